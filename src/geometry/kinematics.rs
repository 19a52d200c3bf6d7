//! Kinematics of an angular-contact-free ball bearing that rolls without sliding, and its characteristic frequencies.
//!
//! With γ = D_w/D_pw and contact angle 0 cage and elements turn at
//! ```text
//! ω_c = ½ [ω_i (1−γ) + ω_o (1+γ)] (1−slip)
//! ω_b = [ω_o (1+γ) − ω_i (1−γ)] / (2γ) · (1−s_b)
//! ```
//! Slip is the cage's lag behind pure rolling. The spin ω_b is absolute. It is the mean of rolling on both raceways, by
//! half the difference of ω_c R_p − r ω_b = ω_i R_i and ω_c R_p + r ω_b = ω_o R_o, so that the cage's slip leaves it
//! alone; s_b is its own lag.

use crate::scene::Bearing;

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

/// Characteristic frequencies (Hz) for an outer ring that stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frequencies {
    /// Ball pass frequency of the outer ring: Z f_c.
    pub bpfo: f64,
    /// Ball pass frequency of the inner ring: Z (f_s − f_c).
    pub bpfi: f64,
    /// Ball spin frequency.
    pub bsf: f64,
    /// Fundamental train (cage) frequency.
    pub ftf: f64,
}

/// Cage speed per inner ring speed, ω_c/ω_i, for an outer ring that stands.
pub fn cage_ratio(bearing: &Bearing, slip: f64) -> f64 {
    0.5 * (1.0 - bearing.element_diameter / bearing.pitch_diameter) * (1.0 - slip)
}

/// Characteristic frequencies at shaft frequency `speed_hz` (Hz).
pub fn frequencies(bearing: &Bearing, slip: f64, speed_hz: f64) -> Frequencies {
    let gamma = bearing.element_diameter / bearing.pitch_diameter;
    let z = bearing.element_count as f64;
    let ftf = cage_ratio(bearing, slip) * speed_hz;
    Frequencies { bpfo: z * ftf, bpfi: z * (speed_hz - ftf), bsf: 0.5 * speed_hz * (1.0 - gamma * gamma) / gamma, ftf }
}
