//! What acts on the bearing from outside during one communication step, as polynomials of the time τ since its start.
//!
//! A prescribed ring moves as x + vτ + ½aτ² + ⅙jτ³, loads and shaft speed as their value and derivatives say. Nothing
//! here depends on absolute time, so the millionth step is as exact as the first.

use crate::numerics::{sin_cos, wrap};

/// c₀ + c₁τ + ½c₂τ²
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Quadratic(pub [f64; 3]);

impl Quadratic {
    /// A constant.
    pub fn constant(value: f64) -> Self {
        Self([value, 0.0, 0.0])
    }

    /// Value at `tau`.
    #[inline]
    pub fn at(&self, tau: f64) -> f64 {
        self.0[0] + tau * (self.0[1] + 0.5 * tau * self.0[2])
    }

    /// First derivative at `tau`.
    #[inline]
    pub fn rate_at(&self, tau: f64) -> f64 {
        self.0[1] + tau * self.0[2]
    }
}

/// c₀ + c₁τ + ½c₂τ² + ⅙c₃τ³
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Cubic(pub [f64; 4]);

impl Cubic {
    /// Value at `tau`.
    #[inline]
    pub fn at(&self, tau: f64) -> f64 {
        self.0[0] + tau * (self.0[1] + 0.5 * tau * (self.0[2] + tau * (1.0 / 3.0) * self.0[3]))
    }

    /// First derivative at `tau`.
    #[inline]
    pub fn rate_at(&self, tau: f64) -> f64 {
        self.0[1] + tau * (self.0[2] + 0.5 * tau * self.0[3])
    }

    /// Second derivative at `tau`.
    #[inline]
    pub fn second_at(&self, tau: f64) -> f64 {
        self.0[2] + tau * self.0[3]
    }
}

/// Cage angle kept as whole turns and the rest, so that it does not lose digits in a long run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CageAngle {
    /// Whole turns.
    pub turns: i64,
    /// The rest [rad], in [−π, π].
    pub rest: f64,
}

impl CageAngle {
    /// From an angle [rad].
    pub fn new(angle: f64) -> Self {
        Self::default().advanced(angle)
    }

    /// This angle further by `angle` [rad].
    pub fn advanced(self, angle: f64) -> Self {
        let sum = self.rest + angle;
        let rest = wrap(sum);
        Self { turns: self.turns + ((sum - rest) / std::f64::consts::TAU).round() as i64, rest }
    }

    /// The whole angle [rad].
    pub fn total(self) -> f64 {
        self.turns as f64 * std::f64::consts::TAU + self.rest
    }
}

/// What acts from outside during one communication step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Drive {
    /// Cage angle at the start [rad], within one turn.
    pub cage_start: f64,
    /// Cage angle since the start [rad], with its value 0, its speed and its acceleration.
    pub cage: Quadratic,
    /// Prescribed position of the inner ring [m], x and y; zero when it is not prescribed.
    pub shaft: [Cubic; 2],
    /// Prescribed position of the outer ring [m].
    pub housing: [Cubic; 2],
    /// External load on the inner ring [N].
    pub shaft_load: [Quadratic; 2],
    /// External load on the outer ring [N].
    pub housing_load: [Quadratic; 2],
}

impl Drive {
    /// Cage angle at `tau` [rad].
    #[inline]
    pub fn cage_angle(&self, tau: f64) -> f64 {
        self.cage_start + self.cage.at(tau)
    }

    /// Where the cage is at `tau`.
    #[inline]
    pub fn clock(&self, tau: f64) -> Clock {
        let cage_angle = self.cage_angle(tau);
        let (sin, cos) = sin_cos(cage_angle);
        Clock { tau, cage: (cos, sin), cage_angle, cage_speed: self.cage.rate_at(tau) }
    }

    /// Where the cage is at some instants after `from`, worked out together: direction at `from`, turned by a small
    /// angle.
    #[inline(always)]
    pub(crate) fn clocks<const N: usize>(&self, from: f64, after: [f64; N]) -> [Clock; N] {
        let start = self.clock(from);
        let (speed, acceleration) = (start.cage_speed, self.cage.0[2]);
        let mut turned = [0.0; N];
        for (angle, after) in turned.iter_mut().zip(after) {
            *angle = after * (speed + 0.5 * after * acceleration);
        }
        if !turned.iter().all(|angle| angle.abs() <= SMALL_ANGLE) {
            return after.map(|after| self.clock(from + after));
        }
        let mut clocks = [start; N];
        for ((clock, after), x) in clocks.iter_mut().zip(after).zip(turned) {
            let square = x * x;
            let sin = x * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0 - square * (1.0 / 5040.0))));
            let less = square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0 - square * (1.0 / 40_320.0))));
            let (cos_0, sin_0) = start.cage;
            clock.tau = from + after;
            clock.cage = (cos_0 - (cos_0 * less + sin_0 * sin), sin_0 - (sin_0 * less - cos_0 * sin));
            clock.cage_angle = start.cage_angle + x;
            clock.cage_speed = speed + after * acceleration;
        }
        clocks
    }
}

/// Angle up to which the series of [`Drive::clocks`] hold to rounding [rad]: 0.03¹⁰/10! is 2e-22.
const SMALL_ANGLE: f64 = 0.03;

/// An instant, and where the cage is then.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Time since the communication point [s].
    pub tau: f64,
    /// cos and sin of the cage angle.
    pub cage: (f64, f64),
    /// Cage angle [rad], within one turn at the communication point.
    pub cage_angle: f64,
    /// Cage speed [rad/s].
    pub cage_speed: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn clocks_worked_out_together_are_those_worked_out_alone() {
        for (speed, acceleration) in [(100.0, 0.0), (-3000.0, 1e7), (0.0, 0.0), (1e4, -1e9)] {
            for from in [0.0, 3e-4] {
                let drive = Drive { cage_start: 2.5, cage: Quadratic([0.0, speed, acceleration]), ..Drive::default() };
                let after = [0.0, 1e-7, 3e-6, 1e-5];
                for (together, after) in drive.clocks(from, after).into_iter().zip(after) {
                    let alone = drive.clock(from + after);
                    // A rounding or two of numbers up to 1, and of the angle.
                    let angle = 4.0 * f64::EPSILON * (1.0 + alone.cage_angle.abs());
                    assert!((together.cage.0 - alone.cage.0).abs() < angle, "{together:?} {alone:?}");
                    assert!((together.cage.1 - alone.cage.1).abs() < angle, "{together:?} {alone:?}");
                    assert!((together.cage_angle - alone.cage_angle).abs() < angle);
                    let speed = 4.0 * f64::EPSILON * (alone.cage_speed.abs() + 1e7 * 3e-4 + 1.0);
                    assert!((together.cage_speed - alone.cage_speed).abs() < speed.max(1e-9));
                }
            }
        }
    }

    #[test]
    fn a_minute_of_small_advances_keeps_the_cage_angle() {
        let step = 2.0 * std::f64::consts::PI * 4.0 * 1e-4;
        let mut angle = CageAngle::new(-1.0);
        for _ in 0..600_000 {
            angle = angle.advanced(step);
        }
        // Each advance rounds at most half an ulp of π, 2.2e-16; 600 000 of them at worst 1.3e-10.
        assert!((angle.total() - (600_000.0 * step - 1.0)).abs() < 2e-10 + 1e-12 * angle.total());
        assert_eq!(angle.turns, 240);
    }
}
