//! Modes of an assembly at rest: each satisfies the oracle's matrix of small motions, and all of them together have its
//! trace and that of its square, so that none is missing or there twice.

use super::super::judge::{start, start_state};
use crate::case::{Case, Damping, Step};
use crate::oracle::Bearing;
use crate::oracle::linear::Freedom;
use crate::oracle::run::{Pace, Run};
use crate::oracle::signals::signals;
use crate::subject::Subject;
use crate::units::rounding;
use brinell::simulation::SimulationError;
use brinell_analysis::modes::{Assembly, Kind, Mode};
use std::f64::consts::PI;

/// Difference of two matrices by differences, over the square of the largest frequency, up to which they are trusted.
const SMOOTH: f64 = 1e-4;

/// Whether a case's modes could be compared.
pub(super) fn agree(case: &Case, assembly: &Assembly) -> Result<bool, String> {
    // Oil resists on one side of rest only: nothing is linear there.
    if case.film.is_some() {
        return Ok(false);
    }
    let steps = vec![Step { length: 1e-6, host: None }];
    let case = Case { speed_hz: 0.0, housing_hz: case.housing_hz.map(|_| 0.0), steps, ..case.clone() };
    let names = signals(&case);
    let mut subject = Subject::new(&case).map_err(|error| format!("at rest: {error}"))?;
    let first = match subject.start(&case) {
        Ok(first) => first,
        Err(SimulationError::Equilibrium(_)) => return Ok(false),
        Err(error) => return Err(format!("at rest: {error}")),
    };
    let oracle = Bearing::new(&case);
    start(&oracle, &case, &first, &names).map_err(|why| format!("at rest: {why}"))?;
    let found = assembly.modes(case.cage_deg * PI / 180.0).map_err(|error| error.to_string())?;
    let freedoms = oracle.freedoms();
    let expected: Vec<&str> = freedoms.iter().map(|freedom| freedom.name.as_str()).collect();
    if assembly.freedom_names() != expected {
        return Err(format!("what moves is {:?}, the oracle says {expected:?}", assembly.freedom_names()));
    }
    let rates = found.modes.iter().flat_map(|mode| &mode.eigenvalues).map(|[re, im]| re.hypot(*im));
    let fastest = rates.fold(0.0, f64::max);
    let state = start_state(&case, &names, &first);
    // As for stiffness: what is right agrees over one of these distances.
    let mut judged = Ok(false);
    for part in [1e-3, 1e-4, 1e-5, 1e-6] {
        let Some(linear) = Linear::new(&oracle, &freedoms, &state, fastest, part) else { continue };
        let mut modes = found.modes.iter().filter(|mode| mode.kind != Kind::Free);
        let agreed =
            modes.try_for_each(|mode| linear.satisfied_by(mode)).and_then(|()| linear.has_traces_of(&found.modes));
        judged = agreed.map(|()| true);
        if judged.is_ok() {
            break;
        }
    }
    judged
}

/// The oracle's matrix, weighted with the roots of the masses, velocities over the largest frequency: all its entries
/// are of that frequency's size.
struct Linear {
    matrix: Vec<Vec<f64>>,
    masses: Vec<f64>,
    fastest: f64,
    /// How exactly an entry is known, over the largest frequency.
    own: f64,
    /// Elements that no raceway presses on: they stay where they are, and a shape is without them.
    loose: Vec<bool>,
}

impl Linear {
    /// By differences over a part of the least approach of those that hold an element.
    fn new(oracle: &Bearing, freedoms: &[Freedom], y: &[f64], fastest: f64, part: f64) -> Option<Self> {
        let run = Run::new(oracle, y.to_vec(), None, Pace::STANDING);
        let weight = oracle.mass * oracle.gravity[0].hypot(oracle.gravity[1]);
        let loose = run.acting.contacts.iter().map(|[inner, outer]| inner.force.max(outer.force) <= 1e-3 * weight);
        let loose: Vec<bool> = loose.collect();
        let held =
            run.acting.contacts.iter().zip(&loose).filter(|(_, loose)| !**loose).flat_map(|(contacts, _)| contacts);
        let least = held.filter(|c| c.force > 0.0).map(|c| c.approach).fold(f64::INFINITY, f64::min);
        if !(least.is_finite() && fastest > 0.0) {
            return None;
        }
        let h = part * least;
        let masses: Vec<f64> = freedoms.iter().map(|freedom| freedom.mass).collect();
        let count = masses.len();
        // Hunt and Crossley's damper pulls nowhere: beyond 1/χ it is not linear.
        let slow = match oracle.damping {
            Damping::HuntCrossley(chi) => 0.1 / chi,
            Damping::Proportional(_) => f64::INFINITY,
        };
        let weighted = |h: f64| {
            let mut matrix = oracle.matrix(y, [h, (h * fastest).min(slow)]);
            for (i, row) in matrix.iter_mut().enumerate() {
                for (k, entry) in row.iter_mut().enumerate() {
                    let scale = |i: usize| masses[i % count].sqrt() * if i < count { fastest } else { 1.0 };
                    *entry *= scale(i) / scale(k) / fastest;
                }
            }
            matrix
        };
        let (matrix, coarse) = (weighted(h), weighted(2.0 * h));
        let apart = matrix.iter().flatten().zip(coarse.iter().flatten()).map(|(a, b)| (a - b).abs());
        // Elements stand where they stand to a rounding, beside which a roller is pressed in by next to nothing.
        let own = apart.fold(rounding(oracle) / least, f64::max);
        (own <= SMOOTH).then_some(Self { matrix, masses, fastest, own, loose })
    }

    /// Whether a row is not of a loose element.
    fn held(&self, i: usize) -> bool {
        !self.loose.get(i % self.masses.len()).is_some_and(|loose| *loose)
    }

    /// A shape and its rate go on as the mode's eigenvalue says.
    fn satisfied_by(&self, mode: &Mode) -> Result<(), String> {
        let [re, im] = mode.eigenvalues[0].map(|part| part / self.fastest);
        let times = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a * c - b * d, a * d + b * c];
        let shape = mode.shape.iter().zip(&self.masses);
        let positions =
            shape.map(|([size, phase], mass)| [size * phase.cos(), size * phase.sin()].map(|x| x * mass.sqrt()));
        let positions: Vec<[f64; 2]> = positions.collect();
        let vector: Vec<[f64; 2]> =
            positions.iter().copied().chain(positions.iter().map(|x| times([re, im], *x))).collect();
        let norm = |vector: &[[f64; 2]]| vector.iter().map(|[a, b]| a * a + b * b).sum::<f64>().sqrt();
        let left: Vec<[f64; 2]> = (self.matrix.iter().zip(&vector).enumerate())
            .filter(|(i, _)| self.held(*i))
            .map(|(_, (row, x))| {
                let sum = [0, 1].map(|part| row.iter().zip(&vector).map(|(a, x)| a * x[part]).sum::<f64>());
                let grown = times([re, im], *x);
                [sum[0] - grown[0], sum[1] - grown[1]]
            })
            .collect();
        let limit = (1e-6 + self.masses.len() as f64 * self.own) * norm(&vector);
        if norm(&left) <= limit {
            return Ok(());
        }
        let hertz = self.fastest / std::f64::consts::TAU;
        Err(format!(
            "{:?} with {re:e}, {im:e} times {hertz} Hz leaves {:e} of itself (limit {limit:e}): {:?}",
            mode.kind,
            norm(&left),
            mode.shape
        ))
    }

    fn has_traces_of(&self, modes: &[Mode]) -> Result<(), String> {
        let n = self.matrix.len();
        let [mut sum, mut squares] = [0.0; 2];
        for mode in modes {
            for [re, im] in mode.eigenvalues.iter().map(|value| value.map(|part| part / self.fastest)) {
                let twice = if im == 0.0 { 1.0 } else { 2.0 };
                sum += twice * re;
                squares += twice * (re * re - im * im);
            }
        }
        // The command leaves loose elements out.
        let held = || (0..n).filter(|&i| self.held(i));
        let trace: f64 = held().map(|i| self.matrix[i][i]).sum();
        let product = |i: usize| held().map(|k| self.matrix[i][k] * self.matrix[k][i]).sum::<f64>();
        let of_square: f64 = held().map(product).sum();
        // Differences of n entries, of size 1 at most.
        let limit = n as f64 * (2e-6 + 2.0 * self.own);
        for (name, a, b) in [("sum", sum, trace), ("sum of squares", squares, of_square)] {
            if !((a - b).abs() <= limit) {
                return Err(format!(
                    "the {name} of all eigenvalues is {a}, the oracle says {b}, of the fastest's size"
                ));
            }
        }
        Ok(())
    }
}
