//! An element on one raceway: radii, curvatures, and the gap between the two bodies.
//!
//! Of a ball the gap across the raceway is that of two circles, its own and the groove's. Of a roller it is the crown's
//! depth, and the contact ends where the roller does: the raceway goes on beyond, which a half-space has right, and the
//! roller's free end is as stiff here as if it went on, too. Pressures at the ends of a straight roller grow without
//! bound as a grid is refined; forces do not.

use super::error::ContactError;
use super::rolling::RacewaySide;
use crate::geometry::curvature::relative_curvature;
use crate::geometry::hertz_constant::squared_eccentricity;
use crate::geometry::line_contact::{LINE_ORDER, half_width_under, logarithmic_depth};
use crate::numerics::elementary::elliptic;
use crate::scene::{Bearing, RollerProfile};

/// Radii of an element and of the raceway it runs on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElementOnRaceway {
    /// Radius of the element r (m).
    pub element_radius: f64,
    /// Radius of the raceway at the groove's bottom, R_o or R_i (m).
    pub raceway_radius: f64,
    /// What the contact is across the raceway.
    pub across: Across,
    /// Which raceway: the outer one is concave, the inner one convex.
    pub raceway: RacewaySide,
}

/// What a contact is across the raceway.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Across {
    /// A ball in a groove of this radius r_g (m).
    Groove(f64),
    /// A roller on a straight raceway.
    Roller {
        /// Its effective length (m).
        length: f64,
        /// Whether it has the logarithmic crown.
        crowned: bool,
    },
}

impl ElementOnRaceway {
    /// Element and one raceway of a bearing.
    pub fn of(bearing: &Bearing, raceway: RacewaySide) -> Self {
        Self {
            element_radius: bearing.element_radius(),
            raceway_radius: raceway.radius(bearing),
            across: match bearing.roller() {
                None => Across::Groove(bearing.groove_radii()[raceway as usize]),
                Some(roller) => {
                    Across::Roller { length: roller.length, crowned: roller.profile == RollerProfile::Logarithmic }
                }
            },
            raceway,
        }
    }

    /// The same at a contact angle α (rad): along the raceway it has the curvature cos α/R_c of the track, a circle of
    /// radius R_c about the ring's axis (Meusnier).
    pub fn at_angle(bearing: &Bearing, raceway: RacewaySide, angle: f64) -> Self {
        let raceway_radius = raceway.track_radius(bearing, angle) / libm::cos(angle);
        Self { raceway_radius, ..Self::of(bearing, raceway) }
    }

    /// Checks the radii.
    ///
    /// # Errors
    /// When a groove or an outer raceway is not wider than the element, a roller has no length, or a number is not
    /// finite.
    pub fn checked(self) -> Result<Self, ContactError> {
        let r = self.element_radius;
        let (least, limit) = match self.raceway {
            RacewaySide::Inner => (0.0, "positive"),
            RacewaySide::Outer => (r, "larger than the element's radius"),
        };
        let across = match self.across {
            Across::Groove(radius) => ("groove radius", radius, r, "larger than the element's radius"),
            Across::Roller { length, .. } => ("roller length", length, 0.0, "positive"),
        };
        let checks =
            [("element radius", r, 0.0, "positive"), ("raceway radius", self.raceway_radius, least, limit), across];
        for (quantity, value, above, limit) in checks {
            if !(value > above && value.is_finite()) {
                return Err(ContactError::BadInput { quantity, value, unit: "m", limit: limit.to_owned() });
            }
        }
        Ok(self)
    }

    /// Curvatures of the gap along and across the raceway (1/m).
    pub fn curvatures(&self) -> [f64; 2] {
        let raceway = match self.raceway {
            RacewaySide::Inner => self.raceway_radius,
            RacewaySide::Outer => -self.raceway_radius,
        };
        let across = match self.across {
            Across::Groove(radius) => relative_curvature(self.element_radius, -radius),
            Across::Roller { .. } => 0.0,
        };
        [relative_curvature(self.element_radius, raceway), across]
    }

    /// Half-axes of the contact along and across the raceway (m) at the approach δ (m). Of a ball those of Hertz's
    /// ellipse: with A ≤ B half the curvatures, a² = δ (K − E)/(A e² K) and b = a √(1 − e²). Of a roller half the width
    /// of the line and half its length.
    pub fn contact_half_axes(&self, approach: f64) -> [f64; 2] {
        let [along, across] = self.curvatures();
        if let Across::Roller { length, .. } = self.across {
            return [half_width_under(approach, length, along), 0.5 * length];
        }
        let (low, high) = (along.min(across), along.max(across));
        let m = squared_eccentricity(high / low);
        let (k, e) = elliptic::complete(m);
        let quotient = if m < 1e-8 { 0.5 } else { (k - e) / (m * k) };
        let major = (approach * quotient / (0.5 * low)).sqrt();
        let minor = major * (1.0 - m).sqrt();
        if along < across { [major, minor] } else { [minor, major] }
    }

    /// Gap (m) for zero approach on the smooth raceway, x along and y across (m) from where the two bodies touch.
    pub fn gap(&self, x: f64, y: f64) -> f64 {
        self.along(x)[0] + self.across(y)
    }

    /// Part of the gap along the raceway with its slope, at distance t (m) from the element.
    #[inline]
    pub(super) fn along(&self, t: f64) -> [f64; 2] {
        let (element, raceway) = (circle(self.element_radius, t), circle(self.raceway_radius, t));
        match self.raceway {
            RacewaySide::Inner => [element[0] + raceway[0], element[1] + raceway[1]],
            RacewaySide::Outer => [element[0] - raceway[0], element[1] - raceway[1]],
        }
    }

    /// Second derivative (1/m) of the part along the raceway, at distance t (m) from the element.
    pub(super) fn along_second(&self, t: f64) -> f64 {
        let (element, raceway) = (circle_second(self.element_radius, t), circle_second(self.raceway_radius, t));
        match self.raceway {
            RacewaySide::Inner => element + raceway,
            RacewaySide::Outer => element - raceway,
        }
    }

    /// Part of the gap across the raceway, at distance t (m) from the element's middle; without end beyond a ball.
    pub(super) fn across(&self, t: f64) -> f64 {
        match self.across {
            Across::Groove(_) if t.abs() >= self.element_radius => f64::INFINITY,
            Across::Groove(radius) => circle(self.element_radius, t)[0] - circle(radius, t)[0],
            Across::Roller { crowned: false, .. } => 0.0,
            Across::Roller { length, crowned: true } => logarithmic_depth(2.0 * self.element_radius, length, t),
        }
    }

    /// Its first and second derivative (–, 1/m) in a groove.
    pub(super) fn across_derivatives(&self, t: f64) -> [f64; 2] {
        let Across::Groove(radius) = self.across else { return [0.0; 2] };
        let of = |of: f64| [circle(of, t)[1], circle_second(of, t)];
        let ([slope, second], [groove, groove_second]) = (of(self.element_radius), of(radius));
        [slope - groove, second - groove_second]
    }

    /// Length (m) on which the contact ends by itself; `None` of a ball.
    pub(super) fn length(&self) -> Option<f64> {
        match self.across {
            Across::Groove(_) => None,
            Across::Roller { length, .. } => Some(length),
        }
    }

    /// Power n by which the force grows with the approach, about: 3/2 of a ball, 10/9 of a roller.
    pub(super) fn order(&self) -> f64 {
        if self.length().is_some() { LINE_ORDER } else { 1.5 }
    }
}

/// R − √(R² − t²) without cancellation, and its slope.
#[inline]
fn circle(radius: f64, t: f64) -> [f64; 2] {
    let root = (radius * radius - t * t).sqrt();
    [t * t / (radius + root), t / root]
}

/// Its second derivative.
fn circle_second(radius: f64, t: f64) -> f64 {
    let square = radius * radius - t * t;
    radius * radius / (square * square.sqrt())
}
