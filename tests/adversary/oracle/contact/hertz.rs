//! Stiffness of an elliptical contact of two paraboloids, by the arithmetic-geometric mean (Johnson 1985, eqs.
//! 4.25–4.28).

use std::f64::consts::PI;

/// Complete elliptic integrals K and K − E of squared modulus 1 − `b`², b being the ratio of the half axes.
fn integrals(b: f64) -> (f64, f64) {
    let (mut a, mut g) = (1.0, b);
    // K − E = K Σ 2^(n−1) c_n², with c_0² = 1 − b²: no difference of near numbers.
    let (mut sum, mut weight) = (0.5 * (1.0 - b) * (1.0 + b), 0.5);
    for _ in 0..40 {
        let c = 0.5 * (a - g);
        weight *= 2.0;
        sum += weight * c * c;
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
        if c.abs() < 1e-17 * a {
            break;
        }
    }
    let k = PI / (2.0 * a);
    (k, k * sum)
}

/// K of Q = K δ^1.5 for two relative principal curvatures (1/m) and the effective modulus (Pa).
pub(crate) fn stiffness(curvatures: [f64; 2], modulus: f64) -> f64 {
    let (half_axis, per_square) = ellipse(curvatures);
    let small = curvatures[0].min(curvatures[1]) / 2.0;
    half_axis * half_axis * half_axis * 2.0 * PI * modulus * small / (3.0 * per_square)
}

/// Longer half axis of the contact over the root of its approach (√m), along the smaller curvature.
pub(crate) fn half_length(curvatures: [f64; 2]) -> f64 {
    ellipse(curvatures).0
}

/// That half axis, and (K − E)/e² of the ellipse.
fn ellipse(curvatures: [f64; 2]) -> (f64, f64) {
    let (small, large) = (curvatures[0].min(curvatures[1]) / 2.0, curvatures[0].max(curvatures[1]) / 2.0);
    // (B/A)(K − E) = (a/b)² E − K = (a/b)² (e² K − (K − E)), which is steep in b: halve its logarithm.
    let excess = |b: f64| {
        let (k, difference) = integrals(b);
        let square = (1.0 - b) * (1.0 + b);
        (square * k - difference) / (b * b) - large / small * difference
    };
    let (mut low, mut high) = ((small / large).powi(2).ln() - 1.0, 0.0f64);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if excess(middle.exp()) > 0.0 { low = middle } else { high = middle }
    }
    let b = (0.5 * (low + high)).exp();
    let (k, difference) = integrals(b);
    let square = (1.0 - b) * (1.0 + b);
    // (K − E)/e² → π/4 for a circle.
    let per_square = if square < 1e-7 { 0.25 * PI * (1.0 + 0.375 * square) } else { difference / square };
    ((per_square / (k * small)).sqrt(), per_square)
}

#[test]
fn a_sphere_has_its_closed_form_and_a_known_ellipse_its_printed_one() {
    let found = stiffness([250.0, 250.0], 1e11);
    assert!((found / (4.0 / 3.0 * 1e11 * 0.004f64.sqrt()) - 1.0).abs() < 1e-9, "{found}");
    // SKF 6205's inner contact: 2.545e10, printed to four digits.
    let (r, r_i, groove) = (3.97e-3, 15.5475e-3, 0.52 * 7.94e-3);
    let found = stiffness([1.0 / r + 1.0 / r_i, 1.0 / r - 1.0 / groove], 207e9 / (2.0 * 0.91));
    assert!((found / 2.545e10 - 1.0).abs() < 3e-4, "{found}");
}
