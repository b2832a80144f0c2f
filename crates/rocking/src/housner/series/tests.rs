use super::*;
use approx::assert_relative_eq;

fn start(alpha: f64, w: f64, rate: f64) -> StepStart<f64> {
    let (sin, cos) = (alpha - w).sin_cos();
    StepStart { w, rate, sin, cos }
}

fn level(b: f64, db: f64) -> StepGround<f64> {
    StepGround { b, db, gamma: 1.0, dgamma: 0.0 }
}

/// w'' of the series against the right hand side, at points of the step.
fn satisfies<const V: bool>(ground: &StepGround<f64>) {
    let (alpha, h, p2) = (0.2, 0.05, 2.9);
    let series = PowerSeries::<_, SHORT>::new::<V>(&start(alpha, 0.07, 0.3), h, ground, p2 * h * h);
    for x in [0.0, 0.05, 0.1] {
        let (w, _) = series.at(x);
        let second: f64 = (2..SHORT)
            .map(|k| (k * (k - 1)) as f64 * series.c[k] * f64::powi(x, k as i32 - 2))
            .sum();
        let (gamma, b) = (ground.gamma + ground.dgamma * x, ground.b + ground.db * x);
        let force = -p2 * (gamma * (alpha - w).sin() + b * (alpha - w).cos());
        assert_relative_eq!(second / (h * h), force, max_relative = 1e-12);
    }
}

#[test]
fn the_series_satisfies_housners_equation_inside_the_step() {
    satisfies::<false>(&level(0.15, -0.4));
    satisfies::<true>(&StepGround { gamma: 0.7, dgamma: 0.5, ..level(0.15, -0.4) });
    satisfies::<true>(&StepGround { gamma: -0.2, dgamma: -0.6, ..level(-0.9, 0.3) });
}

#[test]
fn a_level_ground_that_does_not_move_up_gives_the_same_series_either_way() {
    let (at, ground, h) = (start(0.2, 0.07, 0.3), level(0.15, -0.4), 0.05);
    let without = PowerSeries::<_, LONG>::new::<false>(&at, h, &ground, 2.9 * h * h);
    assert_eq!(
        PowerSeries::<_, LONG>::new::<true>(&at, h, &ground, 2.9 * h * h).c[..4],
        without.c[..4]
    );
}

/// Two half steps against one whole step: the truncated terms are where `reach` says they are.
#[test]
fn two_half_steps_agree_with_a_whole_step_to_rounding() {
    let (alpha, h, p2, b0, db) = (0.2, 0.005, 2.9, 0.15, -0.05);
    let step = |at: &StepStart<f64>, h: f64, ground: &StepGround<f64>| {
        PowerSeries::<_, SHORT>::new::<true>(at, h, ground, p2 * h * h)
    };
    let ground = |gamma, b, part: f64| StepGround { b, db: db * part, gamma, dgamma: 0.03 * part };
    let whole = step(&start(alpha, 0.07, 0.3), h, &ground(0.8, b0, 1.0));
    assert_eq!(whole.reach(), 1.0);
    let k = h / 2.0;
    let first = step(&start(alpha, 0.07, 0.3), k, &ground(0.8, b0, 0.5));
    let (w, rate) = (first.at(1.0).0, first.end_slope() / k);
    let second = step(&start(alpha, w, rate), k, &ground(0.815, b0 + db / 2.0, 0.5));
    assert_relative_eq!(second.at(1.0).0, whole.at(1.0).0, max_relative = 1e-15);
    assert_relative_eq!(second.end_slope() / k, whole.end_slope() / h, max_relative = 1e-14);
}
