//! Analytic Jacobian of the right-hand side, damping included, and its derivative by time.
//!
//! An element couples to the rings and to no other element, so the matrix is an arrow: one 2×2 block per element, its
//! coupling to the rings, and the rings' own block. The contacts' derivatives are those of `linearized`, with f, G and
//! D as there; because u' = w − e_r·v_o,
//! ```text
//! ∂f/∂u = G e_r + D e_t ω    ∂f/∂w = D e_r    ∂f/∂x_o = −∂f/∂x_i = G    ∂f/∂v_i = −D    ∂f/∂v_o = D e_t e_tᵀ
//! ```
//! The outer contact's force depends on u and u' alone, and on time through the cage angle.
//!
//! By time, at constant state: ė_r = ω e_t, ė_t = −ω e_r, ω' the cage's acceleration, and prescribed rings and loads as
//! the excitation says.
//!
//! The derivatives are those of the branch that the state is in; at the onset of a contact there are two.

use super::fastest::{BodyIndices, Fastest};
use super::spatial_jacobian::SpatialJacobian;
use crate::dynamics::contacts::{ElementMotion, ElementVariation, Linearized, Shortcuts};
use crate::dynamics::parameters::{
    BODIES, Bodies, BodyMatrix, Cells, Excitation, FramedKinematics, Kinematics, Layout, Model, PathMotion, RingState,
    prescribed_rate,
};
use crate::dynamics::quasi_static::{RingJacobian, Rings, stacked};
use crate::numerics::lanes::row::Row;
use crate::numerics::plane::Vector;
use crate::scene::{MOST_SENSORS, Motion};

/// Rows and columns of one element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElementBlock {
    /// Radial direction; ∂u'/∂v_o is its negative, ∂u'/∂w is 1.
    pub e_r: Vector,
    /// ∂w'/∂u (1/s²)
    pub by_path: f64,
    /// ∂w'/∂w (1/s)
    pub by_velocity: f64,
    /// ∂w'/∂x_o = −∂w'/∂x_i (1/s²)
    pub by_offset: Vector,
    /// ∂w'/∂v_i (1/s)
    pub by_shaft_velocity: Vector,
    /// ∂w'/∂v_o (1/s)
    pub by_housing_velocity: Vector,
    /// ∂(v_i', v_o')/∂u (1/s²)
    pub rings_by_path: Rings,
    /// ∂(v_i', v_o')/∂w (1/s)
    pub rings_by_velocity: Rings,
}

/// The Jacobian in its blocks.
#[derive(Debug, Clone)]
pub struct Jacobian {
    /// The elements' blocks.
    pub elements: Vec<ElementBlock>,
    /// Accelerations of the bodies by their positions (1/s²).
    pub by_position: BodyMatrix,
    /// Accelerations of the bodies by their velocities (1/s).
    pub by_velocity: BodyMatrix,
    /// Derivative of the right-hand side by time at constant state.
    pub by_time: Row,
    /// Where each body is in the state; `None` for a body without state, whose rows and columns count for nothing.
    pub body_indices: [Option<BodyIndices>; BODIES],
    /// Where the elements' velocities begin in the state.
    pub radial_velocity: usize,
    /// That of rings in space, in place of all but the derivative by time.
    pub space: Option<Box<SpatialJacobian>>,
}

impl Jacobian {
    /// Room for a model's Jacobian.
    pub fn new(model: &Model) -> Self {
        let size = model.supports.size();
        let elements = if model.elements_in_balance() || model.space.is_some() { 0 } else { model.element_count };
        Self {
            elements: vec![ElementBlock::default(); elements],
            by_position: BodyMatrix::zeros(size, size),
            by_velocity: BodyMatrix::zeros(size, size),
            by_time: Row::zeros(model.layout.len),
            body_indices: body_indices(&model.layout),
            radial_velocity: model.layout.radial_velocity,
            space: model.space.as_ref().map(|space| Box::new(SpatialJacobian::new(model, space))),
        }
    }

    /// One element alone that is damped with `rate` (1/s).
    #[cfg(test)]
    pub fn with_fastest(rate: f64) -> Self {
        Self {
            elements: vec![ElementBlock { by_velocity: -rate, ..ElementBlock::default() }],
            by_position: BodyMatrix::zeros(0, 0),
            by_velocity: BodyMatrix::zeros(0, 0),
            by_time: Row::zeros(0),
            body_indices: [None; BODIES],
            radial_velocity: 1,
            space: None,
        }
    }

    /// The fastest of the elements and bodies, each taken alone while all else stands still.
    ///
    /// Neighbours that move too make the eigenvalue larger: without damping by √3 at most; with damping, among many
    /// assemblies, by less than 2 where rings are heavier than an element and by less than 3 where they are not.
    /// `tests/motion/fastest_eigenvalue.rs` compares it with all eigenvalues.
    pub fn fastest(&self) -> Fastest {
        if let Some(space) = &self.space {
            return space.fastest();
        }
        let mut fastest = Fastest::default();
        for block in &self.elements {
            fastest.consider(block.by_path, block.by_velocity);
        }
        for i in (0..BODIES).filter(|&i| self.body_indices[i].is_some()) {
            fastest.consider(self.by_own_position(i), self.by_velocity[(i, i)]);
        }
        fastest
    }

    /// Acceleration of a body by its own position, all else standing still (1/s²). Paths are seen from the outer ring:
    /// when that moves and an element does not, the element's path changes.
    fn by_own_position(&self, body: usize) -> f64 {
        let alone = self.by_position[(body, body)];
        if !(2..4).contains(&body) {
            return alone;
        }
        self.elements.iter().fold(alone, |sum, block| sum - block.rings_by_path[body] * block.e_r[body - 2])
    }

    /// The whole matrix ∂(state')/∂(state), rows by columns, of a state of `len` slots; for studies.
    pub fn matrix(&self, len: usize) -> Vec<Vec<f64>> {
        if let Some(space) = &self.space {
            return space.matrix(len);
        }
        let start = self.radial_velocity;
        let mut matrix = vec![vec![0.0; len]; len];
        for (j, block) in self.elements.iter().enumerate() {
            let w = start + j;
            matrix[j][w] = 1.0;
            (matrix[w][j], matrix[w][w]) = (block.by_path, block.by_velocity);
            for a in 0..2 {
                if let Some(BodyIndices { position: x, velocity: v }) = self.body_indices[a] {
                    (matrix[w][x], matrix[w][v]) = (-block.by_offset[a], block.by_shaft_velocity[a]);
                    (matrix[v][j], matrix[v][w]) = (block.rings_by_path[a], block.rings_by_velocity[a]);
                }
                if let Some(BodyIndices { position: x, velocity: v }) = self.body_indices[2 + a] {
                    (matrix[w][x], matrix[w][v]) = (block.by_offset[a], block.by_housing_velocity[a]);
                    (matrix[v][j], matrix[v][w]) = (block.rings_by_path[2 + a], block.rings_by_velocity[2 + a]);
                    matrix[j][v] = -block.e_r[a];
                }
            }
        }
        let bodies = || self.body_indices.iter().enumerate().filter_map(|(i, body)| body.map(|body| (i, body)));
        for (i, BodyIndices { position: x, velocity: v }) in bodies() {
            matrix[x][v] = 1.0;
            for (k, by) in bodies() {
                (matrix[v][by.position], matrix[v][by.velocity]) = (self.by_position[(i, k)], self.by_velocity[(i, k)]);
            }
        }
        matrix
    }
}

impl Default for ElementBlock {
    fn default() -> Self {
        let (none, rings) = (Vector::zeros(), Rings::zeros());
        Self {
            e_r: none,
            by_path: 0.0,
            by_velocity: 0.0,
            by_offset: none,
            by_shaft_velocity: none,
            by_housing_velocity: none,
            rings_by_path: rings,
            rings_by_velocity: rings,
        }
    }
}

/// What all elements share while the Jacobian is put together.
struct Shared {
    now: FramedKinematics,
    /// Prescribed velocity and acceleration of each ring, the inner first; zero where the state has them.
    prescribed: [RingState; 2],
    /// 1/mass of the rings' coordinates (1/kg).
    inverse_masses: Rings,
    /// Speed and acceleration of the frames of defects.
    frames: [[f64; 2]; 3],
    /// Rate of the speed that oil films follow (rad/s²).
    film_rate: f64,
}

impl Model {
    /// The Jacobian at `tau`.
    pub fn linearize(
        &self,
        excitation: &Excitation,
        tau: f64,
        cells: &Cells,
        state: &[f64],
        jacobian: &mut Jacobian,
        shortcuts: &mut Shortcuts,
    ) {
        if let (Some(space), Jacobian { space: Some(of_space), by_time, .. }) = (&self.space, &mut *jacobian) {
            return self.linearize_in_space(space, (excitation, tau), cells, state, (of_space, by_time), shortcuts);
        }
        let start = self.layout.radial_velocity;
        let host = |motion: Motion, prescribed| {
            if motion == Motion::Host { prescribed_rate(prescribed, tau) } else { RingState::default() }
        };
        let shared = Shared {
            now: self.kinematics(excitation, tau, state),
            prescribed: [host(self.shaft.motion, &excitation.shaft), host(self.housing.motion, &excitation.housing)],
            inverse_masses: self.supports.inverse_masses().fixed_rows::<4>(0).into(),
            frames: excitation.frame_rates(tau),
            film_rate: excitation.relative_speed.rate_at(tau),
        };
        self.add_supports(excitation, tau, &shared, jacobian);
        if self.elements_in_balance() {
            return self.add_elements_in_balance(cells, state, &shared, jacobian, shortcuts);
        }
        for j in 0..self.element_count {
            let motion = [state[j], state[start + j]];
            let element = self.linearized(j, self.cells_of(cells, j), motion, &shared.now, shortcuts);
            self.add_element(j, &element, &shared, jacobian);
            self.add_element_by_time(j, &element, &shared, jacobian);
        }
    }

    /// What elements in balance at every instant make of the bodies' part: by positions their elastic
    /// tangent, exact; by velocities what dampers hand on. That damping
    /// changes as rings move, by χ δ̇ of the tangent, is left out, and so is what elements make of the derivative by
    /// time: it is for the stability of explicit steps, and at rest, for the modes, there is none of either.
    fn add_elements_in_balance(
        &self,
        cells: &Cells,
        state: &[f64],
        shared: &Shared,
        jacobian: &mut Jacobian,
        shortcuts: &mut Shortcuts,
    ) {
        let (mut by_position, mut by_velocity) = (RingJacobian::zeros(), RingJacobian::zeros());
        for j in 0..self.element_count {
            let at = self.element_motion(j, PathMotion::at_rest(state[j]), &shared.now, shortcuts);
            let found = self.in_balance(self.cells_of(cells, j), state[j], &at, shortcuts);
            self.add_balanced(&found.elastic, &mut by_position);
            for axis in 0..2 {
                let rings = self.damped_by_drift(&found, axis);
                by_velocity.column_mut(axis).zip_apply(&rings, |sum, force| *sum -= force);
                by_velocity.column_mut(2 + axis).zip_apply(&rings, |sum, force| *sum += force);
            }
        }
        for (whole, of_elements) in [(&mut jacobian.by_position, by_position), (&mut jacobian.by_velocity, by_velocity)]
        {
            let mut corner = whole.fixed_view_mut::<4, 4>(0, 0);
            corner += RingJacobian::from_diagonal(&shared.inverse_masses) * of_elements;
        }
    }

    /// One element's block, and its part of the bodies'.
    fn add_element(&self, j: usize, element: &Linearized, shared: &Shared, jacobian: &mut Jacobian) {
        let (ElementMotion { e_r, e_t, omega, .. }, [by_q, by_q_rate]) = (element.at, element.by_q());
        let per_mass = self.per_mass_of(j);
        let by_path = element.change(&ElementVariation::of_path());
        let by_rate = element.change(&ElementVariation::of_path_rate());
        // e_rᵀ G and e_rᵀ D: D is symmetric, G with damping is not.
        let (row_g, row_d) = (by_q.tr_mul(&e_r), by_q_rate.tr_mul(&e_r));
        let on_rings = |shaft: Vector, housing: Vector| shared.inverse_masses.component_mul(&stacked(shaft, housing));
        jacobian.elements[j] = ElementBlock {
            e_r,
            by_path: by_path.radial() * per_mass + omega * omega,
            by_velocity: by_rate.radial() * per_mass,
            by_offset: row_g * per_mass,
            by_shaft_velocity: -row_d * per_mass,
            by_housing_velocity: (e_t * row_d.dot(&e_t) + e_r * by_rate.outer.x) * per_mass + e_t * omega,
            rings_by_path: on_rings(element.at.on_shaft(by_path.inner), element.at.on_housing(by_path.outer)),
            rings_by_velocity: on_rings(element.at.on_shaft(by_rate.inner), element.at.on_housing(by_rate.outer)),
        };
        let of_shaft = shared.inverse_masses[0];
        let (g, d, swing) = (by_q * of_shaft, by_q_rate * of_shaft, by_q_rate * e_t * of_shaft * e_t.transpose());
        let on_housing = element.at.on_housing(by_rate.outer) * shared.inverse_masses[2] * e_r.transpose();
        let (position, velocity) = (&mut jacobian.by_position, &mut jacobian.by_velocity);
        let mut corner = position.fixed_view_mut::<2, 2>(0, 0);
        corner += g;
        let mut corner = position.fixed_view_mut::<2, 2>(0, 2);
        corner -= g;
        let mut corner = velocity.fixed_view_mut::<2, 2>(0, 0);
        corner += d;
        let mut corner = velocity.fixed_view_mut::<2, 2>(0, 2);
        corner -= swing;
        let mut corner = velocity.fixed_view_mut::<2, 2>(2, 2);
        corner -= on_housing;
    }

    /// One element's part of the derivative by time.
    fn add_element_by_time(&self, j: usize, element: &Linearized, shared: &Shared, jacobian: &mut Jacobian) {
        let Jacobian { by_time, body_indices, .. } = jacobian;
        let Linearized { at: ElementMotion { e_r, e_t, omega, alpha, .. }, rho, inner, outer, .. } = *element;
        let (now, [shaft, housing]) = (&shared.now, &shared.prescribed);
        let v = now.housing.velocity;
        let path_rate = -omega * v.dot(&e_t) - housing.velocity.dot(&e_r);
        let with_time = element.change(&ElementVariation {
            offset: housing.position - shaft.position,
            drift: housing.velocity - shaft.velocity,
            path: 0.0,
            path_rate,
            angle: omega,
            speed: alpha,
            film_speed: shared.film_rate,
            frames: shared.frames,
        });
        by_time[j] = path_rate;
        by_time[self.layout.radial_velocity + j] = (with_time.radial() + omega * inner.force.y) * self.per_mass_of(j)
            + omega * self.gravity.dot(&e_t)
            + alpha * (v.dot(&e_t) + 2.0 * rho * omega)
            + omega * (housing.velocity.dot(&e_t) - omega * v.dot(&e_r));
        let turning = e_r * (omega * outer.force.y) + e_t * (omega * outer.force.x);
        let force = stacked(element.at.on_shaft(with_time.inner), element.at.on_housing(with_time.outer) + turning);
        for i in 0..4 {
            if let Some(BodyIndices { velocity, .. }) = body_indices[i] {
                by_time[velocity] += shared.inverse_masses[i] * force[i];
            }
        }
    }

    /// Starts `jacobian` with what does not come from contacts: supports, sensor, loads.
    fn add_supports(&self, excitation: &Excitation, tau: f64, shared: &Shared, jacobian: &mut Jacobian) {
        let [by_position, by_velocity] = self.supports.accelerations_by_motion();
        jacobian.by_position.copy_from(by_position);
        jacobian.by_velocity.copy_from(by_velocity);
        jacobian.by_time[2 * self.layout.radial_velocity..].fill(0.0);
        // Prescribed rings move the sensor; on the rings themselves nothing but their loads depends on time.
        let [shaft, housing] = &shared.prescribed;
        let moves = Kinematics { shaft: *shaft, housing: *housing, ..*shared.now };
        let [velocity, acceleration] = moves.bodies();
        let loads = excitation.shaft_load.iter().chain(&excitation.housing_load).map(|load| load.rate_at(tau));
        let loads = Bodies::from_iterator(loads.chain([0.0; MOST_SENSORS]));
        let forces = self.supports.forces(&velocity, &acceleration) + loads;
        let rates = forces.component_mul(&self.supports.inverse_masses());
        for (body, rate) in jacobian.body_indices.iter().zip(&rates) {
            if let Some(BodyIndices { velocity, .. }) = *body {
                jacobian.by_time[velocity] = *rate;
            }
        }
    }
}

fn body_indices(layout: &Layout) -> [Option<BodyIndices>; BODIES] {
    let ring =
        |start: Option<usize>, axis: usize| start.map(|i| BodyIndices { position: i + axis, velocity: i + 2 + axis });
    let mut indices = [None; BODIES];
    indices[..4].copy_from_slice(&[
        ring(layout.shaft, 0),
        ring(layout.shaft, 1),
        ring(layout.housing, 0),
        ring(layout.housing, 1),
    ]);
    for (body, i) in indices.iter_mut().skip(4).zip(layout.sensor_indices()) {
        *body = Some(BodyIndices { position: i, velocity: i + 1 });
    }
    indices
}

#[cfg(test)]
pub(crate) mod tests;
