//! What holds rings and sensor: a spring and a damper from each ring to the ground, and from the sensor to the outer
//! ring.
//!
//! ```text
//! f_i = −k_i x_i − c_i v_i        f_o = −k_o x_o − c_o v_o + f_s e_y        f_s = k_s (y_s − y_o) + c_s (v_s − v_o)
//! ```
//! f_s acts on the sensor the other way. That is written once, in [`Supports::forces`]; right-hand side, Jacobian,
//! equilibrium and derivatives of outputs take it from there.

use super::kinematics::{Kinematics, RingState};
use crate::numerics::lanes::{Lanes, QUAD, Wide};
use crate::numerics::plane::Vector;
use crate::scene::{Motion, Ring, Scene};

/// Coordinates of the bodies beside the elements: inner ring x, y, outer ring x, y, sensor y.
pub const BODIES: usize = 5;

/// One number for each coordinate of the bodies.
pub type Bodies = nalgebra::SVector<f64, BODIES>;
/// A linear map between them.
pub type BodyMatrix = nalgebra::SMatrix<f64, BODIES, BODIES>;

/// A body's spring and damper, and how easily forces accelerate it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Stiffness k [N/m].
    pub stiffness: f64,
    /// Damping c [N s/m].
    pub damping: f64,
    /// 1/mass [1/kg]; 0 for a ring that forces do not move.
    pub inverse_mass: f64,
}

/// Supports of both rings and of the sensor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Supports {
    /// The inner ring's, to the ground.
    pub shaft: Support,
    /// The outer ring's, to the ground.
    pub housing: Support,
    /// The sensor's, to the outer ring.
    pub sensor: Option<Support>,
}

impl Support {
    fn of_ring(ring: &Ring) -> Self {
        let inverse_mass = if ring.motion == Motion::Internal { 1.0 / ring.mass } else { 0.0 };
        Self { stiffness: ring.stiffness, damping: ring.damping, inverse_mass }
    }

    /// Force [N] for a displacement [m] and a velocity [m/s].
    #[inline(always)]
    fn force(&self, x: f64, v: f64) -> f64 {
        self.stiffness * x + self.damping * v
    }
}

impl Supports {
    /// Those of a scene.
    pub fn new(scene: &Scene) -> Self {
        let sensor = scene.sensor.map(|sensor| Support {
            stiffness: sensor.stiffness,
            damping: sensor.damping,
            inverse_mass: 1.0 / sensor.mass,
        });
        Self { shaft: Support::of_ring(&scene.shaft), housing: Support::of_ring(&scene.housing), sensor }
    }

    /// Support of each ring, the inner first.
    pub fn rings(&self) -> [&Support; 2] {
        [&self.shaft, &self.housing]
    }

    /// 1/mass of each coordinate [1/kg]; 0 where forces move nothing.
    pub fn inverse_masses(&self) -> Bodies {
        let [shaft, housing] = self.rings().map(|ring| ring.inverse_mass);
        Bodies::from([shaft, shaft, housing, housing, self.sensor.map_or(0.0, |sensor| sensor.inverse_mass)])
    }

    /// Force f_s of the sensor on the outer ring along y [N].
    #[inline(always)]
    pub fn sensor_force(&self, y: f64, v: f64, housing: &RingState) -> f64 {
        self.sensor.map_or(0.0, |sensor| sensor.force(y - housing.position.y, v - housing.velocity.y))
    }

    /// Forces on the bodies [N] for their displacements [m] and velocities [m/s].
    pub fn forces(&self, x: &Bodies, v: &Bodies) -> Bodies {
        let housing = RingState { position: Vector::new(x[2], x[3]), velocity: Vector::new(v[2], v[3]) };
        let sensor = self.sensor_force(x[4], v[4], &housing);
        let ground = |i: usize, support: &Support| -support.force(x[i], v[i]);
        let [shaft, outer] = self.rings();
        Bodies::from([ground(0, shaft), ground(1, shaft), ground(2, outer), ground(3, outer) + sensor, -sensor])
    }

    /// Accelerations of the bodies by their positions [1/s²] and by their velocities [1/s].
    pub fn accelerations_by_motion(&self) -> [BodyMatrix; 2] {
        let (masses, none) = (self.inverse_masses(), Bodies::zeros());
        let column = |forces: Bodies| forces.component_mul(&masses);
        let unit = |k: usize| Bodies::from_fn(|i, _| if i == k { 1.0 } else { 0.0 });
        let (mut by_position, mut by_velocity) = (BodyMatrix::zeros(), BodyMatrix::zeros());
        for k in 0..BODIES {
            by_position.set_column(k, &column(self.forces(&unit(k), &none)));
            by_velocity.set_column(k, &column(self.forces(&none, &unit(k))));
        }
        [by_position, by_velocity]
    }

    /// Derivative of the sensor's state by time, into lanes.
    #[inline(always)]
    pub(super) fn sensor_rates<S: Wide>(&self, simd: S, v: f64, force: f64) -> Lanes<S::Quad> {
        let inverse_mass = self.sensor.map_or(0.0, |sensor| sensor.inverse_mass);
        whole(simd, [v, 0.0, 0.0, 0.0], [0.0, -force * inverse_mass, 0.0, 0.0])
    }
}

impl Support {
    /// Velocity and acceleration of a ring, `force` [N] being all that acts on it beside its support.
    #[inline(always)]
    pub(super) fn ring_rates<S: Wide>(&self, simd: S, at: &RingState, force: Vector) -> Lanes<S::Quad> {
        let (x, v) = (at.position, at.velocity);
        let along = (force - v * self.damping - x * self.stiffness) * self.inverse_mass;
        whole(simd, [v.x, v.y, 0.0, 0.0], [0.0, 0.0, along.x, along.y])
    }
}

impl Kinematics {
    /// Displacements and velocities of the bodies, the sensor's being `y` and `v`.
    pub fn bodies(&self, y: f64, v: f64) -> [Bodies; 2] {
        let of =
            |shaft: Vector, housing: Vector, sensor| Bodies::from([shaft.x, shaft.y, housing.x, housing.y, sensor]);
        [of(self.shaft.position, self.housing.position, y), of(self.shaft.velocity, self.housing.velocity, v)]
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
        Supports {
            shaft: Support { stiffness: 3.0, damping: 0.5, inverse_mass: 0.25 },
            housing: Support { stiffness: 7.0, damping: 0.25, inverse_mass: 0.5 },
            sensor: Some(Support { stiffness: 11.0, damping: 2.0, inverse_mass: 4.0 }),
        }
    }

    #[test]
    fn spring_and_damper_forces_are_those_of_hookes_law() {
        let (x, v) = (Bodies::from([1.0, 2.0, 3.0, 4.0, 5.0]), Bodies::from([0.0, 0.0, 2.0, 0.0, 3.0]));
        // Sensor: 11 (5 − 4) + 2 (3 − 0) = 17.
        assert_eq!(supports().forces(&x, &v), Bodies::from([-3.0, -6.0, -21.5, -28.0 + 17.0, -17.0]));
    }

    #[test]
    fn the_matrices_are_the_forces_per_mass() {
        let supports = supports();
        let [by_position, by_velocity] = supports.accelerations_by_motion();
        let (x, v) = (Bodies::from([1.0, -2.0, 0.5, 4.0, -3.0]), Bodies::from([2.0, 1.0, -1.0, 0.25, 8.0]));
        let wanted = supports.forces(&x, &v).component_mul(&supports.inverse_masses());
        // Small whole numbers and binary fractions: exact.
        assert_eq!(by_position * x + by_velocity * v, wanted);
    }
}
