//! Whether the automatic choice of the method costs more than the best of its methods alone.
//!
//! Shipped scenes, and stiff ones made of them: light elements, strong damping, high load. The methods take turns, and
//! of each the fastest run counts, so that what else the machine does falls on all alike. Beside the CPU time stands a
//! count without noise: steps tried, an implicit one as so many explicit ones as it costs.

use std::path::Path;
use std::time::Duration;

use anyhow::Result;
use brinell::scene::{ContactLaw, Damping, Motion, Scene};
use brinell::simulation::{Method, Simulation, StepCounts};
use cpu_time::ThreadTime;

use super::Extent;
use super::integration::scene_file;
use super::run::STEP;
use fmu_build::package::Model;
use fmu_build::shared::{Project, contact_map, whole_file};

/// Explicit steps that an implicit one costs: what the choice itself assumes.
const EXPLICIT_STEPS: f64 = 5.0;
/// Tolerance of the runs.
const TOLERANCE: f64 = 1e-5;

/// One case: its name, its scene, simulated time (s), and what is changed.
type Case = (&'static str, &'static str, f64, fn(&mut Scene));

const CASES: [Case; 16] = [
    ("6205-hosted", "6205-hosted", 0.05, |_| {}),
    ("6205-healthy", "6205-healthy", 0.05, |_| {}),
    ("6205-epps", "6205-epps", 0.025, |_| {}),
    ("6205-spall-5deg", "6205-spall-5deg", 0.025, |_| {}),
    ("er16k-tb1-hosted-shaft", "er16k-tb1-hosted-shaft", 0.025, |_| {}),
    ("er16k-tb1", "er16k-tb1", 0.025, |_| {}),
    ("er16k-tb2", "er16k-tb2", 0.025, |_| {}),
    ("er16k-tb2-30um", "er16k-tb2-30um", 0.025, |_| {}),
    ("er16k-tb2-compliant", "er16k-tb2-compliant", 0.025, |_| {}),
    ("er16k-tb1, law hertz, elements 10 times lighter", "er16k-tb1", 0.02, |s| lighter(s, 0.1)),
    ("er16k-tb1, law hertz, elements 100 times lighter", "er16k-tb1", 0.02, |s| lighter(s, 0.01)),
    ("6205-healthy, elements 100 times lighter", "6205-healthy", 0.02, |s| lighter(s, 0.01)),
    ("6205-healthy, χ = 5 s/m", "6205-healthy", 0.05, |s| s.contact.damping = Damping::HuntCrossley(5.0)),
    ("6205-healthy, 50 kN, χ = 0.5 s/m", "6205-healthy", 0.02, |s| s.shaft.load = [0.0, -5e4]),
    ("6205-healthy, 50 kN, χ = 5 s/m", "6205-healthy", 0.02, |s| {
        s.shaft.load = [0.0, -5e4];
        s.contact.damping = Damping::HuntCrossley(5.0);
    }),
    ("6205-healthy, proportional, τ = 10 µs", "6205-healthy", 0.05, |s| {
        s.contact.damping = Damping::Proportional(1e-5);
    }),
];

/// Each alone, the last one automatic.
const METHODS: [Method; 4] = [Method::PhaseFitted, Method::DormandPrince, Method::Rodas, Method::Automatic];

/// What one case costs by each of [`METHODS`].
#[derive(Debug, Clone)]
pub(super) struct Row {
    pub(super) what: &'static str,
    /// CPU seconds per simulated second.
    pub(super) cost: [f64; 4],
    /// Tried steps per simulated second, implicit ones counted by what they cost.
    pub(super) steps: [f64; 4],
    /// Share of the automatic method's steps that were implicit.
    pub(super) implicit: f64,
}

impl Row {
    /// The automatic method's figure over the smallest of the others.
    pub(super) fn ratio([phase_fitted, dormand_prince, implicit, automatic]: [f64; 4]) -> f64 {
        automatic / phase_fitted.min(dormand_prince).min(implicit)
    }
}

fn lighter(scene: &mut Scene, factor: f64) {
    scene.contact.law = ContactLaw::Hertz;
    scene.bearing.element_mass = Some(factor * scene.bearing.mass_of_element());
}

/// Measures and writes `method-choice.csv`.
pub(super) fn measure(extent: Extent, data: &Path) -> Result<Vec<Row>> {
    let cases = if extent == Extent::Short { &CASES[..2] } else { &CASES[..] };
    let mut rows = Vec::new();
    for &(what, scene, stop, change) in cases {
        let mut model = Model::read(&scene_file(scene))?;
        change(&mut model.scene);
        model.scene.tolerance = TOLERANCE;
        let map = contact_map::of(&model.scene, model.profile_texts(), &Project::find())?;
        let mut simulation = Simulation::with_map(model.scene.clone(), model.profile_texts(), map.as_deref())?;
        if model.scene.shaft.motion == Motion::Host {
            // 12 µm beyond the concentric position: some hundred newtons on the lowest elements.
            simulation.set_reals(&[simulation.reference("shaft.y")?], &[-12e-6])?;
        }
        rows.push(compare(what, &simulation, stop)?);
    }
    let path = data.join("method-choice.csv");
    whole_file::write_with(&path, |out| {
        writeln!(
            out,
            "what,phase_fitted_cpu_s_per_s,dormand_prince_cpu_s_per_s,implicit_cpu_s_per_s,automatic_cpu_s_per_s,\
             phase_fitted_steps_per_s,dormand_prince_steps_per_s,implicit_steps_per_s,automatic_steps_per_s,\
             implicit_share"
        )?;
        for Row { what, cost, steps, implicit } in &rows {
            let numbers = cost.iter().chain(steps).map(|value| format!("{value:.4e}")).collect::<Vec<_>>().join(",");
            writeln!(out, "\"{what}\",{numbers},{implicit:.3}")?;
        }
        Ok(())
    })?;
    Ok(rows)
}

fn compare(what: &'static str, simulation: &Simulation, stop: f64) -> Result<Row> {
    let mut row = Row { what, cost: [f64::INFINITY; 4], steps: [0.0; 4], implicit: 0.0 };
    let (mut spent, mut rounds) = (Duration::ZERO, 0);
    while rounds < 5 || (spent < Duration::from_secs(6) && rounds < 60) {
        for (i, method) in METHODS.into_iter().enumerate() {
            let mut run = simulation.clone();
            run.set_method(method);
            run.initialize(0.0)?;
            let start = ThreadTime::now();
            for _ in 0..(stop / STEP).round() as usize {
                run.step(STEP)?;
            }
            let taken = start.elapsed();
            spent += taken;
            row.cost[i] = row.cost[i].min(taken.as_secs_f64() / stop);
            let Counted { steps, implicit } = counted(&mut run)?;
            row.steps[i] = steps / stop;
            if method == Method::Automatic {
                row.implicit = implicit;
            }
        }
        rounds += 1;
        if spent > Duration::from_secs(40) {
            break;
        }
    }
    Ok(row)
}

/// The steps of a run.
struct Counted {
    /// Tried ones, an implicit one as so many explicit ones as it costs.
    steps: f64,
    /// Share of implicit ones.
    implicit: f64,
}

/// Counts steps. Rejected ones are not counted by method: they are taken to be shared like the accepted.
fn counted(run: &mut Simulation) -> Result<Counted> {
    let mut rejected = [0];
    run.integers(&[run.reference("solver.rejected_steps")?], &mut rejected)?;
    let StepCounts { all, implicit } = run.step_counts();
    let share = implicit as f64 / all as f64;
    let tried = all as f64 + f64::from(rejected[0]);
    Ok(Counted { steps: tried * (1.0 + (EXPLICIT_STEPS - 1.0) * share), implicit: share })
}
