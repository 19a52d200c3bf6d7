//! How a host has moved a ring between two communication points.
//!
//! Places and velocities at both ends give one cubic,
//! ```text
//! a(t) = ā + a' (t − h/2)      ā = (v₁ − v₀)/h      a' = −12 s/h³      s = x₁ − x₀ − (v₀ + v₁) h/2
//! ```
//! A force that is held changes the acceleration at the ends of the step alone: what a jumps by there, all that is
//! continuous left out, is the change of that force over the mass.

use super::step::Triple;

/// The way of one ring over one step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Way {
    /// Length of the step (s).
    pub(super) length: f64,
    /// Mean place, velocity and acceleration.
    pub(super) place: Triple,
    pub(super) velocity: Triple,
    pub(super) acceleration: Triple,
    /// Rate of the acceleration.
    pub(super) rate: Triple,
    /// The part s of the way that is not that of the mean velocity.
    pub(super) unexplained: Triple,
    /// Whether the ring has another place and no velocity.
    pub(super) lacks_velocity: bool,
    /// How far the velocity's change takes the ring in one step (m).
    turned: f64,
}

impl Way {
    /// From place and velocity at the start to those at the end of a step.
    pub(super) fn new([x0, v0]: [Triple; 2], [x1, v1]: [Triple; 2], length: f64) -> Self {
        let velocity = 0.5 * (v0 + v1);
        let unexplained = x1 - x0 - velocity * length;
        Self {
            length,
            place: 0.5 * (x0 + x1),
            velocity,
            acceleration: (v1 - v0) / length,
            rate: unexplained * (-12.0 / (length * length * length)),
            unexplained,
            lacks_velocity: v0 == Triple::zeros() && v1 == Triple::zeros() && x0 != x1,
            turned: (v1 - v0).norm() * length,
        }
    }

    /// Acceleration at the start and at the end, inside the step.
    pub(super) fn ends(&self) -> [Triple; 2] {
        let half = self.rate * (0.5 * self.length);
        [self.acceleration - half, self.acceleration + half]
    }

    /// Whether no acceleration that a step can bear explains it: twice what the velocity turns by.
    pub(super) fn is_jump(&self) -> bool {
        self.unexplained.norm() > 2.0 * self.turned
    }
}
