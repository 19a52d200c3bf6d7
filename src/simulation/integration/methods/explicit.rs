//! What the explicit methods share: sums of stages, error estimates, and what is asked of the equations.

use super::stage_buffers::StageBuffers;
use crate::numerics::lanes::row::Row;
use crate::numerics::lanes::{
    Each, Lanes, Partition, QUAD, WIDEST, Wide, blocks, blocks_mut, largest_of, quads, quads_mut,
};

/// Number of the stage at the end of a step; with either method it is the first of the next.
pub const LAST: usize = 6;

/// Stages that an error estimate is made of, with their weights.
pub(crate) type ErrorParts = [(usize, f64); 6];

/// A stage by its number.
#[inline(always)]
fn stage_of(buffers: &StageBuffers, number: usize) -> &Row {
    match number {
        0 => &buffers.first,
        LAST => &buffers.last,
        _ => &buffers.stages[number - 1],
    }
}

/// Largest magnitude of the error estimate of the step tried last, each component times its weight; infinite as soon as
/// one is no finite number.
#[inline(always)]
pub fn largest_error<S: Wide>(simd: S, buffers: &StageBuffers, parts: ErrorParts, h: f64, weights: &[f64]) -> f64 {
    let mut found = Found { largest: [0.0; QUAD], poison: [0.0; WIDEST] };
    let [a, b, c, d, e, f] = parts.map(|(number, _)| &stage_of(buffers, number)[..]);
    buffers.partition.read(simd, [weights, a, b, c, d, e, f], &Errors(parts.map(|(_, weight)| weight)), &mut found);
    if found.poison == [0.0; WIDEST] { h * largest_of(found.largest) } else { f64::INFINITY }
}

/// Error estimate of component `i` of the step tried last.
pub(crate) fn error(buffers: &StageBuffers, parts: ErrorParts, i: usize, h: f64) -> f64 {
    let mut sum = 0.0;
    for (stage, weight) in parts {
        sum += weight * stage_of(buffers, stage)[i];
    }
    h * sum
}

/// How stages are weighted, the one row for positions and the other for velocities; both times the step's length `h`
/// (s).
#[derive(Debug, Clone, Copy)]
pub(super) struct Weights<'a, const N: usize> {
    pub(super) h: f64,
    pub(super) positions: &'a [f64; N],
    pub(super) velocities: &'a [f64; N],
}

impl<'a, const N: usize> Weights<'a, N> {
    /// One row for positions and velocities.
    #[inline(always)]
    pub(super) fn alike(h: f64, row: &'a [f64; N]) -> Self {
        Self { h, positions: row, velocities: row }
    }
}

/// Puts `state` + h Σ weight × stage into `to`; `kinds` is 1 for positions, 0 for velocities. The stage that was worked
/// out last is to come last: all else is ready while it is waited for.
///
/// Each method writes its stages out one by one, so that weights are constants there: looked up by the stage's number,
/// they cost a step 5 to 8 % more.
#[inline(always)]
pub(super) fn combine<S: Wide, const N: usize>(
    simd: S,
    partition: Partition,
    kinds: &[f64],
    state: &[f64],
    stages: [&[f64]; N],
    Weights { h, positions, velocities }: Weights<N>,
    to: &mut [f64],
) {
    let (half, whole) = (partition.second() / WIDEST, partition.third() / WIDEST);
    let mut lists = [&blocks(state)[..whole]; N];
    for (list, stage) in lists.iter_mut().zip(stages) {
        *list = &blocks(stage)[..whole];
    }
    let (state_blocks, to_blocks) = (&blocks(state)[..whole], &mut blocks_mut(to)[..whole]);
    for (row, start) in [(positions, 0), (velocities, half)] {
        let mut weights = [Lanes::splat(simd, 0.0); N];
        for (weight, of_row) in weights.iter_mut().zip(row) {
            *weight = Lanes::splat(simd, h * of_row);
        }
        for k in start..start + half {
            for part in 0..WIDEST / S::F64_LANES {
                let mut sum = Lanes::part(simd, &state_blocks[k], part);
                for n in 0..N {
                    if row[n] != 0.0 {
                        sum = sum + weights[n] * Lanes::part(simd, &lists[n][k], part);
                    }
                }
                sum.put(&mut to_blocks[k], part);
            }
        }
    }
    let third = partition.third();
    let (quad, state, to) = (simd.quad(), quads(&state[third..]), quads_mut(&mut to[third..]));
    let kinds = &quads(&kinds[third..])[..to.len()];
    let mut lists = [&state[..to.len()]; N];
    for (list, stage) in lists.iter_mut().zip(stages) {
        *list = &quads(&stage[third..])[..to.len()];
    }
    for (k, to) in to.iter_mut().enumerate() {
        let kind = Lanes::<S>::of(simd, kinds[k]);
        let mut sum = Lanes::<S>::of(simd, state[k]);
        for n in 0..N {
            if positions[n] == velocities[n] {
                if positions[n] != 0.0 {
                    sum = sum + Lanes::splat(quad, h * positions[n]) * Lanes::<S>::of(simd, lists[n][k]);
                }
                continue;
            }
            let more = Lanes::splat(quad, h * (positions[n] - velocities[n]));
            let weight = Lanes::splat(quad, h * velocities[n]) + kind * more;
            sum = sum + weight * Lanes::<S>::of(simd, lists[n][k]);
        }
        sum.store(to, 0);
    }
}

/// The first of a row.
#[inline(always)]
pub(super) fn row<const N: usize, const ALL: usize>(row: [f64; ALL]) -> [f64; N] {
    std::array::from_fn(|i| row[i])
}

/// What the methods integrate.
pub trait RightHandSide {
    /// Puts the derivative of `state` at the node of a stage into `out`. With a time `ahead` (s), what counts are the
    /// positions that the velocities in `state` reach in that time from those in `state`. Asked for stages 1 to
    /// [`LAST`], the last one at the end of the step and without `ahead`. To be marked `inline(always)`.
    fn evaluate<S: Wide>(&mut self, simd: S, stage: usize, state: &[f64], ahead: Option<f64>, out: &mut [f64]);
}

/// Weighted errors, with the weights of the stages.
struct Errors([f64; 6]);

struct Found {
    largest: [f64; QUAD],
    /// 0 times every error: 0, unless one is no finite number.
    poison: [f64; WIDEST],
}

impl Each<7, 0> for Errors {
    type Sum = Found;

    #[inline(always)]
    fn each<S: Wide>(&self, simd: S, [weight, stages @ ..]: [Lanes<S>; 7], found: &mut Found) -> [Lanes<S>; 0] {
        let mut sum = Lanes::splat(simd, self.0[0]) * stages[0];
        // By index: a chain of iterators over these arrays is not resolved when the library is optimised as a whole,
        // and calls a function for each stage.
        for n in 1..self.0.len() {
            sum = sum + Lanes::splat(simd, self.0[n]) * stages[n];
        }
        let error = (weight * sum).abs();
        (Lanes::splat(simd, 0.0) * error).add_to(&mut found.poison, false);
        error.largest_to(&mut found.largest);
        []
    }
}
