//! Random rollers, oil and modes.

use super::scale::Scale;
use crate::bearing::Bearing;
use crate::case::{Case, Film, Mode, Roller};
use crate::draw::Draw;
use crate::oil::THINNEST;
use std::f64::consts::{PI, TAU};

/// What rolls, and in what.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Elements {
    Balls,
    OiledBalls,
    Rollers,
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

/// What else than usual a scene of these elements is to do.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Wish {
    /// Speed (rad/s) of the ring that turns.
    pub(super) size: Option<f64>,
    pub(super) way: Option<&'static str>,
}

impl Wish {
    /// Oil films follow a speed that changes, and straight rollers turn as slowly as users turn them, where dampers
    /// count beside a roller's weight.
    pub(super) fn random(draw: &mut Draw, case: &Case) -> Self {
        let (film, straight) = (case.film.is_some(), case.roller.is_some_and(|roller| !roller.crowned));
        Self {
            size: (straight && draw.chance(0.3)).then(|| TAU * draw.log(0.5, 8.0) * draw.sign()),
            way: (film && draw.chance(0.5)).then(|| draw.pick(&["ramp", "reversal"])),
        }
    }
}

/// Makes the bearing one of rollers: of steel, as the law of the laminae is.
pub(super) fn rollers(draw: &mut Draw, case: &mut Case) {
    let laminae = draw.pick(&[10, 25, 40, 40, 101, 640]);
    case.roller =
        Some(Roller { length_mm: case.diameter_mm * draw.log(0.301, 2.99), laminae, crowned: draw.chance(0.6) });
    case.element = None;
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
