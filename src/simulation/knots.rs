//! Knots: the instants at which an element enters another cell of the defect, found from whole cells, never by comparing times.
//!
//! The cage angle is a quadratic of time within a communication step, so the passages are roots of a quadratic.

use crate::dynamics::drive::Drive;
use crate::dynamics::forces::SMOOTH;
use crate::dynamics::model::Model;
use std::f64::consts::TAU;

/// The next knot to land on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Knot {
    /// When [s] since the communication point.
    pub(super) tau: f64,
    /// Which element, from 0.
    pub(super) element: usize,
    /// The cell it enters.
    pub(super) cell: u32,
}

/// The earliest passage of an element into another cell between `tau` and `end`.
pub(super) fn next_knot(model: &Model, drive: &Drive, tau: f64, end: f64, cells: &[u32]) -> Option<Knot> {
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
