//! Random defects in space: the shapes of the plane, on both raceways and on balls, most of them where a ball is.

use crate::case::{Defect, On, Shape};
use crate::draw::Draw;
use crate::envelope::within_half_a_turn;
use crate::random_case::shape::{Around, random};
use crate::random_case::space::Space;
use crate::spatial::bearing::SpatialBearing;
use crate::spatial::case::SpatialCase;
use std::f64::consts::TAU;

/// Share of a ring's and of a ball's circumference that a defect may have. All of a body's lie within a third of a turn
/// of the first: as a track has fewer angles about its own centre than about the axis, none is seen around the back.
const LONGEST: [f64; 2] = [0.1, 0.3];
const FARTHEST_DEG: f64 = 110.0;
/// Smallest gap (m) between two.
const GAP: f64 = 2e-6;

/// Up to three defects, for contacts that are pressed together so far (m).
pub(super) fn add(draw: &mut Draw, case: &mut SpatialCase, approach: f64) {
    for _ in 0..[0, 0, 0, 1, 1, 1, 1, 2, 2, 3][draw.below(10)] {
        // What does not fit is drawn again, and left out if it never does.
        for _ in 0..4 {
            let defect = one(draw, case, approach);
            let fits = fits(case, &defect);
            case.defects.push(defect);
            if fits && !SpatialBearing::new(&closed(case)).surfaces.leaps() {
                break;
            }
            case.defects.pop();
        }
    }
}

/// With an operating angle, so that none is looked for.
fn closed(case: &SpatialCase) -> SpatialCase {
    SpatialCase { operating_deg: case.operating_deg.or(Some(15.0)), ..case.clone() }
}

/// Radius (m) of a body at the grooves' bottoms.
fn bearer(case: &SpatialCase, on: On) -> f64 {
    let bearing = SpatialBearing::new(&SpatialCase { defects: Vec::new(), ..closed(case) });
    match on {
        On::Outer => bearing.rho_0 + bearing.radius,
        On::Inner => bearing.rho_0 - bearing.clearance - bearing.radius,
        On::Element { .. } => bearing.radius,
    }
}

fn one(draw: &mut Draw, case: &SpatialCase, approach: f64) -> Defect {
    let last = case.defects.last().cloned().filter(|_| draw.chance(0.5));
    let on = match last.as_ref().map(|last| last.on) {
        Some(On::Element { element, .. }) => On::Element { element, tilt_deg: 0.0 },
        Some(ring) => ring,
        None => Space::Whole.body(draw, case.count),
    };
    let (r, of_ball) = (case.diameter_mm * 0.5e-3, matches!(on, On::Element { .. }));
    let bearer = bearer(case, on);
    let most = LONGEST[usize::from(of_ball)] * TAU * bearer;
    let (_, shape) = random(draw, &Around { r, bearer, on, most, approach });
    let half = 0.5 * shape.length(bearer);
    let degrees = |arc: f64| (arc / bearer).to_degrees();
    let angle_deg = if let Some(last) = &last {
        let away = half + 0.5 * last.shape.length(bearer) + draw.log(2.0 * GAP, r);
        last.angle_deg + degrees(away) * draw.sign()
    } else if draw.chance(0.2) {
        draw.between(-180.0, 180.0)
    } else {
        let past = degrees(half) * draw.between(-1.3, 1.3);
        // A ball's own faces a raceway; a ring's faces a ball.
        past + match on {
            On::Element { .. } => draw.pick(&[0.0, 180.0]),
            _ => case.cage_deg + 360.0 * draw.below(case.count) as f64 / case.count as f64,
        }
    };
    let mut defect = Defect { on, angle_deg, shape };
    Space::Whole.tilt(draw, &mut defect, r);
    defect
}

/// Whether some of it stands out of the body.
fn is_raised(defect: &Defect) -> bool {
    matches!(&defect.shape, Shape::Trace(points) if points.iter().any(|&(_, depth)| depth < 0.0))
}

/// Whether a defect has its own place, beside others of its body. Where a ring's and a ball's meet under one contact
/// the deeper counts, which says nothing of raised ones: these are not drawn on both.
fn fits(case: &SpatialCase, defect: &Defect) -> bool {
    let of_ball = |defect: &Defect| matches!(defect.on, On::Element { .. });
    let raised = is_raised(defect) || case.defects.iter().any(is_raised);
    if raised && case.defects.iter().any(|other| of_ball(other) != of_ball(defect)) {
        return false;
    }
    let bearer = bearer(case, defect.on);
    let mut same = case.defects.iter().filter(|other| other.on.is_body_of(defect.on)).peekable();
    let apart = |other: &Defect| within_half_a_turn((other.angle_deg - defect.angle_deg).to_radians()).abs();
    let near = same.peek().is_none_or(|first| apart(first).to_degrees() < FARTHEST_DEG);
    near && same
        .all(|other| bearer * apart(other) - 0.5 * (other.shape.length(bearer) + defect.shape.length(bearer)) > GAP)
}
