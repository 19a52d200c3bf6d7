//! One step of an explicit pair for what oscillates: partitioned Runge–Kutta, order 4(3), phase and amplitude of order
//! 6.
//!
//! Positions x and velocities v take their own coefficients, and a stage's positions already use that stage's
//! velocities:
//! ```text
//! V_i = v + h Σ_{j<i} a_ij F_j,   X_i = x + h Σ_{j≤i} â_ij G_j,   G = x'(t, V),   F = v'(t, X, V)
//! v₁ = v + h Σ b_j F_j,           x₁ = x + h Σ b_j G_j
//! ```
//! with F at the end of a step the first of the next: five evaluations a step.
//!
//! On x'' = −ω²x the step is a matrix of determinant 1 + O((ωh)⁸) whose trace is 2 cos ωh + O((ωh)⁸), and it is stable
//! up to ωh = 4 with a little damping. A pair of order 5 for any equation, as Dormand–Prince's, reaches 2 with six
//! evaluations and has the phase error at ωh = 0.33 that this one has at 0.8. An element between its raceways is such
//! an oscillator, weakly damped, and either its stability or its phase is what limits a bearing's explicit steps.
//!
//! The coefficients were found for this program, by numerical optimisation: the free ones of all that meet the order
//! conditions were moved until phase, amplitude and reach were as above, with the residuals of order 5 as small as that
//! leaves them. The tests check all of it.

use super::explicit::{LAST, RightHandSide, Weights, combine};
use super::stage_buffers::StageBuffers;
use crate::numerics::lanes::Wide;

/// Order of a step, and of the one that its error is estimated by.
pub const ORDERS: [usize; 2] = [4, 3];

/// Nodes c, the row sums of a and of â, and 1.
pub const NODES: [f64; LAST] =
    [0.0, 0.28270737957946374, 0.39338794696228396, 0.5820632704722885, 0.8429264990121761, 1.0];

/// a
pub static VELOCITIES: [[f64; 5]; 5] = [
    [0.0, 0.0, 0.0, 0.0, 0.0],
    [0.28270737957946374, 0.0, 0.0, 0.0, 0.0],
    [-0.015267734519361675, 0.40865568148164566, 0.0, 0.0, 0.0],
    [-0.09159184889770952, 0.5596869889786574, 0.11396813039134053, 0.0, 0.0],
    [0.18874159397391257, 0.1215442498098198, -0.024711443689928694, 0.5573520989183723, 0.0],
];

/// â
pub static POSITIONS: [[f64; 5]; 5] = [
    [0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0898603529819182, 0.19284702659754557, 0.0, 0.0, 0.0],
    [0.34130779674986156, -0.38842147052540044, 0.4405016207378229, 0.0, 0.0],
    [0.21189219055477973, 0.11537641441206967, 0.12608100178506887, 0.12871366372037002, 0.0],
    [-0.011904176047863486, 0.6199011514838408, -0.1434669826246903, 0.3076279643389404, 0.07076854186194868],
];

/// b
pub const WEIGHTS: [f64; LAST] =
    [0.10027381249783876, 0.22505168655891208, 0.28926730490770214, 0.008770811582423075, 0.376636384453124, 0.0];

/// Weights of the error estimate. Up to a factor there is one set, the end of the step included, that vanishes up to
/// order 3; the factor makes a tolerance mean what it means to Dormand–Prince's.
pub const ERROR: [f64; 7] = [
    -0.006627135320588654,
    0.00630963057780291,
    0.016864472239058736,
    -0.014200008142264953,
    -0.013969277330280742,
    0.0,
    0.011622317976272696,
];

#[inline(always)]
fn weights<'a>(h: f64, stage: usize) -> Weights<'a, 5> {
    Weights { h, positions: &POSITIONS[stage], velocities: &VELOCITIES[stage] }
}

/// Tries a step of length `h` from `state`; the first stage must be there.
#[inline(always)]
pub fn try_step<S: Wide>(
    simd: S,
    buffers: &mut StageBuffers,
    state: &[f64],
    h: f64,
    right_hand_side: &mut impl RightHandSide,
) {
    let StageBuffers { first, last, stages: [a, b, c, d, ..], end, trial, positions, partition, .. } = buffers;
    let (partition, len) = (*partition, partition.len());
    // Equal lengths, seen once, spare the checks of every sum.
    let (kinds, state, first) = (&positions[..len], &state[..len], &first[..len]);
    let (a, b, c, d) = (&mut a[..len], &mut b[..len], &mut c[..len], &mut d[..len]);
    let (trial, end) = (&mut trial[..len], &mut end[..len]);
    combine(simd, partition, [kinds, state, first], weights(h, 1), trial);
    right_hand_side.evaluate(simd, 1, trial, Some(h * POSITIONS[1][1]), a);
    combine(simd, partition, [kinds, state, first, a], weights(h, 2), trial);
    right_hand_side.evaluate(simd, 2, trial, Some(h * POSITIONS[2][2]), b);
    combine(simd, partition, [kinds, state, first, a, b], weights(h, 3), trial);
    right_hand_side.evaluate(simd, 3, trial, Some(h * POSITIONS[3][3]), c);
    combine(simd, partition, [kinds, state, first, a, b, c], weights(h, 4), trial);
    right_hand_side.evaluate(simd, 4, trial, Some(h * POSITIONS[4][4]), d);
    combine(simd, partition, [kinds, state, first, a, b, c, d], Weights::alike(h, &WEIGHTS), end);
    right_hand_side.evaluate(simd, LAST, end, None, last);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::lanes::row::Row;
    use crate::numerics::lanes::{Kernel, Partition, dispatch};
    use pulp::Scalar256b;

    /// A tree of the order conditions of x' = G(t, v), linear in v, and v' = F(t, x, v).
    #[derive(Debug, Clone)]
    enum Tree {
        Leaf,
        /// An F with these branches.
        Velocity(Vec<Tree>),
        /// A G with so many leaves and perhaps one more branch.
        Position(usize, Option<Box<Tree>>),
    }

    impl Tree {
        fn order(&self) -> usize {
            match self {
                Self::Leaf => 1,
                Self::Velocity(branches) => 1 + branches.iter().map(Self::order).sum::<usize>(),
                Self::Position(leaves, branch) => 1 + leaves + branch.as_ref().map_or(0, |branch| branch.order()),
            }
        }

        fn density(&self) -> f64 {
            let branches = match self {
                Self::Leaf => 1.0,
                Self::Velocity(branches) => branches.iter().map(Self::density).product(),
                Self::Position(_, branch) => branch.as_ref().map_or(1.0, |branch| branch.density()),
            };
            branches * self.order() as f64
        }

        /// Φ of each stage, the end of the step among them.
        fn weights(&self) -> [f64; 6] {
            let below = |branch: &Self| match branch {
                Self::Leaf => NODES,
                Self::Velocity(_) => times(&velocities(), branch.weights()),
                Self::Position(..) => times(&positions(), branch.weights()),
            };
            let product = |a: [f64; 6], b: [f64; 6]| std::array::from_fn(|i| a[i] * b[i]);
            match self {
                Self::Leaf => [1.0; 6],
                Self::Velocity(branches) => branches.iter().map(below).fold([1.0; 6], product),
                Self::Position(leaves, branch) => {
                    let leaves = NODES.map(|c| c.powi(*leaves as i32));
                    branch.as_ref().map_or(leaves, |branch| product(leaves, below(branch)))
                }
            }
        }
    }

    /// Trees of this order whose root is an F.
    fn trees(order: usize) -> Vec<Tree> {
        rows(order - 1, order - 1).into_iter().map(Tree::Velocity).collect()
    }

    /// Rows of branches with `left` vertices in all, none with more than `most`, the larger ones first.
    fn rows(left: usize, most: usize) -> Vec<Vec<Tree>> {
        if left == 0 {
            return vec![Vec::new()];
        }
        let mut found = Vec::new();
        for size in 1..=most.min(left) {
            // In one order only: up to order 4 no two branches have more than one vertex.
            for branch in branches(size) {
                for smaller in rows(left - size, size) {
                    found.push([vec![branch.clone()], smaller].concat());
                }
            }
        }
        found
    }

    /// Branches of this order. Of a G no branch but one can be an F, and a leaf may be t or v.
    fn branches(order: usize) -> Vec<Tree> {
        if order == 1 {
            return vec![Tree::Leaf];
        }
        let mut found = trees(order);
        found.push(Tree::Position(order - 1, None));
        for leaves in 0..order - 2 {
            found.extend(trees(order - 1 - leaves).into_iter().map(|f| Tree::Position(leaves, Some(Box::new(f)))));
        }
        found
    }

    /// Rows of a and b, and of â and b.
    fn velocities() -> [[f64; 6]; 6] {
        std::array::from_fn(|i| {
            std::array::from_fn(|j| match (i, j) {
                (5, _) => WEIGHTS[j],
                (_, 0..4) => VELOCITIES[i][j],
                _ => 0.0,
            })
        })
    }

    fn positions() -> [[f64; 6]; 6] {
        std::array::from_fn(|i| {
            std::array::from_fn(|j| match (i, j) {
                (5, _) => WEIGHTS[j],
                (_, 0..5) => POSITIONS[i][j],
                _ => 0.0,
            })
        })
    }

    fn times(matrix: &[[f64; 6]; 6], vector: [f64; 6]) -> [f64; 6] {
        matrix.map(|row| dot(row, vector))
    }

    fn dot(a: [f64; 6], b: [f64; 6]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    #[test]
    fn there_are_thirteen_trees_of_up_to_four_vertices() {
        assert_eq!([1, 2, 3, 4].map(|order| trees(order).len()), [1, 1, 3, 8]);
    }

    #[test]
    fn all_conditions_of_order_four_hold_and_the_estimate_vanishes_up_to_order_three_only() {
        // Those of x follow: with the same weights b, a tree with a G at its root has the condition of one with an F.
        let estimate = [0, 1, 2, 3, 4, 6].map(|i| ERROR[i]);
        let mut largest = 0.0f64;
        for tree in (1..=ORDERS[0]).flat_map(trees) {
            let miss = dot(WEIGHTS, tree.weights()) - 1.0 / tree.density();
            assert!(miss.abs() < 4e-16, "{tree:?}: {miss}");
            let estimate = dot(estimate, tree.weights()).abs();
            assert!(tree.order() > ORDERS[1] || estimate < 1e-16, "{tree:?}: {estimate}");
            largest = largest.max(estimate);
        }
        assert!(largest > 1e-5);
    }

    #[test]
    fn nodes_are_the_row_sums() {
        for (i, (velocities, positions)) in velocities().iter().zip(positions()).enumerate() {
            for row in [*velocities, positions] {
                assert!((row.iter().sum::<f64>() - NODES[i]).abs() < 4e-16, "row {i}");
            }
        }
    }

    /// Two oscillators x'' = f(t, x, x'), the states x, x' of one after the other's.
    struct Oscillators<F>(F, f64, f64);

    impl<F: Fn(f64, f64, f64) -> f64> RightHandSide for Oscillators<F> {
        fn evaluate<S: Wide>(&mut self, _: S, stage: usize, state: &[f64], ahead: Option<f64>, out: &mut [f64]) {
            let (tau, h) = (self.1, self.2);
            for i in [0, 2] {
                let (v, node) = (state[i + 1], NODES[stage.min(LAST - 1)]);
                let x = state[i] + ahead.unwrap_or(0.0) * v;
                (out[i], out[i + 1]) = (v, (self.0)(tau + node * h, x, v));
            }
        }
    }

    /// Both oscillators after `count` steps of length `h`.
    fn integrate(start: [f64; 4], count: usize, h: f64, force: impl Fn(f64, f64, f64) -> f64 + Copy) -> [f64; 4] {
        let kinds = Row::from_fn(4, |i| if i % 2 == 0 { 1.0 } else { 0.0 });
        let mut buffers = StageBuffers::new(Partition { count: 0, rest: 4 }, kinds);
        let mut state = start;
        for step in 0..count {
            let mut equations = Oscillators(force, step as f64 * h, h);
            let mut first = [0.0; 4];
            equations.evaluate(Scalar256b, 0, &state, None, &mut first);
            buffers.first.copy_from_slice(&first);
            try_step(Scalar256b, &mut buffers, &state, h, &mut equations);
            state.copy_from_slice(&buffers.end);
        }
        state
    }

    #[test]
    fn halving_the_step_divides_the_error_by_two_to_the_fourth() {
        // Nonlinear in both position and velocity, and forced.
        let force = |t: f64, x: f64, v: f64| -x - 0.5 * x * x * x - 0.3 * v * x + (1.3 * t).cos();
        let end = |count: usize| integrate([1.0, 0.0, -0.5, 0.7], count, 2.0 / count as f64, force);
        let exact = end(4096);
        let error = |count: usize| end(count).iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let observed = (error(32) / error(64)).log2();
        assert!((observed - 4.0).abs() < 0.3, "observed order {observed}");
    }

    #[test]
    fn phase_and_amplitude_of_an_oscillator_are_of_order_six() {
        // One step from both unit states is the step's matrix. Determinant and trace miss 1 and 2 cos h by O(h⁸).
        let miss = |h: f64| {
            let [a, c, b, d] = integrate([1.0, 0.0, 0.0, 1.0], 1, h, |_, x, _| -x);
            [a * d - b * c - 1.0, a + d - 2.0 * h.cos()]
        };
        for (large, small) in miss(0.8).into_iter().zip(miss(0.4)) {
            let observed = (large / small).abs().log2();
            assert!((observed - 8.0).abs() < 0.5, "observed order {observed}: {large} {small}");
            assert!(large.abs() < 2e-6, "{large}");
        }
    }

    /// Nine oscillators in two lists, x' of one after all x, and four more states in the rest.
    struct Lists(f64);

    impl RightHandSide for Lists {
        fn evaluate<S: Wide>(&mut self, _: S, _: usize, state: &[f64], ahead: Option<f64>, out: &mut [f64]) {
            let indices = (0..9).map(|j| (j, 16 + j)).chain([(32, 33), (34, 35)]);
            for (x, v) in indices {
                let moved = state[x] + ahead.unwrap_or(0.0) * state[v];
                (out[x], out[v]) = (state[v], -self.0 * moved * (1.0 + x as f64));
            }
        }
    }

    struct OneStep<'a>(&'a mut StageBuffers, &'a [f64]);

    impl Kernel for OneStep<'_> {
        type Output = Vec<f64>;

        #[inline(always)]
        fn run<S: Wide>(self, simd: S) -> Vec<f64> {
            try_step(simd, self.0, self.1, 0.1, &mut Lists(3.0));
            self.0.end.to_vec()
        }
    }

    #[test]
    fn lists_of_any_width_give_equal_bits_and_what_single_oscillators_give() {
        let is_position = |i: usize| i < 9 || i == 32 || i == 34;
        let kinds = Row::from_fn(36, |i| f64::from(u8::from(is_position(i))));
        let mut buffers = StageBuffers::new(Partition { count: 9, rest: 4 }, kinds);
        let state: Vec<f64> = (0..36)
            .map(|i| if (9..16).contains(&i) || (25..32).contains(&i) { 0.0 } else { (i as f64).sin() })
            .collect();
        let mut first = vec![0.0; 36];
        Lists(3.0).evaluate(Scalar256b, 0, &state, None, &mut first);
        buffers.first.copy_from_slice(&first);
        let wide = dispatch(OneStep(&mut buffers, &state));
        let narrow = OneStep(&mut buffers, &state).run(Scalar256b);
        assert_eq!(wide, narrow);
        for j in 0..9 {
            let alone = integrate([state[j], state[16 + j], 0.0, 0.0], 1, 0.1, |_, x, _| -3.0 * x * (1.0 + j as f64));
            // Alone, weights of positions and velocities are put together with a rounding more.
            assert!((wide[j] - alone[0]).abs() < 1e-15 && (wide[16 + j] - alone[1]).abs() < 1e-14, "{j}");
        }
    }
}
