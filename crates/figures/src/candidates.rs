//! Error of every sampled candidate against its two frequencies: how rugged the landscape is, and
//! what was chosen.

use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::lettering::Lettering;
use super::mark::{Mark, MarkShape};
use super::number::short;
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::{BLUE, NUMBER, PALE, Pen, SIDES, VERMILLION};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("candidates");

/// One pair of springs that was tried.
#[derive(Clone, Copy, Debug)]
pub struct CandidateMark {
    /// Omega_n of the vertical chain (Hz).
    pub vertical_hz: f64,
    /// Omega_n of the horizontal chain (Hz).
    pub horizontal_hz: f64,
    /// Its error; for an abandoned one what it had reached then, a lower bound. May be infinite:
    /// drawn at the top.
    pub error: f64,
    /// Whether its run was ended before the record's end because it could not win any more.
    pub abandoned: bool,
}

/// What the figure shows.
#[derive(Clone, Copy, Debug, Default)]
pub struct CandidatesFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// What the error is, as "NRMSE of u and v".
    pub error_label: &'a str,
    /// All that were tried.
    pub candidates: &'a [CandidateMark],
    /// Index of the best one.
    pub chosen: Option<usize>,
    /// What the best one is: "delivered", or best of something else.
    pub chosen_label: &'a str,
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] when there is no candidate, for a NaN, for an index beyond the candidates.
pub fn draw(data: &CandidatesFigure<'_>) -> Result<Sheet, FigureError> {
    let all = data.candidates;
    CHECK.least(
        "candidates",
        all.len().min(data.chosen.map_or(usize::MAX, |i| all.len().saturating_sub(i))),
        1,
    )?;
    let frequencies: Vec<f64> = all.iter().flat_map(|c| [c.vertical_hz, c.horizontal_hz]).collect();
    CHECK.finite("frequencies (vertical and horizontal in turn)", &frequencies)?;
    let errors: Vec<f64> = all.iter().map(|c| c.error).collect();
    CHECK.each("error", &errors, |x| !x.is_nan())?;

    let mut canvas = Canvas::default();
    let count = |abandoned: bool| all.iter().filter(|c| c.abandoned == abandoned).count();
    let mut entries =
        vec![LegendEntry::mark(format!("run to the end ({})", count(false)), whole())];
    if count(true) > 0 {
        entries.push(LegendEntry::mark(
            format!("abandoned, at its lower bound ({})", count(true)),
            abandoned(),
        ));
    }
    if data.chosen.is_some() {
        entries.push(LegendEntry::mark(data.chosen_label, chosen()));
    }
    let lost = errors.iter().filter(|e| e.is_infinite()).count();
    if lost > 0 {
        entries.push(LegendEntry::mark(
            format!("no finite error ({lost}), at the upper edge"),
            infinite(),
        ));
    }
    let ((left, right), gap) = (SIDES, 110.0);
    let top = legend::header(&mut canvas, data.title, &entries, left, right);
    let middle = (left + right) / 2.0;
    let y = Scale::log_around(errors.iter().copied(), 10.0);
    // Room below all marks for the words about the chosen one.
    let y = Scale::log(y.low / (y.high / y.low).powf(0.07), y.high);
    let x = Scale::log_around(frequencies.iter().copied(), 4.0);
    for (from, to, axis, first) in [
        (left, middle - gap / 2.0, "vertical Ωₙ [Hz]", true),
        (middle + gap / 2.0, right, "horizontal Ωₙ [Hz]", false),
    ] {
        let panel =
            Panel { frame: PanelFrame { left: from, top, right: to, bottom: top + 670.0 }, x, y };
        panel.axes(&mut canvas, Some(axis), if first { data.error_label } else { "" }, 110.0);
        let hz = |c: &CandidateMark| if first { c.vertical_hz } else { c.horizontal_hz };
        let best = data.chosen.map(|i| all[i]);
        if let Some(best) = best {
            panel.upright(&mut canvas, hz(&best), Pen::new(VERMILLION, 2.0).dashed());
        }
        // The abandoned lie under the others.
        for (skip, mark) in [(false, abandoned()), (true, whole())] {
            for candidate in all.iter().filter(|c| c.abandoned != skip) {
                let mark = if candidate.error.is_infinite() { infinite() } else { mark };
                mark.draw(&mut canvas, panel.at_clamped(hz(candidate), candidate.error));
            }
        }
        if let Some(best) = best {
            chosen().draw(&mut canvas, panel.at_clamped(hz(&best), best.error));
            tell(&mut canvas, &panel, hz(&best), best.error);
        }
    }
    canvas.finish(top + 770.0)
}

fn whole() -> Mark {
    Mark::new(MarkShape::Disc, 7.0, BLUE)
}

fn abandoned() -> Mark {
    // a ring around one that was run to the end at the same place
    Mark::new(MarkShape::Disc, 11.0, PALE).hollow()
}

fn infinite() -> Mark {
    Mark::new(MarkShape::Triangle, 8.0, PALE)
}

fn chosen() -> Mark {
    Mark::new(MarkShape::Diamond, 12.0, VERMILLION)
}

/// The chosen one's numbers, at the foot of its line.
fn tell(canvas: &mut Canvas, panel: &Panel, hz: f64, error: f64) {
    let at = panel.at(hz, panel.y.low);
    let text = format!("{} Hz, {}", short(hz, 3), short(error, 2));
    let how = Lettering::new(NUMBER).bold().colour(VERMILLION);
    let on_the_left = at.0 + 16.0 + how.length(&text) > panel.frame.right;
    let (x, across) =
        if on_the_left { (at.0 - 12.0, HPos::Right) } else { (at.0 + 12.0, HPos::Left) };
    canvas.text((x, at.1 - 12.0), &text, how.at(across, VPos::Bottom));
}
