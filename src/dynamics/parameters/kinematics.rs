//! Where cage and rings are at one instant, and how fast they move: the bearing's one "now".
//!
//! The cage is known before the state is, so its part is worked out first, for several instants of a step together.
//! Rings follow from the state where it has them, else from the host.

use super::excitation::{Excitation, Frames, WholeAngle};
use super::film::FilmsNow;
use crate::numerics::lanes::stay_a_branch;
use crate::numerics::plane::Vector;
use crate::numerics::{SMALL_ANGLE, sin_cos, small_turn};
use std::ops::{Deref, DerefMut};

/// The cage at one instant; one that is uneven as it would turn without that: the *nominal* cage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CageState {
    /// Time τ since the communication point (s).
    pub tau: f64,
    /// Direction of element 1: cosine and sine of the cage angle.
    pub direction: Vector,
    /// Cage angle (rad), within one turn at the communication point.
    pub angle: f64,
    /// Cage speed (rad/s).
    pub speed: f64,
    /// Cage acceleration (rad/s²).
    pub acceleration: f64,
}

/// Position and velocity of a ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RingState {
    /// Position (m).
    pub position: Vector,
    /// Velocity (m/s).
    pub velocity: Vector,
}

/// An element on its path.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct PathMotion {
    /// u (m).
    pub(in crate::dynamics) path: f64,
    /// u' (m/s).
    pub(in crate::dynamics) rate: f64,
}

impl PathMotion {
    /// At rest at a path (m).
    #[inline]
    pub(in crate::dynamics) fn at_rest(path: f64) -> Self {
        Self { path, rate: 0.0 }
    }
}

/// Cage and rings at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kinematics {
    /// The cage.
    pub cage: CageState,
    /// The inner ring.
    pub shaft: RingState,
    /// The outer ring.
    pub housing: RingState,
}

/// Cage and rings at one instant, and what few contacts ask for within a step's kernels: the cage's turns, the frames
/// of defects and oil films.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FramedKinematics {
    /// Cage and rings.
    pub motion: Kinematics,
    /// Whole turns of the cage at the communication point. In its own state they would make every step of every bearing
    /// longer, by 0.5 to 1 % of its instructions.
    pub turns: i64,
    /// The frames of defects.
    pub frames: Frames,
    /// The oil films; `None` of dry contacts.
    pub films: Option<FilmsNow>,
}

impl Deref for FramedKinematics {
    type Target = Kinematics;

    fn deref(&self) -> &Kinematics {
        &self.motion
    }
}

impl DerefMut for FramedKinematics {
    fn deref_mut(&mut self) -> &mut Kinematics {
        &mut self.motion
    }
}

/// What the right-hand side is evaluated at.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stage<'a> {
    /// What acts from outside.
    pub(crate) excitation: &'a Excitation,
    /// The cage at the stage's instant.
    pub(crate) cage: &'a CageState,
    /// State vector.
    pub(crate) state: &'a [f64],
    /// Time (s) by which the positions in `state` are still to be moved on along the velocities in it.
    pub(crate) ahead: Option<f64>,
}

impl Default for RingState {
    fn default() -> Self {
        Self { position: Vector::zeros(), velocity: Vector::zeros() }
    }
}

impl CageState {
    /// A cage that stands still at an angle (rad).
    pub fn at_rest(angle: f64) -> Self {
        Self { tau: 0.0, direction: direction(angle), angle, speed: 0.0, acceleration: 0.0 }
    }
}

impl FramedKinematics {
    /// Nothing moves and contacts are dry; the outer ring's centre is `offset` (m) from the inner's, frames are at
    /// their angles of the start.
    pub fn at_rest(cage_angle: f64, offset: Vector) -> Self {
        let housing = RingState { position: offset, ..RingState::default() };
        let (cage, shaft) = (CageState::at_rest(cage_angle), RingState::default());
        Self { motion: Kinematics { cage, shaft, housing }, turns: 0, frames: Frames::default(), films: None }
    }

    /// The same positions with nothing moving.
    pub fn standing(&self) -> Self {
        let still = |ring: &RingState| RingState { velocity: Vector::zeros(), ..*ring };
        let cage = CageState { speed: 0.0, acceleration: 0.0, ..self.cage };
        let motion = Kinematics { cage, shaft: still(&self.shaft), housing: still(&self.housing) };
        Self { motion, frames: self.frames.at_rest(), ..*self }
    }

    /// Angle of the nominal cage.
    #[inline]
    pub(crate) fn cage_angle(&self) -> WholeAngle {
        WholeAngle { turns: self.turns, rest: self.cage.angle }
    }
}

impl Kinematics {
    /// Position of the outer ring's centre seen from the inner's (m).
    #[inline(always)]
    pub fn offset(&self) -> Vector {
        self.housing.position - self.shaft.position
    }

    /// Its velocity (m/s).
    #[inline(always)]
    pub fn drift(&self) -> Vector {
        self.housing.velocity - self.shaft.velocity
    }
}

impl Excitation {
    /// Angle of the nominal cage at an instant.
    #[inline(always)]
    pub(crate) fn cage_angle_of(&self, cage: &CageState) -> WholeAngle {
        WholeAngle { turns: self.cage_turns, rest: cage.angle }
    }

    /// The cage at `tau`.
    #[inline]
    pub fn cage_at(&self, tau: f64) -> CageState {
        let angle = self.cage_angle(tau);
        CageState {
            tau,
            direction: direction(angle),
            angle,
            speed: self.cage.rate_at(tau),
            acceleration: self.cage.0[2],
        }
    }

    /// The cage at some instants after `from`, worked out together: the direction at `from`, turned by a small angle.
    #[inline(always)]
    pub(crate) fn cage_after<const N: usize>(&self, from: f64, after: [f64; N]) -> [CageState; N] {
        let start = self.cage_at(from);
        let mut turned = [0.0; N];
        for (angle, after) in turned.iter_mut().zip(after) {
            *angle = after * (start.speed + 0.5 * after * start.acceleration);
        }
        if !turned.iter().all(|angle| angle.abs() <= SMALL_ANGLE) {
            return after.map(|after| self.cage_at(from + after));
        }
        let mut cages = [start; N];
        for ((cage, after), x) in cages.iter_mut().zip(after).zip(turned) {
            let (sin, less) = small_turn(x);
            let (cos_0, sin_0) = (start.direction.x, start.direction.y);
            cage.tau = from + after;
            cage.direction = Vector::new(cos_0 - (cos_0 * less + sin_0 * sin), sin_0 - (sin_0 * less - cos_0 * sin));
            cage.angle = start.angle + x;
            cage.speed = start.speed + after * start.acceleration;
        }
        cages
    }
}

#[inline(always)]
fn direction(angle: f64) -> Vector {
    let (sin, cos) = sin_cos(angle);
    Vector::new(cos, sin)
}

/// A position, moved on along its rate by the time `ahead`.
#[inline(always)]
pub(in crate::dynamics) fn moved(position: f64, rate: f64, ahead: Option<f64>) -> f64 {
    match ahead {
        None => position,
        Some(ahead) => {
            // The position is not to wait for its rate where nothing is ahead.
            stay_a_branch();
            position + ahead * rate
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::parameters::excitation::Quadratic;

    #[test]
    fn cages_worked_out_together_are_those_worked_out_alone() {
        for (speed, acceleration) in [(100.0, 0.0), (-3000.0, 1e7), (0.0, 0.0), (1e4, -1e9)] {
            for from in [0.0, 3e-4] {
                let excitation = Excitation {
                    cage_start: 2.5,
                    cage: Quadratic([0.0, speed, acceleration]),
                    ..Excitation::default()
                };
                let after = [0.0, 1e-7, 3e-6, 1e-5];
                for (together, after) in excitation.cage_after(from, after).into_iter().zip(after) {
                    let alone = excitation.cage_at(from + after);
                    // A rounding or two of numbers up to 1, and of the angle.
                    let angle = 4.0 * f64::EPSILON * (1.0 + alone.angle.abs());
                    assert!((together.direction.x - alone.direction.x).abs() < angle, "{together:?} {alone:?}");
                    assert!((together.direction.y - alone.direction.y).abs() < angle, "{together:?} {alone:?}");
                    assert!((together.angle - alone.angle).abs() < angle);
                    let speed = 4.0 * f64::EPSILON * (alone.speed.abs() + 1e7 * 3e-4 + 1.0);
                    assert!((together.speed - alone.speed).abs() < speed.max(1e-9));
                }
            }
        }
    }
}
