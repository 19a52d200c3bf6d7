//! A mass in a host on a ring that the host moves: one that holds the ring's force over a step, and one that iterates.

use super::differences::{reals, references};
use brinell::simulation::Simulation;

/// Two coordinates.
pub type Pair = [f64; 2];

/// What a host has on two coordinates of the shaft.
#[derive(Clone, Copy)]
pub struct Coupled {
    /// Inputs: positions, speeds, accelerations.
    pub places: [&'static str; 6],
    /// Names of the bearing's forces, behind what kind they are.
    pub forces: [&'static str; 2],
    pub mass: Pair,
    pub damping: Pair,
    pub load: Pair,
    pub start: Pair,
    /// Beyond them the mass has gone astray.
    pub bounds: Pair,
    pub stop: f64,
    /// Between positions that are told (s).
    pub grid: f64,
}

impl Coupled {
    /// The mass under a force that is held, exactly.
    fn moved(&self, x: Pair, v: Pair, force: Pair, h: f64) -> (Pair, Pair) {
        let after = [0, 1].map(|i| {
            let rate = self.damping[i] / self.mass[i];
            let far = (force[i] + self.load[i]) / self.damping[i];
            (x[i] + far * h - (v[i] - far) * (-rate * h).exp_m1() / rate, far + (v[i] - far) * (-rate * h).exp())
        });
        (after.map(|(x, _)| x), after.map(|(_, v)| v))
    }

    /// Positions at each multiple of the grid, by steps of `h` (s) that are taken so many times from the same point,
    /// each time with what came out; `kind` of forces. Fewer if the mass goes astray.
    pub fn positions(&self, mut simulation: Simulation, kind: &str, times: usize, h: f64) -> Vec<Pair> {
        let places = references(&simulation, &self.places);
        let forces = self.forces.map(|name| simulation.reference(&format!("shaft.{kind}{name}")).unwrap());
        let force_of = |simulation: &mut Simulation| -> Pair { reals(simulation, &forces).try_into().unwrap() };
        let set = |simulation: &mut Simulation, x: Pair, v: Pair, a: Pair| {
            simulation.set_reals(&places, &[x, v, a].concat()).unwrap();
        };
        let (mut x, mut v) = (self.start, [0.0; 2]);
        set(&mut simulation, x, v, [0.0; 2]);
        simulation.initialize(0.0).unwrap();
        let mut force = force_of(&mut simulation);
        let mut positions = vec![x];
        for count in 1..=(self.stop / h).round() as usize {
            // The acceleration that a unit shows is that of the force which it was given last.
            let a = [0, 1].map(|i| (force[i] + self.load[i] - self.damping[i] * v[i]) / self.mass[i]);
            let (read, before) = (force_of(&mut simulation), simulation.save());
            set(&mut simulation, x, v, a);
            simulation.step(h).unwrap();
            for _ in 1..times {
                let (x1, v1) = self.moved(x, v, force_of(&mut simulation), h);
                simulation.restore(&before).unwrap();
                set(&mut simulation, x1, v1, a);
                simulation.step(h).unwrap();
            }
            force = if times > 1 { force_of(&mut simulation) } else { read };
            (x, v) = self.moved(x, v, force, h);
            if (0..2).any(|i| x[i].abs() > self.bounds[i] || x[i].is_nan()) {
                break;
            }
            if count % (self.grid / h).round() as usize == 0 {
                positions.push(x);
            }
        }
        positions
    }
}

/// Sums of the squares by which each coordinate is apart from what is exact, and of its way.
pub fn apart_and_way(found: &[Pair], exact: &[Pair]) -> [Pair; 2] {
    [0, 1].map(|i| {
        let square = |a: &Pair, b: &Pair| (a[i] - b[i]).powi(2);
        let apart = found.iter().zip(exact).map(|(a, b)| square(a, b)).sum();
        [apart, exact.iter().map(|b| square(b, &exact[0])).sum()]
    })
}
