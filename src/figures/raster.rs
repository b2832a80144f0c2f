//! Pixels, painted with exact or analytic coverage: thin lines stay smooth without drawing at several times the size.
//!
//! Coordinates are in pixels, y downwards; the centre of the pixel (i, j) lies at (i + 1/2, j + 1/2). A stroke covers a
//! pixel by clamp(w/2 + 1/2 - d, 0, 1), with d the distance from the pixel's centre to the line and w its width; the
//! segments of one polyline are joined by the largest coverage, so that a transparent line shows no knots.

/// A point [pixel].
pub type Point = (f64, f64);

/// A colour and how much of it: red, green, blue and opacity 0..1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ink {
    pub rgb: (u8, u8, u8),
    pub alpha: f64,
}

/// An opaque picture of 8-bit red, green and blue, row by row from the top.
pub struct Raster {
    width: usize,
    height: usize,
    rgb: Vec<u8>,
    /// Coverage of the shape being painted; all zero between two shapes.
    mask: Vec<f32>,
    /// The pixels whose coverage is not zero.
    touched: Vec<usize>,
}

/// Rows or columns [from, to) of pixels.
type Span = (usize, usize);

impl Raster {
    /// A white picture.
    pub fn new(width: usize, height: usize) -> Self {
        Self { width, height, rgb: vec![255; width * height * 3], mask: vec![0.0; width * height], touched: Vec::new() }
    }

    /// Width and height [pixel].
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// The picture's bytes.
    pub fn rgb(&self) -> &[u8] {
        &self.rgb
    }

    /// Lay ink on one pixel; outside of the picture nothing happens.
    pub fn blend(&mut self, x: i64, y: i64, ink: Ink, coverage: f64) {
        if x < 0 || y < 0 || x >= self.width as i64 || y >= self.height as i64 {
            return;
        }
        let at = (y as usize * self.width + x as usize) * 3;
        mix(&mut self.rgb[at..at + 3], ink, coverage);
    }

    /// A polyline with round joins and ends, or a dot when all its points are one.
    pub fn stroke(&mut self, points: &[Point], width: f64, ink: Ink) {
        // A line thinner than a pixel is a pale line of one pixel.
        let ink = Ink { alpha: ink.alpha * width.min(1.0), ..ink };
        let reach = width.max(1.0) / 2.0 + 0.5;
        for pair in points.windows(2) {
            self.capsule(pair[0], pair[1], reach);
        }
        if let [only] = points {
            self.capsule(*only, *only, reach);
        }
        self.lay(ink);
    }

    /// A filled polygon (even-odd rule), each pixel covered by the area inside of it, to a fifth of a pixel in y.
    pub fn fill(&mut self, points: &[Point], ink: Ink) {
        const SLICES: usize = 5;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for &(_, y) in points {
            low = low.min(y);
            high = high.max(y);
        }
        let Some((top, bottom)) = span(low, high, self.height) else { return };
        let mut crossings: Vec<f64> = Vec::new();
        for row in top..bottom {
            for slice in 0..SLICES {
                let y = row as f64 + (slice as f64 + 0.5) / SLICES as f64;
                crossings.clear();
                for (i, &(x1, y1)) in points.iter().enumerate() {
                    let (x0, y0) = points[if i == 0 { points.len() - 1 } else { i - 1 }];
                    if (y0 <= y) != (y1 <= y) {
                        crossings.push(x0 + (x1 - x0) * (y - y0) / (y1 - y0));
                    }
                }
                crossings.sort_by(f64::total_cmp);
                for pair in crossings.chunks_exact(2) {
                    let Some((left, right)) = span(pair[0], pair[1], self.width) else { continue };
                    for x in left..right {
                        let covered = (pair[1].min(x as f64 + 1.0) - pair[0].max(x as f64)).max(0.0);
                        self.cover(row * self.width + x, |old| old + (covered / SLICES as f64) as f32);
                    }
                }
            }
        }
        self.lay(ink);
    }

    /// A filled circle, or its rim of the given width.
    pub fn circle(&mut self, centre: Point, radius: f64, rim: Option<f64>, ink: Ink) {
        let outer = radius + rim.unwrap_or(0.0) / 2.0 + 0.5;
        let Some((left, right)) = span(centre.0 - outer, centre.0 + outer, self.width) else { return };
        let Some((top, bottom)) = span(centre.1 - outer, centre.1 + outer, self.height) else { return };
        for y in top..bottom {
            for x in left..right {
                let d = (x as f64 + 0.5 - centre.0).hypot(y as f64 + 0.5 - centre.1) - radius;
                let coverage = match rim {
                    None => 0.5 - d,
                    Some(width) => width / 2.0 + 0.5 - d.abs(),
                };
                self.blend(x as i64, y as i64, ink, coverage.clamp(0.0, 1.0));
            }
        }
    }

    /// Add to the mask the pixels within `reach` of the segment from a to b.
    fn capsule(&mut self, a: Point, b: Point, reach: f64) {
        let Some((left, right)) = span(a.0.min(b.0) - reach, a.0.max(b.0) + reach, self.width) else { return };
        let Some((top, bottom)) = span(a.1.min(b.1) - reach, a.1.max(b.1) + reach, self.height) else { return };
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let length_squared = dx * dx + dy * dy;
        let half_row = if dy == 0.0 { 0.0 } else { reach * length_squared.sqrt() / dy.abs() };
        for row in top..bottom {
            let y = row as f64 + 0.5 - a.1;
            // On this row the endless line's band is all that can be covered: a long slanting line stays cheap.
            let (from, to) = if dy == 0.0 {
                (left, right)
            } else {
                let middle = a.0 + dx * y / dy;
                match span(middle - half_row, middle + half_row, self.width) {
                    Some((from, to)) => (from.max(left), to.min(right)),
                    None => continue,
                }
            };
            for column in from..to {
                let x = column as f64 + 0.5 - a.0;
                let along =
                    if length_squared == 0.0 { 0.0 } else { ((x * dx + y * dy) / length_squared).clamp(0.0, 1.0) };
                let (x, y) = (x - along * dx, y - along * dy);
                let coverage = (reach - (x * x + y * y).sqrt()).clamp(0.0, 1.0) as f32;
                self.cover(row * self.width + column, |old| old.max(coverage));
            }
        }
    }

    /// Change one pixel's coverage.
    fn cover(&mut self, at: usize, change: impl Fn(f32) -> f32) {
        let old = self.mask[at];
        let new = change(old);
        if old == 0.0 && new > 0.0 {
            self.touched.push(at);
        }
        self.mask[at] = new;
    }

    /// Lay ink through the mask and clear it.
    fn lay(&mut self, ink: Ink) {
        for at in self.touched.drain(..) {
            let coverage = std::mem::take(&mut self.mask[at]);
            mix(&mut self.rgb[at * 3..at * 3 + 3], ink, f64::from(coverage.min(1.0)));
        }
    }
}

/// The pixels that the interval from low to high touches, if any.
fn span(low: f64, high: f64, size: usize) -> Option<Span> {
    // `max` and `min` would drop a NaN.
    if low.is_nan() || high.is_nan() {
        return None;
    }
    let from = low.floor().max(0.0);
    let to = high.ceil().min(size as f64);
    if from < to { Some((from as usize, to as usize)) } else { None }
}

fn mix(pixel: &mut [u8], ink: Ink, coverage: f64) {
    let share = coverage * ink.alpha;
    for (old, new) in pixel.iter_mut().zip([ink.rgb.0, ink.rgb.1, ink.rgb.2]) {
        let mixed = f64::from(*old) + share * (f64::from(new) - f64::from(*old));
        *old = (mixed + 0.5) as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK: Ink = Ink { rgb: (0, 0, 0), alpha: 1.0 };

    /// The inked area [pixel], from the darkness of the picture.
    fn area(raster: &Raster) -> f64 {
        raster.rgb().iter().map(|&byte| f64::from(255 - byte)).sum::<f64>() / (3.0 * 255.0)
    }

    #[test]
    fn a_filled_triangle_covers_its_area() {
        let mut raster = Raster::new(100, 100);
        raster.fill(&[(10.3, 10.1), (80.7, 30.2), (40.9, 90.8)], BLACK);
        let exact = 0.5 * ((80.7 - 10.3) * (90.8 - 10.1) - (40.9 - 10.3) * (30.2 - 10.1));
        assert!((area(&raster) / exact - 1.0).abs() < 2e-3, "{} against {exact}", area(&raster));
    }

    #[test]
    fn a_disc_covers_pi_r_squared_and_a_rim_its_length_times_its_width() {
        let mut disc = Raster::new(100, 100);
        disc.circle((50.2, 49.7), 30.0, None, BLACK);
        assert!((area(&disc) / (std::f64::consts::PI * 900.0) - 1.0).abs() < 2e-3);
        let mut ring = Raster::new(100, 100);
        ring.circle((50.2, 49.7), 30.0, Some(3.0), BLACK);
        assert!((area(&ring) / (std::f64::consts::TAU * 90.0) - 1.0).abs() < 5e-3);
    }

    #[test]
    fn a_stroke_is_as_dark_as_it_is_long_and_wide_whatever_its_slope() {
        for end in [(90.5, 10.5), (90.5, 50.5), (60.5, 90.5), (10.5, 90.5)] {
            let mut raster = Raster::new(100, 100);
            raster.stroke(&[(10.5, 10.5), end], 3.0, BLACK);
            let length = (end.0 - 10.5).hypot(end.1 - 10.5);
            // The two round ends add a disc of the line's width.
            let exact = 3.0 * length + std::f64::consts::PI * 2.25;
            assert!((area(&raster) / exact - 1.0).abs() < 0.02, "{end:?}: {} against {exact}", area(&raster));
        }
    }

    #[test]
    fn shapes_outside_of_the_picture_or_without_a_number_do_no_harm() {
        let mut raster = Raster::new(20, 20);
        raster.stroke(&[(-50.0, -50.0), (-40.0, 1e300)], 3.0, BLACK);
        raster.stroke(&[(f64::NAN, 1.0), (5.0, f64::NAN)], 3.0, BLACK);
        raster.fill(&[(f64::NAN, 0.0), (100.0, 200.0), (300.0, 200.0)], BLACK);
        raster.circle((-100.0, 5.0), 3.0, None, BLACK);
        assert_eq!(area(&raster), 0.0);
    }
}
