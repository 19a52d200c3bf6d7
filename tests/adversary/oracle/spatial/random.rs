//! Random scenes in space.

use super::bearing::SpatialBearing;
use super::case::{AxialSetting, Body, Gyroscopic, Host, Spall, SpatialCase, SpatialRing, Step};
use crate::case::{Damping, Motion};
use crate::draw::Draw;
use crate::turning::quadratic;
use std::f64::consts::{PI, TAU};

/// A scene with three or five degrees of freedom whose balls all have a place: pressed along the axis, or held.
pub fn random(draw: &mut Draw) -> SpatialCase {
    let (count, diameter_mm) = (4 + draw.below(14), draw.log(3.0, 25.0));
    let smallest = diameter_mm / (PI / count as f64).sin();
    let conformities = [0, 1].map(|_| draw.between(0.51, 0.55));
    let distance_um = (conformities[0] + conformities[1] - 1.0) * diameter_mm * 1e3;
    let setting = match draw.below(4) {
        0 => AxialSetting::Radial(draw.between(-2e-4, 5e-3) * diameter_mm * 1e3),
        1 => AxialSetting::Play(draw.between(0.02, 0.8) * distance_um),
        _ => AxialSetting::Angle(draw.between(8.0, 40.0) * draw.sign()),
    };
    let freedom = if draw.chance(0.5) { 3 } else { 5 };
    // About a thousandth of a ball's radius deep.
    let force = 1.5e3 * (diameter_mm / 8.0).powi(2) * draw.log(0.02, 1.0);
    let sense = match setting {
        AxialSetting::Angle(angle) => angle.signum(),
        _ => draw.sign(),
    };
    let mut case = SpatialCase {
        freedom,
        gravity: if draw.chance(0.5) { [0.0, -9.81, 0.0] } else { [draw.between(-5.0, 5.0), -9.0, 3.0] },
        count,
        diameter_mm,
        pitch_mm: smallest * draw.between(1.1, 1.6),
        conformities,
        setting,
        operating_deg: draw.between(0.0, 35.0),
        hertz: [0, 1].map(|_| draw.chance(0.1).then(|| draw.log(5e9, 5e10))),
        damping: if draw.chance(0.7) {
            Damping::HuntCrossley(draw.log(0.05, 1.0))
        } else {
            Damping::Proportional(draw.log(1e-7, 3e-6))
        },
        across: draw.log(0.05, 2.0),
        slip: if draw.chance(0.7) { 0.0 } else { draw.between(0.0, 0.3) },
        cage_deg: draw.between(-180.0, 180.0),
        speed_hz: draw.log(5.0, 200.0) * draw.sign(),
        housing_hz: draw.chance(0.2).then(|| draw.between(-30.0, 30.0)),
        tolerance: draw.pick(&[1e-8, 1e-9, 1e-10]),
        gyroscopic: Gyroscopic::Nobody,
        ..SpatialCase::at_rest()
    };
    rings(draw, &mut case, force, sense);
    if draw.chance(0.5) {
        let on = if draw.chance(0.5) { Body::Inner } else { Body::Outer };
        let length_mm = draw.between(0.02, 0.25) * diameter_mm;
        let angle_deg = draw.between(-180.0, 180.0);
        case.spalls.push(Spall { on, angle_deg, length_mm, depth_um: draw.log(1.0, 200.0) });
    }
    let at = if draw.chance(0.3) { handed_over(&mut case, sense) } else { [0.0; 5] };
    steps(draw, &mut case, at);
    case
}

/// Gives the shaft to the host where it would rest, if that is found, and says where.
fn handed_over(case: &mut SpatialCase, sense: f64) -> [f64; 5] {
    let Some(rest) = SpatialBearing::new(case).balance(None, [0.0, 0.0, sense * 20e-6, 0.0, 0.0]) else {
        return [0.0; 5];
    };
    case.rings[0] = SpatialRing { motion: Motion::Host, ..SpatialRing::FIXED };
    std::array::from_fn(|a| rest.state[a])
}

fn rings(draw: &mut Draw, case: &mut SpatialCase, force: f64, sense: f64) {
    let across = force * draw.between(0.0, 0.5);
    let [x, y] = draw.vector(across);
    let moment = force * case.pitch_mm * 1e-3 * draw.between(0.0, 0.1);
    let [moment_x, moment_y] = draw.vector(moment);
    let mass = draw.log(0.3, 10.0);
    let transverse = mass * (case.pitch_mm * 1e-3).powi(2) * draw.between(0.5, 3.0);
    let shaft = SpatialRing {
        load: [x, y, force * sense, moment_x, moment_y],
        preload: if draw.chance(0.3) { 0.3 * force } else { 0.0 },
        damping: [draw.log(100.0, 3000.0), draw.log(100.0, 3000.0), draw.log(0.05, 2.0)],
        // A tilt that only balls hold may not hold at all.
        stiffness: [0.0, if draw.chance(0.3) { 1e5 } else { 0.0 }, draw.log(1e3, 1e5)],
        inertia: [transverse, transverse * draw.between(0.3, 1.9)],
        ..SpatialRing::free(mass, [0.0; 5])
    };
    case.rings[0] = shaft;
    if case.freedom == 3 {
        case.rings[0].load[3..].fill(0.0);
    }
    // A preload pushes in the sense of the contact angle alone.
    if sense < 0.0 && !matches!(case.setting, AxialSetting::Angle(_)) {
        case.rings[0].preload = 0.0;
    }
    if draw.chance(0.4) {
        case.rings[1] = SpatialRing {
            damping: [2000.0, 2000.0, 0.0],
            stiffness: [draw.log(1e7, 1e8), draw.log(1e7, 1e8), 0.0],
            ..SpatialRing::free(draw.log(1.0, 10.0), [0.0; 5])
        };
    }
}

fn steps(draw: &mut Draw, case: &mut SpatialCase, at: [f64; 5]) {
    let length = draw.log(5e-5, 4e-4);
    let speeds = [TAU * case.speed_hz, TAU * case.housing_hz.unwrap_or(0.0)];
    // Of what the host moves, place, velocity and acceleration; tilts by a pitch radius.
    let mut moves = at.map(|place| [place, 0.0, 0.0]);
    let far = [1.0, 1.0, 1.0, 2e3 / case.pitch_mm, 2e3 / case.pitch_mm].map(|unit| unit * 1e-8 * case.diameter_mm);
    for i in 0..6 {
        let share = if i == 0 { 1.0 } else { draw.between(0.8, 1.2) };
        let rate = if i == 0 { 0.0 } else { speeds[0] * draw.between(-1.0, 1.0) };
        let says = i == 0 || draw.chance(0.7);
        if says && i > 0 {
            (0..case.freedom).for_each(|a| moves[a][2] = 2.0 * far[a] / length.powi(2) * draw.between(-1.0, 1.0));
        }
        let rings = case.rings.map(|ring| match ring.motion {
            Motion::Internal => ring.load.map(|load| [load * share, 0.0, 0.0]),
            Motion::Host => moves,
            Motion::Fixed => [[0.0; 3]; 5],
        });
        let host = Host { speeds: [[speeds[0], rate], [speeds[1], 0.0]], rings };
        case.steps.push(Step { length, host: says.then_some(host) });
        moves = moves.map(|c| quadratic(c, length));
    }
}
