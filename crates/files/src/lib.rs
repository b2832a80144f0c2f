//! Files read within bounds and written whole; numbers and paths in words.

// what is printed goes through the program's `commands/terminal`
#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]
#![warn(missing_docs)]

pub mod input;
pub mod memory;
pub mod message;
pub mod whole_file;
