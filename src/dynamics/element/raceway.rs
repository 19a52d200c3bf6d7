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

    /// As [`DampedLaw::pushing`].
    fn pushing(&self, contact: &Contact<T, P>) -> T;
}

/// The law of a contact.
pub(in crate::dynamics) trait Law<T: Number>: Copy {
    /// Force (N) of a contact of this constant at an approach (m) and its rate (m/s).
    fn force(&self, constant: T::Plain, approach: T, closing: T) -> T;
    /// As [`DampedLaw::pushing`].
    fn pushing(&self, approach: T, closing: T) -> T;
}

impl<T: Number<Plain = T>, E: Elastic> Law<T> for DampedLaw<T, E> {
    #[inline(always)]
    fn force(&self, constant: T, approach: T, closing: T) -> T {
        DampedLaw::force(self, constant, approach, closing)
    }

    #[inline(always)]
    fn pushing(&self, approach: T, closing: T) -> T {
        DampedLaw::pushing(self, approach, closing)
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

    #[inline(always)]
    fn pushing(&self, approach: T, closing: T) -> T {
        self.law.pushing(approach, closing)
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

    #[inline(always)]
    fn pushing(&self, contact: &Contact<T, 1>) -> T {
        self.law.pushing(contact.approach, contact.closing)
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

    #[inline(always)]
    fn pushing(&self, contact: &Contact<T, 1>) -> T {
        self.law.pushing(contact.approach, contact.closing)
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
        let ([x, h], [x_rate, h_rate]) = (at.at, at.rate);
        let (groove, number) = (self.groove, |value: f64| x.all(value));
        let (approach, normal) = groove.touch([number(groove.beyond) - x, number(groove.shift) - h]);
        let [n_x, n_h] = normal;
        let closing = -(n_x * x_rate + n_h * h_rate);
        let magnitude = self.law.force(constant, approach, closing);
        let creep = magnitude * (n_x * h_rate - n_h * x_rate) * self.across_damping;
        let force = [magnitude * n_x + creep * n_h, magnitude * n_h - creep * n_x];
        Contact { force, approach, closing, magnitude, normal }
    }

    #[inline(always)]
    fn pushing(&self, contact: &Contact<T, 2>) -> T {
        self.law.pushing(contact.approach, contact.closing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::groove::{Axis, GrooveContact};
    use crate::contact::law::Point;
    use crate::dynamics::element::{Element, Shifted, Tilted, View};
    use crate::scene::{Bearing, Damping};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_ball_in_the_meridian_plane_meets_what_it_meets_in_space(
            [u, v] in prop::array::uniform2(-3e-5..3e-5f64), offset in prop::array::uniform3(-8e-5..8e-5f64),
            drift in prop::array::uniform3(-0.1..0.1f64), rate in prop::array::uniform2(-0.1..0.1f64),
            tilts in any::<bool>(), tilt in prop::array::uniform2(-5e-3..5e-3f64),
            tilting in prop::array::uniform2(-1.0..1.0f64),
        ) {
            let mut bearing = Bearing::steel_balls(12, 7.938e-3, 38.5e-3);
            bearing.set_contact_angle(25f64.to_radians());
            let rho = bearing.outer_raceway_radius() - bearing.element_radius() + u;
            let (omega, damping) = (100.0, Damping::HuntCrossley(0.5));
            let [tilt, tilting] = [tilt, tilting].map(|of| if tilts { of } else { [0.0; 2] });
            let ball = Element { e_r: [1.0, 0.0], at: [u, v], rate, rho, omega };
            let axis = Axis::tilted(tilt, tilting);
            let q = [rho + offset[0], offset[1], v + offset[2]];
            let velocity = axis.velocity(q, [rate[0] + drift[0], rho * omega + drift[1], rate[1] + drift[2]]);
            for groove in &Groove::of(&bearing) {
                let expected = GrooveContact::of(groove, q, &axis);
                let law = DampedLaw::new(damping, Point, |number| number);
                let raceway = GrooveCircle { groove, law, across_damping: 0.5 };
                let (found, along_ring) = if tilts {
                    let view = Tilted::new([offset, drift], tilt, tilting);
                    let (at, seen) = view.see(&ball);
                    let found = raceway.contact(2.5e10, &at);
                    (found, Tilted::along_ring(&ball, &seen, found.force))
                } else {
                    let view = Shifted::<_, 3, false> { offset, drift };
                    let (at, seen) = View::<f64, 2, 5>::see(&view, &ball);
                    let found = raceway.contact(2.5e10, &at);
                    (found, <Shifted<_, 3, false> as View<f64, 2, 5>>::along_ring(&ball, &seen, found.force))
                };
                // Rounding of 20 mm there.
                prop_assert!((found.approach - expected.approach).abs() < 4e-17);
                prop_assert!((found.closing - expected.closing(velocity)).abs() < 1e-11);
                let force = expected.force(found.magnitude, found.magnitude, 0.5, velocity);
                let moment = crate::contact::groove::cross(q, force);
                let expected = [force[0], force[1], force[2], moment[0], moment[1]];
                for (found, expected) in along_ring.into_iter().zip(expected) {
                    prop_assert!((found - expected).abs() <= 1e-11 * force.map(f64::abs).iter().sum::<f64>());
                }
            }
        }
    }
}
