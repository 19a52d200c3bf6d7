//! The command `size`: the damaged part and the length of a spall from recordings, as JSON on standard output and a
//! figure for each recording.
//!
//! Standard output carries the JSON and nothing else; what happens meanwhile goes to standard error.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use brinell::scene::{self, Scene};
use brinell::simulation::setup::with_operating_angle;
use brinell_analysis::recording::{Recording, Source, Speed, TextFormat};
use brinell_analysis::sizing::{Figure, Grade, RecordingReport, Report, Standing, size_with};
use brinell_analysis::spectra::{Fault, PLAUSIBLE, find_speed};

use super::{new_scene, size_report};
use crate::package::model::operating_angle;
use crate::package::read_scene;
use crate::shared::{Project, Python, contact_map, csv, digits, note, speed, talk, whole_file};

/// Where the bearing and its load come from.
#[derive(Debug, Clone, PartialEq)]
pub enum Bearing {
    /// A scene, by its file or its name.
    Scene(PathBuf),
    /// The catalogue, and the load (N) where it is known.
    Catalogue(String, Option<f64>),
}

impl Bearing {
    fn scene(&self) -> Result<Scene> {
        match self {
            Bearing::Scene(path) => Ok(read_scene(path)?.1),
            Bearing::Catalogue(name, load) => new_scene::without_rig(name, *load),
        }
    }
}

/// Where the shaft's speed comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum ShaftSpeed {
    /// The user, or a column of the file.
    Stated(Speed),
    /// The signal itself, between two limits (Hz).
    Sought([f64; 2]),
}

/// A speed as it is typed: `25`, `1500rpm`, `20..30`, `auto`.
pub(crate) fn shaft_speed(text: &str) -> Result<ShaftSpeed, String> {
    if text == "auto" {
        return Ok(ShaftSpeed::Sought(PLAUSIBLE));
    }
    let Some((low, high)) = text.split_once("..") else {
        let wanted = |why| format!("{why}, limits as in 20..30, or auto");
        return speed(text).map(|hertz| ShaftSpeed::Stated(Speed::Constant(hertz))).map_err(wanted);
    };
    Ok(ShaftSpeed::Sought([speed(low)?, speed(high)?]))
}

/// What the user says.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// Sampling rate (Hz); `None` where the files state it.
    pub rate: Option<f64>,
    /// Shaft speed of all recordings, or of each.
    pub speeds: Vec<ShaftSpeed>,
    /// Column of the signal, by name or number.
    pub channel: Option<String>,
    /// How texts are written.
    pub text: TextFormat,
    /// Whether to draw.
    pub figure: bool,
    /// File of a page that shows what the answer rests on.
    pub report: Option<PathBuf>,
}

/// The command: prints the report, and writes `<folder>/<recording>-size.csv`, `.json` and, if wanted, figures.
pub fn command(
    project: &Project,
    bearing: &Bearing,
    recordings: &[PathBuf],
    options: &Options,
    folder: &Path,
) -> Result<()> {
    // In space balls pass a spall as often as the contact angle says under which they run.
    let scene = with_operating_angle(&bearing.scene()?).into_owned();
    if let Some(said) = operating_angle(&scene) {
        note!("note: {said}");
    }
    let recordings = read(recordings, options, &scene.bearing)?;
    for (r, speed) in recordings.iter().zip(options.speeds.iter().cycle()) {
        // Times that are read as numbers leave some 1e-13 of the rate over.
        let rate = digits(1e-3 * r.rate());
        let by = if matches!(speed, ShaftSpeed::Sought(_)) { ", by its own lines" } else { "" };
        note!("{}: {:.3} s at {rate} kHz, shaft {:.4} Hz{by}", r.name(), r.duration(), r.speed());
    }
    let maps = |scene: &Scene| contact_map::of(scene, None, project).ok().flatten();
    let bar = talk::bar(recordings.len() as u64, "sizing [{bar:30}] {pos}/{len} recordings, {elapsed}");
    bar.enable_steady_tick(std::time::Duration::from_millis(500));
    let report = size_with(&recordings, &scene, &maps, &mut |done| {
        bar.inc(1);
        // Of one recording the answer says it all.
        if recordings.len() > 1 {
            bar.suspend(|| note!("{}: {}", done.name, of_recording(done)));
        }
    });
    bar.finish_and_clear();
    let report = report?;
    eprintln!("{}", answer(&report));
    println!("{}", serde_json::to_string_pretty(&report)?);
    std::io::stdout().flush()?;
    let stems = write(&report, folder)?;
    if let Some(path) = &options.report {
        whole_file::write(path, size_report::page(&report, &recordings, &scene, &found(&report))?)?;
        eprintln!("{}", path.display());
    }
    if options.figure {
        Python::draw(project, "size.py", &stems);
    }
    Ok(())
}

fn read(paths: &[PathBuf], options: &Options, bearing: &scene::Bearing) -> Result<Vec<Recording>> {
    let count = options.speeds.len();
    if count != 1 && count != paths.len() {
        bail!("{count} speeds for {} recordings: give one for all, or one for each", paths.len());
    }
    let speeds = options.speeds.iter().cycle();
    let recordings = paths.iter().zip(speeds).map(|(path, speed)| {
        // Until it is found a speed that can be stands in for it: limits are judged where it is sought.
        let stated = match speed {
            ShaftSpeed::Stated(speed) => speed.clone(),
            ShaftSpeed::Sought(_) => Speed::Constant(PLAUSIBLE[0]),
        };
        let source = Source { rate: options.rate, speed: stated, signal: options.channel.clone(), text: options.text };
        let recording = Recording::read(path, &source)?;
        let ShaftSpeed::Sought(limits) = speed else { return Ok(recording) };
        let found = find_speed(recording.name(), recording.samples(), recording.rate(), bearing, *limits)?;
        Ok(recording.at_speed(found)?)
    });
    recordings.collect()
}

/// The answer in a line: which part, how long, how far to rely on it, why.
fn answer(report: &Report) -> String {
    format!("{}: {}", found(report), report.reason)
}

/// Which part, how long, how far to rely on it.
fn found(report: &Report) -> String {
    let part = part(report.fault);
    match (report.length_mm, report.uncertainty_mm, report.length_deg, report.standing) {
        (Some(length), Some(uncertainty), Some(degrees), Some(standing)) => {
            let standing = if standing == Standing::Firm { "firm" } else { "provisional" };
            format!("{part}: {length:.2} ± {uncertainty:.2} mm ({degrees:.2} degrees), {standing}")
        }
        _ => {
            let least =
                report.at_least_deg.map_or("no length".to_owned(), |least| format!("at least {least:.2} degrees"));
            format!("{part}, {least}")
        }
    }
}

/// What one of several recordings gave.
fn of_recording(done: &RecordingReport) -> String {
    let part = match done.grade {
        Grade::None => part(done.fault).to_owned(),
        grade => format!("{}, {}", part(done.fault), grade.name()),
    };
    match (done.length_deg, done.uncertainty_deg, done.at_least_deg) {
        (Some(length), Some(uncertainty), _) => format!("{part}: {length:.2} ± {uncertainty:.2} degrees"),
        (.., least) => {
            let least = least.map_or("no length".to_owned(), |least| format!("at least {least:.2} degrees"));
            format!("{part}, {least}: {}", done.reason.as_deref().unwrap_or("no reason given"))
        }
    }
}

fn part(fault: Fault) -> &'static str {
    match fault {
        Fault::Outer => "outer raceway",
        Fault::Inner => "inner raceway",
        Fault::Element => "rolling element",
        Fault::Undecided => "undecided which part",
        Fault::None => "no fault found",
    }
}

/// Averaged passages as CSV and what they show as JSON, each named when it is there; gives the files' stems.
fn write(report: &Report, folder: &Path) -> Result<Vec<PathBuf>> {
    let mut stems: Vec<PathBuf> = Vec::new();
    for (figure, recording) in report.figures.iter().zip(&report.recordings) {
        let name = Path::new(&figure.name).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        // Never the recording's own name: the folder may be its own.
        let mut stem = folder.join(format!("{name}-size"));
        // Recordings of one name from several folders.
        for count in 2.. {
            if !stems.contains(&stem) {
                break;
            }
            stem = folder.join(format!("{name}-size-{count}"));
        }
        let passage = with_ending(&stem, ".csv");
        whole_file::write_with(&passage, |mut out| write_passage(&mut out, figure))?;
        eprintln!("{}", passage.display());
        let mut answer = serde_json::to_value(recording)?;
        answer["critical_load_n"] = serde_json::json!(report.critical_load_n);
        answer["critical_load_reason"] = serde_json::json!(report.critical_load_reason);
        answer["kind"] = serde_json::json!(report.kind);
        let about = with_ending(&stem, ".json");
        whole_file::write(&about, serde_json::to_string_pretty(&answer)? + "\n")?;
        eprintln!("{}", about.display());
        stems.push(stem);
    }
    Ok(stems)
}

/// A recording's name may hold dots: the ending is added, not exchanged.
fn with_ending(stem: &Path, ending: &str) -> PathBuf {
    let mut name = stem.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

fn write_passage(out: &mut impl Write, figure: &Figure) -> Result<()> {
    let mut names = vec![("angle", "deg"), ("signal", "1"), ("level", "dB"), ("low", "1")];
    let mut columns = vec![&figure.angle, &figure.signal, &figure.level, &figure.low];
    for (name, unit, column) in [("model", "1", &figure.model), ("path", "m", &figure.path)] {
        if let Some(column) = column {
            names.push((name, unit));
            columns.push(column);
        }
    }
    csv::header(out, names.into_iter())?;
    for i in 0..figure.angle.len() {
        csv::row(out, columns.iter().map(|column| column[i]))?;
    }
    Ok(())
}
