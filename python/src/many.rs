//! Many structures on many records at many scales: one table, on all cores.
//!
//! A history is dropped as soon as its row is written: ten thousand of them take the memory of a
//! few hundred.

use std::sync::{
    Arc,
    atomic::{AtomicUsize, Ordering},
};

use numpy::PyArray1;
use pyo3::{
    PyClass,
    exceptions::{PyKeyError, PyTypeError},
    prelude::*,
    types::{PyCapsule, PyList, PySequence, PyString},
};
use rocking::{
    housner::{self, Rocking, RockingOptions},
    motion::{peak, peak_index},
    structure::Body,
};

use crate::{
    arrow::{ArrowArrayStream, Column, Columns},
    numbers::{self, a_kind, factors, ratio},
    record::{Record, checked_scales},
    rocking::{Solved, ended},
    said::value_error,
    structure::Structure,
    work::{self, Stop},
};

/// Histories of one record solved together: enough for every lane, few enough for every core and a
/// look for ^C.
const TOGETHER: usize = 256;

/// A row of the table.
struct Row {
    outcome: &'static str,
    peak_ratio: f64,
    peak_theta: f64,
    peak_rate: f64,
    peak_u: f64,
    peak_time: f64,
    uplift: f64,
    impacts: i64,
    last_impact: f64,
    overturned: f64,
}

impl Row {
    fn new(body: &Body<f64>, dt: f64, rocking: &Rocking<f64>) -> Self {
        let peak_at = peak_index(&rocking.theta);
        let theta = rocking.theta.get(peak_at).map_or(0.0, |theta| theta.abs());
        Self {
            outcome: ended(&rocking.outcome),
            peak_ratio: Solved::ratio(body, rocking, theta),
            peak_theta: theta,
            peak_rate: peak(&rocking.rate).abs(),
            // the farther it leans, the farther it is
            peak_u: body.u(theta).abs(),
            peak_time: peak_at as f64 * dt,
            uplift: rocking.uplifts.first().map_or(f64::NAN, |uplift| uplift.time),
            impacts: rocking.impacts.len() as i64,
            last_impact: rocking.impacts.last().map_or(f64::NAN, |impact| impact.time),
            overturned: rocking.overturned().unwrap_or(f64::NAN),
        }
    }
}

/// What is solved: every structure at every scale on every record.
struct Asked<'a> {
    structures: &'a [Structure],
    records: &'a [strong_motion::Record],
    scales: &'a [f64],
    restitution: Option<f64>,
}

impl Asked<'_> {
    fn of_a_record(&self) -> usize {
        self.structures.len() * self.scales.len()
    }

    fn count(&self) -> usize {
        self.of_a_record() * self.records.len()
    }

    /// Structure, record and scale of a row: scales run fastest, then structures.
    fn at(&self, row: usize) -> (usize, usize, usize) {
        let (record, row) = (row / self.of_a_record(), row % self.of_a_record());
        (row / self.scales.len(), record, row % self.scales.len())
    }

    fn solve(&self, stop: &Stop, done: &AtomicUsize) -> Vec<Row> {
        let each = self.of_a_record();
        let jobs: Vec<(usize, usize)> = (0..self.records.len())
            .flat_map(|r| (0..each).step_by(TOGETHER).map(move |from| (r, from)))
            .collect();
        let verticals: Vec<_> =
            self.records.iter().map(strong_motion::Record::vertical_accel).collect();
        let solve = |&(r, from): &(usize, usize)| {
            // whatever it has found is dropped by `rocking`, once all threads have come to this
            if stop.asked() {
                return Vec::new();
            }
            let record = &self.records[r];
            let those = from..each.min(from + TOGETHER);
            let bodies: Vec<_> =
                those.clone().map(|i| self.structures[self.at(i).0].body()).collect();
            let options: Vec<_> = those
                .map(|i| RockingOptions {
                    scale: self.scales[self.at(i).2],
                    restitution: Some(self.restitution.unwrap_or(self.structures[self.at(i).0].e)),
                    vertical: verticals[r].clone(),
                    ..RockingOptions::default()
                })
                .collect();
            let rocked = housner::solve_lanes(&bodies, record.dt, &record.accel, &options);
            done.fetch_add(rocked.len(), Ordering::Relaxed);
            bodies
                .iter()
                .zip(&rocked)
                .map(|(body, rocking)| Row::new(body, record.dt, rocking))
                .collect()
        };
        parallel::map(&jobs, solve).into_iter().flatten().collect()
    }

    fn table(&self, rows: &[Row]) -> Columns {
        let n = rows.len();
        let place =
            |pick: fn((usize, usize, usize)) -> usize| (0..n).map(move |i| pick(self.at(i)));
        let whole = |pick| Column::Whole(place(pick).map(|i| i as i64).collect());
        let real = |pick: fn(&Row) -> f64| Column::Real(rows.iter().map(pick).collect());
        let all = vec![
            ("structure", whole(|at| at.0)),
            ("record", Column::words(place(|at| at.1).map(|i| self.records[i].name.as_str()))),
            ("record_index", whole(|at| at.1)),
            ("scale", Column::Real(place(|at| at.2).map(|i| self.scales[i]).collect())),
            ("outcome", Column::words(rows.iter().map(|row| row.outcome))),
            ("peak_ratio", real(|row| row.peak_ratio)),
            ("peak_theta", real(|row| row.peak_theta)),
            ("peak_rate", real(|row| row.peak_rate)),
            ("peak_u", real(|row| row.peak_u)),
            ("peak_time", real(|row| row.peak_time)),
            ("uplift_time", real(|row| row.uplift)),
            ("impacts", Column::Whole(rows.iter().map(|row| row.impacts).collect())),
            ("last_impact_time", real(|row| row.last_impact)),
            ("overturned_time", real(|row| row.overturned)),
        ];
        Columns { rows: n, all }
    }
}

/// A table of histories, a row each: what `rocking` returns, where its columns are told.
#[pyclass(frozen, module = "groundspring")]
pub struct RockingTable(Arc<Columns>);

#[pymethods]
impl RockingTable {
    /// Names of the columns.
    #[getter]
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        PyList::new(py, self.0.all.iter().map(|(name, _)| *name))
    }

    fn __len__(&self) -> usize {
        self.0.rows
    }

    /// A column: an array of numbers, or a list of words.
    fn __getitem__<'py>(slf: &Bound<'py, Self>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let (py, columns) = (slf.py(), &slf.get().0);
        let Some((_, column)) = columns.all.iter().find(|(column, _)| *column == name) else {
            let names: Vec<_> = columns.all.iter().map(|(name, _)| *name).collect();
            return Err(PyKeyError::new_err(format!(
                "there is no column {name:?}; there are {}",
                names.join(", ")
            )));
        };
        Ok(match column {
            Column::Real(x) => crate::view(slf.clone().into_any(), x)?.into_any(),
            Column::Whole(x) => PyArray1::from_slice(py, x).into_any(),
            Column::Words(..) => {
                PyList::new(py, (0..columns.rows).filter_map(|i| column.word(i)))?.into_any()
            }
        })
    }

    /// For whoever reads Arrow: `polars.DataFrame(table)`, `pyarrow.table(table)`. The numbers
    /// are not copied.
    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // the interface lets the table keep its own types
        drop(requested_schema);
        PyCapsule::new_with_value(py, ArrowArrayStream::of(self.0.clone()), c"arrow_array_stream")
    }

    /// The table as it is, units as in `rocking`.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_tables", "rocking", (slf,))
    }

    /// The same for polars, without a copy.
    fn to_polars<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_tables", "polars", (slf,))
    }

    fn __repr__(&self) -> String {
        let outcomes =
            self.0.all.iter().find(|(name, _)| *name == "outcome").map(|(_, column)| column);
        let overturned = (0..self.0.rows)
            .filter(|i| outcomes.and_then(|c| c.word(*i)) == Some("overturned"))
            .count();
        format!("RockingTable({} histories, {overturned} overturned)", self.0.rows)
    }

    /// For notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_html", "rocking", (slf,))
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyAny>,))> {
        let columns = slf.call_method0("_columns")?;
        Ok((crate::restore(slf.py(), "table")?, (columns,)))
    }

    /// Names and columns.
    fn _columns<'py>(slf: &Bound<'py, Self>) -> PyResult<Vec<(&'static str, Bound<'py, PyAny>)>> {
        let columns = &slf.get().0;
        columns.all.iter().map(|(name, _)| Ok((*name, Self::__getitem__(slf, name)?))).collect()
    }
}

/// What `groundspring.rocking` calls; progress is told how many histories more are done.
#[pyfunction]
#[pyo3(signature = (structures, records, scales = None, *, vertical = None, restitution = None,
    progress = None), name = "rocking")]
pub fn rock_all(
    py: Python<'_>,
    structures: Several<Structure>,
    records: Several<Record>,
    scales: Option<Bound<'_, PyAny>>,
    vertical: Option<Several<Record>>,
    restitution: Option<f64>,
    progress: Option<Bound<'_, PyAny>>,
) -> PyResult<RockingTable> {
    let (structures, records) = (structures.all(), records.all());
    let scales = factors(scales)?;
    let records = beside(records, vertical.map(Several::all))?;
    for record in &records {
        checked_scales(record, &scales)?;
    }
    let restitution = ratio(restitution)?;
    let asked = Asked { structures: &structures, records: &records, scales: &scales, restitution };
    if asked.count() == 0 {
        return Err(value_error(
            "rocking: there are no structures, records or scales; give at least one of each",
        ));
    }
    let done = AtomicUsize::new(0);
    let mut told = 0;
    let tell = |_: Python<'_>| {
        let now = done.load(Ordering::Relaxed);
        if let Some(progress) = progress.as_ref().filter(|_| now > told) {
            progress.call1((now - told,))?;
        }
        told = now;
        Ok(())
    };
    let columns = work::watched(
        py,
        |stop| {
            let rows = asked.solve(stop, &done);
            stop.check();
            asked.table(&rows)
        },
        tell,
    )?;
    Ok(RockingTable(Arc::new(columns)))
}

/// Each record with the vertical one that goes with it: one for all, or as many.
fn beside(
    records: Vec<Record>,
    vertical: Option<Vec<Record>>,
) -> PyResult<Vec<strong_motion::Record>> {
    let Some(ups) = vertical else {
        return Ok(records.into_iter().map(|record| record.0).collect());
    };
    if ups.len() != 1 && ups.len() != records.len() {
        let (n, m) = (records.len(), ups.len());
        return Err(value_error(format!(
            "rocking: {n} records and {m} vertical ones; give one for all, or as many"
        )));
    }
    let pairs = records.iter().zip(ups.iter().cycle());
    pairs.map(|(record, up)| Ok(record.beside(Some(up))?.into_owned())).collect()
}

/// One or several.
pub enum Several<T> {
    One(T),
    Many(Vec<T>),
}

impl<'py, T> FromPyObject<'_, 'py> for Several<T>
where
    T: PyClass + Clone,
{
    type Error = PyErr;

    fn extract(of: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(one) = of.cast::<T>() {
            return Ok(Self::One(one.borrow().clone()));
        }
        let give = format!("give a {}, or a list of them", <T as PyClass>::NAME);
        several_of(&of, "", &give).map(Self::Many)
    }
}

/// All items of a list of one kind, which may have a name; `give` says what to give if it is none.
pub fn several_of<T: PyClass + Clone>(
    of: &Bound<'_, PyAny>,
    name: &str,
    give: &str,
) -> PyResult<Vec<T>> {
    let refused = |what: String, found: &Bound<'_, PyAny>| {
        PyTypeError::new_err(format!("{what} is {}; {give}", a_kind(found)))
    };
    let whole = || if name.is_empty() { "the argument".to_owned() } else { name.to_owned() };
    let list = of.cast::<PySequence>().map_err(|_| refused(whole(), of))?;
    if of.is_instance_of::<PyString>() {
        return Err(refused(whole(), of));
    }
    let item = |(i, item): (usize, PyResult<Bound<'_, PyAny>>)| {
        let item = item?;
        let one = item.cast::<T>().map(|one| one.borrow().clone());
        let at = if name.is_empty() { format!("item {i}") } else { format!("{name}[{i}]") };
        one.map_err(|_| refused(at, &item))
    };
    list.try_iter()?.enumerate().map(item).collect()
}

impl<T> Several<T> {
    pub fn all(self) -> Vec<T> {
        match self {
            Self::One(one) => vec![one],
            Self::Many(many) => many,
        }
    }
}

/// A table from columns that were taken out of one.
#[pyfunction]
pub fn _table(columns: Vec<(String, Bound<'_, PyAny>)>) -> PyResult<RockingTable> {
    // the names are those of a table of ours
    let none = Asked { structures: &[], records: &[], scales: &[], restitution: None }.table(&[]);
    let mut rows = None;
    let mut all = Vec::new();
    for (name, kind) in none.all {
        let Some((_, of)) = columns.iter().find(|(column, _)| column == name) else {
            return Err(value_error(format!("_table: there is no column {name:?}")));
        };
        let n = of.len()?;
        if *rows.get_or_insert(n) != n {
            return Err(value_error("_table: columns of different lengths"));
        }
        let column = match kind {
            Column::Whole(_) => Column::Whole(
                numbers::row(of, name, "whole numbers")?.into_iter().map(|x| x as i64).collect(),
            ),
            Column::Real(_) => Column::Real(numbers::row(of, name, "numbers")?),
            Column::Words(..) => {
                Column::words(of.extract::<Vec<String>>()?.iter().map(String::as_str))
            }
        };
        all.push((name, column));
    }
    Ok(RockingTable(Arc::new(Columns { rows: rows.unwrap_or(0), all })))
}
