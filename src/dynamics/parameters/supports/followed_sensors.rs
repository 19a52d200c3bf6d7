//! Sensors that are moved on exactly, so that not their resonance but the rings limit a step.
//!
//! A sensor of mass m_s along e on an outer ring of mass m_o, on which all but the sensors exert F, moves by
//! ```text
//! z = s − e·x_o     y = x_o + Σ (m_s/m_o) s e     y'' = F/m_o
//! z'' + 2 ζ ω z' + ω² z = −e·y''                  ω² = k (1/m_s + 1/m_o),  2 ζ ω = c (1/m_s + 1/m_o)
//! ```
//! if sensors are perpendicular to one another. y is slow, and a step integrates it as ever, with z held: contacts feel
//! z only through x_o, by m_s/(m_o + m_s) of it. z follows under the forcing that the stages have so far, and, once the
//! step is done, under the cubic y'' of the quintic that y has over it, exactly but for rounding. Error control is told
//! what contacts felt of the difference. z itself has a smaller error than y: the cubic misses 5e-4 (νh)⁴ of a forcing
//! of frequency ν, and z' gets no more of what it misses than y' does.

use super::sensor_modes::{Cubic, StepEnds, follow, section};
use crate::dynamics::parameters::Layout;
use crate::numerics::plane::Vector;
use crate::numerics::polynomials::Quintic;
use crate::numerics::sin_cos;
use crate::scene::{DegreesOfFreedom, ElementInertia, Motion, Scene};
use std::f64::consts::TAU;

/// Angle (rad) of the oscillation up to which it is a power series; beyond, the closed form loses no digits.
const SERIES: f64 = 1.0;
/// Largest damping ratio: the closed form divides by √(1 − ζ²).
const MOST_DAMPED: f64 = 0.9;
/// Frequency (rad/s) from which on a sensor limits steps: rings on their contacts swing more slowly.
const FAST: f64 = 5e3 * TAU;
/// Largest m_s/m_o: contacts are to feel little of a sensor.
const HEAVIEST: f64 = 0.5;
/// Largest cosine between sensors that count as perpendicular.
const PERPENDICULAR: f64 = 1e-9;

/// Most sensors that are perpendicular to one another in the plane.
pub(crate) const MOST_FOLLOWED: usize = 2;

/// z (m) and z' (m/s) of a sensor.
pub(crate) type Swing = [f64; 2];

/// A sensor that is moved on exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FollowedSensor {
    /// Index of its displacement in a state, before its velocity.
    index: usize,
    /// Index of the outer ring's x.
    housing: usize,
    /// e
    direction: Vector,
    /// m_s/m_o
    ratio: f64,
    /// ω (rad/s)
    frequency: f64,
    /// ζ
    damping_ratio: f64,
}

impl FollowedSensor {
    /// All sensors of a scene; none where they are not to be followed: elements with inertia limit a step themselves,
    /// and structural modes see a sensor's acceleration as a cubic.
    pub(in crate::dynamics) fn all(scene: &Scene, layout: &Layout) -> Vec<Self> {
        let free = scene.bearing.element_inertia == ElementInertia::None
            && scene.bearing.degrees_of_freedom == DegreesOfFreedom::Two
            && scene.housing.motion == Motion::Internal;
        let Some(housing) = layout.housing.filter(|_| free) else { return Vec::new() };
        let sensors = scene.sensors.iter().zip(layout.sensor_indices());
        let found: Vec<Self> = sensors
            .map(|(sensor, index)| {
                let ease = 1.0 / sensor.mass + 1.0 / scene.housing.mass;
                let frequency = (sensor.stiffness * ease).sqrt();
                Self {
                    index,
                    housing,
                    direction: sensor.unit().into(),
                    ratio: sensor.mass / scene.housing.mass,
                    frequency,
                    damping_ratio: 0.5 * sensor.damping * ease / frequency,
                }
            })
            .collect();
        let apart =
            |k: usize| found[..k].iter().all(|other| other.direction.dot(&found[k].direction).abs() < PERPENDICULAR);
        let suits = |one: &Self| one.damping_ratio < MOST_DAMPED && one.frequency >= FAST && one.ratio <= HEAVIEST;
        let follows = found.len() <= MOST_FOLLOWED
            && (0..found.len()).all(|k| apart(k) && suits(&found[k]))
            && scene.sensors.iter().all(|sensor| sensor.modes.is_empty());
        if follows { found } else { Vec::new() }
    }

    /// z and z' in a state, or their rates in a derivative.
    pub(crate) fn swing(&self, state: &[f64]) -> Swing {
        [0, 1].map(|kind: usize| state[self.index + kind] - self.along(state, kind))
    }

    /// How far the outer ring goes (m) as z grows by `z` (m) and y stays.
    pub(crate) fn felt(&self, z: f64) -> f64 {
        -self.ratio / (1.0 + self.ratio) * z
    }

    /// Puts z and z' into a state whose y stays, or their rates into a derivative; positions there are still to be
    /// moved on by their velocities for the time `ahead` (s).
    pub(crate) fn put(&self, swing: Swing, ahead: f64, state: &mut [f64]) {
        let Self { index, housing, direction: e, ratio, .. } = *self;
        let old = [0, 1].map(|kind: usize| [self.along(state, kind), state[index + kind]]);
        let placed = |[x, s]: [f64; 2], z: f64| {
            let x = (x + ratio * s - ratio * z) / (1.0 + ratio);
            [x, x + z]
        };
        let rates = placed(old[1], swing[1]);
        let places = placed([0, 1].map(|i: usize| old[0][i] + ahead * old[1][i]), swing[0]);
        for (kind, [x, s]) in [[0, 1].map(|i: usize| places[i] - ahead * rates[i]), rates].into_iter().enumerate() {
            let by = x - old[kind][0];
            state[housing + 2 * kind] += e.x * by;
            state[housing + 2 * kind + 1] += e.y * by;
            state[index + kind] = s;
        }
    }

    /// e·y'' (m/s²) of a derivative.
    pub(crate) fn forcing(&self, derivative: &[f64]) -> f64 {
        self.along(derivative, 1) + self.ratio * derivative[self.index + 1]
    }

    /// The same over a step, as a cubic in the share of it.
    pub(crate) fn forcing_over(&self, ends: StepEnds) -> Cubic {
        let y = |list: &[f64], kind: usize| self.along(list, kind) + self.ratio * list[self.index + kind];
        let [values, rates] = [0, 1].map(|kind: usize| ends.states.map(|state| y(state, kind)));
        Quintic::new(ends.length, 0.0).second_derivative(values, rates, ends.derivatives.map(|rate| self.forcing(rate)))
    }

    /// z and z' at the share `to` of a step of `length` (s), from those at the share `from`, under a cubic forcing.
    pub(crate) fn follow(&self, forcing: Cubic, length: f64, [from, to]: [f64; 2], swing: Swing) -> Swing {
        let (share, h) = (to - from, length * (to - from));
        if share == 0.0 {
            return swing;
        }
        let (omega, zeta, forcing) = (self.frequency, self.damping_ratio, section(forcing, from, share));
        let turn = omega * h;
        if turn < SERIES {
            return follow([omega, zeta], forcing, h, swing);
        }
        // A cubic under which nothing swings, and what swings about it.
        let [a, b, c, d] = forcing.map(|forcing| -forcing / (omega * omega));
        let (lag, inertia) = (2.0 * zeta / turn, 2.0 / (turn * turn));
        let c = c - lag * 3.0 * d;
        let b = b - lag * 2.0 * c - inertia * 3.0 * d;
        let a = a - lag * b - inertia * c;
        let [z, rate] = [swing[0] - a, swing[1] - b / h];
        let ringing = (1.0 - zeta * zeta).sqrt();
        let (sin, cos) = sin_cos(ringing * turn);
        let (fall, sin) = (libm::exp(-zeta * turn), sin / ringing);
        let (z, rate) =
            (fall * (z * cos + (rate / omega + zeta * z) * sin), fall * (rate * cos - (zeta * rate + omega * z) * sin));
        [z + (a + b + c + d), rate + (b + 2.0 * c + 3.0 * d) / h]
    }

    /// Along e, of the outer ring's position (0) or velocity (1).
    fn along(&self, list: &[f64], kind: usize) -> f64 {
        let at = self.housing + 2 * kind;
        self.direction.x * list[at] + self.direction.y * list[at + 1]
    }

    /// What its spring and damper make of the outer ring's own acceleration by its place (1/s²) and velocity (1/s),
    /// along x and y.
    pub(crate) fn on_ring(&self) -> [[f64; 2]; 2] {
        let by = [self.frequency * self.frequency, 2.0 * self.damping_ratio * self.frequency].map(|by| self.felt(by));
        [self.direction.x, self.direction.y].map(|e| by.map(|by| by * e * e))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sensor() -> FollowedSensor {
        let direction = Vector::new(0.6, 0.8);
        FollowedSensor { index: 4, housing: 0, direction, ratio: 0.15, frequency: 1e5, damping_ratio: 0.05 }
    }

    #[test]
    fn the_closed_form_is_what_the_series_gives_in_pieces() {
        let (sensor, forcing) = (sensor(), [3.0, -20.0, 50.0, -35.0]);
        for h in [1.1e-5, 1e-4, 1e-3] {
            let whole = sensor.follow(forcing, h, [0.2, 0.9], [1e-9, 2e-5]);
            // Each of half a radian or less.
            let mut pieced = [1e-9, 2e-5];
            for k in 0..140 {
                pieced = sensor.follow(forcing, h, [k, k + 1].map(|k: u16| 0.2 + f64::from(k) * 0.005), pieced);
            }
            // 140 roundings of the share and of what swings.
            assert!((whole[0] - pieced[0]).abs() < 1e-13 * 1e-9, "{h}: {:e}", whole[0] - pieced[0]);
            assert!((whole[1] - pieced[1]).abs() < 1e-13 * 1e-4, "{h}: {:e}", whole[1] - pieced[1]);
        }
    }

    #[test]
    fn a_sensor_is_put_where_it_is_to_be_and_nothing_else_moves() {
        let (sensor, ahead) = (sensor(), 3e-6);
        let state = [1e-5, -2e-5, 3e-3, 1e-3, 4e-6, -2e-3];
        let moved = |state: &[f64]| [0, 1, 4].map(|i: usize| state[i] + ahead * state[[2, 3, 0, 0, 5][i]]);
        let slow = |[x, y, s]: [f64; 3]| [0.6 * x + 0.8 * y + 0.15 * s, 0.8 * x - 0.6 * y];
        let mut put = state;
        sensor.put([2e-9, 5e-4], ahead, &mut put);
        let [x, y, s] = moved(&put);
        // Roundings of 1e-5 m and 1e-3 m/s.
        assert!((s - 0.6 * x - 0.8 * y - 2e-9).abs() < 1e-20 && (sensor.swing(&put)[1] - 5e-4).abs() < 1e-17);
        for (found, expected) in slow(moved(&put)).into_iter().zip(slow(moved(&state))) {
            assert!((found - expected).abs() < 1e-20, "{found} {expected}");
        }
        let rates = |state: &[f64; 6]| slow([state[2], state[3], state[5]]);
        assert!(rates(&put).into_iter().zip(rates(&state)).all(|(a, b)| (a - b).abs() < 1e-17));
    }
}
