//! What a run leaves behind: the motion, every landing, the feet's forces, the energy account.

use std::ops::ControlFlow;

use super::{
    Finish,
    control::{Outcome, Work},
    model::{TH, X, Z},
    observer::{Change, Observer, View},
};
use crate::motion::Motion;

/// A foot that opens again this soon after its touch-down, the body not having reversed, bounced [s].
const BOUNCE_WITHIN: f64 = 0.25;

/// One touch-down of a foot and what came of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landing {
    /// Touch-down [s].
    pub time: f64,
    /// 0 left, 1 right.
    pub foot: usize,
    /// Kinetic energy of the body at touch-down [J].
    pub kinetic: f64,
    /// Energy taken by dashpots and let go by springs from this touch-down to the next landing (or the end) [J].
    pub lost: f64,
    /// Whether the foot opened again within 0.25 s while the body had not reversed.
    pub bounced: bool,
    /// Whether it is the first touch-down after rocking on the other foot (not the re-landing of a bounce).
    pub impact: bool,
    /// Time with both feet in the air since the impact this landing belongs to [s].
    pub airborne: f64,
}

/// Contact forces of both feet (left, right) at every sample [N].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Forces {
    pub vertical: [Vec<f64>; 2],
    pub horizontal: [Vec<f64>; 2],
}

/// The energy account at every sample [J].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Account {
    pub input: Vec<f64>,
    /// Stored above the initial energy.
    pub stored: Vec<f64>,
    /// Dashpots and released springs.
    pub dissipated: Vec<f64>,
    pub residual: Vec<f64>,
}

/// A whole history of the finite element model.
#[derive(Clone, Debug)]
pub struct History {
    pub motion: Motion,
    pub landings: Vec<Landing>,
    pub forces: Forces,
    pub account: Account,
    pub outcome: Outcome,
    pub work: Work,
    /// Largest |residual| over the largest energy of the history.
    pub energy_residual: f64,
    /// Z of the centre of mass at the start [m]; minus the settlement when it stood settled.
    pub initial_z: f64,
    /// Total time with both feet in the air [s].
    pub airborne: f64,
}

impl History {
    /// Number of impacts, re-landings of bounces not counted.
    pub fn impacts(&self) -> usize {
        self.landings.iter().filter(|l| l.impact).count()
    }

    /// Number of bounces.
    pub fn bounces(&self) -> usize {
        self.landings.iter().filter(|l| l.bounced).count()
    }
}

/// An observer that keeps everything.
#[derive(Clone, Debug)]
pub struct Recorder {
    motion: Motion,
    landings: Vec<Landing>,
    forces: Forces,
    account: Account,
    initial_z: f64,
    residual: f64,
    /// Energy lost up to the last impact [J].
    lost_before: f64,
    /// Sign of the rotation rate at each foot's last touch-down.
    heading: f64,
    airborne_since: Option<f64>,
    airborne: f64,
}

impl Recorder {
    /// With room for n samples.
    pub fn new(n: usize) -> Self {
        let room = || Vec::with_capacity(n);
        Self {
            motion: Motion::with_capacity(n),
            landings: Vec::new(),
            forces: Forces { vertical: [room(), room()], horizontal: [room(), room()] },
            account: Account { input: room(), stored: room(), dissipated: room(), residual: room() },
            initial_z: 0.0,
            residual: 0.0,
            lost_before: 0.0,
            heading: 0.0,
            airborne_since: None,
            airborne: 0.0,
        }
    }

    /// The history, once the run is over.
    pub fn finish(mut self, finish: Finish<f64>) -> History {
        let lost = finish.energy.dissipated + finish.energy.released;
        self.close_landing(lost);
        History {
            motion: self.motion,
            landings: self.landings,
            forces: self.forces,
            account: self.account,
            outcome: finish.outcome,
            work: finish.work,
            energy_residual: self.residual / finish.energy_scale,
            initial_z: self.initial_z,
            airborne: self.airborne,
        }
    }

    fn close_landing(&mut self, lost: f64) {
        if let Some(impact) = self.landings.iter_mut().rev().find(|l| l.impact) {
            impact.lost = lost - self.lost_before;
        }
        self.lost_before = lost;
    }
}

impl Observer<f64> for Recorder {
    fn sample(&mut self, index: usize, view: &View<f64>) -> ControlFlow<()> {
        let q = &view.state.q;
        if index == 0 {
            self.initial_z = q[Z];
        }
        self.motion.push(q[X], q[Z] - self.initial_z, q[TH]);
        for (i, f) in view.model.contact(q, view.feet).iter().enumerate() {
            self.forces.vertical[i].push(f.vertical);
            self.forces.horizontal[i].push(f.horizontal);
        }
        let e = view.energy;
        self.account.input.push(e.input);
        self.account.stored.push(e.stored - e.initial);
        self.account.dissipated.push(e.dissipated + e.released);
        self.account.residual.push(e.residual());
        self.residual = self.residual.max(e.residual().abs());
        ControlFlow::Continue(())
    }

    fn event(&mut self, foot: usize, change: Change, view: &View<f64>) {
        let time = view.time;
        let rate = view.state.v[TH];
        let lost = view.energy.dissipated + view.energy.released;
        match change {
            Change::LiftOff => {
                if let Some(last) = self.landings.iter_mut().rev().find(|l| l.foot == foot)
                    && time - last.time < BOUNCE_WITHIN
                    && rate * self.heading > 0.0
                {
                    last.bounced = true;
                }
                if !view.feet[1 - foot].closed() {
                    self.airborne_since = Some(time);
                }
            }
            Change::TouchDown => {
                if let Some(since) = self.airborne_since.take() {
                    self.airborne += time - since;
                    if let Some(impact) = self.landings.iter_mut().rev().find(|l| l.impact) {
                        impact.airborne += time - since;
                    }
                }
                let again = self.landings.iter().rev().find(|l| l.foot == foot).is_some_and(|l| l.bounced && time - l.time < BOUNCE_WITHIN)
                    // the foot that was left behind, touching again in the same landing
                    || self.landings.iter().rev().find(|l| l.impact).is_some_and(|l| l.foot != foot && time - l.time < BOUNCE_WITHIN && rate * self.heading > 0.0);
                if !again {
                    self.close_landing(lost);
                    self.heading = rate;
                }
                self.landings.push(Landing {
                    time,
                    foot,
                    kinetic: view.model.body_kinetic(view.state),
                    lost: 0.0,
                    bounced: false,
                    impact: !again,
                    airborne: 0.0,
                });
            }
        }
    }
}
