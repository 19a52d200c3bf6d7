//! What a host gives at a communication point: kept for the look ahead, and turned where a step is repeated.
//!
//! *The last steps.* From the velocities that the host gave follow the mean accelerations between them, whatever it
//! gives as acceleration and however late that is.
//!
//! *Repeated steps.* A host that iterates takes a step, puts the state back, and takes the step anew with what the
//! other units have come to meanwhile: values of the step's end. With `host.repeated_inputs = end` they are taken for
//! that. The inputs keep what was given when the step was taken first, and go from there to the values of the end. With
//! d = x₁ − x₀ − v₀h and w = v₁ − v₀ a ring goes as the cubic
//! ```text
//! a = 6 d/h² − 2 w/h      a' = 6 w/h² − 12 d/h³
//! ```
//! or, where the velocity is as it was and so was not given anew, as the parabola a = 2 d/h². Loads and speeds go
//! straight. Derivatives that the host sets for a repeated step do not act: its ends say how it goes.

use crate::dynamics::parameters::Excitation;
use crate::scene::RepeatedInputs;
use crate::simulation::Simulation;
use crate::simulation::interface::value_access::SECOND;
use crate::simulation::run::state::Foreseen;

impl Simulation {
    /// Takes what the host has set for a step of `step` (s): as it is, or for the step's end.
    #[inline]
    pub(super) fn take_inputs(&mut self, step: f64) {
        let Some(index) = self.interface.inputs.repeated else { return };
        if self.run.state.integers[index] == RepeatedInputs::End.number() && self.run.state.started && step > 0.0 {
            self.take_first_or_end(step);
        }
    }

    fn take_first_or_end(&mut self, step: f64) {
        let (count, state) = (self.interface.inputs.count, &mut self.run.state);
        if !state.first.are_of(state.time) {
            (state.first.given, state.first.time) = (true, state.time);
            state.first.values.copy_from_slice(&state.reals[..count]);
            return;
        }
        self.wiring.note(SECOND);
        state.input_rates.fill([None; 2]);
        let (first, end, rates) = (&state.first.values, &mut state.reals, &mut state.input_rates);
        for ring in self.interface.inputs.rings() {
            for index in ring.load.into_iter().flatten() {
                rates[index][0] = Some((end[index] - first[index]) / step);
            }
            for axis in 0..self.interface.inputs.axes {
                if let (Some(x), Some(v), Some(a)) = (ring.position[axis], ring.velocity[axis], ring.acceleration[axis])
                {
                    let d = end[x] - first[x] - first[v] * step;
                    let w = end[v] - first[v];
                    let square = step * step;
                    let [second, third] = if w == 0.0 {
                        [2.0 * d / square, 0.0]
                    } else {
                        [6.0 * d / square - 2.0 * w / step, 6.0 * w / square - 12.0 * d / (square * step)]
                    };
                    end[a] = second;
                    rates[a][0] = Some(third);
                }
            }
        }
        for index in self.interface.inputs.speeds.into_iter().flatten() {
            rates[index][0] = Some((end[index] - first[index]) / step);
        }
        let accelerations = self.interface.inputs.rings().map(|ring| ring.acceleration);
        for index in (0..count).filter(|&index| !accelerations.as_flattened().contains(&Some(index))) {
            end[index] = first[index];
        }
    }

    /// Notes a step of `step` (s) that has been taken, with the inputs where it has brought them.
    #[inline]
    pub(super) fn note_step(&mut self, excitation: &Excitation, step: f64) {
        self.ahead.foreseen = Foreseen::default();
        let (count, history) = (self.interface.inputs.count, &mut self.run.state.history);
        let axes = self.interface.inputs.axes;
        let velocity = |ring: usize, axis: usize| excitation.motion[ring][axis].0[1];
        if history.step > 0.0 {
            history.earlier = [history.step, history.earlier[0]];
            history.means[1] = history.means[0];
            for (ring, mean) in history.means[0].iter_mut().enumerate() {
                for (axis, mean) in mean.iter_mut().enumerate().take(axes) {
                    *mean = (velocity(ring, axis) - history.velocities[ring][axis]) / history.step;
                }
            }
        }
        history.step = step;
        for (ring, velocities) in history.velocities.iter_mut().enumerate() {
            for (axis, known) in velocities.iter_mut().enumerate().take(axes) {
                *known = velocity(ring, axis);
            }
        }
        history.arrived.copy_from_slice(&self.run.state.reals[..count]);
    }
}
