//! Every shipped scene gives the numbers it gave: 20 ms of each, compared with `tests/golden/<scene>.csv`.
//!
//! A file holds exact counters, one fingerprint of all bits, and for each real output a fingerprint of its own, a
//! tolerance and a sample a millisecond. The fingerprints say whether anything moved, the tolerances whether a signal
//! did: bits may differ in the last places where arithmetic is written in another order, and such a run still agrees
//! within them. Outputs that a file does not name are not compared, so a new variable changes no file.
//!
//! `BLESS=1 cargo test --workspace --test golden` writes the files anew. Read the difference before it is committed:
//! a slower solver (more steps, more rejected ones) is a regression too.
#![allow(clippy::unwrap_used)]

mod runs;
#[path = "../support/mod.rs"]
mod support;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use brinell::scene::{Motion, Scene};
use brinell::simulation::StepCounts;
use brinell::simulation::interface::table::{Causality, Kind};
use runs::{AS_SHIPPED, BY_PATH, STEP, STEPS, ring_motion, scene_of};
use support::{Named, fingerprint};

/// Samples of the file are so many communication steps apart.
const STRIDE: usize = 10;
/// Tolerance of a column per largest value in it. Rounding (1e-16) grows tenfold every 6 ms where elements rattle, to
/// 1e-12; the file prints ten digits. What is larger is another result.
const TOLERANCE: f64 = 1e-9;

/// One run: counters by name, and the samples of each output at every communication point.
struct Run {
    counters: BTreeMap<String, u64>,
    columns: Vec<(String, Vec<f64>)>,
}

/// What a file says of a run.
#[derive(Debug, Default, PartialEq)]
struct Golden {
    counters: BTreeMap<String, u64>,
    fingerprint: u64,
    columns: Vec<Column>,
}

#[derive(Debug, Default, PartialEq)]
struct Column {
    name: String,
    tolerance: f64,
    fingerprint: u64,
    samples: Vec<f64>,
}

fn move_rings(bearing: &mut Named, scene: &Scene, t: f64) {
    for (name, ring) in [("shaft", &scene.shaft), ("housing", &scene.housing)] {
        if ring.motion == Motion::Host {
            for (part, value) in ring_motion(name, t) {
                bearing.set(&format!("{name}.{part}"), value);
            }
        }
    }
}

fn run(name: &str) -> Run {
    let scene =
        if BY_PATH.contains(&name) { support::shipped(name) } else { support::shipped_as_it_is(scene_of(name)) };
    let mut bearing = Named::new(scene.clone());
    let outputs: Vec<(String, u32)> = bearing
        .0
        .table()
        .iter()
        .filter(|v| v.causality == Causality::Output && matches!(v.kind, Kind::Real { .. }))
        .map(|v| (v.name.clone(), v.reference))
        .collect();
    let (names, references): (Vec<_>, Vec<_>) = outputs.into_iter().unzip();
    let mut columns: Vec<(String, Vec<f64>)> = names.into_iter().map(|name| (name, Vec::new())).collect();
    move_rings(&mut bearing, &scene, 0.0);
    bearing.0.initialize(0.0).unwrap();
    let mut row = vec![0.0; references.len()];
    for point in 0..=STEPS {
        bearing.0.reals(&references, &mut row).unwrap();
        for ((_, column), value) in columns.iter_mut().zip(&row) {
            column.push(*value);
        }
        if point < STEPS {
            move_rings(&mut bearing, &scene, point as f64 * STEP);
            bearing.run(STEP, 1);
        }
    }
    let StepCounts { all: steps, implicit } = bearing.0.step_counts();
    let mut counters = BTreeMap::from([("steps".to_owned(), steps), ("implicit".to_owned(), implicit)]);
    for counter in ["rejected_steps", "map_lookups", "contact_solves"] {
        // Which of them there are follows from the contact law.
        let name = format!("solver.{counter}");
        if bearing.0.reference(&name).is_ok() {
            counters.insert(counter.to_owned(), u64::try_from(bearing.count(&name)).unwrap());
        }
    }
    Run { counters, columns }
}

impl Golden {
    fn of(run: &Run) -> Self {
        let columns: Vec<Column> = run
            .columns
            .iter()
            .map(|(name, values)| Column {
                name: name.clone(),
                tolerance: TOLERANCE * values.iter().fold(0.0, |most: f64, value| most.max(value.abs())),
                fingerprint: fingerprint(values.iter().map(|value| value.to_bits())),
                samples: values.iter().step_by(STRIDE).copied().collect(),
            })
            .collect();
        Self {
            counters: run.counters.clone(),
            fingerprint: fingerprint(columns.iter().map(|c| c.fingerprint)),
            columns,
        }
    }

    fn write(&self) -> String {
        let mut text = String::new();
        for (counter, value) in &self.counters {
            writeln!(text, "# {counter} = {value}").unwrap();
        }
        writeln!(text, "# bits = {:016x}", self.fingerprint).unwrap();
        text += &line(self.columns.iter().map(|c| c.name.clone()));
        text += &line(self.columns.iter().map(|c| format!("{:016x}", c.fingerprint)));
        text += &line(self.columns.iter().map(|c| format!("{:.1e}", c.tolerance)));
        for row in 0..self.columns[0].samples.len() {
            text += &line(self.columns.iter().map(|c| format!("{:.10e}", c.samples[row])));
        }
        text
    }

    fn read(text: &str) -> Self {
        let mut golden = Self::default();
        let (head, body): (Vec<&str>, Vec<&str>) = text.lines().partition(|line| line.starts_with('#'));
        for line in head {
            let (name, value) = line.trim_start_matches("# ").split_once(" = ").unwrap();
            if name == "bits" {
                golden.fingerprint = u64::from_str_radix(value, 16).unwrap();
            } else {
                golden.counters.insert(name.to_owned(), value.parse().unwrap());
            }
        }
        let [names, bits, tolerances, samples @ ..] = &body[..] else { panic!("three lines and samples are wanted") };
        golden.columns = names.split(',').map(|name| Column { name: name.to_owned(), ..Column::default() }).collect();
        for (column, bits) in golden.columns.iter_mut().zip(bits.split(',')) {
            column.fingerprint = u64::from_str_radix(bits, 16).unwrap();
        }
        for (column, tolerance) in golden.columns.iter_mut().zip(tolerances.split(',')) {
            column.tolerance = tolerance.parse().unwrap();
        }
        for row in samples {
            for (column, value) in golden.columns.iter_mut().zip(row.split(',')) {
                column.samples.push(value.parse().unwrap());
            }
        }
        golden
    }

    /// All in which a run differs, one line each.
    fn differences(&self, run: &Run) -> Vec<String> {
        let mut found = Vec::new();
        for (counter, &wanted) in &self.counters {
            let now = run.counters[counter];
            if now != wanted {
                found.push(format!("{counter}: {wanted} → {now}"));
            }
        }
        for column in &self.columns {
            let Some((_, values)) = run.columns.iter().find(|(name, _)| *name == column.name) else {
                found.push(format!("{}: is no longer there", column.name));
                continue;
            };
            if fingerprint(values.iter().map(|value| value.to_bits())) == column.fingerprint {
                continue;
            }
            let samples = values.iter().step_by(STRIDE).zip(&column.samples);
            // Printed digits of the file come on top.
            let apart = samples.map(|(now, then)| (now - then).abs() - 1e-10 * then.abs()).fold(0.0, f64::max);
            let verdict = if apart <= column.tolerance { "only bits" } else { "ANOTHER SIGNAL" };
            found.push(format!("{}: {verdict}, {apart:.1e} apart, tolerance {:.1e}", column.name, column.tolerance));
        }
        let named = |name: &str| self.columns.iter().any(|column| column.name == name);
        let bits = run.columns.iter().filter(|(name, _)| named(name));
        let bits = fingerprint(bits.map(|(_, values)| fingerprint(values.iter().map(|value| value.to_bits()))));
        if bits != self.fingerprint {
            found.push(format!("bits: {:016x} → {bits:016x}", self.fingerprint));
        }
        found
    }
}

fn line(cells: impl Iterator<Item = String>) -> String {
    cells.collect::<Vec<_>>().join(",") + "\n"
}

fn file_of(name: &str) -> PathBuf {
    brinell_tests::root().join("tests/golden").join(format!("{name}.csv"))
}

fn compare(name: &str) {
    let run = run(name);
    let file = file_of(name);
    if std::env::var_os("BLESS").is_some() {
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(&file, Golden::of(&run).write()).unwrap();
    }
    let text = fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}; BLESS=1 writes it", file.display()));
    let differences = Golden::read(&text).differences(&run);
    assert!(differences.is_empty(), "{name}:\n{}", differences.join("\n"));
}

/// One test a scene, so that they run side by side and each is named; the list is checked against the folder.
macro_rules! scenes {
    ($($test:ident $name:literal)*) => {
        const SCENES: &[&str] = &[$($name),*];
        $(#[test]
        fn $test() {
            compare($name);
        })*
    };
}

scenes! {
    epps_gives_the_numbers_it_gave "6205-epps"
    healthy_gives_the_numbers_it_gave "6205-healthy"
    combined_load_gives_the_numbers_it_gave "6205-combined"
    preloaded_7205_gives_the_numbers_it_gave "7205-preloaded"
    inner_spall_of_a_7205_gives_the_numbers_it_gave "7205-inner"
    one_of_a_pair_of_7205_gives_the_numbers_it_gave "7205-pair"
    hosted_gives_the_numbers_it_gave "6205-hosted"
    rotor_gives_the_numbers_it_gave "6205-rotor"
    inner_5deg_gives_the_numbers_it_gave "6205-inner-5deg"
    inner_5deg_as_shipped_gives_the_numbers_it_gave "6205-inner-5deg-map"
    inner_5deg_machine_gives_the_numbers_it_gave "6205-inner-5deg-machine"
    irregular_cage_gives_the_numbers_it_gave "6205-irregular-cage"
    spall_5deg_gives_the_numbers_it_gave "6205-spall-5deg"
    spall_5deg_machine_gives_the_numbers_it_gave "6205-spall-5deg-machine"
    two_defects_gives_the_numbers_it_gave "6205-two-defects"
    two_defects_as_shipped_give_the_numbers_they_gave "6205-two-defects-map"
    element_gives_the_numbers_it_gave "er16k-element"
    element_as_shipped_gives_the_numbers_it_gave "er16k-element-map"
    inner_gives_the_numbers_it_gave "er16k-inner"
    inner_as_shipped_gives_the_numbers_it_gave "er16k-inner-map"
    tb1_gives_the_numbers_it_gave "er16k-tb1"
    tb1_damped_gives_the_numbers_it_gave "er16k-tb1-damped"
    tb1_oil_gives_the_numbers_it_gave "er16k-tb1-oil"
    tb1_hosted_shaft_gives_the_numbers_it_gave "er16k-tb1-hosted-shaft"
    tb2_gives_the_numbers_it_gave "er16k-tb2"
    tb2_30um_gives_the_numbers_it_gave "er16k-tb2-30um"
    tb2_compliant_gives_the_numbers_it_gave "er16k-tb2-compliant"
    turning_outer_gives_the_numbers_it_gave "er16k-turning-outer"
    rollers_give_the_numbers_they_gave "nu205-healthy"
    rollers_over_a_spall_give_the_numbers_they_gave "nu205-inner"
    rollers_over_a_spall_as_shipped_give_the_numbers_they_gave "nu205-inner-map"
}

#[test]
fn every_shipped_scene_has_a_golden_run() {
    let folder = brinell_tests::root().join("scenes");
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            let as_shipped = if BY_PATH.contains(&&*name) { name.clone() + AS_SHIPPED } else { name.clone() };
            for name in [name, as_shipped] {
                assert!(SCENES.contains(&name.as_str()), "{name} has no golden run");
            }
        }
    }
}

#[test]
fn a_golden_file_reads_back_as_it_was_written_and_sees_what_moved() {
    let counters = BTreeMap::from([("steps".to_owned(), 7)]);
    let mut run = Run { counters, columns: vec![("a".to_owned(), vec![1.0; 31]), ("b".to_owned(), vec![-2e-6; 31])] };
    let golden = Golden::of(&run);
    assert_eq!(Golden::read(&golden.write()), golden);
    assert_eq!(golden.differences(&run), Vec::<String>::new());
    run.columns[0].1[5] += f64::EPSILON;
    run.columns[1].1[10] *= 1.1;
    run.counters.insert("steps".to_owned(), 8);
    let found = golden.differences(&run);
    assert_eq!(found.len(), 4, "{found:?}");
    assert!(found[0].contains("7 → 8") && found[1].contains("only bits") && found[2].contains("ANOTHER SIGNAL"));
}
