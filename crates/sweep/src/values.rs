//! Lists and ranges of numbers in a sweep file.
//!
//! ```toml
//! size_m = 2.0
//! size_m = [1.0, 2.0, 5.0]
//! size_m = { from = 1.0, to = 30.0, count = 40, spacing = "log" }   # or "linear", the default
//! ```

use serde::Deserialize;

/// One number, some numbers, or a range of them: at least one, all finite.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "WrittenValues")]
pub(crate) struct Values(Vec<f64>);

#[derive(Clone, Copy)]
enum Spacing {
    Linear,
    Log,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Range {
    from: f64,
    to: f64,
    count: usize,
    /// "linear" unless given, or "log": told here, since an untagged enum forgets what was wrong.
    spacing: Option<String>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "give a number, a list of numbers, or { from = 1.0, to = 9.0, count = 5, spacing \
                 = \"log\" }"
)]
enum WrittenValues {
    One(f64),
    Some(Vec<f64>),
    Range(Range),
}

/// No list is longer.
const MOST: usize = 100_000;

impl TryFrom<WrittenValues> for Values {
    type Error = String;

    fn try_from(written: WrittenValues) -> Result<Self, String> {
        let values = match written {
            WrittenValues::One(x) => vec![x],
            WrittenValues::Some(list) => list,
            WrittenValues::Range(range) => range.values()?,
        };
        if values.is_empty() || values.len() > MOST {
            return Err(format!("{} values; give 1 to {MOST} numbers", values.len()));
        }
        match values.iter().find(|x| !x.is_finite()) {
            Some(x) => Err(format!("{x} is not finite; give finite numbers")),
            None => Ok(Self(values)),
        }
    }
}

impl Range {
    fn values(&self) -> Result<Vec<f64>, String> {
        let Self { from, to, count, .. } = *self;
        let spacing = match self.spacing.as_deref() {
            None | Some("linear") => Spacing::Linear,
            Some("log") => Spacing::Log,
            Some(other) => {
                return Err(format!("spacing is {other:?}; give \"linear\" or \"log\""));
            }
        };
        let rises = to > from;
        if !(2..=MOST).contains(&count) || !rises {
            return Err(format!(
                "from {from:?} to {to:?} in {count}; give to greater than from, count 2 to {MOST}"
            ));
        }
        let steps = (count - 1) as f64;
        let share = |i: usize| i as f64 / steps;
        let value = |i: usize| match spacing {
            _ if i + 1 == count => to,
            Spacing::Linear => from + (to - from) * share(i),
            Spacing::Log => from * (to / from).powf(share(i)),
        };
        match spacing {
            Spacing::Log if from <= 0.0 => {
                Err(format!("from {from:?}; a logarithm wants numbers greater than zero"))
            }
            _ => Ok((0..count).map(value).collect()),
        }
    }
}

impl Values {
    /// The numbers, at least one.
    pub(crate) fn all(&self) -> &[f64] {
        &self.0
    }

    /// The first that is not within a range.
    pub(crate) fn outside(&self, low: f64, high: f64) -> Option<f64> {
        self.0.iter().copied().find(|x| !(low..=high).contains(x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Deserialize)]
    struct File {
        x: Values,
    }

    fn read(text: &str) -> Result<Vec<f64>, String> {
        toml::from_str::<File>(text).map(|file| file.x.0).map_err(|e| e.message().to_string())
    }

    #[test]
    fn a_number_a_list_and_a_range_can_be_given() {
        assert_eq!(read("x = 2"), Ok(vec![2.0]));
        assert_eq!(read("x = [1.0, 3]"), Ok(vec![1.0, 3.0]));
        assert_eq!(read("x = { from = 1, to = 2, count = 3 }"), Ok(vec![1.0, 1.5, 2.0]));
        let log = read("x = { from = 1.0, to = 100.0, count = 3, spacing = \"log\" }").unwrap();
        assert!((log[1] - 10.0).abs() < 1e-14 && log[2] == 100.0);
    }

    #[test]
    fn what_is_no_range_is_refused() {
        for (text, word) in [
            ("x = []", "0 values"),
            ("x = [nan]", "not finite"),
            ("x = { from = 2, to = 1, count = 3 }", "to greater than from"),
            ("x = { from = 0.0, to = 1.0, count = 3, spacing = \"log\" }", "logarithm"),
            ("x = \"all\"", "give a number"),
            (
                "x = { from = 1.0, to = 2.0, count = 3, spacing = \"lin\" }",
                "spacing is \"lin\"; give \"linear\" or \"log\"",
            ),
        ] {
            let said = read(text).unwrap_err();
            assert!(said.contains(word), "{text}: {said}");
        }
    }
}
