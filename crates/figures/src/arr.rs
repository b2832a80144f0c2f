//! Amplitude response ratio against frequency ratio (equation 7 of the paper): target, fits, active
//! points.

use plotters::style::Color;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::lettering::Lettering;
use super::mark::{Mark, MarkShape};
use super::number::{brief, short};
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::{GREY, NUMBER, Pen, SIDES, SKY};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("arr");

/// A band of frequencies in which the target bounds the response.
#[derive(Clone, Copy, Debug)]
pub struct TargetBand {
    /// From and to, frequency ratio g.
    pub g: (f64, f64),
    /// Least ARR wanted, if any.
    pub at_least: Option<f64>,
    /// Largest ARR wanted, if any.
    pub at_most: Option<f64>,
}

/// A frequency at which the fit touches its bound.
#[derive(Clone, Copy, Debug)]
pub struct ActiveMark {
    /// Frequency ratio g.
    pub g: f64,
    /// Amplitude response ratio there.
    pub arr: f64,
    /// Its multiplier in the optimality conditions, told beside it; `None` tells nothing.
    pub multiplier: Option<f64>,
}

/// One spring-absorber unit's response.
#[derive(Clone, Copy, Debug)]
pub struct UnitCurve<'a> {
    /// In the legend.
    pub label: &'a str,
    /// Frequency ratios, increasing, greater than zero.
    pub g: &'a [f64],
    /// Amplitude response ratio at these frequencies.
    pub arr: &'a [f64],
    /// Where it touches its bounds.
    pub active: &'a [ActiveMark],
    /// Whether it is of the springs that were delivered: a full line; others are dashed.
    pub delivered: bool,
    /// Vertical and horizontal units have their own colours.
    pub horizontal: bool,
    /// The lowest cap that its kind of unit can keep, if that is what was wanted.
    pub cap: Option<f64>,
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct ResponseFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// What is wanted.
    pub target: &'a [TargetBand],
    /// The units.
    pub curves: &'a [UnitCurve<'a>],
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for an empty or not finite slice.
pub fn draw(data: &ResponseFigure<'_>) -> Result<Sheet, FigureError> {
    CHECK.least("curves", data.curves.len(), 1)?;
    for curve in data.curves {
        CHECK.least(curve.label, curve.g.len(), 2)?;
        CHECK.finite(&format!("g of {}", curve.label), curve.g)?;
        CHECK.column(&format!("ARR of {}", curve.label), curve.arr, curve.g.len())?;
        let active: Vec<f64> = curve.active.iter().flat_map(|a| [a.g, a.arr]).collect();
        CHECK.finite(&format!("active points of {}", curve.label), &active)?;
        CHECK.finite(&format!("cap of {}", curve.label), curve.cap.as_slice())?;
    }
    for band in data.target {
        let bounds = [band.at_least.unwrap_or(0.0), band.at_most.unwrap_or(0.0)];
        CHECK.finite("target", &[band.g.0, band.g.1, bounds[0], bounds[1]])?;
    }

    let mut canvas = Canvas::default();
    let mut entries: Vec<LegendEntry> = data
        .curves
        .iter()
        .map(|curve| {
            let pen = pen(curve);
            if curve.active.is_empty() {
                LegendEntry::line(curve.label, pen)
            } else {
                LegendEntry::both(curve.label, pen, dot(curve))
            }
        })
        .collect();
    if !data.target.is_empty() {
        entries.push(LegendEntry::patch("outside the target", SKY.mix(0.22)));
    }
    if data.curves.iter().flat_map(|curve| curve.active).any(|active| active.multiplier.is_some()) {
        let neutral = Mark::new(MarkShape::Disc, 9.0, GREY);
        entries.push(LegendEntry::mark("active, with multiplier", neutral));
    }
    let (left, right) = SIDES;
    let top = legend::header(&mut canvas, data.title, &entries, left, right);
    let panel = Panel {
        frame: PanelFrame { left, top, right, bottom: top + 750.0 },
        x: g_axis(data),
        y: arr_axis(data),
    };
    for band in data.target {
        shade(&mut canvas, &panel, band);
    }
    panel.axes(
        &mut canvas,
        Some("frequency ratio, g = ω/Ωₙ"),
        "amplitude response ratio, ARR",
        105.0,
    );
    for band in data.target {
        bound(&mut canvas, &panel, band);
    }
    lowest(&mut canvas, &panel, data.curves);
    for curve in data.curves {
        panel.curve(&mut canvas, curve.g, curve.arr, pen(curve));
    }
    for curve in data.curves {
        touches(&mut canvas, &panel, curve);
    }
    canvas.finish(top + 850.0)
}

fn pen(curve: &UnitCurve<'_>) -> Pen {
    let pen = |width| Pen::series(usize::from(curve.horizontal), width);
    if curve.delivered { pen(4.5) } else { pen(2.8).dashed() }
}

fn dot(curve: &UnitCurve<'_>) -> Mark {
    Mark::series(usize::from(curve.horizontal))
}

/// The least and the largest of numbers above zero.
fn range(all: impl Iterator<Item = f64>) -> (f64, f64) {
    all.filter(|x| *x > 0.0)
        .fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)))
}

fn g_axis(data: &ResponseFigure<'_>) -> Scale {
    let all = data.curves.iter().flat_map(|curve| curve.g).copied();
    let (low, high) = range(all);
    if high > 0.0 { Scale::log(low, high) } else { Scale::log(0.05, 20.0) }
}

/// The tails of the curves may fall for ever; four decades below the top are enough to see them go.
fn arr_axis(data: &ResponseFigure<'_>) -> Scale {
    let caps = data.target.iter().filter_map(|band| band.at_most);
    let all = data.curves.iter().flat_map(|curve| curve.arr).copied().chain(caps);
    let (low, high) = range(all);
    if high > 0.0 {
        Scale::log(low.max(high * 1e-4).min(high / 10.0), high * 2.2)
    } else {
        Scale::log(0.1, 10.0)
    }
}

/// Colour what the target forbids.
fn shade(canvas: &mut Canvas, panel: &Panel, band: &TargetBand) {
    let colour = SKY.mix(0.22);
    if let Some(most) = band.at_most {
        canvas.block(
            panel.at_clamped(band.g.0, panel.y.high),
            panel.at_clamped(band.g.1, most),
            colour,
        );
    }
    if let Some(least) = band.at_least {
        canvas.block(
            panel.at_clamped(band.g.0, least),
            panel.at_clamped(band.g.1, panel.y.low),
            colour,
        );
    }
}

/// The edge of what the target forbids; the cap tells its value.
fn bound(canvas: &mut Canvas, panel: &Panel, band: &TargetBand) {
    let pen = Pen::new(GREY, 2.0).dashed();
    let ends = [panel.x.clamp(band.g.0), panel.x.clamp(band.g.1)];
    if let Some(least) = band.at_least {
        panel.curve(canvas, &ends, &[least, least], pen);
    }
    let Some(most) = band.at_most else { return };
    panel.curve(canvas, &ends, &[most, most], pen);
    let at = panel.at(ends[0], panel.y.high);
    let how = Lettering::new(NUMBER).at(HPos::Left, VPos::Top);
    canvas.text((at.0 + 14.0, at.1 + 12.0), &format!("ARR ≤ {}", brief(most, 4)), how);
}

/// The lowest cap of every curve that has one, its value at the right; below its line where the
/// next cap is near above.
fn lowest(canvas: &mut Canvas, panel: &Panel, curves: &[UnitCurve<'_>]) {
    let caps = || curves.iter().filter_map(|curve| Some((curve, curve.cap?)));
    for (curve, cap) in caps() {
        let colour = pen(curve).rgb();
        panel.curve(
            canvas,
            &[panel.x.low, panel.x.high],
            &[cap, cap],
            Pen::new(colour, 1.6).dashed(),
        );
        let at = panel.at(panel.x.high, cap);
        let crowded = caps()
            .any(|(_, other)| (1.0..36.0).contains(&(at.1 - panel.at(panel.x.high, other).1)));
        let (y, along) =
            if crowded { (at.1 + 10.0, VPos::Top) } else { (at.1 - 10.0, VPos::Bottom) };
        let how = Lettering::new(NUMBER).colour(colour).at(HPos::Right, along);
        canvas.text((at.0 - 14.0, y), &format!("lowest cap {}", brief(cap, 4)), how);
    }
}

fn touches(canvas: &mut Canvas, panel: &Panel, curve: &UnitCurve<'_>) {
    for active in curve.active {
        // A point at g = 0 has no place on this axis: it stands at the left edge.
        let at = panel.at_clamped(active.g, active.arr);
        dot(curve).draw(canvas, at);
        let Some(multiplier) = active.multiplier else { continue };
        // Points close to each other tell their numbers to either side.
        let near = |other: &ActiveMark, side: f64| {
            let away = side * (panel.at_clamped(other.g, other.arr).0 - at.0);
            away > 0.0 && away < 100.0
        };
        let (across, shift) = if curve.active.iter().any(|other| near(other, 1.0)) {
            (HPos::Right, 14.0)
        } else if at.0 < panel.frame.left + 60.0
            || curve.active.iter().any(|other| near(other, -1.0))
        {
            (HPos::Left, if at.0 < panel.frame.left + 60.0 { 14.0 } else { -14.0 })
        } else {
            (HPos::Center, 0.0)
        };
        let how = Lettering::new(NUMBER).colour(pen(curve).rgb());
        // The first curve tells its multipliers above, the others below: both stay readable where
        // they touch together.
        let (y, along) =
            if !curve.horizontal { (at.1 - 22.0, VPos::Bottom) } else { (at.1 + 22.0, VPos::Top) };
        canvas.text((at.0 + shift, y), &short(multiplier, 2), how.at(across, along));
    }
}
