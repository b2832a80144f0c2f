//! Figures of an elastic structure's run.

use super::{ElasticRun, bearing::ForceQuantity, feet, title as structure_title};
use crate::pictures as draw;
use figures::{
    EventMark, Figure, FigureError, brief, prefix, short,
    stack::{self, StackFigure, StackQuantity},
};
use frames::answer::{Compared, ComparedEnd, ElasticHistories};
use frames::structure::ElasticStructure;
use report::predictable_to;
use results::Finding;
use rocking::motion::peak;

/// Share of the feet's distance below which they stay where they stood.
const LEAST_MOVED: f64 = 1e-3;

/// Title, and below it the structure, the record, its scale and Omega_n.
fn title(run: &ElasticRun, what: &str) -> String {
    let excitation = &run.case.excitation;
    let motion = format!("{} × {}", excitation.record.name, brief(excitation.scale, 4));
    let of = subtitle(&run.assembled.structure, &motion, run.parameters.omega_n_hz);
    format!("{what}\n{of}")
}

/// The structure, the motion and Omega_n, for below a title.
pub fn subtitle(structure: &ElasticStructure, motion: &str, omega_n_hz: f64) -> String {
    let (unit, letter) = prefix(omega_n_hz);
    let hz = short(omega_n_hz / unit, 3);
    format!("{}; {motion}; Ωₙ/2π = {hz} {letter}Hz", structure_title(structure))
}

/// The name of what base `i` of so many does: of two it is the left or the right one's.
pub fn of_base(what: &str, (i, bases): (usize, usize)) -> String {
    match (bases, i) {
        (0 | 1, _) => what.to_string(),
        (_, 0) => format!("{what}, left"),
        _ => format!("{what}, right"),
    }
}

/// All of them.
pub(crate) fn draw(run: &ElasticRun) -> Result<Vec<Figure>, FigureError> {
    Ok(vec![history(run)?, forces(run)?])
}

fn history(run: &ElasticRun) -> Result<Figure, FigureError> {
    let ElasticHistories { reference, fem, sways, .. } = &run.answer.histories;
    let n = reference.history.q.len().max(fem.q.len());
    let t: Vec<f64> = (0..n).map(|i| i as f64 * run.record.dt).collect();
    let label = |what: &str, i: usize| of_base(what, (i, sways.len()));
    let mut names = Vec::new();
    let mut curves: Vec<[&[f64]; 2]> = Vec::new();
    for (i, [reference, fem]) in sways.iter().enumerate() {
        names.push((label("rotation", i), "rad"));
        curves.push([&reference.rotation, &fem.rotation]);
        names.push((label("drift", i), "m"));
        curves.push([&reference.drift, &fem.drift]);
    }
    let feet = feet::moved(run);
    let width = 2.0 * run.assembled.structure.body().half_width;
    let largest = feet.iter().flatten().map(|moved| peak(moved).abs()).fold(0.0, f64::max);
    if largest > LEAST_MOVED * width {
        let of = foot_names(feet.len());
        for (name, [reference, fem]) in of.iter().zip(&feet) {
            names.push((name.to_string(), "m"));
            curves.push([reference, fem]);
        }
    }
    let panels: Vec<StackQuantity> = names
        .iter()
        .zip(&curves)
        .map(|((name, unit), curves)| StackQuantity { name, unit, curves })
        .collect();
    let event = horizon(run);
    let event = event.as_ref().map(|(time, text)| EventMark { time: *time, text });
    let title = title(run, "Rotation on the ground, and drift without it");
    let names = ["rigid ground, plastic landings", "finite elements on ground springs"];
    let sheet = stack::draw_while_moving(&StackFigure {
        title: &title,
        t: &t,
        names: &names,
        panels: &panels,
        event,
    })?;
    let caption = "Rotation of the footing (of the line between the feet), drift of the mass \
                   without the rigid rotation, and where feet land elsewhere than they stood.";
    Ok(Figure { name: draw::HISTORY, caption, sheet })
}

/// Up to when the curves can be foretold (s), or go, and why.
fn horizon(run: &ElasticRun) -> Option<(f64, String)> {
    let findings = &run.parameters.findings;
    let slides = findings.iter().any(|filed| matches!(filed.finding, Finding::SlidesOn { .. }));
    let Compared { seconds, end, .. } = run.answer.compared;
    Some(match (predictable_to(findings), end) {
        (Some(until), _) if slides => {
            (until, format!("at t = {until:.2} s a corner lands sliding: friction decides"))
        }
        (Some(until), _) => (until, format!("predictable to t = {until:.2} s")),
        (None, ComparedEnd::History) => {
            (seconds, format!("the history on rigid ground ends at t = {seconds:.2} s"))
        }
        (None, _) => return None,
    })
}

/// Curves of where feet are: of a structure on one footing, or on two feet.
fn foot_names(feet: usize) -> &'static [&'static str] {
    match feet {
        1 => &["footing moved"],
        _ => &["left foot moved", "right foot moved"],
    }
}

/// Curves of forces: without those of the rigid body, of which an A-frame has none.
fn force_names(quantities: &[ForceQuantity]) -> &'static [&'static str] {
    const NAMES: [&str; 3] =
        ["fixed to the ground", "rocking, elastic", "rocking, rigid (Housner)"];
    match quantities.iter().any(|quantity| !quantity.series[2].is_empty()) {
        true => &NAMES,
        false => &NAMES[..2],
    }
}

fn forces(run: &ElasticRun) -> Result<Figure, FigureError> {
    let quantities = &run.bearing.quantities;
    let n = run.answer.histories.fem.q.len().max(run.answer.fixed.q.len());
    let t: Vec<f64> = (0..n).map(|i| i as f64 * run.record.dt).collect();
    // fixed in black under the others
    let names = force_names(quantities);
    let rigid = names.len() > 2;
    let curves: Vec<Vec<&[f64]>> = quantities
        .iter()
        .map(|quantity| {
            let [rocking, fixed, body] = &quantity.series;
            let mut all: Vec<&[f64]> = vec![fixed, rocking];
            if rigid {
                all.push(&body[..body.len().min(n)]);
            }
            all
        })
        .collect();
    let panels: Vec<StackQuantity> = quantities
        .iter()
        .zip(&curves)
        .map(|(quantity, curves)| StackQuantity {
            name: quantity.name,
            unit: quantity.unit,
            curves,
        })
        .collect();
    let title = title(run, "What rocking buys, forces unfiltered");
    let sheet =
        stack::draw(&StackFigure { title: &title, t: &t, names, panels: &panels, event: None })?;
    Ok(Figure {
        name: draw::BEARING,
        caption: "What the structure bears when it rocks, and held to the ground: of each force \
                  the column or leg in which it is largest, and the largest magnitude since the \
                  sample before: a tension beside a larger compression is not drawn. Of forces \
                  that the table has filtered or withholds, the spikes at landings are those of \
                  springs and mesh.",
        sheet,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_footing_is_neither_left_nor_right() {
        assert_eq!((foot_names(1), foot_names(2).len()), (&["footing moved"][..], 2));
        let names = [(0, 1), (0, 2), (1, 2)].map(|base| of_base("drift", base));
        assert_eq!(names, ["drift", "drift, left", "drift, right"]);
    }

    #[test]
    fn the_legend_of_forces_names_the_curves_that_there_are() {
        let of = |rigid: Vec<f64>| {
            let series = [vec![1.0], vec![2.0], rigid];
            force_names(&[ForceQuantity { name: "axial force", unit: "N", series }])
        };
        assert_eq!(of(Vec::new()), ["fixed to the ground", "rocking, elastic"]);
        assert!(of(vec![3.0])[2].contains("Housner"));
    }
}
