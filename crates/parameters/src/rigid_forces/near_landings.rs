//! Forces of a body on springs near its landings, without what the springs add.

use super::ground_row::{GroundRow, standing_feet};
use dynamics::fem::{DAMPERS, Demands, History};
use rocking::{
    members::Members,
    regime,
    scalar::GRAVITY,
    structure::{Body, Kind},
};
use strong_motion::Record;

/// Forces near landings, at the other samples than `kept`, of a body that presses on the ground: m
/// (a_g, g + a_v) where both feet press and it can stand so, those of equation (1) where one does,
/// with a tendon and dampers if it has these, and what the dashpot of the corner in the air does,
/// which moves as the body does. With friction, or where both feet press under members, what m (g +
/// a_v) of a vertical motion presses with. A landing adds its impulse, which is not a design force.
pub(super) fn near_landings(
    (kind, body): (Kind, &Body<f64>),
    record: &Record,
    (history, demands): (&History, &Demands),
    kept: &[usize],
    members: Option<&Members>,
) -> Vec<(usize, GroundRow)> {
    let theta = &history.motion.theta;
    let row = |i: usize| {
        let [left, right] = demands.feet.get(i)?.map(|[_, n]| n);
        if left.max(right) <= 0.0 {
            return None;
        }
        let at = |record: &[f64]| record.get(i).copied().unwrap_or(0.0) / GRAVITY;
        let ground = (at(&record.accel), 1.0 + at(record.up()));
        let (side, weight) = (if right > left { 1.0 } else { -1.0 }, body.mass * GRAVITY);
        let [before, after] = [i.saturating_sub(1), (i + 1).min(theta.len() - 1)];
        let rate = (theta[after] - theta[before]) / ((after - before).max(1) as f64 * record.dt);
        let one = left.min(right) <= 0.0;
        if let Some(members) = members.filter(|members| members.act() && one) {
            let of = regime::forces_of_foot(body, members, side, (theta[i], rate), ground);
            let pivot = [of.0 * weight, of.1 * weight];
            let feet = match side > 0.0 {
                true => [[0.0, demands.at[i][DAMPERS[0]]], pivot],
                false => [pivot, [0.0, demands.at[i][DAMPERS[1]]]],
            };
            // a corner's bearing has the ground's force alone
            let corners = if side > 0.0 { [[0.0; 2], pivot] } else { [pivot, [0.0; 2]] };
            let row = GroundRow { corners, ..GroundRow::new(kind, body, theta[i], feet) };
            return (of.1 > 0.0).then_some((i, row));
        }
        if members.is_some() {
            let shaken = !record.up().is_empty() && ground.1 > 0.0;
            let pressed = if shaken { weight * ground.1 } else { 0.0 };
            let lifted = usize::from(side < 0.0);
            let of_damper = demands.at[i][DAMPERS[lifted]];
            let damper = Some(of_damper).filter(|force| *force != 0.0 && one);
            let row = GroundRow::pressing(kind, body, side, pressed);
            return (shaken || damper.is_some())
                .then(|| (i, row.hung(kind, body, (lifted, damper.unwrap_or(0.0)), theta[i])));
        }
        if left.min(right) > 0.0 && regime::stands(body, ground) {
            let feet = standing_feet(body, weight, ground);
            return Some((i, GroundRow::new(kind, body, theta[i], feet)));
        }
        let (f, n) = regime::forces(body, side, theta[i], rate, ground);
        let force = [f, n].map(|share| share * weight);
        let feet = if side > 0.0 { [[0.0; 2], force] } else { [force, [0.0; 2]] };
        (n > 0.0).then(|| (i, GroundRow::new(kind, body, theta[i], feet)))
    };
    let samples = theta.len().min(demands.feet.len());
    (0..samples).filter(|i| kept.binary_search(i).is_err()).filter_map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answers::compare_models;
    use dynamics::spring::{Design, Springs};
    use rocking::{members::Members, regime::ground_forces, structure::Structure};

    /// Near landings a block bears what its motion says, shear and axial force at one instant: the
    /// forces of Housner's body where a foot presses alone, those of a body that stands where both
    /// do; nothing in the air. With members: its weight under the vertical motion.
    #[test]
    fn near_landings_forces_are_those_of_the_motion() {
        let block = Structure::block(2.1, 0.45, 640.0).unwrap();
        let body = block.body::<f64>();
        let pulse = |i: usize| if i < 60 { 4.0 * (i as f64 / 20.0).min(1.0) } else { 0.0 };
        let up: Vec<f64> = (0..300).map(|i| 3.0 * (0.2 * f64::from(i)).sin()).collect();
        let record = Record::new("made up", 0.01, (0..300).map(pulse).collect()).unwrap();
        let record = record.with_vertical(Record::new("up", 0.01, up).unwrap()).unwrap();
        let design = Design::from_kc(0.3, 0.1, 0.75, 10240.0);
        let springs = Springs { vertical: design, horizontal: design }.chains(640.0);
        let both =
            compare_models(&body, body.restitution(), &springs, &Members::default(), &record);
        let of = (&both.fem, &both.demands);
        let housner = ground_forces(&body, (&record.accel, record.up()), &both.rocking);
        let weight = 640.0 * GRAVITY;
        let near = near_landings((Kind::Block, &body), &record, of, &[], None);
        let [mut rocked, mut stood] = [0; 2];
        for (i, row) in &near {
            let (f, n) = housner[*i];
            let found = [row.largest(0), -row.largest(3)];
            let due = if both.rocking.theta[*i].abs() > 1e-3 {
                rocked += 1;
                [f, n]
            } else if *i < 10 {
                stood += 1;
                [640.0 * record.accel[*i], 640.0 * (GRAVITY + record.up()[*i])]
            } else {
                continue;
            };
            let close = |k: usize| (found[k] - due[k]).abs() < 2e-2 * weight;
            assert!(close(0) && close(1), "{i} {found:?} {due:?}");
        }
        assert!(rocked > 50 && stood > 5, "{rocked} {stood}");
        let kept: Vec<usize> = (0..both.fem.motion.len()).filter(|i| *i != 30).collect();
        let tied =
            near_landings((Kind::Block, &body), &record, of, &kept, Some(&Members::default()));
        assert_eq!(tied.iter().map(|(i, _)| *i).collect::<Vec<_>>(), [30]);
        let least = 640.0 * (GRAVITY + record.up()[30]);
        assert!((tied[0].1.largest(3) / -least - 1.0).abs() < 1e-12);
        assert_eq!(tied[0].1.largest(0), 0.0);
    }

    /// Pressed by n on one foot, a block's base bears n b; of a frame's leg no moment is known, and
    /// its axial force is at least what of n is along it.
    #[test]
    fn members_leave_a_leg_its_axial_force_alone() {
        let [frame, block] = [Structure::paper(), Structure::block(2.1, 0.45, 640.0).unwrap()]
            .map(|structure| structure.body::<f64>());
        let row = GroundRow::pressing(Kind::AFrame, &frame, 1.0, 7e6);
        assert_eq!([0, 1, 2].map(|k| row.largest(k)), [0.0; 3]);
        assert!((row.largest(3) / (-7e6 * 61.0 / 61.0_f64.hypot(6.1)) - 1.0).abs() < 1e-12);
        let row = GroundRow::pressing(Kind::Block, &block, -1.0, 7e3);
        assert!((row.largest(2).abs() - 7e3 * 0.225).abs() < 1e-9 && row.largest(3) == -7e3);
    }
}
