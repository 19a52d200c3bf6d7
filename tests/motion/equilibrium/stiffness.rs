//! Static stiffness, load distribution and critical load.

use crate::support::draw::Draw;
use crate::support::{profile_of, shipped};
use brinell::scene::{Bearing, ContactLaw, DefectOn, DefectShape, Scene};
use brinell_analysis::statics::{
    Balance, CriticalLoad, NoCriticalLoad, StaticBearing, StaticError, min_mean_max, sweep,
};
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

fn bearing(scene: &Scene) -> StaticBearing {
    StaticBearing::new(scene, profile_of(scene).as_deref()).unwrap()
}

fn healthy() -> Scene {
    Scene { defects: Vec::new(), ..shipped("er16k-tb1") }
}

/// The extended spall with another depth (m).
fn extended(depth_of_floor: f64) -> Scene {
    let mut scene = shipped("er16k-tb2");
    let Some(defect) = scene.defects.first_mut() else { panic!("no defect") };
    let DefectShape::Spall { depth, .. } = &mut defect.shape else { panic!("no spall") };
    *depth = depth_of_floor;
    scene
}

/// Least, mean and greatest stiffness along the load without transverse force (N/µm).
fn stiffness(bearing: &StaticBearing) -> [f64; 3] {
    min_mean_max(&sweep(bearing, -FRAC_PI_2, 200).unwrap(), |balance| balance.free_stiffness() * 1e-6)
}

fn critical(bearing: &StaticBearing) -> CriticalLoad {
    bearing.critical_load().unwrap().unwrap()
}

#[track_caller]
fn agree(found: &[f64], expected: &[f64], tolerance: f64) {
    for (found, expected) in found.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < tolerance, "{found} against {expected}");
    }
}

/// A prototype's figures: three digits, elements pushed along the radius of the undisplaced bearing. With the ring
/// displaced by 0.1 mm the true direction is 0.3 degrees off, 0.9 % of a force at 60 degrees from the load.
const PROTOTYPE: f64 = 0.01;

#[test]
fn stiffness_over_the_cage_angle_is_that_of_the_prototype() {
    agree(&stiffness(&bearing(&healthy())), &[87.3, 88.4, 88.8], PROTOTYPE);
    agree(&stiffness(&bearing(&shipped("er16k-tb1"))), &[56.5, 77.0, 88.8], PROTOTYPE);
    agree(&stiffness(&bearing(&shipped("er16k-tb2"))), &[27.8, 47.3, 58.6], PROTOTYPE);
}

#[test]
fn a_spall_inside_under_the_load_has_the_critical_load_of_one_outside() {
    // On both floors elements go down by the depth, and rings are as stiff beside them.
    let (outside, mut scene) = (bearing(&shipped("er16k-tb1")), shipped("er16k-tb1"));
    scene.defects[0].on = DefectOn::Inner;
    scene.shaft_initial_angle = 0.3;
    let inside = bearing(&scene).with_shaft_angle(0.0);
    let (of_outer, of_inner) = (critical(&outside), critical(&inside));
    // Except for the Hertz constants' share: the element in the spall carries nothing yet.
    agree(&[of_inner.load], &[of_outer.load], 1e-9);
    agree(&[inside.bottom().unwrap().path], &[1e-4], 1e-9);
    // Turned away from the load the spall counts for nothing.
    let away = inside.with_shaft_angle(PI);
    agree(&stiffness(&away), &stiffness(&bearing(&healthy())), 1e-9);
    // Its depth, and not the mean of its law's roundings, decides.
    let deeper = critical(&inside.with_depth_times(1.01).unwrap().with_shaft_angle(0.0));
    agree(&[deeper.load], &[critical(&outside.with_depth_times(1.01).unwrap()).load], 1e-9);
}

#[test]
fn the_extended_spall_at_30_micrometres_stiffens_between_500_and_600_newtons() {
    let shallow = bearing(&shipped("er16k-tb2-30um"));
    agree(&stiffness(&shallow.with_load([0.0, -500.0]))[..1], &[27.8], PROTOTYPE);
    agree(&stiffness(&shallow.with_load([0.0, -600.0]))[..1], &[55.6], PROTOTYPE);
}

#[test]
fn the_critical_load_of_the_extended_spall_is_that_of_the_prototype() {
    let found = critical(&bearing(&shipped("er16k-tb2")));
    agree(&[found.load], &[3630.0], PROTOTYPE);
    assert_eq!(found.elements, 2);
    let line = critical(&bearing(&shipped("er16k-tb1")));
    assert_eq!(line.elements, 1);
    assert!(line.load > 2.0 * found.load, "{} against {}", line.load, found.load);
}

#[test]
fn the_scenes_of_the_change_of_load_change_between_500_and_600_newtons() {
    for name in ["er16k-tb2-30um", "er16k-tb2-compliant"] {
        let found = critical(&bearing(&shipped(name))).load;
        assert!((500.0..600.0).contains(&found), "{name}: {found}");
    }
}

#[test]
fn elements_at_the_bottom_carry_above_the_critical_load_and_not_below() {
    for scene in [shipped("er16k-tb1"), shipped("er16k-tb2"), shipped("er16k-tb2-compliant"), shipped("6205-epps")] {
        let bearing = bearing(&scene);
        let found = critical(&bearing);
        let carrying = |load: f64| {
            let balance = bearing.balance(found.cage_angle, [0.0, -load]).unwrap();
            balance.elements.iter().filter(|element| element.in_defect && element.inner_force > 0.0).count()
        };
        // 1e-6 of the load: the search ends at 1e-11, a force that begins as a power 1.5 needs some way to be seen.
        assert_eq!(carrying(found.load * (1.0 - 1e-6)), 0, "{}", scene.name);
        assert_eq!(carrying(found.load * (1.0 + 1e-6)), found.elements, "{}", scene.name);
    }
}

#[test]
fn the_critical_load_of_two_elements_follows_from_the_geometry() {
    // Small depth: the ring goes straight down by x, elements at ±20° touch the floor h at x cos 20° = G + h, those at
    // ±60° carry K (x cos 60° − G)^1.5 each, and the sum of their vertical parts is the load.
    let scene = extended(10e-6);
    let hertz = brinell::geometry::hertz_constant::HertzConstants::of(&scene.bearing).in_series();
    let cos = |degrees: f64| degrees.to_radians().cos();
    let approach = 15e-6 / cos(20.0) * cos(60.0) - 5e-6;
    let expected = 2.0 * cos(60.0) * hertz * approach.powf(1.5);
    // The ring's displacement of 16 µm turns the inner forces by 0.7 mrad: 0.12 % of the load; and t²/2ρ, 5 nm of 3 µm.
    agree(&[critical(&bearing(&scene)).load], &[expected], 4e-3);
}

#[test]
fn sensitivities_equal_differences_of_critical_loads() {
    let deep = bearing(&shipped("er16k-tb2"));
    let found = critical(&deep);
    let by = deep.sensitivity(&found).unwrap().unwrap();
    let difference = |other: StaticBearing| critical(&other).load - found.load;
    // One-sided differences over 0.1 %: their error is half the step, relative to the load's own scale.
    let per_metre = [
        difference(bearing(&extended(100.1e-6))) / 0.1e-6,
        difference(deep.with_clearance(5.1e-6)) / 0.1e-6,
        difference(deep.with_outer_compliance(1e-12)) / 1e-12,
    ];
    agree(&[by.by_depth, by.by_clearance, by.by_compliance], &per_metre, 1e-2);
    assert!(by.by_depth > 0.0 && by.by_clearance < 0.0 && by.by_compliance < 0.0);
}

#[test]
fn depths_multiplied_are_the_depths_of_another_scene() {
    let scaled = bearing(&shipped("er16k-tb2")).with_depth_times(0.3).unwrap();
    // 0.3 · 100 µm and 30 µm differ by a rounding.
    agree(&[critical(&scaled).load], &[critical(&bearing(&extended(30e-6))).load], 1e-9);
}

#[test]
fn stiffness_is_the_slope_of_the_load() {
    for scene in [shipped("er16k-tb2"), shipped("er16k-tb2-compliant"), shipped("6205-epps")] {
        let bearing = bearing(&scene);
        for cage_angle in [-1.9, -1.7, -1.5] {
            let at = |load| bearing.balance(cage_angle, load).unwrap();
            let (balance, step) = (at([20.0, -500.0]), 1e-3);
            for (axis, change) in [[step, 0.0], [0.0, step]].into_iter().enumerate() {
                let near = |sign: f64| at([20.0 + sign * change[0], -500.0 + sign * change[1]]).displacement;
                let (after, before) = (near(1.0), near(-1.0));
                let moved = [0, 1].map(|a| after[a] - before[a]);
                for row in 0..2 {
                    let force = balance.stiffness[row][0] * moved[0] + balance.stiffness[row][1] * moved[1];
                    let expected = if row == axis { 2.0 * step } else { 0.0 };
                    // Rounding: a position of 1e-5 m to 1e-21 m times 1e8 N/m; truncation of second order in 1e-3/500.
                    assert!((force - expected).abs() < 1e-6 * step, "{}: {force} against {expected}", scene.name);
                }
            }
        }
    }
}

#[test]
fn the_compliant_bearing_is_its_rigid_one_and_the_seats_in_series() {
    // Two elements at 60° from the load, the third opposite and loose: each adds its spring times cos² 60°.
    let mut scene = healthy();
    scene.bearing.element_count = 3;
    let rigid = bearing(&scene);
    let soft = rigid.with_outer_compliance(3e-8);
    let at = |bearing: &StaticBearing| bearing.balance(FRAC_PI_2, [0.0, -5.0]).unwrap();
    let (a, b) = (at(&rigid), at(&soft));
    assert_eq!(a.loaded().collect::<Vec<_>>(), [1, 2]);
    // A displacement of 12 µm turns the contacts by 0.5 mrad, which changes cos² 60° by 0.2 %.
    agree(&[1.0 / b.free_stiffness() - 1.0 / a.free_stiffness()], &[2.0 * 3e-8], 5e-3);
}

#[test]
fn the_load_zone_is_where_a_healthy_bearing_carries() {
    let bearing = bearing(&healthy());
    for balance in sweep(&bearing, 0.0, 40).unwrap() {
        let ring = balance.displacement[1].atan2(balance.displacement[0]);
        for element in &balance.elements {
            let angle = (element.angle - ring + PI).rem_euclid(2.0 * PI) - PI;
            // The zone neglects t²/2ρ of the displacement: 1e-8 m beside 5e-6 m, some 1e-3 rad.
            if (angle.abs() - balance.load_zone).abs() > 2e-3 {
                assert_eq!(element.inner_force > 0.0, angle.abs() < balance.load_zone, "{angle}");
            }
        }
    }
}

#[test]
fn a_sweep_shows_both_sides_of_each_change() {
    let balances = sweep(&bearing(&shipped("er16k-tb2")), -FRAC_PI_2, 30).unwrap();
    let loaded = |balance: &Balance| balance.loaded().collect::<Vec<_>>();
    let changes = balances.windows(2).filter(|pair| loaded(&pair[0]) != loaded(&pair[1]));
    let widths: Vec<f64> = changes.map(|pair| pair[1].cage_angle - pair[0].cage_angle).collect();
    assert!(widths.len() >= 4, "{widths:?}");
    assert!(widths.iter().all(|&width| width > 0.0 && width <= 1e-7), "{widths:?}");
    assert!(balances.windows(2).all(|pair| pair[1].cage_angle > pair[0].cage_angle));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn every_balance_holds_the_load_and_its_stiffness_is_symmetric(
        cage_angle in -PI..PI, load in 1.0..1e4f64, direction in -PI..PI, soft in prop::bool::ANY,
    ) {
        let scene = shipped(if soft { "er16k-tb2-compliant" } else { "er16k-tb2" });
        let load = [load * direction.cos(), load * direction.sin()];
        let balance = bearing(&scene).balance(cage_angle, load).unwrap();
        let size = load[0].hypot(load[1]);
        let mut sum = [0.0; 2];
        for element in &balance.elements {
            // n from the displaced inner ring's centre to the element's.
            let rho = 0.5 * scene.bearing.pitch_diameter + 0.5 * scene.bearing.radial_clearance + element.path;
            let (sin, cos) = element.angle.sin_cos();
            let q = [rho * cos - balance.displacement[0], rho * sin - balance.displacement[1]];
            let length = q[0].hypot(q[1]);
            prop_assert!(element.inner_force >= 0.0 && element.outer_force >= 0.0);
            for a in 0..2 {
                sum[a] += element.inner_force * q[a] / length;
            }
        }
        // The search ends at 1e-12 of the largest force; directions here are rounded once more.
        prop_assert!((sum[0] - load[0]).abs() + (sum[1] - load[1]).abs() < 1e-10 * size + 1e-10, "{sum:?} {load:?}");
        let [[xx, xy], [yx, yy]] = balance.stiffness;
        prop_assert!((xy - yx).abs() <= 1e-12 * (xx.abs() + yy.abs()));
    }

    #[test]
    fn turning_the_cage_by_one_spacing_changes_nothing(cage_angle in -PI..PI) {
        let bearing = bearing(&shipped("er16k-tb1"));
        let at = |angle| bearing.balance(angle, [0.0, -500.0]).unwrap().free_stiffness();
        // Angles round at 4e-16; near an edge the stiffness turns by 1e9 N/m per rad.
        prop_assert!((at(cage_angle) / at(cage_angle + bearing.spacing()) - 1.0).abs() < 1e-9);
    }
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let hosted = shipped("6205-hosted");
    let found = bearing(&hosted).balance(0.0, bearing(&hosted).load());
    assert!(matches!(found, Err(StaticError::NoLoad { .. })), "{found:?}");
    assert_eq!(bearing(&healthy()).critical_load(), Err(StaticError::NoDefect));
}

/// Spalled bearings of three to six elements.
fn sparse(seed: u64) -> Scene {
    let mut draw = Draw::new(seed);
    let mut draw = |low, high| draw.within(low, high);
    let count = draw(3.0, 7.0) as usize;
    let diameter = draw(4e-3, 12e-3);
    let pitch = diameter * draw(2.6, 6.0);
    let mut bearing = Bearing::steel_balls(count, diameter, pitch);
    bearing.radial_clearance = draw(0.0, 20e-6);
    let angle = draw(-PI, PI);
    let outer = 0.5 * (pitch + diameter);
    let length = outer * draw(2.0, 60.0).to_radians();
    let builder = Scene::builder(bearing).shaft_load([0.0, -draw(50.0, 5000.0)]).shaft_speed(60.0);
    builder.spall(angle, length, draw(5e-6, 200e-6)).law(ContactLaw::Hertz).build().unwrap()
}

#[test]
fn spalled_bearings_of_few_elements_have_their_stiffness_and_a_critical_load_or_the_reason_for_none() {
    let (mut given, mut none) = (0, 0);
    for seed in 0..40 {
        let scene = sparse(seed);
        let bearing = bearing(&scene);
        assert!(sweep(&bearing, -FRAC_PI_2, 20).is_ok(), "{seed}");
        let angles = (0..20).map(|i| f64::from(i) / 20.0 * bearing.spacing());
        let found =
            angles.map(|angle| bearing.critical_load_at(angle).unwrap()).chain([bearing.critical_load().unwrap()]);
        for found in found {
            match found {
                Ok(critical) => {
                    let balance = bearing.balance(critical.cage_angle, [0.0, -critical.load.max(1.0)]).unwrap();
                    let most = balance.elements.iter().map(|element| element.inner_approach).fold(0.0, f64::max);
                    assert!(most <= 0.1 * scene.bearing.element_radius(), "{seed}: {critical:?}");
                    given += 1;
                }
                Err(NoCriticalLoad::BeyondElastic { load, gap_um, approach_um, limit_um }) => {
                    assert!(load.is_finite() && gap_um >= 0.0 && approach_um > limit_um, "{seed}");
                    none += 1;
                }
                Err(NoCriticalLoad::NoneInside) => {}
                Err(why) => panic!("{seed}, {scene:?}: {why}"),
            }
        }
    }
    assert!(given > 50 && none > 50, "{given} {none}");
}

#[test]
fn a_spall_opposite_the_load_says_why_no_load_brings_its_elements_to_carry() {
    let mut scene = shipped("er16k-tb1");
    scene.defects[0].angle = FRAC_PI_2;
    let why = bearing(&scene).critical_load().unwrap().unwrap_err().to_string();
    // Balls of 7.94 mm; the ring goes away from the spall.
    assert!(why.contains("um to go") && why.contains("at most 397.0 um, a tenth of an element's radius"), "{why}");
}
