//! What every deck needs besides the parameters: legs, steps, tolerances, each with its rule.

use super::{Expected, ExportError, printable};
use crate::{
    fem::MASSLESS_ROTATION,
    members::{Legs, Members},
    parameters::Parameters,
    record::Record,
    spring::{Chain, Springs},
    structure::{Body, Structure},
};

/// Rotational inertia, as a share of m R^2, that a deck gives to a body that has none: OpenSees and SAP2000 cannot
/// solve for a rotation without inertia while both feet are in the air. Ten times more or less
/// changes 20 s of a 5 m frame by 2e-3 (NRMSE).
pub const SMALL_INERTIA: f64 = 1e-5;

/// Rotational inertia, as a share of m R^2, of a body that our model takes as massless in rotation, in an OpenSees deck: so
/// little that its vibration on the springs, of sqrt(m R^2/I_cg) Omega_n, dies in every step, the fine ones too. Where steps
/// resolve it, it goes on ringing and spoils the history; with 1e-8 Newton's iteration fails.
const QUICK_INERTIA: f64 = 1e-7;

/// Stiffness of the legs over the stiffest spring (k1 or k2, either direction). At 100 the history is off by 1e-2, from
/// 1e3 on by less than the integrator's own error.
const LEG_STIFFNESS: f64 = 1e4;

/// Mass of a foot on an elastic leg, over 3EI/L^3 dt^2, in an OpenSees deck. A foot that opens lets go what its leg was
/// bent by, at once if it has no mass; without a little mass Newton's iteration does not find where it goes, with ten times
/// more the foot goes on swinging, and what it keeps of the energy changes the history by 1e-2 and more.
const FOOT_MASS: f64 = 0.05;
/// Dashpot of such a foot, to the side, over 3EI/L^3 dt: the swing ends within a few steps.
const FOOT_DASHPOT: f64 = 4.0;

/// What OpenSees needs to carry massless legs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Regularised {
    /// Of a foot [kg].
    pub mass: f64,
    /// Of a foot, to the side [N s/m].
    pub dashpot: f64,
    /// I_cg: where our model takes the rotation as massless, as small as the feet's [kg m2].
    pub inertia: f64,
}

/// Time steps per period of the stiffest Omega_n (see [`steps_per_sample`]).
const STEPS_PER_PERIOD: f64 = 40.0;
/// p times the time step, at most: where events are followed in fine parts, and where they are not.
const STEP_BY_ROCKING: [f64; 2] = [2e-4, 1e-4];
/// Newton's displacement tolerance over R.
const TOLERANCE: f64 = 2e-11;

/// Parts of an OpenSees step in which a foot may touch or lift, or has just done so.
const FINE: usize = 16;
/// How long after a touch or a lift the steps stay fine, in units of 1/Omega_n: the releases of a lifting foot, one after
/// the other, are over in half that time.
const CALM: f64 = 2.0;

/// Time steps of OpenSees (TRBDF2) per sample of the record: dt = min( 1/(40 Omega_n [Hz]), 2e-4/p ), rounded so that
/// every sample is met. Steps in which a foot may touch or lift are taken in 16 parts: a foot lands, is anchored and lets go
/// up to one step late, an error of first order that is all there is to gain.
///
/// | 2 m block, 160 Hz, 5 s of El Centro | dt 3.7e-5 | 9.3e-6 | 1.6e-4 with fine parts |
/// |---|---|---|---|
/// | NRMSE of u against our own history | 2.4e-3 | 7.6e-4 | 2.7e-4 |
///
/// Elastic legs are followed without fine parts, at 1e-4/p: the mass that their feet need suits one step only.
pub fn steps_per_sample(parameters: &Parameters, dt: f64) -> usize {
    steps(parameters, dt, parameters.legs.is_none())
}

/// The same for a program that takes all its steps alike, or not.
pub(super) fn steps(parameters: &Parameters, dt: f64, watched: bool) -> usize {
    let body = parameters.structure.body::<f64>();
    let chains = parameters.chains();
    let omega = (chains.vertical.k1.max(chains.horizontal.k1) / body.mass).sqrt();
    let by_rocking = STEP_BY_ROCKING[usize::from(!watched)] / body.p_squared().sqrt();
    let most = (std::f64::consts::TAU / (STEPS_PER_PERIOD * omega)).min(by_rocking);
    // a hair less, so that a ratio that is whole but for rounding stays it
    ((dt / most - 1e-9).ceil() as usize).max(1)
}

/// The structure as decks hold it: a body without rotational inertia gets [`SMALL_INERTIA`]. Simulate this one to compare.
pub fn with_inertia(structure: &Structure) -> Structure {
    let body = structure.body::<f64>();
    let small = SMALL_INERTIA * body.mass * body.radius().powi(2);
    let given = structure.rotational_inertia_kgm2;
    Structure { rotational_inertia_kgm2: if given > 0.0 { given } else { small }, ..*structure }
}

/// A deck's numbers.
pub(super) struct Model<'a> {
    pub structure: Structure,
    /// I_cg as written [kg m2].
    pub inertia: f64,
    pub springs: Springs<Chain<f64>>,
    pub members: Members<f64>,
    /// EA/L and 3EI/L^3 of a leg that is all but rigid [N/m].
    pub leg: f64,
    /// EA and EI of the legs: given, or all but rigid.
    pub legs: Legs<f64>,
    /// Newton's displacement tolerance [m].
    pub tolerance: f64,
    pub steps_per_sample: usize,
    /// The same where events are not followed in fine parts.
    pub even_steps: usize,
    /// Parts of a step in which a foot may touch or lift.
    pub fine: usize,
    /// How long the steps stay fine after that [s].
    pub calm: f64,
    pub record: &'a Record,
    pub expected: Expected,
    /// The record's name, harmless in comments.
    pub record_name: String,
}

impl<'a> Model<'a> {
    pub fn new(parameters: &Parameters, record: &'a Record, expected: &Expected) -> Result<Self, ExportError> {
        let members = parameters.members();
        let structure = parameters.structure;
        let springs = parameters.chains();
        let Springs { vertical: v, horizontal: h } = springs;
        for (name, value, may_be_zero) in [
            ("structure.height_m", structure.height_m, false),
            ("structure.width_m", structure.width_m, false),
            ("structure.mass_kg", structure.mass_kg, false),
            ("structure.rotational_inertia_kgm2", structure.rotational_inertia_kgm2, true),
            ("vertical.k1_n_per_m", v.k1, false),
            ("vertical.k2_n_per_m", v.k2, false),
            ("vertical.m2_kg", v.m2, false),
            ("vertical.c_ns_per_m", v.c, true),
            ("horizontal.k1_n_per_m", h.k1, false),
            ("horizontal.k2_n_per_m", h.k2, false),
            ("horizontal.m2_kg", h.m2, false),
            ("horizontal.c_ns_per_m", h.c, true),
            ("legs.ea_n", members.legs.map_or(1.0, |l| l.ea), false),
            ("legs.ei_nm2", members.legs.map_or(1.0, |l| l.ei), false),
            ("damper.c_ns_per_m", members.damper.map_or(0.0, |d| d.c), true),
            ("tendon.stiffness_n_per_m", members.tendon.map_or(1.0, |t| t.stiffness), false),
            ("tendon.pretension_n", members.tendon.map_or(0.0, |t| t.pretension), true),
        ] {
            if !(value.is_finite() && (value > 0.0 || may_be_zero && value == 0.0)) {
                return Err(ExportError::Number { name, value });
            }
        }
        if expected.samples == 0 || expected.samples > record.len() {
            return Err(ExportError::Samples { expected: expected.samples, record: record.len() });
        }
        let leg = LEG_STIFFNESS * v.k1.max(v.k2).max(h.k1).max(h.k2);
        let length = structure.body::<f64>().radius();
        let rigid = Legs { ea: leg * length, ei: leg * length.powi(3) / 3.0 };
        Ok(Self {
            structure,
            inertia: with_inertia(&structure).rotational_inertia_kgm2,
            springs,
            members,
            leg,
            legs: members.legs.unwrap_or(rigid),
            tolerance: TOLERANCE * structure.body::<f64>().radius(),
            steps_per_sample: steps_per_sample(parameters, record.dt),
            even_steps: steps(parameters, record.dt, false),
            fine: if members.legs.is_none() { FINE } else { 1 },
            calm: CALM * (structure.mass_kg / v.k1.max(h.k1)).sqrt(),
            record,
            expected: *expected,
            record_name: printable(&record.name),
        })
    }

    pub fn body(&self) -> Body<f64> {
        self.structure.body()
    }

    /// p times the time step of OpenSees, at most.
    pub fn by_rocking(&self) -> f64 {
        STEP_BY_ROCKING[usize::from(self.fine == 1)]
    }

    /// Time of the last sample followed [s].
    pub fn duration(&self) -> f64 {
        (self.expected.samples - 1) as f64 * self.record.dt
    }

    pub fn inertia_note(&self) -> &'static str {
        if self.structure.rotational_inertia_kgm2 > 0.0 {
            "as given"
        } else {
            "1e-5 m R^2, small but not zero, else the rotation is undefined while both feet are in the air"
        }
    }

    /// How OpenSees holds legs that have no mass, where they are given; else zero.
    pub fn regularised(&self) -> Regularised {
        let radius = self.body().radius();
        let point_mass = self.structure.mass_kg * radius * radius;
        let massless = self.inertia < MASSLESS_ROTATION * point_mass;
        if self.members.legs.is_none() {
            let inertia = if massless { self.inertia.min(QUICK_INERTIA * point_mass) } else { self.inertia };
            return Regularised { mass: 0.0, dashpot: 0.0, inertia };
        }
        let dt = self.record.dt / self.steps_per_sample as f64;
        let bending = 3.0 * self.legs.ei / radius.powi(3);
        let mass = FOOT_MASS * bending * dt * dt;
        let inertia = if massless { mass * radius * radius } else { self.inertia };
        Regularised { mass, dashpot: FOOT_DASHPOT * bending * dt, inertia }
    }

    /// Length at which the tendon begins to pull [m]; zero without one.
    pub fn slack(&self) -> f64 {
        let length = self.structure.height_m + self.expected.settled;
        self.members.tendon.map_or(0.0, |t| length - t.pretension / t.stiffness)
    }

    pub fn leg_note(&self) -> String {
        if self.members.legs.is_some() {
            return "as given".to_string();
        }
        format!("{LEG_STIFFNESS:e} times the stiffest spring")
    }

    pub fn title(&self) -> String {
        format!(
            "Rocking body, h = {} m, 2b = {} m, m = {} kg, on tuned ground springs: {}",
            self.structure.height_m, self.structure.width_m, self.structure.mass_kg, self.record_name
        )
    }

    pub fn record_note(&self) -> String {
        format!(
            "{}: {} samples, dt {} s, peak {:.4} g; m/s2, positive to the right",
            self.record_name,
            self.record.len(),
            self.record.dt,
            self.record.pga_g()
        )
    }
}

/// 17 significant digits: reads back to the same number.
pub(super) fn digits(x: f64) -> String {
    format!("{x:.16e}")
}
