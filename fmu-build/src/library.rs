//! The compiled library, the same for every scene: built from source, or found ready-made.
//!
//! It has a build profile of its own (`fmu-library` in the workspace's `Cargo.toml`): stripped and optimised as
//! a whole. A library beside this program serves where the source is not at hand.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use crate::project::Project;

/// The compiled library for one or several platforms.
#[derive(Debug, Clone)]
pub struct Library {
    binaries: Vec<Binary>,
}

/// The compiled library for one platform.
#[derive(Debug, Clone)]
pub struct Binary {
    /// The standard's name of the platform: its folder under `binaries/`.
    pub platform: &'static str,
    /// Extension of the file, without the dot.
    pub extension: &'static str,
    /// The file.
    pub bytes: Vec<u8>,
}

impl Library {
    /// The library at `chosen`; else built from the workspace's source; else the one beside this program.
    pub fn obtain(project: &Project, chosen: Option<&Path>) -> Result<Self> {
        let path = match (chosen, project.source()) {
            (Some(path), _) => path.to_path_buf(),
            (None, Some(source)) => build(source)?,
            (None, None) => beside_this_program()?,
        };
        let bytes = fs::read(&path).with_context(|| path.display().to_string())?;
        Ok(Self { binaries: vec![Binary { platform: platform()?, extension: env::consts::DLL_EXTENSION, bytes }] })
    }

    /// One binary for each platform.
    pub fn binaries(&self) -> &[Binary] {
        &self.binaries
    }
}

/// The standard's name of the platform that this program runs on.
pub fn platform() -> Result<&'static str> {
    match (env::consts::OS, env::consts::ARCH) {
        ("linux", "x86_64") => Ok("linux64"),
        ("linux", "aarch64") => Ok("aarch64-linux"),
        ("macos", "x86_64" | "aarch64") => Ok("darwin64"),
        ("windows", "x86_64") => Ok("win64"),
        (system, processor) => {
            bail!("platform {system} on {processor}: FMI 2.0 has no name for it")
        }
    }
}

fn build(source: &Path) -> Result<PathBuf> {
    // `cargo run` and `cargo test` say which cargo they are.
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(&cargo)
        .current_dir(source)
        .args(["build", "--lib", "--package", "brinell", "--profile", "fmu-library"])
        .args(["--locked", "--message-format", "json-render-diagnostics"])
        .stderr(Stdio::inherit())
        .output()
        .with_context(|| format!("cannot start {} to compile the model library", cargo.display()))?;
    if !output.status.success() {
        bail!("the model library was not compiled ({}); cargo's messages are above", output.status);
    }
    let built = String::from_utf8_lossy(&output.stdout);
    let found =
        built.lines().filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok()).find_map(artifact);
    found.context("cargo built no dynamic library of the package brinell")
}

/// Path of the dynamic library, when a message of cargo announces it.
fn artifact(message: serde_json::Value) -> Option<PathBuf> {
    if message["reason"] != "compiler-artifact" || message["target"]["name"] != "brinell" {
        return None;
    }
    let files = message["filenames"].as_array()?.iter().filter_map(|file| file.as_str());
    files.map(PathBuf::from).find(|file| file.extension().is_some_and(|e| e == env::consts::DLL_EXTENSION))
}

fn beside_this_program() -> Result<PathBuf> {
    let program = env::current_exe()?;
    let name = format!("{}brinell{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    let path = program.with_file_name(name);
    if !path.is_file() {
        bail!("no model library: neither Brinell's source nor {} is there; name one with --library", path.display());
    }
    Ok(path)
}
