//! Recordings of a machine, sized singly and by group, and the scene of one of them beside it.
//!
//! The recordings belong to others and are not part of this project. What was found in them is:
//! `docs/validation-recordings.md` is written anew only when recordings are given.

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use brinell::scene::Scene;
use brinell_analysis::measured::Measured;
use brinell_analysis::recording::{Recording, Source, Speed};
use brinell_analysis::report::{Figure, RecordingReport};
use brinell_analysis::{passages, spall_size};

use super::blind;
use super::runs::Case;
use super::write_csv;
use fmu_build::contact_map;
use fmu_build::project::Project;

/// Scene of the rig.
const SCENE: &str = "6205-spall-5deg";
/// The other spall laid beside the recording: length at the surface [degrees], depth [m], slope of the flanks
/// [degrees]. Its floor is 5 degrees long. Chosen so that impacts and null fall where the recording has them.
const FLANKS: [f64; 3] = [5.8, 12e-6, 4.18];
/// Harmonics of the envelope that are drawn.
const HARMONICS: usize = 20;

/// A recording with what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// The file.
    pub path: PathBuf,
    /// Shaft speed [Hz].
    pub speed: f64,
    /// Nominal length [degrees], 0 of a healthy bearing.
    pub nominal: f64,
}

impl Known {
    /// `FILE@HZ=DEGREES`.
    pub fn parse(text: &str) -> Result<Self> {
        let wanted = || format!("{text}: recordings are given as FILE@HZ=DEGREES");
        let (path, rest) = text.rsplit_once('@').with_context(wanted)?;
        let (speed, nominal) = rest.split_once('=').with_context(wanted)?;
        Ok(Self {
            path: path.into(),
            speed: speed.parse().with_context(wanted)?,
            nominal: nominal.parse().with_context(wanted)?,
        })
    }
}

/// The table of recordings and the comparison with the scene, as Markdown.
pub fn table(project: &Project, known: &[Known], rate: f64) -> Result<String> {
    let case = Case::shipped(project, SCENE)?;
    let [length, depth, slope] = FLANKS;
    let with_flanks = case.clone().with_flanks(length, depth, slope);
    let scene = Scene { defects: Vec::new(), ..case.scene.clone() };
    let maps = |scene: &Scene| contact_map::of(scene, None, project).ok().flatten();
    let read = |known: &Known| -> Result<Recording> {
        let source = Source { rate: Some(rate), speed: Speed::Constant(known.speed), signal: None };
        Ok(Recording::read(&known.path, &source)?)
    };
    let mut text = String::from(
        "| recording | nominal (°) | found (°) | 95 % (°) | error | onset (°) | impacts (°) |\n|---|---:|---:|---:|---:|---:|---|\n",
    );
    let mut groups: Vec<(f64, Vec<Recording>)> = Vec::new();
    let mut beside: Vec<(f64, Figure, RecordingReport, Vec<f64>)> = Vec::new();
    for one in known {
        let recording = read(one)?;
        let report = spall_size::size_with(std::slice::from_ref(&recording), &scene, &maps, &mut |_| ())?;
        let (Some(found), Some(figure)) = (report.recordings.first(), report.figures.first()) else {
            bail!("no report of {}", one.path.display());
        };
        text += &row(found, one.nominal)?;
        if one.nominal == case.length() {
            beside.push((one.speed, figure.clone(), found.clone(), harmonics(&recording, &scene)?));
        }
        match groups.iter_mut().find(|(nominal, _)| *nominal == one.nominal) {
            Some((_, group)) => group.push(recording),
            None => groups.push((one.nominal, vec![recording])),
        }
    }
    for (nominal, group) in groups.iter().filter(|(_, group)| group.len() > 1) {
        let report = spall_size::size_with(group, &scene, &maps, &mut |_| ())?;
        let per_degree = report.length_mm.zip(report.length_deg).map_or(1.0, |(mm, deg)| mm / deg);
        let error = |deg: f64| format!("{:+.1} %", 100.0 * (deg / nominal - 1.0));
        writeln!(
            text,
            "| **all {} of {nominal}° together** | {nominal} | {} | {} | {} | | |",
            group.len(),
            number(report.length_deg),
            number(report.uncertainty_mm.map(|mm| mm / per_degree)),
            report.length_deg.map_or("–".to_owned(), error)
        )?;
    }
    if !beside.is_empty() {
        text += "\n### The scene beside the recording of 5°\n\n";
        text += "| shaft (Hz) | | onset before the first impact (°) | first to last impact (°) | length by events (°) | null of the envelope's harmonics |\n|---:|---|---:|---:|---:|---:|\n";
        for (speed, figure, found, comb) in &beside {
            writeln!(text, "{}", beside_row(*speed, "recording", Some(found), comb))?;
            for (label, case) in [("scene", &case), ("with flanks", &with_flanks)] {
                let case = case.clone().at_speed(*speed);
                // By its events, like the recording: a scene without sensor is no rig to compare with.
                let recording = Recording::new("scene", blind::recorded(project, &case)?, 51_200.0, *speed)?;
                let blind = Scene { defects: Vec::new(), sensors: Vec::new(), ..case.scene.clone() };
                let report = spall_size::size(std::slice::from_ref(&recording), &blind)?;
                let own = harmonics(&recording, &blind)?;
                writeln!(text, "{}", beside_row(*speed, label, report.recordings.first(), &own))?;
                // The figure shows the last, which is nearer.
                let stem = format!("beside-{speed:.0}hz");
                write_beside(project, &stem, figure, report.figures.first(), comb, &own)?;
            }
        }
    }
    Ok(text)
}

fn beside_row(speed: f64, label: &str, found: Option<&RecordingReport>, comb: &[f64]) -> String {
    let onset = number(found.and_then(|f| f.onset_deg).map(|onset| -onset));
    let last = number(found.and_then(|f| f.impacts_deg.last().copied()));
    let length = number(found.and_then(|f| f.length_deg));
    format!("| {speed} | {label} | {onset} | {last} | {length} | {} |", null(comb))
}

fn row(found: &RecordingReport, nominal: f64) -> Result<String> {
    let name = Path::new(&found.name).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let error =
        found.length_deg.filter(|_| nominal > 0.0).map(|deg| format!("{:+.1} %", 100.0 * (deg / nominal - 1.0)));
    let impacts: Vec<String> = found.impacts_deg.iter().map(|impact| format!("{impact:.2}")).collect();
    let length = found.length_deg.map_or("unresolved".to_owned(), |deg| format!("{deg:.2}"));
    let nominal = if nominal > 0.0 { format!("{nominal}") } else { "healthy".to_owned() };
    Ok(format!(
        "| `{name}` | {nominal} | {length} | {} | {} | {} | {} |\n",
        number(found.uncertainty_deg),
        error.unwrap_or("–".to_owned()),
        number(found.onset_deg),
        impacts.join(", ")
    ))
}

fn number(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.2}"))
}

/// Amplitudes of the averaged envelope's harmonics of the ball pass frequency, over that of the first.
fn harmonics(recording: &Recording, scene: &Scene) -> Result<Vec<f64>> {
    let measured = Measured::new(recording, &scene.bearing)?;
    let row = passages::average(&measured.envelope_rows(0.0, measured.points()));
    let amplitude = |k: usize| {
        let turn = std::f64::consts::TAU * k as f64 / row.len() as f64;
        let (re, im) = row.iter().enumerate().fold((0.0, 0.0), |(re, im), (i, x)| {
            (re + x * libm::cos(turn * i as f64), im - x * libm::sin(turn * i as f64))
        });
        libm::hypot(re, im)
    };
    let first = amplitude(1);
    Ok((1..=HARMONICS).map(|k| amplitude(k) / first).collect())
}

/// The first harmonic that is weaker than both its neighbours.
fn null(comb: &[f64]) -> String {
    let k = (1..comb.len() - 1).find(|&k| comb[k] < comb[k - 1] && comb[k] < comb[k + 1]);
    k.map_or("none".to_owned(), |k| (k + 1).to_string())
}

fn write_beside(
    project: &Project,
    stem: &str,
    recorded: &Figure,
    simulated: Option<&Figure>,
    comb: &[f64],
    own: &[f64],
) -> Result<()> {
    for (label, figure) in [("recording", Some(recorded)), ("scene", simulated)] {
        let Some(figure) = figure else { continue };
        let names = [("angle", "deg"), ("low", "1"), ("level", "dB")].map(|(name, unit)| (name.to_owned(), unit));
        let columns = [figure.angle.clone(), figure.low.clone(), figure.level.clone()];
        write_csv(project, &format!("{stem}-{label}"), &names, &columns)?;
    }
    let order = (1..=comb.len()).map(|k| k as f64).collect();
    let names = [("harmonic", "1"), ("recording", "1"), ("scene", "1")].map(|(name, unit)| (name.to_owned(), unit));
    write_csv(project, &format!("{stem}-harmonics"), &names, &[order, comb.to_vec(), own.to_vec()])
}

/// Where the table of recordings is kept.
pub fn kept(docs: &Path) -> PathBuf {
    docs.join("validation-recordings.md")
}

/// The table as it was written last.
pub fn last(docs: &Path) -> String {
    fs::read_to_string(kept(docs)).unwrap_or_else(|_| "No recordings were given yet.\n".to_owned())
}
