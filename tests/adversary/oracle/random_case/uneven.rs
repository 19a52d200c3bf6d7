//! Random sizes of elements, and random waves.

use super::scale::Scale;
use crate::bearing::Bearing;
use crate::case::{Case, Grooves, On, Wave};
use crate::draw::Draw;
use std::f64::consts::TAU;

/// Largest slope of all waves of a body together, and their curvature over that of the gap, which a scene may have.
const STEEPEST: f64 = 0.01;
const MOST_CURVED: f64 = 0.1;

/// Makes elements unequal in a quarter of all scenes and bodies wavy in a third; what the tables call it.
pub(super) fn add(draw: &mut Draw, case: &mut Case, scale: &Scale) -> &'static str {
    let unequal = draw.chance(0.25);
    if unequal {
        sizes(draw, case, scale);
    }
    if draw.chance(0.35) {
        waves(draw, case, scale);
    }
    match (unequal, case.waves.is_empty()) {
        (false, true) => "equal elements, round bodies",
        (true, true) => "unequal elements",
        (false, false) => "waves",
        (true, false) => "unequal elements, waves",
    }
}

/// Of which the approach feels a part, up to what grooves, neighbours and the scene allow.
fn sizes(draw: &mut Draw, case: &mut Case, scale: &Scale) {
    let conformity = match case.grooves {
        _ if case.roller.is_some() => 1.0,
        Grooves::Equal(groove) => groove / (2.0 * case.diameter_mm),
        Grooves::Each(inner, outer) => inner.min(outer),
    };
    let most = (0.9e-3f64).min(0.5 * (2.0 * conformity - 1.0)) * 2.0 * scale.r;
    let size = (scale.approach * draw.log(0.01, 2.0)).min(most).min(1.9e-3);
    case.larger_um = (0..case.count).map(|_| 1e6 * size * draw.between(-1.0, 1.0)).collect();
}

/// One to three orders on one or both rings, or on elements: no two bodies of one contact turn against each other that
/// have defects or waves, unless both are rings.
fn waves(draw: &mut Draw, case: &mut Case, scale: &Scale) {
    let on_element = |on: On| matches!(on, On::Element { .. });
    let elements = case.defects.iter().filter(|defect| on_element(defect.on)).count();
    if elements > 0 && elements < case.defects.len() {
        return;
    }
    let of_elements = elements > 0 || case.defects.is_empty() && draw.chance(0.3);
    for _ in 0..1 + draw.below(3) {
        let on = match of_elements {
            true => On::Element { element: draw.below(case.count), tilt_deg: 0.0 },
            false => draw.pick(&[On::Inner, On::Outer]),
        };
        let radius = scale.bearer(on);
        let gap = 1.0 / scale.r + if on == On::Inner { 1.0 / radius } else { -1.0 / scale.raceway };
        let amplitude = (scale.approach * draw.log(0.01, 1.0)).min(0.9e-3);
        // Three on one body together stay within both limits.
        let [steep, curved] = [STEEPEST / (3.1 * amplitude), (MOST_CURVED * gap / (3.1 * amplitude)).sqrt()];
        // Five lengths of a contact under 1000 N to a wave; where the gap is as wide as the approach it has ended.
        let bearing = Bearing::smooth(case);
        let approach = (0..2).map(|side| bearing.growth[side].approach(1000.0)).fold(0.0, f64::max);
        let long = TAU / 5.0 / (2.0 * (2.0 * approach / gap).sqrt());
        let highest = (radius * steep.min(curved).min(long)).min(1000.0);
        if highest >= 1.0 {
            let (order, crest_deg) = (draw.log(1.0, highest + 1.0).min(highest) as u32, draw.between(-180.0, 180.0));
            case.waves.push(Wave { on, order, amplitude_um: 1e6 * amplitude, crest_deg });
        }
    }
}
