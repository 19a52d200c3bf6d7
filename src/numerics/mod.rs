//! Deterministic elementary functions and small numerical tools that know nothing of bearings.
//!
//! Bits must be equal on every machine. The standard library's sine, cosine and power functions are the
//! platform's own; those used here are compiled with the project.

pub mod elliptic;
#[cfg(test)]
pub(crate) mod trees;

/// Sine and cosine of `angle` [rad], with the same bits on every machine.
#[inline]
pub fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// `angle` [rad] brought into [−π, π] by whole turns.
#[inline]
pub fn wrap(angle: f64) -> f64 {
    let turn = 2.0 * std::f64::consts::PI;
    angle - turn * (angle / turn).round()
}
