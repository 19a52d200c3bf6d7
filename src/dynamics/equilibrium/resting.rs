//! Where an element rests on a raceway that it touches without force.

use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{Meeting, Shortcuts};
use crate::dynamics::parameters::{Frame, Frames, Model, SMOOTH, WholeAngle};

impl Model {
    /// The path (m) of element `j` (from 0) where it rests against the outer raceway without force, with element 1 at
    /// `cage_angle` (rad) and all else as at the start.
    pub fn resting_path(&self, j: usize, cage_angle: f64) -> f64 {
        let angle = self.element_angle(j, WholeAngle::in_first_turn(cage_angle));
        let cell = self.outer.defects.cell_at(angle);
        self.touching_path(j, [cell, SMOOTH], angle, &Frames::default(), &mut Shortcuts::default())
    }

    /// How much farther (m) element `j` (from 0) comes inwards than on the smooth inner raceway before it touches a
    /// defect of that, with element 1 at `cage_angle` and the inner ring at `shaft_angle` (rad), rings concentric.
    pub fn resting_opening(&self, j: usize, cage_angle: f64, shaft_angle: f64) -> f64 {
        let mut frames = Frames::default();
        frames.0[Frame::Shaft as usize].angle = shaft_angle;
        let direction = self.element_angle(j, WholeAngle::in_first_turn(cage_angle));
        let cell = self.inner.defects.cell_at(direction - shaft_angle);
        if cell == SMOOTH {
            return 0.0;
        }
        let distance = self.centre_radius(j) - (self.radial_clearance - self.larger(j));
        let mut at = Meeting { element: j, cells: [cell, SMOOTH], u: 0.0, direction, distance, curved: true };
        let shortcuts = &mut Shortcuts::default();
        for _ in 0..20 {
            let near = self.near_or_unsolved(RacewaySide::Inner, &at, &frames, shortcuts).approach;
            let step = near.value / near.by_path;
            (at.u, at.distance) = (at.u - step, at.distance + step);
            if step.abs() < 1e-15 {
                break;
            }
        }
        at.u
    }
}
