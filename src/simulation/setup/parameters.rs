//! Parameters that a host may set: their start values, and the scene with the values set.

use crate::scene::{ContactLaw, Damping, DefectShape, DrawnDiameters, RepeatedInputs, Ring, Scene};
use crate::simulation::SimulationError;
use crate::simulation::interface::table::{Kind, Variable};
use crate::simulation::interface::{Parameter, Quantity, RingName};

/// Start values of the table: reals, and beside them integers.
pub(in crate::simulation) fn start_values(table: &[Variable]) -> (Vec<f64>, Vec<i32>) {
    table
        .iter()
        .map(|variable| match variable.kind {
            Kind::Real { start, .. } => (start.unwrap_or(0.0), 0),
            Kind::Enumeration { start, .. } | Kind::Whole { start } => (0.0, start),
            Kind::Integer | Kind::Text { .. } => (0.0, 0),
        })
        .unzip()
}

/// Value of a real parameter, if the scene has it.
pub(in crate::simulation) fn parameter(quantities: &[Quantity], values: &[f64], wanted: Parameter) -> Option<f64> {
    quantities.iter().position(|&q| q == Quantity::Parameter(wanted)).map(|i| values[i])
}

/// The scene with the parameters that the host has set, checked again.
pub(in crate::simulation) fn with_parameters(
    scene: &Scene,
    quantities: &[Quantity],
    values: &[f64],
    integers: &[i32],
) -> Result<Scene, SimulationError> {
    let mut changed = scene.clone();
    for ((&quantity, &value), &integer) in quantities.iter().zip(values).zip(integers) {
        let Quantity::Parameter(parameter) = quantity else { continue };
        match parameter {
            Parameter::InternalClearance => changed.bearing.radial_clearance = 0.5 * value,
            Parameter::ContactAngle => changed.bearing.set_contact_angle(value),
            // One that the host leaves alone stays that of the free angle, which the host may have set.
            Parameter::OperatingAngle if Some(value) == scene.bearing.given_operating_angle() => {}
            Parameter::OperatingAngle => changed.bearing.operating_angle = Some(value),
            Parameter::AcrossDamping => changed.contact.across_damping = Some(value),
            Parameter::AxialDamping(ring) => ring_of(&mut changed, ring).axial.damping = value,
            Parameter::AxialStiffness(ring) => ring_of(&mut changed, ring).axial.stiffness = value,
            Parameter::Preload(ring) => ring_of(&mut changed, ring).axial.preload = value,
            Parameter::TransverseInertia => changed.shaft.tilt.transverse_inertia = value,
            Parameter::PolarInertia => changed.shaft.tilt.polar_inertia = value,
            Parameter::TiltDamping => changed.shaft.tilt.damping = value,
            Parameter::TiltStiffness => changed.shaft.tilt.stiffness = value,
            Parameter::ContactDamping => {
                changed.contact.damping = match changed.contact.damping {
                    Damping::HuntCrossley(_) => Damping::HuntCrossley(value),
                    Damping::Proportional(_) => Damping::Proportional(value),
                }
            }
            Parameter::ContactLaw => {
                // Other numbers were refused when they were set.
                changed.contact.law = ContactLaw::numbered(integer).unwrap_or(changed.contact.law);
            }
            Parameter::CageSlip => changed.cage.slip = value,
            Parameter::CageInitialAngle => changed.cage.initial_angle = value,
            Parameter::SpinSlip => changed.cage.spin_slip = value,
            Parameter::RingInitialAngle(RingName::Shaft) => changed.shaft_initial_angle = value,
            Parameter::RingInitialAngle(RingName::Housing) => changed.housing_initial_angle = value,
            Parameter::DefectAngle(index) => changed.defects[index].angle = value,
            Parameter::RingMass(ring) => ring_of(&mut changed, ring).mass = value,
            Parameter::RingDamping(ring) => ring_of(&mut changed, ring).damping = value,
            Parameter::RingStiffness(ring) => ring_of(&mut changed, ring).stiffness = value,
            Parameter::Tolerance => changed.tolerance = value,
            Parameter::SpallLength(k) => sizes_of(&mut changed, k).for_each(|[length, _]| *length = value),
            Parameter::SpallDepth(k) => sizes_of(&mut changed, k).for_each(|[_, depth]| *depth = value),
            Parameter::CageSeed => {
                // Numbers below 0 were refused when they were set.
                let seed = integer.unsigned_abs().into();
                changed.cage.irregularity.iter_mut().for_each(|cage| cage.draw_with(seed));
            }
            Parameter::DiameterSeed => {
                let seed = integer.unsigned_abs().into();
                let drawn = changed.bearing.drawn_diameters.map(|drawn| DrawnDiameters { seed, ..drawn });
                drawn.into_iter().for_each(|drawn| changed.bearing.draw_diameters(drawn));
            }
            Parameter::FilmViscosity => changed.film.iter_mut().for_each(|film| film.viscosity = value),
            Parameter::SensorResonance(index) => changed.sensors[index].set_resonance(value),
            Parameter::RecorderRate => changed.recorder.iter_mut().for_each(|recorder| recorder.rate = value),
            // No part of a scene.
            Parameter::RecorderFolder => {}
            Parameter::RepeatedInputs => {
                changed.repeated_inputs = RepeatedInputs::numbered(integer).unwrap_or(changed.repeated_inputs);
            }
        }
    }
    changed.check()?;
    Ok(changed)
}

/// Length and depth of a defect, if it is a spall.
fn sizes_of(scene: &mut Scene, defect: usize) -> impl Iterator<Item = [&mut f64; 2]> {
    let sizes = match &mut scene.defects[defect].shape {
        DefectShape::Spall { length, depth, .. } => Some([length, depth]),
        DefectShape::Profile(_) => None,
    };
    sizes.into_iter()
}

fn ring_of(scene: &mut Scene, ring: RingName) -> &mut Ring {
    match ring {
        RingName::Shaft => &mut scene.shaft,
        RingName::Housing => &mut scene.housing,
    }
}
