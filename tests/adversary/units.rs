//! In what a difference of two runs is measured.
//!
//! The unit is what one step of the simulation may be wrong by: its tolerance times the largest approach, for velocities a
//! thousand of that per second, and what follows from both for forces and accelerations.

use crate::case::{Case, Damping, Motion};
use crate::oracle::Bearing;
use crate::oracle::envelope::Feature;
use crate::oracle::run::Kind;
use std::collections::BTreeMap;

/// Units that a difference may have: many steps follow each other, each wrong by up to one.
pub const LIMIT: f64 = 100.0;
/// Largest allowed difference over the largest force up to which runs are compared.
pub const HORIZON: f64 = 0.02;

/// How exactly a position is known [m]: to some roundings of the radii, and to what interpolating the rigid path leaves.
pub fn rounding(bearing: &Bearing) -> f64 {
    let path = if bearing.defective { 3e-13 * bearing.r } else { 0.0 };
    4e-15 * bearing.rho_0 + path
}

/// How exactly the path's slope is known [m/rad] at an angle from the defect's centre.
///
/// The path is kept as cubics through its values and slopes at nodes, at most 5e-6 m or 1.25e-3 r apart, and twice as
/// near until the path itself is right to E = 2e-13 r and some roundings. Between nodes w apart a cubic's value is wrong
/// by w⁴P⁗/384 and its slope by √3/216 w³P⁗, which is 3.08 E/w. Over a point P⁗ = 3 (1 + 4 sin²κ)/(r³ cos⁷κ), over a
/// straight piece less; 1.25 is for points of a depth that is not small beside the raceway's radius. Roundings of the
/// values come into the slope as 1.5 (p₁ − p₀)/w. A level piece is kept as the constant that it is.
pub fn slope_error(bearing: &Bearing, feature: Feature, psi: f64) -> f64 {
    let Some((envelope, _)) = &bearing.defect else { return 0.0 };
    let level = !matches!(feature, Feature::Corner(_)) && envelope.path(feature, psi).1 == 0.0;
    if level {
        return 0.0;
    }
    let (r, raceway) = (bearing.r, bearing.rho_0 + bearing.r);
    let cos = |psi: f64| {
        let (path, slope) = envelope.path(feature, psi);
        1.0 / (slope / (bearing.rho_0 + path)).hypot(1.0)
    };
    let value = 2e-13 * r + 4.0 * f64::EPSILON * raceway;
    let width = |cos: f64| r * (128.0 * value / r / (5.0 - 4.0 * cos * cos)).powf(0.25) * cos.powf(1.75);
    let ends = envelope.stretch(psi);
    let widest = 5e-6f64.max(1.25e-3 * r).min(width(cos(ends[0]))).min(width(cos(ends[1])));
    let narrowest = (0.5 * widest).min((ends[1] - ends[0]) * raceway);
    let truncated = 1.25 * 3.08 * value / width(cos(psi));
    let rounded = 3.0 * f64::EPSILON * (2.0 * raceway + r / cos(psi)) / narrowest;
    raceway * (truncated + rounded)
}

/// How exactly the path [m] is kept at an angle that is touched at more than 85°: a stretch has 65 536 cubics at most.
pub fn path_error(bearing: &Bearing, feature: Feature, psi: f64) -> f64 {
    let (Some((envelope, _)), Feature::Corner(_)) = (&bearing.defect, feature) else { return 0.0 };
    let [from, to] = envelope.stretch(psi);
    let width = (to - from) / 65_536.0;
    // w⁴P⁗/384 with P⁗ as in `slope_error`, at the steeper end of the cubic.
    let error = |psi: f64| {
        let (path, slope) = envelope.path(feature, psi.clamp(from, to));
        let cos = 1.0 / (slope / (bearing.rho_0 + path)).hypot(1.0);
        let fourth = 3.0 * (5.0 - 4.0 * cos * cos) / (bearing.r.powi(3) * cos.powi(7));
        (width * (bearing.rho_0 + bearing.r)).powi(4) * fourth / 384.0
    };
    error(psi - width).max(error(psi + width))
}

/// One unit of each kind of signal, for the largest approaches [m].
pub fn units(bearing: &Bearing, case: &Case, largest: [f64; 2]) -> BTreeMap<Kind, f64> {
    let approach = largest[0].max(largest[1]).max(0.0);
    let length = case.tolerance * (approach + 1e-7) + rounding(bearing);
    let velocity = 1e3 * case.tolerance * (approach + 1e-7);
    let (mut k, mut c) = (0.0f64, 0.0f64);
    for side in 0..2 {
        let root = bearing.stiffness[side] * approach.sqrt();
        k = k.max(1.5 * root);
        c = c.max(match case.damping {
            Damping::HuntCrossley(chi) => chi * root * approach,
            Damping::Proportional(tau) => 1.5 * tau * root,
        });
    }
    let force = length * k + velocity * c;
    let shared = 1.0 + case.count as f64 / 3.0;
    let omega = bearing.ratio * bearing.speed.abs();
    let mut units = BTreeMap::from([
        (Kind::Force, shared * force),
        (Kind::Length, length),
        (Kind::Velocity, velocity),
        (Kind::Angle, 1e-14 * (1.0 + bearing.cage_start.abs())),
        (Kind::Torque, bearing.rho_0 * (shared * force + 2.0 * bearing.mass * omega * velocity * case.count as f64)),
    ]);
    let sensor = case.sensor.map_or(0.0, |[_, k, c]| k * length + c * velocity);
    for (which, ring) in case.rings.iter().enumerate() {
        let own = shared * force + ring.stiffness * length + ring.damping * velocity + sensor;
        // What the host prescribes is given back as it is.
        let mass = if ring.motion == Motion::Internal { ring.mass } else { f64::INFINITY };
        units.insert(Kind::Acceleration(which), own / mass);
    }
    units.insert(Kind::Acceleration(2), sensor / case.sensor.map_or(1.0, |[mass, ..]| mass));
    units
}

/// Largest difference of each kind between two samples, and those before.
pub fn differences(names: &[(String, Kind)], a: &[f64], b: &[f64], into: &mut BTreeMap<Kind, f64>) {
    for (((_, kind), a), b) in names.iter().zip(a).zip(b) {
        let entry = into.entry(*kind).or_insert(0.0);
        *entry = entry.max((a - b).abs());
    }
}

/// The magnitudes of all forces.
pub fn largest_force<'a>(names: &'a [(String, Kind)], sample: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
    names.iter().zip(sample).filter(|((_, kind), _)| *kind == Kind::Force).map(|(_, force)| force.abs())
}
