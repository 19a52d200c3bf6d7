//! Any sequence of calls with any arguments: a status each time, never a crash, and a reset brings the instance back.
#![no_main]

use std::cell::OnceCell;
use std::ptr;

use arbitrary::{Arbitrary, Unstructured};
use brinell_fmi::fmi2::*;
use brinell_fuzz::{Resources, get, start};
use libfuzzer_sys::fuzz_target;

#[derive(Debug, Arbitrary)]
enum Call {
    Setup(Option<f64>, f64, Option<f64>),
    Enter,
    Exit,
    Start,
    Terminate,
    Reset,
    Step(f64, f64),
    StepOn(f64),
    Get(Vec<u8>),
    GetAll,
    GetInteger(u8),
    GetBoolean(u8),
    GetString(u8),
    Set(u8, f64),
    SetSmall(u8, i16),
    SetInteger(u8, i32),
    SetBoolean(u8, i32),
    SetString(u8),
    Rate(u8, i32, f64),
    Derivatives(u8, i32),
    Directional(Vec<u8>, Vec<u8>, f64),
    Save,
    SaveOver(u8),
    Restore(u8),
    Free(u8),
    Bytes(u8, u16, u8),
    Cancel,
    Status(u8, i32),
    Logging(bool, bool),
    Null(u8),
}

thread_local!(static RESOURCES: OnceCell<[Resources; 4]> = const { OnceCell::new() });

/// Steps of more than this only take longer.
const LONGEST: f64 = 1e-3;

fn references(bytes: &[u8]) -> Vec<u32> {
    bytes.iter().take(40).map(|&byte| u32::from(byte)).collect()
}

/// An instance under way: its states, the references of all real variables.
struct Run<'a> {
    c: Component,
    states: Vec<FmuState>,
    all: &'a [u32],
}

impl Run<'_> {
    fn make(&mut self, call: &Call) {
        match *call {
            Call::Save | Call::SaveOver(_) | Call::Restore(_) | Call::Free(_) => self.keep(call),
            Call::Bytes(number, offset, flip) => self.serialize(number, offset, flip),
            Call::Derivatives(..) | Call::Directional(..) => self.differentiate(call),
            Call::Status(which, kind) => self.ask(which, kind),
            Call::Null(which) => self.null(which),
            Call::Get(_) | Call::GetAll | Call::GetInteger(_) | Call::GetBoolean(_) | Call::GetString(_) => {
                self.read(call)
            }
            Call::Set(..)
            | Call::SetSmall(..)
            | Call::SetInteger(..)
            | Call::SetBoolean(..)
            | Call::SetString(_)
            | Call::Rate(..) => self.set(call),
            _ => self.live(call),
        }
    }

    fn live(&mut self, call: &Call) {
        let c = self.c;
        let point = || {
            let mut time = 0.0;
            unsafe { fmi2GetRealStatus(c, LAST_SUCCESSFUL_TIME, &mut time) };
            time
        };
        let short = |step: f64| if step > LONGEST && step.is_finite() { step % LONGEST } else { step };
        unsafe {
            match *call {
                Call::Setup(tolerance, begin, stop) => {
                    let (t, s) = (tolerance.is_some().into(), stop.is_some().into());
                    fmi2SetupExperiment(c, t, tolerance.unwrap_or(0.0), begin, s, stop.unwrap_or(0.0));
                }
                Call::Enter => drop(fmi2EnterInitializationMode(c)),
                Call::Exit => drop(fmi2ExitInitializationMode(c)),
                Call::Start => {
                    fmi2SetupExperiment(c, FALSE, 0.0, 0.0, FALSE, 0.0);
                    fmi2EnterInitializationMode(c);
                    fmi2ExitInitializationMode(c);
                }
                Call::Terminate => drop(fmi2Terminate(c)),
                Call::Reset => drop(fmi2Reset(c)),
                Call::Step(point, step) => drop(fmi2DoStep(c, point, short(step), TRUE)),
                Call::StepOn(step) => drop(fmi2DoStep(c, point(), short(step.abs()), FALSE)),
                Call::Cancel => drop(fmi2CancelStep(c)),
                Call::Logging(on, known) => {
                    let names = [if known { c"logStatusError" } else { c"nonsense" }.as_ptr()];
                    fmi2SetDebugLogging(c, on.into(), 1, names.as_ptr());
                }
                _ => unreachable!("{call:?} is none of an instance's life"),
            }
        }
    }

    fn read(&mut self, call: &Call) {
        let c = self.c;
        unsafe {
            match *call {
                Call::Get(ref list) => drop(get(c, &references(list))),
                Call::GetAll => drop(get(c, self.all)),
                Call::GetInteger(reference) => drop(fmi2GetInteger(c, &u32::from(reference), 1, &mut 0)),
                Call::GetBoolean(reference) => drop(fmi2GetBoolean(c, &u32::from(reference), 1, &mut 0)),
                Call::GetString(reference) => drop(fmi2GetString(c, &u32::from(reference), 1, &mut ptr::null())),
                _ => unreachable!("{call:?} reads nothing"),
            }
        }
    }

    fn set(&mut self, call: &Call) {
        let c = self.c;
        unsafe {
            match *call {
                Call::Set(reference, value) => drop(fmi2SetReal(c, &u32::from(reference), 1, &value)),
                Call::SetSmall(reference, value) => {
                    fmi2SetReal(c, &u32::from(reference), 1, &(f64::from(value) * 1e-9));
                }
                Call::SetInteger(reference, value) => {
                    // The other contact laws take seconds to set up.
                    fmi2SetInteger(c, &u32::from(reference), 1, &if (2..=3).contains(&value) { 1 } else { value });
                }
                Call::SetBoolean(reference, value) => drop(fmi2SetBoolean(c, &u32::from(reference), 1, &value)),
                Call::SetString(reference) => drop(fmi2SetString(c, &u32::from(reference), 1, &c"x".as_ptr())),
                Call::Rate(reference, order, value) => {
                    fmi2SetRealInputDerivatives(c, &u32::from(reference), 1, &order, &value);
                }
                _ => unreachable!("{call:?} sets nothing"),
            }
        }
    }

    fn differentiate(&mut self, call: &Call) {
        match *call {
            Call::Derivatives(reference, order) => {
                let mut value = 0.0;
                let reference = u32::from(reference);
                let status = unsafe { fmi2GetRealOutputDerivatives(self.c, &reference, 1, &order, &mut value) };
                assert!(status != Status::Ok || value.is_finite());
            }
            Call::Directional(ref unknowns, ref knowns, seed) => {
                let (unknowns, knowns) = (references(unknowns), references(knowns));
                let (seed, mut values) = (vec![seed; knowns.len()], vec![0.0; unknowns.len()]);
                let (u, k) = (unknowns.as_ptr(), knowns.as_ptr());
                let (nu, nk) = (unknowns.len(), knowns.len());
                let (seed, found) = (seed.as_ptr(), values.as_mut_ptr());
                let status = unsafe { fmi2GetDirectionalDerivative(self.c, u, nu, k, nk, seed, found) };
                assert!(status != Status::Ok || values.iter().all(|value| value.is_finite()));
            }
            _ => unreachable!("{call:?} asks for no derivative"),
        }
    }

    fn pick(&self, number: u8) -> FmuState {
        self.states[usize::from(number) % self.states.len()]
    }

    fn keep(&mut self, call: &Call) {
        let c = self.c;
        unsafe {
            match *call {
                Call::Save => {
                    let mut state = ptr::null_mut();
                    assert_eq!(fmi2GetFMUstate(c, &mut state), Status::Ok);
                    self.states.push(state);
                }
                Call::SaveOver(number) => drop(fmi2GetFMUstate(c, &mut self.pick(number))),
                Call::Restore(number) => drop(fmi2SetFMUstate(c, self.pick(number))),
                Call::Free(number) => drop(fmi2FreeFMUstate(c, &mut self.pick(number))),
                _ => unreachable!("{call:?} keeps no state"),
            }
        }
    }

    fn serialize(&mut self, number: u8, offset: u16, flip: u8) {
        let (c, picked) = (self.c, self.pick(number));
        unsafe {
            let mut size = 0;
            if fmi2SerializedFMUstateSize(c, picked, &mut size) != Status::Ok {
                return;
            }
            let mut bytes = vec![0u8; size];
            assert_eq!(fmi2SerializeFMUstate(c, picked, bytes.as_mut_ptr().cast(), size), Status::Ok);
            bytes[usize::from(offset) % size] ^= flip;
            let mut state = ptr::null_mut();
            let status = fmi2DeSerializeFMUstate(c, bytes.as_ptr().cast(), size, &mut state);
            assert_eq!(status == Status::Ok, flip == 0);
            if status == Status::Ok {
                self.states.push(state);
            }
        }
    }

    fn ask(&mut self, which: u8, kind: i32) {
        let c = self.c;
        unsafe {
            match which % 5 {
                0 => drop(fmi2GetStatus(c, kind, &mut Status::Ok)),
                1 => drop(fmi2GetRealStatus(c, kind, &mut 0.0)),
                2 => drop(fmi2GetIntegerStatus(c, kind, &mut 0)),
                3 => drop(fmi2GetBooleanStatus(c, kind, &mut 0)),
                _ => drop(fmi2GetStringStatus(c, kind, &mut ptr::null())),
            }
        }
    }

    fn null(&mut self, which: u8) {
        let c = self.c;
        unsafe {
            match which % 6 {
                0 => drop(fmi2GetReal(c, ptr::null(), 3, ptr::null_mut())),
                1 => drop(fmi2SetReal(c, ptr::null(), 3, ptr::null())),
                2 => drop(fmi2GetFMUstate(c, ptr::null_mut())),
                3 => drop(fmi2DeSerializeFMUstate(c, ptr::null(), 9, ptr::null_mut())),
                4 => drop(fmi2SetDebugLogging(c, TRUE, 2, ptr::null())),
                _ => drop(fmi2GetStatus(c, DO_STEP_STATUS, ptr::null_mut())),
            }
        }
    }
}

fuzz_target!(|data: &[u8]| {
    let mut data = Unstructured::new(data);
    let Ok(scene) = data.int_in_range(0..=3usize) else { return };
    RESOURCES.with(|resources| {
        let resources = &resources.get_or_init(|| [0, 1, 2, 3].map(Resources::new))[scene];
        let all = resources.reals();
        let c = resources.instance();
        let mut run = Run { c, states: vec![ptr::null_mut()], all: &all };
        for _ in 0..100 {
            let Ok(call) = Call::arbitrary(&mut data) else { break };
            run.make(&call);
            if data.is_empty() {
                break;
            }
        }
        get(c, &all);
        unsafe {
            assert_eq!(fmi2Reset(c), Status::Ok);
            start(c);
            assert_eq!(fmi2DoStep(c, 0.0, 1e-6, TRUE), Status::Ok);
            fmi2FreeInstance(c);
        }
    });
});
