//! Times at which a program with steps of one size shows its results.
//!
//! Such a program ends a step at every output time. Its own step is only kept if the output's is a
//! whole multiple of it:
//!
//! ```text
//!   output step = k step,  k = max(1, round(dt/step)),  dt of the record
//! ```

/// A ratio that is whole within this is whole.
const SAME: f64 = 1e-6;

/// A program's output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutputSteps {
    /// So many, after the one at t = 0.
    pub count: usize,
    /// Of this size (s): the record's own where the program's step divides it.
    pub step_s: f64,
}

impl OutputSteps {
    /// Of a program's step (s), through so many samples of a record at an interval dt (s).
    pub fn of(step: f64, dt: f64, samples: usize) -> Self {
        let multiple = (dt / step).round().max(1.0) * step;
        // its own number, to the last digit
        let step_s = if (multiple / dt - 1.0).abs() < SAME { dt } else { multiple };
        let duration = samples.saturating_sub(1) as f64 * dt;
        Self { count: (duration / step_s + SAME).floor() as usize, step_s }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every output time is the end of a step, whatever the step: 20 s of a record at 0.01 s.
    #[test]
    fn the_output_is_a_whole_number_of_steps() {
        for (step, count, step_s) in [
            (0.001, 2000, 0.01),
            (0.003, 2222, 0.009),
            (0.004, 1666, 0.012),
            (0.008, 2500, 0.008),
            (0.01, 2000, 0.01),
            (0.02, 1000, 0.02),
            (1e-4, 2000, 0.01),
        ] {
            let output = OutputSteps::of(step, 0.01, 2001);
            assert_eq!(output.count, count, "{step}");
            assert!((output.step_s / step_s - 1.0).abs() < 1e-12, "{step}: {output:?}");
            let steps = output.step_s / step;
            assert!((steps - steps.round()).abs() < 1e-9 && steps > 0.5, "{step}: {steps}");
        }
        // the record's own step to the last bit
        assert_eq!(OutputSteps::of(0.001, 0.005, 11), OutputSteps { count: 10, step_s: 0.005 });
    }
}
