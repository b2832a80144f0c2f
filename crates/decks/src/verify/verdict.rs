//! Whether OpenSees is within its limit of our own history.

use parameters::predictability::{Foretold, ForetoldEnd, STANDING, standing_error, standing_share};
use rocking::{
    motion::{Motion, peak},
    structure::Body,
};

/// Largest NRMSE of u between OpenSees and our own history.
pub const LIMIT: f64 = 0.001;

/// Share of the largest u by which histories that have parted differ.
const PARTED: f64 = 0.01;

/// OpenSees against our own history, up to where that can be foretold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenSeesVerdict {
    /// NRMSE of u over what is judged.
    pub error: f64,
    /// Whether it is over a thousandth of half the width, of a body that hardly moves, not over the
    /// motion.
    pub stands: bool,
    /// Whether it is at most [`LIMIT`].
    pub within: bool,
    /// Samples judged: all, or those that can be foretold.
    pub samples: usize,
    /// The last of those, if that is before the history's last (s).
    pub until: Option<f64>,
    /// Why there.
    pub end: Option<ForetoldEnd>,
    /// When OpenSees first is off by one hundredth of the largest u (s).
    pub parted: Option<f64>,
    /// Of a body that slides and never lifts, which is judged by this instead.
    pub slip: Option<Slip>,
}

/// Slip of our own history and of OpenSees' (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slip {
    /// The largest.
    pub largest_m: [f64; 2],
    /// That of the last sample judged, with its sign.
    pub last_m: [f64; 2],
}

impl Slip {
    /// Largest difference of the two that passes, as a share of the largest slip.
    pub const LIMIT: f64 = 0.01;

    /// The larger difference, of the largest slips and of the last, over our largest.
    pub fn error(&self) -> f64 {
        let apart = |[ours, opensees]: [f64; 2]| (ours - opensees).abs();
        let most = apart(self.largest_m).max(apart(self.last_m));
        if most == 0.0 { 0.0 } else { most / self.largest_m[0] }
    }

    /// Difference of the largest slips, over ours; infinite over none.
    pub fn error_of_largest(&self) -> f64 {
        relative(self.largest_m)
    }

    /// Difference of the last slips over our last, which may be far less than the largest; infinite
    /// over none.
    pub fn error_of_last(&self) -> f64 {
        relative(self.last_m)
    }
}

/// How far the second is from the first, over the first.
fn relative([ours, opensees]: [f64; 2]) -> f64 {
    if ours == opensees { 0.0 } else { ((opensees - ours) / ours).abs() }
}

impl OpenSeesVerdict {
    /// `foretold`: up to where it can be, `None` for all of it.
    pub(crate) fn new(
        opensees: &Motion,
        ours: &Motion,
        body: &Body<f64>,
        dt: f64,
        foretold: Option<Foretold>,
    ) -> Self {
        let until = foretold.map(|foretold| foretold.samples);
        let samples = until.unwrap_or(ours.len()).min(ours.len()).min(opensees.len());
        let (a, b) = (&opensees.u[..samples], &ours.u[..samples]);
        let error = standing_error(a, b, body.half_width);
        let far = PARTED * peak(&ours.u).abs().max(STANDING * body.half_width);
        let parted = opensees.u.iter().zip(&ours.u).position(|(a, b)| (a - b).abs() > far);
        let time = |sample: usize| sample as f64 * dt;
        let end = foretold.map(|foretold| foretold.end);
        let stands = standing_share(b.iter(), body.half_width) < 1.0;
        Self {
            error,
            stands,
            within: error <= LIMIT,
            samples,
            until: until.map(|samples| time(samples.saturating_sub(1))),
            end,
            parted: parted.map(time),
            slip: None,
        }
    }

    /// The same judged by the slip of a body that never lifts: when a foot slips hangs on the
    /// smallest forces, how far it goes does not.
    #[must_use]
    pub(crate) fn of_slip(self, opensees: &Motion, ours: &Motion) -> Self {
        let both = [ours, opensees].map(|motion| &motion.u[..self.samples.min(motion.u.len())]);
        let slip = Slip {
            largest_m: both.map(|u| peak(u).abs()),
            last_m: both.map(|u| u.last().copied().unwrap_or(0.0)),
        };
        Self { within: slip.error() <= Slip::LIMIT, slip: Some(slip), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::structure::Structure;

    /// A history of 1 m and one that leaves it by the given share from the given sample on.
    fn pair(share: f64, from: usize) -> [Motion; 2] {
        let u: Vec<f64> = (0..100).map(|i| if i % 2 == 0 { 1.0 } else { -1.0 }).collect();
        let off = u
            .iter()
            .enumerate()
            .map(|(i, u)| if i < from { *u } else { u * (1.0 + share) })
            .collect();
        [off, u].map(|u| Motion { v: u.clone(), theta: u.clone(), u })
    }

    fn judged(share: f64, from: usize, until: Option<usize>) -> OpenSeesVerdict {
        let [off, ours] = pair(share, from);
        let foretold = until.map(|samples| Foretold { samples, end: ForetoldEnd::Width });
        OpenSeesVerdict::new(&off, &ours, &Structure::paper().body(), 0.01, foretold)
    }

    #[test]
    fn a_history_off_by_its_limit_passes_and_one_further_off_does_not() {
        assert!(judged(0.9 * LIMIT, 0, None).within);
        let far = judged(1.1 * LIMIT, 0, None);
        assert!(!far.within && (far.error / (1.1 * LIMIT) - 1.0).abs() < 1e-9, "{far:?}");
        assert_eq!(far.parted, None);
    }

    #[test]
    fn what_cannot_be_foretold_is_not_judged_but_the_time_of_parting_is_told() {
        let verdict = judged(0.5, 60, Some(50));
        assert!(verdict.within && verdict.samples == 50);
        assert_eq!((verdict.until, verdict.parted), (Some(0.49), Some(0.6)));
        assert!(!judged(0.5, 40, Some(50)).within);
    }

    /// A body that slides to 20 mm and back to 15 mm: 0.9 % of 20 mm passes, of the largest as of
    /// the last, and 1.1 % does not, however far histories are apart in between.
    #[test]
    fn a_body_that_slides_is_judged_by_how_far_it_goes_and_where_it_ends() {
        let slide = |largest: f64, between: f64, last: f64| {
            let u = vec![0.0, largest, between, last];
            Motion { v: vec![0.0; 4], theta: vec![0.0; 4], u }
        };
        let ours = slide(0.02, 0.018, 0.015);
        let judged = |other: &Motion| {
            OpenSeesVerdict::new(other, &ours, &Structure::paper().body(), 0.01, None)
                .of_slip(other, &ours)
        };
        let near = judged(&slide(0.020_18, 0.005, 0.014_82));
        assert!(near.within && (near.slip.unwrap().error() - 0.009).abs() < 1e-9, "{near:?}");
        assert!(near.error > LIMIT);
        // 0.18 mm of 20 mm, and of 15 mm
        let [largest, last] =
            near.slip.map(|slip| [slip.error_of_largest(), slip.error_of_last()]).unwrap();
        assert!((largest - 0.009).abs() < 1e-9 && (last - 0.012).abs() < 1e-9, "{near:?}");
        assert!(!judged(&slide(0.020_22, 0.018, 0.015)).within);
        assert!(!judged(&slide(0.02, 0.018, 0.015_22)).within);
    }

    /// A millimetre of a frame 6.1 m wide to each side is standing: an error of a tenth of that is
    /// within 0.001 of a thousandth of the width.
    #[test]
    fn a_body_that_stands_is_judged_by_its_width() {
        let [off, ours] = pair(0.1, 0).map(|m| {
            let u: Vec<f64> = m.u.iter().map(|u| u * 1e-5).collect();
            Motion { v: u.clone(), theta: u.clone(), u }
        });
        let verdict = OpenSeesVerdict::new(&off, &ours, &Structure::paper().body(), 0.01, None);
        assert!(verdict.within && verdict.error > 0.0 && verdict.stands, "{verdict:?}");
        assert!(!judged(0.0, 0, None).stands);
    }
}
