//! What `tune run` prints: one screen, the answer first.

use super::{FiledParameters, Run, Table, Unit, force_value, height, peak_table, sentence};
use files::message::{shortened, significant};
use springs::results::{DesignForce, DesignForces, FiledFinding, Finding, ForceName, Weight};

/// Lines of a screen, and letters of a line.
pub(crate) const LINES: usize = 30;
pub(crate) const WIDTH: usize = 98;
/// Lines that one warning may take, and on a crowded screen.
const LONGEST_WARNING: usize = 3;
const LONGEST_OF_MANY: usize = 2;
/// Lines of the design forces.
const MOST_FORCE_LINES: usize = 3;

/// What is said where no springs suit steps of one size.
pub(crate) const NO_PROGRAM: &str = "not these springs: programs with steps of one size need others; there are none for this structure";
/// Letters of a file's name in the line of the record.
const LONGEST_NAME: usize = 48;

/// Where results are, for the commands that the screen ends with.
pub struct Written<'a> {
    /// The folder.
    pub folder: &'a str,
    /// Whether report.html was written.
    pub report: bool,
    /// Whether decks were.
    pub decks: bool,
}

/// The screen: at most `LINES` lines of at most `WIDTH` letters.
pub fn screen(run: &Run, written: &Written) -> String {
    let mut lines = Vec::new();
    taken(run, written, &mut lines);
    lines.push(String::new());
    wrap(&mut lines, "", &run.verdict());
    lines.extend(peak_table(run).iter().flat_map(Table::lines));
    forces(run, &mut lines);
    springs(run, &mut lines);
    if let Some(accuracy) = &run.accuracy {
        at_most(2, &mut lines, "accuracy  ", &accuracy.short());
    }
    next(run, written, &mut lines);
    // a crowded screen needs the room of the empty line
    let warns = run.remarks().any(|finding| finding.weight >= Weight::Warning);
    if lines.len() + usize::from(warns) > LINES {
        lines.retain(|line| !line.is_empty());
    }
    warnings(run, written, &mut lines);
    lines.join("\n") + "\n"
}

/// The same as [`wrap`], in so many lines: what does not fit is left out.
fn at_most(most: usize, lines: &mut Vec<String>, name: &str, text: &str) {
    let mut all = Vec::new();
    wrap(&mut all, name, text);
    if all.len() > most {
        all.truncate(most);
        if let Some(last) = all.last_mut() {
            let kept: String = last.chars().take(WIDTH - 4).collect();
            *last = format!("{} ...", kept.trim_end());
        }
    }
    lines.extend(all);
}

/// Text behind a name, its further lines below the text; words that do not fit a line are shortened
/// in the middle.
fn wrap(lines: &mut Vec<String>, name: &str, text: &str) {
    let indent = name.chars().count();
    let mut line = name.to_string();
    let mut empty = true;
    for word in text.split(' ') {
        let word = shortened(word, WIDTH - indent);
        let room = line.chars().count() + usize::from(!empty) + word.chars().count() <= WIDTH;
        if !room {
            lines.push(std::mem::replace(&mut line, " ".repeat(indent)));
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line.push_str(&word);
        empty = false;
    }
    lines.push(line);
}

fn taken(run: &Run, written: &Written, lines: &mut Vec<String>) {
    let fact = |name: &str| {
        run.taken.facts.iter().find(|(fact, _)| fact.starts_with(name)).map(|(_, value)| value)
    };
    let first = fact("first lifts").map_or(String::new(), |time| format!(", first at {time}"));
    let lifts = fact("lifts").map_or(String::new(), |value| format!("; lifts at {value}{first}"));
    at_most(2, lines, "", &format!("{}{lifts}", run.taken.structure));
    if let Some(record) = &run.taken.record {
        let short: Vec<String> =
            record.split(' ').map(|word| shortened(word, LONGEST_NAME)).collect();
        at_most(2, lines, "", &short.join(" "));
    }
    let all: Vec<String> =
        run.taken.assumed.iter().map(|a| format!("{} ({})", a.what, a.key)).collect();
    let place = if written.report { "report.html" } else { "--verbose" };
    // as many as two lines hold
    for shown in (1..=all.len()).rev() {
        let rest = match all.len() - shown {
            0 => String::new(),
            n => format!("; and {n} more: {place}"),
        };
        let mut some = Vec::new();
        wrap(&mut some, "assumed: ", &(all[..shown].join("; ") + &rest));
        if some.len() <= 2 || shown == 1 {
            lines.extend(some);
            break;
        }
    }
}

fn forces(run: &Run, lines: &mut Vec<String>) {
    let Some(forces) = &run.design_forces else { return };
    // an asterisk where some are, a word where all are
    let doubted = |one: (ForceName, DesignForce)| one.1.holds && !run.foretells(one);
    let [some, every] = [forces.all().any(doubted), forces.all().all(|one| !run.foretells(one))];
    let mark = if some && !every { "*" } else { "" };
    let below = match forces.below_hz {
        Some(hz) => Some(format!("below {} Hz", significant(hz, 3))),
        None => {
            matches!(run.parameters, FiledParameters::Rigid(_)).then(|| "between impacts".into())
        }
    };
    let doubt = some.then(|| format!("{mark} not foretold").trim_start().to_string());
    let of: Vec<String> = below.into_iter().chain(doubt).collect();
    let of = if of.is_empty() { String::new() } else { format!(" ({})", of.join("; ")) };
    let name = format!("design forces{of}  ");
    let all = force_words(forces, |force| if doubted(force) { mark } else { "" });
    // as many as three lines hold
    for shown in (1..=all.len()).rev() {
        let rest = if shown < all.len() { "; more in the report" } else { "" };
        let mut some = Vec::new();
        wrap(&mut some, &name, &(all[..shown].join("; ") + rest));
        if some.len() <= MOST_FORCE_LINES || shown == 1 {
            lines.extend(some);
            break;
        }
    }
}

/// The forces in words, each with its mark; those withheld are named.
fn force_words<'a>(
    forces: &DesignForces,
    mark: impl Fn((ForceName, DesignForce)) -> &'a str,
) -> Vec<String> {
    // magnitudes: signs are in the report
    let magnitude = |force: DesignForce| DesignForce { value: force.value.map(f64::abs), ..force };
    let cell = |(name, force): (ForceName, DesignForce)| {
        let mark = mark((name, force));
        format!("{} {}{mark}{}", name.words(), force_value(name, &magnitude(force)), height(&force))
    };
    // the report has the vertical force, too
    forces.all().filter(|(name, _)| *name != ForceName::SoleVertical).map(cell).collect()
}

fn springs(run: &Run, lines: &mut Vec<String>) {
    const SHOWN: usize = 2;
    const SAID: &str = "  numerical contact stiffness, not soil";
    let of = format!("springs {}", run.springs_at.replace("each", "per"));
    let mut table = Table::new([of.as_str(), "k1 [N/m]", "k2 [N/m]", "m2 [kg]", "c [N s/m]"]);
    let steps = run.program.as_ref().map(|program| format!("{} steps", program.steps));
    let mut add = |of: Option<&str>, units: &[Unit]| {
        for unit in units.iter().take(SHOWN) {
            let cells = [unit.k1_n_per_m, unit.k2_n_per_m, unit.m2_kg, unit.c_ns_per_m]
                .map(|x| significant(x, 4));
            let name = of.map_or(format!("  {}", unit.name), |of| format!("  {of}: {}", unit.name));
            table.rows.push([vec![name], cells.into()].concat());
        }
    };
    add(steps.as_ref().map(|_| "OpenSees deck"), &run.springs);
    run.program.iter().for_each(|program| add(steps.as_deref(), &program.units));
    let mut all = table.lines();
    let note = match run.springs.len() {
        n if n > SHOWN => format!("{SAID}; {} more units: parameters.json", n - SHOWN),
        _ => SAID.to_string(),
    };
    if let Some(head) = all.first_mut() {
        if head.chars().count() + note.chars().count() <= WIDTH {
            head.push_str(&note);
        } else if head.chars().count() + SAID.chars().count() / 2 <= WIDTH
            && run.springs.len() <= SHOWN
        {
            head.push_str("  numerical, not soil");
        } else {
            all.push(note);
        }
    }
    lines.extend(all);
}

fn next(run: &Run, written: &Written, lines: &mut Vec<String>) {
    let folder = written.folder.trim_end_matches('/');
    let file = |name: &str| shortened(&format!("{folder}/{name}"), 58);
    if written.decks {
        let commands = [
            format!("python3 {};", file("decks/model_openseespy.py")),
            format!("tune verify --parameters {}", file("parameters.json")),
        ];
        // on one line, if both fit
        if commands.iter().map(|command| command.chars().count() + 1).sum::<usize>() < WIDTH - 10 {
            wrap(lines, "OpenSees  ", &commands.join(" "));
        } else {
            wrap(lines, "OpenSees  ", commands[0].trim_end_matches(';'));
            wrap(lines, "check it  ", &commands[1]);
        }
    }
    match &run.program {
        Some(program) => at_most(3, lines, &format!("{:10}", program.short()), &program.line()),
        None => wrap(lines, "SAP2000   ", NO_PROGRAM),
    }
    if written.report {
        wrap(lines, "report    ", &file("report.html"));
    }
}

/// What changes a design the most is told first.
fn urgency(finding: &Finding) -> usize {
    match finding {
        Finding::IllConditioned { .. } => 0,
        Finding::Doubt { .. } => 1,
        Finding::VerticalLeftOut { .. } => 2,
        Finding::ForcesHeldInPart { .. } => 3,
        Finding::FeetApart { .. } => 5,
        _ => 4,
    }
}

fn warnings(run: &Run, written: &Written, lines: &mut Vec<String>) {
    let mut all: Vec<_> =
        run.remarks().filter(|finding| finding.weight >= Weight::Warning).collect();
    all.sort_by_key(|filed| (std::cmp::Reverse(filed.weight), urgency(&filed.finding)));
    let words = |filed: &FiledFinding| {
        let remedy =
            filed.remedy.as_ref().map_or(String::new(), |remedy| format!(" {}", sentence(remedy)));
        format!("{}{remedy}", sentence(&filed.message))
    };
    let taken = |filed: &&FiledFinding| {
        let mut some = Vec::new();
        at_most(LONGEST_WARNING, &mut some, "warning   ", &words(filed));
        some.len()
    };
    let room = LINES.saturating_sub(lines.len());
    let longest =
        if all.iter().map(taken).sum::<usize>() > room { LONGEST_OF_MANY } else { LONGEST_WARNING };
    let place = if written.report { "report.html" } else { "parameters.json" };
    let mut told = 0;
    for finding in &all {
        // a line is kept for those that do not fit, if there is more than one
        let room = LINES.saturating_sub(lines.len());
        let rest = usize::from(told + 1 < all.len());
        if room <= rest {
            break;
        }
        at_most((room - rest).min(longest), lines, "warning   ", &words(finding));
        told += 1;
    }
    let more = all.len() - told;
    if more > 0 && lines.len() < LINES {
        lines.push(format!("warning   and {more} more: {place}"));
    }
}
