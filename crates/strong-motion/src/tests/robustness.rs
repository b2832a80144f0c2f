//! Whatever the bytes: a record that passes its own checks, or an error of one line.

use super::super::*;
use proptest::prelude::*;

/// Whatever the bytes, the reader answers: with a record that passes its own checks, or with one
/// line.
fn answers(file: &str, bytes: &[u8], options: &ReadOptions) {
    match Record::parse(file, bytes, options) {
        Ok(record) => assert_eq!(
            Record::new(record.name.clone(), record.dt, record.accel.clone()),
            Ok(record)
        ),
        Err(error) => {
            let message = error.to_string();
            assert!(!message.chars().any(char::is_control) && message.len() < 400, "{message}");
        }
    }
}

fn options() -> impl Strategy<Value = ReadOptions> {
    let units = prop_oneof![
        Just(Units::G),
        Just(Units::MetrePerSecond2),
        Just(Units::CentimetrePerSecond2)
    ];
    (proptest::option::of(prop_oneof![Just(0.01), any::<f64>()]), proptest::option::of(units))
        .prop_map(|(dt, units)| ReadOptions { dt, units, ..ReadOptions::default() })
}

fn valid_file() -> impl Strategy<Value = &'static str> {
    prop_oneof![
        Just("T\nS\nACCELERATION IN UNITS OF G\nNPTS= 4, DT= .01 SEC\n  .1E-01 -.2D-1\n .3-.4\n"),
        Just("UNITS OF CM/S/S\r\n 4 0.0100 NPTS, DT\r\n 1 2\r\n 3 4\r\n"),
        Just("t [s],a [g]\n0.00,0.1\n0.01,-0.2\n0.02,0.3\n0.03,0.1\n"),
        Just("# dt = 0.01 s\n# units: m/s2\n0.1\n-0.2\n0.3\n"),
        Just("t;a (cm/s\u{b2})\n1e-2;10\n2e-2;-20\n3e-2;30\n"),
        Just(include_str!("../../../../fuzz/corpus/record/geonet_v2a")),
        Just(include_str!("../../../../fuzz/corpus/record/geonet_v1a")),
        Just(include_str!("../../../../fuzz/corpus/record/cosmos_v2c")),
        Just(include_str!("../../../../fuzz/corpus/record/csmip_v2")),
        Just(include_str!("../../../../fuzz/corpus/record/knet")),
        Just(include_str!("../../../../fuzz/corpus/record/esm")),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        ..ProptestConfig::with_cases(2000)
    })]

    #[test]
    fn arbitrary_bytes_never_panic(
        bytes in proptest::collection::vec(any::<u8>(), 0..200),
        options in options(),
    ) {
        for file in ["x.at2", "x.csv", ""] {
            answers(file, &bytes, &options);
        }
    }

    #[test]
    fn arbitrary_text_of_the_readers_alphabet_never_panics(
        text in "([-+.,;:=\t\n\r \
            0-9eEdDgm/s\u{b2}#%\"]|NPTS|DT|UNITS|nan|\u{e9}){0,80}", options in options()
    ) {
        for file in ["x.at2", "x.csv"] {
            answers(file, text.as_bytes(), &options);
        }
    }

    #[test]
    fn mutated_files_never_panic(
        file in valid_file(),
        edits in proptest::collection::vec(
            (any::<prop::sample::Index>(), any::<u8>(), 0..4_u8),
            1..6,
        ),
        options in options()
    ) {
        let mut bytes = file.as_bytes().to_vec();
        for (at, byte, edit) in edits {
            if bytes.is_empty() {
                break;
            }
            let at = at.index(bytes.len());
            match edit {
                0 => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                2 => bytes.truncate(at),
                _ => { bytes.remove(at); }
            }
        }
        answers("x.at2", &bytes, &options);
        answers("x.csv", &bytes, &options);
    }
}
