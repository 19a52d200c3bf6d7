//! What a step costs over the number of elements, and a communication step of 10 µs beside it.
//!
//! Elements couple to the rings only, so the cost should be a share of each element and one of the rings: O(Z).
//! Elements are computed eight at a time, which shows below that.

use std::path::Path;

use anyhow::Result;
use brinell::scene::{ContactLaw, Ring, Scene};
use brinell::simulation::{Method, Simulation};

use super::Extent;
use super::integration::scene_file;
use super::machine::fastest;
use fmu_build::package::Model;
use fmu_build::shared::whole_file;

/// Numbers of elements.
const COUNTS: [usize; 10] = [3, 5, 8, 9, 16, 25, 32, 50, 75, 100];
/// Communication step (s), and how many of them.
const STEP: (f64, usize) = (1e-4, 50);

/// Cost at one number of elements.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    pub(super) count: usize,
    /// CPU seconds of an accepted step: explicit, implicit, and explicit with a spall.
    pub(super) seconds: [f64; 3],
}

/// What one communication step of 10 µs costs when the host moves both rings.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hosted {
    pub(super) tolerance: f64,
    /// CPU seconds of a communication step.
    pub(super) seconds: f64,
    /// Integration steps in it.
    pub(super) steps: f64,
}

/// Measures and writes `elements.csv`.
pub(super) fn measure(extent: Extent, data: &Path) -> Result<(Vec<Row>, Vec<Hosted>)> {
    let counts = if extent == Extent::Short { &COUNTS[..3] } else { &COUNTS[..] };
    let mut rows = Vec::new();
    for &count in counts {
        let healthy = with_elements("6205-healthy", count)?;
        let spalled = with_elements("er16k-tb1", count)?;
        let seconds = [
            of_a_step(&healthy, Method::PhaseFitted)?,
            of_a_step(&healthy, Method::Rodas)?,
            of_a_step(&spalled, Method::PhaseFitted)?,
        ];
        rows.push(Row { count, seconds });
    }
    let path = data.join("elements.csv");
    whole_file::write_with(&path, |out| {
        writeln!(out, "elements,explicit_s_per_step,implicit_s_per_step,explicit_with_spall_s_per_step")?;
        for Row { count, seconds: [explicit, implicit, spalled] } in &rows {
            writeln!(out, "{count},{explicit:.4e},{implicit:.4e},{spalled:.4e}")?;
        }
        Ok(())
    })?;
    Ok((rows, [1e-3, 1e-5].into_iter().map(hosted).collect::<Result<_>>()?))
}

/// A shipped scene with another number of elements, on a pitch circle that has room for them and at the same load for
/// each.
fn with_elements(name: &str, count: usize) -> Result<Scene> {
    let mut scene = Model::read(&scene_file(name))?.scene;
    let factor = count as f64 / scene.bearing.element_count as f64;
    scene.bearing.element_count = count;
    scene.bearing.pitch_diameter *= factor.max(1.0);
    scene.shaft.load = scene.shaft.load.map(|load| factor * load);
    scene.contact.law = ContactLaw::Hertz;
    Ok(scene)
}

fn of_a_step(scene: &Scene, method: Method) -> Result<f64> {
    let mut simulation = Simulation::new(scene.clone(), None)?;
    simulation.set_method(method);
    simulation.initialize(0.0)?;
    let mut steps = 0;
    let seconds = fastest(
        || simulation.clone(),
        |run: &mut Simulation| {
            for _ in 0..STEP.1 {
                run.step(STEP.0)?;
            }
            steps = run.step_counts().all;
            anyhow::Ok(())
        },
    )?;
    Ok(seconds / steps as f64)
}

fn hosted(tolerance: f64) -> Result<Hosted> {
    let mut scene = Model::read(&scene_file("6205-healthy"))?.scene;
    for ring in [&mut scene.shaft, &mut scene.housing] {
        *ring = Ring::hosted();
    }
    (scene.sensors, scene.tolerance) = (Vec::new(), tolerance);
    let mut simulation = Simulation::new(scene, None)?;
    let references = [simulation.reference("shaft.y")?, simulation.reference("shaft.vy")?];
    // 20 µm beyond the concentric position, some hundred newtons on the lowest elements.
    let motion = [-20e-6, 0.0];
    simulation.set_reals(&references, &motion)?;
    simulation.initialize(0.0)?;
    let (count, mut steps) = (10_000, 0);
    let seconds = fastest(
        || simulation.clone(),
        |run: &mut Simulation| {
            for _ in 0..count {
                run.set_reals(&references, &motion)?;
                run.step(1e-5)?;
            }
            steps = run.step_counts().all;
            anyhow::Ok(())
        },
    )?;
    Ok(Hosted { tolerance, seconds: seconds / f64::from(count), steps: steps as f64 / f64::from(count) })
}
