//! The oil film: what it takes off the clearance, what it resists with before contacts begin, and that it follows the
//! speed.

use crate::support::differences::by_input;
use crate::support::{Named, runge_kutta, shipped};
use brinell::dynamics::contacts::Forces;
use brinell::dynamics::parameters::{Cells, Excitation, Model, Quadratic, film};
use brinell::geometry::film_thickness::{LubricatedContact, rolling_speed_ratio, speed_factor};
use brinell::scene::{Film, Motion, Ring, Scene};
use brinell::simulation::Simulation;
use std::f64::consts::TAU;

const OIL: Film = Film { viscosity: 0.04, pressure_viscosity: 2e-8, layer: None };

/// Test bearing 1 with oil.
fn oiled() -> Scene {
    Scene { film: Some(OIL), ..shipped("er16k-tb1") }
}

/// One element between rings that stand, without weight; films are as at this speed (rad/s).
fn alone(speed: f64) -> (Model, Excitation) {
    let mut scene = oiled();
    (scene.defects, scene.sensors) = (Vec::new(), Vec::new());
    (scene.shaft, scene.housing) = (Ring::fixed(), Ring::fixed());
    (scene.gravity, scene.bearing.element_count, scene.cage.initial_angle) = ([0.0; 2], 1, 0.3);
    (Model::smooth(&scene), Excitation { relative_speed: Quadratic::constant(speed), ..Excitation::default() })
}

/// Forces of both contacts of the element at path `u` and radial velocity `w`, and its acceleration.
fn at(model: &Model, excitation: &Excitation, u: f64, w: f64) -> [f64; 3] {
    let mut state = vec![0.0; model.layout.len];
    (state[0], state[model.layout.radial_velocity]) = (u, w);
    let (mut rate, mut forces) = (vec![0.0; state.len()], Forces::new(1));
    model.derivative(excitation, 0.0, &Cells::smooth(1, 0), &state, &mut rate, &mut forces);
    [forces.contacts.inner[0], forces.contacts.outer[0], rate[model.layout.radial_velocity]]
}

/// Films of the inner and of the outer raceway: squeeze constant (N s) and thickness (m) at a speed (rad/s).
fn films(speed: f64) -> [(f64, f64); 2] {
    let bearing = oiled().bearing;
    // Rings that stand have no load: the smallest that the formula is asked for.
    let rolling = rolling_speed_ratio(&bearing) * speed;
    LubricatedContact::of(&bearing, &OIL, 0.0)
        .map(|contact| (contact.squeeze, contact.thickness(speed_factor(rolling))))
}

#[test]
fn a_gap_that_closes_evenly_resists_as_the_closed_form_says_on_both_raceways() {
    let (model, excitation) = alone(TAU * 10.0);
    let [(inner, h_inner), (outer, h_outer)] = films(TAU * 10.0);
    let films_now = model.films_at(&excitation, 0.0);
    assert!((model.radial_clearance - model.clearance(films_now.as_ref()) - h_inner - h_outer).abs() < 1e-18);
    for u in [-4e-6, -2e-6, -0.3e-6] {
        for w in [0.01, 0.2, -0.03] {
            let [force_in, force_out, acceleration] = at(&model, &excitation, u, w);
            // Of the clearance the films leave 5 µm less their thickness.
            let gap_in = 5e-6 - h_inner - h_outer + u + h_inner;
            let expected = if w > 0.0 { [0.0, outer * w / (h_outer - u)] } else { [inner * -w / gap_in, 0.0] };
            for (found, expected) in [force_in, force_out].into_iter().zip(expected) {
                // Rounding of micrometres in a radius of 16 mm is 1e-12.
                assert!((found - expected).abs() <= 1e-9 * expected, "{u} {w}: {found} {expected}");
            }
            let sum = (force_in - force_out) / model.element_mass;
            assert!((acceleration - sum).abs() < 1e-9 * sum.abs() + 1e-12);
        }
    }
}

#[test]
fn a_loose_element_stops_where_the_stopping_law_says() {
    // m dv/dt = −c v/g and dg/dt = −v: g falls to g₀ e^(−m v₀/c), whatever the film's thickness is counted into g.
    let (model, excitation) = alone(TAU * 10.0);
    let [_, (c, h)] = films(TAU * 10.0);
    for (start, speed) in [(4e-6, 0.01), (2e-6, 0.05)] {
        let mut way = vec![-start, speed];
        // A hundredth of the gap's own time m g/c and less.
        for _ in 0..60_000 {
            way = runge_kutta(&way, 2e-8, |way| vec![way[1], at(&model, &excitation, way[0], way[1])[2]]);
        }
        let expected = (start + h) * (-model.element_mass * speed / c).exp();
        // It comes to rest exponentially; 1.2 ms are 40 times of its slowest.
        let left = h - way[0];
        assert!((left - expected).abs() < 1e-6 * expected, "{start} {speed}: {left} {expected}");
    }
}

#[test]
fn an_opening_gap_is_not_held() {
    let (model, excitation) = alone(TAU * 10.0);
    for u in [-4e-6, -1e-6, -1e-9] {
        assert_eq!(at(&model, &excitation, u, -0.1)[1], 0.0);
    }
    for u in [-1e-9, -1e-6] {
        assert_eq!(at(&model, &excitation, u, 0.1)[0], 0.0);
    }
}

#[test]
fn films_take_their_thickness_off_the_clearance_where_rings_turn_and_nothing_where_they_stand() {
    // Held rings: what is pressed between them carries more by the films.
    let mut scene = oiled();
    (scene.defects, scene.sensors) = (Vec::new(), Vec::new());
    let start = |scene: &Scene| {
        let mut bearing = Named::started(scene.clone());
        bearing.get("shaft.y") - bearing.get("housing.y")
    };
    let oiled_at = |speed: f64| start(&Scene { shaft_speed: speed, ..scene.clone() });
    let dry_at = |speed: f64| start(&Scene { shaft_speed: speed, film: None, ..scene.clone() });
    assert_eq!(oiled_at(0.0).to_bits(), dry_at(0.0).to_bits());
    let bearing = &scene.bearing;
    let of = LubricatedContact::of(bearing, &OIL, 5.0 * 500.0 / 9.0);
    let lost: f64 = of.iter().map(|c| c.thickness(speed_factor(rolling_speed_ratio(bearing) * TAU * 10.0))).sum();
    assert!(lost > 0.2e-6 && lost < 0.4e-6, "{lost}");
    // As much as a dry bearing of so much less clearance stands higher; the raceway's radius goes with the clearance.
    let mut tighter = Scene { film: None, shaft_speed: TAU * 10.0, ..scene.clone() };
    tighter.bearing.radial_clearance -= lost;
    let [rise, expected] = [oiled_at(TAU * 10.0), start(&tighter)].map(|y| y - dry_at(TAU * 10.0));
    assert!((rise - expected).abs() < 2e-3 * expected, "{rise} {expected}");
}

/// A bearing after so many steps (s) in which the speed (Hz) changes, from this on.
fn after(steps: u32, from: f64) -> Named {
    let mut bearing = Named::started(oiled());
    for k in 0..steps {
        bearing.set("shaft.speed", TAU * (from + f64::from(k)));
        bearing.run(1e-4, 1);
    }
    bearing
}

#[test]
fn a_saved_state_and_a_repeated_step_have_the_same_bits() {
    // The films of the other are those of another speed.
    let (mut bearing, mut other) = (after(100, 10.0), after(1, 510.0));
    let names = [
        "shaft.y",
        "shaft.force.y",
        "element[1].path",
        "element[1].force.outer",
        "element[4].force.outer",
        "cage.torque",
        "sensor.acceleration",
    ];
    let state = other.0.state_from_bytes(&bearing.0.save().to_bytes()).unwrap();
    other.0.restore(&state).unwrap();
    assert_eq!(other.bits(names), bearing.bits(names));
    for k in 100..140 {
        bearing.set("shaft.speed", TAU * (10.0 + f64::from(k)));
        bearing.goes_on_alike(&mut other, names, 1e-4, 1);
    }
}

/// What follows the speed through the films.
const FOLLOWING: [&str; 6] =
    ["shaft.force.y", "housing.force.y", "shaft.ay", "element[1].force.inner", "element[2].force.outer", "cage.torque"];

#[test]
fn outputs_follow_the_speed_through_the_films_as_their_derivatives_say() {
    let mut scene = oiled();
    scene.film = Some(Film { viscosity: 0.1, ..OIL });
    let stiffnesses = ["shaft.stiffness.xx", "shaft.stiffness.xy", "shaft.stiffness.yy"];
    let mut names = FOLLOWING.to_vec();
    names.extend(stiffnesses);
    let mut bearing = Simulation::new(scene, None).unwrap();
    for started in [false, true] {
        if started {
            bearing.initialize(0.0).unwrap();
            bearing.step(1e-3).unwrap();
        }
        let speed = bearing.reference("shaft.speed").unwrap();
        for (slope, &name) in by_input(&mut bearing, &names, "shaft.speed", TAU * 1e-3).iter().zip(&names) {
            // (1e-4)² of truncation, and the rounding of outputs that are up to 1e3 N, 1e3 m/s² and 1e9 N/m.
            let rounding = if stiffnesses.contains(&name) { 1e-5 * 1e9 * 1e-6 } else { 1e-6 };
            assert!(slope.miss() < 1e-5 * slope.found.abs() + rounding, "{name}: {slope:?}");
            let mut adjoint = [0.0];
            bearing.adjoint_derivative(&[bearing.reference(name).unwrap()], &[speed], &[1.0], &mut adjoint).unwrap();
            assert_eq!(adjoint, [slope.given], "{name}");
        }
        let table = bearing.table().to_vec();
        for dependencies in bearing.dependencies() {
            let name = &table[dependencies.output as usize].name;
            if stiffnesses.contains(&&**name) || FOLLOWING.contains(&&**name) {
                assert!(dependencies.direct.contains(&speed), "{name}");
            }
        }
    }
}

#[test]
fn outputs_change_with_time_as_the_films_do() {
    // The speed changes fast enough for films to count: 63 rad/s in 5 ms.
    let mut bearing = Simulation::new(Scene { film: Some(Film { viscosity: 0.4, ..OIL }), ..oiled() }, None).unwrap();
    bearing.initialize(0.0).unwrap();
    let speed = bearing.reference("shaft.speed").unwrap();
    let go = |bearing: &mut Simulation, step: f64| {
        bearing.set_input_derivatives(&[speed], &[1], &[1.2e4]).unwrap();
        bearing.step(step).unwrap();
    };
    go(&mut bearing, 1e-3);
    for name in ["shaft.force.y", "shaft.stiffness.yy"] {
        let (unknown, mut found) = (bearing.reference(name).unwrap(), [0.0]);
        bearing.set_input_derivatives(&[speed], &[1], &[1.2e4]).unwrap();
        bearing.output_derivatives(&[unknown], &[1], &mut found).unwrap();
        let (before, saved) = (bearing.get(name).unwrap(), bearing.save());
        let step = 1e-8;
        go(&mut bearing, step);
        let quotient = (bearing.get(name).unwrap() - before) / step;
        bearing.restore(&saved).unwrap();
        // A one-sided quotient: elements vibrate with some 1e5 rad/s.
        assert!((found[0] - quotient).abs() < 5e-3 * quotient.abs(), "{name}: {} {quotient}", found[0]);
    }
}

/// A hosted inner ring in oil, nothing turning.
fn held() -> Scene {
    let mut scene = oiled();
    (scene.defects, scene.sensors, scene.housing) = (Vec::new(), Vec::new(), Ring::fixed());
    Scene { shaft: Ring::hosted(), shaft_speed: 0.0, ..scene }
}

#[test]
fn speeds_too_small_for_their_reciprocal_give_numbers() {
    for speed in [5e-324, 1e-310, -2e-309, 2e-308, 1e-200] {
        let mut bearing = Named::started_with(held(), &[("shaft.speed", speed), ("shaft.y", -9e-6)]);
        bearing.run(1e-5, 1);
        for name in ["shaft.stiffness.yy", "shaft.stiffness.xy", "shaft.next_mean_force.y"] {
            let value = bearing.get(name);
            assert!(value.is_finite(), "{name} is {value} at {speed:e} rad/s");
        }
        let [known, unknown] = ["shaft.y", "shaft.force.y"].map(|name| bearing.0.reference(name).unwrap());
        let mut change = [0.0];
        bearing.0.directional_derivative(&[unknown], &[known], &[1.0], &mut change).unwrap();
        assert!(change[0] < -1e6, "{change:?} at {speed:e} rad/s");
    }
}

#[test]
fn a_ring_at_rest_feels_the_film_whichever_way_it_begins_to_move() {
    let mut bearing = Simulation::new(held(), None).unwrap();
    for started in [false, true] {
        if started {
            bearing.initialize(0.0).unwrap();
        }
        for (force, velocity) in [("shaft.force.x", "shaft.vx"), ("shaft.force.y", "shaft.vy")] {
            let slope = by_input(&mut bearing, &[force], velocity, 1e-8)[0];
            // Balls that bear their weight alone go away from the film: 3 % at 1e-4 m/s.
            assert!(slope.found < -1.0 && slope.miss() < 1e-6 * slope.found.abs(), "{force} by {velocity}: {slope:?}");
        }
    }
}

#[test]
fn a_bearing_that_runs_down_and_stands_and_turns_back_has_numbers_throughout() {
    let mut bearing = Named::started(oiled());
    for k in 0..80 {
        bearing.set("shaft.speed", TAU * (10.0 - 0.25 * f64::from(k)).max(0.0));
        bearing.run(2.5e-4, 1);
        assert!(bearing.get("shaft.y").is_finite());
    }
    for speed in [0.0, -1.0, -20.0] {
        bearing.set("shaft.speed", speed);
        bearing.run(1e-3, 1);
    }
    assert!(bearing.get("shaft.force.y") > 100.0);
}

#[test]
fn a_ring_that_a_host_lifts_feels_the_film_give_back_no_work() {
    // The inner ring swings 3 µm up and down between a gap and a contact, fast enough for the film to matter; over
    // whole swings the bearing takes work and never gives any.
    let mut scene = oiled();
    (scene.defects, scene.sensors) = (Vec::new(), Vec::new());
    (scene.shaft, scene.housing) = (Ring::hosted(), Ring::fixed());
    scene.contact.damping = brinell::scene::Damping::HuntCrossley(0.0);
    (scene.shaft_speed, scene.gravity) = (0.0, [0.0; 2]);
    assert_eq!(scene.shaft.motion, Motion::Host);
    let work = |film: Option<Film>| {
        let (step, pace) = (1e-5, TAU * 200.0);
        let motion = |t: f64| (-3.5e-6 + 3e-6 * (pace * t).cos(), -3e-6 * pace * (pace * t).sin());
        let (y, vy) = motion(0.0);
        let scene = Scene { film, ..scene.clone() };
        let mut bearing = Named::started_with(scene, &[("shaft.y", y), ("shaft.vy", vy)]);
        let mut work = 0.0;
        for k in 0..500 {
            let (y, vy) = motion(f64::from(k) * step);
            bearing.set("shaft.y", y);
            bearing.set("shaft.vy", vy);
            bearing.run(step, 1);
            work -= bearing.get("shaft.mean_force.y") * (motion(f64::from(k + 1) * step).0 - y);
        }
        work
    };
    let (dry, wet) = (work(None), work(Some(OIL)));
    // What the dry bearing takes is what its elements' bouncing holds, and the error of the mean force.
    assert!(wet > 0.0 && wet > dry, "{wet} {dry}");
}

#[test]
fn a_film_that_fills_the_bearing_is_remarked_upon_and_one_that_bursts_it_is_an_error() {
    let mut scene = oiled();
    assert_eq!(film::remark(&scene), None);
    scene.film = Some(Film { viscosity: 1.0, ..OIL });
    scene.shaft_speed = TAU * 30.0;
    let remark = film::remark(&scene).unwrap().to_string();
    assert!(remark.contains("of a radial clearance of 5 um (bearing.radial_clearance_um)"), "{remark}");
    let mut bearing = Simulation::new(scene, None).unwrap();
    bearing.initialize(0.0).unwrap();
    bearing.step(1e-4).unwrap();
    bearing.set("shaft.speed", TAU * 5e3).unwrap();
    let message = bearing.step(1e-4).unwrap_err().to_string();
    assert!(message.contains("at 5000 Hz leave a radial clearance of -"), "{message}");
    // Nothing was taken: it goes on at another speed.
    bearing.set("shaft.speed", TAU * 10.0).unwrap();
    bearing.step(1e-4).unwrap();
}

/// The sensor's signal every millisecond while the shaft of a healthy 6205 in oil goes evenly from 10 to `to` (Hz)
/// within `span` (s), by steps of `step` (s).
fn run_up(viscosity: f64, to: f64, span: f64, step: f64) -> Vec<f64> {
    let scene = Scene { film: Some(Film { viscosity, ..OIL }), shaft_speed: TAU * 10.0, ..shipped("6205-healthy") };
    let mut bearing = Named::started(scene);
    let (speed, rate) = (bearing.0.reference("shaft.speed").unwrap(), TAU * (to - 10.0) / span);
    let (per_sample, samples) = ((1e-3 / step).round() as usize, (span / 1e-3).round() as usize);
    let mut signal = Vec::new();
    for _ in 0..samples {
        for _ in 0..per_sample {
            bearing.0.set_input_derivatives(&[speed], &[1], &[rate]).unwrap();
            bearing.0.step(step).unwrap();
        }
        signal.push(bearing.get("sensor.acceleration"));
    }
    signal
}

/// Root mean square of a difference, over that of the second signal.
fn miss(a: &[f64], b: &[f64]) -> f64 {
    let rms = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
    rms(&mut a.iter().zip(b).map(|(a, b)| a - b)) / rms(&mut b.iter().copied())
}

#[test]
fn a_run_up_in_oil_is_the_same_with_any_communication_step() {
    for viscosity in [0.04, 0.4] {
        let [coarse, fine] = [1e-3, 1e-4].map(|step| run_up(viscosity, 40.0, 0.5, step));
        let miss = miss(&coarse, &fine);
        // The scene's tolerance of 1e-5 leaves 5e-5 and 4e-4; films that stood still within a step missed by 0.2 and 2.
        assert!(miss < 2e-3, "{viscosity} Pa s: {miss}");
    }
}
