//! Forces to design for are the structure's: finer meshes and other springs leave them as they are.

use groundspring::{
    elastic::{
        answer::{ElasticAnswer, Reference},
        assembled::Assembled,
        design_forces::{ForceKind, HOLDS, StructureForces},
        structure::{ElasticStructure, PierSpec},
    },
    record::Record,
    tuning::elastic::{design::springs, landing_speed, stand},
};

use crate::common::el_centro;

const PIER: PierSpec = PierSpec {
    height_m: 14.0,
    width_m: 3.2,
    mass_kg: 450e3,
    footing_mass_kg: 90e3,
    footing_height_m: 1.5,
    footing_inertia_kgm2: None,
    ea_n: None,
    ga_n: None,
    ei_nm2: Some(7.65e9),
    frequency_hz: None,
    damping_ratio: 0.05,
    axial_damping_ratio: None,
    column_mass_kg: 79e3,
    elements: Some(4),
};

/// Over 5 s of El Centro, on springs that settle by this share of the structure's own deformation.
fn forces(elements: usize, give: f64) -> StructureForces {
    let structure = ElasticStructure::Pier(PierSpec { elements: Some(elements), ..PIER }).checked().unwrap();
    let model = Assembled::new(structure).unwrap();
    let record = Record::new("El Centro", 0.01, el_centro(501)).unwrap();
    let springs = springs(&stand(&model).unwrap(), give, landing_speed(&structure), 1.0);
    let reference = Reference::new(&model, &record).unwrap();
    ElasticAnswer::new(&model, &springs.corners, &record, reference).unwrap().design
}

#[test]
fn a_pier_s_design_forces_hold_and_stay_with_the_elements_doubled_and_on_softer_springs() {
    let give = 3e-5;
    let four = forces(4, give);
    let cutoff = four.cutoff.as_ref().unwrap();
    assert!(cutoff.modes_hz.len() == 3 && cutoff.modes_hz.iter().all(|mode| *mode < cutoff.cutoff_hz));
    // Omega_n^2 goes as 1/give
    for other in [forces(8, give), forces(4, 16.0 * give)] {
        for kind in [ForceKind::ColumnShear, ForceKind::ColumnBaseMoment, ForceKind::Axial] {
            let [a, b] = [&four, &other].map(|forces| *forces.get(kind).unwrap());
            assert!(a.holds && b.holds && a.change() < HOLDS, "{a:?} {b:?}");
            let change = (b.found.abs() / a.found.abs() - 1.0).abs();
            assert!(change < HOLDS, "{kind:?}: {change} {a:?} {b:?}");
        }
    }
}
