//! The model library as it is packed: old enough for every Linux, stripped, free of this machine's paths.
//! `cargo test --workspace --release --test fmu library`. The files of all platforms: `platform_files.rs`.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::process::Command;

use fmu_build::package::{Choice, Library};
use fmu_build::platforms::{OLDEST_GLIBC, PLATFORMS, Platform, check_installed, needed_glibc};
use fmu_build::shared::Project;

#[test]
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[cfg_attr(debug_assertions, ignore = "looks at the shipped library, which `--release` makes")]
fn the_packed_library_runs_with_glibc_2_17_and_without_libgcc() {
    let binary = &common::library().binaries()[0];
    assert_eq!(binary.platform.name, "linux64");
    assert!(needed_glibc(&binary.bytes).unwrap() <= OLDEST_GLIBC, "{:?}", common::library().describe());
    let holds = |text: &[u8]| binary.bytes.windows(text.len()).any(|window| window == text);
    assert!(!holds(b"libgcc_s"), "libgcc_s is asked for");
    // As names of sections, which end in NUL; the standard library's backtraces hold them as plain words.
    assert!(!holds(b"\0.symtab\0") && !holds(b"\0.debug_info\0"), "not stripped");
    let root = common::root().to_str().unwrap();
    assert!(!holds(root.as_bytes()), "it tells where it was built: {root}");
}

#[test]
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
#[cfg_attr(debug_assertions, ignore = "looks at the shipped library, which `--release` makes")]
fn objdump_finds_no_newer_symbol_and_119_functions() {
    let file = common::folder("objdump").join("library.so");
    std::fs::write(&file, &common::library().binaries()[0].bytes).unwrap();
    let Ok(output) = Command::new("objdump").arg("-T").arg(&file).output() else {
        println!("objdump is not installed: left out");
        return;
    };
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let newest = needed_glibc(text.as_bytes()).unwrap();
    assert!(newest <= OLDEST_GLIBC, "{newest:?}");
    let exported: Vec<_> = text.lines().filter(|line| line.contains(".text") && !line.contains("*UND*")).collect();
    // FMI 2.0: 34 of co-simulation, 10 of model exchange. FMI 3.0: all 75.
    for (prefix, count) in [(" fmi2", 44), (" fmi3", 75), (" ", 119)] {
        let found = exported.iter().filter(|line| line.contains(prefix)).count();
        assert_eq!(found, count, "{prefix}: {exported:#?}");
    }
}

#[test]
fn a_platform_without_its_standard_library_is_refused_with_the_command_that_installs_it() {
    for platform in PLATFORMS {
        let Err(why) = check_installed(common::root(), &[platform]) else { continue };
        let choice = Choice { file: None, platforms: vec![platform.name.to_owned()] };
        let refused = Library::obtain(&Project::find(), &choice).unwrap_err().to_string();
        assert_eq!(refused, why.to_string());
        assert!(platform.targets.iter().any(|t| refused.contains("rustup target add") && refused.contains(t.triple)));
    }
    assert!(check_installed(common::root(), &[Platform::host().unwrap()]).is_ok());
}
