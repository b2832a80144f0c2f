//! The paper's inner fit: f and xi of a mass ratio mu by the shape of the frequency response (ARR,
//! equation 7).

pub mod certificate;

pub mod excess;

pub mod inner;

pub mod minimax;

pub mod outer;

pub mod smooth;

pub mod table_1;
