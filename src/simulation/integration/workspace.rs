//! What a step works in, and what the step tried last has left there.
//!
//! The error of a step is measured against the largest approach in any contact, because that is what forces follow
//! from: 1e-5 of a path of 1 mm would be more than a loaded contact's whole approach.

use super::progress::Progress;
use crate::dynamics::contacts::{Forces, RingForces};
use crate::dynamics::derivatives::{Fastest, Jacobian};
use crate::dynamics::parameters::{Excitation, Layout, Model, StepEnds};
use crate::numerics::lanes::row::Row;
use crate::scene::Motion;
use crate::simulation::integration::methods::{ExplicitMethod, StageBuffers};

/// Approach below which errors are no longer measured relative to it (m): a contact of about 0.2 N.
const SMALLEST_APPROACH: f64 = 0.1e-6;
/// Turns an approach into a velocity (1/s): below the rings' angular frequency on their contacts. With it the error of
/// accelerations comes out at about ten times the tolerance while contacts hold.
const VELOCITY_PER_APPROACH: f64 = 1e3;

/// Angle by which elements in balance may go round in one step where a host moves a ring (rad): a fiftieth of a load
/// zone, over which the stages' sum misses 1e-6 of a mean force.
const MOST_TURN: f64 = 0.02;

/// What is integrated from one communication point to the next.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    /// The equations.
    pub model: &'a Model,
    /// What acts from outside.
    pub excitation: &'a Excitation,
}

impl Problem<'_> {
    /// Longest step (s) over which stages see enough of what a host moves: elements in balance have no state whose
    /// error would say so, and mean forces are sums over the stages.
    pub(super) fn longest_step(&self) -> f64 {
        let hosted = [&self.model.shaft, &self.model.housing].iter().any(|ring| ring.motion == Motion::Host);
        if hosted && self.model.elements_in_balance() {
            MOST_TURN / self.excitation.cage.0[1].abs()
        } else {
            f64::INFINITY
        }
    }
}

/// One step within a communication step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Its start (s) after the communication point.
    pub from: f64,
    /// Its length (s).
    pub length: f64,
}

impl Span {
    /// Its end (s) after the communication point.
    pub fn end(self) -> f64 {
        self.from + self.length
    }
}

/// The right-hand side at one instant.
#[derive(Debug, Clone)]
pub struct Evaluation {
    /// The state's derivative.
    pub derivative: Row,
    /// Forces on the rings, and each contact.
    pub forces: Forces,
}

impl Evaluation {
    /// Room for a model's.
    pub fn new(model: &Model) -> Self {
        Self { derivative: Row::zeros(model.layout.len), forces: Forces::of(model) }
    }
}

/// Workspaces of the integration; holds nothing that the future depends on.
#[derive(Debug, Clone)]
pub struct Workspace {
    pub(super) buffers: StageBuffers,
    /// Which explicit method steps.
    pub(super) pair: ExplicitMethod,
    pub(super) jacobian: Jacobian,
    /// Jacobian and derivative by time belong to the start of the step.
    pub(in crate::simulation) linearized: bool,
    pub(in crate::simulation) forces: Forces,
    pub(super) dense: Row,
    /// State of the sensors' modes at that instant.
    pub(super) sensor_modes: Row,
    pub(super) scratch: Row,
    /// Sum over the stages of the step tried last of weight × ring force.
    pub(super) weighted_force: RingForces,
    pub(super) first_force: RingForces,
    pub(super) last_force: RingForces,
    /// Turns errors of all states into lengths; 0 where there is no state.
    pub(super) weights: Row,
    /// Largest error of the step tried last (m), infinite as soon as one state's is not finite.
    pub(super) largest_error: f64,
    /// Largest approach of any contact at its end (m).
    pub(super) largest_approach: f64,
    /// Whether any contact pushes there that did not at its start, or the other way round.
    pub(super) changed: bool,
}

impl Workspace {
    /// Workspaces for a model.
    pub fn new(model: &Model) -> Self {
        let len = model.layout.len;
        let positions = Row::from_fn(len, |i| f64::from(u8::from(model.layout.is_position(i))));
        Self {
            buffers: StageBuffers::new(model.layout.partition(), positions),
            pair: ExplicitMethod::default(),
            jacobian: Jacobian::new(model),
            linearized: false,
            forces: Forces::of(model),
            dense: Row::zeros(len),
            sensor_modes: Row::zeros(model.sensor_modes.state_len()),
            scratch: Row::zeros(len),
            weighted_force: [0.0; 10],
            first_force: [0.0; 10],
            last_force: [0.0; 10],
            weights: Row::from_fn(len, |i| weight(&model.layout, i)),
            largest_error: 0.0,
            largest_approach: 0.0,
            changed: false,
        }
    }

    /// Derivative at the start of the next step, at `tau` (s) after the communication point.
    pub(super) fn first_stage(&mut self, problem: Problem, tau: f64, progress: &Progress) {
        let (first, forces) = (&mut self.buffers.first, &mut self.forces);
        problem.model.derivative(problem.excitation, tau, &progress.cells, &progress.state, first, forces);
        self.first_force = self.forces.rings;
        self.linearized = false;
    }

    /// The same of a step that starts where the right-hand side has been evaluated.
    pub(super) fn first_stage_is(&mut self, known: &Evaluation, problem: Problem, progress: &Progress) {
        self.buffers.first.copy_from_slice(&known.derivative);
        self.forces.enter(problem.model, &progress.cells);
        self.forces.defect_lookups += known.forces.defect_lookups;
        self.first_force = known.forces.rings;
        self.linearized = false;
    }

    /// Jacobian and derivative by time at the start of the next step, unless they are there.
    pub(super) fn linearize(&mut self, problem: Problem, tau: f64, progress: &Progress) {
        if !self.linearized {
            let Problem { model, excitation } = problem;
            let (Progress { cells, state, .. }, shortcuts) = (progress, &mut self.forces.shortcuts);
            model.linearize(excitation, tau, cells, state, &mut self.jacobian, shortcuts);
            model.derivative_by_time(excitation, tau, cells, state, &mut self.jacobian, shortcuts);
            self.linearized = true;
        }
    }

    /// What moves fastest at `tau`, where the next step starts.
    pub(super) fn fastest(&mut self, problem: Problem, tau: f64, progress: &Progress) -> Fastest {
        let Problem { model, excitation } = problem;
        let (jacobian, shortcuts) = (&mut self.jacobian, &mut self.forces.shortcuts);
        model.linearize(excitation, tau, &progress.cells, &progress.state, jacobian, shortcuts);
        self.linearized = false;
        jacobian.fastest()
    }

    /// Error of the step tried last, per tolerance. Infinite as soon as one state's is not finite.
    pub(super) fn error(&self, tolerance: f64) -> f64 {
        self.largest_error / (tolerance * (self.largest_approach + SMALLEST_APPROACH))
    }
}

/// Both ends of the step of `length` (s) tried last from the state `start`.
pub(super) fn step_ends<'a>(buffers: &'a StageBuffers, start: &'a [f64], length: f64) -> StepEnds<'a> {
    StepEnds { states: [start, &buffers.end], derivatives: [&buffers.first, &buffers.last], length }
}

/// Weight that turns the error of state `i` into a length.
fn weight(layout: &Layout, i: usize) -> f64 {
    match (layout.is_integrated(i), layout.is_position(i)) {
        (false, _) => 0.0,
        (true, true) => 1.0,
        (true, false) => 1.0 / VELOCITY_PER_APPROACH,
    }
}
