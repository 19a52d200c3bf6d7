//! Whole runs under the contact laws, as Markdown: events of one passage, and how far accelerations are apart.
//!
//! `cargo run --release --example contact_laws [-- STOP_S]`, minutes; tables of `docs/evidence/contact.md`. Finer is
//! twice the cells in both directions. Differences are those of the housing's vertical acceleration, sampled at 51.2
//! kHz, from the finer `love`: root mean square and largest, each relative to that run's own. A struck spall is chaotic
//! after some 30 ms; hence the short runs.

use std::error::Error;
use std::time::Instant;

use brinell::scene::{ContactLaw, Scene};
use brinell::simulation::Simulation;

const RATE: f64 = 51_200.0;

struct Run {
    force: Vec<f64>,
    acceleration: Vec<f64>,
    seconds: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let stop: f64 = std::env::args().nth(1).map_or(Ok(0.03), |text| text.parse())?;
    for name in ["er16k-tb1", "6205-epps"] {
        let scene = brinell_scene_file::from_toml(&std::fs::read_to_string(format!("scenes/{name}.toml"))?)?;
        println!("\n`{name}`, {:.0} ms\n", 1e3 * stop);
        println!(
            "| law | unloaded from | loaded again | peak force | its time | rms difference | largest difference | run \
             time |"
        );
        println!("|---|---|---|---|---|---|---|---|");
        let laws = [
            ("love, finer", ContactLaw::Love, true),
            ("love", ContactLaw::Love, false),
            ("map", ContactLaw::Map, false),
            ("hertz", ContactLaw::Hertz, false),
        ];
        let mut reference = None;
        for (label, law, finer) in laws {
            let found = run(&scene, law, finer, stop)?;
            let reference = reference.get_or_insert_with(|| found.acceleration.clone());
            let rms = |x: &mut dyn Iterator<Item = f64>| x.map(|v| v * v).sum::<f64>().sqrt();
            let peak = |x: &mut dyn Iterator<Item = f64>| x.fold(0.0_f64, |m, v| m.max(v.abs()));
            let mut apart = found.acceleration.iter().zip(reference.iter()).map(|(a, b)| a - b);
            let apart: Vec<f64> = apart.by_ref().collect();
            let mean = rms(&mut apart.iter().copied()) / rms(&mut reference.iter().copied());
            let largest = peak(&mut apart.iter().copied()) / peak(&mut reference.iter().copied());
            let ms =
                |index: Option<usize>| index.map_or("–".to_owned(), |k| format!("{:.2} ms", 1e3 * k as f64 / RATE));
            let lost = found.force.iter().position(|&f| f <= 0.0);
            let again = lost.and_then(|from| (from..found.force.len()).find(|&k| found.force[k] > 0.0));
            let after = again.or(lost).unwrap_or(0);
            let highest = (after..found.force.len()).max_by(|&a, &b| found.force[a].total_cmp(&found.force[b]));
            println!(
                "| {label} | {} | {} | {:.0} N | {} | {mean:.1e} | {largest:.1e} | {:.1} s |",
                ms(lost),
                ms(again),
                highest.map_or(f64::NAN, |k| found.force[k]),
                ms(highest),
                found.seconds
            );
        }
    }
    Ok(())
}

fn run(scene: &Scene, law: ContactLaw, finer: bool, stop: f64) -> Result<Run, Box<dyn Error>> {
    let mut scene = scene.clone();
    scene.contact.law = law;
    if finer {
        scene.contact.cells = Some([96, 64]);
    }
    let read = |file: &&str| std::fs::read_to_string(format!("scenes/{file}"));
    let profiles: Vec<String> = scene.profile_names().iter().map(read).collect::<Result<_, _>>()?;
    let mut simulation = Simulation::new(scene, profiles.iter().map(String::as_str))?;
    let references = [simulation.reference("element[1].force.outer")?, simulation.reference("housing.ay")?];
    let start = Instant::now();
    simulation.initialize(0.0)?;
    let mut run = Run { force: Vec::new(), acceleration: Vec::new(), seconds: 0.0 };
    for _ in 0..(stop * RATE) as usize {
        simulation.step(1.0 / RATE)?;
        let mut values = [0.0; 2];
        simulation.reals(&references, &mut values)?;
        run.force.push(values[0]);
        run.acceleration.push(values[1]);
    }
    run.seconds = start.elapsed().as_secs_f64();
    Ok(run)
}
