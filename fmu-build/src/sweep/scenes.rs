//! The scene of each run: that of the sweep with what the run changes.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use brinell::scene::{ContactLaw, Defect, DefectShape, Scene};
use brinell::simulation::setup::largest_force;
use brinell_scene_file::replaces;
use toml::{Table, Value};

use super::design::Run;
use super::file::{Kind, Sweep, number};
use crate::package::model;
use crate::shared::note;

/// Loads: a number is along the scene's load, downwards where that has none.
pub(super) const LOADS: [&str; 2] = ["shaft.load_n", "housing.load_n"];
/// Maps for many defects are coarser than that of one studied closely: 0.4 % of the largest force, for a third of the
/// time.
const MAP_ACCURACY: f64 = 4e-3;
/// Cells of the grid behind maps of spalls: half as many rows across the contact as a scene's own map has. Columns
/// decide the force (`docs/evidence/contact.md`), and a map costs a quarter of the time.
const MAP_CELLS: [u32; 2] = [48, 16];

/// The scene that runs change.
pub(super) struct Base {
    /// Its file, or its name if it is a shipped one.
    pub(super) path: PathBuf,
    pub(super) text: String,
    pub(super) table: Table,
    pub(super) scene: Scene,
}

impl Base {
    /// Reads it; `beside` is the sweep's own file.
    pub(super) fn read(name: &str, beside: &Path) -> Result<Self> {
        let near = beside.parent().unwrap_or(Path::new("")).join(name);
        let path = if near.exists() { near } else { PathBuf::from(name) };
        let (text, scene) = model::read_scene(&path)?;
        for remark in model::remarks(&text, &scene) {
            note!("note: {}: {remark}", path.display());
        }
        Ok(Self { table: text.parse().with_context(|| path.display().to_string())?, text, path, scene })
    }

    /// The file of a run's scene, without what follows from it.
    ///
    /// # Errors
    /// A key that the scene cannot have.
    pub(super) fn changed(&self, sweep: &Sweep, run: &Run) -> Result<Table, String> {
        let mut table = self.table.clone();
        table.insert("name".to_owned(), Value::String(run_name(run.index)));
        if let Some(kind) = run.kind {
            put_on(&mut table, kind)?;
        }
        let set = sweep.set.iter().map(|entry| (entry.key.as_str(), &entry.of));
        let of_run = run.values.iter().map(|(key, value)| (key.as_str(), value));
        // What a healthy bearing's defect would be is of no interest.
        let healthy = run.kind == Some(Kind::Healthy);
        let given: Vec<(&str, &Value)> = set.chain(of_run).filter(|(key, _)| !(healthy && is_of_defect(key))).collect();
        for (key, _) in &given {
            // A key of [defect.profile] says that there is a profile.
            for key in [*key, key.rsplit_once('.').map_or(key, |(table, _)| table)] {
                let (inner, last) = inner(&mut table, key)?;
                let path = key.strip_suffix(last).unwrap_or_default();
                inner.retain(|other, _| !replaces(key, &format!("{path}{other}")));
            }
        }
        for (key, value) in given {
            let (inner, last) = inner(&mut table, key)?;
            let value = if LOADS.contains(&key) { load(inner.get(last), value) } else { value.clone() };
            inner.insert(last.to_owned(), value);
        }
        table.remove("recorder");
        if sweep.filter {
            let mut recorder = Table::new();
            recorder.insert("rate_hz".to_owned(), Value::Float(sweep.rate));
            recorder.insert("filter".to_owned(), Value::String("linear-phase".to_owned()));
            table.insert("recorder".to_owned(), Value::Table(recorder));
        }
        Ok(table)
    }

    /// The scene of a run, and its file as `brinell run` takes it.
    ///
    /// # Errors
    /// What is wrong with the scene.
    pub(super) fn scene(&self, sweep: &Sweep, run: &Run) -> Result<(Scene, Table)> {
        let mut table = self.changed(sweep, run).map_err(anyhow::Error::msg)?;
        let mut scene = brinell_scene_file::from_toml(&toml::to_string(&table)?)?;
        if scene.contact.law == ContactLaw::Map && !scene.defects.is_empty() {
            let force = *scene.contact.largest_force.get_or_insert(force_of_map(&scene, sweep));
            let accuracy = *scene.contact.map_accuracy.get_or_insert(MAP_ACCURACY);
            let is_spall = |defect: &Defect| matches!(defect.shape, DefectShape::Spall { .. });
            if scene.defects.iter().all(is_spall) {
                scene.contact.cells.get_or_insert(MAP_CELLS);
            }
            let contact = table.entry("contact").or_insert_with(|| Value::Table(Table::new()));
            if let Value::Table(contact) = contact {
                contact.insert("largest_force_n".to_owned(), Value::Float(force));
                contact.insert("map_accuracy".to_owned(), Value::Float(accuracy));
                if let Some(cells) = scene.contact.cells {
                    let cells = cells.map(|count| Value::Integer(count.into())).to_vec();
                    contact.insert("cells".to_owned(), Value::Array(cells));
                }
                scene.contact.flank_map =
                    *contact.entry("flank_map").or_insert(Value::Boolean(true)) == Value::Boolean(true);
            }
        }
        Ok((scene, table))
    }

    /// What the scene of a run says of a key.
    pub(super) fn value<'t>(table: &'t Table, key: &str) -> Option<&'t Value> {
        let mut parts = key.split('.');
        let first = table.get(parts.next()?)?;
        parts.try_fold(first, |value, part| value.as_table()?.get(part))
    }
}

/// Name of a run and of its files.
pub(super) fn run_name(index: u64) -> String {
    format!("run-{index:07}")
}

/// Whether a key is about the defect.
pub(super) fn is_of_defect(key: &str) -> bool {
    key == "defect" || key.starts_with("defect.")
}

/// Puts the defect on a body.
fn put_on(table: &mut Table, kind: Kind) -> Result<(), String> {
    if kind == Kind::Healthy {
        table.remove("defect");
        return Ok(());
    }
    let (defect, _) = inner(table, "defect.on")?;
    defect.insert("on".to_owned(), Value::String(kind.word().to_owned()));
    if kind == Kind::Element {
        defect.entry("element").or_insert(Value::Integer(1));
    } else {
        ["element", "tilt_deg"].iter().for_each(|key| {
            defect.remove(*key);
        });
    }
    Ok(())
}

/// The table in which a key stands, which is made where it is missing, and the key without its table.
fn inner<'t, 'k>(table: &'t mut Table, key: &'k str) -> Result<(&'t mut Table, &'k str), String> {
    let Some((path, last)) = key.rsplit_once('.') else { return Ok((table, key)) };
    let mut at = table;
    for part in path.split('.') {
        let next = at.entry(part).or_insert_with(|| Value::Table(Table::new()));
        if let (Value::String(_), "profile") = (&*next, part) {
            // The name of the file alone.
            let file = std::mem::replace(next, Value::Table(Table::new()));
            next.as_table_mut().map(|table| table.insert("file".to_owned(), file));
        }
        at = match next {
            Value::Table(inner) => inner,
            Value::Array(several) => match &mut several[..] {
                [Value::Table(only)] => only,
                _ => return Err(format!("{key}: the scene has several [[{part}]], and a sweep changes one [{part}]")),
            },
            _ => return Err(format!("{key}: {part} is no table of the scene")),
        };
    }
    Ok((at, last))
}

/// A load as the scene has it; that along the axis stays.
fn load(present: Option<&Value>, value: &Value) -> Value {
    let Some(force) = number(value) else { return value.clone() };
    let (along, axial) = match present.and_then(Value::as_array).map(Vec::as_slice) {
        Some([x, y, axial @ ..]) => (number(x).zip(number(y)), axial),
        _ => (None, &[][..]),
    };
    let size = along.map_or(0.0, |(x, y)| x.hypot(y));
    let (x, y) = along.filter(|_| size > 0.0).map_or((0.0, -1.0), |(x, y)| (x / size, y / size));
    Value::Array([x, y].map(|part| Value::Float(force * part)).into_iter().chain(axial.iter().cloned()).collect())
}

/// Force up to which the contact maps of a sweep's runs reach (N): for the largest load of all runs, so that they share
/// them.
fn force_of_map(scene: &Scene, sweep: &Sweep) -> f64 {
    let size = |value: &Value| match value.as_array() {
        Some(parts) => parts.iter().filter_map(number).fold(0.0, |sum: f64, part| sum.hypot(part)),
        None => number(value).unwrap_or(0.0).abs(),
    };
    let is_load = |key: &str| LOADS.contains(&key);
    let grid = sweep.grid.iter().filter(|entry| is_load(&entry.key)).flat_map(|entry| entry.of.iter().map(size));
    let random = sweep.random.iter().filter(|entry| is_load(&entry.key)).flat_map(|entry| entry.of.map(f64::abs));
    let own = [&scene.shaft, &scene.housing].map(|ring| ring.load[0].hypot(ring.load[1]));
    let heaviest = grid.chain(random).chain(own).fold(0.0, f64::max);
    let mut heavy = scene.clone();
    (heavy.shaft.load, heavy.housing.load) = ([0.0, -heaviest], [0.0; 2]);
    largest_force(&heavy)
}
