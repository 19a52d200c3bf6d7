//! Normal force of a damped Hertz contact, Q(δ, δ̇).
//!
//! Elastic part K δ^1.5 (Hertz). Damping never pulls:
//! ```text
//! Hunt–Crossley   Q = K δ^1.5 · max(0, 1 + χ δ̇)
//! proportional    Q = max(0, K δ^1.5 + 1.5 τ K δ^0.5 δ̇)
//! ```
//! Both vanish continuously at δ = 0. Hunt–Crossley is very stiff at high load: χ = 5 s/m at 50 kN gives an eigenvalue
//! of 1e8 /s for a 2 g element.

use crate::scene::Damping;

/// Turns the dimensionless factor of Hunt and Crossley's damping into a length of an approach's magnitude [m].
pub(crate) const PUSHING_LENGTH: f64 = 1e-6;

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
        let delta = or_zero(delta);
        self.stiffness * delta * delta.sqrt()
    }

    /// Elastic tangent stiffness [N/m] at approach `delta` [m].
    #[inline]
    pub fn elastic_stiffness(&self, delta: f64) -> f64 {
        1.5 * self.stiffness * or_zero(delta).sqrt()
    }

    /// Force [N] at approach `delta` [m] and its rate [m/s].
    #[inline]
    pub fn force(&self, delta: f64, rate: f64) -> f64 {
        let delta = or_zero(delta);
        let root = self.stiffness * delta.sqrt();
        match self.damping {
            Damping::HuntCrossley(chi) => root * delta * or_zero(1.0 + chi * rate),
            Damping::Proportional(tau) => root * or_zero(delta + 1.5 * tau * rate),
        }
    }

    /// a and b with which both damping laws are Q = K √δ max(0, δ + (a δ + b) δ̇), a in s/m and b in s.
    #[inline]
    pub fn damping_weights(&self) -> [f64; 2] {
        match self.damping {
            Damping::HuntCrossley(chi) => [chi, 0.0],
            Damping::Proportional(tau) => [0.0, 1.5 * tau],
        }
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

    /// A length [m] that is positive while the contact pushes and negative while it does not.
    ///
    /// It is continuous in both arguments, so that the moment of change can be located as its root.
    #[inline]
    pub fn pushing(&self, delta: f64, rate: f64) -> f64 {
        match self.damping {
            Damping::HuntCrossley(chi) => delta.min(PUSHING_LENGTH * (1.0 + chi * rate)),
            Damping::Proportional(tau) => delta + (1.5 * tau * rate).min(0.0),
        }
    }
}

/// 0 for a negative value. What is no number stays so: a force of zero would hide it.
#[inline]
fn or_zero(value: f64) -> f64 {
    if value < 0.0 { 0.0 } else { value }
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
