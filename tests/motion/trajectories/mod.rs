//! Stored trajectories of an independent program: `trajectories/*.csv`, positions (m) under law `hertz` by SciPy's
//! DOP853 at a relative tolerance of 1e-12 on equations that were written separately in Python. Commit 1df39393 has
//! that program in `tests/oracle`. Of random scenes `adversary/oracle` says the same.

use crate::support::Named;
use std::f64::consts::TAU;

/// Elements between rings that the host moves.
const SCENE: &str = r#"
name = "trajectory"
description = "ER16K between prescribed rings"
[bearing]
element_count = 1
element_diameter_mm = 7.94
pitch_diameter_mm = 39.32
groove_diameter_mm = 8.19
radial_clearance_um = 5.0
youngs_modulus_gpa = 207.0
poissons_ratio = 0.3
density_kg_m3 = 7800.0
[cage]
initial_angle_deg = -95.0
[shaft]
motion = "host"
speed_hz = 10.0
[housing]
motion = "host"
[solver]
tolerance = 1e-10
"#;

/// Nine elements, the shaft free under 500 N, the housing fixed; the cage's angle (degrees).
fn nine_elements(cage: f64) -> String {
    let shaft = "motion = \"internal\"\nload_n = [0.0, -500.0]\nmass_kg = 3.2638\ndamping_n_s_m = 1376.8\n\
                 stiffness_n_m = 0.0";
    SCENE
        .replace("element_count = 1", "element_count = 9")
        .replace("[shaft]\nmotion = \"host\"", &format!("[shaft]\n{shaft}"))
        .replace("[housing]\nmotion = \"host\"", "[housing]\nmotion = \"fixed\"")
        .replace("= -95.0", &format!("= {cage}"))
}

/// The same at a tighter tolerance with a defect 100 µm deep.
fn with_defect(cage: f64, defect: &str) -> String {
    nine_elements(cage).replace("tolerance = 1e-10", "tolerance = 1e-11")
        + &format!("[contact]\nlaw = \"hertz\"\n[defect]\n{defect}\ndepth_um = 100.0\n")
}

/// Follows what is stored under a name, the host doing something before each of so many steps between two rows:
/// elements within 1e-10 m, the shaft within 1e-12 m.
fn follows(name: &str, scene: &str, steps: usize, host: impl Fn(&mut Named, f64)) {
    let file = brinell_tests::root().join("tests/motion/trajectories").join(name).with_extension("csv");
    let mut reader = csv::Reader::from_path(file).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().skip(1).map(str::to_owned).collect();
    let rows: Vec<Vec<f64>> = reader.deserialize().map(|row| row.unwrap()).collect();
    let mut bearing = Named::new(brinell_scene_file::from_toml(scene).unwrap());
    host(&mut bearing, 0.0);
    bearing.0.initialize(0.0).unwrap();
    let (mut path, mut ring) = (0.0f64, 0.0f64);
    for (k, row) in rows.iter().enumerate() {
        if k > 0 {
            let (from, step) = (rows[k - 1][0], (row[0] - rows[k - 1][0]) / steps as f64);
            for i in 0..steps {
                host(&mut bearing, from + step * i as f64);
                bearing.0.step(step).unwrap();
            }
        }
        for (name, expected) in names.iter().zip(&row[1..]) {
            let worst = if name.ends_with(".path") { &mut path } else { &mut ring };
            *worst = worst.max((bearing.get(name) - expected).abs());
        }
    }
    assert!(rows.len() > 40 && path < 1e-10 && ring < 1e-12, "{name}: path off by {path:e} m, ring by {ring:e} m");
}

#[test]
fn one_element_between_prescribed_rings_moves_as_stored() {
    let [ax, ay, y0, omega] = [3e-6, 5e-6, -20e-6, 300.0 * TAU];
    // Within 1 µs the motion is wrong by 1/6 of its third derivative: 6e-15 m. Before a row the host says its own.
    follows("one-element", SCENE, 50, |bearing, time| {
        let (sin, cos) = (omega * time).sin_cos();
        let of = |start: f64, a: f64| [start + a * sin, a * omega * cos, -a * omega * omega * sin];
        let rings = [("x", of(0.0, ax)), ("y", of(y0, ay))];
        for (axis, values) in rings {
            for (kind, value) in ["", "v", "a"].into_iter().zip(values) {
                bearing.set(&format!("shaft.{kind}{axis}"), value);
            }
        }
    });
}

#[test]
fn nine_elements_and_a_free_shaft_move_as_stored() {
    follows("nine-elements", &nine_elements(-90.0), 1, |_, _| {});
}

/// Element 1 meets them under the load: a short spall of the inner raceway after 5 ms, one of 10° from 5.7 to 10.3 ms,
/// and spalls of its own that face the outer raceway after 5 ms and the inner one after 26 ms.
#[test]
fn elements_over_defects_of_the_inner_raceway_and_of_a_ball_move_as_stored() {
    let on_element = |length: f64| format!("on = \"element\"\nelement = 1\nangle_deg = 42.7519\nlength_mm = {length}");
    for (name, cage, defect) in [
        ("inner-short", -97.1826, "on = \"inner\"\nangle_deg = -108.0\nlength_mm = 0.4".to_owned()),
        ("inner-long", -101.492, "on = \"inner\"\nangle_deg = -118.8\nlength_deg = 10.0".to_owned()),
        ("element-short", -112.1826, on_element(0.4)),
        ("element-long", -112.1826, on_element(1.2)),
    ] {
        follows(name, &with_defect(cage, &defect), 1, |_, _| {});
    }
}
