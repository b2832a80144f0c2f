//! The program `tune`, run in a folder to its end.

use std::{
    path::Path,
    process::{Command, Output},
};

pub fn tune(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_tune")).current_dir(folder).args(args).output().unwrap()
}
