//! Figures of an elastic structure's run.

use super::{ElasticRun, title as structure_title};
use crate::pictures as draw;
use figures::{
    EventMark, Figure, FigureError, brief, prefix, short,
    stack::{self, StackFigure, StackQuantity},
};
use frames::answer::{Compared, ComparedEnd, ElasticHistories};

/// Title, and below it the structure, the record, its scale and Omega_n.
fn title(run: &ElasticRun, what: &str) -> String {
    let excitation = &run.case.excitation;
    let (unit, letter) = prefix(run.parameters.omega_n_hz);
    format!(
        "{what}\n{}; {} × {}; Ωₙ/2π = {} {letter}Hz",
        structure_title(&run.assembled.structure),
        excitation.record.name,
        brief(excitation.scale, 4),
        short(run.parameters.omega_n_hz / unit, 3)
    )
}

/// All of them.
pub(crate) fn draw(run: &ElasticRun) -> Result<Vec<Figure>, FigureError> {
    Ok(vec![history(run)?, forces(run)?])
}

fn history(run: &ElasticRun) -> Result<Figure, FigureError> {
    let ElasticHistories { reference, fem, sways, .. } = &run.answer.histories;
    let n = reference.history.q.len().max(fem.q.len());
    let t: Vec<f64> = (0..n).map(|i| i as f64 * run.record.dt).collect();
    let several = sways.len() > 1;
    let label = |what: &str, i: usize| {
        if several {
            format!("{what}, {}", if i == 0 { "left" } else { "right" })
        } else {
            what.to_string()
        }
    };
    let mut names = Vec::new();
    let mut curves: Vec<[&[f64]; 2]> = Vec::new();
    for (i, [reference, fem]) in sways.iter().enumerate() {
        names.push((label("rotation", i), "rad"));
        curves.push([&reference.rotation, &fem.rotation]);
        names.push((label("drift", i), "m"));
        curves.push([&reference.drift, &fem.drift]);
    }
    let panels: Vec<StackQuantity> = names
        .iter()
        .zip(&curves)
        .map(|((name, unit), curves)| StackQuantity { name, unit, curves })
        .collect();
    let Compared { seconds, end, .. } = run.answer.compared;
    let text = match end {
        ComparedEnd::Record => None,
        ComparedEnd::History => {
            Some(format!("the history on rigid ground ends at t = {seconds:.2} s"))
        }
        ComparedEnd::Slides => {
            Some(format!("at t = {seconds:.2} s a corner lands sliding: friction decides"))
        }
        ComparedEnd::Foretold => {
            Some(format!("from t = {seconds:.2} s on no model foretells this motion"))
        }
    };
    let event = text.as_ref().map(|text| EventMark { time: seconds, text });
    let title = title(run, "Rotation on the ground, and drift without it");
    let names = ["rigid ground, plastic landings", "finite elements on ground springs"];
    let sheet =
        stack::draw(&StackFigure { title: &title, t: &t, names: &names, panels: &panels, event })?;
    let caption = "Rotation of the footing (of the line between the feet), and drift of the mass \
                   without the rigid rotation.";
    Ok(Figure { name: draw::HISTORY, caption, sheet })
}

fn forces(run: &ElasticRun) -> Result<Figure, FigureError> {
    let quantities = &run.bearing.quantities;
    let n = run.answer.histories.fem.q.len().max(run.answer.fixed.q.len());
    let t: Vec<f64> = (0..n).map(|i| i as f64 * run.record.dt).collect();
    // fixed in black under the others
    let rigid = run.answer.rigid.is_some();
    let names: &[&str] = if rigid {
        &["fixed to the ground", "rocking, elastic", "rocking, rigid (Housner)"]
    } else {
        &["fixed to the ground", "rocking, elastic"]
    };
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
                  the column or leg in which it is largest. Of forces that the table has filtered \
                  or withholds, the spikes at landings are those of springs and mesh.",
        sheet,
    })
}
