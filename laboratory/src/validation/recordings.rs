//! Recordings of a machine, sized singly and by group, and the scene of one of them beside it.
//!
//! The recordings belong to others and are not part of this project. What was found in them is:
//! their table on the page is written anew only when recordings are given.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use brinell::scene::{Defect, DefectShape, Scene};
use brinell_analysis::recording::{Recording, Source, Speed, TextFormat};
use brinell_analysis::sizing;
use brinell_analysis::sizing::event_length::AveragedPassage;
use brinell_analysis::sizing::passages::fold;
use brinell_analysis::sizing::{Fault, Figure, Measured, RecordingReport};

use super::{blind, write_csv};
use fmu_build::paper::Case;
use fmu_build::shared::{Project, contact_map};

/// Scene of the rig.
const SCENE: &str = "6205-spall-5deg";
/// The same bearing with a spall of the inner raceway.
const INNER_SCENE: &str = "6205-inner-5deg";
/// Way from the loudest impact that another must keep (degrees): less than half of a spall of 5 degrees, more than
/// echoes.
const APART: f64 = 2.0;
/// What the inner scene records: long enough for the load zone's share of passages.
const INNER_SECONDS: f64 = 3.0;
const RATE: f64 = 51_200.0;
/// The other spall laid beside the recording: length at the surface (degrees), depth (m), slope of the flanks
/// (degrees). Its floor is 5 degrees long. Chosen so that impacts and null fall where the recording has them.
const FLANKS: [f64; 3] = [5.8, 12e-6, 4.18];
/// Harmonics of the envelope that are drawn.
const HARMONICS: usize = 20;

/// A recording with what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Known {
    /// The file.
    pub path: PathBuf,
    /// Shaft speed (Hz).
    pub speed: f64,
    /// Sampling rate (Hz), where it is not that of all.
    pub rate: Option<f64>,
    /// Nominal length (degrees), 0 of a healthy bearing or of a fault that has none.
    pub nominal: f64,
    /// The fault that it is of.
    pub fault: Fault,
}

impl Known {
    /// `FILE@HZ=DEGREES` of the outer raceway, `FILE@HZ=DEGREESi` of the inner one, `FILE@HZ=0` healthy,
    /// `FILE@HZ=ball`; behind the speed `/RATE` where the sampling rate is another (Hz).
    pub fn parse(text: &str) -> Result<Self> {
        let wanted = || {
            format!(
                "{text}: recordings are given as FILE@HZ=DEGREES or FILE@HZ/RATE=DEGREES, with an i behind it for the \
                 inner raceway, or ball"
            )
        };
        let (path, rest) = text.rsplit_once('@').with_context(wanted)?;
        let (speed, nominal) = rest.split_once('=').with_context(wanted)?;
        let (speed, rate) = match speed.split_once('/') {
            Some((speed, rate)) => (speed, Some(rate.parse().with_context(wanted)?)),
            None => (speed, None),
        };
        let (path, speed) = (path.into(), speed.parse().with_context(wanted)?);
        if nominal == "ball" {
            return Ok(Self { path, speed, rate, nominal: 0.0, fault: Fault::Element });
        }
        let (length, raceway) = match nominal.strip_suffix('i') {
            Some(length) => (length, Fault::Inner),
            None => (nominal, Fault::Outer),
        };
        let nominal: f64 = length.parse().with_context(wanted)?;
        Ok(Self { path, speed, rate, nominal, fault: if nominal > 0.0 { raceway } else { Fault::None } })
    }
}

/// The table of recordings and the comparison with the scene, as Markdown.
pub fn table(project: &Project, known: &[Known], rate: f64) -> Result<String> {
    let case = Case::shipped(SCENE)?;
    let [length, depth, slope] = FLANKS;
    let mut with_flanks = case.clone().with_spall(length, depth);
    if let Some(Defect { shape: DefectShape::Spall { edge_slope, .. }, .. }) = with_flanks.scene.defects.first_mut() {
        *edge_slope = slope.to_radians();
    }
    let scene = Scene { defects: Vec::new(), ..case.scene.clone() };
    let maps = |scene: &Scene| contact_map::of(scene, None, project).ok().flatten();
    let read = |known: &Known| -> Result<Recording> {
        let speed = Speed::Constant(known.speed);
        let text = TextFormat::default();
        let source = Source { rate: known.rate.or(Some(rate)), speed, signal: None, text };
        Ok(Recording::read(&known.path, &source)?)
    };
    let mut text = String::from(
        "| recording | nominal (°) | looks like | found (°) | 95 % (°) | error | onset (°) | impacts (°) \
         |\n|---|---:|---|---:|---:|---:|---:|---|\n",
    );
    let mut groups: Vec<OneFault> = Vec::new();
    let mut beside: Vec<Beside> = Vec::new();
    let mut inside: Vec<Inside> = Vec::new();
    for one in known {
        let recording = read(one)?;
        let report = sizing::size_with(std::slice::from_ref(&recording), &scene, &maps, &mut |_| ())?;
        let (Some(found), Some(figure)) = (report.recordings.first(), report.figures.first()) else {
            bail!("no report of {}", one.path.display());
        };
        text += &row(found, one)?;
        if one.nominal == case.length().round() && one.fault == Fault::Outer {
            let comb = harmonics(&recording, &scene)?;
            beside.push(Beside { speed: one.speed, figure: figure.clone(), found: found.clone(), comb });
        }
        if one.nominal == case.length().round() && one.fault == Fault::Inner {
            let loud = Loud::of(&recording, &scene)?;
            inside.push(Inside { speed: one.speed, found: found.clone(), loud });
        }
        match groups.iter_mut().find(|group| group.nominal == one.nominal && group.fault == one.fault) {
            Some(group) => group.recordings.push(recording),
            None => groups.push(OneFault { nominal: one.nominal, fault: one.fault, recordings: vec![recording] }),
        }
    }
    let several = groups.iter().filter(|group| group.recordings.len() > 1 && group.nominal > 0.0);
    for OneFault { nominal, fault, recordings } in several {
        let report = sizing::size_with(recordings, &scene, &maps, &mut |_| ())?;
        let per_degree = report.length_mm.zip(report.length_deg).map_or(1.0, |(mm, deg)| mm / deg);
        let error = |deg: f64| format!("{:+.1} %", 100.0 * (deg / nominal - 1.0));
        writeln!(
            text,
            "| **all {} of {nominal}° {} together** | {nominal} | {} | {} | {} | {} | | {} |",
            recordings.len(),
            if *fault == Fault::Inner { "inside" } else { "outside" },
            looks_like(report.fault),
            number(report.length_deg),
            number(report.uncertainty_mm.map(|mm| mm / per_degree)),
            report.length_deg.map_or("–".to_owned(), error),
            report.standing.map_or(String::new(), |standing| format!("{standing:?}").to_lowercase())
        )?;
    }
    text += &outer_beside(project, [&case, &with_flanks], &beside)?;
    text += &inner_beside(project, &inside)?;
    Ok(text)
}

/// Recordings of one fault and one nominal length (degrees).
struct OneFault {
    nominal: f64,
    fault: Fault,
    recordings: Vec<Recording>,
}

/// What stands beside an outer recording.
struct Beside {
    /// Of the shaft (Hz).
    speed: f64,
    figure: Figure,
    found: RecordingReport,
    /// Harmonics of its envelope.
    comb: Vec<f64>,
}

/// What stands beside an inner recording.
struct Inside {
    /// Of the shaft (Hz).
    speed: f64,
    found: RecordingReport,
    loud: Loud,
}

/// The outer scene and that with flanks beside recordings of their length, as Markdown; nothing without these.
fn outer_beside(project: &Project, [case, with_flanks]: [&Case; 2], beside: &[Beside]) -> Result<String> {
    if beside.is_empty() {
        return Ok(String::new());
    }
    let mut text = String::from("\n### The scene beside the recording of 5°\n\n");
    text += "| shaft (Hz) | | onset before the first impact (°) | first to last impact (°) | length by events (°) \
             | null of the envelope's harmonics |\n|---:|---|---:|---:|---:|---:|\n";
    for Beside { speed, figure, found, comb } in beside {
        writeln!(text, "{}", beside_row(*speed, "recording", Some(found), comb))?;
        for (label, case) in [("scene", case), ("with flanks", with_flanks)] {
            let case = case.clone().at_speed(*speed);
            // By its events, like the recording: a scene without sensor is no rig to compare with.
            let recording = Recording::new("scene", blind::recorded(project, &case)?, RATE, *speed)?;
            let blind = Scene { defects: Vec::new(), sensors: Vec::new(), ..case.scene.clone() };
            let report = sizing::size(std::slice::from_ref(&recording), &blind)?;
            let own = harmonics(&recording, &blind)?;
            writeln!(text, "{}", beside_row(*speed, label, report.recordings.first(), &own))?;
            // The figure shows the last, which is nearer.
            let stem = format!("beside-{speed:.0}hz");
            let simulated = report.figures.first().zip(report.recordings.first());
            write_beside(project, &stem, [Some((figure, found)), simulated], [comb, &own])?;
        }
    }
    Ok(text)
}

/// The inner scene beside recordings of its length, as Markdown; nothing without these.
fn inner_beside(project: &Project, recorded: &[Inside]) -> Result<String> {
    if recorded.is_empty() {
        return Ok(String::new());
    }
    let case = Case::shipped(INNER_SCENE)?;
    let mut text = String::from(
        "\n### The inner scene beside the recording of 5°\n\n\
         | shaft (Hz) | | looks like | two loudest (° apart) | impacts (° after the first) | onset before the first \
         impact (°) | length by events (°) | strong over weak passages |\n\
         |---:|---|---|---:|---|---:|---:|---:|\n",
    );
    for Inside { speed, found, loud } in recorded {
        writeln!(text, "{}", inner_row(*speed, "recording", found, loud))?;
        let case = case.clone().at_speed(*speed);
        let signal = case.record(project, &["sensor.acceleration"], RATE, INNER_SECONDS)?.remove(0);
        let recording = Recording::new("scene", signal, RATE, *speed)?;
        let blind = Scene { defects: Vec::new(), sensors: Vec::new(), ..case.scene.clone() };
        let report = sizing::size(std::slice::from_ref(&recording), &blind)?;
        let loud = Loud::of(&recording, &blind)?;
        let Some(found) = report.recordings.first() else { bail!("no report of the scene {INNER_SCENE}") };
        writeln!(text, "{}", inner_row(*speed, "scene", found, &loud))?;
    }
    Ok(text)
}

fn inner_row(speed: f64, label: &str, found: &RecordingReport, loud: &Loud) -> String {
    let impacts: Vec<String> = loud.impacts.iter().map(|impact| format!("{impact:.2}")).collect();
    let onset = number(before_impact(found).map(|onset| -onset));
    let length = number(found.length_deg);
    let (fault, strong) = (looks_like(found.fault), found.modulation);
    let (impacts, apart) = (impacts.join(", "), loud.apart);
    format!("| {speed} | {label} | {fault} | {apart:.2} | {impacts} | {onset} | {length} | {strong:.1} |")
}

/// Onset of the entry (degrees), the first impact at 0, as the page's tables have it.
fn before_impact(found: &RecordingReport) -> Option<f64> {
    Some(found.onset_deg? - found.impacts_deg.first()?)
}

/// Impacts (degrees), likewise.
fn after_first(found: &RecordingReport) -> Vec<f64> {
    found.impacts_deg.iter().map(|impact| impact - found.impacts_deg[0]).collect()
}

/// What is loud in an averaged passage (degrees).
struct Loud {
    /// Impacts, after the first.
    impacts: Vec<f64>,
    /// From the highest of the envelope's level to the highest that is at least [`APART`] away.
    apart: f64,
}

impl Loud {
    fn of(recording: &Recording, scene: &Scene) -> Result<Self> {
        let measured = Measured::new(recording, &scene.bearing)?;
        let passage = AveragedPassage::of(&measured);
        let [angle, _, level] = passage.curves(&measured, 0.0);
        let around = |a: f64, b: f64| {
            let way = (a - b).rem_euclid(measured.spacing);
            way.min(measured.spacing - way)
        };
        let loudest = |away: &dyn Fn(f64) -> bool| {
            let all = (0..level.len()).filter(|&i| away(angle[i]));
            all.max_by(|&a, &b| level[a].total_cmp(&level[b])).map_or(0.0, |i| angle[i])
        };
        let first = loudest(&|_| true);
        let second = loudest(&|at| around(at, first) >= APART);
        Ok(Self { impacts: passage.impacts(), apart: around(first, second) })
    }
}

fn looks_like(fault: Fault) -> &'static str {
    match fault {
        Fault::Outer => "outer raceway",
        Fault::Inner => "inner raceway",
        Fault::Element => "element",
        Fault::Undecided => "undecided",
        Fault::None => "none",
    }
}

fn beside_row(speed: f64, label: &str, found: Option<&RecordingReport>, comb: &[f64]) -> String {
    let onset = number(found.and_then(before_impact).map(|onset| -onset));
    let last = number(found.and_then(|f| after_first(f).last().copied()));
    let length = number(found.and_then(|f| f.length_deg));
    format!("| {speed} | {label} | {onset} | {last} | {length} | {} |", null(comb))
}

fn row(found: &RecordingReport, known: &Known) -> Result<String> {
    let name = Path::new(&found.name).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let nominal = known.nominal;
    let error =
        found.length_deg.filter(|_| nominal > 0.0).map(|deg| format!("{:+.1} %", 100.0 * (deg / nominal - 1.0)));
    let impacts: Vec<String> = after_first(found).iter().map(|impact| format!("{impact:.2}")).collect();
    let length = found.length_deg.map_or("unresolved".to_owned(), |deg| format!("{deg:.2}"));
    let nominal = match known.fault {
        Fault::Outer => format!("{nominal}"),
        Fault::Inner => format!("{nominal} inside"),
        Fault::Element => "ball".to_owned(),
        Fault::None | Fault::Undecided => "healthy".to_owned(),
    };
    Ok(format!(
        "| `{name}` | {nominal} | {} | {length} | {} | {} | {} | {} |\n",
        looks_like(found.fault),
        number(found.uncertainty_deg),
        error.unwrap_or("–".to_owned()),
        number(before_impact(found)),
        impacts.join(", ")
    ))
}

fn number(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.2}"))
}

/// Amplitudes of the averaged envelope's harmonics of the ball pass frequency, over that of the first.
fn harmonics(recording: &Recording, scene: &Scene) -> Result<Vec<f64>> {
    let measured = Measured::new(recording, &scene.bearing)?;
    let row = fold::average(&measured.envelope_rows(0.0, measured.points()));
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
    sized: [Option<(&Figure, &RecordingReport)>; 2],
    [comb, own]: [&[f64]; 2],
) -> Result<()> {
    for (label, sized) in ["recording", "scene"].into_iter().zip(sized) {
        let Some((figure, found)) = sized else { continue };
        // From the first impact, which both have.
        let first = found.impacts_deg.first().copied().unwrap_or(0.0);
        let angle = figure.angle.iter().map(|angle| angle - first).collect();
        let names = [("angle", "deg"), ("low", "1"), ("level", "dB")].map(|(name, unit)| (name.to_owned(), unit));
        let columns = [angle, figure.low.clone(), figure.level.clone()];
        write_csv(project, &format!("{stem}-{label}"), &names, &columns)?;
    }
    let order = (1..=comb.len()).map(|k| k as f64).collect();
    let names = [("harmonic", "1"), ("recording", "1"), ("scene", "1")].map(|(name, unit)| (name.to_owned(), unit));
    write_csv(project, &format!("{stem}-harmonics"), &names, &[order, comb.to_vec(), own.to_vec()])
}
