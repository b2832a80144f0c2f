//! Parts: fixed ranges of cells, one Parquet file each.

use std::{
    ops::Range,
    path::{Path, PathBuf},
    str::FromStr,
};

use super::{
    SweepError, history, manifest, overturning, plan::Plan, row, spec::SweepKind, springs::SpringsTable, table::Table,
};

/// Share I of N of a sweep, for machines that share the work: the parts I, I + N, I + 2 N ... from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Share {
    pub index: u64,
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
        let (index, of) = (index.trim().parse().map_err(|_| wrong())?, of.trim().parse().map_err(|_| wrong())?);
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
    pub plan: &'a Plan,
    pub folder: &'a Path,
    pub hash: &'a str,
}

impl SweepParts<'_> {
    /// File of part i.
    pub fn path(&self, part: u64) -> PathBuf {
        self.folder.join("parts").join(format!("part-{part:05}.parquet"))
    }

    /// Cells of part i.
    pub fn cells(&self, part: u64) -> Range<u64> {
        let from = part * self.plan.part;
        from..(from + self.plan.part).min(self.plan.cells())
    }

    /// Whether part i is there and of this sweep.
    pub fn is_done(&self, part: u64) -> bool {
        Table::peek(&self.path(part)).is_some_and(|(hash, _)| hash == self.hash)
    }

    /// Those that are not there.
    pub fn missing(&self) -> Vec<u64> {
        (0..self.plan.parts()).filter(|part| !self.is_done(*part)).collect()
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
        let cells = self.cells(part);
        let table = if self.plan.kind == SweepKind::Overturning {
            overturning::table(self.plan, &overturning::rows(self.plan, springs, cells, done)?)
        } else {
            row::table(self.plan, &history::rows(self.plan, springs, cells, done)?)
        };
        let path = self.path(part);
        let mut bytes = Vec::new();
        table.write_parquet(&mut bytes, self.hash).map_err(|e| SweepError::File {
            path: path.display().to_string(),
            source: std::io::Error::other(e.to_string()),
        })?;
        manifest::whole(&path, &bytes)
    }

    /// Some columns of every part, one part after another.
    ///
    /// # Errors
    /// A file that cannot be read, or what `take` says.
    pub fn each(
        &self,
        wanted: &Table,
        mut take: impl FnMut(Table) -> Result<(), SweepError>,
    ) -> Result<(), SweepError> {
        for part in 0..self.plan.parts() {
            if self.is_done(part) {
                take(Table::read_parquet(&self.path(part), wanted)?)?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_cover_all_parts_once() {
        let mut all: Vec<u64> = (1..=3).flat_map(|index| Share { index, of: 3 }.parts(10)).collect();
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
