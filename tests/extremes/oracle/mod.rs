//! Extremes without a closed form: against equations written separately in Python and integrated by SciPy's DOP853 at
//! 1e-12, whose forces are kept in `oracle.csv` (commit 1df39393 has the program, `tests/oracle`); in space against the
//! oracle of the random scenes.

pub mod in_space;

use crate::row::Row;
use crate::scenes::Kind;
use crate::support::Named;
use brinell::scene::Scene;
use brinell::simulation::Method;
use std::path::PathBuf;

/// Names of the forces that are compared, in the order of `oracle.csv`.
const NAMES: [&str; 5] =
    ["shaft.force.x", "shaft.force.y", "housing.force.y", "element[1].force.outer", "element[2].force.inner"];

struct Oracle {
    /// Number of the communication step, and the forces at its end.
    samples: Vec<(usize, [f64; 5])>,
    /// Its own error over the largest force.
    own_error: f64,
}

/// Runs a case of `cases.toml` as it is, at the default tolerance of 1e-5.
pub fn case(kind: Kind, name: &'static str) -> Row {
    let what = &format!("{}{name}", kind.prefix);
    let case = definition(what);
    let limit = case["limit"].as_float().unwrap();
    let tight = case.get("reference").is_some();
    let oracle = if tight { other_method(&case) } else { oracle(what) };
    let largest = oracle.samples.iter().flat_map(|(_, forces)| forces).fold(0.0f64, |m, f| m.max(f.abs()));

    let mut bearing = Named::new(scene(&case));
    let (mut worst, mut shown) = (0.0f64, (0.0f64, 0.0, ""));
    let found = samples(&mut bearing, &case, &oracle.samples.iter().map(|(step, _)| *step).collect::<Vec<_>>());
    assert_eq!(found.len(), oracle.samples.len(), "{what}: not all of the oracle's instants were reached");
    for (found, (_, expected)) in found.iter().zip(&oracle.samples) {
        for ((name, &expected), &got) in NAMES.iter().zip(expected).zip(found) {
            worst = worst.max((got - expected).abs());
            if expected.abs() > shown.0.abs() {
                shown = (expected, got, name);
            }
        }
    }
    // The oracle must know better than what it judges.
    assert!(oracle.own_error < 0.1 * limit, "{what}: the oracle's own error is {:e}", oracle.own_error);
    assert!(worst <= limit * largest, "{what}: forces differ by {worst:e} N of {largest:e} N");
    let by = if tight { "Rodas5P alone at a tolerance of 1e-7" } else { "oracle" };
    Row::new(name, format!("{by}: `{}` {:.6e} N", shown.2, shown.0), format!("{:.6e} N", shown.1), &bearing)
        .within(worst / largest, limit)
}

/// The compared forces after so many communication steps each, the host doing what the case says.
fn samples(bearing: &mut Named, case: &toml::Table, at: &[usize]) -> Vec<[f64; 5]> {
    let (step, count) = (case["step_s"].as_float().unwrap(), case["steps"].as_integer().unwrap() as usize);
    for (name, value) in case.get("start").and_then(|start| start.as_table()).into_iter().flatten() {
        bearing.set(name, value.as_float().unwrap());
    }
    bearing.0.initialize(0.0).unwrap();
    let mut found = Vec::new();
    for i in 0..count {
        host(bearing, case, i as f64 * step);
        bearing.run(step, 1);
        if at.contains(&(i + 1)) {
            found.push(NAMES.map(|name| bearing.get(name)));
        }
    }
    found
}

/// The implicit method alone at a tolerance 100 times tighter, where the case asks for it instead of the oracle.
fn other_method(case: &toml::Table) -> Oracle {
    let mut scene = scene(case);
    scene.tolerance *= 1e-2;
    let mut bearing = Named::new(scene);
    bearing.0.set_method(Method::Rodas);
    let count = case["steps"].as_integer().unwrap() as usize;
    let at: Vec<usize> = (1..=10).map(|k| k * count / 10).collect();
    let found = samples(&mut bearing, case, &at);
    Oracle { samples: at.into_iter().zip(found).collect(), own_error: 0.0 }
}

/// What the host does before the communication step that begins at `time`.
fn host(bearing: &mut Named, case: &toml::Table, time: f64) {
    if let Some(later) = case.get("later").and_then(|later| later.as_table())
        && time > later["time_s"].as_float().unwrap() - 1e-9
    {
        for (name, value) in later.iter().filter(|(name, _)| *name != "time_s") {
            bearing.set(name, value.as_float().unwrap());
        }
    }
    if let Some(ramp) = case.get("ramp") {
        let speed = bearing.reference("shaft.speed");
        bearing.0.set_input_derivatives(&[speed], &[1], &[ramp.as_float().unwrap()]).unwrap();
    }
    if let Some(load) = case.get("cosine_load").and_then(|load| load.as_array()) {
        let (load, omega) = (load[0].as_float().unwrap(), std::f64::consts::TAU * load[1].as_float().unwrap());
        let reference = bearing.reference("shaft.load.y");
        let (sin, cos) = (omega * time).sin_cos();
        bearing.set("shaft.load.y", load * cos);
        let rates = [-load * omega * sin, -load * omega * omega * cos];
        bearing.0.set_input_derivatives(&[reference, reference], &[1, 2], &rates).unwrap();
    }
}

fn folder() -> PathBuf {
    brinell_tests::root().join("tests/extremes")
}

fn definition(what: &str) -> toml::Table {
    let text = std::fs::read_to_string(folder().join("cases.toml")).unwrap();
    let all: toml::Table = text.parse().unwrap();
    let cases = all["case"].as_array().unwrap();
    let found = cases.iter().find(|case| case["what"].as_str() == Some(what));
    found.unwrap_or_else(|| panic!("no case {what}")).as_table().unwrap().clone()
}

/// The shipped scene with what the case replaces; law `hertz`, which the oracle has.
fn scene(case: &toml::Table) -> Scene {
    let name = case["scene"].as_str().unwrap();
    let path = brinell_tests::root().join(format!("scenes/{name}.toml"));
    let mut scene: toml::Table = std::fs::read_to_string(path).unwrap().parse().unwrap();
    let mut change = |key: &str, value: Option<toml::Value>| {
        let (table, name) = match key.split_once('.') {
            Some((table, name)) => (scene[table].as_table_mut().unwrap(), name),
            None => (&mut scene, key),
        };
        match value {
            Some(value) => _ = table.insert(name.to_owned(), value),
            None => assert!(table.remove(name).is_some(), "{key} is not there to be removed"),
        }
    };
    for key in case.get("remove").and_then(|keys| keys.as_array()).into_iter().flatten() {
        change(key.as_str().unwrap(), None);
    }
    for (key, value) in case.get("set").and_then(|keys| keys.as_table()).into_iter().flatten() {
        change(key, Some(value.clone()));
    }
    change("contact.law", Some("hertz".into()));
    brinell_scene_file::from_toml(&toml::to_string(&scene).unwrap()).unwrap()
}

fn oracle(what: &str) -> Oracle {
    let mut reader = csv::Reader::from_path(folder().join("oracle.csv")).unwrap();
    let names: Vec<&str> = ["what", "step"].into_iter().chain(NAMES).chain(["own_error"]).collect();
    assert_eq!(reader.headers().unwrap(), &names);
    let mut found = Oracle { samples: Vec::new(), own_error: 0.0 };
    for row in reader.records().map(Result::unwrap).filter(|row| &row[0] == what) {
        let values: Vec<f64> = row.iter().skip(1).map(|value| value.parse().unwrap()).collect();
        found.samples.push((values[0] as usize, std::array::from_fn(|i| values[1 + i])));
        found.own_error = values[6];
    }
    assert!(!found.samples.is_empty(), "oracle.csv lacks {what}: give it a `reference`");
    found
}
