//! What `tune run` prints: one screen, the answer first.
//!
//! `lines` breaks text, `peaks` has the displacements, `forces` the design forces, `warnings` what
//! room is left for.

mod forces;
mod lines;
mod peaks;
mod warnings;

use super::{Run, STEADY, Section, Table, Unit, peak_table};
use files::message::{shortened, significant};
use lines::{at_most, parts_at_most, wrapped};
use peaks::of_screen;
use warnings::{Warned, is_doubt, tell, warnings};

/// Lines of a screen, and letters of a line.
pub(crate) const LINES: usize = 30;
pub(crate) const WIDTH: usize = 98;

/// What the answer may take where warnings need room.
#[derive(Clone, Copy)]
struct Crowding {
    /// Whether an empty line stands before the verdict.
    empty_line: bool,
    /// Lines of what was assumed.
    assumed: usize,
    /// Lines of the accuracy, and sets of motions that it is told on.
    accuracy: usize,
    measured: usize,
    /// Lines of the verdict.
    sentence: usize,
    /// Whether the deck's own command stands beside that which checks it.
    both_commands: bool,
    /// Lines of what a program with fixed time steps errs.
    program: usize,
    /// Lines for the settings of such a program: all of them; without those that keep their
    /// defaults; or as many as fit. 0: only in the report.
    settings: usize,
    /// Whether impacts, and the friction needed, stand in the table of peaks.
    all_peaks: bool,
    /// Whether the record and what was assumed have one line each, forces that are withheld stand
    /// in one, parts of a displacement stand in one, and what a unit is made of is left to the
    /// report.
    tight: bool,
}

/// Lines that all settings of a program take.
const ALL_SETTINGS: usize = 4;

/// All that there is room for.
const SPACIOUS: Crowding = Crowding {
    empty_line: true,
    assumed: 2,
    accuracy: 2,
    measured: 2,
    sentence: 3,
    both_commands: true,
    program: 2,
    settings: ALL_SETTINGS,
    all_peaks: true,
    tight: false,
};

/// What leaves most room.
const CLOSEST: Crowding = Crowding {
    empty_line: false,
    assumed: 1,
    accuracy: 1,
    measured: 1,
    sentence: 3,
    both_commands: false,
    program: 1,
    settings: 3,
    all_peaks: true,
    tight: false,
};

/// The first is taken where every warning has all its lines; else the last.
const CROWDING: [Crowding; 8] = [
    SPACIOUS,
    Crowding { empty_line: false, ..SPACIOUS },
    Crowding { assumed: 2, accuracy: 2, ..CLOSEST },
    Crowding { accuracy: 2, ..CLOSEST },
    CLOSEST,
    Crowding { all_peaks: false, ..CLOSEST },
    Crowding { settings: 2, all_peaks: false, tight: true, ..CLOSEST },
    Crowding { settings: 0, all_peaks: false, tight: true, ..CLOSEST },
];

/// What is said where no springs suit steps of one size.
const NO_PROGRAM: &str = "not these springs: programs with steps of one size need \
    others; there are none for this structure";
/// The same of a structure with members, which `tune export --stepping even` refuses.
const NO_PROGRAM_FOR_MEMBERS: &str = "not these springs: programs with steps of one size need \
    others, which are not made for dampers, tendons or friction";

/// Why there are no springs for steps of one size.
pub(crate) fn no_program(run: &Run) -> &'static str {
    if run.has_members() { NO_PROGRAM_FOR_MEMBERS } else { NO_PROGRAM }
}

/// The deck of OpenSees with steps of one size.
pub const EVEN_DECK: &str = "model_even.py";
/// The model for SAP2000 as tables to import.
pub const TABLES: &str = "model_sap2000.s2k";
/// The same as a sheet to type from.
pub const SHEET: &str = "sap2000_by_hand.txt";
/// The sheet for ETABS.
pub const ETABS_SHEET: &str = "etabs_by_hand.txt";
/// What a unit is made of, from above.
const UNIT: &str = "foot - k1 (gap) - m2 - k2 and c - ground";
/// Letters of a path in a command.
const LONGEST_PATH: usize = 58;
/// What a doubt of what was given begins with.
const CHECK: &str = "CHECK     ";
/// What the report's line begins with.
const REPORT: &str = "report    ";

/// Where results are, for the commands that the screen ends with.
pub struct Written<'a> {
    /// The folder.
    pub folder: &'a str,
    /// Whether report.html was written.
    pub report: bool,
    /// Whether decks were.
    pub decks: bool,
    /// Of decks that were left out or end early: why, and what to do.
    pub left_out: &'a [String],
}

impl Written<'_> {
    /// A file of the folder, as it can be typed if it is not too long.
    fn file(&self, name: &str) -> String {
        shortened(&format!("{}/{name}", self.folder.trim_end_matches('/')), LONGEST_PATH)
    }

    /// The last line: where the report is, how many warnings are there alone, and the file to type
    /// a model from for a program.
    fn report_line(&self, warnings: usize, sheet: Option<&str>) -> String {
        let all = self.report_and(warnings);
        let Some(sheet) = sheet.filter(|_| self.decks) else { return all };
        // a path to copy, if there is room for it
        let path = format!("{}/decks/{sheet}", self.folder.trim_end_matches('/'));
        let places = [path, format!("decks/{sheet} beside it")];
        let lines = places.map(|place| format!("{all}; type it from {place}"));
        lines.into_iter().find(|line| line.chars().count() <= WIDTH).unwrap_or(all)
    }

    fn report_and(&self, warnings: usize) -> String {
        let name = if self.report { "report.html" } else { "parameters.json" };
        let more = match warnings {
            0 => String::new(),
            1 => ", with 1 more warning".into(),
            more => format!(", with {more} more warnings"),
        };
        format!("{REPORT}{}{more}", self.file(name))
    }

    /// The files of a program that was asked for, if the report's line has no room for them.
    fn files_alone(&self, run: &Run) -> Option<String> {
        const MANY: usize = 10;
        let files = asked_files(run).filter(|_| self.decks)?;
        let together = self.report_and(MANY).chars().count() + files.chars().count() + 2;
        (together > WIDTH || !self.report).then_some(files)
    }
}

/// The files of the model for SAP2000 or ETABS, where a user asked for that.
fn asked_files(run: &Run) -> Option<String> {
    let program = run.program.as_ref().filter(|program| program.asked)?;
    let sheet = sheet_of(run)?;
    Some(match program.etabs {
        true => format!("type it from decks/{sheet}"),
        false => format!("decks/{TABLES}, {sheet}"),
    })
}

/// The screen: at most `LINES` lines of at most `WIDTH` letters.
pub fn screen(run: &Run, written: &Written) -> String {
    let warnings = warnings(run, written.left_out);
    // the last line is the report's
    let room = |lines: &Vec<String>| (LINES - 1).saturating_sub(lines.len());
    let wanted: usize = warnings.iter().map(|warning| warning.lines().len()).sum();
    let answers = CROWDING.iter().map(|crowding| answer(run, written, *crowding));
    // what a program that a user asked for is to be set to is told all the same
    let asked = run.program.as_ref().is_some_and(|program| program.asked && program.usable);
    let levels = CROWDING.len() - usize::from(asked);
    let fits = |(level, lines): &(usize, Vec<String>)| {
        lines.len() < LINES && room(lines) >= wanted || level + 1 == levels
    };
    let answers = answers.take(levels).enumerate();
    let mut lines = answers.into_iter().find(fits).map(|(_, lines)| lines).unwrap_or_default();
    lines.truncate(LINES - 1);
    let left_out = tell(&warnings, &mut lines);
    if written.report || left_out > 0 {
        // what was asked for is told in any case
        let files = asked_files(run).filter(|_| written.decks);
        lines.push(match files {
            Some(files) if written.files_alone(run).is_none() => {
                format!("{}; {files}", written.report_and(left_out))
            }
            Some(_) => written.report_and(left_out),
            None => written.report_line(left_out, sheet_of(run)),
        });
    }
    lines.join("\n") + "\n"
}

/// The file to type from, if there is one.
fn sheet_of(run: &Run) -> Option<&str> {
    let program = run.program.as_ref().filter(|program| program.csi && program.usable)?;
    run.sap2000.then_some(if program.etabs { ETABS_SHEET } else { SHEET })
}

impl Run {
    /// With what is to be said of its decks, for the report.
    pub fn with_decks(mut self, left_out: &[String]) -> Self {
        if !left_out.is_empty() {
            self.sections.push(Section {
                id: "decks",
                title: "Decks that are left out or end early".into(),
                text: left_out.iter().map(|line| format!("{line}.")).collect(),
                ..Section::default()
            });
        }
        self
    }
}

/// All but the warnings.
fn answer(run: &Run, written: &Written, crowding: Crowding) -> Vec<String> {
    let mut lines = Vec::new();
    taken(run, written, crowding, &mut lines);
    if crowding.empty_line {
        lines.push(String::new());
    }
    at_most(crowding.sentence, &mut lines, "", &run.verdict());
    lines.extend(peak_table(run).into_iter().flat_map(|table| of_screen(table, crowding)));
    lines.extend(forces::lines(run, crowding.tight));
    springs(run, &mut lines);
    if crowding.settings > 0 && !crowding.tight {
        lines.push(format!("  {}, each direction: {UNIT}", run.springs_at));
    }
    if let Some(accuracy) = &run.accuracy {
        // as many sets as there is room for; what was asked and found on one of them is not cut
        let sets = accuracy.sets().clamp(1, crowding.measured);
        let told =
            |sets: usize| wrapped("accuracy  ", &accuracy.short(sets, run.unjudged()).join("; "));
        let fits = |some: &Vec<String>| some.len() <= crowding.accuracy;
        lines.extend((1..=sets).rev().map(told).find(fits).unwrap_or_else(|| told(1)));
    }
    next(run, written, crowding, &mut lines);
    lines
}

fn taken(run: &Run, written: &Written, crowding: Crowding, lines: &mut Vec<String>) {
    let two = if crowding.tight { 1 } else { 2 };
    let fact = |name: &str| {
        run.taken.facts.iter().find(|(fact, _)| fact.starts_with(name)).map(|(_, value)| value)
    };
    let first = fact("first lifts").map_or(String::new(), |time| format!(", at {time}"));
    let vertical = if run.taken.vertical { " (1 + vertical in g)" } else { "" };
    // an elastic structure that is shaken may lift at less
    let at = if fact(STEADY).is_some() { "at a steady" } else { "beyond" };
    let lifts = fact("lifts")
        .map_or(String::new(), |value| format!("; lifts {at} {value}{vertical}{first}"));
    // what lifts it is an answer: it is not cut
    lines.extend(wrapped("", &format!("{}{lifts}", run.taken.structure)));
    if let Some(record) = &run.taken.short_record {
        let name = if record.chars().count() > WIDTH { "record " } else { "" };
        at_most(two, lines, "", record.strip_prefix(name).unwrap_or(record));
    }
    for filed in run.remarks().filter(|filed| is_doubt(filed)) {
        lines.extend(Warned::of(CHECK, filed).lines());
    }
    let all: Vec<String> =
        run.taken.assumed.iter().map(|a| format!("{} ({})", a.what, a.key)).collect();
    let place = if written.report { "report.html" } else { "--verbose" };
    let told = |shown: usize| match all.len() - shown {
        0 => all.join("; "),
        n => format!("{}; and {n} more: {place}", all[..shown].join("; ")),
    };
    // as many as the lines hold
    let some = (1..=all.len()).rev().map(|shown| wrapped("assumed: ", &told(shown)));
    match some.into_iter().find(|some| some.len() <= crowding.assumed) {
        Some(some) => lines.extend(some),
        // one that is longer than the lines
        None if !all.is_empty() => at_most(two, lines, "assumed: ", &told(1)),
        None => {}
    }
}

fn springs(run: &Run, lines: &mut Vec<String>) {
    const SHOWN: usize = 2;
    const SAID: &str = "  numerical contact stiffness, not soil";
    let of = format!("springs {}", run.springs_at.replace("each", "for one"));
    let mut table = Table::new([of.as_str(), "k1 [N/m]", "k2 [N/m]", "m2 [kg]", "c [N s/m]"]);
    let steps =
        run.program.as_ref().map(|program| format!("{}, {}", program.short(), program.steps));
    let mut add = |of: Option<&str>, units: &[Unit]| {
        for unit in units.iter().take(SHOWN) {
            let cells = unit.row.numbers().map(|x| significant(x, 4));
            let name = of.map_or(format!("  {}", unit.name), |of| format!("  {of}: {}", unit.name));
            table.rows.push([vec![name], cells.into()].concat());
        }
    };
    let own = (steps.as_ref().map(|_| "OpenSees, adaptive"), &run.springs);
    let usable = run.program.iter().filter(|program| program.usable);
    let mut all: Vec<_> =
        [own].into_iter().chain(usable.map(|program| (steps.as_deref(), &program.units))).collect();
    // those that were asked for, first
    if run.program.as_ref().is_some_and(|program| program.asked) {
        all.reverse();
    }
    all.into_iter().for_each(|(of, units)| add(of, units));
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

fn next(run: &Run, written: &Written, crowding: Crowding, lines: &mut Vec<String>) {
    let both = crowding.both_commands;
    let no_use = run.accuracy.as_ref().and_then(|accuracy| accuracy.no_use());
    if written.decks {
        let run = format!("python3 {}", written.file("decks/model_openseespy.py"));
        let check = format!("tune verify --parameters {}", written.file("parameters.json"));
        if let Some(why) = &no_use {
            let deck = written.file("decks/model_openseespy.py");
            lines.extend(wrapped("OpenSees  ", &format!("{why}; the deck: {deck}")));
        // on one line, if both fit
        } else if run.chars().count() + check.chars().count() + 2 < WIDTH - 10 {
            lines.extend(wrapped("OpenSees  ", &format!("{run}; {check}")));
        } else {
            if both {
                lines.extend(wrapped("OpenSees  ", &run));
            }
            lines.extend(wrapped(if both { "check it  " } else { "OpenSees  " }, &check));
        }
    }
    match &run.program {
        Some(program) => {
            let name = format!("{:10}", program.short());
            // the words that fit; the fewest are not cut
            let mut told = program.lines().map(|text| wrapped(&name, &text));
            let fits = told.iter().position(|some| some.len() <= crowding.program);
            lines.append(&mut told[fits.unwrap_or(told.len() - 1)]);
            let settings = program.settings(crowding.settings >= ALL_SETTINGS);
            if !settings.is_empty() && crowding.settings > 0 {
                let place = if written.report { "report.html" } else { "--verbose" };
                let rest = format!("all settings: {place}");
                parts_at_most(crowding.settings, lines, "  set to  ", &settings, &rest);
            }
            if written.decks && program.deck_of_even_steps && program.usable {
                let deck = format!("python3 {}", written.file(&format!("decks/{EVEN_DECK}")));
                lines.extend(wrapped("its deck  ", &deck));
            }
            if let Some(files) = written.files_alone(run) {
                lines.extend(wrapped("its model ", &files));
            }
        }
        None => lines.extend(wrapped("SAP2000   ", no_program(run))),
    }
}
