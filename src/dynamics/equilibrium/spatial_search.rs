//! The static equilibrium in space: each ball's balance is solved inside, then that of the free rings by Newton's
//! method on the tangent with the balls in balance, as in the plane ([`super::search`]). Tilts count as lengths at the
//! pitch radius, moments as forces there.
//!
//! The search begins where the bearing is about closed along the axis, in the sense of the axial load.
//!
//! On its way balls may come deeper than the law of contact near a defect reaches. There the search takes the smooth
//! raceway, which pushes more, so that forces still fall as balls give way; a balance in which one stays there is
//! refused.

use super::error::EquilibriumError;
use super::limits::{ITERATIONS, RESIDUAL, SMALLEST_RESIDUAL, Tried, UNBALANCED, as_far_as_it_pushes, longest_step};
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::parameters::{
    COORDINATES, Cells, Excitation, FramedKinematics, Layout, Model, RINGS, RingInSpace, Space,
};
use crate::dynamics::spatial::{BallMotion, Balls};
use nalgebra::{DMatrix, DVector};

/// Rounding of distances of some 20 mm (m).
const ROUNDING: f64 = 1e-17;
/// What the search is given.
struct Given<'a> {
    space: &'a Space,
    excitation: &'a Excitation,
    cells: &'a Cells,
    still: FramedKinematics,
    /// The rings as the host has them; free coordinates are looked for.
    rings: [RingInSpace; 2],
    /// Coordinates that are looked for.
    free: Vec<usize>,
}

/// Net force on the free coordinates, as forces (N).
struct Balance {
    force: DVector<f64>,
    contact_sum: f64,
    limit: f64,
}

impl Balance {
    fn residual(&self) -> f64 {
        if self.force.iter().all(|force| force.is_finite()) { self.force.amax() } else { f64::INFINITY }
    }
}

impl Given<'_> {
    /// The rings with the free coordinates at `x` (m).
    fn rings_at(&self, x: &DVector<f64>) -> [RingInSpace; 2] {
        let mut rings = self.rings;
        for (&i, x) in self.free.iter().zip(x.iter()) {
            rings[i / COORDINATES].position[i % COORDINATES] = x / self.space.length(i);
        }
        rings
    }
}

impl Model {
    /// As [`Model::equilibrium`] in space.
    pub(super) fn spatial_equilibrium(
        &self,
        space: &Space,
        excitation: &Excitation,
        cells: &Cells,
        state: &mut [f64],
    ) -> Result<(), EquilibriumError> {
        let shortcuts = &mut Shortcuts::default();
        state.fill(0.0);
        let still = self.kinematics(excitation, 0.0, state);
        let rings = self.rings_in_space(excitation, 0.0, state, None);
        let free = (0..RINGS).filter(|&i| space.free[i]).collect();
        let given = Given { space, excitation, cells, still, rings, free };
        let mut x = DVector::from_iterator(given.free.len(), given.free.iter().map(|&i| self.first_place(&given, i)));
        let middle = 0.5 * [0, 1].map(|ring| self.shifted(&given, &x, ring)).iter().sum::<f64>();
        let mut balls = vec![[0.0, middle]; self.element_count];
        let mut balance = self.spatial_balance(&given, &x, &mut balls, shortcuts);
        let mut iteration = 0;
        while balance.residual() > balance.limit && balance.residual().is_finite() {
            iteration += 1;
            let step = self.spatial_newton_step(&given, &x, &balls, (&balance, iteration), shortcuts);
            let next = self
                .along_spatial(&given, (&x, step), &mut balls, &balance, shortcuts)
                .filter(|_| iteration <= ITERATIONS);
            let Some(next) = next else {
                self.check_balls(&given, &x, &mut balls, shortcuts)?;
                return Err(EquilibriumError::NotFound { residual: balance.residual(), limit: balance.limit });
            };
            (x, balance) = next;
        }
        self.check_balls(&given, &x, &mut balls, shortcuts)?;
        self.write_in_space(&given, &x, &balls, state);
        Ok(())
    }

    /// Axial place (m) of the circle of groove centres of a ring.
    fn shifted(&self, given: &Given, x: &DVector<f64>, ring: usize) -> f64 {
        given.rings_at(x)[ring].position[2] + given.space.grooves[ring].shift
    }

    /// Where the search for a coordinate begins (m): for z where the bearing is closed in the sense of what acts on the
    /// ring, and for all others at 0.
    fn first_place(&self, given: &Given, coordinate: usize) -> f64 {
        if coordinate % COORDINATES != 2 {
            return 0.0;
        }
        let ring = coordinate / COORDINATES;
        let load = given.excitation.loads_in_space(0.0)[0][coordinate] + given.space.preload[ring];
        let [inner, outer] = &given.space.grooves;
        // The grooves' centres at their distance in the meridian plane from each other, and beside it along the axis.
        let (distance, radial) = (inner.reach + outer.reach, inner.centre_radius - outer.centre_radius);
        let closed = (distance * distance - radial * radial).max(0.0).sqrt();
        let sense = if load == 0.0 { return 0.0 } else { load.signum() * if ring == 0 { 1.0 } else { -1.0 } };
        let root = libm::cbrt(load.abs() / (self.element_count as f64 * self.inner.contact.law.stiffness));
        let approach = root * root;
        let apart = sense * (closed + 4.0 * approach) - (inner.shift - outer.shift);
        let held = &given.rings;
        match ring {
            0 => held[1].position[2] + apart,
            // Between two free rings the inner one has moved already.
            _ if given.space.free[2] => 0.0,
            _ => held[0].position[2] - apart,
        }
    }

    /// Balances all balls for given rings and sums the forces on the free coordinates.
    fn spatial_balance(
        &self,
        given: &Given,
        x: &DVector<f64>,
        balls: &mut [[f64; 2]],
        shortcuts: &mut Shortcuts,
    ) -> Balance {
        let (space, rings) = (given.space, given.rings_at(x));
        let [mut sums, _] = given.excitation.loads_in_space(0.0);
        for (ring, preload) in space.preload.into_iter().enumerate() {
            sums[COORDINATES * ring + 2] += preload;
        }
        let mut largest =
            sums.iter().enumerate().fold(0.0f64, |most, (i, load)| most.max(load.abs() / space.length(i)));
        let (mut contact_sum, mut rounding) = (0.0, 0.0);
        for (j, place) in balls.iter_mut().enumerate() {
            let (at, alpha) = self.ball_motion(j, &given.still, &rings, shortcuts);
            let at = BallMotion { tried: true, ..at };
            let cells = self.cells_of(given.cells, j);
            let (there, forces) = if self.elements_in_balance() {
                let found = self.ball_in_balance(space, cells, *place, (&at, alpha), shortcuts);
                (found.place, found.forces)
            } else {
                let found = self.balanced_ball(space, cells, *place, &at, at.omega, shortcuts);
                (found.at, found.forces)
            };
            *place = there;
            for (sum, force) in sums.iter_mut().zip(forces.on_rings().as_flattened()) {
                *sum += force;
            }
            for (side, contact) in forces.contacts.iter().enumerate() {
                contact_sum += contact.magnitude;
                largest = largest.max(contact.magnitude);
                let law = &[&self.inner, &self.outer][side].contact.law;
                rounding += law.elastic_stiffness(contact.approach.max(0.0)) * ROUNDING;
            }
        }
        let force = given.free.iter().map(|&i| {
            let support = space.support_stiffness(i) * rings[i / COORDINATES].position[i % COORDINATES];
            largest = largest.max(support.abs() / space.length(i));
            (sums[i] - support) / space.length(i)
        });
        let force = DVector::from_iterator(given.free.len(), force.collect::<Vec<_>>());
        Balance { force, contact_sum, limit: RESIDUAL * largest + SMALLEST_RESIDUAL + rounding }
    }

    /// A step of the free coordinates from the condensed tangent: (−J + μ) step = force.
    fn spatial_newton_step(
        &self,
        given: &Given,
        x: &DVector<f64>,
        balls: &[[f64; 2]],
        (balance, iteration): (&Balance, i32),
        shortcuts: &mut Shortcuts,
    ) -> DVector<f64> {
        let (space, rings) = (given.space, given.rings_at(x));
        let (cells, balls) = (given.cells, Balls { places: balls, searched: true });
        let tangent = self.spatial_tangent::<{ 2 + RINGS }>(space, &given.still, &rings, cells, balls, shortcuts);
        let longest = longest_step(iteration);
        let (turning, loose) = (balance.contact_sum / self.outer_centre_radius, balance.residual() / longest);
        let count = given.free.len();
        let solve = |shift: f64| {
            let matrix = DMatrix::from_fn(count, count, |row, column| {
                let (i, k) = (given.free[row], given.free[column]);
                let own = if i == k { space.support_stiffness(i) } else { 0.0 };
                let shifted = if i == k { shift } else { 0.0 };
                (own - tangent[i][k]) / (space.length(i) * space.length(k)) + shifted
            });
            let step = matrix.lu().solve(&balance.force);
            step.filter(|step| step.iter().all(|part| part.is_finite()) && step.dot(&balance.force) > 0.0)
        };
        let step = solve(loose).or_else(|| solve(turning + loose)).or_else(|| solve(2.0 * (turning + loose)));
        let step = step.unwrap_or_else(|| &balance.force * (longest / balance.residual()));
        let length = step.amax();
        if length > longest { step * (longest / length) } else { step }
    }

    /// Goes along a step as far as the residual pushes forward.
    fn along_spatial(
        &self,
        given: &Given,
        (x, step): (&DVector<f64>, DVector<f64>),
        balls: &mut [[f64; 2]],
        start: &Balance,
        shortcuts: &mut Shortcuts,
    ) -> Option<(DVector<f64>, Balance)> {
        as_far_as_it_pushes(start.force.dot(&step), 60, |share| {
            let next = x + &step * share;
            let balance = self.spatial_balance(given, &next, balls, shortcuts);
            let (push, is_balanced) = (balance.force.dot(&step), balance.residual() <= balance.limit);
            Tried { there: (next, balance), push, is_balanced }
        })
    }

    /// Refuses a balance in which a ball has none.
    fn check_balls(
        &self,
        given: &Given,
        x: &DVector<f64>,
        balls: &mut [[f64; 2]],
        shortcuts: &mut Shortcuts,
    ) -> Result<(), EquilibriumError> {
        let rings = given.rings_at(x);
        for (j, place) in balls.iter_mut().enumerate() {
            let (at, _) = self.ball_motion(j, &given.still, &rings, shortcuts);
            let (cells, omega) = (self.cells_of(given.cells, j), at.omega);
            let at = if self.elements_in_balance() { at.standing() } else { at };
            let found = self.balanced_ball(given.space, cells, *place, &at, omega, shortcuts);
            let [r, z] = found.residual;
            let body = self.element_mass * (self.gravity.norm() + found.forces.ball.rho * omega * omega);
            let sum: f64 = found.forces.contacts.iter().map(|contact| contact.magnitude).sum();
            let force = libm::hypot(r, z);
            // A ball is out of balance by what the rounding of its place makes of it.
            let rounded: f64 =
                found.forces.contacts.iter().zip([&self.inner, &self.outer]).fold(0.0, |sum, (at, on)| {
                    let law = &on.contact.law;
                    sum + law.elastic(2.0 * ROUNDING) + law.elastic_stiffness(at.approach.max(0.0)) * ROUNDING
                });
            if !force.is_finite()
                && let Some(unsolved) = self.unsolved_contact(cells, &at, &found.forces, shortcuts)
            {
                let (element, angle_deg) = (j + 1, unsolved.angle.to_degrees());
                return Err(EquilibriumError::Unsolved { element, angle_deg, cause: unsolved.cause });
            }
            if !(force <= UNBALANCED * (sum + body) + rounded && found.at[0].abs() <= self.element_radius) {
                return Err(EquilibriumError::Element { element: j + 1, path: found.at[0], force });
            }
        }
        Ok(())
    }

    fn write_in_space(&self, given: &Given, x: &DVector<f64>, balls: &[[f64; 2]], state: &mut [f64]) {
        let (layout, rings) = (&self.layout, given.rings_at(x));
        for (start, ring) in [layout.shaft, layout.housing].into_iter().zip(&rings) {
            let Some(start) = start else { continue };
            for (k, &position) in ring.position.iter().enumerate() {
                state[start + Layout::POSITIONS[k]] = position;
            }
        }
        let Some([v, w_z]) = layout.axial() else { return };
        let housing = &rings[1];
        for (j, place) in balls.iter().enumerate() {
            // At rest against the outer ring: u' = 0 and v' = 0.
            let e_r = self.ball_motion(j, &given.still, &rings, &mut Shortcuts::default()).0.e_r;
            (state[j], state[v + j]) = (place[0], place[1]);
            state[layout.radial_velocity + j] = housing.velocity[0] * e_r[0] + housing.velocity[1] * e_r[1];
            state[w_z + j] = housing.velocity[2];
        }
        for (k, i) in layout.sensor_indices().enumerate() {
            state[i] = given.space.along_sensor(k, &housing.position);
            state[i + 1] = given.space.along_sensor(k, &housing.velocity);
        }
    }
}
