//! Random scenes against the oracle.

mod found;
mod judge;
mod report;

use crate::case::{Case, random};
use crate::draw::{Draw, for_seeds, seeds};
use crate::oracle::Bearing;
use crate::subject::Subject;
use judge::judge;
use report::Tally;
use std::f64::consts::PI;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

/// Judges scenes with these seeds, on so many threads.
fn tally(seeds: std::ops::Range<u64>, threads: usize) -> Tally {
    let next = AtomicU64::new(seeds.start);
    let work = || {
        let mut tally = Tally::default();
        loop {
            let seed = next.fetch_add(1, Ordering::Relaxed);
            if seed >= seeds.end {
                return tally;
            }
            let (kind, case) = random(&mut Draw::new(seed));
            if seeds.end - seeds.start == 1 {
                show(&case);
            }
            tally.add(seed, kind, case.tolerance, judge(&case));
        }
    };
    std::thread::scope(|scope| {
        let handles: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let mut all = Tally::default();
        for handle in handles {
            all.join(handle.join().unwrap());
        }
        all
    })
}

/// A scene that is replayed alone, as files.
fn show(case: &Case) {
    println!("{}{}{:#?}", case.toml(), case.profile().unwrap_or_default(), case.steps);
}

#[test]
fn random_scenes_agree_with_the_oracle() {
    let tally = tally(seeds(30), 1);
    println!("{}", tally.markdown());
    let failed: Vec<String> = tally.failed.iter().map(|(seed, why)| format!("BRINELL_SEED={seed}: {why}")).collect();
    assert!(failed.is_empty(), "{} failed:\n{}", failed.len(), failed.join("\n"));
}

/// `BRINELL_SCENES=10000 cargo test --release --test adversary -- --ignored write` takes some hours.
#[test]
#[ignore = "writes the random scenes' section of docs/stability.md"]
fn write_the_section_of_random_scenes() {
    let seeds = seeds(10_000);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let tally = tally(seeds, threads);
    println!("{:#?}", tally.failed);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (section, page) = (root.join("tests/adversary/scenes.md"), root.join("docs/stability.md"));
    let head = include_str!("scenes/head.md");
    std::fs::write(&section, format!("{head}\n{}", tally.markdown())).unwrap();
    let (text, new) = (std::fs::read_to_string(&page).unwrap(), std::fs::read_to_string(&section).unwrap());
    let title = head.lines().next().unwrap();
    let from = text.find(title).unwrap_or(text.len());
    let to = text[from..].match_indices("\n## ").next().map_or(text.len(), |(at, _)| from + at + 1);
    std::fs::write(&page, format!("{}{new}\n{}", &text[..from], &text[to..])).unwrap();
}

#[test]
fn the_page_holds_the_section() {
    let page = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/stability.md")).unwrap();
    assert!(page.contains(include_str!("scenes.md")), "docs/stability.md does not hold tests/adversary/scenes.md");
}

/// The path that the simulation's elements follow over a scene's defect, at angles all around, is the brute-force envelope.
#[test]
fn random_rigid_paths_are_the_envelope() {
    for_seeds(60, |_, draw| {
        let (_, case) = random(draw);
        let oracle = Bearing::new(&case);
        let Some((envelope, _)) = &oracle.defect else { return Ok(()) };
        let simulation = Subject::new(&case).map_err(|error| error.to_string())?.simulation;
        let Some((near, _)) = &simulation.equations().0.defect else { return Err("no defect".to_owned()) };
        let (knots, rho) = (near.knots(), oracle.rho_0);
        // Around each knot and change, along the defect, and anywhere.
        let ends = knots.iter().chain(&envelope.changes).flat_map(|at| [at - 1e-9, at + 1e-9]);
        let anywhere = (0..500).map(|_| draw.between(-PI, PI));
        let [first, last] = [knots[0], knots[knots.len() - 1]];
        let within = (0..1000).map(|i| first + (last - first) * (f64::from(i) + 0.5) / 1000.0);
        for psi in ends.chain(anywhere).chain(within).filter(|psi| (-PI..=PI).contains(psi)) {
            let cell = knots.partition_point(|&knot| knot <= psi);
            let found = if cell == 0 || cell == knots.len() {
                0.0
            } else {
                -near.approach(cell - 1, 0.0, psi, rho).map_err(|error| error.to_string())?.value
            };
            let expected = envelope.touched(psi).1 - rho;
            // Roundings of the radii, and the polynomials that the path is kept as.
            let (limit, off) = (crate::units::rounding(&oracle), found - expected);
            let kept = envelope.path(envelope.feature(psi), psi).0;
            if !((kept - expected).abs() <= limit && off.abs() <= limit) {
                return Err(format!("path at {psi} is {found:e}, not {expected:e} (kept as {kept:e}): {off:e} off"));
            }
        }
        Ok(())
    });
}
