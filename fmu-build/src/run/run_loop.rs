//! The steps of a run without a host, and what it leaves in files.

use std::path::Path;

use anyhow::{Context, Result};
use brinell::recording::Recording;
use brinell::scene::Scene;
use brinell::simulation::Simulation;

use super::columns::Columns;
use super::signals::{Growing, Signals};
use super::speed_profile::SpeedProfile;
use crate::interrupt::{self, Held};
use crate::shared::{Grid, NotWritten, talk};

/// Communication steps between two looks of a bar.
const EVERY: u64 = 64;

/// When a run communicates, and how fast its shaft turns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RunLoop<'a> {
    /// Communication points.
    pub(crate) grid: Grid,
    /// The shaft's speed over time, where it changes.
    pub(crate) profile: Option<&'a SpeedProfile>,
    /// Whether a bar shows how far it is.
    pub(crate) shows: bool,
}

/// What a run leaves in its own folder.
pub(crate) struct Done {
    /// The columns that were asked for, after the time.
    pub(crate) signals: Signals,
    /// Name and unit of its columns, the time's first.
    pub(crate) units: Vec<(String, &'static str)>,
    /// What the scene's recorder has sampled.
    pub(crate) recording: Option<Signals>,
    /// When a user ended it before its time (s).
    pub(crate) interrupted_at: Option<f64>,
}

impl RunLoop<'_> {
    /// Runs the simulation of a scene; its signals go into `growing`. A full disk is an error about the table at
    /// `about`.
    pub(crate) fn simulate(
        &self,
        scene: &Scene,
        simulation: &mut Simulation,
        mut columns: Columns,
        growing: &Path,
        about: &Path,
    ) -> Result<Done> {
        simulation.record_into(&growing.to_string_lossy());
        let shaft_speed = simulation.reference("shaft.speed")?;
        if let Some(profile) = self.profile {
            simulation.set_reals(&[shaft_speed], &[profile.at(0.0)])?;
        }
        simulation.initialize(0.0).context("initial equilibrium")?;
        let mut recording = Recording::begin(simulation, &scene.name)?;
        let units: Vec<(String, &str)> =
            std::iter::once(("time", "s")).chain(columns.names()).map(|(name, unit)| (name.to_owned(), unit)).collect();
        let full = |error| NotWritten::new(about, error);
        let names = units.iter().map(|(name, _)| name.clone()).collect();
        // No recording has that name: those of scenes end in .npy alone.
        let file = growing.join("signals.table");
        let mut rows = Growing::create(&file, names, self.grid.count + 1).map_err(full)?;
        let mut row = vec![0.0; units.len()];
        let steps = if self.shows { self.grid.count } else { 0 };
        let bar = talk::bar(steps, "{msg} [{bar:30}] {percent} %, {eta} left").with_message(scene.name.clone());
        let held = Held::new();
        let mut interrupted_at = None;
        for index in 0..=self.grid.count {
            if index > 0 {
                if interrupt::came() {
                    interrupted_at = Some(simulation.time());
                    break;
                }
                self.step(simulation, shaft_speed, index)?;
                if let Some(recording) = &mut recording {
                    recording.keep_up(simulation)?;
                }
            }
            row[0] = simulation.time();
            columns.read(simulation, &mut row[1..])?;
            rows.push(&row).map_err(full)?;
            if self.shows && index % EVERY == 0 {
                bar.set_position(index);
            }
        }
        bar.finish_and_clear();
        drop(held);
        let signals = rows.end().map_err(full)?;
        let recording = match recording {
            None => None,
            Some(mut recording) => {
                recording.store(simulation)?;
                let recorder = simulation.recorder().into_iter().flat_map(|recorder| recorder.references());
                let names = recorder.map(|reference| simulation.table()[reference as usize].name.clone());
                let names = std::iter::once("time".to_owned()).chain(names).collect();
                Some(Signals::of_recording(recording.path(), names)?)
            }
        };
        Ok(Done { signals, units, recording, interrupted_at })
    }

    /// Communication step `number`, with the speed going straight from the profile's value at its start to that at its
    /// end.
    fn step(&self, simulation: &mut Simulation, shaft_speed: u32, number: u64) -> Result<()> {
        let at = simulation.time();
        let step = self.grid.length(number, at);
        if let Some(profile) = self.profile {
            let (from, to) = (profile.at(at), profile.at(at + step));
            simulation.set_reals(&[shaft_speed], &[from])?;
            simulation.set_input_derivatives(&[shaft_speed], &[1], &[(to - from) / step])?;
        }
        // An error of a step has its time.
        Ok(simulation.step(step)?)
    }
}
