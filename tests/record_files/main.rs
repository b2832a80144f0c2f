//! Record files of the networks: real ones, ones made in each format, and damaged ones.

mod command;
mod malformed;
mod real;
mod synthetic;
mod vertical;
mod write;
