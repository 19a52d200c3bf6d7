//! From a scene and the parameters that a host has set to the model that is stepped.

use std::sync::Arc;

use super::SimulationError;
use super::quantity::{Parameter, Quantity, RingName};
use super::variables::{Kind, Variable};
use crate::contact::contact_maps::ContactMaps;
use crate::contact::flat_stretches::check_ends;
use crate::contact::map::ContactMap;
use crate::contact::map_plan::MapPlan;
use crate::contact::map_specification::{MapSpecification, Runner, Sequential};
use crate::contact::near_defect::{NearDefect, NearLove, NearMap};
use crate::contact::raceway_grid::{ElementOnRaceway, Resolution};
use crate::contact::rigid_path::RigidPath;
use crate::contact::rolling::{RacewaySide, Rolling};
use crate::dynamics::drive::Frame;
use crate::dynamics::model::Model;
use crate::dynamics::raceway::{DefectiveElement, Defects};
use crate::geometry::hertz_constant::HertzConstants;
use crate::scene::{ContactLaw, Damping, DefectOn, Ring, Scene};
use crate::surface::Surface;
use std::f64::consts::{PI, TAU};

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
            Parameter::SpinSlip => changed.cage.spin_slip = value,
            Parameter::RingInitialAngle(RingName::Shaft) => changed.shaft_initial_angle = value,
            Parameter::RingInitialAngle(RingName::Housing) => changed.housing_initial_angle = value,
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

/// The raceways that a scene's defect meets, the inner one first.
fn sides(scene: &Scene) -> &'static [RacewaySide] {
    match scene.defect.as_ref().map(|defect| defect.on) {
        None => &[],
        Some(DefectOn::Outer) => &[RacewaySide::Outer],
        Some(DefectOn::Inner) => &[RacewaySide::Inner],
        Some(DefectOn::Element { .. }) => &[RacewaySide::Inner, RacewaySide::Outer],
    }
}

/// What the contact map of a scene covers on one raceway: forces up to `contact.largest_force_n`, or else four times
/// the static force on the most loaded element, 5 F/Z (Stribeck), and at least 1000 N. Outside Δ counts the rings' and
/// seats' compliance as well. An accuracy that the scene asks for is held; the usual one may be missed, in defects
/// deeper than they are long, by what `TOLERATED` says.
pub fn map_specification(scene: &Scene, side: RacewaySide) -> MapSpecification {
    let (force, hertz) = (largest_force(scene), HertzConstants::of(&scene.bearing));
    let (stiffness, compliance) = match side {
        RacewaySide::Inner => (hertz.inner, 0.0),
        RacewaySide::Outer => (hertz.outer, scene.bearing.outer_compliance),
    };
    let usual = MapSpecification::new(libm::pow(force / stiffness, 2.0 / 3.0) + compliance * force);
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

/// Computes the contact maps of a scene, `None` where its law needs none. `runner` says on how many cores.
///
/// # Errors
/// Where a contact cannot be solved or the accuracy is not reached.
pub fn build_map(
    scene: &Scene,
    surface: &Surface,
    runner: &mut impl Runner,
) -> Result<Option<ContactMaps>, SimulationError> {
    if scene.contact.law != ContactLaw::Map {
        return Ok(None);
    }
    let maps = sides(scene).iter().map(|&side| {
        ContactMap::build(surface, ElementOnRaceway::of(&scene.bearing, side), map_specification(scene, side), runner)
    });
    Ok(Some(ContactMaps::new(maps.collect::<Result<Vec<_>, _>>()?)))
}

/// Fingerprint of all that the contact maps of a scene depend on.
pub fn map_fingerprint(scene: &Scene, surface: &Surface) -> u64 {
    let each: Vec<u64> = sides(scene).iter().map(|&side| fingerprint_on(scene, surface, side)).collect();
    ContactMaps::fingerprint_of(&each)
}

fn fingerprint_on(scene: &Scene, surface: &Surface, side: RacewaySide) -> u64 {
    let element = ElementOnRaceway::of(&scene.bearing, side);
    ContactMap::fingerprint_of(surface, element, map_specification(scene, side))
}

/// Maps that were stored with the scene; refused when they are damaged or belong to something else.
pub fn stored_map(scene: &Scene, surface: &Surface, bytes: &[u8]) -> Result<ContactMaps, SimulationError> {
    Ok(ContactMaps::from_bytes(bytes, map_fingerprint(scene, surface))?)
}

/// The surface near the defect in contact with one raceway, of number `index` among those that it meets.
fn near(
    scene: &Scene,
    surface: &Surface,
    stored: Option<&Arc<ContactMaps>>,
    (index, side): (usize, RacewaySide),
) -> Result<NearDefect, SimulationError> {
    let on_element = matches!(scene.defect.as_ref().map(|defect| defect.on), Some(DefectOn::Element { .. }));
    let rolling = Rolling::of(&scene.bearing, side, on_element);
    let (element, specification) = (ElementOnRaceway::of(&scene.bearing, side), map_specification(scene, side));
    let near = match (scene.contact.law, surface) {
        (ContactLaw::Hertz, Surface::Profile(profile)) => NearDefect::Hertz(RigidPath::new(profile.points(), rolling)?),
        (ContactLaw::Hertz, Surface::Topography(_)) => {
            return Err(SimulationError::LawNotAvailable { law: scene.contact.law });
        }
        (ContactLaw::Map, _) => {
            let wanted = fingerprint_on(scene, surface, side);
            let map = match stored.and_then(|stored| stored.get(index)) {
                Some(map) if map.fingerprint() == wanted => Arc::clone(map),
                _ => Arc::new(ContactMap::build(surface, element, specification, &mut Sequential(|_, _| {}))?),
            };
            NearDefect::Map(NearMap::new(map, rolling.bearer_radius()))
        }
        (ContactLaw::Love, _) => {
            let (contact, knots, flats) = MapPlan::new(surface, element, specification)?.into_love();
            NearDefect::Love(Box::new(NearLove::new(contact, &knots, flats, rolling.bearer_radius())))
        }
    };
    let (knots, radius) = (near.knots(), rolling.bearer_radius());
    if let (Some(first), Some(last)) = (knots.first(), knots.last()) {
        // The contact's own check is for a raceway; an element is shorter around.
        check_ends(surface.extent(), (first * radius, last * radius), radius, "where contacts reach it")?;
    }
    Ok(near)
}

/// The equations' parameters, with what the contact law needs near the defect.
pub fn build_model(
    scene: &Scene,
    surface: Option<&Surface>,
    map: Option<&Arc<ContactMaps>>,
) -> Result<Model, SimulationError> {
    let (Some(surface), Some(defect)) = (surface, &scene.defect) else { return Ok(Model::smooth(scene)) };
    let near = |index: usize, side| near(scene, surface, map, (index, side));
    let (mut inner, mut outer) = (Defects::new(Frame::Shaft, []), Defects::new(Frame::Housing, []));
    let mut defective = Vec::new();
    match defect.on {
        DefectOn::Inner => inner = Defects::new(Frame::Shaft, [(near(0, RacewaySide::Inner)?, defect.angle)]),
        DefectOn::Outer => outer = Defects::new(Frame::Housing, [(near(0, RacewaySide::Outer)?, defect.angle)]),
        DefectOn::Element { element, .. } => {
            // At the start the defect is at its angle from the direction of its element, and the spin is counted from
            // there; the inner raceway is met with the opposite side.
            let facing = scene.cage.initial_angle + element as f64 * TAU / scene.bearing.element_count as f64;
            let centre = facing + defect.angle;
            let defects = [
                Defects::new(Frame::Spin, [(near(0, RacewaySide::Inner)?, centre - PI)]),
                Defects::new(Frame::Spin, [(near(1, RacewaySide::Outer)?, centre)]),
            ];
            defective.push(DefectiveElement { element, defects });
        }
    }
    Ok(Model::new(scene, [inner, outer], defective))
}
