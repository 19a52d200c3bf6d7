//! A communication step, at once or one integration step after the other.
//!
//! Between two integration steps one may *inspect* it: the simulation then stands where the step has come to, as if it
//! ended there, and shows its outputs. That changes no bit of what follows. Whoever sets an input meanwhile ends the
//! part of the step before, and begins another with the inputs as they are.

mod host_inputs;

use super::excitation;
use super::life::{Simulation, UpToDate};
use super::state::Ended;
use crate::dynamics::parameters::{Excitation, WholeAngle};
use crate::simulation::Method;
use crate::simulation::error::SimulationError;
use crate::simulation::integration::{Advance, Control, Problem, Stepper};
use crate::simulation::recorder::Due;
use crate::simulation::step_error::StepError;

/// Speeds of both rings, and position, velocity and acceleration of each along two axes.
const MOST_INPUTS: usize = 2 + 2 * 6;

/// Inputs with their derivatives; slots beyond the last input are not used.
#[derive(Debug, Clone, Copy, PartialEq)]
struct InputValues {
    values: [f64; MOST_INPUTS],
    rates: [[Option<f64>; 2]; MOST_INPUTS],
}

/// A communication step that has begun.
#[derive(Debug, Clone)]
pub struct StepUnderWay {
    excitation: Excitation,
    control: Control,
    advance: Advance,
}

/// An inspection of where a step has come to: what the simulation has to forget of it.
#[derive(Debug)]
#[must_use = "the step goes on from `resume`"]
pub struct Inspection {
    time: f64,
    cage: WholeAngle,
    frames: [WholeAngle; 3],
    ended: Ended,
    inputs: InputValues,
    /// The inputs where the step has brought them.
    arrived: InputValues,
}

impl StepUnderWay {
    /// Whether it has come to its end.
    pub fn is_done(&self) -> bool {
        self.advance.is_done()
    }

    /// How far it has come (s).
    pub fn elapsed(&self) -> f64 {
        self.advance.elapsed()
    }

    /// Lets it end `elapsed` (s) after its beginning, if that is earlier than it would, and no earlier than where it
    /// is.
    pub fn shorten_to(&mut self, elapsed: f64) {
        self.advance.shorten_to(elapsed);
    }
}

impl Simulation {
    /// Advances by exactly `step` (s).
    pub fn step(&mut self, step: f64) -> Result<(), SimulationError> {
        self.take_inputs(step);
        let excitation = self.advance(step)?;
        self.note_step(&excitation, step);
        Ok(())
    }

    /// Advances by `step` (s) under the inputs as they are. Gives how they went on.
    #[inline]
    pub(super) fn advance(&mut self, step: f64) -> Result<Excitation, SimulationError> {
        let (control, excitation) = self.prepare(step)?;
        let advanced = self.stepper(&excitation, control).advance(step);
        advanced.map_err(|cause| self.failed(cause))?;
        self.commit(&excitation, step);
        Ok(excitation)
    }

    /// Begins a communication step of `step` (s).
    /// ```
    /// use brinell::scene::{Bearing, Scene};
    /// use brinell::simulation::Simulation;
    ///
    /// let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3); let scene =
    /// Scene::builder(bearing).shaft_speed(157.1).shaft_load([0.0, -1500.0]).build()?; let mut simulation =
    /// Simulation::new(scene, None)?; simulation.initialize(0.0)?; // A step in parts, watched, and ended where the
    /// load on element 1 is gone. let force = simulation.reference("element[1].force.outer")?; let mut under_way =
    /// simulation.begin_step(1e-2)?; while !under_way.is_done() {
    ///     simulation.advance_once(&mut under_way)?;
    ///     let inspection = simulation.inspect(&under_way);
    ///     let mut value = [0.0];
    ///     simulation.reals(&[force], &mut value)?;
    ///     simulation.resume(&mut under_way, inspection)?;
    ///     if value[0] == 0.0 {
    ///         break;
    ///     }
    /// } simulation.end_step(under_way); assert!(simulation.time() <= 1e-2);
    /// # Ok::<(), brinell::Error>(())
    /// ```
    ///
    /// # Errors
    /// A step that is not finite and above 0, or before `initialize`; what cannot be integrated.
    pub fn begin_step(&mut self, step: f64) -> Result<StepUnderWay, SimulationError> {
        self.take_inputs(step);
        self.begin_part(step)
    }

    /// Begins a step, or goes on with one under other inputs.
    fn begin_part(&mut self, step: f64) -> Result<StepUnderWay, SimulationError> {
        let (control, excitation) = self.prepare(step)?;
        let begun = self.stepper(&excitation, control).start(step);
        let advance = begun.map_err(|cause| self.failed(cause))?;
        Ok(StepUnderWay { excitation, control, advance })
    }

    /// Takes one integration step of a communication step.
    ///
    /// # Errors
    /// What cannot be integrated; the communication step is then lost.
    pub fn advance_once(&mut self, under_way: &mut StepUnderWay) -> Result<(), SimulationError> {
        let StepUnderWay { excitation, control, advance } = under_way;
        let taken = self.stepper(excitation, *control).advance_once(advance);
        taken.map_err(|cause| self.failed(cause))
    }

    /// Ends a communication step where it has come to.
    pub fn end_step(&mut self, under_way: StepUnderWay) {
        let StepUnderWay { excitation, control, advance } = under_way;
        self.stepper(&excitation, control).finish(&advance);
        self.commit(&excitation, advance.tau);
        self.note_step(&excitation, advance.tau);
    }

    /// Stands where a step has come to, as it would if it ended there, except for what belongs to the step as a whole:
    /// mean forces and counts. Until [`resume`](Self::resume) outputs and their derivatives may be read and inputs be
    /// set, no more.
    pub fn inspect(&mut self, under_way: &StepUnderWay) -> Inspection {
        let state = &self.state;
        let (time, cage, frames, ended) = (state.time, state.cage, state.frames, state.ended);
        let inputs = self.input_values();
        // Nobody looks ahead from within a step.
        self.ahead.force = Some(self.state.progress.mean_force);
        self.commit(&under_way.excitation, under_way.advance.tau);
        Inspection { time, cage, frames, ended, inputs, arrived: self.input_values() }
    }

    /// Ends an inspection. If inputs have been set to other values than the step had brought them to, they act from
    /// here on.
    ///
    /// # Errors
    /// What cannot be integrated from here on.
    pub fn resume(&mut self, under_way: &mut StepUnderWay, inspection: Inspection) -> Result<(), SimulationError> {
        self.up_to_date = UpToDate::State;
        if self.input_values() != inspection.arrived && !under_way.is_done() {
            let StepUnderWay { excitation, control, advance } = &*under_way;
            self.stepper(excitation, *control).finish_part(advance);
            let mut next = self.begin_part(advance.end - advance.tau)?;
            next.advance.follow(advance);
            *under_way = next;
            return Ok(());
        }
        let count = self.inputs.count;
        let state = &mut self.state;
        (state.time, state.cage, state.frames, state.ended) =
            (inspection.time, inspection.cage, inspection.frames, inspection.ended);
        state.reals[..count].copy_from_slice(&inspection.inputs.values[..count]);
        state.input_rates.copy_from_slice(&inspection.inputs.rates[..count]);
        Ok(())
    }

    /// Checks a step, and readies for it what goes along with the integration.
    #[inline]
    fn prepare(&mut self, step: f64) -> Result<(Control, Excitation), SimulationError> {
        if !(step > 0.0 && step.is_finite()) {
            return Err(SimulationError::CommunicationStep(step));
        }
        if !self.state.started {
            return Err(SimulationError::NotInitialized);
        }
        self.up_to_date = UpToDate::State;
        self.ahead.force = None;
        let excitation = self.excitation(true);
        // The speed goes straight, so that films are thickest at an end.
        for tau in [0.0, step] {
            self.check_films(&excitation, tau)?;
        }
        self.workspace.forces.shortcuts.forget();
        match self.recorder.as_mut().filter(|recorder| recorder.is_on()) {
            Some(recorder) => recorder.begin(self.state.time, self.state.angles()),
            // What is not sampled cannot be made up for: whoever records on from here begins anew.
            None => self.state.progress.due = Due::default(),
        }
        let method = match self.method {
            Method::Automatic | Method::Rodas if self.model.elements_in_balance() => Method::Explicit,
            method => method,
        };
        let control = Control {
            tolerance: self.inputs.tolerance.map_or(self.scene.tolerance, |i| self.state.reals[i]),
            max_steps: self.scene.max_steps,
            method,
        };
        Ok((control, excitation))
    }

    #[inline]
    fn stepper<'a>(&'a mut self, excitation: &'a Excitation, control: Control) -> Stepper<'a> {
        Stepper {
            problem: Problem { model: &self.model, excitation },
            control,
            workspace: &mut self.workspace,
            progress: &mut self.state.progress,
            recorder: self.recorder.as_mut().filter(|recorder| recorder.is_on()),
        }
    }

    /// Time, angles and inputs move on by `step` (s).
    #[inline]
    fn commit(&mut self, excitation: &Excitation, step: f64) {
        self.state.cage = self.state.cage.advanced(excitation.cage.at(step));
        if self.inputs.frames {
            for (angle, turning) in self.state.frames.iter_mut().zip(&excitation.frames) {
                *angle = angle.advanced(turning.since.at(step));
            }
        }
        self.state.time += step;
        excitation::follow(&mut self.state, &self.inputs, &self.model.ratios, excitation, step);
    }

    fn input_values(&self) -> InputValues {
        let count = self.inputs.count;
        let mut inputs = InputValues { values: [0.0; MOST_INPUTS], rates: [[None; 2]; MOST_INPUTS] };
        inputs.values[..count].copy_from_slice(&self.state.reals[..count]);
        inputs.rates[..count].copy_from_slice(&self.state.input_rates);
        inputs
    }

    fn failed(&self, cause: StepError) -> SimulationError {
        SimulationError::Step { time: self.state.time, cause }
    }
}
