//! What the contact maps of a scene are to cover.

use super::arrangement::{largest_approach, largest_force, softness_of_edges};
use crate::contact::love::Resolution;
use crate::contact::map::{CONTINUED, MapSpecification};
use crate::contact::rolling::RacewaySide;
use crate::scene::{Bearing, ContactLaw, Scene};

/// Error of a contact map that is still taken when the scene asks for none in particular: below what a real edge's
/// shape leaves open.
const TOLERATED: f64 = 0.02;

/// Contact maps are made for clearances that are multiples of this (µm). What lies between changes a raceway's radius
/// by a ten thousandth, and forces by less than a hundredth of a map's own error; a bearing whose clearance is swept
/// has few maps then.
const CLEARANCE_UM: f64 = 5.0;

/// The bearing for which the contacts near a scene's defects are prepared.
pub(super) fn prepared(scene: &Scene) -> Bearing {
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

/// Forces (N) that belong to an approach (m) and to its limit, on the raceway whose map has that limit.
pub(in crate::simulation) fn forces_of([approach, limit]: [f64; 2], scene: &Scene) -> [f64; 2] {
    let bearing = &prepared(scene);
    let (inner, outer, largest) = (RacewaySide::Inner, RacewaySide::Outer, largest_force(scene));
    let miss = |side: RacewaySide| (limit / largest_approach(bearing, side, largest) - CONTINUED).abs();
    let side = if miss(inner) <= miss(outer) { inner } else { outer };
    [approach, limit].map(|approach| {
        let (mut low, mut high) = (0.0, largest);
        while largest_approach(bearing, side, high) < approach {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            if largest_approach(bearing, side, middle) < approach { low = middle } else { high = middle }
        }
        high
    })
}
