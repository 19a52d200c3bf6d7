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

use super::contact_lanes::{Group, Record};
use super::drive::Drive;
use super::kinematics::{Kinematics, Stage, moved};
use super::model::Model;
use super::raceway::SMOOTH;
use crate::contact::error::ContactError;
use crate::contact::near_defect::OuterApproach;
use crate::numerics::lanes::{Each, Kernel, Lanes, Lists, QUAD, WIDEST, Wide, dispatch, largest_of, places};
use crate::numerics::plane::{Vector, turned};

/// What the right-hand side found on its way. Its lists are made once.
#[derive(Debug, Default)]
pub struct Forces {
    /// Each contact, where the right-hand side was asked to keep them.
    pub contacts: Record,
    /// The elements, with what follows from the raceway that each is on.
    pub(super) groups: Vec<Group>,
    /// Elements that are not on the smooth rigid raceway, with their cells.
    others: Vec<(usize, u32)>,
    /// Their outer contacts.
    other_contacts: Vec<OtherContact>,
    /// Number of elements.
    count: usize,
    /// The bearing's force on the inner ring, then on the outer [N].
    pub rings: [f64; 4],
    /// Number of approaches near the defect that were asked for.
    pub defect_lookups: u64,
    /// The last contact near the defect that could not be computed, of an element whose place is a number.
    pub unsolved: Option<UnsolvedContact>,
}

/// A contact near the defect that could not be computed.
#[derive(Debug, Clone, PartialEq)]
pub struct UnsolvedContact {
    /// The element, from 0.
    pub element: usize,
    /// Its angle from the defect's centre [rad].
    pub angle: f64,
    /// Position of the outer ring's centre seen from the inner's [m].
    pub offset: [f64; 2],
    /// Why.
    pub cause: ContactError,
}

impl Clone for Forces {
    /// With the room that the lists have: a copy allocates no more in a step than the original.
    fn clone(&self) -> Self {
        let mut copy = Self {
            contacts: self.contacts.clone(),
            groups: self.groups.clone(),
            unsolved: self.unsolved.clone(),
            ..Self::new(self.count)
        };
        copy.others.extend_from_slice(&self.others);
        copy.other_contacts.extend_from_slice(&self.other_contacts);
        (copy.rings, copy.defect_lookups) = (self.rings, self.defect_lookups);
        copy
    }
}

impl Forces {
    /// Room for `count` elements.
    pub fn new(count: usize) -> Self {
        let places = places(count);
        Self {
            count,
            contacts: Record::new(places),
            groups: vec![Group::default(); places / WIDEST],
            others: Vec::with_capacity(count),
            other_contacts: Vec::with_capacity(count),
            ..Self::default()
        }
    }

    /// Sorts the elements by the raceway they are on. What follows inside kernels is for these cells.
    fn enter(&mut self, model: &Model, cells: &[u32]) {
        let rigid = model.outer.contact.compliance == 0.0;
        self.others.clear();
        self.groups.copy_from_slice(&model.elements);
        for (j, &cell) in cells.iter().enumerate() {
            if !(rigid && cell == SMOOTH) {
                self.others.push((j, cell));
                self.groups[j / WIDEST].outer[j % WIDEST] = 0.0;
            }
        }
    }

    /// Puts what [`Model::other_contacts`] found among the contacts that are kept.
    fn record_others(&mut self) {
        let record = &mut self.contacts;
        for other in &self.other_contacts {
            let j = other.element;
            record.outer_approach[j] = other.approach;
            record.outer_pushing[j] = other.pushing;
            [record.outer[j], record.outer_radial[j], record.outer_tangential[j]] = other.force;
        }
    }

    /// The bearing's force on the inner ring [N].
    pub fn shaft(&self) -> Vector {
        Vector::new(self.rings[0], self.rings[1])
    }

    /// The bearing's force on the outer ring [N].
    pub fn housing(&self) -> Vector {
        Vector::new(self.rings[2], self.rings[3])
    }

    /// Notes which contacts push: 1 for those that do, −1 for the others, the inner contacts before the outer.
    pub fn note_pushing(&self, sides: &mut [f64]) {
        let lengths = self.contacts.inner_pushing.iter().chain(&*self.contacts.outer_pushing);
        for (side, &length) in sides.iter_mut().zip(lengths) {
            *side = if length > 0.0 { 1.0 } else { -1.0 };
        }
    }

    /// How far the contact that has changed most since `sides` were noted is beyond its change [m]; negative while none has.
    pub fn beyond_change(&self, sides: &[f64]) -> f64 {
        let places = self.contacts.inner_pushing.len();
        let (inner, outer) = sides.split_at(places);
        let mut most = f64::NEG_INFINITY;
        for (sides, lengths) in [(inner, &self.contacts.inner_pushing), (outer, &self.contacts.outer_pushing)] {
            for (side, length) in sides.iter().zip(lengths.iter()).take(self.count) {
                most = most.max(-side * length);
            }
        }
        most
    }

    /// Whether any contact has changed since `sides` were noted, inside a kernel.
    #[inline(always)]
    pub(crate) fn pushing_differs_on<S: Wide>(&self, simd: S, sides: &[f64]) -> bool {
        let places = self.contacts.inner_pushing.len();
        let (inner, outer) = sides.split_at(places);
        let from = [inner, &self.contacts.inner_pushing, outer, &self.contacts.outer_pushing];
        let mut most = [0.0; QUAD];
        Lists { from, to: [] }.for_each(simd, places, &BeyondChange, &mut most);
        largest_of(most) > 0.0
    }

    /// Largest approach of any contact [m], 0 if there is none, inside a kernel.
    #[inline(always)]
    pub(crate) fn largest_approach_on<S: Wide>(&self, simd: S) -> f64 {
        let (mut most, approach) = ([0.0; QUAD], [&self.contacts.inner_approach[..], &self.contacts.outer_approach]);
        Lists { from: approach, to: [] }.for_each(simd, approach[0].len(), &Largest, &mut most);
        largest_of(most)
    }
}

/// An outer contact that is not that of the smooth rigid raceway.
#[derive(Debug, Clone, Copy)]
struct OtherContact {
    element: usize,
    approach: f64,
    pushing: f64,
    /// Magnitude [N], and the parts inwards and counter-clockwise on the element.
    force: [f64; 3],
}

/// An element seen from the inner ring's centre.
#[derive(Debug, Clone, Copy)]
pub(super) struct InnerGap {
    /// δ_i [m]
    pub(super) approach: f64,
    /// n = q/|q|, radial and tangential.
    pub(super) n: Vector,
    /// |q| [m]
    pub(super) distance: f64,
}

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

    /// As [`Self::derivative`] inside a kernel, for the cells that `forces` have last seen there. Each contact is kept only if
    /// `RECORD`, which takes a stage whose positions are not still to be moved on.
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
        // A copy for the call, so that what is known of the instant can stay in registers: what is written to memory in parts
        // and read together soon after is read late.
        let others = if forces.others.is_empty() {
            Vector::zeros()
        } else {
            self.other_contacts::<RECORD>(&{ now }, state, ahead, forces)
        };
        let [shaft_x, shaft_y, housing_x, housing_y] =
            self.smooth_contacts::<S, RECORD>(simd, &now, stage, derivative, (&forces.groups, &mut forces.contacts));
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
        let Forces { others, other_contacts, groups, defect_lookups, unsolved, .. } = forces;
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
            groups[j / WIDEST].other[j % WIDEST] = -f_r * self.inverse_element_mass;
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

    /// Where an element at path `u` in direction `e_r` is seen from the inner ring, whose centre is `offset` before the
    /// outer ring's.
    #[inline]
    pub(super) fn inner_gap(&self, u: f64, offset: Vector, e_r: Vector) -> InnerGap {
        // |q| = √((ρ+p)² + t²), written so that δ_i loses no digits to the radii's 20 mm.
        let (p, t) = (offset.dot(&e_r), offset.dot(&turned(e_r)));
        let q_r = self.outer_centre_radius + u + p;
        let distance = (q_r * q_r + t * t).sqrt();
        let approach = -self.radial_clearance - u - p - t * t / (distance + q_r);
        InnerGap { approach, n: Vector::new(q_r / distance, t / distance), distance }
    }

    /// Approach of element `j` to the outer raceway in a cell of the defect; `None` on the smooth raceway.
    ///
    /// Inlined, so that what its caller does not use is not worked out.
    #[inline(always)]
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
        let defect = self.outer.defect.as_ref()?;
        Some(defect.surface.approach(cell as usize, u, defect.angle(cage_angle + self.element_offset(j)), rho))
    }

    /// As [`Self::near_defect`], the smooth raceway included.
    pub(super) fn outer_approach(&self, j: usize, cell: u32, u: f64, cage_angle: f64, rho: f64) -> OuterApproach {
        match self.near_defect(j, cell, u, cage_angle, rho) {
            None => OuterApproach::smooth(u),
            Some(near) => near.unwrap_or_else(|_| OuterApproach::unsolved()),
        }
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

/// How far the contact that has changed most is beyond its change.
struct BeyondChange;

impl Each<4, 0> for BeyondChange {
    type Sum = [f64; QUAD];

    #[inline(always)]
    fn places<S: Wide>(&self, _: S, from: [Lanes<S>; 4], most: &mut [f64; QUAD]) -> [Lanes<S>; 0] {
        let [inner_side, inner, outer_side, outer] = from;
        (-(inner_side * inner)).at_least(-(outer_side * outer)).largest_to(most);
        []
    }
}

/// The largest approach.
struct Largest;

impl Each<2, 0> for Largest {
    type Sum = [f64; QUAD];

    #[inline(always)]
    fn places<S: Wide>(&self, _: S, approach: [Lanes<S>; 2], most: &mut [f64; QUAD]) -> [Lanes<S>; 0] {
        approach[0].at_least(approach[1]).largest_to(most);
        []
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
