//! The command `size`: the damaged part and the length of a spall from recordings, as JSON on standard output and a
//! figure for each recording.
//!
//! Standard output carries the JSON and nothing else; what happens meanwhile goes to standard error.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use brinell::scene::{Bearing, Scene};
use brinell::simulation::setup::with_operating_angle;
use brinell_analysis::recording::{ENDINGS, Recording, Source, Speed, Stated, TextFormat};
use brinell_analysis::sizing::{Figure, RecordingReport, Report, Standing, size_with};
use brinell_analysis::spectra::{Fault, find_speed};
use brinell_scene_file::UnitQuestion;
use clap::Args;

use super::{new_scene, size_report};
use crate::package::model::operating_angle;
use crate::package::read_scene;
use crate::shared::{
    Drawn, Project, contact_map, csv, delimiter, digits, html_file, note, number, rate, speed, talk, whole, whole_file,
};

/// Largest relative difference from a speed that the file states: more is no slip.
const SAME_SPEED: f64 = 0.02;

/// Where the shaft's speed comes from.
#[derive(Debug, Clone, PartialEq)]
pub enum ShaftSpeed {
    /// The user, or a column of the file.
    Stated(Speed),
    /// The signal itself, between two limits (Hz).
    Sought([f64; 2]),
}

/// A speed as it is typed: `25`, `1500rpm`, `20..30`, `20..30Hz`, `1200..1800rpm`.
pub(crate) fn shaft_speed(text: &str) -> Result<ShaftSpeed, String> {
    let Some((low, high)) = text.split_once("..") else {
        let wanted = |why| format!("{why}, or limits as in 20..30");
        return speed(text).map(|hertz| ShaftSpeed::Stated(Speed::Constant(hertz))).map_err(wanted);
    };
    // A unit behind the second is of both.
    let digits = |c: char| c.is_ascii_digit() || c == '.';
    let unit = if low.ends_with(digits) { high.trim_start_matches(digits) } else { "" };
    Ok(ShaftSpeed::Sought([speed(&format!("{low}{unit}"))?, speed(high)?]))
}

/// Options of `size`.
#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("shaft"))]
#[command(group = clap::ArgGroup::new("which").required(true))]
pub struct Size {
    /// Recordings of one bearing: .csv, .tsv, .txt, .lvm, .npy, .npz, .mat or .wav, or texts of any other name
    #[arg(required = true, value_name = "RECORDING")]
    recordings: Vec<PathBuf>,
    /// Scene file (TOML) of the bearing, its load and, if known, its rig; its defect is ignored
    #[arg(long, group = "which")]
    scene: Option<PathBuf>,
    /// Instead of a scene a bearing that `brinell catalogue` lists; nothing is known of its rig
    #[arg(long, value_name = "NAME", group = "which")]
    bearing: Option<String>,
    /// Load of that bearing in newtons [default: 5 % of the static rating]
    #[arg(long, value_name = "N", requires = "bearing", allow_negative_numbers = true, value_parser = number)]
    load: Option<f64>,
    /// Sampling rate in hertz, or as in 51.2kHz [default: the file's own]
    #[arg(long, value_name = "HZ", allow_negative_numbers = true, value_parser = rate)]
    rate: Option<f64>,
    /// Shaft speed in hertz, or in rpm as in 1797rpm: one for all recordings, or one for each, separated by commas;
    /// LOW..HIGH, as in 20..30 or 1200..1800rpm, seeks it by the shaft's own lines; HIGH below 1.9 times LOW
    #[arg(
        long,
        value_name = "HZ|LOW..HIGH",
        value_delimiter = ',',
        group = "shaft",
        allow_negative_numbers = true,
        value_parser = shaft_speed,
    )]
    speed: Vec<ShaftSpeed>,
    /// Column of a tachometer, by name or by number from 1
    #[arg(long, value_name = "COLUMN", group = "shaft")]
    tacho: Option<String>,
    /// Pulses of the tachometer per shaft turn
    #[arg(
        long,
        value_name = "COUNT",
        default_value_t = 1,
        allow_negative_numbers = true,
        value_parser = whole::<1, 10_000>,
    )]
    pulses: u32,
    /// Column of the shaft's speed at every sample, in hertz unless its heading says rpm or rad/s
    #[arg(long, value_name = "COLUMN", group = "shaft")]
    speed_column: Option<String>,
    /// Channel of the signal, by name or by number from 1, where a file has several
    #[arg(long, value_name = "NAME|NUMBER", alias = "column")]
    channel: Option<String>,
    /// What stands between the columns of a text: a sign, tab or blank [default: of .csv a comma, of .tsv a tab, of
    /// others blanks; a semicolon with --decimal ,; of .lvm what its header says]
    #[arg(long, value_name = "SIGN", value_parser = delimiter)]
    delimiter: Option<char>,
    /// Decimal sign of a text, a point or a comma [default: .]
    #[arg(long, value_name = "SIGN")]
    decimal: Option<char>,
    /// Write an HTML page with what the answer rests on: spectra, combs, averaged passage
    #[arg(long, value_name = "FILE.html", value_parser = html_file)]
    report: Option<PathBuf>,
    #[command(flatten)]
    drawn: Drawn,
}

impl Size {
    /// The bearing and its load.
    fn scene(&self) -> Result<Scene> {
        match &self.scene {
            Some(path) => Ok(read_scene(path)?.1),
            None => new_scene::without_rig(self.bearing.as_deref().unwrap_or_default(), self.load),
        }
    }

    /// What nobody gave.
    fn assumed(&self, scene: &Scene) -> Vec<String> {
        let mut assumed = Vec::new();
        if self.bearing.is_some() && self.load.is_none() {
            assumed.push(format!("load {:.0} N, 5 % of the static rating (--load)", scene.shaft.load[1].abs()));
        }
        if self.bearing.is_some() {
            let clearance = 1e6 * scene.bearing.radial_clearance;
            assumed.push(format!("radial clearance {} um and dimensions of the catalogue", digits(clearance)));
        }
        assumed
    }

    /// Speed of the shaft in all recordings, or in each.
    fn speeds(&self) -> Vec<ShaftSpeed> {
        if let Some(column) = &self.tacho {
            vec![ShaftSpeed::Stated(Speed::Tachometer(column.clone(), self.pulses))]
        } else if let Some(column) = &self.speed_column {
            vec![ShaftSpeed::Stated(Speed::Column(column.clone()))]
        } else if self.speed.is_empty() {
            vec![ShaftSpeed::Stated(Speed::Unknown)]
        } else {
            self.speed.clone()
        }
    }
}

/// The command: prints the report, and writes `<folder>/<recording>-size.csv`, `.json` and, if wanted, figures.
pub fn command(project: &Project, options: &Size) -> Result<()> {
    // In space balls pass a spall as often as the contact angle says under which they run.
    let scene = with_operating_angle(&options.scene()?).into_owned();
    if let Some(said) = operating_angle(&scene) {
        note!("note: {said}");
    }
    let speeds = options.speeds();
    let recordings = read(options, &speeds, &scene.bearing)?;
    for (r, speed) in recordings.iter().zip(speeds.iter().cycle()) {
        // Times that are read as numbers leave some 1e-13 of the rate over.
        let rate = digits(1e-3 * r.rate());
        let by = if matches!(speed, ShaftSpeed::Sought(_)) { ", by its own lines" } else { "" };
        note!("{}: {:.3} s at {rate} kHz, shaft {:.4} Hz{by}", r.name(), r.duration(), r.speed());
    }
    let asked = questions(&recordings, &speeds, &scene.bearing);
    for asked in &asked {
        note!("note: {asked}");
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
    let mut report = report?;
    // Whoever reads the answer alone is to know that it may be of another speed.
    report.reason.extend(asked.iter().map(|asked| format!("; {asked}")));
    report.assumed = options.assumed(&scene);
    eprintln!("{}", found(&report));
    for line in basis(&report) {
        eprintln!("  {line}");
    }
    println!("{}", serde_json::to_string_pretty(&report)?);
    std::io::stdout().flush()?;
    let stems = write(&report, &options.drawn.folder(project, "size"))?;
    if let Some(path) = &options.report {
        whole_file::write(path, size_report::page(&report, &recordings, &scene, &found(&report))?)?;
        eprintln!("{}", path.display());
    }
    eprint!("{}", options.drawn.figure(project, "size.py", &stems, &stems)?);
    Ok(())
}

/// Questions about speeds that were probably given in another unit. A tachometer has none.
fn questions(recordings: &[Recording], speeds: &[ShaftSpeed], bearing: &Bearing) -> Vec<String> {
    let mut asked = Vec::new();
    for (r, speed) in recordings.iter().zip(speeds.iter().cycle()) {
        let hertz = match speed {
            ShaftSpeed::Stated(Speed::Tachometer(..)) => continue,
            ShaftSpeed::Stated(_) => r.speed(),
            ShaftSpeed::Sought([_, high]) => *high,
        };
        let question = UnitQuestion::of(bearing, "shaft.speed_hz", hertz);
        asked.extend(question.map(|question| format!("{}: shaft {} Hz: {question}", r.name(), digits(hertz))));
    }
    asked
}

fn read(options: &Size, speeds: &[ShaftSpeed], bearing: &Bearing) -> Result<Vec<Recording>> {
    let (paths, count) = (&options.recordings, speeds.len());
    if count != 1 && count != paths.len() {
        bail!("{count} speeds for {} recordings: give one for all, or one for each", paths.len());
    }
    let text = TextFormat { delimiter: options.delimiter, decimal: options.decimal };
    let recordings = paths.iter().zip(speeds.iter().cycle()).map(|(path, speed)| {
        // Until it is found a speed that can be stands in for it: limits are judged where it is sought.
        let stated = match speed {
            ShaftSpeed::Stated(speed) => speed.clone(),
            ShaftSpeed::Sought(_) => Speed::Constant(1.0),
        };
        let source = Source { rate: options.rate, speed: stated, signal: options.channel.clone(), text };
        let recording = Recording::read(path, &source)?;
        let recording = match speed {
            ShaftSpeed::Stated(_) => recording,
            ShaftSpeed::Sought(limits) => {
                let found = find_speed(recording.name(), recording.samples(), recording.rate(), bearing, *limits)?;
                recording.at_speed(found)?
            }
        };
        tell(&recording);
        Ok(recording)
    });
    recordings.collect()
}

/// How a file was read, and whether it states another speed than what is used.
fn tell(recording: &Recording) {
    for remark in recording.remarks() {
        note!("note: {remark}");
    }
    let other = |stated: &&Stated| !((recording.speed() / stated.hertz - 1.0).abs() <= SAME_SPEED);
    if let Some(stated) = recording.stated_speed().filter(other) {
        note!(
            "warning: {}: it has {} = {}, a shaft at {} Hz, and is sized at {} Hz: which is right?",
            recording.name(),
            stated.name,
            stated.value,
            digits(stated.hertz),
            digits(recording.speed())
        );
    }
}

/// Which part, how plainly, how long, how far to rely on it: one line.
fn found(report: &Report) -> String {
    let standing = match report.standing {
        Some(Standing::Firm) => ", firm",
        Some(Standing::Provisional) => ", provisional",
        None => "",
    };
    let part = size_report::damaged(report.fault, report.grade);
    if report.fault == Fault::None {
        return part;
    }
    format!("{part}: {}{standing}", size_report::length(report))
}

/// What the answer rests on, what was assumed and what to do next: lines below it.
fn basis(report: &Report) -> Vec<String> {
    let mut lines: Vec<String> = report.reason.split("; ").map(str::to_owned).collect();
    lines.extend(report.assumed.iter().map(|assumed| format!("assumed: {assumed}")));
    lines.push(format!("next: {}", report.next));
    lines
}

/// What one of several recordings gave.
fn of_recording(done: &RecordingReport) -> String {
    let why = done.reason.as_ref().map_or(String::new(), |reason| format!(": {reason}"));
    format!("{}: {}{why}", size_report::damaged(done.fault, done.grade), size_report::recorded_length(done))
}

/// Averaged passages as CSV and what they show as JSON, each named when it is there; gives the files' stems.
fn write(report: &Report, folder: &Path) -> Result<Vec<PathBuf>> {
    let mut stems: Vec<PathBuf> = Vec::new();
    for (figure, recording) in report.figures.iter().zip(&report.recordings) {
        // Of names that are dates the last part is no ending.
        let named = Path::new(&figure.name);
        let ends = named.extension().is_some_and(|end| ENDINGS.iter().any(|known| end.eq_ignore_ascii_case(known)));
        let name = if ends { named.file_stem() } else { Some(named.as_os_str()) };
        let name = name.unwrap_or_default().to_string_lossy().into_owned();
        // Never the recording's own name: the folder may be its own.
        let mut stem = folder.join(format!("{name}-size"));
        // Recordings of one name from several folders.
        for count in 2.. {
            if !stems.contains(&stem) {
                break;
            }
            stem = folder.join(format!("{name}-size-{count}"));
        }
        let passage = whole_file::beside(&stem, ".csv");
        write_passage(&passage, figure)?;
        eprintln!("{}", passage.display());
        let mut answer = serde_json::to_value(recording)?;
        answer["critical_load_n"] = serde_json::json!(report.critical_load_n);
        answer["critical_load_reason"] = serde_json::json!(report.critical_load_reason);
        answer["kind"] = serde_json::json!(report.kind);
        let about = whole_file::beside(&stem, ".json");
        whole_file::write(&about, serde_json::to_string_pretty(&answer)? + "\n")?;
        eprintln!("{}", about.display());
        stems.push(stem);
    }
    Ok(stems)
}

fn write_passage(path: &Path, figure: &Figure) -> Result<()> {
    let mut names = vec![("angle", "deg"), ("signal", "1"), ("level", "dB"), ("low", "1")];
    let mut columns = vec![&figure.angle, &figure.signal, &figure.level, &figure.low];
    for (name, unit, column) in [("model", "1", &figure.model), ("path", "m", &figure.path)] {
        if let Some(column) = column {
            names.push((name, unit));
            columns.push(column);
        }
    }
    csv::table(path, &names, &columns)
}
