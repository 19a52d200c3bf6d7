//! The notebooks of `examples/notebooks` run, cell after cell, with the Python module that the wheel brings, and what
//! is stored in them came out of these cells.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::fs;
use std::path::{Path, PathBuf};

use fmu_build::shared::{Project, Python};
use serde_json::Value;

const NOTEBOOKS: [&str; 3] = ["bearing.ipynb", "fmu.ipynb", "rotor.ipynb"];
/// What executes them, beside the packages of the examples.
const EXECUTES: &str = "nbclient==0.11.0\nipykernel==7.4.0\n";
/// All that is stored in all of them (bytes).
const LARGEST: u64 = 600_000;

fn path(name: &str) -> PathBuf {
    common::root().join("examples/notebooks").join(name)
}

fn module() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("module")
}

/// Code cells of a notebook: what each is, and what came out of it.
fn cells(name: &str) -> Vec<(String, Vec<Value>)> {
    let notebook: Value = serde_json::from_str(&fs::read_to_string(path(name)).unwrap()).unwrap();
    let code = notebook["cells"].as_array().unwrap().iter().filter(|cell| cell["cell_type"] == "code");
    code.map(|cell| (text(&cell["source"]), cell["outputs"].as_array().unwrap().clone())).collect()
}

/// Lines of a notebook's text.
fn text(lines: &Value) -> String {
    lines.as_array().unwrap().iter().map(|line| line.as_str().unwrap()).collect()
}

/// Runs code in a folder of its own, where it finds the module and the examples, and gives what it prints.
fn run(python: &Python, name: &str, code: &str) -> String {
    let (folder, root) = (common::folder(name), common::root());
    let begin = format!(
        "import os, sys\nfrom pathlib import Path\nroot = Path({root:?})\nos.chdir({folder:?})\n\
         sys.path.insert(0, {:?})\nsys.path.append(str(root / 'examples'))\n",
        module()
    );
    common::run_text(python, &folder, &(begin + code), [""; 0])
}

/// With this program.
fn python() -> Python {
    common::that_builds(common::python().clone())
}

/// Runs the code of a notebook, and then `check`. What is printed must be what the notebook says was printed.
fn runs(python: &Python, name: &str, check: &str) {
    let (mut code, mut printed) = (String::new(), String::new());
    for (source, outputs) in cells(name) {
        code += &format!("{source}\n");
        printed.extend(outputs.iter().filter(|out| out["output_type"] == "stream").map(|out| text(&out["text"])));
    }
    let said = run(python, name, &(code + check));
    assert!(printed.len() > 20 || name == "fmu.ipynb", "{name}: {printed}");
    assert_eq!(said, printed, "{name}: execute it anew");
}

#[test]
fn notebooks_hold_what_came_out_of_them_and_nothing_of_a_machine() {
    let mut bytes = 0;
    for name in NOTEBOOKS {
        bytes += path(name).metadata().unwrap().len();
        let cells = cells(name);
        let all: Vec<&Value> = cells.iter().flat_map(|(_, outputs)| outputs).collect();
        assert!(all.iter().any(|out| out["data"]["image/png"].is_string()), "{name}: no picture");
        for out in all {
            assert!(out["output_type"] != "error" && out["name"] != "stderr", "{name}: {out}");
            let mut words = out.clone();
            words["data"]["image/png"].take();
            let words = words.to_string();
            let root = common::root().to_str().unwrap();
            for of_a_machine in ["/tmp/", "/home/", "/root/", "site-packages", "ipykernel_", root] {
                assert!(!words.contains(of_a_machine), "{name}: {words}");
            }
        }
        let (last, outputs) = cells.last().unwrap();
        assert!(!outputs.is_empty(), "{name}: not executed to its end, {last}");
    }
    assert!(bytes < LARGEST, "{bytes} bytes");
    let there = fs::read_dir(path("")).unwrap().count();
    assert_eq!(there, NOTEBOOKS.len(), "a notebook that no test runs");
}

#[test]
fn names_and_keywords_that_notebooks_use_are_those_of_the_module() {
    let notebooks = NOTEBOOKS.map(path);
    let package = module().join("brinell");
    let said = common::run_script("notebooks/notebook_names.py", [&package].into_iter().chain(&notebooks));
    assert!(said.trim().parse::<usize>().unwrap() >= 8, "{said} calls");
}

/// All, or the one that the environment's `BRINELL_PAGE` names.
#[test]
#[ignore = "executes the notebooks and writes them; needs the environment of the examples, half a gigabyte"]
fn write_the_notebooks() {
    let examples = fs::read_to_string(common::root().join("examples/requirements.txt")).unwrap();
    let python = Python::prepare_from(&Project::find(), "notebooks-python", &(examples + EXECUTES)).unwrap();
    // Pictures as a notebook has them, and the package from its source.
    let inline = "module://matplotlib_inline.backend_inline";
    let python = common::that_builds(python).with_variable("MPLBACKEND", inline).with_variable("PYTHONPATH", module());
    let one = std::env::var("BRINELL_PAGE").ok();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/notebooks/notebook_execute.py");
    let chosen = NOTEBOOKS.into_iter().filter(|name| one.as_ref().is_none_or(|one| one == name)).map(path);
    let words = std::iter::once(common::folder("notebooks")).chain(chosen);
    python.run_file(&script, words).unwrap_or_else(|error| panic!("{error:#}"));
}

#[test]
fn the_notebook_of_a_bearing_finds_its_spall_in_envelope_and_length() {
    // Lines of a spectrum over 0.55 s are 1.8 Hz apart.
    runs(&python(), "bearing.ipynb", BEARING);
}

const BEARING: &str = r#"
assert abs(strongest - ball_pass) < 1.9
assert len(plt.get_fignums()) == 3
assert run.units["sensor.acceleration"] == "m/s2" and run.recording is None
assert report["fault"] == "outer", report
(passage,) = report["recordings"]
# Similarity has no impacts: some are put in.
passage["impacts_deg"] = [1.5, 3.25]
axes = report.plot().axes
assert [axis.get_ylabel() for axis in axes] == ["signal (recording's unit)", "envelope (dB)"], axes
assert {axis.get_xlabel() for axis in axes} == {"travel of the element from the leading edge (degrees)"}, axes
ends = [[line.get_xdata() for line in axis.lines if len(line.get_xdata()) == 2] for axis in axes]
marks = [*passage["edges_deg"], 1.5, 3.25]
assert [[at for at, last in of if at == last] for of in ends] == [marks, marks], (ends, marks)
assert axes[0].get_title("left").startswith("recording.npy: 2."), axes[0].get_title("left")
found = sorted(name for name in os.listdir() if not name.startswith("script-"))
assert found == ["mine.toml", "recording.npy", "scene.schema.json"], found
"#;

#[test]
fn the_notebook_of_an_fmu_steps_it_in_fmpy() {
    // An element in the spall carries nothing, and its strike is felt by those that do.
    let check = "assert str(fmu) == 'er16k-tb1.fmu' and result.size == 1001\n\
                 least = min(result[name][result['time'] > 0.005].min() for name in forces)\n\
                 most, start = (max(pick(result[name]) for name in forces) for pick in (max, lambda f: f[0]))\n\
                 assert least == 0 and most > 1.5 * start, (least, most, start)\n";
    runs(&python(), "fmu.ipynb", check);
}

#[test]
#[ignore = "needs the environment of the examples, half a gigabyte"]
fn the_notebook_of_a_rotor_carries_any_rotor_in_two_bearings() {
    if !common::has_ross() {
        return;
    }
    // The spalled end goes down with each passage, the healthy one hardly: half of a line's width is 1.7 Hz, and lines
    // are 3.3 Hz apart.
    let check = "assert abs(strongest - ball_pass) < 3.4, (strongest, ball_pass)\n\
                 assert len(plt.get_fignums()) == 2 and run.yout.shape == (8001, 54)\n\
                 assert np.ptp(run.at(8)[late, 1]) > 2 * np.ptp(run.at(0)[late, 1])\n";
    runs(common::examples_python(), "rotor.ipynb", check);
}

#[test]
fn what_the_program_refuses_is_an_error_of_the_module_in_its_words() {
    let said = run(&python(), "module", REFUSED);
    assert!(said.starts_with("no-such-scene: neither a file nor a shipped scene"), "{said}");
    assert!(said.contains("stop time -1 s") && said.contains("none.npy"), "{said}");
}

const REFUSED: &str = r#"
import brinell
assert "6205-epps" in brinell.scenes() and len(brinell.scenes()) >= 12
for call in (
    lambda: brinell.run("no-such-scene"),
    lambda: brinell.run("6205-healthy", stop=-1.0),
    lambda: brinell.size("none.npy", "6205-spall-5deg", speed=10, rate=51200),
):
    try:
        call()
    except brinell.BrinellError as error:
        print(error)
    else:
        raise SystemExit("nothing was refused")
"#;

#[test]
fn the_module_hands_on_columns_speed_and_noise_and_tells_all_faults_of_a_scene() {
    let said = run(&python(), "module-run", MODULE);
    assert!(said.contains("handed on"), "{said}");
}

const MODULE: &str = r#"
import warnings
import brinell
import numpy as np

profile = Path("up.csv")
profile.write_text("time_s,speed_hz\n0,10\n0.02,20\n")
names = ["shaft.speed", "sensor.*"]
clean = brinell.run("6205-healthy", columns=names, speed_profile=profile)
assert list(clean) == ["time", "shaft.speed", "sensor.acceleration"], list(clean)
assert clean["time"][-1] == 0.02 or abs(clean["time"][-1] - 0.02) < 1e-12
assert np.allclose(clean["shaft.speed"], 2 * np.pi * (10 + 500 * clean["time"]), rtol=1e-12)
noise = {"speed_profile": profile, "noise_db": 20}
noisy = [brinell.run("6205-healthy", columns=names, **noise, noise_seed=s) for s in (1, 1, 2)]
first, again, other = (run["sensor.acceleration"] for run in noisy)
assert np.array_equal(first, again) and not np.array_equal(first, other)
with warnings.catch_warnings(record=True) as told:
    warnings.simplefilter("always")
    quiet = brinell.run("6205-healthy", stop=1e-4)
    assert not told, told
    for wrong in (lambda: quiet["sensor.accel"], lambda: quiet.plot("sensor.accel")):
        try:
            wrong()
        except KeyError as error:
            assert "did you mean sensor.acceleration?" in str(error) and "'sensor' are sensor" in str(error), error
        else:
            raise AssertionError("there is no such signal")
    assert "sensor.accel" not in quiet and quiet.get("sensor.accel") is None
    text = (root / "scenes/6205-healthy.toml").read_text(encoding="utf-8")
    scene = Path("asked.toml")
    scene.write_text(text.replace("load_n = [0.0, -1500.0]", "load_n = [0.0, -1.5]"), encoding="utf-8")
    assert len(brinell.run(scene, stop=1e-4)["time"]) == len(quiet["time"])
[asked] = told
assert asked.category is brinell.BrinellWarning and asked.filename == __file__, asked
assert "shaft.load_n = -1.5: -1500 N given in kN?" in str(asked.message), asked
scene = Path("bad.toml")
scene.write_text("name = 'bad'\ncolour = 1\n")
try:
    brinell.run(scene)
except brinell.BrinellError as error:
    told = str(error)
    assert "4 faults" in told and "colour is unknown" in told and "[shaft] is missing" in told, told
else:
    raise AssertionError("accepted")
print("handed on")
"#;

#[test]
fn functions_of_the_module_give_what_their_names_say() {
    run(&python(), "module-functions", FUNCTIONS);
}

/// pandas is no package of this environment: where it lacks, `to_pandas` says how to get it.
const FUNCTIONS: &str = r#"
import warnings
import brinell
import numpy as np

assert brinell.__version__
scene = brinell.new("mine", bearing="6206", defect="inner:1.2mm")
assert scene.is_file() and 'on = "inner"' in scene.read_text()
assert 'motion = "host"' in brinell.new("hosted", hosted=True).read_text()
assert "load_n = [0.0, -390.0, 200.0]" in brinell.new("pushed", axial=200.0).read_text()
unnamed = brinell.new(bearing="7205B", axial=500.0)
assert unnamed.name == "7205b-healthy.toml" and ", 500.0]" in unnamed.read_text(), unnamed
(found,) = listed = brinell.catalogue("6205")
assert "<th>bpfo_orders</th>" in listed._repr_html_(), listed._repr_html_()
# Z/2 (1 - D/Dpw) turns of the shaft, with the catalogue's own dimensions.
ratio = found["element_diameter_mm"] / found["pitch_diameter_mm"]
assert abs(found["bpfo_orders"] - found["element_count"] / 2 * (1 - ratio)) < 1e-3, found
table = brinell.stiffness("er16k-tb1-hosted-shaft", load=400)
assert len({column.size for column in table.values()}) == 1
modes = brinell.modes("er16k-tb1-hosted-shaft", load=400)
assert "undamped_frequency_hz" in modes._repr_html_() and "stiffness.free [N/m]" in table._repr_html_()
(axis,) = table.plot().axes
assert (axis.get_xlabel(), axis.get_ylabel()) == ("cage angle from the defect (degrees)", "stiffness (N/µm)"), axis
assert axis.get_ylim()[0] == 0 and all(np.abs(line.get_xdata()).max() > 10 for line in axis.lines), axis.get_ylim()
said = {line.get_label(): line.get_ydata() for line in axis.lines}
assert np.allclose(said["no transverse force"], 1e-6 * table["stiffness.free [N/m]"], rtol=1e-12), said
assert "without defect" in said and not any("stiffness" in name for name in said), said
assert [axis.get_ylabel() for axis in table.plot(["shaft.y", "load.y [N]"]).axes] == ["m", "N"]
figure = modes.plot()
assert [axis.get_xlabel() for axis in figure.axes] == ["cage angle from the defect (degrees)"] * 2
named = [text.get_text() for text in figure.legends[0].get_texts()]
for axis, label, extent, scale in (
    (figure.axes[0], "undamped natural frequency (Hz)", "undamped_frequency_hz", 1),
    (figure.axes[1], "damping ratio (%)", "damping_ratio", 100),
):
    ends = sorted([scale * end for end in line[extent]] for line in modes["lines"])
    drawn = sorted([np.nanmin(line.get_ydata()), np.nanmax(line.get_ydata())] for line in axis.lines)
    assert axis.get_ylabel() == label and np.allclose(drawn, ends, rtol=1e-12) and len(ends) > 4, (drawn, ends)
    rings = [line.get_label() for line in axis.lines if line.get_label()[0].isdigit()]
    assert set(rings) | {"elements"} == set(named) and any("housing.y" in name for name in rings), (rings, named)
dented = brinell.contact("er16k-tb1", on="outer", angle=7.9, force=500, pressure_limit=6)
assert isinstance(dented, dict) and dented["found"]["max_pressure_mpa"] <= 6000.1, dented["found"]
assert "<td>found.max_pressure_mpa</td><td>6000</td>" in dented._repr_html_()
along, across, below = dented.plot().axes
assert [axis.get_ylabel() for axis in (along, across, below)] == ["pressure (MPa)"] * 2 + ["depth (mm)"]
assert along.get_xlabel() == "x, along the raceway (mm)" and across.get_xlabel() == "y, across the raceway (mm)"
assert below.get_xlabel() == "von Mises stress (MPa)"
(x, y), cells = brinell.figures.cells(dented, dented.tables["pressure"])
# Pressures carry the force, to what the solver leaves.
assert abs(cells.sum() * (x[1] - x[0]) * (y[1] - y[0]) - 500) < 0.01, cells.sum()
assert 5900 < along.lines[0].get_ydata().max() < 6000.1, along.lines[0].get_ydata().max()
for axis, half in zip((along, across), dented["hertz"]["half_axes_mm"]):
    where, hertz = axis.lines[1].get_data()
    assert abs(hertz.max() / dented["hertz"]["max_pressure_mpa"] - 1) < 1e-3
    assert abs(where[hertz > 0].max() / half - 1) < 0.01, (where[hertz > 0].max(), half)
assert len(brinell.run(bearing="6206", defect="inner:1.2mm", stop=0.001)["time"]) == 51
run = brinell.run("6205-healthy", stop=0.005)
assert "<table>" in run._repr_html_() and run["time"][-1] == 0.005
assert [axis.get_ylabel() for axis in run.plot(["shaft.y", "shaft.force.y"]).axes] == ["m", "N"]
try:
    import pandas
except ModuleNotFoundError:
    for answer in (run, table, modes):
        try:
            answer.to_pandas()
        except ImportError as error:
            assert "pip install pandas" in str(error), error
        else:
            raise AssertionError("a table without pandas")
else:
    assert run.to_pandas().attrs["units"]["shaft.y"] == "m"
    assert list(table.to_pandas().columns) == list(table)[1:]
    assert len(modes.to_pandas()) == sum(len(one["modes"]) for one in modes["angles"])
    assert list(dented.to_pandas()["contact"]) == ["found", "hertz"]
text = scene.read_text() + "\n[recorder]\nrate_hz = 12800.0\n"
scene.write_text(text)
with warnings.catch_warnings(record=True) as said:
    warnings.simplefilter("always")
    run = brinell.run(scene, stop=0.005, columns="shaft.load.y")
assert run.recording is None
assert [w.category for w in said] == [brinell.BrinellWarning] and "samples nothing" in str(said[0].message), said
assert said[0].filename == __file__
with open("few.toml", "w") as file:
    file.write('scene = "6205-healthy"\nruns = 2\nstop_s = 0.01\nsettle_s = 0.005\n')
with warnings.catch_warnings():
    # That all went well is no warning.
    warnings.simplefilter("error")
    table = brinell.sweep("few.toml", "few", signals="array")
assert table.name == "runs.parquet" and np.load("few/signals.npy").shape == (2, 256, 1)
with open(table, "rb") as file:
    assert file.read(4) == b"PAR1"
try:
    import pandas
    import pyarrow
except ModuleNotFoundError:
    pass
else:
    assert list(table.to_pandas()["run"]) == [0, 1] and "<td>rms_m_s2</td>" in table._repr_html_()
    assert [axis.get_ylabel() for axis in table.plot().axes] == ["rms_m_s2", "kurtosis"]
try:
    brinell.contact("er16k-tb1", on="middle", angle=0.0, force=300.0)
except brinell.BrinellError as error:
    assert "middle" in str(error), error
else:
    raise AssertionError("no body of that name")
try:
    brinell.build("6205-healthy", kind="cs", names="flat", scalars=True)
except brinell.BrinellError as error:
    assert "--scalars is for --fmi 3" in str(error), error
else:
    raise AssertionError("FMI 2.0 has no arrays")
"#;
