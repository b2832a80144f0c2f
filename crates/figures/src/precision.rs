//! Work and precision: what an error costs with each tool.

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::mark::Mark;
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::{LABEL, Pen, WIDTH};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("precision");

/// One tool over a ladder of tolerances or steps.
#[derive(Clone, Copy, Debug)]
pub struct ToolSeries<'a> {
    /// In the legend.
    pub label: &'a str,
    /// (error, time), in the units of the two labels, both greater than zero.
    pub points: &'a [(f64, f64)],
}

/// What the figure shows.
#[derive(Clone, Copy, Debug, Default)]
pub struct PrecisionFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// As "largest error of u (m)".
    pub error_label: &'a str,
    /// As "time (ms)".
    pub time_label: &'a str,
    /// The tools.
    pub series: &'a [ToolSeries<'a>],
}

/// Height of one comparison (pixel).
const SHEET: f64 = 960.0;

/// Draw comparisons one below the other.
///
/// # Errors
/// [`FigureError`] when a slice is empty, when a number is not finite or not greater than zero.
pub fn draw(sheets: &[PrecisionFigure<'_>]) -> Result<Sheet, FigureError> {
    CHECK.least("comparisons", sheets.len(), 1)?;
    for data in sheets {
        CHECK.least("series", data.series.len(), 1)?;
        for series in data.series {
            CHECK.least(series.label, series.points.len(), 1)?;
            let numbers: Vec<f64> =
                series.points.iter().flat_map(|point| [point.0, point.1]).collect();
            let what = format!("{} (error and time in turn)", series.label);
            CHECK.each(&what, &numbers, |x| x.is_finite() && x > 0.0)?;
        }
    }
    let mut canvas = Canvas::default();
    for (k, data) in sheets.iter().enumerate() {
        panel(&mut canvas, data, SHEET * k as f64);
    }
    canvas.finish(SHEET * sheets.len() as f64)
}

/// One comparison, its upper edge at `y`.
fn panel(canvas: &mut Canvas, data: &PrecisionFigure<'_>, y: f64) {
    let entries: Vec<LegendEntry> = data
        .series
        .iter()
        .enumerate()
        .map(|(i, series)| LegendEntry::both(series.label, Pen::series(i, 3.0), Mark::series(i)))
        .collect();
    let left = 150.0;
    let top = y + legend::title(canvas, data.title, (left, WIDTH as f64 - 40.0), y);
    // The legend's column takes what its longest text needs, but leaves the panel more than half of
    // the sheet.
    let text = super::lettering::Lettering::new(LABEL);
    let longest = data.series.iter().map(|series| text.length(series.label)).fold(0.0, f64::max);
    let right = (WIDTH as f64 - 40.0 - longest - 76.0 - 36.0).max(850.0);
    legend::column(canvas, &entries, (right + 36.0, top + 24.0));

    let points = || data.series.iter().flat_map(|series| series.points);
    let panel = Panel {
        frame: PanelFrame { left, top, right, bottom: y + 860.0 },
        x: Scale::log_around(points().map(|point| point.0), 10.0),
        y: Scale::log_around(points().map(|point| point.1), 10.0),
    };
    panel.axes(canvas, Some(data.error_label), data.time_label, 110.0);
    for (i, series) in data.series.iter().enumerate().rev() {
        let (errors, times): (Vec<f64>, Vec<f64>) = series.points.iter().copied().unzip();
        panel.curve(canvas, &errors, &times, Pen::series(i, 3.0));
        for &(error, time) in series.points {
            Mark::series(i).draw(canvas, panel.at(error, time));
        }
    }
}
