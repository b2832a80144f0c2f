//! The corpus of the fuzz targets (`fuzz/`), replayed: every input that ever reached new code or
//! failed.

use std::{fs, path::Path};

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rayon::prelude::*;

#[path = "../fuzz/checks.rs"]
mod checks;

/// Of what must hold of any bytes.
type Check = fn(&[u8]);

fn replay(target: &str, check: Check) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(target);
    let mut files: Vec<_> =
        fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
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

/// Inputs made from the corpus and from random bytes, seed by seed: `MUTATED=1000000 cargo test
/// --release --test fuzz_corpus mutated -- --nocapture` tries more of them, `MUTATED_SEED=7` that
/// one alone.
#[test]
fn mutated_and_random_inputs_are_read_or_refused_in_one_line() {
    let targets: [(&str, Check); 3] =
        [("record", checks::record), ("case", checks::case), ("parameters", checks::parameters)];
    let corpora: Vec<Vec<Vec<u8>>> = targets.iter().map(|(target, _)| corpus(target)).collect();
    let number = |name: &str| std::env::var(name).ok().map(|text| text.parse::<u64>().unwrap());
    let seeds = match number("MUTATED_SEED") {
        Some(seed) => seed..seed + 1,
        None => 0..number("MUTATED").unwrap_or(1500),
    };
    let fails = |seed: &u64| {
        let which = (*seed % 3) as usize;
        let input = input(&corpora[which], *seed);
        std::panic::catch_unwind(|| targets[which].1(&input)).is_err()
    };
    let tried = seeds.end - seeds.start;
    let failed: Vec<u64> = seeds.into_par_iter().filter(fails).collect();
    let memory = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak =
        memory.lines().find(|line| line.starts_with("VmHWM")).unwrap_or("VmHWM: not known here");
    println!("{tried} inputs, {} failed; {peak}", failed.len());
    assert!(failed.is_empty(), "seeds that fail, each by MUTATED_SEED: {failed:?}");
}

/// The inputs of a target, and files of the formats that it reads.
fn corpus(target: &str) -> Vec<Vec<u8>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders: &[&str] =
        if target == "record" { &["tests/records", "tuning/records"] } else { &["tuning"] };
    let listed =
        |folder: &str| fs::read_dir(root.join(folder)).unwrap().map(|entry| entry.unwrap().path());
    let wanted = |path: &std::path::PathBuf| {
        path.is_file() && (target == "record" || path.extension().is_some())
    };
    let mut files: Vec<_> =
        folders.iter().flat_map(|folder| listed(folder)).filter(wanted).collect();
    files.extend(listed(&format!("fuzz/corpus/{target}")));
    files.sort();
    // a file's beginning holds its headers and some numbers
    let beginning =
        |path: &std::path::PathBuf| fs::read(path).unwrap().into_iter().take(6000).collect();
    files.iter().map(beginning).collect()
}

/// What numbers of a file may become.
const NUMBERS: [&str; 12] = [
    "0",
    "-1",
    "1e308",
    "-1e-308",
    "nan",
    "inf",
    "1e999",
    "99999999999",
    "0x10",
    "1,5",
    "",
    "3.0e",
];

/// One input: a file of the corpus, changed in one to six places, or random bytes.
fn input(corpus: &[Vec<u8>], seed: u64) -> Vec<u8> {
    let mut dice = ChaCha8Rng::seed_from_u64(seed);
    if dice.random_bool(0.05) {
        let length = dice.random_range(0..400);
        return (0..length).map(|_| dice.random()).collect();
    }
    let mut bytes = corpus[dice.random_range(0..corpus.len())].clone();
    for _ in 0..dice.random_range(1..=6) {
        let at = dice.random_range(0..=bytes.len());
        let until = (at + dice.random_range(1..64)).min(bytes.len());
        match dice.random_range(0..8) {
            0 if at < bytes.len() => bytes[at] ^= 1 << dice.random_range(0..8),
            1 => bytes.truncate(at),
            2 => drop(bytes.drain(at..until)),
            3 => {
                let part = bytes[at..until].to_vec();
                bytes.splice(at..at, part);
            }
            4 => {
                let other = &corpus[dice.random_range(0..corpus.len())];
                let from = dice.random_range(0..=other.len());
                let part =
                    other[from..(from + dice.random_range(1..400)).min(other.len())].to_vec();
                bytes.splice(at..until, part);
            }
            5 if at < bytes.len() => bytes[at] = dice.random(),
            // a number, in place of the next one
            _ => {
                let digit = |byte: &u8| byte.is_ascii_digit() || b"+-.eE".contains(byte);
                let Some(begin) = bytes[at..].iter().position(digit).map(|i| at + i) else {
                    continue;
                };
                let end = bytes[begin..]
                    .iter()
                    .position(|byte| !digit(byte))
                    .map_or(bytes.len(), |i| begin + i);
                bytes.splice(begin..end, NUMBERS[dice.random_range(0..NUMBERS.len())].bytes());
            }
        }
    }
    bytes
}
