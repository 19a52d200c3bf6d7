//! Motions that are known: two other right-hand sides and integrations of them agree to 1e-14 m.

use crate::case::{Defect, Length, On, Shape};
use crate::spatial::bearing::BALLS;
use crate::spatial::*;
use std::f64::consts::TAU;

/// A tenth of what is printed last.
#[track_caller]
fn near(found: f64, expected: f64, limit: f64) {
    assert!((found - expected).abs() <= limit, "{found:.12} is not {expected}");
}

/// Weight, a shaft on dampers, a housing that stands, loads that step after a millisecond.
fn rig(case: SpatialCase, load: [f64; 5], later: [f64; 5]) -> SpatialCase {
    let shaft = SpatialRing { damping: [1376.8, 1376.8, 0.4], ..SpatialRing::free(3.2638, load) };
    let speeds = [[TAU * case.speed_hz, 0.0], [0.0; 2]];
    let says = |load: [f64; 5]| Host { speeds, rings: [load.map(|load| [load, 0.0, 0.0]), [[0.0; 3]; 5]] };
    SpatialCase {
        gravity: [0.0, -9.81, 0.0],
        rings: [SpatialRing { inertia: [4e-3, 2e-3], ..shaft }, SpatialRing::FIXED],
        steps: vec![Step { length: 1e-3, host: Some(says(load)) }, Step { length: 5e-3, host: Some(says(later)) }],
        ..case
    }
}

/// A spall of 0.3 mm, 100 µm deep.
fn sharp(on: On, angle_deg: f64) -> Defect {
    let shape = Shape::Spall { length: Length::Millimetres(0.3), depth_um: 100.0, slope_deg: 90.0 };
    Defect { on, angle_deg, shape }
}

/// An instant of a run: shaft (µm, mrad), u and v of ball 1 (µm), its forces (N) and angles (°) inside and outside.
type Instant = ([f64; 5], [f64; 2], [f64; 2], [f64; 2]);

/// The start and the end of a run.
fn ends(case: &SpatialCase, guess: [f64; 5]) -> [Instant; 2] {
    let bearing = SpatialBearing::new(case);
    let balance = bearing.balance(case.steps[0].host.as_ref(), guess).expect("a balance");
    assert!(balance.left < 1e-9, "{:e}", balance.left);
    let mut run = SpatialRun::new(&bearing, balance.state, case.steps[0].host.as_ref(), [0.0; 2], 1e-15, 20_000_000);
    let now = |run: &SpatialRun<'_>| {
        let touches = run.acting.balls[0].contacts;
        let (forces, angles) = (touches.map(|touch| touch.force), touches.map(|touch| touch.angle.to_degrees()));
        let scaled: [f64; 5] = std::array::from_fn(|a| run.ring(0)[a] * if a < 3 { 1e6 } else { 1e3 });
        (scaled, run.place(0).map(|x| x * 1e6), forces, angles)
    };
    let first = now(&run);
    for step in &case.steps {
        run.step(step.length, step.host.as_ref()).expect("a run to its end");
    }
    assert!(run.y.len() == BALLS + 4 * case.count);
    [first, now(&run)]
}

#[track_caller]
fn compare(found: Instant, expected: Instant) {
    // One and a half of the last printed digit of each.
    found.0.into_iter().zip(expected.0).for_each(|(found, expected)| near(found, expected, 1.5e-7));
    found.1.into_iter().zip(expected.1).for_each(|(found, expected)| near(found, expected, 1.5e-7));
    found.2.into_iter().zip(expected.2).for_each(|(found, expected)| near(found, expected, 1.5e-6));
    found.3.into_iter().zip(expected.3).for_each(|(found, expected)| near(found, expected, 1.5e-6));
}

#[test]
fn an_angular_contact_bearing_follows_a_step_of_its_loads() {
    let case = SpatialCase {
        count: 12,
        diameter_mm: 7.938,
        pitch_mm: 38.5,
        conformities: [0.515, 0.525],
        setting: AxialSetting::Angle(20.0),
        operating_deg: Some(20.0),
        speed_hz: 60.0,
        mass_g: Some(2.0427),
        cage_deg: -80.0,
        ..SpatialCase::at_rest()
    };
    let case = rig(case, [0.0, -200.0, 500.0, 0.0, 0.0], [30.0, -200.0, 650.0, 0.0, 0.0]);
    let constants = SpatialBearing::new(&case).constants();
    assert!((constants[0] / 2.822_011_710_3e10 - 1.0).abs() < 1e-10, "{constants:?}");
    assert!((constants[1] / 2.497_973_337_1e10 - 1.0).abs() < 1e-10, "{constants:?}");
    let [first, last] = ends(&case, [0.0, -1e-6, 14e-6, 0.0, 0.0]);
    compare(
        first,
        (
            [0.000_182_4, -1.225_874_8, 14.154_635_4, 0.0, 0.0],
            [-11.742_073_5, 8.432_203_8],
            [145.428_164, 146.286_609],
            [22.367_399, 22.229_459],
        ),
    );
    compare(
        last,
        (
            [0.137_422_5, -1.096_955_6, 17.111_596_6, 0.0, 0.0],
            [-12.167_165_7, 10.277_460_1],
            [167.061_005, 167.909_078],
            [22.875_559, 22.759_542],
        ),
    );
}

#[test]
fn a_tilting_6205_follows_a_step_of_its_moments() {
    let case = SpatialCase {
        freedom: 5,
        setting: AxialSetting::Radial(8.0),
        operating_deg: Some(15.0),
        speed_hz: 40.0,
        mass_g: Some(2.0443),
        cage_deg: -80.0,
        ..SpatialCase::at_rest()
    };
    let case = rig(case, [0.0, -250.0, 350.0, 0.3, 0.2], [0.0, -250.0, 350.0, -0.5, 0.5]);
    let [first, last] = ends(&case, [1e-6, -12e-6, 91e-6, 1.8e-3, 0.2e-3]);
    compare(
        first,
        (
            [1.253_061_0, -11.966_898_0, 91.379_821_3, 1.798_173_3, 0.221_817_7],
            [1.907_035_7, 27.859_925_3],
            [240.375_840, 240.796_314],
            [9.950_367, 9.834_962],
        ),
    );
    compare(
        last,
        (
            [3.100_743_6, -5.574_738_4, 93.391_631_1, 0.648_592_1, 0.532_500_5],
            [-0.988_303_6, 38.417_941_2],
            [185.369_700, 185.778_984],
            [13.760_381, 13.682_040],
        ),
    );
}

#[test]
fn a_ball_at_a_contact_angle_crosses_a_spall() {
    let mut case = SpatialCase {
        operating_deg: Some(15.0),
        speed_hz: 30.0,
        mass_g: Some(2.0443),
        cage_deg: -103.017_492_131_6,
        defects: vec![sharp(On::Outer, -90.0)],
        ..SpatialCase::at_rest()
    };
    case = rig(case, [0.0, -200.0, 400.0, 0.0, 0.0], [0.0, -200.0, 400.0, 0.0, 0.0]);
    case.steps[1].length = 2.1e-3;
    let [first, last] = ends(&case, [0.0, -1e-6, 87e-6, 0.0, 0.0]);
    compare(
        first,
        (
            [0.000_125_5, -1.319_821_5, 86.795_789_2, 0.0, 0.0],
            [-1.923_870_6, 43.352_797_6],
            [211.965_904, 212.205_336],
            [15.466_223, 15.448_164],
        ),
    );
    compare(
        last,
        (
            [0.000_059_9, -1.451_245_4, 86.834_670_5, 0.0, 0.0],
            [-1.839_051_0, 43.369_762_0],
            [218.590_428, 219.168_183],
            [15.466_101, 15.445_968],
        ),
    );
}
