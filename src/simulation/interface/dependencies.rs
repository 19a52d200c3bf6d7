//! Which output depends on which input or parameter, at a communication point and at the start.
//!
//! At a communication point only what feeds through without a step counts: states do not follow inputs at once, forces
//! follow prescribed motion. At the start the static equilibrium ties forces, positions and paths to every load and
//! every motion that is given; but rings are at rest whatever the inputs are, and what only matters in motion does not
//! enter.

use super::quantity::{Input, Parameter, Quantity as Q, RingName};
use crate::scene::{DefectOn, DegreesOfFreedom, ElementInertia, Motion, Scene, WavyBody};
use crate::simulation::interface::table::{Causality, Dependencies, Variable};

/// The dependencies of all outputs, in the order of the table.
pub(in crate::simulation) fn of(table: &[Variable], quantities: &[Q], scene: &Scene) -> Vec<Dependencies> {
    let rows = || table.iter().zip(quantities);
    let known = |variable: &Variable| matches!(variable.causality, Causality::Input | Causality::Parameter);
    let knowns: Vec<_> = rows().filter(|(variable, _)| known(variable)).collect();
    let defect = scene.defects.iter().any(|defect| defect.on != DefectOn::Inner)
        || scene.waviness.iter().any(|waves| waves.on != WavyBody::Inner);
    rows()
        .filter(|(variable, _)| variable.causality == Causality::Output)
        .map(|(variable, &output)| {
            let listed = |depends: &dyn Fn(&Variable, Q) -> bool| {
                knowns.iter().filter(|(known, quantity)| depends(known, **quantity)).map(|(v, _)| v.reference).collect()
            };
            Dependencies {
                output: variable.reference,
                direct: listed(&|known, quantity| {
                    let input = quantity.as_input().filter(|_| known.causality == Causality::Input);
                    input.is_some_and(|input| follows(output, input, defect, scene))
                }),
                initial: listed(&|_, quantity| starts_from(output, quantity, scene)),
            }
        })
        .collect()
}

/// Whether an output follows an input at the same instant.
fn follows(output: Q, input: Input, defect: bool, scene: &Scene) -> bool {
    use RingName::{Housing, Shaft};
    let (position, velocity, speed) = match input {
        Input::Position(..) => (true, false, false),
        Input::Velocity(..) => (false, true, false),
        Input::Speed(_) => (false, false, true),
        Input::Load(..) | Input::Acceleration(..) => (false, false, false),
    };
    // Inner contacts see both rings, and the cage speed through the rate of approach.
    let inner = position || velocity || speed;
    // Outer contacts see the path, which is measured from the outer ring, and its rate. An element in balance hands on
    // at once what either ring does. Oil films follow the speed.
    let balanced = scene.bearing.element_inertia == ElementInertia::None;
    let film = scene.film.is_some();
    let outer =
        if balanced { inner } else { matches!(input, Input::Velocity(Housing, _)) || ((defect || film) && speed) };
    // A tilted outer ring meets its elements elsewhere, and elements that go round pass along its tilt.
    let in_space = scene.bearing.degrees_of_freedom != DegreesOfFreedom::Two;
    let outer = outer || (in_space && speed);
    match output {
        Q::Force(Shaft, _) | Q::ElementInnerForce(_) => inner,
        Q::Force(Housing, _) | Q::ElementOuterForce(_) => {
            outer || (in_space && matches!(input, Input::Position(Housing, 3..)))
        }
        Q::Acceleration(Shaft, axis) => inner || input == Input::Load(Shaft, axis),
        Q::Acceleration(Housing, axis) => outer || input == Input::Load(Housing, axis),
        // Elements in balance are where their centrifugal force puts them; of balls in space that turns the contacts.
        Q::Stiffness(..) => position || ((film || balanced || in_space) && speed),
        // Through its spring and damper, along its direction.
        Q::SensorAcceleration(k) => match input {
            Input::Position(Housing, axis) | Input::Velocity(Housing, axis) => {
                scene.housing.motion == Motion::Host && axis < 3 && scene.sensors[k].unit_in_space()[axis] != 0.0
            }
            Input::Position(Shaft, _) | Input::Velocity(Shaft, _) => false,
            Input::Speed(_) | Input::Load(..) | Input::Acceleration(..) => false,
        },
        // The host's own positions; those of the state follow no input at once.
        Q::Probe(axis) => matches!(input, Input::Position(_, along) if along == axis),
        Q::CageSpeed => speed,
        // Tangential parts of the inner contacts, and the elements' inertia as the outer ring accelerates.
        Q::CageTorque => inner || matches!(input, Input::Acceleration(Housing, _) | Input::Load(Housing, _)),
        Q::ShaftTorque => inner,
        // With inertia they are states.
        Q::ElementPath(_) | Q::ElementAxial(_) => balanced && (position || speed),
        // Where the contact is open the angle is 0, and that it is so follows rates.
        Q::ContactAngle(_, 0) | Q::ShoulderMargin(_, 0) => inner,
        Q::ContactAngle(..) | Q::ShoulderMargin(..) => {
            outer || (in_space && matches!(input, Input::Position(Housing, 3..)))
        }
        // States follow no input at once, and a mean is of the step before.
        Q::Position(..)
        | Q::Velocity(..)
        | Q::MeanForce(..)
        | Q::NextMeanForce(..)
        | Q::CageAngle
        | Q::ElementAngle(_)
        | Q::RingAngle(_)
        | Q::ElementSpinAngle(_) => false,
        Q::CouplingError | Q::LargestCouplingError | Q::SuggestedStep => false,
        Q::Speed(_) | Q::Load(..) | Q::Count(_) | Q::RadialClearance | Q::Parameter(_) => false,
    }
}

/// Whether an output depends on an input or a parameter in initialization mode.
pub(in crate::simulation) fn starts_from(output: Q, known: Q, scene: &Scene) -> bool {
    match output {
        Q::CageAngle => known == Q::Parameter(Parameter::CageInitialAngle),
        Q::ElementAngle(_) => matches!(known, Q::Parameter(Parameter::CageInitialAngle | Parameter::CageSeed)),
        Q::RingAngle(ring) => known == Q::Parameter(Parameter::RingInitialAngle(ring)),
        Q::ElementSpinAngle(j) => match known {
            Q::Parameter(Parameter::DefectAngle(index)) => scene.first_defect_of(j) == Some(index),
            _ => false,
        },
        Q::CageSpeed => turns(known, scene) || known == Q::Parameter(Parameter::CageSeed),
        // At rest; no step has been taken.
        Q::CouplingError | Q::LargestCouplingError => false,
        Q::Velocity(..) | Q::Acceleration(..) | Q::SensorAcceleration(_) => false,
        Q::Position(..)
        | Q::Force(..)
        | Q::MeanForce(..)
        | Q::NextMeanForce(..)
        | Q::Stiffness(..)
        | Q::Probe(_)
        | Q::CageTorque
        | Q::ShaftTorque
        | Q::ElementPath(_)
        | Q::ElementAxial(_)
        | Q::ContactAngle(..)
        | Q::ShoulderMargin(..)
        | Q::ElementInnerForce(_)
        | Q::ElementOuterForce(_)
        | Q::Speed(_)
        | Q::Load(..)
        | Q::Count(_)
        | Q::RadialClearance
        | Q::SuggestedStep
        | Q::Parameter(_) => match (known, known.as_input()) {
            (Q::Parameter(parameter), _) => balances(parameter),
            // Only the cage's torque knows that a prescribed outer ring accelerates.
            (_, Some(Input::Acceleration(RingName::Housing, _))) => output == Q::CageTorque,
            (_, Some(Input::Acceleration(RingName::Shaft, _))) => false,
            (_, Some(Input::Speed(_) | Input::Load(..) | Input::Position(..) | Input::Velocity(..))) => true,
            (_, None) => false,
        },
    }
}

/// Whether the nominal cage's speed depends on an input or a parameter: in space, where parameters are of contact
/// angles, by the angle at which balls roll.
pub(in crate::simulation) fn turns(known: Q, scene: &Scene) -> bool {
    let in_space = scene.bearing.degrees_of_freedom != DegreesOfFreedom::Two;
    match known {
        Q::Speed(_) | Q::Parameter(Parameter::CageSlip) => true,
        Q::Parameter(Parameter::ContactAngle | Parameter::OperatingAngle) => in_space,
        _ => false,
    }
}

/// Whether the static equilibrium depends on a parameter.
pub(in crate::simulation) fn balances(parameter: Parameter) -> bool {
    match parameter {
        // Tolerance and recorder are of steps; masses and dampers of rings, and sensors, matter in motion.
        Parameter::Tolerance | Parameter::RecorderFolder | Parameter::RecorderRate => false,
        Parameter::RepeatedInputs | Parameter::SensorResonance(_) => false,
        Parameter::RingMass(_) | Parameter::RingDamping(_) | Parameter::AxialDamping(_) => false,
        Parameter::TransverseInertia | Parameter::PolarInertia | Parameter::TiltDamping => false,
        Parameter::InternalClearance
        | Parameter::ContactAngle
        | Parameter::OperatingAngle
        | Parameter::AcrossDamping
        | Parameter::AxialStiffness(_)
        | Parameter::Preload(_)
        | Parameter::TiltStiffness
        | Parameter::ContactDamping
        | Parameter::ContactLaw
        | Parameter::CageSlip
        | Parameter::CageInitialAngle
        | Parameter::RingInitialAngle(_)
        | Parameter::SpinSlip
        | Parameter::DefectAngle(_)
        | Parameter::SpallLength(_)
        | Parameter::SpallDepth(_)
        | Parameter::CageSeed
        | Parameter::DiameterSeed
        | Parameter::FilmViscosity
        | Parameter::RingStiffness(_) => true,
    }
}
