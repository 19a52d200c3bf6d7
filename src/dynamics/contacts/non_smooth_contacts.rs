//! Contacts that are not those of smooth rigid raceways: near defects, and on an outer raceway that yields. One at a
//! time, before the others.

use super::element_contacts::{InnerGap, Meeting};
use super::forces::{Forces, NonSmooth, NonSmoothContact, UnsolvedContact};
use crate::contact::error::ContactError;
use crate::contact::near_defect::Approach;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::parameters::{ElementBlock, Frame, Frames, Kinematics, Model, Near, SMOOTH, moved};
use crate::dynamics::parameters::{FilmsNow, film_force};
use crate::numerics::lanes::{Kernel, WIDEST, Wide};
use crate::numerics::plane::{Vector, turned, turned_by};

impl Model {
    /// The outer contacts that are not those of the smooth rigid raceway; gives their force on the outer ring.
    ///
    /// They come first, so that what they add to an element's acceleration is long written when all elements' are read.
    #[inline(always)]
    fn non_smooth_outer_contacts<const RECORD: bool>(
        &self,
        now: &Kinematics,
        state: &[f64],
        ahead: Option<f64>,
        forces: &mut Forces,
    ) -> Vector {
        let Forces { non_smooth_outer, non_smooth_contacts: [_, contacts], elements, torques, .. } = forces;
        let (frames, films) = (&forces.frames, forces.films.as_ref());
        let (defect_lookups, unsolved) = (&mut forces.defect_lookups, &mut forces.unsolved);
        if RECORD {
            contacts.clear();
        }
        let mut sum = OuterSum { on_housing: Vector::zeros(), elements, torques, contacts };
        for &NonSmooth { element: j, cells } in non_smooth_outer.iter() {
            let at @ OnPath { u, path_rate, .. } = self.on_path(j, now, state, ahead, sum.elements);
            // Each way to the end with its own numbers: what is one or another is written to memory and read late.
            match cells {
                [SMOOTH, SMOOTH] => sum.add::<RECORD>(self, &at, self.yielding_contact(u, path_rate, films)),
                [_, SMOOTH] => {
                    *defect_lookups += 1;
                    let [angle, speed] = self.turning(j, now, sum.elements);
                    let (meeting, frame) = (self.outer_meeting_at(angle, j, cells, u), self.outer.defects.frame);
                    let near = self.near_ring_defect(RacewaySide::Outer, &meeting, frames).unwrap_or_else(|cause| {
                        self.without_answer(RacewaySide::Outer, &meeting, now, frames, cause, unsolved)
                    });
                    let turning = speed - frames.of(frame).speed;
                    let found = self.outer_contact(&near, frame, [path_rate, turning], meeting.distance, films);
                    sum.add::<RECORD>(self, &at, found);
                }
                _ => {
                    *defect_lookups += 1;
                    let [angle, speed] = self.turning(j, now, sum.elements);
                    let meeting = self.outer_meeting_at(angle, j, cells, u);
                    let found = self.own_outer_contact(&meeting, [path_rate, speed], now, (frames, films), unsolved);
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
        state: &[f64],
        ahead: Option<f64>,
        elements: &[ElementBlock],
    ) -> OnPath {
        let (block, i, cage) = (&elements[j / WIDEST], j % WIDEST, &now.cage);
        let (sin, cos) = (block.sin[i], block.cos[i]);
        let e_r = turned_by(cage.direction, sin, cos);
        let path_rate = state[self.layout.radial_velocity + j] - now.housing.velocity.dot(&e_r);
        OnPath { element: j, e_r, u: moved(state[j], path_rate, ahead), path_rate }
    }

    /// Angle (rad) of element `j` about the outer ring's centre, and its speed (rad/s).
    #[inline(always)]
    fn turning(&self, j: usize, now: &Kinematics, elements: &[ElementBlock]) -> [f64; 2] {
        let (block, i, cage) = (&elements[j / WIDEST], j % WIDEST, &now.cage);
        [cage.angle + self.element_offset(j) + block.lead[i], cage.speed * block.pace[i]]
    }

    /// The inner contacts near defects; gives their force on the inner ring. After the outer ones, to whose part of an
    /// element's acceleration they add.
    #[inline(never)]
    pub(in crate::dynamics) fn non_smooth_inner_contacts<const RECORD: bool>(
        &self,
        now: &Kinematics,
        state: &[f64],
        ahead: Option<f64>,
        forces: &mut Forces,
    ) -> Vector {
        let mut on_shaft = Vector::zeros();
        let Forces { non_smooth_inner, non_smooth_outer, non_smooth_contacts: [contacts, _], elements, .. } = forces;
        let (torques, lookups, unsolved) = (&mut forces.torques, &mut forces.defect_lookups, &mut forces.unsolved);
        let (frames, films) = (&forces.frames, forces.films.as_ref());
        let clearance = self.clearance(films);
        if RECORD {
            contacts.clear();
        }
        for &NonSmooth { element: j, cells } in non_smooth_inner.iter() {
            let OnPath { e_r, u, path_rate, .. } = self.on_path(j, now, state, ahead, elements);
            let [angle, speed] = self.turning(j, now, elements);
            *lookups += 1;
            let gap = self.inner_gap(u, now.offset(), e_r, clearance);
            let at = self.inner_meeting(j, cells, &gap, angle);
            let (near, frame) = self.near_defect(RacewaySide::Inner, &at, frames);
            let near =
                near.unwrap_or_else(|cause| self.without_answer(RacewaySide::Inner, &at, now, frames, cause, unsolved));
            let near = Near::new(near, frame, frames);
            let around = (self.outer_centre_radius + u) * speed;
            let q_rate = [now.drift().dot(&e_r) + path_rate, now.drift().dot(&turned(e_r)) + around];
            let found = self.inner_contact(&near, &gap, q_rate, films);
            let [_, f_r, f_t] = found.force;
            let acceleration = &mut elements[j / WIDEST].other[j % WIDEST];
            let of_outer = if non_smooth_outer.iter().any(|other| other.element == j) { *acceleration } else { 0.0 };
            *acceleration = of_outer + f_r * self.inverse_element_mass;
            on_shaft -= e_r * f_r + turned(e_r) * f_t;
            if RECORD {
                torques[found.frame as usize] += found.torque;
                contacts.push(NonSmoothContact { element: j, ..found });
            }
        }
        on_shaft
    }

    /// What stands for a contact near a defect that has no answer, which is kept.
    #[cold]
    fn without_answer(
        &self,
        side: RacewaySide,
        at: &Meeting,
        now: &Kinematics,
        frames: &Frames,
        cause: ContactError,
        unsolved: &mut Option<UnsolvedContact>,
    ) -> Approach {
        // NaN here has its cause elsewhere.
        if (at.u + now.cage.angle).is_finite() {
            let angle = self.angle_from_defect(side, at, frames);
            *unsolved = Some(UnsolvedContact { element: at.element, angle, offset: now.offset().into(), cause });
        }
        Approach::unsolved()
    }

    /// The outer contact of an element on a smooth raceway that yields.
    #[inline(always)]
    fn yielding_contact(&self, u: f64, path_rate: f64, films: Option<&FilmsNow>) -> NonSmoothContact {
        let law = &self.outer.contact;
        let (part, part_rate) = law.of_contact(u, path_rate);
        let force = law.law.force(part, part_rate) + film_force(films, RacewaySide::Outer, u, path_rate);
        let (force, pushing) = ([force, force, 0.0], law.law.pushing(part, part_rate));
        NonSmoothContact { element: 0, approach: u, pushing, force, torque: 0.0, frame: Frame::Housing }
    }

    /// The outer contact of an element with its own defect.
    #[inline(never)]
    fn own_outer_contact(
        &self,
        at: &Meeting,
        [path_rate, speed]: [f64; 2],
        now: &Kinematics,
        (frames, films): (&Frames, Option<&FilmsNow>),
        unsolved: &mut Option<UnsolvedContact>,
    ) -> NonSmoothContact {
        let (near, frame) = self.near_defect(RacewaySide::Outer, at, frames);
        let near =
            near.unwrap_or_else(|cause| self.without_answer(RacewaySide::Outer, at, now, frames, cause, unsolved));
        let turning = speed - frames.of(frame).speed;
        self.outer_contact(&near, frame, [path_rate, turning], at.distance, films)
    }

    /// An outer contact at this approach and distance from the ring's centre; the path, and the angle against the body
    /// that bears the defect, change at `rates`.
    #[inline(always)]
    fn outer_contact(
        &self,
        near: &Approach,
        frame: Frame,
        rates: [f64; 2],
        distance: f64,
        films: Option<&FilmsNow>,
    ) -> NonSmoothContact {
        let [path_rate, turning] = rates;
        let compliant = self.outer.contact.compliance != 0.0;
        let rate = near.by_path * path_rate + near.by_angle * turning;
        let (part, part_rate) =
            if compliant { self.outer.contact.of_contact(near.value, rate) } else { (near.value, rate) };
        let film = film_force(films, RacewaySide::Outer, near.value, rate);
        let outer = self.outer.contact.law.force(part, part_rate) + film;
        let (f_r, f_t) = (outer * near.radial, outer * near.tangential);
        let magnitude = outer * (near.radial * near.radial + near.tangential * near.tangential).sqrt();
        let pushing = self.outer.contact.law.pushing(part, part_rate);
        let force = [magnitude, f_r, f_t];
        NonSmoothContact { element: 0, approach: near.value, pushing, force, torque: -f_t * distance, frame }
    }

    /// An inner contact at this approach, q changing at `q_rate` (radial and tangential as seen from the outer ring).
    fn inner_contact(
        &self,
        near: &Near,
        gap: &InnerGap,
        q_rate: [f64; 2],
        films: Option<&FilmsNow>,
    ) -> NonSmoothContact {
        let Near { approach: near, frame_speed, frame } = near;
        let (n, [radial, tangential]) = (gap.n, q_rate);
        let opening = n.x * radial + n.y * tangential;
        let turning = (n.x * tangential - n.y * radial) / gap.distance;
        let rate = -near.by_path * opening + near.by_angle * (turning - frame_speed);
        let law = &self.inner.contact.law;
        let amount = law.force(near.value, rate) + film_force(films, RacewaySide::Inner, near.value, rate);
        let (along, across) = (amount * near.radial, amount * near.tangential);
        let (f_r, f_t) = (along * n.x - across * n.y, along * n.y + across * n.x);
        let magnitude = amount * (near.radial * near.radial + near.tangential * near.tangential).sqrt();
        NonSmoothContact {
            element: 0,
            approach: near.value,
            pushing: law.pushing(near.value, rate),
            force: [magnitude, f_r, f_t],
            torque: -across * gap.distance,
            frame: *frame,
        }
    }
}

/// What outer contacts that are not those of the smooth rigid raceway add up to.
struct OuterSum<'a> {
    on_housing: Vector,
    elements: &'a mut [ElementBlock],
    torques: &'a mut [f64; 3],
    contacts: &'a mut Vec<NonSmoothContact>,
}

impl OuterSum<'_> {
    #[inline(always)]
    fn add<const RECORD: bool>(
        &mut self,
        model: &Model,
        &OnPath { element: j, e_r, .. }: &OnPath,
        found: NonSmoothContact,
    ) {
        let [_, f_r, f_t] = found.force;
        self.elements[j / WIDEST].other[j % WIDEST] = -f_r * model.inverse_element_mass;
        self.on_housing += e_r * f_r - turned(e_r) * f_t;
        if RECORD {
            self.torques[found.frame as usize] += found.torque;
            self.contacts.push(NonSmoothContact { element: j, ..found });
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
pub(in crate::dynamics) struct NonSmoothOuter<'a, const RECORD: bool> {
    pub(in crate::dynamics) model: &'a Model,
    pub(in crate::dynamics) now: &'a Kinematics,
    pub(in crate::dynamics) state: &'a [f64],
    /// Time (s) by which paths are still to be moved on along their rates.
    pub(in crate::dynamics) ahead: Option<f64>,
    pub(in crate::dynamics) forces: &'a mut Forces,
}

impl<const RECORD: bool> Kernel for NonSmoothOuter<'_, RECORD> {
    type Output = Vector;

    #[inline(always)]
    fn run<S: Wide>(self, _: S) -> Vector {
        self.model.non_smooth_outer_contacts::<RECORD>(self.now, self.state, self.ahead, self.forces)
    }
}
