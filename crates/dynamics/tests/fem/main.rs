//! Stories of the finite element model: what a user may rely on, over whole histories.

mod accuracy;
mod common;
mod edges;
mod energy;
mod extremes;
mod landings;
mod lanes;
mod members;
mod rigid_limit;
mod similarity;
mod stiff;
mod vertical;
