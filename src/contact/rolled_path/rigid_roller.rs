//! Two rigid circles, one of which has a profile, that roll over each other: which feature of it touches the other
//! circle, and by how much they then come together.
//!
//! Equations and limits are those of `rigid_path`, which makes a table of what is found here.

use crate::contact::error::ContactError;
use crate::contact::love::{Arcs, check_ends};
use crate::contact::rolling::{Rolling, Touch};

/// Largest tan κ with which a stretch may begin or end, 89.99°. Where the path leaps it is infinite, or 1e5 by the
/// ends' rounding.
pub(super) const STEEPEST: f64 = 1e4;

/// What the element touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Feature {
    /// The raceway outside the profile.
    Raceway,
    /// A point of the profile.
    Vertex(usize),
    /// The inside of the straight piece after a point of the profile.
    Stretch(usize),
}

/// A point of the profile in polar form.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    /// φ (rad).
    phi: f64,
    /// B (m).
    radius: f64,
}

/// The feature that is touched at an angle (rad).
#[derive(Debug, Clone, Copy)]
struct Touched {
    angle: f64,
    feature: Feature,
}

/// A stretch of the path over one feature.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    /// Angle at which it ends (rad).
    pub(in crate::contact) end: f64,
    pub(super) feature: Feature,
}

/// All stretches of the path.
pub(super) struct Stretches {
    /// Angle at which the first one begins (rad).
    pub(in crate::contact) begin: f64,
    /// Each begins where the one before ends.
    pub(super) list: Vec<Stretch>,
}

/// The profile in polar form and the circle that rolls over it.
pub(super) struct Roller {
    rolling: Rolling,
    /// φ does not decrease; starts and ends on the smooth body.
    vertices: Vec<Vertex>,
    shallowest: f64,
    deepest: f64,
}

impl Roller {
    /// `points` as (arc, depth) (m).
    pub(in crate::contact) fn new(points: &[(f64, f64)], rolling: Rolling) -> Self {
        let radius = rolling.bearer_radius();
        let vertex = |&(arc, depth): &(f64, f64)| Vertex { phi: arc / radius, radius: rolling.radius_at(depth) };
        let mut vertices: Vec<Vertex> = points.iter().map(vertex).collect();
        if let (Some(&first), Some(&last)) = (vertices.first(), vertices.last()) {
            // A profile that does not start or end at depth 0 has a wall there.
            if first.radius != radius {
                vertices.insert(0, Vertex { radius, ..first });
            }
            if last.radius != radius {
                vertices.push(Vertex { radius, ..last });
            }
        }
        let depths = || vertices.iter().map(|v| rolling.depth_of(v.radius));
        let (shallowest, deepest) = (depths().fold(0.0, f64::min), depths().fold(0.0, f64::max));
        Self { rolling, vertices, shallowest, deepest }
    }

    /// First and last angle of the profile.
    fn ends(&self) -> (f64, f64) {
        (self.vertices.first().map_or(0.0, |v| v.phi), self.vertices.last().map_or(0.0, |v| v.phi))
    }

    /// Refuses a leap of the path between two features that meet at `angle`.
    pub(super) fn check_climb(&self, angle: f64, features: [Feature; 2]) -> Result<(), ContactError> {
        let [before, behind] = features.map(|feature| self.touch(feature, angle));
        let rolling = self.rolling();
        if [before, behind].iter().all(|&Touch { path, slope }| slope.abs() <= STEEPEST * rolling.distance(path)) {
            return Ok(());
        }
        Err(ContactError::NoWayOut {
            at_mm: angle * rolling.bearer_radius() * 1e3,
            depth_mm: before.path.max(behind.path) * 1e3,
            limit_mm: before.path.min(behind.path) * 1e3,
            radius_mm: rolling.element_radius * 1e3,
        })
    }

    /// Refuses a profile around the whole body.
    pub(super) fn check_ends(&self) -> Result<(), ContactError> {
        let radius = self.rolling.bearer_radius();
        let arcs = |(first, last)| Arcs { first: first * radius, last: last * radius };
        check_ends(arcs(self.ends()), arcs(self.extent()), radius, "where raised rims may lift them")
    }

    /// Angles between which the path may differ from 0: the profile, and beyond it what a raised rim touches.
    fn extent(&self) -> (f64, f64) {
        let (first, last) = self.ends();
        // A rim that rises by e lifts the element over √(2 e r R/(R∓r)) on either side; 1 % more to be clear of it.
        let Rolling { element_radius, raceway_radius, .. } = self.rolling;
        let reach = (2.0 * -self.shallowest * element_radius * raceway_radius / self.rolling.smooth_distance()).sqrt()
            * (1.01 / self.rolling.bearer_radius());
        (first - reach, last + reach)
    }

    /// The two bodies.
    pub(super) fn rolling(&self) -> &Rolling {
        &self.rolling
    }

    /// Whether the path over a feature has the same height everywhere.
    pub(super) fn is_level(&self, feature: Feature) -> bool {
        match feature {
            Feature::Raceway => true,
            Feature::Vertex(_) => false,
            Feature::Stretch(index) => self.vertices[index].radius == self.vertices[index + 1].radius,
        }
    }

    /// The path's stretches of one touched feature each.
    ///
    /// A point p keeps the centre q outside the circle of radius r about it, of which the path follows the arc that
    /// faces the ring's centre: q·(q − p) < 0. The circles about two points with the middle m meet at m + t and m − t,
    /// with t across p₁p₂. If the paths crossed at both, the four conditions would hold, and their sum is 4 t² < 0. So
    /// the paths over two points cross once at most, whatever their depths; the one at the lower angle comes first, the
    /// touched point moves in one direction only, and between two angles with the same feature there is no other. The
    /// raceway on either side of the profile is the one exception: the search begins with an angle inside the profile.
    ///
    /// Along a straight piece, R linear in φ, the raceway's curvature is at most 1.09/R, less than the element's 1/r:
    /// it is touched at one point at most.
    pub(super) fn stretches(&self) -> Stretches {
        let (first, last) = self.extent();
        let mut found = Vec::new();
        let at = |share: f64| {
            let angle = first + (last - first) * share;
            Touched { angle, feature: self.touched(angle) }
        };
        let (left, middle, right) = (at(1e-12), at(0.5), at(1.0 - 1e-12));
        self.bisect(left, middle, &mut found);
        self.bisect(middle, right, &mut found);
        found.push(Stretch { end: last, feature: right.feature });
        Stretches { begin: first, list: found }
    }

    /// Pushes the stretches of all features that give way to another between two angles.
    fn bisect(&self, left: Touched, right: Touched, found: &mut Vec<Stretch>) {
        if left.feature == right.feature {
            return;
        }
        let middle = 0.5 * (left.angle + right.angle);
        // 1e-13 rad is 2e-15 m along the raceway.
        if right.angle - left.angle < 1e-13 || middle <= left.angle || middle >= right.angle {
            found.push(Stretch { end: middle, feature: left.feature });
            return;
        }
        let middle = Touched { angle: middle, feature: self.touched(middle) };
        self.bisect(left, middle, found);
        self.bisect(middle, right, found);
    }

    /// The feature that the element touches with its centre at `angle`.
    fn touched(&self, angle: f64) -> Feature {
        let mut best = (f64::INFINITY, Feature::Raceway);
        let (first, last) = self.ends();
        if angle <= first || angle >= last {
            best.0 = 0.0;
        }
        let nearest = self.vertices.partition_point(|v| v.phi < angle);
        // The straight piece above the centre first: its ends may be far away.
        if let Some(below) = nearest.checked_sub(1)
            && let Some(path) = self.stretch(below, angle)
            && path < best.0
        {
            best = (path, Feature::Stretch(below));
        }
        // Then outwards on either side, a vertex and the piece that leads on from it, until even the shallowest point
        // there is too far to be touched.
        let mut consider = |index: usize, beyond: Option<usize>| -> bool {
            let Vertex { phi, radius } = self.vertices[index];
            if self.lower_bound(phi - angle) > best.0 {
                return false;
            }
            if self.lower_bound(phi - angle) + self.rolling.depth_of(radius) - self.shallowest < best.0
                && let Some(path) = self.vertex(index, angle)
                && path < best.0
            {
                best = (path, Feature::Vertex(index));
            }
            if let Some(beyond) = beyond
                && let Some(path) = self.stretch(beyond, angle)
                && path <= best.0
            {
                best = (path, Feature::Stretch(beyond));
            }
            true
        };
        (nearest..self.vertices.len()).take_while(|&i| consider(i, Some(i))).count();
        (0..nearest).rev().take_while(|&i| consider(i, i.checked_sub(1))).count();
        best.1
    }

    /// A bound from below of the path over a point at angular distance `d` and beyond.
    fn lower_bound(&self, d: f64) -> f64 {
        self.rolling.least_rise(d, self.shallowest, self.deepest) + self.shallowest
    }

    fn vertex(&self, index: usize, angle: f64) -> Option<f64> {
        let Vertex { phi, radius } = self.vertices[index];
        self.rolling.path_over(radius, phi - angle)
    }

    /// The path over the straight piece after vertex `index`, if the element touches its inside.
    fn stretch(&self, index: usize, angle: f64) -> Option<f64> {
        let phi = self.stretch_touch(index, angle)?;
        self.rolling.path_over(self.radius_on(index, phi), phi - angle)
    }

    fn radius_on(&self, index: usize, phi: f64) -> f64 {
        let [Vertex { phi: phi0, radius: r0 }, Vertex { phi: phi1, radius: r1 }] =
            [self.vertices[index], self.vertices[index + 1]];
        r0 + (r1 - r0) * ((phi - phi0) / (phi1 - phi0))
    }

    /// Angle of the touched point inside a straight piece: there the path over the piece's points has a minimum.
    fn stretch_touch(&self, index: usize, angle: f64) -> Option<f64> {
        let &Vertex { phi: phi1, radius: r1 } = self.vertices.get(index + 1)?;
        let Vertex { phi: phi0, radius: r0 } = self.vertices[index];
        if phi1 <= phi0 {
            return None;
        }
        let slope = (r1 - r0) / (phi1 - phi0);
        if slope == 0.0 {
            return (angle > phi0 && angle < phi1).then_some(angle);
        }
        let derivative = |phi: f64| {
            let side = if phi < angle { f64::NEG_INFINITY } else { f64::INFINITY };
            self.rolling.change_along(self.radius_on(index, phi), slope, phi - angle).unwrap_or(side)
        };
        if derivative(phi0) >= 0.0 || derivative(phi1) <= 0.0 {
            return None;
        }
        let (mut low, mut high) = (phi0, phi1);
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return Some(middle);
            }
            if derivative(middle) < 0.0 { low = middle } else { high = middle }
        }
    }

    /// The path over one feature. By the envelope theorem only the direct dependence on ψ counts.
    pub(super) fn touch(&self, feature: Feature, angle: f64) -> Touch {
        let Vertex { phi, radius } = match feature {
            Feature::Raceway => return Touch::default(),
            Feature::Vertex(index) => self.vertices[index],
            // At the ends of a stretch rounding may put the touched point just outside it: then its end is touched.
            Feature::Stretch(index) => {
                let phi = self.stretch_touch(index, angle).unwrap_or_else(|| {
                    let reach = |v: Vertex| self.rolling.path_over(v.radius, v.phi - angle).unwrap_or(f64::INFINITY);
                    let (from, to) = (self.vertices[index], self.vertices[index + 1]);
                    if reach(from) <= reach(to) { from.phi } else { to.phi }
                });
                Vertex { phi, radius: self.radius_on(index, phi) }
            }
        };
        self.rolling.touch(radius, phi - angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_are_those_that_a_dense_search_finds() {
        let mut seed = 7u64;
        let mut random = || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (seed >> 33) as f64 / (1u64 << 31) as f64
        };
        // Depths of 3, 30 and 200 µm between points 2 to 40 µm apart: walls as steep as 89°, some raised above the
        // raceway.
        for depth in [3e-6, 30e-6, 200e-6] {
            for _ in 0..5 {
                let mut arc = 0.0;
                let points: Vec<(f64, f64)> = (0..50)
                    .map(|i| {
                        arc += 2e-6 + 38e-6 * random();
                        (arc, if i == 0 || i == 49 { 0.0 } else { depth * (random() - 0.1) })
                    })
                    .collect();
                let roller = Roller::new(&points, Rolling::outer_ring(3.97e-3, 23.6325e-3));
                let Stretches { begin: first, list: stretches } = roller.stretches();
                let last = stretches[stretches.len() - 1].end;
                let mut stretch = 0;
                for i in 1..20_000 {
                    let angle = first + (last - first) * f64::from(i) / 20_000.0;
                    while angle > stretches[stretch].end {
                        stretch += 1;
                    }
                    // Where two ends of stretches fall together rounding decides between neighbours.
                    let near = |end: f64| (end - angle).abs() < 1e-12;
                    let feature = roller.touched(angle);
                    assert!(
                        feature == stretches[stretch].feature || stretches.iter().any(|s| near(s.end)),
                        "{depth} at {angle}: {feature:?}, not {:?}",
                        stretches[stretch].feature
                    );
                }
            }
        }
    }
}
