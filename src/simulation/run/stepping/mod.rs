//! A communication step, at once or one integration step after the other.
//!
//! Between two integration steps one may *inspect* it: the simulation then stands where the step has come to, as if it
//! ended there, and shows its outputs. That changes no bit of what follows. Whoever sets an input meanwhile ends the
//! part of the step before, and begins another with the inputs as they are.

mod host_inputs;
mod lost_in_coupling;

use super::life::{Simulation, UpToDate};
use super::running::InputValues;
use super::state::Ended;
use crate::dynamics::parameters::{Excitation, WholeAngle};
use crate::simulation::error::SimulationError;
use crate::simulation::integration::{Advance, Control};
use crate::simulation::interface::value_access::SECOND;

/// A communication step that has begun.
#[derive(Debug, Clone)]
pub struct StepUnderWay {
    excitation: Excitation,
    control: Control,
    advance: Advance,
    /// Whether rings have been moved inside it.
    is_moved: bool,
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
        self.note_coupling(&excitation, step);
        Ok(())
    }

    /// Advances by `step` (s) under the inputs as they are. Gives how they went on.
    #[inline]
    pub(super) fn advance(&mut self, step: f64) -> Result<Excitation, SimulationError> {
        let Begun { excitation, control, is_evaluated } = self.prepare(step)?;
        let known = is_evaluated.then_some(&self.present.evaluation);
        let advanced = self.run.stepper(&excitation, control, known).advance(step);
        advanced.map_err(|cause| self.run.failed(&self.setup.scene, cause))?;
        self.run.commit(&self.interface.inputs, &excitation, step);
        Ok(excitation)
    }

    /// Begins a communication step of `step` (s).
    /// ```
    /// use brinell::scene::{Bearing, Scene};
    /// use brinell::simulation::Simulation;
    ///
    /// let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
    /// let scene = Scene::builder(bearing).shaft_speed(157.1).shaft_load([0.0, -1500.0]).build()?;
    /// let mut simulation = Simulation::new(scene, None)?;
    /// simulation.initialize(0.0)?;
    /// // A step in parts, watched, and ended where the load on element 1 is gone.
    /// let force = simulation.reference("element[1].force.outer")?;
    /// let mut under_way = simulation.begin_step(1e-2)?;
    /// while !under_way.is_done() {
    ///     simulation.advance_once(&mut under_way)?;
    ///     let inspection = simulation.inspect(&under_way);
    ///     let mut value = [0.0];
    ///     simulation.reals(&[force], &mut value)?;
    ///     simulation.resume(&mut under_way, inspection)?;
    ///     if value[0] == 0.0 {
    ///         break;
    ///     }
    /// }
    /// simulation.end_step(under_way);
    /// assert!(simulation.time() <= 1e-2);
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
        let Begun { excitation, control, is_evaluated } = self.prepare(step)?;
        let known = is_evaluated.then_some(&self.present.evaluation);
        let begun = self.run.stepper(&excitation, control, known).start(step);
        let advance = begun.map_err(|cause| self.run.failed(&self.setup.scene, cause))?;
        Ok(StepUnderWay { excitation, control, advance, is_moved: false })
    }

    /// Takes one integration step of a communication step.
    ///
    /// # Errors
    /// What cannot be integrated; the communication step is then lost.
    pub fn advance_once(&mut self, under_way: &mut StepUnderWay) -> Result<(), SimulationError> {
        let StepUnderWay { excitation, control, advance, .. } = under_way;
        let taken = self.run.stepper(excitation, *control, None).advance_once(advance);
        taken.map_err(|cause| self.run.failed(&self.setup.scene, cause))
    }

    /// Ends a communication step where it has come to.
    pub fn end_step(&mut self, under_way: StepUnderWay) {
        let StepUnderWay { excitation, control, advance, is_moved } = under_way;
        self.run.stepper(&excitation, control, None).finish(&advance);
        self.run.commit(&self.interface.inputs, &excitation, advance.tau);
        self.note_step(&excitation, advance.tau);
        if is_moved {
            self.interrupt_coupling();
        } else {
            self.note_coupling(&excitation, advance.tau);
        }
    }

    /// Stands where a step has come to, as it would if it ended there, except for what belongs to the step as a whole:
    /// mean forces and counts. Until [`resume`](Self::resume) outputs and their derivatives may be read and inputs be
    /// set, no more.
    pub fn inspect(&mut self, under_way: &StepUnderWay) -> Inspection {
        let state = &self.run.state;
        let (time, cage, frames, ended) = (state.time, state.cage, state.frames, state.ended);
        let inputs = self.run.input_values();
        // Nobody looks ahead from within a step.
        self.ahead.foreseen.force = Some(self.run.state.progress.mean_force);
        self.run.commit(&self.interface.inputs, &under_way.excitation, under_way.advance.tau);
        Inspection { time, cage, frames, ended, inputs, arrived: self.run.input_values() }
    }

    /// Ends an inspection. If inputs have been set to other values than the step had brought them to, they act from
    /// here on.
    ///
    /// # Errors
    /// What cannot be integrated from here on.
    pub fn resume(&mut self, under_way: &mut StepUnderWay, inspection: Inspection) -> Result<(), SimulationError> {
        self.up_to_date = UpToDate::State;
        if self.run.input_values() != inspection.arrived && !under_way.is_done() {
            // Its rings are moved inside the step.
            self.note_wiring(SECOND);
            let StepUnderWay { excitation, control, advance, .. } = &*under_way;
            self.run.stepper(excitation, *control, None).finish_part(advance);
            let mut next = self.begin_part(advance.end - advance.tau)?;
            next.advance.follow(advance);
            next.is_moved = true;
            *under_way = next;
            return Ok(());
        }
        let state = &mut self.run.state;
        (state.time, state.cage, state.frames, state.ended) =
            (inspection.time, inspection.cage, inspection.frames, inspection.ended);
        self.run.set_inputs(&inspection.inputs);
        Ok(())
    }

    /// Checks a step, and readies for it what goes along with the integration.
    #[inline]
    fn prepare(&mut self, step: f64) -> Result<Begun, SimulationError> {
        if !(step > 0.0 && step.is_finite()) {
            return Err(SimulationError::CommunicationStep(step));
        }
        if !self.run.state.started {
            return Err(SimulationError::NotInitialized);
        }
        let is_evaluated = self.begins_evaluated();
        let excitation = if is_evaluated { self.present.excitation } else { self.excitation(true) };
        self.up_to_date = UpToDate::State;
        self.ahead.before = std::mem::take(&mut self.ahead.foreseen);
        // The speed goes straight, so that films are thickest at an end.
        for tau in [0.0, step] {
            self.setup.check_films(&self.run.model, &excitation, tau)?;
        }
        self.run.begin();
        Ok(Begun { excitation, control: self.run.control(&self.setup.scene, &self.interface.inputs), is_evaluated })
    }
}

/// What a communication step begins with.
struct Begun {
    excitation: Excitation,
    control: Control,
    /// Whether the right-hand side is that of the present.
    is_evaluated: bool,
}
