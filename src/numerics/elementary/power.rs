//! Powers to a few digits, with the same bits on every machine, where a library's full precision would cost more than
//! it is worth: step size control asks for two a step.

/// `base` to the power `exponent`, for normal positive bases and results, wrong by less than 1e-3 of itself while
/// |exponent| ≤ 1.
///
/// log₂(2^n m) = n + log₂ m with m between √½ and √2 from three terms of the series in (m − 1)/(m + 1), and 2^x from a
/// polynomial between −½ and ½.
#[inline]
pub fn rough_power(base: f64, exponent: f64) -> f64 {
    power_of_two(exponent * logarithm_of_two(base))
}

#[inline]
fn logarithm_of_two(x: f64) -> f64 {
    const SQRT_HALF: u64 = std::f64::consts::FRAC_1_SQRT_2.to_bits();
    // Bits counted from √½: their upper part is n, what is left belongs to m.
    let bits = x.to_bits() as i64 - SQRT_HALF as i64;
    let n = bits >> 52;
    let m = f64::from_bits((bits - (n << 52) + SQRT_HALF as i64) as u64);
    let t = (m - 1.0) / (m + 1.0);
    let square = t * t;
    n as f64 + t * (2.0 + square * (2.0 / 3.0 + square * (2.0 / 5.0))) * std::f64::consts::LOG2_E
}

#[inline]
fn power_of_two(x: f64) -> f64 {
    const TO_WHOLE: f64 = 6_755_399_441_055_744.0;
    let x = x.clamp(-1000.0, 1000.0);
    let shifted = x + TO_WHOLE;
    let y = (x - (shifted - TO_WHOLE)) * std::f64::consts::LN_2;
    let fraction = 1.0 + y * (1.0 + y * (0.5 + y * (1.0 / 6.0 + y * (1.0 / 24.0 + y * (1.0 / 120.0)))));
    // The last bits of the shifted number are the whole part.
    f64::from_bits(fraction.to_bits().wrapping_add(shifted.to_bits() << 52))
}

#[test]
fn rough_powers_have_three_digits() {
    for i in -300..300 {
        let base = 10f64.powf(f64::from(i) / 10.0);
        for exponent in [-1.0, -0.17, 0.0, 0.04, 0.5, 1.0] {
            let (found, expected) = (rough_power(base, exponent), base.powf(exponent));
            assert!((found / expected - 1.0).abs() < 1e-3, "{base} {exponent}: {found} {expected}");
        }
    }
}
