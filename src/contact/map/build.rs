//! How a [`ContactMap`] is made, and the fingerprint that ties it to its inputs.

use std::hash::Hasher;

use crate::numerics::checksum::Checksum;
use crate::surface::Surface;

use super::lookup::ContactMap;
use super::plan::MapPlan;
use super::specification::{MapSpecification, Runner};
use crate::contact::element_on_raceway::{Across, ElementOnRaceway};
use crate::contact::error::ContactError;
use crate::contact::rolling::RacewaySide;

/// The map follows the grid, and the grid's own steps may be larger than the accuracy: a map is refused when its error
/// is so many times what was asked for, unless the specification tolerates more.
pub const REFUSED: f64 = 1.5;

impl ContactMap {
    /// Map for an element over `surface`.
    ///
    /// # Errors
    /// [`ContactError::BadInput`] for impossible inputs, [`ContactError::MapNotAccurate`] when even the finest nodes
    /// miss the accuracy by more than is tolerated; what was reached is in [`ContactMap::accuracy`].
    pub fn build(
        surface: &Surface,
        element: ElementOnRaceway,
        specification: MapSpecification,
        runner: &mut impl Runner,
    ) -> Result<Self, ContactError> {
        let map = MapPlan::new(surface, element, specification)?.build(runner)?;
        if map.accuracy.max() > specification.tolerated.unwrap_or(REFUSED * specification.accuracy) {
            return Err(ContactError::MapNotAccurate {
                achieved: map.accuracy.max(),
                requested: specification.accuracy,
                nodes: map.nodes(),
            });
        }
        Ok(map)
    }

    /// Fingerprint of all inputs: a stored map with another one belongs to something else.
    pub fn fingerprint_of(surface: &Surface, element: ElementOnRaceway, specification: MapSpecification) -> u64 {
        let mut hash = Checksum::default();
        hash.write(env!("CARGO_PKG_VERSION").as_bytes());
        let mut number = |value: f64| hash.write(&value.to_bits().to_le_bytes());
        for value in [element.element_radius, element.raceway_radius] {
            number(value);
        }
        match element.across {
            Across::Groove(radius) => number(radius),
            Across::Roller { length, crowned } => {
                // No groove is so narrow.
                number(if crowned { -2.0 } else { -1.0 });
                number(length);
            }
        }
        // Maps of the outer raceway are older than those of the inner one, and their fingerprints stay.
        if element.raceway == RacewaySide::Inner {
            number(-1.0);
        }
        number(specification.largest_approach);
        number(specification.accuracy);
        number(specification.resolution.columns as f64);
        number(specification.resolution.rows as f64);
        // Maps of half-spaces are older, and their fingerprints stay.
        if let Some(edges) = specification.edges {
            number(edges.factor);
            number(edges.deepest);
        }
        match surface {
            Surface::Profile(profile) => {
                for &(arc, depth) in profile.points() {
                    number(arc);
                    number(depth);
                }
            }
            Surface::Topography(topography) => {
                for values in [topography.arcs(), topography.axials(), topography.depths()] {
                    number(values.len() as f64);
                    for &value in values {
                        number(value);
                    }
                }
            }
        }
        hash.finish()
    }
}
