//! The crate speaks to who types commands: its words for who writes Python.

/// An option of the program, and the argument that is the same in Python; none where Python has
/// nothing like it.
const OPTIONS: [(&str, &str); 23] = [
    ("that `tune run` wrote", "that Tuned.save wrote"),
    ("as `tune run` writes it", "as Tuned.save writes it"),
    (
        "--units g, m/s2, cm/s2, mm/s2, mg, %g, ft/s2, in/s2 or mGal",
        "units=\"g\", \"m/s2\", \"cm/s2\", \"mm/s2\", \"mg\", \"%g\", \"ft/s2\", \"in/s2\" or \
         \"mGal\"",
    ),
    ("--units cm/s2, in m/s2 --units m/s2", "units=\"cm/s2\", in m/s2 units=\"m/s2\""),
    ("--vertical auto (vertical = \"auto\" in [record])", "vertical=\"auto\""),
    ("--vertical auto", "vertical=\"auto\""),
    ("--column, a number or a name", "column=, a number or a name"),
    ("--dt SECONDS", "dt=seconds"),
    ("--duration, duration_s", "duration="),
    ("max_omega_hz (--max-hz)", "max_hz"),
    ("--work 10", "a method that takes less"),
    ("--time-limit", "a time limit"),
    ("--baseline", "baseline=True"),
    ("; in a case file column in [record])", ")"),
    ("--parameters", "read_parameters"),
    ("--out", "another folder"),
    ("--verbose", ".lines"),
    ("tuning.max_settlement_m", "max_settlement"),
    ("tuning.max_omega_hz", "max_hz"),
    ("tuning.accuracy", "accuracy"),
    ("tuning.peaks", "peaks"),
    ("judge by many: tune init sweep", "judge by many: groundspring.rocking"),
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

/// A message with the arguments and functions of Python in it. Names of files and records, which
/// are the user's, stay as they are: an option is a word of its own, and not one in `names`.
pub fn in_python(text: &str, names: &[&str]) -> String {
    let mut said = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((at, name)) = first_name(rest, names) {
        said += &in_words(&rest[..at]);
        said += name;
        rest = &rest[at + name.len()..];
    }
    said + &in_words(rest)
}

/// The first name that stands in the text, the longest of those that begin there.
fn first_name<'a>(text: &str, names: &[&'a str]) -> Option<(usize, &'a str)> {
    let found = names.iter().filter(|name| !name.is_empty()).filter_map(|name| {
        let at = text.match_indices(*name).map(|(at, _)| at);
        at.filter(|at| stands_alone(text, *at, name.len())).map(|at| (at, *name)).next()
    });
    found.min_by_key(|(at, name)| (*at, usize::MAX - name.len()))
}

/// Whether no letter, digit or sign of a file's name touches a piece of the text.
fn stands_alone(text: &str, at: usize, length: usize) -> bool {
    let of_a_name =
        |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.' | '/' | '\\' | '~');
    let mut after = text[at + length..].chars();
    // a point or a dash may end what is said
    let goes_on = match after.next() {
        Some('.' | '-' | '/') => after.next().is_some_and(of_a_name),
        next => next.is_some_and(of_a_name),
    };
    !text[..at].ends_with(of_a_name) && !goes_on
}

/// What is said, without names.
fn in_words(text: &str) -> String {
    let mut said = text.to_owned();
    for (theirs, ours) in OPTIONS.into_iter().chain(COMMANDS) {
        let places: Vec<usize> = said
            .match_indices(theirs)
            .map(|(at, _)| at)
            .filter(|at| stands_alone(&said, *at, theirs.len()))
            .collect();
        for at in places.into_iter().rev() {
            said.replace_range(at..at + theirs.len(), ours);
        }
    }
    other_options(&said)
}

/// What is left of options has the argument's name; a number after it goes on without a space.
fn other_options(said: &str) -> String {
    let mut words = String::with_capacity(said.len());
    let mut rest = said;
    while let Some(at) = rest.find("--") {
        let after = &rest[at + 2..];
        let end =
            after.find(|c: char| !(c.is_ascii_lowercase() || c == '-')).unwrap_or(after.len());
        let name = after[..end].trim_end_matches('-');
        words.push_str(&rest[..at]);
        let begins = name.starts_with(|c: char| c.is_ascii_lowercase());
        if begins && stands_alone(rest, at, 2 + name.len()) {
            words.push_str(&name.replace('-', "_"));
            words.push('=');
            rest = &after[name.len()..];
            let value = rest.strip_prefix(' ');
            rest = value.filter(|v| v.starts_with(|c: char| c.is_ascii_digit())).unwrap_or(rest);
        } else {
            words.push_str("--");
            rest = after;
        }
    }
    words + rest
}
