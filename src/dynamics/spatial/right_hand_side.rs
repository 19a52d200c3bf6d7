//! The right-hand side in space: balls with radial and axial motion, rings with their five coordinates, sensors.

use crate::dynamics::contacts::Forces;
use crate::dynamics::parameters::{
    COORDINATES, Layout, Model, RINGS, RingInSpace, SMOOTH, SPATIAL_BODIES, Space, Stage, force_slot,
};
use crate::numerics::lanes::Wide;

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
            let kept = (&forces.elements[..], &mut forces.contacts);
            flat(self.smooth_balls::<S, RECORD>(simd, space, &rings, stage, derivative, kept))
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
            let ball = at.ball(self, [moved[0], moved[1], state[w + j], state[w_z + j]]);
            forces.defect_lookups += cells.iter().filter(|cells| **cells != [SMOOTH; 2]).count() as u64;
            let found = self.ball_forces(space, cells, &at, &ball, &mut forces.shortcuts);
            let [f_r, f_t, f_z] = found.force();
            if !(f_r + f_t + f_z).is_finite() {
                self.note_unsolved(cells, &at, &found, forces);
            }
            derivative[w + j] += f_r * self.per_mass_of(j);
            derivative[w_z + j] += f_z * self.per_mass_of(j);
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
}

/// Both rings' coordinates after each other.
fn flat([inner, outer]: [[f64; COORDINATES]; 2]) -> [f64; RINGS] {
    std::array::from_fn(|i| if i < COORDINATES { inner[i] } else { outer[i - COORDINATES] })
}
