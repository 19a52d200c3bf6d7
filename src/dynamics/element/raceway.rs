//! A smooth raceway in the meridian plane: what it does to an element there.
//!
//! ```text
//! circle    δ = x outside, −G − x inside                                                 no h
//! groove    s = k − x   d = √(s² + (ζ − h)²)   δ = d − l   n = (s, ζ − h)/d   t = (−n_h, n_x)
//!           F = Q n − χ_a Q (t·v) t            v = (ẋ, ḣ)
//! ```
//! k is the distance of the circle of groove centres beyond R_o − r, l_i − G inside and −l_o outside. Beyond 90° from
//! the groove's bottom there is no steel (see [`crate::contact::groove`]).

use super::Meridian;
use crate::contact::groove::Groove;
use crate::contact::law::{DampedLaw, Elastic, SqueezeFilm};
use crate::numerics::number::Number;

/// What a raceway does to an element.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Contact<T, const P: usize> {
    /// Force on the element (N) away from the ring's axis, and along it.
    pub(in crate::dynamics) force: [T; P],
    /// Approach δ (m) and its rate (m/s).
    pub(in crate::dynamics) approach: T,
    pub(in crate::dynamics) closing: T,
    /// Force Q along the normal (N).
    pub(in crate::dynamics) magnitude: T,
    /// Direction of Q.
    pub(in crate::dynamics) normal: [T; P],
}

/// A raceway whose contact has this constant K (N/m^n).
pub(in crate::dynamics) trait Raceway<T: Number, const P: usize>: Copy {
    /// The same for an element whose diameter is so much larger (m).
    fn beside(self, larger: T) -> Self;

    /// The contact of an element there.
    fn contact(&self, constant: T::Plain, at: &Meridian<T, P>) -> Contact<T, P>;
}

/// The law of a contact.
pub(in crate::dynamics) trait Law<T: Number>: Copy {
    /// Force (N) of a contact of this constant at an approach (m) and its rate (m/s).
    fn force(&self, constant: T::Plain, approach: T, closing: T) -> T;
}

impl<T: Number, E: Elastic> Law<T> for DampedLaw<T::Plain, E> {
    #[inline(always)]
    fn force(&self, constant: T::Plain, approach: T, closing: T) -> T {
        DampedLaw::force(self, constant, approach, closing)
    }
}

/// A law with the film between the surfaces.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Filmed<L, T> {
    pub(in crate::dynamics) law: L,
    pub(in crate::dynamics) film: Option<SqueezeFilm<T>>,
}

impl<T: Number<Plain = T>, L: Law<T>> Law<T> for Filmed<L, T> {
    #[inline(always)]
    fn force(&self, constant: T, approach: T, closing: T) -> T {
        let dry = self.law.force(constant, approach, closing);
        let Some(film) = &self.film else { return dry };
        // Constants of contacts are far above 1, or 0 for what is no smooth contact.
        dry + constant.at_most(constant.all(1.0)) * film.force(approach, closing)
    }
}

/// The inner raceway of elements that stay in their plane, which this clearance (m) separates from an element on the
/// outer one.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Inside<T, L> {
    pub(in crate::dynamics) clearance: T,
    pub(in crate::dynamics) law: L,
}

/// Their outer raceway.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Outside<L> {
    pub(in crate::dynamics) law: L,
}

impl<T: Number, L: Law<T>> Raceway<T, 1> for Inside<T, L> {
    #[inline(always)]
    fn beside(self, larger: T) -> Self {
        Self { clearance: self.clearance - larger, ..self }
    }

    #[inline(always)]
    fn contact(&self, constant: T::Plain, at: &Meridian<T, 1>) -> Contact<T, 1> {
        let (approach, closing) = (-self.clearance - at.at[0], -at.rate[0]);
        let magnitude = self.law.force(constant, approach, closing);
        Contact { force: [magnitude], approach, closing, magnitude, normal: [approach.all(1.0)] }
    }
}

impl<T: Number, L: Law<T>> Raceway<T, 1> for Outside<L> {
    #[inline(always)]
    fn beside(self, _: T) -> Self {
        self
    }

    #[inline(always)]
    fn contact(&self, constant: T::Plain, at: &Meridian<T, 1>) -> Contact<T, 1> {
        let (approach, closing) = (at.at[0], at.rate[0]);
        let magnitude = self.law.force(constant, approach, closing);
        Contact { force: [-magnitude], approach, closing, magnitude, normal: [approach.all(-1.0)] }
    }
}

/// Where a ball touches a groove, in the meridian plane.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Touch<T> {
    /// δ (m) and its rate (m/s).
    pub(in crate::dynamics) approach: T,
    pub(in crate::dynamics) closing: T,
    /// n
    pub(in crate::dynamics) normal: [T; 2],
    /// t·v (m/s)
    pub(in crate::dynamics) sliding: T,
}

impl<T: Number> Touch<T> {
    #[inline(always)]
    pub(in crate::dynamics) fn of(groove: &Groove, at: &Meridian<T, 2>) -> Self {
        let ([x, h], [x_rate, h_rate]) = (at.at, at.rate);
        let number = |value: f64| x.all(value);
        let (approach, normal) = groove.touch([number(groove.beyond) - x, number(groove.shift) - h]);
        let [n_x, n_h] = normal;
        let (closing, sliding) = (-(n_x * x_rate + n_h * h_rate), n_x * h_rate - n_h * x_rate);
        Self { approach, closing, normal, sliding }
    }

    /// A force (N) along n, and one against t.
    #[inline(always)]
    pub(in crate::dynamics) fn exerts(&self, force: T, against: T) -> [T; 2] {
        let [n_x, n_h] = self.normal;
        [force * n_x + against * n_h, force * n_h - against * n_x]
    }
}

/// The groove of balls that move along the axis too.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct GrooveCircle<'a, P, L> {
    pub(in crate::dynamics) groove: &'a Groove,
    pub(in crate::dynamics) law: L,
    /// χ_a (s/m)
    pub(in crate::dynamics) across_damping: P,
}

impl<T: Number, L: Law<T>> Raceway<T, 2> for GrooveCircle<'_, T::Plain, L> {
    /// Balls in space are equal.
    #[inline(always)]
    fn beside(self, _: T) -> Self {
        self
    }

    #[inline(always)]
    fn contact(&self, constant: T::Plain, at: &Meridian<T, 2>) -> Contact<T, 2> {
        let touch @ Touch { approach, closing, normal, .. } = Touch::of(self.groove, at);
        let magnitude = self.law.force(constant, approach, closing);
        let force = touch.exerts(magnitude, magnitude * touch.sliding * self.across_damping);
        Contact { force, approach, closing, magnitude, normal }
    }
}

#[cfg(test)]
mod tests;
