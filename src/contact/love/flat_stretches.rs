//! Where a raceway is level, so that the contact is the smooth one's: before the defect, after it, and on flat floors.

use crate::geometry::curvature;
use crate::surface::Surface;

use crate::contact::element_on_raceway::ElementOnRaceway;
use crate::contact::error::ContactError;
use std::f64::consts::TAU;

/// Smooth raceway that must be left between what elements feel of a defect's two ends (rad): knots closer together than
/// 1e-9 rad are one.
const SMALLEST_GAP: f64 = 1e-8;

/// A part of a raceway.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Arcs {
    /// First arc (m).
    pub(crate) first: f64,
    /// Last arc (m).
    pub(crate) last: f64,
}

impl Arcs {
    /// Of a defect.
    pub(crate) fn of(surface: &Surface) -> Self {
        let (first, last) = surface.extent();
        Self { first, last }
    }
}

/// Refuses a defect of this `extent` that elements feel within `felt`, for the reason `why`, if that is the whole
/// raceway: laws near the defect know what is beyond one of its ends, not what is beyond both.
pub(crate) fn check_ends(extent: Arcs, felt: Arcs, raceway_radius: f64, why: &'static str) -> Result<(), ContactError> {
    let (length, span) = (extent.last - extent.first, felt.last - felt.first);
    let limit = (TAU - SMALLEST_GAP) * raceway_radius;
    if span < limit {
        return Ok(());
    }
    Err(ContactError::EndsMeet {
        length_mm: length * 1e3,
        limit_mm: (limit - (span - length)) * 1e3,
        reach_mm: (extent.first - felt.first).max(felt.last - extent.last) * 1e3,
        why,
        circumference_mm: TAU * raceway_radius * 1e3,
    })
}

/// Distance (m) along the raceway within which the element comes lower than `depth` (m); a little more than the
/// circles'.
pub(in crate::contact) fn reach(element: ElementOnRaceway, depth: f64) -> f64 {
    curvature::reach(depth.max(0.0), element.curvatures()[0])
}

/// A stretch of constant depth.
#[derive(Debug, Clone, Copy)]
pub(in crate::contact) struct Flat {
    /// First arc (m).
    pub(in crate::contact) start: f64,
    /// Last arc (m).
    pub(in crate::contact) end: f64,
    /// Depth (m).
    pub(in crate::contact) depth: f64,
}

/// Stretches of constant depth.
pub(in crate::contact) fn flats(surface: &Surface) -> Vec<Flat> {
    let (from, to) = surface.extent();
    let mut flats = vec![Flat { start: f64::NEG_INFINITY, end: from, depth: 0.0 }];
    if let Surface::Profile(profile) = surface {
        for pair in profile.points().windows(2) {
            let ((s0, d0), (s1, d1)) = (pair[0], pair[1]);
            if d0 == d1 && s1 > s0 {
                flats.push(Flat { start: s0, end: s1, depth: d0 });
            }
        }
    }
    flats.push(Flat { start: to, end: f64::INFINITY, depth: 0.0 });
    flats
}

/// Smallest depth (m), of the highest rim; 0 without one.
pub(in crate::contact) fn shallowest(surface: &Surface) -> f64 {
    surface.depths().fold(0.0, f64::min)
}
