//! Peak rotation against the level of the ground motion: single records in grey, quantiles over all of them. A panel a structure.

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::{self, PALE, Pen, WIDTH};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("ida");

/// One structure.
#[derive(Clone, Debug)]
pub struct IdaSubject {
    pub label: String,
    /// Levels and peaks |theta|/alpha of single records; infinite where the body overturned.
    pub records: Vec<(Vec<f64>, Vec<f64>)>,
    pub levels: Vec<f64>,
    /// 16, 50 and 84 % of all records at the levels; infinite where these overturned.
    pub quantiles: [Vec<f64>; 3],
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct IdaFigure<'a> {
    pub title: &'a str,
    pub level_label: &'a str,
    pub subjects: &'a [IdaSubject],
}

/// |theta|/alpha at the upper edge: above it all have overturned, or nearly.
const HIGHEST: f64 = 1.5;
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
    let (left, right) = (150.0, WIDTH as f64 - 40.0);
    let rows = data.subjects.len().div_ceil(2);
    let mut canvas = Canvas::default();
    let top = legend::header(&mut canvas, data.title, &entries, left, right) + 20.0;
    let middle = 0.5 * (left + right);
    for (i, subject) in data.subjects.iter().enumerate() {
        let top = top + (i / 2) as f64 * (HEIGHT + GAP);
        let (from, to) = if i % 2 == 0 { (left, middle - 40.0) } else { (middle + 75.0, right) };
        let x = Scale::log_around(subject.levels.iter().copied(), 2.0);
        let frame = PanelFrame { left: from, top, right: to, bottom: top + HEIGHT };
        let panel = Panel { frame, x, y: Scale::linear(0.0, HIGHEST) };
        panel.axes(&mut canvas, Some(&format!("{}: {}", subject.label, data.level_label)), "peak |θ|/α", 95.0);
        let shown = |values: &[f64]| -> Vec<f64> { values.iter().map(|x| x.min(10.0 * HIGHEST)).collect() };
        for (levels, peaks) in &subject.records {
            panel.curve(&mut canvas, levels, &shown(peaks), Pen::new(PALE, 1.2));
        }
        for (i, quantile) in subject.quantiles.iter().enumerate() {
            panel.curve(&mut canvas, &subject.levels, &shown(quantile), pen(i));
        }
    }
    canvas.finish(top + rows as f64 * (HEIGHT + GAP))
}

fn pen(i: usize) -> Pen {
    let pen = Pen::new(style::series(1 - i % 2), if i == 1 { 5.0 } else { 3.0 });
    if i == 2 { pen.dashed() } else { pen }
}
