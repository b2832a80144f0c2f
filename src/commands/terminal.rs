//! The one place that writes to stdout and stderr.
//!
//! A reader of a pipe that went away is the end of the output, and nothing is wrong: the command
//! goes on and its files are whole. Any other failure of stdout is an error of one line, of stderr
//! an exit code alone, and both after the files are written. No control character of a name gets to
//! a terminal.

use std::{
    fmt::Display,
    io::{self, ErrorKind, Write},
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
};

use comfy_table::{Row, Table, presets};
use serde::Serialize;

use super::CommandError;
use files::message::{is_unprintable, printable, printable_lines};

/// Whether the reader of stdout went away: what follows has no reader.
static STDOUT_ENDED: AtomicBool = AtomicBool::new(false);
/// Whether something that was for stderr was lost, though a reader waits for it.
static STDERR_FAILED: AtomicBool = AtomicBool::new(false);

/// A table to be printed, that Markdown takes, too.
pub fn table(head: impl Into<Row>) -> Table {
    let mut table = Table::new();
    table.load_style(presets::ASCII_MARKDOWN).set_header(head);
    table
}

/// Write results to stdout. Call it when all files are written: a full disk must not cost them.
///
/// # Errors
/// It cannot be written, and not because its reader went away.
pub fn stdout(text: impl Display) -> Result<(), CommandError> {
    if STDOUT_ENDED.load(Ordering::Relaxed) {
        return Ok(());
    }
    match write(&mut io::stdout().lock(), &text.to_string()) {
        Err(e) if e.kind() == ErrorKind::BrokenPipe => {
            STDOUT_ENDED.store(true, Ordering::Relaxed);
            Ok(())
        }
        written => Ok(written?),
    }
}

/// Write a value to stdout as JSON, in which such characters are spelt as JSON spells them.
///
/// # Errors
/// As [`stdout`].
pub fn json(value: &impl Serialize) -> Result<(), CommandError> {
    let json = serde_json::to_string_pretty(value).map_err(CommandError::result)?;
    let mut text = String::with_capacity(json.len() + 1);
    for c in json.chars() {
        match c {
            '\n' => text.push('\n'),
            c if is_unprintable(c) => {
                let units = c
                    .encode_utf16(&mut [0; 2])
                    .iter()
                    .map(|unit| format!("\\u{unit:04x}"))
                    .collect::<String>();
                text.push_str(&units);
            }
            c => text.push(c),
        }
    }
    text.push('\n');
    stdout(text)
}

/// Write a line to stderr: progress, warnings, errors. What cannot be written is lost, and
/// [`stderr_failed`] from then on.
pub fn stderr(line: impl Display) {
    match write(&mut io::stderr().lock(), &format!("{line}\n")) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => STDERR_FAILED.store(true, Ordering::Relaxed),
        _ => {}
    }
}

/// Say on stderr where results are.
pub fn written(folder: &Path) {
    stderr(format_args!("written to {}", shown(folder)));
}

/// Whether lines for stderr were lost on a full disk or a broken device.
pub fn stderr_failed() -> bool {
    STDERR_FAILED.load(Ordering::Relaxed)
}

/// The name of a file as a line can show it.
pub fn shown(path: &Path) -> String {
    printable(&path.display().to_string()).into_owned()
}

/// At once, without the buffer of stdout, which is lost in silence when a process ends.
fn write(out: &mut impl Write, text: &str) -> io::Result<()> {
    out.write_all(printable_lines(text).as_bytes())?;
    out.flush()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fails from the first byte on, as a device that is full.
    struct Full;

    impl Write for Full {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(ErrorKind::StorageFull.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_full_device_is_an_error_and_no_panic() {
        assert_eq!(write(&mut Full, "text").unwrap_err().kind(), ErrorKind::StorageFull);
    }

    #[test]
    fn lines_stay_and_what_steers_a_terminal_is_spelt_out() {
        let mut out = Vec::new();
        write(&mut out, "a\tb\n\u{1b}]0;title\u{7}\u{202e}\n").unwrap();
        assert_eq!(String::from_utf8(out).unwrap(), "a\tb\n\\u{1b}]0;title\\u{7}\\u{202e}\n");
    }
}
