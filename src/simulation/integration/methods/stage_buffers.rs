//! Room for a step, made once. One method steps at a time, and all of them keep their stages here.

use crate::numerics::lanes::Partition;
use crate::numerics::lanes::row::Row;

/// Room for the stages of a step. States are parted as [`Partition`] says.
#[derive(Debug, Clone)]
pub struct StageBuffers {
    /// Derivative at the start of the step.
    pub first: Row,
    /// Derivative at its end, which is that at the start of the next.
    pub last: Row,
    /// The implicit method's stages; of an explicit one those between `first` and `last`, from number 1 on.
    pub(super) stages: [Row; 8],
    /// State at the end of the step tried last.
    pub end: Row,
    pub(super) trial: Row,
    pub(in crate::simulation) slope: Row,
    /// 1 where a state is a position, 0 elsewhere.
    pub(super) positions: Row,
    pub(super) partition: Partition,
}

impl StageBuffers {
    /// Room for states that are cut in this way; 1 in `positions` where a state is a position.
    pub fn new(partition: Partition, positions: Row) -> Self {
        let zeros = || Row::zeros(partition.len());
        Self {
            first: zeros(),
            last: zeros(),
            stages: std::array::from_fn(|_| zeros()),
            end: zeros(),
            trial: zeros(),
            slope: zeros(),
            positions,
            partition,
        }
    }

    /// Makes the derivative at the end of the step tried last that at the start of the next.
    pub fn carry_over(&mut self) {
        std::mem::swap(&mut self.first, &mut self.last);
    }
}
