//! Static equilibrium: the load distribution from which a run starts.
//!
//! Rings are at rest or move as prescribed, elements keep their distance from the outer ring (u' = 0) and go round with
//! the cage: they feel gravity, the centrifugal force and the contacts' damping at those rates, so that no acceleration
//! is left at the start. Each element's radial balance is solved inside (its force falls monotonically with u), then
//! the internal rings' by Newton's method on the elastic tangent, after many steps on that of the damped contacts, with
//! a shift that keeps a loose ring's step bounded, and a search along the step for the point at which the residual no
//! longer pushes forward: in a convex potential that is the minimum along the line.
//!
//! An element that nothing pushes rests against the outer raceway without force.
//!
//! *A balance between two paths.* Where a damped raceway comes towards an element at a rate δ̇ > 0, its force near δ =
//! 0 is that of the damper, n τ δ̇ S(δ) under proportional damping: K n τ δ̇ δ^(1/9) of a straight roller. What
//! balances a weight G is δ = (G/(K n τ δ̇))^9. For an NU 205's roller (K 1.2e9 N/m^(10/9), G 0.03 N, τ 1.25e-5 s) that
//! is 3e-16 m at 0.1 mm/s and 1e-21 m at 0.4 mm/s, while paths of 30 µm are numbers 3e-21 m apart: from one number to
//! the next the force goes from less than the weight to more. (A ball's δ is above 1e-13 m up to 0.1 m/s.) The balance
//! then lies between the two paths; forces are those of the way between them at which nothing is left, and the state is
//! the path at which less is.

use super::element::ElementAtRest;
pub use super::error::EquilibriumError;
use super::limits::{
    DOUBLING, ITERATIONS, RESIDUAL, SMALLEST_RESIDUAL, Tried, UNBALANCED, as_far_as_it_pushes, longest_step,
};
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{ElementMotion, Meeting, Shortcuts};
use crate::dynamics::parameters::{Cells, Excitation, FramedKinematics, Model, PathMotion, SMOOTH};
use crate::dynamics::quasi_static::{RadialForce, Rings, in_plane, stacked};
use crate::numerics::plane::Vector;
use crate::numerics::sin_cos;
use std::f64::consts::FRAC_PI_4;

/// How far from where a search ended a contact law is asked for an answer (m): far above the rounding of paths.
const FURTHER: f64 = 1e-15;
/// Times that cells are looked up anew for the equilibrium found.
const CELLS: u32 = 8;

impl Model {
    /// Writes the static equilibrium under `excitation` at τ = 0 into `state`; velocities are those of rings at rest,
    /// or of prescribed rings that carry the elements along.
    pub fn equilibrium(
        &self,
        excitation: &Excitation,
        cells: &Cells,
        state: &mut [f64],
    ) -> Result<(), EquilibriumError> {
        if let Some(space) = &self.space {
            return self.spatial_equilibrium(space, excitation, cells, state);
        }
        let shortcuts = &mut Shortcuts::default();
        state.fill(0.0);
        let mut u = vec![0.0; self.element_count];
        let given = Given { excitation, cells, still: self.kinematics(excitation, 0.0, state) };
        let rings = stacked(given.still.shaft.position, given.still.housing.position);
        let mut found = self.equilibrium_from(&given, rings, &mut u, shortcuts);
        // Over steep defects more than one way down ends on a ledge.
        for start in self.other_starts() {
            if !matches!(found, Err(EquilibriumError::NotFound { .. })) {
                break;
            }
            u.fill(0.0);
            let again = self.equilibrium_from(&given, rings + start, &mut u, shortcuts);
            found = again.or(found);
        }
        self.write(excitation, found?, &u, state);
        Ok(())
    }

    /// Displacements of the free rings (m) from which a balance is looked for that was not found from rest: all around,
    /// to where elements just touch and as far again.
    fn other_starts(&self) -> impl Iterator<Item = Rings> {
        let play = 0.5 * self.radial_clearance.max(0.0) + 1e-3 * self.element_radius;
        (0..16).map(move |k| {
            let (sin, cos) = sin_cos(f64::from(k % 8) * FRAC_PI_4);
            let by = Vector::new(sin, -cos) * if k < 8 { play } else { 2.0 * play };
            self.free_rings(stacked(by, -by))
        })
    }

    /// The free rings in balance, all elements with them, looked for from there.
    fn equilibrium_from(
        &self,
        given: &Given,
        mut rings: Rings,
        u: &mut [f64],
        shortcuts: &mut Shortcuts,
    ) -> Result<Rings, EquilibriumError> {
        let mut balance = self.balance(given, rings, u, shortcuts);
        let mut iteration = 0;
        // An element without a balance where the rings are to begin with is found by the checks below.
        while balance.residual() > balance.limit && balance.residual().is_finite() {
            iteration += 1;
            let step = self.newton_step(given, rings, u, (&balance, iteration), shortcuts);
            let next = self.along(given, (rings, step), u, &balance, shortcuts).filter(|_| iteration <= ITERATIONS);
            let Some(next) = next else {
                if balance.residual() <= balance.rounding {
                    // As near as roundings let it come: back to the paths of these rings.
                    self.balance(given, rings, u, shortcuts);
                    break;
                }
                // A step that cannot be taken may end where a contact has no answer.
                let tried = rings + step;
                self.balance(given, tried, u, shortcuts);
                self.check_contacts(given, tried, u, shortcuts)?;
                return Err(EquilibriumError::NotFound { residual: balance.residual(), limit: balance.limit });
            };
            (rings, balance) = next;
        }
        self.check_contacts(given, rings, u, shortcuts)?;
        self.check_elements(given, rings, u, shortcuts)?;
        Ok(rings)
    }

    /// As [`equilibrium`](Self::equilibrium), the cells of all contacts found with it: in which cell an inner contact
    /// is depends on where the rings come to rest.
    ///
    /// # Errors
    /// As there.
    pub fn equilibrium_with_cells(
        &self,
        excitation: &Excitation,
        state: &mut [f64],
    ) -> Result<Cells, EquilibriumError> {
        state.fill(0.0);
        let mut cells = self.cells_at(excitation, 0.0, state);
        for _ in 0..CELLS {
            self.equilibrium(excitation, &cells, state)?;
            let there = self.cells_at(excitation, 0.0, state);
            // A contact on a knot may be in either cell.
            if there == cells || !self.has_inner_defects() {
                break;
            }
            cells = there;
        }
        Ok(cells)
    }

    /// Refuses elements whose balance lies where the contact law near the defect has no answer: their search ends
    /// there.
    fn check_contacts(
        &self,
        given: &Given,
        rings: Rings,
        u: &[f64],
        shortcuts: &mut Shortcuts,
    ) -> Result<(), EquilibriumError> {
        let now = given.with_rings(rings);
        for (j, &u) in u.iter().enumerate() {
            let cells = self.cells_of(given.cells, j);
            let ElementMotion { e_r, angle, .. } = self.element_motion(j, PathMotion::at_rest(u), &now, shortcuts);
            let gap = self.inner_gap(j, u - FURTHER, now.offset(), e_r, self.clearance(now.films.as_ref()));
            let inner = self.inner_meeting(j, cells[0], &gap, angle);
            let outer = Meeting { u: u + FURTHER, ..self.outer_meeting(angle, j, cells[1], u) };
            for (side, at) in [(RacewaySide::Outer, outer), (RacewaySide::Inner, inner)] {
                if at.cells == [SMOOTH; 2] {
                    continue;
                }
                let Err(cause) = self.near(side, &at, &now.frames, shortcuts) else { continue };
                // The search may have ended on the far side, where all is NaN.
                let element = self.at_rest(j, cells, u - FURTHER, &now, shortcuts);
                let residual = self.radial_force(&element).force;
                if !(residual.abs() <= UNBALANCED * element.inner.force.norm()) {
                    let angle_deg = self.angle_from_defect(side, &at, &now.frames).to_degrees();
                    return Err(EquilibriumError::Contact { element: j + 1, angle_deg, residual, cause });
                }
            }
        }
        Ok(())
    }

    /// Refuses a balance of the rings in which an element has none: the search for its path ends wherever it got to. Of
    /// two paths between which a balance lies, takes the one at which less force is left.
    fn check_elements(
        &self,
        given: &Given,
        rings: Rings,
        u: &mut [f64],
        shortcuts: &mut Shortcuts,
    ) -> Result<(), EquilibriumError> {
        let now = given.with_rings(rings);
        for (j, path) in u.iter_mut().enumerate() {
            let cells = self.cells_of(given.cells, j);
            let element = self.at_rest(j, cells, *path, &now, shortcuts);
            let RadialForce { force, slope } = self.radial_force(&element);
            let is_steep = !self.elements_in_balance() && !(force.abs() <= self.no_force(&element));
            let nearer = is_steep.then(|| self.balanced_element(j, cells, *path, &now, shortcuts).nearer).flatten();
            *path = nearer.unwrap_or(*path);
            let is_balanced = nearer.is_some() || force.abs() <= self.no_force_at(&element, slope);
            if !(is_balanced && path.abs() <= self.element_radius) {
                return Err(EquilibriumError::Element { element: j + 1, path: *path, force });
            }
        }
        Ok(())
    }

    /// Balances all elements for given rings and sums the forces on the rings.
    fn balance(&self, given: &Given, rings: Rings, u: &mut [f64], shortcuts: &mut Shortcuts) -> Balance {
        let Given { excitation, cells, .. } = given;
        let now = given.with_rings(rings);
        let (mut force, mut largest, mut contact_sum, mut rounding) = (Rings::zeros(), 0.0f64, 0.0, 0.0);
        let play = now.offset().norm() + self.clearance(now.films.as_ref()).abs();
        for j in 0..self.element_count {
            let in_cells = self.cells_of(cells, j);
            let ElementAtRest { path, element, nearer } = if self.elements_in_balance() {
                let at = self.element_motion(j, PathMotion::at_rest(u[j]), &now, shortcuts);
                let found = self.in_balance(in_cells, u[j], &at, shortcuts);
                let [shaft, housing] = found.element().on_rings();
                force += stacked(shaft, housing);
                ElementAtRest { path: found.path, element: found.elastic, nearer: None }
            } else {
                let found = self.balanced_element(j, in_cells, u[j], &now, shortcuts);
                let [shaft, housing] = found.element.forces().on_rings(&found.element.at);
                force += stacked(shaft, housing);
                found
            };
            u[j] = path;
            if nearer.is_none() {
                rounding += self.radial_force(&element).slope.abs() * (path.abs() + play) * 4.0 * f64::EPSILON;
            }
            let (inner, outer) = (element.inner.force, element.outer.force);
            contact_sum += inner.norm();
            largest = largest.max(inner.amax()).max(outer.amax());
        }
        let loads = in_plane(&excitation.load.map(|ring| ring.map(|load| load.at(0.0))));
        let supports = Rings::from(self.supports.ring_stiffnesses()).component_mul(&rings);
        force += loads - supports;
        largest = largest.max(loads.amax()).max(supports.amax());
        let limit = RESIDUAL * largest + SMALLEST_RESIDUAL;
        Balance { force: self.free_rings(force), contact_sum, limit, rounding }
    }

    /// A step of the free rings from the condensed tangent: (−J + μ) step = force.
    fn newton_step(
        &self,
        given: &Given,
        rings: Rings,
        u: &[f64],
        (balance, iteration): (&Balance, i32),
        shortcuts: &mut Shortcuts,
    ) -> Rings {
        let now = given.with_rings(rings);
        // Where a host draws the rings apart so fast that dampers leave nothing of their contacts' forces, the elastic
        // tangent is far too stiff.
        let jacobian = if iteration > DOUBLING {
            self.ring_jacobian_at(u, given.cells, &now, false, shortcuts)
        } else {
            self.ring_jacobian_at(u, given.cells, &now.standing(), false, shortcuts)
        };
        // The turning of contact forces makes a lightly held ring's tangent indefinite; its bound ΣQ/|q| takes that
        // out. The second term lets a loose ring move by the longest step, and vanishes with the residual.
        let longest = longest_step(iteration);
        let (turning, free) = (balance.contact_sum / self.outer_centre_radius, balance.residual() / longest);
        let solve = |share: f64| {
            let mut matrix = self.free_rings_matrix(&jacobian, share * (turning + free));
            if iteration > DOUBLING {
                // What turns a force is the rings' offset. Preloaded rings that soft supports let go together would
                // creep.
                self.couple(&mut matrix, -share * turning);
            }
            let solved = matrix.lu().solve(&balance.force);
            solved.filter(|step| step.iter().all(|part| part.is_finite()) && step.dot(&balance.force) > 0.0)
        };
        // |q| is less than the centres' radius by some of the clearance: on top of an element a little is left of the
        // turning.
        let step = solve(1.0).or_else(|| solve(2.0));
        let step = step.unwrap_or_else(|| balance.force / balance.residual() * longest);
        let length = step.amax();
        if length > longest { step * (longest / length) } else { step }
    }

    /// Goes along a step as far as the residual pushes forward.
    fn along(
        &self,
        given: &Given,
        (rings, step): (Rings, Rings),
        u: &mut [f64],
        start: &Balance,
        shortcuts: &mut Shortcuts,
    ) -> Option<(Rings, Balance)> {
        as_far_as_it_pushes(start.force.dot(&step), 100, |share| {
            let next = rings + step * share;
            let balance = self.balance(given, next, u, shortcuts);
            let (push, is_balanced) = (balance.force.dot(&step), balance.residual() <= balance.limit);
            Tried { there: (next, balance), push, is_balanced }
        })
    }

    fn write(&self, excitation: &Excitation, rings: Rings, u: &[f64], state: &mut [f64]) {
        let w = self.layout.radial_velocity;
        state[..self.element_count].copy_from_slice(u);
        for (index, first) in [(self.layout.shaft, 0), (self.layout.housing, 2)] {
            if let Some(i) = index {
                state[i..i + 2].copy_from_slice(&rings.as_slice()[first..first + 2]);
            }
        }
        // At rest against the outer ring: u' = 0.
        let now = self.kinematics(excitation, 0.0, state);
        for j in 0..self.element_count {
            state[w + j] = now.housing.velocity.dot(&self.direction(j, &now));
        }
        for (sensor, i) in self.supports.sensors.iter().zip(self.layout.sensor_indices()) {
            let e = sensor.direction;
            (state[i], state[i + 1]) = (now.housing.position.dot(&e), now.housing.velocity.dot(&e));
        }
    }
}

/// What the search is given. Velocities in `still` stay; where the rings are follows in each iteration.
struct Given<'a> {
    excitation: &'a Excitation,
    cells: &'a Cells,
    still: FramedKinematics,
}

impl Given<'_> {
    /// The instant `still` with the rings there.
    fn with_rings(&self, rings: Rings) -> FramedKinematics {
        let mut now = self.still;
        (now.shaft.position, now.housing.position) = (Vector::new(rings[0], rings[1]), Vector::new(rings[2], rings[3]));
        now
    }
}

/// Net force on the free rings.
struct Balance {
    force: Rings,
    /// Σ|Q_i| (N)
    contact_sum: f64,
    limit: f64,
    /// What roundings of the positions make of the forces (N); more than the limit where a damper is steep.
    rounding: f64,
}

impl Balance {
    /// Infinite where an element found no balance: nalgebra's largest passes over NaN.
    fn residual(&self) -> f64 {
        if self.force.iter().all(|force| force.is_finite()) { self.force.amax() } else { f64::INFINITY }
    }
}
