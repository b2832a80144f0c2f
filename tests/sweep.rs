//! `tune sweep`: killed and gone on with, cut into shares, on any number of threads, the bytes are
//! the same.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
    process::{Child, Stdio},
    thread::sleep,
    time::Duration,
};

#[path = "support/program.rs"]
mod program;

use program::{TestFolder, command};

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

/// `tune sweep` begun in a folder, silent.
fn start(folder: &TestFolder, out: &str) -> Child {
    let line = format!("sweep sweep.toml --out {out} --quiet");
    let mut command = command(&folder.path(""), &line);
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

fn sweep(folder: &TestFolder, out: &str, more: &str) {
    folder.runs(&format!("sweep sweep.toml --out {out} --quiet {more}"));
}

/// A sweep of El Centro alone.
fn few() -> String {
    SWEEP.replace("earthquakes = 40", "").replace("synthetic = 20", "")
}

/// The file of a part in a folder of results.
fn part(folder: &TestFolder, out: &str, i: u32) -> PathBuf {
    folder.path(&format!("{out}/parts/part-{i:05}-of-00025.parquet"))
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

/// Two folders of results have the same files.
fn same(folder: &TestFolder, a: &str, b: &str) {
    let [a, b] = [a, b].map(|out| files(&folder.path(out)));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>());
    for (name, bytes) in &a {
        assert!(b[name] == *bytes, "{name} differs");
    }
}

fn begun() -> TestFolder {
    let dir = TestFolder::with(&[("sweep.toml", SWEEP)]);
    sweep(&dir, "whole", "--jobs 1");
    dir
}

#[test]
fn a_sweep_killed_ten_times_and_gone_on_with_has_the_same_bytes() {
    let dir = begun();
    let mut killed = 0;
    for i in 0_u64..40 {
        let mut child = start(&dir, "killed");
        // moments without a rhythm, from before the first part to after several
        sleep(Duration::from_millis(3 + i * i * 37 % 61));
        child.kill().unwrap();
        killed += u32::from(!child.wait().unwrap().success());
        if killed == 10 {
            break;
        }
    }
    sweep(&dir, "killed", "");
    assert!(killed >= 3, "only {killed} runs were caught alive");
    same(&dir, "whole", "killed");
}

#[test]
fn shares_on_other_threads_in_another_order_and_twice_give_the_same_bytes() {
    let dir = begun();
    for share in ["3/3", "1/3", "2/3", "1/3"] {
        sweep(&dir, "shares", &format!("--shard {share} --jobs 2"));
    }
    // one part lost, one damaged: both are computed again
    let part = |i| part(&dir, "shares", i);
    fs::remove_file(part(2)).unwrap();
    let bytes = fs::read(part(4)).unwrap();
    fs::write(part(4), &bytes[..bytes.len() / 2]).unwrap();
    let gather = "sweep gather sweep.toml --out shares";
    let ended = dir.tune(gather);
    assert_eq!(ended.code, Some(1));
    assert!(ended.stderr.contains("2 of 25 parts are missing (2, 4)"), "{}", ended.stderr);
    sweep(&dir, "shares", "--shard 1/1");
    dir.runs(gather);
    same(&dir, "whole", "shares");
}

#[test]
fn another_sweep_in_the_same_folder_is_refused() {
    let few = few();
    let dir = TestFolder::with(&[("sweep.toml", &few)]);
    sweep(&dir, "out", "--no-figures");
    for other in [
        few.replace("seed = 5", "seed = 6"),
        few.replace("mass_kg = 400.0", "mass_kg = 400.0\nname = \"cabinet\""),
    ] {
        dir.write("sweep.toml", other);
        let said = dir.refuses("sweep sweep.toml --out out");
        assert!(said.contains("holds another sweep"), "{said}");
    }
}

/// What `tune sweep gather` says of a folder; it must refuse it in one line.
fn refused(dir: &TestFolder, out: &str) -> String {
    let gather = dir.tune(&format!("sweep gather sweep.toml --out {out}"));
    let said = gather.stderr;
    assert!(matches!(gather.code, Some(1 | 2)) && said.lines().count() == 1, "{said}");
    said
}

#[test]
fn a_part_that_is_another_or_has_a_bit_changed_is_refused_and_computed_again() {
    let dir = begun();
    let part = |i| part(&dir, "whole", i);
    let good = files(&dir.path("whole"));
    fs::copy(part(0), part(3)).unwrap();
    let said = refused(&dir, "whole");
    assert!(
        said.contains("1 of 25 parts are missing (3): the file of part 3 is part 0 of 25"),
        "{said}"
    );
    let mut bytes = fs::read(part(7)).unwrap();
    for at in (0..bytes.len()).step_by(97) {
        bytes[at] ^= 1;
        fs::write(part(7), &bytes).unwrap();
        let said = refused(&dir, "whole");
        assert!(said.contains("the file of part 7 is damaged"), "byte {at}: {said}");
        bytes[at] ^= 1;
    }
    bytes[100] ^= 1;
    fs::write(part(7), &bytes).unwrap();
    sweep(&dir, "whole", "");
    assert_eq!(files(&dir.path("whole")), good);
}

#[test]
fn two_sweeps_in_one_folder_share_it_and_lose_nothing() {
    let dir = begun();
    for pause in [0, 3, 11, 29] {
        let mut first = start(&dir, "both");
        sleep(Duration::from_millis(pause));
        let mut second = start(&dir, "both");
        assert!(first.wait().unwrap().success() && second.wait().unwrap().success());
        same(&dir, "whole", "both");
        fs::remove_dir_all(dir.path("both")).unwrap();
    }
}

#[test]
fn springs_and_manifests_that_a_hand_has_changed_are_refused() {
    let text = few().replace("kind = \"fragility\"", "kind = \"compare\"");
    let text = text.replace("count = 12", "count = 2") + "[springs]\naccuracy = 0.02\n";
    let dir = TestFolder::with(&[("sweep.toml", &text)]);
    sweep(&dir, "out", "--no-figures");
    let again = |file: &str, from: &str, to: &str| {
        let path = format!("out/{file}");
        let good = dir.text(&path);
        let changed = good.replacen(from, to, 1);
        assert_ne!(good, changed);
        dir.write(&path, changed);
        let said = dir.refuses("sweep sweep.toml --out out");
        assert!(said.contains(file), "{said}");
        dir.write(&path, good);
    };
    again("springs.json", "\"omega_n_hz_over_p\": ", "\"omega_n_hz_over_p\": -");
    again("manifest.json", "\"cells\": ", "\"cells\": 1");
    sweep(&dir, "out", "--no-figures");
}

/// A cell of an overturning spectrum has as many rows as it has intervals: its parts are taken as
/// they were written, and again by a second run.
#[test]
fn an_overturning_spectrum_is_gathered_from_parts_of_any_number_of_rows() {
    let spec = include_str!("../tuning/sweeps/overturning.toml");
    let spec = spec.replace("count = 120", "count = 24").replace("count = 600", "count = 60");
    let folder = TestFolder::with(&[("sweep.toml", &spec)]);
    for out in ["first", "second", "second"] {
        sweep(&folder, out, "--no-figures");
    }
    same(&folder, "first", "second");
}

/// What a sweep of `[records]` and levels prints on stdout and stderr.
fn told(records: &str, more: &str) -> (TestFolder, String) {
    let spec = SWEEP.split("[records]").next().unwrap();
    let levels = "[levels]\npga_g = [0.5, 0.8, 2.0]\n";
    let spec = format!("{spec}[records]\n{records}\n{levels}");
    let dir = TestFolder::with(&[("sweep.toml", &spec)]);
    let ran = dir.runs(&format!("sweep sweep.toml --out out --quiet {more}"));
    (dir, ran.stdout + &ran.stderr)
}

#[test]
fn figures_of_several_structures_stay_in_the_folder() {
    let (dir, _) = told("el_centro = true\nearthquakes = 5", "");
    for name in ["fragility.png", "fragility_structures.png", "fragility_structures.svg"] {
        assert!(dir.path("out").join(name).is_file(), "{name}");
    }
}

/// A record of which the strong part is cut off is scaled by thousands; one that is there twice
/// counts as two; a vertical motion is left out.
#[test]
fn doubts_of_records_and_structures_are_told_before_and_in_the_summary() {
    let record = program::TE_MARA;
    let (dir, said) =
        told(&format!("files = [{record:?}, {record:?}]\nduration_s = 5.0"), "--no-figures");
    for part in [
        "the levels scale this record by up to",
        "below 0.005 g; the whole record has 0.9922 g; use more of the record (duration_s under",
        "a vertical component of 1.837 g beside 0.9922 g across is left out; write vertical =",
        "and it counts twice; take one of them out",
        "choose with component under [records]",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let summary = dir.text("out/summary.md");
    assert_eq!(summary.matches("\nCHECK ").count(), 4, "{summary}");
    let (_, none) = told("el_centro = true\nsynthetic = 3", "--no-figures");
    assert!(!none.contains("CHECK"), "{none}");
}

/// Motions made like a given one have peaks of their own: 2 g is 101 times this one's 0.0198 g.
#[test]
fn the_scale_of_motions_like_a_given_one_is_that_of_these() {
    let weak = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/records/20180212_211557_WPWS_20.V2A");
    let (_, said) = told(&format!("like = {weak:?}\nlike_count = 3"), "--no-figures");
    let scale = said.split("scale this record by up to ").nth(1).unwrap();
    let scale: f64 = scale.split(';').next().unwrap().parse().unwrap();
    assert!((105.0..300.0).contains(&scale), "{said}");
}

/// Motions like a given one are made on all threads while the sweep is read: `--jobs` must count
/// before that, alone and in the commands that `tune sweep plan` writes.
#[test]
fn motions_like_a_given_one_are_the_same_on_any_number_of_threads() {
    let spec = SWEEP.split("[[structure]]").nth(1).unwrap();
    let spec = format!(
        "[sweep]\nkind = \"fragility\"\npart = 20\n[[structure]]{spec}[records]\nlike = {:?}\n\
         like_count = 20\n[levels]\npga_g = [0.3, 0.6, 1.0]\n",
        program::WAIPAWA
    );
    let dir = TestFolder::with(&[("sweep.toml", &spec)]);
    sweep(&dir, "whole", "--no-figures");
    assert_eq!(files(&dir.path("whole/parts")).len(), 3);
    sweep(&dir, "one", "--no-figures --jobs 1");
    sweep(&dir, "two", "--no-figures --jobs 2");
    for share in ["1/2 --jobs 1", "2/2 --jobs 2"] {
        sweep(&dir, "shares", &format!("--shard {share}"));
    }
    dir.runs("sweep gather sweep.toml --out shares --no-figures");
    for out in ["one", "two", "shares"] {
        same(&dir, "whole", out);
    }
    let said = dir.refuses("sweep sweep.toml --out none --jobs 2000");
    assert!(said.contains("--jobs is 2000; give at most 1024 threads"), "{said}");
}

#[test]
fn a_summary_of_some_parts_tells_of_how_many_histories() {
    let dir = begun();
    fs::remove_file(part(&dir, "whole", 3)).unwrap();
    dir.runs("sweep gather sweep.toml --out whole --partial --no-figures --quiet");
    let summary = dir.text("whole/summary.md");
    assert!(summary.starts_with("1404 of 1464 histories: 2 structures"), "{summary}");
}
