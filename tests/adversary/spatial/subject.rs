//! The simulation of a case in space, driven as the case's host drives it, and what of it is compared.

use crate::case::Motion;
use crate::oracle::spatial::{SpatialCase, SpatialRun};
use crate::subject::read;
use brinell::simulation::{Simulation, SimulationError};

/// What a signal is measured in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    Length,
    Velocity,
    Across,
    Tilt,
    TiltRate,
    Angle,
    /// Angle to a shoulder from the end of an ellipse, which is shorter than its groove's radius.
    Margin,
    Force,
    Moment,
}

impl Kind {
    /// How far before it the force stands that decides on it.
    pub fn behind_its_force(self) -> Option<usize> {
        match self {
            Self::Angle => Some(1),
            Self::Margin => Some(2),
            _ => None,
        }
    }
}

/// Names of what is compared.
pub fn names(case: &SpatialCase) -> Vec<(String, Kind)> {
    let mut names = Vec::new();
    for (which, name) in ["shaft", "housing"].into_iter().enumerate() {
        if case.rings[which].motion == Motion::Internal {
            names.extend(["x", "y", "z"].map(|axis| (format!("{name}.{axis}"), Kind::Length)));
            names.extend(["x", "y", "z"].map(|axis| (format!("{name}.v{axis}"), Kind::Velocity)));
        }
        names.extend(["x", "y", "z"].map(|axis| (format!("{name}.force.{axis}"), Kind::Force)));
        names.extend(["x", "y"].map(|axis| (format!("{name}.moment.{axis}"), Kind::Moment)));
    }
    if case.freedom == 5 && case.rings[0].motion == Motion::Internal {
        names.extend(["x", "y"].map(|axis| (format!("shaft.tilt.{axis}"), Kind::Tilt)));
        names.extend(["x", "y"].map(|axis| (format!("shaft.tilt.v{axis}"), Kind::TiltRate)));
    }
    for j in 1..=case.count {
        names.push((format!("element[{j}].path"), Kind::Length));
        names.push((format!("element[{j}].axial"), Kind::Across));
        for (side, shoulder) in ["inner", "outer"].into_iter().zip(case.shoulders_mm) {
            names.push((format!("element[{j}].force.{side}"), Kind::Force));
            names.push((format!("element[{j}].contact_angle.{side}"), Kind::Angle));
            names.extend(shoulder.map(|_| (format!("element[{j}].shoulder.{side}"), Kind::Margin)));
        }
    }
    names
}

/// The oracle's values, in the order of [`names`].
pub fn values(case: &SpatialCase, run: &SpatialRun<'_>) -> Vec<f64> {
    let mut values = Vec::new();
    for which in 0..2 {
        if case.rings[which].motion == Motion::Internal {
            values.extend(&run.y[10 * which..10 * which + 3]);
            values.extend(&run.y[10 * which + 5..10 * which + 8]);
        }
        values.extend(run.acting.rings[which]);
    }
    if case.freedom == 5 && case.rings[0].motion == Motion::Internal {
        values.extend(&run.y[3..5]);
        values.extend(&run.y[8..10]);
    }
    for ball in &run.acting.balls {
        values.extend(ball.place);
        for (side, touch) in ball.contacts.iter().enumerate() {
            values.extend([touch.force, touch.angle]);
            values.extend(run.bearing.margin(side, touch));
        }
    }
    values
}

/// The simulation, with the references of what is compared.
pub struct Subject {
    simulation: Simulation,
    references: Vec<u32>,
}

impl Subject {
    pub fn new(case: &SpatialCase) -> Result<Self, String> {
        let scene = brinell_scene_file::from_toml(&case.toml()).map_err(|error| error.to_string())?;
        let profiles = case.profiles();
        let simulation =
            Simulation::new(scene, profiles.iter().map(String::as_str)).map_err(|error| error.to_string())?;
        let references = names(case).iter().map(|(name, _)| simulation.reference(name)).collect::<Result<_, _>>();
        Ok(Self { references: references.map_err(|error| error.to_string())?, simulation })
    }

    fn say(&mut self, case: &SpatialCase, step: usize, rates: bool) -> Result<(), SimulationError> {
        let Some(host) = &case.steps[step].host else { return Ok(()) };
        let mut all = vec![("shaft.speed".to_owned(), host.speeds[0][0], host.speeds[0][1])];
        if case.housing_hz.is_some() {
            all.push(("housing.speed".to_owned(), host.speeds[1][0], host.speeds[1][1]));
        }
        for (which, name) in ["shaft", "housing"].into_iter().enumerate() {
            let motion = case.rings[which].motion;
            let free = if case.freedom == 5 && (which == 0 || motion == Motion::Host) { 5 } else { 3 };
            match motion {
                Motion::Internal => {}
                Motion::Fixed => continue,
                Motion::Host => {
                    let places = ["#x", "#y", "#z", "tilt.#x", "tilt.#y"];
                    for (place, moves) in places.into_iter().zip(host.rings[which]).take(free) {
                        for (order, value) in ["", "v", "a"].into_iter().zip(moves) {
                            all.push((format!("{name}.{}", place.replace('#', order)), value, 0.0));
                        }
                    }
                    continue;
                }
            }
            let inputs = ["load.x", "load.y", "load.z", "load_moment.x", "load_moment.y"];
            for (input, [value, rate, _]) in inputs.into_iter().zip(host.rings[which]).take(free) {
                all.push((format!("{name}.{input}"), value, rate));
            }
        }
        for (name, value, rate) in all {
            let reference = self.simulation.reference(&name)?;
            self.simulation.set_reals(&[reference], &[value])?;
            if rates && rate != 0.0 {
                self.simulation.set_input_derivatives(&[reference], &[1], &[rate])?;
            }
        }
        Ok(())
    }

    pub fn start(&mut self, case: &SpatialCase) -> Result<Vec<f64>, SimulationError> {
        self.say(case, 0, false)?;
        self.simulation.initialize(0.0)?;
        read(&mut self.simulation, &self.references)
    }

    pub fn step(&mut self, case: &SpatialCase, step: usize) -> Result<Vec<f64>, SimulationError> {
        self.say(case, step, true)?;
        self.simulation.step(case.steps[step].length)?;
        read(&mut self.simulation, &self.references)
    }
}
