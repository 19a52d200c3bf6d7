//! A host of FMI 3.0: unpacked resources, a logger that remembers, a function for intermediate updates, and the
//! exported functions as methods.

pub(crate) use crate::two::Resources;
use brinell::simulation::Simulation;
use brinell::simulation::interface::of_all_elements;
use brinell::simulation::interface::table::Variable;
use brinell_fmi::fmi3::*;
use std::cell::{Cell, RefCell};
use std::ffi::{CStr, CString};
use std::sync::Arc;
use std::{fs, ptr};

/// One call of the logger.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Line {
    pub(crate) status: Status,
    pub(crate) category: String,
    pub(crate) message: String,
}

/// What the FMU says in an intermediate update.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Update {
    pub(crate) instance: Instance,
    pub(crate) time: f64,
    pub(crate) set_requested: bool,
    pub(crate) get_allowed: bool,
    pub(crate) finished: bool,
    pub(crate) can_return: bool,
}

/// What a host does in an intermediate update; a time is one at which it wants the step to return.
pub(crate) type OnUpdate = Box<dyn FnMut(Update) -> Option<f64>>;

/// The instance environment points here.
#[derive(Default)]
pub(crate) struct Environment {
    lines: RefCell<Vec<Line>>,
    on_update: RefCell<Option<OnUpdate>>,
    instance: Cell<Option<Instance>>,
}

unsafe extern "C-unwind" fn remember(
    environment: InstanceEnvironment,
    status: Status,
    category: FmiString,
    message: FmiString,
) {
    // SAFETY: the environment is that of a living `Host`; Brinell passes strings that end in NUL, or this test fails.
    let (environment, texts) = unsafe {
        let text = |pointer| CStr::from_ptr(pointer).to_str().unwrap().to_owned();
        (&*environment.cast::<Environment>(), [category, message].map(text))
    };
    let [category, message] = texts;
    environment.lines.borrow_mut().push(Line { status, category, message });
}

unsafe extern "C-unwind" fn update(
    environment: InstanceEnvironment,
    time: f64,
    set_requested: Bool,
    get_allowed: Bool,
    finished: Bool,
    can_return: Bool,
    early_return_requested: *mut Bool,
    early_return_time: *mut f64,
) {
    // SAFETY: as above.
    let environment = unsafe { &*environment.cast::<Environment>() };
    let [set_requested, get_allowed, finished, can_return] =
        [set_requested, get_allowed, finished, can_return].map(|flag| flag != FALSE);
    let instance = environment.instance.get().unwrap();
    let told = Update { instance, time, set_requested, get_allowed, finished, can_return };
    if let Some(at) = environment.on_update.borrow_mut().as_mut().and_then(|on_update| on_update(told)) {
        // SAFETY: the pointers are the FMU's.
        unsafe {
            *early_return_requested = TRUE;
            *early_return_time = at;
        }
    }
}

/// What a host passes to `fmi3InstantiateCoSimulation`; `None` stands for NULL.
pub(crate) struct Call<'a> {
    pub(crate) name: Option<&'a str>,
    pub(crate) token: Option<&'a str>,
    pub(crate) path: Option<&'a str>,
    pub(crate) logging: bool,
    pub(crate) event_mode: bool,
    pub(crate) early_return: bool,
    pub(crate) required: &'a [u32],
    pub(crate) on_update: Option<OnUpdate>,
}

impl Call<'_> {
    pub(crate) fn make(self) -> (Instance, Box<Environment>) {
        let callback = self.on_update.as_ref().map(|_| update as IntermediateUpdateCallback);
        let environment = Box::new(Environment { on_update: RefCell::new(self.on_update), ..Environment::default() });
        let texts = [self.name, self.token, self.path].map(|text| text.map(|text| CString::new(text).unwrap()));
        let [name, token, path] = texts.each_ref().map(|text| text.as_ref().map_or(ptr::null(), |text| text.as_ptr()));
        // SAFETY: strings end in NUL, the list is as long as said; the environment lives as long as the instance.
        let instance = unsafe {
            fmi3InstantiateCoSimulation(
                name,
                token,
                path,
                FALSE,
                self.logging.into(),
                self.event_mode.into(),
                self.early_return.into(),
                self.required.as_ptr(),
                self.required.len(),
                ptr::from_ref(&*environment).cast_mut().cast(),
                Some(remember),
                callback,
            )
        };
        environment.instance.set(Some(instance));
        (instance, environment)
    }
}

impl Environment {
    /// The lines logged since the last call.
    pub(crate) fn take(&self) -> Vec<Line> {
        self.lines.take()
    }
}

/// An instance and its host.
pub(crate) struct Host {
    pub(crate) c: Instance,
    pub(crate) environment: Box<Environment>,
    pub(crate) resources: Arc<Resources>,
    simulation: Simulation,
}

/// What `fmi3DoStep` gives beside its status: event handling, termination, early return, time.
pub(crate) type Stepped = (bool, bool, bool, f64);

impl Host {
    /// An instance of a shipped scene, logging on.
    pub(crate) fn of(scene: &str) -> Self {
        Self::with(Resources::of(scene), "instance 1", &[], None)
    }

    /// An instance at its first communication point.
    pub(crate) fn started(scene: &str) -> Self {
        let host = Self::of(scene);
        host.start();
        host
    }

    /// An instance that has intermediate updates with these variables and can handle an early return.
    pub(crate) fn updated(scene: &str, required: &[&str], on_update: OnUpdate) -> Self {
        let resources = Resources::of(scene);
        let simulation = simulation_of(&resources);
        let required: Vec<u32> = required.iter().map(|name| reference(&simulation, name)).collect();
        let host = Self::with(resources, "instance 1", &required, Some(on_update));
        host.start();
        host
    }

    pub(crate) fn with(
        resources: impl Into<Arc<Resources>>,
        name: &str,
        required: &[u32],
        on_update: Option<OnUpdate>,
    ) -> Self {
        let resources = resources.into();
        let path = format!("{}/", resources.directory.to_str().unwrap());
        let call = Call {
            name: Some(name),
            token: Some(&resources.guid),
            path: Some(&path),
            logging: true,
            event_mode: false,
            early_return: true,
            required,
            on_update,
        };
        let (c, environment) = call.make();
        assert!(!c.is_null(), "{:?}", environment.take());
        let simulation = simulation_of(&resources);
        Self { c, environment, resources, simulation }
    }

    /// From instantiated to the first communication point at 0 s.
    pub(crate) fn start(&self) {
        assert_eq!(self.enter(None, 0.0, None), Status::Ok, "{:?}", self.lines());
        assert_eq!(self.exit(), Status::Ok, "{:?}", self.lines());
    }

    pub(crate) fn lines(&self) -> Vec<Line> {
        self.environment.take()
    }

    pub(crate) fn last_message(&self) -> String {
        self.lines().pop().map(|line| line.message).unwrap_or_default()
    }

    pub(crate) fn enter(&self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
        let flag = |value: Option<f64>| Bool::from(value.is_some());
        let (tolerance_given, stop_given) = (flag(tolerance), flag(stop));
        let (tolerance, stop) = (tolerance.unwrap_or(f64::NAN), stop.unwrap_or(f64::NAN));
        // SAFETY: no pointers but the handle.
        unsafe { fmi3EnterInitializationMode(self.c, tolerance_given, tolerance, start, stop_given, stop) }
    }

    pub(crate) fn exit(&self) -> Status {
        // SAFETY: no pointers but the handle.
        unsafe { fmi3ExitInitializationMode(self.c) }
    }

    pub(crate) fn terminate(&self) -> Status {
        // SAFETY: no pointers but the handle.
        unsafe { fmi3Terminate(self.c) }
    }

    pub(crate) fn reset(&self) -> Status {
        // SAFETY: no pointers but the handle.
        unsafe { fmi3Reset(self.c) }
    }

    pub(crate) fn do_step(&self, point: f64, size: f64) -> Result<Stepped, Status> {
        let (mut event, mut terminate, mut early, mut time) = (9, 9, 9, f64::NAN);
        // SAFETY: pointers to one value each.
        let status = unsafe {
            let pointers = (&raw mut event, &raw mut terminate, &raw mut early, &raw mut time);
            fmi3DoStep(self.c, point, size, TRUE, pointers.0, pointers.1, pointers.2, pointers.3)
        };
        match status {
            Status::Ok => Ok((event != FALSE, terminate != FALSE, early != FALSE, time)),
            status => Err(status),
        }
    }

    /// A step that ends where it should.
    pub(crate) fn step(&self, point: f64, size: f64) {
        let stepped = self.do_step(point, size);
        assert_eq!(stepped, Ok((false, false, false, point + size)), "{:?}", self.lines());
    }

    /// Reads `count` values behind references.
    pub(crate) fn get_values(&self, references: &[u32], count: usize) -> Result<Vec<f64>, Status> {
        get(self.c, references, count)
    }

    /// Reads scalars.
    pub(crate) fn get(&self, references: &[u32]) -> Result<Vec<f64>, Status> {
        self.get_values(references, references.len())
    }

    /// Reads all elements of an array.
    pub(crate) fn array(&self, name: &str) -> Result<Vec<f64>, Status> {
        self.get_values(&[self.reference(name)], self.simulation.scene().bearing.element_count)
    }

    pub(crate) fn set(&self, references: &[u32], values: &[f64]) -> Status {
        set(self.c, references, values)
    }

    pub(crate) fn save(&self) -> FmuState {
        let mut state = ptr::null_mut();
        // SAFETY: `state` is NULL, as the first call wants it.
        assert_eq!(unsafe { fmi3GetFMUState(self.c, &raw mut state) }, Status::Ok, "{:?}", self.lines());
        state
    }

    pub(crate) fn restore(&self, state: FmuState) -> Status {
        // SAFETY: any handle may be passed.
        unsafe { fmi3SetFMUState(self.c, state) }
    }

    pub(crate) fn free(&self, mut state: FmuState) -> Status {
        // SAFETY: any handle may be passed.
        unsafe { fmi3FreeFMUState(self.c, &raw mut state) }
    }

    pub(crate) fn serialize(&self, state: FmuState) -> Vec<u8> {
        let mut size = 0;
        // SAFETY: `size` may be written.
        assert_eq!(unsafe { fmi3SerializedFMUStateSize(self.c, state, &raw mut size) }, Status::Ok);
        let mut bytes = vec![0u8; size];
        // SAFETY: the buffer has the size said.
        assert_eq!(unsafe { fmi3SerializeFMUState(self.c, state, bytes.as_mut_ptr(), size) }, Status::Ok);
        bytes
    }

    pub(crate) fn deserialize(&self, bytes: &[u8]) -> Result<FmuState, Status> {
        let mut state = ptr::null_mut();
        // SAFETY: the bytes are as many as said, `state` is NULL.
        match unsafe { fmi3DeserializeFMUState(self.c, bytes.as_ptr(), bytes.len(), &raw mut state) } {
            Status::Ok => Ok(state),
            status => Err(status),
        }
    }

    /// The value reference of a variable by its name in FMI 3.0.
    pub(crate) fn reference(&self, name: &str) -> u32 {
        reference(&self.simulation, name)
    }

    pub(crate) fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    pub(crate) fn table(&self) -> &[Variable] {
        self.simulation.table()
    }

    /// References of all real variables, arrays by that of their first element, and the number of their values.
    pub(crate) fn reals(&self) -> (Vec<u32>, usize) {
        reals(&self.simulation)
    }

    /// All real values.
    pub(crate) fn all(&self) -> Vec<f64> {
        let (references, count) = self.reals();
        self.get_values(&references, count).unwrap()
    }
}

/// References of all real variables, and the number of their values.
pub(crate) fn reals(simulation: &Simulation) -> (Vec<u32>, usize) {
    use brinell::simulation::interface::table::Kind;
    let arrays = simulation.arrays();
    let is_real = |row: &&Variable| matches!(row.kind, Kind::Real { .. });
    let rows: Vec<u32> = simulation.table().iter().filter(is_real).map(|row| row.reference).collect();
    let is_shown = |row: &u32| arrays.iter().all(|array| array.rows[0] == *row || !array.rows.contains(row));
    (rows.iter().copied().filter(is_shown).collect(), rows.len())
}

/// The value reference of a variable by its name in FMI 3.0.
pub(crate) fn reference(simulation: &Simulation, name: &str) -> u32 {
    if name == "time" {
        return simulation.table().len() as u32;
    }
    let arrays = simulation.arrays();
    let array = arrays
        .iter()
        .map(|array| array.rows[0])
        .find(|&first| of_all_elements(&simulation.table()[first as usize]).0 == name);
    array.unwrap_or_else(|| simulation.reference(name).unwrap())
}

pub(crate) fn simulation_of(resources: &Resources) -> Simulation {
    let text = fs::read_to_string(resources.directory.join("scene.toml")).unwrap();
    let scene = brinell_scene_file::from_toml(&text).unwrap();
    let read = |file: &str| fs::read_to_string(resources.directory.join(file)).unwrap();
    let profiles: Vec<String> = scene.profile_names().into_iter().map(read).collect();
    Simulation::new(scene, profiles.iter().map(String::as_str)).unwrap()
}

pub(crate) fn get(c: Instance, references: &[u32], count: usize) -> Result<Vec<f64>, Status> {
    let mut values = vec![f64::NAN; count];
    // SAFETY: the arrays are as long as said.
    match unsafe { fmi3GetFloat64(c, references.as_ptr(), references.len(), values.as_mut_ptr(), count) } {
        Status::Ok => Ok(values),
        status => Err(status),
    }
}

pub(crate) fn set(c: Instance, references: &[u32], values: &[f64]) -> Status {
    // SAFETY: the arrays are as long as said.
    unsafe { fmi3SetFloat64(c, references.as_ptr(), references.len(), values.as_ptr(), values.len()) }
}

impl Drop for Host {
    fn drop(&mut self) {
        // SAFETY: any handle may be passed, also one that a test has freed.
        unsafe { fmi3FreeInstance(self.c) };
    }
}
