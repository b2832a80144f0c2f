//! What a deck for a program with steps of one size holds, to be stepped here.

use fixed_steps::{FixedStepBody, StepSettings};
use parameters::Parameters;
use springs::landing_simulation::differs_from_housner;

use crate::{
    ExportError,
    stepping::{Stepped, Stepping},
};

/// A rigid body on the springs for a program with steps of one size.
#[derive(Clone, Debug)]
pub struct SteppedModel {
    /// Its structure and springs, as parameters.
    pub parameters: Parameters,
    /// What is stepped.
    pub model: FixedStepBody,
    /// How.
    pub settings: StepSettings,
}

/// The model that a deck of such a program has.
///
/// # Errors
/// Parameters without springs for such a program.
pub fn stepped_model(
    parameters: &Parameters,
    stepping: Stepping,
) -> Result<SteppedModel, ExportError> {
    let stepped = Stepped::new(parameters, stepping)?;
    let (model, settings) = stepped.model();
    Ok(SteppedModel { parameters: stepped.parameters, model, settings })
}

impl ExportError {
    /// Why parameters have no springs for such a program.
    pub(crate) fn no_program(parameters: &Parameters) -> Self {
        let (asked, body) = (parameters.restitution(), parameters.structure.body::<f64>());
        match differs_from_housner(&body, asked) {
            true => Self::ProgramRestitution { asked, due: body.restitution() },
            false => Self::NoProgram,
        }
    }
}
