//! How often `size` is right on recordings of known machines: `cargo lab diagnose LIST.csv`.
//!
//! The recordings are the user's: a list names each with its machine, its speed and what is damaged. Each is judged
//! whole, in halves and in pieces of one second, without knowledge of its rig, beside a plain script on the same pieces
//! ([`baseline`]). Results are counted by machine: what was adjusted on one machine proves nothing on it.

mod baseline;
mod list;
mod table;

use std::path::Path;

use anyhow::{Context, Result};
use brinell::scene::Scene;
use brinell_analysis::recording::{Recording, Source, Speed, TextFormat};
use brinell_analysis::sizing::{self, Fault, Grade, Report};
use cpu_time::ThreadTime;
use fmu_build::commands::new_scene::without_rig;
use rayon::prelude::*;

pub use list::{Known, read};

/// Length of a short piece (s).
const PIECE: f64 = 1.0;

/// Speeds that are tried, as shares of the true one: at these one kind of fault has the lines of another.
const WRONG: [f64; 4] = [0.5, 2.0 / 3.0, 1.5, 2.0];

/// What a piece of a recording is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Extent {
    Whole,
    Half,
    Second,
    /// Whole, at a speed that is not the shaft's.
    WrongSpeed,
}

/// What was answered of one piece.
#[derive(Debug, Clone)]
pub(crate) struct Answer {
    pub(crate) known: Known,
    pub(crate) extent: Extent,
    pub(crate) fault: Fault,
    pub(crate) grade: Grade,
    /// Length and half its interval (degrees).
    pub(crate) length: Option<[f64; 2]>,
    pub(crate) at_least: Option<f64>,
    /// What the script says.
    pub(crate) script: Fault,
    /// CPU time (s).
    pub(crate) cpu: f64,
    /// Share, and share alone, of the combs of outer raceway, inner raceway and element.
    combs: [f64; 6],
    reason: String,
}

/// The command: the tables as Markdown on standard output, each answer into a file if wanted.
///
/// # Errors
/// A list or a recording that cannot be read.
pub fn command(list: &Path, answers: Option<&Path>) -> Result<()> {
    let all: Vec<Vec<Answer>> = read(list)?.par_iter().map(judged).collect::<Result<_>>()?;
    let all: Vec<Answer> = all.into_iter().flatten().collect();
    if let Some(path) = answers {
        write(path, &all)?;
    }
    print!("{}", table::tables(&all));
    Ok(())
}

/// All answers of one recording.
fn judged(known: &Known) -> Result<Vec<Answer>> {
    let source = Source {
        rate: known.rate,
        speed: Speed::Constant(known.speed),
        signal: known.channel.clone(),
        text: TextFormat::default(),
    };
    let whole = Recording::read(&known.path, &source)?;
    let scene = without_rig(&known.bearing, known.load)?;
    let (samples, rate) = (whole.samples(), whole.rate());
    let half = samples.len() / 2;
    let second = (PIECE * rate) as usize;
    let halves = samples.chunks_exact(half.max(1)).map(|piece| (Extent::Half, piece));
    let seconds = samples.chunks_exact(second.max(1)).map(|piece| (Extent::Second, piece));
    let pieces = std::iter::once((Extent::Whole, samples)).chain(halves).chain(seconds);
    let wrong = WRONG.map(|times| (Extent::WrongSpeed, samples, times));
    let one = |(extent, piece, times): (Extent, &[f64], f64)| -> Option<Result<Answer>> {
        let recording = Recording::new(whole.name(), piece.to_vec(), rate, times * known.speed).ok()?;
        Some(answer(known, extent, &recording, &scene))
    };
    pieces.map(|(extent, piece)| (extent, piece, 1.0)).chain(wrong).filter_map(one).collect()
}

fn answer(known: &Known, extent: Extent, recording: &Recording, scene: &Scene) -> Result<Answer> {
    let begin = ThreadTime::now();
    let report = sizing::size(std::slice::from_ref(recording), scene);
    let cpu = begin.elapsed().as_secs_f64();
    let report = report.with_context(|| known.path.display().to_string())?;
    let script = baseline::kind(recording, &scene.bearing);
    let Report { recordings, fault, reason, .. } = report;
    let one = recordings.first().context("no report of the recording")?;
    let combs = &one.combs;
    Ok(Answer {
        known: known.clone(),
        extent,
        fault,
        grade: one.grade,
        length: one.length_deg.zip(one.uncertainty_deg).map(|(length, half)| [length, half]),
        at_least: one.at_least_deg,
        script,
        cpu,
        combs: [
            combs.outer.share,
            combs.outer.alone,
            combs.inner.share,
            combs.inner.alone,
            combs.element.share,
            combs.element.alone,
        ],
        reason,
    })
}

fn write(path: &Path, all: &[Answer]) -> Result<()> {
    let mut text = String::from(
        "file,machine,extent,truth,nominal_deg,answer,grade,script,length_deg,half_interval_deg,at_least_deg,cpu_s,\
         outer,outer_alone,inner,inner_alone,element,element_alone,reason\n",
    );
    let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.3}"));
    for a in all {
        let stem = a.known.path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let combs: Vec<String> = a.combs.iter().map(|share| format!("{share:.4}")).collect();
        text += &format!(
            "{stem},{},{:?},{:?},{},{:?},{:?},{:?},{},{},{},{:.2},{},\"{}\"\n",
            a.known.machine,
            a.extent,
            a.known.fault,
            number(a.known.length),
            a.fault,
            a.grade,
            a.script,
            number(a.length.map(|l| l[0])),
            number(a.length.map(|l| l[1])),
            number(a.at_least),
            a.cpu,
            combs.join(","),
            a.reason.replace('"', "'")
        );
    }
    fmu_build::shared::whole_file::write(path, text)
}
