//! What a coupling has lost in a step, handed to [`coupling`](crate::simulation::coupling).

use crate::dynamics::contacts::RingForces;
use crate::dynamics::parameters::{Excitation, force_slot};
use crate::scene::{Motion, Ring};
use crate::simulation::Simulation;
use crate::simulation::coupling::{Body, Coupling, Step, Triple};
use crate::simulation::interface::RingName;
use crate::simulation::run::state::Foreseen;
use nalgebra::Matrix3;

impl Simulation {
    /// Notes a step of `length` (s) for what the coupling loses.
    #[inline]
    pub(super) fn note_coupling(&mut self, excitation: &Excitation, length: f64) {
        if self.run.state.coupling.is_some() {
            self.note_hosted(excitation, length);
        }
    }

    /// Forgets the last step for that, as a host has moved its rings inside the step.
    pub(super) fn interrupt_coupling(&mut self) {
        if let Some(coupling) = &mut self.run.state.coupling {
            coupling.interrupt();
        }
    }

    /// Notes the rate of a force on a ring that the host has asked for (N/s).
    pub(in crate::simulation) fn note_rate(&mut self, ring: RingName, axis: usize, value: f64) {
        self.ahead.foreseen.rate.get_or_insert([0.0; 10])[force_slot(ring.index(), axis)] = value;
    }

    /// What is known of the coupling to a host that moves a ring.
    #[inline]
    pub fn coupling(&self) -> Option<&Coupling> {
        self.run.state.coupling.as_deref()
    }

    /// Apart, so that a step has nothing of it on its stack.
    #[inline(never)]
    fn note_hosted(&mut self, excitation: &Excitation, length: f64) {
        // What a host reads now: computed once.
        self.evaluate();
        self.refresh_stiffness();
        let axes = self.interface.inputs.axes.min(3);
        let triple = |of: &dyn Fn(usize) -> f64| Triple::from_fn(|axis, _| if axis < axes { of(axis) } else { 0.0 });
        let on_rings = |forces: &RingForces| [0, 1].map(|ring| triple(&|axis| forces[force_slot(ring, axis)]));
        let mean = on_rings(&self.run.state.progress.mean_force);
        let end = on_rings(&self.present.evaluation.forces.rings);
        let stiffness = &self.present.stiffness;
        let bodies = [&self.run.model.shaft, &self.run.model.housing].map(body);
        let Foreseen { force, rate } = &self.ahead.before;
        let Some(coupling) = &mut self.run.state.coupling else { return };
        let step = Step {
            length,
            motion: [0, 1].map(|ring| [0, 1, 2, 3].map(|order| triple(&|axis| excitation.motion[ring][axis].0[order]))),
            start: coupling.forces().unwrap_or(mean),
            mean,
            foretold: force.as_ref().map_or(mean, on_rings),
            rate: rate.as_ref().map_or_else(Default::default, on_rings),
            is_foretold: f64::from(u8::from(force.is_some())),
            has_rate: f64::from(u8::from(rate.is_some())),
            end,
            stiffness: Matrix3::from_fn(|row, column| stiffness[row][column]),
        };
        coupling.note(step, bodies);
    }
}

/// A ring as the error of its place goes on.
fn body(ring: &Ring) -> Body {
    let along = |across: f64, axial: f64| Triple::new(across, across, axial);
    match ring.motion {
        Motion::Host => Body { is_hosted: true, ..Body::default() },
        Motion::Fixed => Body::default(),
        Motion::Internal => Body {
            is_hosted: false,
            mass: ring.mass,
            stiffness: along(ring.stiffness, ring.axial.stiffness),
            damping: along(ring.damping, ring.axial.damping),
        },
    }
}
