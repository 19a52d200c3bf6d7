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
use super::tangent::{RadialForce, Rings, stacked};
use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{
    ElementChange, ElementForces, ElementMotion, ElementVariation, Linearized, Meeting, Shortcuts, UnsolvedContact,
};
use crate::dynamics::parameters::{FramedKinematics, Model, PathMotion, SMOOTH};
use crate::numerics::number::Scalar;
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
    /// Its contacts damped at the rates of the balance.
    pub(super) damped: Linearized<T>,
    /// u (m)
    pub(in crate::dynamics) path: T,
    /// u' (m/s)
    pub(in crate::dynamics) path_rate: T,
    /// Force of the inner contact on the element (N).
    pub(in crate::dynamics) inner: Vector<T>,
    /// Force of the outer contact on the element (N).
    pub(in crate::dynamics) outer: Vector<T>,
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
    /// Its contacts' forces, damping included.
    pub(in crate::dynamics) fn forces(&self) -> ElementForces<T> {
        let Linearized { at, rho, n, distance, inner, outer } = self.elastic;
        let frames = [inner.frame, outer.frame];
        let frames = [0, 1].map(|side| self.near[side].then_some(frames[side]));
        let at = at.on_path(self.path, self.path_rate);
        ElementForces { at, rho, inner: self.inner, outer: self.outer, n, distance, frames }
    }
}

impl InBalance {
    /// Whether it is one: a search that found none, or a contact without an answer, leaves NaN.
    pub(in crate::dynamics) fn is_found(&self) -> bool {
        (self.inner.x + self.inner.y + self.outer.x + self.outer.y + self.path_rate).is_finite()
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
        let FoundPath { path, slope, evaluations } = self.balanced_path(cells, guess, &at.values(), shortcuts);
        let mut still = |path: T| self.linearized_at(cells, &at.on_path(path, T::from(0.0)), shortcuts);
        let path = if slope == 0.0 {
            T::from(path)
        } else {
            T::root_of(path, slope, |path| self.radial_balance(&still(path)).force)
        };
        let elastic = still(path);
        let RadialForce { force, slope } = self.radial_balance(&elastic);
        let path_rate = self.balance_rate(&elastic);
        let contacts = self.own_dampers(at.element);
        let damped = self.linearized_with(contacts, cells, &at.on_path(path, path_rate), shortcuts);
        let ElementChange { inner, outer } = damping(&elastic, &damped);
        let is_known = force.value().abs() <= self.no_force_at(&elastic.values(), slope.value());
        let known = T::from(if is_known { 1.0 } else { f64::NAN });
        InBalance {
            path,
            path_rate,
            inner: (elastic.inner.force + inner) * known,
            outer: (elastic.outer.force + outer) * known,
            elastic,
            damped,
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
            let element = self.linearized_at(cells, &at.on_path(u, 0.0).searched(), shortcuts);
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

    /// u' (m/s) of an element that stays in balance as cage, rings and frames move on.
    fn balance_rate<T: Scalar>(&self, elastic: &Linearized<T>) -> T {
        let ElementMotion { element, e_t, omega, alpha, drift, frames, .. } = elastic.at;
        let moved = elastic.change(&ElementVariation {
            offset: drift,
            angle: omega,
            frames: frames.0.map(|turn| [turn.speed, T::from(0.0)]),
            ..ElementVariation::default()
        });
        let gravity = self.gravity.map(T::from).dot(&e_t);
        let body = omega * (gravity + alpha * T::Plain::from(2.0 * self.centre_radius(element)));
        let push = moved.radial() + omega * elastic.inner.force.y + body * T::Plain::from(self.mass_of(element));
        let slope = self.radial_balance(elastic).slope;
        if slope.value() < 0.0 { -push / slope } else { T::from(0.0) }
    }

    /// Derivative of an element's forces on the rings by the outer ring's velocity less the inner's along one axis, as
    /// long as its contacts push (N s/m).
    pub(in crate::dynamics) fn damped_by_drift(&self, found: &InBalance, axis: usize) -> Rings {
        let InBalance { elastic, damped, .. } = found;
        let along = elastic.change(&ElementVariation::of_path());
        let stiffness = -along.radial();
        if stiffness <= 0.0 {
            return Rings::zeros();
        }
        let mut drift = Vector::zeros();
        drift[axis] = 1.0;
        let pushed = elastic.change(&ElementVariation { offset: drift, ..ElementVariation::default() });
        let path_rate = pushed.radial() / stiffness;
        let d = damped.change(&ElementVariation { drift, path_rate, ..ElementVariation::default() });
        let lag = d.radial() / stiffness;
        stacked(elastic.at.on_shaft(d.inner + along.inner * lag), elastic.at.on_housing(d.outer + along.outer * lag))
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

/// What damping changes of the forces on an element, its balance kept.
fn damping<T: Scalar>(elastic: &Linearized<T>, damped: &Linearized<T>) -> ElementChange<T> {
    let along = elastic.change(&ElementVariation::of_path());
    let stiffness = -along.radial();
    let [inner, outer] = [damped.inner.force - elastic.inner.force, damped.outer.force - elastic.outer.force];
    if stiffness.value() <= 0.0 {
        return ElementChange { inner: Vector::zeros(), outer: Vector::zeros() };
    }
    let lag = (inner.x - outer.x) / stiffness;
    let (inner, outer) = (inner + along.inner * lag, outer + along.outer * lag);
    // No contact pulls.
    let share =
        share_that_pushes(&elastic.inner.force, &inner).at_most(share_that_pushes(&elastic.outer.force, &outer));
    ElementChange { inner: inner * share, outer: outer * share }
}

/// Largest share of a change that leaves a force pushing, 1 at most.
fn share_that_pushes<T: Scalar>(force: &Vector<T>, change: &Vector<T>) -> T {
    let (along, square) = (force.dot(change), force.dot(force));
    if along.value() < -square.value() { -square / along } else { T::from(1.0) }
}

#[cfg(test)]
mod tests;
