//! All that the future of a simulation depends on, and nothing else. It is what runs: taking it is a copy, putting it
//! back another.

use crate::dynamics::contacts::RingForces;
use crate::dynamics::parameters::WholeAngle;
use crate::simulation::coupling::Coupling;
use crate::simulation::integration::Progress;
use crate::simulation::interface::Angles;

/// Everything that the future of a [`Simulation`](super::life::Simulation) depends on; taking it and putting it back
/// changes no bit.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    pub(in crate::simulation) time: f64,
    pub(in crate::simulation) started: bool,
    pub(in crate::simulation) cage: WholeAngle,
    /// Angles of the frames of defects, in the order of [`crate::dynamics::parameters::Frame`].
    pub(in crate::simulation) frames: [WholeAngle; 3],
    pub(in crate::simulation) ended: Ended,
    pub(in crate::simulation) progress: Progress,
    /// Values of inputs and real parameters, by index in the table; outputs follow from all the rest.
    pub(in crate::simulation) reals: Vec<f64>,
    /// Those of enumerations, by index.
    pub(in crate::simulation) integers: Vec<i32>,
    /// First and second derivatives of inputs for the next step, where the host has given any, by index.
    pub(in crate::simulation) input_rates: Vec<[Option<f64>; 2]>,
    pub(super) history: History,
    /// What is known of the host; `None` where it moves no ring.
    pub(super) coupling: Option<Box<Coupling>>,
    pub(super) first: FirstInputs,
}

/// Accelerations at the end of the last step that derivatives of inputs gave and no input says: outputs at that instant
/// follow from them. Gone once the host sets an input.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::simulation) struct Ended {
    /// Of the cage (rad/s²).
    pub(super) cage: f64,
    /// Of a prescribed outer ring (m/s²).
    pub(in crate::simulation) housing: [f64; 2],
}

/// The last steps, as the host moved the rings in them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct History {
    /// Length of the last step (s); 0 before the first.
    pub(super) step: f64,
    /// Lengths of the two steps before it (s), the later one first; 0 where there was none.
    pub(super) earlier: [f64; 2],
    /// Mean accelerations over those (m/s², rad/s²): of each step, of both rings, of all coordinates.
    pub(super) means: [[[f64; 5]; 2]; 2],
    /// Velocities at the beginning of the last step (m/s, rad/s), of both rings.
    pub(super) velocities: [[f64; 5]; 2],
    /// Inputs where the last step has brought them.
    pub(super) arrived: Vec<f64>,
}

impl History {
    /// That of no step, for so many inputs.
    pub(super) fn none(inputs: usize) -> Self {
        let (means, velocities) = ([[[0.0; 5]; 2]; 2], [[0.0; 5]; 2]);
        Self { step: 0.0, earlier: [0.0; 2], means, velocities, arrived: vec![0.0; inputs] }
    }

    /// All its numbers.
    pub(super) fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        let means = self.means.as_flattened_mut().as_flattened_mut();
        let rest = means.iter_mut().chain(self.velocities.as_flattened_mut()).chain(&mut self.arrived);
        std::iter::once(&mut self.step).chain(&mut self.earlier).chain(rest)
    }

    fn copy_from(&mut self, other: &Self) {
        let Self { step, earlier, means, velocities, arrived } = self;
        (*step, *earlier, *means, *velocities) = (other.step, other.earlier, other.means, other.velocities);
        arrived.copy_from_slice(&other.arrived);
    }
}

/// What the host gave when it first took the step from a communication point; kept where `host.repeated_inputs` asks
/// for it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FirstInputs {
    /// Whether there are any.
    pub(super) given: bool,
    /// The communication point (s).
    pub(super) time: f64,
    /// The inputs.
    pub(super) values: Vec<f64>,
}

impl FirstInputs {
    /// None, of so many inputs.
    pub(super) fn none(inputs: usize) -> Self {
        Self { given: false, time: 0.0, values: vec![0.0; inputs] }
    }

    /// Whether they are those of the step from this communication point.
    pub(super) fn are_of(&self, time: f64) -> bool {
        self.given && self.time.to_bits() == time.to_bits()
    }

    fn copy_from(&mut self, other: &Self) {
        (self.given, self.time) = (other.given, other.time);
        self.values.copy_from_slice(&other.values);
    }
}

/// What a host has asked of the next step, since the last.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Foreseen {
    /// Forces on inner and outer ring to hold over it (N).
    pub(super) force: Option<RingForces>,
    /// How forces change with the time as it begins (N/s); 0 where nobody has asked.
    pub(super) rate: Option<RingForces>,
}

/// A look at the next step.
#[derive(Debug, Clone, Default)]
pub(super) struct Ahead {
    pub(super) foreseen: Foreseen,
    /// The same of the step that was taken last.
    pub(super) before: Foreseen,
    /// Where the state is kept meanwhile.
    pub(super) state: Option<Box<State>>,
}

impl Ahead {
    /// Nothing is known; if looks are to be expected there is room for the state, so that they allocate nothing.
    pub(super) fn begin(&mut self, state: &State, expected: bool) {
        self.foreseen = Foreseen::default();
        if expected && self.state.is_none() {
            self.state = Some(Box::new(state.clone()));
        }
    }
}

impl State {
    /// Angles of cage and frames.
    pub(in crate::simulation) fn angles(&self) -> Angles {
        Angles { cage: self.cage.total(), frames: self.frames.map(WholeAngle::total) }
    }

    /// Copies another state of the same model; allocates nothing.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.copy_all_but_first(other);
        self.first.copy_from(&other.first);
    }

    /// Whether such steps can have been taken.
    pub(super) fn steps_are_possible(&self) -> bool {
        let mut history = self.history.clone();
        let mut coupling = self.coupling.clone();
        let coupling = coupling.iter_mut().flat_map(|coupling| coupling.numbers());
        let finite = history.numbers().chain(coupling).all(|number| number.is_finite());
        let first = std::iter::once(&self.first.time).chain(&self.first.values).all(|number| number.is_finite());
        finite && first && self.history.step >= 0.0 && self.history.earlier.iter().all(|step| *step >= 0.0)
    }

    /// Forgets the steps that were taken.
    pub(super) fn forget_steps(&mut self) {
        let inputs = self.input_rates.len();
        (self.history, self.first) = (History::none(inputs), FirstInputs::none(inputs));
        if let Some(coupling) = &mut self.coupling {
            **coupling = Coupling::default();
        }
    }

    /// Copies a state that was taken earlier. What a step began with the first time is no part of the state before that
    /// time, and stays.
    pub(super) fn go_back_to(&mut self, earlier: &Self, ahead: &mut Ahead) {
        ahead.foreseen = Foreseen::default();
        if self.first.are_of(earlier.time) {
            self.copy_all_but_first(earlier);
        } else {
            self.copy_from(earlier);
        }
    }

    /// Copies all of it but the first inputs of a step.
    fn copy_all_but_first(&mut self, other: &Self) {
        let Self {
            time,
            started,
            cage,
            frames,
            ended,
            progress,
            reals,
            integers,
            input_rates,
            history,
            coupling,
            first: _,
        } = self;
        (*time, *started, *ended) = (other.time, other.started, other.ended);
        (*cage, *frames) = (other.cage, other.frames);
        progress.copy_from(&other.progress);
        reals.copy_from_slice(&other.reals);
        integers.copy_from_slice(&other.integers);
        input_rates.copy_from_slice(&other.input_rates);
        history.copy_from(&other.history);
        coupling.clone_from(&other.coupling);
    }
}
