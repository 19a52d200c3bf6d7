//! What a bearing has in space beyond the plane: grooves, motion along the axis, tilt.
//!
//! A ring has five coordinates: x, y, z, and its tilt about x and about y; with three degrees of freedom it does not
//! tilt. Rings move, beside the contacts' forces F and moments M, as
//! ```text
//! m x'' = F + load − c x' − k x                 along each axis, z with its own c and k
//! I_t φ_x'' + I_p Ω φ_y' = M_x + L_x − c_t φ_x' − k_t φ_x      Ω the ring's speed
//! I_t φ_y'' − I_p Ω φ_x' = M_y + L_y − c_t φ_y' − k_t φ_y
//! f_s = k_s (s − x_o·e) + c_s (s' − x_o'·e)     of a sensor on the outer ring, along e; m_s s'' = −f_s
//! ```
//! Tilts are small, and moments are about axes that stand.

use crate::contact::element_on_raceway::ElementOnRaceway;
use crate::contact::groove::Groove;
use crate::contact::law::elastic_law;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::parameters::excitation::{COORDINATES, Excitation, Frame};
use crate::dynamics::parameters::kinematics::RingState;
use crate::dynamics::parameters::layout::Layout;
use crate::geometry::hertz_constant::rolling_radii;
use crate::numerics::number::Scalar;
use crate::numerics::plane::Vector;
use crate::scene::{Bearing, DegreesOfFreedom, Gyroscopic, MOST_SENSORS, Motion, Ring, Scene};

/// Coordinates of both rings.
pub const RINGS: usize = 2 * COORDINATES;
/// Coordinates of the bodies beside the elements: those of the inner ring, of the outer ring, and each sensor's.
pub const SPATIAL_BODIES: usize = RINGS + MOST_SENSORS;

/// Coordinates of the bodies where there is one sensor at most.
pub const FEW_SPATIAL_BODIES: usize = RINGS + 1;

/// One number for each coordinate of the bodies.
pub type SpatialBodies<T = f64> = [T; SPATIAL_BODIES];

/// A ring in space: x, y, z (m), tilt about x and y (rad), or what acts along them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RingInSpace<T = f64> {
    /// Coordinates.
    pub position: [T; COORDINATES],
    /// Their rates (1/s).
    pub velocity: [T; COORDINATES],
}

/// What a bearing has beyond the plane.
#[derive(Debug, Clone, PartialEq)]
pub struct Space {
    /// The grooves of the inner and of the outer ring.
    pub grooves: [Groove; 2],
    /// Angles (rad) from the bottoms of the grooves to their shoulders, where the scene has them.
    pub shoulders: [Option<f64>; 2],
    /// Half-lengths of the contact ellipses across the grooves under 1 N (m), which grow with the cube root of the
    /// force.
    pub half_lengths: [f64; 2],
    /// Damping of balls across the grooves χ_a (s/m).
    pub across_damping: f64,
    /// Twice the shares of the balls' gyroscopic couple that the inner and the outer contact hold.
    pub couple_shares: [f64; 2],
    /// Gravity along z (m/s²).
    pub gravity: f64,
    /// Half the pitch diameter (m), which makes a length of a tilt.
    pub pitch_radius: f64,
    /// Largest distance (m) of the rings along z, that of the grooves' centres.
    pub largest_shift: f64,
    /// Force of the preload springs on both rings along z (N).
    pub preload: [f64; 2],
    /// Whether rings may tilt.
    pub tilts: bool,
    /// Which coordinates of the rings forces move.
    pub free: [bool; RINGS],
    /// Support of each body.
    bodies: [Body; SPATIAL_BODIES],
    /// Moments of inertia of both rings about z (kg m²).
    polar_inertia: [f64; 2],
    /// Directions of the sensors.
    sensors: Vec<[f64; 3]>,
}

/// How one coordinate of a body is held.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Body {
    stiffness: f64,
    damping: f64,
    /// 0 of one that forces do not move.
    inverse_inertia: f64,
}

impl Space {
    /// Of a scene; `None` of rings that stay in their plane.
    pub(super) fn of(scene: &Scene) -> Option<Box<Self>> {
        let (bearing, freedom) = (&scene.bearing, scene.bearing.degrees_of_freedom);
        if freedom == DegreesOfFreedom::Two {
            return None;
        }
        let (mut free, mut bodies) = ([false; RINGS], [Body::default(); SPATIAL_BODIES]);
        let tilts = freedom == DegreesOfFreedom::Five;
        for (ring, (of, tilts)) in [(&scene.shaft, tilts), (&scene.housing, false)].into_iter().enumerate() {
            for (k, body) in bodies_of(of).into_iter().enumerate() {
                let moves = of.motion == Motion::Internal && (k < 3 || tilts);
                free[COORDINATES * ring + k] = moves;
                let inverse_inertia = if moves { body.inverse_inertia } else { 0.0 };
                bodies[COORDINATES * ring + k] = Body { inverse_inertia, ..body };
            }
        }
        for (body, sensor) in bodies.iter_mut().skip(RINGS).zip(&scene.sensors) {
            let (stiffness, damping) = (sensor.stiffness, sensor.damping);
            *body = Body { stiffness, damping, inverse_inertia: 1.0 / sensor.mass };
        }
        let sense = bearing.axial_sense();
        Some(Box::new(Self {
            grooves: Groove::of(bearing),
            shoulders: [(bearing.shoulder_inner, 0), (bearing.shoulder_outer, 1)]
                .map(|(height, side)| height.map(|height| libm::acos(1.0 - height / bearing.groove_radii()[side]))),
            half_lengths: half_lengths(bearing),
            across_damping: scene.contact.damping_across(),
            couple_shares: match bearing.gyroscopic {
                Gyroscopic::None => [0.0; 2],
                Gyroscopic::Outer => [0.0, 2.0],
                Gyroscopic::Shared => [1.0; 2],
            },
            gravity: scene.axial_gravity,
            pitch_radius: 0.5 * bearing.pitch_diameter,
            largest_shift: bearing.groove_distance(),
            preload: [sense * scene.shaft.axial.preload, -sense * scene.housing.axial.preload],
            tilts,
            free,
            bodies,
            polar_inertia: [&scene.shaft, &scene.housing].map(|ring| ring.tilt.polar_inertia),
            sensors: scene.sensors.iter().map(|sensor| sensor.unit_in_space()).collect(),
        }))
    }

    /// Length (m) of a unit of each coordinate: that of the pitch radius of a tilt.
    pub fn length(&self, coordinate: usize) -> f64 {
        if coordinate % COORDINATES < 3 { 1.0 } else { self.pitch_radius }
    }

    /// θ_s − |α| − a/r_g (rad) of a contact at the angle α (rad) under a force (N).
    pub fn shoulder_margin<T: Scalar>(&self, side: usize, angle: T, force: T) -> T {
        let (ends, none) = (T::from(self.shoulders[side].unwrap_or(0.0)), T::from(0.0));
        let from_bottom = angle.if_less(none, -angle, angle);
        ends - from_bottom - self.half_length(side, force) / T::from(self.grooves[side].radius)
    }

    /// Half-length (m) of the ellipse of a contact across the groove under a force (N), which grows with its cube root.
    fn half_length<T: Scalar>(&self, side: usize, force: T) -> T {
        let root = libm::cbrt(force.value().max(0.0));
        if root == 0.0 {
            return T::from(0.0);
        }
        T::root_of(root, 3.0 * root * root, |root| root * root * root - force) * T::Plain::from(self.half_lengths[side])
    }

    /// Whether a contact at the angle α (rad) under a force (N) is beside places across the groove, given by their
    /// `ends` (m), by more than a quarter of its ellipse's half-length.
    pub fn is_beside(&self, ends: [f64; 2], side: usize, angle: f64, force: f64) -> bool {
        let place = self.grooves[side].place_across(angle);
        (ends[0] - place).max(place - ends[1]) > 0.25 * self.half_length(side, force)
    }

    /// 1/inertia of a coordinate (1/kg, 1/(kg m²)); 0 where forces move nothing.
    pub(in crate::dynamics) fn inverse_inertia(&self, coordinate: usize) -> f64 {
        self.bodies[coordinate].inverse_inertia
    }

    /// Mass (kg) or moment of inertia (kg m²) of a coordinate of the rings; `None` where forces move nothing.
    pub fn inertia(&self, coordinate: usize) -> Option<f64> {
        self.free[coordinate].then(|| 1.0 / self.inverse_inertia(coordinate))
    }

    /// Stiffness of the rings' supports (N/m, N m/rad).
    pub(in crate::dynamics) fn support_stiffness(&self, coordinate: usize) -> f64 {
        self.bodies[coordinate].stiffness
    }

    /// Accelerations of the bodies whose positions are `x` and velocities `v`, `acting` on the rings beside their
    /// supports; the rings turn at `speeds` (rad/s). Linear in all but the speeds.
    pub fn accelerations(
        &self,
        x: &SpatialBodies,
        v: &SpatialBodies,
        acting: &[f64; RINGS],
        speeds: [f64; 2],
    ) -> SpatialBodies {
        let mut forces = [0.0; SPATIAL_BODIES];
        for i in 0..RINGS {
            let body = &self.bodies[i];
            forces[i] = acting[i] - body.damping * v[i] - body.stiffness * x[i];
        }
        for (ring, (inertia, speed)) in self.polar_inertia.into_iter().zip(speeds).enumerate() {
            let (about_x, about_y) = (COORDINATES * ring + 3, COORDINATES * ring + 4);
            let spin = inertia * speed;
            forces[about_x] -= spin * v[about_y];
            forces[about_y] += spin * v[about_x];
        }
        for (k, direction) in self.sensors.iter().enumerate() {
            let body = &self.bodies[RINGS + k];
            let along = |of: &SpatialBodies| (0..3).map(|i| of[COORDINATES + i] * direction[i]).sum::<f64>();
            let force = body.stiffness * (x[RINGS + k] - along(x)) + body.damping * (v[RINGS + k] - along(v));
            for i in 0..3 {
                forces[COORDINATES + i] += force * direction[i];
            }
            forces[RINGS + k] = -force;
        }
        std::array::from_fn(|i| forces[i] * self.bodies[i].inverse_inertia)
    }

    /// Change of the same as all of it changes while the rings move as they are; the speeds and how they change. The
    /// gyroscopic couple changes with the speed.
    pub(crate) fn vary_accelerations(
        &self,
        (x, v): (&SpatialBodies, &SpatialBodies),
        acting: &[f64; RINGS],
        rings: &[RingInSpace; 2],
        [speeds, changes]: [[f64; 2]; 2],
    ) -> SpatialBodies {
        let (none, mut present) = ([0.0; SPATIAL_BODIES], [0.0; SPATIAL_BODIES]);
        for (of, ring) in present.chunks_exact_mut(COORDINATES).zip(rings) {
            of.copy_from_slice(&ring.velocity);
        }
        let found = self.accelerations(x, v, acting, speeds);
        let [with, without] = [changes, [0.0; 2]].map(|by| self.accelerations(&none, &present, &[0.0; RINGS], by));
        std::array::from_fn(|i| found[i] + (with[i] - without[i]))
    }

    /// Where a sensor is (m) that moves along with an outer ring at `housing`.
    pub(in crate::dynamics) fn along_sensor(&self, sensor: usize, housing: &[f64; COORDINATES]) -> f64 {
        (0..3).map(|i| housing[i] * self.sensors[sensor][i]).sum()
    }
}

/// Half-lengths of the ellipses across the grooves under 1 N (m), for the curvatures of Hertz's constants.
fn half_lengths(bearing: &Bearing) -> [f64; 2] {
    [RacewaySide::Inner, RacewaySide::Outer].map(|side| {
        let approach = elastic_law(bearing, side).approach_under(1.0);
        let raceway_radius = rolling_radii(bearing)[side as usize];
        ElementOnRaceway { raceway_radius, ..ElementOnRaceway::of(bearing, side) }.contact_half_axes(approach)[1]
    })
}

fn bodies_of(ring: &Ring) -> [Body; COORDINATES] {
    let across = Body { stiffness: ring.stiffness, damping: ring.damping, inverse_inertia: 1.0 / ring.mass };
    let axial = Body { stiffness: ring.axial.stiffness, damping: ring.axial.damping, ..across };
    let tilt = Body {
        stiffness: ring.tilt.stiffness,
        damping: ring.tilt.damping,
        inverse_inertia: 1.0 / ring.tilt.transverse_inertia,
    };
    [across, across, axial, tilt, tilt]
}

/// Rings by coordinates in the order of the bodies, from the order in which forces on them are kept: x and y of the
/// inner ring, then of the outer, z and tilt of the inner ring, then of the outer.
pub const fn force_slot(ring: usize, coordinate: usize) -> usize {
    if coordinate < 2 { 2 * ring + coordinate } else { 2 + 3 * ring + coordinate }
}

impl RingInSpace {
    /// What of it is in the plane.
    pub(in crate::dynamics) fn in_plane(&self) -> RingState {
        let [position, velocity] = [self.position, self.velocity].map(|of| Vector::new(of[0], of[1]));
        RingState { position, velocity }
    }
}

impl From<RingState> for RingInSpace {
    fn from(RingState { position, velocity }: RingState) -> Self {
        let [position, velocity] = [position, velocity].map(|of| [of.x, of.y, 0.0, 0.0, 0.0]);
        Self { position, velocity }
    }
}

impl Excitation {
    /// Both rings' motion at `tau` as the host prescribes it.
    fn prescribed(&self, ring: usize, tau: f64) -> RingInSpace {
        let mut found = RingInSpace::default();
        for (k, motion) in self.motion[ring].iter().enumerate() {
            (found.position[k], found.velocity[k]) = (motion.at(tau), motion.rate_at(tau));
        }
        found
    }

    /// Velocity and acceleration of a ring at `tau` as the host prescribes them.
    pub(in crate::dynamics) fn prescribed_rates(&self, ring: usize, tau: f64) -> RingInSpace {
        let mut found = RingInSpace::default();
        for (k, motion) in self.motion[ring].iter().enumerate() {
            (found.position[k], found.velocity[k]) = (motion.rate_at(tau), motion.second_at(tau));
        }
        found
    }

    /// External loads on both rings (N, N m), and their rates.
    pub(in crate::dynamics) fn loads_in_space(&self, tau: f64) -> [[f64; RINGS]; 2] {
        let mut found = [[0.0; RINGS]; 2];
        for (i, load) in self.load.as_flattened().iter().enumerate() {
            (found[0][i], found[1][i]) = (load.at(tau), load.rate_at(tau));
        }
        found
    }

    /// Speeds of both rings (rad/s), and their rates (rad/s²).
    pub fn ring_speeds(&self, tau: f64) -> [[f64; 2]; 2] {
        let turning = [Frame::Shaft, Frame::Housing].map(|frame| self.frames[frame as usize].since);
        [turning.map(|since| since.rate_at(tau)), turning.map(|since| since.0[2])]
    }
}

impl Layout {
    /// Both rings at `tau`: from the state where it has them, else as the host prescribes, or at rest. Positions are
    /// moved on by the time `ahead` (s).
    pub(in crate::dynamics) fn rings_in_space(
        &self,
        excitation: &Excitation,
        hosted: [bool; 2],
        tau: f64,
        state: &[f64],
        ahead: f64,
    ) -> [RingInSpace; 2] {
        [(0, self.shaft), (1, self.housing)].map(|(ring, start)| match start {
            Some(start) => {
                let velocity = std::array::from_fn(|k| state[start + Self::VELOCITIES[k]]);
                let position = std::array::from_fn(|k| state[start + Self::POSITIONS[k]] + ahead * velocity[k]);
                RingInSpace { position, velocity }
            }
            None if hosted[ring] => excitation.prescribed(ring, tau),
            None => RingInSpace::default(),
        })
    }
}
