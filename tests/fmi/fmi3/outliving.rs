//! A call within an intermediate update that does not end with it: against the standard, and no reason to wait for
//! ever.

use crate::three::Resources;
use brinell_fmi::fmi3::*;
use std::ffi::{CStr, CString};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock, mpsc};
use std::thread::{self, JoinHandle};
use std::time::Duration;
use std::{iter, ptr};

const STEP: f64 = 1e-3;

/// An instance in another thread.
#[derive(Clone, Copy)]
struct Handle(Instance);

// SAFETY: a handle may wander between threads.
unsafe impl Send for Handle {}
// SAFETY: as above; it is only copied.
unsafe impl Sync for Handle {}

impl Handle {
    /// Reads a variable that does not exist.
    fn read_nothing(self) -> Status {
        let mut value = f64::NAN;
        // SAFETY: one reference, one value.
        unsafe { fmi3GetFloat64(self.0, [u32::MAX].as_ptr(), 1, &raw mut value, 1) }
    }

    fn step(self, point: f64) -> Status {
        let (mut flags, mut time) = ([9; 3], 0.0);
        let [event, end, early] = std::array::from_fn(|i| &raw mut flags[i]);
        // SAFETY: a living handle, and pointers to one value each.
        unsafe { fmi3DoStep(self.0, point, STEP, TRUE, event, end, early, &raw mut time) }
    }

    fn start(self) {
        // SAFETY: a living handle.
        unsafe {
            assert_eq!(fmi3EnterInitializationMode(self.0, FALSE, 0.0, 0.0, FALSE, 0.0), Status::Ok);
            assert_eq!(fmi3ExitInitializationMode(self.0), Status::Ok);
        }
    }
}

/// A host whose logger waits for the end of the step when a second thread logs.
#[derive(Default)]
struct Waiting {
    handle: OnceLock<Handle>,
    second: Mutex<Option<JoinHandle<Status>>>,
    is_logging: AtomicBool,
    is_stepped: AtomicBool,
    lines: Mutex<Vec<String>>,
}

fn wait_for(flag: &AtomicBool) {
    iter::repeat_with(|| flag.load(Ordering::Acquire))
        .take_while(|is_set| !is_set)
        .for_each(|_| thread::sleep(Duration::from_millis(1)));
}

unsafe extern "C-unwind" fn log(host: InstanceEnvironment, _: Status, _: FmiString, message: FmiString) {
    // SAFETY: the environment is a host that outlives its instance, the message a string that ends in NUL.
    let (host, message) = unsafe { (&*host.cast::<Waiting>(), CStr::from_ptr(message)) };
    host.lines.lock().unwrap().push(message.to_str().unwrap().to_owned());
    if host.second.lock().unwrap().is_some() {
        host.is_logging.store(true, Ordering::Release);
        wait_for(&host.is_stepped);
    }
}

unsafe extern "C-unwind" fn update(
    host: InstanceEnvironment,
    _time: f64,
    _set_requested: Bool,
    _get_allowed: Bool,
    _finished: Bool,
    _can_return: Bool,
    _early_return_requested: *mut Bool,
    _early_return_time: *mut f64,
) {
    // SAFETY: as above.
    let host = unsafe { &*host.cast::<Waiting>() };
    if host.is_stepped.load(Ordering::Acquire) {
        return;
    }
    let handle = *host.handle.get().unwrap();
    // The lock is held until the thread is noted, so that its line finds it.
    let mut second = host.second.lock().unwrap();
    *second = Some(thread::spawn(move || handle.read_nothing()));
    drop(second);
    wait_for(&host.is_logging);
}

#[test]
fn a_step_whose_update_leaves_a_call_behind_fails_and_waits_for_nobody() {
    let (host, resources) = (Arc::new(Waiting::default()), Resources::of("6205-healthy"));
    let path = format!("{}/", resources.directory.to_str().unwrap());
    let [name, token, path] = ["instance 1", &resources.guid, &path].map(|text| CString::new(text).unwrap());
    // SAFETY: strings end in NUL, no variables are listed; the host lives until the end of this test.
    let instance = unsafe {
        fmi3InstantiateCoSimulation(
            name.as_ptr(),
            token.as_ptr(),
            path.as_ptr(),
            FALSE,
            TRUE,
            FALSE,
            TRUE,
            ptr::null(),
            0,
            Arc::as_ptr(&host).cast_mut().cast(),
            Some(log),
            Some(update),
        )
    };
    let handle = *host.handle.get_or_init(|| Handle(instance));
    handle.start();
    host.lines.lock().unwrap().clear();

    let (stepped, status) = mpsc::channel();
    thread::spawn(move || {
        let handle = handle;
        stepped.send(handle.step(0.0))
    });
    // A step takes a millisecond.
    let status = status.recv_timeout(Duration::from_secs(60));
    host.is_stepped.store(true, Ordering::Release);
    assert_eq!(status, Ok(Status::Error), "the step is still waiting for a call that waits for it");
    let second = host.second.lock().unwrap().take().unwrap();
    assert_eq!(second.join().unwrap(), Status::Error);
    let lines = host.lines.lock().unwrap().join("\n");
    assert!(lines.contains("fmi3GetFloat64: intermediateUpdate returned before this call within it did"), "{lines}");

    // The instance is in error as after any other, and can be reset.
    assert_eq!(handle.step(0.0), Status::Error);
    // SAFETY: a living handle.
    assert_eq!(unsafe { fmi3Reset(instance) }, Status::Ok);
    handle.start();
    assert_eq!([0.0, STEP].map(|point| handle.step(point)), [Status::Ok; 2]);
    // SAFETY: as above.
    unsafe { fmi3FreeInstance(instance) };
}
