//! Values of several variables, and derivatives as a simulation gives them beside differences.

use brinell::simulation::Simulation;

pub fn references(simulation: &Simulation, names: &[&str]) -> Vec<u32> {
    names.iter().map(|name| simulation.reference(name).unwrap_or_else(|error| panic!("{error}"))).collect()
}

pub fn reals(simulation: &mut Simulation, references: &[u32]) -> Vec<f64> {
    let mut values = vec![f64::NAN; references.len()];
    simulation.reals(references, &mut values).unwrap();
    values
}

/// A derivative of an output: as it is given, by differences, by how much these change from one to the next, and the
/// largest of the values that they are of.
#[derive(Debug, Clone, Copy)]
pub struct Slope {
    pub given: f64,
    pub found: f64,
    pub second: f64,
    pub size: f64,
}

impl Slope {
    pub fn miss(&self) -> f64 {
        (self.given - self.found).abs()
    }

    pub fn largest(&self) -> f64 {
        self.given.abs().max(self.found.abs())
    }
}

/// Derivatives of outputs by an input, and central differences over `h` to either side of where it is.
pub fn by_input(simulation: &mut Simulation, outputs: &[&str], input: &str, h: f64) -> Vec<Slope> {
    let (unknowns, known) = (references(simulation, outputs), references(simulation, &[input]));
    let (mut given, middle) = (vec![f64::NAN; unknowns.len()], simulation.get(input).unwrap());
    simulation.directional_derivative(&unknowns, &known, &[1.0], &mut given).unwrap();
    let [before, after, here] = [middle - h, middle + h, middle].map(|value| {
        simulation.set_reals(&known, &[value]).unwrap();
        reals(simulation, &unknowns)
    });
    let slope = |i: usize| {
        let (a, b, second) = (before[i], after[i], (after[i] + before[i] - 2.0 * here[i]).abs() / h);
        Slope { given: given[i], found: (b - a) / (2.0 * h), second, size: a.abs().max(b.abs()) }
    };
    (0..given.len()).map(slope).collect()
}

/// Derivatives of outputs by time, and one-sided differences of second order over steps of `h` (s), from which the
/// simulation comes back.
pub fn by_time(simulation: &mut Simulation, outputs: &[&str], h: f64) -> Vec<Slope> {
    let unknowns = references(simulation, outputs);
    let (mut given, here) = (vec![f64::NAN; unknowns.len()], simulation.save());
    simulation.output_derivatives(&unknowns, &vec![1; unknowns.len()], &mut given).unwrap();
    let now = reals(simulation, &unknowns);
    let [near, far] = [h, 2.0 * h].map(|step| {
        simulation.step(step).unwrap();
        let values = reals(simulation, &unknowns);
        simulation.restore(&here).unwrap();
        values
    });
    let slope = |i: usize| {
        let found = (4.0 * near[i] - far[i] - 3.0 * now[i]) / (2.0 * h);
        Slope { given: given[i], found, second: (far[i] + now[i] - 2.0 * near[i]).abs() / h, size: now[i].abs() }
    };
    (0..given.len()).map(slope).collect()
}
