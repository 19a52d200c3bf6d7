//! What outputs follow from is computed when somebody reads one, and each output when it is read itself.
//!
//! The right-hand side at a communication point is evaluated once: for whoever reads there first, or for the step that
//! begins there. The last stage of the step before is another evaluation: time counts from the communication point, so
//! that its last bits differ, and inputs may have changed. Under law `love` both evaluate it, since what was solved
//! last is where the next solution begins.

use super::life::{Simulation, UpToDate};
use super::state::Ended;
use crate::dynamics::parameters::force_slot;
use crate::simulation::error::SimulationError;
use crate::simulation::interface::{Outputs, Quantity, of_first_order, suggested_step};

impl Simulation {
    /// Evaluates the right-hand side at the communication point, unless it is that of the values set.
    #[inline]
    pub(in crate::simulation) fn refresh(&mut self) -> Result<(), SimulationError> {
        if self.up_to_date >= UpToDate::Forces {
            return Ok(());
        }
        let started = self.run.state.started;
        if !started && self.up_to_date < UpToDate::State {
            self.find_equilibrium()?;
        }
        self.evaluate();
        Ok(())
    }

    /// Evaluates it, unless it is that of the values set; of what has an equilibrium or has begun.
    pub(super) fn evaluate(&mut self) {
        if self.up_to_date >= UpToDate::Forces {
            return;
        }
        self.present.evaluate(&self.run, self.excitation(false));
        if !self.run.state.started {
            self.present.rest(&self.run.model.layout);
        }
        self.up_to_date = UpToDate::Forces;
    }

    /// Computes the tangent stiffness, once [`refresh`](Self::refresh) has been there.
    pub(super) fn refresh_stiffness(&mut self) {
        if self.up_to_date < UpToDate::Stiffness {
            self.present.evaluate_stiffness(&self.run);
            self.up_to_date = UpToDate::Stiffness;
        }
    }

    /// Whether a step from here begins with what has been evaluated for outputs.
    pub(super) fn begins_evaluated(&self) -> bool {
        let state = &self.run.state;
        self.up_to_date >= UpToDate::Forces
            && state.ended == Ended::default()
            && !state.input_rates.as_flattened().iter().any(Option::is_some)
            && self.present.evaluation.forces.unsolved.is_none()
            && !self.run.model.solves_grids()
    }

    /// The step that a host wired as this one should take (s). Apart, so that other values do not pay for it.
    #[cold]
    #[inline(never)]
    fn step_by_wiring(&self) -> f64 {
        let coupling = self.run.state.coupling.as_deref();
        let masses = [0, 1].map(|ring| coupling.and_then(|coupling| coupling.mass(ring)));
        let step = suggested_step(&self.run.model, &self.present.stiffness, masses, self.interface.least_stiffness);
        let first = coupling.and_then(|coupling| coupling.is_of_first_order()).unwrap_or_else(|| self.holds_force());
        if first { of_first_order(step) } else { step }
    }

    /// Error of the coupling as it is, and at most so far.
    #[cold]
    #[inline(never)]
    fn coupling_errors(&self) -> [f64; 2] {
        self.run.state.coupling.as_ref().map_or([0.0; 2], |coupling| coupling.errors())
    }

    /// Value of a real output.
    #[inline]
    pub(super) fn output(&self, outputs: &Outputs, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::MeanForce(ring, axis) => self.run.state.progress.mean_force[force_slot(ring.index(), axis)],
            Quantity::NextMeanForce(ring, axis) => {
                let force = self.ahead.foreseen.force.as_ref().unwrap_or(&self.run.state.progress.mean_force);
                force[force_slot(ring.index(), axis)]
            }
            Quantity::Stiffness(row, column) => self.present.stiffness[row][column],
            Quantity::SuggestedStep => self.step_by_wiring(),
            Quantity::CouplingError => self.coupling_errors()[0],
            Quantity::LargestCouplingError => self.coupling_errors()[1],
            other => outputs.value(other).unwrap_or(f64::NAN),
        }
    }
}
