//! Error against CPU time of the time integration, for every shipped scene and every method.
//!
//! Errors are against the automatic method at a tolerance of 1e-12. How far that itself can be trusted is measured
//! against the other method of the pair.

use std::path::{Path, PathBuf};

use anyhow::Result;
use brinell::simulation::{Method, StepCounts};

use super::Extent;
use super::machine::{fastest, timed};
use super::run::{Deviation, STEP, Signals, Subject};
use crate::packed::{self, Packed};
use fmu_build::package::Model;
use fmu_build::shared::{Project, bar, whole_file};

/// Simulated time (s): long enough for an element to pass the spall of the ER16K, short enough for elements that bounce
/// freely not to have lost all memory of the start.
const STOP: f64 = 0.025;
/// Tolerances asked for.
const TOLERANCES: [f64; 9] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10];
/// How often all runs are timed, minutes apart: other programs on the machine come and go.
const ROUNDS: usize = 5;
/// The reference's tolerance.
const REFERENCE: f64 = 1e-12;

/// Errors and cost of one run.
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) scene: String,
    pub(super) method: &'static str,
    /// Tolerance.
    pub(super) setting: f64,
    /// CPU seconds per simulated second: of the automatic method in the FMU's own library, of the others, which an FMU
    /// does not offer by themselves, in this program.
    pub(super) cost: f64,
    /// The same in this program.
    pub(super) in_program: f64,
    /// Accepted steps per simulated second.
    pub(super) steps: f64,
    /// Share of them that were implicit.
    pub(super) implicit: f64,
    pub(super) deviation: Deviation,
}

/// How well a reference is known.
#[derive(Debug, Clone)]
pub(super) struct Check {
    pub(super) scene: String,
    /// Signal whose error is called the acceleration's.
    pub(super) signal: &'static str,
    /// The other method of the pair against the reference.
    pub(super) pair: Deviation,
}

/// The results.
#[derive(Debug, Clone)]
pub(super) struct Integration {
    pub(super) rows: Vec<Row>,
    pub(super) checks: Vec<Check>,
    /// Simulated time (s).
    pub(super) stop: f64,
}

const METHODS: [(&str, Method); 4] = [
    ("automatic", Method::Automatic),
    ("phase-fitted only", Method::PhaseFitted),
    ("DP5 only", Method::DormandPrince),
    ("Rodas5P only", Method::Rodas),
];

/// Measures and writes `integration.csv`.
pub(super) fn measure(project: &Project, extent: Extent, data: &Path) -> Result<Integration> {
    let names: &[&str] = match extent {
        Extent::Full => &[
            "6205-hosted",
            "6205-healthy",
            "6205-epps",
            "6205-spall-5deg",
            "er16k-tb1-hosted-shaft",
            "er16k-tb1",
            "er16k-tb2",
            "er16k-tb2-30um",
            "er16k-tb2-compliant",
        ],
        Extent::Short => &["6205-healthy", "er16k-tb1-hosted-shaft"],
    };
    let tolerances = if extent == Extent::Full { &TOLERANCES[..] } else { &TOLERANCES[1..4] };
    let library = packed::library(project)?;
    let rounds = if extent == Extent::Full { ROUNDS } else { 1 };
    let runs = METHODS.len() * tolerances.len();
    let steps = names.len() * (2 + (1 + rounds) * runs);
    let bar = bar(steps as u64, "integration [{bar:30}] {pos}/{len}, {elapsed} {msg}");
    let mut results = Integration { rows: Vec::new(), checks: Vec::new(), stop: STOP };
    let mut scenes = Vec::new();
    for name in names {
        let model = Model::read(&scene_file(name))?;
        let subject = Subject::new(&model, (*name).to_owned(), STOP)?;
        bar.set_message(format!("{name}: reference"));
        let reference = subject.signals(Method::Automatic, REFERENCE)?;
        bar.inc(1);
        let other = subject.signals(Method::Rodas, 10.0 * REFERENCE)?;
        bar.inc(1);
        results.checks.push(Check {
            scene: subject.name.clone(),
            signal: subject.signal(),
            pair: other.deviation(&reference),
        });
        for (label, method) in METHODS {
            for &tolerance in tolerances {
                bar.set_message(format!("{name}: error of {label}, {tolerance:e}"));
                results.rows.push(controlled(&subject, label, method, tolerance, &reference)?);
                bar.inc(1);
            }
        }
        scenes.push((Packed::new(&model, &library)?, subject));
    }
    for round in 1..=rounds {
        for ((fmu, subject), rows) in scenes.iter().zip(results.rows.chunks_mut(runs)) {
            let methods = METHODS.iter().flat_map(|(_, method)| tolerances.iter().map(move |_| *method));
            for (row, method) in rows.iter_mut().zip(methods) {
                bar.set_message(format!("round {round}: {}, {}, {:e}", row.scene, row.method, row.setting));
                let [in_program, cost] = times(subject, fmu, method, row.setting)?.map(|seconds| seconds / STOP);
                (row.in_program, row.cost) = (row.in_program.min(in_program), row.cost.min(cost));
                bar.inc(1);
            }
        }
    }
    bar.finish_and_clear();
    write(&data.join("integration.csv"), &results.rows)?;
    Ok(results)
}

/// Error and steps of a run, not yet timed.
fn controlled(
    subject: &Subject,
    label: &'static str,
    method: Method,
    tolerance: f64,
    reference: &Signals,
) -> Result<Row> {
    let signals = subject.signals(method, tolerance)?;
    let mut simulation = subject.start(method, tolerance)?;
    subject.finish(&mut simulation)?;
    let StepCounts { all, implicit, .. } = simulation.step_counts();
    Ok(Row {
        scene: subject.name.clone(),
        method: label,
        setting: tolerance,
        cost: f64::INFINITY,
        in_program: f64::INFINITY,
        steps: all as f64 / subject.stop,
        implicit: implicit as f64 / all as f64,
        deviation: signals.deviation(reference),
    })
}

/// CPU seconds of a run in this program and, of the automatic method, in the FMU's own library.
fn times(subject: &Subject, fmu: &Packed, method: Method, tolerance: f64) -> Result<[f64; 2]> {
    let start = subject.start(method, tolerance)?;
    let mut in_program = || {
        let mut simulation = start.clone();
        timed(|| subject.finish(&mut simulation))
    };
    if method == Method::Automatic {
        return fastest([&mut in_program, &mut || fmu.run(tolerance, subject.stop, STEP)]);
    }
    let [seconds] = fastest([&mut in_program])?;
    Ok([seconds; 2])
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().map(Path::to_path_buf).unwrap_or_default()
}

/// A shipped scene's file.
pub(super) fn scene_file(name: &str) -> PathBuf {
    root().join("scenes").join(name).with_extension("toml")
}

fn write(path: &Path, rows: &[Row]) -> Result<()> {
    whole_file::write_with(path, |out| {
        writeln!(
            out,
            "scene,method,setting,cpu_s_per_s,program_cpu_s_per_s,steps_per_s,implicit_share,acceleration_rms,\
             acceleration_max,path_rms_m,path_max_m"
        )?;
        for row in rows {
            let d = row.deviation;
            writeln!(
                out,
                "{},{},{:e},{:.4e},{:.4e},{:.4e},{:.3},{:.2e},{:.2e},{:.2e},{:.2e}",
                row.scene,
                row.method,
                row.setting,
                row.cost,
                row.in_program,
                row.steps,
                row.implicit,
                d.acceleration_rms,
                d.acceleration_max,
                d.path_rms,
                d.path_max
            )?;
        }
        Ok(())
    })
}
