use super::*;
use dynamics::spring::{Design, Springs};
use rocking::structure::Structure;
use strong_motion::excitation::of_record;

fn parameters(excitation: &Excitation, folder: &Path) -> Parameters {
    let design = Design::from_kc(0.3, 0.1, 0.75, 160.0);
    let used = excitation.used().unwrap();
    Parameters {
        record: Some(RecordRow::new(excitation, &used, folder)),
        ..Parameters::new(Structure::paper(), &Springs { vertical: design, horizontal: design })
    }
}

/// Written and read as a file is.
fn again(parameters: &Parameters) -> Parameters {
    Parameters::parse("p.json", &parameters.to_json()).unwrap()
}

#[test]
fn a_file_is_found_from_the_folder_of_the_parameters_wherever_both_are_moved() {
    let dir = tempfile::tempdir().unwrap();
    for folder in ["old/motions", "old/out"] {
        std::fs::create_dir_all(dir.path().join(folder)).unwrap();
    }
    let file = dir.path().join("old/motions/a.txt");
    std::fs::write(&file, "0.1\n0.3\n-0.2\n").unwrap();
    let options = ReadOptions { dt: Some(0.02), units: Some(Units::G), ..Default::default() };
    let record = Record::read(&file, &options).unwrap();
    let excitation = Excitation { record, scale: 1.5, duration_s: Some(0.02) };
    // a folder that is made only later
    let written = parameters(&excitation, &dir.path().join("old/out/run"));
    let row = written.record.clone().unwrap();
    let way = "../../motions/a.txt".to_string();
    let named = file.display().to_string();
    assert_eq!(
        row.source,
        Some(SourceRow::File {
            file: named,
            path: way,
            units: Units::G,
            component: None,
            baseline: false
        })
    );
    assert_eq!((row.scale, row.duration_s, row.pga_time_s), (Some(1.5), Some(0.02), Some(0.02)));

    std::fs::rename(dir.path().join("old"), dir.path().join("new")).unwrap();
    std::fs::create_dir(dir.path().join("new/out/run")).unwrap();
    let path = dir.path().join("new/out/run/parameters.json");
    let found = again(&written).excitation(&path).unwrap();
    assert_eq!(found, Excitation { record: found.record.clone(), ..excitation.clone() });
    assert_eq!(found.record, excitation.record);

    let file = dir.path().join("new/motions/a.txt");
    std::fs::write(&file, "0.1\n0.3\n-0.21\n").unwrap();
    let changed = written.excitation(&path).unwrap_err().to_string();
    assert!(
        changed.contains("a.txt has changed since the springs were tuned (the hash of its"),
        "{changed}"
    );
    std::fs::write(&file, "# units: cm/s2\n0.1\n0.3\n-0.2\n").unwrap();
    assert!(matches!(written.excitation(&path), Err(RememberedError::Changed { .. })));
    std::fs::remove_file(&file).unwrap();
    assert!(matches!(written.excitation(&path), Err(RememberedError::Missing { .. })));
}

/// Components of one instrument differ by a few samples; the springs are of those up to the end of
/// the horizontal one, and so is the hash.
#[test]
fn a_vertical_component_that_goes_on_after_the_record_is_found_again() {
    let dir = tempfile::tempdir().unwrap();
    let [across, up] = ["across.txt", "up.txt"].map(|name| dir.path().join(name));
    std::fs::write(&across, "0.1\n0.3\n-0.2\n").unwrap();
    let options = ReadOptions { dt: Some(0.02), units: Some(Units::G), ..Default::default() };
    let with_up = ReadOptions { vertical: Some(up.clone().into()), ..options.clone() };
    for (more, duration_s) in [("", None), ("0.3\n-0.1\n", None), ("0.3\n", Some(0.02))] {
        std::fs::write(&up, format!("0.05\n-0.1\n0.2\n{more}")).unwrap();
        let record = Record::read(&across, &with_up).unwrap();
        let excitation = Excitation { record, scale: 1.0, duration_s };
        let written = again(&parameters(&excitation, dir.path()));
        // FNV-1a of the step and the three samples that are used, whatever follows them
        let used = [0.05, -0.1, 0.2].map(|g| g * 9.81);
        let numbers = [0.02].into_iter().chain(used).flat_map(f64::to_le_bytes);
        let row = written.record.as_ref().unwrap().vertical.as_ref().unwrap();
        assert_eq!(row.fnv1a_64, format!("{:016x}", strong_motion::fnv1a(numbers)));
        let found = written.excitation(&dir.path().join("parameters.json")).unwrap();
        assert_eq!(found.record.up(), used);
        assert_eq!(found.used().unwrap(), excitation.used().unwrap());
        // one that has changed is still told
        std::fs::write(&up, format!("0.05\n-0.1\n0.21\n{more}")).unwrap();
        let changed = written.excitation(&dir.path().join("parameters.json"));
        assert!(matches!(changed, Err(RememberedError::Changed { .. })));
    }
}

/// Records cut and scaled in memory are told as such, and are found again.
#[test]
fn a_record_that_was_scaled_and_cut_is_found_again_with_its_scale_and_length() {
    let made = Record::el_centro().truncated(20.0).scaled(1.5).unwrap();
    let excitation = of_record(made.clone(), 2.0, Some(30.0));
    let written = again(&parameters(&excitation, Path::new("out")));
    let row = written.record.as_ref().unwrap();
    assert_eq!((row.samples, row.scale, row.duration_s), (3995, Some(3.0), Some(20.0)));
    let found = written.excitation(Path::new("p.json")).unwrap();
    assert_eq!(found.used().unwrap().len(), made.len());
    assert_eq!(found.used().unwrap().pga_g(), Record::el_centro().scaled(3.0).unwrap().pga_g());
    // one cut after another: the shorter one
    let short = of_record(Record::el_centro().truncated(5.0).truncated(9.0), 1.0, None);
    assert_eq!((short.duration_s, short.scale), (Some(5.0), 1.0));
    // put together of parts it is in no file
    let apart = made.clone().with_vertical(made).unwrap();
    let numbers = parameters(&of_record(apart, 1.0, None), Path::new("out"));
    assert!(matches!(numbers.excitation(Path::new("p.json")), Err(RememberedError::NoFile { .. })));
}

#[test]
fn the_embedded_record_is_remembered_as_such_and_numbers_are_said_to_be_nowhere() {
    let el_centro = Excitation { scale: 2.0, ..Excitation::whole(Record::el_centro()) };
    let found =
        again(&parameters(&el_centro, Path::new("out"))).excitation(Path::new("p.json")).unwrap();
    assert_eq!(found, Excitation { duration_s: Some(el_centro.duration()), ..el_centro });
    let made = Excitation::whole(Record::new("made", 0.01, vec![1.0; 10]).unwrap());
    let error = parameters(&made, Path::new("out"))
        .excitation(Path::new("p.json"))
        .unwrap_err()
        .to_string();
    assert_eq!(
        error,
        "p.json: its record made was given as numbers and is in no file; save it as a column of \
         accelerations, in Python \
         numpy.savetxt(\"motion.txt\", record.accel), and name it with --record motion.txt --dt \
         0.01 --units m/s2"
    );
}

#[test]
fn files_of_schema_1_stand_for_20_s_of_el_centro() {
    let text = include_str!("../../../../fuzz/corpus/parameters/paper");
    let old = Parameters::parse("p.json", text).unwrap();
    assert_eq!((old.schema, old.assessment), (1, None));
    let found = old.excitation(Path::new("p.json")).unwrap();
    assert_eq!(
        (&found.record, found.scale, found.duration_s),
        (&Record::el_centro(), 1.0, Some(20.0))
    );
}

#[test]
fn a_way_leads_from_one_folder_to_a_file_in_another() {
    for (folder, file, expected) in [
        ("/a/b/c", "/a/b/d/x", "../d/x"),
        ("/a/b", "/a/b/x", "x"),
        ("/a/b", "/a/x", "../x"),
        ("/a/b", "/c/x", "/c/x"),
        ("out", "x", "../x"),
    ] {
        assert_eq!(way(Path::new(folder), Path::new(file)), Path::new(expected), "{folder} {file}");
    }
}
