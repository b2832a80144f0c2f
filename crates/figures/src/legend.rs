//! Title and legend: above the panels or beside them, never over data.

use plotters::style::RGBAColor;
use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::Canvas;
use super::lettering::Lettering;
use super::mark::Mark;
use super::style::{LABEL, NUMBER, Pen, TITLE};

/// Size below which no line of a title is set (pixel).
const SMALLEST: f64 = 19.0;
/// Length of a sample of line (pixel).
const SAMPLE: f64 = 64.0;

/// One row of a legend: what is drawn, and what it means.
#[derive(Clone, Debug)]
pub(crate) struct LegendEntry {
    pub text: String,
    pub pen: Option<Pen>,
    pub mark: Option<Mark>,
    pub patch: Option<RGBAColor>,
}

impl LegendEntry {
    /// A line.
    pub(crate) fn line(text: impl Into<String>, pen: Pen) -> Self {
        Self { text: text.into(), pen: Some(pen), mark: None, patch: None }
    }

    /// A mark.
    pub(crate) fn mark(text: impl Into<String>, mark: Mark) -> Self {
        Self { text: text.into(), pen: None, mark: Some(mark), patch: None }
    }

    /// A line with marks on it.
    pub(crate) fn both(text: impl Into<String>, pen: Pen, mark: Mark) -> Self {
        Self { text: text.into(), pen: Some(pen), mark: Some(mark), patch: None }
    }

    /// A filled area.
    pub(crate) fn patch(text: impl Into<String>, colour: RGBAColor) -> Self {
        Self { text: text.into(), pen: None, mark: None, patch: Some(colour) }
    }

    fn sample(&self) -> f64 {
        if self.pen.is_some() || self.patch.is_some() { SAMPLE } else { 26.0 }
    }

    fn length(&self) -> f64 {
        self.sample() + 12.0 + Lettering::new(LABEL).length(&self.text)
    }

    /// Draw it with its left end and the middle of its height at the point.
    pub(crate) fn draw(&self, canvas: &mut Canvas, (x, y): (f64, f64)) {
        let sample = self.sample();
        if let Some(colour) = self.patch {
            canvas.block((x, y - 13.0), (x + sample, y + 13.0), colour);
        }
        if let Some(pen) = self.pen {
            canvas.line(&[(x, y), (x + sample, y)], pen);
        }
        if let Some(mark) = self.mark {
            mark.draw(canvas, (x + sample / 2.0, y));
        }
        canvas.text((x + sample + 12.0, y), &self.text, Lettering::new(LABEL));
    }
}

/// A title, and below it the legend in as many rows as it takes, from `left` to `right`; where the
/// figure may begin below them (pixel).
pub(crate) fn header(
    canvas: &mut Canvas,
    title: &str,
    entries: &[LegendEntry],
    left: f64,
    right: f64,
) -> f64 {
    let below = self::title(canvas, title, (left, right), 0.0);
    let (mut x, mut y) = (left, below + 8.0);
    for entry in entries {
        let length = entry.length();
        if x > left && x + length > right {
            (x, y) = (left, y + 42.0);
        }
        entry.draw(canvas, (x, y));
        x += length + 44.0;
    }
    if entries.is_empty() { below } else { y + 46.0 }
}

/// A title between `left` and `right` in a figure whose upper edge is at `y`, remarks below its
/// first line; their height (pixel).
pub(crate) fn title(canvas: &mut Canvas, title: &str, (left, right): (f64, f64), y: f64) -> f64 {
    let mut below = 52.0;
    for (i, line) in title.lines().enumerate() {
        let how = if i == 0 { Lettering::new(TITLE).bold() } else { Lettering::new(NUMBER) };
        let how = how.fitted(line, right - left, SMALLEST);
        below += if i == 0 { 0.0 } else { 37.0 };
        canvas.text((left, y + below), line, how.at(HPos::Left, VPos::Bottom));
    }
    below + 32.0
}

/// The legend in one column; its left end and the middle of its first row at the point.
pub(crate) fn column(canvas: &mut Canvas, entries: &[LegendEntry], (x, y): (f64, f64)) {
    for (i, entry) in entries.iter().enumerate() {
        entry.draw(canvas, (x, y + 44.0 * i as f64));
    }
}
