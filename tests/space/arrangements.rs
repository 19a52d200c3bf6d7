//! Shoulders, and pairs on one rigid shaft.

use super::*;
use std::f64::consts::PI;

#[test]
fn shoulders_are_as_far_from_the_ellipses_ends_as_printed() {
    let of = |thrust: f64| {
        let height = Some(0.2 * 7.94e-3);
        let bearing = Bearing { shoulder_inner: height, shoulder_outer: height, ..b6205(10e-6) };
        let scene = free_shaft(bearing, DegreesOfFreedom::Three).gravity([0.0; 2]).axial_load(thrust);
        started(scene.build().unwrap())
    };
    let names = ["element[1].shoulder.inner", "element[1].shoulder.outer"];
    for (thrust, expected) in [(1000.0, "19.128144 19.521648"), (3000.0, "10.721279 11.258685")] {
        printed(&values(&mut of(thrust), names), PI / 180.0, expected);
    }
    // The inner ellipse just meets its shoulder.
    let mut meeting = of(8462.012);
    let [margin, angle] = values(&mut meeting, ["element[1].shoulder.inner", "element[1].contact_angle.inner"]);
    printed(&[angle], PI / 180.0, "29.281908");
    // The printed force to its last digit: 1e-3 N of 8 kN are 1e-8 rad.
    assert!(margin.abs() < 1e-8, "{margin:e}");
}

#[test]
fn an_ellipse_at_a_free_contact_angle_is_that_of_its_hertz_constant() {
    let height = Some(1.5e-3);
    let bearing = Bearing { shoulder_inner: height, shoulder_outer: height, ..angular(25.0) };
    let scene = free_shaft(bearing, DegreesOfFreedom::Three).gravity([0.0; 2]).axial_load(500.0);
    let margins = ["element[1].shoulder.inner", "element[1].shoulder.outer"];
    // θ_s − α − a₁ Q^(1/3)/r_g with the printed α and Q of that thrust, a₁ from Hertz's integrals by
    // arithmetic-geometric means at the curvatures ±cos α°/(½ D_pw ∓ r cos α°): 1.4726458e-4 and 1.1688585e-4
    // m/N^(1/3).
    printed(&values(&mut started(scene.build().unwrap()), margins), PI / 180.0, "14.677247 16.226334");
}

/// Force along z (N) and moment about x (N m) of one bearing on its ring, which a host holds.
fn held(way: f64, [y, z, tilt]: [f64; 3]) -> [f64; 3] {
    let mut bearing = Bearing { hertz_inner: Some(2.82515273e10), hertz_outer: Some(2.49580607e10), ..angular(25.0) };
    bearing.set_contact_angle(way * 25f64.to_radians());
    let scene = hosted_shaft(bearing, DegreesOfFreedom::Five).gravity([0.0; 2]).cage(0.0, -0.5 * PI);
    let place = [("shaft.y", y), ("shaft.z", z), ("shaft.tilt.x", tilt)];
    let mut found = started_with(Simulation::new(scene.build().unwrap(), None).unwrap(), &place);
    values(&mut found, ["shaft.force.y", "shaft.force.z", "shaft.moment.x"])
}

#[test]
fn a_preloaded_pair_carries_and_opens_as_printed() {
    const OFFSET: f64 = 5e-6;
    // Back to back the left bearing, with a positive angle, is closed by +5 µm, the right one by −5 µm.
    let external = |z: f64| -(held(1.0, [0.0, OFFSET + z, 0.0])[1] + held(-1.0, [0.0, z - OFFSET, 0.0])[1]);
    printed(&[-held(1.0, [0.0, OFFSET, 0.0])[1]], 1.0, "153.930271");
    printed(&[external(1e-6), external(3e-6)], 1.0, "95.417781 283.431470");
    // Where the right one has no force left.
    let opened = held(-1.0, [0.0, 0.0, 0.0])[1];
    assert!(opened.abs() < 1e-9, "{opened:e}");
    // The opening that is printed was sought to about 1e-12 m, at 1e8 N/m.
    let opening = external(OFFSET);
    assert!((opening - 457.88740).abs() < 1e-4, "{opening}");
    // Central differences of two steps, whose largest errors cancel.
    let over = |h: f64| (external(h) - external(-h)) / (2.0 * h);
    printed(&[(4.0 * over(1e-8) - over(2e-8)) / 3.0], 1e7, "9.55242");
}

#[test]
fn a_pair_resists_tilt_as_printed_back_to_back_and_face_to_face() {
    let tilt = 1e-4;
    // Centres 50 mm apart: at b the ring goes to y = −b φ, and its force has the lever b.
    let moment = |way: f64, offset: f64| {
        [(-25e-3, way, offset), (25e-3, -way, -offset)]
            .map(|(b, way, z)| {
                let [y, _, about_x] = held(way, [-b * tilt, z, tilt]);
                about_x - b * y
            })
            .iter()
            .sum::<f64>()
    };
    printed(&[-moment(1.0, 5e-6)], 1.0, "21.394603");
    printed(&[-moment(-1.0, -5e-6)], 1.0, "4.968967");
}
