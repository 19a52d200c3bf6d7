//! The contacts of one ball with both grooves, near defects or not, in single numbers with any derivatives.

use super::{BallState, OnBall, rates};
use crate::contact::error::ContactError;
use crate::contact::law::CompliantContact;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{Meeting, Near, Shortcuts};
use crate::dynamics::element::{Aslant, Element, Meridian, Tilted, Touch, View, product, views};
use crate::dynamics::parameters::{COORDINATES, Frame, Frames, Model, RingInSpace, SMOOTH, Space};
use crate::numerics::number::{Dual, Scalar};

/// A ball and what it meets.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct BallMotion<T: Scalar = f64> {
    /// The element, from 0.
    pub(in crate::dynamics) element: usize,
    pub(in crate::dynamics) e_r: [T; 2],
    /// Angle about the outer ring's centre (rad) and its speed (rad/s).
    pub(in crate::dynamics) angle: T,
    pub(in crate::dynamics) omega: T,
    pub(in crate::dynamics) rings: [RingInSpace<T>; 2],
    pub(in crate::dynamics) frames: Frames<T>,
    /// Whether derivatives are to know of curvatures along surfaces.
    pub(in crate::dynamics) curved: bool,
    /// Whether a contact too deep for its law near a defect is taken for one of the smooth raceway, which pushes more:
    /// a search learns from it which way to go. Where it ends is to be asked without.
    pub(in crate::dynamics) tried: bool,
}

/// A contact of a ball.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct BallContact<T: Scalar = f64> {
    /// How the ring sees the ball, and n away from its axis and along it.
    pub(in crate::dynamics) seen: Aslant<T>,
    pub(in crate::dynamics) normal: [T; 2],
    pub(in crate::dynamics) on_ball: OnBall<T>,
    /// Equivalent approach (m) and its rate (m/s).
    pub(in crate::dynamics) approach: T,
    pub(in crate::dynamics) rate: T,
    /// Magnitude of the force along the normal and around the ring (N).
    pub(in crate::dynamics) magnitude: T,
    /// The frame of the body that has the defect under it.
    pub(in crate::dynamics) frame: Option<Frame>,
}

/// A contact of a ball in its ring's meridian plane.
#[derive(Debug, Clone, Copy)]
pub(super) struct InMeridian<T> {
    /// Force on the ball (N) away from the ring's axis and along it, and around it.
    pub(super) force: [T; 2],
    pub(super) around: Option<T>,
    /// As [`BallContact`] has them.
    normal: [T; 2],
    approach: T,
    rate: T,
    magnitude: T,
    frame: Option<Frame>,
}

/// Where a ball meets a groove.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Place<T> {
    pub(super) at: Meridian<T, 2>,
    /// Direction of the ball (rad), outside its own and inside that from the inner ring's axis, and its rate (rad/s);
    /// known where the groove is not smooth.
    pub(super) turn: [T; 2],
}

/// A ball with its contacts.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct BallForces<T: Scalar = f64> {
    pub(in crate::dynamics) ball: Element<T, 2>,
    pub(in crate::dynamics) contacts: [BallContact<T>; 2],
}

impl<T: Scalar> BallForces<T> {
    /// Force of both contacts on the ball along e_r, e_t and z (N).
    pub(in crate::dynamics) fn force(&self) -> [T; 3] {
        let [inner, outer] = self.contacts.map(|contact| contact.on_ball.force);
        std::array::from_fn(|i| inner[i] + outer[i])
    }

    /// Forces and moments on both rings.
    pub(in crate::dynamics) fn on_rings(&self) -> [[T; COORDINATES]; 2] {
        self.contacts.map(|contact| contact.on_ball.on_ring(self.ball.e_r))
    }

    /// Torques on the bodies whose defects are under its contacts, about the axis of the ring at each contact (N m).
    pub(in crate::dynamics) fn torques(&self) -> impl Iterator<Item = (Frame, T)> {
        self.contacts
            .into_iter()
            .filter_map(|contact| Some((contact.frame?, product(contact.on_ball.moment, contact.seen.axis))))
    }
}

impl<T: Scalar> BallMotion<T> {
    /// The same in numbers of another kind.
    pub(in crate::dynamics) fn mapped<U: Scalar>(&self, number: impl Fn(T) -> U) -> BallMotion<U> {
        let ring = |ring: RingInSpace<T>| RingInSpace {
            position: ring.position.map(&number),
            velocity: ring.velocity.map(&number),
        };
        BallMotion {
            element: self.element,
            e_r: self.e_r.map(&number),
            angle: number(self.angle),
            omega: number(self.omega),
            rings: self.rings.map(ring),
            frames: self.frames.mapped(&number),
            curved: self.curved,
            tried: self.tried,
        }
    }

    /// The same as dual numbers that do not change.
    pub(in crate::dynamics) fn lifted<const K: usize>(&self) -> BallMotion<Dual<T, K>> {
        self.mapped(Dual::constant)
    }

    /// The same positions with nothing moving.
    pub(in crate::dynamics) fn standing(&self) -> Self {
        let none = T::from(0.0);
        let rings = self.rings.map(|ring| RingInSpace { velocity: [none; COORDINATES], ..ring });
        Self { omega: none, rings, frames: self.frames.at_rest(), ..*self }
    }

    /// Whether the ball and the rings stand, so that no velocity depends on where it is; defects may turn under it.
    pub(in crate::dynamics) fn stands(&self) -> bool {
        let none = |rate: T| rate.value() == 0.0;
        none(self.omega) && self.rings.iter().flat_map(|ring| ring.velocity).all(none)
    }

    /// The ball at u, v, w and w_z.
    // A function for each kind of number, once: with derivatives it is long.
    #[inline(never)]
    pub(in crate::dynamics) fn ball(&self, model: &Model, [u, v, w, w_z]: BallState<T>) -> Element<T, 2> {
        self.ball_moving(model, [u, v], rates(self.e_r, [w, w_z], &self.rings[1]))
    }

    /// The ball at u and v, which change at these rates.
    pub(in crate::dynamics) fn ball_moving(&self, model: &Model, at: [T; 2], rate: [T; 2]) -> Element<T, 2> {
        let Self { e_r, omega, .. } = *self;
        Element { e_r, at, rate, rho: T::from(model.outer_centre_radius) + at[0], omega }
    }
}

impl Model {
    /// The contacts of a ball in these cells.
    pub(in crate::dynamics) fn ball_forces<T: Scalar>(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        at: &BallMotion<T>,
        ball: &Element<T, 2>,
        shortcuts: &mut Shortcuts,
    ) -> BallForces<T> {
        let laws = [&self.inner.contact, &self.outer.contact];
        self.ball_forces_with(laws, space, cells, at, ball, shortcuts)
    }

    /// The same with these laws.
    pub(in crate::dynamics) fn ball_forces_with<T: Scalar>(
        &self,
        laws: [&CompliantContact; 2],
        space: &Space,
        cells: [[u32; 2]; 2],
        at: &BallMotion<T>,
        ball: &Element<T, 2>,
        shortcuts: &mut Shortcuts,
    ) -> BallForces<T> {
        let views = views(&at.rings);
        let mut contact = |side: RacewaySide| {
            let (law, view, cells) = (laws[side as usize], &views[side as usize], cells[side as usize]);
            let (place, seen) = place_of(side, cells, at.angle, view, ball);
            let found = self.ball_contact((law, side), space, cells, at, &place, shortcuts);
            let InMeridian { force, around, normal, approach, rate, magnitude, frame } = found;
            let on_ball = OnBall::of(&seen, force, around);
            BallContact { seen, normal, on_ball, approach, rate, magnitude, frame }
        };
        BallForces { ball: *ball, contacts: [contact(RacewaySide::Inner), contact(RacewaySide::Outer)] }
    }

    /// One contact of a ball, in these cells.
    #[inline(never)]
    pub(super) fn ball_contact<T: Scalar>(
        &self,
        (law, side): (&CompliantContact, RacewaySide),
        space: &Space,
        cells: [u32; 2],
        at: &BallMotion<T>,
        place: &Place<T>,
        shortcuts: &mut Shortcuts,
    ) -> InMeridian<T> {
        let groove = &space.grooves[side as usize];
        let touch @ Touch { approach, closing, normal, sliding } = Touch::of(groove, &place.at);
        let damping = T::Plain::from(space.across_damping);
        let is_open = groove.cosine(normal).value() <= 0.0;
        if cells == [SMOOTH; 2] || is_open {
            let magnitude = law.law.force(approach, closing);
            let force = touch.exerts(magnitude, magnitude * sliding * damping);
            return InMeridian { force, around: None, normal, approach, rate: closing, magnitude, frame: None };
        }
        let meeting = self.ball_meeting(cells, at, place, approach);
        let near = self.near_ball(side, space, &meeting, normal, &at.frames, shortcuts);
        let beyond = || if at.tried { Near::smooth(approach) } else { Near::unsolved() };
        let (near, by_across) = near.unwrap_or_else(|_| (beyond(), None));
        let mut rate = near.rate([closing, place.turn[1]], &at.frames);
        // ∂Δ/∂t: how far the contact goes across the groove as the ball moves along t, times ∂Δ/∂η.
        let by_t = by_across.map(|by_across| by_across * groove.run_across(approach));
        if let Some(by_t) = by_t {
            rate += by_t * sliding;
        }
        let found = near.force_at(law, None, rate);
        let mut against = found.magnitude * sliding * damping;
        if let Some(by_t) = by_t {
            against += found.smooth * by_t;
        }
        let ([along, around], [approach, rate], magnitude) = (found.force, found.part, found.magnitude);
        let force = touch.exerts(along, against);
        InMeridian { force, around: Some(around), normal, approach, rate, magnitude, frame: Some(near.frame) }
    }

    /// The surface near a defect, and ∂Δ/∂η of one that varies across the groove.
    ///
    /// # Errors
    /// Where the contact law has no answer.
    #[inline(always)]
    pub(super) fn near_ball<T: Scalar>(
        &self,
        side: RacewaySide,
        space: &Space,
        meeting: &Meeting<T>,
        normal: [T; 2],
        frames: &Frames<T>,
        shortcuts: &mut Shortcuts,
    ) -> Result<(Near<T>, Option<T>), ContactError> {
        if self.raceway(side).defects.varying_across(meeting.cells[0]).is_none() {
            return self.near(side, meeting, frames, shortcuts).map(|near| (near, None));
        }
        let groove = &space.grooves[side as usize];
        let across = groove.place_across(groove.angle(normal));
        let (near, by_across) = self.near_across(side, meeting, across, frames, shortcuts)?;
        Ok((near, Some(by_across)))
    }

    /// Where a ball at this approach (m) meets a defect.
    pub(super) fn ball_meeting<T: Scalar>(
        &self,
        cells: [u32; 2],
        at: &BallMotion<T>,
        place: &Place<T>,
        approach: T,
    ) -> Meeting<T> {
        let distance = place.at.at[0] + T::from(self.outer_centre_radius);
        Meeting { element: at.element, cells, u: approach, direction: place.turn[0], distance, curved: at.curved }
    }
}

/// Where a ball, at this `angle` (rad) about the outer ring's centre, meets the groove of a ring, and how it is seen.
#[inline(always)]
pub(super) fn place_of<T: Scalar>(
    side: RacewaySide,
    cells: [u32; 2],
    angle: T,
    view: &Tilted<T>,
    ball: &Element<T, 2>,
) -> (Place<T>, Aslant<T>) {
    let (at, seen) = view.see(ball);
    let turn = match side {
        RacewaySide::Inner if cells != [SMOOTH; 2] => [angle + seen.lead(), view.turning_of(ball, &seen)],
        _ => [angle, ball.omega],
    };
    (Place { at, turn }, seen)
}
