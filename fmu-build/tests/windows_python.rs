//! fmpy in a Python for Windows, under Wine: an FMU there and here, and the wheel for Windows as a user has it.
//!
//! `.ci/platforms` installs what these tests need and runs them.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used)]

mod common;
#[path = "common/dist.rs"]
mod dist;
#[path = "common/machines.rs"]
mod machines;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use common::program::done;
use fmu_build::package::{Choice, Library};
use fmu_build::platforms::Platform;
use fmu_build::shared::{Project, Version};

/// numpy 2 asks for functions of the C library that Wine 8 lacks.
const NUMPY: &str = "numpy==1.26.4";

/// A Python for Windows.
struct WindowsPython {
    folder: PathBuf,
}

impl WindowsPython {
    /// Puts it together with the packages that figures are drawn with, and further ones.
    fn new(name: &str, further: &[PathBuf]) -> Self {
        let folder = common::folder(name);
        let pinned = fs::read_to_string(common::root().join("fmu-build/python/requirements.txt")).unwrap();
        let other = |line: &&str| !["numpy", "scipy", "cmake"].iter().any(|name| line.starts_with(name));
        let mut packages: Vec<_> = pinned.lines().filter(other).map(str::to_owned).collect();
        packages.push(NUMPY.to_owned());
        packages.extend(further.iter().map(|path| path.display().to_string()));
        let list = folder.join("packages.txt");
        fs::write(&list, packages.join("\n")).unwrap();
        common::run_script("windows/windows_python.py", [&folder, &list]);
        let built =
            machines::compiled(Platform::named("win64").unwrap().targets[0], &["--example", "python"]).join("examples");
        fs::copy(built.join("python.exe"), folder.join("python.exe")).unwrap();
        machines::bring_what_wine_lacks(&folder);
        Self { folder }
    }

    fn program(&self) -> PathBuf {
        self.folder.join("python.exe")
    }
}

/// What a command prints.
fn printed(mut command: Command) -> String {
    done(&mut command).out.replace('\r', "")
}

/// Apart, so that the nightly run can leave them to `.ci/platforms`.
mod all_platforms {
    use super::*;

    #[test]
    #[ignore = "compiles the library for Windows and needs Wine"]
    fn fmpy_on_windows_gets_the_bits_that_fmpy_gets_here_of_the_same_fmus() {
        let platforms = vec!["linux64".to_owned(), "win64".to_owned()];
        let library = Library::obtain(&Project::find(), &Choice { file: None, platforms }).unwrap();
        let folder = common::folder("Wälzlager für Windows");
        let scenes = common::names();
        let write =
            |name: &String| fmu_build::package::write(&common::model(name), &library, Version::Fmi2, &folder).unwrap();
        let fmus: Vec<_> = scenes.iter().map(write).collect();
        let here = common::run_script("windows/bits.py", words(&folder.join("here"), &fmus, Path::to_path_buf));

        let python = WindowsPython::new("windows-python", &[]);
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python/windows/bits.py");
        let mut command = machines::wine(&python.program());
        command.env("PYTHONUTF8", "1").arg(machines::on_windows(&script));
        command.args(words(&folder.join("there"), &fmus, |path| machines::on_windows(path).into()));
        let there = printed(command);
        assert!(here.starts_with("linux64\n") && there.starts_with("win64\n"), "{here}{there}");
        assert_eq!(here.lines().count(), 1 + scenes.len(), "{here}");
        for (here, there) in here.lines().zip(there.lines()).skip(1) {
            assert_eq!(here, there);
        }
        assert_eq!(here.len(), there.len() + "linux64".len() - "win64".len());
    }

    #[test]
    #[ignore = "needs what `cargo lab dist` makes, and Wine"]
    fn the_wheel_for_windows_builds_drives_and_draws_and_leaves_nothing_else() {
        let python = WindowsPython::new("windows-wheel", &[dist::made("-win_amd64.whl")]);
        // Where pip puts programs on Windows.
        let scripts = python.folder.join("Scripts");
        fs::rename(python.folder.join("Lib/site-packages/bin"), &scripts).unwrap();
        machines::bring_what_wine_lacks(&scripts);
        let here = common::folder("windows-here");
        let cache = common::folder("windows-cache");
        let start = |program: PathBuf| {
            let mut command = machines::wine(&program);
            command.current_dir(&here).env("LOCALAPPDATA", machines::on_windows(&cache));
            command
        };
        let mut demo = start(scripts.join("brinell.exe"));
        demo.arg("demo");
        let said = printed(demo);
        assert!(said.contains("6205-epps.fmu"), "{said}");
        assert_eq!(dist::names(&here), ["brinell-demo"].map(str::to_owned).into());
        let drawn = dist::names(&here.join("brinell-demo"));
        for file in ["6205-epps.fmu", "demo.png", "demo.svg", "events.csv"] {
            assert!(drawn.contains(file), "{drawn:?}");
        }
        let mut module = start(python.program());
        let code = "import brinell; run = brinell.run('er16k-tb1', stop=0.01); print(run, run['shaft.y'][-1])\n\
                    print(brinell.build('er16k-tb1', 'brinell-demo'))";
        module.args(["-c", code]);
        let said = printed(module);
        assert!(said.contains("101 points until 0.0") && said.contains("er16k-tb1.fmu"), "{said}");
        assert_eq!(dist::names(&here), ["brinell-demo"].map(str::to_owned).into());
    }
}

/// Arguments of `bits.py`, each path in the words of its system.
fn words(folder: &Path, fmus: &[PathBuf], path: impl Fn(&Path) -> PathBuf) -> Vec<PathBuf> {
    let files = fmus.iter().map(|fmu| path(fmu));
    [path(folder), "0.02".into()].into_iter().chain(files).collect()
}
