//! A small change of state and inputs, and what contact forces make of it.

use crate::dynamics::parameters::{COORDINATES, CageState, Lead, RINGS, RingInSpace, RingState};
use crate::dynamics::quasi_static::Rings;
use crate::numerics::number::Dual;
use crate::numerics::plane::Vector;

/// A small change of state and inputs.
#[derive(Debug, Clone, Default)]
pub struct Variation {
    /// Of the nominal cage angle (rad).
    pub cage_angle: f64,
    /// Of the nominal cage speed (rad/s).
    pub cage_speed: f64,
    /// Of the speed that oil films follow (rad/s).
    pub film_speed: f64,
    /// Of angle (rad) and speed (rad/s) of the frames of defects, in the order of
    /// [`crate::dynamics::parameters::Frame`].
    pub frames: [[f64; 2]; 3],
    /// Of the inner and of the outer ring.
    pub rings: [RingInSpace; 2],
    /// Of the balls' axial positions v (m); of no length in the plane.
    pub axial: Vec<f64>,
    /// Of their axial velocities w_z (m/s).
    pub axial_velocity: Vec<f64>,
    /// Of the element paths u (m).
    pub path: Vec<f64>,
    /// Of the elements' absolute radial velocities w (m/s).
    pub radial_velocity: Vec<f64>,
}

/// What contact forces make of a [`Variation`].
#[derive(Debug, Clone, Default)]
pub struct ForceChange {
    /// Of each inner contact's force (N).
    pub inner: Vec<f64>,
    /// Of each outer contact's force (N).
    pub outer: Vec<f64>,
    /// Of the rates of the elements' paths (m/s).
    pub path_rate: Vec<f64>,
    /// Of the rates of their absolute radial velocities (m/s²).
    pub radial_acceleration: Vec<f64>,
    /// Of the rates of their axial positions (m/s); of no length in the plane.
    pub axial_rate: Vec<f64>,
    /// Of the rates of their axial velocities (m/s²); of no length in the plane.
    pub axial_acceleration: Vec<f64>,
    /// Of the forces (N) and moments (N m) on the inner and on the outer ring.
    pub rings: [[f64; COORDINATES]; 2],
    /// Of each contact angle on the inner and on the outer raceway (rad); of no length in the plane.
    pub contact_angles: [Vec<f64>; 2],
    /// Of the cage torque (N m) while the outer ring's acceleration does not change.
    pub cage_torque: f64,
    /// Of the torque of contacts near its defects on the inner ring (N m).
    pub shaft_torque: f64,
    /// Cage torque by the outer ring's acceleration (kg m).
    pub torque_by_acceleration: Vector,
}

impl Variation {
    /// No change, with room for `count` elements.
    pub fn new(count: usize) -> Self {
        Self { path: vec![0.0; count], radial_velocity: vec![0.0; count], ..Self::default() }
    }

    /// The same, with room for what `count` balls of rings in space do.
    pub fn in_space(count: usize) -> Self {
        Self { axial: vec![0.0; count], axial_velocity: vec![0.0; count], ..Self::new(count) }
    }

    /// Makes it no change again; allocates nothing.
    pub fn clear(&mut self) {
        (self.cage_angle, self.cage_speed, self.frames) = (0.0, 0.0, [[0.0; 2]; 3]);
        self.film_speed = 0.0;
        self.rings = Default::default();
        self.axial.fill(0.0);
        self.axial_velocity.fill(0.0);
        self.path.fill(0.0);
        self.radial_velocity.fill(0.0);
    }

    /// Of both rings in the plane.
    pub(crate) fn in_plane(&self) -> [RingState; 2] {
        self.rings.map(|ring| ring.in_plane())
    }

    /// Of the outer ring's velocity (m/s).
    pub(in crate::dynamics) fn housing_velocity(&self) -> Vector {
        self.rings[1].in_plane().velocity
    }

    /// Moves both rings further in the plane (m).
    pub(in crate::dynamics) fn move_rings(&mut self, motion: &Rings) {
        for (i, by) in motion.iter().enumerate() {
            self.rings[i / 2].position[i % 2] += by;
        }
    }

    /// Moves both rings further (m, rad).
    pub(in crate::dynamics) fn move_in_space(&mut self, motion: &[f64; RINGS]) {
        for (i, by) in motion.iter().enumerate() {
            self.rings[i / COORDINATES].position[i % COORDINATES] += by;
        }
    }
}

impl ForceChange {
    /// Room for `count` elements.
    pub fn new(count: usize) -> Self {
        let [inner, outer, path_rate, radial_acceleration] = [(); 4].map(|()| vec![0.0; count]);
        Self { inner, outer, path_rate, radial_acceleration, ..Self::default() }
    }

    /// The same, with room for what `count` balls of rings in space do along the axis, and for their contact angles.
    pub fn in_space(count: usize) -> Self {
        let [axial_rate, axial_acceleration] = [(); 2].map(|()| vec![0.0; count]);
        let contact_angles = [(); 2].map(|()| vec![0.0; count]);
        Self { axial_rate, axial_acceleration, contact_angles, ..Self::new(count) }
    }
}

/// A number and its change.
pub(in crate::dynamics) type Changing = Dual<f64, 1>;

/// How an element, or the cage itself, goes round with the nominal cage, to first order.
pub(crate) struct Going {
    /// Change of its angle (rad).
    pub(crate) turn: f64,
    /// Change of its speed (rad/s).
    pub(crate) speed: f64,
    /// Change of its acceleration (rad/s²).
    pub(super) alpha: f64,
}

impl Going {
    /// Change of the angle alone (rad).
    pub(crate) fn turned(lead: Lead, by: &Variation) -> f64 {
        (1.0 + lead.rate) * by.cage_angle
    }

    /// Of an element that is so far ahead as the nominal cage's angle and speed change.
    pub(crate) fn of(lead: Lead, cage: &CageState, by: &Variation) -> Self {
        let Lead { rate, second, third, .. } = lead;
        let (omega, share) = (cage.speed, 1.0 + rate);
        Self {
            turn: Self::turned(lead, by),
            speed: share * by.cage_speed + second * omega * by.cage_angle,
            alpha: (cage.acceleration * second + omega * omega * third) * by.cage_angle
                + 2.0 * omega * second * by.cage_speed,
        }
    }
}

/// A number that changes by `by`.
pub(super) fn changing(value: f64, by: f64) -> Changing {
    Changing { value, by: [by] }
}
