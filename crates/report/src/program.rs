//! Springs for a program with fixed time steps: what it is to be set to, and what they err.

use serde::Serialize;

use super::{Section, Table, Unit, elastic::springs::corner_units, predictable_to, unit_of};
use files::message::{percent, quantity, significant};
use springs::{
    parameters::{
        Parameters,
        elastic::ElasticParameters,
        program::{FootUnits, ProgramErrors, ProgramRow, ProgramTest},
    },
    results::{FiledFinding, Finding, PeakPair},
    tuning::fixed_steps::THROUGH,
};

/// Letters of a name in the first column of a screen.
const NAME: usize = 9;

/// A tolerance above which one suspects a misprint.
const LARGE: f64 = 0.01;

/// Springs for a program with fixed time steps.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProgramReport {
    /// The program: "SAP2000".
    pub program: String,
    /// Its steps: "1 ms".
    pub steps: String,
    /// What it is to be set to, in the order of a dialog.
    pub set_to: Vec<ProgramSetting>,
    /// What the springs err there, measured in this run.
    pub errors: String,
    /// The same in fewer words.
    #[serde(skip)]
    short_errors: String,
    /// The units, as the run's own.
    pub units: Vec<Unit>,
    /// The same errors in parts and suites.
    #[serde(skip)]
    table: Table,
    /// Whether they are of use: the program gets through most motions tried, and errs by less.
    #[serde(skip)]
    pub(crate) usable: bool,
    /// Whether it is OpenSees with steps of one size, which has a deck of its own.
    #[serde(skip)]
    pub(crate) deck_of_even_steps: bool,
    /// Whether it is SAP2000 or ETABS, for which a run writes a sheet to type from.
    #[serde(skip)]
    pub(crate) csi: bool,
    /// Why they are stiffer than the closed form has them, if they are.
    #[serde(skip)]
    stiffer: Option<&'static str>,
}

/// A setting of a program.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ProgramSetting {
    /// As a dialog names it.
    pub name: &'static str,
    /// What it is to be.
    pub value: String,
    /// Both, for a screen.
    #[serde(skip)]
    short: String,
    /// Whether it looks like a misprint and is none.
    #[serde(skip)]
    meant: bool,
}

impl ProgramSetting {
    fn new(name: &'static str, value: String, short: String) -> Self {
        Self { name, value, short, meant: false }
    }
}

impl ProgramReport {
    /// Of a rigid body's springs, if there are some for a program.
    pub(crate) fn of_rigid(parameters: &Parameters) -> Option<Self> {
        let row = parameters.program.as_ref()?;
        let FootUnits { vertical, horizontal, rotational_inertia_kgm2 } = row.units;
        let units = [unit_of("vertical", &vertical), unit_of("horizontal", &horizontal)];
        let given = parameters.structure.rotational_inertia_kgm2;
        let inertia = (rotational_inertia_kgm2 != given).then(|| {
            let value = format!("{} kg m2", significant(rotational_inertia_kgm2, 4));
            ProgramSetting::new(
                "rotational inertia at the mass",
                value.clone(),
                format!("inertia {value}"),
            )
        });
        let late = late(parameters.peaks, &parameters.findings);
        Some(Self::new(row, units.into(), inertia, ("top", "synthetic motions", late)))
    }

    /// Of an elastic structure's springs.
    pub(crate) fn of_elastic(parameters: &ElasticParameters) -> Option<Self> {
        let row = parameters.program.as_ref()?;
        let late = late(parameters.peaks, &parameters.findings);
        // this record among them
        let told = ("peaks", "motions", late);
        Some(Self::new(row, corner_units(&row.units.springs), None, told))
    }

    fn new<U>(
        row: &ProgramRow<U>,
        units: Vec<Unit>,
        inertia: Option<ProgramSetting>,
        (peaks, motions, late): (&str, &'static str, bool),
    ) -> Self {
        let tolerance = match row.converged {
            ProgramTest::UnbalanceOverWeight(value) => {
                let x = significant(value, 3);
                let name = "iteration convergence tolerance, relative";
                let short = format!("tolerance {x}");
                ProgramSetting { meant: value > LARGE, ..ProgramSetting::new(name, x, short) }
            }
            ProgramTest::IncrementM(x) => {
                let x = format!("{} m", significant(x, 3));
                ProgramSetting::new(
                    "tolerance of a change of place",
                    x.clone(),
                    format!("tolerance {x}"),
                )
            }
        };
        let (integrator, newton, step) =
            (row.integrator_words(), row.newton_iterations, row.step_s);
        let least = quantity(step / row.substeps as f64, "s");
        let mut set_to = vec![
            ProgramSetting::new("integrator", integrator.clone(), integrator),
            ProgramSetting::new(
                "iterations with constant stiffness",
                "0".into(),
                format!("0 constant + {newton} Newton iterations"),
            ),
            ProgramSetting::new(
                "Newton-Raphson iterations, at most",
                newton.to_string(),
                String::new(),
            ),
            tolerance,
            ProgramSetting::new("smallest substep", least.clone(), format!("substeps {least}")),
        ];
        set_to.extend(inertia);
        Self {
            program: row.program(),
            steps: quantity(row.step_s, "s"),
            set_to,
            errors: errors(row, (peaks, motions, late), true),
            short_errors: errors(row, (peaks, motions, late), false),
            units,
            table: table(row, motions),
            usable: row.not_to_be_used().is_none(),
            deck_of_even_steps: row.is_opensees_even(),
            csi: row.is_csi(),
            stiffer: row.stiffer_for_earthquakes.then_some(
                "Omega_n is twice that of the closed form: earthquake-like motions sway the \
                    structure before it lifts, and their peaks err less on such springs; this \
                    integrator ends the motions that they ring in.",
            ),
        }
    }

    /// The program's name, or that its steps are even, in nine letters.
    pub(crate) fn short(&self) -> &str {
        if self.program.chars().count() <= NAME { &self.program } else { "even step" }
    }

    /// For a screen: what goes wrong and the errors; where there is little room, on how many
    /// motions and the history's are left out.
    pub(crate) fn line(&self, room: bool) -> String {
        let errors = if room { &self.errors } else { &self.short_errors };
        format!("{} steps: {errors}", self.steps)
    }

    /// For a screen: what the program is to be set to; nothing of springs that are not to be used.
    pub(crate) fn settings(&self, room: bool) -> String {
        let told = self.set_to.iter().filter(|s| self.usable && !s.short.is_empty());
        let one = |s: &ProgramSetting| match s.meant && room {
            true => format!("{} (meant so large)", s.short),
            false => s.short.clone(),
        };
        told.map(one).collect::<Vec<_>>().join(", ")
    }

    /// For a report.
    pub(crate) fn section(&self) -> Section {
        let set_to =
            self.set_to.iter().map(|s| format!("{}: {}", s.name, s.value)).collect::<Vec<_>>();
        Section {
            id: "program",
            title: format!("Springs for {} with steps of {}", self.program, self.steps),
            text: vec![
                format!(
                    "A program with steps of one size lands somewhere within a step, and errs by \
                        13 p dt in the median whatever its springs. These are as stiff, and give \
                        back as little of a landing, as the step has use for. Set: {}.",
                    set_to.join("; ")
                ),
                format!(
                    "Measured by stepping the model as such a program does, beside the history of \
                        the reference: {}.",
                    self.errors
                ),
            ],
            table: Some(self.table.clone()),
            notes: self.stiffer.map(String::from).into_iter().collect(),
            ..Section::default()
        }
    }

    /// k1, k2, m2, c of its units.
    pub(crate) fn springs(&self) -> Section {
        let row = |unit: &Unit| {
            let numbers = [unit.k1_n_per_m, unit.k2_n_per_m, unit.m2_kg, unit.c_ns_per_m];
            [vec![unit.name.clone()], numbers.map(|x| format!("{x:.4e}")).into()].concat()
        };
        Section {
            id: "program-springs",
            title: format!("The same, springs at each foot for steps of {}", self.steps),
            table: Some(
                Table::new(["unit", "k1 [N/m]", "k2 [N/m]", "m2 [kg]", "c [N s/m]"])
                    .with(self.units.iter().map(row)),
            ),
            ..Section::default()
        }
    }
}

/// That a program does not get through one history in twenty.
pub(crate) fn lost<U>(row: &ProgramRow<U>, asked: bool) -> Option<Finding> {
    let errors = row.expected.synthetic?;
    let (lost, histories) = (errors.lost, errors.histories);
    let many = lost as f64 > (1.0 - THROUGH) * histories as f64;
    let (program, step_s, csi) = (row.program(), row.step_s, row.is_csi());
    many.then_some(Finding::ProgramLoses { program, step_s, lost, histories, csi, asked })
}

/// Whether the largest displacement comes after what can be predicted.
fn late(peaks: Option<PeakPair>, findings: &[FiledFinding]) -> bool {
    let largest = peaks.and_then(|pair| pair.reference.times).map(|times| times.top_displacement_s);
    predictable_to(findings).zip(largest).is_some_and(|(until, largest)| largest > until)
}

/// What goes wrong, if something does; then the errors, largest displacement first: median and what
/// 90 % are below.
fn errors<U>(
    row: &ProgramRow<U>,
    (peaks, motions, late): (&str, &'static str, bool),
    room: bool,
) -> String {
    let nothing = String::new;
    let suites =
        [(motions, row.expected.synthetic), ("earthquake-like motions", row.expected.earthquakes)];
    let suites = suites.into_iter().filter_map(|(name, errors)| Some((name, errors?)));
    let suites: Vec<(&str, ProgramErrors)> = suites.collect();
    let median = |errors: &ProgramErrors| errors.peak[0].unwrap_or(f64::INFINITY);
    // of the suite where they err most
    let worst = suites
        .iter()
        .copied()
        .reduce(|one, other| if median(&other.1) > median(&one.1) { other } else { one });
    let Some((name, errors)) = worst else {
        return "errors not measured".into();
    };
    if let Some(why) = row.not_to_be_used() {
        return why.to_string();
    }
    let cell = |x: Option<f64>| x.map_or("lost".into(), percent);
    let [median, ninety] = errors.peak.map(cell);
    let history = errors.history[0];
    let history = history.map_or(String::new(), |x| format!(", NRMSE {}", significant(x, 2)));
    let [lost, all] =
        suites.iter().fold([0; 2], |[lost, all], (_, e)| [lost + e.lost, all + e.histories]);
    let each = |(name, e): &(&str, ProgramErrors)| format!("{} of {} {name}", e.lost, e.histories);
    let fails = match lost {
        0 => nothing(),
        _ if room => {
            format!("fails on {}; ", suites.iter().map(each).collect::<Vec<_>>().join(", "))
        }
        lost => format!("fails on {lost} of {all}; "),
    };
    let [ends, top] = row.on_record.map_or([None; 2], |on| [on.gives_up_s, on.top]);
    let ends = ends.map_or(nothing(), |s| {
        format!("this record: gives up at {} s, try another --step; ", significant(s, 3))
    });
    let top = top.filter(|_| ends.is_empty());
    let here = top.map_or(nothing(), |top| match (late, room) {
        (true, true) => format!("this record: top {} (not predictable); ", signed(top)),
        // the table of peaks says what the asterisk is
        (true, false) => format!("here top {}*; ", signed(top)),
        (false, true) => format!("this record: top {}; ", signed(top)),
        (false, false) => format!("here top {}; ", signed(top)),
    });
    if !room {
        let told = match errors.peak[0] {
            Some(_) => format!("{peaks} {median} (median), {ninety} (90 %)"),
            None => format!("most {name} are lost"),
        };
        return format!("{ends}{fails}{here}{told}");
    }
    // how many there are is said with those that fail
    let told = lost > 0 && suites.len() == 1;
    let on = if told { nothing() } else { format!(" on {} {name}", errors.histories) };
    let within = match errors.peak[0] {
        Some(_) => format!("{peaks} within {median} (median), {ninety} (90 %){on}{history}"),
        None => format!("most {name} are lost"),
    };
    format!("{ends}{fails}{here}{within}")
}

/// A difference with its sign.
fn signed(share: f64) -> String {
    let sign = if share > 0.0 && !percent(share).starts_with("below") { "+" } else { "" };
    format!("{sign}{}", percent(share))
}

fn table<U>(row: &ProgramRow<U>, motions: &str) -> Table {
    let expected = &row.expected;
    let number = |x: f64| significant(x, 2);
    let cell = |x: Option<f64>| x.map_or("lost".into(), number);
    let parts = [
        ("by the step alone, 13 p dt (median)", Some(expected.floor)),
        ("by the sway before uplift", expected.stance),
        ("by what a landing gives back", expected.rebound),
    ];
    let empty = String::new;
    let part = |(name, value): (&str, Option<f64>)| {
        Some(vec![format!("expected {name}"), number(value?), empty(), empty(), empty(), empty()])
    };
    let parts = parts.into_iter().filter_map(part);
    let measured = |name: &str, errors: Option<ProgramErrors>| {
        errors.map(|e| {
            let percent = |x: Option<f64>| x.map_or("lost".into(), percent);
            vec![
                format!("measured on {} {name}", e.histories),
                cell(e.history[0]),
                cell(e.history[1]),
                percent(e.peak[0]),
                percent(e.peak[1]),
                e.lost.to_string(),
            ]
        })
    };
    let measured = [
        measured(motions, expected.synthetic),
        measured("earthquake-like motions", expected.earthquakes),
    ];
    Table::new([
        "error",
        "history, NRMSE, median",
        "90 %",
        "largest displacement, median",
        "90 %",
        "lost",
    ])
    .with(parts.chain(measured.into_iter().flatten()))
}
