//! An elastic structure in a program with fixed time steps: its springs, with substeps at touches
//! too, and what the emulation of such a program finds of it.

use dynamics::spring::{Chain, Springs};
use fixed_steps::{
    FixedStepAnalysis, FixedStepFrame, FixedStepFrameHistory, FixedStepOutcome, GaveUp,
    MemberDamping, StepSettings,
};
use frames::{Mechanics, assembled::Assembled, frame::EquilibriumError};
use nalgebra::DVector;
use parameters::{
    corner::CornerRow,
    program::{CornerUnits, ProgramRow},
};
use rocking::scalar::GRAVITY;
use springs::elastic::program::for_substep;
use strong_motion::Record;

use crate::{
    DeckFormat, ExportError,
    stepping::{EvenSteps, Stepping},
};

/// By how much stronger motions are that a history is to be told from: a deck's arms, its own
/// iteration and rounding make as much of a difference. In OpenSees histories of piers under HHT
/// and TRBDF2 part where one of a motion 1e-4 stronger or weaker does, not where 1e-5 shows.
const STRONGER: [f64; 4] = [1e-5, -1e-5, 1e-4, -1e-4];
/// Part of the largest displacement beyond which two histories have parted: a tenth of what a deck
/// allows.
const PARTED: f64 = 1e-3;

/// Springs of an elastic structure for a program with fixed time steps, and how it steps.
#[derive(Clone, Debug, PartialEq)]
pub struct CornerProgram {
    /// The program, on the springs for its steps.
    pub row: ProgramRow<CornerUnits>,
    /// Substeps of a step at touches; 1: none.
    touches: usize,
}

impl CornerProgram {
    /// All steps alike, on the springs of a run.
    pub fn even(row: &ProgramRow<CornerUnits>) -> Self {
        Self { row: row.clone(), touches: 1 }
    }

    /// The same, or with substeps at touches on springs for these, at the K of a run's.
    ///
    /// # Errors
    /// A structure that does not stand, as many units as corners are needed.
    pub fn new(
        assembled: &Assembled,
        row: &ProgramRow<CornerUnits>,
        stepping: Stepping,
    ) -> Result<Self, ExportError> {
        let touches = stepping.at_touches();
        let even = Self::even(row);
        if touches == 1 {
            return Ok(even);
        }
        let failed = |message: &str| ExportError::Steps { message: message.into() };
        let chains = row.units.chains();
        let first = chains.first().map(|corner| corner.vertical.k2 / corner.vertical.k1);
        let k = first.ok_or_else(|| failed("the program has no springs; tune run makes them"))?;
        let found = for_substep(assembled, k, row.step_s / touches as f64)
            .ok_or_else(|| failed("the structure does not stand; make it wider"))?;
        let corner = |(of, springs): (&CornerRow, &Springs<Chain>)| CornerRow {
            vertical: (&springs.vertical).into(),
            horizontal: (&springs.horizontal).into(),
            ..*of
        };
        let springs = row.units.springs.iter().zip(&found.corners).map(corner).collect();
        let units = CornerUnits { springs };
        Ok(Self { row: ProgramRow { units, ..even.row }, touches })
    }

    /// Settings of its steps.
    pub(crate) fn steps(&self) -> EvenSteps {
        EvenSteps::new(&self.row, self.touches)
    }

    /// Emulated through a record.
    ///
    /// # Errors
    /// As many units as corners are needed.
    pub fn history(
        &self,
        assembled: &Assembled,
        record: &Record,
    ) -> Result<CornerHistory, ExportError> {
        self.history_with(assembled, record, MemberDamping::of_program(self.row.name))
    }

    /// The same in the program that a deck of this format is for.
    ///
    /// # Errors
    /// The same.
    pub fn history_in_deck(
        &self,
        assembled: &Assembled,
        record: &Record,
        format: DeckFormat,
    ) -> Result<CornerHistory, ExportError> {
        self.history_with(assembled, record, self.damping_in(format))
    }

    /// Whether a deck of this format is for the program itself.
    pub fn is_of(&self, format: DeckFormat) -> bool {
        self.damping_in(format) == MemberDamping::of_program(self.row.name)
    }

    /// What dashpots of members resist where this format is used: tables of springs are typed into
    /// the program itself.
    fn damping_in(&self, format: DeckFormat) -> MemberDamping {
        match format {
            DeckFormat::Csv | DeckFormat::Markdown => MemberDamping::of_program(self.row.name),
            _ => format.member_damping(),
        }
    }

    fn history_with(
        &self,
        assembled: &Assembled,
        record: &Record,
        damping: MemberDamping,
    ) -> Result<CornerHistory, ExportError> {
        let frame = &assembled.frame;
        let failed = |e: EquilibriumError| ExportError::Steps { message: e.to_string() };
        let springs = self.row.units.chains();
        let still = DVector::zeros(frame.size());
        let weight = frame.whole_mass(&still) * GRAVITY;
        let model = FixedStepFrame::new(frame, &springs).map_err(failed)?;
        let settings = StepSettings { damping, ..self.steps().settings(weight) };
        let analysis = FixedStepAnalysis::new(&model, settings, record.dt, &record.accel);
        let analysis = FixedStepAnalysis { vertical: record.up(), ..analysis };
        let FixedStepFrameHistory { coordinates, outcome, work } =
            analysis.history().map_err(failed)?;
        let [gives_up_s, falls_s] = match outcome {
            FixedStepOutcome::GaveUp(GaveUp { time, .. }) => [Some(time), None],
            FixedStepOutcome::Fallen { time } => [None, Some(time)],
            FixedStepOutcome::Finished => [None; 2],
        };
        let mut history = CornerHistory { coordinates, gives_up_s, falls_s, foretold_s: None };
        if damping == MemberDamping::OfChanges {
            // a step whose half fails, too, has an end that depends on the iteration, which is not
            // the same in two programs
            let mut ends = vec![work.part_failed_s];
            for by in STRONGER {
                let beside = FixedStepAnalysis { scale: 1.0 + by, ..analysis.clone() }.history();
                let beside = beside.map_err(failed)?;
                let parts = history.parts_from(&beside.coordinates, assembled, record.dt);
                ends.extend([beside.work.part_failed_s, parts]);
            }
            history.foretold_s = ends.into_iter().flatten().min_by(f64::total_cmp);
        }
        Ok(history)
    }
}

/// A structure's history in a program with fixed time steps.
#[derive(Clone, Debug, PartialEq)]
pub struct CornerHistory {
    /// The structure's coordinates at every sample.
    pub coordinates: Vec<Vec<f64>>,
    /// When the program gives up, if it does (s).
    pub gives_up_s: Option<f64>,
    /// When the structure has fallen over, if it does: the history ends there (s).
    pub falls_s: Option<f64>,
    /// Up to when OpenSees can be expected to find the same (s), of a history for OpenSees: to its
    /// end if none. It need not from where a motion a little stronger or weaker makes another
    /// history, nor from the first step on of which a half fails, too.
    pub foretold_s: Option<f64>,
}

impl CornerHistory {
    /// Up to when a history of a slightly other motion stays with this one (s), at the node that
    /// a deck checks; none if to its end.
    fn parts_from(&self, beside: &[Vec<f64>], assembled: &Assembled, dt: f64) -> Option<f64> {
        let top = assembled.watched.first().map_or(0, |watched| watched.top);
        let [ours, theirs] = [&self.coordinates[..], beside].map(|all| {
            let place = |q: &Vec<f64>| assembled.frame.displacement(top, q);
            all.iter().map(place).collect::<Vec<_>>()
        });
        let peak = ours.iter().map(|[x, ..]| x.abs()).fold(0.0, f64::max);
        let apart = |([x, z, _], [x1, z1, _]): (&[f64; 3], &[f64; 3])| {
            (x - x1).hypot(z - z1) > PARTED * peak
        };
        let first = ours.iter().zip(&theirs).position(apart)?;
        Some(first.saturating_sub(1) as f64 * dt)
    }
}
