//! Text as a scene file: refused with a reason, or a bearing that can be set up and stepped.
#![no_main]

use brinell::scene::{ContactLaw, model_file};
use brinell::simulation::Simulation;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(mut scene) = brinell_scene_file::from_toml(text) else { return };
    // An FMU gets the same scene, bit by bit.
    let model = model_file::encode(&scene, text).unwrap();
    assert_eq!(model_file::encode(&model_file::decode(&model, text).unwrap(), text).unwrap(), model);
    // Contact maps take seconds; hundreds of elements take long without telling more.
    scene.contact.law = ContactLaw::Hertz;
    scene.max_steps = scene.max_steps.min(brinell_fuzz::MAX_STEPS);
    if scene.bearing.element_count > 30 {
        return;
    }
    if let Ok(simulation) = Simulation::new(scene, None) {
        brinell_fuzz::run(simulation);
    }
});
