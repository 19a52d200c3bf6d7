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
//! up to rounding. Where that push changes its sign the path jumps from one raceway to the other, and both forces are
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
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{
    ContactForces, ElementForces, ElementMotion, Linearized, Meeting, Shortcuts, UnsolvedContact,
};
use crate::dynamics::parameters::{FramedKinematics, Model, PathMotion, SMOOTH};
use crate::numerics::number::{Dual, Scalar};
use crate::numerics::plane::Vector;

/// Change of a path below which Newton's next step is exact to rounding (m): what is left is 0.25 (this)²/δ, with the
/// lightest contact's δ of 1e-9 m below 1e-21 m.
const SETTLED: f64 = 1e-15;
/// The same in shares of the lightest contact's δ: where a contact is left with less force than it has at 1e-14 m, as
/// that of an element without weight, Newton's steps are each a third of the one before.
const SETTLED_SHARE: f64 = 0.1;
/// First step of a search that nothing brackets (m); each next one is twice as long.
const FIRST_STRIDE: f64 = 1e-8;
/// Most evaluations of the contacts: doubling from the first stride to a metre, and halving back.
const MOST_EVALUATIONS: u64 = 300;
/// Evaluations of a contact in balance: one each without and with damping.
const EVALUATIONS_AT_BALANCE: u64 = 2;

/// An element in balance. Forces are in parts along e_r and e_t, of the outer contact inwards.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct InBalance<T: Scalar = f64> {
    /// Its contacts without damping.
    pub(in crate::dynamics) elastic: Linearized<T>,
    /// u (m)
    pub(in crate::dynamics) path: T,
    /// u' (m/s)
    pub(in crate::dynamics) path_rate: T,
    /// The contacts' forces, damping included.
    pub(in crate::dynamics) forces: ContactForces<T>,
    /// Whether the inner and the outer contact are near a defect.
    near: [bool; 2],
    /// Evaluations of the contacts that it took.
    pub(in crate::dynamics) evaluations: u64,
}

/// A path that was searched for.
#[derive(Debug, Clone, Copy)]
pub(in crate::dynamics) struct FoundPath {
    /// (m)
    pub(in crate::dynamics) path: f64,
    /// Derivative of the radial force by the path there (N/m); 0 where nothing touches.
    slope: f64,
    /// How often contacts were evaluated.
    evaluations: u64,
}

impl<T: Scalar> InBalance<T> {
    /// The element with its contacts' forces.
    pub(in crate::dynamics) fn element(&self) -> ElementForces<T> {
        let Linearized { at, rho, n, distance, inner, outer } = self.elastic;
        let frames = [inner.frame, outer.frame];
        let frames = [0, 1].map(|side| self.near[side].then_some(frames[side]));
        let at = at.on_path(self.path, self.path_rate);
        ElementForces { at, rho, forces: self.forces, n, distance, frames }
    }
}

impl InBalance {
    /// Whether it is one: a search that found none, or a contact without an answer, leaves NaN.
    pub(in crate::dynamics) fn is_found(&self) -> bool {
        let ContactForces { inner, outer } = self.forces;
        (inner.sum() + outer.sum() + self.path_rate).is_finite()
    }
}

impl Model {
    /// The element `at` in balance, looked for from path `guess` (m) on; where it is on its path does not matter. Where
    /// there is no balance, or a contact has no answer, forces are NaN.
    pub(in crate::dynamics) fn in_balance<T: Scalar>(
        &self,
        cells: [[u32; 2]; 2],
        guess: f64,
        at: &ElementMotion<T>,
        shortcuts: &mut Shortcuts,
    ) -> InBalance<T> {
        let FoundPath { path, slope, evaluations } = self.balanced_path(cells, guess, &at.mapped(T::value), shortcuts);
        let mut still = |path: T| self.linearized(cells, &at.on_path(path, T::from(0.0)), shortcuts);
        let path = if slope == 0.0 {
            T::from(path)
        } else {
            T::root_of(path, slope, |path| self.radial_force(&still(path)).force)
        };
        let elastic = still(path);
        let moving = elastic.at.by_path_and_time();
        let without = elastic.chained(&moving);
        // The balance goes on with time: R_u u' + R_t = 0.
        let Dual { value: force, by: [slope, push] } = self.radial_balance(&moving, &without);
        let path_rate = if slope.value() < 0.0 { -push / slope } else { T::from(0.0) };
        let dampers = self.own_dampers(at.element);
        let damped = self.element_forces(dampers, cells, &at.on_path(path, path_rate), shortcuts);
        let is_known = force.value().abs() <= self.no_force_at(&elastic.values(), slope.value());
        let known = T::from(if is_known { 1.0 } else { f64::NAN });
        let ContactForces { inner, outer } = with_damping(&without, &damped.forces);
        InBalance {
            path,
            path_rate,
            forces: ContactForces { inner: inner * known, outer: outer * known },
            elastic,
            near: cells.map(|cells| cells != [SMOOTH; 2]),
            evaluations: evaluations + EVALUATIONS_AT_BALANCE,
        }
    }

    /// Path of the balance, looked for from `guess` (m) on.
    pub(in crate::dynamics) fn balanced_path(
        &self,
        cells: [[u32; 2]; 2],
        guess: f64,
        at: &ElementMotion,
        shortcuts: &mut Shortcuts,
    ) -> FoundPath {
        let mut search = PathSearch::between(f64::NEG_INFINITY, f64::INFINITY, FIRST_STRIDE);
        let mut u = if guess.is_finite() { guess } else { 0.0 };
        let mut slope = 0.0;
        for evaluations in 1..MOST_EVALUATIONS {
            let element = self.linearized(cells, &at.on_path(u, 0.0).searched(), shortcuts);
            let push = self.radial_push(&element);
            slope = push.slope;
            if push.force == 0.0 && slope == 0.0 {
                // Nothing pushes and nothing touches.
                let path = self.touching_path(at.element, cells[1], at.angle, &at.frames, shortcuts);
                return FoundPath { path, slope, evaluations };
            }
            let newton = u - push.force / slope;
            if (newton - u).abs() <= SETTLED.min(SETTLED_SHARE * element.lightest_approach()) {
                return FoundPath { path: newton, slope, evaluations };
            }
            let Some(next) = search.next(u, push.force, newton) else {
                return FoundPath { path: u, slope, evaluations };
            };
            u = next;
        }
        FoundPath { path: u, slope, evaluations: MOST_EVALUATIONS }
    }

    /// The contact of element `j` that has no answer.
    pub(in crate::dynamics) fn contact_without_answer(
        &self,
        j: usize,
        cells: [[u32; 2]; 2],
        path: f64,
        now: &FramedKinematics,
        shortcuts: &mut Shortcuts,
    ) -> Option<UnsolvedContact> {
        let ElementMotion { e_r, angle, .. } = self.element_motion(j, PathMotion::at_rest(path), now, shortcuts);
        let gap = self.inner_gap(j, path, now.offset(), e_r, self.clearance(now.films.as_ref()));
        let inner = self.inner_meeting(j, cells[0], &gap, angle);
        let outer = self.outer_meeting(angle, j, cells[1], path);
        // A search ends on the near side of where there is no answer.
        let beyond = |at: Meeting| Meeting { u: at.u + SETTLED, ..at };
        [(RacewaySide::Outer, outer), (RacewaySide::Inner, inner)]
            .into_iter()
            .filter(|(_, at)| at.cells != [SMOOTH; 2])
            .find_map(|(side, at)| {
                self.near(side, &beyond(at), &now.frames, shortcuts).err().map(|cause| {
                    let angle = self.angle_from_defect(side, &at, &now.frames);
                    UnsolvedContact { element: j, angle, offset: now.offset().into(), cause }
                })
            })
    }
}

/// The forces with what damping changes of those without it, its balance kept. Their first direction is the path's.
fn with_damping<T: Scalar>(without: &ContactForces<Dual<T, 2>>, damped: &ContactForces<T>) -> ContactForces<T> {
    let elastic =
        ContactForces { inner: without.inner.map(|part| part.value), outer: without.outer.map(|part| part.value) };
    let along = without.by(0);
    let stiffness = -along.radial();
    if stiffness.value() <= 0.0 {
        return elastic;
    }
    let [inner, outer] = [damped.inner - elastic.inner, damped.outer - elastic.outer];
    let lag = (inner.x - outer.x) / stiffness;
    let (inner, outer) = (inner + along.inner * lag, outer + along.outer * lag);
    // No contact pulls.
    let share = share_that_pushes(&elastic.inner, &inner).at_most(share_that_pushes(&elastic.outer, &outer));
    ContactForces { inner: elastic.inner + inner * share, outer: elastic.outer + outer * share }
}

/// Largest share of a change that leaves a force pushing, 1 at most.
fn share_that_pushes<T: Scalar>(force: &Vector<T>, change: &Vector<T>) -> T {
    let (along, square) = (force.dot(change), force.dot(force));
    if along.value() < -square.value() { -square / along } else { T::from(1.0) }
}

#[cfg(test)]
mod tests;
