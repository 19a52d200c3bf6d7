//! The force to hold over the next communication step, by a step ahead that is taken back.
//!
//! A host that steps all units in parallel and holds inputs gives a ring one force for the whole of a step, of length
//! h. What brings the ring to the right velocity is the mean of the force over that step; it is not known yet, but the
//! bearing can take the step itself, along the way on which the ring is going, and see. Elements, edges of a defect,
//! contact changes, dampers and a housing of its own are in it as in any step.
//!
//! *The position.* A force F that grows by F' brings a ring of mass m to ½ F h²/m + ⅙ F' h³/m, its mean held brings it
//! to ½ (F + ½ F' h) h²/m, which is F' h³/12m too far. Step after step that is a velocity of h² F'/12m, as if h² F''/12
//! were pushed too much. So the force to hold is
//! ```text
//! mean − h² F''/12,   F'' = −K a
//! ```
//! with the tangent stiffness K and the acceleration a of the rings against each other.
//!
//! *The way.* Such a host hands on the acceleration that belonged to the force held before: the FMU has moved the ring
//! by what is one step late. The velocities v that it gives are exact, and so are the mean accelerations between them.
//! They are continued to the last step, whose end is put right by what its own mean acceleration differs, and to the
//! next:
//! ```text
//! a(t) by the line through the means of the last two steps that are known
//! ```
//! Before three steps are known the ring goes on as the inputs say; before the first one the force is that of the
//! start.

use super::life::{Simulation, UpToDate};
use super::state::{Ended, Foreseen, History};
use crate::dynamics::contacts::RingForces;
use crate::dynamics::parameters::force_slot;
use crate::simulation::error::SimulationError;
use crate::simulation::interface::{Inputs, Quantity, RingName};

/// Steps that the line through two means is followed beyond the later one at most, in lengths of those; of equal steps
/// it is followed for 1 and 2.
const REACH: f64 = 3.0;

impl Simulation {
    /// Finds the forces to hold over a next step of the length of the last, unless they are known.
    pub(super) fn look_ahead(&mut self) -> Result<(), SimulationError> {
        if self.ahead.foreseen.force.is_some() || !self.run.state.started || self.run.state.history.step == 0.0 {
            return Ok(());
        }
        let foreseen = self.ahead.foreseen;
        let kept = match self.ahead.state.take() {
            Some(mut kept) => {
                kept.copy_from(&self.run.state);
                kept
            }
            None => Box::new(self.run.state.clone()),
        };
        let recorder = self.run.recorder.take();
        let found = self.step_ahead(&kept.history);
        self.run.recorder = recorder;
        self.run.state.copy_from(&kept);
        self.ahead.state = Some(kept);
        self.invalidate(UpToDate::State);
        self.ahead.foreseen = Foreseen { force: Some(found?), ..foreseen };
        Ok(())
    }

    /// The step (s) that a host which moves a ring should take, `solver.suggested_step`; `None` where it moves none.
    pub fn suggested_step(&mut self) -> Result<Option<f64>, SimulationError> {
        if !self.interface.quantities.contains(&Quantity::SuggestedStep) {
            return Ok(None);
        }
        self.refresh()?;
        self.refresh_stiffness();
        Ok(Some(self.value_of(Quantity::SuggestedStep)))
    }

    /// Takes the step.
    fn step_ahead(&mut self, history: &History) -> Result<RingForces, SimulationError> {
        let state = &mut self.run.state;
        state.reals[..self.interface.inputs.count].copy_from_slice(&history.arrived);
        state.input_rates.fill([None; 2]);
        state.ended = Ended::default();
        carry_on(history, &self.interface.inputs, &mut state.reals);
        self.invalidate(UpToDate::State);
        self.refresh()?;
        self.refresh_stiffness();
        let axes = self.interface.inputs.axes;
        let [shaft, housing] = [RingName::Shaft, RingName::Housing]
            .map(|ring| nalgebra::Vector5::from_fn(|axis, _| self.value_of(Quantity::Acceleration(ring, axis))));
        let stiffness = nalgebra::Matrix5::from_fn(|row, column| self.value_of(Quantity::Stiffness(row, column)));
        let late = stiffness * (shaft - housing) * (history.step * history.step / 12.0);
        self.advance(history.step)?;
        let mut force = self.run.state.progress.mean_force;
        for axis in 0..axes {
            force[force_slot(0, axis)] += late[axis];
            force[force_slot(1, axis)] -= late[axis];
        }
        Ok(force)
    }

    /// Value of a quantity as it was computed last; 0 for what this scene does not have.
    fn value_of(&self, wanted: Quantity) -> f64 {
        let is_there = self.interface.quantities.contains(&wanted);
        if is_there { self.output(&self.present.outputs(&self.run), wanted) } else { 0.0 }
    }
}

/// Puts the inputs of hosted rings where the last step ends and on their way through the next.
fn carry_on(history: &History, inputs: &Inputs, reals: &mut [f64]) {
    let History { step, earlier: [later, first], .. } = *history;
    if first == 0.0 {
        return;
    }
    // In means of the steps, whose middles are so far apart.
    let [last, next] = [later + step, later + 3.0 * step].map(|reach| (reach / (later + first)).min(REACH));
    for (ring, of) in inputs.rings().into_iter().enumerate() {
        for axis in 0..inputs.axes {
            let (Some(x), Some(v), Some(a)) = (of.position[axis], of.velocity[axis], of.acceleration[axis]) else {
                continue;
            };
            let [known, before] = [0, 1].map(|which| history.means[which][ring][axis]);
            let line = |reach: f64| known + reach * (known - before);
            let taken = (reals[v] - history.velocities[ring][axis]) / step;
            let more = line(last) - taken;
            reals[x] += 0.5 * more * step * step;
            reals[v] += more * step;
            reals[a] = line(next);
        }
    }
}
