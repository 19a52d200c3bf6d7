//! Kinematics of an angular-contact-free ball bearing that rolls without sliding, and its characteristic frequencies.
//!
//! With γ = D_w/D_pw and contact angle 0, the cage turns at ω_c = ½[ω_i(1−γ) + ω_o(1+γ)](1−slip). Here ω_o = 0: the
//! outer ring does not turn. Slip is the cage's lag behind pure rolling.

use crate::scene::Bearing;

/// Characteristic frequencies [Hz] for an outer ring that stands.
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

/// Characteristic frequencies at shaft frequency `speed_hz` [Hz].
pub fn frequencies(bearing: &Bearing, slip: f64, speed_hz: f64) -> Frequencies {
    let gamma = bearing.element_diameter / bearing.pitch_diameter;
    let z = bearing.element_count as f64;
    let ftf = cage_ratio(bearing, slip) * speed_hz;
    Frequencies { bpfo: z * ftf, bpfi: z * (speed_hz - ftf), bsf: 0.5 * speed_hz * (1.0 - gamma * gamma) / gamma, ftf }
}
