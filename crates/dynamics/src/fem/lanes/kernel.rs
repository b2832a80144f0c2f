//! One Radau step of several histories side by side.
//!
//! Every loop over lanes is straight arithmetic on the functions that a history alone calls
//! (`step`, `newton`, `model`), which the compiler turns into vector operations. No operation is
//! contracted or reordered, so that a lane's step is that of the history alone, bit for bit, on any
//! machine.

#![allow(clippy::needless_range_loop)] // one index over many arrays

use crate::{
    fem::{
        model::{Foot, N, State},
        run::{Contacts, Scales, StepMeasures, TimeLoop},
        step::{Convergence, IterationVerdict, Request, Stages},
    },
    spring::{Chain, Springs},
};
use rocking::structure::Body;
use rows::{ENTRIES, column};

/// A block for each coordinate, written out: the compiler keeps a loop of many lines as a loop, and
/// then leaves the lanes alone.
macro_rules! coordinates {
    ($k:ident => $block:block) => {
        coordinates!($k in 0 1 2 3 4 5 6 => $block)
    };
    ($k:ident in $($number:literal)+ => $block:block) => {
        $({
            const $k: usize = $number;
            $block
        })+
    };
}

mod rows;
mod sweeps;

/// Histories side by side.
pub(super) const WIDTH: usize = 8;

/// Iterations of a call: most steps need one or two, those after an event more.
const ROUNDS: usize = 2;

/// A number of each lane.
type Lanes = [f64; WIDTH];

/// What a history's model is made of.
const FIXED: usize = 14;

/// The steps of all lanes: what is asked, and what comes out.
pub(super) struct Kernel {
    fixed: [Lanes; FIXED],
    scales: [Lanes; 4],
    q0: [Lanes; N],
    v0: [Lanes; N],
    anchor: [Lanes; 2],
    /// One where a foot is closed, or holds.
    closed: [Lanes; 2],
    holds: [Lanes; 2],
    h: Lanes,
    /// Ground acceleration along the step.
    start: [Lanes; 2],
    slope: [Lanes; 2],
    curve: [Lanes; 2],
    /// One where the body turns about its foot, and what a turn then counts.
    turning: Lanes,
    weight: Lanes,
    real: [Lanes; ENTRIES],
    pair: [[Lanes; ENTRIES]; 2],
    a: [[Lanes; N]; 3],
    q: [[Lanes; N]; 3],
    v: [[Lanes; N]; 3],
    residual: [[Lanes; N]; 3],
    /// By how much the foot's lever differs at the stages from that of the matrices.
    turned: [[Lanes; 2]; 3],
    lever: [Lanes; 2],
    /// Corrections in the eigenvectors of A: the real one, and both parts of the pair.
    w: [[Lanes; N]; 3],
    /// One where the iteration goes on.
    active: Lanes,
    /// One where the rotation left the reach of the polynomials for sine and cosine.
    steep: Lanes,
    /// The same where it was so at the step's start or half way.
    begins_steep: Lanes,
    change: Lanes,
    convergence: [Option<Convergence>; WIDTH],
    verdict: [IterationVerdict; WIDTH],
    /// Whether a step has been asked for since the last call.
    fresh: bool,
    stored: Lanes,
    input: Lanes,
    dissipated: Lanes,
    missed: Lanes,
    /// Compressions of both feet's gaps at the step's start and stages, and what counts as none.
    gaps: [[Lanes; 4]; 2],
    gap_tolerance: Lanes,
    /// One where no foot's contact changes.
    unchanged: Lanes,
}

/// A lane's step, tried.
pub(super) enum Tried {
    /// Whether it converged, and what it did.
    Step(bool, StepMeasures),
    /// It needs more iterations.
    GoesOn,
    /// It is to be tried by itself.
    Steep,
}

impl Kernel {
    pub(crate) fn new() -> Self {
        let none = [0.0; WIDTH];
        Self {
            // masses and lengths of one where there is no lane: no division by zero
            fixed: [[1.0; WIDTH]; FIXED],
            scales: [[1.0; WIDTH]; 4],
            q0: [none; N],
            v0: [none; N],
            anchor: [none; 2],
            closed: [none; 2],
            holds: [none; 2],
            h: [1.0; WIDTH],
            start: [none; 2],
            slope: [none; 2],
            curve: [none; 2],
            turning: none,
            weight: [1.0; WIDTH],
            real: [none; ENTRIES],
            pair: [[none; ENTRIES]; 2],
            a: [[none; N]; 3],
            q: [[none; N]; 3],
            v: [[none; N]; 3],
            residual: [[none; N]; 3],
            turned: [[none; 2]; 3],
            lever: [none; 2],
            w: [[none; N]; 3],
            active: none,
            steep: none,
            begins_steep: none,
            change: none,
            convergence: [None; WIDTH],
            verdict: [IterationVerdict::Failed; WIDTH],
            fresh: false,
            stored: none,
            input: none,
            dissipated: none,
            missed: none,
            gaps: [[none; 4]; 2],
            gap_tolerance: none,
            unchanged: none,
        }
    }

    /// Lane l follows this run from now on.
    pub(crate) fn assign(&mut self, l: usize, run: &TimeLoop<'_>) {
        let (model, scales) = (run.model, &run.scales);
        self.gap_tolerance[l] = run.gap_tolerance();
        let Springs { vertical: v, horizontal: h } = &model.springs;
        let Body { mass, half_width, height, inertia } = model.body;
        let chain = |c: &Chain| [c.k1, c.k2, c.m2, c.c];
        let ([a, b, c, d], [e, f, g, i]) = (chain(v), chain(h));
        let fixed = [
            mass,
            half_width,
            height,
            inertia,
            a,
            b,
            c,
            d,
            e,
            f,
            g,
            i,
            model.translation,
            model.rotation,
        ];
        for (to, from) in self.fixed.iter_mut().zip(fixed) {
            to[l] = from;
        }
        let &Scales { radius, share, moment, alpha } = scales;
        for (to, from) in self.scales.iter_mut().zip([radius, share, moment, alpha]) {
            to[l] = from;
        }
    }

    /// Lane l follows nothing any more.
    pub(crate) fn leave(&mut self, l: usize) {
        self.convergence[l] = None;
    }

    /// Ask lane l for a step.
    pub(crate) fn submit(
        &mut self,
        l: usize,
        state: &State,
        feet: &[Foot; 2],
        request: &Request,
        rounding: f64,
    ) {
        assert!(l < WIDTH);
        for k in 0..N {
            self.q0[k][l] = state.q[k];
            self.v0[k][l] = state.v[k];
            for i in 0..3 {
                self.a[i][k][l] = request.guess[i][k];
            }
        }
        for (i, foot) in feet.iter().enumerate() {
            self.anchor[i][l] = foot.anchor;
            self.closed[i][l] = f64::from(u8::from(foot.closed()));
            self.holds[i][l] = f64::from(u8::from(foot.holds()));
        }
        self.h[l] = request.h;
        for k in 0..2 {
            self.start[k][l] = request.ground.start[k];
            self.slope[k][l] = request.ground.slope[k];
            self.curve[k][l] = request.ground.curve[k];
        }
        self.turning[l] = f64::from(u8::from(request.turning.is_some()));
        self.weight[l] = request.turning.map_or(1.0, |turning| turning.weight);
        self.convergence[l] = Some(Convergence::new(request.tolerance, rounding, request.rate));
        self.fresh = true;
    }

    /// What lane l's step came to; if it converged, its end, and where contacts change or `wholly`
    /// all its stages.
    pub(crate) fn collect_step(&self, l: usize, wholly: bool, stages: &mut Stages) -> Tried {
        assert!(l < WIDTH);
        if self.steep[l] != 0.0 {
            return Tried::Steep;
        }
        stages.h = self.h[l];
        if let Some(convergence) = &self.convergence[l] {
            (stages.iterations, stages.rate) = (convergence.iterations, convergence.rate);
        }
        let converged = match self.verdict[l] {
            IterationVerdict::GoesOn => return Tried::GoesOn,
            verdict => verdict == IterationVerdict::Converged,
        };
        let unchanged = self.unchanged[l] != 0.0;
        if converged {
            let first = if unchanged && !wholly { 2 } else { 0 };
            for i in first..3 {
                stages.a[i] = column(&self.a[i], l);
                stages.q[i] = column(&self.q[i], l);
                stages.v[i] = column(&self.v[i], l);
            }
        }
        let contacts = if unchanged {
            Contacts::Unchanged
        } else {
            Contacts::Gaps([column(&self.gaps[0], l), column(&self.gaps[1], l)])
        };
        let measures = StepMeasures {
            stored: self.stored[l],
            input: self.input[l],
            dissipated: self.dissipated[l],
            missed: self.missed[l],
            contacts,
        };
        Tried::Step(converged, measures)
    }

    /// Go on with the steps of all lanes, a few iterations: those that need more go on with the
    /// next call, beside others' new steps.
    #[inline(always)]
    pub(crate) fn step(&mut self) {
        if self.fresh {
            self.factor();
            self.fresh = false;
        }
        self.steep = self.begins_steep;
        for round in 0..=ROUNDS {
            self.stages();
            let mut goes_on = false;
            for l in 0..WIDTH {
                let verdict = self.convergence[l]
                    .as_ref()
                    .map_or(IterationVerdict::Failed, Convergence::verdict);
                self.verdict[l] = verdict;
                let runs = verdict == IterationVerdict::GoesOn && self.steep[l] == 0.0;
                self.active[l] = f64::from(u8::from(runs));
                goes_on |= runs;
            }
            if !goes_on || round == ROUNDS {
                break;
            }
            for i in 0..3 {
                self.residuals(i);
                self.turn(i);
            }
            self.correct();
            for l in 0..WIDTH {
                if let (Some(convergence), true) = (&mut self.convergence[l], self.active[l] != 0.0)
                    && !convergence.moved(self.change[l])
                {
                    convergence.give_up();
                }
            }
        }
        self.measure();
        self.account();
        self.contacts();
    }
}
