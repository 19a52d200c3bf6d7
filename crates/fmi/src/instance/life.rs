//! One instance: the model, where it is in time, in which mode, and how it talks to the host.

use std::ffi::{CString, c_char};

use super::addressing::Addressing;
use super::clock::Clock;
use super::failure::Failure;
use super::intermediate_updates::IntermediateUpdates;
use super::mode::{Function, Mode};
use super::snapshot::Snapshot;
use super::snapshots::Snapshots;
use crate::c_interface::{FmuState, Logger, Status, ValueReference, c_string};
use crate::resources::SharedModel;
use brinell::recording::{Recording, Unstored};
use brinell::simulation::{Simulation, VariableError};

/// Suggested steps from which on one is warned of: errors beyond some 10 % with a wiring of second order, and of first.
const TOO_LONG: [f64; 2] = [3.0, 10.0];
/// Growth of the force from which on the step is looked at again: frequencies grow with its sixth root, by 1.4.
const HEAVIER: f64 = 8.0;

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
    /// Longest step that has been looked at (s), and the largest force under which it was (N).
    looked_at: [f64; 2],
    /// Whether the host held forces then.
    looked_at_held: bool,
    /// Whether it has warned of contacts that a shoulder cuts.
    warned_of_shoulders: bool,
    /// Whether it has warned of contacts beside the slices of a topography.
    warned_of_track: bool,
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
            looked_at: [0.0; 2],
            looked_at_held: false,
            warned_of_shoulders: false,
            warned_of_track: false,
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
        (self.looked_at, self.looked_at_held) = ([0.0; 2], false);
        (self.warned_of_shoulders, self.warned_of_track) = (false, false);
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
        self.finish_step(after)
    }

    /// Checks point and step. Gives the clock at the step's end.
    #[inline]
    pub(crate) fn begin_step(&mut self, point: f64, step: f64) -> Result<Clock, Failure> {
        // Stands if the step fails or panics.
        self.last_step = Status::Error;
        let after = self.clock.as_ref().ok_or(Failure::NotSetUp)?.after(point, step)?;
        #[cfg(feature = "panic-on-demand")]
        self.logger.panic_on_demand();
        let ([longest, heaviest], load) = (self.looked_at, self.simulation.mean_load());
        let held = self.simulation.holds_force();
        if step > 1.1 * longest || load > HEAVIER * heaviest || held != self.looked_at_held {
            (self.looked_at, self.looked_at_held) = ([longest.max(step), heaviest.max(load)], held);
            self.look_at_length(step)?;
        }
        Ok(after)
    }

    /// Warns of a step that is too long for the casing; looks at each length once, at none that is hardly longer, and
    /// again where the force has grown.
    #[cold]
    fn look_at_length(&mut self, step: f64) -> Result<(), Failure> {
        let Some(suggested) = self.simulation.suggested_step()? else { return Ok(()) };
        let held = self.looked_at_held;
        if step > TOO_LONG[usize::from(held)] * suggested {
            self.logger.line(Status::Warning, || {
                let wiring = if held {
                    "where force is held, as all that is read suggests, and for a hundred times as much where \
                     next_mean_force is held, mean_force taken in sequence or derivatives passed on"
                } else {
                    "where next_mean_force is held, mean_force taken in sequence or derivatives passed on, and for a \
                     hundredth of it where force is held; the error grows by the step's square"
                };
                format!(
                    "communication step of {step:e} s: the rings on this casing ask for some {suggested:.1e} s \
                     (solver.suggested_step) {wiring}."
                )
            });
        }
        Ok(())
    }

    /// Notes that the model has come to where this clock is.
    #[inline]
    pub(crate) fn finish_step(&mut self, reached: Clock) -> Result<(), Failure> {
        if let Some(recording) = &mut self.recording {
            recording.keep_up(&mut self.simulation)?;
        }
        self.clock = Some(reached);
        self.last_step = Status::Ok;
        if !self.warned_of_shoulders && self.simulation.has_truncated_contacts() {
            self.warn_of_shoulders(reached.time);
        }
        if !self.warned_of_track && self.simulation.has_off_track_contacts() {
            self.warn_of_track(reached.time);
        }
        Ok(())
    }

    /// Says once that forces are no longer those of whole ellipses.
    #[cold]
    fn warn_of_shoulders(&mut self, time: f64) {
        self.warned_of_shoulders = true;
        self.logger.line(Status::Warning, || {
            format!(
                "until {time:?} s a raceway's shoulder has cut the contact of an element \
                 (solver.truncated_contacts, element[j].shoulder): forces stay those of whole ellipses, up to 2 % too \
                 large with an eighth of the ellipse cut off and 9 % with a quarter."
            )
        });
    }

    /// Says once that a topography is no longer met where a ball is.
    #[cold]
    fn warn_of_track(&mut self, time: f64) {
        self.warned_of_track = true;
        self.logger.line(Status::Warning, || {
            format!(
                "until {time:?} s a contact was beside the slices across the groove for which the map of a topography \
                 is made, by more than a quarter of its ellipse's half-length (solver.off_track_contacts): it meets \
                 the outermost of them instead. bearing.operating_angle_deg says where they are; contact.law = \
                 \"love\" has no such bounds."
            )
        });
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
