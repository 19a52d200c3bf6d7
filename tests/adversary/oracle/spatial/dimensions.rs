//! The numbers of a bearing in space, from those of its case.

use super::bearing::SpatialBearing;
use super::case::{AxialSetting, SpatialCase};
use super::contact::{Dampers, Groove};
use super::surfaces::{Surfaces, Track};
use crate::case::Motion;
use crate::hertz;
use std::f64::consts::{PI, TAU};

/// Change of the operating angle (°) below which it is that of the balance.
const SETTLED: f64 = 1e-3;

impl SpatialBearing {
    pub fn new(case: &SpatialCase) -> Self {
        let free = match case.setting {
            AxialSetting::Angle(degrees) => Some(degrees),
            _ => None,
        };
        Self::at(case, case.operating_deg.or(free).unwrap_or_else(|| operating_angle(case)))
    }

    /// With this operating angle (°).
    fn at(case: &SpatialCase, operating_deg: f64) -> Self {
        let (d, pitch) = (case.diameter_mm * 1e-3, case.pitch_mm * 1e-3);
        let r = d / 2.0;
        let reach = case.conformities.map(|f| f * d - r);
        let (clearance, lean) = closed(case, reach[0] + reach[1]);
        let (r_o, r_i) = ((pitch + d + clearance) / 2.0, (pitch - d - clearance) / 2.0);
        let modulus = case.effective_modulus();
        let along = along_rolling(lean, [r_i, r_o], pitch, r);
        let curvatures = [0, 1].map(|side| [1.0 / r + along[side], 1.0 / r - 1.0 / (case.conformities[side] * d)]);
        let (sine, cosine, gamma) = (lean.map_or(0.0, f64::sin), (operating_deg * PI / 180.0).cos(), d / pitch);
        // Of the inner and the outer ring.
        let groove = |side: usize| {
            let (inwards, bottom) = [(1.0, r_i), (-1.0, r_o)][side];
            Groove {
                inner: side == 0,
                circle: bottom + inwards * case.conformities[side] * d,
                shift: inwards * reach[side] * sine,
                touching: reach[side],
                stiffness: case.hertz[side].unwrap_or_else(|| hertz::stiffness(curvatures[side], modulus)),
            }
        };
        let track = |side: usize| {
            let (inwards, bottom) = [(1.0, r_i), (-1.0, r_o)][side];
            Track { bottom, circle: bottom + inwards * case.conformities[side] * d * (1.0 - cosine), cosine }
        };
        let cage_start = case.cage_deg * PI / 180.0;
        Self {
            count: case.count,
            radius: r,
            rho_0: r_o - r,
            mass: case.mass_g.map_or(case.density * 4.0 / 3.0 * PI * r * r * r, |mass| mass * 1e-3),
            gravity: case.gravity,
            clearance,
            pitch,
            rings: case.rings,
            freedom: case.freedom,
            gyroscopic: case.gyroscopic,
            sense: if sine < 0.0 { -1.0 } else { 1.0 },
            grooves: [0, 1].map(groove),
            surfaces: Surfaces::new(&case.defects, [0, 1].map(track), r, (case.count, cage_start)),
            dampers: Dampers { normal: case.damping, across: case.across },
            inertia: case.inertia,
            quotients: 1.0,
            ratios: ratios(gamma, gamma * cosine, case.slip),
            cage_start,
            speeds: [case.speed_hz, case.housing_hz.unwrap_or(0.0)].map(|hz| TAU * hz),
            shoulders: [0, 1].map(|side| {
                case.shoulders_mm[side].map(|height| (1.0 - height * 1e-3 / (case.conformities[side] * d)).acos())
            }),
            halves: [0, 1].map(|side| hertz::half_length(curvatures[side]) / (case.conformities[side] * d)),
        }
    }
}

/// Radial clearance (m) of grooves whose centres are so far apart (m), and the free contact angle (rad) that is given.
fn closed(case: &SpatialCase, apart: f64) -> (f64, Option<f64>) {
    match case.setting {
        AxialSetting::Radial(um) => (um * 1e-6, None),
        AxialSetting::Play(um) => (apart * (1.0 - (um * 1e-6 / (2.0 * apart)).asin().cos()), None),
        AxialSetting::Angle(degrees) => {
            let free = degrees * PI / 180.0;
            (apart * (1.0 - free.cos()), Some(free))
        }
    }
}

/// Curvatures of both raceways along rolling (1/m): at a free contact angle, or at the grooves' bottoms.
fn along_rolling(lean: Option<f64>, [r_i, r_o]: [f64; 2], pitch: f64, r: f64) -> [f64; 2] {
    let Some(cos) = lean.map(f64::cos) else { return [1.0 / r_i, -1.0 / r_o] };
    [cos / (pitch / 2.0 - r * cos), -cos / (pitch / 2.0 + r * cos)]
}

/// Speeds of cage, shaft, housing and balls per speed of shaft and housing; `along` is γ cos α_n. A ball turns in its
/// pocket by the mean of rolling on both raceways, each seen from the cage.
fn ratios(gamma: f64, along: f64, slip: f64) -> [[f64; 2]; 4] {
    let cage = [1.0 - along, 1.0 + along].map(|part| 0.5 * part * (1.0 - slip));
    let spin = |speeds: [f64; 2]| {
        let of_cage = cage[0] * speeds[0] + cage[1] * speeds[1];
        let [inside, outside] = [(speeds[0] - of_cage) * (1.0 - along), (speeds[1] - of_cage) * (1.0 + along)];
        of_cage + 0.5 * (outside - inside) / gamma
    };
    [cage, [1.0, 0.0], [0.0, 1.0], [spin([1.0, 0.0]), spin([0.0, 1.0])]]
}

/// The operating angle (°) that a case leaves open: the mean of all contact angles' sizes in the balance of its scene
/// without defects, by their forces; 0 where a host moves a ring.
fn operating_angle(case: &SpatialCase) -> f64 {
    let (mut angle, smooth) = (0.0, SpatialCase { defects: Vec::new(), ..case.clone() });
    if case.rings.iter().any(|ring| ring.motion == Motion::Host) {
        return angle;
    }
    for _ in 0..20 {
        let Some(balance) = SpatialBearing::at(&smooth, angle).rest(None) else { break };
        let touches = balance.held.balls.iter().flat_map(|ball| ball.contacts);
        let [sum, total] =
            touches.fold([0.0; 2], |[sum, total], touch| [sum + touch.force * touch.angle.abs(), total + touch.force]);
        let next = (sum / total).to_degrees();
        let settled = (next - angle).abs() < SETTLED;
        angle = next;
        if settled {
            break;
        }
    }
    angle
}

#[test]
fn elements_turn_at_an_operating_angle_as_printed() {
    // 6205 at 10 Hz: FTF, BPFO, BPFI, BSF.
    for (degrees, expected) in [
        (0.0, [3.983_094, 35.847_848, 54.152_152, 23.567_477]),
        (15.0, [4.017_744, 36.159_700, 53.840_300, 23.635_597]),
        (40.0, [4.221_005, 37.989_045, 52.010_955, 23.987_638]),
    ] {
        let bearing = SpatialBearing::at(&SpatialCase::at_rest(), degrees);
        let [cage, shaft, _, spin] = bearing.ratios.map(|ratio| 10.0 * ratio[0]);
        let found = [cage, 9.0 * cage, 9.0 * (shaft - cage), (spin - cage).abs()];
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{degrees}: {found}");
        }
    }
}
