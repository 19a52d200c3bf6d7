//! Elements of unequal size: load distributions against an independent computation, energy, lines of a spectrum.

use crate::support::Named;
use crate::support::defects::spall;
use crate::support::energy::exchanged_and_lost;
use crate::support::loaded::{TURNS, lines, loaded, preloaded, start};
use brinell::contact::near_defect::LoveSolvers;
use brinell::dynamics::parameters::SMOOTH;
use brinell::geometry::hertz_constant::HertzConstants;
use brinell::scene::{Bearing, ContactLaw, Damping, Defect, DrawnDiameters, ElementInertia, Ring, Scene};
use brinell::simulation::setup::build_model;
use brinell::surface::Surface;
use std::f64::consts::FRAC_PI_2;

/// With some elements larger: their numbers, from 1, and by how much (m).
fn with(mut scene: Scene, larger: &[(usize, f64)]) -> Scene {
    scene.bearing.diameter_offsets = vec![0.0; scene.bearing.element_count];
    larger.iter().for_each(|&(element, by)| scene.bearing.diameter_offsets[element - 1] = by);
    scene
}

/// Energy minimized, exact geometry: an independent computation, to the digits that it was printed with.
#[test]
fn load_distributions_are_those_of_an_independent_computation() {
    for inertia in [ElementInertia::Full, ElementInertia::None] {
        for (larger, expected) in [
            (&[][..], [0.0, -14.679_152_5, 278.826_18, 144.419_55, 144.419_55]),
            (&[(1, 1e-6)], [0.0, -14.152_727_4, 299.896_44, 130.659_43, 130.659_43]),
            (&[(1, -1e-6)], [0.0, -15.190_798_9, 257.685_16, 158.226_21, 158.226_21]),
            (&[(2, 1e-6)], [-0.782_061_4, -14.357_766_4, 265.054_24, 153.396_96, 153.424_70]),
        ] {
            let mut scene = with(loaded(), larger);
            scene.bearing.element_inertia = inertia;
            let found = start(scene);
            for (k, (found, expected)) in found.into_iter().zip(expected).enumerate() {
                let digits = if k < 2 { 6e-8 } else { 6e-6 };
                assert!((found - expected).abs() < digits, "{larger:?}, {inertia:?}: {k}: {found} for {expected}");
            }
        }
    }
}

#[test]
fn hertz_constants_of_a_larger_ball_are_of_its_own_radius_in_the_same_grooves() {
    let larger = loaded().bearing.with_elements_larger(1e-6);
    let HertzConstants { inner, outer } = HertzConstants::of(&larger);
    // The digits of the independent computation.
    assert!((inner / 2.547_862_73e10 - 1.0).abs() < 3e-9 && (outer / 2.699_924_59e10 - 1.0).abs() < 3e-9);
    let nominal = loaded().bearing;
    let moved = |of: fn(&Bearing) -> f64| (of(&larger) - of(&nominal)).abs();
    assert!(moved(Bearing::outer_raceway_radius) < 1e-17 && moved(Bearing::inner_raceway_radius) < 1e-17);
    let heavier = larger.mass_of_element() / nominal.mass_of_element();
    assert!((heavier - (1.0f64 + 1e-6 / 7.94e-3).powi(3)).abs() < 1e-14, "{heavier}");
}

#[test]
fn elements_listed_as_equal_are_those_of_a_bearing_without_the_list() {
    let run = |scene: Scene| {
        let mut bearing = Named::started(Scene { shaft_speed: 60.0, ..scene });
        bearing.run(1e-4, 100);
        bearing.all(["shaft.y", "element[3].path", "cage.torque"])
    };
    for (a, b) in run(loaded()).into_iter().zip(run(with(loaded(), &[]))) {
        // Another compiled form of the same sums.
        assert!((a - b).abs() < 1e-9 * a.abs(), "{a} {b}");
    }
}

#[test]
fn energy_goes_nowhere_but_into_the_turning_cage() {
    let mut scene = with(loaded(), &[(1, 2e-6), (4, -1e-6), (5, 0.5e-6), (9, -2e-6)]);
    (scene.contact.damping, scene.shaft.damping) = (Damping::HuntCrossley(0.0), 0.0);
    (scene.tolerance, scene.gravity, scene.shaft_speed) = (1e-9, [3.0, -9.81], 100.0);
    // Not a balance: the shaft swings.
    let mut bearing = Named::started(Scene { shaft: Ring { load: [200.0, -500.0], ..scene.shaft }, ..scene.clone() });
    bearing.run(1e-5, 10);
    scene.shaft.load = [200.0, -500.0];
    let [moved, lost] = exchanged_and_lost(&mut bearing, &scene, 2e-6, 3000);
    assert!(moved > 1e-6 && lost < 1e-4 * moved, "{lost:e} J of {moved:e} J are lost");
}

#[test]
fn a_larger_ball_comes_round_with_the_cage() {
    let [_, cage, _] = TURNS;
    let [equal, larger] = [preloaded(), with(preloaded(), &[(3, 0.2e-6)])].map(|scene| lines(scene, [cage, 5, 7]));
    assert!(equal.iter().all(|line| *line < 1e-6), "{equal:?}");
    // K δ^(3/2) of both contacts in series, δ the preload.
    let bearing = preloaded().bearing;
    let stiffness = HertzConstants::of(&bearing).in_series();
    let expected = 1.5 * stiffness * 5e-6f64.sqrt() * 0.2e-6;
    assert!((larger[0] / expected - 1.0).abs() < 0.03, "{larger:?} {expected}");
    assert!(larger[1].max(larger[2]) < 1e-3 * larger[0], "{larger:?}");
}

#[test]
fn rollers_of_unequal_size_keep_their_constants_and_share_the_load_by_their_diameters() {
    let mut scene = loaded();
    scene.bearing = Bearing::steel_rollers(13, 7.5e-3, 9e-3, 38.5e-3);
    let [_, y, equal, ..] = start(scene.clone());
    let [_, higher, larger, ..] = start(with(scene, &[(1, 1e-6)]));
    assert!(higher > y + 0.1 && larger > equal + 20.0, "{y} {higher} µm, {equal} {larger} N");
}

#[test]
fn drawn_diameters_are_the_seeds_and_have_their_root_mean_square() {
    let drawn = |seed| {
        let mut bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
        bearing.draw_diameters(DrawnDiameters { rms: 0.3e-6, seed });
        bearing.diameter_offsets
    };
    assert_eq!(drawn(7), drawn(7));
    assert_ne!(drawn(7), drawn(8));
    let drawn = drawn(7);
    let rms = (drawn.iter().map(|x| x * x).sum::<f64>() / 9.0).sqrt();
    assert!((rms / 0.3e-6 - 1.0).abs() < 1e-12 && drawn.iter().sum::<f64>().abs() < 1e-20);
    // Not those of the cage's spacing.
    let cage = brinell::scene::CageIrregularity::drawn_offsets(9, 0.3e-6, 7);
    assert!(drawn.iter().zip(&cage).all(|(a, b)| (a - b).abs() > 1e-12));
}

#[test]
fn near_a_defect_a_nominal_ball_stands_for_one_a_micrometre_larger() {
    // Equivalent approaches over a spall's edge and floor, solved on a grid for either ball.
    let path = 10e-6;
    let forces = |bearing: Bearing| -> Vec<f64> {
        let mut scene = loaded();
        scene.bearing = bearing;
        scene.defects = vec![Defect::outer(-FRAC_PI_2, spall(0.8e-3, 50e-6))];
        (scene.contact.law, scene.contact.cells) = (ContactLaw::Love, Some([24, 16]));
        let surfaces = Surface::load_all(&scene, None).unwrap();
        let defects = build_model(&scene, &surfaces, None).unwrap().outer.defects;
        let mut solvers = LoveSolvers::default();
        let mut at = |degrees: f64| {
            let direction = -FRAC_PI_2 + degrees.to_radians();
            let cell = defects.cell_at(direction);
            assert_ne!(cell, SMOOTH);
            let found = defects.approach(cell, path, direction, 19.5e-3, false, &mut solvers).unwrap();
            (found.value.max(0.0) / path).powf(1.5)
        };
        (0..13).map(|k| at(0.1 * f64::from(k))).collect()
    };
    let nominal = loaded().bearing;
    let [equal, larger] = [nominal.clone(), nominal.with_elements_larger(1e-6)].map(forces);
    let most = equal.iter().zip(&larger).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max);
    let range = equal.iter().fold([1.0f64, 0.0], |[least, most], &force| [least.min(force), most.max(force)]);
    assert!(range[0] < 0.6 && range[1] > 0.9, "{range:?} of the force on the smooth raceway");
    // 9e-5 here.
    assert!(most > 1e-6 && most < 2e-4, "{most:e} of the force on the smooth raceway");
}
