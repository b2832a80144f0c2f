//! Ground motions.

use std::{borrow::Cow, path::PathBuf};

use cases::NO_MOTION;
use pyo3::prelude::*;
use strong_motion as core;
use strong_motion::{Recording, TableColumn, Units};

use crate::{
    Array, numbers,
    said::{shown, value_error, value_error_of, warn_of_file},
    structure::hashed,
    times, view,
};

/// Scales that a record can be taken at, or an error in the words of the scale or of the record.
pub fn checked_scales(record: &core::Record, scales: &[f64]) -> PyResult<()> {
    if let Some((i, scale)) = scales.iter().enumerate().find(|(_, scale)| !scale.is_finite()) {
        let at = if scales.len() > 1 { format!("scales[{i}]") } else { "scales".to_owned() };
        return Err(value_error(format!(
            "{at} is {}; every scale must be a finite number",
            scale.to_string().to_lowercase()
        )));
    }
    let largest = scales.iter().copied().max_by(|a, b| a.abs().total_cmp(&b.abs()));
    match largest.filter(|scale| (scale * record.pga_g()).abs() >= 50.0) {
        Some(scale) => record.scaled(scale).map(|_| ()).map_err(value_error),
        None => Ok(()),
    }
}

/// A record at a scale; none at a scale of zero, as the program has it.
pub fn at_scale(record: Cow<'_, core::Record>, scale: f64) -> PyResult<Cow<'_, core::Record>> {
    match scale {
        1.0 => Ok(record),
        0.0 => Err(value_error(format!("scale is 0; {NO_MOTION}"))),
        _ => record.scaled(scale).map(Cow::Owned).map_err(value_error),
    }
}

/// A ground motion: acceleration at even time steps, linear in between. Equal ones have equal
/// names and numbers.
///
/// dt     time step, s
/// accel  ground acceleration at t = i dt, positive to the right, in `units`: one row of real
///        numbers
/// name   what it is called
/// units  of accel: "m/s2", "g" (9.81 m/s2), "cm/s2", "mm/s2", "mg", "%g", "ft/s2", "in/s2" or
///        "mGal"
///
/// A time step of 0.05 s and more, and peaks that no earthquake has (above 5 g or 3 m/s, below
/// 1e-4 g), are a GroundspringWarning.
///
/// ValueError: dt not between 1e-6 and 1 s, no sample, a sample that is not finite, a peak
/// above 50 g; an array of two dimensions, masked, complex, or with units of its own.
#[pyclass(frozen, eq, from_py_object, module = "groundspring")]
#[derive(Clone, PartialEq)]
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
    #[pyo3(signature = (dt, accel, name = "record", *, units = "m/s2"))]
    fn new(
        py: Python<'_>,
        dt: &Bound<'_, PyAny>,
        accel: &Bound<'_, PyAny>,
        name: &str,
        units: &str,
    ) -> PyResult<Self> {
        let factor = units.parse::<Units>().map_err(value_error)?.metres_per_second2();
        let dt = numbers::real(dt, "dt", "the time step in s")?;
        let mut accel =
            numbers::row(accel, "accel", "accelerations in m/s2, or in the units that are named")?;
        if factor != 1.0 {
            accel.iter_mut().for_each(|a| *a *= factor);
        }
        let record =
            core::Record::new(name, dt, accel).map_err(|error| value_error_of(error, &[name]))?;
        // a slow push that is made of numbers may end with any velocity
        let doubtful = core::notices(&record, name, "").into_iter();
        doubtful
            .filter(|notice| !matches!(notice, core::Notice::Fast { .. }))
            .try_for_each(|notice| warn_of_file(py, &notice, &[name]))?;
        Ok(Self(record))
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

    /// The record with a vertical ground acceleration at the same times, positive upwards: a
    /// Record, or a row of numbers, m/s2.
    fn with_vertical(&self, up: &Bound<'_, PyAny>) -> PyResult<Self> {
        let up = match up.cast::<Self>() {
            Ok(record) => record.get().clone(),
            Err(_) => {
                let accel = numbers::row(up, "up", "a Record, or accelerations in m/s2")?;
                Self(core::Record::new("up", self.0.dt, accel).map_err(value_error)?)
            }
        };
        Ok(Self(self.beside(Some(&up))?.into_owned()))
    }

    /// Every acceleration times a factor, the vertical ones too.
    fn scaled(&self, factor: f64) -> PyResult<Self> {
        self.0.scaled(factor).map(Self).map_err(value_error)
    }

    /// The samples up to this time, s; at least the first.
    ///
    /// ValueError: no time above zero.
    fn truncated(&self, duration: f64) -> PyResult<Self> {
        if duration.is_nan() || duration <= 0.0 {
            return Err(value_error(format!(
                "truncated: duration is {duration:?}; give seconds greater than zero"
            )));
        }
        Ok(Self(self.0.truncated(duration)))
    }

    /// Ground acceleration, g, over time, s, with the vertical one if there is one.
    #[pyo3(signature = (axes = None))]
    fn plot<'py>(
        slf: &Bound<'py, Self>,
        axes: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_plots", "record", (slf, axes))
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __hash__(&self) -> u64 {
        let r = &self.0;
        let up = r.vertical.as_ref().map(|up| core::as_record(up, r.dt));
        let numbers = r.accel.iter().chain(up.iter().flat_map(|up| &up.accel));
        hashed(&r.name, std::iter::once(&r.dt).chain(numbers))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let (py, of) = (slf.py(), slf.get());
        let args = (of.0.dt, Self::accel(slf)?, of.0.name.clone(), of.vertical());
        Ok((crate::restore(py, "record")?, args.into_pyobject(py)?.into_any()))
    }

    /// For notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_html", "record", (slf,))
    }

    fn __repr__(&self) -> String {
        let r = &self.0;
        format!("Record({:?}: {} samples of {} s, PGA {:.4} g)", r.name, r.len(), r.dt, r.pga_g())
    }
}

/// The record in a file: PEER AT2, GeoNet, COSMOS, CSMIP, K-NET, ESM or columns.
///
/// component  name or azimuth in degrees, of a file with several; the stronger horizontal one
///            unless given
/// dt, units  where the file does not say: s; "g", "m/s2" or another unit that `Record` takes
/// baseline   subtract the mean of the samples
/// column     of a table of several: its number, from 1 with the times, or its name
/// vertical   the file of the vertical component, or "auto": that of the same file; none unless
///            given
///
/// ValueError: the file cannot be read, is no record, is damaged, or does not agree with what
/// is said of it.
#[pyfunction]
#[pyo3(signature = (path, component = None, dt = None, units = None, baseline = false,
    vertical = None, column = None))]
#[allow(clippy::too_many_arguments)]
pub fn read_record(
    py: Python<'_>,
    path: PathBuf,
    component: Option<&Bound<'_, PyAny>>,
    dt: Option<f64>,
    units: Option<&str>,
    baseline: bool,
    vertical: Option<PathBuf>,
    column: Option<&Bound<'_, PyAny>>,
) -> PyResult<Record> {
    let units = units.map(str::parse::<Units>).transpose().map_err(value_error)?;
    // an azimuth may be given as a number
    let component =
        component.map(|component| component.str().map(|s| s.to_string())).transpose()?;
    let column = column.map(|column| column.str().map(|s| s.to_string())).transpose()?;
    let component = match (component, column) {
        (Some(_), Some(_)) => {
            return Err(value_error("read_record: give component or column, not both"));
        }
        (component, None) => component,
        (None, Some(column)) => {
            let column: TableColumn = match column.parse() {
                Ok(column) => column,
                Err(never) => match never {},
            };
            Some(column.component())
        }
    };
    let up = vertical.clone();
    let options =
        core::ReadOptions { dt, units, component, baseline, vertical: vertical.map(Into::into) };
    let names = [shown(&path), up.as_deref().map_or_else(String::new, shown)];
    let names: Vec<&str> =
        names.iter().map(String::as_str).filter(|name| *name != "auto").collect();
    let recording = py
        .detach(|| Recording::read(&path, &options))
        .map_err(|error| value_error_of(error, &names))?;
    recording.notices().iter().try_for_each(|notice| warn_of_file(py, notice, &names))?;
    Ok(Record(recording.into_record()))
}

/// Imperial Valley 1940, El Centro Array #9, component 180 (north-south), PEER: 3995 samples,
/// dt 0.01 s.
#[pyfunction]
pub fn el_centro() -> Record {
    Record(core::Record::el_centro())
}
