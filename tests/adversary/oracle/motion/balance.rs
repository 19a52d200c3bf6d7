//! A static balance, looked for from many sides: whether a scene that the simulation refuses to start has one.
//!
//! For rings at given positions each element is balanced by halving; then the free rings go downhill in the square of
//! the force on them (Levenberg and Marquardt, with difference quotients).

use crate::bearing::Bearing;
use crate::case::{Case, Motion};
use crate::elimination::solve;
use crate::instant::{Acting, Contact, ELEMENTS, Outside};
use crate::run::{Pace, Run};
use crate::surface::Stretches;
use std::f64::consts::TAU;

struct Search<'a> {
    bearing: &'a Bearing,
    outside: Outside,
    stretches: Vec<Stretches>,
    /// Indices in the state vector of what is free.
    free: Vec<usize>,
    acting: Acting,
}

/// Largest net force (N) that is left on a free ring or an element at the best stable balance found, and the largest
/// force in play.
pub fn best(bearing: &Bearing, case: &Case) -> (f64, f64) {
    let mut search = Search::new(bearing, case);
    let mut best = (f64::INFINITY, 0.0);
    let soft = case.rings.iter().filter(|ring| ring.motion == Motion::Internal && ring.stiffness > 0.0);
    let sag = soft.map(|ring| ring.load[0].hypot(ring.load[1]) / ring.stiffness).fold(0.0, f64::max);
    let play = 0.5 * bearing.clearance.max(0.0) + 1e-3 * bearing.r;
    for size in [0.0, play, 2.0 * play, sag] {
        for direction in 0..if size == 0.0 { 1 } else { 8 } {
            let (sin, cos) = (TAU * f64::from(direction) / 8.0).sin_cos();
            let found = search.from([size * cos, size * sin]);
            if found.0 < best.0 {
                best = found;
            }
            if best.0 <= 1e-9 * best.1 {
                return best;
            }
        }
    }
    best
}

/// A bearing whose shaft is held at a position, each element in balance.
pub struct Held {
    /// On the shaft, its load with it (N).
    pub force: [f64; 2],
    /// Inner and outer contact of each element.
    pub contacts: Vec<[Contact; 2]>,
    pub outside: Outside,
    pub stretches: Vec<Stretches>,
    pub y: Vec<f64>,
}

/// How a case stands between rings of which the shaft is at `shaft` (m) and the housing fixed.
pub fn held(bearing: &Bearing, case: &Case, shaft: [f64; 2]) -> Held {
    let mut y = vec![0.0; bearing.state_count()];
    y[..2].copy_from_slice(&shaft);
    let mut search = Search::new(bearing, case);
    let (force, _) = search.force(&mut y);
    let Search { outside, stretches, acting, .. } = search;
    Held { force: [force[0], force[1]], contacts: acting.contacts, outside, stretches, y }
}

impl<'a> Search<'a> {
    fn new(bearing: &'a Bearing, case: &Case) -> Self {
        let host = case.steps.first().and_then(|step| step.host.as_ref());
        let run = Run::new(bearing, vec![0.0; bearing.state_count()], host, Pace::STANDING);
        let free = (0..2).filter(|&which| case.rings[which].motion == Motion::Internal);
        let free = free.flat_map(|which| [4 * which, 4 * which + 1]).collect();
        // At the start the host's derivatives of loads and speed are not at work yet.
        let mut outside = run.outside;
        outside.turns.iter_mut().for_each(|turn| turn[2] = 0.0);
        Self { bearing, outside, stretches: run.stretches, free, acting: Acting::default() }
    }
}

impl Search<'_> {
    /// Downhill from one position of the shaft.
    fn from(&mut self, shaft: [f64; 2]) -> (f64, f64) {
        let mut y = vec![0.0; self.bearing.state_count()];
        for (a, position) in shaft.into_iter().enumerate() {
            if self.free.contains(&a) {
                y[a] = position;
            }
        }
        let (mut force, mut largest) = self.force(&mut y);
        let square = |force: &[f64]| force.iter().map(|f| f * f).sum::<f64>();
        let mut damping = 1e-3;
        for _ in 0..200 {
            if square(&force[..self.free.len()]).sqrt() <= 1e-11 * largest {
                break;
            }
            let jacobian = self.jacobian(&y, &force);
            let Some(step) = marquardt(&jacobian, &force[..self.free.len()], damping) else { break };
            let mut next = y.clone();
            for (&i, step) in self.free.iter().zip(&step) {
                next[i] += step.clamp(-self.bearing.r, self.bearing.r);
            }
            let (next_force, next_largest) = self.force(&mut next);
            if square(&next_force) < square(&force) {
                (y, force, largest) = (next, next_force, next_largest);
                damping *= 0.2;
            } else {
                damping *= 5.0;
                if damping > 1e12 {
                    break;
                }
            }
        }
        let jacobian = self.jacobian(&y, &force);
        // On top of an element a ring is in balance and does not stay there.
        let left = if stable(&jacobian) { force.iter().fold(0.0f64, |m, f| m.max(f.abs())) } else { f64::INFINITY };
        (left, largest)
    }

    fn jacobian(&mut self, y: &[f64], force: &[f64]) -> Vec<Vec<f64>> {
        let h = 1e-7 * self.bearing.r;
        let free = self.free.clone();
        free.iter()
            .map(|&i| {
                let mut moved = y.to_vec();
                moved[i] += h;
                let (there, _) = self.force(&mut moved);
                there[..free.len()].iter().zip(force).map(|(a, b)| (a - b) / h).collect()
            })
            .collect()
    }

    /// Balances the elements; force on what is free and then on the worst element, and the largest force.
    fn force(&mut self, y: &mut [f64]) -> (Vec<f64>, f64) {
        let (bearing, count) = (self.bearing, self.bearing.count);
        // All elements are halved together: none feels another. Outwards the raceway wins.
        let (mut low, mut high) = (vec![-2.0 * bearing.r; count], vec![bearing.r; count]);
        let mut along = vec![0.0; count];
        for _ in 0..110 {
            for j in 0..count {
                y[ELEMENTS + 2 * j] = 0.5 * (low[j] + high[j]);
            }
            self.along(y, &mut along);
            for j in 0..count {
                if along[j] > 0.0 { low[j] = y[ELEMENTS + 2 * j] } else { high[j] = y[ELEMENTS + 2 * j] }
            }
        }
        let worst = along.iter().fold(0.0f64, |m, f| m.max(f.abs()));
        let mut found = Vec::new();
        let mut largest = self.acting.contacts.iter().flatten().fold(0.0f64, |m, contact| m.max(contact.force));
        for &i in &self.free {
            let (which, a) = (i / 4, i % 4);
            let ring = &bearing.rings[which];
            let load = self.outside.rings[which][a][0];
            found.push(load + self.acting.rings[which][a] - ring.stiffness * y[i]);
            largest = largest.max(load.abs()).max((ring.stiffness * y[i]).abs());
        }
        found.push(worst);
        (found, largest)
    }

    /// Net radial force on each element.
    fn along(&mut self, y: &[f64], along: &mut [f64]) {
        let mut rates = vec![0.0; y.len()];
        self.bearing.stretches(&self.outside, 0.0, y, [true, false], &mut self.stretches);
        self.bearing.rates(&self.outside, 0.0, y, &self.stretches, &mut rates, &mut self.acting);
        let carried = self.acting.accelerations[1];
        for (j, along) in along.iter_mut().enumerate() {
            let (sin, cos) = (self.outside.turns[0][0] + TAU * j as f64 / self.bearing.count as f64).sin_cos();
            *along = self.bearing.own(j).mass * (rates[ELEMENTS + 2 * j + 1] + carried[0] * cos + carried[1] * sin);
        }
    }
}

/// Whether forces push back whatever moves: −(J + Jᵀ) has Cholesky's factors.
fn stable(jacobian: &[Vec<f64>]) -> bool {
    let n = jacobian.len();
    let mut lower = vec![vec![0.0; n]; n];
    for i in 0..n {
        for k in 0..=i {
            let before: f64 = (0..k).map(|l| lower[i][l] * lower[k][l]).sum();
            let rest = -(jacobian[i][k] + jacobian[k][i]) - before;
            if i == k && rest <= 0.0 {
                return false;
            }
            lower[i][k] = if i == k { rest.sqrt() } else { rest / lower[k][k] };
        }
    }
    true
}

/// The step against `force`; columns of the Jacobian are those of its lists.
fn marquardt(jacobian: &[Vec<f64>], force: &[f64], damping: f64) -> Option<Vec<f64>> {
    let n = jacobian.len();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let row = |i: usize| {
        let mut row: Vec<f64> = (0..n).map(|k| dot(&jacobian[i], &jacobian[k])).collect();
        row[i] += damping * row[i] + 1e-300;
        row
    };
    let right: Vec<f64> = (0..n).map(|i| -dot(&jacobian[i], force)).collect();
    solve((0..n).map(row).collect(), &right)
}
