//! The program in a browser: a case file's text and record files in; histories, springs and the
//! files of a run out, as JSON.
//!
//! | function | from | to |
//! |---|---|---|
//! | [`give_file`], [`forget_file`] | a record file | what cases may name from then on |
//! | [`read_record`] | the case's record | its components, its motion for drawing |
//! | [`pulse`] | amplitude, period | a record file |
//! | [`at_once`] | a case | both histories on springs from the geometry, what is said of them |
//! | [`tune`], [`run_file`] | a case | the whole run: what is said of it; its files, the bytes that `tune run --no-figures --no-front` writes |
//! | [`fixed_step`] | a rigid body's case | the springs for its program that a run tries first |
//! | [`variations`] | a case; sizes, slendernesses, scales | the largest rotation of each |
//! | [`first_fall`] | a case; one that stands, one that falls | where between them the first falls |
//!
//! Every function gives JSON, or the one line that the program says of bad input. There are no
//! threads: a page calls from a worker and ends the worker to stop it. On wasm32 they are exported
//! to JavaScript; natively they are the same, for tests.

#![warn(missing_docs)]

mod any_case;
mod at_once;
mod error;
mod fixed_step;
mod ground;
mod run;
mod said;
mod series;
mod thin;
mod variations;

use std::path::Path;

use serde::Serialize;
#[cfg(target_family = "wasm")]
use wasm_bindgen::prelude::wasm_bindgen;

use any_case::AnyCase;
pub use error::WebError;

/// What a function gives: JSON, or one line on what is wrong.
pub type JsonOrLine = Result<String, String>;

fn json<T: Serialize>(made: Result<T, WebError>) -> JsonOrLine {
    let made = made.map_err(|e| e.to_string())?;
    serde_json::to_string(&made).map_err(|e| e.to_string())
}

/// The program's version.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn version() -> String {
    env!("CARGO_PKG_VERSION").into()
}

/// Give a record file by its bare name, as cases name it.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn give_file(name: &str, bytes: &[u8]) {
    any_case::forget();
    files::memory::give(Path::new(name), bytes);
}

/// Forget a record file.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn forget_file(name: &str) {
    any_case::forget();
    files::memory::forget(Path::new(name));
}

/// The record of a case file's text: components, the one taken, its motion for drawing.
///
/// # Errors
/// What is wrong with the case or the record.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn read_record(case: &str) -> JsonOrLine {
    json(AnyCase::of(case).and_then(|case| ground::read(&case)))
}

/// A record file with one pulse, Ricker's antisymmetric wavelet: amplitude (g), period (s). Its
/// samples are in g, one a line; its time step is [`pulse_step`].
///
/// # Errors
/// An amplitude or a period out of range.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn pulse(amplitude_g: f64, period_s: f64) -> JsonOrLine {
    ground::pulse(amplitude_g, period_s).map_err(|e| e.to_string())
}

/// Time step of [`pulse`] (s).
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn pulse_step(period_s: f64) -> f64 {
    ground::pulse_step(period_s)
}

/// Both models' histories on springs from the geometry, and what is said of them; `friction`: the
/// ground's coefficient, for the warning of sliding.
///
/// # Errors
/// What is wrong with the case or the record.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn at_once(case: &str, friction: f64) -> JsonOrLine {
    json(AnyCase::of(case).and_then(|case| at_once::answer(&case, friction)))
}

/// The whole run: what the program says of it. [`run_file`] has its files.
///
/// # Errors
/// What is wrong with the case or the record; springs that there are none of.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn tune(case: &str, friction: f64) -> JsonOrLine {
    json(AnyCase::of(case).and_then(|case| run::tune(&case, friction)))
}

/// A file of the last run, by its name in the folder of results; empty if there is none.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn run_file(name: &str) -> String {
    run::file(name)
}

/// Springs of a rigid body for the case's program with steps of one size, in closed form and not
/// measured: those that [`tune`] tries first.
///
/// # Errors
/// What is wrong with the case; an elastic structure.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn fixed_step(case: &str) -> JsonOrLine {
    json(AnyCase::of(case).and_then(|case| fixed_step::preliminary(&case)))
}

/// Peak |theta|/alpha of bodies on the case's record, by Housner: JSON in, a list of
/// `{"alpha", "radius_m", "scale"}` (rad, m; the case's own where left out); a list out, null where
/// the body overturns.
///
/// # Errors
/// What is wrong with the case, the record or the list.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn variations(case: &str, asked: &str) -> JsonOrLine {
    json(AnyCase::of(case).and_then(|case| variations::answer(&case, asked)))
}

/// Between two of [`variations`], JSON in: the first stands, the second falls. The share of the way
/// from one to the other at which the first falls, to 1/4096.
///
/// # Errors
/// What is wrong with the case, the record or the two.
#[cfg_attr(target_family = "wasm", wasm_bindgen)]
pub fn first_fall(case: &str, ends: &str) -> JsonOrLine {
    json(AnyCase::of(case).and_then(|case| variations::first_fall(&case, ends)))
}

#[cfg(test)]
mod tests;
