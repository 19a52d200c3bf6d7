//! One ball in balance, and balls without inertia, which are so at every instant.
//!
//! A ball is balanced by Newton's steps of at most 2 µm with a Jacobian of difference quotients. One without inertia is
//! where its *elastic* contacts balance the weight and the centrifugal force,
//! ```text
//! R(b, t) = F_i + F_o + m (g + ω_c² ρ e_r) = 0     b = (u, v)     b' = −R_b⁻¹ R_t
//! ```
//! and its dampers act at the velocity that it has by that. What they do to it, d, moves it on by −R_b⁻¹ d to first
//! order, which changes what both contacts do; all of that is made smaller where a contact would pull.

use super::bearing::{Ball, Outside, SpatialBearing};
use super::case::Gyroscopic;
use super::contact::{Dampers, Pose, Touch};
use super::vector::{Vector, add, cross, dot, subtract, times};
use crate::elimination::solve;
use crate::turning::quadratic;

/// Longest step of a ball (m).
const LONGEST: f64 = 2e-6;
/// Of difference quotients: a distance (m); the shortest and the longest where rounding counts, in between a part of
/// the smallest approach; and a time (s) in which a ball goes less than a micrometre.
const NEAR: f64 = 1e-10;
const WIDE: [f64; 2] = [1e-11, 1e-9];
const OF_APPROACH: f64 = 0.02;
const SOON: f64 = 1e-8;

/// An instant of a communication step: what the host says, and how far into it.
type Instant<'a> = (&'a Outside, f64);

impl Pose {
    /// So much later at the same velocity.
    fn later(&self, time: f64) -> Self {
        Self {
            position: add(self.position, times(time, self.velocity)),
            tilt: [0, 1].map(|a| self.tilt[a] + time * self.tilt_rate[a]),
            ..*self
        }
    }
}

impl SpatialBearing {
    /// Ball `j` at a place that it does not leave, and what is left on it along e_r and z (N).
    fn standing(
        &self,
        (outside, t): Instant<'_>,
        poses: &[Pose; 2],
        j: usize,
        [u, v]: [f64; 2],
        dampers: Dampers,
    ) -> (Ball, [f64; 2]) {
        let ([e_r, _], housing) = (self.directions(outside, t, j), poses[1].velocity);
        let ball = self.ball((outside, t), poses, j, [u, dot(e_r, housing), v, housing[2]], dampers);
        let ball = self.with_couple((outside, t), ball);
        let (force, omega) = (ball.force(), quadratic(outside.turns[0], t)[1]);
        let body = dot(self.gravity, e_r) + (self.rho_0 + u) * omega * omega;
        (ball, [dot(force, e_r) + self.mass * body, force[2] + self.mass * self.gravity[2]])
    }

    /// Ball `j` in balance, looked for from a place, and what is left on it (N).
    pub(super) fn settled(
        &self,
        now: Instant<'_>,
        poses: &[Pose; 2],
        j: usize,
        mut place: [f64; 2],
        dampers: Dampers,
    ) -> Option<(Ball, f64)> {
        let at = |place: [f64; 2]| self.standing(now, poses, j, place, dampers);
        let size = |force: [f64; 2]| force[0].hypot(force[1]);
        let (mut ball, mut force) = at(place);
        for _ in 0..500 {
            let scale = ball.contacts.iter().fold(1e-6, |m, touch| touch.force.max(m));
            if size(force) <= 1e-14 * scale {
                break;
            }
            // Loose between both raceways: outwards until one pushes.
            let step = solve(self.slopes(now, poses, (j, place), dampers, NEAR), &force.map(|f| -f))
                .unwrap_or(vec![force[0].signum() * LONGEST, 0.0]);
            let share = (LONGEST / step[0].hypot(step[1])).min(1.0);
            let mut tried = None;
            let better = [1.0, 0.5, 0.25, 0.1, 0.03].into_iter().find_map(|part| {
                let next = [0, 1].map(|k| place[k] + part * share * step[k]);
                let found = at(next);
                tried = Some((next, found));
                (size(found.1) < size(force)).then_some((next, found))
            });
            let Some((next, found)) = better.or(tried.filter(|_| size(force) > 1e-9 * scale)) else { break };
            (place, (ball, force)) = (next, found);
        }
        size(force).is_finite().then_some((ball, size(force)))
    }

    /// Rows of R_b (N/m), over a distance (m) either way.
    fn slopes(
        &self,
        now: Instant<'_>,
        poses: &[Pose; 2],
        (j, place): (usize, [f64; 2]),
        dampers: Dampers,
        over: f64,
    ) -> Vec<Vec<f64>> {
        let columns = [0, 1].map(|k| {
            let moved = |by: f64| {
                let mut there = place;
                there[k] += by;
                self.standing(now, poses, j, there, dampers).1
            };
            let (up, down) = (moved(over), moved(-over));
            [0, 1].map(|i| (up[i] - down[i]) / (2.0 * over))
        });
        (0..2).map(|i| columns.iter().map(|column| column[i]).collect()).collect()
    }

    /// Ball `j` without inertia, looked for from a place; NaN where there is no balance.
    pub(super) fn following(&self, now: Instant<'_>, poses: &[Pose; 2], j: usize, guess: [f64; 2]) -> Ball {
        let Some((elastic, left)) = self.settled(now, poses, j, guess, Dampers::NONE) else { return lost() };
        if left > 1e-8 * elastic.contacts.iter().fold(1e-3, |m, touch| touch.force.max(m)) {
            return lost();
        }
        let ((outside, t), place) = (now, elastic.place);
        let approaches = elastic.contacts.iter().map(|touch| touch.approach).filter(|&approach| approach > 0.0);
        let smallest = OF_APPROACH * approaches.fold(f64::INFINITY, f64::min);
        let (over, soon) = (self.quotients * smallest.clamp(WIDE[0], WIDE[1]), self.quotients * SOON);
        let rows = self.slopes(now, poses, (j, place), Dampers::NONE, over);
        // Where nothing holds it nothing follows.
        let answer = |force: [f64; 2]| solve(rows.clone(), &force.map(|f| -f)).unwrap_or(vec![0.0; 2]);
        let [later, earlier] = [soon, -soon].map(|by| {
            let moved = [poses[0].later(by), poses[1].later(by)];
            self.standing((outside, t + by), &moved, j, place, Dampers::NONE).1
        });
        let rates = answer([0, 1].map(|i| (later[i] - earlier[i]) / (2.0 * soon)));
        let ([e_r, _], housing) = (self.directions(outside, t, j), poses[1].velocity);
        let moving = [place[0], rates[0] + dot(e_r, housing), place[1], rates[1] + housing[2]];
        let damped = self.with_couple(now, self.ball(now, poses, j, moving, self.dampers));
        let by_dampers = subtract(damped.force(), elastic.force());
        let lag = answer([dot(by_dampers, e_r), by_dampers[2]]);
        let far = lag[0].hypot(lag[1]).max(1e-30);
        let [ahead, behind] = [over, -over].map(|by| {
            let there = [0, 1].map(|k| place[k] + by * lag[k] / far);
            self.standing(now, poses, j, there, Dampers::NONE).0
        });
        let change = [0, 1].map(|side| {
            let [elastic, damped, ahead, behind] = [&elastic, &damped, &ahead, &behind].map(|of| &of.contacts[side]);
            let of = |part: fn(&Touch) -> Vector| {
                let follows = times(far / (2.0 * over), subtract(part(ahead), part(behind)));
                add(subtract(part(damped), part(elastic)), follows)
            };
            [of(|touch| touch.on_ball), of(|touch| touch.moment)]
        });
        // No contact pulls.
        let share = [0, 1].map(|side| {
            let force = elastic.contacts[side].on_ball;
            let (along, square) = (dot(force, change[side][0]), dot(force, force));
            if along < -square { -square / along } else { 1.0 }
        });
        let share = share[0].min(share[1]);
        let contacts = [0, 1].map(|side| {
            let touch = elastic.contacts[side];
            let [on_ball, moment] = change[side].map(|part| times(share, part));
            let (on_ball, moment) = (add(touch.on_ball, on_ball), add(touch.moment, moment));
            let force = dot(on_ball, touch.normal_and_across()[0]).hypot(dot(on_ball, touch.frame[2]));
            Touch { on_ball, moment, force, ..touch }
        });
        Ball { contacts, place }
    }

    /// With Jones's forces λ M_g/D across the grooves at the points of contact, where both contacts carry.
    fn with_couple(&self, (outside, t): Instant<'_>, mut ball: Ball) -> Ball {
        let shares = match self.gyroscopic {
            Gyroscopic::Nobody => return ball,
            Gyroscopic::Outer => [0.0, 2.0],
            Gyroscopic::Shared => [1.0, 1.0],
        };
        if ball.contacts.iter().any(|touch| touch.force <= 0.0) {
            return ball;
        }
        let [cage, shaft] = [0, 1].map(|which| quadratic(outside.turns[which], t)[1]);
        let moment = self.gyroscopic_moment(shaft, cage, &ball);
        for ((touch, share), sign) in ball.contacts.iter_mut().zip(shares).zip([1.0, -1.0]) {
            let [normal, across] = touch.normal_and_across();
            let force = times(sign * share * moment / (2.0 * self.radius), across);
            // Inside the ball's normal goes away from the point of contact, outside towards it.
            let point = add(touch.arm, times(-sign * self.radius, normal));
            touch.on_ball = add(touch.on_ball, force);
            touch.moment = add(touch.moment, cross(point, force));
        }
        ball
    }

    /// M_g (N m) of a ball, the shaft and the cage turning so fast (rad/s).
    pub fn gyroscopic_moment(&self, shaft: f64, cage: f64, ball: &Ball) -> f64 {
        let [(sin_i, cos_i), (sin_o, cos_o)] = ball.contacts.map(|touch| touch.angle.sin_cos());
        let gamma = 2.0 * self.radius / self.pitch;
        let beta = (sin_o / (cos_o + gamma)).atan();
        let outer = (cos_o + beta.tan() * sin_o) / (1.0 + gamma * cos_o);
        let inner = (cos_i + beta.tan() * sin_i) / (1.0 - gamma * cos_i);
        let spin = shaft / ((outer + inner) * gamma * beta.cos());
        0.4 * self.mass * self.radius * self.radius * spin * cage * beta.sin()
    }
}

/// A ball that nothing balances.
fn lost() -> Ball {
    let touch = Touch { on_ball: [f64::NAN; 3], moment: [f64::NAN; 3], force: f64::NAN, ..Touch::default() };
    Ball { contacts: [touch; 2], place: [f64::NAN; 2] }
}
