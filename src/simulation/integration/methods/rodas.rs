//! One step of Rodas5P, a linearly implicit (Rosenbrock–Wanner) method of order 5(4) for stiff equations.
//!
//! Eight linear systems with one matrix W = 1/(hγ) − J and no iteration; stiffly accurate and L-stable, so what is
//! stiff and has died away costs no step size. With k the stages:
//! ```text
//! W k_i = f(t + c_i h, y + Σ a_ij k_j) + Σ C_ij k_j/h + h d_i ∂f/∂t,   y₁ = y + Σ a_8j k_j + k_8,   error = k_8
//! ```
//! Coefficients: Steinebach, *Construction of Rosenbrock–Wanner method Rodas5P and numerical benchmarks within the
//! Julia Differential Equations package*, BIT 63 (2023) 27, in the transformed form printed by OrdinaryDiffEq.jl. The
//! last three stages share their argument's first five weights: each adds its predecessor. Dense output of order 4.
//!
//! J and ∂f/∂t must be exact for the order to hold. At the onset of a contact they jump; steps end there.

use super::stage_buffers::StageBuffers;
use crate::numerics::lanes::row::Row;
use crate::numerics::lanes::{Each, Lanes, Wide};

/// Order of a step, and of the one that its error is estimated by.
pub(crate) const ORDERS: [usize; 2] = [5, 4];

/// γ
pub(crate) const GAMMA: f64 = 0.21193756319429014;

/// Nodes c.
pub(crate) const NODES: [f64; 8] =
    [0.0, 0.6358126895828704, 0.4095798393397535, 0.9769306725060716, 0.4288403609558664, 1.0, 1.0, 1.0];

/// Weights d of the derivative by time.
pub(crate) const TIME: [f64; 8] =
    [GAMMA, -0.42387512638858027, -0.3384627126235924, 1.8046452872882734, 2.325825639765069, 0.0, 0.0, 0.0];

/// a. The last row is also the solution of order 4; with k₈ added, of weight 1, it is that of order 5.
pub(crate) const STAGES: [[f64; 7]; 8] = [
    [0.0; 7],
    [3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [2.849394379747939, 0.45842242204463923, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-6.954028509809101, 2.489845061869568, -10.358996098473584, 0.0, 0.0, 0.0, 0.0],
    [2.8029986275628964, 0.5072464736228206, -0.3988312541770524, -0.04721187230404641, 0.0, 0.0, 0.0],
    LAST,
    [LAST[0], LAST[1], LAST[2], LAST[3], LAST[4], 1.0, 0.0],
    [LAST[0], LAST[1], LAST[2], LAST[3], LAST[4], 1.0, 1.0],
];

const LAST: [f64; 7] =
    [-7.502846399306121, 2.561846144803919, -11.627539656261098, -0.18268767659942256, 0.030198172008377946, 0.0, 0.0];

/// C
pub(crate) const COUPLING: [[f64; 7]; 8] = [
    [0.0; 7],
    [-14.155112264123755, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-17.97296035885952, -2.859693295451294, 0.0, 0.0, 0.0, 0.0, 0.0],
    [147.12150275711716, -1.41221402718213, 71.68940251302358, 0.0, 0.0, 0.0, 0.0],
    [165.43517024871676, -0.4592823456491126, 42.90938336958603, -5.961986721573306, 0.0, 0.0, 0.0],
    [24.854864614690072, -3.0009227002832186, 47.4931110020768, 5.5814197821558125, -0.6610691825249471, 0.0, 0.0],
    [
        30.91273214028599,
        -3.1208243349937974,
        77.79954646070892,
        34.28646028294783,
        -19.097331116725623,
        -28.087943162872662,
        0.0,
    ],
    [
        37.80277123390563,
        -3.2571969029072276,
        112.26918849496327,
        66.9347231244047,
        -40.06618937091002,
        -54.66780262877968,
        -9.48861652309627,
    ],
];

/// Dense output: three sums over the stages.
pub(crate) const DENSE: [[f64; 8]; 3] = [
    [
        25.948786856663858,
        -2.5579724845846235,
        10.433815404888879,
        -2.3679251022685204,
        0.524948541321073,
        1.1241088310450404,
        0.4272876194431874,
        -0.17202221070155493,
    ],
    [
        -9.91568850695171,
        -0.9689944594115154,
        3.0438037242978453,
        -24.495224566215796,
        20.176138334709044,
        15.98066361424651,
        -6.789040303419874,
        -6.710236069923372,
    ],
    [
        11.419903575922262,
        2.8879645146136994,
        72.92137995996029,
        80.12511834622643,
        -52.072871366152654,
        -59.78993625266729,
        -0.15582684282751913,
        4.883087185713722,
    ],
];

/// Some lists, and the stages after them.
#[inline(always)]
fn lists<'a, const N: usize>(first: &[&'a [f64]], stages: &'a [Row]) -> [&'a [f64]; N] {
    std::array::from_fn(|i| if i < first.len() { first[i] } else { &*stages[i - first.len()] })
}

/// Tries a step of length `h` from `state`, whose derivative is [`StageBuffers::first`] and its derivative by time
/// `by_time`.
#[inline(always)]
pub(crate) fn try_step<S: Wide>(
    simd: S,
    buffers: &mut StageBuffers,
    state: &[f64],
    by_time: &[f64],
    h: f64,
    system: &mut impl System,
) {
    let StageBuffers { first, stages, end, trial, slope, partition, .. } = buffers;
    partition.for_each(simd, [first, by_time], &mut stages[0], &Coupled::<0>(h), &mut ());
    system.solve(&mut stages[0]);
    for stage in 1..8 {
        let (done, rest) = stages.split_at_mut(stage);
        let k = &mut rest[0];
        match stage {
            1 => partition.for_each(simd, lists(&[state], done), trial, &Argument::<1>, &mut ()),
            2 => partition.for_each(simd, lists(&[state], done), trial, &Argument::<2>, &mut ()),
            3 => partition.for_each(simd, lists(&[state], done), trial, &Argument::<3>, &mut ()),
            4 => partition.for_each(simd, lists(&[state], done), trial, &Argument::<4>, &mut ()),
            5 => partition.for_each(simd, lists(&[state], done), trial, &Argument::<5>, &mut ()),
            _ => {
                slope.copy_from_slice(trial);
                partition.for_each(simd, [slope, &done[stage - 1]], trial, &Sum, &mut ());
            }
        }
        system.evaluate(simd, stage, trial, slope);
        match stage {
            1 => partition.for_each(simd, lists(&[slope, by_time], done), k, &Coupled::<1>(h), &mut ()),
            2 => partition.for_each(simd, lists(&[slope, by_time], done), k, &Coupled::<2>(h), &mut ()),
            3 => partition.for_each(simd, lists(&[slope, by_time], done), k, &Coupled::<3>(h), &mut ()),
            4 => partition.for_each(simd, lists(&[slope, by_time], done), k, &Coupled::<4>(h), &mut ()),
            5 => partition.for_each(simd, lists(&[slope, by_time], done), k, &Coupled::<5>(h), &mut ()),
            6 => partition.for_each(simd, lists(&[slope, by_time], done), k, &Coupled::<6>(h), &mut ()),
            _ => partition.for_each(simd, lists(&[slope, by_time], done), k, &Coupled::<7>(h), &mut ()),
        }
        system.solve(k);
    }
    partition.for_each(simd, [trial, &stages[7]], end, &Sum, &mut ());
}

/// Largest magnitude of the error estimate of the step tried last, each component times its weight; infinite as
/// soon as one is no finite number.
pub(crate) fn largest_error(buffers: &StageBuffers, weights: &[f64]) -> f64 {
    let (mut largest, mut poison) = (0.0f64, 0.0);
    for (error, weight) in buffers.stages[7].iter().zip(weights) {
        largest = largest.max((error * weight).abs());
        poison += 0.0 * error;
    }
    if poison == 0.0 { largest } else { f64::INFINITY }
}

/// Error estimate of component `i` of the step tried last.
pub(crate) fn error(buffers: &StageBuffers, i: usize) -> f64 {
    buffers.stages[7][i]
}

/// State at share `share` of the step tried last, into `out`.
#[inline(always)]
pub(crate) fn dense<S: Wide>(simd: S, buffers: &StageBuffers, state: &[f64], share: f64, out: &mut [f64]) {
    let rest = 1.0 - share;
    let mut weights = [0.0; 8];
    for (i, weight) in weights.iter_mut().enumerate() {
        *weight = share * rest * (DENSE[0][i] + share * (DENSE[1][i] + share * DENSE[2][i]));
    }
    let [a, b, c, d, e, f, g, last] = &buffers.stages;
    let from = [state, &buffers.end, a, b, c, d, e, f, g, last];
    buffers.partition.for_each(simd, from, out, &Dense { share, weights }, &mut ());
}

/// What the method integrates.
pub(crate) trait System {
    /// Puts the derivative of `state` at the node of a stage, 1 to 7, into `out`. To be marked `inline(always)`.
    fn evaluate<S: Wide>(&mut self, simd: S, stage: usize, state: &[f64], out: &mut [f64]);

    /// Puts (1/(hγ) − J)⁻¹ b into b.
    fn solve(&self, b: &mut [f64]);
}

/// The argument of one of the first stages: state and all stages before it.
struct Argument<const STAGE: usize>;

/// The right-hand side of one stage's linear system, for a step of this length: slope, ∂f/∂t and all stages before it.
struct Coupled<const STAGE: usize>(f64);

/// The state at a share of the step: from those at its ends and all stages with these weights.
struct Dense {
    share: f64,
    weights: [f64; 8],
}

impl Each<10, 1> for Dense {
    type Sum = ();

    #[inline(always)]
    fn each<S: Wide>(&self, simd: S, from: [Lanes<S>; 10], (): &mut ()) -> [Lanes<S>; 1] {
        let [state, after, stages @ ..] = from;
        let mut sum = Lanes::splat(simd, 1.0 - self.share) * state + Lanes::splat(simd, self.share) * after;
        for (stage, weight) in stages.into_iter().zip(self.weights) {
            sum = sum + Lanes::splat(simd, weight) * stage;
        }
        [sum]
    }
}

/// The sum of two lists.
struct Sum;

macro_rules! stages {
    ($($stage:literal: $argument:literal, $coupled:literal;)*) => {$(
        impl Each<$argument, 1> for Argument<$stage> {
            type Sum = ();

            #[inline(always)]
            fn each<S: Wide>(&self, simd: S, from: [Lanes<S>; $argument], (): &mut ()) -> [Lanes<S>; 1] {
                let mut sum = from[0];
                for (&weight, &stage) in STAGES[$stage].iter().zip(&from[1..]) {
                    sum = sum + Lanes::splat(simd, weight) * stage;
                }
                [sum]
            }
        }

        impl Each<$coupled, 1> for Coupled<$stage> {
            type Sum = ();

            #[inline(always)]
            fn each<S: Wide>(&self, simd: S, from: [Lanes<S>; $coupled], (): &mut ()) -> [Lanes<S>; 1] {
                let mut sum = from[0];
                for (&weight, &stage) in COUPLING[$stage].iter().zip(&from[2..]) {
                    sum = sum + Lanes::splat(simd, weight / self.0) * stage;
                }
                if TIME[$stage] != 0.0 {
                    sum = sum + Lanes::splat(simd, self.0 * TIME[$stage]) * from[1];
                }
                [sum]
            }
        }
    )*};
}

stages!(0: 1, 2; 1: 2, 3; 2: 3, 4; 3: 4, 5; 4: 5, 6; 5: 6, 7; 6: 7, 8; 7: 8, 9;);

impl Each<2, 1> for Sum {
    type Sum = ();

    #[inline(always)]
    fn each<S: Wide>(&self, _: S, [a, b]: [Lanes<S>; 2], (): &mut ()) -> [Lanes<S>; 1] {
        [a + b]
    }
}

#[cfg(test)]
mod tests;
