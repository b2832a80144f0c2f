//! Ground springs that let a finite element program follow Housner's theory of rocking.
//!
//! The modules stand in the order in which data flows through the program:
//!
//! ```text
//! record ──┐
//! structure┼─> housner ──────────────┐
//!          │                         ├─> compare ─> tuning ─> export, figures
//! spring ──┴─> fem ──────────────────┘      ^
//!   ^                                       │
//!   └── response (ARR) <────────────────────┘
//! ```
//!
//! Symbols are those of Ma, Butterworth & Davidson, "Modelling rocking structures using standard
//! finite elements", NZSEE Conference 2005; numbers in brackets, as (7), are its equations.
//! Units are SI throughout; angles in radians; theta > 0 leans to the right, u > 0 is to the right.

// units in brackets, as [m], are no links
#![allow(rustdoc::broken_intra_doc_links)]

mod message;

pub mod scalar;

pub mod record;

pub mod synthetic;

pub mod excitation;

pub mod structure;

pub mod spring;

pub mod members;

pub mod response;

pub mod motion;

pub mod housner;

pub mod conditioning;

pub mod regime;

pub mod fem;

pub mod overturning;

pub mod compare;

pub mod verdict;

pub mod parameters;

pub mod tuning;

pub mod validate;

pub mod predictability;

#[cfg(feature = "cli")]
pub mod sweep;

pub mod export;

pub mod front;

pub mod verify;

#[cfg(feature = "cli")]
pub mod bench;

pub mod case;

#[cfg(feature = "cli")]
pub mod commands;

#[cfg(feature = "figures")]
pub mod figures;
