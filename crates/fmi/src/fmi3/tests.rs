//! The whole interface as a host in C uses it: raw pointers, memory that is not initialised, a callback that calls
//! back.
//!
//! These tests are small enough for Miri, as those of FMI 2.0 are.

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
        let directory = env::temp_dir().join(format!("brinell-fmi3-{name}-{}", std::process::id()));
        fs::create_dir_all(&directory).unwrap();
        fs::write(directory.join("scene.toml"), SCENE).unwrap();
        let model = model_file::encode(&brinell_scene_file::from_toml(SCENE).unwrap(), SCENE).unwrap();
        fs::write(directory.join("model.bin"), model).unwrap();
        Self(directory)
    }

    /// An instance at its first communication point, with updates that `callback` gets.
    fn started(&self, required: &[u32], callback: Option<(IntermediateUpdateCallback, *mut c_void)>) -> Instance {
        let texts = ["small".to_owned(), guid(SCENE, None), self.0.display().to_string()];
        let [name, token, path] = texts.map(|text| CString::new(text).unwrap());
        let (name, token, path) = (name.as_ptr(), token.as_ptr(), path.as_ptr());
        let (update, environment) = callback.map_or((None, ptr::null_mut()), |(update, to)| (Some(update), to));
        let (list, count) = (required.as_ptr(), required.len());
        // SAFETY: strings end in NUL, the list is as long as said; the environment is the caller's.
        unsafe {
            let c = fmi3InstantiateCoSimulation(
                name,
                token,
                path,
                FALSE,
                FALSE,
                FALSE,
                TRUE,
                list,
                count,
                environment,
                None,
                update,
            );
            assert!(!c.is_null());
            assert_eq!(fmi3EnterInitializationMode(c, FALSE, 0.0, 0.0, FALSE, 0.0), Status::Ok);
            assert_eq!(fmi3ExitInitializationMode(c), Status::Ok);
            c
        }
    }
}

impl Drop for Resources {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Reference of the array whose first element has this name.
fn reference(name: &str) -> u32 {
    let table = brinell::simulation::interface::table::rows(&brinell_scene_file::from_toml(SCENE).unwrap(), &[]);
    table.iter().find(|(row, _)| row.name == name).unwrap().0.reference
}

/// A step into memory that nobody has written; whether it returned early, and when.
fn step(c: Instance, point: f64, size: f64) -> (bool, f64) {
    let mut flags = [MaybeUninit::<Bool>::uninit(); 3];
    let mut time = MaybeUninit::<f64>::uninit();
    let [event, end, early] = flags.each_mut().map(MaybeUninit::as_mut_ptr);
    // SAFETY: memory for one value each, written under OK.
    unsafe {
        assert_eq!(fmi3DoStep(c, point, size, TRUE, event, end, early, time.as_mut_ptr()), Status::Ok);
        (flags[2].assume_init() != FALSE, time.assume_init())
    }
}

#[test]
fn arrays_states_and_derivatives_go_into_memory_that_is_not_initialised() {
    let resources = Resources::new("memory");
    let c = resources.started(&[], None);
    let path = reference("element[1].path");
    assert_eq!(step(c, 0.0, 1e-6), (false, 1e-6));
    // SAFETY: the arrays are as long as said; under OK all values are written.
    unsafe {
        let mut values = [MaybeUninit::<f64>::uninit(); 3];
        assert_eq!(fmi3GetFloat64(c, &raw const path, 1, values.as_mut_ptr().cast(), 3), Status::Ok);
        assert!(values.iter().all(|value| value.assume_init().is_finite()));
        let (force, speed, seed) = (reference("element[1].force.inner"), 0, 1.0);
        let mut changes = [MaybeUninit::<f64>::uninit(); 3];
        let values = changes.as_mut_ptr().cast();
        let status =
            fmi3GetDirectionalDerivative(c, &raw const force, 1, &raw const speed, 1, &raw const seed, 1, values, 3);
        assert_eq!(status, Status::Ok);
        assert!(changes.iter().all(|change| change.assume_init().is_finite()));
        let mut state = ptr::null_mut();
        assert_eq!(fmi3GetFMUState(c, &raw mut state), Status::Ok);
        let mut size = MaybeUninit::<usize>::uninit();
        assert_eq!(fmi3SerializedFMUStateSize(c, state, size.as_mut_ptr()), Status::Ok);
        let size = size.assume_init();
        let mut bytes = Vec::<u8>::with_capacity(size);
        assert_eq!(fmi3SerializeFMUState(c, state, bytes.as_mut_ptr(), size), Status::Ok);
        bytes.set_len(size);
        assert_eq!(fmi3FreeFMUState(c, &raw mut state), Status::Ok);
        assert_eq!(fmi3DeserializeFMUState(c, bytes.as_ptr(), size, &raw mut state), Status::Ok);
        assert_eq!(fmi3SetFMUState(c, state), Status::Ok);
        let mut count = MaybeUninit::<usize>::uninit();
        assert_eq!(fmi3GetNumberOfVariableDependencies(c, force, count.as_mut_ptr()), Status::Ok);
        assert!(count.assume_init() > 0);
        fmi3FreeInstance(c);
    }
}

#[test]
fn a_host_calls_back_into_its_instance_while_a_step_is_under_way() {
    /// What the callback is given of its instance, and counts.
    struct Host {
        c: Instance,
        path: u32,
        calls: u32,
    }
    unsafe extern "C-unwind" fn update(
        environment: InstanceEnvironment,
        time: f64,
        _: Bool,
        _: Bool,
        _: Bool,
        can_return: Bool,
        wanted: *mut Bool,
        at: *mut f64,
    ) {
        // SAFETY: the environment is the host below, which is not used while a step is under way; the pointers are
        // the FMU's.
        unsafe {
            let host = &mut *environment.cast::<Host>();
            let mut values = [0.0; 3];
            let status = fmi3GetFloat64(host.c, &raw const host.path, 1, values.as_mut_ptr(), 3);
            assert_eq!(status, Status::Ok);
            // Not here, and not from the other version either.
            fmi3FreeInstance(host.c);
            crate::fmi2::fmi2FreeInstance(host.c);
            host.calls += 1;
            if can_return != FALSE && host.calls == 2 {
                (*wanted, *at) = (TRUE, time);
            }
        }
    }
    let resources = Resources::new("update");
    let path = reference("element[1].path");
    let mut host = Host { c: ptr::null_mut(), path, calls: 0 };
    let to = &raw mut host;
    let c = resources.started(&[path], Some((update, to.cast())));
    // SAFETY: no step is under way.
    unsafe { (*to).c = c };
    let (early, time) = step(c, 0.0, 1e-4);
    assert!(early && time > 0.0 && time < 1e-4);
    // SAFETY: no step is under way; the last use of the instance.
    unsafe {
        assert_eq!((*to).calls, 2);
        fmi3FreeInstance(c);
    }
}
