//! Platforms that the model library can be compiled for, and the linkers that do it.
//!
//! Rust's own linker call takes the C library of the machine that compiles, and an FMU made on a new Linux does not
//! load on an older one. Zig holds the symbol lists of every glibc and of the other systems, so linking through it
//! makes a library for glibc 2.17 (2012) wherever it is made, without `libgcc_s`, and reaches other systems too. It
//! comes from the Python package index (`pip install ziglang`) and is in this program's own environment; where neither
//! that nor a `zig` in the path is found, the machine's own linker makes a library for its own kind.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context, Result, bail};

use crate::project::Project;
use crate::python::Python;
use crate::whole_file;

/// The oldest glibc that a library linked by zig runs with: the oldest that Rust supports.
pub const OLDEST_GLIBC: (u32, u32) = (2, 17);

/// A platform of the FMI standard.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Target {
    /// The standard's name: the folder under `binaries/`.
    pub platform: &'static str,
    /// Rust's name.
    pub triple: &'static str,
    /// Zig's name.
    pub zig: &'static str,
    /// Extension of a dynamic library, without the dot.
    pub extension: &'static str,
}

/// All that can be asked for.
pub const TARGETS: [Target; 5] = [
    Target { platform: "linux64", triple: "x86_64-unknown-linux-gnu", zig: "x86_64-linux-gnu.2.17", extension: "so" },
    Target { platform: "win64", triple: "x86_64-pc-windows-gnu", zig: "x86_64-windows-gnu", extension: "dll" },
    Target { platform: "darwin64", triple: "x86_64-apple-darwin", zig: "x86_64-macos", extension: "dylib" },
    Target {
        platform: "aarch64-linux",
        triple: "aarch64-unknown-linux-gnu",
        zig: "aarch64-linux-gnu.2.17",
        extension: "so",
    },
    // FMI 2.0 has one folder for both kinds of Mac.
    Target { platform: "darwin64", triple: "aarch64-apple-darwin", zig: "aarch64-macos", extension: "dylib" },
];

impl Target {
    /// The platform of this name, the standard's or Rust's; of two with one name the first.
    pub fn named(platform: &str) -> Result<Self> {
        let known = || TARGETS.map(|target| target.platform).join(", ");
        TARGETS
            .into_iter()
            .find(|target| target.platform == platform || target.triple == platform)
            .with_context(|| format!("platform {platform:?}: known are {}", known()))
    }

    /// The platform that this program runs on.
    pub fn host() -> Result<Self> {
        match (env::consts::OS, env::consts::ARCH) {
            ("linux", "x86_64") => Self::named("linux64"),
            ("linux", "aarch64") => Self::named("aarch64-linux"),
            ("macos", "x86_64") => Self::named("darwin64"),
            ("macos", "aarch64") => Self::named("aarch64-apple-darwin"),
            ("windows", "x86_64") => Self::named("win64"),
            (system, processor) => bail!("platform {system} on {processor}: FMI 2.0 has no name for it"),
        }
    }

    /// Fails, with what to do, if Rust's standard library for this platform is not installed.
    pub fn check_installed(&self, source: &Path) -> Result<()> {
        let output = Command::new("rustc")
            .current_dir(source)
            .args(["--print", "target-libdir", "--target", self.triple])
            .stderr(Stdio::inherit())
            .output()
            .context("cannot start rustc")?;
        let folder = PathBuf::from(String::from_utf8_lossy(&output.stdout).trim());
        let has_std = |entry: fs::DirEntry| entry.file_name().to_string_lossy().starts_with("libstd-");
        if output.status.success()
            && fs::read_dir(folder).is_ok_and(|mut all| all.any(|entry| entry.is_ok_and(has_std)))
        {
            return Ok(());
        }
        bail!(
            "{}: Rust's standard library for {} is not installed; run: rustup target add {}",
            self.platform,
            self.triple,
            self.triple
        )
    }
}

/// How to start zig.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Zig(Vec<PathBuf>);

impl Zig {
    /// Looks in this program's Python environment, in the path, and among the system's Python packages.
    pub fn find(project: &Project) -> Option<Self> {
        let python = Python::interpreter_of(project);
        let by_python = |python: PathBuf| Self(vec![python, "-m".into(), "ziglang".into()]);
        [by_python(python), Self(vec!["zig".into()]), by_python("python3".into())].into_iter().find(Self::works)
    }

    fn works(&self) -> bool {
        let Some((program, arguments)) = self.0.split_first() else { return false };
        let output = Command::new(program).args(arguments).arg("version").stderr(Stdio::null()).output();
        output.is_ok_and(|output| output.status.success())
    }

    /// Writes the program that rustc calls as its linker for a platform, and gives its path.
    ///
    /// Two things need help: Rust asks for `libgcc_s`, in place of which zig has its own unwinder to link statically;
    /// and the libraries that were joined into glibc's main one later must be named as zig names them.
    pub fn linker(&self, project: &Project, target: Target) -> Result<PathBuf> {
        // The name's end tells rustc which kind of linker it is.
        let script = project.target().join("zig").join(format!("{}-clang", target.triple));
        let command: Vec<_> = self.0.iter().map(|part| format!("'{}'", part.display())).collect();
        let cache = project.target().join("zig/cache");
        let text = format!(
            "#!/bin/sh\n\
             # Written by cargo fmu build: links through zig.\n\
             export ZIG_GLOBAL_CACHE_DIR='{cache}' ZIG_LOCAL_CACHE_DIR='{cache}'\n\
             for argument do\n\
             \x20 shift\n\
             \x20 case $argument in\n\
             \x20   -lgcc_s | -lgcc_eh) set -- \"$@\" -lunwind ;;\n\
             \x20   -lgcc | -fuse-ld=* | --target=*) ;;\n\
             \x20   *) set -- \"$@\" \"$argument\" ;;\n\
             \x20 esac\n\
             done\n\
             exec {command} cc -target {target} \"$@\"\n",
            cache = cache.display(),
            command = command.join(" "),
            target = target.zig,
        );
        let about = || script.display().to_string();
        fs::create_dir_all(&cache).with_context(about)?;
        if fs::read_to_string(&script).is_ok_and(|there| there == text) {
            return Ok(script);
        }
        whole_file::write(&script, text)?;
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            fs::set_permissions(&script, fs::Permissions::from_mode(0o755)).with_context(about)?;
        }
        Ok(script)
    }
}

/// The newest version of glibc that a library's symbols ask for; `None` if it asks for none.
pub fn needed_glibc(library: &[u8]) -> Option<(u32, u32)> {
    const NAME: &[u8] = b"GLIBC_";
    let version = |text: &[u8]| {
        let end = text.iter().position(|byte| !byte.is_ascii_digit() && *byte != b'.').unwrap_or(text.len());
        let mut parts = std::str::from_utf8(&text[..end]).ok()?.split('.');
        Some((parts.next()?.parse().ok()?, parts.next()?.parse().ok()?))
    };
    let places = library.windows(NAME.len()).enumerate().filter(|(_, window)| *window == NAME);
    places.filter_map(|(at, _)| version(&library[at + NAME.len()..])).max()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_platform_is_found_by_either_name_and_an_unknown_one_lists_the_known() {
        assert_eq!(Target::named("win64").unwrap().triple, "x86_64-pc-windows-gnu");
        assert_eq!(Target::named("aarch64-unknown-linux-gnu").unwrap().platform, "aarch64-linux");
        assert!(Target::named("amiga").unwrap_err().to_string().contains("linux64"));
    }

    #[test]
    fn the_newest_glibc_is_found_by_number_not_by_letter() {
        assert_eq!(needed_glibc(b"\0GLIBC_2.9\0GLIBC_2.14\0GLIBC_2.2.5\0GLIBC_PRIVATE\0"), Some((2, 14)));
        assert_eq!(needed_glibc(b"no such name"), None);
    }
}
