//! What the FMI interface costs: nanoseconds per call, through the compiled library as a host loads it.
//!
//! `cargo bench --bench fmi2_interface`. Each figure is the fastest of many batches: what disturbs a measurement only
//! adds. The overhead of `fmi2DoStep` is what a refused step costs (null handle), and the difference between a step
//! through the interface and the same step of `Simulation`.
#![allow(unsafe_code)]
// A benchmark stops at the first surprise.
#![allow(clippy::unwrap_used, missing_docs)]

use brinell::scene::model_file;
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{Causality, Kind, Variable, guid};
use brinell_fmi::fmi2::*;
use libloading::{Library, Symbol};
use std::ffi::CString;
use std::hint::black_box;
use std::path::{Path, PathBuf};
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

/// The functions of a compiled library.
struct Api<'l> {
    instantiate: Symbol<'l, Instantiate>,
    setup: Symbol<'l, Setup>,
    enter: Symbol<'l, Plain>,
    exit: Symbol<'l, Plain>,
    get: Symbol<'l, Get>,
    set: Symbol<'l, Set>,
    step: Symbol<'l, Step>,
    save: Symbol<'l, Save>,
    restore: Symbol<'l, Restore>,
    free: Symbol<'l, unsafe extern "C" fn(Component)>,
}

impl<'l> Api<'l> {
    fn of(library: &'l Library) -> Self {
        // SAFETY: the signatures are those of the standard.
        unsafe {
            Self {
                instantiate: library.get("fmi2Instantiate").unwrap(),
                setup: library.get("fmi2SetupExperiment").unwrap(),
                enter: library.get("fmi2EnterInitializationMode").unwrap(),
                exit: library.get("fmi2ExitInitializationMode").unwrap(),
                get: library.get("fmi2GetReal").unwrap(),
                set: library.get("fmi2SetReal").unwrap(),
                step: library.get("fmi2DoStep").unwrap(),
                save: library.get("fmi2GetFMUstate").unwrap(),
                restore: library.get("fmi2SetFMUstate").unwrap(),
                free: library.get("fmi2FreeInstance").unwrap(),
            }
        }
    }

    fn start(&self, c: Component) {
        // SAFETY: a living instance, in the standard's order.
        unsafe {
            assert_eq!((self.setup)(c, FALSE, 0.0, 0.0, FALSE, 0.0), Status::Ok);
            assert_eq!((self.enter)(c), Status::Ok);
            assert_eq!((self.exit)(c), Status::Ok);
        }
    }

    fn get(&self, c: Component, references: &[u32], values: &mut [f64]) -> Status {
        // SAFETY: as many values as references.
        unsafe { (self.get)(c, references.as_ptr(), references.len(), values.as_mut_ptr()) }
    }

    fn set(&self, c: Component, references: &[u32], values: &[f64]) -> Status {
        // SAFETY: as many values as references.
        unsafe { (self.set)(c, references.as_ptr(), references.len(), values.as_ptr()) }
    }
}

/// What instances are made from.
struct Resources {
    text: &'static str,
    folder: PathBuf,
    location: CString,
    identity: CString,
    callbacks: CallbackFunctions,
}

impl Resources {
    fn new() -> Self {
        let text = include_str!("../../scenes/6205-healthy.toml");
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("interface");
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("scene.toml"), text).unwrap();
        let model = model_file::encode(&brinell_scene_file::from_toml(text).unwrap(), text).unwrap();
        fs::write(folder.join("model.bin"), model).unwrap();
        // SAFETY: the logger ignores what it gets; leaving arguments out of a C function does no harm on the platforms
        // measured.
        let logger = unsafe { std::mem::transmute::<Logger, LoggerCallback>(ignore) };
        let callbacks = CallbackFunctions {
            logger: Some(logger),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: ptr::null_mut(),
        };
        let location = CString::new(format!("file://{}", folder.to_str().unwrap())).unwrap();
        Self { text, folder, location, identity: CString::new(guid(text, None)).unwrap(), callbacks }
    }

    fn instance(&self, api: &Api) -> Component {
        let (identity, location) = (self.identity.as_ptr(), self.location.as_ptr());
        let callbacks = &raw const self.callbacks;
        // SAFETY: all of them live as long as the instances here.
        unsafe { (api.instantiate)(c"bench".as_ptr(), CO_SIMULATION, identity, location, callbacks, FALSE, FALSE) }
    }
}

/// The library that was built along with this program, or the one that it was given.
fn library() -> PathBuf {
    let name = format!("{}brinell_fmi{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    let given = env::args().skip(1).find(|argument| !argument.starts_with("--"));
    given.map_or_else(|| env::current_exe().unwrap().with_file_name(name), |given| brinell_tests::root().join(given))
}

/// References of 20 outputs, and of 20 inputs, some of them several times.
fn references(table: &[Variable]) -> (Vec<u32>, Vec<u32>) {
    let is_output = |v: &&Variable| v.causality == Causality::Output && matches!(v.kind, Kind::Real { .. });
    let outputs = table.iter().filter(is_output).filter(|v| !v.name.contains("stiffness"));
    let inputs = table.iter().filter(|v| v.causality == Causality::Input).cycle();
    (outputs.map(|v| v.reference).take(20).collect(), inputs.map(|v| v.reference).take(20).collect())
}

fn reading_and_setting(api: &Api, c: Component, table: &[Variable]) {
    let (outputs, inputs) = references(table);
    let mut values = [0.0; 20];
    api.get(c, &outputs, &mut values);
    let none = time(200, 20_000, || _ = black_box(api.get(c, &[], &mut [])));
    let one = time(200, 20_000, || _ = black_box(api.get(c, &outputs[..1], &mut values)));
    let twenty = time(200, 20_000, || _ = black_box(api.get(c, &outputs, &mut values)));
    println!("get ×0, ×1, ×20             {none:8.1} {one:8.1} {twenty:8.1} ns");
    let mut given = [0.0; 20];
    assert_eq!(api.get(c, &inputs, &mut given), Status::Ok);
    let one = time(200, 20_000, || _ = black_box(api.set(c, &inputs[..1], &given)));
    let twenty = time(200, 20_000, || _ = black_box(api.set(c, &inputs, &given)));
    println!("set ×1, ×20                 {one:8.1} {twenty:8.1} ns");
}

fn stepping(api: &Api, c: Component, simulation: &mut Simulation) {
    // SAFETY: a null handle is refused, the other one is alive.
    let step = |c, point, h| unsafe { (api.step)(c, point, h, TRUE) };
    let refused = time(200, 20_000, || _ = black_box(step(ptr::null_mut(), 0.0, 1e-9)));
    println!("doStep on a null handle     {refused:8.1} ns");
    let h = 1e-12;
    let (mut through, mut direct) = (f64::INFINITY, f64::INFINITY);
    let mut point = 0.0;
    // Interleaved, so that both meet the same machine.
    for _ in 0..200 {
        through = through.min(time(1, 500, || {
            assert_eq!(step(c, point, h), Status::Ok);
            point += h;
        }));
        direct = direct.min(time(1, 500, || simulation.step(black_box(h)).unwrap()));
    }
    println!("doStep, Simulation::step    {through:8.1} {direct:8.1} ns, overhead {:.1} ns", through - direct);
}

fn saving(api: &Api, c: Component) {
    let mut state = ptr::null_mut();
    // SAFETY: the state is that of this instance.
    unsafe {
        assert_eq!((api.save)(c, &raw mut state), Status::Ok);
        let saving = time(200, 20_000, || _ = black_box((api.save)(c, &raw mut state)));
        let restoring = time(200, 20_000, || _ = black_box((api.restore)(c, state)));
        println!("GetFMUstate, SetFMUstate    {saving:8.1} {restoring:8.1} ns");
    }
}

fn living(api: &Api, resources: &Resources) {
    // SAFETY: each instance is freed once.
    let free = |c| unsafe { (api.free)(c) };
    let created = time(50, 20, || free(black_box(resources.instance(api))));
    let started = time(50, 20, || {
        let c = resources.instance(api);
        api.start(c);
        free(c);
    });
    println!("create–free, create–init–free {:8.1} {:8.1} µs", created / 1e3, started / 1e3);
}

fn main() {
    let resources = Resources::new();
    let path = library();
    println!("{}", path.display());
    // SAFETY: loading our own library runs no code.
    let library = unsafe { Library::new(&path).unwrap() };
    let api = Api::of(&library);
    let c = resources.instance(&api);
    api.start(c);
    let mut simulation = Simulation::new(brinell_scene_file::from_toml(resources.text).unwrap(), None).unwrap();
    simulation.initialize(0.0).unwrap();
    reading_and_setting(&api, c, simulation.table());
    stepping(&api, c, &mut simulation);
    saving(&api, c);
    living(&api, &resources);
    // SAFETY: the last use of the instance.
    unsafe { (api.free)(c) };
    fs::remove_dir_all(&resources.folder).unwrap();
}
