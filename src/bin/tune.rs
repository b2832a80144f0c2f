//! `tune`: finds the ground springs of a rocking structure. See the library's `commands`.

use std::process::ExitCode;

fn main() -> ExitCode {
    groundspring::main()
}
