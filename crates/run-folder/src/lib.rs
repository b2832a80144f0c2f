//! The folder of a run: tables, decks, figures, report, exchanged as a whole.
//!
//! | module | what |
//! |---|---|
//! | `rigid`, `elastic` | all that a run leaves |
//! | `folder`, `place` | one run a folder; what can be written is found out before the work |
//! | `tables`, `models`, `pictures` | CSV files, decks, figures |
//! | `texts` | the files of a run before they are written |

#![warn(missing_docs)]

pub mod elastic;
mod error;
pub mod folder;
pub mod models;
pub mod pictures;
pub mod place;
pub mod rigid;
pub mod tables;
pub mod texts;

pub use error::FolderError;
