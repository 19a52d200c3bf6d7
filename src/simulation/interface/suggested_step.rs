//! The communication step that a host which moves a ring should take.
//!
//! What a coupling loses in a step h is counted in ωh, ω being the fastest mode of the rings against each other on the
//! bearing: ω² = λ (1/m_i + 1/m_o), with the largest eigenvalue λ of the tangent stiffness, a ring that stands having
//! no 1/m. A wiring whose error is of second order (`next_mean_force` held, `mean_force` in sequence, `force` with its
//! derivative, repeated steps that are given their end) is about 1 % off after 20 ms at ωh = [`SECOND_ORDER`], measured
//! with a rotor without a damper on a casing that stands, the worst case; dampers and a soft casing let it be three
//! times that. `force` held is of first order: for 1 % it wants ωh = [`FIRST_ORDER`].
//!
//! How a host is wired, and which mass it moves, shows after some steps: [`coupling`](crate::simulation::coupling).
//! Before that, who reads after the first step `force` alone is taken for one that holds it ([`Wiring`]), and the mass
//! is the scene's (`host.mass_kg`), or that of published models, 3.26 kg for a shaft and 6.64 kg for a housing. With m
//! times the mass the step is √m times as long.
//!
//! A bearing that hardly touches is soft, and stiff a moment later: it counts as one on which an element is pressed by
//! a hundredth of what it would carry under the static load rating C₀ ([`least_stiffness`]).

use super::value_access::{FORCE, SECOND};
use crate::contact::law::elastic_law;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::parameters::{COORDINATES, Model};
use crate::geometry::STRIBECK;
use crate::geometry::load_rating::load_ratings;
use crate::scene::{Bearing, Motion, Ring};

/// ωh of a wiring of second order, and of first.
const SECOND_ORDER: f64 = 0.1;
const FIRST_ORDER: f64 = 0.001;
/// Multiplications by the stiffness until its largest eigenvalue stands: a second one that is a tenth smaller leaves
/// a thousandth, one that is nearer is as good.
const ROUNDS: usize = 30;

/// What a host has read since its first step. No part of the state: what is taken back was read all the same.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::simulation) struct Wiring {
    seen: u8,
}

impl Wiring {
    /// Notes what has been read, in the classes of `value_access`.
    #[inline]
    pub(in crate::simulation) fn note(&mut self, classes: u8) {
        self.seen |= classes;
    }

    /// Whether the force of an instant is all that the host goes by.
    pub(in crate::simulation) fn holds_force(self) -> bool {
        self.seen & (FORCE | SECOND) == FORCE
    }
}

/// Share of the static load rating under which a bearing is taken for touching.
const TOUCHING: f64 = 0.01;

/// Stiffness (N/m) of both contacts of one element under that share of what it would carry of the static load rating.
pub(in crate::simulation) fn least_stiffness(bearing: &Bearing) -> f64 {
    let force = TOUCHING * STRIBECK * load_ratings(bearing).fixed / bearing.element_count as f64;
    let approach = |force: f64| -> f64 {
        [RacewaySide::Inner, RacewaySide::Outer]
            .map(|side| elastic_law(bearing, side).approach_under(force))
            .iter()
            .sum()
    };
    0.2 * force / (approach(1.1 * force) - approach(0.9 * force))
}

/// The step (s) for the tangent stiffness −∂F/∂x of the inner ring, with a wiring of second order; for the masses (kg)
/// that the host moves, where they are known, and a stiffness that is no less than this.
pub(in crate::simulation) fn suggested_step(
    model: &Model,
    stiffness: &[[f64; COORDINATES]; COORDINATES],
    masses: [Option<f64>; 2],
    least: f64,
) -> f64 {
    let of_state = model.supports.inverse_masses();
    let rings = [&model.shaft, &model.housing];
    let of_host = |ring: usize| {
        let usual = [Ring::default_shaft(), Ring::default_housing()][ring].mass;
        masses[ring].unwrap_or(if rings[ring].mass > 0.0 { rings[ring].mass } else { usual })
    };
    let inverse = |ring: usize| match rings[ring].motion {
        Motion::Host => 1.0 / of_host(ring),
        Motion::Internal => of_state[2 * ring],
        Motion::Fixed => 0.0,
    };
    SECOND_ORDER / (stiffest(stiffness).max(least) * (inverse(0) + inverse(1))).sqrt()
}

/// The step (s) with a force that is held, by that with a wiring of second order.
pub(in crate::simulation) fn of_first_order(step: f64) -> f64 {
    FIRST_ORDER / SECOND_ORDER * step
}

/// The largest eigenvalue of the stiffness (N/m) along x, y and z, which is symmetric up to what damping leaves.
fn stiffest(stiffness: &[[f64; COORDINATES]; COORDINATES]) -> f64 {
    // Begun by the axis that is stiffest itself, which no other direction of a positive matrix is orthogonal to.
    let start = (0..3).max_by(|&i, &j| stiffness[i][i].total_cmp(&stiffness[j][j])).unwrap_or(0);
    let mut along = [0, 1, 2].map(|axis| if axis == start { 1.0 } else { 0.0 });
    let mut found = stiffness[start][start];
    for _ in 0..ROUNDS {
        let pushed =
            [0, 1, 2].map(|i| (0..3).map(|j| 0.5 * (stiffness[i][j] + stiffness[j][i]) * along[j]).sum::<f64>());
        let length = pushed.iter().map(|x| x * x).sum::<f64>().sqrt();
        if !(length > 0.0) {
            break;
        }
        (along, found) = (pushed.map(|x| x / length), length);
    }
    found
}
