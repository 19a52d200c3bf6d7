//! What the fuzz targets share: small scenes, an instance behind the C interface, and checks.
//!
//! A target fails on a crash, on a panic even if the interface would catch it, on a call that takes longer than
//! libFuzzer's timeout, on memory that leaks, and on a number that is not finite under `fmi2OK`.

use std::ffi::CString;
use std::path::PathBuf;
use std::{fs, ptr};

use brinell::scene::model_file;
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::{guid, Kind, Variable};
use brinell_fmi::fmi2::*;

/// Scenes: both rings moved by forces, one of them by the host, both by the host; and defects of all bodies, an outer
/// ring that turns, an irregular cage, sensors and a probe.
pub const SCENES: [&str; 4] = [
    concat!(include_str!("bearing.toml"), include_str!("internal.toml")),
    concat!(include_str!("bearing.toml"), include_str!("hosted_shaft.toml")),
    concat!(include_str!("bearing.toml"), include_str!("hosted.toml")),
    include_str!("everything.toml"),
];

/// Most integration steps in one communication step: a fuzzer finds the slowest inputs first.
pub const MAX_STEPS: u64 = 2000;

unsafe extern "C" fn ignore(_: ComponentEnvironment, _: FmiString, _: Status, _: FmiString, _: FmiString) {}

/// Unpacked resources of one scene.
pub struct Resources {
    directory: PathBuf,
    location: CString,
    guid: CString,
    /// The scene's variables.
    pub table: Vec<Variable>,
}

impl Resources {
    /// Writes the scene where a process of this number finds it again.
    pub fn new(number: usize) -> Self {
        let text = SCENES[number];
        let directory = std::env::temp_dir().join(format!("brinell-fuzz-{}-{number}", std::process::id()));
        fs::create_dir_all(&directory).unwrap();
        fs::write(directory.join("scene.toml"), text).unwrap();
        let scene = brinell_scene_file::from_toml(text).unwrap();
        fs::write(directory.join("model.bin"), model_file::encode(&scene, text).unwrap()).unwrap();
        let table = Simulation::new(scene, None).unwrap().table().to_vec();
        Self {
            location: CString::new(format!("file://{}", directory.display())).unwrap(),
            guid: CString::new(guid(text, None)).unwrap(),
            directory,
            table,
        }
    }

    /// A new instance.
    pub fn instance(&self) -> Component {
        type Logger = unsafe extern "C" fn(ComponentEnvironment, FmiString, Status, FmiString, FmiString);
        // The logger takes fewer arguments than it gets, which harms nobody on the platforms that libFuzzer runs on.
        let logger = unsafe { std::mem::transmute::<Logger, LoggerCallback>(ignore) };
        let callbacks = CallbackFunctions {
            logger: Some(logger),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            component_environment: ptr::null_mut(),
        };
        let (guid, location) = (self.guid.as_ptr(), self.location.as_ptr());
        let c = unsafe { fmi2Instantiate(c"fuzz".as_ptr(), CO_SIMULATION, guid, location, &callbacks, FALSE, TRUE) };
        assert!(!c.is_null());
        c
    }

    /// References of all real variables.
    pub fn reals(&self) -> Vec<u32> {
        self.table.iter().filter(|v| matches!(v.kind, Kind::Real { .. })).map(|v| v.reference).collect()
    }
}

impl Drop for Resources {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.directory);
    }
}

/// Brings a new instance to its first communication point.
pub fn start(c: Component) {
    unsafe {
        assert_eq!(fmi2SetupExperiment(c, FALSE, 0.0, 0.0, FALSE, 0.0), Status::Ok);
        assert_eq!(fmi2EnterInitializationMode(c), Status::Ok);
        assert_eq!(fmi2ExitInitializationMode(c), Status::Ok);
    }
}

/// Reads variables; under OK all must be finite.
pub fn get(c: Component, references: &[u32]) -> Status {
    let mut values = vec![f64::NAN; references.len()];
    let status = unsafe { fmi2GetReal(c, references.as_ptr(), references.len(), values.as_mut_ptr()) };
    assert!(status != Status::Ok || values.iter().all(|value| value.is_finite()), "not finite under OK");
    status
}

/// Runs a simulation for a moment: results are finite or there is an error.
pub fn run(mut simulation: Simulation) {
    let reals: Vec<u32> =
        simulation.table().iter().filter(|v| matches!(v.kind, Kind::Real { .. })).map(|v| v.reference).collect();
    let mut values = vec![0.0; reals.len()];
    if simulation.initialize(0.0).is_err() {
        return;
    }
    for step in [1e-6, 1e-5, 1e-4] {
        if simulation.step(step).is_err() || simulation.reals(&reals, &mut values).is_err() {
            return;
        }
        let bad = values.iter().position(|value| !value.is_finite());
        // The C interface refuses to hand such values out; here it is enough that the states are sound.
        assert!(simulation.state_vector().iter().all(|value| value.is_finite()), "state, variable {bad:?}");
    }
}

/// The checksum that guards states and maps.
pub use brinell::numerics::checksum::checksum;
