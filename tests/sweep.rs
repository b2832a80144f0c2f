//! `tune sweep`: killed and gone on with, cut into shares, on any number of threads, the bytes are
//! the same.

use std::{
    collections::BTreeMap,
    fs,
    path::Path,
    process::{Command, Stdio},
    thread::sleep,
    time::Duration,
};

use tempfile::TempDir;

const SWEEP: &str = r#"
[sweep]
kind = "fragility"
seed = 5
part = 60

[[structure]]
kind = "aframe"
height_m = 12.0
width_m = 2.4
mass_kg = 350e3

[[structure]]
kind = "block"
total_height_m = 2.0
width_m = 0.5
mass_kg = 400.0

[records]
el_centro = true
earthquakes = 40
synthetic = 20

[levels]
pga_g = { from = 0.1, to = 2.0, count = 12, spacing = "log" }
"#;

fn tune(folder: &Path, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tune"));
    command.current_dir(folder).args(args).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

fn sweep(folder: &Path, out: &str, more: &[&str]) {
    let args = [&["sweep", "sweep.toml", "--out", out, "--quiet"], more].concat();
    assert!(tune(folder, &args).status().unwrap().success(), "{args:?}");
}

/// Every file below a folder with its bytes.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(here) = folders.pop() {
        for entry in fs::read_dir(here).unwrap().map(|entry| entry.unwrap().path()) {
            if entry.is_dir() {
                folders.push(entry);
            } else {
                let name = entry.strip_prefix(folder).unwrap().display().to_string();
                found.insert(name, fs::read(&entry).unwrap());
            }
        }
    }
    found
}

fn same(a: &Path, b: &Path) {
    let (a, b) = (files(a), files(b));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
    for (name, bytes) in &a {
        assert!(b[name] == *bytes, "{name} differs");
    }
}

fn begun() -> TempDir {
    let dir = TempDir::new().unwrap();
    fs::write(dir.path().join("sweep.toml"), SWEEP).unwrap();
    sweep(dir.path(), "whole", &["--jobs", "1"]);
    dir
}

#[test]
fn a_sweep_killed_ten_times_and_gone_on_with_has_the_same_bytes() {
    let dir = begun();
    let mut killed = 0;
    for i in 0_u64..40 {
        let mut child = tune(dir.path(), &["sweep", "sweep.toml", "--out", "killed", "--quiet"])
            .spawn()
            .unwrap();
        // moments without a rhythm, from before the first part to after several
        sleep(Duration::from_millis(3 + i * i * 37 % 61));
        child.kill().unwrap();
        killed += u32::from(!child.wait().unwrap().success());
        if killed == 10 {
            break;
        }
    }
    sweep(dir.path(), "killed", &[]);
    assert!(killed >= 3, "only {killed} runs were caught alive");
    same(&dir.path().join("whole"), &dir.path().join("killed"));
}

#[test]
fn shares_on_other_threads_in_another_order_and_twice_give_the_same_bytes() {
    let dir = begun();
    for share in ["3/3", "1/3", "2/3", "1/3"] {
        sweep(dir.path(), "shares", &["--shard", share, "--jobs", "2"]);
    }
    // one part lost, one damaged: both are computed again
    let part = |i: u32| dir.path().join(format!("shares/parts/part-{i:05}-of-00025.parquet"));
    fs::remove_file(part(2)).unwrap();
    let bytes = fs::read(part(4)).unwrap();
    fs::write(part(4), &bytes[..bytes.len() / 2]).unwrap();
    let gather = tune(dir.path(), &["sweep", "gather", "sweep.toml", "--out", "shares"])
        .stderr(Stdio::piped())
        .output()
        .unwrap();
    assert_eq!(gather.status.code(), Some(1));
    let said = String::from_utf8(gather.stderr).unwrap();
    assert!(said.contains("2 of 25 parts are missing (2, 4)"), "{said}");
    sweep(dir.path(), "shares", &["--shard", "1/1"]);
    assert!(
        tune(dir.path(), &["sweep", "gather", "sweep.toml", "--out", "shares"])
            .status()
            .unwrap()
            .success()
    );
    same(&dir.path().join("whole"), &dir.path().join("shares"));
}

#[test]
fn another_sweep_in_the_same_folder_is_refused() {
    let dir = TempDir::new().unwrap();
    let write = |text: &str| fs::write(dir.path().join("sweep.toml"), text).unwrap();
    write(&SWEEP.replace("earthquakes = 40", "").replace("synthetic = 20", ""));
    sweep(dir.path(), "out", &["--no-figures"]);
    let few = SWEEP.replace("earthquakes = 40", "").replace("synthetic = 20", "");
    for other in [
        few.replace("seed = 5", "seed = 6"),
        few.replace("mass_kg = 400.0", "mass_kg = 400.0\nname = \"cabinet\""),
    ] {
        write(&other);
        let refused = tune(dir.path(), &["sweep", "sweep.toml", "--out", "out"])
            .stderr(Stdio::piped())
            .output()
            .unwrap();
        let said = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(refused.status.code(), Some(2));
        assert!(said.contains("holds another sweep") && said.lines().count() == 1, "{said}");
    }
}

/// What `tune sweep gather` says of a folder; it must refuse it in one line.
fn refused(dir: &Path, out: &str) -> String {
    let args = ["sweep", "gather", "sweep.toml", "--out", out];
    let gather = tune(dir, &args).stderr(Stdio::piped()).output().unwrap();
    let said = String::from_utf8(gather.stderr).unwrap();
    assert!(matches!(gather.status.code(), Some(1 | 2)) && said.lines().count() == 1, "{said}");
    said
}

#[test]
fn a_part_that_is_another_or_has_a_bit_changed_is_refused_and_computed_again() {
    let dir = begun();
    let part = |i: u32| dir.path().join(format!("whole/parts/part-{i:05}-of-00025.parquet"));
    let good = files(&dir.path().join("whole"));
    fs::copy(part(0), part(3)).unwrap();
    let said = refused(dir.path(), "whole");
    assert!(
        said.contains("1 of 25 parts are missing (3): the file of part 3 is part 0 of 25"),
        "{said}"
    );
    let mut bytes = fs::read(part(7)).unwrap();
    for at in (0..bytes.len()).step_by(97) {
        bytes[at] ^= 1;
        fs::write(part(7), &bytes).unwrap();
        assert!(
            refused(dir.path(), "whole").contains("the file of part 7 is damaged"),
            "byte {at}"
        );
        bytes[at] ^= 1;
    }
    bytes[100] ^= 1;
    fs::write(part(7), &bytes).unwrap();
    sweep(dir.path(), "whole", &[]);
    assert_eq!(files(&dir.path().join("whole")), good);
}

#[test]
fn two_sweeps_in_one_folder_share_it_and_lose_nothing() {
    let dir = begun();
    for pause in [0, 3, 11, 29] {
        let start = || {
            tune(dir.path(), &["sweep", "sweep.toml", "--out", "both", "--quiet"]).spawn().unwrap()
        };
        let mut first = start();
        sleep(Duration::from_millis(pause));
        let mut second = start();
        assert!(first.wait().unwrap().success() && second.wait().unwrap().success());
        same(&dir.path().join("whole"), &dir.path().join("both"));
        fs::remove_dir_all(dir.path().join("both")).unwrap();
    }
}

#[test]
fn springs_and_manifests_that_a_hand_has_changed_are_refused() {
    let dir = TempDir::new().unwrap();
    let text = SWEEP.replace("earthquakes = 40", "").replace("synthetic = 20", "");
    let text = text
        .replace("kind = \"fragility\"", "kind = \"compare\"")
        .replace("count = 12", "count = 2");
    fs::write(dir.path().join("sweep.toml"), text + "[springs]\naccuracy = 0.02\n").unwrap();
    sweep(dir.path(), "out", &["--no-figures"]);
    let again = |file: &str, from: &str, to: &str| {
        let path = dir.path().join("out").join(file);
        let good = fs::read_to_string(&path).unwrap();
        let changed = good.replacen(from, to, 1);
        assert_ne!(good, changed);
        fs::write(&path, changed).unwrap();
        let refused = tune(dir.path(), &["sweep", "sweep.toml", "--out", "out"])
            .stderr(Stdio::piped())
            .output();
        let refused = refused.unwrap();
        let said = String::from_utf8(refused.stderr).unwrap();
        assert!(
            refused.status.code() == Some(2) && said.contains(file) && said.lines().count() == 1,
            "{said}"
        );
        fs::write(&path, good).unwrap();
    };
    again("springs.json", "\"omega_n_hz_over_p\": ", "\"omega_n_hz_over_p\": -");
    again("manifest.json", "\"cells\": ", "\"cells\": 1");
    sweep(dir.path(), "out", &["--no-figures"]);
}

/// A cell of an overturning spectrum has as many rows as it has intervals: its parts are taken as
/// they were written, and again by a second run.
#[test]
fn an_overturning_spectrum_is_gathered_from_parts_of_any_number_of_rows() {
    let folder = tempfile::tempdir().unwrap();
    let spec =
        fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/tuning/sweeps/overturning.toml"));
    let spec =
        spec.unwrap().replace("count = 120", "count = 24").replace("count = 600", "count = 60");
    fs::write(folder.path().join("sweep.toml"), spec).unwrap();
    sweep(folder.path(), "first", &["--no-figures"]);
    sweep(folder.path(), "second", &["--no-figures"]);
    sweep(folder.path(), "second", &["--no-figures"]);
    same(&folder.path().join("first"), &folder.path().join("second"));
}

/// What a sweep of `[records]` and levels prints on stdout and stderr.
fn told(records: &str, more: &[&str]) -> (TempDir, String) {
    let dir = TempDir::new().unwrap();
    let spec = SWEEP.split("[records]").next().unwrap();
    let levels = "[levels]\npga_g = [0.5, 0.8, 2.0]\n";
    fs::write(dir.path().join("sweep.toml"), format!("{spec}[records]\n{records}\n{levels}"))
        .unwrap();
    let args = [&["sweep", "sweep.toml", "--out", "out", "--quiet"], more].concat();
    let ran = tune(dir.path(), &args).stdout(Stdio::piped()).stderr(Stdio::piped()).output();
    let ran = ran.unwrap();
    assert!(ran.status.success(), "{ran:?}");
    let told = [ran.stdout, ran.stderr].map(|bytes| String::from_utf8(bytes).unwrap()).concat();
    (dir, told)
}

#[test]
fn figures_of_several_structures_stay_in_the_folder() {
    let (dir, _) = told("el_centro = true\nearthquakes = 5", &[]);
    for name in ["fragility.png", "fragility_structures.png", "fragility_structures.svg"] {
        assert!(dir.path().join("out").join(name).is_file(), "{name}");
    }
}

/// A record of which the strong part is cut off is scaled by thousands; one that is there twice
/// counts as two; a vertical motion is left out.
#[test]
fn doubts_of_records_and_structures_are_told_before_and_in_the_summary() {
    let records = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/records/20161113_110259_WTMC_20.V2A");
    let (dir, said) =
        told(&format!("files = [{records:?}, {records:?}]\nduration_s = 5.0"), &["--no-figures"]);
    for part in [
        "the levels scale this record by up to",
        "below 0.005 g; the whole record has 0.9922 g; use more of the record (duration_s under",
        "a vertical component of 1.837 g beside 0.9922 g across is left out; write vertical =",
        "and it counts twice; take one of them out",
        "choose with component under [records]",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let summary = fs::read_to_string(dir.path().join("out/summary.md")).unwrap();
    assert_eq!(summary.matches("\nCHECK ").count(), 4, "{summary}");
    let (_, none) = told("el_centro = true\nsynthetic = 3", &["--no-figures"]);
    assert!(!none.contains("CHECK"), "{none}");
}

#[test]
fn a_summary_of_some_parts_tells_of_how_many_histories() {
    let dir = begun();
    let out = dir.path().join("whole");
    fs::remove_file(out.join("parts/part-00003-of-00025.parquet")).unwrap();
    let args = ["sweep", "gather", "sweep.toml", "--out", "whole", "--partial", "--no-figures"];
    let args = [&args[..], &["--quiet"]].concat();
    assert!(tune(dir.path(), &args).status().unwrap().success());
    let summary = fs::read_to_string(out.join("summary.md")).unwrap();
    assert!(summary.starts_with("1404 of 1464 histories: 2 structures"), "{summary}");
}
