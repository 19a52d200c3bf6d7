//! What is changed between runs: a bearing with a parameter set moves as one that was described so.

use crate::support::{Named, shipped};
use brinell::scene::{ContactLaw, DefectOn, DefectShape, DrawnDiameters, Recorder, RecorderFilter, Scene};
use brinell::simulation::interface::table::Kind;
use brinell::simulation::{Simulation, SimulationError};

fn sized(scene: &Scene, [new_length, new_depth]: [f64; 2]) -> Scene {
    let mut changed = scene.clone();
    let DefectShape::Spall { length, depth, .. } = &mut changed.defects[0].shape else { panic!() };
    (*length, *depth) = (new_length, new_depth);
    changed
}

/// Every output after a step, from a bearing as it is described.
fn moved(mut simulation: Simulation) -> Vec<(String, f64)> {
    simulation.initialize(0.0).unwrap();
    simulation.step(4e-3).unwrap();
    let names: Vec<String> = simulation.table().iter().map(|row| row.name.clone()).collect();
    names
        .into_iter()
        .filter(|name| !name.starts_with("solver") && !name.starts_with("defect") && !name.starts_with("sensor.res"))
        .filter_map(|name| simulation.get(&name).ok().map(|value| (name, value)))
        .collect()
}

/// A bearing with reals and integers set moves as it was described so, and otherwise than without them.
fn moves_as_described(scene: &Scene, reals: &[(&str, f64)], integers: &[(&str, i32)], described: Scene) {
    let mut set = Simulation::new(scene.clone(), None).unwrap();
    reals.iter().for_each(|(name, value)| set.set(name, *value).unwrap());
    for (name, value) in integers {
        set.set_integers(&[set.reference(name).unwrap()], &[*value]).unwrap();
    }
    let (set, described) = (moved(set), moved(Simulation::new(described, None).unwrap()));
    assert_eq!(set, described);
    let is_set = |name: &str| reals.iter().any(|(set, _)| *set == name);
    let others = |rows: Vec<(String, f64)>| rows.into_iter().filter(|(name, _)| !is_set(name)).collect::<Vec<_>>();
    assert_ne!(others(set), others(moved(Simulation::new(scene.clone(), None).unwrap())), "it changes nothing");
}

fn spalled(law: ContactLaw) -> Scene {
    let mut scene = shipped("er16k-tb1");
    scene.contact.law = law;
    // Coarse, so that a map takes a moment. An element stands over the spall at the start.
    (scene.contact.cells, scene.contact.map_accuracy) = (Some([8, 8]), Some(0.1));
    scene.cage.initial_angle = scene.defects[0].angle;
    scene
}

#[test]
fn a_spall_whose_sizes_are_set_is_one_that_was_described_with_them() {
    for (law, flank_map) in [(ContactLaw::Hertz, false), (ContactLaw::Map, false), (ContactLaw::Map, true)] {
        let mut scene = spalled(law);
        scene.contact.flank_map = flank_map;
        // Long enough for a map of its flanks.
        let sizes = [if flank_map { 4.5e-3 } else { 3e-3 }, 25e-6];
        let set = [("defect.length", sizes[0]), ("defect.depth", sizes[1])];
        moves_as_described(&scene, &set, &[], sized(&scene, sizes));
    }
}

#[test]
fn a_spall_that_does_not_fit_is_refused_with_its_size_and_the_limit() {
    let mut bearing = Simulation::new(spalled(ContactLaw::Hertz), None).unwrap();
    let error = bearing.set("defect.depth", 1.0).unwrap_err().to_string();
    assert!(error.starts_with("variable defect.depth: 1 is outside 1e-9 … "), "{error}");
    // Each is possible by itself: 20 µm long, with flanks of 45 degrees that meet at 10 µm.
    let mut scene = spalled(ContactLaw::Hertz);
    let DefectShape::Spall { edge_slope, .. } = &mut scene.defects[0].shape else { panic!() };
    *edge_slope = std::f64::consts::FRAC_PI_4;
    let mut bearing = Simulation::new(scene, None).unwrap();
    bearing.set("defect.length", 20e-6).unwrap();
    let error = bearing.initialize(0.0).unwrap_err();
    assert!(matches!(error, SimulationError::Scene(_)), "{error}");
}

#[test]
fn every_law_takes_the_sizes_that_are_declared() {
    let mut tilted = shipped("er16k-element");
    let DefectOn::Element { tilt, .. } = &mut tilted.defects[0].on else { panic!() };
    *tilt = 0.05;
    let [outer, inner, element] = ["er16k-tb1", "er16k-inner", "er16k-element"].map(shipped);
    let laws = [ContactLaw::Hertz, ContactLaw::Map, ContactLaw::Love];
    for (law, scene) in laws.into_iter().flat_map(|law| [&outer, &inner, &element, &tilted].map(|scene| (law, scene))) {
        let mut scene = scene.clone();
        (scene.contact.law, scene.contact.cells, scene.contact.map_accuracy) = (law, Some([8, 8]), Some(0.1));
        let bearing = Simulation::new(scene.clone(), None).unwrap();
        for name in ["defect.length", "defect.depth"] {
            let row = bearing.variable(bearing.reference(name).unwrap()).unwrap();
            let Kind::Real { min: Some(min), max: Some(max), .. } = row.kind else { panic!("{name} has no limits") };
            for size in [min, max] {
                let mut bearing = Simulation::new(scene.clone(), None).unwrap();
                bearing.set(name, size).unwrap();
                bearing.initialize(0.0).unwrap_or_else(|error| panic!("{law:?}, {name} = {size}: {error}"));
            }
        }
    }
}

#[test]
fn under_law_map_a_spalls_size_has_no_derivative() {
    let mut bearing = Simulation::new(spalled(ContactLaw::Map), None).unwrap();
    let [length, y] = ["defect.length", "shaft.y"].map(|name| bearing.reference(name).unwrap());
    let error = bearing.directional_derivative(&[y], &[length], &[1.0], &mut [0.0]).unwrap_err();
    assert!(matches!(&error, SimulationError::NoDerivativeBySize(name) if name == "defect.length"), "{error}");
}

#[test]
fn a_cage_with_another_seed_is_one_that_was_drawn_with_it() {
    let text = include_str!("../../../scenes/6205-irregular-cage.toml");
    let with_seed = |seed: &str| {
        let line = text.lines().find(|line| line.starts_with("seed")).unwrap();
        brinell_scene_file::from_toml(&text.replace(line, &format!("seed = {seed}"))).unwrap()
    };
    moves_as_described(&with_seed("5"), &[], &[("cage.seed", 77)], with_seed("77"));
    // FMI 2.0 has no integer for it.
    let large = Simulation::new(with_seed("3000000000"), None).unwrap();
    assert!(large.reference("cage.seed").is_err());
    let mut bearing = Simulation::new(with_seed("5"), None).unwrap();
    let seed = bearing.reference("cage.seed").unwrap();
    let error = bearing.set_integers(&[seed], &[-1]).unwrap_err();
    assert_eq!(error.to_string(), "variable cage.seed: -1 is outside 0 … 2.147483647e9");
}

#[test]
fn elements_with_another_seed_are_those_that_were_drawn_with_it() {
    let with_seed = |seed: u64| {
        let mut scene = shipped("6205-healthy");
        scene.bearing.draw_diameters(DrawnDiameters { rms: 0.3e-6, seed });
        scene
    };
    moves_as_described(&with_seed(5), &[], &[("bearing.element_diameter_seed", 77)], with_seed(77));
    let reference = |scene: Scene| {
        let bearing = Simulation::new(scene, None).unwrap();
        bearing.reference("bearing.element_diameter_seed").map(|seed| bearing.table().len() - seed as usize)
    };
    // Behind all others, which keep their references, but for the internal clearance.
    assert_eq!(reference(with_seed(5)).unwrap(), 2);
    assert!(reference(with_seed(1 << 31)).is_err() && reference(shipped("6205-healthy")).is_err());
}

#[test]
fn oil_of_another_viscosity_is_one_that_was_described_with_it() {
    let scene = shipped("er16k-tb1-oil");
    let mut thick = scene.clone();
    thick.film.as_mut().unwrap().viscosity = 0.11;
    moves_as_described(&scene, &[("film.viscosity", 0.11)], &[], thick);
}

#[test]
fn a_sensor_with_another_resonance_has_its_mass_and_damping_ratio() {
    let scene = shipped("er16k-tb1");
    let (mut set, mut described) = (Simulation::new(scene.clone(), None).unwrap(), scene.clone());
    set.set("sensor.resonance", 5000.0).unwrap();
    let rate = 5000.0 * std::f64::consts::TAU;
    let sensor = &mut described.sensors[0];
    let ratio = sensor.damping / (2.0 * (sensor.stiffness * sensor.mass).sqrt());
    (sensor.stiffness, sensor.damping) = (sensor.mass * rate * rate, 2.0 * ratio * sensor.mass * rate);
    let before = moved(Simulation::new(scene, None).unwrap());
    let after = moved(Simulation::new(described, None).unwrap());
    let mut differs = false;
    for (((name, set), (_, described)), (_, before)) in moved(set).into_iter().zip(after).zip(before) {
        // Stiffness and damping are rounded otherwise, and what shows a difference of 1e-9 is a rest of 1e-3 m/s².
        assert!((set - described).abs() <= 1e-8 * described.abs(), "{name}: {set} {described}");
        differs |= name == "sensor.acceleration" && (set - before).abs() > 1e-3 * before.abs();
    }
    assert!(differs);
}

/// A healthy bearing with a recorder of a rate (Hz) that is described so and then perhaps set.
fn recorded(filter: RecorderFilter, described: f64, set: Option<f64>) -> Named {
    let recorder = Some(Recorder { rate: described, filter });
    let mut bearing = Named::new(Scene { recorder, ..shipped("6205-healthy") });
    bearing.0.record_into("somewhere");
    if let Some(rate) = set {
        bearing.set("recorder.rate", rate);
    }
    bearing.0.initialize(0.0).unwrap();
    bearing
}

#[test]
fn a_recorder_with_another_rate_has_the_rows_of_one_that_was_described_with_it() {
    for filter in [RecorderFilter::LinearPhase, RecorderFilter::None] {
        let recording = |described: f64, set: Option<f64>| {
            let mut bearing = recorded(filter, described, set);
            bearing.run(10e-3, 1);
            bearing.0.recorder().unwrap().samples().values.to_vec()
        };
        let [set, described] = [recording(51_200.0, Some(12_800.0)), recording(12_800.0, None)];
        assert!(set == described && !set.is_empty(), "{filter:?}: {} and {} numbers", set.len(), described.len());
        assert!(recording(51_200.0, None).len() > 2 * set.len());
    }
}

#[test]
fn bytes_of_a_state_are_judged_by_the_rate_that_is_in_them() {
    let started = |rate: f64| {
        let mut bearing = recorded(RecorderFilter::None, 51_200.0, Some(rate));
        // The next sample of the slow one is due in more than two intervals of the fast one.
        bearing.run(5.01e-3, 1);
        bearing.0
    };
    let (slow, fast) = (started(12_800.0), started(51_200.0));
    assert!(fast.state_from_bytes(&slow.save().to_bytes()).is_ok());
}

#[test]
fn a_state_taken_at_another_rate_brings_its_rate_along() {
    let started = |rate: f64| {
        let mut bearing = recorded(RecorderFilter::LinearPhase, 51_200.0, Some(rate));
        bearing.run(5e-3, 1);
        bearing.0
    };
    let (mut slow, mut fast) = (started(12_800.0), started(51_200.0));
    fast.restore(&slow.save()).unwrap();
    let rows = |bearing: &mut Simulation| {
        bearing.forget_samples();
        bearing.step(10e-3).unwrap();
        bearing.recorder().unwrap().samples().values.to_vec()
    };
    assert_eq!(rows(&mut slow), rows(&mut fast));
}
