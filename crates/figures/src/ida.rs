//! Peak rotation against the level of the ground motion, both as logarithms: single records in
//! grey, quantiles over all of them. A panel a structure, each with the ranges in which its body
//! moves and stands.

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::{GREY, PALE, Pen, SIDES};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("ida");

/// One structure.
#[derive(Clone, Debug)]
pub struct IdaSubject {
    /// Its name.
    pub label: String,
    /// Levels and peaks |theta|/alpha of single records; infinite where the body overturned.
    pub records: Vec<(Vec<f64>, Vec<f64>)>,
    /// Intensities.
    pub levels: Vec<f64>,
    /// 16, 50 and 84 % of all records at the levels; infinite where these overturned.
    pub quantiles: [Vec<f64>; 3],
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct IdaFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// Of the axis of the intensity.
    pub level_label: &'a str,
    /// The structures.
    pub subjects: &'a [IdaSubject],
}

/// |theta|/alpha at the upper edge: from about here on a body overturns.
const HIGHEST: f64 = 1.2;
/// At the lower edge at least; less is no rocking that anyone would see.
const LOWEST: f64 = 3e-3;
/// Levels are shown from one of these below the first at which a body moves.
const BEFORE: f64 = 0.9;
const HEIGHT: f64 = 480.0;
const GAP: f64 = 150.0;
const SHARES: [&str; 3] = ["16 % of records below", "median", "84 %"];

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] when there is nothing to draw, for a NaN.
pub fn draw(data: &IdaFigure<'_>) -> Result<Sheet, FigureError> {
    CHECK.least("subjects", data.subjects.len(), 1)?;
    for subject in data.subjects {
        CHECK.least("levels", subject.levels.len(), 1)?;
        CHECK.finite("levels", &subject.levels)?;
        for values in &subject.quantiles {
            CHECK.each(&subject.label, values, |x| x >= 0.0)?;
        }
    }
    let mut entries = vec![LegendEntry::line("single records", Pen::new(PALE, 1.5))];
    entries.extend(SHARES.iter().enumerate().map(|(i, share)| LegendEntry::line(*share, pen(i))));
    let (left, right) = SIDES;
    let columns = data.subjects.len().min(2);
    let rows = data.subjects.len().div_ceil(columns);
    let mut canvas = Canvas::default();
    let top = legend::header(&mut canvas, data.title, &entries, left, right) + 20.0;
    for (i, subject) in data.subjects.iter().enumerate() {
        let frame = PanelFrame::of_rows(i, columns, top, (HEIGHT, GAP));
        let panel = Panel { frame, x: levels(subject), y: peaks(subject) };
        panel.axes(
            &mut canvas,
            Some(&format!("{}\n{}", data.level_label, subject.label)),
            "peak |θ|/α",
            95.0,
        );
        panel.level(&mut canvas, 1.0, Pen::new(GREY, 1.5).dashed());
        for (levels, peaks) in &subject.records {
            let (x, y) = standing(levels, peaks);
            panel.curve(&mut canvas, &x, &y, Pen::new(PALE, 1.2));
        }
        for (i, quantile) in subject.quantiles.iter().enumerate() {
            let (x, y) = standing(&subject.levels, quantile);
            panel.curve(&mut canvas, &x, &y, pen(i));
        }
    }
    canvas.finish(top + rows as f64 * (HEIGHT + GAP))
}

/// Peaks of a subject that a body moves by and does not overturn, with their levels.
fn moving(subject: &IdaSubject) -> impl Iterator<Item = (f64, f64)> {
    let records = subject.records.iter().flat_map(|(levels, peaks)| levels.iter().zip(peaks));
    let quantiles =
        subject.quantiles.iter().flat_map(|quantile| subject.levels.iter().zip(quantile));
    records
        .chain(quantiles)
        .map(|(level, peak)| (*level, *peak))
        .filter(|(_, peak)| (LOWEST..HIGHEST).contains(peak))
}

/// From the first level at which a body moves to the last at which one moves and stands; all levels
/// if none does.
fn levels(subject: &IdaSubject) -> Scale {
    let (low, high) = moving(subject).fold((f64::INFINITY, 0.0_f64), |(low, high), (level, _)| {
        (low.min(level), high.max(level))
    });
    if high > low {
        Scale::log(BEFORE * low, high / BEFORE)
    } else {
        Scale::log_around(subject.levels.iter().copied(), 2.0)
    }
}

/// From the least of nearly all peaks of the quantiles to where a body overturns, at least a
/// decade.
fn peaks(subject: &IdaSubject) -> Scale {
    let low = moving(subject).fold(0.1 * HIGHEST, |low: f64, (_, peak)| low.min(peak));
    Scale::log(low.max(LOWEST), HIGHEST)
}

/// A curve as it is drawn: a logarithm shows neither zero nor infinity, so that these lie far
/// outside of the panel.
fn standing(levels: &[f64], peaks: &[f64]) -> (Vec<f64>, Vec<f64>) {
    levels
        .iter()
        .zip(peaks)
        .map(|(level, peak)| (*level, peak.clamp(1e-2 * LOWEST, 10.0 * HIGHEST)))
        .unzip()
}

fn pen(i: usize) -> Pen {
    let pen = Pen::series(1 - i % 2, if i == 1 { 5.0 } else { 3.0 });
    if i == 2 { pen.dashed() } else { pen }
}
