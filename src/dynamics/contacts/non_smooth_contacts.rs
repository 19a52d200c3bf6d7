//! Contacts that are not those of smooth rigid raceways: near defects, and on an outer raceway that yields. One at a
//! time, before the others.

use super::element_forces::{InnerPlace, OnElement, OuterPlace, Place};
use super::forces::{Forces, NonSmooth, NonSmoothContact, UnsolvedContact};
use super::kernel::{ContactForce, InnerGap, Meeting, Near};
use crate::contact::error::ContactError;
use crate::contact::law::CompliantContact;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::parameters::{ElementBlock, Frames, Kinematics, Model, SMOOTH, moved};
use crate::numerics::lanes::{Kernel, WIDEST, Wide};
use crate::numerics::plane::{Vector, parts, turned, turned_by};

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
        let (defect_lookups, unsolved, shortcuts) =
            (&mut forces.defect_lookups, &mut forces.unsolved, &mut forces.shortcuts);
        if RECORD {
            contacts.clear();
        }
        let film = films.map(|films| &films.squeeze[RacewaySide::Outer as usize]);
        let on_housing = Vector::zeros();
        let mut sum = OuterSum { on_housing, elements, torques, contacts };
        for &NonSmooth { element: j, cells } in non_smooth_outer.iter() {
            let at @ OnPath { u, path_rate, .. } = self.on_path(j, now, state, ahead, sum.elements);
            let [angle, omega] = self.turning(j, now, sum.elements);
            let [_, law] = self.own_contacts(j);
            *defect_lookups += u64::from(cells != [SMOOTH; 2]);
            let place = Place { element: j, cells, u, angle, frames, film, curved: true };
            let unsolved =
                |at: &Meeting, cause| self.without_answer(RacewaySide::Outer, at, now, frames, cause, unsolved);
            let found = self.outer_contact(law, &OuterPlace { at: place, path_rate, omega }, shortcuts, unsolved);
            sum.add::<RECORD>(&at, law, &found, self.centre_radius(j) + u);
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
        let (block, i) = (&elements[j / WIDEST], j % WIDEST);
        let e_r = turned_by(now.cage.direction, block.sin[i], block.cos[i]);
        let path_rate = state[self.layout.radial_velocity + j] - now.housing.velocity.dot(&e_r);
        let u = moved(state[j], path_rate, ahead);
        OnPath { element: j, e_r, u, path_rate }
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
        let (frames, films, shortcuts) = (&forces.frames, forces.films.as_ref(), &mut forces.shortcuts);
        let clearance = self.clearance(films);
        let film = films.map(|films| &films.squeeze[RacewaySide::Inner as usize]);
        if RECORD {
            contacts.clear();
        }
        for &NonSmooth { element: j, cells } in non_smooth_inner.iter() {
            let OnPath { e_r, u, path_rate, .. } = self.on_path(j, now, state, ahead, elements);
            let [angle, omega] = self.turning(j, now, elements);
            *lookups += 1;
            let [law, _] = self.own_contacts(j);
            let rho = self.centre_radius(j) + u;
            let place = InnerPlace {
                at: Place { element: j, cells, u, angle, frames, film, curved: true },
                clearance: clearance - self.larger(j),
                rho,
                offset: parts(now.offset(), e_r),
                q_rate: InnerGap::q_rate(parts(now.drift(), e_r), path_rate, rho, omega),
            };
            let unsolved =
                |at: &Meeting, cause| self.without_answer(RacewaySide::Inner, at, now, frames, cause, unsolved);
            let (found, gap) = self.inner_contact(law, &place, shortcuts, unsolved);
            let [f_r, f_t] = found.force;
            let acceleration = &mut elements[j / WIDEST].other[j % WIDEST];
            let of_outer = if non_smooth_outer.iter().any(|other| other.element == j) { *acceleration } else { 0.0 };
            *acceleration = of_outer + f_r * self.per_mass_of(j);
            on_shaft -= e_r * f_r + turned(e_r) * f_t;
            if RECORD {
                torques[found.frame as usize] -= found.contact.force[1] * gap.distance;
                contacts.push(NonSmoothContact::new(j, law, &found));
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
    ) -> Near<f64> {
        // NaN here has its cause elsewhere.
        if (at.u + now.cage.angle).is_finite() {
            let angle = self.angle_from_defect(side, at, frames);
            *unsolved = Some(UnsolvedContact { element: at.element, angle, offset: now.offset().into(), cause });
        }
        Near::unsolved()
    }
}

impl NonSmoothContact {
    #[inline(always)]
    fn new(element: usize, law: &CompliantContact, found: &OnElement<f64>) -> Self {
        let OnElement { force: [radial, tangential], contact, .. } = *found;
        let ContactForce { approach, part, magnitude, .. } = contact;
        Self { element, approach, pushing: law.law.pushing(part[0], part[1]), force: [magnitude, radial, tangential] }
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
        &OnPath { element: j, e_r, .. }: &OnPath,
        law: &CompliantContact,
        found: &OnElement<f64>,
        distance: f64,
    ) {
        let [f_r, f_t] = found.force;
        let (block, i) = (&mut self.elements[j / WIDEST], j % WIDEST);
        block.other[i] = -f_r * block.per_mass[i];
        self.on_housing += e_r * f_r - turned(e_r) * f_t;
        if RECORD {
            self.torques[found.frame as usize] -= f_t * distance;
            self.contacts.push(NonSmoothContact::new(j, law, found));
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
