//! The native half of the Python package `groundspring`: what the crate computes, as Python
//! objects.
//!
//! | file | what |
//! |---|---|
//! | `record`, `structure`, `springs` | what goes in; each object holds one of the crate's |
//! | `rocking`, `filed` | Housner's solution, one history or many; as it is pickled |
//! | `simulation` | both models on given springs |
//! | `tuned`, `program` | the whole of `tune run`; the program with fixed steps that it is asked for |
//! | `design`, `validation` | the design without units, the frequency response; springs judged over many records |
//! | `many`, `arrow` | many histories as one table; a table for whoever reads Arrow |
//! | `numbers` | rows of numbers from Python, checked |
//! | `work`, `said`, `words` | long work that ^C interrupts; errors, warnings, JSON; in Python's words |
//!
//! Nothing is computed here. Errors are `ValueError` in Python's words, warnings
//! `groundspring.GroundspringWarning`. Arrays are views of the crate's own memory where it has
//! them, and cannot be written to.

mod arrow;
mod design;
mod filed;
mod many;
mod numbers;
mod program;
mod record;
mod rocking;
mod said;
mod simulation;
mod springs;
mod structure;
mod tuned;
mod validation;
mod words;
mod work;

use pyo3::prelude::*;

#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::{
        design::{
            _design, _unit_design, Design, UnitDesign, design, fit_response, frequency_response,
        },
        filed::{_histories, _history},
        many::{_table, RockingTable, rock_all},
        record::{Record, el_centro, read_record},
        rocking::{Histories, History, rigid_rocking, rigid_rocking_many},
        said::GroundspringWarning,
        simulation::{Simulation, simulate},
        springs::{_units_for, Chain, Springs, read_parameters},
        structure::Structure,
        tuned::{Tuned, tune},
        validation::{Validation, earthquake_records, synthetic_records, validate},
    };

    #[pymodule_export]
    const STEPS: &str = decks::STEPS;

    #[pymodule_export]
    const __VERSION: &str = env!("CARGO_PKG_VERSION");

    #[pymodule_export]
    const GRAVITY: f64 = ::rocking::scalar::GRAVITY;
}

/// What the crate's numbers are called with in Python.
pub(crate) type Array<'py> = Bound<'py, numpy::PyArray1<f64>>;

/// What a function of the package's own Python answers.
pub(crate) fn call<'py>(
    py: Python<'py>,
    module: &str,
    function: &str,
    of: impl pyo3::call::PyCallArgs<'py>,
) -> PyResult<Bound<'py, PyAny>> {
    py.import(format!("groundspring.{module}"))?.call_method1(function, of)
}

/// What makes an object again that was pickled.
pub(crate) fn restore<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("groundspring._restore")?.getattr(name)
}

/// A view of numbers that live in `owner`, which must be frozen and own them; not to be written to.
pub(crate) fn view<'py>(owner: Bound<'py, PyAny>, numbers: &[f64]) -> PyResult<Array<'py>> {
    // SAFETY: `owner` is kept alive by the array, is frozen, and so neither moves nor changes the
    // numbers
    let array = unsafe {
        numpy::PyArray1::borrow_from_array(&numpy::ndarray::ArrayView1::from(numbers), owner)
    };
    array.getattr("flags")?.setattr("writeable", false)?;
    Ok(array)
}

/// t = i dt of n samples (s).
pub(crate) fn times(py: Python<'_>, n: usize, dt: f64) -> Array<'_> {
    numpy::PyArray1::from_iter(py, (0..n).map(|i| i as f64 * dt))
}
