//! A motion and the reference's answer to it: what springs of an elastic structure are judged on.

use super::design::CornerSprings;
use dynamics::{
    effort::Effort,
    fem::Control,
    spring::{Chain, Springs},
};
use frames::{
    answer::Reference,
    assembled::{Assembled, Sway, errors},
    design_forces::{ColumnForces, stiffer},
    fem::{ElasticAnalysis, ElasticHistory, ElasticStart},
    peaks::{StructurePeakErrors, StructurePeaks},
    reference::{ElasticRocking, GroundAcceleration, ReferenceOutcome, Stop, TRIED, step_units},
};
use strong_motion::Record;

/// A history is compared if its predictable part is this share of it, or has so many landings.
const LEAST_SHARE: f64 = 0.2;
const LEAST_LANDINGS: usize = 3;
/// A motion is followed over this part of it, then over twice as much, until it can be foretold no
/// further.
const PARTS: usize = 4;

/// A motion, a start, and the reference's history.
#[derive(Clone, Debug)]
pub struct ElasticTrial {
    /// Time step (s).
    pub dt: f64,
    /// Ground acceleration over the part that can be foretold (m/s2).
    pub accel: Vec<f64>,
    /// The vertical part, upwards; empty if there is none.
    pub vertical: Vec<f64>,
    /// Lean from which it is released (rad); none if it starts standing.
    pub lean: Option<f64>,
    /// The reference over that part.
    pub reference: Vec<Sway>,
    /// Its peaks.
    pub peaks: StructurePeaks,
    /// Landings of the reference in it.
    pub landings: usize,
}

/// A history on springs beside the reference.
#[derive(Clone, Copy, Debug)]
pub struct Judged {
    /// NRMSE of rotations, of sways.
    pub errors: [f64; 2],
    /// Of peaks.
    pub peaks: StructurePeakErrors,
    /// Touches of corners over the reference's part.
    pub touches: usize,
}

impl Judged {
    /// Of a history that was not followed.
    pub(crate) const LOST: Self =
        Self { errors: [f64::INFINITY; 2], peaks: StructurePeakErrors::LOST, touches: 0 };
}

/// What a motion comes to.
#[derive(Clone, Debug)]
pub enum ElasticTrialOutcome {
    /// A history to compare with.
    ReferenceMotion(ElasticTrial),
    /// It does not lift the structure, or overturns it, or cannot be followed.
    Unfit,
    /// Its reference met the bound on its work.
    OutOfWork,
    /// Its reference cannot be predicted for long enough.
    IllConditioned,
}

/// A history of the reference may take one in so many of all units.
const TRIALS: u64 = 90;
/// Histories computed for one trial: the reference and two perturbed ones.
const TOLD_BY: u64 = 3;

fn count(history: &ElasticRocking, effort: &Effort) {
    let coordinates = history.q.first().map_or(0, |q| q.len());
    effort.spend(TOLD_BY * history.tried as u64 * step_units(coordinates));
}

fn out_of_work(history: &ElasticRocking) -> bool {
    matches!(history.outcome, ReferenceOutcome::Stopped { why: Stop::Work | Stop::Events, .. })
}

impl ElasticTrialOutcome {
    /// The trial, if it is one.
    pub fn trial(self) -> Option<ElasticTrial> {
        if let Self::ReferenceMotion(trial) = self { Some(trial) } else { None }
    }
}

impl ElasticTrial {
    /// Let go from a lean, its work counted.
    pub fn released(
        model: &Assembled,
        lean: f64,
        (dt, duration): (f64, f64),
        effort: &Effort,
    ) -> ElasticTrialOutcome {
        let still = vec![0.0; (duration / dt).ceil() as usize + 1];
        let Some(q) = model.leaning(lean) else { return ElasticTrialOutcome::Unfit };
        let ground = GroundAcceleration::horizontal(dt, &still);
        let history = model.rock(ground, &q, effort.part(TRIALS));
        count(&history, effort);
        let foretold = || model.foretold(ground, &q, &history, TRIED);
        Self::found(model, ground, Some(lean), &history, foretold)
    }

    /// From rest through a record, its work counted; unfit once it is stopped from outside.
    pub fn shaken(model: &Assembled, record: &Record, effort: &Effort) -> ElasticTrialOutcome {
        let Ok(q) = model.upright() else { return ElasticTrialOutcome::Unfit };
        let whole = GroundAcceleration::of(record);
        let mut samples = record.len().div_ceil(PARTS);
        let mut shorter: Option<(usize, ElasticRocking, usize)> = None;
        loop {
            let ground = whole.first(samples);
            if effort.stopped() {
                return ElasticTrialOutcome::Unfit;
            }
            let history = model.rock(ground, &q, effort.part(TRIALS));
            count(&history, effort);
            if out_of_work(&history) {
                // the part before is there
                let before = shorter.map(|(samples, history, foretold)| {
                    Self::found(model, whole.first(samples), None, &history, || foretold)
                });
                let before =
                    before.filter(|found| matches!(found, ElasticTrialOutcome::ReferenceMotion(_)));
                return before.unwrap_or(ElasticTrialOutcome::OutOfWork);
            }
            let foretold = model.foretold(ground, &q, &history, TRIED);
            // what comes after it need not be known
            if foretold < samples && history.landings().next().is_some() || samples == record.len()
            {
                return Self::found(model, ground, None, &history, || foretold);
            }
            shorter = Some((samples, history, foretold));
            samples = (2 * samples).min(record.len());
        }
    }

    /// The same beside a reference that is known.
    pub(crate) fn beside(
        model: &Assembled,
        record: &Record,
        reference: &Reference,
    ) -> ElasticTrialOutcome {
        let ground = GroundAcceleration::of(record);
        Self::found(model, ground, None, &reference.history, || reference.followed)
    }

    fn found(
        model: &Assembled,
        GroundAcceleration { dt, accel, vertical }: GroundAcceleration,
        lean: Option<f64>,
        history: &ElasticRocking,
        foretold: impl FnOnce() -> usize,
    ) -> ElasticTrialOutcome {
        if out_of_work(history) {
            return ElasticTrialOutcome::OutOfWork;
        }
        if history.outcome != ReferenceOutcome::Completed || history.landings().next().is_none() {
            return ElasticTrialOutcome::Unfit;
        }
        let samples = foretold().min(accel.len());
        let end = samples.saturating_sub(1) as f64 * dt;
        let landings = history.landings().take_while(|event| event.time <= end).count();
        let long = samples as f64 >= LEAST_SHARE * accel.len() as f64;
        if landings == 0 || !long && landings < LEAST_LANDINGS {
            return ElasticTrialOutcome::IllConditioned;
        }
        let reference = model.sways(history.q[..samples].iter().map(|q| q.as_slice()));
        let peaks = StructurePeaks::of(model, history.q[..samples].iter().map(|q| q.as_slice()));
        let vertical = vertical[..samples.min(vertical.len())].to_vec();
        ElasticTrialOutcome::ReferenceMotion(Self {
            dt,
            accel: accel[..samples].to_vec(),
            vertical,
            lean,
            reference,
            peaks,
            landings,
        })
    }

    /// The finite elements' history on springs, as far as it got; its forces finely sampled in so
    /// many parts to a time step.
    pub fn follow(
        &self,
        model: &Assembled,
        springs: &[Springs<Chain>],
        control: Control,
        parts: usize,
    ) -> Option<ElasticHistory> {
        let start = self.lean.map_or(ElasticStart::Standing, ElasticStart::Leaning);
        let vertical = &self.vertical;
        let case = ElasticAnalysis {
            control,
            vertical,
            forces: false,
            parts,
            ..ElasticAnalysis::new(&model.frame, springs, start, self.dt, &self.accel)
        };
        case.simulate().ok()
    }

    /// The errors on springs; infinite where their history does not get as far as the reference.
    /// Those of forces, if asked for, beside springs at 4 Omega_n. Its work is counted.
    pub fn judge(
        &self,
        model: &Assembled,
        springs: &CornerSprings,
        forces: Option<&ColumnForces>,
        (control, effort): (Control, &Effort),
    ) -> Judged {
        let lost = forces.map(|_| f64::INFINITY);
        let parts = forces.map_or(0, |forces| forces.parts(self.dt));
        let Some(history) = self.follow(model, &springs.corners, control, parts) else {
            let peaks = StructurePeakErrors { design_forces: lost, ..StructurePeakErrors::LOST };
            return Judged { errors: [f64::INFINITY; 2], peaks, touches: 0 };
        };
        history.spend(effort);
        let touches = history.contacts.iter().filter(|contact| contact.touches).count();
        let sways = model.sways(history.q.iter().map(Vec::as_slice));
        let errors = errors(&self.reference, &sways, self.accel.len());
        let design_forces = || {
            let forces = forces?;
            let other = self.follow(model, &stiffer(&springs.corners), control, parts);
            other.iter().for_each(|other| other.spend(effort));
            match other.filter(|other| other.q.len() == history.q.len()) {
                Some(other) => forces.peaks(&history).error(&forces.peaks(&other)),
                None => lost,
            }
        };
        let peaks = if errors.iter().all(|error| error.is_finite()) {
            let peaks =
                StructurePeaks::of(model, history.q.iter().map(Vec::as_slice)).beside(&self.peaks);
            StructurePeakErrors { design_forces: design_forces(), ..peaks }
        } else {
            StructurePeakErrors { design_forces: lost, ..StructurePeakErrors::LOST }
        };
        Judged { errors, peaks, touches }
    }
}
