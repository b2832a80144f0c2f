//! What a user should look at again: numbers that can be right and seldom are. A doubt is a
//! warning, no error.
//!
//! ```text
//!   mean density   all mass / (total height x width x depth of the body's box)
//! ```
//!
//! A plane structure has no depth: its box is taken as deep as it is wide between the feet, a
//! frame's as deep as a footing. Depths of structures differ from that by a factor of four or so,
//! hence limits that lie far apart: 5 kg/m3 is four times the air's, 25,000 beyond the densest
//! metals (osmium, 22,590).

mod words;

use super::{Case, ElasticCase, GivenKeys, StructureSection, structure::unit_of};
use frames::structure::ElasticStructure;
use rocking::structure::{Kind, Structure};
use strong_motion::{Source, excitation::Excitation};

/// A doubt and its quantities.
#[derive(Clone, Debug, PartialEq)]
pub enum Doubt {
    /// A block whose `height_m`, that of its centre of mass, may be its total height: the height in
    /// the unit of its key.
    TotalHeight { key: &'static str, height: f64, unit: &'static str },
    /// A mean density of no material.
    Density { kg_per_m3: f64, mass_kg: f64, box_m: [f64; 3], least: f64, most: f64 },
    /// A block so light that its mass may be in tonnes.
    Tonnes { mass: f64, kg_per_m3: f64 },
    /// A rotational inertia above m R^2: mass would stand further from the centre than the feet.
    Inertia { kgm2: f64, m_r2: f64 },
    /// A column several times as heavy as the mass that it bears.
    HeavyColumn { column_kg: f64, mass_kg: f64 },
    /// A height of no structure (m).
    Height { height_m: f64 },
    /// A mass that is nothing beside the structure's, and so may be in tonnes.
    LightPart { key: &'static str, mass_kg: f64, all_kg: f64 },
    /// A peak ground acceleration beyond all that was recorded.
    StrongMotion { pga_g: f64, scale: f64 },
    /// Peak ground acceleration of the part used, and of the whole record, scaled.
    WeakMotion { pga_g: f64, least_g: f64, whole_g: f64 },
    /// The strongest part of the record is not used: the peaks, scaled.
    PeakCut { pga_g: f64, whole_g: f64 },
    /// A vertical component of the record's file is left out that is not small: peaks of the whole
    /// file, scaled.
    VerticalLeftOut { peak_g: f64, horizontal_g: f64 },
    /// A vertical component is taken as the horizontal motion.
    VerticalTaken { component: String },
    /// A scale below zero reverses the vertical motion, too.
    Reversed { scale: f64 },
    /// More of the record is asked for than there is.
    LongDuration { asked_s: f64, record_s: f64 },
}

/// Mean densities that structures and equipment have [kg/m3].
const DENSITY: [f64; 2] = [5.0, 25_000.0];
/// Of solid masonry, stone and concrete [kg/m3].
const SOLID: [f64; 2] = [1600.0, 3000.0];
/// Below it a body is no solid: equipment, furniture, a tank [kg/m3].
const LIGHT: f64 = 1000.0;
/// Empty cabinets have more; steel [kg/m3].
const LIGHTEST: f64 = 30.0;
const HEAVIEST: f64 = 8000.0;
/// A light body is seldom higher: it stands in a room (m).
const ROOM_M: f64 = 2.5;
/// A column is seldom so many times as heavy as what it bears.
const HEAVY_COLUMN: f64 = 3.0;
/// Weaker ground motions are not felt (g).
const LEAST_PGA_G: f64 = 0.005;
/// No bridge and no chimney is higher, and no body that is looked at is lower (m).
const HEIGHTS: [f64; 2] = [0.02, 500.0];
/// Stronger ones were not recorded on the ground (g): horizontally 2.7 g, in Tsukidate in 2011.
const MOST_PGA_G: f64 = 3.0;
/// Below this share of the record's peak the part used lacks the strong motion.
const USED_SHARE: f64 = 0.5;
/// A part of a structure's mass that is nothing beside it: a number in tonnes is a thousandth.
const NOTHING: f64 = 2e-3;
/// A vertical component above this share of the horizontal one's peak is not left out without a
/// word.
const VERTICAL_SHARE: f64 = 0.5;
/// Beyond this slenderness a body does not rock (rad), as [`Structure::checked`] has it.
const STOCKIEST: f64 = 0.9;

impl Case {
    /// Doubts of the body and of its ground motion, in this order. Each can be printed.
    pub fn doubts(&self) -> Vec<Doubt> {
        with_motion(self.doubts_of_structure(), &self.excitation)
    }

    /// Doubts of the body alone.
    #[doc(hidden)]
    pub fn doubts_of_structure(&self) -> Vec<Doubt> {
        of_structure(&self.structure, &self.given)
    }
}

impl StructureSection {
    /// Doubts of the body that it gives.
    pub fn doubts(&self, body: &Structure) -> Vec<Doubt> {
        of_structure(body, &self.given())
    }
}

/// Doubts of a body, given by these keys.
fn of_structure(body: &Structure, given: &GivenKeys) -> Vec<Doubt> {
    let height = if body.kind == Kind::Block { 2.0 * body.height_m } else { body.height_m };
    let box_m = [height, body.width_m, body.width_m];
    let density = density(body.mass_kg, box_m, DENSITY[0]);
    let height_or_tonnes = || tonnes(body).or_else(|| total_height(body, given));
    let inertia = inertia(body);
    of_height(height).into_iter().chain(height_or_tonnes()).chain(density).chain(inertia).collect()
}

impl ElasticCase {
    /// Doubts of the structure and of its ground motion, in this order.
    pub fn doubts(&self) -> Vec<Doubt> {
        with_motion(self.doubts_of_structure(), &self.excitation)
    }

    /// Doubts of the structure alone.
    pub fn doubts_of_structure(&self) -> Vec<Doubt> {
        let box_m = match &self.structure {
            ElasticStructure::Pier(pier) => [pier.height_m, pier.width_m, pier.width_m],
            ElasticStructure::AFrame(frame) => [frame.height_m, frame.width_m, frame.width_m],
            ElasticStructure::Frame(frame) => {
                [frame.height_m, frame.span_m + frame.footing_width_m, frame.footing_width_m]
            }
        };
        let column = match &self.structure {
            ElasticStructure::Pier(pier) => heavy_column(pier.column_mass_kg, pier.mass_kg),
            ElasticStructure::Frame(frame) => {
                heavy_column(2.0 * frame.column_mass_kg, frame.beam_mass_kg)
            }
            ElasticStructure::AFrame(_) => None,
        };
        // of concrete or steel, but for a tower on legs that stand wide
        let least = match &self.structure {
            ElasticStructure::AFrame(_) => DENSITY[0],
            ElasticStructure::Pier(_) | ElasticStructure::Frame(_) => LIGHTEST,
        };
        let height = of_height(box_m[0]);
        let all =
            height.into_iter().chain(density(self.structure.mass(), box_m, least)).chain(column);
        let inertia = match &self.structure {
            ElasticStructure::AFrame(frame) => {
                let (height, half_width) = (frame.height_m, frame.width_m / 2.0);
                large_inertia(frame.inertia(), frame.mass_kg * height.hypot(half_width).powi(2))
            }
            _ => None,
        };
        all.chain(self.light_part()).chain(inertia).collect()
    }

    /// The first mass that is nothing beside the structure's.
    fn light_part(&self) -> Option<Doubt> {
        let parts = match &self.structure {
            ElasticStructure::Pier(pier) => vec![
                ("mass_kg", pier.mass_kg),
                ("footing_mass_kg", pier.footing_mass_kg),
                ("column_mass_kg", pier.column_mass_kg),
            ],
            ElasticStructure::AFrame(frame) => {
                vec![("mass_kg", frame.mass_kg), ("foot_mass_kg", frame.foot_mass_kg)]
            }
            ElasticStructure::Frame(frame) => vec![
                ("beam_mass_kg", frame.beam_mass_kg),
                ("footing_mass_kg", frame.footing_mass_kg),
                ("column_mass_kg", frame.column_mass_kg),
            ],
        };
        let all_kg = self.structure.mass();
        let light = |(_, mass): &(&str, f64)| *mass > 0.0 && *mass < NOTHING * all_kg;
        let (key, mass_kg) = parts.into_iter().find(light)?;
        Some(Doubt::LightPart { key, mass_kg, all_kg })
    }
}

/// Whether a block's height of the centre of mass looks like its total height: as it is read the
/// block is no solid, and half as high it would be one; or it is light and would not stand in a
/// room. A block that could not rock if it were half as high is as it is read.
fn total_height(body: &Structure, given: &GivenKeys) -> Option<Doubt> {
    let key = given.height.filter(|key| key.starts_with("height_") && body.kind == Kind::Block)?;
    let total = 2.0 * body.height_m;
    let read = body.mass_kg / (total * body.width_m.powi(2));
    let rocks = (body.width_m / body.height_m).atan() < STOCKIEST;
    let solid = |density: f64| (SOLID[0]..=SOLID[1]).contains(&density);
    let half_is_solid = !solid(read) && solid(2.0 * read);
    let above_a_room = read < LIGHT && total > ROOM_M && body.height_m <= ROOM_M;
    let (height, unit) = (body.height_m / unit_of(key), key.trim_start_matches("height_"));
    (rocks && (half_is_solid || above_a_room)).then_some(Doubt::TotalHeight { key, height, unit })
}

/// Whether a block is lighter than what stands in rooms, and would not be if its mass were in
/// tonnes.
fn tonnes(body: &Structure) -> Option<Doubt> {
    let kg_per_m3 = body.mass_kg / (2.0 * body.height_m * body.width_m.powi(2));
    let doubted = (DENSITY[0]..LIGHTEST).contains(&kg_per_m3)
        && (LIGHT..HEAVIEST).contains(&(1e3 * kg_per_m3))
        && body.kind == Kind::Block;
    doubted.then_some(Doubt::Tonnes { mass: body.mass_kg, kg_per_m3 })
}

fn density(mass_kg: f64, box_m: [f64; 3], least: f64) -> Option<Doubt> {
    let kg_per_m3 = mass_kg / box_m.iter().product::<f64>();
    let most = DENSITY[1];
    let within = (least..=most).contains(&kg_per_m3);
    (!within).then_some(Doubt::Density { kg_per_m3, mass_kg, box_m, least, most })
}

/// Of a rigid body; a block of more is refused as it is read.
fn inertia(body: &Structure) -> Option<Doubt> {
    let rigid = body.body::<f64>();
    large_inertia(body.rotational_inertia_kgm2, rigid.mass * rigid.radius().powi(2))
}

fn large_inertia(kgm2: f64, m_r2: f64) -> Option<Doubt> {
    (kgm2 > m_r2 * (1.0 + 1e-9)).then_some(Doubt::Inertia { kgm2, m_r2 })
}

fn of_height(height_m: f64) -> Option<Doubt> {
    let [least, most] = HEIGHTS;
    (!(least..=most).contains(&height_m)).then_some(Doubt::Height { height_m })
}

fn heavy_column(column_kg: f64, mass_kg: f64) -> Option<Doubt> {
    (column_kg > HEAVY_COLUMN * mass_kg).then_some(Doubt::HeavyColumn { column_kg, mass_kg })
}

/// Doubts of a structure, and those of its ground motion after them.
fn with_motion(mut doubts: Vec<Doubt>, excitation: &Excitation) -> Vec<Doubt> {
    doubts.extend(of_excitation(excitation));
    doubts
}

/// Doubts of a ground motion, as it is used.
pub fn of_excitation(excitation: &Excitation) -> Vec<Doubt> {
    let record = &excitation.record;
    let used = record.truncated(excitation.duration());
    let pga_g = excitation.scale.abs() * used.pga_g();
    let whole_g = excitation.scale.abs() * record.pga_g();
    let weak =
        (pga_g < LEAST_PGA_G).then_some(Doubt::WeakMotion { pga_g, least_g: LEAST_PGA_G, whole_g });
    let cut = (weak.is_none() && pga_g < USED_SHARE * whole_g)
        .then_some(Doubt::PeakCut { pga_g, whole_g });
    let strong =
        (pga_g > MOST_PGA_G).then_some(Doubt::StrongMotion { pga_g, scale: excitation.scale });
    let record_s = record.duration();
    // half a step: a length that was rounded is none that is longer
    let long = excitation.duration_s.filter(|asked| *asked > record_s + 0.5 * record.dt);
    let long = long.map(|asked_s| Doubt::LongDuration { asked_s, record_s });
    let vertical = excitation
        .vertical_left_out()
        .filter(|left| left.peak_g > VERTICAL_SHARE * left.horizontal_g);
    let vertical = vertical.map(|left| Doubt::VerticalLeftOut {
        peak_g: left.peak_g,
        horizontal_g: left.horizontal_g,
    });
    let only = match &record.source {
        Source::File { vertical_taken: Some(component), .. } => Some(component.clone()),
        _ => None,
    };
    let only = only.map(|component| Doubt::VerticalTaken { component });
    let scale = excitation.scale;
    let reversed = (scale < 0.0 && record.vertical.is_some()).then_some(Doubt::Reversed { scale });
    let of_peaks = weak.into_iter().chain(cut).chain(strong);
    only.into_iter().chain(of_peaks).chain(reversed).chain(long).chain(vertical).collect()
}

impl Doubt {
    /// Peaks of a vertical component that is left out, and of the horizontal one (g), if that is
    /// doubted.
    pub fn vertical_left_out(&self) -> Option<(f64, f64)> {
        match *self {
            Self::VerticalLeftOut { peak_g, horizontal_g } => Some((peak_g, horizontal_g)),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests;
