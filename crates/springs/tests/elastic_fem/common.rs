//! Piers, springs and a record for these stories.

use std::f64::consts::TAU;

use cases::Asked;
use dynamics::spring::{Chain, Springs};
use fixed_steps::FixedStepProgram;
use frames::{
    answer::{ElasticAnswer, Reference},
    assembled::Assembled,
    beam::BeamSection,
    frame::{Cantilever, Footing, Frame, StraightMember},
    reference::{FORETOLD, MOST_WORK},
    structure::{ElasticStructure, PierSpec},
};
use rocking::scalar::GRAVITY;
use springs::elastic::{ElasticAsked, design::CornerSprings};
use strong_motion::Record;

/// An error alone; the program is the usual one.
pub fn only(error: Asked) -> ElasticAsked {
    ElasticAsked { error, most_hz: None, program: FixedStepProgram::usual() }
}

/// m, m_b (kg), h_b (m), f (Hz), k_a (N/m) of a pier 12 m high, 4 m wide, damped by 2 % across and
/// along its column.
pub struct Numbers {
    pub mass: f64,
    pub footing: f64,
    pub centre: f64,
    pub hz: f64,
    pub axial: f64,
}

/// The pier of reference/flexible_pier.py with `--chord`: one element hinged at the mass, kb =
/// 3EI/L = (k + m g/L) L^2.
pub fn pier(numbers: &Numbers) -> Cantilever {
    let &Numbers { mass, footing, centre, hz, axial } = numbers;
    let (height, omega) = (12.0, TAU * hz);
    let length = height - 2.0 * centre;
    let bending = (mass * omega * omega + mass * GRAVITY / length) * length.powi(3) / 3.0;
    let section = BeamSection {
        axial: axial * length,
        bending,
        shear: f64::INFINITY,
        axial_damping: 2.0 * 0.02 * (axial * mass).sqrt() * length,
        bending_damping: 2.0 * 0.02 * mass * omega * length.powi(3) / 3.0,
        line_mass: 0.0,
    };
    Cantilever {
        mass,
        inertia: None,
        height,
        footing: Footing::block(4.0, footing, centre, 2.0 * centre),
        column: StraightMember { section, elements: 1 },
        consistent: false,
    }
}

pub const MODERATE: Numbers =
    Numbers { mass: 6e5, footing: 1.2e5, centre: 0.75, hz: 2.0, axial: 8e9 };

/// The pier of tuning/pier.toml, but that its column has no mass.
pub const PIER: PierSpec = PierSpec {
    height_m: 12.0,
    width_m: 4.0,
    mass_kg: 600e3,
    footing_mass_kg: 60e3,
    footing_height_m: 1.5,
    footing_inertia_kgm2: None,
    ea_n: None,
    ga_n: None,
    ei_nm2: None,
    frequency_hz: Some(2.0),
    damping_ratio: 0.02,
    axial_damping_ratio: None,
    column_mass_kg: 0.0,
    elements: None,
};

/// A structure as users write it.
pub fn structure(text: &str) -> ElasticStructure {
    toml::from_str::<ElasticStructure>(text).unwrap().checked().unwrap()
}

/// A portal of 8 m.
pub fn portal() -> ElasticStructure {
    structure(
        "kind = 'frame'\nheight_m = 8.0\nspan_m = 10.0\nfooting_width_m = 2.5\n\
         footing_height_m = 1.0\nfooting_mass_kg = 30e3\n\
         beam_mass_kg = 200e3\ncolumn_ea_n = 3e10\ncolumn_ei_nm2 = 4e9\nbeam_ea_n = 4e10\n\
         beam_ei_nm2 = 8e9\ndamping_ratio = 0.02\n",
    )
}

/// Springs scaled by what lands at each corner: K 0.05, C_u 0.60, mu_u 0.66; horizontally K 1, C 2,
/// mu 0.3 and `ratio` times the frequency (Hz).
pub fn springs(frame: &Frame, hz: f64, ratio: f64) -> Vec<Springs<Chain>> {
    let chain = |m: f64, hz: f64, k: f64, c: f64, mu: f64| {
        let omega = TAU * hz;
        let k1 = m * omega * omega;
        Chain { k1, k2: k * k1, m2: mu * m, c: c * m * omega }
    };
    (0..frame.places().len())
        .map(|i| {
            let [x, z] = frame.effective_mass(i);
            Springs {
                vertical: chain(z, hz, 0.05, 0.60, 0.66),
                horizontal: chain(x, ratio * hz, 1.0, 2.0, 0.3),
            }
        })
        .collect()
}

/// The first samples of El Centro (PEER I-ELC180, dt 0.01 s) (m/s2).
pub fn el_centro(samples: usize) -> Vec<f64> {
    Record::el_centro().accel[..samples].to_vec()
}

/// The NRMSE of histories that must have one length.
pub fn nrmse(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    rocking::motion::nrmse(a, b)
}

/// What a structure does on rigid ground, as far as it can be foretold.
pub fn on_rigid_ground(model: &Assembled, record: &Record) -> Reference {
    Reference::new(model, record, FORETOLD, MOST_WORK).unwrap()
}

/// The same on its springs, beside it.
pub fn answer(
    model: &Assembled,
    springs: &CornerSprings,
    record: &Record,
    reference: Reference,
) -> ElasticAnswer {
    ElasticAnswer::new(model, &springs.corners, record, reference, Some(MOST_WORK / 10)).unwrap()
}
