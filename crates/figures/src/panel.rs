//! A pair of axes: frame, grid, numbers, and curves that stay inside.

use plotters::style::text_anchor::{HPos, VPos};

use super::canvas::Canvas;
use super::lettering::Lettering;
use super::plot::{EventMark, Plot};
use super::scale::Scale;
use super::shape::PixelPoint;
use super::style::{AXIS, GREY, GRID, LABEL, NUMBER, Pen, SIDES};

/// Height of a row of words about an event, and size of a remark (pixel).
pub(crate) const ROW: f64 = 36.0;
const REMARK: f64 = 23.0;
/// Size below which no number of an axis is set (pixel).
const SMALLEST: f64 = 12.0;

/// Where a panel stands on the sheet (pixel).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PanelFrame {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl PanelFrame {
    /// The i-th of panels in one or two columns below `top`: as high, and with so much between two
    /// rows (pixel).
    pub(crate) fn of_rows(i: usize, columns: usize, top: f64, (height, gap): (f64, f64)) -> Self {
        let ((left, right), top) = (SIDES, top + (i / columns) as f64 * (height + gap));
        let middle = 0.5 * (left + right);
        let (left, right) = match (columns, i % 2) {
            (1, _) => (left, right),
            (_, 0) => (left, middle - 40.0),
            _ => (middle + 75.0, right),
        };
        Self { left, top, right, bottom: top + height }
    }

    /// Whether a point lies inside or on the edge.
    fn holds(&self, (x, y): PixelPoint) -> bool {
        x >= self.left && x <= self.right && y >= self.top && y <= self.bottom
    }
}

/// The cumulative distribution of sorted numbers, as a curve from the origin.
pub(crate) fn stairs(sorted: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (mut x, mut y) = (vec![0.0], vec![0.0]);
    for (i, &at) in sorted.iter().enumerate() {
        x.extend([at, at]);
        y.extend([i as f64, i as f64 + 1.0].map(|below| below / sorted.len() as f64));
    }
    (x, y)
}

/// Two axes in a frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Panel {
    pub frame: PanelFrame,
    pub x: Scale,
    pub y: Scale,
}

impl Panel {
    /// Where a pair of values stands (pixel).
    pub(crate) fn at(&self, x: f64, y: f64) -> PixelPoint {
        let PanelFrame { left, top, right, bottom } = self.frame;
        (left + self.x.share(x) * (right - left), bottom - self.y.share(y) * (bottom - top))
    }

    /// Where the nearest pair of values that the axes show stands (pixel).
    pub(crate) fn at_clamped(&self, x: f64, y: f64) -> PixelPoint {
        self.at(self.x.clamp(x), self.y.clamp(y))
    }

    /// Grid, axes, numbers and labels; no numbers below when there is no label for x, whose lines
    /// are set smaller where they are longer than the axis. `gutter` is
    /// the distance of the y label's middle from the axis (pixel); long numbers push it farther.
    pub(crate) fn axes(
        &self,
        canvas: &mut Canvas,
        x_label: Option<&str>,
        y_label: &str,
        gutter: f64,
    ) {
        let PanelFrame { left, top, right, bottom } = self.frame;
        let (grid, axis) = (Pen::new(GRID, 1.5), Pen::new(AXIS, 2.0));
        let number = Lettering::new(NUMBER);
        let (x_ticks, y_ticks) =
            (self.x.ticks(right - left, 110.0), self.y.ticks(bottom - top, 60.0));
        // numbers leave room for the label between them and the sheet's edge
        let length = |text: &str| number.length(text);
        let longest = y_ticks.iter().map(|tick| tick.label.as_str());
        let longest = longest.max_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or("");
        let tick_number = number.fitted(longest, left - 14.0 - 1.7 * LABEL, SMALLEST);
        // Whole pixels and a half: a thin upright line is sharp.
        let sharp = |x: f64| x.round() + 0.5;
        for tick in &x_ticks {
            let x = sharp(self.at(tick.value, self.y.low).0);
            let told = !tick.label.is_empty();
            if told {
                canvas.line(&[(x, top), (x, bottom)], grid);
            }
            canvas.line(&[(x, bottom), (x, bottom + if told { 8.0 } else { 4.0 })], axis);
        }
        for tick in &y_ticks {
            let y = sharp(self.at(self.x.low, tick.value).1);
            let told = !tick.label.is_empty();
            if told {
                canvas.line(&[(left, y), (right, y)], grid);
            }
            canvas.line(&[(left - if told { 8.0 } else { 4.0 }, y), (left, y)], axis);
            canvas.text((left - 14.0, y), &tick.label, tick_number.at(HPos::Right, VPos::Center));
        }
        canvas.line(&[(left, top), (left, bottom), (right, bottom)], axis);
        let label = Lettering::new(LABEL);
        let gutter = gutter.max(14.0 + tick_number.length(longest) + LABEL);
        // what stands at the sheet's edge is not cut there
        canvas.text(
            ((left - gutter).max(LABEL), (top + bottom) / 2.0),
            y_label,
            label.upwards().at(HPos::Center, VPos::Center),
        );
        if let Some(x_label) = x_label {
            for tick in &x_ticks {
                let x = self.at(tick.value, self.y.low).0;
                canvas.text((x, bottom + 17.0), &tick.label, number.at(HPos::Center, VPos::Top));
            }
            for (i, line) in x_label.lines().enumerate() {
                let label = label.fitted(line, right - left, 0.5 * LABEL);
                let y = bottom + 57.0 + ROW * i as f64;
                canvas.text(((left + right) / 2.0, y), line, label.at(HPos::Center, VPos::Top));
            }
        }
    }

    /// A curve through the pairs of values, cut at the frame; the shorter of the two slices counts.
    pub(crate) fn curve(&self, canvas: &mut Canvas, xs: &[f64], ys: &[f64], pen: Pen) {
        let points: Vec<PixelPoint> = xs.iter().zip(ys).map(|(&x, &y)| self.at(x, y)).collect();
        for piece in points
            .split(|p| !(p.0.is_finite() && p.1.is_finite()))
            .flat_map(|run| clip(&thin(run), self.frame))
        {
            canvas.line(&piece, pen);
        }
    }

    /// Curves over time, each with its name, and their numbers for a page that zooms; `label` is
    /// that of the axis.
    pub(crate) fn history(
        &self,
        canvas: &mut Canvas,
        label: &str,
        t: &[f64],
        curves: &[(&str, &[f64], Pen)],
    ) -> Plot {
        for (_, values, pen) in curves {
            match values {
                [constant] => self.level(canvas, *constant, *pen),
                _ => self.curve(canvas, t, values, *pen),
            }
        }
        Plot {
            frame: [self.frame.left, self.frame.top, self.frame.right, self.frame.bottom],
            x: [self.x.low, self.x.high],
            y: [self.y.low, self.y.high],
            logarithmic: self.y.logarithmic(),
            ..Plot::new(label, t, curves)
        }
    }

    /// Times at which something ends: a line each, and its words at the top of the panel if they
    /// are wanted.
    pub(crate) fn events(
        &self,
        canvas: &mut Canvas,
        plot: &mut Plot,
        events: &[(EventMark<'_>, Pen)],
        told: bool,
    ) {
        for (i, (event, pen)) in events.iter().enumerate() {
            self.upright(canvas, event.time, *pen);
            plot.events.push((event.time, event.text.into()));
            if !told {
                continue;
            }
            let how = Lettering::new(NUMBER).bold().colour(pen.rgb());
            let (x, length) = (self.at(event.time, self.y.low).0, how.length(event.text));
            let left = x - 14.0 - length > self.frame.left + 10.0;
            let (x, across) = if left { (x - 14.0, HPos::Right) } else { (x + 14.0, HPos::Left) };
            canvas.label(
                (x, self.frame.top + 12.0 + ROW * i as f64),
                event.text,
                how.at(across, VPos::Top),
            );
        }
    }

    /// A remark above the panel's upper right corner.
    pub(crate) fn remark(&self, canvas: &mut Canvas, text: &str) {
        let at = (self.frame.right, self.frame.top - 8.0);
        canvas.text(at, text, Lettering::new(REMARK).colour(GREY).at(HPos::Right, VPos::Bottom));
    }

    /// A straight line from edge to edge at a height.
    pub(crate) fn level(&self, canvas: &mut Canvas, y: f64, pen: Pen) {
        self.curve(canvas, &[self.x.low, self.x.high], &[y, y], pen);
    }

    /// A straight line from edge to edge at a place.
    pub(crate) fn upright(&self, canvas: &mut Canvas, x: f64, pen: Pen) {
        self.curve(canvas, &[x, x], &[self.y.low, self.y.high], pen);
    }
}

/// At most four points a pixel column: the first, the lowest, the highest and the last look the
/// same as all of them.
fn thin(points: &[PixelPoint]) -> Vec<PixelPoint> {
    let mut kept = Vec::with_capacity(points.len().min(8192));
    for column in points.chunk_by(|a, b| a.0.floor() == b.0.floor()) {
        if column.len() <= 4 {
            kept.extend_from_slice(column);
            continue;
        }
        let (mut low, mut high) = (0, 0);
        for (i, point) in column.iter().enumerate() {
            if point.1 < column[low].1 {
                low = i;
            }
            if point.1 > column[high].1 {
                high = i;
            }
        }
        let mut keep = [0, low, high, column.len() - 1];
        keep.sort_unstable();
        for (i, &at) in keep.iter().enumerate() {
            if i == 0 || at != keep[i - 1] {
                kept.push(column[at]);
            }
        }
    }
    kept
}

/// The pieces of a polyline inside a frame (Liang & Barsky 1984, segment by segment).
fn clip(points: &[PixelPoint], frame: PanelFrame) -> Vec<Vec<PixelPoint>> {
    let mut pieces: Vec<Vec<PixelPoint>> = Vec::new();
    let mut piece: Vec<PixelPoint> = Vec::new();
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let Some((from, to)) = inside(a, b, frame) else { continue };
        let along = |share: f64| (a.0 + share * (b.0 - a.0), a.1 + share * (b.1 - a.1));
        if from > 0.0 || piece.is_empty() {
            if piece.len() > 1 {
                pieces.push(std::mem::take(&mut piece));
            }
            piece = vec![along(from)];
        }
        piece.push(if to < 1.0 { along(to) } else { b });
        if to < 1.0 {
            pieces.push(std::mem::take(&mut piece));
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    if let [only] = points
        && frame.holds(*only)
    {
        pieces.push(vec![*only]);
    }
    pieces
}

/// The share of the segment from a to b at which it enters and leaves the frame.
fn inside(a: PixelPoint, b: PixelPoint, frame: PanelFrame) -> Option<(f64, f64)> {
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    let edges = [
        (a.0 - b.0, a.0 - frame.left),
        (b.0 - a.0, frame.right - a.0),
        (a.1 - b.1, a.1 - frame.top),
        (b.1 - a.1, frame.bottom - a.1),
    ];
    for (outward, room) in edges {
        if outward == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if outward > 0.0 {
            to = to.min(room / outward);
        } else {
            from = from.max(room / outward);
        }
    }
    if from <= to { Some((from, to)) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: PanelFrame = PanelFrame { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    #[test]
    fn a_curve_is_cut_where_it_leaves_and_enters() {
        let pieces = clip(&[(-5.0, 5.0), (5.0, 5.0), (5.0, 15.0), (8.0, 15.0), (8.0, 5.0)], FRAME);
        assert_eq!(
            pieces,
            [vec![(0.0, 5.0), (5.0, 5.0), (5.0, 10.0)], vec![(8.0, 10.0), (8.0, 5.0)]]
        );
        assert!(clip(&[(-5.0, -1.0), (20.0, -1.0)], FRAME).is_empty());
        assert_eq!(clip(&[(-5.0, -5.0), (15.0, 15.0)], FRAME), [vec![(0.0, 0.0), (10.0, 10.0)]]);
    }

    #[test]
    fn thinning_keeps_the_extremes_of_every_pixel_column() {
        let points: Vec<PixelPoint> = (0..100_000)
            .map(|i| (f64::from(i) * 1e-3, (f64::from(i) * 0.37).sin() * f64::from(i)))
            .collect();
        let kept = thin(&points);
        assert!(kept.len() <= 400);
        for column in 0..100 {
            let extremes = |points: &[PixelPoint]| {
                points
                    .iter()
                    .filter(|p| p.0.floor() == f64::from(column))
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| {
                        (low.min(p.1), high.max(p.1))
                    })
            };
            assert_eq!(extremes(&points), extremes(&kept));
        }
        assert_eq!((kept[0], kept[kept.len() - 1]), (points[0], points[points.len() - 1]));
    }
}
