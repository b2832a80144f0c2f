//! What `tune validate` judges: the springs of a run, and how their histories are stepped.

use serde::Serialize;

use super::{CommandError, terminal};
use decks::{Stepping, stepped_model};
use dynamics::fem;
use fixed_steps::{Integrator, ProgramName};
use parameters::Parameters;
use results::NotToBeUsed;
use validation::JudgedModel;

/// The program whose steps are emulated.
#[derive(Serialize)]
pub(super) struct JudgedProgram {
    /// As `[program]` names it; none: any program with this integrator.
    #[serde(rename = "for", skip_serializing_if = "Option::is_none")]
    name: Option<ProgramName>,
    /// (s)
    step_s: f64,
    integrator: Integrator,
    /// Substeps of a step at touches; 1: none.
    substeps_at_touches: usize,
    /// I_cg that the program's model has.
    rotational_inertia_kgm2: f64,
}

/// Springs to be judged.
pub(super) struct JudgedSprings {
    /// The run's, with the springs that are judged.
    pub parameters: Parameters,
    pub model: JudgedModel,
    /// None of steps that follow touches.
    pub program: Option<JudgedProgram>,
    /// How histories are stepped, in words, where a program is emulated.
    pub steps: Option<String>,
    /// Whether the run refuses these springs, and why.
    pub not_to_be_used: Option<NotToBeUsed>,
}

impl JudgedSprings {
    /// Say what of the run is left out, and whether it refuses these springs.
    pub fn tell(&self) {
        if !self.parameters.members().is_none() {
            terminal::stderr(format_args!(
                "dampers, tendon and friction are left out: both models are of the rigid body alone"
            ));
        }
        if let Some(why) = self.not_to_be_used {
            terminal::stderr(format_args!("these springs are {why}"));
        }
    }

    /// Those of a run for such steps.
    ///
    /// # Errors
    /// A run without springs for a program.
    pub fn new(parameters: Parameters, stepping: Stepping) -> Result<Self, CommandError> {
        if stepping == Stepping::Events {
            let (springs, control) = (parameters.chains(), fem::Control::default());
            let model = JudgedModel::Events { springs, control };
            let (program, steps, not_to_be_used) = (None, None, None);
            return Ok(Self { parameters, model, program, steps, not_to_be_used });
        }
        let Some(row) = &parameters.program else {
            let why = match parameters.members().is_none() {
                true => stepped_model(&parameters, stepping).err().map(|why| why.with_options()),
                false => None,
            };
            let why = why.as_deref().and_then(|why| why.strip_prefix("export: "));
            let why = why.unwrap_or(
                "springs for steps of one size are not made for dampers, tendons and friction; \
                 give --stepping events",
            );
            return Err(CommandError::Result(format!("validate: {why}")));
        };
        let stepped = stepped_model(&parameters, stepping)?;
        let (model, settings) = (stepped.model, stepped.settings);
        let touches = settings.at_touches;
        let program = JudgedProgram {
            name: row.name,
            step_s: row.step_s,
            integrator: row.integrator,
            substeps_at_touches: touches,
            rotational_inertia_kgm2: stepped.parameters.structure.rotational_inertia_kgm2,
        };
        let at_touches =
            if touches > 1 { format!(", {touches} substeps at touches") } else { String::new() };
        let steps = format!(
            "steps: {}, {}, {} s each{at_touches}, emulated",
            row.program(),
            row.integrator.words(),
            row.step_s
        );
        // that verdict is of the springs for even steps
        let not_to_be_used = row.not_to_be_used().filter(|_| stepping == Stepping::Even);
        let (vertical, horizontal) = (stepped.parameters.vertical, stepped.parameters.horizontal);
        Ok(Self {
            parameters: Parameters { vertical, horizontal, ..parameters },
            model: JudgedModel::Even { model, settings },
            program: Some(program),
            steps: Some(steps),
            not_to_be_used,
        })
    }
}
