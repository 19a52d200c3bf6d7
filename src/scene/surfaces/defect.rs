//! A defect: which body has it, where, and its shape.

use super::super::Bearing;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// A defect of one body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Defect {
    /// The body that has it.
    pub on: DefectOn,
    /// Angle of its centre (rad): on a ring counter-clockwise in the ring's own sense, from +x at the start unless the
    /// ring has another initial angle; on an element counter-clockwise from where it faces the outer raceway at the
    /// start.
    pub angle: f64,
    /// Its shape.
    pub shape: DefectShape,
}

/// The body that has a defect.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub enum DefectOn {
    /// The outer ring.
    #[default]
    Outer,
    /// The inner ring.
    Inner,
    /// A rolling element.
    Element {
        /// Which, from 0.
        element: usize,
        /// Latitude of a pit's centre off the rolling track (rad), 0 for one on it.
        tilt: f64,
    },
}

/// Shape of a defect.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum DefectShape {
    /// A trapezoid: flat floor, straight flanks, the full width of the raceway.
    Spall {
        /// Length along the raceway at its surface (m).
        length: f64,
        /// Depth of the floor (m).
        depth: f64,
        /// Steepness of the flanks (rad); π/2 for vertical edges.
        edge_slope: f64,
    },
    /// A measured surface.
    Profile(Measured),
}

/// A measured surface: its file, and what is done to the depths in it, in this order.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Measured {
    /// Its name, beside the scene file.
    pub file: String,
    /// Form that is taken off.
    pub form: Option<MeasuredForm>,
    /// What is put at depth 0.
    pub level: Option<MeasuredLevel>,
    /// Whether the file has heights, of which depths are the opposite.
    pub invert: bool,
}

/// Form of a body that its measured surface still has.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MeasuredForm {
    /// The circle through both ends of each trace, a tenth of its length each.
    Circle,
}

/// What of a measured surface is smooth raceway, at depth 0.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MeasuredLevel {
    /// Both ends of each trace, a tenth of its length each: the straight line through them.
    Ends,
}

impl<F: Into<String>> From<F> for Measured {
    /// The file as it is.
    fn from(file: F) -> Self {
        Self { file: file.into(), ..Self::default() }
    }
}

/// What a size of a defect must stay below.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DefectLimit {
    /// (m)
    pub size: f64,
    /// What that is.
    pub what: &'static str,
}

/// Length that the rolling track meets of the shortest spall, over element diameter: an element that bridges less sinks
/// by 1/8 of it squared over the radius, 2 nm at 8 µm, and a contact grid that shows it would have a hundred times as
/// many cells as usual. Assumed.
const SHORTEST: f64 = 1e-3;
/// Part of the way around its body beyond which a defect of the inner ring or of an element is not local.
const LONGEST: f64 = 0.9;
/// Part of an element's radius beyond which a hole in it leaves no half-space.
const DEEPEST: f64 = 0.2;
/// What must stay below a limit may come so near to it.
const BELOW: f64 = 1.0 - 1e-9;

impl Defect {
    /// A defect of the outer raceway whose centre is at `angle` (rad).
    pub fn outer(angle: f64, shape: DefectShape) -> Self {
        Self { on: DefectOn::Outer, angle, shape }
    }

    /// A defect of the inner raceway whose centre is at `angle` (rad) at the start.
    pub fn inner(angle: f64, shape: DefectShape) -> Self {
        Self { on: DefectOn::Inner, angle, shape }
    }
}

impl DefectOn {
    /// Radius of the body where defects are (m).
    pub fn radius(self, bearing: &Bearing) -> f64 {
        match self {
            Self::Outer => bearing.outer_raceway_radius(),
            Self::Inner => bearing.inner_raceway_radius(),
            Self::Element { .. } => bearing.element_radius(),
        }
    }

    /// What a defect's length must stay below.
    pub fn longest(self, bearing: &Bearing) -> DefectLimit {
        let around = TAU * self.radius(bearing);
        let (size, what) = match self {
            Self::Outer => (around, "the circumference of the outer raceway"),
            Self::Inner => (LONGEST * around, "nine tenths of the circumference of the inner raceway"),
            Self::Element { .. } => (LONGEST * around, "nine tenths of the circumference of an element"),
        };
        DefectLimit { size, what }
    }

    /// What a defect's depth must stay below.
    pub fn deepest(self, bearing: &Bearing) -> DefectLimit {
        let (size, what) = match self {
            Self::Element { .. } => (DEEPEST * bearing.element_radius(), "a fifth of the radius of an element"),
            _ => (bearing.element_radius(), "the radius of an element"),
        };
        DefectLimit { size, what }
    }

    /// Length (m) along the rolling track below which no element sinks into a spall.
    pub fn shortest(bearing: &Bearing) -> f64 {
        SHORTEST * bearing.element_diameter
    }

    /// Lengths (m) from and to which a host may change a spall's under every law of contact. Of a whole outer raceway
    /// those that contacts reach around are too long: nine tenths are taken there as well.
    pub fn lengths(self, bearing: &Bearing) -> [f64; 2] {
        let shortest = libm::hypot(Self::shortest(bearing), self.off_track(bearing));
        [shortest, BELOW * LONGEST * TAU * self.radius(bearing)]
    }

    /// The largest depth (m) of such a spall.
    pub fn largest_depth(self, bearing: &Bearing) -> f64 {
        BELOW * self.deepest(bearing).size
    }

    /// Diameter (m) of a pit whose rim the rolling track touches, 2 r sin λ.
    pub fn off_track(self, bearing: &Bearing) -> f64 {
        match self {
            Self::Element { tilt, .. } => 2.0 * bearing.element_radius() * libm::sin(tilt).abs(),
            _ => 0.0,
        }
    }

    /// Length (m) along the rolling track of a spall of this length: the chord on which the track crosses a round pit
    /// that lies off it, √(d² − 4 r² sin² λ); 0 where it does not.
    pub fn met_length(self, length: f64, bearing: &Bearing) -> f64 {
        let across = self.off_track(bearing);
        if across == 0.0 { length } else { (length * length - across * across).max(0.0).sqrt() }
    }
}
