//! One contact of one element in the plane, near a defect or not: place, motion, law → force. Written once, for one
//! element and for several side by side, and either with derivatives; smooth contacts in motion are those of
//! [`smooth`](super::smooth).
//!
//! With ρ the distance of the element from the outer ring's centre and the rings' offset p along and t across e_r,
//! ```text
//! q = (ρ + p, t)   n = q/|q|   δ_i = −G − (u + p + t²/(|q| + q_r))   δ̇_i = −n·q̇   φ̇ = (n_r q̇_t − n_t q̇_r)/|q|
//! f_i = Q(δ_i, δ̇_i) n          f_o = Q(u, u′)                     on smooth raceways
//! Δ̇ = Δ_u δ̇ + Δ_ψ (φ̇ − ω_f)   f = Q(Δ, Δ̇) (R n + T t)           near a defect
//! ```
//! Outside δ is u, n is e_r and φ̇ the element's speed; there R and T point inwards and counter-clockwise.

use super::shortcuts::Shortcuts;
use crate::contact::error::ContactError;
use crate::contact::law::{CompliantContact, SqueezeFilm};
use crate::contact::near_defect::Approach;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::element::off_centre;
use crate::dynamics::parameters::{Defects, Frame, Frames, Model, OilFilms, Raceway, SMOOTH};
use crate::numerics::number::{Number, Scalar};

/// An element seen from the inner ring's centre.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct InnerGap<T> {
    /// δ_i (m)
    pub(in crate::dynamics) approach: T,
    /// n = q/|q|, radial and tangential.
    pub(in crate::dynamics) n: [T; 2],
    /// |q| (m)
    pub(in crate::dynamics) distance: T,
}

/// Where one contact of an element is, and in which cells.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Meeting<T = f64> {
    /// The element, from 0.
    pub(in crate::dynamics) element: usize,
    /// Cell of the raceway, and cell of the element's own defect.
    pub(in crate::dynamics) cells: [u32; 2],
    /// Approach to the smooth raceway (m).
    pub(in crate::dynamics) u: T,
    /// Direction of the element from the ring's centre (rad).
    pub(in crate::dynamics) direction: T,
    /// Distance of the element from the ring's centre (m).
    pub(in crate::dynamics) distance: T,
    /// Whether derivatives are to know of curvatures along the surface (`ElementMotion::curved`).
    pub(in crate::dynamics) curved: bool,
}

/// The surface under a contact.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Near<T> {
    /// Equivalent approach.
    pub(in crate::dynamics) approach: Approach<T>,
    /// What the body turns with that has the defect.
    pub(in crate::dynamics) frame: Frame,
}

/// What one contact exerts on the element.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct ContactForce<T> {
    /// Equivalent approach Δ (m).
    pub(in crate::dynamics) approach: T,
    /// The contact's own part of it (m), and the rate at which its damper acts (m/s).
    pub(in crate::dynamics) part: [T; 2],
    /// Parts of the force (N): away from the raceway along the direction in which they touch, and counter-clockwise.
    pub(in crate::dynamics) force: [T; 2],
    /// Magnitude of the force (N).
    pub(in crate::dynamics) magnitude: T,
    /// Force (N) of the smooth contact at the equivalent approach, which the slopes of that share out.
    pub(in crate::dynamics) smooth: T,
}

impl<T: Number> InnerGap<T> {
    /// Of an element at path `u` (m), `rho` (m) from the outer ring's centre, with the rings' `offset` (m) along and
    /// across its direction. `series`: |q| − q_r = t (t/q_r)/2 − … and the direction of q are series in t/q_r
    /// ([`Model::nearly_concentric`]). Written so that δ_i loses no digits to the radii's 20 mm.
    #[inline(always)]
    pub(in crate::dynamics) fn of(rho: T, u: T, [p, t]: [T; 2], clearance: T, series: bool) -> Self {
        let (longer, n, distance) = off_centre([rho + p, t], series);
        Self { approach: -clearance - (u + p + longer), n, distance }
    }

    /// Rate q̇ (m/s) along and across e_r of an element `rho` (m) from the outer ring's centre, whose path changes at
    /// u' (m/s) and which goes round with `omega` (rad/s), as the rings draw apart at `drift` (m/s) along and across.
    #[inline(always)]
    pub(in crate::dynamics) fn q_rate([along, across]: [T; 2], path_rate: T, rho: T, omega: T) -> [T; 2] {
        [along + path_rate, across + rho * omega]
    }

    /// Rate δ̇ (m/s) as q changes at `q_rate` (m/s).
    #[inline(always)]
    pub(in crate::dynamics) fn closing(&self, [q_r, q_t]: [T; 2]) -> T {
        let [n_r, n_t] = self.n;
        -(n_r * q_r + n_t * q_t)
    }

    /// Rate φ̇ (rad/s) of its direction from the inner ring's centre.
    #[inline(always)]
    pub(in crate::dynamics) fn turning(&self, [q_r, q_t]: [T; 2]) -> T {
        let [n_r, n_t] = self.n;
        (n_r * q_t - n_t * q_r) / self.distance
    }

    /// Parts along and counter-clockwise of e_r of a force along and counter-clockwise of n.
    #[inline(always)]
    pub(in crate::dynamics) fn turned(&self, [along, across]: [T; 2]) -> [T; 2] {
        let [n_r, n_t] = self.n;
        [along * n_r - across * n_t, along * n_t + across * n_r]
    }
}

impl<T: Scalar> InnerGap<T> {
    /// Angle φ − θ (rad) between the element's directions from the inner ring's centre and from the outer's.
    #[inline(always)]
    pub(in crate::dynamics) fn lead(&self) -> T {
        T::angle_of(self.n)
    }
}

impl<T: Scalar> Meeting<T> {
    /// The surface under it in a `cell` of a body's defects.
    #[inline(always)]
    fn over(
        &self,
        defects: &Defects,
        cell: u32,
        frames: &Frames<T>,
        shortcuts: &mut Shortcuts,
    ) -> Result<Near<T>, ContactError> {
        let direction = self.direction - frames.of(defects.frame).angle;
        let approach = defects.approach(cell, self.u, direction, self.distance, self.curved, &mut shortcuts.love)?;
        Ok(Near { approach, frame: defects.frame })
    }
}

impl<T: Scalar> ContactForce<T> {
    /// Of the smooth raceway at this approach (m) that changes at this rate (m/s).
    #[inline(always)]
    pub(super) fn on_smooth(law: &CompliantContact, film: Option<&SqueezeFilm<T>>, approach: T, rate: T) -> Self {
        let (smooth, part) = normal_force(law, film, approach, rate);
        Self { approach, part, force: [smooth, T::from(0.0)], magnitude: smooth, smooth }
    }
}

impl<T: Scalar> Near<T> {
    /// The smooth raceway at approach `u` (m).
    #[inline(always)]
    pub(in crate::dynamics) fn smooth(u: T) -> Self {
        Self { approach: Approach::smooth(u), frame: Frame::Housing }
    }

    /// NaN, where the contact law has no answer: an integration that meets it takes the step back.
    pub(in crate::dynamics) fn unsolved() -> Self {
        Self { approach: Approach::unsolved(), frame: Frame::Housing }
    }

    /// Force of the contact of this `law` whose approach and angle change at these rates (m/s, rad/s), with the film
    /// between the surfaces.
    #[inline(always)]
    pub(in crate::dynamics) fn force(
        &self,
        law: &CompliantContact,
        film: Option<&SqueezeFilm<T>>,
        [closing, turning]: [T; 2],
        frames: &Frames<T>,
    ) -> ContactForce<T> {
        let rate = self.rate([closing, turning], frames);
        self.force_at(law, film, rate)
    }

    /// Δ̇ (m/s) where approach and angle change at these rates (m/s, rad/s).
    #[inline(always)]
    pub(in crate::dynamics) fn rate(&self, [closing, turning]: [T; 2], frames: &Frames<T>) -> T {
        let Approach { by_path, by_angle, .. } = self.approach;
        by_path * closing + by_angle * (turning - frames.of(self.frame).speed)
    }

    /// The force where the approach changes at this `rate` (m/s).
    #[inline(always)]
    pub(in crate::dynamics) fn force_at(
        &self,
        law: &CompliantContact,
        film: Option<&SqueezeFilm<T>>,
        rate: T,
    ) -> ContactForce<T> {
        let Approach { value, radial, tangential, .. } = self.approach;
        let (force, part) = normal_force(law, film, value, rate);
        ContactForce {
            approach: value,
            part,
            force: [force * radial, force * tangential],
            magnitude: force * (radial * radial + tangential * tangential).sqrt(),
            smooth: force,
        }
    }
}

impl Model {
    /// The surface under a contact, of the element's own defect and of the raceway's the one that carries less.
    ///
    /// Inlined, so that what its caller does not use is not worked out.
    ///
    /// # Errors
    /// Where the contact law has no answer.
    #[inline(always)]
    pub(in crate::dynamics) fn near<T: Scalar>(
        &self,
        side: RacewaySide,
        at: &Meeting<T>,
        frames: &Frames<T>,
        shortcuts: &mut Shortcuts,
    ) -> Result<Near<T>, ContactError> {
        if at.cells[1] != SMOOTH {
            return self.near_own_defect(side, at, frames, shortcuts);
        }
        at.over(&self.raceway(side).defects, at.cells[0], frames, shortcuts)
    }

    /// As [`Self::near`] in space, at the place `across` (m) the groove, with ∂Δ/∂across.
    ///
    /// # Errors
    /// As there.
    #[inline(never)]
    pub(in crate::dynamics) fn near_across<T: Scalar>(
        &self,
        side: RacewaySide,
        at: &Meeting<T>,
        across: T,
        frames: &Frames<T>,
        shortcuts: &mut Shortcuts,
    ) -> Result<(Near<T>, T), ContactError> {
        let defects = &self.raceway(side).defects;
        let direction = at.direction - frames.of(defects.frame).angle;
        let (place, love) = ([at.u, across], &mut shortcuts.love);
        let (approach, by_across) =
            defects.approach_across(at.cells[0], place, direction, at.distance, at.curved, love)?;
        let ring = Near { approach, frame: defects.frame };
        if at.cells[1] != SMOOTH {
            let own = self.near(side, &Meeting { cells: [SMOOTH, at.cells[1]], ..*at }, frames, shortcuts)?;
            if own.approach.value.value() < ring.approach.value.value() {
                return Ok((own, T::from(0.0)));
            }
        }
        Ok((ring, by_across))
    }

    /// As [`Self::near`], the smooth raceway included; NaN where the contact law has no answer.
    pub(in crate::dynamics) fn near_or_unsolved<T: Scalar>(
        &self,
        side: RacewaySide,
        at: &Meeting<T>,
        frames: &Frames<T>,
        shortcuts: &mut Shortcuts,
    ) -> Near<T> {
        if at.cells == [SMOOTH; 2] {
            return Near::smooth(at.u);
        }
        self.near(side, at, frames, shortcuts).unwrap_or(Near::unsolved())
    }

    /// As [`Self::near`], of an element in a cell of its own defect.
    #[inline(never)]
    fn near_own_defect<T: Scalar>(
        &self,
        side: RacewaySide,
        at: &Meeting<T>,
        frames: &Frames<T>,
        shortcuts: &mut Shortcuts,
    ) -> Result<Near<T>, ContactError> {
        let [ring, own] = at.cells;
        let defective = self.defective.iter().find(|defective| defective.element == at.element);
        let own = match defective {
            Some(defective) => at.over(&defective.defects[side as usize], own, frames, shortcuts)?,
            None => Near { approach: Approach::smooth(at.u), frame: Frame::Spin },
        };
        if ring == SMOOTH {
            return Ok(own);
        }
        let ring = self.near(side, &Meeting { cells: [ring, SMOOTH], ..*at }, frames, shortcuts)?;
        Ok(if own.approach.value.value() < ring.approach.value.value() { own } else { ring })
    }

    /// One of the raceways.
    #[inline(always)]
    pub(in crate::dynamics) fn raceway(&self, side: RacewaySide) -> &Raceway {
        match side {
            RacewaySide::Inner => &self.inner,
            RacewaySide::Outer => &self.outer,
        }
    }
}

/// Q(Δ, Δ̇) of a contact with the film between its surfaces (N), and the contact's own part of approach and rate.
#[inline(always)]
fn normal_force<T: Scalar>(law: &CompliantContact, film: Option<&SqueezeFilm<T>>, approach: T, rate: T) -> (T, [T; 2]) {
    let (part, part_rate) = law.of_contact(approach, rate);
    let force = law.law.force(part, part_rate);
    (film.map_or(force, |film| force + film.force(approach, rate)), [part, part_rate])
}

/// The film of one raceway.
#[inline(always)]
pub(super) fn film_on<T>(films: Option<&OilFilms<T>>, side: RacewaySide) -> Option<&SqueezeFilm<T>> {
    films.map(|films| &films.squeeze[side as usize])
}
