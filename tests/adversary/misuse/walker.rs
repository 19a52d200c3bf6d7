//! One instance that is misused, beside a twin that takes only the calls that succeeded, and a model of what the
//! standard says about it.

use super::chance::Chance;
use super::stage::{Folders, Stage};
use super::standard::{self, ERROR, OK, Statuses};
use super::tally::Tally;
use crate::two::{Host, Line, bits};
use brinell_fmi::fmi2::*;
use std::collections::{BTreeMap, VecDeque};
use std::fs;
use std::path::PathBuf;
use std::sync::Arc;

pub(super) use super::standard::State;

/// A call that has changed an instance, to be made on another one.
type Deed = Arc<dyn Fn(&Host) -> Status + Send + Sync>;

/// What the standard and the calls so far say about an instance. It is saved and restored with the instance's state.
#[derive(Clone)]
pub(super) struct Model {
    pub(super) state: State,
    /// Time and stop time, once an experiment is set up.
    pub(super) clock: Option<(f64, Option<f64>)>,
    /// A value has been set that no sensible host sets: what is computed from it may be an error.
    pub(super) wild: bool,
    /// Derivatives of inputs, of order 1 and 2, for the next step.
    pub(super) rates: BTreeMap<u32, [Option<f64>; 2]>,
    pub(super) last_step: Status,
    /// The calls that lead here from a new instance, without what was taken back.
    path: Vec<Deed>,
}

impl Model {
    fn new() -> Self {
        Self {
            state: State::Instantiated,
            clock: None,
            wild: false,
            rates: BTreeMap::new(),
            last_step: Status::Ok,
            path: Vec::new(),
        }
    }
}

/// A saved state of the instance, and the twin's of the same moment if the twin was there.
pub(super) struct Saved {
    pub(super) handle: FmuState,
    pub(super) twin: Option<FmuState>,
    pub(super) model: Model,
}

/// A state as bytes, for others to take.
#[derive(Clone)]
pub(super) struct Blob {
    pub(super) scene: &'static str,
    pub(super) bytes: Arc<Vec<u8>>,
    pub(super) model: Model,
    /// The twin was there, so the bytes are those of a run that broke no rule.
    pub(super) sound: bool,
}

/// What the others have: handles that are not one's own, and states as bytes.
#[derive(Default, Clone)]
pub(super) struct Strangers {
    pub(super) states: Vec<usize>,
    pub(super) blobs: Vec<Blob>,
    pub(super) dead: Vec<usize>,
}

/// Where an instance has been told to record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Folder {
    None,
    Shared,
    Full,
    Blocked,
}

pub(super) struct Walker<'w> {
    pub(super) stage: &'w Stage,
    pub(super) folders: &'w Folders,
    pub(super) number: u64,
    name: String,
    pub(super) subject: Host,
    pub(super) twin: Host,
    pub(super) model: Model,
    /// The twin stands where the instance stands. It is left behind by an error.
    pub(super) together: bool,
    pub(super) saved: Vec<Saved>,
    /// Handles of states that were freed.
    pub(super) freed: Vec<FmuState>,
    pub(super) folder: Folder,
    /// Where the last recording was begun. The run may have been taken back since, and another folder been named.
    begun_in: Folder,
    /// A recording was begun and nothing has failed since.
    pub(super) recording: bool,
    /// Whether a file is open for it; `None` if that cannot be known.
    pub(super) file: Option<bool>,
    /// Other instances may have the same name, or one that makes the same name of a file.
    pub(super) name_is_shared: bool,
    /// Categories that are on: their bits are those of the statuses.
    pub(super) categories: u8,
    pub(super) tally: Tally,
    /// The instance was freed: another one takes the walker's place.
    pub(super) gone: bool,
    pub(super) seed: u64,
    history: VecDeque<String>,
}

// SAFETY: each walker, and with it the two instances and their logs, is used by one thread at a time.
unsafe impl Send for Walker<'_> {}

/// So many walkers have names that others have, too.
pub(super) const SHARERS: u64 = 2;

/// Bits of all categories in [`Walker::categories`].
pub(super) const ALL_CATEGORIES: u8 = 0b1111;

impl<'w> Walker<'w> {
    /// An instance of its own name, or of one that others may have; its number says which.
    pub(super) fn new(stage: &'w Stage, folders: &'w Folders, number: u64, seed: u64, chance: &mut Chance) -> Self {
        let name_is_shared = number % 1000 < SHARERS;
        let name = match (name_is_shared, chance.below(3)) {
            (true, 0) => "left bearing".to_owned(),
            (true, 1) => "left/bearing".to_owned(),
            (true, _) => "100 %s %n".to_owned(),
            (false, _) => format!("walker {number}"),
        };
        folders.prepare(&name);
        let logging = !chance.one_in(4);
        let subject = Host::with(Arc::clone(&stage.resources), &name, logging);
        subject.lines();
        Self {
            stage,
            folders,
            number,
            subject,
            twin: Host::with(Arc::clone(&stage.resources), "twin", false),
            model: Model::new(),
            together: true,
            saved: Vec::new(),
            freed: Vec::new(),
            folder: Folder::None,
            begun_in: Folder::None,
            recording: false,
            file: Some(false),
            name_is_shared,
            categories: if logging { ALL_CATEGORIES } else { 0 },
            tally: Tally { instances: 2, ..Tally::default() },
            gone: false,
            history: VecDeque::from([format!("fmi2Instantiate({name:?}, logging {logging})")]),
            name,
            seed,
        }
    }

    /// With an error beside the statuses given, if values are such that it may fail.
    pub(super) fn unless_wild(&self, statuses: Statuses) -> Statuses {
        if self.model.wild || self.model.state == State::Error { statuses.or(ERROR) } else { statuses }
    }

    /// Statuses of a call that begins a recording.
    pub(super) fn begins_recording(&self) -> Statuses {
        match self.folder {
            Folder::None => OK,
            Folder::Shared if !self.name_is_shared => OK,
            // Another instance may have the recording, or there is no room for it.
            Folder::Shared | Folder::Full => OK.or(ERROR),
            Folder::Blocked => ERROR,
        }
    }

    /// After such a call.
    pub(super) fn recording_began(&mut self, done: bool) {
        let begun = done && self.folder != Folder::None;
        (self.recording, self.file) = (begun, if done { Some(begun) } else { None });
        self.begun_in = self.folder;
    }

    /// Whether what is recorded may find no room.
    pub(super) fn lacks_room(&self) -> bool {
        [self.folder, self.begun_in].contains(&Folder::Full)
    }

    /// Looks at the status and the log of a call, of which these statuses are expected where the function is allowed
    /// and an error elsewhere. True if the call has had its effect.
    pub(super) fn judge(
        &mut self,
        function: &'static str,
        where_allowed: Statuses,
        status: Status,
        call: impl FnOnce() -> String,
    ) -> bool {
        let state = self.model.state;
        let expected = if standard::allows(function, state) { where_allowed } else { ERROR };
        self.tally.count(function, state, status);
        self.remember(format!("{function}({}) in {state:?}: {status:?}", call()));
        let lines = self.subject.lines();
        let said = || format!("{status:?} is not what was expected, {expected:?}: {lines:?}");
        self.require(expected.has(status), said);
        self.look_at(function, status, &lines);
        if status >= Status::Error {
            (self.model.state, self.together) = (State::Error, false);
        }
        status <= Status::Warning
    }

    /// A status other than OK has one line that begins with the function; what is switched off is silent, unless
    /// samples are lost.
    fn look_at(&self, function: &str, status: Status, lines: &[Line]) {
        let is_lost = |status| status == Status::Warning && matches!(function, "fmi2Terminate" | "fmi2Reset");
        let is_told = |status: Status| self.categories & 1 << status as u8 != 0 || is_lost(status);
        // That a step is long for its casing is advice: no status says it.
        let is_advice =
            |line: &Line| line.status == Status::Warning && line.message.starts_with("communication step of ");
        for line in lines {
            let category = match line.status {
                Status::Ok => "logEvents",
                Status::Warning => "logStatusWarning",
                Status::Discard => "logStatusDiscard",
                _ => "logStatusError",
            };
            let event = line.status == Status::Ok && line.message.starts_with("recording ");
            let proper = event || is_advice(line) || line.message.starts_with(function);
            let proper = proper && line.category == category && line.format == "%s";
            self.require(proper, || format!("{line:?}"));
            self.require(is_told(line.status), || format!("switched off: {line:?}"));
        }
        let of = |status: Status| lines.iter().filter(|line| line.status == status && !is_advice(line)).count();
        let wanted = usize::from(is_told(status));
        if status != Status::Ok {
            self.require(of(status) == wanted, || format!("{wanted} lines expected: {lines:?}"));
        }
        // A state that is freed by value is warned of in the log alone.
        let by_value = |line: &Line| function == "fmi2FreeFMUstate" && line.message.contains("it is freed");
        let fits = |line: &Line| line.status <= status || by_value(line) || is_advice(line);
        self.require(lines.iter().all(fits), || format!("worse than the status: {lines:?}"));
    }

    /// Lets the twin do what the instance did, and notes it as part of the way here.
    pub(super) fn follow(&mut self, deed: impl Fn(&Host) -> Status + Send + Sync + 'static) {
        self.alongside(&deed);
        self.model.path.push(Arc::new(deed));
    }

    /// Lets the twin do what the instance did, if it stands where the instance stood.
    pub(super) fn alongside(&mut self, deed: impl Fn(&Host) -> Status) {
        if self.together {
            let status = deed(&self.twin);
            self.require(status <= Status::Warning, || format!("the twin got {status:?}"));
        }
    }

    fn is_readable(&self) -> bool {
        standard::allows("fmi2GetReal", self.model.state) && self.model.state != State::Error
    }

    /// Everything that can be read.
    fn read(&self, host: &Host) -> Result<(Vec<u64>, Vec<i32>), Status> {
        let reals = host.get(&self.stage.reals(None))?;
        Ok((bits(&reals), host.get_integers(&self.stage.integers())?))
    }

    /// A new instance that goes straight the way that the instance has come by detours gives equal bits.
    pub(super) fn compare_with_the_straight_way(&mut self) {
        if !self.together || !self.is_readable() || self.model.wild {
            return;
        }
        let straight = Host::with(Arc::clone(&self.stage.resources), "straight", false);
        for (number, deed) in self.model.path.iter().enumerate() {
            let status = deed(&straight);
            self.require(status <= Status::Warning, || format!("straight, deed {number} got {status:?}"));
        }
        let (ours, straights) = (self.read(&self.subject), self.read(&straight));
        self.require(ours == straights, || format!("the straight way differs: {ours:x?} {straights:x?}"));
        self.tally.straight_ways += 1;
    }

    /// Compares everything that can be read, bit by bit; then the states as bytes.
    pub(super) fn compare(&mut self) {
        if !self.together || !self.is_readable() {
            return;
        }
        let (ours, twins) = (self.read(&self.subject), self.read(&self.twin));
        self.subject.lines();
        self.require(ours == twins, || format!("the twin differs: {ours:x?} {twins:x?}"));
        if ours.is_err() {
            self.require(self.model.wild, || "what a sensible host has set cannot be read".to_owned());
            (self.model.state, self.together) = (State::Error, false);
            return;
        }
        let bytes = |host: &Host| {
            let state = host.save();
            let bytes = host.serialize(state);
            assert_eq!(host.free(state), Status::Ok);
            bytes
        };
        let (ours, twins) = (bytes(&self.subject), bytes(&self.twin));
        let offset = ours.iter().zip(&twins).position(|(a, b)| a != b);
        self.require(ours == twins, || format!("the twin's state differs at byte {offset:?} of {}", ours.len()));
        self.tally.comparisons += 1;
    }

    /// The recording, once it is finished, is the twin's byte for byte.
    pub(super) fn compare_recordings(&mut self) {
        if !(self.recording && self.together && self.begun_in == Folder::Shared) {
            return;
        }
        let files = |folder: PathBuf| -> Vec<Vec<u8>> {
            let entries = fs::read_dir(folder).map(|entries| entries.flatten().collect()).unwrap_or_else(|_| vec![]);
            entries.iter().filter_map(|entry| fs::read(entry.path()).ok()).collect()
        };
        let (ours, twins) = (files(self.folders.shared()), files(self.folders.own(self.number)));
        self.require(!twins.is_empty(), || "the twin has recorded nothing".to_owned());
        for twin in &twins {
            self.require(ours.contains(twin), || format!("no recording is the twin's, of {} bytes", twin.len()));
        }
        self.tally.recordings += 1;
    }

    /// After `fmi2Reset`: as a new instance, except for saved states and logging.
    pub(super) fn start_over(&mut self) {
        self.model = Model::new();
        (self.together, self.recording, self.file) = (true, false, Some(false));
        (self.folder, self.begun_in) = (Folder::None, Folder::None);
    }

    pub(super) fn remember(&mut self, call: String) {
        if self.history.len() == 60 {
            self.history.pop_front();
        }
        self.history.push_back(call);
    }

    pub(super) fn require(&self, holds: bool, what: impl FnOnce() -> String) {
        if !holds {
            let calls: Vec<_> = self.history.iter().map(String::as_str).collect();
            let (seed, scene, name) = (self.seed, self.stage.name, &self.name);
            panic!("{}\nseed {seed}, {scene}, instance {name:?}, last calls:\n{}", what(), calls.join("\n"));
        }
    }
}
