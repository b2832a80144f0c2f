//! What a step does to the energy account, and what it misses.

use super::TimeLoop;
use crate::fem::{
    acceptance::{TriedStep, allowed_energy, cautious},
    model::{Model, State, TH, X, Z},
    step::Stages,
};
use rocking::scalar::GRAVITY;

/// What a step does, measured.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepMeasures {
    /// Energy stored at its end (J).
    pub stored: f64,
    /// Work of the base excitation and dissipation over it (J).
    pub input: f64,
    pub dissipated: f64,
    /// Its local error by the embedded formula: of the body's place over R alpha, and of its
    /// momentum over m p R alpha.
    pub missed: f64,
    pub contacts: Contacts,
}

/// What is known of the feet's contacts over a step.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Contacts {
    Unknown,
    /// They stay what they are.
    Unchanged,
    /// The compressions of both feet's gaps at the step's start and stages (m).
    Gaps([[f64; 4]; 2]),
}

/// The scales of a local error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scales {
    pub radius: f64,
    /// The rotation's share of a momentum; none without inertia.
    pub share: f64,
    /// 1/p (s), the time in which an error of the rate becomes one of the lean.
    pub moment: f64,
    /// Lean of balance (rad).
    pub alpha: f64,
}

impl Scales {
    pub(crate) fn of(model: &Model) -> Self {
        let body = &model.body;
        let radius = body.radius();
        let share = model.rotation / (body.mass * radius * radius);
        let moment = body.p().recip();
        Self { radius, share: share.min(1.0), moment, alpha: body.alpha() }
    }

    /// Of what a step misses.
    #[inline(always)]
    pub(crate) fn missed(&self, State { q, v }: &State) -> f64 {
        let place = q[X].abs().max(q[Z].abs()).max(q[TH].abs() * self.radius);
        let speed = v[X].abs().max(v[Z].abs()).max(v[TH].abs() * self.radius * self.share);
        place.max(speed * self.moment) / (self.radius * self.alpha)
    }
}

impl TimeLoop<'_> {
    /// What a step does to the account, and what it misses.
    pub(super) fn measure(&self, stages: &Stages) -> StepMeasures {
        let stored = self.model.energy(&stages.end(), &self.feet);
        let (input, dissipated) = stages.work(self.model, &self.feet, &self.here);
        let local = self.stepper.local_error(&self.state, &self.feet, &self.here, stages);
        StepMeasures {
            stored,
            input,
            dissipated,
            missed: self.scales.missed(&local),
            contacts: Contacts::Unknown,
        }
    }

    /// Book the step if the account closes well enough and little is missed; choose the next step's
    /// size.
    pub(super) fn account(&mut self, stages: &Stages, measures: &StepMeasures) -> bool {
        let &StepMeasures { stored, input, dissipated, missed, .. } = measures;
        let defect = (stored - self.energy.stored - input + dissipated).abs();
        let h = stages.h;
        let tried = TriedStep { h, planned: self.h, settling: self.settling };
        let allowed = [self.allowed(stored, stages), self.allowed_error(h)];
        if !tried.holds([defect, missed], allowed, (&mut self.h, &mut self.work)) {
            return false;
        }
        self.state = stages.end();
        self.energy.book(stored, input, dissipated);
        if !self.model.elements.is_empty() {
            self.energy.by_members += stages.taken_by_members(self.model, &self.feet);
        }
        self.scale = self.energy.largest(self.scale);
        self.guess = stages.a[2];
        self.rate = cautious(stages.rate);
        true
    }

    /// What that error may be; never less than rounding makes of it.
    fn allowed_error(&self, h: f64) -> f64 {
        let rounding = self.rounding * (1.0 + self.scales.moment / h)
            / (self.scales.alpha * self.model.body.half_width);
        self.error.max(rounding)
    }

    /// Energy that this step may lose or gain (J).
    fn allowed(&self, stored: f64, stages: &Stages) -> f64 {
        allowed_energy(self.control.tolerance * self.scale, &self.energy, stored)
            .max(self.places(stages))
    }

    /// Energy that comes and goes as places are rounded (J): a few units in their last digit times
    /// the force. On stiff springs under a body far from where it stood, a smaller step does not
    /// lose less.
    fn places(&self, stages: &Stages) -> f64 {
        let (q, a) = (&stages.q[2], &stages.a[2]);
        let place = q[X].abs() + q[Z].abs() + q[TH].abs() * self.model.body.radius();
        let force = self.model.translation * (a[X].abs() + a[Z].abs() + GRAVITY);
        4.0 * f64::EPSILON * place * force
    }
}
