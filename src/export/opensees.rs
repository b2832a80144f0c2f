//! OpenSees decks: the same model in Python and in Tcl, from two templates that explain every choice in comments.

use std::fmt::Write;

use super::model::{A_PAIR, LEG_STIFFNESS, Model, digits};
use crate::scalar::GRAVITY;

/// The deck for openseespy.
pub(super) fn python(model: &Model) -> String {
    let vertical = Vertical {
        loads: r#"
    # The vertical part, positive upwards, in the same way.
    ops.timeSeries("Path", 3, "-dt", RECORD_DT, "-values", *VERTICAL)
    ops.pattern("Plain", 3, 3)
    ops.load(APEX, 0.0, -MASS, 0.0)
    for foot, _ in FEET:
        ops.load(foot + ABSORBER, 0.0, -M2_V, 0.0)"#,
        around: ("VERTICAL = (\n", "\n)"),
    };
    fill(include_str!("deck.py"), super::STEPS, model, ",", &vertical)
}

/// The deck for OpenSees' Tcl interpreter.
pub(super) fn tcl(model: &Model) -> String {
    let vertical = Vertical {
        loads: r#"
    # The vertical part, positive upwards, in the same way.
    global m2v vertical
    timeSeries Path 3 -dt $recordDt -values $vertical -factor 1.0
    pattern Plain 3 3 "load 3 0.0 [expr {-$mass}] 0.0; load 11 0.0 [expr {-$m2v}] 0.0; load 12 0.0 [expr {-$m2v}] 0.0""#,
        around: ("set vertical {\n", "\n}"),
    };
    fill(include_str!("deck.tcl"), include_str!("steps.tcl"), model, "", &vertical)
}

/// A coefficient of friction at which no pressing foot ever slips, not even in the last microsecond before it lifts: with 1000
/// a foot that lifts lets its horizontal force go in 20 us instead of at once, and 3 s of a 2 m block are off by 3e-4.
const HOLDS: f64 = 1e7;

/// What a deck has where the ground moves vertically, too: the loads, and what stands before and after its samples.
struct Vertical {
    loads: &'static str,
    around: (&'static str, &'static str),
}

impl Vertical {
    /// Loads and samples; nothing without vertical motion.
    fn texts(&self, model: &Model, separator: &str) -> (String, String) {
        let Some(vertical) = &model.record.vertical else { return Default::default() };
        let (before, after) = self.around;
        let note = format!("\n# The vertical part, peak {:.4} g; m/s2, positive upwards\n", vertical.peak_g());
        (self.loads.to_string(), note + before + &rows(&vertical.accel, separator) + after)
    }
}

/// A record, four samples a line.
pub(super) fn rows(accel: &[f64], separator: &str) -> String {
    let lines = accel.chunks(4).map(|samples| {
        samples.iter().fold(String::from("   "), |mut line, &a| {
            // writing to a String does not fail
            let _ = write!(line, " {}{separator}", digits(a));
            line
        })
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn accuracy_note(model: &Model) -> String {
    if model.accuracy < model.expected.accuracy {
        format!("{} was asked for, and small errors grow in this history", model.expected.accuracy)
    } else {
        "the steps follow from it".to_string()
    }
}

/// Put the stepping routine and the model's numbers in the place of `@NAME@`.
fn fill(template: &str, routine: &str, model: &Model, separator: &str, vertical: &Vertical) -> String {
    let (loads, samples) = vertical.texts(model, separator);
    let body = model.body();
    let (v, h) = (&model.springs.vertical, &model.springs.horizontal);
    let e = &model.expected;
    let values = [
        ("TITLE", model.title()),
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
        ("DAMPER_C", digits(model.members.damper.map_or(0.0, |d| d.c))),
        ("FRICTION", digits(model.members.friction.map_or(HOLDS, |f| f.coefficient))),
        ("TENDON_K", digits(model.members.tendon.map_or(0.0, |t| t.stiffness))),
        ("TENDON_SLACK", digits(model.slack())),
        ("LEG_RATIO", LEG_STIFFNESS.to_string()),
        ("TOLERANCE", digits(model.tolerance)),
        ("RECORD_DT", digits(model.record.dt)),
        ("ACCURACY", digits(model.accuracy)),
        ("ACCURACY_NOTE", accuracy_note(model)),
        ("LANDING", digits(model.landing)),
        ("RISE", digits(model.rise)),
        ("STEPS", A_PAIR.to_string()),
        ("SAMPLES", e.samples.to_string()),
        ("DURATION", model.duration().to_string()),
        ("SETTLED", digits(e.settled)),
        ("U_MAX", digits(e.u.0)),
        ("U_MIN", digits(e.u.1)),
        ("V_MAX", digits(e.v.0)),
        ("V_MIN", digits(e.v.1)),
        ("RECORD_NOTE", model.record_note()),
        ("VERTICAL_LOADS", loads),
    ];
    let mut text = template.to_string();
    for (name, value) in values {
        text = text.replace(&format!("@{name}@"), &value);
    }
    text = text.replace("@ROUTINE@", routine.trim_end());
    // last and once: they are most of the text
    text.replacen("@VERTICAL@", &samples, 1).replacen("@RECORD@", &rows(&model.record.accel, separator), 1)
}
