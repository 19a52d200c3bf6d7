//! Stiffness of an elliptical Hertz contact: Q = K δ^1.5 for two paraboloids on elastic half-spaces.
//!
//! With relative curvatures 2A ≤ 2B, semi-axes a ≥ b, e² = 1 − (b/a)² and complete elliptic integrals K(e), E(e)
//! (Johnson, *Contact Mechanics*, 1985, eqs. 4.25–4.28):
//! ```text
//! B/A = [(a/b)² E(e) − K(e)] / [K(e) − E(e)]
//! a³  = 3Q [K(e) − E(e)] / (2π E* e² A)
//! δ   = 3Q K(e) / (2π E* a)
//! ```
//! No approximation of the integrals is used. Valid while the contact is small against the radii: at an element force
//! of 1500 N true circles are already 2.4 % softer than their paraboloids.

use super::curvature::relative_curvature;
use crate::numerics::elementary::elliptic;
use crate::scene::Bearing;

/// Hertz constants of one element's contacts with the two smooth raceways (N/m^1.5).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzConstants {
    /// Element on inner raceway.
    pub inner: f64,
    /// Element on outer raceway.
    pub outer: f64,
}

impl HertzConstants {
    /// Those of a bearing, an override in the scene going first. They are taken once, at the free contact angle of an
    /// angular contact bearing: constants that followed the angle would differ by a part in a hundred over 40 degrees,
    /// and leave the contacts without a potential.
    pub fn of(bearing: &Bearing) -> Self {
        let r = bearing.element_radius();
        let modulus = effective_modulus(bearing);
        let constant = |raceway: f64, conformity: f64| {
            let across = relative_curvature(r, -(conformity * bearing.element_diameter));
            point_contact(relative_curvature(r, raceway), across, modulus)
        };
        let [inner, outer] = rolling_radii(bearing);
        let inner = || constant(inner, bearing.conformity_inner);
        let outer = || constant(-outer, bearing.conformity_outer);
        Self { inner: bearing.hertz_inner.unwrap_or_else(inner), outer: bearing.hertz_outer.unwrap_or_else(outer) }
    }

    /// Constant of both contacts in series: Q = K (δ_i + δ_o)^1.5.
    pub fn in_series(&self) -> f64 {
        let compliance = |k: f64| 1.0 / libm::cbrt(k * k);
        let total: f64 = compliance(self.inner) + compliance(self.outer);
        1.0 / (total * total.sqrt())
    }
}

/// Radii (m) of the inner and the outer raceway along rolling: at the groove's bottom, or at the free contact angle of
/// an angular contact bearing, (½ D_pw ∓ r cos α°)/cos α°, the γ terms of ISO/TS 16281.
pub fn rolling_radii(bearing: &Bearing) -> [f64; 2] {
    let Some(angle) = bearing.contact_angle else {
        return [bearing.inner_raceway_radius(), bearing.outer_raceway_radius()];
    };
    let middle = 0.5 * bearing.pitch_diameter / libm::cos(angle);
    [middle - bearing.element_radius(), middle + bearing.element_radius()]
}

/// E* of an element and a ring (Pa): 1/E* = (1−ν₁²)/E₁ + (1−ν₂²)/E₂.
pub fn effective_modulus(bearing: &Bearing) -> f64 {
    plane_moduli(bearing)[0] * share_of_ring(bearing)
}

/// Share of the ring in what both bodies yield, E*(1−ν²)/E: exactly a half of equal materials, less where elements are
/// softer.
pub fn share_of_ring(bearing: &Bearing) -> f64 {
    let [ring, element] = plane_moduli(bearing);
    1.0 / (1.0 + ring / element)
}

/// E/(1−ν²) of ring and element (Pa).
fn plane_moduli(bearing: &Bearing) -> [f64; 2] {
    let of = |modulus: f64, ratio: f64| modulus / (1.0 - ratio * ratio);
    let (modulus, ratio) = (bearing.youngs_modulus, bearing.poissons_ratio);
    [
        of(modulus, ratio),
        of(bearing.element_youngs_modulus.unwrap_or(modulus), bearing.element_poissons_ratio.unwrap_or(ratio)),
    ]
}

/// K of Q = K δ^1.5 for two positive relative principal curvatures (1/m) and E* (Pa).
pub fn point_contact(curvature_1: f64, curvature_2: f64, effective_modulus: f64) -> f64 {
    let two_a = curvature_1.min(curvature_2);
    let m = squared_eccentricity(curvature_1.max(curvature_2) / two_a);
    let (k, e) = elliptic::complete(m);
    // K(e) − E(e) → π e²/4 for the circular contact, where the quotient below is 0/0.
    let difference_over_m = if m < 1e-8 { 0.25 * std::f64::consts::PI * (1.0 + 0.375 * m) } else { (k - e) / m };
    let c = 1.5 / (std::f64::consts::PI * effective_modulus);
    1.0 / (k * k.sqrt() * c) * (difference_over_m / (0.5 * two_a)).sqrt()
}

/// δ (m) of Q = K δ^1.5 under a force (N), for K (N/m^1.5).
pub fn approach_under(force: f64, constant: f64) -> f64 {
    let ratio = force / constant;
    libm::cbrt(ratio * ratio)
}

/// e² of the contact ellipse whose curvature ratio B/A ≥ 1 is given, by bisection on ln(b/a): the ratio is monotonic.
pub(crate) fn squared_eccentricity(ratio: f64) -> f64 {
    let ratio_at = |flatness: f64| {
        // flatness = (b/a)²
        let m = 1.0 - flatness;
        let (k, e) = elliptic::complete(m);
        if m < 1e-8 { 1.0 + 1.5 * m } else { (e / flatness - k) / (k - e) }
    };
    // b/a behaves as (A/B)^0.6 or so; (A/B)² is far below it, 1 is above.
    let (mut low, mut high) = (1.0 / (ratio * ratio * ratio * ratio), 1.0);
    for _ in 0..200 {
        let middle = (low * high).sqrt();
        if middle <= low || middle >= high {
            break;
        }
        if ratio_at(middle) > ratio { low = middle } else { high = middle }
    }
    1.0 - (low * high).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_on_a_plane_has_the_closed_form() {
        // Q = 4/3 E* √R δ^1.5; rounding only.
        let (radius, modulus): (f64, f64) = (0.004, 1.1e11);
        let expected = 4.0 / 3.0 * modulus * radius.sqrt();
        let found = point_contact(1.0 / radius, 1.0 / radius, modulus);
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} against {expected}");
    }

    #[test]
    fn constants_at_a_free_contact_angle_are_those_of_the_curvatures_there() {
        let mut bearing =
            Bearing { conformity_inner: 0.515, conformity_outer: 0.525, ..Bearing::steel_balls(12, 7.938e-3, 38.5e-3) };
        for (degrees, inner, outer) in [
            (0.0, 2.816_288e10, 2.501_867e10),
            (15.0, 2.819_530e10, 2.499_670e10),
            (-25.0, 2.825_153e10, 2.495_806e10),
            (40.0, 2.838_144e10, 2.486_605e10),
        ] {
            bearing.set_contact_angle(f64::to_radians(degrees));
            let found = HertzConstants::of(&bearing);
            // Seven digits are given.
            assert!((found.inner / inner - 1.0).abs() < 3e-7, "{degrees}: {found:?}");
            assert!((found.outer / outer - 1.0).abs() < 3e-7, "{degrees}: {found:?}");
        }
    }

    #[test]
    fn nearly_equal_curvatures_join_the_circular_contact_smoothly() {
        let at = |ratio: f64| point_contact(250.0, 250.0 * ratio, 1e11);
        // K varies as √(curvature) to first order; the second difference of three near points is rounding.
        for step in [1e-7, 1e-5, 1e-3] {
            let second = at(1.0 + step) - 2.0 * at(1.0) + at(1.0 / (1.0 + step));
            assert!(second.abs() < 2.0 * step * step * at(1.0) + 1e-8 * at(1.0), "{step}: {second}");
        }
    }

    #[test]
    fn a_flat_ellipse_satisfies_the_curvature_equation() {
        for ratio in [1.5, 10.0, 30.0, 1000.0] {
            let m = squared_eccentricity(ratio);
            let (k, e) = elliptic::complete(m);
            assert!(((e / (1.0 - m) - k) / (k - e) / ratio - 1.0).abs() < 1e-10, "{ratio}");
        }
    }
}
