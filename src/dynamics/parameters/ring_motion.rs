//! How the rings of a model move: from the state where it has them, else as the host prescribes.

use crate::dynamics::parameters::{
    COORDINATES, Cubic, Excitation, FramedKinematics, Kinematics, Layout, Model, RingInSpace, RingState, Stage, moved,
};
use crate::numerics::plane::Vector;
use crate::scene::Motion;

impl Model {
    /// Cage and rings at `tau`.
    pub fn kinematics(&self, excitation: &Excitation, tau: f64, state: &[f64]) -> FramedKinematics {
        let motion = self.kinematics_of(&Stage { excitation, cage: &excitation.cage_at(tau), state, ahead: None });
        let (frames, films) = (excitation.frames_at(tau), self.films_at(excitation, tau));
        FramedKinematics { motion, turns: excitation.cage_turns, frames, films }
    }

    /// As [`kinematics`](Self::kinematics), without the frames of defects and oil films.
    #[inline(always)]
    pub(in crate::dynamics) fn kinematics_of(&self, at: &Stage) -> Kinematics {
        let Stage { excitation, cage, state, ahead } = *at;
        let (shaft, housing) = (self.shaft.motion, self.housing.motion);
        Kinematics {
            cage: *cage,
            shaft: ring_state(self.layout.shaft, shaft, &excitation.motion[0], cage.tau, state, ahead),
            housing: ring_state(self.layout.housing, housing, &excitation.motion[1], cage.tau, state, ahead),
        }
    }

    /// Position and velocity of the inner ring, wherever they come from.
    #[inline(always)]
    pub fn shaft_state(&self, excitation: &Excitation, tau: f64, state: &[f64]) -> RingState {
        ring_state(self.layout.shaft, self.shaft.motion, &excitation.motion[0], tau, state, None)
    }

    /// Position and velocity of the outer ring, wherever they come from.
    #[inline(always)]
    pub fn housing_state(&self, excitation: &Excitation, tau: f64, state: &[f64]) -> RingState {
        ring_state(self.layout.housing, self.housing.motion, &excitation.motion[1], tau, state, None)
    }

    /// Velocity and acceleration of the inner and the outer ring, each in a [`RingState`] of rates: zero for a ring at
    /// rest.
    pub fn ring_rates(&self, excitation: &Excitation, tau: f64, derivative: &[f64]) -> [RingState; 2] {
        [(0, self.layout.shaft), (1, self.layout.housing)].map(|(ring, index)| match index {
            Some(i) => RingState {
                position: Vector::new(derivative[i], derivative[i + 1]),
                velocity: Vector::new(derivative[i + 2], derivative[i + 3]),
            },
            None => self.prescribed_ring_rates(excitation, ring, tau).in_plane(),
        })
    }

    /// Velocity and acceleration of the inner ring (0) or the outer (1) as the host prescribes them; 0 of one that it
    /// does not move.
    pub(in crate::dynamics) fn prescribed_ring_rates(
        &self,
        excitation: &Excitation,
        ring: usize,
        tau: f64,
    ) -> RingInSpace {
        match [&self.shaft, &self.housing][ring].motion {
            Motion::Host => excitation.prescribed_rates(ring, tau),
            Motion::Internal | Motion::Fixed => RingInSpace::default(),
        }
    }

    /// Both rings at `tau`, their positions moved on by the time that is still `ahead` (s).
    #[inline(always)]
    pub fn rings_in_space(
        &self,
        excitation: &Excitation,
        tau: f64,
        state: &[f64],
        ahead: Option<f64>,
    ) -> [RingInSpace; 2] {
        let hosted = [&self.shaft, &self.housing].map(|ring| ring.motion == Motion::Host);
        self.layout.rings_in_space(excitation, hosted, tau, state, ahead.unwrap_or(0.0))
    }

    /// Velocity and acceleration of both rings in space.
    pub fn ring_rates_in_space(&self, excitation: &Excitation, tau: f64, derivative: &[f64]) -> [RingInSpace; 2] {
        [(0, self.layout.shaft), (1, self.layout.housing)].map(|(ring, start)| match start {
            Some(start) => RingInSpace {
                position: Layout::POSITIONS.map(|slot| derivative[start + slot]),
                velocity: Layout::VELOCITIES.map(|slot| derivative[start + slot]),
            },
            None => self.prescribed_ring_rates(excitation, ring, tau),
        })
    }
}

#[inline(always)]
fn ring_state(
    index: Option<usize>,
    motion: Motion,
    [x, y, ..]: &[Cubic; COORDINATES],
    tau: f64,
    state: &[f64],
    ahead: Option<f64>,
) -> RingState {
    match (index, motion) {
        (Some(i), _) => {
            let velocity = Vector::new(state[i + 2], state[i + 3]);
            let position = Vector::new(moved(state[i], velocity.x, ahead), moved(state[i + 1], velocity.y, ahead));
            RingState { position, velocity }
        }
        (None, Motion::Host) => RingState {
            position: Vector::new(x.at(tau), y.at(tau)),
            velocity: Vector::new(x.rate_at(tau), y.rate_at(tau)),
        },
        _ => RingState::default(),
    }
}
