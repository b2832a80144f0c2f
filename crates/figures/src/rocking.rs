//! Rocking spectra: peak rotation over 1/p and slenderness as a map. A panel a kind of body.

use plotters::style::RGBColor;

use super::canvas::Canvas;
use super::legend::{self, LegendEntry};
use super::panel::{Panel, PanelFrame};
use super::scale::Scale;
use super::style::SIDES;
use super::{Check, FigureError, Sheet};

const CHECK: Check = Check("rocking");

/// One body.
#[derive(Clone, Copy, Debug)]
pub struct RockingBody {
    /// 1/p (s).
    pub period: f64,
    /// (rad)
    pub alpha: f64,
    /// |theta|/alpha; infinite for a body that overturned, zero for one that was never lifted.
    pub peak: f64,
}

/// All bodies of one kind.
#[derive(Clone, Debug)]
pub struct Map {
    /// Its name.
    pub label: String,
    /// The bodies.
    pub bodies: Vec<RockingBody>,
}

/// What the figure shows.
#[derive(Clone, Copy, Debug)]
pub struct RockingFigure<'a> {
    /// First line: the head; further ones: remarks.
    pub title: &'a str,
    /// One a kind of body.
    pub maps: &'a [Map],
}

/// Upper ends of the steps of |theta|/alpha, and their colours, from light to dark: told apart in
/// print too.
const STEPS: [(f64, RGBColor); 6] = [
    (0.0, RGBColor(236, 236, 236)),
    (0.1, RGBColor(222, 235, 247)),
    (0.25, RGBColor(158, 202, 225)),
    (0.5, RGBColor(66, 146, 198)),
    (1.0, RGBColor(8, 81, 156)),
    (f64::MAX, RGBColor(74, 20, 134)),
];
const OVERTURNED: RGBColor = RGBColor(213, 94, 0);

fn colour(peak: f64) -> RGBColor {
    STEPS.iter().find(|(end, _)| peak <= *end).map_or(OVERTURNED, |(_, colour)| *colour)
}

/// Draw the figure.
///
/// # Errors
/// [`FigureError`] when there is nothing to draw, for numbers that are not finite.
pub fn draw(data: &RockingFigure<'_>) -> Result<Sheet, FigureError> {
    CHECK.least("maps", data.maps.len(), 1)?;
    for map in data.maps {
        CHECK.least("bodies", map.bodies.len(), 1)?;
        let numbers: Vec<f64> =
            map.bodies.iter().flat_map(|body| [body.period, body.alpha]).collect();
        CHECK.each("period and alpha", &numbers, |x| x.is_finite() && x > 0.0)?;
        let peaks: Vec<f64> = map.bodies.iter().map(|body| body.peak).collect();
        CHECK.each("peak", &peaks, |x| x >= 0.0)?;
    }
    let names =
        ["never lifted", "|θ|/α to 0.1", "to 0.25", "to 0.5", "to 1", "above 1", "overturned"];
    let colours = STEPS.iter().map(|(_, colour)| *colour).chain([OVERTURNED]);
    let entries: Vec<LegendEntry> = names
        .iter()
        .zip(colours)
        .map(|(name, colour)| LegendEntry::patch(*name, colour.into()))
        .collect();
    let (left, right) = SIDES;
    let rows = (620.0, 150.0);
    let mut canvas = Canvas::default();
    let top = legend::header(&mut canvas, data.title, &entries, left, right) + 20.0;
    for (i, map) in data.maps.iter().enumerate() {
        one(&mut canvas, map, PanelFrame::of_rows(i, 1, top, rows));
    }
    canvas.finish(top + data.maps.len() as f64 * (rows.0 + rows.1))
}

/// The different ones of some numbers, increasing.
fn different(numbers: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = numbers.collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| (*a / *b - 1.0).abs() < 1e-9);
    all
}

/// Where the i-th of increasing numbers begins and ends, half way to its neighbours.
fn edges(numbers: &[f64], i: usize) -> (f64, f64) {
    let half = |a: usize, b: usize| 0.5 * (numbers[b] - numbers[a]);
    let last = numbers.len() - 1;
    match (i, last) {
        (_, 0) => (0.95 * numbers[0], 1.05 * numbers[0]),
        (0, _) => (numbers[0] - half(0, 1), numbers[0] + half(0, 1)),
        (i, last) if i == last => (numbers[i] - half(i - 1, i), numbers[i] + half(i - 1, i)),
        (i, _) => (numbers[i] - half(i - 1, i), numbers[i] + half(i, i + 1)),
    }
}

fn one(canvas: &mut Canvas, map: &Map, frame: PanelFrame) {
    // even steps of ln(1/p)
    let periods = different(map.bodies.iter().map(|body| body.period));
    let logs: Vec<f64> = periods.iter().map(|x| x.ln()).collect();
    let alphas = different(map.bodies.iter().map(|body| body.alpha));
    let across = |i: usize| {
        let (from, to) = edges(&logs, i);
        if logs.len() == 1 {
            (0.95 * periods[0], 1.05 * periods[0])
        } else {
            (from.exp(), to.exp())
        }
    };
    let x = Scale::log(across(0).0, across(periods.len() - 1).1);
    let y = Scale::linear(edges(&alphas, 0).0, edges(&alphas, alphas.len() - 1).1);
    let panel = Panel { frame, x, y };
    panel.axes(canvas, Some(&format!("{}: 1/p [s]", map.label)), "α [rad]", 105.0);
    let near = |all: &[f64], x: f64| all.iter().position(|other| (other / x - 1.0).abs() < 1e-9);
    for body in &map.bodies {
        let (Some(i), Some(j)) = (near(&periods, body.period), near(&alphas, body.alpha)) else {
            continue;
        };
        let (from, to) = across(i);
        let (low, high) = edges(&alphas, j);
        canvas.block(panel.at(from, high), panel.at(to, low), colour(body.peak));
    }
}
