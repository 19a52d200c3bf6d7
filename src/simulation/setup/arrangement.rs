//! Where the defects of a scene are on their bodies: those so close together that one contact may meet two of them are
//! one surface.
//!
//! An element rolls off one edge and into the next within √(2 r_e h) each, r_e its radius against the raceway's and h
//! the depth, and a contact feels a defect from half its own length before it. Defects of one body that are closer than
//! both together become one profile, whose envelope and whose contact map are one; those farther apart keep a surface
//! each. Overlaps are refused: which of two depths would hold is not said.

use super::tracks::element_on_track;
use crate::contact::law::elastic_law;
use crate::contact::love::EdgeSoftness;
use crate::contact::rolling::RacewaySide;
use crate::geometry::hertz_constant::share_of_ring;
use crate::geometry::load_rating::load_ratings;
use crate::scene::{Bearing, ContactEdge, DefectOn, Motion, Scene};
use crate::surface::{Surface, SurfaceError, rounded};
use std::borrow::Cow;
use std::f64::consts::TAU;

/// Smallest distance between two defects of one body (m).
const CLOSEST: f64 = 1e-6;
/// Half-lengths of the contact at the largest force within which a defect is felt; a contact map ends after 1.2 of them
/// and three cells.
const FELT: f64 = 2.0;

/// A surface on a body: one defect, or several that are close together.
#[derive(Debug, Clone)]
pub(in crate::simulation) struct PlacedSurface<'a> {
    /// The body.
    pub(super) on: DefectOn,
    /// The surface; its arcs count from `centre`.
    pub(super) surface: Cow<'a, Surface>,
    /// Angle of arc 0 (rad), as the angle of a defect.
    pub(super) centre: f64,
}

/// The part of its body that a defect covers.
#[derive(Clone, Copy)]
struct Covered {
    /// Number of the defect in the scene, from 0.
    index: usize,
    /// Angle of its centre in [0, 2π) (rad).
    centre: f64,
    /// First and last angle (rad).
    ends: [f64; 2],
}

/// The raceways that a defect of a body meets, the inner one first.
pub(super) fn sides(on: DefectOn) -> &'static [RacewaySide] {
    match on {
        DefectOn::Outer => &[RacewaySide::Outer],
        DefectOn::Inner => &[RacewaySide::Inner],
        DefectOn::Element { .. } => &[RacewaySide::Inner, RacewaySide::Outer],
    }
}

/// The defects of a scene, whose surfaces are `surfaces` in the same order, as their bodies have them: bodies in the
/// order in which the scene names them.
///
/// # Errors
/// Defects that overlap; a topography so close to another defect that both would have to be one surface.
pub(in crate::simulation) fn placed_surfaces<'a>(
    scene: &Scene,
    surfaces: &'a [Surface],
) -> Result<Vec<PlacedSurface<'a>>, SurfaceError> {
    let mut placed = Vec::new();
    for (index, defect) in scene.defects.iter().enumerate().take(surfaces.len()) {
        let same = |other: &DefectOn| is_same_body(*other, defect.on);
        if scene.defects[..index].iter().any(|before| same(&before.on)) {
            continue;
        }
        let all: Vec<usize> = (index..surfaces.len()).filter(|&k| same(&scene.defects[k].on)).collect();
        placed.extend(on_body(scene, surfaces, &all)?);
    }
    Ok(placed)
}

fn is_same_body(one: DefectOn, other: DefectOn) -> bool {
    match (one, other) {
        (DefectOn::Element { element, .. }, DefectOn::Element { element: of_other, .. }) => element == of_other,
        (one, other) => one == other,
    }
}

/// The surfaces of one body, which has the defects `all`.
fn on_body<'a>(scene: &Scene, surfaces: &'a [Surface], all: &[usize]) -> Result<Vec<PlacedSurface<'a>>, SurfaceError> {
    if let [one] = *all {
        let defect = &scene.defects[one];
        return Ok(vec![PlacedSurface { on: defect.on, surface: Cow::Borrowed(&surfaces[one]), centre: defect.angle }]);
    }
    let radius = scene.defects[all[0]].on.radius(&scene.bearing);
    let mut covered: Vec<Covered> = all
        .iter()
        .map(|&index| {
            let (first, last) = surfaces[index].extent();
            let centre = scene.defects[index].angle.rem_euclid(TAU);
            Covered { index, centre, ends: [centre + first / radius, centre + last / radius] }
        })
        .collect();
    covered.sort_by(|a, b| a.ends[0].total_cmp(&b.ends[0]));
    // Each defect with what lies between it and the next.
    let count = covered.len();
    let mut gaps = Vec::with_capacity(count);
    for (k, one) in covered.iter().enumerate() {
        let turn = if k + 1 == count { TAU } else { 0.0 };
        let next = &covered[(k + 1) % count];
        let gap = (next.ends[0] + turn - one.ends[1]) * radius;
        if gap < CLOSEST {
            let numbers = [one.index, next.index].map(|index| index + 1);
            return Err(SurfaceError::Overlap { numbers, gap_mm: gap * 1e3, limit_mm: CLOSEST * 1e3 });
        }
        let apart = needed(scene, [&surfaces[one.index], &surfaces[next.index]], scene.defects[one.index].on);
        gaps.push((gap, apart));
    }
    // Begun after the gap that parts most clearly: the last defect and the first have it between them.
    let clear = |k: usize| gaps[k].0 - gaps[k].1;
    let widest = (0..count).max_by(|&a, &b| clear(a).total_cmp(&clear(b))).unwrap_or(0);
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for step in 1..=count {
        let (k, before) = ((widest + step) % count, (widest + step - 1) % count);
        let (gap, apart) = gaps[before];
        match groups.last_mut() {
            Some(group) if gap < apart => group.push(k),
            _ => groups.push(vec![k]),
        }
    }
    groups.into_iter().map(|group| joined(scene, surfaces, &covered, &group, gaps[group[0]].1)).collect()
}

/// The surface of the defects `group` among those `covered`.
fn joined<'a>(
    scene: &Scene,
    surfaces: &'a [Surface],
    covered: &[Covered],
    group: &[usize],
    apart: f64,
) -> Result<PlacedSurface<'a>, SurfaceError> {
    let first = &covered[group[0]];
    let defect = &scene.defects[first.index];
    let radius = defect.on.radius(&scene.bearing);
    if group.len() == 1 {
        return Ok(PlacedSurface {
            on: defect.on,
            surface: Cow::Borrowed(&surfaces[first.index]),
            centre: defect.angle,
        });
    }
    let mut profiles = Vec::with_capacity(group.len());
    for &k in group {
        let Covered { index, centre, .. } = covered[k];
        let Surface::Profile(profile) = &surfaces[index] else {
            let other = covered[if k == group[0] { group[1] } else { group[0] }].index;
            return Err(SurfaceError::TopographyClose { numbers: [index + 1, other + 1], limit_mm: apart * 1e3 });
        };
        let arc = (centre - first.centre).rem_euclid(TAU) * radius;
        profiles.push((rounded(arc), profile));
    }
    // Angles from the centre are within half a turn, and so the whole must be.
    let end = profiles.last().map_or(0.0, |(arc, profile)| arc + profile.extent().1);
    let begin = profiles.first().map_or(0.0, |(_, profile)| profile.extent().0);
    let middle = rounded(0.5 * (begin + end));
    profiles.iter_mut().for_each(|(arc, _)| *arc -= middle);
    let surface = Cow::Owned(Surface::Profile(crate::surface::Profile::joined(&profiles)));
    Ok(PlacedSurface { on: defect.on, surface, centre: defect.angle + middle / radius })
}

/// Distance (m) between two defects from which on no contact meets both.
fn needed(scene: &Scene, pair: [&Surface; 2], on: DefectOn) -> f64 {
    let depth = pair.iter().flat_map(|surface| surface.depths()).fold(0.0_f64, |most, depth| most.max(depth.abs()));
    let of = |side: &RacewaySide| {
        let element = element_on_track(&scene.bearing, *side);
        let approach = largest_approach(&scene.bearing, *side, largest_force(scene));
        let [along, _] = element.contact_half_axes(approach);
        let reach = |depth: f64| (2.0 * depth / element.curvatures()[0]).sqrt();
        // Maps are prepared for contacts that are up to half longer.
        let soft = softness_of_edges(scene).map_or(0.0, |edges| edges.reach(depth, 1.5 * along));
        2.0 * (reach(depth).max(soft) + reach(approach) + FELT * along)
    };
    sides(on).iter().map(of).fold(0.0, f64::max)
}

/// How soft sharp edges are; `None` for half-spaces. With two materials they are those of the rings, unless all defects
/// are on elements.
pub(super) fn softness_of_edges(scene: &Scene) -> Option<EdgeSoftness> {
    match scene.contact.edge {
        ContactEdge::HalfSpace => None,
        ContactEdge::Step => {
            let (bearing, ring) = (&scene.bearing, share_of_ring(&scene.bearing));
            let on_elements = scene.defects.iter().all(|defect| matches!(defect.on, DefectOn::Element { .. }));
            Some(match bearing.element_poissons_ratio {
                Some(ratio) if on_elements => EdgeSoftness::of_steps_in(ratio, 1.0 - ring),
                _ => EdgeSoftness::of_steps_in(bearing.poissons_ratio, ring),
            })
        }
    }
}

/// Least force that the contact map of a scene reaches (N).
const LEAST_FORCE: f64 = 1000.0;
/// Steps of the largest forces within a decade: preferred numbers R10 (ISO 3), so that scenes of similar loads share
/// their maps.
const PREFERRED: [f64; 10] = [1.0, 1.25, 1.6, 2.0, 2.5, 3.15, 4.0, 5.0, 6.3, 8.0];

/// Share of the static load rating that a host may press with where a scene says nothing: more than bearings are run
/// under (assumed).
const HOSTED_SHARE: f64 = 0.3;

/// Force (N) up to which the contact map of a scene reaches: what the scene asks for, or else four times the static
/// force on the most loaded element, 5 F/Z (Stribeck), at least 1000 N, rounded up to a preferred number. Where the
/// host moves a ring and nothing loads the other, F is 0.3 of the static load rating.
pub fn largest_force(scene: &Scene) -> f64 {
    if let Some(force) = scene.contact.largest_force {
        return force;
    }
    let load = [scene.shaft.load, scene.housing.load].iter().map(|f| libm::hypot(f[0], f[1])).fold(0.0, f64::max);
    let (hosted, thrust) =
        ([&scene.shaft, &scene.housing].iter().any(|ring| ring.motion == Motion::Host), thrust_share(scene));
    let load =
        if hosted && load == 0.0 && thrust == 0.0 { HOSTED_SHARE * load_ratings(&scene.bearing).fixed } else { load };
    let needed = 4.0 * crate::geometry::STRIBECK * load / scene.bearing.element_count as f64 + 4.0 * thrust;
    let mut decade = LEAST_FORCE;
    while 10.0 * decade < needed {
        decade *= 10.0;
    }
    PREFERRED.iter().map(|step| step * decade).find(|force| *force >= needed).unwrap_or(10.0 * decade)
}

/// Force (N) on each element of what presses the rings along the axis, at the angle at which the bearing closes.
fn thrust_share(scene: &Scene) -> f64 {
    let thrust = [&scene.shaft, &scene.housing].map(|ring| ring.axial.load.abs() + ring.axial.preload);
    let thrust = thrust[0].max(thrust[1]);
    if thrust == 0.0 {
        return 0.0;
    }
    let bearing = &scene.bearing;
    let angle = bearing.given_operating_angle().unwrap_or(0.0).max(bearing.free_contact_angle().abs());
    thrust / (scene.bearing.element_count as f64 * libm::sin(angle.max(FLATTEST)))
}

/// Contact angle below which no bearing carries a thrust (rad): 5°.
const FLATTEST: f64 = 0.087;

/// Approach (m) of an element to a raceway under a force (N), what the ring yields outside included.
pub(super) fn largest_approach(bearing: &Bearing, side: RacewaySide, force: f64) -> f64 {
    let compliance = match side {
        RacewaySide::Inner => 0.0,
        RacewaySide::Outer => bearing.outer_compliance,
    };
    elastic_law(bearing, side).approach_under(force) + compliance * force
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    /// The largest force of a bearing of ten balls whose shaft carries `load` (N).
    fn of_load(load: f64) -> f64 {
        let mut scene = Scene::er16k();
        (scene.bearing.element_count, scene.shaft.load) = (10, [0.6 * load, -0.8 * load]);
        largest_force(&scene)
    }

    #[test]
    fn the_largest_force_is_a_preferred_number_that_covers_four_times_the_static_one() {
        for (needed, largest) in [(0.0, 1000.0), (999.0, 1000.0), (1001.0, 1250.0), (3151.0, 4000.0)] {
            assert_eq!(of_load(0.5 * needed), largest, "{needed} N");
        }
        for (needed, largest) in [(9999.0, 1e4), (10_001.0, 1.25e4), (8.1e6, 1e7)] {
            assert_eq!(of_load(0.5 * needed), largest, "{needed} N");
        }
    }

    #[test]
    fn a_force_that_the_scene_names_is_taken_as_it_is() {
        let mut scene = Scene::er16k();
        scene.contact.largest_force = Some(1111.0);
        assert_eq!(largest_force(&scene), 1111.0);
    }
}
