//! Advances the state by one communication step: error control, and steps that land on what is not smooth.
//!
//! Three kinds of instants end a step exactly: the communication point; a *knot*, where an element enters another cell
//! of the defect; a *contact change*, where a contact begins or ceases to push. Within a step every element stays in
//! its cell and the right-hand side is smooth, but for the C¹ onset of a contact force.
//!
//! Knots are whole numbers (the cell of each element), never recognised by comparing times, so a restored state
//! continues with the same bits. Contact changes are located on the dense output.
//!
//! Three methods step, one at a time ([`super::switching`]); error control and landing are the same for all.
//!
//! The error of a step is measured against the largest approach in any contact, because that is what forces follow
//! from: 1e-5 of a path of 1 mm would be more than a loaded contact's whole approach.

use super::arrow::Arrow;
use super::explicit::{Explicit, Pair};
use super::failing::check_rings;
use super::kernels::{Look, Trial};
use super::knots::{Leg, next_knot};
use super::outputs::Outputs;
use super::progress::Progress;
use super::recorder::Recorder;
use super::rodas::{self, Rodas};
use super::step_error::StepError;
use super::switching::Method;
use crate::dynamics::drive::Drive;
use crate::dynamics::forces::Forces;
use crate::dynamics::jacobian::Jacobian;
use crate::dynamics::model::{Layout, Model};
use crate::numerics::lanes::dispatch;
use crate::numerics::rough_power;
use crate::numerics::row::Row;
use crate::scene::Motion;

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

/// Smallest step [s]; the fastest real mode of a steel bearing's element lasts 1e-8 s.
pub(super) const SMALLEST_STEP: f64 = 1e-15;
/// Approach below which errors are no longer measured relative to it [m]: a contact of about 0.2 N.
const SMALLEST_APPROACH: f64 = 0.1e-6;
/// Turns an approach into a velocity [1/s]: below the rings' angular frequency on their contacts. With it the error of
/// accelerations comes out at about ten times the tolerance while contacts hold.
const VELOCITY_PER_APPROACH: f64 = 1e3;
/// Shares of a step: a contact change this close to its start is not landed on, which bounds chatter.
const CLOSEST_CHANGE: f64 = 1e-4;
/// How far beyond the stable step one may go to land: what grows there is taken back by the next steps, or by error control.
const STABLE_SLACK: f64 = 1.15;
/// How much longer than wanted steps may be to be one fewer.
const EQUAL_SLACK: f64 = 1.03;
/// Share of the wanted step below which a step has been cut short.
const CUT: f64 = 0.8;
/// Inner nodes of Lobatto's quadrature with four nodes, as shares of a step; exact for polynomials of degree 5.
const LOBATTO: [f64; 2] = [0.276_393_202_250_021_03, 0.723_606_797_749_979];

/// Workspaces of the integration; holds nothing that the future depends on.
#[derive(Debug, Clone)]
pub struct Stepper {
    /// Also keeps the derivatives at start (first stage) and end (last stage) of a step, whichever method takes it.
    pub(super) explicit: Explicit,
    /// Which explicit method steps.
    pub(super) pair: Pair,
    pub(super) implicit: Rodas,
    pub(super) jacobian: Jacobian,
    /// ∂f/∂t at the start of the step.
    pub(super) by_time: Row,
    /// Jacobian and `by_time` belong to the start of the step.
    pub(super) linearized: bool,
    pub(super) arrow: Arrow,
    pub(super) forces: Forces,
    pub(super) dense: Row,
    pub(super) scratch: Row,
    /// Sum over the stages of the step tried last of weight × ring force.
    pub(super) weighted_force: [f64; 4],
    pub(super) first_force: [f64; 4],
    pub(super) last_force: [f64; 4],
    /// Turns errors of all states into lengths; 0 where there is no state.
    pub(super) weights: Row,
    /// Largest error of the step tried last [m], infinite as soon as one state's is not finite.
    pub(super) largest_error: f64,
    /// Largest approach of any contact at its end [m].
    pub(super) largest_approach: f64,
    /// Whether any contact pushes there that did not at its start, or the other way round.
    pub(super) changed: bool,
}

impl Stepper {
    /// Workspaces for a model.
    pub fn new(model: &Model) -> Self {
        let len = model.layout.len;
        let positions = Row::from_fn(len, |i| f64::from(u8::from(model.layout.is_position(i))));
        Self {
            explicit: Explicit::new(model.layout.cut(), positions),
            pair: Pair::default(),
            implicit: Rodas::new(model.layout.cut()),
            jacobian: Jacobian::new(model),
            by_time: Row::zeros(len),
            linearized: false,
            arrow: Arrow::new(model.element_count),
            forces: Forces::new(model.element_count),
            dense: Row::zeros(len),
            scratch: Row::zeros(len),
            weighted_force: [0.0; 4],
            first_force: [0.0; 4],
            last_force: [0.0; 4],
            weights: Row::from_fn(len, |i| weight(&model.layout, i)),
            largest_error: 0.0,
            largest_approach: 0.0,
            changed: false,
        }
    }

    /// Advances `progress` by `step` [s] under `drive`. A recorder takes its samples on the way.
    pub fn advance(
        &mut self,
        model: &Model,
        drive: &Drive,
        control: Control,
        step: f64,
        progress: &mut Progress,
        mut recorder: Option<&mut Recorder>,
    ) -> Result<(), StepError> {
        let mut tau = 0.0;
        let mut impulse = [0.0; 4];
        // A step that failed may have left them.
        (self.forces.defect_lookups, self.forces.unsolved) = (0, None);
        match control.method {
            Method::Automatic => {}
            Method::DormandPrince | Method::PhaseFitted => progress.choice.implicit = false,
            Method::Rodas => progress.choice.implicit = true,
        }
        check_rings(model, drive, tau, progress)?;
        let first_count = progress.steps + progress.rejected_steps;
        let mut knot = next_knot(model, drive, (tau, Leg::Out), step, &progress.cells);
        let mut at_once = 0;
        self.first_stage(model, drive, tau, progress);
        if progress.choice.stable_step == 0.0 && control.method != Method::Rodas {
            self.linearize(model, drive, tau, progress);
            progress.choice.look_first(&self.jacobian, control.method, control.tolerance);
        }
        self.pair = control.method.pair(control.tolerance, progress.choice.damped);
        while tau < step {
            if let Some(at) = knot
                && at.tau <= tau
            {
                count_passage(model, tau, &mut at_once)?;
                progress.cells[at.element] = at.cell;
                knot = next_knot(model, drive, (tau, at.leg), step, &progress.cells);
                self.first_stage(model, drive, tau, progress);
                continue;
            }
            let target = knot.map_or(step, |k| k.tau.min(step));
            let by = (progress.choice.implicit, self.pair);
            let h = self.accepted_step(model, drive, control, (tau, target), progress, recorder.as_deref_mut())?;
            for (sum, force) in impulse.iter_mut().zip(self.weighted_force) {
                *sum += h * force;
            }
            at_once = 0;
            tau = if h == target - tau { target } else { tau + h };
            let taken = progress.steps + progress.rejected_steps - first_count;
            if taken > control.max_steps && tau < step {
                // The accepted step's stages have been handed on: back for a look.
                self.explicit.carry_over();
                return Err(StepError::TooManySteps {
                    steps: taken,
                    limit: control.max_steps,
                    since: tau,
                    step: progress.next_step,
                    component: self.worst(model, h, by),
                });
            }
        }
        // A knot right at the communication point is passed now, so that outputs there are those of the new cell.
        while let Some(at) = knot
            && at.tau <= tau
        {
            count_passage(model, tau, &mut at_once)?;
            progress.cells[at.element] = at.cell;
            knot = next_knot(model, drive, (tau, at.leg), step, &progress.cells);
        }
        if let Some(recorder) = recorder {
            recorder.end(&mut progress.due, step);
        }
        progress.mean_force = impulse.map(|i| i / step);
        progress.defect_lookups += std::mem::take(&mut self.forces.defect_lookups);
        Ok(())
    }

    /// Derivative at the start of the next step.
    fn first_stage(&mut self, model: &Model, drive: &Drive, tau: f64, progress: &Progress) {
        model.derivative(drive, tau, &progress.cells, &progress.state, &mut self.explicit.stages[0], &mut self.forces);
        self.first_force = self.forces.rings;
        self.linearized = false;
    }

    /// Takes one step from `from` that goes no further than `to`, as long as error control and contact changes allow,
    /// and returns its length.
    fn accepted_step(
        &mut self,
        model: &Model,
        drive: &Drive,
        control: Control,
        (from, to): (f64, f64),
        progress: &mut Progress,
        recorder: Option<&mut Recorder>,
    ) -> Result<f64, StepError> {
        let remaining = to - from;
        // A landing on a contact change: the step that ends there.
        let mut landing = None;
        let mut tried = 0;
        loop {
            let wanted = progress.choice.limited(progress.next_step);
            // One step a little beyond what is stable rather than two, where error control has no objection.
            let reach = progress.next_step.min(STABLE_SLACK * wanted);
            let h = landing.unwrap_or(if reach >= remaining * (1.0 - 1e-9) {
                remaining
            } else {
                // Equal steps rather than a remnant, and one fewer where that makes them hardly longer.
                remaining / (remaining / (EQUAL_SLACK * wanted)).ceil()
            });
            tried += 1;
            self.try_step(model, drive, from, h, progress);
            let error = self.error(control.tolerance);
            if !(error <= 1.0) {
                progress.rejected_steps += 1;
                let factor =
                    if error.is_finite() { self.step_factor(error, 1.0, progress).clamp(0.1, 0.9) } else { 0.1 };
                progress.next_step = h * factor;
                landing = None;
                self.check_step(model, drive, (from, h), error, progress)?;
                continue;
            }
            if self.changed && landing.is_none() {
                let share = self.first_change(model, drive, (from, h), control.tolerance, progress);
                if share > CLOSEST_CHANGE && share < 1.0 {
                    progress.rejected_steps += 1;
                    landing = Some(share * h);
                    // The contacts that change there, by the dense output: the shorter step may end a hair before.
                    self.forces.note_pushing(&mut progress.pushing);
                    continue;
                }
            }
            if self.changed && landing.is_none() {
                self.forces.note_pushing(&mut progress.pushing);
            }
            let proposal = h * self.step_factor(error, progress.last_error, progress).clamp(0.2, 5.0);
            // A step cut short to land somewhere says nothing against the step wanted before it.
            let cut = h < CUT * wanted;
            progress.next_step = if cut { proposal.max(wanted) } else { proposal };
            progress.last_error = error.max(1e-4);
            if let Some(recorder) = recorder {
                self.record(model, drive, (from, h), progress, recorder);
            }
            self.accept(model, drive, (from, h), progress)?;
            self.choose(model, drive, control, (from, h), (tried, cut), progress);
            return Ok(h);
        }
    }

    /// Takes the samples that are due within the step tried last.
    fn record(
        &mut self,
        model: &Model,
        drive: &Drive,
        (from, h): (f64, f64),
        progress: &mut Progress,
        recorder: &mut Recorder,
    ) {
        let lookups = self.forces.defect_lookups;
        while let Some(tau) = recorder.due_before(&progress.due, from + h) {
            self.look(model, drive, (from, h), (tau - from).max(0.0) / h, progress);
            let Self { dense, scratch, forces, .. } = self;
            let outputs = Outputs::new(model, (drive, tau), (dense, scratch), forces, recorder.cage_angle());
            recorder.take(&mut progress.due, &mut progress.under_way, &outputs);
        }
        // What the recorder looks up is not the solver's work.
        self.forces.defect_lookups = lookups;
    }

    fn accept(
        &mut self,
        model: &Model,
        drive: &Drive,
        (from, h): (f64, f64),
        progress: &mut Progress,
    ) -> Result<(), StepError> {
        if progress.choice.implicit {
            self.weigh_forces(model, drive, (from, h), progress);
            progress.implicit_steps += 1;
            std::mem::swap(&mut progress.state, &mut self.implicit.end);
        } else {
            std::mem::swap(&mut progress.state, &mut self.explicit.end);
        }
        progress.steps += 1;
        // Contacts that failed in trials which error control took back are of no account.
        self.forces.unsolved = None;
        self.explicit.carry_over();
        self.first_force = self.last_force;
        self.linearized = false;
        for (j, &path) in progress.state[..model.element_count].iter().enumerate() {
            if !(path.abs() <= model.element_radius) {
                let (limit, since) = (model.element_radius, from + h);
                return Err(StepError::ThrownOut { element: j + 1, path, limit, since });
            }
        }
        check_rings(model, drive, from + h, progress)
    }

    /// Notes the step and perhaps chooses another method for the next. The Jacobian of an implicit step is still that of
    /// its start.
    fn choose(
        &mut self,
        model: &Model,
        drive: &Drive,
        control: Control,
        (from, h): (f64, f64),
        (tried, cut): (u32, bool),
        progress: &mut Progress,
    ) {
        if progress.choice.implicit {
            if control.method == Method::Rodas {
                return;
            }
            progress.choice.implicit_step(h, tried, &self.jacobian, control.method, control.tolerance);
        } else if progress.choice.explicit_step(h, tried, cut) {
            self.linearize(model, drive, from + h, progress);
            progress.choice.look_explicit(&self.jacobian, control.method, control.tolerance);
        }
        self.pair = control.method.pair(control.tolerance, progress.choice.damped);
    }

    fn linearize(&mut self, model: &Model, drive: &Drive, tau: f64, progress: &Progress) {
        if !self.linearized {
            let (jacobian, by_time) = (&mut self.jacobian, &mut self.by_time);
            model.linearize(drive, tau, &progress.cells, &progress.state, jacobian, by_time);
            self.linearized = true;
        }
    }

    fn try_step(&mut self, model: &Model, drive: &Drive, from: f64, h: f64, progress: &Progress) {
        if progress.choice.implicit {
            self.linearize(model, drive, from, progress);
            self.arrow.factor(&self.jacobian, 1.0 / (rodas::GAMMA * h));
        }
        dispatch(Trial { stepper: self, model, drive, from, h, progress });
    }

    /// The state at a share of the step tried last, in `dense`, its derivative in `scratch`, and all forces there.
    pub(super) fn look(
        &mut self,
        model: &Model,
        drive: &Drive,
        (from, h): (f64, f64),
        share: f64,
        progress: &Progress,
    ) {
        dispatch(Look { stepper: self, model, drive, from, h, share, progress });
    }

    /// Mean ring forces of an implicit step, by quadrature over its dense output. They are read only if a ring's motion
    /// is prescribed.
    fn weigh_forces(&mut self, model: &Model, drive: &Drive, (from, h): (f64, f64), progress: &Progress) {
        self.weighted_force = [0.0; 4];
        if model.shaft.motion != Motion::Host && model.housing.motion != Motion::Host {
            return;
        }
        for i in 0..4 {
            self.weighted_force[i] = (self.first_force[i] + self.last_force[i]) / 12.0;
        }
        for share in LOBATTO {
            self.look(model, drive, (from, h), share, progress);
            for (sum, force) in self.weighted_force.iter_mut().zip(self.forces.rings) {
                *sum += 5.0 / 12.0 * force;
            }
        }
    }

    /// Error of the step tried last, per tolerance. Infinite as soon as one state's is not finite.
    fn error(&self, tolerance: f64) -> f64 {
        self.largest_error / (tolerance * (self.largest_approach + SMALLEST_APPROACH))
    }

    /// Factor from this step to the next for an error per tolerance: a proportional–integral controller (Hairer and
    /// Wanner, *Solving Ordinary Differential Equations II*, IV.2) with the exponents usual for an estimate of this order.
    fn step_factor(&self, error: f64, last_error: f64, progress: &Progress) -> f64 {
        let [now, before] = match self.pair {
            Pair::PhaseFitted if !progress.choice.implicit => [-0.21, 0.05],
            _ => [-0.17, 0.04],
        };
        0.9 * rough_power(error.max(1e-10), now) * rough_power(last_error, before)
    }
}

/// Weight that turns the error of state `i` into a length.
fn weight(layout: &Layout, i: usize) -> f64 {
    match (layout.is_used(i), layout.is_position(i)) {
        (false, _) => 0.0,
        (true, true) => 1.0,
        (true, false) => 1.0 / VELOCITY_PER_APPROACH,
    }
}

/// Counts passages of knots between which no time passes: each element can pass each knot once.
fn count_passage(model: &Model, since: f64, count: &mut usize) -> Result<(), StepError> {
    *count += 1;
    let knots = model.defect.as_ref().map_or(0, |(near, _)| near.knots().len());
    if *count > model.element_count * knots {
        return Err(StepError::TooFast { count: *count, since });
    }
    Ok(())
}
