//! A simulation as a Rust program uses it: variables by name, and its start.

use crate::support::differences::reals;
use crate::support::shipped;
use brinell::scene::{Recorder, RecorderFilter, Scene};
use brinell::simulation::Simulation;
use brinell::simulation::interface::table::Kind;

/// A bearing with a spall and a recorder.
fn recording() -> Simulation {
    let recorder = Some(Recorder { rate: 51_200.0, filter: RecorderFilter::None });
    Simulation::new(Scene { recorder, ..shipped("er16k-tb1") }, None).unwrap()
}

fn simulation(scene: &str) -> Simulation {
    Simulation::new(shipped(scene), None).unwrap()
}

#[test]
fn a_variable_that_is_not_real_is_told_with_the_method_to_use() {
    let mut bearing = recording();
    for (name, told) in [
        ("solver.steps", "variable solver.steps is of type Integer: use counts, with its reference"),
        ("contact.law", "variable contact.law is of type Enumeration: use integers, with its reference"),
        ("recorder.folder", "variable recorder.folder is of type String: use strings, with its reference"),
    ] {
        assert_eq!(bearing.get(name).unwrap_err().to_string(), told);
    }
    for (name, told) in [
        ("solver.steps", "variable solver.steps cannot be set: it is computed"),
        ("contact.law", "variable contact.law is of type Enumeration: use set_integers, with its reference"),
        ("recorder.folder", "variable recorder.folder is of type String: use set_strings, with its reference"),
    ] {
        assert_eq!(bearing.set(name, 1.0).unwrap_err().to_string(), told);
    }
}

#[test]
fn an_unknown_name_is_refused_by_name() {
    let error = simulation("er16k-tb1").reference("shaft.laod.y").unwrap_err();
    assert_eq!(error.to_string(), "this model has no variable shaft.laod.y");
}

#[test]
fn large_numbers_are_told_with_their_power_of_ten() {
    let error = simulation("er16k-tb1").set("shaft.load.y", 1e300).unwrap_err();
    assert_eq!(error.to_string(), "variable shaft.load.y: 1e300 is outside -1e9 … 1e9");
}

#[test]
fn a_start_that_is_no_instant_is_refused_and_changes_nothing() {
    for start in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut bearing = simulation("er16k-tb1");
        let error = bearing.initialize(start).unwrap_err();
        assert_eq!(error.to_string(), format!("start time {start} s: it must be finite"));
        assert!(bearing.step(1e-4).is_err() && bearing.time() == 0.0);
        bearing.initialize(2.0).unwrap();
        assert_eq!(bearing.time(), 2.0);
    }
}

#[test]
fn a_second_start_is_as_the_first_but_for_its_inputs() {
    for scene in ["er16k-tb1", "6205-hosted"] {
        let values = |bearing: &mut Simulation| {
            let rows = bearing.table().iter().filter(|row| matches!(row.kind, Kind::Real { .. }));
            let references: Vec<u32> = rows.map(|row| row.reference).collect();
            reals(bearing, &references).into_iter().map(f64::to_bits).collect::<Vec<u64>>()
        };
        let (mut once, mut twice) = (simulation(scene), simulation(scene));
        twice.initialize(0.0).unwrap();
        for _ in 0..5 {
            twice.set("shaft.speed", 70.0).unwrap();
            twice.step(1e-4).unwrap();
        }
        once.set("shaft.speed", 70.0).unwrap();
        once.initialize(3.0).unwrap();
        twice.initialize(3.0).unwrap();
        assert_eq!(values(&mut once), values(&mut twice), "{scene} at the start");
        assert_eq!((twice.time(), twice.step_counts().all), (3.0, 0));
        for bearing in [&mut once, &mut twice] {
            bearing.step(1e-4).unwrap();
        }
        assert_eq!(values(&mut once), values(&mut twice), "{scene} after a step");
    }
}

#[test]
fn lists_of_unequal_lengths_are_refused_and_nothing_is_set_or_read() {
    let mut bearing = recording();
    let [x, y, law, folder, steps] = ["shaft.load.x", "shaft.load.y", "contact.law", "recorder.folder", "solver.steps"]
        .map(|name| bearing.reference(name).unwrap());
    let before = [bearing.get("shaft.load.x").unwrap(), bearing.get("shaft.load.y").unwrap()];
    let told = "2 value references with a list of 1 for them: there must be as many of both";
    assert_eq!(bearing.set_reals(&[x, y], &[1.0]).unwrap_err().to_string(), told);
    assert_eq!(bearing.set_integers(&[law, law], &[1]).unwrap_err().to_string(), told);
    assert_eq!(bearing.set_strings(&[folder, folder], &["here"]).unwrap_err().to_string(), told);
    let (orders, rates) = ([[1].as_slice(), &[1, 1]], [[1.0].as_slice(), &[1.0, 1.0]]);
    for (orders, rates) in [(orders[0], rates[1]), (orders[1], rates[0])] {
        assert_eq!(bearing.set_input_derivatives(&[x, y], orders, rates).unwrap_err().to_string(), told);
    }
    let mut real = [7.0];
    assert_eq!(bearing.reals(&[x, y], &mut real).unwrap_err().to_string(), told);
    assert_eq!(bearing.integers(&[law, law], &mut [7]).unwrap_err().to_string(), told);
    assert_eq!(bearing.counts(&[steps, steps], &mut [7]).unwrap_err().to_string(), told);
    assert_eq!(bearing.set_reals(&[], &[1.0]).unwrap_err().to_string(), told.replace('2', "0"));
    let force = bearing.reference("shaft.force.y").unwrap();
    assert_eq!(bearing.directional_derivative(&[force], &[x, y], &[1.0], &mut real).unwrap_err().to_string(), told);
    assert_eq!(bearing.directional_derivative(&[force; 2], &[x], &[1.0], &mut real).unwrap_err().to_string(), told);
    assert_eq!(bearing.adjoint_derivative(&[force], &[x, y], &[1.0], &mut real).unwrap_err().to_string(), told);
    bearing.initialize(0.0).unwrap();
    assert_eq!(bearing.output_derivatives(&[force; 2], &[1, 1], &mut real).unwrap_err().to_string(), told);
    assert_eq!(real, [7.0]);
    assert_eq!([bearing.get("shaft.load.x").unwrap(), bearing.get("shaft.load.y").unwrap()], before);
    assert_eq!(bearing.strings(&[folder]).unwrap(), [""]);
    // A counter among others of another type: nothing is read either.
    let mut counts = [7, 7];
    assert!(bearing.counts(&[steps, x], &mut counts).is_err() && counts == [7, 7]);
}
