//! Inputs as text or bytes. Tests run these over `tests/fuzz/corpus`, too.

mod map;
mod recording;
mod scene;
mod state;
mod trace;

use brinell::simulation::Simulation;
use brinell::simulation::interface::table::Kind;

/// Scenes: both rings moved by forces, one of them by the host, both by the host; and defects of all bodies, an outer
/// ring that turns, an irregular cage, sensors and a probe.
const SCENES: [&str; 4] = [
    concat!(include_str!("../bearing.toml"), include_str!("../internal.toml")),
    concat!(include_str!("../bearing.toml"), include_str!("../hosted_shaft.toml")),
    concat!(include_str!("../bearing.toml"), include_str!("../hosted.toml")),
    include_str!("../everything.toml"),
];

/// Most integration steps in one communication step: a fuzzer finds the slowest inputs first.
const MAX_STEPS: u64 = 2000;

/// Makes of bytes what the target of this name makes of them. True if they are accepted.
pub(crate) fn run(target: &str, data: &[u8]) -> bool {
    match target {
        "map" => map::run(data),
        "recording" => recording::run(data),
        "scene" => scene::run(data),
        "state" => state::run(data),
        "trace" => trace::run(data),
        other => panic!("no target {other}"),
    }
}

/// Runs a simulation for a moment: results are finite or there is an error.
fn simulate(mut simulation: Simulation) {
    let reals: Vec<u32> =
        simulation.table().iter().filter(|v| matches!(v.kind, Kind::Real { .. })).map(|v| v.reference).collect();
    let mut values = vec![0.0; reals.len()];
    if simulation.initialize(0.0).is_err() {
        return;
    }
    for step in [1e-6, 1e-5, 1e-4] {
        if simulation.step(step).is_err() || simulation.reals(&reals, &mut values).is_err() {
            return;
        }
        let bad = values.iter().position(|value| !value.is_finite());
        // The C interface refuses to hand such values out; here it is enough that the states are sound.
        assert!(simulation.state_vector().iter().all(|value| value.is_finite()), "state, variable {bad:?}");
    }
}
