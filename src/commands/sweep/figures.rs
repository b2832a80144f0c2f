//! The figures of a sweep, from its tables.

mod fragility;

use std::path::Path;

use super::super::CommandError;
use figures::{ida as levels, overturning as spectra, peaks, rocking as maps};
use rocking::structure::Kind;
use sweep::{
    compare::Comparison,
    ida::{Ida, IdaPoint},
    motion::SweepMotion,
    plan::{Measure, Plan},
    reduce::{MODELS, models},
};
use sweep_table::SweepTable;

pub use fragility::fragility;

/// Panels beyond which a figure is no figure.
const PANELS: usize = 6;
/// How many structures a figure shows, where these are not all.
fn of_structures(shown: usize, plan: &Plan) -> String {
    match plan.subjects.len() {
        all if all > shown => format!(", {shown} of {all} structures"),
        _ => String::new(),
    }
}

fn motions(plan: &Plan) -> String {
    let all = plan.motions.len();
    format!("{all} {}", if all == 1 { "motion" } else { "motions" })
}

/// How many motions have lines of their own, where these are not all.
fn grey_lines(shown: usize, all: usize) -> String {
    match shown {
        0 => String::new(),
        shown if shown < all => format!(" ({shown} as grey lines)"),
        _ => String::new(),
    }
}

/// The restitution that a figure shows, where a sweep has several: the first.
fn restitution_shown(plan: &Plan) -> String {
    match plan.restitutions.as_deref() {
        Some([first, _, ..]) => format!(", e = {first}"),
        _ => String::new(),
    }
}

fn level_label(plan: &Plan) -> &'static str {
    match plan.measure {
        Measure::Scale => "scale",
        Measure::PgaG => "PGA [g]",
        Measure::PgaOverUplift => "PGA/(g tan α)",
    }
}

pub fn ida(plan: &Plan, ida: &Ida, path: &Path) -> Result<(), CommandError> {
    let first = ida.points.first().map_or(0, |point| point.model);
    let subjects: Vec<levels::IdaSubject> = plan
        .subjects
        .iter()
        .enumerate()
        .take(PANELS)
        .map(|(i, subject)| {
            let points: Vec<&IdaPoint> = ida
                .points
                .iter()
                .filter(|p| p.subject == i && p.model == first && p.restitution == 0 && p.n > 0)
                .collect();
            let quantile =
                |share: f64| points.iter().filter_map(|point| point.quantile(share)).collect();
            levels::IdaSubject {
                label: subject.name.clone(),
                records: ida
                    .curves
                    .iter()
                    .filter(|curve| curve.subject == i)
                    .map(|curve| (curve.levels.clone(), curve.peaks.clone()))
                    .collect(),
                levels: points.iter().map(|point| point.level).collect(),
                quantiles: [quantile(0.16), quantile(0.5), quantile(0.84)],
            }
        })
        .filter(|subject: &levels::IdaSubject| !subject.levels.is_empty())
        .collect();
    if subjects.is_empty() {
        return Ok(());
    }
    let lines = subjects.iter().map(|subject| subject.records.len()).max().unwrap_or(0);
    let title = format!(
        "Peak rotation against {}, {}{}{}{}",
        level_label(plan),
        motions(plan),
        grey_lines(lines, plan.motions.len()),
        of_structures(subjects.len(), plan),
        restitution_shown(plan)
    );
    Ok(levels::draw(&levels::IdaFigure {
        title: &title,
        level_label: level_label(plan),
        subjects: &subjects,
    })?
    .save(path)?)
}

/// The spectra of a plan: structure, pulse and model.
fn spectra_of(plan: &Plan) -> impl Iterator<Item = (usize, String, &'static str)> {
    let mut pulses: Vec<String> = Vec::new();
    for motion in &plan.motions {
        if let SweepMotion::Pulse { shape, .. } = motion
            && !pulses.contains(&shape.label())
        {
            pulses.push(shape.label());
        }
    }
    let models = models(plan);
    (0..plan.subjects.len()).flat_map(move |subject| {
        let (pulses, models) = (pulses.clone(), models.clone());
        pulses.into_iter().flat_map(move |pulse| {
            models.clone().into_iter().map(move |model| (subject, pulse.clone(), MODELS[model]))
        })
    })
}

/// omega/p at which a structure is given a pulse, increasing: those where nothing overturns, too.
fn frequencies(plan: &Plan, subject: usize, pulse: &str) -> Vec<f64> {
    let p = plan.subjects[subject].p;
    let of = |motion: &SweepMotion| match motion {
        SweepMotion::Pulse { shape, frequency } if shape.label() == pulse => {
            Some(frequency.omega(p) / p)
        }
        _ => None,
    };
    let mut all: Vec<f64> = plan.motions.iter().filter_map(of).collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

pub fn overturning(plan: &Plan, table: &SweepTable, path: &Path) -> Result<(), CommandError> {
    let (q, model) = (table.reals("omega_over_p"), table.texts("model"));
    let (from, to, impacts) =
        (table.reals("from_over_uplift"), table.reals("to_over_uplift"), table.reals("impacts"));
    let (subject, pulse) = (table.counts("structure_index"), table.texts("pulse"));
    let (low, high) = (plan.levels[0], plan.levels[plan.levels.len() - 1]);
    let e = table.reals("restitution");
    let mut spectra = Vec::new();
    let count = spectra_of(plan).count();
    for (index, name, kind) in spectra_of(plan).take(PANELS) {
        let which = if plan.subjects.len() > 1 {
            format!("\n{}", plan.subjects[index].name)
        } else {
            String::new()
        };
        let how = if plan.model.housner() && plan.model.fem() {
            format!(", {kind}")
        } else {
            String::new()
        };
        let frequencies = frequencies(plan, index, &name);
        // of the first restitution
        let mine = |row: &usize| {
            subject[*row] == index as i64
                && *pulse[*row] == *name
                && &*model[*row] == kind
                && e[*row] == Some(plan.restitution(index, 0))
        };
        let interval = |row: usize| spectra::AmplitudeInterval {
            q: q[row].unwrap_or(1.0),
            from: from[row].unwrap_or(low),
            to: to[row].unwrap_or(f64::INFINITY),
            impacts: impacts[row].unwrap_or(0.0) as usize,
        };
        let intervals = (0..table.rows()).filter(mine).map(interval).collect();
        spectra.push(spectra::Spectrum {
            label: format!("{name}{how}{which}"),
            frequencies,
            intervals,
        });
    }
    let all = || spectra.iter().flat_map(|spectrum| spectrum.frequencies.iter().copied());
    let frequencies = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
    let title = match &plan.subjects[..] {
        [one] => format!("Pulses that overturn: {}", one.name),
        all => format!("Pulses that overturn, {} structures", all.len()),
    };
    let title = match count {
        all if all > PANELS => format!("{title}, {PANELS} of {all} spectra"),
        _ => title,
    } + &restitution_shown(plan);
    let amplitudes = (0.9 * low, high);
    let data =
        spectra::OverturningFigure { title: &title, spectra: &spectra, frequencies, amplitudes };
    Ok(spectra::draw(&data)?.save(path)?)
}

pub fn rocking(plan: &Plan, ida: &Ida, path: &Path) -> Result<(), CommandError> {
    let first = ida.points.first().map_or(0, |point| point.model);
    let mut maps_found = Vec::new();
    for (kind, name) in [(Kind::AFrame, "A-frames"), (Kind::Block, "blocks")] {
        let mine = |point: &&IdaPoint| {
            point.model == first
                && point.restitution == 0
                && point.level == plan.levels[0]
                && plan.subjects[point.subject].structure.kind == kind
        };
        let body = |point: &IdaPoint| {
            let subject = &plan.subjects[point.subject];
            Some(maps::RockingBody {
                period: 1.0 / subject.p,
                alpha: subject.alpha,
                peak: point.quantile(0.5)?,
            })
        };
        let bodies: Vec<maps::RockingBody> =
            ida.points.iter().filter(mine).filter_map(body).collect();
        if !bodies.is_empty() {
            maps_found.push(maps::Map { label: name.into(), bodies });
        }
    }
    if maps_found.is_empty() {
        return Ok(());
    }
    let of = match &plan.motions[..] {
        [one] => one.name(),
        all => format!("median of {} motions", all.len()),
    };
    let e = restitution_shown(plan);
    let title = format!("Rocking spectrum, {of}, {} {}{e}", level_label(plan), plan.levels[0]);
    Ok(maps::draw(&maps::RockingFigure { title: &title, maps: &maps_found })?.save(path)?)
}

pub fn compare(comparison: &Comparison, path: &Path) -> Result<(), CommandError> {
    if comparison.sample.is_empty() {
        return Ok(());
    }
    let title =
        format!("Rigid against springs, {} histories", comparison.all().map_or(0, |row| row.n));
    Ok(peaks::draw(&peaks::PeaksFigure { title: &title, pairs: &comparison.sample })?.save(path)?)
}
