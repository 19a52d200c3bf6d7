//! How long the next step is to be.

use super::progress::Progress;
use super::workspace::Workspace;
use crate::numerics::rough_power;
use crate::simulation::integration::methods::ExplicitMethod;

/// How far beyond the stable step one may go to land: what grows there is taken back by the next steps, or by error
/// control.
const STABLE_SLACK: f64 = 1.15;
/// How much longer than wanted steps may be to be one fewer.
const EQUAL_SLACK: f64 = 1.03;

/// Factor from this step to the next for an error per tolerance: a proportional–integral controller (Hairer and
/// Wanner, *Solving Ordinary Differential Equations II*, IV.2) with the exponents usual for an estimate of this order.
pub(super) fn step_factor(workspace: &Workspace, error: f64, last_error: f64, progress: &Progress) -> f64 {
    let [now, before] = match workspace.pair {
        ExplicitMethod::PhaseFitted if !progress.choice.implicit => [-0.21, 0.05],
        _ => [-0.17, 0.04],
    };
    0.9 * rough_power(error.max(1e-10), now) * rough_power(last_error, before)
}

/// Factor from a step that failed over a contact change to the next trial. Forces begin and end with the power 1.5 of
/// time, so the error is of order 2.5 whatever the order of the method.
pub(super) fn factor_over_change(error: f64) -> f64 {
    (0.9 * rough_power(error.max(1e-10), -0.33)).clamp(0.1, 0.9)
}

/// Length of the next step within what remains, `wanted` being stable and `next` what error control wants.
#[inline(always)]
pub(super) fn share_of(remaining: f64, wanted: f64, next: f64) -> f64 {
    // One step a little beyond what is stable rather than two, where error control has no objection.
    if next.min(STABLE_SLACK * wanted) >= remaining * (1.0 - 1e-9) {
        remaining
    } else {
        // Equal steps rather than a remnant, and one fewer where that makes them hardly longer.
        remaining / (remaining / (EQUAL_SLACK * wanted)).ceil()
    }
}
