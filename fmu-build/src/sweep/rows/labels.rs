//! Labels of a run: what it is a run of, by this project's names and by those of public collections.

use std::f64::consts::TAU;

use anyhow::Result;
use brinell::geometry::kinematics::Frequencies;
use brinell::scene::{Defect, DefectShape, Motion, Scene};
use brinell::simulation::setup::with_operating_angle;

use super::Cell;
use crate::sweep::file::{Kind as Fault, number};
use crate::sweep::scenes::Base;

/// Puts a cell into the column of a name.
type Put<'a> = dyn FnMut(&str, Cell) -> Result<()> + 'a;

/// Labels a run of this scene, whose file is `table`; its shaft turns at `speed` (Hz), and samples come at `rate` (Hz).
pub(in crate::sweep) fn put(
    put: &mut Put<'_>,
    scene: &Scene,
    table: &toml::Table,
    speed: f64,
    rate: f64,
) -> Result<()> {
    let (kind, shape) = match &scene.defects[..] {
        [] => (Fault::Healthy.word(), None),
        [defect] => (Fault::of(defect.on).word(), Some(defect)),
        _ => ("several", None),
    };
    put("label_kind", Cell::Text(kind.to_owned()))?;
    if let Some(defect) = shape {
        if let DefectShape::Spall { length, depth, .. } = defect.shape {
            put("label_length_mm", Cell::Number(rounded(length * 1e3)))?;
            put("label_depth_um", Cell::Number(rounded(depth * 1e6)))?;
        }
        // As the file has it, in degrees.
        let angle = Base::value(table, "defect.angle_deg").and_then(number);
        put("label_angle_deg", Cell::Number(angle.unwrap_or(rounded(defect.angle.to_degrees()))))?;
    }
    if carries_shaft_load(scene) {
        let load = rounded(scene.shaft.load[0].hypot(scene.shaft.load[1]));
        put("label_load_n", Cell::Number(load))?;
        put("load", Cell::Number(load))?;
    }
    put("label_speed_hz", Cell::Number(speed))?;
    in_the_fields_words(put, scene, speed, rate)
}

/// The same in the words of public collections of recordings.
fn in_the_fields_words(put: &mut Put<'_>, scene: &Scene, speed: f64, rate: f64) -> Result<()> {
    let faults: Vec<&str> = scene.defects.iter().map(|defect| Fault::of(defect.on).field_word()).collect();
    let healthy = faults.is_empty();
    let kind = if healthy { Fault::Healthy.field_word().to_owned() } else { faults.join("+") };
    put("fault_type", Cell::Text(kind))?;
    put("fault_location", Cell::Text(if healthy { "none" } else { "test_bearing" }.to_owned()))?;
    let lengths: Vec<f64> = scene.defects.iter().filter_map(length).collect();
    // A profile's length is in its file.
    if healthy || lengths.len() == scene.defects.len() {
        put("fault_size_mm", Cell::Number(rounded(1e3 * lengths.into_iter().fold(0.0, f64::max))))?;
    }
    put("speed_rpm", Cell::Number(rounded(60.0 * speed)))?;
    put("load_unit", Cell::Text("N".to_owned()))?;
    put("fs", Cell::Number(rate))?;
    // Without slip, as they are computed from a data sheet.
    let mut nominal = scene.clone();
    (nominal.cage.slip, nominal.cage.spin_slip) = (0.0, 0.0);
    let Frequencies { bpfo, bpfi, bsf, ftf } = Frequencies::of(&with_operating_angle(&nominal));
    for (name, hertz) in [("bpfo", bpfo), ("bpfi", bpfi), ("bsf", bsf), ("ftf", ftf)] {
        put(name, Cell::Number(rounded(hertz / (scene.shaft_speed / TAU).abs())))?;
    }
    Ok(())
}

/// Length of a spall (m).
fn length(defect: &Defect) -> Option<f64> {
    match defect.shape {
        DefectShape::Spall { length, .. } => Some(length),
        DefectShape::Profile(_) => None,
    }
}

/// Whether the bearing carries the shaft's load and nothing else: of a shaft that only the bearing holds. Otherwise its
/// load is its force on the shaft at the start, where rings and elements are in balance.
pub(in crate::sweep) fn carries_shaft_load(scene: &Scene) -> bool {
    scene.shaft.motion == Motion::Internal && scene.shaft.stiffness == 0.0
}

/// Without the last digits, which a change of units leaves.
pub(in crate::sweep) fn rounded(value: f64) -> f64 {
    format!("{value:.12e}").parse().unwrap_or(value)
}
