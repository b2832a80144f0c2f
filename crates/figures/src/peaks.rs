//! Peaks of two models over a sweep: one against the other, and their distributions.

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::mark::{Mark, MarkShape};
use super::panel::{Panel, PanelFrame, stairs};
use super::scale::Scale;
use super::style::{BLACK, BLUE, GREY, Pen, SIDES, VERMILLION};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("peaks");
/// A body that overturned stands at the edge.
const EDGE: f64 = 1.0;

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct PeaksFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// |theta|/alpha by Housner and on springs; infinite for a body that overturned.
    pub pairs: &'a [(f64, f64)],
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] when there is no pair, for a NaN or a negative peak.
pub fn draw(data: &PeaksFigure<'_>) -> Result<Sheet, FigureError> {
    CHECK.least("pairs", data.pairs.len(), 1)?;
    let (rigid, fem): (Vec<f64>, Vec<f64>) = data.pairs.iter().copied().unzip();
    CHECK.each("Housner", &rigid, |x| x >= 0.0)?;
    CHECK.each("finite element", &fem, |x| x >= 0.0)?;
    let mut canvas = Canvas::default();
    let dot = |colour, shape| Mark::new(shape, 5.0, colour);
    let entries = [
        LegendEntry::line("Housner", Pen::new(BLACK, 5.0)),
        LegendEntry::line("finite element", Pen::new(VERMILLION, 2.6)),
        LegendEntry::mark("history", dot(BLUE, MarkShape::Disc)),
        LegendEntry::mark("overturned in one or both", dot(VERMILLION, MarkShape::Square)),
    ];
    let (left, right) = SIDES;
    let top = legend::header(&mut canvas, data.title, &entries, left, right) + 10.0;
    let (middle, bottom) = (0.5 * (left + right), 750.0);
    let scale = || Scale::linear(0.0, 1.04);
    let panel = Panel {
        frame: PanelFrame { left, top, right: middle - 40.0, bottom },
        x: scale(),
        y: scale(),
    };
    panel.axes(&mut canvas, Some("peak |θ|/α"), "share of histories below", 105.0);
    for (mut peaks, pen) in [(rigid, Pen::new(BLACK, 5.0)), (fem, Pen::new(VERMILLION, 2.6))] {
        peaks.iter_mut().for_each(|peak| *peak = peak.min(EDGE));
        peaks.sort_by(f64::total_cmp);
        let (x, y) = stairs(&peaks);
        panel.curve(&mut canvas, &x, &y, pen);
    }
    let panel = Panel {
        frame: PanelFrame { left: middle + 115.0, top, right, bottom },
        x: scale(),
        y: scale(),
    };
    panel.axes(&mut canvas, Some("Housner, peak |θ|/α"), "finite element, peak |θ|/α", 95.0);
    panel.curve(&mut canvas, &[0.0, 1.04], &[0.0, 1.04], Pen::new(GREY, 2.0).dashed());
    for &(rigid, fem) in data.pairs {
        let over = rigid.is_infinite() || fem.is_infinite();
        let mark =
            if over { dot(VERMILLION, MarkShape::Square) } else { dot(BLUE, MarkShape::Disc) };
        mark.draw(&mut canvas, panel.at(rigid.min(EDGE), fem.min(EDGE)));
    }
    canvas.finish(860.0)
}
