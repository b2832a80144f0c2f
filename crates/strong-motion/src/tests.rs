use super::*;

mod robustness;
mod spreadsheet;

fn parse(file: &str, text: &str) -> Result<Record, RecordError> {
    Record::parse(file, text.as_bytes(), &ReadOptions::default())
}

fn notices_of(text: &str) -> Vec<Notice> {
    Recording::parse("x.txt", text.as_bytes(), &ReadOptions::default()).unwrap().notices()
}

/// Bare values at steps of 0.01 s.
fn in_steps(units: Units) -> ReadOptions {
    ReadOptions { dt: Some(0.01), units: Some(units), ..ReadOptions::default() }
}

/// PEER's own figures for the record: dt 0.01 s, PGA 0.313 g; the file's first and last samples.
#[test]
fn el_centro_is_the_peer_record() {
    let record = Record::el_centro();
    assert_eq!((record.name.as_str(), record.dt, record.len()), ("IELC180", 0.01, 3995));
    assert_eq!(format!("{:.3}", record.pga_g()), "0.313");
    assert_eq!(record.accel[0], -6.40318e-3 * GRAVITY);
    assert_eq!(record.accel[3994], 1.2536e-4 * GRAVITY);
    assert!((record.duration() - 39.94).abs() < 1e-12);
    assert_eq!(record.truncated(20.0).len(), 2001);
}

#[test]
fn both_at2_headers_any_columns_and_line_ends_give_the_same_record() {
    let titles =
        "PEER STRONG MOTION DATABASE RECORD\nSOMEWHERE\nACCELERATION TIME HISTORY IN UNITS OF G\n";
    let expected =
        Record::new("x", 0.01, [0.1, -0.2, 0.3, 0.25].map(|g| g * GRAVITY).to_vec()).unwrap();
    for header in ["NPTS=  4, DT= .01000 SEC", "  4   0.0100  NPTS, DT", "NPTS=4, DT=.01 SEC,"] {
        for data in [
            ".1 -.2 .3 .25",
            "1.0E-01 -.2E+00\n\n  .3D+00   0.25\n",
            ".1,-.2,.3,.25\n",
            " .1-.2+.3+.25",
        ] {
            let text = format!("{titles}{header}\n{data}");
            for text in [text.replace('\n', "\r\n"), text.replace('\n', "\r"), text] {
                assert_eq!(parse("folder/x.at2", &text).as_ref(), Ok(&expected), "{text:?}");
                assert_eq!(parse("x.txt", &text).as_ref(), Ok(&expected), "{text:?}");
            }
        }
    }
}

#[test]
fn tables_give_the_same_record_whatever_separates_their_columns() {
    let expected = Record::new("x", 0.02, [0.0, 0.5, -1.25].to_vec()).unwrap();
    for text in [
        "time_s,accel_m_s2\n0.00,0\n0.02,0.5\n0.04,-1.25\n",
        "# from somewhere\n# t [s]  a [m/s2]\n0 0\n0.02 0.5\n0.04 -1.25",
        "t;a [cm/s2]\r\n0.02;0\r\n0.04;50\r\n0.06;-125\r\n",
        "% units: Gal\n0\t0\n\n  2e-2\t50\n// the end is near\n4e-2\t-125\n",
        "Caf\u{e9}\n\"t\",\"a (m/s^2)\"\n\"0\",\"0.0\",\n\"0.02\",\"0.5\",\n\"0.04\",\"-1.25\",\n",
        "EVENT_NAME: Umbria\nSAMPLING_INTERVAL_S: 0.020\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n\
         0\n50\n-125\n",
        "# dt = 0.02 s, acceleration in units of m/s2\n0\n0.5\n-1.25\n",
    ] {
        assert_eq!(parse("x.csv", text).as_ref(), Ok(&expected), "{text:?}");
    }
}

#[test]
fn one_column_needs_the_time_step_and_the_unit() {
    let text = "0.1\n-0.2\n";
    assert_eq!(parse("x", text), Err(RecordError::NoStep { file: "x".into() }));
    let options = ReadOptions { dt: Some(0.01), ..ReadOptions::default() };
    assert_eq!(
        Record::parse("x", text.as_bytes(), &options),
        Err(RecordError::NoUnits { file: "x".into() })
    );
    let options = ReadOptions { units: Some(Units::G), ..options };
    let record = Record::parse("x", text.as_bytes(), &options).unwrap();
    assert_eq!(record.accel, [0.1 * GRAVITY, -0.2 * GRAVITY]);
}

#[test]
fn what_the_file_says_and_the_user_says_must_agree() {
    let text = "UNITS OF G\nNPTS= 2, DT= .0039 SEC\n.1 .2\n";
    let read = |dt, units| {
        Record::parse(
            "x.at2",
            text.as_bytes(),
            &ReadOptions { dt, units, ..ReadOptions::default() },
        )
    };
    assert!(matches!(read(Some(0.01), None), Err(RecordError::StepDiffers { .. })));
    assert!(matches!(
        read(None, Some(Units::MetrePerSecond2)),
        Err(RecordError::UnitsDiffer { .. })
    ));
    // 1/256 s printed with four decimals: the user's is the sharper one
    assert_eq!(read(Some(0.00390625), Some(Units::G)).unwrap().dt, 0.00390625);
    assert!(matches!(read(Some(0.0), None), Err(RecordError::BadStep { .. })));
}

/// Damage of every kind, and the words of the message that say what, where and what to do.
#[test]
fn every_damage_is_an_error_of_one_line_with_place_and_remedy() {
    let at2 = "T\nS\nACCELERATION IN UNITS OF G\nNPTS= 4, DT= .01 SEC\n.1 .2\n.3 .4\n";
    for (file, text, words) in [
        (
            "a.at2",
            at2.replace(".3 .4", ".3"),
            "line 6: the file ends after 3 samples but its header (line 4) says NPTS 4",
        ),
        (
            "a.at2",
            at2.replace(".3 .4", ".3 .4 .5"),
            "line 6: the file holds 5 samples and its header",
        ),
        ("a.at2", at2.replace("NPTS= 4,", "NPTS= 999999999999,"), "says NPTS 999999999999"),
        (
            "a.at2",
            at2.replace("NPTS= 4,", "NPTS= 99999999999999999999999,"),
            "line 4: cannot read NPTS and DT",
        ),
        ("a.at2", at2.replace("DT= .01", "DT= -.01"), "line 4: cannot read NPTS and DT"),
        ("a.at2", at2.replace("DT= .01", "DT= 5."), "between 1e-6 and 1 s"),
        ("a.at2", at2.replace("NPTS", "SAMPLES"), "no line with NPTS and DT"),
        ("a.at2", at2.replace(".3", "NaN"), "line 6: 'NaN' is not a finite number"),
        ("a.at2", at2.replace(".3", "1e999"), "line 6: '1e999' is not a finite number"),
        ("a.at2", at2.replace(".3", "*******"), "line 6: '*******' is not a number"),
        (
            "a.at2",
            at2.replace("ACCELERATION IN UNITS OF G", "VELOCITY IN UNITS OF CM/S"),
            "speaks of velocity",
        ),
        (
            "a.at2",
            at2.replace("T\n", "ACCELEROGRAPH 7\n")
                .replace("ACCELERATION IN", "DISPLACEMENT TIME SERIES IN"),
            "speaks of displacement",
        ),
        ("a.at2", at2.replace("UNITS OF G", "SOMETHING"), "pass --units"),
        (
            "a.at2",
            at2.replace(".3", "341.7"),
            "above 50 g; the unit or the scale is probably wrong",
        ),
        ("a.at2", at2.replace('T', "\0"), "not a text file (byte 0 is 0x00)"),
        ("a.at2", String::new(), "holds no samples"),
        ("a.csv", " \n \n".into(), "holds no samples"),
        ("a.csv", "t,a [g]\n".into(), "holds no samples"),
        (
            "a.csv",
            "# units g\n0.00 .1\n0.01 .2\n0.03 .3\n0.04 .3\n".into(),
            "line 4: the time step is 0.02 s where 0.01 s",
        ),
        ("a.csv", "t,a [g]\n0.00,.1\n0.01,nan\n".into(), "line 3: 'nan' is not a finite number"),
        ("a.csv", "t,a [g]\n0.00,.1\n0.01,x\n".into(), "line 3: 'x' is not a number"),
        ("a.csv", "t,a [g]\n0.00,x\n0.01,.1\n0.02,.1\n".into(), "line 2: 'x' is not a number"),
        (
            "a.csv",
            "t,a [g]\n0.00,.1\n0.01\n".into(),
            "line 3: 1 column where the lines before have 2",
        ),
        ("a.csv", "t,a [g]\n0.00,.1\n0.01,\n".into(), "line 3: 1 column"),
        ("a.csv", "t,a [g],b\n0.00,.1,1\n".into(), "line 2: 3 columns"),
        ("a.csv", "t;a [g]\n0,00;0,1\n0,01;0,2\n".into(), "line 2: '0,00;0,1' has decimal commas"),
        ("a.csv", "t a [g]\n0,00 0,1\n".into(), "line 2: '0,00 0,1' has decimal commas"),
        ("a.csv", "a [g]\n0,01\n0,02\n0,03\n".into(), "line 2: '0,01' has decimal commas"),
        ("a.csv", "t,a\n0.00,.1\n0.01,.2\n".into(), "pass --units"),
        ("a.csv", "t [s],v [m/s], velocity\n0.00,.1\n0.01,.2\n".into(), "speaks of velocity"),
        ("a.csv", "t,a [g]\n0.00,.1\n".into(), "pass --dt"),
        ("a.csv", "t,a [g]\n0,.1\n2,.1\n4,.1\n".into(), "between 1e-6 and 1 s"),
        ("a\nb.csv", "t,a\n0.0,\x01".into(), "a\\nb.csv: not a text file"),
    ] {
        let message = parse(file, &text).expect_err(&text).to_string();
        assert!(message.contains(words), "{text:?}: {message}");
        assert!(!message.contains('\n') && message.starts_with('a'), "{message}");
    }
}

/// Tables that are not records say so, and are never half read.
#[test]
fn misreadings_are_refused() {
    let given = in_steps(Units::CentimetrePerSecond2);
    let rows = |row: &dyn Fn(usize) -> String| (1..40).map(row).collect::<String>();
    let wave = |i: usize| (i as f64).sin();
    let table = rows(&|i| format!("{:.2},{:.3}\n", 0.01 * i as f64, wave(i)));
    let column = rows(&|i| format!("{:.3}\n", wave(i)));
    for (text, words) in [
        ("a,b,c\n1,2,3\n".to_owned(), "line 2: 3 columns"),
        (
            rows(&|i| format!("{:.2} {:.3} {:.3}\n", 0.01 * i as f64, wave(i), wave(2 * i))),
            "line 1: 3 columns",
        ),
        (rows(&|i| format!("{i} {:.3}\n", wave(i))), "line 1: the first column counts rows"),
        (
            rows(&|i| format!("{}.0,{:.3}\n", i - 1, wave(i))),
            "line 1: the first column counts rows",
        ),
        (
            rows(&|i| format!("{:.2},{:.3}\n", 0.01 * i as f64, 2.0 + wave(i))),
            "never changes its sign",
        ),
        (
            rows(&|i| format!("{:.4},{:.3}\n", 0.01 * 1.2_f64.powi(i as i32), 2.0 + wave(i))),
            "never changes its sign",
        ),
        (format!("Period (s),Sa (g)\n{table}"), "a spectrum"),
        (format!("t,v [m/s]\n{table}"), "speaks of velocity"),
        (format!("t,d [cm]\n{table}"), "speaks of displacement"),
        (format!("# units: cm/s\n{column}"), "speaks of velocity"),
        (
            rows(&|i| format!("{} {} {}\n", 8000 + i % 7, 8000 + i % 5, 8000 - i % 3)),
            "counts of a digitiser",
        ),
        (format!("# unit: counts\n{column}"), "counts of a digitiser"),
        (format!("# unit: m/s2\n{column}"), "the file says its unit is m/s2"),
    ] {
        let message = Record::parse("x.csv", text.as_bytes(), &given).expect_err(&text).to_string();
        assert!(message.contains(words), "{}: {message}", &text[..30]);
    }
    let utf16: Vec<u8> = "t,a [g]\n0,1\n".encode_utf16().flat_map(u16::to_le_bytes).collect();
    assert!(matches!(
        Record::parse("x.csv", &utf16, &ReadOptions::default()),
        Err(RecordError::Binary { .. })
    ));
}

#[test]
fn bare_values_in_several_columns_are_read_row_by_row() {
    let given = in_steps(Units::MetrePerSecond2);
    let expected = [0.1, -0.2, 0.3, 0.4, -0.5, 0.6, -0.7, 0.8];
    for text in
        ["title\n0.1 -0.2 0.3\n0.4 -0.5 0.6\n-0.7 0.8\n", "0.1,-0.2,0.3,0.4\n-0.5,0.6,-0.7,0.8\n"]
    {
        assert_eq!(Record::parse("x", text.as_bytes(), &given).unwrap().accel, expected, "{text}");
    }
    let two = "0.1 -0.2\n0.3 0.4\n-0.5 0.6\n-0.7 0.8\n0.2 0.1\n-0.1";
    assert_eq!(Record::parse("x", two.as_bytes(), &given).unwrap().len(), 11);
    assert!(matches!(parse("x", two), Err(RecordError::Ragged { line: 6, .. })));
    let cut = "0.1 -0.2 0.3\n0.4 -0.5\n-0.7 0.8 0.9\n";
    assert!(matches!(
        Record::parse("x", cut.as_bytes(), &given),
        Err(RecordError::Ragged { line: 2, .. })
    ));
}

#[test]
fn an_offset_is_said_and_removed_when_asked() {
    let text = "# dt = 0.01 s, acceleration in m/s2\n1.5\n0.5\n1.25\n0.75\n";
    let read = |baseline| {
        let options = ReadOptions { baseline, ..ReadOptions::default() };
        Recording::parse("x.txt", text.as_bytes(), &options).unwrap()
    };
    let plain = read(false);
    assert!(matches!(plain.notices()[..],
            [Notice::Offset { share, .. }] if (share - 1.0 / 1.5).abs() < 1e-12));
    let removed = read(true);
    assert_eq!((removed.notices(), removed.component().offset), (vec![], 1.0));
    assert_eq!(removed.into_record().accel, [0.5, -0.5, 0.25, -0.25]);
}

#[test]
fn peaks_that_earthquakes_do_not_have_are_said() {
    let notices = |accel: f64| {
        let text = format!("# dt = 0.01 s, acceleration in m/s2\n{accel}\n{}\n", -accel);
        notices_of(&text)
    };
    assert!(matches!(notices(60.0)[..], [Notice::Strong { .. }]));
    assert!(matches!(notices(5e-4)[..], [Notice::Weak { .. }]));
    assert_eq!(notices(3.0), []);
}

/// One motion, its times in s and in ms.
#[test]
fn times_in_milliseconds_are_converted_and_other_units_refused() {
    let parse = |header: &str, by: f64| {
        let row = |i: i32| {
            format!("{},{}\n", f64::from(i) * 0.005 * by, 0.1 * f64::from(1 - 2 * (i % 2)))
        };
        let text = format!("{header}\n{}", (0..40).map(row).collect::<String>());
        Recording::parse("x.csv", text.as_bytes(), &ReadOptions::default())
    };
    let seconds = parse("time (s),acc (g)", 1.0).unwrap();
    assert_eq!((seconds.component().record.dt, seconds.notices()), (0.005, vec![]));
    for header in ["time (ms),acc (g)", "Time [msec],a [g]", "t_ms,acc_g", "# t [ms], a [g]"] {
        let read = parse(header, 1e3).unwrap();
        assert_eq!(read.component().record, seconds.component().record, "{header}");
        let told = read.notices();
        assert_eq!(told, [Notice::Milliseconds { file: "x.csv".into(), dt: 0.005 }]);
        assert_eq!(
            told[0].to_string(),
            "x.csv: times in ms, as their column is named, make a step of 0.005 s"
        );
    }
    // names with blanks, between blanks
    let text = "time (ms)  acc (m/s2)\n0.0 0.1\n0.5 -0.1\n1.0 0.2\n1.5 -0.1\n";
    let read = Record::parse("x", text.as_bytes(), &ReadOptions::default()).unwrap();
    assert_eq!(read.dt, 0.0005);
    let refused = parse("# a comment\ntime (min),acc (g)", 1.0 / 60.0).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "x.csv, line 2: times in 'min' are not known; give them in s or in ms"
    );
}

/// 2 m/s2 for 2 s and back: 4 m/s.
#[test]
fn time_steps_and_velocities_that_records_do_not_have_are_said() {
    let notices = |dt: f64, halves: usize| {
        let line = |i: usize| if i < halves { "2.0\n" } else { "-2.0\n" };
        let text = (0..2 * halves).map(line).collect::<String>();
        let text = format!("# dt = {dt} s, acceleration in m/s2\n{text}");
        notices_of(&text)
    };
    assert!(matches!(notices(0.05, 4)[..], [Notice::Coarse { dt: 0.05, .. }]));
    assert_eq!(notices(0.04, 4), []);
    let fast = notices(0.01, 200);
    let [Notice::Fast { pgv, .. }] = fast[..] else { panic!("{fast:?}") };
    // but for half of the step in which it turns
    assert!((pgv - 4.0).abs() < 0.02, "{pgv}");
    assert_eq!(notices(0.01, 140), []);
}

#[test]
fn records_are_checked_scaled_cut_and_interpolated() {
    let record = Record::new("r", 0.5, vec![0.0, 1.0, -3.0]).unwrap();
    assert_eq!(
        (record.pga(), record.duration(), record.len(), record.is_empty()),
        (3.0, 1.0, 3, false)
    );
    assert_eq!(record.scaled(-2.0).unwrap().accel, [0.0, -2.0, 6.0]);
    assert_eq!(record.truncated(0.5).accel, [0.0, 1.0]);
    assert_eq!(record.truncated(0.0).len(), 1);
    assert_eq!(record.truncated(f64::NAN).len(), 1);
    assert_eq!(record.truncated(f64::INFINITY).len(), 3);
    assert_eq!(
        [-0.1, 0.0, 0.25, 0.75, 1.0, 1.1, f64::NAN].map(|t| record.at(t)),
        [0.0, 0.0, 0.5, -1.0, -3.0, 0.0, 0.0]
    );
    assert!(matches!(record.scaled(f64::NAN), Err(RecordError::BadSample { index: 0, .. })));
    assert!(matches!(record.scaled(1000.0), Err(RecordError::HugePeak { .. })));
    assert!(matches!(Record::new("r", 0.01, vec![]), Err(RecordError::Empty { .. })));
    for dt in [0.0, -0.01, f64::NAN, f64::INFINITY, 1e-7, 1.1] {
        assert!(matches!(Record::new("r", dt, vec![0.0]), Err(RecordError::BadStep { .. })));
    }
}

#[test]
fn a_folder_is_read_in_order_and_a_bad_file_does_not_end_it() {
    let folder = tempfile::tempdir().unwrap();
    let options = ReadOptions::default();
    assert!(matches!(Record::list_dir(folder.path()), Err(RecordError::NoRecords { .. })));
    for (file, text) in [
        ("c.AT2", "UNITS OF G\nNPTS= 1, DT= .01\n.1"),
        ("b.txt", "nothing"),
        ("a.csv", "t,a [g]\n0,.1\n.01,.2\n"),
        ("README.md", "not a record"),
    ] {
        std::fs::write(folder.path().join(file), text).unwrap();
    }
    std::fs::create_dir(folder.path().join("sub.csv")).unwrap();
    let files = Record::list_dir(folder.path()).unwrap();
    let names: Vec<_> =
        files.iter().map(|path| path.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(names, ["a.csv", "b.txt", "c.AT2"]);
    let read: Vec<_> = files.iter().map(|path| Record::read(path, &options)).collect();
    assert_eq!(read[0].as_ref().unwrap().name, "a");
    assert!(matches!(read[1], Err(RecordError::Empty { .. })));
    assert_eq!(read[2].as_ref().unwrap().len(), 1);

    assert!(matches!(Record::read(folder.path(), &options), Err(RecordError::Folder { .. })));
    let missing = folder.path().join("missing.at2");
    assert!(matches!(Record::read(&missing, &options), Err(RecordError::Unreadable { .. })));
    assert!(matches!(Record::list_dir(&missing), Err(RecordError::Unreadable { .. })));
}
