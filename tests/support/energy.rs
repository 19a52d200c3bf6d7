//! Energy of a held bearing, and what its forced motions take out of it.

use super::Named;
use brinell::dynamics::contacts::Forces;
use brinell::dynamics::parameters::Frame;
use brinell::geometry::hertz_constant::HertzConstants;
use brinell::scene::Scene;

/// All energy of a bearing with balls whose outer ring is held: shaft, elements, contacts, load and gravity (J); and
/// what leaves it by forced motions (W).
pub fn energy_and_power(bearing: &mut Named, scene: &Scene) -> [f64; 2] {
    let cage_torque = bearing.get("cage.torque");
    let (model, excitation) = bearing.0.equations();
    let state = bearing.0.state_vector();
    let cells = model.cells_at(&excitation, 0.0, state);
    let mut forces = Forces::of(model);
    model.derivative(&excitation, 0.0, &cells, state, &mut vec![0.0; state.len()], &mut forces);
    let layout = &model.layout;
    let stored = |k: f64, approach: f64| 0.4 * k * approach.max(0.0).powf(2.5);
    let i = layout.shaft.unwrap();
    let mut energy = 0.5 * scene.shaft.mass * (state[i + 2].powi(2) + state[i + 3].powi(2));
    energy -= scene.shaft.load[0] * state[i] + scene.shaft.load[1] * state[i + 1];
    let speed = excitation.cage.0[1];
    for j in 0..model.element_count {
        let larger = scene.bearing.diameter_offsets.get(j).copied().unwrap_or(0.0);
        let own = scene.bearing.with_elements_larger(larger);
        let (hertz, mass) = (HertzConstants::of(&own), own.mass_of_element());
        let rho = own.outer_raceway_radius() - own.element_radius() + state[j];
        let (w, angle) = (state[layout.radial_velocity + j], excitation.cage_start + model.element_offset(j));
        energy += 0.5 * mass * (w * w + (rho * speed).powi(2));
        energy -= mass * rho * (scene.gravity[0] * angle.cos() + scene.gravity[1] * angle.sin());
        energy += stored(hertz.inner, forces.contacts.inner_approach[j]);
        energy += stored(hertz.outer, forces.contacts.outer_approach[j]);
    }
    let spin = excitation.frames[Frame::Spin as usize].since.0[1];
    let power = forces.torque_on(Frame::Shaft) * scene.shaft_speed
        + cage_torque * speed
        + forces.torque_on(Frame::Spin) * (spin - speed);
    [energy, power]
}

/// What a run of so many steps (s) exchanges with its forced motions at most, and what is lost beside that (J).
pub fn exchanged_and_lost(bearing: &mut Named, scene: &Scene, step: f64, count: usize) -> [f64; 2] {
    let [start, mut power] = energy_and_power(bearing, scene);
    let (mut left, mut drift, mut moved) = (0.0, 0.0f64, 0.0f64);
    for _ in 0..count {
        bearing.0.step(step).unwrap();
        let [energy, now] = energy_and_power(bearing, scene);
        left += 0.5 * step * (power + now);
        power = now;
        drift = drift.max((energy + left - start).abs());
        moved = moved.max(left.abs());
    }
    [moved, drift]
}
