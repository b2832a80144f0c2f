//! Q. T. Ma, J. W. Butterworth, B. D. Davidson, "Modelling rocking structures using standard finite
//! elements", NZSEE Conference 2005: Table 1 and Figure 4, every digit that survives, and what
//! springs do that are found here.
//!
//! ```text
//!            m1 = 680.1 t                        one foot, vertically and horizontally:
//!               /\                               foot - gap, k1 - m2 - (k2 beside c) - ground
//!              /  \    h = 61 m (200 ft)
//!             /    \                             mu = m2/m1, Omega_n^2 = k1/m1, k2 = mu f^2 k1,
//!            /______\                            c = 2 xi mu m1 Omega_n
//!          2b = 12.2 m (40 ft)                   ground: El Centro 1940, N-S, the first 20 s
//! ```
//!
//! J. L. Beck, R. I. Skinner, "The seismic response of a reinforced concrete bridge pier designed
//! to step", Earthquake Engineering and Structural Dynamics 2 (1974) 343-358, had almost the same
//! structure on the same earthquake: peak 444.5 mm (17.5 in), period about 3.3 s; the paper marks
//! 3.5 s. Their record is another digitisation of that ground motion, so that comparison is one of
//! size, not of digits. docs/paper.md tells the same in words, with the command of every number.

#[path = "table_1/digits.rs"]
mod digits;
#[path = "table_1/histories.rs"]
mod histories;
#[path = "table_1/tuned.rs"]
mod tuned;
