//! A mass on a hosted ring along z and its inertia about x, in a host that holds the bearing's force over a step and in
//! one that iterates, against steps that are twenty times shorter.

use crate::support::coupled::{Coupled, Pair, apart_and_way};
use crate::{angular, hosted_shaft};
use brinell::scene::{DegreesOfFreedom, RepeatedInputs};
use brinell::simulation::Simulation;

/// Along z (kg, N s/m, N) and about x (kg m², N m s, N m).
const COUPLED: Coupled = Coupled {
    places: ["shaft.z", "shaft.tilt.x", "shaft.vz", "shaft.tilt.vx", "shaft.az", "shaft.tilt.ax"],
    forces: ["force.z", "moment.x"],
    mass: [3.0, 2e-3],
    damping: [2000.0, 1.0],
    load: [-600.0, 3.0],
    start: [-4e-6, 0.0],
    bounds: [f64::INFINITY; 2],
    stop: 3e-3,
    grid: 2e-4,
};

fn hosted() -> Simulation {
    let mut scene = hosted_shaft(angular(25.0), DegreesOfFreedom::Five).shaft_speed(300.0).build().unwrap();
    (scene.tolerance, scene.repeated_inputs) = (1e-9, RepeatedInputs::End);
    Simulation::new(scene, None).unwrap()
}

/// Positions in a host that holds `kind` forces, or takes each step so many times.
fn coupled(kind: &str, times: usize, h: f64) -> Vec<Pair> {
    COUPLED.positions(hosted(), kind, times, h)
}

#[test]
fn the_force_to_hold_leads_a_mass_along_the_axis_and_its_tilt() {
    let exact = coupled("next_mean_", 1, 1e-6);
    let ways: Pair = [0, 1].map(|i| exact.iter().map(|x| (x[i] - exact[0][i]).abs()).fold(0.0, f64::max));
    assert!(ways[0] > 1e-6 && ways[1] > 1e-5, "{ways:?}");
    let found = [("next_mean_", 1), ("mean_", 4), ("", 1)].map(|(kind, times)| {
        // In percent of their way.
        apart_and_way(&coupled(kind, times, 2e-5), &exact).map(|[apart, way]| 100.0 * (apart / way).sqrt())
    });
    assert!(found[0].iter().all(|&error| error < 0.1), "{found:?}");
    assert!(found[1].iter().all(|&error| error < 0.1), "{found:?}");
    assert!(found[2].iter().all(|&error| error > 1.0), "{found:?}");
}
