//! Forces between the feet and the ground against time.

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::number::{brief, prefix, short};
use super::panel::{Panel, PanelFrame};
use super::plot::EventMark;
use super::scale::{Scale, around_zero};
use super::style::{self, BLUE, GREY, Pen, SIDES, VERMILLION};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("contact");
/// An axis ends at so many times the force that is not passed in `USUAL` of the samples, where some
/// go farther: landings on stiff springs are a thousand weights, and would leave nothing else to
/// see.
const BEYOND: f64 = 2.0;
const USUAL: f64 = 0.95;

/// What the figure shows: forces on the body at the times t, one value each.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContactFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// Times, increasing (s).
    pub t: &'a [f64],
    /// Vertical force on the left foot, positive up (N).
    pub left_vertical: &'a [f64],
    /// Vertical force on the right foot, positive up (N).
    pub right_vertical: &'a [f64],
    /// Horizontal force on the left foot, positive to the right (N).
    pub left_horizontal: &'a [f64],
    /// Horizontal force on the right foot, positive to the right (N).
    pub right_horizontal: &'a [f64],
    /// The body's weight (N), drawn as a level to compare with.
    pub weight: Option<f64>,
    /// When the body overturned.
    pub end: Option<EventMark<'a>>,
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for an empty or not finite slice or slices of different lengths.
pub fn draw(data: &ContactFigure<'_>) -> Result<Sheet, FigureError> {
    let n = CHECK.times(data.t)?;
    for (what, force) in [
        ("left_vertical", data.left_vertical),
        ("right_vertical", data.right_vertical),
        ("left_horizontal", data.left_horizontal),
        ("right_horizontal", data.right_horizontal),
    ] {
        CHECK.column(what, force, n)?;
    }
    CHECK.finite("weight", data.weight.as_slice())?;

    let mut canvas = Canvas::default();
    let mut entries =
        vec![LegendEntry::line("left foot", pens()[0]), LegendEntry::line("right foot", pens()[1])];
    if let Some(weight) = data.weight {
        let (unit, letter) = prefix(weight);
        entries.push(LegendEntry::line(
            format!("weight, {} {letter}N", brief(weight / unit, 3)),
            level(),
        ));
    }
    entries.extend(data.end.map(|end| LegendEntry::line(end.text, ending())));
    let (left, right) = SIDES;
    // room for a remark
    let top = legend::header(&mut canvas, data.title, &entries, left, right) + 16.0;
    let middle = top + 450.0;
    let frames = [
        PanelFrame { left, top, right, bottom: middle },
        PanelFrame { left, top: middle + 48.0, right, bottom: middle + 404.0 },
    ];
    let vertical = [data.left_vertical, data.right_vertical];
    ForceDirection { name: "vertical", forces: vertical, weight: data.weight, last: false }.draw(
        &mut canvas,
        data,
        frames[0],
    );
    let horizontal = [data.left_horizontal, data.right_horizontal];
    ForceDirection { name: "horizontal", forces: horizontal, weight: None, last: true }.draw(
        &mut canvas,
        data,
        frames[1],
    );
    canvas.finish(middle + 504.0)
}

fn pens() -> [Pen; 2] {
    [Pen::new(BLUE, 2.6), Pen::new(VERMILLION, 2.6)]
}

fn ending() -> Pen {
    Pen::new(style::BLACK, 2.4).dashed()
}

fn level() -> Pen {
    Pen::new(GREY, 2.2).dashed()
}

/// One direction: both feet on one axis.
struct ForceDirection<'a> {
    name: &'a str,
    forces: [&'a [f64]; 2],
    weight: Option<f64>,
    last: bool,
}

impl ForceDirection<'_> {
    /// From and to (N), and the largest force if it lies beyond.
    fn range(&self) -> (f64, f64, Option<f64>) {
        let mut sizes: Vec<f64> =
            self.forces.iter().flat_map(|force| force.iter().map(|x| x.abs())).collect();
        sizes.sort_unstable_by(f64::total_cmp);
        let usual = sizes[((sizes.len() - 1) as f64 * USUAL) as usize];
        let (most, end) =
            (sizes[sizes.len() - 1], BEYOND * usual.max(0.7 * self.weight.unwrap_or(0.0)));
        let end = if usual > 0.0 && most > 1.5 * end { end } else { most };
        let all = self.forces.iter().flat_map(|force| force.iter().copied()).chain(self.weight);
        let (low, high) = around_zero(all);
        let end = end.max(self.weight.unwrap_or(0.0));
        (low.max(-end), high.min(end), (most > end).then_some(most))
    }

    fn draw(&self, canvas: &mut Canvas, data: &ContactFigure<'_>, frame: PanelFrame) {
        let (low, high, beyond) = self.range();
        let (unit, letter) = prefix(high.max(-low));
        let room = 0.06 * (high - low) / unit;
        let x = Scale::linear(data.t[0], data.t[data.t.len() - 1]);
        let panel = Panel { frame, x, y: Scale::linear(low / unit - room, high / unit + room) };
        let label = format!("{} force [{letter}N]", self.name);
        panel.axes(canvas, self.last.then_some("time [s]"), &label, 110.0);
        panel.level(canvas, 0.0, Pen::new(style::AXIS, 1.5));
        let scaled = self.forces.map(|force| force.iter().map(|x| x / unit).collect::<Vec<f64>>());
        let weight = self.weight.map(|weight| [weight / unit]);
        let mut curves: Vec<(&str, &[f64], Pen)> = Vec::new();
        curves.extend(
            ["left foot", "right foot"]
                .into_iter()
                .zip(&scaled)
                .zip(pens())
                .map(|((n, f), p)| (n, &f[..], p)),
        );
        curves.extend(weight.iter().map(|weight| ("weight", &weight[..], level())));
        let mut plot = panel.history(canvas, &label, data.t, &curves);
        let end = data.end.map(|end| (end, ending()));
        panel.events(canvas, &mut plot, end.as_slice(), false);
        if let Some(most) = beyond {
            let (unit, letter) = prefix(most);
            let weights =
                data.weight.map_or(String::new(), |w| format!(", {} weights", short(most / w, 3)));
            panel.remark(
                canvas,
                &format!("landings go on to {} {letter}N{weights}", short(most / unit, 3)),
            );
        }
        canvas.keep(plot);
    }
}
