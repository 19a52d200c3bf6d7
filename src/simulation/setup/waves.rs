//! Whether an element follows a scene's waves as a rigid one: they must be long against its contacts.

use super::arrangement::{largest_approach, largest_force};
use super::tracks::element_on_track;
use crate::contact::rolling::RacewaySide;
use crate::scene::{Scene, WavyBody};
use crate::simulation::SimulationError;
use std::f64::consts::TAU;

/// Least length of a wave in lengths of the contact at the largest force. Hertz's pressure over the contact sees 1 −
/// (k b)²/10 of a wave of k per length, b half the contact's: at this limit 0.96, of a line contact 0.95.
const LENGTHS: f64 = 5.0;

/// Refuses waves that a contact would average out.
pub(super) fn check_waves(scene: &Scene) -> Result<(), SimulationError> {
    if scene.waviness.is_empty() {
        return Ok(());
    }
    let force = largest_force(scene);
    let along = |side| {
        let approach = largest_approach(&scene.bearing, side, force);
        2.0 * element_on_track(&scene.bearing, side).contact_half_axes(approach)[0]
    };
    for waves in &scene.waviness {
        let contact = match waves.on {
            WavyBody::Inner => along(RacewaySide::Inner),
            WavyBody::Outer => along(RacewaySide::Outer),
            WavyBody::Element(_) => along(RacewaySide::Inner).max(along(RacewaySide::Outer)),
        };
        let limit = (TAU * waves.on.radius(&scene.bearing) / (LENGTHS * contact)).floor();
        if f64::from(waves.order) > limit {
            let contact_mm = contact * 1e3;
            return Err(SimulationError::ShortWaves { order: waves.order, limit, contact_mm, force });
        }
    }
    Ok(())
}
