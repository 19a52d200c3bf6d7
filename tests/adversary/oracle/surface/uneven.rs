//! Bodies that are not what their nominal radii say: elements of unequal size, and waves.
//!
//! An element larger by Δ, of radius r + Δ/2, touches the smooth outer raceway at R_o − r − Δ/2 from its centre and has
//! Δ less of clearance. Raceways and grooves keep their radii, so its Hertz constants are of its own; its mass
//! grows with D³, a roller's with D².
//!
//! A body's radius is B + Σ w_n cos n(ψ − ψ_n) in its own frame. An outer raceway's crest lets an element by as much
//! farther out, as a path P does; another body's crest keeps it away. With E(δ) the contact's energy and δ = u − P(ψ)
//! the forces are Q along the line of centres and Q P′ over the centres' distance across it.

use crate::case::{Case, On, Wave};
use crate::growth::Growth;
use crate::hertz;
use crate::surface::Rise;
use crate::turning::{HOUSING, SHAFT, SPIN, Turns};
use std::f64::consts::{PI, TAU};

/// What of an element is its own.
#[derive(Debug, Clone)]
pub struct Own {
    /// Diameter beyond the nominal one (m).
    pub larger: f64,
    pub mass: f64,
    pub growth: [Growth; 2],
}

/// What all elements meet: radii of raceways and grooves (m), inner and outer, and E/(2(1−ν²)) (Pa).
pub(crate) struct Bodies {
    pub raceways: [f64; 2],
    pub grooves: [f64; 2],
    pub modulus: f64,
}

impl Bodies {
    /// The nominal element, and all that are different; it alone where all are equal.
    pub(crate) fn elements(&self, case: &Case) -> (Own, Vec<Own>) {
        let line = Growth::of_roller(case);
        let nominal = self.element(case, 0.0, line.as_ref());
        let own: Vec<Own> = case.larger_um.iter().map(|um| self.element(case, um * 1e-6, line.as_ref())).collect();
        let all = if own.is_empty() { vec![nominal.clone()] } else { own };
        (nominal, all)
    }

    fn element(&self, case: &Case, larger: f64, line: Option<&Growth>) -> Own {
        let nominal = 0.5e-3 * case.diameter_mm;
        let r = nominal + 0.5 * larger;
        let volume = |r: f64| match case.roller {
            Some(roller) => PI * r * r * roller.length_mm * 1e-3,
            None => 4.0 / 3.0 * PI * r * r * r,
        };
        let given = |grams: f64| 1e-3 * grams * volume(r) / volume(nominal);
        let mass = case.mass_g.map_or_else(|| volume(r) * case.density.unwrap(), given);
        let constant = |side: usize| {
            let along = if side == 0 { 1.0 / self.raceways[0] } else { -1.0 / self.raceways[1] };
            hertz::stiffness([1.0 / r + along, 1.0 / r - 1.0 / self.grooves[side]], self.modulus)
        };
        let growth = [0, 1].map(|side| match line {
            Some(line) => line.clone(),
            None => Growth::Point(case.hertz[side].unwrap_or_else(|| constant(side))),
        });
        Own { larger, mass, growth }
    }
}

/// The waves that one raceway's contacts meet on a body.
#[derive(Debug, Clone)]
pub(crate) struct Waves {
    /// What the body turns with.
    frame: usize,
    /// Angle 0 of the body, as the contact meets it while its frame stands at 0 (rad).
    zero: f64,
    /// Order, P at a crest (m), angle of a crest (rad).
    pub(crate) all: Vec<[f64; 3]>,
}

/// Waves of rings, inner and outer, and of elements, on their inner and their outer side.
#[derive(Debug, Clone, Default)]
pub struct AllWaves {
    pub(crate) rings: [Option<Waves>; 2],
    pub(crate) elements: Vec<Option<[Waves; 2]>>,
}

impl Waves {
    fn of(case: &Case, body: On, frame: usize, zero: f64) -> Option<Self> {
        let way = if body == On::Outer { 1e-6 } else { -1e-6 };
        let number = |wave: &Wave| [f64::from(wave.order), way * wave.amplitude_um, wave.crest_deg.to_radians()];
        let all: Vec<_> = case.waves.iter().filter(|wave| wave.on.is_body_of(body)).map(number).collect();
        (!all.is_empty()).then_some(Self { frame, zero, all })
    }

    /// P and dP/dψ of waves where a contact meets them, how fast it passes, and what the waves turn with.
    pub(crate) fn rise(&self, [direction, rate]: [f64; 2], turns: &Turns) -> Rise {
        let psi = direction - turns[self.frame][0] - self.zero;
        let sum = |of: &dyn Fn(&[f64; 3]) -> f64| self.all.iter().map(of).sum::<f64>();
        Rise {
            path: sum(&|[n, w, crest]| w * (n * (psi - crest)).cos()),
            slope: sum(&|[n, w, crest]| -n * w * (n * (psi - crest)).sin()),
            rate: rate - turns[self.frame][1],
            frame: self.frame,
        }
    }
}

impl AllWaves {
    /// `start` is the direction of element 1 at the start (rad).
    pub fn of(case: &Case, start: f64) -> Self {
        let rings = [Waves::of(case, On::Inner, SHAFT, 0.0), Waves::of(case, On::Outer, HOUSING, 0.0)];
        let element = |j: usize| {
            let (body, outwards) =
                (On::Element { element: j, tilt_deg: 0.0 }, start + TAU * j as f64 / case.count as f64);
            // At the start an element's angle 0 faces the outer raceway.
            Some([Waves::of(case, body, SPIN, outwards - PI)?, Waves::of(case, body, SPIN, outwards)?])
        };
        Self { rings, elements: (0..case.count).map(element).collect() }
    }
}
