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

impl Simulation {
    /// Samples of the outputs of these names, the first one now and then one after each `step` (s). They have no end
    /// but an error, after which there is nothing.
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
    pub fn samples<'a>(
        &'a mut self,
        names: &[&str],
        step: f64,
    ) -> Result<impl Iterator<Item = Result<Sample, SimulationError>> + use<'a>, SimulationError> {
        let references: Vec<u32> = names.iter().map(|name| self.reference(name)).collect::<Result<_, _>>()?;
        let (mut begun, mut failed) = (false, false);
        Ok(std::iter::from_fn(move || {
            if failed {
                return None;
            }
            let mut sample = || {
                if begun {
                    self.step(step)?;
                }
                begun = true;
                let mut values = vec![0.0; references.len()];
                self.reals(&references, &mut values)?;
                Ok(Sample { time: self.time(), values })
            };
            let sample = sample();
            failed = sample.is_err();
            Some(sample)
        }))
    }
}
