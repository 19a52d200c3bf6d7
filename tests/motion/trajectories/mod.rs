//! Stored trajectories of an independent program: `trajectories/*.csv`, positions (m) under law `hertz` by SciPy's
//! DOP853 at a relative tolerance of 1e-12 on equations that were written separately in Python. Commit 1df39393 has
//! that program in `tests/oracle`. Of random scenes `adversary/oracle` says the same.

use crate::support::defects::spall;
use crate::support::{Named, shipped};
use brinell::scene::{Defect, DefectOn, Ring, Scene};
use std::f64::consts::TAU;

/// The ER16K under 500 N, without a defect, from this angle of the cage (degrees): the shaft free, the housing fixed.
fn er16k(cage: f64) -> Scene {
    let (housing, sensors, defects) = (Ring::fixed(), Vec::new(), Vec::new());
    let mut scene = Scene { housing, sensors, defects, tolerance: 1e-10, ..shipped("er16k-tb1") };
    scene.cage.initial_angle = cage.to_radians();
    scene
}

/// Follows what is stored under a name, the host doing something before each of so many steps between two rows:
/// elements within 1e-10 m, the shaft within 1e-12 m.
fn follows(name: &str, scene: Scene, steps: usize, host: impl Fn(&mut Named, f64)) {
    let file = brinell_tests::root().join("tests/motion/trajectories").join(name).with_extension("csv");
    let mut reader = csv::Reader::from_path(file).unwrap();
    let names: Vec<String> = reader.headers().unwrap().iter().skip(1).map(str::to_owned).collect();
    let rows: Vec<Vec<f64>> = reader.deserialize().map(|row| row.unwrap()).collect();
    let mut bearing = Named::new(scene);
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
    let mut scene = Scene { shaft: Ring::hosted(), housing: Ring::hosted(), ..er16k(-95.0) };
    scene.bearing.element_count = 1;
    let [ax, ay, y0, omega] = [3e-6, 5e-6, -20e-6, 300.0 * TAU];
    // Within 1 µs the motion is wrong by 1/6 of its third derivative: 6e-15 m. Before a row the host says its own.
    follows("one-element", scene, 50, |bearing, time| {
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
    follows("nine-elements", er16k(-90.0), 1, |_, _| {});
}

/// Element 1 meets them under the load: a short spall of the inner raceway after 5 ms, one of 10° from 5.7 to 10.3 ms,
/// and spalls of its own that face the outer raceway after 5 ms and the inner one after 26 ms.
#[test]
fn elements_over_defects_of_the_inner_raceway_and_of_a_ball_move_as_stored() {
    let ten_degrees = 10f64.to_radians() * er16k(0.0).bearing.inner_raceway_radius();
    let (inner, element) = (DefectOn::Inner, DefectOn::Element { element: 0, tilt: 0.0 });
    for (name, cage, on, angle, length) in [
        ("inner-short", -97.1826, inner, -108.0_f64, 0.4e-3),
        ("inner-long", -101.492, inner, -118.8, ten_degrees),
        ("element-short", -112.1826, element, 42.7519, 0.4e-3),
        ("element-long", -112.1826, element, 42.7519, 1.2e-3),
    ] {
        let defect = Defect { on, angle: angle.to_radians(), shape: spall(length, 100e-6) };
        follows(name, Scene { defects: vec![defect], tolerance: 1e-11, ..er16k(cage) }, 1, |_, _| {});
    }
}
