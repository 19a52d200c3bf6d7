//! One bearing that is stepped through time: integrator, variable table, plain state. Does no I/O and reads no clock.
//!
//! This is the whole of what `fmi2` and `fmu-build` see of the model.

pub mod variables;

use crate::scene::Scene;
use variables::Variable;

/// What goes wrong in setting up or stepping a bearing. Each message names the quantity, its value and the limit.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SimulationError {
    /// A variable was addressed wrongly or given a value that it cannot have. Nothing was changed.
    #[error(transparent)]
    Variable(#[from] VariableError),
    /// A communication step that cannot be taken. Nothing was changed.
    #[error("communication step {0} s: it must be finite and above 0")]
    CommunicationStep(f64),
    /// Not built yet.
    #[error("not built yet")]
    NotBuilt,
}

/// A variable was addressed wrongly or given a value that it cannot have. Nothing was changed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VariableError {
    /// No such reference.
    #[error("value reference {0}: this model's references end at {1}")]
    UnknownReference(u32, u32),
    /// The variable has another type.
    #[error("variable {name} (value reference {reference}) is not of type {wanted}")]
    WrongType {
        /// Its name.
        name: String,
        /// Its reference.
        reference: u32,
        /// Type of the call.
        wanted: &'static str,
    },
    /// An output, or a parameter after initialization.
    #[error("variable {name} cannot be set: {why}")]
    NotSettable {
        /// Its name.
        name: String,
        /// The reason.
        why: &'static str,
    },
    /// A value outside its range, or not finite.
    #[error("variable {name}: {value} is outside {min} … {max}")]
    OutOfRange {
        /// Its name.
        name: String,
        /// The value given.
        value: f64,
        /// Smallest value allowed.
        min: f64,
        /// Largest value allowed.
        max: f64,
    },
}

/// A bearing that is stepped through time.
///
/// Life: [`new`](Self::new), set parameters and inputs, [`initialize`](Self::initialize), then set inputs and
/// [`step`](Self::step). Reading outputs before `initialize` computes the static equilibrium of the values set so far.
#[derive(Debug, Clone)]
pub struct Simulation {
    table: Vec<Variable>,
    time: f64,
}

/// Everything that the future of a [`Simulation`] depends on; taking it and putting it back changes no bit.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    time: f64,
}

impl Simulation {
    /// Sets up the scene. `profile` is the text of the defect's profile file, when the scene names one.
    pub fn new(_scene: Scene, _profile: Option<&str>) -> Result<Self, SimulationError> {
        Ok(Self { table: Vec::new(), time: 0.0 })
    }

    /// The variables, ordered by value reference, which is the index.
    pub fn table(&self) -> &[Variable] {
        &self.table
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Sets reals; all or none. Inputs at any time, parameters before `initialize`.
    pub fn set_reals(&mut self, _references: &[u32], _values: &[f64]) -> Result<(), VariableError> {
        Ok(())
    }

    /// Reads reals. Outputs are computed if something has changed since they were last.
    pub fn reals(&mut self, _references: &[u32], _values: &mut [f64]) -> Result<(), SimulationError> {
        Err(SimulationError::NotBuilt)
    }

    /// Sets integers (the enumeration `contact.law`); all or none; before `initialize`.
    pub fn set_integers(&mut self, _references: &[u32], _values: &[i32]) -> Result<(), VariableError> {
        Ok(())
    }

    /// Reads integers and enumerations.
    pub fn integers(&mut self, _references: &[u32], _values: &mut [i32]) -> Result<(), SimulationError> {
        Err(SimulationError::NotBuilt)
    }

    /// Derivative of order 1 or 2 of real inputs, valid through the next step; all or none.
    pub fn set_input_derivatives(
        &mut self,
        _references: &[u32],
        _orders: &[i32],
        _values: &[f64],
    ) -> Result<(), VariableError> {
        Ok(())
    }

    /// Solves the static equilibrium at `start` [s] and ends the setting of parameters.
    pub fn initialize(&mut self, _start: f64) -> Result<(), SimulationError> {
        Err(SimulationError::NotBuilt)
    }

    /// Advances by exactly `step` [s].
    pub fn step(&mut self, _step: f64) -> Result<(), SimulationError> {
        Err(SimulationError::NotBuilt)
    }

    /// Takes the state.
    pub fn save(&self) -> State {
        State { time: self.time }
    }

    /// Puts a state of this same model back.
    pub fn restore(&mut self, _state: &State) {}
}
