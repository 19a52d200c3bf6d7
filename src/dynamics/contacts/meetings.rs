//! Where an element stands to the two raceways: its gap to the inner one, and its approach to either near a defect.

use crate::contact::error::ContactError;
use crate::contact::near_defect::{Approach, Lever};
use crate::contact::rolling::RacewaySide;
use crate::dynamics::parameters::{
    CageState, Cells, Defects, Excitation, Frame, FramedKinematics, Frames, Kinematics, Model, Near, Raceway, SMOOTH,
};
use crate::numerics::plane::{Vector, turned};

/// How far apart along path and raceway the approach near the defect is sampled for its second derivatives (m).
pub(in crate::dynamics) const DIFFERENCE: f64 = 1e-9;

/// An element seen from the inner ring's centre.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct InnerGap {
    /// δ_i (m)
    pub(in crate::dynamics) approach: f64,
    /// n = q/|q|, radial and tangential.
    pub(in crate::dynamics) n: Vector,
    /// |q| (m)
    pub(in crate::dynamics) distance: f64,
}

/// One contact of an element: where it is and in which cells.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Meeting {
    /// The element, from 0.
    pub(in crate::dynamics) element: usize,
    /// Cell of the raceway, and cell of the element's own defect.
    pub(in crate::dynamics) cells: [u32; 2],
    /// Approach to the smooth raceway (m).
    pub(in crate::dynamics) u: f64,
    /// Direction of the element from the ring's centre (rad).
    pub(in crate::dynamics) direction: f64,
    /// Distance of the element from the ring's centre (m).
    pub(in crate::dynamics) distance: f64,
}

impl InnerGap {
    /// Angle φ − θ (rad) between the element's directions from the inner ring's centre and from the outer's.
    #[inline]
    pub(in crate::dynamics) fn lead(&self) -> f64 {
        libm::atan2(self.n.y, self.n.x)
    }
}

impl Model {
    /// Where an element at path `u` in direction `e_r` is seen from the inner ring, whose centre is `offset` before the
    /// outer ring's, with this `clearance` between the raceways.
    #[inline]
    pub(in crate::dynamics) fn inner_gap(&self, u: f64, offset: Vector, e_r: Vector, clearance: f64) -> InnerGap {
        // |q| = √((ρ+p)² + t²), written so that δ_i loses no digits to the radii's 20 mm.
        let (p, t) = (offset.dot(&e_r), offset.dot(&turned(e_r)));
        let q_r = self.outer_centre_radius + u + p;
        let distance = (q_r * q_r + t * t).sqrt();
        let approach = -clearance - u - p - t * t / (distance + q_r);
        InnerGap { approach, n: Vector::new(q_r / distance, t / distance), distance }
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
        Meeting { element: j, cells, u, direction: angle, distance: self.outer_centre_radius + u }
    }

    /// Element `j` at this angle (rad) and with this gap where it meets the inner raceway.
    #[inline]
    pub(in crate::dynamics) fn inner_meeting(&self, j: usize, cells: [u32; 2], gap: &InnerGap, angle: f64) -> Meeting {
        Meeting { element: j, cells, u: gap.approach, direction: angle + gap.lead(), distance: gap.distance }
    }

    /// Approach of an element in some cell near a defect, its own or the raceway's, of both the one that carries less;
    /// and the frame of the body that bears it.
    ///
    /// Inlined, so that what its caller does not use is not worked out.
    #[inline(always)]
    pub(in crate::dynamics) fn near_defect(
        &self,
        side: RacewaySide,
        at: &Meeting,
        frames: &Frames,
    ) -> (Result<Approach, ContactError>, Frame) {
        if at.cells[1] != SMOOTH {
            return self.near_own_defect(side, at, frames);
        }
        (self.near_ring_defect(side, at, frames), self.raceway(side).0.defects.frame)
    }

    /// As [`Self::near_defect`], of an element in a cell of the raceway's defects and in none of its own.
    #[inline(always)]
    pub(super) fn near_ring_defect(
        &self,
        side: RacewaySide,
        at: &Meeting,
        frames: &Frames,
    ) -> Result<Approach, ContactError> {
        let (raceway, by_approach) = self.raceway(side);
        let lever = Lever { distance: at.distance, by_approach };
        raceway.defects.approach(at.cells[0], at.u, at.direction, frames, lever)
    }

    /// As [`Self::near_defect`], of an element in a cell of its own defect.
    #[inline(never)]
    fn near_own_defect(
        &self,
        side: RacewaySide,
        at: &Meeting,
        frames: &Frames,
    ) -> (Result<Approach, ContactError>, Frame) {
        let [ring, own] = at.cells;
        let (raceway, by_approach) = self.raceway(side);
        let lever = Lever { distance: at.distance, by_approach };
        let defective = self.defective.iter().find(|defective| defective.element == at.element);
        let own = defective.map_or(Ok(Approach::smooth(at.u)), |defective| {
            defective.defects[side as usize].approach(own, at.u, at.direction, frames, lever)
        });
        if ring == SMOOTH {
            return (own, Frame::Spin);
        }
        match (own, self.near_ring_defect(side, at, frames)) {
            (Ok(own), Ok(ring)) if own.value < ring.value => (Ok(own), Frame::Spin),
            (Err(error), _) => (Err(error), Frame::Spin),
            (_, ring) => (ring, raceway.defects.frame),
        }
    }

    /// A raceway, and how an element's distance from the ring's centre changes with its approach.
    #[inline]
    fn raceway(&self, side: RacewaySide) -> (&Raceway, f64) {
        match side {
            RacewaySide::Inner => (&self.inner, -1.0),
            RacewaySide::Outer => (&self.outer, 1.0),
        }
    }

    /// As [`Self::near_defect`], the smooth raceway included.
    pub(in crate::dynamics) fn approach(&self, side: RacewaySide, at: &Meeting, frames: &Frames) -> Near {
        if at.cells == [SMOOTH; 2] {
            return Near::smooth(at.u);
        }
        let (near, frame) = self.near_defect(side, at, frames);
        near.map_or_else(|_| Near::unsolved(), |approach| Near::new(approach, frame, frames))
    }

    /// Change (1/m) of the direction of an inner contact near a defect as its gap narrows and the element stays, along
    /// and across its direction from the ring's centre.
    pub(super) fn direction_by_gap(&self, at: &Meeting, frames: &Frames) -> Vector {
        let direction = |by: f64| {
            let near = self.approach(RacewaySide::Inner, &Meeting { u: at.u + by, ..*at }, frames).approach;
            Vector::new(near.radial, near.tangential)
        };
        (direction(DIFFERENCE) - direction(-DIFFERENCE)) / (2.0 * DIFFERENCE)
    }

    /// Angle (rad) of a contact from the centre of the defect that it is at, or else of the raceway's nearest.
    pub(in crate::dynamics) fn angle_from_defect(&self, side: RacewaySide, at: &Meeting, frames: &Frames) -> f64 {
        let (raceway, _) = self.raceway(side);
        let own = self.defective.iter().find(|defective| defective.element == at.element && at.cells[1] != SMOOTH);
        let defects = own.map_or(&raceway.defects, |defective| &defective.defects[side as usize]);
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

    /// Over a defect the path of an element without force is where the approach vanishes.
    pub(in crate::dynamics) fn touching_path(&self, j: usize, cells: [u32; 2], now: &FramedKinematics) -> f64 {
        let mut u = 0.0;
        for _ in 0..20 {
            let near =
                self.approach(RacewaySide::Outer, &self.outer_meeting(j, cells, u, &now.cage), &now.frames).approach;
            let step = near.value / near.by_path;
            u -= step;
            if step.abs() < 1e-15 {
                break;
            }
        }
        u
    }
}
