//! The command `sweep`: thousands of runs of one scene over grids and random values, on all cores, into one table.
//!
//! Each run is a scene of its own, a function of the file and the run's number alone, and is stepped as `run` steps any
//! scene. So rows have the same bits on any number of threads, in any order, and after a sweep was interrupted.

mod check;
mod design;
mod faults;
mod file;
mod folder;
mod maps;
mod rows;
mod runner;
mod scenes;
mod workers;

use std::collections::{BTreeSet, HashMap};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use anyhow::{Context, Result, bail};
use brinell::scene::Experiment;
use clap::Args;
use indicatif::{ProgressBar, ProgressDrawTarget};

use crate::interrupt::{Held, Interrupted};
use crate::run::noise_spectrum::NoiseSpectrum;
use crate::run::speed_profile::SpeedProfile;
use crate::shared::{Grid, Project, note, seed, talk, whole, whole_file};
pub(crate) use design::Part;
use faults::{Fault, Faults};
use file::Sweep;
pub(crate) use folder::SignalFormat;
use folder::{Card, Folder, Record};
use maps::Maps;
use rows::{Journal, Row};
use runner::SweepRunner;
use scenes::Base;

/// The table of a sweep.
const TABLE: &str = "runs.parquet";

/// Options of `sweep`.
#[derive(Debug, Args)]
pub struct Options {
    /// File of the sweep (TOML): which scene is run, and what changes from run to run
    file: PathBuf,
    /// Folder for the table; a sweep that was interrupted goes on in it [default: named after the file]
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Runs at once [default: as many as there are cores]
    #[arg(long, value_name = "COUNT", allow_negative_numbers = true, value_parser = whole::<1, 4096>)]
    jobs: Option<u32>,
    /// Write the signals of the runs as well [default format: npy]
    #[arg(long, value_enum, value_name = "FORMAT", num_args = 0..=1, default_missing_value = "npy")]
    signals: Option<SignalFormat>,
    /// Make part K of N only, on any machine; the same command without it joins all parts in the folder
    #[arg(long, value_name = "K/N")]
    part: Option<Part>,
    /// Print the scene of one run, which `brinell run` takes, and run nothing
    #[arg(long, value_name = "RUN", allow_negative_numbers = true, value_parser = seed)]
    scene_of: Option<u64>,
}

impl Options {
    fn folder(&self, project: &Project) -> PathBuf {
        let of_file = || project.results("sweep").join(self.file.file_stem().unwrap_or_else(|| "sweep".as_ref()));
        self.output.clone().unwrap_or_else(of_file)
    }

    fn jobs(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        self.jobs.map_or_else(cores, |jobs| jobs as usize)
    }
}

/// A sweep that was read and can be run.
struct Planned {
    sweep: Sweep,
    base: Base,
    text: String,
    /// Keys that take whole numbers only.
    whole: BTreeSet<String>,
    speeds: Vec<SpeedProfile>,
    spectrum: Option<NoiseSpectrum>,
    grid: Grid,
}

/// The command: `<folder>/runs.parquet` and, if wanted, a file with the signals of each run in `<folder>/signals`. A
/// part goes into a folder of its own in it; without one, rows and signals of the parts there are taken over.
pub(crate) fn command(project: &Project, options: &Options) -> Result<()> {
    match options.scene_of {
        Some(run) => print_scene(&options.file, run),
        None => run_all(project, options),
    }
}

fn run_all(project: &Project, options: &Options) -> Result<()> {
    let (file, jobs) = (&options.file, options.jobs());
    let planned = Planned::read(file)?;
    let Planned { sweep, base, .. } = &planned;
    let columns = rows::columns::columns(sweep, &|key| planned.is_whole(key));
    let record = Record::of(sweep, base, file, &planned.text, options.signals, &columns)?;
    let folder = Folder::open(&options.folder(project), options.part, options.signals, &record)?;
    let (mut journal, mut rows) = Journal::open(&folder.path, &folder.running, &columns)?;
    if let Some(beyond) = rows.iter().filter_map(Row::run).find(|run| *run >= sweep.runs) {
        bail!("{} holds run {beyond}: runs must be at least {}", folder.path.display(), beyond + 1);
    }
    let runner = SweepRunner {
        sweep,
        base,
        columns: &columns,
        speeds: &planned.speeds,
        spectrum: planned.spectrum.as_ref(),
        grid: planned.grid,
        folder: &folder,
        texts: Mutex::default(),
    };
    let table =
        Table { path: folder.path.join(TABLE), columns: &columns, origin: planned.origin(), running: &folder.running };
    if !rows.is_empty() {
        table.write(&mut rows)?;
    }
    let wanted: Vec<u64> =
        (0..sweep.runs).filter(|&run| options.part.is_none_or(|part| part.place(run).is_some())).collect();
    let missing = Missing::of(&rows, &wanted, &folder);
    let (maps, fingerprints) = prepare(project, &planned, &runner, &missing.runs, jobs)?;
    let _held = Held::new();
    let bar = bar(wanted.len() as u64, (wanted.len() - missing.runs.len()) as u64);
    // The table is written now and then, whenever there is a quarter more of it.
    let mut next = rows.len() + rows.len() / 4 + 100;
    let mut counts = Counts { made: 0, again: 0, failed: 0 };
    let job = |k: usize| runner.row(&planned.run(missing.runs[k]), &maps, &fingerprints[k]);
    workers::each(jobs, missing.runs.len(), job, |k, row| {
        let row = match row {
            // Of a run under way when the user ended the sweep nothing is kept.
            Err(error) if error.is::<Interrupted>() => return Ok(()),
            row => row?,
        };
        let again = missing.again.contains(&missing.runs[k]);
        counts.add(&row, again);
        if !again {
            journal.add(&row)?;
            rows.push(row);
        }
        bar.set_message(if counts.failed > 0 { format!(", {} failed", counts.failed) } else { String::new() });
        bar.inc(1);
        if rows.len() >= next {
            next = rows.len() + rows.len() / 4 + 100;
            table.write(&mut rows)?;
        }
        Ok(())
    })?;
    bar.finish_and_clear();
    table.write(&mut rows)?;
    let card = Card { sweep, file, text: &planned.text, signals: options.signals, columns: &columns };
    card.write(&folder.path, &rows)?;
    let failed = rows.iter().filter(|row| error_of(row).is_some()).filter_map(Row::run).collect();
    folder.put_together(&wanted, &failed)?;
    let _ = fs::remove_dir_all(&folder.running);
    println!("{}", table.path.display());
    if let Some(signals) = folder.signals().filter(|signals| signals.exists()) {
        println!("{}", signals.display());
    }
    tell(&rows, &counts, missing.runs.len())
}

/// The table of a sweep.
struct Table<'a> {
    path: PathBuf,
    columns: &'a [rows::Column],
    origin: [(&'a str, &'a str); 3],
    running: &'a Path,
}

impl Table<'_> {
    /// Writes it beside the runs under way, and moves it from there when it is whole.
    fn write(&self, rows: &mut [Row]) -> Result<()> {
        rows.sort_by_key(Row::run);
        let whole = self.running.join(TABLE);
        rows::write_table(&whole, self.columns, &self.origin, rows)?;
        whole_file::take_out(&whole, self.path.parent().unwrap_or(Path::new(""))).map(drop)
    }
}

/// Runs that are to be made.
struct Missing {
    runs: Vec<u64>,
    /// Those of them that have a row and whose signals somebody has taken away.
    again: BTreeSet<u64>,
}

impl Missing {
    fn of(rows: &[Row], wanted: &[u64], folder: &Folder) -> Self {
        let done: BTreeSet<u64> = rows.iter().filter_map(Row::run).collect();
        let sound = rows.iter().filter(|row| error_of(row).is_none()).filter_map(Row::run);
        let again: BTreeSet<u64> = sound.filter(|run| folder.lacks_signals(*run)).collect();
        let missing = |run: &&u64| !done.contains(run) || again.contains(run);
        let runs = wanted.iter().filter(missing).copied().collect();
        Self { runs, again }
    }
}

/// Runs that were made now.
struct Counts {
    made: usize,
    /// For their signals alone.
    again: usize,
    failed: usize,
}

impl Counts {
    fn add(&mut self, row: &Row, again: bool) {
        self.made += usize::from(!again);
        self.again += usize::from(again);
        self.failed += usize::from(error_of(row).is_some());
    }
}

/// Prints the scene of a run as a file that `brinell run` takes.
fn print_scene(file: &Path, run: u64) -> Result<()> {
    let planned = Planned::read(file)?;
    if run >= planned.sweep.runs {
        bail!("run {run}: the sweep has runs 0 to {}", planned.sweep.runs - 1);
    }
    let (_, table) = planned.base.scene(&planned.sweep, &planned.run(run))?;
    print!("{}", toml::to_string(&table)?);
    Ok(())
}

impl Planned {
    /// Reads a sweep and all that it names.
    ///
    /// # Errors
    /// All that is wrong with the file, also with its values in the scene.
    fn read(file: &Path) -> Result<Self> {
        let about = || file.display().to_string();
        let text = fs::read_to_string(file).with_context(about)?;
        let (sweep, mut faults) = Sweep::read(&text).with_context(about)?;
        let base = if sweep.scene.is_empty() { None } else { Some(Base::read(&sweep.scene, file)) };
        let mut whole = BTreeSet::new();
        let base = match base {
            None => None,
            Some(Err(error)) => {
                let line = 1 + text.lines().take_while(|line| !line.trim_start().starts_with("scene")).count();
                faults.push(Fault { line, message: format!("scene: {error:#}") });
                None
            }
            Some(Ok(base)) => {
                let keys = sweep.lines().map(|(key, _)| key);
                whole.extend(keys.filter(|key| check::takes_whole_numbers(&base, &sweep, key)).map(str::to_owned));
                let (wrong, questions) = check::faults(&base, &sweep, &|key| whole.contains(key));
                faults.extend(wrong);
                questions.tell(file);
                Some(base)
            }
        };
        faults.sort_by_key(|fault| fault.line);
        let Some(base) = base.filter(|_| faults.is_empty()) else {
            return Err(Faults(faults)).with_context(about);
        };
        let grid = Grid::even(&Experiment { stop: sweep.stop, step: 1.0 / sweep.rate }).with_context(about)?;
        let beside = |name: &String| file.parent().unwrap_or(Path::new("")).join(name);
        let speed = |name: &String| {
            let path = beside(name);
            let profile = SpeedProfile::read(&path, &base.scene.bearing)?;
            profile.check_covers(grid.end()).with_context(|| path.display().to_string())?;
            anyhow::Ok(profile)
        };
        let speeds = sweep.speed_profiles.iter().map(speed).collect::<Result<_>>()?;
        let spectrum = sweep.noise_spectrum.as_ref();
        let spectrum = spectrum.map(|name| NoiseSpectrum::read(&beside(name), sweep.rate)).transpose()?;
        Ok(Self { sweep, base, text, whole, speeds, spectrum, grid })
    }

    /// What the table says of where it comes from: nothing that depends on the time or the machine.
    fn origin(&self) -> [(&str, &str); 3] {
        [
            ("brinell.version", env!("CARGO_PKG_VERSION")),
            ("brinell.sweep", &self.text),
            ("brinell.scene", &self.base.text),
        ]
    }

    fn is_whole(&self, key: &str) -> bool {
        self.whole.contains(key)
    }

    fn run(&self, index: u64) -> design::Run {
        self.sweep.run(index, &|key| self.is_whole(key))
    }
}

/// Computes the contact maps that the runs need, and says which run needs which. A scene that cannot be needs none: its
/// run will say so.
fn prepare<'p>(
    project: &'p Project,
    planned: &Planned,
    runner: &SweepRunner<'_>,
    missing: &[u64],
    jobs: usize,
) -> Result<(Maps<'p>, Vec<Vec<u64>>)> {
    let mut fingerprints = vec![Vec::new(); missing.len()];
    let needed = |k: usize| {
        let ready = runner.ready(&planned.run(missing[k])).ok()?;
        maps::needed(&ready.scene, &ready.texts).ok()
    };
    workers::each(jobs, missing.len(), needed, |k, fingerprint| {
        fingerprints[k] = fingerprint.unwrap_or_default();
        Ok(())
    })?;
    let mut uses: HashMap<u64, usize> = HashMap::new();
    let mut first = Vec::new();
    for (k, all) in fingerprints.iter().enumerate() {
        if all.iter().any(|one| !uses.contains_key(one)) {
            first.push(k);
        }
        all.iter().for_each(|&one| *uses.entry(one).or_default() += 1);
    }
    let mut maps = Maps::new(project, uses);
    for k in first {
        let ready = runner.ready(&planned.run(missing[k]))?;
        maps.prepare(&ready.scene, &ready.texts, jobs)?;
    }
    Ok((maps, fingerprints))
}

fn bar(runs: u64, done: u64) -> ProgressBar {
    let bar = talk::bar(runs, "sweep [{bar:30}] {pos}/{len} runs{msg}, {per_sec}, {eta} left").with_position(done);
    // A new start forgets times, not steps: those made earlier would count as made at once with the first of now. Nor
    // is their rate shown.
    bar.set_draw_target(ProgressDrawTarget::hidden());
    bar.tick();
    bar.reset_eta();
    if talk::is_shown() {
        bar.set_draw_target(ProgressDrawTarget::stderr());
    }
    bar
}

fn error_of(row: &Row) -> Option<&str> {
    match row.0.last() {
        Some(rows::Cell::Text(error)) => Some(error),
        _ => None,
    }
}

/// Says what a reader of the table must know.
///
/// # Errors
/// That the user has interrupted, where some of the `wanted` runs are missing for it.
fn tell(rows: &[Row], counts: &Counts, wanted: usize) -> Result<()> {
    let mut errors = rows.iter().filter_map(|row| Some((row.run()?, error_of(row)?)));
    let first = errors.next();
    let failed = usize::from(first.is_some()) + errors.count();
    // A remark only where there is something to remark.
    let kind = if failed > 0 { "note: " } else { "" };
    note!("{kind}{} runs, {} of them made now, {failed} failed", rows.len(), counts.made);
    if counts.again > 0 {
        note!("note: the signals of {} runs were gone and were made again", counts.again);
    }
    if let Some((run, error)) = first {
        note!("note: run {run}: {error}");
    }
    match wanted - counts.made - counts.again {
        0 => Ok(()),
        left => {
            note!("note: interrupted: what is in the table is kept; the same command makes the other {left} runs");
            Err(Interrupted.into())
        }
    }
}

#[cfg(test)]
mod tests {
    use std::thread::sleep;
    use std::time::Duration;

    #[test]
    fn the_rate_of_a_sweep_that_goes_on_is_that_of_the_runs_made_now() {
        let bar = super::bar(400, 75);
        sleep(Duration::from_millis(100));
        bar.inc(1);
        bar.tick();
        let rate = bar.per_sec();
        // One run in a tenth of a second or longer.
        assert!(rate > 0.0 && rate < 10.5, "{rate}/s");
    }
}
