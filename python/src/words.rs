//! The crate speaks to who types commands: its words for who writes Python.

/// An option of the program, and the argument that is the same in Python; none where Python has
/// nothing like it.
const OPTIONS: [(&str, &str); 22] = [
    ("that `tune run` wrote", "that Tuned.save wrote"),
    ("as `tune run` writes it", "as Tuned.save writes it"),
    ("--units g, m/s2 or cm/s2", "units=\"g\", \"m/s2\" or \"cm/s2\""),
    ("--units cm/s2, in m/s2 --units m/s2", "units=\"cm/s2\", in m/s2 units=\"m/s2\""),
    ("--vertical auto (vertical = \"auto\" in [record])", "vertical=\"auto\""),
    ("--vertical auto", "vertical=\"auto\""),
    ("--column, a number or a name", "component=\"column 3\" or its name"),
    ("--dt SECONDS", "dt=seconds"),
    ("--duration, duration_s", "duration="),
    ("max_omega_hz (--max-hz)", "max_hz"),
    ("--max-hz", "max_hz="),
    ("--work 10", "a method that takes less"),
    ("--time-limit", "a time limit"),
    ("--baseline", "baseline=True"),
    ("--component", "component="),
    ("--column", "component=\"column 3\""),
    ("--parameters", "read_parameters"),
    ("--out", "another folder"),
    ("--verbose", ".lines"),
    ("tuning.max_settlement_m", "max_settlement"),
    ("tuning.", ""),
    ("objective = \"arr\"", "method=\"arr\""),
];

/// Commands of the program, and what does the same.
const COMMANDS: [(&str, &str); 9] = [
    ("tune validate", "groundspring.validate"),
    ("tune sweep", "groundspring.rocking"),
    ("tune run", "groundspring.tune"),
    ("tune housner", "groundspring.rigid_rocking"),
    ("tune simulate", "groundspring.simulate"),
    ("tune record", "groundspring.read_record"),
    ("tune verify", "the program's verify"),
    ("tune export", "Tuned.save"),
    ("tune init", "the program's init"),
];

/// A message with the arguments and functions of Python in it.
pub fn in_python(text: &str) -> String {
    let mut said = text.to_owned();
    for (theirs, ours) in OPTIONS.into_iter().chain(COMMANDS) {
        if said.contains(theirs) {
            said = said.replace(theirs, ours);
        }
    }
    // what is left of options has the argument's name
    let mut words = String::with_capacity(said.len());
    let mut rest = said.as_str();
    while let Some(at) = rest.find("--") {
        let (before, option) = rest.split_at(at);
        words.push_str(before);
        let option = &option[2..];
        let end =
            option.find(|c: char| !(c.is_ascii_lowercase() || c == '-')).unwrap_or(option.len());
        let name = option[..end].trim_end_matches('-');
        if name.is_empty() {
            words.push_str("--");
        } else {
            words.push_str(&name.replace('-', "_"));
            words.push('=');
        }
        rest = &option[name.len()..];
        // the value goes on without a space
        if let Some(value) = rest
            .strip_prefix(' ')
            .filter(|v| !name.is_empty() && v.starts_with(|c: char| c.is_ascii_digit()))
        {
            rest = value;
        }
    }
    words.push_str(rest);
    words
}
