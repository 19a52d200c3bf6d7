//! All that the future of a simulation depends on, and nothing else. It is what runs: taking it is a copy, putting it
//! back another.

use super::outputs::Angles;
use super::progress::Progress;
use crate::dynamics::drive::WholeAngle;

/// Everything that the future of a [`Simulation`](super::Simulation) depends on; taking it and putting it back changes
/// no bit.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    pub(super) time: f64,
    pub(super) started: bool,
    pub(super) cage: WholeAngle,
    /// Angles of the frames of defects, in the order of [`crate::dynamics::drive::Frame`].
    pub(super) frames: [WholeAngle; 3],
    pub(super) ended: Ended,
    pub(super) progress: Progress,
    /// Values of the table's real variables, by index; outputs are those computed last.
    pub(super) reals: Vec<f64>,
    /// Those of its integers and enumerations, by index.
    pub(super) integers: Vec<i32>,
    /// First and second derivatives of inputs for the next step, where the host has given any, by index.
    pub(super) input_rates: Vec<[Option<f64>; 2]>,
}

/// Accelerations at the end of the last step that derivatives of inputs gave and no input says: outputs at that instant
/// follow from them. Gone once the host sets an input.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Ended {
    /// Of the cage (rad/s²).
    pub(super) cage: f64,
    /// Of a prescribed outer ring (m/s²).
    pub(super) housing: [f64; 2],
}

impl State {
    /// Angles of cage and frames.
    pub(super) fn angles(&self) -> Angles {
        Angles { cage: self.cage.total(), frames: self.frames.map(WholeAngle::total) }
    }

    /// Copies another state of the same model; allocates nothing.
    pub(super) fn copy_from(&mut self, other: &Self) {
        let Self { time, started, cage, frames, ended, progress, reals, integers, input_rates } = self;
        (*time, *started, *ended) = (other.time, other.started, other.ended);
        (*cage, *frames) = (other.cage, other.frames);
        progress.copy_from(&other.progress);
        reals.copy_from_slice(&other.reals);
        integers.copy_from_slice(&other.integers);
        input_rates.copy_from_slice(&other.input_rates);
    }
}
