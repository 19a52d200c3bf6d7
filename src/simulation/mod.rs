//! One bearing that is stepped through time: integrator, variable table, plain state. Does no I/O and reads no clock.
//!
//! This is the whole of what `fmi2` and `fmu-build` see of the model.

mod access;
pub mod arrow;
mod contact_changes;
mod decimation;
mod dependencies;
pub mod derivatives;
pub mod dormand_prince;
mod driving;
pub mod error;
pub mod explicit;
mod failing;
pub mod guid;
mod kernels;
mod knots;
pub mod log_category;
pub mod outputs;
pub mod phase_fitted;
pub mod progress;
pub mod recorder;
pub mod rodas;
pub mod setup;
pub mod state_bytes;
pub mod step_error;
pub mod stepper;
pub mod switching;
pub mod table;
pub mod texts;
mod values;
pub mod variables;

pub use error::{SimulationError, VariableError};
pub use switching::Method;

use crate::contact::map::ContactMap;
use crate::dynamics::drive::{CageAngle, Drive};
use crate::dynamics::forces::{Forces, SMOOTH};
use crate::dynamics::model::Model;
use crate::numerics::plane::Vector;
use crate::scene::{ContactLaw, Scene};
use crate::surface::Surface;
use access::Access;
use derivatives::Change;
use driving::Ended;
use progress::Progress;
use recorder::{Due, Recorder};
use setup::Inputs;
use std::sync::Arc;
use stepper::{Control, Stepper};
use table::Quantity;
use variables::{Causality, Dependencies, Kind, Variable};

/// A bearing that is stepped through time.
///
/// Life: [`new`](Self::new), set parameters and inputs, [`initialize`](Self::initialize), then set inputs and
/// [`step`](Self::step). Reading outputs before `initialize` computes the static equilibrium of the values set so far.
#[derive(Debug, Clone)]
pub struct Simulation {
    scene: Arc<Scene>,
    surface: Option<Arc<Surface>>,
    /// The contact map stored with the scene.
    map: Option<Arc<ContactMap>>,
    /// Shared by clones, as what follows from the table is.
    table: Arc<[Variable]>,
    quantities: Arc<[Quantity]>,
    access: Arc<[Access]>,
    inputs: Inputs,
    /// Values of the table, by index; integers live in `integers`.
    values: Vec<f64>,
    integers: Vec<i32>,
    /// First and second derivatives of inputs for the next step, where the host has given any, by index.
    input_rates: Vec<[Option<f64>; 2]>,
    model: Model,
    stepper: Stepper,
    /// `None` where the scene has no recorder.
    recorder: Option<Recorder>,
    method: Method,
    forces: Forces,
    derivative: Vec<f64>,
    change: Change,
    /// The outer ring's acceleration when outputs were computed last [m/s²].
    present_acceleration: Vector,
    /// Without the variables, which are in `values`, `integers` and `input_rates` while the simulation runs.
    state: State,
    /// Parameters have been set since the model was built.
    model_is_stale: bool,
    /// Parameters or inputs have been set since the equilibrium was found.
    equilibrium_is_stale: bool,
    outputs_are_stale: bool,
    stiffness_is_stale: bool,
}

/// Everything that the future of a [`Simulation`] depends on; taking it and putting it back changes no bit.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    time: f64,
    started: bool,
    cage: CageAngle,
    ended: Ended,
    progress: Progress,
    /// Inputs and parameters, by index; outputs are left at what they were.
    values: Vec<f64>,
    integers: Vec<i32>,
    input_rates: Vec<[Option<f64>; 2]>,
}

impl State {
    /// Copies all but the variables of another state of the same model.
    fn copy_progress(&mut self, other: &State) {
        (self.time, self.started, self.cage, self.ended) = (other.time, other.started, other.cage, other.ended);
        self.progress.copy_from(&other.progress);
    }
}

impl Simulation {
    /// Sets up the scene. `profile` is the text of the defect's profile file, when the scene names one.
    ///
    /// # Errors
    /// An impossible scene or profile.
    pub fn new(scene: Scene, profile: Option<&str>) -> Result<Self, SimulationError> {
        Self::with_map(scene, profile, None)
    }

    /// As [`new`](Self::new), with the bytes of the contact map that was stored for the scene. Without it, law `map`
    /// computes the map on initialization, which takes seconds.
    ///
    /// # Errors
    /// An impossible scene or profile; a map that is damaged or belongs to something else.
    pub fn with_map(scene: Scene, profile: Option<&str>, map: Option<&[u8]>) -> Result<Self, SimulationError> {
        // Without a defect there is nothing to look up.
        let map = map.filter(|_| scene.defect.is_some()).map(ContactMap::decode).transpose()?;
        Self::with_shared_map(scene, profile, map.map(Arc::new))
    }

    /// As [`with_map`](Self::with_map), with a map that others may use as well.
    ///
    /// # Errors
    /// As [`with_map`](Self::with_map).
    pub fn with_shared_map(
        scene: Scene,
        profile: Option<&str>,
        map: Option<Arc<ContactMap>>,
    ) -> Result<Self, SimulationError> {
        scene.check()?;
        let surface =
            scene.defect.as_ref().map(|defect| Surface::load(&defect.shape, profile, &scene.bearing)).transpose()?;
        let (table, quantities): (Vec<_>, Vec<_>) = table::rows(&scene).into_iter().unzip();
        let access = table.iter().zip(&quantities).map(|(row, &quantity)| Access::new(row, quantity)).collect();
        let (values, integers) = setup::start_values(&table);
        let map = map.filter(|_| surface.is_some());
        if let (Some(surface), Some(map)) = (&surface, &map) {
            map.check_fingerprint(setup::map_fingerprint(&scene, surface))?;
        }
        // What takes long is left to the initialization: the host may change parameters before it.
        let model_is_stale = match scene.contact.law {
            ContactLaw::Hertz => false,
            ContactLaw::Map => map.is_none(),
            ContactLaw::Love => true,
        } && surface.is_some();
        let model = setup::build_model(&scene, surface.as_ref().filter(|_| !model_is_stale), map.as_ref())?;
        let recorder = Recorder::of(&scene, &table, &quantities);
        let progress = Progress::new(model.layout.len, model.element_count, under_way(&recorder));
        let inputs = Inputs::new(&quantities, table.iter().take_while(|v| v.causality == Causality::Input).count());
        let input_rates = vec![[None; 2]; inputs.count];
        Ok(Self {
            inputs,
            stepper: Stepper::new(&model),
            recorder,
            method: Method::Automatic,
            forces: Forces::new(model.element_count),
            derivative: vec![0.0; model.layout.len],
            change: Change::new(model.element_count),
            present_acceleration: Vector::zeros(),
            state: State {
                time: 0.0,
                started: false,
                cage: CageAngle::new(scene.cage.initial_angle),
                ended: Ended::default(),
                progress,
                values: Vec::new(),
                integers: Vec::new(),
                input_rates: Vec::new(),
            },
            scene: Arc::new(scene),
            surface: surface.map(Arc::new),
            map,
            table: table.into(),
            access,
            quantities: quantities.into(),
            values,
            integers,
            input_rates,
            model,
            model_is_stale,
            equilibrium_is_stale: true,
            outputs_are_stale: true,
            stiffness_is_stale: true,
        })
    }

    /// The variables, ordered by value reference, which is the index.
    pub fn table(&self) -> &[Variable] {
        &self.table
    }

    /// Value reference of the variable of this name.
    ///
    /// # Errors
    /// The scene has no such variable.
    pub fn reference(&self, name: &str) -> Result<u32, VariableError> {
        let variable = self.table.iter().find(|variable| variable.name == name);
        variable.map(|variable| variable.reference).ok_or_else(|| VariableError::UnknownName(name.to_owned()))
    }

    /// What each output depends on, in the order of the table.
    pub fn dependencies(&self) -> Vec<Dependencies> {
        dependencies::of(&self.table, &self.quantities, &self.scene)
    }

    /// The scene as it was set up.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Time [s].
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Chooses the integration method, for studies; automatic unless this is called. No part of the state.
    pub fn set_method(&mut self, method: Method) {
        self.method = method;
        // What is stable is to be looked at anew: it was for another method.
        self.state.progress.choice.stable_step = 0.0;
    }

    /// Accepted integration steps so far, and how many of them the implicit method took.
    pub fn step_counts(&self) -> (u64, u64) {
        (self.state.progress.steps, self.state.progress.implicit_steps)
    }

    /// The recorder, if the scene has one and the host has given it a folder.
    pub fn recorder(&self) -> Option<&Recorder> {
        self.recorder.as_ref().filter(|recorder| recorder.is_on())
    }

    /// Gives the recorder a folder; an empty one switches it off. Does nothing where the scene has no recorder.
    pub fn record_into(&mut self, folder: &str) {
        if let Some(recorder) = &mut self.recorder {
            folder.clone_into(&mut recorder.folder);
        }
    }

    /// Drops the rows kept in the recorder, once they have been stored.
    pub fn forget_samples(&mut self) {
        if let Some(recorder) = &mut self.recorder {
            recorder.forget(&self.state.progress.due);
        }
    }

    /// The equations of motion and what acts from outside from now on, for studies that integrate them themselves.
    pub fn equations(&self) -> (&Model, Drive) {
        (&self.model, self.drive(true))
    }

    /// The state vector, laid out as [`crate::dynamics::model::Layout`] says.
    pub fn state_vector(&self) -> &[f64] {
        &self.state.progress.state
    }

    /// Solves the static equilibrium at `start` [s] and ends the setting of parameters.
    pub fn initialize(&mut self, start: f64) -> Result<(), SimulationError> {
        self.find_equilibrium()?;
        self.state.time = start;
        self.state.started = true;
        self.forget_samples();
        self.outputs_are_stale = true;
        self.stiffness_is_stale = true;
        Ok(())
    }

    /// Advances by exactly `step` [s].
    pub fn step(&mut self, step: f64) -> Result<(), SimulationError> {
        if !(step > 0.0 && step.is_finite()) {
            return Err(SimulationError::CommunicationStep(step));
        }
        if !self.state.started {
            return Err(SimulationError::NotInitialized);
        }
        let drive = self.drive(true);
        let control = Control {
            tolerance: self.inputs.tolerance.map_or(self.scene.tolerance, |i| self.values[i]),
            max_steps: self.scene.max_steps,
            method: self.method,
        };
        self.outputs_are_stale = true;
        self.stiffness_is_stale = true;
        self.model.forget_contacts();
        let mut recorder = self.recorder.as_mut().filter(|recorder| recorder.is_on());
        match &mut recorder {
            Some(recorder) => recorder.begin(self.state.time, self.state.cage.total()),
            // What is not sampled cannot be made up for: whoever records on from here begins anew.
            None => self.state.progress.due = Due::default(),
        }
        let time = self.state.time;
        self.stepper
            .advance(&self.model, &drive, control, step, &mut self.state.progress, recorder)
            .map_err(|cause| SimulationError::Step { time, cause })?;
        self.state.cage = self.state.cage.advanced(drive.cage.at(step));
        self.state.time += step;
        self.follow_prescribed_motion(&drive, step);
        Ok(())
    }

    /// Takes the state.
    pub fn save(&self) -> State {
        State {
            values: self.values.clone(),
            integers: self.integers.clone(),
            input_rates: self.input_rates.clone(),
            ..self.state.clone()
        }
    }

    /// Takes the state over one taken earlier of this same model; allocates nothing.
    pub fn save_into(&self, state: &mut State) {
        state.copy_progress(&self.state);
        state.values.copy_from_slice(&self.values);
        state.integers.copy_from_slice(&self.integers);
        state.input_rates.copy_from_slice(&self.input_rates);
    }

    /// Puts a state of this same model back. An error leaves the simulation in need of another state or of a rebuild.
    pub fn restore(&mut self, state: &State) -> Result<(), SimulationError> {
        let parameters_differ = self.table.iter().enumerate().any(|(i, variable)| {
            variable.causality == Causality::Parameter
                && (self.values[i].to_bits() != state.values[i].to_bits() || self.integers[i] != state.integers[i])
        });
        self.model_is_stale |= parameters_differ;
        self.values.copy_from_slice(&state.values);
        self.integers.copy_from_slice(&state.integers);
        self.input_rates.copy_from_slice(&state.input_rates);
        self.state.copy_progress(state);
        if let Some(recorder) = &mut self.recorder {
            recorder.rewind(&self.state.progress.due);
        }
        self.equilibrium_is_stale = true;
        self.outputs_are_stale = true;
        self.stiffness_is_stale = true;
        // Before the start, the equilibrium rebuilds the model when it is asked for.
        if !self.state.started {
            return Ok(());
        }
        self.rebuild()?;
        let cells = self.model.defect.as_ref().map_or(0, |(near, _)| near.knots().len().saturating_sub(1));
        if self.state.progress.cells.iter().all(|&cell| cell == SMOOTH || (cell as usize) < cells) {
            Ok(())
        } else {
            Err(SimulationError::ForeignState)
        }
    }

    /// Rebuilds the model if parameters were set, and finds the equilibrium.
    fn find_equilibrium(&mut self) -> Result<(), SimulationError> {
        self.rebuild()?;
        let angle = setup::parameter(&self.quantities, &self.values, Quantity::CageInitialAngle);
        self.state.cage = CageAngle::new(angle.unwrap_or(self.scene.cage.initial_angle));
        let drive = self.drive(false);
        let cage_angle = drive.cage_angle(0.0);
        let progress = &mut self.state.progress;
        *progress = Progress::new(self.model.layout.len, self.model.element_count, under_way(&self.recorder));
        for j in 0..self.model.element_count {
            progress.cells[j] = self.model.cell_at(j, cage_angle);
        }
        self.model.equilibrium(&drive, &progress.cells, &mut progress.state)?;
        self.model.forget_contacts();
        self.model.derivative(&drive, 0.0, &progress.cells, &progress.state, &mut self.derivative, &mut self.forces);
        self.forces.note_pushing(&mut progress.pushing);
        let (shaft, housing) = (self.forces.shaft(), self.forces.housing());
        progress.mean_force = [shaft.x, shaft.y, housing.x, housing.y];
        self.equilibrium_is_stale = false;
        Ok(())
    }

    fn rebuild(&mut self) -> Result<(), SimulationError> {
        if !self.model_is_stale {
            return Ok(());
        }
        let scene = setup::with_parameters(&self.scene, &self.quantities, &self.values, &self.integers)?;
        self.model = setup::build_model(&scene, self.surface.as_deref(), self.map.as_ref())?;
        self.model_is_stale = false;
        Ok(())
    }
}

/// Length of the rows that a recorder has under way.
fn under_way(recorder: &Option<Recorder>) -> usize {
    recorder.as_ref().map_or(0, Recorder::under_way)
}
