//! One step of the explicit Runge–Kutta pair of Dormand and Prince, order 5(4), with dense output of order 4.
//!
//! Coefficients: Dormand and Prince (1980); dense output: Hairer, Nørsett and Wanner, *Solving Ordinary Differential
//! Equations I*, II.6. The last stage of a step is the first of the next.

use super::explicit::{LAST, RightHandSide, Weights, combine};
use super::stage_buffers::StageBuffers;
use crate::numerics::lanes::{Each, Lanes, Wide};

/// Order of a step, and of the one that its error is estimated by.
pub(crate) const ORDERS: [usize; 2] = [5, 4];

/// Nodes c.
pub(crate) const NODES: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];

/// Stage coefficients a; the last row is also the weights b of order 5.
pub(crate) static STAGES: [[f64; 6]; 7] = [
    [0.0; 6],
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// Weights of order 5 minus those of order 4.
pub(crate) const ERROR: [f64; 7] =
    [71.0 / 57600.0, 0.0, -71.0 / 16695.0, 71.0 / 1920.0, -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0];

const DENSE: [f64; 7] = [
    -12715105075.0 / 11282082432.0,
    0.0,
    87487479700.0 / 32700410799.0,
    -10690763975.0 / 1880347072.0,
    701980252875.0 / 199316789632.0,
    -1453857185.0 / 822651844.0,
    69997945.0 / 29380423.0,
];

/// Tries a step of length `h` from `state`; the first stage must be there.
#[inline(always)]
pub(crate) fn try_step<S: Wide>(
    simd: S,
    buffers: &mut StageBuffers,
    state: &[f64],
    h: f64,
    right_hand_side: &mut impl RightHandSide,
) {
    let StageBuffers { first, last, stages: [a, b, c, d, e, ..], end, trial, positions, partition, .. } = buffers;
    let (partition, len) = (*partition, partition.len());
    // Equal lengths, seen once, spare the checks of every sum.
    let (kinds, state, first) = (&positions[..len], &state[..len], &first[..len]);
    let (a, b, c, d, e) = (&mut a[..len], &mut b[..len], &mut c[..len], &mut d[..len], &mut e[..len]);
    let (trial, end) = (&mut trial[..len], &mut end[..len]);
    combine(simd, partition, [kinds, state, first], Weights::alike(h, &STAGES[1]), trial);
    right_hand_side.evaluate(simd, 1, trial, None, a);
    combine(simd, partition, [kinds, state, first, a], Weights::alike(h, &STAGES[2]), trial);
    right_hand_side.evaluate(simd, 2, trial, None, b);
    combine(simd, partition, [kinds, state, first, a, b], Weights::alike(h, &STAGES[3]), trial);
    right_hand_side.evaluate(simd, 3, trial, None, c);
    combine(simd, partition, [kinds, state, first, a, b, c], Weights::alike(h, &STAGES[4]), trial);
    right_hand_side.evaluate(simd, 4, trial, None, d);
    combine(simd, partition, [kinds, state, first, a, b, c, d], Weights::alike(h, &STAGES[5]), trial);
    right_hand_side.evaluate(simd, 5, trial, None, e);
    let [of_first, _, of_b, of_c, of_d, of_e] = STAGES[LAST];
    let row = [of_first, of_b, of_c, of_d, of_e];
    combine(simd, partition, [kinds, state, first, b, c, d, e], Weights::alike(h, &row), end);
    right_hand_side.evaluate(simd, LAST, end, None, last);
}

/// State at share `share` of the step tried last, whose length was `h`, into `out`.
#[inline(always)]
pub(crate) fn dense<S: Wide>(simd: S, buffers: &StageBuffers, state: &[f64], h: f64, share: f64, out: &mut [f64]) {
    let StageBuffers { first, last, stages: [_, b, c, d, e, ..], .. } = buffers;
    buffers.partition.for_each(simd, [state, &buffers.end, first, b, c, d, e, last], out, &Dense { h, share }, &mut ());
}

/// The state at a share of a step of this length: from those at its ends and all stages but the second, whose weight is
/// 0.
struct Dense {
    h: f64,
    share: f64,
}

impl Each<8, 1> for Dense {
    type Sum = ();

    #[inline(always)]
    fn each<S: Wide>(&self, simd: S, from: [Lanes<S>; 8], (): &mut ()) -> [Lanes<S>; 1] {
        let [state, after, first, b, c, d, e, last] = from;
        let [h, share, rest] = [self.h, self.share, 1.0 - self.share].map(|number| Lanes::splat(simd, number));
        let difference = after - state;
        let start = h * first - difference;
        let end = difference - h * last - start;
        let mut second = Lanes::splat(simd, DENSE[0]) * first;
        for (stage, &weight) in [b, c, d, e, last].into_iter().zip(&DENSE[2..]) {
            second = second + Lanes::splat(simd, weight) * stage;
        }
        [state + share * (difference + rest * (start + share * (end + rest * h * second)))]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::lanes::Partition;
    use crate::numerics::lanes::row::Row;
    use crate::numerics::trees;
    use pulp::Scalar256b;

    /// y' = −y² + sin τ and a linear oscillator beside it.
    fn right_hand_side(tau: f64, y: &[f64], out: &mut [f64]) {
        (out[0], out[1], out[2]) = (tau.sin() - y[0] * y[0], y[2], -4.0 * y[1]);
    }

    /// The test's equations in a step from this time on and of this length.
    struct From(f64, f64);

    impl RightHandSide for From {
        fn evaluate<S: Wide>(&mut self, _: S, stage: usize, state: &[f64], _: Option<f64>, out: &mut [f64]) {
            right_hand_side(self.0 + NODES[stage] * self.1, state, out);
        }
    }

    fn step(method: &mut StageBuffers, tau: f64, state: &[f64], h: f64) {
        try_step(Scalar256b, method, state, h, &mut From(tau, h));
    }

    fn integrate(count: usize) -> Vec<f64> {
        let mut method = StageBuffers::new(Partition { count: 0, rest: 4 }, Row::zeros(4));
        let mut state = vec![1.0, 0.0, 1.0, 0.0];
        let h = 1.0 / count as f64;
        for i in 0..count {
            let tau = i as f64 * h;
            let mut first = vec![0.0; 4];
            right_hand_side(tau, &state, &mut first);
            method.first.copy_from_slice(&first);
            step(&mut method, tau, &state, h);
            state.copy_from_slice(&method.end);
        }
        state
    }

    /// The coefficients as a square matrix, and the weights of both orders.
    fn coefficients() -> ([[f64; 7]; 7], [f64; 7], [f64; 7]) {
        let entry = |row: usize, column: usize| if column < 6 { STAGES[row][column] } else { 0.0 };
        let weights: [f64; 7] = std::array::from_fn(|j| entry(6, j));
        let matrix = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        (matrix, weights, std::array::from_fn(|j| weights[j] - ERROR[j]))
    }

    #[test]
    fn the_coefficients_satisfy_all_seventeen_conditions_of_order_five_and_the_embedded_ones_the_eight_of_order_four() {
        let (matrix, weights, embedded) = coefficients();
        for tree in trees::up_to_order(ORDERS[0]) {
            let stages = trees::weights(&tree, &matrix, &matrix);
            let miss =
                |b: [f64; 7]| (stages.iter().zip(b).map(|(phi, b)| phi * b).sum::<f64>() - 1.0 / tree.density()).abs();
            // Fractions of six digits, terms of magnitude 10: rounding only.
            assert!(miss(weights) < 1e-14, "{tree:?}: {}", miss(weights));
            assert!(tree.order() > ORDERS[1] || miss(embedded) < 1e-14, "{tree:?}: {}", miss(embedded));
        }
    }

    #[test]
    fn nodes_are_the_row_sums() {
        for (i, row) in STAGES.iter().enumerate() {
            assert!((row.iter().sum::<f64>() - NODES[i]).abs() < 1e-14, "row {i}");
        }
    }

    #[test]
    fn halving_the_step_divides_the_error_by_two_to_the_fifth() {
        let reference = integrate(2048);
        let error = |count: usize| {
            let state = integrate(count);
            (0..3).map(|i| (state[i] - reference[i]).abs()).fold(0.0, f64::max)
        };
        let observed = (error(16) / error(32)).log2();
        // The next term of the error changes the observed order by less than 0.4 at these steps.
        assert!((observed - 5.0).abs() < 0.4, "observed order {observed}");
    }

    #[test]
    fn dense_output_is_of_order_four() {
        // One step from the exact state: its dense output is wrong by O(h⁵). Largest error over the step's shares.
        let error = |h: f64| {
            let mut method = StageBuffers::new(Partition { count: 0, rest: 4 }, Row::zeros(4));
            let state = vec![0.0, 0.0, 1.0, 0.0];
            let mut first = vec![0.0; 4];
            right_hand_side(0.0, &state, &mut first);
            method.first.copy_from_slice(&first);
            step(&mut method, 0.0, &state, h);
            let mut found = vec![0.0; 4];
            (1..20)
                .map(|i| {
                    let share = i as f64 / 20.0;
                    dense(Scalar256b, &method, &state, h, share, &mut found);
                    (found[1] - 0.5 * (2.0 * share * h).sin()).abs()
                })
                .fold(0.0, f64::max)
        };
        let observed = (error(0.2) / error(0.1)).log2();
        assert!((observed - 5.0).abs() < 0.3, "observed order {observed}");
    }
}
