//! Record files of the networks: real ones, ones made in each format, and damaged ones.

mod command;
mod malformed;
#[path = "../support/program.rs"]
mod program;
mod real;
mod synthetic;
mod vertical;
mod write;

/// Run `tune` in a folder: exit code, stdout, stderr.
fn tune(folder: &std::path::Path, args: &[&str]) -> (i32, String, String) {
    let output = program::tune(folder, args);
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}
