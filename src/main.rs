//! `tune`: finds the ground springs of a rocking structure.

// what is printed goes through the program's `commands/terminal`
#![cfg_attr(not(test), deny(clippy::print_stdout, clippy::print_stderr))]

mod commands;

use std::process::ExitCode;

fn main() -> ExitCode {
    commands::main()
}
