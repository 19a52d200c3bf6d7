//! The flanks of a defect on the shortest floor between them on which a contact of one knows nothing of the other:
//! their map serves every defect that has these flanks, however long its floor is.

use super::lookup::{ContactMap, Stretch};
use super::plan::{PREPARED, floor_margin, strip_width};
use super::specification::MapSpecification;
use crate::contact::element_on_raceway::ElementOnRaceway;
use crate::contact::love::{flats, shallowest};
use crate::surface::Surface;

/// Cells become a little longer than asked for so that edges lie on their borders; never so much.
const LONGER_CELLS: f64 = 1.1;
/// Half the floor is a multiple of this (m), so that what rounds differently gives the same.
const FLOOR: f64 = 1e-5;

/// A surface whose floor is as short as its flanks allow.
#[derive(Debug, Clone, PartialEq)]
pub struct Flanks {
    /// The surface; arc 0 is in the middle of the floor.
    pub surface: Surface,
    /// How far (m) the flanks before and behind the floor are moved along the arc where they belong.
    pub moved: [f64; 2],
}

impl Flanks {
    /// Those of a surface under this element; `None` where its longest floor is too short, and of a topography.
    pub fn of(surface: &Surface, element: ElementOnRaceway, specification: MapSpecification) -> Option<Self> {
        let Surface::Profile(profile) = surface else { return None };
        let inside = flats(surface).into_iter().filter(|flat| flat.start.is_finite() && flat.end.is_finite());
        let floor = inside.max_by(|a, b| (a.end - a.start).total_cmp(&(b.end - b.start)))?;
        let MapSpecification { largest_approach, resolution, .. } = specification;
        let widest = 2.0 * element.contact_half_axes(PREPARED * largest_approach)[0];
        let cell = LONGER_CELLS * widest / resolution.columns.max(2) as f64;
        let margin = floor_margin(element, largest_approach, cell, floor.depth - shallowest(surface));
        let half = FLOOR * ((margin + strip_width(element, largest_approach)) / FLOOR).floor() + FLOOR;
        if floor.end - floor.start <= 2.0 * half {
            return None;
        }
        let surface = Surface::Profile(profile.with_floor([floor.start, floor.end], half));
        Some(Self { surface, moved: [floor.start + half, floor.end - half] })
    }
}

impl ContactMap {
    /// The same with what is before and behind arc 0, which lies on a floor, [moved](Flanks::moved) along the arc.
    pub fn with_flanks_moved(&self, moved: [f64; 2]) -> Self {
        let mut map = self.clone();
        let patches = map.stretches.iter_mut().filter_map(|stretch| match stretch {
            Stretch::Patch(patch) => Some(&mut patch.start),
            Stretch::Flat(_) => None,
        });
        for arc in map.knots.iter_mut().chain(patches) {
            *arc += moved[usize::from(*arc > 0.0)];
        }
        map
    }
}
