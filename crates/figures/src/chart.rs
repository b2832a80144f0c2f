//! The chart of the design from the geometry: what to read off for a slenderness and an Omega_n/p.

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::{GREY, Pen, WIDTH};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("chart");

/// One slenderness of one kind of body: a value each for every Omega_n/p.
#[derive(Clone, Copy, Debug)]
pub struct ChartCurve<'a> {
    /// Slenderness (rad).
    pub alpha: f64,
    /// Whether it is drawn dashed: the second kind of body.
    pub dashed: bool,
    /// Omega_n over p.
    pub omega_n_over_p: &'a [f64],
    /// Values of each panel, in the order of `ChartFigure::panels`.
    pub values: [&'a [f64]; 4],
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct ChartFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// What is on the vertical axis of each panel.
    pub panels: [&'a str; 4],
    /// What a full and a dashed line are.
    pub kinds: [&'a str; 2],
    /// The curves.
    pub curves: &'a [ChartCurve<'a>],
}

/// Height of a panel, and the distance between two (pixel).
const HEIGHT: f64 = 360.0;
const GAP: f64 = 40.0;

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for an empty or not finite slice or slices of different lengths.
pub fn draw(data: &ChartFigure<'_>) -> Result<Sheet, FigureError> {
    CHECK.least("curves", data.curves.len(), 1)?;
    for curve in data.curves {
        let name = format!("omega_n_over_p at alpha {}", curve.alpha);
        CHECK.least(&name, curve.omega_n_over_p.len(), 2)?;
        CHECK.finite(&name, curve.omega_n_over_p)?;
        for (values, panel) in curve.values.into_iter().zip(data.panels) {
            CHECK.column(
                &format!("{panel} at alpha {}", curve.alpha),
                values,
                curve.omega_n_over_p.len(),
            )?;
        }
    }
    let mut alphas: Vec<f64> = Vec::new();
    for curve in data.curves {
        if !alphas.contains(&curve.alpha) {
            alphas.push(curve.alpha);
        }
    }
    let pen = |curve: &ChartCurve| {
        let i = alphas.iter().position(|a| *a == curve.alpha).unwrap_or(0);
        let pen = Pen::series(i, 3.0);
        if curve.dashed { pen.dashed() } else { pen }
    };
    let mut canvas = Canvas::default();
    let mut entries: Vec<LegendEntry> = alphas
        .iter()
        .enumerate()
        .map(|(i, alpha)| LegendEntry::line(format!("\u{3b1} = {alpha}"), Pen::series(i, 3.0)))
        .collect();
    entries.push(LegendEntry::line(data.kinds[0], Pen::new(GREY, 3.0)));
    entries.push(LegendEntry::line(data.kinds[1], Pen::new(GREY, 3.0).dashed()));
    let (left, right) = (170.0, WIDTH as f64 - 40.0);
    let top = legend::header(&mut canvas, data.title, &entries, left, right);
    let x = Scale::log_around(data.curves.iter().flat_map(|c| c.omega_n_over_p).copied(), 4.0);
    for (k, label) in data.panels.into_iter().enumerate() {
        let y = Scale::log_around(data.curves.iter().flat_map(|c| c.values[k]).copied(), 3.0);
        let top = top + k as f64 * (HEIGHT + GAP);
        let panel = Panel { frame: PanelFrame { left, top, right, bottom: top + HEIGHT }, x, y };
        panel.axes(&mut canvas, (k == 3).then_some("Ωₙ/p"), label, 120.0);
        for curve in data.curves {
            panel.curve(&mut canvas, curve.omega_n_over_p, curve.values[k], pen(curve));
        }
    }
    canvas.finish(top + 4.0 * (HEIGHT + GAP) + 80.0)
}
