//! Springs from the geometry: the landing in the stiff limit as a small problem of its own.

pub mod chain;

mod linear;

pub mod corners;

pub mod plane;

pub mod design;

pub mod part;

pub mod universal;

pub mod weight;
