//! A frame whose corners stand on spring-absorber units.
//!
//! ```text
//!   q = [ the frame's n coordinates;  a_x, a_z of every corner's absorbers ]
//!   gap, closed while it presses:   N =  k1_v (a_z - p_z)            (> 0: the ground pushes the corner up)
//!                                   H = -k1_h (p_x - a_x - anchor)   (only while N acts; anchored where it landed)
//!   M q'' = Q + sum G' (H, N)       m2_h a_x'' = -m2_h a_g - H - k2_h a_x - c_h a_x'
//!                                   m2_v a_z'' = -m2_v a_v - N - k2_v a_z - c_v a_z'
//! ```
//!
//! A corner whose horizontal spring would throw it up, however little it presses, slides: what
//! Coulomb's law tends to as friction grows,
//!
//! ```text
//!   H = +-mu k1_v (d + tau d'),     d = a_z - p_z;     tau = 2 sqrt(m_eff/(mu k1_v)): the force that keeps it down is damped critically
//! ```
//!
//! until it comes to a stop. So does one that lands flat, from its touch on (`lands_flat`). The law
//! of the rigid body's feet (`dynamics::fem`), p the corner's displacement. Gravity acts on the
//! frame only, so that an open absorber rests at zero.

use nalgebra::DVector;

use crate::{
    frame::{EquilibriumError, Frame, StrainRates, Support},
    mechanics::Mechanics,
};
use dynamics::spring::{Chain, Springs};

/// How a corner meets its springs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CornerState {
    /// Whether it is on the ground.
    pub closed: bool,
    /// Whether its horizontal spring holds.
    pub holds: bool,
    /// Where its horizontal spring is anchored (m).
    pub anchor: f64,
    /// Direction of the horizontal force on a corner that slides, 1 or -1; zero of others.
    pub drag: f64,
}

/// mu of a corner that slides.
const FRICTION: f64 = 100.0;

/// A corner lands flat if this share of its fall, or less, is left once it has stopped across.
const FLAT: f64 = 0.5;

impl CornerState {
    /// In the air.
    pub(crate) const OPEN: Self = Self { closed: false, holds: false, anchor: 0.0, drag: 0.0 };
    /// On the ground since the structure was built.
    pub(crate) const STANDING: Self = Self { closed: true, holds: true, anchor: 0.0, drag: 0.0 };
}

/// Frame and springs, ready to compute with.
#[derive(Debug)]
pub(super) struct ElasticModel<'a> {
    pub frame: &'a Frame,
    /// Under each corner.
    pub units: &'a [Springs<Chain>],
    /// Number of the frame's coordinates, and with the absorbers.
    pub n: usize,
    pub size: usize,
    /// tau of each corner (s).
    damping: Vec<f64>,
}

/// Index of a corner's horizontal absorber displacement; the vertical one follows.
#[inline(always)]
pub(super) fn absorber(n: usize, corner: usize) -> usize {
    n + 2 * corner
}

impl<'a> ElasticModel<'a> {
    pub(crate) fn new(frame: &'a Frame, units: &'a [Springs<Chain>]) -> Self {
        let n = frame.size();
        let tau = |i: usize| {
            2.0 * (frame.effective_mass(i)[1] / (FRICTION * units[i].vertical.k1)).sqrt()
        };
        Self {
            frame,
            units,
            n,
            size: n + 2 * units.len(),
            damping: (0..units.len()).map(tau).collect(),
        }
    }

    /// What a sliding corner's horizontal force is of its vertical one, where that changes by
    /// itself and by its rate.
    pub(crate) fn dragged(&self, i: usize, foot: &CornerState) -> [f64; 2] {
        let drag = if foot.closed && !foot.holds { FRICTION * foot.drag } else { 0.0 };
        [drag, drag * self.damping[i]]
    }

    /// The direction of the force that brakes a corner that lands so flat that its horizontal
    /// spring would take most of its fall, or throw it up; `None` if it does not, or its footing
    /// turns about another.
    pub(crate) fn lands_flat(
        &self,
        i: usize,
        feet: &[CornerState],
        q: &[f64],
        v: &[f64],
    ) -> Option<f64> {
        let nodes = self.frame.footing_nodes();
        if feet.iter().zip(nodes).any(|(foot, node)| foot.closed && *node == nodes[i]) {
            return None;
        }
        let (slip, fall) = (self.sliding(i, q, v), -self.compression_rate(i, q, v));
        let [wx, wxz, _] = self.frame.mobility(i, q);
        // both downwards: it falls, and what of that is left once it has stopped across
        (fall - wxz / wx * slip > FLAT * fall).then(|| -slip.signum())
    }

    /// Velocity at which a corner slides over its horizontal absorber (m/s).
    pub(crate) fn sliding(&self, i: usize, q: &[f64], v: &[f64]) -> f64 {
        let place = &self.frame.places()[i];
        place.velocity(&place.reach(q), v)[0] - v[absorber(self.n, i)]
    }

    /// Horizontal force on a closed corner.
    #[inline(always)]
    fn across(
        &self,
        i: usize,
        foot: &CornerState,
        (x, compression): (f64, f64),
        q: &[f64],
        v: &[f64],
    ) -> f64 {
        let Springs { vertical, horizontal } = &self.units[i];
        if foot.holds {
            return horizontal.k1 * (q[absorber(self.n, i)] + foot.anchor - x);
        }
        if foot.drag == 0.0 {
            return 0.0;
        }
        let [of_force, of_rate] = self.dragged(i, foot);
        vertical.k1 * (of_force * compression + of_rate * self.compression_rate(i, q, v))
    }

    /// Forces of the ground on a corner (H, N) at q, q'.
    #[inline(always)]
    pub(crate) fn contact(&self, i: usize, foot: &CornerState, q: &[f64], v: &[f64]) -> [f64; 2] {
        if !foot.closed {
            return [0.0; 2];
        }
        let [x, z] = self.frame.places()[i].reach(q).place;
        let compression = q[absorber(self.n, i) + 1] - z;
        [self.across(i, foot, (x, compression), q, v), self.units[i].vertical.k1 * compression]
    }

    /// Compression of a corner's gap: positive when it presses (m).
    #[inline(always)]
    pub(crate) fn compression(&self, i: usize, q: &[f64]) -> f64 {
        q[absorber(self.n, i) + 1] - self.frame.places()[i].reach(q).place[1]
    }

    /// Its rate (m/s).
    pub(crate) fn compression_rate(&self, i: usize, q: &[f64], v: &[f64]) -> f64 {
        let place = &self.frame.places()[i];
        v[absorber(self.n, i) + 1] - place.velocity(&place.reach(q), v)[1]
    }

    /// The anchor that leaves a corner's horizontal spring without force where it stands now (m).
    pub(crate) fn anchor_here(&self, i: usize, q: &[f64]) -> f64 {
        self.frame.places()[i].reach(q).place[0] - q[absorber(self.n, i)]
    }

    /// Forces on all coordinates.
    pub(crate) fn forces(
        &self,
        q: &[f64],
        v: &[f64],
        feet: &[CornerState],
        ground: [f64; 2],
        out: &mut [f64],
    ) {
        let n = self.n;
        let state = (&q[..n], &v[..n]);
        self.frame.forces(state, StrainRates::OfVelocities, ground, &mut out[..n]);
        for (i, (foot, Springs { vertical, horizontal })) in feet.iter().zip(self.units).enumerate()
        {
            let at = absorber(n, i);
            let (mut h, mut p) = (0.0, 0.0);
            if foot.closed {
                let place = &self.frame.places()[i];
                let reach = place.reach(q);
                let compression = q[at + 1] - reach.place[1];
                p = vertical.k1 * compression;
                h = self.across(i, foot, (reach.place[0], compression), q, v);
                place.push(&reach, [h, p], out);
            }
            out[at] =
                -(h + horizontal.m2 * ground[0] + horizontal.k2 * q[at] + horizontal.c * v[at]);
            out[at + 1] =
                -(p + vertical.m2 * ground[1] + vertical.k2 * q[at + 1] + vertical.c * v[at + 1]);
        }
    }

    /// Masses of an absorber's two coordinates (kg).
    pub(crate) fn absorber_masses(&self, i: usize) -> [f64; 2] {
        [self.units[i].horizontal.m2, self.units[i].vertical.m2]
    }

    /// out = M a.
    pub(crate) fn momentum(&self, a: &[f64], out: &mut [f64]) {
        let n = self.n;
        self.frame.momentum(&a[..n], &mut out[..n]);
        for i in 0..self.units.len() {
            let (at, [h, v]) = (absorber(n, i), self.absorber_masses(i));
            (out[at], out[at + 1]) = (h * a[at], v * a[at + 1]);
        }
    }

    /// Kinetic, gravitational and elastic energy (J).
    pub(crate) fn energy(&self, q: &[f64], v: &[f64], feet: &[CornerState]) -> f64 {
        let n = self.n;
        let mut twice = 0.0;
        for (i, (foot, Springs { vertical, horizontal })) in feet.iter().zip(self.units).enumerate()
        {
            let at = absorber(n, i);
            twice += horizontal.m2 * v[at] * v[at] + vertical.m2 * v[at + 1] * v[at + 1];
            twice += horizontal.k2 * q[at] * q[at] + vertical.k2 * q[at + 1] * q[at + 1];
            let [h, p] = self.contact(i, foot, q, v);
            let held = if foot.holds { h * h / horizontal.k1 } else { 0.0 };
            twice += held + p * p / vertical.k1;
        }
        self.frame.kinetic_energy(&v[..n]) + self.frame.stored(&q[..n]) + 0.5 * twice
    }

    /// Power of the ground's motion (W).
    pub(crate) fn input_power(&self, v: &[f64], [ground, up]: [f64; 2]) -> f64 {
        let mut power = self.frame.fed(&v[..self.n], [ground, up]);
        for i in 0..self.units.len() {
            let (at, [h, z]) = (absorber(self.n, i), self.absorber_masses(i));
            power -= h * v[at] * ground + z * v[at + 1] * up;
        }
        power
    }

    /// Power that dashpots and sliding take (W).
    pub(crate) fn dissipation(&self, q: &[f64], v: &[f64], feet: &[CornerState]) -> f64 {
        let mut power = self.frame.dissipated(&q[..self.n], &v[..self.n]);
        for (i, (unit, foot)) in self.units.iter().zip(feet).enumerate() {
            let at = absorber(self.n, i);
            power += unit.horizontal.c * v[at] * v[at] + unit.vertical.c * v[at + 1] * v[at + 1];
            if foot.closed && !foot.holds && foot.drag != 0.0 {
                power -= self.contact(i, foot, q, v)[0] * self.sliding(i, q, v);
            }
        }
        power
    }

    /// Stiffness under each corner, standing.
    pub(crate) fn supports(&self) -> Vec<Support> {
        self.units
            .iter()
            .map(|unit| Some([unit.horizontal.in_series(), unit.vertical.in_series()]))
            .collect()
    }

    /// Standing still on all corners.
    pub(crate) fn standing(&self) -> Result<(Vec<f64>, Vec<CornerState>), EquilibriumError> {
        let feet = vec![CornerState::STANDING; self.units.len()];
        Ok((self.settle(&self.frame.standing(&self.supports())?, &feet), feet))
    }

    /// Held at a lean on the last corner, or the first.
    pub(crate) fn leaning(
        &self,
        lean: f64,
    ) -> Result<(Vec<f64>, Vec<CornerState>), EquilibriumError> {
        let frame = self.frame.leaning(lean, &self.supports())?;
        let mut feet = vec![CornerState::OPEN; self.units.len()];
        let pivot = if lean > 0.0 { feet.last_mut() } else { feet.first_mut() };
        if let Some(pivot) = pivot {
            *pivot = CornerState::STANDING;
        }
        let q = self.settle(&frame, &feet);
        // a lean of less than the settlement leaves other corners in the ground, and then they
        // press too
        for (i, foot) in feet.iter_mut().enumerate() {
            if !foot.closed && self.compression(i, &q) > 0.0 {
                *foot = CornerState { anchor: self.anchor_here(i, &q), ..CornerState::STANDING };
            }
        }
        Ok((q, feet))
    }

    /// The frame at q, absorbers under what they carry.
    pub(crate) fn settle(&self, frame: &DVector<f64>, feet: &[CornerState]) -> Vec<f64> {
        let mut q = frame.as_slice().to_vec();
        for ((foot, unit), corner) in feet.iter().zip(self.units).zip(self.frame.places()) {
            let [x, z] = corner.reach(frame.as_slice()).place;
            let share = |chain: &Chain| chain.k1 / (chain.k1 + chain.k2);
            let along = if foot.closed && foot.holds {
                (x - foot.anchor) * share(&unit.horizontal)
            } else {
                0.0
            };
            q.extend([along, if foot.closed { z * share(&unit.vertical) } else { 0.0 }]);
        }
        q
    }
}
