//! The compiled library, the same for every scene: built from source, or found ready-made.
//!
//! It has a build profile of its own (`fmu-library` in the workspace's `Cargo.toml`): stripped and optimised as
//! a whole. Paths of the machine are left out of it, so that equal source and equal tools give equal bytes. A library
//! beside this program serves where the source is not at hand.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use crate::project::Project;
use crate::target::{OLDEST_GLIBC, Target, Zig, needed_glibc};

/// What to pack: a file that is there, or what to build.
#[derive(Debug, Clone, Default)]
pub struct Choice {
    /// A compiled library for this platform.
    pub file: Option<PathBuf>,
    /// Platforms to build for; none stands for this program's own.
    pub platforms: Vec<String>,
}

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
    /// The library that was chosen; else built from the workspace's source; else the one beside this program.
    pub fn obtain(project: &Project, choice: &Choice) -> Result<Self> {
        let host = Target::host()?;
        let Some(source) = project.source().filter(|_| choice.file.is_none()) else {
            if !choice.platforms.is_empty() {
                bail!("--target needs Brinell's source to compile, and goes without --library");
            }
            let path = choice.file.clone().map_or_else(beside_this_program, Ok)?;
            return Ok(Self { binaries: vec![Binary::read(host, &path)?] });
        };
        let targets = match choice.platforms.as_slice() {
            [] => vec![host],
            names => names.iter().map(|name| Target::named(name)).collect::<Result<Vec<_>>>()?,
        };
        for target in &targets {
            target.check_installed(source)?;
        }
        let zig = Zig::find(project);
        let build = |target: &Target| Binary::read(*target, &build(project, source, *target, host, zig.as_ref())?);
        Ok(Self { binaries: targets.iter().map(build).collect::<Result<Vec<_>>>()? })
    }

    /// One binary for each platform.
    pub fn binaries(&self) -> &[Binary] {
        &self.binaries
    }

    /// A line for each binary: platform, size, and what it needs.
    pub fn describe(&self) -> Vec<String> {
        self.binaries.iter().map(Binary::describe).collect()
    }
}

impl Binary {
    fn read(target: Target, path: &Path) -> Result<Self> {
        let bytes = fs::read(path).with_context(|| path.display().to_string())?;
        Ok(Self { platform: target.platform, extension: target.extension, bytes })
    }

    fn describe(&self) -> String {
        let size = self.bytes.len() as f64 / 1024.0;
        let needs = match needed_glibc(&self.bytes) {
            None => String::new(),
            Some(version) if version > OLDEST_GLIBC => format!(
                ", needs glibc {}.{}; for {}.{} and newer: pip install ziglang",
                version.0, version.1, OLDEST_GLIBC.0, OLDEST_GLIBC.1
            ),
            Some(version) => format!(", needs glibc {}.{}", version.0, version.1),
        };
        format!("{}: {size:.0} KiB{needs}", self.platform)
    }
}

fn build(project: &Project, source: &Path, target: Target, host: Target, zig: Option<&Zig>) -> Result<PathBuf> {
    // `cargo run` and `cargo test` say which cargo they are.
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(&cargo);
    command
        .current_dir(source)
        .args(["build", "--lib", "--package", "brinell-fmi", "--profile", "fmu-library", "--target", target.triple])
        .args(["--locked", "--message-format", "json-render-diagnostics"])
        .env("CARGO_ENCODED_RUSTFLAGS", flags(source))
        .stderr(Stdio::inherit());
    match zig {
        // Zig's libraries are of use where the C library's age matters, and for other systems.
        Some(zig) if cfg!(unix) && (target != host || target.extension == "so") => {
            let variable = format!("CARGO_TARGET_{}_LINKER", target.triple.to_uppercase().replace('-', "_"));
            command.env(variable, zig.linker(project, target)?);
        }
        None if target != host => bail!("{}: no linker for it; run: pip install ziglang", target.platform),
        _ => {}
    }
    let output =
        command.output().with_context(|| format!("cannot start {} to compile the model library", cargo.display()))?;
    if !output.status.success() {
        bail!("{}: not compiled ({}); cargo's messages are above", target.platform, output.status);
    }
    let built = String::from_utf8_lossy(&output.stdout);
    let found = built
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok())
        .find_map(|message| artifact(&message, target));
    found.context("cargo built no dynamic library of the package brinell-fmi")
}

/// The compiler's flags: the user's, and names in place of this machine's folders.
fn flags(source: &Path) -> OsString {
    let mut flags = match (env::var_os("CARGO_ENCODED_RUSTFLAGS"), env::var("RUSTFLAGS")) {
        (Some(encoded), _) => encoded,
        (None, Ok(plain)) => plain.split_whitespace().collect::<Vec<_>>().join("\u{1f}").into(),
        (None, Err(_)) => OsString::new(),
    };
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    let cargo = home.or_else(|| env::home_dir().map(|home| home.join(".cargo")));
    for (folder, name) in [(Some(source.to_path_buf()), "brinell"), (cargo, "cargo")] {
        if let Some(folder) = folder {
            if !flags.is_empty() {
                flags.push("\u{1f}");
            }
            flags.push("--remap-path-prefix=");
            flags.push(folder);
            flags.push(format!("={name}"));
        }
    }
    flags
}

/// Path of the dynamic library, when a message of cargo announces it.
fn artifact(message: &serde_json::Value, target: Target) -> Option<PathBuf> {
    if message["reason"] != "compiler-artifact" || message["target"]["name"] != "brinell_fmi" {
        return None;
    }
    let files = message["filenames"].as_array()?.iter().filter_map(|file| file.as_str());
    files.map(PathBuf::from).find(|file| file.extension().is_some_and(|e| e == target.extension))
}

fn beside_this_program() -> Result<PathBuf> {
    let program = env::current_exe()?;
    let name = format!("{}brinell_fmi{}", env::consts::DLL_PREFIX, env::consts::DLL_SUFFIX);
    let path = program.with_file_name(name);
    if !path.is_file() {
        bail!("no model library: neither Brinell's source nor {} is there; name one with --library", path.display());
    }
    Ok(path)
}
