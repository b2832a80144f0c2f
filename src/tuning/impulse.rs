//! Springs tuned on the impact objective: all eight parameters at once, from the ARR families.

use std::f64::consts::TAU;

use nalgebra::SVector;
use num_dual::{Derivative, DualNum, DualSVec64};
use rayon::prelude::*;

use super::{
    catalogue::{self, Wanted},
    descent::{LeastSquares, descend},
    global,
    impact::Impact,
    arr::inner::Fit,
    outer::Bracket,
};
use crate::{
    fem::Control,
    scalar::{GRAVITY, Scalar, real},
    spring::{Design, Springs},
    structure::Body,
};

type Dual = DualSVec64<8>;

/// Least and largest stiffness ratio K, damping number C and mass ratio mu that are tried.
const K: (f64, f64) = (0.001, 30.0);
const C: (f64, f64) = (0.005, 40.0);
const MU: (f64, f64) = (0.0025, 40.0);
/// Least Omega_n tried, as a share of the largest.
const SOFTEST: f64 = 0.1;

/// Error that landings out of order count as, for every factor e of one and what they are beyond their limits.
const DISORDER: f64 = 0.1;
/// The share of those limits that a search keeps to: other tolerances and rounded parameters take the rest.
const STRICT: f64 = 0.97;
/// Ripple of the vertical force that a landing may leave to the next impact, share of the weight. Springs that ring more have
/// landings in order one by one and fail where they follow each other.
const RINGING: f64 = 0.1;
/// Cost of springs on which a run did not finish.
const UNFINISHED: f64 = 10.0;

/// The springs found, and their error by the impact objective.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    pub springs: Springs<Design<f64>>,
    /// sqrt of the sum of squares of `Impact`'s residuals: about the NRMSE to expect; more where landings ring on.
    pub error: f64,
    /// Whether its landings are in order, from all leans.
    pub in_order: bool,
}

/// The eight logarithms: Omega_n [Hz], K, C, mu of the vertical and of the horizontal chain.
fn springs<S: Scalar>(z: &[S]) -> Springs<Design<S>> {
    let design = |z: &[S]| Design::from_kc(z[3].exp(), z[1].exp(), z[2].exp(), z[0].exp());
    Springs { vertical: design(&z[..4]), horizontal: design(&z[4..]) }
}

pub(super) fn logarithms(s: &Springs<Design<f64>>) -> [f64; 8] {
    let (v, h) = (&s.vertical, &s.horizontal);
    [v.omega_n_hz, v.k(), v.c(), v.mu, h.omega_n_hz, h.k(), h.c(), h.mu].map(f64::ln)
}

fn norm(residuals: &[f64]) -> f64 {
    residuals.iter().map(|r| r * r).sum::<f64>().sqrt()
}

/// x to 40 bits (1e-12): bounces make the objective rugged, and a search over it takes the rounding of its input for news.
fn rounded(x: f64) -> f64 {
    f64::from_bits((x.to_bits() + (1 << 11)) & !((1 << 12) - 1))
}

/// The impact objective within a bracket.
pub struct Objective {
    impact: Impact,
    /// What the catalogue is asked for.
    wanted: Wanted,
    bracket: Bracket,
    control: Control,
}

impl Objective {
    /// The objective depends on the mass only through I_cg/m, so it is that of a body of 1 kg: in whatever unit a mass is
    /// given, the same springs are found.
    pub fn new(body: &Body<f64>, restitution: f64, bracket: Bracket) -> Self {
        let control = Control { tolerance: 1e-6, most_steps: 8_000, ..Control::default() };
        let body = &Body { mass: 1.0, inertia: rounded(body.inertia / body.mass), ..*body };
        let restitution = rounded(restitution);
        Self {
            impact: Impact::new(body, restitution, bracket.max_hz),
            wanted: Wanted {
                omega_over_p: TAU * bracket.max_hz / body.p_squared().sqrt(),
                alpha: body.alpha(),
                mass_share: body.mass_share(),
                ratio: restitution / body.restitution(),
            },
            bracket,
            control,
        }
    }

    /// Least settlement that these springs can have [m].
    pub fn least_settlement(bracket: &Bracket) -> f64 {
        bracket.least_settlement(K.1)
    }

    /// Whether any springs settle as little as is asked for.
    fn can_settle(&self) -> bool {
        Self::least_settlement(&self.bracket) <= self.bracket.max_settlement
    }

    /// z with K of the vertical chain, and then its Omega_n, raised to what the largest settlement asks for.
    fn settled(&self, mut z: [f64; 8]) -> [f64; 8] {
        let Bracket { max_hz, max_settlement } = self.bracket;
        // (1 + 1/K) / Omega_n^2 at the limit
        let at = |hz: f64| max_settlement / (0.5 * GRAVITY) * (TAU * hz).powi(2);
        let most = K.1.ln();
        let needed = |hz: f64| if at(hz) > 1.0 { -(at(hz) - 1.0).ln() } else { f64::INFINITY };
        if needed(z[0].exp()) > most {
            let hz = max_hz * (self.bracket.least_settlement(K.1) / max_settlement).sqrt();
            (z[0], z[1]) = (z[0].max(hz.ln()), most);
        } else {
            z[1] = z[1].max(needed(z[0].exp()));
        }
        z
    }

    /// These springs, stiffened if they settle by more than is allowed, and what the impact objective says of them.
    fn found(&self, s: &Springs<Design<f64>>) -> Found {
        let springs = match s.settlement(1.0) > self.bracket.max_settlement {
            true => springs(&self.settled(logarithms(s))),
            false => *s,
        };
        let residuals = self.residuals(&logarithms(&springs));
        let landings = self.knows_order() && self.impact.in_order(&residuals);
        let excess = if landings { self.rings(&springs) } else { 0.0 };
        Found { springs, error: norm(&residuals) + DISORDER * excess.ln_1p(), in_order: landings && excess <= 0.0 }
    }

    /// Whether landings can be in order: for another restitution than equation 2's the feet must bounce.
    fn knows_order(&self) -> bool {
        !self.impact.another()
    }

    /// What a search over the logarithms `z` minimises: the error, what the landings lack to be in order, and the square of
    /// the distance from the bounds.
    pub(super) fn cost(&self, z: &[f64]) -> f64 {
        let (within, outside) = self.within(z);
        let residuals = self.residuals(&within);
        let disorder = match self.knows_order() {
            true => match self.impact.disorder(&residuals, STRICT) {
                0.0 => self.rings(&springs(&within)),
                some => some,
            },
            false => 0.0,
        };
        let cost = norm(&residuals) + DISORDER * disorder.ln_1p();
        // a run that did not finish is worse than any other
        if cost.is_finite() { cost + outside } else { UNFINISHED + outside }
    }

    /// By how much springs ring beyond the limit, in limits: single landings say nothing of an absorber that swings on.
    fn rings(&self, springs: &Springs<Design<f64>>) -> f64 {
        (self.impact.ringing(springs) / RINGING - 1.0).max(0.0)
    }

    /// The springs of logarithms `z`, held within the bounds.
    pub(super) fn at(&self, z: &[f64]) -> Found {
        self.found(&springs(&self.within(z).0))
    }

    /// `z` held within the bounds and the largest settlement, and the square of how far it was moved.
    fn within(&self, z: &[f64]) -> ([f64; 8], f64) {
        let (low, high) = self.bounds();
        let held = std::array::from_fn(|i| z[i].clamp(low[i], high[i]));
        let within = match springs(&held).settlement(1.0) > self.bracket.max_settlement {
            true => self.settled(held),
            false => held,
        };
        (within, within.iter().zip(z).map(|(a, b)| (a - b).powi(2)).sum())
    }

    /// sqrt of the sum of squares of the residuals.
    pub fn error(&self, s: &Springs<Design<f64>>) -> f64 {
        norm(&self.residuals(&logarithms(s)))
    }
}

impl LeastSquares for Objective {
    fn residuals(&self, z: &[f64]) -> Vec<f64> {
        self.impact.residuals(&springs(z), self.control)
    }

    fn gradients(&self, z: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let duals: Vec<Dual> = z
            .iter()
            .enumerate()
            .map(|(i, &z)| Dual::new(z, Derivative::derivative_generic(nalgebra::Const::<8>, nalgebra::U1, i)))
            .collect();
        // one iteration more leaves the gradients good to the square of the iteration's rate, about 1e-4: enough for a step
        let control = Control { extra_iterations: 1, tolerance: 1e-5, ..self.control };
        let found = self.impact.residuals(&springs(&duals), control);
        let rows = found
            .iter()
            .map(|r| {
                let row: SVector<f64, 8> = r.eps.unwrap_generic(nalgebra::Const::<8>, nalgebra::U1);
                row.iter().copied().collect()
            })
            .collect();
        (found.iter().map(|r| r.re).collect(), rows)
    }

    fn bounds(&self) -> (Vec<f64>, Vec<f64>) {
        let hz = (SOFTEST * self.bracket.max_hz, self.bracket.max_hz);
        let pairs = [hz, K, C, MU, hz, K, C, MU];
        (pairs.iter().map(|p| p.0.ln()).collect(), pairs.iter().map(|p| p.1.ln()).collect())
    }

    fn inequality(&self, z: &[f64]) -> Option<(f64, Vec<f64>)> {
        // ln of g/2 (1 + 1/K) / Omega_n^2 over the largest settlement
        let settlement = |omega: Dual, k: Dual| {
            ((k.exp().recip() + 1.0) * (0.5 * GRAVITY) / ((omega.exp() * TAU) * (omega.exp() * TAU))).ln()
        };
        let seed =
            |i: usize, x: f64| Dual::new(x, Derivative::derivative_generic(nalgebra::Const::<8>, nalgebra::U1, i));
        let value = settlement(seed(0, z[0]), seed(1, z[1])) - real::<Dual>(self.bracket.max_settlement.ln());
        let row: SVector<f64, 8> = value.eps.unwrap_generic(nalgebra::Const::<8>, nalgebra::U1);
        Some((value.re, row.iter().copied().collect()))
    }
}

/// Springs that are this much worse than the best by the impact objective may still be the better ones for a record.
const PASSABLE: f64 = 2.0;
/// So may any whose error by it is this small: single landings tell no more.
const SLIGHT: f64 = 0.02;
/// Steps from a start whose landings are in order as it is.
const NEARLY_THERE: u64 = 2;

/// How hard to search.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Springs known that are tried, of the structures most like it.
    pub tried: usize,
    /// Starts that are followed if the landings of none are in order as it is; else it is the best of those.
    pub followed: usize,
    /// Steps of each.
    pub iterations: u64,
    /// Then follow none; so it is where springs of a structure so like it are known, too.
    pub content: bool,
}

/// Evaluations of a search where no springs known have their landings in order.
const SEARCH: usize = 1000;

/// Tune all eight parameters: the best of [`proposals`], [`searched`], by the impact objective among those whose landings are in
/// order.
pub fn tune(objective: &Objective, families: &[Fit], effort: Effort) -> Option<Found> {
    let proposals = searched(objective, proposals(objective, families, effort), None, &|_, _, _| ());
    in_order_first(&proposals).next().copied()
}

/// Proposals and what a search of so many `evaluations` adds; unless given, there is one where the landings of none are in order
/// and those of others might be. `progress` gets the evaluations done, planned, and the least cost so far.
pub fn searched(
    objective: &Objective,
    proposals: Vec<Found>,
    evaluations: Option<usize>,
    progress: &(dyn Fn(usize, usize, f64) + Sync),
) -> Vec<Found> {
    let lacking = objective.knows_order() && !proposals.iter().any(|found| found.in_order);
    let evaluations = evaluations.unwrap_or(if lacking { SEARCH } else { 0 });
    if evaluations == 0 || !objective.can_settle() {
        return proposals;
    }
    let ends = global::search(objective, proposals.first(), evaluations, progress);
    ranked([proposals, ends].concat())
}

/// Those of proposals whose landings are in order; all, if those of none are.
pub fn in_order_first(proposals: &[Found]) -> impl Iterator<Item = &Found> {
    let any = proposals.iter().any(|found| found.in_order);
    proposals.iter().filter(move |found| found.in_order || !any)
}

/// Springs that are good for any record, the best first, and none much worse than it: from springs found before for structures
/// of like Omega_n/p and, where none of these has its landings in order, from pairs of families at the stiffest springs allowed.
/// The best few are followed down all eight parameters. Empty if no start finishes its runs, or all settle by more than is allowed.
pub fn proposals(objective: &Objective, families: &[Fit], effort: Effort) -> Vec<Found> {
    let hz = objective.bracket.max_hz;
    if !objective.can_settle() {
        return Vec::new();
    }
    let judged = |starts: &[Springs<Design<f64>>]| -> Vec<Found> {
        starts.par_iter().with_max_len(1).map(|start| objective.found(start)).collect()
    };
    let any_in_order = |found: &[Found]| found[..passable(found)].iter().any(|found| found.in_order);
    let mut starts = best_first(judged(&catalogue::near(&objective.wanted, hz, effort.tried)));
    if !any_in_order(&starts) {
        let pairs = families.iter().map(|fit| {
            let design = Design { mu: fit.mu, f: fit.f, xi: fit.xi, omega_n_hz: hz };
            Springs { vertical: design, horizontal: design }
        });
        starts = best_first([starts, judged(&pairs.collect::<Vec<_>>())].concat());
    }
    let in_order = any_in_order(&starts);
    let (followed, iterations) = match (in_order, effort.content || objective.wanted.is_known()) {
        (true, true) => (0, 0),
        // one that is in order needs no rival, and is nearly there
        (true, false) => (1, effort.iterations.min(NEARLY_THERE)),
        (false, _) => (effort.followed, effort.iterations),
    };
    let follow: Vec<&Found> = in_order_first(&starts[..passable(&starts)]).take(followed).collect();
    let ends: Vec<Found> = follow
        .par_iter()
        .map(|start| {
            let end = descend(objective, &logarithms(&start.springs), 0.3, iterations);
            // the descent sees the limit of the settlement as a plane
            objective.found(&springs(&end.z))
        })
        .collect();
    ranked([ends, starts].concat())
}

fn best_first(mut found: Vec<Found>) -> Vec<Found> {
    found.sort_by(|a, b| a.error.total_cmp(&b.error));
    found
}

/// How many of springs, the best first, are not much worse than it.
fn passable(found: &[Found]) -> usize {
    let most = found.first().map_or(f64::INFINITY, |best| (PASSABLE * best.error).max(SLIGHT));
    found.iter().take_while(|found| found.error.is_finite() && found.error <= most).count()
}

/// The best first, and none much worse than it.
fn ranked(found: Vec<Found>) -> Vec<Found> {
    let mut found = best_first(found);
    found.truncate(passable(&found));
    found
}
