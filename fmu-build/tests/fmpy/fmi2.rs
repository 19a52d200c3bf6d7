//! A public importer drives the FMUs: fmpy, through the C interface. The scripts in `tests/python` say what they check.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use brinell::scene::Experiment;
use fmu_build::commands::check;
use fmu_build::package::Model;
use fmu_build::run;
use fmu_build::run::table::Format;
use fmu_build::shared::{Grid, Project, Version};

fn all_fmus(folder: &Path) -> Vec<PathBuf> {
    let names = common::scenes().into_iter().map(|path| path.file_stem().unwrap().to_owned());
    names.map(|name| common::fmu_of(name.to_str().unwrap(), folder)).collect()
}

#[test]
fn validate_fmu_finds_nothing() {
    let fmus = all_fmus(&common::folder("validate"));
    common::python().run("validate.py", fmus).unwrap_or_else(|error| panic!("{error:#}"));
}

#[test]
fn simulate_fmu_runs_every_shipped_scene() {
    common::run_script("simulate.py", all_fmus(&common::folder("simulate")));
}

#[test]
fn an_fmu_in_a_folder_with_spaces_and_umlauts_runs() {
    let folder = common::folder("Wälzlager & Käfig 50 % + mehr");
    common::run_script("odd_folder.py", [common::fmu_of("6205-epps", &folder)]);
}

#[test]
fn a_load_that_changes_each_step_acts_in_each_step() {
    common::run_script("changing_load.py", [common::fmu_of("er16k-tb1", &common::folder("load"))]);
}

#[test]
fn a_shaft_moved_by_the_host_feels_what_a_shaft_moving_itself_feels() {
    let folder = common::folder("hosted");
    let fmus = [common::fmu_of("er16k-tb1", &folder), common::fmu_of("er16k-tb1-hosted-shaft", &folder)];
    common::run_script("hosted_shaft.py", fmus);
}

#[test]
fn a_host_that_steps_by_milliseconds_records_at_51200_hz() {
    let folder = common::folder("recorder");
    let scene = folder.join("recorded.toml");
    let text = fs::read_to_string(common::root().join("scenes/6205-healthy.toml")).unwrap();
    fs::write(&scene, format!("{text}\n[recorder]\nrate_hz = 51200.0\nfilter = \"none\"\n")).unwrap();
    let fmu =
        fmu_build::package::write(&Model::read(&scene).unwrap(), common::library(), Version::Fmi2, &folder).unwrap();
    common::run_script("recorder.py", [fmu]);
}

#[test]
fn a_light_shaft_of_the_host_is_stepped_again_until_both_agree() {
    let folder = common::folder("implicit");
    let fmus = [common::fmu_of("er16k-tb1", &folder), common::fmu_of("er16k-tb1-hosted-shaft", &folder)];
    println!("{}", common::run_script("implicit_coupling.py", fmus));
}

#[test]
fn directional_derivatives_of_every_shipped_fmu_are_central_differences() {
    common::run_script("directional.py", all_fmus(&common::folder("directional")));
}

#[test]
fn two_instances_of_two_scenes_do_not_disturb_each_other() {
    let folder = common::folder("two");
    common::run_script(
        "two_instances.py",
        [common::fmu_of("6205-epps", &folder), common::fmu_of("er16k-tb2", &folder)],
    );
}

#[test]
fn an_fmu_and_a_run_without_a_host_give_equal_bits() {
    let folder = common::folder("bits");
    for name in ["6205-epps", "er16k-tb1"] {
        let step = 1e-5;
        let csv = folder.join(name).with_extension("csv");
        let options = run::Options {
            grid: Grid::new(&Experiment { stop: 0.02, step }, None, None).unwrap(),
            columns: Vec::new(),
            format: Format::Csv,
            profile: None,
            noise: None,
            wav: None,
            figure: false,
            page: false,
            open: false,
        };
        run::command(&Project::find(), common::model(name), &options, &folder).unwrap();
        assert_eq!(fs::read_to_string(&csv).unwrap().lines().count(), 2002, "a header and 2001 points");
        let fmu = common::fmu_of(name, &folder);
        common::run_script("equal_bits.py", [fmu.as_os_str(), csv.as_os_str(), OsStr::new(&step.to_string())]);
    }
}

#[test]
fn the_check_command_passes_an_fmu_of_ours_and_refuses_a_broken_one() {
    let folder = common::folder("check");
    let project = Project::find();
    check::command(&project, &common::fmu_of("6205-epps", &folder), false).unwrap();

    let broken = folder.join("broken.fmu");
    fs::write(&broken, "no zip file").unwrap();
    let refused = format!("{:#}", check::command(&project, &broken, false).unwrap_err());
    assert!(refused.contains("broken.fmu"), "the message names the file: {refused}");
}
