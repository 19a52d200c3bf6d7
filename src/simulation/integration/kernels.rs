//! What runs in wide registers within a step: all stages of a trial, and a probe of the step tried last.

use super::progress::Progress;
use super::workspace::{Problem, Span, Workspace};
use crate::dynamics::contacts::{Forces, RingForces};
use crate::dynamics::derivatives::Jacobian;
use crate::dynamics::motion::{Between, Known};
use crate::dynamics::parameters::{CageState, Excitation, Model, Stage};
use crate::numerics::lanes::{Kernel, Wide, dispatch};
use crate::simulation::integration::methods::{
    ExplicitMethod, LAST, RightHandSide, StageBuffers, dormand_prince, largest_error, rodas,
};

/// Tries one step with the method that is chosen, and leaves what error control asks of it.
pub(super) fn try_step(workspace: &mut Workspace, problem: Problem, span: Span, progress: &Progress) {
    if progress.choice.implicit {
        workspace.linearize(problem, span.from, progress);
        workspace.jacobian.factor(1.0 / (rodas::GAMMA * span.length));
    }
    dispatch(Trial { workspace, problem, span, progress });
}

/// Leaves the state at a share of the step tried last in `dense`, its derivative in `scratch`, and all forces there.
pub(super) fn probe(workspace: &mut Workspace, problem: Problem, span: Span, share: f64, progress: &Progress) {
    dispatch(Probe { workspace, problem, span, share, progress });
}

/// A step, all stages.
struct Trial<'a> {
    workspace: &'a mut Workspace,
    problem: Problem<'a>,
    span: Span,
    progress: &'a Progress,
}

impl Kernel for Trial<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        let Self { workspace, problem, span, progress } = self;
        if progress.choice.implicit {
            implicit(simd, workspace, problem, span, progress);
        } else {
            explicit(simd, workspace, problem, span, progress);
        }
        let Workspace { buffers, forces, .. } = &mut *workspace;
        forces.settle(problem.model, &mut buffers.end);
        workspace.last_force = workspace.forces.rings;
        workspace.largest_approach = workspace.forces.largest_approach_on(simd);
        workspace.changed = workspace.forces.pushing_differs_on(simd, &progress.pushing);
    }
}

#[inline(always)]
fn explicit<S: Wide>(simd: S, workspace: &mut Workspace, problem: Problem, span: Span, progress: &Progress) {
    match workspace.pair {
        ExplicitMethod::DormandPrince => {
            explicit_step(simd, ExplicitMethod::DormandPrince, workspace, problem, span, progress)
        }
        ExplicitMethod::PhaseFitted => {
            explicit_step(simd, ExplicitMethod::PhaseFitted, workspace, problem, span, progress)
        }
    }
}

/// Inlined for each method of its own.
#[inline(always)]
fn explicit_step<S: Wide>(
    simd: S,
    pair: ExplicitMethod,
    workspace: &mut Workspace,
    problem: Problem,
    span: Span,
    progress: &Progress,
) {
    let (Problem { model, excitation }, Span { from, length: h }) = (problem, span);
    let weights = pair.weights();
    let sum = workspace.first_force.map(|force| weights[0] * force);
    let cages = excitation.cage_after(from, pair.nodes().map(|node| node * h));
    let mut stages = Stages { model, excitation, cages, weights, forces: &mut workspace.forces, sum };
    pair.try_step(simd, &mut workspace.buffers, &progress.state, h, &mut stages);
    workspace.weighted_force = stages.sum;
    workspace.largest_error = largest_error(simd, &workspace.buffers, pair.error_parts(), h, &workspace.weights);
}

#[inline(always)]
fn implicit<S: Wide>(simd: S, workspace: &mut Workspace, problem: Problem, span: Span, progress: &Progress) {
    let (Problem { model, excitation }, Span { from, length: h }) = (problem, span);
    let Workspace { buffers, forces, jacobian, largest_error, weights, .. } = workspace;
    let cages = excitation.cage_after(from, rodas::NODES.map(|node| node * h));
    let mut system = System { model, excitation, cages, forces, jacobian };
    rodas::try_step(simd, buffers, &progress.state, &jacobian.by_time, h, &mut system);
    *largest_error = rodas::largest_error(buffers, weights);
    let StageBuffers { end, last, .. } = buffers;
    let stage = Stage { excitation, cage: &cages[rodas::NODES.len() - 1], state: end, ahead: None };
    model.derivative_on::<S, true>(simd, stage, last, forces);
}

/// The state at a share of the step tried last, its derivative, and each contact there.
struct Probe<'a> {
    workspace: &'a mut Workspace,
    problem: Problem<'a>,
    span: Span,
    share: f64,
    progress: &'a Progress,
}

impl Kernel for Probe<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Wide>(self, simd: S) {
        let Self { workspace, problem, span: Span { from, length: h }, share, progress } = self;
        let Problem { model, excitation } = problem;
        let Workspace { buffers, forces, dense, scratch, pair, .. } = workspace;
        let cage = excitation.cage_at(from + share * h);
        match pair {
            _ if progress.choice.implicit => rodas::dense(simd, buffers, &progress.state, share, dense),
            ExplicitMethod::DormandPrince => dormand_prince::dense(simd, buffers, &progress.state, h, share, dense),
            ExplicitMethod::PhaseFitted => {
                let start =
                    Known { cage: excitation.cage_at(from), state: &progress.state, derivative: &buffers.first };
                let end = Known { cage: excitation.cage_at(from + h), state: &buffers.end, derivative: &buffers.last };
                let pieces = &mut forces.shortcuts.leads;
                let between = Between { length: h, share, cage: &cage };
                model.dense_output(simd, excitation, [start, end], between, pieces, dense);
            }
        }
        let stage = Stage { excitation, cage: &cage, state: dense, ahead: None };
        model.derivative_on::<S, true>(simd, stage, scratch, forces);
        forces.settle(model, dense);
    }
}

/// The equations of motion and their linear systems during one implicit step.
struct System<'a> {
    model: &'a Model,
    excitation: &'a Excitation,
    cages: [CageState; 8],
    forces: &'a mut Forces,
    jacobian: &'a Jacobian,
}

impl rodas::System for System<'_> {
    #[inline(always)]
    fn evaluate<S: Wide>(&mut self, simd: S, stage: usize, state: &[f64], out: &mut [f64]) {
        let stage = Stage { excitation: self.excitation, cage: &self.cages[stage], state, ahead: None };
        self.model.derivative_on::<S, false>(simd, stage, out, self.forces);
    }

    fn solve(&self, b: &mut [f64]) {
        self.jacobian.solve(b);
    }
}

/// The equations of motion during one explicit step, and what the stages add up to.
struct Stages<'a> {
    model: &'a Model,
    excitation: &'a Excitation,
    /// Those of the first stages; the last two are at the same time.
    cages: [CageState; LAST],
    /// Weights of the stages.
    weights: [f64; LAST],
    forces: &'a mut Forces,
    /// Sum of weight × ring force.
    sum: RingForces,
}

impl RightHandSide for Stages<'_> {
    #[inline(always)]
    fn evaluate<S: Wide>(&mut self, simd: S, stage: usize, state: &[f64], ahead: Option<f64>, out: &mut [f64]) {
        let (model, forces) = (self.model, &mut *self.forces);
        let (excitation, cage) = (self.excitation, &self.cages[stage.min(LAST - 1)]);
        let at = Stage { excitation, cage, state, ahead };
        if stage == LAST {
            return model.derivative_on::<S, true>(simd, at, out, forces);
        }
        model.derivative_on::<S, false>(simd, at, out, forces);
        for (sum, force) in self.sum.iter_mut().zip(&forces.rings) {
            *sum += self.weights[stage] * force;
        }
    }
}
