//! Files made in each format come back as the numbers they were made of.

use strong_motion::{Direction, Notice, ReadOptions, RecordFormat, Recording, Units};

use crate::write::{self, DT, PREPENDED, SAMPLES, peak, rounded, wave};

fn read(file: &str, text: &str) -> Recording {
    Recording::parse(file, text.as_bytes(), &ReadOptions::default())
        .unwrap_or_else(|error| panic!("{error}"))
}

fn same(found: &[f64], expected: impl IntoIterator<Item = f64>) {
    let expected: Vec<f64> = expected.into_iter().collect();
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= 1e-12 * (1.0 + b.abs()), "{a} {b}");
    }
}

fn is_of(recording: &Recording, format: RecordFormat, station: &str) {
    assert_eq!((recording.format, recording.station.as_deref()), (format, Some(station)));
}

fn directions(recording: &Recording) -> Vec<Direction> {
    recording.components.iter().map(|component| component.direction).collect()
}

const GEONET: [(&str, f64); 3] = [("N28W", 5000.0), ("S62W", 7000.0), ("Up", 9000.0)];
const COSMOS: [(i64, f64); 3] = [(360, 3.0), (90, 2.0), (400, 4.0)];

#[test]
fn geonet_files_have_three_components() {
    for raw in [false, true] {
        let text = write::geonet(&GEONET, raw);
        let recording = read("x.txt", &text);
        is_of(&recording, RecordFormat::GeoNet, "TEST Made up Farm");
        assert_eq!(
            directions(&recording),
            [Direction::Azimuth(332.0), Direction::Azimuth(242.0), Direction::Vertical]
        );
        for (component, scale) in recording.components.iter().zip([5000.0, 7000.0, 9000.0]) {
            let values = rounded(&wave(scale, 0.3), 1);
            same(&component.record.accel, values.iter().map(|mm| mm * 1e-3));
            assert_eq!((component.record.dt, component.units), (DT, Units::MillimetrePerSecond2));
            let (value, time) = peak(&values);
            let header = component.header_pga.unwrap();
            assert_eq!(component.start, if raw { 0.0 } else { -PREPENDED });
            let time = component.start + time;
            assert!(
                (header.value - value * 1e-3).abs() < 1e-9
                    && (header.time.unwrap() - time).abs() < 1e-9
            );
            assert_eq!(component.header_pgv.is_some(), !raw);
        }
        // the stronger horizontal one, said aloud
        assert_eq!(recording.taken, 1);
        assert!(
            matches!(&recording.notices()[..], [Notice::Taken { taken, .. }] if taken == "S62W \
                (azimuth 242)")
        );
        assert_eq!(recording.into_record().name, "x S62W");
    }
}

#[test]
fn a_component_is_chosen_by_name_or_azimuth() {
    let text = write::geonet(&GEONET, false);
    let choose = |wanted: &str| {
        let options = ReadOptions { component: Some(wanted.into()), ..ReadOptions::default() };
        Recording::parse("x.V2A", text.as_bytes(), &options)
    };
    for (wanted, taken) in
        [("N28W", 0), ("n28w", 0), ("332", 0), ("-28", 0), ("242.2", 1), ("up", 2), ("vertical", 2)]
    {
        let recording = choose(wanted).unwrap();
        assert_eq!((recording.taken, recording.notices()), (taken, vec![]), "{wanted}");
    }
    for wanted in ["90", "N", "", "?"] {
        let message = choose(wanted).unwrap_err().to_string();
        assert!(
            message.contains("no component") && message.contains("S62W (azimuth 242)"),
            "{message}"
        );
    }
    let twice = write::csmip(&[("90 Deg", 10.0), ("90 Deg", 20.0), ("360 Deg", 5.0)]);
    let options =
        |wanted: &str| ReadOptions { component: Some(wanted.into()), ..ReadOptions::default() };
    let message =
        Recording::parse("x.V2", twice.as_bytes(), &options("90")).unwrap_err().to_string();
    assert!(message.contains("more than one component 90"), "{message}");
    assert_eq!(Recording::parse("x.V2", twice.as_bytes(), &options("chan 2")).unwrap().taken, 1);
    assert!(Recording::parse("x", b"# g, dt = 0.01\n0.1\n", &options("90")).is_err());
}

#[test]
fn cosmos_channels_have_the_step_of_the_data_not_of_the_raw_record() {
    for (unit, factor) in [(("cm/sec2", 4), 0.01), (("g", 2), 9.81), (("gal", 10), 0.01)] {
        let recording = read("x", &write::cosmos(&COSMOS, unit));
        is_of(&recording, RecordFormat::Cosmos, "XX-TEST Test Place");
        assert_eq!(
            directions(&recording),
            [Direction::Azimuth(0.0), Direction::Azimuth(90.0), Direction::Vertical]
        );
        for (component, scale) in recording.components.iter().zip([3.0, 2.0, 4.0]) {
            same(&component.record.accel, rounded(&wave(scale, 0.3), 5).iter().map(|a| a * factor));
            assert!((component.record.dt - DT).abs() < 1e-15);
        }
        assert_eq!(recording.taken, 0);
    }
    // without a code the words tell the azimuth, in both spellings
    let text = write::cosmos(&[(-999, 3.0)], ("cm/sec2", 4));
    assert_eq!(read("x", &text).component().label(), "Chan 1 (azimuth 45)");
    assert_eq!(
        read("x", &text.replace("Sta Chan ", "Sta Cha: ")).component().label(),
        "Chan 1 (azimuth 45)"
    );
    // a peak known to three decimals, its field filled with zeros
    let (value, _) = peak(&rounded(&wave(3.0, 0.3), 5));
    let coarse = text.replace(&format!("{value:15.6}"), &format!("{value:12.3}000"));
    assert!(coarse != text && read("x", &coarse).component().header_pga.is_some());
}

#[test]
fn csmip_channels_are_read_by_their_announced_formats() {
    let text = write::csmip(&[("90 Deg", 60.0), ("360 Deg", 80.0), (" Up", 70.0)]);
    for text in [text.replace("\r\n", "\n"), text.clone()] {
        let recording = read("x", &text);
        is_of(&recording, RecordFormat::Csmip, "12345 Test Place");
        let labels: Vec<String> = recording.components.iter().map(|c| c.label()).collect();
        assert_eq!(labels, ["Chan 1 (azimuth 90)", "Chan 2 (azimuth 0)", "Chan 3 (vertical)"]);
        for (component, scale) in recording.components.iter().zip([60.0, 80.0, 70.0]) {
            same(&component.record.accel, rounded(&wave(scale, 0.3), 4).iter().map(|cm| cm * 0.01));
            assert!(component.header_pgv.is_some() && component.record.dt == DT);
        }
        assert_eq!(recording.taken, 1);
    }
    let capitals = read("x", &text.to_uppercase());
    assert_eq!((capitals.component().label().as_str(), capitals.taken), ("Chan 2 (azimuth 0)", 1));
}

#[test]
fn knet_counts_are_scaled_and_lose_their_mean() {
    let (_, gal) = write::knet_counts();
    for (dir, name, direction) in [
        ("N-S", "N-S", Direction::Azimuth(0.0)),
        ("E-W", "E-W", Direction::Azimuth(90.0)),
        ("5", "EW2", Direction::Azimuth(90.0)),
        ("3", "UD1", Direction::Vertical),
    ] {
        let recording = read("TST001.EW", &write::knet(dir));
        is_of(&recording, RecordFormat::KNet, "TST001");
        let component = recording.component();
        assert_eq!((component.name.as_deref(), component.direction), (Some(name), direction));
        assert_eq!(component.record.dt, 0.01);
        same(&component.record.accel, gal.iter().map(|gal| gal * 0.01));
        let only =
            recording.notices().iter().any(|notice| matches!(notice, Notice::OnlyVertical { .. }));
        assert_eq!(only, direction == Direction::Vertical);
    }
    // newer files spell it without the point
    assert_eq!(
        read("x", &write::knet("N-S").replace("Max. Acc. (gal) ", "Max Acc. (gal)  ")).format,
        RecordFormat::KNet
    );
}

#[test]
fn esm_files_have_one_value_a_line() {
    for (stream, direction) in [("HNE", Direction::Azimuth(90.0)), ("HNZ", Direction::Vertical)] {
        let recording = read("x.asc", &write::dyna(stream, -30.0));
        is_of(&recording, RecordFormat::Dyna, "XX TST Test Place");
        let component = recording.component();
        assert_eq!((component.name.as_deref(), component.direction), (Some(stream), direction));
        assert_eq!((component.record.dt, component.record.len()), (DT, SAMPLES));
        same(&component.record.accel, rounded(&wave(-30.0, 0.3), 6).iter().map(|cm| cm * 0.01));
    }
}

/// What the file says is not taken from the user.
#[test]
fn options_must_agree_with_the_file() {
    for text in [
        write::geonet(&[("N28W", 5000.0)], false),
        write::cosmos(&[(360, 3.0)], ("cm/sec2", 4)),
        write::csmip(&[("90 Deg", 60.0)]),
        write::knet("N-S"),
        write::dyna("HNE", 30.0),
    ] {
        let with = |dt, units| {
            let options = ReadOptions { dt, units, ..ReadOptions::default() };
            Recording::parse("x", text.as_bytes(), &options)
                .map(|_| ())
                .map_err(|error| error.to_string())
        };
        assert!(with(None, Some(Units::MetrePerSecond2)).unwrap_err().contains("says its unit is"));
        assert!(with(Some(0.03), None).unwrap_err().contains("time step is"));
    }
}

/// Files as other programs leave them on the way: other line ends, a mark of byte order, tabs,
/// blanks, no last line end.
#[test]
fn a_file_says_the_same_however_its_lines_end() {
    let files = [
        write::geonet(&GEONET, true),
        write::cosmos(&COSMOS, ("cm/sec2", 4)),
        write::csmip(&[("90 Deg", 10.0), ("360 Deg", 5.0)]),
        write::knet("N-S"),
        write::dyna("HNE", 30.0),
    ];
    for text in files {
        let expected = read("x", &text);
        let unix = text.replace("\r\n", "\n");
        let changed = [
            unix.replace('\n', "\r\n"),
            unix.replace('\n', "\r"),
            format!("\u{feff}{unix}"),
            unix.trim_end().to_owned(),
            format!("{}\n\n   \n", unix.trim_end()),
            unix.lines().map(|line| format!("{line} \t ")).collect::<Vec<_>>().join("\n"),
            format!("{}\n\u{1a}", unix.trim_end()),
        ];
        for changed in changed {
            let found = read("x", &changed);
            assert_eq!((found.format, found.taken), (expected.format, expected.taken));
            assert_eq!(found.components.len(), expected.components.len());
            for (found, expected) in found.components.iter().zip(&expected.components) {
                assert_eq!(found.record.accel, expected.record.accel);
                assert_eq!(
                    (found.record.dt, found.direction),
                    (expected.record.dt, expected.direction)
                );
            }
        }
    }
}

/// Instruments of K-NET and KiK-net differ in their scale factors and rates.
#[test]
fn knet_scale_factors_and_rates_are_the_header_s() {
    let (counts, gal) = write::knet_counts();
    let largest = gal.iter().fold(0.0, |most: f64, a| most.max(a.abs()));
    let (most, mean) =
        (3920.0 / 6_182_761.0, counts.iter().sum::<i64>() as f64 / counts.len() as f64);
    for (scale, hz, seconds) in
        [((2000.0, 8_388_608.0), 200.0, "1"), ((7845.0, 8_223_790.0), 100.0, "2")]
    {
        let factor = scale.0 / scale.1;
        let text = write::knet("4")
            .replace("3920(gal)/6182761", &format!("{}(gal)/{}", scale.0, scale.1))
            .replace("100Hz", &format!("{hz}Hz"))
            .replace("Duration Time(s)  2", &format!("Duration Time(s)  {seconds}"))
            .replace(&format!("{largest:.3}"), &format!("{:.3}", largest / most * factor));
        let recording = read("x.NS2", &text);
        let record = &recording.components[0].record;
        assert_eq!((recording.format, record.dt), (RecordFormat::KNet, 1.0 / hz));
        same(&record.accel, counts.iter().map(|count| (*count as f64 - mean) * factor * 0.01));
    }
}

/// ESM and its relatives add keys; AFAD gives the peak without its sign.
#[test]
fn unknown_keys_of_a_header_are_passed_over() {
    let text = write::dyna("HNE", 30.0);
    let expected = read("x", &text);
    let more = text.replace(
        "HEADER_FORMAT",
        "NDBC: 3\nBOGUS: 12.5: x\nLATE_NORMAL_TRIGGERED: \nUSER1:\t7\nHEADER_FORMAT",
    );
    assert_eq!(read("x", &more).components[0].record.accel, expected.components[0].record.accel);
    assert_eq!(read("x", &text.replace("PGA_CM/S^2: -", "PGA_CM/S^2: ")).components.len(), 1);
}
