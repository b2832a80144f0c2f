//! Housner's solution: one history, or many on all cores.

use std::{
    borrow::Cow,
    f64::consts::FRAC_PI_2,
    sync::{Arc, OnceLock},
};

use numpy::{AllowTypeChange, PyArray1, PyArrayLike1};
use pyo3::{exceptions::PyIndexError, prelude::*};
use rocking::{
    housner::{self, Rocking, RockingOptions, RockingOutcome},
    motion::Motion,
    structure::Body,
};
use springs::case::LONGEST_S;

use crate::{Array, record::Record, said::value_error, structure::Structure, times, view, work::interruptible};

/// Histories computed between two looks for ^C.
const AT_A_TIME: usize = 2048;

/// One history and the body that it is of.
struct Solved {
    body: Body<f64>,
    dt: f64,
    rocking: Rocking<f64>,
    motion: OnceLock<Motion>,
}

impl Solved {
    fn new(body: Body<f64>, dt: f64, rocking: Rocking<f64>) -> Self {
        Self { body, dt, rocking, motion: OnceLock::new() }
    }

    fn motion(&self) -> &Motion {
        self.motion.get_or_init(|| self.rocking.motion(&self.body))
    }

    fn peak_ratio(&self) -> f64 {
        if self.rocking.overturned().is_some() {
            // as in the tables of tune validate and tune sweep: it lies, and how far it had fallen
            // says nothing
            return FRAC_PI_2 / self.body.alpha();
        }
        self.rocking.theta.iter().fold(0.0, |peak: f64, x| peak.max(x.abs())) / self.body.alpha()
    }
}

/// A history of rigid rocking at the record's samples.
#[pyclass(frozen, module = "groundspring")]
pub struct History {
    all: Arc<Vec<Solved>>,
    index: usize,
}

impl History {
    pub fn new(body: Body<f64>, dt: f64, rocking: Rocking<f64>) -> Self {
        Self { all: Arc::new(vec![Solved::new(body, dt, rocking)]), index: 0 }
    }

    fn one(&self) -> &Solved {
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
        match self.one().rocking.outcome {
            RockingOutcome::Rocked => "rocked",
            RockingOutcome::NeverMoved => "never_lifted",
            RockingOutcome::Overturned { .. } => "overturned",
            RockingOutcome::LeavesGround { .. } => "leaves_ground",
            RockingOutcome::WorkBound { .. } => "work_bound",
            RockingOutcome::NotFinite { .. } => "not_finite",
        }
    }

    /// When |theta| last grew past alpha, of a body that overturned, s.
    #[getter]
    fn overturned(&self) -> Option<f64> {
        self.one().rocking.overturned()
    }

    /// Largest |theta|/alpha, without unit; pi/2 / alpha if it overturned, as in every table of the
    /// program.
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

    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("groundspring._tables")?.call_method1("motion", (slf,))
    }
}

/// Many histories: a sequence.
#[pyclass(frozen, sequence, module = "groundspring")]
pub struct Histories(Arc<Vec<Solved>>);

#[pymethods]
impl Histories {
    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __getitem__(&self, index: isize) -> PyResult<History> {
        let n = self.0.len();
        let at = if index < 0 { index + n as isize } else { index };
        if !(0..n as isize).contains(&at) {
            return Err(PyIndexError::new_err(format!("there are {n} histories, none of index {index}")));
        }
        Ok(History { all: self.0.clone(), index: at as usize })
    }

    /// Largest |theta|/alpha of each, without unit; pi/2 / alpha where the body overturned.
    #[getter]
    fn peak_ratio<'py>(&self, py: Python<'py>) -> Array<'py> {
        PyArray1::from_iter(py, self.0.iter().map(Solved::peak_ratio))
    }

    /// Whether each overturned.
    #[getter]
    fn overturned<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        PyArray1::from_iter(py, self.0.iter().map(|solved| solved.rocking.overturned().is_some()))
    }

    fn __repr__(&self) -> String {
        format!("Histories({})", self.0.len())
    }
}

/// Housner's solution for a structure on a record; `vertical` holds the vertical ground
/// acceleration at the same times, positive upwards.
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
    let record = record.beside(vertical)?;
    let record = if scale == 1.0 { record } else { Cow::Owned(record.scaled(scale).map_err(value_error)?) };
    let body = structure.body();
    let options =
        RockingOptions { restitution: Some(e), vertical: record.vertical_accel(), ..RockingOptions::default() };
    let rocking = py.detach(|| housner::solve(&body, record.dt, &record.accel, &options));
    Ok(History::new(body, record.dt, rocking))
}

/// One or several.
#[derive(FromPyObject)]
pub enum Structures {
    One(Structure),
    Several(Vec<Structure>),
}

#[derive(FromPyObject)]
pub enum Scales<'py> {
    One(f64),
    Several(PyArrayLike1<'py, f64, AllowTypeChange>),
}

/// Housner's solutions for several structures, or several scales of the record, or pairs of both,
/// on all cores.
#[pyfunction]
#[pyo3(signature = (structures, record, scales = Scales::One(1.0), restitution = None))]
pub fn rigid_rocking_many(
    py: Python<'_>,
    structures: Structures,
    record: &Record,
    scales: Scales<'_>,
    restitution: Option<f64>,
) -> PyResult<Histories> {
    let structures = match structures {
        Structures::One(one) => vec![one],
        Structures::Several(several) => several,
    };
    let scales = match scales {
        Scales::One(one) => vec![one],
        Scales::Several(several) => several.as_array().to_vec(),
    };
    let (bodies, options) = pairs(&structures, record, &scales, ratio(restitution)?)?;
    let (dt, accel) = (record.0.dt, &record.0.accel[..]);
    let n = bodies.len().max(options.len());
    let solved = interruptible(py, |stop| {
        let mut all = Vec::with_capacity(if bodies.is_empty() || options.is_empty() { 0 } else { n });
        for from in (0..all.capacity().min(n)).step_by(AT_A_TIME) {
            stop.check();
            let to = n.min(from + AT_A_TIME);
            let bodies = if bodies.len() > 1 { &bodies[from..to] } else { &bodies[..] };
            let options = if options.len() > 1 { &options[from..to] } else { &options[..] };
            let rocked = housner::solve_lanes(bodies, dt, accel, options);
            let body = bodies.iter().cycle();
            all.extend(rocked.into_iter().zip(body).map(|(rocking, body)| Solved::new(*body, dt, rocking)));
        }
        all
    })?;
    Ok(Histories(Arc::new(solved)))
}

/// Bodies, and how to solve each.
type Pairs = (Vec<Body<f64>>, Vec<RockingOptions<f64>>);

/// Bodies and options of one length, or one of length 1.
fn pairs(structures: &[Structure], record: &Record, scales: &[f64], restitution: Option<f64>) -> PyResult<Pairs> {
    let (n, m) = (structures.len(), scales.len());
    if n != m && n != 1 && m != 1 {
        return Err(value_error(format!(
            "rigid_rocking_many: {n} structures and {m} scales; give one of either, or as many of both"
        )));
    }
    // an impossible scale is refused in the words of the record
    let pga_g = record.0.pga_g();
    let worst = scales.iter().find(|s| !s.is_finite()).or(scales.iter().max_by(|a, b| a.abs().total_cmp(&b.abs())));
    if let Some(&worst) = worst.filter(|s| !(s.is_finite() && (*s * pga_g).abs() < 50.0)) {
        record.0.scaled(worst).map_err(value_error)?;
    }
    let bodies = structures.iter().map(Structure::body).collect();
    // the restitution goes with the structure: as many options as there are of the longer list
    let same_e = structures.windows(2).all(|pair| pair[0].e == pair[1].e);
    let count = if same_e { m } else { n.max(m) };
    let options = (0..count.min(n * m)).map(|i| {
        let e = restitution.unwrap_or(structures[i % n].e);
        RockingOptions {
            scale: scales[i % m],
            restitution: Some(e),
            vertical: record.0.vertical_accel(),
            ..RockingOptions::default()
        }
    });
    Ok((bodies, options.collect()))
}

/// A length of history (s), in the program's words if it is none.
pub fn seconds(given: Option<f64>) -> PyResult<Option<f64>> {
    match given {
        Some(d) if !(d > 0.0 && d <= LONGEST_S) => {
            Err(value_error(format!("duration is {d:?}; give seconds greater than zero, at most 1e6")))
        }
        given => Ok(given),
    }
}

/// A velocity ratio, in the program's words if it is none.
pub fn ratio(given: Option<f64>) -> PyResult<Option<f64>> {
    match given {
        Some(e) if !(0.0..=1.0).contains(&e) => {
            Err(value_error(format!("restitution is {e:?}; a velocity ratio lies between 0 and 1")))
        }
        given => Ok(given),
    }
}
