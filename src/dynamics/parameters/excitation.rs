//! What acts on the bearing from outside during one communication step, as polynomials of the time τ since its start.
//!
//! A prescribed ring moves as x + vτ + ½aτ² + ⅙jτ³, loads and shaft speed as their value and derivatives say. Nothing
//! here depends on absolute time, so the millionth step is as exact as the first.

use crate::numerics::number::Scalar;
use crate::numerics::wrap;

/// Coordinates of a ring: x, y, z, and its tilt about x and about y.
pub const COORDINATES: usize = 5;

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

/// What defects turn with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// The inner ring.
    Shaft,
    /// The outer ring.
    Housing,
    /// An element about its own axis.
    Spin,
}

/// Angle and speed of a frame at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Turn<T = f64> {
    /// Angle (rad).
    pub angle: T,
    /// Speed (rad/s).
    pub speed: T,
}

/// All frames at one instant, in the order of [`Frame`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Frames<T = f64>(pub [Turn<T>; 3]);

impl<T: Copy> Frames<T> {
    /// One of them.
    #[inline]
    pub fn of(&self, frame: Frame) -> Turn<T> {
        self.0[frame as usize]
    }
}

impl<T: Scalar> Frames<T> {
    /// Frames that stand still at these angles.
    pub fn at_rest(&self) -> Self {
        Self(self.0.map(|turn| Turn { speed: T::from(0.0), ..turn }))
    }

    /// The same in numbers of another kind.
    #[inline(always)]
    pub(in crate::dynamics) fn mapped<U>(&self, number: impl Fn(T) -> U) -> Frames<U> {
        Frames(self.0.map(|turn| Turn { angle: number(turn.angle), speed: number(turn.speed) }))
    }
}

/// How a frame turns during one communication step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Turning {
    /// Its angle at the start (rad), within one turn.
    pub start: f64,
    /// Its angle since the start (rad), with its value 0, its speed and its acceleration.
    pub since: Quadratic,
}

/// An angle kept as whole turns and the rest, so that it does not lose digits in a long run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WholeAngle {
    /// Whole turns.
    pub turns: i64,
    /// The rest (rad), in [−π, π] at communication points.
    pub rest: f64,
}

impl WholeAngle {
    /// From an angle (rad).
    pub fn new(angle: f64) -> Self {
        Self::default().advanced(angle)
    }

    /// An angle (rad) that is none of whole turns, however large.
    pub fn in_first_turn(rest: f64) -> Self {
        Self { turns: 0, rest }
    }

    /// This angle further by `angle` (rad).
    pub fn advanced(self, angle: f64) -> Self {
        let sum = self.rest + angle;
        let rest = wrap(sum);
        Self { turns: self.turns + ((sum - rest) / std::f64::consts::TAU).round() as i64, rest }
    }

    /// The whole angle (rad).
    pub fn total(self) -> f64 {
        self.turns as f64 * std::f64::consts::TAU + self.rest
    }
}

/// What acts from outside during one communication step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Excitation {
    /// Cage angle at the start (rad), within one turn.
    pub cage_start: f64,
    /// Whole turns of the cage at the start.
    pub cage_turns: i64,
    /// Cage angle since the start (rad), with its value 0, its speed and its acceleration.
    pub cage: Quadratic,
    /// How the frames of defects turn, in the order of [`Frame`].
    pub frames: [Turning; 3],
    /// Prescribed coordinates of the inner and of the outer ring: x, y, z (m), and tilts about x and y (rad); zero when
    /// they are not prescribed.
    pub motion: [[Cubic; COORDINATES]; 2],
    /// External loads on the inner and on the outer ring along the same axes (N) and about them (N m).
    pub load: [[Quadratic; COORDINATES]; 2],
    /// Speed of the inner ring against the outer (rad/s), which oil films follow.
    pub relative_speed: Quadratic,
}

impl Excitation {
    /// Nothing moves: element 1 is at `cage_angle` and the frames of defects are at `frames` (rad).
    pub fn standing(cage_angle: f64, frames: [f64; 3]) -> Self {
        let frames = frames.map(|start| Turning { start, ..Turning::default() });
        Self { cage_start: cage_angle, frames, ..Self::default() }
    }

    /// Cage angle at `tau` (rad).
    #[inline]
    pub fn cage_angle(&self, tau: f64) -> f64 {
        self.cage_start + self.cage.at(tau)
    }

    /// The frames of defects at `tau`.
    pub fn frames_at(&self, tau: f64) -> Frames {
        let turn = |frame: &Turning| Turn { angle: frame.start + frame.since.at(tau), speed: frame.since.rate_at(tau) };
        let [shaft, housing, spin] = &self.frames;
        Frames([turn(shaft), turn(housing), turn(spin)])
    }

    /// Speed (rad/s) and acceleration (rad/s²) of each frame at `tau`.
    pub fn frame_rates(&self, tau: f64) -> [[f64; 2]; 3] {
        self.frames.map(|frame| [frame.since.rate_at(tau), frame.since.0[2]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_minute_of_small_advances_keeps_the_cage_angle() {
        let step = 2.0 * std::f64::consts::PI * 4.0 * 1e-4;
        let mut angle = WholeAngle::new(-1.0);
        for _ in 0..600_000 {
            angle = angle.advanced(step);
        }
        // Each advance rounds at most half an ulp of π, 2.2e-16; 600 000 of them at worst 1.3e-10.
        assert!((angle.total() - (600_000.0 * step - 1.0)).abs() < 2e-10 + 1e-12 * angle.total());
        assert_eq!(angle.turns, 240);
    }
}
