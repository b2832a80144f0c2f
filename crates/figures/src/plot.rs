//! The numbers of a panel over time, for a page that zooms and tells values: what the SVG of the
//! panel shows, at full resolution.

use serde::Serialize;

use super::style::Pen;

/// Times that a panel keeps at most; of more, the extremes of every curve in as many stretches of
/// time.
const MOST: usize = 5000;

/// A curve: as many values as the panel has times, or fewer where it ends early, or one that holds
/// at all times.
#[derive(Clone, Debug, Serialize)]
pub struct Curve {
    pub name: String,
    pub colour: String,
    pub width: f64,
    pub dashed: bool,
    /// 32-bit numbers, little end first, in base 64.
    pub values: String,
}

/// One model's marks on the time axis, in a row of their own.
#[derive(Clone, Debug, Serialize)]
pub struct Marks {
    pub colour: String,
    /// Their times (s), as `Curve::values`.
    pub times: String,
}

impl Marks {
    /// Marks at these times.
    pub(crate) fn new(times: &[f64], pen: Pen) -> Self {
        Self {
            colour: pen.hex(),
            times: base64(&times.iter().map(|&t| t as f32).collect::<Vec<f32>>()),
        }
    }
}

/// A time at which something ends.
#[derive(Clone, Copy, Debug)]
pub struct EventMark<'a> {
    /// (s)
    pub time: f64,
    /// As "Housner's body overturns at t = 4.44 s".
    pub text: &'a str,
}

/// A panel: where it stands in the picture, its axes, its curves.
#[derive(Clone, Debug, Serialize)]
pub struct Plot {
    /// Left, top, right, bottom [pixel of the picture].
    pub frame: [f64; 4],
    pub x: [f64; 2],
    pub y: [f64; 2],
    pub logarithmic: bool,
    /// Of the vertical axis, with its unit in brackets.
    pub label: String,
    /// Times of the values (s), as `Curve::values`.
    pub t: String,
    pub curves: Vec<Curve>,
    /// Rows from the axis upwards.
    pub marks: Vec<Marks>,
    pub events: Vec<(f64, String)>,
}

impl Plot {
    /// Curves against the times t, without axes yet.
    pub(crate) fn new(label: &str, t: &[f64], curves: &[(&str, &[f64], Pen)]) -> Self {
        let kept = extremes(t.len(), curves);
        let pick = |values: &[f64]| -> String {
            match values {
                [constant] => base64(&[*constant as f32]),
                _ => base64(
                    &kept
                        .iter()
                        .filter_map(|&i| values.get(i))
                        .map(|&x| x as f32)
                        .collect::<Vec<f32>>(),
                ),
            }
        };
        Self {
            frame: [0.0; 4],
            x: [0.0; 2],
            y: [0.0; 2],
            logarithmic: false,
            label: label.into(),
            t: pick(t),
            curves: curves
                .iter()
                .map(|(name, values, pen)| Curve {
                    name: (*name).into(),
                    colour: pen.hex(),
                    width: pen.width,
                    dashed: pen.dash.is_some(),
                    values: pick(values),
                })
                .collect(),
            marks: Vec::new(),
            events: Vec::new(),
        }
    }
}

/// Which samples are kept: all of a short history; of a long one the least and the largest of every
/// curve in each stretch.
fn extremes(n: usize, curves: &[(&str, &[f64], Pen)]) -> Vec<usize> {
    if n <= MOST {
        return (0..n).collect();
    }
    let stretches = MOST / (2 * curves.len().max(1));
    let mut kept = vec![0, n - 1];
    for k in 0..stretches {
        let (from, to) = (k * n / stretches, (k + 1) * n / stretches);
        for (_, values, _) in curves {
            let part = from.min(values.len())..to.min(values.len());
            kept.extend(part.clone().min_by(|&a, &b| values[a].total_cmp(&values[b])));
            kept.extend(part.max_by(|&a, &b| values[a].total_cmp(&values[b])));
        }
    }
    kept.sort_unstable();
    kept.dedup();
    kept
}

/// The numbers' bytes, little end first, in base 64 (RFC 4648).
fn base64(values: &[f32]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let bits = group.iter().fold(0_u32, |bits, &byte| bits << 8 | u32::from(byte))
            << (8 * (3 - group.len()));
        for k in 0..4 {
            let digit = DIGITS[(bits >> (18 - 6 * k) & 63) as usize];
            out.push(if k <= group.len() { char::from(digit) } else { '=' });
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::style::{BLACK, Pen};
    use super::*;

    #[test]
    fn base_64_is_that_of_the_standard() {
        // 1.0 is 00 00 80 3f, -2.5 is 00 00 20 c0
        assert_eq!(base64(&[1.0]), "AACAPw==");
        assert_eq!(base64(&[1.0, -2.5]), "AACAPwAAIMA=");
        assert_eq!(base64(&[]), "");
    }

    #[test]
    fn a_long_history_keeps_its_ends_and_its_extremes() {
        let mut u: Vec<f64> = (0..100_000).map(|i| (f64::from(i) * 0.01).sin()).collect();
        u[33_333] = 7.0;
        let short = &u[..50_000];
        let kept = extremes(
            u.len(),
            &[("u", &u, Pen::new(BLACK, 1.0)), ("v", short, Pen::new(BLACK, 1.0))],
        );
        assert!(
            kept.len() <= MOST + 2
                && kept[0] == 0
                && kept[kept.len() - 1] == 99_999
                && kept.contains(&33_333)
        );
        assert!(kept.windows(2).all(|pair| pair[0] < pair[1]));
        assert_eq!(extremes(10, &[]), (0..10).collect::<Vec<_>>());
    }
}
