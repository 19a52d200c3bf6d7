//! What tests of the model share: scenes written in a few lines, and named access to variables.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used)] // each test program uses a part of this

use brinell::scene::Scene;
use brinell::simulation::Simulation;

/// A scene file that ships with the project, with the contact law that needs no map: these tests are of what moves.
pub fn shipped(name: &str) -> Scene {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(format!("{name}.toml"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let mut scene = Scene::from_toml(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    scene.contact.law = brinell::scene::ContactLaw::Hertz;
    scene
}

/// Text of the profile file that a shipped scene names, if it names one.
pub fn profile_of(scene: &Scene) -> Option<String> {
    let brinell::scene::DefectShape::Profile(file) = &scene.defect.as_ref()?.shape else { return None };
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(file);
    Some(std::fs::read_to_string(path).unwrap())
}

/// A simulation with access by name.
pub struct Named(pub Simulation);

impl Named {
    pub fn new(scene: Scene) -> Self {
        let profile = profile_of(&scene);
        Self(Simulation::new(scene, profile.as_deref()).unwrap())
    }

    /// Set up and initialized at time 0.
    pub fn started(scene: Scene) -> Self {
        let mut named = Self::new(scene);
        named.0.initialize(0.0).unwrap();
        named
    }

    pub fn reference(&self, name: &str) -> u32 {
        self.0.reference(name).unwrap()
    }

    pub fn get(&mut self, name: &str) -> f64 {
        let mut value = [0.0];
        let reference = self.reference(name);
        self.0.reals(&[reference], &mut value).unwrap();
        value[0]
    }

    pub fn count(&mut self, name: &str) -> i32 {
        let mut value = [0];
        let reference = self.reference(name);
        self.0.integers(&[reference], &mut value).unwrap();
        value[0]
    }

    pub fn set(&mut self, name: &str, value: f64) {
        let reference = self.reference(name);
        self.0.set_reals(&[reference], &[value]).unwrap();
    }

    pub fn run(&mut self, step: f64, count: usize) {
        for _ in 0..count {
            self.0.step(step).unwrap();
        }
    }

    /// Force between each element and the inner raceway [N].
    pub fn inner_forces(&mut self, count: usize) -> Vec<f64> {
        (1..=count).map(|j| self.get(&format!("element[{j}].force.inner"))).collect()
    }
}
