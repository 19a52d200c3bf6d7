//! Small motions about rest: ∂(state')/∂(state), by differences.

use crate::bearing::Bearing;
use crate::case::Motion;
use crate::instant::{ELEMENTS, SENSOR};
use crate::run::{Pace, Run};

/// A degree of freedom: its name, its mass (kg), and where its position and its velocity stand in the state.
#[derive(Debug, Clone)]
pub struct Freedom {
    pub name: String,
    pub mass: f64,
    pub position: usize,
    pub velocity: usize,
}

impl Bearing {
    /// All degrees of freedom: elements, then rings and sensor as far as they move.
    pub fn freedoms(&self) -> Vec<Freedom> {
        let freedom =
            |name: String, mass: f64, position: usize, velocity: usize| Freedom { name, mass, position, velocity };
        let element = |j: usize| {
            let position = ELEMENTS + 2 * j;
            freedom(format!("element[{}].path", j + 1), self.own(j).mass, position, position + 1)
        };
        let mut found: Vec<Freedom> = (0..self.count).map(element).collect();
        for (which, name) in ["shaft", "housing"].into_iter().enumerate() {
            let ring = &self.rings[which];
            if ring.motion == Motion::Internal {
                found.extend(
                    ["x", "y"].into_iter().enumerate().map(|(a, axis)| {
                        freedom(format!("{name}.{axis}"), ring.mass, 4 * which + a, 4 * which + 2 + a)
                    }),
                );
            }
        }
        found.extend(self.sensor.map(|[mass, ..]| freedom("sensor.y".to_owned(), mass, SENSOR, SENSOR + 1)));
        found
    }

    /// ∂(positions', velocities')/∂(positions, velocities) of all degrees of freedom at a state of rest, by central
    /// differences of `h` (m) and `v` (m/s).
    pub fn matrix(&self, y: &[f64], [h, v]: [f64; 2]) -> Vec<Vec<f64>> {
        let freedoms = self.freedoms();
        let all: Vec<usize> = freedoms.iter().map(|f| f.position).chain(freedoms.iter().map(|f| f.velocity)).collect();
        let rates = |i: usize, by: f64| {
            let mut moved = y.to_vec();
            moved[i] += by;
            let run = Run::new(self, moved, None, Pace::STANDING);
            all.iter().map(|&row| run.rates()[row]).collect::<Vec<f64>>()
        };
        let mut matrix = vec![vec![0.0; all.len()]; all.len()];
        for (column, &i) in all.iter().enumerate() {
            let step = if column < freedoms.len() { h } else { v };
            let (below, above) = (rates(i, -step), rates(i, step));
            for row in 0..all.len() {
                matrix[row][column] = (above[row] - below[row]) / (2.0 * step);
            }
        }
        matrix
    }
}
