//! The surfaces that contacts may meet, as the contacts of one raceway meet them.

pub mod envelope;
pub(crate) mod uneven;

use crate::envelope::{Envelope, within_half_a_turn};
use crate::turning::Turns;

/// The defects of a body as one raceway's contacts meet them.
pub struct Surface {
    pub envelope: Envelope,
    /// Angle of the first one's middle (rad) in its frame.
    pub centre: f64,
    pub frame: usize,
}

/// All surfaces: those of the rings, and those of each element on the inner and the outer raceway.
#[derive(Default)]
pub struct Surfaces {
    pub rings: [Option<Surface>; 2],
    pub own: Vec<Option<[Surface; 2]>>,
}

/// Of an element's two contacts, the stretches of the ring's surface and of its own that they are in.
pub type Stretches = [[usize; 2]; 2];

/// P, dP/dψ and the speed past it (rad/s) of what a contact meets, and what that turns with.
#[derive(Debug, Clone, Copy, Default)]
pub struct Rise {
    pub path: f64,
    pub slope: f64,
    pub rate: f64,
    pub frame: usize,
}

impl Surface {
    /// Angle from the defect's middle to a direction in which the bodies touch, within half a turn.
    pub fn psi(&self, direction: f64, turns: &Turns) -> f64 {
        within_half_a_turn(direction - turns[self.frame][0] - self.centre)
    }
}
