//! Bounds on a fit. At fixed mu each is a bound on z = (ln K, ln C), so together they are a box:
//!
//! ```text
//!  K = mu f^2,   C = 2 mu xi,   settlement s = m1 g/2 (1/k1 + 1/k2) = g (1 + 1/K) / (2 Omega_n^2)
//! ```

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Bounds on the fitted parameters, each optional; `[bounds]` in a case file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Bounds {
    /// Smallest frequency ratio f [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub f_min: Option<f64>,
    /// Largest frequency ratio f [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub f_max: Option<f64>,
    /// Smallest damping ratio xi [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub xi_min: Option<f64>,
    /// Largest damping ratio xi [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub xi_max: Option<f64>,
    /// Smallest stiffness ratio K = k2/k1 [-].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub k_min: Option<f64>,
}

/// What is wrong with bounds, and what to do.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum BoundsError {
    #[error("bounds: {name} is {value:?}; give a finite number greater than zero, or leave it out")]
    NotPositive { name: &'static str, value: f64 },
    #[error(
        "bounds: nothing lies between {low_name} ({quantity} >= {low:.6}) and {high_name} \
         ({quantity} <= {high:.6}) for mu = {mu}; loosen one of them"
    )]
    Empty {
        quantity: &'static str,
        low_name: &'static str,
        low: f64,
        high_name: &'static str,
        high: f64,
        mu: f64,
    },
}

/// The box low <= z <= high that bounds make at one mu, and the name of each side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Region {
    pub low: Vector2<f64>,
    pub high: Vector2<f64>,
    pub low_names: [&'static str; 2],
    pub high_names: [&'static str; 2],
}

/// The side of the box where nothing was asked.
const SEARCH_RANGE: &str = "search_range";

impl Bounds {
    /// The box of z at mass ratio mu.
    pub(crate) fn region(&self, mu: f64) -> Result<Region, BoundsError> {
        // Far beyond any optimum: the minimax has K between 1/2 and about mu, C between 1.8 and
        // about 1.3 sqrt(mu).
        let (least, most) = (1e-4, 1e4 * mu.max(1.0));
        let mut sides =
            [Side { low: least, low_name: SEARCH_RANGE, high: most, high_name: SEARCH_RANGE }; 2];
        let k = |f: f64| mu * f * f;
        let c = |xi: f64| 2.0 * mu * xi;
        let given = |name, value: Option<f64>| match value {
            Some(value) if !(value.is_finite() && value > 0.0) => {
                Err(BoundsError::NotPositive { name, value })
            }
            other => Ok(other),
        };
        if let Some(f) = given("f_min", self.f_min)? {
            sides[0].raise(k(f), "f_min");
        }
        if let Some(k_min) = given("k_min", self.k_min)? {
            sides[0].raise(k_min, "k_min");
        }
        if let Some(f) = given("f_max", self.f_max)? {
            sides[0].lower(k(f), "f_max");
        }
        if let Some(xi) = given("xi_min", self.xi_min)? {
            sides[1].raise(c(xi), "xi_min");
        }
        if let Some(xi) = given("xi_max", self.xi_max)? {
            sides[1].lower(c(xi), "xi_max");
        }
        for (Side { low, low_name, high, high_name }, quantity) in sides.into_iter().zip(["K", "C"])
        {
            if low > high {
                return Err(BoundsError::Empty { quantity, low_name, low, high_name, high, mu });
            }
        }
        let [k, c] = sides;
        Ok(Region {
            low: Vector2::new(k.low, c.low).map(f64::ln),
            high: Vector2::new(k.high, c.high).map(f64::ln),
            low_names: [k.low_name, c.low_name],
            high_names: [k.high_name, c.high_name],
        })
    }
}

/// The bounds on one of K and C, and what each is called.
#[derive(Clone, Copy)]
struct Side {
    low: f64,
    low_name: &'static str,
    high: f64,
    high_name: &'static str,
}

impl Side {
    fn raise(&mut self, value: f64, name: &'static str) {
        if value > self.low {
            (self.low, self.low_name) = (value, name);
        }
    }

    fn lower(&mut self, value: f64, name: &'static str) {
        if value < self.high {
            (self.high, self.high_name) = (value, name);
        }
    }
}

impl Region {
    /// The nearest z inside.
    pub(crate) fn clamp(&self, z: &Vector2<f64>) -> Vector2<f64> {
        z.sup(&self.low).inf(&self.high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_that_leave_nothing_are_named() {
        let bounds = Bounds { f_max: Some(1.0), k_min: Some(3.0), ..Bounds::default() };
        assert!(bounds.region(4.0).is_ok());
        let error = bounds.region(2.0).unwrap_err();
        assert!(
            matches!(error, BoundsError::Empty { low_name: "k_min", high_name: "f_max", .. }),
            "{error}"
        );
        let error = Bounds { xi_max: Some(f64::NAN), ..Bounds::default() }.region(1.0).unwrap_err();
        assert!(matches!(error, BoundsError::NotPositive { name: "xi_max", .. }));
    }
}
