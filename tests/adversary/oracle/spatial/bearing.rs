//! The numbers of a bearing in space, and the rates of its state.

use super::case::{Gyroscopic, Host, SpatialRing};
use super::contact::{Dampers, Groove, Pose, Touch, seen};
use super::surfaces::Surfaces;
use super::vector::{Vector, add, dot, times};
use crate::case::Motion;
use crate::turning::{Turns, quadratic};
use std::f64::consts::TAU;

/// Numbers of a ring in the state: x, y, z, tilts about x and y, then their velocities.
pub(super) const OF_RING: usize = 10;
/// Where the balls begin: of each u, w, v, w_z.
pub(super) const BALLS: usize = 2 * OF_RING;

/// A bearing in SI units.
pub struct SpatialBearing {
    pub count: usize,
    pub radius: f64,
    /// Distance of a ball's centre from the outer ring's, where it touches the groove's bottom.
    pub rho_0: f64,
    pub mass: f64,
    pub gravity: Vector,
    pub clearance: f64,
    pub pitch: f64,
    pub rings: [SpatialRing; 2],
    pub freedom: usize,
    pub gyroscopic: Gyroscopic,
    /// +1 or −1: where a preload pushes the shaft.
    pub sense: f64,
    pub(super) grooves: [Groove; 2],
    pub(super) surfaces: Surfaces,
    pub(super) dampers: Dampers,
    /// Whether balls have inertia.
    pub(super) inertia: bool,
    /// As a factor, how far the difference quotients of balls without it go: what half of it changes is their error.
    pub quotients: f64,
    /// Speeds of cage, shaft, housing and balls' spin per speed of shaft and housing.
    pub(super) ratios: [[f64; 2]; 4],
    pub cage_start: f64,
    /// Speeds of shaft and housing at the start (rad/s).
    pub speeds: [f64; 2],
    /// Angles of the shoulders from the grooves' bottoms (rad); and half-lengths of the ellipses across the grooves
    /// over those radii and √approach (1/√m).
    pub(super) shoulders: [Option<f64>; 2],
    pub(super) halves: [f64; 2],
}

/// What the host says for a step, and how cage, shaft, housing and balls turn in it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outside {
    pub(super) turns: Turns,
    pub(super) rings: [[[f64; 3]; 5]; 2],
}

/// One ball.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ball {
    /// Inner, outer.
    pub contacts: [Touch; 2],
    /// u and v (m).
    pub place: [f64; 2],
}

/// What acts at an instant.
#[derive(Debug, Clone, Default)]
pub struct Acting {
    pub balls: Vec<Ball>,
    /// The bearing on shaft and housing: forces (N), then moments about x and y (N m).
    pub rings: [[f64; 5]; 2],
    /// Accelerations of both.
    pub accelerations: [[f64; 5]; 2],
}

impl Ball {
    /// What both rings do to it (N).
    pub(super) fn force(&self) -> Vector {
        add(self.contacts[0].on_ball, self.contacts[1].on_ball)
    }
}

impl SpatialBearing {
    /// Hertz constants, inner and outer.
    pub fn constants(&self) -> [f64; 2] {
        self.grooves.map(|groove| groove.stiffness)
    }

    /// Axial places of the circles of groove centres, inner and outer.
    pub fn shifts(&self) -> [f64; 2] {
        self.grooves.map(|groove| groove.shift)
    }

    /// Angle (rad) from the end of an ellipse to the shoulder, where there is one; the force decides on its size.
    pub fn margin(&self, side: usize, touch: &Touch) -> Option<f64> {
        let approach = (touch.force / self.grooves[side].stiffness).cbrt().powi(2);
        Some(self.shoulders[side]? - touch.angle.abs() - self.halves[side] * approach.sqrt())
    }

    /// How many numbers a state has.
    pub fn state_count(&self) -> usize {
        BALLS + 4 * self.count
    }

    /// What the host's speeds and inputs are, from the angles of cage, shaft, housing and spin.
    pub(super) fn outside(&self, angles: [f64; 4], host: &Host) -> Outside {
        let turn = |which: usize| {
            let [of_shaft, of_housing] = self.ratios[which];
            let [speed, rate] = [0, 1].map(|k| of_shaft * host.speeds[0][k] + of_housing * host.speeds[1][k]);
            [angles[which], speed, rate]
        };
        Outside { turns: std::array::from_fn(turn), rings: host.rings }
    }

    /// The same where the run begins.
    pub(super) fn first(&self, host: Option<&Host>) -> Outside {
        self.outside([self.cage_start, 0.0, 0.0, 0.0], host.unwrap_or(&self.of_scene()))
    }

    /// What the host says where it says nothing: the loads and speeds of the scene.
    pub(super) fn of_scene(&self) -> Host {
        Host {
            speeds: self.speeds.map(|speed| [speed, 0.0]),
            rings: self.rings.map(|ring| ring.load.map(|load| [load, 0.0, 0.0])),
        }
    }

    /// Which numbers of a ring are free.
    pub(super) fn free(&self, which: usize) -> std::ops::Range<usize> {
        match (self.rings[which].motion, self.freedom, which) {
            (Motion::Internal, 5, 0) => 0..5,
            (Motion::Internal, ..) => 0..3,
            _ => 0..0,
        }
    }

    pub(super) fn pose(&self, which: usize, outside: &Outside, t: f64, y: &[f64]) -> Pose {
        let numbers: [[f64; 2]; 5] = match self.rings[which].motion {
            Motion::Internal => std::array::from_fn(|a| [y[OF_RING * which + a], y[OF_RING * which + 5 + a]]),
            Motion::Host => outside.rings[which].map(|c| quadratic(c, t)).map(|[at, rate, _]| [at, rate]),
            Motion::Fixed => [[0.0; 2]; 5],
        };
        let part = |a: usize, k: usize| numbers[a][k];
        Pose {
            position: [part(0, 0), part(1, 0), part(2, 0)],
            velocity: [part(0, 1), part(1, 1), part(2, 1)],
            tilt: [part(3, 0), part(4, 0)],
            tilt_rate: [part(3, 1), part(4, 1)],
        }
    }

    /// Direction of ball `j` and its perpendicular, at time `t` into a step.
    pub(super) fn directions(&self, outside: &Outside, t: f64, j: usize) -> [Vector; 2] {
        let (sin, cos) = (quadratic(outside.turns[0], t)[0] + TAU * j as f64 / self.count as f64).sin_cos();
        [[cos, sin, 0.0], [-sin, cos, 0.0]]
    }

    /// Ball `j` between two poses, its contacts damped so; u, w, v, w_z are its numbers.
    pub(super) fn ball(
        &self,
        (outside, t): (&Outside, f64),
        poses: &[Pose; 2],
        j: usize,
        [u, w, v, w_z]: [f64; 4],
        dampers: Dampers,
    ) -> Ball {
        let turns = outside.turns.map(|turn| quadratic(turn, t));
        let [e_r, e_t] = self.directions(outside, t, j);
        let housing = &poses[1];
        let rho = self.rho_0 + u;
        let place = add(add(housing.position, times(rho, e_r)), [0.0, 0.0, v]);
        // w and w_z are those in space; along the cage's turning it goes with the outer ring's centre.
        let velocity =
            add(add(times(w, e_r), [0.0, 0.0, w_z]), times(dot(housing.velocity, e_t) + rho * turns[0][1], e_t));
        let contacts = [0, 1].map(|side| {
            let touch = seen(&poses[side], place, velocity);
            let direction = match side {
                0 => touch.turning(),
                _ => [turns[0][0] + TAU * j as f64 / self.count as f64, turns[0][1]],
            };
            touch.pushed(&self.grooves[side], self.surfaces.over(side, j, direction, &turns), dampers)
        });
        Ball { contacts, place: [u, v] }
    }
}
