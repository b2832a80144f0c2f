//! Forces of a body on friction while both its feet press: it stands or slides upright.
//!
//! ```text
//!   F = H_left + H_right, N = N_left + N_right    of the springs
//!   N_left = (N + F h/b)/2, N_right = (N - F h/b)/2    statics: a foot's spring rings when a slip stops
//!   sliding, |F| = mu N:  H = F N_foot/N    else H as the springs share it, within mu N_foot
//! ```

use super::ground_row::GroundRow;
use rocking::{
    members::Friction,
    structure::{Body, Kind},
};

/// A share of mu N within which a body slides.
const SLIDES: f64 = 1e-6;

/// The forces of feet (H, N) on springs (N), as statics part them; none of a foot in the air.
pub(super) fn upright(
    kind: Kind,
    body: &Body<f64>,
    friction: Friction,
    feet: [[f64; 2]; 2],
) -> Option<GroundRow> {
    let [[left_h, left_n], [right_h, right_n]] = feet;
    if left_n.min(right_n) <= 0.0 {
        return None;
    }
    let (f, n) = (left_h + right_h, left_n + right_n);
    // all on one foot, it is about to lift
    let apart = (f * body.height / body.half_width).clamp(-n, n);
    let [left_n, right_n] = [0.5 * (n + apart), 0.5 * (n - apart)];
    let most = friction.coefficient * n;
    let left_h = if f.abs() >= (1.0 - SLIDES) * most {
        f * left_n / n
    } else {
        // what one foot cannot hold, the other does
        let [left, right] = [left_n, right_n].map(|n| friction.coefficient * n);
        left_h.clamp(-left, left).clamp(f - right, f + right)
    };
    Some(GroundRow::new(kind, body, 0.0, [[left_h, left_n], [f - left_h, right_n]]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::{scalar::GRAVITY, structure::Structure};

    const FRICTION: Friction = Friction { coefficient: 0.2 };

    /// A sliding frame by hand: F = mu W, N = W/2 (1 +- mu h/b), H = mu N on each foot; a leg's
    /// moment at the apex is (mu h - b) N, less one's where the foot is the other.
    #[test]
    fn a_sliding_frame_bears_what_statics_say() {
        let frame = Structure::a_frame(6.0, 3.0, 1e4).unwrap();
        let (body, w) = (frame.body::<f64>(), 1e4 * GRAVITY);
        // springs that ring: the feet exchange a hundredth of the weight
        let ringing = [[0.2 * 0.91 * w, 0.91 * w], [0.2 * 0.09 * w, 0.09 * w]];
        let row = upright(Kind::AFrame, &body, FRICTION, ringing).unwrap();
        let near =
            |found: f64, due: f64| assert!((found / due - 1.0).abs() < 1e-9, "{found} {due}");
        near(row.largest(0), 0.2 * w);
        near(row.largest(4), 0.9 * w);
        near(row.largest(5), 0.2 * 0.9 * w);
        near(row.largest(2).abs(), (1.5 - 0.2 * 6.0) * 0.9 * w);
        let length = 6.0_f64.hypot(1.5);
        near(-row.largest(3), 0.9 * w * (6.0 + 0.2 * 1.5) / length);
    }

    /// A block that holds: its corners stay within mu N, and bear the push and its moment.
    #[test]
    fn a_block_that_holds_bears_its_push_within_its_friction() {
        let block = Structure::block(1.8, 0.8, 1e3).unwrap();
        let (body, w) = (block.body::<f64>(), 1e3 * GRAVITY);
        let f = 0.19 * w;
        let feet = [[0.5 * f, 0.6 * w], [0.5 * f, 0.4 * w]];
        let row = upright(Kind::Block, &body, FRICTION, feet).unwrap();
        for [h, n] in row.corners {
            assert!(h.abs() <= 0.2 * n * (1.0 + 1e-12), "{h} {n}");
        }
        let [shear, moment, axial] = [0, 2, 3].map(|k| row.largest(k));
        assert!((shear / f - 1.0).abs() < 1e-12 && (axial / -w - 1.0).abs() < 1e-12);
        assert!((moment / (f * 0.9) - 1.0).abs() < 1e-12, "{moment}");
        assert!(upright(Kind::Block, &body, FRICTION, [[f, w], [0.0; 2]]).is_none());
    }
}
