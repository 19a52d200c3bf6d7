//! From a scene and the surfaces of its defects to the parameters of its equations.

use std::borrow::Cow;
use std::sync::Arc;

use super::across::Across;
use super::arrangement::{PlacedSurface, placed_surfaces, sides};
use super::maps::{NeededMap, map_fingerprint};
use super::parameters::with_parameters;
use super::specification::{map_specification, prepared};
use super::tracks::{about, defect_radius, element_on_track, on_track, rolling_on_track, with_operating_angle};
use super::waves::check_waves;
use crate::contact::across::Slices;
use crate::contact::love::{Arcs, check_ends};
use crate::contact::map::{ContactMap, ContactMaps, MapPlan, Sequential};
use crate::contact::near_defect::{NearDefect, NearLove, NearMap};
use crate::contact::rolled_path::RigidPath;
use crate::contact::rolling::RacewaySide;
use crate::dynamics::parameters::{Centred, DefectiveElement, Defects, Excitation, Frame, Model, WholeAngle};
use crate::scene::{ContactLaw, DefectOn, DegreesOfFreedom, Gyroscopic, Scene};
use crate::simulation::SimulationError;
use crate::simulation::interface::Quantity;
use crate::surface::roller_profile::unread;
use crate::surface::{Surface, SurfaceError, with_roller_profile};
use std::f64::consts::{PI, TAU};

/// What a simulation is set up from. It does not change.
#[derive(Debug, Clone)]
pub(in crate::simulation) struct Setup {
    pub(in crate::simulation) scene: Arc<Scene>,
    pub(in crate::simulation) surfaces: Arc<[Surface]>,
    /// The contact maps stored with the scene.
    map: Option<Arc<ContactMaps>>,
}

impl Setup {
    /// Reads the `profiles` of the scene's defects and crowns; the stored maps are to be those of this scene.
    pub(in crate::simulation) fn new<'p>(
        scene: Scene,
        profiles: impl IntoIterator<Item = &'p str>,
        map: Option<Arc<ContactMaps>>,
    ) -> Result<Self, SimulationError> {
        scene.check()?;
        let profiles: Vec<&str> = profiles.into_iter().collect();
        let scene = with_roller_profile(&scene, profiles.iter().copied())?;
        let surfaces = Surface::load_all(&scene, profiles)?;
        let scene = with_operating_angle(&scene).into_owned();
        let map = map.filter(|_| !surfaces.is_empty());
        if let Some(map) = &map {
            map.check_fingerprint(map_fingerprint(&scene, &surfaces)?)?;
        }
        Ok(Self { scene: Arc::new(scene), surfaces: surfaces.into(), map })
    }

    /// The scene's model, and whether it is complete: what takes long is left to the initialization, as the host may
    /// change parameters before it.
    pub(in crate::simulation) fn first_model(&self) -> Result<(Model, bool), SimulationError> {
        let Self { scene, surfaces, map } = self;
        let is_complete = surfaces.is_empty()
            || match scene.contact.law {
                ContactLaw::Hertz => true,
                ContactLaw::Map => map.is_some(),
                ContactLaw::Love => false,
            };
        if !is_complete {
            // Overlaps and what does not reach a track are refused now, not when the model is built.
            for placed in placed_surfaces(scene, surfaces)? {
                sides(placed.on).iter().try_for_each(|&side| Across::of(scene, &placed, side).map(|_| ()))?;
            }
        }
        Ok((build_model(scene, if is_complete { surfaces } else { &[] }, map.as_ref())?, is_complete))
    }

    /// The model with the parameters that a host has set.
    pub(in crate::simulation) fn model(
        &self,
        quantities: &[Quantity],
        reals: &[f64],
        integers: &[i32],
    ) -> Result<Model, SimulationError> {
        let scene = with_parameters(&self.scene, quantities, reals, integers)?;
        let mut surfaces = Cow::Borrowed(&*self.surfaces);
        for (index, (defect, before)) in scene.defects.iter().zip(&self.scene.defects).enumerate() {
            if defect.shape != before.shape {
                // Only a spall's sizes can be set, and it has no profile.
                surfaces.to_mut()[index] = Surface::load(defect, None, &self.scene.bearing)?;
            }
        }
        build_model(&scene, &surfaces, self.map.as_ref())
    }

    /// Refuses oil films that are too thick at an instant.
    pub(in crate::simulation) fn check_films(
        &self,
        model: &Model,
        excitation: &Excitation,
        tau: f64,
    ) -> Result<(), SimulationError> {
        let Some(films) = model.films_at(excitation, tau) else { return Ok(()) };
        let (clearance, limit) = (model.clearance(Some(&films)), self.scene.bearing.smallest_radial_clearance());
        if !(clearance >= limit) {
            return Err(SimulationError::ThickFilms {
                films_um: films.together() * 1e6,
                speed_hz: excitation.relative_speed.at(tau) / TAU,
                clearance_um: clearance * 1e6,
                limit_um: limit * 1e6,
            });
        }
        Ok(())
    }
}

/// A placed surface in contact with one raceway; a map that is not among those stored is computed, once.
fn near(
    scene: &Scene,
    placed: &PlacedSurface,
    side: RacewaySide,
    stored: Option<&Arc<ContactMaps>>,
    computed: &mut Vec<Arc<ContactMap>>,
) -> Result<NearDefect, SimulationError> {
    let surface = &*on_track(&placed.surface, &scene.bearing, placed.on);
    let bearer = defect_radius(&scene.bearing, placed.on);
    let (rolling, shortened) = rolling_on_track(&scene.bearing, side, matches!(placed.on, DefectOn::Element { .. }));
    let across = Across::of(scene, placed, side)?;
    let near = match (scene.contact.law, surface) {
        (ContactLaw::Hertz, Surface::Profile(profile)) => {
            NearDefect::Hertz(RigidPath::new(profile.points(), rolling)?.turned_slower(shortened))
        }
        (ContactLaw::Hertz, Surface::Topography(_)) => {
            return Err(SimulationError::LawNotAvailable { law: scene.contact.law });
        }
        (ContactLaw::Map, _) => {
            let wanted = NeededMap::all(scene, placed, side)?;
            let maps = wanted.iter().map(|wanted| made(wanted, stored, computed)).collect::<Result<Vec<_>, _>>()?;
            let near = NearMap::new(Arc::clone(&maps[0]), bearer);
            NearDefect::Map(match across {
                Some(Across { ends, distance, .. }) => near.with_slices(Slices::new(maps, ends, distance)),
                None => near,
            })
        }
        (ContactLaw::Love, _) => {
            let (element, specification) = (element_on_track(&prepared(scene), side), map_specification(scene, side));
            let surface = about(Cow::Borrowed(surface), across.map(|across| across.track));
            let near = NearLove::new(MapPlan::new(&surface, element, specification)?.into_love(), bearer);
            NearDefect::Love(Box::new(match across {
                Some(across) => near.across(across.track),
                None => near,
            }))
        }
    };
    let (knots, radius) = (near.knots(), bearer);
    if let (Some(first), Some(last)) = (knots.first(), knots.last()) {
        // The contact's own check is for a raceway; an element is shorter around.
        let felt = Arcs { first: first * radius, last: last * radius };
        check_ends(Arcs::of(surface), felt, radius, "where contacts reach it")?;
    }
    Ok(near)
}

/// A map that is stored, was made before or is made now.
fn made(
    wanted: &NeededMap,
    stored: Option<&Arc<ContactMaps>>,
    computed: &mut Vec<Arc<ContactMap>>,
) -> Result<Arc<ContactMap>, SimulationError> {
    let known = stored.and_then(|stored| stored.find(wanted.fingerprint));
    let map = match known.or_else(|| computed.iter().find(|map| map.fingerprint() == wanted.fingerprint)) {
        Some(map) => Arc::clone(map),
        None => {
            let map = Arc::new(wanted.build(&mut Sequential(|_, _| {}))?);
            computed.push(Arc::clone(&map));
            map
        }
    };
    Ok(if wanted.moved == [0.0; 2] { map } else { Arc::new(map.with_flanks_moved(wanted.moved)) })
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
    if scene.film.is_some() && scene.bearing.degrees_of_freedom != DegreesOfFreedom::Two {
        let given = scene.bearing.degrees_of_freedom.count();
        return Err(SimulationError::NotInSpace { what: "the oil film, [film],", given });
    }
    if scene.bearing.gyroscopic != Gyroscopic::None && scene.housing_speed.is_some() {
        return Err(SimulationError::CoupleOfTurningHousing);
    }
    check_waves(scene)?;
    if surfaces.is_empty() {
        return Ok(Model::smooth(scene));
    }
    let mut computed = Vec::new();
    let (mut rings, mut defective) = ([Vec::new(), Vec::new()], Vec::<DefectiveElement>::new());
    for placed in &placed_surfaces(scene, surfaces)? {
        let mut near = |side| near(scene, placed, side, map, &mut computed);
        match placed.on {
            DefectOn::Inner => rings[0].push(Centred { surface: near(RacewaySide::Inner)?, centre: placed.centre }),
            DefectOn::Outer => rings[1].push(Centred { surface: near(RacewaySide::Outer)?, centre: placed.centre }),
            DefectOn::Element { element, .. } => {
                // At the start the defect is at its angle from the direction of its element, and the spin is counted
                // from there; the inner raceway is met with the opposite side.
                // In an irregular cage it is the model that knows where that is.
                let start = WholeAngle::in_first_turn(scene.cage.initial_angle);
                let facing = Model::smooth(scene).element_angle(element, start);
                let centre = facing + placed.centre;
                let both = [
                    Centred { surface: near(RacewaySide::Inner)?, centre: centre - PI },
                    Centred { surface: near(RacewaySide::Outer)?, centre },
                ];
                match defective.iter_mut().find(|other| other.element == element) {
                    Some(other) => {
                        other.defects.iter_mut().zip(both).for_each(|(defects, one)| defects.add(one));
                    }
                    None => {
                        let first = scene.first_defect_of(element).map_or(placed.centre, |k| scene.defects[k].angle);
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
