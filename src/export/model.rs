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
/// little that its vibration on the springs, of sqrt(m R^2/I_cg) Omega_n, dies in every step, the shortest too. Where steps
/// resolve it, it goes on ringing and spoils the history: with 1e-5 a 5 m frame is off by 0.2 after 3 s. What rocking feels of
/// it is in the mass of the translation ([`Regularised::moved`]).
const QUICK_INERTIA: f64 = 1e-11;

/// Stiffness of the legs over the stiffest spring (k1 or k2, either direction), the same along and across; the stiffer, the
/// more digits get lost. OpenSees decks take their compliance off that of k1, so that both in series are k1.
const LEG_STIFFNESS: f64 = 1e3;

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
    /// Mass of the translation: there with I_cg/R^2 added, as in our model [kg].
    pub moved: f64,
}

/// Time steps per period of the stiffest Omega_n (see [`steps_per_sample`]).
const STEPS_PER_PERIOD: f64 = 40.0;
/// p times the time step, at most: where steps get shorter towards touches and lifts, and where they do not.
const STEP_BY_ROCKING: [f64; 2] = [2e-4, 1e-4];
/// Newton's displacement tolerance over R.
const TOLERANCE: f64 = 2e-11;

/// Length of the shortest step, where a foot touches or lifts, over that of the longest.
const SHORTEST: f64 = 1.0 / 256.0;

/// Steps get finer with the root of what a change of the width by 1e-5 does to the history (from 1.3e-3 on), since their
/// error is of second order; so many times at most.
const FINER: f64 = 750.0;
const FINEST: f64 = 16.0;

/// Time steps of OpenSees (TRBDF2) per sample of the record: dt = min( 1/(40 Omega_n [Hz]), 2e-4/p ), rounded so that
/// every sample is met; up to 16 times finer where a hair of width moves the history, by `hair` (NRMSE of u per relative
/// change of the width by 1e-5). Around touches and lifts the deck itself takes shorter ones.
///
/// | 160 Hz, 20 s of El Centro | `hair` | finer | NRMSE of u against our own history |
/// |---|---|---|---|
/// | 61 m frame | 1.5e-5 | 1 | 2.8e-5 |
/// | 2 m block | 0.059 | 7 | 7.8e-4 |
/// | 5 m frame | 0.20 | 13 (8) | 1.3e-3 (4.6e-3) |
///
/// Elastic legs are followed in even steps, 1e-4/p: the mass that their feet need suits one step only.
pub fn steps_per_sample(parameters: &Parameters, dt: f64, hair: f64) -> usize {
    let even = parameters.legs.is_some();
    let finer = if even { 1.0 } else { (FINER * hair).sqrt().ceil().clamp(1.0, FINEST) };
    steps(parameters, dt, even) * finer as usize
}

/// For a program that takes all its steps alike, or not.
fn steps(parameters: &Parameters, dt: f64, even: bool) -> usize {
    let body = parameters.structure.body::<f64>();
    let chains = parameters.chains();
    let omega = (chains.vertical.k1.max(chains.horizontal.k1) / body.mass).sqrt();
    let by_rocking = STEP_BY_ROCKING[usize::from(even)] / body.p_squared().sqrt();
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
    /// The same for a program that takes all its steps alike.
    pub even_steps: usize,
    /// Length of the shortest step, where a foot touches or lifts, over that of the longest.
    pub shortest: f64,
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
            steps_per_sample: steps_per_sample(parameters, record.dt, expected.hair),
            even_steps: steps(parameters, record.dt, true),
            shortest: if members.legs.is_none() { SHORTEST } else { 1.0 },
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
        STEP_BY_ROCKING[usize::from(self.members.legs.is_some())]
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
        let moved = self.structure.mass_kg + if massless { self.inertia / (radius * radius) } else { 0.0 };
        if self.members.legs.is_none() {
            let inertia = if massless { self.inertia.min(QUICK_INERTIA * point_mass) } else { self.inertia };
            return Regularised { mass: 0.0, dashpot: 0.0, inertia, moved };
        }
        let dt = self.record.dt / self.steps_per_sample as f64;
        let bending = 3.0 * self.legs.ei / radius.powi(3);
        let mass = FOOT_MASS * bending * dt * dt;
        let inertia = if massless { mass * radius * radius } else { self.inertia };
        Regularised { mass, dashpot: FOOT_DASHPOT * bending * dt, inertia, moved }
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
