//! Files read within bounds and written whole; numbers and paths in words.

#![warn(missing_docs)]

pub mod input;
pub mod memory;
pub mod message;
pub mod whole_file;
