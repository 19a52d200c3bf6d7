//! Classical Runge–Kutta steps of one length, cut where an element comes to touch another feature and where a contact
//! begins or ceases to push. After such a change of contact, and at each communication point, the steps begin small and
//! grow, because a force sets in as δ^1.5 or √δ.

use crate::bearing::Bearing;
use crate::case::{Host, Motion};
use crate::growth::Growth;
use crate::instant::{Acting, ELEMENTS, Outside, SENSOR};
use crate::signals;
use crate::surface::Stretches;
use crate::turning::quadratic;
use std::f64::consts::{PI, TAU};

/// Why a run ended early.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stop {
    /// More steps than allowed.
    Budget,
    /// An element or a ring has left the bearing.
    Left,
    /// The steps were too long: the state is no longer finite.
    Lost,
}

/// One run of the oracle.
pub struct Run<'a> {
    bearing: &'a Bearing,
    pub y: Vec<f64>,
    pub outside: Outside,
    pub acting: Acting,
    /// Those that contacts are in.
    pub stretches: Vec<Stretches>,
    /// Largest approach in any inner and any outer contact so far (m).
    pub largest: [f64; 2],
    pace: Pace,
    left: usize,
    stages: [Vec<f64>; 5],
}

/// How fast a run goes.
#[derive(Debug, Clone, Copy)]
pub struct Pace {
    /// Longest step (s).
    pub h: f64,
    /// Steps at least between two passages; eight times as many in a communication step.
    pub fewest: u32,
    /// Steps at most in all.
    pub budget: usize,
}

impl Pace {
    /// No step at all.
    pub const STANDING: Self = Self { h: 1.0, fewest: 1, budget: 0 };

    /// With twice as many steps wherever there are any.
    pub fn halved(self) -> Self {
        Self { h: 0.5 * self.h, fewest: 2 * self.fewest, budget: 2 * self.budget }
    }
}

impl<'a> Run<'a> {
    /// From a state.
    pub fn new(bearing: &'a Bearing, y: Vec<f64>, host: Option<&Host>, pace: Pace) -> Self {
        let loads = [0, 1].map(|which| bearing.rings[which].load.map(|load| [load, 0.0, 0.0]));
        let speeds = bearing.speeds.map(|speed| [speed, 0.0]);
        let Host { speeds, rings } = *host.unwrap_or(&Host { speeds, rings: loads });
        let (len, turns) = (bearing.state_count(), bearing.turning(bearing.starts, speeds));
        let mut run = Self {
            bearing,
            y,
            outside: Outside { turns, rings },
            acting: Acting::default(),
            stretches: vec![[[0; 2]; 2]; bearing.count],
            largest: [0.0; 2],
            pace,
            left: pace.budget,
            stages: std::array::from_fn(|_| vec![0.0; len]),
        };
        run.feel(0.0, 0.0);
        run
    }

    /// What the outer contacts touch at one time, the inner ones now, and what then acts at time `t` into the step.
    pub fn feel(&mut self, t: f64, outer_at: f64) {
        self.bearing.stretches(&self.outside, outer_at, &self.y, [false, true], &mut self.stretches);
        self.bearing.stretches(&self.outside, t, &self.y, [true, false], &mut self.stretches);
        self.evaluate(t);
    }

    /// Derivative of the present state into stage 0, and what acts.
    fn evaluate(&mut self, t: f64) {
        let Self { bearing, y, outside, acting, stretches, stages, .. } = self;
        bearing.rates(outside, t, y, stretches, &mut stages[0], acting);
        for contacts in &acting.contacts {
            for side in 0..2 {
                self.largest[side] = self.largest[side].max(contacts[side].approach);
            }
        }
    }

    /// The signals now, after a communication step of this length, in the order of [`signals::signals`].
    pub fn values(&self, length: f64) -> Vec<f64> {
        signals::values(self.bearing, &self.y, &self.outside, &self.acting, length)
    }

    pub fn bearing(&self) -> &Bearing {
        self.bearing
    }

    /// The present derivative.
    pub fn rates(&self) -> &[f64] {
        &self.stages[0]
    }

    /// Acceleration with which the outer ring carries element `j` outwards (m/s²): no balance counts the host's, nor
    /// that of a light ring by the little that is left of its own balance.
    pub fn carried(&self, j: usize) -> f64 {
        let (sin, cos) = (self.outside.turns[0][0] + TAU * j as f64 / self.bearing.count as f64).sin_cos();
        self.acting.accelerations[1][0] * cos + self.acting.accelerations[1][1] * sin
    }

    /// The host's doing before a step.
    fn host(&mut self, host: Option<&Host>) {
        let before = self.outside.rings[1];
        match host {
            Some(host) => {
                self.outside.turns = self.bearing.turning(self.outside.turns.map(|turn| turn[0]), host.speeds);
                self.outside.rings = host.rings;
            }
            None => {
                self.outside.turns.iter_mut().for_each(|turn| turn[2] = 0.0);
                for which in 0..2 {
                    for a in 0..2 {
                        if self.bearing.rings[which].motion == Motion::Internal {
                            self.outside.rings[which][a] = [self.outside.rings[which][a][0], 0.0, 0.0];
                        }
                    }
                }
            }
        }
        if self.bearing.rings[1].motion == Motion::Host {
            let jump = [0, 1].map(|a| self.outside.rings[1][a][1] - before[a][1]);
            for j in 0..self.bearing.count {
                let (sin, cos) = (self.outside.turns[0][0] + TAU * j as f64 / self.bearing.count as f64).sin_cos();
                self.y[ELEMENTS + 2 * j + 1] -= jump[0] * cos + jump[1] * sin;
            }
        }
    }

    /// Takes a communication step; the signals at its end.
    pub fn step(&mut self, length: f64, host: Option<&Host>) -> Result<Vec<f64>, Stop> {
        self.host(host);
        let impulses = ELEMENTS + 2 * self.bearing.count;
        self.y[impulses..impulses + 4].fill(0.0);
        let mut from = 0.0;
        for to in self.passages(length) {
            self.feel(from, 0.5 * (from + to));
            self.smooth(length, from, to)?;
            from = to;
        }
        self.outside.turns = self.outside.turns.map(|turn| quadratic(turn, length));
        self.outside.rings = self.outside.rings.map(|ring| ring.map(|c| quadratic(c, length)));
        Ok(self.values(length))
    }

    /// Times within a step at which an outer contact comes to touch another feature, ascending, and its end.
    fn passages(&self, length: f64) -> Vec<f64> {
        let mut times = vec![length];
        let motions = self.bearing.motions(&self.outside, 0.0, &self.y);
        let cage = self.outside.turns[0];
        for j in 0..self.bearing.count {
            for surface in self.bearing.surfaces(1, j).into_iter().flatten() {
                let seat = self.bearing.seat(j, cage, &motions, &self.y);
                let start = surface.psi(seat.turning(1, &self.outside.turns)[0], &self.outside.turns);
                let frame = self.outside.turns[surface.frame];
                let past = [0.0, cage[1] - frame[1], cage[2] - frame[2]];
                crossings(past, start, &surface.envelope.changes, length, &mut times);
            }
        }
        times.retain(|&t| t > 0.0 && t <= length);
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Integrates between two passages of a communication step.
    fn smooth(&mut self, step: f64, from: f64, to: f64) -> Result<(), Stop> {
        let Pace { h, fewest, .. } = self.pace;
        let longest = h.min(step / f64::from(8 * fewest)).min((to - from) / f64::from(fewest));
        let (mut t, mut since) = (from, if from == 0.0 { 0.0 } else { f64::INFINITY });
        while t < to {
            if self.left == 0 {
                return Err(Stop::Budget);
            }
            // A part of the time since, so that these steps are halved as well.
            let wanted = longest.min((longest / 1024.0).max(since / f64::from(fewest)));
            let remaining = to - t;
            let count = (remaining / wanted).ceil();
            let h = if count <= 1.0 { remaining } else { (remaining / count).min(wanted) };
            let (start, touching) = (self.y.clone(), self.touching(t));
            let slope = self.stages[0].clone();
            self.runge_kutta(&start, &slope, t, h);
            self.evaluate(t + h);
            let after = self.touching(t + h);
            if after == touching {
                t = if count <= 1.0 { to } else { t + h };
                since += h;
            } else {
                let corner = after.inner != touching.inner || after.over != touching.over;
                let halvings = if corner { 40 } else { self.onset_halvings() };
                let share = self.first_change(&start, &slope, &touching, halvings, t, h);
                self.runge_kutta(&start, &slope, t, share * h);
                t = if share == 1.0 && count <= 1.0 { to } else { t + share * h };
                self.bearing.stretches(&self.outside, t, &self.y, [true, false], &mut self.stretches);
                self.evaluate(t);
                since = 0.0;
            }
            self.check(t)?;
        }
        Ok(())
    }

    /// A force that sets in with δ^(10/9), or turns at once, as oil's does, is met more exactly than one with δ^1.5.
    fn onset_halvings(&self) -> u32 {
        let point = matches!(self.bearing.growth[0], Growth::Point(_));
        if point && self.bearing.oil.is_none() { 10 } else { 30 }
    }

    /// What the contacts do at time `t` into the step.
    fn touching(&self, t: f64) -> Touching {
        let pushing = self
            .acting
            .contacts
            .iter()
            .map(|contacts| contacts.map(|contact| [contact.pushes, contact.squeezes]))
            .collect();
        let over = self.acting.contacts.iter().map(|contacts| contacts.map(|contact| contact.over)).collect();
        let mut inner = vec![[[0; 2]; 2]; self.bearing.count];
        self.bearing.stretches(&self.outside, t, &self.y, [true, false], &mut inner);
        Touching { pushing, over, inner }
    }

    /// Share of a step by which the first contact has just changed, to so many halvings. What is left of the step
    /// behind the change of a force that begins there with its power of 1.5 is a thousandth; a corner turns the force
    /// at once.
    fn first_change(
        &mut self,
        start: &[f64],
        slope: &[f64],
        touching: &Touching,
        halvings: u32,
        t: f64,
        h: f64,
    ) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..halvings {
            let middle = 0.5 * (low + high);
            self.runge_kutta(start, slope, t, middle * h);
            self.evaluate(t + middle * h);
            if self.touching(t + middle * h) == *touching { low = middle } else { high = middle }
        }
        high
    }

    /// One step from `start`, where the derivative is `slope`, into the state.
    fn runge_kutta(&mut self, start: &[f64], slope: &[f64], t: f64, h: f64) {
        let Self { bearing, y, outside, acting, stretches, stages, .. } = self;
        self.left = self.left.saturating_sub(1);
        let [_, k2, k3, k4, at] = stages;
        let mut stage = |share: f64, k: &[f64], out: &mut [f64]| {
            for (at, (y, k)) in at.iter_mut().zip(start.iter().zip(k)) {
                *at = y + share * h * k;
            }
            bearing.rates(outside, t + share * h, at, stretches, out, acting);
        };
        stage(0.5, slope, k2);
        stage(0.5, k2, k3);
        stage(1.0, k3, k4);
        for i in 0..y.len() {
            y[i] = start[i] + h / 6.0 * (slope[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
        }
    }

    /// The limits beyond which the simulation is to give up.
    fn check(&self, t: f64) -> Result<(), Stop> {
        let position = |which: usize, a: usize| match self.bearing.rings[which].motion {
            Motion::Internal => self.y[4 * which + a],
            Motion::Host => quadratic(self.outside.rings[which][a], t)[0],
            Motion::Fixed => 0.0,
        };
        let offset = (position(1, 0) - position(0, 0)).hypot(position(1, 1) - position(0, 1));
        let far = (0..self.bearing.count).any(|j| self.y[ELEMENTS + 2 * j].abs() > self.bearing.r);
        if !self.y.iter().all(|y| y.is_finite()) {
            return Err(Stop::Lost);
        }
        if far || offset > self.bearing.r { Err(Stop::Left) } else { Ok(()) }
    }

    /// The state with positions and velocities moved by so much, up and down in turn.
    pub fn moved(bearing: &Bearing, y: &[f64], position: f64, velocity: f64) -> Vec<f64> {
        let mut moved = y.to_vec();
        let mut up = position;
        for (which, ring) in bearing.rings.iter().enumerate().filter(|(_, ring)| ring.motion == Motion::Internal) {
            for a in 0..2 {
                // A ring whose velocity changes in a step: 1e-12 kg have no business here.
                debug_assert!(ring.mass > 0.0);
                moved[4 * which + a] += up;
                moved[4 * which + 2 + a] -= up / position * velocity;
                up = -up;
            }
        }
        if bearing.sensor.is_some() {
            moved[SENSOR] += position;
        }
        for j in 0..bearing.count {
            // No two neighbours, nor opposite ones, alike.
            let part = ((j as f64 + 0.5) * PI * 0.618).sin();
            moved[ELEMENTS + 2 * j] += position * part;
            moved[ELEMENTS + 2 * j + 1] += velocity * part;
        }
        moved
    }
}

/// What contacts do: which push and press out oil, whose defects they are over, and in which stretches the inner ones
/// are.
#[derive(PartialEq)]
struct Touching {
    pushing: Vec<[[bool; 2]; 2]>,
    over: Vec<[Option<usize>; 2]>,
    inner: Vec<Stretches>,
}

/// Times up to `length` at which an angle that begins at `start` and changes by a quadratic comes to one of `changes`.
fn crossings(past: [f64; 3], start: f64, changes: &[f64], length: f64, times: &mut Vec<f64>) {
    // It goes one way before and after it reverses.
    let reversal = -past[1] / past[2];
    let turn = if reversal > 0.0 && reversal < length { reversal } else { 0.0 };
    for (from, to) in [(0.0, turn), (turn, length)] {
        if to <= from {
            continue;
        }
        let ends = [from, to].map(|t| quadratic(past, t)[0]);
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        for change in changes {
            let mut angle = change - start;
            angle += TAU * ((low - angle) / TAU).ceil();
            while angle < high {
                times.push(when(past, angle, (from, to)));
                angle += TAU;
            }
        }
    }
}

/// When a quadratic has come to an angle, within times between which it goes one way.
fn when(past: [f64; 3], angle: f64, (mut low, mut high): (f64, f64)) -> f64 {
    let turned = |t: f64| quadratic(past, t)[0] - angle;
    let rising = turned(high) > turned(low);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if (turned(middle) < 0.0) == rising { low = middle } else { high = middle }
    }
    high
}
