//! Kinematics of a bearing that rolls without sliding, at one contact angle α of both raceways, and its characteristic
//! frequencies.
//!
//! With γ = D_w/D_pw and γ' = γ cos α cage and elements turn at
//! ```text
//! ω_c = ½ [ω_i (1−γ') + ω_o (1+γ')] (1−slip)
//! ω_b = [ω_o (1+γ') − ω_i (1−γ')] / (2γ) · (1−s_b) + ω_c (1 − cos α)
//! ```
//! Slip is the cage's lag behind pure rolling. An element turns in its pocket about an axis that leans by α from the
//! bearing's, at ω_b − ω_c: the mean of rolling on both raceways, by half the difference of (ω_i − ω_c)(R_p − r cos α)
//! = −r (ω_b − ω_c) inside and (ω_o − ω_c)(R_p + r cos α) = r (ω_b − ω_c) outside, so that of the cage's motion only
//! the part along that axis counts, ω_c cos α. Without a contact angle ω_b is the absolute spin, which the cage's slip
//! leaves alone; s_b is its own lag. Angles of both contacts that differ, as centrifugal force makes them, move ω_c by
//! the second order of half their difference.

use crate::scene::{Bearing, Scene};
use std::f64::consts::TAU;

/// Speeds of cage and elements per speed of the inner ring, then of the outer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ratios {
    /// Of the cage.
    pub cage: [f64; 2],
    /// Of the elements' spin.
    pub spin: [f64; 2],
}

impl Ratios {
    /// Those of a bearing whose cage lags by `slip` and whose elements lag by `spin_slip`, at the operating angle that
    /// the scene gives, or none.
    pub fn new(bearing: &Bearing, slip: f64, spin_slip: f64) -> Self {
        Self::at(bearing, bearing.given_operating_angle().unwrap_or(0.0), slip, spin_slip)
    }

    /// The same at a contact angle (rad).
    pub fn at(bearing: &Bearing, angle: f64, slip: f64, spin_slip: f64) -> Self {
        let (gamma, cosine) = (bearing.element_diameter / bearing.pitch_diameter, libm::cos(angle));
        let along = gamma * cosine;
        let cage = [0.5 * (1.0 - along) * (1.0 - slip), 0.5 * (1.0 + along) * (1.0 - slip)];
        let rolling = |by: f64, cage: f64| by / (2.0 * gamma) * (1.0 - spin_slip) + cage * (1.0 - cosine);
        Self { cage, spin: [rolling(along - 1.0, cage[0]), rolling(1.0 + along, cage[1])] }
    }
}

/// Characteristic frequencies (Hz): how often parts of a bearing pass one another. None is negative.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frequencies {
    /// Ball pass frequency of the outer ring: Z |f_c − f_o|.
    pub bpfo: f64,
    /// Ball pass frequency of the inner ring: Z |f_i − f_c|.
    pub bpfi: f64,
    /// Ball spin frequency, against the cage: |f_b − f_c|.
    pub bsf: f64,
    /// Fundamental train (cage) frequency: |f_c|.
    pub ftf: f64,
}

impl Frequencies {
    /// Those of a scene at its speeds, either ring turning or not; all 0 where nothing turns.
    pub fn of(scene: &Scene) -> Self {
        let ratios = Ratios::new(&scene.bearing, scene.cage.slip, scene.cage.spin_slip);
        let speeds = [scene.shaft_speed, scene.housing_speed.unwrap_or(0.0)];
        Self::at(&ratios, scene.bearing.element_count, speeds.map(|speed| speed / TAU))
    }

    /// Those of `count` elements where the inner and the outer ring turn at these speeds (Hz).
    fn at(ratios: &Ratios, count: usize, [inner, outer]: [f64; 2]) -> Self {
        let of = |ratios: [f64; 2]| ratios[0] * inner + ratios[1] * outer;
        let (cage, spin) = (of(ratios.cage), of(ratios.spin));
        Self {
            bpfo: passage_frequency(count, cage, outer),
            bpfi: passage_frequency(count, cage, inner),
            bsf: (spin - cage).abs(),
            ftf: cage.abs(),
        }
    }
}

/// How often one of `count` elements passes a point of a ring (Hz), by the speeds of the cage and of that ring (Hz).
pub fn passage_frequency(count: usize, cage: f64, ring: f64) -> f64 {
    count as f64 * (cage - ring).abs()
}

/// Characteristic frequencies where the shaft turns at `speed_hz` (Hz) and the outer ring stands.
pub fn frequencies(bearing: &Bearing, slip: f64, speed_hz: f64) -> Frequencies {
    Frequencies::at(&Ratios::new(bearing, slip, 0.0), bearing.element_count, [speed_hz, 0.0])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn near(found: Frequencies, expected: [f64; 4]) {
        let found = [found.bpfo, found.bpfi, found.bsf, found.ftf];
        // Rounding of a dozen operations.
        let worst = found.iter().zip(expected).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-14, "{found:?} {expected:?}");
    }

    #[test]
    fn a_contact_angle_moves_the_frequencies_as_its_cosine_says() {
        let mut bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
        let at = |bearing: &Bearing| {
            let Frequencies { bpfo, bpfi, bsf, ftf } = frequencies(bearing, 0.0, 10.0);
            [ftf, bpfo, bpfi, bsf]
        };
        let plain = at(&bearing);
        for (degrees, expected) in [
            (0.0, [3.983_094, 35.847_848, 54.152_152, 23.567_477]),
            (15.0, [4.017_744, 36.159_700, 53.840_300, 23.635_597]),
            (-40.0, [4.221_005, 37.989_045, 52.010_955, 23.987_638]),
        ] {
            bearing.operating_angle = Some(f64::to_radians(degrees));
            for (found, expected) in at(&bearing).into_iter().zip(expected) {
                // Six decimals are given.
                assert!((found - expected).abs() < 1e-6, "{degrees}: {found} {expected}");
            }
        }
        bearing.operating_angle = Some(0.0);
        assert_eq!(at(&bearing), plain);
        // With no operating angle it is the free contact angle, if there is one.
        bearing.operating_angle = None;
        bearing.set_contact_angle(f64::to_radians(15.0));
        assert!((at(&bearing)[0] - 4.017_744).abs() < 1e-6);
        // Slip of the cage leaves the rolling of balls in their pockets to the part along their axis.
        let [rolling, slipping] = [0.0, 0.1].map(|slip| Ratios::new(&bearing, slip, 0.0));
        let [fast, slow] = [rolling, slipping].map(|ratios| ratios.spin[0] - ratios.cage[0]);
        let along_the_axis = libm::cos(f64::to_radians(15.0)) * (rolling.cage[0] - slipping.cage[0]);
        assert!((slow - fast - along_the_axis).abs() < 1e-15);
    }

    #[test]
    fn frequencies_are_those_of_the_motion_of_the_parts_against_each_other_and_never_negative() {
        let mut scene =
            Scene::builder(Bearing::steel_balls(9, 7.94e-3, 39.04e-3)).shaft_speed(TAU * 10.0).build().unwrap();
        let gamma = scene.bearing.element_diameter / scene.bearing.pitch_diameter;
        let (count, cage) = (scene.bearing.element_count as f64, 5.0 * (1.0 - gamma));
        let standing = [count * cage, count * (10.0 - cage), 5.0 * (1.0 - gamma * gamma) / gamma, cage];
        near(frequencies(&scene.bearing, 0.0, 10.0), standing);
        near(frequencies(&scene.bearing, 0.0, -10.0), standing);
        near(Frequencies::of(&scene), standing);
        // Both rings forward by 3 Hz: elements pass as before, the cage goes 3 Hz faster.
        (scene.shaft_speed, scene.housing_speed) = (TAU * 13.0, Some(TAU * 3.0));
        near(Frequencies::of(&scene), [standing[0], standing[1], standing[2], cage + 3.0]);
        // The outer ring alone, backwards: as many elements pass the inner ring as the shaft's 10 Hz would make.
        (scene.shaft_speed, scene.housing_speed) = (0.0, Some(-TAU * 10.0));
        near(Frequencies::of(&scene), [standing[0], standing[1], standing[2], 5.0 * (1.0 + gamma)]);
        (scene.shaft_speed, scene.housing_speed) = (0.0, None);
        assert_eq!(Frequencies::of(&scene), Frequencies { bpfo: 0.0, bpfi: 0.0, bsf: 0.0, ftf: 0.0 });
    }
}
