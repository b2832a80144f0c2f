//! The whole of `tune run`.

use std::{path::PathBuf, sync::Arc};

use pyo3::prelude::*;
use report::rigid::RigidRun;
use run_folder::rigid::{Output, save};
use springs::{
    case::{Case, Objective, Tuning},
    tuning::job::Job,
};
use strong_motion::excitation::Excitation;

use crate::{
    record::Record,
    rocking::seconds,
    said::{plain, value_error, warn_of},
    simulation::Simulation,
    springs::Springs,
    structure::Structure,
    work::interruptible,
};

/// What the program finds, a line each.
fn lines(run: &RigidRun) -> Vec<String> {
    let accuracy = run.said(run.parameters.clone()).accuracy;
    let accuracy = accuracy.map(|accuracy| format!("accuracy: {}", accuracy.sentence()));
    run.parameters.findings.iter().map(|finding| finding.line()).chain(accuracy).collect()
}

/// Springs of a structure, and all that `tune run` finds of them.
#[pyclass(frozen, module = "groundspring")]
pub struct Tuned {
    run: Arc<RigidRun>,
    structure: Structure,
    histories: Py<Simulation>,
}

#[pymethods]
impl Tuned {
    /// What they are for.
    #[getter]
    fn structure(&self) -> Structure {
        self.structure
    }

    /// The springs.
    #[getter]
    fn springs(&self) -> Springs {
        Springs::of(self.structure.core.mass_kg, &self.run.job.springs)
    }

    /// What was asked for, whether it is reached, what was measured and on what, as in
    /// `parameters.json`: NRMSE, without unit.
    #[getter]
    fn accuracy(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        plain(py, &self.run.parameters.assessment)
    }

    /// What the body does in both models, as in `parameters.json`: times in s, rotations over
    /// alpha.
    #[getter]
    fn verdict(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        plain(py, &self.run.parameters.verdict)
    }

    /// Both histories on the record.
    #[getter]
    fn histories(&self, py: Python<'_>) -> Py<Simulation> {
        self.histories.clone_ref(py)
    }

    /// All of `parameters.json` but the record; keys end in their units.
    #[getter]
    fn parameters(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        plain(py, &self.run.parameters)
    }

    /// What the program says of the run.
    #[getter]
    fn lines(&self) -> Vec<String> {
        lines(&self.run)
    }

    /// Write what `tune run` writes; the decks that are left out, each with the reason.
    #[pyo3(signature = (folder, figures = true))]
    fn save(&self, py: Python<'_>, folder: PathBuf, figures: bool) -> PyResult<Vec<String>> {
        let left_out = interruptible(py, |_| save(&self.run, &folder, Output { figures, report: true }))?;
        left_out.map_err(value_error)
    }

    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().histories.bind(slf.py()).call_method0("to_pandas")
    }

    #[pyo3(signature = (axes = None))]
    fn plot<'py>(slf: &Bound<'py, Self>, axes: Option<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().histories.bind(slf.py()).call_method1("plot", (axes,))
    }

    fn __repr__(&self) -> String {
        format!("Tuned(Omega_n {:.1} Hz)\n{}", self.run.job.springs.vertical.omega_n_hz, lines(&self.run).join("\n"))
    }
}

/// Tune the springs of a structure; on El Centro unless a record is given.
#[pyfunction]
#[pyo3(signature = (structure, record = None, accuracy = 0.002, method = "landing", *, scale = 1.0, duration = None,
    max_hz = None, max_settlement = 0.01, friction = 0.5, front = false, vertical = None))]
#[allow(clippy::too_many_arguments)]
pub fn tune(
    py: Python<'_>,
    structure: Structure,
    record: Option<&Record>,
    accuracy: f64,
    method: &str,
    scale: f64,
    duration: Option<f64>,
    max_hz: Option<f64>,
    max_settlement: f64,
    friction: f64,
    front: bool,
    vertical: Option<&Record>,
) -> PyResult<Tuned> {
    let objective = match method {
        "landing" => Objective::Landing,
        "arr" => Objective::Arr,
        other => return Err(value_error(format!("method is {other:?}; give \"landing\" or \"arr\", the paper's"))),
    };
    let duration = seconds(duration)?;
    let record =
        record.map_or_else(|| Record(strong_motion::Record::el_centro()), Record::clone).beside(vertical)?.into_owned();
    let tuning =
        Tuning { objective, accuracy, max_omega_hz: max_hz, max_settlement_m: max_settlement, ..Tuning::default() };
    let excitation = Excitation { record, scale, duration_s: duration };
    let case = Case::new("tune", (structure.core, structure.e), excitation, tuning).map_err(value_error)?;
    let (run, simulation) = interruptible(py, |stop| {
        let job = Job::new(&case, &|_, _, _| stop.check()).map_err(value_error)?;
        let points = if front { report::stiffness_tradeoff::front(&job, &|_, _| stop.check()) } else { Vec::new() };
        stop.check();
        let run = RigidRun::new(case, job, points, friction);
        let run = Arc::new(run);
        let simulation = Simulation::of(structure, run.clone());
        Ok::<_, PyErr>((run, simulation))
    })??;
    warn_of(py, &run.parameters.findings)?;
    Ok(Tuned { run, structure, histories: Py::new(py, simulation)? })
}
