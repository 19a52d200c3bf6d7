//! Why a step cannot be taken: the state, the contact or the ring that fails first, not what follows from it.

use super::progress::Progress;
use super::workspace::{Problem, Span, Workspace};
use crate::contact::near_defect::NearDefect;
use crate::dynamics::contacts::UnsolvedContact;
use crate::dynamics::parameters::{Layout, Model};
use crate::simulation::integration::methods::{ExplicitMethod, explicit, rodas};
use crate::simulation::step_error::{SMALLEST_STEP, StepError};

/// Whether a step shorter than the one of length `h` that failed is still worth trying.
pub(super) fn check_step(
    workspace: &mut Workspace,
    problem: Problem,
    span: Span,
    error: f64,
    progress: &Progress,
) -> Result<(), StepError> {
    let (Problem { model, .. }, since) = (problem, span.from);
    // A step must move time: late in a long communication step its last digit is the limit.
    let (step, limit) = (progress.next_step, SMALLEST_STEP.max(4.0 * f64::EPSILON * since));
    if step >= limit {
        return Ok(());
    }
    if error.is_finite() {
        let component = worst(workspace, model, span.length, progress.choice.implicit, workspace.pair);
        return Err(StepError::Underflow { step, limit, since, component });
    }
    // Rings that the host has moved apart say more than what follows from it.
    check_rings(problem, span.end(), progress)?;
    if let Some(UnsolvedContact { element, angle, offset, cause }) = workspace.forces.unsolved.take() {
        let (element, angle_deg) = (element + 1, angle.to_degrees());
        return Err(StepError::Contact { element, angle_deg, offset, since, cause });
    }
    Err(diverging(workspace, problem, span, step, progress))
}

/// What changes fastest where no step of length `h` has a finite end: at its start, or in Euler's step on, where
/// all rates are finite there too. Behind that each NaN makes others NaN, and which was the
/// first is not known.
fn diverging(workspace: &mut Workspace, problem: Problem, span: Span, step: f64, progress: &Progress) -> StepError {
    let (Problem { model, excitation }, Span { from: since, length: h }) = (problem, span);
    let Workspace { buffers, forces, dense, scratch, weights, .. } = workspace;
    let rates = &mut buffers.first;
    model.derivative(excitation, since, &progress.cells, &progress.state, rates, forces);
    for (i, value) in dense.iter_mut().enumerate() {
        *value = progress.state[i] + h * rates[i];
    }
    model.derivative(excitation, since + h, &progress.cells, dense, scratch, forces);
    let finite = |i: usize| scratch[i].is_finite();
    let rates: &[f64] = if (0..scratch.len()).all(finite) { scratch } else { rates };
    let fastest = first_largest(&model.layout, |i| weights[i] * rates[i]);
    let (component, value) = (model.layout.name(fastest), progress.state[fastest]);
    StepError::NotFinite { component, value, rate: rates[fastest], step, since }
}

/// Name of the state with the largest error in the step tried last, whose length was `h`; tried by the implicit method
/// or, explicitly, by this pair.
pub(super) fn worst(workspace: &Workspace, model: &Model, h: f64, implicit: bool, pair: ExplicitMethod) -> String {
    let error = |i: usize| {
        let buffers = &workspace.buffers;
        if implicit { rodas::error(buffers, i) } else { explicit::error(buffers, pair.error_parts(), i, h) }
    };
    model.layout.name(first_largest(&model.layout, |i| workspace.weights[i] * error(i)))
}

/// The state at which `size` is the largest; NaN is larger than any.
fn first_largest(layout: &Layout, size: impl Fn(usize) -> f64) -> usize {
    let larger = |i: usize, than: usize| {
        let (one, other) = (size(i).abs(), size(than).abs());
        one > other || one.is_nan() && !other.is_nan()
    };
    let states = (0..layout.len).filter(|&i| layout.is_integrated(i));
    states.fold(0, |largest, i| if larger(i, largest) { i } else { largest })
}

/// Beyond an element's radius the rings are beside each other, and a contact that is NaN would push nothing.
pub(in crate::simulation) fn check_rings(problem: Problem, tau: f64, progress: &Progress) -> Result<(), StepError> {
    let Problem { model, excitation } = problem;
    if let Some(space) = &model.space {
        let [inner, outer] = model.rings_in_space(excitation, tau, &progress.state, None);
        let (distance, limit) = (outer.position[2] - inner.position[2], space.largest_shift);
        if !(distance.abs() <= limit) {
            return Err(StepError::AxialDistance { distance, limit, since: tau });
        }
    }
    let shaft = model.shaft_state(excitation, tau, &progress.state).position;
    let housing = model.housing_state(excitation, tau, &progress.state).position;
    let (apart, limit) = (housing - shaft, model.element_radius);
    if apart.norm_squared() <= limit * limit {
        return Ok(());
    }
    let offset = libm::hypot(apart.x, apart.y);
    Err(StepError::RingsApart { offset, limit, shaft: shaft.into(), housing: housing.into(), since: tau })
}

/// Largest contact angle (degrees): no groove goes on so far.
const STEEPEST: f64 = 80.0;

/// In space no ball may climb out of its groove. Counts ends of steps at which a shoulder cuts a contact, and those at
/// which one is beside what is prepared of a surface that varies across the groove.
pub(super) fn check_angles(
    workspace: &Workspace,
    model: &Model,
    since: f64,
    progress: &mut Progress,
) -> Result<(), StepError> {
    let Some(space) = &model.space else { return Ok(()) };
    let contacts = &workspace.forces.contacts;
    let (mut is_cut, mut is_beside) = (false, false);
    for (j, side) in (0..model.element_count).flat_map(|j| [(j, 0), (j, 1)]) {
        let pushes = [&contacts.inner, &contacts.outer][side][j] > 0.0;
        let meridian = [contacts.meridians[2 * side][j], contacts.meridians[2 * side + 1][j]];
        if pushes && space.grooves[side].cosine(meridian) < STEEPEST_COSINE {
            let angle_deg = contacts.contact_angle(space, j, side).to_degrees();
            return Err(StepError::TooSteep { element: j + 1, angle_deg, limit_deg: STEEPEST, since });
        }
        is_cut |= pushes && space.shoulders[side].is_some() && contacts.shoulder_margin(space, j, side) < 0.0;
        let cell = [&progress.cells.inner, &progress.cells.outer][side][j];
        let surface = [&model.inner, &model.outer][side].defects.varying_across(cell);
        if let Some(ends) = surface.and_then(NearDefect::prepared_across).filter(|_| pushes) {
            let force = [&contacts.inner, &contacts.outer][side][j];
            is_beside |= space.is_beside(ends, side, contacts.contact_angle(space, j, side), force);
        }
    }
    progress.truncated_contacts += u64::from(is_cut);
    progress.off_track_contacts += u64::from(is_beside);
    Ok(())
}

/// cos 80°
const STEEPEST_COSINE: f64 = 0.173_648_177_666_930_35;
