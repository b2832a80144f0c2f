//! What TOML refuses, in words of a case file.

use files::message::one_line;

/// A line whose value is of another type or none of those known, by serde's message: what it has,
/// and what to write instead.
pub(super) fn in_plain_words(message: &str, line: &str) -> Option<String> {
    let (key, value) = line.split_once('=')?;
    let (key, value) = (one_line(key.trim()), without_comment(value));
    if let Some(variant) = message.strip_prefix("unknown variant `") {
        let (given, known) = variant.split_once("`, expected ")?;
        let known = known.trim_start_matches("one of ").replace('`', "");
        let solids = if key == "kind" { " (a cabinet, a tank, a column)" } else { "" };
        let known = known.replace("block", &format!("block{solids}"));
        return Some(format!("{key} is \"{}\"; known are {known}", one_line(given)));
    }
    if let Some((_, wanted)) = message.strip_prefix("invalid type: ")?.split_once(", expected ") {
        let wanted = match key.as_str() {
            "vertical" => "\"auto\", or the file of one in quotes".into(),
            _ => wanted_words(wanted, value),
        };
        return Some(format!("{key} is {}; write {wanted}", one_line(value)));
    }
    None
}

/// A line that is no TOML, by its message.
pub(super) fn unreadable(message: &str, line: &str) -> Option<String> {
    let Some((key, value)) = line.split_once('=') else { return of_line(message, line) };
    let (key, value) = (one_line(key.trim()), without_comment(value));
    if message.starts_with("duplicate key") {
        return Some(format!("{key} is given twice; keep one of them"));
    }
    let shown = one_line(value);
    let digits = value.trim_start_matches(['+', '-']);
    let number = |text: &str| text.parse::<f64>().ok().filter(|x| x.is_finite());
    Some(if value.is_empty() {
        format!("{key} has no value; give one, or leave the key out")
    } else if let Some(share) = value.strip_suffix('%').and_then(|text| number(text.trim())) {
        format!("{key} is {shown}; write it as a share: {}", share / 100.0)
    } else if let Some(x) = number(value) {
        let plain = if x.abs() < 1e15 { x.to_string() } else { format!("{x:e}") };
        format!("{key} is {shown}; write {plain}")
    } else if digits.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
        format!("{key} is {shown}; write a number alone, with a point: the key names its unit")
    } else if value.starts_with(['"', '\'']) {
        format!("{key} is {shown}; end the text with a quote, and write \\ as /")
    } else {
        format!(
            "{key} is {shown}; write a text in quotes: {key} = \"{}\"",
            shown.replace('\\', "/")
        )
    })
}

/// Of a line without `=`.
fn of_line(message: &str, line: &str) -> Option<String> {
    let line = line.trim();
    let name = one_line(line.trim_matches(['[', ']', ' ']));
    if !line.starts_with('[') {
        return Some(format!(
            "\"{}\" is no line of a case file; write key = value",
            one_line(line)
        ));
    }
    if message.starts_with("duplicate key") {
        return Some(format!("[{name}] is there twice; put its keys together"));
    }
    (!line.contains(']')).then(|| format!("[{name} has no end; write [{name}]"))
}

/// A value without the comment behind it: a # in quotes is part of it.
fn without_comment(value: &str) -> &str {
    let value = value.trim();
    match value.strip_prefix(['"', '\'']) {
        Some(_) => value,
        None => value.split('#').next().unwrap_or_default().trim_end(),
    }
}

/// What serde expects.
fn wanted_words(wanted: &str, given: &str) -> String {
    match wanted {
        "a whole number" => match given.parse::<f64>() {
            Ok(x) if x.fract() == 0.0 && (0.0..1e9).contains(&x) => format!("a whole number, {x}"),
            _ => "a whole number".into(),
        },
        "a number" if given.starts_with('"') => "a number, without quotes".into(),
        "a number" if given.parse::<f64>().is_ok() => "a number with a point or an exponent".into(),
        "path string" | "a string" => "a text in quotes".into(),
        "a boolean" => "true or false".into(),
        other => other.replace('`', "\""),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_toml_refuses_is_told_by_the_key() {
        let told = |line: &str| {
            let error = line.parse::<toml::Table>().unwrap_err();
            unreadable(error.message().lines().next().unwrap_or_default(), line).unwrap()
        };
        for (line, words) in [
            ("width_m = .5", "width_m is .5; write 0.5"),
            ("mass_kg = 05 # t", "mass_kg is 05; write 5"),
            ("damping_ratio = 2%", "damping_ratio is 2%; write it as a share: 0.02"),
            (
                "width_m = 2 m",
                "width_m is 2 m; write a number alone, with a point: the key names its unit",
            ),
            ("kind = block", "kind is block; write a text in quotes: kind = \"block\""),
            ("width_m =", "width_m has no value; give one, or leave the key out"),
            ("kind = \"block", "kind is \"block; end the text with a quote, and write \\ as /"),
            ("kind: 3", "\"kind: 3\" is no line of a case file; write key = value"),
            ("[structure", "[structure has no end; write [structure]"),
        ] {
            assert_eq!(told(line), words);
        }
        let twice = unreadable("duplicate key", "a = 2");
        assert_eq!(twice.unwrap(), "a is given twice; keep one of them");
    }

    #[test]
    fn a_value_of_another_type_is_told_with_what_is_wanted() {
        let told = |message: &str, line: &str| in_plain_words(message, line).unwrap();
        assert_eq!(
            told("invalid type: string \"2\", expected a number", "scale = \"2\""),
            "scale is \"2\"; write a number, without quotes"
        );
        assert_eq!(
            told("invalid type: boolean `true`, expected path string", "vertical = true"),
            "vertical is true; write \"auto\", or the file of one in quotes"
        );
        assert_eq!(
            told("invalid type: floating point `4.0`, expected a whole number", "elements = 4.0"),
            "elements is 4.0; write a whole number, 4"
        );
        assert_eq!(
            told("unknown variant `column`, expected `aframe` or `block`", "kind = \"column\""),
            "kind is \"column\"; known are aframe or block (a cabinet, a tank, a column)"
        );
    }
}
