//! What the ground gives a rigid body at one instant, and what its legs or its base bear.

use frames::design_forces::ForcesTogether;
use results::CornerForce;
use rocking::{
    motion::TimedPeak,
    structure::{Body, Kind},
};

/// Column shear, moment and axial force: of a block about its base, of an A-frame's legs at the
/// apex.
type ForceRow = [f64; 3];

/// How many forces are told: see [`GroundRow::largest`].
pub(super) const FORCES: usize = 6;
const CORNER_VERTICAL: usize = 4;
const CORNER_HORIZONTAL: usize = 5;

/// Forces at one instant.
#[derive(Clone, Copy)]
pub(super) struct GroundRow {
    /// Whether all are known: not of a body of which one knows what it presses with alone.
    pub whole: bool,
    /// Whether both feet bear.
    pub stands: bool,
    /// On the body, horizontally (N).
    pub sole_shear: f64,
    /// Of the ground on the left corner and on the right one: (H, N) (N).
    pub corners: [[f64; 2]; 2],
    /// Of the left leg and of the right one; of a block the same twice.
    pub legs: [ForceRow; 2],
}

impl GroundRow {
    /// For forces (H, N) of the left and the right foot of a body that leans by theta.
    pub fn new(kind: Kind, body: &Body<f64>, theta: f64, feet: [[f64; 2]; 2]) -> Self {
        let [[left_h, left_n], [right_h, right_n]] = feet;
        let sole_shear = left_h + right_h;
        if kind == Kind::Block {
            let moment = (left_n - right_n) * body.half_width;
            let row = [sole_shear, moment, -(left_n + right_n)];
            return Self { whole: true, stands: false, sole_shear, corners: feet, legs: [row; 2] };
        }
        let (sin, cos) = theta.sin_cos();
        let legs = [(-1.0, feet[0]), (1.0, feet[1])].map(|(side, [h, n])| {
            // from the mass to the foot, turned clockwise with the body
            let (x, z) = (side * body.half_width, -body.height);
            let (dx, dz) = (x * cos + z * sin, z * cos - x * sin);
            let length = body.radius();
            let moment = h * dz - n * dx;
            [moment / length, moment, (h * dx + n * dz) / length]
        });
        Self { whole: true, stands: false, sole_shear, corners: feet, legs }
    }

    /// Pressed by n (N) on the foot of a side (1: right), what is across it not known.
    pub fn pressing(kind: Kind, body: &Body<f64>, side: f64, n: f64) -> Self {
        let feet = if side > 0.0 { [[0.0; 2], [0.0, n]] } else { [[0.0, n], [0.0; 2]] };
        if kind == Kind::AFrame {
            let along = [0.0, 0.0, -n * body.height / body.radius()];
            let legs = [along; 2];
            return Self { whole: false, stands: false, sole_shear: 0.0, corners: feet, legs };
        }
        Self { whole: false, ..Self::new(kind, body, 0.0, feet) }
    }

    /// The same of a body that leans by theta, with what the dashpot of the corner in the air (0
    /// left, 1 right) does, d (N, upwards): a frame's leg there bears it alone; a block's base
    /// bears d b the more where it pulls down.
    pub fn hung(
        mut self,
        kind: Kind,
        body: &Body<f64>,
        (corner, d): (usize, f64),
        theta: f64,
    ) -> Self {
        let mut feet = [[0.0; 2]; 2];
        feet[corner][1] = if kind == Kind::Block { d.min(0.0) } else { d };
        let hanging = Self::new(kind, body, theta, feet).legs;
        match kind {
            Kind::AFrame => self.legs[corner] = hanging[corner],
            Kind::Block => {
                self.legs = [std::array::from_fn(|k| self.legs[0][k] + hanging[0][k]); 2];
            }
        }
        self
    }

    /// The leg where a force of a leg is the larger one: 0 shear, 1 moment, 2 axial force.
    fn leg(&self, force: usize) -> ForceRow {
        let [left, right] = self.legs;
        if left[force].abs() >= right[force].abs() { left } else { right }
    }

    /// The corner where a force of the ground is the larger one: 0 horizontal, 1 vertical.
    fn corner_of(&self, part: usize) -> [f64; 2] {
        let [left, right] = self.corners;
        if left[part].abs() >= right[part].abs() { left } else { right }
    }

    /// Shear at the sole (0), column shear (1), moment (2), axial force (3), at one corner vertical
    /// (4) and horizontal (5) force of the ground.
    pub fn largest(&self, k: usize) -> f64 {
        match k {
            0 => self.sole_shear,
            CORNER_VERTICAL => self.corner_of(1)[1],
            CORNER_HORIZONTAL => self.corner_of(0)[0],
            k => self.leg(k - 1)[k - 1],
        }
    }

    /// Both forces of the corner of the same, if it is one's.
    pub fn corner(&self, k: usize) -> Option<CornerForce> {
        let part = match k {
            CORNER_VERTICAL => 1,
            CORNER_HORIZONTAL => 0,
            _ => return None,
        };
        let [horizontal_n, vertical_n] = self.corner_of(part);
        Some(CornerForce { horizontal_n, vertical_n })
    }

    /// Raise the peaks of the same to what they are at a time (s).
    pub fn raise(&self, time: f64, peaks: &mut [TimedPeak; FORCES]) {
        for (k, peak) in peaks.iter_mut().enumerate() {
            *peak = peak.larger(TimedPeak { value: self.largest(k), time });
        }
    }

    /// What acts together with the same; with forces of the ground, in the leg that bears the
    /// larger axial force.
    pub fn together(&self, kind: Kind, k: usize) -> ForcesTogether {
        let [column_shear_n, moment, axial_n] =
            self.leg(if (1..=3).contains(&k) { k - 1 } else { 2 });
        let (column_base_moment_nm, apex_moment_nm) = match kind {
            Kind::Block => (moment, None),
            Kind::AFrame => (0.0, Some(moment)),
        };
        ForcesTogether { column_shear_n, axial_n, column_base_moment_nm, apex_moment_nm }
    }
}

/// Forces of the left foot and of the right one of a standing body of this weight (N), over a
/// ground of a_g/g and gamma.
pub(super) fn standing_feet(
    body: &Body<f64>,
    weight: f64,
    (ground, gamma): (f64, f64),
) -> [[f64; 2]; 2] {
    let (f, n) = (weight * ground, weight * gamma);
    let apart = f * body.height / body.half_width;
    [[0.5 * f, 0.5 * (n + apart)], [0.5 * f, 0.5 * (n - apart)]]
}
