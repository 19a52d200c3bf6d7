//! Normal force of a damped elastic contact, Q(δ, δ̇).
//!
//! Elastic part Q_e = S δ with tangent Q_e′ = n S ([`super::elasticity`]): S = K √δ and n = 3/2 for a ball (Hertz),
//! S = K δ^(1/9) and n = 10/9 for a straight roller. Damping never pulls:
//! ```text
//! Hunt–Crossley   Q = Q_e · max(0, 1 + χ δ̇)
//! proportional    Q = max(0, Q_e + τ Q_e′ δ̇)
//! both            Q = S max(0, δ + (χ δ + n τ) δ̇),   τ = 0 or χ = 0
//! ```
//! Both vanish continuously at δ = 0. Hunt–Crossley is very stiff at high load: χ = 5 s/m at 50 kN gives an eigenvalue
//! of 1e8 /s for a 2 g element.
//!
//! [`DampedLaw`] is the common form, for one contact or for several side by side in a register; [`ForceLaw`] is one
//! contact with its stiffness, and knows derivatives too.

use super::elasticity::{Elastic, Elasticity, Line, Point};
use crate::numerics::number::{Number, Scalar};
use crate::scene::Damping;

/// Turns the dimensionless factor of Hunt and Crossley's damping into a length of an approach's magnitude (m).
pub(crate) const PUSHING_LENGTH: f64 = 1e-6;

/// How contacts of one elasticity are damped, whatever their stiffness; for numbers of every kind. Constants are `P`.
#[derive(Debug, Clone, Copy)]
pub struct DampedLaw<P, E = Point> {
    elastic: E,
    damping: Damping,
    /// χ (s/m) and τ (s).
    chi: P,
    tau: P,
}

impl<P: Number, E: Elastic> DampedLaw<P, E> {
    /// `splat` makes a constant of a number.
    #[inline(always)]
    pub fn new(damping: Damping, elastic: E, splat: impl Fn(f64) -> P) -> Self {
        let [chi, tau] = match damping {
            Damping::HuntCrossley(chi) => [chi, 0.0],
            Damping::Proportional(tau) => [0.0, tau],
        };
        Self { elastic, damping, chi: splat(chi), tau: splat(tau) }
    }

    /// Force (N) of a contact of constant `stiffness` (N/m^n) at approach `delta` (m) and its rate (m/s).
    #[inline(always)]
    pub fn force<T: Number<Plain = P>>(&self, stiffness: P, delta: T, rate: T) -> T {
        let delta = delta.or_zero();
        let [secant, order] = self.elastic.secant_and_order(stiffness, delta);
        secant * (delta + (delta * self.chi + order * self.tau) * rate).or_zero()
    }
}

impl<P: Number<Plain = P>, E: Elastic> DampedLaw<P, E> {
    /// What damping adds (N) to an elastic force (N) of this tangent stiffness (N/m) at a rate of approach (m/s).
    #[inline(always)]
    pub fn damping_of(&self, force: P, stiffness: P, rate: P) -> P {
        (self.chi * force + self.tau * stiffness) * rate
    }

    /// A length (m) that is positive while the contact pushes and negative while it does not.
    ///
    /// It is continuous in both arguments, so that the moment of change can be located as its root.
    #[inline(always)]
    pub fn pushing(&self, delta: P, rate: P) -> P {
        match self.damping {
            Damping::HuntCrossley(_) => delta.at_most(delta.all(PUSHING_LENGTH) * (delta.all(1.0) + self.chi * rate)),
            Damping::Proportional(_) => {
                let [_, order] = self.elastic.secant_and_order(delta.all(1.0), delta.or_zero());
                delta + (order * self.tau * rate).at_most(delta.all(0.0))
            }
        }
    }
}

/// An elastic contact with damping.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceLaw {
    /// Constant K of the contact (N/m^n): Hertz's of a point (N/m^1.5), the lamina law's of a line (N/m^(10/9)).
    pub stiffness: f64,
    /// How the force grows with the approach.
    pub elasticity: Elasticity,
    /// Damping of the contact.
    pub damping: Damping,
}

impl ForceLaw {
    /// Elastic force (N) at approach `delta` (m).
    #[inline]
    pub fn elastic<T: Scalar>(&self, delta: T) -> T {
        let (delta, stiffness) = (delta.or_zero(), T::Plain::from(self.stiffness));
        match self.elasticity {
            // The factors in the order in which the results of balls have their bits.
            Elasticity::Point => delta * stiffness * delta.sqrt(),
            _ => self.elasticity.secant_and_order(stiffness, delta)[0] * delta,
        }
    }

    /// Elastic tangent stiffness (N/m) at approach `delta` (m).
    #[inline]
    pub fn elastic_stiffness<T: Scalar>(&self, delta: T) -> T {
        let [secant, order] = self.elasticity.secant_and_order(T::Plain::from(self.stiffness), delta.or_zero());
        order * secant
    }

    /// Elastic tangent stiffness (N/m) under an elastic force (N); of a ball 1.5 K^⅔ Q^⅓.
    pub fn stiffness_under(&self, force: f64) -> f64 {
        match self.elasticity {
            Elasticity::Point => 1.5 * libm::cbrt(self.stiffness * self.stiffness * force),
            _ => self.elastic_stiffness(self.approach_under(force)),
        }
    }

    /// The approach (m) at which the elastic force is `force` (N), by Newton's method from above: the force is convex.
    pub fn approach_under(&self, force: f64) -> f64 {
        // A straight roller's approach and the crown's mean depth together are too much, as a convex force's mean over
        // the laminae is above the force at their mean.
        let mut delta = match &self.elasticity {
            Elasticity::Point => return libm::pow(force / self.stiffness, 2.0 / 3.0),
            Elasticity::Line => return libm::pow(force / self.stiffness, 0.9),
            Elasticity::Crowned(crown) => libm::pow(force / self.stiffness, 0.9) + crown.mean_depth(),
        };
        for _ in 0..200 {
            let next = delta - (self.elastic(delta) - force) / self.elastic_stiffness(delta);
            let settled = (next - delta).abs() <= 2.0 * f64::EPSILON * delta;
            delta = next;
            if settled {
                break;
            }
        }
        delta
    }

    /// Force (N) at approach `delta` (m) and its rate (m/s).
    #[inline(always)]
    pub fn force<T: Scalar>(&self, delta: T, rate: T) -> T {
        match self.elasticity.line() {
            None => self.force_of(Point, delta, rate),
            Some(line) => self.line_force(line, delta, rate),
        }
    }

    /// Not inlined: with it balls' steps would be too large to be inlined, and lose the instructions of the machine
    /// they run on.
    #[inline(never)]
    fn line_force<T: Scalar>(&self, line: Line<'_>, delta: T, rate: T) -> T {
        self.force_of(line, delta, rate)
    }

    #[inline(always)]
    fn force_of<T: Scalar>(&self, elastic: impl Elastic, delta: T, rate: T) -> T {
        DampedLaw::new(self.damping, elastic, T::Plain::from).force(T::Plain::from(self.stiffness), delta, rate)
    }

    /// As [`DampedLaw::pushing`].
    #[inline(always)]
    pub fn pushing(&self, delta: f64, rate: f64) -> f64 {
        match self.elasticity.line() {
            None => DampedLaw::new(self.damping, Point, |number| number).pushing(delta, rate),
            Some(line) => self.line_pushing(line, delta, rate),
        }
    }

    #[inline(never)]
    fn line_pushing(&self, line: Line<'_>, delta: f64, rate: f64) -> f64 {
        DampedLaw::new(self.damping, line, |number| number).pushing(delta, rate)
    }
}
