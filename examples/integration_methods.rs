//! Cost of the explicit, the implicit and the automatically chosen method on every shipped scene and on stiff ones, at one
//! tolerance, with the error of each against the other method at a tolerance 1000 times tighter.
//!
//! Contact laws are those of the scenes; a map is computed first and its time not counted;
//! "law hertz" spares the minutes for it.
//!
//! `cargo run --release --example integration_methods [-- TOLERANCE [PART OF A CASE'S NAME]]`

use brinell::scene::{ContactLaw, Damping, DefectShape, Scene};
use brinell::simulation::{Method, Simulation};
use std::error::Error;
use std::path::Path;
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// Changes a scene.
type Change = fn(&mut Scene);

const CASES: [(&str, &str, f64, Change); 12] = [
    ("6205-healthy", "6205-healthy", 0.05, |_| {}),
    ("6205-epps", "6205-epps", 0.05, |_| {}),
    ("6205-hosted", "6205-hosted", 0.05, |_| {}),
    ("er16k-tb1", "er16k-tb1", 0.05, |_| {}),
    ("er16k-tb2", "er16k-tb2", 0.05, |_| {}),
    ("hosted shaft, law hertz", "er16k-tb1-hosted-shaft", 0.05, |s| s.contact.law = ContactLaw::Hertz),
    ("tb1, law hertz, 10x lighter", "er16k-tb1", 0.02, |s| lighter(s, 0.1)),
    ("tb1, law hertz, 100x lighter", "er16k-tb1", 0.02, |s| lighter(s, 0.01)),
    ("healthy, chi 5 s/m", "6205-healthy", 0.05, |s| s.contact.damping = Damping::HuntCrossley(5.0)),
    ("healthy, 50 kN, chi 0.5", "6205-healthy", 0.02, |s| s.shaft.load = [0.0, -5e4]),
    ("healthy, 50 kN, chi 5", "6205-healthy", 0.02, |s| {
        s.shaft.load = [0.0, -5e4];
        s.contact.damping = Damping::HuntCrossley(5.0);
    }),
    ("healthy, proportional 1e-5 s", "6205-healthy", 0.05, |s| s.contact.damping = Damping::Proportional(1e-5)),
];

fn lighter(scene: &mut Scene, factor: f64) {
    scene.contact.law = ContactLaw::Hertz;
    scene.bearing.element_mass = Some(factor * scene.bearing.mass_of_element());
}

struct Run {
    seconds: f64,
    steps: (u64, u64),
    forces: Vec<[f64; 4]>,
}

fn set_up(scene: Scene) -> Outcome<Simulation> {
    let profile = match scene.defect.as_ref().map(|d| &d.shape) {
        Some(DefectShape::Profile(file)) => Some(std::fs::read_to_string(scenes().join(file))?),
        _ => None,
    };
    Ok(Simulation::new(scene, profile.as_deref())?)
}

fn run(bearing: &Simulation, method: Method, tolerance: f64, stop: f64) -> Outcome<Run> {
    let mut bearing = bearing.clone();
    bearing.set_method(method);
    let reference = |name: &str| bearing.table().iter().position(|v| v.name == name).map(|i| i as u32);
    let names = ["shaft.force.x", "shaft.force.y", "element[1].force.outer", "element[2].force.inner"];
    let references: Vec<u32> = names.iter().filter_map(|n| reference(n)).collect();
    let solver: Vec<u32> = reference("solver.tolerance").into_iter().collect();
    bearing.set_reals(&solver, &[tolerance])?;
    bearing.initialize(0.0)?;
    let step = 1e-4;
    let mut forces = Vec::new();
    let mut seconds = 0.0;
    for _ in 0..(stop / step).round() as usize {
        let before = Instant::now();
        bearing.step(step)?;
        seconds += before.elapsed().as_secs_f64();
        let mut now = [0.0; 4];
        bearing.reals(&references, &mut now)?;
        forces.push(now);
    }
    Ok(Run { seconds: seconds / stop, steps: bearing.step_counts(), forces })
}

/// Root mean square of the difference of all forces over that of the forces.
fn error(run: &Run, reference: &Run) -> f64 {
    let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
        let pairs = run.forces.iter().flatten().zip(reference.forces.iter().flatten());
        pairs.map(|(a, b)| of(*a, *b)).sum()
    };
    (sum(&|a, b| (a - b) * (a - b)) / sum(&|_, b| b * b)).sqrt()
}

fn scenes() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

fn main() -> Outcome<()> {
    let tolerance = std::env::args().nth(1).map_or(Ok(1e-5), |text| text.parse())?;
    let wanted = std::env::args().nth(2).unwrap_or_default();
    println!("tolerance {tolerance:e}; CPU s per simulated s, steps per simulated s, error of forces");
    println!("{:<30}{:>30}{:>30}{:>30}  automatic/better", "", "DP5", "Rodas5P", "automatic (implicit share)");
    for (title, name, stop, change) in CASES.into_iter().filter(|case| case.0.contains(&wanted)) {
        let mut scene = Scene::from_toml(&std::fs::read_to_string(scenes().join(format!("{name}.toml")))?)?;
        change(&mut scene);

        let bearing = set_up(scene)?;
        let runs = [Method::DormandPrince, Method::Rodas, Method::Automatic].map(|method| {
            // The fastest of five: the machine does other things too.
            let mut best: Option<Run> = None;
            for _ in 0..5 {
                let next = run(&bearing, method, tolerance, stop)?;
                if best.as_ref().is_none_or(|b| next.seconds < b.seconds) {
                    best = Some(next);
                }
            }
            best.ok_or_else(|| "no run".into())
        });
        let [explicit, implicit, automatic]: [Outcome<Run>; 3] = runs;
        let (explicit, implicit, automatic) = (explicit?, implicit?, automatic?);
        let reference = run(&bearing, Method::DormandPrince, 1e-3 * tolerance, stop)?;
        let column = |run: &Run| {
            format!("{:8.4} {:9.0} {:8.1e}", run.seconds, run.steps.0 as f64 / stop, error(run, &reference))
        };
        println!(
            "{title:<30}{:>30}{:>30}{:>30} ({:.2})  {:.2}",
            column(&explicit),
            column(&implicit),
            column(&automatic),
            automatic.steps.1 as f64 / automatic.steps.0 as f64,
            automatic.seconds / explicit.seconds.min(implicit.seconds),
        );
    }
    Ok(())
}
