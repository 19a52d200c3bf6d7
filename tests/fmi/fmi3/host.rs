//! A host of FMI 3.0: unpacked resources, a logger that remembers, a function for intermediate updates, and the
//! exported functions as methods.

pub(crate) use crate::two::Resources;
use crate::two::any_host::{self, Functions, Line, Of, Version, is_real};
use brinell::simulation::Simulation;
use brinell::simulation::interface::of_all_elements;
use brinell_fmi::fmi3::*;
use std::cell::{Cell, RefCell};
use std::ffi::{CStr, CString};
use std::ptr;
use std::sync::Arc;

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
    let (instance, format) = (String::new(), String::new());
    environment.lines.borrow_mut().push(Line { instance, status, category, format, message });
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
    /// `fmi3InstantiateModelExchange`, which takes nothing of what follows but the logging.
    pub(crate) model_exchange: bool,
    pub(crate) logging: bool,
    pub(crate) event_mode: bool,
    pub(crate) early_return: bool,
    pub(crate) required: &'a [u32],
    pub(crate) on_update: Option<OnUpdate>,
}

impl<'a> Call<'a> {
    /// One that nothing is wrong with, and asks for nothing.
    pub(crate) fn good(token: &'a str, path: &'a str) -> Self {
        Self {
            name: Some("instance 1"),
            token: Some(token),
            path: Some(path),
            model_exchange: false,
            logging: false,
            event_mode: false,
            early_return: false,
            required: &[],
            on_update: None,
        }
    }

    pub(crate) fn make(self) -> (Instance, Box<Environment>) {
        let callback = self.on_update.as_ref().map(|_| update as IntermediateUpdateCallback);
        let environment = Box::new(Environment { on_update: RefCell::new(self.on_update), ..Environment::default() });
        let texts = [self.name, self.token, self.path].map(|text| text.map(|text| CString::new(text).unwrap()));
        let [name, token, path] = texts.each_ref().map(|text| text.as_ref().map_or(ptr::null(), |text| text.as_ptr()));
        let (own, logging) = (ptr::from_ref(&*environment).cast_mut().cast(), self.logging.into());
        let (event_mode, early_return) = (self.event_mode.into(), self.early_return.into());
        let (list, count) = (self.required.as_ptr(), self.required.len());
        let log = Some(remember as LogMessageCallback);
        // SAFETY: strings end in NUL, the list is as long as said; the environment lives as long as the instance.
        let instance = unsafe {
            if self.model_exchange {
                fmi3InstantiateModelExchange(name, token, path, FALSE, logging, own, log)
            } else {
                fmi3InstantiateCoSimulation(
                    name,
                    token,
                    path,
                    FALSE,
                    logging,
                    event_mode,
                    early_return,
                    list,
                    count,
                    own,
                    log,
                    callback,
                )
            }
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

/// What `fmi3DoStep` gives beside its status: event handling, termination, early return, time.
pub(crate) type Stepped = (bool, bool, bool, f64);

/// FMI 3.0.
pub(crate) struct Three;

/// An instance and its host.
pub(crate) type Host = any_host::Host<Three>;

impl Version for Three {
    type Log = Environment;
    type Byte = u8;
    const FUNCTIONS: Functions<u8> = Functions {
        free: fmi3FreeInstance,
        exit: fmi3ExitInitializationMode,
        terminate: fmi3Terminate,
        reset: fmi3Reset,
        get_state: fmi3GetFMUState,
        set_state: fmi3SetFMUState,
        free_state: fmi3FreeFMUState,
        state_size: fmi3SerializedFMUStateSize,
        serialize: fmi3SerializeFMUState,
        deserialize: fmi3DeserializeFMUState,
    };

    fn lines(environment: &Environment) -> Vec<Line> {
        environment.take()
    }

    fn make(resources: Arc<Resources>, name: &str, logging: bool) -> (Instance, Box<Environment>) {
        let path = resources.directory.to_str().unwrap();
        Call { name: Some(name), logging, early_return: true, ..Call::good(&resources.guid, path) }.make()
    }

    fn begin(host: &Host, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Status {
        let flag = |value: Option<f64>| Bool::from(value.is_some());
        let (tolerance_given, stop_given) = (flag(tolerance), flag(stop));
        let (tolerance, stop) = (tolerance.unwrap_or(f64::NAN), stop.unwrap_or(f64::NAN));
        // SAFETY: no pointers but the handle.
        unsafe { fmi3EnterInitializationMode(host.c, tolerance_given, tolerance, start, stop_given, stop) }
    }

    fn step(host: &Host, point: f64, size: f64) -> Status {
        host.do_step(point, size).err().unwrap_or(Status::Ok)
    }

    fn get(c: Instance, references: &[u32], values: &mut [f64]) -> Status {
        // SAFETY: the arrays are as long as said.
        unsafe { fmi3GetFloat64(c, references.as_ptr(), references.len(), values.as_mut_ptr(), values.len()) }
    }

    fn set(c: Instance, references: &[u32], values: &[f64]) -> Status {
        // SAFETY: the arrays are as long as said.
        unsafe { fmi3SetFloat64(c, references.as_ptr(), references.len(), values.as_ptr(), values.len()) }
    }

    /// Arrays by the reference of their first element.
    fn reals(simulation: &Simulation) -> (Vec<u32>, usize) {
        let arrays = simulation.arrays();
        let real = simulation.table().iter().filter(|row| is_real(row));
        let rows: Vec<u32> = real.map(|row| row.reference).collect();
        let is_shown = |row: &u32| arrays.iter().all(|array| array.rows[0] == *row || !array.rows.contains(row));
        (rows.iter().copied().filter(is_shown).collect(), rows.len())
    }

    /// By its name in FMI 3.0.
    fn reference(simulation: &Simulation, name: &str) -> u32 {
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
}

impl Host {
    /// An instance that has intermediate updates with these variables and can handle an early return.
    pub(crate) fn updated(scene: &str, required: &[u32], on_update: OnUpdate) -> Self {
        let host = Self::updated_with(Resources::of(scene), required, on_update);
        host.start();
        host
    }

    /// The same of given resources, before it is started.
    pub(crate) fn updated_with(resources: Resources, required: &[u32], on_update: OnUpdate) -> Self {
        let path = resources.directory.to_str().unwrap();
        let call = Call { required, on_update: Some(on_update), ..Call::good(&resources.guid, path) };
        let parts = Call { logging: true, early_return: true, ..call }.make();
        Self::of_parts(parts, resources.into())
    }

    pub(crate) fn do_step(&self, point: f64, size: f64) -> Result<Stepped, Status> {
        let (mut event, mut terminate, mut early, mut time) = (9, 9, 9, f64::NAN);
        // SAFETY: pointers to one value each.
        let status = unsafe {
            let pointers = (&raw mut event, &raw mut terminate, &raw mut early, &raw mut time);
            fmi3DoStep(self.c, point, size, TRUE, pointers.0, pointers.1, pointers.2, pointers.3)
        };
        status.of((event != FALSE, terminate != FALSE, early != FALSE, time))
    }

    /// A step that ends where it should.
    pub(crate) fn step(&self, point: f64, size: f64) {
        let stepped = self.do_step(point, size);
        assert_eq!(stepped, Ok((false, false, false, point + size)), "{:?}", self.lines());
    }

    /// Reads all elements of an array.
    pub(crate) fn array(&self, name: &str) -> Result<Vec<f64>, Status> {
        self.get_values(&[self.reference(name)], self.simulation().scene().bearing.element_count)
    }

    /// References of all real variables, arrays by that of their first element, and the number of their values.
    pub(crate) fn reals(&self) -> (Vec<u32>, usize) {
        Three::reals(self.simulation())
    }

    /// Derivatives of as many values behind `unknowns` by knowns, times a seed.
    pub(crate) fn directional(&self, of: [&[u32]; 2], seed: &[f64], count: usize) -> Result<Vec<f64>, Status> {
        product(self, fmi3GetDirectionalDerivative, of, seed, count)
    }

    /// Derivatives of as many outputs by time.
    pub(crate) fn by_time(&self, unknowns: &[u32], count: usize) -> Result<Vec<f64>, Status> {
        let (orders, mut values) = (vec![1; unknowns.len()], vec![f64::NAN; count]);
        let (of, into) = (unknowns.as_ptr(), values.as_mut_ptr());
        // SAFETY: the arrays are as long as said.
        unsafe { fmi3GetOutputDerivatives(self.c, of, unknowns.len(), orders.as_ptr(), into, count) }.of(values)
    }
}

/// `fmi3GetDirectionalDerivative` or `fmi3GetAdjointDerivative`.
pub(crate) type Derivative =
    unsafe extern "C" fn(Instance, *const u32, usize, *const u32, usize, *const f64, usize, *mut f64, usize) -> Status;

/// What it gives for unknowns, knowns and a seed.
pub(crate) fn product(
    host: &Host,
    function: Derivative,
    [unknowns, knowns]: [&[u32]; 2],
    seed: &[f64],
    count: usize,
) -> Result<Vec<f64>, Status> {
    let mut values = vec![f64::NAN; count];
    let (of, by, into) = (unknowns.as_ptr(), knowns.as_ptr(), values.as_mut_ptr());
    let (rows, columns) = (unknowns.len(), knowns.len());
    // SAFETY: the arrays are as long as said.
    unsafe { function(host.c, of, rows, by, columns, seed.as_ptr(), seed.len(), into, count) }.of(values)
}

/// Reads `count` values by a handle, as in an update.
pub(crate) fn get(c: Instance, references: &[u32], count: usize) -> Result<Vec<f64>, Status> {
    let mut values = vec![f64::NAN; count];
    Three::get(c, references, &mut values).of(values)
}

/// Sets values by a handle.
pub(crate) fn set(c: Instance, references: &[u32], values: &[f64]) -> Status {
    Three::set(c, references, values)
}
