//! One bearing from its scene on: its life from setting up to stepping, and its state taken and put back.

use super::running::{Present, Run};
use super::state::{Ahead, Ended, State};
use crate::contact::map::ContactMaps;
use crate::dynamics::contacts::Shortcuts;
use crate::dynamics::parameters::{Cells, Excitation, Model, WholeAngle};
use crate::scene::Scene;
use crate::simulation::Method;
use crate::simulation::error::{SimulationError, VariableError};
use crate::simulation::integration::{Progress, StepCounts};
use crate::simulation::interface::table::{Causality, Dependencies, Variable};
use crate::simulation::interface::{Change, ElementArray, Interface, Parameter, RingName, Wiring};
use crate::simulation::recorder::Recorder;
use crate::simulation::setup::{self, Setup};
use std::sync::Arc;

/// A bearing that is stepped through time.
///
/// Life: [`new`](Self::new), set parameters and inputs, [`initialize`](Self::initialize), then set inputs and
/// [`step`](Self::step). Reading outputs before `initialize` computes the static equilibrium of the values set so far.
#[derive(Debug, Clone)]
pub struct Simulation {
    pub(in crate::simulation) setup: Setup,
    pub(in crate::simulation) interface: Interface,
    /// This and the next are on the heap: a bearing is handed on and copied where a host's thread has little stack.
    pub(in crate::simulation) run: Box<Run>,
    pub(in crate::simulation) present: Box<Present>,
    pub(in crate::simulation) change: Box<Change>,
    pub(super) up_to_date: UpToDate,
    pub(super) ahead: Ahead,
    pub(super) wiring: Wiring,
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
    /// Derivative and forces, from which all outputs follow but the stiffness.
    Forces,
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
        let setup = Setup::new(scene, profiles, map)?;
        let interface = Interface::of(&setup.scene, &setup.surfaces);
        let (model, is_complete) = setup.first_model()?;
        let run = Box::new(Run::new(model, &setup.scene, &interface));
        let in_space = run.model.space.is_some();
        Ok(Self {
            present: Box::new(Present::new(&run.model)),
            change: Box::new(Change::new(run.model.element_count, run.model.sensor_modes.state_len(), in_space)),
            ahead: Ahead::default(),
            wiring: Wiring::default(),
            up_to_date: if is_complete { UpToDate::Model } else { UpToDate::Nothing },
            setup,
            interface,
            run,
        })
    }

    /// The variables, ordered by value reference, which is the index.
    pub fn table(&self) -> &[Variable] {
        &self.interface.table
    }

    /// Value reference of the variable of this name.
    ///
    /// # Errors
    /// The scene has no such variable.
    pub fn reference(&self, name: &str) -> Result<u32, VariableError> {
        self.interface.reference(name)
    }

    /// What each output depends on, in the order of the table.
    pub fn dependencies(&self) -> Vec<Dependencies> {
        self.interface.dependencies(&self.setup.scene)
    }

    /// Variables of every element as arrays, in the order of the table.
    pub fn arrays(&self) -> Vec<ElementArray> {
        self.interface.arrays()
    }

    /// The scene as it was set up.
    pub fn scene(&self) -> &Scene {
        &self.setup.scene
    }

    /// Time (s).
    pub fn time(&self) -> f64 {
        self.run.state.time
    }

    /// Chooses the integration method, for studies; automatic unless this is called. No part of the state.
    pub fn set_method(&mut self, method: Method) {
        self.run.method = method;
        // What is stable is to be checked anew: it was for another method.
        self.run.state.progress.choice.stable_step = 0.0;
    }

    /// Accepted integration steps so far.
    pub fn step_counts(&self) -> StepCounts {
        StepCounts { all: self.run.state.progress.steps, implicit: self.run.state.progress.implicit_steps }
    }

    /// Whether a shoulder has cut the contact of an element so far.
    pub fn has_truncated_contacts(&self) -> bool {
        self.run.state.progress.truncated_contacts > 0
    }

    /// Whether a contact has been beside what is prepared of a surface that varies across the groove.
    pub fn has_off_track_contacts(&self) -> bool {
        self.run.state.progress.off_track_contacts > 0
    }

    /// The recorder, if the scene has one and the host has given it a folder.
    pub fn recorder(&self) -> Option<&Recorder> {
        self.run.recorder.as_ref().filter(|recorder| recorder.is_on())
    }

    /// Gives the recorder a folder; an empty one switches it off. Does nothing where the scene has no recorder.
    pub fn record_into(&mut self, folder: &str) {
        if let Some(recorder) = &mut self.run.recorder {
            folder.clone_into(&mut recorder.folder);
        }
    }

    /// Drops the rows kept in the recorder, once they have been stored.
    pub fn forget_samples(&mut self) {
        if let Some(recorder) = &mut self.run.recorder {
            recorder.forget(&self.run.state.progress.due);
        }
    }

    /// The equations of motion and what acts from outside from now on, for studies that integrate them themselves.
    pub fn equations(&self) -> (&Model, Excitation) {
        (&self.run.model, self.excitation(true))
    }

    /// The state vector, laid out as [`crate::dynamics::parameters::Layout`] says.
    pub fn state_vector(&self) -> &[f64] {
        &self.run.state.progress.state
    }

    /// Cells of defects in which all contacts are, for studies.
    pub fn cells(&self) -> &Cells {
        &self.run.state.progress.cells
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
        self.run.state.ended = Ended::default();
        self.find_equilibrium()?;
        self.run.state.time = start;
        self.run.state.started = true;
        self.wiring = Wiring::default();
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
        self.run.state.clone()
    }

    /// Takes the state over one taken earlier of this same model; allocates nothing.
    pub fn save_into(&self, state: &mut State) {
        state.copy_from(&self.run.state);
    }

    /// Puts a state of this same model back. An error leaves the simulation in need of another state or of a rebuild.
    pub fn restore(&mut self, state: &State) -> Result<(), SimulationError> {
        let Self { interface, run, .. } = self;
        let present = &run.state;
        let parameters_differ = interface.table.iter().enumerate().any(|(i, variable)| {
            variable.causality == Causality::Parameter
                && (present.reals[i].to_bits() != state.reals[i].to_bits() || present.integers[i] != state.integers[i])
        });
        self.run.state.go_back_to(state, &mut self.ahead);
        if let Some(recorder) = &mut self.run.recorder {
            recorder.rewind(&self.run.state.progress.due);
        }
        self.invalidate(if parameters_differ { UpToDate::Nothing } else { UpToDate::Model });
        // Before the start, the equilibrium rebuilds the model when it is asked for.
        if !self.run.state.started {
            return Ok(());
        }
        self.rebuild()?;
        if self.run.model.has_cells(&self.run.state.progress.cells) {
            self.up_to_date = UpToDate::State;
            Ok(())
        } else {
            Err(SimulationError::ForeignState)
        }
    }

    /// Whether the host holds the force of an instant over a step, as far as what it reads shows.
    #[inline]
    pub fn holds_force(&self) -> bool {
        self.wiring.holds_force()
    }

    /// Notes how the host is wired once it steps, in classes of `value_access`.
    #[inline]
    pub(in crate::simulation) fn note_wiring(&mut self, classes: u8) {
        if self.run.state.history.step > 0.0 {
            self.wiring.note(classes);
        }
    }

    /// Notes that what follows after `last` is no longer that of the values set.
    pub(in crate::simulation) fn invalidate(&mut self, last: UpToDate) {
        self.up_to_date = self.up_to_date.min(last);
    }

    /// Where every external influence is, during the next step if `stepping`.
    pub(in crate::simulation) fn excitation(&self, stepping: bool) -> Excitation {
        self.run.excitation(&self.interface.inputs, stepping)
    }

    /// Rebuilds the model if parameters were set, and finds the equilibrium.
    pub(super) fn find_equilibrium(&mut self) -> Result<(), SimulationError> {
        self.rebuild()?;
        let Self { setup, interface, run, .. } = self;
        let angle = |parameter, of_scene| {
            let set = setup::parameter(&interface.quantities, &run.state.reals, parameter);
            WholeAngle::new(set.unwrap_or(of_scene))
        };
        let scene = &setup.scene;
        let cage = angle(Parameter::CageInitialAngle, scene.cage.initial_angle);
        let shaft = angle(Parameter::RingInitialAngle(RingName::Shaft), scene.shaft_initial_angle);
        let housing = angle(Parameter::RingInitialAngle(RingName::Housing), scene.housing_initial_angle);
        (run.state.cage, run.state.frames) = (cage, [shaft, housing, WholeAngle::new(0.0)]);
        let excitation = run.excitation(&interface.inputs, false);
        setup.check_films(&run.model, &excitation, 0.0)?;
        run.state.forget_steps();
        self.ahead.begin(&run.state, interface.inputs.repeated.is_some());
        run.state.progress = Progress::new(&run.model, run.rows_under_way());
        let progress = &mut run.state.progress;
        progress.cells = run.model.equilibrium_with_cells(&excitation, &mut progress.state)?;
        self.present.evaluate(&self.run, excitation);
        let (progress, forces) = (&mut self.run.state.progress, &self.present.evaluation.forces);
        forces.note_pushing(&mut progress.pushing);
        progress.mean_force = forces.rings;
        self.up_to_date = UpToDate::State;
        Ok(())
    }

    fn rebuild(&mut self) -> Result<(), SimulationError> {
        if self.up_to_date > UpToDate::Nothing {
            return Ok(());
        }
        let Self { setup, interface, run, present, .. } = self;
        run.model = Arc::new(setup.model(&interface.quantities, &run.state.reals, &run.state.integers)?);
        let rate = setup::parameter(&interface.quantities, &run.state.reals, Parameter::RecorderRate);
        if let Some((recorder, rate)) = run.recorder.as_mut().zip(rate) {
            recorder.set_rate(rate, &run.state.progress.due);
        }
        for forces in [&mut present.evaluation.forces, &mut run.workspace.forces] {
            forces.shortcuts = Shortcuts::of(&run.model);
        }
        self.up_to_date = UpToDate::Model;
        Ok(())
    }
}
