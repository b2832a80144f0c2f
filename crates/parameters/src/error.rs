//! What may be wrong with a file of parameters.

use thiserror::Error;

use super::SCHEMA;
use rocking::{
    members::{MembersError, NO_LEGS},
    structure::StructureError,
};

/// What is wrong with a parameter file, and what to do.
#[derive(Debug, Error)]
#[allow(missing_docs)] // messages say what variants and their fields are
pub enum ParametersError {
    #[error("{path}: cannot be read ({source}); give the parameters.json that `tune run` wrote")]
    Read { path: String, source: std::io::Error },
    #[error(
        "{path}: these are springs of an elastic structure, which only `tune export` and `tune \
         verify` take; give the parameters.json of a rigid body"
    )]
    Elastic { path: String },
    #[error("{path}: {}, and let `tune run` find its springs", NO_LEGS)]
    Legs { path: String },
    #[error("{path}, line {line}: {message}; give a parameters.json as `tune run` writes it")]
    Parse { path: String, line: usize, message: String },
    #[error("{path}: {chain}.{name} is {value:?}; give a finite number{bound}")]
    Value { path: String, chain: &'static str, name: &'static str, value: f64, bound: &'static str },
    #[error(
        "{path}: {chain}.{name} is {value:?}, {times:.1e} times {scale}: no result would mean \
         anything; give k1 and k2 in N/m, m2 in kg, c in N s/m"
    )]
    Absurd {
        path: String,
        chain: String,
        name: &'static str,
        value: f64,
        times: f64,
        scale: &'static str,
    },
    #[error(
        "{path}: its schema is {schema}, this program reads up to {SCHEMA}; take a newer tune, or \
         tune again"
    )]
    Schema { path: String, schema: u32 },
    #[error("{path}: program.{key} is {value}; {remedy}")]
    Program { path: String, key: &'static str, value: String, remedy: String },
    #[error("{path}: record.{name} is {value:?}; give a finite number greater than zero")]
    Record { path: String, name: &'static str, value: f64 },
    #[error("{path}: restitution is {value}; a velocity ratio lies between 0 and 1")]
    Restitution { path: String, value: f64 },
    #[error("{path}: {source}")]
    Structure { path: String, source: StructureError },
    #[error("{path}: {source}")]
    Members { path: String, source: MembersError },
}
