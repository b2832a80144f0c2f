//! The levels of a sweep.

use serde::Serialize;

use crate::{
    SweepError,
    spec::{SweepKind, SweepSource},
};

/// What the levels are levels of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// The factor on the acceleration.
    Scale,
    /// The peak ground acceleration (g).
    PgaG,
    /// PGA over that which lifts the body, g tan alpha.
    PgaOverUplift,
}

/// What the file's levels are levels of, and the levels.
pub(super) fn levels(
    source: &SweepSource,
    kind: SweepKind,
) -> Result<(Measure, Vec<f64>), SweepError> {
    let Some(section) = &source.spec.levels else {
        if matches!(kind, SweepKind::Rocking | SweepKind::Compare) {
            return Ok((Measure::Scale, vec![1.0]));
        }
        let remedy = "no [levels]; give scale, pga_g or pga_over_uplift";
        return Err(source.at(&source.spec.sweep.kind, remedy));
    };
    let all = section.get_ref();
    let given = [
        (Measure::Scale, "scale", &all.scale, 100.0),
        (Measure::PgaG, "pga_g", &all.pga_g, 50.0),
        (Measure::PgaOverUplift, "pga_over_uplift", &all.pga_over_uplift, 1e4),
    ];
    let mut given = given
        .into_iter()
        .filter_map(|(m, name, values, most)| values.as_ref().map(|v| (m, name, v, most)));
    let (Some((measure, name, values, most)), None) = (given.next(), given.next()) else {
        return Err(source.at(section, "levels: give one of scale, pga_g and pga_over_uplift"));
    };
    let mut levels = source.all_within(name, values, 1e-6, most)?;
    let mut sorted = levels.clone();
    sorted.sort_by(f64::total_cmp);
    if let Some(pair) = sorted.windows(2).find(|pair| pair[0] == pair[1]) {
        let message = format!("{name} has {} twice, which counts twice; take one out", pair[0]);
        return Err(source.at(values, message));
    }
    if kind == SweepKind::Overturning {
        if measure != Measure::PgaOverUplift || levels.len() < 2 {
            let remedy = "an overturning spectrum scans pga_over_uplift; give a range, as { from = \
                          1.0, to = 12.0, count = 400, spacing = \"log\" }";
            return Err(source.at(values, remedy));
        }
        levels.sort_by(f64::total_cmp);
    }
    Ok((measure, levels))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_that_is_there_twice_is_refused() {
        let of = |values: &str| {
            let text = format!("[sweep]\nkind = 'fragility'\n[levels]\nscale = {values}\n");
            levels(&SweepSource::parse("a.toml".into(), text).unwrap(), SweepKind::Fragility)
        };
        assert_eq!(of("[1.0, 0.5]").unwrap().1, [1.0, 0.5]);
        assert_eq!(
            of("[1.0, 0.5, 1.0]").unwrap_err().to_string(),
            "a.toml, line 4: scale has 1 twice, which counts twice; take one out"
        );
    }
}
