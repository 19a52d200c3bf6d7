//! Normal force of a damped Hertz contact, Q(δ, δ̇).
//!
//! Elastic part K δ^1.5 (Hertz). Damping never pulls:
//! ```text
//! Hunt–Crossley   Q = K δ^1.5 · max(0, 1 + χ δ̇)
//! proportional    Q = max(0, K δ^1.5 + 1.5 τ K δ^0.5 δ̇)
//! both            Q = K √δ max(0, δ + (a δ + b) δ̇),   a = χ, b = 0   or   a = 0, b = 1.5 τ
//! ```
//! Both vanish continuously at δ = 0. Hunt–Crossley is very stiff at high load: χ = 5 s/m at 50 kN gives an eigenvalue
//! of 1e8 /s for a 2 g element.
//!
//! [`DampedLaw`] is the common form, for one contact or for several side by side in a register; [`ForceLaw`] is one contact with
//! its stiffness, and knows derivatives too.

use std::ops::{Add, Mul, Sub};

use crate::numerics::lanes::{Lanes, Wide};
use crate::scene::Damping;

/// Turns the dimensionless factor of Hunt and Crossley's damping into a length of an approach's magnitude [m].
const PUSHING_LENGTH: f64 = 1e-6;

/// A number, or several of them side by side.
pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// √x
    fn sqrt(self) -> Self;
    /// 0 for a negative value. What is no number stays so: a force of zero would hide it.
    fn or_zero(self) -> Self;
    /// The smaller of two.
    fn at_most(self, limit: Self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn or_zero(self) -> Self {
        if self < 0.0 { 0.0 } else { self }
    }

    #[inline(always)]
    fn at_most(self, limit: Self) -> Self {
        self.min(limit)
    }
}

impl<S: Wide> Number for Lanes<S> {
    #[inline(always)]
    fn sqrt(self) -> Self {
        Lanes::sqrt(self)
    }

    #[inline(always)]
    fn or_zero(self) -> Self {
        Lanes::or_zero(self)
    }

    #[inline(always)]
    fn at_most(self, limit: Self) -> Self {
        Lanes::at_most(self, limit)
    }
}

/// How contacts are damped, whatever their stiffness; for single numbers or for lanes.
#[derive(Debug, Clone, Copy)]
pub struct DampedLaw<T> {
    damping: Damping,
    /// a [s/m] and b [s].
    a: T,
    b: T,
    one: T,
    zero: T,
    pushing_length: T,
}

impl<T: Number> DampedLaw<T> {
    /// `splat` makes a `T` of a number.
    #[inline(always)]
    pub fn new(damping: Damping, splat: impl Fn(f64) -> T) -> Self {
        let (a, b) = match damping {
            Damping::HuntCrossley(chi) => (chi, 0.0),
            Damping::Proportional(tau) => (0.0, 1.5 * tau),
        };
        let [a, b, one, zero, pushing_length] = [a, b, 1.0, 0.0, PUSHING_LENGTH].map(splat);
        Self { damping, a, b, one, zero, pushing_length }
    }

    /// Force [N] of a contact of Hertz's constant `stiffness` [N/m^1.5] at approach `delta` [m] and its rate [m/s].
    #[inline(always)]
    pub fn force(&self, stiffness: T, delta: T, rate: T) -> T {
        let delta = delta.or_zero();
        stiffness * delta.sqrt() * (delta + (self.a * delta + self.b) * rate).or_zero()
    }

    /// A length [m] that is positive while the contact pushes and negative while it does not.
    ///
    /// It is continuous in both arguments, so that the moment of change can be located as its root.
    #[inline(always)]
    pub fn pushing(&self, delta: T, rate: T) -> T {
        match self.damping {
            Damping::HuntCrossley(_) => delta.at_most(self.pushing_length * (self.one + self.a * rate)),
            Damping::Proportional(_) => delta + (self.b * rate).at_most(self.zero),
        }
    }
}

/// Force and its derivatives with respect to approach and rate of approach.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Force {
    /// Q [N]
    pub value: f64,
    /// ∂Q/∂δ [N/m]
    pub by_approach: f64,
    /// ∂Q/∂δ̇ [N s/m]
    pub by_rate: f64,
}

/// K δ^1.5 with damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceLaw {
    /// Hertz constant K [N/m^1.5].
    pub stiffness: f64,
    /// Damping of the contact.
    pub damping: Damping,
}

impl ForceLaw {
    /// Elastic force [N] at approach `delta` [m].
    #[inline]
    pub fn elastic(&self, delta: f64) -> f64 {
        let delta = delta.or_zero();
        self.stiffness * delta * delta.sqrt()
    }

    /// Elastic tangent stiffness [N/m] at approach `delta` [m].
    #[inline]
    pub fn elastic_stiffness(&self, delta: f64) -> f64 {
        1.5 * self.stiffness * delta.or_zero().sqrt()
    }

    /// Force [N] at approach `delta` [m] and its rate [m/s].
    #[inline]
    pub fn force(&self, delta: f64, rate: f64) -> f64 {
        self.damped().force(self.stiffness, delta, rate)
    }

    #[inline(always)]
    fn damped(&self) -> DampedLaw<f64> {
        DampedLaw::new(self.damping, |number| number)
    }

    /// Force with its derivatives.
    pub fn with_derivatives(&self, delta: f64, rate: f64) -> Force {
        if self.pushing(delta, rate) <= 0.0 {
            return Force::default();
        }
        let root = self.stiffness * delta.sqrt();
        match self.damping {
            Damping::HuntCrossley(chi) => Force {
                value: root * delta * (1.0 + chi * rate),
                by_approach: 1.5 * root * (1.0 + chi * rate),
                by_rate: chi * root * delta,
            },
            Damping::Proportional(tau) => Force {
                value: root * (delta + 1.5 * tau * rate),
                by_approach: root * (1.5 + 0.75 * tau * rate / delta),
                by_rate: 1.5 * tau * root,
            },
        }
    }

    /// As [`DampedLaw::pushing`].
    #[inline]
    pub fn pushing(&self, delta: f64, rate: f64) -> f64 {
        self.damped().pushing(delta, rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn laws() -> [ForceLaw; 2] {
        [Damping::HuntCrossley(0.5), Damping::Proportional(1e-6)].map(|damping| ForceLaw { stiffness: 1e10, damping })
    }

    proptest! {
        #[test]
        fn a_contact_never_pulls(delta in -1e-4..1e-4f64, rate in -50.0..50.0f64) {
            for law in laws() {
                prop_assert!(law.force(delta, rate) >= 0.0);
            }
        }

        #[test]
        fn force_is_positive_exactly_where_the_contact_pushes(delta in -1e-4..1e-4f64, rate in -50.0..50.0f64) {
            for law in laws() {
                prop_assert_eq!(law.pushing(delta, rate) > 0.0, law.force(delta, rate) > 0.0);
            }
        }

        #[test]
        fn derivatives_equal_difference_quotients(delta in 1e-7..1e-4f64, rate in -1.5..5.0f64) {
            for law in laws() {
                prop_assume!(law.pushing(delta, rate) > 1e-8);
                let force = law.with_derivatives(delta, rate);
                let (d, v) = (1e-5 * delta, 1e-6);
                let by_approach = (law.force(delta + d, rate) - law.force(delta - d, rate)) / (2.0 * d);
                let by_rate = (law.force(delta, rate + v) - law.force(delta, rate - v)) / (2.0 * v);
                // Second-order quotients: relative truncation 1e-10, rounding 1e-16/1e-6.
                prop_assert!((force.value - law.force(delta, rate)).abs() <= 1e-14 * force.value);
                prop_assert!((force.by_approach - by_approach).abs() < 1e-7 * force.by_approach.abs() + 1e-8 * law.elastic_stiffness(delta));
                prop_assert!((force.by_rate - by_rate).abs() < 1e-7 * by_rate.abs());
            }
        }
    }

    #[test]
    fn an_approach_that_is_no_number_gives_no_force_that_is_one() {
        for law in laws() {
            assert!(law.force(f64::NAN, 0.0).is_nan() && law.force(1e-6, f64::NAN).is_nan());
            assert!(law.elastic(f64::NAN).is_nan() && law.elastic_stiffness(f64::NAN).is_nan());
        }
    }

    #[test]
    fn without_damping_the_force_is_hertz() {
        let law = ForceLaw { stiffness: 2e10, damping: Damping::HuntCrossley(0.0) };
        // 2e10 · (1e-5)^1.5 = 632.4555… N
        assert!((law.force(1e-5, 3.0) - 632.455_532_033_675_9).abs() < 1e-9);
    }
}
