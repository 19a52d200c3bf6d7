//! One step of the explicit Runge–Kutta pair of Dormand and Prince, order 5(4), with dense output of order 4.
//!
//! Coefficients: Dormand and Prince (1980); dense output: Hairer, Nørsett and Wanner, *Solving Ordinary Differential
//! Equations I*, II.6. The last stage of a step is the first of the next.

/// Nodes c.
pub const NODES: [f64; 7] = [0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0];

/// Stage coefficients a; the last row is also the weights b of order 5.
pub const STAGES: [[f64; 6]; 7] = [
    [0.0; 6],
    [0.2, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];

/// Weights of order 5 minus those of order 4.
pub const ERROR: [f64; 7] =
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

/// Room for the stages of a step, made once.
#[derive(Debug, Clone, Default)]
pub struct DormandPrince {
    /// Stage derivatives; the first is that at the start of the step.
    pub stages: [Vec<f64>; 7],
    /// State at the end of the step tried last.
    pub end: Vec<f64>,
    trial: Vec<f64>,
}

impl DormandPrince {
    /// Room for `len` states.
    pub fn new(len: usize) -> Self {
        let zeros = || vec![0.0; len];
        Self { stages: std::array::from_fn(|_| zeros()), end: zeros(), trial: zeros() }
    }

    /// Tries a step of length `h` from `state`; the first stage must be there. `derivative(c h, state, out, stage)` is
    /// asked for stages 1 to 6, the last at the end of the step.
    pub fn try_step(&mut self, state: &[f64], h: f64, mut derivative: impl FnMut(f64, &[f64], &mut [f64], usize)) {
        for stage in 1..7 {
            let (done, rest) = self.stages.split_at_mut(stage);
            combine(&mut self.trial, state, done, &STAGES[stage], h);
            if stage == 6 {
                self.end.copy_from_slice(&self.trial);
            }
            derivative(NODES[stage] * h, &self.trial, &mut rest[0], stage);
        }
    }

    /// Error estimate of component `i` of the step tried last.
    #[inline]
    pub fn error(&self, i: usize, h: f64) -> f64 {
        let mut sum = 0.0;
        for (stage, weight) in self.stages.iter().zip(ERROR) {
            sum += weight * stage[i];
        }
        h * sum
    }

    /// State at share `share` of the step tried last, into `out`.
    pub fn dense(&self, state: &[f64], h: f64, share: f64, out: &mut [f64]) {
        let rest = 1.0 - share;
        for (i, value) in out.iter_mut().enumerate() {
            let difference = self.end[i] - state[i];
            let start = h * self.stages[0][i] - difference;
            let end = difference - h * self.stages[6][i] - start;
            let mut bend = 0.0;
            for (stage, weight) in self.stages.iter().zip(DENSE) {
                bend += weight * stage[i];
            }
            *value = state[i] + share * (difference + rest * (start + share * (end + rest * h * bend)));
        }
    }

    /// Makes the last stage of the step tried last the first of the next.
    pub fn carry_over(&mut self) {
        self.stages.swap(0, 6);
    }
}

#[inline]
fn combine(out: &mut [f64], state: &[f64], stages: &[Vec<f64>], weights: &[f64; 6], h: f64) {
    for (i, value) in out.iter_mut().enumerate() {
        let mut sum = 0.0;
        for (stage, weight) in stages.iter().zip(weights) {
            sum += weight * stage[i];
        }
        *value = state[i] + h * sum;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::trees;

    /// y' = −y² + sin τ and a linear oscillator beside it.
    fn right_hand_side(tau: f64, y: &[f64], out: &mut [f64]) {
        (out[0], out[1], out[2]) = (tau.sin() - y[0] * y[0], y[2], -4.0 * y[1]);
    }

    fn integrate(count: usize) -> Vec<f64> {
        let mut method = DormandPrince::new(3);
        let mut state = vec![1.0, 0.0, 1.0];
        let h = 1.0 / count as f64;
        for i in 0..count {
            let tau = i as f64 * h;
            let mut first = vec![0.0; 3];
            right_hand_side(tau, &state, &mut first);
            method.stages[0] = first;
            method.try_step(&state, h, |c, y, out, _| right_hand_side(tau + c, y, out));
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
        for tree in trees::up_to_order(5) {
            let stages = trees::weights(&tree, &matrix, &matrix);
            let miss =
                |b: [f64; 7]| (stages.iter().zip(b).map(|(phi, b)| phi * b).sum::<f64>() - 1.0 / tree.density()).abs();
            // Fractions of six digits, terms of magnitude 10: rounding only.
            assert!(miss(weights) < 1e-14, "{tree:?}: {}", miss(weights));
            assert!(tree.order() == 5 || miss(embedded) < 1e-14, "{tree:?}: {}", miss(embedded));
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
            let mut method = DormandPrince::new(3);
            let state = vec![0.0, 0.0, 1.0];
            let mut first = vec![0.0; 3];
            right_hand_side(0.0, &state, &mut first);
            method.stages[0] = first;
            method.try_step(&state, h, |c, y, out, _| right_hand_side(c, y, out));
            let mut found = vec![0.0; 3];
            (1..20)
                .map(|i| {
                    let share = i as f64 / 20.0;
                    method.dense(&state, h, share, &mut found);
                    (found[1] - 0.5 * (2.0 * share * h).sin()).abs()
                })
                .fold(0.0, f64::max)
        };
        let observed = (error(0.2) / error(0.1)).log2();
        assert!((observed - 5.0).abs() < 0.3, "observed order {observed}");
    }
}
