//! Integrators by name, as users write them.

use std::{fmt, str::FromStr};

use crate::integrator::{Integrator, IntegratorError};
use thiserror::Error;

/// A name that is no integrator's.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum IntegratorNameError {
    /// Unknown, or not with these numbers.
    #[error(
        "integrator {name:?}: give newmark:GAMMA:BETA, hht:ALPHA (0 to -1/2; \
         -1/3 damps most), generalized-alpha:RHO (0 to 1), trbdf2 or backward-euler"
    )]
    Unknown {
        /// As given.
        name: String,
    },
    /// HHT with alpha's sign forgotten, as other programs write it.
    #[error(
        "integrator {name:?}: alpha of HHT is negative or zero here: give hht:-0.333, or nearer to \
         zero"
    )]
    Sign {
        /// As given.
        name: String,
    },
    /// It is unstable.
    #[error(transparent)]
    Unstable(#[from] IntegratorError),
}

impl IntegratorNameError {
    /// What to give.
    pub fn remedy(&self) -> String {
        let told = self.to_string();
        told.split_once(": ").map_or(told.clone(), |(_, remedy)| remedy.to_string())
    }
}

impl fmt::Display for Integrator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Newmark { gamma, beta } => write!(f, "newmark:{gamma}:{beta}"),
            Self::Hht { alpha } => write!(f, "hht:{alpha}"),
            Self::GeneralizedAlpha { rho_inf } => write!(f, "generalized-alpha:{rho_inf}"),
            Self::Trbdf2 => f.write_str("trbdf2"),
            Self::BackwardEuler => f.write_str("backward-euler"),
        }
    }
}

impl Integrator {
    /// In words: "HHT alpha -1/3".
    #[doc(hidden)]
    pub fn words(&self) -> String {
        match self {
            Self::Hht { alpha } if (alpha + 1.0 / 3.0).abs() < 1e-9 => "HHT alpha -1/3".into(),
            Self::Hht { alpha } => format!("HHT alpha {alpha}"),
            Self::Newmark { gamma, beta } => format!("Newmark gamma {gamma}, beta {beta}"),
            Self::GeneralizedAlpha { rho_inf } => format!("generalized alpha, rho_inf {rho_inf}"),
            Self::Trbdf2 => "TRBDF2".into(),
            Self::BackwardEuler => "BackwardEuler".into(),
        }
    }
}

impl TryFrom<String> for Integrator {
    type Error = IntegratorNameError;

    fn try_from(name: String) -> Result<Self, IntegratorNameError> {
        name.parse()
    }
}

impl From<Integrator> for String {
    fn from(integrator: Integrator) -> Self {
        integrator.to_string()
    }
}

impl FromStr for Integrator {
    type Err = IntegratorNameError;

    fn from_str(name: &str) -> Result<Self, IntegratorNameError> {
        let unknown = || IntegratorNameError::Unknown { name: name.into() };
        let lower = name.to_ascii_lowercase();
        let mut parts = lower.split(':');
        let head = parts.next().unwrap_or_default();
        let numbers: Vec<f64> =
            parts.map(str::parse).collect::<Result<_, _>>().map_err(|_| unknown())?;
        let integrator = match (head, numbers.as_slice()) {
            ("newmark", []) => Self::AVERAGE_ACCELERATION,
            ("newmark", &[gamma, beta]) => Self::Newmark { gamma, beta },
            ("hht", []) => Self::HHT_MOST,
            ("hht", &[alpha]) if alpha > 0.0 => {
                return Err(IntegratorNameError::Sign { name: name.into() });
            }
            ("hht", &[alpha]) => Self::Hht { alpha },
            ("generalized-alpha", &[rho_inf]) => Self::GeneralizedAlpha { rho_inf },
            ("trbdf2", []) => Self::Trbdf2,
            ("backward-euler", []) => Self::BackwardEuler,
            _ => return Err(unknown()),
        };
        Ok(integrator.checked()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for integrator in [
            Integrator::AVERAGE_ACCELERATION,
            Integrator::HHT_MOST,
            Integrator::GENERALIZED_ALPHA_0,
            Integrator::Trbdf2,
            Integrator::BackwardEuler,
        ] {
            assert_eq!(integrator.to_string().parse(), Ok(integrator));
        }
        assert_eq!("HHT:-0.1".parse(), Ok(Integrator::Hht { alpha: -0.1 }));
        // without a number it is the one that SAP2000 is to be set to
        assert_eq!("HHT".parse(), Ok(Integrator::HHT_MOST));
        // OpenSees' own number
        let [sign, unstable] = ["hht:0.9", "hht:-0.9"].map(|name| name.parse::<Integrator>());
        assert!(matches!(sign, Err(IntegratorNameError::Sign { .. })));
        assert!(matches!(unstable, Err(IntegratorNameError::Unstable(_))));
        for unknown in ["wilson:1.4", "hht:", "hht:x", "trbdf2:1", "newmark:0.5", ""] {
            let error = unknown.parse::<Integrator>().unwrap_err();
            assert!(error.to_string().contains("backward-euler"), "{error}");
        }
    }
}
