//! In what a difference of two runs is measured.
//!
//! The unit is what one step of the simulation may be wrong by: its tolerance times the largest approach, for
//! velocities a thousand of that per second, and what follows from both for forces and accelerations.

use crate::case::{Case, Damping, Defect, Mode, Motion};
use crate::oracle::Bearing;
use crate::oracle::envelope::Feature;
use crate::oracle::signals::Kind;
use crate::oracle::surface::Surface;
use std::collections::BTreeMap;

/// Units that a difference may have: many steps follow each other, each wrong by up to one.
pub const LIMIT: f64 = 100.0;
/// Largest allowed difference over the largest force up to which runs are compared.
pub const HORIZON: f64 = 0.02;

/// What interpolating the rigid path of an element leaves, of its radius.
pub const KEPT_PATH: f64 = 3e-13;

/// How exactly a position is known (m): to some roundings of the radii, and to what interpolating the rigid path
/// leaves.
pub fn rounding(bearing: &Bearing) -> f64 {
    let path = if bearing.defective { KEPT_PATH * bearing.r } else { 0.0 };
    4e-15 * bearing.rho_0 + path
}

/// How exactly the position of a defect beside another one is known, along its body and out of it (m): both may become
/// one profile, whose arcs are rounded to a picometre.
pub fn position_error(case: &Case) -> f64 {
    let beside = |(k, defect): (usize, &Defect)| case.defects[..k].iter().any(|other| other.on.is_body_of(defect.on));
    if case.defects.iter().enumerate().any(beside) { 0.5e-12 } else { 0.0 }
}

/// How exactly the slope of a kept path is known (m/rad) at an angle from the defect's centre.
///
/// The path is kept as cubics through its values and slopes at nodes, at most 5e-6 m or 1.25e-3 r apart along the body
/// with the defect, and twice as near until the path itself is right to E = 2e-13 r and some roundings. Between nodes w
/// apart a cubic's value is wrong by w⁴P⁗/384 and its slope by √3/216 w³P⁗, which is 3.08 E/w. A quarter more is for
/// what P⁗ changes within w. Roundings of the values come into the slope as 1.5 (p₁ − p₀)/w. A level piece is kept as
/// the constant that it is.
pub fn slope_error(bearing: &Bearing, surface: &Surface, psi: f64) -> f64 {
    let envelope = &surface.envelope;
    let stretch = envelope.stretch(psi);
    let feature = envelope.feature(stretch);
    let level = !matches!(feature, Feature::Corner(_)) && envelope.path(feature, psi).1 == 0.0;
    if level {
        return 0.0;
    }
    let raceway = bearing.rho_0 + bearing.r;
    let value = 2e-13 * bearing.r + 4.0 * f64::EPSILON * raceway;
    let width = |psi: f64| (384.0 * value / envelope.fourth(feature, psi).abs()).powf(0.25);
    let ends = envelope.ends(stretch);
    let widest = (5e-6f64.max(1.25e-3 * bearing.r) / envelope.own).min(width(ends[0])).min(width(ends[1]));
    let narrowest = (0.5 * widest).min(ends[1] - ends[0]);
    let truncated = 1.25 * 3.08 * value / width(psi);
    let rounded = 3.0 * f64::EPSILON * (2.0 * raceway + envelope.steepened(feature, psi)) / narrowest;
    truncated + rounded
}

/// How exactly the path (m) is kept at an angle that is touched at more than 85°: a stretch has 65 536 cubics at most.
pub fn path_error(surface: &Surface, psi: f64) -> f64 {
    let envelope = &surface.envelope;
    let stretch = envelope.stretch(psi);
    let feature = envelope.feature(stretch);
    let Feature::Corner(_) = feature else { return 0.0 };
    let [from, to] = envelope.ends(stretch);
    let width = (to - from) / 65_536.0;
    // w⁴P⁗/384 at the steeper end of the cubic.
    let error = |psi: f64| width.powi(4) * envelope.fourth(feature, psi.clamp(from, to)).abs() / 384.0;
    error(psi - width).max(error(psi + width))
}

/// One unit of each kind of signal, for the largest approaches (m).
pub fn units(bearing: &Bearing, case: &Case, largest: [f64; 2]) -> BTreeMap<Kind, f64> {
    let approach = largest[0].max(largest[1]).max(0.0);
    let length = case.tolerance * (approach + 1e-7) + rounding(bearing) + position_error(case) / LIMIT;
    let velocity = 1e3 * case.tolerance * (approach + 1e-7);
    let (mut k, mut c) = (0.0f64, 0.0f64);
    for side in 0..2 {
        let [elastic, slope] = bearing.growth[side].force(approach);
        let damper = match case.damping {
            Damping::HuntCrossley(chi) => chi * elastic,
            Damping::Proportional(tau) => tau * slope,
        };
        // Oil resists most where it is thinnest, to an element as fast as contacts throw it.
        let fast = approach * (slope / bearing.mass).sqrt();
        let oil = bearing.oil.as_ref().map(|oil| oil.resistance(side, 0.0, 0.0, fast)).unwrap_or_default();
        (k, c) = (k.max(slope + oil.steep), c.max(damper + oil.by_rate));
    }
    let force = length * k + velocity * c;
    let shared = 1.0 + case.count as f64 / 3.0;
    let omega = bearing.past(None, bearing.speeds).abs();
    let angle = bearing.starts.iter().fold(1.0, |sum, angle| sum + angle.abs());
    let mut units = BTreeMap::from([
        (Kind::Force, shared * force),
        (Kind::Length, length),
        (Kind::Velocity, velocity),
        (Kind::Angle, 1e-14 * angle),
        (Kind::Torque, bearing.rho_0 * (shared * force + 2.0 * bearing.mass * omega * velocity * case.count as f64)),
    ]);
    let sensor = case.sensor.map_or(0.0, |[_, k, c]| k * length + c * velocity);
    for (which, ring) in case.rings.iter().enumerate() {
        let own = shared * force + ring.stiffness * length + ring.damping * velocity + sensor;
        // What the host prescribes is given back as it is.
        let mass = if ring.motion == Motion::Internal { ring.mass } else { f64::INFINITY };
        units.insert(Kind::Acceleration(which), own / mass);
    }
    let shown = 1.0 + case.modes.iter().map(Mode::amplification).sum::<f64>();
    units.insert(Kind::Acceleration(2), shown * sensor / case.sensor.map_or(1.0, |[mass, ..]| mass));
    units
}

/// Largest difference of each kind between two samples, and those before.
pub fn differences<K: Copy + Ord>(names: &[(String, K)], a: &[f64], b: &[f64], into: &mut BTreeMap<K, f64>) {
    for (((_, kind), a), b) in names.iter().zip(a).zip(b) {
        let entry = into.entry(*kind).or_insert(0.0);
        *entry = entry.max((a - b).abs());
    }
}

/// The magnitudes of all forces.
pub fn largest_force<'a>(names: &'a [(String, Kind)], sample: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
    names.iter().zip(sample).filter(|((_, kind), _)| *kind == Kind::Force).map(|(_, force)| force.abs())
}
