//! Where elements run on the raceways: at the groove's bottom, or in space at the operating angle α_n.
//!
//! A track at α_n is a circle of radius R_c about its ring's axis, with the curvature cos α_n/R_c along rolling. So a
//! raceway of the radius R_n = R_c/cos α_n stands for it, on which an angle d around the ring is d cos α_n: arcs are
//! the same, R_c d = R_n d cos α_n. A defect keeps the angles that it has at the groove's bottom, of radius R, so that
//! its arcs on the track are R_c/R as long.

use std::borrow::Cow;

use crate::contact::element_on_raceway::ElementOnRaceway;
use crate::contact::rolling::{RacewaySide, Rolling};
use crate::dynamics::contacts::{Forces, Shortcuts};
use crate::dynamics::parameters::{Excitation, Model, Quadratic};
use crate::scene::{Bearing, DefectOn, DegreesOfFreedom, Motion, Scene};
use crate::surface::Surface;

/// Change of the operating angle below which it is that of the balance (rad): a thousandth of a degree.
const SETTLED: f64 = 1.7e-5;
/// Most balances that are looked for.
const MOST: usize = 20;

/// Operating angle of a bearing in space (rad); 0 in the plane.
pub(super) fn angle_of(bearing: &Bearing) -> f64 {
    bearing.given_operating_angle().filter(|_| bearing.degrees_of_freedom != DegreesOfFreedom::Two).unwrap_or(0.0)
}

/// An element on one raceway's track.
pub(super) fn element_on_track(bearing: &Bearing, side: RacewaySide) -> ElementOnRaceway {
    match angle_of(bearing) {
        0.0 => ElementOnRaceway::of(bearing, side),
        angle => ElementOnRaceway::at_angle(bearing, side, angle),
    }
}

/// How it rolls there, over a defect of the element or of the raceway; and cos α_n by which angles around the body with
/// the defect are shorter there.
pub(super) fn rolling_on_track(bearing: &Bearing, side: RacewaySide, on_element: bool) -> (Rolling, f64) {
    let rolling = Rolling::of(bearing, side, on_element);
    match angle_of(bearing) {
        0.0 => (rolling, 1.0),
        angle => {
            let raceway_radius = element_on_track(bearing, side).raceway_radius;
            (Rolling { raceway_radius, ..rolling }, if on_element { 1.0 } else { libm::cos(angle) })
        }
    }
}

/// A surface as it is met on the track.
pub(super) fn on_track<'a>(surface: &'a Surface, bearing: &Bearing, on: DefectOn) -> Cow<'a, Surface> {
    if angle_of(bearing) == 0.0 || matches!(on, DefectOn::Element { .. }) {
        return Cow::Borrowed(surface);
    }
    let longer = defect_radius(bearing, on) / on.radius(bearing);
    Cow::Owned(match surface {
        Surface::Profile(profile) => Surface::Profile(profile.stretched(longer)),
        Surface::Topography(topography) => Surface::Topography(topography.stretched(longer)),
    })
}

/// The same as it lies about a place across the groove (m), where one is given.
pub(super) fn about<'a>(surface: Cow<'a, Surface>, place: Option<f64>) -> Cow<'a, Surface> {
    match place {
        Some(place) => Cow::Owned(surface.into_owned().seen_from(place)),
        None => surface,
    }
}

/// Radius of a body's track where its defects are (m).
pub(super) fn defect_radius(bearing: &Bearing, on: DefectOn) -> f64 {
    match (on, angle_of(bearing)) {
        (_, 0.0) | (DefectOn::Element { .. }, _) => on.radius(bearing),
        (DefectOn::Outer, angle) => RacewaySide::Outer.track_radius(bearing, angle),
        (DefectOn::Inner, angle) => RacewaySide::Inner.track_radius(bearing, angle),
    }
}

/// The scene with the operating angle that it leaves open: with free rings the mean |α| of the start's balance on
/// smooth raceways, weighted with the forces, and 0 where a host moves a ring.
pub fn with_operating_angle(scene: &Scene) -> Cow<'_, Scene> {
    let bearing = &scene.bearing;
    if bearing.degrees_of_freedom == DegreesOfFreedom::Two || bearing.given_operating_angle().is_some() {
        return Cow::Borrowed(scene);
    }
    let mut scene = scene.clone();
    scene.bearing.operating_angle = Some(0.0);
    let hosted = [&scene.shaft, &scene.housing].iter().any(|ring| ring.motion == Motion::Host);
    if hosted || bearing.roller().is_some() {
        return Cow::Owned(scene);
    }
    let mut angle = 0.0f64;
    for _ in 0..MOST {
        scene.bearing.operating_angle = Some(angle);
        // Where there is no balance, it is reported when the start is looked for.
        let Some(next) = balanced_angle(&scene) else { break };
        let settled = (next - angle).abs() < SETTLED;
        angle = next;
        if settled {
            break;
        }
    }
    scene.bearing.operating_angle = Some(angle);
    Cow::Owned(scene)
}

/// Mean |α| (rad) of all contacts in the static balance of a scene without its defects, weighted with their forces.
fn balanced_angle(scene: &Scene) -> Option<f64> {
    let model = Model::smooth(scene);
    let space = model.space.as_ref()?;
    let speeds = [scene.shaft_speed, scene.housing_speed.unwrap_or(0.0)];
    let cage = model.ratios.cage[0] * speeds[0] + model.ratios.cage[1] * speeds[1];
    let excitation = Excitation {
        cage: Quadratic([0.0, cage, 0.0]),
        load: [scene.shaft, scene.housing].map(|ring| ring.loads().map(Quadratic::constant)),
        ..Excitation::standing(scene.cage.initial_angle, [0.0; 3])
    };
    let mut state = vec![0.0; model.layout.len];
    let cells = model.equilibrium_with_cells(&excitation, &mut state).ok()?;
    let (mut forces, mut derivative) = (Forces::of(&model), vec![0.0; model.layout.len]);
    forces.shortcuts = Shortcuts::of(&model);
    model.derivative(&excitation, 0.0, &cells, &state, &mut derivative, &mut forces);
    let contacts = &forces.contacts;
    let (mut sum, mut total) = (0.0, 0.0);
    for j in 0..model.element_count {
        for (side, force) in [contacts.inner[j], contacts.outer[j]].into_iter().enumerate() {
            sum += force * contacts.contact_angle(space, j, side).abs();
            total += force;
        }
    }
    (total > 0.0).then(|| sum / total)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::contact::rolled_path::RigidPath;

    /// How far into a deep spall (m) a rigid ball goes that is pushed along α and is `d` (rad) within its edge, which
    /// is a cut through the groove along a meridian: its section with the cut touches the groove's circle.
    fn exact(bearing: &Bearing, side: RacewaySide, alpha: f64, d: f64) -> f64 {
        let (r, groove) = (bearing.element_radius(), bearing.groove_radii()[side as usize]);
        let sense = if side == RacewaySide::Outer { 1.0 } else { -1.0 };
        let centre = side.radius(bearing) - sense * groove;
        let is_free = |path: f64| {
            let from_centre = groove - r + path;
            let (g, h) = (centre + sense * from_centre * libm::cos(alpha), from_centre * libm::sin(alpha));
            let [g_cut, across] = [g * libm::cos(d), g * libm::sin(d)];
            libm::hypot(g_cut - centre, h) < groove - (r * r - across * across).sqrt()
        };
        let [mut free, mut beyond] = [0.0, 1e-4];
        for _ in 0..60 {
            let middle = 0.5 * (free + beyond);
            if is_free(middle) { free = middle } else { beyond = middle }
        }
        free
    }

    #[test]
    fn an_edge_at_a_contact_angle_lets_a_ball_in_as_far_as_the_track_says_and_that_is_nearly_exact() {
        // A 6205 with 5 µm; degrees, then for edges 0.2 and 0.4 mm away at the groove's bottom, outer and inner,
        // micrometres of the exact ball and of the track.
        let table = [
            (0.0, [[4.189532, 4.189532], [16.795320, 16.795320], [6.327068, 6.327068], [25.343306, 25.343306]]),
            (15.0, [[4.163131, 4.163240], [16.687693, 16.689345], [6.385645, 6.386196], [25.573683, 25.581426]]),
            (25.0, [[4.116985, 4.117276], [16.499696, 16.504094], [6.488262, 6.489734], [25.977806, 25.998479]]),
            (40.0, [[4.008642, 4.009314], [16.058960, 16.069105], [6.730333, 6.733747], [26.933861, 26.981830]]),
        ];
        let mut bearing = Bearing { radial_clearance: 5e-6, ..Bearing::steel_balls(9, 7.94e-3, 39.04e-3) };
        bearing.degrees_of_freedom = DegreesOfFreedom::Three;
        for (degrees, expected) in table {
            let alpha = f64::to_radians(degrees);
            bearing.operating_angle = Some(alpha);
            let edges = [(RacewaySide::Outer, DefectOn::Outer), (RacewaySide::Inner, DefectOn::Inner)]
                .into_iter()
                .flat_map(|side| [(side, 0.2e-3), (side, 0.4e-3)]);
            for (((side, on), arc), [by_ball, by_track]) in edges.zip(expected) {
                let (half, deep) = (4e-3, 1e-3);
                let spall = [(-half, 0.0), (-half, deep), (half, deep), (half, 0.0)];
                let longer = defect_radius(&bearing, on) / on.radius(&bearing);
                let (rolling, cos) = rolling_on_track(&bearing, side, false);
                let path = RigidPath::new(&spall.map(|(s, depth)| (s * longer, depth)), rolling).unwrap();
                let angle = (arc - half) / on.radius(&bearing);
                let found = 1e6 * path.turned_slower(cos).at(0, angle).path;
                let ball = 1e6 * exact(&bearing, side, alpha, arc / on.radius(&bearing));
                // Six decimals are given.
                assert!((found - by_track).abs() < 6e-7, "{degrees} {side:?} {arc}: {found} {by_track}");
                assert!((ball - by_ball).abs() < 6e-7, "{degrees} {side:?} {arc}: {ball} {by_ball}");
                assert!((found / ball - 1.0).abs() <= 2e-3, "{degrees} {side:?} {arc}: {found} {ball}");
            }
        }
    }
}
