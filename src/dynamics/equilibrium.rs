//! Static equilibrium: the load distribution from which a run starts.
//!
//! Rings are at rest or move as prescribed, elements keep their distance from the outer ring (u' = 0) and go round with
//! the cage: they feel gravity, the centrifugal force and the contacts' damping at those rates, so that no acceleration
//! is left at the start. Each element's radial balance is solved inside (its force falls monotonically with u), then the internal rings' by Newton's method on
//! the condensed tangent with a shift that keeps a loose ring's step bounded, and a search along the step for the point
//! at which the residual no longer pushes forward: in a convex potential that is the minimum along the line.
//!
//! An element that nothing pushes rests against the outer raceway without force.

use super::drive::{Drive, Quadratic};
use super::forces::{SMOOTH, dot};
use super::model::Model;
use crate::numerics::linear::solve4;
use crate::scene::Motion;

/// Why no equilibrium was found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EquilibriumError {
    /// The residual did not vanish.
    #[error(
        "no static equilibrium: a net force of {residual:.3e} N stays on the rings (limit {limit:.1e} N); \
         give the internal rings a support stiffness that can carry their load"
    )]
    NotFound {
        /// Force left [N].
        residual: f64,
        /// Largest force allowed [N].
        limit: f64,
    },
}

/// Share of the largest force in play that may remain as residual: a few roundings of a sum of Z forces.
const RESIDUAL: f64 = 1e-12;
/// Residual that counts as none [N], for bearings without load: rounding of positions times contact stiffness.
const SMALLEST_RESIDUAL: f64 = 1e-12;
/// Longest step of a ring between two iterations [m].
const LONGEST_STEP: f64 = 50e-6;
const ITERATIONS: usize = 500;

impl Model {
    /// Writes the static equilibrium under `drive` at τ = 0 into `state`; velocities are those of rings at rest, or of
    /// prescribed rings that carry the elements along.
    pub fn equilibrium(&self, drive: &Drive, cells: &[u32], state: &mut [f64]) -> Result<(), EquilibriumError> {
        state.fill(0.0);
        let mut rings = Rings::start(self, drive);
        let mut u = vec![0.0; self.element_count];
        let mut balance = self.balance(drive, cells, &rings, &mut u);
        let mut iteration = 0;
        while balance.residual() > balance.limit {
            iteration += 1;
            if iteration > ITERATIONS {
                return Err(EquilibriumError::NotFound { residual: balance.residual(), limit: balance.limit });
            }
            let step = self.newton_step(drive, cells, &rings, &u, &balance);
            let Some(next) = self.along(drive, cells, &rings, &mut u, &balance, step) else {
                return Err(EquilibriumError::NotFound { residual: balance.residual(), limit: balance.limit });
            };
            (rings, balance) = next;
        }
        self.write(drive, &rings, &u, state);
        Ok(())
    }

    /// The path [m] of element `j` (from 0) where it rests against the outer raceway without force.
    pub fn resting_path(&self, j: usize, cage_angle: f64) -> f64 {
        self.touching_path(j, self.cell_at(j, cage_angle), cage_angle)
    }

    /// Over the defect the path of an element without force is where the approach vanishes.
    fn touching_path(&self, j: usize, cell: u32, cage_angle: f64) -> f64 {
        let mut u = 0.0;
        for _ in 0..20 {
            let near = self.outer_approach(j, cell, u, cage_angle, self.outer_centre_radius + u);
            let step = near.value / near.by_path;
            u -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        u
    }

    /// The path at which an element is in radial balance, looked for from `guess` on.
    fn balanced_path(&self, cell: u32, guess: f64, radial: &Radial, at: &Start) -> f64 {
        let force = |u: f64| self.radial_force(cell, u, radial, at);
        let touch = if cell == SMOOTH { 0.0 } else { self.touching_path(radial.j, cell, at.cage_angle) };
        let at_touch = force(touch).0;
        if at_touch == 0.0 {
            return touch;
        }
        // Newton from the path found last, with the bracket that the signs give; where Newton would leave the bracket or
        // leap, halving, or walking on as long as there is no bracket.
        let (mut low, mut high) = if at_touch > 0.0 { (touch, f64::INFINITY) } else { (f64::NEG_INFINITY, touch) };
        let mut stride = 1e-6f64.copysign(at_touch);
        let mut u = if guess > low && guess < high { guess } else { touch + stride };
        for _ in 0..300 {
            let (f, slope) = force(u);
            if f > 0.0 {
                low = u
            } else {
                high = u
            }
            let newton = u - f / slope;
            // A millionth of a millionth of a nanometre: the rounding of micrometre paths.
            if f == 0.0 || (newton - u).abs() < 1e-21 {
                return u;
            }
            let next = if newton > low && newton < high && (newton - u).abs() < LONGEST_STEP {
                newton
            } else if low.is_finite() && high.is_finite() {
                0.5 * (low + high)
            } else {
                stride *= 2.0;
                u + stride
            };
            if next <= low || next >= high || stride.abs() > 1.0 {
                return u;
            }
            u = next;
        }
        u
    }

    fn start(&self, drive: &Drive) -> Start {
        let velocity = |motion: Motion, place: &[Quadratic; 2]| {
            if motion == Motion::Host { place.map(|q| q.rate_at(0.0)) } else { [0.0; 2] }
        };
        let shaft = velocity(self.shaft.motion, &drive.shaft);
        let housing = velocity(self.housing.motion, &drive.housing);
        let cage_angle = drive.cage_angle(0.0);
        Start {
            cage_angle,
            cage: super::forces::cos_sin(cage_angle),
            omega: drive.cage.rate_at(0.0),
            drift: [0, 1].map(|a| housing[a] - shaft[a]),
        }
    }

    fn radial(&self, j: usize, offset: [f64; 2], at: &Start) -> Radial {
        let e_r = self.direction(j, at.cage);
        let e_t = [-e_r[1], e_r[0]];
        Radial {
            j,
            e_r,
            e_t,
            offset,
            drift: [dot(at.drift, e_r), dot(at.drift, e_t)],
            gravity: self.element_mass * dot(self.gravity, e_r),
        }
    }

    /// Radial force on an element at path `u`, and the slope of its elastic part.
    #[inline]
    fn radial_force(&self, cell: u32, u: f64, radial: &Radial, at: &Start) -> (f64, f64) {
        let rho = self.outer_centre_radius + u;
        let inner = self.inner_gap(u, radial.offset, radial.e_r);
        let rate = -(inner.n[0] * radial.drift[0] + inner.n[1] * (radial.drift[1] + rho * at.omega));
        let body = radial.gravity + self.element_mass * rho * at.omega * at.omega;
        let across = self.inner.elastic(inner.approach) / inner.distance;
        let k = self.inner.elastic_stiffness(inner.approach);
        let slope = across - (k + across) * inner.n[0] * inner.n[0];
        let near = self.outer_approach(radial.j, cell, u, at.cage_angle, rho);
        let outer = self.outer.force(near.value, near.by_angle * at.omega);
        let outer_slope = self.outer.elastic_stiffness(near.value) * near.by_path * near.radial
            + self.outer.elastic(near.value) * near.radial_by_path;
        let force = self.inner.force(inner.approach, rate) * inner.n[0] - outer * near.radial + body;
        (force, slope - outer_slope)
    }

    /// Contact forces on element `j` at the start's rates: u' = 0, rings at rest or as prescribed.
    fn damped_element(&self, cell: u32, u: f64, radial: &Radial, at: &Start) -> OnElement {
        let Radial { e_r, e_t, offset, .. } = *radial;
        let rho = self.outer_centre_radius + u;
        let inner = self.inner_gap(u, offset, e_r);
        let rate = -(inner.n[0] * radial.drift[0] + inner.n[1] * (radial.drift[1] + rho * at.omega));
        let force = self.inner.force(inner.approach, rate);
        let near = self.outer_approach(radial.j, cell, u, at.cage_angle, rho);
        let outer = self.outer.force(near.value, near.by_angle * at.omega);
        OnElement {
            inner: [0, 1].map(|a| force * (inner.n[0] * e_r[a] + inner.n[1] * e_t[a])),
            outer: [outer * near.radial, outer * near.tangential],
        }
    }

    /// Balances all elements for given rings and sums the forces on the rings.
    fn balance(&self, drive: &Drive, cells: &[u32], rings: &Rings, u: &mut [f64]) -> Balance {
        let (offset, at) = (rings.offset(), self.start(drive));
        let mut force = [0.0; 4];
        let (mut largest, mut contact_sum) = (0.0f64, 0.0);
        for j in 0..self.element_count {
            let radial = self.radial(j, offset, &at);
            u[j] = self.balanced_path(cells[j], u[j], &radial, &at);
            let (element, e_r) = (self.damped_element(cells[j], u[j], &radial, &at), radial.e_r);
            contact_sum += dot(element.inner, element.inner).sqrt();
            let on_housing = [0, 1].map(|a| element.outer[0] * e_r[a] - element.outer[1] * [-e_r[1], e_r[0]][a]);
            for a in 0..2 {
                force[a] -= element.inner[a];
                force[2 + a] += on_housing[a];
                largest = largest.max(element.inner[a].abs()).max(element.outer[a].abs());
            }
        }
        for a in 0..2 {
            let loads = [drive.shaft_load[a].at(0.0), drive.housing_load[a].at(0.0)];
            let supports = [self.shaft.stiffness * rings.position[a], self.housing.stiffness * rings.position[2 + a]];
            for ring in 0..2 {
                force[2 * ring + a] += loads[ring] - supports[ring];
                largest = largest.max(loads[ring].abs()).max(supports[ring].abs());
            }
        }
        for (f, free) in force.iter_mut().zip(rings.free) {
            if !free {
                *f = 0.0;
            }
        }
        Balance { force, contact_sum, limit: RESIDUAL * largest + SMALLEST_RESIDUAL }
    }

    /// A step of the free rings from the condensed tangent: (−J + μ) step = force.
    fn newton_step(&self, drive: &Drive, cells: &[u32], rings: &Rings, u: &[f64], balance: &Balance) -> [f64; 4] {
        let mut matrix = self.ring_jacobian(u, cells, rings.offset(), drive.cage_angle(0.0));
        // The turning of contact forces makes a lightly held ring's tangent indefinite; its bound ΣQ/|q| takes that out.
        // The second term lets a loose ring move by the longest step, and vanishes with the residual.
        let shift = balance.contact_sum / self.outer_centre_radius + balance.residual() / LONGEST_STEP;
        for (i, row) in matrix.iter_mut().enumerate() {
            let support = if i < 2 { self.shaft.stiffness } else { self.housing.stiffness };
            for (k, value) in row.iter_mut().enumerate() {
                let on_diagonal = if i == k { support + shift } else { 0.0 };
                *value = if rings.free[i] && rings.free[k] {
                    on_diagonal - *value
                } else if i == k {
                    1.0
                } else {
                    0.0
                };
            }
        }
        let mut step = solve4(matrix, balance.force);
        let length = step.iter().fold(0.0f64, |m, s| m.max(s.abs()));
        if !length.is_finite() || dot4(step, balance.force) <= 0.0 {
            step = balance.force.map(|f| f / balance.residual() * LONGEST_STEP);
        } else if length > LONGEST_STEP {
            step = step.map(|s| s * (LONGEST_STEP / length));
        }
        step
    }

    /// Goes along a step as far as the residual pushes forward.
    fn along(
        &self,
        drive: &Drive,
        cells: &[u32],
        rings: &Rings,
        u: &mut [f64],
        start: &Balance,
        step: [f64; 4],
    ) -> Option<(Rings, Balance)> {
        let push_0 = dot4(start.force, step);
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut share = 1.0;
        for _ in 0..100 {
            let next = rings.moved(step, share);
            let balance = self.balance(drive, cells, &next, u);
            let push = dot4(balance.force, step);
            if balance.residual() <= balance.limit || push.abs() <= 0.5 * push_0 || (push > 0.0 && high.is_infinite()) {
                return Some((next, balance));
            }
            if push > 0.0 {
                low = share
            } else {
                high = share
            }
            share = 0.5 * (low + high);
        }
        None
    }

    fn write(&self, drive: &Drive, rings: &Rings, u: &[f64], state: &mut [f64]) {
        let w = self.layout.radial_velocity;
        state[..self.element_count].copy_from_slice(u);
        for (place, first) in [(self.layout.shaft, 0), (self.layout.housing, 2)] {
            if let Some(i) = place {
                state[i..i + 2].copy_from_slice(&rings.position[first..first + 2]);
            }
        }
        // At rest against the outer ring: u' = 0.
        let housing = self.housing_state(drive, 0.0, state);
        let cage = super::forces::cos_sin(drive.cage_angle(0.0));
        for j in 0..self.element_count {
            state[w + j] = dot(housing.velocity, self.direction(j, cage));
        }
        if let Some(i) = self.layout.sensor {
            (state[i], state[i + 1]) = (housing.position[1], housing.velocity[1]);
        }
    }
}

/// What all elements share at the start.
struct Start {
    cage_angle: f64,
    cage: (f64, f64),
    omega: f64,
    /// Velocity of the outer ring less that of the inner [m/s].
    drift: [f64; 2],
}

/// What stays while one element's radial balance is looked for.
struct Radial {
    j: usize,
    e_r: [f64; 2],
    e_t: [f64; 2],
    offset: [f64; 2],
    /// Drift of the rings, radial and tangential [m/s].
    drift: [f64; 2],
    /// Radial part of the element's weight [N].
    gravity: f64,
}

/// Contact forces on one element [N]: the inner in x and y, the outer inwards and counter-clockwise.
struct OnElement {
    inner: [f64; 2],
    outer: [f64; 2],
}

/// Positions of both rings during the search.
#[derive(Debug, Clone, Copy)]
struct Rings {
    position: [f64; 4],
    free: [bool; 4],
}

impl Rings {
    fn start(model: &Model, drive: &Drive) -> Self {
        let prescribed = |motion: Motion, value: f64| if motion == Motion::Host { value } else { 0.0 };
        let (shaft, housing) = (model.shaft.motion, model.housing.motion);
        let free = |motion: Motion| motion == Motion::Internal;
        Self {
            position: [
                prescribed(shaft, drive.shaft[0].at(0.0)),
                prescribed(shaft, drive.shaft[1].at(0.0)),
                prescribed(housing, drive.housing[0].at(0.0)),
                prescribed(housing, drive.housing[1].at(0.0)),
            ],
            free: [free(shaft), free(shaft), free(housing), free(housing)],
        }
    }

    fn offset(&self) -> [f64; 2] {
        [self.position[2] - self.position[0], self.position[3] - self.position[1]]
    }

    fn moved(&self, step: [f64; 4], share: f64) -> Self {
        let mut moved = *self;
        for (position, step) in moved.position.iter_mut().zip(step) {
            *position += share * step;
        }
        moved
    }
}

/// Net force on the free rings.
struct Balance {
    force: [f64; 4],
    /// Σ|Q_i| [N]
    contact_sum: f64,
    limit: f64,
}

impl Balance {
    fn residual(&self) -> f64 {
        self.force.iter().fold(0.0, |m, f| m.max(f.abs()))
    }
}

fn dot4(a: [f64; 4], b: [f64; 4]) -> f64 {
    (0..4).map(|i| a[i] * b[i]).sum()
}
