//! The iteration of a body that turns about its foot.
//!
//! Stiff springs hold the foot, not the body, and while the body turns the lever between both turns
//! with it: a matrix taken half way pushes the body aside with Omega^2 for each unit by which
//! another stage's lever differs. In the foot's place (p_x, p_z) instead of the body's (X, Z) the
//! springs are the same at all stages,
//!
//! ```text
//!   d(p_x, p_z) = d(X', Z') + L d_theta       d(X', Z') = d(X, Z) + D_i d_theta       r'_theta = r_theta - D_i . (r_X, r_Z)
//! ```
//!
//! with L = dp/dtheta where the matrix is taken and D_i = dp/dtheta at stage i - L: so the matrix
//! solves for (X', Z', theta), whose displacements at the stages are h^2 A^2 times their
//! accelerations, as those of (X, Z, theta) are. The forces in it are those at the step's start:
//! half way along the tangent stiff springs carry a million times the weight. What the iteration
//! still leaves is a turn about the foot, of the order of the turn within the step and of no
//! stiffness: no force comes of it, and it need not be smaller than a share of what a step may
//! miss.

use super::{
    contact::FootForce,
    radau::{A2, A2_INV},
};

/// The foot that a body turns about while it takes a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turning {
    pub foot: usize,
    /// What a turn counts in an iteration's correction, over what a displacement of the foot does.
    pub weight: f64,
}

/// The feet's forces at a step's start and their levers half way, from what they are at both.
#[inline(always)]
pub(super) fn contact([start, middle]: [[FootForce; 2]; 2]) -> [FootForce; 2] {
    let at = |i: usize| FootForce { px_th: middle[i].px_th, pz_th: middle[i].pz_th, ..start[i] };
    [at(0), at(1)]
}

/// What is left of the moment at a stage where the lever differs by `turned`.
#[inline(always)]
pub(super) fn moment([x, z, th]: [f64; 3], turned: [f64; 2]) -> f64 {
    th - (x * turned[0] + z * turned[1])
}

/// What of a coordinate's accelerations at the stages comes from the turn, whose own are `th`,
/// where the levers differ by `turned`.
#[inline(always)]
pub(super) fn carried(th: [f64; 3], turned: [f64; 3]) -> [f64; 3] {
    let at = |i: usize| (th[0] * A2[i][0] + th[1] * A2[i][1] + th[2] * A2[i][2]) * turned[i];
    let places = [at(0), at(1), at(2)];
    A2_INV.map(|[a, b, c]| places[0] * a + places[1] * b + places[2] * c)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        fem::{
            model::{Model, N, Pose, TH, X, Z},
            radau::C,
            step::{Ground, NO_GUESS, Request, Stages, Stepper},
        },
        spring::{Design, Springs},
    };
    use rocking::{scalar::GRAVITY, structure::Structure};

    /// The paper's frame turns about its right foot by 0.02 rad in a step: iterations until the
    /// foot's place is known to a thousandth of the springs' compression, and by how much the
    /// equations of motion then fail at the stages, over the weight.
    fn iterations(hz: f64, turns: bool) -> Option<(usize, f64)> {
        let body = Structure::paper().body::<f64>();
        let chain = Design::from_kc(0.5, 0.2, 0.92, hz);
        let model =
            Model::new(&body, &Springs { vertical: chain, horizontal: chain }.chains(body.mass));
        let (mut state, feet) = model.on_one_foot(0.03);
        let Pose { sin, cos } = Pose::of(&state.q);
        let (_, _, px_th, pz_th) = model.foot(1, &state.q, sin, cos);
        let rate = 0.2;
        (state.v[X], state.v[Z], state.v[TH]) = (-px_th * rate, -pz_th * rate, rate);
        let compression = body.mass * GRAVITY / model.springs.vertical.k1;
        let request = Request {
            h: 0.1,
            ground: Ground { start: [1.0, 0.0], slope: [-5.0, 0.0], curve: [0.0; 2] },
            guess: [NO_GUESS; 3],
            tolerance: 1e-3 * compression,
            rate: 1.0,
            turning: turns.then_some(Turning { foot: 1, weight: 1e-3 }),
        };
        let mut stages = Stages::none();
        if !Stepper::new(&model).step(&state, &feet, &request, &mut stages) {
            return None;
        }
        let masses = model.masses(&feet);
        let mut worst: f64 = 0.0;
        for (i, c) in C.into_iter().enumerate() {
            let forces =
                model.forces(&stages.q[i], &stages.v[i], &feet, request.ground.after(request.h, c));
            for k in 0..N {
                let length = if k == TH { body.radius() } else { 1.0 };
                worst = worst.max(((forces[k] - masses[k] * stages.a[i][k]) / length).abs());
            }
        }
        Some((stages.iterations, worst / (body.mass * GRAVITY)))
    }

    #[test]
    fn springs_of_any_stiffness_take_as_few_iterations_and_leave_no_force() {
        for hz in [100.0, 1e3, 1e4, 3e4] {
            let (count, force) = iterations(hz, true).unwrap();
            assert!(count <= 3 && force < 1e-3, "{hz} Hz: {count} {force}");
            assert!(iterations(hz, false).is_none_or(|(plain, _)| plain > 2 * count), "{hz} Hz");
        }
    }
}
