//! Labels of a run: what it is a run of, by this project's names and by those of public collections.

use std::f64::consts::TAU;

use anyhow::Result;
use brinell::geometry::kinematics::Frequencies;
use brinell::scene::{Defect, DefectOn, DefectShape, Motion, Scene};
use toml::Value;

use super::statistics::HARMONICS;
use super::{Cell, Column, Kind};
use crate::sweep::file::{Kind as Fault, Sweep, number};
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
        [defect] => (kind_of(defect.on).word(), Some(defect)),
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
    let faults: Vec<&str> = scene.defects.iter().map(|defect| field_word(defect.on)).collect();
    let healthy = faults.is_empty();
    put("fault_type", Cell::Text(if healthy { "normal".to_owned() } else { faults.join("+") }))?;
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
    let Frequencies { bpfo, bpfi, bsf, ftf } = Frequencies::of(&nominal);
    for (name, hertz) in [("bpfo", bpfo), ("bpfi", bpfi), ("bsf", bsf), ("ftf", ftf)] {
        put(name, Cell::Number(rounded(hertz / (scene.shaft_speed / TAU).abs())))?;
    }
    Ok(())
}

/// Columns of the table of a sweep.
pub(in crate::sweep) fn columns(sweep: &Sweep, is_whole: &dyn Fn(&str) -> bool) -> Vec<Column> {
    let mut columns = vec![Column { name: "run".to_owned(), kind: Kind::Whole }];
    let mut add = |name: &str, kind: Kind| columns.push(Column { name: name.to_owned(), kind });
    if !sweep.kinds.is_empty() {
        add("kind", Kind::Text);
    }
    if !sweep.speed_profiles.is_empty() {
        add("speed_profile", Kind::Text);
    }
    for entry in &sweep.grid {
        let whole = entry.of.iter().all(Value::is_integer) && is_whole(&entry.key);
        let numbers = entry.of.iter().all(|value| number(value).is_some());
        add(
            &entry.key,
            if whole {
                Kind::Whole
            } else if numbers {
                Kind::Number
            } else {
                Kind::Text
            },
        );
    }
    for entry in &sweep.random {
        add(&entry.key, if is_whole(&entry.key) { Kind::Whole } else { Kind::Number });
    }
    for (name, limits) in [("noise_db", sweep.noise.ratio), ("noise_rms_m_s2", sweep.noise.floor)] {
        if limits.is_some() {
            add(name, Kind::Number);
        }
    }
    add("label_kind", Kind::Text);
    for label in ["length_mm", "depth_um", "angle_deg", "load_n", "speed_hz"] {
        add(&format!("label_{label}"), Kind::Number);
    }
    for (name, kind) in FIELD_LABELS {
        add(name, kind);
    }
    for name in ["bpfo_hz", "rms_m_s2", "peak_m_s2", "kurtosis"] {
        add(name, Kind::Number);
    }
    (1..=HARMONICS).for_each(|k| add(&envelope_name(k), Kind::Number));
    for name in ["unloaded_s", "loaded_again_s", "unloaded_deg"] {
        add(name, Kind::Number);
    }
    for name in ["steps", "rejected_steps"] {
        add(name, Kind::Whole);
    }
    add("error", Kind::Text);
    columns
}

/// Labels by the names and words of the package bearing-datasets, so that its recordings and runs stand in one table.
const FIELD_LABELS: [(&str, Kind); 11] = [
    ("fault_type", Kind::Text),
    ("fault_location", Kind::Text),
    ("fault_size_mm", Kind::Number),
    ("speed_rpm", Kind::Number),
    ("load", Kind::Number),
    ("load_unit", Kind::Text),
    ("fs", Kind::Number),
    ("bpfo", Kind::Number),
    ("bpfi", Kind::Number),
    ("bsf", Kind::Number),
    ("ftf", Kind::Number),
];

fn field_word(on: DefectOn) -> &'static str {
    match on {
        DefectOn::Outer => "outer",
        DefectOn::Inner => "inner",
        DefectOn::Element { .. } => "rolling_element",
    }
}

/// Length of a spall (m).
fn length(defect: &Defect) -> Option<f64> {
    match defect.shape {
        DefectShape::Spall { length, .. } => Some(length),
        DefectShape::Profile(_) => None,
    }
}

pub(in crate::sweep) fn envelope_name(k: usize) -> String {
    format!("envelope_{k}_bpfo_m_s2")
}

fn kind_of(on: DefectOn) -> Fault {
    match on {
        DefectOn::Outer => Fault::Outer,
        DefectOn::Inner => Fault::Inner,
        DefectOn::Element { .. } => Fault::Element,
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
