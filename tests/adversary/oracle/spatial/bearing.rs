//! The numbers of a bearing in space, and the rates of its state.

use super::case::{AxialSetting, Body, Gyroscopic, Host, SpatialCase, SpatialRing};
use super::contact::{Groove, Pose, Touch, seen};
use super::spall::Path;
use super::vector::{Vector, add, cross, dot, times};
use crate::case::{Damping, Motion};
use crate::hertz;
use crate::turning::quadratic;
use std::f64::consts::{PI, TAU};

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
    paths: [Vec<Path>; 2],
    pub(super) damping: Damping,
    pub(super) across: f64,
    /// Speed of the cage per speed of shaft and housing.
    pub cage: [f64; 2],
    pub cage_start: f64,
    /// Speeds of shaft and housing at the start (rad/s).
    pub speeds: [f64; 2],
}

/// What the host says for a step, and how cage, shaft and housing turn in it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Outside {
    pub(super) turns: [[f64; 3]; 3],
    pub(super) rings: [[[f64; 3]; 5]; 2],
}

/// One ball.
#[derive(Debug, Clone, Copy, Default)]
pub struct Ball {
    /// Inner, outer.
    pub contacts: [Touch; 2],
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

impl SpatialBearing {
    pub fn new(case: &SpatialCase) -> Self {
        let (d, pitch) = (case.diameter_mm * 1e-3, case.pitch_mm * 1e-3);
        let r = d / 2.0;
        let [f_i, f_o] = case.conformities;
        let [l_i, l_o] = [f_i * d - r, f_o * d - r];
        let a = l_i + l_o;
        let free = match case.setting {
            AxialSetting::Radial(um) => (1.0 - um.max(0.0) * 1e-6 / a).acos(),
            AxialSetting::Play(um) => (um * 1e-6 / (2.0 * a)).asin(),
            AxialSetting::Angle(degrees) => degrees * PI / 180.0,
        };
        let (clearance, lean) = match case.setting {
            AxialSetting::Radial(um) => (um * 1e-6, None),
            AxialSetting::Play(_) => (a * (1.0 - free.cos()), None),
            AxialSetting::Angle(_) => (a * (1.0 - free.cos()), Some(free)),
        };
        let (r_o, r_i) = ((pitch + d + clearance) / 2.0, (pitch - d - clearance) / 2.0);
        let modulus = case.modulus_gpa * 1e9 / (2.0 * (1.0 - case.poisson * case.poisson));
        let along = along_rolling(lean, [r_i, r_o], pitch, r);
        let constant = |side: usize| {
            let curvatures = [1.0 / r + along[side], 1.0 / r - 1.0 / (case.conformities[side] * d)];
            case.hertz[side].unwrap_or_else(|| hertz::stiffness(curvatures, modulus))
        };
        let sine = lean.map_or(0.0, f64::sin);
        let (cos_n, gamma) = ((case.operating_deg * PI / 180.0).cos(), d / pitch);
        // Of the grooves at the track's angle: its circle, and the paths along it.
        let path = |spall: &super::case::Spall| {
            let hollow = spall.on == Body::Outer;
            let bottom = if hollow { r_o } else { r_i };
            let track = if hollow { r_o - f_o * d * (1.0 - cos_n) } else { r_i + f_i * d * (1.0 - cos_n) };
            // Its length is that of the arc at the groove's bottom, whatever the track.
            let half = spall.length_mm * 1e-3 / (2.0 * bottom);
            let size = [spall.angle_deg * PI / 180.0, half, spall.depth_um * 1e-6];
            Path::new(track, cos_n, r, hollow, size)
        };
        let paths = [Body::Inner, Body::Outer]
            .map(|body| case.spalls.iter().filter(|spall| spall.on == body).map(path).collect());
        Self {
            count: case.count,
            radius: r,
            rho_0: r_o - r,
            mass: case.mass_g.map_or(case.density * 4.0 / 3.0 * PI * r * r * r, |mass| mass * 1e-3),
            gravity: case.gravity,
            clearance,
            pitch,
            rings: case.rings,
            freedom: case.freedom,
            gyroscopic: case.gyroscopic,
            sense: if sine < 0.0 { -1.0 } else { 1.0 },
            grooves: [
                Groove { inner: true, circle: r_i + f_i * d, shift: l_i * sine, touching: l_i, stiffness: constant(0) },
                Groove {
                    inner: false,
                    circle: r_o - f_o * d,
                    shift: -l_o * sine,
                    touching: l_o,
                    stiffness: constant(1),
                },
            ],
            paths,
            damping: case.damping,
            across: case.across,
            cage: [1.0 - gamma * cos_n, 1.0 + gamma * cos_n].map(|part| 0.5 * part * (1.0 - case.slip)),
            cage_start: case.cage_deg * PI / 180.0,
            speeds: [case.speed_hz, case.housing_hz.unwrap_or(0.0)].map(|hz| TAU * hz),
        }
    }

    /// Hertz constants, inner and outer.
    pub fn constants(&self) -> [f64; 2] {
        self.grooves.map(|groove| groove.stiffness)
    }

    /// Axial places of the circles of groove centres, inner and outer.
    pub fn shifts(&self) -> [f64; 2] {
        self.grooves.map(|groove| groove.shift)
    }

    /// How many numbers a state has.
    pub fn state_count(&self) -> usize {
        BALLS + 4 * self.count
    }

    /// What the host's speeds and inputs are, from the angles of cage, shaft and housing.
    pub(super) fn outside(&self, angles: [f64; 3], host: &Host) -> Outside {
        let cage = [0, 1].map(|order| self.cage[0] * host.speeds[0][order] + self.cage[1] * host.speeds[1][order]);
        let of = |which: usize, [speed, rate]: [f64; 2]| [angles[which], speed, rate];
        Outside { turns: [of(0, cage), of(1, host.speeds[0]), of(2, host.speeds[1])], rings: host.rings }
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

    /// Ball `j` between two poses; u, w, v, w_z are its numbers.
    pub(super) fn ball(&self, outside: &Outside, t: f64, poses: &[Pose; 2], j: usize, of: [f64; 4]) -> Ball {
        let turns = outside.turns.map(|turn| quadratic(turn, t));
        let ([e_r, e_t], [u, w, v, w_z]) = (self.directions(outside, t, j), of);
        let housing = &poses[1];
        let rho = self.rho_0 + u;
        let place = add(add(housing.position, times(rho, e_r)), [0.0, 0.0, v]);
        // w and w_z are those in space; along the cage's turning it goes with the outer ring's centre.
        let velocity =
            add(add(times(w, e_r), [0.0, 0.0, w_z]), times(dot(housing.velocity, e_t) + rho * turns[0][1], e_t));
        let contacts = [0, 1].map(|side| {
            let touch = seen(&poses[side], place, velocity);
            let [mut angle, mut rate] = touch.turning();
            if side == 1 {
                (angle, rate) = (turns[0][0] + TAU * j as f64 / self.count as f64, turns[0][1]);
            }
            let (ring, speed) = (turns[1 + side][0], turns[1 + side][1]);
            let sunk = self.paths[side].iter().map(|path| path.sunk(angle - ring)).find(|sunk| sunk[0] > 0.0);
            touch.pushed(&self.grooves[side], sunk.unwrap_or_default(), rate - speed, self.damping, self.across)
        });
        Ball { contacts }
    }

    /// Times in a step at which an outer contact comes to a corner of its path.
    pub(super) fn passages(&self, outside: &Outside, length: f64) -> Vec<f64> {
        let mut times = Vec::new();
        let past: [f64; 3] = std::array::from_fn(|k| outside.turns[0][k] - outside.turns[2][k]);
        for path in &self.paths[1] {
            for (j, corner) in (0..self.count).flat_map(|j| path.corners().into_iter().map(move |corner| (j, corner))) {
                let start = past[0] + TAU * j as f64 / self.count as f64 - path.centre - corner;
                crossings([start, past[1], past[2]], length, &mut times);
            }
        }
        times.sort_by(f64::total_cmp);
        times
    }

    /// What acts, and the rates of the state.
    pub(super) fn rates(&self, outside: &Outside, t: f64, y: &[f64], out: &mut [f64], acting: &mut Acting) {
        let poses = [0, 1].map(|which| self.pose(which, outside, t, y));
        let [_, omega, _] = quadratic(outside.turns[0], t);
        acting.balls.clear();
        acting.rings = [[0.0; 5]; 2];
        for j in 0..self.count {
            let at = BALLS + 4 * j;
            let of: [f64; 4] = std::array::from_fn(|k| y[at + k]);
            let ball = self.ball(outside, t, &poses, j, of);
            let [e_r, e_t] = self.directions(outside, t, j);
            let force = add(ball.contacts[0].on_ball, ball.contacts[1].on_ball);
            let (housing, rho) = (poses[1].velocity, self.rho_0 + of[0]);
            out[at] = of[1] - dot(e_r, housing);
            out[at + 1] =
                dot(force, e_r) / self.mass + dot(self.gravity, e_r) + omega * (dot(housing, e_t) + rho * omega);
            out[at + 2] = of[3] - housing[2];
            out[at + 3] = force[2] / self.mass + self.gravity[2];
            for (which, touch) in ball.contacts.iter().enumerate() {
                let moment = cross(touch.arm, touch.on_ball);
                let of_ring = [touch.on_ball[0], touch.on_ball[1], touch.on_ball[2], moment[0], moment[1]];
                (0..5).for_each(|a| acting.rings[which][a] -= of_ring[a]);
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

/// Curvatures of both raceways along rolling (1/m): at a free contact angle, or at the grooves' bottoms.
fn along_rolling(lean: Option<f64>, [r_i, r_o]: [f64; 2], pitch: f64, r: f64) -> [f64; 2] {
    let Some(cos) = lean.map(f64::cos) else { return [1.0 / r_i, -1.0 / r_o] };
    [cos / (pitch / 2.0 - r * cos), -cos / (pitch / 2.0 + r * cos)]
}

/// Times up to `length` at which an angle that changes by a quadratic is a whole number of turns.
fn crossings([start, speed, rate]: [f64; 3], length: f64, times: &mut Vec<f64>) {
    let at = |t: f64| start + t * (speed + 0.5 * t * rate);
    let reversal = -speed / rate;
    let turn = if reversal > 0.0 && reversal < length { reversal } else { length };
    for (from, to) in [(0.0, turn), (turn, length)] {
        let (low, high) = (at(from).min(at(to)), at(from).max(at(to)));
        let mut whole = (low / TAU).ceil();
        while to > from && whole * TAU <= high {
            let (mut early, mut late) = (from, to);
            for _ in 0..80 {
                let middle = 0.5 * (early + late);
                if (at(middle) < whole * TAU) == (at(to) > at(from)) { early = middle } else { late = middle }
            }
            times.push(late);
            whole += 1.0;
        }
    }
}
