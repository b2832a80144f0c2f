//! A block, a pier, their springs and a motion that rocks them.

use dynamics::spring::{Chain, Design, Springs};
use fixed_steps::{ConvergenceTest, Integrator, Iteration, StepSettings};
use frames::{
    beam::BeamSection,
    frame::{Cantilever, Footing, Frame, StraightMember},
};
use rocking::structure::{Body, Structure};

/// Time step of motions (s).
pub const DT: f64 = 0.01;

pub fn block() -> Body<f64> {
    Structure::block(2.6, 0.7, 1e3).unwrap().body()
}

/// A mass of 600 t on a column of 12 m on a footing of 4 m; 2 Hz, eta_I its dashpot (N m2 s). The
/// column begins at the footing's centre.
pub fn pier(bending_damping: f64) -> Frame {
    let section = BeamSection { bending_damping, ..BeamSection::elastic(1e10, 4e10) };
    let footing = Footing::block(4.0, 1.2e5, 0.75, 0.75);
    let column = StraightMember { section, elements: 1 };
    Cantilever { mass: 6e5, inertia: None, height: 12.0, footing, column, consistent: false }
        .layout()
        .frame()
        .unwrap()
}

/// Units for this mass (kg), at a frequency (Hz).
pub fn units(mass: f64, hz: f64) -> Springs<Chain> {
    let vertical = Design::from_kc(0.3, 0.1, 0.75, hz);
    let horizontal = Design::from_kc(0.3, 0.57, 1.86, hz);
    Springs { vertical, horizontal }.chains(mass)
}

/// A Ricker wavelet of 7 rad/s about 1 s: 3 s.
pub fn pulse(peak: f64) -> Vec<f64> {
    let at = |t: f64| {
        let square = (3.5 * (t - 1.0)).powi(2);
        peak * (1.0 - 2.0 * square) * (-square).exp()
    };
    (0..300).map(|i| at(f64::from(i) * DT)).collect()
}

/// Newton's iterations alone, down to a change of place (m).
pub fn newton(integrator: Integrator, step: f64, below: f64) -> StepSettings {
    let iteration = Iteration { constant: 0, newton: 30, test: ConvergenceTest::Increment(below) };
    StepSettings { iteration, ..StepSettings::new(integrator, step) }
}
