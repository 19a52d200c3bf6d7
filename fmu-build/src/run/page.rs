//! What the page of a run is made of beside its signals: the bearing's frequencies, the defects with their surfaces,
//! and where the files are.

use std::path::Path;

use anyhow::Result;
use brinell::contact::rolling::RacewaySide;
use brinell::geometry::kinematics::Frequencies;
use brinell::scene::DefectOn;
use brinell::simulation::setup::track_across;
use brinell::surface::Surface;
use serde_json::{Value, json};

use super::signals::Signals;
use crate::package::Model;

/// Most points of a surface that are drawn.
const POINTS: usize = 4000;

/// Files of a run.
pub(super) struct Files<'a> {
    /// At communication points, with all variables.
    pub(super) signals: &'a Signals,
    /// The recorder's samples.
    pub(super) recording: Option<&'a Signals>,
    /// Spectrum of the envelope, a CSV with a JSON beside it.
    pub(super) envelope: Option<&'a Path>,
    /// Whether the shaft's speed changes.
    pub(super) changes: bool,
    /// Orders, with what there is to mark.
    pub(super) orders: Option<&'a (std::path::PathBuf, Value)>,
}

/// All of it as JSON.
///
/// # Errors
/// Those of a profile's file.
pub(super) fn described(model: &Model, files: &Files, notes: &[String]) -> Result<Value> {
    let scene = &model.scene;
    let bearing = &scene.bearing;
    let surfaces = Surface::load_all(scene, model.profile_texts())?;
    let defects = scene.defects.iter().zip(surfaces).map(|(defect, surface)| {
        let profile = match surface {
            Surface::Profile(profile) => profile,
            Surface::Topography(topography) => topography.profile_at(track_across(model.simulation.scene(), defect.on)),
        };
        let every = profile.points().len().div_ceil(POINTS);
        let (on, element) = match defect.on {
            DefectOn::Outer => ("outer", None),
            DefectOn::Inner => ("inner", None),
            DefectOn::Element { element, .. } => ("element", Some(element + 1)),
        };
        json!({
            "on": on,
            "element": element,
            "angle": defect.angle,
            "radius": defect.on.radius(bearing),
            "surface": profile.points().iter().step_by(every).collect::<Vec<_>>(),
        })
    });
    Ok(json!({
        "name": scene.name,
        "description": scene.description,
        "count": bearing.element_count,
        "clearance": bearing.radial_clearance,
        "element_radius": bearing.element_radius(),
        "outer_radius": bearing.outer_raceway_radius(),
        "inner_radius": bearing.inner_raceway_radius(),
        "passage": 1.0 / Frequencies::of(model.simulation.scene()).bpfo.abs().max(1.0),
        "sensor": if scene.sensors.is_empty() { "housing.ay".to_owned() } else { scene.sensor_variable(0) },
        "changes": files.changes,
        "turns": scene.housing_speed.is_some(),
        "section": section(model),
        "signals": files.signals.path(),
        "recording": files.recording.map(Signals::path),
        "recorder_rate": scene.recorder.map(|recorder| recorder.rate),
        "envelope": files.envelope,
        "orders": files.orders.map(|(path, said)| json!({ "file": path, "said": said })),
        "defects": defects.collect::<Vec<_>>(),
        "notes": notes,
    }))
}

/// The grooves of the outer and of the inner ring, where balls move across them; lengths in metres, shoulders in
/// radians from the groove's bottom.
fn section(model: &Model) -> Value {
    let Some(space) = &model.simulation.equations().0.space else { return Value::Null };
    let of = |side: RacewaySide| {
        let (k, groove) = (side as usize, &space.grooves[side as usize]);
        json!({
            "centre_radius": groove.centre_radius,
            "shift": groove.shift,
            "radius": groove.radius,
            "shoulder": space.shoulders[k],
            // Half of the ellipse across the groove under 1 N; it grows with the cube root of the force.
            "half_length": space.half_lengths[k],
        })
    };
    json!({ "outer": of(RacewaySide::Outer), "inner": of(RacewaySide::Inner) })
}
