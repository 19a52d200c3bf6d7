//! The contact maps that a scene needs, made or taken from where they are stored.

use std::borrow::Cow;

use super::across::Across;
use super::arrangement::{PlacedSurface, placed_surfaces, sides};
use super::specification::{map_specification, prepared};
use super::tracks::{about, element_on_track, on_track, with_operating_angle};
use crate::contact::element_on_raceway::ElementOnRaceway;
use crate::contact::map::{ContactMap, ContactMaps, Flanks, MapSpecification, Runner};
use crate::contact::rolling::RacewaySide;
use crate::scene::{ContactLaw, Scene};
use crate::simulation::SimulationError;
use crate::surface::Surface;

/// A contact map that a scene needs.
#[derive(Debug, Clone)]
pub struct NeededMap<'s> {
    surface: Cow<'s, Surface>,
    element: ElementOnRaceway,
    specification: MapSpecification,
    /// How far (m) its flanks before and behind the middle are moved along the arc where the defect has them.
    pub(super) moved: [f64; 2],
    /// Fingerprint of all that it depends on.
    pub fingerprint: u64,
}

impl<'s> NeededMap<'s> {
    /// Those of a surface on one raceway, as an element of the [`prepared`] bearing meets it: one, or the slices of a
    /// topography that varies across the groove.
    ///
    /// # Errors
    /// A topography that does not reach the track.
    pub(super) fn all(
        scene: &Scene,
        placed: &PlacedSurface<'s>,
        side: RacewaySide,
    ) -> Result<Vec<Self>, SimulationError> {
        Ok(match Across::of(scene, placed, side)? {
            Some(across) => across.slices().map(|place| Self::of(scene, placed, side, Some(place))).collect(),
            None => vec![Self::of(scene, placed, side, None)],
        })
    }

    /// That of a surface, about a place across the groove (m) where one is given.
    fn of(scene: &Scene, placed: &PlacedSurface<'s>, side: RacewaySide, place: Option<f64>) -> Self {
        let bearing = prepared(scene);
        let (element, specification) = (element_on_track(&bearing, side), map_specification(scene, side));
        let surface = match on_track(&placed.surface, &scene.bearing, placed.on) {
            Cow::Borrowed(_) => placed.surface.clone(),
            Cow::Owned(stretched) => Cow::Owned(stretched),
        };
        let surface = about(surface, place);
        let flanks = Some(&*surface).filter(|_| scene.contact.flank_map);
        let (surface, moved) = match flanks.and_then(|surface| Flanks::of(surface, element, specification)) {
            Some(Flanks { surface, moved }) => (Cow::Owned(surface), moved),
            None => (surface, [0.0; 2]),
        };
        let fingerprint = ContactMap::fingerprint_of(&surface, element, specification);
        Self { surface, element, specification, moved, fingerprint }
    }

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
/// Defects that overlap; a topography that does not reach the track.
pub fn needed_maps<'s>(scene: &Scene, surfaces: &'s [Surface]) -> Result<Vec<NeededMap<'s>>, SimulationError> {
    let scene = &*with_operating_angle(scene);
    let mut maps: Vec<NeededMap> = Vec::new();
    for placed in placed_surfaces(scene, surfaces)? {
        for &side in sides(placed.on) {
            for map in NeededMap::all(scene, &placed, side)? {
                if !maps.iter().any(|known| known.fingerprint == map.fingerprint) {
                    maps.push(map);
                }
            }
        }
    }
    Ok(maps)
}

/// Computes the contact maps of a scene with these surfaces of its defects, `None` where its law needs none. `runner`
/// says on how many cores.
///
/// Maps take seconds, and serve every simulation of the scene: keep their bytes, in a file or in memory, and hand them
/// to [`Simulation::with_map`](crate::simulation::Simulation::with_map) at each start.
/// ```
/// use brinell::contact::map::Sequential;
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
