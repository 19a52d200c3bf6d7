//! The examples and the pages that name them: every command of theirs runs, on a short case, and its result is looked
//! at.
//! Those that need more than fmpy and matplotlib have a Python environment of their own, made from
//! `examples/requirements.txt`; it has half a gigabyte, and so they run in the nightly part.
#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;
mod rotors;
mod sweeps;

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use fmu_build::package::{Model, write};
use fmu_build::shared::{Python, Version};
use serde_json::Value;

const RIGID: &str = "python examples/step_by_step.py --stop 0.06";
const ROSS: &str = "python examples/rotor_ross.py --stop 1";
const SWEEP: &str = "python examples/sweep.py examples/sweep.toml -o target/labelled";
const SYSTEMS: &str = "python examples/system_of_fmus.py --build";
const SYSTEM: &str = "python examples/system_of_fmus.py --short";
const PAIR: &str = "python examples/pair_of_bearings.py --build";
const PAIRS: &str = "python examples/pair_of_bearings.py --short";
const RUN_UP_SYSTEM: &str = "python examples/run_up.py --build";
const RUN_UP: &str = "python examples/run_up.py --short";
/// What this file's environment or another test does.
const SET_UP: [&str; 6] = [
    "python3 -m venv target/examples-env",
    ". target/examples-env/bin/activate",
    "pip install -r examples/requirements.txt",
    // tests/fmu/reference.rs runs it, with all scenes.
    "brinell build er16k-tb1 --reference",
    "brinell build er16k-tb1 --reference --fmi 3",
    // tests/program/reports/contact.rs runs it, on fewer cells.
    "brinell contact er16k-tb1 --on outer --angle 7.85 --force 300",
];

/// The environment of fmpy and matplotlib, with this build's program and library.
fn python() -> &'static Python {
    static PYTHON: OnceLock<Python> = OnceLock::new();
    PYTHON.get_or_init(|| {
        // Contact maps are computed once and then kept; without this two tests would compute the same one.
        for scene in ["er16k-tb1", "er16k-tb1-hosted-shaft"] {
            common::model(scene);
        }
        common::that_builds(common::python().clone())
    })
}

/// Runs a command of the guide with a folder of its own, and gives what it said.
fn run(command: &str, folder: &Path) -> String {
    run_in(python(), command, folder)
}

fn run_in(python: &Python, command: &str, folder: &Path) -> String {
    let (script, words) = parts(command);
    let words = words.take_while(|&word| word != "-o").map(OsString::from);
    python.run_file(&script, words.chain(["-o".into(), folder.into()])).unwrap_or_else(|error| panic!("{error:#}"))
}

/// The script of a command, and its arguments.
fn parts(command: &str) -> (PathBuf, impl Iterator<Item = &str>) {
    let mut words = command.strip_prefix("python ").unwrap().split(' ');
    (common::root().join(words.next().unwrap()), words)
}

/// The last line that a program said, as JSON.
fn last(said: &str) -> Value {
    serde_json::from_str(said.lines().last().unwrap()).unwrap()
}

/// Rows of numbers in a Markdown table: the first columns' words, and the cells after them.
fn table(text: &str, words: usize) -> Vec<(String, Vec<String>)> {
    let rows = text.lines().filter(|line| line.starts_with("| ")).skip(1);
    let cells =
        rows.map(|line| line.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect::<Vec<_>>());
    cells.map(|cells| (cells[..words].join(" "), cells[words..].to_vec())).collect()
}

fn percent(cell: &str) -> f64 {
    cell.strip_suffix(" %").map_or(f64::INFINITY, |number| number.parse().unwrap_or(f64::INFINITY))
}

fn has_figure(stem: PathBuf) {
    for suffix in ["svg", "png"] {
        let path = stem.with_extension(suffix);
        assert!(path.metadata().is_ok_and(|file| file.len() > 10_000), "{}", path.display());
    }
}

/// SSP files with so many FMUs each.
fn hold_fmus<'a>(systems: impl Iterator<Item = &'a str>, counts: &[usize]) {
    let fmus = systems.map(|system| {
        let archive = zip::ZipArchive::new(fs::File::open(system).unwrap()).unwrap();
        archive.file_names().filter(|name| name.as_ref().unwrap().ends_with(".fmu")).count()
    });
    assert_eq!(fmus.collect::<Vec<_>>(), counts);
}

fn page(name: &str) -> String {
    fs::read_to_string(common::root().join("docs").join(name)).unwrap()
}

/// Blocks of the pages about examples in this language.
fn blocks(language: &str) -> Vec<String> {
    let guide: String = ["hosting", "step", "sensors", "systems", "axial", "run-up", "reference-results"]
        .map(|name| page(&format!("how-to/{name}.md")))
        .concat();
    let fence = format!("```{language}\n");
    let parts = guide.split(&fence).skip(1);
    parts.map(|part| part.split("```").next().unwrap().to_owned()).collect()
}

#[test]
fn every_command_of_the_guide_is_run_here() {
    let known = [RIGID, ROSS, SWEEP, SYSTEMS, SYSTEM, PAIR, PAIRS, RUN_UP_SYSTEM, RUN_UP];
    let commands: Vec<_> =
        blocks("sh").iter().flat_map(|block| block.lines().map(str::to_owned).collect::<Vec<_>>()).collect();
    for command in &commands {
        let command = command.split(" #").next().unwrap().trim();
        assert!(known.contains(&command) || SET_UP.contains(&command), "not run: {command}");
    }
    for command in known {
        assert!(commands.iter().any(|found| found.starts_with(command)), "not in the guide: {command}");
    }
}

#[test]
fn the_code_in_the_guide_runs() {
    let code = blocks("python");
    assert_eq!(code.len(), 1);
    let root = common::root().display().to_string();
    let folder = common::folder("guide");
    let text = code[0]
        .replace("\"examples\"", &format!("{:?}", format!("{root}/examples")))
        .replace("\"target/examples\"", &format!("{:?}", folder.display().to_string()));
    common::run_text(python(), &folder, &text, [""; 0]);
}

#[test]
fn the_host_of_forty_lines_on_its_page_runs_with_a_new_hosted_scene() {
    let folder = common::folder("own-host");
    common::program::done(common::program::brinell(&["new", "mine", "--hosted", "-o"]).arg(&folder));
    let model = Model::read(&folder.join("mine.toml")).unwrap();
    let fmu = write(&model, common::library(), Version::Fmi2, &folder).unwrap();
    let text = page("how-to/own-host.md");
    let code = text.split("```python\n").nth(1).unwrap().split("```").next().unwrap();
    let module = common::root().join("fmu-build/module");
    let code = format!("import sys\n\nsys.path.insert(0, {:?})\n{code}", module.display().to_string());
    let said = common::run_text(python(), &folder, &code, [fmu]);
    // 450 N are carried, but for what the run-up stirs, well below a per cent.
    let force: f64 = said.split(", ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!((force / 450.0 - 1.0).abs() < 0.02, "{said}");
}

#[test]
fn rest_is_found_under_ten_loads_healthy_and_spalled_in_all_degrees_of_freedom() {
    let folder = common::folder("rest");
    let script = common::root().join("fmu-build/tests/python/steps/rest.py");
    let said = python().run_file(&script, [&common::root().join("examples"), &folder]);
    println!("{}", said.unwrap_or_else(|error| panic!("{error:#}")));
}

#[test]
fn an_fmu_bears_its_scenes_name_whatever_its_files_is() {
    let folder = common::folder("example-names");
    fs::copy(common::root().join("scenes/6205-healthy.toml"), folder.join("another.toml")).unwrap();
    let text = "import sys\nsys.path.insert(0, sys.argv[1])\nfrom bearing import build\n\
                [fmu] = build([sys.argv[2] + '/another.toml'], sys.argv[2])\nprint(fmu.name, fmu.is_file())";
    let said = common::run_text(python(), &folder, text, [&common::root().join("examples"), &folder]);
    assert_eq!(said.trim(), "6205-healthy.fmu True");
}

#[cfg(unix)]
#[test]
fn examples_call_the_installed_program_and_cargo_only_where_there_is_none() {
    use std::os::unix::fs::PermissionsExt;
    let folder = common::folder("example-program");
    let text = "import sys\nsys.path.insert(0, sys.argv[1])\nimport bearing\nprint(bearing.program())";
    let said = |python: Python| {
        let python = python.with_variable("PATH", &folder);
        common::run_text(&python, &folder, text, [common::root().join("examples")])
    };
    assert!(said(common::python().clone()).starts_with("['cargo', 'fmu']"));
    let installed = folder.join("brinell");
    fs::write(&installed, "#!/bin/sh\n").unwrap();
    fs::set_permissions(&installed, fs::Permissions::from_mode(0o755)).unwrap();
    assert_eq!(said(common::python().clone()).trim(), format!("['{}']", installed.display()));
    let named = common::python().clone().with_variable("BRINELL_FMU", "mine --quiet");
    assert_eq!(said(named).trim(), "['mine', '--quiet']");
}

#[test]
fn two_bearings_carry_a_rigid_rotor() {
    let folder = common::folder("example-rigid");
    let said = last(&run(RIGID, &folder));
    has_figure(folder.join("step_by_step"));
    // 1000 N and 6 kg, 0.18 m and 0.22 m from the bearings 0.40 m apart. Over two passages the mean of the ringing
    // and of the momentum that the rotor gains is within 5 % of it.
    for (name, share) in [("mean_force_left_n", 0.45), ("mean_force_right_n", 0.55)] {
        let (found, expected) = (said[name].as_f64().unwrap(), share * (1000.0 + 6.0 * 9.81));
        assert!((found / expected - 1.0).abs() < 0.05, "{name}: {found}, expected {expected}");
    }
    assert!(said["largest_sensor_m_s2"].as_f64().unwrap() > 1.0, "the spall is felt: {said}");
}

#[test]
#[ignore = "half a minute; at night"]
fn a_rotor_run_up_moves_alike_by_both_hosts_and_nearly_as_in_linear_bearings() {
    let folder = common::folder("example-run-up");
    hold_fmus(run(&format!("{RUN_UP_SYSTEM} --ssp 2.0"), &folder).lines(), &[2]);
    common::validate([folder.join("disk.fmu")]);
    let said = last(&run(RUN_UP, &folder));
    has_figure(folder.join("run_up"));
    // Over 20 ms at 20 µs: twice what was found.
    assert!(said["ssp_apart"].as_f64().unwrap() < 4e-4, "{said}");
    for axis in ["um_x", "um_y"] {
        let [real, linear] = ["python", "linear"].map(|host| said[host][axis].as_f64().unwrap());
        // A bearing's stiffness varies by some per cent with the cage's angle; 2.4 and 1.3 % were found.
        assert!((real / linear - 1.0).abs() < 0.05, "{axis}: {said}");
    }
    // The disk's 10 kg on the shaft's 2e7 N/m in series with both bearings, of 3.55e7 and 8.90e7 N/m each. Journals, a
    // tenth of it where little moves, are left out.
    for (found, stiffness) in said["modes_hz"].as_array().unwrap().iter().zip([7.1e7, 17.8e7]) {
        let series = 1.0 / (1.0 / 2e7 + 1.0 / stiffness);
        let without_journals = (series / 10.0f64).sqrt() / std::f64::consts::TAU;
        assert!((found.as_f64().unwrap() / without_journals - 1.0).abs() < 0.01, "{found} {without_journals}");
    }
}

#[test]
#[ignore = "half a minute; at night"]
fn a_shaft_in_a_pair_of_bearings_is_as_exact_by_each_host_as_its_page_says() {
    let folder = common::folder("example-pair");
    let said = run(PAIR, &folder);
    // Both bearings, each with its own parameters, and the shaft.
    hold_fmus(said.lines().filter(|line| line.ends_with(".ssp")), &[3; 3]);
    common::validate([folder.join("shaft.fmu")]);
    // Two bearings of 25 degrees closed by 5 µm each hold 9.55e7 N/m at rest; at 50 Hz balls press the inner
    // ring a little less.
    let stiffness: f64 = said.split_once("stiffness: ").unwrap().1.split(' ').next().unwrap().parse().unwrap();
    assert!((stiffness / 9.55e7 - 1.0).abs() < 0.01, "{stiffness:e} N/m");

    let rows = table(&run(PAIRS, &folder), 3);
    assert_eq!(rows.len(), 7);
    let here = page("how-to/axial.md");
    // Steps of 5 µs over the first 2 ms. Limits: twice what was found.
    for (told, limit) in [
        ("plain host tangent stiffness `mean_force`", 0.04),
        ("ours parallel `force`, held", 8.0),
        ("ours parallel `next_mean_force`, held", 0.013),
        ("ours parallel `force` and its derivative", 0.08),
        ("ours sequential `force`, interpolated", 0.04),
        ("ours sequential `mean_force`, held", 0.04),
        ("fmpy parallel, begins with 0 `force`, held", 15.0),
    ] {
        let (_, cells) = rows.iter().find(|(row, _)| row == told).unwrap_or_else(|| panic!("no row {told}"));
        assert!(percent(&cells[0]) < limit, "{told}: {cells:?}");
        let row = here.lines().find(|line| line.trim_matches('|').replace(" | ", " ").trim_start().starts_with(told));
        assert!(row.is_some(), "not in the page: {told}");
    }
}

#[test]
fn a_system_of_bearing_and_rotor_is_as_exact_by_each_algorithm_as_its_page_says() {
    let folder = common::folder("example-system");
    let said = run(SYSTEMS, &folder);
    hold_fmus(said.lines(), &[2; 6]);
    // The rotor is an FMU that any importer can take.
    common::validate([folder.join("rotor.fmu")]);

    let rows = table(&run(SYSTEM, &folder), 5);
    assert_eq!(rows.len(), 18);
    let here = page("how-to/systems.md");
    for bearing in ["healthy", "spalled"] {
        // Steps of 10 µs over the first 5 ms. Limits: twice what was found.
        let found = |told: &str| {
            let words = format!("{bearing} free {told}");
            let (_, cells) = rows.iter().find(|(row, _)| *row == words).unwrap_or_else(|| panic!("no row {words}"));
            percent(&cells[0])
        };
        let (held, derivative) =
            (found("ours parallel `force`, held"), found("ours parallel `force` and its derivative"));
        let (late, mean) = (found("ours parallel `mean_force`, held"), found("ours sequential `mean_force`, held"));
        assert!(held < 4.0 && derivative < 0.07 && mean < 0.03, "{bearing}: {held} %, {derivative} %, {mean} %");
        // What hosts that hold, and hosts that iterate, are to wire.
        let (ahead, repeated) = (
            found("ours parallel `next_mean_force`, held"),
            found("ours iterated `mean_force`, held; the end repeated"),
        );
        assert!(ahead < 0.05 && repeated < 0.05, "{bearing}: {ahead} %, {repeated} %");
        // A force that comes a whole step late instead of half a one.
        assert!(late > 1.8 * held && held > 20.0 * derivative, "{bearing}: {late} %, {held} %, {derivative} %");
        // An input of 0 in the first step.
        assert!(found("fmpy parallel, begins with 0 `force`, held") > 10.0 * held);
    }
    for (words, _) in &rows {
        let told = words.split_once('`').unwrap().1;
        let stands = |line: &&str| line.starts_with(&format!("| {} | ", words.split(' ').next().unwrap()));
        assert!(here.lines().filter(stands).any(|line| line.contains(told)), "not in the page: {words}");
    }
}
