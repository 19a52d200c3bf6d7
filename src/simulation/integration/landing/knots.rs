//! Knots whose instants are known beforehand: those at which an element enters another cell of a defect of the outer
//! raceway, or of its own on its outer side. They are found from whole cells, never by comparing times. The angles that
//! count are those of the elements about the outer ring's centre, which follow from time alone; passages that depend on
//! where the inner ring is are those of [`super::crossings`].
//!
//! The angle of the elements against the body with the defect is a quadratic of time within a communication step, so it
//! turns back at most once, and before and after that it goes one way only. Which of these two *legs* it is on is, like
//! a cell, no question of times: the way back begins with the first passage that only it can make. On a leg an element
//! meets the knot ahead of its cell and no other. The knot that it has just passed, from which rounding leaves it at an
//! angle of about 0, therefore neither fires again nor is missed when the cage comes back; and a knot on which the cage
//! turns is passed both ways or not at all.

use crate::dynamics::parameters::{Ahead, Cells, Defects, Excitation, Frame, Model, Quadratic};

/// Part of a communication step on which elements turn one way against the body with a defect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::simulation) enum Leg {
    /// The way on which the step begins.
    Out,
    /// The way back, after the cage's speed has passed through 0.
    Back,
}

/// The legs of motion against the outer ring and against the elements' own spin.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::simulation) struct Legs {
    pub(in crate::simulation) ring: Leg,
    pub(super) spin: Leg,
}

impl Legs {
    /// Those on which a communication step begins.
    pub(in crate::simulation) const OUT: Self = Self { ring: Leg::Out, spin: Leg::Out };
}

/// A contact that may enter another cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::simulation) enum Contact {
    /// That of an element, from 0, with the outer raceway.
    Outer(usize),
    /// That of an element with the inner raceway.
    Inner(usize),
    /// That of a defective element, counted among those, with the inner (0) or the outer (1) raceway.
    Own(usize, usize),
}

/// The next knot to land on.
#[derive(Debug, Clone, Copy)]
pub(in crate::simulation) struct Knot {
    /// When (s) since the communication point.
    pub(in crate::simulation) tau: f64,
    /// Which contact.
    pub(in crate::simulation) contact: Contact,
    /// The cell it enters.
    pub(in crate::simulation) cell: u32,
    /// On which legs.
    pub(in crate::simulation) legs: Legs,
}

impl Contact {
    /// Puts the contact into a cell.
    pub(in crate::simulation) fn enter(self, cell: u32, cells: &mut Cells) {
        match self {
            Self::Outer(j) => cells.outer[j] = cell,
            Self::Inner(j) => cells.inner[j] = cell,
            Self::Own(k, side) => cells.own[k][side] = cell,
        }
    }
}

/// The earliest scheduled passage of a contact into another cell between `from`, on `legs`, and `end`, both in (s)
/// since the communication point.
pub(in crate::simulation) fn next_knot(
    model: &Model,
    excitation: &Excitation,
    from: f64,
    legs: Legs,
    end: f64,
    cells: &Cells,
) -> Option<Knot> {
    // In an uneven cage elements go by no quadratic of time: their passages are found like those inside.
    if model.is_uneven() {
        return None;
    }
    let over = |frame: Frame| Search { model, excitation, frame, from, end };
    let ring = passages(excitation, Frame::Housing, legs.ring, |way, leg| {
        let on = |(j, &cell): (usize, &u32)| Way {
            defects: &model.outer.defects,
            element: j,
            cell,
            contact: Contact::Outer(j),
        };
        let found = over(Frame::Housing).earliest(way, leg, cells.outer.iter().enumerate().map(on));
        found.map(|Passage { tau, contact, cell }| Knot { tau, contact, cell, legs: Legs { ring: leg, ..legs } })
    });
    if model.defective.is_empty() {
        return ring;
    }
    let spin = passages(excitation, Frame::Spin, legs.spin, |way, leg| {
        let own = model.defective.iter().zip(&cells.own).enumerate();
        let own = own.map(|(k, (defective, cells))| Way {
            defects: &defective.defects[1],
            element: defective.element,
            cell: cells[1],
            contact: Contact::Own(k, 1),
        });
        let found = over(Frame::Spin).earliest(way, leg, own);
        found.map(|Passage { tau, contact, cell }| Knot { tau, contact, cell, legs: Legs { spin: leg, ..legs } })
    });
    match (ring, spin) {
        (Some(ring), Some(spin)) => Some(if spin.tau < ring.tau { spin } else { ring }),
        (ring, spin) => ring.or(spin),
    }
}

/// Angle of element 1 against a frame since the start of the communication step.
fn against(excitation: &Excitation, frame: Frame) -> Quadratic {
    let of = excitation.frames[frame as usize].since.0;
    Quadratic(std::array::from_fn(|i| excitation.cage.0[i] - of[i]))
}

/// The first knot that `on` finds on the legs that are left, asked with the way of each.
fn passages(excitation: &Excitation, frame: Frame, leg: Leg, on: impl Fn(f64, Leg) -> Option<Knot>) -> Option<Knot> {
    let [_, speed, acceleration] = against(excitation, frame).0;
    let out = if speed == 0.0 { acceleration } else { speed };
    let found = if leg == Leg::Out && out != 0.0 { on(out.signum(), Leg::Out) } else { None };
    // Every passage on the way out comes before every one on the way back.
    if found.is_none() && speed * acceleration < 0.0 { on(acceleration.signum(), Leg::Back) } else { found }
}

/// A contact on its way over defects.
struct Way<'a> {
    defects: &'a Defects,
    element: usize,
    cell: u32,
    contact: Contact,
}

/// Where passages of contacts over defects that turn with `frame` are looked for: between two times since the
/// communication point (s).
struct Search<'a> {
    model: &'a Model,
    excitation: &'a Excitation,
    frame: Frame,
    from: f64,
    end: f64,
}

/// When a contact enters another cell (s) since the communication point, and which.
#[derive(Clone, Copy)]
struct Passage {
    tau: f64,
    contact: Contact,
    cell: u32,
}

impl Search<'_> {
    /// The earliest passage on a leg that goes `way`, 1 or −1.
    fn earliest<'a>(&self, way: f64, leg: Leg, contacts: impl Iterator<Item = Way<'a>>) -> Option<Passage> {
        let Self { model, excitation, frame, from, end } = *self;
        let (cage_angle, turned, against) =
            (excitation.cage_angle(from), excitation.frames_at(from).of(frame).angle, against(excitation, frame));
        let (mut speed, acceleration) = (way * against.rate_at(from), way * against.0[2]);
        if leg == Leg::Out {
            // Where the cage is about to turn, rounding may show it on its way back already.
            speed = speed.max(0.0);
        }
        let mut earliest: Option<Passage> = None;
        for on in contacts.filter(|on| !on.defects.is_empty()) {
            let direction = cage_angle + model.element_offset(on.element) - turned;
            let Some(Ahead { angle, beyond }) = on.defects.ahead(on.cell, direction, way > 0.0) else { continue };
            let tau = from + passage(speed, acceleration, angle.max(0.0));
            if tau <= end && earliest.is_none_or(|e| tau < e.tau) {
                earliest = Some(Passage { tau, contact: on.contact, cell: beyond });
            }
        }
        earliest
    }
}

/// Time until speed·t + ½ acceleration·t² reaches `angle` ≥ 0 on its way forward, infinite if never. Where it begins by
/// moving backward that is when it comes back, also for an angle of 0.
fn passage(speed: f64, acceleration: f64, angle: f64) -> f64 {
    let root = (speed * speed + 2.0 * acceleration * angle).sqrt();
    // Of the two forms of the same root the one in which nothing cancels. No root is NaN, and then neither is the
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
    use crate::dynamics::derivatives::jacobian::tests::lively;
    use crate::dynamics::parameters::{SMOOTH, SurfaceDefect, WholeAngle};
    use crate::scene::{Damping, Motion};
    use proptest::prelude::*;
    use std::rc::Rc;

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
    fn walk(model: &Model, excitation: &Excitation, end: f64, cells: &mut Cells) -> usize {
        let (mut tau, mut legs, mut count) = (0.0, Legs::OUT, 0);
        while let Some(knot) = next_knot(model, excitation, tau, legs, end, cells) {
            (tau, legs) = (knot.tau.max(tau), knot.legs);
            knot.contact.enter(knot.cell, cells);
            count += 1;
            assert!(count < 100_000, "{excitation:?}: passages without end");
        }
        count
    }

    fn defect(model: &Model) -> &SurfaceDefect {
        model.outer.defects.iter().next().unwrap()
    }

    /// Cell of element `j` at a cage angle.
    fn cell_at(model: &Model, j: usize, cage_angle: f64) -> u32 {
        model.outer.defects.cell_at(cage_angle + model.element_offset(j))
    }

    /// How far the angle of element `j` is outside its cell (rad); negative inside.
    fn outside(model: &Model, j: usize, cage_angle: f64, cell: u32) -> f64 {
        let (knots, angle) = (defect(model).knots(), defect(model).angle(cage_angle + model.element_offset(j)));
        match cell {
            SMOOTH => (angle - knots[0]).min(knots[knots.len() - 1] - angle),
            cell => (knots[cell as usize] - angle).max(angle - knots[cell as usize + 1]),
        }
    }

    fn model() -> Rc<Model> {
        thread_local!(static MODEL: Rc<Model> = lively([Motion::Fixed; 2], Damping::HuntCrossley(0.3), 0.0).0.into());
        MODEL.with(Rc::clone)
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
            let model = &*model();
            let defect = defect(model);
            // Perhaps an element begins exactly on a knot.
            let start = on_knot.map_or(start, |(k, j)| {
                defect.knots()[k % defect.knots().len()] + defect.centre - model.element_offset(j)
            });
            let mut angle = WholeAngle::new(start);
            let outer: Vec<u32> = (0..9).map(|j| cell_at(model, j, angle.rest)).collect();
            let mut cells = Cells { outer, ..Cells::smooth(9, 0) };
            let mut speed = speed;
            for (acceleration, time) in steps {
                let cage = Quadratic([0.0, speed, acceleration]);
                let excitation = Excitation { cage_start: angle.rest, cage, ..Excitation::default() };
                walk(model, &excitation, time, &mut cells);
                angle = angle.advanced(cage.at(time));
                for (j, &cell) in cells.outer.iter().enumerate() {
                    // Rounding of the way made, turns included, and of times within the step.
                    let blur = 16.0 * f64::EPSILON * (10.0 + time * (speed.abs() + acceleration.abs() * time));
                    let outside = outside(model, j, angle.rest, cell);
                    prop_assert!(outside <= blur, "element {j} is {outside:e} rad outside its cell, allowed {blur:e}");
                }
                speed = cage.rate_at(time);
            }
        }
    }

    #[test]
    fn a_knot_on_which_the_cage_turns_is_passed_both_ways_or_not_at_all() {
        let model = &*model();
        let defect = defect(model);
        let mut passed = [0; 3];
        for (k, &knot) in defect.knots().iter().enumerate() {
            for way in [1.0, -1.0] {
                for n in 1..200 {
                    // So short a way that no other knot is met.
                    let (speed, acceleration) = (way * f64::from(n) * 0.013, -way * 1e3 / f64::from(n));
                    let turn = -0.5 * speed * speed / acceleration;
                    let cage_start = knot + defect.centre - turn;
                    let before = cell_at(model, 0, cage_start);
                    let mut cells = Cells { outer: vec![before], ..Cells::default() };
                    let cage = Quadratic([0.0, speed, acceleration]);
                    let excitation = Excitation { cage_start, cage, ..Excitation::default() };
                    let met = walk(model, &excitation, -2.5 * speed / acceleration, &mut cells);
                    assert!(cells.outer[0] == before || turn.abs() > 1e-3, "knot {k}: {excitation:?}");
                    passed[met.min(2)] += usize::from(turn.abs() <= 1e-3);
                }
            }
        }
        // Rounding decides which, and both come about.
        assert!(passed[0] > 0 && passed[1] == 0 && passed[2] > 0, "{passed:?}");
    }
}
