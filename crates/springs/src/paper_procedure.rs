//! The paper's procedure: Omega_n by the error of a history, after the inner fit of the crate
//! `frequency_response`.

pub mod outer;

pub mod table_1;
