//! One passage in detail: the four events of the line spall (the paper's Figure 1) and Epps' spall (Figures 4 and 5).

use std::ops::RangeInclusive;

use anyhow::{Context, Result};
use brinell::contact::rolled_path::RigidPath;
use brinell::contact::rolling::{RacewaySide, Rolling};
use brinell::surface::{Profile, Surface};
use brinell_analysis::sizing::waveform::{ringing, synthesis};

use super::Case;
use crate::shared::Project;

/// Samples per second where a passage is shown in detail: elements ring on their contacts at 40 to 50 kHz.
const RATE: f64 = 1e6;
const NAMES: [&str; 5] =
    ["sensor.acceleration", "housing.ay", "element[1].path", "element[1].force.inner", "element[1].force.outer"];
/// Length of Epps' spall along the raceway (m).
const EPPS_LENGTH: f64 = 0.8e-3;

/// Around a spall that is drawn (µm).
pub(super) const AROUND: RangeInclusive<i32> = -700..=700;

/// Names of columns with their units.
pub type Names = Vec<(String, &'static str)>;

/// The signals around one passage of element 1.
#[derive(Debug, Clone)]
pub struct Passage {
    /// Time from the leading edge (s).
    pub time: Vec<f64>,
    /// The sensor's and the housing's acceleration (m/s²), the element's path (m), inner and outer force (N).
    pub signals: Vec<Vec<f64>>,
}

impl Passage {
    /// From so long before the leading edge of a defect of so many degrees to so long after it (s).
    ///
    /// # Errors
    /// Of the simulation.
    pub fn of(project: &Project, case: &Case, length: f64, window: [f64; 2]) -> Result<Self> {
        let entry = case.entry(length);
        let run = case.record(project, &NAMES, RATE, entry + window[1])?;
        let from = ((entry - window[0]).max(0.0) * RATE) as usize;
        let time = (from..run[0].len()).map(|k| k as f64 / RATE - entry).collect();
        Ok(Self { time, signals: run.into_iter().map(|column| column[from..].to_vec()).collect() })
    }

    /// Mean vertical acceleration of the housing between two times (s, m/s²).
    pub fn mean_acceleration(&self, from: f64, to: f64) -> f64 {
        let within: Vec<f64> =
            self.time.iter().zip(&self.signals[1]).filter(|(t, _)| **t >= from && **t <= to).map(|(_, a)| *a).collect();
        within.iter().sum::<f64>() / within.len() as f64
    }

    /// Largest vertical acceleration of the housing between two times, either way (s, m/s²).
    pub fn shaken(&self, from: f64, to: f64) -> f64 {
        let within = self.time.iter().zip(&self.signals[1]).filter(|(t, _)| **t >= from && **t <= to);
        within.fold(0.0, |most, (_, a)| a.abs().max(most))
    }
}

/// The events of a line spall: times from the leading edge (s), and a force (N).
#[derive(Debug, Clone, Copy)]
pub struct FourEvents {
    /// The outer raceway carries nothing.
    pub free: f64,
    /// The free element strikes the floor.
    pub floor: f64,
    /// The inner ring carries again.
    pub reload: f64,
    /// The last lift-off before the exit.
    pub settled: f64,
    /// The centre is over the trailing edge.
    pub exit: f64,
    /// Greatest outer force about the exit (N).
    pub peak: f64,
    /// When that is (s).
    pub peak_at: f64,
}

impl FourEvents {
    /// Of a passage whose trailing edge is passed at `exit` (s).
    pub fn of(Passage { time, signals: run }: &Passage, exit: f64) -> Self {
        let (inner, outer) = (&run[3], &run[4]);
        let first = |from: f64, is: &dyn Fn(usize) -> bool| {
            (0..time.len()).find(|&k| time[k] >= from && is(k)).map_or(f64::NAN, |k| time[k])
        };
        let free = first(0.0, &|k| outer[k] == 0.0);
        let floor = first(free, &|k| outer[k] > 0.0);
        // Just after the release the inner contact holds on for some microseconds.
        let reload = first(free + 1e-3, &|k| inner[k] > 0.0);
        let before = |to: f64, is: &dyn Fn(usize) -> bool| {
            (0..time.len()).rev().find(|&k| time[k] <= to && is(k)).map_or(f64::NAN, |k| time[k])
        };
        let settled = before(exit, &|k| outer[k] == 0.0 || inner[k] == 0.0);
        let near = |k: &usize| (time[*k] - exit).abs() < 1.5e-3;
        let highest = (0..time.len()).filter(near).max_by(|&a, &b| outer[a].total_cmp(&outer[b]));
        let (peak, peak_at) = highest.map_or((f64::NAN, f64::NAN), |k| (outer[k], time[k]));
        Self { free, floor, reload, settled, exit, peak, peak_at }
    }
}

/// What an element does over Epps' spall.
#[derive(Debug, Clone)]
pub struct Epps {
    /// The signals.
    pub passage: Passage,
    /// How far the path of a rigid element drops (m).
    pub drop: f64,
    /// Deepest path (m).
    pub deepest: f64,
    /// From edge to edge (s).
    pub traverse: f64,
    /// Outer force before the spall, least over it, greatest as it is taken up again (N).
    pub force: [f64; 3],
    /// What the sensor rings at after it (Hz), where that is seen.
    pub rings: Option<f64>,
}

impl Epps {
    /// Of a case whose defect is as long as Epps' spall.
    ///
    /// # Errors
    /// Of the simulation.
    pub fn of(project: &Project, case: &Case) -> Result<Self> {
        let length = Self::degrees(case);
        let passage = Passage::of(project, case, length, [1e-3, 4e-3])?;
        let (traverse, force) = (length / case.travel(), &passage.signals[4]);
        let at = |from: f64, to: f64| {
            let within = |(t, _): &(&f64, &f64)| **t >= from && **t <= to;
            let within = passage.time.iter().zip(force).filter(within).map(|(_, &force)| force);
            within.fold((f64::MAX, 0.0f64), |(low, high), force| (low.min(force), high.max(force)))
        };
        // The peak as it takes up its load again; one of the ringing that follows may be higher.
        let force = [at(-0.5e-3, -0.45e-3).1, at(0.0, 1.2 * traverse).0, at(0.5 * traverse, 1.5 * traverse).1];
        let deepest = passage.signals[2].iter().copied().fold(0.0, f64::max);
        let rings = rings_after(project, case, length)?;
        Ok(Self { drop: rigid_drop(case)?, deepest, traverse, force, rings, passage })
    }

    /// When the outer force is least, and when half of what it was before the spall is there again (s).
    pub fn unloaded_and_loaded(&self) -> (f64, f64) {
        let (time, force) = (&self.passage.time, &self.passage.signals[4]);
        let over = (0..time.len()).filter(|&k| time[k] >= 0.0 && time[k] <= 1.2 * self.traverse);
        let least = over.min_by(|&a, &b| force[a].total_cmp(&force[b])).unwrap_or(0);
        let half = (least..time.len()).find(|&k| force[k] > 0.5 * self.force[0]);
        (time[least], half.map_or(f64::NAN, |k| time[k]))
    }

    /// Its length on the raceway of this case (degrees).
    pub fn degrees(case: &Case) -> f64 {
        (EPPS_LENGTH / case.scene.bearing.outer_raceway_radius()).to_degrees()
    }
}

/// Frequency of the averaged signal below 2.5 kHz after the exit (Hz).
fn rings_after(project: &Project, case: &Case, length: f64) -> Result<Option<f64>> {
    let rate = 51_200.0;
    let run = case.record(project, &NAMES[..1], rate, 0.4)?;
    let passage = case.average(&run[0], rate, length, 0.0, 4);
    let smooth = synthesis::below_cut(&passage, case.bpfo());
    let from = (1.3 * length / case.travel() * rate) as usize;
    Ok(ringing::strongest(&smooth[from..], rate))
}

/// The profile of a case's defect, and the path of a rigid element over it.
///
/// # Errors
/// Of a scene whose surface is no profile.
pub(crate) fn path_of(case: &Case) -> Result<(Profile, RigidPath)> {
    let bearing = &case.scene.bearing;
    let defect = case.scene.defects.first().context("no defect")?;
    let Surface::Profile(profile) = Surface::load(defect, case.profile(), bearing)? else {
        anyhow::bail!("a topography has no one path")
    };
    let path = RigidPath::new(profile.points(), Rolling::of(bearing, RacewaySide::Outer, false))?;
    Ok((profile, path))
}

/// Depth of the path of a rigid element (m) at angle (rad).
fn rigid(path: &RigidPath, angle: f64) -> f64 {
    let after = path.knots().partition_point(|&knot| knot <= angle);
    if after == 0 || after == path.knots().len() { 0.0 } else { path.at(after - 1, angle).path }
}

fn rigid_drop(case: &Case) -> Result<f64> {
    let (_, path) = path_of(case)?;
    let radius = case.scene.bearing.outer_raceway_radius();
    Ok((-500..=500).map(|k| rigid(&path, f64::from(k) * 1e-6 / radius)).fold(0.0, f64::max))
}

/// Columns of a profile and the path of a rigid element over it, every micrometre of these: arc, depth and path (m).
///
/// # Errors
/// Of a scene whose surface is no profile.
pub fn profile(case: &Case, micrometres: RangeInclusive<i32>) -> Result<(Names, [Vec<f64>; 3])> {
    let (profile, path) = path_of(case)?;
    let radius = case.scene.bearing.outer_raceway_radius();
    let arc: Vec<f64> = micrometres.map(|k| f64::from(k) * 1e-6).collect();
    let depth = arc.iter().map(|&arc| profile.depth_at(arc)).collect();
    let centre = arc.iter().map(|&arc| rigid(&path, arc / radius)).collect();
    let names = ["arc", "depth", "path"].map(|name| (name.to_owned(), "m"));
    Ok((names.to_vec(), [arc, depth, centre]))
}

/// Columns of several passages: the time of the first, and the signals of each under its name.
pub fn table<'p>(passages: impl IntoIterator<Item = (&'p str, &'p Passage)>) -> (Names, Vec<&'p [f64]>) {
    let (mut names, mut columns) = (vec![("time".to_owned(), "s")], Vec::new());
    for (name, Passage { time, signals }) in passages {
        if columns.is_empty() {
            columns.push(time.as_slice());
        }
        columns.extend(signals.iter().map(Vec::as_slice));
        let units = ["m/s2", "m/s2", "m", "N", "N"];
        names.extend(NAMES.iter().zip(units).map(|(signal, unit)| (format!("{name} {signal}"), unit)));
    }
    (names, columns)
}
