//! Dormand and Prince's Runge–Kutta pair of fifth order with the error of every step below a tolerance, cut where an
//! outer contact comes to a corner of its path.

use super::bearing::{Acting, BALLS, OF_RING, Outside, SpatialBearing};
use super::case::Host;
use super::statics::is_hosted;
use super::vector::dot;
use crate::case::Motion;
use crate::turning::{HOUSING, SHAFT, quadratic};

const NODES: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];
const WEIGHTS: [[f64; 6]; 6] = [
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
/// Of the difference from the solution of fourth order.
const ERROR: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339_200.0, 22.0 / 525.0, -1.0 / 40.0];

/// Why a run ended early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stop {
    /// More steps than allowed.
    Budget,
    /// A ball or a ring has left the bearing.
    Left,
    /// A ball without inertia is nowhere in balance, or not found.
    Lost,
}

impl SpatialBearing {
    /// What acts, and the rates of the state.
    pub(super) fn rates(&self, outside: &Outside, t: f64, y: &[f64], out: &mut [f64], acting: &mut Acting) {
        let poses = [0, 1].map(|which| self.pose(which, outside, t, y));
        let [_, omega, _] = quadratic(outside.turns[0], t);
        acting.balls.clear();
        acting.rings = [[0.0; 5]; 2];
        for j in 0..self.count {
            let at = BALLS + 4 * j;
            let of: [f64; 4] = std::array::from_fn(|k| y[at + k]);
            let ball = if self.inertia {
                let ball = self.ball((outside, t), &poses, j, of, self.dampers);
                let ([e_r, e_t], force) = (self.directions(outside, t, j), ball.force());
                let (housing, rho) = (poses[1].velocity, self.rho_0 + of[0]);
                out[at] = of[1] - dot(e_r, housing);
                out[at + 1] =
                    dot(force, e_r) / self.mass + dot(self.gravity, e_r) + omega * (dot(housing, e_t) + rho * omega);
                out[at + 2] = of[3] - housing[2];
                out[at + 3] = force[2] / self.mass + self.gravity[2];
                ball
            } else {
                // What it is in balance with has no part in the error of a step.
                out[at..at + 4].fill(0.0);
                self.following((outside, t), &poses, j, [of[0], of[2]])
            };
            for (which, touch) in ball.contacts.iter().enumerate() {
                let of_ring = touch.on_ring();
                (0..5).for_each(|a| acting.rings[which][a] += of_ring[a]);
            }
            acting.balls.push(ball);
        }
        for which in 0..2 {
            self.ring_rates(which, outside, t, y, out, acting);
        }
    }

    fn ring_rates(&self, which: usize, outside: &Outside, t: f64, y: &[f64], out: &mut [f64], acting: &mut Acting) {
        let (ring, at) = (&self.rings[which], OF_RING * which);
        out[at..at + OF_RING].fill(0.0);
        let spin = quadratic(outside.turns[1 + which], t)[1];
        for a in self.free(which) {
            let kind = [0, 0, 1, 2, 2][a];
            let mut force = acting.rings[which][a] + quadratic(outside.rings[which][a], t)[0];
            force -= ring.damping[kind] * y[at + 5 + a] + ring.stiffness[kind] * y[at + a];
            if a == 2 {
                force += ring.preload * self.sense * if which == 0 { 1.0 } else { -1.0 };
            }
            let gyroscopic = ring.inertia[1] * spin;
            force += match a {
                3 => -gyroscopic * y[at + 5 + 4],
                4 => gyroscopic * y[at + 5 + 3],
                _ => 0.0,
            };
            let inertia = if a < 3 { ring.mass } else { ring.inertia[0] };
            out[at + a] = y[at + 5 + a];
            out[at + 5 + a] = force / inertia;
            acting.accelerations[which][a] = force / inertia;
        }
        if ring.motion == Motion::Host {
            acting.accelerations[which] = outside.rings[which].map(|c| c[2]);
        }
    }
}

/// One run.
pub struct SpatialRun<'a> {
    pub bearing: &'a SpatialBearing,
    pub y: Vec<f64>,
    outside: Outside,
    pub acting: Acting,
    /// Error of a position in a step (m).
    tolerance: f64,
    budget: usize,
    h: f64,
}

impl<'a> SpatialRun<'a> {
    /// From a state, with so many steps at most.
    pub fn new(
        bearing: &'a SpatialBearing,
        y: Vec<f64>,
        host: Option<&Host>,
        rings_deg: [f64; 2],
        tolerance: f64,
        budget: usize,
    ) -> Self {
        let mut outside = bearing.first(host);
        (outside.turns[SHAFT][0], outside.turns[HOUSING][0]) = (rings_deg[0].to_radians(), rings_deg[1].to_radians());
        let mut run = Self { bearing, y, outside, acting: Acting::default(), tolerance, budget, h: 1e-7 };
        run.feel(0.0);
        run
    }

    /// What acts so long after the start of the step.
    fn feel(&mut self, t: f64) {
        let mut rates = vec![0.0; self.y.len()];
        self.bearing.rates(&self.outside, t, &self.y, &mut rates, &mut self.acting);
        self.keep_places();
    }

    /// Balls without inertia are looked for from where they were.
    fn keep_places(&mut self) {
        if !self.bearing.inertia {
            for (j, ball) in self.acting.balls.iter().enumerate() {
                [self.y[BALLS + 4 * j], self.y[BALLS + 4 * j + 2]] = ball.place;
            }
        }
    }

    /// Angle of the cage now (rad).
    pub fn cage_angle(&self) -> f64 {
        self.outside.turns[0][0]
    }

    fn say(&mut self, host: Option<&Host>) {
        let angles = self.outside.turns.map(|turn| turn[0]);
        let Some(host) = host else {
            self.outside.turns.iter_mut().for_each(|turn| turn[2] = 0.0);
            for which in (0..2).filter(|&which| !is_hosted(self.bearing, which)) {
                self.outside.rings[which].iter_mut().for_each(|load| *load = [load[0], 0.0, 0.0]);
            }
            return;
        };
        self.outside = self.bearing.outside(angles, host);
    }

    /// Takes a communication step.
    pub fn step(&mut self, length: f64, host: Option<&Host>) -> Result<(), Stop> {
        self.say(host);
        let mut cuts = self.bearing.surfaces.passages(&self.outside.turns, length);
        cuts.retain(|&cut| cut > 1e-12 && cut < length - 1e-12);
        cuts.push(length);
        let mut from = 0.0;
        for to in cuts {
            self.smooth(from, to)?;
            from = to;
        }
        self.outside.turns = self.outside.turns.map(|turn| quadratic(turn, length));
        self.outside.rings = self.outside.rings.map(|ring| ring.map(|c| quadratic(c, length)));
        self.feel(0.0);
        Ok(())
    }

    fn smooth(&mut self, from: f64, to: f64) -> Result<(), Stop> {
        let n = self.y.len();
        let mut stages = vec![vec![0.0; n]; 7];
        let (mut t, mut at) = (from, vec![0.0; n]);
        // A force sets in again behind a cut.
        self.h = self.h.min(1e-7);
        while t < to {
            if self.budget == 0 {
                return Err(Stop::Budget);
            }
            self.budget -= 1;
            // Where nothing else moves, a ball without inertia is not to be looked for too far from where it was.
            if !self.bearing.inertia {
                self.h = self.h.min(1e-5);
            }
            let last = t + 1.0001 * self.h >= to;
            let h = if last { to - t } else { self.h };
            for stage in 0..7 {
                for i in 0..n {
                    let sum: f64 = (0..stage).map(|k| WEIGHTS[stage - 1][k] * stages[k][i]).sum();
                    at[i] = self.y[i] + h * sum;
                }
                self.bearing.rates(&self.outside, t + NODES[stage] * h, &at, &mut stages[stage], &mut self.acting);
            }
            let worst = (0..n).map(|i| {
                let off: f64 = (0..7).map(|k| ERROR[k] * stages[k][i]).sum();
                (h * off).abs() / self.limit(i)
            });
            let worst = worst.fold(0.0f64, |m, off| if off.is_finite() { m.max(off) } else { f64::INFINITY });
            if worst <= 1.0 {
                self.y.copy_from_slice(&at);
                self.keep_places();
                t = if last { to } else { t + h };
                self.check()?;
            } else if h < 1e-18 {
                return Err(Stop::Lost);
            }
            self.h = h * (0.9 * worst.max(1e-9).powf(-0.2)).clamp(0.2, if worst <= 1.0 { 5.0 } else { 0.9 });
        }
        Ok(())
    }

    /// What one number may be off by: tilts move balls by their pitch radius, velocities change in 10 µs.
    fn limit(&self, i: usize) -> f64 {
        let fast = if i < BALLS { i % 10 >= 5 } else { i % 2 == 1 };
        let tilts = i < BALLS && i % 5 >= 3;
        self.tolerance * if fast { 1e5 } else { 1.0 } * if tilts { 50.0 } else { 1.0 }
    }

    fn check(&self) -> Result<(), Stop> {
        let r = self.bearing.radius;
        let far = (0..self.bearing.count).any(|j| self.y[BALLS + 4 * j].abs().max(self.y[BALLS + 4 * j + 2].abs()) > r);
        if far {
            return Err(Stop::Left);
        }
        if self.y.iter().all(|y| y.is_finite()) { Ok(()) } else { Err(Stop::Lost) }
    }

    /// u and v of a ball.
    pub fn place(&self, j: usize) -> [f64; 2] {
        self.acting.balls[j].place
    }

    /// Position and tilt of a ring that moves by itself.
    pub fn ring(&self, which: usize) -> [f64; 5] {
        std::array::from_fn(|a| self.y[10 * which + a])
    }
}
