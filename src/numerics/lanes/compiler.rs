//! What kernels need of the compiler and it does not find by itself, each with what it is good for. Beside these there
//! are [`Wide::outlined`](super::Wide::outlined), which makes a function of a kernel, and loops by index instead of
//! chains of iterators over arrays, for which it calls functions.

/// A copy of small numbers to hand on to a function of its own by reference, so that the original can stay in
/// registers: what is written to memory in parts and read together soon after is read late.
#[inline(always)]
pub fn handed_on<T: Copy>(value: &T) -> T {
    *value
}

/// Keeps a choice between two numbers a branch. As a selection the number would wait for both, and all that is computed
/// from it as well.
#[inline(always)]
pub fn stay_a_branch() {
    std::hint::black_box(());
}
