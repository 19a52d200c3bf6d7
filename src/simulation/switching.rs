//! The choice between the explicit and the implicit method, on measured stiffness, without a clock.
//!
//! Both cost a known number of right-hand sides a step, so the better one is known as soon as the steps are. The explicit
//! method can be *stable* up to h|λ| = r only, λ the fastest eigenvalue ([`Jacobian::fastest`]) and r the reach of its
//! stability region in that direction. While it steps, its mean h|λ|/r is looked at now and then: near 1 it is stability
//! that limits the step, and the implicit method is tried. While that steps, each of its steps stands for
//! max(1, h|λ|/r) explicit ones; when these would be cheaper, or have not become dearer within the first few steps,
//! the explicit method comes back and the next trial waits twice as long.
//!
//! Explicit steps stay within h|λ| = r of the last look. Error control alone lets them swing across it, and what grows there
//! before it is noticed is noise as large as the tolerance: in a healthy bearing several times all other errors.

use super::stepper::SMALLEST_STEP;
use crate::dynamics::jacobian::Jacobian;

/// Which methods a simulation may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// Whichever is cheaper at the moment.
    #[default]
    Automatic,
    /// The explicit one only: Dormand–Prince 5(4).
    DormandPrince,
    /// The linearly implicit one only: Rodas5P.
    Rodas,
}

/// What the choice depends on; part of the state.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Choice {
    /// The implicit method steps.
    pub implicit: bool,
    /// Steps tried since the last look.
    pub tried: u32,
    /// Steps among them that error control ended; the others landed somewhere.
    pub limited: u32,
    /// Time gained since the last look [s]; for the implicit method, explicit steps that this would have taken.
    pub gained: f64,
    /// Looks that found stiffness but are still to be passed over.
    pub wait: u32,
    /// Looks that will be passed over after the next trial that fails.
    pub patience: u32,
    /// Longest explicit step that is stable by the fastest eigenvalue of the last look [s]; 0 before the first.
    pub stable_step: f64,
}

/// Steps between two looks of the explicit method: one Jacobian in 200 right-hand sides.
const LOOK: u32 = 32;
/// Steps of a trial of the implicit method: they grow two- to fivefold each, so six show what it can do.
const TRIAL: u32 = 6;
/// Steps between two looks of the implicit method.
const IMPLICIT_LOOK: u32 = 16;
/// Explicit steps that cost as much as one implicit step; measured with nine elements: 4 in instructions with AVX2, 5.5 in time
/// with AVX-512.
const COST: f64 = 5.0;
/// Share of the stable step above which it is stability that limits. Error control lets the step swing below the limit.
const NEAR_LIMIT: f64 = 0.5;
/// Longest row of looks to be passed over.
const MOST_PATIENCE: u32 = 64;

impl Choice {
    /// Whether counting and deciding can have led here. What is tried beyond the next look is one step's trials, a thousand at most:
    /// each shortens it by a tenth or more.
    pub(super) fn is_possible(&self) -> bool {
        self.tried < LOOK + 1000
            && self.limited <= self.tried.max(1)
            && self.gained >= 0.0
            && self.wait <= MOST_PATIENCE
            && self.patience <= MOST_PATIENCE
            && (self.stable_step == 0.0 || self.stable_step >= SMALLEST_STEP)
    }

    /// Notes a finished explicit step of length `h` [s] and how often it was tried. `landed`: something else than error
    /// control ended it. Says whether it is time to look at the Jacobian.
    pub fn explicit_step(&mut self, h: f64, tried: u32, landed: bool) -> bool {
        self.tried += tried;
        self.limited += u32::from(!landed);
        self.gained += h;
        self.tried >= LOOK
    }

    /// Decides after a row of explicit steps.
    pub fn look_explicit(&mut self, jacobian: &Jacobian) {
        let mean = self.gained / f64::from(self.tried);
        let stiff = mean * rate_of_steps(jacobian) > NEAR_LIMIT;
        // Where most steps land on something, longer ones are of no use.
        let useful = f64::from(self.limited) > (1.0 - 1.0 / COST) * f64::from(self.tried);
        let again = stiff && useful && self.wait == 0;
        if stiff && useful && self.wait > 0 {
            self.wait -= 1;
        }
        let stable_step = 1.0 / rate_of_steps(jacobian);
        *self = Self { implicit: again, wait: self.wait, patience: self.patience, stable_step, ..Self::default() };
    }

    /// `step` [s], or the longest stable one if that is shorter and the explicit method steps.
    pub fn limited(&self, step: f64) -> f64 {
        if self.implicit || self.stable_step == 0.0 { step } else { step.min(self.stable_step) }
    }

    /// Notes a finished implicit step of length `h` [s] and how often it was tried; decides now and then.
    pub fn implicit_step(&mut self, h: f64, tried: u32, jacobian: &Jacobian) {
        let trial = self.limited == 0;
        self.tried += tried;
        self.gained += (h * rate_of_steps(jacobian)).max(1.0);
        if self.tried < if trial { TRIAL } else { IMPLICIT_LOOK } {
            return;
        }
        let pays = self.gained > COST * f64::from(self.tried);
        // `limited` marks that the trial is over.
        let stable_step = 1.0 / rate_of_steps(jacobian);
        let next = Self {
            implicit: pays,
            limited: 1,
            wait: self.wait,
            patience: self.patience,
            stable_step,
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

/// Explicit steps per second that stability asks for.
fn rate_of_steps(jacobian: &Jacobian) -> f64 {
    let (fastest, damping) = jacobian.fastest();
    fastest / reach(damping)
}

/// Reach of the explicit method's stability region along an eigenvalue of damping ratio `damping`: 3.2 where damping is strong;
/// 2 near the imaginary one, beyond which amplitudes grow by more than 3 % a step.
fn reach(damping: f64) -> f64 {
    2.0 + 4.0 * damping.min(0.3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reach_lies_within_the_stability_region() {
        // 1 + z + z²/2 + z³/6 + z⁴/24 + z⁵/120 + z⁶/600, the stability function of Dormand–Prince 5(4).
        let amplification = |radius: f64, damping: f64| {
            let (re, im) = (-radius * damping, radius * (1.0 - damping * damping).sqrt());
            let mut sum = (0.0, 0.0);
            for c in [1.0 / 600.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0] {
                sum = (sum.0 * re - sum.1 * im + c, sum.0 * im + sum.1 * re);
            }
            f64::hypot(sum.0, sum.1)
        };
        for i in 0..=100 {
            let damping = i as f64 / 100.0;
            for k in 1..=20 {
                let share = k as f64 / 20.0;
                assert!(amplification(share * reach(damping), damping) < 1.04, "{damping} {share}");
            }
        }
        assert!(amplification(3.35, 1.0) > 1.0 && amplification(2.4, 0.0) > 1.1);
    }

    #[test]
    fn a_trial_that_does_not_pay_ends_after_six_steps_and_the_next_waits_twice_as_long() {
        let slow = Jacobian::with_fastest(1.0);
        let mut choice = Choice { implicit: true, patience: 2, ..Choice::default() };
        for _ in 0..TRIAL {
            assert!(choice.implicit);
            choice.implicit_step(1e-3, 1, &slow);
        }
        assert!(!choice.implicit);
        assert_eq!((choice.wait, choice.patience), (4, 4));
    }

    #[test]
    fn steps_at_the_stability_limit_start_a_trial_and_long_implicit_steps_keep_it() {
        let fast = Jacobian::with_fastest(1e8);
        let mut choice = Choice::default();
        while !choice.explicit_step(3e-8, 1, false) {}
        choice.look_explicit(&fast);
        assert!(choice.implicit);
        for _ in 0..100 {
            choice.implicit_step(1e-6, 1, &fast);
        }
        assert!(choice.implicit);
    }

    #[test]
    fn explicit_steps_stay_stable_and_implicit_ones_are_free() {
        let fast = Jacobian::with_fastest(1e8);
        let mut choice = Choice::default();
        assert_eq!(choice.limited(1.0), 1.0);
        while !choice.explicit_step(1e-9, 1, false) {}
        choice.look_explicit(&fast);
        let limit = 1.0 / rate_of_steps(&fast);
        assert_eq!((choice.limited(1.0), choice.limited(0.5 * limit)), (limit, 0.5 * limit));
        assert_eq!(Choice { implicit: true, ..choice }.limited(1.0), 1.0);
    }

    #[test]
    fn steps_that_land_anyway_start_no_trial() {
        let fast = Jacobian::with_fastest(1e8);
        let mut choice = Choice::default();
        while !choice.explicit_step(3e-8, 1, true) {}
        choice.look_explicit(&fast);
        assert!(!choice.implicit);
    }
}
