//! Elastic structures: equations of motion, and the reference on rigid ground against theory and an
//! independent program.

#![allow(clippy::print_stdout)]

mod another_program;
mod energy;
mod equations;
mod limits;
mod piers;
mod portal;
mod random;
mod stories;
