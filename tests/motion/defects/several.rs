//! Several defects of one bearing: on one body or on several, far apart or under one envelope.

use crate::support::Named;
use crate::support::defects::{held, spall};
use brinell::contact::map::{ContactMaps, Sequential};
use brinell::scene::{ContactLaw, Defect, DefectOn, DefectShape, Scene};
use brinell::simulation::{Simulation, setup};
use brinell::surface::Surface;
use std::f64::consts::{FRAC_PI_2, PI};

/// ER16K with these defects under law `hertz`, its outer ring held.
fn bearing(defects: Vec<Defect>) -> Scene {
    Scene { defects, ..held(Defect::outer(0.0, spall(1e-3, 1e-4))) }
}

/// A spall of an element that faces the outer raceway at the start of its turn.
fn on(element: usize, length: f64, depth: f64) -> Defect {
    Defect { on: DefectOn::Element { element, tilt: 0.0 }, ..Defect::outer(0.0, spall(length, depth)) }
}

/// Angle (rad) of an arc (m) of the outer raceway.
fn arc(length: f64) -> f64 {
    length / bearing(Vec::new()).bearing.outer_raceway_radius()
}

/// Shaft, paths and outer forces over some milliseconds.
fn course(mut bearing: Named, count: usize) -> Vec<[f64; 20]> {
    let of_elements = (1..=9).flat_map(|j| ["path", "force.outer"].map(|what| format!("element[{j}].{what}")));
    let names: Vec<String> = ["shaft.x", "shaft.y"].map(str::to_owned).into_iter().chain(of_elements).collect();
    let names: [&str; 20] = std::array::from_fn(|k| &*names[k]);
    bearing.course(names, 1e-4, count)
}

#[test]
fn defects_far_apart_have_the_paths_that_each_has_alone() {
    let [one, other] = [(-FRAC_PI_2, 0.8e-3, 30e-6), (0.4, 1.5e-3, 80e-6)]
        .map(|(angle, length, depth)| Defect::outer(angle, spall(length, depth)));
    let path = |defects: Vec<Defect>, at: f64| {
        let named = Named::started(bearing(defects));
        named.0.equations().0.resting_path(0, at)
    };
    for (defect, half) in [(&one, 0.02), (&other, 0.04)] {
        let mut deepest = 0.0f64;
        for k in -20..=20 {
            let at = defect.angle + half * f64::from(k) / 20.0;
            let together = path(vec![one.clone(), other.clone()], at);
            assert_eq!(together, path(vec![defect.clone()], at), "{at}");
            deepest = deepest.max(together);
        }
        assert!(deepest > 1e-5, "{deepest}");
    }
}

#[test]
fn defects_close_together_are_one_profile() {
    // An element rolls over both edges of the ridge of 0.5 mm between two spalls.
    let (length, gap, depth) = (1.2e-3, 0.5e-3, 60e-6);
    let spalls = [-0.5 * (length + gap), 0.5 * (length + gap)]
        .map(|middle| Defect::outer(-FRAC_PI_2 + arc(middle), spall(length, depth)));
    let edges = [-length - 0.5 * gap, -0.5 * gap, 0.5 * gap, 0.5 * gap + length];
    let mut text = "arc_mm,depth_um\n".to_owned();
    for (k, edge) in edges.into_iter().enumerate() {
        // A trace has one depth at an arc: a nanometre for an edge.
        let (before, after) = if k % 2 == 0 { (0.0, depth) } else { (depth, 0.0) };
        for (shift, depth) in [(-0.5e-9, before), (0.5e-9, after)] {
            text += &format!("{:.9},{}\n", (edge + shift) * 1e3, depth * 1e6);
        }
    }
    let traced = bearing(vec![Defect::outer(-FRAC_PI_2, DefectShape::Profile("ridge.csv".into()))]);
    let mut one = Named(Simulation::new(traced, Some(text.as_str())).unwrap());
    one.0.initialize(0.0).unwrap();
    let [a, b] = spalls;
    let [one, both, swapped] =
        [one, Named::started(bearing(vec![a.clone(), b.clone()])), Named::started(bearing(vec![b, a]))]
            .map(|bearing| course(bearing, 150));
    // In whatever order they are named.
    assert_eq!(both, swapped);
    let mut most = 0.0f64;
    for (one, both) in one.iter().zip(&both) {
        for k in (2..20).step_by(2) {
            most = most.max(both[k]);
            // Half a nanometre of arc on paths that rise by a quarter of their arc at most.
            assert!((one[k] - both[k]).abs() < 5e-10, "{} {}", one[k], both[k]);
        }
    }
    assert!(most > 2e-5, "{most}");
}

#[test]
fn defects_close_together_are_all_there_if_they_reach_more_than_half_way_around() {
    // 10 µm deep, three of 80° with ridges of 3° between them, from 0° on.
    let (long, ridge) = (80f64.to_radians(), 3f64.to_radians());
    let length = long / arc(1.0);
    let middles = [0.0, 1.0, 2.0].map(|k| 0.5 * long + k * (long + ridge));
    let spalls = || middles.map(|middle| Defect::outer(middle, spall(length, 10e-6))).to_vec();
    for turned in 0..3 {
        let mut scene = bearing(spalls());
        scene.defects.rotate_left(turned);
        // So large a contact that it would feel both sides of a ridge.
        scene.contact.largest_force = Some(2e4);
        let named = Named::started(scene);
        for middle in middles {
            for part in [-0.4, 0.0, 0.4] {
                let path = named.0.equations().0.resting_path(0, middle + part * long);
                assert!((path - 10e-6).abs() < 1e-12, "{path:e} m at {part} of the one at {middle}");
            }
        }
        let smooth = named.0.equations().0.resting_path(0, -1.0);
        assert!(smooth.abs() < 1e-15, "{smooth:e}");
    }
}

#[test]
fn the_order_in_which_defects_are_named_changes_no_bit() {
    let defects = vec![
        Defect::outer(-FRAC_PI_2, spall(0.8e-3, 40e-6)),
        Defect::inner(-1.2, spall(0.6e-3, 40e-6)),
        Defect { angle: 0.5, ..on(3, 0.5e-3, 30e-6) },
        Defect::outer(1.0, spall(0.4e-3, 20e-6)),
    ];
    let mut turned = defects.clone();
    turned.reverse();
    let [one, other] = [defects, turned].map(|defects| course(Named::started(bearing(defects)), 100));
    assert_eq!(one, other);
}

#[test]
fn one_table_among_several_is_the_table_alone() {
    let text = include_str!("../../../scenes/er16k-inner.toml");
    assert!(text.contains("\n[defect]\n"));
    let several = brinell_scene_file::from_toml(&text.replace("\n[defect]\n", "\n[[defect]]\n")).unwrap();
    assert_eq!(several, brinell_scene_file::from_toml(text).unwrap());
}

#[test]
fn an_angle_set_by_the_host_is_the_scenes_own() {
    let defects = |angle| vec![Defect::outer(-FRAC_PI_2, spall(0.8e-3, 4e-5)), Defect::inner(angle, spall(6e-4, 4e-5))];
    let mut set = Named::new(bearing(defects(0.3)));
    set.0.set("defect[2].angle", -1.2).unwrap();
    assert!(set.0.reference("defect.angle").is_err());
    set.0.initialize(0.0).unwrap();
    assert_eq!(course(set, 60), course(Named::started(bearing(defects(-1.2))), 60));
    // Into one another: refused with both numbers, when the model is built.
    let mut set =
        Named::new(bearing(vec![Defect::outer(0.0, spall(1e-3, 4e-5)), Defect::outer(1.0, spall(1e-3, 4e-5))]));
    set.0.set("defect[2].angle", 0.02).unwrap();
    let message = set.0.initialize(0.0).unwrap_err().to_string();
    assert!(message.contains("numbers 1 and 2") && message.contains("-0.5"), "{message}");
}

#[test]
fn overlaps_and_topographies_too_close_are_refused_with_their_numbers() {
    let beside = |gap: f64, shape: DefectShape| {
        vec![Defect::outer(PI, spall(1e-3, 4e-5)), Defect::outer(PI + arc(1e-3 + gap), shape)]
    };
    let refusal = |defects: Vec<Defect>, law, text: Option<&str>| {
        let mut scene = bearing(defects);
        scene.contact.law = law;
        Simulation::new(scene, text).map(|_| ()).map_err(|error| error.to_string())
    };
    let hertz = |gap| refusal(beside(gap, spall(1e-3, 4e-5)), ContactLaw::Hertz, None);
    let message = hertz(-0.1e-3).unwrap_err();
    assert!(
        message.contains("numbers 1 and 2") && message.contains("-0.1") && message.contains("0.001 mm"),
        "{message}"
    );
    assert!(hertz(0.5e-6).is_err());
    assert_eq!(hertz(2e-6), Ok(()));
    // Elements and rings are bodies of their own.
    let on = |element| on(element, 1e-3, 4e-5);
    let apart = vec![on(0), on(1), Defect::inner(0.0, spall(1e-3, 4e-5)), Defect::outer(0.0, spall(1e-3, 4e-5))];
    assert_eq!(refusal(apart, ContactLaw::Hertz, None), Ok(()));
    assert!(refusal(vec![on(1), on(1)], ContactLaw::Hertz, None).unwrap_err().contains("numbers 1 and 2"));

    let text = "arc_mm,axial_mm,depth_um\n-0.5,-1,10\n-0.5,1,10\n0.5,-1,20\n0.5,1,30\n";
    let topography = DefectShape::Profile("pit.csv".into());
    let message = refusal(beside(0.3e-3, topography.clone()), ContactLaw::Map, Some(text)).unwrap_err();
    assert!(message.contains("number 2 is a topography and number 1"), "{message}");
    assert_eq!(refusal(beside(12e-3, topography), ContactLaw::Map, Some(text)), Ok(()));
}

#[test]
fn bodies_with_the_same_profile_share_their_contact_maps() {
    let on = |element, length| on(element, length, 2e-6);
    let maps = |defects| {
        let mut scene = bearing(defects);
        scene.contact.law = ContactLaw::Map;
        (scene.contact.cells, scene.contact.map_accuracy) = (Some([16, 12]), Some(2e-2));
        scene.contact.largest_force = Some(300.0);
        let surfaces = Surface::load_all(&scene, None).unwrap();
        let maps = setup::build_map(&scene, &surfaces, &mut Sequential(|_, _| {})).unwrap().unwrap();
        let bytes = maps.to_bytes();
        assert_eq!(ContactMaps::decode(&bytes).unwrap(), maps);
        let stored = Simulation::with_map(scene, None, Some(&bytes)).unwrap();
        (maps.count(), stored)
    };
    let (count, mut two) = maps(vec![on(0, 0.2e-3), on(4, 0.2e-3)]);
    // Inner and outer raceway.
    assert_eq!(count, 2);
    two.initialize(0.0).unwrap();
    two.step(1e-3).unwrap();
    assert_eq!(maps(vec![on(0, 0.2e-3), on(4, 0.2e-3), Defect::inner(0.1, spall(0.2e-3, 2e-6))]).0, 2);
    assert_eq!(maps(vec![on(0, 0.2e-3), on(4, 0.25e-3)]).0, 4);
}
