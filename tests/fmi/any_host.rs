//! A host of either version: what both do alike, by functions that differ in their names alone.

use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Kind, Variable};
use brinell_fmi::fmi2::{Component, FmuState, Status};
use brinell_tests::resources::Resources;
use std::cell::OnceCell;
use std::sync::Arc;
use std::{fs, ptr};

/// One call of the logger. That of FMI 3.0 is told neither instance nor format.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    pub(crate) instance: String,
    pub(crate) status: Status,
    pub(crate) category: String,
    pub(crate) format: String,
    pub(crate) message: String,
}

type Plain = unsafe extern "C" fn(Component) -> Status;
type OfState = unsafe extern "C" fn(Component, *mut FmuState) -> Status;

/// What a version calls these functions.
pub(crate) struct Functions<Byte> {
    pub(crate) free: unsafe extern "C" fn(Component),
    pub(crate) exit: Plain,
    pub(crate) terminate: Plain,
    pub(crate) reset: Plain,
    pub(crate) get_state: OfState,
    pub(crate) set_state: unsafe extern "C" fn(Component, FmuState) -> Status,
    pub(crate) free_state: OfState,
    pub(crate) state_size: unsafe extern "C" fn(Component, FmuState, *mut usize) -> Status,
    pub(crate) serialize: unsafe extern "C" fn(Component, FmuState, *mut Byte, usize) -> Status,
    pub(crate) deserialize: unsafe extern "C" fn(Component, *const Byte, usize, *mut FmuState) -> Status,
}

/// A version of the standard, and what its hosts do each in their own way.
pub(crate) trait Version: Sized {
    type Log;
    type Byte;
    const FUNCTIONS: Functions<Self::Byte>;

    /// The lines logged since the last call.
    fn lines(log: &Self::Log) -> Vec<Line>;
    /// An instance of these resources, with the logger and nothing else.
    fn make(resources: Arc<Resources>, name: &str, logging: bool) -> (Component, Box<Self::Log>);
    /// Into initialization mode.
    fn begin(host: &Host<Self>, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status;
    fn step(host: &Host<Self>, point: f64, size: f64) -> Status;
    fn get(c: Component, references: &[u32], values: &mut [f64]) -> Status;
    fn set(c: Component, references: &[u32], values: &[f64]) -> Status;
    /// References of all real variables, and the number of their values.
    fn reals(simulation: &Simulation) -> (Vec<u32>, usize);
    /// The value reference of a variable.
    fn reference(simulation: &Simulation, name: &str) -> u32;
}

/// An instance and its host.
pub(crate) struct Host<V: Version> {
    pub(crate) c: Component,
    pub(crate) log: Box<V::Log>,
    pub(crate) resources: Arc<Resources>,
    simulation: OnceCell<Simulation>,
}

impl<V: Version> Host<V> {
    pub(crate) fn of_parts((c, log): (Component, Box<V::Log>), resources: Arc<Resources>) -> Self {
        assert!(!c.is_null(), "{:?}", V::lines(&log));
        Self { c, log, resources, simulation: OnceCell::new() }
    }

    /// An instance of given resources, which others may share.
    pub(crate) fn with(resources: impl Into<Arc<Resources>>, name: &str, logging: bool) -> Self {
        let resources = resources.into();
        Self::of_parts(V::make(Arc::clone(&resources), name, logging), resources)
    }

    /// An instance of a shipped scene, logging on.
    pub(crate) fn of(scene: &str) -> Self {
        Self::named(scene, "instance 1")
    }

    /// The same with a name.
    pub(crate) fn named(scene: &str, name: &str) -> Self {
        Self::with(Resources::of(scene), name, true)
    }

    /// An instance at its first communication point.
    pub(crate) fn started(scene: &str) -> Self {
        Self::started_at(scene, 0.0, None)
    }

    /// The same at another time, with a stop time.
    pub(crate) fn started_at(scene: &str, start: f64, stop: Option<f64>) -> Self {
        let host = Self::of(scene);
        host.start_at(start, stop);
        host
    }

    /// An instance in initialization mode.
    pub(crate) fn initializing(scene: &str) -> Self {
        let host = Self::of(scene);
        assert_eq!(host.begin(None, 0.0, None), Status::Ok, "{:?}", host.lines());
        host
    }

    /// From instantiated to the first communication point at 0 s.
    pub(crate) fn start(&self) {
        self.start_at(0.0, None);
    }

    pub(crate) fn start_at(&self, start: f64, stop: Option<f64>) {
        assert_eq!(self.begin(None, start, stop), Status::Ok, "{:?}", self.lines());
        assert_eq!(self.exit(), Status::Ok, "{:?}", self.lines());
    }

    /// Into initialization mode.
    pub(crate) fn begin(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
        V::begin(self, tolerance, start, stop)
    }

    /// The status of a step.
    pub(crate) fn advance(&self, point: f64, size: f64) -> Status {
        V::step(self, point, size)
    }

    /// The lines logged since the last call.
    pub(crate) fn lines(&self) -> Vec<Line> {
        V::lines(&self.log)
    }

    pub(crate) fn last_message(&self) -> String {
        self.lines().pop().map(|line| line.message).unwrap_or_default()
    }

    /// A call that is refused, with all of these words in the last line, which is given, and taken back by restoring a
    /// state.
    #[track_caller]
    pub(crate) fn refuses(&self, state: FmuState, words: &[&str], call: impl FnOnce(&Self) -> Status) -> String {
        self.lines();
        assert_eq!(call(self), Status::Error, "{words:?}");
        let message = self.last_message();
        for word in words {
            assert!(message.contains(word), "{word}: {message}");
        }
        assert_eq!(self.restore(state), Status::Ok, "{words:?}");
        message
    }

    pub(crate) fn exit(&self) -> Status {
        // SAFETY of this and those below: any handles may be passed; pointers are to as much as is said.
        unsafe { (V::FUNCTIONS.exit)(self.c) }
    }

    pub(crate) fn terminate(&self) -> Status {
        unsafe { (V::FUNCTIONS.terminate)(self.c) }
    }

    pub(crate) fn reset(&self) -> Status {
        unsafe { (V::FUNCTIONS.reset)(self.c) }
    }

    /// Reads `count` values behind references.
    pub(crate) fn get_values(&self, references: &[u32], count: usize) -> Result<Vec<f64>, Status> {
        let mut values = vec![f64::NAN; count];
        V::get(self.c, references, &mut values).of(values)
    }

    /// Reads scalars.
    pub(crate) fn get(&self, references: &[u32]) -> Result<Vec<f64>, Status> {
        self.get_values(references, references.len())
    }

    pub(crate) fn set(&self, references: &[u32], values: &[f64]) -> Status {
        V::set(self.c, references, values)
    }

    /// All real values.
    pub(crate) fn all(&self) -> Vec<f64> {
        let (references, count) = V::reals(self.simulation());
        self.get_values(&references, count).unwrap()
    }

    pub(crate) fn save(&self) -> FmuState {
        let mut state = ptr::null_mut();
        assert_eq!(unsafe { (V::FUNCTIONS.get_state)(self.c, &raw mut state) }, Status::Ok, "{:?}", self.lines());
        state
    }

    pub(crate) fn restore(&self, state: FmuState) -> Status {
        unsafe { (V::FUNCTIONS.set_state)(self.c, state) }
    }

    pub(crate) fn free(&self, mut state: FmuState) -> Status {
        unsafe { (V::FUNCTIONS.free_state)(self.c, &raw mut state) }
    }

    pub(crate) fn serialize(&self, state: FmuState) -> Vec<u8> {
        let mut size = 0;
        assert_eq!(unsafe { (V::FUNCTIONS.state_size)(self.c, state, &raw mut size) }, Status::Ok);
        let mut bytes = vec![0u8; size];
        let status = unsafe { (V::FUNCTIONS.serialize)(self.c, state, bytes.as_mut_ptr().cast(), size) };
        assert_eq!(status, Status::Ok, "{:?}", self.lines());
        bytes
    }

    pub(crate) fn deserialize(&self, bytes: &[u8]) -> Result<FmuState, Status> {
        let mut state = ptr::null_mut();
        unsafe { (V::FUNCTIONS.deserialize)(self.c, bytes.as_ptr().cast(), bytes.len(), &raw mut state) }.of(state)
    }

    /// The value reference of a variable.
    pub(crate) fn reference(&self, name: &str) -> u32 {
        V::reference(self.simulation(), name)
    }

    /// The variable table, as the model description would tell it.
    pub(crate) fn table(&self) -> &[Variable] {
        self.simulation().table()
    }

    /// The model behind the interface, set up once more.
    pub(crate) fn simulation(&self) -> &Simulation {
        self.simulation.get_or_init(|| {
            let read = |file: &str| fs::read_to_string(self.resources.directory.join(file)).unwrap();
            let scene = brinell_scene_file::from_toml(&read("scene.toml")).unwrap();
            let profiles: Vec<String> = scene.profile_names().into_iter().map(read).collect();
            Simulation::new(scene, profiles.iter().map(String::as_str)).unwrap()
        })
    }
}

impl<V: Version> Drop for Host<V> {
    fn drop(&mut self) {
        // SAFETY: any handle may be passed, also one that a test has freed.
        unsafe { (V::FUNCTIONS.free)(self.c) };
    }
}

/// A result under OK, or the status.
pub(crate) trait Of: Sized {
    fn of<T>(self, result: T) -> Result<T, Self>;
}

impl Of for Status {
    fn of<T>(self, result: T) -> Result<T, Self> {
        if self == Self::Ok { Ok(result) } else { Err(self) }
    }
}

pub(crate) fn is_real(variable: &Variable) -> bool {
    matches!(variable.kind, Kind::Real { .. })
}
