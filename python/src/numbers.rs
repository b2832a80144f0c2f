//! Numbers from Python: a list, an array, anything that numpy takes for one. What is not a row of
//! real numbers is refused, with what to pass instead.

use numpy::{PyArray1, PyArrayMethods, PyUntypedArray, PyUntypedArrayMethods};
use pyo3::{exceptions::PyTypeError, prelude::*, types::PyDict};

use cases::LONGEST_S;

use crate::said::value_error;

/// A row of numbers called `name`; `what` they are, with their unit.
pub fn row(of: &Bound<'_, PyAny>, name: &str, what: &str) -> PyResult<Vec<f64>> {
    let py = of.py();
    let refused = |found: &str, give: &str| value_error(format!("{name}: {found}; {give}"));
    let quantity =
        ["units", "unit"].iter().any(|attribute| of.hasattr(*attribute).unwrap_or(false));
    if quantity {
        return Err(refused(
            "numbers with units of their own",
            &format!("give plain numbers, {what}: x.to(...).magnitude"),
        ));
    }
    let numpy = py.import("numpy")?;
    if of.is_instance(&numpy.getattr("ma")?.getattr("MaskedArray")?)? {
        let masked = numpy.getattr("ma")?.call_method1("is_masked", (of,))?.extract()?;
        if masked {
            return Err(refused(
                "a masked array",
                "fill what is masked: x.filled(0.0), or cut it off",
            ));
        }
    }
    let array =
        numpy.call_method1("asarray", (of,)).map_err(|_| refused("not a row of numbers", what))?;
    let untyped = array.cast::<PyUntypedArray>()?;
    let kind: String = array.getattr("dtype")?.getattr("kind")?.extract()?;
    match kind.as_str() {
        "f" | "i" | "u" | "b" => {}
        "c" => return Err(refused("complex numbers", &format!("give real ones, {what}: x.real"))),
        _ => {
            return Err(refused(
                &format!("an array of {}", array.getattr("dtype")?),
                &format!("give numbers, {what}"),
            ));
        }
    }
    match untyped.ndim() {
        1 => {}
        n => {
            let shape: Vec<String> = untyped.shape().iter().map(ToString::to_string).collect();
            let give = format!("give one row of numbers, {what}: x[:, 0], or x.ravel()");
            return Err(refused(
                &format!("an array of {n} dimensions, shape ({})", shape.join(", ")),
                &give,
            ));
        }
    }
    let options = PyDict::new(py);
    options.set_item("dtype", "float64")?;
    let array = numpy.call_method("ascontiguousarray", (array,), Some(&options))?;
    Ok(array.cast::<PyArray1<f64>>()?.to_vec()?)
}

/// A number called `name`; `what` it is, with its unit.
pub fn real(of: &Bound<'_, PyAny>, name: &str, what: &str) -> PyResult<f64> {
    of.extract().map_err(|_| {
        let found = a_kind(of);
        PyTypeError::new_err(format!("{name} is {found}; give a number, {what}"))
    })
}

/// "'0.01', a str"; what is longer is named by its kind alone.
pub fn a_kind(of: &Bound<'_, PyAny>) -> String {
    let kind = of.get_type().name().map_or_else(|_| "object".to_owned(), |name| name.to_string());
    let vowel = kind.to_ascii_lowercase().starts_with(['a', 'e', 'i', 'o', 'u']);
    let article = if vowel || kind == "ndarray" { "an" } else { "a" };
    let shown = of.repr().map_or_else(|_| String::new(), |text| text.to_string());
    let short = !shown.is_empty() && shown.len() <= 40 && !shown.contains(char::is_control);
    if short { format!("{shown}, {article} {kind}") } else { format!("{article} {kind}") }
}

/// A number, or a row of them.
pub fn one_or_more(of: &Bound<'_, PyAny>, name: &str, what: &str) -> PyResult<Vec<f64>> {
    match of.extract::<f64>() {
        Ok(one) if !of.hasattr("ndim").unwrap_or(false) => Ok(vec![one]),
        _ => {
            let scalar = of.getattr("ndim").ok().and_then(|n| n.extract::<usize>().ok()) == Some(0);
            match of.extract::<f64>() {
                Ok(one) if scalar => Ok(vec![one]),
                _ => row(of, name, what),
            }
        }
    }
}

/// Factors on a record; one of 1 unless given.
pub fn factors(given: Option<Bound<'_, PyAny>>) -> PyResult<Vec<f64>> {
    given.map_or(Ok(vec![1.0]), |scales| {
        one_or_more(&scales, "scales", "factors on the record, without unit")
    })
}

/// A length of history (s), in the program's words if it is none.
pub fn seconds(given: Option<f64>) -> PyResult<Option<f64>> {
    match given {
        Some(d) if !(d > 0.0 && d <= LONGEST_S) => Err(value_error(format!(
            "duration is {d:?}; give seconds greater than zero, at most 1e6"
        ))),
        given => Ok(given),
    }
}

/// A velocity ratio, in the program's words if it is none.
pub fn ratio(given: Option<f64>) -> PyResult<Option<f64>> {
    match given {
        Some(e) if !(0.0..=1.0).contains(&e) => {
            Err(value_error(format!("restitution is {e:?}; a velocity ratio lies between 0 and 1")))
        }
        given => Ok(given),
    }
}
