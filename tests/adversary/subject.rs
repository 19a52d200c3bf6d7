//! The simulation of a case, driven as the case's host drives it.

use crate::case::{Case, Motion};
use crate::draw::Draw;
use crate::oracle::signals::signals;
use brinell::scene::Scene;
use brinell::simulation::interface::table::{Causality, Kind};
use brinell::simulation::{Simulation, SimulationError};
use brinell_scene_file::SceneFileError;
use std::fmt;

/// Why there is no run.
#[derive(Clone, PartialEq, thiserror::Error)]
pub enum Refusal {
    #[error(transparent)]
    Scene(#[from] SceneFileError),
    #[error(transparent)]
    Simulation(#[from] SimulationError),
}

impl fmt::Debug for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => f.debug_tuple("Scene").field(error).finish(),
            Self::Simulation(error) => error.fmt(f),
        }
    }
}

pub struct Subject {
    pub simulation: Simulation,
    references: Vec<u32>,
    /// Time at which it begins (s).
    pub begin: f64,
    /// Inputs are set one by one, in an order drawn from here.
    pub shuffle: Option<Draw>,
    /// Each step is taken in another way first and taken back.
    pub rollback: bool,
}

/// Name, and the real or whole number that it has.
pub type Parameter = (String, Result<f64, i32>);

/// Values of variables.
pub fn read(simulation: &mut Simulation, references: &[u32]) -> Result<Vec<f64>, SimulationError> {
    let mut values = vec![0.0; references.len()];
    simulation.reals(references, &mut values)?;
    Ok(values)
}

impl Subject {
    pub fn new(case: &Case) -> Result<Self, Refusal> {
        let scene = brinell_scene_file::from_toml(&case.toml())?;
        Ok(Self::of(scene, case)?)
    }

    fn of(scene: Scene, case: &Case) -> Result<Self, SimulationError> {
        let profiles = case.profiles();
        let mut simulation = Simulation::new(scene, profiles.iter().map(String::as_str))?;
        if case.spin_slip != 0.0 {
            let spin_slip = simulation.reference("element.spin_slip")?;
            simulation.set_reals(&[spin_slip], &[case.spin_slip])?;
        }
        let references = signals(case).iter().map(|(name, _)| simulation.reference(name)).collect::<Result<_, _>>()?;
        Ok(Self { simulation, references, begin: 0.0, shuffle: None, rollback: false })
    }

    /// The signals, in the order of [`signals`].
    pub fn read(&mut self) -> Result<Vec<f64>, SimulationError> {
        read(&mut self.simulation, &self.references)
    }

    /// The signals at the start.
    pub fn start(&mut self, case: &Case) -> Result<Vec<f64>, SimulationError> {
        self.set_inputs(case, 0, false)?;
        self.simulation.initialize(self.begin)?;
        self.read()
    }

    /// The signals after a step.
    pub fn step(&mut self, case: &Case, i: usize) -> Result<Vec<f64>, SimulationError> {
        self.set_inputs(case, i, true)?;
        let length = case.steps[i].length;
        if self.rollback {
            let state = self.simulation.save();
            // Whatever comes of it.
            let _ = self.simulation.step(0.37 * length).and_then(|()| self.read().map(|_| ()));
            self.simulation.restore(&state)?;
        }
        self.simulation.step(length)?;
        self.read()
    }

    /// Sets what the host sets before a step; derivatives only once the run has begun.
    fn set_inputs(&mut self, case: &Case, step: usize, derivatives: bool) -> Result<(), SimulationError> {
        let Some(host) = &case.steps[step].host else { return Ok(()) };
        let reference = |name: &str| self.simulation.reference(name);
        let (mut values, mut rates) = (Vec::new(), Vec::new());
        let turning = ["shaft.speed", "housing.speed"].into_iter().zip(host.speeds);
        for (name, [value, slope]) in turning.take(1 + usize::from(case.housing_hz.is_some())) {
            let speed = reference(name)?;
            values.push((speed, value));
            rates.push((speed, 1, slope));
        }
        for (which, name) in ["shaft", "housing"].into_iter().enumerate() {
            for (a, axis) in ["x", "y"].into_iter().enumerate() {
                let [value, first, second] = host.rings[which][a];
                match case.rings[which].motion {
                    Motion::Internal => {
                        let load = reference(&format!("{name}.load.{axis}"))?;
                        values.push((load, value));
                        rates.extend([(load, 1, first), (load, 2, second)]);
                    }
                    Motion::Host => {
                        for (prefix, value) in [("", value), ("v", first), ("a", second)] {
                            values.push((reference(&format!("{name}.{prefix}{axis}"))?, value));
                        }
                    }
                    Motion::Fixed => {}
                }
            }
        }
        rates.retain(|rate| derivatives && rate.2 != 0.0);
        if let Some(draw) = &mut self.shuffle {
            while !values.is_empty() {
                let (reference, value) = values.swap_remove(draw.below(values.len()));
                self.simulation.set_reals(&[reference], &[value])?;
            }
            while !rates.is_empty() {
                let (reference, order, rate) = rates.swap_remove(draw.below(rates.len()));
                self.simulation.set_input_derivatives(&[reference], &[order], &[rate])?;
            }
            return Ok(());
        }
        let (references, values): (Vec<u32>, Vec<f64>) = values.into_iter().unzip();
        self.simulation.set_reals(&references, &values)?;
        let references: Vec<u32> = rates.iter().map(|rate| rate.0).collect();
        let orders: Vec<i32> = rates.iter().map(|rate| rate.1).collect();
        let rates: Vec<f64> = rates.iter().map(|rate| rate.2).collect();
        self.simulation.set_input_derivatives(&references, &orders, &rates)?;
        Ok(())
    }

    /// All numbers among the parameters.
    pub fn parameters(&mut self) -> Vec<Parameter> {
        let table: Vec<_> = self.simulation.table().to_vec();
        let mut found = Vec::new();
        for variable in table.iter().filter(|variable| variable.causality == Causality::Parameter) {
            let (mut real, mut whole) = ([0.0], [0]);
            match variable.kind {
                Kind::Real { .. } => self.simulation.reals(&[variable.reference], &mut real).unwrap(),
                Kind::Enumeration { .. } => self.simulation.integers(&[variable.reference], &mut whole).unwrap(),
                _ => continue,
            }
            let value = if matches!(variable.kind, Kind::Real { .. }) { Ok(real[0]) } else { Err(whole[0]) };
            found.push((variable.name.clone(), value));
        }
        found
    }

    pub fn set_parameters(&mut self, parameters: &[Parameter]) {
        for (name, value) in parameters {
            let reference = self.simulation.reference(name).unwrap();
            match value {
                Ok(real) => self.simulation.set_reals(&[reference], &[*real]).unwrap(),
                Err(whole) => self.simulation.set_integers(&[reference], &[*whole]).unwrap(),
            }
        }
    }
}
