//! What users install, as `cargo lab dist` made it: into an empty Python environment, without Rust and without the
//! source in sight. The programs for other machines run under Wine and QEMU and must build the same FMU to the byte.
//!
//! `.ci/platforms wheels` makes what these tests look at.
#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used)]

mod common;
#[path = "common/dist.rs"]
mod dist;
#[path = "common/machines.rs"]
mod machines;
#[path = "common/macos.rs"]
mod macos;

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;

use dist::{made, names};
use fmu_build::platforms::{OLDEST_GLIBC, needed_glibc};
use object::{Architecture, BinaryFormat, Object, macho};
use zip::ZipArchive;

/// All that a command says, which must do what it is told.
#[track_caller]
fn said(command: &mut Command) -> String {
    let said = common::program::done(command);
    said.out + &said.err
}

/// A program on a user's machine, and the empty folder that it stands in.
fn user(name: &str, program: &Path, bin: &Path) -> (PathBuf, Command) {
    let here = common::folder(name);
    let mut command = Command::new(program);
    as_user(&mut command, &here, bin);
    (here, command)
}

/// Lets a command stand in a folder, with nothing but the system and `bin` in its path and an empty home.
fn as_user(command: &mut Command, here: &Path, bin: &Path) {
    let home = common::folder(&format!("{}-home", here.file_name().unwrap().display()));
    let of_the_machine: Vec<_> =
        command.get_envs().map(|(name, value)| (name.to_owned(), value.unwrap().to_owned())).collect();
    command.current_dir(here).env_clear().envs(of_the_machine).env("HOME", home);
    command.env("PATH", std::env::join_paths([bin, Path::new("/usr/bin"), Path::new("/bin")]).unwrap());
    // Where packages come from, and by which certificates.
    let kept = |name: &str| name.starts_with("PIP_") || name.starts_with("SSL_") || name.ends_with("_proxy");
    command.envs(std::env::vars().filter(|(name, _)| kept(name)));
}

/// An environment with the wheel and these of its extras, and its folder of programs.
fn environment(name: &str, extras: &str) -> PathBuf {
    let wheel = made("manylinux_2_17_x86_64.whl");
    let folder = common::folder(name);
    let done = Command::new("python3").args(["-m", "venv"]).arg(&folder).status().unwrap();
    assert!(done.success());
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
    let what = format!("{}[{extras}]", wheel.display());
    said(Command::new(folder.join("bin/python")).args(install).arg(what));
    folder.join("bin")
}

/// Apart, so that the nightly run can leave them to `.ci/platforms`.
mod all_platforms {
    use super::*;

    #[test]
    #[ignore = "needs what `cargo lab dist` makes"]
    fn a_wheel_in_an_empty_environment_builds_drives_and_draws_and_leaves_nothing_else() {
        let bin = environment("wheel-env", "figures");
        let (here, mut demo) = user("wheel-demo", &bin.join("brinell"), &bin);
        assert!(Command::new("which").arg("cargo").env("PATH", "/usr/bin:/bin").status().is_ok_and(|s| !s.success()));
        said(demo.arg("demo"));
        assert_eq!(names(&here), BTreeSet::from(["brinell-demo".to_owned()]));
        let drawn = names(&here.join("brinell-demo"));
        assert!(
            ["6205-epps.fmu", "demo.png", "demo.svg", "events.csv"].iter().all(|&n| drawn.contains(n)),
            "{drawn:?}"
        );
        // The figure in the README is of the same numbers.
        let svg = fs::read_to_string(here.join("brinell-demo/demo.svg")).unwrap();
        assert!(svg.len() > 100_000, "{} bytes", svg.len());

        let (here, mut build) = user("wheel-build", &bin.join("brinell"), &bin);
        let told = said(build.args(["build", "er16k-tb1"]));
        assert_eq!(names(&here), BTreeSet::from(["er16k-tb1.fmu".to_owned()]));
        for platform in ["linux64", "win64", "darwin64", "aarch64-linux"] {
            assert!(told.contains(&format!("{platform}: ")), "{told}");
        }

        let (here, mut python) = user("wheel-module", &bin.join("python"), &bin);
        let code = "import brinell; run = brinell.run('er16k-tb1', stop=0.01); print(run, run['shaft.y'][-1])";
        let told = said(python.args(["-c", code]));
        assert!(told.contains("101 points until 0.0"), "{told}");
        assert_eq!(names(&here), BTreeSet::new());
    }

    #[test]
    #[ignore = "needs what `cargo lab dist` makes; ROSS and what it needs are 1.4 GB"]
    fn a_wheel_with_its_extras_in_an_empty_environment_couples_rotors_of_ross() {
        let bin = environment("wheel-extras", "figures,ross");
        let (here, mut python) = user("wheel-ross", &bin.join("python"), &bin);
        let code = "import brinell.ross, plotly; print('imported', brinell.ross.element.__name__, plotly.__version__)";
        let told = said(python.args(["-c", code]));
        assert!(told.contains("imported element 6."), "{told}");
        assert_eq!(names(&here), BTreeSet::new());
    }

    #[test]
    #[ignore = "needs what `cargo lab dist` makes, Wine and QEMU"]
    fn the_programs_for_windows_and_arm_build_the_fmu_that_the_one_for_linux_builds() {
        let folder = common::folder("archives");
        let unpacked = |end: &str| {
            let archive = made(end);
            let name =
                archive.file_name().unwrap().to_str().unwrap().trim_end_matches(".tar.gz").trim_end_matches(".zip");
            let unpack = "import shutil, sys; shutil.unpack_archive(sys.argv[1], sys.argv[2])";
            let done = Command::new("python3").args(["-c", unpack]).arg(&archive).arg(&folder).status().unwrap();
            assert!(done.success());
            let found = names(&folder.join(name));
            assert!(
                ["LICENSE-MIT", "README.md", "scenes", "third-party-program.txt"].iter().all(|&n| found.contains(n))
            );
            folder.join(name)
        };
        let mut fmus = Vec::new();
        for (end, start) in
            [("-linux64.tar.gz", None), ("-win64.zip", Some("wine")), ("-aarch64-linux.tar.gz", Some("qemu"))]
        {
            let top = unpacked(end);
            let program = top.join(if start == Some("wine") { "brinell.exe" } else { "brinell" });
            let here = common::folder(&format!("archive{end}"));
            let mut command = match start {
                Some("wine") => {
                    machines::bring_what_wine_lacks(&top);
                    machines::wine(&program)
                }
                Some(_) => machines::qemu(&program),
                None => Command::new(&program),
            };
            as_user(&mut command, &here, &top);
            said(command.args(["build", "6205-epps"]));
            assert_eq!(names(&here), BTreeSet::from(["6205-epps.fmu".to_owned()]), "{end}");
            fmus.push((end, fs::read(here.join("6205-epps.fmu")).unwrap()));
        }
        for (end, fmu) in &fmus {
            assert!(*fmu == fmus[0].1, "{end}: another FMU, {} and {} bytes", fmu.len(), fmus[0].1.len());
        }
    }
    #[test]
    #[ignore = "needs what `cargo lab dist` makes"]
    fn every_wheel_has_its_systems_tag_and_program_the_module_and_the_licences() {
        for (processor, kind) in [("x86_64", Architecture::X86_64), ("aarch64", Architecture::Aarch64)] {
            let tags = ["manylinux_2_17", "manylinux2014"].map(|system| format!("py3-none-{system}_{processor}"));
            let program = checked_wheel(&format!("manylinux_2_17_{processor}.whl"), &tags, "brinell");
            let file = object::File::parse(&*program).unwrap();
            assert_eq!((file.format(), file.architecture()), (BinaryFormat::Elf, kind));
            assert!(needed_glibc(&program).unwrap() <= OLDEST_GLIBC, "{:?}", needed_glibc(&program));
        }
        let program = checked_wheel("-win_amd64.whl", &["py3-none-win_amd64".to_owned()], "brinell.exe");
        let file = object::File::parse(&*program).unwrap();
        assert_eq!((file.format(), file.architecture()), (BinaryFormat::Pe, Architecture::X86_64));
        let tags = ["arm64", "universal2", "x86_64"].map(|kind| format!("py3-none-macosx_11_0_{kind}"));
        let program = checked_wheel("macosx_11_0_x86_64.whl", &tags, "brinell");
        let parts = macos::parts(&program);
        macos::check(&parts);
        assert!(parts.iter().all(|part| part.kind == macho::MH_EXECUTE));
    }
}

/// Looks at all of a wheel but its program, which is given.
fn checked_wheel(end: &str, tags: &[String], program: &str) -> Vec<u8> {
    let mut wheel = ZipArchive::new(File::open(made(end)).unwrap()).unwrap();
    let mut read = |name: &str| {
        let mut bytes = Vec::new();
        let mut file = wheel.by_name(name).unwrap_or_else(|error| panic!("{end}: {name}: {error}"));
        file.read_to_end(&mut bytes).unwrap();
        bytes
    };
    let top = concat!("brinell-", env!("CARGO_PKG_VERSION"));
    let text = String::from_utf8(read(&format!("{top}.dist-info/WHEEL"))).unwrap();
    let found: BTreeSet<_> = text.lines().filter_map(|line| line.strip_prefix("Tag: ")).collect();
    assert_eq!(found, tags.iter().map(String::as_str).collect(), "{end}");
    let about = String::from_utf8(read(&format!("{top}.dist-info/METADATA"))).unwrap();
    assert!(about.contains(concat!("\nVersion: ", env!("CARGO_PKG_VERSION"), "\n")), "{about}");
    for file in ["LICENSE-MIT", "LICENSE-APACHE", "fmu-build/assets/third-party-program.txt"] {
        let ours = fs::read(common::root().join(file)).unwrap();
        assert!(read(&format!("{top}.dist-info/licenses/{file}")) == ours, "{end}: {file}");
    }
    for file in ["__init__.py", "figures.py", "host.py", "results.py", "ross.py", "py.typed"] {
        let ours = fs::read(common::root().join("fmu-build/module/brinell").join(file)).unwrap();
        assert!(read(&format!("brinell/{file}")) == ours, "{end}: {file}");
    }
    read(&format!("{top}.data/scripts/{program}"))
}
