//! Two models over many records: distributions of the peaks, peak against peak, error against
//! conditioning.

use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::lettering::Lettering;
use super::mark::{Mark, MarkShape};
use super::number::short;
use super::panel::{Panel, PanelFrame, stairs};
use super::scale::Scale;
use super::style::{BLACK, BLUE, GREY, NUMBER, Pen, SIDES, VERMILLION};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("validation");
/// A toppled body has no peak of its own: it stands at 1, the edge of the pictures.
const TOPPLED: f64 = 1.0;

/// One record under both models.
#[derive(Clone, Copy, Debug)]
pub struct ValidationPoint {
    /// Peak |theta|/alpha by Housner; whatever it is, 1 is drawn when the body toppled.
    pub peak_housner: f64,
    /// Peak |theta|/alpha by finite elements.
    pub peak_fem: f64,
    /// Whether Housner's body overturns.
    pub overturned_housner: bool,
    /// Whether the finite elements overturn.
    pub overturned_fem: bool,
    /// Relative change of Housner's history per relative change of the structure; may be infinite.
    pub sensitivity: f64,
    /// Error of the horizontal history; may be infinite.
    pub nrmse: f64,
}

/// What the figure shows.
#[derive(Clone, Copy, Debug, Default)]
pub struct ValidationFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// The records.
    pub rows: &'a [ValidationPoint],
    /// Kolmogorov-Smirnov distance of the two distributions of peaks.
    pub ks_distance: f64,
    /// Below this sensitivity a record is well conditioned.
    pub well_conditioned: f64,
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] when there is no row, for a NaN or a negative peak.
pub fn draw(data: &ValidationFigure<'_>) -> Result<Sheet, FigureError> {
    CHECK.least("rows", data.rows.len(), 1)?;
    let column =
        |of: fn(&ValidationPoint) -> f64| -> Vec<f64> { data.rows.iter().map(of).collect() };
    for (what, values) in [
        ("peak_housner", column(|row| row.peak_housner)),
        ("peak_fem", column(|row| row.peak_fem)),
        ("sensitivity", column(|row| row.sensitivity)),
        ("nrmse", column(|row| row.nrmse)),
    ] {
        CHECK.each(what, &values, |x| x >= 0.0)?;
    }
    CHECK.finite("ks_distance and well_conditioned", &[data.ks_distance, data.well_conditioned])?;

    let mut canvas = Canvas::default();
    let mut entries = vec![
        LegendEntry::line("Housner", Pen::new(BLACK, 5.0)),
        LegendEntry::line("finite element", Pen::new(VERMILLION, 2.6)),
        LegendEntry::mark("record", dot()),
    ];
    if data.rows.iter().any(|row| row.overturned_housner || row.overturned_fem) {
        entries.push(LegendEntry::mark("toppled in one or both", toppled()));
    }
    let lost = data
        .rows
        .iter()
        .filter(|row| !(row.nrmse.is_finite() && row.sensitivity.is_finite()))
        .count();
    if lost > 0 {
        entries.push(LegendEntry::mark(
            format!("error or sensitivity not finite ({lost}), at the edge"),
            infinite(),
        ));
    }
    let (left, right) = SIDES;
    let top = legend::header(&mut canvas, data.title, &entries, left, right);
    let middle = (left + right) / 2.0;
    let bottom = top + 590.0;
    distributions(&mut canvas, data, PanelFrame { left, top, right: middle - 40.0, bottom });
    peaks(&mut canvas, data, PanelFrame { left: middle + 115.0, top, right, bottom });
    errors(
        &mut canvas,
        data,
        PanelFrame { left, top: bottom + 130.0, right, bottom: bottom + 660.0 },
    );
    canvas.finish(bottom + 760.0)
}

fn dot() -> Mark {
    Mark::new(MarkShape::Disc, 7.0, BLUE)
}

fn infinite() -> Mark {
    Mark::new(MarkShape::Triangle, 9.0, GREY)
}

fn toppled() -> Mark {
    Mark::new(MarkShape::Square, 8.0, VERMILLION).hollow()
}

fn pair(row: &ValidationPoint) -> (f64, f64) {
    let of = |peak: f64, over: bool| if over { TOPPLED } else { peak.min(TOPPLED) };
    (of(row.peak_housner, row.overturned_housner), of(row.peak_fem, row.overturned_fem))
}

/// Both cumulative distributions as stairs, and where they are farthest apart.
fn distributions(canvas: &mut Canvas, data: &ValidationFigure<'_>, frame: PanelFrame) {
    let panel = Panel { frame, x: Scale::linear(0.0, 1.04), y: Scale::linear(0.0, 1.04) };
    panel.axes(canvas, Some("peak |θ|/α"), "share of records below", 105.0);
    let (mut rigid, mut fem): (Vec<f64>, Vec<f64>) = data.rows.iter().map(pair).unzip();
    rigid.sort_by(f64::total_cmp);
    fem.sort_by(f64::total_cmp);
    for (sorted, pen) in [(&rigid, Pen::new(BLACK, 5.0)), (&fem, Pen::new(VERMILLION, 2.6))] {
        let (mut x, mut y) = stairs(sorted);
        x.push(panel.x.high);
        y.push(1.0);
        panel.curve(canvas, &x, &y, pen);
    }
    let below = |sorted: &[f64], x: f64| {
        sorted.partition_point(|peak| *peak <= x) as f64 / sorted.len() as f64
    };
    let mut widest = (0.0, 0.0, 0.0);
    for &x in rigid.iter().chain(&fem) {
        let (a, b) = (below(&rigid, x), below(&fem, x));
        if (a - b).abs() > widest.2 {
            widest = (x, (a + b) / 2.0, (a - b).abs());
        }
    }
    let told = match data.rows.len() {
        1 => "one record: no statistics".to_string(),
        _ => format!("KS distance {}", short(data.ks_distance, 2)),
    };
    let how = Lettering::new(NUMBER).colour(BLUE).bold().at(HPos::Right, VPos::Bottom);
    if widest.2 > 0.0 {
        let (x, half) = (widest.0, widest.2 / 2.0);
        panel.curve(canvas, &[x, x], &[widest.1 - half, widest.1 + half], Pen::new(BLUE, 5.0));
    }
    // The lower right corner, up to where toppled bodies stand, lies below any distribution but one
    // of toppled bodies alone.
    canvas.label((panel.at(0.97, 0.0).0, frame.bottom - 18.0), &told, how);
}

/// Each record's peak in the finite element model against Housner's; on the diagonal they agree.
fn peaks(canvas: &mut Canvas, data: &ValidationFigure<'_>, frame: PanelFrame) {
    let panel = Panel { frame, x: Scale::linear(0.0, 1.04), y: Scale::linear(0.0, 1.04) };
    panel.axes(canvas, Some("Housner, peak |θ|/α"), "finite element, peak |θ|/α", 95.0);
    panel.curve(canvas, &[0.0, 1.04], &[0.0, 1.04], Pen::new(GREY, 2.0).dashed());
    let over = |row: &&ValidationPoint| row.overturned_housner || row.overturned_fem;
    for row in data.rows.iter().filter(|row| !over(row)) {
        let (x, y) = pair(row);
        let mark = if row.peak_fem.is_finite() { dot() } else { infinite() };
        mark.draw(canvas, panel.at(x, y));
    }
    for row in data.rows.iter().filter(over) {
        let (x, y) = pair(row);
        toppled().draw(canvas, panel.at(x, y));
    }
}

/// Error against the sensitivity of Housner's own answer: where it is large, no model can follow
/// one to one.
fn errors(canvas: &mut Canvas, data: &ValidationFigure<'_>, frame: PanelFrame) {
    // a body that never lifts has no history to compare
    let rows = || data.rows.iter().filter(|row| row.sensitivity > 0.0);
    let x =
        Scale::log_around(rows().map(|row| row.sensitivity).chain([data.well_conditioned]), 10.0);
    let panel = Panel { frame, x, y: Scale::log_around(rows().map(|row| row.nrmse), 10.0) };
    panel.axes(canvas, Some("sensitivity of Housner's history"), "NRMSE of u", 110.0);
    panel.upright(canvas, data.well_conditioned, Pen::new(GREY, 2.2).dashed());
    // Well conditioned first, so that the rarer toppled ones stay visible on top.
    let over = |row: &&ValidationPoint| row.overturned_housner || row.overturned_fem;
    for row in rows().filter(|row| !over(row)) {
        let finite = row.nrmse.is_finite() && row.sensitivity.is_finite();
        let mark = if finite { dot() } else { infinite() };
        mark.draw(canvas, panel.at_clamped(row.sensitivity, row.nrmse));
    }
    for row in rows().filter(over) {
        toppled().draw(canvas, panel.at_clamped(row.sensitivity, row.nrmse));
    }
    let at = panel.at(data.well_conditioned, panel.y.high);
    // above the frame: within it there may be a point anywhere
    let how = Lettering::new(NUMBER).colour(GREY).at(HPos::Right, VPos::Bottom);
    canvas.label((at.0 + 8.0, at.1 - 8.0), "well conditioned", how);
}
