//! A public importer drives the FMUs: fmpy, through the C interface. The scripts in `tests/python` say what they check.
#![allow(clippy::unwrap_used)]

use crate::common::program::{brinell, done};
use crate::common::{self, fmu_of, run_script};
use std::fs;
use std::path::PathBuf;

use fmu_build::commands::check;
use fmu_build::package::Model;
use fmu_build::shared::{Project, Version};

#[test]
fn validate_fmu_finds_nothing() {
    common::validate(common::fmus(Version::Fmi2));
}

#[test]
fn simulate_fmu_runs_every_shipped_scene() {
    run_script("steps/simulate.py", common::fmus(Version::Fmi2));
}

#[test]
fn an_fmu_in_a_folder_with_spaces_and_umlauts_runs() {
    let fmu = common::folder("Wälzlager & Käfig 50 % + mehr").join("6205-epps.fmu");
    fs::copy(fmu_of("6205-epps"), &fmu).unwrap();
    run_script("steps/odd_folder.py", [fmu]);
}

#[test]
fn a_load_that_changes_each_step_acts_in_each_step() {
    run_script("steps/changing_load.py", [fmu_of("er16k-tb1")]);
}

#[test]
fn a_shaft_moved_by_the_host_feels_what_a_shaft_moving_itself_feels() {
    run_script("steps/hosted_shaft.py", ["er16k-tb1", "er16k-tb1-hosted-shaft"].map(fmu_of));
}

#[test]
fn a_host_that_steps_by_milliseconds_records_at_51200_hz() {
    let folder = common::folder("recorder");
    let scene = folder.join("recorded.toml");
    let text = common::scene_text("6205-healthy") + "\n[recorder]\nrate_hz = 51200.0\nfilter = \"none\"\n";
    fs::write(&scene, text).unwrap();
    let fmu =
        fmu_build::package::write(&Model::read(&scene).unwrap(), common::library(), Version::Fmi2, &folder).unwrap();
    run_script("steps/recorder.py", [fmu]);
}

#[test]
fn a_light_shaft_of_the_host_is_stepped_again_until_both_agree() {
    println!("{}", run_script("steps/implicit_coupling.py", ["er16k-tb1", "er16k-tb1-hosted-shaft"].map(fmu_of)));
}

#[test]
fn directional_derivatives_of_every_shipped_fmu_are_central_differences() {
    run_script("interface/directional.py", common::fmus(Version::Fmi2));
}

#[test]
fn two_instances_of_two_scenes_do_not_disturb_each_other() {
    run_script("steps/two_instances.py", ["6205-epps", "er16k-tb2"].map(fmu_of));
}

#[test]
fn an_fmu_and_a_run_without_a_host_give_equal_bits() {
    let (folder, step) = (common::folder("bits"), "1e-5");
    let pairs = ["6205-epps", "er16k-tb1"].map(|name| {
        let run = ["run", name, "--stop", "0.02", "--step", step, "--no-figure", "--columns", "*", "-o"];
        done(brinell(&run).arg(&folder));
        let csv = folder.join(name).with_extension("csv");
        assert_eq!(fs::read_to_string(&csv).unwrap().lines().count(), 2002, "a header and 2001 points");
        [fmu_of(name), csv]
    });
    run_script("steps/equal_bits.py", [PathBuf::from(step)].into_iter().chain(pairs.concat()));
}

#[test]
fn the_check_command_passes_an_fmu_of_ours_and_refuses_a_broken_one() {
    let project = Project::find();
    check::command(&project, &fmu_of("6205-epps"), false).unwrap();

    let broken = common::folder("check").join("broken.fmu");
    fs::write(&broken, "no zip file").unwrap();
    let refused = format!("{:#}", check::command(&project, &broken, false).unwrap_err());
    assert!(refused.contains("broken.fmu"), "the message names the file: {refused}");
}
