//! What each part of a scene costs: from the barest bearing upwards, one part more at a time.

use std::f64::consts::TAU;
use std::path::Path;

use anyhow::Result;
use brinell::scene::{
    CageIrregularity, ContactLaw, Defect, DefectOn, DefectShape, Motion, Recorder, RecorderFilter, Ring, Scene, Sensor,
};
use brinell::simulation::Simulation;

use super::Extent;
use super::integration::scene_file;
use super::machine::fastest;
use fmu_build::package::Model;
use fmu_build::shared::{Project, contact_map, whole_file};

/// Communication step (s).
const STEP: f64 = 1e-4;

/// Cost of one scene.
#[derive(Debug, Clone)]
pub(super) struct Part {
    /// What it has.
    pub(super) what: &'static str,
    /// Number of states.
    pub(super) states: usize,
    /// Number of variables.
    pub(super) variables: usize,
    /// CPU seconds per simulated second.
    pub(super) cost: f64,
    /// Accepted steps per simulated second.
    pub(super) steps: f64,
    /// Contacts near the defect per simulated second.
    pub(super) lookups: f64,
}

/// Measures and writes `leaving-out.csv`.
pub(super) fn measure(extent: Extent, data: &Path) -> Result<Vec<Part>> {
    let stop = if extent == Extent::Full { 0.1 } else { 0.01 };
    let full = Model::read(&scene_file("6205-healthy"))?.scene;
    let mut bare = full.clone();
    bare.shaft = Ring::hosted();
    bare.housing = bare.shaft;
    bare.sensors.clear();

    let mut parts = Vec::new();
    let mut add = |what, scene: &Scene, seen: Seen| -> Result<()> {
        parts.push(cost(what, scene, seen, stop)?);
        Ok(())
    };
    add("elements alone, both rings from the host", &bare, Seen::Nothing)?;
    let mut scene = bare.clone();
    scene.shaft = full.shaft;
    add("+ inner ring with mass and load", &scene, Seen::Nothing)?;
    scene.housing = full.housing;
    add("+ outer ring on its support", &scene, Seen::Nothing)?;
    scene.sensors = if full.sensors.is_empty() { vec![Sensor::default()] } else { full.sensors.clone() };
    add("+ accelerometer", &scene, Seen::Nothing)?;
    scene.defects = vec![Defect {
        on: DefectOn::Outer,
        angle: -std::f64::consts::FRAC_PI_2,
        shape: DefectShape::Spall { length: 0.8e-3, depth: 50e-6, edge_slope: std::f64::consts::FRAC_PI_2 },
    }];
    scene.contact.law = ContactLaw::Hertz;
    add("+ spall of 0.8 mm, law hertz", &scene, Seen::Nothing)?;
    for (what, changed) in instead(&scene) {
        add(what, &changed, Seen::Nothing)?;
    }
    scene.contact.law = ContactLaw::Map;
    add("  the same, law map", &scene, Seen::Nothing)?;
    if extent == Extent::Full {
        scene.contact.law = ContactLaw::Love;
        add("  the same, law love", &scene, Seen::Nothing)?;
        scene.contact.law = ContactLaw::Map;
    }
    add("+ all outputs read every 0.1 ms", &scene, Seen::Outputs)?;
    add("+ tangent stiffness read as well", &scene, Seen::Stiffness)?;
    scene.recorder = Some(Recorder { rate: 51_200.0, filter: RecorderFilter::None });
    add("+ recorder at 51.2 kHz, filter none", &scene, Seen::Stiffness)?;
    scene.recorder = Some(Recorder { rate: 51_200.0, filter: RecorderFilter::LinearPhase });
    add("  the same, filter linear-phase", &scene, Seen::Stiffness)?;
    write(&data.join("leaving-out.csv"), &parts)?;
    Ok(parts)
}

/// What a scene with one spall outside may have instead of it, or beside it.
fn instead(scene: &Scene) -> [(&'static str, Scene); 6] {
    let changed = |change: &dyn Fn(&mut Scene)| {
        let mut scene = scene.clone();
        change(&mut scene);
        scene
    };
    [
        ("  on the inner raceway instead", changed(&|scene| scene.defects[0].on = DefectOn::Inner)),
        (
            "  on an element instead",
            changed(&|scene| scene.defects[0].on = DefectOn::Element { element: 0, tilt: 0.0 }),
        ),
        (
            "  on both raceways",
            changed(&|scene| {
                scene.defects.push(Defect { on: DefectOn::Inner, ..scene.defects[0].clone() });
            }),
        ),
        ("  with an outer ring that turns", changed(&|scene| scene.housing_speed = Some(10.0))),
        ("  with a second accelerometer", changed(&|scene| scene.sensors.push(scene.sensors[0].clone()))),
        (
            "  with an irregular cage",
            changed(&|scene| {
                let [spacing, jitter, wander] = CageIrregularity::RECORDED;
                let (count, spacing_angle) = (scene.bearing.element_count, TAU / scene.bearing.element_count as f64);
                let offsets = CageIrregularity::drawn_offsets(count, spacing * spacing_angle, 1);
                let jitter = jitter * spacing_angle;
                scene.cage.irregularity = Some(CageIrregularity { offsets, jitter, wander, seed: 1 });
            }),
        ),
    ]
}

/// What the host reads after each step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Seen {
    Nothing,
    Outputs,
    Stiffness,
}

fn cost(what: &'static str, scene: &Scene, seen: Seen, stop: f64) -> Result<Part> {
    let map = contact_map::of(scene, None, &Project::find())?;
    let mut simulation = Simulation::with_map(scene.clone(), None, map.as_deref())?;
    if scene.shaft.motion == Motion::Host {
        simulation.set_reals(&[simulation.reference("shaft.y")?], &[-12e-6])?;
    }
    let references: Vec<u32> = simulation
        .table()
        .iter()
        .filter(|v| matches!(v.kind, brinell::simulation::interface::table::Kind::Real { .. }))
        .filter(|v| seen == Seen::Stiffness || !v.name.starts_with("shaft.stiffness"))
        .map(|v| v.reference)
        .collect();
    simulation.record_into("memory");
    simulation.initialize(0.0)?;
    let mut values = vec![0.0; references.len()];
    let mut steps = 0;
    let mut lookups = 0;
    let counters: Vec<u32> = simulation
        .table()
        .iter()
        .filter(|v| v.name == "solver.map_lookups" || v.name == "solver.contact_solves")
        .map(|v| v.reference)
        .collect();
    let seconds = fastest(
        || simulation.clone(),
        |run: &mut Simulation| {
            for _ in 0..(stop / STEP).round() as usize {
                run.step(STEP)?;
                if seen != Seen::Nothing {
                    run.reals(&references, &mut values)?;
                }
                run.forget_samples();
            }
            steps = run.step_counts().all;
            let mut counts = vec![0; counters.len()];
            run.integers(&counters, &mut counts)?;
            lookups = counts.iter().sum::<i32>();
            anyhow::Ok(())
        },
    )?;
    Ok(Part {
        what,
        states: simulation.equations().0.layout.count(),
        variables: simulation.table().len(),
        cost: seconds / stop,
        steps: steps as f64 / stop,
        lookups: f64::from(lookups) / stop,
    })
}

fn write(path: &Path, parts: &[Part]) -> Result<()> {
    whole_file::write_with(path, |out| {
        writeln!(out, "what,states,variables,cpu_s_per_s,steps_per_s,contacts_near_defect_per_s")?;
        for part in parts {
            let what = part.what.trim();
            let Part { states, variables, cost, steps, lookups, .. } = part;
            writeln!(out, "\"{what}\",{states},{variables},{cost:.4e},{steps:.4e},{lookups:.4e}")?;
        }
        Ok(())
    })
}
