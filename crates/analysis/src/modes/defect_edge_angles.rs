//! Where an element's contact meets the edges of defects of rings, as angles of the cage.
//!
//! While the contact crosses an edge, the raceway under it is lost or won within the contact's own length, a fraction
//! of a degree, and all that depends on its stiffness may have a peak there that evenly spaced angles miss. Edges are
//! where the depth jumps, and a defect's two ends. Those of an element's own defect are not among them: how it lies at
//! a cage angle is a matter of chance.

use crate::statics::evenly_spaced;
use brinell::contact::element_on_raceway::ElementOnRaceway;
use brinell::contact::rolling::RacewaySide;
use brinell::dynamics::parameters::{Model, WholeAngle};
use brinell::scene::{DefectOn, Scene};
use brinell::simulation::setup::map_specification;
use brinell::surface::Surface;

/// An edge of a defect of a ring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    /// Its angle (rad) with the rings as they are at the start, counter-clockwise from +x.
    angle: f64,
    /// Half the length along the raceway of a contact under the scene's largest force (rad).
    half_length: f64,
}

/// Angles on either side of an edge, and how many of them are within half a contact's length.
const BESIDE: i32 = 12;
const FINENESS: f64 = 5.0;
/// Angles closer than this (rad) are one.
const SAME: f64 = 1e-9;
/// Rounds that find the cage angle at which an element of an irregular cage is at a given angle. Each multiplies the
/// error by the slope of the element's lead: some hundredths in cages as recorded, 0.3 where a scene allows most.
const CORRECTIONS: usize = 12;

impl Edge {
    /// The edges of all defects of rings, `surfaces` being those of the scene's defects.
    pub(crate) fn all(scene: &Scene, surfaces: &[Surface]) -> Vec<Self> {
        let mut edges = Vec::new();
        for (defect, surface) in scene.defects.iter().zip(surfaces) {
            let (side, start) = match defect.on {
                DefectOn::Inner => (RacewaySide::Inner, scene.shaft_initial_angle),
                DefectOn::Outer => (RacewaySide::Outer, scene.housing_initial_angle),
                DefectOn::Element { .. } => continue,
            };
            let radius = side.radius(&scene.bearing);
            let contact = ElementOnRaceway::of(&scene.bearing, side);
            let [half_length, _] = contact.contact_half_axes(map_specification(scene, side).largest_approach);
            let (first, last) = surface.extent();
            for arc in surface.edges().into_iter().chain([first, last]) {
                edges.push(Self { angle: start + defect.angle + arc / radius, half_length: half_length / radius });
            }
        }
        edges
    }

    /// Angles about the edge (rad): across the contact's length to either side and beyond.
    fn around(self) -> impl Iterator<Item = f64> {
        (-BESIDE..=BESIDE).map(move |k| self.angle + f64::from(k) * (self.half_length / FINENESS))
    }
}

/// `count` evenly spaced cage angles from `first` (rad) on over a `period` of the model, its end, and those at which an
/// element's contact is about one of these edges; ascending.
pub(crate) fn angles(model: &Model, edges: &[Edge], first: f64, period: f64, count: usize) -> Vec<f64> {
    let mut angles = evenly_spaced(first, period, count);
    let last = angles[angles.len() - 1];
    for place in edges.iter().flat_map(|edge| edge.around()) {
        // In an even cage any element does: the others' angles are whole spacings away.
        for j in 0..if model.is_even() { 1 } else { model.element_count } {
            // Into the period first: an irregular cage is another a turn on.
            let target = first + (place - model.element_offset(j) - first).rem_euclid(period);
            let mut cage = target;
            for _ in 0..CORRECTIONS {
                let lead = model.element_angle(j, WholeAngle::in_first_turn(cage)) - model.element_offset(j) - cage;
                cage = target - lead;
            }
            if (first..=last).contains(&cage) {
                angles.push(cage);
            }
        }
    }
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|next, before| *next - *before < SAME);
    // The end itself, not what has been taken for the same.
    angles.pop();
    angles.push(last);
    angles
}

#[cfg(test)]
mod tests {
    use crate::modes::assembly::Assembly;
    use brinell::scene::{Bearing, CageIrregularity, Scene};
    use std::f64::consts::{FRAC_PI_2, TAU};

    #[test]
    fn every_element_of_an_irregular_cage_is_caught_on_both_edges_of_a_spall() {
        let bearing = Bearing::steel_balls(9, 7.94e-3, 39.04e-3);
        let radius = bearing.outer_raceway_radius();
        let spacing = TAU / 9.0;
        let [fixed, jitter, wander] = CageIrregularity::RECORDED;
        let offsets = CageIrregularity::drawn_offsets(9, fixed * spacing, 1);
        let scene = Scene::builder(bearing)
            .shaft_load([0.0, -49.0])
            .spall(-FRAC_PI_2, 2e-3, 15e-6)
            .irregularity(CageIrregularity { offsets, drawn: None, jitter: jitter * spacing, wander, seed: 1 })
            .build()
            .unwrap();
        let assembly = Assembly::new(&scene, None, None).unwrap();
        let found: Vec<Vec<f64>> =
            assembly.telling_angles(0.0, 8).into_iter().map(|cage| assembly.element_angles(cage)).collect();
        for edge in [-1.0, 1.0].map(|side| -FRAC_PI_2 + side * 1e-3 / radius) {
            for j in 0..9 {
                let nearest = found.iter().map(|angles| (angles[j] - edge).abs()).fold(f64::INFINITY, f64::min);
                assert!(nearest < 1e-9, "element {}: {nearest} rad from the edge at {edge}", j + 1);
            }
        }
    }
}
