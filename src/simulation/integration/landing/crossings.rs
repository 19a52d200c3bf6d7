//! Crossings: passages into another cell of a defect that no quadratic of time foretells, found on the dense output of
//! a step: those of contacts with the inner raceway, and in an uneven cage those of all contacts.
//!
//! In which direction an element is seen from the inner ring's centre depends on where that is, so these instants are
//! roots and no known times. A step that ends beyond one is taken again to end on it, and the contact then changes its
//! cell, a whole number that nothing else decides. As on known knots, a contact meets the knot ahead of its cell on its
//! way and no other; the one it has just passed does not count again unless it comes back.

use super::knots::Contact;
use crate::dynamics::parameters::{Ahead, Cells, Defects, FramedKinematics, LeadPieces, Model};
use crate::simulation::integration::kernels::probe;
use crate::simulation::integration::progress::Progress;
use crate::simulation::integration::workspace::{Problem, Span, Workspace};

/// Width of a step, as a share, to which the instant of a crossing is narrowed down: at the speed of an element on its
/// way a millionth of a nanometre.
const NARROW: f64 = 1e-11;
/// Most probes of the dense output: halving alone reaches the width in 37.
const MOST: usize = 60;

/// A passage into another cell within a step.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulation) struct Crossing {
    /// Share of the step at which it happens.
    pub(in crate::simulation) share: f64,
    pub(in crate::simulation) contact: Contact,
    /// The cell beyond.
    pub(in crate::simulation) cell: u32,
}

/// A contact that defects concern.
#[derive(Clone, Copy)]
pub(in crate::simulation) struct Watched<'a> {
    pub(in crate::simulation) defects: &'a Defects,
    pub(in crate::simulation) element: usize,
    pub(in crate::simulation) cell: u32,
    pub(in crate::simulation) contact: Contact,
}

/// A contact at the start of the step.
#[derive(Clone, Copy)]
struct Begun<'a> {
    at: Watched<'a>,
    tau: f64,
    /// Angle by which it is seen ahead of the element's position in an even cage (rad).
    lead: f64,
}

/// A crossing as the two ends of the step show it.
#[derive(Clone, Copy)]
struct Candidate<'a> {
    begun: Begun<'a>,
    /// Share of the step at which it happens if motion is even.
    share: f64,
    /// Angle to go until then (rad), with its sign.
    way: f64,
    /// The cell beyond.
    cell: u32,
}

/// The first crossing within the step tried last.
pub(in crate::simulation) fn first_crossing(
    workspace: &mut Workspace,
    problem: Problem,
    span: Span,
    progress: &Progress,
) -> Option<Crossing> {
    let model = problem.model;
    let Workspace { buffers, forces, .. } = &mut *workspace;
    let pieces = &mut forces.shortcuts.leads;
    let [start, end] = [(span.from, &progress.state), (span.end(), &buffers.end)].map(|(tau, state)| Instant {
        now: model.kinematics(problem.excitation, tau, state),
        tau,
        state,
    });
    let mut first: Option<Candidate> = None;
    for at in watched(model, &progress.cells, model.is_uneven()) {
        let frame = start.now.frames.of(at.defects.frame).angle;
        let direction = start.now.cage.angle + model.element_offset(at.element);
        let begun = Begun { at, tau: start.tau, lead: start.lead(problem, &at, pieces) };
        let travel = begun.travel(problem, &end, pieces);
        let Some(Ahead { angle, beyond }) = at.defects.ahead(at.cell, direction + begun.lead - frame, travel > 0.0)
        else {
            continue;
        };
        let way = angle.max(0.0);
        if travel != 0.0 && travel.abs() >= way {
            let share = way / travel.abs();
            if first.is_none_or(|first| share < first.share) {
                first = Some(Candidate { begun, share, way: way * travel.signum(), cell: beyond });
            }
        }
    }
    let first = first?;
    let share = root(workspace, problem, span, progress, &first);
    Some(Crossing { share, contact: first.begun.at.contact, cell: first.cell })
}

/// Share of the step at which a contact has made its way, bracketed by secants; on the far side.
fn root(workspace: &mut Workspace, problem: Problem, span: Span, progress: &Progress, of: &Candidate) -> f64 {
    let Candidate { begun, share: guess, way, .. } = *of;
    let model = problem.model;
    let (mut low, mut high) = (0.0f64, 1.0f64);
    let mut share = guess;
    for number in 0..MOST {
        if high - low <= NARROW || !(share > 0.0 && share < 1.0) {
            break;
        }
        probe(workspace, problem, span, share, progress);
        let tau = span.from + share * span.length;
        let now = model.kinematics(problem.excitation, tau, &workspace.dense);
        let there = Instant { now, tau, state: &workspace.dense };
        let made = begun.travel(problem, &there, &mut workspace.forces.shortcuts.leads) / way;
        let beyond = made >= 1.0;
        if beyond {
            high = share
        } else {
            low = share
        }
        // Motion over a step is nearly even. A probe on either side of the root closes the bracket; every fourth one
        // halves it, whatever the secant says.
        let secant = share / made.max(f64::MIN_POSITIVE) + if beyond { -0.4 * NARROW } else { 0.4 * NARROW };
        share = if number % 4 != 3 && secant > low && secant < high { secant } else { 0.5 * (low + high) };
    }
    if guess <= 0.0 { 0.0 } else { high }
}

/// Positions at one instant.
#[derive(Clone, Copy)]
struct Instant<'a> {
    now: FramedKinematics,
    tau: f64,
    state: &'a [f64],
}

/// All contacts with the inner raceway that may meet a defect; with those with the outer one, if `outside`.
pub(in crate::simulation) fn watched<'a>(
    model: &'a Model,
    cells: &'a Cells,
    outside: bool,
) -> impl Iterator<Item = Watched<'a>> {
    let inner = &model.inner.defects;
    let of_ring = cells.inner.iter().enumerate().filter(|_| !inner.is_empty());
    let of_ring = of_ring.map(|(j, &cell)| Watched { defects: inner, element: j, cell, contact: Contact::Inner(j) });
    let outer = &model.outer.defects;
    let of_outer = cells.outer.iter().enumerate().filter(move |_| outside && !outer.is_empty());
    let of_outer = of_outer.map(|(j, &cell)| Watched { defects: outer, element: j, cell, contact: Contact::Outer(j) });
    let sides = if outside { 0..2 } else { 0..1 };
    let own = model.defective.iter().zip(&cells.own).enumerate();
    let own = own.flat_map(move |(k, (defective, cells))| {
        sides.clone().map(move |side| Watched {
            defects: &defective.defects[side],
            element: defective.element,
            cell: cells[side],
            contact: Contact::Own(k, side),
        })
    });
    of_ring.chain(of_outer).chain(own)
}

impl Instant<'_> {
    /// Angle by which a contact is seen ahead of its element's position in an even cage (rad): from the inner ring,
    /// and in an uneven cage.
    fn lead(&self, problem: Problem, at: &Watched, pieces: &mut LeadPieces) -> f64 {
        at.lead(problem, (self.tau, self.state), &self.now, pieces)
    }
}

impl Watched<'_> {
    /// Angle by which it is seen ahead of its element's position in an even cage (rad), in a state at an instant (s).
    pub(in crate::simulation) fn lead(
        &self,
        problem: Problem,
        (tau, state): (f64, &[f64]),
        now: &FramedKinematics,
        pieces: &mut LeadPieces,
    ) -> f64 {
        let (model, j) = (problem.model, self.element);
        let of_cage = model.lead_with(j, now.cage_angle(), pieces);
        match self.contact {
            Contact::Inner(_) | Contact::Own(_, 0) => {
                model.seen_from_inside(j, (problem.excitation, tau), state, now, &of_cage) + of_cage.angle
            }
            _ => of_cage.angle,
        }
    }
}

impl Begun<'_> {
    /// Angle that the contact has gone since (rad), against the body with its defect.
    fn travel(&self, problem: Problem, to: &Instant, pieces: &mut LeadPieces) -> f64 {
        // Of the whole angles only the change, so that no turns are to be counted and no digits are lost.
        let (cage, frame) =
            (&problem.excitation.cage, &problem.excitation.frames[self.at.defects.frame as usize].since);
        let even = (cage.at(to.tau) - cage.at(self.tau)) - (frame.at(to.tau) - frame.at(self.tau));
        even + (to.lead(problem, &self.at, pieces) - self.lead)
    }
}
