//! Rows of results as columns, written as Parquet and read back, or written as CSV.
//!
//! Parquet: one row group a file, Snappy, no statistics of strings; a missing number is a null. The
//! same table gives the same bytes.

#![warn(missing_docs)]

use std::{collections::BTreeMap, fmt::Write as _, sync::Arc};

use bytes::Bytes;

use parquet::{
    basic::{Compression, Encoding},
    column::{reader::ColumnReader, writer::ColumnWriter},
    data_type::ByteArray,
    errors::ParquetError,
    file::{
        metadata::KeyValue,
        properties::WriterProperties,
        reader::{FileReader, SerializedFileReader},
        writer::SerializedFileWriter,
    },
    schema::parser::parse_message_type,
};

/// Values of one column, one a row.
#[derive(Clone, Debug, PartialEq)]
pub enum Column {
    /// Whole numbers.
    Count(Vec<i64>),
    /// None: there is no such number.
    Real(Vec<Option<f64>>),
    /// Yes, no or nothing.
    Flag(Vec<Option<bool>>),
    /// Words.
    Text(Vec<Arc<str>>),
}

/// Columns of one length, each with its name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SweepTable {
    /// The columns.
    pub columns: Vec<(&'static str, Column)>,
}

impl Column {
    fn len(&self) -> usize {
        match self {
            Self::Count(values) => values.len(),
            Self::Real(values) => values.len(),
            Self::Flag(values) => values.len(),
            Self::Text(values) => values.len(),
        }
    }

    /// Add another's values; nothing if it is of another type.
    fn append(&mut self, more: Self) {
        match (self, more) {
            (Self::Count(all), Self::Count(more)) => all.extend(more),
            (Self::Real(all), Self::Real(more)) => all.extend(more),
            (Self::Flag(all), Self::Flag(more)) => all.extend(more),
            (Self::Text(all), Self::Text(more)) => all.extend(more),
            _ => {}
        }
    }

    fn schema(&self, name: &str) -> String {
        match self {
            Self::Count(_) => format!("required int64 {name};"),
            Self::Real(_) => format!("optional double {name};"),
            Self::Flag(_) => format!("optional boolean {name};"),
            Self::Text(_) => format!("required byte_array {name} (UTF8);"),
        }
    }

    fn write(&self, writer: &mut ColumnWriter) -> Result<(), ParquetError> {
        fn levels<T>(values: &[Option<T>]) -> Vec<i16> {
            values.iter().map(|value| i16::from(value.is_some())).collect()
        }
        match (self, writer) {
            (Self::Count(values), ColumnWriter::Int64ColumnWriter(writer)) => {
                writer.write_batch(values, None, None)?;
            }
            (Self::Real(values), ColumnWriter::DoubleColumnWriter(writer)) => {
                let present: Vec<f64> = values.iter().flatten().copied().collect();
                writer.write_batch(&present, Some(&levels(values)), None)?;
            }
            (Self::Flag(values), ColumnWriter::BoolColumnWriter(writer)) => {
                let present: Vec<bool> = values.iter().flatten().copied().collect();
                writer.write_batch(&present, Some(&levels(values)), None)?;
            }
            (Self::Text(values), ColumnWriter::ByteArrayColumnWriter(writer)) => {
                let bytes: Vec<ByteArray> =
                    values.iter().map(|text| ByteArray::from(text.as_bytes().to_vec())).collect();
                writer.write_batch(&bytes, None, None)?;
            }
            _ => return Err(ParquetError::General("a column of another type".into())),
        }
        Ok(())
    }

    fn cell(&self, row: usize) -> String {
        match self {
            Self::Count(values) => values[row].to_string(),
            Self::Real(values) => values[row].map_or(String::new(), |x| x.to_string()),
            Self::Flag(values) => values[row].map_or(String::new(), |x| x.to_string()),
            Self::Text(values) if values[row].contains([',', '"', '\n']) => {
                format!("\"{}\"", values[row].replace('"', "\"\""))
            }
            Self::Text(values) => values[row].to_string(),
        }
    }
}

/// A table in the making: one column after another, of the same rows.
#[derive(Debug)]
pub struct TableOf<'a, R> {
    rows: &'a [R],
    table: SweepTable,
}

impl<'a, R> TableOf<'a, R> {
    /// Of these rows, without columns.
    pub fn new(rows: &'a [R]) -> Self {
        Self { rows, table: SweepTable::default() }
    }

    fn with(mut self, name: &'static str, column: Column) -> Self {
        self.table.columns.push((name, column));
        self
    }

    /// With whole numbers.
    pub fn count(self, name: &'static str, of: impl Fn(&R) -> u64) -> Self {
        let column = Column::Count(self.rows.iter().map(|row| of(row) as i64).collect());
        self.with(name, column)
    }

    /// With numbers.
    pub fn real(self, name: &'static str, of: impl Fn(&R) -> Option<f64>) -> Self {
        let column = Column::Real(self.rows.iter().map(of).collect());
        self.with(name, column)
    }

    /// With yes, no or nothing.
    pub fn flag(self, name: &'static str, of: impl Fn(&R) -> Option<bool>) -> Self {
        let column = Column::Flag(self.rows.iter().map(of).collect());
        self.with(name, column)
    }

    /// With words.
    pub fn text<T: Into<Arc<str>>>(self, name: &'static str, of: impl Fn(&R) -> T) -> Self {
        let column = Column::Text(self.rows.iter().map(|row| of(row).into()).collect());
        self.with(name, column)
    }

    /// The whole.
    pub fn table(self) -> SweepTable {
        self.table
    }
}

impl SweepTable {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |(_, column)| column.len())
    }

    /// Add the rows of a table with the same columns.
    pub fn append(&mut self, more: Self) {
        for ((_, all), (_, more)) in self.columns.iter_mut().zip(more.columns) {
            all.append(more);
        }
    }

    /// A column of numbers.
    pub fn reals(&self, name: &str) -> &[Option<f64>] {
        match self.columns.iter().find(|(other, _)| *other == name) {
            Some((_, Column::Real(values))) => values,
            _ => &[],
        }
    }

    /// A column of counts.
    pub fn counts(&self, name: &str) -> &[i64] {
        match self.columns.iter().find(|(other, _)| *other == name) {
            Some((_, Column::Count(values))) => values,
            _ => &[],
        }
    }

    /// A column of yes and no.
    pub fn flags(&self, name: &str) -> &[Option<bool>] {
        match self.columns.iter().find(|(other, _)| *other == name) {
            Some((_, Column::Flag(values))) => values,
            _ => &[],
        }
    }

    /// A column of words.
    pub fn texts(&self, name: &str) -> &[Arc<str>] {
        match self.columns.iter().find(|(other, _)| *other == name) {
            Some((_, Column::Text(values))) => values,
            _ => &[],
        }
    }

    /// The Parquet file, with some metadata.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn parquet(&self, metadata: &[(&'static str, String)]) -> Result<Vec<u8>, ParquetError> {
        let metadata =
            metadata.iter().map(|(key, value)| KeyValue::new((*key).to_string(), value.clone()));
        let fields: String =
            self.columns.iter().map(|(name, column)| column.schema(name)).collect();
        let schema = Arc::new(parse_message_type(&format!("message row {{ {fields} }}"))?);
        let mut properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_created_by(concat!("groundspring ", env!("CARGO_PKG_VERSION")).into())
            .set_key_value_metadata(Some(metadata.collect()));
        for (name, column) in &self.columns {
            if !matches!(column, Column::Text(_)) {
                properties = properties
                    .set_column_dictionary_enabled((*name).into(), false)
                    .set_column_encoding((*name).into(), Encoding::PLAIN);
            }
        }
        let mut writer =
            SerializedFileWriter::new(Vec::new(), schema, Arc::new(properties.build()))?;
        let mut group = writer.next_row_group()?;
        let mut columns = self.columns.iter();
        while let Some(mut writer) = group.next_column()? {
            if let Some((_, column)) = columns.next() {
                column.write(writer.untyped())?;
            }
            writer.close()?;
        }
        group.close()?;
        writer.into_inner()
    }

    /// The metadata of a Parquet file, and how many rows it has.
    pub fn metadata(bytes: Bytes) -> Option<(BTreeMap<String, String>, u64)> {
        let reader = SerializedFileReader::new(bytes).ok()?;
        let file = reader.metadata().file_metadata();
        let pairs = file.key_value_metadata()?.iter();
        let pairs = pairs.filter_map(|pair| Some((pair.key.clone(), pair.value.clone()?)));
        Some((pairs.collect(), u64::try_from(file.num_rows()).ok()?))
    }

    /// Some columns of a Parquet file, in the order asked for; a table without rows tells their
    /// types.
    ///
    /// # Errors
    /// The file is none, or does not have them.
    pub fn read_parquet(bytes: Bytes, wanted: &Self) -> Result<Self, ParquetError> {
        read(bytes, wanted)
    }

    /// The head of the CSV file.
    pub fn csv_head(&self) -> String {
        let names: Vec<&str> = self.columns.iter().map(|(name, _)| *name).collect();
        names.join(",") + "\n"
    }

    /// The rows of the CSV file.
    pub fn csv_rows(&self) -> String {
        let mut out = String::new();
        for row in 0..self.rows() {
            let cells: Vec<String> =
                self.columns.iter().map(|(_, column)| column.cell(row)).collect();
            // writing to a String cannot fail
            let _ = writeln!(out, "{}", cells.join(","));
        }
        out
    }
}

fn read(file: Bytes, wanted: &SweepTable) -> Result<SweepTable, ParquetError> {
    fn placed<T>(levels: &[i16], values: Vec<T>) -> Vec<Option<T>> {
        let mut values = values.into_iter();
        levels.iter().map(|level| if *level == 0 { None } else { values.next() }).collect()
    }
    let reader = SerializedFileReader::new(file)?;
    let mut table = wanted.clone();
    for group in 0..reader.num_row_groups() {
        let group = reader.get_row_group(group)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        for (name, column) in &mut table.columns {
            let there =
                group.metadata().columns().iter().position(|c| c.column_path().string() == *name);
            let index = there.ok_or_else(|| ParquetError::General(format!("no column {name}")))?;
            let mut levels = Vec::new();
            match (group.get_column_reader(index)?, column) {
                (ColumnReader::Int64ColumnReader(mut reader), Column::Count(all)) => {
                    reader.read_records(rows, None, None, all)?;
                }
                (ColumnReader::DoubleColumnReader(mut reader), Column::Real(all)) => {
                    let mut values = Vec::new();
                    reader.read_records(rows, Some(&mut levels), None, &mut values)?;
                    all.extend(placed(&levels, values));
                }
                (ColumnReader::BoolColumnReader(mut reader), Column::Flag(all)) => {
                    let mut values = Vec::new();
                    reader.read_records(rows, Some(&mut levels), None, &mut values)?;
                    all.extend(placed(&levels, values));
                }
                (ColumnReader::ByteArrayColumnReader(mut reader), Column::Text(all)) => {
                    let mut values = Vec::new();
                    reader.read_records(rows, None, None, &mut values)?;
                    for value in values {
                        all.push(value.as_utf8()?.into());
                    }
                }
                _ => return Err(ParquetError::General(format!("column {name} has another type"))),
            }
        }
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> SweepTable {
        let text =
            |words: &[&str]| Column::Text(words.iter().map(|word| Arc::from(*word)).collect());
        SweepTable {
            columns: vec![
                ("cell", Column::Count(vec![7, 8, 9])),
                ("peak", Column::Real(vec![Some(0.1), None, Some(-1.0 / 3.0)])),
                ("over", Column::Flag(vec![None, Some(true), Some(false)])),
                ("record", text(&["a", "b, \"c\"", "a"])),
            ],
        }
    }

    fn empty() -> SweepTable {
        let real = |name| (name, Column::Real(Vec::new()));
        SweepTable {
            columns: vec![
                ("record", Column::Text(Vec::new())),
                real("peak"),
                ("over", Column::Flag(Vec::new())),
                ("cell", Column::Count(Vec::new())),
            ],
        }
    }

    fn parquet() -> Vec<u8> {
        table().parquet(&[("sweep", "0123".into())]).unwrap()
    }

    #[test]
    fn what_was_written_is_read_back_to_the_last_bit_and_the_same_table_gives_the_same_bytes() {
        let bytes = Bytes::from(parquet());
        let back = SweepTable::read_parquet(bytes.clone(), &empty()).unwrap();
        for (name, column) in table().columns {
            assert_eq!(back.columns.iter().find(|(other, _)| *other == name).unwrap().1, column);
        }
        let (metadata, rows) = SweepTable::metadata(bytes.clone()).unwrap();
        assert_eq!((metadata["sweep"].as_str(), rows), ("0123", 3));
        assert_eq!(bytes, parquet());
    }

    #[test]
    fn a_cut_file_is_no_table() {
        let bytes = Bytes::from(parquet());
        for cut in [0, 5, bytes.len() / 2, bytes.len() - 1] {
            assert!(SweepTable::metadata(bytes.slice(..cut)).is_none());
            assert!(SweepTable::read_parquet(bytes.slice(..cut), &empty()).is_err());
        }
    }

    #[test]
    fn csv_quotes_what_must_be() {
        let table = table();
        assert_eq!(table.csv_head(), "cell,peak,over,record\n");
        assert_eq!(
            table.csv_rows(),
            "7,0.1,,a\n8,,true,\"b, \"\"c\"\"\"\n9,-0.3333333333333333,false,a\n"
        );
    }
}
