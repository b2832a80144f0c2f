//! The wanted shape of the response (section 5.1 of the paper): near uniform at the low frequencies
//! of rocking, capped in between, rolling off above.
//!
//! A target is a list of bands in g = omega/Omega_n. Each gives, at every g inside, an excess
//!
//! ```text
//!  cap        w ln( ARR / limit )                    ARR stays below limit
//!  roll_off   w ln( ARR g^2 / limit )                ARR stays below limit / g^2
//!  uniform    w ( |ln( ARR / ARR(0) )| - ln(1 + x) ) ARR is flat within the share x = limit
//!  rigid      w ( |ln ARR| - ln(1 + x) )             ARR is that of rigid ground at rest, 1, within the share x
//! ```
//!
//! and the fit makes the largest excess over all bands and g as small as it can; the target is met
//! when that is zero or less. The weight w decides which band gives way when not all can be met.
//! The default target is one cap with limit 1 over all g: it asks for the smallest largest ARR.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The bands of the wanted response; `[[target.bands]]` in a case file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Target {
    /// At least one band; they may overlap.
    pub bands: Vec<Band>,
}

/// What a band asks of ARR.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BandKind {
    /// ARR <= limit.
    Cap,
    /// ARR within the share `limit` of ARR(0), above or below.
    Uniform,
    /// ARR within the share `limit` of 1, above or below.
    Rigid,
    /// ARR <= limit / g^2.
    RollOff,
}

/// One band of frequency ratios and what it asks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Band {
    /// Where the band begins, g = omega/Omega_n [-]; 0 unless given.
    #[serde(default)]
    pub g_low: f64,
    /// Where the band ends, g = omega/Omega_n [-]; no end unless given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub g_high: Option<f64>,
    /// What the band asks.
    pub kind: BandKind,
    /// The limit of that kind [-]: a largest ARR, a largest ARR g^2, or a share (0.05 is 5 %).
    pub limit: f64,
    /// Weight w of the excess [-]; 1 unless given.
    #[serde(default = "one")]
    pub weight: f64,
}

fn one() -> f64 {
    1.0
}

/// What is wrong with a target, and what to do. Bands count from 1.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum TargetError {
    #[error(
        "target: it has no band; give at least one [[target.bands]], or leave the target out for \
         the default cap"
    )]
    Empty,
    #[error(
        "target: band {band} runs from g_low = {g_low} to g_high = {g_high}; give 0 <= g_low < \
         g_high (leave g_high out for no end)"
    )]
    Range { band: usize, g_low: f64, g_high: f64 },
    #[error("target: band {band} has {name} = {value}; give a finite number greater than zero")]
    NotPositive { band: usize, name: &'static str, value: f64 },
    #[error(
        "target: band {band} is a roll_off from g_low = 0, where limit / g^2 has no meaning; give \
         g_low > 0"
    )]
    RollOffFromZero { band: usize },
    #[error(
        "target: band {band} is {kind} without an end, but ARR falls to zero as g grows; give \
         g_high"
    )]
    FlatWithoutEnd { band: usize, kind: &'static str },
}

impl Default for Target {
    /// The flat cap: make the largest ARR over all g as small as possible.
    fn default() -> Self {
        Self {
            bands: vec![Band {
                g_low: 0.0,
                g_high: None,
                kind: BandKind::Cap,
                limit: 1.0,
                weight: 1.0,
            }],
        }
    }
}

impl Target {
    /// The target itself if a fit can work on it.
    pub(crate) fn checked(self) -> Result<Self, TargetError> {
        if self.bands.is_empty() {
            return Err(TargetError::Empty);
        }
        for (index, band) in self.bands.iter().enumerate() {
            band.check(index + 1)?;
        }
        Ok(self)
    }
}

impl Band {
    fn check(&self, band: usize) -> Result<(), TargetError> {
        let (g_low, g_high) = (self.g_low, self.g_high.unwrap_or(f64::INFINITY));
        if !(g_low.is_finite() && g_low >= 0.0 && g_high > g_low) {
            return Err(TargetError::Range { band, g_low, g_high });
        }
        for (name, value) in [("limit", self.limit), ("weight", self.weight)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(TargetError::NotPositive { band, name, value });
            }
        }
        match self.kind {
            BandKind::RollOff if g_low == 0.0 => Err(TargetError::RollOffFromZero { band }),
            BandKind::Uniform if g_high.is_infinite() => {
                Err(TargetError::FlatWithoutEnd { band, kind: "uniform" })
            }
            BandKind::Rigid if g_high.is_infinite() => {
                Err(TargetError::FlatWithoutEnd { band, kind: "rigid" })
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_file_spells_bands_as_documented() {
        let text = "
            [[bands]]
            kind = \"uniform\"
            g_high = 0.2
            limit = 0.05
            weight = 2.0
            [[bands]]
            kind = \"roll_off\"
            g_low = 2.0
            limit = 4.0
        ";
        let target: Target = toml::from_str(text).unwrap();
        let uniform = Band {
            g_low: 0.0,
            g_high: Some(0.2),
            kind: BandKind::Uniform,
            limit: 0.05,
            weight: 2.0,
        };
        let roll_off =
            Band { g_low: 2.0, g_high: None, kind: BandKind::RollOff, limit: 4.0, weight: 1.0 };
        assert_eq!(target.clone().checked().unwrap().bands, [uniform, roll_off]);
        let back: Target = toml::from_str(&toml::to_string(&target).unwrap()).unwrap();
        assert_eq!(back, target);
    }

    #[test]
    fn an_unknown_key_is_an_error() {
        let error =
            toml::from_str::<Target>("[[bands]]\nkind = \"cap\"\nlimit = 2.0\ng_hihg = 1.0")
                .unwrap_err();
        assert!(error.to_string().contains("g_hihg"), "{error}");
    }

    #[test]
    fn senseless_bands_are_named_by_their_number() {
        let good = Target::default().bands[0];
        let check = |band: Band| Target { bands: vec![good, band] }.checked().unwrap_err();
        assert_eq!(Target { bands: vec![] }.checked().unwrap_err(), TargetError::Empty);
        assert!(matches!(
            check(Band { g_high: Some(0.0), ..good }),
            TargetError::Range { band: 2, .. }
        ));
        assert!(matches!(
            check(Band { g_low: f64::NAN, ..good }),
            TargetError::Range { band: 2, .. }
        ));
        assert!(matches!(
            check(Band { limit: 0.0, ..good }),
            TargetError::NotPositive { name: "limit", .. }
        ));
        assert!(matches!(
            check(Band { weight: -1.0, ..good }),
            TargetError::NotPositive { name: "weight", .. }
        ));
        assert_eq!(
            check(Band { kind: BandKind::RollOff, ..good }),
            TargetError::RollOffFromZero { band: 2 }
        );
        assert!(matches!(
            check(Band { kind: BandKind::Rigid, ..good }),
            TargetError::FlatWithoutEnd { band: 2, .. }
        ));
    }
}
