//! Text as a measured trace or topography: refused with a reason, or a raceway that elements can roll over.
#![no_main]

use brinell::scene::{DefectShape, Scene};
use brinell::simulation::Simulation;
use brinell::surface::Surface;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let mut scene = Scene::from_toml(brinell_fuzz::SCENES[0]).unwrap();
    if let Some(defect) = &mut scene.defect {
        defect.shape = DefectShape::Profile("trace.csv".to_owned());
        let Ok(surface) = Surface::load(&defect.shape, Some(text), &scene.bearing) else { return };
        let (first, last) = surface.extent();
        assert!(first.is_finite() && last.is_finite() && first <= last);
    }
    if let Ok(simulation) = Simulation::new(scene, Some(text)) {
        brinell_fuzz::run(simulation);
    }
});
