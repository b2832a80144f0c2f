//! The tests of `benches/compare`, which as a bench runs none.

#[path = "../benches/compare/main.rs"]
mod compare;
