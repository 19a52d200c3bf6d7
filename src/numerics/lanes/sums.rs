//! Sums over elements, several side by side.

use super::{Lanes, WIDEST, Wide, sum_of};

/// Sums of `N` numbers by lanes: eight sums each, whatever the registers.
///
/// In registers of their own kind: added to a half of eight numbers that is found out late, a sum would be written in
/// quarters and read together, at 15 cycles each.
#[derive(Debug)]
pub struct Sums<S: Wide, const N: usize>([[Lanes<S>; 2]; N]);

impl<S: Wide, const N: usize> Sums<S, N> {
    /// Of nothing yet.
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        Self([[Lanes::splat(simd, 0.0); 2]; N])
    }

    /// Adds the numbers of this part of a block.
    #[inline(always)]
    pub fn add(&mut self, part: usize, numbers: &[Lanes<S>]) {
        let half = part % (WIDEST / S::F64_LANES);
        for (lanes, &number) in self.0.iter_mut().zip(numbers) {
            lanes[half] = lanes[half] + number;
        }
    }

    /// The sums over all lanes.
    #[inline(always)]
    pub fn totals(&self) -> [f64; N] {
        let mut totals = [0.0; N];
        for (total, halves) in totals.iter_mut().zip(&self.0) {
            let mut lanes = [0.0; WIDEST];
            for (part, half) in halves.iter().enumerate().take(WIDEST / S::F64_LANES) {
                half.put(&mut lanes, part);
            }
            *total = sum_of(lanes);
        }
        totals
    }
}
