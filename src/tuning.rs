//! Finding springs: the inner design (mu, f, xi), by the paper's frequency response or from the geometry; Omega_n; and what
//! uses them.

pub mod arr;

mod catalogue;

pub mod choice;

pub mod descent;

pub mod front;

mod global;

pub mod impact;

pub mod impulse;

pub mod job;

pub mod landing;

mod off;

pub mod outer;
