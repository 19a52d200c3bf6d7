//! A mass on a hosted ring along z and its inertia about x, in a host that holds the bearing's force over a step and in
//! one that iterates, against steps that are twenty times shorter.

use crate::angular;
use brinell::scene::{DegreesOfFreedom, RepeatedInputs, Ring, Scene};
use brinell::simulation::Simulation;

/// Along z (kg) and about x (kg m²).
const MASS: [f64; 2] = [3.0, 2e-3];
/// (N s/m), (N m s)
const DAMPING: [f64; 2] = [2000.0, 1.0];
/// (N), (N m)
const LOAD: [f64; 2] = [-600.0, 3.0];
const STOP: f64 = 3e-3;
const GRID: f64 = 2e-4;
const PLACES: [&str; 6] = ["shaft.z", "shaft.tilt.x", "shaft.vz", "shaft.tilt.vx", "shaft.az", "shaft.tilt.ax"];

type Pair = [f64; 2];

fn hosted() -> Simulation {
    let scene = Scene::builder(angular(25.0)).degrees_of_freedom(DegreesOfFreedom::Five);
    let scene = scene.shaft(Ring::hosted()).housing(Ring::fixed()).shaft_speed(300.0);
    let mut scene = scene.build().unwrap();
    (scene.tolerance, scene.repeated_inputs) = (1e-9, RepeatedInputs::End);
    Simulation::new(scene, None).unwrap()
}

/// The mass under a force that is held, exactly.
fn moved(x: Pair, v: Pair, force: Pair, h: f64) -> (Pair, Pair) {
    let after = [0, 1].map(|i| {
        let rate = DAMPING[i] / MASS[i];
        let far = (force[i] + LOAD[i]) / DAMPING[i];
        (x[i] + far * h - (v[i] - far) * (-rate * h).exp_m1() / rate, far + (v[i] - far) * (-rate * h).exp())
    });
    (after.map(|(x, _)| x), after.map(|(_, v)| v))
}

/// Positions at each multiple of the grid, of a host that holds `prefix` forces, or takes each step `times` times.
fn coupled(prefix: &str, times: usize, h: f64) -> Vec<Pair> {
    let mut simulation = hosted();
    let places = PLACES.map(|name| simulation.reference(name).unwrap());
    let forces = ["force.z", "moment.x"].map(|name| simulation.reference(&format!("shaft.{prefix}{name}")).unwrap());
    let force_of = |simulation: &mut Simulation| {
        let mut force = [0.0; 2];
        simulation.reals(&forces, &mut force).unwrap();
        force
    };
    let set = |simulation: &mut Simulation, x: Pair, v: Pair, a: Pair| {
        simulation.set_reals(&places, &[x[0], x[1], v[0], v[1], a[0], a[1]]).unwrap();
    };
    let (mut x, mut v) = ([-4e-6, 0.0], [0.0; 2]);
    set(&mut simulation, x, v, [0.0; 2]);
    simulation.initialize(0.0).unwrap();
    let mut force = force_of(&mut simulation);
    let mut positions = vec![x];
    for count in 1..=(STOP / h).round() as usize {
        // What a unit shows is the acceleration under the force that it was given last.
        let a = [0, 1].map(|i| (force[i] + LOAD[i] - DAMPING[i] * v[i]) / MASS[i]);
        if times == 1 {
            force = force_of(&mut simulation);
        }
        let before = simulation.save();
        set(&mut simulation, x, v, a);
        simulation.step(h).unwrap();
        for _ in 1..times {
            let (x1, v1) = moved(x, v, force_of(&mut simulation), h);
            simulation.restore(&before).unwrap();
            set(&mut simulation, x1, v1, a);
            simulation.step(h).unwrap();
        }
        if times > 1 {
            force = force_of(&mut simulation);
        }
        (x, v) = moved(x, v, force, h);
        if count % (GRID / h).round() as usize == 0 {
            positions.push(x);
        }
    }
    positions
}

/// Errors of both coordinates in percent of their way.
fn errors(found: &[Pair], exact: &[Pair]) -> Pair {
    [0, 1].map(|i| {
        let square = |a: f64, b: f64| (a - b) * (a - b);
        let error: f64 = found.iter().zip(exact).map(|(a, b)| square(a[i], b[i])).sum();
        let way: f64 = exact.iter().map(|b| square(b[i], exact[0][i])).sum();
        100.0 * (error / way).sqrt()
    })
}

#[test]
fn the_force_to_hold_leads_a_mass_along_the_axis_and_its_tilt() {
    let exact = coupled("next_mean_", 1, 1e-6);
    let ways: Pair = [0, 1].map(|i| exact.iter().map(|x| (x[i] - exact[0][i]).abs()).fold(0.0, f64::max));
    assert!(ways[0] > 1e-6 && ways[1] > 1e-5, "{ways:?}");
    let found =
        [("next_mean_", 1), ("mean_", 4), ("", 1)].map(|(prefix, times)| errors(&coupled(prefix, times, 2e-5), &exact));
    assert!(found[0].iter().all(|&error| error < 0.1), "{found:?}");
    assert!(found[1].iter().all(|&error| error < 0.1), "{found:?}");
    assert!(found[2].iter().all(|&error| error > 1.0), "{found:?}");
}
