//! A lane's numbers out of the rows of all lanes, and a factored matrix as such numbers.

use num_complex::Complex;

use super::Lanes;
use crate::fem::newton::{Chains, Condensed, Rigid};

/// Numbers that make up a factored matrix.
pub(super) const ENTRIES: usize = 25;

/// Lane l's numbers.
#[inline(always)]
pub(super) fn column<const M: usize>(rows: &[Lanes; M], l: usize) -> [f64; M] {
    let mut column = [0.0; M];
    for k in 0..M {
        column[k] = rows[k][l];
    }
    column
}

/// Complex numbers from their parts.
#[inline(always)]
pub(super) fn both(re: &[f64; ENTRIES], im: &[f64; ENTRIES]) -> [Complex<f64>; ENTRIES] {
    let mut both = [Complex::new(0.0, 0.0); ENTRIES];
    coordinates!(E in 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 => {
        both[E] = Complex::new(re[E], im[E]);
    });
    both
}

/// A factored matrix as numbers in a row.
#[inline(always)]
pub(super) fn pack<T: Copy>(chains: &Chains<T>, rigid: &Rigid<T>) -> [T; ENTRIES] {
    let ([[a, b], [c, d]], [[e, f], [g, h]]) = (&chains.0, &rigid.lever);
    #[rustfmt::skip]
    let entries = [
        a.pivot, a.coupling, a.share, a.stiffness,
        b.pivot, b.coupling, b.share, b.stiffness,
        c.pivot, c.coupling, c.share, c.stiffness,
        d.pivot, d.coupling, d.share, d.stiffness,
        *e, *f, *g, *h,
        rigid.x_inv, rigid.z_inv, rigid.th_inv, rigid.x_th, rigid.z_th,
    ];
    entries
}

#[inline(always)]
pub(super) fn unpack<T: Copy>(e: &[T; ENTRIES], closed: [bool; 2]) -> (Chains<T>, Rigid<T>) {
    let condensed = |k: usize| Condensed {
        pivot: e[k],
        coupling: e[k + 1],
        share: e[k + 2],
        stiffness: e[k + 3],
    };
    let chains = Chains([[condensed(0), condensed(4)], [condensed(8), condensed(12)]]);
    let lever = [[e[16], e[17]], [e[18], e[19]]];
    (
        chains,
        Rigid {
            closed,
            lever,
            x_inv: e[20],
            z_inv: e[21],
            th_inv: e[22],
            x_th: e[23],
            z_th: e[24],
        },
    )
}
