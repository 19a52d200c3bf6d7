//! One instance: the model, where it is in time, in which mode, and how it talks to the host.

mod warnings;

use std::ffi::{CString, c_char};

use crate::c_interface::{FmuState, Logger, Status, ValueReference, c_string};
use crate::instance::addressing::Addressing;
use crate::instance::clock::Clock;
use crate::instance::failure::Failure;
use crate::instance::intermediate_updates::IntermediateUpdates;
use crate::instance::mode::{Function, Mode};
use crate::instance::snapshot::Snapshot;
use crate::instance::snapshots::Snapshots;
use crate::resources::SharedModel;
use brinell::recording::{Recording, Unstored};
use brinell::simulation::{Simulation, VariableError};

/// What a host has been warned of.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Warned {
    /// Contacts that a shoulder cuts.
    pub(super) of_shoulders: bool,
    /// Contacts beside the slices of a topography.
    pub(super) of_track: bool,
    /// Positions without velocities.
    pub(super) of_velocity: bool,
    /// A ring that jumped.
    pub(super) of_jump: bool,
    /// The largest error of the coupling.
    pub(super) of_error: f64,
}

/// One instance of the FMU.
#[derive(Debug)]
pub(crate) struct Instance {
    /// Mode, which decides what may be called.
    pub(crate) mode: Mode,
    /// Where the experiment begins, is, and ends; `None` before the host has given it.
    pub(crate) clock: Option<Clock>,
    /// Status of the last step.
    pub(crate) last_step: Status,
    /// Whether a panic has left the simulation in an unknown condition.
    pub(crate) damaged: bool,
    /// The bearing.
    pub(crate) simulation: Box<Simulation>,
    /// The way to the host's logger.
    pub(crate) logger: Logger,
    /// What the resources describe.
    pub(crate) model: SharedModel,
    /// States that the host has saved.
    pub(crate) snapshots: Snapshots,
    /// Whether it is for model exchange.
    pub(crate) exchange: bool,
    /// Whether the FMU lists the variables of model exchange, of whichever kind the instance is.
    pub(crate) lists_exchange: bool,
    /// What references stand for in FMI 3.0; `None` in FMI 2.0, where each is a row of the table.
    pub(crate) addressing: Option<Addressing>,
    /// What the host wants of intermediate updates; `None` if nothing.
    pub(crate) updates: Option<IntermediateUpdates>,
    /// Room for the rows behind arrays.
    pub(crate) rows: Vec<ValueReference>,
    /// The file that the recorder's samples go to.
    recording: Option<Recording>,
    /// What it has warned of.
    pub(super) warned: Warned,
    /// Strings handed out last, which stay valid until strings are read again.
    texts: Vec<CString>,
}

impl Instance {
    /// A fresh instance of a model.
    pub(crate) fn new(model: SharedModel, logger: Logger) -> Self {
        Self {
            mode: Mode::Instantiated,
            clock: None,
            last_step: Status::Ok,
            damaged: false,
            simulation: model.simulation(),
            logger,
            model,
            snapshots: Snapshots::default(),
            exchange: false,
            lists_exchange: false,
            addressing: None,
            updates: None,
            rows: Vec::new(),
            recording: None,
            warned: Warned::default(),
            texts: Vec::new(),
        }
    }

    /// Back to where [`new`](Self::new) left it, and what kept samples from being stored, if anything did. Saved states
    /// and logging stay.
    pub(crate) fn reset(&mut self) -> Result<Option<Failure>, Failure> {
        let unstored = self.finish_recording("are lost").err();
        self.recording = None;
        self.rebuild();
        self.mode = Mode::Instantiated;
        self.clock = None;
        self.warned = Warned::default();
        self.last_step = Status::Ok;
        Ok(unstored)
    }

    /// Finds the static equilibrium and begins the recording, if there is to be one.
    pub(crate) fn initialize(&mut self, start: f64) -> Result<(), Failure> {
        if self.exchange && self.simulation.recorder().is_some() {
            return Err(Failure::NoRecorder);
        }
        self.simulation.initialize(start)?;
        self.begin_recording()
    }

    fn begin_recording(&mut self) -> Result<(), Failure> {
        // That of a run which was taken back to before its start; its claim would hold against the new one.
        self.recording = None;
        self.recording = Recording::begin(&self.simulation, self.logger.instance_name())?;
        if let (Some(recording), Some(recorder)) = (&self.recording, self.simulation.recorder()) {
            let path = recording.path().display();
            self.logger.line(Status::Ok, || format!("recording {path}: {}.", recorder.description()));
        }
        Ok(())
    }

    /// Takes a step from a communication point.
    #[inline]
    pub(crate) fn take_step(&mut self, point: f64, step: f64) -> Result<(), Failure> {
        let after = self.begin_step(point, step)?;
        self.simulation.step(step)?;
        self.finish_step(after, step)
    }

    /// Checks point and step. Gives the clock at the step's end.
    #[inline]
    pub(crate) fn begin_step(&mut self, point: f64, step: f64) -> Result<Clock, Failure> {
        // Stands if the step fails or panics.
        self.last_step = Status::Error;
        let after = self.clock.as_ref().ok_or(Failure::NotSetUp)?.after(point, step)?;
        #[cfg(feature = "panic-on-demand")]
        self.logger.panic_on_demand();
        Ok(after)
    }

    /// Notes that the model has come to where this clock is.
    #[inline]
    pub(crate) fn finish_step(&mut self, reached: Clock, step: f64) -> Result<(), Failure> {
        if let Some(recording) = &mut self.recording {
            recording.keep_up(&mut self.simulation)?;
        }
        self.clock = Some(reached);
        self.last_step = Status::Ok;
        self.warn(reached.time, step)
    }

    /// Lets a tolerance of the host's tighten that of the time integration, and never loosen it: hosts hand in their
    /// own default without asking, and a scene's tolerance is chosen for its impacts.
    pub(crate) fn tighten(&mut self, tolerance: f64) -> Result<(), Failure> {
        if !(tolerance > 0.0 && tolerance.is_finite()) {
            return Err(Failure::Tolerance(tolerance));
        }
        Ok(self.simulation.tighten_tolerance(tolerance)?)
    }

    /// Changes the mode, and says so.
    pub(crate) fn enter(&mut self, mode: Mode, function: &Function) {
        self.mode = mode;
        let name = mode.name(function.version);
        let line = || match self.clock {
            Some(clock) => format!("{}: {name} at {:?} s.", function.name, clock.time),
            None => format!("{}: {name}.", function.name),
        };
        self.logger.line(Status::Ok, line);
    }

    /// Stores what the recorder still holds. What becomes of it if that fails is `fate`: never more than a
    /// warning, for the run itself is as good as it was.
    pub(crate) fn finish_recording(&mut self, fate: &'static str) -> Result<(), Failure> {
        let Some(recording) = &mut self.recording else { return Ok(()) };
        let Err(cause) = recording.store(&mut self.simulation) else { return Ok(()) };
        Err(Failure::Unstored { cause, samples: Unstored::of(&self.simulation), fate })
    }

    fn rebuild(&mut self) {
        self.simulation = self.model.simulation();
        self.damaged = false;
    }

    /// Saves everything that the instance's future depends on: over the state behind `handle`, or anew if it is null.
    pub(crate) fn save(&mut self, handle: FmuState) -> Result<FmuState, Failure> {
        let Self { mode, clock, last_step, ref simulation, .. } = *self;
        self.snapshots.put(handle, |old| match old {
            Some(old) => {
                simulation.save_into(&mut old.simulation);
                (old.mode, old.clock, old.last_step) = (mode, clock, last_step);
                None
            }
            None => Some(Snapshot { mode, clock, last_step, simulation: simulation.save() }),
        })
    }

    /// Frees a state that came in place of its address. A warning is logged but not returned: hosts that do this stop
    /// at any status but OK.
    pub(crate) fn free_by_value(&mut self, handle: FmuState, function: &'static str) -> Result<(), Failure> {
        self.snapshots.free(handle)?;
        let text = || format!("{function}: the state itself was passed, not its address; it is freed.");
        self.logger.line(Status::Warning, text);
        Ok(())
    }

    /// Puts a saved state back. A simulation that a panic has damaged is set up anew first.
    pub(crate) fn restore(&mut self, handle: FmuState) -> Result<(), Failure> {
        if self.damaged {
            let folder = self.simulation.recorder().map(|recorder| recorder.folder().to_owned());
            self.rebuild();
            self.simulation.record_into(folder.as_deref().unwrap_or_default());
        }
        let snapshot = self.snapshots.get(handle)?;
        let of_other_kind = match snapshot.mode {
            Mode::Event | Mode::ContinuousTime => !self.exchange,
            Mode::StepComplete => self.exchange,
            _ => false,
        };
        if of_other_kind {
            return Err(Failure::OtherKind);
        }
        self.simulation.restore(&snapshot.simulation)?;
        self.mode = snapshot.mode;
        self.clock = snapshot.clock;
        self.last_step = snapshot.last_step;
        // The state of another instance, taken up by one that was never initialized itself.
        if self.recording.is_none() && self.mode == Mode::StepComplete {
            self.begin_recording()?;
        }
        Ok(())
    }

    /// The error that says why a variable is not what a call takes it for.
    pub(crate) fn wrong_type(&self, reference: ValueReference, wanted: &'static str) -> VariableError {
        match self.simulation.variable(reference) {
            Ok(variable) => VariableError::WrongType { name: variable.name.clone(), reference, wanted },
            Err(unknown) => unknown,
        }
    }

    /// Keeps strings alive for the host and hands out their addresses.
    pub(crate) fn keep(&mut self, texts: Vec<String>) -> impl Iterator<Item = *const c_char> {
        self.texts = texts.into_iter().map(c_string).collect();
        self.texts.iter().map(|text| text.as_ptr())
    }
}

/// Refuses results that are not finite.
#[inline]
pub(crate) fn finite(simulation: &Simulation, references: &[ValueReference], values: &[f64]) -> Result<(), Failure> {
    // 0·x is 0 for what is finite and NaN otherwise, and so is the sum: no branch in the loop.
    if values.iter().map(|value| 0.0 * value).sum::<f64>() == 0.0 {
        return Ok(());
    }
    let index = values.iter().position(|value| !value.is_finite()).unwrap_or_default();
    let name = references.get(index).and_then(|&reference| match simulation.table().get(reference as usize) {
        Some(variable) => Some(variable.name.clone()),
        None => simulation.exchange_name(reference),
    });
    let name = name.unwrap_or_default();
    Err(Failure::NotFinite { name, value: values.get(index).copied().unwrap_or(f64::NAN) })
}
