//! Table 1 of the paper beside the springs of the paper's own structure.

use dynamics::spring::{Design, Springs};
use rocking::structure::{Kind, Structure};

/// The springs of Table 1, if this is the paper's structure.
pub fn of(structure: &Structure) -> Option<Springs<Design<f64>>> {
    let paper = Structure::paper();
    let same = structure.kind == Kind::AFrame
        && (structure.height_m, structure.width_m, structure.mass_kg)
            == (paper.height_m, paper.width_m, paper.mass_kg);
    same.then(Springs::table_1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_structure_but_the_papers_has_table_1() {
        assert_eq!(of(&Structure::paper()), Some(Springs::table_1()));
        assert!(of(&Structure::a_frame(20.0, 4.0, 1e5).unwrap()).is_none());
    }
}
