//! What a run leaves behind.

use super::{Finish, demands::Demand, filter::low_pass, run::View};
use crate::{
    elastic::frame::{Base, Frame},
    fem::{Account, HistoryOutcome, Work},
};

/// A touch or a lift of a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// (s)
    pub time: f64,
    /// Counted from the left.
    pub corner: usize,
    /// Whether it touches: it lifts otherwise.
    pub touches: bool,
    /// Velocity of the corner (x, z) (m/s).
    pub speed: [f64; 2],
}

/// Force of the ground on a corner, horizontally and vertically, sample by sample (N).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CornerForces {
    /// At the sample.
    pub at: Vec<[f64; 2]>,
    /// The largest magnitudes since the sample before: an impact is over long before the next sample.
    pub peak: Vec<[f64; 2]>,
    /// The mean since the sample before, that is impulse over time: what impacts leave of themselves.
    pub mean: Vec<[f64; 2]>,
}

impl CornerForces {
    /// Vertical forces without the spikes of landings (N): means between samples dt apart, low-pass filtered at this frequency (Hz).
    pub fn filtered(&self, direction: usize, dt: f64, frequency: f64) -> Vec<f64> {
        let means: Vec<f64> = self.mean.iter().map(|force| force[direction]).collect();
        low_pass(&means, dt, frequency)
    }
}

/// A whole history.
#[derive(Clone, Debug)]
pub struct History {
    /// Time between samples (s).
    pub dt: f64,
    /// The frame's coordinates at every sample (m, rad).
    pub q: Vec<Vec<f64>>,
    /// Their velocities.
    pub v: Vec<Vec<f64>>,
    /// At every corner.
    pub forces: Vec<CornerForces>,
    /// What the structure bears at every sample.
    pub demands: Vec<Demand>,
    /// Of each value, the largest magnitude since the sample before.
    pub worst: Vec<Demand>,
    /// Touches and lifts.
    pub contacts: Vec<Contact>,
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

impl History {
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

/// Keeps everything.
pub(super) struct Recorder {
    history: History,
    /// Impulse of every corner since the last sample [N s], and largest forces [N].
    impulses: Vec<[f64; 2]>,
    largest: Vec<[f64; 2]>,
    now: Demand,
    worst: Demand,
    residual: f64,
    begun: bool,
}

impl Recorder {
    pub fn new(frame: &Frame, dt: f64, samples: usize) -> Self {
        let corners = frame.places().len();
        let room = || Vec::with_capacity(samples);
        Self {
            history: History {
                dt,
                q: Vec::with_capacity(samples),
                v: Vec::with_capacity(samples),
                forces: vec![CornerForces::default(); corners],
                demands: Vec::with_capacity(samples),
                worst: Vec::with_capacity(samples),
                contacts: Vec::new(),
                account: Account { input: room(), stored: room(), dissipated: room(), residual: room() },
                outcome: HistoryOutcome::Completed,
                work: Work::default(),
                energy_residual: 0.0,
                energy_scale: 0.0,
            },
            impulses: vec![[0.0; 2]; corners],
            largest: vec![[0.0; 2]; corners],
            now: Demand::new(frame),
            worst: Demand::new(frame),
            residual: 0.0,
            begun: false,
        }
    }

    /// At a sample.
    pub fn sample(&mut self, view: &View) {
        let n = view.model.n;
        self.look(view);
        let history = &mut self.history;
        for (i, forces) in history.forces.iter_mut().enumerate() {
            let force = view.model.contact(i, &view.feet[i], view.q);
            forces.at.push(force);
            forces.peak.push(std::mem::take(&mut self.largest[i]));
            let impulse = std::mem::take(&mut self.impulses[i]);
            forces.mean.push(if self.begun { impulse.map(|j| j / history.dt) } else { force });
        }
        history.q.push(view.q[..n].to_vec());
        history.v.push(view.v[..n].to_vec());
        history.demands.push(self.now.clone());
        history.worst.push(std::mem::replace(&mut self.worst, self.now.clone()));
        let e = view.energy;
        history.account.input.push(e.input);
        history.account.stored.push(e.stored - e.initial);
        history.account.dissipated.push(e.dissipated + e.released);
        history.account.residual.push(e.residual());
        self.residual = self.residual.max(e.residual().abs());
        self.begun = true;
    }

    fn look(&mut self, view: &View) {
        let frame = view.model.frame;
        self.now.take(frame, &view.q[..view.model.n], &view.v[..view.model.n]);
        self.worst.enlarge(&self.now);
        for (i, largest) in self.largest.iter_mut().enumerate() {
            for (largest, force) in largest.iter_mut().zip(view.model.contact(i, &view.feet[i], view.q)) {
                if force.abs() > largest.abs() {
                    *largest = force;
                }
            }
        }
    }

    /// After a step, with its impulses.
    pub fn step(&mut self, view: &View, impulses: &[[f64; 2]]) {
        for (sum, impulse) in self.impulses.iter_mut().zip(impulses) {
            *sum = [sum[0] + impulse[0], sum[1] + impulse[1]];
        }
        self.look(view);
    }

    /// After a corner's contact has changed.
    pub fn contact(&mut self, corner: usize, view: &View) {
        let place = &view.model.frame.places()[corner];
        let speed = place.velocity(&place.reach(view.q), view.v);
        let touches = view.feet[corner].closed;
        self.history.contacts.push(Contact { time: view.time, corner, touches, speed });
    }

    /// The history, once the run is over.
    pub fn finish(self, finish: Finish) -> History {
        History {
            outcome: finish.outcome,
            work: finish.work,
            energy_residual: self.residual / finish.energy_scale,
            energy_scale: finish.energy_scale,
            ..self.history
        }
    }
}
