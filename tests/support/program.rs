//! The program `tune`, run in a folder of files to its end.

// a test program uses some of it
#![allow(dead_code)]

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use serde_json::Value;
use tempfile::TempDir;

/// The record of Te Mara Farm, with its vertical component.
pub const TE_MARA: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/tests/records/20161113_110259_WTMC_20.V2A");

/// A small record of three components, S16W, S74E and upwards.
pub const WAIPAWA: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/tests/records/20180212_211557_WPWS_20.V2A");

/// A command in a folder; its words stand between blanks, or between quotation marks: `--out ''`.
pub fn command(folder: &Path, line: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tune"));
    for (i, part) in line.split('\'').enumerate() {
        if i % 2 == 1 {
            command.arg(part);
        } else {
            command.args(part.split_whitespace());
        }
    }
    command.current_dir(folder);
    command
}

/// How a command ended, and what it printed.
#[derive(Debug)]
pub struct Ended {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

impl From<Output> for Ended {
    fn from(output: Output) -> Self {
        let [stdout, stderr] =
            [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        Self { code: output.status.code(), stdout, stderr }
    }
}

impl Ended {
    /// It must have ended well.
    pub fn well(self) -> Self {
        assert_eq!(self.code, Some(0), "{}", self.stderr);
        self
    }

    /// What it refuses, in one line and with exit code 2, without a result.
    pub fn refusal(self) -> String {
        assert_eq!((self.code, self.stdout.as_str()), (Some(2), ""), "{}", self.stderr);
        assert_eq!(self.stderr.trim_end().lines().count(), 1, "{}", self.stderr);
        self.stderr
    }
}

pub fn tune(folder: &Path, line: &str) -> Ended {
    command(folder, line).output().unwrap().into()
}

/// A folder that is there for a test.
pub struct TestFolder(TempDir);

impl TestFolder {
    /// With these files.
    pub fn with(files: &[(&str, &str)]) -> Self {
        let folder = Self(TempDir::new().unwrap());
        files.iter().for_each(|(name, text)| folder.write(name, text));
        folder
    }

    /// A file; a folder, if its name ends in /.
    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.path(name);
        match name.ends_with('/') {
            true => fs::create_dir(path).unwrap(),
            false => fs::write(path, bytes).unwrap(),
        }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn has(&self, name: &str) -> bool {
        self.path(name).exists()
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.bytes(name)).unwrap()
    }

    pub fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&self.bytes(name)).unwrap()
    }

    /// Run the program here.
    pub fn tune(&self, line: &str) -> Ended {
        tune(self.0.path(), line)
    }

    /// The same; it must end well.
    pub fn runs(&self, line: &str) -> Ended {
        self.tune(line).well()
    }

    /// The same; it must refuse, and this is what it says.
    pub fn refuses(&self, line: &str) -> String {
        self.tune(line).refusal()
    }
}

/// A finding of parameters.json.
pub fn finding<'a>(parameters: &'a Value, name: &str) -> Option<&'a Value> {
    parameters["findings"].as_array()?.iter().find(|finding| finding["finding"] == name)
}
