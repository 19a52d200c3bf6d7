//! Forces on the rings by the rings' positions, each element staying in its radial balance.
//!
//! Element j is in balance where R_j = f·e_r − F_r + m (g·e_r + ρ ω²) = 0. What the rings do moves it by
//! du_j = −dR_j/(∂R_j/∂u_j), so that the forces on the rings depend on the rings alone: the arrow of all positions, its
//! elements eliminated. At rest that is the elastic tangent stiffness of the bearing.
//!
//! An element that nothing touches does not answer.

use crate::dynamics::contacts::{ContactForces, ElementMotion, Linearized, Shortcuts};
use crate::dynamics::parameters::{COORDINATES, Cells, FramedKinematics, Model, PathMotion};
use crate::numerics::number::{Dual, Scalar};
use crate::numerics::plane::Vector;
use crate::scene::Motion;
use std::ops::{Add, Mul};

/// ∂(force on inner ring, force on outer ring)/∂(position of inner ring, position of outer ring) (N/m).
pub type RingJacobian<T = f64> = nalgebra::Matrix4<T>;
/// x and y of the inner ring, then of the outer.
pub type Rings<T = f64> = nalgebra::Vector4<T>;

/// Change of one element's path (m) and of the forces on the rings (N), its balance kept.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Balanced<T: Scalar> {
    pub(in crate::dynamics) path: T,
    pub(in crate::dynamics) rings: Rings<T>,
}

/// Radial force R on an element, inertia of the turning cage and gravity included.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct RadialForce<T = f64> {
    /// R (N).
    pub(in crate::dynamics) force: T,
    /// Its derivative by u (N/m).
    pub(in crate::dynamics) slope: T,
}

impl Model {
    /// R (N) on an element that its contacts push so, 0 in balance.
    #[inline(always)]
    pub(in crate::dynamics) fn radial_balance<T: Scalar + Add<E, Output = T>, E: Scalar>(
        &self,
        at: &ElementMotion<T, E>,
        forces: &ContactForces<T>,
    ) -> T {
        let radius = self.centrifugal_radius(at.element, self.distance(at));
        let body = radius * (at.omega * at.omega) + self.gravity.map(E::from).dot(&at.e_r);
        forces.radial() + body * T::Plain::from(self.mass_of(at.element))
    }

    /// The same and how it changes with the path.
    #[inline(always)]
    pub(in crate::dynamics) fn radial_force<T: Scalar>(&self, element: &Linearized<T>) -> RadialForce<T> {
        let at = element.at.by_path::<1>();
        let Dual { value: force, by: [slope] } = self.radial_balance(&at, &element.chained(&at));
        RadialForce { force, slope }
    }

    /// Radius (m) at which element `j` at distance `rho` (m) feels its centrifugal force.
    ///
    /// In balance at every instant an element feels that on the smooth outer raceway, different by 1e-3 of itself, over
    /// a spall 100 µm deep by 6e-3. A force that grows outwards would leave it two balances in its clearance where it
    /// about cancels its weight.
    #[inline(always)]
    pub(in crate::dynamics) fn centrifugal_radius<T: Scalar>(&self, j: usize, rho: T) -> T {
        if self.elements_in_balance() { T::from(self.centre_radius(j)) } else { rho }
    }

    /// What each direction of `at`, the first of which is the path's own, does to an element that keeps its balance,
    /// and through it to the rings.
    #[inline(always)]
    pub(in crate::dynamics) fn balanced<T: Scalar, E: Scalar, const K: usize>(
        &self,
        element: &Linearized<T>,
        at: &ElementMotion<Dual<T, K>, E>,
    ) -> [Balanced<T>; K]
    where
        Dual<T, K>: Mul<E, Output = Dual<T, K>> + Add<E, Output = Dual<T, K>>,
    {
        let forces = element.chained(at);
        let [shaft, housing] = forces.on_rings(at);
        let (push, rings) = (self.radial_balance(at, &forces).by, stacked(shaft, housing));
        std::array::from_fn(|k| {
            let path = if push[0].value() == 0.0 { T::from(0.0) } else { -push[k] / push[0] };
            Balanced { path, rings: rings.map(|force| force.by[k] + force.by[0] * path) }
        })
    }

    /// Adds an element in balance to the Jacobian of the rings' forces.
    pub(in crate::dynamics) fn add_balanced<T: Scalar>(&self, element: &Linearized<T>, jacobian: &mut RingJacobian<T>) {
        let mut at = element.at.by_path::<3>();
        at.offset = Vector::from_fn(|axis, _| Dual::variable(element.at.offset[axis], 1 + axis));
        for (axis, of) in self.balanced(element, &at)[1..].iter().enumerate() {
            add_by_offset(jacobian, axis, &of.rings);
        }
    }

    /// Elastic Jacobian of the rings' forces at the element paths `u`, everything standing where it is in `now`.
    pub fn ring_jacobian(
        &self,
        u: &[f64],
        cells: &Cells,
        now: &FramedKinematics,
        shortcuts: &mut Shortcuts,
    ) -> RingJacobian {
        self.ring_jacobian_at(u, cells, &now.standing(), true, shortcuts)
    }

    /// The same with the dampers' part at the velocities of `now`, each u' being 0; for searches without curvatures
    /// along defects, not `curved`.
    pub(in crate::dynamics) fn ring_jacobian_at(
        &self,
        u: &[f64],
        cells: &Cells,
        now: &FramedKinematics,
        curved: bool,
        shortcuts: &mut Shortcuts,
    ) -> RingJacobian {
        let mut jacobian = RingJacobian::zeros();
        for (j, &u) in u.iter().enumerate().take(self.element_count) {
            let at = self.element_motion(j, PathMotion::at_rest(u), now, shortcuts);
            let element = self.linearized(self.cells_of(cells, j), &ElementMotion { curved, ..at }, shortcuts);
            self.add_balanced(&element, &mut jacobian);
        }
        jacobian
    }

    /// An element that stands where it is, all else being as in `now`.
    pub(in crate::dynamics) fn at_rest(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        u: f64,
        now: &FramedKinematics,
        shortcuts: &mut Shortcuts,
    ) -> Linearized {
        self.linearized(cells, &self.element_motion(j, PathMotion::at_rest(u), now, shortcuts), shortcuts)
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

/// Adds a change of the rings' forces by how far they are apart along one axis.
pub(in crate::dynamics) fn add_by_offset<T: Scalar>(jacobian: &mut RingJacobian<T>, axis: usize, rings: &Rings<T>) {
    jacobian.column_mut(axis).zip_apply(rings, |sum, force| *sum -= force);
    jacobian.column_mut(2 + axis).zip_apply(rings, |sum, force| *sum += force);
}

/// What of both rings' coordinates is in the plane, as one.
pub(crate) fn in_plane(rings: &[[f64; COORDINATES]; 2]) -> Rings {
    Rings::from_fn(|i, _| rings[i / 2][i % 2])
}

/// Vectors of the inner and the outer ring as one.
pub(crate) fn stacked<T: Scalar>(shaft: Vector<T>, housing: Vector<T>) -> Rings<T> {
    Rings::new(shaft.x, shaft.y, housing.x, housing.y)
}
