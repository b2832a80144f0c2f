//! Why a sweep ended without its result.

use thiserror::Error;

use cases::CaseError;
use rocking::synthetic::LikeError;
use springs::job::JobError;
use strong_motion::RecordError;

/// What is wrong with a sweep, where, and what to do.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum SweepError {
    #[error("{path}: cannot be read ({source}); check the name of the sweep file")]
    Read { path: String, source: std::io::Error },
    #[error(transparent)]
    Case(#[from] CaseError),
    #[error("{path}: this is a case, not a sweep; run it as `tune run {path}`")]
    IsCase { path: String },
    #[error("{path}, line {line}: {message}")]
    Spec { path: String, line: usize, message: String },
    #[error("{}", in_keys(.0))]
    Record(#[from] RecordError),
    #[error(transparent)]
    Like(#[from] LikeError),
    #[error("{record}: has no motion; take the record out of the sweep")]
    Still { record: String },
    #[error("springs of {structure}: {source}")]
    Springs { structure: String, source: JobError },
    #[error(
        "{folder}: holds another sweep ({there}, this one is {here}); name another folder with \
         --out, or remove it"
    )]
    OtherSweep { folder: String, there: String, here: String },
    #[error("{path}: {source}; check the folder, its rights and the room on the disk")]
    File { path: String, source: std::io::Error },
    #[error(
        "{path}: {reason}; remove the file and run the sweep again, which computes what is missing"
    )]
    Damaged { path: String, reason: String },
    #[error(
        "{folder}: {missing} of {parts} parts are missing ({first}){unfit}; run the same tune \
         sweep again, which computes these alone"
    )]
    Missing { folder: String, missing: usize, parts: usize, first: String, unfit: String },
    #[error(
        "{folder}: no sweep there (no manifest.json); give the folder that tune sweep --out was \
         given"
    )]
    NoSweep { folder: String },
}

/// An error of a record in the keys of `[records]`.
fn in_keys(error: &RecordError) -> String {
    cases::in_keys(&error.to_string())
        .replace("with column, a number or a name (", "with component, \"column 2\" or a name (")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_of_records_name_the_keys_of_a_sweep_file() {
        let file = || "a.csv".to_string();
        let columns = RecordError::TooManyColumns {
            file: file(),
            line: 1,
            found: 3,
            columns: "column 2, column 3".into(),
        };
        let step = RecordError::NoStep { file: file() };
        for (error, keys) in [
            (columns, "with component, \"column 2\" or a name (column 2, column 3); bare"),
            (step, "the time step is not in the file; give dt_s"),
            (RecordError::NoUnits { file: file() }, "give units g, m/s2"),
        ] {
            let told = SweepError::Record(error).to_string();
            assert!(
                told.contains(keys) && !told.contains("--") && !told.contains("[record]"),
                "{told}"
            );
        }
    }
}
