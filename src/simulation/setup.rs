//! From a scene and the parameters that a host has set to the model that is stepped.

use super::SimulationError;
use super::table::{Quantity, RingName};
use super::variables::{Kind, Variable};
use crate::contact::near_defect::NearDefect;
use crate::contact::rigid_path::RigidPath;
use crate::dynamics::model::Model;
use crate::scene::{ContactLaw, Damping, Ring, Scene};
use crate::surface::Surface;

/// Where in the table the inputs of one ring stand.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RingInputs {
    pub(super) load: [Option<usize>; 2],
    pub(super) position: [Option<usize>; 2],
    pub(super) velocity: [Option<usize>; 2],
    pub(super) acceleration: [Option<usize>; 2],
}

/// Where in the table the inputs stand, and the tolerance.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Inputs {
    pub(super) speed: Option<usize>,
    pub(super) tolerance: Option<usize>,
    /// Inputs are the first so many rows.
    pub(super) count: usize,
    pub(super) shaft: RingInputs,
    pub(super) housing: RingInputs,
}

impl Inputs {
    /// `input_count` leading rows of the table are inputs; a ring's motion among the outputs is not.
    pub(super) fn new(quantities: &[Quantity], input_count: usize) -> Self {
        let mut inputs = Self {
            tolerance: quantities.iter().position(|&q| q == Quantity::Tolerance),
            count: input_count,
            ..Self::default()
        };
        for (index, &quantity) in quantities.iter().take(input_count).enumerate() {
            let place = match quantity {
                Quantity::ShaftSpeed => &mut inputs.speed,
                Quantity::Load(ring, axis) => &mut inputs.ring(ring).load[axis],
                Quantity::Position(ring, axis) => &mut inputs.ring(ring).position[axis],
                Quantity::Velocity(ring, axis) => &mut inputs.ring(ring).velocity[axis],
                Quantity::Acceleration(ring, axis) => &mut inputs.ring(ring).acceleration[axis],
                _ => continue,
            };
            *place = Some(index);
        }
        inputs
    }

    fn ring(&mut self, ring: RingName) -> &mut RingInputs {
        match ring {
            RingName::Shaft => &mut self.shaft,
            RingName::Housing => &mut self.housing,
        }
    }
}

/// Start values of the table: reals, and beside them integers.
pub(super) fn start_values(table: &[Variable]) -> (Vec<f64>, Vec<i32>) {
    table
        .iter()
        .map(|variable| match variable.kind {
            Kind::Real { start, .. } => (start.unwrap_or(0.0), 0),
            Kind::Enumeration { start, .. } => (0.0, start),
            Kind::Integer | Kind::Text { .. } => (0.0, 0),
        })
        .unzip()
}

/// Value of a real parameter, if the scene has it.
pub(super) fn parameter(quantities: &[Quantity], values: &[f64], wanted: Quantity) -> Option<f64> {
    quantities.iter().position(|&q| q == wanted).map(|i| values[i])
}

/// The scene with the parameters that the host has set, checked again.
pub(super) fn with_parameters(
    scene: &Scene,
    quantities: &[Quantity],
    values: &[f64],
    integers: &[i32],
) -> Result<Scene, SimulationError> {
    let mut changed = scene.clone();
    for ((&quantity, &value), &integer) in quantities.iter().zip(values).zip(integers) {
        match quantity {
            Quantity::RadialClearance => changed.bearing.radial_clearance = value,
            Quantity::ContactDamping => {
                changed.contact.damping = match changed.contact.damping {
                    Damping::HuntCrossley(_) => Damping::HuntCrossley(value),
                    Damping::Proportional(_) => Damping::Proportional(value),
                }
            }
            Quantity::ContactLaw => {
                changed.contact.law = match integer {
                    1 => ContactLaw::Hertz,
                    2 => ContactLaw::Map,
                    _ => ContactLaw::Love,
                }
            }
            Quantity::CageSlip => changed.cage.slip = value,
            Quantity::CageInitialAngle => changed.cage.initial_angle = value,
            Quantity::DefectAngle => {
                if let Some(defect) = &mut changed.defect {
                    defect.angle = value;
                }
            }
            Quantity::RingMass(ring) => ring_of(&mut changed, ring).mass = value,
            Quantity::RingDamping(ring) => ring_of(&mut changed, ring).damping = value,
            Quantity::RingStiffness(ring) => ring_of(&mut changed, ring).stiffness = value,
            Quantity::Tolerance => changed.tolerance = value,
            _ => {}
        }
    }
    changed.check()?;
    Ok(changed)
}

fn ring_of(scene: &mut Scene, ring: RingName) -> &mut Ring {
    match ring {
        RingName::Shaft => &mut scene.shaft,
        RingName::Housing => &mut scene.housing,
    }
}

/// The equations' parameters, with what the contact law needs near the defect.
pub(crate) fn build_model(scene: &Scene, surface: Option<&Surface>) -> Result<Model, SimulationError> {
    let near = surface
        .map(|surface| match (scene.contact.law, surface) {
            (ContactLaw::Hertz, Surface::Profile(profile)) => Ok(NearDefect::Hertz(RigidPath::new(
                profile.points(),
                0.5 * scene.bearing.element_diameter,
                scene.bearing.outer_raceway_radius(),
            ))),
            (law, _) => Err(SimulationError::LawNotAvailable { law }),
        })
        .transpose()?;
    Ok(Model::new(scene, near))
}
