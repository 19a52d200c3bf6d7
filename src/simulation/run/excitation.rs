//! What acts on the bearing from outside: from input variables and their derivatives to polynomials of time, and back.

use super::state::{Ended, State};
use crate::dynamics::parameters::{Cubic, Excitation, Quadratic, Turning};
use crate::geometry::kinematics::Ratios;
use crate::simulation::interface::{Inputs, RingInputs};

/// Where every external influence is from a communication point on. Derivatives of inputs act where the bearing is
/// `stepping`.
///
/// Each coefficient of a ring's motion comes from the derivative of the lowest variable that gives it: the velocity
/// from the position's, or else from the input; the acceleration from the position's, the velocity's, or the input.
pub(in crate::simulation) fn excitation(state: &State, inputs: &Inputs, ratios: &Ratios, stepping: bool) -> Excitation {
    let value = |index: Option<usize>| index.map_or(0.0, |i| state.reals[i]);
    let given =
        |index: Option<usize>, order: usize| index.filter(|_| stepping).and_then(|i| state.input_rates[i][order - 1]);
    let rate = |index: Option<usize>, order: usize| given(index, order).unwrap_or(0.0);
    let load = |index: Option<usize>| Quadratic([value(index), rate(index, 1), rate(index, 2)]);
    let motion = |ring: &RingInputs, axis: usize| -> Cubic {
        let (x, v, a) = (ring.position[axis], ring.velocity[axis], ring.acceleration[axis]);
        Cubic([
            value(x),
            given(x, 1).unwrap_or(value(v)),
            given(x, 2).or(given(v, 1)).unwrap_or(value(a)),
            given(v, 2).unwrap_or(rate(a, 1)),
        ])
    };
    let Inputs { speeds, shaft, housing, .. } = *inputs;
    let turning = |start: f64, by: [f64; 2]| {
        let sum = |of: &dyn Fn(Option<usize>) -> f64| {
            // An outer ring that stands adds nothing, not even a rounding.
            let inner = by[0] * of(speeds[0]);
            if speeds[1].is_none() { inner } else { inner + by[1] * of(speeds[1]) }
        };
        Turning { start, since: Quadratic([0.0, sum(&value), sum(&|index| rate(index, 1))]) }
    };
    let cage = turning(state.cage.rest, ratios.cage);
    let Quadratic([_, speed, acceleration]) = turning(0.0, [1.0, -1.0]).since;
    let [shaft_frame, housing_frame, spin] = state.frames.map(|frame| frame.rest);
    let mut excitation = Excitation {
        cage_start: cage.start,
        cage_turns: state.cage.turns,
        cage: cage.since,
        frames: if inputs.frames {
            [turning(shaft_frame, [1.0, 0.0]), turning(housing_frame, [0.0, 1.0]), turning(spin, ratios.spin)]
        } else {
            Default::default()
        },
        motion: [shaft, housing].map(|ring| std::array::from_fn(|axis| motion(&ring, axis))),
        load: [shaft, housing].map(|ring| ring.load.map(load)),
        relative_speed: Quadratic([speed, acceleration, 0.0]),
    };
    if !stepping {
        excitation.cage.0[2] += state.ended.cage;
        for (motion, acceleration) in excitation.motion[1].iter_mut().zip(state.ended.housing) {
            motion.0[2] += acceleration;
        }
    }
    excitation
}

/// After a step the inputs stand where they were extrapolated to, so that outputs belong to the end of the step
/// until the host sets them anew.
pub(in crate::simulation) fn follow(
    state: &mut State,
    inputs: &Inputs,
    ratios: &Ratios,
    ended: &Excitation,
    step: f64,
) {
    for (of, ring) in inputs.rings().into_iter().enumerate() {
        for axis in 0..inputs.axes {
            let (motion, load) = (ended.motion[of][axis], ended.load[of][axis]);
            let ends = [
                (ring.position[axis], motion.at(step)),
                (ring.velocity[axis], motion.rate_at(step)),
                (ring.load[axis], load.at(step)),
            ];
            for (index, value) in ends {
                if let Some(i) = index {
                    state.reals[i] = value;
                }
            }
        }
    }
    let Inputs { speeds, shaft, housing, .. } = *inputs;
    for i in shaft.acceleration.into_iter().chain(housing.acceleration).chain(speeds).flatten() {
        state.reals[i] += state.input_rates[i][0].unwrap_or(0.0) * step;
    }
    let given = state.input_rates.as_flattened().iter().any(Option::is_some);
    state.input_rates.fill([None; 2]);
    state.ended = Ended::default();
    if given {
        let now = excitation(state, inputs, ratios, false);
        let left = |axis: usize| ended.motion[1][axis].second_at(step) - now.motion[1][axis].second_at(0.0);
        state.ended = Ended { cage: ended.cage.0[2] - now.cage.0[2], housing: [left(0), left(1)] };
    }
}
