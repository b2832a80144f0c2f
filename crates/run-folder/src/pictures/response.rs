//! The figure of the springs' response in frequency, with what was asked of it.

use dynamics::spring::Design;
use figures::{FigureError, Sheet};
use frequency_response::{
    response,
    target::{Band, BandKind, Target},
};

use super::Pictures;

impl Pictures<'_> {
    pub(super) fn response(&self) -> Result<Option<Sheet>, FigureError> {
        let job = self.job;
        let g: Vec<f64> = (0..=600).map(|i| 0.02 * f64::powf(1000.0, i as f64 / 600.0)).collect();
        let arr_of = |d: &Design<f64>| {
            g.iter().map(|&g| response::arr(g, d.mu, d.f, d.xi)).collect::<Vec<_>>()
        };
        let best = job.paper.as_ref().map(|paper| paper.tuned.best.springs);
        let mut labels = Vec::new();
        if best != Some(job.springs) {
            labels.push((false, "vertical, delivered".to_string(), job.springs.vertical, None));
            labels.push((true, "horizontal, delivered".to_string(), job.springs.horizontal, None));
        }
        if let Some(paper) = &job.paper {
            let delivered =
                if best == Some(job.springs) { "delivered" } else { "paper's procedure" };
            let springs = &paper.tuned.best.springs;
            for (horizontal, name, d, fits) in [
                (false, "vertical", springs.vertical, &paper.vertical),
                (true, "horizontal", springs.horizontal, &paper.horizontal),
            ] {
                let fit = fits.iter().find(|fit| (fit.mu, fit.f, fit.xi) == (d.mu, d.f, d.xi));
                labels.push((horizontal, format!("{name}, {delivered}, μ = {}", d.mu), d, fit));
            }
        }
        // a point that is active at an infinite frequency stands at the right edge, and is said
        let lowest = lowest_cap(&self.case.target);
        let end = g[g.len() - 1];
        let active: Vec<Vec<figures::arr::ActiveMark>> = labels
            .iter()
            .map(|(_, _, _, fit)| {
                let all = fit.iter().flat_map(|fit| &fit.certificate.active);
                all.map(|a| figures::arr::ActiveMark {
                    g: a.g.min(end),
                    arr: a.arr,
                    multiplier: None,
                })
                .collect()
            })
            .collect();
        let arr: Vec<Vec<f64>> = labels.iter().map(|(_, _, d, _)| arr_of(d)).collect();
        let curve = |i: usize| {
            let (horizontal, label, d, fit) = &labels[i];
            figures::arr::UnitCurve {
                label,
                g: &g,
                arr: &arr[i],
                active: &active[i],
                delivered: *d == job.springs.vertical || *d == job.springs.horizontal,
                horizontal: *horizontal,
                cap: fit.filter(|_| lowest).map(|fit| fit.peak),
            }
        };
        let curves: Vec<_> = (0..labels.len()).map(curve).collect();
        let target: Vec<_> =
            self.case.target.bands.iter().filter_map(|band| wanted(band, g[0], end)).collect();
        let mut title = self.title("Frequency response of the ground springs");
        if labels
            .iter()
            .filter_map(|label| label.3)
            .flat_map(|fit| &fit.certificate.active)
            .any(|a| a.g > end)
        {
            title.push_str("\nPoints active at g beyond the axis stand at its right end.");
        }
        figures::arr::draw(&figures::arr::ResponseFigure {
            title: &title,
            target: &target,
            curves: &curves,
        })
        .map(Some)
    }
}

/// Whether the target asks for nothing but the lowest cap there is, by a limit that no chain can
/// meet.
fn lowest_cap(target: &Target) -> bool {
    target.bands.iter().all(|band| band.kind == BandKind::Cap && band.limit <= 1.0)
}

/// A target band as the figure shows it: caps that can be met and flat bands.
fn wanted(band: &Band, low: f64, high: f64) -> Option<figures::arr::TargetBand> {
    let g = (band.g_low.max(low), band.g_high.unwrap_or(high).min(high));
    match band.kind {
        BandKind::Cap => (band.limit > 1.0).then_some(figures::arr::TargetBand {
            g,
            at_least: None,
            at_most: Some(band.limit),
        }),
        BandKind::Rigid => Some(figures::arr::TargetBand {
            g,
            at_least: Some(1.0 / (1.0 + band.limit)),
            at_most: Some(1.0 + band.limit),
        }),
        BandKind::Uniform | BandKind::RollOff => None,
    }
}
