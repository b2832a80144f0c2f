//! A foot as a program with fixed time steps has it.
//!
//! ```text
//!   d = a_z - p_z, compression of the gap       e = p_x - a_x, how far the foot is from its absorber across
//!   d < 0   open:    no force; its anchor goes along:  anchor = e
//!   d >= 0  closed:  N = k1_v d,  H = -k1_h (e - anchor), at most mu N
//! ```
//!
//! decided anew in every trial of the iteration. The law of OpenSees' flatSliderBearing with a gap
//! without tension as axial material, which our decks use (FlatSliderSimple2d.cpp): the anchor that
//! counts is the last step's, and a foot that is open in any trial of a step leaves the anchor of
//! the steps to come where it was then, even if the step ends with it closed.
//!
//! Where it was then is where the program has the foot's own node, at the end of a leg: in a trial
//! of Newton's iteration where its linear equations put it, half R times the square of the trial's
//! rotation from where the leg turns to; at the end of a step of HHT on a straight line through
//! where the forces count. A step of 0.01 s and a rotation of 0.5 rad/s make 1e-5 m of it, which is
//! as much as springs give, and histories that touch so differ from then on.

use dynamics::spring::{Chain, Springs};

/// A coefficient of friction at which no pressing foot ever slips, not even in the last microsecond
/// before it lifts: with 1000 a foot that lifts lets its horizontal force go in 20 us instead of at
/// once, and 3 s of a 2 m block are off by 3e-4. That of our decks.
pub const HOLDS: f64 = 1e7;

/// A foot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedFoot {
    /// Whether it presses.
    pub closed: bool,
    /// Whether its horizontal spring holds; it slides otherwise.
    pub holds: bool,
    /// Where it was at the last step's end, of integrators whose forces count within a step (m).
    pub place: [f64; 2],
    /// Whether it pressed at the last step's end.
    was: bool,
    /// Whether it stays as it was then, whatever its gap.
    held: bool,
    /// Where its horizontal spring is anchored in this step (m).
    pub anchor: f64,
    /// The same in steps to come (m).
    next: f64,
}

impl FixedFoot {
    /// On the ground since the structure was built, settled to this place (m).
    pub fn standing(place: [f64; 2]) -> Self {
        Self { place, ..Self::new(true, 0.0) }
    }

    /// On the ground or in the air, its horizontal spring without force at `anchor`.
    pub fn new(closed: bool, anchor: f64) -> Self {
        let (held, place) = (false, [0.0; 2]);
        Self { closed, holds: closed, was: closed, held, place, anchor, next: anchor }
    }

    /// Decide whether it is closed, and holds, in a trial: its gap's compression d and its distance
    /// across e (m).
    #[inline(always)]
    pub fn meet(&mut self, unit: &Springs<Chain>, d: f64, e: f64) {
        self.closed = if self.held { self.was } else { d >= 0.0 };
        if !self.closed {
            self.holds = false;
            self.next = e;
            return;
        }
        if self.held {
            self.holds = true;
            return;
        }
        let (trial, most) = (unit.horizontal.k1 * (e - self.anchor), HOLDS * unit.vertical.k1 * d);
        self.holds = trial.abs() <= most;
        if !self.holds {
            self.next = self.anchor + (trial.abs() - most) / unit.horizontal.k1 * trial.signum();
        }
    }

    /// Force of the ground on it (H, N), as it was met (N).
    #[inline(always)]
    pub fn force(&self, unit: &Springs<Chain>, d: f64, e: f64) -> [f64; 2] {
        if !self.closed {
            return [0.0; 2];
        }
        let (n, along) = (unit.vertical.k1 * d, unit.horizontal.k1 * (self.anchor - e));
        [if self.holds { along } else { HOLDS * n * along.signum() }, n]
    }

    /// Where it is at the end of a step a part w of which brings it to `at`.
    pub fn goes_on(&mut self, at: [f64; 2], w: f64) -> [f64; 2] {
        for (place, at) in self.place.iter_mut().zip(at) {
            *place += (at - *place) / w;
        }
        self.place
    }

    /// Whether it has touched or left the ground since the last step's end.
    #[inline(always)]
    pub fn has_changed(&self) -> bool {
        self.closed != self.was
    }

    /// Stay as it was at the last step's end until [`FixedFoot::release`], whatever its gap: a
    /// closed one pulls, an open one goes through the ground.
    pub(crate) fn hold(&mut self) {
        self.held = true;
    }

    /// Open and close with its gap again.
    pub(crate) fn release(&mut self) {
        self.held = false;
    }

    /// Close or open at the end of a trial in which it was held.
    pub(crate) fn change(&mut self) {
        self.closed = !self.was;
        self.holds = self.closed;
    }

    /// Whether it pressed at the last step's end.
    pub(crate) fn was_closed(&self) -> bool {
        self.was
    }

    /// The step holds.
    #[inline(always)]
    pub fn commit(&mut self) {
        self.was = self.closed;
        self.anchor = self.next;
    }

    /// A trial is given up: forgets the anchor that it found.
    pub fn revert(&mut self) {
        self.next = self.anchor;
    }
}

/// A spring-absorber unit in one direction, its absorber condensed out of the iteration's matrix.
///
/// ```text
///   (D + k) da - k g'dq = r_a    ->    adds k D/(D + k) g g' to the matrix, and g k/(D + k) r_a to the right side
///   D: the absorber's own part of the matrix,  k: that of k1 while it acts,  g: row of the foot's place
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct CondensedUnit {
    /// k D/(D + k) (N/m).
    pub stiffness: f64,
    /// k/(D + k).
    pub share: f64,
    /// 1/(D + k) (m/N).
    pub give: f64,
}

impl CondensedUnit {
    /// Of a unit whose k1 acts or does not.
    #[inline(always)]
    pub fn new(chain: &Chain, acts: bool, weights: &crate::kinematics::TangentWeights) -> Self {
        let own =
            weights.mass * chain.m2 + weights.damping * chain.c + weights.stiffness * chain.k2;
        let k = if acts { weights.stiffness * chain.k1 } else { 0.0 };
        let give = 1.0 / (own + k);
        Self { stiffness: k * own * give, share: k * give, give }
    }
}
