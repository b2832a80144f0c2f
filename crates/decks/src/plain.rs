//! Plain tables: k1, k2, m2 and c under every foot or corner, in both directions, and what a model
//! that is typed by hand needs besides.

use std::fmt::Write;

use super::{model::digits, stepping::EvenSteps};
use dynamics::spring::{Chain, Springs};
use files::message::{quantity, significant};
use frames::frame::FrameLayout;

/// Characters of a line of a note.
const LINE: usize = 92;

/// A foot or corner by name, its place across (m), and the units under it.
pub(super) type NamedSprings = (String, f64, Springs<Chain>);

/// Name, place, direction and numbers of every unit.
fn rows(places: &[NamedSprings]) -> impl Iterator<Item = [String; 7]> {
    places.iter().flat_map(|(name, x, Springs { vertical, horizontal })| {
        [("vertical", vertical), ("horizontal", horizontal)].map(
            |(direction, &Chain { k1, k2, m2, c })| {
                let [k1, k2, m2, c] = [k1, k2, m2, c].map(digits);
                [name.clone(), significant(*x, 7), direction.to_string(), k1, k2, m2, c]
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

/// The test of an iteration: its limit, and of what.
fn test(even: &EvenSteps) -> (f64, &'static str) {
    match even.unbalance {
        Some(most) => (most, "unbalance over weight"),
        None => (even.tolerance(), "change of place in m"),
    }
}

/// One line a unit, SI units in the header; last the steps that the springs are for, and how a
/// program that takes them is to iterate.
pub(super) fn csv(even: Option<&EvenSteps>, places: &[NamedSprings]) -> String {
    let mut head =
        String::from("foot,x_m,direction,k1_n_per_m,k2_n_per_m,m2_kg,c_ns_per_m,for_steps");
    let steps = match even {
        None => "shortened towards touches".into(),
        Some(even @ EvenSteps { step, integrator, touches, .. }) => {
            head += ",substeps,newton_iterations,tolerance,tolerance_is_of";
            let warning = even.warning().map_or("", |_| " (NOT to be used: see the report)");
            let (limit, of) = test(even);
            format!(
                "{}{} by {integrator}{warning},{},{},{limit:e},{of}",
                quantity(*step, "s"),
                substeps(*touches),
                even.substeps,
                even.newton
            )
        }
    };
    let mut text = head + "\n";
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

/// What someone who types the model needs to know of a unit.
const BESIDES: &str = "
## What a model needs besides

- m2 has no weight: gravity does not act on it. The ground's acceleration does, as on every mass: \
the horizontal motion on the m2 of a horizontal unit, the vertical motion on that of a vertical one.
- One node under each foot carries both m2, one in each direction. It does not turn.
- The vertical k1 presses and never pulls. When it opens the horizontal k1 lets go; when the foot \
lands it takes hold anew where the foot is, and does not pull it back to where it stood. A foot \
that presses does not slide.
- The geometry is that of large displacements: the weight's moment on the leaning structure is \
what makes it rock.
";

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
        let halved = match even.substeps {
            0 | 1 => "no step is halved".into(),
            n => format!("a step that fails is halved, down to 1/{} of it", 1_usize << n.ilog2()),
        };
        let limit = match even.unbalance {
            Some(most) => format!("an unbalance below {} of the weight", significant(most, 3)),
            None => format!("a change of place below {} m", significant(even.tolerance(), 3)),
        };
        format!(
            "These springs are for a program with steps of {}{} ({}); {halved}; Newton's \
                iteration, its matrix formed anew each time, at most {} times, to {limit}.\
                \n\n{warning}",
            quantity(even.step, "s"),
            substeps(even.touches),
            even.integrator.words(),
            even.newton
        )
    };
    text.push_str(&even.map_or(FOR_OPENSEES.into(), steps));
    text.push_str(
        "| foot | x [m] | direction | k1 [N/m] | k2 [N/m] | m2 [kg] | c [N s/m] |\n\
            |---|---|---|---|---|---|---|\n",
    );
    for row in rows(places) {
        // writing to a String cannot fail
        let _ = writeln!(text, "| {} |", row.join(" | "));
    }
    text + BESIDES
}

/// The beams of an elastic structure, with what damps them.
pub(super) fn beams(layout: &FrameLayout) -> String {
    let mut text = String::from(
        "\n## Beams\n\n\
        | beam | from x, z [m] | to x, z [m] | EA [N] | EI [N m2] | GA_s [N] \
        | axial damping [s] | damping of bending [s] |\n|---|---|---|---|---|---|---|---|\n",
    );
    for (i, member) in layout.members.iter().enumerate() {
        let s = &member.section;
        let [from, to] = member.ends.map(|end| {
            let [x, z] = end.place.map(|x| significant(x, 6));
            format!("{x}, {z}")
        });
        let shear = if s.shear.is_finite() { digits(s.shear) } else { "rigid".into() };
        let [axial, bending] =
            [s.axial_damping / s.axial, s.bending_damping / s.bending].map(digits);
        let [ea, ei] = [s.axial, s.bending].map(digits);
        let _ = writeln!(
            text,
            "| {} | {from} | {to} | {ea} | {ei} | {shear} | {axial} | {bending} |",
            i + 1
        );
    }
    text + "\nDamping is proportional to stiffness, beam by beam: the axial force is EA times \
        (strain + axial damping x its rate), the moment EI times (curvature + damping of bending x \
        its rate); GA_s is damped as EI. There is none proportional to mass, so that a rotation of \
        the whole structure meets none.\n"
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
