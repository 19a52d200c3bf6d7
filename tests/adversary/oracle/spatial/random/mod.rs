//! Random scenes in space.

mod defects;

use super::bearing::SpatialBearing;
use super::case::{AxialSetting, Gyroscopic, Host, SpatialCase, SpatialRing, Step};
use crate::case::{Damping, Motion};
use crate::draw::Draw;
use crate::turning::quadratic;
use std::f64::consts::{PI, TAU};

/// A scene with three or five degrees of freedom whose balls all have a place: pressed along the axis, or held.
pub fn random(draw: &mut Draw) -> SpatialCase {
    let mut case = bearing(draw);
    // Of steel about a thousandth of a ball's radius deep, and of what is softer no deeper; a quarter carry next to
    // nothing.
    let light = if draw.chance(0.25) { 1e-3 } else { 1.0 };
    let soft = (case.modulus_gpa / 207.0).min(1.0);
    let force = 1.5e3 * soft * (case.diameter_mm / 8.0).powi(2) * draw.log(0.02, 1.0) * light;
    let sense = match case.setting {
        AxialSetting::Angle(angle) => angle.signum(),
        _ => draw.sign(),
    };
    rings(draw, &mut case, force, sense);
    if draw.chance(0.35) {
        case.inertia = false;
        if case.housing_hz.is_none() && draw.chance(0.6) {
            case.gyroscopic = draw.pick(&[Gyroscopic::Outer, Gyroscopic::Shared]);
        }
    }
    let approach = 2.0 * (2.0 * force / (case.count as f64 * soft * 2e10)).cbrt().powi(2);
    defects::add(draw, &mut case, approach);
    let length = draw.log(5e-5, 4e-4);
    let mut moves = [[[0.0; 3]; 5]; 2];
    if draw.chance(0.15) {
        case.rings[1] = SpatialRing { motion: Motion::Host, ..SpatialRing::FIXED };
        let places = [(); 5].map(|()| draw.between(-1.0, 1.0));
        moves[1] = moving(draw, &case, length, places);
    }
    if draw.chance(0.3) {
        let rest = handed_over(&mut case, moves[1]);
        moves[0] = moving(draw, &case, length, [0.0; 5]);
        (0..5).for_each(|a| moves[0][a][0] = rest[a]);
    }
    steps(draw, &mut case, moves, length);
    case
}

fn bearing(draw: &mut Draw) -> SpatialCase {
    let (count, diameter_mm) = (4 + draw.below(14), draw.log(3.0, 25.0));
    let smallest = diameter_mm / (PI / count as f64).sin();
    let conformities = [0, 1].map(|_| draw.between(0.51, 0.55));
    let distance_um = (conformities[0] + conformities[1] - 1.0) * diameter_mm * 1e3;
    let setting = match draw.below(4) {
        // So loose that balls come to lie beyond the far groove's centres, if they are not pressed along the axis.
        0 if draw.chance(0.5) => AxialSetting::Radial(draw.between(0.2, 0.49) * distance_um),
        0 => AxialSetting::Radial(draw.between(-2e-4, 5e-3) * diameter_mm * 1e3),
        1 => AxialSetting::Play(draw.between(0.02, 0.8) * distance_um),
        2 => AxialSetting::Angle(draw.between(45.0, 60.0) * draw.sign()),
        _ => AxialSetting::Angle(draw.between(8.0, 40.0) * draw.sign()),
    };
    let steel = draw.chance(0.7);
    SpatialCase {
        freedom: if draw.chance(0.5) { 3 } else { 5 },
        gravity: if draw.chance(0.5) { [0.0, -9.81, 0.0] } else { [draw.between(-5.0, 5.0), -9.0, 3.0] },
        count,
        diameter_mm,
        pitch_mm: smallest * draw.between(1.1, 1.6),
        conformities,
        setting,
        operating_deg: draw.chance(0.6).then(|| draw.between(-35.0, 35.0)),
        shoulders_mm: conformities.map(|f| draw.chance(0.3).then(|| f * diameter_mm * draw.between(0.1, 0.7))),
        modulus_gpa: if steel { 207.0 } else { draw.log(2.0, 400.0) },
        poisson: if steel { 0.3 } else { draw.between(0.15, 0.4) },
        // Of every fourth bearing, without a draw of its own: silicon nitride.
        element: (count % 4 == 3).then_some([310.0, 0.26]),
        mass_g: draw.chance(0.2).then(|| 4e-3 * diameter_mm.powi(3) * draw.log(0.3, 3.0)),
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
        ..SpatialCase::at_rest()
    }
}

/// Gives the shaft to the host where it would rest, if that is found, and says where.
fn handed_over(case: &mut SpatialCase, housing: [[f64; 3]; 5]) -> [f64; 5] {
    let host = said(case, [case.rings[0].load.map(|load| [load, 0.0, 0.0]), housing]);
    let Some(rest) = SpatialBearing::new(case).rest(Some(&host)) else { return [0.0; 5] };
    case.rings[0] = SpatialRing { motion: Motion::Host, ..SpatialRing::FIXED };
    std::array::from_fn(|a| rest.state[a])
}

fn said(case: &SpatialCase, rings: [[[f64; 3]; 5]; 2]) -> Host {
    Host { speeds: [case.speed_hz, case.housing_hz.unwrap_or(0.0)].map(|hz| [TAU * hz, 0.0]), rings }
}

fn rings(draw: &mut Draw, case: &mut SpatialCase, force: f64, sense: f64) {
    let across = force * draw.between(0.0, 0.5);
    let [x, y] = draw.vector(across);
    let moment = force * case.pitch_mm * 1e-3 * draw.between(0.0, 0.1);
    let [moment_x, moment_y] = draw.vector(moment);
    let mass = draw.log(0.3, 10.0);
    let transverse = mass * (case.pitch_mm * 1e-3).powi(2) * draw.between(0.5, 3.0);
    // A preload pushes in the sense of the contact angle alone.
    let springs = sense > 0.0 || matches!(case.setting, AxialSetting::Angle(_));
    let mut preload = |share: f64| if springs && draw.chance(share) { 0.3 * force } else { 0.0 };
    let preloads = [preload(0.3), preload(0.2)];
    case.rings[0] = SpatialRing {
        load: [x, y, force * sense, moment_x, moment_y],
        preload: preloads[0],
        damping: [draw.log(100.0, 3000.0), draw.log(100.0, 3000.0), draw.log(0.05, 2.0)],
        // A tilt that only balls hold may not hold at all.
        stiffness: [0.0, if draw.chance(0.3) { 1e5 } else { 0.0 }, draw.log(1e3, 1e5)],
        inertia: [transverse, transverse * draw.between(0.3, 1.9)],
        ..SpatialRing::free(mass, [0.0; 5])
    };
    if case.freedom == 3 {
        case.rings[0].load[3..].fill(0.0);
    }
    if draw.chance(0.4) {
        case.rings[1] = SpatialRing {
            preload: preloads[1],
            damping: [2000.0, 2000.0, 0.0],
            stiffness: [draw.log(1e7, 1e8), draw.log(1e7, 1e8), 0.0],
            ..SpatialRing::free(draw.log(1.0, 10.0), [0.0; 5])
        };
    }
}

/// How far a host moves a ring in a step, tilts by a pitch radius (m, rad).
fn reach(draw: &mut Draw, case: &SpatialCase) -> [f64; 5] {
    let far = draw.log(3e-9, 1e-7) * case.diameter_mm;
    [1.0, 1.0, 1.0, 2e3 / case.pitch_mm, 2e3 / case.pitch_mm].map(|unit| unit * far)
}

/// Places of a ring that the host moves, in reaches, with the velocities that half of them have from the start on.
fn moving(draw: &mut Draw, case: &SpatialCase, length: f64, places: [f64; 5]) -> [[f64; 3]; 5] {
    let (far, fast) = (reach(draw, case), draw.chance(0.5));
    let mut moves: [[f64; 3]; 5] = std::array::from_fn(|a| {
        [far[a] * places[a], if fast { far[a] / length * draw.between(-1.0, 1.0) } else { 0.0 }, 0.0]
    });
    moves[case.freedom..].fill([0.0; 3]);
    moves
}

fn steps(draw: &mut Draw, case: &mut SpatialCase, mut moves: [[[f64; 3]; 5]; 2], length: f64) {
    for i in 0..6 {
        let first = i == 0;
        let (share, says) = (if first { 1.0 } else { draw.between(0.8, 1.2) }, first || draw.chance(0.7));
        let rate = if first { 0.0 } else { TAU * case.speed_hz * draw.between(-1.0, 1.0) };
        let ramp = if first || draw.chance(0.5) { 0.0 } else { draw.between(-0.1, 0.1) / length };
        if says && !first {
            for ring in &mut moves {
                let far = reach(draw, case);
                (0..case.freedom).for_each(|a| ring[a][2] = 2.0 * far[a] / length.powi(2) * draw.between(-1.0, 1.0));
            }
        }
        let rings = [0, 1].map(|which| match case.rings[which].motion {
            Motion::Internal => case.rings[which].load.map(|load| [load * share, load * ramp, 0.0]),
            Motion::Host => moves[which],
            Motion::Fixed => [[0.0; 3]; 5],
        });
        let mut host = said(case, rings);
        host.speeds[0][1] = rate;
        case.steps.push(Step { length, host: says.then_some(host) });
        moves = moves.map(|ring| ring.map(|c| quadratic(c, length)));
    }
}
