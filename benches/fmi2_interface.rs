//! What the FMI interface costs: nanoseconds per call, through the compiled library as a host loads it.
//!
//! `cargo bench --bench fmi2_interface`. Each figure is the fastest of many batches: what disturbs a measurement only
//! adds. The overhead of `fmi2DoStep` is what a refused step costs (null handle), and the difference between a step
//! through the interface and the same step of `Simulation`.
#![allow(unsafe_code)]
// A benchmark stops at the first surprise.
#![allow(clippy::unwrap_used, missing_docs)]

use brinell::scene::Scene;
use brinell::simulation::Simulation;
use brinell::simulation::guid::guid;
use brinell::simulation::variables::{Causality, Kind};
use brinell_fmi::fmi2::*;
use libloading::{Library, Symbol};
use std::ffi::CString;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;
use std::{env, fs, ptr};

/// Nanoseconds per call: the fastest of `batches` batches of `count` calls.
fn time(batches: u32, count: u32, mut call: impl FnMut()) -> f64 {
    let batch = |_| {
        let start = Instant::now();
        for _ in 0..count {
            call();
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(count)
    };
    (0..batches).map(batch).fold(f64::INFINITY, f64::min)
}

type Logger = unsafe extern "C" fn(ComponentEnvironment, FmiString, Status, FmiString, FmiString);
type Instantiate = unsafe extern "C" fn(
    FmiString,
    FmuType,
    FmiString,
    FmiString,
    *const CallbackFunctions,
    Boolean,
    Boolean,
) -> Component;
type Setup = unsafe extern "C" fn(Component, Boolean, f64, f64, Boolean, f64) -> Status;
type Plain = unsafe extern "C" fn(Component) -> Status;
type Get = unsafe extern "C" fn(Component, *const u32, usize, *mut f64) -> Status;
type Set = unsafe extern "C" fn(Component, *const u32, usize, *const f64) -> Status;
type Step = unsafe extern "C" fn(Component, f64, f64, Boolean) -> Status;
type Save = unsafe extern "C" fn(Component, *mut FmuState) -> Status;
type Restore = unsafe extern "C" fn(Component, FmuState) -> Status;

unsafe extern "C" fn ignore(_: ComponentEnvironment, _: FmiString, _: Status, _: FmiString, _: FmiString) {}

fn main() {
    let text = include_str!("../scenes/6205-healthy.toml");
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("interface");
    fs::create_dir_all(&directory).unwrap();
    fs::write(directory.join("scene.toml"), text).unwrap();
    let location = CString::new(format!("file://{}", directory.to_str().unwrap())).unwrap();
    let identity = CString::new(guid(text, None)).unwrap();

    let library = format!("{}brinell{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    let path = env::args()
        .skip(1)
        .find(|argument| !argument.starts_with("--"))
        .map_or_else(|| env::current_exe().unwrap().with_file_name(&library), |given| Path::new(&given).to_path_buf());
    println!("{}", path.display());
    // SAFETY: the signatures are those of the standard, the calls are in order and their pointers good. The logger
    // ignores what it gets; leaving arguments out of a C function does no harm on the platforms measured.
    unsafe {
        let library = Library::new(&path).unwrap();
        let instantiate: Symbol<'_, Instantiate> = library.get("fmi2Instantiate").unwrap();
        let setup: Symbol<'_, Setup> = library.get("fmi2SetupExperiment").unwrap();
        let enter: Symbol<'_, Plain> = library.get("fmi2EnterInitializationMode").unwrap();
        let exit: Symbol<'_, Plain> = library.get("fmi2ExitInitializationMode").unwrap();
        let get: Symbol<'_, Get> = library.get("fmi2GetReal").unwrap();
        let set: Symbol<'_, Set> = library.get("fmi2SetReal").unwrap();
        let step: Symbol<'_, Step> = library.get("fmi2DoStep").unwrap();
        let save: Symbol<'_, Save> = library.get("fmi2GetFMUstate").unwrap();
        let restore: Symbol<'_, Restore> = library.get("fmi2SetFMUstate").unwrap();
        let free: Symbol<'_, unsafe extern "C" fn(Component)> = library.get("fmi2FreeInstance").unwrap();

        let callbacks = CallbackFunctions {
            logger: Some(std::mem::transmute::<Logger, LoggerCallback>(ignore)),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: ptr::null_mut(),
        };
        let make = || {
            let (identity, location) = (identity.as_ptr(), location.as_ptr());
            instantiate(c"bench".as_ptr(), CO_SIMULATION, identity, location, &raw const callbacks, FALSE, FALSE)
        };
        let start = |c| {
            assert_eq!(setup(c, FALSE, 0.0, 0.0, FALSE, 0.0), Status::Ok);
            assert_eq!(enter(c), Status::Ok);
            assert_eq!(exit(c), Status::Ok);
        };
        let c = make();
        start(c);

        let mut simulation = Simulation::new(Scene::from_toml(text).unwrap(), None).unwrap();
        simulation.initialize(0.0).unwrap();
        let table = simulation.table().to_vec();
        let outputs: Vec<u32> = table
            .iter()
            .filter(|v| v.causality == Causality::Output && matches!(v.kind, Kind::Real { .. }))
            .filter(|v| !v.name.contains("stiffness"))
            .map(|v| v.reference)
            .take(20)
            .collect();
        let inputs: Vec<u32> =
            table.iter().filter(|v| v.causality == Causality::Input).map(|v| v.reference).cycle().take(20).collect();
        let mut values = [0.0; 20];

        get(c, outputs.as_ptr(), 20, values.as_mut_ptr());
        let none = time(200, 20_000, || _ = black_box(get(c, ptr::null(), 0, ptr::null_mut())));
        let one = time(200, 20_000, || _ = black_box(get(c, outputs.as_ptr(), 1, values.as_mut_ptr())));
        let twenty = time(200, 20_000, || _ = black_box(get(c, outputs.as_ptr(), 20, values.as_mut_ptr())));
        println!("get ×0, ×1, ×20             {none:8.1} {one:8.1} {twenty:8.1} ns");
        let mut given = [0.0; 20];
        assert_eq!(get(c, inputs.as_ptr(), 20, given.as_mut_ptr()), Status::Ok);
        let one = time(200, 20_000, || _ = black_box(set(c, inputs.as_ptr(), 1, given.as_ptr())));
        let twenty = time(200, 20_000, || _ = black_box(set(c, inputs.as_ptr(), 20, given.as_ptr())));
        println!("set ×1, ×20                 {one:8.1} {twenty:8.1} ns");

        let refused = time(200, 20_000, || _ = black_box(step(ptr::null_mut(), 0.0, 1e-9, TRUE)));
        println!("doStep on a null handle     {refused:8.1} ns");
        let h = 1e-12;
        let (mut through, mut direct) = (f64::INFINITY, f64::INFINITY);
        let mut point = 0.0;
        // Interleaved, so that both meet the same machine.
        for _ in 0..200 {
            through = through.min(time(1, 500, || {
                assert_eq!(step(c, point, h, TRUE), Status::Ok);
                point += h;
            }));
            direct = direct.min(time(1, 500, || simulation.step(black_box(h)).unwrap()));
        }
        println!("doStep, Simulation::step    {through:8.1} {direct:8.1} ns, overhead {:.1} ns", through - direct);

        let mut state = ptr::null_mut();
        assert_eq!(save(c, &raw mut state), Status::Ok);
        let saving = time(200, 20_000, || _ = black_box(save(c, &raw mut state)));
        let restoring = time(200, 20_000, || _ = black_box(restore(c, state)));
        println!("GetFMUstate, SetFMUstate    {saving:8.1} {restoring:8.1} ns");

        let created = time(50, 20, || free(black_box(make())));
        let started = time(50, 20, || {
            let c = make();
            start(c);
            free(c);
        });
        println!("create–free, create–init–free {:8.1} {:8.1} µs", created / 1e3, started / 1e3);
        free(c);
    }
    fs::remove_dir_all(directory).unwrap();
}
