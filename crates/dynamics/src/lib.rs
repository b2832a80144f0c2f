//! Finite elements of a rigid body on ground springs: steps, events, energy account.

// what is printed goes through the program's `commands/terminal`
#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]
#![warn(missing_docs)]

pub mod compare;
pub mod effort;
pub mod fem;
pub mod spring;
