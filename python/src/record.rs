//! Ground motions.

use std::{borrow::Cow, path::PathBuf};

use numpy::{AllowTypeChange, PyArrayLike1};
use pyo3::prelude::*;
use strong_motion as core;
use strong_motion::{Recording, Units};

use crate::{
    Array,
    said::{value_error, warn},
    times, view,
};

/// A ground motion: acceleration at even time steps, linear in between.
#[pyclass(frozen, module = "groundspring")]
#[derive(Clone)]
pub struct Record(pub core::Record);

impl Record {
    /// With the vertical motion given beside it, if one is.
    pub fn beside(&self, vertical: Option<&Self>) -> PyResult<Cow<'_, core::Record>> {
        let Some(up) = vertical else { return Ok(Cow::Borrowed(&self.0)) };
        self.0.clone().with_vertical(up.0.clone()).map(Cow::Owned).map_err(value_error)
    }
}

#[pymethods]
impl Record {
    #[new]
    #[pyo3(signature = (dt, accel, name = "record"))]
    fn new(dt: f64, accel: PyArrayLike1<'_, f64, AllowTypeChange>, name: &str) -> PyResult<Self> {
        let accel = accel.as_array().to_vec();
        core::Record::new(name, dt, accel).map(Self).map_err(value_error)
    }

    /// What it is called.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Time step, s.
    #[getter]
    fn dt(&self) -> f64 {
        self.0.dt
    }

    /// Ground acceleration at t = i dt, positive to the right, m/s2.
    #[getter]
    fn accel<'py>(slf: &Bound<'py, Self>) -> PyResult<Array<'py>> {
        view(slf.clone().into_any(), &slf.get().0.accel)
    }

    /// Times of the samples, s.
    #[getter]
    fn t<'py>(&self, py: Python<'py>) -> Array<'py> {
        times(py, self.0.len(), self.0.dt)
    }

    /// Time of the last sample, s.
    #[getter]
    fn duration(&self) -> f64 {
        self.0.duration()
    }

    /// Peak ground acceleration, m/s2.
    #[getter]
    fn pga(&self) -> f64 {
        self.0.pga()
    }

    /// Peak ground acceleration, g.
    #[getter]
    fn pga_g(&self) -> f64 {
        self.0.pga_g()
    }

    /// The vertical ground acceleration that goes with it, positive upwards.
    #[getter]
    fn vertical(&self) -> Option<Self> {
        self.0.vertical.as_ref().map(|up| Self(core::as_record(up, self.0.dt)))
    }

    fn with_vertical(&self, up: &Self) -> PyResult<Self> {
        Ok(Self(self.beside(Some(up))?.into_owned()))
    }

    fn scaled(&self, factor: f64) -> PyResult<Self> {
        self.0.scaled(factor).map(Self).map_err(value_error)
    }

    fn truncated(&self, duration: f64) -> Self {
        Self(self.0.truncated(duration))
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __repr__(&self) -> String {
        let r = &self.0;
        format!("Record({:?}: {} samples of {} s, PGA {:.4} g)", r.name, r.len(), r.dt, r.pga_g())
    }
}

/// The record in a file of any format that the program reads.
#[pyfunction]
#[pyo3(signature = (path, component = None, dt = None, units = None, baseline = false, vertical = None))]
pub fn read_record(
    py: Python<'_>,
    path: PathBuf,
    component: Option<&Bound<'_, PyAny>>,
    dt: Option<f64>,
    units: Option<&str>,
    baseline: bool,
    vertical: Option<PathBuf>,
) -> PyResult<Record> {
    let units = units.map(str::parse::<Units>).transpose().map_err(value_error)?;
    // an azimuth may be given as a number
    let component = component.map(|component| component.str().map(|s| s.to_string())).transpose()?;
    let options = core::ReadOptions { dt, units, component, baseline, vertical: vertical.map(Into::into) };
    let recording = py.detach(|| Recording::read(&path, &options)).map_err(value_error)?;
    recording.notices().iter().try_for_each(|notice| warn(py, notice))?;
    Ok(Record(recording.into_record()))
}

/// El Centro 1940, north-south, from PEER.
#[pyfunction]
pub fn el_centro() -> Record {
    Record(core::Record::el_centro())
}
