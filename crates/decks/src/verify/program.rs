//! A deck in the program it was written for, as a child process that cannot hang.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::{Duration, Instant},
};

use super::VerifyError;
use crate::DeckFormat;

/// The deck's exit code when openseespy cannot be loaded.
const NO_OPENSEES: i32 = 3;

/// Interval at which the deck's progress is read.
const TELL: Duration = Duration::from_millis(500);

/// The last line like "12 s of 20 s" in what the deck said: 12.
fn followed(said: &[u8]) -> Option<usize> {
    String::from_utf8_lossy(said)
        .lines()
        .rev()
        .find_map(|line| line.split_once(" s of ")?.0.parse().ok())
}

/// What runs the deck.
#[derive(Clone, Debug, PartialEq)]
pub enum Program {
    /// A Python interpreter that has openseespy.
    Python(PathBuf),
    /// OpenSees' Tcl interpreter: a command and its first arguments, as `OpenSees` or `python3 -m
    /// opensees`.
    Tcl(Vec<String>),
}

/// What a deck's run left behind.
pub(super) struct ProgramOutput {
    /// Whether the deck found its peaks within 1 % of ours.
    pub good: bool,
    pub report: String,
}

impl Program {
    /// The deck it reads.
    pub fn format(&self) -> DeckFormat {
        match self {
            Self::Python(_) => DeckFormat::OpenSeesPy,
            Self::Tcl(_) => DeckFormat::OpenSeesTcl,
        }
    }

    fn name(&self) -> String {
        match self {
            Self::Python(path) => path.display().to_string(),
            Self::Tcl(words) => words.join(" "),
        }
    }

    fn command(&self) -> Command {
        match self {
            Self::Python(path) => Command::new(path),
            Self::Tcl(words) => {
                let mut words = words.iter();
                let mut command = Command::new(words.next().map_or("", String::as_str));
                command.args(words);
                command
            }
        }
    }

    /// Run a deck; its output goes through files, so that no pipe can fill up. `progress` is told
    /// how many seconds of the record the deck says it has followed.
    pub(super) fn run(
        &self,
        deck: &Path,
        patience: Duration,
        progress: &dyn Fn(usize),
    ) -> Result<ProgramOutput, VerifyError> {
        let logs = [deck.with_extension("out"), deck.with_extension("err")];
        let folder = |path: &Path| {
            let path = path.display().to_string();
            move |source| VerifyError::Folder { path, source }
        };
        let [out, err] =
            [&logs[0], &logs[1]].map(|path| fs::File::create(path).map_err(folder(path)));
        let mut child = self
            .command()
            .arg(deck)
            .stdin(Stdio::null())
            .stdout(out?)
            .stderr(err?)
            .spawn()
            .map_err(|source| VerifyError::NoProgram { program: self.name(), source })?;
        let began = Instant::now();
        let mut told = began;
        let status = loop {
            match child.try_wait() {
                Ok(Some(status)) => break status,
                Ok(None) if began.elapsed() < patience => {
                    if told.elapsed() > TELL {
                        told = Instant::now();
                        fs::read(&logs[1])
                            .ok()
                            .and_then(|bytes| followed(&bytes))
                            .into_iter()
                            .for_each(progress);
                    }
                    std::thread::sleep(Duration::from_millis(20));
                }
                Ok(None) | Err(_) => {
                    // it may have ended in between: nothing is lost
                    let _ = child.kill();
                    let _ = child.wait();
                    return Err(VerifyError::Hung { seconds: patience.as_secs_f64() });
                }
            }
        };
        let text = |path: &PathBuf| {
            fs::read(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
        };
        let report = text(&logs[0]).map_err(folder(&logs[0]))?;
        let complaint = text(&logs[1]).map_err(folder(&logs[1]))?;
        match status.code() {
            Some(code @ (0 | 1)) if report.contains("within 1 %:") => {
                Ok(ProgramOutput { good: code == 0, report })
            }
            Some(NO_OPENSEES) if matches!(self, Self::Python(_)) => {
                Err(VerifyError::NoOpenSees { python: self.name() })
            }
            _ if complaint.contains("No module named opensees") => {
                Err(VerifyError::NoTcl { command: self.name() })
            }
            code => {
                let reason = complaint
                    .lines()
                    .rev()
                    .map(str::trim)
                    .find(|line| !line.is_empty() && !line.starts_with("Process 0"));
                let Some(reason) = reason else {
                    let how = code.map_or("by a signal".into(), |code| format!("with code {code}"));
                    return Err(VerifyError::Silent { program: self.name(), how });
                };
                Err(VerifyError::Stopped { reason: reason.chars().take(200).collect() })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::followed;

    #[test]
    fn the_last_second_that_the_deck_names_is_told() {
        assert_eq!(
            followed(b"WARNING: failed of 3 s\n1 s of 20 s\n2 s of 20 s\nNewton cycles\n"),
            Some(2)
        );
        assert_eq!(followed(b"WARNING\n"), None);
    }
}
