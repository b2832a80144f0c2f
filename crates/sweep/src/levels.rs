//! What the histories at each level say of a structure: how likely it lifts and overturns, how far
//! its top moves.
//!
//! ```text
//! share of n motions       k/n
//! its bounds (E. B. Wilson 1927, Journal of the American Statistical Association 22, 209), z of the confidence:
//!     [ k/n + z^2/(2 n) -+ z sqrt( k (n - k)/n^3 + z^2/(4 n^2) ) ] / (1 + z^2/n)
//! lean theta about a foot, to the right:
//!     top's middle   u = b (1 - cos theta) + H sin theta       foot in the air   2 b sin theta
//! ```
//!
//! At one level every motion is one history, so that histories are independent of each other. H is
//! the height of the top: twice that of the centre of mass of a block, that of the mass of an
//! A-frame. Displacements grow with the lean, so their quantiles are those of the lean.

use super::{
    ida::{Ida, IdaPoint},
    plan::Plan,
};
use rocking::structure::{Body, Kind, Structure};
use sweep_table::{SweepTable, TableOf};

/// How far a structure moves at a lean (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LeanDisplacements {
    /// Horizontal, of the top's middle.
    pub top_m: f64,
    /// Of the foot in the air.
    pub uplift_m: f64,
}

impl LeanDisplacements {
    /// At a lean of |theta|/alpha; infinite where that is.
    pub(crate) fn new(structure: &Structure, ratio: f64) -> Self {
        if !ratio.is_finite() {
            return Self { top_m: f64::INFINITY, uplift_m: f64::INFINITY };
        }
        let body = structure.body::<f64>();
        let theta = ratio * body.alpha();
        let height = match structure.kind {
            Kind::Block => 2.0 * body.height,
            Kind::AFrame => body.height,
        };
        Self {
            top_m: Body { height, ..body }.u(theta),
            uplift_m: 2.0 * body.half_width * theta.sin(),
        }
    }
}

/// Bounds on a probability of which k of n were seen, z standard deviations to both sides.
pub(crate) fn wilson(k: u64, n: u64, z: f64) -> Option<(f64, f64)> {
    if n == 0 {
        return None;
    }
    let (k, n) = (k as f64, n as f64);
    let middle = (k + 0.5 * z * z) / n;
    let half = z * (k * (n - k) / n.powi(3) + z * z / (4.0 * n * n)).sqrt();
    let whole = 1.0 + z * z / n;
    // to rounding zero of none, and one of all
    let low = if k == 0.0 { 0.0 } else { (middle - half) / whole };
    let high = if k == n { 1.0 } else { (middle + half) / whole };
    Some((low, high))
}

/// One structure at one level.
#[derive(Clone, Debug)]
pub(crate) struct LevelAnswer {
    /// In the plan's measure.
    pub level: f64,
    /// Shares of the histories that count that lift and overturn, with the bounds on the latter.
    pub lifted: f64,
    pub overturned: f64,
    pub bounds: (f64, f64),
    /// Of the median, and of 84 % of the motions; infinite where these overturn.
    pub median: LeanDisplacements,
    pub most: LeanDisplacements,
}

impl LevelAnswer {
    fn new(plan: &Plan, point: &IdaPoint, z: f64) -> Option<Self> {
        let structure = &plan.subjects[point.subject].structure;
        let at = |share: f64| Some(LeanDisplacements::new(structure, point.quantile(share)?));
        Some(Self {
            level: point.level,
            lifted: point.lifted as f64 / point.n as f64,
            overturned: point.overturned as f64 / point.n as f64,
            bounds: wilson(point.overturned, point.n, z)?,
            median: at(0.5)?,
            most: at(0.84)?,
        })
    }
}

/// The levels of one structure and restitution by one model that tell most, at most so many: from
/// the last at which nothing overturns to the first at which everything does; and at how many there
/// are histories that count.
pub(crate) fn telling<'a>(
    plan: &Plan,
    points: impl Iterator<Item = &'a IdaPoint>,
    z: f64,
    most: usize,
) -> (Vec<LevelAnswer>, usize) {
    let mut all: Vec<LevelAnswer> =
        points.filter_map(|point| LevelAnswer::new(plan, point, z)).collect();
    all.sort_by(|a, b| a.level.total_cmp(&b.level));
    let most = most.max(2);
    let count = all.len();
    if count <= most {
        return (all, count);
    }
    let from =
        all.iter().position(|row| row.overturned > 0.0).unwrap_or(all.len()).saturating_sub(1);
    let from = from.min(all.len() - most);
    let to = all.iter().rposition(|row| row.overturned < 1.0).map_or(0, |last| last + 1);
    let to = to.clamp(from + most - 1, all.len() - 1);
    let place = |i: usize| from + (i * (to - from) + (most - 1) / 2) / (most - 1);
    ((0..most).map(|i| all[place(i)].clone()).collect(), count)
}

/// Which of a structure's levels are shown, if not all: of `counting` some history counts.
pub(crate) fn shown_words(shown: usize, counting: usize, all: usize) -> String {
    let none = match counting < all {
        true => format!(
            "{} {} without a history that counts, since all failed or left the ground",
            all - counting,
            if all - counting == 1 { "level is" } else { "levels are" }
        ),
        false => String::new(),
    };
    match (shown < counting, counting < all) {
        (false, false) => String::new(),
        (true, false) => format!(" {shown} of its {all} levels, spread evenly; ida.csv has all:"),
        (false, true) => format!(" {shown} of its {all} levels; {none}:"),
        (true, true) => format!(
            " {shown} of its {all} levels, spread evenly over {counting}; {none}; ida.csv has all:"
        ),
    }
}

/// Columns of `ida.csv` beside those of the peaks: bounds on the share that overturns,
/// displacements of the quantiles.
pub fn columns(plan: &Plan, ida: &Ida, z: f64) -> SweepTable {
    let bounds = |point: &IdaPoint| wilson(point.overturned, point.n, z);
    let at = |point: &IdaPoint, share: f64| {
        Some(LeanDisplacements::new(
            &plan.subjects[point.subject].structure,
            point.quantile(share)?,
        ))
    };
    TableOf::new(&ida.points)
        .real("overturned_low", |point| Some(bounds(point)?.0))
        .real("overturned_high", |point| Some(bounds(point)?.1))
        .real("top_16_m", |point| Some(at(point, 0.16)?.top_m))
        .real("top_50_m", |point| Some(at(point, 0.5)?.top_m))
        .real("top_84_m", |point| Some(at(point, 0.84)?.top_m))
        .real("uplift_16_m", |point| Some(at(point, 0.16)?.uplift_m))
        .real("uplift_50_m", |point| Some(at(point, 0.5)?.uplift_m))
        .real("uplift_84_m", |point| Some(at(point, 0.84)?.uplift_m))
        .table()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lognormal::quantile;

    /// R. G. Newcombe (1998), "Two-sided confidence intervals for the single proportion",
    /// Statistics in Medicine 17, table I, method 3: 95 %.
    #[test]
    fn bounds_are_those_printed_for_the_score_method() {
        let z = quantile(0.975);
        for (k, n, low, high) in [
            (81, 263, 0.2553, 0.3662),
            (15, 148, 0.0624, 0.1605),
            (0, 20, 0.0, 0.1611),
            (1, 29, 0.0061, 0.1718),
        ] {
            let (a, b) = wilson(k, n, z).unwrap();
            assert!((a - low).abs() < 5.1e-5 && (b - high).abs() < 5.1e-5, "{k}/{n}: {a} {b}");
        }
        assert_eq!((wilson(0, 0, z), wilson(7, 7, z).unwrap().1), (None, 1.0));
    }

    /// The corner of a block and the middle of its top, turned about the foot as points of a plane.
    #[test]
    fn the_top_and_the_foot_turn_about_the_other_foot() {
        let block = Structure::block(1.9, 0.6, 400.0).unwrap();
        let alpha = block.body::<f64>().alpha();
        for ratio in [0.0, 0.1, 0.5, 1.0] {
            let (sin, cos) = (ratio * alpha).sin_cos();
            // clockwise about (b, 0): (x, y) -> (b + (x - b) cos + y sin, y cos - (x - b) sin)
            let turned =
                |x: f64, y: f64| (0.3 + (x - 0.3) * cos + y * sin, y * cos - (x - 0.3) * sin);
            let moved = LeanDisplacements::new(&block, ratio);
            assert!((moved.top_m - turned(0.0, 1.9).0).abs() < 1e-14, "{ratio}");
            assert!((moved.uplift_m - turned(-0.3, 0.0).1).abs() < 1e-14, "{ratio}");
        }
        let frame = Structure::a_frame(61.0, 12.2, 1e5).unwrap();
        assert_eq!(
            LeanDisplacements::new(&frame, 0.3).top_m,
            frame.body::<f64>().u(0.3 * frame.body::<f64>().alpha())
        );
        assert_eq!(LeanDisplacements::new(&block, f64::INFINITY).top_m, f64::INFINITY);
    }

    #[test]
    fn levels_that_were_thinned_out_and_those_without_a_history_are_told_apart() {
        assert_eq!(shown_words(5, 5, 5), "");
        assert_eq!(
            shown_words(10, 12, 12),
            " 10 of its 12 levels, spread evenly; ida.csv has all:"
        );
        assert_eq!(
            shown_words(3, 3, 5),
            " 3 of its 5 levels; 2 levels are without a history that counts, since all failed or \
             left the ground:"
        );
        let both = shown_words(10, 15, 16);
        assert!(both.contains("10 of its 16 levels, spread evenly over 15; 1 level is"), "{both}");
    }
}
