//! The right-hand side of a bearing whose elements are in balance at every instant: rings and sensors move, elements
//! are where rings and time say.
//!
//! Elements on smooth raceways are found side by side (`quasi_static::balance_lanes`), those with a
//! contact near a defect, or on a raceway that yields, one by one (`quasi_static::element_balance`).

use crate::dynamics::contacts::{BodyTorque, ContactForces, FirstOrder, Forces, Linearized, Record};
use crate::dynamics::parameters::{FramedKinematics, Kinematics, Model, PathMotion, SMOOTH, Stage, moved};
use crate::dynamics::quasi_static::{InBalance, SmoothElements};
use crate::numerics::lanes::{Lanes, Wide, handed_on};
use crate::numerics::plane::Vector;

impl Model {
    /// As [`Model::derivative`] of a bearing whose elements are in balance. The derivative of a path is its rate, that
    /// of a radial velocity 0: from them follows where the next stage's search begins, and nothing else.
    #[inline(always)]
    pub(super) fn balanced_derivative<S: Wide, const RECORD: bool>(
        &self,
        simd: S,
        stage: &Stage,
        derivative: &mut [f64],
        forces: &mut Forces,
    ) {
        let Stage { excitation, cage, .. } = *stage;
        let now = self.kinematics_of(stage);
        derivative[self.layout.radial_velocity..2 * self.layout.radial_velocity].fill(0.0);
        let smooth = SmoothElements::<RECORD> { model: self, now: &handed_on(&now), stage, derivative, forces };
        let mut rings = simd.outlined(smooth);
        if !forces.searched.is_empty() {
            if self.has_frames {
                forces.frames = excitation.frames_at(cage.tau);
            }
            let found = self.searched_elements::<RECORD>(&now, stage, derivative, forces);
            rings.iter_mut().zip(found).for_each(|(sum, force)| *sum += force);
        }
        Lanes::of(simd, rings).store(&mut forces.rings, 0);
        self.body_rates(simd, stage, &now, rings, derivative);
    }

    /// The elements whose balance is looked for one by one; gives their force on the inner and on the outer ring.
    #[inline(never)]
    fn searched_elements<const RECORD: bool>(
        &self,
        now: &Kinematics,
        stage: &Stage,
        derivative: &mut [f64],
        forces: &mut Forces,
    ) -> [f64; 4] {
        let now =
            FramedKinematics { motion: *now, turns: stage.excitation.cage_turns, frames: forces.frames, films: None };
        let mut rings = [Vector::zeros(); 2];
        if RECORD {
            forces.torques = [0.0; 3];
        }
        for i in 0..forces.searched.len() {
            let (j, cells) = (forces.searched[i].element, forces.searched[i].cells);
            let at = self.element_motion(j, PathMotion::at_rest(0.0), &now, &mut forces.shortcuts);
            let along = now.housing.velocity.dot(&at.e_r);
            let guess = moved(stage.state[j], stage.state[self.layout.radial_velocity + j] - along, stage.ahead);
            let found = self.in_balance(cells, guess, &at, &mut forces.shortcuts);
            forces.defect_lookups +=
                found.evaluations * cells.iter().filter(|cells| **cells != [SMOOTH; 2]).count() as u64;
            if !found.is_found()
                && let Some(unsolved) = self.contact_without_answer(j, cells, found.path, &now, &mut forces.shortcuts)
            {
                forces.unsolved = Some(unsolved);
            }
            let exerted = found.element();
            for (sum, force) in rings.iter_mut().zip(exerted.on_rings()) {
                *sum += force;
            }
            derivative[j] = found.path_rate;
            if RECORD {
                for BodyTorque { frame, torque } in exerted.torques() {
                    forces.torques[frame as usize] += torque;
                }
                self.record_balanced(j, &found, along, &mut forces.contacts);
            }
        }
        let [shaft, housing] = rings;
        [shaft.x, shaft.y, housing.x, housing.y]
    }

    /// Keeps an element's contacts; `along` is the outer ring's velocity in its radial direction (m/s).
    fn record_balanced(&self, j: usize, found: &InBalance, along: f64, record: &mut Record) {
        let Linearized {
            n,
            inner: FirstOrder { approach: inside, .. },
            outer: FirstOrder { approach: outside, .. },
            ..
        } = found.elastic;
        let ContactForces { inner: on_inner, outer: on_outer } = found.forces;
        let (inner, outer, laws) = (on_inner.norm(), on_outer.norm(), self.own_contacts(j));
        let direction = if inner > 0.0 { on_inner / inner } else { n.into() };
        for (list, value) in [
            (&mut record.inner, inner),
            (&mut record.normal_radial, direction.x),
            (&mut record.normal_tangential, direction.y),
            (&mut record.outer, outer),
            (&mut record.outer_radial, on_outer.x),
            (&mut record.outer_tangential, on_outer.y),
            (&mut record.inner_approach, inside),
            (&mut record.outer_approach, outside),
            (&mut record.inner_pushing, laws[0].pushing(inside, 0.0)),
            (&mut record.outer_pushing, laws[1].pushing(outside, 0.0)),
            (&mut record.path_rate, found.path_rate),
        ] {
            list[j] = value;
        }
        (record.balanced[0][j], record.balanced[1][j]) = (found.path, found.path_rate + along);
    }
}
