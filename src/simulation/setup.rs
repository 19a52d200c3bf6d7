//! From a scene and the parameters that a host has set to the model that is stepped.

use std::sync::Arc;

use super::SimulationError;
use super::quantity::{Parameter, Quantity, RingName};
use super::variables::{Kind, Variable};
use crate::contact::map::ContactMap;
use crate::contact::map_plan::MapPlan;
use crate::contact::map_specification::{MapSpecification, Runner, Sequential};
use crate::contact::near_defect::{NearDefect, NearLove, NearMap};
use crate::contact::raceway_grid::{ElementOnRaceway, Resolution};
use crate::contact::rigid_path::RigidPath;
use crate::dynamics::model::Model;
use crate::dynamics::raceway::Placed;
use crate::geometry::hertz_constant::HertzConstants;
use crate::scene::{ContactLaw, Damping, Ring, Scene};
use crate::surface::Surface;

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
pub(super) fn parameter(quantities: &[Quantity], values: &[f64], wanted: Parameter) -> Option<f64> {
    quantities.iter().position(|&q| q == Quantity::Parameter(wanted)).map(|i| values[i])
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
        let Quantity::Parameter(parameter) = quantity else { continue };
        match parameter {
            Parameter::RadialClearance => changed.bearing.radial_clearance = value,
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
            Parameter::DefectAngle => {
                if let Some(defect) = &mut changed.defect {
                    defect.angle = value;
                }
            }
            Parameter::RingMass(ring) => ring_of(&mut changed, ring).mass = value,
            Parameter::RingDamping(ring) => ring_of(&mut changed, ring).damping = value,
            Parameter::RingStiffness(ring) => ring_of(&mut changed, ring).stiffness = value,
            Parameter::Tolerance => changed.tolerance = value,
            // The recorder is no part of the model.
            Parameter::RecorderFolder => {}
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

/// Error of a contact map that is still taken when the scene asks for none in particular: below what a real edge's
/// shape leaves open.
const TOLERATED: f64 = 0.02;

/// Force [N] up to which the contact map of a scene reaches.
pub fn largest_force(scene: &Scene) -> f64 {
    let load = [scene.shaft.load, scene.housing.load].iter().map(|f| f[0].hypot(f[1])).fold(0.0, f64::max);
    let assumed = (4.0 * 5.0 * load / scene.bearing.element_count as f64).max(1000.0);
    scene.contact.largest_force.unwrap_or(assumed)
}

/// What the contact map of a scene covers: forces up to `contact.largest_force_n`, or else four times the static force
/// on the most loaded element, 5 F/Z (Stribeck), and at least 1000 N. Δ counts the rings' and seats' compliance as
/// well. An accuracy that the scene asks for is held; the usual one may be missed, in defects deeper than they are
/// long, by what `TOLERATED` says.
pub fn map_specification(scene: &Scene) -> MapSpecification {
    let force = largest_force(scene);
    let contact = libm::pow(force / HertzConstants::of(&scene.bearing).outer, 2.0 / 3.0);
    let usual = MapSpecification::new(contact + scene.bearing.outer_compliance * force);
    MapSpecification {
        accuracy: scene.contact.map_accuracy.unwrap_or(usual.accuracy),
        tolerated: if scene.contact.map_accuracy.is_none() { Some(TOLERATED) } else { None },
        resolution: scene
            .contact
            .cells
            .map_or(usual.resolution, |[columns, rows]| Resolution { columns: columns as usize, rows: rows as usize }),
        ..usual
    }
}

/// Computes the contact map of a scene, `None` where its law needs none. `runner` says on how many cores.
///
/// # Errors
/// Where a contact cannot be solved or the accuracy is not reached.
pub fn build_map(
    scene: &Scene,
    surface: &Surface,
    runner: &mut impl Runner,
) -> Result<Option<ContactMap>, SimulationError> {
    if scene.contact.law != ContactLaw::Map {
        return Ok(None);
    }
    Ok(Some(ContactMap::build(surface, ElementOnRaceway::outer(&scene.bearing), map_specification(scene), runner)?))
}

/// Fingerprint of all that the contact map of a scene depends on.
pub fn map_fingerprint(scene: &Scene, surface: &Surface) -> u64 {
    ContactMap::fingerprint_of(surface, ElementOnRaceway::outer(&scene.bearing), map_specification(scene))
}

/// A map that was stored with the scene; refused when it is damaged or belongs to something else.
pub fn stored_map(scene: &Scene, surface: &Surface, bytes: &[u8]) -> Result<ContactMap, SimulationError> {
    Ok(ContactMap::from_bytes(bytes, map_fingerprint(scene, surface))?)
}

/// The raceway near the defect under law `map`: the stored map if it is that of this scene, or else one made now.
fn near_map(scene: &Scene, surface: &Surface, stored: Option<&Arc<ContactMap>>) -> Result<NearDefect, SimulationError> {
    let (element, specification) = (ElementOnRaceway::outer(&scene.bearing), map_specification(scene));
    let map = match stored {
        Some(map) if map.fingerprint() == map_fingerprint(scene, surface) => Arc::clone(map),
        _ => Arc::new(ContactMap::build(surface, element, specification, &mut Sequential(|_, _| {}))?),
    };
    Ok(NearDefect::Map(NearMap::new(map, element.raceway_radius)))
}

fn near_love(scene: &Scene, surface: &Surface) -> Result<NearDefect, SimulationError> {
    let element = ElementOnRaceway::outer(&scene.bearing);
    let (contact, knots, flats) = MapPlan::new(surface, element, map_specification(scene))?.into_love();
    Ok(NearDefect::Love(Box::new(NearLove::new(contact, &knots, flats, element.raceway_radius))))
}

/// The equations' parameters, with what the contact law needs near the defect.
pub fn build_model(
    scene: &Scene,
    surface: Option<&Surface>,
    map: Option<&Arc<ContactMap>>,
) -> Result<Model, SimulationError> {
    let near = surface
        .map(|surface| match (scene.contact.law, surface) {
            (ContactLaw::Hertz, Surface::Profile(profile)) => Ok(NearDefect::Hertz(RigidPath::new(
                profile.points(),
                scene.bearing.element_radius(),
                scene.bearing.outer_raceway_radius(),
            )?)),
            (ContactLaw::Hertz, Surface::Topography(_)) => {
                Err(SimulationError::LawNotAvailable { law: scene.contact.law })
            }
            (ContactLaw::Map, _) => near_map(scene, surface, map),
            (ContactLaw::Love, _) => near_love(scene, surface),
        })
        .transpose()?;
    let placed = near.zip(scene.defect.as_ref()).map(|(surface, defect)| Placed { surface, centre: defect.angle });
    Ok(Model::new(scene, placed))
}
