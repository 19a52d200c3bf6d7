//! What is done to a measured trace before it is a defect: form is taken off, its ends are put at depth 0, heights
//! become depths. Of a topography each line along the arc is a trace.
//!
//! A tenth of a trace's length at either end is taken for smooth raceway. The line goes through the middles of both
//! ends. The circle is the one that fits all of their points best, by Kåsa's equation (IEEE Transactions on
//! Instrumentation and Measurement 25, 1976), here solved for the height z over the chord s, so that a straight line is
//! the circle without curvature:
//! ```text
//! z = a + b s + c (s² + z²)         least squares in a, b, c; the curvature of small slopes is 2c
//! ```
//! It holds where the ends are smooth; an arc is taken for its chord, which is 0.8 % shorter at a fifth of the radius.

use super::SurfaceError;
use crate::scene::{Measured, MeasuredForm, MeasuredLevel};
use nalgebra::{Matrix3, Vector3};

/// Share of a trace at either end that is smooth raceway.
const END: f64 = 0.1;
/// Points from which on there is a circle.
const FEWEST: usize = 3;

/// A circle of the form z = a + b s + c (s² + z²), all over a length (m).
#[derive(Debug, Clone, Copy)]
struct Circle {
    coefficients: [f64; 3],
    length: f64,
}

/// Does to the depths (m) of a trace over its ascending arcs (m) what is asked for.
pub(super) fn treat(arcs: &[f64], depths: &mut [f64], of: &Measured) -> Result<(), SurfaceError> {
    if let Some(MeasuredForm::Circle) = of.form {
        let points = ends(arcs).into_iter().flatten().count();
        let circle = circle(arcs, depths).ok_or(SurfaceError::NoCircle { points, fewest: FEWEST })?;
        depths.iter_mut().zip(arcs).for_each(|(depth, arc)| *depth -= circle.at(*arc));
    }
    if let Some(MeasuredLevel::Ends) = of.level {
        let line = line_through_ends(arcs, depths);
        depths.iter_mut().zip(arcs).for_each(|(depth, arc)| *depth -= line(*arc));
    }
    if of.invert {
        depths.iter_mut().for_each(|depth| *depth = 0.0 - *depth);
    }
    Ok(())
}

/// Curvature (1/m) of the circle through both ends of a trace; `None` where they have too few points.
pub fn curvature_of_ends(arcs: &[f64], depths: &[f64]) -> Option<f64> {
    circle(arcs, depths).map(|circle| 2.0 * circle.coefficients[2] / circle.length)
}

/// Depth (m) over the arc (m) of the straight line through both ends of a trace.
pub fn line_through_ends(arcs: &[f64], depths: &[f64]) -> impl Fn(f64) -> f64 + use<> {
    let middle = |of: &[f64], end: std::ops::Range<usize>| {
        let count = end.len() as f64;
        of[end].iter().sum::<f64>() / count
    };
    let [[s0, h0], [s1, h1]] = ends(arcs).map(|end| [middle(arcs, end.clone()), middle(depths, end)]);
    move |arc| h0 + (h1 - h0) * ((arc - s0) / (s1 - s0))
}

/// The points of both ends of a trace of two points at least.
fn ends(arcs: &[f64]) -> [std::ops::Range<usize>; 2] {
    let (count, first, last) = (arcs.len(), arcs[0], arcs[arcs.len() - 1]);
    let end = END * (last - first);
    let after = arcs.partition_point(|&arc| arc <= first + end);
    let before = arcs.partition_point(|&arc| arc < last - end);
    [0..after.min(count - 1), before.max(1)..count]
}

fn circle(arcs: &[f64], depths: &[f64]) -> Option<Circle> {
    let length = arcs[arcs.len() - 1] - arcs[0];
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    let mut points = 0;
    for k in ends(arcs).into_iter().flatten() {
        let (s, z) = (arcs[k] / length, depths[k] / length);
        let row = Vector3::new(1.0, s, s * s + z * z);
        matrix += row * row.transpose();
        right += row * z;
        points += 1;
    }
    let coefficients = matrix.cholesky().filter(|_| points >= FEWEST)?.solve(&right);
    Some(Circle { coefficients: coefficients.into(), length })
}

impl Circle {
    /// Height (m) at an arc (m): the root of c z² − z + q, q = a + b s + c s², that is q where c is 0.
    fn at(&self, arc: f64) -> f64 {
        let [a, b, c] = self.coefficients;
        let s = arc / self.length;
        let q = a + s * (b + c * s);
        self.length * 2.0 * q / (1.0 + (1.0 - 4.0 * c * q).max(0.0).sqrt())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    const LENGTH: f64 = 8e-3;

    /// A spall of 2 mm, 30 µm deep, whose trace has 401 points.
    fn spall() -> (Vec<f64>, Vec<f64>) {
        let arcs: Vec<f64> = (-200..=200).map(|k| LENGTH / 400.0 * f64::from(k)).collect();
        let depths = arcs.iter().map(|arc| if arc.abs() < 1e-3 { 30e-6 } else { 0.0 }).collect();
        (arcs, depths)
    }

    /// The largest difference (m) of a treated trace from the spall.
    fn left(spoilt: impl Fn(f64, f64) -> f64, of: Measured) -> f64 {
        let (arcs, depths) = spall();
        let mut found: Vec<f64> = arcs.iter().zip(&depths).map(|(arc, depth)| spoilt(*arc, *depth)).collect();
        treat(&arcs, &mut found, &of).unwrap();
        found.iter().zip(depths).map(|(found, depth)| (found - depth).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn what_an_instrument_leaves_on_a_trace_comes_off_it() {
        let (level, form) = (Some(MeasuredLevel::Ends), Some(MeasuredForm::Circle));
        // Rounding of heights of a millimetre.
        let nothing = 1e-15;
        assert_eq!(left(|_, depth| -depth, Measured { invert: true, ..Measured::default() }), 0.0);
        let tilted = |arc: f64, depth: f64| depth + 1e-3 + 0.02 * arc;
        assert!(left(tilted, Measured { level, ..Measured::default() }) < nothing);
        for radius in [23.49e-3f64, -15.6e-3, 1.0] {
            let round = |arc: f64| radius - radius.signum() * (radius * radius - (arc + 1e-3) * (arc + 1e-3)).sqrt();
            let heights = |arc: f64, depth: f64| round(arc) - depth + 5e-4 - 5e-4 * arc;
            let mended = left(heights, Measured { form, invert: true, ..Measured::default() });
            // A circle that is tilted by a shear, and not turned, is none: by some 20 nm at 0.5 mrad on 15.6 mm.
            assert!(mended < 3e-8, "{radius}: {mended:e}");
        }
    }

    #[test]
    fn a_trace_without_form_has_no_curvature_and_one_with_too_few_points_no_circle() {
        let (arcs, depths) = spall();
        assert!(curvature_of_ends(&arcs, &depths).unwrap().abs() < 1e-9);
        let form = Some(MeasuredForm::Circle);
        let refused = treat(&[0.0, 1e-3], &mut [0.0, 0.0], &Measured { form, ..Measured::default() });
        assert_eq!(refused, Err(SurfaceError::NoCircle { points: 2, fewest: 3 }));
    }
}
