//! Elements without inertia, in radial balance at every instant: their limits, snaps, saved states and derivatives, and
//! the model with inertia beside it.

mod derivatives;
mod measured;

use crate::counting;
use crate::support::{Named, shipped, shipped_as_it_is};
use brinell::scene::{ContactLaw, ElementInertia, Ring, Scene};
use brinell::simulation::Method;
use brinell_analysis::modes::{Assembly, Mode};

fn without_inertia(mut scene: Scene) -> Scene {
    scene.bearing.element_inertia = ElementInertia::None;
    scene
}

/// Scenes of every kind of defect and element, in an uneven cage, on a raceway that yields, and moved by a host.
const SCENES: [&str; 9] = [
    "6205-healthy",
    "er16k-tb1",
    "er16k-inner",
    "er16k-element",
    "6205-irregular-cage",
    "er16k-tb2-compliant",
    "er16k-turning-outer",
    "nu205-inner",
    "er16k-tb1-hosted-shaft",
];

#[test]
fn a_bearing_that_stands_has_the_equilibrium_of_elements_with_inertia() {
    for name in SCENES {
        let mut scene = shipped(name);
        (scene.shaft_speed, scene.housing_speed) = (0.0, scene.housing_speed.map(|_| 0.0));
        let [mut full, mut none] = [scene.clone(), without_inertia(scene)].map(Named::started);
        let load = full.get("element[1].force.outer").max(100.0);
        for variable in ["shaft.force.x", "shaft.force.y", "element[1].force.inner", "element[7].force.outer"] {
            let [a, b] = [full.get(variable), none.get(variable)];
            // Both find a balance to 1e-12 of the largest force; rings of little stiffness lie where rounding puts
            // them.
            assert!((a - b).abs() < 1e-8 * load, "{name}: {variable} is {a} and {b}");
        }
        for j in 1..=full.0.scene().bearing.element_count {
            let variable = format!("element[{j}].path");
            let [a, b] = [full.get(&variable), none.get(&variable)];
            assert!((a - b).abs() < 1e-12, "{name}: {variable} is {a:e} and {b:e}");
        }
    }
}

#[test]
fn nothing_accelerates_at_the_start() {
    for name in SCENES {
        let mut bearing = Named::started(without_inertia(shipped(name)));
        let before = bearing.get("shaft.force.y");
        let internal = bearing.0.table().iter().any(|variable| variable.name == "housing.ay");
        bearing.0.step(1e-7).unwrap();
        if internal && name != "er16k-tb1-hosted-shaft" {
            let at = bearing.get("housing.ay").abs().max(bearing.get("shaft.ay").abs());
            // Forces turn with the elements: 1e-7 s are 2 nm of their way, of a force of 1 kN a millionth.
            assert!(at < 1e-3, "{name}: {at} m/s²");
        }
        let after = bearing.get("shaft.force.y");
        assert!((after - before).abs() < 1e-5 * before.abs(), "{name}: {before} N, then {after} N");
    }
}

#[test]
fn a_turning_bearing_runs_under_every_law_and_returns_to_the_same_bits() {
    let names = ["shaft.y", "housing.force.x", "element[1].path", "element[2].force.outer", "cage.torque"];
    for name in SCENES {
        for law in [ContactLaw::Hertz, ContactLaw::Map, ContactLaw::Love] {
            let mut scene = without_inertia(shipped_as_it_is(name));
            scene.contact.law = law;
            // Grids inside the step are slow: few cells, and the passage of one edge.
            let of_law: &[&str] = match law {
                ContactLaw::Hertz => &SCENES,
                ContactLaw::Map => &["er16k-tb1", "er16k-inner", "nu205-inner"],
                ContactLaw::Love => &["er16k-tb1"],
            };
            if !of_law.contains(&name) {
                continue;
            }
            scene.contact.cells = (law == ContactLaw::Love).then_some([16, 8]);
            let rounds = if law == ContactLaw::Love { 4 } else { 20 };
            // Element 1 stands over the middle of what is damaged after 5 ms or before.
            scene.cage.initial_angle = -1.7;
            let [mut bearing, mut other] = [scene.clone(), scene].map(Named::started);
            for _ in 0..rounds {
                bearing.goes_on_alike(&mut other, names, 7.7e-4, 2);
                assert!(bearing.all(names).iter().all(|value| value.is_finite()), "{name}");
            }
        }
    }
}

/// A bearing so slow that its elements fall onto the inner ring, outside the load zone.
fn slow() -> Scene {
    let mut scene = without_inertia(shipped("6205-healthy"));
    scene.shaft_speed = std::f64::consts::TAU;
    scene.shaft.load = [0.0, -300.0];
    scene
}

#[test]
fn a_loose_element_snaps_from_one_raceway_to_the_other_where_its_weight_along_the_path_changes_its_sign() {
    let scene = slow();
    let radius = scene.bearing.outer_raceway_radius() - scene.bearing.element_radius();
    let cage = brinell::geometry::kinematics::frequencies(&scene.bearing, 0.0, 1.0).ftf * std::f64::consts::TAU;
    // g sin θ = R ω²
    let expected = (radius * cage * cage / 9.81).asin();
    let mut instants = Vec::new();
    for step in [1e-4, 1e-3] {
        let mut scene = scene.clone();
        // Element 1 comes up from below, out of the load zone before it is level.
        scene.cage.initial_angle = expected - 0.02;
        let mut bearing = Named::started(scene.clone());
        let names = ["element[1].path", "element[1].angle", "shaft.force.y", "housing.force.y", "shaft.y"];
        let mut before = bearing.all(names);
        let found = (0..(0.05 / step) as usize).find_map(|_| {
            bearing.run(step, 1);
            let after = bearing.all(names);
            let last = std::mem::replace(&mut before, after);
            (after[0] < -1e-6).then_some((last, after))
        });
        let (last, after) = found.unwrap();
        // It lay outside, and goes through the clearance at once; within the step in which it does.
        assert!(last[0] >= 0.0 && last[0] < 1e-7, "{last:?}");
        assert!(last[1] <= expected && expected <= after[1], "{last:?} {after:?} {expected}");
        // No force jumps by as much as a thousandth of a ball's weight, 2 g, beside what goes on anyway.
        for k in [2, 3] {
            assert!((after[k] - last[k]).abs() < 0.2, "{last:?} {after:?}");
        }
        instants.push(after[4]);
    }
    // Where the rings are does not depend on the communication step except for the tolerance.
    assert!((instants[0] - instants[1]).abs() < 1e-8, "{instants:?}");
}

#[test]
fn a_bearing_that_turns_slowly_answers_like_one_with_inertia() {
    // 1 Hz: all that moves is far below what elements do by themselves. Without weight: a ball that has fallen onto the
    // inner ring rattles as the gap closes before the load zone, ever faster, and moves the rings by 14 nm, by its
    // inertia alone.
    let mut scene = slow();
    (scene.gravity, scene.tolerance) = ([0.0; 2], 1e-7);
    let names = ["shaft.x", "shaft.y", "element[1].force.inner"];
    let run = |scene: Scene| Named::started(scene).course(names, 1e-3, 400);
    let mut full = scene.clone();
    full.bearing.element_inertia = ElementInertia::Full;
    let (none, full) = (run(scene), run(full));
    let size = |k: usize| {
        let mean = full.iter().map(|row| row[k]).sum::<f64>() / full.len() as f64;
        full.iter().map(|row| (row[k] - mean).abs()).fold(0.0, f64::max)
    };
    for k in 0..3 {
        let miss = none.iter().zip(&full).map(|(a, b)| (a[k] - b[k]).abs()).fold(0.0, f64::max);
        // Of the variation with the passing elements.
        assert!(miss < 2e-3 * size(k), "{k}: {miss:e} of {:e}", size(k));
    }
}

#[test]
fn a_step_without_inertia_allocates_nothing() {
    for name in SCENES {
        let mut bearing = Named::started(without_inertia(shipped(name)));
        bearing.run(1e-3, 5);
        let (result, allocations) = counting::counted(|| (0..40).try_for_each(|_| bearing.0.step(1e-3)));
        result.unwrap();
        assert_eq!(allocations, 0, "{name}");
    }
}

#[test]
fn elements_without_inertia_are_no_states_and_leave_nothing_to_the_implicit_method() {
    let mut bearing = Named::started(without_inertia(shipped("er16k-tb1")));
    // Two rings of x, y, vx, vy and a sensor.
    assert_eq!(bearing.0.equations().0.layout.count(), 10);
    bearing.0.set_method(Method::Rodas);
    bearing.run(1e-3, 20);
    assert_eq!(bearing.0.step_counts().implicit, 0);
}

#[test]
fn mean_forces_on_hosted_rings_do_not_depend_on_the_communication_step() {
    let run = |step: f64, count: usize| {
        let scene = without_inertia(shipped("er16k-tb1"));
        let scene = Scene { shaft: Ring::hosted(), housing: Ring::hosted(), sensors: Vec::new(), ..scene };
        let mut bearing = Named::started_with(scene, &[("shaft.y", -14e-6)]);
        bearing.course(["shaft.mean_force.y"], step, count).concat().iter().sum::<f64>() / count as f64
    };
    let [short, long] = [run(1e-5, 3000), run(3e-2, 1)];
    // Steps of 0.02 rad of the cage; where elements meet the spall they end on its knots.
    assert!((short - long).abs() < 1e-4 * short.abs(), "{short} N and {long} N");
    assert!(short.abs() > 50.0, "{short} N");
}

#[test]
fn a_film_is_refused_with_its_reason() {
    let scene = without_inertia(shipped("er16k-tb1-oil"));
    let error = scene.check().unwrap_err().to_string();
    assert!(error.contains("[film]") && error.contains("bearing.element_inertia"), "{error}");
}

#[test]
fn modes_and_stiffness_are_those_of_rings_on_elements_without_mass() {
    let scene = shipped("6205-healthy");
    let below = |scene: &Scene| -> Vec<[f64; 2]> {
        let modes = Assembly::new(scene, None, None).unwrap().modes(-1.5).unwrap().modes;
        let of = |mode: &Mode| [mode.undamped_frequency().unwrap_or(0.0), mode.damping_ratio().unwrap_or(0.0)];
        modes.iter().map(of).filter(|mode| mode[0] < 2000.0).collect()
    };
    let (full, none) = (below(&scene), below(&without_inertia(scene.clone())));
    assert!(full.len() == none.len() && full.len() >= 4, "{full:?} {none:?}");
    for ([a, damping_a], [b, damping_b]) in full.iter().zip(&none) {
        // Some balls of 2 g swing with rings of 3 and 7 kg; dampers to first order.
        assert!((a - b).abs() < 3e-3 * a && (damping_a - damping_b).abs() < 1e-2 * damping_a, "{full:?} {none:?}");
    }
    let [a, b] = [scene.clone(), without_inertia(scene)].map(|mut scene| {
        scene.shaft_speed = 0.0;
        Named::started(scene).get("shaft.stiffness.yy")
    });
    assert!((a - b).abs() < 1e-9 * a, "{a} {b}");
}

/// The housing's acceleration over some time (s) in the lowest bands is that of the full model, up to such a share.
fn has_the_accelerations_of_the_full_model(name: &str, time: f64, bands: usize, share: f64) {
    let [full, none] = measured::pair(&shipped(name), "housing.ay", time);
    for (low, high) in measured::BANDS.into_iter().take(bands) {
        let [a, b] = [&full, &none].map(|signal| measured::level(signal, low, high));
        assert!((a - b).abs() < share * a.max(1e-5), "{name}, {low} to {high} Hz: {a} and {b} m/s²");
    }
}

#[test]
fn healthy_bearings_have_the_accelerations_of_the_full_model_below_two_kilohertz() {
    for name in ["6205-healthy", "nu205-healthy"] {
        // The aim is 1 % below 2 kHz.
        has_the_accelerations_of_the_full_model(name, 0.2, 3, 0.01);
    }
}

#[test]
fn an_element_loses_its_load_over_a_spall_and_has_it_again_when_the_full_model_says() {
    let [full, none] = [shipped("er16k-tb1"), without_inertia(shipped("er16k-tb1"))].map(measured::events);
    // It leaves the raceway while it is pressed; with inertia it strikes the far edge before it is pressed again.
    assert!((full[0] - none[0]).abs() < 2e-5, "{full:?} {none:?}");
    assert!((full[1] - none[1]).abs() < 3e-4, "{full:?} {none:?}");
}

#[test]
fn a_spalled_bearing_has_the_accelerations_of_the_full_model_below_a_kilohertz() {
    has_the_accelerations_of_the_full_model("er16k-tb1", 0.3, 2, 0.05);
}
