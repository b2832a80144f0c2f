//! Bad input of every kind: one clear line on stderr, exit code 2, nothing written.

mod contents;
mod doubts;
mod files;
mod mistakes;
mod options;
#[path = "../support/program.rs"]
mod program;
mod sweeps;

use program::TestFolder;

/// Run `tune` in an empty folder with the given files, as [`TestFolder`] takes them; it must fail
/// cleanly and say each of `words`.
fn refuses(files: &[(&str, &str)], line: &str, words: &[&str]) {
    refuses_in(&TestFolder::with(files), line, words);
}

/// The same with a file of any bytes.
fn refuses_bytes((name, bytes): (&str, &[u8]), line: &str, words: &[&str]) {
    let folder = TestFolder::with(&[]);
    folder.write(name, bytes);
    refuses_in(&folder, line, words);
}

fn refuses_in(folder: &TestFolder, line: &str, words: &[&str]) {
    let entries = || std::fs::read_dir(folder.path("")).unwrap().count();
    let before = entries();
    let stderr = folder.refuses(line);
    assert!(stderr.chars().count() < 400, "{line}: {stderr}");
    for word in words {
        assert!(stderr.contains(word), "{line}: {stderr:?} does not say {word:?}");
    }
    assert_eq!(entries(), before, "{line} wrote something");
}

const STRUCTURE: &str =
    "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 100.0\n";

const AT2: &str = "PEER\nname\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS= 4, DT= .01000 SEC\n";

fn run_case(text: &str, words: &[&str]) {
    refuses(&[("case.toml", text)], "run case.toml --quiet --out results", words);
}

fn run_record(name: &str, text: &str, more: &str, words: &[&str]) {
    let line = format!("run --quiet --out results --record {name} {more}");
    refuses(&[(name, text)], &line, words);
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

fn export(more: &str, words: &[&str]) {
    let line = format!("export --parameters p.json {more}");
    refuses(&[("p.json", &parameters(1e6))], &line, words);
}

fn verify(more: &str, words: &[&str]) {
    let line = format!("verify --parameters p.json --duration 3 {more}");
    refuses(&[("p.json", &parameters(1e6))], &line, words);
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
const USERS: [&str; 3] = [
    "simulate --parameters p.json",
    "verify --parameters p.json",
    "export --parameters p.json --format csv --out springs.csv",
];
