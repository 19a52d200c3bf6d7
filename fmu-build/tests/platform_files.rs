//! The libraries of all platforms as files: what they export, what they ask of their system, how they are signed, and
//! that they are the same bytes whenever and wherever they are built.
//!
//! `.ci/platforms` installs what these tests need and runs them.
#![allow(clippy::unwrap_used)]

mod common;
#[path = "common/macos.rs"]
mod macos;

use std::process::Command;
use std::sync::OnceLock;

use fmu_build::package::{Binary, Choice, Library, fmu};
use fmu_build::platforms::{OLDEST_GLIBC, needed_glibc};
use fmu_build::shared::{Project, Version};
use object::{LittleEndian, Object, macho};

/// How many functions of each version there are, for co-simulation and for model exchange.
const FUNCTIONS: [(&str, usize); 2] = [("fmi2", 44), ("fmi3", 75)];

fn libraries() -> &'static Library {
    static LIBRARIES: OnceLock<Library> = OnceLock::new();
    LIBRARIES.get_or_init(|| Library::obtain(&Project::find(), &all()).unwrap())
}

fn all() -> Choice {
    Choice { file: None, platforms: vec!["all".to_owned()] }
}

fn binary(platform: &str) -> &'static Binary {
    libraries().binaries().iter().find(|binary| binary.platform.name == platform).unwrap()
}

fn holds(bytes: &[u8], text: &str) -> bool {
    bytes.windows(text.len()).any(|window| window == text.as_bytes())
}

/// Exported names, without the underscore that macOS puts before each.
fn exports(bytes: &[u8]) -> Vec<String> {
    let file = object::File::parse(bytes).unwrap();
    let names = file.exports().unwrap();
    let text = names.map(|export| String::from_utf8_lossy(export.unwrap().name().name().unwrap()).into_owned());
    text.map(|name| name.strip_prefix('_').map_or(name.clone(), str::to_owned)).collect()
}

/// Apart, so that the nightly run can leave them to `.ci/platforms`.
mod all_platforms {
    use super::*;

    #[test]
    #[ignore = "compiles the library for all platforms"]
    fn every_library_exports_the_functions_of_the_standard_and_nothing_else() {
        let whole = libraries().binaries().iter().filter(|binary| binary.platform.name != "darwin64");
        let parts = whole.map(|binary| (binary.platform.name, binary.bytes.as_slice()));
        let macos = macos::parts(&binary("darwin64").bytes);
        let mut seen = 0;
        for (name, bytes) in parts.chain(macos.iter().map(|part| ("darwin64", part.bytes))) {
            let names = exports(bytes);
            for (version, count) in FUNCTIONS {
                assert_eq!(names.iter().filter(|name| name.starts_with(version)).count(), count, "{name}: {names:?}");
            }
            assert!(names.iter().all(|name| name.starts_with("fmi2") || name.starts_with("fmi3")), "{name}: {names:?}");
            seen += 1;
        }
        assert_eq!(seen, 5);
    }

    #[test]
    #[ignore = "compiles the library for all platforms"]
    fn no_library_tells_where_it_was_built() {
        let home = std::env::home_dir().unwrap();
        for binary in libraries().binaries() {
            for path in [common::root().to_str().unwrap(), &format!("{}/.cargo", home.display()), "/target/"] {
                assert!(!holds(&binary.bytes, path), "{}: {path}", binary.platform.name);
            }
        }
    }

    #[test]
    #[ignore = "compiles the library for all platforms"]
    fn linux_libraries_run_with_glibc_2_17_and_without_libgcc() {
        for platform in ["linux64", "aarch64-linux"] {
            let bytes = &binary(platform).bytes;
            assert!(needed_glibc(bytes).unwrap() <= OLDEST_GLIBC, "{platform}: {:?}", needed_glibc(bytes));
            assert!(!holds(bytes, "libgcc_s"), "{platform}");
        }
    }

    #[test]
    #[ignore = "compiles the library for all platforms"]
    fn the_library_of_windows_asks_for_windows_own_libraries_and_bears_no_date() {
        let bytes = binary("win64").bytes.as_slice();
        let file = object::read::pe::PeFile64::parse(bytes).unwrap();
        assert_eq!(file.nt_headers().file_header.time_date_stamp.get(LittleEndian), 0);
        let file = object::File::parse(bytes).unwrap();
        let mut from: Vec<String> = file
            .imports()
            .unwrap()
            .map(|import| String::from_utf8_lossy(import.unwrap().library()).to_lowercase())
            .collect();
        from.sort();
        from.dedup();
        // Windows 10 and later have all of them; none comes with a compiler.
        let known = |name: &String| {
            name.starts_with("api-ms-win-c")
                || ["kernel32.dll", "ntdll.dll", "ws2_32.dll", "userenv.dll", "bcryptprimitives.dll"]
                    .contains(&name.as_str())
        };
        assert!(from.iter().all(known), "{from:?}");
    }

    #[test]
    #[ignore = "compiles the library for all platforms"]
    fn the_file_of_macos_serves_both_processors_from_version_11_on_and_is_signed() {
        let parts = macos::parts(&binary("darwin64").bytes);
        macos::check(&parts);
        for part in parts {
            assert_eq!(part.kind, macho::MH_DYLIB);
            assert_eq!(part.install_name.as_deref(), Some("@rpath/brinell_fmi.dylib"));
        }
    }

    #[test]
    #[ignore = "compiles the library for all platforms"]
    fn an_fmu_with_every_library_and_a_map_takes_less_than_9_megabytes() {
        let model = common::model("6205-epps");
        assert!(model.map.is_some());
        let bytes = fmu::pack(&model, libraries(), Version::Fmi2).unwrap();
        for line in libraries().describe() {
            println!("{line}");
        }
        println!("FMU: {} bytes", bytes.len());
        assert!(bytes.len() < 9_000_000, "{} bytes", bytes.len());
        let file = common::folder("all-platforms").join("6205-epps.fmu");
        std::fs::write(&file, bytes).unwrap();
        fmu_build::commands::check::command(&Project::find(), &file, false).unwrap();
    }

    #[test]
    #[ignore = "compiles the library for all platforms in another folder, for ten minutes"]
    fn all_libraries_built_in_two_folders_have_equal_bytes() {
        let copy = common::folder("second-build");
        for part in [
            "Cargo.toml",
            "Cargo.lock",
            ".cargo",
            "crates",
            "src",
            "laboratory",
            "tests",
            "examples",
            "fmu-build",
            "scenes",
        ] {
            let status = Command::new("cp").arg("-r").arg(common::root().join(part)).arg(&copy).status().unwrap();
            assert!(status.success(), "{part}");
        }
        for file in ["LICENSE-MIT", "LICENSE-APACHE", "README.md"] {
            std::fs::copy(common::root().join(file), copy.join(file)).unwrap();
        }
        let second = Library::obtain(&Project::at(&copy), &all()).unwrap();
        for (first, second) in libraries().binaries().iter().zip(second.binaries()) {
            assert!(first.bytes == second.bytes, "{}: the libraries differ", first.platform.name);
        }
        let model = common::model("6205-epps");
        assert!(
            fmu::pack(&model, libraries(), Version::Fmi2).unwrap()
                == fmu::pack(&model, &second, Version::Fmi2).unwrap()
        );
    }
}
