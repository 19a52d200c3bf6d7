//! What acts on the bearing from outside: from input variables and their derivatives to polynomials of time, and back.

use super::Simulation;
use super::setup;
use crate::dynamics::drive::{Drive, Quadratic};

impl Simulation {
    /// Where every external influence is during the next step.
    pub(super) fn drive(&self, stepping: bool) -> Drive {
        let rates = |index: usize| if stepping { self.input_rates[index] } else { [0.0; 2] };
        let value = |index: Option<usize>| index.map_or(0.0, |i| self.values[i]);
        let load = |index: Option<usize>| {
            index.map_or(Quadratic::default(), |i| Quadratic([self.values[i], rates(i)[0], rates(i)[1]]))
        };
        let place = |ring: &setup::RingInputs, axis: usize| {
            let Some(position) = ring.position[axis] else { return Quadratic::default() };
            let given = rates(position);
            if given != [0.0; 2] {
                return Quadratic([self.values[position], given[0], given[1]]);
            }
            let acceleration = ring.velocity[axis].map_or(0.0, |i| rates(i)[0]) + value(ring.acceleration[axis]);
            Quadratic([self.values[position], value(ring.velocity[axis]), acceleration])
        };
        let speed = self.inputs.speed;
        Drive {
            cage_start: self.state.cage.rest,
            cage: Quadratic([
                0.0,
                self.model.cage_ratio * value(speed),
                self.model.cage_ratio * speed.map_or(0.0, |i| rates(i)[0]),
            ]),
            shaft: [place(&self.inputs.shaft, 0), place(&self.inputs.shaft, 1)],
            housing: [place(&self.inputs.housing, 0), place(&self.inputs.housing, 1)],
            shaft_load: [load(self.inputs.shaft.load[0]), load(self.inputs.shaft.load[1])],
            housing_load: [load(self.inputs.housing.load[0]), load(self.inputs.housing.load[1])],
        }
    }

    /// After a step the inputs stand where they were extrapolated to, so that outputs belong to the end of the step
    /// until the host sets them anew.
    pub(super) fn follow_prescribed_motion(&mut self, drive: &Drive, step: f64) {
        let rings = [
            (self.inputs.shaft, drive.shaft, drive.shaft_load),
            (self.inputs.housing, drive.housing, drive.housing_load),
        ];
        for (ring, place, load) in rings {
            for axis in 0..2 {
                let ends = [
                    (ring.position[axis], place[axis].at(step)),
                    (ring.velocity[axis], place[axis].rate_at(step)),
                    (ring.load[axis], load[axis].at(step)),
                ];
                for (index, value) in ends {
                    if let Some(i) = index {
                        self.values[i] = value;
                    }
                }
            }
        }
        if let Some(i) = self.inputs.speed {
            self.values[i] += self.input_rates[i][0] * step;
        }
        for rates in &mut self.input_rates {
            *rates = [0.0; 2];
        }
    }
}
