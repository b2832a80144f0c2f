//! Figures of fragility: all states of all structures, overturning structure by structure.

use std::path::Path;

use super::{CommandError, PANELS, motions, restitution_shown};
use figures::fragility as probability;
use sweep::{
    fragility::{Fragility, FragilityRow, LimitState, MEASURES},
    lognormal::LognormalFit,
    plan::Plan,
    reduce::MODELS,
};

/// Points of a curve, and of what was observed.
const POINTS: usize = 120;
const OBSERVED: usize = 24;

/// Both figures: all states for all structures together, and overturning structure by structure.
pub fn fragility(plan: &Plan, fragility: &Fragility, path: &Path) -> Result<(), CommandError> {
    let states = LimitState::all(plan);
    let several = plan.subjects.len() > 1;
    let (first, half_width) = (fragility.members[0].model, fragility.half_width());
    let of = |row: &FragilityRow| &fragility.members[row.member];
    let main = |row: &FragilityRow| {
        let member = of(row);
        member.model == first && member.restitution == 0 && member.subject.is_none() == several
    };
    let curve = |row: &FragilityRow, entry: usize| {
        let observed = fragility.observed(row, &states, OBSERVED);
        curve(row, entry, half_width, observed)
    };
    let model = if MODELS[first] == "fem" { "finite elements" } else { "Housner" };
    let e = restitution_shown(plan);
    let who = all_of(plan);
    let names: Vec<String> =
        states.iter().map(|state| state.name().replace("theta/alpha", "|θ|/α")).collect();
    // curves of the rows for which there is an entry of the legend, a panel a measure
    let save = |what: String,
                names: &[String],
                entry: &dyn Fn(&FragilityRow) -> Option<usize>,
                path: &Path| {
        let rows = |index: usize| fragility.rows.iter().filter(move |row| row.measure == index);
        let curves = |index: usize| rows(index).filter_map(|row| curve(row, entry(row)?)).collect();
        let measures: Vec<probability::MeasurePanel> = (0..MEASURES.len())
            .map(|index| {
                let separates =
                    rows(index).any(|row| entry(row).is_some() && separated(row).is_some());
                probability::MeasurePanel {
                    label: measure_label(index),
                    curves: curves(index),
                    remark: if separates { SEPARATED } else { "" },
                }
            })
            .filter(|measure| !measure.curves.is_empty())
            .collect();
        if measures.is_empty() {
            return Ok::<_, CommandError>(());
        }
        let drawn = |entry: usize| {
            measures.iter().any(|measure| measure.curves.iter().any(|curve| curve.entry == entry))
        };
        let named = |(entry, name): (usize, &String)| match drawn(entry) {
            true => name.clone(),
            false => format!("{name}: no fit"),
        };
        let names: Vec<String> = names.iter().enumerate().map(named).collect();
        let title = format!("{what}, {}, {model}{e}", motions(plan));
        let label = probability_label(fragility);
        let data = probability::FragilityFigure {
            title: &title,
            entries: &names,
            measures: &measures,
            probability_label: &label,
        };
        Ok(probability::draw(&data)?.save(path)?)
    };
    let state =
        |row: &FragilityRow| states.iter().position(|state| main(row) && *state == row.state);
    save(format!("Fragility, {who}"), &names, &state, path)?;
    if !several {
        return Ok(());
    }
    let shown = plan.subjects.len().min(PANELS);
    let names: Vec<String> =
        plan.subjects.iter().take(shown).map(|subject| subject.name.clone()).collect();
    let alone = |row: &FragilityRow| {
        let member = of(row);
        let overturning = row.state == LimitState::Overturning
            && member.model == first
            && member.restitution == 0;
        member.subject.filter(|subject| overturning && *subject < shown)
    };
    let each = path.with_file_name("fragility_structures.png");
    save(overturning_of(shown, plan), &names, &alone, &each)?;
    Ok(())
}

/// A measure of intensity with its unit.
fn measure_label(index: usize) -> String {
    let (name, unit) = MEASURES[index];
    let unit = if unit == "-" { String::new() } else { format!(" [{unit}]") };
    format!("{}{unit}", name.replace("alpha", "α"))
}

/// The structures whose overturning a figure shows.
fn overturning_of(shown: usize, plan: &Plan) -> String {
    match plan.subjects.len() {
        all if all > shown => format!("Overturning of {shown} of {all} structures"),
        _ => "Overturning of each structure".to_string(),
    }
}

/// What a fit shows; there are no bounds of one record, nor of records that do not differ.
fn probability_label(fragility: &Fragility) -> String {
    match fragility.rows.iter().any(|row| row.covariance.is_some()) {
        true => format!("probability, {:.0} % bounds", 100.0 * fragility.confidence),
        false => "probability, without bounds".into(),
    }
}

/// Beyond what was computed a fit is not drawn by more than this factor.
const BEYOND: f64 = 1.5;

/// From 0.2 % to 99.8 % of a fit; a step where a measure separates what exceeds from what does not.
fn curve(
    row: &FragilityRow,
    entry: usize,
    half_width: f64,
    observed: Vec<(f64, f64)>,
) -> Option<probability::FragilityCurve> {
    use sweep::lognormal::phi;
    if let Some((below, above)) = separated(row) {
        return Some(step((below, above), entry, observed));
    }
    let fit = row.probit()?;
    let x: Vec<f64> = (0..POINTS)
        .map(|i| {
            fit.median() * (fit.beta() * 2.9 * (2.0 * i as f64 / (POINTS - 1) as f64 - 1.0)).exp()
        })
        .filter(|x| (row.range.0 / BEYOND..=row.range.1 * BEYOND).contains(x))
        .collect();
    if x.len() < 2 {
        return None;
    }
    let deviation = |x: f64| row.covariance.map_or(0.0, |all| fit.deviation_at(all, x));
    let at = |side: f64| -> Vec<f64> {
        x.iter().map(|x| phi(fit.a + fit.b * x.ln() + side * half_width * deviation(*x))).collect()
    };
    Some(probability::FragilityCurve {
        entry,
        probability: at(0.0),
        low: at(-1.0),
        high: at(1.0),
        observed,
        x,
    })
}

/// What is said of a step.
const SEPARATED: &str = "a step: all above exceed, none below";

/// How far before and after it a step is drawn, as a factor.
const BESIDE: f64 = 1.2;

/// The greatest intensity that does not exceed and the least that does, where all that exceed lie
/// above all that do not.
fn separated(row: &FragilityRow) -> Option<(f64, f64)> {
    match row.fit {
        LognormalFit::Separated { below, above } => Some((below, above)),
        _ => None,
    }
}

/// A step between two intensities at their geometric mean; its bounds are those two.
fn step(
    (below, above): (f64, f64),
    entry: usize,
    observed: Vec<(f64, f64)>,
) -> probability::FragilityCurve {
    let middle = (below * above).sqrt();
    let (first, last) = (below / BESIDE, above * BESIDE);
    probability::FragilityCurve {
        entry,
        x: vec![first, below, below, middle, middle, above, above, last],
        probability: vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0],
        low: vec![0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0],
        high: vec![0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0],
        observed,
    }
}

/// The structures of a figure of all of them.
fn all_of(plan: &Plan) -> String {
    match &plan.subjects[..] {
        [one] => one.name.clone(),
        [_, _] => "both structures".into(),
        all => format!("all {} structures", all.len()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The step of Phi(ln(x/theta)/beta) as beta goes to nothing; what lies between the two
    /// intensities is not known.
    #[test]
    fn what_a_measure_separates_is_a_step_between_the_two() {
        let step = step((0.5, 2.0), 3, Vec::new());
        let limit = |x: f64| if x < 1.0 { 0.0 } else { 1.0 };
        for ((x, p), (low, high)) in
            step.x.iter().zip(&step.probability).zip(step.low.iter().zip(&step.high))
        {
            assert!(*x == 1.0 || *p == limit(*x), "{x} {p}");
            assert!(low <= p && p <= high);
            assert!((0.5..=2.0).contains(x) || low == high);
        }
        assert!(step.x.is_sorted() && step.entry == 3);
        assert!(step.x.iter().zip(&step.probability).filter(|(x, _)| **x == 1.0).count() == 2);
    }
}
