//! Record files of the networks: real ones, ones made in each format, and damaged ones.

mod command;
mod formats;
mod malformed;
#[path = "../support/program.rs"]
mod program;
mod real;
mod synthetic;
mod vertical;
mod write;
