//! Structures and scales of one length, or one of either.

use pyo3::PyResult;
use rocking::{housner::RockingOptions, structure::Body};

use crate::{
    record::{Record, checked_scales},
    said::value_error,
    structure::Structure,
};

/// Bodies, and how to solve each.
type Pairs = (Vec<Body<f64>>, Vec<RockingOptions<f64>>);

/// Bodies and options of one length, or one of length 1.
pub(super) fn pairs(
    structures: &[Structure],
    record: &Record,
    scales: &[f64],
    restitution: Option<f64>,
) -> PyResult<Pairs> {
    let (n, m) = (structures.len(), scales.len());
    if n != m && n != 1 && m != 1 {
        return Err(value_error(format!(
            "rigid_rocking_many: {n} structures and {m} scales; give one of either, or as many of \
                both"
        )));
    }
    checked_scales(&record.0, scales)?;
    let bodies = structures.iter().map(Structure::body).collect();
    // the restitution goes with the structure: as many options as there are of the longer list
    let same_e = structures.windows(2).all(|pair| pair[0].e == pair[1].e);
    let count = if same_e { m } else { n.max(m) };
    let options = (0..count.min(n * m)).map(|i| {
        let e = restitution.unwrap_or(structures[i % n].e);
        RockingOptions {
            scale: scales[i % m],
            restitution: Some(e),
            vertical: record.0.vertical_accel(),
            ..RockingOptions::default()
        }
    });
    Ok((bodies, options.collect()))
}
