//! Normal force of a damped Hertz contact, Q(δ, δ̇).
//!
//! Elastic part K δ^1.5 (Hertz). Damping never pulls:
//! ```text
//! Hunt–Crossley   Q = K δ^1.5 · max(0, 1 + χ δ̇)
//! proportional    Q = max(0, K δ^1.5 + 1.5 τ K δ^0.5 δ̇)
//! ```
//! Both vanish continuously at δ = 0. Hunt–Crossley is very stiff at high load: χ = 5 s/m at 50 kN gives an eigenvalue
//! of 1e8 /s for a 2 g element.
//!
//! A linear compliance c in series ([`super::series`]) leaves the contact a part δ of the approach Δ. The damper belongs
//! to the contact alone. The contact closes at s Δ̇, s = dδ/dΔ, and of what its damper exerts the share s reaches the
//! outside, the rest being taken back by the spring that it stretches; so the force is that of the contact at (δ, s² Δ̇).
//! Work lost per time is the damper's own, c_d (s Δ̇)². This holds to first order in the damping force; a massless node
//! between damper and compliance would need a state of its own.

use super::series;
use crate::scene::Damping;

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

/// K δ^1.5 with damping, in series with a linear compliance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceLaw {
    /// Hertz constant K [N/m^1.5].
    pub stiffness: f64,
    /// Damping of the contact.
    pub damping: Damping,
    /// Compliance c in series [m/N]; 0 for none.
    pub compliance: f64,
}

impl ForceLaw {
    /// Elastic force [N] at approach `delta` [m].
    #[inline]
    pub fn elastic(&self, delta: f64) -> f64 {
        let delta = self.of_contact(delta, 0.0).0.max(0.0);
        self.stiffness * delta * delta.sqrt()
    }

    /// Elastic tangent stiffness [N/m] at approach `delta` [m].
    #[inline]
    pub fn elastic_stiffness(&self, delta: f64) -> f64 {
        let alone = |delta: f64| 1.5 * self.stiffness * delta.max(0.0).sqrt();
        if self.compliance == 0.0 || delta <= 0.0 {
            return alone(delta);
        }
        let part = series::part(delta, self.stiffness, self.compliance);
        alone(part.approach) * part.share
    }

    /// Force [N] at approach `delta` [m] and its rate [m/s].
    #[inline]
    pub fn force(&self, delta: f64, rate: f64) -> f64 {
        let (delta, rate) = self.of_contact(delta, rate);
        let delta = delta.max(0.0);
        let root = self.stiffness * delta.sqrt();
        match self.damping {
            Damping::HuntCrossley(chi) => root * delta * (1.0 + chi * rate).max(0.0),
            Damping::Proportional(tau) => root * (delta + 1.5 * tau * rate).max(0.0),
        }
    }

    /// Force with its derivatives.
    pub fn with_derivatives(&self, delta: f64, rate: f64) -> Force {
        if self.compliance == 0.0 || delta <= 0.0 {
            return self.contact_alone(delta, rate);
        }
        let series::Part { approach, share } = series::part(delta, self.stiffness, self.compliance);
        let alone = self.contact_alone(approach, share * share * rate);
        // s = 1/(1 + c k) falls as the contact hardens: ds/dΔ = −s³ c dk/dδ.
        let share_by_approach = -share * share * share * self.compliance * 0.75 * self.stiffness / approach.sqrt();
        Force {
            value: alone.value,
            by_approach: share * (alone.by_approach + alone.by_rate * 2.0 * rate * share_by_approach),
            by_rate: alone.by_rate * share * share,
        }
    }

    /// The contact's own approach [m] and the rate [m/s] at which its damper acts, of those of the whole.
    #[inline]
    fn of_contact(&self, delta: f64, rate: f64) -> (f64, f64) {
        if self.compliance == 0.0 || delta <= 0.0 {
            return (delta, rate);
        }
        let part = series::part(delta, self.stiffness, self.compliance);
        (part.approach, part.share * part.share * rate)
    }

    /// Force of the contact alone with its derivatives.
    fn contact_alone(&self, delta: f64, rate: f64) -> Force {
        if self.pushing_alone(delta, rate) <= 0.0 {
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
        let (delta, rate) = self.of_contact(delta, rate);
        self.pushing_alone(delta, rate)
    }

    #[inline]
    fn pushing_alone(&self, delta: f64, rate: f64) -> f64 {
        match self.damping {
            Damping::HuntCrossley(chi) => {
                // One micrometre turns the dimensionless factor into a length of the approach's magnitude.
                const LENGTH: f64 = 1e-6;
                delta.min(LENGTH * (1.0 + chi * rate))
            }
            Damping::Proportional(tau) => delta + (1.5 * tau * rate).min(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn laws() -> impl Iterator<Item = ForceLaw> {
        let dampings = [Damping::HuntCrossley(0.5), Damping::Proportional(1e-6)];
        let compliances = [0.0, 1e-9, 3e-7];
        dampings
            .into_iter()
            .flat_map(move |damping| compliances.map(|compliance| ForceLaw { stiffness: 1e10, damping, compliance }))
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
                let (d, v) = (1e-5 * delta, 1e-3);
                let by_approach = (law.force(delta + d, rate) - law.force(delta - d, rate)) / (2.0 * d);
                let by_rate = (law.force(delta, rate + v) - law.force(delta, rate - v)) / (2.0 * v);
                // Second-order quotients: relative truncation 1e-10, rounding 1e-16/1e-5; the force is linear in the rate.
                prop_assert!((force.value - law.force(delta, rate)).abs() <= 1e-14 * force.value);
                prop_assert!((force.by_approach - by_approach).abs() < 1e-7 * force.by_approach.abs() + 1e-8 * law.elastic_stiffness(delta));
                prop_assert!((force.by_rate - by_rate).abs() < 1e-7 * by_rate.abs());
            }
        }
    }

    #[test]
    fn without_damping_the_force_is_hertz() {
        let law = ForceLaw { stiffness: 2e10, damping: Damping::HuntCrossley(0.0), compliance: 0.0 };
        // 2e10 · (1e-5)^1.5 = 632.4555… N
        assert!((law.force(1e-5, 3.0) - 632.455_532_033_675_9).abs() < 1e-9);
    }

    #[test]
    fn without_compliance_no_bit_is_other_than_the_contacts() {
        let law = ForceLaw { stiffness: 2.929e10, damping: Damping::HuntCrossley(0.5), compliance: 0.0 };
        for (delta, rate) in [(3.7e-6, 0.013), (1.1e-5, -0.4), (-2e-6, 1.0), (0.0, 0.0)] {
            let squeezed = f64::max(delta, 0.0);
            let root = 2.929e10 * squeezed.sqrt();
            let factor: f64 = 1.0 + 0.5 * rate;
            assert_eq!(law.force(delta, rate).to_bits(), (root * squeezed * factor.max(0.0)).to_bits());
            assert_eq!(law.elastic(delta).to_bits(), (2.929e10 * squeezed * squeezed.sqrt()).to_bits());
            assert_eq!(law.elastic_stiffness(delta).to_bits(), (1.5 * 2.929e10 * squeezed.sqrt()).to_bits());
        }
    }

    #[test]
    fn a_compliance_takes_its_linear_part_of_the_approach() {
        let law = ForceLaw { stiffness: 2e10, damping: Damping::HuntCrossley(0.0), compliance: 1e-8 };
        // 632.4555… N over 10 µm in the contact and 6.324555… µm in the compliance; printed digits.
        assert!((law.elastic(16.324_555_320_336_76e-6) - 632.455_532_033_675_9).abs() < 1e-9);
        let (contact, compliance) = (1.0 / (1.5 * 632.455_532_033_675_9 / 1e-5), 1e-8);
        assert!((law.elastic_stiffness(16.324_555_320_336_76e-6) * (contact + compliance) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn damping_through_a_compliance_is_that_of_the_contacts_own_damper() {
        for damping in [Damping::HuntCrossley(0.5), Damping::Proportional(1e-6)] {
            for compliance in [1e-9, 1e-8, 3e-7] {
                let alone = ForceLaw { stiffness: 2e10, damping, compliance: 0.0 };
                let law = ForceLaw { compliance, ..alone };
                let (total, rate) = (3e-5, 1e-5);
                let share = series::part(total, alone.stiffness, compliance).share;
                // Contact and damper against the spring: δ from the balance of forces at the contact's own rate.
                let (mut low, mut high) = (0.0, total);
                for _ in 0..100 {
                    let middle = 0.5 * (low + high);
                    let excess = alone.force(middle, share * rate) - (total - middle) / compliance;
                    if excess < 0.0 { low = middle } else { high = middle }
                }
                let damped = (total - low) / compliance - law.elastic(total);
                // Second order in χδ̇ or τδ̇/δ, 1e-5 or less; the difference itself keeps about four digits.
                let expected = law.force(total, rate) - law.elastic(total);
                assert!(
                    (damped / expected - 1.0).abs() < 1e-3,
                    "{damping:?} {compliance}: {damped} against {expected}"
                );
            }
        }
    }
}
