//! An elastic structure in a program with fixed time steps: its springs, with substeps at touches
//! too, and what the emulation of such a program finds of it.

use dynamics::spring::{Chain, Springs};
use fixed_steps::{FixedStepAnalysis, FixedStepFrame, FixedStepOutcome, GaveUp};
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
    ExportError,
    stepping::{EvenSteps, Stepping},
};

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

    /// Emulated through a record: the structure's coordinates at every sample, and when the program
    /// gives up, if it does (s).
    ///
    /// # Errors
    /// As many units as corners are needed.
    pub fn history(
        &self,
        assembled: &Assembled,
        record: &Record,
    ) -> Result<(Vec<Vec<f64>>, Option<f64>), ExportError> {
        let frame = &assembled.frame;
        let failed = |e: EquilibriumError| ExportError::Steps { message: e.to_string() };
        let springs = self.row.units.chains();
        let still = DVector::zeros(frame.size());
        let weight = frame.whole_mass(&still) * GRAVITY;
        let model = FixedStepFrame::new(frame, &springs).map_err(failed)?;
        let settings = self.steps().settings(weight);
        let analysis = FixedStepAnalysis::new(&model, settings, record.dt, &record.accel);
        let analysis = FixedStepAnalysis { vertical: record.up(), ..analysis };
        let history = analysis.history().map_err(failed)?;
        let gives_up = match history.outcome {
            FixedStepOutcome::GaveUp(GaveUp { time, .. }) => Some(time),
            _ => None,
        };
        Ok((history.coordinates, gives_up))
    }
}
