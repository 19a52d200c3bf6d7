//! Where across the groove a topography of a ring is met by balls in space.
//!
//! The track lies at the place η_n, the groove's arc from its bottom to the operating angle α_n: r_go α_n outside and
//! −r_gi α_n inside, the other way where the bearing is pushed the other way. Law `love` knows the surface everywhere
//! about it, law `map` on slices beside each other, of which the middle one is on the track. On an element the track
//! is the middle row wherever the ball runs.

use super::arrangement::PlacedSurface;
use super::specification::{map_specification, prepared};
use super::tracks::{angle_of, element_on_track};
use crate::contact::rolling::RacewaySide;
use crate::scene::{DefectOn, DegreesOfFreedom, Scene};
use crate::simulation::SimulationError;
use crate::surface::Surface;

/// Slices on either side of the track.
const BESIDE: usize = 3;
/// Distance of two slices over the half-length across the groove of the largest contact. It is a quarter of that of a
/// contact of a quarter of the force, 0.157, at the most.
const APART: f64 = 0.125;

/// Places (m) at which a surface is met across the groove.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Across {
    /// η_n
    pub(super) track: f64,
    /// First and last place for which law `map` prepares it.
    pub(super) ends: [f64; 2],
    /// Distance of its slices.
    pub(super) distance: f64,
    /// Whether it varies there; one slice does where it does not.
    varies: bool,
}

impl Across {
    /// Where a surface is met on one raceway; `None` of one that is met the same everywhere across: a profile's, an
    /// element's, and each one in the plane.
    ///
    /// # Errors
    /// A topography that does not reach the track, wherever it is met.
    pub(super) fn of(
        scene: &Scene,
        placed: &PlacedSurface,
        side: RacewaySide,
    ) -> Result<Option<Self>, SimulationError> {
        check_reach(scene, placed.on, &placed.surface)?;
        let Surface::Topography(topography) = &*placed.surface else { return Ok(None) };
        let in_plane = scene.bearing.degrees_of_freedom == DegreesOfFreedom::Two;
        if in_plane || matches!(placed.on, DefectOn::Element { .. }) {
            return Ok(None);
        }
        let track = track_across(scene, placed.on);
        let (element, specification) = (element_on_track(&prepared(scene), side), map_specification(scene, side));
        let [_, half] = element.contact_half_axes(specification.largest_approach);
        // Whole rows of the grids, so that all slices are solved on the same cells.
        let row = 2.0 * half / specification.resolution.rows as f64;
        let distance = (APART * half / row).round().max(1.0) * row;
        let beside = BESIDE as f64 * distance;
        // A contact of the largest force, a fifth wider as its grid is, and rounded up to a row.
        let felt = beside + 1.2 * half + 2.0 * row;
        let varies = topography.varies_across([track - felt, track + felt]);
        Ok(Some(Self { track, ends: [track - beside, track + beside], distance, varies }))
    }

    /// Place of each slice (m).
    pub(super) fn slices(self) -> impl Iterator<Item = f64> {
        let (first, count) = if self.varies { (self.ends[0], 2 * BESIDE + 1) } else { (self.track, 1) };
        (0..count).map(move |k| first + k as f64 * self.distance)
    }
}

/// Place η_n (m) of the track across the groove of a ring at the scene's operating angle; 0 in the plane and on an
/// element.
pub fn track_across(scene: &Scene, on: DefectOn) -> f64 {
    let angle = angle_of(&scene.bearing) * pushed_way(scene);
    let [inner, outer] = scene.bearing.groove_radii();
    match on {
        // Radii of rollers' raceways across are infinite.
        _ if angle == 0.0 => 0.0,
        DefectOn::Outer => outer * angle,
        DefectOn::Inner => -(inner * angle),
        DefectOn::Element { .. } => 0.0,
    }
}

/// Sign of the contact angles: that of a free contact angle or of an operating angle below 0, else the way in which the
/// inner ring is pushed.
fn pushed_way(scene: &Scene) -> f64 {
    let (bearing, [shaft, housing]) = (&scene.bearing, [&scene.shaft.axial, &scene.housing.axial]);
    let push = match (bearing.contact_angle, bearing.operating_angle) {
        (Some(free), _) => free,
        (None, Some(angle)) if angle < 0.0 => angle,
        _ => shaft.load + shaft.preload - (housing.load - housing.preload),
    };
    if push < 0.0 { -1.0 } else { 1.0 }
}

/// First and last place (m) across a body on which elements run: a ball's track, or the length of a roller.
pub fn track_width(scene: &Scene, on: DefectOn) -> [f64; 2] {
    let half = scene.bearing.roller().map_or(0.0, |roller| 0.5 * roller.length);
    let track = track_across(scene, on);
    [track - half, track + half]
}

/// Refuses a topography beside which elements run: it would be a smooth raceway.
///
/// # Errors
/// Rows of which none is on the track.
pub fn check_reach(scene: &Scene, on: DefectOn, surface: &Surface) -> Result<(), SimulationError> {
    let Surface::Topography(topography) = surface else { return Ok(()) };
    let (axials, track) = (topography.axials(), track_width(scene, on));
    let rows = [axials[0], axials[axials.len() - 1]];
    if rows[0] <= track[1] && track[0] <= rows[1] {
        return Ok(());
    }
    let body = match on {
        DefectOn::Outer => "outer ring",
        DefectOn::Inner => "inner ring",
        DefectOn::Element { .. } => "element",
    };
    Err(SimulationError::OffTopography { body, track_mm: track.map(|at| at * 1e3), rows_mm: rows.map(|at| at * 1e3) })
}
