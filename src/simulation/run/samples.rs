//! A run as an iterator: outputs at evenly spaced communication points.

use super::life::Simulation;
use crate::simulation::error::SimulationError;

/// Outputs at one communication point.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Time (s).
    pub time: f64,
    /// Values in the order in which the names were given.
    pub values: Vec<f64>,
}

/// Steps a simulation and gives its outputs, the present ones first. It has no end but an error, after which it gives
/// nothing.
#[derive(Debug)]
pub struct Samples<'a> {
    simulation: &'a mut Simulation,
    references: Vec<u32>,
    step: f64,
    begun: bool,
    failed: bool,
}

impl Simulation {
    /// Samples of the outputs of these names, the first one now and then one after each `step` (s).
    ///
    /// ```
    /// use brinell::scene::{Bearing, Scene};
    /// use brinell::simulation::Simulation;
    ///
    /// let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
    /// let scene = Scene::builder(bearing).shaft_speed(157.1).shaft_load([0.0, -1500.0]).build()?;
    /// let mut simulation = Simulation::new(scene, None)?;
    /// simulation.initialize(0.0)?;
    /// let forces = simulation.samples(&["element[1].force.outer"], 1e-4)?.take(11);
    /// let largest = forces.map(|sample| Ok(sample?.values[0])).collect::<Result<Vec<f64>, brinell::Error>>()?;
    /// assert_eq!(largest.len(), 11);
    /// # Ok::<(), brinell::Error>(())
    /// ```
    ///
    /// # Errors
    /// An unknown name.
    pub fn samples(&mut self, names: &[&str], step: f64) -> Result<Samples<'_>, SimulationError> {
        let references = names.iter().map(|name| self.reference(name)).collect::<Result<_, _>>()?;
        Ok(Samples { simulation: self, references, step, begun: false, failed: false })
    }
}

impl Samples<'_> {
    fn sample(&mut self) -> Result<Sample, SimulationError> {
        if self.begun {
            self.simulation.step(self.step)?;
        }
        self.begun = true;
        let mut values = vec![0.0; self.references.len()];
        self.simulation.reals(&self.references, &mut values)?;
        Ok(Sample { time: self.simulation.time(), values })
    }
}

impl Iterator for Samples<'_> {
    type Item = Result<Sample, SimulationError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let sample = self.sample();
        self.failed = sample.is_err();
        Some(sample)
    }
}
