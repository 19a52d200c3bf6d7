//! From a scene and the parameters that a host has set to the model that is stepped.

use std::borrow::Cow;
use std::sync::Arc;

use super::SimulationError;
pub use super::arrangement::largest_force;
use super::arrangement::{Spot, arranged, largest_approach, sides, softness_of_edges};
use super::quantity::{Parameter, Quantity, RingName};
use super::variables::{Kind, Variable};
use crate::contact::contact_maps::ContactMaps;
use crate::contact::element_on_raceway::ElementOnRaceway;
use crate::contact::flat_stretches::{Arcs, check_ends};
use crate::contact::map::ContactMap;
use crate::contact::map_plan::MapPlan;
use crate::contact::map_specification::{MapSpecification, Runner, Sequential};
use crate::contact::near_defect::{NearDefect, NearLove, NearMap};
use crate::contact::raceway_grid::Resolution;
use crate::contact::rigid_path::RigidPath;
use crate::contact::rolling::{RacewaySide, Rolling};
use crate::dynamics::drive::Frame;
use crate::dynamics::kinematics::CageState;
use crate::dynamics::model::Model;
use crate::dynamics::raceway::{Centred, DefectiveElement, Defects};
use crate::scene::{Bearing, ContactLaw, Damping, DefectOn, Ring, Scene};
use crate::surface::roller_profile::unread;
use crate::surface::{Surface, SurfaceError};
use std::f64::consts::PI;

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
            Parameter::DefectAngle(index) => changed.defects[index].angle = value,
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

/// Contact maps are made for clearances that are multiples of this (µm). What lies between changes a raceway's radius
/// by a ten thousandth, and forces by less than a hundredth of a map's own error; a bearing whose clearance is swept
/// has few maps then.
const CLEARANCE_UM: f64 = 5.0;

/// The bearing for which the contacts near a scene's defects are prepared.
fn prepared(scene: &Scene) -> Bearing {
    let mut bearing = scene.bearing.clone();
    if scene.contact.law == ContactLaw::Map {
        // In micrometres, as files give it: a multiple keeps its bits.
        bearing.radial_clearance = CLEARANCE_UM * (bearing.radial_clearance * 1e6 / CLEARANCE_UM).round() / 1e6;
    }
    bearing
}

/// What the contact map of a scene covers on one raceway: forces up to the [`largest_force`]. Outside Δ counts the
/// rings' and seats' compliance as well. An accuracy that the scene asks for is held; the usual one may be missed, in
/// defects deeper than they are long, by what `TOLERATED` says.
pub fn map_specification(scene: &Scene, side: RacewaySide) -> MapSpecification {
    let largest = largest_approach(&prepared(scene), side, largest_force(scene));
    let usual = if scene.bearing.roller().is_some() {
        MapSpecification::of_roller(largest)
    } else {
        MapSpecification::new(largest)
    };
    MapSpecification {
        accuracy: scene.contact.map_accuracy.unwrap_or(usual.accuracy),
        tolerated: if scene.contact.map_accuracy.is_none() { Some(TOLERATED) } else { None },
        resolution: scene
            .contact
            .cells
            .map_or(usual.resolution, |[columns, rows]| Resolution { columns: columns as usize, rows: rows as usize }),
        edges: softness_of_edges(scene),
        ..usual
    }
}

/// A contact map that a scene needs.
#[derive(Debug, Clone)]
pub struct NeededMap<'s> {
    surface: Cow<'s, Surface>,
    element: ElementOnRaceway,
    specification: MapSpecification,
    /// Fingerprint of all that it depends on.
    pub fingerprint: u64,
}

impl NeededMap<'_> {
    /// Computes it. `runner` says on how many cores.
    ///
    /// # Errors
    /// Where a contact cannot be solved or the accuracy is not reached.
    pub fn build(&self, runner: &mut impl Runner) -> Result<ContactMap, SimulationError> {
        Ok(ContactMap::build(&self.surface, self.element, self.specification, runner)?)
    }
}

/// The contact maps that a scene with these surfaces of its defects needs under law `map`: each surface on each raceway
/// that it meets, equal ones once.
///
/// # Errors
/// Defects that overlap.
pub fn needed_maps<'s>(scene: &Scene, surfaces: &'s [Surface]) -> Result<Vec<NeededMap<'s>>, SimulationError> {
    let mut maps: Vec<NeededMap> = Vec::new();
    let bearing = prepared(scene);
    for spot in arranged(scene, surfaces)? {
        for &side in sides(spot.on) {
            let (element, specification) = (ElementOnRaceway::of(&bearing, side), map_specification(scene, side));
            let fingerprint = ContactMap::fingerprint_of(&spot.surface, element, specification);
            if !maps.iter().any(|map| map.fingerprint == fingerprint) {
                maps.push(NeededMap { surface: spot.surface.clone(), element, specification, fingerprint });
            }
        }
    }
    Ok(maps)
}

/// Computes the contact maps of a scene with these surfaces of its defects, `None` where its law needs none. `runner`
/// says on how many cores.
///
/// Maps take seconds, and serve every simulation of the scene: keep their bytes, in a file or in memory, and hand them
/// to [`Simulation::with_map`](super::Simulation::with_map) at each start.
/// ```
/// use brinell::contact::map_specification::Sequential;
/// use brinell::scene::{Bearing, Scene};
/// use brinell::simulation::Simulation;
/// use brinell::simulation::setup::build_map;
/// use brinell::surface::Surface;
///
/// // Coarse, so that it takes a moment here: leave cells and accuracy out.
/// let scene = Scene::builder(Bearing::steel_balls(9, 7.94e-3, 39.04e-3))
///     .shaft_load([0.0, -1500.0])
///     .spall(-std::f64::consts::FRAC_PI_2, 2e-3, 50e-6)
///     .contact_cells([8, 8])
///     .map_accuracy(0.1)
///     .build()?;
/// let surfaces = Surface::load_all(&scene, None)?;
/// // One column after the other; the closure may show how far it is.
/// let map = build_map(&scene, &surfaces, &mut Sequential(|_done, _of| {}))?;
/// let bytes = map.map(|map| map.to_bytes());
///
/// let mut simulation = Simulation::with_map(scene, None, bytes.as_deref())?;
/// simulation.initialize(0.0)?;
/// assert!(simulation.get("shaft.y")? < 0.0);
/// # Ok::<(), brinell::Error>(())
/// ```
///
/// # Errors
/// Defects that overlap; where a contact cannot be solved or the accuracy is not reached.
pub fn build_map(
    scene: &Scene,
    surfaces: &[Surface],
    runner: &mut impl Runner,
) -> Result<Option<ContactMaps>, SimulationError> {
    if scene.contact.law != ContactLaw::Map || surfaces.is_empty() {
        return Ok(None);
    }
    let maps = needed_maps(scene, surfaces)?.iter().map(|map| map.build(runner)).collect::<Result<Vec<_>, _>>()?;
    Ok(Some(ContactMaps::new(maps)))
}

/// Fingerprint of all that the contact maps of a scene depend on.
///
/// # Errors
/// Defects that overlap.
pub fn map_fingerprint(scene: &Scene, surfaces: &[Surface]) -> Result<u64, SimulationError> {
    let each: Vec<u64> = needed_maps(scene, surfaces)?.iter().map(|map| map.fingerprint).collect();
    Ok(ContactMaps::fingerprint_of(&each))
}

/// Maps that were stored with the scene; refused when they are damaged or belong to something else.
pub fn stored_map(scene: &Scene, surfaces: &[Surface], bytes: &[u8]) -> Result<ContactMaps, SimulationError> {
    Ok(ContactMaps::from_bytes(bytes, map_fingerprint(scene, surfaces)?)?)
}

/// The surface of a spot in contact with one raceway; a map that is not among those stored is computed, once.
fn near(
    scene: &Scene,
    spot: &Spot,
    side: RacewaySide,
    stored: Option<&Arc<ContactMaps>>,
    computed: &mut Vec<Arc<ContactMap>>,
) -> Result<NearDefect, SimulationError> {
    let surface = &*spot.surface;
    let rolling = Rolling::of(&scene.bearing, side, matches!(spot.on, DefectOn::Element { .. }));
    let (element, specification) = (ElementOnRaceway::of(&prepared(scene), side), map_specification(scene, side));
    let near = match (scene.contact.law, surface) {
        (ContactLaw::Hertz, Surface::Profile(profile)) => NearDefect::Hertz(RigidPath::new(profile.points(), rolling)?),
        (ContactLaw::Hertz, Surface::Topography(_)) => {
            return Err(SimulationError::LawNotAvailable { law: scene.contact.law });
        }
        (ContactLaw::Map, _) => {
            let wanted = ContactMap::fingerprint_of(surface, element, specification);
            let known = stored.and_then(|stored| stored.find(wanted));
            let map = match known.or_else(|| computed.iter().find(|map| map.fingerprint() == wanted)) {
                Some(map) => Arc::clone(map),
                None => {
                    let built = ContactMap::build(surface, element, specification, &mut Sequential(|_, _| {}))?;
                    let map = Arc::new(built);
                    computed.push(Arc::clone(&map));
                    map
                }
            };
            NearDefect::Map(NearMap::new(map, rolling.bearer_radius()))
        }
        (ContactLaw::Love, _) => {
            let grid = MapPlan::new(surface, element, specification)?.into_love();
            NearDefect::Love(Box::new(NearLove::new(grid, rolling.bearer_radius())))
        }
    };
    let (knots, radius) = (near.knots(), rolling.bearer_radius());
    if let (Some(first), Some(last)) = (knots.first(), knots.last()) {
        // The contact's own check is for a raceway; an element is shorter around.
        let felt = Arcs { first: first * radius, last: last * radius };
        check_ends(Arcs::of(surface), felt, radius, "where contacts reach it")?;
    }
    Ok(near)
}

/// The equations' parameters, with what the contact law needs near the defects, whose surfaces are given in the scene's
/// order; none for a model without them.
///
/// # Errors
/// Defects that overlap, and whatever keeps the contact law from being prepared for a surface.
pub fn build_model(
    scene: &Scene,
    surfaces: &[Surface],
    map: Option<&Arc<ContactMaps>>,
) -> Result<Model, SimulationError> {
    if let Some(name) = unread(scene) {
        return Err(SurfaceError::no_crown(name).into());
    }
    if surfaces.is_empty() {
        return Ok(Model::smooth(scene));
    }
    let mut computed = Vec::new();
    let (mut rings, mut defective) = ([Vec::new(), Vec::new()], Vec::<DefectiveElement>::new());
    for spot in &arranged(scene, surfaces)? {
        let mut near = |side| near(scene, spot, side, map, &mut computed);
        match spot.on {
            DefectOn::Inner => rings[0].push(Centred { surface: near(RacewaySide::Inner)?, centre: spot.centre }),
            DefectOn::Outer => rings[1].push(Centred { surface: near(RacewaySide::Outer)?, centre: spot.centre }),
            DefectOn::Element { element, .. } => {
                // At the start the defect is at its angle from the direction of its element, and the spin is counted
                // from there; the inner raceway is met with the opposite side.
                // In an irregular cage it is the model that knows where that is.
                let start = CageState::at_rest(scene.cage.initial_angle);
                let facing = Model::smooth(scene).element_angle(element, &start);
                let centre = facing + spot.centre;
                let both = [
                    Centred { surface: near(RacewaySide::Inner)?, centre: centre - PI },
                    Centred { surface: near(RacewaySide::Outer)?, centre },
                ];
                match defective.iter_mut().find(|other| other.element == element) {
                    Some(other) => {
                        other.defects.iter_mut().zip(both).for_each(|(defects, one)| defects.add(one));
                    }
                    None => {
                        let first = scene.first_defect_of(element).map_or(spot.centre, |k| scene.defects[k].angle);
                        let defects = both.map(|one| Defects::new(Frame::Spin, [one]));
                        defective.push(DefectiveElement { element, defects, mark: facing + first });
                    }
                }
            }
        }
    }
    let [inner, outer] = rings;
    Ok(Model::new(scene, [Defects::new(Frame::Shaft, inner), Defects::new(Frame::Housing, outer)], defective))
}
