//! What is said of an elastic structure's run: the structure on rigid ground beside the same on its
//! springs.

mod feet;
mod forces;
mod peaks;
pub(crate) mod springs;

use self::springs::{alone, springs_findings};
use super::{Assumed, FiledParameters, Run, Section, Table, cut_at_largest, doubts, judged};
use cases::{ElasticCase, doubts::Doubt};
use dynamics::{
    fem::HistoryOutcome,
    spring::{Chain, Springs},
};
use files::message::significant;
pub use forces::design_forces;
use frames::{
    answer::{ElasticAnswer, ElasticHistories},
    assembled::{Assembled, Sway},
    design_forces::through,
    ensemble::Ensemble,
    reference::{ReferenceOutcome, Stop},
    structure::ElasticStructure,
};
use parameters::elastic::{ElasticParameters, OnRecord};
pub use peaks::peaks_on_springs;
use results::{
    DeckEnd, DesignForce, DesignForces, Ending, Finding, FindingModel, ForceName, PeakChange,
};
use rocking::{
    members::Members,
    motion::{TimedPeak, peak},
};
pub use springs::of_case;
use strong_motion::Record;

/// Part of what a footing bears at rest below which its force tells nothing of friction: it all but
/// flies.
const LEAST_PRESS: f64 = 0.1;

/// What a run is told from.
pub struct ElasticParts<'a> {
    /// As it was given.
    pub case: &'a ElasticCase,
    /// The structure and its finite elements.
    pub assembled: &'a Assembled,
    /// The part of the record that is used, scaled.
    pub record: &'a Record,
    /// Under every corner.
    pub springs: &'a [Springs<Chain>],
    /// Both models' answers.
    pub answer: &'a ElasticAnswer,
    /// The friction coefficient that the ground offers.
    pub friction: f64,
}

/// The structure in a few words.
pub fn title(structure: &ElasticStructure) -> String {
    let m = |x: f64| format!("{} m", significant(x, 4));
    match structure {
        ElasticStructure::Pier(pier) => {
            format!("pier {} high on a footing of {}", m(pier.height_m), m(pier.width_m))
        }
        ElasticStructure::AFrame(frame) => {
            format!(
                "A-frame with elastic legs {} high, feet {} apart",
                m(frame.height_m),
                m(frame.width_m)
            )
        }
        ElasticStructure::Frame(frame) => {
            format!("frame {} high, columns {} apart", m(frame.height_m), m(frame.span_m))
        }
    }
}

impl ElasticParts<'_> {
    /// Friction coefficient that a footing on rigid ground needs, and when (s); how much of what it
    /// bears at rest presses it then. The footing that needs most: thrusts of two cancel.
    fn friction_needed(&self) -> (TimedPeak, f64) {
        let frame = &self.assembled.frame;
        let forces = &self.answer.histories.reference.history.forces;
        let sizes: Vec<usize> =
            frame.places().chunk_by(|a, b| a.shares_node(b)).map(<[_]>::len).collect();
        // (H, N) of each footing
        let footings = |corners: &Vec<[f64; 2]>| -> Vec<[f64; 2]> {
            let mut rest = corners.as_slice();
            let mut one = |size: &usize| {
                let (own, others) = rest.split_at(*size);
                rest = others;
                [0, 1].map(|k| own.iter().map(|force| force[k]).sum())
            };
            sizes.iter().map(&mut one).collect()
        };
        // what each bears at rest, its tendon's tension included
        let at_rest = forces.first().map(footings).unwrap_or_default();
        let mut most = (TimedPeak::default(), 0.0);
        for (i, corners) in forces.iter().enumerate() {
            for ([h, n], [_, at_rest]) in footings(corners).into_iter().zip(&at_rest) {
                let needed = (h / n).abs();
                if n > LEAST_PRESS * at_rest && needed > most.0.value {
                    let time = i as f64 * self.record.dt;
                    most = (TimedPeak { value: needed, time }, n / at_rest);
                }
            }
        }
        most
    }

    /// All findings.
    pub fn findings(&self, parameters: &ElasticParameters) -> Vec<Finding> {
        // what of the search was cut is there already
        let mut all: Vec<Finding> =
            parameters.findings.iter().map(|filed| filed.finding.clone()).collect();
        let judged = judged::elastic(self.assembled, &self.answer.histories, self.record);
        if let Some(on) = &parameters.on_record {
            all.extend(self.what_it_does(on));
            all.extend(foretold(on, judged.as_ref(), parameters.design_forces.as_ref()));
            let alpha = self.assembled.structure.body().alpha();
            all.extend(on.near.iter().map(|near| nearby(near, alpha)));
            let motions = self.answer.near_left_out;
            let none = self.answer.ensemble.is_none();
            let left_out = Finding::NearMotionsLeftOut { motions, all: none };
            all.extend((motions > 0).then_some(left_out));
        }
        let (needed, press) = self.friction_needed();
        all.extend((needed.value > self.friction).then_some(Finding::Sliding {
            needed: needed.value,
            time_s: Some(needed.time),
            available: self.friction,
            press_over_weight: Some(press),
        }));
        let until = all.iter().chain(&judged).filter_map(Finding::predictable_to);
        all.extend(self.feet_moved(until.reduce(f64::min)));
        let (whole, peaks) = (&self.case.excitation.record, self.peaks().reference);
        all.extend(cut_at_largest(&peaks, whole, self.record));
        all.extend(self.vertical_left_out());
        all.extend(doubts(self.case.doubts()));
        all.extend(springs_findings(parameters));
        let asked = self.case.program.is_some();
        all.extend(parameters.program.iter().filter_map(|row| super::program::lost(row, asked)));
        all.extend(parameters.design_forces.iter().filter_map(|forces| forces.held_in_part()));
        all.extend(parameters.design_forces.iter().filter_map(|forces| forces.of_cutoff()));
        all.extend(parameters.design_forces.iter().flat_map(|forces| forces.withheld()));
        all.extend(judged);
        all
    }

    /// A vertical component of some size that is left out: what it would change.
    fn vertical_left_out(&self) -> Option<Finding> {
        let doubts = self.case.doubts();
        let (vertical_g, horizontal_g) = doubts.iter().find_map(Doubt::vertical_left_out)?;
        let with = || {
            let record = self.case.excitation.with_vertical_left_out()?.ok()?.used().ok()?;
            through(self.assembled, self.springs, &record).ok()?
        };
        // of forces that do not hold, and of a history that ends early, there is nothing to compare
        let checked = self.answer.design.forces.iter().any(|force| force.holds);
        let Some(with) = checked.then(with).flatten() else {
            let (overturns_s, changes) = (None, Vec::new());
            return Some(Finding::VerticalLeftOut {
                vertical_g,
                horizontal_g,
                overturns_s,
                changes,
                predictable_to_s: None,
                checked: false,
            });
        };
        let top = PeakChange {
            quantity: "top displacement".into(),
            unit: "m".into(),
            without: self.peaks().springs.top_displacement_m,
            with: with.top_displacement,
        };
        let change = |(kind, with): (ForceName, f64)| {
            // what is withheld may matter most
            let without = self.answer.design.get(kind)?.others.found.abs();
            let (quantity, unit) = (kind.words().to_string(), kind.unit().to_string());
            Some(PeakChange { quantity, unit, without, with: with.abs() })
        };
        Some(Finding::VerticalLeftOut {
            vertical_g,
            horizontal_g,
            overturns_s: with.overturns,
            changes: [top].into_iter().chain(with.forces.into_iter().filter_map(change)).collect(),
            predictable_to_s: None,
            checked: false,
        })
    }

    fn what_it_does(&self, on: &OnRecord) -> Vec<Finding> {
        let ElasticHistories { reference, fem, sways } = &self.answer.histories;
        let (history, fem) = (&reference.history, fem.outcome);
        let mut all = Vec::new();
        let fell = |outcome: HistoryOutcome| match outcome {
            HistoryOutcome::Overturned { time } => Some(time),
            _ => None,
        };
        let reference_fell = match history.outcome {
            ReferenceOutcome::Overturned { time } => Some(time),
            _ => None,
        };
        all.push(match (fell(fem), reference_fell) {
            (Some(time_s), reference_s) => Finding::Overturns { time_s, reference_s },
            (None, Some(time_s)) => Finding::Overturns { time_s, reference_s: Some(time_s) },
            (None, None) if !history.lifts() => Finding::NeverLifts {
                pga_g: self.record.pga_g(),
                uplift_g: self
                    .assembled
                    .uplift_g()
                    .unwrap_or_else(|| self.assembled.structure.body().alpha().tan()),
            },
            _ => Finding::Stands {
                // a history on springs that ends early is none of the record
                share_of_overturning: match fem.ends_early() {
                    Some(_) => on.peak_ratio_reference,
                    None => on.peak_ratio_fem,
                },
                reference_share: Some(on.peak_ratio_reference),
                over_s: on.compared_s,
                largest_at_s: {
                    let of = usize::from(fem.ends_early().is_none());
                    Some(self.record.dt * largest_at(sways, of) as f64)
                },
                if_feet_hold: false,
                of_columns: matches!(self.assembled.structure, ElasticStructure::Frame(_)),
                tied: false,
            },
        });
        if fell(fem).is_some() != reference_fell.is_some() {
            let words = |time: Option<f64>| {
                time.map_or("stands".into(), |time| format!("overturns at t = {time:.2} s"))
            };
            all.push(Finding::ModelsDisagree {
                reference: words(reference_fell),
                springs: words(fell(fem)),
            });
        }
        if let ReferenceOutcome::Stopped { time, why } = history.outcome {
            all.push(Finding::HistoryEndsEarly {
                model: FindingModel::Reference,
                time_s: time,
                ending: if why == Stop::Work { Ending::WorkBound } else { Ending::Stopped },
            });
        }
        let ending = match fem {
            HistoryOutcome::WorkBound { .. } => Ending::WorkBound,
            HistoryOutcome::Unstable { .. } => Ending::Unstable,
            _ => Ending::Stopped,
        };
        let early =
            |time_s| Finding::HistoryEndsEarly { model: FindingModel::Springs, time_s, ending };
        all.extend(fem.ends_early().map(early));
        all
    }

    /// All that is said of it; `parameters` are those filed.
    pub fn said(&self, parameters: ElasticParameters) -> Run {
        let mut run = alone(parameters);
        let first = self.answer.histories.reference.history.first_lift();
        run.taken.facts.extend(first.map(super::first_lift));
        run.taken.record = Some(self.case.excitation.line());
        run.taken.short_record = Some(self.case.excitation.short_line());
        run.taken.vertical = self.record.vertical.is_some();
        run.taken.assumed = Assumed::all(&self.case.assumptions());
        run.friction_needed = Some(self.friction_needed().0.value);
        run.sap2000 = self.assembled.members == Members::default();
        run.sections.extend(self.comparison(&run));
        run
    }

    fn comparison(&self, run: &Run) -> Option<Section> {
        let FiledParameters::Elastic(parameters) = &run.parameters else { return None };
        let on = parameters.on_record?;
        let number = |x: Option<f64>| x.map_or("-".to_string(), |x| significant(x, 2));
        let rows = [
            ("NRMSE of the rotation", number(on.nrmse_rotation)),
            ("NRMSE of the drift", number(on.nrmse_drift)),
            ("landings of corners on rigid ground", on.landings_reference.to_string()),
            ("landings of corners on springs", on.touches_fem.to_string()),
            ("energy residual", format!("{:.1e}", on.energy_residual)),
        ];
        let rows = rows.map(|(name, value)| vec![name.to_string(), value]);
        let over = if on.whole { "all that is used" } else { "where it can be compared" };
        Some(Section {
            id: "comparison",
            title: format!("The first {} s of the record: {over}", significant(on.compared_s, 4)),
            table: Some(Table::new(["on springs, beside rigid ground", ""]).with(rows)),
            ..Section::default()
        })
    }
}

/// Up to when the motion can be foretold: as far as a deck is `judged` one to one, which is less
/// than springs are compared over; and what comes after.
fn foretold(
    on: &OnRecord,
    judged: Option<&Finding>,
    forces: Option<&DesignForces>,
) -> Option<Finding> {
    let (foretold, slides) = match judged {
        Some(Finding::DeckJudged { judged_s, end: DeckEnd::Foretold, .. }) => (*judged_s, None),
        Some(Finding::DeckJudged { judged_s, end: DeckEnd::Slides, .. }) => {
            (*judged_s, on.slides_on_s.or(Some(*judged_s)))
        }
        _ => (on.foretold_s?, on.slides_on_s),
    };
    let softer_hz = on.softer_omega_n_hz;
    let late = |(name, force): (ForceName, DesignForce)| {
        (force.holds && force.time_s > foretold).then_some(name)
    };
    let later_forces = forces.iter().flat_map(|forces| forces.all()).filter_map(late).collect();
    Some(match slides {
        Some(time_s) => Finding::SlidesOn { time_s, softer_hz, later_forces },
        None => Finding::ForetoldUpTo { time_s: foretold, softer_hz, later_forces },
    })
}

fn nearby(near: &Ensemble, alpha: f64) -> Finding {
    let ratio = |pair: [Option<f64>; 2]| pair.map(|x| x.map(|x| x / alpha));
    Finding::NearMotions {
        motions: near.motions,
        change: near.change,
        median_ratio: ratio(near.rotation_rad.median),
        p90_ratio: ratio(near.rotation_rad.p90),
        overturned: near.overturned,
    }
}

/// Sample of the largest rotation, on rigid ground (0) or on springs (1).
fn largest_at(sways: &[[Sway; 2]], k: usize) -> usize {
    let all = sways.iter().flat_map(|pair| pair[k].rotation.iter().enumerate());
    all.max_by(|(_, a), (_, b)| a.abs().total_cmp(&b.abs())).map_or(0, |(i, _)| i)
}

/// Largest magnitude of a series of every base.
pub fn largest(sways: &[[Sway; 2]], k: usize, of: fn(&Sway) -> &[f64]) -> f64 {
    sways.iter().map(|pair| peak(of(&pair[k])).abs()).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use frames::{assembled::Assembled, structure::ElasticStructure};

    /// On feet 6 m apart.
    pub(super) fn a_frame() -> Assembled {
        let text = "kind = 'aframe'\nheight_m = 24.0\nwidth_m = 6.0\nmass_kg = 3e5\n\
            foot_mass_kg = 1e4\nea_n = 1e10\nei_nm2 = 1e10\ndamping_ratio = 0.03\n";
        let structure: ElasticStructure = toml::from_str(text).unwrap();
        Assembled::new(structure.checked().unwrap()).unwrap()
    }

    /// Springs are compared over 12.2 s, a deck over 4.42 s: so far the motion is foretold.
    #[test]
    fn a_motion_is_foretold_for_as_long_as_its_deck_is_judged() {
        let on = OnRecord {
            compared_s: 12.2,
            foretold_s: Some(12.2),
            slides_on_s: Some(12.2),
            ..OnRecord::default()
        };
        let judged = |end| Finding::DeckJudged { judged_s: 4.42, record_s: 40.0, end };
        let shear = DesignForce { holds: true, time_s: 6.0, ..DesignForce::default() };
        let forces = DesignForces { column_shear_n: Some(shear), ..DesignForces::default() };
        let told = |end| foretold(&on, Some(&judged(end)), Some(&forces)).unwrap();
        let (softer_hz, later_forces) = (None, vec![ForceName::ColumnShear]);
        let until =
            Finding::ForetoldUpTo { time_s: 4.42, softer_hz, later_forces: later_forces.clone() };
        assert_eq!(told(DeckEnd::Foretold), until);
        // without a deck's, and where a corner slides
        let slides = foretold(&on, None, Some(&forces)).unwrap();
        assert!(matches!(slides, Finding::SlidesOn { time_s: 12.2, later_forces, .. }
            if later_forces.is_empty()));
        assert!(matches!(told(DeckEnd::Slides), Finding::SlidesOn { later_forces, .. }
            if later_forces == [ForceName::ColumnShear]));
    }
}
