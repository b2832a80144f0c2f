//! Legs without mass that do not give way: the rigid body on two feet, of `fem::Analysis`, on the
//! same springs.

use dynamics::{
    fem,
    spring::{Design, Springs},
};
use frames::{
    beam::BeamSection,
    fem::{ElasticAnalysis, ElasticStart},
    frame::{Base, LeggedFrame, StraightMember},
};
use rocking::structure::Body;

use crate::common::{el_centro, nrmse};

/// An A-frame of 61 m, 12.2 m wide, 680 t, with some rotational inertia; its legs shorten by a
/// ten-thousandth of what the springs do.
#[test]
fn stiff_legs_with_light_feet_rock_as_the_rigid_body_does() {
    let (mass, height, width): (f64, f64, f64) = (680.1e3, 61.0, 12.2);
    let inertia = 0.02 * mass * (height * height + 0.25 * width * width);
    let design = Design::from_kc(0.3, 0.1, 0.75, 160.0);
    let springs = Springs { vertical: design, horizontal: design }.chains(mass);
    let length = height.hypot(0.5 * width);
    let stiff = 1e4 * springs.vertical.k1;
    let leg = StraightMember {
        section: BeamSection::elastic(stiff * length, stiff * length.powi(3) / 3.0),
        elements: 1,
    };
    let frame =
        LeggedFrame { mass, inertia, height, width, foot_mass: 1.0, leg }.layout().frame().unwrap();
    let body = Body { mass, half_width: 0.5 * width, height, inertia };
    let accel = el_centro(1001);
    for (elastic, rigid, accel) in [
        (ElasticStart::Leaning(0.05), fem::Start::Leaning(0.05), vec![0.0; 1001]),
        (ElasticStart::Standing, fem::Start::Settled, accel),
    ] {
        let both = [springs; 2];
        let history =
            ElasticAnalysis::new(&frame, &both, elastic, 0.01, &accel).simulate().unwrap();
        let case =
            fem::Analysis { start: rigid, ..fem::Analysis::new(body, springs, 0.01, &accel) };
        let expected = case.simulate();
        let error = nrmse(&history.rotation(&frame, Base::Feet), &expected.motion.theta);
        assert!(error < 2e-3, "{error:e}");
        // legs and tiny feet store nothing
        assert!(history.energy_residual < 1e-6);
    }
}
