//! A ring: who moves it, its load and its support.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Who moves a ring.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Motion {
    /// The host prescribes position and velocity.
    Host,
    /// The ring has a mass and moves under the forces on it.
    Internal,
    /// The ring stands.
    Fixed,
}

/// What a host's inputs are when it repeats a step from the same communication point.
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RepeatedInputs {
    /// Values at the step's start, as in every other step.
    #[default]
    Start,
    /// Values at the step's end; those at its start are what the host gave when it first took the step.
    End,
}

impl RepeatedInputs {
    /// Both. The variable `host.repeated_inputs` numbers them from 1 in this order.
    pub const ALL: [Self; 2] = [Self::Start, Self::End];

    /// Its number in the variable.
    pub fn number(self) -> i32 {
        if self == Self::Start { 1 } else { 2 }
    }

    /// That of a number, if it is one's.
    pub fn numbered(number: i32) -> Option<Self> {
        Self::ALL.into_iter().find(|of| of.number() == number)
    }

    /// Its name in a scene file, and what it is.
    pub const fn described(self) -> (&'static str, &'static str) {
        match self {
            Self::Start => ("start", "Values at the start of the step, as in every other step"),
            Self::End => ("end", "Values at the end of the step; the start keeps those of the first time"),
        }
    }
}

/// A ring and its support.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Ring {
    /// Who moves it.
    pub motion: Motion,
    /// External load (N), x and y: start value of the load inputs. This and what follows: zero unless `motion` is
    /// internal.
    pub load: [f64; 2],
    /// Mass (kg).
    pub mass: f64,
    /// Viscous damping to ground (N s/m).
    pub damping: f64,
    /// Stiffness to ground (N/m).
    pub stiffness: f64,
    /// Along the bearing's axis, of a ring that moves there.
    pub axial: AxialSupport,
    /// About x and y, of a ring that tilts under the moments on it.
    pub tilt: TiltSupport,
}

/// What acts on a ring along the bearing's axis beside the bearing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct AxialSupport {
    /// External load (N): start value of the input.
    pub load: f64,
    /// Force of a preload spring (N), not negative, which presses the ring in the sense of the contact angle and stays
    /// whatever the load is.
    pub preload: f64,
    /// Viscous damping to ground (N s/m).
    pub damping: f64,
    /// Stiffness to ground (N/m).
    pub stiffness: f64,
}

/// What acts on a ring about x and y beside the bearing, and its inertia.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct TiltSupport {
    /// External moment (N m) about x and y: start value of the inputs.
    pub load_moment: [f64; 2],
    /// Moment of inertia I_t about x or y (kg m²).
    pub transverse_inertia: f64,
    /// Moment of inertia I_p about z (kg m²), which with the ring's speed couples both tilts.
    pub polar_inertia: f64,
    /// Viscous damping to ground (N m s/rad).
    pub damping: f64,
    /// Stiffness to ground (N m/rad).
    pub stiffness: f64,
}

impl AxialSupport {
    /// Nothing but the bearing.
    pub const NONE: Self = Self { load: 0.0, preload: 0.0, damping: 0.0, stiffness: 0.0 };
}

impl TiltSupport {
    /// Of a ring that does not tilt under moments.
    pub const NONE: Self =
        Self { load_moment: [0.0; 2], transverse_inertia: 0.0, polar_inertia: 0.0, damping: 0.0, stiffness: 0.0 };
    /// Of the default shaft, assumed: the transverse radius of inertia is 39 mm, as of a thin shaft of 136 mm.
    pub const ASSUMED: Self = Self { transverse_inertia: 5e-3, polar_inertia: 3e-3, damping: 0.5, ..Self::NONE };
}

impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Host => "host",
            Self::Internal => "internal",
            Self::Fixed => "fixed",
        })
    }
}
