//! Communication points: where the host says it is, against where the instance is.
//!
//! A host may add up its steps or multiply them, so its communication points carry rounding: `n` additions at time
//! `t` are off by at most `n·ε·t/2`, 1e-10 relative after a million steps. [`ROUNDING`] allows ten times that. The
//! instance adopts the host's point, so rounding never accumulates between the two.

/// Largest relative difference that passes for the host's rounding.
pub(super) const ROUNDING: f64 = 1e-9;

/// Time of an instance [s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Clock {
    /// Start of the experiment [s].
    pub(super) start: f64,
    /// End of the experiment [s], when the host has told one.
    pub(super) stop: Option<f64>,
    /// The communication point reached [s].
    pub(super) time: f64,
}

/// Why an experiment or a step is refused.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub(super) enum ClockError {
    /// Not a number, or infinite.
    #[error("start time {0:?} s: it must be finite")]
    Start(f64),
    /// Not a number, infinite, or not after the start.
    #[error("stop time {stop:?} s: it must be finite and after the start time {start:?} s")]
    Stop {
        /// Stop time given.
        stop: f64,
        /// Start time given.
        start: f64,
    },
    /// Not where the instance is.
    #[error("communication point {point:?} s: the instance is at {time:?} s (allowed difference {allowed:e} s)")]
    Point {
        /// Point given.
        point: f64,
        /// Point reached.
        time: f64,
        /// Difference that would pass for rounding.
        allowed: f64,
    },
    /// Zero, negative, not a number or infinite.
    #[error("communication step size {0:?} s: it must be finite and above 0")]
    Step(f64),
    /// Past the stop time.
    #[error("communication step from {point:?} s by {step:?} s: it ends past the stop time {stop:?} s")]
    PastStop {
        /// Point given.
        point: f64,
        /// Step given.
        step: f64,
        /// Stop time.
        stop: f64,
    },
}

impl Clock {
    /// A clock at the start of an experiment.
    pub(super) fn new(start: f64, stop: Option<f64>) -> Result<Self, ClockError> {
        if !start.is_finite() {
            return Err(ClockError::Start(start));
        }
        match stop {
            Some(stop) if !(stop.is_finite() && stop > start) => Err(ClockError::Stop { stop, start }),
            _ => Ok(Self { start, stop, time: start }),
        }
    }

    /// The time at the end of a step that the host asks for.
    #[inline]
    pub(super) fn end_of_step(&self, point: f64, step: f64) -> Result<f64, ClockError> {
        if !(step > 0.0 && step.is_finite()) {
            return Err(ClockError::Step(step));
        }
        let allowed = ROUNDING * self.time.abs().max(step);
        let difference = (point - self.time).abs();
        if difference > allowed || difference.is_nan() {
            return Err(ClockError::Point { point, time: self.time, allowed });
        }
        let end = point + step;
        if !end.is_finite() {
            return Err(ClockError::Step(step));
        }
        match self.stop {
            Some(stop) if end > stop + ROUNDING * stop.abs().max(step) => {
                Err(ClockError::PastStop { point, step, stop })
            }
            _ => Ok(end),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_million_added_steps_are_accepted_and_end_on_the_stop_time() {
        let mut clock = Clock::new(0.0, Some(100.0)).unwrap();
        let step = 1e-4;
        let mut added = 0.0;
        for n in 0..1_000_000 {
            // The host multiplies on odd steps and adds on even ones.
            let point = if n % 2 == 0 { added } else { f64::from(n) * step };
            clock.time = clock.end_of_step(point, step).unwrap();
            added += step;
        }
    }

    #[test]
    fn a_point_that_is_one_step_off_is_refused() {
        let clock = Clock { start: 0.0, stop: None, time: 1000.0 };
        for point in [1000.0 - 1e-5, 1000.0 + 1e-5, 0.0, f64::NAN, f64::INFINITY] {
            assert!(matches!(clock.end_of_step(point, 1e-5), Err(ClockError::Point { .. })), "{point}");
        }
    }

    #[test]
    fn a_step_must_be_finite_and_above_zero() {
        let clock = Clock::new(0.0, None).unwrap();
        for step in [0.0, -0.0, -1e-3, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(matches!(clock.end_of_step(0.0, step), Err(ClockError::Step(_))), "{step}");
        }
        assert!(clock.end_of_step(0.0, f64::MIN_POSITIVE).is_ok());
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
