//! How far searches for a balance go, and how exactly.

/// Share of the largest force in play that may remain as residual: a few roundings of a sum of Z forces.
pub(super) const RESIDUAL: f64 = 1e-12;
/// Residual that counts as none (N), for bearings without load: rounding of positions times contact stiffness.
pub(super) const SMALLEST_RESIDUAL: f64 = 1e-12;
/// Share of the largest force beyond which an element is not in balance: its own search ends a thousand times below.
pub(super) const UNBALANCED: f64 = 1e-6;
/// Longest step of a ring between two iterations at first (m); a soft support may have a long way to go.
const LONGEST_STEP: f64 = 50e-6;
/// Iterations after which the longest step doubles, rings may go together as far as their supports let them, and the
/// tangent is that of the damped contacts.
pub(super) const DOUBLING: i32 = 50;
/// Most iterations.
pub(super) const ITERATIONS: i32 = 500;
/// Longest step of a ring in an iteration (m): after all of them it may have moved by metres.
pub(super) fn longest_step(iteration: i32) -> f64 {
    LONGEST_STEP * f64::from(1 << (iteration / DOUBLING).min(16))
}
