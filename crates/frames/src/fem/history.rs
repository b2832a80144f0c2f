//! What a run leaves behind.

use super::{
    ElasticFinish,
    demands::FrameDemand,
    filter::low_pass,
    run::ElasticView,
    series::{FineForces, FineRecorder},
    step::ElasticStages,
    step_units,
};
use crate::frame::{Base, Frame};
use dynamics::{
    effort::Effort,
    fem::{Account, HistoryOutcome, Work},
};

/// A touch or a lift of a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactChange {
    /// (s)
    pub time: f64,
    /// Counted from the left.
    pub corner: usize,
    /// Whether it touches: it lifts otherwise.
    pub touches: bool,
    /// Velocity of the corner (x, z) (m/s).
    pub speed: [f64; 2],
}

/// Force of the ground on a corner, or on all of them together, horizontally and vertically, sample
/// by sample (N).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundForces {
    /// At the sample.
    pub at: Vec<[f64; 2]>,
    /// The largest magnitudes since the sample before: an impact is over long before the next
    /// sample.
    pub peak: Vec<[f64; 2]>,
    /// The mean since the sample before, that is impulse over time: what impacts leave of
    /// themselves.
    pub mean: Vec<[f64; 2]>,
}

impl GroundForces {
    /// Forces in one direction (0: horizontal, 1: vertical) without the spikes of landings (N):
    /// means between samples dt apart, low-pass filtered at this frequency (Hz); the means
    /// themselves where the samples are too far apart to have it ([`low_pass`]).
    pub fn filtered(&self, direction: usize, dt: f64, frequency: f64) -> Vec<f64> {
        let means: Vec<f64> = self.mean.iter().map(|force| force[direction]).collect();
        low_pass(&means, dt, frequency)
    }

    /// Note a sample's force; what was found since the sample before begins anew.
    fn push(&mut self, at: [f64; 2], since: &mut Since, dt: f64) {
        let Since { impulse, largest } = std::mem::take(since);
        self.mean.push(if self.at.is_empty() { at } else { impulse.map(|j| j / dt) });
        self.peak.push(largest);
        self.at.push(at);
    }
}

/// Impulse (N s) and largest force (N) since the last sample.
#[derive(Clone, Copy, Debug, Default)]
struct Since {
    impulse: [f64; 2],
    largest: [f64; 2],
}

impl Since {
    fn force(&mut self, force: [f64; 2]) {
        for (largest, force) in self.largest.iter_mut().zip(force) {
            if force.abs() > largest.abs() {
                *largest = force;
            }
        }
    }

    fn add(&mut self, impulse: [f64; 2]) {
        self.impulse = [self.impulse[0] + impulse[0], self.impulse[1] + impulse[1]];
    }
}

/// A whole history.
#[derive(Clone, Debug)]
pub struct ElasticHistory {
    /// Time between samples (s).
    pub dt: f64,
    /// The frame's coordinates at every sample (m, rad).
    pub q: Vec<Vec<f64>>,
    /// Their velocities.
    pub v: Vec<Vec<f64>>,
    /// At every corner; empty, as all forces are, of a history that keeps none.
    pub forces: Vec<GroundForces>,
    /// On all corners together: the largest is that of one instant.
    pub ground: GroundForces,
    /// What the structure bears at every sample.
    pub demands: Vec<FrameDemand>,
    /// Of each value, the largest magnitude since the sample before.
    pub worst: Vec<FrameDemand>,
    /// Forces finely sampled, of a history that keeps them.
    pub fine: Option<FineForces>,
    /// Touches and lifts.
    pub contacts: Vec<ContactChange>,
    /// Of energy.
    pub account: Account,
    /// How it ended.
    pub outcome: HistoryOutcome,
    /// What it cost.
    pub work: Work,
    /// Largest |residual| over the largest energy of the history.
    pub energy_residual: f64,
    /// Largest energy of the history (J).
    pub energy_scale: f64,
}

impl ElasticHistory {
    /// Count what it cost, and whether it met its own bound.
    pub fn spend(&self, effort: &Effort) {
        let tried = (self.work.steps + self.work.rejected + self.work.events) as u64;
        let coordinates = self.q.first().map_or(0, Vec::len);
        effort.spend(tried * step_units(coordinates));
        effort.judged(matches!(self.outcome, HistoryOutcome::WorkBound { .. }));
    }

    /// Rotation of a base at every sample (rad).
    pub fn rotation(&self, frame: &Frame, base: Base) -> Vec<f64> {
        self.q.iter().map(|q| base.rotation(frame, q)).collect()
    }

    /// A node's displacement relative to what rotates rigidly with a base, in its axes: across (m).
    pub fn drift(&self, frame: &Frame, node: usize, base: Base) -> Vec<f64> {
        self.q.iter().map(|q| base.drift(frame, node, q)[0]).collect()
    }

    /// Height of a corner above the ground (m).
    pub fn uplift(&self, frame: &Frame, corner: usize) -> Vec<f64> {
        self.q.iter().map(|q| frame.places()[corner].reach(q).place[1]).collect()
    }

    /// Number of touches of a corner.
    pub fn touches(&self, corner: usize) -> usize {
        self.contacts.iter().filter(|contact| contact.touches && contact.corner == corner).count()
    }
}

/// Keeps everything, or all but forces.
pub(super) struct ElasticRecorder {
    history: ElasticHistory,
    forces: Option<ElasticForces>,
    fine: Option<FineRecorder>,
    residual: f64,
}

/// Forces since the last sample.
struct ElasticForces {
    corners: Vec<Since>,
    ground: Since,
    now: FrameDemand,
    worst: FrameDemand,
}

impl ElasticForces {
    fn new(frame: &Frame) -> Self {
        let corners = vec![Since::default(); frame.places().len()];
        Self {
            corners,
            ground: Since::default(),
            now: FrameDemand::new(frame),
            worst: FrameDemand::new(frame),
        }
    }

    fn look(&mut self, view: &ElasticView) {
        let n = view.model.n;
        self.now.take(view.model.frame, &view.q[..n], &view.v[..n]);
        self.worst.enlarge(&self.now);
        let mut sum = [0.0; 2];
        for (i, corner) in self.corners.iter_mut().enumerate() {
            let force = view.model.contact(i, &view.feet[i], view.q, view.v);
            corner.force(force);
            sum = [sum[0] + force[0], sum[1] + force[1]];
        }
        self.ground.force(sum);
    }

    fn step(&mut self, impulses: &[[f64; 2]]) {
        for (corner, &impulse) in self.corners.iter_mut().zip(impulses) {
            corner.add(impulse);
            self.ground.add(impulse);
        }
    }

    fn sample(&mut self, view: &ElasticView, history: &mut ElasticHistory) {
        let mut sum = [0.0; 2];
        for (i, (since, forces)) in self.corners.iter_mut().zip(&mut history.forces).enumerate() {
            let force = view.model.contact(i, &view.feet[i], view.q, view.v);
            forces.push(force, since, history.dt);
            sum = [sum[0] + force[0], sum[1] + force[1]];
        }
        history.ground.push(sum, &mut self.ground, history.dt);
        history.demands.push(self.now.clone());
        history.worst.push(std::mem::replace(&mut self.worst, self.now.clone()));
    }
}

impl ElasticRecorder {
    /// Of a history of so many samples, with forces or without, finely sampled in so many parts to
    /// a time step or not.
    pub(crate) fn new(
        frame: &Frame,
        (dt, samples): (f64, usize),
        forces: bool,
        parts: usize,
    ) -> Self {
        let room = || Vec::with_capacity(samples);
        let corners = if forces { frame.places().len() } else { 0 };
        Self {
            history: ElasticHistory {
                dt,
                q: Vec::with_capacity(samples),
                v: Vec::with_capacity(samples),
                forces: vec![GroundForces::default(); corners],
                ground: GroundForces::default(),
                demands: Vec::new(),
                worst: Vec::new(),
                fine: None,
                contacts: Vec::new(),
                account: Account {
                    input: room(),
                    stored: room(),
                    dissipated: room(),
                    residual: room(),
                },
                outcome: HistoryOutcome::Completed,
                work: Work::default(),
                energy_residual: 0.0,
                energy_scale: 0.0,
            },
            forces: forces.then(|| ElasticForces::new(frame)),
            fine: (parts > 0).then(|| FineRecorder::new(frame, dt, samples, parts)),
            residual: 0.0,
        }
    }

    /// At a sample.
    pub(crate) fn sample(&mut self, view: &ElasticView) {
        let n = view.model.n;
        let history = &mut self.history;
        if let Some(forces) = &mut self.forces {
            forces.look(view);
            forces.sample(view, history);
        }
        if let Some(fine) = &mut self.fine {
            fine.begin(view);
        }
        history.q.push(view.q[..n].to_vec());
        history.v.push(view.v[..n].to_vec());
        history.account.push(view.energy);
        self.residual = self.residual.max(view.energy.residual().abs());
    }

    /// After a step, with its impulses.
    pub(crate) fn step(
        &mut self,
        view: &ElasticView,
        stages: &ElasticStages,
        impulses: &[[f64; 2]],
    ) {
        if let Some(fine) = &mut self.fine {
            fine.step(view, stages);
        }
        if let Some(forces) = &mut self.forces {
            forces.step(impulses);
            forces.look(view);
        }
    }

    /// After a corner's contact has changed.
    pub(crate) fn contact(&mut self, corner: usize, view: &ElasticView) {
        let place = &view.model.frame.places()[corner];
        let speed = place.velocity(&place.reach(view.q), view.v);
        let touches = view.feet[corner].closed;
        self.history.contacts.push(ContactChange { time: view.time, corner, touches, speed });
    }

    /// The history, once the run is over.
    pub(crate) fn finish(self, finish: ElasticFinish) -> ElasticHistory {
        let end = self.history.q.len().saturating_sub(1) as f64 * self.history.dt;
        ElasticHistory {
            fine: self.fine.map(|fine| fine.finish(end)),
            outcome: finish.outcome,
            work: finish.work,
            energy_residual: self.residual / finish.energy_scale,
            energy_scale: finish.energy_scale,
            ..self.history
        }
    }
}
