//! Tests of the finite element model against closed forms, limits, dual numbers and dense linear
//! algebra.

mod forces;
mod friction;
mod integrator;
mod members;
mod motions;
mod statics;

use std::f64::consts::TAU;

use super::model::{Contact, Foot, Model, State};
use crate::spring::{Chain, Design, Springs};
use rocking::structure::{Body, Structure};

/// The paper's structure with I_cg as a share of m R^2.
fn body(share: f64) -> Body<f64> {
    let mut body = Structure::paper().body::<f64>();
    body.inertia = share * body.mass * body.radius().powi(2);
    body
}

/// Springs of different chains in the two directions.
fn springs() -> Springs<Chain<f64>> {
    let vertical = Design::from_kc(0.3, 0.1, 0.75, 20.0);
    let horizontal = Design::from_kc(1.7, 0.57, 1.86, 35.0);
    Springs { vertical, horizontal }.chains(Structure::paper().mass_kg)
}

/// All pairs of contacts, both feet anchored off centre.
fn contacts() -> Vec<[Foot<f64>; 2]> {
    let all = [Contact::Open, Contact::Slide, Contact::Stick];
    let foot = |contact, anchor| Foot { contact, anchor };
    all.iter().flat_map(|&l| all.map(|r| [foot(l, 0.013), foot(r, -0.007)])).collect()
}

/// A state far from any symmetry: leaning, pressed, moving.
fn state() -> State<f64> {
    State {
        q: [0.11, -0.02, 0.031, 0.004, -0.011, -0.003, -0.017],
        v: [0.3, -0.1, 0.02, 0.05, -0.2, 0.07, 0.13],
    }
}

/// Standing at rest on springs without damping.
fn undamped(share: f64) -> (Model<f64>, State<f64>, [Foot<f64>; 2]) {
    let mut springs = springs();
    springs.vertical.c = 0.0;
    springs.horizontal.c = 0.0;
    let model = Model::new(&body(share), &springs);
    let (state, feet) = model.settled();
    (model, state, feet)
}

/// Angular frequency (1/s) of f (Hz).
fn omega(hz: f64) -> f64 {
    TAU * hz
}
