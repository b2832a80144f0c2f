use thiserror::Error;

use super::{RecordFormat, Units};

/// What is wrong with a ground motion file or with the numbers of a record, where, and what to do.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
#[allow(missing_docs)] // messages say what the variants' fields are
pub enum RecordError {
    /// The file cannot be read.
    #[error("{file}: cannot be read ({reason}); check the path and its permissions")]
    Unreadable { file: String, reason: String },
    /// The path is a folder.
    #[error("{file}: is a folder; name one record file")]
    Folder { file: String },
    /// A folder without record files.
    #[error("{folder}: no record files in this folder; supported are {extensions}")]
    NoRecords { folder: String, extensions: String },
    /// The file is larger than any record.
    #[error(
        "{file}: larger than {limit_mb} MB; a record is text of a few MB at most: check that this \
         is the right file"
    )]
    TooLarge { file: String, limit_mb: u64 },
    /// The file is no text.
    #[error(
        "{file}: not a text file (byte {byte} is 0x{value:02x}); export the record as plain UTF-8 \
         text"
    )]
    Binary { file: String, byte: usize, value: u8 },
    /// There is no sample.
    #[error(
        "{file}: holds no samples; give an accelerogram: PEER AT2, GeoNet, COSMOS, CSMIP, K-NET, \
         ESM, or columns"
    )]
    Empty { file: String },
    /// A word stands where a number should.
    #[error(
        "{file}, line {line}: '{text}' is not a number; correct it, or start a comment line with #"
    )]
    NotANumber { file: String, line: usize, text: String },
    /// A number of the file is not finite.
    #[error("{file}, line {line}: '{text}' is not a finite number; repair or cut the record there")]
    NotFinite { file: String, line: usize, text: String },
    /// Numbers have decimal commas.
    #[error("{file}, line {line}: '{text}' has decimal commas; write decimal points instead")]
    DecimalComma { file: String, line: usize, text: String },
    /// A table of several columns, none of which was chosen.
    #[error(
        "{file}, line {line}: {found} columns; choose the acceleration with --column, a number or \
         a name ({columns}; in a case file column in [record]); bare values are read row by row \
         with --dt and --units"
    )]
    TooManyColumns { file: String, line: usize, found: usize, columns: String },
    /// A table in which no column, or more than one, is of the vertical motion.
    #[error(
        "{file}, line {line}: {found} columns, of which none or several are of a vertical motion \
         ({columns}); call it UP, UD, Z, V or vertical in the header"
    )]
    NoVerticalColumn { file: String, line: usize, found: usize, columns: String },
    /// The file is a case file.
    #[error(
        "{file}: this is a case file, not a ground motion; run it as `tune run {file}`, or name a \
         record here"
    )]
    IsCase { file: String },
    /// A line of a table has more or fewer columns than those before it.
    #[error(
        "{file}, line {line}: {} where the lines before have {expected}; the line is cut or \
         merged: repair it",
        columns(*.found)
    )]
    Ragged { file: String, line: usize, found: usize, expected: usize },
    /// Times are not evenly spaced.
    #[error(
        "{file}, line {line}: the time step is {step:?} s where {expected:?} s is expected; \
         resample evenly{}",
        match .given {
            None => ", or if the times are only printed coarsely pass --dt".to_owned(),
            Some(dt) => format!(": --dt {dt:?} does not make these times even"),
        }
    )]
    Uneven { file: String, line: usize, step: f64, expected: f64, given: Option<f64> },
    /// Times fall.
    #[error(
        "{file}, line {line}: the time falls from {before:?} to {time:?} s, as most of them do; \
         put times first and in order"
    )]
    TimesFall { file: String, line: usize, before: f64, time: f64 },
    /// An AT2 file without NPTS and DT.
    #[error(
        "{file}: no line with NPTS and DT near the top; an AT2 file says 'NPTS= 4000, DT= .01000 \
         SEC' on its fourth line"
    )]
    NoHeader { file: String },
    /// NPTS and DT of an AT2 file cannot be read.
    #[error(
        "{file}, line {line}: cannot read NPTS and DT from '{text}'; write 'NPTS= 4000, DT= .01000 \
         SEC'"
    )]
    BadHeader { file: String, line: usize, text: String },
    /// There are more or fewer samples than the header says.
    #[error(
        "{file}, line {line}: the file {} its header (line {header_line}) says NPTS {npts}; {}: \
         fetch it again or correct NPTS",
        held(*.found, *.npts).0,
        held(*.found, *.npts).1
    )]
    Count { file: String, line: usize, found: usize, header_line: usize, npts: u64 },
    /// The time step that was given is not that of the file.
    #[error(
        "{file}: the file's time step is {file_dt:?} s but --dt is {given:?} s; drop --dt or \
         correct one of them"
    )]
    StepDiffers { file: String, file_dt: f64, given: f64 },
    /// The unit that was given is not that of the file.
    #[error(
        "{file}: the file says its unit is {file_units} but --units is {given}; drop --units or \
         correct one of them"
    )]
    UnitsDiffer { file: String, file_units: Units, given: Units },
    /// Neither the file nor the user says the time step.
    #[error("{file}: the time step is not in the file; pass --dt SECONDS")]
    NoStep { file: String },
    /// Neither the file nor the user says the unit.
    #[error(
        "{file}: the unit of acceleration is not in the file; pass --units g, m/s2, \
         cm/s2, mm/s2, mg, %g, ft/s2, in/s2 or mGal"
    )]
    NoUnits { file: String },
    /// Times are in a unit that is not known.
    #[error("{file}, line {line}: times in '{unit}' are not known; give them in s or in ms")]
    TimeUnit { file: String, line: usize, unit: String },
    /// The numbers are velocities or displacements.
    #[error("{file}: the header speaks of {quantity}, not of acceleration; give the accelerogram")]
    NotAcceleration { file: String, quantity: &'static str },
    /// The file has no vertical component to take, or more than one.
    #[error("{file}: has {found}; name the file of one, or leave the vertical motion out")]
    NoVertical { file: String, found: &'static str },
    /// The vertical component has other times than the record.
    #[error(
        "{vertical}: the vertical component has {samples} samples of {dt:?} s, the record \
         {record_samples} of {record_dt:?} s; resample or cut it to the record's times"
    )]
    VerticalDiffers {
        vertical: String,
        samples: usize,
        dt: f64,
        record_samples: usize,
        record_dt: f64,
    },
    /// A time step that is not within 1e-6 to 1 s.
    #[error(
        "{record}: the time step is {dt:?} s; it must be between 1e-6 and 1 s: \
        times are taken in s"
    )]
    BadStep { record: String, dt: f64 },
    /// A sample in memory that is not finite.
    #[error(
        "{record}: sample {index} (counted from 0) is {value:?}; every sample must be a finite \
         number"
    )]
    BadSample { record: String, index: usize, value: f64 },
    /// The peak is above 50 g.
    #[error(
        "{record}: the peak is {shown:.4} g, above 50 g; the unit or the scale is probably wrong: \
         numbers in cm/s2 need --units cm/s2, in m/s2 --units m/s2",
        shown = .pga_g.min(1e9)
    )]
    HugePeak { record: String, pga_g: f64 },
    /// A line is not what the format has there.
    #[error(
        "{file}, line {line}: {wanted} should stand here, not {found}; the {format} file is cut or \
         damaged: fetch it again"
    )]
    Layout { file: String, line: usize, format: RecordFormat, wanted: &'static str, found: String },
    /// A block of values ends before its announced number.
    #[error(
        "{file}, line {line}: the {what} end after {found} values where line {header_line} \
         announces {said}; the file is cut or damaged: fetch it again"
    )]
    Short {
        file: String,
        line: usize,
        what: &'static str,
        found: usize,
        said: u64,
        header_line: usize,
    },
    /// An uncorrected CSMIP file.
    #[error(
        "{file}, line {line}: an uncorrected CSMIP file (.V1); fetch the corrected one (.V2) of \
         the same record"
    )]
    Uncorrected { file: String, line: usize },
    /// A line has more or fewer numbers than the format has.
    #[error(
        "{file}, line {line}: {found} numbers where {expected} are expected; the line is cut or \
         merged: fetch the file again"
    )]
    Fields { file: String, line: usize, found: usize, expected: usize },
    /// The samples have another peak than the header says.
    #[error(
        "{file}, line {line}: the header gives the peak {of} as {said}, the samples have {found}; \
         the file is damaged or was edited: fetch it again"
    )]
    Peak { file: String, line: usize, of: &'static str, said: String, found: String },
    /// The unit that the file names is no known acceleration.
    #[error(
        "{file}, line {line}: the unit '{unit}' is no acceleration that is known; give g, m/s2, \
         cm/s2 (gal), mm/s2, mg, %g, ft/s2, in/s2 or mGal"
    )]
    ForeignUnit { file: String, line: usize, unit: String },
    /// The component asked for is not there, or more than one is meant.
    #[error(
        "{file}: {} component {wanted}; it has {available}: pass another --component (name, \
         azimuth), of a table --column",
        if *.several { "there is more than one" } else { "there is no" }
    )]
    NoComponent { file: String, wanted: String, several: bool, available: String },
    /// The first column counts rows.
    #[error(
        "{file}, line {line}: the first column counts rows (step 1) and is no time; remove it and \
         pass --dt, or write the times"
    )]
    RowIndex { file: String, line: usize },
    /// The column of the values never changes its sign: a spectrum.
    #[error(
        "{file}: {column} never changes its sign, as a spectrum over its periods and \
         unlike an accelerogram; if it is one, name the columns 'time, acceleration' or pass \
         --baseline"
    )]
    OneSign { file: String, column: String },
    /// The numbers are counts of a digitiser without a scale.
    #[error(
        "{file}: the numbers are counts of a digitiser without a scale; convert them to \
         acceleration, or fetch the corrected file"
    )]
    Counts { file: String },
}

/// What a file holds that does not have the samples its header tells, and what that says of it.
fn held(found: usize, npts: u64) -> (String, &'static str) {
    if found as u64 > npts {
        (format!("holds {found} samples and"), "one of them is wrong")
    } else {
        (format!("ends after {found} samples but"), "the file is cut or damaged")
    }
}

fn columns(n: usize) -> String {
    format!("{n} {}", if n == 1 { "column" } else { "columns" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_with_more_samples_than_it_tells_is_not_called_cut() {
        let told = |found| {
            let (file, line, header_line) = ("a.AT2".to_string(), 9, 4);
            RecordError::Count { file, line, found, header_line, npts: 3995 }.to_string()
        };
        assert_eq!(
            told(3996),
            "a.AT2, line 9: the file holds 3996 samples and its header (line 4) says NPTS 3995; \
             one of them is wrong: fetch it again or correct NPTS"
        );
        assert!(told(3994).contains("the file ends after 3994 samples but its header (line 4)"));
        assert!(told(3994).contains("the file is cut or damaged"));
    }
}
