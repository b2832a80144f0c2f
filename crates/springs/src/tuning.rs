//! Finding springs: the inner design (mu, f, xi), by the paper's frequency response or from the geometry; Omega_n; and what
//! uses them.

pub mod arr;

pub mod assessment;

pub mod descent;

pub mod elastic;

pub mod follow;

pub mod job;

mod ladder;

pub mod landing;

pub mod omega;

mod search;

pub mod suite;

pub mod whole_model;
