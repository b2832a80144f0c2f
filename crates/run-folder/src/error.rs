//! Why results were not written.

use decks::ExportError;
use figures::FigureError;
use thiserror::Error;

/// Why results were not written.
#[derive(Debug, Error)]
pub enum FolderError {
    /// A figure that cannot be drawn or written.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// A deck that cannot be made.
    #[error("{}", .0.with_options())]
    Deck(#[from] ExportError),
    /// A file that cannot be written.
    #[error("{path}: cannot be written ({source}); check the folder and its rights")]
    Write {
        /// The file.
        path: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// A file stands where a folder is needed.
    #[error("{path}: is a file where a folder is needed; name another with --out")]
    NotAFolder {
        /// The file.
        path: String,
    },
    /// A folder where a file is needed.
    #[error("{path}: is a folder; name a file with --out")]
    NotAFile {
        /// The folder.
        path: String,
    },
    /// A file that the command reads, or a case.
    #[error("{path}: is {what} and would be lost; name another file with --out")]
    Input {
        /// The file.
        path: String,
        /// What it is.
        what: &'static str,
    },
    /// A device or a pipe.
    #[error("{path}: is a device or a pipe, which a file would replace; name a file with --out")]
    NotRegular {
        /// The device.
        path: String,
    },
    /// The folder of a file is not there.
    #[error("{path}: there is no folder {folder}; make it first, or name another with --out")]
    NoFolder {
        /// The file.
        path: String,
        /// Its folder.
        folder: String,
    },
    /// Files of two runs may stand in a folder.
    #[error(
        "{folder}: tune {command} was stopped while it put its files there, and some are of \
         another run; run it again (or, if you know \
         that {folder} is of one run, remove UNFINISHED-{command}.txt)"
    )]
    Mixed {
        /// The folder.
        folder: String,
        /// The command that was stopped.
        command: &'static str,
    },
    /// A file is not the one that a run wrote there.
    #[error(
        "{path}: is not the file that tune run wrote there with the other files of {folder}; run \
         it again, or put yours into a folder of its own"
    )]
    OfAnotherRun {
        /// The file.
        path: String,
        /// Its folder.
        folder: String,
    },
    /// A list of files that cannot be put in words.
    #[error("the list of files: {0}")]
    List(#[from] serde_json::Error),
}
