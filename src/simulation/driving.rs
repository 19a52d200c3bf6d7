//! What acts on the bearing from outside: from input variables and their derivatives to polynomials of time, and back.

use super::Simulation;
use super::setup::{Inputs, RingInputs};
use super::table::Quantity;
use crate::dynamics::drive::{Cubic, Drive, Quadratic};

/// Highest order of the derivatives by time that act where a quantity is an input, and how its description says so.
/// What would make a higher polynomial than [`Drive`] has is refused: the cage's angle is a quadratic, so that the
/// instants at which elements pass knots are roots of one.
pub(super) fn derivatives(input: Quantity) -> (i32, &'static str) {
    match input {
        Quantity::Position(..) => (2, "derivatives of orders 1 and 2 act, in place of velocity and acceleration"),
        Quantity::Velocity(..) => (2, "derivatives of orders 1 and 2 act, in place of acceleration and its derivative"),
        Quantity::Load(..) => (2, "derivatives of orders 1 and 2 act"),
        _ => (1, "derivative of order 1 acts"),
    }
}

/// Accelerations at the end of the last step that derivatives of inputs gave and no input says: outputs at that instant
/// follow from them. Gone once the host sets an input.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Ended {
    /// Of the cage [rad/s²].
    pub(super) cage: f64,
    /// Of a prescribed outer ring [m/s²].
    pub(super) housing: [f64; 2],
}

impl Simulation {
    /// Where every external influence is during the next step.
    ///
    /// Each coefficient of a ring's motion comes from the derivative of the lowest variable that gives it: the velocity
    /// from the position's, or else from the input; the acceleration from the position's, the velocity's, or the input.
    pub(super) fn drive(&self, stepping: bool) -> Drive {
        let value = |index: Option<usize>| index.map_or(0.0, |i| self.values[i]);
        let given = |index: Option<usize>, order: usize| {
            index.filter(|_| stepping).and_then(|i| self.input_rates[i][order - 1])
        };
        let rate = |index: Option<usize>, order: usize| given(index, order).unwrap_or(0.0);
        let load = |index: Option<usize>| Quadratic([value(index), rate(index, 1), rate(index, 2)]);
        let place = |ring: &RingInputs, axis: usize| {
            let (x, v, a) = (ring.position[axis], ring.velocity[axis], ring.acceleration[axis]);
            Cubic([
                value(x),
                given(x, 1).unwrap_or(value(v)),
                given(x, 2).or(given(v, 1)).unwrap_or(value(a)),
                given(v, 2).unwrap_or(rate(a, 1)),
            ])
        };
        let Inputs { speed, shaft, housing, .. } = self.inputs;
        let cage_ratio = self.model.cage_ratio;
        let mut drive = Drive {
            cage_start: self.state.cage.rest,
            cage: Quadratic([0.0, cage_ratio * value(speed), cage_ratio * rate(speed, 1)]),
            shaft: [place(&shaft, 0), place(&shaft, 1)],
            housing: [place(&housing, 0), place(&housing, 1)],
            shaft_load: shaft.load.map(load),
            housing_load: housing.load.map(load),
        };
        if !stepping {
            drive.cage.0[2] += self.state.ended.cage;
            for (place, acceleration) in drive.housing.iter_mut().zip(self.state.ended.housing) {
                place.0[2] += acceleration;
            }
        }
        drive
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
        let Inputs { speed, shaft, housing, .. } = self.inputs;
        for i in shaft.acceleration.into_iter().chain(housing.acceleration).chain([speed]).flatten() {
            self.values[i] += self.input_rates[i][0].unwrap_or(0.0) * step;
        }
        let given = self.input_rates.as_flattened().iter().any(Option::is_some);
        self.input_rates.fill([None; 2]);
        self.state.ended = Ended::default();
        if given {
            let now = self.drive(false);
            let left = |axis: usize| drive.housing[axis].second_at(step) - now.housing[axis].second_at(0.0);
            self.state.ended = Ended { cage: drive.cage.0[2] - now.cage.0[2], housing: [left(0), left(1)] };
        }
    }
}
