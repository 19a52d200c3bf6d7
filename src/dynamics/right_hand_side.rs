//! The right-hand side of the equations of motion.
//!
//! With e_r, e_t the radial and tangential directions of an element, q from the inner ring's centre to the element's,
//! n = q/|q|, v_o, v_i the rings' velocities and ω the cage speed:
//! ```text
//! u'  = w − e_r·v_o
//! w'  = (Q_i n·e_r − F_r)/m + g·e_r + ω (v_o·e_t + ρ ω)
//! δ_i = R_i + r − |q|,   δ̇_i = −n·(v_o + u' e_r + ρ ω e_t − v_i)
//! m_i x_i'' = F_i − Σ Q_i n − c_s v_i − k_s x_i
//! m_o x_o'' = F_o + Σ (F_r e_r − F_t e_t) − c_p v_o − k_p x_o + Σ f_s e_s,   m_s s'' = −f_s
//! ```
//! F_r and F_t are what the outer raceway exerts on the element, inwards and counter-clockwise; on the smooth raceway
//! F_r = Q(u, u') and F_t = 0. Near a defect of the inner raceway, or of the element on its inner side, Q_i n gives way
//! to Q (R n + T t), with the direction (R, T) of that contact and t = ẑ×n. As w is the element's *absolute* radial
//! velocity, no ring acceleration enters. The cage is kinematic: it takes up every tangential force on the elements.
//! What it takes is the cage torque.

use super::drive::{Drive, Frame, Frames};
use super::element_block::ElementBlock;
use super::element_contacts::{InnerGap, Meeting};
use super::forces::{Forces, Other, OtherContact, UnsolvedContact};
use super::kinematics::{Kinematics, Stage, moved};
use super::model::Model;
use super::raceway::{Cells, Near, SMOOTH};
use crate::contact::error::ContactError;
use crate::contact::near_defect::Approach;
use crate::contact::rolling::RacewaySide;
use crate::numerics::lanes::{Kernel, Lanes, WIDEST, Wide, dispatch};
use crate::numerics::plane::{Vector, turned, turned_by};

impl Model {
    /// Derivative of `state` at `tau`, and each contact; `cells` says in which cell each contact is.
    pub fn derivative(
        &self,
        drive: &Drive,
        tau: f64,
        cells: &Cells,
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
        // Before anything else, so that nothing of it is in the way of even cages.
        if self.is_uneven() {
            return simd.outlined(UnevenDerivative::<RECORD>(Derivative {
                model: self,
                stage: *stage,
                derivative,
                forces,
            }));
        }
        self.derivative_in::<S, RECORD, false>(simd, stage, derivative, forces);
    }

    /// As [`Self::derivative_on`]; if `UNEVEN`, in an uneven cage.
    #[inline(always)]
    fn derivative_in<S: Wide, const RECORD: bool, const UNEVEN: bool>(
        &self,
        simd: S,
        stage: &Stage,
        derivative: &mut [f64],
        forces: &mut Forces,
    ) {
        let Stage { drive, cage, state, ahead } = *stage;
        if UNEVEN {
            self.place_uneven(drive, cage, &mut forces.elements);
        }
        let (now, tau) = (self.kinematics_of(stage), cage.tau);
        let [outer, inner] = [forces.other_outer.is_empty(), forces.other_inner.is_empty()].map(|none| !none);
        let (mut on_shaft, mut on_housing) = (Vector::zeros(), Vector::zeros());
        if outer || inner {
            if self.has_frames {
                forces.frames = drive.frames_at(tau);
            }
            let state = (state, ahead);
            if RECORD {
                forces.torques = [0.0; 3];
            }
            // A copy for each call, so that what is known of the instant can stay in registers: what is written to
            // memory in parts and read together soon after is read late.
            if outer {
                on_housing =
                    simd.outlined(OtherOuter::<RECORD> { model: self, now: &{ now }, state, forces: &mut *forces });
            }
            if inner {
                on_shaft = self.other_inner_contacts::<RECORD>(&{ now }, state, forces);
            }
        }
        let [shaft_x, shaft_y, housing_x, housing_y] = self.smooth_contacts::<S, RECORD, UNEVEN>(
            simd,
            &now,
            stage,
            derivative,
            (&forces.elements, &mut forces.contacts),
        );
        let (shaft_x, shaft_y) = (shaft_x + on_shaft.x, shaft_y + on_shaft.y);
        let (housing_x, housing_y) = (housing_x + on_housing.x, housing_y + on_housing.y);
        if RECORD && (outer || inner) {
            forces.record_others();
        }
        Lanes::of(simd, [shaft_x, shaft_y, housing_x, housing_y]).store(&mut forces.rings, 0);
        let supports = &self.supports;
        if let Some(i) = self.layout.shaft {
            let force = Vector::new(drive.shaft_load[0].at(tau) + shaft_x, drive.shaft_load[1].at(tau) + shaft_y);
            supports.shaft.ring_rates(simd, &now.shaft, force).store(derivative, i);
        }
        let mut reaction = Vector::zeros();
        for (sensor, i) in supports.sensors.iter().zip(self.layout.sensor_places()) {
            let v = state[i + 1];
            let force = sensor.force(moved(state[i], v, ahead), v, &now.housing);
            reaction += sensor.direction * force;
            sensor.rates(simd, v, force).store(derivative, i);
        }
        if let Some(i) = self.layout.housing {
            let load = &drive.housing_load;
            let force =
                Vector::new(load[0].at(tau) + (housing_x + reaction.x), load[1].at(tau) + (housing_y + reaction.y));
            supports.housing.ring_rates(simd, &now.housing, force).store(derivative, i);
        }
    }

    /// The outer contacts that are not those of the smooth rigid raceway; gives their force on the outer ring.
    ///
    /// They come first, so that what they add to an element's acceleration is long written when all elements' are read.
    #[inline(always)]
    fn other_outer_contacts<const RECORD: bool>(
        &self,
        now: &Kinematics,
        state: (&[f64], Option<f64>),
        forces: &mut Forces,
    ) -> Vector {
        let Forces { other_outer, other_contacts: [_, contacts], elements, torques, .. } = forces;
        let (frames, defect_lookups, unsolved) = (&forces.frames, &mut forces.defect_lookups, &mut forces.unsolved);
        if RECORD {
            contacts.clear();
        }
        let mut sum = OuterSum { on_housing: Vector::zeros(), elements, torques, contacts };
        for &Other { element: j, cells } in other_outer.iter() {
            let at @ OnPath { u, path_rate, .. } = self.on_path(j, now, state, sum.elements);
            // Each way to the end with its own numbers: what is one or another is written to memory and read late.
            match cells {
                [SMOOTH, SMOOTH] => sum.add::<RECORD>(self, &at, self.yielding_contact(u, path_rate)),
                [_, SMOOTH] => {
                    *defect_lookups += 1;
                    let [angle, speed] = self.turning(j, now, sum.elements);
                    let (meeting, frame) = (self.outer_meeting_at(angle, j, cells, u), self.outer.defects.frame);
                    let near = self.near_ring_defect(RacewaySide::Outer, &meeting, frames).unwrap_or_else(|cause| {
                        self.without_answer(RacewaySide::Outer, (&meeting, now, frames), cause, unsolved)
                    });
                    let turning = speed - frames.of(frame).speed;
                    let found = self.outer_contact(&near, frame, [path_rate, turning], meeting.distance);
                    sum.add::<RECORD>(self, &at, found);
                }
                _ => {
                    *defect_lookups += 1;
                    let [angle, speed] = self.turning(j, now, sum.elements);
                    let meeting = self.outer_meeting_at(angle, j, cells, u);
                    let found = self.own_outer_contact(&meeting, [path_rate, speed], (now, frames), unsolved);
                    sum.add::<RECORD>(self, &at, found);
                }
            }
        }
        sum.on_housing
    }

    /// Where element `j` is, its path moved on by the time that is still `ahead`.
    #[inline(always)]
    fn on_path(
        &self,
        j: usize,
        now: &Kinematics,
        (state, ahead): (&[f64], Option<f64>),
        elements: &[ElementBlock],
    ) -> OnPath {
        let (block, i, cage) = (&elements[j / WIDEST], j % WIDEST, &now.cage);
        let (sin, cos) = (block.sin[i], block.cos[i]);
        let e_r = turned_by(cage.direction, sin, cos);
        let path_rate = state[self.layout.radial_velocity + j] - now.housing.velocity.dot(&e_r);
        OnPath { element: j, e_r, u: moved(state[j], path_rate, ahead), path_rate }
    }

    /// Angle [rad] of element `j` about the outer ring's centre, and its speed [rad/s].
    #[inline(always)]
    fn turning(&self, j: usize, now: &Kinematics, elements: &[ElementBlock]) -> [f64; 2] {
        let (block, i, cage) = (&elements[j / WIDEST], j % WIDEST, &now.cage);
        [cage.angle + self.element_offset(j) + block.lead[i], cage.speed * block.pace[i]]
    }

    /// The inner contacts near defects; gives their force on the inner ring. After the outer ones, to whose part of an
    /// element's acceleration they add.
    #[inline(never)]
    fn other_inner_contacts<const RECORD: bool>(
        &self,
        now: &Kinematics,
        state: (&[f64], Option<f64>),
        forces: &mut Forces,
    ) -> Vector {
        let mut on_shaft = Vector::zeros();
        let Forces { other_inner, other_outer, other_contacts: [contacts, _], elements, .. } = forces;
        let (torques, lookups, unsolved) = (&mut forces.torques, &mut forces.defect_lookups, &mut forces.unsolved);
        let frames = &forces.frames;
        if RECORD {
            contacts.clear();
        }
        for &Other { element: j, cells } in other_inner.iter() {
            let OnPath { e_r, u, path_rate, .. } = self.on_path(j, now, state, elements);
            let [angle, speed] = self.turning(j, now, elements);
            *lookups += 1;
            let gap = self.inner_gap(u, now.offset(), e_r);
            let at = self.inner_meeting(j, cells, &gap, angle);
            let (near, frame) = self.near_defect(RacewaySide::Inner, &at, frames);
            let near = near
                .unwrap_or_else(|cause| self.without_answer(RacewaySide::Inner, (&at, now, frames), cause, unsolved));
            let near = Near::new(near, frame, frames);
            let around = (self.outer_centre_radius + u) * speed;
            let q_rate = [now.drift().dot(&e_r) + path_rate, now.drift().dot(&turned(e_r)) + around];
            let found = self.inner_contact(&near, &gap, q_rate);
            let [_, f_r, f_t] = found.force;
            let acceleration = &mut elements[j / WIDEST].other[j % WIDEST];
            let of_outer = if other_outer.iter().any(|other| other.element == j) { *acceleration } else { 0.0 };
            *acceleration = of_outer + f_r * self.inverse_element_mass;
            on_shaft -= e_r * f_r + turned(e_r) * f_t;
            if RECORD {
                torques[found.frame as usize] += found.torque;
                contacts.push(OtherContact { element: j, ..found });
            }
        }
        on_shaft
    }

    /// What stands for a contact near a defect that has no answer, which is kept.
    #[cold]
    fn without_answer(
        &self,
        side: RacewaySide,
        (at, now, frames): (&Meeting, &Kinematics, &Frames),
        cause: ContactError,
        unsolved: &mut Option<UnsolvedContact>,
    ) -> Approach {
        // What is no number here has its cause elsewhere.
        if (at.u + now.cage.angle).is_finite() {
            let angle = self.angle_from_defect(side, at, frames);
            *unsolved = Some(UnsolvedContact { element: at.element, angle, offset: now.offset().into(), cause });
        }
        Approach::unsolved()
    }

    /// The outer contact of an element on a smooth raceway that yields.
    #[inline(always)]
    fn yielding_contact(&self, u: f64, path_rate: f64) -> OtherContact {
        let law = &self.outer.contact;
        let (part, part_rate) = law.of_contact(u, path_rate);
        let force = law.law.force(part, part_rate);
        let (force, pushing) = ([force, force, 0.0], law.law.pushing(part, part_rate));
        OtherContact { element: 0, approach: u, pushing, force, torque: 0.0, frame: Frame::Housing }
    }

    /// The outer contact of an element with its own defect.
    #[inline(never)]
    fn own_outer_contact(
        &self,
        at: &Meeting,
        [path_rate, speed]: [f64; 2],
        (now, frames): (&Kinematics, &Frames),
        unsolved: &mut Option<UnsolvedContact>,
    ) -> OtherContact {
        let (near, frame) = self.near_defect(RacewaySide::Outer, at, frames);
        let near =
            near.unwrap_or_else(|cause| self.without_answer(RacewaySide::Outer, (at, now, frames), cause, unsolved));
        let turning = speed - frames.of(frame).speed;
        self.outer_contact(&near, frame, [path_rate, turning], at.distance)
    }

    /// An outer contact at this approach and distance from the ring's centre; the path, and the angle against the body
    /// that bears the defect, change at `rates`.
    #[inline(always)]
    fn outer_contact(&self, near: &Approach, frame: Frame, rates: [f64; 2], distance: f64) -> OtherContact {
        let [path_rate, turning] = rates;
        let compliant = self.outer.contact.compliance != 0.0;
        let rate = near.by_path * path_rate + near.by_angle * turning;
        let (part, part_rate) =
            if compliant { self.outer.contact.of_contact(near.value, rate) } else { (near.value, rate) };
        let outer = self.outer.contact.law.force(part, part_rate);
        let (f_r, f_t) = (outer * near.radial, outer * near.tangential);
        let magnitude = outer * (near.radial * near.radial + near.tangential * near.tangential).sqrt();
        let pushing = self.outer.contact.law.pushing(part, part_rate);
        let force = [magnitude, f_r, f_t];
        OtherContact { element: 0, approach: near.value, pushing, force, torque: -f_t * distance, frame }
    }

    /// An inner contact at this approach, q changing at `q_rate` (radial and tangential as seen from the outer ring).
    fn inner_contact(&self, near: &Near, gap: &InnerGap, q_rate: [f64; 2]) -> OtherContact {
        let Near { approach: near, frame_speed, frame } = near;
        let (n, [radial, tangential]) = (gap.n, q_rate);
        let opening = n.x * radial + n.y * tangential;
        let turning = (n.x * tangential - n.y * radial) / gap.distance;
        let rate = -near.by_path * opening + near.by_angle * (turning - frame_speed);
        let law = &self.inner.contact.law;
        let amount = law.force(near.value, rate);
        let (along, across) = (amount * near.radial, amount * near.tangential);
        let (f_r, f_t) = (along * n.x - across * n.y, along * n.y + across * n.x);
        let magnitude = amount * (near.radial * near.radial + near.tangential * near.tangential).sqrt();
        OtherContact {
            element: 0,
            approach: near.value,
            pushing: law.pushing(near.value, rate),
            force: [magnitude, f_r, f_t],
            torque: -across * gap.distance,
            frame: *frame,
        }
    }

    /// Torque of the elements on the cage about the outer ring's centre [N m], counter-clockwise.
    ///
    /// The kinematic cage forces each element to the tangential acceleration a_o·e_t + 2 u' ω + ρ ω'; what contacts and
    /// gravity do not supply, it does. It also takes up the torque of an element's defect on that element, whose spin
    /// is forced as well. `acceleration` is the outer ring's [m/s²].
    pub fn cage_torque(&self, drive: &Drive, tau: f64, state: &[f64], acceleration: Vector, forces: &Forces) -> f64 {
        self.begin(drive);
        let cage = drive.cage_at(tau);
        let of_paths: f64 = (0..self.element_count)
            .map(|j| {
                let e_t = turned(self.direction(j, &cage));
                let [speed, alpha] = self.element_speed(j, &cage);
                let rho = self.outer_centre_radius + state[j];
                let contacts = &forces.contacts;
                let inertia = acceleration.dot(&e_t) + 2.0 * contacts.path_rate[j] * speed + rho * alpha;
                let contacts = contacts.inner[j] * contacts.normal_tangential[j] + contacts.outer_tangential[j];
                rho * (contacts + self.element_mass * (self.gravity.dot(&e_t) - inertia))
            })
            .sum();
        of_paths + forces.torque_on(Frame::Spin)
    }
}

/// What outer contacts that are not those of the smooth rigid raceway add up to.
struct OuterSum<'a> {
    on_housing: Vector,
    elements: &'a mut [ElementBlock],
    torques: &'a mut [f64; 3],
    contacts: &'a mut Vec<OtherContact>,
}

impl OuterSum<'_> {
    #[inline(always)]
    fn add<const RECORD: bool>(
        &mut self,
        model: &Model,
        &OnPath { element: j, e_r, .. }: &OnPath,
        found: OtherContact,
    ) {
        let [_, f_r, f_t] = found.force;
        self.elements[j / WIDEST].other[j % WIDEST] = -f_r * model.inverse_element_mass;
        self.on_housing += e_r * f_r - turned(e_r) * f_t;
        if RECORD {
            self.torques[found.frame as usize] += found.torque;
            self.contacts.push(OtherContact { element: j, ..found });
        }
    }
}

/// An element on its path.
struct OnPath {
    element: usize,
    e_r: Vector,
    u: f64,
    path_rate: f64,
}

/// The outer contacts that are not those of the smooth rigid raceway, as a function of its own for the machine's
/// instructions: what mixes with wide registers and is made for others waits for them.
struct OtherOuter<'a, const RECORD: bool> {
    model: &'a Model,
    now: &'a Kinematics,
    state: (&'a [f64], Option<f64>),
    forces: &'a mut Forces,
}

impl<const RECORD: bool> Kernel for OtherOuter<'_, RECORD> {
    type Output = Vector;

    #[inline(always)]
    fn run<S: Wide>(self, _: S) -> Vector {
        self.model.other_outer_contacts::<RECORD>(self.now, self.state, self.forces)
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

/// As [`Derivative`], in an uneven cage.
struct UnevenDerivative<'a, const RECORD: bool>(Derivative<'a>);

impl<const RECORD: bool> Kernel for UnevenDerivative<'_, RECORD> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        let Derivative { model, stage, derivative, forces } = self.0;
        model.derivative_in::<S, RECORD, true>(simd, &stage, derivative, forces);
    }
}
