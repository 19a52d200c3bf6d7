//! One map of a spall's flanks for spalls of any length.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, TAU};
use std::sync::Arc;

use crate::er16k::OUTER;
use crate::support::Named;
use brinell::contact::map::{ContactMaps, Flanks, MapSpecification, Sequential};
use brinell::scene::{Bearing, Scene};
use brinell::simulation::{Simulation, setup};
use brinell::surface::{Profile, Surface};

const LARGEST: f64 = 10e-6;

fn spall(length: f64, slope: f64) -> Surface {
    Surface::Profile(Profile::spall(length, 100e-6, slope))
}

fn specification() -> MapSpecification {
    MapSpecification { accuracy: 3e-3, ..MapSpecification::new(LARGEST) }
}

fn flanks(length: f64, slope: f64) -> Option<Flanks> {
    Flanks::of(&spall(length, slope), OUTER, specification())
}

#[test]
fn spalls_with_the_same_flanks_have_one_surface_to_the_bit_and_short_ones_none() {
    for slope in [FRAC_PI_2, FRAC_PI_6] {
        let of = |length: f64| flanks(length, slope);
        let shortest = (1..1000).map(|k| f64::from(k) * 1e-5).find(|&length| of(length).is_some()).unwrap();
        // Each flank reaches as far into the spall as an element needs to sink in, and as a contact is long.
        assert!((2e-3..4e-3).contains(&shortest), "{shortest}");
        let first = of(shortest).unwrap();
        for k in 1..300 {
            let length = shortest + f64::from(k) * 1.1e-5 / 3.0;
            let other = of(length).unwrap();
            assert_eq!(other.surface, first.surface, "{length}");
            let [before, behind] = other.moved;
            assert_eq!(before, -behind);
            assert!((0.0..length - shortest + 2e-5).contains(&(2.0 * behind)), "{behind}");
        }
        assert!(first.surface != flanks(shortest + 1e-3, 1.1 * FRAC_PI_6).unwrap().surface);
    }
}

#[test]
fn the_map_of_the_flanks_is_that_of_the_whole_spall_where_they_are() {
    let (length, build) = (6.517e-3, |surface: &Surface| crate::built(surface, OUTER, specification()));
    for slope in [FRAC_PI_2, FRAC_PI_6] {
        let Flanks { surface, moved } = flanks(length, slope).unwrap();
        let (whole, short) = (build(&spall(length, slope)), build(&surface));
        let full = LARGEST.powf(1.5);
        let mut largest = 0.0_f64;
        for i in -400..=400 {
            let s = f64::from(i) * 1e-5;
            // What is farther from its flank than the middle of the short floor is on a floor all the same.
            let on_short = if s < 0.0 { (s - moved[0]).min(0.0) } else { (s - moved[1]).max(0.0) };
            for path in [2e-6, 6e-6, 9e-6, 30e-6, 60e-6, 104e-6] {
                let forces = [(&whole, s), (&short, on_short)].map(|(map, s)| {
                    let found = map.lookup(path, s).ok().filter(|found| found.value < LARGEST);
                    found.map(|found| found.forces(crate::hertz).map(|force| force / full))
                });
                if let [Some(whole), Some(short)] = forces {
                    for (one, other) in whole.into_iter().zip(short) {
                        largest = largest.max((one - other).abs());
                    }
                }
            }
        }
        // Both may be wrong by 3e-3 of the largest force, and their cells are not equally long.
        assert!((1e-6..4e-3).contains(&largest), "{largest:e}");
    }
}

fn scene(length: f64, flank_map: bool) -> Scene {
    let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
    let scene =
        Scene::builder(bearing).shaft_load([0.0, -300.0]).shaft_speed(10.0 * TAU).spall(-FRAC_PI_2, length, 100e-6);
    let mut scene = scene.contact_cells([24, 12]).map_accuracy(0.02).largest_force(800.0).build().unwrap();
    scene.contact.flank_map = flank_map;
    scene
}

/// Accelerations of the housing over 80 ms, in which balls pass three edges.
fn run(scene: Scene, map: Option<&[u8]>) -> Vec<f64> {
    let mut bearing = Named(Simulation::with_map(scene, None, map).unwrap());
    bearing.0.initialize(0.0).unwrap();
    bearing.course(["housing.ay"], 1e-4, 800).concat()
}

#[test]
fn a_run_with_the_flanks_map_of_another_length_is_that_with_its_own() {
    let map = |scene: &Scene| {
        let surfaces = Surface::load_all(scene, None).unwrap();
        let needed = setup::needed_maps(scene, &surfaces).unwrap();
        assert_eq!(needed.len(), 1);
        (needed[0].fingerprint, needed[0].build(&mut Sequential(|_, _| ())).unwrap())
    };
    let (short, long) = (scene(4.2e-3, true), scene(6.1e-3, true));
    let (fingerprint, of_short) = map(&short);
    let (same, of_long) = map(&long);
    assert!(fingerprint == same && of_short == of_long);
    let bytes = ContactMaps::shared(vec![Arc::new(of_short)]).to_bytes();
    let found = run(long, Some(&bytes));
    let [own, longer] = [6.1e-3, 6.1001e-3].map(|length| run(scene(length, false), None));
    let rms = |values: &[f64]| (values.iter().map(|a| a * a).sum::<f64>() / values.len() as f64).sqrt();
    let apart = |other: &[f64]| rms(&own.iter().zip(other).map(|(a, b)| a - b).collect::<Vec<_>>());
    // Loose balls remember every difference: signals of spalls whose lengths differ by 0.1 µm are as far apart.
    let [found, longer] = [&found, &longer].map(|other| apart(other) / rms(&own));
    assert!(longer < 0.03 && found < 1.5 * longer, "{found} {longer}");
}
