//! Springs of elastic structures in steps of one size: histories lost, and errors, over the stances
//! of vertical and of horizontal units.
//!
//! ```sh
//! cargo bench --bench elastic_fixed_steps
//! ```
//!
//! On a synthetic suite for each structure. None of them is in docs/fixed-steps.md or a test.

use dynamics::effort::Effort;
use fixed_steps::{FixedStepProgram, Integrator, ProgramName};
use frames::{assembled::Assembled, structure::ElasticStructure};
use springs::elastic::{
    program::{ElasticFixedStepDesign, errors_on},
    stand,
    suite::ElasticSuite,
};

type BenchError = Box<dyn std::error::Error>;

/// The programs' step (s).
const STEP: f64 = 1e-3;
/// Stances of the vertical and of the horizontal units.
const STANCES: [[f64; 2]; 10] = [
    [12.0, 768.0],
    [12.0, 192.0],
    [12.0, 48.0],
    [12.0, 12.0],
    [12.0, 3.0],
    [48.0, 192.0],
    [48.0, 12.0],
    [192.0, 768.0],
    [192.0, 12.0],
    [3.0, 3.0],
];

/// Height, span, width and height of a footing (m), its mass, the beam's (kg), EI of a column.
const FRAMES: [[f64; 7]; 3] = [
    [9.0, 8.0, 2.6, 1.2, 35e3, 250e3, 3.5e9],
    [20.0, 15.0, 4.0, 1.5, 60e3, 900e3, 9e9],
    [5.0, 6.0, 1.5, 0.8, 10e3, 60e3, 1e9],
];
/// Height, width, height of the footing (m), its mass, the mass above (kg), frequency (Hz).
const PIERS: [[f64; 6]; 2] =
    [[6.0, 2.0, 0.8, 15e3, 150e3, 5.0], [22.0, 7.0, 2.0, 200e3, 1000e3, 1.2]];

fn structures() -> impl Iterator<Item = String> {
    let frames = FRAMES.into_iter().map(|[h, span, width, high, footing, beam, ei]| {
        format!(
            "kind = 'frame'\nheight_m = {h:?}\nspan_m = {span:?}\nfooting_width_m = {width:?}\n\
             footing_height_m = {high:?}\nfooting_mass_kg = {footing:?}\nbeam_mass_kg = {beam:?}\n\
             column_ea_n = 3.4e10\ncolumn_ei_nm2 = {ei:?}\nbeam_ea_n = 4e10\n\
             beam_ei_nm2 = 1e10\ndamping_ratio = 0.02\n"
        )
    });
    let piers = PIERS.into_iter().map(|[h, width, high, footing, mass, hz]| {
        format!(
            "kind = 'pier'\nheight_m = {h:?}\nwidth_m = {width:?}\nmass_kg = {mass:?}\n\
             footing_mass_kg = {footing:?}\nfooting_height_m = {high:?}\n\
             frequency_hz = {hz:?}\ndamping_ratio = 0.02\n"
        )
    });
    frames.chain(piers)
}

fn programs() -> [(&'static str, FixedStepProgram); 3] {
    let [csi, script] =
        [ProgramName::Sap2000, ProgramName::OpenSees].map(|name| FixedStepProgram::of(name, STEP));
    let trbdf2 = FixedStepProgram { name: None, integrator: Integrator::Trbdf2, ..script };
    [("SAP2000, HHT -1/3", csi), ("backward Euler", script), ("TRBDF2", trbdf2)]
}

/// A number of the family, and springs of it.
type Row = (String, ElasticFixedStepDesign);

fn rows() -> [Row; STANCES.len()] {
    STANCES.map(|[stance, horizontal_stance]| {
        let recipe = ElasticFixedStepDesign::RECIPE;
        let design = ElasticFixedStepDesign { stance, horizontal_stance, ..recipe };
        (format!("stance {stance}, horizontal {horizontal_stance}"), design)
    })
}

fn main() -> Result<(), BenchError> {
    let rows = rows();
    println!("median NRMSE of rotations over p dt (lost) of each structure; all lost");
    let mut suites = Vec::new();
    for text in structures() {
        println!("{}", text.replace('\n', "; "));
        let structure: ElasticStructure = toml::from_str(&text)?;
        suites.push(ElasticSuite::new(Assembled::new(structure)?, None, &Effort::unbounded()));
    }
    for (name, program) in programs() {
        for (row, design) in &rows {
            let (mut told, mut lost) = (Vec::new(), 0);
            for suite in &suites {
                let standing = stand(&suite.model).ok_or("does not stand")?;
                let body = suite.model.structure.body();
                let springs = design.springs(&standing, STEP, &body);
                let uplift = standing.uplift().ok_or("cannot lift")?;
                let settings = program.settings(standing.mass * uplift);
                let errors = errors_on(suite, &springs, settings, &Effort::unbounded())
                    .ok_or("no motion can be predicted")?;
                let p_dt = body.p() * STEP;
                told.push(format!("{:.0} ({})", errors.quantile(0.5) / p_dt, errors.lost()));
                lost += errors.lost();
            }
            println!("{name}, {row}: {}; {lost}", told.join(", "));
        }
    }
    Ok(())
}
