//! One axis: which value stands where, and which values are told.

use super::number::fixed;
use files::message::power_of_ten;

/// A value told at the axis.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tick {
    pub value: f64,
    /// Empty for a small mark between two told values.
    pub label: String,
}

/// A linear or logarithmic axis from `low` to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    pub low: f64,
    pub high: f64,
    logarithmic: bool,
}

/// The least and the largest of some values and zero.
pub(crate) fn around_zero(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    values.into_iter().fold((0.0, 0.0), |(low, high), x| (f64::min(low, x), f64::max(high, x)))
}

impl Scale {
    /// From low to high exactly; a length of nothing is widened.
    pub(crate) fn linear(low: f64, high: f64) -> Self {
        if high > low {
            return Self { low, high, logarithmic: false };
        }
        let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
        Self { low: low - half, high: high + half, logarithmic: false }
    }

    /// Logarithmic from low to high exactly; both greater than zero.
    pub(crate) fn log(low: f64, high: f64) -> Self {
        let low = low.max(f64::MIN_POSITIVE);
        if high > low {
            Self { low, high, logarithmic: true }
        } else {
            Self { low: low / 3.0, high: low * 3.0, logarithmic: true }
        }
    }

    /// Logarithmic with room around the positive ones of the values, at least a factor of `least`
    /// in all.
    pub(crate) fn log_around(values: impl IntoIterator<Item = f64>, least: f64) -> Self {
        let (mut low, mut high) = (f64::INFINITY, 0.0_f64);
        for x in values.into_iter().filter(|x| x.is_finite() && *x > 0.0) {
            (low, high) = (low.min(x), high.max(x));
        }
        if high == 0.0 {
            (low, high) = (0.1, 1.0);
        }
        let room = (high / low).powf(0.06).max(1.08);
        let missing = (least / (high / low * room * room)).max(1.0).sqrt();
        Self { low: low / room / missing, high: high * room * missing, logarithmic: true }
    }

    /// Whether it shows powers of ten at even distances.
    pub(crate) fn logarithmic(&self) -> bool {
        self.logarithmic
    }

    /// Where a value stands: 0 at low, 1 at high. What a logarithm cannot show stands far below.
    pub(crate) fn share(&self, value: f64) -> f64 {
        if !self.logarithmic {
            (value - self.low) / (self.high - self.low)
        } else if value > 0.0 {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            -1e3
        }
    }

    /// The nearest value that the axis shows.
    pub(crate) fn clamp(&self, value: f64) -> f64 {
        value.clamp(self.low, self.high)
    }

    /// Ticks for an axis so many pixels long, with labels about `apart` pixels from each other.
    pub(crate) fn ticks(&self, pixels: f64, apart: f64) -> Vec<Tick> {
        let most = (pixels / apart).max(2.0);
        if self.logarithmic { self.log_ticks(most) } else { self.linear_ticks(most) }
    }

    /// Steps of 1, 2 or 5 times a power of ten.
    fn linear_ticks(&self, most: f64) -> Vec<Tick> {
        let raw = (self.high - self.low) / most;
        let decade = 10_f64.powi(raw.log10().floor() as i32);
        let step = decade
            * [1.0, 2.0, 5.0, 10.0]
                .into_iter()
                .find(|s| s * decade >= raw * (1.0 - 1e-9))
                .unwrap_or(10.0);
        let decimals = (-(step * (1.0 + 1e-9)).log10().floor()).max(0.0) as usize;
        // A hundredth of a step is less than two pixels: an axis that ends at 19.99 still tells its
        // 20.
        let (first, last) =
            ((self.low / step - 0.01).ceil() as i64, (self.high / step + 0.01).floor() as i64);
        (first..=last)
            .map(|i| i as f64 * step)
            .map(|value| Tick { value, label: fixed(value, decimals) })
            .collect()
    }

    /// Powers of ten, or 1, 2 and 5 times them where there is room.
    fn log_ticks(&self, most: f64) -> Vec<Tick> {
        let (from, to) = (self.low.log10().floor() as i32, self.high.log10().floor() as i32);
        let decades = (self.high / self.low).log10();
        let every = (decades / most).ceil().max(1.0) as i32;
        // Beyond this, numbers with all their zeros are harder to read than powers of ten.
        let plain = self.low >= 0.9e-4 && self.high <= 1.1e5;
        // five digits side by side need more room
        let three_a_decade = if plain && self.high >= 1e4 { 3.2 } else { 2.4 };
        let told: &[u32] = match most / decades {
            room if room >= 10.0 && decades < 1.0 => &[1, 2, 3, 4, 5, 6, 7, 8],
            room if room >= three_a_decade && decades < if plain { 4.0 } else { 2.0 } => &[1, 2, 5],
            _ => &[1],
        };
        let mut ticks = Vec::new();
        for exponent in from..=to {
            for digit in 1..=9_u32 {
                let value = decimal(digit, exponent);
                if !(value >= self.low * (1.0 - 1e-9) && value <= self.high * (1.0 + 1e-9)) {
                    continue;
                }
                let label = if !told.contains(&digit) || exponent.rem_euclid(every) != 0 {
                    String::new()
                } else if plain {
                    fixed(value, (-exponent).max(0) as usize)
                } else if digit == 1 {
                    power_of_ten(exponent)
                } else {
                    format!("{digit}·{}", power_of_ten(exponent))
                };
                // Many decades: small marks between them would be a smear.
                if !label.is_empty() || decades < 5.0 || digit == 1 {
                    ticks.push(Tick { value, label });
                }
            }
        }
        ticks
    }
}

/// digit times ten to the exponent, rounded once.
fn decimal(digit: u32, exponent: i32) -> f64 {
    let digit = f64::from(digit);
    if exponent < 0 { digit / 10_f64.powi(-exponent) } else { digit * 10_f64.powi(exponent) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(scale: Scale, pixels: f64, apart: f64) -> Vec<String> {
        scale
            .ticks(pixels, apart)
            .into_iter()
            .map(|tick| tick.label)
            .filter(|label| !label.is_empty())
            .collect()
    }

    #[test]
    fn linear_ticks_are_round_and_hold_both_ends() {
        assert_eq!(
            labels(Scale::linear(0.0, 20.0), 1400.0, 130.0),
            ["0", "2", "4", "6", "8", "10", "12", "14", "16", "18", "20"]
        );
        assert_eq!(
            labels(Scale::linear(-0.3, 0.3), 400.0, 60.0),
            ["−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2", "0.3"]
        );
        assert_eq!(
            labels(Scale::linear(-433.0, 431.0), 400.0, 60.0),
            ["−400", "−200", "0", "200", "400"]
        );
    }

    #[test]
    fn ticks_fit_whatever_the_magnitude() {
        for exponent in -12..=12 {
            for width in [1.0, 1.3, 2.0, 4.9, 7.7] {
                let high = width * 10_f64.powi(exponent);
                let ticks = Scale::linear(-0.4 * high, high).ticks(600.0, 100.0);
                assert!((3..=9).contains(&ticks.len()), "{high}: {ticks:?}");
            }
        }
    }

    #[test]
    fn log_ticks_are_plain_near_one_and_powers_far_from_it() {
        assert_eq!(
            labels(Scale::log(0.05, 20.0), 1400.0, 130.0),
            ["0.05", "0.1", "0.2", "0.5", "1", "2", "5", "10", "20"]
        );
        assert_eq!(
            labels(Scale::log(1e-12, 1e-6), 600.0, 60.0),
            ["10⁻¹²", "10⁻¹¹", "10⁻¹⁰", "10⁻⁹", "10⁻⁸", "10⁻⁷", "10⁻⁶"]
        );
        assert_eq!(
            labels(Scale::log(1e-12, 1.0), 400.0, 80.0),
            ["10⁻¹²", "10⁻⁹", "10⁻⁶", "10⁻³", "10⁰"]
        );
        assert_eq!(
            labels(Scale::log(0.02, 0.06), 600.0, 60.0),
            ["0.02", "0.03", "0.04", "0.05", "0.06"]
        );
    }

    #[test]
    fn shares_run_from_zero_to_one() {
        for scale in [Scale::linear(-3.0, 5.0), Scale::log(0.01, 100.0)] {
            assert!(scale.share(scale.low).abs() < 1e-15);
            assert!((scale.share(scale.high) - 1.0).abs() < 1e-15);
        }
        assert!((Scale::log(0.01, 100.0).share(1.0) - 0.5).abs() < 1e-15);
        assert!(Scale::log(0.01, 100.0).share(0.0) < -100.0);
    }

    #[test]
    fn degenerate_ranges_are_widened() {
        assert!(Scale::linear(2.0, 2.0).high > 2.0);
        assert!(Scale::linear(0.0, 0.0).high > 0.0);
        let around = Scale::log_around([0.03], 10.0);
        assert!((around.high / around.low - 10.0).abs() < 1e-9);
        assert!(Scale::log_around([], 10.0).low > 0.0);
    }
}
