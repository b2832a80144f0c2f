use super::*;
use strong_motion::Record;

fn block(sizes: &str) -> Vec<Doubt> {
    Case::parse("case.toml", &format!("[structure]\nkind = 'block'\n{sizes}")).unwrap().doubts()
}

#[test]
fn a_cabinet_that_would_not_stand_in_a_room_is_doubted() {
    let doubts = block("height_m = 1.9\nwidth_m = 0.8\nmass_kg = 400.0\n");
    assert_eq!(doubts, [Doubt::TotalHeight { key: "height_m", height: 1.9, unit: "m" }]);
    assert_eq!(
        doubts[0].message(),
        "height_m = 1.9, of the centre of mass, makes a block 3.8 m tall"
    );
    assert_eq!(doubts[0].remedy(), "if 1.9 m is its total height, write total_height_m = 1.9");
    let told = doubts[0].to_string();
    assert!(told.ends_with("tall; if 1.9 m is its total height, write total_height_m = 1.9"));
    let feet = block("height_in = 74.0\nwidth_in = 30.0\nweight_lb = 900\n");
    assert_eq!(feet[0].remedy(), "if 74 in is its total height, write total_height_in = 74");
    // twice 1 m stands in a room; a height that is said to be the total one is none to doubt
    assert_eq!(block("height_m = 1.0\nwidth_m = 0.5\nmass_kg = 200.0\n"), []);
    assert_eq!(block("total_height_m = 3.8\nwidth_m = 0.8\nmass_kg = 400.0\n"), []);
}

/// A transformer of 32 t whose mass is given in tonnes: the doubt of its height has no place beside
/// that.
#[test]
fn a_mass_in_tonnes_is_doubted() {
    let transformer = block("height_m = 1.6\nwidth_m = 1.3\nmass_kg = 32.0\n");
    let [Doubt::Tonnes { mass, kg_per_m3 }] = transformer[..] else { panic!("{transformer:?}") };
    assert!(mass == 32.0 && (kg_per_m3 - 32.0 / (3.2 * 1.69)).abs() < 1e-9);
    assert_eq!(
        transformer[0].message(),
        "mass_kg = 32 gives a block of 5.917 kg/m3 if it is as deep as wide"
    );
    assert_eq!(transformer[0].remedy(), "if it is 32 t, write mass_kg = 32e3");
    assert_eq!(block("height_m = 1.6\nwidth_m = 1.3\nmass_kg = 32e3\n"), []);
}

/// A column of stone, 2600 kg/m3, as it is read or with half its height.
#[test]
fn a_solid_is_known_by_its_density() {
    let mass = |height: f64| 2600.0 * height * 0.64;
    let column = |mass: f64| block(&format!("height_m = 4.0\nwidth_m = 0.8\nmass_kg = {mass:?}\n"));
    assert_eq!(column(mass(8.0)), []);
    assert_eq!(column(mass(4.0)), [Doubt::TotalHeight { key: "height_m", height: 4.0, unit: "m" }]);
    // half as high it would be too stocky to rock: atan(0.8/0.6) = 0.93
    assert_eq!(block(&format!("height_m = 0.6\nwidth_m = 0.8\nmass_kg = {:?}\n", mass(0.6))), []);
}

#[test]
fn heights_in_millimetres_and_masses_in_tonnes_are_doubted() {
    let high = block("height_m = 2000.0\nwidth_m = 600.0\nmass_kg = 5e11\n");
    assert!(matches!(high[..], [Doubt::Height { height_m: 4000.0 }]), "{high:?}");
    let pier = "[structure]\nkind = \"pier\"\nheight_m = 10.0\nwidth_m = 4.0\nmass_kg = 4e5\n\
        footing_mass_kg = 60.0\nfooting_height_m = 1.0\nfrequency_hz = 2.0\ndamping_ratio = 0.02\n";
    let light = ElasticCase::parse("pier.toml", pier).unwrap().doubts_of_structure();
    assert!(matches!(light[..], [Doubt::LightPart { key: "footing_mass_kg", .. }]), "{light:?}");
    assert_eq!(light[0].remedy(), "if it is 60 t, write footing_mass_kg = 60e3");
    let told = ElasticCase::parse("pier.toml", &pier.replace("= 60.0", "= 60e3")).unwrap();
    assert_eq!(told.doubts_of_structure(), []);
    let strong = Excitation { scale: 9.81, ..Excitation::whole(Record::el_centro()) };
    assert!(matches!(of_excitation(&strong)[..], [Doubt::StrongMotion { .. }]));
}

#[test]
fn densities_of_no_material_are_doubted() {
    let tonnes = block("height_m = 1.0\nwidth_m = 1.0\nmass_kg = 9.0\n");
    let box_m = [2.0, 1.0, 1.0];
    let doubt = Doubt::Density { kg_per_m3: 4.5, mass_kg: 9.0, box_m, least: 5.0, most: 25_000.0 };
    assert_eq!(tonnes, [doubt]);
    assert_eq!(
        tonnes[0].message(),
        "a mean density of 4.5 kg/m3 is not within 5 to 25000: 9 kg in a box of 2 x 1 x 1 m, as \
            deep as wide"
    );
    // 5.05 kg/m3 may be a mass in tonnes, but is within
    assert!(matches!(
        block("height_m = 1.0\nwidth_m = 1.0\nmass_kg = 10.1\n")[..],
        [Doubt::Tonnes { .. }]
    ));
    assert_eq!(block("height_m = 1.0\nwidth_m = 1.0\nmass_kg = 60.1\n"), []);
    assert_eq!(block("height_m = 1.0\nwidth_m = 1.0\nmass_kg = 49.9e3\n"), []);
    assert_eq!(block("height_m = 1.0\nwidth_m = 1.0\nmass_kg = 50.1e3\n").len(), 1);
    let pier = "[structure]\nkind = 'pier'\nheight_m = 12.0\nwidth_m = 4.0\nmass_kg = 600.0\n\
        footing_mass_kg = 60.0\nfooting_height_m = 1.5\nfrequency_hz = 2.0\ndamping_ratio = 0.02\n";
    let doubts = ElasticCase::parse("pier.toml", pier).unwrap().doubts();
    // 660 kg in 12 x 4 x 4 m
    assert!(
        matches!(doubts[..],
            [Doubt::Density { kg_per_m3, .. }] if (kg_per_m3 - 3.4375).abs() < 1e-12),
        "{doubts:?}"
    );
}

/// m R^2 = 1e5 (10^2 + 1^2) = 1.01e7 kg m2, of a rigid A-frame and of one that gives.
#[test]
fn an_inertia_of_mass_beyond_the_feet_is_doubted() {
    let frame = "[structure]\nkind = 'aframe'\nheight_m = 10.0\nwidth_m = 2.0\nmass_kg = 1e5\n";
    let elastic = "ea_n = 1e10\nei_nm2 = 1e9\nfoot_mass_kg = 5e3\ndamping_ratio = 0.02\n";
    for (inertia, doubted) in [("1.00e7", false), ("1.02e7", true), ("1e11", true)] {
        let given = format!("{frame}rotational_inertia_kgm2 = {inertia}\n");
        let rigid = Case::parse("case.toml", &given).unwrap().doubts_of_structure();
        let gives = ElasticCase::parse("case.toml", &format!("{given}{elastic}")).unwrap();
        for doubts in [rigid, gives.doubts_of_structure()] {
            let found = doubts.iter().any(|doubt| {
                matches!(doubt, Doubt::Inertia { m_r2, .. }
                if (m_r2 / 1.01e7 - 1.0).abs() < 1e-12)
            });
            assert_eq!(found, doubted, "{inertia}: {doubts:?}");
        }
    }
    let block = "[structure]\nkind = 'block'\ntotal_height_m = 2.0\nwidth_m = 0.5\n\
        mass_kg = 100.0\nrotational_inertia_kgm2 = 1.06e6\n";
    let refused = Case::parse("case.toml", block).unwrap_err().to_string();
    assert!(refused.contains("at most 106.2500 kg m2"), "{refused}");
}

#[test]
fn motions_that_nobody_feels_or_that_end_early_are_doubted() {
    let record = || Record::new("a", 0.01, vec![0.0, 0.04, -0.02, 0.3]).unwrap();
    let with = |scale, duration_s| {
        of_excitation(&Excitation { scale, duration_s, ..Excitation::whole(record()) })
    };
    assert_eq!(with(1.0, None), []);
    // what counts is the part used: 0.04 m/s2
    assert!(matches!(with(-1.0, Some(0.02))[..],
            [Doubt::WeakMotion { pga_g, .. }] if (pga_g - 0.04 / 9.81).abs() < 1e-15));
    assert_eq!(with(1.0, Some(0.034)), []);
    let cut = with(10.0, Some(0.02));
    assert!(matches!(cut[..], [Doubt::PeakCut { .. }]));
    let told = "the part used has a peak of 0.04077 g, the whole record 0.3058 g";
    assert_eq!(cut[0].message(), told);
    assert_eq!(with(1.0, Some(90.0)), [Doubt::LongDuration { asked_s: 90.0, record_s: 0.03 }]);
    assert!(
        with(1.0, Some(90.0))[0].message().starts_with("90 s are asked for, the record has 0.03 s")
    );
}

#[test]
fn a_scale_that_turns_the_vertical_motion_upside_down_is_doubted() {
    let up = Record::new("up", 0.01, vec![0.0, 0.1, -0.1, 0.0]).unwrap();
    let record = Record::new("a", 0.01, vec![0.0, 0.4, -0.2, 0.3]).unwrap();
    let with = |record: &Record, scale| {
        of_excitation(&Excitation { scale, ..Excitation::whole(record.clone()) })
    };
    assert_eq!(with(&record, -0.5), []);
    let record = record.with_vertical(up).unwrap();
    assert_eq!(with(&record, 0.5), []);
    let doubts = with(&record, -0.5);
    assert_eq!(doubts, [Doubt::Reversed { scale: -0.5 }]);
    assert_eq!(doubts[0].remedy(), "for the motion as recorded write scale = 0.5");
}

#[test]
fn the_cases_of_the_folder_are_beyond_doubt() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tuning");
    for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let Some("toml") = path.extension().and_then(|e| e.to_str()) else { continue };
        let (name, text) = (path.display().to_string(), std::fs::read_to_string(&path).unwrap());
        let doubts = if ElasticCase::is(&text) {
            ElasticCase::parse(&name, &text).unwrap().doubts()
        } else {
            Case::read(&path).unwrap().doubts()
        };
        // the record's own 1.84 g upwards, which this case leaves out
        let vertical = |doubt: &Doubt| matches!(doubt, Doubt::VerticalLeftOut { .. });
        let known = usize::from(name.ends_with("pier_kaikoura.toml"));
        assert_eq!(
            (doubts.len(), doubts.iter().filter(|d| vertical(d)).count()),
            (known, known),
            "{name}: {doubts:?}"
        );
    }
}
