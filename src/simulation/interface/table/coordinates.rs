//! Names of the coordinates of rings, and the rows that only rings in space have.

use super::builder::Builder;
use super::variables::Unit;
use crate::scene::{Defect, DefectOn, DegreesOfFreedom, Motion};
use crate::simulation::interface::quantity::{Quantity as Q, RingName};
use crate::surface::Surface;

/// Letter of each coordinate of a ring, and whether it is along an axis or about one.
pub(super) const COORDINATES: [[&str; 2]; 5] =
    [["x", "along "], ["y", "along "], ["z", "along "], ["x", "about "], ["y", "about "]];

/// What belongs to motion along an axis, and to tilts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Along<T> {
    pub(super) axis: T,
    pub(super) tilt: T,
}

impl<T> Along<T> {
    /// What belongs to a coordinate.
    pub(super) fn of(self, coordinate: usize) -> T {
        if coordinate > 2 { self.tilt } else { self.axis }
    }
}

/// Name of the position, or with its prefix of a rate, of a ring along a coordinate.
pub(super) fn name(ring: &str, prefix: &str, coordinate: usize) -> String {
    let tilt = Along { axis: ".", tilt: ".tilt." }.of(coordinate);
    [ring, tilt, prefix, COORDINATES[coordinate][0]].concat()
}

/// Name of a part of the tangent stiffness, its row first.
pub(super) fn stiffness_name(row: usize, column: usize) -> String {
    let letter = |k: usize| [Along { axis: "", tilt: "tilt_" }.of(k), COORDINATES[k][0]].concat();
    let between = if row > 2 || column > 2 { "_" } else { "" };
    ["shaft.stiffness.", &letter(row), between, &letter(column)].concat()
}

impl Builder<'_> {
    /// Forces on a ring along its axes, and in space moments about x and y.
    pub(super) fn forces(&mut self, ring: RingName, prefix: &str, text: [&str; 2], quantity: fn(RingName, usize) -> Q) {
        let [of, what] = ring.names();
        for axis in 0..if self.in_space() { COORDINATES.len() } else { 2 } {
            let [letter, along] = COORDINATES[axis];
            let kind = Along { axis: ["force.", "Force"], tilt: ["moment.", "Moment"] }.of(axis);
            self.output(
                &[of, ".", prefix, kind[0], letter].concat(),
                &[kind[1], text[0], " the ", what, " ", along, letter, text[1]].concat(),
                quantity(ring, axis),
                Along { axis: Unit::Newton, tilt: Unit::NewtonMetre }.of(axis),
                Along { axis: 1000.0, tilt: 10.0 }.of(axis),
            );
        }
    }

    /// Whether rings move beyond the plane.
    pub(super) fn in_space(&self) -> bool {
        self.scene.bearing.degrees_of_freedom != DegreesOfFreedom::Two
    }

    /// Whether any shoulder's height is known.
    pub(super) fn has_shoulders(&self) -> bool {
        let bearing = &self.scene.bearing;
        bearing.shoulder_inner.is_some() || bearing.shoulder_outer.is_some()
    }

    /// Whether contacts meet a ring's topography at places across the groove.
    pub(super) fn meets_topography_beside_its_track(&self) -> bool {
        let of_ring = |(defect, surface): (&Defect, &Surface)| {
            matches!(surface, Surface::Topography(_)) && !matches!(defect.on, DefectOn::Element { .. })
        };
        self.in_space() && self.scene.defects.iter().zip(self.surfaces).any(of_ring)
    }

    /// Coordinates along which a ring moves. The tilt of an outer ring that moves under forces is held.
    pub(super) fn moving(&self, ring: RingName) -> std::ops::Range<usize> {
        let count = self.scene.bearing.degrees_of_freedom.count();
        let held = ring == RingName::Housing && self.motion(ring) == Motion::Internal;
        0..if held { count.min(3) } else { count }
    }

    /// Contact angles of an element, and what they leave to the shoulders.
    pub(super) fn element_angles(&mut self, j: usize) {
        let bearing = &self.scene.bearing;
        let sides = [("inner", bearing.shoulder_inner), ("outer", bearing.shoulder_outer)];
        let number = j + 1;
        for (side, (raceway, _)) in sides.into_iter().enumerate() {
            self.output(
                &format!("element[{number}].contact_angle.{raceway}"),
                &format!("Contact angle of element {number} on the {raceway} raceway; 0 where it is open"),
                Q::ContactAngle(j, side),
                Unit::Radian,
                0.1,
            );
        }
        for (side, (raceway, shoulder)) in sides.into_iter().enumerate() {
            if shoulder.is_none() {
                continue;
            }
            self.output(
                &format!("element[{number}].shoulder.{raceway}"),
                &format!(
                    "Angle from the end of the contact ellipse of element {number} to the {raceway} ring's shoulder; \
                     negative where the shoulder cuts it"
                ),
                Q::ShoulderMargin(j, side),
                Unit::Radian,
                0.1,
            );
        }
    }
}
