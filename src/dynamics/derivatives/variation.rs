//! First-order change of forces and accelerations for a small change of state and inputs.
//!
//! All that an element meets is a dual number along the change, and what contacts, balance and tangent stiffness make
//! of it comes out with its derivative: there is no text of their derivatives. An element's path changes at
//! u' = w − e_r·v_o; one in balance has its path where the balance is.
//!
//! With it the derivative of any output follows: by an input at fixed state, by an input through the static
//! equilibrium, and by time along the motion. Derivatives are those of the branch that each contact is in; at the
//! onset of a contact there are two.

use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::contacts::{BodyTorque, ElementForces, ElementMotion};
use crate::dynamics::parameters::{
    CageState, Cells, Excitation, Frame, FramedKinematics, Frames, Lead, Model, PathMotion, RingInSpace, RingState, Turn,
};
use crate::dynamics::quasi_static::{RingJacobian, Rings, stacked};
use crate::numerics::number::Dual;
use crate::numerics::plane::{Matrix, Vector};

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
    /// Of the inner ring.
    pub shaft: RingState,
    /// Of the outer ring.
    pub housing: RingState,
    /// Of the inner and the outer ring beyond the plane: z, and tilt about x and about y; x and y are as above.
    pub beyond: [RingInSpace; 2],
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
    /// Of the force on the inner ring (N).
    pub shaft: Vector,
    /// Of the force on the outer ring (N).
    pub housing: Vector,
    /// Of the force along z (N) and the moments about x and y (N m) on the inner and the outer ring.
    pub beyond: [[f64; 3]; 2],
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
        (self.shaft, self.housing) = (RingState::default(), RingState::default());
        self.beyond = Default::default();
        self.axial.fill(0.0);
        self.axial_velocity.fill(0.0);
        self.path.fill(0.0);
        self.radial_velocity.fill(0.0);
    }

    /// Of the outer ring's position less that of the inner (m).
    pub(in crate::dynamics) fn offset(&self) -> Vector {
        self.housing.position - self.shaft.position
    }

    /// Moves both rings further (m).
    pub(in crate::dynamics) fn move_rings(&mut self, motion: &Rings) {
        self.shaft.position += Vector::new(motion[0], motion[1]);
        self.housing.position += Vector::new(motion[2], motion[3]);
    }

    /// Of the outer ring's velocity less that of the inner (m/s).
    pub(in crate::dynamics) fn drift(&self) -> Vector {
        self.housing.velocity - self.shaft.velocity
    }
}

impl ForceChange {
    /// Room for `count` elements.
    pub fn new(count: usize) -> Self {
        Self { inner: vec![0.0; count], outer: vec![0.0; count], ..Self::default() }
    }

    /// The same, with room for the contact angles of `count` balls of rings in space.
    pub fn in_space(count: usize) -> Self {
        Self { contact_angles: [(); 2].map(|()| vec![0.0; count]), ..Self::new(count) }
    }
}

/// A number and its change.
pub(in crate::dynamics) type Changing = Dual<f64, 1>;

/// How an element goes round with the cage, to first order.
pub(in crate::dynamics) struct Going {
    /// Change of its angle (rad).
    pub(super) turn: f64,
    /// Change of its speed (rad/s).
    pub(in crate::dynamics) speed: f64,
    /// Change of its acceleration (rad/s²).
    pub(super) alpha: f64,
}

impl Going {
    /// Of an element that is so far ahead as the nominal cage's angle and speed change.
    pub(in crate::dynamics) fn of(Lead { rate, second, third, .. }: Lead, cage: &CageState, by: &Variation) -> Self {
        let (omega, share) = (cage.speed, 1.0 + rate);
        Self {
            turn: share * by.cage_angle,
            speed: share * by.cage_speed + second * omega * by.cage_angle,
            alpha: (cage.acceleration * second + omega * omega * third) * by.cage_angle
                + 2.0 * omega * second * by.cage_speed,
        }
    }
}

impl Model {
    /// What element `j`, at path and absolute radial velocity of the state, meets as all that changes.
    fn changing_motion(
        &self,
        j: usize,
        state: &[f64],
        now: &FramedKinematics,
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> ElementMotion<Changing> {
        let w = state[self.layout.radial_velocity + j];
        let at = self.element_motion(j, PathMotion { path: state[j], rate: 0.0 }, now, shortcuts);
        let lead = self.lead_with(j, now.cage_angle(), &mut shortcuts.leads);
        let Going { turn, speed, alpha } = Going::of(lead, &now.cage, by);
        let frames = [0, 1, 2].map(|i| {
            let (Turn { angle, speed }, [d_angle, d_speed]) = (at.frames.0[i], by.frames[i]);
            Turn { angle: changing(angle, d_angle), speed: changing(speed, d_speed) }
        });
        let e_r = changing_vector(at.e_r, at.e_t * turn);
        let housing = changing_vector(now.housing.velocity, by.housing.velocity);
        ElementMotion {
            element: j,
            e_r,
            e_t: changing_vector(at.e_t, at.e_r * -turn),
            angle: changing(at.angle, turn),
            omega: changing(at.omega, speed),
            alpha: changing(at.alpha, alpha),
            path: changing(at.path, by.path[j]),
            path_rate: changing(w, by.radial_velocity[j]) - housing.dot(&e_r),
            offset: changing_vector(at.offset, by.offset()),
            drift: changing_vector(at.drift, by.drift()),
            frames: Frames(frames),
            films: at.films,
            film_speed: changing(at.film_speed, by.film_speed),
            curved: true,
        }
    }

    /// Change of the contact forces under `excitation` at τ = 0 for a small change `by`. `acceleration` is the outer
    /// ring's. Of elements in balance it puts the change of their paths into `by`.
    pub fn vary(
        &self,
        excitation: &Excitation,
        cells: &Cells,
        state: &[f64],
        acceleration: Vector,
        (by, change): (&mut Variation, &mut ForceChange),
        shortcuts: &mut Shortcuts,
    ) {
        if let Some(space) = &self.space {
            return self.vary_in_space(space, excitation, (cells, state), acceleration, (by, change), shortcuts);
        }
        let now = self.kinematics(excitation, 0.0, state);
        let mut rings = Rings::zeros();
        (change.cage_torque, change.shaft_torque, change.torque_by_acceleration) = (0.0, 0.0, Vector::zeros());
        for j in 0..self.element_count {
            let forces = self.changing_forces(j, cells, state, &now, by, shortcuts);
            rings += on_rings(&forces);
            (change.inner[j], change.outer[j]) = (magnitude(&forces.inner), magnitude(&forces.outer));
            let around = forces.inner.y + forces.outer.y;
            let ElementMotion { e_t, omega, alpha, path, path_rate, .. } = forces.at;
            let torque = self.torque_on_cage(e_t, [omega, alpha], [path, path_rate], around, acceleration);
            change.cage_torque += torque.by[0];
            change.torque_by_acceleration -=
                forces.at.e_t.map(|part| part.value * forces.rho.value * self.element_mass);
            for BodyTorque { frame, torque } in forces.torques() {
                match frame {
                    Frame::Shaft => change.shaft_torque += torque.by[0],
                    Frame::Spin => change.cage_torque += torque.by[0],
                    Frame::Housing => {}
                }
            }
            if self.elements_in_balance() {
                let housing = changing_vector(now.housing.velocity, by.housing.velocity);
                let w = forces.at.path_rate + housing.dot(&forces.at.e_r);
                (by.path[j], by.radial_velocity[j]) = (forces.at.path.by[0], w.by[0]);
            }
        }
        (change.shaft, change.housing) = (Vector::new(rings[0], rings[1]), Vector::new(rings[2], rings[3]));
    }

    /// Forces on element `j`, in motion or in balance, as all that it meets changes.
    fn changing_forces(
        &self,
        j: usize,
        cells: &Cells,
        state: &[f64],
        now: &FramedKinematics,
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> ElementForces<Changing> {
        let (cells, at) = (self.cells_of(cells, j), self.changing_motion(j, state, now, by, shortcuts));
        if self.elements_in_balance() {
            self.in_balance(cells, state[j], &at, shortcuts).forces()
        } else {
            self.element_forces(cells, &at, shortcuts)
        }
    }

    /// Change of the forces on the rings (N), of elements in balance with their paths where these ask for it.
    pub(in crate::dynamics) fn vary_rings(
        &self,
        cells: &Cells,
        state: &[f64],
        now: &FramedKinematics,
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> Rings {
        let elements = 0..self.element_count;
        elements.map(|j| on_rings(&self.changing_forces(j, cells, state, now, by, shortcuts))).sum()
    }

    /// Change of the inner ring's elastic force by its own position, [`Model::ring_jacobian`]'s first block (N/m), for
    /// a small change at the instant τ = 0 of `excitation`.
    pub fn vary_stiffness(
        &self,
        excitation: &Excitation,
        cells: &Cells,
        state: &[f64],
        by: &Variation,
        shortcuts: &mut Shortcuts,
    ) -> Matrix {
        let now = self.kinematics(excitation, 0.0, state);
        let mut jacobian = RingJacobian::<Changing>::zeros();
        for j in 0..self.element_count {
            let at = self.changing_motion(j, state, &now, by, shortcuts).standing();
            self.add_balanced(&self.linearized_at(self.cells_of(cells, j), &at, shortcuts), &mut jacobian);
        }
        Matrix::from_fn(|row, column| jacobian[(row, column)].by[0])
    }
}

pub(super) fn changing(value: f64, by: f64) -> Changing {
    Changing { value, by: [by] }
}

fn changing_vector(value: Vector, by: Vector) -> Vector<Changing> {
    value.zip_map(&by, changing)
}

/// Change of the forces on the rings (N).
fn on_rings(forces: &ElementForces<Changing>) -> Rings {
    let [shaft, housing] = forces.on_rings();
    stacked(shaft, housing).map(|force| force.by[0])
}

/// Change of a force's magnitude (N).
fn magnitude(force: &Vector<Changing>) -> f64 {
    use crate::numerics::number::Number;
    force.dot(force).sqrt().by[0]
}
