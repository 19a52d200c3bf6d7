//! How much softer a raceway is beside a sharp edge than the half-space that Love's solution speaks of.
//!
//! On a body that *ends* at the edge a load p(x′, y′) at the distance x′ from it lowers the surface at x by its own
//! part and by that of its image on the other side, times a factor ψ of Poisson's ratio (Guilbault's idea, J. Tribol.
//! 133 (2011) 031402). Against the exact quarter-space of Hetényi (two half-spaces whose normal stresses on each
//! other's side are taken off), ψ is 1.29 to 1.35 for ν = 0, 1.74 to 1.81 for 0.3 and 2.30 to 2.40 for 0.45, whatever
//! the distance.
//!
//! A spall's edge is a *step* of depth h: the body goes on below, and far from a shallow step nothing is softer. With s
//! = x + x′ and the distance y across, the image is here
//! ```text
//! I = e^(−s/λ) (1/√(s² + y²) − 1/√(s² + y² + H²)),   H = 1.6 h,   λ = 4 h
//! ```
//! As h grows this becomes the end's image, and it vanishes with h. The two numbers were fitted to plane-strain finite
//! elements of a cylinder over the edge of a step, up to a half-width inside it: forces agree to 3 %
//! (`tests/contact/edge.rs`), which is the accuracy that is claimed. ½ψ I is added to the influence: half of a
//! contact's compliance is the spalled body's, of another material than the other body its own share.
//!
//! The influence matrix stays symmetric and positive definite, so that the contact still has an energy: I is symmetric,
//! and its Laplace transform by s, 2(1 − cos(H√(t² − k²)))/√(t² − k²) for the wave number k along the edge and t > |k|,
//! is nowhere negative; the factor e^(−s/λ) only moves it.

use libm::{asinh, atan, exp};

/// H per depth of the step.
const BURIED: f64 = 1.6;
/// λ per depth of the step.
const DECAY: f64 = 4.0;
/// Distance from the edge per depth of the step beyond which less than 5e-4 of the force is missing.
const FELT: f64 = 5.0;

/// Softness of the edges of one material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeSoftness {
    /// ½ψ; with two materials the spalled body's share in place of the half.
    pub factor: f64,
    /// Depth of a step that counts as an end, in half-axes of the largest contact along the raceway: deeper ones count
    /// as this deep.
    pub deepest: f64,
}

impl EdgeSoftness {
    /// That of steps in a body of this Poisson's ratio. Deeper ones than four half-axes would be felt far along the
    /// raceway: as deep as that, a step leaves a ball on its edge 9 to 14 % more force than an end, and 16 to 23 % more
    /// two half-axes inside.
    pub fn of_steps(poissons_ratio: f64) -> Self {
        Self::of_steps_in(poissons_ratio, 0.5)
    }

    /// The same of a body that yields this share of both.
    pub fn of_steps_in(poissons_ratio: f64, share: f64) -> Self {
        Self { factor: share * image_factor(poissons_ratio), deepest: 4.0 }
    }

    /// Distance (m) from a step of this depth (m) within which it is felt by contacts of up to this half-axis (m) along
    /// the raceway.
    pub fn reach(&self, depth: f64, half_axis: f64) -> f64 {
        StepImage::reach(depth.min(self.deepest * half_axis))
    }
}

/// ψ for a Poisson's ratio: a parabola through 1.32, 1.78 and 2.35 at 0, 0.3 and 0.45.
pub fn image_factor(poissons_ratio: f64) -> f64 {
    1.32 + poissons_ratio * (0.355_556 + poissons_ratio * 3.925_926)
}

/// The image of a step's edge on cells of a grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct StepImage {
    /// Depth of the step (m).
    pub(in crate::contact) depth: f64,
    /// ½ψ.
    pub(super) factor: f64,
    /// Full sides of a cell (m).
    pub(in crate::contact) cell: [f64; 2],
}

impl StepImage {
    /// Distance from the edge within which it is felt (m).
    pub(in crate::contact) fn reach(depth: f64) -> f64 {
        FELT * depth
    }

    /// Integral of ½ψ I over a cell at s and y (m).
    pub(super) fn influence(&self, s: f64, y: f64) -> f64 {
        let [a, b] = self.cell.map(|side| 0.5 * side);
        let buried = BURIED * self.depth;
        let corners = |of: &dyn Fn(f64, f64) -> f64| {
            (of(s + a, y + b) - of(s - a, y + b)) - (of(s + a, y - b) - of(s - a, y - b))
        };
        let end = corners(&|x, y| corner(x, y, 0.0));
        let below = corners(&|x, y| corner(x, y, buried));
        self.factor * exp(-s / (DECAY * self.depth)) * (end - below)
    }
}

/// Antiderivative of 1/√(x² + y² + z²) by x and y, for x > 0 or z > 0.
fn corner(x: f64, y: f64, z: f64) -> f64 {
    let (across, along) = ((x * x + z * z).sqrt(), (y * y + z * z).sqrt());
    let part = |p: f64, q: f64, length: f64| if length == 0.0 { 0.0 } else { p * asinh(q / length) };
    let buried = if z == 0.0 { 0.0 } else { z * atan(x * y / (z * (x * x + y * y + z * z).sqrt())) };
    part(x, y, across) + part(y, x, along) - buried
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::love::half_space::rectangle_kernel;

    #[test]
    fn a_deep_step_is_an_end_and_a_shallow_one_is_none() {
        let cell = [6e-6, 40e-6];
        for (s, y) in [(6e-6, 0.0), (60e-6, 40e-6), (300e-6, 400e-6)] {
            let end = 0.9 * rectangle_kernel(s, y, 3e-6, 20e-6);
            let of = |depth: f64| StepImage { depth, factor: 0.9, cell }.influence(s, y);
            // What is buried at 1600 m is (s/H) of the rest; the corners cancel to 1e-10 of it.
            assert!((of(1e3) / end - 1.0).abs() < 1e-5, "{s} {y}: {} {end}", of(1e3));
            assert!(of(1e-7).abs() < 1e-2 * end && of(1e-4) < end && of(1e-4) > 0.0);
        }
    }

    #[test]
    fn an_end_softens_a_square_patch_as_hetenyis_two_half_spaces_do() {
        // Deflection of the middle of a square of side 2 c whose centre is d/c from the edge, over the half-space's.
        const EXACT: [(f64, f64, f64); 7] = [
            (1.0, 1.512, 1.381),
            (1.25, 1.413, 1.307),
            (1.5, 1.344, 1.256),
            (2.0, 1.258, 1.192),
            (3.0, 1.172, 1.128),
            (5.0, 1.103, 1.077),
            (10.0, 1.051, 1.038),
        ];
        for (distance, steel, cork) in EXACT {
            let image = rectangle_kernel(2.0 * distance, 0.0, 1.0, 1.0) / rectangle_kernel(0.0, 0.0, 1.0, 1.0);
            for (poissons_ratio, exact) in [(0.3, steel), (0.0, cork)] {
                let found = 1.0 + image_factor(poissons_ratio) * image;
                // 3 % is what is claimed; the worst is 1 %.
                assert!((found / exact - 1.0).abs() < 0.01, "{distance} {poissons_ratio}: {found} {exact}");
            }
        }
    }

    #[test]
    fn a_line_of_cells_along_the_edge_has_the_image_of_plane_strain() {
        // ∫I dy = e^(−s/λ) ln(1 + H²/s²), over cells so narrow along s that they are points.
        let image = StepImage { depth: 1e-4, factor: 1.0, cell: [1e-8, 20e-6] };
        for s in [2e-5, 1e-4, 4e-4] {
            let sum: f64 = (-5000..=5000).map(|j| image.influence(s, f64::from(j) * 20e-6)).sum::<f64>() / 1e-8;
            let expected = f64::exp(-s / 4e-4) * f64::ln(1.0 + (1.6e-4 / s).powi(2));
            // The line is 0.2 m long: H²/length² of it is missing.
            assert!((sum / expected - 1.0).abs() < 1e-5, "{s}: {sum} {expected}");
        }
    }
}
