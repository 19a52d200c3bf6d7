//! Energy of a held bearing with balls, and what its forced motions take out of it.

use super::Named;
use brinell::contact::law::elastic_law;
use brinell::contact::rolling::RacewaySide;
use brinell::dynamics::contacts::Forces;
use brinell::dynamics::parameters::Frame;
use brinell::geometry::hertz_constant::HertzConstants;
use brinell::scene::Scene;
use brinell::simulation::Simulation;

fn forces(simulation: &Simulation) -> Forces {
    let (model, excitation) = simulation.equations();
    let state = simulation.state_vector();
    let mut forces = Forces::of(model);
    model.derivative(&excitation, 0.0, simulation.cells(), state, &mut vec![0.0; state.len()], &mut forces);
    forces
}

/// All energy (J) of a bearing whose outer ring is held, in the plane or with a shaft that moves along its axis too:
/// shaft, elements, contacts, loads as the scene has them and gravity; and that of the shaft's motion.
pub fn energy(simulation: &mut Simulation, scene: &Scene) -> [f64; 2] {
    let (axial, ring) = (simulation.equations().0.layout.axial(), &scene.shaft);
    let preload = scene.bearing.contact_angle.map_or(0.0, |angle| ring.axial.preload.copysign(angle));
    let loads = [ring.load[0], ring.load[1], ring.axial.load + preload];
    let (mut of_shaft, mut energy) = (0.0, 0.0);
    for (axis, load) in ["x", "y", "z"].iter().zip(loads).take(if axial.is_some() { 3 } else { 2 }) {
        let [x, v] = ["", "v"].map(|of| simulation.get(&format!("shaft.{of}{axis}")).unwrap());
        of_shaft += 0.5 * ring.mass * v * v;
        energy -= load * x;
    }
    let contacts = forces(simulation).contacts;
    let (model, excitation) = simulation.equations();
    let (state, speed) = (simulation.state_vector(), excitation.cage.0[1]);
    for j in 0..model.element_count {
        let larger = scene.bearing.diameter_offsets.get(j).copied().unwrap_or(0.0);
        let own = scene.bearing.with_elements_larger(larger);
        let (hertz, mass) = (HertzConstants::of(&own), own.mass_of_element());
        let rho = own.outer_raceway_radius() - own.element_radius() + state[j];
        let along = axial.map_or(0.0, |[_, velocity]| state[velocity + j]);
        let (w, angle) = (state[model.layout.radial_velocity + j], excitation.cage_start + model.element_offset(j));
        energy += 0.5 * mass * (w * w + (rho * speed).powi(2) + along * along);
        energy -= mass * rho * (scene.gravity[0] * angle.cos() + scene.gravity[1] * angle.sin());
        for (k, approach) in [(hertz.inner, contacts.inner_approach[j]), (hertz.outer, contacts.outer_approach[j])] {
            energy += 0.4 * k * approach.max(0.0).powf(2.5);
        }
    }
    [energy + of_shaft, of_shaft]
}

/// What leaves a bearing by forced motions (W).
fn power(bearing: &mut Named, scene: &Scene) -> f64 {
    let (cage_torque, forces) = (bearing.get("cage.torque"), forces(&bearing.0));
    let (_, excitation) = bearing.0.equations();
    let (speed, spin) = (excitation.cage.0[1], excitation.frames[Frame::Spin as usize].since.0[1]);
    forces.torque_on(Frame::Shaft) * scene.shaft_speed
        + cage_torque * speed
        + forces.torque_on(Frame::Spin) * (spin - speed)
}

/// What a run of so many steps (s) exchanges with its forced motions at most, and what is lost beside that (J).
pub fn exchanged_and_lost(bearing: &mut Named, scene: &Scene, step: f64, count: usize) -> [f64; 2] {
    let ([start, _], mut before) = (energy(&mut bearing.0, scene), power(bearing, scene));
    let (mut left, mut drift, mut moved) = (0.0, 0.0f64, 0.0f64);
    for _ in 0..count {
        bearing.0.step(step).unwrap();
        let ([energy, _], now) = (energy(&mut bearing.0, scene), power(bearing, scene));
        left += 0.5 * step * (before + now);
        before = now;
        drift = drift.max((energy + left - start).abs());
        moved = moved.max(left.abs());
    }
    [moved, drift]
}

/// Energy (J) that a contact stores under an elastic force (N): 2/5 Q δ of a ball, ∫Q dδ of a roller.
pub fn stored(scene: &Scene, side: RacewaySide, force: f64) -> f64 {
    let law = elastic_law(&scene.bearing, side);
    if scene.bearing.roller().is_none() {
        return 0.4 * force * (force / law.stiffness).powf(2.0 / 3.0);
    }
    // By the trapezoidal rule, whose error of 1e-7 is far below what is looked for.
    let (delta, steps) = (law.approach_under(force), 2000);
    let at = |i: u32| law.elastic(delta * f64::from(i) / f64::from(steps));
    (1..steps).map(at).sum::<f64>() * delta / f64::from(steps) + 0.5 * force * delta / f64::from(steps)
}

/// What element 1 between rings that a host holds, without weight, has when an input is set to a value: its energy
/// before and after that, 10 ms later, and by how much it changes meanwhile (J).
pub fn pushed(bearing: &mut Named, scene: &Scene, (input, value): (&str, f64)) -> [f64; 4] {
    let (mass, velocity) = (scene.bearing.mass_of_element(), bearing.0.equations().0.layout.radial_velocity);
    let energy = |b: &mut Named| {
        let w = b.0.state_vector()[velocity];
        let [inner, outer] = b.all(["element[1].force.inner", "element[1].force.outer"]);
        let contacts = stored(scene, RacewaySide::Inner, inner) + stored(scene, RacewaySide::Outer, outer);
        contacts + 0.5 * mass * w * w
    };
    let rest = energy(bearing);
    bearing.set(input, value);
    let (start, mut drift) = (energy(bearing), 0.0f64);
    for _ in 0..100 {
        bearing.run(1e-4, 1);
        drift = drift.max((energy(bearing) - start).abs());
    }
    [rest, start, energy(bearing), drift]
}
