//! `tune init`: a case file to begin with, every line explained.

use std::{
    fs::OpenOptions,
    io::{ErrorKind, Write},
    path::PathBuf,
};

use clap::{Args, ValueEnum};

use super::{CommandError, output::file_in};

/// What the file begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Shape {
    /// Two legs that meet in one mass: a bridge pier, a tower
    #[value(name = "aframe")]
    AFrame,
    /// A solid block: a column, a cabinet, equipment
    Block,
}

/// Options of `tune init`.
#[derive(Debug, Args)]
pub struct Options {
    /// What rocks
    #[arg(value_enum, default_value_t = Shape::AFrame)]
    shape: Shape,
    /// The case file to write; one that is there stays as it is
    #[arg(long, value_name = "PATH", default_value = "case.toml")]
    out: PathBuf,
}

const AFRAME: &str = "\
[structure]
kind = \"aframe\"          # all mass at the apex of two legs
height_m = 12.0          # of the centre of mass above the feet; or height_ft, height_in
width_m = 2.4            # between the feet; or width_ft, width_in
mass_kg = 350e3          # or mass_t, mass_lb, weight_kn, weight_kip
";

const BLOCK: &str = "\
[structure]
kind = \"block\"           # solid, its centre of mass half way up
total_height_m = 2.0     # of the whole block; or total_height_ft, total_height_in
width_m = 0.5            # between the edges that it rocks on; or width_ft, width_in
mass_kg = 400.0          # or mass_t, mass_lb, weight_kn, weight_lb
# rotational_inertia_kgm2 = 140.0  # about the centre of mass, where it is not that of a solid block
";

const REST: &str = "\
# restitution = 0.9      # velocity after an impact over that before; left out: Housner's, equation 2

[record]                 # left out: 1940 El Centro, north-south
# file = \"motion.at2\"    # PEER AT2, GeoNet, COSMOS, CSMIP, K-NET, ESM or columns, beside this file
# component = \"N\"        # of a file with several; left out: the stronger horizontal one
# dt_s = 0.01            # where the file does not say
# units = \"cm/s2\"        # g, m/s2, cm/s2 or mm/s2, where the file does not say
scale = 1.0              # factor on the acceleration
# duration_s = 20.0      # left out: the whole record

[tuning]
accuracy = 0.002         # of the history against Housner's: sqrt(sum (u - u_H)^2 / sum u_H^2)
# max_omega_hz = 160.0   # stiffest springs, for programs with fixed time steps; left out: no limit
";

/// The text for a shape.
fn text(shape: Shape) -> String {
    let structure = match shape {
        Shape::AFrame => AFRAME,
        Shape::Block => BLOCK,
    };
    format!("# A case for `tune run`: what rocks, on which ground motion, how accurately.\n\n{structure}{REST}")
}

pub fn run(o: &Options) -> Result<(), CommandError> {
    let out = file_in(&o.out, "case.toml")?;
    let path = out.display().to_string();
    let there = |source: std::io::Error| match source.kind() {
        ErrorKind::AlreadyExists => {
            CommandError::Result(format!("{path}: is there already; name another with --out, or remove it"))
        }
        _ => CommandError::Write { path: path.clone(), source },
    };
    if let Some(folder) = out.parent() {
        std::fs::create_dir_all(folder).map_err(there)?;
    }
    let mut file = OpenOptions::new().write(true).create_new(true).open(&out).map_err(there)?;
    file.write_all(text(o.shape).as_bytes()).map_err(there)?;
    eprintln!("written to {path}: edit it, then `tune run {path}`");
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    #[test]
    fn both_files_are_cases() {
        let frame = Case::parse("case.toml", &text(Shape::AFrame)).unwrap();
        assert_eq!((frame.structure.height_m, frame.structure.mass_kg), (12.0, 350e3));
        let block = Case::parse("case.toml", &text(Shape::Block)).unwrap();
        assert_eq!((block.structure.height_m, block.structure.width_m), (1.0, 0.5));
    }

    /// What is commented out is right, too: but for the names of files, which are not there.
    #[test]
    fn what_is_commented_out_can_be_used() {
        for shape in [Shape::AFrame, Shape::Block] {
            let used: String = text(shape)
                .lines()
                .filter(|line| {
                    !["# file", "# component", "# dt_s", "# units", "# A case"].iter().any(|x| line.starts_with(x))
                })
                .map(|line| format!("{}\n", line.strip_prefix("# ").unwrap_or(line)))
                .collect();
            let case = Case::parse("case.toml", &used).unwrap();
            assert_eq!((case.restitution, case.tuning.max_omega_hz), (0.9, Some(160.0)));
        }
    }
}
