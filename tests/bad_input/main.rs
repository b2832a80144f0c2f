//! Bad input of every kind: one clear line on stderr, exit code 2, nothing written.

mod contents;
mod doubts;
mod files;
mod mistakes;
mod options;
#[path = "../support/program.rs"]
mod program;
mod sweeps;

use std::{fs, path::Path};

use tempfile::TempDir;

/// Run `tune` in an empty folder with the given files; it must fail cleanly and say each of
/// `words`.
fn refuses(files: &[(&str, &str)], args: &[&str], words: &[&str]) {
    let files: Vec<(&str, &[u8])> =
        files.iter().map(|(name, text)| (*name, text.as_bytes())).collect();
    refuses_bytes(&files, args, words);
}

/// The same with files of any bytes; a name that ends in / is a folder.
fn refuses_bytes(files: &[(&str, &[u8])], args: &[&str], words: &[&str]) {
    let dir = TempDir::new().unwrap();
    for (name, bytes) in files {
        let path = dir.path().join(name);
        if name.ends_with('/') {
            fs::create_dir(path).unwrap()
        } else {
            fs::write(path, bytes).unwrap()
        }
    }
    refuses_in(dir.path(), args, words);
}

fn refuses_in(dir: &Path, args: &[&str], words: &[&str]) {
    let before = entries(dir);
    let output = program::tune(dir, args);
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{args:?}: {stderr}");
    assert_eq!(stderr.trim_end().lines().count(), 1, "{args:?}: more than one line: {stderr}");
    assert!(stderr.chars().count() < 400, "{args:?}: {stderr}");
    for word in words {
        assert!(stderr.contains(word), "{args:?}: {stderr:?} does not say {word:?}");
    }
    assert!(output.stdout.is_empty(), "{args:?} printed a result");
    let left = entries(dir);
    assert_eq!(left.len(), before.len(), "{args:?} wrote something: {left:?}");
}

fn entries(dir: &Path) -> Vec<String> {
    fs::read_dir(dir).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
}

const STRUCTURE: &str =
    "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 100.0\n";

const AT2: &str = "PEER\nname\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS= 4, DT= .01000 SEC\n";

fn run_case(text: &str, words: &[&str]) {
    refuses(&[("case.toml", text)], &["run", "case.toml", "--quiet", "--out", "results"], words);
}

fn run_record(name: &str, text: &str, more: &[&str], words: &[&str]) {
    let mut args = vec!["run", "--quiet", "--out", "results", "--record", name];
    args.extend(more);
    refuses(&[(name, text)], &args, words);
}

/// A parameter file whose vertical chain has this k1.
fn parameters(k1: f64) -> String {
    let row = |k1: f64| {
        format!(
            "{{\"mu\":1,\"f\":1,\"xi\":1,\"omega_n_hz\":1,\"k1_n_per_m\":{k1},\"k2_n_per_m\":1e6,\
                \"m2_kg\":10,\"c_ns_per_m\":1e3}}"
        )
    };
    let structure = "{\"kind\":\"block\",\"height_m\":1,\"width_m\":0.5,\"mass_kg\":100,\
        \"rotational_inertia_kgm2\":35}";
    format!("{{\"structure\":{structure},\"vertical\":{},\"horizontal\":{}}}", row(k1), row(1e6))
}

fn export(more: &[&str], words: &[&str]) {
    let args = [&["export", "--parameters", "p.json"], more].concat();
    refuses(&[("p.json", &parameters(1e6))], &args, words);
}

fn verify(more: &[&str], words: &[&str]) {
    let args = [&["verify", "--parameters", "p.json", "--duration", "3"], more].concat();
    refuses(&[("p.json", &parameters(1e6))], &args, words);
}

const PARAMETERS: &str = include_str!("../../fuzz/corpus/parameters/paper");

fn with(path: &str, value: serde_json::Value) -> String {
    let mut all: serde_json::Value = serde_json::from_str(PARAMETERS).unwrap();
    let (section, key) = path.split_once('.').unwrap();
    all[section][key] = value;
    all.to_string()
}

/// The parameters of `PARAMETERS` with this record.
fn remembering(record: serde_json::Value) -> String {
    let mut all: serde_json::Value = serde_json::from_str(PARAMETERS).unwrap();
    all["record"] = record;
    all.to_string()
}

fn record_row(source: serde_json::Value) -> serde_json::Value {
    serde_json::json!({
        "name": "a", "dt_s": 0.01, "samples": 3, "pga_g": 0.3, "scale": 1.0, "duration_s": 0.02,
        "fnv1a_64": "0123456789abcdef", "source": source,
    })
}

/// Each command that uses the record a parameters.json remembers.
const USERS: [&[&str]; 3] = [
    &["simulate", "--parameters", "p.json"],
    &["verify", "--parameters", "p.json"],
    &["export", "--parameters", "p.json", "--format", "csv", "--out", "springs.csv"],
];
