//! Balances that are known: figures of an independent reference and of published tables.

mod motion;

use super::*;
use crate::case::{Damping, Motion};

/// Within one and a half of the last digit that is printed, `digit`.
#[track_caller]
fn printed(found: f64, expected: f64, digit: f64) {
    assert!((found - expected).abs() <= 1.5 * digit, "{found:.12} is not {expected}");
}

/// Free in all directions, without weight or damping.
fn standing(freedom: usize, load: [f64; 5]) -> SpatialCase {
    let shaft = SpatialRing { motion: Motion::Internal, mass: 1.0, load, inertia: [1.0, 1.0], ..SpatialRing::FIXED };
    SpatialCase {
        freedom,
        damping: Damping::HuntCrossley(0.0),
        across: 0.0,
        rings: [shaft, SpatialRing::FIXED],
        ..SpatialCase::at_rest()
    }
}

/// The bearing of the angular contact figures: 12 balls of 7.938 mm on 38.5 mm, 25 degrees.
fn angular(freedom: usize, load: [f64; 5]) -> SpatialCase {
    SpatialCase {
        count: 12,
        diameter_mm: 7.938,
        pitch_mm: 38.5,
        conformities: [0.515, 0.525],
        setting: AxialSetting::Angle(25.0),
        operating_deg: Some(25.0),
        mass_g: Some(2.0427),
        ..standing(freedom, load)
    }
}

fn balanced(case: &SpatialCase, guess: [f64; 5]) -> (SpatialBearing, Balance) {
    let bearing = SpatialBearing::new(case);
    let found = bearing.balance(None, guess).expect("a balance");
    let force = found.held.balls.iter().flat_map(|ball| ball.contacts).fold(0.0f64, |m, touch| m.max(touch.force));
    assert!(found.left <= 1e-9 * force && found.held.left <= 1e-9 * force, "{:e} {:e}", found.left, found.held.left);
    (bearing, found)
}

/// ISO/TS 16281's example with a play (µm).
fn of_the_standard(freedom: usize, play: f64, load: [f64; 5]) -> SpatialCase {
    SpatialCase {
        count: 7,
        diameter_mm: 11.5,
        pitch_mm: 43.5,
        conformities: [0.52, 0.53],
        setting: AxialSetting::Radial(0.5 * play),
        hertz: [Some(3.073_702_31e10), Some(2.898_078_29e10)],
        cage_deg: 0.0,
        ..standing(freedom, load)
    }
}

/// ISO/TS 16281's example: loads and tilts that public programs give, by exact circles.
#[test]
fn the_example_of_iso_16281_has_its_exact_displacements() {
    let of = |play: f64, load: [f64; 5], guess: [f64; 5]| {
        let case = SpatialCase { modulus_gpa: 210.0, ..of_the_standard(5, play, load) };
        let (_, found) = balanced(&case, guess);
        let y = &found.state;
        [y[0] * 1e6, y[1] * 1e6, y[2] * 1e6, y[3] * 1e3, y[4] * 1e3]
    };
    let guess = [15e-6, 0.0, 140e-6, 0.0, 2.7e-3];
    for (play, load, expected) in [
        (0.0, [0.0, 0.0, 1000.0, 0.0, 0.0], [0.0, 0.0, 133.537_986, 0.0, 0.0]),
        (10.0, [0.0, 0.0, 1000.0, 0.0, 0.0], [0.0, 0.0, 149.171_720_7, 0.0, 0.0]),
        (10.0, [1000.0, 0.0, 1000.0, 0.0, 0.0], [19.897_516_1, 0.0, 146.418_175_3, 0.0, 2.715_060_6]),
        (10.0, [1000.0, 0.0, 1000.0, 1.0, 0.0], [19.836_716_2, -2.704_880_3, 146.266_865_2, 0.496_915_6, 2.706_146_3]),
    ] {
        // Constants are given to nine digits.
        for (found, expected) in of(play, load, guess).into_iter().zip(expected) {
            printed(found, expected, 1e-6);
        }
    }
    let alone = of(0.0, [0.0, 0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 3.5e-3, 0.0]);
    for (found, expected) in alone.into_iter().zip([-0.099_220_2, 0.0, 0.0, 3.708_268_9, 0.0]) {
        printed(found, expected, 1e-6);
    }
}

#[test]
fn a_purely_radial_load_on_the_example_has_its_exact_displacement() {
    for (play, expected) in [(0.0, 15.114_774_2), (10.0, 21.229_430_3)] {
        let mut case = of_the_standard(3, play, [1000.0, 0.0, 0.0, 0.0, 0.0]);
        case.rings[0].stiffness[1] = 1.0;
        let (_, found) = balanced(&case, [15e-6, 0.0, 0.0, 0.0, 0.0]);
        printed(found.state[0] * 1e6, expected, 1e-6);
    }
}

#[test]
fn a_6205_under_thrust_has_the_closed_form_and_its_stiffness() {
    for (clearance, thrust, [z, angle, force], stiffness) in [
        (
            5.0,
            100.0,
            [71.493_326_7, 12.882_299_5, 49.837_015],
            [1.221_801_61e7, 1.041_107_70e8, 2.360_840_43e3, -4.653_593_06e5],
        ),
        (
            5.0,
            1000.0,
            [102.576_328_0, 18.166_693_4, 356.373_633],
            [4.982_704_29e7, 1.909_030_19e8, 9.615_431_29e3, -1.201_105_98e6],
        ),
        (
            10.0,
            1000.0,
            [114.394_480_4, 20.399_847_1, 318.763_105],
            [5.708_626_95e7, 1.790_774_01e8, 1.102_138_06e4, -1.278_251_19e6],
        ),
    ] {
        let case =
            SpatialCase { setting: AxialSetting::Radial(clearance), ..standing(3, [0.0, 0.0, thrust, 0.0, 0.0]) };
        let (bearing, found) = balanced(&case, [0.0, 0.0, z * 1e-6, 0.0, 0.0]);
        printed(found.state[2] * 1e6, z, 1e-7);
        for ball in &found.held.balls {
            printed(ball.contacts[0].angle.to_degrees(), angle, 1e-7);
            printed(ball.contacts[1].force, force, 1e-6);
        }
        let k = bearing.stiffness([0.0, 0.0, found.state[2], 0.0, 0.0]).unwrap();
        for (found, expected) in [k[2][2], k[0][0], k[3][3], k[0][4]].into_iter().zip(stiffness) {
            // Difference quotients: 4e-8 of what the approach is in the fourth power, and their rounding.
            assert!((found / expected - 1.0).abs() < 2e-7, "{found:e} {expected:e}");
        }
    }
}

#[test]
fn a_6205_under_combined_load_tilts_by_two_milliradians_where_nobody_holds_it() {
    let mut held = standing(3, [0.0, -500.0, 300.0, 0.0, 0.0]);
    // The figures are of constants of five digits.
    held.hertz = [Some(2.5448e10), Some(2.6967e10)];
    let (_, found) = balanced(&held, [0.0, -3e-6, 80e-6, 0.0, 0.0]);
    printed(found.state[1] * 1e6, -3.662_357_3, 1e-6);
    printed(found.state[2] * 1e6, 82.066_683_9, 1e-6);
    let balls = &found.held.balls;
    printed(balls[0].contacts[0].force, 255.714_23, 1e-4);
    printed(balls[4].contacts[0].force, 31.572_25, 1e-4);
    printed(balls[0].contacts[0].angle.to_degrees(), 14.546_80, 1e-5);
    printed(found.held.rings[0][3], 2.547_057_4, 1e-6);
    let free = SpatialCase { freedom: 5, ..held };
    let (_, found) = balanced(&free, [0.0, -14e-6, 80e-6, 2.2e-3, 0.0]);
    for (found, expected) in [found.state[1] * 1e6, found.state[2] * 1e6, found.state[3] * 1e3].into_iter().zip([
        -14.232_840_8,
        79.753_803_9,
        2.238_599_6,
    ]) {
        printed(found, expected, 1e-6);
    }
    let balls = &found.held.balls;
    for (j, force) in [(0, 343.742), (3, 84.998_83), (4, 109.137_22)] {
        printed(balls[j].contacts[0].force, force, 1e-4);
    }
    printed(balls[0].contacts[0].angle.to_degrees(), 6.364_04, 1e-5);
    printed(balls[4].contacts[0].angle.to_degrees(), 21.924_12, 1e-5);
}

#[test]
fn an_angular_contact_bearing_has_its_place_and_all_of_its_stiffness() {
    let case = angular(5, [0.0, -200.0, 500.0, 0.5, 0.0]);
    let (bearing, found) = balanced(&case, [0.0, -20e-6, 7e-6, 2e-3, 0.0]);
    for (found, expected) in bearing.constants().into_iter().zip([2.825_152_73e10, 2.495_806_07e10]) {
        assert!((found / expected - 1.0).abs() < 3e-9, "{found:e}");
    }
    for (found, expected) in [bearing.clearance, bearing.shifts()[0], bearing.shifts()[1]].into_iter().zip([
        29.749_151_46,
        50.321_156_4,
        -83.868_594,
    ]) {
        printed(found * 1e6, expected, 1e-7);
    }
    for (a, expected) in [(1, -21.693_518_5e-6), (2, 6.894_487_5e-6), (3, 2.196_72e-3)] {
        assert!((found.state[a] / expected - 1.0).abs() < 2e-7, "{}", found.state[a]);
    }
    let k = bearing.stiffness(std::array::from_fn(|a| found.state[a])).unwrap();
    for (row, column, expected) in [
        (0, 0, 1.327_950_8e8),
        (0, 4, -1.220_366_0e6),
        (1, 1, 1.597_560_6e8),
        (1, 2, 1.191_964_5e7),
        (1, 3, 1.4265e6),
        (2, 2, 7.437_204_6e7),
        (2, 3, 3.6895e5),
        (3, 3, 1.527_164_4e4),
        (4, 4, 1.227_929_4e4),
    ] {
        // Two of them are printed with five digits.
        let relative = if [(1, 3), (2, 3)].contains(&(row, column)) { 4e-5 } else { 3e-7 };
        assert!((k[row][column] / expected - 1.0).abs() < relative, "{row} {column}: {:e}", k[row][column]);
    }
    let held = bearing.held([2e-6, -3e-6, 20e-6, 1e-3, -0.5e-3]).unwrap();
    for (found, expected) in held.rings[0].into_iter().zip([
        -1_349.476_795_5,
        -1_368.610_475_3,
        -1_885.317_391_2,
        -16.518_287_5,
        15.044_718_3,
    ]) {
        printed(found, expected, 1e-6);
    }
    printed(held.balls[0].contacts[0].force, 49.426_435, 1e-6);
    printed(held.balls[0].contacts[0].angle.to_degrees(), 24.932_070, 1e-6);
}

/// The bearing of the angular contact figures turning so fast (rev/min).
fn turning(speed: f64, load: [f64; 5], gyroscopic: Gyroscopic) -> SpatialCase {
    SpatialCase { speed_hz: speed / 60.0, gyroscopic, ..angular(3, load) }
}

#[test]
fn centrifugal_force_parts_the_contact_angles_at_high_speed() {
    for (speed, angles, forces, z, k_zz, k_xx) in [
        (0.0, [26.703_322_3, 26.703_322_3], [92.722_239, 92.722_239], 10.564_815_8, 7.590_878_2e7, 1.448_756_4e8),
        (20e3, [31.522_500_6, 23.365_168_4], [79.693_970, 105.062_352], 8.845_035_1, 5.193_489_6e7, 9.526_353_4e7),
        (40e3, [40.370_401_9, 14.328_386_5], [64.327_571, 168.364_407], -5.948_135_4, 2.026_966_9e7, 2.546_596_1e7),
    ] {
        let case = turning(speed, [0.0, 0.0, 500.0, 0.0, 0.0], Gyroscopic::Nobody);
        let (bearing, found) = balanced(&case, [0.0, 0.0, z * 1e-6, 0.0, 0.0]);
        printed(found.state[2] * 1e6, z, 1e-7);
        for side in 0..2 {
            let touch = &found.held.balls[3].contacts[side];
            printed(touch.angle.to_degrees(), angles[side], 1e-7);
            printed(touch.force, forces[side], 1e-6);
        }
        let k = bearing.stiffness([0.0, 0.0, found.state[2], 0.0, 0.0]).unwrap();
        // Soft contacts at a small approach: the quotients' fourth order is larger.
        assert!((k[2][2] / k_zz - 1.0).abs() < 2e-6 && (k[0][0] / k_xx - 1.0).abs() < 2e-6, "{k:?}");
    }
    let case = turning(20e3, [0.0, -100.0, 500.0, 0.0, 0.0], Gyroscopic::Nobody);
    let (_, found) = balanced(&case, [0.0, -1e-6, 8.7e-6, 0.0, 0.0]);
    printed(found.state[1] * 1e6, -1.063_541_1, 1e-7);
    printed(found.state[2] * 1e6, 8.721_655_4, 1e-7);
    for (j, forces, angles) in [
        (0, [99.619_552, 125.033_090], [30.469_347, 23.829_202]),
        (6, [62.479_754, 87.811_246], [32.828_158, 22.689_187]),
    ] {
        for side in 0..2 {
            printed(found.held.balls[j].contacts[side].force, forces[side], 1e-6);
            printed(found.held.balls[j].contacts[side].angle.to_degrees(), angles[side], 1e-6);
        }
    }
}

#[test]
fn gyroscopic_couples_shift_the_balance_by_who_holds_them() {
    for (who, angles, z) in [
        (Gyroscopic::Outer, [33.218_716, 21.858_813], 6.934_069),
        (Gyroscopic::Shared, [31.685_681, 23.143_992], 8.360_800),
    ] {
        let case = turning(20e3, [0.0, 0.0, 500.0, 0.0, 0.0], who);
        let (bearing, found) = balanced(&case, [0.0, 0.0, 8e-6, 0.0, 0.0]);
        printed(found.state[2] * 1e6, z, 1e-6);
        let ball = &found.held.balls[0];
        for side in 0..2 {
            printed(ball.contacts[side].angle.to_degrees(), angles[side], 1e-6);
        }
        if who == Gyroscopic::Outer {
            let shaft = bearing.speeds[0];
            printed(bearing.gyroscopic_moment(shaft, bearing.ratios[0][0] * shaft, ball), 0.017_320_6, 1e-7);
        }
    }
}

#[test]
fn a_preloaded_pair_holds_along_the_axis_and_against_tilt_by_how_it_is_mounted() {
    let [left, right] = [25.0, -25.0].map(|degrees| {
        SpatialBearing::new(&SpatialCase { setting: AxialSetting::Angle(degrees), ..angular(5, [0.0; 5]) })
    });
    let along = |bearing: &SpatialBearing, z: f64| bearing.held([0.0, 0.0, z * 1e-6, 0.0, 0.0]).unwrap().rings[0][2];
    printed(-along(&left, 5.0), 153.930_271, 1e-6);
    printed(along(&right, -5.0), 153.930_271, 1e-6);
    let pair = |z: f64| -along(&left, z + 5.0) - along(&right, z - 5.0);
    printed(pair(1.0), 95.417_781, 1e-6);
    printed(pair(3.0), 283.431_470, 1e-6);
    let k = [(&left, 5e-6), (&right, -5e-6)].map(|(one, z)| one.stiffness([0.0, 0.0, z, 0.0, 0.0]).unwrap()[2][2]);
    assert!(((k[0] + k[1]) / 9.552_425_0e7 - 1.0).abs() < 2e-7, "{k:?}");
    // The relieved bearing opens where it is just closed again.
    printed(pair(5.0), 457.8874, 1e-4);
    // The shaft tilts by 0.1 mrad about the middle between them.
    let tilt = 1e-4;
    let moment = |at: [(&SpatialBearing, f64, f64); 2]| -> f64 {
        at.into_iter()
            .map(|(bearing, b, offset)| {
                let force = bearing.held([0.0, -b * tilt, offset, tilt, 0.0]).unwrap().rings[0];
                -(force[3] - b * force[1])
            })
            .sum()
    };
    printed(moment([(&left, -25e-3, 5e-6), (&right, 25e-3, -5e-6)]), 21.394_603, 1e-6);
    printed(moment([(&right, -25e-3, -5e-6), (&left, 25e-3, 5e-6)]), 4.968_967, 1e-6);
}
