//! Sine and cosine without branches, with the same bits on every machine.
//!
//! The angle is brought into [−π/4, π/4] by n quarter turns, π/2 taken in two parts (Cody and Waite) of which the first
//! has 33 bits, so that n times it is exact. There Taylor's series end where the next term is below rounding:
//! 0.79¹⁹/19! is 1e-19. Beyond [`LARGEST`] the library's reduction takes over.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI, TAU};

/// Largest angle that the two parts of π/2 serve (rad).
const LARGEST: f64 = 1e5;
/// π/2 in two parts; the first has 33 bits.
const QUARTER: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];
/// Added to a small number it leaves its nearest whole number in the last bits.
const TO_WHOLE: f64 = 6_755_399_441_055_744.0;

/// −1/3!, 1/5!, …
const SINE: [f64; 8] = [
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5_040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
    1.0 / 355_687_428_096_000.0,
];

/// 1/4!, −1/6!, …
const COSINE: [f64; 7] = [
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
];

/// Sine and cosine of `angle` (rad), with the same bits on every machine.
#[inline(always)]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    if !(angle.abs() <= LARGEST) {
        return libm::sincos(angle);
    }
    let shifted = angle * FRAC_2_PI + TO_WHOLE;
    let quarters = shifted - TO_WHOLE;
    let rest = (angle - quarters * QUARTER[0]) - quarters * QUARTER[1];
    let square = rest * rest;
    let sine = rest + rest * square * series(&SINE, square);
    let cosine = 1.0 - 0.5 * square + square * square * series(&COSINE, square);
    let quadrant = shifted.to_bits();
    let (first, second) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let negate = |value: f64, when: bool| if when { -value } else { value };
    (negate(first, quadrant & 2 != 0), negate(second, (quadrant ^ (quadrant >> 1)) & 1 != 0))
}

/// Ratio up to which [`direction_angle`] is a series: the next term is 0.01¹⁰/11 of the angle.
const SMALL_RATIO: f64 = 0.01;

/// Angle (rad) of a direction with these parts along x and y, in [−π, π]; 0 has no sign along x.
#[inline(always)]
pub fn direction_angle([x, y]: [f64; 2]) -> f64 {
    if !(y.abs() < SMALL_RATIO * x) {
        return libm::atan2(y, x);
    }
    let ratio = y / x;
    let square = ratio * ratio;
    ratio - ratio * (square * (1.0 / 3.0 - square * (0.2 - square * (1.0 / 7.0 - square * (1.0 / 9.0)))))
}

/// Angle up to which [`small_turn`] holds to rounding (rad): 0.03¹⁰/10! is 2e-22.
pub const SMALL_ANGLE: f64 = 0.03;

/// sin x and 1 − cos x of a small angle (rad), by their series.
#[inline(always)]
pub fn small_turn(x: f64) -> (f64, f64) {
    let square = x * x;
    let sin = x * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0 - square * (1.0 / 5040.0))));
    let less = square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0 - square * (1.0 / 40_320.0))));
    (sin, less)
}

/// c₀ + c₁x + c₂x² + …, even and odd terms apart so that they are worked out side by side.
#[inline(always)]
fn series<const N: usize>(c: &[f64; N], x: f64) -> f64 {
    let square = x * x;
    let (mut even, mut odd) = (0.0, 0.0);
    for i in (0..N).rev() {
        if i % 2 == 0 {
            even = even * square + c[i];
        } else {
            odd = odd * square + c[i];
        }
    }
    even + x * odd
}

/// `angle` (rad) brought into [−π, π] by whole turns.
#[inline(always)]
pub fn wrap(angle: f64) -> f64 {
    let turns = angle * (0.5 * FRAC_1_PI);
    // As far as the sum below keeps whole numbers; the library's rounding is a call on machines without an instruction
    // for it.
    let whole = if turns.abs() < 1e15 { (turns + TO_WHOLE) - TO_WHOLE } else { turns.round() };
    angle - TAU * whole
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angle_of_a_direction_is_that_of_the_library_to_rounding() {
        for i in -4000..=4000 {
            // Through 0, and far beyond where the series ends.
            let ratio = f64::from(i) * f64::from(i).abs() * 1e-9;
            for x in [1.0, 0.3, 2e-5] {
                let (found, expected) = (direction_angle([x, ratio * x]), libm::atan2(ratio * x, x));
                assert!((found - expected).abs() <= f64::EPSILON * expected.abs(), "{ratio}: {found:e} {expected:e}");
            }
        }
        for direction in [[0.0, 0.0], [-1.0, 1e-9], [-1.0, -0.0], [0.0, -2.0]] {
            assert_eq!(direction_angle(direction).to_bits(), libm::atan2(direction[1], direction[0]).to_bits());
        }
        assert_eq!(direction_angle([1.0, -0.0]), 0.0);
        assert!(direction_angle([f64::NAN, 0.0]).is_nan() && direction_angle([1.0, f64::NAN]).is_nan());
    }
    use std::f64::consts::PI;

    #[test]
    fn the_two_parts_of_a_quarter_turn_are_pi_half_and_the_first_has_33_bits() {
        assert_eq!(QUARTER[0].to_bits() & 0xf_ffff, 0);
        assert_eq!(QUARTER[0] + QUARTER[1], PI / 2.0);
        // π/2 − (its double) = 6.123233995736766e-17, of which the second part holds what is below the first.
        assert!(((PI / 2.0 - QUARTER[0]) + 6.123_233_995_736_766e-17 - QUARTER[1]).abs() < 1e-26);
    }

    #[test]
    fn a_wrapped_angle_lies_within_half_a_turn_and_differs_by_whole_turns() {
        for i in -2000..2000 {
            let angle = 0.37 * f64::from(i);
            let wrapped = wrap(angle);
            // Half a turn, and what rounding of the angle lets through.
            assert!(wrapped.abs() <= PI + 1e-12, "{angle}: {wrapped}");
            let turns = (angle - wrapped) / TAU;
            assert!((turns - turns.round()).abs() < 1e-12, "{angle}: {wrapped}");
        }
        assert_eq!((wrap(0.0), wrap(3.0), wrap(-3.0)), (0.0, 3.0, -3.0));
    }

    #[test]
    fn sine_and_cosine_are_those_of_the_library_to_the_last_bit_or_so() {
        let mut worst = 0.0f64;
        for i in -200_000..200_000 {
            let angle = f64::from(i) * 1.234_567e-4 + 1e-9 * f64::from(i % 7);
            let (sin, cos) = sin_cos(angle);
            let (sin_libm, cos_libm) = libm::sincos(angle);
            worst = worst.max((sin - sin_libm).abs()).max((cos - cos_libm).abs());
        }
        // One unit in the last place of 1 is 2.2e-16; roundings of the series add about half of it.
        assert!(worst < 2.3e-16, "{worst:e}");
        for angle in [0.0, -0.0, 1e-300, 99_999.9, -99_999.9, 1e7, 1e300] {
            let (sin, cos) = sin_cos(angle);
            let (sin_libm, cos_libm) = libm::sincos(angle);
            // Reduction by two parts at 1e5: 6e4 quarter turns of 1e-26.
            assert!((sin - sin_libm).abs() < 3e-16 && (cos - cos_libm).abs() < 3e-16, "{angle}");
        }
        assert!(sin_cos(f64::NAN).0.is_nan() && sin_cos(f64::INFINITY).1.is_nan());
    }
}
