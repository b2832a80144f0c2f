//! Damaged files of each format: one line that says what is wrong, on which line, and what to do.

use strong_motion::{ReadOptions, Recording};

use crate::write;

/// The text with every line (from 1) changed; one that becomes none is left out.
fn changed(text: &str, change: impl Fn(usize, &str) -> Option<String>) -> String {
    let lines = text.lines().enumerate().filter_map(|(i, line)| change(i + 1, line));
    lines.collect::<Vec<_>>().join("\n")
}

/// The text with line `at` edited.
fn edit(text: &str, at: usize, change: impl Fn(&str) -> String) -> String {
    changed(text, |i, line| Some(if i == at { change(line) } else { line.to_owned() }))
}

/// The text up to line `at`.
fn cut(text: &str, at: usize) -> String {
    changed(text, |i, line| (i <= at).then(|| line.to_owned()))
}

/// The text with a word replaced from line `from` on.
fn replaced(text: &str, from: usize, word: &str, by: &str) -> String {
    changed(text, |i, line| Some(if i < from { line.to_owned() } else { line.replace(word, by) }))
}

fn without(text: &str, at: usize) -> String {
    changed(text, |i, line| (i != at).then(|| line.to_owned()))
}

fn line_of(text: &str, words: &str) -> usize {
    text.lines().position(|line| line.contains(words)).unwrap() + 1
}

/// Each text is refused in one line with these words.
fn refused(cases: &[(String, &str)]) {
    assert!(cases.len() >= 10);
    let mut wrong = Vec::new();
    for (text, words) in cases {
        for name in ["a.txt", "a.at2"] {
            let message = match Recording::parse(name, text.as_bytes(), &ReadOptions::default()) {
                Ok(_) => "accepted".to_owned(),
                Err(error) => error.to_string(),
            };
            if !message.contains(words) {
                wrong.push(format!("'{words}' is not in: {message}"));
            }
            assert!(!message.contains('\n') && message.len() < 400, "{message}");
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn geonet() {
    let text = write::geonet(&[("N28W", 5000.0), ("Up", 9000.0)], false);
    let component = 26 + 3 * 21;
    let printed_peak =
        format!("{:>8}", text.lines().nth(13).unwrap().split_whitespace().nth(2).unwrap());
    refused(&[
        (cut(&text, 10), "line 10: 16 lines of text"),
        (
            cut(&text, 40),
            "line 40: the acceleration samples end after 140 values where line 20 announces 203",
        ),
        (cut(&text, component - 1), "the displacement samples end after 200"),
        (cut(&text, component + 5), "16 lines of text"),
        (edit(&text, 30, |l| l.replace('.', "x")), "line 30: "),
        (edit(&text, 30, |l| l[..70].into()), "line 30: 9 numbers where 10 are expected"),
        (edit(&text, 30, |_| "     NaN".repeat(10)), "line 30: 'NaN' is not a finite number"),
        (edit(&text, 20, |l| l.replace("     203", "     204")), "line 10: the number of samples"),
        (edit(&text, 20, |l| l.replace("     203", "       x")), "line 20: the counts of samples"),
        (edit(&text, 23, |l| l.replace("0.0200", "0.0100")), "line 11: the time step"),
        (edit(&text, 23, |l| l.replace("0.0200", "0.0000")), "line 23: the time step"),
        (without(&text, 35), "line "),
        (edit(&text, 14, |l| l.replace("peak", "rms")), "line 14: 'Acceleration: peak'"),
        (
            edit(&text, 14, |l| l.replace(" at ", " at 9")),
            "line 14: the header gives the peak acceleration as",
        ),
        (
            edit(&text, 15, |l| l.replace("peak ", "peak 1")),
            "line 15: the header gives the peak velocity",
        ),
        (
            replaced(&text, 27, &printed_peak, "   100.0"),
            "line 14: the header gives the peak acceleration as",
        ),
        (edit(&text, component + 1, |_| "Something else".into()), "'Corrected accelerogram'"),
    ]);
}

#[test]
fn cosmos() {
    let text = write::cosmos(&[(360, 3.0), (90, 2.0)], ("cm/sec2", 4));
    let data = line_of(&text, "acceleration pts");
    let reals = line_of(&text, "Real-header");
    let at_data = |from: &str, to: &str| edit(&text, data, |line| line.replace(from, to));
    refused(&[
        (cut(&text, 8), "line 8: the lines of text"),
        (
            cut(&text, 20),
            "line 20: the integers of the header end after 60 values where line 14 announces 100",
        ),
        (
            cut(&text, reals + 3),
            "the numbers of the header end after 15 values where line 25 announces 100",
        ),
        (
            cut(&text, data),
            "the acceleration samples end after 0 values where line 49 announces 203",
        ),
        (cut(&text, data + 4), "line 53: the acceleration samples end after 32 values"),
        (without(&text, reals), "line 25: Real-header values follow should stand here"),
        (at_data("Format=(8F10.5)", ""), "line 49: '... acceleration pts"),
        (at_data("units=", ""), "line 49: '... acceleration pts"),
        (at_data("cm/sec2(04)", "counts(50)"), "counts of a digitiser"),
        (at_data("cm/sec2(04)", "psi(60)"), "line 49: the unit 'psi(60)'"),
        (text.replace("acceleration pts", "velocity pts"), "speaks of velocity"),
        (at_data("approx    4", "approx   12"), "line 49: the length in seconds"),
        (at_data("203", "195"), "line 74: 8 numbers where 3 are expected"),
        (edit(&text, data + 3, |line| line.replacen('.', ",", 1)), "line 52: "),
        (edit(&text, data + 3, |line| line[..65].into()), "line 52: 7 numbers where 8"),
        (
            edit(&text, reals + 13, |line| line.replace(" -", " ")),
            "line 25: the header gives the peak acceleration",
        ),
        (
            edit(&text, reals + 13, |line| line.replace("1.", "9.")),
            "line 25: the header gives the peak acceleration",
        ),
        (edit(&text, data + 26, |line| format!("{line}\n{line}")), "line 76: "),
        (text.replace("End-of-data", "Ende"), "'End-of-data'"),
        (
            edit(&text, 1, |line| line.replace("13 text", "xx text")),
            "line 1: a first line with '(Format v",
        ),
    ]);
}

#[test]
fn csmip() {
    let text = write::csmip(&[("90 Deg", 60.0), ("360 Deg", 80.0)]).replace("\r\n", "\n");
    let data = line_of(&text, "points of accel");
    let at_data = |from: &str, to: &str| edit(&text, data, |line| line.replace(from, to));
    let peak = line_of(&text, "Peak acceleration");
    refused(&[
        (cut(&text, 12), "line 13: '... points of accel data equally spaced"),
        (
            cut(&text, data),
            "line 46: the acceleration samples end after 0 values where line 46 announces 203",
        ),
        (cut(&text, data + 10), "line 56: the acceleration samples end after 80 values"),
        (without(&text, data + 5), "line 71: 3 numbers where 8 are expected"),
        (edit(&text, data + 5, |line| line.replacen('.', "o", 1)), "line 51: "),
        (edit(&text, data + 5, |line| line[..72].into()), "line 51: "),
        (
            edit(&text, data + 5, |_| "       NaN".repeat(8)),
            "line 51: 'NaN' is not a finite number",
        ),
        (edit(&text, data + 5, |_| "**********".repeat(8)), "line 51: '**********"),
        (at_data("203", "203x"), "line 46: '... points of accel"),
        (at_data("203", "195"), "line 71: 8 numbers where 3 are expected"),
        (at_data("cm/sec2.", "volts."), "line 46: the unit 'volts'"),
        (at_data("(8f10.4)", ""), "line 46: '... points of accel"),
        (at_data(".020 sec", "xx sec"), "line 46: '... points of accel"),
        (at_data(".020 sec", ".010 sec"), "line 18: the header gives the peak acceleration"),
        (
            edit(&text, peak, |line| line.replace("= ", "= 1")),
            "line 18: the header gives the peak acceleration",
        ),
        (
            edit(&text, peak + 1, |line| line.replace("at  ", "at 1")),
            "line 19: the header gives the peak velocity",
        ),
        (text.replace("/&", "??"), "'/&', the end of the channel"),
        (
            "Uncorrected Accelerogram Data\n 203 Accelerogram points at 200 pts/sec in units of g \
                . Format: (8f9.6)\n"
                .into(),
            "line 2: an uncorrected CSMIP file (.V1); fetch the corrected one",
        ),
    ]);
}

#[test]
fn knet() {
    let text = write::knet("N-S");
    let change = |from: &str, to: &str| text.replace(from, to);
    refused(&[
        (cut(&text, 14), "line 15: 'Memo.', the last line of the header"),
        (cut(&text, 17), "the samples end after 0 values where line 12 announces 200"),
        (cut(&text, 28), "line 28: the samples end after 88 values where line 12 announces 200"),
        (cut(&text, 41), "line 41: the samples end after 192 values where line 12 announces 200"),
        (change("Memo.", ""), "'Memo.'"),
        (change("100Hz", "Hz"), "line 11: 'Sampling Freq(Hz)' and a number"),
        (change("100Hz", "-100Hz"), "line 11: 'Sampling Freq(Hz)' and a number"),
        (
            change("3920(gal)/6182761", "3920/6182761"),
            "line 14: 'Scale Factor' as in 3920(gal)/6182761",
        ),
        (change("/6182761", "/0"), "line 14: 'Scale Factor'"),
        (change("3920(gal)", "2000(gal)"), "line 15: the header gives the peak acceleration as"),
        (without(&text, 14), "line 16: 'Scale Factor'"),
        (without(&text, 15), "line 16: 'Max. Acc. (gal)'"),
        (
            change("Max. Acc. (gal)   ", "Max. Acc. (gal)   1"),
            "line 15: the header gives the peak acceleration as 1",
        ),
        (change("Duration Time(s)  2", "Duration Time(s)  20"), "where line 12 announces 2000"),
        (edit(&text, 20, |line| line[..50].into()), "line 20: 6 numbers where 8 are expected"),
        (edit(&text, 20, |line| line.replacen('8', "8.", 1)), "8.56' is not a number"),
        (edit(&text, 20, |line| format!("{line}     8000")), "line 20: 9 numbers where 8"),
        (edit(&text, 20, |_| "        end".into()), "line 20: 'end' is not a number"),
    ]);
}

#[test]
fn esm() {
    let text = write::dyna("HNE", 30.0);
    let change = |from: &str, to: &str| text.replace(from, to);
    refused(&[
        (cut(&text, 10), "'UNITS: cm/s^2' should stand here"),
        (
            cut(&text, 16),
            "line 16: the acceleration samples end after 0 values where line 9 announces 203",
        ),
        (
            cut(&text, 100),
            "line 100: the acceleration samples end after 84 values where line 9 announces 203",
        ),
        (
            change("NDATA: 203", "NDATA: 202"),
            "line 219: the end of the file, after the samples that NDATA announces",
        ),
        (change("NDATA: 203", "NDATA: many"), "line 9: 'NDATA: ' and the number of samples"),
        (change("NDATA: 203", "NDATA: "), "line 9: 'NDATA: ' and the number of samples"),
        (without(&text, 9), "'NDATA: ' and the number of samples"),
        (
            change("NDATA: 203", "NDATA: 203\nNDATA: 202"),
            "line 10: nothing else than what an earlier line says",
        ),
        (
            change("UNITS: cm/s^2", "UNITS: m/s^2"),
            "line 12: the header gives the peak acceleration as",
        ),
        (
            change("SAMPLING_INTERVAL_S: 0.020000", "SAMPLING_INTERVAL_S: 0"),
            "line 8: 'SAMPLING_INTERVAL_S: ' and seconds",
        ),
        (change("UNITS: cm/s^2", "UNITS: counts"), "line 11: the unit 'counts'"),
        (change("DATA_TYPE: ACCELERATION", "DATA_TYPE: VELOCITY"), "speaks of velocity"),
        (
            change("DATA_TYPE: ACCELERATION", "DATA_TYPE: ACCELERATION RESPONSE SPECTRUM"),
            "speaks of a spectrum",
        ),
        (change("PGA_CM/S^2: ", "PGA_CM/S^2: 1"), "line 12: "),
        (change("PGA_CM/S^2: ", "PGA_CM/S^2: x"), "line 12: a number, or nothing"),
        (
            change("TIME_PGA_S: ", "TIME_PGA_S: 1"),
            "line 12: the header gives the peak acceleration",
        ),
        (edit(&text, 50, |_| "x".into()), "line 50: the acceleration samples end after 33"),
        (edit(&text, 50, |_| "0.1 0.2".into()), "line 50: 2 numbers where 1"),
        (edit(&text, 50, |_| "0,1".into()), "line 50: '0,1' is not a number"),
        (edit(&text, 50, |_| "inf".into()), "line 50: 'inf' is not a finite number"),
    ]);
}
