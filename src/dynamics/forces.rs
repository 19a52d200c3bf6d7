//! The right-hand side of the equations of motion.
//!
//! With e_r, e_t the radial and tangential directions of an element, q from the inner ring's centre to the element's,
//! n = q/|q|, v_o, v_i the rings' velocities and ω the cage speed:
//! ```text
//! u'  = w − e_r·v_o
//! w'  = (Q_i n·e_r − F_r)/m + g·e_r + ω (v_o·e_t + ρ ω)
//! δ_i = R_i + r − |q|,   δ̇_i = −n·(v_o + u' e_r + ρ ω e_t − v_i)
//! m_i x_i'' = F_i − Σ Q_i n − c_s v_i − k_s x_i
//! m_o x_o'' = F_o + Σ (F_r e_r − F_t e_t) − c_p v_o − k_p x_o + f_s,   m_s y_s'' = −f_s
//! ```
//! F_r and F_t are what the outer raceway exerts on the element, inwards and counter-clockwise; on the smooth raceway
//! F_r = Q(u, u') and F_t = 0. As w is the element's *absolute* radial velocity, no ring acceleration enters.
//! The cage is kinematic: it takes up every tangential force on the elements. What it takes is the cage torque.

use super::drive::{Drive, Quadratic};
use super::model::Model;
use crate::contact::error::ContactError;
use crate::contact::near_defect::OuterApproach;
use crate::numerics::{sin_cos, wrap};
use crate::scene::Motion;

/// Cell of an element on the smooth raceway, away from the defect.
pub const SMOOTH: u32 = u32::MAX;

/// What the right-hand side found on its way. Its vectors are made once.
#[derive(Debug, Clone, Default)]
pub struct Forces {
    /// Force of the inner contact Q_i of each element [N].
    pub inner: Vec<f64>,
    /// Direction of q, radial and tangential, of each element.
    pub normal: Vec<[f64; 2]>,
    /// Force of the outer contact of each element [N].
    pub outer: Vec<f64>,
    /// Outer contact force on each element, inwards [N].
    pub outer_radial: Vec<f64>,
    /// Outer contact force on each element, counter-clockwise [N].
    pub outer_tangential: Vec<f64>,
    /// Approach of the inner contact [m]: negative when there is a gap.
    pub inner_approach: Vec<f64>,
    /// Equivalent approach of the outer contact [m].
    pub outer_approach: Vec<f64>,
    /// How clearly the inner contact pushes ([`crate::contact::force_law::ForceLaw::pushing`]) [m].
    pub inner_pushing: Vec<f64>,
    /// How clearly the outer contact pushes [m].
    pub outer_pushing: Vec<f64>,
    /// u' of each element [m/s].
    pub path_rate: Vec<f64>,
    /// The bearing's force on the inner ring [N].
    pub shaft: [f64; 2],
    /// The bearing's force on the outer ring [N].
    pub housing: [f64; 2],
    /// Number of approaches near the defect that were asked for.
    pub defect_lookups: u64,
    /// Why the last contact near the defect that could not be computed could not.
    pub unsolved: Option<ContactError>,
}

impl Forces {
    /// Room for `count` elements.
    pub fn new(count: usize) -> Self {
        let zeros = || vec![0.0; count];
        Self {
            inner: zeros(),
            normal: vec![[0.0; 2]; count],
            outer: zeros(),
            outer_radial: zeros(),
            outer_tangential: zeros(),
            inner_approach: zeros(),
            outer_approach: zeros(),
            inner_pushing: zeros(),
            outer_pushing: zeros(),
            path_rate: zeros(),
            ..Self::default()
        }
    }

    /// Largest approach of any contact [m], 0 if there is none.
    pub fn largest_approach(&self) -> f64 {
        self.inner_approach.iter().chain(&self.outer_approach).copied().fold(0.0, f64::max)
    }
}

/// An element seen from the inner ring's centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct InnerGap {
    /// δ_i [m]
    pub(super) approach: f64,
    /// n = q/|q|, radial and tangential.
    pub(super) n: [f64; 2],
    /// |q| [m]
    pub(super) distance: f64,
}

/// Position and velocity of a ring.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RingState {
    /// Position [m].
    pub position: [f64; 2],
    /// Velocity [m/s].
    pub velocity: [f64; 2],
}

impl Model {
    /// Position and velocity of the inner ring, wherever they come from.
    #[inline]
    pub fn shaft_state(&self, drive: &Drive, tau: f64, state: &[f64]) -> RingState {
        ring_state(self.layout.shaft, self.shaft.motion, &drive.shaft, tau, state)
    }

    /// Position and velocity of the outer ring, wherever they come from.
    #[inline]
    pub fn housing_state(&self, drive: &Drive, tau: f64, state: &[f64]) -> RingState {
        ring_state(self.layout.housing, self.housing.motion, &drive.housing, tau, state)
    }

    /// Angle [rad] of element `j` from the defect's centre, within half a turn, for a cage angle.
    #[inline]
    pub fn angle_from_defect(&self, j: usize, cage_angle: f64, defect_angle: f64) -> f64 {
        wrap(cage_angle + self.element_offset(j) - defect_angle)
    }

    /// Derivative of `state` at `tau`; `cells` says in which cell of the defect each element is.
    pub fn derivative(
        &self,
        drive: &Drive,
        tau: f64,
        cells: &[u32],
        state: &[f64],
        derivative: &mut [f64],
        forces: &mut Forces,
    ) {
        let z = self.element_count;
        let shaft = self.shaft_state(drive, tau, state);
        let housing = self.housing_state(drive, tau, state);
        // Two copies of the loop, so that a rigid assembly does not even pay for the question.
        if self.outer.compliance == 0.0 {
            self.contact_forces::<false>(drive, tau, cells, state, (&shaft, &housing), forces);
        } else {
            self.contact_forces::<true>(drive, tau, cells, state, (&shaft, &housing), forces);
        }

        let cage_angle = drive.cage_angle(tau);
        let omega = drive.cage.rate_at(tau);
        let cage = cos_sin(cage_angle);
        let per_mass = 1.0 / self.element_mass;
        for j in 0..z {
            let e_r = self.direction(j, cage);
            let rho = self.outer_centre_radius + state[j];
            let along = housing.velocity[1] * e_r[0] - housing.velocity[0] * e_r[1];
            derivative[j] = forces.path_rate[j];
            derivative[z + j] = (forces.inner[j] * forces.normal[j][0] - forces.outer_radial[j]) * per_mass
                + dot(self.gravity, e_r)
                + omega * (along + rho * omega);
        }

        if let Some(i) = self.layout.shaft {
            let per_mass = 1.0 / self.shaft.mass;
            for axis in 0..2 {
                let (x, v) = (shaft.position[axis], shaft.velocity[axis]);
                derivative[i + axis] = v;
                derivative[i + 2 + axis] = per_mass
                    * (drive.shaft_load[axis].at(tau) + forces.shaft[axis]
                        - self.shaft.damping * v
                        - self.shaft.stiffness * x);
            }
        }
        let reaction = self.sensor_derivative(&housing, state, derivative);
        if let Some(i) = self.layout.housing {
            let per_mass = 1.0 / self.housing.mass;
            for axis in 0..2 {
                let (x, v) = (housing.position[axis], housing.velocity[axis]);
                let sensor = if axis == 1 { reaction } else { 0.0 };
                derivative[i + axis] = v;
                derivative[i + 2 + axis] = per_mass
                    * (drive.housing_load[axis].at(tau) + forces.housing[axis] + sensor
                        - self.housing.damping * v
                        - self.housing.stiffness * x);
            }
        }
    }

    /// The sensor's own derivative, and its force on the housing along y [N].
    fn sensor_derivative(&self, housing: &RingState, state: &[f64], derivative: &mut [f64]) -> f64 {
        let (Some(sensor), Some(i)) = (&self.sensor, self.layout.sensor) else { return 0.0 };
        let (y, v) = (state[i], state[i + 1]);
        let force = sensor.stiffness * (y - housing.position[1]) + sensor.damping * (v - housing.velocity[1]);
        derivative[i] = v;
        derivative[i + 1] = -force / sensor.mass;
        force
    }

    /// Forces in all contacts; `COMPLIANT` says whether the outer raceway yields.
    fn contact_forces<const COMPLIANT: bool>(
        &self,
        drive: &Drive,
        tau: f64,
        cells: &[u32],
        state: &[f64],
        rings: (&RingState, &RingState),
        forces: &mut Forces,
    ) {
        let z = self.element_count;
        let (shaft, housing) = rings;
        let cage_angle = drive.cage_angle(tau);
        let omega = drive.cage.rate_at(tau);
        let cage = cos_sin(cage_angle);
        // From the inner to the outer ring's centre.
        let offset = [0, 1].map(|a| housing.position[a] - shaft.position[a]);
        let drift = [0, 1].map(|a| housing.velocity[a] - shaft.velocity[a]);
        (forces.shaft, forces.housing) = ([0.0; 2], [0.0; 2]);
        for j in 0..z {
            let e_r = self.direction(j, cage);
            let e_t = [-e_r[1], e_r[0]];
            let (u, w) = (state[j], state[z + j]);
            let rho = self.outer_centre_radius + u;
            let path_rate = w - dot(housing.velocity, e_r);
            forces.path_rate[j] = path_rate;

            let InnerGap { approach: delta, n, .. } = self.inner_gap(u, offset, e_r);
            let rate = -(n[0] * (dot(drift, e_r) + path_rate) + n[1] * (dot(drift, e_t) + rho * omega));
            let inner = self.inner.force(delta, rate);
            forces.inner_approach[j] = delta;
            forces.inner_pushing[j] = self.inner.pushing(delta, rate);
            forces.inner[j] = inner;
            forces.normal[j] = n;

            let mut outer_rate = path_rate;
            let (mut approach, mut radial, mut tangential) = (u, 1.0, 0.0);
            let mut magnitude = 1.0;
            if let Some(near) = self.near_defect(j, cells[j], u, cage_angle, rho) {
                let near = near.unwrap_or_else(|error| {
                    forces.unsolved = Some(error);
                    OuterApproach::unsolved()
                });
                outer_rate = near.by_path * path_rate + near.by_angle * omega;
                (approach, radial, tangential) = (near.value, near.radial, near.tangential);
                magnitude = (radial * radial + tangential * tangential).sqrt();
                forces.defect_lookups += 1;
            }
            let (part, part_rate) =
                if COMPLIANT { self.outer.of_contact(approach, outer_rate) } else { (approach, outer_rate) };
            let outer = self.outer.contact.force(part, part_rate);
            let (f_r, f_t) = (outer * radial, outer * tangential);
            forces.outer_approach[j] = approach;
            forces.outer_pushing[j] = self.outer.contact.pushing(part, part_rate);
            forces.outer[j] = outer * magnitude;
            forces.outer_radial[j] = f_r;
            forces.outer_tangential[j] = f_t;

            for axis in 0..2 {
                forces.shaft[axis] -= inner * (n[0] * e_r[axis] + n[1] * e_t[axis]);
                forces.housing[axis] += f_r * e_r[axis] - f_t * e_t[axis];
            }
        }
    }

    /// Where an element at path `u` in direction `e_r` is seen from the inner ring, whose centre is `offset` before the
    /// outer ring's.
    #[inline]
    pub(super) fn inner_gap(&self, u: f64, offset: [f64; 2], e_r: [f64; 2]) -> InnerGap {
        // |q| = √((ρ+p)² + t²), written so that δ_i loses no digits to the radii's 20 mm.
        let (p, t) = (dot(offset, e_r), e_r[0] * offset[1] - e_r[1] * offset[0]);
        let q_r = self.outer_centre_radius + u + p;
        let distance = (q_r * q_r + t * t).sqrt();
        let approach = -self.radial_clearance - u - p - t * t / (distance + q_r);
        InnerGap { approach, n: [q_r / distance, t / distance], distance }
    }

    /// Approach of element `j` to the outer raceway in a cell of the defect; `None` on the smooth raceway.
    #[inline]
    pub(super) fn near_defect(
        &self,
        j: usize,
        cell: u32,
        u: f64,
        cage_angle: f64,
        rho: f64,
    ) -> Option<Result<OuterApproach, ContactError>> {
        if cell == SMOOTH {
            return None;
        }
        let (near, centre) = self.defect.as_ref()?;
        Some(near.approach(cell as usize, u, self.angle_from_defect(j, cage_angle, *centre), rho))
    }

    /// As [`Self::near_defect`], the smooth raceway included.
    pub(super) fn outer_approach(&self, j: usize, cell: u32, u: f64, cage_angle: f64, rho: f64) -> OuterApproach {
        match self.near_defect(j, cell, u, cage_angle, rho) {
            None => OuterApproach::smooth(u),
            Some(near) => near.unwrap_or_else(|_| OuterApproach::unsolved()),
        }
    }

    /// Cell of the defect in which element `j` is at a cage angle [rad].
    pub fn cell_at(&self, j: usize, cage_angle: f64) -> u32 {
        let Some((near, centre)) = &self.defect else { return SMOOTH };
        let knots = near.knots();
        let angle = self.angle_from_defect(j, cage_angle, *centre);
        match knots.partition_point(|&k| k <= angle) {
            0 => SMOOTH,
            above if above == knots.len() => SMOOTH,
            above => (above - 1) as u32,
        }
    }

    /// Torque of the elements on the cage about the outer ring's centre [N m], counter-clockwise.
    ///
    /// The kinematic cage forces each element to the tangential acceleration a_o·e_t + 2 u' ω + ρ ω'; what contacts and
    /// gravity do not supply, it does. `acceleration` is the outer ring's [m/s²].
    pub fn cage_torque(&self, drive: &Drive, tau: f64, state: &[f64], acceleration: [f64; 2], forces: &Forces) -> f64 {
        let (omega, alpha) = (drive.cage.rate_at(tau), drive.cage.0[2]);
        let cage = cos_sin(drive.cage_angle(tau));
        (0..self.element_count)
            .map(|j| {
                let e_r = self.direction(j, cage);
                let e_t = [-e_r[1], e_r[0]];
                let rho = self.outer_centre_radius + state[j];
                let inertia = dot(acceleration, e_t) + 2.0 * forces.path_rate[j] * omega + rho * alpha;
                let contacts = forces.inner[j] * forces.normal[j][1] + forces.outer_tangential[j];
                rho * (contacts + self.element_mass * (dot(self.gravity, e_t) - inertia))
            })
            .sum()
    }
}

fn ring_state(place: Option<usize>, motion: Motion, prescribed: &[Quadratic; 2], tau: f64, state: &[f64]) -> RingState {
    match (place, motion) {
        (Some(i), _) => RingState { position: [state[i], state[i + 1]], velocity: [state[i + 2], state[i + 3]] },
        (None, Motion::Host) => RingState {
            position: [prescribed[0].at(tau), prescribed[1].at(tau)],
            velocity: [prescribed[0].rate_at(tau), prescribed[1].rate_at(tau)],
        },
        _ => RingState::default(),
    }
}

#[inline]
pub(super) fn cos_sin(angle: f64) -> (f64, f64) {
    let (sin, cos) = sin_cos(angle);
    (cos, sin)
}

#[inline]
pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
