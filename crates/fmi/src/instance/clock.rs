//! Communication points: where the host says it is, against where the instance is.
//!
//! The instance adopts the host's point, so rounding never accumulates between the two. A host that adds its steps
//! meets the instance to the bit; one that multiplies, `start + n·step`, is off by the rounding of this point, of the
//! last one and of the instance's own sum, 3.5 ε of the largest time in them at most: [`ROUNDINGS`]. A host that
//! changes between adding and multiplying brings the rounding of all its additions: `n` of them at time `t` are off by
//! at most `n·ε·t/2`, 1e-10 of `t` after a million. Ten times that passes ([`ADDED`]), but no more than a hundredth of
//! a step ([`OF_STEP`]), which additions reach after nine million steps at the earliest: a step that was left out or
//! done twice is a hundred times as far off, however late it is.
//!
//! Where a step is below 400 ε of the time, 0.15 ms at Unix time, a hundredth of it is less than the roundings of the
//! time, and these decide. A step of a few ε itself, 1.5 µs at Unix time, is taken all the same: its length is exact,
//! and the last step of a run may well be what rounding has left. Whether such a step was left out is nothing that
//! times could show.
//!
//! As the instance adopts the host's point, a host that is off by a little in each step would drift away unseen. Its
//! points are therefore held against the exact sum of its steps as well. A host that multiplies, or counts in whole
//! nanoseconds, stays within a few roundings of it; one that adds is off by the roundings of its sums, half an ε of the
//! time at each. Beyond both, and a hundredth of a step or 1e-9 of the time as above, points and steps contradict each
//! other: of steps above some ε of the time a drift of 1 % is found within two or three.

/// Largest difference that the rounding of a multiplying host makes, in ε of the largest time.
const ROUNDINGS: f64 = 4.0;
/// Largest difference that passes for the rounding of many additions, per time.
const ADDED: f64 = 1e-9;
/// The same per step, of the last one and the one to come the shorter.
const OF_STEP: f64 = 1e-2;

/// Time of an instance (s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Clock {
    /// Start of the experiment (s).
    pub(crate) start: f64,
    /// End of the experiment (s), when the host has given one.
    pub(crate) stop: Option<f64>,
    /// The communication point reached (s).
    pub(crate) time: f64,
    /// The step that led there (s); 0 before the first.
    pub(crate) last: f64,
    /// How far `time` is beyond the start and the exact sum of all steps since (s).
    pub(crate) drift: f64,
    /// What the roundings of so many additions may come to (s).
    pub(crate) rounded: f64,
}

/// Why an experiment or a step is refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub(crate) enum ClockError {
    /// Not a number, or infinite.
    #[error("start time {0:?} s: it must be finite")]
    Start(f64),
    /// Not a number, or infinite.
    #[error("time {0:?} s: it must be finite")]
    Time(f64),
    /// Not a number, infinite, or not after the start.
    #[error("stop time {stop:?} s: it must be finite and after the start time {start:?} s")]
    Stop { stop: f64, start: f64 },
    /// Not where the instance is.
    #[error("communication point {point:?} s: the instance is at {time:?} s (allowed difference {allowed:e} s)")]
    Point { point: f64, time: f64, allowed: f64 },
    /// A little off in every step.
    #[error(
        "communication point {point:?} s: the start and all steps since are {drift:e} s away from it \
         (allowed difference {allowed:e} s)"
    )]
    Drift { point: f64, drift: f64, allowed: f64 },
    /// Zero, negative, not a number or infinite.
    #[error("communication step size {0:?} s: it must be finite and above 0")]
    Step(f64),
    /// Past the stop time, by somebody else's integrator.
    #[error("integrator step to {time:?} s: it ends past the stop time {stop:?} s")]
    TimePastStop { time: f64, stop: f64 },
    /// Past the stop time.
    #[error("communication step from {point:?} s by {step:?} s: it ends past the stop time {stop:?} s")]
    PastStop { point: f64, step: f64, stop: f64 },
}

impl Clock {
    /// A clock at the start of an experiment.
    pub(crate) fn new(start: f64, stop: Option<f64>) -> Result<Self, ClockError> {
        if !start.is_finite() {
            return Err(ClockError::Start(start));
        }
        match stop {
            Some(stop) if !(stop.is_finite() && stop > start) => Err(ClockError::Stop { stop, start }),
            _ => Ok(Self { start, stop, time: start, last: 0.0, drift: 0.0, rounded: 0.0 }),
        }
    }

    /// Goes to a time that somebody else's integrator tries, which may be past the stop time: CVode steps over it, and
    /// interpolates.
    pub(crate) fn move_to(&mut self, time: f64) -> Result<(), ClockError> {
        if !time.is_finite() {
            return Err(ClockError::Time(time));
        }
        self.time = time;
        Ok(())
    }

    /// Refuses a step of somebody else's integrator that is taken for good and ends past the stop time.
    pub(crate) fn check_taken(&self) -> Result<(), ClockError> {
        let Self { time, start, .. } = *self;
        match self.stop {
            Some(stop) if time > stop + ADDED * stop.abs().max(start.abs()) => {
                Err(ClockError::TimePastStop { time, stop })
            }
            _ => Ok(()),
        }
    }

    /// The clock at the end of a step that the host asks for.
    #[inline]
    pub(crate) fn after(&self, point: f64, step: f64) -> Result<Self, ClockError> {
        if !(step > 0.0 && step.is_finite()) {
            return Err(ClockError::Step(step));
        }
        let shortest = if self.last > 0.0 { step.min(self.last) } else { step };
        let allowed = self.allowed(step, shortest);
        let difference = (point - self.time).abs();
        if difference > allowed || difference.is_nan() {
            return Err(ClockError::Point { point, time: self.time, allowed });
        }
        let drift = self.drift + (point - self.time);
        let allowed = self.rounded + self.allowed(step, step.max(self.last));
        if drift.abs() > allowed {
            return Err(ClockError::Drift { point, drift, allowed });
        }
        let end = point + step;
        if !end.is_finite() {
            return Err(ClockError::Step(step));
        }
        match self.stop {
            Some(stop) if end > stop + self.allowed(step, step) => Err(ClockError::PastStop { point, step, stop }),
            _ => Ok(self.moved(point, step)),
        }
    }

    /// The clock at the end of a step that has been accepted, or that ends earlier than one that was.
    #[inline]
    pub(crate) fn moved(&self, point: f64, step: f64) -> Self {
        let end = point + step;
        let drift = self.drift + (point - self.time) + rounding_of(point, step, end);
        let rounded = self.rounded + 0.5 * f64::EPSILON * end.abs();
        Self { time: end, last: step, drift, rounded, ..*self }
    }

    /// Difference (s) that passes for a host's rounding around a step, next to which the `shortest` step lies.
    fn allowed(&self, step: f64, shortest: f64) -> f64 {
        let largest = self.time.abs().max(self.start.abs()).max(step);
        (ROUNDINGS * f64::EPSILON * largest).max((ADDED * largest).min(OF_STEP * shortest))
    }
}

/// By how much `sum` is more than `a + b`, exactly (Knuth's two-sum).
#[inline]
fn rounding_of(a: f64, b: f64, sum: f64) -> f64 {
    let b_kept = sum - a;
    let a_kept = sum - b_kept;
    (a_kept - a) + (b_kept - b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of a long run. Miri is a thousand times slower, and looks for something else.
    const COUNT: u32 = if cfg!(miri) { 100 } else { 100_000 };

    /// A clock that has come to `time` by a step.
    fn at(time: f64, last: f64) -> Clock {
        Clock { start: 0.0, stop: None, time, last, drift: 0.0, rounded: 0.0 }
    }

    #[test]
    #[cfg_attr(
        miri,
        ignore = "ten million steps of arithmetic: a thousand times slower there, and nothing to be found"
    )]
    fn ten_million_added_steps_are_accepted_and_end_on_the_stop_time() {
        for (step, count) in [(1e-4, 1_000_000), (0.1, 1_000_000), (1e-5, 10_000_000)] {
            let mut clock = Clock::new(0.0, Some(f64::from(count) * step)).unwrap();
            let mut added = 0.0;
            for n in 0..count {
                // The host multiplies on odd steps and adds on even ones.
                let point = if n % 2 == 0 { added } else { f64::from(n) * step };
                clock = clock.after(point, step).unwrap();
                added += step;
            }
            assert!(matches!(clock.after(added, step), Err(ClockError::PastStop { .. })), "{added}");
        }
    }

    #[test]
    fn a_host_that_multiplies_is_met_from_any_start_with_any_step() {
        for start in [-1.7e9, -1e3, -0.37, 0.0, 1e5, 1.7e9] {
            // Down to steps that do not move so late a time, and through 0.
            for step in [0.3, 1e-2, 1e-4 / 3.0, 1e-6, 1e-8] {
                let mut clock = Clock::new(start, None).unwrap();
                for n in 0..COUNT {
                    clock = clock.after(start + f64::from(n) * step, step).unwrap();
                }
            }
        }
    }

    #[test]
    fn a_host_that_adds_is_met_exactly() {
        let (mut clock, mut time) = (Clock::new(1.7e9, None).unwrap(), 1.7e9);
        for n in 0..COUNT {
            let step = 1e-4 + 1e-9 * f64::from(n);
            clock = clock.after(time, step).unwrap();
            time += step;
            assert_eq!(clock.time.to_bits(), time.to_bits());
        }
    }

    #[test]
    fn a_point_that_is_off_by_a_tenth_of_a_step_is_refused_however_late() {
        for time in [0.0, 1.0, 1e3, 1e5, 1e6, 1e7] {
            for off in [1e-5, -1e-5, 1e-4, -1e-4, -0.9, -time, f64::NAN, f64::INFINITY] {
                if off != 0.0 {
                    let found = at(time, 1e-4).after(time + off, 1e-4);
                    assert!(matches!(found, Err(ClockError::Point { .. })), "{off} at {time}");
                }
            }
        }
        // At Unix time a tenth of 100 µs is 42 numbers away.
        for off in [1e-5, -1e-5, -1e-4, -0.9, -1.7e9] {
            assert!(at(1.7e9, 1e-4).after(1.7e9 + off, 1e-4).is_err(), "{off}");
        }
    }

    /// Steps that a host takes until it is refused, whose points move on by `share` of a step more; 1000 at most.
    fn steps_of_a_drifting_host(start: f64, step: f64, share: f64) -> u32 {
        let mut clock = Clock::new(start, None).unwrap();
        for n in 0..1000 {
            let point = start + f64::from(n) * (1.0 + share) * step;
            match clock.after(point, step) {
                Ok(after) => clock = after,
                Err(_) => return n,
            }
        }
        1000
    }

    #[test]
    fn a_host_whose_points_drift_away_from_the_sum_of_its_steps_is_refused_however_late() {
        for start in [0.0, 1e3, 1e4, 1e5, 1e6] {
            for share in [0.009, -0.009, 0.005, -0.005, 0.001, -0.001] {
                // What passes is a hundredth of a step, and some roundings of 1e6 s.
                let taken = steps_of_a_drifting_host(start, 1e-3, share);
                assert!(f64::from(taken - 1) * share.abs() <= 0.011, "{start} s, {share}: refused after {taken} steps");
            }
        }
        // At Unix time a number is 0.02 % of 1 ms, and additions alone make half of that in each step.
        for share in [0.009, -0.009] {
            assert!(steps_of_a_drifting_host(1.7e9, 1e-3, share) <= 4);
        }
    }

    #[test]
    fn the_drift_is_that_of_the_exact_sum() {
        let step = 1.0 + f64::EPSILON;
        let mut clock = Clock::new(0.5 * f64::EPSILON, None).unwrap();
        for n in 1..=4u32 {
            clock = clock.after(clock.time, step).unwrap();
            // Multiples of 2^-53: start 1, steps 2^53 + 2.
            let exact = i128::from(n) * ((1 << 53) + 2) + 1;
            let kept = (clock.time * 9_007_199_254_740_992.0) as i128;
            assert_eq!(clock.drift, (kept - exact) as f64 / 9_007_199_254_740_992.0, "after {n} steps");
            assert!(clock.drift.abs() <= clock.rounded);
        }
    }

    #[test]
    fn a_short_step_done_twice_before_a_long_one_is_refused() {
        assert!(at(1e4, 1e-6).after(1e4 - 1e-6, 1e-3).is_err());
        assert!(at(1e4, 1e-3).after(1e4 + 1e-6, 1e-6).is_err());
        assert!(at(1e4, 1e-6).after(1e4, 1e-3).is_ok());
    }

    #[test]
    fn a_step_past_the_stop_time_is_refused_however_late_and_rounding_is_not() {
        for stop in [1.0, 1e5, 1e7, 1.7e9] {
            let clock = Clock { stop: Some(stop), ..at(stop, 1e-4) };
            assert!(matches!(clock.after(stop, 1e-4), Err(ClockError::PastStop { .. })), "{stop}");
            assert!(matches!(clock.after(stop, 1e-5), Err(ClockError::PastStop { .. })), "{stop}");
            // What one rounding has left of the run.
            assert!(clock.after(stop, f64::EPSILON * stop).is_ok());
            let before = Clock { time: stop - 1e-4, ..clock };
            assert!(before.after(stop - 1e-4, 1e-4 + 2.0 * f64::EPSILON * stop).is_ok());
        }
    }

    #[test]
    fn a_step_must_be_finite_and_above_zero() {
        let clock = Clock::new(0.0, None).unwrap();
        for step in [0.0, -0.0, -1e-3, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(matches!(clock.after(0.0, step), Err(ClockError::Step(_))), "{step}");
        }
        assert!(clock.after(0.0, f64::MIN_POSITIVE).is_ok());
    }

    #[test]
    fn an_experiment_needs_a_finite_start_and_a_later_finite_stop() {
        assert!(Clock::new(-3.0, Some(-2.0)).is_ok());
        assert!(Clock::new(f64::NAN, None).is_err());
        for stop in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Clock::new(0.0, Some(stop)).is_err(), "{stop}");
        }
    }
}
