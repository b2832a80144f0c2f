//! The whole of `tune run`.

use std::{path::PathBuf, sync::Arc};

use cases::{Case, Objective, Tuning};
use pyo3::{IntoPyObjectExt, prelude::*, types::PyTuple};
use report::rigid::RigidRun;
use run_folder::rigid::{Output, save};
use springs::job::Job;
use strong_motion::excitation::of_record;

use crate::{
    numbers::seconds,
    program::ProgramArguments,
    record::Record,
    said::{one_line, plain, shown, value_error, value_error_of, warn_of},
    simulation::Simulation,
    springs::Springs,
    structure::Structure,
    work::interruptible,
};

/// What the program finds, a line each.
fn lines(run: &RigidRun) -> Vec<String> {
    let said = run.said(run.parameters.clone());
    let accuracy = said.accuracy.map(|accuracy| format!("accuracy: {}", accuracy.sentence()));
    let program = said
        .program
        .map(|row| format!("springs for {}, steps of {}: {}", row.program, row.steps, row.errors));
    let findings = run.parameters.findings.iter().map(|finding| finding.line());
    findings.chain(accuracy).chain(program).collect()
}

/// Springs of a rigid structure, and all that is found of them.
///
/// The springs are for a body that lands as a whole. Under columns that give they are wrong:
/// they throw the foot back, again and again, in a million steps. There
/// `groundspring.opensees.springs_for` has those of what lands.
#[pyclass(frozen, module = "groundspring")]
pub struct Tuned {
    run: Arc<RigidRun>,
    structure: Structure,
    histories: Py<Simulation>,
    /// What it was computed from, in the order of `tune`'s arguments.
    inputs: Py<PyTuple>,
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
    /// `parameters.json`: NRMSE.
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

    /// Springs for a program with steps of one size, what it is to be set to, and what they err
    /// there, as in `parameters.json`; None where there are none.
    #[getter]
    fn program(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        plain(py, &self.run.parameters.program)
    }

    /// What is to be said of the run.
    #[getter]
    fn lines(&self) -> Vec<String> {
        lines(&self.run).into_iter().map(one_line).collect()
    }

    /// Write springs, histories, figures (SVG), decks. Decks that a program cannot hold are left
    /// out: each is named, with the reason.
    #[pyo3(signature = (folder, figures = true))]
    fn save(&self, py: Python<'_>, folder: PathBuf, figures: bool) -> PyResult<Vec<String>> {
        let left_out =
            interruptible(py, |_| save(&self.run, &folder, Output { figures, report: true }))?;
        left_out.map_err(|error| value_error_of(error, &[&shown(&folder)]))
    }

    /// Those of its histories.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.get().histories.bind(slf.py()).call_method0("to_pandas")
    }

    /// Horizontal displacement, mm, of both models over time, s.
    #[pyo3(signature = (axes = None))]
    fn plot<'py>(
        slf: &Bound<'py, Self>,
        axes: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        slf.get().histories.bind(slf.py()).call_method1("plot", (axes,))
    }

    /// For notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_html", "tuned", (slf,))
    }

    /// What it was computed from: computed again when it is unpickled.
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Py<PyTuple>)> {
        Ok((crate::restore(py, "tuned")?, self.inputs.clone_ref(py)))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __repr__(&self) -> String {
        let omega = self.run.job.springs.vertical.omega_n_hz;
        let asked = self.run.parameters.assessment.as_ref().map(|assessment| {
            let reached = if assessment.reached { "reached" } else { "not reached" };
            format!(", accuracy {} {reached}", assessment.accuracy)
        });
        format!("Tuned(Omega_n {omega:.1} Hz{})", asked.unwrap_or_default())
    }

    fn __str__(&self) -> String {
        format!("{}\n{}", self.__repr__(), self.lines().join("\n"))
    }
}

/// A run of a case, and its histories.
fn run(
    py: Python<'_>,
    case: Case,
    structure: Structure,
    friction: f64,
    front: bool,
) -> PyResult<(Arc<RigidRun>, Simulation)> {
    interruptible(py, |stop| {
        let job = Job::new(&case, &|_, _, _| stop.check()).map_err(value_error)?;
        let points = if front {
            report::stiffness_tradeoff::front(&job, &|_, _| stop.check())
        } else {
            Vec::new()
        };
        stop.check();
        let run = RigidRun::new(case, job, points, friction);
        let run = Arc::new(run);
        let simulation = Simulation::of(structure, run.clone());
        Ok::<_, PyErr>((run, simulation))
    })?
}

/// Tune the springs of a rigid structure; for columns that give see
/// `groundspring.opensees.springs_for`.
///
/// record          on which they are judged beside the motions made for the structure; all of
///                 El Centro unless given
/// accuracy        error of the history against Housner's (NRMSE) that Omega_n is chosen for
/// method          "landing": by the geometry; "arr": the paper's procedure, on the record
/// scale           factor on the record
/// duration        of the record, s; all of it unless given
/// max_hz          stiffest springs, Omega_n/2 pi, Hz; not for programs with steps of one size
/// max_settlement  of the standing body, m
/// friction        coefficient of the ground, without unit, for the warning of sliding
/// front           error against stiffness, too
/// vertical        ground acceleration at the record's times, positive upwards, if not that of
///                 the record
/// program         program with steps of one size that springs are wanted for besides:
///                 "sap2000", "etabs" or "opensees-even"; SAP2000 unless given
/// step            its time step, s; 0.001 unless given
/// integrator      its integrator: "hht:ALPHA" (0 to -1/2), "newmark:GAMMA:BETA",
///                 "generalized-alpha:RHO", "trbdf2" or "backward-euler"; alone, any program that
///                 has it
/// substeps        a step that fails is halved, down to one in so many, a power of two; 16
///                 unless given
///
/// ValueError: no springs settle as little as asked for; a number out of its range; an integrator
/// that the program does not have.
#[pyfunction]
#[pyo3(signature = (structure, record = None, accuracy = 0.002, method = "landing", *,
    scale = 1.0, duration = None, max_hz = None, max_settlement = 0.01, friction = 0.5,
    front = false, vertical = None, program = None, step = None, integrator = None,
    substeps = None))]
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
    program: Option<String>,
    step: Option<f64>,
    integrator: Option<String>,
    substeps: Option<usize>,
) -> PyResult<Tuned> {
    let objective = match method {
        "landing" => Objective::Landing,
        "arr" => Objective::Arr,
        other => {
            return Err(value_error(format!(
                "method is {other:?}; give \"landing\" or \"arr\", the paper's"
            )));
        }
    };
    let duration = seconds(duration)?;
    let asked = ProgramArguments { program, step, integrator, substeps };
    let inputs = PyTuple::new(
        py,
        [
            structure.into_bound_py_any(py)?,
            record.cloned().into_bound_py_any(py)?,
            accuracy.into_bound_py_any(py)?,
            method.into_bound_py_any(py)?,
            scale.into_bound_py_any(py)?,
            duration.into_bound_py_any(py)?,
            max_hz.into_bound_py_any(py)?,
            max_settlement.into_bound_py_any(py)?,
            friction.into_bound_py_any(py)?,
            front.into_bound_py_any(py)?,
            vertical.cloned().into_bound_py_any(py)?,
            asked.program.as_deref().into_bound_py_any(py)?,
            asked.step.into_bound_py_any(py)?,
            asked.integrator.as_deref().into_bound_py_any(py)?,
            asked.substeps.into_bound_py_any(py)?,
        ],
    )?;
    let record = record
        .map_or_else(|| Record(strong_motion::Record::el_centro()), Record::clone)
        .beside(vertical)?
        .into_owned();
    let tuning = Tuning {
        objective,
        accuracy,
        max_omega_hz: max_hz,
        max_settlement_m: max_settlement,
        ..Tuning::default()
    };
    let excitation = of_record(record, scale, duration);
    let case = Case::new("tune", (structure.core, structure.e), excitation, tuning)
        .map_err(value_error)?;
    let case = asked.of(case)?;
    let (run, simulation) = run(py, case, structure, friction, front)?;
    warn_of(py, &run.parameters.findings)?;
    let inputs = inputs.unbind();
    Ok(Tuned {
        run,
        structure,
        histories: Py::new(py, simulation.again(inputs.clone_ref(py)))?,
        inputs,
    })
}
