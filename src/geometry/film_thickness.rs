//! The oil film of an element on a raceway: its thickness where they are pressed together, and what it takes to press
//! it out of a gap.
//!
//! With R_x and R_y the equivalent radii along and across the rolling direction, E′ = 2E* = E/(1−ν²), η₀ the viscosity,
//! α its coefficient of pressure and ū the speed with which both surfaces pass through the contact, the film in the
//! middle of an elliptical contact under the force Q is (Hamrock and Dowson 1977)
//! ```text
//! h_c/R_x = 2.69 U^0.67 G^0.53 W^−0.067 (1 − 0.61 e^(−0.73 k))
//! U = η₀ū/(E′R_x),   G = αE′,   W = Q/(E′R_x²),   k = 1.03 (R_y/R_x)^0.64
//! ```
//! Pure rolling, enough oil, the temperature of the surroundings. At ū = 0 there is no film.
//!
//! Between two paraboloids that approach each other, p = 6η|ε̇|/[(1/R_x + 1/R_y) h²] solves Reynolds' equation. Its sum
//! over all the gap that is filled with oil is
//! ```text
//! F = c |ε̇|/ε,   c = 12πη (R_x R_y)^(3/2)/(R_x + R_y)
//! ```
//! 6πηR² for a sphere. Viscosity is that without pressure: the gap is open and the surfaces are rigid there.

use super::{curvature::relative_curvature, hertz_constant::effective_modulus};
use crate::scene::{Bearing, Film};
use std::f64::consts::PI;

/// Exponent of the speed in Hamrock and Dowson's formula.
pub const SPEED_EXPONENT: f64 = 0.67;

/// Smallest W. Where no load is known, as of rings that a host moves, it is this; ten times the load make the film a
/// seventh thinner.
const SMALLEST_LOAD: f64 = 1e-5;

/// The film of one raceway's contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LubricatedContact {
    /// c: what a closing gap (m) resists with, times its rate and over its height (N s).
    pub squeeze: f64,
    /// h_c per ū^0.67 (m/(m/s)^0.67).
    thickness: f64,
}

impl LubricatedContact {
    /// Of equivalent radii along and across the rolling direction (m) under the force (N) of the most loaded contact.
    pub fn new([along, across]: [f64; 2], effective_modulus: f64, film: &Film, force: f64) -> Self {
        let modulus = 2.0 * effective_modulus;
        let ellipticity = 1.03 * libm::pow(across / along, 0.64);
        let speed = libm::pow(film.viscosity / (modulus * along), SPEED_EXPONENT);
        let material = libm::pow(film.pressure_viscosity * modulus, 0.53);
        let load = libm::pow((force / (modulus * along * along)).max(SMALLEST_LOAD), -0.067);
        let shape = 1.0 - 0.61 * libm::exp(-0.73 * ellipticity);
        let product = along * across;
        Self {
            squeeze: 12.0 * PI * film.viscosity * product * product.sqrt() / (along + across),
            thickness: 2.69 * along * speed * material * load * shape,
        }
    }

    /// Those of a bearing's inner and outer raceway under the force (N) of the most loaded contact.
    pub fn of(bearing: &Bearing, film: &Film, force: f64) -> [Self; 2] {
        let r = bearing.element_radius();
        let grooves = bearing.groove_radii();
        let inner = [bearing.inner_raceway_radius(), -grooves[0]];
        let outer = [-bearing.outer_raceway_radius(), -grooves[1]];
        [inner, outer].map(|raceway| {
            let equivalent = raceway.map(|radius| 1.0 / relative_curvature(r, radius));
            Self::new(equivalent, effective_modulus(bearing), film, force)
        })
    }

    /// h_c (m) at the speed ū of which this is the [`speed_factor`].
    #[inline]
    pub fn thickness(&self, factor: f64) -> f64 {
        self.thickness * factor
    }
}

/// ū^0.67 of a speed ū (m/s).
#[inline]
pub fn speed_factor(speed: f64) -> f64 {
    if speed == 0.0 { 0.0 } else { libm::pow(speed, SPEED_EXPONENT) }
}

/// ū (m/s) of both raceways per speed of one ring against the other (rad/s): D_pw (1−γ²)/4.
pub fn rolling_speed_ratio(bearing: &Bearing) -> f64 {
    let gamma = bearing.element_diameter / bearing.pitch_diameter;
    0.25 * bearing.pitch_diameter * (1.0 - gamma * gamma)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    const OIL: Film = Film { viscosity: 0.04, pressure_viscosity: 2e-8, layer: None };

    #[test]
    fn a_sphere_is_pressed_towards_a_plane_as_stokes_lubrication_says() {
        let radius = 0.004;
        let found = LubricatedContact::new([radius, radius], 1.1e11, &OIL, 100.0).squeeze;
        // Rounding.
        assert!((found / (6.0 * PI * 0.04 * radius * radius) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn film_and_squeeze_of_a_known_contact_have_their_figures() {
        let mut bearing = Bearing::steel_balls(9, 7.94e-3, 39.32e-3);
        bearing.conformity_outer = 8.19 / (2.0 * 7.94);
        bearing.conformity_inner = bearing.conformity_outer;
        let [inner, outer] = LubricatedContact::of(&bearing, &OIL, 278.0);
        let speed = rolling_speed_ratio(&bearing) * TAU * 10.0;
        // Worked out by hand from the formulas above, to the digits given.
        assert!((speed - 0.59245).abs() < 1e-5, "{speed}");
        let factor = speed_factor(speed);
        assert!((outer.squeeze / 1.73e-4 - 1.0).abs() < 3e-3, "{}", outer.squeeze);
        assert!((outer.thickness(factor) / 0.155e-6 - 1.0).abs() < 4e-3, "{}", outer.thickness(factor));
        assert!(inner.squeeze < outer.squeeze && inner.thickness(factor) < outer.thickness(factor));
        assert_eq!(outer.thickness(speed_factor(0.0)), 0.0);
    }
}
