//! What runs in wide registers within a step: all stages of a trial, and a look into the step tried last.

use super::arrow::Arrow;
use super::dormand_prince::{self, RightHandSide};
use super::progress::Progress;
use super::rodas;
use super::stepper::{Stepper, ring_forces};
use crate::dynamics::drive::{Clock, Drive};
use crate::dynamics::forces::Forces;
use crate::dynamics::jacobian::Jacobian;
use crate::dynamics::model::Model;
use crate::numerics::lanes::{Kernel, Wide};

/// One step of length `h` from `from` with the method that is chosen, all stages, and what error control asks of it.
pub(super) struct Trial<'a> {
    pub(super) stepper: &'a mut Stepper,
    pub(super) model: &'a Model,
    pub(super) drive: &'a Drive,
    pub(super) from: f64,
    pub(super) h: f64,
    pub(super) progress: &'a Progress,
}

impl Kernel for Trial<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        let Self { stepper, model, drive, from, h, progress } = self;
        if progress.choice.implicit {
            implicit(simd, stepper, (model, drive), (from, h), progress);
        } else {
            explicit(simd, stepper, (model, drive), (from, h), progress);
        }
        stepper.last_force = ring_forces(&stepper.forces);
        stepper.largest_approach = stepper.forces.largest_approach_on(simd);
        stepper.changed = stepper.forces.pushing_differs_on(simd, &progress.pushing);
    }
}

#[inline(always)]
fn explicit<S: Wide>(
    simd: S,
    stepper: &mut Stepper,
    (model, drive): (&Model, &Drive),
    (from, h): (f64, f64),
    progress: &Progress,
) {
    let sum = stepper.first_force.map(|force| dormand_prince::STAGES[dormand_prince::LAST][0] * force);
    let nodes: [f64; dormand_prince::LAST] = std::array::from_fn(|i| dormand_prince::NODES[i] * h);
    let mut stages = Stages { model, drive, clocks: drive.clocks(from, nodes), forces: &mut stepper.forces, sum };
    stepper.explicit.try_step(simd, &progress.state, h, &mut stages);
    stepper.weighted_force = stages.sum;
    stepper.largest_error = stepper.explicit.error(simd, h, &stepper.weights);
}

#[inline(always)]
fn implicit<S: Wide>(
    simd: S,
    stepper: &mut Stepper,
    (model, drive): (&Model, &Drive),
    (from, h): (f64, f64),
    progress: &Progress,
) {
    let Stepper { explicit, implicit, forces, jacobian, arrow, by_time, largest_error, weights, .. } = stepper;
    let [first, .., last] = &mut explicit.stages;
    let clocks = drive.clocks(from, rodas::NODES.map(|node| node * h));
    let mut system = System { model, drive, clocks, forces, jacobian, arrow };
    implicit.try_step(simd, &progress.state, (first, by_time), h, &mut system);
    *largest_error = implicit.largest_error(weights);
    let at = (drive, &clocks[rodas::NODES.len() - 1]);
    model.derivative_on::<S, true>(simd, at, &implicit.end, last, forces);
}

/// The state at a share of the step tried last, its derivative, and each contact there.
pub(super) struct Look<'a> {
    pub(super) stepper: &'a mut Stepper,
    pub(super) model: &'a Model,
    pub(super) drive: &'a Drive,
    pub(super) from: f64,
    pub(super) h: f64,
    pub(super) share: f64,
    pub(super) progress: &'a Progress,
}

impl Kernel for Look<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        let Self { stepper, model, drive, from, h, share, progress } = self;
        let Stepper { explicit, implicit, forces, dense, scratch, .. } = stepper;
        if progress.choice.implicit {
            implicit.dense(simd, &progress.state, share, dense);
        } else {
            explicit.dense(simd, &progress.state, h, share, dense);
        }
        let clock = drive.clock(from + share * h);
        model.derivative_on::<S, true>(simd, (drive, &clock), dense, scratch, forces);
    }
}

/// The equations of motion and their linear systems during one implicit step.
struct System<'a> {
    model: &'a Model,
    drive: &'a Drive,
    clocks: [Clock; 8],
    forces: &'a mut Forces,
    jacobian: &'a Jacobian,
    arrow: &'a Arrow,
}

impl rodas::System for System<'_> {
    #[inline(always)]
    fn evaluate<S: Wide>(&mut self, simd: S, stage: usize, state: &[f64], out: &mut [f64]) {
        let at = (self.drive, &self.clocks[stage]);
        self.model.derivative_on::<S, false>(simd, at, state, out, self.forces);
    }

    fn solve(&self, b: &mut [f64]) {
        self.arrow.solve(self.jacobian, b);
    }
}

/// The equations of motion during one explicit step, and what the stages add up to.
struct Stages<'a> {
    model: &'a Model,
    drive: &'a Drive,
    /// Those of the first five stages; the last two are at the same time.
    clocks: [Clock; dormand_prince::LAST],
    forces: &'a mut Forces,
    /// Sum of weight × ring force.
    sum: [f64; 4],
}

impl RightHandSide for Stages<'_> {
    #[inline(always)]
    fn evaluate<S: Wide>(&mut self, simd: S, stage: usize, state: &[f64], out: &mut [f64]) {
        let at = (self.drive, &self.clocks[stage.min(dormand_prince::LAST - 1)]);
        let forces = &mut *self.forces;
        if stage == dormand_prince::LAST {
            return self.model.derivative_on::<S, true>(simd, at, state, out, forces);
        }
        self.model.derivative_on::<S, false>(simd, at, state, out, forces);
        for (sum, force) in self.sum.iter_mut().zip(ring_forces(forces)) {
            *sum += dormand_prince::STAGES[dormand_prince::LAST][stage] * force;
        }
    }
}
