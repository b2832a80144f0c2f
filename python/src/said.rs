//! What the crate says, in Python's ways: errors, warnings, JSON.

use std::{ffi::CString, fmt::Display, path::Path};

use pyo3::{
    create_exception,
    exceptions::{PyUserWarning, PyValueError},
    prelude::*,
};
use results::{FiledFinding, Weight};
use serde::Serialize;

use crate::words::in_python;

create_exception!(
    groundspring,
    GroundspringWarning,
    PyUserWarning,
    "What is doubtful: in reading a record, in springs, in a comparison."
);

/// One line, in Python's words.
pub fn one_line(text: impl Display) -> String {
    one_line_of(text, &[])
}

/// The same, with names that stay as they are.
fn one_line_of(text: impl Display, names: &[&str]) -> String {
    let line: String =
        text.to_string().chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    in_python(&line, names)
}

/// An error in Python's words.
pub fn value_error(error: impl Display) -> PyErr {
    PyValueError::new_err(one_line(error))
}

/// The same of a file, or of what else the user has named.
pub fn value_error_of(error: impl Display, names: &[&str]) -> PyErr {
    PyValueError::new_err(one_line_of(error, names))
}

/// A warning in Python's words, at the line of the user's code.
pub fn warn(py: Python<'_>, text: impl Display) -> PyResult<()> {
    warn_of_file(py, text, &[])
}

/// The same of a file, or of what else the user has named.
pub fn warn_of_file(py: Python<'_>, text: impl Display, names: &[&str]) -> PyResult<()> {
    let text = CString::new(one_line_of(text, names)).map_err(value_error)?;
    PyErr::warn(py, &py.get_type::<GroundspringWarning>(), &text, 1)
}

/// A path as messages of one line show it.
pub fn shown(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

/// Warn of those lines of a report that warn.
pub fn warn_of<'a>(
    py: Python<'_>,
    findings: impl IntoIterator<Item = &'a FiledFinding>,
) -> PyResult<()> {
    let grave = findings.into_iter().filter(|finding| finding.weight >= Weight::Warning);
    grave.map(FiledFinding::line).try_for_each(|line| warn(py, &line))
}

/// A value as its JSON has it: dicts, lists, numbers.
pub fn plain(py: Python<'_>, value: &impl Serialize) -> PyResult<Py<PyAny>> {
    let text = serde_json::to_string(value).map_err(value_error)?;
    Ok(py.import("json")?.call_method1("loads", (text,))?.unbind())
}
