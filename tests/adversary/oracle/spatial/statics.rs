//! Balances: balls between rings that are held, free rings under loads, and the stiffness of the whole.
//!
//! Each ball is balanced by Newton's steps of at most 2 µm with a Jacobian of difference quotients; so are the free
//! rings, with the balls in balance at every try. What dampers do at the speed of the cage counts, as in motion.

use super::bearing::{BALLS, Ball, OF_RING, Outside, SpatialBearing};
use super::case::{Gyroscopic, Host};
use super::contact::Pose;
use super::vector::{Vector, add, cross, dot, solve, times};
use crate::case::Motion;

/// Longest step of a ball (m).
const LONGEST: f64 = 2e-6;

/// A bearing in balance.
#[derive(Debug, Clone)]
pub struct Balance {
    /// The state that it has, at rest except for what the host moves.
    pub state: Vec<f64>,
    pub held: Held,
    /// Force (N) or moment (N m) that is left on what is free.
    pub left: f64,
}

/// Balls in balance between rings that are held.
#[derive(Debug, Clone)]
pub struct Held {
    pub balls: Vec<Ball>,
    /// u and v of each.
    pub places: Vec<[f64; 2]>,
    /// The bearing on shaft and housing: forces, and moments about x and y.
    pub rings: [[f64; 5]; 2],
    /// Largest force (N) that is left on a ball.
    pub left: f64,
}

impl SpatialBearing {
    /// The balance of the free rings under what the host says at the start, looked for from `guess`, the position and
    /// tilt of the shaft; `None` where none is found.
    pub fn balance(&self, host: Option<&Host>, guess: [f64; 5]) -> Option<Balance> {
        let mut outside = self.outside([self.cage_start, 0.0, 0.0], host.unwrap_or(&self.of_scene()));
        // At the start nothing has turned, nor do derivatives of speeds count.
        outside.turns.iter_mut().for_each(|turn| turn[2] = 0.0);
        let mut state = vec![0.0; self.state_count()];
        let free: Vec<usize> = (0..2).flat_map(|which| self.free(which).map(move |a| OF_RING * which + a)).collect();
        for a in self.free(0) {
            state[a] = guess[a];
        }
        let mut places = vec![[0.0, 0.5 * guess[2]]; self.count];
        let (mut force, mut held) = self.on_free(&outside, &mut state, &free, &mut places)?;
        for _ in 0..200 {
            let size = norm(&force);
            let load = held.balls.iter().flat_map(|ball| ball.contacts).fold(1e-3, |m, touch| touch.force.max(m));
            if size <= 1e-13 * load {
                break;
            }
            let columns: Vec<Vec<f64>> = free
                .iter()
                .map(|&i| {
                    // Micrometres and microradians: forces are smooth on a thousandth of them.
                    let h = 1e-9;
                    let moved = |by: f64| {
                        let (mut there, mut places) = (state.clone(), places.clone());
                        there[i] += by;
                        self.on_free(&outside, &mut there, &free, &mut places).map(|found| found.0)
                    };
                    let (up, down) = (moved(h)?, moved(-h)?);
                    Some(up.iter().zip(&down).map(|(a, b)| (a - b) / (2.0 * h)).collect())
                })
                .collect::<Option<_>>()?;
            let rows = (0..free.len()).map(|i| columns.iter().map(|column| column[i]).collect()).collect();
            let step = solve(rows, &force.iter().map(|f| -f).collect::<Vec<_>>())?;
            // Tilts of a milliradian move balls by tens of micrometres.
            let longest = free.iter().zip(&step).map(|(i, step)| step.abs() / [1.0, 50.0][usize::from(i % 10 > 2)]);
            let scale = (5.0 * LONGEST / longest.fold(1e-30, f64::max)).min(1.0);
            let improved = [1.0, 0.5, 0.1, 0.01, 1e-3].into_iter().find_map(|share| {
                let (mut there, mut tried) = (state.clone(), places.clone());
                free.iter().zip(&step).for_each(|(&i, step)| there[i] += share * scale * step);
                let (now, held) = self.on_free(&outside, &mut there, &free, &mut tried)?;
                (norm(&now) < size).then_some((there, tried, now, held))
            });
            let Some(better) = improved else { break };
            (state, places, force, held) = better;
        }
        Some(Balance { state, held, left: norm(&force) })
    }

    /// Balls in balance where the rings are as the state says; force on what is free.
    fn on_free(
        &self,
        outside: &Outside,
        state: &mut [f64],
        free: &[usize],
        places: &mut [[f64; 2]],
    ) -> Option<(Vec<f64>, Held)> {
        let poses = [0, 1].map(|which| self.pose(which, outside, 0.0, state));
        let held = self.between(outside, &poses, places)?;
        for (j, [u, v]) in held.places.iter().enumerate() {
            let [e_r, _] = self.directions(outside, 0.0, j);
            let at = BALLS + 4 * j;
            state[at..at + 4].copy_from_slice(&[*u, dot(e_r, poses[1].velocity), *v, poses[1].velocity[2]]);
        }
        let force = free.iter().map(|&i| {
            let (which, a) = (i / OF_RING, i % OF_RING);
            let ring = &self.rings[which];
            let preload = if a == 2 { ring.preload * self.sense * [1.0, -1.0][which] } else { 0.0 };
            held.rings[which][a] + outside.rings[which][a][0] + preload - ring.stiffness[[0, 0, 1, 2, 2][a]] * state[i]
        });
        Some((force.collect(), held))
    }

    /// Balls in balance with the shaft held there (m, rad) and the housing at rest.
    pub fn held(&self, shaft: [f64; 5]) -> Option<Held> {
        let outside = self.outside([self.cage_start, 0.0, 0.0], &self.of_scene());
        let pose = Pose { position: [shaft[0], shaft[1], shaft[2]], tilt: [shaft[3], shaft[4]], ..Pose::default() };
        let mut places = vec![[0.0, 0.5 * shaft[2]]; self.count];
        self.between(&outside, &[pose, Pose::default()], &mut places)
    }

    /// Stiffness of the bearing: how its force and moment on the shaft fall with position and tilt of the shaft, about
    /// where it is; a fifth of a percent of an approach away, and twice that, so that what is left is of fourth order.
    pub fn stiffness(&self, shaft: [f64; 5]) -> Option<[[f64; 5]; 5]> {
        let mut found = [[0.0; 5]; 5];
        for column in 0..5 {
            let h = if column < 3 { 4e-8 } else { 2e-6 };
            let at = |by: f64| {
                let mut moved = shaft;
                moved[column] += by;
                self.held(moved).map(|held| held.rings[0])
            };
            let [near, far] = [[at(h)?, at(-h)?], [at(2.0 * h)?, at(-2.0 * h)?]];
            for (row, found) in found.iter_mut().enumerate() {
                let [short, long] = [near, far].map(|[up, down]| (up[row] - down[row]) / (2.0 * h));
                found[column] = -(4.0 * short - 0.5 * long) / 3.0;
            }
        }
        Some(found)
    }

    fn between(&self, outside: &Outside, poses: &[Pose; 2], places: &mut [[f64; 2]]) -> Option<Held> {
        let mut held = Held { balls: Vec::new(), places: Vec::new(), rings: [[0.0; 5]; 2], left: 0.0 };
        for (j, place) in places.iter_mut().enumerate() {
            let (ball, extra, left) = self.settled(outside, poses, j, place)?;
            for which in 0..2 {
                let touch = &ball.contacts[which];
                let moment = cross(touch.arm, touch.on_ball);
                let couple = extra[which];
                let at = add(touch.arm, times([-1.0, 1.0][which] * self.radius, normal(touch, which)));
                let with = cross(at, couple);
                for a in 0..3 {
                    held.rings[which][a] -= touch.on_ball[a] + couple[a];
                }
                for a in 0..2 {
                    held.rings[which][3 + a] -= moment[a] + with[a];
                }
            }
            held.left = held.left.max(left);
            held.places.push(*place);
            held.balls.push(ball);
        }
        Some(held)
    }

    /// One ball in balance, what gyroscopic forces do to it at both contacts, and what is left (N).
    fn settled(
        &self,
        outside: &Outside,
        poses: &[Pose; 2],
        j: usize,
        place: &mut [f64; 2],
    ) -> Option<(Ball, [Vector; 2], f64)> {
        let [e_r, _] = self.directions(outside, 0.0, j);
        let housing = poses[1].velocity;
        let omega = outside.turns[0][1];
        let at = |[u, v]: [f64; 2]| {
            let ball = self.ball(outside, 0.0, poses, j, [u, dot(e_r, housing), v, housing[2]]);
            let extra = self.gyroscopic_forces(outside, &ball, e_r);
            let pushes = add(ball.contacts[0].on_ball, ball.contacts[1].on_ball);
            let pushes = add(pushes, add(extra[0], extra[1]));
            let body = dot(self.gravity, e_r) + (self.rho_0 + u) * omega * omega;
            let force = [dot(pushes, e_r) + self.mass * body, pushes[2] + self.mass * self.gravity[2]];
            (force, ball, extra)
        };
        let (mut force, mut ball, mut extra) = at(*place);
        for _ in 0..500 {
            let size = force[0].hypot(force[1]);
            let scale = ball.contacts.iter().fold(1e-6, |m, touch| touch.force.max(m));
            if size <= 1e-14 * scale {
                break;
            }
            let quotient = |k: usize| {
                let h = 1e-10;
                let (mut up, mut down) = (*place, *place);
                (up[k], down[k]) = (up[k] + h, down[k] - h);
                let (up, down) = (at(up).0, at(down).0);
                [0, 1].map(|i| (up[i] - down[i]) / (2.0 * h))
            };
            let (of_u, of_v) = (quotient(0), quotient(1));
            let rows = vec![vec![of_u[0], of_v[0]], vec![of_u[1], of_v[1]]];
            // Loose between both raceways: outwards until one pushes.
            let step = solve(rows, &[-force[0], -force[1]]).unwrap_or(vec![force[0].signum() * LONGEST, 0.0]);
            let long = step[0].hypot(step[1]);
            let scale = (LONGEST / long).min(1.0);
            let tried = [1.0, 0.5, 0.25, 0.1, 0.03].map(|share| {
                let next = [place[0] + share * scale * step[0], place[1] + share * scale * step[1]];
                (next, at(next))
            });
            let better = tried.iter().find(|(_, found)| found.0[0].hypot(found.0[1]) < size);
            let Some((next, found)) = better.or(if size > 1e-9 * scale { tried.last() } else { None }) else { break };
            (*place, (force, ball, extra)) = (*next, *found);
        }
        let left = force[0].hypot(force[1]);
        left.is_finite().then_some((ball, extra, left))
    }

    /// Jones's forces λ M_g/D at the inner and the outer contact of a ball.
    fn gyroscopic_forces(&self, outside: &Outside, ball: &Ball, e_r: Vector) -> [Vector; 2] {
        let shares = match self.gyroscopic {
            Gyroscopic::Nobody => return [[0.0; 3]; 2],
            Gyroscopic::Outer => [0.0, 2.0],
            Gyroscopic::Shared => [1.0, 1.0],
        };
        let moment = self.gyroscopic_moment(outside.turns[1][1], outside.turns[0][1], ball);
        let [inner, outer] = ball.contacts.map(|touch| touch.angle.sin_cos());
        let push = |share: f64, radial: f64, axial: f64| {
            let size = share * moment / (2.0 * self.radius);
            add(times(size * radial, e_r), [0.0, 0.0, size * axial])
        };
        [push(shares[0], -inner.0, inner.1), push(shares[1], outer.0, -outer.1)]
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

/// From the ball towards the groove's circle inside, away from it outside.
fn normal(touch: &super::contact::Touch, _which: usize) -> Vector {
    let (sin, cos) = touch.angle.sin_cos();
    add(times(cos, touch.frame[0]), times(sin, touch.frame[1]))
}

fn norm(force: &[f64]) -> f64 {
    force.iter().map(|f| f * f).sum::<f64>().sqrt()
}

/// Whether the host moves a ring.
pub(super) fn is_hosted(bearing: &SpatialBearing, which: usize) -> bool {
    bearing.rings[which].motion == Motion::Host
}
