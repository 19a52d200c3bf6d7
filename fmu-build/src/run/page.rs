//! What the page of a run is made of beside its signals: the bearing's frequencies, the defects with their surfaces,
//! and where the files are.

use std::path::{Path, PathBuf};

use anyhow::Result;
use brinell::contact::rolling::RacewaySide;
use brinell::geometry::kinematics::Frequencies;
use brinell::scene::DefectOn;
use brinell::simulation::setup::track_across;
use brinell::surface::Surface;
use serde_json::{Value, json};

use super::run_loop::Done;
use super::signals::Signals;
use crate::package::Model;

/// Most points of a surface that are drawn.
const POINTS: usize = 4000;

/// All of it as JSON, with the files of a run: at communication points with all variables and the recorder's samples,
/// the spectrum of the envelope, and orders with what there is to mark; `changes` says whether the shaft's speed does.
///
/// # Errors
/// Those of a profile's file.
pub(super) fn described(
    model: &Model,
    done: &Done,
    envelope: Option<&Path>,
    orders: Option<(PathBuf, Value)>,
    changes: bool,
    notes: &[String],
) -> Result<Value> {
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
        "changes": changes,
        "turns": scene.housing_speed.is_some(),
        "section": section(model),
        "signals": done.signals.path(),
        "recording": done.recording.as_ref().map(Signals::path),
        "recorder_rate": scene.recorder.map(|recorder| recorder.rate),
        "envelope": envelope,
        "orders": orders.map(|(path, said)| json!({ "file": path, "said": said })),
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
