//! Plain tables: k1, k2, m2 and c under every foot or corner, in both directions.

use std::fmt::Write;

use super::{model::digits, stepping::EvenSteps};
use dynamics::spring::{Chain, Springs};
use files::message::quantity;

/// Characters of a line of a note.
const LINE: usize = 92;

/// A foot or corner by name, and the units under it.
pub(super) type NamedSprings = (String, Springs<Chain>);

/// Place, direction and numbers of every unit.
fn rows(places: &[NamedSprings]) -> impl Iterator<Item = [String; 6]> {
    places.iter().flat_map(|(place, Springs { vertical, horizontal })| {
        [("vertical", vertical), ("horizontal", horizontal)].map(
            |(direction, &Chain { k1, k2, m2, c })| {
                let [k1, k2, m2, c] = [k1, k2, m2, c].map(digits);
                [place.clone(), direction.to_string(), k1, k2, m2, c]
            },
        )
    })
}

/// What steps have besides their size.
fn substeps(at_touches: usize) -> String {
    match at_touches {
        1 => String::new(),
        count => format!(" with {count} substeps at touches"),
    }
}

/// One line a unit, SI units in the header; last the steps that the springs are for.
pub(super) fn csv(even: Option<&EvenSteps>, places: &[NamedSprings]) -> String {
    let mut text =
        String::from("foot,direction,k1_n_per_m,k2_n_per_m,m2_kg,c_ns_per_m,for_steps\n");
    let steps = match even {
        None => "shortened towards touches".into(),
        Some(even @ EvenSteps { step, integrator, touches, .. }) => {
            let warning = even.warning().map_or("", |_| " (NOT to be used: see the report)");
            format!("{}{} by {integrator}{warning}", quantity(*step, "s"), substeps(*touches))
        }
    };
    for row in rows(places) {
        text.push_str(&format!("{},{steps}\n", row.join(",")));
    }
    text
}

/// What springs are for whose steps follow touches.
const FOR_OPENSEES: &str = "These springs are for the OpenSees deck of the same run, which \
    shortens its steps towards touches (TRBDF2).\nA program with steps of one size needs others: \
    those of \
    `tune export --stepping even`, in a run's folder springs_even.md.\n\n";

/// A table to read and to paste, with the unit's picture and what the springs are
/// for: the steps of one size, if they are for such.
pub(super) fn markdown(title: &str, even: Option<&EvenSteps>, places: &[NamedSprings]) -> String {
    let mut text = format!("# Ground springs\n\n{title}\n\n");
    text.push_str(
        "Under each foot, vertically and horizontally: foot - gap, k1 - m2 - (k2 parallel with c) \
            - ground.\n",
    );
    text.push_str(
        "The gaps press and never pull; the horizontal k1 acts only while its foot presses.\n\n",
    );
    let steps = |even: &EvenSteps| {
        let warning = even.warning().map_or(String::new(), |why| format!("**{why}.**\n\n"));
        format!(
            "These springs are for a program with steps of {}{} ({}).\n\n{warning}",
            quantity(even.step, "s"),
            substeps(even.touches),
            even.integrator
        )
    };
    text.push_str(&even.map_or(FOR_OPENSEES.into(), steps));
    text.push_str(
        "| foot | direction | k1 [N/m] | k2 [N/m] | m2 [kg] | c [N s/m] |\n\
            |---|---|---|---|---|---|\n",
    );
    for row in rows(places) {
        // writing to a String cannot fail
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
    text
}

/// Words in lines, with this between them.
pub(super) fn lines(words: &str, between: &str) -> String {
    let mut text = String::new();
    let mut long = 0;
    for word in words.split(' ') {
        let (space, size) = if long == 0 { ("", 0) } else { (" ", 1) };
        let fits = long + size + word.len() <= LINE;
        text += if fits { space } else { between };
        text += word;
        long = if fits { long + size } else { 0 } + word.len();
    }
    text
}
