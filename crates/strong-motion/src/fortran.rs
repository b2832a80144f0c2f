//! Numbers in fixed formats, as Fortran programs write them: `(8F10.5)` is eight fields of ten
//! characters to a line.

use super::text::{number, precision, quote, raw_lines};
use super::{RecordError, RecordFormat};

/// How numbers stand in lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct FortranFormat {
    pub per_line: usize,
    pub width: usize,
}

impl FortranFormat {
    /// From a line that ends in a format: `(8F10.5)`, `(10I8)`, `(1P5E14.6)`, `(E15.6)`.
    pub(super) fn parse(line: &str) -> Option<Self> {
        let inside = line[line.rfind('(')? + 1..].to_ascii_uppercase();
        let inside = inside.trim_start_matches("1P").trim_start_matches(',').trim();
        let letter = inside.find(['F', 'E', 'G', 'D', 'I'])?;
        let per_line = if letter == 0 { 1 } else { inside[..letter].trim().parse().ok()? };
        let width = &inside[letter + 1..];
        let width: usize = width[..width.find(|c: char| !c.is_ascii_digit())?].parse().ok()?;
        ((1..=1000).contains(&per_line) && (1..=100).contains(&width))
            .then_some(Self { per_line, width })
    }

    /// The fields of a line that should hold `expected`: between blanks if that many numbers come
    /// out, else by columns.
    fn fields(self, line: &str, expected: usize) -> Vec<&str> {
        let apart: Vec<&str> = line.split_whitespace().collect();
        if apart.len() == expected && apart.iter().all(|field| number(field).is_some()) {
            return apart;
        }
        let columns: Option<Vec<&str>> = (0..line.len().div_ceil(self.width))
            .map(|i| {
                line.get(i * self.width..((i + 1) * self.width).min(line.len())).map(str::trim)
            })
            .collect();
        columns
            .filter(|fields| {
                fields.len() == expected && fields.iter().all(|field| number(field).is_some())
            })
            .unwrap_or(apart)
    }
}

/// A file line by line, from the top.
pub(super) struct Cursor<'a> {
    pub file: &'a str,
    format: RecordFormat,
    lines: Vec<&'a str>,
    at: usize,
}

/// What a header promises of a block of numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Promise {
    /// The numbers, as in "acceleration samples".
    pub what: &'static str,
    pub count: u64,
    pub layout: FortranFormat,
    /// The line that says so.
    pub line: usize,
}

/// A block of numbers, each with its printed form.
pub(super) struct Block<'a> {
    pub values: Vec<f64>,
    pub printed: Vec<&'a str>,
}

impl Block<'_> {
    /// Half of the last printed digit of a value.
    pub(super) fn half_digit(&self, i: usize) -> f64 {
        self.printed.get(i).map_or(0.0, |printed| half_digit(printed))
    }
}

/// Half of the last printed digit of a number.
pub(super) fn half_digit(printed: &str) -> f64 {
    0.5 * 10_f64.powi(precision(printed).0)
}

impl<'a> Cursor<'a> {
    pub(super) fn new(file: &'a str, format: RecordFormat, text: &'a str) -> Self {
        Self { file, format, lines: raw_lines(text).collect(), at: 0 }
    }

    /// The number of the next line, counted from 1.
    pub(super) fn number(&self) -> usize {
        self.at + 1
    }

    pub(super) fn peek(&self) -> Option<&'a str> {
        self.lines.get(self.at).copied()
    }

    pub(super) fn advance(&mut self) {
        self.at += 1;
    }

    /// Go on to the next line that is not blank; whether there is one.
    pub(super) fn skip_blank(&mut self) -> bool {
        while self.peek().is_some_and(|line| line.trim().is_empty()) {
            self.at += 1;
        }
        self.peek().is_some()
    }

    /// The next line, which should be `wanted`.
    pub(super) fn line(&mut self, wanted: &'static str) -> Result<&'a str, RecordError> {
        let line = self.peek().ok_or_else(|| self.not(self.number(), wanted))?;
        self.at += 1;
        Ok(line)
    }

    /// The next lines, all of which should be `wanted`.
    pub(super) fn take(
        &mut self,
        count: usize,
        wanted: &'static str,
    ) -> Result<Vec<&'a str>, RecordError> {
        let from = self.at;
        let to = from.saturating_add(count);
        if to > self.lines.len() {
            return Err(self.not(self.lines.len(), wanted));
        }
        self.at = to;
        Ok(self.lines[from..to].to_vec())
    }

    /// Something else stands on a line (from 1) where `wanted` should be.
    pub(super) fn not(&self, line: usize, wanted: &'static str) -> RecordError {
        let found = self.lines.get(line.saturating_sub(1)).map_or("", |line| line.trim());
        let found = if found.is_empty() {
            "an empty line or the end".to_owned()
        } else {
            format!("'{}'", quote(found))
        };
        RecordError::Layout { file: self.file.to_owned(), line, format: self.format, wanted, found }
    }

    /// Header values in lines of their own, as printed.
    pub(super) fn header(&mut self, promise: Promise) -> Result<Vec<&'a str>, RecordError> {
        let mut printed = Vec::new();
        while (printed.len() as u64) < promise.count {
            let (line, text, expected) = self.next_row(promise, printed.len())?;
            let fields = promise.layout.fields(text, expected);
            self.right_number(line, fields.len(), expected)?;
            printed.extend(fields);
        }
        Ok(printed)
    }

    /// The numbers that the header promised.
    pub(super) fn block(&mut self, promise: Promise) -> Result<Block<'a>, RecordError> {
        let mut block = Block { values: Vec::new(), printed: Vec::new() };
        while (block.values.len() as u64) < promise.count {
            let (line, text, expected) = self.next_row(promise, block.values.len())?;
            let fields = promise.layout.fields(text, expected);
            for field in &fields {
                let (file, text) = (self.file.to_owned(), || quote(field));
                match number(field) {
                    Some(value) if value.is_finite() => block.values.push(value),
                    Some(_) => return Err(RecordError::NotFinite { file, line, text: text() }),
                    None => return Err(RecordError::NotANumber { file, line, text: text() }),
                }
            }
            self.right_number(line, fields.len(), expected)?;
            block.printed.extend(fields);
        }
        Ok(block)
    }

    /// The next line of a block, its number and how many numbers it should hold.
    fn next_row(
        &mut self,
        promise: Promise,
        found: usize,
    ) -> Result<(usize, &'a str, usize), RecordError> {
        let line = self.number();
        let text = self.peek().unwrap_or("");
        // a block is over where a word or nothing stands; NaN is a number gone wrong
        let word =
            text.trim_start().starts_with(|c: char| c.is_ascii_alphabetic() || "/|".contains(c));
        let first_number = text.split_whitespace().next().and_then(number);
        if text.trim().is_empty() || word && first_number.is_none() {
            let (file, line) = (self.file.to_owned(), line.min(self.lines.len()));
            let Promise { what, count: said, line: header_line, .. } = promise;
            return Err(RecordError::Short { file, line, what, found, said, header_line });
        }
        self.at += 1;
        let left = promise.count - found as u64;
        Ok((line, text, left.min(promise.layout.per_line as u64) as usize))
    }

    fn right_number(&self, line: usize, found: usize, expected: usize) -> Result<(), RecordError> {
        if found == expected {
            return Ok(());
        }
        Err(RecordError::Fields { file: self.file.to_owned(), line, found, expected })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_read_from_the_lines_that_announce_them() {
        let layout = |per_line, width| Some(FortranFormat { per_line, width });
        for (line, expected) in [
            (
                " 15050 points of accel data equally spaced at  .020 sec, in cm/sec2. (8f10.6)",
                layout(8, 10),
            ),
            (
                "   42000 acceleration pts, approx  210 secs, units=cm/sec2(04),Format=(1E15.6)",
                layout(1, 15),
            ),
            (" 100 Integer-header values follow on  10 lines, Format= (10I8)", layout(10, 8)),
            ("Format=(1P5E14.6)", layout(5, 14)),
            ("(E15.6)", layout(1, 15)),
            ("no format", None),
            ("(8A10)", None),
            ("(0F10.3)", None),
            ("(8F)", None),
        ] {
            assert_eq!(FortranFormat::parse(line), expected, "{line}");
        }
    }

    #[test]
    fn touching_fields_are_cut_by_columns_and_loose_ones_by_blanks() {
        let layout = FortranFormat { per_line: 3, width: 8 };
        assert_eq!(
            layout.fields(" -5505.9-11026.4 -6529.3", 3),
            ["-5505.9", "-11026.4", "-6529.3"]
        );
        assert_eq!(layout.fields("1 2\t3", 3), ["1", "2", "3"]);
        assert_eq!(
            layout.fields("12345678123456781234.678", 3),
            ["12345678", "12345678", "1234.678"]
        );
        // neither: what blanks part is reported
        assert_eq!(layout.fields("1 2", 3), ["1", "2"]);
    }

    #[test]
    fn a_block_ends_with_its_last_number_or_an_error_that_says_where() {
        let promise = Promise {
            what: "acceleration samples",
            count: 5,
            layout: FortranFormat { per_line: 3, width: 4 },
            line: 1,
        };
        let block = |text: &str| {
            let mut cursor = Cursor::new("x", RecordFormat::GeoNet, text);
            cursor.block(promise).map(|block| (block.values, cursor.number()))
        };
        assert_eq!(block("  1.  2.  3.\n  4.  5.\nEND"), Ok((vec![1.0, 2.0, 3.0, 4.0, 5.0], 3)));
        for (text, words) in [
            (
                "  1.  2.  3.\n",
                "line 2: the acceleration samples end after 3 values where line 1 announces 5",
            ),
            ("  1.  2.  3.\nEND", "line 2: the acceleration samples end after 3"),
            ("  1.  2.  3.\n  4.", "line 2: 1 numbers where 2"),
            ("  1.  2.  3.  4.\n", "line 1: 4 numbers where 3"),
            ("  1.  x.  3.\n", "line 1: 'x.' is not a number"),
            ("  1. NaN  3.\n", "line 1: 'NaN' is not a finite"),
        ] {
            let message = block(text).unwrap_err().to_string();
            assert!(message.contains(words), "{text:?}: {message}");
        }
    }
}
