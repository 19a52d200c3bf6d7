//! How far a communication step has come, between its integration steps.

use crate::dynamics::contacts::RingForces;
use crate::simulation::integration::landing::Knot;

/// How far a communication step has come.
#[derive(Debug, Clone, Copy)]
pub struct Advance {
    /// Where it ends (s) after the communication point. May be brought forward.
    pub(in crate::simulation) end: f64,
    /// Where it is (s) after the communication point.
    pub(in crate::simulation) tau: f64,
    /// Impulse of the forces on both rings since the communication point, and before it as far as `before` goes back
    /// (N s).
    pub(super) impulse: RingForces,
    /// Time before the communication point that the impulse covers (s).
    pub(super) before: f64,
    /// The next knot to land on.
    pub(super) knot: Option<Knot>,
    /// Knots passed without time between them.
    pub(super) simultaneous: usize,
    /// Integration steps before the communication point.
    pub(super) first_count: u64,
}

impl Advance {
    /// At the communication point, with `end` (s) to come, after so many integration steps.
    pub(in crate::simulation) fn new(end: f64, knot: Option<Knot>, first_count: u64) -> Self {
        Self { end, tau: 0.0, impulse: [0.0; 10], before: 0.0, knot, simultaneous: 0, first_count }
    }

    /// Whether it has come to its end.
    pub(in crate::simulation) fn is_done(&self) -> bool {
        !(self.tau < self.end)
    }

    /// Where it is (s) after the communication point that the impulse goes back to.
    pub(in crate::simulation) fn elapsed(&self) -> f64 {
        self.before + self.tau
    }

    /// Ends `elapsed` (s) after that point if it would not end before, but no earlier than where it is.
    pub(in crate::simulation) fn shorten_to(&mut self, elapsed: f64) {
        self.end = self.end.min((elapsed - self.before).max(self.tau));
    }

    /// Takes over the impulse of an advance that ends where this one begins.
    pub(in crate::simulation) fn follow(&mut self, earlier: &Advance) {
        self.before = earlier.elapsed();
        self.impulse = earlier.impulse;
    }
}
