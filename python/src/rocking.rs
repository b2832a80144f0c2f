//! Housner's solution: one history, or many on all cores.

use std::{
    f64::consts::FRAC_PI_2,
    sync::{Arc, OnceLock},
};

use numpy::PyArray1;
use pyo3::{exceptions::PyIndexError, prelude::*};
use rocking::{
    housner::{self, Rocking, RockingOptions, RockingOutcome},
    motion::{self, Motion},
    structure::Body,
};

use crate::{
    Array,
    filed::Filed,
    many::Several,
    numbers::{factors, ratio},
    record::{Record, at_scale},
    structure::{Structure, hashed},
    times, view,
    work::interruptible,
};

mod pairs;

use pairs::pairs;

/// Histories computed between two looks for ^C.
const AT_A_TIME: usize = 2048;

/// One history and the body that it is of.
pub struct Solved {
    pub body: Body<f64>,
    pub dt: f64,
    pub rocking: Rocking<f64>,
    motion: OnceLock<Motion>,
}

impl Solved {
    pub fn new(body: Body<f64>, dt: f64, rocking: Rocking<f64>) -> Self {
        Self { body, dt, rocking, motion: OnceLock::new() }
    }

    fn motion(&self) -> &Motion {
        self.motion.get_or_init(|| self.rocking.motion(&self.body))
    }

    fn peak_ratio(&self) -> f64 {
        let peak = motion::peak(&self.rocking.theta).abs();
        Self::ratio(&self.body, &self.rocking, peak)
    }

    /// Largest |theta|/alpha of a history whose largest |theta| is `peak` (rad).
    pub fn ratio(body: &Body<f64>, rocking: &Rocking<f64>, peak: f64) -> f64 {
        // as in the tables of tune validate and tune sweep: one that overturned lies, and how far
        // it had fallen says nothing
        let theta = if rocking.overturned().is_some() { FRAC_PI_2 } else { peak };
        theta / body.alpha()
    }
}

/// The name of an outcome.
pub fn ended(outcome: &RockingOutcome) -> &'static str {
    match outcome {
        RockingOutcome::Rocked => "rocked",
        RockingOutcome::NeverMoved => "never_lifted",
        RockingOutcome::Overturned { .. } => "overturned",
        RockingOutcome::LeavesGround { .. } => "leaves_ground",
        RockingOutcome::WorkBound { .. } => "work_bound",
        RockingOutcome::NotFinite { .. } => "not_finite",
    }
}

/// A history of rigid rocking at the record's samples, cut where the body lies flat.
#[pyclass(frozen, module = "groundspring")]
pub struct History {
    all: Arc<Vec<Solved>>,
    index: usize,
}

impl History {
    pub fn new(body: Body<f64>, dt: f64, rocking: Rocking<f64>) -> Self {
        Self { all: Arc::new(vec![Solved::new(body, dt, rocking)]), index: 0 }
    }

    pub fn one(&self) -> &Solved {
        &self.all[self.index]
    }
}

#[pymethods]
impl History {
    /// Time step, s.
    #[getter]
    fn dt(&self) -> f64 {
        self.one().dt
    }

    /// Times of the samples, s.
    #[getter]
    fn t<'py>(&self, py: Python<'py>) -> Array<'py> {
        times(py, self.one().rocking.theta.len(), self.one().dt)
    }

    /// Rotation, positive leaning to the right, rad.
    #[getter]
    fn theta<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        view(slf.clone().into_any(), &slf.get().one().rocking.theta)
    }

    /// Rate of the rotation, rad/s.
    #[getter]
    fn rate<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        view(slf.clone().into_any(), &slf.get().one().rocking.rate)
    }

    /// Horizontal displacement of the centre of mass, positive to the right, m.
    #[getter]
    fn u<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        view(slf.clone().into_any(), &slf.get().one().motion().u)
    }

    /// Vertical displacement of the centre of mass, positive up, m.
    #[getter]
    fn v<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        view(slf.clone().into_any(), &slf.get().one().motion().v)
    }

    /// Times of the impacts, s.
    #[getter]
    fn impacts<'py>(&self, py: Python<'py>) -> Array<'py> {
        PyArray1::from_iter(py, self.one().rocking.impacts.iter().map(|i| i.time))
    }

    /// Rates of the rotation before the impacts, rad/s.
    #[getter]
    fn impact_rates<'py>(&self, py: Python<'py>) -> Array<'py> {
        PyArray1::from_iter(py, self.one().rocking.impacts.iter().map(|i| i.rate_before))
    }

    /// How it ended.
    #[getter]
    fn outcome(&self) -> &'static str {
        ended(&self.one().rocking.outcome)
    }

    /// When |theta| last grew past alpha, of a body that overturned, s.
    #[getter]
    fn overturned(&self) -> Option<f64> {
        self.one().rocking.overturned()
    }

    /// Largest |theta|/alpha, without unit; pi/2 / alpha if it overturned, as in every table.
    #[getter]
    fn peak_ratio(&self) -> f64 {
        self.one().peak_ratio()
    }

    fn __len__(&self) -> usize {
        self.one().rocking.theta.len()
    }

    fn __repr__(&self) -> String {
        format!(
            "History({}, {} samples, {} impacts, peak |theta|/alpha {:.4})",
            self.outcome(),
            self.__len__(),
            self.one().rocking.impacts.len(),
            self.peak_ratio()
        )
    }

    /// u and v, m, theta, rad, rate, rad/s, over time, s.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_tables", "motion", (slf,))
    }

    /// Rotation, mrad, over time, s, with the impacts.
    #[pyo3(signature = (axes = None))]
    fn plot<'py>(
        slf: &Bound<'py, Self>,
        axes: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_plots", "history", (slf, axes))
    }

    /// For notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_html", "history", (slf,))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self.one().numbers() == other.get().one().numbers())
    }

    fn __hash__(&self) -> u64 {
        hashed(self.outcome(), self.one().rocking.theta.iter())
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Filed<'py>,))> {
        let (body, _, events, outcome, time) = slf.get().one().numbers();
        let (theta, rate) = (Self::theta(slf)?.into_any(), Self::rate(slf)?.into_any());
        let filed = (body, theta, rate, events, outcome.to_owned(), time);
        Ok((crate::restore(slf.py(), "history")?, (filed,)))
    }
}

/// Many histories: a sequence of `History`.
#[pyclass(frozen, sequence, module = "groundspring")]
pub struct Histories(pub Arc<Vec<Solved>>);

#[pymethods]
impl Histories {
    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __getitem__(&self, index: isize) -> PyResult<History> {
        let n = self.0.len();
        let at = if index < 0 { index + n as isize } else { index };
        if !(0..n as isize).contains(&at) {
            return Err(PyIndexError::new_err(format!(
                "there are {n} histories, none of index {index}"
            )));
        }
        Ok(History { all: self.0.clone(), index: at as usize })
    }

    /// Largest |theta|/alpha of each, without unit; pi/2 / alpha where the body overturned.
    #[getter]
    fn peak_ratio<'py>(&self, py: Python<'py>) -> Array<'py> {
        PyArray1::from_iter(py, self.0.iter().map(Solved::peak_ratio))
    }

    /// How each ended.
    #[getter]
    fn outcome(&self) -> Vec<&'static str> {
        self.0.iter().map(|solved| ended(&solved.rocking.outcome)).collect()
    }

    /// Whether each overturned.
    #[getter]
    fn overturned<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        PyArray1::from_iter(py, self.0.iter().map(|solved| solved.rocking.overturned().is_some()))
    }

    /// A row a history: outcome, largest |theta|/alpha, impacts, when it overturned, s,
    /// samples.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_tables", "histories", (slf,))
    }

    /// For notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_html", "histories", (slf,))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        let same = |(a, b): (&Solved, &Solved)| a.numbers() == b.numbers();
        other.cast::<Self>().is_ok_and(|other| {
            let (a, b) = (&self.0, &other.get().0);
            a.len() == b.len() && a.iter().zip(b.iter()).all(same)
        })
    }

    fn __hash__(&self) -> u64 {
        hashed("", self.0.iter().filter_map(|solved| solved.rocking.theta.last()))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, (Vec<History>,))> {
        let all = &slf.get().0;
        let each = (0..all.len()).map(|index| History { all: all.clone(), index });
        Ok((crate::restore(slf.py(), "histories")?, (each.collect(),)))
    }

    fn __repr__(&self) -> String {
        let overturned =
            self.0.iter().filter(|solved| solved.rocking.overturned().is_some()).count();
        format!("Histories({}, {overturned} overturned)", self.0.len())
    }
}

/// Housner's solution for a structure on a record.
///
/// vertical  ground acceleration at the same times, positive upwards, if not that of the
///           record; the history ends where the
///           ground would have to pull (outcome "leaves_ground")
///
/// ValueError: a vertical record of other times; a scale (none of zero) or restitution out of
/// range.
#[pyfunction]
#[pyo3(signature = (structure, record, vertical = None, scale = 1.0, restitution = None))]
pub fn rigid_rocking(
    py: Python<'_>,
    structure: &Structure,
    record: &Record,
    vertical: Option<&Record>,
    scale: f64,
    restitution: Option<f64>,
) -> PyResult<History> {
    let e = ratio(restitution)?.unwrap_or(structure.e);
    // as the program scales: the samples are, so that both agree to the last bit
    let record = at_scale(record.beside(vertical)?, scale)?;
    let body = structure.body();
    let options = RockingOptions::on(&record, e);
    let rocking = py.detach(|| housner::solve(&body, record.dt, &record.accel, &options));
    Ok(History::new(body, record.dt, rocking))
}

/// Housner's solutions on all cores: of several structures, or at several scales, or of as many
/// pairs of both.
///
/// scales  factors on the record, without unit; 1 unless given
///
/// ValueError: structures and scales of different number, neither of which is one.
#[pyfunction]
#[pyo3(signature = (structures, record, scales = None, restitution = None))]
pub fn rigid_rocking_many(
    py: Python<'_>,
    structures: Several<Structure>,
    record: &Record,
    scales: Option<Bound<'_, PyAny>>,
    restitution: Option<f64>,
) -> PyResult<Histories> {
    let (structures, scales) = (structures.all(), factors(scales)?);
    let (bodies, options) = pairs(&structures, record, &scales, ratio(restitution)?)?;
    let (dt, accel) = (record.0.dt, &record.0.accel[..]);
    let n = bodies.len().max(options.len());
    let solved = interruptible(py, |stop| {
        let mut all =
            Vec::with_capacity(if bodies.is_empty() || options.is_empty() { 0 } else { n });
        for from in (0..all.capacity().min(n)).step_by(AT_A_TIME) {
            stop.check();
            let to = n.min(from + AT_A_TIME);
            let bodies = if bodies.len() > 1 { &bodies[from..to] } else { &bodies[..] };
            let options = if options.len() > 1 { &options[from..to] } else { &options[..] };
            let rocked = housner::solve_lanes(bodies, dt, accel, options);
            let body = bodies.iter().cycle();
            all.extend(
                rocked.into_iter().zip(body).map(|(rocking, body)| Solved::new(*body, dt, rocking)),
            );
        }
        all
    })?;
    Ok(Histories(Arc::new(solved)))
}
