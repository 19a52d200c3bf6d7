//! The forces of both contacts of one element, and what they exert on the rest of the bearing.

use super::element_motion::ElementMotion;
use super::kernel::{ContactForce, InnerGap, Meeting, Near, film_on};
use super::shortcuts::Shortcuts;
use crate::contact::error::ContactError;
use crate::contact::law::{CompliantContact, SqueezeFilm};
use crate::contact::rolling::RacewaySide;
use crate::dynamics::parameters::{Frame, Frames, Model, SMOOTH};
use crate::numerics::number::{Dual, Scalar};
use crate::numerics::plane::Vector;
use std::ops::{Add, Mul};

/// What a contact of an element follows from, on either raceway.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place<'a, T> {
    pub(super) element: usize,
    /// Cell of the raceway and of the element's own defect.
    pub(super) cells: [u32; 2],
    /// Path (m), and angle of the element about the outer ring's centre (rad).
    pub(super) u: T,
    pub(super) angle: T,
    pub(super) frames: &'a Frames<T>,
    /// The film between its surfaces.
    pub(super) film: Option<&'a SqueezeFilm<T>>,
    pub(super) curved: bool,
}

/// What the inner contact of an element follows from.
#[derive(Debug, Clone, Copy)]
pub(super) struct InnerPlace<'a, T> {
    pub(super) at: Place<'a, T>,
    /// What separates a raceway from the element pressed to the other (m), films included.
    pub(super) clearance: T,
    /// Distance from the outer ring's centre (m).
    pub(super) rho: T,
    /// Rings' offset (m), and rate of q (m/s), along and across e_r.
    pub(super) offset: [T; 2],
    pub(super) q_rate: [T; 2],
}

/// What the outer contact of an element follows from.
#[derive(Debug, Clone, Copy)]
pub(super) struct OuterPlace<'a, T> {
    pub(super) at: Place<'a, T>,
    /// Rate of the path (m/s), and speed of the element about the outer ring's centre (rad/s).
    pub(super) path_rate: T,
    pub(super) omega: T,
}

/// What a contact exerts on its element.
#[derive(Debug, Clone, Copy)]
pub(super) struct OnElement<T> {
    /// Force (N) along e_r, of the outer contact against it, and counter-clockwise.
    pub(super) force: [T; 2],
    /// The same as seen from the ring, and what else is found.
    pub(super) contact: ContactForce<T>,
    /// The frame of the body that has the defect.
    pub(super) frame: Frame,
}

/// Forces of both contacts on an element (N), in parts along e_r and e_t, of the outer contact inwards.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct ContactForces<T: Scalar = f64> {
    pub(in crate::dynamics) inner: Vector<T>,
    pub(in crate::dynamics) outer: Vector<T>,
}

/// The forces on one element, and what their torques ask for.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct ElementForces<T: Scalar = f64> {
    /// The element, at this motion.
    pub(in crate::dynamics) at: ElementMotion<T>,
    /// Distance from the outer ring's centre (m).
    pub(in crate::dynamics) rho: T,
    pub(in crate::dynamics) forces: ContactForces<T>,
    /// Direction, along e_r and e_t, and length of q (m).
    pub(in crate::dynamics) n: [T; 2],
    pub(in crate::dynamics) distance: T,
    /// The frame of the body that has the defect under each contact; `None` on smooth raceways.
    pub(in crate::dynamics) frames: [Option<Frame>; 2],
}

/// A torque on a body with a defect.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct BodyTorque<T = f64> {
    /// The frame in which the body turns.
    pub(in crate::dynamics) frame: Frame,
    /// About its own centre (N m).
    pub(in crate::dynamics) torque: T,
}

impl<T: Scalar> ContactForces<T> {
    /// Radial force on the element (N).
    #[inline(always)]
    pub(in crate::dynamics) fn radial(&self) -> T {
        self.inner.x - self.outer.x
    }

    /// Force on the inner and on the outer ring (N) of an element `at` this place.
    #[inline(always)]
    pub(in crate::dynamics) fn on_rings<E: Scalar>(&self, at: &ElementMotion<T, E>) -> [Vector<T>; 2]
    where
        T: Mul<E, Output = T>,
    {
        let Self { inner, outer } = self;
        let along = |e: &Vector<E>, force: T| e.map(|part| force * part);
        [-(along(&at.e_r, inner.x) + along(&at.e_t, inner.y)), along(&at.e_r, outer.x) - along(&at.e_t, outer.y)]
    }
}

impl<T: Scalar, const K: usize> ContactForces<Dual<T, K>> {
    /// Derivatives by one direction.
    pub(in crate::dynamics) fn by(&self, k: usize) -> ContactForces<T> {
        ContactForces { inner: self.inner.map(|part| part.by[k]), outer: self.outer.map(|part| part.by[k]) }
    }
}

impl<T: Scalar> ElementForces<T> {
    /// Force on the inner and on the outer ring (N).
    pub(in crate::dynamics) fn on_rings(&self) -> [Vector<T>; 2] {
        self.forces.on_rings(&self.at)
    }

    /// Torques on the bodies with the defects under its contacts. A force on a smooth raceway goes through the ring's
    /// centre.
    pub(in crate::dynamics) fn torques(&self) -> impl Iterator<Item = BodyTorque<T>> {
        let ContactForces { inner, outer } = self.forces;
        let across = inner.y * self.n[0] - inner.x * self.n[1];
        let torques = [-across * self.distance, -outer.y * self.rho];
        self.frames
            .into_iter()
            .zip(torques)
            .filter_map(|(frame, torque)| frame.map(|frame| BodyTorque { frame, torque }))
    }
}

impl<T: Scalar + Mul<E, Output = T>, E: Scalar> ElementMotion<T, E> {
    /// Where a contact of it is, in these cells.
    fn place<'a>(&'a self, cells: [u32; 2], film: Option<&'a SqueezeFilm<T>>) -> Place<'a, T> {
        let Self { element, path, angle, ref frames, curved, .. } = *self;
        Place { element, cells, u: path, angle, frames, film, curved }
    }

    /// Rings' offset (m) and rate of q (m/s) along and across e_r, the element being `rho` (m) from the outer ring's
    /// centre.
    #[inline(always)]
    pub(super) fn seen_from_inner(&self, rho: T) -> ([T; 2], [T; 2]) {
        let Self { e_r, e_t, offset, drift, .. } = self;
        let drift = [along(drift, e_r), along(drift, e_t)];
        let q_rate = InnerGap::q_rate(drift, self.path_rate, rho, self.omega);
        ([along(offset, e_r), along(offset, e_t)], q_rate)
    }
}

/// Part of a vector along a direction.
#[inline(always)]
fn along<T: Scalar + Mul<E, Output = T>, E: Scalar>(vector: &Vector<T>, e: &Vector<E>) -> T {
    vector.x * e.x + vector.y * e.y
}

impl Model {
    /// The forces of these contacts on an element, in these cells (see `Model::cells_of`).
    pub(in crate::dynamics) fn element_forces<T: Scalar>(
        &self,
        contacts: [&CompliantContact; 2],
        cells: [[u32; 2]; 2],
        at: &ElementMotion<T>,
        shortcuts: &mut Shortcuts,
    ) -> ElementForces<T> {
        let films = at.oil_films();
        let film = |side| film_on(films.as_ref(), side);
        let (rho, clearance) = (self.distance(at), self.clearance_between(at.element, films.as_ref()));
        let (offset, q_rate) = at.seen_from_inner(rho);
        let inside = at.place(cells[0], film(RacewaySide::Inner));
        let place = InnerPlace { at: inside, clearance, rho, offset, q_rate };
        let (inner, gap) = self.inner_contact(contacts[0], &place, shortcuts, unanswered);
        let outside = at.place(cells[1], film(RacewaySide::Outer));
        let place = OuterPlace { at: outside, path_rate: at.path_rate, omega: at.omega };
        let outer = self.outer_contact(contacts[1], &place, shortcuts, unanswered);
        let bearer = |cells: [u32; 2], frame| (cells != [SMOOTH; 2]).then_some(frame);
        ElementForces {
            at: *at,
            rho,
            forces: ContactForces { inner: inner.force.into(), outer: outer.force.into() },
            n: gap.n,
            distance: gap.distance,
            frames: [bearer(cells[0], inner.frame), bearer(cells[1], outer.frame)],
        }
    }

    /// Torque on the cage about the outer ring's centre (N m) of element `j` with this tangential direction, speed and
    /// acceleration (rad/s, rad/s²), path and rate of it (m, m/s), that its contacts push `around` with a force (N)
    /// counter-clockwise; that about its own axis is left out.
    ///
    /// The kinematic cage forces each element to the tangential acceleration a_o·e_t + 2 u' ω + ρ ω'; what contacts and
    /// gravity do not supply, it does. `acceleration` is the outer ring's (m/s²).
    pub(in crate::dynamics) fn torque_on_cage<T: Scalar>(
        &self,
        j: usize,
        e_t: Vector<T>,
        [omega, alpha]: [T; 2],
        [path, path_rate]: [T; 2],
        around: T,
        acceleration: Vector,
    ) -> T {
        let rho = path + T::from(self.centre_radius(j));
        let inertia = acceleration.map(T::from).dot(&e_t) + (path_rate + path_rate) * omega + rho * alpha;
        rho * (around + (self.gravity.map(T::from).dot(&e_t) - inertia) * T::Plain::from(self.mass_of(j)))
    }

    /// Distance ρ (m) of an element from the outer ring's centre.
    #[inline(always)]
    pub(in crate::dynamics) fn distance<T: Scalar, E: Scalar>(&self, at: &ElementMotion<T, E>) -> T {
        at.path + T::from(self.centre_radius(at.element))
    }

    /// w' (m/s²) of an element under this `radial` force of its contacts (N) as the outer ring goes at `housing` (m/s).
    #[inline(always)]
    pub(in crate::dynamics) fn radial_acceleration<T, E: Scalar>(
        &self,
        at: &ElementMotion<T, E>,
        radial: T,
        housing: Vector<T>,
    ) -> T
    where
        T: Scalar + Mul<E, Output = T> + Add<E, Output = T>,
    {
        let turning = at.omega * (along(&housing, &at.e_t) + self.distance(at) * at.omega);
        radial * T::Plain::from(self.per_mass_of(at.element)) + self.gravity.map(E::from).dot(&at.e_r) + turning
    }

    /// The inner contact, and the gap it is in. Where the contact law has no answer it is what `unsolved` gives.
    #[inline(always)]
    pub(super) fn inner_contact<T: Scalar>(
        &self,
        contact: &CompliantContact,
        place: &InnerPlace<T>,
        shortcuts: &mut Shortcuts,
        unsolved: impl FnOnce(&Meeting<T>, ContactError) -> Near<T>,
    ) -> (OnElement<T>, InnerGap<T>) {
        let InnerPlace { at, clearance, rho, offset, q_rate } = place;
        let Place { element, cells, u, angle, frames, film, curved } = *at;
        let gap = InnerGap::of(*rho, u, *offset, *clearance, false);
        if cells == [SMOOTH; 2] {
            let contact = ContactForce::on_smooth(contact, film, gap.approach, gap.closing(*q_rate));
            let force = gap.n.map(|part| contact.smooth * part);
            return (OnElement { force, contact, frame: Frame::Housing }, gap);
        }
        let (u, direction, distance) = (gap.approach, angle + gap.lead(), gap.distance);
        let at = Meeting { element, cells, u, direction, distance, curved };
        let near = self.near(RacewaySide::Inner, &at, frames, shortcuts).unwrap_or_else(|cause| unsolved(&at, cause));
        let contact = near.force(contact, film, [gap.closing(*q_rate), gap.turning(*q_rate)], frames);
        (OnElement { force: gap.turned(contact.force), contact, frame: near.frame }, gap)
    }

    /// The outer contact. Where the contact law has no answer it is what `unsolved` gives.
    #[inline(always)]
    pub(super) fn outer_contact<T: Scalar>(
        &self,
        contact: &CompliantContact,
        place: &OuterPlace<T>,
        shortcuts: &mut Shortcuts,
        unsolved: impl FnOnce(&Meeting<T>, ContactError) -> Near<T>,
    ) -> OnElement<T> {
        let OuterPlace { at, path_rate, omega } = place;
        let Place { element, cells, u, angle, frames, film, curved } = *at;
        if cells == [SMOOTH; 2] {
            let contact = ContactForce::on_smooth(contact, film, u, *path_rate);
            return OnElement { force: contact.force, contact, frame: Frame::Housing };
        }
        let distance = u + T::from(self.centre_radius(element));
        let at = Meeting { element, cells, u, direction: angle, distance, curved };
        let near = self.near(RacewaySide::Outer, &at, frames, shortcuts).unwrap_or_else(|cause| unsolved(&at, cause));
        let contact = near.force(contact, film, [*path_rate, *omega], frames);
        OnElement { force: contact.force, contact, frame: near.frame }
    }
}

/// What stands for a contact without an answer where nobody asks why.
#[inline(always)]
pub(super) fn unanswered<T: Scalar>(_: &Meeting<T>, _: ContactError) -> Near<T> {
    Near::unsolved()
}
