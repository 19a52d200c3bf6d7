//! What holds rings and sensors: a spring and a damper from each ring to the ground, and from each sensor to the outer
//! ring.
//!
//! ```text
//! f_i = −k_i x_i − c_i v_i     f_o = −k_o x_o − c_o v_o + Σ f_s e     f_s = k_s (s − x_o·e) + c_s (v_s − v_o·e)
//! ```
//! f_s acts on the sensor the other way, along its direction e. Three functions say so, because shipped bits depend on
//! the order of terms:
//!
//! - [`Supports::forces`], all bodies at once, of which Jacobian and derivatives of outputs are made;
//! - `Support::ring_rates` for the right-hand side, which sums (F − c v − k x)/m with all other forces F on a ring, not
//!   F/m − (k x + c v)/m; a sensor's part is [`SensorSupport::force`] in both;
//! - `Supports::ring_stiffnesses` for what is at rest, equilibrium and tangent: there only the rings' springs are left.

mod sensor_modes;

pub use sensor_modes::SensorModes;

pub(crate) use sensor_modes::StepEnds;

use super::kinematics::{Kinematics, RingState};
use crate::numerics::lanes::{Lanes, QUAD, Wide};
use crate::numerics::plane::Vector;
use crate::scene::{MOST_SENSORS, Motion, Ring, Scene};
use nalgebra::Vector4;
use std::sync::Arc;

/// Coordinates of both rings in the plane: inner ring x, y, outer ring x, y.
pub const PLANE_RINGS: usize = 4;
/// Coordinates of the bodies beside the elements: those of the rings, each sensor along its direction.
pub const BODIES: usize = PLANE_RINGS + MOST_SENSORS;
/// Coordinates of the bodies where there is one sensor at most.
pub const FEW_BODIES: usize = PLANE_RINGS + 1;

/// One number for each coordinate of the bodies.
pub type Bodies = nalgebra::SVector<f64, BODIES>;
/// A linear map between them, of [`BODIES`] or, with one sensor at most, of the first [`FEW_BODIES`].
pub type BodyMatrix = nalgebra::DMatrix<f64>;

/// A body's spring and damper, and how easily forces accelerate it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Stiffness k (N/m).
    pub stiffness: f64,
    /// Damping c (N s/m).
    pub damping: f64,
    /// 1/mass (1/kg); 0 for a ring that forces do not move.
    pub inverse_mass: f64,
}

/// A sensor's spring and damper, and the direction along which it moves against the outer ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensorSupport {
    /// Spring, damper and mass.
    pub support: Support,
    /// Unit vector.
    pub direction: Vector,
}

/// Supports of both rings and of the sensors.
#[derive(Debug, Clone, PartialEq)]
pub struct Supports {
    /// The inner ring's, to the ground.
    pub shaft: Support,
    /// The outer ring's, to the ground.
    pub housing: Support,
    /// The sensors', to the outer ring.
    pub sensors: Vec<SensorSupport>,
    /// Accelerations of the bodies by their positions (1/s²) and by their velocities (1/s).
    accelerations: Arc<[BodyMatrix; 2]>,
}

impl Support {
    fn of_ring(ring: &Ring) -> Self {
        let inverse_mass = if ring.motion == Motion::Internal { 1.0 / ring.mass } else { 0.0 };
        Self { stiffness: ring.stiffness, damping: ring.damping, inverse_mass }
    }

    /// Force (N) for a displacement (m) and a velocity (m/s).
    #[inline(always)]
    fn force(&self, x: f64, v: f64) -> f64 {
        self.stiffness * x + self.damping * v
    }
}

impl Supports {
    /// Those of a scene.
    pub fn new(scene: &Scene) -> Self {
        let sensors = scene.sensors.iter().map(|sensor| SensorSupport {
            support: Support { stiffness: sensor.stiffness, damping: sensor.damping, inverse_mass: 1.0 / sensor.mass },
            direction: sensor.unit().into(),
        });
        Self::of(Support::of_ring(&scene.shaft), Support::of_ring(&scene.housing), sensors.collect())
    }

    fn of(shaft: Support, housing: Support, sensors: Vec<SensorSupport>) -> Self {
        let none = BodyMatrix::zeros(0, 0);
        let supports = Self { shaft, housing, sensors, accelerations: Arc::new([none.clone(), none]) };
        let accelerations = Arc::new(supports.worked_out());
        Self { accelerations, ..supports }
    }

    /// Size of a [`BodyMatrix`] here.
    pub fn size(&self) -> usize {
        if self.sensors.len() > 1 { BODIES } else { FEW_BODIES }
    }

    /// Support of each ring, the inner first.
    pub fn rings(&self) -> [&Support; 2] {
        [&self.shaft, &self.housing]
    }

    /// Stiffness of the rings' springs (N/m), for each coordinate: inner ring x, y, outer ring x, y.
    pub(in crate::dynamics) fn ring_stiffnesses(&self) -> [f64; 4] {
        let [shaft, housing] = self.rings().map(|ring| ring.stiffness);
        [shaft, shaft, housing, housing]
    }

    /// 1/mass of each coordinate (1/kg); 0 where forces move nothing.
    pub fn inverse_masses(&self) -> Bodies {
        let [shaft, housing] = self.rings().map(|ring| ring.inverse_mass);
        let mut masses = Bodies::zeros();
        masses.fixed_rows_mut::<4>(0).copy_from_slice(&[shaft, shaft, housing, housing]);
        for (mass, sensor) in masses.iter_mut().skip(4).zip(&self.sensors) {
            *mass = sensor.support.inverse_mass;
        }
        masses
    }

    /// Forces on the bodies (N) for their displacements (m) and velocities (m/s).
    fn forces(&self, x: &Bodies, v: &Bodies) -> Bodies {
        let housing = RingState { position: Vector::new(x[2], x[3]), velocity: Vector::new(v[2], v[3]) };
        let ground = |i: usize, support: &Support| -support.force(x[i], v[i]);
        let [shaft, outer] = self.rings();
        let mut forces = Bodies::zeros();
        forces.fixed_rows_mut::<4>(0).copy_from_slice(&[
            ground(0, shaft),
            ground(1, shaft),
            ground(2, outer),
            ground(3, outer),
        ]);
        for (k, sensor) in self.sensors.iter().enumerate() {
            let force = sensor.force(x[4 + k], v[4 + k], &housing);
            forces[2] += force * sensor.direction.x;
            forces[3] += force * sensor.direction.y;
            forces[4 + k] = -force;
        }
        forces
    }

    /// Accelerations (m/s²) of bodies at these displacements (m) and velocities (m/s), `acting` on the rings (N) beside
    /// their supports. Linear, so of changes too.
    pub fn accelerations(&self, x: &Bodies, v: &Bodies, acting: &Vector4<f64>) -> Bodies {
        let mut forces = self.forces(x, v);
        let mut on_rings = forces.fixed_rows_mut::<4>(0);
        on_rings += acting;
        forces.component_mul(&self.inverse_masses())
    }

    /// Accelerations of the bodies by their positions (1/s²) and by their velocities (1/s).
    pub fn accelerations_by_motion(&self) -> &[BodyMatrix; 2] {
        &self.accelerations
    }

    fn worked_out(&self) -> [BodyMatrix; 2] {
        let (masses, none) = (self.inverse_masses(), Bodies::zeros());
        let size = self.size();
        let column = |forces: Bodies| forces.component_mul(&masses).rows(0, size).into_owned();
        let unit = |k: usize| Bodies::from_fn(|i, _| if i == k { 1.0 } else { 0.0 });
        let (mut by_position, mut by_velocity) = (BodyMatrix::zeros(size, size), BodyMatrix::zeros(size, size));
        for k in 0..4 + self.sensors.len() {
            by_position.set_column(k, &column(self.forces(&unit(k), &none)));
            by_velocity.set_column(k, &column(self.forces(&none, &unit(k))));
        }
        [by_position, by_velocity]
    }
}

impl SensorSupport {
    /// Force f_s of the sensor on the outer ring along its direction (N), for its displacement (m) and velocity (m/s)
    /// along it.
    #[inline(always)]
    pub fn force(&self, s: f64, v: f64, housing: &RingState) -> f64 {
        let e = self.direction;
        self.support.force(s - housing.position.dot(&e), v - housing.velocity.dot(&e))
    }

    /// Derivative of the sensor's state by time, into lanes.
    #[inline(always)]
    pub(in crate::dynamics) fn rates<S: Wide>(&self, simd: S, v: f64, force: f64) -> Lanes<S::Quad> {
        whole(simd, [v, 0.0, 0.0, 0.0], [0.0, -force * self.support.inverse_mass, 0.0, 0.0])
    }
}

impl Support {
    /// Velocity and acceleration of a ring, `force` (N) being all that acts on it beside its support.
    #[inline(always)]
    pub(in crate::dynamics) fn ring_rates<S: Wide>(&self, simd: S, at: &RingState, force: Vector) -> Lanes<S::Quad> {
        let (x, v) = (at.position, at.velocity);
        let along = (force - v * self.damping - x * self.stiffness) * self.inverse_mass;
        whole(simd, [v.x, v.y, 0.0, 0.0], [0.0, 0.0, along.x, along.y])
    }
}

impl Kinematics {
    /// Displacements and velocities of the bodies, those of the sensors being zero.
    pub fn bodies(&self) -> [Bodies; 2] {
        let of = |shaft: Vector, housing: Vector| {
            Bodies::from_iterator([shaft.x, shaft.y, housing.x, housing.y].into_iter().chain([0.0; MOST_SENSORS]))
        };
        [of(self.shaft.position, self.housing.position), of(self.shaft.velocity, self.housing.velocity)]
    }
}

/// The sum of two quadruples, written at once: the compiler would write one that is put together in two halves, and
/// reading them together soon after would have to wait.
#[inline(always)]
fn whole<S: Wide>(simd: S, one: [f64; QUAD], other: [f64; QUAD]) -> Lanes<S::Quad> {
    Lanes::of(simd, one) + Lanes::of(simd, other)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn supports() -> Supports {
        let sensor = Support { stiffness: 11.0, damping: 2.0, inverse_mass: 4.0 };
        Supports::of(
            Support { stiffness: 3.0, damping: 0.5, inverse_mass: 0.25 },
            Support { stiffness: 7.0, damping: 0.25, inverse_mass: 0.5 },
            [[0.0, 1.0], [0.5, -0.5]].map(|e| SensorSupport { support: sensor, direction: e.into() }).to_vec(),
        )
    }

    fn bodies(first: [f64; 6]) -> Bodies {
        Bodies::from_iterator(first.into_iter().chain([0.0; BODIES - 6]))
    }

    #[test]
    fn spring_and_damper_forces_are_those_of_hookes_law() {
        let (x, v) = (bodies([1.0, 2.0, 3.0, 4.0, 5.0, 0.5]), bodies([0.0, 0.0, 2.0, 0.0, 3.0, 1.0]));
        // Sensors: 11 (5 − 4) + 2 (3 − 0) = 17 upwards; 11 (0.5 + 0.5) + 2 (1 − 1) = 11, half of it to the right and
        // downwards.
        let wanted = bodies([-3.0, -6.0, -21.5 + 5.5, -28.0 + 17.0 - 5.5, -17.0, -11.0]);
        assert_eq!(supports().forces(&x, &v), wanted);
    }

    #[test]
    fn the_matrices_are_the_forces_per_mass() {
        let supports = supports();
        let [by_position, by_velocity] = supports.accelerations_by_motion();
        let (x, v) = (bodies([1.0, -2.0, 0.5, 4.0, -3.0, 1.0]), bodies([2.0, 1.0, -1.0, 0.25, 8.0, -2.0]));
        let wanted = supports.forces(&x, &v).component_mul(&supports.inverse_masses());
        // Small whole numbers and binary fractions: exact.
        assert_eq!(by_position * x + by_velocity * v, nalgebra::DVector::from_column_slice(wanted.as_slice()));
    }
}
