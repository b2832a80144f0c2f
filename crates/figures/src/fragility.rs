//! Probabilities of exceedance against measures of intensity: fits, their bounds, what was
//! observed. Two panels a row.

use plotters::style::Color;

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::mark::{Mark, MarkShape};
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::{self, Pen, SIDES};
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("fragility");

/// One fitted curve and its bounds at the same intensities.
#[derive(Clone, Debug)]
pub struct FragilityCurve {
    /// Which entry of the legend it is.
    pub entry: usize,
    /// Intensities.
    pub x: Vec<f64>,
    /// Probability of exceedance at each.
    pub probability: Vec<f64>,
    /// Lower bound of it.
    pub low: Vec<f64>,
    /// Upper bound of it.
    pub high: Vec<f64>,
    /// Intensity and share of histories.
    pub observed: Vec<(f64, f64)>,
}

/// One measure of intensity.
#[derive(Clone, Debug)]
pub struct MeasurePanel {
    /// Name and unit of the measure.
    pub label: String,
    /// One a structure and limit state.
    pub curves: Vec<FragilityCurve>,
    /// Words above the panel.
    pub remark: &'static str,
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct FragilityFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// The legend, in the order of the curves.
    pub entries: &'a [String],
    /// The panels.
    pub measures: &'a [MeasurePanel],
    /// Of the vertical axis.
    pub probability_label: &'a str,
}

/// Height of a panel, and the distance between two rows (pixel).
const HEIGHT: f64 = 480.0;
const GAP: f64 = 130.0;

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] when there is nothing to draw, for numbers that are not finite.
pub fn draw(data: &FragilityFigure<'_>) -> Result<Sheet, FigureError> {
    CHECK.least("measures", data.measures.len(), 1)?;
    for measure in data.measures {
        for curve in &measure.curves {
            CHECK.finite(&measure.label, &curve.x)?;
            for column in [&curve.probability, &curve.low, &curve.high] {
                CHECK.column(&measure.label, column, curve.x.len())?;
            }
        }
    }
    let rows = data.measures.len().div_ceil(2);
    let entries: Vec<LegendEntry> = data
        .entries
        .iter()
        .enumerate()
        .map(|(i, name)| LegendEntry::both(name.as_str(), pen(i), dot(i)))
        .collect();
    let (left, right) = SIDES;
    let mut canvas = Canvas::default();
    let top = legend::header(&mut canvas, data.title, &entries, left, right);
    let height = top + rows as f64 * (HEIGHT + GAP);
    for (i, measure) in data.measures.iter().enumerate() {
        let frame = PanelFrame::of_rows(i, 2, top, (HEIGHT, GAP));
        one(&mut canvas, data, measure, frame, i % 2 == 0);
    }
    canvas.finish(height)
}

fn pen(i: usize) -> Pen {
    Pen::series(i, 3.5)
}

fn dot(i: usize) -> Mark {
    Mark::new(MarkShape::Disc, 5.5, style::series(i))
}

fn one(
    canvas: &mut Canvas,
    data: &FragilityFigure<'_>,
    measure: &MeasurePanel,
    frame: PanelFrame,
    labelled: bool,
) {
    let x = Scale::log_around(measure.curves.iter().flat_map(|curve| curve.x.iter().copied()), 2.0);
    let panel = Panel { frame, x, y: Scale::linear(0.0, 1.02) };
    panel.axes(
        canvas,
        Some(&measure.label),
        if labelled { data.probability_label } else { "" },
        95.0,
    );
    panel.remark(canvas, measure.remark);
    for curve in &measure.curves {
        let edge = |p: &[f64]| -> Vec<_> {
            curve.x.iter().zip(p).map(|(x, p)| panel.at_clamped(*x, *p)).collect()
        };
        let mut band = edge(&curve.low);
        band.extend(edge(&curve.high).into_iter().rev());
        canvas.fill(&band, style::series(curve.entry).mix(0.18));
    }
    for curve in &measure.curves {
        for (x, share) in &curve.observed {
            if (panel.x.low..=panel.x.high).contains(x) {
                dot(curve.entry).draw(canvas, panel.at(*x, *share));
            }
        }
        panel.curve(canvas, &curve.x, &curve.probability, pen(curve.entry));
    }
}
