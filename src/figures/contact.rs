//! Forces between the feet and the ground against time.

use std::path::Path;

use super::canvas::Canvas;
use super::legend::{self, Entry};
use super::number::{brief, prefix};
use super::panel::{Frame, Panel};
use super::scale::Scale;
use super::style::{self, BLUE, GREY, Pen, VERMILLION, WIDTH};
use super::{Check, FigureError};

const CHECK: Check = Check("contact");

/// What the figure shows: forces on the body at the times t, one value each.
#[derive(Clone, Copy, Debug)]
pub struct Contact<'a> {
    pub title: &'a str,
    /// Times, increasing [s].
    pub t: &'a [f64],
    /// Vertical force on the left foot, positive up [N].
    pub left_vertical: &'a [f64],
    /// Vertical force on the right foot, positive up [N].
    pub right_vertical: &'a [f64],
    /// Horizontal force on the left foot, positive to the right [N].
    pub left_horizontal: &'a [f64],
    /// Horizontal force on the right foot, positive to the right [N].
    pub right_horizontal: &'a [f64],
    /// The body's weight [N], drawn as a level to compare with.
    pub weight: Option<f64>,
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for an empty or not finite slice or slices of different lengths, and when `path` cannot be written.
pub fn render(data: &Contact<'_>, path: &Path) -> Result<(), FigureError> {
    CHECK.least("t", data.t.len(), 2)?;
    CHECK.finite("t", data.t)?;
    let n = data.t.len();
    for (what, force) in [
        ("left_vertical", data.left_vertical),
        ("right_vertical", data.right_vertical),
        ("left_horizontal", data.left_horizontal),
        ("right_horizontal", data.right_horizontal),
    ] {
        CHECK.column(what, force, n)?;
    }
    CHECK.finite("weight", data.weight.as_slice())?;

    let mut canvas = Canvas::new(WIDTH, 1060);
    let (left_foot, right_foot) = (Pen::new(BLUE, 2.6), Pen::new(VERMILLION, 2.6));
    let level = Pen::new(GREY, 2.2).dashed();
    let mut entries = vec![Entry::line("left foot", left_foot), Entry::line("right foot", right_foot)];
    if let Some(weight) = data.weight {
        let (unit, letter) = prefix(weight);
        entries.push(Entry::line(format!("weight, {} {letter}N", brief(weight / unit, 3)), level));
    }
    let (left, right) = (150.0, WIDTH as f64 - 40.0);
    let top = legend::header(&mut canvas, data.title, &entries, left, right);
    let x = Scale::linear(data.t[0], data.t[n - 1]);
    let middle = top + 450.0;
    let frames = [Frame { left, top, right, bottom: middle }, Frame { left, top: middle + 34.0, right, bottom: 960.0 }];

    let vertical = [(data.left_vertical, left_foot), (data.right_vertical, right_foot)];
    let (panel, unit) = pair(&mut canvas, data.t, &vertical, data.weight, x, frames[0], "vertical", None);
    if let Some(weight) = data.weight {
        panel.level(&mut canvas, weight / unit, level);
    }
    let horizontal = [(data.left_horizontal, left_foot), (data.right_horizontal, right_foot)];
    pair(&mut canvas, data.t, &horizontal, None, x, frames[1], "horizontal", Some("time [s]"));
    canvas.save(path)
}

/// One direction: both feet on one axis. The panel and the unit of its numbers [N].
#[allow(clippy::too_many_arguments)]
fn pair(
    canvas: &mut Canvas,
    t: &[f64],
    forces: &[(&[f64], Pen)],
    shown: Option<f64>,
    x: Scale,
    frame: Frame,
    direction: &str,
    x_label: Option<&str>,
) -> (Panel, f64) {
    let all = forces.iter().flat_map(|(force, _)| force.iter().copied()).chain(shown);
    let (low, high) = all.fold((0.0_f64, 0.0_f64), |(low, high), force| (low.min(force), high.max(force)));
    let (unit, letter) = prefix(high.max(-low));
    let room = 0.06 * (high - low) / unit;
    let panel = Panel { frame, x, y: Scale::linear(low / unit - room, high / unit + room) };
    panel.axes(canvas, x_label, &format!("{direction} force [{letter}N]"), 110.0);
    panel.level(canvas, 0.0, Pen::new(style::AXIS, 1.5));
    for (force, pen) in forces {
        let scaled: Vec<f64> = force.iter().map(|force| force / unit).collect();
        panel.curve(canvas, t, &scaled, *pen);
    }
    (panel, unit)
}
