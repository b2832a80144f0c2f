//! Histories of a range of cells, by Housner in lock-step, by finite elements side by side.

use std::{borrow::Cow, f64::consts::FRAC_PI_2, ops::Range, sync::Arc};

use super::{
    SweepError,
    plan::{Cell, Plan, Subject},
    row::{CellAnswer, CellOutcome, HistoryRow},
    springs::SpringsTable,
};
use dynamics::{
    fem,
    spring::{Chain, Springs},
};
use rocking::{
    housner::{self, Rocking, RockingSummary},
    motion::samples_until,
    structure::Body,
};
use strong_motion::Record;
use validation::{ComparisonObserver, effective_acceleration};

/// Cells that are taken at a time: enough to fill the lanes again where a history ends early.
const LOCK_STEP: usize = 256;
const SIDE_BY_SIDE: usize = 64;

/// The rows of a range of cells, in their order. `done` is told how many more are through.
///
/// # Errors
/// A record that cannot be read, or has no motion.
pub(crate) fn rows(
    plan: &Plan,
    springs: Option<&SpringsTable>,
    cells: Range<u64>,
    done: &(dyn Fn(u64) + Sync),
) -> Result<Vec<HistoryRow>, SweepError> {
    let cells: Vec<Cell> = cells.map(|index| plan.cell(index)).collect();
    let same = |a: &Cell, b: &Cell| {
        a.motion == b.motion
            && (a.subject == b.subject || !plan.motions[a.motion].is_for_structure())
    };
    let groups: Vec<&[Cell]> = cells.chunk_by(same).collect();
    let together = if springs.is_some() { SIDE_BY_SIDE } else { LOCK_STEP };
    let rows = parallel::map(&groups, |group| -> Result<Vec<HistoryRow>, SweepError> {
        let ground = UnscaledGround::new(plan, group[0])?;
        let chunks: Vec<&[Cell]> = group.chunks(together).collect();
        let rows = parallel::map(&chunks, |cells| {
            let rows = ground.rows(plan, springs, cells);
            done(cells.len() as u64);
            rows
        });
        Ok(rows.into_iter().flatten().collect())
    });
    Ok(rows.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect())
}

/// What finite elements answer, and their NRMSE against Housner's history.
type AnswerOnSprings = (CellAnswer, Option<f64>);

/// A ground motion and its peaks, unscaled.
struct UnscaledGround {
    record: Record,
    name: Arc<str>,
    pga: f64,
    pgv: f64,
    vertical: Option<Arc<[f64]>>,
}

impl UnscaledGround {
    fn new(plan: &Plan, cell: Cell) -> Result<Self, SweepError> {
        let Subject { p, alpha, .. } = plan.subjects[cell.subject];
        let motion = &plan.motions[cell.motion];
        let (record, pgv) = motion.ground(&plan.making, (p, alpha))?;
        let pga = record.pga();
        if pga == 0.0 {
            return Err(SweepError::Still { record: record.name });
        }
        let (name, vertical) = (Arc::from(record.name.as_str()), record.vertical_accel());
        Ok(Self { record, name, pga, pgv, vertical })
    }

    fn rows(&self, plan: &Plan, springs: Option<&SpringsTable>, cells: &[Cell]) -> Vec<HistoryRow> {
        let scales: Vec<f64> = cells
            .iter()
            .map(|cell| {
                plan.factor(&plan.subjects[cell.subject], plan.levels[cell.level], self.pga)
            })
            .collect();
        let bodies: Vec<Body<f64>> =
            cells.iter().map(|cell| plan.subjects[cell.subject].body).collect();
        let options: Vec<housner::RockingOptions<f64>> = cells
            .iter()
            .zip(&scales)
            .map(|(cell, &scale)| housner::RockingOptions {
                scale,
                vertical: self.vertical.clone(),
                restitution: Some(plan.restitution(cell.subject, cell.restitution)),
                members: plan.subjects[cell.subject].members,
                ..Default::default()
            })
            .collect();
        let (dt, accel) = (self.record.dt, &self.record.accel);
        let Some(springs) = springs else {
            let rigid = housner::summaries(&bodies, dt, accel, &options);
            return self.rows_of(plan, (cells, &scales), (&rigid, None));
        };
        let rigid = housner::solve_lanes(&bodies, dt, accel, &options);
        let wanted =
            cells.iter().zip(&scales).zip(&rigid).map(|((cell, &scale), rigid)| WantedHistory {
                subject: &plan.subjects[cell.subject],
                springs: springs.of(cell.subject, cell.restitution),
                scale,
                rigid,
            });
        let fem = elements(&wanted.collect::<Vec<_>>(), &self.record);
        let rigid: Vec<RockingSummary> = rigid.iter().map(Rocking::summary).collect();
        self.rows_of(plan, (cells, &scales), (&rigid, Some(&fem)))
    }

    /// Rows of cells and their scales, of what Housner and finite elements say of them.
    fn rows_of(
        &self,
        plan: &Plan,
        (cells, scales): (&[Cell], &[f64]),
        (rigid, fem): (&[RockingSummary], Option<&[AnswerOnSprings]>),
    ) -> Vec<HistoryRow> {
        let row = |(i, cell): (usize, &Cell)| {
            let subject = &plan.subjects[cell.subject];
            let (fem, nrmse) = fem.map(|fem| fem[i]).unzip();
            let nrmse = nrmse.flatten().filter(|_| plan.model.housner());
            HistoryRow {
                cell: cell.index,
                subject: cell.subject,
                motion: cell.motion,
                restitution: plan.restitution(cell.subject, cell.restitution),
                level: plan.levels[cell.level],
                record: self.name.clone(),
                scale: scales[i],
                pga: self.pga * scales[i].abs(),
                pgv: self.pgv * scales[i].abs(),
                housner: plan.model.housner().then(|| of_housner(subject, &rigid[i])),
                fem,
                nrmse,
            }
        };
        cells.iter().enumerate().map(row).collect()
    }
}

/// pi/2 of a body that overturned; it lies, and how far it had fallen at the record's end says
/// nothing.
fn ratio(subject: &Subject, peak: f64, outcome: CellOutcome) -> Option<f64> {
    match outcome {
        CellOutcome::Failed => None,
        CellOutcome::Overturned => Some(FRAC_PI_2 / subject.alpha),
        _ => Some(peak / subject.alpha),
    }
}

fn of_housner(subject: &Subject, rocking: &RockingSummary) -> CellAnswer {
    let outcome = match rocking.outcome {
        housner::RockingOutcome::NeverMoved => CellOutcome::NeverLifted,
        housner::RockingOutcome::Rocked => CellOutcome::Rocked,
        housner::RockingOutcome::Overturned { .. } => CellOutcome::Overturned,
        housner::RockingOutcome::LeavesGround { .. } => CellOutcome::LeavesGround,
        housner::RockingOutcome::WorkBound { .. } | housner::RockingOutcome::NotFinite { .. } => {
            CellOutcome::Failed
        }
    };
    CellAnswer {
        outcome,
        peak: ratio(subject, rocking.peak, outcome),
        impacts: Some(rocking.impacts),
        overturned_s: rocking.overturned(),
    }
}

/// A finite element history that is wanted, and Housner's answer.
pub(super) struct WantedHistory<'a> {
    pub subject: &'a Subject,
    pub springs: Springs<Chain>,
    pub scale: f64,
    pub rigid: &'a Rocking<f64>,
}

impl WantedHistory<'_> {
    /// What to say of a history, and its NRMSE against Housner's.
    fn answer(&self, stream: &ComparisonObserver, finish: &fem::Finish) -> AnswerOnSprings {
        let outcome = match stream.overturned(finish.outcome) {
            Some(true) => CellOutcome::Overturned,
            Some(false) if stream.peak == 0.0 => CellOutcome::NeverLifted,
            Some(false) => CellOutcome::Rocked,
            None => CellOutcome::Failed,
        };
        let outcome = if stream.peak.is_finite() { outcome } else { CellOutcome::Failed };
        let errors =
            if outcome == CellOutcome::Overturned { stream.upright } else { stream.errors };
        let lifted = self.rigid.outcome != housner::RockingOutcome::NeverMoved;
        let nrmse = errors.horizontal.value();
        let nrmse =
            (lifted && outcome != CellOutcome::Failed && nrmse.is_finite()).then_some(nrmse);
        let peak = ratio(self.subject, stream.peak, outcome);
        (CellAnswer { outcome, peak, impacts: None, overturned_s: None }, nrmse)
    }
}

/// Finite element histories on a record, streamed. The one place where histories on springs are
/// computed.
pub(super) fn elements(wanted: &[WantedHistory<'_>], record: &Record) -> Vec<AnswerOnSprings> {
    let scaled =
        |samples: &[f64], scale: f64| -> Vec<f64> { samples.iter().map(|a| a * scale).collect() };
    let grounds: Vec<(Vec<f64>, Vec<f64>)> = wanted
        .iter()
        .map(|w| (scaled(&record.accel, w.scale), scaled(record.up(), w.scale)))
        .collect();
    let pushes: Vec<Cow<[f64]>> =
        grounds.iter().map(|(accel, vertical)| effective_acceleration(accel, vertical)).collect();
    let case = |i: usize| fem::Analysis {
        vertical: &grounds[i].1,
        // peaks and comparisons alone
        control: fem::Control { long_steps: true, ..fem::Control::search() },
        ..fem::Analysis::new(wanted[i].subject.body, wanted[i].springs, record.dt, &grounds[i].0)
    };
    let cases: Vec<fem::Analysis> = (0..wanted.len()).map(case).collect();
    let followed = fem::histories(&cases, |i| {
        let WantedHistory { subject, rigid, .. } = &wanted[i];
        let standing = samples_until(rigid.overturned(), record.dt).min(rigid.theta.len());
        ComparisonObserver::new(&subject.body, &rigid.theta[..standing], &pushes[i])
    });
    followed.iter().zip(wanted).map(|((stream, finish), w)| w.answer(stream, finish)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spec::SweepSource;
    use rocking::members::{Damper, Members, Tendon};
    use rocking::motion::largest_magnitude;

    const FRAME: &str =
        "[[structure]]\nkind = 'aframe'\nheight_m = 8.9\nwidth_m = 2.1\nmass_kg = 120e3\n";
    const MEMBERS: &str = "damper = { c_ns_per_m = 8e4 }\n\
                           [structure.tendon]\nstiffness_n_per_m = 4e7\npretension_n = 2e5\n";

    fn plan(sweep: &str) -> Result<Plan, SweepError> {
        let text = format!(
            "[sweep]\n{sweep}[records]\nel_centro = true\nduration_s = 10.0\n\
             [levels]\nscale = [0.9, 1.2]\n{FRAME}{FRAME}{MEMBERS}"
        );
        Plan::new(&SweepSource::parse("sweep.toml".into(), text).unwrap())
    }

    #[test]
    fn a_tendon_and_dampers_are_in_the_histories_of_their_structure() {
        let plan = plan("kind = 'fragility'\n").unwrap();
        let [bare, held] = [0, 1].map(|i| &plan.subjects[i]);
        assert_eq!(held.name, format!("{}, tendon, dampers", bare.name));
        let members = Members {
            tendon: Some(Tendon { stiffness: 4e7, pretension: 2e5 }),
            damper: Some(Damper { c: 8e4 }),
            friction: None,
        };
        let over = 1.0 + 2e5 / (120e3 * rocking::scalar::GRAVITY);
        assert!((held.lifts_at() / bare.lifts_at() - over).abs() < 1e-12);
        let rows = rows(&plan, None, 0..4, &|_| ()).unwrap();
        let record = Record::el_centro().truncated(10.0);
        for row in rows {
            let subject = &plan.subjects[row.subject];
            let options = housner::RockingOptions {
                scale: row.scale,
                members: if row.subject == 1 { members } else { Members::default() },
                ..Default::default()
            };
            let alone = housner::solve(&subject.body, record.dt, &record.accel, &options);
            let peak = largest_magnitude(&alone.theta) / subject.alpha;
            let found = row.housner.unwrap();
            assert_eq!(found.peak, Some(peak));
            assert_eq!(found.impacts, Some(alone.impacts.len()));
        }
        let hash = |plan: &Plan| plan.inspect(&mut |_| {}).unwrap().hash;
        let mut other = plan.clone();
        other.subjects[1].members.damper = Some(Damper { c: 9e4 });
        assert_ne!(hash(&plan), hash(&other));
    }

    #[test]
    fn a_tendon_and_dampers_on_springs_and_in_spectra_are_refused_with_what_to_do() {
        for sweep in ["kind = 'fragility'\nmodel = 'both'\n", "kind = 'compare'\n"] {
            let told = plan(sweep).unwrap_err().to_string();
            assert!(told.starts_with("sweep.toml, line 1"), "{told}");
            assert!(told.contains("are followed by Housner's equation alone"), "{told}");
        }
    }
}
