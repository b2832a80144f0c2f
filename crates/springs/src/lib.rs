//! Finds ground springs: cases, designs, stiffness, verdicts, the parameters of a run.

// what is printed goes through the program's `commands/terminal`
#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

pub mod answers;
pub mod case;
pub mod parameters;
pub mod predictability;
pub mod results;
pub mod rigid_forces;
pub mod tuning;
pub mod validate;
pub mod verdict;
