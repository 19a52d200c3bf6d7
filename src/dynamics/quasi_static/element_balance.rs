//! One element without inertia, in radial balance at every instant.
//!
//! With f the inner contact's force on the element and F_r the outer's inwards, both elastic,
//! ```text
//! R(u) = f·e_r − F_r + m (g·e_r + (R_o − r) ω²) = 0          (R_o − r) ω²: see `centrifugal_radius`
//! u'   = −(∂R/∂t + ∂R/∂x ẋ)/(∂R/∂u)                         implicit function theorem, x the rings' positions
//! ```
//! *There is one balance.* At fixed rings and time both contacts' forces grow with their approaches and the rest does
//! not depend on u, so that R falls with u wherever a contact pushes: the elastic energy is convex in u. Where neither
//! does, R is the weight and the centrifugal force, and the element goes on to the raceway to which these push it; one
//! that nothing pushes rests against the outer raceway. The path therefore does not depend on where the search begins
//! but for rounding. Where that push changes its sign the path jumps from one raceway to the other, and both forces are
//! 0 on either side: the *snap* of a loose element is an event of the path, and no force jumps.
//!
//! *Damping* of the contacts is what is left of an element's motion where it follows its balance: to first order in the
//! damping forces d the path lags by u₁ = d/(−∂R/∂u), which hands both contacts the same change N of their radial
//! force,
//! ```text
//! d = d_i·e_r − d_o,   N = (d_o k_i + d_i k_o)/(k_i + k_o)     contacts of radial stiffness k_i, k_o in series
//! ```
//! with the dampers at the rates of the elastic balance. What is left out is of second order: the share is (ω d/k)²,
//! 1e-3 at 2 kHz with the usual damper. Without it rings would ring on that the full model damps. No contact pulls: N
//! is made smaller where one would. The path is the elastic one.

use super::path_search::PathSearch;
use super::tangent::RadialForce;
use super::tangent::{Rings, stacked};
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{Bends, ElementChange, ElementVariation, Linearized};
use crate::dynamics::contacts::{Meeting, UnsolvedContact};
use crate::dynamics::parameters::{Frame, FramedKinematics, Model, PathMotion, SMOOTH};
use crate::numerics::plane::{Vector, turned};

/// Change of a path below which Newton's next step is exact to rounding (m): what is left is 0.25 (this)²/δ, with the
/// lightest contact's δ of 1e-9 m below 1e-21 m.
const SETTLED: f64 = 1e-15;
/// First step of a search that nothing brackets (m); each next one is twice as long.
const FIRST_STRIDE: f64 = 1e-8;
/// Most evaluations of the contacts: doubling from the first stride to a metre, and halving back.
const MOST_EVALUATIONS: u64 = 300;
/// Evaluations of a contact in balance: one each without and with damping, and four for its second derivatives.
const EVALUATIONS_AT_BALANCE: u64 = 6;

/// An element in balance.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct InBalance {
    /// Its contacts without damping.
    pub(in crate::dynamics) elastic: Linearized,
    /// Its contacts damped at the rates of the balance.
    pub(super) damped: Linearized,
    /// u (m)
    pub(in crate::dynamics) path: f64,
    /// u' (m/s)
    pub(in crate::dynamics) path_rate: f64,
    /// Force of the inner contact on the element (N).
    pub(in crate::dynamics) inner: Vector,
    /// Force of the outer contact on the element, inwards and counter-clockwise (N).
    pub(in crate::dynamics) outer: Vector,
    /// Whether the inner and the outer contact are near a defect.
    near: [bool; 2],
    /// Evaluations of the contacts that it took.
    pub(in crate::dynamics) evaluations: u64,
}

/// A torque on a body with a defect.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct BodyTorque {
    /// The frame in which the body turns.
    pub(in crate::dynamics) frame: Frame,
    /// About its own centre (N m).
    pub(in crate::dynamics) torque: f64,
}

/// What an element in balance exerts on the rest of the bearing.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct Exerted {
    /// Force on the inner and on the outer ring (N).
    pub(in crate::dynamics) rings: [Vector; 2],
    /// Torques on the bodies with the defects under its inner and its outer contact.
    pub(in crate::dynamics) torques: [BodyTorque; 2],
}

/// A path that was searched for.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct FoundPath {
    /// (m)
    pub(in crate::dynamics) path: f64,
    /// How often contacts were evaluated.
    evaluations: u64,
}

impl InBalance {
    /// What it exerts.
    pub(in crate::dynamics) fn exerted(&self) -> Exerted {
        let Linearized { e_r, e_t, n, distance, rho, frames, .. } = self.elastic;
        // The force on a smooth raceway goes through the ring's centre.
        let inner = if self.near[0] { -self.inner.dot(&turned(n)) * distance } else { 0.0 };
        let outer = if self.near[1] { -self.outer.y * rho } else { 0.0 };
        Exerted {
            rings: [-self.inner, e_r * self.outer.x - e_t * self.outer.y],
            torques: [BodyTorque { frame: frames[0], torque: inner }, BodyTorque { frame: frames[1], torque: outer }],
        }
    }

    /// Whether it is one: a search that found none, or a contact without an answer, leaves NaN.
    pub(in crate::dynamics) fn is_found(&self) -> bool {
        (self.inner.x + self.inner.y + self.outer.x + self.outer.y + self.path_rate).is_finite()
    }
}

impl Model {
    /// Element `j` in balance, looked for from path `guess` (m) on. Where there is no balance, or a contact has no
    /// answer, forces are NaN.
    pub(in crate::dynamics) fn in_balance(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        guess: f64,
        now: &FramedKinematics,
    ) -> InBalance {
        let FoundPath { path, evaluations } = self.balanced_path(j, cells, guess, now);
        let elastic = self.linearized_at(j, cells, PathMotion::at_rest(path), now, Bends::Wanted);
        let RadialForce { force, slope } = self.radial_balance(&elastic);
        let path_rate = self.balance_rate(j, &elastic, now);
        let dampers = self.dampers.as_deref().map(|[inner, outer]| [inner, outer]);
        let contacts = dampers.unwrap_or([&self.inner.contact, &self.outer.contact]);
        let damped =
            self.linearized_with(contacts, j, cells, PathMotion { path, rate: path_rate }, now, Bends::LeftOut);
        let ElementChange { inner, outer } = damping(&elastic, &damped);
        let known = if force.abs() <= self.no_force_at(&elastic, slope) { 1.0 } else { f64::NAN };
        InBalance {
            path,
            path_rate,
            inner: (elastic.inner + inner) * known,
            outer: (elastic.outer + outer) * known,
            elastic,
            damped,
            near: cells.map(|cells| cells != [SMOOTH; 2]),
            evaluations: evaluations + EVALUATIONS_AT_BALANCE,
        }
    }

    /// Path of the balance, looked for from `guess` (m) on.
    pub(in crate::dynamics) fn balanced_path(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        guess: f64,
        now: &FramedKinematics,
    ) -> FoundPath {
        let mut search = PathSearch::between(f64::NEG_INFINITY, f64::INFINITY, FIRST_STRIDE);
        let mut u = if guess.is_finite() { guess } else { 0.0 };
        for evaluations in 1..MOST_EVALUATIONS {
            let element = self.linearized_at(j, cells, PathMotion::at_rest(u), now, Bends::LeftOut);
            let RadialForce { force, slope } = self.radial_push(&element);
            if force == 0.0 && slope == 0.0 {
                // Nothing pushes and nothing touches.
                return FoundPath { path: self.touching_path(j, cells[1], now), evaluations };
            }
            let newton = u - force / slope;
            if (newton - u).abs() <= SETTLED {
                return FoundPath { path: newton, evaluations };
            }
            let Some(next) = search.next(u, force, newton) else { return FoundPath { path: u, evaluations } };
            u = next;
        }
        FoundPath { path: u, evaluations: MOST_EVALUATIONS }
    }

    /// u' (m/s) of an element that stays in balance as cage, rings and frames move on.
    fn balance_rate(&self, j: usize, elastic: &Linearized, now: &FramedKinematics) -> f64 {
        let Linearized { e_t, omega, .. } = *elastic;
        let [_, alpha] = self.element_speed(j, &now.cage);
        let moved = elastic.change(&ElementVariation {
            offset: now.drift(),
            cage_angle: omega,
            frames: now.frames.0.map(|turn| [turn.speed, 0.0]),
            ..ElementVariation::default()
        });
        let body = omega * (self.gravity.dot(&e_t) + 2.0 * self.outer_centre_radius * alpha);
        let push = moved.radial(elastic) + omega * elastic.inner.dot(&e_t) + self.element_mass * body;
        let slope = self.radial_balance(elastic).slope;
        if slope < 0.0 { -push / slope } else { 0.0 }
    }

    /// Derivative of an element's forces on the rings by the outer ring's velocity less the inner's along one axis, as
    /// long as its contacts push (N s/m).
    pub(in crate::dynamics) fn damped_by_drift(&self, found: &InBalance, axis: usize) -> Rings {
        let InBalance { elastic, damped, .. } = found;
        let along = elastic.change(&ElementVariation::of_path());
        let stiffness = -along.radial(elastic);
        if stiffness <= 0.0 {
            return Rings::zeros();
        }
        let mut drift = Vector::zeros();
        drift[axis] = 1.0;
        let pushed = elastic.change(&ElementVariation { offset: drift, ..ElementVariation::default() });
        let path_rate = pushed.radial(elastic) / stiffness;
        let d = damped.change(&ElementVariation { drift, path_rate, ..ElementVariation::default() });
        let lag = d.radial(elastic) / stiffness;
        let change = ElementChange { inner: d.inner + along.inner * lag, outer: d.outer + along.outer * lag };
        stacked(-change.inner, change.on_housing(elastic))
    }

    /// The contact of element `j` that has no answer.
    pub(in crate::dynamics) fn contact_without_answer(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        path: f64,
        now: &FramedKinematics,
    ) -> Option<UnsolvedContact> {
        let gap = self.inner_gap(path, now.offset(), self.direction(j, &now.cage), self.clearance(now.films.as_ref()));
        let inner = self.inner_meeting(j, cells[0], &gap, self.element_angle(j, &now.cage));
        let outer = self.outer_meeting(j, cells[1], path, &now.cage);
        // A search ends on the near side of where there is no answer.
        let beyond = |at: Meeting| Meeting { u: at.u + SETTLED, ..at };
        [(RacewaySide::Outer, outer), (RacewaySide::Inner, inner)]
            .into_iter()
            .filter(|(_, at)| at.cells != [SMOOTH; 2])
            .find_map(|(side, at)| {
                let (near, _) = self.near_defect(side, &beyond(at), &now.frames);
                near.err().map(|cause| {
                    let angle = self.angle_from_defect(side, &at, &now.frames);
                    UnsolvedContact { element: j, angle, offset: now.offset().into(), cause }
                })
            })
    }
}

/// What damping changes of the forces on an element, its balance kept.
fn damping(elastic: &Linearized, damped: &Linearized) -> ElementChange {
    let along = elastic.change(&ElementVariation::of_path());
    let stiffness = -along.radial(elastic);
    let (inner, outer) = (damped.inner - elastic.inner, damped.outer - elastic.outer);
    if stiffness <= 0.0 {
        return ElementChange::default();
    }
    let lag = (inner.dot(&elastic.e_r) - outer.x) / stiffness;
    let (inner, outer) = (inner + along.inner * lag, outer + along.outer * lag);
    // No contact pulls.
    let share = share_that_pushes(&elastic.inner, &inner).min(share_that_pushes(&elastic.outer, &outer));
    ElementChange { inner: inner * share, outer: outer * share }
}

/// Largest share of a change that leaves a force pushing, 1 at most.
fn share_that_pushes(force: &Vector, change: &Vector) -> f64 {
    let (along, square) = (force.dot(change), force.norm_squared());
    if along < -square { square / -along } else { 1.0 }
}

#[cfg(test)]
mod tests;
