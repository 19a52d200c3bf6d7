//! Forces on the rings by the rings' positions, each element staying in its radial balance.
//!
//! Element j is in balance where R_j = f·e_r − F_r + m (g·e_r + ρ ω²) = 0. What the rings do moves it by
//! du_j = −dR_j/(∂R_j/∂u_j), so that the forces on the rings depend on the rings alone: the arrow of all positions, its
//! elements eliminated. At rest that is the elastic tangent stiffness of the bearing.
//!
//! An element that nothing touches does not answer.

use crate::dynamics::contacts::{Bends, ElementVariation, Linearized};
use crate::dynamics::parameters::SMOOTH;
use crate::dynamics::parameters::{Cells, FramedKinematics, Model, PathMotion};
use crate::numerics::plane::Vector;
use crate::scene::Motion;

/// ∂(force on inner ring, force on outer ring)/∂(position of inner ring, position of outer ring) (N/m).
pub type RingJacobian = nalgebra::Matrix4<f64>;
/// x and y of the inner ring, then of the outer.
pub type Rings = nalgebra::Vector4<f64>;

/// Change of one element's path (m) and of the forces on the rings (N), its balance kept.
pub(in crate::dynamics) struct Balanced {
    pub(in crate::dynamics) path: f64,
    pub(in crate::dynamics) rings: Rings,
}

/// Radial force R on an element, inertia of the turning cage and gravity included.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct RadialForce {
    /// R (N).
    pub(in crate::dynamics) force: f64,
    /// Its derivative by u (N/m).
    pub(in crate::dynamics) slope: f64,
}

impl Model {
    /// Radial force on an element, 0 in balance.
    #[inline]
    pub(in crate::dynamics) fn radial_balance(&self, element: &Linearized) -> RadialForce {
        let Linearized { e_r, rho, omega, .. } = *element;
        let (radius, grows) = self.centrifugal_radius(rho);
        let body = self.gravity.dot(&e_r) + radius * omega * omega;
        let contacts = element.inner.dot(&e_r) - element.outer.x;
        let along = element.change(&ElementVariation::of_path()).radial(element);
        RadialForce {
            force: contacts + self.element_mass * body,
            slope: along + self.element_mass * omega * omega * grows,
        }
    }

    /// Radius (m) at which an element at distance `rho` (m) feels its centrifugal force, and its derivative by the
    /// path.
    ///
    /// In balance at every instant an element feels that on the smooth outer raceway, different by 1e-3 of itself, over
    /// a spall 100 µm deep by 6e-3. A force that grows outwards would leave it two balances in its clearance where it
    /// about cancels its weight.
    #[inline(always)]
    pub(in crate::dynamics) fn centrifugal_radius(&self, rho: f64) -> (f64, f64) {
        if self.elements_in_balance() { (self.outer_centre_radius, 0.0) } else { (rho, 1.0) }
    }

    /// What a change does to an element that keeps its balance, and through it to the rings.
    pub(in crate::dynamics) fn balanced(&self, element: &Linearized, by: &ElementVariation) -> Balanced {
        let Linearized { rho, omega, .. } = *element;
        let along = element.change(&ElementVariation::of_path());
        let direct = element.change(by);
        let (radius, grows) = self.centrifugal_radius(rho);
        let stiffness = along.radial(element) + self.element_mass * omega * omega * grows;
        let push = direct.radial(element) + 2.0 * self.element_mass * radius * omega * by.cage_speed;
        let path = if stiffness == 0.0 { 0.0 } else { -push / stiffness };
        let (on_shaft, on_housing) =
            (-(direct.inner + along.inner * path), direct.on_housing(element) + along.on_housing(element) * path);
        let rings = stacked(on_shaft, on_housing);
        Balanced { path, rings }
    }

    /// Adds an element in balance to the Jacobian of the rings' forces.
    pub(in crate::dynamics) fn add_balanced(&self, element: &Linearized, jacobian: &mut RingJacobian) {
        for axis in 0..2 {
            let rings = self.balanced(element, &ElementVariation::of_offset(axis)).rings;
            jacobian.column_mut(axis).zip_apply(&rings, |sum, force| *sum -= force);
            jacobian.column_mut(2 + axis).zip_apply(&rings, |sum, force| *sum += force);
        }
    }

    /// Elastic Jacobian of the rings' forces at the element paths `u`, everything standing where it is in `now`.
    pub fn ring_jacobian(&self, u: &[f64], cells: &Cells, now: &FramedKinematics) -> RingJacobian {
        let (still, mut jacobian) = (now.standing(), RingJacobian::zeros());
        for (j, &u) in u.iter().enumerate().take(self.element_count) {
            self.add_balanced(&self.at_rest(j, self.cells_of(cells, j), u, &still), &mut jacobian);
        }
        jacobian
    }

    /// An element that stands `still`, as all else does, with the exact derivatives of its forces by positions: what a
    /// ring's motion turns at a defect inside is the force as well.
    pub(in crate::dynamics) fn at_rest(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        u: f64,
        still: &FramedKinematics,
    ) -> Linearized {
        let bends = if cells[0] == [SMOOTH; 2] { Bends::LeftOut } else { Bends::Wanted };
        self.linearized_at(j, cells, PathMotion::at_rest(u), still, bends)
    }

    /// As [`ring_jacobian`](Self::ring_jacobian) with the dampers' part at the velocities of `now`, each u' being 0,
    /// and without second derivatives near defects: for searches.
    pub(in crate::dynamics) fn ring_jacobian_at(
        &self,
        u: &[f64],
        cells: &Cells,
        now: &FramedKinematics,
    ) -> RingJacobian {
        let mut jacobian = RingJacobian::zeros();
        for j in 0..self.element_count {
            let along = PathMotion::at_rest(u[j]);
            let element = self.linearized_at(j, self.cells_of(cells, j), along, now, Bends::LeftOut);
            self.add_balanced(&element, &mut jacobian);
        }
        jacobian
    }

    /// The matrix of the free rings' balance, −J + supports + `shift`; rows and columns of the others are those of the
    /// unit matrix.
    pub(in crate::dynamics) fn free_rings_matrix(&self, jacobian: &RingJacobian, shift: f64) -> RingJacobian {
        let (free, springs) = (self.free(), self.supports.ring_stiffnesses());
        RingJacobian::from_fn(|i, k| match (free[i] && free[k], i == k) {
            (true, true) => springs[i] + shift - jacobian[(i, i)],
            (true, false) => -jacobian[(i, k)],
            (false, on_diagonal) => f64::from(u8::from(on_diagonal)),
        })
    }

    /// Adds `stiffness` between the two rings, where both are free, beside the diagonal of
    /// [`free_rings_matrix`](Self::free_rings_matrix).
    pub(in crate::dynamics) fn couple(&self, matrix: &mut RingJacobian, stiffness: f64) {
        let free = self.free();
        for axis in (0..2).filter(|&axis| free[axis] && free[axis + 2]) {
            matrix[(axis, axis + 2)] += stiffness;
            matrix[(axis + 2, axis)] += stiffness;
        }
    }

    /// `forces` with those on rings that are not free left out.
    pub(in crate::dynamics) fn free_rings(&self, forces: Rings) -> Rings {
        let free = self.free();
        Rings::from_fn(|i, _| if free[i] { forces[i] } else { 0.0 })
    }

    /// Where the free rings go until the bearing balances a change of `force` (N) on them (m). `None` if they have no
    /// stiffness against it.
    pub(in crate::dynamics) fn balancing_motion(&self, jacobian: &RingJacobian, force: Rings) -> Option<Rings> {
        let motion = self.free_rings_matrix(jacobian, 0.0).lu().solve(&self.free_rings(force))?;
        motion.iter().all(|value| value.is_finite()).then_some(motion)
    }

    /// Which of the rings' coordinates forces move.
    fn free(&self) -> [bool; 4] {
        let [shaft, housing] = [&self.shaft, &self.housing].map(|ring| ring.motion == Motion::Internal);
        [shaft, shaft, housing, housing]
    }
}

/// Vectors of the inner and the outer ring as one.
pub(crate) fn stacked(shaft: Vector, housing: Vector) -> Rings {
    Rings::new(shaft.x, shaft.y, housing.x, housing.y)
}
