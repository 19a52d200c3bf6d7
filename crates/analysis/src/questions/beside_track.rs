//! How far beside the track on which elements run a topography is deepest.

use brinell::scene::{DefectOn, Scene};
use brinell::simulation::setup::{check_reach, track_width};
use brinell::surface::{Surface, Topography};
use std::fmt;

/// Share of the largest depth that counts as it: floors are rough.
const AS_DEEP: f64 = 0.9;
/// Share of the largest depth below which the track as good as misses the defect.
const MISSED: f64 = 0.1;

/// A topography that is deepest beside the track.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BesideTrack {
    /// The largest depth (µm).
    pub deepest_um: f64,
    /// The place nearest to the track where it is about as deep (mm), as the file counts.
    pub at_mm: f64,
    /// First and last place on which elements run (mm): one of balls.
    pub track_mm: [f64; 2],
    /// The largest depth there (µm).
    pub on_track_um: f64,
}

impl BesideTrack {
    /// What there is to say of a surface of this body; the scene has its operating angle. One that does not reach the
    /// track is refused.
    pub fn of(scene: &Scene, on: DefectOn, surface: &Surface) -> Option<Self> {
        check_reach(scene, on, surface).ok()?;
        let Surface::Topography(surface) = surface else { return None };
        let track = track_width(scene, on);
        let rows: Vec<(f64, f64)> = surface.axials().iter().map(|&axial| (axial, largest_at(surface, axial))).collect();
        let deepest = rows.iter().map(|(_, depth)| *depth).fold(0.0, f64::max);
        let distance = |at: f64| (at - at.clamp(track[0], track[1])).abs();
        let as_deep = rows.iter().filter(|(_, depth)| *depth >= AS_DEEP * deepest).map(|(at, _)| *at);
        let at = as_deep.min_by(|a, b| distance(*a).total_cmp(&distance(*b))).filter(|_| deepest > 0.0)?;
        let within = rows.iter().filter(|(at, _)| distance(*at) == 0.0).map(|(_, depth)| *depth);
        let on_track = within.chain(track.map(|at| largest_at(surface, at))).fold(0.0, f64::max);
        (on_track < AS_DEEP * deepest).then(|| Self {
            deepest_um: deepest * 1e6,
            at_mm: at * 1e3,
            track_mm: track.map(|at| at * 1e3),
            on_track_um: on_track * 1e6,
        })
    }

    /// Whether the track as good as misses the defect.
    pub fn is_missed(&self) -> bool {
        self.on_track_um < MISSED * self.deepest_um
    }
}

/// The largest depth (m) along the arc at an axial coordinate (m).
fn largest_at(surface: &Topography, axial: f64) -> f64 {
    surface.arcs().iter().map(|&arc| surface.depth_at(arc, axial)).fold(0.0, f64::max)
}

impl fmt::Display for BesideTrack {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { deepest_um, at_mm, track_mm: [first, last], on_track_um } = *self;
        let beside = (at_mm - at_mm.clamp(first, last)).abs();
        write!(
            f,
            "its deepest point, {deepest_um:.1} um, is {beside:.3} mm beside the track, at axial_mm = {at_mm:.3}; on \
             the track"
        )?;
        if first == last {
            write!(f, ", at {first:.3},")?
        } else {
            write!(f, ", from {first:.3} to {last:.3},")?
        }
        write!(f, " it is {on_track_um:.1} um deep")?;
        if !self.is_missed() {
            return Ok(());
        }
        write!(
            f,
            ", less than a tenth. Does axial_mm count from a corner? 0 must be the bottom of the groove, the middle of \
             a roller"
        )
    }
}
