//! One element's contacts to first order, by the few numbers that each follows from.
//!
//! From it are assembled the [Jacobian](crate::dynamics::derivatives::jacobian) of stiff steps, the elements' and
//! rings' balance of the [start](crate::dynamics::equilibrium::search) and how that moves, and the tangent stiffness.
//!
//! The forces are those of the [kernel](super::kernel) over dual numbers: of the inner contact by q, q̇, frame and
//! film, of the outer by u, u′, angle, speed and film. What an element meets leads to these by the same text of them
//! over dual numbers of whoever asks, and the chain rule gives the forces' derivatives. The element's numbers may be
//! dual numbers themselves; the derivatives then have theirs.
//!
//! Derivatives are those of the branch that each contact is in; at the onset of a contact there are two, and where a
//! film's gap ceases to close. At rest all of it is elastic: G = ∂f/∂q is symmetric, and no damping enters.

use super::element_forces::{ContactForces, InnerPlace, OnElement, OuterPlace, Place, unanswered};
use super::element_motion::ElementMotion;
use super::kernel::film_on;
use super::shortcuts::Shortcuts;
use crate::contact::law::CompliantContact;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::parameters::{Frame, Frames, Model, SMOOTH, Turn};
use crate::numerics::number::{Dual, Scalar};
use crate::numerics::plane::Vector;
use std::ops::Mul;

/// Directions of the inner contact's derivatives: q and q̇ along e_r and e_t, angle of the frame less the element's,
/// speed of the frame, film speed.
const INNER: usize = 7;
/// Of the outer contact's: u, u', angle and speed against the frame, film speed.
const OUTER: usize = 5;
/// The first of these, from which dry contacts on smooth raceways follow.
const SMOOTH_INNER: usize = 4;
const SMOOTH_OUTER: usize = 2;

/// One element's contacts to first order. Forces are in parts along e_r and e_t, of the outer contact inwards.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Linearized<T: Scalar = f64> {
    /// The element, at this motion.
    pub(in crate::dynamics) at: ElementMotion<T>,
    /// Distance from the outer ring's centre (m).
    pub(in crate::dynamics) rho: T,
    /// The inner contact.
    pub(in crate::dynamics) inner: FirstOrder<T, INNER>,
    /// The outer contact.
    pub(in crate::dynamics) outer: FirstOrder<T, OUTER>,
    /// Direction, along e_r and e_t, and length of q (m).
    pub(in crate::dynamics) n: [T; 2],
    pub(in crate::dynamics) distance: T,
}

impl Linearized {
    /// The smaller approach (m) of the contacts that touch; infinite where none does.
    pub(in crate::dynamics) fn lightest_approach(&self) -> f64 {
        let touching = [self.inner.approach, self.outer.approach].into_iter().filter(|&approach| approach > 0.0);
        touching.fold(f64::INFINITY, f64::min)
    }
}

/// A contact's force on the element and its derivatives.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct FirstOrder<T: Scalar, const K: usize> {
    /// Force (N).
    pub(in crate::dynamics) force: Vector<T>,
    by: [Vector<T>; K],
    /// Whether it is dry and on a smooth raceway, and follows from the first directions only.
    is_smooth: bool,
    /// Equivalent approach (m).
    pub(in crate::dynamics) approach: T,
    /// The frame of the body that has the defect.
    pub(in crate::dynamics) frame: Frame,
}

impl<T: Scalar, const K: usize> FirstOrder<T, K> {
    /// Of what the kernel finds, some directions left out.
    fn of<const N: usize>(OnElement { force, contact, frame }: OnElement<Dual<T, N>>) -> Self {
        let mut by = [Vector::zeros(); K];
        for (k, by) in by.iter_mut().enumerate().take(N) {
            *by = Vector::new(force[0].by[k], force[1].by[k]);
        }
        let force = Vector::new(force[0].value, force[1].value);
        Self { force, by, is_smooth: N < K, approach: contact.approach.value, frame }
    }

    /// The force as what it follows from changes.
    #[inline(always)]
    fn chained<const SMOOTH_DIRECTIONS: usize, const M: usize>(&self, of: &[Dual<T, M>; K]) -> Vector<Dual<T, M>> {
        if self.is_smooth { self.along::<SMOOTH_DIRECTIONS, M>(of) } else { self.along::<K, M>(of) }
    }

    /// The same by the first directions.
    #[inline(always)]
    fn along<const N: usize, const M: usize>(&self, of: &[Dual<T, M>; K]) -> Vector<Dual<T, M>> {
        let part = |part| Dual::<T, N> { value: self.force[part], by: std::array::from_fn(|i| self.by[i][part]) };
        Vector::new(part(0).chained(of), part(1).chained(of))
    }
}

impl<T: Scalar> Linearized<T> {
    /// The forces.
    pub(in crate::dynamics) fn forces(&self) -> ContactForces<T> {
        ContactForces { inner: self.inner.force, outer: self.outer.force }
    }

    /// The forces where what the element meets, `at` the same place, has derivatives.
    #[inline(always)]
    pub(in crate::dynamics) fn chained<const K: usize, E: Scalar>(
        &self,
        at: &ElementMotion<Dual<T, K>, E>,
    ) -> ContactForces<Dual<T, K>>
    where
        Dual<T, K>: Mul<E, Output = Dual<T, K>>,
    {
        let rho = at.path + (self.rho - self.at.path);
        let (offset, q_rate) = at.seen_from_inner(rho);
        let frame = at.frames.of(self.inner.frame);
        let q = [rho + offset[0], offset[1]];
        let inner = [q[0], q[1], q_rate[0], q_rate[1], frame.angle - at.angle, frame.speed, at.film_speed];
        let frame = at.frames.of(self.outer.frame);
        let outer = [at.path, at.path_rate, at.angle - frame.angle, at.omega - frame.speed, at.film_speed];
        ContactForces {
            inner: self.inner.chained::<SMOOTH_INNER, K>(&inner),
            outer: self.outer.chained::<SMOOTH_OUTER, K>(&outer),
        }
    }
}

impl<T: Scalar, const K: usize> FirstOrder<T, K> {
    fn values(&self) -> FirstOrder<f64, K> {
        let by = self.by.map(|by| by.map(T::value));
        FirstOrder {
            force: self.force.map(T::value),
            by,
            is_smooth: self.is_smooth,
            approach: self.approach.value(),
            frame: self.frame,
        }
    }
}

impl<T: Scalar> Linearized<T> {
    /// The numbers without their derivatives.
    pub(in crate::dynamics) fn values(&self) -> Linearized {
        Linearized {
            at: self.at.mapped(T::value),
            rho: self.rho.value(),
            inner: self.inner.values(),
            outer: self.outer.values(),
            n: self.n.map(T::value),
            distance: self.distance.value(),
        }
    }
}

impl Model {
    /// The contacts of an element at this motion, in these cells (see `Model::cells_of`).
    pub(in crate::dynamics) fn linearized<T: Scalar>(
        &self,
        cells: [[u32; 2]; 2],
        at: &ElementMotion<T>,
        shortcuts: &mut Shortcuts,
    ) -> Linearized<T> {
        let contacts = self.own_contacts(at.element);
        // Dry contacts on smooth raceways ask for the first directions only.
        let [inner, outer] = cells.map(|cells| cells == [SMOOTH; 2] && at.films.is_none());
        let (inner, n, distance) = if inner {
            self.inner_to_first_order::<T, SMOOTH_INNER>(contacts[0], cells[0], at, shortcuts)
        } else {
            self.inner_to_first_order::<T, INNER>(contacts[0], cells[0], at, shortcuts)
        };
        let outer = if outer {
            self.outer_to_first_order::<T, SMOOTH_OUTER>(contacts[1], cells[1], at, shortcuts)
        } else {
            self.outer_to_first_order::<T, OUTER>(contacts[1], cells[1], at, shortcuts)
        };
        Linearized { at: *at, rho: self.distance(at), inner, outer, n, distance }
    }

    fn inner_to_first_order<T: Scalar, const K: usize>(
        &self,
        contact: &CompliantContact,
        cells: [u32; 2],
        at: &ElementMotion<T>,
        shortcuts: &mut Shortcuts,
    ) -> (FirstOrder<T, INNER>, [T; 2], T) {
        let rho = self.distance(at);
        let (offset, q_rate) = at.seen_from_inner(rho);
        let turn = |turn: Turn<T>| Turn { angle: seed(turn.angle, 4), speed: seed(turn.speed, 5) };
        let frames = Frames(at.frames.0.map(turn));
        let films = at.films.map(|films| films.following(seed(at.film_speed, 6)));
        let (inner, gap) = self.inner_contact::<Dual<T, K>>(
            contact,
            &InnerPlace {
                at: Place {
                    element: at.element,
                    cells,
                    u: Dual::constant(at.path),
                    angle: Dual::constant(at.angle),
                    frames: &frames,
                    film: film_on(films.as_ref(), RacewaySide::Inner),
                    curved: at.curved,
                },
                clearance: self.clearance_between(at.element, films.as_ref()),
                rho: Dual::constant(rho),
                offset: [seed(offset[0], 0), seed(offset[1], 1)],
                q_rate: [seed(q_rate[0], 2), seed(q_rate[1], 3)],
            },
            shortcuts,
            unanswered,
        );
        (FirstOrder::of(inner), gap.n.map(|n| n.value), gap.distance.value)
    }

    fn outer_to_first_order<T: Scalar, const K: usize>(
        &self,
        contact: &CompliantContact,
        cells: [u32; 2],
        at: &ElementMotion<T>,
        shortcuts: &mut Shortcuts,
    ) -> FirstOrder<T, OUTER> {
        let frames = at.frames.mapped(Dual::<T, K>::constant);
        let films = at.films.map(|films| films.following(seed(at.film_speed, 4)));
        FirstOrder::of(self.outer_contact(
            contact,
            &OuterPlace {
                at: Place {
                    element: at.element,
                    cells,
                    u: seed(at.path, 0),
                    angle: seed(at.angle, 2),
                    frames: &frames,
                    film: film_on(films.as_ref(), RacewaySide::Outer),
                    curved: at.curved,
                },
                path_rate: seed(at.path_rate, 1),
                omega: seed(at.omega, 3),
            },
            shortcuts,
            unanswered,
        ))
    }
}

/// The variable of direction `k`, or a constant where that is left out.
#[inline(always)]
fn seed<T: Scalar, const K: usize>(value: T, k: usize) -> Dual<T, K> {
    if k < K { Dual::variable(value, k) } else { Dual::constant(value) }
}
