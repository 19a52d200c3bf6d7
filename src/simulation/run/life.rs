//! One bearing from its scene on: its life from setting up to stepping, and its state taken and put back.

use super::excitation;
use super::state::{Ahead, Ended, FirstInputs, History, State};
use crate::contact::map::ContactMaps;
use crate::dynamics::contacts::{Forces, Shortcuts};
use crate::dynamics::parameters::{Cells, Excitation, Model, WholeAngle};
use crate::numerics::plane::Vector;
use crate::scene::{ContactLaw, Scene, nearest};
use crate::simulation::Method;
use crate::simulation::error::{SimulationError, VariableError};
use crate::simulation::integration::{Progress, StepCounts, Workspace};
use crate::simulation::interface::table::{Causality, Dependencies, Variable, rows};
use crate::simulation::interface::{Access, Change, Inputs, Parameter, Quantity, RingName, dependencies};
use crate::simulation::recorder::Recorder;
use crate::simulation::setup::{self, arranged};
use crate::surface::{Surface, with_roller_profile};
use std::f64::consts::TAU;
use std::sync::Arc;

/// A bearing that is stepped through time.
///
/// Life: [`new`](Self::new), set parameters and inputs, [`initialize`](Self::initialize), then set inputs and
/// [`step`](Self::step). Reading outputs before `initialize` computes the static equilibrium of the values set so far.
#[derive(Debug, Clone)]
pub struct Simulation {
    pub(super) scene: Arc<Scene>,
    pub(super) surfaces: Arc<[Surface]>,
    /// The contact maps stored with the scene.
    pub(super) map: Option<Arc<ContactMaps>>,
    /// Shared by clones, as what follows from the table is.
    pub(in crate::simulation) table: Arc<[Variable]>,
    pub(in crate::simulation) quantities: Arc<[Quantity]>,
    pub(in crate::simulation) access: Arc<[Access]>,
    pub(in crate::simulation) inputs: Inputs,
    pub(in crate::simulation) model: Model,
    pub(super) workspace: Workspace,
    /// `None` where the scene has no recorder.
    pub(in crate::simulation) recorder: Option<Recorder>,
    pub(super) method: Method,
    pub(in crate::simulation) forces: Forces,
    pub(in crate::simulation) derivative: Vec<f64>,
    pub(in crate::simulation) change: Change,
    /// The outer ring's acceleration when outputs were computed last (m/s²).
    pub(in crate::simulation) present_acceleration: Vector,
    pub(in crate::simulation) state: State,
    pub(super) up_to_date: UpToDate,
    pub(super) ahead: Ahead,
}

/// The last of what has been computed for the values that are set now. Each follows from the one before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::simulation) enum UpToDate {
    /// Nothing: parameters have been set since the model was built.
    Nothing,
    /// The model; before the start the equilibrium is still to be found.
    Model,
    /// The state vector.
    State,
    /// All outputs but the stiffness.
    Outputs,
    /// The stiffness as well.
    Stiffness,
}

impl Simulation {
    /// Sets up the scene. `profiles` are the texts of the files that its defects name, in the order of
    /// [`Scene::profile_names`]; `None` or `Some` text do for a scene with one file at most.
    ///
    /// # Errors
    /// An impossible scene or profile.
    pub fn new<'p>(scene: Scene, profiles: impl IntoIterator<Item = &'p str>) -> Result<Self, SimulationError> {
        Self::with_map(scene, profiles, None)
    }

    /// As [`new`](Self::new), with the bytes of the contact map that was stored for the scene. Without it, law `map`
    /// computes the map on initialization, which takes seconds; [`setup::build_map`] makes it once, and has an example.
    ///
    /// # Errors
    /// An impossible scene or profile; a map that is damaged or belongs to something else.
    pub fn with_map<'p>(
        scene: Scene,
        profiles: impl IntoIterator<Item = &'p str>,
        map: Option<&[u8]>,
    ) -> Result<Self, SimulationError> {
        // Without a defect there is nothing to look up.
        let map = map.filter(|_| !scene.defects.is_empty()).map(ContactMaps::decode).transpose()?;
        Self::with_shared_map(scene, profiles, map.map(Arc::new))
    }

    /// As [`with_map`](Self::with_map), with maps that others may use as well.
    ///
    /// # Errors
    /// As [`with_map`](Self::with_map).
    pub fn with_shared_map<'p>(
        scene: Scene,
        profiles: impl IntoIterator<Item = &'p str>,
        map: Option<Arc<ContactMaps>>,
    ) -> Result<Self, SimulationError> {
        scene.check()?;
        let profiles: Vec<&str> = profiles.into_iter().collect();
        let scene = with_roller_profile(&scene, profiles.iter().copied())?;
        let surfaces = Surface::load_all(&scene, profiles)?;
        Self::with_surfaces(scene, surfaces.into(), map)
    }

    fn with_surfaces(
        scene: Scene,
        surfaces: Arc<[Surface]>,
        map: Option<Arc<ContactMaps>>,
    ) -> Result<Self, SimulationError> {
        let (table, quantities): (Vec<_>, Vec<_>) = rows(&scene).into_iter().unzip();
        let access = table.iter().zip(&quantities).map(|(row, &quantity)| Access::new(row, quantity)).collect();
        let (reals, integers) = setup::start_values(&table);
        let map = map.filter(|_| !surfaces.is_empty());
        if let Some(map) = &map {
            map.check_fingerprint(setup::map_fingerprint(&scene, &surfaces)?)?;
        }
        // What takes long is left to the initialization: the host may change parameters before it.
        let is_complete = surfaces.is_empty()
            || match scene.contact.law {
                ContactLaw::Hertz => true,
                ContactLaw::Map => map.is_some(),
                ContactLaw::Love => false,
            };
        if !is_complete {
            // Overlaps are refused now, not when the model is built.
            arranged(&scene, &surfaces)?;
        }
        let model = setup::build_model(&scene, if is_complete { &surfaces } else { &[] }, map.as_ref())?;
        let recorder = Recorder::of(&scene, &table, &quantities);
        let progress = new_progress(&model, &recorder);
        let inputs = Inputs {
            frames: scene.turns(),
            ..Inputs::new(&quantities, table.iter().take_while(|v| v.causality == Causality::Input).count())
        };
        Ok(Self {
            inputs,
            workspace: Workspace::new(&model),
            recorder,
            method: Method::Automatic,
            forces: Forces::of(&model),
            derivative: vec![0.0; model.layout.len],
            change: Change::new(model.element_count, model.sensor_modes.state_len()),
            present_acceleration: Vector::zeros(),
            state: State {
                time: 0.0,
                started: false,
                cage: WholeAngle::new(scene.cage.initial_angle),
                frames: [scene.shaft_initial_angle, scene.housing_initial_angle, 0.0].map(WholeAngle::new),
                ended: Ended::default(),
                progress,
                reals,
                integers,
                input_rates: vec![[None; 2]; inputs.count],
                history: History::none(inputs.count),
                first: FirstInputs::none(inputs.count),
            },
            scene: Arc::new(scene),
            surfaces,
            map,
            table: table.into(),
            access,
            quantities: quantities.into(),
            model,
            ahead: Ahead::default(),
            up_to_date: if is_complete { UpToDate::Model } else { UpToDate::Nothing },
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
        variable.map(|variable| variable.reference).ok_or_else(|| {
            let near = nearest(self.table.iter().map(|variable| &*variable.name), name).map(str::to_owned);
            VariableError::UnknownName { name: name.to_owned(), near }
        })
    }

    /// What each output depends on, in the order of the table.
    pub fn dependencies(&self) -> Vec<Dependencies> {
        dependencies::of(&self.table, &self.quantities, &self.scene)
    }

    /// The scene as it was set up.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Time (s).
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Chooses the integration method, for studies; automatic unless this is called. No part of the state.
    pub fn set_method(&mut self, method: Method) {
        self.method = method;
        // What is stable is to be checked anew: it was for another method.
        self.state.progress.choice.stable_step = 0.0;
    }

    /// Accepted integration steps so far.
    pub fn step_counts(&self) -> StepCounts {
        StepCounts { all: self.state.progress.steps, implicit: self.state.progress.implicit_steps }
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
    pub fn equations(&self) -> (&Model, Excitation) {
        (&self.model, self.excitation(true))
    }

    /// The state vector, laid out as [`crate::dynamics::parameters::Layout`] says.
    pub fn state_vector(&self) -> &[f64] {
        &self.state.progress.state
    }

    /// Cells of defects in which all contacts are, for studies.
    pub fn cells(&self) -> &Cells {
        &self.state.progress.cells
    }

    /// Solves the static equilibrium at `start` (s) and ends the setting of parameters.
    ///
    /// A second call begins a run anew, at its own `start`: from the equilibrium under the parameters as they are and
    /// the inputs as they are then, cage and rings at their initial angles and the solver's counts at 0. It drops the
    /// recorder's samples that have not been stored.
    ///
    /// # Errors
    /// A start that is not finite; parameters that make an impossible scene; no equilibrium.
    pub fn initialize(&mut self, start: f64) -> Result<(), SimulationError> {
        if !start.is_finite() {
            return Err(SimulationError::StartTime(start));
        }
        self.state.ended = Ended::default();
        self.find_equilibrium()?;
        self.state.time = start;
        self.state.started = true;
        self.forget_samples();
        Ok(())
    }

    /// Takes the state.
    /// ```
    /// use brinell::scene::{Bearing, Scene};
    /// use brinell::simulation::Simulation;
    ///
    /// let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
    /// let scene = Scene::builder(bearing).shaft_speed(157.1).shaft_load([0.0, -1500.0]).build()?;
    /// let mut simulation = Simulation::new(scene, None)?;
    /// simulation.initialize(0.0)?;
    /// let state = simulation.save();
    /// simulation.step(1e-4)?;
    /// let first = simulation.get("shaft.y")?;
    /// // Back, and the same step once more: the same bits.
    /// simulation.restore(&state)?;
    /// simulation.step(1e-4)?;
    /// assert_eq!(simulation.get("shaft.y")?, first);
    /// # Ok::<(), brinell::Error>(())
    /// ```
    pub fn save(&self) -> State {
        self.state.clone()
    }

    /// Takes the state over one taken earlier of this same model; allocates nothing.
    pub fn save_into(&self, state: &mut State) {
        state.copy_from(&self.state);
    }

    /// Puts a state of this same model back. An error leaves the simulation in need of another state or of a rebuild.
    pub fn restore(&mut self, state: &State) -> Result<(), SimulationError> {
        let present = &self.state;
        let parameters_differ = self.table.iter().enumerate().any(|(i, variable)| {
            variable.causality == Causality::Parameter
                && (present.reals[i].to_bits() != state.reals[i].to_bits() || present.integers[i] != state.integers[i])
        });
        self.state.go_back_to(state, &mut self.ahead);
        if let Some(recorder) = &mut self.recorder {
            recorder.rewind(&self.state.progress.due);
        }
        self.invalidate(if parameters_differ { UpToDate::Nothing } else { UpToDate::Model });
        // Before the start, the equilibrium rebuilds the model when it is asked for.
        if !self.state.started {
            return Ok(());
        }
        self.rebuild()?;
        if self.model.has_cells(&self.state.progress.cells) {
            self.up_to_date = UpToDate::State;
            Ok(())
        } else {
            Err(SimulationError::ForeignState)
        }
    }

    /// Notes that what follows after `last` is no longer that of the values set.
    pub(in crate::simulation) fn invalidate(&mut self, last: UpToDate) {
        self.up_to_date = self.up_to_date.min(last);
    }

    /// Where every external influence is, during the next step if `stepping`.
    pub(in crate::simulation) fn excitation(&self, stepping: bool) -> Excitation {
        excitation::excitation(&self.state, &self.inputs, &self.model.ratios, stepping)
    }

    /// Refuses oil films that are too thick at an instant.
    pub(super) fn check_films(&self, excitation: &Excitation, tau: f64) -> Result<(), SimulationError> {
        let Some(films) = self.model.films_at(excitation, tau) else { return Ok(()) };
        let (clearance, limit) = (self.model.clearance(Some(&films)), self.scene.bearing.smallest_radial_clearance());
        if !(clearance >= limit) {
            return Err(SimulationError::ThickFilms {
                films_um: films.together() * 1e6,
                speed_hz: excitation.relative_speed.at(tau) / TAU,
                clearance_um: clearance * 1e6,
                limit_um: limit * 1e6,
            });
        }
        Ok(())
    }

    /// Rebuilds the model if parameters were set, and finds the equilibrium.
    pub(super) fn find_equilibrium(&mut self) -> Result<(), SimulationError> {
        self.rebuild()?;
        let angle = |parameter| setup::parameter(&self.quantities, &self.state.reals, parameter);
        let (shaft, housing) = (RingName::Shaft, RingName::Housing);
        let [cage, shaft, housing] = [
            angle(Parameter::CageInitialAngle).unwrap_or(self.scene.cage.initial_angle),
            angle(Parameter::RingInitialAngle(shaft)).unwrap_or(self.scene.shaft_initial_angle),
            angle(Parameter::RingInitialAngle(housing)).unwrap_or(self.scene.housing_initial_angle),
        ];
        self.state.cage = WholeAngle::new(cage);
        self.state.frames = [shaft, housing, 0.0].map(WholeAngle::new);
        let excitation = self.excitation(false);
        self.check_films(&excitation, 0.0)?;
        self.state.forget_steps();
        self.ahead.begin(&self.state, self.inputs.repeated.is_some());
        let progress = &mut self.state.progress;
        *progress = new_progress(&self.model, &self.recorder);
        progress.cells = self.model.equilibrium_with_cells(&excitation, &mut progress.state)?;
        self.evaluate(&excitation);
        let progress = &mut self.state.progress;
        self.forces.note_pushing(&mut progress.pushing);
        let (shaft, housing) = (self.forces.shaft(), self.forces.housing());
        progress.mean_force = [shaft.x, shaft.y, housing.x, housing.y];
        self.up_to_date = UpToDate::State;
        Ok(())
    }

    /// Derivative and forces at the communication point under `excitation`. They must not depend on what was computed
    /// before, or a restored state would show other roundings.
    pub(super) fn evaluate(&mut self, excitation: &Excitation) {
        self.forces.shortcuts.forget();
        let (progress, derivative) = (&self.state.progress, &mut self.derivative);
        self.model.derivative(excitation, 0.0, &progress.cells, &progress.state, derivative, &mut self.forces);
    }

    fn rebuild(&mut self) -> Result<(), SimulationError> {
        if self.up_to_date > UpToDate::Nothing {
            return Ok(());
        }
        let scene = setup::with_parameters(&self.scene, &self.quantities, &self.state.reals, &self.state.integers)?;
        self.model = setup::build_model(&scene, &self.surfaces, self.map.as_ref())?;
        for forces in [&mut self.forces, &mut self.workspace.forces] {
            forces.shortcuts = Shortcuts::of(&self.model);
        }
        self.up_to_date = UpToDate::Model;
        Ok(())
    }
}

/// A state at rest of this model.
fn new_progress(model: &Model, recorder: &Option<Recorder>) -> Progress {
    let under_way = recorder.as_ref().map_or(0, Recorder::under_way);
    Progress::new(model, under_way)
}
