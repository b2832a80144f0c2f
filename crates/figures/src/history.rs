//! Displacement of the centre of mass against time: finite element against Housner, the paper's
//! Figure 4.

mod shown;

use plotters::style::RGBColor;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::lettering::Lettering;
use super::mark::{Mark, MarkShape};
use super::number::{prefix, short};
use super::panel::{Panel, PanelFrame, ROW};
use super::plot::{self, EventMark};
use super::scale::{Scale, around_zero};
use super::style::{self, BLACK, GREY, NUMBER, Pen, WIDTH};
use super::{Check, FigureError, Sheet};
use shown::shown;
pub(crate) use shown::{last_moving, with_margin};

const CHECK: Check = Check("history");
const LEFT: f64 = 150.0;
const RIGHT: f64 = WIDTH as f64 - 40.0;
const GUTTER: f64 = 112.0;
/// Displacements from here on are in millimetres, smaller ones in what suits them (m).
const MILLIMETRES: f64 = 1e-4;
/// No displacement is shown larger than at this scale (m).
const NOTHING: f64 = 1e-9;
/// An extreme so much smaller than what the panel shows is none.
const NOUGHT: f64 = 0.01;
/// Impacts nearer to each other than this are strokes: triangles would be a smear (pixel).
const CROWDED: f64 = 15.0;
/// A peak so much smaller than another model's is not told beside it.
const SMALL: f64 = 0.5;
/// How far beyond what stands a fall is shown.
const FALL: f64 = 0.6;

/// One model's history at the samples; it may end before the time axis does.
#[derive(Clone, Copy, Debug, Default)]
pub struct Trace<'a> {
    /// Its name in the legend.
    pub label: &'a str,
    /// Horizontal displacement (m).
    pub u: &'a [f64],
    /// Vertical displacement (m), from the settled position.
    pub v: &'a [f64],
    /// Times of impact (s); empty when they are not known.
    pub impacts: &'a [f64],
    /// When it overturned or ended; what follows is a fall, and shown in part.
    pub end: Option<EventMark<'a>>,
    /// Whether its peaks are told however small beside another's: those of another structure.
    pub answers: bool,
    /// Whether it only lies behind those that are compared: axes are theirs, and it is cut there.
    pub behind: bool,
}

impl<'a> Trace<'a> {
    /// Its first n samples.
    fn first(&self, n: usize) -> Trace<'a> {
        let of = |x: &'a [f64]| &x[..n.min(x.len())];
        Trace { u: of(self.u), v: of(self.v), ..*self }
    }

    /// How many of its samples come before its end: those that axes are made for.
    fn standing(&self, t: &[f64]) -> usize {
        if self.behind {
            return 0;
        }
        self.end.map_or(self.u.len(), |end| t.partition_point(|t| *t <= end.time)).min(self.u.len())
    }
}

/// What the figure shows.
#[derive(Clone, Copy, Debug, Default)]
pub struct HistoryFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// Times of the samples, increasing (s).
    pub t: &'a [f64],
    /// Housner's history: black, under the others.
    pub reference: Trace<'a>,
    /// The finite element history, and those of other programs.
    pub others: &'a [Trace<'a>],
    /// A third panel: u of the others less u of the reference.
    pub differences: bool,
    /// Up to when the histories can be foretold.
    pub foretold: Option<EventMark<'a>>,
}

/// A trace and how it is drawn.
type Drawn<'a> = (Trace<'a>, Pen);

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] for an empty or not finite slice, and for a history longer than the time axis.
pub fn draw(data: &HistoryFigure<'_>) -> Result<Sheet, FigureError> {
    check(data)?;
    let n = shown(data);
    let others: Vec<Trace> = data.others.iter().map(|trace| trace.first(n)).collect();
    let data = &HistoryFigure {
        t: &data.t[..n],
        reference: data.reference.first(n),
        others: &others,
        foretold: data.foretold.filter(|mark| mark.time <= data.t[n - 1]),
        ..*data
    };
    let traces: Vec<Drawn> = std::iter::once((data.reference, Pen::new(BLACK, 5.0)))
        .chain(data.others.iter().enumerate().map(|(i, trace)| (*trace, pen(i))))
        .collect();
    let mut canvas = Canvas::default();
    let mut entries: Vec<LegendEntry> =
        traces.iter().map(|(trace, pen)| LegendEntry::line(trace.label, *pen)).collect();
    if traces.iter().any(|(trace, _)| !trace.impacts.is_empty()) {
        entries.push(LegendEntry::mark("impact (a stroke where close)", impact(BLACK)));
    }
    let top = legend::header(&mut canvas, data.title, &entries, LEFT, RIGHT);
    let x = Scale::linear(data.t[0], data.t[data.t.len() - 1]);
    let frame = PanelFrame { left: LEFT, top, right: RIGHT, bottom: top + 560.0 };
    horizontal(&mut canvas, data, &traces, x, frame);
    let frame = PanelFrame { top: frame.bottom + 34.0, bottom: frame.bottom + 350.0, ..frame };
    vertical(&mut canvas, data, &traces, x, frame);
    let mut bottom = frame.bottom;
    if data.differences {
        let frame = PanelFrame { top: bottom + 34.0, bottom: bottom + 330.0, ..frame };
        differences(&mut canvas, data, x, frame);
        bottom = frame.bottom;
    }
    canvas.finish(bottom + 100.0)
}

fn check(data: &HistoryFigure<'_>) -> Result<(), FigureError> {
    CHECK.times(data.t)?;
    for trace in std::iter::once(&data.reference).chain(data.others) {
        CHECK.least(trace.label, trace.u.len(), 1)?;
        if trace.u.len() > data.t.len() {
            let what = format!("u of {}", trace.label);
            return Err(FigureError::Length {
                figure: CHECK.0,
                what,
                found: trace.u.len(),
                wanted: data.t.len(),
            });
        }
        CHECK.finite(&format!("u of {}", trace.label), trace.u)?;
        CHECK.column(&format!("v of {}", trace.label), trace.v, trace.u.len())?;
        CHECK.finite(&format!("impacts of {}", trace.label), trace.impacts)?;
    }
    Ok(())
}

/// Thinner than the reference, which shows as a dark rim where both agree.
fn pen(i: usize) -> Pen {
    let pen = Pen::series(i, 2.4);
    if i == 0 { pen } else { pen.dashed() }
}

fn impact(colour: RGBColor) -> Mark {
    Mark::new(MarkShape::Triangle, 8.0, colour)
}

/// A unit of length (m), and its name.
fn unit((low, high): (f64, f64)) -> (f64, String) {
    let size = high.max(-low);
    if size == 0.0 || size >= MILLIMETRES {
        return (1e-3, "mm".into());
    }
    let (unit, letter) = prefix(size);
    (unit, format!("{letter}m"))
}

/// The range of one quantity (m): of what stands, and as much of a fall as leaves that legible.
fn bounds<'a>(t: &[f64], traces: &[Drawn<'a>], of: fn(&Trace<'a>) -> &'a [f64]) -> (f64, f64) {
    let range = |all: bool| {
        let values = traces.iter().flat_map(|(trace, _)| {
            let n = if all { trace.u.len() } else { trace.standing(t) };
            of(trace)[..n].iter()
        });
        around_zero(values.copied())
    };
    let ((low, mut high), (least, mut most)) = (range(false), range(true));
    // what is smaller is rounding, and not to be magnified
    if high > low && high - low < NOTHING {
        (high, most) = (low + NOTHING, most.max(low + NOTHING));
    }
    let room = FALL * (high - low).max(f64::MIN_POSITIVE);
    (least.max(low - room), most.min(high + room))
}

/// Where histories end, and up to when they can be foretold.
fn ends<'a>(data: &HistoryFigure<'a>, traces: &[Drawn<'a>]) -> Vec<(EventMark<'a>, Pen)> {
    let foretold = data.foretold.map(|mark| (mark, Pen::new(GREY, 2.4).dashed()));
    let end = |(trace, pen): &Drawn<'a>| Some((trace.end?, Pen { width: 2.4, ..pen.dashed() }));
    foretold.into_iter().chain(traces.iter().filter_map(end)).collect()
}

/// The curves of one quantity, and where they end.
fn curves<'a>(
    canvas: &mut Canvas,
    panel: &Panel,
    label: &str,
    data: &HistoryFigure<'_>,
    traces: &[Drawn<'a>],
    (of, unit): (fn(&Trace<'a>) -> &'a [f64], f64),
    told: bool,
) -> plot::Plot {
    panel.level(canvas, 0.0, Pen::new(style::AXIS, 1.5));
    let values: Vec<Vec<f64>> =
        traces.iter().map(|(trace, _)| of(trace).iter().map(|x| x / unit).collect()).collect();
    let named: Vec<(&str, &[f64], Pen)> = traces
        .iter()
        .zip(&values)
        .map(|((trace, pen), values)| (trace.label, values.as_slice(), *pen))
        .collect();
    let mut plot = panel.history(canvas, label, data.t, &named);
    let ends: Vec<(EventMark, Pen)> = ends(data, traces);
    panel.events(canvas, &mut plot, &ends, told);
    plot
}

fn horizontal(
    canvas: &mut Canvas,
    data: &HistoryFigure<'_>,
    traces: &[Drawn<'_>],
    x: Scale,
    frame: PanelFrame,
) {
    let t = data.t;
    let (low, high) = bounds(t, traces, |trace| trace.u);
    let (unit, name) = unit((low, high));
    let (low, high, label) = (low / unit, high / unit, format!("horizontal, u [{name}]"));
    let size = high - low;
    // Room for the numbers of the peaks and the words about ends, and below for the rows of impacts
    // [pixel].
    let rows = traces.iter().filter(|(trace, _)| !trace.impacts.is_empty()).count() as f64;
    let ends = ends(data, traces).len() as f64;
    let (above, below) = (52.0 + ROW * ends, 52.0 + 25.0 * rows);
    let pixel = size / (frame.bottom - frame.top - above - below);
    let panel = Panel { frame, x, y: Scale::linear(low - below * pixel, high + above * pixel) };
    panel.axes(canvas, None, &label, GUTTER);
    let mut plot = curves(canvas, &panel, &label, data, traces, (|trace| trace.u, unit), true);
    peak(canvas, &panel, t, traces, (|trace| trace.u, unit), 1.0);
    peak(canvas, &panel, t, traces, (|trace| trace.u, unit), -1.0);
    let impacting = traces.iter().rev().filter(|(trace, _)| !trace.impacts.is_empty());
    for (row, (trace, pen)) in impacting.enumerate() {
        let times: Vec<f64> =
            trace.impacts.iter().copied().filter(|t| (x.low..=x.high).contains(t)).collect();
        plot.marks.push(plot::Marks::new(&times, *pen));
        let places: Vec<f64> = times.iter().map(|&time| panel.at(time, 0.0).0).collect();
        let y = frame.bottom - 13.0 - 25.0 * row as f64;
        for (i, &place) in places.iter().enumerate() {
            let near = places[i.saturating_sub(1)..(i + 2).min(places.len())]
                .windows(2)
                .any(|p| p[1] - p[0] < CROWDED);
            if !near {
                impact(pen.rgb()).draw(canvas, (place, y));
            } else if i == 0 || place.round() != places[i - 1].round() {
                canvas
                    .line(&[(place, y - 9.0), (place, y + 6.0)], Pen { width: 2.0, ..*pen }.full());
            }
        }
    }
    canvas.keep(plot);
}

fn vertical(
    canvas: &mut Canvas,
    data: &HistoryFigure<'_>,
    traces: &[Drawn<'_>],
    x: Scale,
    frame: PanelFrame,
) {
    let (t, last) = (data.t, !data.differences);
    let (low, high) = bounds(t, traces, |trace| trace.v);
    let (unit, name) = unit((low, high));
    let (low, high, label) = (low / unit, high / unit, format!("vertical, v [{name}]"));
    let size = high - low;
    let panel = Panel { frame, x, y: Scale::linear(low - 0.05 * size, high + 0.22 * size) };
    panel.axes(canvas, if last { Some("time [s]") } else { None }, &label, GUTTER);
    let plot = curves(canvas, &panel, &label, data, traces, (|trace| trace.v, unit), false);
    peak(canvas, &panel, t, traces, (|trace| trace.v, unit), 1.0);
    canvas.keep(plot);
}

fn differences(canvas: &mut Canvas, data: &HistoryFigure<'_>, x: Scale, frame: PanelFrame) {
    let differences: Vec<Vec<f64>> = data
        .others
        .iter()
        .map(|other| other.u.iter().zip(data.reference.u).map(|(a, b)| (a - b) / 1e-3).collect())
        .collect();
    let (low, high) = around_zero(differences.iter().flatten().copied());
    let size = high - low;
    let panel = Panel { frame, x, y: Scale::linear(low - 0.08 * size, high + 0.08 * size) };
    let label = format!("Δu to {} [mm]", data.reference.label);
    panel.axes(canvas, Some("time [s]"), &label, GUTTER);
    panel.level(canvas, 0.0, Pen::new(style::AXIS, 1.5));
    let named: Vec<(&str, &[f64], Pen)> = data
        .others
        .iter()
        .zip(&differences)
        .enumerate()
        .map(|(i, (o, d))| (o.label, d.as_slice(), pen(i)))
        .collect();
    let plot = panel.history(canvas, &label, data.t, &named);
    canvas.keep(plot);
}

/// Mark every model's extreme on one side, and tell them in one line beyond the outermost, where no
/// curve can be; a small one of another structure beside its own mark. What only a fall reaches is
/// no peak.
fn peak<'a>(
    canvas: &mut Canvas,
    panel: &Panel,
    t: &[f64],
    traces: &[Drawn<'a>],
    (of, unit): (fn(&Trace<'a>) -> &'a [f64], f64),
    side: f64,
) {
    let least = NOUGHT * (panel.y.high - panel.y.low);
    let peak_of = |(trace, pen): &Drawn<'a>| {
        let standing = trace.standing(t);
        let values = &of(trace)[..standing];
        let best = (0..values.len())
            .fold(0, |best, i| if values[i] * side > values[best] * side { i } else { best });
        let value = values.get(best).map_or(0.0, |x| x / unit);
        let falls = trace.end.is_some() && best + 2 >= standing;
        (value * side > least && !falls)
            .then(|| (trace.answers, DrawnPeak { time: t[best], value, colour: pen.rgb() }))
    };
    let peaks: Vec<(bool, DrawnPeak)> = traces.iter().filter_map(peak_of).collect();
    let further = |a: &&DrawnPeak, b: &&DrawnPeak| a.value.abs().total_cmp(&b.value.abs());
    let Some(outermost) = peaks.iter().map(|(_, peak)| peak).max_by(further) else { return };
    let large = |peak: &DrawnPeak| peak.value.abs() >= SMALL * outermost.value.abs();
    let together: Vec<&DrawnPeak> =
        peaks.iter().map(|(_, peak)| peak).filter(|p| large(p)).collect();
    tell(canvas, panel, outermost, &together, side);
    for (_, peak) in peaks.iter().filter(|(answers, peak)| *answers && !large(peak)) {
        tell(canvas, panel, peak, &[peak], side);
    }
}

/// A model's extreme: when (s), its value in the panel's unit, its colour.
struct DrawnPeak {
    time: f64,
    value: f64,
    colour: RGBColor,
}

/// Marks of peaks, and their numbers in one line beyond one of them.
fn tell(canvas: &mut Canvas, panel: &Panel, beyond: &DrawnPeak, peaks: &[&DrawnPeak], side: f64) {
    let mut told: Vec<(String, RGBColor)> = Vec::new();
    for &&DrawnPeak { time, value, colour } in peaks {
        let radius = if told.is_empty() { 8.0 } else { 5.0 };
        Mark::new(MarkShape::Disc, radius, colour).draw(canvas, panel.at(time, value));
        told.push((short(value, if value.abs() < 100.0 { 3 } else { 4 }), colour));
    }
    let lettering = Lettering::new(NUMBER).bold();
    let gap = 16.0;
    let length: f64 = told.iter().map(|(text, _)| lettering.length(text) + gap).sum::<f64>() - gap;
    let at = panel.at(beyond.time, beyond.value);
    let mut left =
        (at.0 - length / 2.0).clamp(panel.frame.left + 8.0, panel.frame.right - length - 4.0);
    for (text, colour) in told {
        let along = if side > 0.0 { VPos::Bottom } else { VPos::Top };
        canvas.text(
            (left, at.1 - 17.0 * side),
            &text,
            lettering.colour(colour).at(HPos::Left, along),
        );
        left += lettering.length(&text) + gap;
    }
}

#[cfg(test)]
mod tests;
