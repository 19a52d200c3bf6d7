//! Text as a measured trace or topography of a raceway or an element: refused with a reason, or a surface that elements
//! can roll over.

use brinell::scene::{DefectOn, DefectShape};
use brinell::simulation::Simulation;
use brinell::surface::Surface;

pub(super) fn run(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let mut scene = brinell_scene_file::from_toml(super::SCENES[0]).unwrap();
    if let Some(defect) = scene.defects.first_mut() {
        defect.shape = DefectShape::Profile("trace.csv".into());
        let element = DefectOn::Element { element: 0, tilt: 0.0 };
        defect.on = [DefectOn::Outer, DefectOn::Inner, element][text.len() % 3];
        let Ok(surface) = Surface::load(defect, Some(text), &scene.bearing) else { return false };
        let (first, last) = surface.extent();
        assert!(first.is_finite() && last.is_finite() && first <= last);
    }
    Simulation::new(scene, Some(text)).map(super::simulate).is_ok()
}
