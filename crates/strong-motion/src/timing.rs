//! The time column: is it even, apart from the rounding of its printed digits, and what is its
//! step.

use super::RecordError;
use crate::largest_magnitude;

/// Unevenness that does not matter, relative to the step: times computed in single precision have
/// it.
const JITTER: f64 = 1e-3;

/// Times as printed, with the lines they stand on.
#[derive(Clone, Default)]
pub(super) struct Times {
    times: Vec<f64>,
    lines: Vec<usize>,
    /// Power of ten of the finest digit in the column, and most significant digits of any number in
    /// it.
    finest: i32,
    significant: i32,
}

impl Times {
    pub fn push(&mut self, line: usize, time: f64, (last_digit, significant): (i32, i32)) {
        self.finest = if self.times.is_empty() { last_digit } else { self.finest.min(last_digit) };
        self.significant = self.significant.max(significant);
        self.times.push(time);
        self.lines.push(line);
    }

    /// The time step and how far it may be off by the rounding of the printed times (s); at least
    /// two times. A given step decides where the times are printed too coarsely to show it.
    pub(super) fn step(&self, file: &str, given: Option<f64>) -> Result<(f64, f64), RecordError> {
        let (Some(first), Some(last)) = (self.times.first(), self.times.last()) else {
            return Err(RecordError::Empty { file: file.to_owned() });
        };
        let intervals = (self.times.len() - 1).max(1) as f64;
        let mean = (last - first) / intervals;
        let digit = self.last_digit();
        let rounding = (digit + JITTER * mean.abs()) / intervals;
        let accuracy = digit / intervals + 1e-12 * mean;
        if mean > 0.0 && self.spread(mean) <= JITTER * mean {
            return Ok((shortest(mean, accuracy), rounding));
        }
        // Rounded times lie within one digit of a line; a quarter more is for the line's own error.
        // A missing sample is a jump by one step, which this allowance stays well below.
        let fine = digit < 0.4 * mean;
        let slope = self.slope();
        if fine && self.spread(slope) <= 1.25 * digit {
            return Ok((shortest(slope, accuracy), rounding));
        }
        match given {
            Some(dt)
                if !fine && !is_multiple(dt, digit) && self.spread(dt) <= 1.000_001 * digit =>
            {
                Ok((dt, rounding))
            }
            _ => Err(self.uneven(file, given)),
        }
    }

    /// Times in ms become times in s.
    pub(super) fn take_as_milliseconds(&mut self) {
        self.times.iter_mut().for_each(|t| *t /= 1e3);
        self.finest -= 3;
    }

    /// Every one is larger than the one before; at least three of them.
    pub(super) fn run_upwards(&self) -> bool {
        self.times.len() > 2 && self.times.windows(2).all(|pair| pair[1] > pair[0])
    }

    /// They go down often and cross zero, as accelerations do and damaged times do not; at least
    /// four of them.
    pub(super) fn run_to_and_fro(&self) -> bool {
        let falls = self.times.windows(2).filter(|pair| pair[1] < pair[0]).count();
        let both = |sign: f64| self.times.iter().any(|t| t * sign > 0.0);
        self.times.len() > 3 && 4 * falls > self.times.len() && both(1.0) && both(-1.0)
    }

    /// They are 0, 1, 2 or 1, 2, 3 and on: numbers of rows, no seconds.
    pub(super) fn count_rows(&self) -> bool {
        self.times.len() > 1 && self.times.windows(2).all(|pair| pair[1] - pair[0] == 1.0)
    }

    /// One unit of the last printed digit, at the largest time (s).
    fn last_digit(&self) -> f64 {
        let largest = largest_magnitude(&self.times);
        let leading = if largest > 0.0 { largest.log10().floor() as i32 + 1 } else { 0 };
        10_f64.powi(self.finest.max(leading - self.significant))
    }

    /// Slope of the least-squares line through the times: rounding of the first and last time does
    /// not tilt it (s).
    fn slope(&self) -> f64 {
        let middle = (self.times.len() - 1) as f64 / 2.0;
        let (mut above, mut below) = (0.0, 0.0);
        for (i, t) in self.times.iter().enumerate() {
            let x = i as f64 - middle;
            above += x * (t - self.times[0]);
            below += x * x;
        }
        above / below
    }

    /// Range of t_i - i dt, less what floating point cannot resolve (s).
    fn spread(&self, dt: f64) -> f64 {
        let offsets = self.times.iter().enumerate().map(|(i, t)| t - i as f64 * dt);
        let (low, high) = offsets
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let largest = largest_magnitude(&self.times);
        (high - low) - 8.0 * f64::EPSILON * largest
    }

    /// The step that stands out most from the median step.
    fn uneven(&self, file: &str, given: Option<f64>) -> RecordError {
        let steps: Vec<f64> = self.times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let mut sorted = steps.clone();
        sorted.sort_by(f64::total_cmp);
        let median = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
        let falls = self.times.windows(2).position(|pair| pair[1] < pair[0]);
        if let Some(first) = falls.filter(|_| median < 0.0) {
            return RecordError::TimesFall {
                file: file.to_owned(),
                line: self.lines.get(first + 1).copied().unwrap_or(1),
                before: self.times[first],
                time: self.times[first + 1],
            };
        }
        let mut worst = 0;
        for (i, step) in steps.iter().enumerate() {
            if (step - median).abs() > (steps[worst] - median).abs() {
                worst = i;
            }
        }
        let tidy = |x: f64| shortest(x, 1e-9 * x.abs());
        RecordError::Uneven {
            file: file.to_owned(),
            line: self.lines.get(worst + 1).copied().unwrap_or(1),
            step: tidy(steps.get(worst).copied().unwrap_or(0.0)),
            expected: tidy(median),
            given,
        }
    }
}

fn is_multiple(dt: f64, digit: f64) -> bool {
    let ratio = dt / digit;
    ratio > 0.5 && (ratio - ratio.round()).abs() < 1e-6
}

/// The number of fewest digits within the tolerance of x: 0.01 for 0.010000000000000002.
fn shortest(x: f64, tolerance: f64) -> f64 {
    (0..16)
        .filter_map(|digits| format!("{x:.digits$e}").parse::<f64>().ok())
        .find(|short| (short - x).abs() <= tolerance)
        .unwrap_or(x)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::precision;

    fn times(printed: impl IntoIterator<Item = String>) -> Times {
        let mut times = Times::default();
        for (i, token) in printed.into_iter().enumerate() {
            times.push(i + 10, token.parse().unwrap(), precision(&token));
        }
        times
    }

    #[test]
    fn rounding_of_printed_times_is_tolerated() {
        let dt = 1.0 / 256.0;
        for print in [
            (|t| format!("{t:.3}")) as fn(f64) -> String,
            |t| format!("{t:.4}"),
            |t| format!("{t}"),
            |t| format!("{t:.5e}"),
            |t| format!("{}", t as f32),
        ] {
            let (step, rounding) =
                times((0..2000).map(|i| print(f64::from(i) * dt))).step("x", None).unwrap();
            assert!((step - dt).abs() <= rounding && rounding < 1e-3 * dt, "{} {step}", print(dt));
        }
    }

    #[test]
    fn steps_come_out_as_people_write_them() {
        let (step, _) =
            times((0..4000).map(|i| format!("{}", f64::from(i) * 0.01))).step("x", None).unwrap();
        assert_eq!(step, 0.01);
        let (step, _) = times((1..=4000).map(|i| format!("{:.2}", f64::from(i) * 0.02)))
            .step("x", None)
            .unwrap();
        assert_eq!(step, 0.02);
    }

    #[test]
    fn times_that_fall_are_told_to() {
        let times = times((0..9).map(|i| format!("{:.2}", 0.09 - 0.01 * f64::from(i))));
        let Err(RecordError::TimesFall { line, before, time, .. }) = times.step("x", None) else {
            panic!("even")
        };
        assert_eq!((line, before, time), (11, 0.09, 0.08));
    }

    #[test]
    fn a_missing_sample_is_found_on_its_line_however_times_are_printed() {
        for decimals in 2..9 {
            let printed = (0..1000)
                .filter(|&i| i != 700)
                .map(|i| format!("{:.decimals$}", f64::from(i) * 0.01));
            let times = times(printed);
            for given in [None, Some(0.01)] {
                match times.step("x", given) {
                    Err(RecordError::Uneven { line, step, expected, .. }) => {
                        assert_eq!((line, step, expected), (710, 0.02, 0.01));
                    }
                    other => panic!("{decimals} decimals, {given:?}: {other:?}"),
                }
            }
        }
    }

    #[test]
    fn times_printed_too_coarsely_need_the_step_from_the_user() {
        let times = times((0..1000).map(|i| format!("{:.2}", f64::from(i) * 0.005)));
        assert!(times.step("x", None).is_err());
        assert_eq!(times.step("x", Some(0.005)).unwrap().0, 0.005);
        assert!(times.step("x", Some(0.006)).is_err());
    }

    #[test]
    fn times_that_stand_still_or_run_backwards_are_uneven() {
        assert!(times((0..5).map(|_| "1.0".to_owned())).step("x", None).is_err());
        assert!(times((0..5).map(|i| format!("{}", -i))).step("x", Some(1.0)).is_err());
    }
}
