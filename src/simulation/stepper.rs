//! Advances the state by one communication step: error control, and steps that land on what is not smooth.
//!
//! Three kinds of instants end a step exactly: the communication point; a *knot*, where an element enters another cell
//! of the defect; a *contact change*, where a contact begins or ceases to push. Within a step every element stays in
//! its cell and the right-hand side is smooth, but for the C¹ onset of a contact force.
//!
//! Knots are whole numbers (the cell of each element), never recognised by comparing times, so a restored state
//! continues with the same bits. Contact changes are located by bisection on the dense output.
//!
//! The error of a step is measured against the largest approach in any contact, because that is what forces follow
//! from: 1e-5 of a path of 1 mm would be more than a loaded contact's whole approach.

use super::dormand_prince::DormandPrince;
use crate::contact::error::ContactError;
use crate::dynamics::drive::Drive;
use crate::dynamics::forces::{Forces, SMOOTH};
use crate::dynamics::model::Model;
use std::f64::consts::TAU;

/// Why a communication step could not be finished.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum StepError {
    /// Error control asks for a step that no longer moves time.
    #[error(
        "the integration step fell to {step:.1e} s (limit {limit:.0e} s) {since:.6e} s into the communication step; \
         the state that resists is {component}: raise solver.tolerance or look for an extreme load or damping"
    )]
    Underflow {
        /// Step wanted [s].
        step: f64,
        /// Smallest step [s].
        limit: f64,
        /// Time into the communication step [s].
        since: f64,
        /// State with the largest error.
        component: String,
    },
    /// An element left the space between the rings.
    #[error(
        "element {element} has left the bearing {since:.6e} s into the communication step: its path is {path:.3e} m, \
         the limit is its radius, {limit:.3e} m; check ring positions and loads"
    )]
    ThrownOut {
        /// Number of the element, from 1.
        element: usize,
        /// Its path u [m].
        path: f64,
        /// Largest path [m].
        limit: f64,
        /// Time into the communication step [s].
        since: f64,
    },
    /// More integration steps than allowed in one communication step.
    #[error(
        "{steps} integration steps did not finish the communication step: {since:.6e} s are done; \
         raise solver.tolerance or take shorter communication steps"
    )]
    TooManySteps {
        /// Steps taken.
        steps: u64,
        /// Time into the communication step [s].
        since: f64,
    },
}

/// The part of the state that the integration owns.
#[derive(Debug, Clone, PartialEq)]
pub struct Progress {
    /// State vector, as [`crate::dynamics::model::Layout`] lays it out.
    pub state: Vec<f64>,
    /// Cell of the defect in which each element is.
    pub cells: Vec<u32>,
    /// Whether the inner contacts, then the outer contacts, push.
    pub pushing: Vec<bool>,
    /// Step that error control would like next [s].
    pub next_step: f64,
    /// Error of the last accepted step, per tolerance.
    pub last_error: f64,
    /// Mean forces on inner and outer ring over the last communication step [N].
    pub mean_force: [f64; 4],
    /// Accepted steps.
    pub steps: u64,
    /// Steps that were tried again with a shorter one, for error or to land.
    pub rejected_steps: u64,
    /// Approaches near the defect that were computed.
    pub defect_lookups: u64,
}

impl Progress {
    /// A state at rest in `len` places for `count` elements.
    pub fn new(len: usize, count: usize) -> Self {
        Self {
            state: vec![0.0; len],
            cells: vec![SMOOTH; count],
            pushing: vec![false; 2 * count],
            next_step: FIRST_STEP,
            last_error: 1.0,
            mean_force: [0.0; 4],
            steps: 0,
            rejected_steps: 0,
            defect_lookups: 0,
        }
    }
}

impl Progress {
    /// Copies the progress of another state of the same model; allocates nothing.
    pub fn copy_from(&mut self, other: &Progress) {
        let Self { state, cells, pushing, .. } = self;
        state.copy_from_slice(&other.state);
        cells.copy_from_slice(&other.cells);
        pushing.copy_from_slice(&other.pushing);
        (self.next_step, self.last_error, self.mean_force) = (other.next_step, other.last_error, other.mean_force);
        (self.steps, self.rejected_steps, self.defect_lookups) =
            (other.steps, other.rejected_steps, other.defect_lookups);
    }
}

/// Step tried first [s]: far below the period of an element on its contacts, and grown at once if that was too timid.
const FIRST_STEP: f64 = 1e-6;
/// Smallest step [s]; the fastest real mode of a steel bearing's element lasts 1e-8 s.
const SMALLEST_STEP: f64 = 1e-15;
/// Approach below which errors are no longer measured relative to it [m]: a contact of about 0.2 N.
const SMALLEST_APPROACH: f64 = 0.1e-6;
/// Turns an approach into a velocity [1/s]: below the rings' angular frequency on their contacts. With it the error of
/// accelerations comes out at about ten times the tolerance while contacts hold.
const VELOCITY_PER_APPROACH: f64 = 1e3;
/// Shares of a step: a contact change this close to its start is not landed on, which bounds chatter.
const CLOSEST_CHANGE: f64 = 1e-4;
/// Bisections that locate a contact change: 1e-7 of a step. The force begins with the power 1.5 of what is left.
const CHANGE_BISECTIONS: usize = 24;
const MOST_STEPS: u64 = 50_000_000;

/// Workspaces of the integration; holds nothing that the future depends on.
#[derive(Debug, Clone)]
pub struct Stepper {
    method: DormandPrince,
    forces: Forces,
    dense: Vec<f64>,
    scratch: Vec<f64>,
    /// Sum over the stages of the step tried last of weight × ring force.
    weighted_force: [f64; 4],
    first_force: [f64; 4],
    last_force: [f64; 4],
}

/// The next knot to land on.
#[derive(Debug, Clone, Copy)]
struct Knot {
    tau: f64,
    element: usize,
    cell: u32,
}

impl Stepper {
    /// Workspaces for a model.
    pub fn new(model: &Model) -> Self {
        let len = model.layout.len;
        Self {
            method: DormandPrince::new(len),
            forces: Forces::new(model.element_count),
            dense: vec![0.0; len],
            scratch: vec![0.0; len],
            weighted_force: [0.0; 4],
            first_force: [0.0; 4],
            last_force: [0.0; 4],
        }
    }

    /// Advances `progress` by `step` [s] under `drive`.
    pub fn advance(
        &mut self,
        model: &Model,
        drive: &Drive,
        tolerance: f64,
        step: f64,
        progress: &mut Progress,
    ) -> Result<(), StepError> {
        let mut tau = 0.0;
        let mut impulse = [0.0; 4];
        let first_count = progress.steps + progress.rejected_steps;
        let mut knot = next_knot(model, drive, tau, step, &progress.cells);
        self.first_stage(model, drive, tau, progress);
        while tau < step {
            if let Some(at) = knot
                && at.tau <= tau
            {
                progress.cells[at.element] = at.cell;
                knot = next_knot(model, drive, tau, step, &progress.cells);
                self.first_stage(model, drive, tau, progress);
                continue;
            }
            let target = knot.map_or(step, |k| k.tau.min(step));
            let h = self.accepted_step(model, drive, tolerance, (tau, target), progress)?;
            for (sum, force) in impulse.iter_mut().zip(self.weighted_force) {
                *sum += h * force;
            }
            tau = if h == target - tau { target } else { tau + h };
            progress.steps += 1;
            let taken = progress.steps + progress.rejected_steps - first_count;
            if taken > MOST_STEPS {
                return Err(StepError::TooManySteps { steps: taken, since: tau });
            }
        }
        // A knot right at the communication point is passed now, so that outputs there are those of the new cell.
        while let Some(at) = knot
            && at.tau <= tau
        {
            progress.cells[at.element] = at.cell;
            knot = next_knot(model, drive, tau, step, &progress.cells);
        }
        progress.mean_force = impulse.map(|i| i / step);
        progress.defect_lookups += std::mem::take(&mut self.forces.defect_lookups);
        Ok(())
    }

    /// Why a contact near the defect could not be computed, if that is what made a step fail.
    pub fn unsolved_contact(&mut self) -> Option<ContactError> {
        self.forces.unsolved.take()
    }

    /// Derivative at the start of the next step.
    fn first_stage(&mut self, model: &Model, drive: &Drive, tau: f64, progress: &Progress) {
        model.derivative(drive, tau, &progress.cells, &progress.state, &mut self.method.stages[0], &mut self.forces);
        self.first_force = ring_forces(&self.forces);
    }

    /// Takes one step from `from` that goes no further than `to`, as long as error control and contact changes allow,
    /// and returns its length.
    fn accepted_step(
        &mut self,
        model: &Model,
        drive: &Drive,
        tolerance: f64,
        (from, to): (f64, f64),
        progress: &mut Progress,
    ) -> Result<f64, StepError> {
        let remaining = to - from;
        // A landing on a contact change: the step that ends there.
        let mut landing = None;
        loop {
            let wanted = progress.next_step;
            let h = landing.unwrap_or(if wanted >= remaining * (1.0 - 1e-9) {
                remaining
            } else if 2.0 * wanted > remaining {
                // Two equal steps rather than one and a remnant.
                0.5 * remaining
            } else {
                wanted
            });
            self.try_step(model, drive, from, h, progress);
            let (error, worst) = self.error(model, tolerance, h);
            if !(error <= 1.0) {
                progress.rejected_steps += 1;
                let factor = if error.is_finite() { step_factor(error, 1.0).clamp(0.1, 0.9) } else { 0.1 };
                progress.next_step = h * factor;
                landing = None;
                if progress.next_step < SMALLEST_STEP {
                    return Err(StepError::Underflow {
                        step: progress.next_step,
                        limit: SMALLEST_STEP,
                        since: from,
                        component: model.layout.name(worst),
                    });
                }
                continue;
            }
            let changed = self.pushing_differs(progress);
            if changed && landing.is_none() {
                let share = self.first_change(model, drive, from, h, progress);
                if share > CLOSEST_CHANGE && share < 1.0 {
                    progress.rejected_steps += 1;
                    landing = Some(share * h);
                    // The contacts that change there, by the dense output: the shorter step may end a hair before.
                    for (flag, value) in progress.pushing.iter_mut().zip(self.pushing_values()) {
                        *flag = value > 0.0;
                    }
                    continue;
                }
            }
            if landing.is_none() {
                for (flag, value) in progress.pushing.iter_mut().zip(self.pushing_values()) {
                    *flag = value > 0.0;
                }
            }
            let proposal = h * step_factor(error, progress.last_error).clamp(0.2, 5.0);
            // A step cut short to land somewhere says nothing against the step wanted before it.
            progress.next_step = if h < wanted { proposal.max(wanted) } else { proposal };
            progress.last_error = error.max(1e-4);
            self.accept(model, from + h, progress)?;
            return Ok(h);
        }
    }

    fn accept(&mut self, model: &Model, since: f64, progress: &mut Progress) -> Result<(), StepError> {
        progress.state.copy_from_slice(&self.method.end);
        self.method.carry_over();
        self.first_force = self.last_force;
        for (j, &path) in progress.state[..model.element_count].iter().enumerate() {
            if !(path.abs() <= model.element_radius) {
                return Err(StepError::ThrownOut { element: j + 1, path, limit: model.element_radius, since });
            }
        }
        Ok(())
    }

    fn try_step(&mut self, model: &Model, drive: &Drive, from: f64, h: f64, progress: &Progress) {
        let weights = super::dormand_prince::STAGES[6];
        let mut sum = self.first_force.map(|f| weights[0] * f);
        let (forces, cells) = (&mut self.forces, &progress.cells);
        let mut last = [0.0; 4];
        self.method.try_step(&progress.state, h, |c, state, out, stage| {
            model.derivative(drive, from + c, cells, state, out, forces);
            last = ring_forces(forces);
            if stage < 6 {
                for (sum, force) in sum.iter_mut().zip(last) {
                    *sum += weights[stage] * force;
                }
            }
        });
        (self.weighted_force, self.last_force) = (sum, last);
    }

    /// Largest error of the step tried last, per tolerance, and the state that has it.
    fn error(&self, model: &Model, tolerance: f64, h: f64) -> (f64, usize) {
        let layout = &model.layout;
        let length = self.forces.largest_approach() + SMALLEST_APPROACH;
        let speed = VELOCITY_PER_APPROACH * length;
        let mut worst = (0.0, 0);
        for i in 0..layout.len {
            let scale = if layout.is_position(i) { length } else { speed };
            let error = (self.method.error(i, h) / scale).abs();
            if !(error <= worst.0) {
                worst = (error, i);
            }
        }
        (worst.0 / tolerance, worst.1)
    }

    fn pushing_values(&self) -> impl Iterator<Item = f64> {
        self.forces.inner_pushing.iter().chain(&self.forces.outer_pushing).copied()
    }

    /// Whether any contact pushes where it did not at the start of the step, or the other way round.
    fn pushing_differs(&self, progress: &Progress) -> bool {
        self.pushing_values().zip(&progress.pushing).any(|(value, &flag)| (value > 0.0) != flag)
    }

    /// Share of the step at which the first contact changes; leaves the forces there.
    fn first_change(&mut self, model: &Model, drive: &Drive, from: f64, h: f64, progress: &Progress) -> f64 {
        let (mut before, mut after) = (0.0, 1.0);
        for _ in 0..CHANGE_BISECTIONS {
            let middle = 0.5 * (before + after);
            if self.differs_at(model, drive, (from, h), middle, progress) { after = middle } else { before = middle }
        }
        self.differs_at(model, drive, (from, h), after, progress);
        after
    }

    fn differs_at(
        &mut self,
        model: &Model,
        drive: &Drive,
        (from, h): (f64, f64),
        share: f64,
        progress: &Progress,
    ) -> bool {
        self.method.dense(&progress.state, h, share, &mut self.dense);
        let tau = from + share * h;
        model.derivative(drive, tau, &progress.cells, &self.dense, &mut self.scratch, &mut self.forces);
        self.pushing_differs(progress)
    }
}

fn ring_forces(forces: &Forces) -> [f64; 4] {
    [forces.shaft[0], forces.shaft[1], forces.housing[0], forces.housing[1]]
}

/// Factor from this step to the next for an error per tolerance: a proportional–integral controller (Hairer and
/// Wanner, *Solving Ordinary Differential Equations II*, IV.2) with the exponents usual for order 5(4).
fn step_factor(error: f64, last_error: f64) -> f64 {
    0.9 * libm::pow(error.max(1e-10), -0.17) * libm::pow(last_error, 0.04)
}

/// The earliest passage of an element into another cell between `tau` and `end`.
fn next_knot(model: &Model, drive: &Drive, tau: f64, end: f64, cells: &[u32]) -> Option<Knot> {
    let (near, centre) = model.defect.as_ref()?;
    let knots = near.knots();
    let last = knots.len() - 1;
    let cage_angle = drive.cage_angle(tau);
    let (speed, acceleration) = (drive.cage.rate_at(tau), drive.cage.0[2]);
    let mut earliest: Option<Knot> = None;
    for (element, &cell) in cells.iter().enumerate() {
        let angle = model.angle_from_defect(element, cage_angle, *centre);
        // Angle to the next knot on either side, and the cell beyond it.
        let (up, cell_up, down, cell_down) = if cell == SMOOTH {
            (around(knots[0] - angle), 0, around(angle - knots[last]), last as u32 - 1)
        } else {
            let i = cell as usize;
            let beyond_up = if i + 1 == last { SMOOTH } else { cell + 1 };
            let beyond_down = if i == 0 { SMOOTH } else { cell - 1 };
            ((knots[i + 1] - angle).max(0.0), beyond_up, (angle - knots[i]).max(0.0), beyond_down)
        };
        let passages = [
            (first_passage(speed, acceleration, up), cell_up),
            (first_passage(-speed, -acceleration, down), cell_down),
        ];
        for (wait, cell) in passages {
            let at = tau + wait;
            if at <= end && earliest.is_none_or(|e| at < e.tau) {
                earliest = Some(Knot { tau: at, element, cell });
            }
        }
    }
    earliest
}

/// An angle [rad] brought into [0, 2π); one that falls short of 0 by rounding is 0.
fn around(angle: f64) -> f64 {
    let within = angle.rem_euclid(TAU);
    if within > TAU - 1e-9 { 0.0 } else { within }
}

/// Time until speed·t + ½ acceleration·t² first reaches `angle` ≥ 0 going forward; infinite if never.
fn first_passage(speed: f64, acceleration: f64, angle: f64) -> f64 {
    if angle == 0.0 {
        // On the knot: passed at once when moving forward.
        return if speed > 0.0 || (speed == 0.0 && acceleration > 0.0) { 0.0 } else { f64::INFINITY };
    }
    if acceleration == 0.0 {
        return if speed > 0.0 { angle / speed } else { f64::INFINITY };
    }
    let square = speed * speed + 2.0 * acceleration * angle;
    if square < 0.0 {
        return f64::INFINITY;
    }
    // The smallest positive root, without cancellation: t = 2 angle/(speed + √…).
    let divisor = speed + square.sqrt();
    if divisor > 0.0 { 2.0 * angle / divisor } else { f64::INFINITY }
}
