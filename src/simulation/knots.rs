//! Knots: the instants at which an element enters another cell of the defect, found from whole cells, never by
//! comparing times.
//!
//! The cage angle is a quadratic of time within a communication step, so the cage turns back at most once, and before
//! and after that it goes one way only. Which of these two *legs* it is on is, like a cell, no question of times: the
//! way back begins with the first passage that only it can make. On a leg an element meets the knot ahead of its cell
//! and no other. The knot that it has just passed, from which rounding leaves it at an angle of about 0, therefore
//! neither fires again nor is missed when the cage comes back; and a knot on which the cage turns is passed both ways
//! or not at all.

use crate::dynamics::drive::Drive;
use crate::dynamics::model::Model;
use crate::dynamics::raceway::Ahead;

/// Part of a communication step on which the cage turns one way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Leg {
    /// The way on which the step begins.
    Out,
    /// The way back, after the cage's speed has passed through 0.
    Back,
}

/// The next knot to land on.
#[derive(Debug, Clone, Copy)]
pub(super) struct Knot {
    /// When [s] since the communication point.
    pub(super) tau: f64,
    /// Which element, from 0.
    pub(super) element: usize,
    /// The cell it enters.
    pub(super) cell: u32,
    /// On which leg.
    pub(super) leg: Leg,
}

/// The earliest passage of an element into another cell between `tau`, on `leg`, and `end`.
pub(super) fn next_knot(model: &Model, drive: &Drive, (tau, leg): (f64, Leg), end: f64, cells: &[u32]) -> Option<Knot> {
    let [_, speed, acceleration] = drive.cage.0;
    let out = if speed == 0.0 { acceleration } else { speed };
    let on = |leg: Leg, way: f64| earliest(model, drive, (tau, leg), (way, end), cells);
    let found = if leg == Leg::Out && out != 0.0 { on(Leg::Out, out.signum()) } else { None };
    // Every passage on the way out comes before every one on the way back.
    if found.is_none() && speed * acceleration < 0.0 { on(Leg::Back, acceleration.signum()) } else { found }
}

/// The earliest passage by `end` on a leg that goes `way`, 1 or −1.
fn earliest(
    model: &Model,
    drive: &Drive,
    (tau, leg): (f64, Leg),
    (way, end): (f64, f64),
    cells: &[u32],
) -> Option<Knot> {
    let defect = model.outer.defect.as_ref()?;
    let cage_angle = drive.cage_angle(tau);
    let (mut speed, acceleration) = (way * drive.cage.rate_at(tau), way * drive.cage.0[2]);
    if leg == Leg::Out {
        // Where the cage is about to turn, rounding may show it on its way back already.
        speed = speed.max(0.0);
    }
    let mut earliest: Option<Knot> = None;
    for (element, &cell) in cells.iter().enumerate() {
        let Ahead { angle, beyond } = defect.ahead(cell, model.angle_from_defect(element, cage_angle), way > 0.0);
        let at = tau + passage(speed, acceleration, angle.max(0.0));
        if at <= end && earliest.is_none_or(|e| at < e.tau) {
            earliest = Some(Knot { tau: at, element, cell: beyond, leg });
        }
    }
    earliest
}

/// Time until speed·t + ½ acceleration·t² reaches `angle` ≥ 0 on its way forward, infinite if never. Where it begins by
/// moving backward that is when it comes back, also for an angle of 0.
fn passage(speed: f64, acceleration: f64, angle: f64) -> f64 {
    let root = (speed * speed + 2.0 * acceleration * angle).sqrt();
    // Of the two forms of the same root the one in which nothing cancels. No root is no number, and then neither is the
    // time.
    if speed > 0.0 {
        2.0 * angle / (speed + root)
    } else if acceleration > 0.0 {
        (root - speed) / acceleration
    } else {
        f64::INFINITY
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::drive::{CageAngle, Quadratic};
    use crate::dynamics::jacobian::tests::lively;
    use crate::dynamics::raceway::SMOOTH;
    use crate::scene::{Damping, Motion};
    use proptest::prelude::*;

    /// Speeds, accelerations and angles of every size and sign, zero among them.
    fn number(largest: f64) -> impl Strategy<Value = f64> {
        let sign = prop_oneof![Just(1.0), Just(-1.0)];
        prop_oneof![
            1 => Just(0.0),
            8 => (sign, -18.0..0.0f64).prop_map(move |(sign, power)| sign * largest * 10f64.powf(power)),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 4000, failure_persistence: None, ..ProptestConfig::default() })]
        #[test]
        fn a_passage_is_where_a_brute_force_search_finds_it(
            speed in number(1e4),
            acceleration in number(1e8),
            angle in number(6.0).prop_map(f64::abs),
            tangent in prop_oneof![4 => Just(None), 1 => (-1e-12..1e-12f64).prop_map(Some)],
        ) {
            // Also motions whose turning point is the knot, or misses it by rounding.
            let angle = match tangent {
                Some(miss) if speed > 0.0 && acceleration < 0.0 => -0.5 * speed * speed / acceleration * (1.0 + miss),
                _ => angle,
            };
            let moved = |t: f64| t * (speed + 0.5 * acceleration * t);
            // Rounding of the two terms, which may cancel.
            let blur = |t: f64| 8.0 * f64::EPSILON * (t * (speed.abs() + 0.5 * acceleration.abs() * t) + angle);
            let found = passage(speed, acceleration, angle);
            let searched = if found.is_finite() {
                prop_assert!((moved(found) - angle).abs() <= blur(found), "{found}: {} of {angle}", moved(found));
                found
            } else {
                // Farther than any motion here would need.
                10.0 * (1.0 + angle) / (speed.abs() + acceleration.abs()).max(1e-30)
            };
            // Once it has moved back, an angle of 0 is reached on return.
            let turned = if speed <= 0.0 && acceleration > 0.0 { -speed / acceleration } else { 0.0 };
            prop_assert!(found.is_nan() || found >= turned);
            for k in 1..1000 {
                let t = turned + (searched - turned) * f64::from(k) / 1000.0;
                prop_assert!(moved(t) <= angle + blur(t), "{found}: at {t} already {} of {angle}", moved(t));
            }
        }
    }

    /// Passes the knots of one communication step; gives how many.
    fn walk(model: &Model, drive: &Drive, end: f64, cells: &mut [u32]) -> usize {
        let (mut tau, mut leg, mut count) = (0.0, Leg::Out, 0);
        while let Some(knot) = next_knot(model, drive, (tau, leg), end, cells) {
            (tau, leg) = (knot.tau.max(tau), knot.leg);
            cells[knot.element] = knot.cell;
            count += 1;
            assert!(count < 100_000, "{drive:?}: passages without end");
        }
        count
    }

    /// How far the angle of element `j` is outside its cell [rad]; negative inside.
    fn outside(model: &Model, j: usize, cage_angle: f64, cell: u32) -> f64 {
        let defect = model.outer.defect.as_ref().unwrap();
        let (knots, angle) = (defect.knots(), model.angle_from_defect(j, cage_angle));
        match cell {
            SMOOTH => (angle - knots[0]).min(knots[knots.len() - 1] - angle),
            cell => (knots[cell as usize] - angle).max(angle - knots[cell as usize + 1]),
        }
    }

    fn model() -> Model {
        lively([Motion::Fixed; 2], Damping::HuntCrossley(0.3), 0.0).0
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]
        #[test]
        fn after_any_motion_every_element_is_in_the_cell_of_its_angle(
            start in -3.2..3.2f64,
            speed in number(300.0),
            steps in prop::collection::vec((number(1e6), 1e-6..0.02f64), 1..12),
            on_knot in prop::option::of((0..20usize, 0..9usize)),
        ) {
            let model = model();
            let defect = model.outer.defect.as_ref().unwrap();
            // Perhaps an element begins exactly on a knot.
            let start = on_knot.map_or(start, |(k, j)| {
                defect.knots()[k % defect.knots().len()] + defect.centre - model.element_offset(j)
            });
            let mut angle = CageAngle::new(start);
            let mut cells: Vec<u32> = (0..9).map(|j| model.cell_at(j, angle.rest)).collect();
            let mut speed = speed;
            for (acceleration, time) in steps {
                let cage = Quadratic([0.0, speed, acceleration]);
                let drive = Drive { cage_start: angle.rest, cage, ..Drive::default() };
                walk(&model, &drive, time, &mut cells);
                angle = angle.advanced(cage.at(time));
                for (j, &cell) in cells.iter().enumerate() {
                    // Rounding of the way made, turns included, and of times within the step.
                    let blur = 16.0 * f64::EPSILON * (10.0 + time * (speed.abs() + acceleration.abs() * time));
                    let outside = outside(&model, j, angle.rest, cell);
                    prop_assert!(outside <= blur, "element {j} is {outside:e} rad outside its cell, allowed {blur:e}");
                }
                speed = cage.rate_at(time);
            }
        }
    }

    #[test]
    fn a_knot_on_which_the_cage_turns_is_passed_both_ways_or_not_at_all() {
        let model = model();
        let defect = model.outer.defect.as_ref().unwrap();
        let mut passed = [0; 3];
        for (k, &knot) in defect.knots().iter().enumerate() {
            for way in [1.0, -1.0] {
                for n in 1..200 {
                    // So short a way that no other knot is met.
                    let (speed, acceleration) = (way * f64::from(n) * 0.013, -way * 1e3 / f64::from(n));
                    let turn = -0.5 * speed * speed / acceleration;
                    let cage_start = knot + defect.centre - turn;
                    let before = model.cell_at(0, cage_start);
                    let mut cells = [SMOOTH; 9];
                    cells[0] = before;
                    let cage = Quadratic([0.0, speed, acceleration]);
                    let drive = Drive { cage_start, cage, ..Drive::default() };
                    let met = walk(&model, &drive, -2.5 * speed / acceleration, &mut cells[..1]);
                    assert!(cells[0] == before || turn.abs() > 1e-3, "knot {k}: {drive:?}");
                    passed[met.min(2)] += usize::from(turn.abs() <= 1e-3);
                }
            }
        }
        // Rounding decides which, and both come about.
        assert!(passed[0] > 0 && passed[1] == 0 && passed[2] > 0, "{passed:?}");
    }
}
