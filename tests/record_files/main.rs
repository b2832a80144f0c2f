//! Record files of the networks: real ones, ones made in each format, and damaged ones.

mod malformed;
mod real;
mod synthetic;
mod write;
