//! Balances: balls between rings that are held, free rings under loads, and the stiffness of the whole.
//!
//! The free rings are balanced by Newton's steps with a Jacobian of difference quotients, the balls in balance at every
//! try. What dampers do at the speed of the cage counts, as in motion.

use super::bearing::{BALLS, Ball, OF_RING, Outside, SpatialBearing};
use super::case::Host;
use super::contact::{Dampers, Pose};
use super::vector::dot;
use crate::case::Motion;
use crate::elimination::solve;

/// Longest step of a ring (m).
const LONGEST: f64 = 10e-6;

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
    /// The balance at the start, looked for from where a shaft that goes along its axial load has closed the bearing
    /// and is pressed into it.
    pub fn rest(&self, host: Option<&Host>) -> Option<Balance> {
        let (load, [inner, outer]) = (self.rings[0].load[2], &self.grooves);
        let (apart, radial) = (inner.touching + outer.touching, inner.circle - outer.circle);
        let closed = (apart * apart - radial * radial).max(0.0).sqrt();
        let pressed = 4.0 * (load.abs() / (self.count as f64 * inner.stiffness)).cbrt().powi(2);
        let housing = self.pose(1, &self.first(host), 0.0, &vec![0.0; self.state_count()]).position[2];
        let z = housing + outer.shift - inner.shift + (closed + pressed).copysign(load);
        self.balance(host, [0.0, 0.0, z, 0.0, 0.0])
    }

    /// Where balls are looked for: between the circles of both grooves.
    fn middle(&self, poses: &[Pose; 2]) -> Vec<[f64; 2]> {
        let z = [0, 1].map(|side| poses[side].position[2] + self.grooves[side].shift);
        vec![[0.0, 0.5 * (z[0] + z[1])]; self.count]
    }

    /// The balance of the free rings under what the host says at the start, looked for from `guess`, the position and
    /// tilt of the shaft; `None` where none is found.
    pub fn balance(&self, host: Option<&Host>, guess: [f64; 5]) -> Option<Balance> {
        let mut outside = self.first(host);
        // At the start nothing has turned, nor do derivatives of speeds count.
        outside.turns.iter_mut().for_each(|turn| turn[2] = 0.0);
        let mut state = vec![0.0; self.state_count()];
        let free: Vec<usize> = (0..2).flat_map(|which| self.free(which).map(move |a| OF_RING * which + a)).collect();
        for a in self.free(0) {
            state[a] = guess[a];
        }
        let mut places = self.middle(&[0, 1].map(|which| self.pose(which, &outside, 0.0, &state)));
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
            let scale = (LONGEST / longest.fold(1e-30, f64::max)).min(1.0);
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
        let outside = self.first(None);
        let pose = Pose { position: [shaft[0], shaft[1], shaft[2]], tilt: [shaft[3], shaft[4]], ..Pose::default() };
        let poses = [pose, Pose::default()];
        self.between(&outside, &poses, &mut self.middle(&poses))
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

    /// Balls in balance between rings at the start of a step; those without inertia where their contacts' dampers leave
    /// them.
    fn between(&self, outside: &Outside, poses: &[Pose; 2], places: &mut [[f64; 2]]) -> Option<Held> {
        let mut held = Held { balls: Vec::new(), places: Vec::new(), rings: [[0.0; 5]; 2], left: 0.0 };
        for (j, place) in places.iter_mut().enumerate() {
            let dampers = if self.inertia { self.dampers } else { Dampers::NONE };
            let (mut ball, left) = self.settled((outside, 0.0), poses, j, *place, dampers)?;
            if !self.inertia {
                ball = self.following((outside, 0.0), poses, j, ball.place);
            }
            for which in 0..2 {
                let of_ring = ball.contacts[which].on_ring();
                (0..5).for_each(|a| held.rings[which][a] += of_ring[a]);
            }
            *place = ball.place;
            held.left = held.left.max(left);
            held.places.push(*place);
            held.balls.push(ball);
        }
        Some(held)
    }
}

fn norm(force: &[f64]) -> f64 {
    force.iter().map(|f| f * f).sum::<f64>().sqrt()
}

/// Whether the host moves a ring.
pub(super) fn is_hosted(bearing: &SpatialBearing, which: usize) -> bool {
    bearing.rings[which].motion == Motion::Host
}
