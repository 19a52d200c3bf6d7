//! What outputs follow from is computed when somebody reads one, and each output when it is read itself.
//!
//! The right-hand side at a communication point is evaluated once: for whoever reads there first, or for the step that
//! begins there. Under law `love` both evaluate it, since what was solved last is where the next solution begins.

use super::life::{Simulation, UpToDate};
use super::state::Ended;
use crate::dynamics::parameters::{Excitation, Model};
use crate::numerics::plane::Matrix;
use crate::simulation::error::SimulationError;
use crate::simulation::integration::Evaluation;
use crate::simulation::interface::{Outputs, Quantity, Solution};

/// The bearing at the communication point.
#[derive(Debug, Clone)]
pub(in crate::simulation) struct Present {
    /// What acts from outside.
    pub(super) excitation: Excitation,
    /// The right-hand side under it.
    pub(super) evaluation: Evaluation,
    /// Tangent stiffness of the inner ring, −∂F/∂x with the elements in static balance (N/m).
    stiffness: Matrix,
}

impl Present {
    pub(super) fn new(model: &Model) -> Self {
        Self { excitation: Excitation::default(), evaluation: Evaluation::new(model), stiffness: Matrix::zeros() }
    }
}

impl Simulation {
    /// Evaluates the right-hand side at the communication point, unless it is that of the values set.
    #[inline]
    pub(in crate::simulation) fn refresh(&mut self) -> Result<(), SimulationError> {
        if self.up_to_date >= UpToDate::Forces {
            return Ok(());
        }
        if !self.state.started && self.up_to_date < UpToDate::State {
            self.find_equilibrium()?;
        }
        self.evaluate(self.excitation(false));
        if !self.state.started {
            self.rest();
        }
        self.up_to_date = UpToDate::Forces;
        Ok(())
    }

    /// Derivative and forces at the communication point under `excitation`. They must not depend on what was computed
    /// before, or a restored state would show other roundings.
    pub(super) fn evaluate(&mut self, excitation: Excitation) {
        let Self { model, present, state, .. } = self;
        let Evaluation { derivative, forces } = &mut present.evaluation;
        forces.shortcuts.forget();
        (forces.defect_lookups, forces.unsolved) = (0, None);
        model.derivative(&excitation, 0.0, &state.progress.cells, &state.progress.state, derivative, forces);
        present.excitation = excitation;
    }

    /// Whether a step from here begins with what has been evaluated for outputs.
    pub(super) fn begins_evaluated(&self) -> bool {
        let state = &self.state;
        self.up_to_date >= UpToDate::Forces
            && state.ended == Ended::default()
            && !state.input_rates.as_flattened().iter().any(Option::is_some)
            && self.present.evaluation.forces.unsolved.is_none()
            && !self.model.solves_grids()
    }

    /// The outputs at the communication point, once [`refresh`](Self::refresh) has been there.
    pub(super) fn outputs(&self) -> Outputs<'_> {
        let (Present { excitation, evaluation, .. }, progress) = (&self.present, &self.state.progress);
        let solution = Solution {
            excitation,
            tau: 0.0,
            state: &progress.state,
            derivative: &evaluation.derivative,
            sensor_modes: &progress.sensor_modes,
        };
        Outputs::new(&self.model, solution, &evaluation.forces, self.state.angles())
    }

    /// Value of a real output, once [`refresh`](Self::refresh) has been there and, if it asks for it,
    /// [`refresh_stiffness`](Self::refresh_stiffness).
    #[inline]
    pub(super) fn output(&self, outputs: &Outputs, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::MeanForce(ring, axis) => self.state.progress.mean_force[2 * ring.index() + axis],
            Quantity::Stiffness(row, column) => self.present.stiffness[(row, column)],
            other => outputs.value(other).unwrap_or(f64::NAN),
        }
    }

    /// The start is a static equilibrium: what rounding leaves of accelerations is none.
    fn rest(&mut self) {
        let (layout, derivative) = (&self.model.layout, &mut self.present.evaluation.derivative);
        for start in [layout.shaft, layout.housing].into_iter().flatten() {
            derivative[start + 2..start + 4].fill(0.0);
        }
        for i in layout.sensor_indices() {
            derivative[i + 1] = 0.0;
        }
    }

    /// Computes the tangent stiffness.
    pub(in crate::simulation) fn refresh_stiffness(&mut self) {
        if self.up_to_date < UpToDate::Stiffness {
            let Self { model, present: Present { excitation, evaluation, stiffness }, state, .. } = self;
            let (progress, forces) = (&state.progress, &mut evaluation.forces);
            let now = model.kinematics(excitation, 0.0, &progress.state);
            let paths = forces.contacts.paths(model, &progress.state);
            let jacobian = model.ring_jacobian(paths, &progress.cells, &now, &mut forces.shortcuts);
            *stiffness = -jacobian.fixed_view::<2, 2>(0, 0).into_owned();
            self.up_to_date = UpToDate::Stiffness;
        }
    }
}
