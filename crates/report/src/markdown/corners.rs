//! What is said of the forces at one corner, and of how members move.

use super::super::{FiledParameters, Run, sentence};
use files::message::{percent, quantity, significant};
use results::{CornerForce, DesignForce, DesignForces};

/// What bounds the moment of a column on a footing, for the check that an engineer makes first.
pub(super) fn on_one_corner(forces: &DesignForces) -> Option<String> {
    (forces.column_base_moment_nm.is_some() && forces.sole_vertical_n.is_some()).then(|| {
        "On one corner the ground bears a moment of N b about the middle of a footing, 2b wide, N \
            the vertical force under it at that time. N has the footing's weight in it and, in a \
            landing, more than all of the weight; the footing's inertia and the shear times its \
            height come between. So the moment at a column's base can be above W b, and above the \
            column's own axial force times b."
            .into()
    })
}

/// Whether a rigid body has a tendon or dampers.
pub(super) fn members(run: &Run) -> bool {
    match &run.parameters {
        FiledParameters::Rigid(parameters) => parameters.members().act(),
        FiledParameters::Elastic(_) => false,
    }
}

/// Both forces of the ground at a corner of a rigid body, for its bearing, and what they leave out.
pub(super) fn at_corners(members: bool, forces: &DesignForces) -> Option<String> {
    let both = |force: Option<DesignForce>| {
        let force = force.filter(|force| force.holds)?;
        let CornerForce { horizontal_n, vertical_n } = force.corner?;
        let [across, press] = [horizontal_n, vertical_n].map(|x| quantity(x.abs(), "N"));
        Some(format!("{press} upwards with {across} across at {} s", significant(force.time_s, 4)))
    };
    let told = [(forces.corner_vertical_n, "vertical"), (forces.corner_horizontal_n, "horizontal")];
    let told: Vec<String> = told
        .into_iter()
        .filter_map(|(force, which)| Some(both(force)? + &format!(" (largest {which})")))
        .collect();
    let anchor = match members {
        true => {
            " Shear of the soles is what the corners bear: a tendon's pull at its anchor and a \
                damper's at its own go past them."
        }
        false => "",
    };
    (!told.is_empty()).then(|| {
        format!(
            "The ground on one corner, for its bearing: {}. Impulses of landings are not in it.\
                {anchor}",
            told.join("; ")
        )
    })
}

/// How far a tendon and dampers are drawn, and how fast.
pub(super) fn member_motions(forces: &DesignForces) -> Option<String> {
    let s = |time: f64| format!("at {} s", significant(time, 4));
    let tendon = forces.tendon_motion.map(|tendon| {
        format!(
            "the tendon is drawn by {} more than it stands {}: strain {}, {} with the pretension, \
                of one as long as the mass is high",
            quantity(tendon.elongation_m, "m"),
            s(tendon.time_s),
            percent(tendon.strain),
            percent(tendon.strain_with_pretension)
        )
    });
    let damper = forces.damper_motion.map(|damper| {
        format!(
            "a damper is drawn by {} {}, and moves at {} {}; it is never shorter than at rest",
            quantity(damper.elongation_m, "m"),
            s(damper.elongation_time_s),
            quantity(damper.velocity_m_per_s, "m/s"),
            s(damper.velocity_time_s)
        )
    });
    let told: Vec<String> = [tendon, damper].into_iter().flatten().collect();
    (!told.is_empty()).then(|| sentence(&format!("{}.", told.join("; "))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use results::DamperMotion;

    #[test]
    fn a_corner_has_both_forces_of_one_instant_and_one_that_is_withheld_none() {
        let at = |horizontal_n: f64, vertical_n: f64| DesignForce {
            corner: Some(CornerForce { horizontal_n, vertical_n }),
            ..DesignForce::measured(vertical_n, 3.13, Some(0.01))
        };
        let forces = DesignForces {
            corner_vertical_n: Some(at(-2e5, 2.2e6)),
            corner_horizontal_n: Some(DesignForce { holds: false, ..at(2.1e5, 2.1e6) }),
            ..DesignForces::default()
        };
        let said = at_corners(true, &forces).unwrap();
        assert!(said.contains("2.2 MN upwards with 200 kN across at 3.13 s (largest vertical)."));
        assert!(said.contains("anchor") && !said.contains("largest horizontal"), "{said}");
        assert!(!at_corners(false, &forces).unwrap().contains("anchor"));
        assert_eq!(at_corners(true, &DesignForces::default()), None);
    }

    #[test]
    fn members_say_how_far_and_how_fast_they_move() {
        let forces = DesignForces {
            damper_motion: Some(DamperMotion {
                elongation_m: 0.0421,
                elongation_time_s: 3.13,
                velocity_m_per_s: 0.188,
                velocity_time_s: 3.506,
            }),
            ..DesignForces::default()
        };
        let said = member_motions(&forces).unwrap();
        assert!(said.starts_with("A damper is drawn by 42.1 mm at 3.13 s"), "{said}");
        assert!(said.contains("188 mm/s at 3.506 s"), "{said}");
        assert_eq!(member_motions(&DesignForces::default()), None);
    }
}
