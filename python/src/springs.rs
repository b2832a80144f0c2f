//! Ground springs with units.

use std::path::PathBuf;

use dynamics::spring;
use pyo3::prelude::*;
use springs::parameters::Parameters;

use crate::{said::value_error, structure::Structure};

/// One spring-absorber unit: foot - gap, k1 - m2 - (k2 parallel with c) - ground.
#[pyclass(frozen, eq, from_py_object, module = "groundspring")]
#[derive(Clone, Copy, PartialEq)]
pub struct Chain(pub spring::Chain<f64>);

#[pymethods]
impl Chain {
    #[new]
    fn new(k1: f64, k2: f64, m2: f64, c: f64) -> PyResult<Self> {
        let positive = [("k1", k1), ("k2", k2), ("m2", m2)].into_iter().find(|(_, x)| !(x.is_finite() && *x > 0.0));
        let wrong = positive.or((!(c.is_finite() && c >= 0.0)).then_some(("c", c)));
        if let Some((name, value)) = wrong {
            return Err(value_error(format!(
                "Chain: {name} is {value:?}; give a finite number above zero (c may be zero): k1, k2 in N/m, m2 in kg, c in N s/m"
            )));
        }
        Ok(Self(spring::Chain { k1, k2, m2, c }))
    }

    /// Gap spring, N/m.
    #[getter]
    fn k1(&self) -> f64 {
        self.0.k1
    }

    /// Spring to the ground, N/m.
    #[getter]
    fn k2(&self) -> f64 {
        self.0.k2
    }

    /// Mass of the absorber, kg: fictitious, without weight.
    #[getter]
    fn m2(&self) -> f64 {
        self.0.m2
    }

    /// Dashpot beside k2, N s/m.
    #[getter]
    fn c(&self) -> f64 {
        self.0.c
    }

    fn __repr__(&self) -> String {
        let c = &self.0;
        format!("Chain(k1={:?}, k2={:?}, m2={:?}, c={:?})", c.k1, c.k2, c.m2, c.c)
    }
}

/// The units under each of the two feet of a structure of this mass.
#[pyclass(frozen, eq, from_py_object, module = "groundspring")]
#[derive(Clone, Copy, PartialEq)]
pub struct Springs {
    #[pyo3(get)]
    pub mass: f64,
    #[pyo3(get)]
    pub vertical: Chain,
    #[pyo3(get)]
    pub horizontal: Chain,
}

impl Springs {
    pub fn chains(&self) -> spring::Springs<spring::Chain<f64>> {
        spring::Springs { vertical: self.vertical.0, horizontal: self.horizontal.0 }
    }

    pub fn designs(&self) -> spring::Springs<spring::Design<f64>> {
        spring::Springs { vertical: self.vertical.0.design(self.mass), horizontal: self.horizontal.0.design(self.mass) }
    }

    pub fn of(mass: f64, designs: &spring::Springs<spring::Design<f64>>) -> Self {
        let spring::Springs { vertical, horizontal } = designs.chains(mass);
        Self { mass, vertical: Chain(vertical), horizontal: Chain(horizontal) }
    }
}

#[pymethods]
impl Springs {
    #[new]
    fn new(mass: f64, vertical: Chain, horizontal: Chain) -> PyResult<Self> {
        if !(mass.is_finite() && mass > 0.0) {
            return Err(value_error(format!("Springs: mass is {mass:?}; give kg, a finite number above zero")));
        }
        Ok(Self { mass, vertical, horizontal })
    }

    /// Omega_n/2 pi of the vertical k1 under the mass, Hz.
    #[getter]
    fn omega_n_hz(&self) -> f64 {
        self.designs().vertical.omega_n_hz
    }

    /// Of the standing body under its weight, m.
    #[getter]
    fn settlement(&self) -> f64 {
        self.designs().settlement(self.mass)
    }

    fn __repr__(&self) -> String {
        format!(
            "Springs(mass={:?}, vertical={}, horizontal={})",
            self.mass,
            self.vertical.__repr__(),
            self.horizontal.__repr__()
        )
    }
}

/// The structure and the springs of a `parameters.json`.
#[pyfunction]
pub fn read_parameters(path: PathBuf) -> PyResult<(Structure, Springs)> {
    let parameters = Parameters::read(&path).map_err(value_error)?;
    let spring::Springs { vertical, horizontal } = parameters.chains();
    let structure = Structure { core: parameters.structure, e: parameters.restitution() };
    let mass = parameters.structure.mass_kg;
    Ok((structure, Springs { mass, vertical: Chain(vertical), horizontal: Chain(horizontal) }))
}
