//! The integrators of programs with fixed time steps, in one form.
//!
//! ```text
//!   M [(1 - m) a_t + m a] + F((1 - w) q_t + w q, (1 - w) v_t + w v) = P(t + w dt)     q, v, a: at t + dt
//! ```
//!
//! | integrator | w | m | v and a from q |
//! |---|---|---|---|
//! | Newmark | 1 | 1 | Newmark's formulas with gamma, beta |
//! | Hilber-Hughes-Taylor | 1 + alpha | 1 | the same, gamma = 1/2 - alpha, beta = (1 - alpha)^2/4 |
//! | generalized alpha | 1/(1 + rho) | (2 - rho)/(1 + rho) | the same, gamma = 1/2 + m - w, beta = (1 + m - w)^2/4 |
//! | TRBDF2, first of two steps | 1 | 1 | trapezoidal rule: gamma 1/2, beta 1/4 |
//! | TRBDF2, second of two steps | 1 | 1 | BDF2 for v and for a |
//! | BackwardEuler | 1 | 1 | two trapezoidal steps, then BDF2 for v and for a |
//!
//! Hilber, Hughes and Taylor, Earthquake Engineering and Structural Dynamics 5 (1977); Chung and
//! Hulbert, Journal of Applied Mechanics 60 (1993), whose alpha_m = 1 - m and alpha_f = 1 - w; Bank
//! and others, IEEE Transactions on Electron Devices 32 (1985); the last two as OpenSees 3.7 has
//! them (its sources TRBDF2.cpp, BackwardEuler.cpp): a step of its TRBDF2 is half of one of the
//! paper's, and its BackwardEuler is the three-point formula, second-order accurate. Forces are
//! taken at the place between the ends, as OpenSees' HHT does it, not weighted between them.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// How a program steps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Integrator {
    /// Newmark's method; (1/2, 1/4) is the trapezoidal rule.
    Newmark {
        /// gamma: 1/2 without algorithmic damping.
        gamma: f64,
        /// beta: gamma/2 and more for unconditional stability.
        beta: f64,
    },
    /// Hilber, Hughes and Taylor's.
    Hht {
        /// alpha of the paper, of SAP2000 and of Abaqus: 0 (the trapezoidal rule) to -1/3 (most
        /// damping). OpenSees' own number is 1 + alpha: `integrator('HHT', 2/3)` is alpha = -1/3.
        alpha: f64,
    },
    /// Chung and Hulbert's. OpenSees 3.7's `GeneralizedAlpha` is a different method even with Chung
    /// and Hulbert's numbers: alpha_M scales the tangent of its iteration, but the inertia forces
    /// are those of the step's end: for rho_inf = 1/2 it is HHT with alpha = -1/3, for 0 Newmark's
    /// method with gamma = 3/2, beta = 1.
    GeneralizedAlpha {
        /// Spectral radius of infinitely stiff modes, 0 (they end within a step) to 1.
        rho_inf: f64,
    },
    /// Trapezoidal and BDF2 steps in turn, of the same size.
    Trbdf2,
    /// OpenSees' BackwardEuler (option 0): BDF2 in every step but the first two.
    BackwardEuler,
}

/// An integrator that cannot step.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum IntegratorError {
    /// HHT outside the range in which it is stable.
    #[error(
        "HHT's alpha is {alpha}: give one from 0 to -0.5, beyond which stiff modes grow; -1/3 \
         damps most (OpenSees' own number is 1 + alpha)"
    )]
    Alpha {
        /// As given.
        alpha: f64,
    },
    /// Newmark's method would be unstable.
    #[error(
        "Newmark's gamma is {gamma}, beta {beta}; it is stable at any step for gamma >= 1/2, beta \
         >= gamma/2"
    )]
    Newmark {
        /// As given.
        gamma: f64,
        /// As given.
        beta: f64,
    },
    /// A spectral radius that is none.
    #[error("generalized alpha: rho_inf is {rho_inf}; give a number from 0 to 1")]
    Radius {
        /// As given.
        rho_inf: f64,
    },
}

/// Formulas of one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum StepFormula {
    /// Newmark's.
    Newmark {
        gamma: f64,
        beta: f64,
        /// w.
        forces_at: f64,
        /// m.
        inertia_at: f64,
    },
    /// BDF2 for v and for a.
    Bdf2,
}

impl StepFormula {
    const TRAPEZOIDAL: Self =
        Self::Newmark { gamma: 0.5, beta: 0.25, forces_at: 1.0, inertia_at: 1.0 };
}

impl Integrator {
    /// The trapezoidal rule, Newmark's (1/2, 1/4): "average acceleration".
    #[doc(hidden)]
    pub const AVERAGE_ACCELERATION: Self = Self::Newmark { gamma: 0.5, beta: 0.25 };
    /// HHT with the most damping.
    pub const HHT_MOST: Self = Self::Hht { alpha: -1.0 / 3.0 };
    /// Generalized alpha that ends infinitely stiff modes within a step.
    #[doc(hidden)]
    pub const GENERALIZED_ALPHA_0: Self = Self::GeneralizedAlpha { rho_inf: 0.0 };

    /// The integrator itself if it is stable at any step.
    ///
    /// # Errors
    /// It is not. HHT's paper takes alpha from 0 to -1/3, which damps stiff modes most; on to -1/2
    /// (-0.414 is met in practice) linear modes are as stable, with less damping again, none at
    /// -1/2. Beyond, stiff modes grow.
    pub fn checked(self) -> Result<Self, IntegratorError> {
        match self {
            Self::Hht { alpha } if !(-0.5..=0.0).contains(&alpha) => {
                Err(IntegratorError::Alpha { alpha })
            }
            Self::Newmark { gamma, beta }
                if !(gamma >= 0.5 && beta >= 0.5 * gamma && beta.is_finite()) =>
            {
                Err(IntegratorError::Newmark { gamma, beta })
            }
            Self::GeneralizedAlpha { rho_inf } if !(0.0..=1.0).contains(&rho_inf) => {
                Err(IntegratorError::Radius { rho_inf })
            }
            _ => Ok(self),
        }
    }

    /// The formulas of a step that follows `equal` steps of the same size without a break.
    pub(crate) fn formula(&self, equal: usize) -> StepFormula {
        match *self {
            Self::Newmark { gamma, beta } => {
                StepFormula::Newmark { gamma, beta, forces_at: 1.0, inertia_at: 1.0 }
            }
            Self::Hht { alpha } => StepFormula::Newmark {
                gamma: 0.5 - alpha,
                beta: 0.25 * (1.0 - alpha) * (1.0 - alpha),
                forces_at: 1.0 + alpha,
                inertia_at: 1.0,
            },
            Self::GeneralizedAlpha { rho_inf } => {
                let (w, m) = (1.0 / (1.0 + rho_inf), (2.0 - rho_inf) / (1.0 + rho_inf));
                let (gamma, beta) = (0.5 + m - w, 0.25 * (1.0 + m - w) * (1.0 + m - w));
                StepFormula::Newmark { gamma, beta, forces_at: w, inertia_at: m }
            }
            Self::Trbdf2 if equal.is_multiple_of(2) => StepFormula::TRAPEZOIDAL,
            Self::BackwardEuler if equal < 2 => StepFormula::TRAPEZOIDAL,
            Self::Trbdf2 | Self::BackwardEuler => StepFormula::Bdf2,
        }
    }

    /// Spectral radius of a mode of infinite stiffness without damping, over one step (over a pair
    /// of steps, its square root, for TRBDF2): what is left of its motion.
    ///
    /// ```text
    ///   Newmark (1/2, 1/4): 1      Newmark: eigenvalues of [[1 - 1/(2 beta), -1/beta], [1 - gamma/(2 beta), 1 - gamma/beta]]
    ///   HHT: the same of (1 + alpha) weighted, -alpha/(1 + alpha) among them      generalized alpha: rho_inf      BDF2: 0
    /// ```
    #[doc(hidden)]
    pub fn stiff_radius(&self) -> f64 {
        match self.formula(1) {
            StepFormula::Bdf2 => 0.0,
            StepFormula::Newmark { gamma, beta, forces_at, .. } => match *self {
                Self::GeneralizedAlpha { rho_inf } => rho_inf,
                // the second step is trapezoidal, the third is not
                Self::BackwardEuler => 0.0,
                _ => newmark_radius(gamma, beta).max((1.0 - forces_at) / forces_at),
            },
        }
    }

    /// Whether motions of infinite stiffness end within a few steps: L-stable.
    #[doc(hidden)]
    pub fn ends_stiff_modes(&self) -> bool {
        self.stiff_radius() == 0.0
    }
}

/// Largest eigenvalue of (v dt, a dt^2) over a step that ends at q = 0, as q does in a mode of
/// infinite stiffness.
fn newmark_radius(gamma: f64, beta: f64) -> f64 {
    let [[a, b], [c, d]] =
        [[1.0 - gamma / beta, 1.0 - 0.5 * gamma / beta], [-1.0 / beta, 1.0 - 0.5 / beta]];
    let (half_trace, determinant) = (0.5 * (a + d), a * d - b * c);
    let square = half_trace * half_trace - determinant;
    if square >= 0.0 { half_trace.abs() + square.sqrt() } else { determinant.sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hilber, Hughes and Taylor's figure 1: at infinite dt/T the trapezoidal rule keeps all, alpha
    /// = -0.3 a spectral radius of 0.54 or so, -1/3 one half.
    #[test]
    fn stiff_modes_are_damped_as_the_papers_say() {
        assert_eq!(Integrator::AVERAGE_ACCELERATION.stiff_radius(), 1.0);
        assert!(
            (Integrator::HHT_MOST.stiff_radius() - 0.5).abs() < 1e-7,
            "{}",
            Integrator::HHT_MOST.stiff_radius()
        );
        for alpha in [-0.05, -0.1, -0.2, -0.3] {
            // (1 + alpha)/(1 - alpha), a double root
            let radius = Integrator::Hht { alpha }.stiff_radius();
            assert!((radius - (1.0 + alpha) / (1.0 - alpha)).abs() < 1e-7, "{alpha}: {radius}");
        }
        // beyond -1/3 less again: -alpha/(1 + alpha)
        let radius = Integrator::Hht { alpha: -0.414 }.stiff_radius();
        assert!((radius - 0.414 / 0.586).abs() < 1e-12, "{radius}");
        // what OpenSees' GeneralizedAlpha of rho_inf 0 is: both eigenvalues are 0
        let same = Integrator::Newmark { gamma: 1.5, beta: 1.0 };
        assert!(same.stiff_radius() < 1e-7 && Integrator::Trbdf2.ends_stiff_modes());
    }

    /// A mode without damping, through steps of the table's formulas written out for it: motions
    /// stay bounded down to alpha = -1/2, whatever the step, and grow beyond it.
    #[test]
    fn hht_is_stable_as_far_as_it_is_taken() {
        let grows = |alpha: f64| {
            let (w, gamma, beta) = (1.0 + alpha, 0.5 - alpha, 0.25 * (1.0 - alpha).powi(2));
            (-8..=16).any(|k| {
                let stiffness = 4.0_f64.powi(k);
                // times sqrt(stiffness)^n, so that all three are of one size; dt = 1, mass 1
                let omega = stiffness.sqrt();
                let [mut q, mut v, mut a] = [1.0_f64, 0.3, -1.0];
                for _ in 0..4000 {
                    let held = q + w * (v * omega + (0.5 - beta) * a * stiffness);
                    let next = -held / (1.0 + w * beta * stiffness);
                    q += omega * v + stiffness * ((0.5 - beta) * a + beta * next);
                    v += omega * ((1.0 - gamma) * a + gamma * next);
                    a = next;
                }
                [q, v, a].iter().any(|x| x.is_nan() || x.abs() > 1e3)
            })
        };
        for alpha in [0.0, -0.1, -1.0 / 3.0, -0.414, -0.49] {
            assert!(!grows(alpha) && Integrator::Hht { alpha }.checked().is_ok(), "{alpha}");
        }
        for alpha in [-0.51, -0.6] {
            assert!(grows(alpha) && Integrator::Hht { alpha }.checked().is_err(), "{alpha}");
        }
    }

    #[test]
    fn unstable_integrators_are_refused() {
        for bad in [
            Integrator::Hht { alpha: 0.667 },
            Integrator::Newmark { gamma: 0.4, beta: 0.25 },
            Integrator::Newmark { gamma: 0.5, beta: 1.0 / 6.0 },
            Integrator::GeneralizedAlpha { rho_inf: f64::NAN },
        ] {
            assert!(bad.checked().is_err(), "{bad:?}");
        }
        for good in [Integrator::HHT_MOST, Integrator::Hht { alpha: -0.414 }, Integrator::Trbdf2] {
            assert_eq!(good.checked(), Ok(good));
        }
    }
}
