//! Which step a host that moves a ring should take on this scene's own casing.

use brinell::scene::Motion;
use minijinja::{Value, context};

use crate::package::model::Model;

/// The load (N) under which the bearing's stiffness is taken; the step follows its sixth root.
const LOAD: f64 = 1000.0;
/// ωh of a wiring of second order, and of a force that is held as it is: both are about 1 % off.
const SECOND_ORDER: f64 = 0.1;
const HELD: f64 = 0.001;

/// The rule in numbers, where a ring is the host's and the bearing can carry the load.
pub(super) fn of(model: &Model) -> Option<Value> {
    let step = suggested_step(model)?;
    let micro = |step: f64| format!("{:.2} µs", step * 1e6).replace(".00 ", " ");
    let rounded = |step: f64| if step >= 1e-5 { format!("{:.0} µs", step * 1e6) } else { micro(step) };
    Some(context! {
        load => format!("{LOAD}"),
        frequency => format!("{:.0}", SECOND_ORDER / step / std::f64::consts::TAU),
        second_order => rounded(step),
        held => rounded(HELD / SECOND_ORDER * step),
    })
}

/// `solver.suggested_step` at the position of the shaft, or of the housing where only that is the host's, that carries
/// the load.
fn suggested_step(model: &Model) -> Option<f64> {
    let mut simulation = model.simulation.clone();
    let (name, towards) = match (model.scene.shaft.motion, model.scene.housing.motion) {
        (Motion::Host, _) => ("shaft", -1.0),
        (_, Motion::Host) => ("housing", 1.0),
        _ => return None,
    };
    // A ring that the scene loads stands where that load puts it.
    let loads = ["shaft.load.x", "shaft.load.y", "housing.load.x", "housing.load.y"];
    loads.iter().for_each(|load| drop(simulation.set(load, 0.0)));
    let (place, force) = (format!("{name}.y"), format!("{name}.force.y"));
    let mut carried = |way: f64| {
        simulation.set(&place, towards * way).ok()?;
        simulation.get(&force).ok().map(|force| -towards * force >= LOAD)
    };
    let (mut low, mut high) = (0.0, 1e-5);
    while !carried(high)? {
        (low, high) = (high, 2.0 * high);
    }
    // To a thousandth.
    while high - low > 1e-3 * high {
        let middle = 0.5 * (low + high);
        if carried(middle)? { high = middle } else { low = middle }
    }
    carried(high)?;
    simulation.get("solver.suggested_step").ok()
}
