//! All that the future of a simulation depends on, and nothing else. It is what runs: taking it is a copy, putting it
//! back another.

use crate::dynamics::parameters::WholeAngle;
use crate::simulation::integration::Progress;
use crate::simulation::interface::Angles;

/// Everything that the future of a [`Simulation`](super::life::Simulation) depends on; taking it and putting it back
/// changes no bit.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    pub(super) time: f64,
    pub(in crate::simulation) started: bool,
    pub(super) cage: WholeAngle,
    /// Angles of the frames of defects, in the order of [`crate::dynamics::parameters::Frame`].
    pub(in crate::simulation) frames: [WholeAngle; 3],
    pub(in crate::simulation) ended: Ended,
    pub(in crate::simulation) progress: Progress,
    /// Values of inputs and real parameters, by index in the table; outputs follow from all the rest.
    pub(in crate::simulation) reals: Vec<f64>,
    /// Those of enumerations, by index.
    pub(in crate::simulation) integers: Vec<i32>,
    /// First and second derivatives of inputs for the next step, where the host has given any, by index.
    pub(in crate::simulation) input_rates: Vec<[Option<f64>; 2]>,
}

/// Accelerations at the end of the last step that derivatives of inputs gave and no input says: outputs at that instant
/// follow from them. Gone once the host sets an input.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::simulation) struct Ended {
    /// Of the cage (rad/s²).
    pub(super) cage: f64,
    /// Of a prescribed outer ring (m/s²).
    pub(in crate::simulation) housing: [f64; 2],
}

impl State {
    /// Angles of cage and frames.
    pub(in crate::simulation) fn angles(&self) -> Angles {
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
