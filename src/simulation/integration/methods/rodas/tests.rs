use crate::numerics::lanes::Partition;
use crate::numerics::trees;
use crate::simulation::integration::methods::rodas::*;
use pulp::Scalar256b;

/// (α, Γ, b) of the untransformed method: Γ⁻¹ = 1/γ − C, α = a Γ, b = m Γ.
fn untransformed() -> ([[f64; 8]; 8], [[f64; 8]; 8], [f64; 8]) {
    // Forward substitution for the lower triangle Γ.
    let mut gamma = [[0.0; 8]; 8];
    for column in 0..8 {
        for row in column..8 {
            let unit = if row == column { 1.0 } else { 0.0 };
            let sum: f64 = (column..row).map(|k| COUPLING[row][k] * gamma[k][column]).sum();
            gamma[row][column] = GAMMA * (unit + sum);
        }
    }
    let mut alpha = [[0.0; 8]; 8];
    let mut b = [0.0; 8];
    for j in 0..8 {
        for i in 0..8 {
            alpha[i][j] = (0..7).map(|k| STAGES[i][k] * gamma[k][j]).sum();
        }
        b[j] = (0..8).map(|k| if k < 7 { STAGES[7][k] } else { 1.0 } * gamma[k][j]).sum();
    }
    (alpha, gamma, b)
}

// Coefficients have 16 digits, and magnitudes of 100 cancel in them.
const CANCELLATION: f64 = 1e-12;

#[test]
fn the_coefficients_satisfy_all_seventeen_conditions_of_order_five() {
    let (alpha, gamma, b) = untransformed();
    let beta: [[f64; 8]; 8] = std::array::from_fn(|i| std::array::from_fn(|j| alpha[i][j] + gamma[i][j]));
    for tree in trees::up_to_order(ORDERS[0]) {
        let sum: f64 = trees::weights(&tree, &alpha, &beta).iter().zip(b).map(|(phi, b)| phi * b).sum();
        assert!((sum - 1.0 / tree.density()).abs() < CANCELLATION, "{tree:?}: {sum}");
    }
}

#[test]
fn the_embedded_weights_satisfy_all_eight_conditions_of_order_four_but_not_those_of_five() {
    let (alpha, gamma, b) = untransformed();
    let beta: [[f64; 8]; 8] = std::array::from_fn(|i| std::array::from_fn(|j| alpha[i][j] + gamma[i][j]));
    // Without k₈: take its row of Γ away.
    let embedded: [f64; 8] = std::array::from_fn(|j| b[j] - gamma[7][j]);
    let mut worst = 0.0f64;
    for tree in trees::up_to_order(ORDERS[0]) {
        let sum: f64 = trees::weights(&tree, &alpha, &beta).iter().zip(embedded).map(|(phi, b)| phi * b).sum();
        let error = (sum - 1.0 / tree.density()).abs();
        if tree.order() <= ORDERS[1] {
            assert!(error < CANCELLATION, "{tree:?}: {sum}");
        } else {
            worst = worst.max(error);
        }
    }
    assert!(worst > 1e-4, "an estimate that is itself of order 5 sees no error: {worst}");
}

#[test]
fn nodes_and_time_weights_are_the_row_sums() {
    let (alpha, gamma, _) = untransformed();
    for i in 0..8 {
        assert!((alpha[i].iter().sum::<f64>() - NODES[i]).abs() < CANCELLATION, "node {i}");
        assert!((gamma[i].iter().sum::<f64>() - TIME[i]).abs() < CANCELLATION, "time weight {i}");
    }
}

/// y' = −λ(y − cos τ) − sin τ and an anharmonic oscillator beside it.
const LAMBDA: f64 = 2.0;

fn right_hand_side(tau: f64, y: &[f64], out: &mut [f64]) {
    (out[0], out[1], out[2]) = (LAMBDA * (tau.cos() - y[0]) - tau.sin(), y[2], -4.0 * y[1] - y[1] * y[1] * y[1]);
}

/// The test's equations in a step from `tau` of length `h`, linearised at y₁ = `y`.
struct Equations {
    tau: f64,
    h: f64,
    y: f64,
}

impl System for Equations {
    fn evaluate<S: Wide>(&mut self, _: S, stage: usize, state: &[f64], out: &mut [f64]) {
        right_hand_side(self.tau + NODES[stage] * self.h, state, out);
    }

    fn solve(&self, b: &mut [f64]) {
        let (s, k) = (1.0 / (self.h * GAMMA), -4.0 - 3.0 * self.y * self.y);
        let determinant = s * s - k;
        (b[0], b[1], b[2]) =
            (b[0] / (s + LAMBDA), (s * b[1] + b[2]) / determinant, (k * b[1] + s * b[2]) / determinant);
    }
}

fn step(method: &mut StageBuffers, tau: f64, y: &[f64], h: f64) {
    right_hand_side(tau, y, &mut method.first);
    let by_time = [-LAMBDA * tau.sin() - tau.cos(), 0.0, 0.0, 0.0];
    try_step(Scalar256b, method, y, &by_time, h, &mut Equations { tau, h, y: y[1] });
}

fn integrate(count: usize) -> Vec<f64> {
    let mut method = StageBuffers::new(Partition { count: 0, rest: 4 }, Row::zeros(4));
    let mut y = vec![0.5, 0.0, 1.0, 0.0];
    let h = 1.0 / count as f64;
    for i in 0..count {
        step(&mut method, i as f64 * h, &y.clone(), h);
        y.copy_from_slice(&method.end);
    }
    y
}

#[test]
fn halving_the_step_divides_the_error_by_two_to_the_fifth() {
    let reference = integrate(512);
    let error = |count: usize| {
        let y = integrate(count);
        (0..3).map(|i| (y[i] - reference[i]).abs()).fold(0.0, f64::max)
    };
    let observed = (error(8) / error(16)).log2();
    // The next term of the error changes the observed order by less than 0.5 at these steps.
    assert!((observed - 5.0).abs() < 0.5, "observed order {observed}");
}

#[test]
fn dense_output_is_of_order_four() {
    let error = |h: f64| {
        let mut method = StageBuffers::new(Partition { count: 0, rest: 4 }, Row::zeros(4));
        let (y, mut found) = (vec![1.0, 0.0, 1.0, 0.0], vec![0.0; 4]);
        step(&mut method, 0.0, &y, h);
        (1..20)
            .map(|i| {
                let share = i as f64 / 20.0;
                dense(Scalar256b, &method, &y, share, &mut found);
                (found[0] - (share * h).cos()).abs()
            })
            .fold(0.0, f64::max)
    };
    let observed = (error(0.4) / error(0.2)).log2();
    // One step of order 4 is wrong by h⁵.
    assert!((observed - 5.0).abs() < 0.5, "observed order {observed}");
}
