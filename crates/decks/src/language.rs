//! The languages of OpenSees decks: what all decks in one share, and how it writes lists.
//!
//! A deck is a template (numbers, model, what is recorded) around three fragments: the stepping
//! routine, the solver with its loads, and the epilogue that follows the record and checks the
//! peaks.

use std::fmt::Write;

use super::{ExportError, model::digits, stepping::EvenSteps};
use files::message::significant;
use strong_motion::Record;

/// A language and its fragments.
#[derive(Debug)]
pub(super) struct Language {
    routine: &'static str,
    /// The same for steps of one size; the lines of its numbers.
    even: &'static str,
    even_numbers: [&'static str; 3],
    /// The call that sets TRBDF2, and any integrator by its name and numbers.
    trbdf2: &'static str,
    integrator: fn(&[String]) -> String,
    solver: &'static str,
    /// What the routine takes after a step that was refused: as it stands, and where no foot lands.
    /// No mark: the routine is to be pasted into scripts as it stands.
    pub(super) refused: [&'static str; 2],
    epilogue: &'static str,
    /// What ends the epilogue, and what stops it with a reason.
    ends: &'static str,
    stops: [&'static str; 2],
    /// What ends the epilogue where the springs are not to be used; and what prints a line.
    ends_refused: &'static str,
    prints: [&'static str; 2],
    /// Code of the shear springs of Timoshenko beams; head and end of their list.
    pub shear_springs: &'static str,
    pub shear_list: [&'static str; 2],
    /// Around a list, between its items, and after a row of a list of lists.
    // decks of elastic structures have lists
    brackets: [&'static str; 2],
    separator: &'static str,
    end: &'static str,
}

/// Python, for openseespy.
pub(super) static PYTHON: Language = Language {
    routine: super::STEPS,
    even: include_str!("steps_even.py"),
    even_numbers: ["STEP = ", "SUBSTEPS = ", "TOUCHES = "],
    trbdf2: "analysis(\"TRBDF2\")",
    integrator: |arguments| match arguments {
        [name, numbers @ ..] => {
            format!("analysis({})", [&[format!("\"{name}\"")], numbers].concat().join(", "))
        }
        [] => String::new(),
    },
    solver: include_str!("solver.py"),
    refused: ["self.shortest if h > self.shortest else 0.25 * h", "0.25 * h"],
    epilogue: include_str!("epilogue.py"),
    ends: "    return 0 if good else 1",
    stops: ["    stop(\"", "\")"],
    ends_refused: "    return 4 if good else 1",
    prints: ["    print(\"", "\")\n"],
    shear_springs: include_str!("elastic_shear.py"),
    shear_list: ["SHEAR = {", "}"],
    brackets: ["(", ")"],
    separator: ", ",
    end: ",",
};

/// Tcl, for OpenSees' own interpreter.
pub(super) static TCL: Language = Language {
    routine: include_str!("steps.tcl"),
    even: include_str!("steps_even.tcl"),
    even_numbers: ["set step ", "set substeps ", "set touches "],
    trbdf2: "solver TRBDF2 Transient",
    integrator: |arguments| format!("solver {{{}}} Transient", arguments.join(" ")),
    solver: include_str!("solver.tcl"),
    refused: ["{$h > $shortest ? $shortest : 0.25 * $h}", "{0.25 * $h}"],
    epilogue: include_str!("epilogue.tcl"),
    ends: "exit [expr {1 - $good}]",
    stops: ["stop \"", "\""],
    ends_refused: "exit [expr {$good ? 4 : 1}]",
    prints: ["puts \"", "\"\n"],
    shear_springs: include_str!("elastic_shear.tcl"),
    shear_list: ["set shear {", "}"],
    brackets: ["{", "}"],
    separator: " ",
    end: "",
};

/// Why decks in steps that follow touches take TRBDF2.
const WHY_TRBDF2: &str = "    # TRBDF2 is L-stable: Newmark (1/2, 1/4) and HHT fail on springs \
                          this stiff, Newmark with damping spoils the answer.\n";
/// Why the iteration of feet that slip takes a line search.
const WHY_LINE_SEARCH: &str =
    "    # Full steps would lift a foot that slips, unless they take microseconds.\n";

impl Language {
    /// A list of two items or more.
    pub(crate) fn list(&self, items: &[String]) -> String {
        let [open, close] = self.brackets;
        format!("{open}{}{close}", items.join(self.separator))
    }

    /// Beams that give in shear, by index: stiffness and dashpot of the spring that stands for it.
    pub(crate) fn shear(&self, springs: &[(usize, [f64; 2])]) -> String {
        let [open, close] = self.shear_list;
        let row = |(beam, [stiffness, damping]): &(usize, [f64; 2])| match self.end {
            "" => format!("    {{{beam} {} {}}}\n", digits(*stiffness), digits(*damping)),
            _ => format!("    {beam}: ({}, {}),\n", digits(*stiffness), digits(*damping)),
        };
        format!("{open}\n{}{close}\n", springs.iter().map(row).collect::<String>())
    }

    /// A list of lists, one a line.
    pub(crate) fn lines(&self, lists: impl Iterator<Item = Vec<String>>) -> String {
        lists
            .map(|items| format!("    {}{}", self.list(&items), self.end))
            .collect::<Vec<_>>()
            .join("\n")
    }

    /// A template with its fragments, the record and these values in the place of `@NAME@`;
    /// `slides` if the body slides and does not lift, so that no landing asks for the shortest
    /// steps after one that was refused.
    ///
    /// # Errors
    /// Steps of one size by an integrator that OpenSees has not.
    pub(crate) fn fill(
        &self,
        template: &str,
        values: &[(&str, String)],
        record: &Record,
        even: Option<&EvenSteps>,
        slides: bool,
    ) -> Result<String, ExportError> {
        let routine = match (even, self.refused) {
            (Some(even), _) => self.even_routine(even),
            (None, [usual, sliding]) if slides => self.routine.replacen(usual, sliding, 1),
            (None, _) => self.routine.to_string(),
        };
        let end = even.map_or_else(|| self.ends.to_string(), |even| self.even_end(even));
        let call = match even {
            Some(even) => (self.integrator)(&even.in_opensees()?),
            None => self.trbdf2.to_string(),
        };
        let why = if even.is_some() { "" } else { WHY_TRBDF2 };
        let (full_steps, line_search) =
            if slides { (WHY_LINE_SEARCH, "LineSearch") } else { ("", "") };
        // the fragments first: they have marks of their own
        let fragments = [
            ("ROUTINE", routine.trim_end()),
            ("SOLVER", self.solver.trim_end()),
            ("EPILOGUE", self.epilogue.trim_end()),
            ("END", &end),
            ("INTEGRATOR", &format!("{why}    {call}")),
            ("FULL_STEPS", full_steps),
            ("LINE_SEARCH", line_search),
        ];
        let mut text = template.to_string();
        if let Some(why) = even.and_then(EvenSteps::warning) {
            // a comment in both languages, below the line that starts Python
            let first =
                if text.starts_with("#!") { text.find('\n').map_or(0, |i| i + 1) } else { 0 };
            text.insert_str(first, &format!("# {why}.\n"));
        }
        for (name, fragment) in fragments {
            text = text.replace(&format!("@{name}@"), fragment);
        }
        let refusal = even.and_then(|even| self.refusal(even)).unwrap_or_default();
        let beyond = even.map(|even| even.ends).unwrap_or_default().beyond();
        let mut told = vec![("REFUSAL", refusal), ("BEYOND", beyond.into())];
        // a deck of even steps is not to find what stiffer springs do in other steps
        let of = if even.is_some() { " of the emulation" } else { "" };
        told.push(("OF", of.into()));
        told.extend(even.map(|_| ("OURS", "the emulation of these steps".into())));
        for (name, value) in told.iter().chain(values) {
            text = text.replace(&format!("@{name}@"), value);
        }
        let vertical = record
            .vertical
            .as_ref()
            .map_or(String::new(), |vertical| self.samples(&vertical.accel));
        // last and once: they are most of the text
        Ok(text.replacen("@VERTICAL@", &vertical, 1).replacen(
            "@RECORD@",
            &self.samples(&record.accel),
            1,
        ))
    }

    /// The routine of steps of one size, its numbers above it.
    fn even_routine(&self, even: &EvenSteps) -> String {
        let [step, substeps, touches] = self.even_numbers;
        let (number, note) =
            (digits(even.step), "# s; a step that fails is halved down to one in SUBSTEPS");
        let note = note.replace("SUBSTEPS", &even.substeps.to_string());
        format!(
            "{note}\n{step}{number}\n{substeps}{}\n{touches}{}\n\n\n{}",
            even.substeps, even.touches, self.even
        )
    }

    /// What ends the epilogue of steps of one size.
    fn even_end(&self, even: &EvenSteps) -> String {
        let refusal = self.refusal(even);
        let ends = if refusal.is_some() { self.ends_refused } else { self.ends };
        let refusal = refusal.unwrap_or_default();
        let Some(time) = even.ends.gives_up_s else { return format!("{refusal}{ends}") };
        let [before, after] = self.stops;
        format!(
            "{refusal}{before}the emulation of these steps gives up at {} s, where the deck ends: \
             take another integrator or another step, longer ones too{after}",
            significant(time, 4)
        )
    }

    /// A line that prints why the springs are not to be used, if they are not.
    fn refusal(&self, even: &EvenSteps) -> Option<String> {
        let [before, after] = self.prints;
        even.warning().map(|why| format!("{before}{why}.{after}"))
    }

    /// Samples, four a line.
    fn samples(&self, accel: &[f64]) -> String {
        let lines = accel.chunks(4).map(|samples| {
            samples.iter().fold(String::from("   "), |mut line, &a| {
                // writing to a String does not fail
                let _ = write!(line, " {}{}", digits(a), self.end);
                line
            })
        });
        lines.collect::<Vec<_>>().join("\n")
    }
}

/// What a record is, for a comment.
pub(super) fn record_note(record: &Record) -> String {
    let vertical = record
        .vertical
        .as_ref()
        .map_or(String::new(), |v| format!(", vertically {:.4} g", v.peak_g()));
    format!(
        "{}: {} samples, dt {} s, peak {:.4} g{vertical}; m/s2, positive to the right",
        super::printable(&record.name),
        record.len(),
        record.dt,
        record.pga_g()
    )
}
