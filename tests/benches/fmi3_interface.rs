//! What FMI 3.0 costs beside FMI 2.0: nanoseconds per call, through the compiled library as a host loads it, on two
//! instances of one scene in turn, so that both meet the same machine.
//!
//! `cargo bench --bench fmi3_interface`. Each figure is the fastest of many batches: what disturbs a measurement only
//! adds.
#![allow(unsafe_code)]
// A benchmark stops at the first surprise.
#![allow(clippy::unwrap_used, missing_docs)]

use brinell::scene::model_file;
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Causality, Kind, guid};
use brinell_fmi::fmi2::{self, CO_SIMULATION, CallbackFunctions, FmiString, LoggerCallback, Status};
use brinell_fmi::fmi3::{self, FALSE, Instance, IntermediateUpdateCallback, LogMessageCallback, TRUE};
use libloading::{Library, Symbol};
use std::ffi::{CString, c_int, c_void};
use std::path::{Path, PathBuf};
use std::time::Instant;
use std::{env, fs, ptr};

/// Nanoseconds per call: the fastest of 200 batches, the two calls in turn.
fn beside(count: u32, mut two: impl FnMut(), mut three: impl FnMut()) -> [f64; 2] {
    let mut fastest = [f64::INFINITY; 2];
    for _ in 0..200 {
        for (best, call) in fastest.iter_mut().zip([&mut two as &mut dyn FnMut(), &mut three]) {
            let start = Instant::now();
            (0..count).for_each(|_| call());
            *best = best.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(count));
        }
    }
    fastest
}

fn show(what: &str, [two, three]: [f64; 2]) {
    println!("{what:44} {two:10.1} {three:10.1} ns   ratio {:.3}", three / two);
}

type Step2 = unsafe extern "C" fn(*mut c_void, f64, f64, c_int) -> Status;
type Step3 = unsafe extern "C" fn(Instance, f64, f64, u8, *mut u8, *mut u8, *mut u8, *mut f64) -> Status;
type Get2 = unsafe extern "C" fn(*mut c_void, *const u32, usize, *mut f64) -> Status;
type Get3 = unsafe extern "C" fn(Instance, *const u32, usize, *mut f64, usize) -> Status;
type Set2 = unsafe extern "C" fn(*mut c_void, *const u32, usize, *const f64) -> Status;
type Set3 = unsafe extern "C" fn(Instance, *const u32, usize, *const f64, usize) -> Status;
type Instantiate2 =
    unsafe extern "C" fn(FmiString, c_int, FmiString, FmiString, *const CallbackFunctions, c_int, c_int) -> *mut c_void;
type Instantiate3 = unsafe extern "C" fn(
    FmiString,
    FmiString,
    FmiString,
    u8,
    u8,
    u8,
    u8,
    *const u32,
    usize,
    *mut c_void,
    Option<LogMessageCallback>,
    Option<IntermediateUpdateCallback>,
) -> Instance;

unsafe extern "C" fn ignore(_: *mut c_void, _: FmiString, _: Status, _: FmiString, _: FmiString) {}
type Logger = unsafe extern "C" fn(*mut c_void, FmiString, Status, FmiString, FmiString);

unsafe extern "C-unwind" fn watch(_: *mut c_void, _: f64, _: u8, _: u8, _: u8, _: u8, _: *mut u8, _: *mut f64) {}

/// Scene, its unpacked folder, and what both versions call it.
struct Unpacked {
    folder: PathBuf,
    identity: CString,
    uri: CString,
    path: CString,
}

impl Unpacked {
    fn new(text: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("interface3");
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("scene.toml"), text).unwrap();
        let model = model_file::encode(&brinell_scene_file::from_toml(text).unwrap(), text).unwrap();
        fs::write(folder.join("model.bin"), model).unwrap();
        let path = folder.to_str().unwrap();
        let [identity, uri, path] =
            [guid(text, None), format!("file://{path}"), format!("{path}/")].map(|text| CString::new(text).unwrap());
        Self { folder, identity, uri, path }
    }

    /// An instance of FMI 2.0 at its first communication point.
    fn two(&self, library: &Library) -> *mut c_void {
        // SAFETY: the standard's signatures and order; strings live through the call, the logger ignores all.
        unsafe {
            let callbacks = CallbackFunctions {
                logger: Some(std::mem::transmute::<Logger, LoggerCallback>(ignore)),
                allocate_memory: None,
                free_memory: None,
                step_finished: None,
                component_environment: ptr::null_mut(),
            };
            let instantiate: Symbol<'_, Instantiate2> = library.get("fmi2Instantiate").unwrap();
            let (identity, uri) = (self.identity.as_ptr(), self.uri.as_ptr());
            let c = instantiate(c"bench".as_ptr(), CO_SIMULATION, identity, uri, &raw const callbacks, 0, 0);
            type Setup = unsafe extern "C" fn(*mut c_void, c_int, f64, f64, c_int, f64) -> Status;
            assert_eq!(library.get::<Setup>("fmi2SetupExperiment").unwrap()(c, 0, 0.0, 0.0, 0, 0.0), Status::Ok);
            for name in ["fmi2EnterInitializationMode", "fmi2ExitInitializationMode"] {
                assert_eq!(library.get::<unsafe extern "C" fn(*mut c_void) -> Status>(name).unwrap()(c), Status::Ok);
            }
            c
        }
    }

    /// An instance of FMI 3.0 at its first communication point.
    fn three(&self, library: &Library, update: Option<IntermediateUpdateCallback>) -> Instance {
        // SAFETY: as above.
        unsafe {
            let instantiate: Symbol<'_, Instantiate3> = library.get("fmi3InstantiateCoSimulation").unwrap();
            let (identity, path, nothing) = (self.identity.as_ptr(), self.path.as_ptr(), ptr::null_mut());
            let name = c"bench".as_ptr();
            let c =
                instantiate(name, identity, path, FALSE, FALSE, FALSE, TRUE, nothing, 0, nothing.cast(), None, update);
            type Enter = unsafe extern "C" fn(Instance, u8, f64, f64, u8, f64) -> Status;
            let enter = library.get::<Enter>("fmi3EnterInitializationMode").unwrap();
            assert_eq!(enter(c, FALSE, 0.0, 0.0, FALSE, 0.0), Status::Ok);
            let exit = library.get::<unsafe extern "C" fn(Instance) -> Status>("fmi3ExitInitializationMode").unwrap();
            assert_eq!(exit(c), Status::Ok);
            c
        }
    }
}

/// One scene, both versions.
fn compare(library: &Library, name: &str, text: &str) {
    println!("{name}");
    let unpacked = Unpacked::new(text);
    let (two, three) = (unpacked.two(library), unpacked.three(library, None));
    let simulation = Simulation::new(brinell_scene_file::from_toml(text).unwrap(), None).unwrap();
    // SAFETY: the standard's signatures.
    let (get2, get3, set2, set3): (Symbol<'_, Get2>, Symbol<'_, Get3>, Symbol<'_, Set2>, Symbol<'_, Set3>) = unsafe {
        (
            library.get("fmi2GetReal").unwrap(),
            library.get("fmi3GetFloat64").unwrap(),
            library.get("fmi2SetReal").unwrap(),
            library.get("fmi3SetFloat64").unwrap(),
        )
    };
    let table = simulation.table();
    let is_output = |kind: &Kind, of: Causality| matches!(kind, Kind::Real { .. }) && of == Causality::Output;
    let arrays = simulation.arrays();
    let scalars: Vec<u32> = table
        .iter()
        .filter(|row| is_output(&row.kind, row.causality) && !row.name.contains("stiffness"))
        .filter(|row| arrays.iter().all(|array| !array.rows.contains(&row.reference)))
        .map(|row| row.reference)
        .cycle()
        .take(20)
        .collect();
    let rows: Vec<u32> = arrays.iter().flat_map(|array| array.rows.clone()).collect();
    let firsts: Vec<u32> = arrays.iter().map(|array| array.rows[0]).collect();
    let mut values = vec![0.0; rows.len().max(20)];
    let array = values.as_mut_ptr();
    // SAFETY of all the calls: living instances, arrays as long as said.
    show("get, 20 scalars", {
        let of = scalars.as_ptr();
        beside(20_000, || _ = unsafe { get2(two, of, 20, array) }, || _ = unsafe { get3(three, of, 20, array, 20) })
    });
    let what = format!("get, {} values of elements", rows.len());
    show(&what, {
        let (by_row, by_array, count) = (rows.as_ptr(), firsts.as_ptr(), rows.len());
        let arrays = firsts.len();
        beside(
            20_000,
            || _ = unsafe { get2(two, by_row, count, array) },
            || _ = unsafe { get3(three, by_array, arrays, array, count) },
        )
    });
    let inputs: Vec<u32> = table
        .iter()
        .filter(|row| row.causality == Causality::Input)
        .map(|row| row.reference)
        .cycle()
        .take(20)
        .collect();
    let of = inputs.as_ptr();
    unsafe { assert_eq!(get2(two, of, 20, array), Status::Ok) };
    show("set, 20 inputs", {
        beside(20_000, || _ = unsafe { set2(two, of, 20, array) }, || _ = unsafe { set3(three, of, 20, array, 20) })
    });
    for step in [1e-12, 1e-5, 1e-3] {
        steps(library, two, three, step, "doStep of");
    }
    let watched = unpacked.three(library, Some(watch));
    let other = unpacked.two(library);
    steps(library, other, watched, 1e-3, "doStep with updates, of");
    fs::remove_dir_all(&unpacked.folder).unwrap();
}

fn steps(library: &Library, two: *mut c_void, three: Instance, step: f64, what: &str) {
    // SAFETY: the standard's signatures.
    let (step2, step3): (Symbol<'_, Step2>, Symbol<'_, Step3>) =
        unsafe { (library.get("fmi2DoStep").unwrap(), library.get("fmi3DoStep").unwrap()) };
    // SAFETY: the functions are those of the standard.
    let state = |c, name: &str| unsafe {
        let mut state = ptr::null_mut();
        type Save = unsafe extern "C" fn(*mut c_void, *mut *mut c_void) -> Status;
        assert_eq!(library.get::<Save>(name).unwrap()(c, &raw mut state), Status::Ok);
        state
    };
    let (saved2, saved3) = (state(two, "fmi2GetFMUstate"), state(three, "fmi3GetFMUState"));
    type Restore = unsafe extern "C" fn(*mut c_void, *mut c_void) -> Status;
    // SAFETY: as above.
    let (back2, back3): (Symbol<'_, Restore>, Symbol<'_, Restore>) =
        unsafe { (library.get("fmi2SetFMUstate").unwrap(), library.get("fmi3SetFMUState").unwrap()) };
    // SAFETY: as above.
    let mut at = unsafe {
        type Real = unsafe extern "C" fn(*mut c_void, c_int, *mut f64) -> Status;
        let mut time = 0.0;
        assert_eq!(
            library.get::<Real>("fmi2GetRealStatus").unwrap()(two, fmi2::LAST_SUCCESSFUL_TIME, &mut time),
            Status::Ok
        );
        time
    };
    let start = at;
    let count = if step < 1e-6 { 500 } else { 20 };
    let (mut taken, mut flags, mut time) = (0, [0u8; 3], 0.0);
    let mut own = at;
    let [event, end, early] = std::array::from_fn(|i| &raw mut flags[i]);
    let reached = &raw mut time;
    // Every batch takes the same steps, from a state put back.
    let found = beside(
        count,
        || unsafe {
            if taken % count == 0 {
                assert_eq!(back2(two, saved2), Status::Ok);
                at = start;
            }
            taken += 1;
            assert_eq!(step2(two, at, step, 1), Status::Ok);
            at += step;
        },
        {
            let mut taken = 0;
            move || unsafe {
                if taken % count == 0 {
                    assert_eq!(back3(three, saved3), Status::Ok);
                    own = start;
                }
                taken += 1;
                assert_eq!(step3(three, own, step, TRUE, event, end, early, reached), Status::Ok);
                own += step;
            }
        },
    );
    show(&format!("{what} {step:e} s"), found);
}

fn main() {
    let name = format!("{}brinell_fmi{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    let given = env::args().skip(1).find(|argument| !argument.starts_with("--"));
    let path = given
        .map_or_else(|| env::current_exe().unwrap().with_file_name(name), |given| brinell_tests::root().join(given));
    println!(
        "{}, FMI {}",
        path.display(),
        unsafe { std::ffi::CStr::from_ptr(fmi3::fmi3GetVersion()) }.to_string_lossy()
    );
    println!("{:44} {:>10} {:>10}", "", "FMI 2.0", "FMI 3.0");
    // SAFETY: loading our own library runs no code.
    let library = unsafe { Library::new(&path).unwrap() };
    compare(&library, "6205-healthy", include_str!("../../scenes/6205-healthy.toml"));
    let spalled = include_str!("../../scenes/er16k-tb1.toml").replace("law = \"map\"", "law = \"hertz\"");
    compare(&library, "er16k-tb1, law hertz", &spalled);
}
