use super::*;

const STRUCTURE: &str =
    "[structure]\nkind = \"block\"\nheight_m = 1.0\nwidth_m = 0.5\nmass_kg = 100.0\n";

fn message(extra: &str) -> String {
    Case::parse("case.toml", &format!("{STRUCTURE}{extra}")).unwrap_err().to_string()
}

#[test]
fn the_papers_case_is_the_papers_structure_on_el_centro() {
    let case = Case::paper().unwrap();
    assert_eq!(case.structure.mass_kg, 680.1e3);
    assert_eq!((case.structure.height_m, case.structure.width_m), (61.0, 12.2));
    assert_eq!(case.record.name, "IELC180");
    assert_eq!(case.duration_s, 20.0);
}

#[test]
fn a_record_is_used_whole_unless_the_case_says_otherwise() {
    let whole = Case::parse("case.toml", STRUCTURE).unwrap();
    assert_eq!(whole.duration_s, Record::el_centro().duration());
    let text = format!("{STRUCTURE}[record]\nscale = 2.0\nduration_s = 15.0\n");
    let mut case = Case::parse("case.toml", &text).unwrap();
    assert_eq!((case.duration_s, case.excitation.scale), (15.0, 2.0));
    assert_eq!(case.record, Record::el_centro().scaled(2.0).unwrap());
    // a scale replaces another
    case.set_excitation(Excitation { scale: 1.5, ..case.excitation.clone() }).unwrap();
    assert_eq!((&case.record, case.duration_s), (&Record::el_centro().scaled(1.5).unwrap(), 15.0));
}

#[test]
fn every_case_in_the_folder_can_be_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tuning");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let cases: Vec<std::path::PathBuf> =
        files.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    assert!(cases.len() >= 5, "{cases:?}");
    for path in cases {
        let text = std::fs::read_to_string(&path).unwrap();
        if ElasticCase::is(&text) {
            ElasticCase::parse(&path.display().to_string(), &text).unwrap();
            continue;
        }
        let case = Case::read(&path).unwrap();
        assert_eq!(case.tuning.objective, Objective::Landing, "{path:?}");
        assert!(case.excitation.duration_s.is_some(), "{path:?}");
    }
}

#[test]
fn a_block_has_a_third_of_m_r_squared_unless_given() {
    let case = Case::parse("case.toml", STRUCTURE).unwrap();
    assert!((case.structure.rotational_inertia_kgm2 - 100.0 * (1.0 + 0.0625) / 3.0).abs() < 1e-12);
}

#[test]
fn an_unknown_key_names_its_line_and_the_nearest_known_key() {
    assert_eq!(
        message("[tuning]\nmax_omega_hx = 80.0\n"),
        "case.toml, line 7: unknown key \"max_omega_hx\"; did you mean \"max_omega_hz\"?"
    );
}

#[test]
fn a_restitution_ratio_multiplies_equation_2() {
    let case = Case::parse("case.toml", &format!("{STRUCTURE}restitution_ratio = 0.95\n")).unwrap();
    assert!((case.restitution / case.structure.body::<f64>().restitution() - 0.95).abs() < 1e-15);
    assert!(message("restitution = 1.2\n").contains("between 0 and 1"));
    assert!(message("restitution = 0.9\nrestitution_ratio = 0.9\n").contains("not both"));
}

#[test]
fn friction_is_read_and_goes_alone() {
    let members = Case::parse("case.toml", &format!("{STRUCTURE}[friction]\ncoefficient = 0.4\n"))
        .unwrap()
        .members;
    assert_eq!(members.friction, Some(Friction { coefficient: 0.4 }));
    let both = message("[friction]\ncoefficient = 0.4\n[damper]\nc_ns_per_m = 1.0\n");
    assert!(both.starts_with("case.toml: friction.coefficient is given together"), "{both}");
}

#[test]
fn members_are_read_and_checked() {
    let text =
        "[damper]\nc_ns_per_m = 3e5\n[tendon]\nstiffness_n_per_m = 4e5\npretension_n = 5e4\n";
    let members = Case::parse("case.toml", &format!("{STRUCTURE}{text}")).unwrap().members;
    assert_eq!(members.damper, Some(Damper { c: 3e5 }));
    assert_eq!(members.tendon, Some(Tendon { stiffness: 4e5, pretension: 5e4 }));
    assert_eq!(
        message("[tendon]\nstiffness_n_per_m = 0.0\npretension_n = 0.0\n"),
        "case.toml: tendon.stiffness_n_per_m is 0; give a finite number greater than zero"
    );
    assert_eq!(
        message("[legs]\nea_n = 1e9\nei_nm2 = 2e9\n"),
        "case.toml, line 6: legs on springs of a rigid body are no more; give [structure] kind = \
            \"aframe\" elastic legs of its own: ea_n, ei_nm2, foot_mass_kg, damping_ratio \
            (docs/elastic.md)"
    );
    assert!(message("[damper]\nc = 1.0\n").contains("did you mean \"c_ns_per_m\"?"));
}

#[test]
fn bad_values_are_named() {
    assert!(
        message("[tuning]\nmass_ratios_vertical = [-1.0]\n")
            .contains("tuning.mass_ratios_vertical is -1")
    );
    assert!(message("[record]\nduration_s = nan\n").contains("record.duration_s is NaN"));
    assert!(
        message("[tuning]\nmax_omega_hz = \"stiff\"\n")
            .starts_with("case.toml, line 7: max_omega_hz is \"stiff\"; write a number")
    );
}

#[test]
fn a_scale_that_is_no_number_is_blamed_not_the_record() {
    for scale in ["nan", "inf", "-inf"] {
        let text = format!("{STRUCTURE}[record]\nscale = {scale}\n");
        let refused = Case::parse("case.toml", &text).unwrap_err().to_string();
        assert!(refused.contains("record.scale is"), "{refused}");
        assert!(refused.contains("give a finite number"), "{refused}");
    }
}

/// Housner's e of an A-frame is cos(2 alpha): tan(alpha) = 1/2 gives 3/5.
#[test]
fn an_assumption_can_be_printed() {
    let text = "[structure]\nkind = 'aframe'\nheight_m = 2.0\nwidth_m = 2.0\nmass_kg = 1e3\n";
    let all = Case::parse("c.toml", text).unwrap().assumptions();
    let told: Vec<String> = all.iter().map(ToString::to_string).collect();
    let expected = "Housner's restitution (equation 2) = 0.6 (structure.restitution)";
    assert!(told.iter().any(|told| told == expected), "{told:?}");
}

/// The case file that this crate's documentation shows, but for its record, is a case.
#[test]
fn the_case_file_of_the_documentation_is_read() {
    let shown = include_str!("lib.rs").split("//! ```").nth(1).unwrap();
    let lines = shown.lines().filter_map(|line| line.strip_prefix("//!")).map(str::trim);
    let records = ["file = ", "vertical = "];
    let text: Vec<&str> =
        lines.filter(|line| !records.iter().any(|key| line.starts_with(key))).collect();
    let case = Case::parse("case.toml", &text.join("\n")).unwrap();
    assert_eq!((case.structure.height_m, case.structure.width_m), (61.0, 12.2));
    assert_eq!(case.members.damper.unwrap().c, 1e6);
    assert!(
        case.program.is_some()
            && text.contains(&"duration_s = 20.0          # left out: all of it")
    );
}
