//! The Jacobian against difference quotients, and what other tests need of it.

use crate::contact::near_defect::NearDefect;
use crate::contact::rolled_path::RigidPath;
use crate::contact::rolling::{RacewaySide, Rolling};
use crate::dynamics::contacts::{Forces, Shortcuts};
use crate::dynamics::derivatives::jacobian::*;
use crate::dynamics::parameters::{
    Cells, Centred, Cubic, DefectiveElement, Defects, Frame, Quadratic, SMOOTH, Turning,
};
use crate::scene::{
    CageIrregularity, Damping, DefectOn, ElementInertia, Film, Motion, Roller, RollerProfile, RollingElement, Scene,
    Sensor, Waviness, WavyBody,
};

/// Who has a defect, and for an element the raceway that it faces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Bearer {
    Ring(RacewaySide),
    Element(RacewaySide),
}

/// A model with a defect of the outer raceway, its rings moved as `motions` say, and something at work in everything
/// that depends on time.
pub(crate) fn lively(motions: [Motion; 2], damping: Damping, cage_angle: f64) -> (Model, Excitation) {
    lively_on(Bearer::Ring(RacewaySide::Outer), motions, damping, cage_angle)
}

/// As [`lively`], with a defect of any body under the elements below.
pub(crate) fn lively_on(
    bearer: Bearer,
    motions: [Motion; 2],
    damping: Damping,
    cage_angle: f64,
) -> (Model, Excitation) {
    lively_with((&RollingElement::Ball, ElementInertia::Full), bearer, motions, damping, cage_angle)
}

/// As [`lively_on`], with these elements.
pub(crate) fn lively_with(
    (element, inertia): (&RollingElement, ElementInertia),
    bearer: Bearer,
    motions: [Motion; 2],
    damping: Damping,
    cage_angle: f64,
) -> (Model, Excitation) {
    let mut scene = Scene::er16k();
    scene.bearing.element = element.clone();
    scene.bearing.element_inertia = inertia;
    scene.contact.damping = damping;
    make_uneven(&mut scene, bearer, damping);
    for (ring, motion) in [&mut scene.shaft, &mut scene.housing].into_iter().zip(motions) {
        ring.motion = motion;
    }
    let profile = [(-2.7e-3, 0.0), (-2.6e-3, 1e-4), (2.0e-3, 1e-4), (2.7e-3, 0.0)];
    let near = |side, on_element, centre| {
        let path = RigidPath::new(&profile, Rolling::of(&scene.bearing, side, on_element)).unwrap();
        Centred { surface: NearDefect::Hertz(path), centre }
    };
    let centre = scene.defects[0].angle;
    let on = |side, centre| (bearer == Bearer::Ring(side)).then(|| near(side, false, centre));
    let [inner, outer] = [on(RacewaySide::Inner, centre - 0.4), on(RacewaySide::Outer, centre)];
    let rings = [Defects::new(Frame::Shaft, inner), Defects::new(Frame::Housing, outer)];
    let mut own = Vec::new();
    if let Bearer::Element(facing) = bearer {
        let towards = if facing == RacewaySide::Outer { cage_angle } else { cage_angle + std::f64::consts::PI };
        let defects = [(RacewaySide::Inner, std::f64::consts::PI), (RacewaySide::Outer, 0.0)]
            .map(|(side, back)| Defects::new(Frame::Spin, [near(side, true, towards - back - 0.1)]));
        own.push(DefectiveElement { element: 0, defects, mark: 0.0 });
    }
    // Frames count only where the scene says that something turns.
    scene.defects[0].on = match bearer {
        Bearer::Ring(RacewaySide::Outer) => DefectOn::Outer,
        Bearer::Ring(RacewaySide::Inner) => DefectOn::Inner,
        Bearer::Element(_) => DefectOn::Element { element: 0, tilt: 0.0 },
    };
    let model = Model::new(&scene, rings, own);
    let motion = |start: f64| {
        let [x, y] = [Cubic([start, 2e-3, -3.0, 4e4]), Cubic([-start, -1e-3, 5.0, -7e4])];
        [x, y, Cubic::default(), Cubic::default(), Cubic::default()]
    };
    let load = |start: f64| {
        let [x, y] = [Quadratic([start, 2e4, 1e6]), Quadratic([-900.0, -4e4, 2e6])];
        [x, y, Quadratic::default(), Quadratic::default(), Quadratic::default()]
    };
    let excitation = Excitation {
        cage_start: cage_angle,
        cage_turns: 2,
        cage: Quadratic([0.0, 250.0, 3e4]),
        frames: [
            Turning { start: 0.4, since: Quadratic([0.0, 600.0, 7e4]) },
            Turning::default(),
            Turning { start: 0.1, since: Quadratic([0.0, -1200.0, -9e4]) },
        ],
        motion: [motion(-1e-6), motion(12e-6)],
        load: [load(100.0), load(-30.0)],
        relative_speed: Quadratic([700.0, 8e6, 0.0]),
    };
    (model, excitation)
}

/// What comes with each [damping](DAMPINGS).
fn make_uneven(scene: &mut Scene, bearer: Bearer, damping: Damping) {
    if damping == Damping::HuntCrossley(5.0) {
        let offsets = (0..9).map(|j| 0.01 * (f64::from(j) - 4.0)).collect();
        scene.cage.irregularity = Some(CageIrregularity { offsets, drawn: None, jitter: 0.02, wander: 0.01, seed: 5 });
    }
    if damping == Damping::HuntCrossley(0.0) {
        scene.bearing.diameter_offsets = (0..9).map(|j| 1e-6 * (f64::from(j % 4) - 1.5)).collect();
    }
    if damping == Damping::Proportional(1e-5) {
        scene.waviness = match bearer {
            Bearer::Ring(_) => vec![
                Waviness { on: WavyBody::Inner, order: 7, amplitude: 2e-6, crest: 0.3 },
                Waviness { on: WavyBody::Outer, order: 11, amplitude: 1e-6, crest: -1.0 },
                Waviness { on: WavyBody::Outer, order: 2, amplitude: 1e-6, crest: 2.0 },
            ],
            Bearer::Element(_) => vec![Waviness { on: WavyBody::Element(0), order: 3, amplitude: 2e-6, crest: 0.5 }],
        };
    }
    // One sensor, or several that swing along other axes.
    if let Damping::Proportional(_) = damping {
        let of = |(direction, mass)| Sensor { direction, mass, ..Sensor::default() };
        scene.sensors = [(0.3, 0.7), (std::f64::consts::FRAC_PI_2, 1.0), (3.6, 0.2)].map(of).to_vec();
    }
    if damping == Damping::HuntCrossley(2.0) && scene.bearing.element_inertia == ElementInertia::Full {
        scene.film = Some(Film { viscosity: 0.1, pressure_viscosity: 2e-8, layer: Some(20e-6) });
    }
}

/// Numbers between −1 and 1, always the same.
pub(crate) fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut x = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        x ^= x << 13;
        x ^= x >> 7;
        x ^= x << 17;
        (x >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// A state in motion, the inner ring pushed 20 µm against the elements below.
pub(crate) fn moving(model: &Model, excitation: &Excitation, seed: u64) -> (Vec<f64>, Cells) {
    let mut noise = noise(seed);
    let z = model.element_count;
    let layout = &model.layout;
    let size = |i: usize| if layout.is_position(i) { 1e-6 } else { 2e-2 };
    let mut state: Vec<f64> =
        (0..layout.len).map(|i| if layout.is_used(i) { size(i) * noise() } else { 0.0 }).collect();
    if let Some(i) = model.layout.shaft {
        state[i + 1] -= 20e-6;
    }
    for j in 0..z {
        let angle = model.element_angle(j, excitation.cage_angle_of(&excitation.cage_at(0.0)));
        let outer = model.outer.defects.met(model.outer.defects.cell_at(angle));
        let at = model.outer_meeting(angle, j, [outer, SMOOTH], 0.0);
        let frames = excitation.frames_at(0.0);
        let floor = -model.near_or_unsolved(RacewaySide::Outer, &at, &frames, &mut Shortcuts::default()).approach.value;
        state[j] += floor + 6e-6;
    }
    let cells = model.cells_at(excitation, 0.0, &state);
    (state, cells)
}

pub(crate) const MOTIONS: [[Motion; 2]; 4] = [
    [Motion::Internal, Motion::Internal],
    [Motion::Host, Motion::Internal],
    [Motion::Internal, Motion::Host],
    [Motion::Host, Motion::Host],
];

/// With each of them comes something else: elements of unequal size, a cage that is not even, waves and several
/// sensors, oil films.
pub(crate) const DAMPINGS: [Damping; 4] =
    [Damping::HuntCrossley(0.0), Damping::HuntCrossley(5.0), Damping::Proportional(1e-5), Damping::HuntCrossley(2.0)];

/// Which contacts push, which are derivatives' branches.
fn branch(forces: &Forces) -> Vec<bool> {
    forces.contacts.inner_pushing.iter().chain(forces.contacts.outer_pushing.iter()).map(|&p| p > 0.0).collect()
}

#[test]
fn jacobian_and_time_derivative_equal_difference_quotients() {
    for bearer in [Bearer::Ring(RacewaySide::Outer), Bearer::Ring(RacewaySide::Inner)] {
        let [compared, left_out, near_defect] =
            compare(&RollingElement::Ball, bearer, [-1.73, -1.66, -1.58, -1.5, -1.45, 0.3]);
        assert!(compared > 10_000 && left_out < 30 && near_defect > 30, "{compared} {left_out} {near_defect}");
    }
    for facing in [RacewaySide::Outer, RacewaySide::Inner] {
        let [compared, _, near_defect] = compare(&RollingElement::Ball, Bearer::Element(facing), [-1.66, -1.58, -1.5]);
        assert!(compared > 7_000 && near_defect > 30, "{compared} {near_defect}");
    }
}

#[test]
fn jacobian_and_time_derivative_of_rollers_equal_difference_quotients() {
    let roller = Roller { length: 9e-3, profile: RollerProfile::Straight, laminae: Roller::LAMINAE };
    let rollers = RollingElement::CylindricalRoller(roller);
    for bearer in [Bearer::Ring(RacewaySide::Outer), Bearer::Ring(RacewaySide::Inner)] {
        let [compared, left_out, near_defect] = compare(&rollers, bearer, [-1.66, -1.58, -1.5]);
        assert!(compared > 5_000 && left_out < 30 && near_defect > 15, "{compared} {left_out} {near_defect}");
    }
    let [compared, _, near_defect] = compare(&rollers, Bearer::Element(RacewaySide::Inner), [-1.58, -1.5]);
    assert!(compared > 4_000 && near_defect > 15, "{compared} {near_defect}");
}

/// Compares at these cage angles; gives how many numbers, how many columns were left out, and how many contacts were
/// near the defect.
fn compare(element: &RollingElement, bearer: Bearer, angles: impl IntoIterator<Item = f64> + Clone) -> [usize; 3] {
    let (mut compared, mut left_out, mut near_defect) = (0, 0, 0);
    for (case, (motions, damping)) in
        MOTIONS.into_iter().flat_map(|m| DAMPINGS.into_iter().map(move |d| (m, d))).enumerate()
    {
        for angle in angles.clone() {
            let (model, excitation) = lively_with((element, ElementInertia::Full), bearer, motions, damping, angle);
            let (state, _) = moving(&model, &excitation, case as u64 + 1);
            let tau = 1e-5;
            let cells = model.cells_at(&excitation, tau, &state);
            near_defect += cells.iter().filter(|&&c| c != SMOOTH).count();
            let len = model.layout.len;
            let mut jacobian = Jacobian::new(&model);
            model.linearize(&excitation, tau, &cells, &state, &mut jacobian, &mut Shortcuts::default());
            model.derivative_by_time(&excitation, tau, &cells, &state, &mut jacobian, &mut Shortcuts::default());
            let matrix = jacobian.matrix(len);
            let mut forces = Forces::of(&model);
            let mut at = |tau: f64, state: &[f64]| {
                let mut out = vec![0.0; len];
                model.derivative(&excitation, tau, &cells, state, &mut out, &mut forces);
                (out, branch(&forces))
            };
            let (here, pushing) = at(tau, &state);
            let largest = here.iter().fold(0.0f64, |m, f| m.max(f.abs()));
            for k in 0..=len {
                let h = if k == len {
                    1e-9
                } else if model.layout.is_position(k) {
                    3e-11
                } else {
                    1e-6
                };
                let moved = |sign: f64| {
                    let mut moved = state.clone();
                    if k < len {
                        moved[k] += sign * h;
                    }
                    (tau + if k == len { sign * h } else { 0.0 }, moved)
                };
                let ((t_a, a), (t_b, b)) = (moved(-1.0), moved(1.0));
                let ((before, branch_before), (after, branch_after)) = (at(t_a, &a), at(t_b, &b));
                if branch_before != pushing || branch_after != pushing {
                    left_out += 1;
                    continue;
                }
                for i in 0..len {
                    let quotient = (after[i] - before[i]) / (2.0 * h);
                    let found = if k == len { jacobian.by_time[i] } else { matrix[i][k] };
                    // Rounding of the largest terms over the difference; truncation (h/δ)² and second derivatives 1e-6.
                    let rounding = 1e-14 * largest / h;
                    assert!(
                        (found - quotient).abs() <= 2e-6 * quotient.abs() + rounding,
                        "{bearer:?} {motions:?} {damping:?} at {angle}: ∂({})/∂({}) = {found:e}, quotient {quotient:e}",
                        model.layout.name(i),
                        if k == len { "t".to_owned() } else { model.layout.name(k) },
                    );
                    compared += 1;
                }
            }
        }
    }
    [compared, left_out, near_defect]
}

#[test]
fn the_solution_satisfies_the_whole_system() {
    for (case, (motions, damping)) in
        MOTIONS.into_iter().flat_map(|m| DAMPINGS.into_iter().map(move |d| (m, d))).enumerate()
    {
        let (model, excitation) = lively(motions, damping, -1.58);
        let (state, cells) = moving(&model, &excitation, case as u64);
        let len = model.layout.len;
        let mut jacobian = Jacobian::new(&model);
        model.linearize(&excitation, 0.0, &cells, &state, &mut jacobian, &mut Shortcuts::default());
        let matrix = jacobian.matrix(len);
        for shift in [1e2, 1e5, 1e9] {
            jacobian.factor(shift);
            let mut noise = noise(7);
            let b: Vec<f64> = (0..len).map(|i| if model.layout.is_used(i) { noise() } else { 0.0 }).collect();
            let mut x = b.clone();
            jacobian.solve(&mut x);
            for i in (0..len).filter(|&i| model.layout.is_used(i)) {
                let (mut sum, mut size) = (shift * x[i], (shift * x[i]).abs() + b[i].abs());
                for k in 0..len {
                    sum -= matrix[i][k] * x[k];
                    size += (matrix[i][k] * x[k]).abs();
                }
                // Rounding of the largest terms, and some growth in the elimination.
                assert!((sum - b[i]).abs() < 1e-12 * size, "{motions:?} {damping:?} row {i}: {sum} for {}", b[i]);
            }
        }
    }
}
