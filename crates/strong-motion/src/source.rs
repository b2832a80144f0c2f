//! Where a record comes from, and a number that tells whether it is still the same.

use std::path::PathBuf;

use super::{Record, Units};

/// Where a record comes from, as far as it takes to have it again.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Source {
    /// Numbers in memory.
    #[default]
    Numbers,
    /// Part of the program: El Centro.
    Embedded,
    /// A file, as it was named, the unit of its numbers, which of its components it is where it has
    /// several, and whether its mean was taken off.
    File {
        /// The file.
        path: PathBuf,
        /// Unit of its numbers.
        units: Units,
        /// The component taken, where it has several.
        component: Option<String>,
        /// Whether the mean of the samples was subtracted.
        baseline: bool,
        /// Peak of the vertical component that the file has and the record does not (g), of the
        /// file as it is.
        vertical_left_out_g: Option<f64>,
        /// The component taken as the horizontal motion, if it is a vertical one.
        vertical_taken: Option<String>,
    },
    /// Made from a seed for a structure.
    Synthetic,
    /// Made from a seed, with the frequencies of earthquakes.
    Earthquake,
}

impl Record {
    /// FNV-1a (64 bit, G. Fowler, L. C. Noll, K.-P. Vo) of dt and the samples, each as the eight
    /// bytes of its IEEE 754 number, least significant first: the same for the same numbers on
    /// every machine. It finds a file that was replaced, not one that was forged.
    pub fn fingerprint(&self) -> u64 {
        let numbers = std::iter::once(&self.dt).chain(&self.accel);
        fnv1a(numbers.flat_map(|x| x.to_bits().to_le_bytes()))
    }
}

/// FNV-1a of 64 bits.
pub fn fnv1a(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Test vectors of the Internet draft draft-eastlake-fnv, appendix C.
    #[test]
    fn the_hash_is_fnv_1a_of_64_bits() {
        for (text, hash) in [
            ("", 0xcbf2_9ce4_8422_2325),
            ("a", 0xaf63_dc4c_8601_ec8c),
            ("foobar", 0x8594_4171_f739_67e8),
        ] {
            assert_eq!(fnv1a(text.bytes()), hash, "{text}");
        }
    }

    #[test]
    fn any_change_of_a_number_changes_the_fingerprint() {
        let record = Record::new("a", 0.01, vec![0.0, 0.5, -1.0]).unwrap();
        let changed = [
            Record { dt: 0.010_000_000_000_000_002, ..record.clone() },
            Record { accel: vec![0.0, 0.5, -1.0, 0.0], ..record.clone() },
            Record { accel: vec![0.0, 0.5 + f64::EPSILON, -1.0], ..record.clone() },
            Record { accel: vec![0.5, 0.0, -1.0], ..record.clone() },
        ];
        assert!(changed.iter().all(|other| other.fingerprint() != record.fingerprint()));
        let named = Record { name: "b".into(), source: Source::Embedded, ..record.clone() };
        assert_eq!(named.fingerprint(), record.fingerprint());
    }
}
