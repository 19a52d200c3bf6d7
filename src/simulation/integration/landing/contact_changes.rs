//! Contact changes: the instants at which a contact begins or ceases to push, found on the dense output of a step.

use crate::numerics::rough_power;
use crate::simulation::integration::kernels::probe;
use crate::simulation::integration::progress::Progress;
use crate::simulation::integration::workspace::{Problem, Span, Workspace};

/// Error of a step that ends past a change by its whole length, times this, is the tolerance where it ends past it by
/// the width to which the instant is narrowed down. Forces begin with the power 1.5 of time, so what is left past the
/// change errs as the power 2.5 of its share: the width is 1e-3 of a step at a tolerance of 1e-5.
const PER_TOLERANCE: f64 = 3.2e-3;

/// Share of the step at which the first contact changes; leaves the forces there.
///
/// How far the contact that has changed most is beyond its change is continuous and changes its sign there. The
/// secant's zero is probed on its far side, so that both ends of the bracket close in; every third probe halves it,
/// whatever the secant says.
pub(in crate::simulation) fn first_change(
    workspace: &mut Workspace,
    problem: Problem,
    span: Span,
    tolerance: f64,
    progress: &Progress,
) -> f64 {
    let narrow = rough_power(PER_TOLERANCE * tolerance, 0.4);
    let (mut before, mut after) = (0.0, 1.0);
    let (mut at_before, mut at_after): (Option<f64>, f64) = (None, workspace.forces.beyond_change(&progress.pushing));
    let mut last_before = true;
    for trial in 0.. {
        let width: f64 = after - before;
        if width <= narrow {
            break;
        }
        let share = match at_before {
            Some(at_before) if trial % 3 != 2 => {
                let secant: f64 = before - width * at_before / (at_after - at_before);
                let margin = if last_before { 0.5 * narrow } else { -0.5 * narrow };
                (secant + margin).clamp(before + 0.25 * narrow, after - 0.25 * narrow)
            }
            _ => 0.5 * (before + after),
        };
        probe(workspace, problem, span, share, progress);
        let value = workspace.forces.beyond_change(&progress.pushing);
        // NaN counts as changed: the step is then cut before it.
        last_before = value <= 0.0;
        if last_before {
            (before, at_before) = (share, Some(value));
        } else {
            (after, at_after) = (share, value);
        }
    }
    if last_before {
        probe(workspace, problem, span, after, progress);
    }
    after
}
