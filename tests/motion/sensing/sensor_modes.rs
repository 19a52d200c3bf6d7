//! The structure between the outer ring and a sensor.

use crate::support::differences::{by_input, by_time};
use crate::support::{Named, furthest, shipped};
use brinell::scene::{Recorder, RecorderFilter, Ring, Scene, Sensor, SensorMode};
use std::f64::consts::TAU;

/// The first as damping that couples modes would have it.
const MODES: [SensorMode; 2] = [
    SensorMode { frequency: 2_300.0, damping_ratio: 0.03, gain: 0.8, quadrature_gain: 0.2 },
    SensorMode { frequency: 7_100.0, damping_ratio: 0.01, gain: -0.5, quadrature_gain: 0.0 },
];

/// An element over a spall; a bare sensor, and its like behind a structure.
fn impacts() -> Scene {
    let mut scene = shipped("er16k-tb2-compliant");
    scene.tolerance = 1e-8;
    scene.sensors = vec![Sensor::default(), Sensor { modes: MODES.to_vec(), ..Sensor::default() }];
    scene
}

/// What a sensor behind `modes` shows of an acceleration sampled every `h` (s), straight between samples: the exact
/// recursion of each mode, by exponentials and circular functions.
fn behind(modes: &[SensorMode], h: f64, accelerations: &[f64]) -> Vec<f64> {
    let mut shown = accelerations.to_vec();
    for mode in modes {
        let (w, zeta) = (TAU * mode.frequency, mode.damping_ratio);
        let (decay, ringing) = (zeta * w, w * (1.0 - zeta * zeta).sqrt());
        let (fall, (sin, cos)) = ((-decay * h).exp(), (ringing * h).sin_cos());
        let [mut z, mut rate] = [0.0, 0.0];
        for (k, pair) in accelerations.windows(2).enumerate() {
            // A straight line p + q t solves z'' + 2 ζ ω z' + ω² z = −a for a straight a; the rest rings.
            let slope = (pair[1] - pair[0]) / h;
            let q = -slope / (w * w);
            let p = (-pair[0] - 2.0 * zeta * w * q) / (w * w);
            let [free, speed] = [z - p, rate - q];
            let swing = (speed + decay * free) / ringing;
            z = p + q * h + fall * (free * cos + swing * sin);
            rate = q + fall * (speed * cos - (decay * swing + ringing * free) * sin);
            shown[k + 1] +=
                mode.gain * (-pair[1] - 2.0 * zeta * w * rate - w * w * z) + mode.quadrature_gain * w * rate;
        }
    }
    shown
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| value.abs().max(most))
}

#[test]
fn a_sensor_behind_a_structure_shows_what_its_modes_make_of_the_base() {
    // Samples at 4 MHz of an acceleration that vibrates at up to 40 kHz: straight lines between them miss
    // (2π 40e3/4e6)²/12 = 3e-4 of it.
    let (h, count) = (2.5e-7, 60_000);
    let mut bearing = Named::started(impacts());
    let (mut base, mut shown) = (vec![0.0], vec![0.0]);
    for [of_base, behind] in bearing.course(["sensor[1].acceleration", "sensor[2].acceleration"], h, count) {
        base.push(of_base);
        shown.push(behind);
    }
    let expected = behind(&MODES, h, &base);
    let (miss, bare) = (furthest(&expected, &shown), furthest(&expected, &base));
    assert!(bare > 0.1 * largest(&expected), "{bare} of {} m/s²", largest(&expected));
    assert!(miss < 3e-4 * largest(&expected), "{miss} of {} m/s²", largest(&expected));
}

#[test]
fn what_is_shown_depends_on_no_communication_step() {
    let course = |step: f64, every: usize| {
        let mut bearing = Named::started(impacts());
        (0..40).map(|_| (bearing.run(step, every), bearing.get("sensor[2].acceleration")).1).collect::<Vec<_>>()
    };
    let (fine, coarse) = (course(1.25e-5, 20), course(2.5e-4, 1));
    // 1e-8 of an approach, ten thousandfold for an acceleration amid impacts.
    assert!(furthest(&fine, &coarse) < 1e-4 * largest(&fine), "{} of {}", furthest(&fine, &coarse), largest(&fine));
    assert!(largest(&fine) > 0.1);
}

#[test]
fn slow_motion_passes_a_structure_unchanged() {
    let mut scene = shipped("6205-healthy");
    (scene.housing, scene.tolerance) = (Ring::hosted(), 1e-11);
    scene.sensors = vec![Sensor { modes: MODES.to_vec(), ..Sensor::default() }];
    let mut bearing = Named::started(scene);
    let names = ["y", "vy", "ay"].map(|name| bearing.reference(&format!("housing.{name}")));
    let (step, acceleration) = (1e-4, -2.0);
    for k in 0..300 {
        let t = f64::from(k) * step;
        bearing.0.set_reals(&names, &[0.5 * acceleration * t * t, acceleration * t, acceleration]).unwrap();
        bearing.0.step(step).unwrap();
    }
    // The slowest mode rings down as e^(−ζ ω t): 2e-6 after 30 ms.
    let shown = bearing.get("sensor.acceleration");
    assert!((shown - acceleration).abs() < 1e-4, "{shown} m/s²");
}

#[test]
fn a_run_put_back_shows_the_same_bits_also_from_bytes() {
    let mut scene = impacts();
    scene.recorder = Some(Recorder { rate: 51_200.0, filter: RecorderFilter::LinearPhase });
    let mut bearing = Named::recorded(scene);
    bearing.run(1e-3, 4);
    let saved = bearing.0.save();
    let bytes = saved.to_bytes();
    let mut rest = |back: &dyn Fn(&mut Named)| {
        back(&mut bearing);
        bearing.run(1e-3, 6);
        let rows = bearing.0.recorder().unwrap().samples().values.to_vec();
        (bearing.get("sensor[2].acceleration").to_bits(), rows.iter().map(|value| value.to_bits()).collect::<Vec<_>>())
    };
    let first = rest(&|_| {});
    assert_eq!(rest(&|bearing| bearing.0.restore(&saved).unwrap()), first);
    assert_eq!(
        rest(&|bearing| {
            let state = bearing.0.state_from_bytes(&bytes).unwrap();
            bearing.0.restore(&state).unwrap();
        }),
        first
    );
}

#[test]
fn the_recorder_sees_a_structure_as_a_host_that_stops_at_each_sample() {
    let rate = 40_000.0;
    let mut scene = impacts();
    scene.recorder = Some(Recorder { rate, filter: RecorderFilter::None });
    let mut far = Named::recorded(scene.clone());
    far.run(1e-3, 10);
    let recorded = far.columns(&["sensor[2].acceleration"]).remove(0);
    let seen = Named::started(scene).course(["sensor[2].acceleration"], 1.0 / rate, recorded.len() - 1);
    let seen = [&[0.0], seen.as_flattened()].concat();
    assert_eq!(recorded.len(), 400);
    // The two runs step differently, and the dense output of an implicit step is less exact than the step.
    assert!(furthest(&recorded, &seen) < 1e-3 * largest(&seen), "{}", furthest(&recorded, &seen));
}

#[test]
fn derivatives_of_what_is_shown_are_difference_quotients() {
    let mut scene = shipped("6205-healthy");
    (scene.shaft, scene.housing, scene.tolerance) = (Ring::hosted(), Ring::hosted(), 1e-11);
    scene.sensors = vec![Sensor { modes: MODES.to_vec(), ..Sensor::default() }];
    let mut bearing = Named::started(scene);
    bearing.set("housing.vy", 2e-3);
    bearing.set("housing.y", 0.0);
    bearing.run(1e-5, 9);
    for input in ["housing.vy", "housing.y"] {
        let slope = by_input(&mut bearing.0, &["sensor.acceleration"], input, 1e-7)[0];
        assert!(slope.found.abs() > 1.0 && slope.miss() < 1e-6 * slope.given.abs(), "{input}: {slope:?}");
    }
    // Third differences fall with the square of the step, the rounding of 1e-10 m of a resonator of 15 kHz grows.
    let slope = by_time(&mut bearing.0, &["sensor.acceleration"], 1e-8)[0];
    assert!(slope.miss() < 1e-2 * slope.given.abs(), "{slope:?}");
}

#[test]
fn tables_of_modes_belong_to_the_sensor_before_them() {
    // What stands after the sensor goes with it; all of it has defaults.
    let (text, _) = include_str!("../../../scenes/6205-spall-5deg.toml").split_once("\n[sensor]\n").unwrap();
    let mode = "[[sensor.mode]]\nfrequency_hz = 2300\ndamping_ratio = 0.03\ngain = 0.8\nquadrature_gain = 0.2\n";
    let with = |tables: &str| brinell_scene_file::from_toml(&format!("{text}\n{tables}"));
    let count =
        |tables: &str| with(tables).unwrap().sensors.iter().map(|sensor| sensor.modes.len()).collect::<Vec<_>>();
    assert_eq!(count(&format!("[sensor]\n{mode}{mode}")), [2]);
    assert_eq!(count(&format!("[[sensor]]\n{mode}[[sensor]]\n{mode}{mode}")), [1, 2]);
    assert_eq!(with(&format!("[sensor]\n{mode}")).unwrap().sensors[0].modes, MODES[..1]);
}

#[test]
fn a_sample_at_the_very_start_of_a_step_is_a_number() {
    let mut scene = impacts();
    // Communication points and samples then fall together.
    scene.recorder = Some(Recorder { rate: 2_000.0, filter: RecorderFilter::None });
    let mut bearing = Named::recorded(scene);
    bearing.run(5e-4, 20);
    let values = bearing.0.recorder().unwrap().samples().values.to_vec();
    assert!(values.len() > 20);
    assert!(values.iter().all(|value| value.is_finite()), "{values:?}");
}
