//! Tables as spreadsheets and instruments write them, and what their headers say beside them.

use super::*;

/// Sixty rows of a motion in g, by a format of a row.
fn table(header: &str, row: impl Fn(f64, f64) -> String) -> String {
    let value = |i: i32| 0.1 * f64::from(i % 5) * f64::from(1 - 2 * (i % 2));
    header.to_owned()
        + &(0..60).map(|i| row(f64::from(i) * 0.01, value(i)) + "\n").collect::<String>()
}

fn plain(header: &str) -> String {
    table(header, |t, a| format!("{t:.2} {a:.4}"))
}

#[test]
fn empty_columns_a_row_of_units_and_latin_1_are_read() {
    let expected = parse("x", &plain("time (s) acc (g)\n")).unwrap();
    for text in [
        table("time (s),acc (g),,note\n", |t, a| format!("{t:.2},{a:.4},,")),
        table("time (s);acc (g);;\n", |t, a| format!("{t:.2};{a:.4};;")),
        table("sep=;\nTime;Acc\ns;g\n", |t, a| format!("{t:.2};{a:.4}")),
        table("Time\tAcc\ns\tmg\n", |t, a| format!("{t:.2}\t{:.1}", a * 1e3)),
        table("t [s],a [%g]\n", |t, a| format!("{t:.2},{:.2}", a * 1e2)),
    ] {
        let found = parse("x", &text).unwrap();
        let pairs = found.accel.iter().zip(&expected.accel);
        assert!(pairs.clone().count() == 60 && found.dt == 0.01, "{text}");
        assert!(pairs.clone().all(|(a, b)| (a - b).abs() < 1e-12), "{text}");
    }
    let french = table("temps (s);acc\u{e9}l\u{e9}ration (m/s\u{b2})\n", |t, a| {
        format!("{t:.2};{:.5}", a * GRAVITY)
    });
    let latin: Vec<u8> = french.chars().map(|c| c as u8).collect();
    let found = Record::parse("x", &latin, &ReadOptions::default()).unwrap();
    assert!(found.accel.iter().zip(&expected.accel).all(|(a, b)| (a - b).abs() < 1e-5));
    // a velocity is one behind empty columns, too
    let velocity = table("time (s),vel (m/s),,\n", |t, a| format!("{t:.2},{a:.4},,"));
    assert!(matches!(parse("x", &velocity), Err(RecordError::NotAcceleration { .. })));
}

#[test]
fn decimal_commas_between_commas_are_named() {
    let decimal = |x: f64| format!("{x:.4}").replace('.', ",");
    for header in ["time [s],acc [g]\n", ""] {
        let text = table(header, |t, a| format!("{},{}", decimal(t), decimal(a)));
        let error = parse("x.csv", &text).unwrap_err();
        assert!(matches!(error, RecordError::DecimalComma { .. }), "{error}");
    }
}

#[test]
fn columns_keep_names_with_their_units_in_brackets() {
    let text = table("time (s) a (g) v (m/s)\n", |t, a| format!("{t:.2} {a:.4} 0.0"));
    let error = parse("x", &text).unwrap_err().to_string();
    assert!(error.contains("3 columns") && error.contains("a (g)"), "{error}");
    let asked = |name: &str| ReadOptions { component: Some(name.into()), ..Default::default() };
    let read = |name: &str| Record::parse("x", text.as_bytes(), &asked(name));
    let expected = parse("x", &plain("time (s) acc (g)\n")).unwrap();
    assert_eq!(read("a").unwrap().accel, expected.accel);
    assert!(matches!(read("v"), Err(RecordError::NotAcceleration { .. })));
}

#[test]
fn a_header_that_says_another_time_step_than_the_times_is_told() {
    let told = |header: &str| notices_of(&plain(&format!("{header}\ntime (s) acc (g)\n")));
    for header in ["# 2010 Chile, station 12, dt=0.005 s", "# sampled at 200 Hz"] {
        let [Notice::OtherStep { said, dt, .. }] = told(header)[..] else {
            panic!("{header}: {:?}", told(header))
        };
        assert_eq!((said, dt), (0.005, 0.01), "{header}");
    }
    assert_eq!(
        told("# sampled at 200 Hz")[0].to_string(),
        "x.txt: the header says a time step of 0.005 s, the times have 0.01 s, which is taken; \
         check which is right"
    );
    for header in
        ["# dt=0.01 s", "# sampled at 100 Hz", "# sampling rate: 100.4 Hz", "# dt unknown"]
    {
        assert_eq!(told(header), [], "{header}");
    }
}

#[test]
fn a_gap_in_the_times_does_not_ask_for_the_step_that_was_given() {
    let text = plain("time (s) acc (g)\n").replace("0.30 ", "# ");
    let said = |dt| {
        let options = ReadOptions { dt, ..ReadOptions::default() };
        Record::parse("x", text.as_bytes(), &options).unwrap_err().to_string()
    };
    assert!(said(None).ends_with("or if the times are only printed coarsely pass --dt"));
    assert!(
        said(Some(0.01)).ends_with("resample evenly: --dt 0.01 does not make these times even")
    );
}
