//! A frame whose corners stand on spring-absorber units, for fixed time steps.
//!
//! ```text
//!   q = [ the frame's n coordinates;  a_x, a_z of every corner's absorbers ]
//!   M q'' = Q(q, q') + sum G' (H, N)        m2_h a_x'' = -m2_h a_g - H - k2_h a_x - c_h a_x'
//!                                           m2_v a_z'' = -m2_v a_v - N - k2_v a_z - c_v a_z'
//! ```
//!
//! M, Q and its tangent are the frame's own (`frames::frame`), H and N those of `contact`. One
//! dense matrix of the frame's coordinates a solution, the absorbers condensed.

use std::ops::ControlFlow;

use dynamics::spring::{Chain, Springs};
use frames::{
    Mechanics,
    frame::{EquilibriumError, Frame, PlaceOnNode, Reach, StrainRates, Support},
};
use nalgebra::{DMatrix, DVectorViewMut, Dyn, LU};

use crate::{
    FALLING,
    analysis::{FixedStepAnalysis, FixedStepOutcome, FixedStepWork},
    contact::{CondensedUnit, FixedFoot},
    kinematics::{TangentWeights, Trial},
    model::FixedStepModel,
};

/// A frame on its springs.
#[derive(Clone, Copy, Debug)]
pub struct FixedStepFrame<'a> {
    frame: &'a Frame,
    /// Under each corner.
    units: &'a [Springs<Chain>],
    /// Rotation of a base beyond which it falls (rad).
    falls_at: f64,
}

/// The matrix of the iteration, absorbers condensed.
#[derive(Clone, Debug)]
pub struct FrameFactor {
    lu: LU<f64, Dyn, Dyn>,
    /// Of every corner, horizontal and vertical.
    units: Vec<[CondensedUnit; 2]>,
    slopes: Vec<[f64; 2]>,
}

impl<'a> FixedStepFrame<'a> {
    /// A frame and the units under its corners; none under a frame that is held.
    ///
    /// # Errors
    /// There are not as many units as corners.
    pub fn new(frame: &'a Frame, units: &'a [Springs<Chain>]) -> Result<Self, EquilibriumError> {
        let (given, needed) = (units.len(), frame.places().len());
        if given != needed {
            return Err(EquilibriumError::Mismatch { what: "springs", given, needed });
        }
        Ok(Self { frame, units, falls_at: FALLING * frame.topples_at() })
    }

    /// Number of the frame's coordinates, which come first.
    fn n(&self) -> usize {
        self.frame.size()
    }

    /// What the dashpots of the frame's members resist in a trial.
    fn strain_rates<'t>(&self, trial: &'t Trial<Vec<f64>>) -> StrainRates<'t> {
        match &trial.change {
            Some((from, over)) => StrainRates::OfChange { from: &from[..self.n()], over: *over },
            None => StrainRates::OfVelocities,
        }
    }

    /// Every corner with its unit and the index of its horizontal absorber; the vertical one
    /// follows.
    fn corners(&self) -> impl Iterator<Item = (usize, &PlaceOnNode, &Springs<Chain>)> {
        let n = self.n();
        self.frame
            .places()
            .iter()
            .zip(self.units)
            .enumerate()
            .map(move |(i, (place, unit))| (n + 2 * i, place, unit))
    }
}

/// A frame's history at the record's samples.
#[derive(Clone, Debug)]
pub struct FixedStepFrameHistory {
    /// The frame's own coordinates; fewer than the record has samples if the outcome says so.
    pub coordinates: Vec<Vec<f64>>,
    /// How it ended.
    pub outcome: FixedStepOutcome,
    /// What it cost.
    pub work: FixedStepWork,
}

impl FixedStepAnalysis<'_, FixedStepFrame<'_>> {
    /// The frame's coordinates at the record's samples.
    ///
    /// # Errors
    /// The frame has no equilibrium to begin from.
    pub fn history(&self) -> Result<FixedStepFrameHistory, EquilibriumError> {
        let mut coordinates = Vec::with_capacity(self.accel.len());
        let (outcome, work) = self.follow(|_, q| {
            coordinates.push(q[..self.model.n()].to_vec());
            ControlFlow::Continue(())
        })?;
        Ok(FixedStepFrameHistory { coordinates, outcome, work })
    }
}

impl FixedStepModel for FixedStepFrame<'_> {
    type Vector = Vec<f64>;
    type Feet = Vec<FixedFoot>;
    type Places = Vec<Reach>;
    type Factor = FrameFactor;

    fn standing(&self) -> Result<(Vec<f64>, Vec<FixedFoot>), EquilibriumError> {
        let support =
            |unit: &Springs<Chain>| Some([unit.horizontal.in_series(), unit.vertical.in_series()]);
        let supports: Vec<Support> = self.units.iter().map(support).collect();
        let mut q = self.frame.standing(&supports)?.as_slice().to_vec();
        for (place, unit) in self.frame.places().iter().zip(self.units) {
            let share = |chain: &Chain| chain.k1 / (chain.k1 + chain.k2);
            let [x, z] = place.reach(&q).place;
            q.extend([x * share(&unit.horizontal), z * share(&unit.vertical)]);
        }
        let foot = |place: &PlaceOnNode| FixedFoot::standing(place.reach(&q).place);
        let feet = self.frame.places().iter().map(foot).collect();
        Ok((q, feet))
    }

    fn places(&self, q: &Vec<f64>) -> Vec<Reach> {
        self.frame.places().iter().map(|place| place.reach(q)).collect()
    }

    fn meet(&self, places: &Vec<Reach>, q: &Vec<f64>, feet: &mut Vec<FixedFoot>) {
        for (((at, _, unit), reach), foot) in self.corners().zip(places).zip(feet) {
            let [x, z] = reach.place;
            foot.meet(unit, q[at + 1] - z, x - q[at]);
        }
    }

    fn meet_after(
        &self,
        (places, before): (&Vec<Reach>, &Vec<f64>),
        q: &Vec<f64>,
        feet: &mut Vec<FixedFoot>,
    ) {
        let change: Vec<f64> = q.iter().zip(before).map(|(q, before)| q - before).collect();
        for (((at, place, unit), reach), foot) in self.corners().zip(places).zip(feet) {
            let [dx, dz] = place.velocity(reach, &change);
            foot.meet(unit, q[at + 1] - reach.place[1] - dz, reach.place[0] + dx - q[at]);
        }
    }

    fn meet_end(&self, places: &Vec<Reach>, w: f64, q: &Vec<f64>, feet: &mut Vec<FixedFoot>) {
        for (((at, _, unit), reach), foot) in self.corners().zip(places).zip(feet) {
            let [x, z] = foot.goes_on(reach.place, w);
            foot.meet(unit, q[at + 1] - z, x - q[at]);
        }
    }

    fn unbalance(
        &self,
        (trial, places): (&Trial<Vec<f64>>, &Vec<Reach>),
        feet: &Vec<FixedFoot>,
        ground: [f64; 2],
        out: &mut Vec<f64>,
    ) {
        let (Trial { q, v, a, .. }, n) = (trial, self.n());
        let mut inertia = vec![0.0; n];
        self.frame.momentum(&a[..n], &mut inertia);
        self.frame.forces((&q[..n], &v[..n]), self.strain_rates(trial), ground, &mut out[..n]);
        out.iter_mut().zip(inertia).for_each(|(out, inertia)| *out -= inertia);
        for (((at, place, unit), reach), foot) in self.corners().zip(places).zip(feet) {
            let force = foot.force(unit, q[at + 1] - reach.place[1], reach.place[0] - q[at]);
            place.push(reach, force, out);
            for (k, chain) in [&unit.horizontal, &unit.vertical].into_iter().enumerate() {
                let i = at + k;
                out[i] =
                    -(force[k] + chain.m2 * (ground[k] + a[i]) + chain.k2 * q[i] + chain.c * v[i]);
            }
        }
    }

    fn unbalance_norm(&self, places: &Vec<Reach>, unbalance: &Vec<f64>) -> f64 {
        let mut joints = unbalance[..self.n()].to_vec();
        let mut squares = 0.0;
        for ((at, place, _), reach) in self.corners().zip(places) {
            let [x, z] = [unbalance[at], unbalance[at + 1]];
            place.push(reach, [x, z], &mut joints);
            squares += 2.0 * (x * x + z * z);
        }
        (squares + joints.iter().map(|f| f * f).sum::<f64>()).sqrt()
    }

    fn factor(
        &self,
        (trial, places): (&Trial<Vec<f64>>, &Vec<Reach>),
        feet: &Vec<FixedFoot>,
        weights: &TangentWeights,
    ) -> Option<FrameFactor> {
        let (Trial { q, v, .. }, n) = (trial, self.n());
        let (mut k, mut c) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
        self.frame.slopes((&q[..n], &v[..n]), self.strain_rates(trial), &mut k, &mut c);
        let mut matrix =
            self.frame.mass_matrix() * weights.mass + c * weights.damping + k * weights.stiffness;
        let (mut units, mut slopes) =
            (Vec::with_capacity(feet.len()), Vec::with_capacity(feet.len()));
        for (((at, place, unit), reach), foot) in self.corners().zip(places).zip(feet) {
            let both = [
                CondensedUnit::new(&unit.horizontal, foot.closed && foot.holds, weights),
                CondensedUnit::new(&unit.vertical, foot.closed, weights),
            ];
            place.rows(reach.slope, |i, gi| {
                place.rows(reach.slope, |j, gj| {
                    matrix[(i, j)] +=
                        both[0].stiffness * gi[0] * gj[0] + both[1].stiffness * gi[1] * gj[1];
                });
            });
            if let Some(th) = place.rotation() {
                let [h, p] = foot.force(unit, q[at + 1] - reach.place[1], reach.place[0] - q[at]);
                matrix[(th, th)] += weights.stiffness * (h * reach.arm[0] + p * reach.arm[1]);
            }
            units.push(both);
            slopes.push(reach.slope);
        }
        let lu = matrix.lu();
        lu.is_invertible().then_some(FrameFactor { lu, units, slopes })
    }

    fn solve(&self, factor: &FrameFactor, r: &mut Vec<f64>) {
        let n = self.n();
        for ((at, place, _), ([h, v], slope)) in
            self.corners().zip(factor.units.iter().zip(&factor.slopes))
        {
            let [fx, fz] = [h.share * r[at], v.share * r[at + 1]];
            place.rows(*slope, |i, g| r[i] += fx * g[0] + fz * g[1]);
        }
        // invertible, or `factor` had given none
        let _ = factor.lu.solve_mut(&mut DVectorViewMut::from_slice(&mut r[..n], n));
        for ((at, place, _), ([h, v], slope)) in
            self.corners().zip(factor.units.iter().zip(&factor.slopes))
        {
            let mut moved = [0.0; 2];
            place.rows(*slope, |i, g| moved = [moved[0] + r[i] * g[0], moved[1] + r[i] * g[1]]);
            r[at] = h.give * r[at] + h.share * moved[0];
            r[at + 1] = v.give * r[at + 1] + v.share * moved[1];
        }
    }

    fn gaps(&self, q: &Vec<f64>, v: &Vec<f64>, mut each: impl FnMut(f64, f64)) {
        for ((at, place, _), reach) in self.corners().zip(self.places(q)) {
            each(q[at + 1] - reach.place[1], v[at + 1] - place.velocity(&reach, v)[1]);
        }
    }

    fn has_fallen(&self, q: &Vec<f64>) -> bool {
        self.frame.has_fallen(&q[..self.n()])
    }

    fn is_falling(&self, q: &Vec<f64>) -> bool {
        self.frame.has_turned(self.falls_at, &q[..self.n()])
    }
}
