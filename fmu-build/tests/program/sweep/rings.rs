//! Passage frequencies and loads of bearings whose outer ring turns, or whose shaft others hold.

use super::*;
use crate::common::program::Table;

/// A 6205 of law `hertz` with a spall of the outer ring, 30 ms.
fn turning(folder: &Path, shaft: f64, housing: f64, more: &str) -> PathBuf {
    let text = format!(
        "scene = \"6205-spall-5deg\"\nruns = 1\nstop_s = 0.25\nsettle_s = 0.05\nrate_hz = 25600\n\
         [set]\ncontact.law = \"hertz\"\ncage.slip = 0.0\nshaft.speed_hz = {shaft:?}\nhousing.speed_hz = {housing:?}\n\
         solver.tolerance = 1e-3\n{more}"
    );
    file(folder, &text)
}

/// What the one run has in a column.
fn number(out: &Path, name: &str) -> Option<f64> {
    let [number] = numbers(out, name)[..] else { panic!("{name} of several runs") };
    number
}

#[test]
fn a_turning_outer_ring_is_passed_at_the_difference_of_the_speeds_and_the_envelope_is_read_there() {
    let folder = common::folder("sweep-rings");
    let run = |name: &str, shaft: f64, housing: f64| {
        let out = folder.join(name);
        let told = sweep(&turning(&folder, shaft, housing, ""), &out, &[]);
        assert!(told.contains(" 0 failed"), "{told}");
        (number(&out, "bpfo_hz").unwrap(), number(&out, "envelope_1_bpfo_m_s2").unwrap())
    };
    // 9/2 (1 − 7.94/39.04) of the 10 Hz between the rings, whoever turns and whither.
    let ratio = 4.5 * (1.0 - 7.94 / 39.04);
    let (standing, line) = run("standing", 10.0, 0.0);
    for (name, shaft, housing) in [("both", 15.0, 5.0), ("outer", 0.0, 10.0), ("back", -10.0, 0.0)] {
        let (bpfo, found) = run(name, shaft, housing);
        // The pitch diameter under clearance.
        assert!((bpfo / (ratio * 10.0) - 1.0).abs() < 1e-3, "{name}: {bpfo}");
        assert!((bpfo / standing - 1.0).abs() < 1e-9, "{name}: {bpfo} {standing}");
        // A defect that turns leaves the load zone: there is a line for all that, far above the 1/50 of another place.
        assert!(found > 0.1 * line, "{name}: {found} of {line}");
    }
}

#[test]
fn a_window_shorter_than_a_passage_has_no_lines() {
    let folder = common::folder("sweep-short-window");
    for (hertz, has) in [(1.0, false), (2.0, true)] {
        // 0.2 s of 3.58 and of 7.17 passages a second.
        let out = folder.join(format!("{hertz}"));
        sweep(&turning(&folder, hertz, 0.0, ""), &out, &[]);
        assert_eq!(number(&out, "envelope_1_bpfo_m_s2").is_some(), has, "{hertz} Hz");
        assert!(number(&out, "bpfo_hz").unwrap() > 3.0 && number(&out, "rms_m_s2").is_some());
    }
}

#[test]
fn the_load_of_a_run_is_what_the_bearing_carries() {
    let folder = common::folder("sweep-carried");
    let load = |name: &str, more: &str| {
        let out = folder.join(name);
        let told = sweep(&turning(&folder, 10.0, 0.0, more), &out, &[]);
        assert!(told.contains(" 0 failed"), "{told}");
        number(&out, "label_load_n").unwrap()
    };
    // What pulls at the housing goes into its feet.
    let housing = "shaft.load_n = [0.0, -100.0]\nhousing.load_n = [0.0, -300.0]\n";
    assert_eq!(load("housing", housing), 100.0);
    // A shaft on a spring shares its load with the bearing: the elements' weight of some grams remains.
    let held = "shaft.load_n = [0.0, -300.0]\nshaft.stiffness_n_m = 1e7\n";
    let found = load("held", held);
    assert!(found > 30.0 && found < 290.0, "{found}");
    // That is its force on the shaft at the start.
    let scene = scene_of(&folder.join("sweep.toml"), &folder.join("none"), "0");
    fs::write(folder.join("held.toml"), scene).unwrap();
    let run = ["run", "held.toml", "--stop", "1e-4", "--step", "1e-4", "--no-figure", "--columns", "shaft.force.*"];
    done(brinell(&run).current_dir(&folder));
    let forces = Table::read(&folder.join("run-0000000.csv"));
    assert_eq!(found, forces.column("shaft.force.x")[0].hypot(forces.column("shaft.force.y")[0]));
}
