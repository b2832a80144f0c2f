//! The design from the geometry, without units, and the frequency response.

use ::frequency_response::{bounds::Bounds, inner::fit, response, target::Target};
use cases::{Asked, Yardstick};
use dynamics::spring;
use landing::design::Geometry;
use numpy::PyArray1;
use pyo3::prelude::*;
use rocking::scalar::GRAVITY;
use springs::stiffness_search;

use crate::{
    Array, numbers,
    said::{plain, value_error},
    springs::Springs,
    structure::{Structure, hashed},
    work::interruptible,
};

/// mu, f, xi, Omega_n over the vertical one.
type Quadruple = (f64, f64, f64, f64);

/// One spring-absorber unit without units.
#[pyclass(frozen, module = "groundspring")]
#[derive(Clone, Copy)]
pub struct UnitDesign(spring::Design<f64>);

#[pymethods]
impl UnitDesign {
    /// m2/m1, without unit.
    #[getter]
    fn mu(&self) -> f64 {
        self.0.mu
    }

    /// Frequency of the absorber on k2 over Omega_n, without unit.
    #[getter]
    fn f(&self) -> f64 {
        self.0.f
    }

    /// c/(2 m2 Omega_n), without unit.
    #[getter]
    fn xi(&self) -> f64 {
        self.0.xi
    }

    /// K = k2/k1 = mu f^2, without unit.
    #[getter]
    fn k(&self) -> f64 {
        self.0.k()
    }

    /// C = c/(m1 Omega_n) = 2 mu xi, without unit.
    #[getter]
    fn c(&self) -> f64 {
        self.0.c()
    }

    /// Omega_n of the unit over that of the vertical one, without unit.
    #[getter]
    fn frequency_ratio(&self) -> f64 {
        self.0.omega_n_hz
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self.0 == other.get().0)
    }

    fn __hash__(&self) -> u64 {
        let d = &self.0;
        hashed("", [d.mu, d.f, d.xi, d.omega_n_hz].iter())
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Quadruple)> {
        let d = &self.0;
        Ok((crate::restore(py, "unit_design")?, (d.mu, d.f, d.xi, d.omega_n_hz)))
    }

    fn __repr__(&self) -> String {
        let d = &self.0;
        format!(
            "UnitDesign(mu={:.6}, K={:.6}, C={:.6}, Omega/Omega_v={:.4})",
            d.mu,
            d.k(),
            d.c(),
            d.omega_n_hz
        )
    }
}

/// The springs of every body of this alpha and inertia, at this Omega_n/p.
#[pyclass(frozen, module = "groundspring")]
pub struct Design {
    geometry: Geometry,
    springs: spring::Springs<spring::Design<f64>>,
}

#[pymethods]
impl Design {
    /// atan(b/h), rad.
    #[getter]
    fn alpha(&self) -> f64 {
        self.geometry.alpha()
    }

    /// I_cg/(m R^2), without unit.
    #[getter]
    fn inertia(&self) -> f64 {
        self.geometry.mass_share().recip() - 1.0
    }

    /// Omega_n/p, without unit.
    #[getter]
    fn stiffness(&self) -> f64 {
        self.geometry.stiffness()
    }

    /// Whether gravity has no part in a landing to speak of.
    #[getter]
    fn in_stiff_limit(&self) -> bool {
        self.geometry.in_stiff_limit()
    }

    /// The vertical unit of each foot.
    #[getter]
    fn vertical(&self) -> UnitDesign {
        UnitDesign(self.springs.vertical)
    }

    /// The horizontal unit of each foot.
    #[getter]
    fn horizontal(&self) -> UnitDesign {
        UnitDesign(self.springs.horizontal)
    }

    /// With units, for a mass, kg, and the distance R from a foot to the centre of mass, m.
    fn springs(&self, mass: f64, radius: f64) -> PyResult<Springs> {
        if let Some((name, value)) = [("mass", mass), ("radius", radius)]
            .into_iter()
            .find(|(_, x)| !(x.is_finite() && *x > 0.0))
        {
            return Err(value_error(format!(
                "springs: {name} is {value:?}; give a finite number above zero"
            )));
        }
        let p = (self.geometry.mass_share() * GRAVITY / radius).sqrt();
        let hz = self.geometry.stiffness() * p / std::f64::consts::TAU;
        let mut springs = self.springs;
        springs.vertical.omega_n_hz *= hz;
        springs.horizontal.omega_n_hz *= hz;
        Ok(Springs::of(mass, &springs))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| self.geometry == other.get().geometry)
    }

    fn __hash__(&self) -> u64 {
        let g = &self.geometry;
        hashed("", [g.alpha(), g.mass_share(), g.stiffness()].iter())
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (f64, f64, f64))> {
        let g = &self.geometry;
        Ok((crate::restore(py, "design")?, (g.alpha(), g.mass_share(), g.stiffness())))
    }

    fn __repr__(&self) -> String {
        format!(
            "Design(alpha={:.6}, inertia={:.6}, stiffness={:.1}, vertical={}, horizontal={})",
            self.alpha(),
            self.inertia(),
            self.stiffness(),
            self.vertical().__repr__(),
            self.horizontal().__repr__()
        )
    }
}

/// The design from the geometry, without units: alpha in rad, inertia I_cg/(m R^2), 0 unless
/// given, stiffness Omega_n/p.
///
/// Omega_n/p is, unless given, where `tune` begins to look for an accuracy of 0.002.
#[pyfunction]
#[pyo3(signature = (alpha, inertia = None, stiffness = None))]
pub fn design(
    py: Python<'_>,
    alpha: Of,
    inertia: Option<f64>,
    stiffness: Option<f64>,
) -> PyResult<Design> {
    let stiffness = stiffness.unwrap_or_else(|| {
        stiffness_search::begin(Asked { by: Yardstick::Histories, error: decks::ACCURACY })
    });
    let geometry = match alpha {
        Of::Structure(structure) => Geometry::of(&structure.body(), stiffness),
        Of::Alpha(alpha) => {
            let inertia = inertia.unwrap_or(0.0);
            if !(inertia.is_finite() && inertia >= 0.0) {
                return Err(value_error(format!(
                    "design: I_cg/(m R^2) is {inertia:?}; give a finite number, zero or greater"
                )));
            }
            Geometry::new(alpha, 1.0 / (1.0 + inertia), stiffness)
        }
    };
    let geometry = geometry.map_err(value_error)?;
    let springs = py.detach(|| geometry.springs());
    Ok(Design { geometry, springs })
}

/// A design that was pickled: alpha (rad), m R^2/I0, Omega_n/p.
#[pyfunction]
pub fn _design(alpha: f64, mass_share: f64, stiffness: f64) -> PyResult<Design> {
    let geometry = Geometry::new(alpha, mass_share, stiffness).map_err(value_error)?;
    Ok(Design { geometry, springs: geometry.springs() })
}

/// A unit that was pickled: mu, f, xi, Omega_n over the vertical one.
#[pyfunction]
pub fn _unit_design(mu: f64, f: f64, xi: f64, omega_n_hz: f64) -> UnitDesign {
    UnitDesign(spring::Design { mu, f, xi, omega_n_hz })
}

/// What a design is of.
#[derive(FromPyObject)]
pub enum Of {
    Structure(Structure),
    Alpha(f64),
}

/// Amplitude response ratio (equation 7) of a unit at frequency ratios g = omega/Omega_n.
#[pyfunction]
pub fn frequency_response<'py>(
    py: Python<'py>,
    g: &Bound<'py, PyAny>,
    mu: f64,
    f: f64,
    xi: f64,
) -> PyResult<Array<'py>> {
    let positive = [("mu", mu), ("f", f)].into_iter().find(|(_, x)| !(x.is_finite() && *x > 0.0));
    if let Some((name, value)) = positive.or((!(xi.is_finite() && xi >= 0.0)).then_some(("xi", xi)))
    {
        return Err(value_error(format!(
            "frequency_response: {name} is {value:?}; give finite mu and f above zero, xi zero or \
                greater"
        )));
    }
    let g = numbers::one_or_more(g, "g", "frequencies over Omega_n, without unit")?;
    Ok(PyArray1::from_iter(py, g.into_iter().map(|g| response::arr(g, mu, f, xi))))
}

/// f and xi of a mass ratio by the paper's frequency response, and the certificate.
#[pyfunction]
pub fn fit_response(py: Python<'_>, mu: f64) -> PyResult<Py<PyAny>> {
    let fit = interruptible(py, |_| fit(mu, &Target::default(), &Bounds::default()))?
        .map_err(value_error)?;
    plain(py, &fit)
}
