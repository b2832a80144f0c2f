//! The rocking structure.

use std::hash::{DefaultHasher, Hash, Hasher};

use cases::StructureSection;
use pyo3::prelude::*;
use rocking::structure::{Body, Kind, Structure as Core};

use crate::{
    numbers::real,
    said::{value_error, warn},
};

/// A rigid body on two feet. Made by `aframe` or `block`.
///
/// Numbers that no structure has (a mean density of air, a height of a kilometre) are a
/// GroundspringWarning.
///
/// ValueError: numbers that cannot rock.
#[pyclass(frozen, eq, from_py_object, module = "groundspring")]
#[derive(Clone, Copy, PartialEq)]
pub struct Structure {
    pub core: Core,
    pub e: f64,
}

/// Equal texts and numbers have equal hashes.
pub fn hashed<'a>(text: &str, numbers: impl Iterator<Item = &'a f64>) -> u64 {
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    // -0.0 and 0.0 are equal
    numbers.for_each(|x| (x + 0.0).to_bits().hash(&mut hasher));
    hasher.finish()
}

impl Structure {
    pub fn body(&self) -> Body<f64> {
        self.core.body()
    }
}

#[pymethods]
impl Structure {
    /// All mass at the apex of two massless legs.
    ///
    /// height       of the centre of mass above the feet, m
    /// width        between the feet, m
    /// mass         kg
    /// inertia      about the centre of mass, kg m2; 1e-5 m R^2 unless given, which rocking
    ///              does not feel
    /// restitution  velocity ratio of a landing; by equation 2 unless given
    #[staticmethod]
    #[pyo3(signature = (height, width, mass, inertia = None, restitution = None))]
    fn aframe(
        height: &Bound<'_, PyAny>,
        width: &Bound<'_, PyAny>,
        mass: &Bound<'_, PyAny>,
        inertia: Option<f64>,
        restitution: Option<f64>,
    ) -> PyResult<Self> {
        let given = lengths_and_mass(height, width, mass)?;
        checked(height.py(), ("Structure.aframe", Kind::AFrame), given, inertia, restitution)
    }

    /// A solid block.
    ///
    /// height       of the whole block, m: twice that of its centre of mass
    /// width        m
    /// mass         kg
    /// inertia      about the centre of mass, kg m2; m R^2/3 unless given
    /// restitution  velocity ratio of a landing; by equation 2 unless given
    #[staticmethod]
    #[pyo3(signature = (height, width, mass, inertia = None, restitution = None))]
    fn block(
        height: &Bound<'_, PyAny>,
        width: &Bound<'_, PyAny>,
        mass: &Bound<'_, PyAny>,
        inertia: Option<f64>,
        restitution: Option<f64>,
    ) -> PyResult<Self> {
        let (whole, width_m, mass_kg) = lengths_and_mass(height, width, mass)?;
        // the crate speaks of half of it
        if !(whole.is_finite() && whole > 0.0) {
            return Err(value_error(format!(
                "Structure.block: height is {whole:?}; give a finite number greater than zero, \
                 of the whole block, m"
            )));
        }
        let given = (whole / 2.0, width_m, mass_kg);
        checked(height.py(), ("Structure.block", Kind::Block), given, inertia, restitution)
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
        self.body().p()
    }

    /// Velocity ratio of a landing, without unit.
    #[getter]
    fn restitution(&self) -> f64 {
        self.e
    }

    fn __hash__(&self) -> u64 {
        let numbers = [self.height(), self.width(), self.mass(), self.inertia(), self.e];
        hashed(self.kind(), numbers.iter())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let args = (self.kind(), self.height(), self.width(), self.mass(), self.inertia(), self.e);
        Ok((crate::restore(py, "structure")?, args.into_pyobject(py)?.into_any()))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __repr__(&self) -> String {
        format!(
            "Structure({}, centre of mass at {} m, {} m wide, {} kg: alpha {:.5} rad, p {:.5} \
                rad/s, e {:.5})",
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

/// The three numbers of every structure.
fn lengths_and_mass(
    height: &Bound<'_, PyAny>,
    width: &Bound<'_, PyAny>,
    mass: &Bound<'_, PyAny>,
) -> PyResult<(f64, f64, f64)> {
    Ok((real(height, "height", "m")?, real(width, "width", "m")?, real(mass, "mass", "kg")?))
}

/// The structure; what is to be looked at again of it is a warning.
fn checked(
    py: Python<'_>,
    (name, kind): (&str, Kind),
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
    let (core, e) = section.checked(name).map_err(value_error)?;
    for doubt in section.doubts(&core) {
        // arguments have no unit in their names
        warn(py, format!("{name}: {doubt}").replace("mass_kg", "mass"))?;
    }
    Ok(Structure { core, e })
}
