//! Springs softer than the landing's limit: the design followed down in Omega_n/p, on landings and
//! uplifts of the whole model.
//!
//! Where a cap keeps Omega_n v_n/g small, gravity takes part in the landing and the stance gives
//! way before it lifts. So the design from the geometry is only where to begin: it is taken at a
//! stiffness at which it holds, and with every step down, by a factor of two, all eight parameters
//! are tuned again on the whole model (`landing_simulation`), from what they were. No record.

use std::f64::consts::TAU;

use super::{
    SearchProgress,
    descent::{LeastSquares, descend},
    landing_simulation::{Criterion, WholeModel},
    paper_procedure::outer::Bracket,
    search::search,
};
use dynamics::{
    effort::Effort,
    fem::Control,
    spring::{Design, Springs},
};
use landing::design::Geometry;
use rocking::{scalar::GRAVITY, structure::Body};

/// Stiffness ratio K, damping number C, mass ratio mu: least and largest.
const K: (f64, f64) = (0.001, LARGEST_K);
/// The largest K that is tried: it settles least.
pub(crate) const LARGEST_K: f64 = 30.0;
const C: (f64, f64) = (0.005, 40.0);
const MU: (f64, f64) = (0.0025, 40.0);
/// Least Omega_n, as a share of the largest.
const SOFTEST: f64 = 0.1;

/// The eight logarithms: Omega_n (Hz), K, C, mu of the vertical and of the horizontal units.
fn springs(z: &[f64]) -> Springs<Design<f64>> {
    let design = |z: &[f64]| Design::from_kc(z[3].exp(), z[1].exp(), z[2].exp(), z[0].exp());
    Springs { vertical: design(&z[..4]), horizontal: design(&z[4..]) }
}

fn logarithms(s: &Springs<Design<f64>>) -> Vec<f64> {
    let (v, h) = (&s.vertical, &s.horizontal);
    [v.omega_n_hz, v.k(), v.c(), v.mu, h.omega_n_hz, h.k(), h.c(), h.mu].map(f64::ln).to_vec()
}

/// Half-width of the central differences (in logarithms): far above the error of a history, far
/// below the range over which the residuals curve.
const DIFFERENCE: f64 = 0.01;

/// Cost of springs on which a run does not finish.
const UNFINISHED: f64 = 100.0;
/// Evaluations of the search for another restitution; cost at which it stops (0.1 % error of e in
/// every landing).
const EVALUATIONS: usize = 6000;
const ENOUGH: f64 = 0.4;

/// Landings and uplifts of a body on springs within a bracket.
struct LandingsAndUplifts<'a> {
    whole: WholeModel,
    bracket: Bracket,
    control: Control,
    effort: &'a Effort,
}

impl<'a> LandingsAndUplifts<'a> {
    /// It depends on the mass only through I_cg/m, so it is that of a body of 1 kg: in whatever
    /// unit a mass is given, the same springs are found.
    fn new(
        body: &Body<f64>,
        restitution: f64,
        (bracket, criterion): (Bracket, Criterion),
        effort: &'a Effort,
    ) -> Self {
        let control = Control { tolerance: 1e-6, most_steps: 8_000, ..Control::default() };
        let body = &Body { mass: 1.0, inertia: body.inertia / body.mass, ..*body };
        Self {
            whole: WholeModel::new(body, restitution, bracket.max_hz, criterion),
            bracket,
            control,
            effort,
        }
    }
}

impl LeastSquares for LandingsAndUplifts<'_> {
    fn stops(&self) -> bool {
        self.effort.stops()
    }

    fn residuals(&self, z: &[f64]) -> Vec<f64> {
        self.whole.residuals(&springs(z), self.control, self.effort)
    }

    fn gradients(&self, z: &[f64]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let now = self.residuals(z);
        let slopes: Vec<Vec<f64>> = parallel::map_range(0..z.len(), |i| {
            let moved = |by: f64| {
                let mut z = z.to_vec();
                z[i] += by;
                self.residuals(&z)
            };
            let ends = moved(DIFFERENCE).into_iter().zip(moved(-DIFFERENCE));
            ends.map(|(up, down)| (up - down) / (2.0 * DIFFERENCE)).collect()
        });
        let rows = (0..now.len()).map(|r| slopes.iter().map(|slope| slope[r]).collect()).collect();
        (now, rows)
    }

    fn bounds(&self) -> (Vec<f64>, Vec<f64>) {
        let hz = (SOFTEST * self.bracket.max_hz, self.bracket.max_hz);
        let pairs = [hz, K, C, MU, hz, K, C, MU];
        (pairs.iter().map(|p| p.0.ln()).collect(), pairs.iter().map(|p| p.1.ln()).collect())
    }

    fn inequality(&self, z: &[f64]) -> Option<(f64, Vec<f64>)> {
        // ln of g/2 (1 + 1/K) / Omega_n^2 over the largest settlement
        let (omega, k) = (z[0].exp() * TAU, z[1].exp());
        let settlement = (1.0 + 1.0 / k) * (0.5 * GRAVITY) / (omega * omega);
        let mut row = vec![0.0; z.len()];
        (row[0], row[1]) = (-2.0, -1.0 / (1.0 + k));
        Some(((settlement / self.bracket.max_settlement).ln(), row))
    }
}

/// Omega_h/Omega_v at the start of the descent: both units as stiff as a cap allows, and the softer
/// vertical ones of `landing::design`.
const RATIOS: [f64; 2] = [1.0, 4.0];
/// Halvings of the stiffness on the way down.
const HALVINGS: i32 = 3;
/// Steps of the descent at every stiffness, and at the last.
const STEPS: (u64, u64) = (4, 15);

/// Springs of at most `bracket.max_hz` for a body that lands with velocity restitution
/// `restitution`, followed down from the design that its geometry gives: one of each ratio and
/// criterion. Which of them follow histories best is for histories to say; neither criterion is the
/// better one for every body.
pub fn follow(
    body: &Body<f64>,
    restitution: f64,
    bracket: Bracket,
    effort: &Effort,
) -> Vec<Springs<Design<f64>>> {
    let criteria = [Criterion::Energy, Criterion::GrowingPart];
    let ways: Vec<(f64, Criterion)> =
        RATIOS.iter().flat_map(|&r| criteria.map(|c| (r, c))).collect();
    // side by side, each with a share of its own
    let shares: Vec<_> = ways.iter().map(|way| (*way, effort.share(ways.len() as u64))).collect();
    let one = |(way, share): &(_, Effort)| path(body, restitution, bracket, *way, share);
    let found = parallel::map(&shares, one);
    shares.iter().for_each(|(_, share)| effort.join(share));
    found.into_iter().flatten().collect()
}

/// Springs for another restitution than equation 2's, by a search and a descent from where it ends.
/// `progress` gets the evaluations done, planned, and the least cost so far.
pub fn with_restitution(
    body: &Body<f64>,
    restitution: f64,
    bracket: Bracket,
    effort: &Effort,
    progress: SearchProgress,
) -> Option<Springs<Design<f64>>> {
    let objective =
        LandingsAndUplifts::new(body, restitution, (bracket, Criterion::Energy), effort);
    let cost = |z: &[f64]| {
        // the descent cannot come back from a settlement that is not allowed
        if let Some((over, _)) = objective.inequality(z).filter(|(over, _)| *over > 0.0) {
            return UNFINISHED * (1.0 + over);
        }
        let error = objective.residuals(z).iter().map(|r| r * r).sum::<f64>().sqrt();
        // a run that did not finish is worse than any other
        if error.is_finite() { error } else { UNFINISHED }
    };
    let z = search(&cost, &objective.bounds(), EVALUATIONS, ENOUGH, effort, progress)?;
    let end = descend(&objective, &z, 0.3, STEPS.1);
    let found = springs(&end.z);
    settles(&found, bracket).then_some(found)
}

/// Whether springs settle by no more than allowed; the descent sees the limit as a plane.
fn settles(springs: &Springs<Design<f64>>, bracket: Bracket) -> bool {
    springs.settlement(1.0) <= bracket.max_settlement * (1.0 + 1e-3)
}

/// Follows the design down from one frequency ratio by one criterion.
fn path(
    body: &Body<f64>,
    restitution: f64,
    bracket: Bracket,
    (ratio, criterion): (f64, Criterion),
    effort: &Effort,
) -> Option<Springs<Design<f64>>> {
    let stiffest = bracket.max_hz * 2f64.powi(HALVINGS);
    let stiffness = TAU * stiffest / ratio / body.p();
    let mut found = Geometry::of(body, stiffness).ok()?.springs();
    found.vertical.omega_n_hz = stiffest / ratio;
    found.horizontal.omega_n_hz = stiffest;
    let mut error = f64::INFINITY;
    for halving in (0..=HALVINGS).rev() {
        let here = Bracket { max_hz: bracket.max_hz * 2f64.powi(halving), ..bracket };
        if halving < HALVINGS {
            found.vertical.omega_n_hz *= 0.5;
            found.horizontal.omega_n_hz *= 0.5;
        }
        let objective = LandingsAndUplifts::new(body, restitution, (here, criterion), effort);
        let steps = if halving == 0 { STEPS.1 } else { STEPS.0 };
        let end = descend(&objective, &logarithms(&found), 0.3, steps);
        (found, error) = (springs(&end.z), end.error);
    }
    (error.is_finite() && settles(&found, bracket)).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::structure::Structure;

    /// Springs of 160 Hz from the geometry of the paper's frame, and what they are judged by.
    fn judged(effort: &Effort) -> (LandingsAndUplifts<'_>, Vec<f64>) {
        let body = Structure::paper().body::<f64>();
        let bracket = Bracket { max_hz: 160.0, max_settlement: 0.01 };
        let restitution = body.restitution();
        let objective =
            LandingsAndUplifts::new(&body, restitution, (bracket, Criterion::Energy), effort);
        let mut found = Geometry::of(&body, TAU * 160.0 / body.p()).unwrap().springs();
        (found.vertical.omega_n_hz, found.horizontal.omega_n_hz) = (160.0, 160.0);
        (objective, logarithms(&found))
    }

    fn moved(z: &[f64], i: usize, by: f64) -> Vec<f64> {
        let mut z = z.to_vec();
        z[i] += by;
        z
    }

    #[test]
    fn the_limit_of_the_settlement_has_the_slopes_of_its_value() {
        let effort = Effort::unbounded();
        let (objective, z) = judged(&effort);
        let value = |z: &[f64]| objective.inequality(z).unwrap().0;
        let (here, row) = objective.inequality(&z).unwrap();
        // both feet, each on half of the weight
        let settles = springs(&z).settlement(1.0);
        assert!((here - (settles / 0.01).ln()).abs() < 1e-12, "{here} {settles}");
        for (i, slope) in row.iter().enumerate() {
            let by = 1e-5;
            let difference = (value(&moved(&z, i, by)) - value(&moved(&z, i, -by))) / (2.0 * by);
            assert!((slope - difference).abs() < 1e-9, "{i}: {slope} {difference}");
        }
    }

    /// Slopes are those of histories followed ten thousand times as exactly, over a third of the
    /// difference: neither their error nor the difference shows.
    #[test]
    fn slopes_are_those_of_finer_differences_of_finer_histories() {
        let effort = Effort::unbounded();
        let (objective, z) = judged(&effort);
        let (_, rows) = objective.gradients(&z);
        let fine = Control { tolerance: 1e-10, most_steps: 100_000, ..objective.control };
        let residuals = |z: &[f64]| objective.whole.residuals(&springs(z), fine, &effort);
        let largest = rows.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!(largest > 1e-2, "the springs are felt: {largest}");
        for i in 0..z.len() {
            let by = DIFFERENCE / 3.0;
            let (up, down) = (residuals(&moved(&z, i, by)), residuals(&moved(&z, i, -by)));
            for (r, row) in rows.iter().enumerate() {
                let slope = (up[r] - down[r]) / (2.0 * by);
                assert!((row[i] - slope).abs() < 0.05 * largest, "{r} {i}: {} {slope}", row[i]);
            }
        }
    }
}
