//! What the explicit methods share: sums of stages, error estimates, and what is asked of the equations.

use super::stage_buffers::StageBuffers;
use crate::numerics::lanes::row::Row;
use crate::numerics::lanes::{Each, Lanes, Lists, Partition, QUAD, WIDEST, Wide, after, largest_of};

/// Number of the stage at the end of a step; with either method it is the first of the next.
pub const LAST: usize = 6;

/// Stages that an error estimate is made of, with their weights.
pub(crate) type ErrorParts = [(usize, f64); 6];

/// These `stages` with what all stages weigh.
pub(super) const fn error_parts(stages: [usize; 6], weights: [f64; 7]) -> ErrorParts {
    let (mut parts, mut n) = ([(0, 0.0); 6], 0);
    while n < stages.len() {
        parts[n] = (stages[n], weights[stages[n]]);
        n += 1;
    }
    parts
}

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
    let len = buffers.partition.len();
    let (mut lists, mut factors) = ([&weights[..len]; 7], [0.0; 6]);
    for n in 0..parts.len() {
        (lists[n + 1], factors[n]) = (&stage_of(buffers, parts[n].0)[..len], parts[n].1);
    }
    buffers.partition.read(simd, lists, &Errors(factors), &mut found);
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
/// (s). What a row has beyond the stages does not count.
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

/// Puts state + h Σ weight × stage into `to`. Of the lists `from` the first is 1 for positions and 0 for velocities,
/// the second is the state, then come the stages. The one that was worked out last is to be the last: all else is ready
/// while it is waited for.
///
/// Each method writes its stages out one by one, so that weights are constants there: looked up by the stage's number,
/// they cost a step 5 to 8 % more.
#[inline(always)]
pub(super) fn combine<S: Wide, const I: usize, const N: usize>(
    simd: S,
    partition: Partition,
    from: [&[f64]; I],
    weights: Weights<N>,
    to: &mut [f64],
) {
    let (count, second, third) = (partition.count, partition.second(), partition.third());
    let Weights { h, positions, velocities } = weights;
    Lists { from, to: [&mut *to] }.for_each(simd, count, &List { h, row: positions }, &mut ());
    let lists = Lists { from: after(from, second), to: [&mut to[second..]] };
    lists.for_each(simd, count, &List { h, row: velocities }, &mut ());
    let lists = Lists { from: after(from, third), to: [&mut to[third..]] };
    lists.for_each(simd.quad(), partition.rest, &weights, &mut ());
}

/// Stages weighted alike.
struct List<'a, const N: usize> {
    h: f64,
    row: &'a [f64; N],
}

impl<const I: usize, const N: usize> Each<I, 1> for List<'_, N> {
    type Sum = ();

    #[inline(always)]
    fn each<S: Wide>(&self, simd: S, from: [Lanes<S>; I], (): &mut ()) -> [Lanes<S>; 1] {
        let mut sum = from[1];
        for n in 2..I {
            sum = sum + Lanes::splat(simd, self.h * self.row[n - 2]) * from[n];
        }
        [sum]
    }
}

impl<const I: usize, const N: usize> Each<I, 1> for Weights<'_, N> {
    type Sum = ();

    #[inline(always)]
    fn each<S: Wide>(&self, simd: S, from: [Lanes<S>; I], (): &mut ()) -> [Lanes<S>; 1] {
        let mut sum = from[1];
        for n in 2..I {
            let (position, velocity) = (self.positions[n - 2], self.velocities[n - 2]);
            let mut weight = Lanes::splat(simd, self.h * velocity);
            if position != velocity {
                weight = weight + from[0] * Lanes::splat(simd, self.h * (position - velocity));
            }
            sum = sum + weight * from[n];
        }
        [sum]
    }
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
        // By index: a chain of iterators over these arrays calls a function for each stage.
        for n in 1..self.0.len() {
            sum = sum + Lanes::splat(simd, self.0[n]) * stages[n];
        }
        let error = (weight * sum).abs();
        (Lanes::splat(simd, 0.0) * error).add_to(&mut found.poison, false);
        error.largest_to(&mut found.largest);
        []
    }
}
