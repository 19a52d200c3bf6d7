//! What the tests of this crate share: the shipped scenes, a compiled library, one Python environment.
#![allow(dead_code, clippy::unwrap_used)] // each test binary uses a part of this

use brinell::scene::model_file;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock};
use std::{env, fs};

use fmu_build::package::{Choice, Library, Model, fmu};
use fmu_build::shared::{Project, Python, Version};

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

/// A shipped scene by name.
pub(crate) fn model(name: &str) -> Model {
    Model::read(&root().join("scenes").join(name).with_extension("toml")).unwrap()
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

/// The FMU of a shipped scene in a folder.
pub(crate) fn fmu_of(name: &str, folder: &Path) -> PathBuf {
    packed(name, Version::Fmi2, folder)
}

/// The FMU of a shipped scene after FMI 3.0 in a folder.
pub(crate) fn fmu3_of(name: &str, folder: &Path) -> PathBuf {
    packed(name, Version::Fmi3, folder)
}

/// The FMU of a shipped scene in a folder, packed once for all tests of a program: that takes a second, most of it for
/// the library.
fn packed(name: &str, version: Version, folder: &Path) -> PathBuf {
    type Packed = BTreeMap<(String, &'static str), Arc<OnceLock<Vec<u8>>>>;
    static PACKED: Mutex<Packed> = Mutex::new(BTreeMap::new());
    let fmu = Arc::clone(PACKED.lock().unwrap().entry((name.to_owned(), version.number())).or_default());
    let bytes = fmu.get_or_init(|| fmu::pack(&model(name), library(), version).unwrap());
    let path = folder.join(name).with_extension("fmu");
    fs::write(&path, bytes).unwrap();
    path
}

/// Names of the shipped scenes.
pub(crate) fn names() -> Vec<String> {
    scenes().iter().map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect()
}

/// Runs a script of `tests/python`; what it says on failure becomes the test's message.
pub(crate) fn run_script<A: AsRef<std::ffi::OsStr>>(script: &str, arguments: impl IntoIterator<Item = A>) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python").join(script);
    python().run_file(&path, arguments).unwrap_or_else(|error| panic!("{error:#}"))
}
