//! The front: the least error that springs up to a stiffness reach, ours beside others.

use std::path::Path;

use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Canvas, Lettering};
use super::legend::{self, Entry};
use super::mark::{self, Mark, Shape};
use super::panel::{Frame, Panel};
use super::scale::Scale;
use super::style::{self, GREY, NUMBER, Pen, WIDTH};
use super::{Check, FigureError};

const CHECK: Check = Check("front");

/// One way to find springs: an error for each bound on the frequency, one value each.
#[derive(Clone, Copy, Debug)]
pub struct Series<'a> {
    pub label: &'a str,
    /// The stiffer chain's Omega_n [Hz].
    pub max_hz: &'a [f64],
    /// Error of the horizontal history.
    pub nrmse_u: &'a [f64],
    /// Error of the vertical history.
    pub nrmse_v: &'a [f64],
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct Front<'a> {
    pub title: &'a str,
    pub series: &'a [Series<'a>],
    /// Errors to be met: (max Omega_n [Hz], largest NRMSE).
    pub goals: &'a [(f64, f64)],
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for an empty or not finite slice or slices of different lengths, and when `path` cannot be written.
pub fn render(data: &Front<'_>, path: &Path) -> Result<(), FigureError> {
    CHECK.least("series", data.series.len(), 1)?;
    for series in data.series {
        CHECK.least(series.label, series.max_hz.len(), 1)?;
        CHECK.finite(&format!("max_hz of {}", series.label), series.max_hz)?;
        CHECK.column(&format!("nrmse_u of {}", series.label), series.nrmse_u, series.max_hz.len())?;
        CHECK.column(&format!("nrmse_v of {}", series.label), series.nrmse_v, series.max_hz.len())?;
    }
    CHECK.finite("goals", &data.goals.iter().flat_map(|goal| [goal.0, goal.1]).collect::<Vec<_>>())?;

    let mut canvas = Canvas::new(WIDTH, 1000);
    let mut entries = Vec::new();
    for (i, series) in data.series.iter().enumerate() {
        entries.push(Entry::both(format!("{}, u", series.label), solid(i), dot(i)));
        entries.push(Entry::both(format!("{}, v", series.label), solid(i).dashed(), dot(i).hollow()));
    }
    if !data.goals.is_empty() {
        entries.push(Entry::mark("goal", goal()));
    }
    let (left, right) = (150.0, WIDTH as f64 - 40.0);
    let top = legend::header(&mut canvas, data.title, &entries, left, right);
    let goals = data.goals.iter();
    let x =
        Scale::log_around(data.series.iter().flat_map(|s| s.max_hz).copied().chain(goals.clone().map(|g| g.0)), 4.0);
    let errors = data.series.iter().flat_map(|s| s.nrmse_u.iter().chain(s.nrmse_v)).copied();
    let y = Scale::log_around(errors.chain(goals.map(|g| g.1)), 10.0);
    let panel = Panel { frame: Frame { left, top, right, bottom: 900.0 }, x, y };
    panel.axes(&mut canvas, Some("stiffer chain, max Ωₙ [Hz]"), "error against Housner, NRMSE", 110.0);
    guide(&mut canvas, &panel, data);
    for &(hz, error) in data.goals {
        goal().draw(&mut canvas, panel.at_clamped(hz, error));
    }
    // The last series lies lowest: ours comes first in the list and on top in the picture.
    for (i, series) in data.series.iter().enumerate().rev() {
        for (error, pen, mark) in
            [(series.nrmse_v, solid(i).dashed(), dot(i).hollow()), (series.nrmse_u, solid(i), dot(i))]
        {
            panel.curve(&mut canvas, series.max_hz, error, pen);
            for (&hz, &error) in series.max_hz.iter().zip(error) {
                mark.draw(&mut canvas, panel.at_clamped(hz, error));
            }
        }
    }
    canvas.save(path)
}

fn solid(i: usize) -> Pen {
    Pen::new(style::series(i), 3.0)
}

fn dot(i: usize) -> Mark {
    Mark::new(mark::series(i), 9.0, style::series(i))
}

fn goal() -> Mark {
    Mark::new(Shape::Pennant, 10.0, GREY)
}

/// error = const / max Omega_n, below every point of the first series so that it crosses none of it.
fn guide(canvas: &mut Canvas, panel: &Panel, data: &Front<'_>) {
    let Some(first) = data.series.first() else { return };
    let pairs = first.max_hz.iter().zip(first.nrmse_u).chain(first.max_hz.iter().zip(first.nrmse_v));
    let constant = pairs.map(|(hz, error)| hz * error).filter(|x| *x > 0.0).fold(f64::INFINITY, f64::min) / 1.5;
    if !constant.is_finite() {
        return;
    }
    let ends = [panel.x.low, panel.x.high];
    panel.curve(canvas, &ends, &ends.map(|hz| constant / hz), Pen::new(GREY, 2.2).dashed());
    // Told where the line is well inside of the frame.
    let told = |share: f64| panel.x.low * (panel.x.high / panel.x.low).powf(share);
    let inside = [0.12, 0.3, 0.5].map(told).into_iter().find(|hz| (0.1..0.9).contains(&panel.y.share(constant / hz)));
    let Some(hz) = inside else { return };
    let (x, y) = panel.at(hz, constant / hz);
    canvas.label((x - 14.0, y + 16.0), "∝ 1/Ωₙ", Lettering::new(NUMBER).colour(GREY).at(HPos::Right, VPos::Top));
}
