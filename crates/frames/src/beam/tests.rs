use num_dual::{DualNum, HyperDual64};

use super::*;
use rocking::scalar::GRAVITY;

/// Rigid in shear, and giving in it.
fn sections() -> [BeamSection; 2] {
    let section =
        BeamSection { axial_damping: 4e3, bending_damping: 7e2, ..BeamSection::elastic(3e6, 2e5) };
    [section, BeamSection { shear: 5e4, ..section }]
}

fn section() -> BeamSection {
    sections()[0]
}

const ENDS: [[f64; 2]; 2] = [[1.0, 2.0], [1.8, 9.0]];
const ARMS: [[f64; 2]; 2] = [[0.4, 1.1], [-0.3, -0.6]];
const Y: [f64; 6] = [0.2, -0.1, 0.5, 1.3, -0.7, 0.9];
const RATE: [f64; 6] = [0.3, 0.5, -0.4, -1.1, 0.2, 0.7];
const HINGES: [[bool; 2]; 4] = [[false, false], [false, true], [true, false], [true, true]];

/// Strains from the places of the ends alone: the length between them, and the angles of the chord
/// by the arc tangent.
fn strains<D: DualNum<f64> + Copy>(y: [D; 6]) -> [D; 3] {
    let place = |p: usize| {
        let ([x, z], th) = (ARMS[p], y[3 * p + 2]);
        let (dx, dz) = (th.cos() * x + th.sin() * z - x, th.cos() * z - th.sin() * x - z);
        [y[3 * p] + dx + ENDS[p][0], y[3 * p + 1] + dz + ENDS[p][1]]
    };
    let (a, b) = (place(0), place(1));
    let chord = [b[0] - a[0], b[1] - a[1]];
    let bare = [ENDS[1][0] - ENDS[0][0], ENDS[1][1] - ENDS[0][1]];
    let length = (chord[0] * chord[0] + chord[1] * chord[1]).sqrt();
    // clockwise from the vertical
    let beta = chord[0].atan2(chord[1]) - bare[0].atan2(bare[1]);
    [length - bare[0].hypot(bare[1]), y[2] - beta, y[5] - beta]
}

fn energy<D: DualNum<f64> + Copy>(y: [D; 6], [ea, ei, ga]: [f64; 3], hinged: [bool; 2]) -> D {
    let [e, a, b] = strains(y);
    let length = 0.8_f64.hypot(7.0);
    // the inverse of its flexibility: L/(6 EI) [2 -1; -1 2] + 1/(GA L) [1 1; 1 1]
    let (own, other) =
        (length / (3.0 * ei) + 1.0 / (ga * length), -length / (6.0 * ei) + 1.0 / (ga * length));
    let scale = length / ei;
    let bent = match hinged {
        [false, false] => {
            (a * a * own - a * b * (2.0 * other) + b * b * own)
                * (scale / (own * own - other * other))
        }
        [false, true] => a * a * (scale / own),
        [true, false] => b * b * (scale / own),
        [true, true] => a * 0.0,
    };
    (e * e * ea + bent * ei) * (0.5 / length)
}

/// The same beam's energy in hyper-dual numbers, written from its definition, against energy,
/// resistance and tangent.
#[test]
fn resistance_and_tangent_are_the_slopes_of_the_energy() {
    for (hinged, section) in
        HINGES.into_iter().flat_map(|hinged| sections().map(|section| (hinged, section)))
    {
        let beam = Beam::new(ENDS, ARMS, hinged, section);
        let still = [0.0; 6];
        let (force, [stiffness, _]) = (beam.resistance(&Y, &still), beam.tangent(&Y, &still));
        for (i, row) in stiffness.iter().enumerate() {
            for (j, stiffness) in row.iter().enumerate() {
                let seed = |k: usize, at: usize| f64::from(u8::from(k == at));
                let y =
                    std::array::from_fn(|k| HyperDual64::new(Y[k], seed(k, i), seed(k, j), 0.0));
                let u = energy(y, [3e6, 2e5, section.shear], hinged);
                assert!((u.re - beam.energy(&Y)).abs() < 1e-12 * u.re);
                assert!((u.eps1 - force[i]).abs() < 1e-12 * 3e6, "{i}: {} {}", u.eps1, force[i]);
                assert!((u.eps1eps2 - stiffness).abs() < 1e-12 * 3e6, "{i} {j}");
            }
        }
    }
}

/// Dashpots: d/dt of the strains as slopes of the strains along the motion, Rayleigh's dissipation
/// function, and differences.
#[test]
fn dashpots_resist_the_rates_of_strain_and_their_tangent_is_the_slope_of_that() {
    for (hinged, section) in
        HINGES.into_iter().flat_map(|hinged| sections().map(|section| (hinged, section)))
    {
        let beam = Beam::new(ENDS, ARMS, hinged, section);
        let force = |y: &[f64; 6], rate: &[f64; 6]| beam.resistance(y, rate);
        let [k, c] = beam.tangent(&Y, &RATE);
        for j in 0..6 {
            let h = 1e-6;
            let moved = |x: &[f64; 6], by: f64| {
                let mut x = *x;
                x[j] += by;
                x
            };
            let (up, down) = (force(&moved(&Y, h), &RATE), force(&moved(&Y, -h), &RATE));
            let (fast, slow) = (force(&Y, &moved(&RATE, h)), force(&Y, &moved(&RATE, -h)));
            for i in 0..6 {
                assert!(((up[i] - down[i]) / (2.0 * h) - k[i][j]).abs() < 1e-8 * 3e6, "{i} {j}");
                assert!(((fast[i] - slow[i]) / (2.0 * h) - c[i][j]).abs() < 1e-8 * 3e6, "{i} {j}");
            }
        }
        // power of the dashpots: what they add to the resistance, times the velocity
        let (with, without) = (force(&Y, &RATE), force(&Y, &[0.0; 6]));
        let power: f64 = (0..6).map(|i| (with[i] - without[i]) * RATE[i]).sum();
        assert!((power - beam.dissipation(&Y, &RATE)).abs() < 1e-12 * power.abs() && power > 0.0);
    }
}

#[test]
fn a_rigid_motion_neither_strains_nor_damps() {
    let beam = Beam::new(ENDS, ARMS, [false, false], section());
    let (th, w): (f64, f64) = (0.7, 1.3);
    // both nodes carried around the origin
    let nodes = [0, 1].map(|p| [ENDS[p][0] - ARMS[p][0], ENDS[p][1] - ARMS[p][1]]);
    let (mut y, mut rate) = ([0.0; 6], [0.0; 6]);
    for (p, [x, z]) in nodes.into_iter().enumerate() {
        let [nx, nz] = [th.cos() * x + th.sin() * z, th.cos() * z - th.sin() * x];
        y[3 * p..3 * p + 3].copy_from_slice(&[nx - x, nz - z, th]);
        rate[3 * p..3 * p + 3].copy_from_slice(&[nz * w, -nx * w, w]);
    }
    assert!(beam.energy(&y) < 1e-20 * 3e6);
    assert!(beam.dissipation(&y, &rate) < 1e-20 * 3e6);
}

#[test]
fn a_small_push_meets_the_textbook_s_stiffness() {
    // upright, clamped at its foot: EA/L, 12 EI/L^3 with the head clamped, 3 EI/L^3 with a hinge
    // there
    let upright = |hinged| {
        let beam = Beam::new([[0.0, 0.0], [0.0, 7.0]], [[0.0; 2]; 2], hinged, section());
        beam.tangent(&[0.0; 6], &[0.0; 6])[0]
    };
    let clamped = upright([false, false]);
    assert!((clamped[4][4] - 3e6 / 7.0).abs() < 1e-9);
    assert!(
        (clamped[3][3] - 12.0 * 2e5 / 343.0).abs() < 1e-9
            && (clamped[5][5] - 4.0 * 2e5 / 7.0).abs() < 1e-9
    );
    assert!((upright([false, true])[3][3] - 3.0 * 2e5 / 343.0).abs() < 1e-9);
}

/// A cantilever under P at its tip: P L^3/(3 EI) + P L/GA_s, its tip turned by P L^2/(2 EI).
#[test]
fn a_cantilever_gives_by_bending_and_by_shear() {
    let [_, section] = sections();
    let k = Beam::new([[0.0, 0.0], [0.0, 7.0]], [[0.0; 2]; 2], [false, false], section)
        .tangent(&[0.0; 6], &[0.0; 6])[0];
    let determinant = k[3][3] * k[5][5] - k[3][5] * k[5][3];
    let (sway, turn) = (k[5][5] / determinant, -k[5][3] / determinant);
    let exact = [343.0 / (3.0 * 2e5) + 7.0 / 5e4, 49.0 / (2.0 * 2e5)];
    assert!(
        (sway / exact[0] - 1.0).abs() < 1e-12 && (turn / exact[1] - 1.0).abs() < 1e-12,
        "{sway} {turn} {exact:?}"
    );
}

/// The ends' accelerations as second differences of where a motion takes them.
#[test]
fn half_of_the_mass_times_an_end_s_acceleration_across_the_chord() {
    let mass = 3.0 * 0.8_f64.hypot(7.0);
    let beam = Beam::new(ENDS, ARMS, HINGES[0], BeamSection { line_mass: 3.0, ..section() });
    let accel = [0.7, -0.2, 1.1, 0.4, 2.0, -0.8];
    let ground = [0.9, GRAVITY];
    let end = |p: usize, t: f64| {
        let y = |k: usize| Y[k] + RATE[k] * t + 0.5 * accel[k] * t * t;
        let ([x, z], th) = (ARMS[p], y(3 * p + 2));
        [y(3 * p) + th.cos() * x + th.sin() * z, y(3 * p + 1) + th.cos() * z - th.sin() * x]
    };
    let [x, z] = beam.direction(&Y);
    for (p, sign) in [(0, 1.0), (1, -1.0)] {
        let h = 1e-4;
        let [before, now, after] = [-h, 0.0, h].map(|t| end(p, t));
        let at = |k: usize| (before[k] - 2.0 * now[k] + after[k]) / (h * h) + ground[k];
        let expected = sign * 0.5 * mass * (at(0) * z - at(1) * x);
        let found = beam.half_inertia(p, [&Y, &RATE, &accel], ground);
        assert!((found / expected - 1.0).abs() < 1e-6, "end {p}: {found} {expected}");
    }
}
