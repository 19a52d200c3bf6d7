//! What runs, and what has been evaluated of it at the communication point.

use super::excitation;
use super::state::{Ended, FirstInputs, History, State};
use crate::contact::error::ContactError;
use crate::contact::map::MAPPED;
use crate::dynamics::parameters::{Excitation, Layout, Model, WholeAngle};
use crate::scene::Scene;
use crate::simulation::Method;
use crate::simulation::error::SimulationError;
use crate::simulation::integration::{Control, Evaluation, Problem, Progress, Stepper, Workspace};
use crate::simulation::interface::{Count, Inputs, Interface, Outputs};
use crate::simulation::recorder::{Due, Recorder};
use crate::simulation::setup;
use crate::simulation::step_error::StepError;
use std::sync::Arc;

/// Speeds of both rings, and position, velocity and acceleration of each along its five coordinates.
const MOST_INPUTS: usize = 2 + 2 * 15;

/// Inputs with their derivatives; slots beyond the last input are not used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::simulation) struct InputValues {
    values: [f64; MOST_INPUTS],
    rates: [[Option<f64>; 2]; MOST_INPUTS],
}

/// What runs: the model, its state, and what steps it.
#[derive(Debug, Clone)]
pub(in crate::simulation) struct Run {
    /// Copies of a simulation share it until parameters of one are set.
    pub(in crate::simulation) model: Arc<Model>,
    pub(in crate::simulation) workspace: Workspace,
    /// `None` where the scene has no recorder.
    pub(in crate::simulation) recorder: Option<Recorder>,
    pub(in crate::simulation) method: Method,
    pub(in crate::simulation) state: State,
}

impl Run {
    /// A model at rest.
    pub(in crate::simulation) fn new(model: Model, scene: &Scene, interface: &Interface) -> Self {
        let recorder = Recorder::of(scene, &interface.table, &interface.quantities);
        let (reals, integers) = setup::start_values(&interface.table);
        let state = State {
            time: 0.0,
            started: false,
            cage: WholeAngle::new(scene.cage.initial_angle),
            frames: [scene.shaft_initial_angle, scene.housing_initial_angle, 0.0].map(WholeAngle::new),
            ended: Ended::default(),
            progress: Progress::new(&model, recorder.as_ref().map_or(0, Recorder::under_way)),
            reals,
            integers,
            input_rates: vec![[None; 2]; interface.inputs.count],
            history: History::none(interface.inputs.count),
            coupling: interface.inputs.repeated.map(|_| Box::default()),
            first: FirstInputs::none(interface.inputs.count),
        };
        Self { workspace: Workspace::new(&model), model: Arc::new(model), recorder, method: Method::Automatic, state }
    }

    /// Length of the recorder's rows under way.
    pub(in crate::simulation) fn rows_under_way(&self) -> usize {
        self.recorder.as_ref().map_or(0, Recorder::under_way)
    }

    /// Where every external influence is, during the next step if `stepping`.
    pub(in crate::simulation) fn excitation(&self, inputs: &Inputs, stepping: bool) -> Excitation {
        excitation::excitation(&self.state, inputs, &self.model.ratios, stepping)
    }

    /// What the solver has counted.
    pub(in crate::simulation) fn count(&self, count: Count) -> u64 {
        self.state.progress.count(count, self.model.solves_grids())
    }

    /// Readies what goes along with a communication step.
    #[inline]
    pub(in crate::simulation) fn begin(&mut self) {
        self.workspace.forces.shortcuts.forget();
        match self.recorder.as_mut().filter(|recorder| recorder.is_on()) {
            Some(recorder) => recorder.begin(self.state.time, self.state.angles()),
            // What is not sampled cannot be made up for: whoever records on from here begins anew.
            None => self.state.progress.due = Due::default(),
        }
    }

    #[inline]
    pub(in crate::simulation) fn control(&self, scene: &Scene, inputs: &Inputs) -> Control {
        let method = match self.method {
            Method::Automatic | Method::Rodas if self.model.elements_in_balance() => Method::Explicit,
            method => method,
        };
        let tolerance = inputs.tolerance.map_or(scene.tolerance, |i| self.state.reals[i]);
        Control { tolerance, max_steps: scene.max_steps, method }
    }

    /// What steps, where a step may begin with a right-hand side that is `known`.
    #[inline]
    pub(in crate::simulation) fn stepper<'a>(
        &'a mut self,
        excitation: &'a Excitation,
        control: Control,
        known: Option<&'a Evaluation>,
    ) -> Stepper<'a> {
        Stepper {
            problem: Problem { model: &self.model, excitation },
            control,
            known,
            workspace: &mut self.workspace,
            progress: &mut self.state.progress,
            recorder: self.recorder.as_mut().filter(|recorder| recorder.is_on()),
        }
    }

    /// Time, angles and inputs move on by `step` (s).
    #[inline]
    pub(in crate::simulation) fn commit(&mut self, inputs: &Inputs, excitation: &Excitation, step: f64) {
        self.state.cage = self.state.cage.advanced(excitation.cage.at(step));
        if inputs.frames {
            for (angle, turning) in self.state.frames.iter_mut().zip(&excitation.frames) {
                *angle = angle.advanced(turning.since.at(step));
            }
        }
        self.state.time += step;
        excitation::follow(&mut self.state, inputs, &self.model.ratios, excitation, step);
    }

    /// The inputs as they are.
    pub(in crate::simulation) fn input_values(&self) -> InputValues {
        let count = self.state.input_rates.len();
        let mut inputs = InputValues { values: [0.0; MOST_INPUTS], rates: [[None; 2]; MOST_INPUTS] };
        inputs.values[..count].copy_from_slice(&self.state.reals[..count]);
        inputs.rates[..count].copy_from_slice(&self.state.input_rates);
        inputs
    }

    /// Puts inputs back.
    pub(in crate::simulation) fn set_inputs(&mut self, inputs: &InputValues) {
        let count = self.state.input_rates.len();
        self.state.reals[..count].copy_from_slice(&inputs.values[..count]);
        self.state.input_rates.copy_from_slice(&inputs.rates[..count]);
    }

    /// Why a step could not be taken, a contact beyond its map in forces.
    #[cold]
    pub(in crate::simulation) fn failed(&self, scene: &Scene, cause: StepError) -> SimulationError {
        let cause = match cause {
            StepError::Contact {
                element,
                angle_deg,
                since,
                cause: ContactError::OutOfRange { quantity: MAPPED, value, upper, .. },
                ..
            } if value < 1e3 * upper => {
                let [force, limit] = setup::forces_of([value, upper], scene);
                StepError::BeyondMap { element, angle_deg, force, limit, since }
            }
            other => other,
        };
        SimulationError::Step { time: self.state.time, cause }
    }
}

/// The bearing at the communication point.
#[derive(Debug, Clone)]
pub(in crate::simulation) struct Present {
    /// What acts from outside.
    pub(in crate::simulation) excitation: Excitation,
    /// The right-hand side under it.
    pub(in crate::simulation) evaluation: Evaluation,
    /// Tangent stiffness of the inner ring, −∂F/∂x with the elements in static balance (N/m).
    pub(in crate::simulation) stiffness: [[f64; 5]; 5],
}

impl Present {
    pub(in crate::simulation) fn new(model: &Model) -> Self {
        let (excitation, evaluation) = (Excitation::default(), Evaluation::new(model));
        Self { excitation, evaluation, stiffness: [[0.0; 5]; 5] }
    }

    /// Evaluates the right-hand side under `excitation`. It must not depend on what was computed before, or a restored
    /// state would show other roundings.
    pub(in crate::simulation) fn evaluate(&mut self, Run { model, state, .. }: &Run, excitation: Excitation) {
        let (Evaluation { derivative, forces }, progress) = (&mut self.evaluation, &state.progress);
        forces.shortcuts.forget();
        (forces.defect_lookups, forces.unsolved) = (0, None);
        model.derivative(&excitation, 0.0, &progress.cells, &progress.state, derivative, forces);
        self.excitation = excitation;
    }

    /// The start is a static equilibrium: what rounding leaves of accelerations is none.
    pub(in crate::simulation) fn rest(&mut self, layout: &Layout) {
        let derivative = &mut self.evaluation.derivative;
        for start in [layout.shaft, layout.housing].into_iter().flatten() {
            for slot in Layout::VELOCITIES.into_iter().take(layout.freedom.count()) {
                derivative[start + slot] = 0.0;
            }
        }
        for i in layout.sensor_indices() {
            derivative[i + 1] = 0.0;
        }
    }

    pub(in crate::simulation) fn evaluate_stiffness(&mut self, Run { model, state, .. }: &Run) {
        let (progress, forces) = (&state.progress, &mut self.evaluation.forces);
        let now = model.kinematics(&self.excitation, 0.0, &progress.state);
        let at = (&progress.cells, &*progress.state);
        let in_space = model.stiffness_in_space(&self.excitation, at, &forces.contacts, &mut forces.shortcuts);
        if let Some(stiffness) = in_space {
            self.stiffness = stiffness;
            return;
        }
        let paths = forces.contacts.paths(model, &progress.state);
        let jacobian = model.ring_jacobian(paths, &progress.cells, &now, &mut forces.shortcuts);
        for (row, column) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            self.stiffness[row][column] = -jacobian[(row, column)];
        }
    }

    /// The outputs.
    pub(in crate::simulation) fn outputs<'a>(&'a self, Run { model, state, .. }: &'a Run) -> Outputs<'a> {
        let (Evaluation { derivative, forces }, progress) = (&self.evaluation, &state.progress);
        Outputs {
            model,
            excitation: &self.excitation,
            tau: 0.0,
            state: &progress.state,
            derivative,
            forces,
            sensor_modes: &progress.sensor_modes,
            start: state.angles(),
        }
    }
}
