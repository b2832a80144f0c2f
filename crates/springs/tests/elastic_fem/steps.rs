//! Forces at the ends of steps: of columns without mass, tendons and dampers.

use frames::{
    assembled::Assembled,
    beam::BeamForces,
    design_forces::ForceName,
    structure::{ElasticStructure, PierSpec},
};
use rocking::members::{Damper, Members, Tendon};
use springs::elastic::{design::springs, landing_speed, stand};
use strong_motion::Record;

use crate::common::{PIER, answer, el_centro, on_rigid_ground};

/// Of a column without mass every force is that of a step: no less than at any sample, up to any
/// time; what acts at that step has it in its own place. With a tendon: T0 + k (length - height) of
/// the mass's motion. With dampers: no less than at the samples.
#[test]
fn forces_of_a_column_without_mass_are_those_of_steps() {
    let pier = PierSpec {
        height_m: 6.0,
        width_m: 2.0,
        mass_kg: 200e3,
        footing_mass_kg: 40e3,
        footing_height_m: 1.0,
        frequency_hz: Some(3.0),
        ea_n: Some(1.2e11),
        axial_damping_ratio: Some(0.001),
        ..PIER
    };
    let structure = ElasticStructure::Pier(pier).checked().unwrap();
    let members = Members {
        tendon: Some(Tendon { stiffness: 1e7, pretension: 2e5 }),
        damper: Some(Damper { c: 2e5 }),
        ..Members::default()
    };
    let accel: Vec<f64> = el_centro(801).iter().map(|a| 2.0 * a).collect();
    let record = Record::new("El Centro x 2", 0.01, accel).unwrap();
    for model in
        [Assembled::new(structure).unwrap(), Assembled::with_members(structure, members).unwrap()]
    {
        let springs = springs(&stand(&model).unwrap(), 1e-5, landing_speed(&structure), 1.0);
        let reference = on_rigid_ground(&model, &record);
        let answer = answer(&model, &springs, &record, reference);
        let (design, fem) = (&answer.design, &answer.histories.fem);
        let sampled =
            |of: fn(&BeamForces) -> f64| fem.demands.iter().map(move |d| of(&d.bearings[0]));
        let axial = design.get(ForceName::Axial).unwrap();
        let together = axial.together.unwrap();
        assert_eq!(together.axial_n, axial.others.found);
        let least = sampled(|b| b.axial).fold(0.0, f64::min);
        let worst = fem.worst.iter().map(|d| d.bearings[0].axial).fold(0.0, f64::min);
        assert!(axial.others.found <= least, "{axial:?} {least}");
        assert!((axial.others.found / worst - 1.0).abs() < 1e-9, "{axial:?} {worst}");
        let shear = design.get(ForceName::ColumnShear).unwrap();
        assert_eq!(shear.together.unwrap().column_shear_n, shear.others.found);
        let most = sampled(|b| b.axial).fold(0.0, f64::max);
        let tension = design.get(ForceName::AxialTension).map_or(0.0, |t| t.others.found);
        assert!(tension >= most, "{tension} {most}");
        let Some(tendon) = design.get(ForceName::Tendon) else {
            assert!(model.members.tendon.is_none() && tension > 0.0);
            assert!(design.get(ForceName::Damper).is_none());
            continue;
        };
        let pull = fem.demands.iter().map(|d| d.tendons[0]).fold(0.0, f64::max);
        let top = fem.q.iter().map(|q| model.frame.tensions(q.as_slice())[0]).fold(0.0, f64::max);
        assert!((pull / top - 1.0).abs() < 1e-12 && tendon.others.found >= pull);
        assert!((tendon.others.found / pull - 1.0).abs() < 5e-3, "{tendon:?} {pull}");
        let damper = design.get(ForceName::Damper).unwrap().others.found;
        let sampled = fem.demands.iter().flat_map(|d| &d.dampers);
        let most = sampled.fold(0.0, |most: f64, force| most.max(force.abs()));
        assert!(damper.abs() >= most && damper.abs() < 1.3 * most, "{damper} {most}");
    }
}
