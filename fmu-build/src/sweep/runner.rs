//! One run of a sweep: its scene is stepped, and its row and signals are made of what the sensors show.

use std::collections::HashMap;
use std::f64::consts::TAU;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use anyhow::{Context, Result, bail};
use brinell::geometry::kinematics::passage_frequency;
use brinell::scene::{DefectOn, Scene};
use brinell::simulation::Simulation;
use brinell_analysis::statistics::mean;
use toml::Value;

use super::design::Run;
use super::file::{Kind as Fault, Sweep};
use super::folder::Folder;
use super::maps::Maps;
use super::rows::columns::envelope_name;
use super::rows::labels::{self, carries_shaft_load, rounded};
use super::rows::statistics::{OneElement, Passage, Statistics, passages};
use super::rows::{Cell, Column, Kind, Row};
use super::scenes::{Base, is_of_defect, run_name};
use crate::interrupt::Interrupted;
use crate::package::model::tell_surface;
use crate::run::columns::Columns;
use crate::run::noise_spectrum::NoiseSpectrum;
use crate::run::run_loop::{Done, RunLoop};
use crate::run::signals::{Growing, Signals};
use crate::run::speed_profile::SpeedProfile;
use crate::shared::{Grid, NotWritten, shipped};

/// All that runs share.
pub(super) struct SweepRunner<'a> {
    pub(super) sweep: &'a Sweep,
    pub(super) base: &'a Base,
    pub(super) columns: &'a [Column],
    pub(super) speeds: &'a [SpeedProfile],
    pub(super) spectrum: Option<&'a NoiseSpectrum>,
    pub(super) grid: Grid,
    /// Where signals grow and go.
    pub(super) folder: &'a Folder,
    /// Texts of profiles that scenes name, once they were read.
    pub(super) texts: Mutex<HashMap<String, Arc<str>>>,
}

/// A run that is ready: its scene, and the texts of the profiles that it names.
pub(super) struct Ready {
    pub(super) scene: Scene,
    pub(super) table: toml::Table,
    pub(super) texts: Vec<Arc<str>>,
}

impl SweepRunner<'_> {
    /// The scene of a run.
    pub(super) fn ready(&self, run: &Run) -> Result<Ready> {
        let (scene, table) = self.base.scene(self.sweep, run)?;
        if scene.sensors.is_empty() {
            bail!("the scene has no [sensor]: a sweep is about what sensors show");
        }
        let texts = scene.profile_names().into_iter().map(|name| self.text(&scene, name)).collect::<Result<_>>()?;
        Ok(Ready { scene, table, texts })
    }

    fn text(&self, scene: &Scene, name: &str) -> Result<Arc<str>> {
        let mut texts = self.texts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(text) = texts.get(name) {
            return Ok(Arc::clone(text));
        }
        let text: Arc<str> = shipped::text_beside(&self.base.path, name)?.into();
        tell_surface(scene, name, &text);
        texts.insert(name.to_owned(), Arc::clone(&text));
        Ok(text)
    }

    /// The row of a run, whatever becomes of it.
    ///
    /// # Errors
    /// Only what is no run's fault: a disk that is full, a column that the table does not have, a user who ends the
    /// sweep.
    pub(super) fn row(&self, run: &Run, maps: &Maps, fingerprints: &[u64]) -> Result<Row> {
        let mut row = Row::of(self.columns, run.index);
        self.put_values(&mut row, run)?;
        let made = panic::catch_unwind(AssertUnwindSafe(|| self.fill(&mut row, run, maps, fingerprints)));
        let error = match made {
            Ok(Ok(())) => return Ok(row),
            Ok(Err(error)) if error.is::<NotWritten>() || error.is::<Interrupted>() => return Err(error),
            Ok(Err(error)) => format!("{error:#}"),
            Err(_) => "the run ended in a fault of the program; standard error says where".to_owned(),
        };
        row.put(self.columns, "error", Cell::Text(error))?;
        Ok(row)
    }

    /// What a run was given.
    fn put_values(&self, row: &mut Row, run: &Run) -> Result<()> {
        let mut put = |name: &str, cell: Cell| row.put(self.columns, name, cell);
        // What is drawn of a defect says nothing of a bearing that has none.
        let is_its_own = |key: &str| run.kind != Some(Fault::Healthy) || !is_of_defect(key);
        for (key, value) in run.values.iter().filter(|(key, _)| is_its_own(key)) {
            let cell = match (value, self.columns.iter().find(|column| column.name == *key).map(|column| column.kind)) {
                (Value::Integer(whole), Some(Kind::Whole)) => Cell::Whole(*whole),
                (value, Some(Kind::Number)) => super::file::number(value).map_or(Cell::Missing, Cell::Number),
                (Value::String(text), _) => Cell::Text(text.clone()),
                (value, _) => Cell::Text(value.to_string()),
            };
            put(key, cell)?;
        }
        if let Some(kind) = run.kind {
            put("kind", Cell::Text(kind.word().to_owned()))?;
        }
        if let Some(grown) = self.sweep.grown(run.index) {
            put("bearing", Cell::Whole(self.sweep.bearing(run.index) as i64))?;
            if run.kind != Some(Fault::Healthy) {
                put("label_growth", Cell::Number(grown))?;
            }
        }
        if let Some(profile) = run.profile {
            put("speed_profile", Cell::Text(self.sweep.speed_profiles[profile].clone()))?;
        }
        if let Some(split) = &self.sweep.split {
            put(
                "split",
                Cell::Text(split.part(self.sweep.seed, self.sweep.bearing(run.index), &run.values).to_owned()),
            )?;
        }
        if let Some(noise) = run.noise {
            let drawn = [("noise_db", noise.ratio), ("noise_rms_m_s2", noise.floor)];
            for (name, value) in drawn.into_iter().filter_map(|(name, value)| Some((name, value?))) {
                put(name, Cell::Number(value))?;
            }
        }
        Ok(())
    }

    fn fill(&self, row: &mut Row, run: &Run, maps: &Maps, fingerprints: &[u64]) -> Result<()> {
        let Ready { scene, table, texts } = self.ready(run)?;
        self.label(row, &scene, &table, run)?;
        let map = maps.take(fingerprints)?;
        let mut simulation = Simulation::with_shared_map(scene.clone(), texts.iter().map(|text| &**text), map)?;
        let profile = run.profile.map(|profile| &self.speeds[profile]);
        let name = run_name(run.index);
        let own = self.folder.running.join(&name);
        std::fs::create_dir_all(&own).map_err(|error| NotWritten::new(&own, error))?;
        let columns = self.wanted(&scene, &simulation)?;
        let run_loop = RunLoop { grid: self.grid, profile, shows: false };
        let done = run_loop.simulate(&scene, &mut simulation, columns, &own, &own)?;
        if done.interrupted_at.is_some() {
            return Err(Interrupted.into());
        }
        let kept = self.kept(&scene, &done, &own.join(format!("{name}.kept")))?;
        if let Some(noise) = run.noise {
            let sensors: Vec<usize> = (1..kept.names().len()).collect();
            noise.add(&kept, &sensors, 0)?;
            if let Some(spectrum) = self.spectrum {
                spectrum.add(&kept, &sensors, self.sweep.rate, noise.seed)?;
            }
        }
        self.measure(row, &scene, &done, &kept)?;
        self.folder.write(&kept, run.index, self.sweep.rate, &toml::to_string(&table)?)?;
        Ok(std::fs::remove_dir_all(&own).map_err(|error| NotWritten::new(&own, error))?)
    }

    /// The signals that are kept of each step.
    fn wanted(&self, scene: &Scene, simulation: &Simulation) -> Result<Columns> {
        let mut names = vec!["cage.speed".to_owned(), "solver.steps".to_owned(), "solver.rejected_steps".to_owned()];
        names.extend((0..scene.sensors.len()).map(|number| scene.sensor_variable(number)));
        if !carries_shaft_load(scene) {
            names.extend(["shaft.force.x".to_owned(), "shaft.force.y".to_owned()]);
        }
        if passes_outer_defect(scene).is_some() {
            names.extend(["element[*].angle".to_owned(), "element[*].force.outer".to_owned()]);
        }
        Columns::matching(simulation.table(), &names)
    }

    /// What the sensors show after the settling time, in a file of its own.
    fn kept(&self, scene: &Scene, done: &Done, file: &Path) -> Result<Signals> {
        let source = done.recording.as_ref().unwrap_or(&done.signals);
        let is_sensor = |name: &str| (0..scene.sensors.len()).any(|number| scene.sensor_variable(number) == name);
        let indices = source.indices(|name| name == "time" || is_sensor(name));
        let names: Vec<String> = indices.iter().map(|&index| source.names()[index].clone()).collect();
        // Without the instant at which settling ends, however it was rounded.
        let late = self.sweep.settle + 1e-9 / self.sweep.rate;
        let mut count = 0;
        source.each_row(|row| {
            count += u64::from(row[0] > late);
            Ok(())
        })?;
        if count < 2 {
            bail!("{count} samples after {} s: there must be 2 at least", self.sweep.settle);
        }
        let full = |error| NotWritten::new(file, error);
        let mut kept = Growing::create(file, names, count).map_err(full)?;
        let mut values = vec![0.0; indices.len()];
        source.each_row(|row| {
            if row[0] > late {
                values.iter_mut().zip(&indices).for_each(|(value, &index)| *value = row[index]);
                kept.push(&values).map_err(full)?;
            }
            Ok(())
        })?;
        Ok(kept.end().map_err(full)?)
    }

    /// What the run is a run of.
    fn label(&self, row: &mut Row, scene: &Scene, table: &toml::Table, run: &Run) -> Result<()> {
        let speed = match run.profile.map(|profile| &self.speeds[profile]) {
            None => rounded(scene.shaft_speed / TAU),
            Some(profile) => {
                let late = (0..=self.grid.count).map(|k| k as f64 * self.grid.step).filter(|t| *t > self.sweep.settle);
                let (sum, count) = late.fold((0.0, 0.0), |(sum, count), t| (sum + profile.hertz(t), count + 1.0));
                sum / count
            }
        };
        labels::put(&mut |name, cell| row.put(self.columns, name, cell), scene, table, speed, self.sweep.rate)
    }

    /// Statistics of the first sensor, passage of the defect, and steps.
    fn measure(&self, row: &mut Row, scene: &Scene, done: &Done, kept: &Signals) -> Result<()> {
        let names = done.signals.names();
        let columns = done.signals.columns(&(0..names.len()).collect::<Vec<_>>())?;
        let column = |name: &str| {
            let index = names.iter().position(|known| known == name).with_context(|| format!("no column {name}"))?;
            anyhow::Ok(columns[index].as_slice())
        };
        let (time, cage) = (column("time")?, column("cage.speed")?);
        let (count, outer) = (scene.bearing.element_count, scene.housing_speed.unwrap_or(0.0));
        let against_outer: Vec<f64> = cage.iter().map(|cage| cage - outer).collect();
        let statistics = Statistics::of(&kept.column(1)?, &passages(time, &against_outer, count, &kept.column(0)?));
        let late = cage.iter().zip(time).filter(|(_, t)| **t > self.sweep.settle);
        let bpfo = late.map(|(cage, _)| passage_frequency(count, cage / TAU, outer / TAU)).collect::<Vec<_>>();
        let mut put = |name: &str, cell: Cell| row.put(self.columns, name, cell);
        let mut number = |name: &str, value: f64| put(name, Cell::Number(value));
        number("bpfo_hz", mean(&bpfo))?;
        number("rms_m_s2", statistics.rms)?;
        number("peak_m_s2", statistics.peak)?;
        number("kurtosis", statistics.kurtosis)?;
        if !carries_shaft_load(scene) {
            let [x, y] = [column("shaft.force.x")?, column("shaft.force.y")?].map(|force| force[0]);
            number("label_load_n", x.hypot(y))?;
            number("load", x.hypot(y))?;
        }
        for (k, line) in statistics.envelope.into_iter().flatten().enumerate() {
            number(&envelope_name(k + 1), line)?;
        }
        if let Some(defect) = passes_outer_defect(scene) {
            let element = |j: usize| {
                let angle = column(&format!("element[{j}].angle"))?;
                anyhow::Ok(OneElement { angle, force: column(&format!("element[{j}].force.outer"))? })
            };
            let elements = (1..=count).map(element).collect::<Result<Vec<_>>>()?;
            if let Some(passage) = Passage::first(time, &elements, defect, self.sweep.settle) {
                number("unloaded_s", passage.unloaded)?;
                number("loaded_again_s", passage.loaded_again)?;
                number("unloaded_deg", passage.turned.to_degrees())?;
            }
        }
        for (name, variable) in [("steps", "solver.steps"), ("rejected_steps", "solver.rejected_steps")] {
            put(name, Cell::Whole(column(variable)?.last().copied().unwrap_or(0.0) as i64))?;
        }
        Ok(())
    }
}

/// Angle of the one defect on an outer ring that stands (rad): elements pass it where their angles say.
fn passes_outer_defect(scene: &Scene) -> Option<f64> {
    match &scene.defects[..] {
        [defect] if defect.on == DefectOn::Outer && scene.housing_speed.is_none() => Some(defect.angle),
        _ => None,
    }
}
