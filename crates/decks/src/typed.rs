//! What someone who types the model needs besides springs and beams: joints with their masses and
//! weights, the load cases, what is to come out. Of the model that SAP2000's sheet has, in SI units
//! and in words for any program.

use std::fmt::Write;

use crate::{
    plain::NamedSprings,
    sap2000::{SapModel, ToCompare, of_any_program},
};
use files::message::significant;
use rocking::scalar::GRAVITY;

/// Digits of numbers that a user gave, or that follow from these by a product.
const DIGITS: usize = 7;

fn number(x: f64) -> String {
    significant(x, DIGITS)
}

/// Joints, load cases, and what to compare, below a table of springs of these places.
pub(crate) fn words(parts: &SapModel, places: &[NamedSprings]) -> String {
    format!("{}{}{}", joints(parts, places), cases(parts), compared(parts))
}

fn joints(parts: &SapModel, places: &[NamedSprings]) -> String {
    let mut text = String::from(
        "\n## Joints\n\n\
        | joint | what | x [m] | z [m] | mass, along x and z [kg] | rotational inertia [kg m2] \
        | weight, downwards [N] |\n|---|---|---|---|---|---|---|\n",
    );
    for joint in &parts.joints {
        let [x, z] = joint.place.map(number);
        let numbers = [joint.mass, joint.inertia, joint.mass * GRAVITY].map(|x| match x {
            0.0 => "-".to_string(),
            x => number(x),
        });
        // writing to a String cannot fail
        let _ = writeln!(
            text,
            "| {} | {} | {x} | {z} | {} |",
            joint.tag,
            what(parts, places, joint.tag),
            numbers.join(" | ")
        );
    }
    let weight = parts.joints.iter().map(|joint| joint.mass).sum::<f64>() * GRAVITY;
    text += &format!(
        "\nA joint that is rigid with another one is joined to it by a stiff arm. Together they \
         weigh {} N, g = {GRAVITY} m/s2",
        number(weight)
    );
    if let Some(share) = parts.even.unbalance {
        let [share, below] = [share, share * weight].map(|x| significant(x, 5));
        text += &format!("; the unbalance of {share} of it is {below} N");
    }
    text + ". The m2 of the springs above are additional masses, without weight.\n"
}

/// What a joint is: a foot or corner by its name, the one to compare, one on a stiff arm.
fn what(parts: &SapModel, places: &[NamedSprings], tag: usize) -> String {
    let mass = |tag: usize| parts.joints.iter().any(|joint| joint.tag == tag && joint.mass > 0.0);
    let foot = parts.feet.iter().zip(places).find(|(foot, _)| foot.joint == tag);
    let arm = parts.bars.iter().find_map(|bar| {
        let [a, b] = bar.joints;
        let rigid = parts.sections[bar.section].is_rigid() && !mass(tag);
        match tag {
            _ if !rigid => None,
            tag if tag == b => Some(a),
            tag if tag == a => Some(b),
            _ => None,
        }
    });
    let words = [
        foot.map(|(_, (name, ..))| name.clone()),
        (parts.watched == tag).then(|| parts.watched_is.to_string()),
        arm.map(|other| format!("rigid with joint {other}")),
    ];
    let words = words.into_iter().flatten().collect::<Vec<_>>().join(", ");
    if words.is_empty() { "-".into() } else { words }
}

fn cases(parts: &SapModel) -> String {
    let mut text = String::from(
        "\n## Load cases\n\n\
        - GRAVITY: the weights alone, slowly, with large displacements.\n\
        - QUAKE: the ground motion from there, by direct integration in the steps above.\n",
    );
    for (name, value) in of_any_program(parts) {
        text += &format!("  - {name}: {value}.\n");
    }
    text
}

fn compared(parts: &SapModel) -> String {
    let ToCompare { head, found } = ToCompare::of(parts);
    let item = |(name, words): &(&str, String)| match name.is_empty() {
        true => format!("- {words}\n"),
        false => format!("- {name}: {words}.\n"),
    };
    let found: String = found.iter().map(item).collect();
    format!("\n## What is to come out\n\nU1 is along x, U3 upwards. {head}\n\n{found}")
}
