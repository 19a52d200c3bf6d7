//! All that the future of a simulation depends on, and nothing else. It is what runs: taking it is a copy, putting it back another.

use super::progress::Progress;
use crate::dynamics::drive::CageAngle;

/// Everything that the future of a [`Simulation`](super::Simulation) depends on; taking it and putting it back changes no bit.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    pub(super) time: f64,
    pub(super) started: bool,
    pub(super) cage: CageAngle,
    pub(super) progress: Progress,
    /// Values of the table's real variables, by index; outputs are those computed last.
    pub(super) reals: Vec<f64>,
    /// Those of its integers and enumerations, by index.
    pub(super) integers: Vec<i32>,
    /// First and second derivatives of inputs for the next step, where the host has given any, by index.
    pub(super) input_rates: Vec<[Option<f64>; 2]>,
}

impl State {
    /// Copies another state of the same model; allocates nothing.
    pub(super) fn copy_from(&mut self, other: &Self) {
        let Self { time, started, cage, progress, reals, integers, input_rates } = self;
        (*time, *started, *cage) = (other.time, other.started, other.cage);
        progress.copy_from(&other.progress);
        reals.copy_from_slice(&other.reals);
        integers.copy_from_slice(&other.integers);
        input_rates.copy_from_slice(&other.input_rates);
    }
}
