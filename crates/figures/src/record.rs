//! A ground motion against time: acceleration and velocity, and what lifts a structure.

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::lettering::Lettering;
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::{self, BLUE, GREY, NUMBER, Pen, SIDES, VERMILLION};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("record");

/// What the figure shows, at the times t, one value each.
#[derive(Clone, Copy, Debug)]
pub struct RecordFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// Times, increasing (s).
    pub t: &'a [f64],
    /// Ground acceleration (g).
    pub accel_g: &'a [f64],
    /// Ground velocity (m/s).
    pub velocity: &'a [f64],
    /// Acceleration that lifts the structure, tan(alpha) (g).
    pub uplift_g: Option<f64>,
    /// Lines below the panels.
    pub notes: &'a [String],
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for fewer than two times, a slice that is not finite or of another length.
pub fn draw(data: &RecordFigure<'_>) -> Result<Sheet, FigureError> {
    let n = CHECK.times(data.t)?;
    CHECK.column("accel_g", data.accel_g, n)?;
    CHECK.column("velocity", data.velocity, n)?;
    CHECK.finite("uplift_g", data.uplift_g.as_slice())?;

    let mut canvas = Canvas::default();
    let (accel, velocity) = (Pen::new(VERMILLION, 2.4), Pen::new(BLUE, 2.8));
    let level = Pen::new(GREY, 2.2).dashed();
    let mut entries =
        vec![LegendEntry::line("acceleration", accel), LegendEntry::line("velocity", velocity)];
    if data.uplift_g.is_some() {
        entries.push(LegendEntry::line("uplift, ± g tan α", level));
    }
    let (left, right) = SIDES;
    let top = legend::header(&mut canvas, data.title, &entries, left, right);
    let x = Scale::linear(data.t[0], data.t[n - 1]);
    let (middle, bottom) = (top + 440.0, top + 830.0);
    let symmetric = |values: &[f64], least: f64| {
        let most = values.iter().fold(least, |most, x| most.max(x.abs())).max(f64::MIN_POSITIVE);
        Scale::linear(-1.08 * most, 1.08 * most)
    };

    // a level far above the record would flatten it
    let peak = data.accel_g.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
    let shown = data.uplift_g.filter(|uplift| *uplift <= 3.0 * peak);
    let y = symmetric(data.accel_g, shown.unwrap_or(0.0));
    let panel = Panel { frame: PanelFrame { left, top, right, bottom: middle }, x, y };
    panel.axes(&mut canvas, None, "acceleration [g]", 110.0);
    panel.level(&mut canvas, 0.0, Pen::new(style::AXIS, 1.5));
    panel.curve(&mut canvas, data.t, data.accel_g, accel);
    for uplift in shown.iter().flat_map(|uplift| [-uplift, *uplift]) {
        panel.level(&mut canvas, uplift, level);
    }

    let panel = Panel {
        frame: PanelFrame { left, top: middle + 34.0, right, bottom },
        x,
        y: symmetric(data.velocity, 0.0),
    };
    panel.axes(&mut canvas, Some("time from the first sample [s]"), "velocity [m/s]", 110.0);
    panel.level(&mut canvas, 0.0, Pen::new(style::AXIS, 1.5));
    panel.curve(&mut canvas, data.t, data.velocity, velocity);
    for (i, note) in data.notes.iter().enumerate() {
        let at = (left, bottom + 105.0 + 36.0 * i as f64);
        canvas.text(at, note, Lettering::new(NUMBER).colour(style::TEXT));
    }
    canvas.finish(bottom + 180.0)
}
