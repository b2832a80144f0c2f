use super::*;
use approx::assert_relative_eq;

const PIER: &str = r#"
kind = "pier"
height_m = 12.0
width_m = 4.0
mass_kg = 600e3
footing_mass_kg = 120e3
footing_height_m = 1.5
frequency_hz = 2.0
damping_ratio = 0.02
"#;

const A_FRAME: &str = r#"
kind = "aframe"
height_m = 61.0
width_m = 12.2
mass_kg = 680.1e3
ea_n = 6.7e9
ei_nm2 = 1e10
foot_mass_kg = 5e3
damping_ratio = 0.02
"#;

fn read(text: &str) -> Result<ElasticStructure, String> {
    let structure: ElasticStructure = toml::from_str(text).map_err(|e| e.to_string())?;
    structure.checked().map_err(|e| e.to_string())
}

fn pier() -> PierSpec {
    match read(PIER).unwrap() {
        ElasticStructure::Pier(pier) => pier,
        other => panic!("{other:?}"),
    }
}

/// Under a beam of this EI (N m2).
fn portal(beam_ei: f64) -> ElasticStructure {
    let text = format!(
        "kind = 'frame'\nheight_m = 9.0\nspan_m = 8.0\nfooting_width_m = 2.5\n\
         footing_height_m = 1.0\nfooting_mass_kg = 30e3\nbeam_mass_kg = 400e3\n\
         column_ea_n = 3e10\ncolumn_ei_nm2 = 2e9\nbeam_ea_n = 3e10\n\
         beam_ei_nm2 = {beam_ei:e}\ndamping_ratio = 0.03"
    );
    read(&text).unwrap()
}

#[test]
fn a_pier_has_the_frequency_that_it_was_given() {
    let structure = read(PIER).unwrap();
    assert_relative_eq!(structure.frequency_hz(), 2.0, max_relative = 1e-12);
    assert_eq!(structure.mass(), 720e3);
    let by_ei = PierSpec { frequency_hz: None, ei_nm2: Some(pier().ei()), ..pier() };
    assert_relative_eq!(ElasticStructure::Pier(by_ei).frequency_hz(), 2.0, max_relative = 1e-12);
}

/// A square column of side a and E = 30 GPa: EI = E a^4/12.
#[test]
fn without_ea_a_column_is_square_and_of_concrete() {
    let a: f64 = 1.8;
    let pier = PierSpec { frequency_hz: None, ei_nm2: Some(30e9 * a.powi(4) / 12.0), ..pier() };
    assert_relative_eq!(pier.ea(), 30e9 * a * a, max_relative = 1e-12);
    // 600 t x 9.81 m/s2 over EA
    assert_relative_eq!(
        ElasticStructure::Pier(pier).shortening(),
        5.886e6 / (30e9 * 3.24),
        max_relative = 1e-12
    );
}

#[test]
fn the_rigid_body_of_a_pier_has_its_parts_inertia_about_a_corner() {
    let (pier, body) = (pier(), ElasticStructure::Pier(pier()).body());
    let about_corner = body.inertia + body.mass * body.radius().powi(2);
    let by_hand = 600e3 * (144.0 + 4.0) + pier.footing_inertia() + 120e3 * (4.0 + 0.5625);
    assert_relative_eq!(about_corner, by_hand, max_relative = 1e-12);
}

/// Rigid beam: both columns clamped at both ends, 24 EI/L^3; no beam: two cantilevers, 6 EI/L^3.
#[test]
fn a_portal_lies_between_its_limits() {
    let with = |beam_ei: f64| portal(beam_ei).frequency_hz();
    let hz = |factor: f64| {
        let stiffness = factor * 2e9 / 512.0 - 2.0 * 200e3 * 9.81 / 8.0;
        (stiffness / 400e3).sqrt() / std::f64::consts::TAU
    };
    assert_relative_eq!(with(1e18), hz(24.0), max_relative = 1e-6);
    assert_relative_eq!(with(1e2), hz(6.0), max_relative = 1e-6);
}

#[test]
fn what_no_structure_can_be_is_refused_in_one_line() {
    for (from, to, expected) in [
        ("600e3", "-1.0", "mass_kg"),
        ("600e3", "1e300", "mass_kg"),
        ("600e3", "nan", "mass_kg"),
        ("width_m = 4.0", "width_m = 90.0", "slenderness"),
        ("damping_ratio = 0.02", "damping_ratio = 2.0", "damping_ratio"),
        (
            "frequency_hz = 2.0",
            "frequency_hz = 2.0\nei_nm2 = 1e10",
            "ei_nm2 and frequency_hz are both given",
        ),
        ("frequency_hz = 2.0", "", "one of ei_nm2 and frequency_hz"),
        ("frequency_hz = 2.0", "frequency_hz = 2.0\nea_n = 1e6", "ea_n"),
        ("frequency_hz = 2.0", "ei_nm2 = 1e6", "buckles"),
        ("footing_height_m = 1.5", "footing_height_m = 12.0", "footing_height_m"),
        ("frequency_hz = 2.0", "frequency_hz = 2.0\nelements = 8", "elements"),
        (
            "frequency_hz = 2.0",
            "frequency_hz = 2.0\ncolumn_mass_kg = 1e4\nelements = 800",
            "elements",
        ),
        ("frequency_hz = 2.0", "frequency_hz = 2.0\ncolour = 3", "colour"),
    ] {
        let message = read(&PIER.replace(from, to)).expect_err(to);
        assert!(message.contains(expected), "{to}: {message}");
    }
}

#[test]
fn legs_shorten_by_their_load_over_ea() {
    let structure = read(A_FRAME).unwrap();
    let load = 0.5 * 680.1e3 * 9.81 / 0.1_f64.atan().cos();
    assert_relative_eq!(structure.shortening(), load / 6.7e9, max_relative = 1e-12);
    let frame: ElasticStructure = toml::from_str(&toml::to_string(&structure).unwrap()).unwrap();
    assert_eq!(frame, structure);
}

/// The finite elements of each kind, held at their feet: the closed forms' lowest frequency, to
/// what these leave out.
#[test]
fn finite_elements_have_the_frequency_of_the_closed_form() {
    let lowest = |structure: &ElasticStructure| {
        let frame = structure.layout().fixed().frame().unwrap();
        let standing = frame.standing(&[]).unwrap();
        let frequencies = frame.frequencies(&standing);
        frequencies[0]
    };
    let pier = pier();
    for (structure, within) in [
        // P-Delta of the shortened column
        (ElasticStructure::Pier(pier), 1e-3),
        (
            ElasticStructure::Pier(PierSpec { column_mass_kg: 60e3, elements: Some(8), ..pier }),
            5e-3,
        ),
    ] {
        assert_relative_eq!(lowest(&structure), structure.frequency_hz(), max_relative = within);
    }
    let frame = read(A_FRAME).unwrap();
    // the legs' bending is left out
    assert_relative_eq!(lowest(&frame), frame.frequency_hz(), max_relative = 1e-2);
    let portal = portal(4e9);
    // columns' shortening and the rotational inertia of the tops are left out
    assert_relative_eq!(lowest(&portal), portal.frequency_hz(), max_relative = 1.5e-2);
    assert_relative_eq!(lowest(&portal), portal.fixed_base_frequency_hz(), max_relative = 1e-12);
    // OpenSees, `eigen`: 8 elasticBeamColumn to a column, 16 with consistent masses to the beam,
    // PDelta under half of the beam's weight on each column
    assert_relative_eq!(lowest(&portal), 2.1765161916, max_relative = 1e-2);
}

/// A mass at the apex that turns slows an A-frame. OpenSees, `eigen`: 8 elasticBeamColumn to a leg
/// hinged at its foot, PDelta under the weight; ours has one, and its bow adds nothing.
#[test]
fn an_a_frame_is_slowed_by_the_rotational_inertia_at_its_apex() {
    for (inertia, due, within) in
        [(1.3e6, 1.0525439641, 1e-3), (8e6, 0.9927272791, 5e-3), (2e7, 0.7243319077, 1.5e-2)]
    {
        let frame = read(&format!(
            "kind = 'aframe'\nheight_m = 24.0\nwidth_m = 5.0\nmass_kg = 320e3\nea_n = 1.6e10\n\
             ei_nm2 = 1.9e9\nfoot_mass_kg = 9e3\ndamping_ratio = 0.025\n\
             rotational_inertia_kgm2 = {inertia}"
        ))
        .unwrap();
        assert_relative_eq!(frame.fixed_base_frequency_hz(), due, max_relative = within);
    }
}

/// E = 30 GPa, nu = 0.2, 5/6 of the area: GA_s = 5/6 EA/2.4. Cantilevers give by L^3/(3 EI) +
/// L/GA_s.
#[test]
fn a_column_with_mass_gives_in_shear() {
    let heavy = PierSpec { column_mass_kg: 60e3, ..pier() };
    assert_relative_eq!(heavy.ga(), heavy.ea() * 5.0 / 6.0 / 2.4, max_relative = 1e-12);
    assert_relative_eq!(ElasticStructure::Pier(heavy).frequency_hz(), 2.0, max_relative = 1e-12);
    for given in [PierSpec { ea_n: Some(6e10), ..heavy }, PierSpec { ga_n: Some(1e9), ..heavy }] {
        assert_relative_eq!(
            ElasticStructure::Pier(given).frequency_hz(),
            2.0,
            max_relative = 1e-12
        );
    }
    assert_eq!(pier().ga(), f64::INFINITY);
}
