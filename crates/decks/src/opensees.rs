//! OpenSees decks: the same model in Python and in Tcl, from two templates that explain every
//! choice in comments.

use super::{
    ExportError,
    language::{Language, PYTHON, TCL, record_note},
    model::{A_PAIR, DeckModel, LEG_STIFFNESS, digits},
};
use fixed_steps::contact::HOLDS;
use rocking::{
    members::{Members, slides},
    scalar::GRAVITY,
};

/// The deck for openseespy.
pub(super) fn python(model: &DeckModel) -> Result<String, ExportError> {
    fill(&PYTHON, include_str!("deck.py"), model)
}

/// The deck for OpenSees' Tcl interpreter.
pub(super) fn tcl(model: &DeckModel) -> Result<String, ExportError> {
    fill(&TCL, include_str!("deck.tcl"), model)
}

/// Steps of a sample at least while feet slip: their error is measured by what the feet rise, which
/// tells nothing of a slide. A block 0.9 m high slides by 37 mm and ends at 4.45 mm: with two at
/// 4.14 mm, with these at 4.40 mm.
const OF_A_SLIDE: usize = 20;

/// Whether feet slip, in steps that follow touches.
fn slips(model: &DeckModel) -> bool {
    let friction = model.members.friction.as_ref();
    model.even.is_none() && friction.is_some_and(|friction| slides(friction, &model.body()))
}

fn accuracy_note(model: &DeckModel) -> String {
    if model.accuracy < model.expected.accuracy {
        format!("{} was asked for, and small errors grow in this history", model.expected.accuracy)
    } else {
        "the steps follow from it".to_string()
    }
}

/// The template with the model's numbers.
fn fill(language: &Language, template: &str, model: &DeckModel) -> Result<String, ExportError> {
    let body = model.body();
    let (v, h) = (&model.springs.vertical, &model.springs.horizontal);
    let e = &model.expected;
    let Members { damper, tendon, friction } = model.members;
    let slides = slips(model);
    let (steps, steps_note) = match slides {
        true => (OF_A_SLIDE, "the error of steps tells nothing of a slide"),
        false => (A_PAIR, "more change nothing"),
    };
    let values = [
        ("TITLE", model.title()),
        ("OURS", "`tune simulate`".into()),
        ("GRAVITY", digits(GRAVITY)),
        ("HEIGHT", digits(body.height)),
        ("HALF_WIDTH", digits(body.half_width)),
        ("MASS", digits(body.mass)),
        ("INERTIA", digits(model.inertia)),
        ("INERTIA_NOTE", model.inertia_note().to_string()),
        ("K1_V", digits(v.k1)),
        ("K2_V", digits(v.k2)),
        ("C_V", digits(v.c)),
        ("M2_V", digits(v.m2)),
        ("K1_H", digits(h.k1)),
        ("K2_H", digits(h.k2)),
        ("C_H", digits(h.c)),
        ("M2_H", digits(h.m2)),
        ("LEG", digits(model.leg)),
        ("DAMPER_C", digits(damper.map_or(0.0, |d| d.c))),
        ("FRICTION", digits(friction.map_or(HOLDS, |f| f.coefficient))),
        ("DAMPER_ALOFT", digits(model.damper_aloft())),
        ("TENDON_K", digits(tendon.map_or(0.0, |t| t.stiffness))),
        ("TENDON_SLACK", digits(model.slack())),
        ("LEG_RATIO", LEG_STIFFNESS.to_string()),
        ("TOLERANCE", digits(model.even.map_or(model.tolerance, |even| even.tolerance()))),
        ("RECORD_DT", digits(model.record.dt)),
        ("ACCURACY", digits(model.accuracy)),
        ("ACCURACY_NOTE", accuracy_note(model)),
        ("LANDING", digits(model.landing)),
        ("RISE", digits(model.rise)),
        ("STEPS", steps.to_string()),
        ("STEPS_NOTE", steps_note.into()),
        ("SAMPLES", e.samples.to_string()),
        ("COMPARED", e.compared.to_string()),
        ("COMPARED_S", model.compared_s().to_string()),
        ("DURATION", model.duration().to_string()),
        ("SETTLED", digits(e.settled)),
        ("U_MAX", digits(e.u.0)),
        ("U_MIN", digits(e.u.1)),
        ("V_MAX", digits(e.v.0)),
        ("V_MIN", digits(e.v.1)),
        ("RECORD_NOTE", record_note(model.record)),
    ];
    language.fill(template, &values, model.record, model.even.as_ref(), slides)
}
