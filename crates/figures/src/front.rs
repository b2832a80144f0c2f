//! The front: error against Omega_n, of one way to design springs beside others; below, what
//! stiffness costs.

use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::lettering::Lettering;
use super::mark::Mark;
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::{BLACK, GREY, NUMBER, Pen, SIDES, TEXT};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("front");

/// One way to design springs: an error for each Omega_n, one value each.
#[derive(Clone, Copy, Debug)]
pub struct DesignSeries<'a> {
    /// In the legend.
    pub label: &'a str,
    /// Omega_n of the vertical springs (Hz).
    pub omega_n_hz: &'a [f64],
    /// Error of the history, NRMSE.
    pub error: &'a [f64],
}

/// What stiffness costs, one value for each Omega_n.
#[derive(Clone, Copy, Debug)]
pub struct Cost<'a> {
    /// Of the axis.
    pub label: &'a str,
    /// Omega_n/2 pi (Hz).
    pub omega_n_hz: &'a [f64],
    /// The cost at each.
    pub value: &'a [f64],
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct FrontFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// Of the axis of the error.
    pub error_label: &'a str,
    /// The ways to design.
    pub series: &'a [DesignSeries<'a>],
    /// Omega_n of the springs that were delivered (Hz).
    pub chosen_hz: f64,
    /// Accuracy that was asked for.
    pub accuracy: f64,
    /// Each in a panel of its own, side by side.
    pub costs: [Cost<'a>; 2],
    /// Remarks below, a line each.
    pub notes: &'a [String],
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for an empty or not finite slice or slices of different lengths.
pub fn draw(data: &FrontFigure<'_>) -> Result<Sheet, FigureError> {
    CHECK.least("series", data.series.len(), 1)?;
    let columns = data.series.iter().map(|s| (s.label, s.omega_n_hz, s.error));
    for (label, hz, value) in
        columns.chain(data.costs.iter().map(|c| (c.label, c.omega_n_hz, c.value)))
    {
        CHECK.least(label, hz.len(), 1)?;
        CHECK.finite(&format!("omega_n_hz of {label}"), hz)?;
        CHECK.column(label, value, hz.len())?;
    }
    CHECK.finite("chosen_hz and accuracy", &[data.chosen_hz, data.accuracy])?;

    let mut canvas = Canvas::default();
    let mut entries: Vec<LegendEntry> = data
        .series
        .iter()
        .enumerate()
        .map(|(i, s)| LegendEntry::both(s.label, Pen::series(i, 3.0), Mark::series(i)))
        .collect();
    entries.push(LegendEntry::line("delivered", upright()));
    entries.push(LegendEntry::line("accuracy asked for", level()));
    let (left, right) = SIDES;
    let top = legend::header(&mut canvas, data.title, &entries, left, right);
    let frequencies =
        data.series.iter().flat_map(|s| s.omega_n_hz).copied().chain([data.chosen_hz]);
    let x = Scale::log_around(frequencies, 4.0);
    let y = Scale::log_around(
        data.series.iter().flat_map(|s| s.error).copied().chain([data.accuracy]),
        10.0,
    );
    let panel = Panel { frame: PanelFrame { left, top, right, bottom: top + 680.0 }, x, y };
    panel.axes(&mut canvas, Some("Ωₙ of the vertical springs [Hz]"), data.error_label, 110.0);
    guide(&mut canvas, &panel, data);
    panel.upright(&mut canvas, data.chosen_hz, upright());
    panel.level(&mut canvas, data.accuracy, level());
    // The last series lies lowest: ours comes first in the list and on top in the picture.
    for (i, series) in data.series.iter().enumerate().rev() {
        panel.curve(&mut canvas, series.omega_n_hz, series.error, Pen::series(i, 3.0));
        for (&hz, &error) in series.omega_n_hz.iter().zip(series.error) {
            Mark::series(i).draw(&mut canvas, panel.at_clamped(hz, error));
        }
    }
    let (middle, gap) = (0.5 * (left + right), 140.0);
    for (cost, (from, to)) in
        data.costs.iter().zip([(left, middle - 0.5 * gap), (middle + 0.5 * gap, right)])
    {
        let y = Scale::log_around(cost.value.iter().copied(), 4.0);
        let panel = Panel {
            frame: PanelFrame { left: from, top: top + 815.0, right: to, bottom: top + 1090.0 },
            x,
            y,
        };
        panel.axes(&mut canvas, Some("Ωₙ [Hz]"), cost.label, 110.0);
        panel.upright(&mut canvas, data.chosen_hz, upright());
        panel.curve(&mut canvas, cost.omega_n_hz, cost.value, Pen::series(0, 3.0));
        for (&hz, &value) in cost.omega_n_hz.iter().zip(cost.value) {
            Mark::series(0).draw(&mut canvas, panel.at_clamped(hz, value));
        }
    }
    let mut below = top + 1210.0;
    for note in data.notes {
        canvas.text(
            (left, below),
            note,
            Lettering::new(NUMBER).colour(TEXT).at(HPos::Left, VPos::Bottom),
        );
        below += 36.0;
    }
    canvas.finish(below)
}

fn upright() -> Pen {
    Pen::new(BLACK, 2.0).dashed()
}

fn level() -> Pen {
    Pen::new(GREY, 2.0)
}

/// error = const / Omega_n, below every point of the first series so that it crosses none of it.
fn guide(canvas: &mut Canvas, panel: &Panel, data: &FrontFigure<'_>) {
    let Some(first) = data.series.first() else { return };
    let pairs = first.omega_n_hz.iter().zip(first.error);
    let constant =
        pairs.map(|(hz, error)| hz * error).filter(|x| *x > 0.0).fold(f64::INFINITY, f64::min)
            / 1.5;
    if !constant.is_finite() {
        return;
    }
    let ends = [panel.x.low, panel.x.high];
    panel.curve(canvas, &ends, &ends.map(|hz| constant / hz), Pen::new(GREY, 2.2).dashed());
    // Told where the line is well inside of the frame.
    let told = |share: f64| panel.x.low * (panel.x.high / panel.x.low).powf(share);
    let inside = [0.12, 0.3, 0.5]
        .map(told)
        .into_iter()
        .find(|hz| (0.1..0.9).contains(&panel.y.share(constant / hz)));
    let Some(hz) = inside else { return };
    let (x, y) = panel.at(hz, constant / hz);
    canvas.label(
        (x - 14.0, y + 16.0),
        "∝ 1/Ωₙ",
        Lettering::new(NUMBER).colour(GREY).at(HPos::Right, VPos::Top),
    );
}
