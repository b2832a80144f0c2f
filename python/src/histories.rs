//! Many of Housner's histories at once, as a sequence.

use std::sync::Arc;

use numpy::PyArray1;
use pyo3::{exceptions::PyIndexError, prelude::*};

use crate::{
    Array,
    rocking::{History, Solved},
    structure::hashed,
};

/// Body and time step; theta and its rate; times and rates of impacts, times and sides of uplifts;
/// how it ended, and when.
pub(crate) type SolvedNumbers<'a> = ([f64; 5], [&'a [f64]; 2], [Vec<f64>; 5], &'static str, Option<f64>);

/// Many histories: a sequence of `History`.
#[pyclass(frozen, sequence, module = "groundspring")]
pub struct Histories(pub(crate) Arc<Vec<Solved>>);

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

    /// A row a history: outcome, largest |theta|/alpha, impacts, when it overturned, s,
    /// samples.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("groundspring._tables")?.call_method1("histories", (slf,))
    }

    /// For notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("groundspring._html")?.call_method1("histories", (slf,))
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
        Ok((slf.py().import("groundspring._restore")?.getattr("histories")?, (each.collect(),)))
    }

    fn __repr__(&self) -> String {
        let overturned = self.0.iter().filter(|solved| solved.rocking.overturned().is_some()).count();
        format!("Histories({}, {overturned} overturned)", self.0.len())
    }
}

/// Histories that were pickled.
#[pyfunction]
pub fn _histories(all: Vec<PyRef<'_, History>>) -> Histories {
    let again = |one: &PyRef<'_, History>| {
        let Solved { body, dt, rocking, .. } = one.one();
        Solved::new(*body, *dt, rocking.clone())
    };
    Histories(Arc::new(all.iter().map(again).collect()))
}
