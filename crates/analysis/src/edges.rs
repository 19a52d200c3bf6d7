//! Where an element's contact meets the edges of defects of rings, as angles of the cage.
//!
//! While the contact crosses an edge, the raceway under it is lost or won within the contact's own length, a fraction
//! of a degree, and all that depends on its stiffness may have a peak there that evenly spaced angles miss. Edges are
//! where the depth jumps, and a defect's two ends. Those of an element's own defect are not among them: how it lies at
//! a cage angle is a matter of chance.

use brinell::contact::element_on_raceway::ElementOnRaceway;
use brinell::contact::rolling::RacewaySide;
use brinell::dynamics::kinematics::CageState;
use brinell::dynamics::model::Model;
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
/// Corrections after which the cage angle at which an element of an irregular cage is somewhere is exact: its lead
/// changes by at most some hundredths of the cage's angle.
const CORRECTIONS: usize = 8;

impl Edge {
    /// The edges of all defects of rings, `surfaces` being those of the scene's defects.
    pub(super) fn all(scene: &Scene, surfaces: &[Surface]) -> Vec<Self> {
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
pub(super) fn angles(model: &Model, edges: &[Edge], first: f64, period: f64, count: usize) -> Vec<f64> {
    let count = count.max(1);
    let mut angles: Vec<f64> = (0..=count).map(|i| first + i as f64 * (period / count as f64)).collect();
    let last = angles[count];
    for place in edges.iter().flat_map(|edge| edge.around()) {
        // In an even cage any element does: the others' angles are whole spacings away.
        for j in 0..if model.is_even() { 1 } else { model.element_count } {
            let mut cage = place - model.element_offset(j);
            for _ in 0..CORRECTIONS {
                cage += place - model.element_angle(j, &CageState::at_rest(cage));
            }
            angles.push(first + (cage - first).rem_euclid(period));
        }
    }
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|next, before| *next - *before < SAME);
    // The end itself, not what has been taken for the same.
    angles.pop();
    angles.push(last);
    angles
}
