//! Parts: fixed ranges of cells, one Parquet file each, which proves what it is (`seal`).

use std::{
    io::ErrorKind,
    ops::Range,
    path::{Path, PathBuf},
    str::FromStr,
};

use bytes::Bytes;

use super::{
    SweepError, history, manifest, overturning, plan::Plan, row, seal, spec::SweepKind,
    springs::SpringsTable,
};
use files::{input, message::one_line};
use sweep_table::SweepTable;

/// Share I of N of a sweep, for machines that share the work: the parts I, I + N, I + 2 N ... from
/// 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    /// I.
    pub index: u64,
    /// N.
    pub of: u64,
}

impl Default for Share {
    fn default() -> Self {
        Self { index: 1, of: 1 }
    }
}

impl FromStr for Share {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text} is no share; give I/N with I from 1 to N, as 3/8");
        let (index, of) = text.split_once('/').ok_or_else(wrong)?;
        let (index, of) =
            (index.trim().parse().map_err(|_| wrong())?, of.trim().parse().map_err(|_| wrong())?);
        if index >= 1 && index <= of { Ok(Self { index, of }) } else { Err(wrong()) }
    }
}

impl Share {
    /// Its parts.
    pub fn parts(self, all: u64) -> impl Iterator<Item = u64> {
        (self.index - 1..all).step_by(self.of as usize)
    }
}

/// The parts of a sweep in its folder.
pub struct SweepParts<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// The folder.
    pub folder: &'a Path,
    /// Hash of the sweep's file.
    pub hash: &'a str,
    /// Those that are gathered, all unless said: a reader of [`SweepParts::each`] sees these or
    /// none.
    pub gathered: Option<Vec<u64>>,
}

/// What is not there of a sweep.
#[derive(Clone, Debug, Default)]
pub struct MissingParts {
    /// All that must be computed.
    pub parts: Vec<u64>,
    /// Those of them that have a file which is not theirs or was damaged, with the reason.
    pub unfit: Vec<(u64, String)>,
}

/// Bytes of a part that no sweep of ours reaches: a million rows have less.
const MOST_BYTES: u64 = 1 << 30;

impl<'a> SweepParts<'a> {
    /// All parts of a sweep.
    pub fn new(plan: &'a Plan, folder: &'a Path, hash: &'a str) -> Self {
        Self { plan, folder, hash, gathered: None }
    }

    /// File of part i.
    pub fn path(&self, part: u64) -> PathBuf {
        self.folder
            .join("parts")
            .join(format!("part-{part:05}-of-{:05}.parquet", self.plan.parts()))
    }

    /// Cells of part i.
    pub fn cells(&self, part: u64) -> Range<u64> {
        let from = part * self.plan.part;
        from..(from + self.plan.part).min(self.plan.cells())
    }

    /// Cells of the parts that are gathered.
    pub fn gathered_cells(&self) -> u64 {
        let of = |part: &u64| self.cells(*part).end - self.cells(*part).start;
        self.gathered.as_ref().map_or(self.plan.cells(), |parts| parts.iter().map(of).sum())
    }

    /// The file of part i, if it is there; it is as it was written, and that part of this sweep.
    /// Else what is wrong with it.
    fn load(&self, part: u64) -> Result<Option<Bytes>, String> {
        let bytes = match input::bytes(&self.path(part), MOST_BYTES) {
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(format!("cannot be read ({e})")),
            Ok(bytes) => Bytes::from(bytes.ok_or("is too large")?),
        };
        if !seal::holds(&bytes) {
            return Err("is damaged: its checksum does not fit".into());
        }
        let (metadata, rows) = SweepTable::metadata(bytes.clone()).ok_or("is no Parquet file")?;
        let is = |key: &str| metadata.get(key).map_or("", String::as_str);
        if is(seal::SWEEP) != self.hash {
            return Err(format!("is of another sweep ({})", one_line(is(seal::SWEEP))));
        }
        let (number, count) = (part.to_string(), self.plan.parts().to_string());
        if (is(seal::PART), is(seal::PARTS)) != (&number, &count) {
            return Err(format!(
                "is part {} of {}",
                one_line(is(seal::PART)),
                one_line(is(seal::PARTS))
            ));
        }
        let cells = self.cells(part);
        let cells = cells.end - cells.start;
        // a cell of an overturning spectrum has a row for every interval: none, one or more
        let fits = self.plan.kind == SweepKind::Overturning || rows == cells;
        if !fits || is(seal::ROWS) != rows.to_string() {
            return Err(format!(
                "has {rows} rows, its seal says {}, for {cells} cells",
                one_line(is(seal::ROWS))
            ));
        }
        Ok(Some(bytes))
    }

    /// Whether part i is there, whole and of this sweep.
    pub fn is_done(&self, part: u64) -> bool {
        matches!(self.load(part), Ok(Some(_)))
    }

    /// Which of these parts are not there, and why.
    pub fn missing(&self, parts: impl IntoIterator<Item = u64>) -> MissingParts {
        let mut missing = MissingParts::default();
        for part in parts {
            match self.load(part) {
                Ok(Some(_)) => continue,
                Ok(None) => {}
                Err(reason) => missing.unfit.push((part, reason)),
            }
            missing.parts.push(part);
        }
        missing
    }

    /// Compute part i and write it. `done` is told how many more cells are through.
    ///
    /// # Errors
    /// A record that cannot be read, a file that cannot be written.
    pub fn compute(
        &self,
        part: u64,
        springs: Option<&SpringsTable>,
        done: &(dyn Fn(u64) + Sync),
    ) -> Result<(), SweepError> {
        let table = self.rows(self.cells(part), springs, done)?;
        let path = self.path(part);
        let metadata = seal::metadata(self.hash, part, self.plan.parts(), table.rows());
        let mut bytes = table.parquet(&metadata).map_err(|e| SweepError::File {
            path: path.display().to_string(),
            source: std::io::Error::other(e.to_string()),
        })?;
        seal::seal(&mut bytes);
        manifest::whole(&path, &bytes)
    }

    /// The rows of a range of cells.
    ///
    /// # Errors
    /// A record that cannot be read.
    pub fn rows(
        &self,
        cells: Range<u64>,
        springs: Option<&SpringsTable>,
        done: &(dyn Fn(u64) + Sync),
    ) -> Result<SweepTable, SweepError> {
        let plan = self.plan;
        Ok(match plan.kind {
            SweepKind::Overturning => {
                overturning::table(plan, &overturning::rows(plan, springs, cells, done)?)
            }
            _ => row::table(plan, &history::rows(plan, springs, cells, done)?),
        })
    }

    /// Some columns of every part that is gathered, one part after another.
    ///
    /// # Errors
    /// A part that is not there or not as it was written, or what `take` says.
    pub fn each(
        &self,
        wanted: &SweepTable,
        mut take: impl FnMut(SweepTable) -> Result<(), SweepError>,
    ) -> Result<(), SweepError> {
        let all = || (0..self.plan.parts()).collect();
        for part in self.gathered.clone().unwrap_or_else(all) {
            let damaged = |reason: String| SweepError::Damaged {
                path: self.path(part).display().to_string(),
                reason,
            };
            let bytes =
                self.load(part).map_err(damaged)?.ok_or_else(|| damaged("is not there".into()))?;
            take(SweepTable::read_parquet(bytes, wanted).map_err(|e| damaged(e.to_string()))?)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_cover_all_parts_once() {
        let mut all: Vec<u64> =
            (1..=3).flat_map(|index| Share { index, of: 3 }.parts(10)).collect();
        all.sort_unstable();
        assert_eq!(all, (0..10).collect::<Vec<_>>());
        assert_eq!(Share { index: 8, of: 8 }.parts(5).count(), 0);
    }

    #[test]
    fn a_share_is_written_as_a_fraction() {
        assert_eq!("3/8".parse(), Ok(Share { index: 3, of: 8 }));
        for text in ["0/8", "9/8", "3", "a/b", "1/0", "-1/2"] {
            assert!(text.parse::<Share>().unwrap_err().contains("is no share"), "{text}");
        }
    }
}
