//! A table, once: for the terminal, Markdown, HTML (`html`) and CSV.

use serde::Serialize;

/// Names of columns, and rows of as many cells, as they are to be read.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Table {
    /// One name a column.
    pub head: Vec<String>,
    /// One cell a column.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// Without rows.
    pub fn new<S: Into<String>>(head: impl IntoIterator<Item = S>) -> Self {
        Self { head: head.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// With these rows.
    #[must_use]
    pub fn with(mut self, rows: impl IntoIterator<Item = Vec<String>>) -> Self {
        self.rows.extend(rows);
        self
    }

    /// For Markdown.
    pub fn markdown(&self) -> String {
        let mut out =
            format!("| {} |\n|{}\n", self.head.join(" | "), "---|".repeat(self.head.len()));
        for row in &self.rows {
            out.push_str(&format!("| {} |\n", row.join(" | ")));
        }
        out
    }

    /// For a terminal: columns stand under each other, two blanks apart; a line a row, the head
    /// first.
    pub(crate) fn lines(&self) -> Vec<String> {
        let all = || std::iter::once(&self.head).chain(&self.rows);
        let width = |k: usize| {
            all().filter_map(|row| row.get(k)).map(|cell| cell.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..self.head.len()).map(width).collect();
        let line = |row: &Vec<String>| {
            let cells = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:<width$}"));
            cells.collect::<Vec<_>>().join("  ").trim_end().to_string()
        };
        all().map(line).collect()
    }

    /// For a file: cells with a comma or a quote are quoted.
    pub fn csv(&self) -> String {
        let cell = |text: &String| match text.contains([',', '"', '\n']) {
            true => format!("\"{}\"", text.replace('"', "\"\"")),
            false => text.clone(),
        };
        let line = |row: &Vec<String>| row.iter().map(cell).collect::<Vec<_>>().join(",") + "\n";
        std::iter::once(&self.head).chain(&self.rows).map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_table_reads_well_everywhere() {
        let table = Table::new(["force", "value"]).with([vec!["shear".into(), "1,5 kN".into()]]);
        assert_eq!(table.markdown(), "| force | value |\n|---|---|\n| shear | 1,5 kN |\n");
        assert_eq!(table.lines(), ["force  value", "shear  1,5 kN"]);
        assert_eq!(table.csv(), "force,value\nshear,\"1,5 kN\"\n");
    }
}
