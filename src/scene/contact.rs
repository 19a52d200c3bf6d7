//! How contacts yield: law, damping, edges of defects, and the oil between.

use serde::{Deserialize, Serialize};

/// How forces in the contacts are computed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Contact {
    /// Law of the contacts near defects.
    pub law: ContactLaw,
    /// Contact damping.
    pub damping: Damping,
    /// Damping of a ball's motion across the groove χ_a (s/m), when it overrides the usual one.
    pub across_damping: Option<f64>,
    /// Largest force on an element near the defect that laws `map` and `love` are prepared for (N); `None` to take it
    /// from the loads.
    pub largest_force: Option<f64>,
    /// Cells of the contact grid of laws `map` and `love` along and across Hertz's ellipse at the largest force; `None`
    /// for the usual ones.
    pub cells: Option<[u32; 2]>,
    /// Largest error of the contact map, relative to the largest force; `None` for the usual one.
    pub map_accuracy: Option<f64>,
    /// Whether the contact map is that of a spall's flanks on a short floor, which serves spalls of any length above.
    pub flank_map: bool,
    /// What laws `map` and `love` take a sharp edge to be.
    pub edge: ContactEdge,
}

impl Contact {
    /// χ_a (s/m) where nothing says otherwise: a value of the method, not of any friction. Creep would damp the motion
    /// across the groove at once, at a rate that no explicit step likes; with this one it is about critically damped.
    pub const ACROSS_DAMPING: f64 = 0.5;

    /// Damping of a ball's motion across the groove χ_a (s/m): the scene's, or as strong as the damping along the
    /// normal by Hunt and Crossley.
    pub fn damping_across(&self) -> f64 {
        self.across_damping.unwrap_or(match self.damping {
            Damping::HuntCrossley(chi) => chi,
            Damping::Proportional(_) => Self::ACROSS_DAMPING,
        })
    }
}

/// What a sharp edge of a defect is taken to be.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ContactEdge {
    /// As stiff as the middle of a raceway.
    #[default]
    HalfSpace,
    /// As soft as a step of its depth.
    Step,
}

/// Law of the contacts near defects. On smooth raceways all three are Hertz's.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ContactLaw {
    /// The earlier model: Hertz against the rigid path of the element's centre.
    Hertz,
    /// Love's half-space through a potential computed beforehand.
    Map,
    /// Love's half-space solved on a grid inside the step.
    Love,
}

impl ContactLaw {
    /// All laws. The variable `contact.law` numbers them from 1 in this order.
    pub const ALL: [Self; 3] = [Self::Hertz, Self::Map, Self::Love];

    /// Its number in the variable `contact.law`.
    pub fn number(self) -> i32 {
        Self::ALL.iter().take_while(|&&law| law != self).count() as i32 + 1
    }

    /// The law of a number, if it is one's.
    pub fn numbered(number: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|law| law.number() == number)
    }

    /// Its name in a scene file, and what it is.
    pub const fn described(self) -> (&'static str, &'static str) {
        match self {
            Self::Hertz => ("hertz", "Hertz on the rigid path of the element's centre"),
            Self::Map => ("map", "Love's half-space through a potential computed beforehand"),
            Self::Love => ("love", "Love's half-space solved on a grid inside the step"),
        }
    }
}

/// Contact damping; never pulls.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Damping {
    /// Q = Q_e · max(0, 1 + χ δ̇), with the elastic force Q_e(δ), of a ball Kδ^1.5, and χ (s/m).
    HuntCrossley(f64),
    /// Q = max(0, Q_e + τ Q_e′ δ̇), with τ (s).
    Proportional(f64),
}

/// Oil in the contacts.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Film {
    /// Viscosity at the pressure of the surroundings (Pa s).
    pub viscosity: f64,
    /// How the viscosity's logarithm grows with pressure (1/Pa).
    pub pressure_viscosity: f64,
    /// Height up to which oil fills gaps (m); `None` for all of them.
    pub layer: Option<f64>,
}
