//! Springs judged over many records.

use std::path::PathBuf;

use dynamics::fem::Control;
use pyo3::prelude::*;
use rocking::synthetic;
use springs::validate::{self as core, Validator};

use strong_motion::{ReadOptions, RecordError};

use crate::{
    record::Record,
    rocking::{ratio, seconds},
    said::{plain, value_error, warn},
    springs::Springs,
    structure::Structure,
    work::interruptible,
};

/// What many records say of springs.
#[pyclass(frozen, module = "groundspring")]
pub struct Validation(core::Validation);

#[pymethods]
impl Validation {
    /// All of `validate.json`: statistics of all records and of each suite, the rows.
    #[getter]
    fn summary(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        plain(py, &self.0)
    }

    /// A row a record.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let rows = plain(py, &self.0.records)?;
        py.import("groundspring._tables")?.call_method1("rows", (rows,))
    }

    fn __len__(&self) -> usize {
        self.0.records.len()
    }

    fn __repr__(&self) -> String {
        let nrmse = self.0.records.iter().filter(|row| row.comparable()).count();
        format!("Validation({} records, {nrmse} well-conditioned)", self.0.records.len())
    }
}

/// Where the records are.
#[derive(FromPyObject)]
pub enum Records<'py> {
    Several(Vec<PyRef<'py, Record>>),
    Folder(PathBuf),
}

/// Judge springs over records of one's own, and over motions made from a seed.
#[pyfunction]
#[pyo3(signature = (structure, springs, records = None, *, synthetic = 0, earthquakes = 0, seed = 1, duration = None,
    restitution = None))]
#[allow(clippy::too_many_arguments)]
pub fn validate(
    py: Python<'_>,
    structure: Structure,
    springs: Springs,
    records: Option<Records<'_>>,
    synthetic: usize,
    earthquakes: usize,
    seed: u64,
    duration: Option<f64>,
    restitution: Option<f64>,
) -> PyResult<Validation> {
    let restitution = ratio(restitution)?.unwrap_or(structure.e);
    let duration = seconds(duration)?;
    let own: Vec<strong_motion::Record> = match records {
        None => Vec::new(),
        Some(Records::Several(several)) => several.iter().map(|record| record.0.clone()).collect(),
        Some(Records::Folder(folder)) => read_folder(py, &folder)?,
    };
    if let Some(shaken) = own.iter().find(|record| record.vertical.is_some()) {
        return Err(value_error(format!(
            "validate: record {:?} has a vertical component, which is not judged; give it without",
            shaken.name
        )));
    }
    let n = own.len() + synthetic + earthquakes;
    if n == 0 {
        return Err(value_error("validate: there are no records; give some, a folder, or synthetic= or earthquakes="));
    }
    let body = structure.body();
    let judge =
        Validator { body, restitution, springs: springs.chains(), duration_s: duration, control: Control::default() };
    let (p, alpha) = (body.p_squared().sqrt(), body.alpha());
    let validation = interruptible(py, |stop| {
        let record = |i: usize| {
            stop.check();
            let made = i.checked_sub(own.len());
            Ok::<_, RecordError>(match made.map(|i| (i, i.checked_sub(synthetic))) {
                None => own[i].clone(),
                Some((i, None)) => synthetic::record(seed, i, p, alpha),
                Some((_, Some(i))) => synthetic::earthquake(seed, i, p),
            })
        };
        judge.judge_all(n, record, |_| ())
    })?;
    validation.map(Validation).map_err(value_error)
}

/// Every record of a folder, with what its reader says.
fn read_folder(py: Python<'_>, folder: &std::path::Path) -> PyResult<Vec<strong_motion::Record>> {
    let files = strong_motion::list_dir(folder).map_err(value_error)?;
    let read = |file: &PathBuf| {
        let recording = strong_motion::Recording::read(file, &ReadOptions::default()).map_err(value_error)?;
        recording.notices().iter().try_for_each(|notice| warn(py, notice))?;
        Ok(recording.into_record())
    };
    files.iter().map(read).collect()
}

/// The first n motions made for a structure from a seed: Ricker and Mavroeidis-Papageorgiou pulses,
/// filtered noise.
#[pyfunction]
#[pyo3(signature = (structure, n, seed = 1))]
pub fn synthetic_records(structure: Structure, n: usize, seed: u64) -> Vec<Record> {
    let body = structure.body();
    let (p, alpha) = (body.p_squared().sqrt(), body.alpha());
    (0..n).map(|i| Record(synthetic::record(seed, i, p, alpha))).collect()
}

/// The first n motions with the frequencies of earthquakes from a seed: filtered noise of soils of
/// 9 to 36 rad/s, 0.2 to 0.9 g.
#[pyfunction]
#[pyo3(signature = (structure, n, seed = 1))]
pub fn earthquake_records(structure: Structure, n: usize, seed: u64) -> Vec<Record> {
    let p = structure.body().p_squared().sqrt();
    (0..n).map(|i| Record(synthetic::earthquake(seed, i, p))).collect()
}
