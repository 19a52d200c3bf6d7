//! The two explicit pairs of methods, and what a step asks of whichever one takes it.

use super::explicit::{ErrorParts, LAST, RightHandSide, error_parts};
use super::stage_buffers::StageBuffers;
use super::{dormand_prince, phase_fitted};
use crate::numerics::lanes::Wide;

/// The explicit methods.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ExplicitMethod {
    /// `dormand_prince`: order 5(4), for any tolerance.
    #[default]
    DormandPrince,
    /// [`phase_fitted`]: order 4(3), with longer steps where something oscillates.
    PhaseFitted,
}

impl ExplicitMethod {
    /// Nodes c up to the end of the step; where one method has a stage less, its last is the end.
    pub fn nodes(self) -> [f64; LAST] {
        match self {
            Self::DormandPrince => std::array::from_fn(|i| dormand_prince::NODES[i]),
            Self::PhaseFitted => phase_fitted::NODES,
        }
    }

    /// Weights b of the stages.
    pub fn weights(self) -> [f64; LAST] {
        match self {
            Self::DormandPrince => dormand_prince::STAGES[LAST],
            Self::PhaseFitted => phase_fitted::WEIGHTS,
        }
    }

    /// Stages that the error estimate is made of, with their weights.
    #[inline(always)]
    pub fn error_parts(self) -> ErrorParts {
        match self {
            Self::DormandPrince => const { error_parts([0, 2, 3, 4, 5, 6], dormand_prince::ERROR) },
            Self::PhaseFitted => const { error_parts([0, 1, 2, 3, 4, 6], phase_fitted::ERROR) },
        }
    }

    /// Tries a step of length `h` from `state`; the first stage must be there.
    #[inline(always)]
    pub fn try_step<S: Wide>(
        self,
        simd: S,
        buffers: &mut StageBuffers,
        state: &[f64],
        h: f64,
        right_hand_side: &mut impl RightHandSide,
    ) {
        match self {
            Self::DormandPrince => dormand_prince::try_step(simd, buffers, state, h, right_hand_side),
            Self::PhaseFitted => phase_fitted::try_step(simd, buffers, state, h, right_hand_side),
        }
    }
}
