//! How far searches for a balance go, and how exactly; and how far they go along a step.

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

/// What a search along a step finds at a share of it.
pub(super) struct Tried<T> {
    pub(super) there: T,
    /// The force's product with the step.
    pub(super) push: f64,
    /// Whether nothing is left to balance.
    pub(super) is_balanced: bool,
}

/// Goes along a step, at whose beginning the force pushes forward by `push_0`, as far as it does so; at most so many
/// times looked.
pub(super) fn as_far_as_it_pushes<T>(push_0: f64, most: u32, mut at: impl FnMut(f64) -> Tried<T>) -> Option<T> {
    let (mut low, mut high, mut share) = (0.0, f64::INFINITY, 1.0);
    for _ in 0..most {
        let Tried { there, push, is_balanced } = at(share);
        if is_balanced || push.abs() <= 0.5 * push_0 || (push > 0.0 && high.is_infinite()) {
            return Some(there);
        }
        if push > 0.0 {
            low = share
        } else {
            high = share
        }
        share = 0.5 * (low + high);
    }
    None
}
