//! A small FMI 3.0 host: just enough to try an FMU through its C interface.
//!
//! It trusts the library to follow the standard's binary interface; that is what loading a library means.

#![allow(unsafe_code)]

use std::ffi::{CString, c_char, c_int, c_void};
use std::path::Path;
use std::ptr;

use libloading::{Library, Symbol};

use super::fmi2::{Log, SavedState, SlaveError, call, keep, loaded, text};

/// All functions, which the standard wants of an FMU of whatever kind.
const FUNCTIONS: [&str; 75] = [
    "fmi3ActivateModelPartition",
    "fmi3CompletedIntegratorStep",
    "fmi3DeserializeFMUState",
    "fmi3DoStep",
    "fmi3EnterConfigurationMode",
    "fmi3EnterContinuousTimeMode",
    "fmi3EnterEventMode",
    "fmi3EnterInitializationMode",
    "fmi3EnterStepMode",
    "fmi3EvaluateDiscreteStates",
    "fmi3ExitConfigurationMode",
    "fmi3ExitInitializationMode",
    "fmi3FreeFMUState",
    "fmi3FreeInstance",
    "fmi3GetAdjointDerivative",
    "fmi3GetBinary",
    "fmi3GetBoolean",
    "fmi3GetClock",
    "fmi3GetContinuousStateDerivatives",
    "fmi3GetContinuousStates",
    "fmi3GetDirectionalDerivative",
    "fmi3GetEventIndicators",
    "fmi3GetFMUState",
    "fmi3GetFloat32",
    "fmi3GetFloat64",
    "fmi3GetInt16",
    "fmi3GetInt32",
    "fmi3GetInt64",
    "fmi3GetInt8",
    "fmi3GetIntervalDecimal",
    "fmi3GetIntervalFraction",
    "fmi3GetNominalsOfContinuousStates",
    "fmi3GetNumberOfContinuousStates",
    "fmi3GetNumberOfEventIndicators",
    "fmi3GetNumberOfVariableDependencies",
    "fmi3GetOutputDerivatives",
    "fmi3GetShiftDecimal",
    "fmi3GetShiftFraction",
    "fmi3GetString",
    "fmi3GetUInt16",
    "fmi3GetUInt32",
    "fmi3GetUInt64",
    "fmi3GetUInt8",
    "fmi3GetVariableDependencies",
    "fmi3GetVersion",
    "fmi3InstantiateCoSimulation",
    "fmi3InstantiateModelExchange",
    "fmi3InstantiateScheduledExecution",
    "fmi3Reset",
    "fmi3SerializeFMUState",
    "fmi3SerializedFMUStateSize",
    "fmi3SetBinary",
    "fmi3SetBoolean",
    "fmi3SetClock",
    "fmi3SetContinuousStates",
    "fmi3SetDebugLogging",
    "fmi3SetFMUState",
    "fmi3SetFloat32",
    "fmi3SetFloat64",
    "fmi3SetInt16",
    "fmi3SetInt32",
    "fmi3SetInt64",
    "fmi3SetInt8",
    "fmi3SetIntervalDecimal",
    "fmi3SetIntervalFraction",
    "fmi3SetShiftDecimal",
    "fmi3SetShiftFraction",
    "fmi3SetString",
    "fmi3SetTime",
    "fmi3SetUInt16",
    "fmi3SetUInt32",
    "fmi3SetUInt64",
    "fmi3SetUInt8",
    "fmi3Terminate",
    "fmi3UpdateDiscreteStates",
];

type Handle = *mut c_void;
type Logger = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, *const c_char);

/// What `fmi3DoStep` says.
#[derive(Debug, Clone, Copy)]
pub struct Stepped {
    /// The time reached (s).
    pub time: f64,
    /// Whether the FMU wants the run to end.
    pub terminate: bool,
}

/// One instance of a co-simulation FMU. It wants no intermediate updates and no early return.
#[derive(Debug)]
pub struct Slave3 {
    // Fields drop in this order; the instance is freed in `drop`, before any of them.
    instance: Handle,
    library: Library,
    log: Box<Log>,
}

impl Slave3 {
    /// Loads the library and makes an instance. `resources` is the unpacked folder of that name, if there is one.
    pub fn new(path: &Path, instance: &str, token: &str, resources: &Path) -> Result<Self, SlaveError> {
        let library = loaded(path, &FUNCTIONS)?;
        let mut slave = Self { instance: ptr::null_mut(), library, log: Box::default() };
        let separator = std::path::MAIN_SEPARATOR;
        let folder = CString::new(format!("{}{separator}", resources.display()))?;
        let (name, token) = (CString::new(instance)?, CString::new(token)?);
        let folder = if resources.is_dir() { folder.as_ptr() } else { ptr::null() };
        type Instantiate = unsafe extern "C" fn(
            *const c_char,
            *const c_char,
            *const c_char,
            bool,
            bool,
            bool,
            bool,
            *const u32,
            usize,
            *mut c_void,
            Logger,
            Option<unsafe extern "C" fn()>,
        ) -> Handle;
        let environment = ptr::from_ref(&*slave.log).cast_mut().cast();
        // SAFETY: standard's signature; the strings live through the call, the log as long as the instance.
        slave.instance = unsafe {
            let instantiate: Symbol<'_, Instantiate> = slave.library.get("fmi3InstantiateCoSimulation")?;
            let (name, token) = (name.as_ptr(), token.as_ptr());
            instantiate(name, token, folder, false, true, false, false, ptr::null(), 0, environment, note, None)
        };
        if slave.instance.is_null() {
            let log = slave.last_line();
            return Err(SlaveError::NoInstance { function: "fmi3InstantiateCoSimulation", log });
        }
        Ok(slave)
    }

    /// Into and out of initialization with start time 0, a tolerance and no stop time.
    pub fn initialize(&mut self, tolerance: f64) -> Result<(), SlaveError> {
        call!(
            self,
            "fmi3EnterInitializationMode",
            (Handle, bool, f64, f64, bool, f64),
            (self.instance, true, tolerance, 0.0, false, 0.0)
        )?;
        call!(self, "fmi3ExitInitializationMode", (Handle), (self.instance))
    }

    /// `fmi3GetFloat64`; the variables have `count` values in all.
    pub fn reals(&mut self, references: &[u32], count: usize) -> Result<Vec<f64>, SlaveError> {
        let mut values = vec![f64::NAN; count];
        call!(
            self,
            "fmi3GetFloat64",
            (Handle, *const u32, usize, *mut f64, usize),
            (self.instance, references.as_ptr(), references.len(), values.as_mut_ptr(), count)
        )?;
        Ok(values)
    }

    /// `fmi3DoStep`.
    pub fn step(&mut self, from: f64, step: f64) -> Result<Stepped, SlaveError> {
        let (mut event, mut terminate, mut early, mut time) = (false, false, false, f64::NAN);
        call!(
            self,
            "fmi3DoStep",
            (Handle, f64, f64, bool, *mut bool, *mut bool, *mut bool, *mut f64),
            (self.instance, from, step, false, &mut event, &mut terminate, &mut early, &mut time)
        )?;
        Ok(Stepped { time, terminate })
    }

    /// `fmi3GetFMUState`.
    pub fn save(&mut self) -> Result<SavedState, SlaveError> {
        let mut state: Handle = ptr::null_mut();
        call!(self, "fmi3GetFMUState", (Handle, *mut Handle), (self.instance, &mut state))?;
        Ok(SavedState(state))
    }

    /// `fmi3SetFMUState`.
    pub fn restore(&mut self, state: &SavedState) -> Result<(), SlaveError> {
        call!(self, "fmi3SetFMUState", (Handle, Handle), (self.instance, state.0))
    }

    /// `fmi3FreeFMUState`.
    pub fn free(&mut self, mut state: SavedState) -> Result<(), SlaveError> {
        call!(self, "fmi3FreeFMUState", (Handle, *mut Handle), (self.instance, &mut state.0))
    }

    /// `fmi3SerializeFMUState`.
    pub fn to_bytes(&mut self, state: &SavedState) -> Result<Vec<u8>, SlaveError> {
        let (c, mut size) = (self.instance, 0);
        call!(self, "fmi3SerializedFMUStateSize", (Handle, Handle, *mut usize), (c, state.0, &mut size))?;
        let mut bytes = vec![0u8; size];
        let pointer = bytes.as_mut_ptr();
        call!(self, "fmi3SerializeFMUState", (Handle, Handle, *mut u8, usize), (c, state.0, pointer, size))?;
        Ok(bytes)
    }

    /// `fmi3DeserializeFMUState`.
    pub fn from_bytes(&mut self, bytes: &[u8]) -> Result<SavedState, SlaveError> {
        let mut state: Handle = ptr::null_mut();
        call!(
            self,
            "fmi3DeserializeFMUState",
            (Handle, *const u8, usize, *mut Handle),
            (self.instance, bytes.as_ptr(), bytes.len(), &mut state)
        )?;
        Ok(SavedState(state))
    }

    /// `fmi3Terminate`.
    pub fn terminate(&mut self) -> Result<(), SlaveError> {
        call!(self, "fmi3Terminate", (Handle), (self.instance))
    }

    fn last_line(&self) -> String {
        self.log.lock().ok().and_then(|mut log| log.pop()).unwrap_or_else(|| "empty".into())
    }

    fn answer(&self, function: &'static str, status: c_int) -> Result<(), SlaveError> {
        let status = match status {
            0 | 1 => return Ok(()),
            2 => "fmi3Discard",
            3 => "fmi3Error",
            4 => "fmi3Fatal",
            _ => "no status of the standard",
        };
        Err(SlaveError::Status { function, status, log: self.last_line() })
    }
}

impl Drop for Slave3 {
    fn drop(&mut self) {
        if self.instance.is_null() {
            return;
        }
        // SAFETY: standard's signature; the instance lives and is not used after this.
        unsafe {
            if let Ok(free) = self.library.get::<unsafe extern "C" fn(Handle)>("fmi3FreeInstance") {
                free(self.instance);
            }
        }
    }
}

/// The host's logger.
unsafe extern "C" fn note(environment: *mut c_void, _status: c_int, category: *const c_char, message: *const c_char) {
    // SAFETY: the standard passes zero-terminated strings; the slave passed its own log, which outlives the instance.
    unsafe { keep(environment, category, &text(message)) };
}
