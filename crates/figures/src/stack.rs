//! Quantities against time, one panel each above the other.

use super::canvas::Canvas;
use super::history::{last_moving, with_margin};
use super::legend::{self, LegendEntry};
use super::number::prefix;
use super::panel::{Panel, PanelFrame};
use super::plot::EventMark;
use super::scale::{Scale, around_zero};
use super::style::{self, BLACK, Pen, SIDES};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("stack");
/// Heights of a panel and of the gap below it (pixel).
const TALL: f64 = 380.0;
const GAP: f64 = 34.0;

/// One quantity: the same curves in every panel, one of them empty where a model has no such thing.
#[derive(Clone, Copy, Debug)]
pub struct StackQuantity<'a> {
    /// As "base shear".
    pub name: &'a str,
    /// As "N": a prefix is set before it.
    pub unit: &'a str,
    /// As many as [`StackFigure::names`], each at most as long as the times.
    pub curves: &'a [&'a [f64]],
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct StackFigure<'a> {
    /// Lines of the title.
    pub title: &'a str,
    /// Times, increasing (s).
    pub t: &'a [f64],
    /// Names of the curves; the first is black and lies under the others.
    pub names: &'a [&'a str],
    /// From above.
    pub panels: &'a [StackQuantity<'a>],
    /// A time from which on curves are not to be compared.
    pub event: Option<EventMark<'a>>,
}

/// The same figure without the quiet that a record ends in: up to where the last of the quantities
/// has come to rest, and a margin, as [`super::history`] has it.
///
/// # Errors
/// As [`draw`].
pub fn draw_while_moving<'a>(data: &StackFigure<'a>) -> Result<Sheet, FigureError> {
    let last = data.panels.iter().map(|panel| last_moving(panel.curves)).max().unwrap_or(0);
    let n = with_margin(last, data.t.len());
    let fits = |curve: &&[f64]| curve.len() <= data.t.len();
    if n == data.t.len() || !data.panels.iter().flat_map(|panel| panel.curves).all(fits) {
        return draw(data);
    }
    let first = |curves: &[&'a [f64]]| -> Vec<&'a [f64]> {
        curves.iter().map(|curve| &curve[..n.min(curve.len())]).collect()
    };
    let curves: Vec<_> = data.panels.iter().map(|panel| first(panel.curves)).collect();
    let panels: Vec<StackQuantity> = data
        .panels
        .iter()
        .zip(&curves)
        .map(|(panel, curves)| StackQuantity { curves, ..*panel })
        .collect();
    let event = data.event.filter(|event| event.time <= data.t[n - 1]);
    draw(&StackFigure { t: &data.t[..n], panels: &panels, event, ..*data })
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for an empty or not finite slice, or one longer than the times.
pub fn draw(data: &StackFigure<'_>) -> Result<Sheet, FigureError> {
    CHECK.times(data.t)?;
    for panel in data.panels {
        for (name, curve) in data.names.iter().zip(panel.curves) {
            let what = format!("{} of {name}", panel.name);
            CHECK.finite(&what, curve)?;
            if curve.len() > data.t.len() {
                return Err(FigureError::Length {
                    figure: CHECK.0,
                    what,
                    found: curve.len(),
                    wanted: data.t.len(),
                });
            }
        }
    }
    let pens: Vec<Pen> = (0..data.names.len()).map(pen).collect();
    let mut canvas = Canvas::default();
    let ending = Pen::new(BLACK, 2.4).dashed();
    let mut entries: Vec<LegendEntry> =
        data.names.iter().zip(&pens).map(|(name, pen)| LegendEntry::line(*name, *pen)).collect();
    entries.extend(data.event.map(|event| LegendEntry::line(event.text, ending)));
    let (left, right) = SIDES;
    let mut top = legend::header(&mut canvas, data.title, &entries, left, right);
    let x = Scale::linear(data.t[0], data.t[data.t.len() - 1]);
    for (i, quantity) in data.panels.iter().enumerate() {
        let frame = PanelFrame { left, top, right, bottom: top + TALL };
        let last = i + 1 == data.panels.len();
        one(&mut canvas, data, quantity, &pens, (x, frame, last, ending));
        top += TALL + GAP;
    }
    canvas.finish(top - GAP + 100.0)
}

fn one(
    canvas: &mut Canvas,
    data: &StackFigure<'_>,
    quantity: &StackQuantity<'_>,
    pens: &[Pen],
    (x, frame, last, ending): (Scale, PanelFrame, bool, Pen),
) {
    let all = quantity.curves.iter().flat_map(|curve| curve.iter().copied());
    let (low, high) = around_zero(all);
    let size = high.max(-low);
    let (unit, letter) = unit(data.panels, quantity, size);
    let room = (0.06 * (high - low) / unit).max(f64::MIN_POSITIVE);
    let y = if size > 0.0 {
        Scale::linear(low / unit - room, high / unit + room)
    } else {
        Scale::linear(-1.0, 1.0)
    };
    let panel = Panel { frame, x, y };
    let label = format!("{} [{letter}{}]", quantity.name, quantity.unit);
    panel.axes(canvas, last.then_some("time [s]"), &label, 110.0);
    panel.level(canvas, 0.0, Pen::new(style::AXIS, 1.5));
    let scaled: Vec<Vec<f64>> = quantity
        .curves
        .iter()
        .map(|curve| curve.iter().map(|value| value / unit).collect())
        .collect();
    let curves: Vec<(&str, &[f64], Pen)> = data
        .names
        .iter()
        .zip(&scaled)
        .zip(pens)
        .filter(|((_, curve), _)| curve.len() > 1)
        .map(|((name, curve), pen)| (*name, &curve[..], *pen))
        .collect();
    let mut plot = panel.history(canvas, &label, data.t, &curves);
    let end = data.event.map(|event| (event, ending));
    panel.events(canvas, &mut plot, end.as_slice(), false);
    canvas.keep(plot);
}

/// Part of a prefix below which a panel has a smaller one than others of its unit.
const LEAST: f64 = 0.05;

/// Prefix of a quantity of this size: that of the largest of its unit, if that leaves few zeros.
fn unit(panels: &[StackQuantity<'_>], of: &StackQuantity<'_>, size: f64) -> (f64, &'static str) {
    let all = panels.iter().filter(|panel| panel.unit == of.unit).flat_map(|panel| panel.curves);
    let largest = all.flat_map(|curve| curve.iter()).fold(0.0, |most: f64, x| most.max(x.abs()));
    match largest > 0.0 && size >= LEAST * prefix(largest).0 {
        true => prefix(largest),
        false if size > 0.0 => prefix(size),
        false => (1.0, ""),
    }
}

/// The first is wide and black, the others thinner and coloured.
fn pen(i: usize) -> Pen {
    match i {
        0 => Pen::new(BLACK, 4.6),
        1 => Pen::series(0, 2.4),
        i => Pen::series(i - 1, 2.2),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_share_the_times_and_what_is_too_long_is_refused() {
        let t: Vec<f64> = (0..100).map(|i| 0.01 * f64::from(i)).collect();
        let wave: Vec<f64> = t.iter().map(|t| 2e5 * (30.0 * t).sin()).collect();
        let curves: [&[f64]; 2] = [&wave, &wave[..50]];
        let panels = [
            StackQuantity { name: "base shear", unit: "N", curves: &curves },
            StackQuantity { name: "moment", unit: "N m", curves: &curves },
        ];
        let stack = StackFigure {
            title: "Forces",
            t: &t,
            names: &["one", "two"],
            panels: &panels,
            event: None,
        };
        let sheet = draw(&stack).unwrap();
        assert_eq!(sheet.plots.len(), 2);
        assert!(sheet.svg.contains("base shear") && sheet.svg.contains("kN"));
        // one prefix for what is compared
        let small: Vec<f64> = wave.iter().map(|x| 1e-3 * x).collect();
        let of = |name| StackQuantity { name, unit: "N", curves: &curves };
        let panels = [of("base shear"), StackQuantity { curves: &[&small], ..of("damper") }];
        assert_eq!(unit(&panels, &panels[1], 200.0).1, "k");
        let tiny = [0.2];
        let panels = [of("base shear"), StackQuantity { curves: &[&tiny], ..of("damper") }];
        assert_eq!(unit(&panels, &panels[1], 0.2).1, "m");
        assert!(draw(&StackFigure { t: &t[..60], ..stack }).is_err());
    }

    /// Two quantities of other sizes, the smaller one at rest after 20 of 300 s, a slide: what is
    /// shown is a twelfth more than that, whatever comes of it later; of one that moves to the end,
    /// all.
    #[test]
    fn the_quiet_that_a_record_ends_in_is_left_out() {
        let t: Vec<f64> = (0..3001).map(|i| 0.1 * f64::from(i)).collect();
        let moved = |size: f64, until: f64| -> Vec<f64> {
            let at = |t: &f64| size * if *t < until { (5.0 * t).cos() } else { 0.3 };
            t.iter().map(at).collect()
        };
        let (one, other, long) = (moved(1.0, 8.0), moved(1e-3, 20.0), moved(1.0, 290.0));
        let event = Some(EventMark { time: 200.0, text: "predictable to t = 200 s" });
        let svg = |second: &[f64], n: Option<usize>| {
            let n_or_all = n.unwrap_or(t.len());
            let [one, second]: [&[f64]; 2] = [&one[..n_or_all], &second[..n_or_all]];
            let panels = [
                StackQuantity { name: "rotation", unit: "rad", curves: &[one] },
                StackQuantity { name: "drift", unit: "m", curves: &[second] },
            ];
            let figure = StackFigure {
                title: "History",
                t: &t[..n_or_all],
                names: &["one"],
                panels: &panels,
                event: event.filter(|_| n.is_none()),
            };
            match n {
                Some(_) => draw(&figure).unwrap().svg,
                None => draw_while_moving(&figure).unwrap().svg,
            }
        };
        // the last sample that moves, 199, with 8 % of it
        let shown = (199.0_f64 * 1.08).ceil() as usize + 2;
        assert!(svg(&other, None) == svg(&other, Some(shown)));
        assert!(svg(&long, None).contains("predictable to t = 200 s"));
        assert!(
            draw_while_moving(&StackFigure { title: "", t: &[], names: &[], panels: &[], event })
                .is_err()
        );
    }
}
