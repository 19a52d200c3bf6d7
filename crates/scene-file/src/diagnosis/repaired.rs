//! A scene file without what is wrong with it: what was left out is ignored, and the rest can be checked.

use super::all_tables::path;
use super::locations::{Location, at_mut, table_mut};
use crate::rivals::exclude_each_other;
use crate::tables::{Faults, SceneFile, TableFault};
use brinell::scene::Scene;
use serde::Deserialize;
use std::borrow::Cow;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

/// What stands for a key that cannot be missing.
#[derive(Clone, Copy)]
enum StandIn {
    /// As it would be written.
    Value(&'static str),
    /// A bearing with the elements that the file asks for.
    Bearing,
}
use StandIn::{Bearing, Value};

/// Table, key, and what stands for it where no key is there that excludes it.
const STAND_INS: [(&str, &str, StandIn); 22] = [
    ("", "name", Value("'scene'")),
    ("", "bearing", Value("{}")),
    ("", "shaft", Value("{}")),
    ("", "housing", Value("{}")),
    ("bearing", "catalogue", Bearing),
    ("film", "viscosity_pa_s", Value("0.04")),
    ("film", "pressure_viscosity_1_pa", Value("2e-8")),
    ("cage", "seed", Value("0")),
    ("defect", "angle_deg", Value("0.0")),
    ("defect", "length_mm", Value("1.0")),
    ("defect", "depth_um", Value("1.0")),
    ("defect.profile", "file", Value("'profile.csv'")),
    ("waviness", "order", Value("2")),
    ("waviness", "amplitude_um", Value("0.0")),
    ("waviness", "angle_deg", Value("0.0")),
    ("shaft", "motion", Value("'internal'")),
    ("shaft", "speed_hz", Value("0.0")),
    ("housing", "motion", Value("'internal'")),
    ("sensor.mode", "frequency_hz", Value("1e3")),
    ("sensor.mode", "damping_ratio", Value("0.1")),
    ("sensor.mode", "gain", Value("1.0")),
    ("recorder", "rate_hz", Value("51200.0")),
];

/// Keys from which a bearing's dimensions are.
const DIMENSIONS: [&str; 6] =
    ["catalogue", "element", "element_count", "element_diameter_mm", "pitch_diameter_mm", "roller_length_mm"];

/// The file as far as it is right, and what was left out.
pub(super) struct Repaired<'t> {
    file: Spanned<DeTable<'t>>,
    excluded: Vec<(Location, String)>,
}

impl<'t> Repaired<'t> {
    /// Nothing left out yet.
    pub(super) fn of(file: Spanned<DeTable<'t>>) -> Self {
        Self { file, excluded: Vec::new() }
    }

    /// Leaves a key out. Whether it was not left out before.
    pub(super) fn exclude(&mut self, location: Location, key: &str) -> bool {
        if self.is_excluded(location, key) {
            return false;
        }
        if let Some(table) = at_mut(self.file.get_mut(), location) {
            table.remove(key);
        }
        self.excluded.push((location, key.to_owned()));
        true
    }

    /// Whether a key was left out, or all of its table.
    pub(super) fn is_excluded(&self, location: Location, key: &str) -> bool {
        let outer = location.table.split('.').next().unwrap_or_default();
        let is_it = |(at, left_out): &(Location, String)| {
            (*at == location && left_out == key) || (at.table.is_empty() && !outer.is_empty() && left_out == outer)
        };
        self.excluded.iter().any(is_it)
    }

    /// Whether something was left out that the bearing's dimensions are from.
    pub(super) fn lacks_dimensions(&self) -> bool {
        let bearing = Location { table: "bearing", number: [0; 2] };
        DIMENSIONS.iter().any(|key| self.is_excluded(bearing, key))
    }

    /// What is still wrong; nothing where that is not known.
    pub(super) fn errors(&mut self) -> Vec<TableFault> {
        for (name, key, stand_in) in STAND_INS {
            let own = path(name, key, false);
            each(self.file.get_mut(), name, &mut |table| {
                if !table.contains_key(key)
                    && !table.keys().any(|other| exclude_each_other(&own, &path(name, other.get_ref(), false)))
                    && let Ok(value) = DeValue::parse(stand_in.written(table))
                {
                    table.insert(Spanned::new(0..0, Cow::Borrowed(key)), value);
                }
            });
        }
        match SceneFile::deserialize(Deserializer::from(self.file.clone())) {
            Ok(file) => checked(file).map_or_else(|faults| faults.0, |_| Vec::new()),
            Err(_) => Vec::new(),
        }
    }
}

/// The scene of a file, if it is possible.
pub(super) fn checked(file: SceneFile) -> Result<Scene, Faults> {
    let scene = file.into_scene()?;
    scene.check()?;
    Ok(scene)
}

impl StandIn {
    fn written(self, table: &DeTable<'_>) -> &'static str {
        let element = || table.get("element").and_then(|element| element.get_ref().as_str());
        match self {
            Value(written) => written,
            Bearing if element() == Some("cylindrical-roller") => "'NU205'",
            Bearing => "'6205'",
        }
    }
}

/// Does something to every table of a name.
fn each<'t>(table: &mut DeTable<'t>, name: &str, act: &mut dyn FnMut(&mut DeTable<'t>)) {
    if name.is_empty() {
        return act(table);
    }
    let (first, rest) = name.split_once('.').unwrap_or((name, ""));
    match table.get_mut(first).map(Spanned::get_mut) {
        Some(DeValue::Table(inner)) => each(inner, rest, act),
        Some(DeValue::Array(several)) => {
            several.iter_mut().filter_map(table_mut).for_each(|one| each(one, rest, act));
        }
        _ => {}
    }
}
