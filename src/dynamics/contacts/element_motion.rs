//! What one element meets at an instant: where it is, how it moves, and how all that it touches does. In numbers of any
//! kind, so that a change of any of it is followed through the contacts by the one text there is of them.

use super::shortcuts::Shortcuts;
use crate::dynamics::parameters::{FilmsNow, FramedKinematics, Frames, Model, OilFilms, PathMotion, Turn};
use crate::numerics::number::{Dual, Scalar};
use crate::numerics::plane::{Vector, turned};

/// One element and what it meets. Its directions may be constants beside numbers with derivatives: most products are
/// with them, and cost a third then.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct ElementMotion<T: Scalar = f64, E: Scalar = T> {
    /// The element, from 0.
    pub(in crate::dynamics) element: usize,
    /// Radial direction, and the one counter-clockwise of it.
    pub(in crate::dynamics) e_r: Vector<E>,
    pub(in crate::dynamics) e_t: Vector<E>,
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

impl<T: Scalar> ElementMotion<T> {
    /// The same in numbers of another kind.
    #[inline(always)]
    pub(in crate::dynamics) fn mapped<U: Scalar>(&self, number: impl Fn(T) -> U) -> ElementMotion<U> {
        self.mapped_both(&number, &number)
    }

    /// The same in numbers of another kind, and its directions in those of one more.
    #[inline(always)]
    fn mapped_both<U: Scalar, E: Scalar>(
        &self,
        number: impl Fn(T) -> U,
        direction: impl Fn(T) -> E,
    ) -> ElementMotion<U, E> {
        let vector = |vector: Vector<T>| vector.map(&number);
        ElementMotion {
            element: self.element,
            e_r: self.e_r.map(&direction),
            e_t: self.e_t.map(&direction),
            angle: number(self.angle),
            omega: number(self.omega),
            alpha: number(self.alpha),
            path: number(self.path),
            path_rate: number(self.path_rate),
            offset: vector(self.offset),
            drift: vector(self.drift),
            frames: self.frames.mapped(&number),
            films: self.films,
            film_speed: number(self.film_speed),
            curved: self.curved,
        }
    }

    /// The same as its path changes, the first of `K` directions.
    #[inline(always)]
    pub(in crate::dynamics) fn by_path<const K: usize>(&self) -> ElementMotion<Dual<T, K>, T> {
        let path = Dual::variable(self.path, 0);
        ElementMotion { path, ..self.mapped_both(Dual::constant, |direction| direction) }
    }

    /// The same by its path, and by time as all else goes on while the path stands.
    #[inline(always)]
    pub(in crate::dynamics) fn by_path_and_time(&self) -> ElementMotion<Dual<T, 2>> {
        let going = |value: T, rate: T| Dual { value, by: [T::from(0.0), rate] };
        let along = |vector: Vector<T>, rate: Vector<T>| vector.zip_map(&rate, going);
        ElementMotion {
            e_r: along(self.e_r, self.e_t * self.omega),
            e_t: along(self.e_t, self.e_r * -self.omega),
            angle: going(self.angle, self.omega),
            omega: going(self.omega, self.alpha),
            offset: along(self.offset, self.drift),
            frames: Frames(
                self.frames
                    .0
                    .map(|turn| Turn { angle: going(turn.angle, turn.speed), speed: Dual::constant(turn.speed) }),
            ),
            path: Dual::variable(self.path, 0),
            ..self.mapped(Dual::constant)
        }
    }

    /// The films with the derivatives of the speed that they follow.
    pub(super) fn oil_films(&self) -> Option<OilFilms<T>> {
        self.films.map(|films| films.following(self.film_speed))
    }

    /// The same positions, nothing moving.
    pub(in crate::dynamics) fn standing(&self) -> Self {
        let none = T::from(0.0);
        let (drift, frames) = (Vector::zeros(), self.frames.at_rest());
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
