//! Defects of the inner ring and of a ball at a contact angle.

use super::*;
use brinell::scene::{ContactLaw, Defect, DefectOn, DefectShape};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A spall of 0.5 mm under ball 1, which stands right below; it is met off its middle by `off` (rad of its body).
fn under_ball_one(on: DefectOn, off: f64) -> Defect {
    let shape = DefectShape::Spall { length: 0.5e-3, depth: 50e-6, edge_slope: FRAC_PI_2 };
    // A ball's defect counts from where it meets the outer raceway.
    let angle = if matches!(on, DefectOn::Element { .. }) { off } else { off - FRAC_PI_2 };
    Defect { on, angle, shape }
}

#[test]
fn the_mirror_image_of_a_defect_inside_or_on_a_ball_moves_as_the_mirror_image() {
    for on in [DefectOn::Inner, DefectOn::Element { element: 0, tilt: 0.0 }] {
        let of = |way: f64| {
            let mut bearing = angular(25.0);
            bearing.set_contact_angle(way * 25f64.to_radians());
            let scene = free_shaft(bearing, DegreesOfFreedom::Five).shaft_speed(TAU * 40.0).cage(0.0, -FRAC_PI_2);
            let scene = scene.shaft_load([0.0, -300.0]).axial_load(way * 400.0).law(ContactLaw::Hertz);
            let mut scene = scene.defect(under_ball_one(on, -0.03)).tolerance(1e-10).build().unwrap();
            scene.shaft.tilt.load_moment = [way * 0.4, way * -0.2];
            let mut simulation = started(scene);
            simulation.step(2e-3).unwrap();
            simulation
        };
        let (mut one, mut other) = (of(1.0), of(-1.0));
        let signals = [
            ("shaft.x", 1.0),
            ("shaft.y", 1.0),
            ("shaft.z", -1.0),
            ("shaft.tilt.x", -1.0),
            ("shaft.tilt.y", -1.0),
            ("shaft.ay", 1.0),
            ("element[1].path", 1.0),
            ("element[1].axial", -1.0),
            ("element[1].force.inner", 1.0),
            ("element[1].contact_angle.outer", -1.0),
        ];
        // Signs alone differ; roundings of 20 mm grow while the ball rattles over its defect.
        let off = |name: &str, size: f64| 1e-7 * (size + if name.ends_with("ay") { 1.0 } else { 1e-9 });
        are_mirror_images(&mut one, &mut other, &signals, off);
    }
}

#[test]
fn a_contact_inside_or_of_a_balls_defect_carries_by_map_what_law_love_says_and_less_than_on_smooth_raceways() {
    for (on, side) in [(DefectOn::Inner, "inner"), (DefectOn::Element { element: 0, tilt: 0.0 }, "outer")] {
        let of = |law: Option<ContactLaw>| {
            let mut scene = hosted_shaft(b6205_at_15_degrees(), DegreesOfFreedom::Five).cage(0.0, -FRAC_PI_2);
            if let Some(law) = law {
                scene = scene.defect(under_ball_one(on, 0.01)).law(law);
            }
            let scene = scene.contact_cells([24, 12]).map_accuracy(0.05).largest_force(600.0).build().unwrap();
            let place = [("shaft.y", -3e-6), ("shaft.z", 95e-6), ("shaft.tilt.x", 2e-4)];
            let mut simulation = started_with(Simulation::new(scene, None).unwrap(), &place);
            let force = format!("element[1].force.{side}");
            values(&mut simulation, [&force, "shaft.force.z", "shaft.moment.x", "element[5].force.outer"])
        };
        let [map, love] = [ContactLaw::Map, ContactLaw::Love].map(|law| of(Some(law)));
        let smooth = of(None);
        for (map, love) in map.into_iter().zip(love) {
            // The map's accuracy, 5 % of its forces at most; it keeps far better here.
            assert!((map / love - 1.0).abs() < 0.02, "{on:?}: {map} {love}");
        }
        assert!(love[0] < 0.95 * smooth[0], "{on:?}: {} of {}", love[0], smooth[0]);
        // A ball away from the defect does not know of it.
        assert!((love[3] / smooth[3] - 1.0).abs() < 1e-9, "{on:?}");
    }
}
