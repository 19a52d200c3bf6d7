//! What the tests of this crate share: the shipped scenes, a compiled library, one Python environment.
#![allow(dead_code, clippy::unwrap_used)] // each test binary uses a part of this

pub(crate) mod program;

use brinell::scene::model_file;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use std::{env, fs};

use fmu_build::package::{Choice, Library, Model, fmu};
use fmu_build::shared::{Project, Python, Version, whole_file};

/// Root of the workspace.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap()
}

/// All shipped scene files, sorted.
pub(crate) fn scenes() -> Vec<PathBuf> {
    let entries = fs::read_dir(root().join("scenes")).unwrap();
    let mut scenes: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    scenes.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    scenes.sort();
    assert!(scenes.len() >= 6, "six scenes are shipped, found {}", scenes.len());
    scenes
}

/// The file of a shipped scene.
pub(crate) fn scene(name: &str) -> PathBuf {
    root().join("scenes").join(name).with_extension("toml")
}

/// Its text.
pub(crate) fn scene_text(name: &str) -> String {
    fs::read_to_string(scene(name)).unwrap()
}

/// A shipped scene by name.
pub(crate) fn model(name: &str) -> Model {
    Model::read(&scene(name)).unwrap()
}

/// The library that was built along with the tests; in tests built with `--release` the one that FMUs are shipped with.
/// Both are of the same source, the latter optimised as a whole and linked for old systems, which takes a minute.
pub(crate) fn library() -> &'static Library {
    static LIBRARY: OnceLock<Library> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        let choice = Choice { file: built_with_the_tests(), platforms: Vec::new() };
        if choice.file.is_none() {
            // The linker that makes a portable library is in the environment.
            python();
        }
        Library::obtain(&Project::find(), &choice).unwrap()
    })
}

/// The library that was built along with this test, unless the shipped one is to be tested.
pub(crate) fn built_with_the_tests() -> Option<PathBuf> {
    let name = format!("{}brinell_fmi{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    cfg!(debug_assertions).then(|| env::current_exe().unwrap().with_file_name(name))
}

/// The Python environment.
pub(crate) fn python() -> &'static Python {
    static PYTHON: OnceLock<Python> = OnceLock::new();
    PYTHON.get_or_init(|| Python::prepare(&Project::find()).unwrap())
}

/// The environment of all packages that examples need; with `BRINELL_NEWEST_ROSS` that of the newest ROSS which pip
/// finds for this Python, and of what it brings along.
pub(crate) fn examples_python() -> &'static Python {
    static PYTHON: OnceLock<Python> = OnceLock::new();
    PYTHON.get_or_init(|| {
        let (name, requirements) = if env::var_os("BRINELL_NEWEST_ROSS").is_some() {
            ("examples-python-newest", extras().join("\n"))
        } else {
            ("examples-python", fs::read_to_string(root().join("examples/requirements.txt")).unwrap())
        };
        that_builds(Python::prepare_from(&Project::find(), name, &requirements).unwrap())
    })
}

/// What a user gets with `pip install brinell[figures,ross]`.
fn extras() -> Vec<String> {
    let project = fs::read_to_string(root().join("pyproject.toml")).unwrap();
    let project: toml::Table = project.parse().unwrap();
    let extras = project["project"]["optional-dependencies"].as_table().unwrap();
    let listed = ["figures", "ross"].into_iter().flat_map(|name| extras[name].as_array().unwrap());
    listed.map(|package| package.as_str().unwrap().to_owned()).collect()
}

/// Neither ROSS nor the learners that come along with it run on Python 3.9, whatever they say of themselves.
pub(crate) fn has_ross() -> bool {
    static HAS_ROSS: OnceLock<bool> = OnceLock::new();
    let version = "import sys\nprint(sys.version_info >= (3, 10))";
    *HAS_ROSS.get_or_init(|| run_text(examples_python(), &folder("version"), version, [""; 0]).trim() == "True")
}

/// With this build's program and library.
pub(crate) fn that_builds(python: Python) -> Python {
    let program = env!("CARGO_BIN_EXE_brinell");
    let python = python.with_variable("BRINELL_PROGRAM", program).with_variable("BRINELL_FMU", program);
    match built_with_the_tests() {
        Some(library) => python.with_variable("BRINELL_LIBRARY", library),
        None => python,
    }
}

/// Runs a script that is written into a folder; what it says on failure becomes the test's message.
#[track_caller]
pub(crate) fn run_text<A: AsRef<OsStr>>(
    python: &Python,
    folder: &Path,
    text: &str,
    arguments: impl IntoIterator<Item = A>,
) -> String {
    // Tests that run beside each other may write into one folder.
    static WRITTEN: AtomicU32 = AtomicU32::new(0);
    let script = folder.join(format!("script-{}.py", WRITTEN.fetch_add(1, Ordering::Relaxed)));
    fs::write(&script, text).unwrap();
    python.run_file(&script, arguments).unwrap_or_else(|error| panic!("{error:#}"))
}

/// A fresh folder of this name for what a test makes.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// Writes the resources of a scene's FMU into a folder.
pub(crate) fn lay(model: &Model, folder: &Path) {
    fs::create_dir_all(folder).unwrap();
    fs::write(folder.join("scene.toml"), &model.scene_text).unwrap();
    let scene = model_file::encode(&model.scene, &model.scene_text).unwrap();
    fs::write(folder.join("model.bin"), scene).unwrap();
    for profile in &model.profiles {
        fs::write(folder.join(&profile.name), &profile.text).unwrap();
    }
    if let Some(map) = &model.map {
        fs::write(folder.join("map.bin"), map).unwrap();
    }
}

/// The FMU of a shipped scene.
pub(crate) fn fmu_of(name: &str) -> PathBuf {
    fmu(name, Version::Fmi2)
}

/// The FMU of a shipped scene, packed once for all tests of a program: that takes a second, most of it for the library.
pub(crate) fn fmu(name: &str, version: Version) -> PathBuf {
    static PACKED: Mutex<BTreeMap<PathBuf, Arc<OnceLock<()>>>> = Mutex::new(BTreeMap::new());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fmi{}", version.number()));
    let path = folder.join(name).with_extension("fmu");
    let once = Arc::clone(PACKED.lock().unwrap().entry(path.clone()).or_default());
    once.get_or_init(|| {
        fs::create_dir_all(&folder).unwrap();
        // Tests of another program may read the same file.
        whole_file::write(&path, fmu::pack(&model(name), library(), version).unwrap()).unwrap();
    });
    path
}

/// The FMUs of all shipped scenes.
pub(crate) fn fmus(version: Version) -> Vec<PathBuf> {
    names().iter().map(|name| fmu(name, version)).collect()
}

/// Names of the shipped scenes.
pub(crate) fn names() -> Vec<String> {
    scenes().iter().map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect()
}

/// A file of the repository is what a test has written; `BLESS=1` in the environment makes it that.
#[track_caller]
pub(crate) fn is_committed(file: &Path, written: &str) {
    if env::var_os("BLESS").is_some_and(|value| value == "1") {
        fs::create_dir_all(file.parent().unwrap()).unwrap();
        fs::write(file, written).unwrap();
    }
    let committed = fs::read_to_string(file).unwrap_or_default();
    if let Some((line, (new, old))) = (1..).zip(written.lines().zip(committed.lines())).find(|(_, (a, b))| a != b) {
        panic!("{} line {line}:\n  committed {old}\n  now       {new}\nbless it if it is meant", file.display());
    }
    assert!(committed == written, "{} is shorter or longer; bless it if it is meant", file.display());
}

/// Lets fmpy validate FMUs; what it finds becomes the test's message.
#[track_caller]
pub(crate) fn validate(fmus: impl IntoIterator<Item = PathBuf>) {
    run_script("validate.py", fmus);
}

/// Runs a script of `tests/python`; what it says on failure becomes the test's message.
pub(crate) fn run_script<A: AsRef<OsStr>>(script: &str, arguments: impl IntoIterator<Item = A>) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python").join(script);
    python().run_file(&path, arguments).unwrap_or_else(|error| panic!("{error:#}"))
}
