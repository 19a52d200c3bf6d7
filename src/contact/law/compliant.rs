//! A contact in series with a linear compliance: how much of the approach is the contact's own.
//!
//! The raceway yields by cQ under a contact that carries Q, so an approach Δ of element and undeformed raceway is
//! ```text
//! Δ = δ + c Q(δ),   Q = K δ^1.5 for a ball
//! ```
//! For a roller that is solved by Newton's method from δ = Δ on, which goes down to the root, Q being convex. For a
//! ball, with δ = Δ/z² and β = c K √Δ this is the cubic z³ − z = β, which has one root z ≥ 1. Its left side is convex
//! there, so Newton's method converges from any z ≥ 1; from the starts below four steps reach rounding for every β.
//!
//! The share of a small change of Δ that the contact takes is s = dδ/dΔ = 1/(1 + c k) with its tangent stiffness
//! k = 1.5 K √δ: c k = 1.5 β/z.
//!
//! The damper belongs to the contact alone. The contact closes at s Δ̇, and of what its damper exerts the share s
//! reaches the outside, the rest being taken back by the spring that it stretches; so the force is that of the contact
//! at (δ, s² Δ̇). Work lost per time is the damper's own, c_d (s Δ̇)². This holds to first order in the damping force;
//! a massless node between damper and compliance would need a state of its own.
//!
//! The compliance is local: a contact does not move its neighbours. A real ring bends between its elements as well, so
//! c is a measure of an assembly's softness and not a ring's flexibility. Near a defect Δ is the equivalent approach of
//! the contact law, and the raceway yields along the contact's direction.

use super::elasticity::Elasticity;
use super::force_law::ForceLaw;
use crate::numerics::number::Scalar;

/// Most of Newton's steps. Where the compliance takes nearly all, each leaves a tenth of the approach; then they double
/// the digits.
const ITERATIONS: u32 = 50;

/// A damped contact in series with a linear compliance.
#[derive(Debug, Clone, PartialEq)]
pub struct CompliantContact {
    /// The contact.
    pub law: ForceLaw,
    /// Compliance c (m/N); 0 for none, which leaves every bit the contact's own.
    pub compliance: f64,
}

impl CompliantContact {
    /// The contact's own approach (m) and the rate (m/s) at which its damper acts, of those of the whole.
    #[inline(always)]
    pub fn of_contact<T: Scalar>(&self, delta: T, rate: T) -> (T, T) {
        if self.compliance == 0.0 || delta.value() <= 0.0 {
            return (delta, rate);
        }
        let Part { approach, share } = self.part_of(delta);
        (approach, share * share * rate)
    }

    /// Elastic force (N) at approach `delta` (m).
    pub fn elastic(&self, delta: f64) -> f64 {
        self.law.elastic(self.of_contact(delta, 0.0).0)
    }

    /// Elastic tangent stiffness (N/m) at approach `delta` (m).
    pub fn elastic_stiffness(&self, delta: f64) -> f64 {
        if self.compliance == 0.0 || delta <= 0.0 {
            return self.law.elastic_stiffness(delta);
        }
        let part = self.part(delta);
        self.law.elastic_stiffness(part.approach) * part.share
    }

    /// Force (N) at approach `delta` (m) and its rate (m/s).
    #[inline(always)]
    pub fn force<T: Scalar>(&self, delta: T, rate: T) -> T {
        let (delta, rate) = self.of_contact(delta, rate);
        self.law.force(delta, rate)
    }

    /// As [`ForceLaw::pushing`].
    pub fn pushing(&self, delta: f64, rate: f64) -> f64 {
        let (delta, rate) = self.of_contact(delta, rate);
        self.law.pushing(delta, rate)
    }
}

impl CompliantContact {
    /// As [`Self::part`], with derivatives where the approach has them.
    #[inline(always)]
    fn part_of<T: Scalar>(&self, total: T) -> Part<T> {
        let Part { approach: root, share } = self.part(total.value());
        if T::DEPTH == 0 {
            return Part { approach: T::from(root), share: T::from(share) };
        }
        let compliance = T::Plain::from(self.compliance);
        let excess = |approach: T| approach + self.law.elastic(approach) * compliance - total;
        let approach = T::root_of(root, 1.0 / share, excess);
        let softer = self.law.elastic_stiffness(approach) * compliance + T::from(1.0);
        Part { approach, share: T::from(1.0) / softer }
    }

    /// The part of the approach `total` > 0 (m) that the contact takes.
    #[inline(always)]
    fn part(&self, total: f64) -> Part<f64> {
        match self.law.elasticity {
            Elasticity::Point => part(total, self.law.stiffness, self.compliance),
            _ => self.part_of_line(total),
        }
    }

    /// As [`Self::part`], of a line contact. Not inlined: with it balls' steps would be too large to be inlined, and
    /// lose the instructions of the machine they run on.
    #[inline(never)]
    fn part_of_line(&self, total: f64) -> Part<f64> {
        let mut approach = total;
        for _ in 0..ITERATIONS {
            let excess = approach + self.compliance * self.law.elastic(approach) - total;
            let slope = 1.0 + self.compliance * self.law.elastic_stiffness(approach);
            let next = approach - excess / slope;
            // A crown's table is convex except for roundings, so a step may lead up again, and the next one down.
            let settled = (next - approach).abs() <= 16.0 * f64::EPSILON * next;
            approach = next;
            if settled {
                break;
            }
        }
        Part { approach, share: 1.0 / (1.0 + self.compliance * self.law.elastic_stiffness(approach)) }
    }
}

/// The contact's part of an approach.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Part<T> {
    /// δ (m).
    approach: T,
    /// s = dδ/dΔ, between 0 and 1.
    share: T,
}

/// The part of the approach `total` ≥ 0 (m) that a contact of Hertz constant `stiffness` (N/m^1.5) takes in series with
/// `compliance` (m/N).
#[inline(always)]
fn part(total: f64, stiffness: f64, compliance: f64) -> Part<f64> {
    let beta = compliance * stiffness * total.sqrt();
    let z = root(beta);
    Part { approach: total / (z * z), share: 1.0 / (1.0 + 1.5 * beta / z) }
}

/// The root z ≥ 1 of z³ − z = β for β ≥ 0.
#[inline(always)]
fn root(beta: f64) -> f64 {
    // The first is exact to second order at 0, the second to second order at infinity; neither is off by more than
    // 0.04.
    let mut z = if beta < 1.0 {
        1.0 + beta / (2.0 + 1.5 * beta)
    } else {
        let cube_root = libm::cbrt(beta);
        cube_root + 1.0 / (3.0 * cube_root)
    };
    for _ in 0..4 {
        let square = z * z;
        z = (2.0 * square * z + beta) / (3.0 * square - 1.0);
    }
    z
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::law::crown::Crown;
    use crate::numerics::number::Dual;
    use crate::scene::Damping;
    use proptest::prelude::*;
    use std::sync::{Arc, LazyLock};

    static CONTACTS: LazyLock<Vec<CompliantContact>> = LazyLock::new(|| {
        let dampings = [Damping::HuntCrossley(0.5), Damping::Proportional(1e-6)];
        let contacts = dampings.into_iter().flat_map(|damping| {
            let point = ForceLaw { stiffness: 1e10, elasticity: Elasticity::Point, damping };
            let depths: Vec<f64> = (0..40).map(|k| 4e-6 * (f64::from(2 * k - 39) / 40.0).powi(4)).collect();
            let elasticity = Elasticity::Crowned(Arc::new(Crown::new(&depths)));
            let crowned = ForceLaw { stiffness: 1e9, elasticity, damping };
            let line = ForceLaw { elasticity: Elasticity::Line, ..crowned.clone() };
            let softness = [0.0, 1e-9, 1e-8, 3e-7];
            [point, line, crowned]
                .into_iter()
                .flat_map(move |law| softness.map(|compliance| CompliantContact { law: law.clone(), compliance }))
        });
        contacts.collect()
    });

    /// δ by bisection of the defining relation.
    fn bisected(total: f64, stiffness: f64, compliance: f64) -> f64 {
        let (mut low, mut high) = (0.0, total);
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return middle;
            }
            if middle + compliance * stiffness * middle * middle.sqrt() < total { low = middle } else { high = middle }
        }
    }

    proptest! {
        #[test]
        fn the_part_solves_the_series_relation(exponent in -12.0..-3.0f64, compliance in -12.0..-4.0f64) {
            let (total, compliance, stiffness) = (10f64.powf(exponent), 10f64.powf(compliance), 3e10);
            let found = part(total, stiffness, compliance).approach;
            let direct = bisected(total, stiffness, compliance);
            // A handful of roundings on either side.
            prop_assert!((found / direct - 1.0).abs() < 4e-15, "{found} against {direct}");
        }

        #[test]
        fn force_is_positive_exactly_where_the_contact_pushes(delta in -1e-4..1e-4f64, rate in -50.0..50.0f64) {
            for law in &*CONTACTS {
                prop_assert!(law.force(delta, rate) >= 0.0);
                prop_assert_eq!(law.pushing(delta, rate) > 0.0, law.force(delta, rate) > 0.0);
            }
        }

        #[test]
        fn derivatives_equal_difference_quotients(delta in 1e-7..1e-4f64, rate in -1.5..5.0f64) {
            for law in &*CONTACTS {
                prop_assume!(law.pushing(delta, rate) > 1e-8);
                let dual = Dual::<f64, 2>::variable;
                let force = law.force(dual(delta, 0), dual(rate, 1));
                let crowned = matches!(law.law.elasticity, Elasticity::Crowned(_));
                // A crown's second derivative jumps where a step of its table ends, felt less by short differences.
                let (d, v) = (if crowned { 1e-6 } else { 1e-5 } * delta, 1e-3);
                let by_approach = (law.force(delta + d, rate) - law.force(delta - d, rate)) / (2.0 * d);
                let by_rate = (law.force(delta, rate + v) - law.force(delta, rate - v)) / (2.0 * v);
                // Truncation 1e-10, rounding 1e-16/1e-5; the force is linear in the rate.
                prop_assert!((force.value - law.force(delta, rate)).abs() <= 1e-14 * force.value);
                let limit = if crowned { 1e-3 } else { 1e-7 };
                let unit = by_approach.abs() + 0.1 * law.elastic_stiffness(delta);
                // On the step itself, where damping has the elastic force's slope, the derivative is one side's, and
                // the quotient lies between both.
                let ends = if crowned && law.compliance > 0.0 { [delta - d, delta + d] } else { [delta; 2] };
                let [a, b] = ends.map(|delta| law.force(dual(delta, 0), dual(rate, 1)).by[0]);
                prop_assert!(a.min(b) - limit * unit < by_approach && by_approach < a.max(b) + limit * unit);
                prop_assert!((force.by[1] - by_rate).abs() < 1e-7 * by_rate.abs());
                let elastic = (law.elastic(delta + d) - law.elastic(delta - d)) / (2.0 * d);
                let limit = if crowned { 1e-3 } else { 1e-9 };
                prop_assert!((law.elastic_stiffness(delta) / elastic - 1.0).abs() < limit);
            }
        }

        #[test]
        fn the_share_is_the_slope_of_the_part(exponent in -9.0..-3.0f64, compliance in -12.0..-5.0f64) {
            let (total, compliance, stiffness) = (10f64.powf(exponent), 10f64.powf(compliance), 3e10);
            let at = |total| part(total, stiffness, compliance).approach;
            let step = 1e-5 * total;
            let slope = (at(total + step) - at(total - step)) / (2.0 * step);
            // Truncation 1e-10, rounding 1e-15/1e-5.
            prop_assert!((part(total, stiffness, compliance).share / slope - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn an_approach_that_is_nan_gives_a_force_that_is_nan() {
        for law in &*CONTACTS {
            assert!(law.force(f64::NAN, 0.0).is_nan() && law.force(1e-6, f64::NAN).is_nan());
            assert!(law.elastic(f64::NAN).is_nan() && law.elastic_stiffness(f64::NAN).is_nan());
        }
    }

    #[test]
    fn without_damping_the_force_is_hertz() {
        let law = ForceLaw { stiffness: 2e10, elasticity: Elasticity::Point, damping: Damping::HuntCrossley(0.0) };
        // 2e10 · (1e-5)^1.5 = 632.4555… N
        assert!((law.force(1e-5, 3.0) - 632.455_532_033_675_9).abs() < 1e-9);
    }

    #[test]
    fn four_steps_are_enough_at_every_softness() {
        for i in -300..=300 {
            let beta = 10f64.powf(f64::from(i) / 20.0);
            let z = root(beta);
            let residual = z * (z * z - 1.0) - beta;
            // The residual of a z that is right to one rounding: slope times z ε, twice.
            assert!(residual.abs() <= 2.0 * f64::EPSILON * z * (3.0 * z * z - 1.0), "β = {beta}: {residual}");
        }
    }

    #[test]
    fn without_compliance_no_bit_is_other_than_the_contacts() {
        for law in CONTACTS.iter().map(|contact| CompliantContact { compliance: 0.0, ..contact.clone() }) {
            for (delta, rate) in [(3.7e-6, 0.013), (1.1e-5, -0.4), (-2e-6, 1.0), (0.0, 0.0)] {
                let (alone, bits) = (law.law.clone(), f64::to_bits);
                assert_eq!(bits(law.force(delta, rate)), bits(alone.force(delta, rate)));
                assert_eq!(bits(law.pushing(delta, rate)), bits(alone.pushing(delta, rate)));
                assert_eq!(bits(law.elastic(delta)), bits(alone.elastic(delta)));
                assert_eq!(bits(law.elastic_stiffness(delta)), bits(alone.elastic_stiffness(delta)));
                let dual = Dual::<f64, 2>::variable;
                let [whole, own] =
                    [law.force(dual(delta, 0), dual(rate, 1)), alone.force(dual(delta, 0), dual(rate, 1))];
                assert_eq!(whole, own);
            }
        }
    }

    #[test]
    fn a_compliance_takes_its_linear_part_of_the_approach() {
        let damping = Damping::HuntCrossley(0.0);
        let contact = ForceLaw { stiffness: 2e10, elasticity: Elasticity::Point, damping };
        let law = CompliantContact { law: contact, compliance: 1e-8 };
        // 632.4555… N over 10 µm in the contact and 6.324555… µm in the compliance; printed digits.
        assert!((law.elastic(16.324_555_320_336_76e-6) - 632.455_532_033_675_9).abs() < 1e-9);
        let springs = 1.0 / (1.5 * 632.455_532_033_675_9 / 1e-5) + 1e-8;
        assert!((law.elastic_stiffness(16.324_555_320_336_76e-6) * springs - 1.0).abs() < 1e-12);
    }

    #[test]
    fn damping_through_a_compliance_is_that_of_the_contacts_own_damper() {
        for damping in [Damping::HuntCrossley(0.5), Damping::Proportional(1e-6)] {
            for compliance in [1e-9, 1e-8, 3e-7] {
                let alone = ForceLaw { stiffness: 2e10, elasticity: Elasticity::Point, damping };
                let law = CompliantContact { law: alone.clone(), compliance };
                let (total, rate) = (3e-5, 1e-5);
                let share = part(total, alone.stiffness, compliance).share;
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
