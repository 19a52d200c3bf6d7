//! How two round bodies part from where they touch.

/// Relative curvature (1/m) of two bodies of these radii (m) that touch: 1/r + 1/R. The radius of a hollow, as an outer
/// raceway or a groove, is negative.
pub fn relative_curvature(radius: f64, other: f64) -> f64 {
    1.0 / radius + 1.0 / other
}

/// Distance (m) from the point of touch at which bodies of this relative curvature κ (1/m) are `gap` (m) apart:
/// √(2h/κ), of their paraboloids.
pub fn reach(gap: f64, curvature: f64) -> f64 {
    (2.0 * gap / curvature).sqrt()
}
