//! How far rings are from where they would be without what the coupling has lost.
//!
//! ```text
//! M δ'' + C δ' + (K + k) δ = r
//! ```
//! for both rings together: K is the bearing's tangent stiffness between them. A step is the implicit midpoint rule,
//! which neither damps nor drives. What was lost is forgotten with a time constant of [`MEMORY`], as every rotor
//! forgets by dampers: without one it would grow without bound, however small.

use nalgebra::{Matrix6, Vector6};

use super::host::Lost;
use super::step::{Body, Step, Triple};

/// s.
const MEMORY: f64 = 0.02;
/// Share of its own elastic approach from which on a ring counts as moved.
const LEAST_WAY: f64 = 1e-3;

#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Error {
    /// Error of place (m) and velocity of both rings.
    place: [Triple; 2],
    velocity: [Triple; 2],
    /// Where hosted rings began, and 1 once they have.
    start: [Triple; 2],
    began: f64,
    /// Squares of error and way, summed over the time (m² s).
    off: f64,
    way: f64,
    /// Their ratio, and its largest.
    pub(super) now: f64,
    pub(super) largest: f64,
}

impl Error {
    /// Whether no step has begun yet.
    pub(super) fn is_fresh(&self) -> bool {
        self.began == 0.0
    }

    /// Notes where rings begin.
    pub(super) fn begin(&mut self, places: [Triple; 2]) {
        (self.start, self.began) = (places, 1.0);
    }

    /// Notes an error that one step has made.
    ///
    /// It is set against way and error together: what is small stays what it is, and nothing is off by more than all.
    pub(super) fn note(&mut self, share: f64) {
        self.now = if share < f64::MAX { share / (1.0 + share) } else { 1.0 };
        self.largest = self.largest.max(self.now);
    }

    /// Takes the errors on by a step in which so much was lost.
    pub(super) fn go_on(&mut self, step: &Step, lost: [Lost; 2], bodies: [Body; 2]) {
        let (h, k) = (step.length, step.stiffness);
        let (mut mass, mut damping, mut stiffness) = (Matrix6::zeros(), Matrix6::zeros(), Matrix6::zeros());
        let mut force = Vector6::zeros();
        for ring in [0, 1] {
            let (own, other, body) = (3 * ring, 3 * (1 - ring), bodies[ring]);
            if body.mass == 0.0 {
                // It stands.
                mass.fixed_view_mut::<3, 3>(own, own).fill_diagonal(1.0);
                continue;
            }
            mass.fixed_view_mut::<3, 3>(own, own).fill_diagonal(body.mass);
            stiffness.fixed_view_mut::<3, 3>(own, own).copy_from(&k);
            stiffness.fixed_view_mut::<3, 3>(own, other).copy_from(&-k);
            for axis in 0..3 {
                stiffness[(own + axis, own + axis)] += body.stiffness[axis];
                damping[(own + axis, own + axis)] = body.damping[axis];
            }
            let acting = lost[ring].force - k * (lost[ring].gap - lost[1 - ring].gap);
            force.fixed_rows_mut::<3>(own).copy_from(&acting);
        }
        let stacked = |of: &[Triple; 2]| Vector6::from_fn(|i, _| of[i / 3][i % 3]);
        let (place, velocity) = (stacked(&self.place), stacked(&self.velocity));
        let matrix = mass + damping * (0.5 * h) + stiffness * (0.25 * h * h);
        let known = mass * velocity + (force - stiffness * place) * (0.5 * h);
        let Some(middle) = matrix.lu().solve(&known) else { return };
        let kept = 1.0 / (1.0 + h / MEMORY);
        for ring in [0, 1] {
            let middle = Triple::from_fn(|axis, _| middle[3 * ring + axis]);
            self.place[ring] = (self.place[ring] + middle * h + lost[ring].beyond) * kept;
            self.velocity[ring] = (middle * 2.0 - self.velocity[ring]) * kept;
        }
    }

    /// Compares the errors with the way of hosted rings, which are at these places.
    pub(super) fn compare(&mut self, step: &Step, places: [Triple; 2], hosted: [bool; 2]) {
        let (h, stiffness) = (step.length, step.stiffness.trace());
        let kept = 1.0 / (1.0 + h / MEMORY);
        let least = if stiffness > 0.0 { LEAST_WAY * step.mean[0].norm() / stiffness } else { 0.0 };
        let (mut off, mut way) = (0.0, least * least);
        for ring in [0, 1].into_iter().filter(|&ring| hosted[ring]) {
            off += self.place[ring].norm_squared();
            way += (places[ring] - self.start[ring]).norm_squared();
        }
        self.off = self.off * kept * kept + off * h;
        self.way = self.way * kept * kept + way * h;
        if self.way > 0.0 {
            self.note((self.off / self.way).sqrt());
        }
    }

    /// All its numbers.
    pub(super) fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        let Self { place, velocity, start, began, off, way, now, largest } = self;
        let triples = [place, velocity, start].into_iter().flatten().flat_map(|triple| triple.iter_mut());
        triples.chain([began, off, way, now, largest])
    }
}
