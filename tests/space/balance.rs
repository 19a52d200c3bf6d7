//! Static balances against printed figures.

use super::*;
use std::f64::consts::PI;

/// Tangent stiffness k_zz, k_xx, k_φφ, k_x,φy.
const STIFFNESS: [&str; 4] =
    ["shaft.stiffness.zz", "shaft.stiffness.xx", "shaft.stiffness.tilt_x_tilt_x", "shaft.stiffness.x_tilt_y"];

#[test]
fn a_6205_under_thrust_stands_where_the_closed_form_says() {
    // sin α (cos α°/cos α − 1)^(3/2) = F_a/(Z K A^(3/2)), to the printed digits.
    let table = [
        (5e-6, 100.0, "71.4933267 12.8822995 49.837015", "1.22180161e7 1.04110770e8 2.36084043e3 -4.65359306e5"),
        (5e-6, 1000.0, "102.5763280 18.1666934 356.373633", "4.98270429e7 1.90903019e8 9.61543129e3 -1.20110598e6"),
        (10e-6, 1000.0, "114.3944804 20.3998471 318.763105", "5.70862695e7 1.79077401e8 1.10213806e4 -1.27825119e6"),
    ];
    for (clearance, thrust, place, stiffness) in table {
        let scene = free_shaft(b6205(clearance), DegreesOfFreedom::Five).gravity([0.0; 2]).axial_load(thrust);
        let mut found = started(scene.build().unwrap());
        let [z, angle, force] =
            values(&mut found, ["shaft.z", "element[1].contact_angle.inner", "element[1].force.inner"]);
        printed(&[z * 1e6, angle.to_degrees(), force], 1.0, place);
        printed(&values(&mut found, STIFFNESS), 1.0, stiffness);
    }
}

#[test]
fn a_6205_under_combined_load_stands_as_printed_with_its_tilt_held_and_free() {
    let of = |freedom| {
        let bearing = Bearing { hertz_inner: Some(2.5448e10), hertz_outer: Some(2.6967e10), ..b6205(5e-6) };
        let scene = free_shaft(bearing, freedom).gravity([0.0; 2]).shaft_load([0.0, -500.0]).axial_load(300.0);
        started(scene.cage(0.0, -0.5 * PI).build().unwrap())
    };
    let mut held = of(DegreesOfFreedom::Three);
    printed(&values(&mut held, ["shaft.y", "shaft.z"]), 1e-6, "-3.6623573 82.0666839");
    printed(&values(&mut held, ["element[1].force.inner", "element[5].force.inner"]), 1.0, "255.71423 31.57225");
    printed(&values(&mut held, ["element[1].contact_angle.outer"]), PI / 180.0, "14.54680");
    // What a guide must hold: the bearing's moment on the ring.
    printed(&values(&mut held, ["shaft.moment.x"]), 1.0, "2.5470574");
    let mut free = of(DegreesOfFreedom::Five);
    printed(&values(&mut free, ["shaft.y", "shaft.z"]), 1e-6, "-14.2328408 79.7538039");
    printed(&values(&mut free, ["shaft.tilt.x"]), 1e-3, "2.2385996");
    let forces = ["element[1].force.inner", "element[4].force.inner", "element[5].force.inner"];
    printed(&values(&mut free, forces), 1.0, "343.74200 84.99883 109.13722");
    let angles = ["element[1].contact_angle.inner", "element[5].contact_angle.inner"];
    printed(&values(&mut free, angles), PI / 180.0, "6.36404 21.92412");
}

#[test]
fn an_angular_contact_bearing_has_the_printed_balance_and_tangent() {
    let mut scene = free_shaft(angular(25.0), DegreesOfFreedom::Five)
        .gravity([0.0; 2])
        .shaft_load([0.0, -200.0])
        .axial_load(500.0)
        .cage(0.0, -0.5 * PI)
        .build()
        .unwrap();
    scene.shaft.tilt.load_moment = [0.5, 0.0];
    let mut found = started(scene);
    printed(&values(&mut found, ["shaft.y", "shaft.z"]), 1e-6, "-21.6935185 6.8944875");
    printed(&values(&mut found, ["shaft.tilt.x"]), 1e-3, "2.1967200");
    let names = ["x", "y", "z", "tilt_x", "tilt_y"];
    let expected = [
        ["1.3279508e8", "0", "0", "0", "-1.2203660e6"],
        ["", "1.5975606e8", "1.1919645e7", "1.4265e6", "0"],
        ["", "", "7.4372046e7", "3.6895e5", "0"],
        ["", "", "", "1.5271644e4", "0"],
        ["", "", "", "", "1.2279294e4"],
    ];
    for (row, a) in names.iter().enumerate() {
        for (column, b) in names.iter().enumerate().skip(row) {
            let between = if row > 2 || column > 2 { "_" } else { "" };
            let value = found.get(&format!("shaft.stiffness.{a}{between}{b}")).unwrap();
            match expected[row][column] {
                // What vanishes by symmetry, of elements that are 1e8: rounding.
                "0" => assert!(value.abs() < 1.0, "{a} {b}: {value}"),
                text => printed(&[value], 1.0, text),
            }
        }
    }
}

#[test]
fn an_angular_contact_bearing_pushes_its_hosted_ring_as_printed() {
    let scene = hosted_shaft(angular(25.0), DegreesOfFreedom::Five).gravity([0.0; 2]).cage(0.0, -0.5 * PI);
    let place =
        [("shaft.x", 2e-6), ("shaft.y", -3e-6), ("shaft.z", 20e-6), ("shaft.tilt.x", 1e-3), ("shaft.tilt.y", -0.5e-3)];
    let mut found = started_with(Simulation::new(scene.build().unwrap(), None).unwrap(), &place);
    let forces = ["shaft.force.x", "shaft.force.y", "shaft.force.z", "shaft.moment.x", "shaft.moment.y"];
    let expected = "-1349.4767955 -1368.6104753 -1885.3173912 -16.5182875 15.0447183";
    printed(&values(&mut found, forces), 1.0, expected);
    printed(&values(&mut found, ["element[1].force.inner"]), 1.0, "49.426435");
    printed(&values(&mut found, ["element[1].contact_angle.inner"]), PI / 180.0, "24.932070");
}

#[test]
fn centrifugal_force_parts_the_contact_angles_as_printed() {
    // Angles (degrees), forces (N), displacement (µm) and stiffness (N/m).
    let table = [
        (0.0, "26.7033223 26.7033223", "92.722239 92.722239", "10.5648158", "7.5908782e7 1.4487564e8"),
        (20_000.0, "31.5225006 23.3651684", "79.693970 105.062352", "8.8450351", "5.1934896e7 9.5263534e7"),
        (40_000.0, "40.3704019 14.3283865", "64.327571 168.364407", "-5.9481354", "2.0269669e7 2.5465961e7"),
    ];
    for (speed, angles, forces, z, stiffness) in table {
        let scene = free_shaft(angular(25.0), DegreesOfFreedom::Five).gravity([0.0; 2]).axial_load(500.0);
        let mut found = started(scene.shaft_speed(speed * PI / 30.0).build().unwrap());
        let named = ["element[1].contact_angle.inner", "element[1].contact_angle.outer"];
        printed(&values(&mut found, named), PI / 180.0, angles);
        printed(&values(&mut found, ["element[1].force.inner", "element[1].force.outer"]), 1.0, forces);
        printed(&values(&mut found, ["shaft.z"]), 1e-6, z);
        printed(&values(&mut found, ["shaft.stiffness.zz", "shaft.stiffness.xx"]), 1.0, stiffness);
    }
    let scene = free_shaft(angular(25.0), DegreesOfFreedom::Three).gravity([0.0; 2]).axial_load(500.0);
    // The figures are those of elastic contacts.
    let scene = scene.damping(brinell::scene::Damping::HuntCrossley(0.0));
    let scene = scene.shaft_load([0.0, -100.0]).shaft_speed(20_000.0 * PI / 30.0).cage(0.0, -0.5 * PI);
    let mut found = started(scene.build().unwrap());
    printed(&values(&mut found, ["shaft.y", "shaft.z"]), 1e-6, "-1.0635411 8.7216554");
    let forces =
        ["element[1].force.inner", "element[1].force.outer", "element[7].force.inner", "element[7].force.outer"];
    printed(&values(&mut found, forces), 1.0, "99.619552 125.033090 62.479754 87.811246");
}

#[test]
fn the_bearing_of_iso_16281_stands_where_the_exact_geometry_says() {
    // Z 7, ball 1 at 0°, radial load along x.
    let bearing = |clearance: f64| Bearing {
        conformity_inner: 0.52,
        conformity_outer: 0.53,
        youngs_modulus: 210e9,
        hertz_inner: Some(3.07370231e10),
        hertz_outer: Some(2.89807829e10),
        radial_clearance: clearance,
        ..Bearing::steel_balls(7, 11.5e-3, 43.5e-3)
    };
    let scene = |clearance, [along_x, along_z]: [f64; 2], moment: [f64; 2]| {
        let scene = free_shaft(bearing(clearance), DegreesOfFreedom::Five).gravity([0.0; 2]);
        let mut scene = scene.shaft_load([along_x, 0.0]).axial_load(along_z).cage(0.0, 0.0).build().unwrap();
        scene.shaft.tilt.load_moment = moment;
        scene
    };
    let of = |clearance, load, moment| started(scene(clearance, load, moment));
    // s is the diametral clearance.
    for (clearance, z) in [(0.0, "133.537986"), (5e-6, "149.1717207")] {
        let mut found = of(clearance, [0.0, 1000.0], [0.0; 2]);
        printed(&values(&mut found, ["shaft.z"]), 1e-6, z);
    }
    // Nothing along the axis: a spring says where z is.
    let radial = |clearance, load, moment| {
        let mut scene = scene(clearance, [load, 1.0], [moment, 0.0]);
        (scene.shaft.axial.load, scene.shaft.axial.stiffness) = (0.0, 1.0);
        started(scene)
    };
    for (clearance, x) in [(0.0, "15.1147742"), (5e-6, "21.2294303")] {
        printed(&values(&mut radial(clearance, 1000.0, 0.0), ["shaft.x"]), 1e-6, x);
    }
    let mut alone = radial(0.0, 0.0, 1.0);
    printed(&values(&mut alone, ["shaft.x"]), 1e-6, "-0.0992202");
    printed(&values(&mut alone, ["shaft.tilt.x"]), 1e-3, "3.7082689");
    let mut both = of(5e-6, [1000.0; 2], [0.0; 2]);
    let names = ["shaft.x", "shaft.y", "shaft.z"];
    let [x, y, z] = values(&mut both, names);
    // Constants of the contacts with nine digits leave 6e-9 of z open, beside half of its last digit.
    printed(&[x, z - 1e-14], 1e-6, "19.8975161 146.4181753");
    let [tilt_x, tilt_y] = values(&mut both, ["shaft.tilt.x", "shaft.tilt.y"]);
    printed(&[tilt_y], 1e-3, "2.7150606");
    // Symmetry: the balance is known to 1e-12 of the load.
    assert!(y.abs() < 1e-14 && tilt_x.abs() < 1e-12, "{y} {tilt_x}");
    let mut all = of(5e-6, [1000.0; 2], [1.0, 0.0]);
    printed(&values(&mut all, names), 1e-6, "19.8367162 -2.7048803 146.2668652");
    printed(&values(&mut all, ["shaft.tilt.x", "shaft.tilt.y"]), 1e-3, "0.4969156 2.7061463");
}

#[test]
fn a_gyroscopic_couple_turns_the_contact_angles_as_printed() {
    use brinell::scene::{Damping, ElementInertia, Gyroscopic};
    let table = [
        (Gyroscopic::Outer, "33.218716 21.858813", "6.934069"),
        (Gyroscopic::Shared, "31.685681 23.143992", "8.360800"),
    ];
    for (gyroscopic, angles, z) in table {
        let bearing = Bearing { gyroscopic, element_inertia: ElementInertia::None, ..angular(25.0) };
        let scene = free_shaft(bearing, DegreesOfFreedom::Three).gravity([0.0; 2]).axial_load(500.0);
        let scene = scene.damping(Damping::HuntCrossley(0.0)).shaft_speed(20_000.0 * PI / 30.0);
        let mut found = started(scene.build().unwrap());
        let named = ["element[1].contact_angle.inner", "element[1].contact_angle.outer"];
        printed(&values(&mut found, named), PI / 180.0, angles);
        printed(&values(&mut found, ["shaft.z"]), 1e-6, z);
    }
}
