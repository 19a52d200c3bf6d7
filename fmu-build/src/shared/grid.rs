//! The communication points of a run.

use anyhow::{Result, bail};
use brinell::scene::Experiment;

/// Equal communication steps from 0 on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Communication step (s).
    pub step: f64,
    /// Number of steps.
    pub count: u64,
}

impl Grid {
    /// The scene's default run, with what the user says instead. The run ends with the last whole step.
    pub fn new(experiment: &Experiment, stop: Option<f64>, step: Option<f64>) -> Result<Self> {
        let stop = stop.unwrap_or(experiment.stop);
        let step = step.unwrap_or(experiment.step);
        for (quantity, value) in [("stop time", stop), ("communication step", step)] {
            if !(value.is_finite() && value > 0.0) {
                bail!("{quantity} {value} s: it must be finite and above 0");
            }
        }
        // A stop time that is a multiple of the step up to rounding counts as one.
        let count = (stop / step * (1.0 + 1e-9)).floor();
        if !(1.0..=1e9).contains(&count) {
            bail!("{count} communication steps of {step} s until {stop} s: between 1 and 1e9 are possible");
        }
        Ok(Self { step, count: count as u64 })
    }

    /// Time of the last communication point (s).
    pub fn end(&self) -> f64 {
        self.step * self.count as f64
    }
}
