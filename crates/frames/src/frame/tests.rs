use nalgebra::{DMatrix, DVector};

use super::*;
use crate::{beam::BeamSection, mechanics::Mechanics};
use rocking::scalar::GRAVITY;

fn section() -> BeamSection {
    BeamSection {
        axial_damping: 3e7,
        bending_damping: 2e7,
        line_mass: 5e3,
        ..BeamSection::elastic(8e9, 6e9)
    }
}

fn pier(elements: usize, inertia: Option<f64>) -> Cantilever {
    let footing = Footing::block(4.0, 1.2e5, 0.75, 1.5);
    Cantilever {
        mass: 6e5,
        inertia,
        height: 12.0,
        footing,
        column: StraightMember { section: section(), elements },
        consistent: false,
    }
}

fn portal() -> Portal {
    let column = StraightMember { section: section(), elements: 2 };
    let footing = Footing::block(3.0, 5e4, 0.5, 1.0);
    Portal { span: 10.0, height: 7.0, mass: 1e5, inertia: 3e4, footing, column, girder: column }
}

/// Everything at once: dampers, tendon, several elements, beams' mass.
fn frames() -> Vec<Frame> {
    let mut tied = pier(3, Some(1e5)).layout();
    let at = NodePoint { node: 1, place: [0.3, 12.5] };
    tied.tendons.push(FrameTendon { at, anchor: [0.7, 0.0], stiffness: 3e7, pretension: 1e6 });
    for corner in tied.corners.clone() {
        tied.dampers.push(FrameDamper { at: corner, c: [2e5, 7e5] });
    }
    let legs = StraightMember { section: section(), elements: 2 };
    let legged = LeggedFrame {
        mass: 6e5,
        inertia: 1e5,
        height: 12.0,
        width: 5.0,
        foot_mass: 3e3,
        leg: legs,
    };
    let consistent = Cantilever { consistent: true, ..pier(4, Some(1e5)) };
    [tied, legged.layout(), portal().layout(), consistent.layout()]
        .map(|l| l.frame().unwrap())
        .to_vec()
}

/// A state out of the ordinary, the same on every machine.
fn state(frame: &Frame) -> (DVector<f64>, DVector<f64>) {
    let n = frame.size();
    let wave = |k: usize, a: f64| ((k as f64 + 1.0) * a).sin();
    (DVector::from_fn(n, |k, _| 0.2 * wave(k, 1.7)), DVector::from_fn(n, |k, _| wave(k, 2.9)))
}

#[test]
fn forces_and_tangent_are_the_slopes_of_the_energies() {
    for frame in frames() {
        let (q, v) = state(&frame);
        let n = frame.size();
        let still = DVector::zeros(n);
        let scale = 8e9;
        let [k, c] = frame.tangent(&q, &v, [0.0; 2]);
        let force = frame.force(&q, &still, [0.0; 2]);
        let bump = |x: &DVector<f64>, j: usize, by: f64| {
            let mut x = x.clone();
            x[j] += by;
            x
        };
        let h = 1e-6;
        for j in 0..n {
            let slope =
                (frame.potential(&bump(&q, j, h)) - frame.potential(&bump(&q, j, -h))) / (2.0 * h);
            assert!((slope + force[j]).abs() < 1e-7 * scale, "{j}: {slope} {}", force[j]);
            let by = |q: [&DVector<f64>; 2], v: [&DVector<f64>; 2]| {
                (frame.force(q[0], v[0], [0.3, 0.7]) - frame.force(q[1], v[1], [0.3, 0.7]))
                    / (2.0 * h)
            };
            let by_q = by([&bump(&q, j, h), &bump(&q, j, -h)], [&v, &v]);
            let by_v = by([&q, &q], [&bump(&v, j, h), &bump(&v, j, -h)]);
            assert!((by_q + k.column(j)).amax() < 1e-7 * scale, "{j}");
            assert!((by_v + c.column(j)).amax() < 1e-7 * scale, "{j}");
        }
        // power of what is neither elastic nor gravity
        let power = (frame.force(&q, &v, [1.1, -0.4]) - force).dot(&v);
        let booked = frame.input_power(&q, &v, [1.1, -0.4]) - frame.dissipation(&q, &v);
        assert!((power - booked).abs() < 1e-10 * booked.abs());
    }
}

/// A corner's acceleration is G q'' + gamma, and its velocity G q'.
#[test]
fn corners_move_as_their_jacobians_say() {
    for frame in frames() {
        let (q, v) = state(&frame);
        let h = 1e-4;
        for i in 0..frame.footings().len() {
            let at = |t: f64| frame.corner(i, &(&q + &v * t), &v).place;
            let (before, now, after) = (at(-h), frame.corner(i, &q, &v), at(h));
            for k in 0..2 {
                assert!(
                    ((after[k] - before[k]) / (2.0 * h) - now.jacobian[k].dot(&v)).abs() < 1e-7
                );
                let bent = (after[k] - 2.0 * now.place[k] + before[k]) / (h * h);
                assert!((bent - now.bias[k]).abs() < 1e-6, "{bent} {}", now.bias[k]);
            }
        }
    }
}

/// Deflection of a node's x under a force of one there, at rest at q.
fn flexibility(frame: &Frame, q: &DVector<f64>, node: usize) -> f64 {
    let k: DMatrix<f64> = frame.tangent(q, &DVector::zeros(frame.size()), [0.0; 2])[0].clone();
    let at = frame.coordinates(node)[0].unwrap();
    let mut load = DVector::zeros(frame.size());
    load[at] = 1.0;
    k.lu().solve(&load).unwrap()[at]
}

#[test]
fn a_cantilever_bends_as_the_textbook_says() {
    for elements in [1, 3, 8] {
        let frame = pier(elements, Some(1e5)).layout().fixed().frame().unwrap();
        let weightless = DVector::zeros(frame.size());
        let (length, ei) = (10.5_f64, 6e9);
        let deflection = flexibility(&frame, &weightless, 1);
        assert!(
            (deflection / (length.powi(3) / (3.0 * ei)) - 1.0).abs() < 1e-10,
            "{elements} {deflection}"
        );
    }
}

/// P-Delta: k = P/(tan(kappa L)/kappa - L), kappa^2 = P/EI, of a weightless column under P; the
/// error of n elements falls as 1/n^2.
#[test]
fn gravity_softens_a_column_as_the_stability_functions_say() {
    let (length, ei, load) = (10.5_f64, 1.2e9_f64, 6e5 * GRAVITY);
    let kappa = (load / ei).sqrt();
    let exact = load / ((kappa * length).tan() / kappa - length);
    let error = |elements: usize| {
        let mut pier = pier(elements, Some(1.0));
        pier.column.section = BeamSection::elastic(1e14, ei);
        // massless nodes between have a little, or there is no M
        pier.column.section.line_mass = 1e-6;
        let frame = pier.layout().fixed().frame().unwrap();
        let q = frame.standing(&[]).unwrap();
        1.0 / flexibility(&frame, &q, 1) / exact - 1.0
    };
    let (coarse, fine) = (error(4), error(8));
    assert!(fine.abs() < 2e-3 && (coarse / fine - 4.0).abs() < 0.2, "{coarse} {fine}");
    // and with one hinged element kb/L^2 - m g/L
    let mut hinged = pier(1, None);
    hinged.column.section = BeamSection::elastic(1e14, ei);
    let frame = hinged.layout().fixed().frame().unwrap();
    let stiffness = 1.0 / flexibility(&frame, &frame.standing(&[]).unwrap(), 1);
    let expected = 3.0 * ei / length.powi(3) - load / length;
    assert!((stiffness / expected - 1.0).abs() < 1e-6, "{stiffness} {expected}");
}

/// Sway of a portal on fixed bases, 24 EI/h^3 (1 + 6 r)/(4 + 6 r), r the girder's EI/L over the
/// column's.
#[test]
fn a_portal_sways_as_the_textbook_says() {
    let mut portal = portal();
    (portal.column.section, portal.girder.section) =
        (BeamSection::elastic(1e14, 6e9), BeamSection::elastic(1e14, 2e9));
    (portal.column.elements, portal.girder.elements) = (1, 1);
    let frame = portal.layout().fixed().frame().unwrap();
    let (height, r) = (6.0_f64, (2e9 / 10.0) / (6e9 / 6.0));
    let exact = 24.0 * 6e9 / height.powi(3) * (1.0 + 6.0 * r) / (4.0 + 6.0 * r);
    let stiffness = 1.0 / flexibility(&frame, &DVector::zeros(frame.size()), 2);
    assert!((stiffness / exact - 1.0).abs() < 1e-3, "{stiffness} {exact}");
}

/// A uniform cantilever's first frequencies, 1.8751^2, 4.6941^2 sqrt(EI/(m L^4))/(2 pi), from both
/// sorts of mass (Blevins, table 8-1).
#[test]
fn a_column_s_own_mass_vibrates_as_the_textbook_says() {
    let error = |consistent: bool, elements: usize, mode: usize| {
        let mut pier = pier(elements, Some(0.0));
        (pier.mass, pier.consistent) = (0.0, consistent);
        let frame = pier.layout().fixed().frame().unwrap();
        let root = [1.875_104_07_f64, 4.694_091_13][mode];
        let exact =
            root * root * (6e9_f64 / (5e3 * 10.5_f64.powi(4))).sqrt() / std::f64::consts::TAU;
        let q = DVector::zeros(frame.size());
        // vibration along the column is elsewhere
        frame
            .frequencies(&q)
            .into_iter()
            .map(|f| (f / exact - 1.0).abs())
            .fold(f64::INFINITY, f64::min)
    };
    for (consistent, mode) in [(false, 0), (false, 1), (true, 0), (true, 1)] {
        let (coarse, fine) = (error(consistent, 8, mode), error(consistent, 16, mode));
        assert!(fine < 2e-2 && coarse / fine > 3.0, "{consistent} {mode}: {coarse} {fine}");
    }
}

#[test]
fn the_weight_stands_on_the_corners_and_a_lean_is_held() {
    let mut portal = portal();
    (portal.column.section, portal.girder.section) =
        (BeamSection::elastic(1e12, 6e12), BeamSection::elastic(1e12, 6e12));
    (portal.column.elements, portal.girder.elements) = (1, 1);
    let frame = portal.layout().frame().unwrap();
    let supports = vec![Some([1e10, 1e10]); 4];
    let q = frame.standing(&supports).unwrap();
    let pressed: f64 =
        frame.places().iter().map(|corner| -1e10 * corner.reach(q.as_slice()).place[1]).sum();
    assert!((pressed / (frame.total_mass() * GRAVITY) - 1.0).abs() < 1e-9);
    let q = frame.leaning(-0.1, &supports).unwrap();
    assert!((frame.displacement(0, q.as_slice())[2] + 0.1).abs() < 1e-14);
    // all of the weight on the left corner, the right footing in the air by some 13 m times the
    // lean
    let [left, .., right] = [0, 1, 2, 3].map(|i| frame.places()[i].reach(q.as_slice()).place);
    assert!((-1e10 * left[1] / (frame.total_mass() * GRAVITY) - 1.0).abs() < 1e-9);
    assert!((right[1] / 13.0 - 0.1).abs() < 1e-3, "{right:?}");
}

/// A mass on corners b to each side, h above them, that turns freely feels m + m h^2/b^2 of itself
/// under one... of a rigid block: the effective mass at a corner is that of free-body mechanics.
#[test]
fn what_lands_is_the_free_body_s_effective_mass() {
    let footing = Footing::block(4.0, 1.2e5, 0.75, 1.5);
    let mut layout = pier(1, None).layout();
    layout.members.clear();
    let frame = layout.frame().unwrap();
    let [x, z] = frame.effective_mass(1);
    // W of a rigid body: 1/m + (lever)^2/I, and the product of the levers
    let (m, i, b, h) = (footing.mass, footing.inertia, 2.0, 0.75);
    let (xx, zz, xz) = (1.0 / m + h * h / i, 1.0 / m + b * b / i, h * b / i);
    let determinant = xx * zz - xz * xz;
    assert!(
        (x * determinant / zz - 1.0).abs() < 1e-12 && (z * determinant / xx - 1.0).abs() < 1e-12
    );
}

#[test]
fn what_does_not_fit_together_is_refused() {
    let refused = |change: &dyn Fn(&mut FrameLayout)| {
        let mut layout = pier(2, None).layout();
        change(&mut layout);
        layout.frame().unwrap_err().to_string()
    };
    assert!(refused(&|l| l.members[1].hinged = [false; 2]).contains("beam 1 is clamped to node 1"));
    assert!(refused(&|l| l.members[1].ends[1].place[0] = 1.0).contains("off its place"));
    assert!(refused(&|l| l.corners[0].node = 9).contains("names node 9"));
    assert!(refused(&|l| l.nodes[1].mass = f64::NAN).contains("mass of node 1 is NaN"));
    assert!(
        refused(&|l| l.members.iter_mut().for_each(|m| m.section.line_mass = 0.0))
            .contains("node 2 has no mass")
    );
}

/// A footing's corner moves by its own mass and inertia alone under a column: force F at the arm
/// (a_x, a_z) gives F/m, and a clockwise rotation (F_x a_z - F_z a_x)/I.
#[test]
fn a_corner_of_a_footing_moves_by_its_mass_and_inertia() {
    let footing = pier(1, None).footing;
    let frame = pier(1, None).layout().frame().unwrap();
    let q = vec![0.0; frame.size()];
    // the footing's node, which has its share of the column's mass
    let mass = |k: usize| frame.mass_matrix()[(k, k)];
    let [m, _, inertia] = frame.coordinates(0).map(|k| mass(k.unwrap()));
    let [_, height] = frame.centre(0);
    for (corner, ax, az) in [(0, -0.5 * footing.width, -height), (1, 0.5 * footing.width, -height)]
    {
        let expected =
            [1.0 / m + az * az / inertia, -ax * az / inertia, 1.0 / m + ax * ax / inertia];
        for (found, expected) in frame.mobility(corner, &q).into_iter().zip(expected) {
            assert!(
                (found - expected).abs() < 1e-12 * expected.abs(),
                "{corner}: {found:e} {expected:e}"
            );
        }
    }
}

/// A row of equal beams from the origin upwards: clamped at its foot or hinged at both ends, with
/// nodes that have no mass but theirs.
fn row(section: BeamSection, length: f64, elements: usize, hinged: bool) -> FrameLayout {
    let place = |i: usize| [0.0, length * i as f64 / elements as f64];
    let held = |i: usize| i == 0 || (hinged && i == elements);
    let nodes =
        (0..=elements).map(|i| Node { held: held(i), ..Node::body(place(i), 0.0, 0.0) }).collect();
    let end = |node: usize| NodePoint { node, place: place(node) };
    let members = (0..elements)
        .map(|i| FrameMember {
            ends: [end(i), end(i + 1)],
            hinged: [hinged && i == 0, hinged && i + 1 == elements],
            section,
        })
        .collect();
    FrameLayout { nodes, members, ..FrameLayout::default() }
}

/// Shear alone: f = (2 n - 1)/(4 L) sqrt(GA_s/m). Bending and shear of a beam on two hinges,
/// without rotary inertia: omega^2 = EI k^4/(m (1 + EI k^2/GA_s)), k = n pi/L (Graff, *Wave Motion
/// in Elastic Solids*, section 3.4).
#[test]
fn columns_that_give_in_shear_have_timoshenko_s_frequencies() {
    use std::f64::consts::{PI, TAU};
    let (length, ga, line_mass) = (12.0, 2e10, 6e3);
    let stiff = BeamSection { shear: ga, line_mass, ..BeamSection::elastic(5e10, 1e16) };
    let sheared = row(stiff, length, 64, false).frame().unwrap().lateral_frequencies();
    for (n, f) in sheared.iter().take(3).enumerate() {
        let exact = (2 * n + 1) as f64 / (4.0 * length) * (ga / line_mass).sqrt();
        assert!((f / exact - 1.0).abs() < 0.01, "{n}: {f} {exact}");
    }
    let ei = 8e9;
    let both = BeamSection { bending: ei, ..stiff };
    let bent = row(both, length, 64, true).frame().unwrap().lateral_frequencies();
    for (n, f) in bent.iter().take(3).enumerate() {
        let k = (n + 1) as f64 * PI / length;
        let exact = (ei * k.powi(4) / (line_mass * (1.0 + ei * k * k / ga))).sqrt() / TAU;
        assert!((f / exact - 1.0).abs() < 0.01, "{n}: {f} {exact}");
    }
}

/// A pier turned by 1 rad, one whose mass is further away than its own size, one that is no number.
#[test]
fn what_has_fallen_and_what_stands() {
    let column = StraightMember { section: BeamSection::elastic(8e9, 6e9), elements: 1 };
    let frame = Cantilever { column, ..pier(1, None) }.layout().frame().unwrap();
    let turn = frame.coordinates(0)[2].unwrap();
    let [across, ..] = frame.coordinates(1).map(Option::unwrap_or_default);
    let moved = |at: usize, by: f64| {
        let mut q = vec![0.0; frame.size()];
        q[at] = by;
        frame.has_fallen(&q)
    };
    assert!(!moved(turn, 0.99) && moved(turn, 1.01) && moved(turn, -1.01) && moved(turn, f64::NAN));
    let size = frame.span();
    assert!(!moved(across, 0.99 * size) && moved(across, -1.01 * size));
    // half of the footing's 4 m over the height of 600 t at 12 m and 120 t at 0.75 m
    let height = (6e5 * 12.0 + 1.2e5 * 0.75) / 7.2e5;
    assert!((frame.topples_at() - (2.0_f64 / height).atan()).abs() < 1e-12);
    // half of a portal's footing over a height below 7 m, not half of what stands on both, 13 m
    let topples = portal().layout().frame().unwrap().topples_at();
    assert!(topples > (1.5_f64 / 7.0).atan() && topples < (6.5_f64 / 7.0).atan(), "{topples}");
}
