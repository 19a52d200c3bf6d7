//! How cargo is called so that it compiles for a target wherever it runs: linker, flags and what the linker needs.
//!
//! Paths of the machine are left out of what is compiled, so that equal source and equal tools give equal bytes.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

use anyhow::{Context, Result, bail};

use super::platform::{Linking, Platform, Target};
use super::zig::Zig;
use crate::shared::{Project, note};

/// The oldest macOS that files are made for: the first that runs on both kinds of Mac.
pub const OLDEST_MACOS: &str = "11.0";
/// The name by which macOS would look for the library, were it linked to and not loaded by its path.
const INSTALL_NAME: &str = "@rpath/brinell_fmi.dylib";

/// How cargo compiles for one target.
#[derive(Debug, Clone, Default)]
pub struct Toolchain {
    /// Variables of cargo's environment.
    pub variables: Vec<(OsString, OsString)>,
    /// The tools, in words: two builds by equal tools of equal source are equal.
    pub tools: String,
}

impl Toolchain {
    /// Puts it together; `library` tells whether a library is linked, or a program.
    ///
    /// # Errors
    /// Where another machine's linker is not to be had.
    pub fn new(project: &Project, source: &Path, target: Target, library: bool) -> Result<Self> {
        let mut made = Self { variables: Vec::new(), tools: rustc(source)? };
        let mut own_flags: Vec<OsString> = Vec::new();
        match target.linking {
            Linking::Zig(name) => made.link_by_zig(project, target, name)?,
            Linking::Apple => {
                made.set("MACOSX_DEPLOYMENT_TARGET", OLDEST_MACOS);
                let by_rust = !cfg!(target_os = "macos");
                let name = if by_rust { "-Clink-arg=" } else { "-Clink-arg=-Wl," };
                if library {
                    let comma = if by_rust { "\u{1f}-Clink-arg=" } else { "," };
                    own_flags.push(format!("{name}-install_name{comma}{INSTALL_NAME}").into());
                }
                if by_rust {
                    let zig = zig(project, target)?;
                    made.tools += &format!("zig {}\n", zig.version().unwrap_or_default());
                    made.set("SDKROOT", zig.apple_kit(project)?);
                    made.set(&linker_variable(target), "rust-lld");
                    own_flags.push("-Clinker-flavor=ld64.lld".into());
                }
            }
        }
        made.set("CARGO_ENCODED_RUSTFLAGS", flags(source, own_flags));
        Ok(made)
    }

    /// Gives a command that calls cargo its environment. A wrapper of the caller's around the compiler is left out:
    /// crates behind one have other names, and a library other bytes.
    pub fn set_up<'a>(&self, command: &'a mut Command) -> &'a mut Command {
        let variables = self.variables.iter().map(|(name, value)| (name, value));
        command.envs(variables).env_remove("RUSTC_WORKSPACE_WRAPPER")
    }

    /// The linker for this target, where it is not the machine's own.
    pub fn linker(&self, target: Target) -> Option<&Path> {
        let name = linker_variable(target);
        self.variables.iter().find(|(known, _)| *known == *name).map(|(_, path)| Path::new(path))
    }

    fn link_by_zig(&mut self, project: &Project, target: Target, name: &str) -> Result<()> {
        // The script that calls zig is one of Unix; and a Mac or a Windows links for itself.
        let useful = cfg!(unix) && (!target.is_host() || cfg!(target_os = "linux"));
        if !useful && target.is_host() {
            return Ok(());
        }
        if !useful {
            bail!("{}: compiling for other systems is done on Linux or macOS", target.triple);
        }
        match zig(project, target) {
            Ok(zig) => {
                self.tools += &format!("zig {}\n", zig.version().unwrap_or_default());
                self.set(&linker_variable(target), zig.linker(project, target, name)?);
                if target.triple.contains("windows") {
                    let path = env::var_os("PATH").unwrap_or_default();
                    let folders = [zig.dlltool(project)?].into_iter().chain(env::split_paths(&path));
                    self.set("PATH", env::join_paths(folders)?);
                }
                Ok(())
            }
            Err(why) if target.is_host() => {
                note!("note: linked by this machine's own linker, for its own C library: {why:#}");
                self.tools += "this machine's linker\n";
                Ok(())
            }
            Err(why) => Err(why),
        }
    }

    fn set(&mut self, name: &str, value: impl Into<OsString>) {
        self.variables.push((name.into(), value.into()));
    }
}

fn zig(project: &Project, target: Target) -> Result<Zig> {
    Zig::obtain(project).with_context(|| format!("{}: no linker for it", target.triple))
}

fn linker_variable(target: Target) -> String {
    format!("CARGO_TARGET_{}_LINKER", target.triple.to_uppercase().replace('-', "_"))
}

/// The cargo that calls this program, else the one in the path: `cargo run` and `cargo test` say which they are.
pub fn cargo() -> OsString {
    env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// What the compiler says of its version.
fn rustc(source: &Path) -> Result<String> {
    let output = Command::new("rustc").current_dir(source).arg("-vV").output().context("cannot start rustc")?;
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// The compiler's flags: the user's, ours, and names in place of this machine's folders.
fn flags(source: &Path, ours: Vec<OsString>) -> OsString {
    let mut all: Vec<OsString> = match (env::var_os("CARGO_ENCODED_RUSTFLAGS"), env::var("RUSTFLAGS")) {
        (Some(encoded), _) => vec![encoded],
        (None, Ok(plain)) => plain.split_whitespace().map(OsString::from).collect(),
        (None, Err(_)) => Vec::new(),
    };
    all.extend(ours);
    let home = env::var_os("CARGO_HOME").map(PathBuf::from);
    let cargo = home.or_else(|| env::home_dir().map(|home| home.join(".cargo")));
    for (folder, name) in [(Some(source.to_path_buf()), "brinell"), (cargo, "cargo")] {
        if let Some(folder) = folder {
            let mut flag = OsString::from("--remap-path-prefix=");
            flag.push(folder);
            flag.push(format!("={name}"));
            all.push(flag);
        }
    }
    all.join("\u{1f}".as_ref())
}

/// Fails, with one command that mends it, if Rust's standard library for any target of these is not installed.
pub fn check_installed(source: &Path, platforms: &[Platform]) -> Result<()> {
    let mut missing = Vec::new();
    for target in platforms.iter().flat_map(|platform| platform.targets) {
        if !is_installed(source, target.compiled_as())? {
            missing.push(target.compiled_as());
        }
    }
    if missing.is_empty() {
        return Ok(());
    }
    let missing = missing.join(" ");
    bail!("Rust's standard library is not installed for every platform; run: rustup target add {missing}")
}

fn is_installed(source: &Path, triple: &str) -> Result<bool> {
    let output = Command::new("rustc")
        .current_dir(source)
        .args(["--print", "target-libdir", "--target", triple])
        .stderr(Stdio::inherit())
        .output()
        .context("cannot start rustc")?;
    let folder = PathBuf::from(String::from_utf8_lossy(&output.stdout).trim());
    let has_std = |entry: fs::DirEntry| entry.file_name().to_string_lossy().starts_with("libstd-");
    let installed = fs::read_dir(folder).is_ok_and(|mut all| all.any(|entry| entry.is_ok_and(has_std)));
    Ok(output.status.success() && installed)
}
