//! Kinematics of a radial bearing, without a contact angle, that rolls without sliding, and its characteristic
//! frequencies.
//!
//! With γ = D_w/D_pw and contact angle 0 cage and elements turn at
//! ```text
//! ω_c = ½ [ω_i (1−γ) + ω_o (1+γ)] (1−slip)
//! ω_b = [ω_o (1+γ) − ω_i (1−γ)] / (2γ) · (1−s_b)
//! ```
//! Slip is the cage's lag behind pure rolling. The spin ω_b is absolute. It is the mean of rolling on both raceways, by
//! half the difference of ω_c R_p − r ω_b = ω_i R_i and ω_c R_p + r ω_b = ω_o R_o, so that the cage's slip leaves it
//! alone; s_b is its own lag.

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
    /// Those of a bearing whose cage lags by `slip` and whose elements lag by `spin_slip`.
    pub fn new(bearing: &Bearing, slip: f64, spin_slip: f64) -> Self {
        let gamma = bearing.element_diameter / bearing.pitch_diameter;
        let rolling = |by: f64| by / (2.0 * gamma) * (1.0 - spin_slip);
        Self {
            cage: [cage_ratio(bearing, slip), 0.5 * (1.0 + gamma) * (1.0 - slip)],
            spin: [rolling(gamma - 1.0), rolling(1.0 + gamma)],
        }
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

/// Cage speed per inner ring speed, ω_c/ω_i, for an outer ring that stands.
pub fn cage_ratio(bearing: &Bearing, slip: f64) -> f64 {
    0.5 * (1.0 - bearing.element_diameter / bearing.pitch_diameter) * (1.0 - slip)
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
