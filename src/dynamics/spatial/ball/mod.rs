//! One ball between the grooves of both rings, which see it as tilted rings do: what follows for ball and rings. In
//! numbers of any kind; letters are those of [`crate::dynamics::element`].

mod balance;
mod chained;
mod contacts;
mod gyroscopic;
mod in_balance;
mod motion;

pub(in crate::dynamics) use chained::MOVING;
pub(in crate::dynamics) use contacts::{BallForces, BallMotion};

use crate::dynamics::element::{Aslant, Element, along, cross, turned_back};
use crate::dynamics::parameters::{COORDINATES, RingInSpace};
use crate::numerics::number::Number;

/// What is known of a ball: u, v (m), w and w_z (m/s).
pub(in crate::dynamics) type BallState<T> = [T; 4];

/// A vector along e_r, e_t and the bearing's axis.
type Spatial<T> = [T; 3];

/// What one contact exerts on the ball, and by it on the ring.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct OnBall<T> {
    /// Force on the ball (N).
    pub(in crate::dynamics) force: Spatial<T>,
    /// Moment on the ring (N m).
    pub(in crate::dynamics) moment: Spatial<T>,
}

/// u' and v' (m/s) of a ball in direction `e_r` with the velocities w and w_z as the outer ring moves.
#[inline(always)]
pub(in crate::dynamics) fn rates<T: Number>(e_r: [T; 2], [w, w_z]: [T; 2], outer: &RingInSpace<T>) -> [T; 2] {
    [w - along(e_r, outer.velocity[0], outer.velocity[1])[0], w_z - outer.velocity[2]]
}

/// Accelerations w' and w_z' (m/s²) under a force along e_r and z (N) of a ball of 1/mass (1/kg), with gravity.
#[inline(always)]
pub(in crate::dynamics) fn accelerations<T: Number>(
    ball: &Element<T, 2>,
    outer: &RingInSpace<T>,
    [f_r, f_z]: [T; 2],
    per_mass: T::Plain,
    gravity: Spatial<T>,
) -> [T; 2] {
    let [g_r, _] = along(ball.e_r, gravity[0], gravity[1]);
    let [_, around] = along(ball.e_r, outer.velocity[0], outer.velocity[1]);
    [f_r * per_mass + g_r + ball.omega * (around + ball.rho * ball.omega), f_z * per_mass + gravity[2]]
}

impl<T: Number> OnBall<T> {
    /// Of a ball seen so, on which a contact exerts forces (N) away from the ring's axis and along it, and `around` it.
    #[inline(always)]
    pub(in crate::dynamics) fn of(seen: &Aslant<T>, parts: [T; 2], around: Option<T>) -> Self {
        let mut force = seen.in_meridian(parts);
        if let Some(around) = around {
            let direction = seen.around();
            force = [0, 1, 2].map(|i: usize| force[i] + direction[i] * around);
        }
        Self { force, moment: cross(force, seen.q) }
    }

    /// Force and moment on the ring along its coordinates.
    #[inline(always)]
    pub(in crate::dynamics) fn on_ring(&self, e_r: [T; 2]) -> [T; COORDINATES] {
        let ([f_r, f_t, f_z], [m_r, m_t, _]) = (self.force, self.moment);
        let ([f_x, f_y], [m_x, m_y]) = (turned_back(e_r, f_r, f_t), turned_back(e_r, m_r, m_t));
        [-f_x, -f_y, -f_z, m_x, m_y]
    }
}
