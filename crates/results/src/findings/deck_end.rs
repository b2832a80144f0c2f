//! Where judging a deck ends.

use serde::{Deserialize, Serialize};

/// Why a deck's history is judged for less than the record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DeckEnd {
    /// All of the record is judged.
    Record,
    /// The body falls over, or our own history ends.
    History,
    /// From there on the motion hangs on the fifth digit of the width, or on changes as small.
    Foretold,
    /// A change of 0.1 % moves the motion too much from there on.
    IllConditioned,
    /// The ground falls faster than a body that has no rotational inertia of its own.
    Flight,
    /// A corner slides on from a landing: what follows depends on friction.
    Slides,
}
