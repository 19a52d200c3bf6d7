//! What must hold whatever the figures are: energy, mirror, turning by one pitch, the plane, states put back.

use super::*;
use crate::support::Named;
use crate::support::differences::by_input;
use crate::support::energy::{energy, exchanged_and_lost};
use brinell::scene::{ContactLaw, Damping, Defect, DefectOn, DefectShape, ElementInertia};
use brinell::simulation::Method;
use std::f64::consts::{PI, TAU};

/// A 6205 in motion whose axial and radial load step.
fn lively(bearing: Bearing) -> SceneBuilder {
    let scene = free_shaft(bearing, DegreesOfFreedom::Three).shaft_speed(TAU * 40.0).cage(0.0, -1.3);
    scene.shaft_load([0.0, -300.0]).axial_load(250.0).law(ContactLaw::Hertz).tolerance(1e-10)
}

#[test]
fn energy_is_what_the_cage_has_put_in() {
    let mut shaft = Ring { damping: 0.0, ..Ring::default_shaft() };
    shaft.axial.damping = 0.0;
    let scene = lively(b6205(8e-6)).shaft(shaft).shaft_load([0.0, -300.0]).axial_load(250.0);
    let mut scene = scene.damping(Damping::HuntCrossley(0.0)).build().unwrap();
    scene.contact.across_damping = Some(0.0);
    let mut simulation = started(scene.clone());
    let [x, y, z] = [40.0, -250.0, 330.0];
    for (axis, load) in ["x", "y", "z"].iter().zip([x, y, z]) {
        simulation.set(&format!("shaft.load.{axis}"), load).unwrap();
    }
    (scene.shaft.load, scene.shaft.axial.load) = ([x, y], z);
    let [first, _] = energy(&mut simulation, &scene);
    let mut most = 0.0f64;
    let work = work_of_cage(&mut simulation, 1000, |simulation| most = most.max(energy(simulation, &scene)[1]));
    let [last, _] = energy(&mut simulation, &scene);
    assert!(most > 1e-6, "{most:e}");
    // Tolerance 1e-10 of an approach of 5 µm under 100 N, 5e-14 J, over a thousand steps that add up.
    assert!((last - first - work).abs() < 1e-6 * most, "{:e} of {most:e}", last - first - work);
}

#[test]
fn balls_pass_defects_of_a_tilted_inner_ring_and_of_their_own_without_loss() {
    let shape = DefectShape::Spall { length: 0.5e-3, depth: 50e-6, edge_slope: 0.5 * PI };
    for (on, angle) in [(DefectOn::Inner, -1.6), (DefectOn::Element { element: 0, tilt: 0.0 }, PI + 0.05)] {
        let scene = hosted_shaft(b6205_at_15_degrees(), DegreesOfFreedom::Five).shaft_speed(TAU * 40.0);
        let scene = scene.cage(0.0, -0.5 * PI).law(ContactLaw::Hertz).damping(Damping::HuntCrossley(0.0));
        let scene = scene.defect(Defect { on, angle, shape: shape.clone() }).tolerance(1e-9).gravity([0.0; 2]);
        let mut scene = scene.build().unwrap();
        scene.contact.across_damping = Some(0.0);
        let place = [("shaft.y", -4e-6), ("shaft.z", 90e-6), ("shaft.tilt.x", 3e-3), ("shaft.tilt.y", -1e-3)];
        let mut bearing = Named::started_with(scene.clone(), &place);
        let [moved, lost] = exchanged_and_lost(&mut bearing, &scene, 1e-7, 20_000);
        // The trapezoidal rule over some thousand steps of each edge; without the tilt's part a tenth would be missing.
        assert!(moved > 1e-6 && lost < 1e-5 * moved, "{on:?}: {lost:e} of {moved:e}");
    }
}

#[test]
fn no_ball_is_pushed_by_the_far_side_of_a_grooves_circle() {
    // In a 6205 the circles' centres come closer than l, 0.159 mm, to balls that the inner ring is too far away from.
    let of = |freedom| {
        let scene = Scene::builder(b6205(150e-6)).degrees_of_freedom(freedom).shaft(Ring::hosted());
        let scene = scene.housing(Ring::fixed()).shaft_speed(TAU * 30.0).law(ContactLaw::Hertz).tolerance(1e-9);
        started_with(Simulation::new(scene.build().unwrap(), None).unwrap(), &[("shaft.y", -85e-6)])
    };
    let (mut space, mut plane) = (of(DegreesOfFreedom::Three), of(DegreesOfFreedom::Two));
    for ball in 1..=9 {
        for (signal, limit) in [("path", 1e-15), ("force.inner", 1e-6), ("force.outer", 1e-6)] {
            let [found, expected] =
                [&mut space, &mut plane].map(|of| of.get(&format!("element[{ball}].{signal}")).unwrap());
            // Rounding of 20 mm, and what it is of a contact's stiffness.
            assert!((found - expected).abs() < limit, "{signal} of ball {ball}: {found:e}, in the plane {expected:e}");
        }
    }
    let steep = free_shaft(angular(60.0), DegreesOfFreedom::Three).shaft_load([0.0, -1500.0]).axial_load(800.0);
    let mut steep = started(steep.build().unwrap());
    for ball in 1..=12 {
        for side in ["inner", "outer"] {
            let angle = steep.get(&format!("element[{ball}].contact_angle.{side}")).unwrap().to_degrees();
            assert!(angle.abs() < 80.0, "ball {ball}, {side}: {angle} degrees");
        }
    }
}

#[test]
fn the_mirror_image_moves_as_the_mirror_image() {
    let of = |way: f64| {
        let mut bearing = angular(25.0);
        bearing.set_contact_angle(way * 25f64.to_radians());
        let scene = lively(bearing).axial_load(way * 250.0);
        let mut simulation = started(scene.build().unwrap());
        simulation.set("shaft.load.x", 50.0).unwrap();
        simulation.set("shaft.load.z", way * 300.0).unwrap();
        simulation.step(2e-3).unwrap();
        simulation
    };
    let (mut one, mut other) = (of(1.0), of(-1.0));
    let signals = [
        ("shaft.x", 1.0),
        ("shaft.y", 1.0),
        ("shaft.z", -1.0),
        ("element[2].path", 1.0),
        ("element[2].axial", -1.0),
        ("element[3].force.inner", 1.0),
        ("element[3].contact_angle.outer", -1.0),
        ("shaft.stiffness.xz", -1.0),
        ("shaft.stiffness.yy", 1.0),
    ];
    // Signs alone differ, and roundings with them where terms cancel.
    are_mirror_images(&mut one, &mut other, &signals, |_, size| 1e-12 * size + 1e-18);
}

#[test]
fn a_cage_turned_by_one_pitch_permutes_the_elements() {
    let of = |turned: f64| {
        let mut simulation = started(lively(b6205(8e-6)).cage(0.0, -1.3 + turned).build().unwrap());
        simulation.set("shaft.load.x", 50.0).unwrap();
        simulation.set("shaft.load.z", 300.0).unwrap();
        simulation.step(2e-3).unwrap();
        simulation
    };
    let (mut one, mut other) = (of(0.0), of(TAU / 9.0));
    for (name, turned, scale) in [
        ("shaft.y", "shaft.y", 1e-6),
        ("shaft.z", "shaft.z", 1e-6),
        ("element[4].path", "element[3].path", 1e-6),
        ("element[1].axial", "element[9].axial", 1e-6),
        ("element[2].force.inner", "element[1].force.inner", 100.0),
    ] {
        let (found, expected) = (one.get(name).unwrap(), other.get(turned).unwrap());
        // Angles of 1 rad round to 1e-16, forces to some 1e-14 a step.
        assert!((found - expected).abs() < 1e-9 * scale, "{name}: {found:e} {expected:e}");
    }
}

#[test]
fn without_axial_load_a_bearing_in_space_is_its_twin_in_the_plane() {
    let of = |freedom| {
        let mut shaft = Ring::default_shaft();
        if freedom == DegreesOfFreedom::Three {
            // Something must hold z.
            shaft.axial.stiffness = 1.0;
        }
        let scene = Scene::builder(b6205(5e-6)).degrees_of_freedom(freedom).shaft(shaft).shaft_speed(TAU * 30.0);
        let scene = scene.shaft_load([0.0, -800.0]).spall(-0.5 * PI, 0.6e-3, 50e-6).cage(0.0, -1.72);
        started(scene.law(ContactLaw::Hertz).tolerance(1e-9).build().unwrap())
    };
    let (mut space, mut plane) = (of(DegreesOfFreedom::Three), of(DegreesOfFreedom::Two));
    let names = ["shaft.x", "shaft.y", "housing.y", "element[1].path", "element[2].path"];
    for _ in 0..40 {
        for (found, expected) in values(&mut space, names).into_iter().zip(values(&mut plane, names)) {
            // The tolerance of an approach of 10 µm, over some hundred steps.
            assert!((found - expected).abs() < 1e-12, "{found:e} {expected:e}");
        }
        assert_eq!(values(&mut space, ["shaft.z", "element[1].axial", "shaft.force.z"]), [0.0; 3]);
        for simulation in [&mut space, &mut plane] {
            simulation.step(1e-4).unwrap();
        }
    }
}

#[test]
fn every_method_goes_the_same_way() {
    let of = |method| {
        let scene = lively(angular(25.0)).degrees_of_freedom(DegreesOfFreedom::Five).tolerance(1e-9);
        let mut scene = scene.damping(Damping::HuntCrossley(2.0)).build().unwrap();
        scene.shaft.tilt.load_moment = [0.4, 0.2];
        let mut simulation = started(scene);
        simulation.set_method(method);
        simulation.set("shaft.load.x", 50.0).unwrap();
        simulation.set("shaft.load.z", 400.0).unwrap();
        simulation.set("shaft.load_moment.y", -0.4).unwrap();
        simulation.step(1.5e-3).unwrap();
        values(&mut simulation, ["shaft.x", "shaft.y", "shaft.z", "shaft.tilt.x", "shaft.tilt.y", "element[3].axial"])
    };
    let expected = of(Method::DormandPrince);
    for method in [Method::PhaseFitted, Method::Rodas, Method::Automatic] {
        for (found, expected) in of(method).into_iter().zip(expected) {
            // 1e-9 of 5 µm a step; the error of a tilt is that over the pitch radius.
            assert!((found - expected).abs() < 2e-11 * (1.0 + 50.0 * f64::from(u8::from(expected.abs() > 1e-4))));
        }
    }
}

#[test]
fn a_state_put_back_goes_on_with_the_same_bits() {
    let mut scene = lively(b6205(8e-6)).degrees_of_freedom(DegreesOfFreedom::Five).tolerance(1e-6).build().unwrap();
    scene.shaft.tilt.load_moment = [0.4, 0.2];
    let [mut bearing, mut other] = [scene.clone(), scene].map(Named::started);
    bearing.set("shaft.load.z", 400.0);
    bearing.run(1e-3, 1);
    let names = ["shaft.x", "shaft.z", "shaft.tilt.x", "element[3].axial", "element[3].force.outer"];
    bearing.goes_on_alike(&mut other, names, 1e-3, 1);
}

#[test]
fn the_operating_angle_is_that_of_the_balance_and_moves_the_cage() {
    let thrust = free_shaft(b6205(5e-6), DegreesOfFreedom::Three).axial_load(1000.0).shaft_speed(TAU * 10.0);
    let mut found = started(thrust.gravity([0.0; 2]).build().unwrap());
    let [angle, contact] = values(&mut found, ["bearing.operating_angle", "element[1].contact_angle.inner"]);
    // A thousandth of a degree ends the search; centrifugal force at 10 Hz parts the angles by less.
    assert!((angle - contact).abs() < 5e-4 && (angle.to_degrees() - 18.167).abs() < 0.02, "{angle} {contact}");
    let gamma = 7.94 / 39.04 * angle.cos();
    let cage = found.get("cage.speed").unwrap();
    assert!((cage / (0.5 * TAU * 10.0 * (1.0 - gamma)) - 1.0).abs() < 1e-13);
    let mut shaft = Ring::default_shaft();
    shaft.axial.stiffness = 1e3;
    let radial = free_shaft(b6205(5e-6), DegreesOfFreedom::Three).shaft(shaft).shaft_load([0.0, -500.0]);
    assert_eq!(started(radial.build().unwrap()).get("bearing.operating_angle").unwrap(), 0.0);
}

#[test]
fn balls_without_inertia_follow_those_with_inertia_where_nothing_rings() {
    let of = |inertia, damping| {
        let bearing = Bearing { element_inertia: inertia, ..b6205(8e-6) };
        let scene = lively(bearing).degrees_of_freedom(DegreesOfFreedom::Five).tolerance(1e-8);
        let mut scene = scene.damping(Damping::HuntCrossley(damping)).build().unwrap();
        scene.shaft.tilt.load_moment = [0.4, 0.2];
        started(scene)
    };
    let names = ["shaft.y", "shaft.z", "shaft.tilt.x", "element[2].path", "element[2].axial", "element[2].force.inner"];
    let scales = [1e-6, 1e-6, 1e-4, 1e-6, 1e-6, 100.0];
    // Without damping, whose rates are those of the path in balance, the start is one and the same.
    let (mut full, mut none) = (of(ElementInertia::Full, 0.0), of(ElementInertia::None, 0.0));
    for ((found, expected), scale) in values(&mut none, names).into_iter().zip(values(&mut full, names)).zip(scales) {
        assert!((found - expected).abs() < 1e-8 * scale, "{found:e} {expected:e}");
    }
    let (mut full, mut none) = (of(ElementInertia::Full, 0.5), of(ElementInertia::None, 0.5));
    for simulation in [&mut full, &mut none] {
        simulation.set("shaft.load.z", 300.0).unwrap();
        simulation.step(4e-3).unwrap();
    }
    // Inertia of 9 balls of 2 g beside 3.3 kg: half a per cent of what moves, some hundredths of a micrometre.
    for ((found, expected), scale) in values(&mut none, names).into_iter().zip(values(&mut full, names)).zip(scales) {
        assert!((found - expected).abs() < 0.05 * scale, "{found:e} {expected:e}");
    }
}

#[test]
fn balls_without_inertia_have_the_directional_derivatives_of_differences() {
    let bearing = Bearing { element_inertia: ElementInertia::None, ..b6205(8e-6) };
    let scene = hosted_shaft(bearing, DegreesOfFreedom::Five).shaft_speed(TAU * 40.0).law(ContactLaw::Hertz);
    let place = [("shaft.y", -2e-6), ("shaft.z", 90e-6), ("shaft.tilt.x", 3e-4), ("shaft.vz", 1e-3)];
    let scene = scene.cage(0.0, -1.3).build().unwrap();
    let mut simulation = started_with(Simulation::new(scene, None).unwrap(), &place);
    let names = ["shaft.force.z", "shaft.moment.x", "element[2].force.outer", "element[2].axial", "element[3].path"];
    for ((input, _), h) in place.into_iter().zip([1e-9, 1e-9, 1e-7, 1e-5]) {
        for (slope, name) in by_input(&mut simulation, &names, input, h).iter().zip(names) {
            let limit = 1e-4 * slope.largest() + 1e-10 * slope.size / h;
            assert!(slope.miss() <= limit, "{name} by {input}: {slope:?}");
        }
    }
}

#[test]
fn what_is_not_modelled_in_space_is_refused_by_name() {
    let film = brinell::scene::Film { viscosity: 0.05, pressure_viscosity: 2e-8, layer: None };
    let scene = lively(b6205(8e-6)).film(film).build().unwrap();
    let refused = Simulation::new(scene, None).unwrap_err().to_string();
    assert!(refused.contains("[film]") && refused.contains("degrees_of_freedom = 2"), "{refused}");
}

#[test]
fn rings_pushed_beyond_their_grooves_stop_the_step_with_the_reason() {
    let mut simulation = started(hosted_shaft(b6205(8e-6), DegreesOfFreedom::Five).build().unwrap());
    // A of a 6205 is 0.3176 mm.
    let refused = simulation.set("shaft.z", 0.4e-3).unwrap_err().to_string();
    assert!(refused.contains("shaft.z") && refused.contains("0.0004") && refused.contains("0.0003176"), "{refused}");
    simulation.set("shaft.vz", 10.0).unwrap();
    let refused = simulation.step(1e-4).unwrap_err().to_string();
    assert!(refused.contains("along z") && refused.contains("3.176e-4 m"), "{refused}");
    assert!(simulation.set("shaft.tilt.x", 0.06).unwrap_err().to_string().contains("0.05"));
}

#[test]
fn under_every_law_a_ball_over_a_line_spall_carries_about_the_same() {
    let of = |law| {
        let scene = hosted_shaft(b6205_at_15_degrees(), DegreesOfFreedom::Three).cage(0.0, -0.5 * PI + 0.01);
        let scene = scene.spall(-0.5 * PI, 0.5e-3, 50e-6).law(law);
        let scene = scene.contact_cells([24, 12]).map_accuracy(0.05).largest_force(600.0).build().unwrap();
        let place = [("shaft.y", -3e-6), ("shaft.z", 95e-6)];
        let mut simulation = started_with(Simulation::new(scene, None).unwrap(), &place);
        let names =
            ["element[1].force.outer", "element[1].contact_angle.outer", "shaft.force.z", "element[5].force.outer"];
        values(&mut simulation, names)
    };
    let [hertz, map, love] = [ContactLaw::Hertz, ContactLaw::Map, ContactLaw::Love].map(of);
    for (map, love) in map.into_iter().zip(love) {
        // The map's own accuracy, of the largest force.
        assert!((map - love).abs() < 0.05 * 600.0 && (map / love - 1.0).abs() < 0.02, "{map} {love}");
    }
    // The rigid ball's contact at an edge is a sixth too stiff at most.
    for (rigid, love) in hertz.into_iter().zip(love) {
        assert!((rigid / love - 1.0).abs() < 0.2, "{rigid} {love}");
    }
    // Fifteen micrometres within the edge it has lost next to nothing of its approach, and much of its ground.
    assert!(love[0] < 0.95 * hertz[0], "{hertz:?} {love:?}");
}
