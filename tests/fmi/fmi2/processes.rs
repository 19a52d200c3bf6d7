//! A state that goes through bytes into another process continues there with the same bits.

use crate::two::{Host, Resources, bits};
use brinell_fmi::fmi2::*;
use std::path::PathBuf;
use std::process::Command;
use std::{env, fs};

const FOLDER: &str = "BRINELL_TEST_STATE";
const STEP: f64 = 2e-6;
const COUNT: u32 = 30;

/// The reals after each of some steps from `from`.
fn run(host: &Host, from: f64) -> String {
    let mut lines = format!("{:x?}\n", bits(&host.all()));
    for n in 0..COUNT {
        assert_eq!(host.step(from + f64::from(n) * STEP, STEP), Status::Ok, "{:?}", host.lines());
        lines += &format!("{:x?}\n", bits(&host.all()));
    }
    lines
}

/// Runs in the other process: takes the state that is in the folder, and leaves what became of it.
#[test]
#[ignore = "started by the tests below, in a process of its own"]
fn child() {
    let Some(folder) = env::var_os(FOLDER).map(PathBuf::from) else {
        println!("skipped: started alone, there is no state to take");
        return;
    };
    let text = fs::read_to_string(folder.join("scene.toml")).unwrap();
    let host = Host::with(Resources::new(&text, None, "resources"), "another process", true);
    let state = host.deserialize(&fs::read(folder.join("state")).unwrap()).unwrap();
    assert_eq!(host.restore(state), Status::Ok, "{:?}", host.lines());
    fs::write(folder.join("result"), run(&host, host.last_time())).unwrap();
}

fn continues_elsewhere(resources: Resources, lead: f64) {
    let host = Host::with(resources, "this process", true);
    host.start();
    // Not along the way that the other process will go.
    let mut time = 0.0;
    for part in [0.4, 0.35, 0.25] {
        assert_eq!(host.step(time, part * lead), Status::Ok, "{:?}", host.lines());
        time += part * lead;
    }
    let lookups = host.get_integers(&[host.reference("solver.rejected_steps")]).unwrap();
    assert!(lookups[0] > 0, "something has happened before the state is taken");
    let folder = host.resources.directory.clone();
    fs::write(folder.join("state"), host.serialize(host.save())).unwrap();
    let expected = run(&host, time);

    let output = Command::new(env::current_exe().unwrap())
        .args(["fmi2::processes::child", "--exact", "--ignored"])
        .env(FOLDER, &folder)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
    assert!(fs::read_to_string(folder.join("result")).unwrap() == expected, "other bits");
}

#[test]
fn a_state_taken_in_an_impact_continues_in_another_process_with_the_same_bits() {
    // 10.2 ms: element 1 strikes the trailing edge of the spall.
    continues_elsewhere(Resources::of("er16k-tb1"), 10.2e-3);
}

#[test]
fn a_state_taken_with_law_love_continues_in_another_process_with_the_same_bits() {
    // Element 1 enters the spall after 5 ms. The start is beside the edge, or the grid would be solved too often for a
    // test.
    let edited = |text: String| {
        let angle = text.lines().find(|line| line.starts_with("initial_angle_deg")).unwrap();
        text.replace(angle, "initial_angle_deg = -98.3").replace("law = \"hertz\"", "law = \"love\"")
    };
    continues_elsewhere(Resources::edited("er16k-tb1", "resources", edited), 3e-4);
}
