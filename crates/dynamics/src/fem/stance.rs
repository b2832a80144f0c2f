//! Where the body stands at first: settled on both feet, or leaning on one.

use super::model::{Contact, Foot, Model, N, State, TH, X, Z, ax, az};
use crate::{fem::model::Pose, spring::Springs};
use rocking::scalar::{GRAVITY, sin_cos};

/// Iterations after which a body leaning under a tendon has no place; a handful is needed.
const MOST_ITERATIONS: usize = 40;

impl Model {
    /// The body standing still on both feet under its weight, each foot on half of it.
    pub(crate) fn settled(&self) -> (State, [Foot; 2]) {
        let pretension = self.elements.tendon.map_or(0.0, |tendon| tendon.pretension);
        self.stand(self.body.mass * GRAVITY + pretension)
    }

    /// The body standing still under a load on its mass (N), downwards.
    pub(crate) fn stand(&self, load: f64) -> (State, [Foot; 2]) {
        let half_weight = load * 0.5;
        let absorber = -half_weight / self.springs.vertical.k2;
        let mut q = [0.0; N];
        q[az(0)] = absorber;
        q[az(1)] = absorber;
        q[Z] = absorber - half_weight / self.springs.vertical.k1;
        let foot = Foot { contact: Contact::Stick, anchor: 0.0 };
        (State { q, v: [0.0; N] }, [foot; 2])
    }

    /// The body at rest leaning by theta on one foot, whatever the other does. The pressing foot's
    /// chains carry what they carry while a rigid body falls back from there, so that no vibration
    /// is started,
    ///
    /// ```text
    ///   theta'' = -m g R sin(alpha - theta) / I0      H = m X''      N = m (g + Z'')
    /// ```
    pub(crate) fn on_one_foot(&self, theta: f64) -> (State, [Foot; 2]) {
        if self.elements.tendon.is_some() {
            return self.lean_under_tendon(theta);
        }
        let side = if theta > 0.0 { 1.0 } else { -1.0 };
        let pressing = usize::from(theta > 0.0);
        let Springs { vertical, horizontal } = &self.springs;
        let (weight, radius) = (self.body.mass * GRAVITY, self.body.radius());
        let lean = self.body.alpha() - theta * side;
        let inertia = self.rotation + self.translation * radius * radius;
        let thrust = self.translation * radius * weight * radius * lean.sin() / inertia;
        let (h, n) = (-side * thrust * lean.cos(), weight - thrust * lean.sin());

        let (sin, cos) = sin_cos(theta);
        let mut q = [0.0; N];
        q[TH] = theta;
        q[ax(pressing)] = -h / horizontal.k2;
        q[az(pressing)] = -n / vertical.k2;
        let (px, pz, ..) = self.foot(pressing, &q, sin, cos);
        q[X] = -px;
        q[Z] = q[az(pressing)] - n / vertical.k1 - pz;
        let mut feet = [Foot { contact: Contact::Open, anchor: 0.0 }; 2];
        feet[pressing] =
            Foot { contact: Contact::Stick, anchor: h / horizontal.k1 - q[ax(pressing)] };
        (State { q, v: [0.0; N] }, feet)
    }

    /// At rest leaning by theta on one foot, pulled by the tendon, whose pull follows from the
    /// place and the place from it.
    fn lean_under_tendon(&self, theta: f64) -> (State, [Foot; 2]) {
        let pressing = usize::from(theta > 0.0);
        let Springs { vertical, horizontal } = &self.springs;
        let mut q = [0.0; N];
        q[TH] = theta;
        let mut feet = [Foot { contact: Contact::Open, anchor: 0.0 }; 2];
        for _ in 0..MOST_ITERATIONS {
            let (h, n) = self.falling_back(&q, pressing);
            q[ax(pressing)] = -h / horizontal.k2;
            q[az(pressing)] = -n / vertical.k2;
            feet[pressing] =
                Foot { contact: Contact::Stick, anchor: h / horizontal.k1 - q[ax(pressing)] };
            let Pose { sin, cos } = Pose::of(&q);
            let (px, pz, ..) = self.foot(pressing, &q, sin, cos);
            let (dx, dz) = (-px, q[az(pressing)] - n / vertical.k1 - pz);
            q[X] += dx;
            q[Z] += dz;
            if dx.hypot(dz) <= 1e-14 * self.body.radius() {
                return (State { q, v: [0.0; N] }, feet);
            }
        }
        // a run from nowhere is unstable from the start
        (State { q: [f64::NAN; N], v: [0.0; N] }, feet)
    }

    /// Force on the pressing foot, horizontal and vertical, while a rigid body falls back from rest
    /// under weight and tendon (N).
    fn falling_back(&self, q: &[f64; N], pressing: usize) -> (f64, f64) {
        let pull = self.elements.tendon.map_or([0.0; 2], |tendon| tendon.force_on_mass(q));
        let (gx, gz) = (pull[0], pull[1] - self.body.mass * GRAVITY);
        let Pose { sin, cos } = Pose::of(q);
        let (_, _, dz, minus_dx) = self.foot(pressing, q, sin, cos);
        let radius = self.body.radius();
        let (tx, tz) = (-minus_dx / radius, dz / radius);
        // the part of the load across the leg accelerates the body about its foot
        let across = gz * tx - gx * tz;
        let swing = self.translation * radius * radius;
        let thrust = across * swing / (self.rotation + swing);
        (-gx - thrust * tz, -gz + thrust * tx)
    }

    /// A start for free rocking: at rest `on_one_foot`; a lean of less than the settlement leaves
    /// the other foot in the ground, and then it presses too.
    pub(crate) fn leaning(&self, theta: f64) -> (State, [Foot; 2]) {
        let (mut state, mut feet) = self.on_one_foot(theta);
        for (i, foot) in feet.iter_mut().enumerate() {
            if !foot.closed() && self.compression(i, &state.q) > 0.0 {
                *foot = Foot { contact: Contact::Stick, anchor: self.anchor_here(i, &state.q) };
            }
        }
        // a body that finds no balance is told by the run (`in_balance`)
        let _ = self.turn_to_balance(&mut state, &feet);
        (state, feet)
    }
}
