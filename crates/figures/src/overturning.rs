//! Overturning spectra: the amplitudes of a pulse that overturn, over its frequency. Two panels a
//! row.

use plotters::style::Color;

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::{self, BLACK, Pen, SIDES};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("overturning");

/// An interval of amplitudes at a frequency.
#[derive(Clone, Copy, Debug)]
pub struct AmplitudeInterval {
    /// omega/p.
    pub q: f64,
    /// Its lower end.
    pub from: f64,
    /// Infinite if it has no upper end.
    pub to: f64,
    /// Impacts before the body overturns: none, one, more; unknown counts as none.
    pub impacts: usize,
}

/// One pulse and structure.
#[derive(Clone, Debug)]
pub struct Spectrum {
    /// Its name, in one line or two.
    pub label: String,
    /// Every frequency that was looked at, increasing.
    pub frequencies: Vec<f64>,
    /// The intervals that overturn.
    pub intervals: Vec<AmplitudeInterval>,
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct OverturningFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// One a panel.
    pub spectra: &'a [Spectrum],
    /// Frequencies omega/p and amplitudes that were looked at.
    pub frequencies: (f64, f64),
    /// Least and greatest amplitude shown.
    pub amplitudes: (f64, f64),
}

const HEIGHT: f64 = 560.0;
const GAP: f64 = 150.0;
const ENTRIES: [&str; 3] = ["overturns without an impact", "after one impact", "after several"];

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] when there is nothing to draw, for numbers that are not finite.
pub fn draw(data: &OverturningFigure<'_>) -> Result<Sheet, FigureError> {
    CHECK.least("spectra", data.spectra.len(), 1)?;
    for spectrum in data.spectra {
        CHECK.least("frequencies", spectrum.frequencies.len(), 1)?;
        CHECK.finite("frequencies", &spectrum.frequencies)?;
        let from: Vec<f64> = spectrum.intervals.iter().map(|interval| interval.from).collect();
        CHECK.finite("from", &from)?;
    }
    let mut entries: Vec<LegendEntry> = ENTRIES
        .iter()
        .enumerate()
        .map(|(i, name)| LegendEntry::patch(*name, colour(i).mix(0.8)))
        .collect();
    entries.push(LegendEntry::line("lifts the body", lift()));
    let (left, right) = SIDES;
    let columns = data.spectra.len().min(2);
    let rows = data.spectra.len().div_ceil(columns);
    let mut canvas = Canvas::default();
    let top = legend::header(&mut canvas, data.title, &entries, left, right) + 20.0;
    for (i, spectrum) in data.spectra.iter().enumerate() {
        let frame = PanelFrame::of_rows(i, columns, top, (HEIGHT, GAP));
        one(&mut canvas, data, spectrum, frame);
    }
    canvas.finish(top + rows as f64 * (HEIGHT + GAP))
}

fn colour(impacts: usize) -> plotters::style::RGBColor {
    [style::VERMILLION, style::BLUE, style::GREEN][impacts.min(2)]
}

fn lift() -> Pen {
    Pen::new(BLACK, 2.5).dashed()
}

fn one(canvas: &mut Canvas, data: &OverturningFigure<'_>, spectrum: &Spectrum, frame: PanelFrame) {
    let q = &spectrum.frequencies;
    let edges = |i: usize| -> (f64, f64) {
        let between = |a: f64, b: f64| (a * b).sqrt();
        let step = if q.len() > 1 {
            (q[q.len() - 1] / q[0]).powf(0.5 / (q.len() - 1) as f64)
        } else {
            1.05
        };
        let low = if i == 0 { q[0] / step } else { between(q[i - 1], q[i]) };
        let high = if i + 1 == q.len() { q[i] * step } else { between(q[i], q[i + 1]) };
        (low, high)
    };
    let panel = Panel {
        frame,
        x: Scale::log(data.frequencies.0, data.frequencies.1),
        y: Scale::log(data.amplitudes.0, data.amplitudes.1),
    };
    for interval in &spectrum.intervals {
        let Some(i) = q.iter().position(|other| (other / interval.q - 1.0).abs() < 1e-9) else {
            continue;
        };
        let (from, to) = edges(i);
        let above = if interval.to.is_finite() { interval.to } else { panel.y.high };
        let (a, b) = (panel.at_clamped(from, above), panel.at_clamped(to, interval.from));
        canvas.block(a, b, colour(interval.impacts).mix(0.8));
    }
    panel.axes(canvas, Some(&format!("ω/p, {}", spectrum.label)), "a/(g tan α)", 95.0);
    panel.level(canvas, 1.0, lift());
}
