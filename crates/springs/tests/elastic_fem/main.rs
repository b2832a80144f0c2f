//! Stories of elastic frames on ground springs: what a user may rely on, over whole histories.

#![allow(clippy::print_stdout)]

mod balance;
mod common;
mod demands;
mod design_forces;
mod fixed_base;
mod members;
mod reference;
mod rigid_limit;
mod steps;
