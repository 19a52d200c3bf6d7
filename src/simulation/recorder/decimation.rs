//! From samples taken M times as often as rows are wanted to rows without aliases.
//!
//! Row k is Σ h(n − kM) · sample n: a low-pass of [`numerics::low_pass`](crate::numerics::low_pass) that reaches
//! [`HALF`] rows to either side, so it shifts no phase and a row's time is that of its middle sample. Samples are not
//! kept: each is added to the sums of all rows under way, of which there are fewer than [`UNDER_WAY`], so that what the
//! future depends on is short however large M is. Before its first sample everything stood as it is there.
//!
//! With F rows per second, signals pass up to F/2.56, where analysers end the alias-free part of their spectra, and
//! nothing passes from F − F/2.56 on, which is where what would fold into that part begins. Half of the amplitude
//! passes at F/2.

use crate::numerics::lanes::{Kernel, Lanes, WIDEST, Wide, blocks, blocks_mut, dispatch};
use crate::numerics::low_pass::low_pass;

/// Rows to either side of a row that its samples come from. With this many, [`ATTENUATION`] is reached between the pass
/// band and the stop band: (102 − 7.95)/(14.36 · 30) of the row rate is 1 − 2/2.56.
pub(super) const HALF: usize = 15;
/// Slots for rows under way: row k is in slot k mod this. 2·[`HALF`] + 1 rows are under way at most, so one is always
/// free.
pub(super) const UNDER_WAY: usize = 32;
/// Row rate over the end of the pass band.
pub(super) const RATE_PER_PASS: f64 = 2.56;
/// Attenuation of the stop band (dB).
const ATTENUATION: f64 = 102.0;

/// A filter that makes a row of many samples.
#[derive(Debug, Clone)]
pub(super) struct Decimation {
    /// Samples for a row, M.
    factor: u64,
    /// h, phase after phase: for each phase of a sample in a row, its weights in the slots from that of the
    /// latest row on, twice over, so that they can be read from any slot on.
    weights: Vec<[f64; 2 * UNDER_WAY]>,
    /// Sum of the weights that the first rows have before the first sample.
    before: [f64; HALF],
}

/// Where a sample is among the rows.
#[derive(Debug, Clone, Copy)]
pub(super) struct RowPhase {
    /// Number of the row that it is in the middle of or behind.
    pub(super) row: u64,
    /// How many samples behind.
    pub(super) phase: usize,
}

impl Decimation {
    /// `factor` samples for a row.
    pub(in crate::simulation) fn new(factor: u64) -> Self {
        let m = factor as usize;
        let h = low_pass(HALF * m, 0.5 / factor as f64, ATTENUATION);
        // So many slots on from the latest row's is, the ring being closed, a row that much short of it older.
        let weight = |phase: usize, slots: usize| {
            let older = (UNDER_WAY - slots % UNDER_WAY) % UNDER_WAY;
            h.get(phase + older * m).copied().unwrap_or(0.0)
        };
        Self {
            factor,
            weights: (0..m).map(|phase| std::array::from_fn(|slots| weight(phase, slots))).collect(),
            before: std::array::from_fn(|row| h[..(HALF - row) * m].iter().sum()),
        }
    }

    /// Samples for a row.
    pub(super) fn factor(&self) -> u64 {
        self.factor
    }

    /// Where sample number `sample` is among the rows.
    pub(super) fn row_phase(&self, sample: u64) -> RowPhase {
        RowPhase { row: sample / self.factor, phase: (sample % self.factor) as usize }
    }

    /// Rows that are complete when so many samples have been taken.
    pub(super) fn complete(&self, samples: u64) -> u64 {
        let begun = samples.div_ceil(self.factor);
        begun.saturating_sub(HALF as u64)
    }

    /// Adds a sample at this phase to the sums of all rows that it belongs to. `sums` has all slots of the sample's
    /// first number, then all of its second, and so on.
    pub(in crate::simulation) fn add(&self, RowPhase { row, phase }: RowPhase, sample: &[f64], sums: &mut [f64]) {
        let latest = slot(row + HALF as u64);
        if phase == 0 {
            self.begin(row, latest, sample, sums);
        }
        dispatch(Add { weights: &self.weights[phase][UNDER_WAY - latest..][..UNDER_WAY], sample, sums });
    }

    /// The row in slot `latest` is one that this sample, in the middle of `row`, is the first of. So are all before it
    /// if there was no sample before.
    fn begin(&self, row: u64, latest: usize, sample: &[f64], sums: &mut [f64]) {
        for (sums, value) in sums.chunks_exact_mut(UNDER_WAY).zip(sample) {
            if row == 0 {
                for (sum, weight) in sums.iter_mut().zip(self.before) {
                    *sum = weight * value;
                }
            }
            sums[latest] = 0.0;
        }
    }
}

/// Where a row is kept among those under way.
pub(super) fn slot(row: u64) -> usize {
    (row % UNDER_WAY as u64) as usize
}

/// Adds each number of a sample times the weights of all slots to its sums.
struct Add<'a> {
    weights: &'a [f64],
    sample: &'a [f64],
    sums: &'a mut [f64],
}

impl Kernel for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        let Self { weights, sample, sums } = self;
        let weights = blocks(weights);
        for (sums, &value) in blocks_mut(sums).chunks_exact_mut(weights.len()).zip(sample) {
            let value = Lanes::splat(simd, value);
            for (sums, weights) in sums.iter_mut().zip(weights) {
                for part in 0..WIDEST / S::F64_LANES {
                    let sum = Lanes::part(simd, sums, part) + Lanes::part(simd, weights, part) * value;
                    sum.put(sums, part);
                }
            }
        }
    }
}
