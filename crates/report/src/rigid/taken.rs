//! The structure as it was understood.

use crate::{Taken, reference};
use files::message::{quantity, significant};
use rocking::{
    members::Members,
    structure::{Kind, Structure},
};

/// The structure as it was understood.
pub(super) fn taken(structure: &Structure, restitution: f64, members: &Members) -> Taken {
    let body = structure.body::<f64>();
    let m = |x: f64| format!("{} m", significant(x, 4));
    let mass = quantity(structure.mass_kg, "kg");
    let (height, width) = (m(structure.height_m), m(structure.width_m));
    let text = match structure.kind {
        Kind::AFrame => format!("A-frame {height} high, feet {width} apart, {mass} at its apex"),
        Kind::Block => format!("block {} high, {width} wide, {mass}", m(2.0 * structure.height_m)),
    };
    let facts = [
        ("height h of the centre of mass", height),
        ("distance 2b of the feet", width),
        ("mass m", mass),
        (
            "rotational inertia about the centre of mass",
            format!("{} kg m2", significant(structure.rotational_inertia_kgm2, 4)),
        ),
        ("slenderness alpha", format!("{} rad", significant(body.alpha(), 4))),
        ("frequency p", format!("{} 1/s", significant(body.p(), 4))),
        ("restitution e", significant(restitution, 4)),
        lifts(structure, members),
    ];
    let facts = facts.into_iter().map(|(name, value)| (name.to_string(), value)).collect();
    Taken::new(text, facts)
}

/// The ground acceleration that lifts it, with its tendon and without.
fn lifts(structure: &Structure, members: &Members) -> (&'static str, String) {
    let g = |members: &Members| {
        format!("{} g", significant(reference::uplift_g(structure, members), 4))
    };
    let without = g(&Members::default());
    let slope = reference::uplift_g(structure, &Members::default());
    match members.tendon.filter(|tendon| tendon.pretension > 0.0) {
        Some(_) => {
            ("lifts at g tan(alpha) (1 + T/W)", format!("{}, without tendon {without}", g(members)))
        }
        None => match members.friction.filter(|friction| friction.coefficient < slope) {
            Some(friction) => {
                let slides = significant(friction.coefficient, 4);
                ("lifts at g tan alpha", format!("{without}, but slides from {slides} g"))
            }
            None => ("lifts at g tan alpha", without),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::{
        members::{Damper, Friction, Tendon},
        scalar::GRAVITY,
    };

    /// A wall 9 m by 6 m of weight W under a tendon of 0.48 W: m a_g h = (W + T) b.
    #[test]
    fn a_tendon_raises_what_lifts_a_wall_and_a_damper_does_not() {
        let wall = Structure::block(9.0, 6.0, 2.5e6 / GRAVITY).unwrap();
        let tendon = Some(Tendon { stiffness: 1.5e7, pretension: 1.2e6 });
        let tied = Members { tendon, ..Members::default() };
        let by_hand = (2.5e6 + 1.2e6) * 3.0 / (2.5e6 * 4.5);
        assert!((reference::uplift_g(&wall, &tied) - by_hand).abs() < 1e-12);
        let (_, told) = lifts(&wall, &tied);
        assert_eq!(told, "0.9867 g, without tendon 0.6667 g");
        // friction below b/h gives way before
        let on = |coefficient| Members {
            friction: Some(Friction { coefficient }),
            ..Members::default()
        };
        let statue = Structure::block(4.2, 1.1, 900.0).unwrap();
        assert_eq!(lifts(&statue, &on(0.22)).1, "0.2619 g, but slides from 0.22 g");
        assert_eq!(lifts(&statue, &on(0.3)).1, "0.2619 g");
        let damped = Members { damper: Some(Damper { c: 1e6 }), ..Members::default() };
        assert_eq!(lifts(&wall, &damped).1, "0.6667 g");
    }
}
