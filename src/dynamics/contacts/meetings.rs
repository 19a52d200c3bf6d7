//! Where elements meet the two raceways, and in which cells of their defects.

use super::kernel::{InnerGap, Meeting};
use super::shortcuts::Shortcuts;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::element::{Element, View, views};
use crate::dynamics::parameters::{Cells, Defects, Excitation, Frames, Kinematics, Lead, Model, SMOOTH};
use crate::numerics::plane::{Vector, parts};

impl Model {
    /// Where element `j` at path `u` in direction `e_r` is seen from the inner ring, whose centre is `offset` before
    /// the outer ring's, with this `clearance` of a nominal element between the raceways.
    #[inline]
    pub(in crate::dynamics) fn inner_gap(
        &self,
        j: usize,
        u: f64,
        offset: Vector,
        e_r: Vector,
        clearance: f64,
    ) -> InnerGap<f64> {
        let offset = parts(offset, e_r);
        InnerGap::of(self.centre_radius(j) + u, u, offset, clearance - self.larger(j), false)
    }

    /// What the direction φ of element `j`, which is `lead` ahead on the cage, at path `u` from the inner ring's centre
    /// is ahead of its angle θ about the outer ring's (rad).
    pub(crate) fn inner_lead(&self, j: usize, u: f64, now: &Kinematics, lead: &Lead) -> f64 {
        // The direction alone, of which the clearance is no part.
        self.inner_gap(j, u, now.offset(), self.direction_with(j, &now.cage, lead), self.radial_clearance).lead()
    }

    /// The same of an element in a state at `tau`, in space too, where the inner ring's axis may be tilted.
    pub(crate) fn seen_from_inside(
        &self,
        j: usize,
        (excitation, tau): (&Excitation, f64),
        state: &[f64],
        now: &Kinematics,
        lead: &Lead,
    ) -> f64 {
        let Some([v, _]) = self.layout.axial() else { return self.inner_lead(j, state[j], now, lead) };
        let [view, _] = views(&self.rings_in_space(excitation, tau, state, None));
        let e_r = self.direction_with(j, &now.cage, lead).into();
        let (at, rho) = ([state[j], state[v + j]], self.outer_centre_radius + state[j]);
        view.see(&Element { e_r, at, rate: [0.0; 2], rho, omega: 0.0 }).1.lead()
    }

    /// Element `j` at this `angle` (rad) and path `u` where it meets the outer raceway.
    #[inline(always)]
    pub(in crate::dynamics) fn outer_meeting(&self, angle: f64, j: usize, cells: [u32; 2], u: f64) -> Meeting {
        Meeting { element: j, cells, u, direction: angle, distance: self.centre_radius(j) + u, curved: true }
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
        let own = own
            .map_or([SMOOTH; 2], |k| [0, 1].map(|side: usize| self.defective[k].defects[side].met(cells.own[k][side])));
        [[self.inner.defects.met(cells.inner[j]), own[0]], [self.outer.defects.met(cells.outer[j]), own[1]]]
    }

    /// Cells of all contacts at `tau` for a state.
    pub fn cells_at(&self, excitation: &Excitation, tau: f64, state: &[f64]) -> Cells {
        let (now, mut cells) =
            (self.kinematics(excitation, tau, state), Cells::smooth(self.element_count, self.defective.len()));
        for j in 0..self.element_count {
            let lead = self.lead(j, now.cage_angle());
            let theta = now.cage.angle + self.element_offset(j) + lead.angle;
            let directions = [theta + self.seen_from_inside(j, (excitation, tau), state, &now, &lead), theta];
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
    pub(in crate::dynamics) fn touching_path(
        &self,
        j: usize,
        cells: [u32; 2],
        angle: f64,
        frames: &Frames,
        shortcuts: &mut Shortcuts,
    ) -> f64 {
        let mut u = 0.0;
        for _ in 0..20 {
            let meeting = self.outer_meeting(angle, j, cells, u);
            let near = self.near_or_unsolved(RacewaySide::Outer, &meeting, frames, shortcuts).approach;
            let step = near.value / near.by_path;
            u -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        u
    }
}
