//! What is doubted is a warning, exit code 0; and what an option says of the file that a case names
//! is done.

use super::*;

const CABINET: &str =
    "[structure]\nkind = \"block\"\nheight_m = 1.9\nwidth_m = 0.8\nmass_kg = 400.0\n";

/// Four samples, the second column twice as strong as the first.
const TABLE: &str =
    "t [s],a [g],b [g]\n0.00,0.1,0.2\n0.01,-0.1,-0.2\n0.02,0.05,0.1\n0.03,0.0,0.0\n";

/// stderr of a command that ends well.
fn accepts(files: &[(&str, &str)], line: &str) -> String {
    TestFolder::with(files).runs(line).stderr
}

/// Doubts of a run, as parameters.json has them: message and remedy. The screen warns of them.
fn doubts(case: &str, more: &str) -> Vec<String> {
    let dir = TestFolder::with(&[("case.toml", case), ("a.csv", TABLE)]);
    let run = "run case.toml --quiet --no-figures --no-front --no-report --max-hz 60";
    let screen = dir.runs(&format!("{run} {more}")).stdout;
    let filed = dir.json("out/parameters.json");
    let findings = filed["findings"].as_array().unwrap();
    let doubts: Vec<_> = findings.iter().filter(|finding| finding["finding"] == "doubt").collect();
    assert!(doubts.iter().all(|doubt| doubt["weight"] == "warning"), "{doubts:?}");
    assert!(doubts.is_empty() || screen.contains("CHECK     "), "{screen}");
    let words = |doubt: &&serde_json::Value| {
        format!("{}; {}", doubt["message"].as_str().unwrap(), doubt["remedy"].as_str().unwrap())
    };
    doubts.iter().map(words).collect()
}

#[test]
fn doubts_are_warnings() {
    let short = "--duration 2";
    assert_eq!(
        doubts(CABINET, short),
        ["height_m = 1.9, of the centre of mass, makes a block 3.8 m tall; if 1.9 m is its total \
            height, write total_height_m = 1.9"]
    );
    let light = CABINET.replace("1.9", "1.0").replace("400.0", "0.4");
    let found = doubts(&light, short);
    assert!(
        found.len() == 1
            && found[0]
                .contains("a mean density of 0.3125 kg/m3 is not within 5 to 25000: 0.4 kg in a"),
        "{found:?}"
    );
    let plain = CABINET.replace("1.9", "1.0");
    assert_eq!(doubts(&plain, short), [] as [&str; 0]);
    let found = doubts(&plain, "--duration 2 --scale 0.01");
    assert!(found.len() == 1 && found[0].contains("below 0.005 g; check the unit"), "{found:?}");
    // the part used is weak, the record is not
    let found = doubts(&plain, "--duration 1 --scale 0.03");
    let told = "the whole record has 0.009386 g; use more of the record (--duration, duration_s)";
    assert!(found.len() == 1 && found[0].ends_with(told), "{found:?}");
    let found = doubts(&plain, "--record a.csv --column a --duration 90");
    assert_eq!(
        found,
        ["90 s are asked for, the record has 0.03 s; all of it is used; leave the duration out, \
                or \
            give a longer record"]
    );
}

#[test]
fn a_column_is_taken_by_number_or_name_from_option_or_case() {
    let peak = |stderr: &str| {
        stderr.lines().find_map(|line| Some(line.split_once("PGA ")?.1[..6].to_owned()))
    };
    for (more, pga) in
        [("--column 2", "0.1000"), ("--column b", "0.2000"), ("--component 'column 3'", "0.2000")]
    {
        let line = format!("housner --record a.csv {more}");
        assert_eq!(peak(&accepts(&[("a.csv", TABLE)], &line)).as_deref(), Some(pga), "{line}");
    }
    for (column, pga) in [("2", "0.1000"), ("\"b\"", "0.2000")] {
        let case = format!("{STRUCTURE}[record]\nfile = \"a.csv\"\ncolumn = {column}\n");
        let files = [("case.toml", case.as_str()), ("a.csv", TABLE)];
        assert_eq!(peak(&accepts(&files, "housner case.toml")).as_deref(), Some(pga));
        // an option goes before the case
        let said = accepts(&files, "housner case.toml --column a");
        assert_eq!(peak(&said).as_deref(), Some("0.1000"), "{said}");
    }
}

#[test]
fn bare_values_read_row_by_row_are_said() {
    let values = "0.1 -0.2 0.3\n-0.1 0.2 -0.3\n0.2 -0.1 0.1\n0.1 0.3 0.2\n";
    let options = "--record a.txt --dt 0.01 --units g";
    let said = accepts(&[("a.txt", values)], &format!("housner {options}"));
    assert!(
        said.contains("3 columns without times are read row by row, as one series of 12 samples"),
        "{said}"
    );
    let said = accepts(&[("a.txt", values)], &format!("housner --column 3 {options}"));
    assert!(said.contains(": 4 samples of 0.01 s") && !said.contains("row by row"), "{said}");
}

#[test]
fn options_speak_of_the_file_that_a_case_names() {
    let case = format!("{STRUCTURE}[record]\nfile = \"a.txt\"\n");
    let files = [("case.toml", case.as_str()), ("a.txt", "0.1\n0.3\n-0.2\n")];
    let said = accepts(&files, "housner case.toml --dt 0.02 --units m/s2 --baseline");
    assert!(said.contains("(a.txt, in m/s2)") && said.contains("3 samples of 0.02 s"), "{said}");
    refuses(
        &files,
        "housner case.toml --dt 0.02",
        &["a.txt: the unit of acceleration is not in the file"],
    );
}

#[test]
fn housner_and_record_doubt_what_a_run_doubts() {
    let millimetres = "[structure]\nkind = \"block\"\ntotal_height_m = 1700.0\nwidth_m = 500.0\n\
        mass_kg = 310.0\n";
    let checks = |line: &str| -> Vec<String> {
        let said = accepts(&[("case.toml", millimetres), ("weak.csv", WEAK)], line);
        said.lines().filter(|line| line.contains("; ")).map(str::to_owned).collect()
    };
    let of_structure = doubts(millimetres, "--duration 2");
    let said = checks("housner case.toml --duration 2 --out h.csv");
    assert!(of_structure.len() == 2 && said.len() == 2, "{of_structure:?} {said:?}");
    assert!(of_structure.iter().all(|doubt| said.contains(&format!("CHECK {doubt}"))), "{said:?}");
    let long = checks("housner --duration 90 --out h.csv");
    let told = "CHECK 90 s are asked for, the record has 39.94 s; all of it is used";
    assert!(long.len() == 1 && long[0].starts_with(told), "{long:?}");
    let weak = checks("record weak.csv");
    let told = "weak.csv: the ground motion has a peak of 5.6e-4 g, below 0.005 g; check the unit \
        of the record and its scale";
    assert_eq!(weak, [told]);
}

const WEAK: &str = "t [s],a [g]\n0.00,0.00056\n0.01,-0.0005\n0.02,0.0001\n0.03,0.0\n";
