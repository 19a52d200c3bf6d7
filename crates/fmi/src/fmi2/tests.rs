//! The whole interface as a host in C uses it: raw pointers, memory that is not initialised, handles of any value,
//! several threads.
//!
//! These tests are small enough for Miri, which knows whether a pointer may be used as it is:
//! `MIRIFLAGS=-Zmiri-disable-isolation cargo +nightly miri test -p brinell-fmi --lib --target
//! riscv64gc-unknown-linux-gnu`, for it knows no inline assembly of x86.
//! Logging is off, for a logger takes variable arguments, which stable Rust cannot define.

use std::ffi::{CString, c_void};
use std::mem::MaybeUninit;
use std::path::PathBuf;
use std::{env, fs, ptr};

use super::*;
use crate::resources::SCENE;
use brinell::scene::model_file;
use brinell::simulation::interface::table::guid;

/// Unpacked resources, deleted when dropped.
struct Resources(PathBuf);

impl Resources {
    fn new(name: &str) -> Self {
        let directory = env::temp_dir().join(format!("brinell-fmi2-{name}-{}", std::process::id()));
        fs::create_dir_all(&directory).unwrap();
        fs::write(directory.join("scene.toml"), SCENE).unwrap();
        let model = model_file::encode(&brinell_scene_file::from_toml(SCENE).unwrap(), SCENE).unwrap();
        fs::write(directory.join("model.bin"), model).unwrap();
        Self(directory)
    }

    fn instance(&self, name: &str) -> Component {
        unsafe extern "C" fn never(_: *mut c_void, _: FmiString, _: Status, _: FmiString, _: FmiString) {
            unreachable!("logging is off");
        }
        type Fixed = unsafe extern "C" fn(*mut c_void, FmiString, Status, FmiString, FmiString);
        // SAFETY: it is not called.
        let logger = unsafe { std::mem::transmute::<Fixed, LoggerCallback>(never) };
        let callbacks = CallbackFunctions {
            logger: Some(logger),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: ptr::null_mut(),
        };
        let texts = [name.to_owned(), guid(SCENE, None), format!("file://{}", self.0.display())];
        let [name, guid, location] = texts.map(|text| CString::new(text).unwrap());
        let (name, guid, location) = (name.as_ptr(), guid.as_ptr(), location.as_ptr());
        // SAFETY: strings end in NUL; all live through the call.
        let c = unsafe { fmi2Instantiate(name, CO_SIMULATION, guid, location, &raw const callbacks, FALSE, FALSE) };
        assert!(!c.is_null());
        c
    }
}

impl Drop for Resources {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn start(c: Component) {
    // SAFETY: any handle may be passed.
    unsafe {
        assert_eq!(fmi2SetupExperiment(c, FALSE, 0.0, 0.0, FALSE, 0.0), Status::Ok);
        assert_eq!(fmi2EnterInitializationMode(c), Status::Ok);
        assert_eq!(fmi2ExitInitializationMode(c), Status::Ok);
    }
}

/// Inputs and outputs into memory that nobody has written.
fn read(c: Component) -> [f64; 8] {
    let references = [0u32, 1, 2, 3, 4, 5, 6, 7];
    let mut values = [MaybeUninit::<f64>::uninit(); 8];
    // SAFETY: the arrays are as long as said; under OK all values are written.
    unsafe {
        assert_eq!(fmi2GetReal(c, references.as_ptr(), 8, values.as_mut_ptr().cast()), Status::Ok);
        values.map(|value| value.assume_init())
    }
}

#[test]
fn an_instance_lives_through_raw_pointers_and_memory_that_is_not_initialised() {
    let resources = Resources::new("life");
    let c = resources.instance("life");
    start(c);
    let mut state = ptr::null_mut();
    // SAFETY: the arrays are as long as said, the pointers are to one value each.
    unsafe {
        assert_eq!(fmi2GetFMUstate(c, &raw mut state), Status::Ok);
        assert_eq!(fmi2DoStep(c, 0.0, 1e-6, TRUE), Status::Ok);
        let after = read(c);
        let mut size = MaybeUninit::<usize>::uninit();
        assert_eq!(fmi2SerializedFMUstateSize(c, state, size.as_mut_ptr()), Status::Ok);
        let size = size.assume_init();
        let mut bytes = Vec::<u8>::with_capacity(size);
        assert_eq!(fmi2SerializeFMUstate(c, state, bytes.as_mut_ptr().cast(), size), Status::Ok);
        bytes.set_len(size);
        assert_eq!(fmi2FreeFMUstate(c, &raw mut state), Status::Ok);
        assert_eq!(fmi2DeSerializeFMUstate(c, bytes.as_ptr().cast(), size, &raw mut state), Status::Ok);
        assert_eq!(fmi2SetFMUstate(c, state), Status::Ok);
        assert_eq!(fmi2DoStep(c, 0.0, 1e-6, TRUE), Status::Ok);
        assert_eq!(read(c), after);
        // The state itself instead of its address.
        assert_eq!(fmi2FreeFMUstate(c, state.cast()), Status::Ok);

        let mut status = MaybeUninit::<Status>::uninit();
        assert_eq!(fmi2GetStatus(c, DO_STEP_STATUS, status.as_mut_ptr()), Status::Ok);
        assert_eq!(status.assume_init(), Status::Ok);
        let mut text = MaybeUninit::<FmiString>::uninit();
        assert_eq!(fmi2GetStringStatus(c, PENDING_STATUS, text.as_mut_ptr()), Status::Ok);
        assert!(!text.assume_init().is_null());
        fmi2FreeInstance(c);
    }
}

#[test]
fn integers_strings_and_derivatives_go_into_memory_that_is_not_initialised() {
    let resources = Resources::new("kinds");
    let c = resources.instance("kinds");
    let table = brinell::simulation::interface::table::rows(&brinell_scene_file::from_toml(SCENE).unwrap(), &[]);
    let named = |name: &str| table.iter().find(|(row, _)| row.name == name).unwrap().0.reference;
    let (steps, folder) = (named("solver.steps"), named("recorder.folder"));
    let (output, input) = (named("shaft.force.y"), named("shaft.speed"));
    // SAFETY: the arrays are as long as said, strings end in NUL.
    unsafe {
        assert_eq!(fmi2SetString(c, &raw const folder, 1, &c"".as_ptr()), Status::Ok);
        start(c);
        let mut count = MaybeUninit::<Integer>::uninit();
        assert_eq!(fmi2GetInteger(c, &raw const steps, 1, count.as_mut_ptr()), Status::Ok);
        assert_eq!(count.assume_init(), 0);
        let mut text = MaybeUninit::<FmiString>::uninit();
        assert_eq!(fmi2GetString(c, &raw const folder, 1, text.as_mut_ptr()), Status::Ok);
        assert_eq!(*text.assume_init(), 0);
        let (mut value, order, seed) = (MaybeUninit::<Real>::uninit(), 1, 1.0);
        let by_time = fmi2GetRealOutputDerivatives(c, &raw const output, 1, &raw const order, value.as_mut_ptr());
        assert_eq!(by_time, Status::Ok);
        assert!(value.assume_init().is_finite());
        let mut value = MaybeUninit::<Real>::uninit();
        let (unknown, known) = (&raw const output, &raw const input);
        let status = fmi2GetDirectionalDerivative(c, unknown, 1, known, 1, &raw const seed, value.as_mut_ptr());
        assert_eq!(status, Status::Ok);
        assert!(value.assume_init().is_finite());
        fmi2FreeInstance(c);
    }
}

#[test]
fn handles_of_instances_that_come_and_go_in_threads_lead_to_their_own_or_nowhere() {
    let resources = Resources::new("threads");
    // Two threads are enough for Miri to see that they race, and a start takes it ten seconds.
    let (threads, rounds) = if cfg!(miri) { (2, 2) } else { (3, 200) };
    std::thread::scope(|scope| {
        for number in 0..threads {
            let resources = &resources;
            scope.spawn(move || {
                for round in 0..rounds {
                    let c = resources.instance("one of many");
                    let speed = f64::from(10 * number + round);
                    // SAFETY: one element each; any handle may be passed.
                    unsafe {
                        assert_eq!(fmi2SetReal(c, &0, 1, &raw const speed), Status::Ok);
                        start(c);
                        let mut read = 0.0;
                        assert_eq!(fmi2GetReal(c, &0, 1, &raw mut read), Status::Ok);
                        assert_eq!(read, speed);
                        fmi2FreeInstance(c);
                        assert_eq!(fmi2Reset(c), Status::Error);
                        fmi2FreeInstance(c);
                    }
                }
            });
        }
    });
}

#[test]
fn an_instance_wanders_from_thread_to_thread() {
    struct Handle(Component);
    // SAFETY: a handle is a number; the instance is used by one thread after another.
    unsafe impl Send for Handle {}
    let resources = Resources::new("wanderer");
    let mut handle = Handle(resources.instance("wanderer"));
    start(handle.0);
    for step in 0..3 {
        let thread = std::thread::spawn(move || {
            let handle = handle;
            // SAFETY: any handle may be passed.
            let status = unsafe { fmi2DoStep(handle.0, f64::from(step) * 1e-6, 1e-6, TRUE) };
            assert_eq!(status, Status::Ok);
            handle
        });
        handle = thread.join().unwrap();
    }
    // SAFETY: any handle may be passed.
    unsafe { fmi2FreeInstance(handle.0) };
}

#[test]
#[cfg(feature = "panic-on-demand")]
fn a_panic_unwinds_to_the_boundary_and_no_further() {
    let resources = Resources::new("panic");
    let c = resources.instance("panic on demand");
    start(c);
    // SAFETY: any handle may be passed.
    unsafe {
        assert_eq!(fmi2DoStep(c, 0.0, 1e-6, TRUE), Status::Error);
        assert_eq!(fmi2Reset(c), Status::Ok);
        start(c);
        fmi2FreeInstance(c);
    }
}
