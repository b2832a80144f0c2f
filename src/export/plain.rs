//! Plain tables: k1, k2, m2 and c of every foot and direction.

use std::fmt::Write;

use super::model::{Model, digits};
use crate::spring::Chain;

/// Foot and direction of every chain.
fn rows<'a>(model: &'a Model) -> impl Iterator<Item = (&'static str, &'static str, &'a Chain<f64>)> {
    let (v, h) = (&model.springs.vertical, &model.springs.horizontal);
    [("left", "vertical", v), ("left", "horizontal", h), ("right", "vertical", v), ("right", "horizontal", h)]
        .into_iter()
}

/// One line a chain, SI units in the header.
pub(super) fn csv(model: &Model) -> String {
    let mut text = String::from("foot,direction,k1_n_per_m,k2_n_per_m,m2_kg,c_ns_per_m\n");
    for (foot, direction, chain) in rows(model) {
        let Chain { k1, k2, m2, c } = *chain;
        // writing to a String does not fail
        let _ = writeln!(text, "{foot},{direction},{},{},{},{}", digits(k1), digits(k2), digits(m2), digits(c));
    }
    text
}

/// A table to read and to paste, with the chain's picture.
pub(super) fn markdown(model: &Model) -> String {
    let mut text = format!("# Ground springs\n\n{}\n\n", model.title());
    text.push_str(
        "Under each foot, vertically and horizontally: foot - gap, k1 - m2 - (k2 parallel with c) - ground.\n",
    );
    text.push_str("The gaps press and never pull; the horizontal k1 acts only while its foot presses.\n\n");
    text.push_str("| foot | direction | k1 [N/m] | k2 [N/m] | m2 [kg] | c [N s/m] |\n|---|---|---|---|---|---|\n");
    for (foot, direction, chain) in rows(model) {
        let Chain { k1, k2, m2, c } = *chain;
        let _ = writeln!(
            text,
            "| {foot} | {direction} | {} | {} | {} | {} |",
            digits(k1),
            digits(k2),
            digits(m2),
            digits(c)
        );
    }
    text
}
