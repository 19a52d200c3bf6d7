//! A run without a host: the simulation is stepped directly, its inputs at their start values but for the shaft's speed,
//! where that has a profile.

pub mod columns;
pub mod grid;
pub mod noise;
mod page;
pub mod signals;
mod spectra;
pub mod speed_profile;
pub mod table;
pub mod wav;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use brinell::recording::Recording;
use brinell::scene::{Recorder, RecorderFilter, Scene};
use brinell::simulation::Simulation;

use crate::digits::digits;
use crate::model::{Model, Profile};
use crate::project::Project;
use crate::python::Python;
use crate::whole_file::{self, NotWritten};
use columns::Columns;
use grid::Grid;
use noise::Noise;
use signals::{Growing, Signals};
use spectra::{Acceleration, Spectra};
use speed_profile::SpeedProfile;
use table::Format;
use wav::Wav;

/// Rate of a recorder that a sound or a page needs and the scene does not have [Hz].
const USUAL_RATE: f64 = 51_200.0;

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
    /// Whether to write a page to look at.
    pub page: bool,
}

/// What a run leaves in its own folder.
struct Done {
    signals: Signals,
    /// Name and unit of its columns, the time's first.
    units: Vec<(String, &'static str)>,
    recording: Option<Signals>,
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
    let chosen = chosen(&model.simulation, &options.columns)?;
    let done = simulate(&mut model, options, growing.path(), &path)?;
    let sensors = |signals: &Signals| signals.places(|name| shows_a_sensor(&model.scene, name));
    if let Some(noise) = &options.noise {
        noise.add(&done.signals, &sensors(&done.signals), 0)?;
        if let Some(recording) = &done.recording {
            noise.add(recording, &sensors(recording), 1)?;
        }
    }
    let columns: Vec<(usize, &str)> = std::iter::once("time")
        .chain(chosen.names().map(|(name, _)| name))
        .filter_map(|name| done.units.iter().position(|(known, _)| known == name))
        .map(|place| (place, done.units[place].1))
        .collect();
    options.format.write(&done.signals, &columns, &path)?;
    println!("{}", path.display());
    if let (Some(wav), Some(recording), Some(recorder)) = (&options.wav, &done.recording, model.scene.recorder) {
        let path = folder.join(format!("{}.wav", model.scene.name));
        let largest = wav.write(recording, &sensors(recording), recorder.rate, &path)?;
        println!("{}", path.display());
        eprintln!("note: {} Hz, 1 is {} m/s2, the largest sample {largest:.3}", recorder.rate, wav.scale);
    }
    if options.figure || options.page {
        draw(project, &model, options, &done, folder)?;
    }
    if let Some(recording) = done.recording.filter(|_| records) {
        println!("{}", whole_file::take_out(recording.path(), folder)?.display());
    }
    Ok(())
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

fn chosen(simulation: &Simulation, patterns: &[String]) -> Result<Columns> {
    if patterns.is_empty() {
        return Ok(Columns::all(simulation.table()));
    }
    Columns::matching(simulation.table(), patterns)
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
        (None, None) if options.wav.is_some() || options.page => USUAL_RATE,
        _ => return Ok(model),
    };
    let mut scene = model.scene;
    scene.recorder = Some(Recorder { rate, filter: RecorderFilter::LinearPhase });
    scene.check().context("--wav-rate")?;
    let texts = model.profiles.iter().map(|profile| profile.text.as_str());
    let simulation = Simulation::with_map(scene.clone(), texts, model.map.as_deref())?;
    Ok(Model { scene, simulation, ..model })
}

/// Runs the simulation; its signals go into `growing`. A disk that is full is told of the table at `about`.
fn simulate(model: &mut Model, options: &Options, growing: &Path, about: &Path) -> Result<Done> {
    let simulation = &mut model.simulation;
    let mut columns = if options.figure || options.page {
        Columns::all(simulation.table())
    } else {
        chosen(simulation, &options.columns)?
    };
    simulation.record_into(&growing.to_string_lossy());
    let shaft_speed = simulation.reference("shaft.speed")?;
    if let Some(profile) = &options.profile {
        simulation.set_reals(&[shaft_speed], &[profile.at(0.0)])?;
    }
    simulation.initialize(0.0).context("initial equilibrium")?;
    let mut recording = Recording::begin(simulation, &model.scene.name)?;
    let units: Vec<(String, &str)> =
        std::iter::once(("time", "s")).chain(columns.names()).map(|(name, unit)| (name.to_owned(), unit)).collect();
    let full = |error| NotWritten::new(about, error);
    let names = units.iter().map(|(name, _)| name.clone()).collect();
    // No recording has that name: those of scenes end in .npy alone.
    let file = growing.join("signals.table");
    let mut rows = Growing::create(&file, names, options.grid.count + 1).map_err(full)?;
    let mut row = vec![0.0; units.len()];
    for index in 0..=options.grid.count {
        if index > 0 {
            step(simulation, shaft_speed, options)?;
            if let Some(recording) = &mut recording {
                recording.keep_up(simulation)?;
            }
        }
        row[0] = simulation.time();
        columns.read(simulation, &mut row[1..])?;
        rows.push(&row).map_err(full)?;
    }
    let signals = rows.end().map_err(full)?;
    let recording = match recording {
        None => None,
        Some(mut recording) => {
            recording.store(simulation)?;
            let recorder = simulation.recorder().into_iter().flat_map(|recorder| recorder.references());
            let names = recorder.map(|reference| simulation.table()[reference as usize].name.clone());
            Some(Signals::of_recording(recording.path(), std::iter::once("time".to_owned()).chain(names).collect())?)
        }
    };
    Ok(Done { signals, units, recording })
}

/// One communication step, with the speed going straight from the profile's value at its start to that at its end.
fn step(simulation: &mut Simulation, shaft_speed: u32, options: &Options) -> Result<()> {
    let (at, step) = (simulation.time(), options.grid.step);
    if let Some(profile) = &options.profile {
        let (from, to) = (profile.at(at), profile.at(at + step));
        simulation.set_reals(&[shaft_speed], &[from])?;
        simulation.set_input_derivatives(&[shaft_speed], &[1], &[(to - from) / step])?;
    }
    // What goes wrong in a step is told with its time.
    Ok(simulation.step(step)?)
}

/// Spectra, figure and page.
fn draw(project: &Project, model: &Model, options: &Options, done: &Done, folder: &Path) -> Result<()> {
    let scene = &model.scene;
    let filtered = |_: &&Signals| scene.recorder.is_some_and(|recorder| recorder.filter == RecorderFilter::LinearPhase);
    let (source, rate) = match done.recording.as_ref().filter(filtered).zip(scene.recorder) {
        Some((recording, recorder)) => (recording, recorder.rate),
        None => (&done.signals, 1.0 / options.grid.step),
    };
    let place = match scene.sensors.is_empty() {
        true => source.places(|name| name == "housing.ay"),
        false => source.places(|name| name == scene.sensor_variable(0)),
    };
    let samples = place.first().map_or(Ok(Vec::new()), |&place| source.column(place))?;
    let acceleration = Acceleration { samples, rate };
    let spectra = Spectra::new(scene, options.profile.as_ref(), acceleration);
    let envelope = spectra.write_envelope(folder)?;
    let too_short = spectra.too_short();
    if let Some(why) = &too_short {
        eprintln!("note: {why}");
    }
    let python = if options.page { Python::prepare_for_pages(project)? } else { Python::prepare(project)? };
    let stem = folder.join(&scene.name);
    if options.figure {
        let mut files: Vec<PathBuf> = vec![done.signals.path().to_owned(), stem.clone()];
        files.extend(envelope.clone());
        print!("{}", python.run("run_figure.py", &files)?);
    }
    if options.page {
        let orders = spectra.write_orders(folder)?;
        let files = page::Files {
            signals: &done.signals,
            recording: done.recording.as_ref(),
            envelope: envelope.as_deref(),
            orders: orders.as_ref(),
        };
        let notes: Vec<String> = notes(options).into_iter().chain(too_short).collect();
        let described = page::described(model, &files, &notes)?;
        let about = done.signals.path().with_extension("json");
        whole_file::write(&about, described.to_string())?;
        print!("{}", python.run("run_page.py", [about, folder.join(format!("{}.html", scene.name))])?);
    }
    Ok(())
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
