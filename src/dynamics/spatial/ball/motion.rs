//! Balls as an instant has them, and what is kept of their contacts.

use super::contacts::{BallForces, BallMotion, place_of};
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{Forces, Record, Shortcuts, UnsolvedContact};
use crate::dynamics::element::{Touch, views};
use crate::dynamics::parameters::{FramedKinematics, Model, RingInSpace, SMOOTH, Stage};
use crate::numerics::lanes::WIDEST;
use crate::numerics::plane::turned_by;

impl Model {
    /// Ball `j` where it is within a step's kernels, and its acceleration about the outer ring's centre (rad/s²).
    #[inline(always)]
    pub(in crate::dynamics::spatial) fn ball_within(
        &self,
        j: usize,
        stage: &Stage,
        rings: &[RingInSpace; 2],
        forces: &Forces,
    ) -> (BallMotion, f64) {
        let (block, i, cage) = (&forces.elements[j / WIDEST], j % WIDEST, stage.cage);
        let [omega, alpha] = block.turning(i, cage);
        let at = BallMotion {
            element: j,
            e_r: turned_by(cage.direction, block.sin[i], block.cos[i]).into(),
            angle: cage.angle + self.element_offset(j) + block.lead[i],
            omega,
            rings: *rings,
            frames: forces.frames,
            curved: true,
            tried: false,
        };
        (at, alpha)
    }

    /// Ball `j` at an instant, all else as `now` says, and its acceleration about the outer ring's centre (rad/s²).
    pub(in crate::dynamics) fn ball_motion(
        &self,
        j: usize,
        now: &FramedKinematics,
        rings: &[RingInSpace; 2],
        shortcuts: &mut Shortcuts,
    ) -> (BallMotion, f64) {
        let lead = self.lead_with(j, now.cage_angle(), &mut shortcuts.leads);
        let [omega, alpha] = lead.speed(&now.cage);
        let at = BallMotion {
            element: j,
            e_r: self.direction_with(j, &now.cage, &lead).into(),
            angle: now.cage.angle + self.element_offset(j) + lead.angle,
            omega,
            rings: *rings,
            frames: now.frames,
            curved: true,
            tried: false,
        };
        (at, alpha)
    }

    /// Keeps why a contact near a defect has no answer, if it is the cause.
    #[cold]
    pub(in crate::dynamics::spatial) fn note_unsolved(
        &self,
        cells: [[u32; 2]; 2],
        at: &BallMotion,
        found: &BallForces,
        forces: &mut Forces,
    ) {
        if let Some(unsolved) = self.unsolved_contact(cells, at, found, &mut forces.shortcuts) {
            forces.unsolved = Some(unsolved);
        }
    }

    /// The contact of a ball near a defect that has no answer there; the outer one of two.
    #[cold]
    pub(in crate::dynamics) fn unsolved_contact(
        &self,
        cells: [[u32; 2]; 2],
        at: &BallMotion,
        found: &BallForces,
        shortcuts: &mut Shortcuts,
    ) -> Option<UnsolvedContact> {
        let space = self.space.as_ref()?;
        let mut unsolved = None;
        for side in [RacewaySide::Inner, RacewaySide::Outer] {
            let cells = cells[side as usize];
            let (place, _) = place_of(side, cells, at.angle, &views(&at.rings)[side as usize], &found.ball);
            let touch = Touch::of(&space.grooves[side as usize], &place.at);
            let meeting = self.ball_meeting(cells, at, &place, touch.approach);
            if cells == [SMOOTH; 2] || !(meeting.u + at.angle).is_finite() {
                continue;
            }
            if let Err(cause) = self.near_ball(side, space, &meeting, touch.normal, &at.frames, shortcuts) {
                let angle = self.angle_from_defect(side, &meeting, &at.frames);
                let [inner, outer] = &at.rings;
                let offset = [0, 1].map(|k| outer.position[k] - inner.position[k]);
                unsolved = Some(UnsolvedContact { element: at.element, angle, offset, cause });
            }
        }
        unsolved
    }
}

impl BallForces {
    /// Keeps the contacts of ball `j`, which they push with `around` (N) along e_t.
    pub(in crate::dynamics::spatial) fn keep(&self, model: &Model, j: usize, around: f64, record: &mut Record) {
        let [inner, outer] = &self.contacts;
        let pushing = |side: usize| {
            let contact = &self.contacts[side];
            [&model.inner, &model.outer][side].contact.law.pushing(contact.approach, contact.rate)
        };
        (record.inner[j], record.outer[j], record.outer_tangential[j]) = (inner.magnitude, outer.magnitude, around);
        (record.inner_approach[j], record.outer_approach[j]) = (inner.approach, outer.approach);
        (record.inner_pushing[j], record.outer_pushing[j]) = (pushing(0), pushing(1));
        record.path_rate[j] = self.ball.rate[0];
        for side in 0..2 {
            let [along_e, along_a] = self.contacts[side].normal;
            (record.meridians[2 * side][j], record.meridians[2 * side + 1][j]) = (along_e, along_a);
        }
    }
}
