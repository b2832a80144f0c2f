//! What `tune run` leaves of an elastic structure: tables, histories, figures, the deck, the page.

use std::path::Path;

use crate::{
    FolderError,
    folder::{Folder, identity},
    models, pictures as rigid_pictures,
    rigid::{Output, write_report},
    tables::{Instants, csv_row},
    texts::RunTexts,
};
use cases::{Asked, ElasticCase};
use decks::{
    ACCURACY, CornerHistory, CornerProgram, DeckFormat, ElasticDeck, EvenEnds, ExportError,
    samples_to,
};
use dynamics::spring::{Chain, Springs};
use figures::Figure;
use frames::{
    answer::{ElasticAnswer, ElasticHistories},
    assembled::{Assembled, Sway, Watched},
    fem::ElasticHistory,
};
use parameters::{
    RecordRow,
    elastic::{ElasticAssessment, ElasticParameters, OnRecord},
    program::{CornerUnits, ProgramRow},
};
use report::{
    Run,
    elastic::{ElasticParts, design_forces, largest, title},
    filed_of_elastic,
    markdown::markdown,
    page::page,
    predictable_to,
    program::with_verdict,
    summary,
};
use rocking::members::Members;
use springs::elastic::{ElasticTuned, program::ElasticProgramSprings};
use strong_motion::Record;

mod bearing;
mod demands;
mod feet;
pub mod pictures;
mod stepped;
pub mod words;

pub use stepped::stepped_deck;

use bearing::ForceQuantities;

/// Drifts below this share of the structure's size are rounding: there is nothing to compare with
/// them.
const ROUNDING: f64 = 1e-12;

/// A job done.
pub struct ElasticRun {
    /// What was asked.
    pub case: ElasticCase,
    /// The structure, ready to compute with.
    pub assembled: Assembled,
    /// Its springs.
    pub tuned: ElasticTuned,
    /// The part of the record that is used, scaled.
    pub record: Record,
    /// Histories, forces and errors on the record.
    pub answer: ElasticAnswer,
    /// The friction coefficient that the ground offers.
    friction: f64,
    /// What the structure bears.
    bearing: ForceQuantities,
    /// Of the program with fixed time steps, by an emulation.
    program_history: Option<CornerHistory>,
    /// But for the record: where that is to be found depends on the folder.
    pub parameters: ElasticParameters,
}

/// What is filed of springs without a record.
pub fn springs_alone(
    assembled: &Assembled,
    tuned: &ElasticTuned,
    asked: Asked,
) -> ElasticParameters {
    let place =
        |(i, springs): (usize, &Springs<Chain>)| (assembled.layout.corners[i].place[0], *springs);
    let corners: Vec<_> = tuned.springs.corners.iter().enumerate().map(place).collect();
    let Asked { by: judged_by, error: accuracy } = asked;
    let assessment =
        ElasticAssessment { judged_by, accuracy, reached: tuned.reached, measured: tuned.measured };
    ElasticParameters {
        assessment: Some(assessment),
        findings: filed_of_elastic(tuned.findings(asked)),
        program: tuned.program.as_ref().map(|program| program_row(assembled, program)),
        ..ElasticParameters::new(assembled.structure, tuned.springs.omega_n_hz, &corners)
            .with_members(assembled.members)
    }
}

/// Springs for a program with fixed time steps, as they are filed.
fn program_row(assembled: &Assembled, program: &ElasticProgramSprings) -> ProgramRow<CornerUnits> {
    let places = assembled.layout.corners.iter().map(|corner| corner.place[0]);
    let row = ProgramRow::of_corners(program, assembled.structure.mass(), places);
    ProgramRow { without_deck: assembled.members != Members::default(), ..row }.judged()
}

/// The deck that is to find this history, up to when it can be foretold (s) if not to its end; in a
/// format, its steps for an accuracy.
pub fn deck(
    assembled: &Assembled,
    springs: &[Springs<Chain>],
    record: &Record,
    (history, until): (&ElasticHistory, Option<f64>),
    (format, accuracy): (DeckFormat, f64),
) -> Result<String, ExportError> {
    deck_of(assembled, (springs, None), record, (&history.q, until), (format, accuracy))
}

/// The same of any springs and history, which is compared up to a time (s) if one is given.
fn deck_of(
    assembled: &Assembled,
    (springs, program): (&[Springs<Chain>], Option<(&CornerProgram, EvenEnds)>),
    record: &Record,
    (history, until): (&[Vec<f64>], Option<f64>),
    (format, accuracy): (DeckFormat, f64),
) -> Result<String, ExportError> {
    let (frame, top) =
        (&assembled.frame, assembled.watched.first().map_or(0, |watched| watched.top));
    let at = |q: &Vec<f64>| {
        let [x, z, _] = frame.displacement(top, q);
        [x, z]
    };
    let motion: Vec<[f64; 2]> = history.iter().map(at).collect();
    ElasticDeck {
        title: &title(&assembled.structure),
        layout: &assembled.layout,
        frame,
        springs,
        record,
        samples: motion.len(),
        compared: samples_to(until, record.dt, motion.len()),
        top: (top, &motion),
        alpha: assembled.structure.body().alpha(),
        frequency_hz: assembled.structure.fixed_base_frequency_hz(),
        accuracy,
        program,
    }
    .text(format)
}

impl ElasticRun {
    /// All that is said and saved of an answer.
    pub fn new(
        case: ElasticCase,
        assembled: Assembled,
        tuned: ElasticTuned,
        record: Record,
        answer: ElasticAnswer,
        friction: f64,
    ) -> Self {
        let alpha = assembled.structure.body().alpha();
        let ElasticHistories { reference, fem, sways, .. } = &answer.histories;
        let [rotations, drifts]: [fn(&Sway) -> &[f64]; 2] =
            [|sway| &sway.rotation, |sway| &sway.drift];
        let largest = |k: usize, of: fn(&Sway) -> &[f64]| largest(sways, k, of);
        let [rotation, drift] =
            answer.errors.map(|error| Some(error).filter(|error| error.is_finite()));
        let on_record = OnRecord {
            compared_s: answer.compared.seconds,
            whole: answer.compared.whole(),
            foretold_s: reference.foretold_seconds(record.dt),
            slides_on_s: reference.slides_on(),
            softer_omega_n_hz: tuned.softer_hz,
            // rotations of a structure that stands are rounding
            nrmse_rotation: rotation.filter(|_| reference.history.lifts()),
            nrmse_drift: drift.filter(|_| largest(0, drifts) > ROUNDING * assembled.frame.span()),
            peak_ratio_reference: largest(0, rotations) / alpha,
            peak_ratio_fem: largest(1, rotations) / alpha,
            peak_drift_reference_m: largest(0, drifts),
            peak_drift_fem_m: largest(1, drifts),
            lifts_s: reference.history.first_lift(),
            landings_reference: reference.history.landings().count(),
            touches_fem: fem.contacts.iter().filter(|contact| contact.touches).count(),
            energy_residual: fem.energy_residual,
            near: answer.ensemble,
        };
        let bearing = ForceQuantities::new(&assembled, &answer, record.dt);
        let mut parameters = ElasticParameters {
            on_record: Some(on_record),
            ..springs_alone(&assembled, &tuned, case.asked)
        };
        // the check of design forces on springs at 4 Omega_n is their error, whatever springs were
        // chosen by
        if let Some(errors) =
            parameters.assessment.as_mut().and_then(|a| a.measured.record.as_mut())
        {
            errors.peaks = errors.peaks.map(|peaks| peaks.with_forces(answer.design.error()));
        }
        let row = parameters.program.as_ref();
        let program_history =
            row.and_then(|row| CornerProgram::even(row).history(&assembled, &record).ok());
        let mut run = Self {
            case,
            assembled,
            tuned,
            record,
            answer,
            friction,
            bearing,
            program_history,
            parameters,
        };
        run.parameters.peaks = Some(run.parts().peaks());
        run.parameters.design_forces =
            Some(design_forces(&run.assembled.structure, &run.answer.design));
        let (findings, asked) = (run.parts().findings(&run.parameters), run.case.program.is_some());
        let on_record = run.program_on_record(&filed_of_elastic(findings.clone()));
        if let Some(row) = &mut run.parameters.program {
            row.on_record = on_record;
        }
        let row = &mut run.parameters.program;
        run.parameters.findings = filed_of_elastic(with_verdict(findings, row.as_mut(), asked));
        run.parameters.peaks = Some(run.parts().foretold_peaks(&run.parameters.findings));
        let until = predictable_to(&run.parameters.findings);
        run.parameters.design_forces =
            run.parameters.design_forces.map(|forces| forces.foretold_to(until));
        run
    }

    /// Write everything into a folder, which is made; `files` are all that it can be.
    pub fn save(
        &self,
        out: &Path,
        files: &[&'static str],
        output: Output,
    ) -> Result<Vec<String>, FolderError> {
        let excitation = &self.case.excitation;
        let asked = (excitation.scale, excitation.duration_s, output);
        let parts: [&dyn std::fmt::Debug; 3] =
            [&self.parameters, &excitation.record.fingerprint(), &asked];
        let folder = Folder::begin(out, "run", files, identity(&parts))?;
        let parameters = self.filed(out);
        let run = self.said(parameters.clone());
        let out = folder.path();
        let texts = self.tables_and_decks(&parameters, &run)?;
        texts.write(out)?;
        let figures: Vec<Figure> = if output.figures { pictures::draw(self)? } else { Vec::new() };
        rigid_pictures::save(out, &figures)?;
        let run = run.with_decks(&texts.left_out);
        write_report(out, output, &run, &figures)?;
        folder.finish()?;
        Ok(texts.left_out)
    }

    /// Everything that [`ElasticRun::save`] writes but figures, as texts; `out` is the folder that
    /// paths start from.
    ///
    /// # Errors
    /// A deck that cannot be made.
    pub fn texts(&self, out: &Path) -> Result<RunTexts, FolderError> {
        let parameters = self.filed(out);
        let run = self.said(parameters.clone());
        let mut texts = self.tables_and_decks(&parameters, &run)?;
        let run = run.with_decks(&texts.left_out);
        texts.files.push(("report.html".into(), page(&run, &[])));
        Ok(texts)
    }

    fn tables_and_decks(
        &self,
        parameters: &ElasticParameters,
        run: &Run,
    ) -> Result<RunTexts, FolderError> {
        let tables = RunTexts::of([
            ("parameters.json", parameters.to_json()),
            ("parameters.md", markdown(run)),
            ("summary.csv", summary(run).csv()),
            ("history.csv", self.history()),
            ("members.csv", demands::csv(self, Instants::Samples)),
            ("members_envelopes.csv", demands::csv(self, Instants::Envelopes)),
        ]);
        let program = self.parameters.program.as_ref();
        let decks = models::decks(|format| self.deck(format))?;
        let stepped = |row: &_, format| self.stepped(row, format);
        let even = models::even_decks(program, &self.record, stepped)?;
        Ok(tables.and(decks).and(even))
    }

    /// All that is said of it; `parameters` are those filed.
    pub fn said(&self, parameters: ElasticParameters) -> Run {
        self.parts().said(parameters)
    }

    fn parts(&self) -> ElasticParts<'_> {
        let Self { case, assembled, record, answer, friction, .. } = self;
        ElasticParts {
            case,
            assembled,
            record,
            springs: &self.tuned.springs.corners,
            answer,
            friction: *friction,
        }
    }

    /// What parameters.json holds in a folder.
    pub fn filed(&self, out: &Path) -> ElasticParameters {
        let record = Some(RecordRow::new(&self.case.excitation, &self.record, out));
        ElasticParameters { record, ..self.parameters.clone() }
    }

    /// Displacement across of the node above every base, in the reference and on the springs (m).
    fn tops(&self) -> Vec<[Vec<f64>; 2]> {
        let ElasticHistories { reference, fem, .. } = &self.answer.histories;
        let frame = &self.assembled.frame;
        let across = |q: &[f64], top: usize| frame.displacement(top, q)[0];
        let of = |&Watched { top, .. }: &Watched| {
            let reference = reference.history.q.iter().map(|q| across(q.as_slice(), top));
            let fem = fem.q.iter().map(|q| across(q, top));
            [reference.collect(), fem.collect()]
        };
        self.assembled.watched.iter().map(of).collect()
    }

    /// A deck whose steps follow touches.
    fn deck(&self, format: DeckFormat) -> Result<String, ExportError> {
        let corners = &self.tuned.springs.corners;
        let until = predictable_to(&self.parameters.findings);
        let fem = (&self.answer.histories.fem, until);
        deck(&self.assembled, corners, &self.record, fem, (format, ACCURACY))
    }

    /// `history.csv`: rotation and drift of every base in the reference and on the springs, uplift
    /// of every corner on them, how far feet have moved, and the top displacement above every base
    /// in both.
    fn history(&self) -> String {
        let ElasticHistories { fem, sways, .. } = &self.answer.histories;
        let name = |what: &str, i: usize| {
            if sways.len() > 1 { format!("{what}_{}", i + 1) } else { what.to_string() }
        };
        let mut head = vec!["t".to_string()];
        for (i, _) in sways.iter().enumerate() {
            for model in ["reference", "fem"] {
                head.extend([
                    name(&format!("theta_{model}"), i),
                    name(&format!("drift_{model}"), i),
                ]);
            }
        }
        let corners = self.assembled.layout.corners.len();
        head.extend((1..=corners).map(|i| format!("uplift_{i}")));
        let uplifts: Vec<Vec<f64>> =
            (0..corners).map(|i| fem.uplift(&self.assembled.frame, i)).collect();
        let feet = feet::moved(self);
        for model in ["reference", "fem"] {
            head.extend((1..=feet.len()).map(|i| format!("foot_{i}_moved_{model}")));
        }
        let tops = self.tops();
        for model in ["reference", "fem"] {
            head.extend((0..sways.len()).map(|i| name(&format!("top_{model}"), i)));
        }
        let mut out = head.join(",") + "\n";
        let longest =
            sways.iter().flatten().map(|sway| sway.rotation.len()).fold(fem.q.len(), usize::max);
        for sample in 0..longest {
            // a history may end before the other: its cells are empty then
            let at = |values: &[f64]| values.get(sample).copied().unwrap_or(f64::NAN);
            let mut row = vec![sample as f64 * self.record.dt];
            for pair in sways {
                for sway in pair {
                    row.extend([at(&sway.rotation), at(&sway.drift)]);
                }
            }
            row.extend(uplifts.iter().map(|uplift| at(uplift)));
            row.extend([0, 1].iter().flat_map(|k| feet.iter().map(|foot| at(&foot[*k]))));
            row.extend([0, 1].iter().flat_map(|k| tops.iter().map(|top| at(&top[*k]))));
            csv_row(&mut out, &row);
        }
        out
    }
}
