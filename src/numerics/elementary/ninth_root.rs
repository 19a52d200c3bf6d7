//! x^(1/9) with the same bits on every machine, for line contacts, whose force grows as δ^(10/9).
//!
//! With w ≈ x^(−1/9) and r = 1 − x w⁹ the exact root is w (1 − r)^(−1/9), of whose series four terms are taken, twice.
//! The first w comes from the bits of x: they are about its logarithm, so a ninth of them, taken from the right
//! constant, is about that of w, wrong by at most 3.0 %. |r| is then 0.31 at most, 1e-3 after the first round and
//! rounding after the second. No division and no branch, so that a compiler takes several numbers at a time.

use std::ops::{Add, Mul, Sub};

/// 2^52, whose last bits count whole numbers.
const WHOLE: f64 = 4_503_599_627_370_496.0;
/// Bits of the first w where those of x are 0, less the last twelve: (10/9 · 1023 − 0.053) · 2^40. The second part, for
/// logarithms being a little above what bits say, makes the largest error on either side the same.
const START: f64 = (10.0 / 9.0 * 1023.0 - 0.053) * 1_099_511_627_776.0;
/// The series of (1 − r)^(−1/9) less its first term, over r.
const SERIES: [f64; 4] = [1.0 / 9.0, 5.0 / 81.0, 95.0 / 2187.0, 665.0 / 19683.0];

/// x^(1/9) of a normal positive number, to 3e-16 of itself; 0 of 0, NaN of NaN. Subnormal numbers give
/// too small a root.
#[inline(always)]
pub fn ninth_root(x: f64) -> f64 {
    root_from(x, first(x), |number| number)
}

/// The first w.
#[inline(always)]
pub(in crate::numerics) fn first(x: f64) -> f64 {
    let upper = f64::from_bits((x.to_bits() >> 12) | WHOLE.to_bits()) - WHOLE;
    let start = (START - upper * (1.0 / 9.0)) + WHOLE;
    f64::from_bits(start.to_bits() << 12)
}

/// The root of one number or of several side by side from the first w; `number` makes a constant of their kind.
#[inline(always)]
pub(in crate::numerics) fn root_from<T>(x: T, mut w: T, number: impl Fn(f64) -> T) -> T
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>,
{
    let [a, b, c, d] = SERIES.map(&number);
    // 1 − x w⁹, and w⁸.
    let residual = |w: T| {
        let square = w * w;
        let fourth = square * square;
        let eighth = fourth * fourth;
        (number(1.0) - x * eighth * w, eighth)
    };
    for _ in 0..2 {
        let (r, _) = residual(w);
        w = w + w * (r * (a + r * (b + r * (c + r * d))));
    }
    // x w⁸ has eight times the rounding of w, and r knows it: (1 − r)^(−8/9).
    let (r, eighth) = residual(w);
    let root = x * eighth;
    root + root * (r * number(8.0 / 9.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_is_exact_to_rounding_over_all_magnitudes() {
        let (mut worst, mut ninth) = (0.0f64, 0.0f64);
        for i in 0..=200_000 {
            // From 1e-300 to 1e300, and every mantissa in turn.
            let x = libm::exp2(f64::from(i - 100_000) * 0.00996 + 0.01);
            let (root, expected) = (ninth_root(x), libm::pow(x, 1.0 / 9.0));
            worst = worst.max((root / expected - 1.0).abs());
            let power = root * root * root;
            ninth = ninth.max((power * power * power / x - 1.0).abs());
        }
        println!("worst: {worst:e}, of the ninth power {ninth:e}");
        // libm's power is given 1/9 rounded, which is 6e-18 · ln x off: 4e-15 at 1e300.
        assert!(worst < 5e-15, "{worst:e}");
        // Nine times the root's error, and four roundings.
        assert!(ninth < 9.0 * 3e-16 + 4.5e-16, "{ninth:e}");
    }

    #[test]
    fn powers_of_512_have_their_roots_to_rounding() {
        for k in -100..=100 {
            let (x, expected) = (libm::exp2(f64::from(9 * k)), libm::exp2(f64::from(k)));
            // Six roundings of half a unit each, of which most cancel.
            assert!((ninth_root(x) / expected - 1.0).abs() <= 3.0 * f64::EPSILON, "{k}: {:e}", ninth_root(x));
        }
    }

    #[test]
    fn nothing_has_the_root_nothing_and_nan_stays_so() {
        assert_eq!(ninth_root(0.0), 0.0);
        assert!(ninth_root(f64::NAN).is_nan() && ninth_root(-f64::NAN).is_nan());
        assert!(ninth_root(f64::MIN_POSITIVE / 1e10).is_finite());
    }

    #[test]
    fn the_root_grows_with_its_number() {
        let mut last = 0.0;
        for i in 0..100_000 {
            let root = ninth_root(1e-9 * libm::exp2(f64::from(i) * 1e-4));
            // A step of 7e-5 in x is 8e-6 in the root, far above rounding.
            assert!(root > last);
            last = root;
        }
    }
}
