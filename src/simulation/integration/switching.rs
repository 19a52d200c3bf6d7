//! The choice between the explicit methods and the implicit one, on measured stiffness, without a clock.
//!
//! All cost a known number of right-hand sides a step, so the best one is known as soon as the steps are. An explicit
//! method can be *stable* up to h|λ| = r only, λ the fastest eigenvalue (`Jacobian::fastest`) and r the reach of its
//! stability region in that direction. While it steps, its mean h|λ|/r is checked now and then: near 1 it is
//! stability that limits the step, and the implicit method is tried. While that steps, each of its steps stands for
//! max(1, h|λ|/r) explicit ones; when these would be cheaper, or have not become dearer within the first few steps, the
//! explicit method comes back and the next trial waits twice as long.
//!
//! Of the two explicit methods it is the phase-fitted one that steps where the tolerance is loose enough for its order
//! and the fastest motion is not so strongly damped that Dormand–Prince's reaches as far.
//!
//! Explicit steps stay within h|λ| = r of the last check. Error control alone lets them swing across it, and what grows
//! there before it is noticed is noise as large as the tolerance: in a healthy bearing several times all other errors.

use crate::dynamics::derivatives::Fastest;
use crate::simulation::integration::methods::{ExplicitMethod, dormand_prince, phase_fitted, rodas};
use crate::simulation::step_error::SMALLEST_STEP;

/// Which methods a simulation may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Whichever is cheaper at the moment.
    #[default]
    Automatic,
    /// One explicit one only: Dormand–Prince 5(4).
    DormandPrince,
    /// The other explicit one only: the phase-fitted pair of order 4(3).
    PhaseFitted,
    /// The linearly implicit one only: Rodas5P.
    Rodas,
    /// Whichever of the explicit ones is cheaper: all that there is for elements in balance at every instant, which
    /// leave nothing stiff.
    Explicit,
}

/// Tolerance from which on the order of the phase-fitted method is enough: at 1e-7 it takes more time than
/// Dormand–Prince's for the same error.
const LOOSE: f64 = 1e-6;

impl Method {
    /// What the automatic choice steps with, as part of a sentence.
    pub fn automatic_in_words() -> String {
        let order = |[step, estimate]: [usize; 2]| format!("order {step}({estimate})");
        format!(
            "an explicit phase-fitted pair of {} at tolerances from {LOOSE:e} on, the explicit pair of Dormand and \
             Prince of {} at smaller ones and where damping is strong, and Rodas5P, linearly implicit, of {} where \
             contacts are stiff",
            order(phase_fitted::ORDERS),
            order(dormand_prince::ORDERS),
            order(rodas::ORDERS)
        )
    }

    /// The explicit method for a tolerance; `damped`: the last check found the fastest motion strongly damped.
    pub(super) fn pair(self, tolerance: f64, damped: bool) -> ExplicitMethod {
        match self {
            Self::DormandPrince => ExplicitMethod::DormandPrince,
            Self::PhaseFitted => ExplicitMethod::PhaseFitted,
            _ if tolerance >= LOOSE && !damped => ExplicitMethod::PhaseFitted,
            _ => ExplicitMethod::DormandPrince,
        }
    }
}

/// What the choice depends on; part of the state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Choice {
    /// The implicit method steps.
    pub implicit: bool,
    /// Steps tried since the last check.
    pub tried: u32,
    /// Steps among them that error control ended; the others landed somewhere.
    pub limited: u32,
    /// Time gained since the last check (s); for the implicit method, explicit steps that this would have taken.
    pub gained: f64,
    /// Checks that found stiffness but are still to be passed over.
    pub wait: u32,
    /// Checks that will be passed over after the next trial that fails.
    pub patience: u32,
    /// Longest explicit step that is stable by the fastest eigenvalue of the last check (s); 0 before the first.
    pub stable_step: f64,
    /// The fastest motion was then so strongly damped that the phase-fitted method does not pay.
    pub damped: bool,
}

/// Steps between two checks of the explicit method: one Jacobian in 200 right-hand sides.
const CHECK_INTERVAL: u32 = 32;
/// Steps of a trial of the implicit method: they grow two- to fivefold each, so six show what it can do.
const TRIAL: u32 = 6;
/// Steps between two checks of the implicit method.
const IMPLICIT_CHECK_INTERVAL: u32 = 16;
/// Explicit steps that cost as much as one implicit step; measured with nine elements: 4 in instructions with AVX2, 5.5
/// in time with AVX-512.
const COST: f64 = 5.0;
/// Share of the stable step above which it is stability that limits. Error control lets the step swing below the limit.
const NEAR_LIMIT: f64 = 0.5;
/// Longest row of checks to be passed over.
const MOST_PATIENCE: u32 = 64;

impl Choice {
    /// Whether counting and deciding can have led here. What is tried beyond the next check is one step's trials, a
    /// thousand at most: each shortens it by a tenth or more.
    pub(in crate::simulation) fn is_possible(&self) -> bool {
        self.tried < CHECK_INTERVAL + 1000
            && self.limited <= self.tried.max(1)
            && self.gained >= 0.0
            && self.wait <= MOST_PATIENCE
            && self.patience <= MOST_PATIENCE
            && (self.stable_step == 0.0 || self.stable_step >= SMALLEST_STEP)
    }

    /// Notes a finished explicit step of length `h` (s) and how often it was tried. `landed`: something else than error
    /// control ended it. Says whether it is time to evaluate the Jacobian.
    pub fn explicit_step(&mut self, h: f64, tried: u32, landed: bool) -> bool {
        self.tried += tried;
        self.limited += u32::from(!landed);
        self.gained += h;
        self.tried >= CHECK_INTERVAL
    }

    /// Checks before the first step: a start at rest excites nothing, and error control alone would let steps grow far
    /// beyond what is stable before it notices.
    pub fn check_first(&mut self, fastest: Fastest, method: Method, tolerance: f64) {
        self.damped = is_damped(fastest);
        self.stable_step = stable_step(fastest, method.pair(tolerance, self.damped));
    }

    /// Decides after a row of explicit steps, between what there is to choose from.
    pub fn check_explicit(&mut self, fastest: Fastest, method: Method, tolerance: f64) {
        let mean = self.gained / f64::from(self.tried);
        let stiff = mean * rate_of_steps(fastest, method.pair(tolerance, self.damped)) > NEAR_LIMIT;
        // Where most steps land on something, longer ones are of no use.
        let useful = f64::from(self.limited) > (1.0 - 1.0 / COST) * f64::from(self.tried);
        let pays = stiff && useful && method == Method::Automatic;
        let again = pays && self.wait == 0;
        if pays && self.wait > 0 {
            self.wait -= 1;
        }
        let damped = is_damped(fastest);
        let stable_step = stable_step(fastest, method.pair(tolerance, damped));
        let (wait, patience) = (self.wait, self.patience);
        *self = Self { implicit: again, wait, patience, stable_step, damped, ..Self::default() };
    }

    /// `step` (s), or the longest stable one if that is shorter and the explicit method steps.
    pub fn limited(&self, step: f64) -> f64 {
        if self.implicit || self.stable_step == 0.0 { step } else { step.min(self.stable_step) }
    }

    /// Notes a finished implicit step of length `h` (s) and how often it was tried; decides now and then, between what
    /// there is to choose from.
    pub fn implicit_step(&mut self, h: f64, tried: u32, fastest: Fastest, method: Method, tolerance: f64) {
        let trial = self.limited == 0;
        let damped = is_damped(fastest);
        let pair = method.pair(tolerance, damped);
        self.tried += tried;
        self.gained += (h * rate_of_steps(fastest, pair)).max(1.0);
        if self.tried < if trial { TRIAL } else { IMPLICIT_CHECK_INTERVAL } {
            return;
        }
        let pays = self.gained > COST * f64::from(self.tried);
        // `limited` marks that the trial is over.
        let stable_step = stable_step(fastest, pair);
        let next = Self {
            implicit: pays,
            limited: 1,
            wait: self.wait,
            patience: self.patience,
            stable_step,
            damped,
            ..Self::default()
        };
        *self = if pays {
            Self { patience: 0, ..next }
        } else if trial {
            let patience = (2 * self.patience).clamp(1, MOST_PATIENCE);
            Self { limited: 0, wait: patience, patience, ..next }
        } else {
            Self { limited: 0, wait: 0, ..next }
        };
    }
}

/// Steps per second that the stability of an explicit method asks for.
fn rate_of_steps(fastest: Fastest, pair: ExplicitMethod) -> f64 {
    fastest.eigenvalue / reach(pair, fastest.damping)
}

/// Longest stable step of an explicit method (s); a number even where nothing moves by itself.
fn stable_step(fastest: Fastest, pair: ExplicitMethod) -> f64 {
    (1.0 / rate_of_steps(fastest, pair)).min(f64::MAX)
}

/// Whether the fastest motion is so strongly damped that the phase-fitted method does not pay: its step costs a tenth
/// more.
fn is_damped(Fastest { damping, .. }: Fastest) -> bool {
    reach(ExplicitMethod::PhaseFitted, damping) < 1.1 * reach(ExplicitMethod::DormandPrince, damping)
}

/// Reach of a method's stability region along an eigenvalue of damping ratio `damping`. Near the imaginary axis
/// Dormand–Prince's is taken where amplitudes grow by 3 % a step: what moves fastest hardly ever is the least damped.
fn reach(pair: ExplicitMethod, damping: f64) -> f64 {
    match pair {
        ExplicitMethod::DormandPrince => 2.0 + 4.0 * damping.min(0.3),
        ExplicitMethod::PhaseFitted => {
            let above =
                PHASE_FITTED_REACH.partition_point(|&(at, _)| at <= damping).clamp(1, PHASE_FITTED_REACH.len() - 1);
            let ((a, reach_a), (b, reach_b)) = (PHASE_FITTED_REACH[above - 1], PHASE_FITTED_REACH[above]);
            reach_a + (reach_b - reach_a) * (damping - a) / (b - a)
        }
    }
}

/// Damping ratios and the phase-fitted method's reach there, a straight line between them: within the stability region.
const PHASE_FITTED_REACH: [(f64, f64); 12] = [
    (0.0, 3.0),
    (0.018, 3.0),
    (0.02, 3.55),
    (0.05, 4.05),
    (0.45, 4.1),
    (0.56, 4.3),
    (0.6, 4.1),
    (0.7, 3.4),
    (0.8, 3.15),
    (0.97, 2.95),
    (0.985, 2.2),
    (1.0, 2.15),
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::integration::methods::phase_fitted;

    /// Largest factor of amplitude in one step with h|λ| = radius and this damping ratio.
    fn amplification(pair: ExplicitMethod, radius: f64, damping: f64) -> f64 {
        match pair {
            // 1 + z + z²/2 + z³/6 + z⁴/24 + z⁵/120 + z⁶/600, the stability function of Dormand–Prince 5(4).
            ExplicitMethod::DormandPrince => {
                let (re, im) = (-radius * damping, radius * (1.0 - damping * damping).sqrt());
                let mut sum = (0.0, 0.0);
                for c in [1.0 / 600.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0] {
                    sum = (sum.0 * re - sum.1 * im + c, sum.0 * im + sum.1 * re);
                }
                f64::hypot(sum.0, sum.1)
            }
            // x'' = −r² x − 2 ζ r x' with a step of 1, from both unit states.
            ExplicitMethod::PhaseFitted => {
                let column = |x: f64, v: f64| {
                    let (mut rates, mut forces) = ([0.0; 5], [0.0; 5]);
                    for i in 0..5 {
                        rates[i] = v + (0..i).map(|j| phase_fitted::VELOCITIES[i][j] * forces[j]).sum::<f64>();
                        let x = x + (0..=i).map(|j| phase_fitted::POSITIONS[i][j] * rates[j]).sum::<f64>();
                        forces[i] = -radius * radius * x - 2.0 * damping * radius * rates[i];
                    }
                    let weighted = |of: [f64; 5]| of.iter().zip(phase_fitted::WEIGHTS).map(|(k, b)| k * b).sum::<f64>();
                    (x + weighted(rates), v + weighted(forces))
                };
                let ((a, c), (b, d)) = (column(1.0, 0.0), column(0.0, 1.0));
                let (half, product) = (0.5 * (a + d), a * d - b * c);
                let square = half * half - product;
                if square < 0.0 { product.sqrt() } else { half.abs() + square.sqrt() }
            }
        }
    }

    #[test]
    fn the_reach_lies_within_the_stability_region() {
        for (pair, growth) in [(ExplicitMethod::DormandPrince, 1.04), (ExplicitMethod::PhaseFitted, 1.008)] {
            for i in 0..=1000 {
                let damping = f64::from(i) / 1000.0;
                for k in 1..=40 {
                    let radius = f64::from(k) / 40.0 * reach(pair, damping);
                    let found = amplification(pair, radius, damping);
                    assert!(found < growth, "{pair:?}: {found} at {radius}, damping {damping}");
                }
            }
        }
        assert!(
            amplification(ExplicitMethod::DormandPrince, 3.35, 1.0) > 1.0
                && amplification(ExplicitMethod::DormandPrince, 2.4, 0.0) > 1.1
        );
        assert!(
            amplification(ExplicitMethod::PhaseFitted, 3.0, 1.0) > 1.3
                && amplification(ExplicitMethod::PhaseFitted, 3.8, 0.0) > 1.1
        );
    }

    #[test]
    fn where_nothing_moves_by_itself_the_stable_step_is_a_number() {
        let mut choice = Choice::default();
        choice.check_first(Fastest { eigenvalue: 0.0, damping: 1.0 }, Method::Automatic, 1e-5);
        assert!(choice.stable_step.is_finite() && choice.is_possible());
        assert_eq!(choice.limited(1e-3), 1e-3);
    }

    #[test]
    fn the_phase_fitted_method_steps_where_the_tolerance_is_loose_and_damping_is_not_strong() {
        let pair = |tolerance, damped| Method::Automatic.pair(tolerance, damped);
        assert_eq!([pair(1e-3, false), pair(1e-6, false)], [ExplicitMethod::PhaseFitted; 2]);
        assert_eq!([pair(1e-7, false), pair(1e-3, true)], [ExplicitMethod::DormandPrince; 2]);
        let reaches =
            |damping| reach(ExplicitMethod::PhaseFitted, damping) / reach(ExplicitMethod::DormandPrince, damping);
        assert!(reaches(0.1) > 1.6 && reaches(0.6) > 1.2 && reaches(1.0) < 0.7);
    }

    #[test]
    fn a_trial_that_does_not_pay_ends_after_six_steps_and_the_next_waits_twice_as_long() {
        let slow = Fastest { eigenvalue: 1.0, damping: 1.0 };
        let mut choice = Choice { implicit: true, patience: 2, ..Choice::default() };
        for _ in 0..TRIAL {
            assert!(choice.implicit);
            choice.implicit_step(1e-3, 1, slow, Method::Automatic, 1e-9);
        }
        assert!(!choice.implicit);
        assert_eq!((choice.wait, choice.patience), (4, 4));
    }

    #[test]
    fn steps_at_the_stability_limit_start_a_trial_and_long_implicit_steps_keep_it() {
        let fast = Fastest { eigenvalue: 1e8, damping: 1.0 };
        let mut choice = Choice::default();
        while !choice.explicit_step(3e-8, 1, false) {}
        choice.check_explicit(fast, Method::Automatic, 1e-9);
        assert!(choice.implicit);
        for _ in 0..100 {
            choice.implicit_step(1e-6, 1, fast, Method::Automatic, 1e-9);
        }
        assert!(choice.implicit);
    }

    #[test]
    fn explicit_steps_stay_stable_and_implicit_ones_are_free() {
        let fast = Fastest { eigenvalue: 1e8, damping: 1.0 };
        let mut choice = Choice::default();
        assert_eq!(choice.limited(1.0), 1.0);
        while !choice.explicit_step(1e-9, 1, false) {}
        choice.check_explicit(fast, Method::Automatic, 1e-9);
        let limit = 1.0 / rate_of_steps(fast, ExplicitMethod::DormandPrince);
        assert_eq!((choice.limited(1.0), choice.limited(0.5 * limit)), (limit, 0.5 * limit));
        assert_eq!(Choice { implicit: true, ..choice }.limited(1.0), 1.0);
    }

    #[test]
    fn steps_that_land_anyway_start_no_trial() {
        let fast = Fastest { eigenvalue: 1e8, damping: 1.0 };
        let mut choice = Choice::default();
        while !choice.explicit_step(3e-8, 1, true) {}
        choice.check_explicit(fast, Method::Automatic, 1e-9);
        assert!(!choice.implicit);
    }
}
