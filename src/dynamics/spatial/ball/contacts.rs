//! The contacts of one ball with both grooves, near defects or not, in single numbers with any derivatives.

use super::{Ball, BallState, OnBall, Place, Seen, axis_of};
use crate::contact::error::ContactError;
use crate::contact::groove::{Axis, dot};
use crate::contact::law::CompliantContact;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{Meeting, Near, Shortcuts};
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
    /// Where it meets the groove.
    pub(in crate::dynamics) place: Place<T>,
    pub(in crate::dynamics) on_ball: OnBall<T>,
    /// Equivalent approach (m) and its rate (m/s).
    pub(in crate::dynamics) approach: T,
    pub(in crate::dynamics) rate: T,
    /// Magnitude of the force along the normal and around the ring (N).
    pub(in crate::dynamics) magnitude: T,
    /// The frame of the body that has the defect under it.
    pub(in crate::dynamics) frame: Option<Frame>,
}

/// A ball with its contacts.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct BallForces<T: Scalar = f64> {
    pub(in crate::dynamics) ball: Ball<T>,
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
        self.contacts.map(|contact| self.ball.on_ring(&contact.on_ball))
    }

    /// Torques on the bodies whose defects are under its contacts, about the axis of the ring at each contact (N m).
    pub(in crate::dynamics) fn torques(&self) -> impl Iterator<Item = (Frame, T)> {
        let axes = [self.ball.seen.0.axis.direction, self.ball.seen.1.axis.direction];
        let about = |(contact, axis): (BallContact<T>, _)| Some((contact.frame?, dot(contact.on_ball.moment, axis)));
        self.contacts.into_iter().zip(axes).filter_map(about)
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
    pub(in crate::dynamics) fn ball(&self, model: &Model, [u, v, w, w_z]: BallState<T>) -> Ball<T> {
        let rates = Ball::rates(self.e_r, [w, w_z], &self.rings[1]);
        self.ball_moving(model, [u, v], rates)
    }

    /// The ball at u and v, which change at these rates.
    pub(in crate::dynamics) fn ball_moving(&self, model: &Model, at: [T; 2], rates: [T; 2]) -> Ball<T> {
        let axes = [axis_of(&self.rings[0]), axis_of(&self.rings[1])];
        self.ball_between(model, at, rates, &axes)
    }

    /// The same between rings of these axes.
    #[inline(never)]
    pub(in crate::dynamics) fn ball_between(
        &self,
        model: &Model,
        at: [T; 2],
        rates: [T; 2],
        [inner, outer]: &[Axis<T>; 2],
    ) -> Ball<T> {
        let ([shaft, housing], radius) = (&self.rings, T::from(model.outer_centre_radius));
        Ball::new(radius, self.e_r, self.omega, (at, rates), [shaft, housing], (inner, outer))
    }
}

impl Model {
    /// The contacts of a ball in these cells.
    pub(in crate::dynamics) fn ball_forces<T: Scalar>(
        &self,
        space: &Space,
        cells: [[u32; 2]; 2],
        at: &BallMotion<T>,
        ball: &Ball<T>,
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
        ball: &Ball<T>,
        shortcuts: &mut Shortcuts,
    ) -> BallForces<T> {
        let [inner, outer] = [RacewaySide::Inner, RacewaySide::Outer];
        let (seen_inside, seen_outside) = &ball.seen;
        let contacts = [
            self.ball_contact((laws[0], inner), space, cells[0], at, seen_inside, shortcuts),
            self.ball_contact((laws[1], outer), space, cells[1], at, seen_outside, shortcuts),
        ];
        BallForces { ball: *ball, contacts }
    }

    /// One contact of a ball, in these cells.
    #[inline(never)]
    pub(super) fn ball_contact<T: Scalar>(
        &self,
        (law, side): (&CompliantContact, RacewaySide),
        space: &Space,
        cells: [u32; 2],
        at: &BallMotion<T>,
        seen: &Seen<T>,
        shortcuts: &mut Shortcuts,
    ) -> BallContact<T> {
        let groove = &space.grooves[side as usize];
        let place = Place::of(groove, seen);
        let (contact, closing) = (&place.contact, place.closing());
        let damping = T::Plain::from(space.across_damping);
        let is_open = groove.cosine(contact.meridian).value() <= 0.0;
        if cells == [SMOOTH; 2] || is_open {
            let force = law.law.force(contact.approach, closing);
            let (on_ball, approach) = (place.presses(force, force, damping), contact.approach);
            return BallContact { place, on_ball, approach, rate: closing, magnitude: force, frame: None };
        }
        let meeting = self.ball_meeting(side, cells, at, &place);
        let turning = match side {
            RacewaySide::Inner => contact.turning(place.velocity),
            RacewaySide::Outer => at.omega,
        };
        let near = self.near_ball(side, space, &meeting, &place, &at.frames, shortcuts);
        let beyond = || if at.tried { Near::smooth(contact.approach) } else { Near::unsolved() };
        let (near, by_across) = near.unwrap_or_else(|_| (beyond(), None));
        let mut rate = near.rate([closing, turning], &at.frames);
        // ∂Δ/∂t: how far the contact goes across the groove as the ball moves along t, times ∂Δ/∂η.
        let by_t = by_across.map(|by_across| by_across * groove.run_across(contact.approach));
        if let Some(by_t) = by_t {
            rate += by_t * dot(contact.across, place.velocity);
        }
        let found = near.force_at(law, None, rate);
        let mut on_ball = place.exerts(found.force, found.magnitude, damping);
        if let Some(by_t) = by_t {
            on_ball = place.exerts_across(on_ball, -(found.smooth * by_t));
        }
        let [approach, rate] = found.part;
        BallContact { place, on_ball, approach, rate, magnitude: found.magnitude, frame: Some(near.frame) }
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
        place: &Place<T>,
        frames: &Frames<T>,
        shortcuts: &mut Shortcuts,
    ) -> Result<(Near<T>, Option<T>), ContactError> {
        if self.raceway(side).defects.varying_across(meeting.cells[0]).is_none() {
            return self.near(side, meeting, frames, shortcuts).map(|near| (near, None));
        }
        let groove = &space.grooves[side as usize];
        let across = groove.place_across(groove.angle(place.contact.meridian));
        let (near, by_across) = self.near_across(side, meeting, across, frames, shortcuts)?;
        Ok((near, Some(by_across)))
    }

    /// Where a ball meets a defect: outside in its own direction, inside in that from the inner ring's axis.
    pub(in crate::dynamics) fn ball_meeting<T: Scalar>(
        &self,
        side: RacewaySide,
        cells: [u32; 2],
        at: &BallMotion<T>,
        place: &Place<T>,
    ) -> Meeting<T> {
        let contact = &place.contact;
        let direction = match side {
            RacewaySide::Inner => at.angle + T::angle_of([contact.outwards[0], contact.outwards[1]]),
            RacewaySide::Outer => at.angle,
        };
        let (u, distance) = (contact.approach, contact.distance);
        Meeting { element: at.element, cells, u, direction, distance, curved: at.curved }
    }
}
