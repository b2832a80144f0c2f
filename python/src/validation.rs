//! Springs judged over many records.

use std::path::{Path, PathBuf};

use dynamics::fem::Control;
use pyo3::{prelude::*, types::PyTuple};
use rocking::synthetic;
use validation::{self as core, JudgedModel, Validator};

use strong_motion::{ReadOptions, RecordError};

use crate::{
    many::several_of,
    numbers::{ratio, seconds},
    record::Record,
    said::{plain, shown, value_error, value_error_of, warn_of_file},
    springs::Springs,
    structure::Structure,
    work::interruptible,
};

/// What many records say of springs: a row a record.
#[pyclass(frozen, module = "groundspring")]
pub struct Validation {
    found: core::Validation,
    /// What it was computed from, in the order of `validate`'s arguments.
    inputs: Py<PyTuple>,
}

#[pymethods]
impl Validation {
    /// All of `validate.json`: statistics of all records and of each suite, the rows.
    #[getter]
    fn summary(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        plain(py, &self.found)
    }

    /// A row a record; names end in their units.
    fn to_pandas<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let rows = plain(py, &self.found.records)?;
        crate::call(py, "_tables", "rows", (rows,))
    }

    /// For notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_html", "validation", (slf,))
    }

    /// What it was computed from: computed again when it is unpickled.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Py<PyTuple>)> {
        Ok((crate::restore(py, "validation")?, self.inputs.clone_ref(py)))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __len__(&self) -> usize {
        self.found.records.len()
    }

    fn __repr__(&self) -> String {
        let nrmse = self.found.records.iter().filter(|row| row.comparable()).count();
        format!("Validation({} records, {nrmse} well-conditioned)", self.found.records.len())
    }
}

/// Where the records are.
pub enum Records {
    Several(Vec<Record>),
    Folder(PathBuf),
}

impl<'py> FromPyObject<'_, 'py> for Records {
    type Error = PyErr;

    fn extract(of: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(folder) = of.extract() {
            return Ok(Self::Folder(folder));
        }
        let give = "give Records (read_record makes one of a file), or the path of a folder";
        several_of(&of, "records", give).map(Self::Several)
    }
}

/// Judge springs over many records.
///
/// records      of your own, or a folder of files
/// synthetic    so many motions made for the structure
/// earthquakes  so many motions like earthquakes
/// seed         of both
/// duration     of each, s; all of it unless given
///
/// Horizontal motion alone: a record with a vertical component is refused.
#[pyfunction]
#[pyo3(signature = (structure, springs, records = None, *, synthetic = 0, earthquakes = 0,
    seed = 1, duration = None, restitution = None))]
#[allow(clippy::too_many_arguments)]
pub fn validate(
    py: Python<'_>,
    structure: Structure,
    springs: Springs,
    records: Option<Records>,
    synthetic: usize,
    earthquakes: usize,
    seed: u64,
    duration: Option<f64>,
    restitution: Option<f64>,
) -> PyResult<Validation> {
    let restitution = ratio(restitution)?.unwrap_or(structure.e);
    let duration = seconds(duration)?;
    springs.check_mass(py, "validate", &structure)?;
    let own: Vec<strong_motion::Record> = match records {
        None => Vec::new(),
        Some(Records::Several(several)) => several.into_iter().map(|record| record.0).collect(),
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
        return Err(value_error(
            "validate: there are no records; give some, a folder, or synthetic= or earthquakes=",
        ));
    }
    let shaken: Vec<Record> = own.iter().cloned().map(Record).collect();
    let inputs = (structure, springs, shaken, synthetic, earthquakes, seed, duration, restitution)
        .into_pyobject(py)?
        .unbind();
    let body = structure.body();
    let judge = Validator {
        body,
        restitution,
        duration_s: duration,
        model: JudgedModel::Events { springs: springs.chains(), control: Control::default() },
    };
    let (p, alpha) = (body.p(), body.alpha());
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
    Ok(Validation { found: validation.map_err(value_error)?, inputs })
}

/// Every record of a folder, with what its reader says.
fn read_folder(py: Python<'_>, folder: &Path) -> PyResult<Vec<strong_motion::Record>> {
    let refused = |error, path: &Path| value_error_of(error, &[&shown(path)]);
    let files = strong_motion::Record::list_dir(folder).map_err(|error| refused(error, folder))?;
    let read = |file: &PathBuf| {
        let recording = strong_motion::Recording::read(file, &ReadOptions::default())
            .map_err(|error| refused(error, file))?;
        let names = [&*shown(file)];
        recording.notices().iter().try_for_each(|notice| warn_of_file(py, notice, &names))?;
        Ok(recording.into_record())
    };
    files.iter().map(read).collect()
}

/// n records, unless ^C comes first.
fn made(
    py: Python<'_>,
    n: usize,
    make: impl Fn(usize) -> strong_motion::Record + Sync,
) -> PyResult<Vec<Record>> {
    interruptible(py, |stop| {
        // as they come: n may be more than memory holds
        let mut all = Vec::new();
        for i in 0..n {
            stop.check();
            all.push(Record(make(i)));
        }
        all
    })
}

/// Motions made for a structure: Ricker and Mavroeidis-Papageorgiou pulses, filtered noise. ^C
/// ends it.
#[pyfunction]
#[pyo3(signature = (structure, n, seed = 1))]
pub fn synthetic_records(
    py: Python<'_>,
    structure: Structure,
    n: usize,
    seed: u64,
) -> PyResult<Vec<Record>> {
    let body = structure.body();
    let (p, alpha) = (body.p(), body.alpha());
    made(py, n, |i| synthetic::record(seed, i, p, alpha))
}

/// Motions with the frequencies of earthquakes: filtered noise of soils of 9 to 36 rad/s, 0.2
/// to 0.9 g. ^C ends it.
///
/// The structure decides how long they are silent at the end.
#[pyfunction]
#[pyo3(signature = (structure, n, seed = 1))]
pub fn earthquake_records(
    py: Python<'_>,
    structure: Structure,
    n: usize,
    seed: u64,
) -> PyResult<Vec<Record>> {
    let p = structure.body().p();
    made(py, n, |i| synthetic::earthquake(seed, i, p))
}
