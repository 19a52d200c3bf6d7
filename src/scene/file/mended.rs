//! A scene file without what is wrong with it: what was left out is looked away from, and the rest can be checked.

use super::super::{Scene, SceneError};
use super::SceneFile;
use super::places::{Place, at_mut};
use toml::{Table, Value};

/// What stands for a key that cannot be missing.
#[derive(Clone, Copy)]
enum StandIn {
    Text(&'static str),
    Number(f64),
    Seed,
    Table,
    /// A bearing with the elements that the file asks for.
    Bearing,
}
use StandIn::{Bearing, Number, Seed, Text};

/// Table, key, what stands for it, and keys that go without it.
const STAND_INS: [(&str, &str, StandIn, &[&str]); 18] = [
    ("", "name", Text("scene"), &[]),
    ("", "bearing", StandIn::Table, &[]),
    ("", "shaft", StandIn::Table, &[]),
    ("", "housing", StandIn::Table, &[]),
    ("bearing", "catalogue", Bearing, &[]),
    ("film", "viscosity_pa_s", Number(0.04), &[]),
    ("film", "pressure_viscosity_1_pa", Number(2e-8), &[]),
    ("cage", "seed", Seed, &[]),
    ("defect", "angle_deg", Number(0.0), &[]),
    ("defect", "length_mm", Number(1.0), &["length_deg", "profile"]),
    ("defect", "depth_um", Number(1.0), &["profile"]),
    ("shaft", "motion", Text("internal"), &[]),
    ("shaft", "speed_hz", Number(0.0), &[]),
    ("housing", "motion", Text("internal"), &[]),
    ("sensor.mode", "frequency_hz", Number(1e3), &[]),
    ("sensor.mode", "damping_ratio", Number(0.1), &[]),
    ("sensor.mode", "gain", Number(1.0), &[]),
    ("recorder", "rate_hz", Number(51_200.0), &[]),
];

/// Keys from which a bearing's dimensions are.
const DIMENSIONS: [&str; 6] =
    ["catalogue", "element", "element_count", "element_diameter_mm", "pitch_diameter_mm", "roller_length_mm"];

/// The file as far as it is right, and what was left out.
pub(super) struct Mended {
    file: Table,
    spoilt: Vec<(Place, String)>,
}

impl Mended {
    /// Nothing left out yet; `None` of what is no TOML.
    pub(super) fn of(text: &str) -> Option<Self> {
        Some(Self { file: text.parse().ok()?, spoilt: Vec::new() })
    }

    /// Leaves a key out. Whether it was not left out before.
    pub(super) fn spoil(&mut self, place: Place, key: &str) -> bool {
        if self.is_spoilt(place, key) {
            return false;
        }
        if let Some(table) = at_mut(&mut self.file, place) {
            table.remove(key);
        }
        self.spoilt.push((place, key.to_owned()));
        true
    }

    /// Whether a key was left out, or all of its table.
    pub(super) fn is_spoilt(&self, place: Place, key: &str) -> bool {
        let outer = place.table.split('.').next().unwrap_or_default();
        let is_it = |(at, left_out): &(Place, String)| {
            (*at == place && left_out == key) || (at.table.is_empty() && !outer.is_empty() && left_out == outer)
        };
        self.spoilt.iter().any(is_it)
    }

    /// Whether something was left out that the bearing's dimensions are from.
    pub(super) fn lacks_dimensions(&self) -> bool {
        let bearing = Place { table: "bearing", number: [0; 2] };
        DIMENSIONS.iter().any(|key| self.is_spoilt(bearing, key))
    }

    /// What is still wrong; nothing where that cannot be said.
    pub(super) fn errors(&mut self) -> Vec<SceneError> {
        for (name, key, stand_in, instead) in STAND_INS {
            each(&mut self.file, name, &mut |table| {
                if !table.contains_key(key) && !instead.iter().any(|other| table.contains_key(*other)) {
                    table.insert(key.to_owned(), stand_in.value(table));
                }
            });
        }
        let Ok(file) = Value::Table(self.file.clone()).try_into::<SceneFile>() else { return Vec::new() };
        let checked = file.into_scene().and_then(|scene: Scene| scene.check());
        checked.map_or_else(SceneError::each, |()| Vec::new())
    }
}

impl StandIn {
    fn value(self, table: &Table) -> Value {
        match self {
            Self::Text(text) => Value::String(text.to_owned()),
            Self::Number(number) => Value::Float(number),
            Self::Seed => Value::Integer(0),
            Self::Table => Value::Table(Table::new()),
            Self::Bearing => {
                let rolls = table.get("element").and_then(Value::as_str) == Some("cylindrical-roller");
                Value::String(if rolls { "NU205" } else { "6205" }.to_owned())
            }
        }
    }
}

/// Does something to every table of a name.
fn each(table: &mut Table, name: &str, act: &mut dyn FnMut(&mut Table)) {
    if name.is_empty() {
        return act(table);
    }
    let (first, rest) = name.split_once('.').unwrap_or((name, ""));
    match table.get_mut(first) {
        Some(Value::Table(inner)) => each(inner, rest, act),
        Some(Value::Array(several)) => {
            several.iter_mut().filter_map(Value::as_table_mut).for_each(|one| each(one, rest, act))
        }
        _ => {}
    }
}
