//! One ball between the grooves of both rings: where it meets them, and what follows for ball and rings. In numbers of
//! any kind.
//!
//! Seen along e_r, e_t and the axis, with ρ = R_o − r + u and the outer ring's centre x_o before the inner's x_i,
//! ```text
//! q_o = (ρ, 0, v)   q_i = q_o + x_o − x_i   q̇_o = (u', ρ ω, v')   q̇_i = q̇_o + ẋ_o − ẋ_i
//! u' = w − e_r·ẋ_o   w' = F·e_r/m + g·e_r + ω (ẋ_o·e_t + ρ ω)
//! v' = w_z − ż_o     w_z' = F_z/m + g_z
//! ```
//! F is the force of both contacts on the ball. On a ring acts −F with the moment −q × F about its centre.

mod balance;
mod chained;
mod contacts;
mod gyroscopic;
mod in_balance;
mod motion;

pub(in crate::dynamics) use chained::MOVING;
pub(in crate::dynamics) use contacts::{BallForces, BallMotion};

use crate::contact::groove::{Axis, Groove, GrooveContact, Spatial, cross, plus, times};
use crate::dynamics::parameters::{COORDINATES, RingInSpace};
use crate::numerics::number::Number;

/// What is known of a ball: u, v (m), w and w_z (m/s).
pub(in crate::dynamics) type BallState<T> = [T; 4];

/// A ball as the rings see it.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Ball<T> {
    /// Direction e_r.
    pub(in crate::dynamics) e_r: [T; 2],
    /// Its speed about the outer ring's centre (rad/s).
    pub(in crate::dynamics) omega: T,
    /// ρ (m).
    pub(in crate::dynamics) rho: T,
    /// u' and v' (m/s).
    pub(in crate::dynamics) rates: [T; 2],
    /// ẋ_o·e_t (m/s).
    around: T,
    /// How it is seen from the inner ring and from the outer one.
    pub(in crate::dynamics) seen: (Seen<T>, Seen<T>),
}

/// A ball seen from one ring, along e_r, e_t and z.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Seen<T> {
    /// Where it is (m).
    pub(in crate::dynamics) q: Spatial<T>,
    /// How fast it goes (m/s).
    pub(in crate::dynamics) rate: Spatial<T>,
    /// The ring's axis.
    pub(in crate::dynamics) axis: Axis<T>,
}

/// Where a ball meets one groove.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Place<T> {
    q: Spatial<T>,
    /// Velocity against the ring (m/s).
    pub(in crate::dynamics) velocity: Spatial<T>,
    pub(in crate::dynamics) contact: GrooveContact<T>,
}

/// What one contact exerts on the ball, and by it on the ring.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct OnBall<T> {
    /// Force on the ball along e_r, e_t and the axis (N).
    pub(in crate::dynamics) force: Spatial<T>,
    /// Moment on the ring about e_r, e_t and the axis (N m).
    pub(in crate::dynamics) moment: Spatial<T>,
}

/// v along e_r and the direction counter-clockwise of it.
#[inline(always)]
fn seen<T: Number>([e_x, e_y]: [T; 2], x: T, y: T) -> [T; 2] {
    [x * e_x + y * e_y, y * e_x - x * e_y]
}

/// Parts along x and y of parts along e_r and e_t.
#[inline(always)]
fn shown<T: Number>([e_x, e_y]: [T; 2], r: T, t: T) -> [T; 2] {
    [r * e_x - t * e_y, r * e_y + t * e_x]
}

/// Axis of a ring, along x, y and z.
#[inline(always)]
pub(in crate::dynamics) fn axis_of<T: Number>(ring: &RingInSpace<T>) -> Axis<T> {
    let (x, v) = (&ring.position, &ring.velocity);
    Axis::tilted([x[3], x[4]], [v[3], v[4]])
}

impl<T: Number> Ball<T> {
    /// u' and v' (m/s) of a ball in direction `e_r` with the velocities w and w_z as the outer ring moves.
    #[inline(always)]
    pub(in crate::dynamics) fn rates(e_r: [T; 2], [w, w_z]: [T; 2], outer: &RingInSpace<T>) -> [T; 2] {
        [w - seen(e_r, outer.velocity[0], outer.velocity[1])[0], w_z - outer.velocity[2]]
    }

    /// At u and v, which change at these rates, in direction `e_r`, going round with `omega` (rad/s), between these
    /// rings, the inner one first; `radius` is R_o − r (m).
    #[inline(always)]
    pub(in crate::dynamics) fn new(
        radius: T,
        e_r: [T; 2],
        omega: T,
        ([u, v], rates): ([T; 2], [T; 2]),
        [inner, outer]: [&RingInSpace<T>; 2],
        axes: (&Axis<T>, &Axis<T>),
    ) -> Self {
        let rho = radius + u;
        let between = |k: usize| outer.position[k] - inner.position[k];
        let drift = |k: usize| outer.velocity[k] - inner.velocity[k];
        let q = [rho, u.all(0.0), v];
        let rate = [rates[0], rho * omega, rates[1]];
        let offset = seen(e_r, between(0), between(1));
        let drifting = seen(e_r, drift(0), drift(1));
        let turned = |x, y| seen(e_r, x, y);
        let q_inner = [rho + offset[0], offset[1], v + between(2)];
        let rate_inner = [rate[0] + drifting[0], rate[1] + drifting[1], rate[2] + drift(2)];
        Self {
            e_r,
            omega,
            rho,
            rates,
            around: seen(e_r, outer.velocity[0], outer.velocity[1])[1],
            seen: (
                Seen { q: q_inner, rate: rate_inner, axis: axes.0.seen(turned) },
                Seen { q, rate, axis: axes.1.seen(turned) },
            ),
        }
    }

    /// Accelerations w' and w_z' (m/s²) under a force along e_r and z (N) of a ball of 1/mass (1/kg), with gravity.
    #[inline(always)]
    pub(in crate::dynamics) fn accelerations(
        &self,
        [f_r, f_z]: [T; 2],
        per_mass: T::Plain,
        gravity: Spatial<T>,
    ) -> [T; 2] {
        let [g_r, _] = seen(self.e_r, gravity[0], gravity[1]);
        [f_r * per_mass + g_r + self.omega * (self.around + self.rho * self.omega), f_z * per_mass + gravity[2]]
    }

    /// Force and moment on a ring of what a contact exerts on the ball, along its coordinates.
    #[inline(always)]
    pub(in crate::dynamics) fn on_ring(&self, of: &OnBall<T>) -> [T; COORDINATES] {
        let [f_x, f_y] = shown(self.e_r, of.force[0], of.force[1]);
        let [m_x, m_y] = shown(self.e_r, of.moment[0], of.moment[1]);
        [-f_x, -f_y, -of.force[2], m_x, m_y]
    }
}

impl<T: Number> Place<T> {
    /// Of a ball seen from the groove's ring.
    #[inline(always)]
    pub(in crate::dynamics) fn of(groove: &Groove, Seen { q, rate, axis }: &Seen<T>) -> Self {
        Self { q: *q, velocity: axis.velocity(*q, *rate), contact: GrooveContact::of(groove, *q, axis) }
    }

    /// Rate at which the ball closes in on the smooth groove (m/s).
    #[inline(always)]
    pub(in crate::dynamics) fn closing(&self) -> T {
        self.contact.closing(self.velocity)
    }

    /// What a contact exerts with a `force` (N) across the groove at the point where it touches a ball of this radius
    /// (m).
    fn held(&self, force: T, radius: T::Plain) -> OnBall<T> {
        let across = self.contact.across.map(|part| part * force);
        let point = std::array::from_fn(|i| self.q[i] - self.contact.normal[i] * radius);
        OnBall { force: across, moment: cross(across, point) }
    }

    /// What a contact exerts with this `force` along the normal (N), its magnitude damped across the groove.
    #[inline(always)]
    pub(in crate::dynamics) fn presses(&self, force: T, magnitude: T, damping: T::Plain) -> OnBall<T> {
        let force = self.contact.force(force, magnitude, damping, self.velocity);
        OnBall { force, moment: cross(force, self.q) }
    }

    /// The same of a contact that exerts forces along the normal and around the ring (N).
    #[inline(always)]
    pub(in crate::dynamics) fn exerts(&self, [force, around]: [T; 2], magnitude: T, damping: T::Plain) -> OnBall<T> {
        let pressed = self.contact.force(force, magnitude, damping, self.velocity);
        let force = plus(pressed, times(self.contact.around, around));
        OnBall { force, moment: cross(force, self.q) }
    }

    /// What a contact exerts with a force (N) along t beside another.
    pub(in crate::dynamics) fn exerts_across(&self, other: OnBall<T>, across: T) -> OnBall<T> {
        let force = plus(other.force, times(self.contact.across, across));
        OnBall { force, moment: cross(force, self.q) }
    }
}
