//! The communication points of a run.

use anyhow::{Result, bail};
use brinell::scene::Experiment;

/// Share of a run's duration that counts as none, for stop times that are multiples of the step up to rounding.
const ROUNDING: f64 = 1e-9;

/// Equal communication steps from 0 on, of which the last may be shorter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Communication step (s).
    pub step: f64,
    /// Number of steps.
    pub count: u64,
    /// Time of the last communication point (s).
    end: f64,
}

impl Grid {
    /// The scene's default run, with what the user says instead. Where the stop time is no multiple of the step, the
    /// last step is shorter.
    pub fn new(experiment: &Experiment, stop: Option<f64>, step: Option<f64>) -> Result<Self> {
        let stop = stop.unwrap_or(experiment.stop);
        let whole = Self::of_whole_steps(&Experiment { stop, step: step.unwrap_or(experiment.step) })?;
        let is_short = stop - whole.end > ROUNDING * stop;
        let grid = if is_short { Self { count: whole.count + 1, end: stop, ..whole } } else { whole };
        grid.checked(stop)
    }

    /// Equal steps alone: a run that ends with the last whole step until the stop time.
    pub fn even(experiment: &Experiment) -> Result<Self> {
        Self::of_whole_steps(experiment)?.checked(experiment.stop)
    }

    fn of_whole_steps(&Experiment { stop, step }: &Experiment) -> Result<Self> {
        for (quantity, value) in [("stop time", stop), ("communication step", step)] {
            if !(value.is_finite() && value > 0.0) {
                bail!("{quantity} {value} s: it must be finite and above 0");
            }
        }
        let count = (stop / step * (1.0 + ROUNDING)).floor();
        Ok(Self { step, count: count as u64, end: step * count })
    }

    fn checked(self, stop: f64) -> Result<Self> {
        let Self { step, count, .. } = self;
        if !(1..=1_000_000_000).contains(&count) {
            bail!("{count} communication steps of {step} s until {stop} s: between 1 and 1e9 are possible");
        }
        Ok(self)
    }

    /// Time of the last communication point (s).
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Whether the last step is shorter than the others.
    pub fn ends_short(&self) -> bool {
        self.end < self.step * self.count as f64
    }

    /// Length of step `number`, counted from 1, that begins at `time` (s).
    pub fn length(&self, number: u64, time: f64) -> f64 {
        if number == self.count && self.ends_short() { self.end - time } else { self.step }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn a_stop_time_that_is_no_multiple_of_the_step_is_reached_by_a_shorter_step() {
        let grid = |stop: f64, step: f64| Grid::new(&Experiment { stop, step }, None, None).unwrap();
        for (stop, step, count, last) in [
            (0.05, 7e-3, 8, 1e-3),
            (0.05, 1e-3, 50, 1e-3),
            // Not a multiple by its digits in binary.
            (0.3, 0.1, 3, 0.1),
            (0.7, 0.1, 7, 0.1),
            (1e-5, 1e-4, 1, 1e-5),
        ] {
            let grid = grid(stop, step);
            assert_eq!(grid.count, count, "{stop} {step}");
            assert!((grid.end() / stop - 1.0).abs() < 1e-15, "{stop} {step}: {}", grid.end());
            let before = (count - 1) as f64 * step;
            assert!((grid.length(count, before) - last).abs() < 1e-15, "{stop} {step}");
            assert!(count == 1 || grid.length(count - 1, before - step) == step);
        }
        let even = Grid::even(&Experiment { stop: 0.05, step: 7e-3 }).unwrap();
        assert_eq!((even.count, even.ends_short(), even.length(7, 0.042)), (7, false, 7e-3));
        assert!(Grid::even(&Experiment { stop: 1e-5, step: 1e-4 }).is_err());
        assert!(Grid::new(&Experiment { stop: 1.0, step: 1e-12 }, None, None).is_err());
    }
}
