//! The end of the sheet: what to compare, and what a user would not expect.

use super::SapModel;
use crate::plain::lines;
use files::message::significant;

/// A range of displacements (m), least first.
fn range((most, least): (f64, f64)) -> String {
    format!("U1 from {} to {}", mm(least), mm(most))
}

fn mm(x: f64) -> String {
    format!("{} mm", significant(1e3 * x, 4))
}

/// What is to come out.
pub(crate) struct ToCompare {
    /// Of which joint, up to when.
    pub head: String,
    /// What is found by whom: its name, or none, and its words.
    pub found: Vec<(&'static str, String)>,
}

impl ToCompare {
    /// What the joint that is watched does.
    pub(crate) fn of(parts: &SapModel) -> Self {
        let [u, v] = parts.peaks;
        let until = parts.until.map_or(String::new(), |until| {
            format!(", to {} s (beyond, {})", significant(until, 4), parts.even.ends.beyond())
        });
        let head = format!(
            "To compare, joint {}, {}: after GRAVITY U3 = {}. In QUAKE{until}:",
            parts.watched,
            parts.watched_is,
            mm(parts.settled)
        );
        let mut found: Vec<_> = parts.topples().map(|topples| ("", topples)).into_iter().collect();
        let housner = parts.housner.and_then(|housner| housner.range);
        found.extend(housner.map(|u| ("Housner", range(u))));
        let steps = format!("{}, U3 at most {} above that", range(u), mm(v.0));
        found.push(("these steps (emulated)", steps));
        found.extend(parts.even.errors().map(|errors| ("", format!("Measured: {errors}."))));
        Self { head, found }
    }
}

/// The same for the sheet.
pub(super) fn expected(parts: &SapModel) -> String {
    const NAME: usize = 25;
    let ToCompare { head, found } = ToCompare::of(parts);
    let mut text = head + "\n";
    for (name, words) in found {
        let name = match name.is_empty() {
            true => String::new(),
            false => format!("{:<NAME$}", format!("{name}:")),
        };
        text += &format!("   {name}{}\n", lines(&words, "\n   "));
    }
    text + "   The screen and report.html of the run have the answer without springs, up to when a \
            motion can be\n   predicted.\n"
}

/// What a user must know, and would not expect.
pub(super) fn notes(parts: &SapModel) -> String {
    let mut all = vec![
        "No springs of a soil: these links make the landing what Housner's theory has it.",
        "The tolerance is loose on purpose: there are steps at whose end neither a foot on the \
         ground nor\n     one in the air fits its own force, and a tighter test stops there. It is \
         what a foot drops as\n     it lifts, on its joint and on its absorber.",
        "Event-to-event stepping is off on purpose: these springs were judged without it. \
         Emulated, it errs\n     less (docs/fixed-steps.md), but how the program finds events is \
         not published.",
        "The program's isolator has a shear force that follows its axial force; the tuned model \
         has a plain\n     spring that lets go when the foot lifts. With this friction they are \
         the same but in the air.",
    ];
    if parts.even.adds_inertia {
        all.push(
            "The inertia R2 at joint 3 belongs to these springs: such steps need some, and a point \
             mass has\n     none.",
        );
    }
    let pair = |i: usize| parts.bars[..i].iter().any(|bar| bar.joints == parts.bars[i].joints);
    if (0..parts.bars.len()).any(pair) {
        all.push(
            "Two frames between the same joints are meant so: the first bears the axial force, the \
             second\n     the moment and the shear, each with its own damping. A member's forces \
             are the sum of both.",
        );
    }
    if parts.sections.iter().any(|section| section.ahead > 0.0) {
        all.push(
            "Damping: stiffness coefficient of the material's viscous proportional damping \
             (VisStiff in tables),\n     a material for each value. It must not resist a rotation \
             of the whole structure: compare a free\n     rocking with and without it.",
        );
    }
    let damping = parts.damping.as_ref().map(|of| lines(of, "\n     "));
    all.extend(damping.as_deref());
    let lines: String = all.iter().map(|note| format!("   - {note}\n")).collect();
    format!("Notes.\n{lines}")
}
