//! Displacement of the centre of mass against time: finite element against Housner, the paper's Figure 4.

use std::path::Path;

use plotters::style::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::{Canvas, Lettering};
use super::legend::{self, Entry};
use super::mark::{Mark, Shape};
use super::number::short;
use super::panel::{Frame, Panel};
use super::scale::Scale;
use super::style::{self, BLACK, NUMBER, Pen, WIDTH};
use super::{Check, FigureError};

const CHECK: Check = Check("history");
const LEFT: f64 = 150.0;
const RIGHT: f64 = WIDTH as f64 - 40.0;
const GUTTER: f64 = 112.0;
const MILLI: f64 = 1e3;

/// One model's history at the samples; it may end before the time axis does.
#[derive(Clone, Copy, Debug)]
pub struct Trace<'a> {
    /// Its name in the legend.
    pub label: &'a str,
    /// Horizontal displacement [m].
    pub u: &'a [f64],
    /// Vertical displacement [m], from the settled position.
    pub v: &'a [f64],
    /// Times of impact [s]; empty when they are not known.
    pub impacts: &'a [f64],
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct History<'a> {
    pub title: &'a str,
    /// Times of the samples, increasing [s].
    pub t: &'a [f64],
    /// Housner's history: black, under the others.
    pub reference: Trace<'a>,
    /// The finite element history, and those of other programs.
    pub others: &'a [Trace<'a>],
    /// A third panel: u of the others less u of the reference.
    pub differences: bool,
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for an empty or not finite slice, for a history longer than the time axis, and when `path` cannot be
/// written.
pub fn render(data: &History<'_>, path: &Path) -> Result<(), FigureError> {
    CHECK.least("t", data.t.len(), 2)?;
    CHECK.finite("t", data.t)?;
    let traces: Vec<(Trace<'_>, Pen)> = std::iter::once((data.reference, Pen::new(BLACK, 5.0)))
        .chain(data.others.iter().enumerate().map(|(i, trace)| (*trace, pen(i))))
        .collect();
    for (trace, _) in &traces {
        CHECK.least(trace.label, trace.u.len(), 1)?;
        if trace.u.len() > data.t.len() {
            let what = format!("u of {}", trace.label);
            return Err(FigureError::Length { figure: CHECK.0, what, found: trace.u.len(), wanted: data.t.len() });
        }
        CHECK.finite(&format!("u of {}", trace.label), trace.u)?;
        CHECK.column(&format!("v of {}", trace.label), trace.v, trace.u.len())?;
        CHECK.finite(&format!("impacts of {}", trace.label), trace.impacts)?;
    }

    let extra = if data.differences { 330.0 } else { 0.0 };
    let mut canvas = Canvas::new(WIDTH, 1130 + extra as usize);
    let mut entries: Vec<Entry> = traces.iter().map(|(trace, pen)| Entry::line(trace.label, *pen)).collect();
    if traces.iter().any(|(trace, _)| !trace.impacts.is_empty()) {
        entries.push(Entry::mark("impact", impact(BLACK)));
    }
    let top = legend::header(&mut canvas, data.title, &entries, LEFT, RIGHT);
    let x = Scale::linear(data.t[0], data.t[data.t.len() - 1]);
    let middle = top + 560.0;
    horizontal(&mut canvas, data.t, &traces, x, Frame { left: LEFT, top, right: RIGHT, bottom: middle });
    let frame = Frame { left: LEFT, top: middle + 34.0, right: RIGHT, bottom: 1030.0 };
    vertical(&mut canvas, data.t, &traces, x, frame, !data.differences);
    if data.differences {
        let frame = Frame { left: LEFT, top: 1064.0, right: RIGHT, bottom: 1030.0 + extra };
        differences(&mut canvas, data, x, frame);
    }
    canvas.save(path)
}

/// Thinner than the reference, which shows as a dark rim where both agree.
fn pen(i: usize) -> Pen {
    let pen = Pen::new(style::series(i), 2.4);
    if i == 0 { pen } else { pen.dashed() }
}

fn impact(colour: RGBColor) -> Mark {
    Mark::new(Shape::Triangle, 8.0, colour)
}

fn millimetres(values: &[f64]) -> Vec<f64> {
    values.iter().map(|x| x * MILLI).collect()
}

fn bounds<'a>(values: impl IntoIterator<Item = &'a [f64]>) -> (f64, f64) {
    values.into_iter().flatten().fold((0.0, 0.0), |(low, high), &x| (x.min(low), x.max(high)))
}

fn horizontal(canvas: &mut Canvas, t: &[f64], traces: &[(Trace<'_>, Pen)], x: Scale, frame: Frame) {
    let (low, high) = bounds(traces.iter().map(|(trace, _)| trace.u));
    let size = (high - low) * MILLI;
    // Room for the numbers of the peaks, and below for the rows of impacts.
    let rows = traces.iter().filter(|(trace, _)| !trace.impacts.is_empty()).count() as f64;
    let y = Scale::linear(low * MILLI - size * (0.13 + 0.05 * rows), high * MILLI + 0.13 * size);
    let panel = Panel { frame, x, y };
    panel.axes(canvas, None, "horizontal, u [mm]", GUTTER);
    panel.level(canvas, 0.0, Pen::new(style::AXIS, 1.5));
    for (trace, pen) in traces {
        panel.curve(canvas, t, &millimetres(trace.u), *pen);
    }
    peak(canvas, &panel, t, traces, |trace| trace.u, 1.0);
    peak(canvas, &panel, t, traces, |trace| trace.u, -1.0);
    let mut row = 0.0;
    for (trace, pen) in traces.iter().rev().filter(|(trace, _)| !trace.impacts.is_empty()) {
        let colour = RGBColor(pen.colour.0, pen.colour.1, pen.colour.2);
        for &time in trace.impacts.iter().filter(|time| **time >= x.low && **time <= x.high) {
            let at = panel.at(time, y.low);
            impact(colour).draw(canvas, (at.0, frame.bottom - 13.0 - 25.0 * row));
        }
        row += 1.0;
    }
}

fn vertical(canvas: &mut Canvas, t: &[f64], traces: &[(Trace<'_>, Pen)], x: Scale, frame: Frame, last: bool) {
    let (low, high) = bounds(traces.iter().map(|(trace, _)| trace.v));
    let size = (high - low) * MILLI;
    let panel = Panel { frame, x, y: Scale::linear(low * MILLI - 0.05 * size, high * MILLI + 0.22 * size) };
    panel.axes(canvas, if last { Some("time [s]") } else { None }, "vertical, v [mm]", GUTTER);
    panel.level(canvas, 0.0, Pen::new(style::AXIS, 1.5));
    for (trace, pen) in traces {
        panel.curve(canvas, t, &millimetres(trace.v), *pen);
    }
    peak(canvas, &panel, t, traces, |trace| trace.v, 1.0);
}

fn differences(canvas: &mut Canvas, data: &History<'_>, x: Scale, frame: Frame) {
    let differences: Vec<Vec<f64>> = data
        .others
        .iter()
        .map(|other| other.u.iter().zip(data.reference.u).map(|(a, b)| (a - b) * MILLI).collect())
        .collect();
    let (low, high) = bounds(differences.iter().map(Vec::as_slice));
    let size = high - low;
    let panel = Panel { frame, x, y: Scale::linear(low - 0.08 * size, high + 0.08 * size) };
    panel.axes(canvas, Some("time [s]"), &format!("Δu to {} [mm]", data.reference.label), GUTTER);
    panel.level(canvas, 0.0, Pen::new(style::AXIS, 1.5));
    for (i, difference) in differences.iter().enumerate() {
        panel.curve(canvas, data.t, difference, pen(i));
    }
}

/// Mark every model's extreme on one side, and tell them in one line beyond the outermost, where no curve can be.
fn peak<'a>(
    canvas: &mut Canvas,
    panel: &Panel,
    t: &[f64],
    traces: &[(Trace<'a>, Pen)],
    of: fn(&Trace<'a>) -> &'a [f64],
    side: f64,
) {
    let mut told: Vec<(String, RGBColor)> = Vec::new();
    let mut outermost: Option<(f64, f64)> = None;
    for (trace, pen) in traces {
        let colour = RGBColor(pen.colour.0, pen.colour.1, pen.colour.2);
        let values = of(trace);
        let best = (0..values.len()).fold(0, |best, i| if values[i] * side > values[best] * side { i } else { best });
        let value = values[best] * MILLI;
        if value * side <= 0.0 {
            continue;
        }
        if outermost.is_none_or(|(_, outer)| value * side > outer * side) {
            outermost = Some((t[best], value));
        }
        Mark::new(Shape::Disc, if told.is_empty() { 8.0 } else { 5.0 }, colour).draw(canvas, panel.at(t[best], value));
        told.push((short(value, if value.abs() < 100.0 { 3 } else { 4 }), colour));
    }
    let Some((time, value)) = outermost else { return };
    let lettering = Lettering::new(NUMBER).bold();
    let gap = 16.0;
    let length: f64 = told.iter().map(|(text, _)| lettering.length(text) + gap).sum::<f64>() - gap;
    let at = panel.at(time, value);
    let mut left = (at.0 - length / 2.0).clamp(panel.frame.left + 8.0, panel.frame.right - length - 4.0);
    for (text, colour) in told {
        let along = if side > 0.0 { VPos::Bottom } else { VPos::Top };
        canvas.text((left, at.1 - 17.0 * side), &text, lettering.colour(colour).at(HPos::Left, along));
        left += lettering.length(&text) + gap;
    }
}
