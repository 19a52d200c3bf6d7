//! Elements in balance: those found side by side against those found alone, rates and tangents against differences.

use crate::contact::rolling::RacewaySide;
use crate::dynamics::contacts::{Forces, Shortcuts};
use crate::dynamics::derivatives::Jacobian;
use crate::dynamics::derivatives::jacobian::tests::{Bearer, DAMPINGS, MOTIONS, lively_with, moving};
use crate::dynamics::parameters::{CageState, Cells, Excitation, PathMotion, Stage};
use crate::dynamics::quasi_static::balance_lanes::SmoothElements;
use crate::dynamics::quasi_static::element_balance::*;
use crate::dynamics::quasi_static::{Rings, stacked};
use crate::numerics::lanes::{Kernel, dispatch};
use crate::scene::{Damping, ElementInertia, Motion, Roller, RollerProfile, RollingElement};
use pulp::Scalar256b;

/// A bearing in motion, at one instant.
struct Moving {
    model: Model,
    excitation: Excitation,
    state: Vec<f64>,
    cells: Cells,
}

impl Moving {
    fn new(element: &RollingElement, bearer: Bearer, motions: [Motion; 2], damping: Damping, angle: f64) -> Self {
        let (model, excitation) = lively_with((element, ElementInertia::None), bearer, motions, damping, angle);
        let (state, cells) = moving(&model, &excitation, 3);
        Self { model, excitation, state, cells }
    }

    /// Derivative and forces with the state moved on.
    fn at(&self, tau: f64, state: &[f64]) -> (Vec<f64>, Forces) {
        let (mut rates, mut forces) = (vec![0.0; state.len()], Forces::of(&self.model));
        self.model.derivative(&self.excitation, tau, &self.cells, state, &mut rates, &mut forces);
        (rates, forces)
    }

    /// Which contacts push.
    fn branch(forces: &Forces) -> Vec<bool> {
        forces.contacts.inner_pushing.iter().chain(&*forces.contacts.outer_pushing).map(|&p| p > 0.0).collect()
    }
}

fn roller() -> RollingElement {
    let roller = Roller { length: 9e-3, profile: RollerProfile::Straight, laminae: Roller::LAMINAE };
    RollingElement::CylindricalRoller(roller)
}

/// Every motion of the rings with every damping, defects anywhere, balls and rollers, elements in and out of the
/// defect.
fn cases() -> Vec<Moving> {
    use RacewaySide::{Inner, Outer};
    let bearers = [Bearer::Ring(Outer), Bearer::Ring(Inner), Bearer::Element(Outer)];
    let mut cases = Vec::new();
    for element in [RollingElement::Ball, roller()] {
        for bearer in bearers {
            for (motions, damping) in MOTIONS.into_iter().flat_map(|m| DAMPINGS.into_iter().map(move |d| (m, d))) {
                for angle in [-1.73, -1.58, -1.45] {
                    cases.push(Moving::new(&element, bearer, motions, damping, angle));
                }
            }
        }
    }
    cases
}

#[test]
fn elements_found_side_by_side_are_those_found_alone_and_each_is_in_balance() {
    let (mut pressed, mut near_defect) = (0, 0);
    for case in cases() {
        let Moving { model, excitation, state, cells } = &case;
        let (rates, forces) = case.at(0.0, state);
        let now = model.kinematics(excitation, 0.0, state);
        let contacts = &forces.contacts;
        let mut rings = Rings::zeros();
        for j in 0..model.element_count {
            let in_cells = model.cells_of(cells, j);
            let at = model.element_motion(j, PathMotion::at_rest(0.0), &now, &mut Shortcuts::default());
            let found = model.in_balance(in_cells, 0.0, &at, &mut Shortcuts::default());
            let ElementMotion { e_r, omega, .. } = found.elastic.at;
            let body = model.mass_of(j) * (model.gravity.dot(&e_r) + model.centre_radius(j) * omega * omega);
            let scale = found.forces.inner.norm() + found.forces.outer.norm() + body.abs();
            let left = found.forces.inner.x - found.forces.outer.x + body;
            // The search ends a thousandth below what it is asked for; rounding of 30 µm on the contact's stiffness.
            assert!(left.abs() < 1e-11 * scale + 1e-11, "{left:e} N is left of element {j}'s {scale} N");
            pressed += usize::from(found.forces.inner.norm() > 1.0);
            near_defect += usize::from(in_cells != [[SMOOTH; 2]; 2]);
            let [shaft, housing] = found.element().on_rings();
            rings += stacked(shaft, housing);
            // Both end their search where 1e-12 m is left of a step; side by side stiffnesses are those before it.
            let path = forces.contacts.paths(model, state)[j];
            assert!((path - found.path).abs() < 1e-15, "element {j}: {path:e} against {:e} alone", found.path);
            let rate = rates[j] - found.path_rate;
            let pushing = [found.elastic.inner.approach, found.elastic.outer.approach]
                .into_iter()
                .filter(|&approach| approach > 0.0);
            let share = 2e-12 / pushing.fold(1.0, f64::min);
            let limit = share * found.path_rate.abs() + 1e-11;
            assert!(rate.abs() < limit, "element {j}: {rate:e} of {:e}", found.path_rate);
            // Dampers follow u'.
            for (together, alone) in
                [(contacts.inner[j], found.forces.inner.norm()), (contacts.outer[j], found.forces.outer.norm())]
            {
                assert!((together - alone).abs() < 1e-8 * scale, "element {j}: {together} N against {alone} N alone");
            }
        }
        let miss = (rings - Rings::from_column_slice(&forces.rings[..4])).amax();
        assert!(miss < 1e-8 * rings.amax(), "{miss:e} N of {rings:?}");
    }
    assert!(pressed > 500 && near_defect > 100, "{pressed} {near_defect}");
}

#[test]
fn the_balance_does_not_depend_on_where_its_search_begins() {
    for case in cases().into_iter().step_by(5) {
        let Moving { model, excitation, state, cells } = &case;
        let (_, forces) = case.at(0.0, state);
        let now = model.kinematics(excitation, 0.0, state);
        for guess in [-90e-6, -1e-6, 2e-9, 40e-6] {
            let mut from = state.clone();
            from[..model.element_count].fill(guess);
            let (_, again) = case.at(0.0, &from);
            for j in 0..model.element_count {
                let [one, other] = [&forces, &again].map(|forces| forces.contacts.paths(model, state)[j]);
                // A loose element's path is known to the rounding of its contact's approach.
                assert!((one - other).abs() < 1e-15, "{one:e} and {other:e} from {guess:e}");
                let at = model.element_motion(j, PathMotion::at_rest(guess), &now, &mut Shortcuts::default());
                let alone = model.in_balance(model.cells_of(cells, j), guess, &at, &mut Shortcuts::default()).path;
                assert!((one - alone).abs() < 1e-15, "{one:e} and {alone:e} alone from {guess:e}");
            }
        }
    }
}

#[test]
fn the_rate_of_a_path_is_what_the_balance_moves_by() {
    let mut compared = 0;
    for case in cases() {
        let Moving { model, state, .. } = &case;
        let (rates, forces) = case.at(0.0, state);
        // A light contact's path curves within a nanometre of its way.
        let h = 2e-10;
        let moved = |sign: f64| {
            let mut state = state.clone();
            for (value, rate) in state.iter_mut().zip(&rates).skip(2 * model.layout.radial_velocity) {
                *value += sign * h * rate;
            }
            case.at(sign * h, &state).1
        };
        let (before, after) = (moved(-1.0), moved(1.0));
        if Moving::branch(&before) != Moving::branch(&forces) || Moving::branch(&after) != Moving::branch(&forces) {
            continue;
        }
        for j in 0..model.element_count {
            let quotient = (after.contacts.paths(model, state)[j] - before.contacts.paths(model, state)[j]) / (2.0 * h);
            // What the search leaves of a light contact's path, 1e-17 m, over the difference; second derivatives 1e-6.
            let limit = 1e-5 * quotient.abs() + 1e-7;
            assert!((rates[j] - quotient).abs() < limit, "element {j}: {} against {quotient}", rates[j]);
            compared += 1;
        }
    }
    assert!(compared > 1500, "{compared}");
}

#[test]
fn tangent_and_dampers_of_the_rings_equal_difference_quotients() {
    let mut compared = 0;
    for damping in [Damping::HuntCrossley(0.0), Damping::HuntCrossley(0.5), Damping::Proportional(1e-6)] {
        for element in [RollingElement::Ball, roller()] {
            for bearer in [RacewaySide::Outer, RacewaySide::Inner].map(Bearer::Ring) {
                let case = Moving::new(&element, bearer, [Motion::Internal; 2], damping, -1.58);
                let Moving { model, excitation, state, cells } = &case;
                let len = model.layout.len;
                let mut jacobian = Jacobian::new(model);
                model.linearize(excitation, 0.0, cells, state, &mut jacobian, &mut Shortcuts::default());
                let matrix = jacobian.matrix(len);
                let (here, forces) = case.at(0.0, state);
                let largest = here.iter().fold(0.0f64, |most, rate| most.max(rate.abs()));
                for k in (2 * model.layout.radial_velocity..len).filter(|&k| model.layout.is_used(k)) {
                    // With damping the tangent is the elastic one.
                    if model.layout.is_position(k) && damping != Damping::HuntCrossley(0.0) {
                        continue;
                    }
                    let h = if model.layout.is_position(k) { 1e-11 } else { 1e-6 };
                    let moved = |sign: f64| {
                        let mut state = state.clone();
                        state[k] += sign * h;
                        case.at(0.0, &state)
                    };
                    let ((before, one), (after, other)) = (moved(-1.0), moved(1.0));
                    if [&one, &other].iter().any(|at| Moving::branch(at) != Moving::branch(&forces)) {
                        continue;
                    }
                    for i in (2 * model.layout.radial_velocity..len).filter(|&i| model.layout.is_used(i)) {
                        let quotient = (after[i] - before[i]) / (2.0 * h);
                        // Truncation 1e-6 of the largest column entry; rounding of the forces over the difference.
                        let limit = 1e-5 * quotient.abs() + 1e-13 * largest / h;
                        assert!(
                            (matrix[i][k] - quotient).abs() < limit,
                            "{damping:?}: ∂({})/∂({}) = {:e}, quotient {quotient:e}",
                            model.layout.name(i),
                            model.layout.name(k),
                            matrix[i][k]
                        );
                        compared += 1;
                    }
                }
            }
        }
    }
    assert!(compared > 500, "{compared}");
}

#[test]
fn registers_of_every_width_give_the_same_bits() {
    for case in cases().into_iter().step_by(7) {
        let Moving { model, excitation, state, cells } = &case;
        let cage: CageState = excitation.cage_at(0.0);
        let stage = Stage { excitation, cage: &cage, state, ahead: Some(1e-6) };
        let now = model.kinematics(excitation, 0.0, state).motion;
        let mut found = [false, true].map(|widest| {
            let (mut rates, mut forces) = (vec![0.0; state.len()], Forces::of(model));
            forces.enter(model, cells);
            model.update_uneven(excitation.cage_angle_of(&cage), &mut forces.elements, &mut forces.shortcuts.leads);
            let kernel =
                SmoothElements::<true> { model, now: &now, stage: &stage, derivative: &mut rates, forces: &mut forces };
            let rings = if widest { dispatch(kernel) } else { kernel.run(Scalar256b) };
            let contacts = &forces.contacts;
            let all = [&rates[..], &rings, &contacts.inner, &contacts.outer, &contacts.balanced[0]].concat();
            all.iter().map(|number| number.to_bits()).collect::<Vec<_>>()
        });
        let [narrow, wide] = &mut found;
        assert_eq!(narrow, wide);
    }
}
