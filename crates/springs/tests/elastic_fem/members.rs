//! Dampers and tendons of elastic structures.

use approx::assert_relative_eq;
use dynamics::fem::HistoryOutcome;
use frames::{
    Mechanics,
    assembled::{Assembled, errors},
    fem::{ElasticAnalysis, ElasticStart},
    frame::Frame,
    reference::GroundAcceleration,
    structure::ElasticStructure,
};
use nalgebra::DVector;
use rocking::members::{Damper, Members, Tendon};
use rocking::scalar::GRAVITY;

use crate::common::{PIER, el_centro, portal, springs, structure};

fn pier() -> ElasticStructure {
    ElasticStructure::Pier(PIER).checked().unwrap()
}

fn legs() -> ElasticStructure {
    structure(
        "kind = 'aframe'\nheight_m = 12.0\nwidth_m = 2.4\nmass_kg = 350e3\nfoot_mass_kg = 5e3\n\
         ea_n = 2e10\nei_nm2 = 5e8\ndamping_ratio = 0.02\n",
    )
}

fn tied(stiffness: f64, pretension: f64) -> Members {
    Members { tendon: Some(Tendon { stiffness, pretension }), ..Members::default() }
}

/// At rest, all tendons have the tension given, and the pier's column bears the weight and that: EA
/// e/L = m g + T.
#[test]
fn a_standing_structure_s_tendons_have_their_pretension() {
    for given in [pier(), portal(), legs()] {
        // from a tendon as good as dead weight to one that the columns' settlement alone would have
        // left slack
        for (stiffness, tension) in [(1e4, 2e4), (1e8, 1e6), (1e10, 1e6), (1e8, 0.0)] {
            let model = Assembled::with_members(given, tied(stiffness, tension)).unwrap();
            let standing = model.upright().unwrap();
            let tensions = model.frame.tensions(standing.as_slice());
            assert!(
                tensions.iter().all(|t| (t - tension).abs() < 1e-6 * (tension + 1.0)),
                "{stiffness} {tensions:?}"
            );
            if let ElasticStructure::Pier(pier) = given {
                let shortening = -model.frame.displacement(1, standing.as_slice())[1];
                let expected = (600e3 * GRAVITY + tension) * pier.length() / pier.ea();
                assert_relative_eq!(shortening, expected, max_relative = 1e-9);
            }
        }
    }
}

/// Stiffness across at the mass of a pier that is held at its base.
fn stiffness_across(frame: &Frame, q: &DVector<f64>) -> f64 {
    let k = frame.tangent(q, &DVector::zeros(frame.size()), [0.0; 2])[0].clone();
    let at = frame.coordinates(1)[0].unwrap();
    let mut load = DVector::zeros(frame.size());
    load[at] = 1.0;
    1.0 / k.lu().solve(&load).unwrap()[at]
}

/// Across, a tendon of tension T and length H adds T/H and, by the column's compression over its
/// length L, takes T/L: 3 EI/L^3 - (m g + T)/L + T/H in all.
#[test]
fn a_tendon_s_stiffness_on_a_standing_pier_is_that_of_the_closed_form() {
    let given = pier();
    let ElasticStructure::Pier(spec) = given else { panic!() };
    for tension in [0.0, 1e6, 5e6] {
        let model = Assembled::with_members(given, tied(1e8, tension)).unwrap();
        let fixed = model.layout.fixed().frame().unwrap();
        let standing = fixed.standing(&[]).unwrap();
        assert_relative_eq!(
            fixed.tensions(standing.as_slice()).iter().sum::<f64>(),
            tension,
            epsilon = 1e-3
        );
        // lengths as they are, settled: some 2e-4 shorter
        let settled = fixed.displacement(1, standing.as_slice())[1];
        let (length, height) = (spec.length() + settled, 12.0 + settled);
        let load = 600e3 * GRAVITY + tension;
        let expected =
            3.0 * spec.ei() / spec.length() / length.powi(2) - load / length + tension / height;
        assert_relative_eq!(stiffness_across(&fixed, &standing), expected, max_relative = 1e-9);
    }
}

/// 6 s of El Centro with dampers and a tendon: the energy account closes, and the finite elements
/// follow the reference with the same members.
#[test]
fn a_pier_with_members_follows_the_reference() {
    let members = Members { damper: Some(Damper { c: 2e6 }), ..tied(2e7, 1e6) };
    let (model, bare) =
        (Assembled::with_members(pier(), members).unwrap(), Assembled::new(pier()).unwrap());
    let accel = el_centro(601);
    let springs = springs(&model.frame, 4e4, 20.0);
    let history =
        ElasticAnalysis::new(&model.frame, &springs, ElasticStart::Standing, 0.01, &accel)
            .simulate()
            .unwrap();
    assert_eq!(history.outcome, HistoryOutcome::Completed);
    assert!(history.energy_residual < 1e-6, "{:e}", history.energy_residual);
    let sways = |model: &Assembled| {
        let rocking = model.rock(
            GroundAcceleration::horizontal(0.01, &accel),
            &model.upright().unwrap(),
            u64::MAX,
        );
        assert!(rocking.landings().count() > 2);
        model.sways(rocking.q.iter().map(|q| q.as_slice()))
    };
    let (reference, without) = (sways(&model), sways(&bare));
    let ours = model.sways(history.q.iter().map(Vec::as_slice));
    let [rotation, drift] = errors(&reference, &ours, 601);
    assert!(rotation < 2e-3 && drift < 1e-2, "{rotation:e} {drift:e}");
    // members do something
    assert!(errors(&reference, &without, 601)[0] > 0.1);
}

/// A rigid pier turns about one corner while the damper under the other pulls: I_o th'' + c (2b)^2
/// th' = M, M = -m g (b - h th), so that th' = r exp(-d t) + M/(I_o d) (1 - exp(-d t)), d = c
/// (2b)^2/I_o, over a time so short that M stays.
#[test]
fn dampers_take_the_rotation_rate_of_the_closed_form() {
    let text = "kind = 'pier'\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = 600e3\n\
                footing_mass_kg = 60e3\nfooting_height_m = 1.5\n\
                ei_nm2 = 1e16\nea_n = 1e16\ndamping_ratio = 0.0\n";
    let c = 5e8;
    let members = Members { damper: Some(Damper { c }), ..Members::default() };
    let model = Assembled::with_members(structure(text), members).unwrap();
    let body = model.structure.body();
    let about_pivot = body.inertia + body.mass * (body.half_width.powi(2) + body.height.powi(2));
    // turning about its right corner, the left one rising
    let (lean, rate) = (1e-3, 0.05);
    let q = model.leaning(lean).unwrap();
    let turned = model.leaning(lean + 1e-6).unwrap();
    let v = (&turned - &q) * (rate / 1e-6);
    let force = model.frame.force(&q, &v, [0.0; 2])
        - model.frame.force(&q, &DVector::zeros(q.len()), [0.0; 2]);
    // virtual work of the dampers' forces over a turn about the pivot
    let moment = force.dot(&v) / rate;
    let lever: f64 = 4.0;
    assert_relative_eq!(moment, -c * lever * lever * rate, max_relative = 1e-3);

    // and in time, by the reference: the rate after t, weight's part as of the undamped body over
    // so short a time
    let dt = 1e-3;
    let still = [0.0; 21];
    let after = |model: &Assembled| {
        let ground = GroundAcceleration::horizontal(dt, &still);
        let rocking = frames::reference::rock(
            &model.frame,
            ground,
            (&q, &v),
            &frames::reference::ReferenceOptions::default(),
        );
        let turn = model.frame.coordinates(0)[2].unwrap();
        rocking.v.last().unwrap()[turn]
    };
    let t = 0.02;
    let decay = c * lever * lever / about_pivot;
    let pull = -body.mass * GRAVITY * (body.half_width - body.height * lean) / about_pivot;
    let expected = rate * (-decay * t).exp() + pull / decay * (1.0 - (-decay * t).exp());
    let damped = after(&model);
    assert!((damped - expected).abs() < 5e-3 * rate, "{damped} {expected}");
    assert!(
        (after(&Assembled::new(structure(text)).unwrap()) - rate - pull * t).abs() < 5e-3 * rate
    );
}
