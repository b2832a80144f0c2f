//! Sweep files: the line, what is wrong, what to do.

use super::refuses;

const HEAD: &str = "[sweep]\nkind = \"fragility\"\n";
const BLOCK: &str =
    "[[structure]]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 100.0\n";
const GROUND: &str = "[records]\nel_centro = true\n";
const LEVELS: &str = "[levels]\nscale = [1.0]\n";

fn sweep(text: &str, words: &[&str]) {
    refuses(&[("sweep.toml", text)], "sweep sweep.toml --quiet --out results", words);
}

#[test]
fn a_sweep_that_asks_for_nothing_or_twice_is_refused_with_its_line() {
    for (text, words) in [
        (format!("{HEAD}{GROUND}{LEVELS}"), ["line 2", "no structure"]),
        (format!("{HEAD}{BLOCK}{LEVELS}"), ["line 2", "no ground motion"]),
        (format!("{HEAD}{BLOCK}{GROUND}"), ["line 2", "no [levels]"]),
        (
            format!("{HEAD}{BLOCK}{GROUND}[levels]\nscale = 1.0\npga_g = 0.4\n"),
            ["line 10", "give one of"],
        ),
        (format!("{HEAD}{BLOCK}{GROUND}[levels]\nscale = -1.0\n"), ["line 11", "scale has -1.0"]),
        (format!("{HEAD}{BLOCK}{GROUND}[levels]\nscale = []\n"), ["line 11", "0 values"]),
        (
            format!("{HEAD}{BLOCK}{GROUND}[levels]\nscales = 1.0\n"),
            ["line 11", "did you mean \"scale\""],
        ),
        (
            format!("{HEAD}restitution = 1.5\n{BLOCK}{GROUND}{LEVELS}"),
            ["line 3", "restitution has 1.5"],
        ),
        (format!("{HEAD}model = \"both ways\"\n{BLOCK}{GROUND}{LEVELS}"), ["line 3", "known are"]),
        (format!("{HEAD}{BLOCK}name = \"a\\nb\"\n{GROUND}{LEVELS}"), ["line 8", "1 to 40 letters"]),
        (format!("{HEAD}{BLOCK}name = 3\n{GROUND}{LEVELS}"), ["line 8", "a text in quotes"]),
        (format!("{HEAD}{BLOCK}names = \"a\"\n{GROUND}{LEVELS}"), ["line 8", "unknown"]),
        (format!("{HEAD}part = 0\n{BLOCK}{GROUND}{LEVELS}"), ["line 3", "1 to 1000000"]),
        (
            format!("{HEAD}{BLOCK}[records]\nearthquakes = 0\n{LEVELS}"),
            ["line 9", "earthquakes is 0"],
        ),
        (
            format!(
                "{HEAD}{GROUND}{LEVELS}[grid]\nkind = \"block\"\nsize_m = 1.0\nslenderness = 1.2\n"
            ),
            ["line 10", "slenderness has 1.2"],
        ),
        (
            format!(
                "{HEAD}{GROUND}{LEVELS}[grid]\nkind = \"cone\"\nsize_m = 1.0\nslenderness = 0.2\n"
            ),
            ["line 8", "aframe"],
        ),
    ] {
        sweep(&text, &words);
    }
}

#[test]
fn pulses_that_are_none_are_refused_with_their_line() {
    let with = |pulse: &str| format!("{HEAD}{BLOCK}[[pulse]]\n{pulse}{LEVELS}");
    sweep(
        &with("shape = \"square\"\nomega_over_p = 2.0\n"),
        &["line 9", "shape is \"square\"; known are"],
    );
    sweep(&with("shape = \"sine\"\n"), &["line 9", "omega_over_p or frequency_hz"]);
    sweep(&with("shape = \"sine\"\nomega_over_p = 0.0\n"), &["line 10", "omega_over_p has 0.0"]);
    sweep(
        &with("shape = \"sine\"\ngamma = 2.0\nomega_over_p = 1.0\n"),
        &["line 9", "take them out"],
    );
    sweep(
        &with("shape = \"mavroeidis-papageorgiou\"\nomega_over_p = 1.0\n"),
        &["line 9", "needs gamma"],
    );
    let spectrum = format!(
        "[sweep]\nkind = \"overturning\"\n{BLOCK}{GROUND}[levels]\npga_over_uplift = [1.0, 2.0]\n"
    );
    sweep(&spectrum, &["line 2", "of pulses"]);
    let scanned = format!(
        "[sweep]\nkind = \"overturning\"\n{BLOCK}[[pulse]]\nshape = \"sine\"\nomega_over_p = 2.0\n\
            {LEVELS}"
    );
    sweep(&scanned, &["line 12", "pga_over_uplift"]);
}

#[test]
fn records_that_are_not_there_or_do_not_move_are_named() {
    let with = |records: &str| format!("{HEAD}{BLOCK}[records]\n{records}{LEVELS}");
    sweep(&with("files = [\"none.at2\"]\n"), &["none.at2", "cannot be read"]);
    sweep(&with("folder = \"none\"\n"), &["none", "cannot be read"]);
    let still = with("files = [\"still.txt\"]\ndt_s = 0.01\nunits = \"g\"\n");
    let args = "sweep sweep.toml --quiet --out results";
    refuses(
        &[("sweep.toml", &still), ("still.txt", "0\n0\n0\n0\n0\n")],
        args,
        &["still", "no motion"],
    );
}

#[test]
fn shares_and_folders_that_are_none_are_refused() {
    let text = format!("{HEAD}{BLOCK}{GROUND}{LEVELS}");
    let files = [("sweep.toml", text.as_str())];
    refuses(&files, "sweep sweep.toml --shard 9/8", &["9/8 is no share"]);
    refuses(&files, "sweep gather sweep.toml --out none", &["none: no sweep there"]);
    refuses(&files, "sweep", &["required"]);
    refuses(&files, "sweep none.toml", &["none.toml", "cannot be read"]);
    refuses(&files, "sweep plan sweep.toml --slurm --time '2h; rm'", &["--time"]);
}

#[test]
fn a_motion_that_no_other_can_be_like_is_refused() {
    let with = |records: &str| format!("{HEAD}{BLOCK}[records]\n{records}{LEVELS}");
    sweep(&with("like = \"none.csv\"\n"), &["none.csv"]);
    sweep(&with("el_centro = true\nlike_count = 5\n"), &["line 10", "like_count without like"]);
    let made = with("synthetic = 3\nvertical = \"auto\"\n");
    sweep(&made, &["line 10", "those of this sweep are horizontal: take it out"]);
    sweep(&with("like = \"sweep.toml\"\n"), &["sweep.toml"]);
    let files = |count: &str, motion: &str| {
        let text = with(&format!("like = \"floor.csv\"\n{count}dt_s = 0.01\nunits = \"g\"\n"));
        (text, motion.to_string())
    };
    let wave: String = (0..400).map(|i| format!("{:.6}\n", (0.2 * f64::from(i)).sin())).collect();
    for ((text, motion), words) in [
        (files("", "0.1\n0.2\n0.1\n"), ["floor", "3 samples"]),
        (files("", &"0.0\n".repeat(400)), ["floor", "no motion"]),
        (files("like_count = 0\n", &wave), ["line 10", "like_count is 0"]),
    ] {
        refuses(
            &[("sweep.toml", &text), ("floor.csv", &motion)],
            "sweep sweep.toml --quiet --out results",
            &words,
        );
    }
}

#[test]
fn elastic_structures_are_said_to_be_none_for_sweeps() {
    let rest = format!("{GROUND}{LEVELS}");
    let pier = "[[structure]]\nkind = \"pier\"\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = 6e5\n\
        footing_mass_kg = 6e4\nfooting_height_m = 1.5\nfrequency_hz = 2.0\ndamping_ratio = 0.02\n";
    let words = ["line 4", "kind = \"pier\" is elastic; sweeps follow rigid bodies alone"];
    sweep(&format!("{HEAD}{pier}{rest}"), &words);
    let frame = BLOCK.replace("block", "aframe") + "ea_n = 1e9\nei_nm2 = 1e9\n";
    let words = ["line 8", "ea_n and ei_nm2 are of an elastic A-frame; sweeps follow rigid"];
    sweep(&format!("{HEAD}{frame}{rest}"), &words);
    let spacing = "[levels]\nscale = { from = 1.0, to = 2.0, count = 3, spacing = \"lin\" }\n";
    let words = ["line 11", "spacing is \"lin\"; give \"linear\" or \"log\""];
    sweep(&format!("{HEAD}{BLOCK}{GROUND}{spacing}"), &words);
}
