//! One entry into a spall and out of it under the three contact laws: the same events.

use crate::support::{Named, shipped_as_it_is};
use brinell::scene::ContactLaw;
use brinell::simulation::Simulation;

const RATE: f64 = 51_200.0;

/// Outer force on the first element, sampled.
fn force(law: ContactLaw) -> Vec<f64> {
    let mut scene = shipped_as_it_is("er16k-tb1");
    scene.contact.law = law;
    // Coarse: the test is about events.
    scene.contact.cells = Some([32, 16]);
    scene.contact.map_accuracy = Some(3e-3);
    let mut bearing = Named(Simulation::new(scene, None).unwrap());
    bearing.0.initialize(0.0).unwrap();
    bearing.course(["element[1].force.outer"], 1.0 / RATE, (0.02 * RATE) as usize).concat()
}

#[test]
fn an_element_is_unloaded_struck_and_loaded_again_at_the_same_times_under_all_laws() {
    let events = [ContactLaw::Love, ContactLaw::Map, ContactLaw::Hertz].map(|law| {
        let force = force(law);
        let unloaded = force.iter().position(|&f| f <= 0.0).unwrap();
        let peak = (unloaded..force.len()).max_by(|&a, &b| force[a].total_cmp(&force[b])).unwrap();
        (unloaded as f64 / RATE, peak as f64 / RATE, force[peak])
    });
    let [love, map, hertz] = events;
    // A sample is 0.02 ms; the map's error is 3e-3 of twice the force, the grid's own steps as much.
    assert!((map.0 - love.0).abs() < 5e-5 && (map.1 - love.1).abs() < 1e-4, "{map:?} {love:?}");
    assert!((map.2 / love.2 - 1.0).abs() < 0.02, "{map:?} {love:?}");
    // The earlier model holds the element at the edge a little longer and more strongly.
    assert!((hertz.0 - love.0).abs() < 3e-4 && (hertz.1 - love.1).abs() < 1e-3, "{hertz:?} {love:?}");
}
