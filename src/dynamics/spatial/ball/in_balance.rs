//! Balls without inertia: in balance between both grooves at every instant.
//!
//! With the elastic residual R(b, t) of a ball at b = (u, v), its place and velocity follow from where the rings are
//! and how they move, as in the plane (`quasi_static::element_balance`):
//! ```text
//! R(b, t) = 0     b' = −R_b⁻¹ R_t
//! ```
//! The contacts' dampers, across the grooves too, act at the rates of that balance. To first order in what they exert,
//! d on the ball, the ball lags by b₁ = −R_b⁻¹ d, which hands both contacts the rest; no contact is made to pull by it.

use super::balance::solved;
use super::contacts::{BallContact, BallForces, BallMotion};
use super::{OnBall, Spatial};
use crate::dynamics::contacts::{Forces, Shortcuts};
use crate::dynamics::element::product as dot;
use crate::dynamics::parameters::{Model, RINGS, RingInSpace, SMOOTH, Space, Stage};
use crate::numerics::number::{Dual, Scalar};
use crate::numerics::plane::{Vector, turned};

/// Derivatives by u, v and time.
type Moving<T> = Dual<T, 3>;

/// A ball in balance, with its contacts' damping.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct BallInBalance<T: Scalar = f64> {
    /// u and v (m), and their rates (m/s).
    pub(in crate::dynamics) place: [T; 2],
    pub(in crate::dynamics) rates: [T; 2],
    pub(in crate::dynamics) forces: BallForces<T>,
}

impl<T: Scalar> BallMotion<T> {
    /// All that stands where it is, with the derivatives by time that its motion gives it; and the speed with its own.
    fn by_time(&self, alpha: T) -> (BallMotion<Moving<T>>, Moving<T>) {
        let along = |value: T, rate: T| {
            let mut number = Moving::constant(value);
            number.by[2] = rate;
            number
        };
        let mut moving = self.standing().lifted::<3>();
        let e_t = turned(Vector::new(self.e_r[0], self.e_r[1]));
        moving.e_r = [along(self.e_r[0], e_t.x * self.omega), along(self.e_r[1], e_t.y * self.omega)];
        moving.angle = along(self.angle, self.omega);
        for (ring, of) in moving.rings.iter_mut().zip(&self.rings) {
            for (k, x) in ring.position.iter_mut().enumerate() {
                *x = along(of.position[k], of.velocity[k]);
            }
        }
        for (turn, of) in moving.frames.0.iter_mut().zip(&self.frames.0) {
            turn.angle = along(of.angle, of.speed);
        }
        (moving, along(self.omega, alpha))
    }
}

impl Model {
    /// u and v (m) of a ball in elastic balance, from a place near it or from anywhere.
    fn balanced_place(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        guess: [f64; 2],
        at: &BallMotion,
        shortcuts: &mut Shortcuts,
    ) -> [f64; 2] {
        let standing = at.standing();
        if let Some(place) = self.newton_place(space, cells, guess, (&standing, at.omega), shortcuts) {
            return place;
        }
        // Standing, except for the centrifugal force.
        self.balanced_ball(space, cells, guess, &standing, at.omega, shortcuts).at
    }

    /// A ball in balance, looked for from `guess` on; `alpha` is its acceleration about the outer ring's centre
    /// (rad/s²).
    pub(in crate::dynamics) fn ball_in_balance<T: Scalar>(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        guess: [f64; 2],
        (at, alpha): (&BallMotion<T>, T),
        shortcuts: &mut Shortcuts,
    ) -> BallInBalance<T> {
        let found = self.balanced_place(space, cells, guess, &at.mapped(T::value), shortcuts);
        let (moving, omega) = at.by_time(alpha);
        let mut place = found.map(T::from);
        let seeded = |place: [T; 2]| [0, 1].map(|k: usize| Moving::variable(place[k], k));
        for _ in 0..T::DEPTH {
            // Each step gives one more order of derivatives, exactly.
            let (residual, _) = self.ball_residual(space, cells, &moving, seeded(place), omega, shortcuts);
            let step = solved(residual.map(|of| [of.by[0], of.by[1]]), residual.map(|of| of.value));
            place = [0, 1].map(|k: usize| (place[k] - step[k]).moved_to(found[k]));
        }
        let (residual, elastic) = self.ball_residual(space, cells, &moving, seeded(place), omega, shortcuts);
        let matrix = residual.map(|of| [of.by[0], of.by[1]]);
        let rates = solved(matrix, residual.map(|of| of.by[2])).map(|rate| -rate);
        let ball = at.ball_moving(self, place, rates);
        let laws = self.own_dampers(at.element);
        let mut damped = self.ball_forces_with(laws, space, cells, at, &ball, shortcuts);
        self.add_couple(space, at.omega, &mut damped);
        let plain = |of: Spatial<Moving<T>>| of.map(|part| part.value);
        let [f_r, _, f_z] = [0, 1, 2].map(|i: usize| {
            let [inner, outer] = [0, 1].map(|side: usize| {
                damped.contacts[side].on_ball.force[i] - elastic.contacts[side].on_ball.force[i].value
            });
            inner + outer
        });
        let lag = solved(matrix, [f_r, f_z]).map(|part| -part);
        let follows = |of: Spatial<Moving<T>>| of.map(|part| part.by[0] * lag[0] + part.by[1] * lag[1]);
        // What damping changes of each contact's force and moment.
        let change = [0, 1].map(|side: usize| {
            let (with, without) = (&damped.contacts[side].on_ball, &elastic.contacts[side].on_ball);
            let sum = |with: Spatial<T>, without: Spatial<Moving<T>>| {
                let (plain, follows) = (plain(without), follows(without));
                std::array::from_fn::<T, 3, _>(|i| with[i] - plain[i] + follows[i])
            };
            [sum(with.force, without.force), sum(with.moment, without.moment)]
        });
        let shares = [0, 1].map(|side: usize| {
            let force = plain(elastic.contacts[side].on_ball.force);
            let (along, square) = (dot(force, change[side][0]), dot(force, force));
            if along.value() < -square.value() { -square / along } else { T::from(1.0) }
        });
        let share = shares[0].at_most(shares[1]);
        let contacts = [0, 1].map(|side: usize| {
            let (of, part) = (&elastic.contacts[side], |base: Spatial<Moving<T>>, change: Spatial<T>| {
                std::array::from_fn::<T, 3, _>(|i| base[i].value + change[i] * share)
            });
            let on_ball = OnBall {
                force: part(of.on_ball.force, change[side][0]),
                moment: part(of.on_ball.moment, change[side][1]),
            };
            let at = damped.contacts[side];
            let [along, around] =
                [at.seen.in_meridian(at.normal), at.seen.around()].map(|part| dot(on_ball.force, part));
            let magnitude = (along * along + around * around).sqrt();
            let (approach, rate) = (of.approach.value, T::from(0.0));
            BallContact { on_ball, approach, rate, magnitude, frame: of.frame, ..at }
        });
        BallInBalance { place, rates, forces: BallForces { ball, contacts } }
    }

    /// The balls' part of the right-hand side where they are in balance; gives the forces on both rings.
    #[inline(never)]
    pub(in crate::dynamics::spatial) fn balls_in_balance<const RECORD: bool>(
        &self,
        space: &Space,
        rings: &[RingInSpace; 2],
        stage: &Stage,
        derivative: &mut [f64],
        forces: &mut Forces,
    ) -> [f64; RINGS] {
        let Some([v, w_z]) = self.layout.axial() else { return [0.0; RINGS] };
        let (w, state, cage) = (self.layout.radial_velocity, stage.state, stage.cage);
        derivative[w..2 * w].fill(0.0);
        forces.frames = stage.excitation.frames_at(cage.tau);
        let mut sums = [0.0; RINGS];
        for j in 0..self.element_count {
            let near = forces.searched.iter().find(|searched| searched.element == j);
            let cells = near.map_or([[SMOOTH; 2]; 2], |near| near.cells);
            let (at, alpha) = self.ball_within(j, stage, rings, forces);
            let carried = rings[1].velocity[0] * at.e_r[0] + rings[1].velocity[1] * at.e_r[1];
            let ahead = stage.ahead.unwrap_or(0.0);
            let guess = [
                state[j] + ahead * (state[w + j] - carried),
                state[v + j] + ahead * (state[w_z + j] - rings[1].velocity[2]),
            ];
            let found = self.ball_in_balance(space, cells, guess, (&at, alpha), &mut forces.shortcuts);
            if cells != [[SMOOTH; 2]; 2] {
                forces.defect_lookups += cells.iter().filter(|cells| **cells != [SMOOTH; 2]).count() as u64;
                if !found.forces.force().iter().sum::<f64>().is_finite() {
                    self.note_unsolved(cells, &at, &found.forces, forces);
                }
            }
            (derivative[j], derivative[v + j]) = (found.rates[0], found.rates[1]);
            for (sum, force) in sums.iter_mut().zip(found.forces.on_rings().as_flattened()) {
                *sum += force;
            }
            if RECORD {
                for (frame, torque) in found.forces.torques() {
                    forces.torques[frame as usize] += torque;
                }
                found.forces.keep(self, j, found.forces.force()[1], &mut forces.contacts);
                let balanced = &mut forces.contacts.balanced;
                (balanced[0][j], balanced[0][v + j]) = (found.place[0], found.place[1]);
                balanced[1][j] = found.rates[0] + carried;
                balanced[1][v + j] = found.rates[1] + rings[1].velocity[2];
            }
        }
        sums
    }
}
