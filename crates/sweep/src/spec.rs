//! The sweep file: what is asked for, as it is written.
//!
//! ```toml
//! [sweep]
//! kind = "fragility"                  # or "overturning", "rocking", "compare"
//! model = "housner"                   # or "fem", "both"; left out: "both" for "compare", else "housner"
//! seed = 1                            # of the motions made
//! restitution = [0.9, 0.95]           # velocity ratio; left out: each structure's own
//! ratios = [0.1, 0.5]                 # of theta/alpha whose exceedance is fitted, beside rocking and overturning
//! confidence = 0.9                    # of the bounds
//!
//! [[structure]]                       # as in a case file; as many as wanted
//! kind = "aframe"
//! height_m = 61.0
//! width_m = 12.2
//! mass_kg = 680.1e3
//! name = "tower"                      # in tables and figures; by kind, R and alpha unless given
//! damper = { c_ns_per_m = 1e6 }       # also tendon = { stiffness_n_per_m = 1e8, pretension_n = 1e6 }: by Housner's equation
//!
//! [grid]                              # or all combinations of
//! kind = ["block"]
//! size_m = { from = 1.0, to = 30.0, count = 40, spacing = "log" }   # R, from a foot to the centre of mass
//! slenderness = [0.1, 0.2]            # alpha (rad)
//!
//! [records]
//! files = ["motion.at2"]              # relative to the sweep file; also dt_s, units, component, baseline, vertical = "auto"
//! folder = "records"
//! el_centro = true
//! synthetic = 100                     # made for each structure
//! earthquakes = 100                   # like earthquakes, the same for all structures
//! like = "floor.csv"                  # made with the response spectrum and the envelope of this record
//! like_count = 100                    # how many of them
//! duration_s = 20.0
//!
//! [[pulse]]
//! shape = "half-sine"                 # "sine", "ricker", "ricker-antisymmetric", "mavroeidis-papageorgiou" with gamma, nu
//! omega_over_p = [1.0, 2.0, 5.0]      # or frequency_hz
//!
//! [levels]                            # one of the three
//! scale = [0.5, 1.0, 2.0]             # factor on the records; pulses have a peak of 1 g
//! pga_g = [0.2, 0.4]
//! pga_over_uplift = { from = 1.0, to = 8.0, count = 60 }            # PGA/(g tan alpha)
//!
//! [springs]
//! accuracy = 0.002
//! max_omega_hz = 2000.0
//! ```

mod elastic;

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use toml::Spanned;

use super::{SweepError, named::NamedStructure, pulse, values::Values};
use cases::parse_error;
use rocking::structure;
use strong_motion::{Units, VerticalFrom};

/// What a sweep asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SweepKind {
    /// Peak theta/alpha against intensity, and probabilities with lognormal fits.
    Fragility,
    /// The intervals of pulse amplitude that overturn.
    Overturning,
    /// Peak theta/alpha over 1/p and alpha.
    Rocking,
    /// Rigid against springs.
    Compare,
}

/// By what the histories are computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SweepModel {
    /// Housner's equation.
    Housner,
    /// Finite elements on springs.
    Fem,
    /// Both, beside each other.
    Both,
}

impl SweepModel {
    /// Whether Housner's equation is among them.
    pub fn housner(self) -> bool {
        self != Self::Fem
    }

    /// Whether the finite elements are among them.
    pub fn fem(self) -> bool {
        self != Self::Housner
    }
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepSection {
    pub kind: Spanned<SweepKind>,
    pub model: Option<Spanned<SweepModel>>,
    #[serde(default = "first_seed")]
    pub seed: u64,
    pub restitution: Option<Spanned<Values>>,
    pub ratios: Option<Spanned<Values>>,
    pub confidence: Option<Spanned<f64>>,
    /// Cells to a part; by the model unless given.
    pub part: Option<Spanned<usize>>,
}

fn first_seed() -> u64 {
    1
}

/// One kind or several.
#[derive(Clone, Debug, Deserialize)]
#[serde(untagged, expecting = "give \"aframe\", \"block\", or a list of them")]
pub(crate) enum Kinds {
    One(structure::Kind),
    Some(Vec<structure::Kind>),
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Grid {
    pub kind: Kinds,
    pub size_m: Spanned<Values>,
    pub slenderness: Spanned<Values>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct Records {
    pub files: Vec<PathBuf>,
    pub folder: Option<PathBuf>,
    pub el_centro: bool,
    pub synthetic: Option<Spanned<usize>>,
    pub earthquakes: Option<Spanned<usize>>,
    pub like: Option<Spanned<PathBuf>>,
    pub like_count: Option<Spanned<usize>>,
    pub dt_s: Option<f64>,
    pub units: Option<Units>,
    pub component: Option<String>,
    pub baseline: bool,
    pub vertical: Option<Spanned<VerticalFrom>>,
    pub duration_s: Option<Spanned<f64>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PulseSection {
    pub shape: Spanned<pulse::Name>,
    pub gamma: Option<Spanned<f64>>,
    pub nu: Option<f64>,
    pub omega_over_p: Option<Spanned<Values>>,
    pub frequency_hz: Option<Spanned<Values>>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct LevelsSection {
    pub scale: Option<Spanned<Values>>,
    pub pga_g: Option<Spanned<Values>>,
    pub pga_over_uplift: Option<Spanned<Values>>,
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct SpringsSection {
    pub accuracy: Option<Spanned<f64>>,
    pub max_omega_hz: Option<Spanned<f64>>,
}

/// A sweep file, its numbers read but not put together.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Spec {
    pub sweep: SweepSection,
    #[serde(default)]
    pub structure: Vec<Spanned<NamedStructure>>,
    pub grid: Option<Spanned<Grid>>,
    #[serde(default)]
    pub records: Records,
    #[serde(default)]
    pub pulse: Vec<PulseSection>,
    pub levels: Option<Spanned<LevelsSection>>,
    #[serde(default)]
    pub springs: SpringsSection,
}

/// A sweep file and its text, to say lines of.
pub(crate) struct SweepSource {
    pub path: String,
    pub text: String,
    pub spec: Spec,
}

/// Whether a file that is no sweep is a case: one structure, and nothing of a sweep.
fn is_case(text: &str) -> bool {
    let has = |section: &str| text.lines().any(|line| line.trim().starts_with(section));
    has("[structure]") && !has("[sweep]")
}

impl SweepSource {
    /// Read a sweep file.
    ///
    /// # Errors
    /// It cannot be read, or a key or a number in it is wrong: with its line.
    pub(crate) fn read(path: &Path) -> Result<Self, SweepError> {
        let name = path.display().to_string();
        let text = files::input::text(path)
            .map_err(|source| SweepError::Read { path: name.clone(), source })?;
        Self::parse(name, text)
    }

    /// The same from its text; `path` names it and is where its records' paths start.
    ///
    /// # Errors
    /// As [`SweepSource::read`].
    pub(crate) fn parse(path: String, text: String) -> Result<Self, SweepError> {
        match toml::from_str(&text) {
            Ok(spec) => Ok(Self { path, text, spec }),
            Err(_) if is_case(&text) => Err(SweepError::IsCase { path }),
            Err(e) => Err(elastic::refusal(&path, &text)
                .unwrap_or_else(|| parse_error(&path, &text, &e).into())),
        }
    }

    /// Where records' paths start.
    pub(crate) fn folder(&self) -> &Path {
        Path::new(&self.path).parent().unwrap_or(Path::new(""))
    }

    /// An error at a value of the file.
    pub(crate) fn at<T>(&self, value: &Spanned<T>, message: impl Into<String>) -> SweepError {
        let line = line_of(&self.text, value);
        SweepError::Spec { path: self.path.clone(), line, message: message.into() }
    }

    /// A number within bounds.
    ///
    /// # Errors
    /// It is not, or not finite.
    pub(crate) fn within(
        &self,
        name: &str,
        value: &Spanned<f64>,
        low: f64,
        high: f64,
    ) -> Result<f64, SweepError> {
        let x = *value.get_ref();
        if (low..=high).contains(&x) {
            Ok(x)
        } else {
            Err(self.at(value, format!("{name} is {x:?}; give a number from {low:?} to {high:?}")))
        }
    }

    /// Numbers within bounds.
    ///
    /// # Errors
    /// One is not.
    pub(crate) fn all_within(
        &self,
        name: &str,
        values: &Spanned<Values>,
        low: f64,
        high: f64,
    ) -> Result<Vec<f64>, SweepError> {
        match values.get_ref().outside(low, high) {
            Some(x) => {
                Err(self
                    .at(values, format!("{name} has {x:?}; give numbers from {low:?} to {high:?}")))
            }
            None => Ok(values.get_ref().all().to_vec()),
        }
    }
}

/// The line of a value of a text.
fn line_of<T>(text: &str, value: &Spanned<T>) -> usize {
    text[..value.span().start.min(text.len())].matches('\n').count() + 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::de::value::{Error, StrDeserializer};

    /// Words that users have in their files.
    #[test]
    fn words_of_sweep_files_are_those_of_the_documents() {
        let model = |word| SweepModel::deserialize(StrDeserializer::<Error>::new(word));
        assert_eq!(model("housner"), Ok(SweepModel::Housner));
        assert_eq!(model("fem"), Ok(SweepModel::Fem));
        assert_eq!(model("both"), Ok(SweepModel::Both));
        let kind = |word| SweepKind::deserialize(StrDeserializer::<Error>::new(word));
        let words = ["fragility", "overturning", "rocking", "compare"].map(kind);
        assert_eq!(
            words.map(Result::unwrap),
            [SweepKind::Fragility, SweepKind::Overturning, SweepKind::Rocking, SweepKind::Compare]
        );
    }
}
