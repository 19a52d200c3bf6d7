//! An element on one raceway: radii, curvatures, and the gap between the two circles.

// `!(a > b)` is true for NaN as well, and is meant to be.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

use super::{error::ContactError, rolling::RacewaySide};
use crate::geometry::hertz_constant::squared_eccentricity;
use crate::numerics::elliptic;
use crate::scene::Bearing;

/// Radii of an element and of the raceway it runs on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElementOnRaceway {
    /// Radius of the element r [m].
    pub element_radius: f64,
    /// Radius of the raceway at the groove's bottom, R_o or R_i [m].
    pub raceway_radius: f64,
    /// Radius of the groove r_g [m].
    pub groove_radius: f64,
    /// Which raceway: the outer one is concave, the inner one convex.
    pub raceway: RacewaySide,
}

impl ElementOnRaceway {
    /// Element and one raceway of a bearing.
    pub fn of(bearing: &Bearing, raceway: RacewaySide) -> Self {
        let conformity = match raceway {
            RacewaySide::Inner => bearing.conformity_inner,
            RacewaySide::Outer => bearing.conformity_outer,
        };
        Self {
            element_radius: bearing.element_radius(),
            raceway_radius: raceway.radius(bearing),
            groove_radius: conformity * bearing.element_diameter,
            raceway,
        }
    }

    /// Checks the radii.
    ///
    /// # Errors
    /// When a groove or an outer raceway is not wider than the element or a number is not finite.
    pub fn checked(self) -> Result<Self, ContactError> {
        let r = self.element_radius;
        let (least, limit) = match self.raceway {
            RacewaySide::Inner => (0.0, "positive"),
            RacewaySide::Outer => (r, "larger than the element's radius"),
        };
        let checks = [
            ("element radius", r, 0.0, "positive"),
            ("raceway radius", self.raceway_radius, least, limit),
            ("groove radius", self.groove_radius, r, "larger than the element's radius"),
        ];
        for (quantity, value, above, limit) in checks {
            if !(value > above && value.is_finite()) {
                return Err(ContactError::BadInput { quantity, value, unit: "m", limit: limit.to_owned() });
            }
        }
        Ok(self)
    }

    /// Curvatures of the gap along and across the raceway [1/m].
    pub fn curvatures(&self) -> [f64; 2] {
        let r = 1.0 / self.element_radius;
        let along = match self.raceway {
            RacewaySide::Inner => r + 1.0 / self.raceway_radius,
            RacewaySide::Outer => r - 1.0 / self.raceway_radius,
        };
        [along, r - 1.0 / self.groove_radius]
    }

    /// Half-axes of Hertz's contact ellipse along and across the raceway [m] at the approach δ [m]: with A ≤ B half the
    /// curvatures, a² = δ (K − E)/(A e² K) and b = a √(1 − e²).
    pub fn contact_half_axes(&self, approach: f64) -> [f64; 2] {
        let [along, across] = self.curvatures();
        let (low, high) = (along.min(across), along.max(across));
        let m = squared_eccentricity(high / low);
        let (k, e) = elliptic::complete(m);
        let quotient = if m < 1e-8 { 0.5 } else { (k - e) / (m * k) };
        let major = (approach * quotient / (0.5 * low)).sqrt();
        let minor = major * (1.0 - m).sqrt();
        if along < across { [major, minor] } else { [minor, major] }
    }

    /// Part of the gap along the raceway with its slope, at distance t [m] from the element.
    #[inline]
    pub(super) fn along(&self, t: f64) -> [f64; 2] {
        let (element, raceway) = (circle(self.element_radius, t), circle(self.raceway_radius, t));
        match self.raceway {
            RacewaySide::Inner => [element[0] + raceway[0], element[1] + raceway[1]],
            RacewaySide::Outer => [element[0] - raceway[0], element[1] - raceway[1]],
        }
    }

    pub(super) fn across(&self, t: f64) -> f64 {
        circle(self.element_radius, t)[0] - circle(self.groove_radius, t)[0]
    }
}

/// R − √(R² − t²) without cancellation, and its slope.
#[inline]
fn circle(radius: f64, t: f64) -> [f64; 2] {
    let root = (radius * radius - t * t).sqrt();
    [t * t / (radius + root), t / root]
}
