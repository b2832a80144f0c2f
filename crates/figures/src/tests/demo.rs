//! Every figure with numbers from closed forms, in the shape of the real ones.

use crate::*;

/// A seeded sequence of numbers in [0, 1) (Knuth's MMIX generator).
struct Dice(u64);

impl Dice {
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn times(n: usize) -> Vec<f64> {
    (0..n).map(|i| i as f64 * 0.01).collect()
}

/// A rocking-like history: parabolas in theta of falling size and length, with v = |u| b/h.
fn rocking(t: &[f64], scale: f64, late: f64) -> (Vec<f64>, Vec<f64>) {
    let u: Vec<f64> = t
        .iter()
        .map(|t| {
            let t = t - late;
            scale
                * 0.4
                * (-0.09 * t).exp()
                * (1.0 - (-t * t / 2.0).exp())
                * (2.0 * t - 0.03 * t * t).sin()
        })
        .collect();
    let v = u.iter().map(|u| 0.1 * u.abs() - 0.02 * u * u).collect();
    (u, v)
}

fn zeros(t: &[f64], u: &[f64]) -> Vec<f64> {
    u.windows(2).zip(t).filter(|(pair, _)| pair[0] * pair[1] < 0.0).map(|(_, t)| *t).collect()
}

fn draw_history(three: bool) -> Result<Sheet, FigureError> {
    let t = times(2001);
    let (u, v) = rocking(&t, 1.0, 0.0);
    let (u1, v1) = rocking(&t, 0.985, 0.02);
    let (u2, v2) = rocking(&t, 0.98, 0.03);
    let (z, z1) = (zeros(&t, &u), zeros(&t, &u1));
    let others = [
        history::Trace {
            label: "finite element",
            u: &u1,
            v: &v1,
            impacts: &z1,
            ..history::Trace::default()
        },
        history::Trace {
            label: "OpenSees",
            u: &u2[..1900],
            v: &v2[..1900],
            ..history::Trace::default()
        },
    ];
    let data = history::HistoryFigure {
        title: "Apex displacement, 61 × 12.2 m A-frame, El Centro 1940 N-S",
        t: &t,
        reference: history::Trace {
            label: "Housner",
            u: &u,
            v: &v,
            impacts: &z,
            ..history::Trace::default()
        },
        others: if three { &others } else { &others[..1] },
        differences: three,
        ..history::HistoryFigure::default()
    };
    history::draw(&data)
}

/// Equation 7 of the paper, to have curves of a familiar shape.
fn ratio(mu: f64, k: f64, c: f64, g: f64) -> f64 {
    let (x, f2, damping) = (g * g, k / mu, (c * g).powi(2));
    let above = damping + (1.0 + mu * (f2 - x)).powi(2);
    let below =
        damping * (x - 1.0).powi(2) + (mu * x * (x - f2) + mu * f2 - x * (1.0 + mu)).powi(2);
    (above / below).sqrt()
}

fn draw_arr() -> Result<Sheet, FigureError> {
    let g: Vec<f64> = (0..2000).map(|i| 0.05 * 400_f64.powf(f64::from(i) / 1999.0)).collect();
    let vertical: Vec<f64> = g.iter().map(|&g| ratio(10.0, 8.993, 3.948, g)).collect();
    let horizontal: Vec<f64> = g.iter().map(|&g| ratio(0.1, 0.52254, 1.8395, g)).collect();
    let tops = (1..g.len() - 1)
        .filter(|&i| vertical[i] > vertical[i - 1] && vertical[i] > vertical[i + 1]);
    let active: Vec<arr::ActiveMark> = tops
        .map(|i| arr::ActiveMark { g: g[i], arr: vertical[i], multiplier: Some(0.487) })
        .collect();
    let one = [arr::ActiveMark {
        g: 0.05,
        arr: ratio(0.1, 0.52254, 1.8395, 0.05),
        multiplier: Some(1.0),
    }];
    let data = arr::ResponseFigure {
        title: "Frequency response of the springs",
        target: &[
            arr::TargetBand { g: (0.05, 2.0), at_least: None, at_most: Some(4.541) },
            arr::TargetBand { g: (6.0, 20.0), at_least: None, at_most: Some(0.1) },
        ],
        curves: &[
            arr::UnitCurve {
                label: "vertical, μ = 10",
                g: &g,
                arr: &vertical,
                active: &active,
                delivered: true,
                horizontal: false,
                cap: None,
            },
            arr::UnitCurve {
                label: "horizontal, μ = 0.1",
                g: &g,
                arr: &horizontal,
                active: &one,
                delivered: false,
                horizontal: true,
                cap: Some(2.0),
            },
        ],
    };
    arr::draw(&data)
}

fn draw_candidates() -> Result<Sheet, FigureError> {
    let mut dice = Dice(7);
    let all: Vec<candidates::CandidateMark> = (0..400)
        .map(|_| {
            let (v, h) = (5.0 * 32_f64.powf(dice.roll()), 5.0 * 32_f64.powf(dice.roll()));
            let error = (1.2 / v + 0.9 / h) * (1.0 + 0.5 * (9.0 * (v.ln() + 2.0 * h.ln())).sin())
                + 0.01 * dice.roll();
            let abandoned = error > 0.08 && dice.roll() < 0.8;
            candidates::CandidateMark {
                vertical_hz: v,
                horizontal_hz: h,
                error: if abandoned { error * (0.3 + 0.5 * dice.roll()) } else { error },
                abandoned,
            }
        })
        .collect();
    let chosen = (0..all.len())
        .filter(|&i| !all[i].abandoned)
        .min_by(|&a, &b| all[a].error.total_cmp(&all[b].error));
    let data = candidates::CandidatesFigure {
        title: "Every sampled pair of Ωₙ",
        error_label: "error, NRMSE of u and v",
        candidates: &all,
        chosen,
        chosen_label: "delivered",
    };
    candidates::draw(&data)
}

fn draw_front() -> Result<Sheet, FigureError> {
    let hz = [20.0, 40.0, 80.0, 160.0, 320.0, 640.0, 1280.0];
    let ours = hz.map(|hz: f64| 0.9 / hz);
    let paper = [0.88, 0.147, 0.09, 0.038, 0.03, 0.022, 0.019];
    let forces: Vec<f64> = hz.iter().map(|hz| hz / 12.0).collect();
    let steps: Vec<f64> = hz.iter().map(|hz| 9000.0 + hz).collect();
    let data = front::FrontFigure {
        title: "Error against stiffness",
        error_label: "NRMSE of u, on the record",
        series: &[
            front::DesignSeries {
                label: "design from the geometry",
                omega_n_hz: &hz,
                error: &ours,
            },
            front::DesignSeries { label: "the paper's procedure", omega_n_hz: &hz, error: &paper },
        ],
        chosen_hz: 500.0,
        accuracy: 0.002,
        costs: [
            front::Cost { label: "foot force [weights]", omega_n_hz: &hz, value: &forces },
            front::Cost { label: "steps of a deck", omega_n_hz: &hz, value: &steps },
        ],
        notes: &["Foot forces are those of the springs in a landing, not of the structure.".into()],
    };
    front::draw(&data)
}

fn draw_contact() -> Result<Sheet, FigureError> {
    let t: Vec<f64> = (0..20_000).map(|i| f64::from(i) * 1e-3).collect();
    let (u, _) = rocking(&t, 1.0, 0.0);
    let weight = 680.1e3 * 9.81;
    let share: Vec<f64> = u.iter().map(|u| 0.5 + 0.5 * (40.0 * u).tanh()).collect();
    let ring: Vec<f64> =
        t.iter().zip(&u).map(|(t, u)| (60.0 * t).sin() * (-30.0 * u.abs()).exp()).collect();
    let force = |of: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        share.iter().zip(&ring).map(|(&share, &ring)| of(share, ring)).collect()
    };
    let data = contact::ContactFigure {
        title: "Forces between the feet and the ground",
        t: &t,
        left_vertical: &force(&|share, ring| {
            (weight * (1.0 - share) * (1.0 + 0.3 * ring)).max(0.0)
        }),
        right_vertical: &force(&|share, ring| (weight * share * (1.0 + 0.3 * ring)).max(0.0)),
        left_horizontal: &force(&|share, ring| 0.1 * weight * (1.0 - share) * (1.0 + ring)),
        right_horizontal: &force(&|share, ring| -0.1 * weight * share * (1.0 + ring)),
        weight: Some(weight),
        end: None,
    };
    contact::draw(&data)
}

fn draw_energy() -> Result<Sheet, FigureError> {
    let t = times(2001);
    let dissipated: Vec<f64> = t.iter().map(|t| 4.1e5 * (1.0 - (-0.2 * t).exp())).collect();
    let stored: Vec<f64> =
        t.iter().map(|t| 1.9e5 * (0.9 * t).sin().powi(2) * (-0.1 * t).exp()).collect();
    let residual: Vec<f64> = t.iter().map(|t| 0.02 * (7.0 * t).sin() * t.min(3.0)).collect();
    let input: Vec<f64> = (0..t.len()).map(|i| stored[i] + dissipated[i] + residual[i]).collect();
    let data = energy::EnergyFigure {
        title: "Energy account",
        t: &t,
        input: &input,
        stored: &stored,
        dissipated: &dissipated,
        residual: &residual,
        end: Some(EventMark { time: 15.0, text: "overturned at t = 15.00 s" }),
    };
    energy::draw(&data)
}

fn draw_validation() -> Result<Sheet, FigureError> {
    let mut dice = Dice(3);
    let rows: Vec<validation::ValidationPoint> = (0..200)
        .map(|_| {
            let peak = dice.roll().powf(1.6) * 1.25;
            let sensitivity = 10_f64.powf(3.0 * dice.roll() * dice.roll() - 0.3);
            let nrmse = 0.01 * sensitivity.powf(0.7) * (0.3 + dice.roll());
            let fem = peak * (1.0 + nrmse * (dice.roll() - 0.5));
            validation::ValidationPoint {
                peak_housner: peak,
                peak_fem: fem,
                overturned_housner: peak > 1.0,
                overturned_fem: fem > 1.0,
                sensitivity,
                nrmse,
            }
        })
        .collect();
    let data = validation::ValidationFigure {
        title: "200 synthetic records, 2 × 0.5 m block",
        rows: &rows,
        ks_distance: 0.025,
        well_conditioned: 10.0,
    };
    validation::draw(&data)
}

fn draw_precision() -> Result<Sheet, FigureError> {
    let ladder = |base: f64, order: f64, first: f64, n: i32| -> Vec<(f64, f64)> {
        (0..n)
            .map(|i| (first * 10_f64.powi(-i * 2), base * 10_f64.powf(f64::from(2 * i) / order)))
            .collect()
    };
    let data = precision::PrecisionFigure {
        title: "Housner, 20 s of El Centro: time against error",
        error_label: "largest error of u [m]",
        time_label: "time [ms]",
        series: &[
            precision::ToolSeries { label: "groundspring", points: &ladder(0.03, 12.0, 1e-4, 5) },
            precision::ToolSeries { label: "diffsol", points: &ladder(0.2, 9.0, 1e-3, 5) },
            precision::ToolSeries { label: "SciPy RK45", points: &ladder(50.0, 10.0, 1e-2, 5) },
            precision::ToolSeries { label: "SciPy DOP853", points: &ladder(70.0, 16.0, 1e-4, 4) },
            precision::ToolSeries { label: "Octave ode45", points: &ladder(400.0, 5.0, 0.2, 2) },
        ],
    };
    precision::draw(&[data])
}

pub type Draw = fn() -> Result<Sheet, FigureError>;

fn draw_record() -> Result<Sheet, FigureError> {
    let t = times(2001);
    let envelope = |t: f64| (-(t - 6.0).powi(2) / 9.0).exp();
    let accel: Vec<f64> = t.iter().map(|t| 0.4 * envelope(*t) * (9.0 * t).sin()).collect();
    let velocity: Vec<f64> = t.iter().map(|t| -0.45 * envelope(*t) * (9.0 * t).cos()).collect();
    let notes =
        ["PGA 0.4 g, PGV 0.45 m/s, pulse period 0.7 s".to_owned(), "a second line".to_owned()];
    let (title, uplift_g) = ("A burst", Some(0.2));
    record::draw(&record::RecordFigure {
        title,
        t: &t,
        accel_g: &accel,
        velocity: &velocity,
        uplift_g,
        notes: &notes,
    })
}

/// Two panels, whose names are longer than their axes.
fn draw_overturning() -> Result<Sheet, FigureError> {
    let frequencies: Vec<f64> = (0..30).map(|i| 1.0 + 0.1 * f64::from(i)).collect();
    let interval = |&q: &f64| overturning::AmplitudeInterval {
        q,
        from: 1.0 + q,
        to: 1.5 * (1.0 + q),
        impacts: 0,
    };
    let spectrum = |size: f64| overturning::Spectrum {
        label: format!(
            "mavroeidis-papageorgiou gamma 1.5 nu 0.5, finite elements\n\
             block R {size} m, alpha 0.1489, e = 0.9672 (equation 2), number 2"
        ),
        intervals: frequencies.iter().map(interval).collect(),
        frequencies: frequencies.clone(),
    };
    overturning::draw(&overturning::OverturningFigure {
        title: "Pulses that overturn, 2 structures",
        spectra: &[spectrum(0.5056), spectrum(1.031)],
        frequencies: (1.0, 4.0),
        amplitudes: (0.9, 10.0),
    })
}

/// Every figure: its name, and how to draw it.
pub const FIGURES: [(&str, Draw); 11] = [
    ("history", || draw_history(false)),
    ("arr", draw_arr),
    ("candidates", draw_candidates),
    ("front", draw_front),
    ("contact", draw_contact),
    ("energy", draw_energy),
    ("record", draw_record),
    ("validation", draw_validation),
    ("precision", draw_precision),
    ("overturning", draw_overturning),
    ("three", || draw_history(true)),
];
