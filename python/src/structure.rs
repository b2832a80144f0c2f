//! The rocking structure.

use pyo3::prelude::*;
use rocking::structure::{Body, Kind, Structure as Core};
use springs::case::StructureSection;

use crate::said::value_error;

/// A rigid body on two feet, and the restitution of its landings.
#[pyclass(frozen, eq, from_py_object, module = "groundspring")]
#[derive(Clone, Copy, PartialEq)]
pub struct Structure {
    pub core: Core,
    pub e: f64,
}

impl Structure {
    pub fn body(&self) -> Body<f64> {
        self.core.body()
    }
}

#[pymethods]
impl Structure {
    #[staticmethod]
    #[pyo3(signature = (height, width, mass, inertia = None, restitution = None))]
    fn aframe(height: f64, width: f64, mass: f64, inertia: Option<f64>, restitution: Option<f64>) -> PyResult<Self> {
        checked("Structure.aframe", Kind::AFrame, (height, width, mass), inertia, restitution)
    }

    #[staticmethod]
    #[pyo3(signature = (height, width, mass, inertia = None, restitution = None))]
    fn block(height: f64, width: f64, mass: f64, inertia: Option<f64>, restitution: Option<f64>) -> PyResult<Self> {
        checked("Structure.block", Kind::Block, (height / 2.0, width, mass), inertia, restitution)
    }

    /// "aframe" or "block".
    #[getter]
    fn kind(&self) -> &'static str {
        match self.core.kind {
            Kind::AFrame => "aframe",
            Kind::Block => "block",
        }
    }

    /// Of the centre of mass above the feet, m.
    #[getter]
    fn height(&self) -> f64 {
        self.core.height_m
    }

    /// Between the feet, m.
    #[getter]
    fn width(&self) -> f64 {
        self.core.width_m
    }

    /// kg.
    #[getter]
    fn mass(&self) -> f64 {
        self.core.mass_kg
    }

    /// About the centre of mass, kg m2.
    #[getter]
    fn inertia(&self) -> f64 {
        self.core.rotational_inertia_kgm2
    }

    /// atan(b/h), the lean of balance, rad.
    #[getter]
    fn alpha(&self) -> f64 {
        self.body().alpha()
    }

    /// sqrt(m g R/I0), 1/s.
    #[getter]
    fn p(&self) -> f64 {
        self.body().p_squared().sqrt()
    }

    /// Velocity ratio of a landing, without unit.
    #[getter]
    fn restitution(&self) -> f64 {
        self.e
    }

    fn __repr__(&self) -> String {
        format!(
            "Structure({}, centre of mass at {} m, {} m wide, {} kg: alpha {:.5} rad, p {:.5} rad/s, e {:.5})",
            self.kind(),
            self.height(),
            self.width(),
            self.mass(),
            self.alpha(),
            self.p(),
            self.e
        )
    }
}

fn checked(
    name: &str,
    kind: Kind,
    (height_m, width_m, mass_kg): (f64, f64, f64),
    rotational_inertia_kgm2: Option<f64>,
    restitution: Option<f64>,
) -> PyResult<Structure> {
    let (restitution_ratio, height_key) = (None, None);
    let section = StructureSection {
        kind,
        height_m,
        width_m,
        mass_kg,
        rotational_inertia_kgm2,
        restitution,
        restitution_ratio,
        height_key,
    };
    section.checked(name).map(|(core, e)| Structure { core, e }).map_err(value_error)
}
