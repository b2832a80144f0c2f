//! The rigid rotation of a structure: that of a footing or, where feet are points, of the line
//! between the outer feet.

use super::Frame;

/// Rotation of a base at which a structure has fallen over (rad), a rigid body as well.
pub const FALLEN: f64 = 1.0;

/// What rotates rigidly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// A footing, by its node.
    Footing(usize),
    /// The line from the first corner to the last.
    Feet,
}

impl Base {
    /// Those of a frame, from left to right; none if it has no corners.
    pub(crate) fn all(frame: &Frame) -> Vec<Self> {
        let mut bases = Vec::new();
        for (corner, &node) in frame.places().iter().zip(frame.footing_nodes()) {
            let base = if corner.rotation().is_some() { Self::Footing(node) } else { Self::Feet };
            if !bases.contains(&base) {
                bases.push(base);
            }
        }
        bases
    }

    /// Its clockwise rotation (rad).
    pub fn rotation(self, frame: &Frame, q: &[f64]) -> f64 {
        self.motion(frame, q).1
    }

    /// Unstressed origin, displacement of it, rotation.
    fn motion(self, frame: &Frame, q: &[f64]) -> ([[f64; 2]; 2], f64) {
        match self {
            Self::Footing(node) => {
                let [x, z, th] = frame.displacement(node, q);
                ([frame.centre(node), [x, z]], th)
            }
            Self::Feet => {
                let ends = [frame.places().first(), frame.places().last()].map(|end| {
                    end.map_or(([0.0; 2], [0.0; 2]), |end| (end.unstressed, end.reach(q).place))
                });
                let [(p, u), (r, w)] = ends;
                let middle = [0, 1].map(|k| 0.5 * (p[k] + r[k]));
                let moved = [0, 1].map(|k| 0.5 * (u[k] + w[k]));
                let (dx, dz) = (r[0] + w[0] - p[0] - u[0], r[1] + w[1] - p[1] - u[1]);
                ([middle, moved], (-dz).atan2(dx))
            }
        }
    }

    /// Mean horizontal displacement of its corners (m): feet that land elsewhere than they stood.
    pub fn feet_moved(self, frame: &Frame, q: &[f64]) -> f64 {
        let own = |node: usize| matches!(self, Self::Feet) || self == Self::Footing(node);
        let corners =
            frame.places().iter().zip(frame.footing_nodes()).filter(|(_, node)| own(**node));
        let (sum, count) = corners
            .fold((0.0, 0), |(sum, count), (place, _)| (sum + place.reach(q).place[0], count + 1));
        sum / f64::from(count.max(1))
    }

    /// A node's displacement relative to what rotates rigidly with the base, in the base's axes:
    /// across and along (m).
    pub fn drift(self, frame: &Frame, node: usize, q: &[f64]) -> [f64; 2] {
        let ([origin, moved], th) = self.motion(frame, q);
        let (at, [x, z, _]) = (frame.centre(node), frame.displacement(node, q));
        let arm = [0, 1].map(|k| at[k] - origin[k]);
        let now = [arm[0] + x - moved[0], arm[1] + z - moved[1]];
        let (sin, cos) = th.sin_cos();
        [now[0] * cos - now[1] * sin - arm[0], now[0] * sin + now[1] * cos - arm[1]]
    }
}

impl Frame {
    /// Whether it has fallen over, or flies apart as no structure does: a base has turned by 1 rad,
    /// or a node has moved by more than the structure is large ([`Frame::span`]).
    pub fn has_fallen(&self, q: &[f64]) -> bool {
        let size = self.span();
        let far = |node: usize| {
            let [x, z, _] = self.displacement(node, q);
            beyond(x.hypot(z), size)
        };
        self.has_turned(FALLEN, q) || (0..self.nodes()).any(far)
    }

    /// Whether a base has turned by an angle or more, to either side (rad).
    pub fn has_turned(&self, angle: f64, q: &[f64]) -> bool {
        Base::all(self).into_iter().any(|base| beyond(base.rotation(self, q).abs(), angle))
    }

    /// Rotation at which the centre of mass stands above a corner of its narrowest base (rad):
    /// arctan of half that base's width over the height of all mass. Infinite without corners.
    pub fn topples_at(&self) -> f64 {
        let mass = |node: usize| self.bodies[node].index[0];
        let mass = |node: usize| self.mass.get((mass(node), mass(node))).copied().unwrap_or(0.0);
        let height = |node: usize| mass(node) * self.centre(node)[1];
        let nodes = || 0..self.nodes();
        let mean = nodes().map(height).sum::<f64>() / nodes().map(mass).sum::<f64>();
        let of = |base: Base| {
            let own = |node: usize| base == Base::Feet || base == Base::Footing(node);
            let corners = self.corners.iter().zip(&self.footings).filter(|(_, node)| own(**node));
            let places: Vec<[f64; 2]> = corners.map(|(corner, _)| corner.unstressed).collect();
            let sole = places.iter().map(|[_, z]| *z).fold(f64::INFINITY, f64::min);
            let [left, right] = [f64::INFINITY, f64::NEG_INFINITY];
            let (left, right) = places
                .iter()
                .fold((left, right), |(left, right), [x, _]| (left.min(*x), right.max(*x)));
            (0.5 * (right - left) / (mean - sole)).atan()
        };
        Base::all(self).into_iter().map(of).fold(f64::INFINITY, f64::min)
    }
}

/// Whether a magnitude has come to a limit, or is no number.
fn beyond(magnitude: f64, limit: f64) -> bool {
    magnitude.is_nan() || magnitude >= limit
}
