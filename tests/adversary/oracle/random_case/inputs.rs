//! What the host of a random scene feeds, communication step by communication step.

use super::scale::Scale;
use crate::case::{Case, Host, Motion};
use crate::draw::Draw;
use std::f64::consts::TAU;

/// What the host feeds.
pub(super) struct Inputs {
    internal: [bool; 2],
    /// Around which a ring's input moves, how far, and how fast (1/s).
    middle: [[f64; 2]; 2],
    swing: [[f64; 2]; 2],
    rate: f64,
    phase: f64,
    time: f64,
    /// Speeds at the start and now; the outer ring's if it turns.
    start: [f64; 2],
    speeds: [f64; 2],
    turns: bool,
}

impl Inputs {
    pub(super) fn new(draw: &mut Draw, case: &Case, scale: &Scale, time: f64) -> Self {
        let internal = case.rings.map(|ring| ring.motion == Motion::Internal);
        let half = 0.5 * case.clearance_um * 1e-6;
        let push = half + 1.5 * scale.approach * draw.between(0.1, 1.0);
        let mut middle = [[0.0; 2]; 2];
        let mut swing = [[0.0; 2]; 2];
        let moves = draw.chance(0.7);
        for which in 0..2 {
            middle[which] = if internal[which] {
                case.rings[which].load
            } else if case.rings[which].motion == Motion::Host {
                let size = push.min(9e-3) * if internal[1 - which] { draw.unit() } else { 0.5 };
                draw.vector(size)
            } else {
                [0.0; 2]
            };
            let size = middle[which][0].hypot(middle[which][1]);
            let part = if internal[which] { size } else { scale.approach.min(5e-4) };
            let size = if moves { part * draw.log(0.01, 1.0) } else { 0.0 };
            swing[which] = draw.vector(size);
        }
        if case.rings.iter().all(|ring| ring.motion != Motion::Internal) {
            // Both rings are moved or held: let them press somewhere.
            let size = push.min(9e-3);
            middle[0] = draw.vector(size);
            middle[1] = [0.0; 2];
        }
        let rate = draw.log(0.3, 30.0) / time;
        let (start, turns) =
            ([case.speed_hz, case.housing_hz.unwrap_or(0.0)].map(|hz| hz * TAU), case.housing_hz.is_some());
        let phase = draw.between(0.0, TAU);
        Self { internal, middle, swing, rate, phase, time: 0.0, start, speeds: start, turns }
    }

    /// Speed of a ring before a step of this length and its slope.
    fn speed(&mut self, draw: &mut Draw, way: &str, which: usize, length: f64) -> [f64; 2] {
        let (start, speed) = (self.start[which], &mut self.speeds[which]);
        let slope = match way {
            "ramp" => start * draw.between(-0.5, 0.5) / length,
            // Stands still somewhere within the step, or has not quite by its end.
            "reversal" => -*speed / length * draw.between(0.5, 3.0),
            _ => 0.0,
        };
        if way == "jumps" && draw.chance(0.5) {
            *speed = start * draw.between(-1.0, 1.0);
        }
        let before = *speed;
        *speed = (before + slope * length).clamp(-1e5, 1e5);
        [before, slope]
    }

    /// What is set before a step of this length.
    pub(super) fn next(&mut self, draw: &mut Draw, way: &str, length: f64) -> Host {
        let mut speeds = [self.speed(draw, way, 0, length), [0.0; 2]];
        if self.turns {
            speeds[1] = self.speed(draw, way, 1, length);
        }
        let angle = self.rate * self.time + self.phase;
        let (sin, cos) = angle.sin_cos();
        let jump = draw.chance(0.2);
        let rings = [0, 1].map(|which| {
            [0, 1].map(|a| {
                let swing = self.swing[which][a];
                let [value, first, second] =
                    [swing * sin, self.rate * swing * cos, -self.rate * self.rate * swing * sin];
                let held = jump && self.internal[which];
                let value = self.middle[which][a] + value;
                if held { [value, 0.0, 0.0] } else { [value, first, second] }
            })
        });
        self.time += length;
        Host { speeds, rings }
    }
}
