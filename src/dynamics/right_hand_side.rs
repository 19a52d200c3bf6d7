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

use super::drive::Drive;
use super::forces::{Forces, OtherContact, UnsolvedContact};
use super::kinematics::{Kinematics, Stage, moved};
use super::model::Model;
use crate::contact::near_defect::OuterApproach;
use crate::numerics::lanes::{Kernel, Lanes, WIDEST, Wide, dispatch};
use crate::numerics::plane::{Vector, turned};

impl Model {
    /// Derivative of `state` at `tau`, and each contact; `cells` says in which cell of the defect each element is.
    pub fn derivative(
        &self,
        drive: &Drive,
        tau: f64,
        cells: &[u32],
        state: &[f64],
        derivative: &mut [f64],
        forces: &mut Forces,
    ) {
        forces.enter(self, cells);
        let stage = Stage { drive, cage: &drive.cage_at(tau), state, ahead: None };
        dispatch(Derivative { model: self, stage, derivative, forces });
    }

    /// As [`Self::derivative`] inside a kernel, for the cells that `forces` have last seen there. Each contact is kept
    /// only if `RECORD`, which takes a stage whose positions are not still to be moved on.
    #[inline(always)]
    pub(crate) fn derivative_on<S: Wide, const RECORD: bool>(
        &self,
        simd: S,
        stage: &Stage,
        derivative: &mut [f64],
        forces: &mut Forces,
    ) {
        let Stage { drive, cage, state, ahead } = *stage;
        let (now, tau) = (self.kinematics_of(stage), cage.tau);
        // A copy for the call, so that what is known of the instant can stay in registers: what is written to memory in
        // parts and read together soon after is read late.
        let others = if forces.others.is_empty() {
            Vector::zeros()
        } else {
            self.other_contacts::<RECORD>(&{ now }, state, ahead, forces)
        };
        let [shaft_x, shaft_y, housing_x, housing_y] =
            self.smooth_contacts::<S, RECORD>(simd, &now, stage, derivative, (&forces.elements, &mut forces.contacts));
        let (housing_x, housing_y) = (housing_x + others.x, housing_y + others.y);
        if RECORD && !forces.others.is_empty() {
            forces.record_others();
        }
        Lanes::of(simd, [shaft_x, shaft_y, housing_x, housing_y]).store(&mut forces.rings, 0);
        let supports = &self.supports;
        if let Some(i) = self.layout.shaft {
            let force = Vector::new(drive.shaft_load[0].at(tau) + shaft_x, drive.shaft_load[1].at(tau) + shaft_y);
            supports.shaft.ring_rates(simd, &now.shaft, force).store(derivative, i);
        }
        let mut reaction = 0.0;
        if let Some(i) = self.layout.sensor {
            let v = state[i + 1];
            reaction = supports.sensor_force(moved(state[i], v, ahead), v, &now.housing);
            supports.sensor_rates(simd, v, reaction).store(derivative, i);
        }
        if let Some(i) = self.layout.housing {
            let load = &drive.housing_load;
            let force = Vector::new(load[0].at(tau) + housing_x, load[1].at(tau) + (housing_y + reaction));
            supports.housing.ring_rates(simd, &now.housing, force).store(derivative, i);
        }
    }

    /// The outer contacts that are not those of the smooth rigid raceway; gives their force on the outer ring.
    ///
    /// They come first, so that what they add to an element's acceleration is long written when all elements' are read.
    #[inline(never)]
    fn other_contacts<const RECORD: bool>(
        &self,
        now: &Kinematics,
        state: &[f64],
        ahead: Option<f64>,
        forces: &mut Forces,
    ) -> Vector {
        let (compliant, start) = (self.outer.contact.compliance != 0.0, self.layout.radial_velocity);
        let mut on_housing = Vector::zeros();
        let Forces { others, other_contacts, elements, defect_lookups, unsolved, .. } = forces;
        other_contacts.clear();
        for &(j, cell) in others.iter() {
            let e_r = self.direction(j, now.cage.direction);
            let path_rate = state[start + j] - now.housing.velocity.dot(&e_r);
            let u = moved(state[j], path_rate, ahead);
            let near = self.near_defect(j, cell, u, now.cage.angle, self.outer_centre_radius + u);
            *defect_lookups += u64::from(near.is_some());
            let near = near.unwrap_or_else(|| Ok(OuterApproach::smooth(u))).unwrap_or_else(|cause| {
                // What is no number here has its cause elsewhere.
                if (u + now.cage.angle).is_finite() {
                    let angle = self.angle_from_defect(j, now.cage.angle);
                    *unsolved = Some(UnsolvedContact { element: j, angle, offset: now.offset().into(), cause });
                }
                OuterApproach::unsolved()
            });
            let rate = near.by_path * path_rate + near.by_angle * now.cage.speed;
            let (part, part_rate) =
                if compliant { self.outer.contact.of_contact(near.value, rate) } else { (near.value, rate) };
            let outer = self.outer.contact.law.force(part, part_rate);
            let (f_r, f_t) = (outer * near.radial, outer * near.tangential);
            elements[j / WIDEST].other[j % WIDEST] = -f_r * self.inverse_element_mass;
            on_housing += e_r * f_r - turned(e_r) * f_t;
            if !RECORD {
                continue;
            }
            let magnitude = outer * (near.radial * near.radial + near.tangential * near.tangential).sqrt();
            other_contacts.push(OtherContact {
                element: j,
                approach: near.value,
                pushing: self.outer.contact.law.pushing(part, part_rate),
                force: [magnitude, f_r, f_t],
            });
        }
        on_housing
    }

    /// Torque of the elements on the cage about the outer ring's centre [N m], counter-clockwise.
    ///
    /// The kinematic cage forces each element to the tangential acceleration a_o·e_t + 2 u' ω + ρ ω'; what contacts and
    /// gravity do not supply, it does. `acceleration` is the outer ring's [m/s²].
    pub fn cage_torque(&self, drive: &Drive, tau: f64, state: &[f64], acceleration: Vector, forces: &Forces) -> f64 {
        let cage = drive.cage_at(tau);
        (0..self.element_count)
            .map(|j| {
                let e_t = turned(self.direction(j, cage.direction));
                let rho = self.outer_centre_radius + state[j];
                let contacts = &forces.contacts;
                let inertia =
                    acceleration.dot(&e_t) + 2.0 * contacts.path_rate[j] * cage.speed + rho * cage.acceleration;
                let contacts = contacts.inner[j] * contacts.normal_tangential[j] + contacts.outer_tangential[j];
                rho * (contacts + self.element_mass * (self.gravity.dot(&e_t) - inertia))
            })
            .sum()
    }
}

/// The whole right-hand side.
struct Derivative<'a> {
    model: &'a Model,
    stage: Stage<'a>,
    derivative: &'a mut [f64],
    forces: &'a mut Forces,
}

impl Kernel for Derivative<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        let Self { model, stage, derivative, forces } = self;
        model.derivative_on::<S, true>(simd, &stage, derivative, forces);
    }
}
