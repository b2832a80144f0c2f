//! What is said of a doubt: what it is, and what to do if it is right.

use std::fmt;

use super::{Doubt, MOST_PGA_G};
use files::message::rounded;

/// In one line: what is doubted, and what to do if the doubt is right.
impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}; {}", self.message(), self.remedy())
    }
}

impl Doubt {
    /// What is doubted, in one line.
    pub fn message(&self) -> String {
        match self {
            Self::TotalHeight { key, height, unit } => {
                let (height, total) = (figures(*height), figures(2.0 * height));
                format!(
                    "{key} = {height}, of the centre of mass, makes a block {total} {unit} tall"
                )
            }
            Self::Density { kg_per_m3, mass_kg, box_m, least, most } => {
                let [height, width, depth] = box_m.map(figures);
                format!(
                    "a mean density of {} kg/m3 is not within {least} to {most}: {} kg in a box of \
                        {height} x {width} x {depth} m, as deep as wide",
                    figures(*kg_per_m3),
                    figures(*mass_kg)
                )
            }
            Self::Tonnes { mass, kg_per_m3 } => {
                let [mass, density] = [*mass, *kg_per_m3].map(figures);
                format!(
                    "mass_kg = {mass} gives a block of {density} kg/m3 if it is as deep as \
                        wide"
                )
            }
            Self::Height { height_m } => {
                format!("no structure {} m high was ever built", figures(*height_m))
            }
            Self::LightPart { key, mass_kg, all_kg } => format!(
                "{key} = {} is next to nothing in a structure of {} kg",
                figures(*mass_kg),
                figures(*all_kg)
            ),
            Self::Inertia { kgm2, m_r2 } => format!(
                "a rotational inertia of {} kg m2 is above m R^2 = {}, as if the mass stood \
                    further from its centre than the feet",
                figures(*kgm2),
                figures(*m_r2)
            ),
            Self::HeavyColumn { column_kg, mass_kg } => {
                let [column, mass] = [*column_kg, *mass_kg].map(figures);
                format!("columns of {column} kg stand under {mass} kg")
            }
            _ => self.message_of_motion(),
        }
    }

    /// Of a ground motion.
    fn message_of_motion(&self) -> String {
        match self {
            Self::WeakMotion { pga_g, least_g, whole_g } => {
                let whole = if whole_g >= least_g {
                    format!("; the whole record has {} g", figures(*whole_g))
                } else {
                    String::new()
                };
                format!(
                    "the ground motion has a peak of {} g, below {least_g} g{whole}",
                    figures(*pga_g)
                )
            }
            Self::PeakCut { pga_g, whole_g } => format!(
                "the part used has a peak of {} g, the whole record {} g",
                figures(*pga_g),
                figures(*whole_g)
            ),
            Self::VerticalLeftOut { peak_g, horizontal_g } => format!(
                "a vertical component of {} g beside {} g across is left out",
                figures(*peak_g),
                figures(*horizontal_g)
            ),
            Self::StrongMotion { pga_g, scale } => {
                let scaled = match *scale == 1.0 {
                    true => String::new(),
                    false => format!(" at scale {}", figures(*scale)),
                };
                format!(
                    "a peak of {} g{scaled} is more than was ever recorded on the ground ({} g)",
                    figures(*pga_g),
                    figures(MOST_PGA_G)
                )
            }
            Self::VerticalTaken { component } => {
                format!("component {component}, a vertical one, is taken as the horizontal motion")
            }
            Self::Reversed { scale } => format!(
                "scale {} reverses the vertical motion, too (the horizontal one alone would change \
                    nothing)",
                figures(*scale)
            ),
            Self::LongDuration { asked_s, record_s } => {
                format!(
                    "{} s are asked for, the record has {} s; all of it is used",
                    figures(*asked_s),
                    figures(*record_s)
                )
            }
            _ => String::new(),
        }
    }

    /// What to do if the doubt is right.
    pub fn remedy(&self) -> String {
        match self {
            Self::TotalHeight { key, height, unit } => {
                let height = figures(*height);
                format!("if {height} {unit} is its total height, write total_{key} = {height}")
            }
            Self::Tonnes { mass, .. } => {
                format!("if it is {0} t, write mass_kg = {0}e3", figures(*mass))
            }
            Self::Height { .. } => "check its unit (m)".to_owned(),
            Self::Inertia { .. } => {
                "check its unit (kg m2); it is about the centre of mass".to_owned()
            }
            Self::Density { .. } => "check lengths (m) and mass (kg)".to_owned(),
            Self::WeakMotion { least_g, whole_g, .. } if whole_g < least_g => {
                "check the unit of the record and its scale".to_owned()
            }
            Self::WeakMotion { .. } | Self::PeakCut { .. } => {
                "use more of the record (--duration, duration_s)".to_owned()
            }
            Self::VerticalLeftOut { .. } => {
                "take it with --vertical auto (vertical = \"auto\" in [record]) and compare"
                    .to_owned()
            }
            Self::LightPart { key, mass_kg, .. } => {
                format!("if it is {0} t, write {key} = {0}e3", figures(*mass_kg))
            }
            Self::StrongMotion { .. } => "check the unit of the record and its scale".to_owned(),
            Self::HeavyColumn { .. } => "check the masses (kg) and their units".to_owned(),
            Self::VerticalTaken { .. } => {
                "choose a horizontal one (--component), or a file that has one".to_owned()
            }
            Self::Reversed { scale } => {
                format!("for the motion as recorded write scale = {}", figures(-scale))
            }
            Self::LongDuration { .. } => {
                "leave the duration out, or give a longer record".to_owned()
            }
        }
    }
}

/// Four significant digits, and no more than it takes.
fn figures(x: f64) -> String {
    let x = rounded(x, 4);
    if x == 0.0 || (1e-3..1e7).contains(&x.abs()) { format!("{x}") } else { format!("{x:e}") }
}
