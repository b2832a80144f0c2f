//! What a fit says: its median, the bounds of its parameters.

use super::FragilityRow;
use crate::lognormal::{LognormalFit, Probit};

/// Confidence bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ConfidenceBounds {
    pub median: (f64, f64),
    pub beta: (f64, f64),
}

impl FragilityRow {
    /// The curve, where there is one.
    pub fn probit(&self) -> Option<&Probit> {
        match &self.fit {
            LognormalFit::Fitted(fit) => Some(fit),
            _ => None,
        }
    }

    /// Whether the median lies outside of what was computed.
    pub(crate) fn is_extrapolated(&self) -> bool {
        self.median().is_some_and(|median| !(self.range.0..=self.range.1).contains(&median))
    }

    /// The median: of the fit or, for separated outcomes, the geometric mean of the two intensities
    /// between which they separate.
    pub(crate) fn median(&self) -> Option<f64> {
        match &self.fit {
            LognormalFit::Fitted(fit) => Some(fit.median()),
            LognormalFit::Separated { below, above } => Some((below * above).sqrt()),
            _ => None,
        }
    }

    /// Bounds at so many standard deviations, of the logarithms.
    pub(crate) fn bounds(&self, half_width: f64) -> Option<ConfidenceBounds> {
        let (fit, covariance) = (self.probit()?, self.covariance?);
        let (ln_median, beta) = fit.deviations(covariance);
        let around = |x: f64, relative: f64| {
            let factor = (half_width * relative).exp();
            (x / factor, x * factor)
        };
        Some(ConfidenceBounds {
            median: around(fit.median(), ln_median),
            beta: around(fit.beta(), beta / fit.beta()),
        })
    }

    pub(crate) fn said(&self) -> &'static str {
        match self.fit {
            LognormalFit::Fitted(_) => "fitted",
            LognormalFit::NoneExceeded => "none exceeds",
            LognormalFit::AllExceeded => "all exceed",
            LognormalFit::Separated { .. } => "separated",
            LognormalFit::Undetermined => "undetermined",
            LognormalFit::Falling => "falling",
        }
    }
}
