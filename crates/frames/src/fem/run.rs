//! The time loop: steps that end at every sample, and between samples at every touch and lift.

use std::f64::consts::FRAC_PI_2;

use super::{
    ElasticAnalysis, ElasticFinish,
    account::ElasticScales,
    events::{ContactLimit, ElasticEvent},
    history::ElasticRecorder,
    model::{CornerState, ElasticModel},
    most_steps,
    step::{ElasticRequest, ElasticStages, ElasticStepper},
};
use crate::frame::Base;
use dynamics::fem::{Control, Energy, HistoryOutcome, RESTART, Work, iterate::Ground};
use rocking::scalar::GRAVITY;

/// What a run shows.
pub(super) struct ElasticView<'a> {
    /// (s)
    pub time: f64,
    pub model: &'a ElasticModel<'a>,
    pub q: &'a [f64],
    pub v: &'a [f64],
    pub feet: &'a [CornerState],
    pub energy: &'a Energy,
}

/// A history in the making.
pub(super) struct SpringsRun<'a> {
    pub model: &'a ElasticModel<'a>,
    case: &'a ElasticAnalysis<'a>,
    pub control: Control,
    /// Steps that may be tried: as many as the control has it of a small structure, fewer of one
    /// whose steps cost more.
    most_steps: usize,
    pub stepper: ElasticStepper<'a>,
    bases: Vec<Base>,
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    pub feet: Vec<CornerState>,
    pub energy: Energy,
    /// Largest energy seen (J), the scale of the account.
    pub scale: f64,
    pub scales: ElasticScales,
    /// Compression of the stiffest k1 under the weight (m), the scale of contact; that of what is
    /// too small to matter without springs.
    pub compression: f64,
    /// 1/Omega_n of the stiffest vertical chain under what lands on it (s), the scale of time in
    /// contact.
    pub settling: f64,
    /// Step size that the energy account asked for (s).
    pub h: f64,
    pub rate: f64,
    /// Ground from now on.
    pub here: Ground,
    pub time: f64,
    /// Impulses of the corners over the step.
    pub impulses: Vec<[f64; 2]>,
    /// When each corner last opened (s).
    pub opened: Vec<f64>,
    pub work: Work,
}

impl<'a> SpringsRun<'a> {
    /// From a start whose energy is measured by that at rest (J).
    pub(crate) fn new(
        case: &'a ElasticAnalysis<'a>,
        model: &'a ElasticModel<'a>,
        start: (Vec<f64>, Vec<f64>, Vec<CornerState>),
        at_rest: f64,
    ) -> Self {
        let (q, v, feet) = start;
        let frame = model.frame;
        let scales = ElasticScales::of(frame);
        let weight = frame.total_mass() * GRAVITY;
        let vertical = || model.units.iter().map(|unit| unit.vertical.k1);
        let stiffest = vertical().fold(0.0, f64::max);
        // without springs: a ten-millionth of its length
        let compression = if stiffest > 0.0 { weight / stiffest } else { 1e-7 * scales.length };
        let settling = vertical()
            .enumerate()
            .map(|(i, k)| (frame.effective_mass(i)[1] / k).sqrt())
            .fold(f64::INFINITY, f64::min)
            .min((scales.length / GRAVITY).sqrt());
        let stored = model.energy(&q, &v, &feet);
        let scale =
            (stored - at_rest).abs().max(1e-3 * at_rest.abs()).max(1e-12 * weight * scales.length);
        let lengths = scales.lengths(model);
        let rounding = 8.0 * f64::EPSILON * scales.span * scales.span / scales.length;
        let corners = feet.len();
        Self {
            model,
            case,
            control: case.control,
            most_steps: most_steps(case.control, model.n),
            stepper: ElasticStepper::new(model, lengths, rounding),
            bases: Base::all(frame),
            q,
            v,
            feet,
            energy: Energy::new(stored),
            scale,
            scales,
            compression,
            settling,
            h: f64::INFINITY,
            rate: 1.0,
            here: Ground::still(),
            time: 0.0,
            impulses: vec![[0.0; 2]; corners],
            opened: vec![f64::NEG_INFINITY; corners],
            work: Work::default(),
        }
    }

    pub(crate) fn view(&self) -> ElasticView<'_> {
        let Self { time, model, q, v, feet, energy, .. } = self;
        ElasticView { time: *time, model, q, v, feet, energy }
    }

    /// Ground from sample i on.
    fn ground(&self, i: usize) -> Ground {
        let ElasticAnalysis { dt, accel, vertical, scale, .. } = *self.case;
        let at = |i: usize| [accel, vertical].map(|a| scale * a.get(i).copied().unwrap_or(0.0));
        let (now, next) = (at(i), at(i + 1));
        Ground { start: now, slope: [0, 1].map(|k| (next[k] - now[k]) / dt), curve: [0.0; 2] }
    }

    /// Follow the record to its end.
    pub(crate) fn follow(&mut self, recorder: &mut ElasticRecorder) -> HistoryOutcome {
        let (dt, samples) = (self.case.dt, self.case.accel.len());
        let mut stages = ElasticStages::new(self.model.size);
        recorder.sample(&self.view());
        for i in 0..samples.saturating_sub(1) {
            let (ground, start) = (self.ground(i), i as f64 * dt);
            let mut t = 0.0;
            while dt - t > 1e-13 * dt {
                (self.time, self.here) = (start + t, ground.from(t));
                if self.work.steps + self.work.rejected + self.work.events >= self.most_steps {
                    return HistoryOutcome::WorkBound { time: self.time };
                }
                if self.h < 1e-14 * dt {
                    return HistoryOutcome::Unstable { time: self.time };
                }
                t += self.advance(dt - t, &mut stages, recorder);
            }
            self.time = start + dt;
            recorder.sample(&self.view());
            if self
                .bases
                .iter()
                .any(|base| base.rotation(self.model.frame, &self.q).abs() > FRAC_PI_2)
            {
                return HistoryOutcome::Overturned { time: self.time };
            }
        }
        HistoryOutcome::Completed
    }

    /// Take a step, of at most `left`; by how much time has moved on: zero if it was refused.
    fn advance(
        &mut self,
        left: f64,
        stages: &mut ElasticStages,
        recorder: &mut ElasticRecorder,
    ) -> f64 {
        let h = self.next_size(left);
        if !self.attempt(h, stages) {
            self.refuse(0.25 * h, stages);
            return 0.0;
        }
        let mut met = self.met(stages);
        match met {
            ElasticEvent::Unresolved => {
                self.refuse(0.25 * h, stages);
                return 0.0;
            }
            ElasticEvent::AtOnce { corner, limit } => {
                self.switch(corner, limit, stages, recorder);
                return 0.0;
            }
            ElasticEvent::Crossing { corner, limit, tau } => {
                match self.locate((corner, limit), h, tau, stages) {
                    Some(true) => {}
                    Some(false) => met = ElasticEvent::Nothing,
                    None => {
                        self.refuse(0.5 * h * tau, stages);
                        return 0.0;
                    }
                }
            }
            ElasticEvent::Nothing => {}
        }
        if !self.account(stages) {
            self.work.rejected += 1;
            return 0.0;
        }
        self.time += stages.h;
        recorder.step(&self.view(), stages, &self.impulses);
        if let ElasticEvent::Crossing { corner, limit, .. } = met {
            self.switch(corner, limit, stages, recorder);
        }
        stages.h
    }

    /// Take a step of size h into `stages`; whether it converges.
    pub(crate) fn attempt(&mut self, h: f64, stages: &mut ElasticStages) -> bool {
        // a share of what presses the corners that the energy account would not notice
        let share = (1e3 * self.control.tolerance).clamp(1e-7, 1e-3);
        let tolerance = (share * self.compression).max(8.0 * f64::EPSILON * self.scales.span);
        let request = ElasticRequest { h, ground: self.here, tolerance, rate: self.rate };
        let converged = self.stepper.step([&self.q, &self.v], &self.feet, &request, stages);
        if converged {
            self.work.iterations += stages.iterations;
        }
        converged
    }

    /// Try again with size h (s).
    fn refuse(&mut self, h: f64, stages: &mut ElasticStages) {
        self.work.rejected += 1;
        self.rate = 1.0;
        self.h = h;
        self.forget(stages);
    }

    /// The accelerations tell nothing of the next step.
    fn forget(&self, stages: &mut ElasticStages) {
        stages.a.iter_mut().for_each(|a| a.fill(0.0));
    }

    /// What the account allows, never past the sample, and no sliver left over.
    fn next_size(&self, left: f64) -> f64 {
        if self.h >= 0.999 * left {
            left
        } else if self.h > 0.5 * left {
            0.5 * left
        } else {
            self.h
        }
    }

    /// A corner touches or lifts now.
    fn switch(
        &mut self,
        corner: usize,
        limit: ContactLimit,
        stages: &mut ElasticStages,
        recorder: &mut ElasticRecorder,
    ) {
        let closed = self.feet[corner].closed;
        self.feet[corner] = self.changed(corner, limit);
        let stored = self.model.energy(&self.q, &self.v, &self.feet);
        self.energy.released += self.energy.stored - stored;
        self.energy.stored = stored;
        self.forget(stages);
        self.rate = 1.0;
        self.h = self.h.min(RESTART * self.settling);
        self.work.events += 1;
        if self.feet[corner].closed != closed {
            recorder.contact(corner, &self.view());
        }
    }

    /// How it ended, and what it cost.
    pub(crate) fn finish(&self, outcome: HistoryOutcome) -> ElasticFinish {
        ElasticFinish { outcome, work: self.work, energy_scale: self.scale }
    }
}
