//! In how many directions the rings move, and the geometry of grooves that counts with more than two: where balls touch
//! once a ring moves along the axis.
//!
//! The centres of the groove radii r_g = f D lie on circles; with l = r_g − D/2 of each ring their distance in the
//! meridian plane is A = l_i + l_o where a ball touches both raceways without force. At the free contact angle α°
//! ```text
//! G = A (1 − cos α°) = 2 A sin²(α°/2),   total axial play s_a = 2 A sin α°
//! ```
//! with the radial clearance G, half of a catalogue's internal clearance.

use super::Bearing;
use serde::{Deserialize, Serialize};

/// In how many directions a ring moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize)]
pub enum DegreesOfFreedom {
    /// Along x and y.
    #[default]
    Two,
    /// And along the bearing's axis, z.
    Three,
    /// And it tilts about x and y.
    Five,
}

impl DegreesOfFreedom {
    /// All there are.
    pub const ALL: [Self; 3] = [Self::Two, Self::Three, Self::Five];

    /// How many they are.
    pub const fn count(self) -> usize {
        match self {
            Self::Two => 2,
            Self::Three => 3,
            Self::Five => 5,
        }
    }

    /// Those of a number, if it is one's.
    pub fn counted(count: i64) -> Option<Self> {
        Self::ALL.into_iter().find(|freedom| i64::try_from(freedom.count()) == Ok(count))
    }
}

/// Who holds the couple that turns the spin axis of a ball with the cage, in balance only.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Gyroscopic {
    /// Nobody: there is no friction.
    #[default]
    None,
    /// The outer contact, Jones's outer raceway control.
    Outer,
    /// Both contacts, half each.
    Shared,
}

impl Bearing {
    /// Distances l_i and l_o (m) of the centres of the groove radii from the centre of a ball that just touches.
    pub fn groove_offsets(&self) -> [f64; 2] {
        [self.conformity_inner, self.conformity_outer].map(|conformity| (conformity - 0.5) * self.element_diameter)
    }

    /// Distance A (m) of both grooves' centres of curvature where a ball just touches both.
    pub fn groove_distance(&self) -> f64 {
        let [inner, outer] = self.groove_offsets();
        inner + outer
    }

    /// Radii r_gi and r_go (m) of the grooves.
    pub fn groove_radii(&self) -> [f64; 2] {
        [self.conformity_inner, self.conformity_outer].map(|conformity| conformity * self.element_diameter)
    }

    /// Free contact angle α° (rad): the given one with its sign, or that to which the clearance lets a ring move along
    /// the axis; 0 where elements are squeezed.
    pub fn free_contact_angle(&self) -> f64 {
        self.contact_angle.unwrap_or_else(|| {
            let share = 0.5 * self.radial_clearance.max(0.0) / self.groove_distance();
            2.0 * libm::asin(share.sqrt().min(1.0))
        })
    }

    /// Radial clearance (m) that belongs to a free contact angle (rad).
    pub fn clearance_at(&self, contact_angle: f64) -> f64 {
        let half = libm::sin(0.5 * contact_angle);
        2.0 * self.groove_distance() * (half * half)
    }

    /// Gives the bearing a free contact angle (rad), positive where it takes pushes of the inner ring towards +z, and
    /// the clearance that belongs to it.
    pub fn set_contact_angle(&mut self, contact_angle: f64) {
        self.radial_clearance = self.clearance_at(contact_angle);
        self.contact_angle = Some(contact_angle);
    }

    /// Axial places ζ_i and ζ_o (m) of the circles of the grooves' centres in their rings: 0 of a bearing that is
    /// symmetric, else such that it is just closed where its rings are not displaced.
    pub fn groove_shifts(&self) -> [f64; 2] {
        let [inner, outer] = self.groove_offsets();
        let sine = self.contact_angle.map_or(0.0, libm::sin);
        [inner * sine, -(outer * sine)]
    }

    /// Contact angle (rad, not negative) for which cage, elements and tracks are worked out, as far as the scene says:
    /// the operating angle, else the free contact angle where one is given. What is left open follows from the start's
    /// equilibrium.
    pub fn given_operating_angle(&self) -> Option<f64> {
        self.operating_angle.or(self.contact_angle).map(f64::abs)
    }

    /// Sense in which the inner ring is pushed by a preload: −1 of a negative contact angle, else 1.
    pub fn axial_sense(&self) -> f64 {
        if self.contact_angle.is_some_and(|angle| angle < 0.0) { -1.0 } else { 1.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clearance_and_free_contact_angle_of_a_6205_belong_together() {
        let mut bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
        // Two conformities of 0.52, of which a half is taken: rounding.
        assert!((bearing.groove_distance() / 0.3176e-3 - 1.0).abs() < 1e-13);
        for (clearance, degrees) in [(5e-6, 10.18), (10e-6, 14.42)] {
            bearing.radial_clearance = clearance;
            let angle = bearing.free_contact_angle();
            // Two digits are given.
            assert!((angle.to_degrees() - degrees).abs() < 5e-3, "{}", angle.to_degrees());
            assert!((bearing.clearance_at(angle) / clearance - 1.0).abs() < 1e-14);
        }
        bearing.radial_clearance = -2e-6;
        assert_eq!((bearing.free_contact_angle(), bearing.groove_shifts()), (0.0, [0.0, 0.0]));
    }

    #[test]
    fn an_angular_contact_bearing_has_the_clearance_and_the_groove_centres_of_its_angle() {
        let mut bearing =
            Bearing { conformity_inner: 0.515, conformity_outer: 0.525, ..Bearing::steel_balls(12, 7.938e-3, 38.5e-3) };
        bearing.set_contact_angle(25f64.to_radians());
        let found = [bearing.radial_clearance, bearing.groove_shifts()[0], bearing.groove_shifts()[1]];
        for (found, expected) in found.into_iter().zip([29.749_151_46e-6, 50.321_156_4e-6, -83.868_594_0e-6]) {
            // Nine digits are given.
            assert!((found / expected - 1.0).abs() < 2e-9, "{found} {expected}");
        }
        assert_eq!((bearing.axial_sense(), bearing.given_operating_angle()), (1.0, Some(25f64.to_radians())));
        bearing.set_contact_angle(-25f64.to_radians());
        assert_eq!((bearing.axial_sense(), bearing.given_operating_angle()), (-1.0, Some(25f64.to_radians())));
        assert_eq!(bearing.radial_clearance, found[0]);
    }
}
