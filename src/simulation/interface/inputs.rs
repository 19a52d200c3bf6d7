//! Where in the variable table the inputs stand.

use super::quantity::{Input, Parameter, Quantity, RingName};

/// Where in the table the inputs of one ring stand.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::simulation) struct RingInputs {
    pub(in crate::simulation) load: [Option<usize>; 5],
    pub(in crate::simulation) position: [Option<usize>; 5],
    pub(in crate::simulation) velocity: [Option<usize>; 5],
    pub(in crate::simulation) acceleration: [Option<usize>; 5],
}

/// Where in the table the inputs stand, and the tolerance.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::simulation) struct Inputs {
    /// Speed of the inner ring, and of an outer ring that turns.
    pub(in crate::simulation) speeds: [Option<usize>; 2],
    pub(in crate::simulation) tolerance: Option<usize>,
    /// The parameter that says what inputs of a repeated step are.
    pub(in crate::simulation) repeated: Option<usize>,
    /// Whether anything asks for the frames of defects: a defect that is not of an outer ring at rest, an output, or
    /// rings in space.
    pub(in crate::simulation) frames: bool,
    /// Inputs are the first so many rows.
    pub(in crate::simulation) count: usize,
    /// A ring's coordinates that can be inputs: 2 in the plane, else 5.
    pub(in crate::simulation) axes: usize,
    pub(in crate::simulation) shaft: RingInputs,
    pub(in crate::simulation) housing: RingInputs,
}

impl Inputs {
    /// `input_count` leading rows of the table are inputs; a ring's motion among the outputs is not.
    pub(in crate::simulation) fn new(quantities: &[Quantity], input_count: usize) -> Self {
        let mut inputs = Self {
            tolerance: quantities.iter().position(|&q| q == Quantity::Parameter(Parameter::Tolerance)),
            repeated: quantities.iter().position(|&q| q == Quantity::Parameter(Parameter::RepeatedInputs)),
            count: input_count,
            ..Self::default()
        };
        for (index, &quantity) in quantities.iter().take(input_count).enumerate() {
            let Some(input) = quantity.as_input() else { continue };
            let slot = match input {
                Input::Speed(ring) => &mut inputs.speeds[ring.index()],
                Input::Load(ring, axis) => &mut inputs.ring(ring).load[axis],
                Input::Position(ring, axis) => &mut inputs.ring(ring).position[axis],
                Input::Velocity(ring, axis) => &mut inputs.ring(ring).velocity[axis],
                Input::Acceleration(ring, axis) => &mut inputs.ring(ring).acceleration[axis],
            };
            *slot = Some(index);
        }
        inputs
    }

    /// Those of both rings, the inner one first.
    pub(in crate::simulation) fn rings(&self) -> [RingInputs; 2] {
        [self.shaft, self.housing]
    }

    fn ring(&mut self, ring: RingName) -> &mut RingInputs {
        match ring {
            RingName::Shaft => &mut self.shaft,
            RingName::Housing => &mut self.housing,
        }
    }
}
