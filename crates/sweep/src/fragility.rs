//! Fragility of a sweep: lognormal fits of rocking, of exceeding given theta/alpha, and of
//! overturning, on four measures of intensity, for each structure and for all of them together.
//!
//! One pass counts outcomes in bins of 0.1 % of each measure, the fits are made from these, and a
//! second pass sums their scores by record for the bounds (`lognormal`). Histories that failed, or
//! whose pivot let go of the ground, are left out and counted.

mod fits;
mod row;

use std::collections::HashMap;

use super::{
    SweepError,
    lognormal::{LognormalFit, SymmetricMatrix, quantile},
    parts::SweepParts,
    plan::Plan,
    reduce::{self, MODELS, SeenHistory},
};
use fits::{bounds, fits};
use sweep_table::{SweepTable, TableOf};

/// What is exceeded or not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LimitState {
    /// The body lifts.
    Rocking,
    /// |theta|/alpha.
    Ratio(f64),
    /// The body overturns.
    Overturning,
}

impl LimitState {
    /// All that a plan asks for.
    pub fn all(plan: &Plan) -> Vec<Self> {
        let ratios = plan.ratios.iter().map(|ratio| Self::Ratio(*ratio));
        std::iter::once(Self::Rocking).chain(ratios).chain([Self::Overturning]).collect()
    }

    /// As tables name it.
    pub fn name(self) -> String {
        match self {
            Self::Rocking => "rocking".into(),
            Self::Ratio(ratio) => format!("theta/alpha > {ratio}"),
            Self::Overturning => "overturning".into(),
        }
    }
}

/// The measures of intensity, and their units.
pub const MEASURES: [(&str, &str); 4] =
    [("PGA", "g"), ("PGV", "m/s"), ("PGA/(g tan alpha)", "-"), ("p PGV/(g tan alpha)", "-")];

/// Width of a bin of ln x.
const BIN: f64 = 1e-3;

#[derive(Clone, Debug)]
struct Bin {
    n: u64,
    sum_ln: f64,
    k: Vec<u64>,
}

/// One structure, or all of them, by one model.
#[derive(Clone, Debug)]
pub struct FragilityGroup {
    /// Index into [`MODELS`].
    pub model: usize,
    /// None: all structures together.
    pub subject: Option<usize>,
    /// Index of the restitution.
    pub restitution: usize,
    bins: [HashMap<i32, Bin>; 4],
    /// Histories that count for nothing: the model could not answer.
    pub excluded: u64,
    /// The last record that counts, and how many do: one whose histories are all left out says
    /// nothing.
    last: Option<usize>,
    /// Motions.
    pub records: usize,
}

/// A fit with all that the tables say of it.
#[derive(Clone, Debug)]
pub struct FragilityRow {
    /// Index of its group.
    pub member: usize,
    /// What is exceeded or not.
    pub state: LimitState,
    /// Index into [`MEASURES`].
    pub measure: usize,
    /// Histories.
    pub n: u64,
    /// Histories that exceed it.
    pub exceeded: u64,
    /// The least and the greatest intensity that was computed.
    pub range: (f64, f64),
    /// What they say.
    pub fit: LognormalFit,
    /// Of (a, b).
    pub covariance: Option<SymmetricMatrix>,
}

/// The fragility of a sweep.
#[derive(Clone, Debug)]
pub struct Fragility {
    /// The groups.
    pub members: Vec<FragilityGroup>,
    /// The fits.
    pub rows: Vec<FragilityRow>,
    /// Level of the bounds: 0.9 of 90 %.
    pub confidence: f64,
}

fn measures(plan: &Plan, seen: &SeenHistory) -> [f64; 4] {
    let subject = &plan.subjects[seen.cell.subject];
    let uplift = subject.uplift();
    [
        seen.pga / rocking::scalar::GRAVITY,
        seen.pgv,
        seen.pga / uplift,
        subject.p * seen.pgv / uplift,
    ]
}

fn bin(x: f64) -> i32 {
    (x.ln() / BIN).floor() as i32
}

fn exceeds(state: LimitState, known: &reduce::KnownAnswer) -> bool {
    match state {
        LimitState::Rocking => known.peak > 0.0,
        LimitState::Ratio(ratio) => known.overturned || known.peak > ratio,
        LimitState::Overturning => known.overturned,
    }
}

/// Where the members of a model, structure and restitution stand.
struct GroupPlaces<'a> {
    plan: &'a Plan,
    models: Vec<usize>,
    /// Structures, and one place more for all of them if there are several.
    subjects: usize,
}

impl<'a> GroupPlaces<'a> {
    fn new(plan: &'a Plan) -> Self {
        let n = plan.subjects.len();
        Self { plan, models: reduce::models(plan), subjects: if n > 1 { n + 1 } else { n } }
    }

    fn members(&self) -> Vec<FragilityGroup> {
        let mut members = Vec::new();
        for &model in &self.models {
            for subject in 0..self.subjects {
                for restitution in 0..self.plan.restitution_count() {
                    let subject = (subject < self.plan.subjects.len()).then_some(subject);
                    let (bins, excluded, records) = (Default::default(), 0, 0);
                    members.push(FragilityGroup {
                        model,
                        subject,
                        restitution,
                        bins,
                        excluded,
                        last: None,
                        records,
                    });
                }
            }
        }
        members
    }

    /// The members that a history counts in, each with its model.
    fn of(&self, seen: &SeenHistory) -> impl Iterator<Item = (usize, usize)> {
        let (subjects, restitutions) = (self.subjects, self.plan.restitution_count());
        let (subject, restitution) = (seen.cell.subject, seen.cell.restitution);
        let pooled = (subjects > self.plan.subjects.len()).then_some(subjects - 1);
        self.models.clone().into_iter().enumerate().flat_map(move |(place, model)| {
            let at =
                move |subject| ((place * subjects + subject) * restitutions + restitution, model);
            [Some(subject), pooled].into_iter().flatten().map(at)
        })
    }
}

impl Fragility {
    /// Of the parts that are there.
    ///
    /// # Errors
    /// A part that cannot be read.
    pub fn new(parts: &SweepParts) -> Result<Self, SweepError> {
        let plan = parts.plan;
        let (places, states) = (GroupPlaces::new(plan), LimitState::all(plan));
        let mut members = places.members();
        reduce::each(parts, |seen| {
            let xs = measures(plan, seen);
            for (place, model) in places.of(seen) {
                let member = &mut members[place];
                let Some(known) = &seen.answers[model] else {
                    member.excluded += 1;
                    continue;
                };
                if member.last != Some(seen.cell.motion) {
                    member.last = Some(seen.cell.motion);
                    member.records += 1;
                }
                for (bins, x) in member.bins.iter_mut().zip(xs) {
                    let bin = bins.entry(bin(x)).or_insert_with(|| Bin {
                        n: 0,
                        sum_ln: 0.0,
                        k: vec![0; states.len()],
                    });
                    bin.n += 1;
                    bin.sum_ln += x.ln();
                    for (k, state) in bin.k.iter_mut().zip(&states) {
                        *k += u64::from(exceeds(*state, known));
                    }
                }
            }
        })?;
        let mut rows = fits(&members, &states);
        bounds(parts, &places, &members, &states, &mut rows)?;
        Ok(Self { members, rows, confidence: plan.confidence })
    }

    /// Half the width of the bounds in standard deviations.
    pub fn half_width(&self) -> f64 {
        quantile(0.5 + 0.5 * self.confidence)
    }

    /// Shares observed for a row: geometric means of the intensity and shares of about equally many
    /// histories each.
    pub fn observed(
        &self,
        row: &FragilityRow,
        states: &[LimitState],
        points: usize,
    ) -> Vec<(f64, f64)> {
        let Some(state) = states.iter().position(|state| *state == row.state) else {
            return Vec::new();
        };
        let sorted = sorted(&self.members[row.member].bins[row.measure]);
        let wanted = (row.n / points.max(1) as u64).max(1);
        let (mut found, mut n, mut k, mut sum) = (Vec::new(), 0, 0, 0.0);
        for bin in sorted {
            (n, k, sum) = (n + bin.n, k + bin.k[state], sum + bin.sum_ln);
            if n >= wanted {
                found.push(((sum / n as f64).exp(), k as f64 / n as f64));
                (n, k, sum) = (0, 0, 0.0);
            }
        }
        found
    }

    /// `fragility.csv`.
    pub fn table(&self, plan: &Plan) -> SweepTable {
        let member = |row: &FragilityRow| &self.members[row.member];
        let bounds = |row: &FragilityRow| row.bounds(self.half_width());
        let restitution = |row: &FragilityRow| {
            let member = member(row);
            match (member.subject, &plan.restitutions) {
                (_, Some(all)) => Some(all[member.restitution]),
                (Some(subject), None) => Some(plan.subjects[subject].restitution),
                (None, None) => None,
            }
        };
        TableOf::new(&self.rows)
            .text("model", |row| MODELS[member(row).model])
            .text("structure", |row| subject_name(plan, member(row).subject))
            .real("restitution", restitution)
            .text("state", |row| row.state.name())
            .text("measure", |row| MEASURES[row.measure].0)
            .text("unit", |row| MEASURES[row.measure].1)
            .count("histories", |row| row.n)
            .count("exceeded", |row| row.exceeded)
            .count("left_out", |row| member(row).excluded)
            .count("records", |row| member(row).records as u64)
            .text("fit", |row| row.said())
            .real("median", |row| row.median())
            .real("median_low", |row| Some(bounds(row)?.median.0))
            .real("median_high", |row| Some(bounds(row)?.median.1))
            .flag("extrapolated", |row| Some(row.is_extrapolated()))
            .real("beta", |row| Some(row.probit()?.beta()))
            .real("beta_low", |row| Some(bounds(row)?.beta.0))
            .real("beta_high", |row| Some(bounds(row)?.beta.1))
            .real("log_likelihood", |row| Some(row.probit()?.log_likelihood))
            .table()
    }
}

/// A structure's name, or that it is all of them.
pub(crate) fn subject_name(plan: &Plan, subject: Option<usize>) -> String {
    subject.map_or("all structures".into(), |subject| plan.subjects[subject].name.clone())
}

fn sorted(bins: &HashMap<i32, Bin>) -> Vec<&Bin> {
    let mut sorted: Vec<(&i32, &Bin)> = bins.iter().collect();
    sorted.sort_by_key(|(bin, _)| **bin);
    sorted.into_iter().map(|(_, bin)| bin).collect()
}
