//! Both models on given springs.

use std::sync::Arc;

use dynamics::fem::{self, QUANTITIES};
use numpy::PyArray1;
use parameters::answers::{ModelComparison, compare_models};
use pyo3::{
    prelude::*,
    types::{PyDict, PyTuple},
};
use report::{
    filed,
    reference::{self, HousnerReport},
    rigid::RigidRun,
};
use results::FiledFinding;
use rocking::members::Members;
use validation::verdict::Verdict;

use crate::{
    Array,
    numbers::ratio,
    record::{Record, at_scale},
    rocking::History,
    said::{one_line, plain, warn_of},
    springs::Springs,
    structure::Structure,
    times, view,
    work::interruptible,
};

/// The finite element history on springs, beside Housner's on the same record.
///
/// Forces are, at every sample, those of largest magnitude since the sample before. They are not
/// checked: those of a landing are the springs', as large as these are stiff.
#[pyclass(frozen, module = "groundspring")]
pub struct Simulation {
    structure: Structure,
    dt: f64,
    source: Source,
    verdict: Verdict,
    findings: Vec<FiledFinding>,
    /// What it was computed from: arguments of `tune`, or of `simulate`.
    inputs: Option<Py<PyTuple>>,
}

/// Where the histories are.
enum Source {
    Own(Box<ModelComparison>),
    Tuned(Arc<RigidRun>),
}

impl Simulation {
    /// The histories of a run.
    pub fn of(structure: Structure, run: Arc<RigidRun>) -> Self {
        let dt = run.job.record.dt;
        let verdict = run.both.verdict(&run.job.body, dt, &run.report.conditioning);
        Self {
            structure,
            dt,
            findings: run.parameters.findings.clone(),
            verdict,
            source: Source::Tuned(run),
            inputs: None,
        }
    }

    /// With what it was computed from.
    pub fn again(self, inputs: Py<PyTuple>) -> Self {
        Self { inputs: Some(inputs), ..self }
    }

    fn both(&self) -> &ModelComparison {
        match &self.source {
            Source::Own(both) => both,
            Source::Tuned(run) => &run.both,
        }
    }

    fn fem(&self) -> &fem::History {
        &self.both().fem
    }
}

#[pymethods]
impl Simulation {
    /// Time step, s.
    #[getter]
    fn dt(&self) -> f64 {
        self.dt
    }

    /// Times of the samples, s.
    #[getter]
    fn t<'py>(&self, py: Python<'py>) -> Array<'py> {
        times(py, self.fem().motion.len(), self.dt)
    }

    /// Rotation, positive leaning to the right, rad.
    #[getter]
    fn theta<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.motion.theta)
    }

    /// Horizontal displacement of the centre of mass, positive to the right, m.
    #[getter]
    fn u<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.motion.u)
    }

    /// Vertical displacement of the centre of mass from the settled position, positive up, m.
    #[getter]
    fn v<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.motion.v)
    }

    /// The ground's force on the left foot, up, N.
    #[getter]
    fn vertical_left<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.forces.vertical[0])
    }

    /// The ground's force on the right foot, up, N.
    #[getter]
    fn vertical_right<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.forces.vertical[1])
    }

    /// The ground's force on the left foot, to the right, N.
    #[getter]
    fn horizontal_left<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.forces.horizontal[0])
    }

    /// The ground's force on the right foot, to the right, N.
    #[getter]
    fn horizontal_right<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.forces.horizontal[1])
    }

    /// Work of the ground since the start, J.
    #[getter]
    fn energy_input<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.account.input)
    }

    /// Above the initial energy, J.
    #[getter]
    fn energy_stored<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.account.stored)
    }

    /// Taken by dashpots and released springs, J.
    #[getter]
    fn energy_dissipated<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.account.dissipated)
    }

    /// What the account leaves unexplained, J.
    #[getter]
    fn energy_residual<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        column(slf, |history| &history.account.residual)
    }

    /// Times of the touch-downs that end a lean on the other foot, s.
    #[getter]
    fn impacts<'py>(&self, py: Python<'py>) -> Array<'py> {
        PyArray1::from_iter(py, self.fem().landings.iter().filter(|l| l.impact).map(|l| l.time))
    }

    /// Of the body standing under its weight, before t = 0, m.
    #[getter]
    fn settlement(&self) -> f64 {
        -self.fem().initial_z
    }

    /// How it ended.
    #[getter]
    fn outcome(&self) -> &'static str {
        match self.fem().outcome {
            fem::HistoryOutcome::Completed => "completed",
            fem::HistoryOutcome::Overturned { .. } => "overturned",
            fem::HistoryOutcome::Stopped { .. } => "stopped",
            fem::HistoryOutcome::WorkBound { .. } => "work_bound",
            fem::HistoryOutcome::Unstable { .. } => "unstable",
        }
    }

    /// Housner's history of the same record.
    #[getter]
    fn housner(&self) -> History {
        History::new(self.structure.body(), self.dt, self.both().rocking.clone())
    }

    /// How the two compare, as in `parameters.json`: errors without unit, peaks and settlement
    /// in m, times in s.
    #[getter(r#match)]
    fn matched(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        plain(py, &self.both().matched)
    }

    /// What the body does in both models, as in `parameters.json`: times in s, rotations over
    /// alpha.
    #[getter]
    fn verdict(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        plain(py, &self.verdict)
    }

    /// What is to be said of the run.
    #[getter]
    fn lines(&self) -> Vec<String> {
        self.findings.iter().map(|finding| one_line(finding.line())).collect()
    }

    /// Base shear and forces in the legs, N; moments, N m; by name.
    #[getter]
    fn demands<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let rows = &self.both().demands.rows;
        let all = PyDict::new(py);
        for (k, name) in QUANTITIES.iter().enumerate() {
            all.set_item(name, PyArray1::from_iter(py, rows.iter().map(|row| row[k])))?;
        }
        Ok(all)
    }

    /// Both models' motions, m and rad, forces, N, moments, N m, and energies, J, over time, s.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_tables", "simulation", (slf,))
    }

    /// Horizontal displacement, mm, of both models over time, s.
    #[pyo3(signature = (axes = None))]
    fn plot<'py>(
        slf: &Bound<'py, Self>,
        axes: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_plots", "histories", (slf, axes))
    }

    /// For notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_html", "simulation", (slf,))
    }

    /// What it was computed from: computed again when it is unpickled.
    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, Option<Py<PyTuple>>)> {
        let name = match self.source {
            Source::Own(_) => "simulation",
            Source::Tuned(_) => "tuned_histories",
        };
        let inputs = self.inputs.as_ref().map(|inputs| inputs.clone_ref(py));
        Ok((crate::restore(py, name)?, inputs))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __repr__(&self) -> String {
        let m = &self.both().matched;
        format!(
            "Simulation({}, NRMSE of u {:.2e}, of v {:.2e}, forces not checked)",
            self.outcome(),
            m.nrmse_horizontal,
            m.nrmse_vertical
        )
    }
}

/// A view of numbers of the finite element history.
fn column<'py>(
    of: &Bound<'py, Simulation>,
    pick: impl Fn(&fem::History) -> &[f64],
) -> PyResult<Array<'py>> {
    view(of.clone().into_any(), pick(&of.get().both().fem))
}

/// Both models on given springs.
///
/// friction  coefficient of the ground, without unit, for the warning of sliding
/// vertical  ground acceleration at the same times, positive upwards, if not that of the record
#[pyfunction]
#[pyo3(signature = (structure, springs, record, scale = 1.0, restitution = None, friction = 0.5,
    vertical = None))]
#[allow(clippy::too_many_arguments)]
pub fn simulate(
    py: Python<'_>,
    structure: Structure,
    springs: Springs,
    record: &Record,
    scale: f64,
    restitution: Option<f64>,
    friction: f64,
    vertical: Option<&Record>,
) -> PyResult<Simulation> {
    let e = ratio(restitution)?.unwrap_or(structure.e);
    let record = at_scale(record.beside(vertical)?, scale)?;
    springs.check_mass(py, "simulate", &structure)?;
    let inputs =
        (structure, springs, Record(record.clone().into_owned()), e, friction).into_pyobject(py)?;
    let simulation = interruptible(py, |_| {
        let (body, dt) = (structure.body(), record.dt);
        let both = compare_models(&body, e, &springs.chains(), &Members::default(), &record);
        let report = HousnerReport::new(&body, e, &record, &both.rocking, friction);
        let verdict = both.verdict(&body, dt, &report.conditioning);
        let findings = filed(reference::all(&structure.core, &record, &both, &report, &verdict));
        Simulation {
            structure,
            dt,
            findings,
            verdict,
            source: Source::Own(Box::new(both)),
            inputs: None,
        }
    })?;
    warn_of(py, &simulation.findings)?;
    Ok(simulation.again(inputs.unbind()))
}
