//! By how much a response exceeds the target: one curve over g for each band and side, and the
//! curve's peaks.
//!
//! ```text
//!  psi(g; z) = w [ s ( ln ARR(g; z) - ref ) - ln limit ],   z = (ln K, ln C),   t(z) = max over curves and g of psi
//! ```
//!
//! At a peak inside its band g follows z (d psi/du = 0, u = ln g), and the peak's value phi(z) has
//! by the implicit function theorem the gradient psi_z and the Hessian psi_zz - psi_zu psi_uz /
//! psi_uu.

use nalgebra::{Matrix2, SVector, Vector2, vector};
use num_dual::{Dual2SVec64, DualNum, first_derivative, hessian, second_derivative};

use crate::response::Response;
use crate::target::{BandKind, Target};
use rocking::scalar::{Scalar, real};

/// The searched parameters z = (ln K, ln C). At fixed mu, ln f and ln xi are half of the first and
/// the second, plus constants; K and C keep a size near one for every mu.
pub(crate) type SearchParameters = Vector2<f64>;

/// The response of mass ratio mu at parameters z.
pub(crate) fn response<S: Scalar>(mu: f64, z: &SVector<S, 2>) -> Response<S> {
    Response { mu: real(mu), k: z[0].exp(), c: z[1].exp() }
}

/// One side of one band.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoundSide {
    /// The band's number, from 0.
    pub band: usize,
    kind: BandKind,
    /// +1 where ARR must stay below, -1 where it must stay above.
    pub side: f64,
    weight: f64,
    ln_limit: f64,
    g_low: f64,
    g_high: f64,
}

/// The curve at one g: an end of its band, or a peak inside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExcessPoint {
    /// Which curve, from 0.
    pub curve: usize,
    /// Frequency ratio; zero and infinity are possible at ends.
    pub g: f64,
    /// A peak inside the band, which moves with z; else an end, which does not.
    pub inside: bool,
    /// psi.
    pub value: f64,
}

/// What a point's value does when z moves: value, gradient and Hessian by z.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QuadraticModel {
    /// psi.
    pub value: f64,
    /// d phi/dz.
    pub slope: Vector2<f64>,
    /// d2 phi/dz2.
    pub curvature: Matrix2<f64>,
}

/// The curves of a target, in the order of its bands, above before below.
pub(crate) fn curves(target: &Target) -> Vec<BoundSide> {
    let mut curves = Vec::new();
    for (index, band) in target.bands.iter().enumerate() {
        let (sides, ln_limit): (&[f64], _) = match band.kind {
            BandKind::Cap | BandKind::RollOff => (&[1.0], band.limit.ln()),
            BandKind::Uniform | BandKind::Rigid => (&[1.0, -1.0], band.limit.ln_1p()),
        };
        curves.extend(sides.iter().map(|&side| BoundSide {
            band: index,
            kind: band.kind,
            side,
            weight: band.weight,
            ln_limit,
            g_low: band.g_low,
            g_high: band.g_high.unwrap_or(f64::INFINITY),
        }));
    }
    curves
}

impl BoundSide {
    /// psi at a finite g of a response.
    pub(crate) fn excess<S: Scalar>(&self, g: S, response: &Response<S>) -> S {
        let ln_arr = response.arr(g).ln();
        let above = match self.kind {
            BandKind::Cap => ln_arr,
            BandKind::RollOff => ln_arr + g.ln() * real::<S>(2.0),
            BandKind::Uniform => (ln_arr - response.at_zero().ln()) * real::<S>(self.side),
            BandKind::Rigid => ln_arr * real::<S>(self.side),
        };
        (above - real::<S>(self.ln_limit)) * real::<S>(self.weight)
    }

    /// g held inside the band, with the derivative of where it is held.
    pub(crate) fn clamp<S: Scalar>(&self, g: S) -> S {
        if g.re() < self.g_low {
            real(self.g_low)
        } else if g.re() > self.g_high {
            real(self.g_high)
        } else {
            g
        }
    }

    /// psi at an end of the band; where g is infinite ARR g^2 = 1 for every z, and ARR = 0.
    fn at_end(&self, g: f64, response: &Response<f64>) -> f64 {
        match (g.is_infinite(), self.kind) {
            (false, _) => self.excess(g, response),
            (true, BandKind::RollOff) => -self.weight * self.ln_limit,
            (true, _) => f64::NEG_INFINITY,
        }
    }

    /// The ends of the band and every peak inside it, in the order of g, for mass ratio mu at z.
    ///
    /// Peaks are bracketed by the sign of d psi/du on a grid that holds the response's own corner
    /// frequencies, so a resonance however sharp is not stepped over, and found to rounding by
    /// Newton's method.
    fn points(&self, index: usize, mu: f64, z: &SearchParameters, out: &mut Vec<ExcessPoint>) {
        let response = response(mu, z);
        let end = |g: f64| ExcessPoint {
            curve: index,
            g,
            inside: false,
            value: self.at_end(g, &response),
        };
        out.push(end(self.g_low));
        let mut left: Option<f64> = None;
        for g in self.grid(&response) {
            let u = g.ln();
            if self.slope(u, mu, z) > 0.0 {
                left = Some(u);
            } else if let Some(from) = left.take() {
                let g = self.peak(from, u, mu, z).exp();
                out.push(ExcessPoint {
                    curve: index,
                    g,
                    inside: true,
                    value: self.excess(g, &response),
                });
            }
        }
        if self.g_high.is_finite() || self.kind == BandKind::RollOff {
            out.push(end(self.g_high));
        }
    }

    fn grid(&self, response: &Response<f64>) -> Vec<f64> {
        /// Between corner frequencies ARR is smooth on the scale of an octave.
        const PER_DECADE: f64 = 24.0;
        /// Steps from one corner to the next.
        const BETWEEN: usize = 8;
        let ([p, q], [r, s]) = (response.fixed_points(), response.resonances());
        // without damping, with any damping, with m2 locked to the ground
        let mut corners = [p, q, r, s, 1.0];
        corners.sort_by(f64::total_cmp);
        let (first, last) = (corners[0], corners[4]);
        // a thousandth below and above the corners ARR is at its limits to a millionth
        let low = self.g_low.max(1e-3 * first);
        let high = self.g_high.min(1e3 * last).max(low);
        let steps = ((high / low).log10() * PER_DECADE).ceil().max(8.0);
        let mut grid: Vec<f64> =
            (0..=steps as usize).map(|i| low * (high / low).powf(i as f64 / steps)).collect();
        // at large mu the corners, and the peaks among them, crowd around g = 1
        for pair in corners.windows(2) {
            grid.extend(
                (0..=BETWEEN).map(|i| pair[0] + (pair[1] - pair[0]) * i as f64 / BETWEEN as f64),
            );
        }
        // both ends exactly, not a rounding short of them: a peak just inside an end is bracketed
        // by it
        grid.retain(|&g| g > low && g < high);
        grid.extend([low, high]);
        grid.sort_by(f64::total_cmp);
        grid
    }

    fn slope(&self, u: f64, mu: f64, z: &SearchParameters) -> f64 {
        first_derivative(|u| self.excess(u.exp(), &response(mu, &z.map(real))), u).1
    }

    /// The u between `a` (rising) and `b` (not rising) where d psi/du = 0.
    fn peak(&self, mut a: f64, mut b: f64, mu: f64, z: &SearchParameters) -> f64 {
        let mut u = 0.5 * (a + b);
        for _ in 0..100 {
            let (_, first, second) =
                second_derivative(|u| self.excess(u.exp(), &response(mu, &z.map(real))), u);
            if first > 0.0 {
                a = u;
            } else {
                b = u;
            }
            let newton = u - first / second;
            let next = if newton > a && newton < b { newton } else { 0.5 * (a + b) };
            // a step of two roundings of u (of order one) is the end
            let done = (next - u).abs() <= 4.0 * f64::EPSILON * u.abs().max(1.0);
            u = next;
            if done {
                break;
            }
        }
        u
    }

    /// The second-order model of a point of this curve.
    pub(crate) fn model(
        &self,
        point: &ExcessPoint,
        mu: f64,
        z: &SearchParameters,
    ) -> QuadraticModel {
        if point.g.is_infinite() {
            return QuadraticModel {
                value: point.value,
                slope: Vector2::zeros(),
                curvature: Matrix2::zeros(),
            };
        }
        if !point.inside {
            let at = |z: SVector<Dual2SVec64<2>, 2>| self.excess(real(point.g), &response(mu, &z));
            let (_, slope, curvature) = hessian(at, z);
            return QuadraticModel { value: point.value, slope, curvature };
        }
        let at = |v: SVector<Dual2SVec64<3>, 3>| {
            self.excess(v[2].exp(), &response(mu, &vector![v[0], v[1]]))
        };
        let (_, slope, second) = hessian(at, &vector![z[0], z[1], point.g.ln()]);
        let (slope, cross) =
            (slope.fixed_rows::<2>(0).into_owned(), second.fixed_view::<2, 1>(0, 2).into_owned());
        // psi_uu < 0 at a peak; one that is about to vanish (psi_uu -> 0) keeps a finite, convex
        // model
        let bend = second[(2, 2)].min(-1e-9);
        let curvature = second.fixed_view::<2, 2>(0, 0) - cross * cross.transpose() / bend;
        QuadraticModel { value: point.value, slope, curvature }
    }
}

/// Every end and peak of every curve.
pub(crate) fn points(curves: &[BoundSide], mu: f64, z: &SearchParameters) -> Vec<ExcessPoint> {
    let mut out = Vec::new();
    for (index, curve) in curves.iter().enumerate() {
        curve.points(index, mu, z, &mut out);
    }
    out
}

/// t(z): the largest excess of these points.
pub(crate) fn largest(points: &[ExcessPoint]) -> f64 {
    points.iter().fold(f64::NEG_INFINITY, |t, point| t.max(point.value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::target::Band;

    fn bands() -> Vec<BoundSide> {
        let band = |g_low, g_high, kind| Band { g_low, g_high, kind, limit: 0.5, weight: 2.0 };
        curves(&Target {
            bands: vec![
                band(0.0, None, BandKind::Cap),
                band(0.0, Some(0.9), BandKind::Uniform),
                band(0.1, Some(3.0), BandKind::Rigid),
                band(0.8, None, BandKind::RollOff),
            ],
        })
    }

    /// mu, z over the search range: damping from next to nothing to locked.
    fn designs() -> impl Iterator<Item = (f64, SearchParameters)> {
        [1e-3, 0.2, 3.0, 100.0].into_iter().flat_map(|mu| {
            [-4.0, -0.7, 1.0, 4.6].into_iter().flat_map(move |ln_k| {
                [-5.0, -1.0, 0.6, 3.0, 7.0]
                    .into_iter()
                    .map(move |ln_c| (mu, Vector2::new(ln_k, ln_c)))
            })
        })
    }

    /// Peaks of ARR are those roots x = g^2 of N'D - ND' where it falls; here by brute force on a
    /// fine grid.
    #[test]
    fn nothing_on_a_fine_grid_exceeds_the_points() {
        for (mu, z) in designs() {
            let response = response(mu, &z);
            let found = points(&bands(), mu, &z);
            for (index, curve) in bands().iter().enumerate() {
                let top = found
                    .iter()
                    .filter(|point| point.curve == index)
                    .fold(f64::MIN, |top, point| top.max(point.value));
                for i in 0..=20_000 {
                    let g = 10f64.powf(-4.0 + 4e-4 * f64::from(i));
                    if (curve.g_low..=curve.g_high).contains(&g) {
                        let value = curve.excess(g, &response);
                        assert!(
                            value <= top + 1e-12 * (1.0 + top.abs()),
                            "mu {mu} {z} {curve:?} g {g}: {value} {top}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn a_peak_just_inside_the_end_of_a_band_is_found() {
        let z = Vector2::new(0.3, 0.2);
        let peak = points(&bands()[..1], 1.0, &z).into_iter().find(|point| point.inside).unwrap();
        for gap in [1e-3, 1e-6, 1e-9] {
            let band = |g_low, g_high| Band {
                g_low,
                g_high,
                kind: BandKind::Cap,
                limit: 0.5,
                weight: 2.0,
            };
            for band in [band(0.0, Some(peak.g * (1.0 + gap))), band(peak.g * (1.0 - gap), None)] {
                let found = points(&curves(&Target { bands: vec![band] }), 1.0, &z);
                assert!(
                    found
                        .iter()
                        .any(|point| point.inside && (point.g / peak.g - 1.0).abs() < 1e-14),
                    "{found:?}"
                );
            }
        }
    }

    #[test]
    fn at_a_peak_inside_the_slope_is_zero() {
        for (mu, z) in designs() {
            for point in points(&bands(), mu, &z).iter().filter(|point| point.inside) {
                let curve = bands()[point.curve];
                let bend = second_derivative(
                    |u| curve.excess(u.exp(), &response(mu, &z.map(real))),
                    point.g.ln(),
                )
                .2;
                let slope = curve.slope(point.g.ln(), mu, &z);
                // one rounding of u = ln g moves the slope by the curvature times it
                assert!(
                    slope.abs() <= 1e-14 * (10.0 + bend.abs()),
                    "mu {mu} {z} {point:?}: {slope} {bend}"
                );
            }
        }
    }

    #[test]
    fn models_agree_with_differences_of_the_points_themselves() {
        for (mu, z) in [
            (0.3, Vector2::new(-0.5, 0.8)),
            (5.0, Vector2::new(1.4, 1.0)),
            (1.0, Vector2::new(0.1, -0.5)),
        ] {
            let curves = bands();
            for point in points(&curves, mu, &z).iter().filter(|point| point.value.is_finite()) {
                let at = |z: SearchParameters| {
                    let now = points(&curves, mu, &z);
                    let same = now
                        .iter()
                        .filter(|other| other.curve == point.curve && other.inside == point.inside)
                        .min_by(|a, b| (a.g - point.g).abs().total_cmp(&(b.g - point.g).abs()))
                        .unwrap();
                    (same.value, curves[same.curve].model(same, mu, &z).slope)
                };
                if point.g.is_infinite() {
                    continue;
                }
                let model = curves[point.curve].model(point, mu, &z);
                let h = 1e-4;
                for j in 0..2 {
                    let [(after, slope_after), (before, slope_before)] =
                        [1.0, -1.0].map(|side| at(z + Vector2::ith(j, side * h)));
                    // central differences: h^2 = 1e-8 times third derivatives, here up to a few
                    // hundred
                    let scale = 1.0 + model.slope.norm() + model.curvature.norm();
                    let first = (after - before) / (2.0 * h) - model.slope[j];
                    let second =
                        (slope_after - slope_before) / (2.0 * h) - model.curvature.column(j);
                    assert!(first.abs() < 1e-6 * scale, "{point:?} {j}: {first}");
                    assert!(second.norm() < 1e-5 * scale, "{point:?} {j}: {second}");
                }
            }
        }
    }
}
