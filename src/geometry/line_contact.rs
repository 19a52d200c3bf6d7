//! Stiffness of a cylindrical roller's line contact and the depth of its crown, by the lamina law of ISO/TS 16281.
//!
//! A roller of effective length L is cut into n_s laminae. Each carries a part of the force of one contact,
//! ```text
//! Q = Σ_k (K_1/n_s) max(0, δ − P(x_k))^(10/9),   K_1 = 2^(10/9) K_L,   K_L = 35948 L^(8/9) N/mm^(10/9), L in mm
//! ```
//! with δ the contact's own approach and P(x) the crown's depth at the lamina's middle (ISO/TS 16281, equations 38 to
//! 46). The standard's K_L is that of both contacts of a roller in series; an element with mass between them needs each
//! for itself. K_L comes from Palmgren's measurements on steel on steel; with elements of another material it grows as
//! E* does, since his approach is 0.39 (4(1−ν₁²)/E₁ + 4(1−ν₂²)/E₂)^0.9 Q^0.9/L^0.8 (mm, N). Neither raceway nor
//! clearance enters: a half-space gives contacts inside and outside 3 % apart and 6 % off this law between 50 and
//! 1500 N on a roller of 7.5 × 9 mm. Rings do not tilt, so that all laminae see the same δ.

use super::hertz_constant::share_of_ring;
use crate::numerics::ninth_root;
use crate::scene::{Bearing, Roller, RollerProfile};

/// K_L over L^(8/9) (N/m²): 35948 in N and mm.
const BOTH_CONTACTS: f64 = 35948e6;
/// Lengths over diameter from which on the logarithmic crown leaves the roller's middle straight.
const LONG: f64 = 2.5;

/// Order of a line contact's force in its approach.
pub const LINE_ORDER: f64 = 10.0 / 9.0;

/// K_1 (N/m^(10/9)) of one contact of a bearing's straight roller of this effective length (m).
pub fn line_constant_of(bearing: &Bearing, length: f64) -> f64 {
    // Of equal materials exactly 1.
    2.0 * share_of_ring(bearing) * line_constant(length)
}

/// K_1 (N/m^(10/9)) of one contact of a straight roller of steel on steel, of this effective length (m).
pub fn line_constant(length: f64) -> f64 {
    let two = ninth_root(2.0);
    let ninth = ninth_root(length);
    2.0 * two * BOTH_CONTACTS * (length / ninth)
}

/// Depth (m) of the standard's logarithmic crown at `x` (m) from the middle of a roller of this diameter and effective
/// length (m), |x| < length/2: equations 43 and 44.
pub fn logarithmic_depth(diameter: f64, length: f64, x: f64) -> f64 {
    let straight = (length - LONG * diameter).max(0.0);
    let beyond = (2.0 * x.abs() - straight).max(0.0) / (length - straight);
    let factor = if straight > 0.0 { 0.0005 } else { 0.00035 };
    -factor * diameter * libm::log1p(-beyond * beyond)
}

/// Depth (m) of a roller's crown at the middle of each lamina.
pub fn lamina_depths(roller: &Roller, diameter: f64) -> Vec<f64> {
    let length = roller.length;
    let middle = |k: u32| length * ((f64::from(k) + 0.5) / f64::from(roller.laminae) - 0.5);
    let depth = |k| match &roller.profile {
        RollerProfile::Straight => 0.0,
        RollerProfile::Logarithmic => logarithmic_depth(diameter, length, middle(k)),
        RollerProfile::Measured(crown) => crown.depth(middle(k)),
    };
    (0..roller.laminae).map(depth).collect()
}

/// Half the width b (m) of Hertz's line contact along the raceway at an approach δ (m), for a length L (m) and the
/// relative curvature κ (1/m): on the half-space the line's middle yields by
/// ```text
/// δ = q/(π E*) [2 ln(2L/b) + 1],   b² = 4 q/(π E* κ),   q the force per length
/// ```
/// if the line is long against b. Its pressure is taken for uniform along the line, which costs some per cent.
pub fn half_width_under(approach: f64, length: f64, curvature: f64) -> f64 {
    let mut width = (approach / curvature).sqrt();
    // Each round leaves a tenth of the error or less.
    for _ in 0..30 {
        width = (4.0 * approach / (curvature * (2.0 * libm::log(2.0 * length / width) + 1.0).max(1.0))).sqrt();
    }
    width
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_constant_is_the_standards_split_between_two_contacts() {
        // 2^(10/9) · 35948 · 9^(8/9) N/mm^(10/9) = 2^(10/9) · 3.5948e10 · 0.009^(8/9) N/m^(10/9).
        let millimetres = 2f64.powf(10.0 / 9.0) * 35948.0 * 9f64.powf(8.0 / 9.0);
        assert!((line_constant(9e-3) / (millimetres * 1e3f64.powf(10.0 / 9.0)) - 1.0).abs() < 1e-14);
        // In series both give the standard's constant back: δ_i + δ_o = (Q/K_L)^0.9.
        let (force, both): (f64, f64) = (1000.0, 3.5948e10 * 9e-3f64.powf(8.0 / 9.0));
        let one = (force / line_constant(9e-3)).powf(0.9);
        assert!((2.0 * one / (force / both).powf(0.9) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn the_crown_is_the_standards_on_short_rollers_and_on_long_ones() {
        // 0.00035 · 7.5 mm · ln 1/(1 − 0.95²) = 6.1112 µm.
        let found = logarithmic_depth(7.5e-3, 9e-3, 0.475 * 9e-3);
        assert!((found / (0.00035 * 7.5e-3 * (1.0 / (1.0 - 0.9025f64)).ln()) - 1.0).abs() < 1e-14, "{found}");
        // A roller of 3 D is straight over 0.5 D; beyond, 0.0005 D ln 1/(1 − ((2x − 0.5 D)/2.5 D)²).
        let long = |x: f64| logarithmic_depth(5e-3, 15e-3, x);
        assert_eq!([long(0.0), long(1.2e-3), long(-1.24e-3)], [0.0; 3]);
        let expected = 0.0005 * 5e-3 * (1.0 / (1.0 - (7.5f64 / 12.5).powi(2))).ln();
        assert!((long(-5e-3) / expected - 1.0).abs() < 1e-14);
    }
}
