//! Exact Jacobian of the right-hand side, damping included; and (s − J) x = b. Of elements in balance at every instant
//! the change of damping is left out.
//!
//! All derivatives are those of the equations of motion over dual numbers: in the plane ([`plane`]), in
//! space ([`space`]). They are those of the branch that the state is in; at the onset of a contact there
//! are two.

mod plane;
mod smooth_balls;
mod space;

use super::arrow::ArrowJacobian;
use super::elimination::Elimination;
use super::fastest::{BodyIndices, Fastest};
use super::small_change::Variation;
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::parameters::{
    BODIES, COORDINATES, Cells, Excitation, FEW_BODIES, FEW_SPATIAL_BODIES, Layout, Model, PLANE_RINGS, RINGS,
    SPATIAL_BODIES,
};
use crate::numerics::lanes::row::Row;

/// The Jacobian of a model.
#[derive(Debug, Clone)]
pub struct Jacobian {
    /// Derivative of the right-hand side by time at constant state, once [it](Model::derivative_by_time) is asked for.
    pub by_time: Row,
    shape: Shape,
    /// What time changes.
    pub(super) time: Variation,
}

/// Places of an element, coordinates of the rings, and of all bodies.
#[derive(Debug, Clone)]
enum Shape {
    Plane(Box<Solvable<1, PLANE_RINGS, FEW_BODIES>>),
    PlaneWithSensors(Box<Solvable<1, PLANE_RINGS, BODIES>>),
    Space(Box<Solvable<2, RINGS, FEW_SPATIAL_BODIES>>),
    SpaceWithSensors(Box<Solvable<2, RINGS, SPATIAL_BODIES>>),
}

#[derive(Debug, Clone)]
struct Solvable<const N: usize, const R: usize, const B: usize>
where
    nalgebra::Const<B>: nalgebra::DimMin<nalgebra::Const<B>, Output = nalgebra::Const<B>>,
{
    jacobian: ArrowJacobian<N, R, B>,
    eliminated: Elimination<N, R, B>,
}

/// The same of any shape.
macro_rules! any {
    ($shape:expr, $of:ident => $what:expr) => {
        match $shape {
            Shape::Plane($of) => $what,
            Shape::PlaneWithSensors($of) => $what,
            Shape::Space($of) => $what,
            Shape::SpaceWithSensors($of) => $what,
        }
    };
}

impl<const N: usize, const R: usize, const B: usize> Solvable<N, R, B>
where
    nalgebra::Const<B>: nalgebra::DimMin<nalgebra::Const<B>, Output = nalgebra::Const<B>>,
{
    fn new(count: usize, bodies: [Option<BodyIndices>; B], starts: [[usize; N]; 2]) -> Box<Self> {
        let jacobian = ArrowJacobian::new(count, bodies, starts);
        Box::new(Self { jacobian, eliminated: Elimination::new(count) })
    }
}

impl Jacobian {
    /// Room for a model's Jacobian.
    pub fn new(model: &Model) -> Self {
        let layout = &model.layout;
        let count = if model.elements_in_balance() { 0 } else { model.element_count };
        let many = model.supports.size() == BODIES;
        let w = layout.radial_velocity;
        let shape = match layout.axial() {
            None if many => Shape::PlaneWithSensors(Solvable::new(count, bodies(model), [[0], [w]])),
            None => Shape::Plane(Solvable::new(count, bodies(model), [[0], [w]])),
            Some([v, w_z]) if many => Shape::SpaceWithSensors(Solvable::new(count, bodies(model), [[0, v], [w, w_z]])),
            Some([v, w_z]) => Shape::Space(Solvable::new(count, bodies(model), [[0, v], [w, w_z]])),
        };
        let time = match &model.space {
            None => Variation::new(model.element_count),
            Some(_) => Variation::in_space(model.element_count),
        };
        Self { by_time: Row::zeros(layout.len), shape, time }
    }

    /// The fastest of the elements and bodies, each taken alone while all else stands still: an element along and
    /// across what its stiffness and its damping are largest along.
    ///
    /// Neighbours that move too make the eigenvalue larger: without damping by √3 at most; with damping, among many
    /// assemblies, by less than 2 where rings are heavier than an element and by less than 3 where they are not.
    /// `tests/motion/fastest_eigenvalue.rs` compares it with all eigenvalues.
    pub fn fastest(&self) -> Fastest {
        any!(&self.shape, of => of.jacobian.fastest())
    }

    /// The whole matrix ∂(state')/∂(state), rows by columns, of a state of `len` slots; for studies.
    pub fn matrix(&self, len: usize) -> Vec<Vec<f64>> {
        any!(&self.shape, of => of.jacobian.matrix(len))
    }

    /// Eliminates `shift` − J, `shift` > 0.
    pub fn factor(&mut self, shift: f64) {
        any!(&mut self.shape, of => of.eliminated.factor(&of.jacobian, shift));
    }

    /// Puts x of (s − J) x = b into `b`, s the shift that was eliminated last.
    pub fn solve(&self, b: &mut [f64]) {
        any!(&self.shape, of => of.eliminated.solve(&of.jacobian, b));
    }
}

impl Model {
    /// The Jacobian at `tau`.
    pub fn linearize(
        &self,
        excitation: &Excitation,
        tau: f64,
        cells: &Cells,
        state: &[f64],
        Jacobian { shape, .. }: &mut Jacobian,
        shortcuts: &mut Shortcuts,
    ) {
        let when = (excitation, tau);
        match (shape, &self.space) {
            (Shape::Plane(of), _) => self.linearize_in_plane(when, cells, state, &mut of.jacobian, shortcuts),
            (Shape::PlaneWithSensors(of), _) => {
                self.linearize_in_plane(when, cells, state, &mut of.jacobian, shortcuts)
            }
            (Shape::Space(of), Some(space)) => {
                self.linearize_in_space(space, when, cells, state, &mut of.jacobian, shortcuts)
            }
            (Shape::SpaceWithSensors(of), Some(space)) => {
                self.linearize_in_space(space, when, cells, state, &mut of.jacobian, shortcuts)
            }
            (Shape::Space(_) | Shape::SpaceWithSensors(_), None) => {}
        }
    }
}

/// Where each coordinate of a model's bodies is in its state.
pub(super) fn bodies<const B: usize>(model: &Model) -> [Option<BodyIndices>; B] {
    let layout = &model.layout;
    let free = |i: usize| model.space.as_ref().is_none_or(|space| space.free[i]);
    let per_ring = if model.space.is_some() { COORDINATES } else { PLANE_RINGS / 2 };
    let mut indices = [None; B];
    for (ring, start) in [layout.shaft, layout.housing].into_iter().enumerate() {
        for k in 0..per_ring {
            let at =
                |start| BodyIndices { position: start + Layout::POSITIONS[k], velocity: start + Layout::VELOCITIES[k] };
            indices[per_ring * ring + k] = start.filter(|_| free(per_ring * ring + k)).map(at);
        }
    }
    for (body, i) in indices.iter_mut().skip(2 * per_ring).zip(layout.sensor_indices()) {
        *body = Some(BodyIndices { position: i, velocity: i + 1 });
    }
    indices
}

#[cfg(test)]
pub(crate) mod tests;
