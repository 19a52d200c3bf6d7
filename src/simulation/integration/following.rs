//! Sensors that a step moves on exactly, beside the method that integrates all else
//! ([`FollowedSensor`]).
//!
//! The method is given derivatives with every sensor held against the outer ring. What the equations are asked at is
//! the state with sensors where they are by then.

use super::workspace::{Span, Workspace, step_ends};
use crate::dynamics::parameters::{FollowedSensor, Forcing, MOST_FOLLOWED, Model, Swing};
use crate::numerics::lanes::row::Row;
use crate::simulation::integration::methods::{LAST, StageBuffers};

/// Points that a cubic goes through.
const POINTS: usize = 4;
/// Smallest tolerance at which sensors are followed: at 1e-6 what contacts feel of a sensor too late is the largest
/// error, and steps are hardly longer than a sensor's stability allows.
const LOOSE: f64 = 1e-5;
/// By which errors count more than where a sensor's stability limits steps. That kept them below what the tolerance
/// says; with this a tolerance gives 0.5 to 2.8 times the errors of the outer ring's velocity that it gave then, and
/// smaller ones of accelerations (docs/how-to/quasi-static.md).
const STRICTER: f64 = 4.0;

/// The sensors on their way through a step that is being tried.
#[derive(Debug)]
pub(super) struct Following<'a> {
    sensors: &'a [FollowedSensor],
    nodes: [f64; LAST],
    length: f64,
    /// Share of the step at which `swings` are.
    at: f64,
    swings: [Swing; MOST_FOLLOWED],
    /// Stages so far: share of the step and each sensor's forcing there.
    known: [(f64, [f64; MOST_FOLLOWED]); LAST + 1],
    count: usize,
    /// A state with sensors where they are.
    placed: &'a mut [f64],
}

impl<'a> Following<'a> {
    /// From the start of a step on. Holds sensors in the first stage.
    #[inline(never)]
    pub(super) fn begin(
        model: &'a Model,
        nodes: [f64; LAST],
        length: f64,
        state: &[f64],
        first: &mut [f64],
        placed: &'a mut Row,
    ) -> Self {
        let sensors = &model.followed[..];
        let mut following = Self {
            sensors,
            nodes,
            length,
            at: 0.0,
            swings: [[0.0; 2]; MOST_FOLLOWED],
            known: Default::default(),
            count: 0,
            placed,
        };
        for (swing, sensor) in following.swings.iter_mut().zip(sensors) {
            *swing = sensor.swing(state);
        }
        following.note(first);
        following
    }

    /// The state of a stage with sensors where they are; positions in it are still to be moved on for the time `ahead`.
    #[inline(never)]
    pub(super) fn place(&mut self, stage: usize, ahead: Option<f64>, state: &[f64]) -> &[f64] {
        let share = self.nodes[stage.min(LAST - 1)];
        self.placed.copy_from_slice(state);
        let known = &self.known[self.count.saturating_sub(POINTS)..self.count];
        for (k, (sensor, swing)) in self.sensors.iter().zip(&mut self.swings).enumerate() {
            let forcing = through(known.iter().map(|(share, of)| [*share, of[k]]));
            *swing = sensor.follow(forcing, self.length, [self.at, share], *swing);
            sensor.put(*swing, ahead.unwrap_or(0.0), self.placed);
        }
        self.at = share;
        self.placed
    }

    /// Notes what a stage's derivative says, and holds sensors in it.
    #[inline(never)]
    pub(super) fn note(&mut self, derivative: &mut [f64]) {
        self.known[self.count].0 = self.at;
        for (forcing, sensor) in self.known[self.count].1.iter_mut().zip(self.sensors) {
            *forcing = sensor.forcing(derivative);
            sensor.put([0.0; 2], 0.0, derivative);
        }
        self.count += 1;
    }

    /// Puts sensors at the end of the step. Gives the largest error (m) of what the method integrated, of which it says
    /// `error`, and of the outer ring's place as contacts felt it. The derivatives at both ends still hold sensors, as
    /// the next step wants them.
    #[inline(never)]
    pub(super) fn finish(self, buffers: &mut StageBuffers, state: &[f64], error: f64) -> f64 {
        let mut largest = STRICTER * error;
        for (sensor, tried) in self.sensors.iter().zip(self.swings) {
            let start = sensor.swing(state);
            let forcing = sensor.forcing_over(step_ends(buffers, state, self.length));
            let end = sensor.follow(forcing, self.length, [0.0, 1.0], start);
            largest = largest.max(sensor.felt(end[0] - tried[0]).abs());
            sensor.put(end, 0.0, &mut buffers.end);
        }
        largest
    }
}

/// Chooses whether the steps that come follow sensors.
pub(super) fn choose(workspace: &mut Workspace, model: &Model, tolerance: f64) {
    workspace.follows = !model.followed.is_empty() && tolerance >= LOOSE;
    workspace.jacobian.follows_sensors = workspace.follows;
}

/// Puts sensors that are followed into the state at a share of the step tried last.
pub(super) fn place_within(workspace: &mut Workspace, model: &Model, span: Span, share: f64, start: &[f64]) {
    let Workspace { buffers, dense, follows, .. } = workspace;
    for sensor in model.followed.iter().filter(|_| *follows) {
        let forcing = sensor.forcing_over(step_ends(buffers, start, span.length));
        let swing = sensor.follow(forcing, span.length, [0.0, share], sensor.swing(start));
        sensor.put(swing, 0.0, dense);
    }
}

/// The polynomial of least degree through points, by Newton's divided differences.
fn through(points: impl Iterator<Item = [f64; 2]>) -> Forcing {
    let (mut at, mut differences, mut count) = ([0.0; POINTS], [0.0; POINTS], 0);
    for [share, value] in points {
        (at[count], differences[count]) = (share, value);
        count += 1;
    }
    for order in 1..count {
        for i in (order..count).rev() {
            differences[i] = (differences[i] - differences[i - 1]) / (at[i] - at[i - order]);
        }
    }
    let mut polynomial = [0.0; POINTS];
    for i in (0..count).rev() {
        for k in (1..POINTS).rev() {
            polynomial[k] = polynomial[k - 1] - at[i] * polynomial[k];
        }
        polynomial[0] = differences[i] - at[i] * polynomial[0];
    }
    polynomial
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_polynomial_goes_through_its_points() {
        let cubic = |s: f64| 2.0 + s * (-3.0 + s * (0.5 + s * 4.0));
        let points = [0.0, 0.28, 0.39, 0.84].map(|s| [s, cubic(s)]);
        for count in 1..=POINTS {
            let [a, b, c, d] = through(points[..count].iter().copied());
            assert!(points[..count].iter().all(|[s, value]| (a + s * (b + s * (c + s * d)) - value).abs() < 1e-13));
            assert!([b, c, d].iter().skip(count - 1).all(|&beyond| beyond == 0.0));
        }
    }
}
