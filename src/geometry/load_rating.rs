//! Load ratings of a radial bearing of one row and its equivalent load, as the standards define them, for every contact
//! angle α. With γ = D cos α/D_pw, in N and mm:
//! ```text
//! balls    C  = b_m f_c (cos α)^0.7 Z^(2/3) D^1.8           (3.647 D^1.4 in place of D^1.8 above 25.4 mm), b_m = 1.3
//!          C₀ = f₀ Z D² cos α
//! rollers  C  = b_m f_c (L cos α)^(7/9) Z^(3/4) D^(29/27),   b_m = 1.1
//!          C₀ = 44 (1 − γ) Z L D cos α
//!          P  = X F_r + Y F_a,   F_r where F_a/F_r ≤ e
//! ```
//! (ISO 281:2007, 5.1, 7.1 and table 3; ISO 76:2006, 5.1 and 7.1). f_c and f₀ are worked out and agree with the
//! standards' tables to their last digit. f_c of balls is Lundberg and Palmgren's with the constants of ISO/TR 1281-1,
//! reduced by λ = 0.95; f₀ is the load of the most loaded ball, a fifth, at 4200 MPa between steel of 207 GPa (ISO/TR
//! 10657). Grooves closer than 0.52 of a ball, and outside 0.53 under C₀, gain nothing in the standards.
//!
//! Makers' catalogues have these values for C₀, of bearings whose inside is known to 2 %. Their C is higher for better
//! steel and finish: SKF's (catalogue 17000/1 EN, 2018) by 5 % of deep groove bearings and by 13 to 16 % of cylindrical
//! roller bearings but NU 202, which is not of that class.

use super::STRIBECK;
use super::hertz_constant::squared_eccentricity;
use crate::numerics::elementary::elliptic;
use crate::scene::{Bearing, RollingElement};
use libm::{cos, pow};
use std::f64::consts::TAU;

/// Largest Hertz pressure of ISO 76 in a ball bearing (Pa).
const STATIC_PRESSURE: f64 = 4200e6;
/// E* (Pa) of the standard's steel.
const STEEL: f64 = 207e9 / (2.0 * (1.0 - 0.3 * 0.3));
/// b_m times the constant of f_c and its reduction: of balls 0.41 · 98.0665 λ with λ = 0.95, of rollers 207.9 λν with
/// λν = 0.83; N and mm.
const BALLS: f64 = 1.3 * 0.41 * 98.0665 * 0.95;
const ROLLERS: f64 = 1.1 * 207.9 * 0.83;
/// ISO 281 counts larger balls by another power of their diameter (mm).
const LARGE: f64 = 25.4;
/// Conformities for which the standards hold; closer grooves gain nothing.
const CLOSEST: f64 = 0.52;
const CLOSEST_OUTSIDE: f64 = 0.53;

/// Load ratings of a bearing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadRatings {
    /// Basic dynamic load rating C (N), ISO 281.
    pub dynamic: f64,
    /// Basic static load rating C₀ (N), ISO 76.
    pub fixed: f64,
    /// f₀ of ball bearings (N/mm²), by which factors of the equivalent load are looked up; `None` of rollers.
    pub f0: Option<f64>,
    /// Contact angle (degrees).
    angle: f64,
}

/// Factors of an equivalent dynamic load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadFactors {
    /// F_a/F_r up to which the axial load does not count.
    pub e: f64,
    /// X beyond it.
    pub radial: f64,
    /// Y beyond it.
    pub axial: f64,
}

/// Those of a bearing with the nominal contact angle that it is given; 0 without.
pub fn load_ratings(bearing: &Bearing) -> LoadRatings {
    let (count, diameter) = (bearing.element_count as f64, 1e3 * bearing.element_diameter);
    let angle = bearing.contact_angle.unwrap_or(0.0).abs();
    let lean = cos(angle);
    let gamma = bearing.element_diameter * lean / bearing.pitch_diameter;
    let angle = angle.to_degrees();
    match &bearing.element {
        RollingElement::CylindricalRoller(roller) => {
            let length = 1e3 * roller.length;
            let size = pow(length * lean, 7.0 / 9.0) * pow(count, 0.75) * pow(diameter, 29.0 / 27.0);
            let fixed = 44.0 * (1.0 - gamma) * count * length * diameter * lean;
            LoadRatings { dynamic: ROLLERS * of_rollers(gamma) * size, fixed, f0: None, angle }
        }
        RollingElement::Ball => {
            let conformities = [bearing.conformity_inner, bearing.conformity_outer];
            let power = if diameter <= LARGE { pow(diameter, 1.8) } else { 3.647 * pow(diameter, 1.4) };
            let dynamic = BALLS * of_balls(gamma, conformities) * pow(lean, 0.7) * pow(count, 2.0 / 3.0) * power;
            let f0 = static_factor(gamma, conformities);
            LoadRatings { dynamic, fixed: f0 * count * diameter * diameter * lean, f0: Some(f0), angle }
        }
    }
}

/// f_c of rollers over its constant.
fn of_rollers(gamma: f64) -> f64 {
    let share = (1.0 - gamma) / (1.0 + gamma);
    let both = pow(1.0 + pow(1.04 * pow(share, 143.0 / 108.0), 4.5), -2.0 / 9.0);
    both * pow(gamma, 2.0 / 9.0) * pow(1.0 - gamma, 29.0 / 27.0) / pow(1.0 + gamma, 0.25)
}

/// f_c of balls over its constant.
fn of_balls(gamma: f64, conformities: [f64; 2]) -> f64 {
    let [inner, outer] = conformities.map(|f| f.max(CLOSEST));
    let groove = |f: f64| 2.0 * f / (2.0 * f - 1.0);
    let osculation = pow(inner / outer * (2.0 * outer - 1.0) / (2.0 * inner - 1.0), 0.41);
    let share = (1.0 - gamma) / (1.0 + gamma);
    let both = pow(1.0 + pow(1.04 * pow(share, 1.72) * osculation, 10.0 / 3.0), -0.3);
    both * pow(gamma, 0.3) * pow(1.0 - gamma, 1.39) / pow(1.0 + gamma, 1.0 / 3.0) * pow(groove(inner), 0.41)
}

/// f₀ (N/mm²).
fn static_factor(gamma: f64, [inner, outer]: [f64; 2]) -> f64 {
    let of = |along: f64, conformity: f64| ball_at_static_pressure([along, 2.0 - 1.0 / conformity]);
    let inner = of(2.0 / (1.0 - gamma), inner.max(CLOSEST));
    let outer = of(2.0 / (1.0 + gamma), outer.max(CLOSEST_OUTSIDE));
    1e-6 * inner.min(outer) / STRIBECK
}

/// Force over D² (Pa) at ISO 76's pressure, for the relative curvatures times D: p = 3Q/(2πab), a³ = 3Q(K − E)/(2πE* e²
/// A) and b² = a²(1 − e²).
fn ball_at_static_pressure([along, across]: [f64; 2]) -> f64 {
    let m = squared_eccentricity(along.max(across) / along.min(across));
    let (k, e) = elliptic::complete(m);
    let major = libm::cbrt(3.0 * (k - e) / (TAU * STEEL * m * 0.5 * along.min(across)));
    let area = STATIC_PRESSURE * TAU * major * major * (1.0 - m).sqrt() / 3.0;
    area * area * area
}

/// A column of ISO 281's table 3: the contact angle (degrees), X, and e and Y along [`RELATIVE_LOADS`]; from 20 degrees
/// on one pair.
struct Column(f64, f64, [[f64; 2]; 9]);

/// f₀F_a/C₀ of the rows, to 4 % the same for all angles.
const RELATIVE_LOADS: [f64; 9] = [0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89];
const COLUMNS: [Column; 9] = [
    Column(
        5.0,
        0.56,
        [
            [0.19, 2.30],
            [0.22, 1.99],
            [0.26, 1.71],
            [0.28, 1.55],
            [0.30, 1.45],
            [0.34, 1.31],
            [0.38, 1.15],
            [0.42, 1.04],
            [0.44, 1.00],
        ],
    ),
    Column(
        10.0,
        0.46,
        [
            [0.29, 1.88],
            [0.32, 1.71],
            [0.36, 1.52],
            [0.38, 1.41],
            [0.40, 1.34],
            [0.44, 1.23],
            [0.49, 1.10],
            [0.54, 1.01],
            [0.54, 1.00],
        ],
    ),
    Column(
        15.0,
        0.44,
        [
            [0.38, 1.47],
            [0.40, 1.40],
            [0.43, 1.30],
            [0.46, 1.23],
            [0.47, 1.19],
            [0.50, 1.12],
            [0.55, 1.02],
            [0.56, 1.00],
            [0.56, 1.00],
        ],
    ),
    Column(20.0, 0.43, [[0.57, 1.00]; 9]),
    Column(25.0, 0.41, [[0.68, 0.87]; 9]),
    Column(30.0, 0.39, [[0.80, 0.76]; 9]),
    Column(35.0, 0.37, [[0.95, 0.66]; 9]),
    Column(40.0, 0.35, [[1.14, 0.57]; 9]),
    Column(45.0, 0.33, [[1.34, 0.50]; 9]),
];

impl LoadRatings {
    /// Factors of the equivalent load under an axial load (N), between the table's angles and loads in proportion;
    /// `None` of rollers, which carry none.
    pub fn factors(&self, axial: f64) -> Option<LoadFactors> {
        let relative = self.f0? * axial.abs() / self.fixed;
        let angles = COLUMNS.map(|Column(angle, ..)| angle);
        let (column, beside) = between(&angles, self.angle);
        let (row, below) = between(&RELATIVE_LOADS, relative);
        let of = |Column(_, x, rows): &Column| {
            let mixed = |part: usize| rows[row][part] + below * (rows[row + 1][part] - rows[row][part]);
            [mixed(0), *x, mixed(1)]
        };
        let (here, next) = (of(&COLUMNS[column]), of(&COLUMNS[column + 1]));
        let mixed = |part: usize| here[part] + beside * (next[part] - here[part]);
        Some(LoadFactors { e: mixed(0), radial: mixed(1), axial: mixed(2) })
    }

    /// Equivalent dynamic load P (N) of a radial and an axial load (N); without the axial one of rollers.
    pub fn equivalent(&self, radial: f64, axial: f64) -> f64 {
        let (radial, axial) = (radial.abs(), axial.abs());
        match self.factors(axial) {
            Some(LoadFactors { e, radial: x, axial: y }) if axial > e * radial => x * radial + y * axial,
            _ => radial,
        }
    }
}

/// The interval of an ascending list that has a value, and the part of it that is below; the ends go on.
fn between(list: &[f64; 9], value: f64) -> (usize, f64) {
    let index = list.partition_point(|known| *known <= value).clamp(1, list.len() - 1) - 1;
    (index, ((value - list[index]) / (list[index + 1] - list[index])).clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// D cos α/D_pw, f_c of balls and f₀ (ISO 281, table 2; ISO 76, table 1), f_c of rollers (ISO 281, table 7).
    const TABLES: [(f64, [f64; 3]); 9] = [
        (0.02, [35.8, 15.1, 60.8]),
        (0.05, [46.7, 15.7, 74.1]),
        (0.08, [52.8, 16.3, 81.2]),
        (0.12, [57.5, 15.9, 86.4]),
        (0.16, [59.6, 14.9, 88.5]),
        (0.20, [59.9, 14.0, 88.7]),
        (0.24, [59.0, 13.0, 87.5]),
        (0.28, [57.1, 12.1, 85.2]),
        (0.30, [56.0, 11.6, 83.8]),
    ];

    #[test]
    fn factors_are_those_of_the_standards_tables() {
        for (gamma, [balls, f0, rollers]) in TABLES {
            let found = [
                BALLS / 1.3 * of_balls(gamma, [CLOSEST; 2]),
                static_factor(gamma, [CLOSEST; 2]),
                ROLLERS / 1.1 * of_rollers(gamma),
            ];
            for (found, printed) in found.into_iter().zip([balls, f0, rollers]) {
                // One unit of the last printed digit.
                assert!((found - printed).abs() < 0.1, "{gamma}: {found}, printed {printed}");
            }
        }
    }

    #[test]
    fn the_equivalent_load_has_the_standards_factors_at_its_angles_and_loads() {
        let mut bearing = Bearing::steel_balls(14, 9.525e-3, 46e-3);
        bearing.set_contact_angle(40f64.to_radians());
        let steep = load_ratings(&bearing);
        assert_eq!(steep.equivalent(1000.0, 1000.0), 1000.0);
        // 0.35 F_r + 0.57 F_a.
        assert!((steep.equivalent(1000.0, 2000.0) - 1490.0).abs() < 1e-9, "{}", steep.equivalent(1000.0, 2000.0));
        bearing.contact_angle = None;
        let flat = load_ratings(&bearing);
        let axial = 0.689 * flat.fixed / flat.f0.unwrap();
        let LoadFactors { e, radial, axial: y } = flat.factors(axial).unwrap();
        assert!([e - 0.26, radial - 0.56, y - 1.71].iter().all(|off| off.abs() < 1e-9), "{e} {radial} {y}");
        let roller = load_ratings(&Bearing::steel_rollers(13, 7.5e-3, 7.8e-3, 39e-3));
        assert_eq!((roller.factors(100.0), roller.equivalent(1000.0, 100.0)), (None, 1000.0));
    }
}
