//! Two rigid circles that roll over each other, element and raceway, one of which has a defect.
//!
//! The bearing body is smooth at the radius B₀ and has the radius B at the touched point, B₀ + h inside the outer ring
//! and B₀ − h elsewhere; C is the radius of the other body. Let d be the angle at the bearer's centre from the line of
//! centres to the touched point. Then the path P, by how much the two come closer than over the smooth body, is
//! ```text
//! outer ring            P = B cos d − √(C² − B² sin² d) − (R_o − r)        B₀ = R_o, C = r
//! inner ring            P = R_i + r − B cos d − √(C² − B² sin² d)          B₀ = R_i, C = r
//! element, outer side   P = √(C² − B² sin² d) − B cos d − (R_o − r)        B₀ = r,   C = R_o
//! element, inner side   P = R_i + r − B cos d − √(C² − B² sin² d)          B₀ = r,   C = R_i
//! ```
//! All are s²/(2 r_e) to third order in the arc s = B₀ d over a point of depth 0, with 1/r_e = 1/r ∓ 1/R: a concave
//! raceway's curvature is taken off the element's, a convex one's is added.

use crate::numerics::sin_cos;
use crate::scene::Bearing;

/// The body that has a defect, and the one that rolls over it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rolling {
    /// Radius of the element r (m).
    pub element_radius: f64,
    /// Radius of the raceway at the groove's bottom, R_o or R_i (m).
    pub raceway_radius: f64,
    /// Which of the two raceways.
    pub raceway: RacewaySide,
    /// Whether the element has the defect, and not the raceway.
    pub on_element: bool,
}

/// One of the two raceways.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RacewaySide {
    /// That of the inner ring, which is convex.
    Inner,
    /// That of the outer ring, which is concave.
    Outer,
}

impl RacewaySide {
    /// Radius R_c (m) of the track at a contact angle α (rad): R_o − r_go (1 − cos α), R_i + r_gi (1 − cos α).
    pub fn track_radius(self, bearing: &Bearing, angle: f64) -> f64 {
        let rise = bearing.groove_radii()[self as usize] * (1.0 - libm::cos(angle));
        match self {
            Self::Inner => self.radius(bearing) + rise,
            Self::Outer => self.radius(bearing) - rise,
        }
    }

    /// Its radius at the groove's bottom (m).
    pub fn radius(self, bearing: &Bearing) -> f64 {
        match self {
            Self::Inner => bearing.inner_raceway_radius(),
            Self::Outer => bearing.outer_raceway_radius(),
        }
    }
}

/// Where the bodies touch, as the path sees it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Touch {
    /// Path P (m).
    pub(super) path: f64,
    /// Its derivative by the angle ψ at which the bodies touch (m/rad).
    pub(super) slope: f64,
}

/// The triangle of the two centres and the touched point.
struct Triangle {
    sin: f64,
    cos: f64,
    /// √(C² − B² sin² d) (m).
    root: f64,
}

impl Rolling {
    /// An element of radius `element_radius` on a defect of the outer ring, whose radius is `raceway_radius` (m).
    pub fn outer_ring(element_radius: f64, raceway_radius: f64) -> Self {
        Self { element_radius, raceway_radius, raceway: RacewaySide::Outer, on_element: false }
    }

    /// An element of this bearing on one of its raceways; the defect is on the element or on the raceway.
    pub fn of(bearing: &Bearing, raceway: RacewaySide, on_element: bool) -> Self {
        let raceway_radius = raceway.radius(bearing);
        Self { element_radius: bearing.element_radius(), raceway_radius, raceway, on_element }
    }

    /// Radius B₀ of the body that has the defect (m).
    pub fn bearer_radius(&self) -> f64 {
        if self.on_element { self.element_radius } else { self.raceway_radius }
    }

    /// Radius C of the other body (m).
    fn other_radius(&self) -> f64 {
        if self.on_element { self.raceway_radius } else { self.element_radius }
    }

    /// Distance of the two centres over the smooth body (m).
    pub(super) fn smooth_distance(&self) -> f64 {
        match self.raceway {
            RacewaySide::Outer => self.raceway_radius - self.element_radius,
            RacewaySide::Inner => self.raceway_radius + self.element_radius,
        }
    }

    /// Distance of the two centres at a path (m).
    pub(super) fn distance(&self, path: f64) -> f64 {
        match self.raceway {
            RacewaySide::Outer => self.smooth_distance() + path,
            RacewaySide::Inner => self.smooth_distance() - path,
        }
    }

    /// Radius B at a depth (m).
    pub(super) fn radius_at(&self, depth: f64) -> f64 {
        if self.concave() { self.raceway_radius + depth } else { self.bearer_radius() - depth }
    }

    /// Depth at a radius B (m).
    pub(super) fn depth_of(&self, radius: f64) -> f64 {
        if self.concave() { radius - self.raceway_radius } else { self.bearer_radius() - radius }
    }

    /// Whether the body that has the defect is touched from its inside.
    fn concave(&self) -> bool {
        self.raceway == RacewaySide::Outer && !self.on_element
    }

    /// The triangle over a point at radius B = `radius` and angle `d`; `None` beyond reach, the far side included.
    fn triangle(&self, radius: f64, d: f64) -> Option<Triangle> {
        let (sin, cos) = sin_cos(d);
        let other = self.other_radius();
        let square = other * other - radius * radius * sin * sin;
        (square > 0.0 && cos > 0.0).then(|| Triangle { sin, cos, root: square.sqrt() })
    }

    /// The path by B cos d and the root.
    fn path(&self, along: f64, root: f64) -> f64 {
        match (self.raceway, self.on_element) {
            (RacewaySide::Outer, false) => along - root - self.smooth_distance(),
            (RacewaySide::Outer, true) => root - along - self.smooth_distance(),
            (RacewaySide::Inner, _) => self.smooth_distance() - along - root,
        }
    }

    /// Path (m) over a point at radius B = `radius` and angle `d`; `None` beyond reach.
    pub(super) fn path_over(&self, radius: f64, d: f64) -> Option<f64> {
        self.triangle(radius, d).map(|Triangle { cos, root, .. }| self.path(radius * cos, root))
    }

    /// The path over a point, with d = φ − ψ.
    pub(super) fn touch(&self, radius: f64, d: f64) -> Touch {
        let (sin, cos) = sin_cos(d);
        let other = self.other_radius();
        let root = (other * other - radius * radius * sin * sin).max(0.0).sqrt();
        let (across, turn) = (radius * sin, radius * radius * sin * cos / root);
        let slope = match (self.raceway, self.on_element) {
            (RacewaySide::Outer, false) => across - turn,
            (RacewaySide::Outer, true) => turn - across,
            (RacewaySide::Inner, _) => -across - turn,
        };
        Touch { path: self.path(radius * cos, root), slope }
    }

    /// Derivative of the path (m/rad) by the touched point's angle φ where the radius grows by `slope` (m/rad); `None`
    /// beyond reach.
    pub(super) fn change_along(&self, radius: f64, slope: f64, d: f64) -> Option<f64> {
        let Triangle { sin, cos, root } = self.triangle(radius, d)?;
        let turn = (radius * slope * sin * sin + radius * radius * sin * cos) / root;
        Some(match (self.raceway, self.on_element) {
            (RacewaySide::Outer, false) => slope * cos - radius * sin + turn,
            (RacewaySide::Outer, true) => radius * sin - slope * cos - turn,
            (RacewaySide::Inner, _) => radius * sin - slope * cos + turn,
        })
    }

    /// A bound from below of how much the path over a point at angle `d` is above the point's depth; depths lie between
    /// `shallowest` and `deepest` (m). It grows with |d| up to half a turn.
    pub(super) fn least_rise(&self, d: f64, shallowest: f64, deepest: f64) -> f64 {
        let (r, other) = (self.element_radius, self.other_radius());
        if self.concave() {
            // The path rises with the point's radius, and for one at radius R_s by at least ½ R_s (R_s−r)/r d²; a tenth
            // less is clear of rounding.
            let radius = self.raceway_radius + shallowest;
            return 0.45 * radius * (radius - r) / r * d * d;
        }
        let radius = self.bearer_radius() - deepest;
        let rise = radius * (1.0 - sin_cos(d).1);
        // Over a convex body the other's sag is added, B² sin² d/(2C) at the least, of which half the (1 + cos d) is
        // kept; inside the outer ring it is taken off, B² sin² d/(C + √·) at the most.
        0.999
            * match self.raceway {
                RacewaySide::Inner => rise * (1.0 + 0.5 * radius / other),
                RacewaySide::Outer => rise * (1.0 - radius / other),
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::rolled_path::RigidPath;

    /// Radii of the ER16K of `er16k-tb1` (m).
    const ELEMENT: f64 = 3.97e-3;
    const OUTER: f64 = 23.6325e-3;
    const INNER: f64 = 15.6875e-3;

    fn kinds() -> [(Rolling, f64); 4] {
        let of = |raceway, raceway_radius, on_element| Rolling {
            element_radius: ELEMENT,
            raceway_radius,
            raceway,
            on_element,
        };
        [
            (of(RacewaySide::Outer, OUTER, false), OUTER),
            (of(RacewaySide::Outer, OUTER, true), ELEMENT),
            (of(RacewaySide::Inner, INNER, false), INNER),
            (of(RacewaySide::Inner, INNER, true), ELEMENT),
        ]
    }

    /// Path over a sharp edge at angle `d`, in the forms in which nothing cancels.
    fn over_an_edge(rolling: &Rolling, d: f64) -> f64 {
        let (bearer, other) = (rolling.bearer_radius(), rolling.other_radius());
        let (across, root) = (bearer * d.sin(), (other * other - (bearer * d.sin()).powi(2)).sqrt());
        let (sag, rise) = (across * across / (other + root), 2.0 * bearer * (0.5 * d).sin().powi(2));
        match (rolling.raceway, rolling.on_element) {
            (RacewaySide::Outer, false) => sag - rise,
            (RacewaySide::Outer, true) => rise - sag,
            (RacewaySide::Inner, _) => rise + sag,
        }
    }

    #[test]
    fn paths_over_a_sharp_edge_are_those_of_the_closed_forms() {
        // Arc past the edge (mm) and the path of each kind (µm), to printed digits.
        let table = [
            (0.2, [4.19458, 4.19113, 6.31559, 6.31059]),
            (0.4, [16.81551, 16.76012, 25.29747, 25.21728]),
            (0.8, [67.86904, 66.96998, 101.76253, 100.46886]),
        ];
        for (arc, expected) in table {
            for ((rolling, _), expected) in kinds().into_iter().zip(expected) {
                let (half, depth) = (2e-3, 0.5e-3);
                let spall = [(-half, 0.0), (-half, depth), (half, depth), (half, 0.0)];
                let path = RigidPath::new(&spall, rolling).unwrap();
                for way in [1.0, -1.0] {
                    let angle = way * (half - arc * 1e-3) / rolling.bearer_radius();
                    let piece = path.knots().partition_point(|&k| k <= angle) - 1;
                    let found = path.at(piece, angle);
                    let closed = over_an_edge(&rolling, arc * 1e-3 / rolling.bearer_radius());
                    assert!((1e6 * closed - expected).abs() < 0.6e-5, "{rolling:?}: {closed:e}, not {expected}");
                    assert!((found.path - closed).abs() < 1e-15, "{rolling:?} at {arc}: {:e}", found.path - closed);
                    let step = 1e-5;
                    let slope = (path.at(piece, angle + step).path - path.at(piece, angle - step).path) / (2.0 * step);
                    assert!((found.slope - slope).abs() < 1e-6 * slope.abs(), "{rolling:?}: {} {slope}", found.slope);
                }
            }
        }
    }

    #[test]
    fn the_floor_is_reached_after_the_arcs_of_the_closed_forms() {
        let expected = [0.968328, 0.977916, 0.793094, 0.798121];
        for ((rolling, radius), expected) in kinds().into_iter().zip(expected) {
            let (half, depth) = (2e-3, 100e-6);
            let spall = [(-half, 0.0), (-half, depth), (half, depth), (half, 0.0)];
            let path = RigidPath::new(&spall, rolling).unwrap();
            let arcs: Vec<f64> = path.knots().iter().map(|angle| 1e3 * angle * radius).collect();
            assert_eq!(arcs.len(), 4);
            // Printed digits, in millimetres.
            assert!((arcs[1] - arcs[0] - expected).abs() < 0.6e-6 && (arcs[0] + 2.0).abs() < 1e-9, "{arcs:?}");
        }
    }
}
