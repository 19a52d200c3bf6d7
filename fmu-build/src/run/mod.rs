//! A run without a host: the simulation is stepped directly, its inputs at their start values except for the shaft's
//! speed, where that has a profile.

pub mod columns;
pub mod noise;
pub(crate) mod noise_spectrum;
mod page;
pub(crate) mod run_loop;
pub mod signals;
mod spectra;
pub mod speed_profile;
pub mod table;
pub mod wav;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use anyhow::{Context, Result, bail};
use brinell::scene::{Recorder, RecorderFilter, Scene};
use brinell::simulation::Simulation;

use crate::interrupt::Interrupted;
use crate::package::model::operating_angle;
use crate::package::{Model, Profile};
use crate::shared::{Grid, Project, Python, detail, digits, note, whole_file};
use columns::Columns;
use noise::Noise;
use run_loop::{Done, RunLoop};
use signals::Signals;
use spectra::{Acceleration, Spectra};
use speed_profile::SpeedProfile;
use table::{Column, Format};
use wav::Wav;

/// Rate of a recorder that a sound or a page needs and the scene does not have (Hz).
const USUAL_RATE: f64 = 51_200.0;

/// How files of a run may end beside its table.
const WRITTEN: [&str; 10] =
    [".csv", ".npy", ".parquet", ".svg", ".png", ".html", ".wav", "-envelope.csv", "-envelope.json", "-orders.csv"];

/// Numbers up to which a table has all columns unless some are named: 17 MB as CSV.
const WHOLE: u64 = 1_000_000;

/// What the user says.
#[derive(Debug, Clone)]
pub struct Options {
    /// Communication points.
    pub grid: Grid,
    /// Patterns of the table's columns; all where there are none.
    pub columns: Vec<String>,
    /// What the table is written as.
    pub format: Format,
    /// The shaft's speed over time.
    pub profile: Option<SpeedProfile>,
    /// Noise of the sensors.
    pub noise: Option<Noise>,
    /// What the sensors show as sound.
    pub wav: Option<Wav>,
    /// Whether to draw.
    pub figure: bool,
    /// Whether to write an HTML page.
    pub page: bool,
    /// Whether to open it in the browser.
    pub open: bool,
}

/// The command: `<folder>/<scene>.csv` or what else the table is to be, `.npy` where the scene has a recorder, and, if
/// wanted, `.wav`, `.html`, `.svg` and `.png` with the spectra that they show. Each file is named when it is there.
pub fn command(project: &Project, model: Model, options: &Options, folder: &Path) -> Result<()> {
    let records = model.scene.recorder.is_some();
    let mut model = with_recorder(model, options)?;
    // It goes on in a folder of its own, so that what is in it is whole before it takes the place of an earlier run's.
    let growing = whole_file::folder_in(folder)?;
    let path = options.format.path(folder, &model.scene.name);
    spare_profiles(&model, &path)?;
    let chosen = chosen(&model.simulation, options)?;
    let columns = if options.figure || options.page {
        Columns::all(model.simulation.table())
    } else {
        chosen.clone().with(model.simulation.table(), &accelerometer(&model.scene))
    };
    let run_loop = RunLoop { grid: options.grid, profile: options.profile.as_ref(), shows: true };
    let (begin, earlier) = (Instant::now(), whole_file::earlier(&folder.join(&model.scene.name), &WRITTEN));
    let done = run_loop.simulate(&model.scene, &mut model.simulation, columns, growing.path(), &path)?;
    let sensors = |signals: &Signals| signals.indices(|name| shows_a_sensor(&model.scene, name));
    if let Some(noise) = &options.noise {
        noise.add(&done.signals, &sensors(&done.signals), 0)?;
        if let Some(recording) = &done.recording {
            noise.add(recording, &sensors(recording), 1)?;
        }
    }
    let columns: Vec<Column> = std::iter::once("time")
        .chain(chosen.names().map(|(name, _)| name))
        .filter_map(|name| done.units.iter().position(|(known, _)| known == name))
        .map(|index| Column { index, unit: done.units[index].1 })
        .collect();
    detail!("{}: {} in {:.2} s", model.scene.name, counts(&mut model.simulation)?, begin.elapsed().as_secs_f64());
    options.format.write(&done.signals, &columns, &table::origin(&model.scene_text), &path)?;
    println!("{}", path.display());
    if let Some(at) = done.interrupted_at {
        note!(
            "interrupted: {} holds what was simulated, up to {} s; nothing else was written",
            path.display(),
            digits(at)
        );
        return Err(Interrupted.into());
    }
    if let (Some(wav), Some(recording), Some(recorder)) = (&options.wav, &done.recording, model.scene.recorder) {
        let path = folder.join(format!("{}.wav", model.scene.name));
        let [largest, clipped] = wav.write(recording, &sensors(recording), recorder.rate, &path)?;
        println!("{}", path.display());
        note!("note: {} Hz, 1 is {} m/s2, the largest sample {largest:.3}", recorder.rate, wav.scale);
        if clipped > 0.0 {
            let (share, enough) = (digits(100.0 * clipped), digits(wav.scale * largest));
            note!(
                "warning: {}: {share} % of the samples are beyond 1, where players clip: --wav-scale above {enough} \
                 keeps them below",
                path.display()
            );
        }
    }
    let drawn = draw(project, &model, options, &done, folder);
    if let Some(recording) = done.recording.filter(|_| records) {
        keep(&recording, &options.columns, folder)?;
    }
    drawn?;
    whole_file::tell_earlier(&earlier);
    Ok(())
}

/// What shakes in the figure and in spectra: the first sensor, or the housing.
fn accelerometer(scene: &Scene) -> String {
    if scene.sensors.is_empty() { "housing.ay".to_owned() } else { scene.sensor_variable(0) }
}

/// Refuses to put the table in the place of a profile that the scene is made of.
fn spare_profiles(model: &Model, table: &Path) -> Result<()> {
    let is_it = |profile: &Profile| {
        Path::new(&profile.name).file_name() == table.file_name()
            && fs::read(table).is_ok_and(|bytes| bytes == profile.text.as_bytes())
    };
    match model.profiles.iter().find(|profile| is_it(profile)) {
        None => Ok(()),
        Some(Profile { name, .. }) => bail!(
            "{} is the profile of a defect, {name}, and the table would take its place: choose another folder with -o",
            table.display()
        ),
    }
}

/// The table's columns: those that are asked for, else all, of a long run what is measured and how the rings move.
fn chosen(simulation: &Simulation, options: &Options) -> Result<Columns> {
    let table = simulation.table();
    if !options.columns.is_empty() {
        return Columns::matching(table, &options.columns);
    }
    let (all, points) = (Columns::all(table), options.grid.count + 1);
    if points.saturating_mul(all.names().count() as u64) <= WHOLE {
        return Ok(all);
    }
    let usual = Columns::usual(table);
    let (many, few) = (all.names().count(), usual.names().count());
    note!("note: {points} points: the table has {few} of {many} columns; --columns '*' gives all");
    Ok(usual)
}

/// Keeps what the recorder has sampled, the whole file or the columns that are asked for.
fn keep(recording: &Signals, patterns: &[String], folder: &Path) -> Result<()> {
    let asked = |name: &str| patterns.iter().any(|pattern| columns::matches(pattern, name));
    let chosen = recording.indices(|name| name == "time" || patterns.is_empty() || asked(name));
    if chosen.len() == recording.names().len() {
        println!("{}", whole_file::take_out(recording.path(), folder)?.display());
        return Ok(());
    }
    let name = recording.path().file_name().unwrap_or_default();
    if chosen.len() == 1 {
        note!("note: no {}: the recorder samples nothing that --columns names", name.display());
        return Ok(());
    }
    let chosen: Vec<Column> = chosen.into_iter().map(|index| Column { index, unit: "" }).collect();
    let path = folder.join(name);
    Format::Npy.write(recording, &chosen, &[], &path)?;
    println!("{}", path.display());
    Ok(())
}

/// Whether a signal is what an accelerometer shows.
fn shows_a_sensor(scene: &Scene, name: &str) -> bool {
    (0..scene.sensors.len()).any(|number| scene.sensor_variable(number) == name)
}

/// The model with the recorder that a sound or a page needs.
fn with_recorder(model: Model, options: &Options) -> Result<Model> {
    let named = options.wav.and_then(|wav| wav.rate);
    if options.wav.is_some() || options.noise.is_some() {
        if model.scene.sensors.is_empty() {
            bail!("the scene has no [sensor]: --wav and --noise-db are about what sensors show");
        }
        if named.is_none()
            && options.wav.is_some()
            && model.scene.recorder.is_some_and(|recorder| recorder.filter == RecorderFilter::None)
        {
            bail!("recorder.filter is \"none\": sound needs \"linear-phase\", or a rate of its own by --wav-rate");
        }
    }
    let rate = match (named, model.scene.recorder) {
        (Some(rate), _) => rate,
        // Of a run-up each resonance is passed: samples at communication points would beat with it in its spectra.
        (None, None) if options.wav.is_some() || options.page || options.profile.is_some() => USUAL_RATE,
        _ => return Ok(model),
    };
    let mut scene = model.scene;
    scene.recorder = Some(Recorder { rate, filter: RecorderFilter::LinearPhase });
    scene.check().context("--wav-rate")?;
    let texts = model.profiles.iter().map(|profile| profile.text.as_str());
    let simulation = Simulation::with_map(scene.clone(), texts, model.map.as_deref())?;
    Ok(Model { scene, simulation, ..model })
}

/// Spectra, and figure and page where they are wanted.
fn draw(project: &Project, model: &Model, options: &Options, done: &Done, folder: &Path) -> Result<()> {
    // With the operating angle under which it ran.
    let scene = model.simulation.scene();
    let filtered = |_: &&Signals| scene.recorder.is_some_and(|recorder| recorder.filter == RecorderFilter::LinearPhase);
    let (source, rate) = match done.recording.as_ref().filter(filtered).zip(scene.recorder) {
        Some((recording, recorder)) => (recording, recorder.rate),
        None => (&done.signals, 1.0 / options.grid.step),
    };
    let indices = source.indices(|name| name == accelerometer(scene));
    let mut samples = indices.first().map_or(Ok(Vec::new()), |&index| source.column(index))?;
    if source.path() == done.signals.path() && options.grid.ends_short() {
        // Spectra are of even times.
        samples.pop();
    }
    let acceleration = Acceleration { samples, rate };
    let spectra = Spectra::new(scene, options.profile.as_ref(), acceleration);
    let envelope = spectra.write_envelope(folder)?;
    let too_short = spectra.too_short().filter(|_| options.figure || options.page);
    if let Some(why) = &too_short {
        note!("note: {why}");
    }
    if options.figure {
        let recorded = done.recording.as_ref().filter(filtered).map_or(Path::new("-"), Signals::path);
        let mut files: Vec<PathBuf> =
            vec![done.signals.path().to_owned(), recorded.to_owned(), folder.join(&scene.name)];
        files.extend(envelope.clone());
        print!("{}", Python::draw(project, "run_figure.py", &files, &[])?);
    }
    if options.page {
        let python = Python::prepare_for_pages(project)?;
        let orders = spectra.write_orders(folder)?;
        let angle = operating_angle(scene);
        let notes: Vec<String> = notes(options).into_iter().chain(angle).chain(too_short).collect();
        let described = page::described(model, done, envelope.as_deref(), orders, options.profile.is_some(), &notes)?;
        let about = done.signals.path().with_extension("json");
        whole_file::write(&about, described.to_string())?;
        let page = folder.join(format!("{}.html", scene.name));
        print!("{}", python.run("run_page.py", [about, page.clone()])?);
        if options.open {
            open(&page);
        }
    }
    Ok(())
}

/// How many steps a simulation has taken.
fn counts(simulation: &mut Simulation) -> Result<String> {
    let references = [simulation.reference("solver.steps")?, simulation.reference("solver.rejected_steps")?];
    let mut counts = [0; 2];
    simulation.integers(&references, &mut counts)?;
    Ok(format!("{} integration steps and {} rejected", counts[0], counts[1]))
}

/// Hands a page to the system's browser; where there is none, the command has printed the page's name.
fn open(page: &Path) {
    let (program, first) = match std::env::consts::OS {
        "windows" => ("cmd", Some(["/C", "start", ""])),
        "macos" => ("open", None),
        _ => ("xdg-open", None),
    };
    let mut command = Command::new(program);
    command.args(first.into_iter().flatten()).arg(page).stdout(Stdio::null()).stderr(Stdio::null());
    if let Err(error) = command.spawn() {
        note!("note: {} was not opened: {program}: {error}", page.display());
    }
}

/// What a reader of the page must know of the run.
fn notes(options: &Options) -> Vec<String> {
    let noise = options.noise.map(|noise| noise.to_string());
    let profile = options.profile.as_ref().map(|profile| {
        format!(
            "the shaft's speed has a profile: {} Hz at the start, {} Hz at the end",
            digits(profile.hertz(0.0)),
            digits(profile.hertz(options.grid.end()))
        )
    });
    noise.into_iter().chain(profile).collect()
}
