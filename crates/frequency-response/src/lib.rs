//! The frequency response of a spring-absorber unit (ARR, equation 7), and the paper's inner fit:
//! f and xi of a mass ratio mu that bring it to a wanted shape.
//!
//! | file | what |
//! |---|---|
//! | `response` | equations 5 to 7 |
//! | `target`, `bounds` | the wanted shape; where f and xi may lie |
//! | `excess` | by how much the response exceeds its target, with exact derivatives |
//! | `smooth`, `minimax` | the fit: L-BFGS on a smooth maximum, then exact minimax steps |
//! | `certificate` | what proves that a fit is a minimum |
//! | `inner` | all of it: `fit` |

pub mod bounds;
pub mod certificate;
mod excess;
pub mod inner;
mod minimax;
pub mod response;
mod smooth;
pub mod target;

pub use response::{Response, arr};
