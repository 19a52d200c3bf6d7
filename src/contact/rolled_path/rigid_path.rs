//! Path of a rigid element's centre that rolls over a profile: the earlier model's description of a defect.
//!
//! The centre of a circle of radius r that touches the raceway point (φ, R) from inside, seen from the ring's centre at
//! angle ψ, is at ρ = R cos(φ−ψ) − √(r² − R² sin²(φ−ψ)). The path is the lowest over all points of the profile,
//! ```text
//! P(ψ) = min_φ [R(φ) cos(φ−ψ) − √(r² − R(φ)² sin²(φ−ψ))] − (R_o − r),   R(φ) = R_o + h(φ)
//! ```
//! the upper envelope of the rolling circle; for one sharp edge and a flat floor it is the closed form of
//! Moazen-Ahmadi, Petersen and Howard (2015). Defects of the inner ring and of elements have the forms that
//! [`Rolling`] gives; ψ is then the direction in which the two bodies touch, in the frame of the one that has the
//! defect. Between two changes of the touched feature (a vertex of the profile, a
//! straight piece of it, the smooth raceway) the path is smooth; there it is tabulated with cubic Hermite pieces whose
//! end values and slopes are exact. The changes are the path's *knots*: at a pair of vertices the path has a cusp.
//!
//! The contact is Hertz's with approach u − P, directed along the path's normal, tan κ = P′/ρ. The element is rigid and
//! the contact a point, so this is invalid within one contact half-width of a spall's edge, where it overstates the
//! force by about 15 %, and it ignores the profile across the raceway. Where an element lies so deep beside a wall that
//! only its side meets the edge, the path leaps and there is no force to climb it with: such a profile is refused.

use super::rigid_roller::{Feature, Roller, Stretch, Stretches};
use crate::contact::error::ContactError;
use crate::contact::rolling::{Rolling, Touch};
use crate::numerics::polynomials::hermite;

/// Path of a rigid element over a profile, as pieces between knots.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidPath {
    /// Ascending angles (rad) from the defect's centre; piece `i` lies between knots `i` and `i + 1`.
    knots: Vec<f64>,
    pieces: Vec<Piece>,
}

/// The path and its slope at one angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PathPoint {
    /// P (m), positive outwards.
    pub path: f64,
    /// dP/dψ (m/rad).
    pub slope: f64,
}

/// A smooth stretch: cubic polynomials on intervals of equal width.
#[derive(Debug, Clone, PartialEq)]
struct Piece {
    start: f64,
    per_width: f64,
    cubics: Vec<[f64; 4]>,
}

/// Widest interval of a cubic along the raceway (m), of which elements of more than 8 mm have a wider one. Its error is
/// width⁴ P⁗/384, about 1e-16 m for an element of 8 mm; narrower ones are made where that is above [`ACCURACY`].
const INTERVAL: f64 = 5e-6;
/// The same over the element's radius. The path's roundings, some of the raceway's radius, come into the slope divided
/// by the width.
const INTERVAL_OF_RADIUS: f64 = 1.25e-3;
/// Largest error of the cubics over the element's radius. P⁗ grows as 1/r³, and without end where the element touches
/// sideways. The error of their slope is √3/216 width³ P⁗, at most 3.1 of the path's error over the width: along the
/// raceway 3e-10/cos^1.75 κ, and as much as the damper at the element's speed makes of that is wrong with the force.
const ACCURACY: f64 = 2e-13;
/// Most intervals of a stretch, which only an element that touches at more than 85° asks for. There the path is less
/// exact, at 89.8° to 1e-10 of the element's radius; beyond [`STEEPEST`](super::rigid_roller::STEEPEST) there is none.
const MOST: usize = 1 << 16;

impl RigidPath {
    /// Rolls two bodies over each other of which one has the profile `points`, (arc, depth) (m) with non-decreasing
    /// arc; its depth is 0 elsewhere.
    ///
    /// Depths must be below the element's radius; the surface layer sees to that.
    ///
    /// # Errors
    /// [`ContactError::EndsMeet`] where rims at both ends lift the element at once, [`ContactError::NoWayOut`] where it
    /// lies so deep that only its side meets an edge.
    pub fn new(points: &[(f64, f64)], rolling: Rolling) -> Result<Self, ContactError> {
        let roller = Roller::new(points, rolling);
        roller.check_ends()?;
        let Stretches { begin, list: stretches } = roller.stretches();
        for pair in stretches.windows(2) {
            roller.check_climb(pair[0].end, [pair[0].feature, pair[1].feature])?;
        }
        let mut knots = vec![begin];
        let mut pieces = Vec::with_capacity(stretches.len());
        for Stretch { end, feature } in stretches {
            pieces.push(Piece::new(&roller, feature, knots[knots.len() - 1], end));
            knots.push(end);
        }
        Ok(Self { knots, pieces })
    }

    /// The path by angles of which the share `cos` turns the bodies over each other. A share of 1 changes no bit.
    pub fn turned_slower(mut self, cos: f64) -> Self {
        let starts = self.pieces.iter_mut().map(|piece| (&mut piece.start, &mut piece.per_width));
        starts.for_each(|(start, per_width)| (*start, *per_width) = (*start / cos, *per_width * cos));
        self.knots.iter_mut().for_each(|knot| *knot /= cos);
        self
    }

    /// Ascending knots (rad) from the defect's centre. Outside the first and last the path is 0.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The path at `angle` (rad) by the polynomials of `piece`, which may be asked slightly beyond its ends.
    #[inline(always)]
    pub fn at(&self, piece: usize, angle: f64) -> PathPoint {
        self.pieces[piece].at(angle)
    }

    /// d²P/dψ² (m/rad²) where [`RigidPath::at`] has path and slope: the derivative of that slope. It is off the rolling
    /// circle's by width² P⁗/12, 4e-7 of itself where an element of 8 mm begins to roll over an edge, and steps by less
    /// between two intervals of the table.
    pub fn second_derivative(&self, piece: usize, angle: f64) -> f64 {
        self.pieces[piece].second_derivative(angle)
    }
}

impl Piece {
    fn new(roller: &Roller, feature: Feature, start: f64, end: f64) -> Self {
        if roller.is_level(feature) {
            // Not by its ends: rounding puts them beside the floor, where the slope is none of the floor's.
            let path = roller.touch(feature, 0.5 * (start + end)).path;
            return Self { start, per_width: 1.0 / (end - start), cubics: vec![[path, 0.0, 0.0, 0.0]] };
        }
        let rolling = roller.rolling();
        let interval = INTERVAL.max(INTERVAL_OF_RADIUS * rolling.element_radius);
        let limit = ACCURACY * rolling.element_radius + 4.0 * f64::EPSILON * rolling.raceway_radius;
        let arc = (end - start) * rolling.bearer_radius();
        let mut count = (arc / interval).ceil().max(1.0) as usize;
        loop {
            let piece = Self::of_intervals(roller, feature, start, end, count);
            if count >= MOST || piece.error(roller, feature) <= limit {
                return piece;
            }
            count *= 2;
        }
    }

    fn of_intervals(roller: &Roller, feature: Feature, start: f64, end: f64, count: usize) -> Self {
        let width = (end - start) / count as f64;
        let node = |i: usize| roller.touch(feature, start + width * i as f64);
        let Touch { path: mut p0, slope: mut m0 } = node(0);
        m0 *= width;
        let cubics = (1..=count)
            .map(|i| {
                let Touch { path: p1, slope } = node(i);
                let m1 = slope * width;
                let cubic = hermite::cubic([p0, m0, p1, m1]);
                (p0, m0) = (p1, m1);
                cubic
            })
            .collect();
        Self { start, per_width: 1.0 / width, cubics }
    }

    /// Error (m) in the middle of intervals, where it is largest; of every sixteenth and the last, as it changes slowly
    /// along them.
    fn error(&self, roller: &Roller, feature: Feature) -> f64 {
        let off = |i: usize| {
            let angle = self.start + (i as f64 + 0.5) / self.per_width;
            (self.at(angle).path - roller.touch(feature, angle).path).abs()
        };
        let last = self.cubics.len() - 1;
        (0..last).step_by(16).chain([last]).map(off).fold(0.0, f64::max)
    }

    /// The cubic of the interval around `angle`, and where in it that is, from 0 to 1.
    #[inline(always)]
    fn interval(&self, angle: f64) -> ([f64; 4], f64) {
        let x = (angle - self.start) * self.per_width;
        let index = (x.max(0.0) as usize).min(self.cubics.len() - 1);
        (self.cubics[index], x - index as f64)
    }

    #[inline(always)]
    fn at(&self, angle: f64) -> PathPoint {
        let ([c0, c1, c2, c3], t) = self.interval(angle);
        PathPoint {
            path: c0 + t * (c1 + t * (c2 + t * c3)),
            slope: self.per_width * (c1 + t * (2.0 * c2 + t * 3.0 * c3)),
        }
    }

    fn second_derivative(&self, angle: f64) -> f64 {
        let ([_, _, c2, c3], t) = self.interval(angle);
        self.per_width * self.per_width * (2.0 * c2 + 6.0 * t * c3)
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    const R: f64 = 3.97e-3;
    const R_O: f64 = 23.6325e-3;

    /// Path of an element of radius `r` over a spall of half a length and a depth (m).
    fn spall(r: f64, raceway: f64, half: f64, depth: f64) -> Result<RigidPath, ContactError> {
        RigidPath::new(&[(-half, 0.0), (-half, depth), (half, depth), (half, 0.0)], Rolling::outer_ring(r, raceway))
    }

    /// P = R_o cos d − √(r² − R_o² sin² d) − (R_o − r) at angle d past an edge, above the floor.
    fn path_of(r: f64, raceway: f64, d: f64) -> f64 {
        raceway * d.cos() - (r * r - (raceway * d.sin()).powi(2)).sqrt() - (raceway - r)
    }

    fn value(path: &RigidPath, angle: f64) -> PathPoint {
        let knots = path.knots();
        let piece = knots.partition_point(|&k| k <= angle).clamp(1, knots.len() - 1) - 1;
        path.at(piece, angle)
    }

    #[test]
    fn a_sharp_spall_has_the_closed_form() {
        let (length, depth) = (6.5e-3, 100e-6);
        let path = spall(R, R_O, 0.5 * length, depth).unwrap();
        let half = 0.5 * length / R_O;
        for i in 0..=1000 {
            let angle = half * (i as f64 / 500.0 - 1.0);
            let off = value(&path, angle).path - path_of(R, R_O, half - angle.abs()).min(depth);
            // The cubics' error, 1e-16 m at this size.
            assert!(off.abs() < 2e-16, "at {angle}: {off:e}");
        }
    }

    #[test]
    fn elements_of_a_fraction_of_a_millimetre_follow_the_closed_form_too() {
        for r in [25e-6, 250e-6] {
            let (raceway, half, depth) = (6.0 * r, 0.5 * r, 0.9 * r);
            let path = spall(r, raceway, half, depth).unwrap();
            for i in 0..=1000 {
                let angle = half / raceway * (i as f64 / 500.0 - 1.0);
                let d = half / raceway - angle.abs();
                let off = value(&path, angle).path - path_of(r, raceway, d).min(depth);
                // The cubics', and roundings of the raceway's radius.
                assert!(off.abs() <= 2.0 * ACCURACY * r, "radius {r}, at {angle}: {off:e} m");
            }
        }
    }

    #[test]
    fn slopes_are_as_exact_as_the_paths_accuracy_says() {
        for r in [25e-6, 1e-3, 3.97e-3, 0.25] {
            let (raceway, half, depth) = (6.0 * r, 0.5 * r, 0.9 * r);
            let path = spall(r, raceway, half, depth).unwrap();
            for i in 0..2000 {
                let angle = half / raceway * ((f64::from(i) + 0.37) / 1000.0 - 1.0);
                // tan κ by the triangle of edge, centre and the ring's centre; the element turns down from the nearer
                // edge.
                let d = half / raceway - angle.abs();
                let (across, rho) = (raceway * d.sin(), path_of(r, raceway, d) + raceway - r);
                let root = (r * r - across * across).sqrt();
                let expected = -angle.signum() * rho * across / root;
                let off = (value(&path, angle).slope - expected).abs() / raceway;
                // √3/216 width³ P⁗, a tenth more for the raceway's curvature, and at most 3.1 of the path's error over
                // the width that this asks for, 1e-3 r cos^1.75 κ at the least; roundings over half of either.
                let (widest, narrow) = (5e-6f64.max(1.25e-3 * r), 1e-3 * r * (root / r).powf(1.75));
                let fourth = 3.0 * (1.0 + 4.0 * (across / r).powi(2)) / (r.powi(3) * (root / r).powi(7));
                let truncated = 1.1 * 3f64.sqrt() / 216.0 * widest.powi(3) * fourth;
                let rounded = 3.0 * f64::EPSILON * (2.0 * raceway + r) / (0.5 * narrow.min(widest));
                let limit = truncated.min(3.1 * ACCURACY * r / narrow) + rounded;
                assert!(off <= limit, "radius {r}, at {angle}: {off:e}, allowed {limit:e}");
            }
        }
    }

    #[test]
    fn a_long_level_stretch_is_level_whatever_rounds_at_its_ends() {
        // Its ends lie 3.6e-14 rad beside those of the straight piece: the slope there over 2.9 rad made 7e-14 m of
        // path.
        let (r, raceway) = (7.015216056226324e-3, 0.17926494803179768);
        let arcs = [0.0, 512.2927440803601, 565.585532953191, 618.8783218260219, 977.0465142100691];
        let depths = [0.0, 0.0, -0.25304031344032263e-6, 0.0, 0.0];
        let middle = 0.5 * arcs[4];
        let points: Vec<(f64, f64)> = arcs.iter().zip(depths).map(|(s, h)| ((s - middle) * 1e-3, h)).collect();
        let path = RigidPath::new(&points, Rolling::outer_ring(r, raceway)).unwrap();
        for i in 1..100 {
            let found = value(&path, path.knots()[0] + 2.85 * f64::from(i) / 100.0);
            // A rounding of the raceway's radius.
            assert!(found.path.abs() <= 3e-17 && found.slope == 0.0, "{found:?}");
        }
    }

    #[test]
    fn a_wall_is_refused_that_the_element_could_only_meet_with_its_side() {
        let half = 2.0 * R;
        // The edge is r beside the centre.
        let limit = (R_O * R_O - R * R).sqrt() - (R_O - R);
        assert!(spall(R, R_O, half, 0.999 * limit).is_ok());
        let error = spall(R, R_O, half, 1.001 * limit).unwrap_err();
        let ContactError::NoWayOut { depth_mm, limit_mm, .. } = error else { panic!("{error}") };
        // 1e-13 rad to which the leap is found, under the root.
        assert!(
            (depth_mm - 1.001e3 * limit).abs() < 1e-9 && (limit_mm - 1e3 * limit).abs() < 2e3 * 1e-6 * R,
            "{error}"
        );
    }

    #[test]
    fn a_ball_wider_than_the_spall_never_reaches_its_floor() {
        // 0.8 mm on a 6205: the drop is 16.8 µm with a cusp in the middle, whatever the depth.
        let path = spall(R, 23.49e-3, 4e-4, 1e-3).unwrap();
        assert_eq!(path.knots().len(), 3);
        let cusp = path.at(0, 0.0);
        // The source prints three digits.
        assert!((cusp.path - 16.8e-6).abs() < 0.05e-6, "{}", cusp.path);
        assert!(cusp.slope > 0.0 && path.at(1, 0.0).slope < 0.0);
    }

    #[test]
    fn a_raised_rim_lifts_the_element_before_it_gets_there() {
        let path = RigidPath::new(&[(0.0, 0.0), (1e-4, -2e-6), (2e-4, 0.0)], Rolling::outer_ring(R, R_O)).unwrap();
        let top = value(&path, 1e-4 / R_O);
        assert!((top.path + 2e-6).abs() < 1e-12, "on the rim: {}", top.path);
        assert!(path.knots()[0] < -1e-5 / R_O);
    }

    #[test]
    fn the_path_lies_on_the_envelope_of_a_rough_profile() {
        // A profile of pseudo-random heights; oracle: direct minimum over a fine sampling of it.
        let mut seed = 1u64;
        let points: Vec<(f64, f64)> = (0..60)
            .map(|i| {
                seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
                let share = (seed >> 33) as f64 / (1u64 << 31) as f64;
                (i as f64 * 20e-6, if i == 0 || i == 59 { 0.0 } else { 3e-6 * share })
            })
            .collect();
        let path = RigidPath::new(&points, Rolling::outer_ring(R, R_O)).unwrap();
        let height = |arc: f64| {
            let i = points.partition_point(|p| p.0 <= arc);
            if i == 0 || i == points.len() {
                return 0.0;
            }
            let ((a0, h0), (a1, h1)) = (points[i - 1], points[i]);
            h0 + (h1 - h0) * (arc - a0) / (a1 - a0)
        };
        for i in 0..400 {
            let angle = (i as f64 + 0.5) / 400.0 * 1.18e-3 / R_O;
            let direct = (-6000..6000)
                .map(|k| {
                    let phi = angle + k as f64 * 1e-7 / R_O;
                    let radius = R_O + height(phi * R_O);
                    let d = phi - angle;
                    radius * d.cos() - (R * R - (radius * d.sin()).powi(2)).sqrt() - (R_O - R)
                })
                .fold(f64::INFINITY, f64::min);
            // The oracle's sampling of 0.1 µm misses a vertex by at most slope × 0.05 µm ≈ 10 nm.
            let found = value(&path, angle).path;
            assert!((found - direct).abs() < 1e-8, "at {angle}: {found} against {direct}");
            assert!(found <= direct + 1e-15);
        }
    }

    #[test]
    fn slope_and_second_derivative_are_those_of_the_path() {
        let path = spall(R, R_O, 3.25e-3, 100e-6).unwrap();
        let knots = path.knots();
        let angle = knots[0] + 0.4 * (knots[1] - knots[0]);
        let (h, at) = (1e-5, |a| path.at(0, a));
        let slope = (at(angle + h).path - at(angle - h).path) / (2.0 * h);
        let second = (at(angle + h).slope - at(angle - h).slope) / (2.0 * h);
        // Quotient error h² P‴/6 ≈ 1e-9 of the value.
        assert!((at(angle).slope / slope - 1.0).abs() < 1e-6);
        assert!((path.second_derivative(0, angle) / second - 1.0).abs() < 1e-4);
    }
}
