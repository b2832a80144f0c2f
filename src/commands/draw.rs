//! The figures of `tune run`, filled from its results.

use std::path::Path;

use rayon::prelude::*;

use super::{CommandError, common::Both};
use crate::{
    case::Case,
    figures::{self, FigureError},
    front::Point,
    response::{
        self,
        target::{Band, BandKind, Target},
    },
    spring::Design,
    tuning::job::Job,
};

/// Whether the target asks for nothing but the lowest cap there is, by a limit that no chain can meet.
fn lowest_cap(target: &Target) -> bool {
    target.bands.iter().all(|band| band.kind == BandKind::Cap && band.limit <= 1.0)
}

/// A target band as the figure shows it: caps that can be met and flat bands.
fn wanted(band: &Band, low: f64, high: f64) -> Option<figures::arr::Band> {
    let g = (band.g_low.max(low), band.g_high.unwrap_or(high).min(high));
    match band.kind {
        BandKind::Cap => {
            (band.limit > 1.0).then_some(figures::arr::Band { g, at_least: None, at_most: Some(band.limit) })
        }
        BandKind::Rigid => {
            Some(figures::arr::Band { g, at_least: Some(1.0 / (1.0 + band.limit)), at_most: Some(1.0 + band.limit) })
        }
        BandKind::Uniform | BandKind::RollOff => None,
    }
}

/// All figures, side by side.
pub fn draw(dir: &Path, case: &Case, job: &Job, both: &Both, front: &[Point]) -> Result<(), CommandError> {
    let (housner, fem) = (&both.housner, &both.fem);
    let dt = job.record.dt;
    let n = housner.len().min(fem.motion.len());
    let t: Vec<f64> = (0..n).map(|i| i as f64 * dt).collect();
    let title = |what: &str| format!("{what}: {}", case.record.name);

    let history = |path: &Path| {
        let impacts_housner: Vec<f64> = both.rocking.impacts.iter().map(|i| i.time).collect();
        let impacts_fem: Vec<f64> = fem.landings.iter().filter(|l| l.impact).map(|l| l.time).collect();
        figures::history::render(
            &figures::history::History {
                title: &title("Apex displacement"),
                t: &t,
                reference: figures::history::Trace {
                    label: "Housner",
                    u: &housner.u[..n],
                    v: &housner.v[..n],
                    impacts: &impacts_housner,
                },
                others: &[figures::history::Trace {
                    label: "finite elements on ground springs",
                    u: &fem.motion.u[..n],
                    v: &fem.motion.v[..n],
                    impacts: &impacts_fem,
                }],
                differences: false,
            },
            path,
        )
    };
    let arr = |path: &Path| {
        let g: Vec<f64> = (0..=600).map(|i| 0.02 * f64::powf(1000.0, i as f64 / 600.0)).collect();
        let arr_of = |d: &Design<f64>| g.iter().map(|&g| response::arr(g, d.mu, d.f, d.xi)).collect::<Vec<_>>();
        let lowest = lowest_cap(&case.target);
        let mut curves = Vec::new();
        let fitted = job.paper.iter().flat_map(|paper| {
            let best = &paper.tuned.best.springs;
            [("vertical", best.vertical, &paper.vertical), ("horizontal", best.horizontal, &paper.horizontal)]
        });
        for (name, d, fits) in fitted {
            let fit = fits.iter().find(|fit| (fit.mu, fit.f, fit.xi) == (d.mu, d.f, d.xi));
            let active: Vec<_> = fit
                .iter()
                .flat_map(|fit| &fit.certificate.active)
                .filter(|a| a.g.is_finite())
                .map(|a| figures::arr::Active { g: a.g, arr: a.arr, multiplier: None })
                .collect();
            let cap = fit.filter(|_| lowest).map(|fit| fit.peak);
            curves.push((format!("{name}, fit at \u{3bc} = {}", d.mu), arr_of(&d), active, cap));
        }
        if job.paper.as_ref().is_none_or(|paper| job.springs != paper.tuned.best.springs) {
            for (name, d) in [("vertical", &job.springs.vertical), ("horizontal", &job.springs.horizontal)] {
                curves.push((format!("{name}, tuned"), arr_of(d), Vec::new(), None));
            }
        }
        let curves: Vec<_> = curves
            .iter()
            .map(|(label, arr, active, cap)| figures::arr::Curve { label, g: &g, arr, active, cap: *cap })
            .collect();
        let target: Vec<_> = case.target.bands.iter().filter_map(|band| wanted(band, g[0], g[g.len() - 1])).collect();
        figures::arr::render(
            &figures::arr::Response {
                title: "Frequency response of the ground springs",
                target: &target,
                curves: &curves,
            },
            path,
        )
    };
    let candidates = |path: &Path| {
        let Some(paper) = &job.paper else { return Ok(()) };
        let tuned = &paper.tuned;
        let candidates: Vec<_> = tuned
            .candidates
            .iter()
            .map(|c| figures::candidates::Candidate {
                vertical_hz: c.springs.vertical.omega_n_hz,
                horizontal_hz: c.springs.horizontal.omega_n_hz,
                error: c.error,
                abandoned: c.abandoned,
            })
            .collect();
        figures::candidates::render(
            &figures::candidates::Candidates {
                title: &title("Every candidate of the paper's procedure"),
                error_label: "NRMSE of u and v",
                candidates: &candidates,
                chosen: Some(tuned.chosen),
            },
            path,
        )
    };
    let contact = |path: &Path| {
        let f = &fem.forces;
        figures::contact::render(
            &figures::contact::Contact {
                title: &title("Forces on the feet; in a landing those of the springs"),
                t: &t,
                left_vertical: &f.vertical[0][..n],
                right_vertical: &f.vertical[1][..n],
                left_horizontal: &f.horizontal[0][..n],
                right_horizontal: &f.horizontal[1][..n],
                weight: Some(case.structure.mass_kg * crate::scalar::GRAVITY),
            },
            path,
        )
    };
    let energy = |path: &Path| {
        let a = &fem.account;
        figures::energy::render(
            &figures::energy::Energy {
                title: &title("Energy account"),
                t: &t,
                input: &a.input[..n],
                stored: &a.stored[..n],
                dissipated: &a.dissipated[..n],
                residual: &a.residual[..n],
            },
            path,
        )
    };
    let front = |path: &Path| {
        let series = |pick: fn(&Point) -> Option<f64>| -> (Vec<f64>, Vec<f64>) {
            front.iter().filter_map(|p| pick(p).map(|e| (p.omega_n_hz, e))).unzip()
        };
        let (landing, arr) = (series(|p| p.landing), series(|p| p.arr));
        let all: Vec<_> = [("design from the geometry", &landing), ("the paper's procedure", &arr)]
            .into_iter()
            .filter(|(_, s)| !s.0.is_empty())
            .map(|(label, s)| figures::front::Series { label, omega_n_hz: &s.0, error: &s.1 })
            .collect();
        if all.is_empty() {
            return Ok(());
        }
        let cost = |pick: fn(&Point) -> f64| -> (Vec<f64>, Vec<f64>) {
            front.iter().map(|p| (p.omega_n_hz, pick(p).max(1.0))).unzip()
        };
        let (forces, steps) = (cost(|p| p.foot_force_weights), cost(|p| p.deck_steps as f64));
        let on = if job.suites.has_record() { "on the record" } else { "median of synthetic motions" };
        figures::front::render(
            &figures::front::Front {
                title: &title("Error against stiffness"),
                error_label: &format!("NRMSE of u, {on}"),
                series: &all,
                chosen_hz: job.springs.vertical.omega_n_hz,
                accuracy: case.tuning.accuracy,
                costs: [
                    figures::front::Cost { label: "foot force [weights]", omega_n_hz: &forces.0, value: &forces.1 },
                    figures::front::Cost { label: "deck steps, at least", omega_n_hz: &steps.0, value: &steps.1 },
                ],
                note: "The largest foot force is that of the springs in a landing, not of the structure.",
            },
            path,
        )
    };
    type Draw<'a> = (&'a str, &'a (dyn Fn(&Path) -> Result<(), FigureError> + Sync));
    let all: [Draw; 6] = [
        ("history.png", &history),
        ("response.png", &arr),
        ("candidates.png", &candidates),
        ("contact.png", &contact),
        ("energy.png", &energy),
        ("front.png", &front),
    ];
    all.par_iter().map(|(name, draw)| draw(&dir.join(name))).collect::<Result<(), FigureError>>()?;
    Ok(())
}
