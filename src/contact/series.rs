//! A Hertz contact in series with a linear compliance: how much of the approach is the contact's own.
//!
//! The raceway yields by cQ under a contact that carries Q, so an approach Δ of element and undeformed raceway is
//! ```text
//! Δ = δ + c K δ^1.5
//! ```
//! With δ = Δ/z² and β = c K √Δ this is the cubic z³ − z = β, which has one root z ≥ 1. Its left side is convex there, so
//! Newton's method converges from any z ≥ 1; from the starts below four steps reach rounding for every β.
//!
//! The share of a small change of Δ that the contact takes is s = dδ/dΔ = 1/(1 + c k) with its tangent stiffness
//! k = 1.5 K √δ: c k = 1.5 β/z.
//!
//! The compliance is local: a contact does not move its neighbours. A real ring bends between its elements as well, so c
//! is a measure of an assembly's softness and not a ring's flexibility.

/// The contact's part of an approach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// δ [m].
    pub approach: f64,
    /// s = dδ/dΔ, between 0 and 1.
    pub share: f64,
}

/// The part of the approach `total` ≥ 0 [m] that a contact of Hertz constant `stiffness` [N/m^1.5] takes in series with
/// `compliance` [m/N].
#[inline]
pub fn part(total: f64, stiffness: f64, compliance: f64) -> Part {
    let beta = compliance * stiffness * total.sqrt();
    let z = root(beta);
    Part { approach: total / (z * z), share: 1.0 / (1.0 + 1.5 * beta / z) }
}

/// The root z ≥ 1 of z³ − z = β for β ≥ 0.
#[inline]
fn root(beta: f64) -> f64 {
    // The first is exact to second order at 0, the second to second order at infinity; neither is off by more than 0.04.
    let mut z = if beta < 1.0 {
        1.0 + beta / (2.0 + 1.5 * beta)
    } else {
        let cube_root = libm::cbrt(beta);
        cube_root + 1.0 / (3.0 * cube_root)
    };
    for _ in 0..4 {
        let square = z * z;
        z = (2.0 * square * z + beta) / (3.0 * square - 1.0);
    }
    z
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// δ by bisection of the defining relation.
    fn bisected(total: f64, stiffness: f64, compliance: f64) -> f64 {
        let (mut low, mut high) = (0.0, total);
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return middle;
            }
            if middle + compliance * stiffness * middle * middle.sqrt() < total { low = middle } else { high = middle }
        }
    }

    proptest! {
        #[test]
        fn the_part_solves_the_series_relation(exponent in -12.0..-3.0f64, compliance in -12.0..-4.0f64) {
            let (total, compliance, stiffness) = (10f64.powf(exponent), 10f64.powf(compliance), 3e10);
            let found = part(total, stiffness, compliance).approach;
            let direct = bisected(total, stiffness, compliance);
            // A handful of roundings on either side.
            prop_assert!((found / direct - 1.0).abs() < 4e-15, "{found} against {direct}");
        }

        #[test]
        fn the_share_is_the_slope_of_the_part(exponent in -9.0..-3.0f64, compliance in -12.0..-5.0f64) {
            let (total, compliance, stiffness) = (10f64.powf(exponent), 10f64.powf(compliance), 3e10);
            let at = |total| part(total, stiffness, compliance).approach;
            let step = 1e-5 * total;
            let slope = (at(total + step) - at(total - step)) / (2.0 * step);
            // Truncation 1e-10, rounding 1e-15/1e-5.
            prop_assert!((part(total, stiffness, compliance).share / slope - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn four_steps_are_enough_at_every_softness() {
        for i in -300..=300 {
            let beta = 10f64.powf(f64::from(i) / 20.0);
            let z = root(beta);
            let residual = z * (z * z - 1.0) - beta;
            // The residual of a z that is right to one rounding: slope times z ε, twice.
            assert!(residual.abs() <= 2.0 * f64::EPSILON * z * (3.0 * z * z - 1.0), "β = {beta}: {residual}");
        }
    }
}
