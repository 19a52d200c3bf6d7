//! Text as a scene file: refused with a reason, or a bearing that can be set up and stepped.

use brinell::scene::{ContactLaw, model_file};
use brinell::simulation::Simulation;

pub(super) fn run(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    let Ok(mut scene) = brinell_scene_file::from_toml(text) else { return false };
    // An FMU gets the same scene, bit by bit.
    let model = model_file::encode(&scene, text).unwrap();
    assert_eq!(model_file::encode(&model_file::decode(&model, text).unwrap(), text).unwrap(), model);
    // Contact maps take seconds; hundreds of elements take long without telling more.
    scene.contact.law = ContactLaw::Hertz;
    scene.max_steps = scene.max_steps.min(super::MAX_STEPS);
    if scene.bearing.element_count > 30 {
        return false;
    }
    Simulation::new(scene, None).map(super::simulate).is_ok()
}
