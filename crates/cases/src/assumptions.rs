//! What the program took by itself where a case left it out: the quantity, the value, the key that
//! sets it.

use std::fmt;

use super::{Case, ElasticCase};
use files::message::{quantity, significant};
use frames::structure::ElasticStructure;
use rocking::structure::Kind;
use strong_motion::{Source, excitation::Excitation};

/// A quantity that was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AssumedQuantity {
    /// Velocity after an impact over that before, by equation 2.
    Restitution,
    /// Rotational inertia about the centre of mass, of a solid block.
    SolidInertia,
    /// The same of a mass at an apex: 1e-5 m R^2.
    LeastInertia,
    /// Rotational inertia of a footing, of a solid block.
    FootingInertia,
    /// EA of a column, of a solid square section with the same EI and E = 30 GPa.
    AxialStiffness,
    /// GA_s of a column with a mass of its own, of a solid rectangular concrete section of its EA.
    ShearStiffness,
    /// Ratio to critical damping along a column, as across.
    AxialDamping,
    /// Mass of a column.
    ColumnMass,
    /// Mass of a frame's beam, half of it at each joint: its weight bends nothing.
    BeamMassAtJoints,
    /// Beam elements to a column.
    Elements,
    /// Peak of the record itself: El Centro, as no file is named.
    ElCentro,
    /// Peak of the vertical component that the file has and that is left out.
    NoVertical,
}

/// What was taken for a quantity that was left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assumption {
    pub quantity: AssumedQuantity,
    pub value: f64,
    /// SI, or g; empty for a ratio or a number.
    pub unit: &'static str,
    /// The key of the case file that sets it.
    pub key: &'static str,
}

impl AssumedQuantity {
    /// What it is and what it was taken for, in a few words.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Restitution => "Housner's restitution (equation 2)",
            Self::SolidInertia => "inertia of a solid block",
            Self::LeastInertia => "inertia of a point mass, 1e-5 m R^2,",
            Self::FootingInertia => "inertia of a solid footing",
            Self::AxialStiffness => "EA of a square section, E = 30 GPa,",
            Self::ShearStiffness => "GA_s of a solid section, nu = 0.2,",
            Self::AxialDamping => "axial damping ratio, as across,",
            Self::ColumnMass => "column's mass",
            Self::BeamMassAtJoints => "no gravity moments: half of the beam's mass at each joint,",
            Self::Elements => "elements to a column",
            Self::ElCentro => "1940 El Centro, north-south, peak",
            Self::NoVertical => "vertical motion left out, peak",
        }
    }
}

fn assumption(
    quantity: AssumedQuantity,
    value: f64,
    unit: &'static str,
    key: &'static str,
) -> Assumption {
    Assumption { quantity, value, unit, key }
}

/// In one line: what it is with its value, and the key that sets it.
impl fmt::Display for Assumption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [what, key] = self.told();
        write!(f, "{what} ({key})")
    }
}

impl Assumption {
    /// What it is with its value, and the key that sets it.
    pub fn told(&self) -> [String; 2] {
        let value = match self.unit {
            "" => significant(self.value, 4),
            unit @ ("g" | "kg m2") => format!("{} {unit}", significant(self.value, 4)),
            unit => quantity(self.value, unit),
        };
        [format!("{} = {value}", self.quantity.words()), self.key.into()]
    }
}

impl Case {
    /// What was left out and taken by itself: of the body and of its ground motion, what weighs
    /// most first. Each can be printed.
    pub fn assumptions(&self) -> Vec<Assumption> {
        use AssumedQuantity::{LeastInertia, Restitution, SolidInertia};
        let mut all = Vec::new();
        if !self.given.restitution {
            all.push(assumption(Restitution, self.restitution, "", "structure.restitution"));
        }
        if !self.given.inertia {
            let quantity =
                if self.structure.kind == Kind::Block { SolidInertia } else { LeastInertia };
            let inertia = self.structure.rotational_inertia_kgm2;
            all.push(assumption(quantity, inertia, "kg m2", "structure.rotational_inertia_kgm2"));
        }
        all.extend(of_excitation(&self.excitation));
        first_what_weighs_most(all)
    }
}

impl ElasticCase {
    /// What was left out and taken by itself: of the structure, then of its ground motion.
    pub fn assumptions(&self) -> Vec<Assumption> {
        let mut all = of_structure(&self.structure);
        all.extend(of_excitation(&self.excitation));
        first_what_weighs_most(all)
    }
}

/// Gravity moments that are left out, a column's EA and a vertical motion that is left out come
/// first: a screen may have no room for all.
fn first_what_weighs_most(mut all: Vec<Assumption>) -> Vec<Assumption> {
    all.sort_by_key(|assumption| match assumption.quantity {
        AssumedQuantity::BeamMassAtJoints => 0,
        // axial forces hang on it
        AssumedQuantity::AxialStiffness => 1,
        AssumedQuantity::NoVertical => 2,
        _ => 3,
    });
    all
}

fn of_structure(structure: &ElasticStructure) -> Vec<Assumption> {
    use AssumedQuantity::{
        AxialDamping, AxialStiffness, BeamMassAtJoints, FootingInertia, LeastInertia,
        ShearStiffness,
    };
    let mut all = Vec::new();
    match structure {
        ElasticStructure::Pier(pier) => {
            if pier.ea_n.is_none() {
                all.push(assumption(AxialStiffness, pier.ea(), "N", "structure.ea_n"));
            }
            if pier.ga_n.is_none() && pier.column_mass_kg > 0.0 {
                all.push(assumption(ShearStiffness, pier.ga(), "N", "structure.ga_n"));
            }
            if pier.axial_damping_ratio.is_none() {
                let ratio = pier.axial_damping_ratio();
                all.push(assumption(AxialDamping, ratio, "", "structure.axial_damping_ratio"));
            }
            if pier.footing_inertia_kgm2.is_none() {
                let inertia = pier.footing_inertia();
                all.push(assumption(
                    FootingInertia,
                    inertia,
                    "kg m2",
                    "structure.footing_inertia_kgm2",
                ));
            }
            all.extend(column(pier.column_mass_kg, pier.elements, pier.elements()));
        }
        ElasticStructure::AFrame(frame) => {
            if frame.rotational_inertia_kgm2.is_none() {
                all.push(assumption(
                    LeastInertia,
                    frame.inertia(),
                    "kg m2",
                    "structure.rotational_inertia_kgm2",
                ));
            }
        }
        ElasticStructure::Frame(frame) => {
            if frame.column_ga_n.is_none() && frame.column_mass_kg > 0.0 {
                all.push(assumption(
                    ShearStiffness,
                    frame.column_ga(),
                    "N",
                    "structure.column_ga_n",
                ));
            }
            all.push(assumption(BeamMassAtJoints, 0.5 * frame.beam_mass_kg, "kg", "beam_mass_kg"));
            all.extend(column(frame.column_mass_kg, frame.elements, frame.elements()));
        }
    }
    all
}

/// Of a column without a mass no mass is told; of one with a mass the elements that it was cut
/// into.
fn column(mass_kg: f64, given: Option<usize>, elements: usize) -> Option<Assumption> {
    match given {
        _ if mass_kg == 0.0 => {
            Some(assumption(AssumedQuantity::ColumnMass, 0.0, "kg", "structure.column_mass_kg"))
        }
        None => {
            Some(assumption(AssumedQuantity::Elements, elements as f64, "", "structure.elements"))
        }
        Some(_) => None,
    }
}

/// What was taken of a ground motion by itself.
pub(crate) fn of_excitation(excitation: &Excitation) -> Vec<Assumption> {
    let embedded = excitation.record.source == Source::Embedded;
    let record = embedded.then(|| {
        let peak_g = excitation.scale.abs() * excitation.record.pga_g();
        assumption(AssumedQuantity::ElCentro, peak_g, "g", "record.file")
    });
    let vertical = excitation.vertical_left_out();
    let vertical = vertical
        .map(|left| assumption(AssumedQuantity::NoVertical, left.peak_g, "g", "record.vertical"));
    record.into_iter().chain(vertical).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keys(assumptions: &[Assumption]) -> Vec<&'static str> {
        assumptions.iter().map(|a| a.key.trim_start_matches("structure.")).collect()
    }

    #[test]
    fn what_a_rigid_case_leaves_out_is_told_with_its_value() {
        let bare = "[structure]\nkind = 'block'\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 1200.0\n";
        let assumed = Case::parse("case.toml", bare).unwrap().assumptions();
        assert_eq!(keys(&assumed), ["restitution", "rotational_inertia_kgm2", "record.file"]);
        // equation 2 of a slender block: 1 - 3/2 sin^2 alpha; m R^2/3; PEER's PGA of El Centro
        let sin2 = 0.0625 / 1.0625;
        assert!((assumed[0].value - (1.0 - 1.5 * sin2)).abs() < 1e-12);
        assert!((assumed[1].value - 1200.0 * 1.0625 / 3.0).abs() < 1e-9);
        assert!((assumed[2].value - 0.313).abs() < 5e-4);
        let given = format!("{bare}restitution_ratio = 0.99\nrotational_inertia_kgm2 = 420.0\n");
        assert_eq!(keys(&Case::parse("case.toml", &given).unwrap().assumptions()), ["record.file"]);
    }

    #[test]
    fn what_a_pier_leaves_out_is_told_with_its_value() {
        let pier = "[structure]\nkind = 'pier'\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = 600e3\n\
            footing_mass_kg = 120e3\nfooting_height_m = 1.5\nei_nm2 = 9e9\ndamping_ratio = 0.02\n";
        let of = |more: &str| {
            ElasticCase::parse("pier.toml", &format!("{pier}{more}")).unwrap().assumptions()
        };
        let assumed = of("");
        let all = [
            "ea_n",
            "axial_damping_ratio",
            "footing_inertia_kgm2",
            "column_mass_kg",
            "record.file",
        ];
        assert_eq!(keys(&assumed), all);
        // a column with a mass of its own gives in shear
        let heavy = of("column_mass_kg = 60e3\n");
        assert_eq!(keys(&heavy)[..2], ["ea_n", "ga_n"]);
        assert!((heavy[1].value / (heavy[0].value * 5.0 / 6.0 / 2.4) - 1.0).abs() < 1e-12);
        // a square of side a: I = a^4/12, so a^2 = sqrt(12 x 9e9/30e9) m2, EA = 30e9 a^2
        assert!((assumed[0].value / (30e9 * (12.0_f64 * 0.3).sqrt()) - 1.0).abs() < 1e-12);
        assert!((assumed[2].value - 120e3 * (16.0 + 2.25) / 12.0).abs() < 1e-6);
        let rest = of("ea_n = 1e11\naxial_damping_ratio = 0.01\nfooting_inertia_kgm2 = 1e5\n\
                column_mass_kg = 9e3\n");
        assert_eq!((keys(&rest), rest[1].value), (vec!["ga_n", "elements", "record.file"], 4.0));
    }

    #[test]
    fn a_vertical_component_that_is_left_out_is_told_with_its_peak() {
        let file =
            concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/records/20161113_110259_WTMC_20.V2A");
        let with = |more: &str| {
            let body =
                "[structure]\nkind = 'aframe'\nheight_m = 12.0\nwidth_m = 2.4\nmass_kg = 3e5\n";
            Case::parse("case.toml", &format!("{body}[record]\nfile = '{file}'\n{more}")).unwrap()
        };
        // the file's own header: 1.84 g upwards beside 0.99 g
        let case = with("scale = -0.5\n");
        let assumed = case.assumptions();
        assert_eq!(keys(&assumed), ["record.vertical", "restitution", "rotational_inertia_kgm2"]);
        assert!((assumed[0].value - 0.5 * 1.84).abs() < 5e-3, "{assumed:?}");
        let both = case.excitation.with_vertical_left_out().unwrap().unwrap();
        assert_eq!(both, with("scale = -0.5\nvertical = 'auto'\n").excitation);
        assert!(both.vertical_left_out().is_none() && of_excitation(&both).is_empty());
    }
}
