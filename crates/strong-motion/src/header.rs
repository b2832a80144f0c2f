//! What the words of a free header say of the numbers below them: a quantity that is not
//! acceleration, a time step.

use super::text::{number, precision};
use super::units::{self, normalised, occurrences};

/// Samples of a digitiser, no acceleration.
pub(super) const COUNTS: &str = "counts";
const SPECTRUM: &str = "a spectrum";
const VELOCITY: &str = "velocity";
const DISPLACEMENT: &str = "displacement";

pub(super) fn is_comment(line: &str) -> bool {
    line.starts_with(['#', '%', '!']) || line.starts_with("//")
}

/// What a header speaks of, when that is not acceleration: by the names of its columns, its lines
/// about the time series or its unit, or any line where none names acceleration.
pub(super) fn quantity(header: &[(usize, &str)], names: &[&str]) -> Option<&'static str> {
    by_names(names).or_else(|| by_words(header))
}

fn by_names(names: &[&str]) -> Option<&'static str> {
    let (first, last) = (names.first()?, names.last()?);
    if units::declared(&[], Some(last)).is_some() {
        // PSA [g] over a period is in the unit of an acceleration
        return (names.len() > 1 && is_abscissa_of_spectrum(first) || is_ordinate(last))
            .then_some(SPECTRUM);
    }
    let word = first_word(last);
    match () {
        () if names.len() > 1 && is_abscissa_of_spectrum(first) || is_ordinate(last) => {
            Some(SPECTRUM)
        }
        () if word.starts_with("count") => Some(COUNTS),
        () if word.starts_with("acc") => None,
        () if word.starts_with("vel") || word == "v" || has_unit(last, &VELOCITY_UNITS) => {
            Some(VELOCITY)
        }
        () if word.starts_with("dis") || in_brackets(last, &["m", "cm", "mm", "in"]) => {
            Some(DISPLACEMENT)
        }
        () => None,
    }
}

fn first_word(name: &str) -> String {
    name.to_ascii_lowercase()
        .split(|c: char| !c.is_ascii_alphanumeric())
        .find(|w| !w.is_empty())
        .unwrap_or("")
        .to_owned()
}

/// Whether a column's name says that it holds times.
pub(super) fn is_time(name: &str) -> bool {
    let word = first_word(name);
    word == "t" || word.starts_with("time") || word.starts_with("zeit")
}

/// The unit of a column of times.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum TimeUnit<'a> {
    Seconds,
    Milliseconds,
    /// As the header has it.
    Other(&'a str),
}

impl<'a> TimeUnit<'a> {
    /// Of a word that names one.
    fn named(word: &'a str) -> Option<Self> {
        let lower = word.trim_end_matches('.').to_lowercase();
        let other =
            ["min", "mins", "h", "hr", "hrs", "us", "usec", "\u{b5}s", "\u{3bc}s", "ns", "d"];
        match lower.as_str() {
            "s" | "sec" | "secs" | "sek" | "seg" => Some(Self::Seconds),
            "ms" | "msec" | "msecs" => Some(Self::Milliseconds),
            _ if lower.starts_with("second") || lower.starts_with("sekund") => Some(Self::Seconds),
            _ if lower.starts_with("millis") => Some(Self::Milliseconds),
            _ if other.contains(&lower.as_str())
                || ["minute", "hour", "day", "micros", "nanos"]
                    .iter()
                    .any(|name| lower.starts_with(name)) =>
            {
                Some(Self::Other(word))
            }
            _ => None,
        }
    }

    /// Of a column's name, or of a line of names that begins with it: `time (ms)`, `t_ms`, `[ms]`.
    /// None where it names none.
    pub(super) fn of(name: &'a str) -> Option<Self> {
        let name = name.trim_start_matches(|c: char| !c.is_alphanumeric());
        let end = name.find(|c: char| !c.is_alphanumeric()).unwrap_or(name.len());
        let (first, rest) = name.split_at(end);
        if !is_time(first) {
            // the line below the names holds the units
            let alone = !rest.contains(char::is_alphanumeric);
            return Self::named(first).filter(|_| alone);
        }
        let rest = rest.trim_start();
        let Some(inside) = rest.strip_prefix(['[', '(']) else {
            let rest = rest.trim_start_matches(|c: char| !c.is_alphanumeric());
            let rest = rest.strip_prefix("in ").unwrap_or(rest);
            return rest.split(|c: char| !c.is_alphanumeric()).next().and_then(Self::named);
        };
        let inside = inside.split([']', ')']).next().unwrap_or(inside).trim();
        // "(from the trigger)" is no unit
        let word = inside.split_whitespace().next()?;
        Self::named(word).or_else(|| (word == inside).then_some(Self::Other(inside)))
    }
}

fn is_abscissa_of_spectrum(name: &str) -> bool {
    let word = first_word(name);
    word.starts_with("period")
        || word.starts_with("freq")
        || word == "f"
        || name.to_ascii_lowercase().contains("hz")
}

fn is_ordinate(name: &str) -> bool {
    ["sa", "psa", "sv", "psv", "sd", "spectral", "fas", "fourier"]
        .contains(&first_word(name).as_str())
}

const VELOCITY_UNITS: [&str; 6] = ["m/s", "cm/s", "mm/s", "in/s", "ft/s", "km/h"];

/// Whether a text names one of the units, and not that unit by second.
fn has_unit(text: &str, names: &[&str]) -> bool {
    let text = normalised(text);
    names.iter().any(|name| occurrences(&text, name).any(|(_, after)| !after.starts_with('/')))
}

fn in_brackets(name: &str, names: &[&str]) -> bool {
    let inside = name
        .split_once(['[', '('])
        .and_then(|(_, rest)| rest.split_once([']', ')']))
        .map(|(unit, _)| unit);
    inside.is_some_and(|unit| names.contains(&unit.trim().to_ascii_lowercase().as_str()))
}

fn by_words(header: &[(usize, &str)]) -> Option<&'static str> {
    let lower: Vec<String> = header.iter().map(|(_, line)| line.to_ascii_lowercase()).collect();
    let any =
        |words: &[&str]| lower.iter().any(|line| words.iter().any(|word| line.contains(word)));
    if any(&["response spectrum", "spectral accel", "fourier spectrum", "fourier ampl"])
        && !any(&["match", "compatible", "accelerogram", "time history", "time series"])
    {
        return Some(SPECTRUM);
    }
    let about =
        |line: &&String| ["unit", "series", "history"].iter().any(|word| line.contains(word));
    let about: Vec<&String> = lower.iter().filter(about).collect();
    let said = [VELOCITY, DISPLACEMENT].into_iter().find(|word| {
        let only = lower.iter().any(|line| line.contains(word)) && !any(&["acc"]);
        only || about.iter().any(|line| line.contains(word))
            && !about.iter().any(|line| line.contains("acc"))
    });
    // "units: cm/s" and no word of what it is the unit of
    let unit_lines = || lower.iter().filter(|line| line.contains("unit"));
    said.or_else(|| unit_lines().any(|line| has_unit(line, &VELOCITY_UNITS)).then_some(VELOCITY))
        .or_else(|| {
            let counts = unit_lines().any(|line| line.contains("count"))
                && units::declared(header, None).is_none();
            counts.then_some(COUNTS)
        })
}

/// The time step in a header line such as `# dt = 0.01 s`, `SAMPLING_INTERVAL_S: 0.005`, and half
/// its last digit.
pub(super) fn step_in(line: &str) -> Option<(f64, f64)> {
    let lower = line.to_ascii_lowercase();
    let is_word = |at: usize, name: &str| {
        !lower[..at].ends_with(|c: char| c.is_alphanumeric())
            && !lower[at + name.len()..].starts_with(|c: char| c.is_alphanumeric())
    };
    let after =
        ["dt", "delta_t", "sampling_interval_s", "sampling interval", "time step", "timestep"]
            .into_iter()
            .find_map(|name| {
                lower
                    .match_indices(name)
                    .find(|&(at, _)| is_word(at, name))
                    .map(|(at, _)| &lower[at + name.len()..])
            })?;
    let mut tokens = after
        .split(|c: char| {
            c.is_whitespace() || matches!(c, '=' | ':' | ',' | ';' | '(' | ')' | '[' | ']')
        })
        .filter(|token| !token.is_empty());
    let first = tokens.next()?;
    let token = first.trim_end_matches(|c: char| c.is_alphabetic());
    let unit = if token == first { tokens.next().unwrap_or("") } else { &first[token.len()..] };
    let factor = match TimeUnit::named(unit) {
        None | Some(TimeUnit::Seconds) => 1.0,
        Some(TimeUnit::Milliseconds) => 1e-3,
        Some(TimeUnit::Other(_)) => return None,
    };
    let dt = number(token).filter(|dt| dt.is_finite() && *dt > 0.0)?;
    Some((dt * factor, 0.5 * factor * 10_f64.powi(precision(token).0)))
}

/// The time step of a rate such as `sampled at 200 Hz`, `sampling rate: 200 Hz`, and half the last
/// digit of the rate, as a step.
pub(super) fn rate_in(line: &str) -> Option<(f64, f64)> {
    let lower = line.to_ascii_lowercase();
    let words = ["sampled at", "sampling rate", "sampling frequency", "sample rate"];
    let after = words.iter().find_map(|word| lower.split_once(word).map(|(_, after)| after))?;
    let after = after.trim_start_matches([' ', ':', '=', '\t']);
    let end = after.find(|c: char| !(c.is_ascii_digit() || c == '.')).unwrap_or(after.len());
    let (rate, unit) = after.split_at(end);
    if !unit.trim_start().starts_with("hz") {
        return None;
    }
    let hertz = number(rate).filter(|rate| rate.is_finite() && *rate > 0.0)?;
    Some((1.0 / hertz, 0.5 * 10_f64.powi(precision(rate).0) / hertz.powi(2)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_columns_tell_what_is_no_acceleration() {
        for (names, expected) in [
            ("t [s],a [g]", None),
            ("time,acceleration", None),
            ("t,acc", None),
            ("t [s],v [m/s]", Some(VELOCITY)),
            ("time,velocity", Some(VELOCITY)),
            ("t,x [cm/s]", Some(VELOCITY)),
            ("t,x [cm/s/s]", None),
            ("t,x [cm/sec**2]", None),
            ("t [s],d [cm]", Some(DISPLACEMENT)),
            ("t,displ", Some(DISPLACEMENT)),
            ("Period (s),PSA (g)", Some(SPECTRUM)),
            ("T (s),Sa (g)", Some(SPECTRUM)),
            ("Frequency [Hz],amplitude", Some(SPECTRUM)),
            ("t,counts", Some(COUNTS)),
        ] {
            let names: Vec<&str> = names.split(',').collect();
            assert_eq!(by_names(&names), expected, "{names:?}");
        }
    }

    #[test]
    fn lines_of_words_tell_it_too() {
        for (line, expected) in [
            ("units: cm/s", Some(VELOCITY)),
            ("units: cm/s^2", None),
            ("units: cm/sec/sec", None),
            ("VELOCITY TIME SERIES IN UNITS OF CM/S", Some(VELOCITY)),
            ("Displacement in cm", Some(DISPLACEMENT)),
            ("5 % damped response spectrum", Some(SPECTRUM)),
            ("accelerogram compatible with the response spectrum of EC8", None),
            ("unit: counts", Some(COUNTS)),
            ("counts converted to units of m/s2", None),
        ] {
            assert_eq!(quantity(&[(1, line)], &[]), expected, "{line}");
        }
    }

    #[test]
    fn time_steps_are_found_in_header_lines() {
        assert_eq!(step_in("# dt = 0.01 s"), Some((0.01, 0.005)));
        assert_eq!(step_in("SAMPLING_INTERVAL_S: 0.005000"), Some((0.005, 0.5e-6)));
        assert_eq!(step_in("# width 3, dt=.02sec"), Some((0.02, 0.005)));
        assert_eq!(step_in("# t, a"), None);
        assert_eq!(step_in("# dt unknown"), None);
        assert_eq!(step_in("# dt = 5 ms"), Some((0.005, 0.5e-3)));
        assert_eq!(step_in("# dt = 5ms"), Some((0.005, 0.5e-3)));
        assert_eq!(step_in("# dt = 0.5 min"), None);
        assert_eq!(rate_in("# sampled at 200 Hz"), Some((0.005, 0.5 / 4e4)));
        assert_eq!(rate_in("Sampling rate: 100.0 Hz"), Some((0.01, 0.05 / 1e4)));
        for line in ["# low pass at 50 Hz", "sampling rate 200", "sampled at Hz", "t (s)"] {
            assert_eq!(rate_in(line), None, "{line}");
        }
    }

    #[test]
    fn names_of_columns_tell_the_unit_of_times() {
        use TimeUnit::{Milliseconds as Ms, Other, Seconds as S};
        for (name, unit) in [
            ("time (ms)", Some(Ms)),
            ("t [ms]", Some(Ms)),
            ("Time [msec]", Some(Ms)),
            ("time_ms", Some(Ms)),
            ("Time(milliseconds)   acc (g)", Some(Ms)),
            ("time in ms", Some(Ms)),
            ("[ms]", Some(Ms)),
            ("t [s]", Some(S)),
            ("Time (sec.)", Some(S)),
            ("time_s", Some(S)),
            ("t, s", Some(S)),
            ("time (min)", Some(Other("min"))),
            ("t [h]", Some(Other("h"))),
            ("time [samples]", Some(Other("samples"))),
            ("time (from the trigger)", None),
            ("time", None),
            ("t", None),
            ("time   acc (g)", None),
            ("acc [m/s2]", None),
            ("ms-1", None),
        ] {
            assert_eq!(TimeUnit::of(name), unit, "{name}");
        }
    }
}
