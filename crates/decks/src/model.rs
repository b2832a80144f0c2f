//! What every deck needs besides the parameters: stiff legs, steps, tolerances, each with its rule.

use super::{
    Expected, ExportError, beside::HousnerBeside, plain::NamedSprings, printable,
    stepping::EvenSteps,
};
use dynamics::{
    fem::MASSLESS_ROTATION,
    spring::{Chain, Springs},
};
use files::message::significant;
use parameters::Parameters;
use rocking::{
    members::Members,
    structure::{Body, Kind, Structure},
};
use strong_motion::Record;

/// Rotational inertia, as a share of m R^2, that a deck gives to a body that has none: OpenSees and
/// SAP2000 cannot solve for a rotation without inertia while both feet are in the air. Ten times
/// more or less changes 20 s of a 5 m frame by 2e-3 (NRMSE).
pub(crate) const SMALL_INERTIA: f64 = 1e-5;

/// The same at least of a body with dampers. Measured while they stayed at its corners in the air
/// (now [`DeckModel::damper_aloft`] is there): these stop a rotation of less inertia within a hop
/// that a landing makes, so that both feet leave the ground. With 1e-5 a deck of a frame of 28 m
/// and 1e6 N s/m had come to 16 of 20 s after 200 s of computing. Our own history takes so little
/// for none, which errs as it does: with 1e-3 by 0.01 on springs of 40 Hz under a tendon.
const DAMPED_INERTIA: f64 = 5e-4;

/// Stiffness of the legs that stand for a rigid body, over the stiffest gap spring k1, the same
/// along and across. OpenSees decks take their compliance off that of k1, so that both in series
/// are k1, however soft the legs; a leg a thousand times stiffer than k1 costs three digits of k1's
/// force, and on springs of 10 kHz Newton's iteration ends in its rounding.
pub(super) const LEG_STIFFNESS: f64 = 4.0;

/// What a history's error is to be, unless one asks otherwise.
pub const ACCURACY: f64 = 0.002;

/// Newton's displacement tolerance over R, of an elastic structure over its span: some twenty times
/// what rounding leaves of it with legs of [`LEG_STIFFNESS`].
pub(super) const TOLERANCE: f64 = 2e-14;

/// The accuracy asked is tightened with what a change of the width by 1e-5 does to the history
/// (from 6.7e-5 on), since the steps' error grows as that does; so many times at most: steps a
/// third as long.
const TIGHTER: f64 = 15_000.0;
const TIGHTEST: f64 = 8.0;
/// Rise of a foot that counts as a motion, over that at which the structure topples.
pub(super) const SMALL_MOTION: f64 = 0.01;
/// Steps per sample where steps follow from the accuracy: a pair, ended by every sample.
pub(super) const A_PAIR: usize = 2;

/// The structure as decks hold it: a body without rotational inertia gets `SMALL_INERTIA`, one with
/// dampers `DAMPED_INERTIA` at least. Simulate this one to compare.
pub fn with_inertia(structure: &Structure, members: &Members) -> Structure {
    let body = structure.body::<f64>();
    let share = |share: f64| share * body.mass * body.radius().powi(2);
    let given = structure.rotational_inertia_kgm2;
    let least = match members.damper {
        Some(_) => share(DAMPED_INERTIA),
        None if given > 0.0 => given,
        None => share(SMALL_INERTIA),
    };
    Structure { rotational_inertia_kgm2: given.max(least), ..*structure }
}

/// A deck's numbers.
pub(super) struct DeckModel<'a> {
    pub structure: Structure,
    /// I_cg as written (kg m2).
    pub inertia: f64,
    pub springs: Springs<Chain>,
    pub members: Members,
    /// EA/L and 3EI/L^3 of the legs that stand for the rigid body (N/m).
    pub leg: f64,
    /// Newton's displacement tolerance (m).
    pub tolerance: f64,
    /// Accuracy that the steps are to have.
    pub accuracy: f64,
    /// 1/Omega_n of the vertical k1 (s).
    pub landing: f64,
    /// Rise of a foot from which on its motion counts (m).
    pub rise: f64,
    /// Settings of steps of one size, in place of those that follow touches.
    pub even: Option<EvenSteps>,
    /// What Housner's equation finds, of a format that tells it.
    pub housner: Option<HousnerBeside>,
    pub record: &'a Record,
    pub expected: Expected,
    /// The record's name, harmless in comments.
    pub record_name: String,
}

impl<'a> DeckModel<'a> {
    pub(crate) fn new(
        parameters: &Parameters,
        record: &'a Record,
        expected: &Expected,
    ) -> Result<Self, ExportError> {
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
        let leg = LEG_STIFFNESS * v.k1.max(h.k1);
        let held = with_inertia(&structure, &members);
        let body = structure.body::<f64>();
        // of one whose end no steps help, too: they help what comes before
        let tighter = (TIGHTER * expected.width_sensitivity).clamp(1.0, TIGHTEST);
        let accuracy = expected.accuracy / tighter;
        Ok(Self {
            structure,
            inertia: held.rotational_inertia_kgm2,
            springs,
            members,
            leg,
            tolerance: TOLERANCE * body.radius(),
            accuracy,
            landing: (body.mass / v.k1).sqrt(),
            rise: SMALL_MOTION * 2.0 * body.half_width * (body.half_width / body.height).atan(),
            even: None,
            housner: None,
            record,
            expected: *expected,
            record_name: printable(&record.name),
        })
    }

    pub(crate) fn body(&self) -> Body<f64> {
        self.structure.body()
    }

    /// The feet and what is under them.
    pub(crate) fn places(&self) -> [NamedSprings; 2] {
        let body = self.body();
        let half = body.radius() * body.alpha().sin();
        [("left", -half), ("right", half)].map(|(foot, x)| (foot.to_string(), x, self.springs))
    }

    /// Time of the last sample followed (s).
    pub(crate) fn duration(&self) -> f64 {
        (self.expected.samples - 1) as f64 * self.record.dt
    }

    /// Time of the last sample compared (s).
    pub(crate) fn compared_s(&self) -> f64 {
        self.expected.compared.saturating_sub(1) as f64 * self.record.dt
    }

    /// c of the dashpot that holds the mass while both feet are in the air, in place of the two at
    /// the corners (N s/m): of a body whose rotation is taken to be massless, as our own history
    /// has it; else 0, and they stay.
    pub(crate) fn damper_aloft(&self) -> f64 {
        let body = self.body();
        let massless = self.inertia < MASSLESS_ROTATION * body.mass * body.radius().powi(2);
        self.members.damper.filter(|_| massless).map_or(0.0, |damper| 2.0 * damper.c)
    }

    pub(crate) fn inertia_note(&self) -> &'static str {
        let body = self.body();
        let damped = DAMPED_INERTIA * body.mass * body.radius().powi(2);
        if self.members.damper.is_some() && self.inertia <= damped * (1.0 + 1e-12) {
            "5e-4 m R^2, small but not zero, else the rotation is undefined while both feet are in \
                the air"
        } else if self.structure.rotational_inertia_kgm2 > 0.0 {
            "as given"
        } else {
            "1e-5 m R^2, small but not zero, else the rotation is undefined while both feet are in \
                the air"
        }
    }

    /// Length at which the tendon begins to pull (m); zero without one.
    pub(crate) fn slack(&self) -> f64 {
        let length = self.structure.height_m + self.expected.settled;
        self.members.tendon.map_or(0.0, |t| length - t.pretension / t.stiffness)
    }

    pub(crate) fn title(&self) -> String {
        let Structure { kind, height_m, width_m, mass_kg, .. } = self.structure;
        // to read: what was typed in inches has 16 digits
        let [h, total, width, mass] =
            [height_m, 2.0 * height_m, width_m, mass_kg].map(|x| significant(x, 6));
        let body = match kind {
            Kind::AFrame => format!("A-frame {h} m high, feet {width} m apart"),
            Kind::Block => {
                format!("Block {total} m high (centre of mass at {h} m), {width} m wide")
            }
        };
        format!("{body}, m = {mass} kg, on tuned ground springs: {}", self.record_name)
    }
}

/// 17 significant digits: reads back to the same number.
pub(super) fn digits(x: f64) -> String {
    format!("{x:.16e}")
}
