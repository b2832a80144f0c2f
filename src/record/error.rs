use thiserror::Error;

use super::Units;

/// What is wrong with a ground motion file or with the numbers of a record, where, and what to do.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RecordError {
    #[error("{file}: cannot be read ({reason}); check the path and its permissions")]
    Unreadable { file: String, reason: String },
    #[error("{file}: is a folder; name one record file")]
    Folder { file: String },
    #[error("{folder}: no record files in this folder; supported are {extensions}")]
    NoRecords { folder: String, extensions: String },
    #[error(
        "{file}: larger than {limit_mb} MB; a record is text of a few MB at most: check that this is the right file"
    )]
    TooLarge { file: String, limit_mb: u64 },
    #[error("{file}: not a text file (byte {byte} is 0x{value:02x}); export the record as plain UTF-8 text")]
    Binary { file: String, byte: usize, value: u8 },
    #[error("{file}: holds no samples; give a PEER AT2 file, or columns of time and acceleration, or of acceleration")]
    Empty { file: String },
    #[error("{file}, line {line}: '{text}' is not a number; correct it, or start a comment line with #")]
    NotANumber { file: String, line: usize, text: String },
    #[error("{file}, line {line}: '{text}' is not a finite number; repair or cut the record there")]
    NotFinite { file: String, line: usize, text: String },
    #[error("{file}, line {line}: '{text}' has decimal commas; write decimal points instead")]
    DecimalComma { file: String, line: usize, text: String },
    #[error(
        "{file}, line {line}: {found} columns; give one column (acceleration, with --dt) or two (time, acceleration), or PEER AT2"
    )]
    TooManyColumns { file: String, line: usize, found: usize },
    #[error(
        "{file}, line {line}: {found} columns where the lines before have {expected}; the line is cut or merged: repair it"
    )]
    Ragged { file: String, line: usize, found: usize, expected: usize },
    #[error(
        "{file}, line {line}: the time step is {step:?} s where {expected:?} s is expected; resample evenly, or if the times are only printed coarsely pass --dt"
    )]
    Uneven { file: String, line: usize, step: f64, expected: f64 },
    #[error(
        "{file}: no line with NPTS and DT near the top; an AT2 file says 'NPTS= 4000, DT= .01000 SEC' on its fourth line"
    )]
    NoHeader { file: String },
    #[error("{file}, line {line}: cannot read NPTS and DT from '{text}'; write 'NPTS= 4000, DT= .01000 SEC'")]
    BadHeader { file: String, line: usize, text: String },
    #[error(
        "{file}, line {line}: the file ends after {found} samples but its header (line {header_line}) says NPTS {npts}; the file is cut or damaged: fetch it again or correct NPTS"
    )]
    Count { file: String, line: usize, found: usize, header_line: usize, npts: u64 },
    #[error("{file}: the file's time step is {file_dt:?} s but --dt is {given:?} s; drop --dt or correct one of them")]
    StepDiffers { file: String, file_dt: f64, given: f64 },
    #[error(
        "{file}: the file says its unit is {file_units} but --units is {given}; drop --units or correct one of them"
    )]
    UnitsDiffer { file: String, file_units: Units, given: Units },
    #[error("{file}: the time step is not in the file; pass --dt SECONDS")]
    NoStep { file: String },
    #[error("{file}: the unit of acceleration is not in the file; pass --units g, m/s2 or cm/s2")]
    NoUnits { file: String },
    #[error("{file}: the header speaks of {quantity}, not of acceleration; give the acceleration record")]
    NotAcceleration { file: String, quantity: &'static str },
    #[error("{record}: the time step is {dt:?} s; it must be between 1e-6 and 1 s")]
    BadStep { record: String, dt: f64 },
    #[error("{record}: sample {index} (counted from 0) is {value:?}; every sample must be a finite number")]
    BadSample { record: String, index: usize, value: f64 },
    #[error(
        "{record}: the peak is {shown:.4} g, above 50 g; the unit is probably wrong: numbers in cm/s2 need --units cm/s2, in m/s2 --units m/s2",
        shown = .pga_g.min(1e9)
    )]
    HugePeak { record: String, pga_g: f64 },
}
