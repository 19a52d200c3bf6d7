//! The right-hand side in space: balls with radial and axial motion, rings with their five coordinates, sensors.

use super::ball_contacts::{BallForces, BallMotion};
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{Forces, Record, UnsolvedContact};
use crate::dynamics::parameters::{
    COORDINATES, FramedKinematics, Layout, Model, RINGS, RingInSpace, SMOOTH, SPATIAL_BODIES, Space,
    Stage, force_slot,
};
use crate::numerics::lanes::{WIDEST, Wide};
use crate::numerics::plane::turned_by;

impl Model {
    /// As [`Model::derivative_on`] of rings in space.
    #[inline(always)]
    pub(in crate::dynamics) fn spatial_derivative<S: Wide, const RECORD: bool>(
        &self,
        simd: S,
        space: &Space,
        stage: &Stage,
        derivative: &mut [f64],
        forces: &mut Forces,
    ) {
        let Stage { excitation, cage, state, ahead } = *stage;
        let angle = excitation.cage_angle_of(cage);
        forces.cage_lead = self.update_uneven(angle, &mut forces.elements, &mut forces.shortcuts.leads);
        let rings = self.rings_in_space(excitation, cage.tau, state, ahead);
        if RECORD {
            forces.torques = [0.0; 3];
        }
        let mut sums = if self.elements_in_balance() {
            self.balls_in_balance::<RECORD>(space, &rings, stage, derivative, forces)
        } else {
            let (elements, contacts) = (&forces.elements, &mut forces.contacts);
            self.smooth_balls::<S, RECORD>(simd, space, &rings, stage, derivative, elements, contacts)
        };
        if !forces.searched.is_empty() && !self.elements_in_balance() {
            forces.frames = excitation.frames_at(cage.tau);
            self.balls_near_defects::<RECORD>(space, &rings, stage, derivative, (forces, &mut sums));
        }
        for (i, force) in sums.into_iter().enumerate() {
            forces.rings[force_slot(i / COORDINATES, i % COORDINATES)] = force;
        }
        self.spatial_bodies(space, stage, &rings, &sums, derivative);
    }

    /// Ball `j` where it is within a step's kernels, and its acceleration about the outer ring's centre (rad/s²).
    #[inline(always)]
    pub(super) fn ball_within(
        &self,
        j: usize,
        stage: &Stage,
        rings: &[RingInSpace; 2],
        forces: &Forces,
    ) -> (BallMotion, f64) {
        let (block, i, cage) = (&forces.elements[j / WIDEST], j % WIDEST, stage.cage);
        let alpha = cage.acceleration * block.pace[i] + cage.speed * cage.speed * block.pace_by_angle[i];
        let at = BallMotion {
            element: j,
            e_r: turned_by(cage.direction, block.sin[i], block.cos[i]).into(),
            angle: cage.angle + self.element_offset(j) + block.lead[i],
            omega: cage.speed * block.pace[i],
            rings: *rings,
            frames: forces.frames,
            curved: true,
        };
        (at, alpha)
    }

    /// Balls of which a contact is near a defect, one by one, after all others.
    #[inline(never)]
    fn balls_near_defects<const RECORD: bool>(
        &self,
        space: &Space,
        rings: &[RingInSpace; 2],
        stage: &Stage,
        derivative: &mut [f64],
        (forces, sums): (&mut Forces, &mut [f64; RINGS]),
    ) {
        let Some([v, w_z]) = self.layout.axial() else { return };
        let (w, state) = (self.layout.radial_velocity, stage.state);
        for i in 0..forces.searched.len() {
            let (j, cells) = (forces.searched[i].element, forces.searched[i].cells);
            let (at, _) = self.ball_within(j, stage, rings, forces);
            let ahead = stage.ahead.unwrap_or(0.0);
            let moved = [state[j] + ahead * derivative[j], state[v + j] + ahead * derivative[v + j]];
            let ball = at.ball(self, space, [moved[0], moved[1], state[w + j], state[w_z + j]]);
            forces.defect_lookups += cells.iter().filter(|cells| **cells != [SMOOTH; 2]).count() as u64;
            let found = self.ball_forces(space, cells, &at, &ball, &mut forces.shortcuts);
            let [f_r, f_t, f_z] = found.force();
            if !(f_r + f_t + f_z).is_finite() {
                self.note_unsolved(cells, &at, &found, forces);
            }
            derivative[w + j] += f_r * self.inverse_element_mass;
            derivative[w_z + j] += f_z * self.inverse_element_mass;
            for (sum, force) in sums.iter_mut().zip(found.on_rings().as_flattened()) {
                *sum += force;
            }
            if RECORD {
                for (frame, torque) in found.torques() {
                    forces.torques[frame as usize] += torque;
                }
                found.keep(self, j, f_t, &mut forces.contacts);
            }
        }
    }

    /// Keeps why a contact near a defect has no answer, if it is the cause.
    #[cold]
    pub(super) fn note_unsolved(
        &self,
        cells: [[u32; 2]; 2],
        at: &BallMotion,
        found: &BallForces,
        forces: &mut Forces,
    ) {
        for side in [RacewaySide::Inner, RacewaySide::Outer] {
            let meeting = self.ball_meeting(side, cells[side as usize], at, &found.ball);
            if cells[side as usize] == [SMOOTH; 2] || !(meeting.u + at.angle).is_finite() {
                continue;
            }
            if let Err(cause) = self.near(side, &meeting, &at.frames, &mut forces.shortcuts) {
                let angle = self.angle_from_defect(side, &meeting, &at.frames);
                let [inner, outer] = &at.rings;
                let offset = [0, 1].map(|k| outer.position[k] - inner.position[k]);
                forces.unsolved = Some(UnsolvedContact { element: at.element, angle, offset, cause });
            }
        }
    }

    /// Rings and sensors under the `contacts` on both rings.
    #[inline(always)]
    fn spatial_bodies(
        &self,
        space: &Space,
        stage: &Stage,
        rings: &[RingInSpace; 2],
        contacts: &[f64; RINGS],
        derivative: &mut [f64],
    ) {
        let Stage { excitation, cage, state, ahead } = *stage;
        let (mut x, mut v) = ([0.0; SPATIAL_BODIES], [0.0; SPATIAL_BODIES]);
        for (ring, at) in rings.iter().enumerate() {
            x[COORDINATES * ring..][..COORDINATES].copy_from_slice(&at.position);
            v[COORDINATES * ring..][..COORDINATES].copy_from_slice(&at.velocity);
        }
        for (k, i) in self.layout.sensor_indices().enumerate() {
            (x[RINGS + k], v[RINGS + k]) = (state[i] + ahead.unwrap_or(0.0) * state[i + 1], state[i + 1]);
        }
        let [loads, _] = excitation.loads_in_space(cage.tau);
        let mut acting = [0.0; RINGS];
        for (i, acting) in acting.iter_mut().enumerate() {
            *acting = loads[i] + contacts[i];
        }
        for (ring, preload) in space.preload.into_iter().enumerate() {
            acting[COORDINATES * ring + 2] += preload;
        }
        let accelerations = space.accelerations(&x, &v, &acting, excitation.ring_speeds(cage.tau)[0]);
        for (ring, start) in [self.layout.shaft, self.layout.housing].into_iter().enumerate() {
            let Some(start) = start else { continue };
            for k in 0..COORDINATES {
                derivative[start + Layout::POSITIONS[k]] = v[COORDINATES * ring + k];
                derivative[start + Layout::VELOCITIES[k]] = accelerations[COORDINATES * ring + k];
            }
        }
        for (k, i) in self.layout.sensor_indices().enumerate() {
            (derivative[i], derivative[i + 1]) = (v[RINGS + k], accelerations[RINGS + k]);
        }
    }

    /// Ball `j` at an instant, all else as `now` says.
    pub(in crate::dynamics) fn ball_motion(
        &self,
        j: usize,
        now: &FramedKinematics,
        rings: &[RingInSpace; 2],
        shortcuts: &mut crate::dynamics::contacts::Shortcuts,
    ) -> BallMotion {
        let lead = self.lead_with(j, now.cage_angle(), &mut shortcuts.leads);
        BallMotion {
            element: j,
            e_r: self.direction_with(j, &now.cage, &lead).into(),
            angle: now.cage.angle + self.element_offset(j) + lead.angle,
            omega: lead.speed(&now.cage)[0],
            rings: *rings,
            frames: now.frames,
            curved: true,
        }
    }
}

impl BallForces {
    /// Keeps the contacts of ball `j`, which they push with `around` (N) along e_t.
    pub(super) fn keep(&self, model: &Model, j: usize, around: f64, record: &mut Record) {
        let [inner, outer] = &self.contacts;
        let pushing = |side: usize| {
            let contact = &self.contacts[side];
            [&model.inner, &model.outer][side].contact.law.pushing(contact.approach, contact.rate)
        };
        (record.inner[j], record.outer[j], record.outer_tangential[j]) = (inner.magnitude, outer.magnitude, around);
        (record.inner_approach[j], record.outer_approach[j]) = (inner.approach, outer.approach);
        (record.inner_pushing[j], record.outer_pushing[j]) = (pushing(0), pushing(1));
        record.path_rate[j] = self.ball.rates[0];
        for side in 0..2 {
            let [along_e, along_a] = self.ball.places[side].contact.meridian;
            (record.meridians[2 * side][j], record.meridians[2 * side + 1][j]) = (along_e, along_a);
        }
    }
}
