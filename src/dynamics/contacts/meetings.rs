//! Where elements meet the two raceways, and in which cells of their defects.

use super::kernel::{InnerGap, Meeting};
use crate::contact::rolling::RacewaySide;
use crate::dynamics::parameters::{
    CageState, Cells, Defects, Excitation, Frame, FramedKinematics, Frames, Kinematics, Model, SMOOTH,
};
use crate::numerics::plane::{Vector, turned};

impl Model {
    /// Where an element at path `u` in direction `e_r` is seen from the inner ring, whose centre is `offset` before the
    /// outer ring's, with this `clearance` between the raceways.
    #[inline]
    pub(in crate::dynamics) fn inner_gap(&self, u: f64, offset: Vector, e_r: Vector, clearance: f64) -> InnerGap<f64> {
        let offset = [offset.dot(&e_r), offset.dot(&turned(e_r))];
        InnerGap::of(self.outer_centre_radius + u, u, offset, clearance, false)
    }

    /// Direction φ (rad) of element `j` at path `u` from the inner ring's centre.
    pub fn inner_direction_of(&self, j: usize, u: f64, now: &Kinematics) -> f64 {
        self.element_angle(j, &now.cage) + self.inner_lead(j, u, now)
    }

    /// What that direction is ahead of the element's angle θ about the outer ring's centre (rad).
    pub fn inner_lead(&self, j: usize, u: f64, now: &Kinematics) -> f64 {
        // The direction alone, of which the clearance is no part.
        self.inner_gap(u, now.offset(), self.direction(j, &now.cage), self.radial_clearance).lead()
    }

    /// Element `j` at path `u` where it meets the outer raceway.
    #[inline]
    pub(in crate::dynamics) fn outer_meeting(&self, j: usize, cells: [u32; 2], u: f64, cage: &CageState) -> Meeting {
        self.outer_meeting_at(self.element_angle(j, cage), j, cells, u)
    }

    /// As [`Self::outer_meeting`], for an element at this `angle` (rad).
    #[inline(always)]
    pub(super) fn outer_meeting_at(&self, angle: f64, j: usize, cells: [u32; 2], u: f64) -> Meeting {
        Meeting { element: j, cells, u, direction: angle, distance: self.outer_centre_radius + u, curved: true }
    }

    /// Element `j` at this angle (rad) and with this gap where it meets the inner raceway.
    #[inline]
    pub(in crate::dynamics) fn inner_meeting(
        &self,
        j: usize,
        cells: [u32; 2],
        gap: &InnerGap<f64>,
        angle: f64,
    ) -> Meeting {
        let (u, direction, distance) = (gap.approach, angle + gap.lead(), gap.distance);
        Meeting { element: j, cells, u, direction, distance, curved: true }
    }

    /// Angle (rad) of a contact from the centre of the defect that it is at, or else of the raceway's nearest.
    pub(in crate::dynamics) fn angle_from_defect(&self, side: RacewaySide, at: &Meeting, frames: &Frames) -> f64 {
        let own = self.defective.iter().find(|defective| defective.element == at.element && at.cells[1] != SMOOTH);
        let defects = own.map_or(&self.raceway(side).defects, |defective| &defective.defects[side as usize]);
        defects.angle(at.direction - frames.of(defects.frame).angle)
    }

    /// Cells of the contacts of element `j` with the inner and with the outer raceway: of the raceway, then its own.
    pub(in crate::dynamics) fn cells_of(&self, cells: &Cells, j: usize) -> [[u32; 2]; 2] {
        let own = self.defective.iter().position(|defective| defective.element == j);
        let own = own.map_or([SMOOTH; 2], |k| cells.own[k]);
        [[cells.inner[j], own[0]], [cells.outer[j], own[1]]]
    }

    /// Cells of all contacts at `tau` for a state.
    pub fn cells_at(&self, excitation: &Excitation, tau: f64, state: &[f64]) -> Cells {
        let (now, mut cells) =
            (self.kinematics(excitation, tau, state), Cells::smooth(self.element_count, self.defective.len()));
        for j in 0..self.element_count {
            let theta = self.element_angle(j, &now.cage);
            let directions = [self.inner_direction_of(j, state[j], &now), theta];
            let cell =
                |defects: &Defects, direction: f64| defects.cell_at(direction - now.frames.of(defects.frame).angle);
            cells.inner[j] = cell(&self.inner.defects, directions[0]);
            cells.outer[j] = cell(&self.outer.defects, directions[1]);
            for (k, defective) in self.defective.iter().enumerate().filter(|(_, own)| own.element == j) {
                cells.own[k] = [0, 1].map(|side| cell(&defective.defects[side], directions[side]));
            }
        }
        cells
    }

    /// Over a defect the path (m) of an element without force is where the approach vanishes.
    pub(in crate::dynamics) fn touching_path(&self, j: usize, cells: [u32; 2], angle: f64, frames: &Frames) -> f64 {
        let mut u = 0.0;
        for _ in 0..20 {
            let meeting = self.outer_meeting_at(angle, j, cells, u);
            let near = self.near_or_unsolved(RacewaySide::Outer, &meeting, frames).approach;
            let step = near.value / near.by_path;
            u -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        u
    }

    /// The path (m) of element `j` (from 0) where it rests against the outer raceway without force, with element 1 at
    /// `cage_angle` (rad) and all else as at the start.
    pub fn resting_path(&self, j: usize, cage_angle: f64) -> f64 {
        let now = FramedKinematics::at_rest(cage_angle, Vector::zeros());
        let cell = self.outer.defects.cell_at(self.element_angle(j, &now.cage));
        self.touching_path(j, [cell, SMOOTH], self.element_angle(j, &now.cage), &now.frames)
    }

    /// How much farther (m) element `j` (from 0) comes inwards than on the smooth inner raceway before it touches a
    /// defect of that, with element 1 at `cage_angle` and the inner ring at `shaft_angle` (rad), rings concentric.
    pub fn resting_opening(&self, j: usize, cage_angle: f64, shaft_angle: f64) -> f64 {
        let mut now = FramedKinematics::at_rest(cage_angle, Vector::zeros());
        now.frames.0[Frame::Shaft as usize].angle = shaft_angle;
        let direction = self.element_angle(j, &now.cage);
        let cell = self.inner.defects.cell_at(direction - shaft_angle);
        if cell == SMOOTH {
            return 0.0;
        }
        let distance = self.outer_centre_radius - self.radial_clearance;
        let mut at = Meeting { element: j, cells: [cell, SMOOTH], u: 0.0, direction, distance, curved: true };
        for _ in 0..20 {
            let near = self.near_or_unsolved(RacewaySide::Inner, &at, &now.frames).approach;
            let step = near.value / near.by_path;
            (at.u, at.distance) = (at.u - step, at.distance + step);
            if step.abs() < 1e-15 {
                break;
            }
        }
        at.u
    }
}
