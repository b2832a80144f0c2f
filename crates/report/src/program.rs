//! Springs for a program with fixed time steps: what it is to be set to, and what they err.

mod errors;

use serde::Serialize;

use super::{Section, Table, Unit, elastic::springs::corner_units, filed, predictable_to};
use decks::{LARGE_TOLERANCE, OutputSteps};
use errors::{ErrorWords, ErrorsOf, errors, table};
use files::message::{quantity, significant};
use parameters::{
    Parameters, RecordRow,
    elastic::ElasticParameters,
    program::{FootUnits, ProgramOnRecord, ProgramRow, ProgramTest},
};
use results::{FiledFinding, Finding, NotToBeUsed, ProgramFault};
use springs::fixed_steps::THROUGH;

/// How a program's name ends that takes other steps, too.
const EVEN: &str = " with even steps";
/// Part of a step within which times are the same.
const SAME: f64 = 1e-6;

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
    /// The same in fewer words, and in fewest.
    #[serde(skip)]
    short_errors: [String; 2],
    /// The units, as the run's own.
    pub units: Vec<Unit>,
    /// The same errors in parts and suites.
    #[serde(skip)]
    table: Table,
    /// Whether they are of use: the program gets through most motions tried, and errs by less.
    pub usable: bool,
    /// Why not, and what to do, if they are not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub not_to_be_used: Option<NotToBeUsed>,
    /// What an emulation of it finds on the record.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on_record: Option<ProgramOnRecord>,
    /// Whether it is OpenSees with steps of one size, which has a deck of its own.
    #[serde(skip)]
    pub(crate) deck_of_even_steps: bool,
    /// Whether it is SAP2000 or ETABS, for which a run writes a sheet to type from.
    #[serde(skip)]
    pub(crate) csi: bool,
    /// Whether it is ETABS, for which it writes no tables.
    #[serde(skip)]
    pub(crate) etabs: bool,
    /// Whether a user asked for it.
    #[serde(skip)]
    pub(crate) asked: bool,
    /// Whether the structure is elastic, of which no law of the step is known.
    #[serde(skip)]
    elastic: bool,
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
    /// Whether a crowded screen leaves it out.
    #[serde(skip)]
    spare: bool,
}

impl ProgramSetting {
    fn new(name: &'static str, value: String, short: String) -> Self {
        Self { name, value, short, meant: false, spare: false }
    }
}

impl ProgramReport {
    /// Of a rigid body's springs, if there are some for a program.
    pub(crate) fn of_rigid(parameters: &Parameters) -> Option<Self> {
        let row = parameters.program.as_ref()?;
        let FootUnits { vertical, horizontal, rotational_inertia_kgm2 } = row.units;
        let units = [
            Unit::new("vertical", &vertical.chain()),
            Unit::new("horizontal", &horizontal.chain()),
        ];
        let given = parameters.structure.rotational_inertia_kgm2;
        let inertia = (rotational_inertia_kgm2 != given).then(|| {
            let value = format!("{} kg m2", significant(rotational_inertia_kgm2, 4));
            ProgramSetting::new(
                "rotational inertia at the mass",
                value.clone(),
                format!("inertia {value}, not {}", significant(given, 4)),
            )
        });
        let told = told(["top", "synthetic motions"], false, &parameters.findings);
        Some(Self::new(row, units.into(), (inertia, output(row, parameters.record.as_ref())), told))
    }

    /// Of an elastic structure's springs.
    pub(crate) fn of_elastic(parameters: &ElasticParameters) -> Option<Self> {
        let row = parameters.program.as_ref()?;
        // this record among them
        let told = told(["peaks", "motions"], true, &parameters.findings);
        let output = output(row, parameters.record.as_ref());
        Some(Self::new(row, corner_units(&row.units.springs), (None, output), told))
    }

    fn new<U>(
        row: &ProgramRow<U>,
        units: Vec<Unit>,
        (inertia, output): (Option<ProgramSetting>, Option<ProgramSetting>),
        told: ErrorsOf,
    ) -> Self {
        Self {
            program: row.program(),
            steps: quantity(row.step_s, "s"),
            set_to: settings(row, inertia, output),
            errors: errors(row, told, ErrorWords::All),
            short_errors: [ErrorWords::Short, ErrorWords::Fewest]
                .map(|words| errors(row, told, words)),
            units,
            table: table(row, &told),
            usable: row.not_to_be_used().is_none(),
            not_to_be_used: row.not_to_be_used(),
            on_record: row.on_record,
            deck_of_even_steps: row.in_opensees(),
            csi: row.is_csi(),
            etabs: row.is_etabs(),
            asked: row.asked,
            elastic: told.elastic,
            stiffer: row.stiffer_for_earthquakes.then_some(
                "The springs are stiffer than those of the closed form: on earthquake-like motions \
                    the structure sways before it lifts, and peaks err less on stiffer springs; \
                    this integrator damps their ringing.",
            ),
        }
    }

    /// The program's name, or that its steps are even.
    pub(crate) fn short(&self) -> &str {
        if self.csi { &self.program } else { "even" }
    }

    /// What goes wrong and the errors.
    pub(crate) fn line(&self) -> String {
        format!("{} steps: {}", self.steps, self.errors)
    }

    /// For a screen: the same, then in fewer words, as there is room.
    pub(crate) fn lines(&self) -> [String; 3] {
        let [short, fewest] = &self.short_errors;
        [&self.errors, short, fewest].map(|errors| format!("{} steps: {errors}", self.steps))
    }

    /// For a screen: what the program is to be set to; nothing of springs that are not to be used.
    pub(crate) fn settings(&self, room: bool) -> Vec<String> {
        let told =
            self.set_to.iter().filter(|s| self.usable && !s.short.is_empty() && (room || !s.spare));
        let one = |s: &ProgramSetting| match s.meant && room {
            true => format!("{} (meant so large)", s.short),
            false => s.short.clone(),
        };
        told.map(one).collect()
    }

    fn title(&self) -> String {
        let program = self.program.strip_suffix(EVEN).unwrap_or(&self.program);
        format!("Springs for {program} with even steps of {}", self.steps)
    }

    /// For a report.
    pub fn section(&self) -> Section {
        let set_to =
            self.set_to.iter().map(|s| format!("{}: {}", s.name, s.value)).collect::<Vec<_>>();
        let law = match self.elastic {
            // its medians lie below and far above the law of a rigid body
            true => {
                "In a program with steps of one size a foot lands somewhere within a step. The \
                    resulting error of an elastic structure follows no simple law and is measured. \
                    Of the springs tried, these lose the fewest motions and, among equals, have \
                    the smallest errors."
            }
            false => {
                "In a program with steps of one size a foot lands somewhere within a step, which \
                    causes a median error of 13 p dt whatever the springs. These springs are as \
                    stiff, and rebound as little, as is useful at this step."
            }
        };
        Section {
            id: "program",
            title: self.title(),
            text: vec![
                format!("{law} Set: {}.", set_to.join("; ")),
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
            [vec![unit.name.clone()], unit.row.numbers().map(|x| format!("{x:.4e}")).into()]
                .concat()
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

/// What errors are of, and what is known of the record's motion.
fn told([peaks, motions]: [&'static str; 2], elastic: bool, findings: &[FiledFinding]) -> ErrorsOf {
    let (moved, until) = (moved_by_little(findings), predictable_to(findings));
    ErrorsOf { peaks, motions, elastic, moved, until }
}

/// The ground motion, for a screen: direction, factor, file, its columns.
const MOTION: &str = "accel U1 x 1: ground_motion.txt (time, value)";

/// What a program is to be set to, in the order of SAP2000's dialog.
fn settings<U>(
    row: &ProgramRow<U>,
    inertia: Option<ProgramSetting>,
    output: Option<ProgramSetting>,
) -> Vec<ProgramSetting> {
    let set = ProgramSetting::new;
    let (integrator, newton) = (row.integrator.words(), row.newton_iterations);
    // halves of halves: of three substeps a half is the least
    let halves = 1_usize << row.substeps.max(1).ilog2();
    let [largest, least] = [1, halves].map(|n| significant(row.step_s / n as f64, 4));
    let mut all = vec![set("integrator", integrator.clone(), integrator)];
    all.extend(output);
    let substeps = match row.is_csi() {
        true => format!("substeps max {largest}, min {least} s"),
        false if halves == 1 => format!("steps of {largest} s, none halved"),
        false => format!("steps of {largest} s, halved down to {least} s where one fails"),
    };
    all.push(set("largest substep", format!("{largest} s"), substeps));
    all.push(set("smallest substep", format!("{least} s"), String::new()));
    if row.is_csi() {
        all.push(set("iterations with constant stiffness", "0".into(), String::new()));
    }
    let (name, value, large) = match row.converged {
        ProgramTest::UnbalanceOverWeight(x) => {
            ("iteration convergence tolerance, relative", significant(x, 3), x > LARGE_TOLERANCE)
        }
        ProgramTest::IncrementM(x) => {
            ("tolerance of a change of place", format!("{} m", significant(x, 3)), false)
        }
    };
    let constant = if row.is_csi() { "constant-stiffness 0, " } else { "" };
    let iterations = format!("{constant}Newton {newton} iterations, tolerance {value}");
    all.push(set("Newton-Raphson iterations, at most", newton.to_string(), String::new()));
    all.push(ProgramSetting { meant: large, ..set(name, value, iterations) });
    if row.is_csi() {
        // what the dialog has otherwise, unless it is told
        all.push(set("event-to-event stepping", "no".into(), "no event stepping".into()));
        all.push(set("line search", "no".into(), "no line search".into()));
        let geometry = "P-Delta plus large displacements";
        all.push(set("geometric nonlinearity", geometry.into(), geometry.into()));
        let damping = set("proportional damping of the case", "0".into(), "case damping 0".into());
        let factor = "1, for the file is in m/s2 and scaled";
        let factor = set("scale factor of the ground motion", factor.into(), MOTION.into());
        all.extend([damping, factor].map(|s| ProgramSetting { spare: true, ..s }));
        all.push(set("initial conditions", "continue from GRAVITY".into(), "from GRAVITY".into()));
    }
    all.extend(inertia);
    all
}

/// The output of SAP2000's load case on a record.
fn output<U>(row: &ProgramRow<U>, record: Option<&RecordRow>) -> Option<ProgramSetting> {
    let record = record.filter(|_| row.is_csi())?;
    let ends = row.on_record.and_then(|on| on.ends_s()).unwrap_or(f64::INFINITY);
    let samples = (record.duration_s?.min(ends) / record.dt_s + SAME).floor() as usize + 1;
    let OutputSteps { count, step_s } = OutputSteps::of(row.step_s, record.dt_s, samples);
    let output = format!("{count} x {} s", significant(step_s, 4));
    Some(ProgramSetting::new("output time steps", output.clone(), format!("output {output}")))
}

/// Findings and, if there is one, that the springs for a program are of no use. Fills in whether
/// the program was asked for, and whether what its springs err on the record can be predicted.
pub fn with_verdict<U>(
    mut findings: Vec<Finding>,
    row: Option<&mut ProgramRow<U>>,
    asked: bool,
) -> Vec<Finding> {
    let Some(row) = row else { return findings };
    row.asked = asked;
    let all = filed(findings.clone());
    let (predictable, until_s) = (Some(moved_by_little(&all).is_none()), predictable_to(&all));
    row.on_record = row.on_record.map(|on| ProgramOnRecord { predictable, until_s, ..on });
    let not_to_be_used = row.not_to_be_used();
    row.not_to_be_used = not_to_be_used;
    findings.extend(spread(row));
    findings.extend(row.errs_on_earthquakes().map(|errors| Finding::ProgramErrsOnEarthquakes {
        program: row.program(),
        step_s: row.step_s,
        median: errors.peak[0],
        motions: errors.histories,
        floor: row.expected.floor,
        asked,
    }));
    let (program, step_s) = (row.program(), row.step_s);
    findings.extend(not_to_be_used.and_then(|NotToBeUsed { fault, advice }| {
        // of steps too long to be measured there is a finding already
        let measured = !matches!(fault, ProgramFault::TooLong { .. });
        measured.then_some(Finding::ProgramNotToBeUsed { program, step_s, fault, advice, asked })
    }));
    findings
}

/// That one motion in ten errs much more than the median. Of earthquake-like motions nearly every
/// rigid body's do: it is said where the program was asked for, its line has both numbers.
fn spread<U>(row: &ProgramRow<U>) -> Option<Finding> {
    let (errors, earthquakes) = row.spreads().filter(|(_, like)| row.asked || !like)?;
    let [median, ninety] = errors.peak;
    Some(Finding::ProgramSpread {
        program: row.program(),
        step_s: row.step_s,
        median: median?,
        ninety: ninety?,
        motions: errors.histories,
        earthquakes,
        asked: row.asked,
    })
}

/// That a program does not get through one history in twenty, of all that it was tried on.
pub(crate) fn lost<U>(row: &ProgramRow<U>, asked: bool) -> Option<Finding> {
    if matches!(row.not_to_be_used(), Some(NotToBeUsed { fault: ProgramFault::Lost { .. }, .. })) {
        return None;
    }
    let [lost, histories] = row.expected.lost();
    let many = lost as f64 > (1.0 - THROUGH) * histories as f64;
    let (program, step_s, csi) = (row.program(), row.step_s, row.is_csi());
    many.then_some(Finding::ProgramLoses { program, step_s, lost, histories, csi, asked })
}

/// By how much a change of 0.1 % moves the motion on the record (NRMSE), where that is so much that
/// what a program errs there tells nothing of its springs.
fn moved_by_little(findings: &[FiledFinding]) -> Option<f64> {
    findings.iter().find_map(|filed| match filed.finding {
        Finding::IllConditioned {
            moved_by_width, moved_by_scale, moved_by_restitution, ..
        } => {
            let restitution = moved_by_restitution.unwrap_or(0.0);
            Some(moved_by_width.max(moved_by_scale).max(restitution))
        }
        _ => None,
    })
}

#[cfg(test)]
mod tests;
