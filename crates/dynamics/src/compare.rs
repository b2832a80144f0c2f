//! The finite element history beside Housner's: one set of numbers that says how well springs do.

use serde::{Deserialize, Serialize};

use crate::fem::{History, Landing};
use rocking::{
    housner::Impact,
    json::null_as_infinite,
    members::Members,
    motion::{Motion, nrmse, peak, samples_until},
    overturning::overturned_with,
    structure::Body,
};

/// How a finite element history matches Housner's over the same samples, up to the first
/// overturning of the two, or to where Housner's body leaves the ground: after it there is nothing
/// to compare. A number that is not finite (an NRMSE of a body that Housner's equation never lifts)
/// is `null` in JSON.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Match {
    /// Length compared (s).
    pub duration_s: f64,
    /// When Housner's body overturned, that is |theta| last grew past alpha (s); none if it did
    /// not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overturned_housner_s: Option<f64>,
    /// When the finite element body overturned, by the same rule (s); none if it did not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overturned_fem_s: Option<f64>,
    /// NRMSE of the horizontal displacement: sqrt( sum (u - u_H)^2 / sum u_H^2 ), u_H Housner's.
    #[serde(deserialize_with = "null_as_infinite")]
    pub nrmse_horizontal: f64,
    /// NRMSE of the vertical displacement v, from the settled position.
    #[serde(deserialize_with = "null_as_infinite")]
    pub nrmse_vertical: f64,
    /// Housner's horizontal displacement u of largest magnitude, with its sign (m).
    pub peak_horizontal_housner_m: f64,
    /// Horizontal displacement u of largest magnitude of the finite elements, with its sign (m).
    pub peak_horizontal_fem_m: f64,
    /// Housner's vertical displacement v of largest magnitude, with its sign, up is positive (m).
    pub peak_vertical_housner_m: f64,
    /// Vertical displacement v of largest magnitude of the finite elements, from the settled
    /// position, with its sign (m).
    pub peak_vertical_fem_m: f64,
    /// Housner's impacts, those of all of his history.
    pub impacts_housner: usize,
    /// Impacts of the finite elements ([`Landing::impact`]) over the length compared.
    pub impacts_fem: usize,
    /// Housner's impacts harder than a fall from 0.02 alpha: what both models count alike, for a
    /// body that comes to rest has ever more, ever gentler ones by his theory, and sways on its
    /// springs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impacts_housner_firm: Option<usize>,
    /// Impacts of the finite elements that are harder than a fall from 0.02 alpha.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub impacts_fem_firm: Option<usize>,
    /// Bounces of the finite elements ([`Landing::bounced`]) over the length compared.
    pub bounces: usize,
    /// Settlement of the standing body under its weight (m).
    pub settlement_m: f64,
    /// Largest |e_effective/e - 1| over the landings with more than 1 % of the largest kinetic
    /// energy; the last is left out, for its losses may not be complete.
    #[serde(deserialize_with = "null_as_infinite")]
    pub restitution_error_max: f64,
    /// Largest |e_effective/e - 1| over the impacts above the energy threshold, a fall from 0.02
    /// alpha, for which springs are tuned: gentler ones are partly taken by the elastic stance. The
    /// last is left out. None if there are none.
    #[serde(default)]
    pub restitution_error_firm: Option<f64>,
    /// Largest |residual| of the energy account over the largest energy.
    pub energy_residual: f64,
}

impl Match {
    /// Compare a history with Housner's motion, both sampled at dt, and his impacts. Public for the
    /// crates that compare.
    #[doc(hidden)]
    pub fn new(
        body: &Body<f64>,
        dt: f64,
        rocking: (&Motion, &[Impact<f64>]),
        fem: &History,
        restitution: f64,
    ) -> Self {
        Self::with_members(body, Members::default(), dt, rocking, fem, restitution)
    }

    /// The same of a body with members.
    #[doc(hidden)]
    pub fn with_members(
        body: &Body<f64>,
        members: Members,
        dt: f64,
        rocking: (&Motion, &[Impact<f64>]),
        fem: &History,
        restitution: f64,
    ) -> Self {
        let (housner, impacts) = rocking;
        let times =
            [housner, &fem.motion].map(|motion| overturned_with(body, members, dt, &motion.theta));
        let until = times.into_iter().flatten().reduce(f64::min);
        let n = housner.len().min(fem.motion.len()).min(samples_until(until, dt));
        // Housner's solution may end before: where its pivot leaves the ground
        let end = if housner.len() < fem.motion.len() {
            housner.len() as f64 * dt
        } else {
            f64::INFINITY
        };
        let end = until.unwrap_or(end).min(end);
        let upright = |l: &&Landing| l.time <= end;
        let before = || fem.landings.iter().filter(upright);
        let landings = effective_restitution(before());
        let largest = before().filter(|l| l.impact).map(|l| l.kinetic).fold(0.0, f64::max);
        let error = |least: f64| error_above(&landings, restitution, least);
        let firm = threshold_energy(body);
        let inertia = body.mass * body.radius().powi(2) / body.mass_share();
        let kinetic = |impact: &Impact<f64>| 0.5 * inertia * impact.rate_before.powi(2);
        Self {
            duration_s: n.saturating_sub(1) as f64 * dt,
            overturned_housner_s: times[0],
            overturned_fem_s: times[1],
            nrmse_horizontal: nrmse(&fem.motion.u[..n], &housner.u[..n]),
            nrmse_vertical: nrmse(&fem.motion.v[..n], &housner.v[..n]),
            peak_horizontal_housner_m: peak(&housner.u[..n]),
            peak_horizontal_fem_m: peak(&fem.motion.u[..n]),
            peak_vertical_housner_m: peak(&housner.v[..n]),
            peak_vertical_fem_m: peak(&fem.motion.v[..n]),
            impacts_housner: impacts.len(),
            impacts_fem: before().filter(|l| l.impact).count(),
            impacts_housner_firm: Some(
                impacts.iter().filter(|impact| kinetic(impact) > firm).count(),
            ),
            impacts_fem_firm: Some(impacts_above_threshold(body, fem, end)),
            bounces: before().filter(|l| l.bounced).count(),
            settlement_m: -fem.initial_z,
            restitution_error_max: error(LANDINGS_THAT_MATTER * largest).unwrap_or(0.0),
            restitution_error_firm: error(firm),
            energy_residual: fem.energy_residual,
        }
    }
}

/// The least lean from which springs are judged, share of alpha.
pub const LEAST_LEAN: f64 = 0.02;

/// Kinetic energy above which impacts count (J).
fn threshold_energy(body: &Body<f64>) -> f64 {
    body.fall(LEAST_LEAN * body.alpha())
}

/// Impacts of a history up to a time (s), those above the energy threshold.
pub fn impacts_above_threshold(body: &Body<f64>, history: &History, end: f64) -> usize {
    let counts = |l: &&Landing| l.time <= end && l.impact && l.kinetic > threshold_energy(body);
    history.landings.iter().filter(counts).count()
}

/// Landings of less than this share of the largest kinetic energy do not count in
/// `restitution_error_max`.
const LANDINGS_THAT_MATTER: f64 = 0.01;

/// Kinetic energy of each impact (J), and sqrt(1 - lost/kinetic): the velocity ratio that loses
/// what the landing lost, up to the next landing. The last is left out, for its losses may not be
/// complete.
fn effective_restitution<'a>(landings: impl Iterator<Item = &'a Landing>) -> Vec<(f64, f64)> {
    let mut all: Vec<(f64, f64)> = landings
        .filter(|l| l.impact)
        .map(|l| (l.kinetic, (1.0 - l.lost / l.kinetic).max(0.0).sqrt()))
        .collect();
    all.pop();
    all
}

/// Largest |e_effective/e - 1| of the landings with more kinetic energy than this (J).
fn error_above(landings: &[(f64, f64)], restitution: f64, least: f64) -> Option<f64> {
    let those = landings.iter().filter(|(kinetic, _)| *kinetic > least);
    those.map(|(_, e)| (e / restitution - 1.0).abs()).reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        fem::{Analysis, Start},
        spring::{Design, Springs},
    };
    use rocking::{
        housner::{history, released, solve},
        scalar::GRAVITY,
        structure::Structure,
    };

    /// Both models of a solid block on plain springs under a steady push.
    fn pushed(share_of_limit: f64) -> (Body<f64>, Match, f64) {
        let body = Structure::block(2.0, 0.5, 1e3).unwrap().body::<f64>();
        let design = Design::from_kc(0.3, 0.1, 0.75, 400.0);
        let springs = Springs { vertical: design, horizontal: design }.chains(body.mass);
        let dt = 0.01;
        let accel = vec![share_of_limit * GRAVITY * body.half_width / body.height; 1000];
        let rocking = history(&body, dt, &accel);
        let history = Analysis::new(body, springs, dt, &accel).simulate();
        let housner = (&rocking.motion(&body), &rocking.impacts[..]);
        (
            body,
            Match::new(&body, dt, housner, &history, body.restitution()),
            rocking.overturned().unwrap_or(f64::NAN),
        )
    }

    /// A block that falls from 0.3 alpha lands with e^2 of the energy each time: (1 -
    /// |theta|/alpha)^2 - 1 of alpha is what is left, so that it takes a count of landings until a
    /// fall from less than 0.02 alpha, and infinitely many to rest.
    #[test]
    fn impacts_above_the_threshold_are_as_many_in_both_models() {
        let structure = Structure::block(2.0, 0.5, 1e3).unwrap();
        let body = structure.body::<f64>();
        let (dt, accel, theta) = (0.005, vec![0.0; 2000], 0.3 * body.alpha());
        let options = released(theta, 0.0);
        let rocking = solve(&body, dt, &accel, &options);
        let design = Design::from_kc(0.3, 0.1, 0.75, 2000.0);
        let springs = Springs { vertical: design, horizontal: design }.chains(body.mass);
        let history =
            Analysis { start: Start::Leaning(theta), ..Analysis::new(body, springs, dt, &accel) }
                .simulate();
        let found = Match::new(
            &body,
            dt,
            (&rocking.motion(&body), &rocking.impacts),
            &history,
            body.restitution(),
        );
        let energy = |lean: f64| (1.0 - (1.0 - lean).powi(2)) / (1.0 - 0.7f64.powi(2));
        let expected = (energy(0.02).ln() / (2.0 * body.restitution().ln())).ceil() as usize;
        assert!(
            found.impacts_housner_firm.unwrap().abs_diff(expected) <= 1,
            "{found:?}, {expected}"
        );
        assert!(
            found.impacts_fem_firm.unwrap().abs_diff(found.impacts_housner_firm.unwrap()) <= 1,
            "{found:?}"
        );
        assert!(found.impacts_housner > found.impacts_housner_firm.unwrap(), "{found:?}");
    }

    /// alpha is passed at acosh(1 + 1/(x - 1))/p, small angles, x the push over its limit: 1.3170/p
    /// for x = 2.
    #[test]
    fn nothing_counts_after_the_first_overturning() {
        let (body, found, time) = pushed(2.0);
        assert!((time * body.p() / 1.3170 - 1.0).abs() < 0.03, "{time}");
        assert!((found.overturned_housner_s.unwrap() - time).abs() < 1e-3, "{found:?}");
        assert!((found.overturned_fem_s.unwrap() - time).abs() < 0.02, "{found:?}");
        assert!(found.duration_s <= time && found.nrmse_horizontal < 0.05, "{found:?}");
        let balance = body.u(body.alpha());
        for peak in [found.peak_horizontal_housner_m, found.peak_horizontal_fem_m] {
            assert!((0.9..=1.001).contains(&(peak.abs() / balance)), "{found:?}");
        }
        assert_eq!((found.impacts_housner, found.impacts_fem), (0, 0));
    }

    #[test]
    fn an_error_against_a_body_that_never_lifts_is_null_in_json_and_read_back() {
        let (_, found, _) = pushed(0.5);
        assert_eq!(found.nrmse_horizontal, f64::INFINITY);
        let json = serde_json::to_string(&found).unwrap();
        assert!(
            json.contains("\"nrmse_horizontal\":null") && !json.contains("overturned"),
            "{json}"
        );
        assert_eq!(serde_json::from_str::<Match>(&json).unwrap(), found);
    }
}
