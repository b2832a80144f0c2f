//! Decks of bodies whose feet slip.

use super::*;
use rocking::members::Friction;

/// Below b/h = 0.1 the paper's frame slides: its deck searches along Newton's steps and takes more
/// of them; above it, and without friction, decks are as they were but for the coefficient.
#[test]
fn decks_of_bodies_that_slide_have_another_iteration() {
    let deck = |coefficient: f64, format| {
        let friction = Some(Friction { coefficient });
        let members = Members { friction, ..Members::default() };
        let parameters = parameters().with_members(members);
        let record = Record::el_centro();
        let model = DeckModel::new(&parameters, &record, &EXPECTED).unwrap();
        export_model(&model, format).unwrap()
    };
    for format in [DeckFormat::OpenSeesPy, DeckFormat::OpenSeesTcl] {
        let [slides, rocks] = [0.09, 0.11].map(|coefficient| deck(coefficient, format));
        assert_eq!(slides.matches("NewtonLineSearch").count(), 1, "{format:?}");
        assert!(!rocks.contains("NewtonLineSearch"), "{format:?}");
        let differ = slides.lines().zip(rocks.lines()).filter(|(a, b)| a != b).count();
        assert!(differ > 3 && slides.lines().count() == rocks.lines().count() + 1, "{differ}");
        let quarter = ["self.allowed = 0.25 * h", "set allowed [expr {0.25 * $h}]"];
        assert!(quarter.iter().any(|line| slides.contains(line)), "{format:?}");
        assert!(!quarter.iter().any(|line| rocks.contains(line)), "{format:?}");
    }
}
