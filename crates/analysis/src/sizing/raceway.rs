//! A raceway with a spall, as sizing needs it: arcs, and how an element sinks past an edge.
//!
//! An element that is s past a sharp edge has sunk by
//! ```text
//! P(s) = s²/(2 r_e),   1/r_e = 1/r − 1/R_o outside,   1/r_e = 1/r + 1/R_i inside
//! ```
//! A concave raceway's curvature is taken off the element's, a convex one's is added: the same arc lets an element sink
//! 1.5 times as deep inside. The circles' own P differs by less than 1 % at 5 degrees. Angles are those of the raceway
//! itself, and what travels over it is the element: on the inner one at the difference of shaft's and cage's speed.

use crate::spectra::Fault;
use brinell::contact::law::elastic_law;
use brinell::contact::rolling::RacewaySide;
use brinell::geometry::STRIBECK;
use brinell::geometry::curvature::{reach, relative_curvature};
use brinell::geometry::hertz_constant::{HertzConstants, approach_under};
use brinell::scene::{Bearing, Motion, Scene};

/// The raceway with the spall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Raceway {
    /// Of the outer ring.
    Outer,
    /// Of the inner ring.
    Inner,
}

impl Raceway {
    /// The raceway that is sized where a recording looks like this fault: the outer one unless it is clearly the inner.
    pub fn of(fault: Fault) -> Self {
        if fault == Fault::Inner { Self::Inner } else { Self::Outer }
    }

    /// Radius (m).
    pub fn radius(self, bearing: &Bearing) -> f64 {
        match self {
            Self::Outer => bearing.outer_raceway_radius(),
            Self::Inner => bearing.inner_raceway_radius(),
        }
    }

    /// 1/r_e (1/m).
    fn relative_curvature(self, bearing: &Bearing) -> f64 {
        let own = self.radius(bearing);
        relative_curvature(bearing.element_radius(), if self == Self::Inner { own } else { -own })
    }

    /// Travel past an edge (degrees) after which an element has sunk by `depth` (m).
    pub fn sunk_after(self, bearing: &Bearing, depth: f64) -> f64 {
        (reach(depth, self.relative_curvature(bearing)) / self.radius(bearing)).to_degrees()
    }

    /// How far (m) an element has sunk `degrees` past an edge.
    pub fn depth_at(self, bearing: &Bearing, degrees: f64) -> f64 {
        let s = degrees.to_radians() * self.radius(bearing);
        0.5 * s * s * self.relative_curvature(bearing)
    }
}

/// Approach of the most loaded element's two contacts together (m); Q as of [`STRIBECK`].
pub(crate) fn approach(scene: &Scene) -> Option<f64> {
    let load = scene.shaft.load[0].hypot(scene.shaft.load[1]);
    if scene.shaft.motion != Motion::Internal || load == 0.0 {
        return None;
    }
    let force = STRIBECK * load / scene.bearing.element_count as f64;
    if scene.bearing.roller().is_some() {
        let both = [RacewaySide::Inner, RacewaySide::Outer];
        return Some(both.map(|side| elastic_law(&scene.bearing, side).approach_under(force)).iter().sum());
    }
    Some(approach_under(force, HertzConstants::of(&scene.bearing).in_series()))
}

/// Shortest length that the scene's load and clearance allow (degrees), where the load is known.
pub(super) fn shortest_length(scene: &Scene, raceway: Raceway) -> Option<f64> {
    let free = approach(scene)? + scene.bearing.radial_clearance.max(0.0);
    Some(2.0 * raceway.sunk_after(&scene.bearing, free))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_element_sinks_as_deep_as_the_rolling_of_circles_says() {
        // An ER16K with 5 µm of clearance; arcs of a rigid ball's path, 0.4 mm past an edge: 16.81551 and 25.29747 µm.
        let bearing = Bearing::steel_balls(9, 7.94e-3, 39.32e-3);
        for (raceway, expected) in [(Raceway::Outer, 16.81551e-6), (Raceway::Inner, 25.29747e-6)] {
            let degrees = (0.4e-3 / raceway.radius(&bearing)).to_degrees();
            let sunk = raceway.depth_at(&bearing, degrees);
            // The next term of the series is (s/r)²/4: 0.3 % here.
            assert!((sunk / expected - 1.0).abs() < 4e-3, "{raceway:?}: {sunk}");
            assert!((raceway.sunk_after(&bearing, sunk) - degrees).abs() < 1e-12);
        }
    }
}
