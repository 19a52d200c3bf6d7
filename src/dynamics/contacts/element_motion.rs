//! What one element meets at an instant: where it is, how it moves, and how all that it touches does. In numbers of any
//! kind, so that a change of any of it is followed through the contacts by the one text there is of them.

use super::shortcuts::Shortcuts;
use crate::dynamics::parameters::{FilmsNow, FramedKinematics, Frames, Model, OilFilms, PathMotion, Turn};
use crate::numerics::number::Scalar;
use crate::numerics::plane::{Vector, turned};

/// One element and what it meets.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct ElementMotion<T: Scalar = f64> {
    /// The element, from 0.
    pub(in crate::dynamics) element: usize,
    /// Radial direction, and the one counter-clockwise of it.
    pub(in crate::dynamics) e_r: Vector<T>,
    pub(in crate::dynamics) e_t: Vector<T>,
    /// Angle (rad), speed (rad/s) and acceleration (rad/s²) about the outer ring's centre.
    pub(in crate::dynamics) angle: T,
    pub(in crate::dynamics) omega: T,
    pub(in crate::dynamics) alpha: T,
    /// Path u (m) and its rate (m/s).
    pub(in crate::dynamics) path: T,
    pub(in crate::dynamics) path_rate: T,
    /// Position (m) and velocity (m/s) of the outer ring less that of the inner.
    pub(in crate::dynamics) offset: Vector<T>,
    pub(in crate::dynamics) drift: Vector<T>,
    /// The frames of defects.
    pub(in crate::dynamics) frames: Frames<T>,
    /// Oil films, `None` of dry contacts, and the speed that they follow (rad/s).
    pub(in crate::dynamics) films: Option<FilmsNow>,
    pub(in crate::dynamics) film_speed: T,
    /// Whether derivatives are to know of curvatures along surfaces. Searches of a balance go better without, as an
    /// edge is softer the farther an element has rolled over it.
    pub(in crate::dynamics) curved: bool,
}

/// A small change of what one element meets.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct ElementVariation<T: Scalar = f64> {
    /// Of the outer ring's position less that of the inner.
    pub(in crate::dynamics) offset: Vector<T>,
    /// Of the outer ring's velocity less that of the inner.
    pub(in crate::dynamics) drift: Vector<T>,
    pub(in crate::dynamics) path: T,
    pub(in crate::dynamics) path_rate: T,
    /// Of the element's angle and speed.
    pub(in crate::dynamics) angle: T,
    pub(in crate::dynamics) speed: T,
    /// Of the speed that oil films follow.
    pub(in crate::dynamics) film_speed: T,
    /// Of angle and speed of the frames of defects, in the order of [`Frame`](crate::dynamics::parameters::Frame).
    pub(in crate::dynamics) frames: [[T; 2]; 3],
}

impl<T: Scalar> ElementMotion<T> {
    /// The numbers without their derivatives.
    pub(in crate::dynamics) fn values(&self) -> ElementMotion {
        let plain = |vector: Vector<T>| vector.map(T::value);
        let frame = |turn: Turn<T>| Turn { angle: turn.angle.value(), speed: turn.speed.value() };
        ElementMotion {
            element: self.element,
            e_r: plain(self.e_r),
            e_t: plain(self.e_t),
            angle: self.angle.value(),
            omega: self.omega.value(),
            alpha: self.alpha.value(),
            path: self.path.value(),
            path_rate: self.path_rate.value(),
            offset: plain(self.offset),
            drift: plain(self.drift),
            frames: Frames(self.frames.0.map(frame)),
            films: self.films,
            film_speed: self.film_speed.value(),
            curved: self.curved,
        }
    }

    /// The films with the derivatives of the speed that they follow.
    pub(super) fn oil_films(&self) -> Option<OilFilms<T>> {
        self.films.map(|films| films.following(self.film_speed))
    }

    /// The same positions, nothing moving.
    pub(in crate::dynamics) fn standing(&self) -> Self {
        let none = T::from(0.0);
        let frames = Frames(self.frames.0.map(|turn| Turn { speed: none, ..turn }));
        let drift = Vector::zeros();
        Self { omega: none, alpha: none, path_rate: none, drift, frames, ..*self }
    }

    /// The same for a search.
    pub(in crate::dynamics) fn searched(&self) -> Self {
        Self { curved: false, ..*self }
    }

    /// The same element on its path elsewhere.
    #[inline]
    pub(in crate::dynamics) fn on_path(&self, path: T, path_rate: T) -> Self {
        Self { path, path_rate, ..*self }
    }
}

impl<T: Scalar> Default for ElementVariation<T> {
    fn default() -> Self {
        let none = T::from(0.0);
        Self {
            offset: Vector::zeros(),
            drift: Vector::zeros(),
            path: none,
            path_rate: none,
            angle: none,
            speed: none,
            film_speed: none,
            frames: [[none; 2]; 3],
        }
    }
}

impl<T: Scalar> ElementVariation<T> {
    /// Of the path alone.
    pub(in crate::dynamics) fn of_path() -> Self {
        Self { path: T::from(1.0), ..Self::default() }
    }

    /// Of u' alone.
    pub(in crate::dynamics) fn of_path_rate() -> Self {
        Self { path_rate: T::from(1.0), ..Self::default() }
    }

    /// Of the rings' offset along one axis alone.
    pub(in crate::dynamics) fn of_offset(axis: usize) -> Self {
        let mut offset = Vector::zeros();
        offset[axis] = T::from(1.0);
        Self { offset, ..Self::default() }
    }
}

impl Model {
    /// Element `j` on its path.
    #[inline]
    pub(in crate::dynamics) fn element_motion(
        &self,
        j: usize,
        PathMotion { path, rate: path_rate }: PathMotion,
        now: &FramedKinematics,
        shortcuts: &mut Shortcuts,
    ) -> ElementMotion {
        let lead = self.lead_with(j, now.cage_angle(), &mut shortcuts.leads);
        let (e_r, [omega, alpha]) = (self.direction_with(j, &now.cage, &lead), lead.speed(&now.cage));
        ElementMotion {
            element: j,
            e_r,
            e_t: turned(e_r),
            angle: now.cage.angle + self.element_offset(j) + lead.angle,
            omega,
            alpha,
            path,
            path_rate,
            offset: now.offset(),
            drift: now.drift(),
            frames: now.frames,
            films: now.films,
            film_speed: now.films.map_or(0.0, |films| films.speed()),
            curved: true,
        }
    }
}
