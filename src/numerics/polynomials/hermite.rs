//! Cubics through values and slopes at both ends of an interval (Hermite).

/// Coefficients, constant first, of the cubic with value and slope at 0 and at 1: `[f0, m0, f1, m1]`.
#[inline]
pub fn cubic([f0, m0, f1, m1]: [f64; 4]) -> [f64; 4] {
    [f0, m0, 3.0 * (f1 - f0) - 2.0 * m0 - m1, 2.0 * (f0 - f1) + m0 + m1]
}
