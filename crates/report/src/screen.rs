//! What `tune run` prints: one screen, the answer first.

mod warnings;

use super::{FiledParameters, Run, Table, Unit, force_value, height, peak_table};
use files::message::{percent, shortened, significant};
use springs::results::{DesignForce, DesignForces, ForceName};
use warnings::{tell, warning_lines, warnings};

/// Lines of a screen, and letters of a line.
pub(crate) const LINES: usize = 30;
pub(crate) const WIDTH: usize = 98;
/// Further lines of the design forces begin here.
const FORCES_INDENT: usize = 15;

/// What the answer may take where warnings need room.
#[derive(Clone, Copy)]
struct Crowding {
    /// Whether an empty line stands before the verdict.
    empty_line: bool,
    /// Lines of what was assumed.
    assumed: usize,
    /// Lines of the design forces.
    forces: usize,
    /// Sets of motions that the accuracy is told on.
    measured: usize,
}

/// The first in which every warning has its room is taken, else the last.
const CROWDING: [Crowding; 3] = [
    Crowding { empty_line: true, assumed: 2, forces: 3, measured: 2 },
    Crowding { empty_line: false, assumed: 2, forces: 3, measured: 2 },
    Crowding { empty_line: false, assumed: 1, forces: 2, measured: 1 },
];

/// What is said where no springs suit steps of one size.
pub(crate) const NO_PROGRAM: &str = "not these springs: programs with steps of one size need \
    others; there are none for this structure";
/// The deck of OpenSees with steps of one size.
pub const EVEN_DECK: &str = "model_even.py";
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
    let warnings = warnings(run);
    let answers = CROWDING.map(|crowding| answer(run, written, crowding));
    let room = |lines: &Vec<String>| LINES.saturating_sub(lines.len());
    let wanted: usize = warnings.iter().map(warning_lines).sum();
    let [spacious, close, closest] = answers;
    let mut lines = if room(&spacious) >= wanted {
        spacious
    } else if room(&close) >= warnings.len() {
        close
    } else {
        closest
    };
    let place = if written.report { "report.html" } else { "parameters.json" };
    tell(&warnings, place, &mut lines);
    lines.join("\n") + "\n"
}

/// All but the warnings.
fn answer(run: &Run, written: &Written, crowding: Crowding) -> Vec<String> {
    let mut lines = Vec::new();
    taken(run, written, crowding.assumed, &mut lines);
    if crowding.empty_line {
        lines.push(String::new());
    }
    wrap(&mut lines, "", &run.verdict());
    lines.extend(peak_table(run).iter().flat_map(Table::lines));
    forces(run, crowding.forces, &mut lines);
    springs(run, &mut lines);
    if let Some(accuracy) = &run.accuracy {
        at_most(2, &mut lines, "accuracy  ", &accuracy.short(crowding.measured));
    }
    next(run, written, &mut lines);
    lines
}

/// The same as [`wrap`], in so many lines: what does not fit is left out.
fn at_most(most: usize, lines: &mut Vec<String>, name: &str, text: &str) {
    let mut all = Vec::new();
    wrap(&mut all, name, text);
    if all.len() > most {
        all.truncate(most);
        if let Some(last) = all.last_mut() {
            // whole words
            while last.chars().count() > WIDTH - 4 {
                let Some(space) = last.trim_end().rfind(' ') else { break };
                last.truncate(space);
            }
            *last = format!("{} ...", last.trim_end_matches([' ', ',', ';', ':']));
        }
    }
    lines.extend(all);
}

/// Text behind a name, its further lines below the text; words that do not fit a line are shortened
/// in the middle.
fn wrap(lines: &mut Vec<String>, name: &str, text: &str) {
    wrap_at(lines, name, name.chars().count(), text);
}

/// The same; further lines begin after so many letters.
fn wrap_at(lines: &mut Vec<String>, name: &str, indent: usize, text: &str) {
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

fn taken(run: &Run, written: &Written, most: usize, lines: &mut Vec<String>) {
    let fact = |name: &str| {
        run.taken.facts.iter().find(|(fact, _)| fact.starts_with(name)).map(|(_, value)| value)
    };
    let first = fact("first lifts").map_or(String::new(), |time| format!(", t = {time}"));
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
    // as many as the lines hold
    for shown in (1..=all.len()).rev() {
        let rest = match all.len() - shown {
            0 => String::new(),
            n => format!("; and {n} more: {place}"),
        };
        let mut some = Vec::new();
        wrap(&mut some, "assumed: ", &(all[..shown].join("; ") + &rest));
        if some.len() <= most || shown == 1 {
            lines.extend(some);
            break;
        }
    }
}

fn forces(run: &Run, most: usize, lines: &mut Vec<String>) {
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
    let of: Vec<String> = below.into_iter().chain(changes(run, forces)).chain(doubt).collect();
    let of = if of.is_empty() { String::new() } else { format!(" ({})", of.join("; ")) };
    let name = format!("design forces{of}  ");
    let words = |brief| force_words(forces, brief, |one| if doubted(one) { mark } else { "" });
    let (full, brief) = (words(false), words(true));
    // all of them, in brief if need be; else as many as the lines hold
    let shorter = (1..brief.len()).rev().map(|shown| (&brief[..shown], "; more in the report"));
    for (some, rest) in [(&full[..], ""), (&brief[..], "")].into_iter().chain(shorter) {
        let mut told = Vec::new();
        wrap_at(&mut told, &name, FORCES_INDENT, &(some.join("; ") + rest));
        if told.len() <= most || some.len() == 1 {
            lines.extend(told);
            break;
        }
    }
}

/// By how much those that are given change, the largest of them.
fn changes(run: &Run, forces: &DesignForces) -> Option<String> {
    let given = forces.all().filter(|(_, force)| force.holds).filter_map(|(_, force)| force.change);
    let with = match run.parameters {
        FiledParameters::Rigid(_) => "springs",
        FiledParameters::Elastic(_) => "springs and mesh",
    };
    Some(format!("{} with {with}", percent(given.reduce(f64::max)?)))
}

/// The forces in words, each with its mark; those withheld are named. In brief without what the
/// whole record has and without heights, which the report tells.
fn force_words<'a>(
    forces: &DesignForces,
    brief: bool,
    mark: impl Fn((ForceName, DesignForce)) -> &'a str,
) -> Vec<String> {
    // magnitudes: signs are in the report
    let magnitude = |force: DesignForce| DesignForce {
        value: force.value.map(f64::abs),
        whole_record: force.whole_record.filter(|_| !brief),
        above_base_m: force.above_base_m.filter(|_| !brief),
        ..force
    };
    let cell = |(name, force): (ForceName, DesignForce)| {
        let mark = mark((name, force));
        let force = magnitude(force);
        format!("{} {}{mark}{}", name.words(), force_value(name, &force), height(&force))
    };
    // the report has the vertical force, too
    let mut all: Vec<_> =
        forces.all().filter(|(name, _)| *name != ForceName::SoleVertical).collect();
    all.sort_by_key(|(name, _)| order(*name));
    all.into_iter().map(cell).collect()
}

/// What a section is designed for comes first: a screen may have no room for the others.
fn order(name: ForceName) -> usize {
    match name {
        ForceName::ColumnShear => 0,
        ForceName::ColumnBaseMoment => 1,
        ForceName::Axial => 2,
        ForceName::AxialTension => 3,
        _ => 4,
    }
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
    let usable = run.program.iter().filter(|program| program.usable);
    usable.for_each(|program| add(steps.as_deref(), &program.units));
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
        Some(program) => {
            at_most(3, lines, &format!("{:10}", program.short()), &program.line());
            if written.decks && program.deck_of_even_steps {
                let deck = format!("python3 {}", file(&format!("decks/{EVEN_DECK}")));
                wrap(lines, "its deck  ", &deck);
            }
        }
        None => wrap(lines, "SAP2000   ", NO_PROGRAM),
    }
    if written.report {
        wrap(lines, "report    ", &file("report.html"));
    }
}
