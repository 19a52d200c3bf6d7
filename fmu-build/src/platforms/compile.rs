//! The model library: for this machine linked of what cargo compiled for the program, for others compiled from source,
//! which takes a minute or two a target. What was made of the same source by the same tools is taken again.

use std::hash::Hasher;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

use anyhow::{Context, Result, bail};
use brinell::numerics::checksum::Checksum;

use super::platform::{Platform, Target};
use super::toolchain::Toolchain;
use super::{toolchain, universal};
use crate::shared::{Project, note, whole_file};

/// What the library is compiled of, in the workspace.
const SOURCES: [&str; 5] = ["Cargo.toml", "Cargo.lock", "src", "crates/fmi", ".cargo"];

/// The library for one platform, compiled for each of its processors.
pub fn platform(project: &Project, source: &Path, platform: Platform) -> Result<Vec<u8>> {
    let parts = platform.targets.iter().map(|target| one(project, source, platform, *target));
    match <[Vec<u8>; 1]>::try_from(parts.collect::<Result<Vec<_>>>()?) {
        Ok([part]) => Ok(part),
        Err(parts) => universal::join(&parts).context(platform.name),
    }
}

/// The library for this machine, of the crates that cargo compiled into `built` along with this program; none where
/// they are not there, or where the platform's file holds code for another processor too.
///
/// Cargo has linked one as well, for this machine's own C library; zig links the same code for old ones.
pub fn linked(project: &Project, source: &Path, platform: Platform, built: &Path) -> Result<Option<Vec<u8>>> {
    let code = built.join("libbrinell_fmi.rlib");
    let (&[target], Ok(bytes)) = (platform.targets, fs::read(&code)) else { return Ok(None) };
    let toolchain = Toolchain::new(project, source, target, true)?;
    let Some(linker) = toolchain.linker(target) else {
        let file = built.join(format!("{}brinell_fmi{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX));
        return Ok(Some(fs::read(&file).with_context(|| file.display().to_string())?));
    };
    let mut sum = Checksum::default();
    sum.write(&bytes);
    sum.write(toolchain.tools.as_bytes());
    let kept = project.cache().join("libraries").join(format!("{:016x}.{}", sum.finish(), platform.extension));
    if let Ok(bytes) = fs::read(&kept) {
        return Ok(Some(bytes));
    }
    let folder = whole_file::folder_in(project.cache())?;
    let (root, library) = (folder.path().join("lib.rs"), folder.path().join("library"));
    fs::write(&root, "pub use brinell_fmi::*;\n")?;
    let output = Command::new("rustc")
        .current_dir(source)
        .args(["--edition", "2024", "--crate-type", "cdylib", "--crate-name", "fmu", "-Cstrip=symbols"])
        .arg(format!("-Clinker={}", linker.display()))
        .arg("-L")
        .arg(format!("dependency={}", built.display()))
        .arg("--extern")
        .arg(format!("brinell_fmi={}", code.display()))
        .arg(&root)
        .arg("-o")
        .arg(&library)
        .output()
        .context("cannot start rustc to link the model library")?;
    if !output.status.success() {
        bail!("{}: not linked: {}", platform.name, String::from_utf8_lossy(&output.stderr).trim());
    }
    let bytes = fs::read(&library)?;
    whole_file::write(&kept, &bytes)?;
    Ok(Some(bytes))
}

/// The library for one target: the one that is kept, else compiled.
fn one(project: &Project, source: &Path, platform: Platform, target: Target) -> Result<Vec<u8>> {
    let toolchain = Toolchain::new(project, source, target, true)?;
    let sum = checksum(source, target, &toolchain)?;
    let kept = project.cache().join("libraries").join(format!("{sum:016x}-{}.{}", target.triple, platform.extension));
    if let Ok(bytes) = fs::read(&kept) {
        return Ok(bytes);
    }
    let built = build(source, platform, target, &toolchain)?;
    let bytes = fs::read(&built).with_context(|| built.display().to_string())?;
    whole_file::write(&kept, &bytes)?;
    Ok(bytes)
}

/// Of every file that is compiled, the tools and how they are called.
fn checksum(source: &Path, target: Target, toolchain: &Toolchain) -> Result<u64> {
    let mut sum = Checksum::default();
    let mut files = Vec::new();
    for part in SOURCES {
        add_files(&source.join(part), &mut files)?;
    }
    files.sort();
    for file in files {
        let name = file.strip_prefix(source).unwrap_or(&file).to_string_lossy().replace('\\', "/");
        let bytes = fs::read(&file).with_context(|| file.display().to_string())?;
        sum.write(format!("{name}\0{}\0", bytes.len()).as_bytes());
        sum.write(&bytes);
    }
    sum.write(format!("{}\0{}\0", target.compiled_as(), toolchain.tools).as_bytes());
    // Where programs are looked for says nothing of what they are.
    for (name, value) in toolchain.variables.iter().filter(|(name, _)| name != "PATH") {
        sum.write(format!("{}={}\0", name.display(), value.display()).as_bytes());
    }
    Ok(sum.finish())
}

fn add_files(path: &Path, files: &mut Vec<PathBuf>) -> Result<()> {
    let about = || path.display().to_string();
    if path.is_dir() {
        for entry in fs::read_dir(path).with_context(about)? {
            add_files(&entry.with_context(about)?.path(), files)?;
        }
    } else if path.is_file() {
        files.push(path.to_owned());
    }
    Ok(())
}

fn build(source: &Path, platform: Platform, target: Target, toolchain: &Toolchain) -> Result<PathBuf> {
    let cargo = toolchain::cargo();
    note!("compiling the model library for {} (once)", target.compiled_as());
    let output = toolchain
        .set_up(&mut Command::new(&cargo))
        .current_dir(source)
        .args(["build", "--lib", "--package", "brinell-fmi", "--release"])
        .args(["--target", target.compiled_as(), "--locked", "--message-format", "json-render-diagnostics"])
        .stderr(Stdio::inherit())
        .output()
        .with_context(|| format!("cannot start {} to compile the model library", cargo.display()))?;
    if !output.status.success() {
        bail!("{}: not compiled ({}); cargo's messages are above", platform.name, output.status);
    }
    let built = String::from_utf8_lossy(&output.stdout);
    let file = built
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok())
        .find_map(|message| artifact(&message, platform.extension));
    file.context("cargo built no dynamic library of the package brinell-fmi")
}

/// Path of the dynamic library, when a message of cargo announces it.
fn artifact(message: &serde_json::Value, extension: &str) -> Option<PathBuf> {
    if message["reason"] != "compiler-artifact" || message["target"]["name"] != "brinell_fmi" {
        return None;
    }
    let files = message["filenames"].as_array()?.iter().filter_map(|file| file.as_str());
    files.map(PathBuf::from).find(|file| file.extension().is_some_and(|ending| ending == extension))
}
