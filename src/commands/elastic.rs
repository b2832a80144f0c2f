//! What `tune run` leaves of an elastic structure: tables, histories, figures, the deck, the page.

use std::path::Path;

use super::{
    CommandError,
    common::csv_row,
    draw::{self, Figure},
    export,
    run::Output,
    write_file,
};
use crate::{
    case::ElasticCase,
    elastic::{
        answer::{ElasticAnswer, ElasticHistories},
        assembled::{Assembled, Sway},
        fem::ElasticHistory,
    },
    export::{ACCURACY, DeckFormat, ElasticDeck, ExportError},
    motion::peak,
    parameters::{
        RecordRow,
        elastic::{ElasticAssessment, ElasticParameters, OnRecord},
    },
    record::Record,
    spring::{Chain, Springs},
    tuning::elastic::ElasticTuned,
};

mod bearing;
mod demands;
mod page;
mod pictures;
pub(super) mod words;

use bearing::ForceQuantities;
use demands::Instants;

/// Drifts below this share of the structure's size are rounding: there is nothing to compare with them.
const ROUNDING: f64 = 1e-12;

/// A job done.
pub struct ElasticRun {
    pub case: ElasticCase,
    pub assembled: Assembled,
    pub tuned: ElasticTuned,
    /// The part of the record that is used, scaled.
    pub record: Record,
    pub answer: ElasticAnswer,
    /// What the structure bears.
    bearing: ForceQuantities,
    /// But for the record: where that is to be found depends on the folder.
    pub parameters: ElasticParameters,
}

/// What is filed of springs without a record.
pub fn springs_alone(assembled: &Assembled, tuned: &ElasticTuned, accuracy: f64) -> ElasticParameters {
    let place = |(i, springs): (usize, &Springs<Chain<f64>>)| (assembled.layout.corners[i].place[0], *springs);
    let corners: Vec<_> = tuned.springs.corners.iter().enumerate().map(place).collect();
    let assessment = ElasticAssessment { accuracy, reached: tuned.reached, measured: tuned.measured };
    ElasticParameters {
        assessment: Some(assessment),
        ..ElasticParameters::new(assembled.structure, tuned.springs.omega_n_hz, &corners)
            .with_members(assembled.members)
    }
}

impl ElasticParameters {
    /// Write the file and its tables; what to print.
    pub(super) fn save_alone(&self, out: &Path) -> Result<String, CommandError> {
        write_file(&out.join("parameters.json"), self.to_json().as_bytes())?;
        write_file(&out.join("parameters.md"), words::markdown(self).as_bytes())?;
        Ok(format!("{}\n{}\n", words::markdown(self), words::assessed(self).join("\n")))
    }
}

/// The deck that is to find this history, in a format, its steps for an accuracy.
pub(super) fn deck(
    assembled: &Assembled,
    springs: &[Springs<Chain<f64>>],
    record: &Record,
    history: &ElasticHistory,
    (format, accuracy): (DeckFormat, f64),
) -> Result<String, ExportError> {
    let (frame, top) = (&assembled.frame, assembled.watched.first().map_or(0, |watched| watched.top));
    let at = |q: &Vec<f64>| {
        let [x, z, _] = frame.displacement(top, q);
        [x, z]
    };
    let motion: Vec<[f64; 2]> = history.q.iter().map(at).collect();
    ElasticDeck {
        title: &words::title(&assembled.structure),
        layout: &assembled.layout,
        frame,
        springs,
        record,
        samples: motion.len(),
        top: (top, &motion),
        alpha: assembled.structure.body().alpha(),
        frequency_hz: assembled.structure.frequency_hz(),
        accuracy,
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
    ) -> Self {
        let alpha = assembled.structure.body().alpha();
        let ElasticHistories { reference, fem, sways, .. } = &answer.histories;
        let [rotations, drifts]: [fn(&Sway) -> &[f64]; 2] = [|sway| &sway.rotation, |sway| &sway.drift];
        let largest =
            |k: usize, of: fn(&Sway) -> &[f64]| sways.iter().map(|pair| peak(of(&pair[k])).abs()).fold(0.0, f64::max);
        let [rotation, drift] = answer.errors.map(|error| Some(error).filter(|error| error.is_finite()));
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
            landings_reference: reference.history.landings().count(),
            touches_fem: fem.contacts.iter().filter(|contact| contact.touches).count(),
            energy_residual: fem.energy_residual,
            near: answer.ensemble,
        };
        let bearing = ForceQuantities::new(&assembled, &answer, record.dt);
        let parameters =
            ElasticParameters { on_record: Some(on_record), ..springs_alone(&assembled, &tuned, case.accuracy) };
        Self { case, assembled, tuned, record, answer, bearing, parameters }
    }

    /// Write everything into a folder, which is there.
    pub fn save(&self, out: &Path, output: Output) -> Result<(), CommandError> {
        let parameters = self.filed(out);
        write_file(&out.join("parameters.json"), parameters.to_json().as_bytes())?;
        let tables = words::markdown(&parameters) + "\n" + &demands::markdown(self);
        write_file(&out.join("parameters.md"), tables.as_bytes())?;
        write_file(&out.join("history.csv"), self.history().as_bytes())?;
        write_file(&out.join("members.csv"), demands::csv(self, Instants::Samples).as_bytes())?;
        write_file(&out.join("members_envelopes.csv"), demands::csv(self, Instants::Envelopes).as_bytes())?;
        export::write_all(&out.join("decks"), |format| self.deck(format))?;
        let figures: Vec<Figure> = if output.figures { pictures::draw(self)? } else { Vec::new() };
        draw::save(out, &figures)?;
        if output.report {
            let page = page::ElasticPage { run: self, parameters: &parameters, figures: &figures };
            write_file(&out.join("report.html"), page.html().as_bytes())?;
        }
        Ok(())
    }

    fn filed(&self, out: &Path) -> ElasticParameters {
        let record = Some(RecordRow::new(&self.case.excitation, &self.record, out));
        ElasticParameters { record, ..self.parameters.clone() }
    }

    /// For the terminal.
    pub fn terminal(&self) -> String {
        let said = words::said(self).join("\n");
        format!("{}\n{}\n{said}\n", words::markdown(&self.parameters), demands::markdown(self))
    }

    fn deck(&self, format: DeckFormat) -> Result<String, ExportError> {
        let corners = &self.tuned.springs.corners;
        deck(&self.assembled, corners, &self.record, &self.answer.histories.fem, (format, ACCURACY))
    }

    /// `history.csv`: rotation and drift of every base in the reference and on the springs, uplift of every corner on them.
    fn history(&self) -> String {
        let ElasticHistories { fem, sways, .. } = &self.answer.histories;
        let name = |what: &str, i: usize| if sways.len() > 1 { format!("{what}_{}", i + 1) } else { what.to_string() };
        let mut head = vec!["t".to_string()];
        for (i, _) in sways.iter().enumerate() {
            for model in ["reference", "fem"] {
                head.extend([name(&format!("theta_{model}"), i), name(&format!("drift_{model}"), i)]);
            }
        }
        let corners = self.assembled.layout.corners.len();
        head.extend((1..=corners).map(|i| format!("uplift_{i}")));
        let uplifts: Vec<Vec<f64>> = (0..corners).map(|i| fem.uplift(&self.assembled.frame, i)).collect();
        let mut out = head.join(",") + "\n";
        let longest = sways.iter().flatten().map(|sway| sway.rotation.len()).fold(fem.q.len(), usize::max);
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
            csv_row(&mut out, &row);
        }
        out
    }
}
