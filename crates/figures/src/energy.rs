//! The energy account against time: what came in, where it is, and what is missing.

use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::lettering::Lettering;
use super::number::{prefix, short};
use super::panel::{Panel, PanelFrame};
use super::plot::EventMark;
use super::scale::{Scale, around_zero};
use super::style::{self, BLACK, BLUE, GREEN, NUMBER, Pen, SIDES, VERMILLION};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("energy");

/// What the figure shows, at the times t, one value each.
#[derive(Clone, Copy, Debug, Default)]
pub struct EnergyFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// Times, increasing (s).
    pub t: &'a [f64],
    /// Work done by the ground on the structure since the start (J).
    pub input: &'a [f64],
    /// Kinetic, elastic and potential energy, less that at the start (J).
    pub stored: &'a [f64],
    /// Work done by the dashpots since the start (J).
    pub dissipated: &'a [f64],
    /// input - stored - dissipated, as the account found it (J).
    pub residual: &'a [f64],
    /// When the body overturned.
    pub end: Option<EventMark<'a>>,
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for an empty or not finite slice or slices of different lengths.
pub fn draw(data: &EnergyFigure<'_>) -> Result<Sheet, FigureError> {
    let n = CHECK.times(data.t)?;
    let accounts =
        [("input", data.input), ("stored", data.stored), ("dissipated", data.dissipated)];
    for (what, energy) in accounts.into_iter().chain([("residual", data.residual)]) {
        CHECK.column(what, energy, n)?;
    }

    let mut canvas = Canvas::default();
    let pens = [Pen::new(BLACK, 4.0), Pen::new(BLUE, 2.8), Pen::new(VERMILLION, 2.8)];
    let names = ["input by the ground", "stored", "dissipated"];
    let mut entries: Vec<LegendEntry> =
        names.iter().zip(pens).map(|(name, pen)| LegendEntry::line(*name, pen)).collect();
    let rest = Pen::new(GREEN, 2.4);
    entries.push(LegendEntry::line("residual", rest));
    let ending = Pen::new(BLACK, 2.4).dashed();
    entries.extend(data.end.map(|end| LegendEntry::line(end.text, ending)));
    let (left, right) = SIDES;
    let top = legend::header(&mut canvas, data.title, &entries, left, right);
    let x = Scale::linear(data.t[0], data.t[n - 1]);

    let all = accounts.iter().flat_map(|(_, energy)| energy.iter().copied());
    let (low, high) = around_zero(all);
    let (unit, letter) = prefix(high.max(-low));
    let room = 0.06 * (high - low) / unit;
    let y = Scale::linear(if low < 0.0 { low / unit - room } else { 0.0 }, high / unit + room);
    let middle = top + 520.0;
    let panel = Panel { frame: PanelFrame { left, top, right, bottom: middle }, x, y };
    let label = format!("energy [{letter}J]");
    panel.axes(&mut canvas, None, &label, 110.0);
    panel.level(&mut canvas, 0.0, Pen::new(style::AXIS, 1.5));
    let scaled =
        accounts.map(|(_, energy)| energy.iter().map(|energy| energy / unit).collect::<Vec<f64>>());
    let curves: Vec<(&str, &[f64], Pen)> = names
        .iter()
        .zip(&scaled)
        .zip(pens)
        .map(|((name, energy), pen)| (*name, &energy[..], pen))
        .collect();
    let mut plot = panel.history(&mut canvas, &label, data.t, &curves);
    let end = data.end.map(|end| (end, ending));
    panel.events(&mut canvas, &mut plot, end.as_slice(), false);
    canvas.keep(plot);

    // The residual as a share of the largest input so far known: of the whole run.
    let whole = data.input.iter().fold(0.0_f64, |most, x| most.max(x.abs())).max(f64::MIN_POSITIVE);
    let share: Vec<f64> = data.residual.iter().map(|x| x.abs() / whole).collect();
    let most = share.iter().copied().fold(0.0_f64, f64::max);
    let top_share = (most * 4.0).max(1e-15);
    let panel = Panel {
        frame: PanelFrame { left, top: middle + 34.0, right, bottom: middle + 330.0 },
        x,
        y: Scale::log(top_share * 1e-5, top_share),
    };
    const SHARE: &str = "|residual| / input";
    panel.axes(&mut canvas, Some("time [s]"), SHARE, 110.0);
    let plot = panel.history(&mut canvas, SHARE, data.t, &[("residual", &share, rest)]);
    canvas.keep(plot);
    let how = Lettering::new(NUMBER).colour(style::TEXT).at(HPos::Right, VPos::Bottom);
    let at = panel.at(x.high, panel.y.low);
    canvas.label((at.0 - 12.0, at.1 - 14.0), &format!("largest {}", short(most, 2)), how);
    canvas.finish(middle + 430.0)
}
