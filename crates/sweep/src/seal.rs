//! What the file of a part says of itself: of which sweep it is, which part of how many, how many
//! rows it has, and a checksum.
//!
//! The checksum is FNV-1a of all bytes of the file, with zeros where the checksum itself stands. It
//! is looked at before anything else in the file is believed. FNV-1a is a bijection of its state
//! for each byte: a file in which one byte differs never has the same.

use strong_motion::fnv1a;

/// Names in the file's metadata.
pub(crate) const SWEEP: &str = "groundspring.sweep";
pub(crate) const PART: &str = "groundspring.part";
pub(crate) const PARTS: &str = "groundspring.parts";
pub(crate) const ROWS: &str = "groundspring.rows";
pub(crate) const CHECKSUM: &str = "groundspring.checksum";

/// What stands before the digits of the checksum. It is the last of its kind in a file: the
/// metadata stand at the end.
const MARK: &[u8] = b"fnv1a64:";
const DIGITS: usize = 16;

/// The metadata of a part, with zeros for the checksum.
pub(crate) fn metadata(
    sweep: &str,
    part: u64,
    parts: u64,
    rows: usize,
) -> Vec<(&'static str, String)> {
    let zeros = format!("{}{}", String::from_utf8_lossy(MARK), "0".repeat(DIGITS));
    vec![
        (SWEEP, sweep.to_string()),
        (PART, part.to_string()),
        (PARTS, parts.to_string()),
        (ROWS, rows.to_string()),
        (CHECKSUM, zeros),
    ]
}

/// Where the digits of the checksum are.
fn digits(bytes: &[u8]) -> Option<std::ops::Range<usize>> {
    let from = bytes.windows(MARK.len()).rposition(|window| window == MARK)? + MARK.len();
    (from + DIGITS <= bytes.len()).then_some(from..from + DIGITS)
}

fn checksum(bytes: &[u8], digits: &std::ops::Range<usize>) -> String {
    let zeroed =
        bytes.iter().enumerate().map(|(i, byte)| if digits.contains(&i) { b'0' } else { *byte });
    format!("{:016x}", fnv1a(zeroed))
}

/// Put the checksum into a file; nothing if it has no place for it.
pub(crate) fn seal(bytes: &mut [u8]) {
    if let Some(digits) = digits(bytes) {
        let sum = checksum(bytes, &digits);
        bytes[digits].copy_from_slice(sum.as_bytes());
    }
}

/// Whether a file is as it was written.
pub(crate) fn holds(bytes: &[u8]) -> bool {
    digits(bytes)
        .is_some_and(|digits| bytes[digits.clone()] == *checksum(bytes, &digits).as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_byte_that_differs_anywhere_is_seen() {
        let mut bytes = b"PAR1 rows rows ".to_vec();
        for (key, value) in metadata("0123", 3, 8, 60) {
            bytes.extend(format!("{key} {value} ").bytes());
        }
        bytes.extend(b"PAR1");
        seal(&mut bytes);
        assert!(holds(&bytes));
        for i in 0..bytes.len() {
            for bit in 0..8 {
                let mut damaged = bytes.clone();
                damaged[i] ^= 1 << bit;
                assert!(!holds(&damaged), "byte {i}, bit {bit}");
            }
        }
        for cut in 0..bytes.len() {
            assert!(!holds(&bytes[..cut]));
        }
    }
}
