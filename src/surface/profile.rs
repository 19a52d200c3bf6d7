//! Depth of a surface along its arc, the same over the whole width: a polygon.
//!
//! h(s) is linear between its points. Two points at one arc are a vertical edge. Outside its points h = 0; where the
//! first or last point is not at depth 0 the profile ends in a vertical edge.

use super::{Interval, SurfaceError};

/// An arc (m) as a multiple of 2⁻⁴⁰ m, about a picometre, so that a body turned by any angle, and flanks any distance
/// apart, have the same profile to the bit.
pub(crate) fn rounded(arc: f64) -> f64 {
    const FINEST: f64 = 1.099511627776e12;
    (arc * FINEST).round() / FINEST
}

/// Depth h (m) over the arc s (m).
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Arc and depth; arcs do not descend, at most two are equal, the first and last depth are 0.
    points: Vec<(f64, f64)>,
    /// Whether the points are samples of something unknown between them, and not corners of a polygon.
    sampled: bool,
}

/// The upper corner of an edge.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Corner {
    /// Its arc (m).
    pub(crate) arc: f64,
    /// +1 where the raceway falls with growing arc, −1 where it rises.
    pub(crate) fall: f64,
}

impl Profile {
    /// A trapezoid: flat floor, straight flanks that lie within the length.
    ///
    /// `length` (m) is measured at the raceway's surface, `depth` (m) at the floor, `edge_slope` (rad) is the flanks'
    /// angle against the raceway, π/2 for vertical edges. Flanks that would meet above the floor are made just steep
    /// enough to meet on it; a checked scene has none.
    pub fn spall(length: f64, depth: f64, edge_slope: f64) -> Self {
        let half = length / 2.0;
        let run = depth / libm::tan(edge_slope);
        // π/2 is not a number of the machine: its tangent is some 1e16, and may be negative after a conversion from
        // degrees.
        let run = if run < 1e-9 * depth { 0.0 } else { run.min(half) };
        let mut points = vec![(-half, 0.0), (-half + run, depth)];
        if run < half {
            points.push((half - run, depth));
        }
        points.push((half, 0.0));
        Self { points, sampled: false }
    }

    /// The same depths over arcs of another length.
    pub(crate) fn stretched(&self, share: f64) -> Self {
        let points = self.points.iter().map(|&(arc, depth)| (arc * share, depth)).collect();
        Self { points, ..*self }
    }

    /// A polygon through arcs and depths (m), arcs not descending.
    ///
    /// # Errors
    /// Fewer than two points, a value that is not finite, an arc below the one before, three points at one arc.
    pub fn from_points(points: Vec<(f64, f64)>) -> Result<Self, SurfaceError> {
        if points.len() < 2 {
            return Err(SurfaceError::TooFewPoints { found: points.len(), column: "arc_mm" });
        }
        let wrong = |index, why| Err(SurfaceError::Points { index, why });
        for (index, &(arc, depth)) in points.iter().enumerate() {
            if !(arc.is_finite() && depth.is_finite()) {
                return wrong(index, "arc and depth must be finite");
            }
            if index >= 1 && arc < points[index - 1].0 {
                return wrong(index, "its arc must not be below the one before");
            }
            if index >= 2 && arc == points[index - 2].0 {
                return wrong(index, "at most two points may have the same arc");
            }
        }
        Ok(Self::closed(points))
    }

    /// The same with its floor, which is level between these two of its arcs (m), from −`half` to `half` (m): arcs from
    /// the floor's ends are rounded, so that floors of any length between the same flanks give equal bits.
    pub(crate) fn with_floor(&self, [start, end]: [f64; 2], half: f64) -> Self {
        let moved = |arc: f64| if arc <= start { rounded(arc - start) - half } else { rounded(arc - end) + half };
        Self { points: self.points.iter().map(|&(arc, depth)| (moved(arc), depth)).collect(), ..*self }
    }

    /// Several profiles as one, each with the arc (m) at which its own arcs begin; they ascend and do not touch.
    pub(crate) fn joined(profiles: &[(f64, &Self)]) -> Self {
        let moved = |&(by, profile): &(f64, &Self)| {
            profile.points.iter().map(move |&(arc, depth)| (arc + by, depth)).collect::<Vec<_>>()
        };
        let points = profiles.iter().flat_map(moved).collect();
        Self { points, sampled: profiles.iter().any(|(_, profile)| profile.sampled) }
    }

    /// As [`from_points`](Self::from_points), of points that are known to be in order.
    pub(super) fn closed(mut points: Vec<(f64, f64)>) -> Self {
        close_ends(&mut points);
        Self { points, sampled: false }
    }

    /// The points are samples of something unknown between them, and not corners of a polygon.
    pub(super) fn into_samples(self) -> Self {
        Self { sampled: true, ..self }
    }

    /// The longest straight line between two samples that differ; `None` for a polygon.
    pub(super) fn coarsest(&self) -> Option<Interval> {
        let lines = self.points.windows(2).filter(|pair| self.sampled && pair[0].1 != pair[1].1);
        Interval::longest(lines.map(|pair| Interval::new(pair[0].0, pair[1].0)))
    }

    /// With every depth multiplied by `factor`.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        Self { points: self.points.iter().map(|&(arc, depth)| (arc, factor * depth)).collect(), ..*self }
    }

    /// Upper corners of edges that are at least `steep` (tangent) and `drop` (m) deep, in ascending order: index of the
    /// point, and [`Corner::fall`].
    fn corners(&self, steep: f64, drop: f64) -> Vec<(usize, f64)> {
        let step = |k: usize| {
            let ((s0, d0), (s1, d1)) = (self.points[k], self.points[k + 1]);
            if (d1 - d0).abs() > steep * (s1 - s0) { (d1 - d0).signum() } else { 0.0 }
        };
        let (mut corners, mut k) = (Vec::new(), 0);
        while k + 1 < self.points.len() {
            let (from, fall) = (k, step(k));
            k += 1;
            while fall != 0.0 && k + 1 < self.points.len() && step(k) == fall {
                k += 1;
            }
            if fall != 0.0 && (self.points[k].1 - self.points[from].1).abs() >= drop {
                corners.push((if fall > 0.0 { from } else { k }, fall));
            }
        }
        corners
    }

    /// Upper corners of edges at least `steep` (tangent) and `drop` (m) deep, in ascending order.
    pub(crate) fn upper_corners(&self, steep: f64, drop: f64) -> Vec<Corner> {
        self.corners(steep, drop).into_iter().map(|(k, fall)| Corner { arc: self.points[k].0, fall }).collect()
    }

    /// With the upper side of such edges continued level by `distance` (m), and a vertical edge there.
    pub(crate) fn with_corners_continued(&self, steep: f64, drop: f64, distance: f64) -> Self {
        let mut points = self.points.clone();
        for (k, fall) in self.corners(steep, drop) {
            let (corner, depth) = self.points[k];
            let end = corner + fall * distance;
            let covered = |s: f64| if fall > 0.0 { s >= corner && s <= end } else { s <= corner && s >= end };
            let below = self.depth_at(end);
            let keep = |&(s, d): &(f64, f64)| !covered(s) || s == corner && d == depth;
            points.retain(keep);
            let at = points.partition_point(|&(s, _)| s < corner) + usize::from(fall > 0.0);
            let edge = if fall > 0.0 { [(end, depth), (end, below)] } else { [(end, below), (end, depth)] };
            points.splice(at..at, edge);
        }
        Self { points, ..*self }
    }

    /// Arcs and depths (m). Arcs do not descend; the first and last depth are 0; two equal arcs are a vertical edge.
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// First and last arc (m).
    pub fn extent(&self) -> (f64, f64) {
        (self.points[0].0, self.points[self.points.len() - 1].0)
    }

    /// Arcs (m), ascending, at which the depth jumps.
    pub fn edges(&self) -> Vec<f64> {
        let jumps = self.points.windows(2).filter(|pair| pair[0].0 == pair[1].0 && pair[0].1 != pair[1].1);
        jumps.map(|pair| pair[0].0).collect()
    }

    /// Depth (m) at an arc (m); at a vertical edge the mean of both sides.
    pub fn depth_at(&self, arc: f64) -> f64 {
        let next = self.points.partition_point(|&(s, _)| s < arc);
        let Some(&(s, h)) = self.points.get(next) else {
            return 0.0;
        };
        if s == arc {
            return match self.points.get(next + 1) {
                Some(&(s_after, h_after)) if s_after == arc => 0.5 * (h + h_after),
                _ => h,
            };
        }
        if next == 0 {
            return 0.0;
        }
        let (s_before, h_before) = self.points[next - 1];
        h_before + (h - h_before) * ((arc - s_before) / (s - s_before))
    }

    /// Exact mean depth (m) between two arcs (m) in either order; the depth itself where they are equal.
    pub fn mean_depth(&self, from: f64, to: f64) -> f64 {
        let (from, to) = if from <= to { (from, to) } else { (to, from) };
        if from == to {
            return self.depth_at(from);
        }
        // The segment that holds `from` begins one point before the first point beyond it.
        let first = self.points.partition_point(|&(s, _)| s <= from).saturating_sub(1);
        let mut area = 0.0;
        for pair in self.points[first..].windows(2) {
            let ((s0, h0), (s1, h1)) = (pair[0], pair[1]);
            if s0 >= to {
                break;
            }
            let (a, b) = (s0.max(from), s1.min(to));
            if b > a {
                let middle = 0.5 * ((a - s0) + (b - s0)) / (s1 - s0);
                area += (b - a) * (h0 + (h1 - h0) * middle);
            }
        }
        area / (to - from)
    }

    /// Arc and depth (m) of the point farthest from the smooth raceway.
    pub(super) fn farthest(&self) -> (f64, f64) {
        let deeper = |a: (f64, f64), b: (f64, f64)| if b.1.abs() > a.1.abs() { b } else { a };
        self.points.iter().copied().fold((0.0, 0.0), deeper)
    }
}

/// Ends at depth 0, by a vertical edge where need be.
fn close_ends(points: &mut Vec<(f64, f64)>) {
    let (first, last) = (points[0], points[points.len() - 1]);
    // An edge that is there already is replaced, not doubled: only its outer side is not 0.
    if points[1].0 == first.0 {
        points[0].1 = 0.0;
    } else if first.1 != 0.0 {
        points.insert(0, (first.0, 0.0));
    }
    let end = points.len() - 1;
    if points[end - 1].0 == last.0 {
        points[end].1 = 0.0;
    } else if last.1 != 0.0 {
        points.push((last.0, 0.0));
    }
}
