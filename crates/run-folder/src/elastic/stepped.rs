//! Decks of an elastic structure for programs with steps of one size, and what such steps find.

use super::{ElasticRun, deck_of};
use decks::{
    ACCURACY, CornerHistory, CornerProgram, DeckFormat, EvenEnds, ExportError, SteppedDeck,
    samples_to,
};
use frames::assembled::{Assembled, Sway, errors};
use parameters::program::{CornerUnits, ProgramOnRecord, ProgramRow};
use report::predictable_to;
use results::FiledFinding;
use strong_motion::Record;

/// The deck for a program with fixed time steps, on its springs. It compares its history up to
/// when the motion can be predicted, `until` (s); all of it if there is no such time.
///
/// # Errors
/// As of a deck whose steps follow touches; an integrator that the format has not.
pub fn stepped_deck(
    assembled: &Assembled,
    program: &CornerProgram,
    record: &Record,
    format: DeckFormat,
    until: Option<f64>,
) -> Result<SteppedDeck, ExportError> {
    let history = program.history_in_deck(assembled, record, format)?;
    stepped_deck_of((assembled, program), record, format, &history, until)
}

fn stepped_deck_of(
    (assembled, program): (&Assembled, &CornerProgram),
    record: &Record,
    format: DeckFormat,
    CornerHistory { coordinates, gives_up_s, falls_s, foretold_s }: &CornerHistory,
    until: Option<f64>,
) -> Result<SteppedDeck, ExportError> {
    let compared = [until, *foretold_s].into_iter().flatten().min_by(f64::total_cmp);
    let ends = EvenEnds {
        gives_up_s: *gives_up_s,
        falls_s: *falls_s,
        compared_by_steps: compared != until,
    };
    let springs = (&program.row.units.chains()[..], Some((program, ends)));
    let text = deck_of(assembled, springs, record, (coordinates, compared), (format, ACCURACY))?;
    Ok(SteppedDeck { text, gives_up_s: *gives_up_s, until })
}

impl ElasticRun {
    /// What a program with fixed time steps would find on the record, beside the reference: up to
    /// when its motion can be predicted, these being the findings.
    pub(super) fn program_on_record(&self, findings: &[FiledFinding]) -> Option<ProgramOnRecord> {
        let history = self.program_history.as_ref()?;
        let CornerHistory { coordinates, gives_up_s, falls_s, .. } = history;
        let frame = &self.assembled.frame;
        let tops = self.assembled.watched.iter().map(|watched| watched.top);
        let top = |q: &Vec<f64>| {
            tops.clone().map(|top| frame.displacement(top, q)[0].abs()).fold(0.0, f64::max)
        };
        let until = predictable_to(findings);
        let samples = samples_to(until, self.record.dt, self.record.len());
        let stands = falls_s.is_none_or(|falls| until.is_some_and(|until| until < falls));
        let whole = stands
            && coordinates.len() >= samples
            && self.answer.histories.falls(self.assembled.structure.body().alpha()).is_none();
        let found = coordinates.iter().take(samples).map(top).fold(0.0, f64::max);
        let pair = self.parts().foretold_peaks(findings);
        let reference = match pair.foretold {
            Some(part) => part.top_displacement_m[0],
            None => pair.reference.top_displacement_m,
        };
        let on = ProgramOnRecord::of(whole.then_some([found, reference]), *gives_up_s);
        let on = ProgramOnRecord { falls_s: *falls_s, ..on };
        let found = self.assembled.sways(coordinates.iter().map(Vec::as_slice));
        let sways = &self.answer.histories.sways;
        let reference: Vec<Sway> = sways.iter().map(|[reference, _]| reference.clone()).collect();
        let [rotations, _] = errors(&reference, &found, samples);
        // of a structure that has not lifted the reference has no rotation to speak of
        let lifts = self.answer.histories.reference.history.first_lift();
        let rocks = lifts.is_some_and(|lifts| until.is_none_or(|until| lifts < until));
        Some(if rocks { on.with_history(rotations) } else { on })
    }

    /// A deck for a program with fixed time steps.
    pub(super) fn stepped(
        &self,
        row: &ProgramRow<CornerUnits>,
        format: DeckFormat,
    ) -> Result<SteppedDeck, ExportError> {
        let until = predictable_to(&self.parameters.findings);
        let program = CornerProgram::even(row);
        match self.program_history.as_ref().filter(|_| program.is_of(format)) {
            Some(history) => {
                let model = (&self.assembled, &program);
                stepped_deck_of(model, &self.record, format, history, until)
            }
            None => stepped_deck(&self.assembled, &program, &self.record, format, until),
        }
    }
}
