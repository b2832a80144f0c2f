//! Decks for programs with steps of one size: their springs, their settings, and what the emulation
//! of such a program finds of them.

use files::message::significant;
use fixed_steps::{
    FixedStepAnalysis, FixedStepBody, FixedStepHistory, FixedStepOutcome, FixedStepSprings, GaveUp,
    Integrator, ProgramName, StepSettings,
    iteration::{ConvergenceTest, Iteration},
    recipe::TOLERANCE,
};
use parameters::{
    Parameters,
    program::{FootUnits, ProgramErrors, ProgramRow, ProgramTest},
};
use results::NotToBeUsed;
use rocking::{
    motion::{Motion, samples_until},
    scalar::GRAVITY,
    structure::Structure,
};
use springs::fixed_steps::DesignNumbers;
use strong_motion::Record;

use crate::{
    DeckFormat, Expected, ExportError,
    beside::housner_beside,
    even_ends::EvenEnds,
    export_model, member,
    model::{ACCURACY, DeckModel, with_inertia},
    samples_to_fall,
};

/// How the program that a deck is for steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stepping {
    /// Shortened towards touches and lifts, whatever the springs.
    #[default]
    Events,
    /// All alike, on the springs for such a program, those of `Parameters::program`.
    Even,
    /// Alike but for substeps at touches, on springs for these, in decks for OpenSees.
    Touches,
}

impl Stepping {
    const ALL: [(&'static str, Self); 3] =
        [("events", Self::Events), ("even", Self::Even), ("touches", Self::Touches)];

    /// Substeps of a step at touches; 1: none.
    pub(crate) fn at_touches(self) -> usize {
        if self == Self::Touches { AT_TOUCHES } else { 1 }
    }
}

impl std::str::FromStr for Stepping {
    type Err = ExportError;

    fn from_str(name: &str) -> Result<Self, ExportError> {
        let found = Self::ALL.into_iter().find(|(known, _)| *known == name);
        found
            .map(|(_, stepping)| stepping)
            .ok_or_else(|| ExportError::Stepping { name: crate::printable(name) })
    }
}

/// Substeps of a step at touches: with 20 the floor of a step of 1 ms is that of 50 us.
const AT_TOUCHES: usize = 20;

/// Settings of steps of one size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EvenSteps {
    /// (s)
    pub step: f64,
    pub integrator: Integrator,
    /// A step that fails is halved, down to one in so many.
    pub substeps: usize,
    /// Substeps of a step at touches; 1: none.
    pub touches: usize,
    /// Newton's iterations at most.
    pub newton: usize,
    /// Unbalance over weight below which they have arrived, where the program tests that.
    pub unbalance: Option<f64>,
    /// Whether the mass has some rotational inertia because such steps need it.
    pub adds_inertia: bool,
    /// Whether the springs are of no use in such steps, and why.
    pub not_to_be_used: Option<NotToBeUsed>,
    /// What they were measured to err on the motions that they are judged on, and on
    /// earthquake-like ones.
    pub errors: [Option<ProgramErrors>; 2],
    /// Whether the program is ETABS.
    pub etabs: bool,
    /// Where a deck of them ends.
    pub ends: EvenEnds,
}

impl EvenSteps {
    pub(crate) fn new<U>(row: &ProgramRow<U>, touches: usize) -> Self {
        let unbalance = match row.converged {
            // the program's own test knows no substeps
            ProgramTest::UnbalanceOverWeight(most) if touches == 1 => Some(most),
            _ => None,
        };
        Self {
            step: row.step_s,
            integrator: row.integrator,
            substeps: row.substeps,
            touches,
            newton: row.newton_iterations,
            unbalance,
            adds_inertia: false,
            not_to_be_used: row.not_to_be_used(),
            errors: [row.expected.synthetic, row.expected.earthquakes],
            etabs: row.is_etabs(),
            ends: EvenEnds::default(),
        }
    }

    /// Why the springs are not to be used; those for substeps at touches were not measured.
    pub(crate) fn warning(&self) -> Option<NotToBeUsed> {
        self.not_to_be_used.filter(|_| self.touches == 1)
    }

    /// Newton's displacement tolerance (m).
    pub(crate) fn tolerance(&self) -> f64 {
        TOLERANCE * GRAVITY * (self.step / self.touches as f64).powi(2)
    }

    /// From when on dashpots of beams work in OpenSees (s): after the first step, wherever in it an
    /// integrator takes its forces.
    pub(crate) fn damped_from(&self) -> f64 {
        1.2 * self.step
    }

    /// As the emulation steps a structure without dampers in its members.
    pub(crate) fn settings(&self, weight: f64) -> StepSettings {
        let test = match self.unbalance {
            Some(most) => ConvergenceTest::Unbalance(most * weight),
            None => ConvergenceTest::Increment(self.tolerance()),
        };
        let iteration = Iteration { constant: 0, newton: self.newton, test };
        let settings = StepSettings { iteration, ..StepSettings::new(self.integrator, self.step) };
        settings
            .with_touches(self.touches)
            .with_substeps(1.0 / (self.substeps * self.touches) as f64)
    }

    /// What such steps err in the largest displacement, measured by the run; nothing where it
    /// measured none.
    pub(crate) fn errors(&self) -> Option<String> {
        let percent = |x: f64| format!("{} %", significant(100.0 * x, 2));
        let on = [" motions", " earthquake-like ones"];
        let told = self.errors.iter().zip(on).filter_map(|(errors, on)| {
            let ProgramErrors { histories, lost, peak: [median, most], .. } = errors.as_ref()?;
            let lost = match lost {
                0 => String::new(),
                lost => format!(" (it fails on {lost})"),
            };
            let most = most.map_or(String::new(), |most| format!(", {} (90 %)", percent(most)));
            Some(format!("{} (median){most} on {histories}{on}{lost}", percent((*median)?)))
        });
        let told = told.collect::<Vec<_>>().join("; ");
        (!told.is_empty())
            .then(|| format!("with such steps the largest displacement errs by {told}"))
    }

    /// Where in a step forces are taken: 1 + alpha of HHT, else its end.
    pub(crate) fn forces_at(&self) -> f64 {
        match self.integrator {
            Integrator::Hht { alpha } => 1.0 + alpha,
            _ => 1.0,
        }
    }

    /// Nothing if SAP2000's tables have the integrator.
    pub(crate) fn in_tables(&self) -> Result<(), ExportError> {
        let Self { integrator, .. } = self;
        match ProgramName::Sap2000.has(*integrator) {
            true => Ok(()),
            false => {
                let name = integrator.to_string();
                Err(ExportError::Integrator { name, program: "SAP2000" })
            }
        }
    }

    /// OpenSees' arguments of the integrator.
    pub(crate) fn in_opensees(&self) -> Result<Vec<String>, ExportError> {
        let number = |x: f64| format!("{x:?}");
        Ok(match self.integrator {
            Integrator::Newmark { gamma, beta } => {
                vec!["Newmark".into(), number(gamma), number(beta)]
            }
            Integrator::Hht { alpha } => vec!["HHT".into(), number(1.0 + alpha)],
            Integrator::Trbdf2 => vec!["TRBDF2".into()],
            Integrator::BackwardEuler => vec!["BackwardEuler".into()],
            Integrator::GeneralizedAlpha { .. } => {
                return Err(ExportError::Integrator {
                    name: self.integrator.to_string(),
                    program: "OpenSees",
                });
            }
        })
    }
}

/// The model for a program with steps of one size, or with substeps at touches: its springs and
/// settings, and what the emulation finds on a record.
pub(crate) struct Stepped {
    pub parameters: Parameters,
    pub steps: EvenSteps,
    /// The structure as it was given.
    pub given: Structure,
}

impl Stepped {
    pub(crate) fn new(parameters: &Parameters, stepping: Stepping) -> Result<Self, ExportError> {
        let Some(row) = &parameters.program else {
            return Err(ExportError::no_program(parameters));
        };
        let FootUnits { vertical, horizontal, .. } = row.units;
        // as decks hold it
        let structure =
            with_inertia(&row.units.structure(&parameters.structure), &parameters.members());
        let program = Parameters { structure, vertical, horizontal, ..parameters.clone() };
        let touches = stepping.at_touches();
        let given = parameters.structure;
        let adds_inertia =
            program.structure.rotational_inertia_kgm2 != given.rotational_inertia_kgm2;
        let steps = EvenSteps { adds_inertia, ..EvenSteps::new(row, touches) };
        if touches == 1 {
            return Ok(Self { parameters: program, steps, given });
        }
        let (body, substep) = (program.structure.body(), steps.step / touches as f64);
        let design = DesignNumbers::AT_TOUCHES.design(&body, substep);
        let springs =
            FixedStepSprings::refined(&body, steps.step, steps.integrator, &design, touches)
                .map_err(|e| ExportError::Steps { message: e.to_string() })?;
        let Parameters { structure, .. } = program;
        let refined = Parameters::new(structure, &springs.units);
        let (vertical, horizontal) = (refined.vertical, refined.horizontal);
        Ok(Self { parameters: Parameters { vertical, horizontal, ..program }, steps, given })
    }

    /// The same where a format has words for it.
    fn for_format(
        parameters: &Parameters,
        format: DeckFormat,
        stepping: Stepping,
    ) -> Result<Self, ExportError> {
        if let Some(name) = member(&parameters.members()) {
            return Err(ExportError::MemberOfSteps { name });
        }
        if stepping == Stepping::Touches && format.is_sap2000() {
            return Err(ExportError::TouchesInTables);
        }
        let stepped = Self::new(parameters, stepping)?;
        if format.is_sap2000() {
            stepped.steps.in_tables()?;
        }
        Ok(stepped)
    }

    /// The deck that is to find this history.
    fn deck(
        self,
        record: &Record,
        format: DeckFormat,
        FixedStepHistory { motion, outcome, .. }: &FixedStepHistory,
        until: Option<f64>,
    ) -> Result<SteppedDeck, ExportError> {
        let [gives_up_s, falls_s] = match outcome {
            FixedStepOutcome::GaveUp(GaveUp { time, .. }) => [Some(*time), None],
            // where the deck's history ends
            FixedStepOutcome::Fallen { time } => {
                let fallen = samples_to_fall(&motion.theta).saturating_sub(1) as f64 * record.dt;
                [None, Some(fallen.min(*time))]
            }
            FixedStepOutcome::Finished => [None; 2],
        };
        let compared = samples_to(until, record.dt, motion.len());
        let model = DeckModel::new(&self.parameters, record, &self.expected(motion, compared))?;
        let beside = format
            .is_typed()
            .then(|| housner_beside(&self.given, &self.parameters, record, compared));
        let ends = EvenEnds { gives_up_s, falls_s, compared_by_steps: false };
        let even = Some(EvenSteps { ends, ..self.steps });
        let model = DeckModel { even, housner: beside, ..model };
        let text = export_model(&model, format)?;
        Ok(SteppedDeck { text, gives_up_s, until })
    }

    /// The model, and how the emulation steps it.
    pub(crate) fn model(&self) -> (FixedStepBody, StepSettings) {
        let body = self.parameters.structure.body();
        let model = FixedStepBody::new(&body, &self.parameters.chains());
        (model, self.steps.settings(body.mass * GRAVITY))
    }

    /// The emulation's history on a record.
    pub(crate) fn history(&self, record: &Record) -> FixedStepHistory {
        let (model, settings) = self.model();
        let analysis = FixedStepAnalysis::new(&model, settings, record.dt, &record.accel);
        FixedStepAnalysis { vertical: record.up(), ..analysis }.history()
    }

    /// What a history is to be found to do, compared on so many samples.
    fn expected(&self, motion: &Motion, compared: usize) -> Expected {
        let body = self.parameters.structure.body::<f64>();
        let chains = self.parameters.chains();
        let settled = -0.5 * body.mass * GRAVITY / chains.vertical.in_series();
        Expected::of_motion(motion, [motion.len(), compared], settled, 0.0)
    }
}

/// A rigid body's history on a record as the program that its springs are for would find it.
///
/// # Errors
/// Parameters without springs for such a program.
pub fn stepped_history(
    parameters: &Parameters,
    record: &Record,
) -> Result<FixedStepHistory, ExportError> {
    Ok(Stepped::new(parameters, Stepping::Even)?.history(record))
}

/// A deck for a program with steps of one size.
#[derive(Clone, Debug, PartialEq)]
pub struct SteppedDeck {
    /// Its text.
    pub text: String,
    /// When the emulation of its steps gives up, which is where the deck ends (s).
    pub gives_up_s: Option<f64>,
    /// Up to when the motion can be predicted, if not to its end (s).
    pub until: Option<f64>,
}

impl SteppedDeck {
    /// The text, and a line for the user if the deck ends before the record.
    #[doc(hidden)]
    pub fn told(self, name: &str) -> (String, Option<String>) {
        let line = self.gives_up_s.map(|time| {
            let then = match self.until.filter(|until| *until <= time) {
                Some(until) => format!("; the motion can be predicted to {until:.2} s"),
                None => ": take another integrator or another step, longer ones too".into(),
            };
            format!("{name} ends at {time:.2} s, where the emulation of its steps gives up{then}")
        });
        (self.text, line)
    }
}

/// Samples up to a time (s), of so many: two at least, to be compared on.
pub fn samples_to(until: Option<f64>, dt: f64, all: usize) -> usize {
    samples_until(until, dt).max(2).min(all)
}

/// The deck for a program with steps of one size, or of any other [`Stepping`]. It compares its
/// history up to when the motion can be predicted, `until` (s), as `Conditioning::predictable_to`
/// gives it; all of it if there is no such time.
///
/// # Errors
/// Parameters without springs for such a program; members; an integrator that the program has not;
/// as [`crate::deck`].
pub fn stepped_deck(
    parameters: &Parameters,
    record: &Record,
    format: DeckFormat,
    stepping: Stepping,
    until: Option<f64>,
) -> Result<SteppedDeck, ExportError> {
    if stepping == Stepping::Events {
        return Ok(SteppedDeck {
            text: crate::deck_of(parameters, record, format, ACCURACY, until)?,
            gives_up_s: None,
            until,
        });
    }
    let stepped = Stepped::for_format(parameters, format, stepping)?;
    let history = stepped.history(record);
    stepped.deck(record, format, &history, until)
}

/// The same with steps of one size throughout, of a body whose history is there
/// ([`stepped_history`]).
///
/// # Errors
/// As [`stepped_deck`].
pub fn even_deck(
    parameters: &Parameters,
    record: &Record,
    format: DeckFormat,
    history: &FixedStepHistory,
    until: Option<f64>,
) -> Result<SteppedDeck, ExportError> {
    Stepped::for_format(parameters, format, Stepping::Even)?.deck(record, format, history, until)
}
