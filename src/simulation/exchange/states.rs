//! The continuous states: where they are kept, and how they change.

use super::part::{Derivative, Part};
use crate::dynamics::parameters::WholeAngle;
use crate::numerics::lanes::QUAD;
use crate::simulation::integration::{Problem, check_rings};
use crate::simulation::run::UpToDate;
use crate::simulation::{Simulation, SimulationError, StepError};

/// Where a continuous state is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// A slot of the state vector.
    Slot(usize),
    /// A slot of the modes under sensors.
    Mode(usize),
    /// The angle of the nominal cage.
    Cage,
    /// The angle of a frame of defects.
    Frame(usize),
}

impl Simulation {
    /// The continuous states, in their order.
    pub(super) fn places(&self) -> impl Iterator<Item = Place> + use<> {
        let layout = self.run.model.layout;
        let slots = (0..layout.len).filter(move |&i| layout.is_integrated(i)).map(Place::Slot);
        let modes = (0..self.run.model.sensor_modes.state_len()).map(Place::Mode);
        let frames = if self.interface.inputs.frames { 0..3 } else { 0..0 };
        slots.chain(modes).chain([Place::Cage]).chain(frames.map(Place::Frame))
    }

    /// Number of continuous states.
    pub fn continuous_state_count(&self) -> usize {
        self.places().count()
    }

    /// Sets the time (s), which nothing depends on.
    pub fn set_time(&mut self, time: f64) {
        self.run.state.time = time;
    }

    /// The continuous states.
    ///
    /// # Errors
    /// Before `initialize`: an equilibrium that does not exist.
    pub fn continuous_states(&mut self, values: &mut [f64]) -> Result<(), SimulationError> {
        if !self.run.state.started {
            self.refresh()?;
        }
        let state = &self.run.state;
        for (value, place) in values.iter_mut().zip(self.places()) {
            *value = match place {
                Place::Slot(i) => state.progress.state[i],
                Place::Mode(i) => state.progress.sensor_modes[i],
                Place::Cage => state.cage.total(),
                Place::Frame(i) => state.frames[i].total(),
            };
        }
        Ok(())
    }

    /// Sets the continuous states; numbers that are finite.
    pub fn set_continuous_states(&mut self, values: &[f64]) {
        let places = self.places();
        let state = &mut self.run.state;
        for (&value, place) in values.iter().zip(places) {
            match place {
                Place::Slot(i) => state.progress.state[i] = value,
                Place::Mode(i) => state.progress.sensor_modes[i] = value,
                Place::Cage => state.cage = WholeAngle::new(value),
                Place::Frame(i) => state.frames[i] = WholeAngle::new(value),
            }
        }
        self.invalidate(UpToDate::State);
    }

    /// Their derivatives by time.
    ///
    /// # Errors
    /// A state that no contact law has an answer for: an integrator tries such states, and takes a shorter step.
    pub fn state_derivatives(&mut self, values: &mut [f64]) -> Result<(), SimulationError> {
        self.refresh()?;
        self.check_contacts()?;
        let (excitation, layout) = (self.excitation(false), self.run.model.layout);
        let progress = &self.run.state.progress;
        let body = |sensor: usize| self.present.evaluation.derivative[layout.sensors + sensor * QUAD + 1];
        for (value, place) in values.iter_mut().zip(self.places()) {
            *value = match place {
                Place::Slot(i) => self.present.evaluation.derivative[i],
                Place::Mode(i) => self.run.model.sensor_modes.slope(i, body, &progress.sensor_modes),
                Place::Cage => excitation.cage.0[1],
                Place::Frame(i) => excitation.frames[i].since.0[1],
            };
        }
        Ok(())
    }

    /// Orders of magnitude of the continuous states.
    pub fn state_nominals(&self, values: &mut [f64]) {
        for (value, place) in values.iter_mut().zip(self.places()) {
            *value = self.nominal(place);
        }
    }

    pub(super) fn nominal(&self, place: Place) -> f64 {
        const POSITION: f64 = 1e-5;
        const VELOCITY: f64 = 1e-2;
        // Those of the inputs of the same kind.
        const TILT: f64 = 1e-3;
        const TILTING: f64 = 1.0;
        match place {
            Place::Slot(i) => match Part::of(&self.run.model.layout, i) {
                Some(Part::Ring(_, 3.., Derivative::Position)) => TILT,
                Some(Part::Ring(_, 3.., Derivative::Rate)) => TILTING,
                _ if self.run.model.layout.is_position(i) => POSITION,
                _ => VELOCITY,
            },
            Place::Mode(i) => [POSITION, VELOCITY][i % 2],
            Place::Cage | Place::Frame(_) => 1.0,
        }
    }

    /// Takes the states as they are for a step that the integrator has accepted.
    ///
    /// # Errors
    /// What a step of its own would fail of: rings beside each other, an element outside the bearing, a contact without
    /// an answer.
    pub fn accept_states(&mut self) -> Result<(), SimulationError> {
        self.refresh()?;
        self.check_contacts()?;
        let excitation = self.excitation(false);
        let failed = |cause| SimulationError::Step { time: self.run.state.time, cause };
        check_rings(Problem { model: &self.run.model, excitation: &excitation }, 0.0, &self.run.state.progress)
            .map_err(failed)?;
        let (paths, limit) =
            (&self.run.state.progress.state[..self.run.model.element_count], self.run.model.element_radius);
        if let Some(j) = paths.iter().position(|path| path.abs() > limit) {
            return Err(failed(StepError::ThrownOut { element: j + 1, path: paths[j], limit, since: 0.0 }));
        }
        // Where the search for the next balance begins.
        self.present.evaluation.forces.settle(&self.run.model, &mut self.run.state.progress.state);
        Ok(())
    }

    fn check_contacts(&mut self) -> Result<(), SimulationError> {
        let Some(unsolved) = self.present.evaluation.forces.unsolved.take() else { return Ok(()) };
        // What is computed next is to find it again.
        self.invalidate(UpToDate::State);
        let (element, angle_deg) = (unsolved.element + 1, unsolved.angle.to_degrees());
        let cause =
            StepError::Contact { element, angle_deg, offset: unsolved.offset, since: 0.0, cause: unsolved.cause };
        Err(SimulationError::Step { time: self.run.state.time, cause })
    }
}
