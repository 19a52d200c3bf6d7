//! The extremes: loads, speeds, masses, clearances, defects, jumps and communication steps far from usual, each against
//! a closed form, or against the other integration method at a tolerance 100 times tighter, or to be refused clearly.
//!
//! Each case gives a row of `docs/stability.md`. To write that file anew:
//! `cargo test --release --test extremes -- --ignored write`.

#![allow(clippy::unwrap_used, clippy::expect_used)]

mod support;

use brinell::geometry::hertz_constant::HertzConstants;
use brinell::scene::{ContactLaw, Damping, Defect, DefectShape, Motion, Ring, Scene};
use brinell::simulation::{Method, Simulation, SimulationError};
use std::f64::consts::{FRAC_PI_2, TAU};
use support::{Named, shipped};

/// One row of the table.
struct Row {
    what: &'static str,
    expected: String,
    got: String,
    steps: (u64, u64),
}

impl Row {
    fn new(what: &'static str, expected: impl Into<String>, got: impl Into<String>, bearing: &Named) -> Self {
        Self { what, expected: expected.into(), got: got.into(), steps: bearing.0.step_counts() }
    }

    fn method(&self) -> String {
        match self.steps {
            (0, _) => "none".to_owned(),
            (_, 0) => "explicit".to_owned(),
            (all, implicit) if all == implicit => "implicit".to_owned(),
            (all, implicit) => format!("both, {:.0} % implicit", 100.0 * implicit as f64 / all as f64),
        }
    }
}

fn healthy() -> Scene {
    shipped("6205-healthy")
}

fn spalled() -> Scene {
    let mut scene = shipped("er16k-tb1");
    scene.contact.law = ContactLaw::Hertz;
    scene
}

fn hosted() -> Scene {
    let mut scene = shipped("6205-healthy");
    for ring in [&mut scene.shaft, &mut scene.housing] {
        *ring = Ring { motion: Motion::Host, load: [0.0; 2], mass: 0.0, damping: 0.0, stiffness: 0.0 };
    }
    scene.sensor = None;
    scene
}

fn lighter(mut scene: Scene, factor: f64) -> Scene {
    scene.bearing.element_mass = Some(factor * scene.bearing.mass_of_element());
    scene
}

fn loaded(mut scene: Scene, load: f64, damping: Damping) -> Scene {
    (scene.shaft.load, scene.contact.damping) = ([0.0, -load], damping);
    scene
}

fn spall(length: f64, depth: f64, slope_degrees: f64, angle: f64) -> Scene {
    let mut scene = spalled();
    let shape = DefectShape::Spall { length, depth, edge_slope: slope_degrees.to_radians() };
    scene.defect = Some(Defect { angle, shape });
    scene
}

/// What a run gives: forces at the communication points.
fn forces(bearing: &mut Named, step: f64, count: usize, host: &dyn Fn(&mut Named, f64)) -> Vec<f64> {
    let names =
        ["shaft.force.x", "shaft.force.y", "housing.force.y", "element[1].force.outer", "element[2].force.inner"];
    let references = names.map(|name| bearing.reference(name));
    let mut found = Vec::new();
    for i in 0..count {
        host(bearing, i as f64 * step);
        bearing.run(step, 1);
        let mut now = [0.0; 5];
        bearing.0.reals(&references, &mut now).unwrap();
        found.extend(now);
    }
    found
}

/// Runs the scene as it is, and by one method alone at a tolerance 100 times tighter; the largest difference of any force
/// over the largest force must be below `limit`.
fn converges(
    what: &'static str,
    scene: Scene,
    (step, count): (f64, usize),
    limit: f64,
    check_by: Method,
    host: &dyn Fn(&mut Named, f64),
) -> Row {
    let mut tight = scene.clone();
    tight.tolerance *= 1e-2;
    let mut bearing = Named::started(scene);
    let found = forces(&mut bearing, step, count, host);
    let mut check = Named::started(tight);
    check.0.set_method(check_by);
    let expected = forces(&mut check, step, count, host);
    let largest = expected.iter().fold(0.0f64, |m, f| m.max(f.abs()));
    let worst = found.iter().zip(&expected).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
    assert!(worst <= limit * largest, "{what}: forces differ by {worst:e} N of {largest:e} N");
    let by = if check_by == Method::Rodas { "implicit" } else { "explicit" };
    Row::new(
        what,
        format!("the {by} method at 1e-2 of the tolerance, within {limit:.0e} of {largest:.3e} N"),
        format!("{:.1e}", worst / largest),
        &bearing,
    )
}

fn nothing(_: &mut Named, _: f64) {}

/// Jump of the load by a factor, and rest in the end: the equilibrium that is solved statically.
///
/// With contact damping within 1e-4: the tolerance is 1e-5 of the largest approach, and the force grows with its power
/// 1.5. Without it the elements go on vibrating with what the jump gave them, some 1e-3 of the force.
fn settles(what: &'static str, scene: Scene, limit: f64) -> Row {
    let load = scene.shaft.load[1];
    let mut scene = scene;
    (scene.shaft_speed, scene.sensor) = (0.0, None);
    let mut at_rest = Named::started(scene.clone());
    let mut start = scene;
    start.shaft.load[1] = 0.2 * load;
    let mut bearing = Named::started(start);
    bearing.set("shaft.load.y", load);
    // Rings' vibrations decay with 2m/c = 5 and 6 ms: e^-25 after 150 ms.
    bearing.run(1e-3, 150);
    let force = |b: &mut Named| b.inner_forces(9).into_iter().fold(0.0, f64::max);
    let (expected, got) = (force(&mut at_rest), force(&mut bearing));
    assert!((got - expected).abs() < limit * expected, "{what}: {got} N, in static equilibrium {expected} N");
    Row::new(
        what,
        format!("static equilibrium: largest element force {expected:.4e} N"),
        format!("{got:.4e} N"),
        &bearing,
    )
}

/// A run that must not go on.
fn refused(what: &'static str, wanted: &str, found: Result<(), SimulationError>, bearing: &Named) -> Row {
    let message = found.expect_err(what).to_string();
    assert!(message.contains(wanted), "{what}: {message}");
    Row::new(what, "a clear error", message, bearing)
}

fn load_1_newton() -> Row {
    converges(
        "load 1 N",
        loaded(healthy(), 1.0, Damping::HuntCrossley(0.5)),
        (1e-4, 100),
        1e-3,
        Method::Rodas,
        &nothing,
    )
}

fn load_0() -> Row {
    let mut scene = loaded(healthy(), 0.0, Damping::HuntCrossley(0.5));
    (scene.gravity, scene.shaft_speed) = ([0.0; 2], 100.0);
    scene.housing.motion = Motion::Fixed;
    scene.housing = Ring { motion: Motion::Fixed, load: [0.0; 2], mass: 0.0, damping: 0.0, stiffness: 0.0 };
    scene.sensor = None;
    scene.shaft.stiffness = 1e6;
    let speed = scene.shaft_speed * brinell::geometry::kinematics::cage_ratio(&scene.bearing, 0.0);
    let mass = scene.bearing.mass_of_element();
    let radius = scene.bearing.outer_raceway_radius() - 0.5 * scene.bearing.element_diameter;
    let mut bearing = Named::started(scene);
    bearing.run(1e-3, 100);
    let (expected, got) = (mass * radius * speed * speed, bearing.get("element[3].force.outer"));
    // Errors are measured against at least 0.1 µm, and this contact's approach is 0.02 µm.
    assert!((got - expected).abs() < 2e-3 * expected, "{got} {expected}");
    assert!(bearing.get("shaft.force.y").abs() < 1e-9);
    Row::new(
        "load 0",
        format!("m ρ ω² = {expected:.4e} N outside, 0 on the shaft"),
        format!("{got:.4e} N, 0"),
        &bearing,
    )
}

fn speed_100_000_rev_min() -> Row {
    let mut scene = hosted();
    scene.shaft_speed = 100_000.0 / 60.0 * TAU;
    let omega = scene.shaft_speed * brinell::geometry::kinematics::cage_ratio(&scene.bearing, 0.0);
    let mass = scene.bearing.mass_of_element();
    let radius = scene.bearing.outer_raceway_radius() - 0.5 * scene.bearing.element_diameter;
    let mut bearing = Named::started(scene);
    bearing.run(1e-4, 200);
    let gravity = -9.81 * bearing.get("element[3].angle").sin();
    let expected = mass * ((radius + bearing.get("element[3].path")) * omega * omega + gravity);
    let got = bearing.get("element[3].force.outer");
    // Gravity turns with 650 Hz far below the contact's resonance: quasi-static within (650/20000)² of 0.02 N.
    assert!((got - expected).abs() < 1e-5 * expected, "{got} {expected}");
    Row::new(
        "shaft at 100 000 rev/min, rings held concentric",
        format!("m (ρ ω² + g·e_r) = {expected:.6e} N"),
        format!("{got:.6e} N"),
        &bearing,
    )
}

fn speed_0() -> Row {
    let mut scene = healthy();
    scene.shaft_speed = 0.0;
    let mut bearing = Named::started(scene);
    let before = bearing.inner_forces(9);
    bearing.run(0.1, 10);
    let drift = before.iter().zip(bearing.inner_forces(9)).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
    let largest = before.iter().fold(0.0f64, |m, f| m.max(*f));
    // Nothing moves: only the static solution's own residual of 1e-12 and what the tolerance lets through.
    assert!(drift < 1e-6 * largest, "{drift} of {largest}");
    Row::new(
        "speed 0 for 1 s",
        "element forces of the start",
        format!("changed by {:.0e} of the largest", drift / largest),
        &bearing,
    )
}

fn reversal() -> Row {
    let mut scene = spalled();
    scene.shaft_speed = 60.0;
    let mut bearing = Named::started(scene);
    let start = bearing.get("cage.angle");
    let (speed, ramp) = (bearing.reference("shaft.speed"), -6000.0);
    for _ in 0..200 {
        bearing.0.set_input_derivatives(&[speed], &[1], &[ramp]).unwrap();
        bearing.run(1e-4, 1);
    }
    let travel = bearing.get("cage.angle") - start;
    // 60 rad/s to −60 rad/s in 20 ms: there and back.
    assert!(travel.abs() < 1e-12 && (bearing.get("shaft.speed") + 60.0).abs() < 1e-10, "{travel}");
    let path = bearing.get("element[3].path");
    assert!(path.abs() < 2e-4, "{path}");
    Row::new(
        "reversal by a ramp of speed, with a spall",
        "the cage back where it was",
        format!("{travel:.0e} rad beside it"),
        &bearing,
    )
}

fn preload() -> Row {
    let mut scene = hosted();
    (scene.bearing.radial_clearance, scene.gravity, scene.shaft_speed) = (-5e-6, [0.0; 2], 0.0);
    let hertz = HertzConstants::of(&scene.bearing);
    let in_series = (hertz.inner.powf(-2.0 / 3.0) + hertz.outer.powf(-2.0 / 3.0)).powf(-1.5);
    let expected = in_series * 5e-6f64.powf(1.5);
    let mut bearing = Named::started(scene);
    bearing.run(1e-3, 20);
    let got = bearing.get("element[5].force.inner");
    // The tolerance of 1e-5 of the approach, with the power 1.5.
    assert!((got - expected).abs() < 1.5e-5 * expected, "{got} {expected}");
    Row::new(
        "clearance −5 µm, concentric",
        format!("K (5 µm)^1.5 = {expected:.6} N in each contact"),
        format!("{got:.6} N"),
        &bearing,
    )
}

fn free_fall() -> Row {
    let mut scene = hosted();
    (scene.bearing.radial_clearance, scene.shaft_speed) = (1e-3, 0.0);
    scene.cage.initial_angle = FRAC_PI_2;
    let mut bearing = Named::started(scene);
    let start = bearing.get("element[1].path");
    // The inner ring, on which the topmost element lies, drops by 0.2 mm at once.
    bearing.set("shaft.y", -2e-4);
    bearing.run(1e-3, 3);
    let expected = start - 0.5 * 9.81 * 3e-3 * 3e-3;
    let got = bearing.get("element[1].path");
    assert_eq!(bearing.get("element[1].force.inner") + bearing.get("element[1].force.outer"), 0.0);
    // A parabola is integrated exactly; rounding of 1 mm over some hundred steps.
    assert!((got - expected).abs() < 1e-15, "{got} {expected}");
    Row::new(
        "both contacts of an element lost",
        format!("free fall: path {expected:.9e} m"),
        format!("{got:.9e} m"),
        &bearing,
    )
}

fn energy_without_damping() -> Row {
    // One element between fixed rings, pushed off its balance: energy of contacts and motion.
    let mut scene = hosted();
    (scene.bearing.radial_clearance, scene.gravity, scene.shaft_speed) = (-10e-6, [0.0; 2], 0.0);
    scene.contact.damping = Damping::HuntCrossley(0.0);
    let hertz = HertzConstants::of(&scene.bearing);
    let (mass, z) = (scene.bearing.mass_of_element(), scene.bearing.element_count);
    let mut bearing = Named::started(scene);
    let energy = |b: &mut Named| {
        let of = |force: f64, k: f64| 0.4 * force * (force / k).powf(2.0 / 3.0);
        let w = b.0.state_vector()[z.next_multiple_of(8)];
        let (inner, outer) = (b.get("element[1].force.inner"), b.get("element[1].force.outer"));
        of(inner, hertz.inner) + of(outer, hertz.outer) + 0.5 * mass * w * w
    };
    let rest = energy(&mut bearing);
    // A blow by the outer ring's velocity, once.
    bearing.set("shaft.x", 3e-6);
    let start = energy(&mut bearing);
    let mut drift: f64 = 0.0;
    for _ in 0..100 {
        bearing.run(1e-4, 1);
        drift = drift.max((energy(&mut bearing) - start).abs());
    }
    let share = drift / (start - rest).abs();
    // Some 400 periods at the default tolerance of 1e-5, of which each takes its part.
    assert!(share < 1e-2, "{share}");
    Row::new(
        "no damping anywhere, 10 ms at 40 kHz",
        "energy of the vibration constant",
        format!("drift {share:.1e} of it"),
        &bearing,
    )
}

fn communication_steps() -> Row {
    let end = |steps: &[f64], stop: f64, load_factor: f64| {
        let mut scene = spalled();
        scene.tolerance = 1e-10;
        scene.shaft.load[1] *= load_factor;
        let mut bearing = Named::started(scene);
        let mut time = 0.0;
        for &step in steps.iter().cycle() {
            let step = f64::min(step, stop - time);
            if step < 1e-13 {
                break;
            }
            bearing.run(step, 1);
            time += step;
        }
        // Over the load of 500 N, and what it does to the housing's spring.
        let found = [
            bearing.get("shaft.force.y") / 500.0,
            bearing.get("element[9].force.outer") / 500.0,
            bearing.get("housing.y") / (500.0 / 1.5e7),
        ];
        (found, bearing)
    };
    let differ = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).fold(0.0f64, |worst, (a, b)| worst.max((a - b).abs()));
    const SPLITS: [&[f64]; 2] = [&[1e-3], &[3.3e-5, 1.7e-3, 2e-6, 1.1e-2]];
    let short = differ(end(&[3e-4], 3e-4, 1.0).0, end(&[1e-7], 3e-4, 1.0).0);
    let (entry, _) = end(&[9e-3], 9e-3, 1.0);
    let entry = SPLITS.iter().fold(0.0f64, |worst, steps| worst.max(differ(entry, end(steps, 9e-3, 1.0).0)));
    // Errors of a thousand steps at 1e-10 add up, through the entry of one element into the spall.
    assert!(short < 1e-10 && entry < 1e-7, "{short} {entry}");
    // Elements that hang loose between the rings bounce, and small differences grow with every bounce: after four
    // passages the bearing answers to a change of the load in its twelfth digit as it does to another splitting of time.
    let (whole, bearing) = end(&[0.1], 0.1, 1.0);
    // One change of the load may by chance grow little; of several the largest counts.
    let changes = [1e-12, -1e-12, 2e-12, -2e-12, 3e-12];
    let sensitivity = changes.iter().fold(0.0f64, |worst, by| worst.max(differ(whole, end(&[0.1], 0.1, 1.0 + by).0)));
    let long = SPLITS.iter().fold(0.0f64, |worst, steps| worst.max(differ(whole, end(steps, 0.1, 1.0).0)));
    assert!(long < 10.0 * sensitivity && long < 2e-2, "{long} {sensitivity}");
    Row::new(
        "communication steps 1e-7, 1e-3, 0.1 s and irregular, tolerance 1e-10",
        format!("equal forces; after 0.1 s as equal as with a load changed by 1e-12, which is {sensitivity:.0e} of it"),
        format!("differ by {short:.0e} of the load after 0.3 ms, {entry:.0e} after 9 ms, {long:.0e} after 0.1 s"),
        &bearing,
    )
}

fn one_minute() -> Row {
    let mut scene = hosted();
    scene.bearing.element_count = 3;
    scene.shaft_speed = 25.0 * TAU;
    let omega = scene.shaft_speed * brinell::geometry::kinematics::cage_ratio(&scene.bearing, 0.0);
    let mut bearing = Named::new(scene);
    bearing.set("shaft.y", -2e-5);
    bearing.0.initialize(0.0).unwrap();
    let start = bearing.get("cage.angle");
    let force = |b: &mut Named| (1..=3).map(|j| b.get(&format!("element[{j}].force.outer"))).fold(0.0, f64::max);
    // The cage turns by one spacing in this time, after which all repeats.
    let period = TAU / 3.0 / omega;
    bearing.run(period, 1);
    let first = force(&mut bearing);
    let count = (60.0 / period) as usize;
    bearing.run(period, count - 1);
    let (angle, last) = (bearing.get("cage.angle") - start, force(&mut bearing));
    let turned = count as f64 * TAU / 3.0;
    // Rounding of each advance, 2e-16 of half a turn, adds up over 1800.
    assert!((angle - turned).abs() < 1e-11, "{angle} {turned}");
    assert!((last - first).abs() < 1e-4 * first, "{last} {first}");
    Row::new(
        "a minute of simulated time at 25 Hz, 3 elements",
        format!("cage {turned:.6} rad; largest element force {first:.4} N as in the first period"),
        format!("{angle:.6} rad; {last:.4} N"),
        &bearing,
    )
}

fn step_budget() -> Row {
    let mut scene = loaded(healthy(), 5e4, Damping::HuntCrossley(5.0));
    scene.max_steps = 1000;
    let mut bearing = Named::started(scene);
    bearing.0.set_method(Method::DormandPrince);
    let found = bearing.0.step(0.01);
    refused("50 kN, χ = 5 s/m, explicit only, solver.max_steps = 1000", "solver.max_steps", found, &bearing)
}

fn thrown_out() -> Row {
    let mut scene = hosted();
    // A hard inner ring, whose energy drives the element out through a soft outer one.
    let hertz = HertzConstants::of(&scene.bearing);
    (scene.bearing.hertz_inner, scene.contact.damping) = (Some(10.0 * hertz.inner), Damping::HuntCrossley(0.0));
    let mut bearing = Named::started(scene);
    bearing.set("shaft.x", 3.9e-3);
    let found = bearing.0.step(0.1);
    refused("host moves the inner ring by 3.9 mm, no damping", "has left the bearing", found, &bearing)
}

fn rings_apart() -> Row {
    let mut bearing = Named::started(hosted());
    // As far as the variable allows: through the outer ring.
    bearing.set("shaft.x", 0.01);
    let found = bearing.0.step(0.1);
    refused("host moves the inner ring by 10 mm", "offset of the rings", found, &bearing)
}

fn not_finite() -> Row {
    let mut bearing = Named::started(hosted());
    let reference = bearing.reference("shaft.x");
    bearing.0.set_input_derivatives(&[reference], &[2], &[1e300]).unwrap();
    let found = bearing.0.step(1e-3);
    refused("host accelerates the inner ring by 1e300 m/s²", "offset of the rings", found, &bearing)
}

fn too_deep() -> Row {
    let bearing = Named::new(healthy());
    let found = Simulation::new(spall(3e-3, 5e-3, 90.0, -FRAC_PI_2), None).map(|_| ());
    refused("spall 5 mm deep, deeper than an element's radius", "depth", found, &bearing)
}

/// Load that turns round at 2 kHz, smoothly, with its derivatives given.
fn reversing(bearing: &mut Named, time: f64) {
    let omega = TAU * 2000.0;
    let (load, reference) = (2000.0, bearing.reference("shaft.load.y"));
    let (sin, cos) = (omega * time).sin_cos();
    bearing.set("shaft.load.y", load * cos);
    let rates = [-load * omega * sin, -load * omega * omega * cos];
    bearing.0.set_input_derivatives(&[reference, reference], &[1, 2], &rates).unwrap();
}

fn jump(bearing: &mut Named, time: f64, by: f64) {
    bearing.set("shaft.y", if time > 2e-4 { -1e-5 - by } else { -1e-5 });
}

fn many(count: usize) -> Scene {
    let mut scene = healthy();
    scene.bearing.element_count = count;
    if count > 9 {
        // As many elements as find room, on a pitch circle that grows with them.
        scene.bearing.pitch_diameter *= count as f64 / 9.0;
    }
    scene
}

macro_rules! extremes {
    ($($name:ident = $case:expr;)*) => {
        $(#[test]
        fn $name() {
            let _: Row = $case;
        })*

        /// Every case, in order.
        fn rows() -> Vec<Row> {
            vec![$($case),*]
        }
    };
}

const CHI: fn(f64) -> Damping = Damping::HuntCrossley;

extremes! {
    without_load_the_elements_press_outwards_only = load_0();
    a_load_of_one_newton_is_carried = load_1_newton();
    fifty_kilonewton_without_contact_damping_settle = settles("load jumps to 50 kN, χ = 0", loaded(healthy(), 5e4, CHI(0.0)), 5e-3);
    fifty_kilonewton_with_usual_damping_settle = settles("load jumps to 50 kN, χ = 0.5 s/m", loaded(healthy(), 5e4, CHI(0.5)), 1e-4);
    fifty_kilonewton_with_strong_damping_settle = settles("load jumps to 50 kN, χ = 5 s/m", loaded(healthy(), 5e4, CHI(5.0)), 1e-4);
    fifty_kilonewton_with_proportional_damping_settle =
        settles("load jumps to 50 kN, proportional, τ = 10 µs", loaded(healthy(), 5e4, Damping::Proportional(1e-5)), 1e-4);
    fifty_kilonewton_turning_agree_with_the_other_method =
        converges("50 kN turning, χ = 5 s/m", loaded(healthy(), 5e4, CHI(5.0)), (1e-4, 10), 1e-4, Method::DormandPrince, &nothing);
    a_bearing_at_rest_stays_at_rest = speed_0();
    one_turn_a_second_agrees = converges("speed 1 Hz, spall", { let mut s = spalled(); s.shaft_speed = TAU; s }, (1e-3, 40), 1e-3, Method::Rodas, &nothing);
    centrifugal_force_at_a_hundred_thousand_turns_a_minute = speed_100_000_rev_min();
    a_speed_that_reverses_brings_the_cage_back = reversal();
    a_step_of_speed_agrees = converges("speed steps from 25 to 250 Hz", healthy(), (1e-4, 50), 1e-3, Method::Rodas,
        &|b, t| b.set("shaft.speed", if t > 1e-3 { 250.0 * TAU } else { 25.0 * TAU }));
    without_damping_energy_stays = energy_without_damping();
    elements_ten_times_lighter_agree = converges("elements 10 times lighter, spall", lighter(spalled(), 0.1), (1e-4, 60), 1e-3, Method::DormandPrince, &nothing);
    elements_a_hundred_times_lighter_agree =
        converges("elements 100 times lighter, spall", lighter(spalled(), 0.01), (1e-4, 60), 1e-3, Method::DormandPrince, &nothing);
    rings_of_a_gram_agree = converges("ring masses 1 g", { let mut s = healthy(); (s.shaft.mass, s.housing.mass) = (1e-3, 1e-3); s }, (1e-4, 50), 1e-3, Method::Rodas, &nothing);
    rings_of_a_ton_agree = converges("ring masses 1 t", { let mut s = healthy(); (s.shaft.mass, s.housing.mass) = (1e3, 1e3); s }, (1e-4, 50), 1e-3, Method::Rodas, &nothing);
    a_clearance_of_a_millimetre_agrees = converges("clearance 1 mm", { let mut s = healthy(); s.bearing.radial_clearance = 1e-3; s }, (1e-4, 30), 1e-2, Method::Rodas, &nothing);
    a_preload_gives_the_forces_of_contacts_in_series = preload();
    a_spall_two_millimetres_deep_agrees = converges("spall 2 mm deep", spall(5e-3, 2e-3, 90.0, -FRAC_PI_2), (1e-4, 100), 1e-2, Method::Rodas, &nothing);
    a_spall_deeper_than_an_element_is_refused = too_deep();
    a_spall_wider_than_the_spacing_agrees = converges("spall of 55 degrees, wider than the spacing", { let mut s = shipped("er16k-tb2"); s.contact.law = ContactLaw::Hertz; s }, (1e-4, 100), 1e-2, Method::Rodas, &nothing);
    a_spall_of_one_cell_agrees = converges("spall 50 µm long, 1 µm deep", spall(50e-6, 1e-6, 90.0, -FRAC_PI_2), (1e-4, 300), 1e-3, Method::Rodas, &nothing);
    a_spall_on_the_unloaded_side_agrees = converges("spall on the unloaded side", spall(5e-3, 1e-4, 90.0, FRAC_PI_2), (1e-4, 100), 1e-3, Method::Rodas, &nothing);
    gentle_edges_agree = converges("edges of 1 degree", spall(20e-3, 1e-4, 1.0, -FRAC_PI_2), (1e-4, 100), 1e-3, Method::Rodas, &nothing);
    vertical_edges_agree = converges("edges of 90 degrees", spall(5e-3, 1e-4, 90.0, -FRAC_PI_2), (1e-4, 100), 1e-2, Method::Rodas, &nothing);
    an_element_without_contact_falls_freely = free_fall();
    a_jump_of_a_micrometre_agrees = converges("host jumps by 1 µm", hosted(), (1e-4, 20), 1e-3, Method::Rodas, &|b, t| jump(b, t, 1e-6));
    a_jump_of_a_hundred_micrometres_agrees = converges("host jumps by 100 µm", hosted(), (1e-4, 20), 1e-3, Method::Rodas, &|b, t| jump(b, t, 1e-4));
    communication_steps_of_any_length_agree = communication_steps();
    a_load_reversing_at_two_kilohertz_agrees = converges("load of 2 kN reversing at 2 kHz", healthy(), (1e-5, 300), 1e-2, Method::Rodas, &reversing);
    a_minute_leaves_no_drift = one_minute();
    three_elements_agree = converges("3 elements", many(3), (1e-4, 50), 1e-3, Method::Rodas, &nothing);
    a_hundred_elements_agree = converges("100 elements", many(100), (1e-4, 30), 1e-3, Method::Rodas, &nothing);
    more_steps_than_allowed_are_an_error = step_budget();
    an_element_thrown_out_is_an_error = thrown_out();
    rings_beside_each_other_are_an_error = rings_apart();
    a_state_that_is_not_finite_is_an_error = not_finite();
}

#[test]
fn a_saved_state_continues_with_the_same_bits_while_the_methods_take_turns() {
    let mut bearing = Named::started(lighter(spalled(), 0.01));
    let mut other = Named::started(lighter(spalled(), 0.01));
    let names = ["shaft.y", "housing.ay", "element[1].path", "element[1].force.outer"];
    let (mut turns, mut last) = (0, bearing.0.step_counts());
    for _ in 0..100 {
        let state = bearing.0.save();
        bearing.run(7.7e-5, 2);
        let first = (names.map(|name| bearing.get(name).to_bits()), bearing.0.step_counts());
        // In this simulation again, and by way of bytes in another that was somewhere else.
        bearing.0.restore(&state).unwrap();
        bearing.run(7.7e-5, 2);
        assert_eq!(first, (names.map(|name| bearing.get(name).to_bits()), bearing.0.step_counts()));
        let state = other.0.state_from_bytes(&state.to_bytes()).unwrap();
        other.0.restore(&state).unwrap();
        other.run(7.7e-5, 2);
        assert_eq!(first, (names.map(|name| other.get(name).to_bits()), other.0.step_counts()));
        let now = bearing.0.step_counts();
        let (all, implicit) = (now.0 - last.0, now.1 - last.1);
        turns += usize::from(implicit > 0 && implicit < all);
        last = now;
    }
    assert!(turns > 10, "both methods stepped in {turns} of 100 rounds only");
}

#[test]
fn mean_forces_of_both_methods_agree() {
    let mean = |method: Method| {
        let mut bearing = Named::started(hosted());
        bearing.0.set_method(method);
        bearing.set("shaft.y", -1e-5);
        bearing.run(1e-3, 1);
        let means = ["shaft.mean_force.x", "shaft.mean_force.y", "housing.mean_force.y"].map(|name| bearing.get(name));
        (means, bearing.get("shaft.force.y"))
    };
    let ((explicit, end), (implicit, _)) = (mean(Method::DormandPrince), mean(Method::Rodas));
    for (a, b) in explicit.iter().zip(implicit) {
        // The tolerance is 1e-5 of an approach.
        assert!((a - b).abs() < 1e-4 * end.abs(), "{a} {b}");
    }
    assert!((explicit[1] - end).abs() > 1e-3 * end.abs(), "a steady force would show nothing: {} {end}", explicit[1]);
}

#[test]
#[ignore = "writes docs/stability.md"]
fn write_the_table_of_stability() {
    let mut text = String::from(
        "# Stability on stiff and extreme cases\n\n\
         Each row is a test of `tests/extremes.rs`, at the default tolerance of 1e-5 unless it says otherwise; this file is \
         written by `cargo test --release --test extremes -- --ignored write`. *Explicit* is Dormand–Prince 5(4), *implicit* \
         Rodas5P; the choice is automatic. Where no closed form exists, the forces at all communication points are compared \
         with those of one method alone at a tolerance 100 times tighter: the largest difference over the largest force. \
         Steps are those of the whole run.\n\n\
         | what | expected | got | steps | method chosen |\n|---|---|---|---:|---|\n",
    );
    for row in rows() {
        text += &format!("| {} | {} | {} | {} | {} |\n", row.what, row.expected, row.got, row.steps.0, row.method());
    }
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    std::fs::create_dir_all(&path).unwrap();
    std::fs::write(path.join("stability.md"), text).unwrap();
}

#[test]
fn a_cage_that_turns_too_fast_for_time_to_pass_between_edges_fails_at_once() {
    let text = std::fs::read_to_string("scenes/er16k-tb1.toml").unwrap();
    let mut scene = Scene::from_toml(&text).unwrap();
    scene.contact.law = ContactLaw::Hertz;
    let mut simulation = Simulation::new(scene, None).unwrap();
    simulation.initialize(0.0).unwrap();
    let speed = simulation.table().iter().find(|variable| variable.name == "shaft.speed").unwrap().reference;
    // No host can set such a speed; a state in bytes can hold it. Marks are put in its place and looked for.
    simulation.set_reals(&[speed], &[12.3456]).unwrap();
    simulation.set_input_derivatives(&[speed], &[1], &[6.54321]).unwrap();
    let mut bytes = simulation.save().to_bytes();
    for (mark, value) in [(12.3456_f64, 1e200_f64), (6.54321, 1.0)] {
        let places: Vec<usize> = (0..bytes.len() - 7).filter(|&i| bytes[i..i + 8] == mark.to_le_bytes()).collect();
        assert_eq!(places.len(), 1);
        bytes[places[0]..places[0] + 8].copy_from_slice(&value.to_le_bytes());
    }
    let state = simulation.state_from_bytes(&bytes).unwrap();
    simulation.restore(&state).unwrap();
    // Without a limit this step would never end: passages at one instant are no integration steps.
    let message = simulation.step(1e-5).unwrap_err().to_string();
    assert!(message.contains("turns too fast"), "{message}");
}
