//! How many instructions the library inside an FMU needs for a step. A count has no noise: what makes the library
//! slower is seen however busy the machine is, and a loop that is no longer unrolled costs more than the limit.
//!
//! The library is the one compiled along with the tests, whose model is optimised and whose C interface is not: 2 to
//! 10 % above the one that FMUs are shipped with, and 0.3 % to either side of it where Clippy's driver compiles, as in
//! `.ci/run`. Of tests built with `--release` it is that of FMUs.
//!
//! Counted by Valgrind's callgrind within `fmi2DoStep` and `fmi2GetReal`, which the test program calls itself, started
//! a second time under Valgrind. Valgrind has AVX2 and no AVX-512: the path for registers of four numbers is counted.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]
#![allow(clippy::unwrap_used)]

mod common;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use brinell::simulation::interface::table::{Causality, Kind};
use fmu_build::package::Model;
use host::Instance;

/// Balls on smooth raceways, a spall under a map, rollers. The rollers of `nu205-healthy` are made straight: Valgrind
/// 3.19 lacks an instruction (`vmovq` between registers, opcode D6) that compilers use for the table of crowned ones.
const SCENES: [&str; 3] = ["6205-healthy", "er16k-tb1", "nu205-healthy-straight"];
/// Communication step (s); in so many of them an element enters `er16k-tb1`'s spall and strikes its end.
const STEP: f64 = 1e-4;
const STEPS: usize = 200;
/// By which part the counts may grow: more than a change that was made for another reason should cost.
const LIMIT: f64 = 0.02;
/// The same with another compiler than the counts are of, which arranges code differently.
const LIMIT_OF_ANOTHER_COMPILER: f64 = 0.1;
/// Table of the counts.
const TABLE: &str = if cfg!(debug_assertions) { "tests" } else { "packed" };
/// File name of the library.
const LIBRARY: &str = "counted.so";
/// Names the folder of a scene to the program under Valgrind.
const FOLDER: &str = "BRINELL_COUNTED_FOLDER";
/// What the program under Valgrind says of a processor without AVX2.
const OTHER_PATH: &str = "another path than that of AVX2";
/// What Valgrind says of an instruction that it lacks.
const UNKNOWN: &str = "unhandled instruction";

/// Counts by scene, with the compiler that they are of.
#[derive(Debug, PartialEq)]
struct Counts {
    compiler: String,
    instructions: BTreeMap<String, u64>,
}

impl Counts {
    fn file() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/instructions.toml")
    }

    /// All that is committed.
    fn tables() -> toml::Table {
        fs::read_to_string(Self::file()).unwrap().parse().unwrap()
    }

    fn read() -> Self {
        let mut table = Self::tables().remove(TABLE).unwrap().try_into::<toml::Table>().unwrap();
        let compiler = table.remove("compiler").unwrap().try_into().unwrap();
        let instructions = table.into_iter().map(|(scene, count)| (scene, count.as_integer().unwrap() as u64));
        Self { compiler, instructions: instructions.collect() }
    }

    /// Counts of this source, or why Valgrind cannot take them.
    fn taken() -> Result<Self, &'static str> {
        let folder = common::folder("instructions");
        fs::write(folder.join(LIBRARY), &common::library().binaries()[0].bytes).unwrap();
        let mut instructions = BTreeMap::new();
        for scene in SCENES {
            instructions.insert(scene.to_owned(), counted(scene, &folder.join(scene))?);
        }
        let compiler = Command::new("rustc").arg("-V").current_dir(common::root()).output().unwrap();
        Ok(Self { compiler: String::from_utf8(compiler.stdout).unwrap().trim().to_owned(), instructions })
    }
}

/// A shipped scene, its rollers made straight where its name says so.
fn model(scene: &str) -> Model {
    let Some(shipped) = scene.strip_suffix("-straight") else {
        return common::model(scene);
    };
    let text = common::scene_text(shipped);
    let crowned = |line: &&str| line.starts_with("roller_profile") || line.starts_with("roller_laminae");
    assert_eq!(text.lines().filter(crowned).count(), 2, "{shipped}");
    let straight: Vec<_> = text.lines().filter(|line| !crowned(line)).collect();
    let text = straight.join("\n").replace("[bearing]", "[bearing]\nroller_profile = \"straight\"");
    let file = common::folder("straight").join(format!("{scene}.toml"));
    fs::write(&file, text).unwrap();
    Model::read(&file).unwrap()
}

/// Instructions of a scene's run, whose resources are put into this folder.
fn counted(scene: &str, folder: &Path) -> Result<u64, &'static str> {
    let model = model(scene);
    common::lay(&model, folder);
    let table = model.simulation.table();
    let outputs =
        table.iter().filter(|row| row.causality == Causality::Output && matches!(row.kind, Kind::Real { .. }));
    let outputs: Vec<_> = outputs.map(|row| row.reference.to_string()).collect();
    fs::write(folder.join("guid"), model.guid()).unwrap();
    fs::write(folder.join("outputs"), outputs.join(" ")).unwrap();
    let written = folder.join("callgrind.out");
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--toggle-collect=fmi2DoStep", "--toggle-collect=fmi2GetReal"])
        .arg(format!("--callgrind-out-file={}", written.display()))
        .arg(env::current_exe().unwrap())
        .args(["--ignored", "--exact", "--nocapture", "--test-threads", "1", "instructions_are_as_many_as_counted"])
        .env(FOLDER, folder)
        .output()
        .unwrap_or_else(|error| panic!("valgrind: {error}"));
    let said = String::from_utf8_lossy(&output.stdout) + String::from_utf8_lossy(&output.stderr);
    if let Some(why) = [OTHER_PATH, UNKNOWN].into_iter().find(|why| said.contains(why)) {
        return Err(why);
    }
    assert!(output.status.success(), "{scene}: {said}");
    let text = fs::read_to_string(written).unwrap();
    Ok(text.lines().find_map(|line| line.strip_prefix("totals: ")).unwrap().parse().unwrap())
}

/// What runs under Valgrind.
fn run(folder: &Path) {
    let wide = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
    if !wide || is_x86_feature_detected!("avx512f") {
        println!("{OTHER_PATH}");
        return;
    }
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    let outputs: Vec<u32> = read("outputs").split(' ').map(|reference| reference.parse().unwrap()).collect();
    let mut instance = Instance::new(&folder.with_file_name(LIBRARY), "counted", &read("guid"), folder).unwrap();
    instance.initialize(None).unwrap();
    for step in 0..STEPS {
        instance.step(step as f64 * STEP, STEP).unwrap();
        assert!(instance.reals(&outputs).unwrap().iter().all(|value| value.is_finite()));
    }
}

#[test]
#[ignore = "needs Valgrind"]
fn instructions_are_as_many_as_counted() {
    if let Some(folder) = env::var_os(FOLDER) {
        return run(Path::new(&folder));
    }
    let taken = match Counts::taken() {
        Ok(taken) => taken,
        Err(why) => return println!("left out, under this Valgrind: {why}"),
    };
    let committed = Counts::read();
    let same = taken.compiler == committed.compiler;
    let limit = if same { LIMIT } else { LIMIT_OF_ANOTHER_COMPILER };
    if !same {
        println!("{} in place of {}: {:.0} % more are allowed", taken.compiler, committed.compiler, 100.0 * limit);
    }
    assert!(taken.instructions.keys().eq(committed.instructions.keys()));
    let mut many = Vec::new();
    for (scene, &count) in &taken.instructions {
        let growth = count as f64 / committed.instructions[scene] as f64 - 1.0;
        println!("{scene}: {count} instructions, {:+.2} %", 100.0 * growth);
        if growth > limit {
            many.push(scene);
        } else if growth < -limit {
            println!("{scene}: so few that the count may be written anew");
        }
    }
    assert!(many.is_empty(), "more than {:.0} % more instructions for {many:?}", 100.0 * limit);
}

#[test]
#[ignore = "writes tests/instructions.toml"]
fn write_the_counts() {
    let Counts { compiler, instructions } = Counts::taken().unwrap();
    let mut counts = toml::Table::from_iter([("compiler".to_owned(), compiler.into())]);
    counts.extend(instructions.into_iter().map(|(scene, count)| (scene, (count as i64).into())));
    let mut tables = Counts::tables();
    tables.insert(TABLE.to_owned(), counts.into());
    let text = format!(
        "# Instructions within fmi2DoStep and fmi2GetReal, 200 steps of 1e-4 s, on the path for AVX2: of the library\n\
         # that is packed, and of the one that tests are built with. Written by\n\
         # `cargo test --locked --workspace --test instructions -- --ignored write_the_counts`, the first with\n\
         # `--release` too.\n{}",
        toml::to_string(&tables).unwrap()
    );
    fs::write(Counts::file(), text).unwrap();
}
