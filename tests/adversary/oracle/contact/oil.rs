//! Oil between elements and raceways: Hamrock and Dowson's film where they are pressed together, and what it takes to
//! press oil out of a gap g that closes.
//!
//! ```text
//! h/R_x = 2.69 U^0.67 G^0.53 W^−0.067 (1 − 0.61 e^(−0.73 k))
//! U = η ū/(E′R_x),   G = αE′,   W = Q/(E′R_x²),   k = 1.03 (R_y/R_x)^0.64
//! F = c g'/g (1 − g/H)²,   c = 12πη (R_xR_y)^1.5/(R_x + R_y);   within the contact, Δ ≥ 0: g = h, and (1 − Δ/h)² of it
//! ```
//! with E′ = E/(1 − ν²), Q the most loaded contact's of five in Z, W at least 1e-5, and surfaces no nearer than their
//! asperities.

use crate::case::Case;
use std::f64::consts::PI;

/// Height of asperities (m): no gap is smaller.
pub const THINNEST: f64 = 0.02e-6;

/// Oil in both raceways' contacts.
#[derive(Debug, Clone)]
pub struct Oil {
    /// c (N s), inner and outer.
    pub squeeze: [f64; 2],
    /// Thickness (m) at a rolling speed of 1 m/s.
    thickness: [f64; 2],
    /// Height up to which oil stands (m).
    layer: f64,
    /// Rolling speed (m/s) per speed of one ring against the other (rad/s).
    rolling: f64,
}

/// What a film adds to a contact.
#[derive(Debug, Clone, Copy, Default)]
pub struct Resistance {
    pub force: f64,
    pub by_rate: f64,
    /// Bound of ∂F/∂Δ (N/m).
    pub steep: f64,
}

impl Oil {
    /// Radii of element and raceways (m), conformities, and E/(2(1−ν²)) (Pa); `None` without oil.
    pub fn new(case: &Case, [r, inner, outer]: [f64; 3], conformities: [f64; 2], modulus: f64) -> Option<Self> {
        let film = case.film?;
        let load = case.rings.iter().map(|ring| ring.load[0].hypot(ring.load[1])).fold(0.0, f64::max);
        let stiff = 2.0 * modulus;
        let curvatures = [1.0 / r + 1.0 / inner, 1.0 / r - 1.0 / outer];
        let sides = [0, 1].map(|side| {
            let along = 1.0 / curvatures[side];
            let across = 1.0 / (1.0 / r - 1.0 / (2.0 * conformities[side] * r));
            let squeeze = 12.0 * PI * film.viscosity * (along * across).powf(1.5) / (along + across);
            let k = 1.03 * (across / along).powf(0.64);
            let w = (5.0 * load / case.count as f64 / (stiff * along * along)).max(1e-5);
            let h = 2.69
                * along
                * (film.viscosity / (stiff * along)).powf(0.67)
                * (film.pressure_viscosity * stiff).powf(0.53)
                * w.powf(-0.067)
                * (1.0 - 0.61 * (-0.73 * k).exp());
            [squeeze, h]
        });
        let gamma = case.diameter_mm / case.pitch_mm;
        Some(Self {
            squeeze: sides.map(|side| side[0]),
            thickness: sides.map(|side| side[1]),
            layer: film.layer_um.map_or(f64::INFINITY, |layer| layer * 1e-6),
            rolling: 0.25e-3 * case.pitch_mm * (1.0 - gamma * gamma),
        })
    }

    /// Thickness (m) of the inner and the outer film while the inner ring turns so fast against the outer one (rad/s).
    pub fn films(&self, speed: f64) -> [f64; 2] {
        self.thickness.map(|thickness| thickness * (self.rolling * speed.abs()).powf(0.67))
    }

    /// What resists at an approach (m) and its rate (m/s), beside a film of this thickness (m).
    pub fn resistance(&self, side: usize, film: f64, approach: f64, rate: f64) -> Resistance {
        let h = film.max(THINNEST);
        let gap = if approach < 0.0 { h - approach } else { h };
        let filled = (1.0 - gap / self.layer).max(0.0);
        let unloaded = if approach > 0.0 { (1.0 - approach / h).max(0.0) } else { 1.0 };
        if rate <= 0.0 {
            return Resistance::default();
        }
        let by_rate = self.squeeze[side] / gap * (filled * unloaded).powi(2);
        Resistance { force: by_rate * rate, by_rate, steep: 3.0 * self.squeeze[side] / (gap * gap) * rate }
    }

    /// Largest ∂F/∂(rate) of a contact (N s/m).
    pub fn strongest(&self, side: usize) -> f64 {
        self.squeeze[side] / THINNEST
    }
}
