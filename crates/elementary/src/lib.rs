//! Elementary functions that give the same bits on every machine.
//!
//! `f64::sin` and its like call the C library of the system, and the last digit of what that gives
//! differs from one library to another. Whoever links this crate has those calls answered by the
//! crate `libm`, the same code everywhere, in a browser too: it defines the C library's symbols, so
//! that every crate of a program is served, and none has to be changed. IEEE 754 fixes the
//! others (`+`, `/`, `sqrt`, `mul_add`).
//!
//! A crate needs `use elementary as _;` for it to be linked.

/// Functions of one number under their names in C.
macro_rules! of_one {
    ($($name:ident)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of the C library.")]
        // SAFETY: the name, the arguments and the result are those of the C library's function
        #[unsafe(no_mangle)]
        pub extern "C" fn $name(x: f64) -> f64 {
            libm::$name(x)
        }
    )*};
}

/// Functions of two numbers.
macro_rules! of_two {
    ($($name:ident)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of the C library.")]
        // SAFETY: as above
        #[unsafe(no_mangle)]
        pub extern "C" fn $name(x: f64, y: f64) -> f64 {
            libm::$name(x, y)
        }
    )*};
}

of_one! { acos acosh asin asinh atan atanh cbrt cos cosh }
of_one! { exp exp2 expm1 log log10 log1p log2 sin sinh tan tanh }
of_two! { atan2 hypot pow }

/// Sine and cosine at once, as compilers for Linux call them.
///
/// # Safety
/// `sin` and `cos` point to numbers that may be written.
// SAFETY: the name, the arguments and the result are those of the C library's function
#[unsafe(no_mangle)]
pub unsafe extern "C" fn sincos(x: f64, sin: *mut f64, cos: *mut f64) {
    // one reduction of the argument: the same bits as of each alone
    let (sine, cosine) = libm::sincos(x);
    // SAFETY: the caller's promise
    unsafe {
        *sin = sine;
        *cos = cosine;
    }
}

#[cfg(test)]
mod tests {
    use std::hint::black_box;

    /// Arguments of all sizes.
    fn arguments() -> impl Iterator<Item = f64> {
        (0..4000).map(|i| (f64::from(i) - 2000.0) * 0.003_7 * 1.01_f64.powi(i % 700))
    }

    /// Of `pow` the libraries differ in the last bit at some of these arguments, of the others at
    /// more: were the C library called, this would fail.
    #[test]
    fn the_standard_library_calls_these() {
        type Pair = (fn(f64) -> f64, fn(f64) -> f64);
        let pairs: [Pair; 9] = [
            (f64::sin, libm::sin),
            (f64::cos, libm::cos),
            (f64::tan, libm::tan),
            (f64::atan, libm::atan),
            (f64::exp, libm::exp),
            (f64::exp_m1, libm::expm1),
            (f64::tanh, libm::tanh),
            (f64::cbrt, libm::cbrt),
            (|x| x.abs().ln(), |x| libm::log(x.abs())),
        ];
        for (i, (standard, ours)) in pairs.iter().enumerate() {
            for x in arguments() {
                let [a, b] = [standard(black_box(x)), ours(black_box(x))];
                assert!(
                    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan(),
                    "function {i} of {x:?}: {a:?}, {b:?}"
                );
            }
        }
        // where sine and cosine are first told from x and 1, too
        let small = (0..4000).map(|i| f64::from(2000 + i) / 2000.0 * 2.0_f64.powi(-28 + i % 4));
        for x in arguments().chain(small) {
            let both = black_box(x).sin_cos();
            assert_eq!(
                (both.0.to_bits(), both.1.to_bits()),
                (libm::sin(x).to_bits(), libm::cos(x).to_bits()),
                "{x:?}"
            );
        }
        for (x, y) in arguments().zip(arguments().skip(17)) {
            let [a, b] = [black_box(x.abs()).powf(black_box(0.37)), libm::pow(x.abs(), 0.37)];
            assert_eq!(a.to_bits(), b.to_bits(), "pow of {x:?}");
            assert_eq!(
                black_box(x).atan2(black_box(y)).to_bits(),
                libm::atan2(x, y).to_bits(),
                "atan2 of {x:?}, {y:?}"
            );
            assert_eq!(
                black_box(x).hypot(black_box(y)).to_bits(),
                libm::hypot(x, y).to_bits(),
                "hypot of {x:?}, {y:?}"
            );
        }
    }
}
