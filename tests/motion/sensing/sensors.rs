//! Accelerometers along any direction, and the probe between the rings.

use crate::support::differences::by_input;
use crate::support::{Named, shipped, turned};
use brinell::scene::{Ring, Scene, Sensor, SensorMode};
use brinell::simulation::interface::table::Causality;

fn sensor(degrees: f64, mass: f64) -> Sensor {
    Sensor { direction: degrees.to_radians(), mass, ..Sensor::default() }
}

#[test]
fn each_sensor_shows_the_housings_acceleration_along_its_own_direction() {
    let mut scene = shipped("6205-healthy");
    // Of an acceleration errors of positions show by the square of 94 000 rad/s.
    (scene.housing, scene.tolerance) = (Ring::hosted(), 1e-11);
    let degrees = [90.0, 0.0, 37.0, 180.0];
    scene.sensors = degrees.map(|direction| sensor(direction, 1.0)).to_vec();
    let mut bearing = Named::started(scene);
    let [a_x, a_y] = [3.0, -2.0];
    let names = ["x", "y", "vx", "vy", "ax", "ay"].map(|name| bearing.reference(&format!("housing.{name}")));
    let (step, count) = (1e-4, 60);
    for k in 0..count {
        let t = f64::from(k) * step;
        let motion = [0.5 * a_x * t * t, 0.5 * a_y * t * t, a_x * t, a_y * t, a_x, a_y];
        bearing.0.set_reals(&names, &motion).unwrap();
        bearing.0.step(step).unwrap();
    }
    for (k, degrees) in degrees.into_iter().enumerate() {
        let (sin, cos) = f64::to_radians(degrees).sin_cos();
        let shown = bearing.get(&format!("sensor[{}].acceleration", k + 1));
        // A resonator of 15 kHz and 5 % rings down as e^(−ζ ω t): nothing is left after 6 ms.
        assert!((shown - (cos * a_x + sin * a_y)).abs() < 1e-3, "{degrees} degrees: {shown} m/s²");
    }
    assert!(bearing.0.reference("sensor.acceleration").is_err());
}

#[test]
fn turning_the_scene_with_its_sensors_changes_no_signal() {
    let mut scene = shipped("6205-healthy");
    (scene.tolerance, scene.sensors) = (1e-10, vec![sensor(90.0, 1.0), sensor(20.0, 0.3)]);
    let other = turned(&scene, 0.777);
    let names = ["sensor[1].acceleration", "sensor[2].acceleration"];
    let [one, other] = [scene, other].map(|scene| Named::started(scene).course(names, 1e-4, 80));
    let largest = one.as_flattened().iter().fold(0.0f64, |most, a| most.max(a.abs()));
    for (a, b) in one.as_flattened().iter().zip(other.as_flattened()) {
        // The tolerance of the integration, a thousandfold for an acceleration.
        assert!((a - b).abs() < 1e-6 * largest, "{a} {b}");
    }
    assert!(largest > 1e-3, "{largest}");
}

#[test]
fn one_table_among_several_sensors_is_the_table_alone() {
    let text = include_str!("../../../scenes/6205-spall-5deg.toml");
    assert!(text.contains("\n[sensor]\n"));
    let several = text.replace("\n[sensor]\n", "\n[[sensor]]\ndirection_deg = 90\n");
    assert_eq!(brinell_scene_file::from_toml(&several).unwrap(), brinell_scene_file::from_toml(text).unwrap());
    // Straight upwards to the bit: the x axis has no part in it.
    assert_eq!(Sensor::default().unit(), [0.0, 1.0]);
}

#[test]
fn masses_of_all_sensors_hang_on_the_housing() {
    // Slow against the resonators, two masses on the housing are the housing's.
    let bare = |sensors: Vec<Sensor>, more: f64| {
        let mut scene = shipped("6205-healthy");
        (scene.sensors, scene.tolerance) = (sensors, 1e-9);
        scene.housing.mass += more;
        let mut bearing = Named::started(scene);
        bearing.0.set("shaft.load.y", -900.0).unwrap();
        bearing.run(1e-4, 50);
        bearing.get("housing.y")
    };
    let (sensed, heavier, lighter) =
        (bare(vec![sensor(90.0, 0.5), sensor(90.0, 0.7)], 0.0), bare(vec![], 1.2), bare(vec![], 0.0));
    let off = (sensed - heavier).abs() / (heavier - lighter).abs();
    // The square of 1 kHz over 18 kHz.
    assert!(off < 0.02, "{sensed} {heavier} {lighter}");
}

#[test]
fn the_probe_shows_the_inner_ring_from_the_outer() {
    let mut scene = shipped("6205-healthy");
    scene.probe = true;
    let mut bearing = Named::started(scene);
    bearing.run(1e-4, 20);
    for axis in ["x", "y"] {
        let apart = bearing.get(&format!("shaft.{axis}")) - bearing.get(&format!("housing.{axis}"));
        assert_eq!(bearing.get(&format!("probe.{axis}")), apart);
    }
    let probe = bearing.0.table().iter().find(|variable| variable.name == "probe.y").unwrap();
    assert_eq!(probe.causality, Causality::Output);
}

#[test]
fn derivatives_of_sensors_and_probe_are_difference_quotients() {
    let mut scene = shipped("6205-healthy");
    (scene.shaft, scene.housing, scene.probe) = (Ring::hosted(), Ring::hosted(), true);
    scene.sensors = vec![sensor(90.0, 1.0), sensor(-30.0, 0.2)];
    let mut bearing = Named::started(scene);
    bearing.run(1e-5, 5);
    let unknown = ["sensor[1].acceleration", "sensor[2].acceleration", "probe.x", "probe.y"];
    let mut compared = 0;
    for known in ["housing.x", "housing.y", "housing.vx", "shaft.y"] {
        for slope in by_input(&mut bearing.0, &unknown, known, 1e-7) {
            assert!(slope.miss() <= 1e-6 * slope.found.abs() + 1e-6, "{known}: {slope:?}");
            compared += usize::from(slope.found != 0.0);
        }
    }
    // By housing.x sensor 2 and the probe, by housing.y both sensors and the probe, by housing.vx sensor 2, by shaft.y
    // the probe.
    assert_eq!(compared, 7);
}

#[test]
fn what_is_wrong_with_one_of_several_is_said_with_its_number() {
    let refused = |sensors| Scene { sensors, ..shipped("6205-spall-5deg") }.check().unwrap_err().to_string();
    let message = refused(vec![Sensor::default(), Sensor { mass: -1.0, ..Sensor::default() }]);
    assert!(message.contains("[[sensor]] number 2") && message.contains("-1"), "{message}");
    let mode = SensorMode { frequency: 0.5, damping_ratio: 0.03, gain: 0.8, quadrature_gain: 0.0 };
    let message = refused(vec![Sensor { modes: vec![mode; 2], ..Sensor::default() }]);
    assert!(message.contains("[[sensor.mode]] number 1") && message.contains("0.5"), "{message}");
}
