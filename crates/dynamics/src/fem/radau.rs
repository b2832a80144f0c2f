//! Radau IIA, three stages, order 5, L-stable and stiffly accurate (Hairer & Wanner, *Solving
//! Ordinary Differential Equations II*, section IV.5), for second-order systems.
//!
//! With a step h from (q, v), the stage accelerations a_j give the stages V_i = v + h sum A_ij a_j
//! and Q_i = q + c_i h v + h^2 sum (A^2)_ij a_j; the last stage is the step's end. `T` diagonalises
//! A in real form: A T = T Lambda with Lambda = [[GAMMA]] and [[ALPHA, BETA], [-BETA, ALPHA]].

/// Nodes c.
pub const C: [f64; 3] = [0.155_051_025_721_682_19, 0.644_948_974_278_317_8, 1.0];

/// Coefficients A; the last row is also the weights b.
pub const A: [[f64; 3]; 3] = [
    [0.196_815_477_223_660_43, -0.065_535_425_850_198_388, 0.023_770_974_348_220_152],
    [0.394_424_314_739_087_28, 0.292_073_411_665_228_46, -0.041_548_752_125_997_931],
    [0.376_403_062_700_467_28, 0.512_485_826_188_421_61, 0.111_111_111_111_111_11],
];

/// A squared.
pub(crate) const A2: [[f64; 3]; 3] = [
    [0.021_835_034_190_722_740, -0.019_857_254_098_612_275, 0.010_042_630_196_562_411],
    [0.177_190_587_431_945_61, 0.038_164_965_809_277_260, -0.007_375_963_529_895_744_3],
    [0.318_041_381_743_977_17, 0.181_958_618_256_022_83, 0.0],
];

/// Inverse of A squared.
pub(crate) const A2_INV: [[f64; 3]; 3] = [
    [4.831_632_475_943_927_0, 6.578_435_211_201_746_2, -0.852_516_921_786_418_29],
    [-8.445_101_877_868_412_8, -11.498_299_142_610_594, 6.985_850_255_119_751_6],
    [72.371_937_588_824_311, -37.038_604_255_490_978, 15.666_666_666_666_667],
];

/// The real eigenvalue of A.
pub const GAMMA: f64 = 0.274_888_829_595_677_37;
/// Real part of the complex pair of A.
pub(crate) const ALPHA: f64 = 0.162_555_585_202_161_32;
/// Imaginary part of the complex pair of A.
pub(crate) const BETA: f64 = 0.184_949_324_407_140_78;

/// Weights of the stages in the embedded formula of order three, GAMMA/3 (-13 - 7 sqrt 6, -13 + 7
/// sqrt 6, -1); that of the start is GAMMA.
pub(crate) const E: [f64; 3] =
    [-2.762_305_454_748_599_2, 0.379_935_598_252_728_87, -0.091_629_609_865_225_789];

/// Eigenvectors: the real one, then real and imaginary part of the one of ALPHA + i BETA.
pub(crate) const T: [[f64; 3]; 3] = [
    [0.094_438_762_488_975_241, -0.141_255_295_020_954_21, -0.030_029_194_105_147_424],
    [0.250_213_122_965_333_11, 0.204_129_352_293_799_93, 0.382_942_112_757_261_94],
    [1.0, 1.0, 0.0],
];

/// Inverse of T.
pub(crate) const T_INV: [[f64; 3]; 3] = [
    [4.178_718_591_551_904_7, 0.327_682_820_761_062_39, 0.523_376_445_499_449_55],
    [-4.178_718_591_551_904_7, -0.327_682_820_761_062_39, 0.476_623_554_500_550_45],
    [-0.502_872_634_945_786_88, 2.571_926_949_855_605_4, -0.596_039_204_828_224_92],
];

/// Lagrange polynomials on the nodes, by ascending powers of tau.
const LAGRANGE: [[f64; 3]; 3] = [
    [1.558_078_204_724_922_4, -3.973_894_442_696_885_9, 2.415_816_237_971_963_5],
    [-0.891_411_538_058_255_72, 6.640_561_109_363_552_5, -5.749_149_571_305_296_8],
    [1.0 / 3.0, -8.0 / 3.0, 10.0 / 3.0],
];

/// Weights w_j(tau) such that q(tau) = q + h sum w_j V_j, the collocation polynomial at tau in
/// 0..1.
pub(crate) fn position_weights(tau: f64) -> [f64; 3] {
    LAGRANGE.map(|[p0, p1, p2]| tau * (p0 + tau * (p1 / 2.0 + tau * (p2 / 3.0))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn product(x: [[f64; 3]; 3], y: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| x[i][k] * y[k][j]).sum()))
    }

    fn assert_close(x: [[f64; 3]; 3], y: [[f64; 3]; 3]) {
        for (a, b) in x.iter().flatten().zip(y.iter().flatten()) {
            assert!((a - b).abs() < 3e-15, "{x:?} {y:?}");
        }
    }

    #[test]
    fn collocation_conditions_hold_to_order_three() {
        for (row, c) in A.iter().zip(C) {
            for k in 1..=3 {
                let sum: f64 = (0..3).map(|j| row[j] * C[j].powi(k - 1)).sum();
                assert!((sum - c.powi(k) / k as f64).abs() < 1e-15);
            }
        }
    }

    /// sum E_i (t^k at c_i) + GAMMA k t^(k-1) at 0 = 0 for k = 1 to 3: nothing is missed of a
    /// cubic. (The formula's weights are GAMMA at the start and b + A^T E at the stages.)
    #[test]
    fn the_embedded_formula_is_of_order_three() {
        let root6 = 6.0_f64.sqrt();
        for (e, x) in E.iter().zip([-13.0 - 7.0 * root6, -13.0 + 7.0 * root6, -1.0]) {
            assert!((e - GAMMA / 3.0 * x).abs() < 1e-15);
        }
        for k in 1..=3 {
            let start = if k == 1 { GAMMA } else { 0.0 };
            let sum: f64 = (0..3).map(|i| E[i] * C[i].powi(k)).sum();
            assert!((sum + start).abs() < 2e-15, "{k} {sum}");
        }
    }

    #[test]
    fn quadrature_is_exact_to_degree_four() {
        for k in 0..=4 {
            let sum: f64 = (0..3).map(|j| A[2][j] * C[j].powi(k)).sum();
            assert!((sum - 1.0 / (k + 1) as f64).abs() < 1e-15);
        }
    }

    #[test]
    fn tables_are_consistent() {
        assert_close(product(A, A), A2);
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        // entries up to 72
        for (row, expected) in product(A2_INV, A2).iter().zip(unit) {
            assert!(row.iter().zip(expected).all(|(x, e)| (x - e).abs() < 1e-14), "{row:?}");
        }
        assert_close(product(T, T_INV), unit);
        let lambda = [[GAMMA, 0.0, 0.0], [0.0, ALPHA, BETA], [0.0, -BETA, ALPHA]];
        assert_close(product(T_INV, product(A, T)), lambda);
    }

    #[test]
    fn the_collocation_polynomial_passes_through_the_stages() {
        for (row, c) in A.iter().zip(C) {
            for (w, a) in position_weights(c).iter().zip(row) {
                // the polynomials' coefficients reach 7: a few units of rounding
                assert!((w - a).abs() < 7.0 * f64::EPSILON);
            }
        }
    }
}
