//! Incremental dynamic analysis: peak |theta|/alpha against the level, over all records of a
//! structure.

use super::{
    SweepError,
    parts::SweepParts,
    plan::Plan,
    reduce::{self, Histogram, MODELS},
};
use sweep_table::{SweepTable, TableOf};

/// One structure and restitution at one level, by one model.
#[derive(Clone, Debug)]
pub struct IdaPoint {
    /// Index into [`MODELS`].
    pub model: usize,
    /// Index of the structure.
    pub subject: usize,
    /// Index of the restitution.
    pub restitution: usize,
    /// Intensity, in what the sweep measures it by.
    pub level: f64,
    /// Histories.
    pub n: u64,
    /// Histories in which the body lifts.
    pub lifted: u64,
    /// Histories in which it overturns.
    pub overturned: u64,
    /// Failed, or the pivot let go: not in n.
    pub left_out: u64,
    /// Of |theta|/alpha; infinite for a body that overturned.
    peaks: Histogram,
}

/// Peaks of one record against level, for the figure.
#[derive(Clone, Debug)]
pub struct IdaCurve {
    /// Index of the structure.
    pub subject: usize,
    /// Intensities.
    pub levels: Vec<f64>,
    /// Largest theta/alpha at each.
    pub peaks: Vec<f64>,
}

/// All points of a sweep: by model, structure, restitution, level.
#[derive(Clone, Debug)]
pub struct Ida {
    /// The points.
    pub points: Vec<IdaPoint>,
    /// Of some records, the first model and the first restitution.
    pub curves: Vec<IdaCurve>,
}

/// Records whose curves are kept, and structures of which.
const CURVES: usize = 30;
const SUBJECTS: usize = 6;

impl IdaPoint {
    /// A quantile of |theta|/alpha; infinite where that many overturn.
    pub fn quantile(&self, share: f64) -> Option<f64> {
        self.peaks.quantile(share)
    }
}

impl Ida {
    /// Of the parts that are there.
    ///
    /// # Errors
    /// A part that cannot be read.
    pub fn new(parts: &SweepParts) -> Result<Self, SweepError> {
        let plan = parts.plan;
        let models = reduce::models(plan);
        let (subjects, restitutions, levels) =
            (plan.subjects.len(), plan.restitution_count(), plan.levels.len());
        let mut points = Vec::new();
        for &model in &models {
            for subject in 0..subjects {
                for restitution in 0..restitutions {
                    points.extend(plan.levels.iter().map(|&level| {
                        let (n, lifted, overturned, left_out) = (0, 0, 0, 0);
                        let peaks = Histogram::default();
                        IdaPoint {
                            model,
                            subject,
                            restitution,
                            level,
                            n,
                            lifted,
                            overturned,
                            left_out,
                            peaks,
                        }
                    }));
                }
            }
        }
        let stride = plan.motions.len().div_ceil(CURVES);
        let mut curves: Vec<IdaCurve> = Vec::new();
        let mut last = None;
        reduce::each(parts, |seen| {
            let cell = seen.cell;
            for (place, &model) in models.iter().enumerate() {
                let at = ((place * subjects + cell.subject) * restitutions + cell.restitution)
                    * levels
                    + cell.level;
                let point = &mut points[at];
                let Some(known) = &seen.answers[model] else {
                    point.left_out += 1;
                    continue;
                };
                point.n += 1;
                point.lifted += u64::from(known.peak > 0.0);
                point.overturned += u64::from(known.overturned);
                let peak = if known.overturned { f64::INFINITY } else { known.peak };
                point.peaks.add(peak);
                let wanted =
                    place == 0 && cell.restitution == 0 && cell.subject < SUBJECTS && levels > 1;
                if wanted && cell.motion.is_multiple_of(stride) {
                    let key = (cell.motion, cell.subject);
                    if last.replace(key) != Some(key) {
                        curves.push(IdaCurve {
                            subject: cell.subject,
                            levels: Vec::new(),
                            peaks: Vec::new(),
                        });
                    }
                    if let Some(curve) = curves.last_mut() {
                        curve.levels.push(point.level);
                        curve.peaks.push(peak);
                    }
                }
            }
        })?;
        Ok(Self { points, curves })
    }

    /// `ida.csv`.
    pub fn table(&self, plan: &Plan) -> SweepTable {
        let share = |k: u64, n: u64| (n > 0).then(|| k as f64 / n as f64);
        TableOf::new(&self.points)
            .text("model", |point| MODELS[point.model])
            .text("structure", |point| plan.subjects[point.subject].name.clone())
            .real("alpha", |point| Some(plan.subjects[point.subject].alpha))
            .real("p_per_s", |point| Some(plan.subjects[point.subject].p))
            .real("restitution", |point| Some(plan.restitution(point.subject, point.restitution)))
            .real("level", |point| Some(point.level))
            .count("histories", |point| point.n)
            .count("left_out", |point| point.left_out)
            .real("share_rocking", |point| share(point.lifted, point.n))
            .real("share_overturned", |point| share(point.overturned, point.n))
            .real("peak_16", |point| point.quantile(0.16))
            .real("peak_50", |point| point.quantile(0.5))
            .real("peak_84", |point| point.quantile(0.84))
            .table()
    }
}
