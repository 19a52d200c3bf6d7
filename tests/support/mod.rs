//! What tests of the model share: scenes written in a few lines, and named access to variables.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used)] // each test program uses a part of this

pub mod coupled;
pub mod defects;
pub mod differences;
pub mod draw;
pub mod energy;
pub mod loaded;
#[path = "../../fmu-build/map_sources.rs"]
mod map_sources;

use std::collections::BTreeMap;
use std::fs;
use std::hash::Hasher;
use std::path::Path;
use std::sync::{Arc, Mutex, OnceLock};

use brinell::contact::error::ContactError;
use brinell::contact::map::{ContactMap, ContactMaps, Runner};
use brinell::numerics::checksum::Checksum;
use brinell::scene::{Bearing, ContactLaw, DefectOn, Roller, RollerProfile, RollingElement, Scene};
use brinell::simulation::Simulation;
use brinell::simulation::setup::{self, NeededMap};
use brinell::surface::Surface;
use rayon::prelude::*;

/// A scene file that ships with the project, with the contact law that needs no map: these tests are of what moves.
pub fn shipped(name: &str) -> Scene {
    let mut scene = shipped_as_it_is(name);
    scene.contact.law = brinell::scene::ContactLaw::Hertz;
    scene
}

/// A scene file that ships with the project.
pub fn shipped_as_it_is(name: &str) -> Scene {
    let path = brinell_tests::root().join("scenes").join(format!("{name}.toml"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    brinell_scene_file::from_toml(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Straight rollers of this length (m).
pub fn straight(length: f64) -> RollingElement {
    RollingElement::CylindricalRoller(Roller { length, profile: RollerProfile::Straight, laminae: Roller::LAMINAE })
}

/// The same scene seen from a frame that is turned by an angle (rad), a defect of the inner ring and sensors with it.
pub fn turned(scene: &Scene, by: f64) -> Scene {
    let mut other = scene.clone();
    (other.gravity, other.shaft.load) = (turned_vector(scene.gravity, by), turned_vector(scene.shaft.load, by));
    other.cage.initial_angle += by;
    other.sensors.iter_mut().for_each(|sensor| sensor.direction += by);
    // The angle on an element is counted from the element's own direction.
    if scene.defects.iter().any(|defect| defect.on == DefectOn::Inner) {
        other.shaft_initial_angle += by;
    }
    other
}

pub fn turned_vector([x, y]: [f64; 2], by: f64) -> [f64; 2] {
    let (sin, cos) = by.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

/// Where a step of `h` by Runge and Kutta's classical method ends.
pub fn runge_kutta(start: &[f64], h: f64, mut slope: impl FnMut(&[f64]) -> Vec<f64>) -> Vec<f64> {
    let along = |slope: &[f64], by: f64| start.iter().zip(slope).map(|(x, k)| x + by * k).collect::<Vec<_>>();
    let first = slope(start);
    let second = slope(&along(&first, 0.5 * h));
    let third = slope(&along(&second, 0.5 * h));
    let fourth = slope(&along(&third, h));
    let mean = (0..start.len()).map(|i| (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]) / 6.0);
    along(&mean.collect::<Vec<_>>(), h)
}

/// Largest difference of two lists.
pub fn furthest(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).fold(0.0, |most, (a, b)| (a - b).abs().max(most))
}

/// Checksum of numbers.
pub fn fingerprint(bits: impl Iterator<Item = u64>) -> u64 {
    let mut sum = Checksum::default();
    bits.for_each(|number| sum.write(&number.to_le_bytes()));
    sum.finish()
}

/// Texts of the profile files that a shipped scene names.
pub fn profiles_of(scene: &Scene) -> Vec<String> {
    let folder = brinell_tests::root().join("scenes");
    scene.profile_names().iter().map(|file| fs::read_to_string(folder.join(file)).unwrap()).collect()
}

/// Text of the first profile file that a shipped scene names, if it names one.
pub fn profile_of(scene: &Scene) -> Option<String> {
    profiles_of(scene).into_iter().next()
}

/// Maps of this process, by the fingerprint of what they depend on.
static MAPS: Mutex<BTreeMap<u64, Arc<OnceLock<Vec<u8>>>>> = Mutex::new(BTreeMap::new());

/// The contact maps of a scene, each computed once for all test programs and kept where `cargo fmu` keeps and finds
/// maps as well, under the same name: none outlives a change of the sources that compute it.
pub fn map_of<'p>(scene: &Scene, profiles: impl IntoIterator<Item = &'p str>) -> Option<Vec<u8>> {
    if scene.defects.is_empty() || scene.contact.law != ContactLaw::Map {
        return None;
    }
    let surfaces = Surface::load_all(scene, profiles).unwrap();
    let maps = setup::needed_maps(scene, &surfaces).unwrap();
    let maps = maps.iter().map(|needed| ContactMap::from_bytes(&one_map(needed), needed.fingerprint).unwrap());
    Some(ContactMaps::new(maps).to_bytes())
}

fn one_map(needed: &NeededMap) -> Vec<u8> {
    let map = Arc::clone(MAPS.lock().unwrap().entry(needed.fingerprint).or_default());
    let bytes = map.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).with_file_name("maps");
        let sources = map_sources::fingerprint(brinell_tests::root()).unwrap();
        let file = folder.join(format!("{:016x}-{sources}.bin", needed.fingerprint));
        if let Ok(bytes) = fs::read(&file) {
            return bytes;
        }
        let bytes = needed.build(&mut Cores).unwrap().to_bytes();
        fs::create_dir_all(&folder).unwrap();
        let partial = file.with_extension(format!("{}.part", std::process::id()));
        fs::write(&partial, &bytes).unwrap();
        fs::rename(&partial, &file).unwrap();
        bytes
    });
    bytes.clone()
}

/// As many threads as there are cores; the map has the same bits however many.
struct Cores;

impl Runner for Cores {
    fn run<T: Send>(
        &mut self,
        count: usize,
        job: &(dyn Fn(usize) -> Result<T, ContactError> + Sync),
    ) -> Result<Vec<T>, ContactError> {
        (0..count).into_par_iter().with_max_len(1).map(job).collect()
    }
}

/// A simulation with access by name.
pub struct Named(pub Simulation);

impl Named {
    pub fn new(scene: Scene) -> Self {
        let profiles = profiles_of(&scene);
        let map = map_of(&scene, profiles.iter().map(String::as_str));
        Self(Simulation::with_map(scene, profiles.iter().map(String::as_str), map.as_deref()).unwrap())
    }

    /// Set up and initialized at time 0.
    pub fn started(scene: Scene) -> Self {
        let mut named = Self::new(scene);
        named.0.initialize(0.0).unwrap();
        named
    }

    /// The same with variables set beforehand.
    pub fn started_with(scene: Scene, values: &[(&str, f64)]) -> Self {
        let mut named = Self::new(scene);
        values.iter().for_each(|(name, value)| named.set(name, *value));
        named.0.initialize(0.0).unwrap();
        named
    }

    /// The same, its recorder on.
    pub fn recorded(scene: Scene) -> Self {
        let mut named = Self::new(scene);
        named.0.record_into("memory");
        named.0.initialize(0.0).unwrap();
        named
    }

    /// Columns of the rows that the recorder has kept.
    pub fn columns(&self, names: &[&str]) -> Vec<Vec<f64>> {
        let recorder = self.0.recorder().unwrap();
        let samples = recorder.samples();
        let column = |name: &&str| {
            let reference = self.reference(name);
            let at = 1 + recorder.references().position(|r| r == reference).unwrap();
            samples.values.chunks(samples.width).map(|row| row[at]).collect()
        };
        names.iter().map(column).collect()
    }

    pub fn reference(&self, name: &str) -> u32 {
        self.0.reference(name).unwrap()
    }

    pub fn get(&mut self, name: &str) -> f64 {
        self.0.get(name).unwrap()
    }

    pub fn all<const N: usize>(&mut self, names: [&str; N]) -> [f64; N] {
        names.map(|name| self.get(name))
    }

    pub fn bits<const N: usize>(&mut self, names: [&str; N]) -> [u64; N] {
        self.all(names).map(f64::to_bits)
    }

    pub fn count(&mut self, name: &str) -> i32 {
        let mut value = [0];
        let reference = self.reference(name);
        self.0.integers(&[reference], &mut value).unwrap();
        value[0]
    }

    pub fn set(&mut self, name: &str, value: f64) {
        self.0.set(name, value).unwrap();
    }

    pub fn run(&mut self, step: f64, count: usize) {
        for _ in 0..count {
            self.0.step(step).unwrap();
        }
    }

    /// Values after each of so many steps (s).
    pub fn course<const N: usize>(&mut self, names: [&str; N], step: f64, count: usize) -> Vec<[f64; N]> {
        let samples = self.0.samples(&names, step).unwrap().skip(1).take(count);
        samples.map(|sample| sample.unwrap().values.try_into().unwrap()).collect()
    }

    /// Takes so many steps (s) twice from here, and once in another simulation by way of a state in bytes: values and
    /// counts of steps must have the same bits.
    pub fn goes_on_alike<const N: usize>(&mut self, other: &mut Self, names: [&str; N], step: f64, count: usize) {
        let state = self.0.save();
        let bytes = state.to_bytes();
        let go_on = |bearing: &mut Self| {
            bearing.run(step, count);
            (bearing.bits(names), bearing.0.step_counts())
        };
        let first = go_on(self);
        self.0.restore(&state).unwrap();
        assert_eq!(go_on(self), first);
        let state = other.0.state_from_bytes(&bytes).unwrap();
        other.0.restore(&state).unwrap();
        assert_eq!(go_on(other), first);
    }

    /// What element 3 presses on the outer raceway with (N), and what it must by m (ρ ω² + g·e_r), after 20 ms in which
    /// nothing but its own weight and turn presses it there; `omega` (rad/s) is the cage's speed.
    pub fn pressed_outwards(&mut self, bearing: &Bearing, omega: f64) -> [f64; 2] {
        self.run(1e-4, 200);
        let radius = bearing.outer_raceway_radius() - bearing.element_radius();
        let gravity = -9.81 * self.get("element[3].angle").sin();
        let turning = (radius + self.get("element[3].path")) * omega * omega;
        [self.get("element[3].force.outer"), bearing.mass_of_element() * (turning + gravity)]
    }

    /// Force between each element and the inner raceway (N).
    pub fn inner_forces(&mut self, count: usize) -> Vec<f64> {
        (1..=count).map(|j| self.get(&format!("element[{j}].force.inner"))).collect()
    }
}
