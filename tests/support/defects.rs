//! Scenes with a defect of the inner raceway or of a ball.

use super::{Named, shipped};
use brinell::dynamics::parameters::SMOOTH;
use brinell::scene::{ContactLaw, Defect, DefectOn, DefectShape, Ring, Scene};
use std::f64::consts::FRAC_PI_2;

/// Speeds of the ER16K at 10 Hz against the inner raceway and of an element's own turning against the cage (rad/s).
pub const PAST_INNER: f64 = 37.7598;
pub const SPIN: f64 = 149.2322;

pub fn spall(length: f64, depth: f64) -> DefectShape {
    DefectShape::Spall { length, depth, edge_slope: FRAC_PI_2 }
}

/// So short and shallow that a contact bridges it.
pub fn short_spall() -> DefectShape {
    spall(2e-4, 2e-6)
}

/// As fine a map as energy asks for, of a coarse grid.
pub fn mapped(mut scene: Scene) -> Scene {
    (scene.contact.law, scene.contact.cells) = (ContactLaw::Map, Some([24, 16]));
    scene.contact.map_accuracy = Some(1e-2);
    scene
}

/// How many contacts of a run of 400 steps were kept in cells of defects, and how many of all in another than that of
/// their angle.
pub fn cells_kept(scene: Scene) -> [usize; 2] {
    let mut bearing = Named::started(scene);
    let (mut inside, mut differ) = (0, 0);
    for _ in 0..400 {
        bearing.0.step(7.3e-5).unwrap();
        let (model, excitation) = bearing.0.equations();
        let there = model.cells_at(&excitation, 0.0, bearing.0.state_vector());
        let kept = bearing.0.cells();
        differ += there.iter().zip(kept.iter()).filter(|(a, b)| a != b).count();
        inside += kept.iter().filter(|&&cell| cell != SMOOTH).count();
    }
    [inside, differ]
}

/// ER16K under law `hertz` with its outer ring held, so that runs do not become chaotic at once.
pub fn held(defect: Defect) -> Scene {
    let mut scene = shipped("er16k-tb1");
    (scene.housing, scene.sensors) = (Ring::fixed(), Vec::new());
    scene.tolerance = 1e-9;
    scene.defects = vec![defect];
    scene
}

/// A spall of 10° in the inner raceway that element 1, under the load at the start, enters after 5 ms.
pub fn inner() -> Scene {
    let mut scene = held(Defect::inner(-105.8f64.to_radians(), DefectShape::Profile("".into())));
    let length = 10f64.to_radians() * scene.bearing.inner_raceway_radius();
    scene.defects[0].shape = spall(length, 100e-6);
    scene.cage.initial_angle = -FRAC_PI_2;
    scene
}

/// A spall on element 1 that faces the outer raceway under the load after 5 ms.
pub fn element(length: f64) -> Scene {
    let on = DefectOn::Element { element: 0, tilt: 0.0 };
    let mut scene = held(Defect { on, angle: SPIN * 5e-3, shape: spall(length, 100e-6) });
    scene.cage.initial_angle = -100f64.to_radians();
    scene
}
