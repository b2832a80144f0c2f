//! Ground springs with units.

use std::path::PathBuf;

use dynamics::spring;
use frames::standing::{FixedResponse, FootingInertia, Standing};
use nalgebra::DMatrix;
use parameters::Parameters;
use pyo3::prelude::*;
use springs::elastic::design;

use crate::{
    said::{shown, value_error, value_error_of, warn},
    structure::{Structure, hashed},
};

/// Springs are not doubted for a mass that differs by less than this share, as `add_feet` has it.
const OTHER_MASS: f64 = 0.03;

/// One spring-absorber unit: foot - gap, k1 - absorber m2 - (k2 parallel with dashpot c) -
/// ground.
///
/// k1, k2 in N/m, m2 in kg, c in N s/m.
#[pyclass(frozen, eq, from_py_object, module = "groundspring")]
#[derive(Clone, Copy, PartialEq)]
pub struct Chain(pub spring::Chain);

#[pymethods]
impl Chain {
    #[new]
    fn new(k1: f64, k2: f64, m2: f64, c: f64) -> PyResult<Self> {
        let positive = [("k1", k1), ("k2", k2), ("m2", m2)]
            .into_iter()
            .find(|(_, x)| !(x.is_finite() && *x > 0.0));
        let wrong = positive.or((!(c.is_finite() && c >= 0.0)).then_some(("c", c)));
        if let Some((name, value)) = wrong {
            return Err(value_error(format!(
                "Chain: {name} is {value:?}; give a finite number above zero (c may be zero): k1, \
                    k2 in N/m, m2 in kg, c in N s/m"
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

    fn __hash__(&self) -> u64 {
        let c = &self.0;
        hashed("", [c.k1, c.k2, c.m2, c.c].iter())
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (f64, f64, f64, f64)) {
        let c = &slf.get().0;
        (slf.get_type().into_any(), (c.k1, c.k2, c.m2, c.c))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
    }

    fn __repr__(&self) -> String {
        let c = &self.0;
        format!("Chain(k1={:?}, k2={:?}, m2={:?}, c={:?})", c.k1, c.k2, c.m2, c.c)
    }
}

/// The units under each of the two feet of a structure of this mass, kg.
#[pyclass(frozen, eq, from_py_object, module = "groundspring")]
#[derive(Clone, Copy, PartialEq)]
pub struct Springs {
    /// Of the structure, kg.
    #[pyo3(get)]
    pub mass: f64,
    /// The vertical unit of each foot.
    #[pyo3(get)]
    pub vertical: Chain,
    /// The horizontal unit of each foot.
    #[pyo3(get)]
    pub horizontal: Chain,
}

impl Springs {
    pub fn chains(&self) -> spring::Springs<spring::Chain> {
        spring::Springs { vertical: self.vertical.0, horizontal: self.horizontal.0 }
    }

    pub fn designs(&self) -> spring::Springs<spring::Design<f64>> {
        spring::Springs {
            vertical: self.vertical.0.design(self.mass),
            horizontal: self.horizontal.0.design(self.mass),
        }
    }

    /// Warn if they are for a structure of another mass.
    pub fn check_mass(&self, py: Python<'_>, who: &str, structure: &Structure) -> PyResult<()> {
        let (own, given) = (self.mass, structure.core.mass_kg);
        if (own / given - 1.0).abs() <= OTHER_MASS {
            return Ok(());
        }
        warn(
            py,
            format!(
                "{who}: the springs are for a structure of {own} kg, this one has {given} kg; give \
                 those of gs.tune(structure)"
            ),
        )
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
            return Err(value_error(format!(
                "Springs: mass is {mass:?}; give kg, a finite number above zero"
            )));
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

    /// Springs `factor` times as stiff, which land as these do: k1 and k2 times it, c times its
    /// root, m2 as it is.
    fn stiffer(&self, factor: f64) -> PyResult<Self> {
        if !(factor.is_finite() && factor > 0.0) {
            return Err(value_error(format!(
                "stiffer: factor is {factor:?}; give a finite number above zero"
            )));
        }
        let unit = |Chain(spring::Chain { k1, k2, m2, c }): Chain| {
            Chain(spring::Chain { k1: k1 * factor, k2: k2 * factor, m2, c: c * factor.sqrt() })
        };
        Ok(Self {
            mass: self.mass,
            vertical: unit(self.vertical),
            horizontal: unit(self.horizontal),
        })
    }

    /// Amplitude response ratio of both units (equation 7), without unit, over frequency, Hz.
    #[pyo3(signature = (axes = None))]
    fn plot<'py>(
        slf: &Bound<'py, Self>,
        axes: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_plots", "springs", (slf, axes))
    }

    /// For notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        crate::call(slf.py(), "_html", "springs", (slf,))
    }

    fn __hash__(&self) -> u64 {
        let unit = |c: &spring::Chain| [c.k1, c.k2, c.m2, c.c];
        hashed(
            "",
            [unit(&self.vertical.0), unit(&self.horizontal.0), [self.mass; 4]]
                .as_flattened()
                .iter(),
        )
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (f64, Chain, Chain)) {
        let of = slf.get();
        (slf.get_type().into_any(), (of.mass, of.vertical, of.horizontal))
    }

    fn __copy__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    fn __deepcopy__<'py>(slf: Bound<'py, Self>, _memo: &Bound<'py, PyAny>) -> Bound<'py, Self> {
        slf
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
    let parameters =
        Parameters::read(&path).map_err(|error| value_error_of(error, &[&shown(&path)]))?;
    let spring::Springs { vertical, horizontal } = parameters.chains();
    let structure = Structure { core: parameters.structure, e: parameters.restitution() };
    let mass = parameters.structure.mass_kg;
    Ok((structure, Springs { mass, vertical: Chain(vertical), horizontal: Chain(horizontal) }))
}

/// The structure held at its feet under 1 m/s2: reactions (H, N) of every foot (N), u' K u (J),
/// omega (rad/s).
type Response = (Vec<[f64; 2]>, f64, f64);
/// Feet of one rigid part, W by rows (x, z of each; 1/kg), distance of the outer ones (m).
type Part = (Vec<usize>, Vec<f64>, f64);

/// Units under every foot of a structure measured by its mass and stiffness: `give` of the stance
/// by the vertical k1 alone, `landing` speed of a foot (m/s). K = k2/k1 of the vertical units, the
/// give of all springs, and the units with the mass (kg) of what lands.
#[pyfunction]
pub fn _units_for(
    mass: f64,
    responses: [Response; 2],
    parts: Vec<Part>,
    give: f64,
    landing: f64,
) -> PyResult<(f64, f64, Vec<Springs>)> {
    let count = responses[0].0.len();
    let square = |(corners, w, _): &Part| w.len() == 4 * corners.len().pow(2);
    if parts.iter().any(|part| !square(part) || part.0.iter().any(|i| *i >= count))
        || responses[1].0.len() != count
    {
        return Err(value_error("_units_for: parts and reactions do not belong together"));
    }
    let mut masses = vec![mass; count];
    let mut footing = |(corners, w, width): Part| {
        let (n, last) = (2 * corners.len(), 2 * corners.len() - 2);
        let w = DMatrix::from_row_slice(n, n, &w);
        // both ends of a body go up and down together by 1/m
        let lands = if last == 0 { 1.0 / w[(1, 1)] } else { 2.0 / (w[(1, 1)] + w[(1, last + 1)]) };
        corners.iter().for_each(|i| masses[*i] = lands);
        FootingInertia { corners, w, width }
    };
    let footings = parts.into_iter().map(&mut footing).collect();
    let response = |(reactions, work, omega): Response| FixedResponse { reactions, work, omega };
    let standing = Standing {
        reactions: vec![[0.0; 2]; count],
        footings,
        responses: responses.map(response),
        mass,
    };
    let found = design::springs(&standing, give, landing, 1.0);
    let units = found.corners.iter().zip(masses).map(|(units, mass)| {
        let spring::Springs { vertical, horizontal } = *units;
        Springs { mass, vertical: Chain(vertical), horizontal: Chain(horizontal) }
    });
    Ok((found.k, found.compliance_ratio, units.collect()))
}
