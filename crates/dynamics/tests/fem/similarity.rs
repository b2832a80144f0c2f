//! The same case in other units, at another scale, or mirrored is the same case.

use dynamics::{
    fem::{Analysis, Control, History},
    spring::{Chain, Springs},
};
use rocking::{motion::largest_magnitude, structure::Structure};
use strong_motion::{ReadOptions, Record};

use crate::common::{el_centro, lively, paper, plastic, settled, settled_with};

type Make = fn(f64, f64) -> Springs<Chain>;

#[test]
fn the_mirrored_record_gives_the_mirrored_history() {
    let record = el_centro();
    let mirrored = Record { accel: record.accel.iter().map(|a| -a).collect(), ..record.clone() };
    for share in [0.0, 1e-2] {
        let structure = paper(share);
        for make in [plastic, lively] as [Make; 2] {
            let springs = make(80.0, structure.mass_kg);
            let one = settled(&structure, springs, &record);
            let other = settled(&structure, springs, &mirrored);
            assert_eq!(one.impacts(), other.impacts());
            assert!(one.motion.u.iter().zip(&other.motion.u).all(|(a, b)| *a == -b));
            assert!(one.motion.v.iter().zip(&other.motion.v).all(|(a, b)| a == b));
        }
    }
}

/// A history with lengths times `length`, times times its root, masses times `mass`.
fn scaled(structure: &Structure, make: Make, record: &Record, length: f64, mass: f64) -> History {
    let time = length.sqrt();
    let structure = Structure {
        height_m: structure.height_m * length,
        width_m: structure.width_m * length,
        mass_kg: structure.mass_kg * mass,
        rotational_inertia_kgm2: structure.rotational_inertia_kgm2 * mass * length * length,
        ..*structure
    };
    let springs = make(80.0 / time, structure.mass_kg);
    Analysis::new(structure.body(), springs, record.dt * time, &record.accel).simulate()
}

#[test]
fn similar_structures_have_similar_histories_to_the_last_bit() {
    // powers of four, so that scaling does not round
    let record = el_centro();
    for share in [0.0, 1e-2] {
        let structure = paper(share);
        for make in [plastic, lively] as [Make; 2] {
            let one = scaled(&structure, make, &record, 1.0, 1.0);
            for (length, mass) in [(1.0 / 1024.0, 1.0 / 65536.0), (4.0, 2.0), (1024.0, 4096.0)] {
                let other = scaled(&structure, make, &record, length, mass);
                assert_eq!(one.work, other.work, "lengths times {length}");
                assert!(one.motion.u.iter().zip(&other.motion.u).all(|(a, b)| a * length == *b));
                assert!(one.motion.v.iter().zip(&other.motion.v).all(|(a, b)| a * length == *b));
            }
        }
    }
}

#[test]
fn other_units_change_a_history_by_rounding_only() {
    let mut record = el_centro();
    record.accel.truncate(600);
    let structure = paper(0.0);
    let one = scaled(&structure, plastic, &record, 1.0, 1.0);
    // feet and short tons, tonnes, pounds
    for (length, mass) in
        [(3.280_839_895, 1.0 / 907.184_74), (1.0, 1e-3), (1.0, 1.0 / 0.453_592_37)]
    {
        let other = scaled(&structure, plastic, &record, length, mass);
        assert_same(&one, &other, length);
    }
}

#[test]
fn a_record_file_in_g_or_centimetres_gives_the_same_history() {
    let mut record = el_centro();
    record.accel.truncate(600);
    let structure = paper(1e-5);
    let springs = plastic(80.0, structure.mass_kg);
    let one = settled(&structure, springs, &record);
    for (header, unit) in [("UNITS OF G", 9.81), ("UNITS OF M/S/S", 1.0), ("UNITS OF CM/S/S", 0.01)]
    {
        let numbers: Vec<String> = record.accel.iter().map(|a| format!("{:e}", a / unit)).collect();
        let text = format!(
            "a\nb\nACCELERATION IN {header}\nNPTS= 600, DT= .01 SEC\n{}\n",
            numbers.join(" ")
        );
        let read = Record::parse("a.at2", text.as_bytes(), &ReadOptions::default()).unwrap();
        assert_same(&one, &settled(&structure, springs, &read), 1.0);
    }
}

/// The body rests through the quiet, whether or not steps are taken there.
#[test]
fn quiet_before_a_record_only_shifts_the_history() {
    let mut record = el_centro();
    record.accel.truncate(1000);
    // the quiet must not become a ramp
    record.accel[0] = 0.0;
    let shifted =
        Record { accel: [vec![0.0; 137], record.accel.clone()].concat(), ..record.clone() };
    for share in [0.0, 1e-2] {
        let structure = paper(share);
        for make in [plastic, lively] as [Make; 2] {
            let springs = make(80.0, structure.mass_kg);
            let one = settled(&structure, springs, &record);
            for skip_rest in [true, false] {
                let control = Control { skip_rest, ..Control::default() };
                let mut other = settled_with(&structure, springs, &shifted, control);
                for x in [&mut other.motion.u, &mut other.motion.v] {
                    assert!(x.drain(..137).all(|x| x.abs() < 1e-12));
                }
                assert_eq!(one.impacts(), other.impacts());
                assert_same(&one, &other, 1.0);
            }
        }
    }
}

/// u and v of `other` are those of `one` times `length`, but for what rounding does to the steps:
/// 1e-8 of the peak.
fn assert_same(one: &History, other: &History, length: f64) {
    let (one, other) = (&one.motion, &other.motion);
    let largest = largest_magnitude(&one.u);
    for (a, b) in [(&one.u, &other.u), (&one.v, &other.v)] {
        assert_eq!(a.len(), b.len());
        let worst = a.iter().zip(b).map(|(a, b)| (a - b / length).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-8 * largest, "{worst:e} of {largest}");
    }
}
