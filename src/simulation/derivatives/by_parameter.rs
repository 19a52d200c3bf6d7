//! Derivatives of outputs at the start by parameters: differences of starts, since parameters shape the model itself,
//! down to radii and contact laws.

use crate::contact::law::Elasticity;
use crate::simulation::interface::Parameter;
use crate::simulation::interface::table::Kind;
use crate::simulation::run::UpToDate;
use crate::simulation::{Simulation, SimulationError};

/// How far a parameter is moved for the difference of two starts, a clearance by `approach` (m). Forces of a start are
/// known to 1e-12 of the load, and this moves them by 1e-8 to 1e-3 of it; on the way to a defect's edge it is 20 nm. A
/// damping or a ring on a soft spring feels its own share.
fn difference(parameter: Parameter, at: f64, nominal: f64, approach: f64) -> f64 {
    match parameter {
        Parameter::InternalClearance => 2.0 * approach,
        Parameter::SpallLength(_) | Parameter::SpallDepth(_) => approach,
        Parameter::FilmViscosity => 1e-3 * at,
        // What turns a groove's centre by a micrometre or so over the fraction of a millimetre.
        Parameter::ContactAngle => 1e-5,
        // A force changes by χ δ̇ = 1e-4 χ or by 1.5 τ δ̇/δ = 30/s τ of itself.
        Parameter::ContactDamping if at > 0.0 => (0.1 * at).min(1e-2 * nominal),
        Parameter::ContactDamping => 1e-2 * nominal,
        Parameter::CageSlip | Parameter::SpinSlip => 1e-3,
        Parameter::RingStiffness(_) | Parameter::AxialStiffness(_) if at > 0.0 => (1e-2 * at).min(1e3),
        Parameter::RingStiffness(_) | Parameter::AxialStiffness(_) => 1e3,
        Parameter::TiltStiffness | Parameter::Preload(_) => 1e-2,
        _ => 1e-6,
    }
}

/// Steps at which to look, and shares of the changes until there in the derivative times a step: on both sides, or
/// where a limit is nearer than a step all on the other. The error is of the step's second order.
fn quotient(at: f64, step: f64, [min, max]: [Option<f64>; 2]) -> [(f64, f64); 2] {
    if min.is_some_and(|min| at - step < min) {
        [(1.0, 2.0), (2.0, -0.5)]
    } else if max.is_some_and(|max| at + step > max) {
        [(-1.0, -2.0), (-2.0, 0.5)]
    } else {
        [(-1.0, -0.5), (1.0, 0.5)]
    }
}

impl Simulation {
    /// How far (m) contacts inside are moved for a difference: a hundredth of what the least is pressed in by, or 1e-4
    /// of the most, beside which it counts for nothing. Positions are known to 1e-19 m, and a force hardly changes if a
    /// free ring follows. Of crowned rollers, whose stiffness has a corner for each lamina, it is 1e-4.
    fn share_of_approaches(&self) -> f64 {
        let (approaches, law) =
            (&self.present.evaluation.forces.contacts.inner_approach, &self.run.model.inner.contact.law);
        let pressed = approaches.iter().filter(|approach| **approach > 0.0);
        let [least, most] = pressed.fold([f64::MAX, 0.0], |[least, most], now| [now.min(least), now.max(most)]);
        let share = if matches!(law.elasticity, Elasticity::Crowned(_)) { 1e-4 } else { 1e-2 };
        if most > 0.0 { (share * least).max(1e-4 * most).clamp(1e-12, 1e-8) } else { 1e-9 }
    }

    /// Adds the derivative of `unknowns` at the start by a parameter, `weight` times, to `values`.
    pub(super) fn along_parameter(
        &self,
        unknowns: &[u32],
        (known, parameter): (u32, Parameter),
        weight: f64,
        values: &mut [f64],
    ) -> Result<(), SimulationError> {
        let Kind::Real { min, max, nominal, .. } = self.variable(known)?.kind else { return Ok(()) };
        // A map is exact to some 1e-3, and takes seconds for each size.
        let sizes = matches!(parameter, Parameter::SpallLength(_) | Parameter::SpallDepth(_));
        if sizes && !self.run.model.rolls_rigidly() {
            return Err(SimulationError::NoDerivativeBySize(self.variable(known)?.name.clone()));
        }
        let (mut start, mut here) = (self.clone(), vec![0.0; unknowns.len()]);
        start.exchange_reals(unknowns, &mut here)?;
        let at = self.run.state.reals[known as usize];
        let step = difference(parameter, at, nominal, start.share_of_approaches());
        let mut there = here.clone();
        // Half the step and the step, of whose errors the largest terms cancel.
        let sides = quotient(at, step, [min, max]);
        let halves = sides.map(|(steps, share)| (0.5 * steps, 8.0 / 3.0 * share));
        let wholes = sides.map(|(steps, share)| (steps, -1.0 / 3.0 * share));
        for (steps, share) in halves.into_iter().chain(wholes) {
            start.run.state.reals[known as usize] = at + steps * step;
            start.invalidate(UpToDate::Nothing);
            // A start beside one that exists: where there is none, the limit of what exists has no derivative.
            start.exchange_reals(unknowns, &mut there).map_err(|_| SimulationError::NoDerivative)?;
            for ((value, there), here) in values.iter_mut().zip(&there).zip(&here) {
                *value += weight * share / step * (there - here);
            }
        }
        Ok(())
    }
}
