//! Where a ring is, wherever that comes from, and how forces accelerate it.

use super::drive::{Cubic, Drive};
use super::model::Model;
use crate::numerics::lanes::{Lanes, QUAD, Wide};
use crate::scene::{Motion, Ring};

/// Position and velocity of a ring.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RingState {
    /// Position [m].
    pub position: [f64; 2],
    /// Velocity [m/s].
    pub velocity: [f64; 2],
}

impl Model {
    /// Position and velocity of the inner ring, wherever they come from.
    #[inline(always)]
    pub fn shaft_state(&self, drive: &Drive, tau: f64, state: &[f64]) -> RingState {
        ring_state(self.layout.shaft, self.shaft.motion, &drive.shaft, tau, (state, None))
    }

    /// Position and velocity of the outer ring, wherever they come from.
    #[inline(always)]
    pub fn housing_state(&self, drive: &Drive, tau: f64, state: &[f64]) -> RingState {
        ring_state(self.layout.housing, self.housing.motion, &drive.housing, tau, (state, None))
    }

    /// Accelerations of the inner and the outer ring at `tau` [m/s²], wherever they come from.
    pub fn ring_accelerations(&self, drive: &Drive, tau: f64, derivative: &[f64]) -> [[f64; 2]; 2] {
        [(self.layout.shaft, &drive.shaft), (self.layout.housing, &drive.housing)].map(|(place, prescribed)| {
            place.map_or(prescribed.map(|place| place.second_at(tau)), |i| [derivative[i + 2], derivative[i + 3]])
        })
    }
}

/// Velocity and acceleration of a ring on its support, `force` [N] being all else that acts on it.
#[inline(always)]
pub(super) fn ring_rates<S: Wide>(
    simd: S,
    ring: &Ring,
    per_mass: f64,
    state: &RingState,
    force: [f64; 2],
) -> Lanes<S::Quad> {
    let (x, v) = (state.position, state.velocity);
    let along = [0, 1].map(|a| per_mass * (force[a] - ring.damping * v[a] - ring.stiffness * x[a]));
    whole(simd, [v[0], v[1], 0.0, 0.0], [0.0, 0.0, along[0], along[1]])
}

/// The sum of two quadruples, written at once: the compiler would write one that is put together in two halves, and reading
/// them together soon after would have to wait.
#[inline(always)]
pub(super) fn whole<S: Wide>(simd: S, one: [f64; QUAD], other: [f64; QUAD]) -> Lanes<S::Quad> {
    Lanes::of(simd, one) + Lanes::of(simd, other)
}

#[inline(always)]
pub(super) fn ring_state(
    place: Option<usize>,
    motion: Motion,
    prescribed: &[Cubic; 2],
    tau: f64,
    (state, ahead): (&[f64], Option<f64>),
) -> RingState {
    match (place, motion) {
        (Some(i), _) => {
            let velocity = [state[i + 2], state[i + 3]];
            RingState { position: [0, 1].map(|a| moved(state[i + a], velocity[a], ahead)), velocity }
        }
        (None, Motion::Host) => RingState {
            position: [prescribed[0].at(tau), prescribed[1].at(tau)],
            velocity: [prescribed[0].rate_at(tau), prescribed[1].rate_at(tau)],
        },
        _ => RingState::default(),
    }
}

/// A position, moved on along its rate by the time `ahead`.
#[inline(always)]
pub(super) fn moved(position: f64, rate: f64, ahead: Option<f64>) -> f64 {
    ahead.map_or(position, |ahead| position + ahead * rate)
}
