//! The corpus of the fuzz targets (`fuzz/`), replayed: every input that ever reached new code or failed.

use std::{fs, path::Path};

#[path = "../fuzz/checks.rs"]
mod checks;

fn replay(target: &str, check: fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(target);
    let mut files: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(files.len() >= 10, "{} has {} inputs", folder.display(), files.len());
    for file in files {
        // the name of the input is printed only if the check panics
        println!("{}", file.display());
        check(&fs::read(&file).unwrap());
    }
}

#[test]
fn any_bytes_are_a_record_or_an_error_of_one_line() {
    replay("record", checks::record);
}

#[test]
fn any_text_is_a_case_or_an_error_of_one_line() {
    replay("case", checks::case);
}

#[test]
fn any_text_is_a_parameter_file_that_runs_or_an_error_of_one_line() {
    replay("parameters", checks::parameters);
}
