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
