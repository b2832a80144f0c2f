//! `tune init`: a case file, or a sweep file, to begin with, every line explained.

use std::{
    fs::OpenOptions,
    io::{ErrorKind, Write},
    path::{Path, PathBuf},
};

use clap::{Args, ValueEnum};

use super::{CommandError, terminal};
use run_folder::FolderError;
use run_folder::place::file_in;

/// What the file begins with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum StructureShape {
    /// Two legs that meet in one mass: a tower, the paper's bridge pier
    #[value(name = "aframe")]
    AFrame,
    /// A solid block: a column, a cabinet, equipment
    Block,
    /// A mass on an elastic column on a rigid footing
    Pier,
    /// The A-frame with elastic legs
    #[value(name = "elastic-aframe")]
    ElasticAFrame,
    /// Two elastic columns on two footings under a beam
    Frame,
    /// A rigid body on many ground motions: a file for `tune sweep`
    Sweep,
}

/// Options of `tune init`.
#[derive(Debug, Args)]
pub struct InitOptions {
    /// What rocks
    #[arg(value_enum, default_value_t = StructureShape::AFrame)]
    shape: StructureShape,
    /// The file to write, case.toml or sweep.toml unless given; one that is there stays as it is
    #[arg(long, value_name = "PATH")]
    out: Option<PathBuf>,
}

const SWEEP: &str = "\
# A file for `tune sweep`: one rigid body or more on many ground motions, each at many levels.

[sweep]
kind = \"fragility\"       # how likely it rocks and overturns
seed = 1                 # of the motions that are made

[[structure]]            # as [structure] of a case; as many as you like
kind = \"block\"           # or \"aframe\"
total_height_m = 2.0
width_m = 0.5
mass_kg = 400.0
# name = \"cabinet\"      # in tables and figures

[records]                # any of these, or several
earthquakes = 100        # made, like earthquakes
# like = \"motion.at2\"    # made, with the spectrum and the envelope of this one
# files = [\"a.at2\", \"b.V2A\"]
# el_centro = true

[levels]                 # or scale = [0.5, 1.0, 1.5]
pga_g = { from = 0.1, to = 2.0, count = 20, spacing = \"log\" }
";

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
total_height_m = 2.0     # of the whole block, or total_height_ft; or height_m, of the centre
width_m = 0.5            # between the edges that it rocks on; or width_ft, width_in
mass_kg = 400.0          # or mass_t, mass_lb, weight_kn, weight_lb
# rotational_inertia_kgm2 = 140.0  # about the centre of mass, where it is not that of a solid block
";

const PIER: &str = "\
[structure]
kind = \"pier\"            # a mass on an elastic column on a rigid footing
height_m = 12.0          # of the mass above the soles
width_m = 4.0            # of the footing
mass_kg = 600e3
footing_mass_kg = 60e3
footing_height_m = 1.5
frequency_hz = 2.0       # fixed to the ground, across; or the column's EI, ei_nm2
damping_ratio = 0.02     # to critical, across
# ea_n = 5e10            # of the column, EA; left out: that of a square concrete section
# ga_n = 1.7e10          # GA_s, in shear, of a column with mass; left out: a solid section's
# axial_damping_ratio = 0.02
# column_mass_kg = 40e3  # along the column
# elements = 4           # to the column, where it has a mass
";

const ELASTIC_AFRAME: &str = "\
[structure]
kind = \"aframe\"          # a mass at the apex of two legs, clamped to it and hinged at the feet
height_m = 30.0          # of the apex above the feet
width_m = 4.0            # between the feet
mass_kg = 400e3          # at the apex
foot_mass_kg = 10e3      # at each foot: what is stopped at a landing
ea_n = 3e10              # of a leg: EA
ei_nm2 = 2.5e9           # and EI
damping_ratio = 0.02     # to critical, across
# rotational_inertia_kgm2 = 1e5    # of the mass at the apex
";

const FRAME: &str = "\
[structure]
kind = \"frame\"           # two columns on two footings under a beam
height_m = 12.0          # of the beam's axis above the soles
span_m = 10.0            # between the columns' axes
footing_width_m = 3.0
footing_height_m = 1.5
footing_mass_kg = 40e3   # each
beam_mass_kg = 500e3     # of the beam and what it carries, half at each joint: no gravity moments
column_ea_n = 3.4e10     # of a column: EA
column_ei_nm2 = 3e9      # and EI
beam_ea_n = 4e10
beam_ei_nm2 = 1e10
damping_ratio = 0.02     # to critical, across
# column_ga_n = 1.2e10   # GA_s, in shear, of columns with mass; left out: a solid section's
# column_mass_kg = 40e3  # along each column
# elements = 4           # to a column, where it has a mass
";

const RESTITUTION: &str = "\
# restitution = 0.9      # velocity after an impact over that before; left out: Housner's, \
                           equation 2
";

const REST: &str = "
[record]                 # left out: 1940 El Centro, north-south
# file = \"motion.at2\"    # PEER AT2, GeoNet, COSMOS, CSMIP, K-NET, ESM or columns, beside this \
                    file
# component = \"N\"        # of a file with several; left out: the stronger horizontal one
# column = 2             # of a table of several columns, counted from 1, or its name in the header
# vertical = \"auto\"      # the file's vertical component, or another file's; left out: none
# dt_s = 0.01            # where the file does not say
# units = \"cm/s2\"        # or g, m/s2, mm/s2, mg, %g, ft/s2, in/s2, mGal; left out: by the file
scale = 1.0              # factor on the acceleration, with a decimal point
# duration_s = 20.0      # left out: the whole record

[tuning]
accuracy = 0.002         # of the history against the reference's, normalised: sqrt(sum (u - \
                    u_r)^2 / sum u_r^2)
# max_omega_hz = 160.0   # stiffest springs allowed, Omega_n / 2 pi; left out: no limit

# [program]              # springs for a program with steps of one size, too
# for = \"sap2000\"        # or etabs, opensees-even
# step_s = 0.001
";

const FRICTION: &str = "
# [friction]             # feet slide; left out: they hold; not with a damper or tendon
# coefficient = 0.5
";

const MEMBERS: &str = "
# [damper]               # a dashpot from the ground to each foot or corner, vertical
# c_ns_per_m = 1e5

# [tendon]               # from the mass to the ground midway between the feet or corners
# stiffness_n_per_m = 1e6
# pretension_n = 1e3
";

/// The text for a shape.
fn text(shape: StructureShape) -> String {
    let (structure, restitution, friction) = match shape {
        StructureShape::Sweep => return SWEEP.into(),
        StructureShape::AFrame => (AFRAME, RESTITUTION, FRICTION),
        StructureShape::Block => (BLOCK, RESTITUTION, FRICTION),
        StructureShape::Pier => (PIER, "", ""),
        StructureShape::ElasticAFrame => (ELASTIC_AFRAME, "", ""),
        StructureShape::Frame => (FRAME, "", ""),
    };
    format!(
        "# A case for `tune run`: what rocks, on which ground motion, how accurately.\n\n\
         {structure}{restitution}{REST}{friction}{MEMBERS}"
    )
}

pub fn run(o: &InitOptions) -> Result<(), CommandError> {
    let (name, command) = match o.shape {
        StructureShape::Sweep => ("sweep.toml", "sweep"),
        _ => ("case.toml", "run"),
    };
    let out = file_in(o.out.as_deref().unwrap_or(Path::new(name)), name)?;
    let path = out.display().to_string();
    let there = |source: std::io::Error| match source.kind() {
        ErrorKind::AlreadyExists => CommandError::Result(format!(
            "{path}: is there already; name another with --out, or remove it"
        )),
        _ => FolderError::Write { path: path.clone(), source }.into(),
    };
    if let Some(folder) = out.parent() {
        std::fs::create_dir_all(folder).map_err(there)?;
    }
    let mut file = OpenOptions::new().write(true).create_new(true).open(&out).map_err(there)?;
    file.write_all(text(o.shape).as_bytes()).map_err(there)?;
    terminal::stderr(format_args!("written to {path}: edit it, then `tune {command} {path}`"));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use cases::{Case, ElasticCase};

    #[test]
    fn both_files_are_cases() {
        let frame = Case::parse("case.toml", &text(StructureShape::AFrame)).unwrap();
        assert_eq!((frame.structure.height_m, frame.structure.mass_kg), (12.0, 350e3));
        let block = Case::parse("case.toml", &text(StructureShape::Block)).unwrap();
        assert_eq!((block.structure.height_m, block.structure.width_m), (1.0, 0.5));
    }

    /// What is commented out is right, too: but for the names of files, which are not there.
    #[test]
    fn what_is_commented_out_can_be_used() {
        for shape in [StructureShape::AFrame, StructureShape::Block] {
            let used = used(shape);
            // friction, or a damper and a tendon
            let [held, slipping] = [&["[friction]"][..], &["[damper]", "[tendon]"]].map(|out| {
                let stays = |part: &&str| !out.iter().any(|name| part.starts_with(name));
                let parts: Vec<&str> = used.split_inclusive("\n\n").filter(stays).collect();
                Case::parse("case.toml", &parts.concat()).unwrap()
            });
            assert_eq!((held.restitution, held.tuning.max_omega_hz), (0.9, Some(160.0)));
            assert!(held.members.damper.is_some() && held.members.tendon.is_some());
            assert!(slipping.members.friction.is_some() && slipping.program.is_some());
        }
        for shape in [StructureShape::Pier, StructureShape::ElasticAFrame, StructureShape::Frame] {
            let used = used(shape);
            assert!(ElasticCase::is(&text(shape)) && ElasticCase::is(&used));
            ElasticCase::parse("case.toml", &text(shape)).unwrap();
            assert_eq!(ElasticCase::parse("case.toml", &used).unwrap().max_omega_hz, Some(160.0));
        }
    }

    /// With the files that it names, and as it is.
    #[test]
    fn the_file_of_a_sweep_is_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("sweep.toml");
        let plan = |text: &str| {
            std::fs::write(&path, text).unwrap();
            sweep::plan::Plan::read(&path).unwrap()
        };
        let text = text(StructureShape::Sweep);
        assert_eq!(plan(&text).cells(), 100 * 20);
        assert_eq!(plan(&text.replace("# el_centro", "el_centro")).cells(), 101 * 20);
    }

    /// The text with what is commented out.
    fn used(shape: StructureShape) -> String {
        let of_file = ["# file", "# component", "# column =", "# vertical", "# dt_s", "# units"];
        let names = [&of_file[..], &["# A case"]].concat();
        text(shape)
            .lines()
            .filter(|line| !names.iter().any(|x| line.starts_with(x)))
            .map(|line| format!("{}\n", line.strip_prefix("# ").unwrap_or(line)))
            .collect()
    }
}
