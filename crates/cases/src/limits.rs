//! Ranges of what users ask for, wherever they ask: case files, options, the library.

/// A range, and what to do beyond it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Least allowed.
    pub least: f64,
    /// Most allowed.
    pub most: f64,
    /// What to give instead.
    pub remedy: &'static str,
}

/// Of the error that a stiffness is chosen for, NRMSE.
pub const ACCURACY: Limits =
    Limits { least: 1e-5, most: 1.0, remedy: "give an error between 1e-5 and 1, as 0.002" };

/// Of the error of peaks that a stiffness is chosen for.
pub const PEAKS: Limits =
    Limits { least: 1e-4, most: 1.0, remedy: "give an error of peaks between 1e-4 and 1, as 0.02" };

/// Of the stiffest springs allowed, Omega_n/2 pi (Hz).
pub const MAX_HZ: Limits = Limits {
    least: 0.1,
    most: 1e6,
    remedy: "give a frequency between 0.1 and 1e6 Hz, or leave it out",
};

impl Limits {
    /// The value, if it lies within.
    ///
    /// # Errors
    /// The value as it is to be shown, and what to give instead.
    pub fn check(&self, value: f64) -> Result<f64, (String, &'static str)> {
        if (self.least..=self.most).contains(&value) {
            Ok(value)
        } else {
            Err((format!("{value:?}"), self.remedy))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_beyond_is_shown_with_its_remedy() {
        assert_eq!(ACCURACY.check(1e-5), Ok(1e-5));
        assert_eq!(ACCURACY.check(7.0), Err(("7.0".into(), ACCURACY.remedy)));
        assert_eq!(MAX_HZ.check(f64::NAN), Err(("NaN".into(), MAX_HZ.remedy)));
    }
}
