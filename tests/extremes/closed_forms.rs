//! Extremes with a closed form, or with a law that must hold.

use crate::row::Row;
use crate::scenes::{Kind, loaded, without_inertia};
use crate::support::Named;
use crate::support::energy::{pushed, stored};
use brinell::contact::rolling::RacewaySide;
use brinell::geometry::hertz_constant::HertzConstants;
use brinell::geometry::kinematics::Ratios;
use brinell::scene::{Damping, Ring, Scene};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Jump of the load by a factor, and rest in the end: the equilibrium that is solved statically.
///
/// With contact damping within 1e-4: the tolerance is 1e-5 of the largest approach, and the force grows with its power
/// 1.5. Without it the elements go on vibrating with what the jump gave them, some 1e-3 of the force.
pub fn settles(kind: Kind, what: &'static str, mut scene: Scene, limit: f64) -> Row {
    let load = scene.shaft.load[1];
    (scene.shaft_speed, scene.sensors) = (0.0, Vec::new());
    let mut at_rest = Named::started(scene.clone());
    scene.shaft.load[1] = 0.2 * load;
    let mut bearing = Named::started(scene);
    bearing.set("shaft.load.y", load);
    // Rings' vibrations decay with 2m/c = 5 and 6 ms: e^-25 after 150 ms.
    bearing.run(1e-3, 150);
    let force = |b: &mut Named| b.inner_forces(kind.count).into_iter().fold(0.0, f64::max);
    let (expected, got) = (force(&mut at_rest), force(&mut bearing));
    assert!((got - expected).abs() < limit * expected, "{what}: {got} N, in static equilibrium {expected} N");
    let wanted = format!("static equilibrium: largest element force {expected:.4e} N");
    Row::new(what, wanted, format!("{got:.4e} N"), &bearing).within((got - expected).abs() / expected, limit)
}

pub fn load_0(kind: Kind, what: &'static str, damping: Damping) -> Row {
    let mut scene = loaded(kind.healthy(), 0.0, damping);
    (scene.gravity, scene.shaft_speed) = ([0.0; 2], 100.0);
    scene.housing = Ring::fixed();
    scene.sensors.clear();
    scene.shaft.stiffness = 1e6;
    let speed = scene.shaft_speed * Ratios::new(&scene.bearing, 0.0, 0.0).cage[0];
    let mass = scene.bearing.mass_of_element();
    let radius = scene.bearing.outer_raceway_radius() - scene.bearing.element_radius();
    let mut bearing = Named::started(scene);
    bearing.run(1e-3, 100);
    let (expected, got) = (mass * radius * speed * speed, bearing.get("element[3].force.outer"));
    // Errors are measured against at least 0.1 µm, and this contact's approach is 0.02 µm.
    assert!((got - expected).abs() < 2e-3 * expected, "{got} {expected}");
    assert!(bearing.get("shaft.force.y").abs() < 1e-9);
    Row::new(what, format!("m ρ ω² = {expected:.4e} N outside, 0 on the shaft"), format!("{got:.4e} N, 0"), &bearing)
        .within((got - expected).abs() / expected, 2e-3)
}

pub fn speed_100_000_rev_min(kind: Kind) -> Row {
    turns_100_000_times_a_minute("shaft at 100 000 rev/min, rings held concentric", kind.hosted(), 1e-5)
}

/// Without inertia an element feels the centrifugal force of one that touches the smooth outer raceway: that of its
/// path beyond it, 1e-5 m of 1.6e-2 m, is left out.
pub fn speed_100_000_rev_min_without_inertia(kind: Kind) -> Row {
    let scene = without_inertia(kind.hosted());
    turns_100_000_times_a_minute("the same, elements without inertia", scene, 1e-3)
}

fn turns_100_000_times_a_minute(what: &'static str, mut scene: Scene, limit: f64) -> Row {
    scene.shaft_speed = 100_000.0 / 60.0 * TAU;
    let omega = scene.shaft_speed * Ratios::new(&scene.bearing, 0.0, 0.0).cage[0];
    let dimensions = scene.bearing.clone();
    let mut bearing = Named::started(scene);
    let [got, expected] = bearing.pressed_outwards(&dimensions, omega);
    let r = dimensions.element_radius();
    let volume = dimensions.roller().map_or(4.0 / 3.0 * PI * r * r * r, |roller| PI * r * r * roller.length);
    assert!((dimensions.mass_of_element() / (volume * dimensions.density) - 1.0).abs() < 1e-14);
    assert_eq!(bearing.get("element[3].force.inner"), 0.0);
    // Gravity turns with 650 Hz far below the contact's resonance: quasi-static within (650/20000)² of 0.02 N.
    assert!((got - expected).abs() < limit * expected, "{got} {expected}");
    Row::new(what, format!("m (ρ ω² + g·e_r) = {expected:.6e} N"), format!("{got:.6e} N"), &bearing)
        .within((got - expected).abs() / expected, limit)
}

pub fn speed_0(kind: Kind) -> Row {
    let mut scene = kind.healthy();
    scene.shaft_speed = 0.0;
    let mut bearing = Named::started(scene);
    let before = bearing.inner_forces(kind.count);
    bearing.run(0.1, 10);
    let drift = before.iter().zip(bearing.inner_forces(kind.count)).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
    let largest = before.iter().fold(0.0f64, |m, f| m.max(*f));
    // Nothing moves: only the static solution's own residual of 1e-12 and what the tolerance lets through.
    assert!(drift < 1e-6 * largest, "{drift} of {largest}");
    Row::new("speed 0 for 1 s", format!("element forces of the start, up to {largest:.4} N"), "the same", &bearing)
        .within(drift / largest, 1e-6)
}

pub fn reversal(kind: Kind) -> Row {
    let mut scene = kind.spalled();
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
    let (what, expected) = ("reversal by a ramp of speed, with a spall", "the cage back where it was, 0 rad");
    Row::new(what, expected, format!("{travel:.0e} rad"), &bearing).within(travel.abs(), 1e-12)
}

pub fn preload(kind: Kind) -> Row {
    let mut scene = kind.hosted();
    (scene.bearing.radial_clearance, scene.gravity, scene.shaft_speed) = (-5e-6, [0.0; 2], 0.0);
    let (form, expected) = if kind.is_rollers() {
        ("(K/40) Σ max(0, 2.5 µm − P_k)^(10/9)", laminae(&scene, 2.5e-6))
    } else {
        let hertz = HertzConstants::of(&scene.bearing);
        let in_series = (hertz.inner.powf(-2.0 / 3.0) + hertz.outer.powf(-2.0 / 3.0)).powf(-1.5);
        ("K (5 µm)^1.5", in_series * 5e-6f64.powf(1.5))
    };
    let mut bearing = Named::started(scene);
    bearing.run(1e-3, 20);
    let got = bearing.get("element[5].force.inner");
    // The tolerance of 1e-5 of the approach, with the power 1.5; a crown's table is right to 2e-5.
    let limit = kind.pick(1.5e-5, 4e-5);
    assert!((got - expected).abs() < limit * expected, "{got} {expected}");
    let wanted = format!("{form} = {expected:.6} N in each contact");
    Row::new("clearance −5 µm, concentric", wanted, format!("{got:.6} N"), &bearing)
        .within((got - expected).abs() / expected, limit)
}

/// Force of a roller with the standard's crown on one raceway by the sum over its laminae (N).
fn laminae(scene: &Scene, approach: f64) -> f64 {
    let (roller, diameter) = (scene.bearing.roller().unwrap(), scene.bearing.element_diameter);
    let count = f64::from(roller.laminae);
    let over = |k: u32| {
        let x = 2.0 * (f64::from(k) + 0.5) / count - 1.0;
        (approach + 0.00035 * diameter * (1.0 - x * x).ln()).max(0.0).powf(10.0 / 9.0)
    };
    let constant = 2f64.powf(10.0 / 9.0) * 3.5948e10 * roller.length.powf(8.0 / 9.0);
    constant / count * (0..roller.laminae).map(over).sum::<f64>()
}

pub fn free_fall(kind: Kind) -> Row {
    let mut scene = kind.hosted();
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
    let wanted = format!("free fall: path {expected:.9e} m");
    Row::new("both contacts of an element lost", wanted, format!("{got:.9e} m"), &bearing)
        .within((got - expected).abs() / expected.abs(), 1e-12)
}

pub fn energy_without_damping(kind: Kind) -> Row {
    // One element between fixed rings, pushed off its balance: energy of contacts and motion.
    let mut scene = kind.hosted();
    (scene.bearing.radial_clearance, scene.gravity, scene.shaft_speed) = (-10e-6, [0.0; 2], 0.0);
    scene.contact.damping = Damping::HuntCrossley(0.0);
    let mut bearing = Named::started(scene.clone());
    // An impact by the inner ring, once; roller 1 is right below.
    let push = (kind.pick("shaft.x", "shaft.y"), kind.pick(3e-6, -3e-6));
    let [rest, start, end, drift] = pushed(&mut bearing, &scene, push);
    let share = drift / (start - rest).abs();
    // Some 400 periods at the default tolerance of 1e-5, of which each takes its part.
    assert!(share < 1e-2, "{share}");
    Row::new(
        kind.pick(
            "one element between fixed rings without damping, 10 ms at 40 kHz",
            "one element between fixed rings without damping, 10 ms",
        ),
        format!("energy of the vibration constant, {:.6e} J", start - rest),
        format!("{:.6e} J", end - rest),
        &bearing,
    )
    .within(share, 1e-2)
}

pub fn energy_of_a_bearing_without_damping(kind: Kind) -> Row {
    // The shaft free on its contacts, the housing held: a housing that moved would take work from the cage.
    let mut scene = kind.healthy();
    let held = Ring::fixed();
    (scene.housing, scene.sensors, scene.shaft_speed) = (held, Vec::new(), 0.0);
    (scene.shaft.damping, scene.contact.damping) = (0.0, Damping::HuntCrossley(0.0));
    let (shaft_mass, mass) = (scene.shaft.mass, scene.bearing.mass_of_element());
    let gravity = scene.gravity;
    let mut bearing = Named::started(scene.clone());
    let load = -3000.0;
    let energy = |b: &mut Named| {
        let layout = b.0.equations().0.layout;
        let state = b.0.state_vector().to_vec();
        let mut sum = 0.0;
        for j in 0..layout.element_count {
            let [inner, outer, angle] =
                ["force.inner", "force.outer", "angle"].map(|name| b.get(&format!("element[{}].{name}", j + 1)));
            let (u, w) = (state[j], state[layout.radial_velocity + j]);
            sum += stored(&scene, RacewaySide::Inner, inner) + stored(&scene, RacewaySide::Outer, outer);
            sum += 0.5 * mass * w * w;
            sum -= mass * u * (gravity[0] * angle.cos() + gravity[1] * angle.sin());
        }
        let shaft = layout.shaft.unwrap();
        let v = [state[shaft + 2], state[shaft + 3]];
        sum + 0.5 * shaft_mass * (v[0] * v[0] + v[1] * v[1]) - load * state[shaft + 1]
    };
    bearing.set("shaft.load.y", load);
    let start = energy(&mut bearing);
    let (mut drift, mut motion): (f64, f64) = (0.0, 0.0);
    for _ in 0..500 {
        bearing.run(1e-4, 1);
        let v = bearing.get("shaft.vy");
        motion = motion.max(0.5 * shaft_mass * v * v);
        drift = drift.max((energy(&mut bearing) - start).abs());
    }
    let share = drift / motion;
    // Thousands of steps at 1e-5 of the approach each, of which errors of one sign add up.
    assert!(share < 1e-2, "{share}");
    Row::new(
        "no damping anywhere, load jumps from 1.5 to 3 kN, 50 ms",
        format!("energy constant; the shaft's own goes up to {motion:.4e} J"),
        format!("changes by {drift:.1e} J"),
        &bearing,
    )
    .within(share, 1e-2)
}
