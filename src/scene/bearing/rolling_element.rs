//! What rolls between the rings: balls or cylindrical rollers.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;
use std::sync::Arc;

/// Kind of the rolling elements.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub enum RollingElement {
    /// Balls in grooves: point contacts.
    #[default]
    Ball,
    /// Cylindrical rollers on straight raceways: line contacts.
    CylindricalRoller(Roller),
}

/// Whether an element's mass resists its radial acceleration.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ElementInertia {
    /// It does: an element vibrates between its raceways.
    #[default]
    Full,
    /// It does not: an element is in radial balance at every instant.
    None,
}

/// A cylindrical roller.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Roller {
    /// Effective length L_we (m): that of the contact, without chamfers.
    pub length: f64,
    /// How its ends are relieved.
    pub profile: RollerProfile,
    /// Laminae into which the lamina law cuts it.
    pub laminae: u32,
}

/// How a roller's ends are relieved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum RollerProfile {
    /// Not at all.
    Straight,
    /// By the logarithmic crown of ISO/TS 16281.
    Logarithmic,
    /// As measured.
    Measured(Crown),
}

/// A measured crown.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Crown {
    /// Name of its file beside the scene file.
    pub name: String,
    /// Distance from the roller's middle, ascending, and depth (m); none before the file has been read, and none in a
    /// model file, beside which the file lies.
    #[serde(skip)]
    pub points: Arc<[[f64; 2]]>,
}

impl Crown {
    /// Whether its file has been read.
    pub fn is_read(&self) -> bool {
        !self.points.is_empty()
    }

    /// Depth (m) at `x` (m) from the roller's middle; beyond the points that of the last.
    pub fn depth(&self, x: f64) -> f64 {
        let next = self.points.partition_point(|point| point[0] <= x);
        match (next.checked_sub(1).and_then(|k| self.points.get(k)), self.points.get(next)) {
            (Some([from, left]), Some([to, right])) => left + (right - left) * ((x - from) / (to - from)),
            (Some([_, depth]), None) | (None, Some([_, depth])) => *depth,
            (None, None) => 0.0,
        }
    }
}

impl Roller {
    /// Laminae where nothing else is said, as the standard's examples have them or more.
    pub const LAMINAE: u32 = 40;
}

impl RollingElement {
    /// Volume (m³) of a solid element of this diameter (m); a roller's with its effective length.
    pub fn volume(&self, diameter: f64) -> f64 {
        match self {
            Self::Ball => PI / 6.0 * diameter * diameter * diameter,
            Self::CylindricalRoller(roller) => PI / 4.0 * diameter * diameter * roller.length,
        }
    }
}
