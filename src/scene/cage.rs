//! The cage: how fast it turns, and what makes passages uneven.

use crate::numerics::counter_noise::{centred, centred_draw};
use serde::{Deserialize, Serialize};

/// Kinematics of the cage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Cage {
    /// Slip: the cage's lag behind pure rolling, 0 for none, 1 for a cage that stands.
    pub slip: f64,
    /// The elements' lag behind the spin of pure rolling.
    pub spin_slip: f64,
    /// Angle of element 1 at the start (rad), counter-clockwise from +x; in an irregular cage that of its position
    /// in an even one.
    pub initial_angle: f64,
    /// What makes passages uneven; `None` for an even cage that turns evenly.
    pub irregularity: Option<CageIrregularity>,
}

/// What makes passages uneven.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CageIrregularity {
    /// Angle of each element ahead of even spacing (rad), their sum 0.
    pub offsets: Vec<f64>,
    /// Root mean square of offsets that were drawn with the seed (rad); `None` for those that were given.
    pub drawn: Option<f64>,
    /// Root mean square of each element's stationary motion about its position (rad).
    pub jitter: f64,
    /// Root mean square of the slow part of slip, as a share of the cage's speed.
    pub wander: f64,
    /// Of the random courses.
    pub seed: u64,
}

impl CageIrregularity {
    /// Root mean squares that recordings of two test rigs with 6205 bearings show, in shares of the element spacing,
    /// and the wander as a share of the cage's speed: 0.3 to 1.6 % repeat with the cage's turn, at most 0.3 to 0.6 %
    /// are stationary, and the mean speed wanders by 0.1 to 0.7 % in 5 s.
    pub const RECORDED: [f64; 3] = [0.006, 0.004, 0.003];

    /// Offsets of `count` elements drawn with a seed, of this root mean square (rad) and of sum 0.
    pub fn drawn_offsets(count: usize, rms: f64, seed: u64) -> Vec<f64> {
        centred_draw(count, rms, seed, 0)
    }

    /// Takes another seed, and draws offsets anew that were drawn.
    pub fn draw_with(&mut self, seed: u64) {
        self.seed = seed;
        if let Some(rms) = self.drawn {
            self.offsets = Self::drawn_offsets(self.offsets.len(), rms, seed);
        }
    }

    /// Offsets (rad) less their mean, so that their sum is 0.
    pub fn centred(offsets: &[f64]) -> Vec<f64> {
        centred(offsets)
    }
}
