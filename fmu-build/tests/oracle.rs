//! The model against an independent one: `tests/oracle` holds the same equations in Python, written separately, and
//! integrates them with SciPy's DOP853 at a relative tolerance of 1e-12. What it found is stored in `tests/oracle`
//! beside this file, as it takes a minute; an ignored test integrates anew (`BLESS=1` stores that).
#![allow(clippy::unwrap_used)]

mod common;

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};
use std::{env, fs};

use brinell::simulation::Simulation;

/// One element between rings that the host moves.
const ONE_ELEMENT: &str = r#"
name = "one-element"
description = "One element between prescribed rings"
[bearing]
element_count = 1
element_diameter_mm = 7.94
pitch_diameter_mm = 39.32
groove_diameter_mm = 8.19
radial_clearance_um = 5.0
youngs_modulus_gpa = 207.0
poissons_ratio = 0.3
density_kg_m3 = 7800.0
[cage]
initial_angle_deg = -95.0
[shaft]
motion = "host"
speed_hz = 10.0
[housing]
motion = "host"
[solver]
tolerance = 1e-10
"#;

/// Nine elements, the shaft free under 500 N, the housing fixed.
const NINE_ELEMENTS: &str = r#"
name = "nine-elements"
description = "ER16K with a free shaft"
[bearing]
element_count = 9
element_diameter_mm = 7.94
pitch_diameter_mm = 39.32
groove_diameter_mm = 8.19
radial_clearance_um = 5.0
youngs_modulus_gpa = 207.0
poissons_ratio = 0.3
density_kg_m3 = 7800.0
[cage]
initial_angle_deg = -90.0
[shaft]
motion = "internal"
speed_hz = 10.0
load_n = [0.0, -500.0]
mass_kg = 3.2638
damping_n_s_m = 1376.8
stiffness_n_m = 0.0
[housing]
motion = "fixed"
[solver]
tolerance = 1e-10
"#;

/// The same at a tighter tolerance with a defect 100 µm deep, contact law `hertz`; cage angle and defect are put in.
fn with_defect(cage_deg: f64, defect: &str) -> String {
    NINE_ELEMENTS
        .replace("initial_angle_deg = -90.0", &format!("initial_angle_deg = {cage_deg}"))
        .replace("tolerance = 1e-10", "tolerance = 1e-11")
        + &format!("[contact]\nlaw = \"hertz\"\n[defect]\n{defect}\ndepth_um = 100.0\n")
}

/// Element 1 meets them under the load: a short spall of the inner raceway after 5 ms, one of 10° from 5.7 to 10.3 ms,
/// and spalls of its own that face the outer raceway after 5 ms and the inner one after 26 ms. Name, scene, what of it
/// each test looks at (s).
fn defects() -> [(&'static str, String, f64, f64); 4] {
    let on_element = |length: f64| {
        with_defect(-112.1826, &format!("on = \"element\"\nelement = 1\nangle_deg = 42.7519\nlength_mm = {length}"))
    };
    let inner = |cage: f64, rest: &str| with_defect(cage, &format!("on = \"inner\"\n{rest}"));
    [
        ("inner-short", inner(-97.1826, "angle_deg = -108.0\nlength_mm = 0.4"), 0.006, 0.025),
        ("inner-long", inner(-101.492, "angle_deg = -118.8\nlength_deg = 10.0"), 0.0064, 0.02),
        ("element-short", on_element(0.4), 0.006, 0.03),
        ("element-long", on_element(1.2), 0.0048, 0.03),
    ]
}

/// Motion of the rings about one element: start (m), amplitudes (m), frequency (Hz).
const MOTION: [f64; 5] = [0.0, -20e-6, 3e-6, 5e-6, 300.0];

/// What the oracle found: names of the columns and its rows.
struct Reference {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Reference {
    /// What is stored under a name.
    fn stored(name: &str) -> Self {
        Self::read(&stored(name))
    }

    /// Integrates a scene.
    fn run(name: &str, scene: &str, arguments: &[&str]) -> Self {
        let folder = common::folder(&format!("oracle-{name}"));
        let (input, output) = (folder.join("scene.toml"), folder.join("reference.csv"));
        fs::write(&input, scene).unwrap();
        let script = common::root().join("tests/oracle/reference.py");
        let mut all = vec![input.to_str().unwrap().to_owned(), "-o".to_owned(), output.to_str().unwrap().to_owned()];
        all.extend(arguments.iter().map(|&a| a.to_owned()));
        common::python().run_file(&script, all).unwrap_or_else(|error| panic!("{error:#}"));
        let found = Self::read(&output).of_positions();
        if env::var_os("BLESS").is_some() {
            fs::write(stored(name), found.text()).unwrap();
        }
        found
    }

    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let mut lines = text.lines();
        let names = lines.next().unwrap().split(',').map(|name| name.trim().to_owned()).collect();
        let rows = lines.map(|line| line.split(',').map(|v| v.trim().parse().unwrap()).collect()).collect();
        Self { names, rows }
    }

    /// Times, positions of the shaft and paths alone: what is compared.
    fn of_positions(&self) -> Self {
        let is_kept = |name: &str| ["time", "shaft.x", "shaft.y"].contains(&name) || name.ends_with(".path");
        let kept: Vec<usize> = (0..self.names.len()).filter(|&k| is_kept(&self.names[k])).collect();
        Self {
            names: kept.iter().map(|&k| self.names[k].clone()).collect(),
            rows: self.rows.iter().map(|row| kept.iter().map(|&k| row[k]).collect()).collect(),
        }
    }

    fn text(&self) -> String {
        let rows =
            self.rows.iter().map(|row| row.iter().map(|value| format!("{value:e}")).collect::<Vec<_>>().join(","));
        std::iter::once(self.names.join(",")).chain(rows).map(|line| line + "\n").collect()
    }

    fn value(&self, row: usize, name: &str) -> f64 {
        let column = self.names.iter().position(|n| n == name).unwrap_or_else(|| panic!("no {name}"));
        self.rows[row][column]
    }
}

/// Where a reference is stored.
fn stored(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracle").join(name).with_extension("csv")
}

fn reference_of(simulation: &Simulation, name: &str) -> u32 {
    simulation.reference(name).unwrap()
}

fn get(simulation: &mut Simulation, name: &str) -> f64 {
    let mut value = [0.0];
    let reference = reference_of(simulation, name);
    simulation.reals(&[reference], &mut value).unwrap();
    value[0]
}

/// Variables by what they are: paths of elements, positions of a ring.
struct Compared<'n> {
    paths: &'n [&'n str],
    rings: &'n [&'n str],
}

/// Largest differences from the oracle over a run: element path, ring position (m).
fn compare(
    simulation: &mut Simulation,
    reference: &Reference,
    compared: Compared,
    mut advance: impl FnMut(&mut Simulation, f64, f64),
) -> [f64; 2] {
    let mut worst = [0.0f64; 2];
    for row in 0..reference.rows.len() {
        if row > 0 {
            let (from, to) = (reference.value(row - 1, "time"), reference.value(row, "time"));
            advance(simulation, from, to - from);
        }
        for (names, worst) in [compared.paths, compared.rings].into_iter().zip(&mut worst) {
            for name in names {
                *worst = worst.max((get(simulation, name) - reference.value(row, name)).abs());
            }
        }
    }
    worst
}

#[test]
fn one_element_between_prescribed_rings_moves_as_the_oracle_says() {
    let [x0, y0, ax, ay, hz] = MOTION;
    let reference = Reference::stored("one-element");
    let mut simulation = Simulation::new(brinell_scene_file::from_toml(ONE_ELEMENT).unwrap(), None).unwrap();
    let inputs = ["shaft.x", "shaft.y", "shaft.vx", "shaft.vy", "shaft.ax", "shaft.ay"]
        .map(|name| reference_of(&simulation, name));
    let set = |simulation: &mut Simulation, time: f64| {
        let (w, phase) = (TAU * hz, TAU * hz * time);
        let (sin, cos) = phase.sin_cos();
        let values = [x0 + ax * sin, y0 + ay * sin, ax * w * cos, ay * w * cos, -ax * w * w * sin, -ay * w * w * sin];
        simulation.set_reals(&inputs, &values).unwrap();
    };
    set(&mut simulation, 0.0);
    simulation.initialize(0.0).unwrap();
    let compared = Compared { paths: &["element[1].path"], rings: &[] };
    let [path, _] = compare(&mut simulation, &reference, compared, |simulation, from, step| {
        // Within 1 µs the motion is wrong by 1/6 of its third derivative: 6e-15 m.
        let count = 50;
        for i in 0..count {
            set(simulation, from + step * i as f64 / count as f64);
            simulation.step(step / count as f64).unwrap();
        }
    });
    assert!(path < 1e-10, "path differs by {path:e} m");
    println!("one element: path within {path:.1e} m");
}

#[test]
fn nine_elements_and_a_free_shaft_move_as_the_oracle_says() {
    let reference = Reference::stored("nine-elements");
    let mut simulation = Simulation::new(brinell_scene_file::from_toml(NINE_ELEMENTS).unwrap(), None).unwrap();
    simulation.initialize(0.0).unwrap();
    let paths: Vec<String> = (1..=9).map(|j| format!("element[{j}].path")).collect();
    let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
    let compared = Compared { paths: &paths, rings: &["shaft.x", "shaft.y"] };
    let [path, ring] = compare(&mut simulation, &reference, compared, |simulation, _, step| {
        simulation.step(step).unwrap();
    });
    assert!(path < 1e-10, "path differs by {path:e} m");
    assert!(ring < 1e-12, "ring differs by {ring:e} m");
    println!("nine elements: path within {path:.1e} m, ring within {ring:.1e} m");
}

/// Follows the oracle; elements within 1e-10 m and the shaft within 1e-12 m.
fn follows(name: &str, scene: &str, reference: &Reference) {
    let mut simulation = Simulation::new(brinell_scene_file::from_toml(scene).unwrap(), None).unwrap();
    simulation.initialize(0.0).unwrap();
    let paths: Vec<String> = (1..=9).map(|j| format!("element[{j}].path")).collect();
    let paths: Vec<&str> = paths.iter().map(String::as_str).collect();
    let [path, ring] = compare(
        &mut simulation,
        reference,
        Compared { paths: &paths, rings: &["shaft.x", "shaft.y"] },
        |simulation, _, step| {
            simulation.step(step).unwrap();
        },
    );
    println!("{name}: path within {path:.1e} m, ring within {ring:.1e} m");
    assert!(path < 1e-10, "{name}: path differs by {path:e} m");
    assert!(ring < 1e-12, "{name}: ring differs by {ring:e} m");
}

/// The oracle's run of a scene with a defect over so long (s).
fn over(name: &str, scene: &str, stop: f64) -> Reference {
    Reference::run(name, scene, &["--stop", &stop.to_string(), "--step", "1e-4", "--rtol", "1e-12"])
}

#[test]
fn elements_over_defects_of_the_inner_raceway_and_of_a_ball_move_as_the_oracle_says() {
    for (name, scene, ..) in defects() {
        follows(name, &scene, &Reference::stored(name));
    }
}

#[test]
#[ignore = "two minutes of Python"]
fn whole_passages_over_defects_of_the_inner_raceway_and_of_a_ball_are_those_of_the_oracle() {
    for (name, scene, _, long) in defects() {
        let name = format!("{name}-whole");
        follows(&name, &scene, &over(&name, &scene, long));
    }
}

#[test]
#[ignore = "a minute of Python"]
fn what_is_stored_is_what_the_oracle_says() {
    let motion = format!("--shaft-motion={}", MOTION.map(|number| number.to_string()).join(","));
    let one = ["--stop", "0.005", "--step", "5e-5", "--rtol", "1e-12", &motion];
    let nine = ["--stop", "0.02", "--step", "1e-4", "--rtol", "1e-12"];
    let smooth = [("one-element", ONE_ELEMENT, &one[..]), ("nine-elements", NINE_ELEMENTS, &nine)];
    let smooth = smooth.map(|(name, scene, arguments)| (name, Reference::run(name, scene, arguments)));
    let near_defects = defects().map(|(name, scene, short, _)| (name, over(name, &scene, short)));
    for (name, anew) in smooth.iter().chain(&near_defects) {
        let stored = Reference::stored(name);
        assert_eq!((&stored.names, stored.rows.len()), (&anew.names, anew.rows.len()), "{name}");
        for (column, name) in anew.names.iter().enumerate() {
            let pairs = stored.rows.iter().zip(&anew.rows).map(|(stored, anew)| [stored[column], anew[column]]);
            let largest = pairs.clone().fold(0.0f64, |largest, [_, anew]| largest.max(anew.abs()));
            // Equal except for roundings of another machine's arithmetic, which a run amplifies.
            let off = pairs.fold(0.0f64, |off, [stored, anew]| off.max((stored - anew).abs()));
            assert!(off <= 1e-8 * largest, "{name} is off by {off:e} of {largest:e}");
        }
    }
}
