//! Rollers in place of balls, oil between them and the raceways, and a structure's modes below the sensor.

use super::Case;
use super::random::Scale;
use crate::Bearing;
use crate::draw::Draw;
use crate::oil::THINNEST;
use std::f64::consts::PI;

/// What rolls, and in what.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Elements {
    Balls,
    OiledBalls,
    Rollers,
}

/// A cylindrical roller.
#[derive(Debug, Clone, Copy)]
pub struct Roller {
    pub length_mm: f64,
    pub laminae: u32,
    /// By the standard's logarithmic crown; straight without.
    pub crowned: bool,
}

/// An oil film.
#[derive(Debug, Clone, Copy)]
pub struct Film {
    pub viscosity: f64,
    pub pressure_viscosity: f64,
    pub layer_um: Option<f64>,
}

/// A mode of the structure below the sensor.
#[derive(Debug, Clone, Copy)]
pub struct Mode {
    pub frequency_hz: f64,
    pub damping_ratio: f64,
    pub gain: f64,
    pub quadrature_gain: f64,
}

impl Elements {
    pub(super) fn random(draw: &mut Draw) -> Self {
        match draw.below(10) {
            0..4 => Self::Rollers,
            4..6 => Self::OiledBalls,
            _ => Self::Balls,
        }
    }
}

/// Makes the bearing one of rollers: of steel, as the law of the laminae is.
pub(super) fn rollers(draw: &mut Draw, case: &mut Case) {
    let laminae = draw.pick(&[10, 25, 40, 40, 101, 640]);
    case.roller =
        Some(Roller { length_mm: case.diameter_mm * draw.log(0.301, 2.99), laminae, crowned: draw.chance(0.6) });
    (case.modulus_gpa, case.poisson, case.hertz) = (draw.between(200.1, 211.9), 0.3, [None; 2]);
    if case.mass_g.is_some() {
        case.mass_g = case.mass_g.map(|mass| mass * draw.log(0.5, 4.0));
    }
}

/// Oil between balls and raceways, and modes below a sensor.
pub(super) fn add(draw: &mut Draw, case: &mut Case, elements: Elements, scale: &Scale) {
    if elements == Elements::OiledBalls {
        let film = Film {
            viscosity: 1.0,
            pressure_viscosity: draw.log(0.5e-8, 4e-8),
            layer_um: draw.chance(0.4).then(|| draw.log(0.05, 100.0)),
        };
        // By the rate at which the thinnest film would stop an element.
        let oiled = Bearing::smooth(&Case { film: Some(film), ..case.clone() });
        let strongest = oiled.oil.as_ref().map_or(0.0, |oil| oil.squeeze[1] / THINNEST) / oiled.mass;
        let viscosity = scale.omega * draw.log(0.03, 30.0) / strongest;
        case.film = Some(Film { viscosity: viscosity.clamp(1e-4, 10.0), ..film });
    }
    if case.sensor.is_some() && draw.chance(0.6) {
        case.modes = (0..1 + draw.below(4)).map(|_| mode(draw, scale)).collect();
    }
}

fn mode(draw: &mut Draw, scale: &Scale) -> Mode {
    Mode {
        frequency_hz: (scale.omega * draw.log(0.003, 0.7) / (2.0 * PI)).clamp(1.0, 1e6),
        damping_ratio: draw.log(2e-3, 1.0),
        gain: draw.between(-2.0, 2.0),
        quadrature_gain: if draw.chance(0.5) { 0.0 } else { draw.between(-1.0, 1.0) },
    }
}

/// What rolls, as the tables call it.
pub(super) fn name(case: &Case) -> &'static str {
    match (&case.roller, &case.film) {
        (Some(Roller { crowned: true, .. }), _) => "crowned rollers",
        (Some(_), _) => "straight rollers",
        (None, Some(_)) => "balls in oil",
        (None, None) => "balls",
    }
}

impl Roller {
    /// Its keys in the table of the bearing.
    pub fn toml(&self) -> String {
        let Self { length_mm, laminae, crowned } = self;
        let profile = if *crowned { "log" } else { "straight" };
        format!(
            "element = \"cylindrical-roller\"\nroller_length_mm = {length_mm:?}\nroller_profile = \"{profile}\"\n\
             roller_laminae = {laminae}\n"
        )
    }
}

impl Film {
    /// Its table.
    pub fn toml(&self) -> String {
        let Self { viscosity, pressure_viscosity, layer_um } = self;
        let layer = layer_um.map_or(String::new(), |layer| format!("layer_um = {layer:?}\n"));
        format!("[film]\nviscosity_pa_s = {viscosity:?}\npressure_viscosity_1_pa = {pressure_viscosity:?}\n{layer}")
    }
}

impl Mode {
    /// Its table, behind that of its sensor.
    pub fn toml(&self) -> String {
        let Self { frequency_hz, damping_ratio, gain, quadrature_gain } = self;
        format!(
            "[[sensor.mode]]\nfrequency_hz = {frequency_hz:?}\ndamping_ratio = {damping_ratio:?}\ngain = {gain:?}\n\
             quadrature_gain = {quadrature_gain:?}\n"
        )
    }

    /// How much larger than its body's acceleration what the sensor measures may be.
    pub fn amplification(&self) -> f64 {
        (self.gain.abs() + self.quadrature_gain.abs()) * (1.0 + 0.5 / self.damping_ratio)
    }
}
