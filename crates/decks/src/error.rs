//! Why there is no deck.

use thiserror::Error;

use crate::printable;

/// What is wrong with an export, and what to do.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum ExportError {
    #[error("export: format '{name}' is not known; give one of {known} (the sheet is ETABS' too)")]
    DeckFormat { name: String, known: String },
    #[error(
        "export: {name} is {value}; give a finite number above zero (dampers and inertia may be \
            zero), as `tune run` writes them"
    )]
    Number { name: &'static str, value: f64 },
    #[error(
        "export: {name} is not written for {format}; leave it out, or take another format \
            (SAP2000 tables have no damper, tendon and friction)"
    )]
    Member { name: &'static str, format: &'static str },
    #[error("export: stepping {name} is not known; give events, even or touches")]
    Stepping { name: String },
    #[error(
        "export: these parameters have no springs for steps of one size; tune for a program that \
            takes such steps"
    )]
    NoProgram,
    #[error(
        "export: springs for steps of one size have the restitution of equation 2, {due:.4}, and \
            these have {asked}; leave restitution out, or take steps that follow touches"
    )]
    ProgramRestitution { asked: f64, due: f64 },
    #[error(
        "export: these springs are for steps of {}, not for SAP2000; tune for SAP2000",
        printable(integrator)
    )]
    AnotherProgram { integrator: String },
    #[error(
        "export: SAP2000 and ETABS take no steps that follow touches; take steps of one size, on \
            springs that were tuned for the program"
    )]
    EventsInTables,
    #[error(
        "export: the springs for steps of one size are not made for a {name}; leave it out, or \
            take steps that follow touches"
    )]
    MemberOfSteps { name: &'static str },
    #[error(
        "export: tables have no loop for substeps at touches; take steps of one size, or a deck \
            for OpenSees"
    )]
    TouchesInTables,
    #[error(
        "export: integrator {name} is not written for {program}; tune with another: hht:-0.333 or \
            newmark, in OpenSees also trbdf2 or backward-euler"
    )]
    Integrator { name: String, program: &'static str },
    #[error("export: {message}")]
    Steps { message: String },
    #[error(
        "export: the history to check against has {expected} samples but the record has {record}; \
            use the record that was simulated"
    )]
    Samples { expected: usize, record: usize },
}

impl ExportError {
    /// Which options of the program do what the message says, if there are some.
    fn options(&self) -> Option<&'static str> {
        Some(match self {
            Self::NoProgram => "give tune run --for sap2000, etabs or opensees-even, and --step",
            Self::AnotherProgram { .. } => "give tune run --for sap2000 and --step",
            Self::EventsInTables => "give --stepping even, and tune run --for sap2000 and --step",
            Self::ProgramRestitution { .. } | Self::MemberOfSteps { .. } => {
                "give --stepping events"
            }
            Self::TouchesInTables => "give --stepping even, or --format openseespy",
            Self::Integrator { .. } => "give tune run another --integrator",
            Self::Member { .. } => "give another --format",
            Self::DeckFormat { .. }
            | Self::Number { .. }
            | Self::Stepping { .. }
            | Self::Steps { .. }
            | Self::Samples { .. } => return None,
        })
    }

    /// The message for who runs the program `tune`: with its options.
    #[doc(hidden)]
    pub fn with_options(&self) -> String {
        self.options().map_or_else(|| self.to_string(), |options| format!("{self} ({options})"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A user of the library has no options; a user of the program has.
    #[test]
    fn messages_speak_of_options_to_users_of_the_program_alone() {
        let (name, asked) = ("damper", 0.9);
        let all = [
            ExportError::Member { name, format: "sap2000" },
            ExportError::Stepping { name: "often".into() },
            ExportError::NoProgram,
            ExportError::ProgramRestitution { asked, due: 0.8 },
            ExportError::AnotherProgram { integrator: "trbdf2".into() },
            ExportError::EventsInTables,
            ExportError::MemberOfSteps { name },
            ExportError::TouchesInTables,
            ExportError::Integrator { name: "trbdf2".into(), program: "SAP2000" },
        ];
        for error in all {
            let (said, told) = (error.to_string(), error.with_options());
            assert!(!said.contains("--"), "{said}");
            assert!(told.starts_with(&said), "{told}");
            assert_eq!(told.contains("--"), error.options().is_some(), "{told}");
        }
    }
}
