//! Rotors of ROSS in bearings of ours, in the environment that has ROSS.

use std::path::Path;

use super::common::{self, examples_python};
use super::{ROSS, has_figure, last, run_in};

/// Where ROSS does not run, the module must say so.
fn has_ross() -> bool {
    let has_ross = common::has_ross();
    if !has_ross {
        let script = common::root().join("examples/rotor_ross.py");
        let said = examples_python().run_file(&script, [""; 0]).unwrap_err().to_string();
        assert!(said.contains("ROSS 2 needs Python 3.10"), "{said}");
    }
    has_ross
}

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn a_ross_rotor_shows_the_passage_frequency_of_a_spalled_bearing_with_sidebands_at_shaft_speed() {
    if !has_ross() {
        return;
    }
    let folder = common::folder("example-ross");
    let said = last(&run_in(examples_python(), ROSS, &folder));
    has_figure(folder.join("rotor_ross"));
    let order = said["bpfo_order"].as_f64().unwrap();
    // 9/2 (1 − 7.94/39.32)
    assert!((order - 3.591_302_1).abs() < 1e-6, "{order}");
    let at =
        |bearing: &str, order: f64| said[format!("position_um_{bearing}")][format!("{order:.3}")].as_f64().unwrap();
    // A healthy bearing has the frequency too, by its varying compliance; the full case has a ratio of 34.
    assert!(at("spalled", order) > 10.0 * at("healthy", order), "{said}");
    // Impacts differ from one another, which makes a floor; the full case has sidebands of 11 and 17 times the floor.
    let floor = said["floor_um_spalled"].as_f64().unwrap();
    for side in [-1.0, 1.0] {
        assert!(at("spalled", order + side) > 4.0 * floor, "{side}: {said}");
    }
}

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn rotors_rest_and_run_up_in_our_bearings_as_in_linear_ones_of_ross() {
    if !has_ross() {
        return;
    }
    let folder = common::folder("example-rotors");
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/ross_rotors.py");
    let arguments = [common::root().join("examples"), folder];
    println!("{}", examples_python().run_file(&script, arguments).unwrap_or_else(|error| panic!("{error:#}")));
}
