//! Finding springs: the inner fit (f, xi for a mass ratio mu, on the frequency response) and what uses it.

pub mod bounds;

mod catalogue;

pub mod choice;

pub mod certificate;

pub mod descent;

pub mod excess;

pub mod front;

mod global;

pub mod impact;

pub mod impulse;

pub mod inner;

pub mod job;

pub mod minimax;

mod off;

pub mod outer;

pub mod smooth;
