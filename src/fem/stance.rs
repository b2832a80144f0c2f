//! Where the body stands at first: settled on both feet, or leaning on one.

use super::model::{Contact, Foot, Model, N, State, TH, X, Z, ax, az};
use crate::{
    scalar::{GRAVITY, Scalar, real, sin_cos},
    spring::Springs,
};

impl<S: Scalar> Model<S> {
    /// The body standing still on both feet under its weight, each foot on half of it.
    pub fn settled(&self) -> (State<S>, [Foot<S>; 2]) {
        match self.elements.is_empty() {
            true => self.stand_rigid(self.body.mass * GRAVITY),
            false => self.stand(S::zero()),
        }
    }

    /// The rigid body standing still under a load on its mass [N], downwards.
    pub fn stand_rigid(&self, load: S) -> (State<S>, [Foot<S>; 2]) {
        let half_weight = load * 0.5;
        let absorber = -half_weight / self.springs.vertical.k2;
        let mut q = [S::zero(); N];
        q[az(0)] = absorber;
        q[az(1)] = absorber;
        q[Z] = absorber - half_weight / self.springs.vertical.k1;
        let foot = Foot { contact: Contact::Stick, anchor: S::zero() };
        (State { q, v: [S::zero(); N] }, [foot; 2])
    }

    /// The body at rest leaning by theta on one foot, whatever the other does. The pressing foot's chains carry what they
    /// carry while a rigid body falls back from there, so that no vibration is started,
    ///
    /// ```text
    ///   theta'' = -m g R sin(alpha - theta) / I0      H = m X''      N = m (g + Z'')
    /// ```
    pub fn on_one_foot(&self, theta: S) -> (State<S>, [Foot<S>; 2]) {
        if !self.elements.is_empty() {
            return self.lean_with_elements(theta);
        }
        let side: S = real(if theta.re() > 0.0 { 1.0 } else { -1.0 });
        let pressing = usize::from(theta.re() > 0.0);
        let Springs { vertical, horizontal } = &self.springs;
        let (weight, radius) = (self.body.mass * GRAVITY, self.body.radius());
        let lean = self.body.alpha() - theta * side;
        let inertia = self.rotation + self.translation * radius * radius;
        let thrust = self.translation * radius * weight * radius * lean.sin() / inertia;
        let (h, n) = (-side * thrust * lean.cos(), weight - thrust * lean.sin());

        let (sin, cos) = sin_cos(theta);
        let mut q = [S::zero(); N];
        q[TH] = theta;
        q[ax(pressing)] = -h / horizontal.k2;
        q[az(pressing)] = -n / vertical.k2;
        let (px, pz, ..) = self.foot(pressing, &q, sin, cos);
        q[X] = -px;
        q[Z] = q[az(pressing)] - n / vertical.k1 - pz;
        let mut feet = [Foot { contact: Contact::Open, anchor: S::zero() }; 2];
        feet[pressing] = Foot { contact: Contact::Stick, anchor: h / horizontal.k1 - q[ax(pressing)] };
        (State { q, v: [S::zero(); N] }, feet)
    }

    /// A start for free rocking: at rest `on_one_foot`; a lean of less than the settlement leaves the other foot in the
    /// ground, and then it presses too.
    pub fn leaning(&self, theta: S) -> (State<S>, [Foot<S>; 2]) {
        let (mut state, mut feet) = self.on_one_foot(theta);
        for (i, foot) in feet.iter_mut().enumerate() {
            if !foot.closed() && self.compression(i, &state.q, foot).re() > 0.0 {
                *foot = Foot { contact: Contact::Stick, anchor: self.anchor_here(i, &state.q, foot) };
            }
        }
        // a body that finds no balance is told by the run (`in_balance`)
        let _ = self.turn_to_balance(&mut state, &feet);
        (state, feet)
    }
}
