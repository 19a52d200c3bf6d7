//! Advances the state by one communication step: error control, and steps that land on what is not smooth.
//!
//! Four kinds of instants end a step exactly: the communication point; a *knot*, where a contact enters another cell of
//! a defect at an instant known beforehand; a *crossing*, where it does so at one that is not; a *contact change*,
//! where a contact begins or ceases to push, at loose tolerances only if the step is too long otherwise. Within a step
//! every element stays in its cell and the right-hand side is smooth, except for the C¹ onset of a contact force.
//!
//! Knots are whole numbers (the cell of each element), never recognised by comparing times, so a restored state
//! continues with the same bits. Contact changes are located on the dense output.
//!
//! Three methods step, one at a time ([`super::switching`]); error control and landing are the same for all.

use super::advance::Advance;
use super::failing::{check_angles, check_rings, check_step, worst};
use super::kernels::{probe, try_step};
use super::progress::Progress;
use super::step_size::{factor_over_change, share_of, step_factor};
use super::switching::Method;
use super::workspace::{Evaluation, Problem, Span, Workspace, step_ends};
use crate::dynamics::parameters::Defects;
use crate::scene::Motion;
use crate::simulation::integration::landing::{Crossing, Knot, Legs, first_change, first_crossing, next_knot};
use crate::simulation::interface::Outputs;
use crate::simulation::recorder::Recorder;
use crate::simulation::step_error::StepError;

/// How exactly, how long and by which method to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Control {
    /// Relative tolerance.
    pub tolerance: f64,
    /// Most integration steps in one communication step, rejected ones included.
    pub max_steps: u64,
    /// Methods that may step.
    pub method: Method,
}

/// Shares of a step: a contact change this close to its start is not landed on, which bounds chatter.
const CLOSEST_CHANGE: f64 = 1e-4;
/// Tolerance from which on a step that error control accepts need not land on a contact change. The estimate sees
/// little of a force that begins within the step, as the power 1.5 of time, and at smaller tolerances that would be the
/// largest error; here it is below those of impacts.
const PASSES_CHANGES: f64 = 1e-3;
/// Share of the wanted step below which a step has been cut short.
const SHORT: f64 = 0.8;
/// Error per tolerance from which on the dense output of a step is too far off to land by.
const BLURRED: f64 = 1e3;
/// Inner nodes of Lobatto's quadrature with four nodes, as shares of a step; exact for polynomials of degree 5.
const LOBATTO: [f64; 2] = [0.276_393_202_250_021_03, 0.723_606_797_749_979];

/// One communication step under way.
#[derive(Debug)]
pub struct Stepper<'a> {
    /// What is integrated.
    pub problem: Problem<'a>,
    /// How.
    pub control: Control,
    /// The right-hand side where the communication step begins, if that has been evaluated.
    pub known: Option<&'a Evaluation>,
    /// Where.
    pub workspace: &'a mut Workspace,
    /// The state that advances.
    pub progress: &'a mut Progress,
    /// Takes its samples on the way.
    pub recorder: Option<&'a mut Recorder>,
}

/// How a step came about.
#[derive(Clone, Copy)]
struct Taken {
    /// Times that it was tried.
    tried: u32,
    /// Something else than error control ended it.
    short: bool,
}

impl Stepper<'_> {
    /// Advances the state by `step` (s).
    pub fn advance(&mut self, step: f64) -> Result<(), StepError> {
        let mut advance = self.start(step)?;
        while !advance.is_done() {
            self.advance_once(&mut advance)?;
        }
        self.finish(&advance);
        Ok(())
    }

    /// Begins to advance by `step` (s).
    pub fn start(&mut self, step: f64) -> Result<Advance, StepError> {
        let first_count = self.progress.steps + self.progress.rejected_steps;
        self.begin()?;
        let mut advance = Advance::new(step, self.next_knot(0.0, Legs::OUT, step), first_count);
        self.pass_what_is_due(&mut advance)?;
        Ok(advance)
    }

    /// Takes one accepted step, and passes the knots at its end, so that outputs there are those of the new cell.
    pub fn advance_once(&mut self, advance: &mut Advance) -> Result<(), StepError> {
        let (tau, end) = (advance.tau, advance.end);
        let target = advance.knot.map_or(end, |k| k.tau.min(end));
        let (implicit, pair) = (self.progress.choice.implicit, self.workspace.pair);
        let h = self.accepted_step(tau, target)?;
        for (sum, force) in advance.impulse.iter_mut().zip(self.workspace.weighted_force) {
            *sum += h * force;
        }
        advance.simultaneous = 0;
        advance.tau = if h == target - tau { target } else { tau + h };
        let taken = self.progress.steps + self.progress.rejected_steps - advance.first_count;
        if taken > self.control.max_steps && !advance.is_done() {
            // The accepted step's stages have been handed on: back for an inspection.
            self.workspace.buffers.carry_over();
            return Err(StepError::TooManySteps {
                steps: taken,
                limit: self.control.max_steps,
                since: advance.tau,
                step: self.progress.next_step,
                component: worst(self.workspace, self.problem.model, h, implicit, pair),
            });
        }
        self.pass_what_is_due(advance)
    }

    /// What a communication step that ends where `advance` has come to leaves behind.
    pub fn finish(&mut self, advance: &Advance) {
        self.finish_part(advance);
        let since = advance.elapsed();
        self.progress.mean_force = advance.impulse.map(|i| i / since);
    }

    /// The same of a part of a communication step, which has no mean of its own.
    pub fn finish_part(&mut self, advance: &Advance) {
        let progress = &mut *self.progress;
        if let Some(recorder) = &self.recorder {
            recorder.end(&mut progress.due, advance.tau);
        }
        progress.defect_lookups += std::mem::take(&mut self.workspace.forces.defect_lookups);
    }

    /// Passes all knots that have been reached.
    fn pass_what_is_due(&mut self, advance: &mut Advance) -> Result<(), StepError> {
        while let Some(at) = advance.knot
            && at.tau <= advance.tau
        {
            advance.knot = self.pass(at, advance.tau, advance.end, &mut advance.simultaneous)?;
            if !advance.is_done() {
                self.workspace.first_stage(self.problem, advance.tau, self.progress);
            }
        }
        Ok(())
    }

    /// The first stage of the first step, and the method that takes it.
    fn begin(&mut self) -> Result<(), StepError> {
        let Self { problem, control, known, workspace, progress, .. } = self;
        // A step that failed may have left them.
        (workspace.forces.defect_lookups, workspace.forces.unsolved) = (0, None);
        match control.method {
            Method::Automatic => {}
            Method::DormandPrince | Method::PhaseFitted | Method::Explicit => progress.choice.implicit = false,
            Method::Rodas => progress.choice.implicit = true,
        }
        check_rings(*problem, 0.0, progress)?;
        match known {
            Some(known) => workspace.first_stage_is(known, *problem, progress),
            None => workspace.first_stage(*problem, 0.0, progress),
        }
        if progress.choice.stable_step == 0.0 && control.method != Method::Rodas {
            let fastest = workspace.fastest(*problem, 0.0, progress);
            progress.choice.check_first(fastest, control.method, control.tolerance);
        }
        workspace.pair = control.method.pair(control.tolerance, progress.choice.damped);
        Ok(())
    }

    fn next_knot(&self, from: f64, legs: Legs, end: f64) -> Option<Knot> {
        next_knot(self.problem.model, self.problem.excitation, from, legs, end, &self.progress.cells)
    }

    /// Passes a knot at `tau` and gives the next one; `simultaneous` counts those between which no time passes.
    fn pass(&mut self, at: Knot, tau: f64, end: f64, simultaneous: &mut usize) -> Result<Option<Knot>, StepError> {
        *simultaneous += 1;
        let model = self.problem.model;
        let knots: usize = model.all_defects().map(Defects::knot_count).sum();
        // Each element can pass each knot once.
        if *simultaneous > model.element_count * knots {
            return Err(StepError::TooFast { count: *simultaneous, since: tau });
        }
        at.contact.enter(at.cell, &mut self.progress.cells);
        Ok(self.next_knot(tau, at.legs, end))
    }

    /// Takes one step from `from` that goes no further than `to`, as long as error control and contact changes allow,
    /// and returns its length.
    fn accepted_step(&mut self, from: f64, to: f64) -> Result<f64, StepError> {
        let remaining = to - from;
        let tolerance = self.control.tolerance;
        // A landing on a contact change or a crossing: the step that ends there.
        let mut landing = None;
        let mut crossing: Option<Crossing> = None;
        let (mut tried, mut simultaneous) = (0, 0);
        loop {
            let Self { problem, workspace, progress, .. } = self;
            let wanted = progress.choice.limited(progress.next_step).min(problem.longest_step());
            let h = landing.unwrap_or_else(|| share_of(remaining, wanted, progress.next_step));
            let span = Span { from, length: h };
            tried += 1;
            try_step(workspace, *problem, span, progress);
            let error = workspace.error(tolerance);
            if !(error <= 1.0) {
                crossing = None;
                landing = self.after_failure(span, error, landing.is_some())?;
                continue;
            }
            if landing.is_none() && problem.model.watches_contacts() {
                crossing = first_crossing(workspace, *problem, span, progress);
            }
            if let Some(found) = crossing.filter(|found| landing.is_none() && found.share <= CLOSEST_CHANGE) {
                crossing = None;
                simultaneous += 1;
                // Each contact enters a cell and perhaps leaves it again; what goes on for longer than that stands on
                // the knot, and its motion is the same in both cells.
                if simultaneous <= 2 * problem.model.contact_count() {
                    progress.rejected_steps += 1;
                    found.contact.enter(found.cell, &mut progress.cells);
                    workspace.first_stage(*problem, from, progress);
                    continue;
                }
            }
            if workspace.changed && landing.is_none() && tolerance < PASSES_CHANGES {
                landing = self.landing_on_change(span, crossing.map_or(1.0, |crossing| crossing.share));
                if landing.is_some() {
                    crossing = None;
                    self.progress.rejected_steps += 1;
                    continue;
                }
            }
            let Self { workspace, progress, .. } = self;
            if let Some(found) = crossing.filter(|_| landing.is_none()) {
                progress.rejected_steps += 1;
                landing = Some(found.share * h);
                continue;
            }
            if workspace.changed && landing.is_none() {
                workspace.forces.note_pushing(&mut progress.pushing);
            }
            // A step cut short to land somewhere says nothing against the step wanted before it.
            let short = h < SHORT * wanted;
            let proposal = h * step_factor(workspace, error, progress.last_error, progress).clamp(0.2, 5.0);
            progress.next_step = if short { proposal.max(wanted) } else { proposal };
            progress.last_error = error.max(1e-4);
            self.conclude(span, Taken { tried, short }, crossing)?;
            return Ok(h);
        }
    }

    /// Rejects the step tried last. What makes steps fail is mostly a contact change, so the next trial ends there; its
    /// length is given. A step that was to end there itself, and one without a change, leave a shorter step wanted.
    fn after_failure(&mut self, span: Span, error: f64, landed: bool) -> Result<Option<f64>, StepError> {
        let Self { problem, workspace, progress, .. } = self;
        progress.rejected_steps += 1;
        if workspace.changed && !landed && error < BLURRED {
            let watches = problem.model.watches_contacts();
            let crossing = if watches { first_crossing(workspace, *problem, span, progress) } else { None };
            let landing = self.landing_on_change(span, crossing.map_or(1.0, |crossing| crossing.share));
            if landing.is_some() {
                return Ok(landing);
            }
        }
        let Self { problem, workspace, progress, .. } = self;
        let factor = match (error.is_finite(), workspace.changed) {
            (false, _) => 0.1,
            (true, true) => factor_over_change(error),
            (true, false) => step_factor(workspace, error, 1.0, progress).clamp(0.1, 0.9),
        };
        progress.next_step = span.length * factor;
        check_step(workspace, *problem, span, error, progress)?;
        Ok(None)
    }

    /// Length of the step that ends at the first contact change of the step tried last, unless that is hardly after its
    /// start or not before the share `limit` of it.
    fn landing_on_change(&mut self, span: Span, limit: f64) -> Option<f64> {
        let Self { problem, control, workspace, progress, .. } = self;
        let share = first_change(workspace, *problem, span, control.tolerance, progress);
        if !(share > CLOSEST_CHANGE && share < limit) {
            return None;
        }
        // The contacts that change there, by the dense output: the shorter step may end a hair before.
        workspace.forces.note_pushing(&mut progress.pushing);
        Some(share * span.length)
    }

    /// Records and accepts the step tried last; a contact that crosses a knot at its end then enters the cell beyond.
    #[inline(always)]
    fn conclude(&mut self, span: Span, taken: Taken, crossing: Option<Crossing>) -> Result<(), StepError> {
        // Before samples within the step leave their own forces.
        check_angles(self.workspace, self.problem.model, span.end(), self.progress)?;
        self.record(span);
        self.accept(span)?;
        self.choose(span, taken);
        if let Some(found) = crossing {
            found.contact.enter(found.cell, &mut self.progress.cells);
            self.workspace.first_stage(self.problem, span.end(), self.progress);
        }
        Ok(())
    }

    /// Takes the samples that are due within the step tried last.
    fn record(&mut self, span: Span) {
        let Self { problem, workspace, progress, recorder, .. } = self;
        let Some(recorder) = recorder else { return };
        let lookups = workspace.forces.defect_lookups;
        while let Some(tau) = recorder.due_before(&progress.due, span.end()) {
            let share = (tau - span.from).max(0.0) / span.length;
            probe(workspace, *problem, span, share, progress);
            workspace.sensor_modes.copy_from_slice(&progress.sensor_modes);
            let Workspace { buffers, sensor_modes, .. } = &mut **workspace;
            let ends = step_ends(buffers, &progress.state, span.length);
            problem.model.sensor_modes.advance(ends, share, sensor_modes);
            let Workspace { dense, scratch, sensor_modes, forces, .. } = &**workspace;
            let (model, excitation) = (problem.model, problem.excitation);
            let (state, derivative, start) = (dense, scratch, recorder.angles());
            let outputs = Outputs { model, excitation, tau, state, derivative, forces, sensor_modes, start };
            recorder.take(&mut progress.due, &mut progress.under_way, &outputs);
        }
        // What the recorder looks up is not the solver's work.
        workspace.forces.defect_lookups = lookups;
    }

    fn accept(&mut self, span: Span) -> Result<(), StepError> {
        if self.progress.choice.implicit {
            self.weigh_forces(span);
        }
        let Self { problem, workspace, progress, .. } = self;
        if !progress.sensor_modes.is_empty() {
            let ends = step_ends(&workspace.buffers, &progress.state, span.length);
            problem.model.sensor_modes.advance(ends, 1.0, &mut progress.sensor_modes);
        }
        std::mem::swap(&mut progress.state, &mut workspace.buffers.end);
        progress.steps += 1;
        progress.implicit_steps += u64::from(progress.choice.implicit);
        // Contacts that failed in trials which error control took back are of no account.
        workspace.forces.unsolved = None;
        workspace.buffers.carry_over();
        workspace.first_force = workspace.last_force;
        workspace.linearized = false;
        let (model, since) = (problem.model, span.end());
        for (j, &path) in progress.state[..model.element_count].iter().enumerate() {
            if !(path.abs() <= model.element_radius) {
                return Err(StepError::ThrownOut { element: j + 1, path, limit: model.element_radius, since });
            }
        }
        check_rings(*problem, since, progress)
    }

    /// Notes the step and perhaps chooses another method for the next. The Jacobian of an implicit step is still that
    /// of its start.
    fn choose(&mut self, span: Span, taken: Taken) {
        let Self { problem, control: Control { method, tolerance, .. }, workspace, progress, .. } = self;
        if progress.choice.implicit {
            if *method == Method::Rodas {
                return;
            }
            progress.choice.implicit_step(span.length, taken.tried, workspace.jacobian.fastest(), *method, *tolerance);
        } else if progress.choice.explicit_step(span.length, taken.tried, taken.short) {
            let fastest = workspace.fastest(*problem, span.end(), progress);
            progress.choice.check_explicit(fastest, *method, *tolerance);
        }
        workspace.pair = method.pair(*tolerance, progress.choice.damped);
    }

    /// Mean ring forces of an implicit step, by quadrature over its dense output. They are read only if a ring's motion
    /// is prescribed.
    fn weigh_forces(&mut self, span: Span) {
        let Self { problem, workspace, progress, .. } = self;
        workspace.weighted_force = [0.0; 10];
        if problem.model.shaft.motion != Motion::Host && problem.model.housing.motion != Motion::Host {
            return;
        }
        for i in 0..workspace.weighted_force.len() {
            workspace.weighted_force[i] = (workspace.first_force[i] + workspace.last_force[i]) / 12.0;
        }
        for share in LOBATTO {
            probe(workspace, *problem, span, share, progress);
            for (sum, force) in workspace.weighted_force.iter_mut().zip(workspace.forces.rings) {
                *sum += 5.0 / 12.0 * force;
            }
        }
    }
}
