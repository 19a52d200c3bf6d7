//! The bearing: its dimensions, its material and what rolls in it.

mod freedom;
mod rolling_element;

pub use freedom::{DegreesOfFreedom, Gyroscopic};
pub use rolling_element::{Crown, ElementInertia, Roller, RollerProfile, RollingElement};

use crate::numerics::counter_noise::centred_draw;
use serde::{Deserialize, Serialize};

/// Course of the random numbers from which diameters are drawn; those of the cage count from 0.
const DIAMETERS: u64 = u64::MAX;

/// Dimensions and material of the bearing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Bearing {
    /// What rolls.
    pub element: RollingElement,
    /// Number of rolling elements Z.
    pub element_count: usize,
    /// Rolling element diameter D_w (m).
    pub element_diameter: f64,
    /// Diameter of each element beyond that (m); none where elements are equal.
    pub diameter_offsets: Vec<f64>,
    /// How these were drawn; `None` of given ones and of equal elements.
    pub drawn_diameters: Option<DrawnDiameters>,
    /// Pitch diameter D_pw (m).
    pub pitch_diameter: f64,
    /// Groove conformity of the inner ring f_i = r_gi/D_w, above 0.5; infinite with rollers, whose raceways are
    /// straight.
    pub conformity_inner: f64,
    /// Groove conformity of the outer ring f_o = r_go/D_w, above 0.5; infinite with rollers.
    pub conformity_outer: f64,
    /// Radial internal clearance G_r (m); negative is a preload. With `contact_angle` that which belongs to it.
    pub radial_clearance: f64,
    /// In how many directions the rings move.
    pub degrees_of_freedom: DegreesOfFreedom,
    /// Free contact angle α° (rad), positive where the bearing takes pushes of the inner ring towards +z; `None` of a
    /// symmetric bearing. [`set_contact_angle`](Self::set_contact_angle) gives it with its clearance.
    pub contact_angle: Option<f64>,
    /// Contact angle (rad) for which the cage, the elements' spin and the tracks are worked out; `None` for the free
    /// one where it is given, else that of the start's equilibrium.
    pub operating_angle: Option<f64>,
    /// Height of the inner ring's shoulder above the groove's bottom (m), on the loaded side; `None` where nobody asks.
    pub shoulder_inner: Option<f64>,
    /// The same of the outer ring (m).
    pub shoulder_outer: Option<f64>,
    /// Who holds the balls' gyroscopic couple.
    pub gyroscopic: Gyroscopic,
    /// Young's modulus of the rings (Pa), and of the elements where they have none of their own.
    pub youngs_modulus: f64,
    /// Poisson's ratio of the rings, and of the elements where they have none of their own.
    pub poissons_ratio: f64,
    /// Young's modulus of elements of another material (Pa).
    pub element_youngs_modulus: Option<f64>,
    /// Poisson's ratio of elements of another material.
    pub element_poissons_ratio: Option<f64>,
    /// Density of the elements (kg/m³).
    pub density: f64,
    /// Mass of one element (kg), when it overrides the solid element's.
    pub element_mass: Option<f64>,
    /// Hertz constant of the inner contact (N/m^1.5), when it overrides the computed one.
    pub hertz_inner: Option<f64>,
    /// Hertz constant of the outer contact (N/m^1.5), when it overrides the computed one.
    pub hertz_outer: Option<f64>,
    /// Compliance in series with each outer contact (m/N): how far the outer raceway yields under an element, by the
    /// ring's and its seat's own deformation, for each newton that this element carries. 0 for a rigid assembly.
    pub outer_compliance: f64,
    /// Whether an element's mass resists its radial acceleration.
    pub element_inertia: ElementInertia,
}

/// How diameters of unequal elements are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct DrawnDiameters {
    /// Root mean square of what they are beyond the nominal one (m).
    pub rms: f64,
    /// Of the random numbers.
    pub seed: u64,
}

impl Bearing {
    /// Radius of an element (m).
    pub fn element_radius(&self) -> f64 {
        0.5 * self.element_diameter
    }

    /// Radius of the outer raceway at the groove's bottom, R_o = (D_pw + D_w + G_r)/2 (m).
    pub fn outer_raceway_radius(&self) -> f64 {
        (self.pitch_diameter + self.element_diameter + self.radial_clearance) / 2.0
    }

    /// Radius of the inner raceway at the groove's bottom, R_i = (D_pw − D_w − G_r)/2 (m).
    pub fn inner_raceway_radius(&self) -> f64 {
        (self.pitch_diameter - self.element_diameter - self.radial_clearance) / 2.0
    }

    /// Mass of one element (kg): the scene's, or a solid ball's or roller's.
    pub fn mass_of_element(&self) -> f64 {
        self.element_mass.unwrap_or_else(|| self.element.volume(self.element_diameter) * self.density)
    }

    /// This bearing with elements larger by so much (m), in raceways and grooves that stay what they are.
    pub fn with_elements_larger(&self, by: f64) -> Self {
        let (diameter, conformity) = (self.element_diameter + by, self.element_diameter / (self.element_diameter + by));
        let heavier = self.element.volume(diameter) / self.element.volume(self.element_diameter);
        Self {
            element_diameter: diameter,
            diameter_offsets: Vec::new(),
            drawn_diameters: None,
            conformity_inner: self.conformity_inner * conformity,
            conformity_outer: self.conformity_outer * conformity,
            radial_clearance: self.radial_clearance - by,
            element_mass: self.element_mass.map(|mass| mass * heavier),
            ..self.clone()
        }
    }

    /// Takes diameters beyond the nominal one that are drawn: of sum 0, none where their root mean square is 0.
    pub fn draw_diameters(&mut self, drawn: DrawnDiameters) {
        let unequal = drawn.rms != 0.0;
        let offsets = unequal.then(|| centred_draw(self.element_count, drawn.rms, drawn.seed, DIAMETERS));
        (self.diameter_offsets, self.drawn_diameters) = (offsets.unwrap_or_default(), unequal.then_some(drawn));
    }

    /// The roller; `None` of a ball bearing.
    pub fn roller(&self) -> Option<&Roller> {
        match &self.element {
            RollingElement::Ball => None,
            RollingElement::CylindricalRoller(roller) => Some(roller),
        }
    }
}
