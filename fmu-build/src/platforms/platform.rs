//! The platforms of the FMI standard that the model library is made for, and Rust's names of them.

use std::env;

use anyhow::{Context, Result, bail};

/// A platform: one folder under `binaries/` with one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Platform {
    /// The folder's name, after FMI 2.0; FMI 3.0's where 2.0 has none.
    pub name: &'static str,
    /// The folders' names after FMI 3.0, one for each processor.
    pub fmi3: &'static [&'static str],
    /// What it is compiled for, one for each processor.
    pub targets: &'static [Target],
    /// Extension of a dynamic library, without the dot.
    pub extension: &'static str,
}

/// A system and a processor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Target {
    /// Rust's name.
    pub triple: &'static str,
    /// How it is linked on another machine.
    pub linking: Linking,
}

/// How a target is linked where it is not the machine's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Linking {
    /// Through zig, which calls the target by this name.
    Zig(&'static str),
    /// By the linker of Rust's own toolchain, with the list of macOS's symbols that zig brings.
    Apple,
}

/// All that there are. The oldest glibc is the oldest that Rust supports.
pub const PLATFORMS: [Platform; 4] = [
    Platform {
        name: "linux64",
        fmi3: &["x86_64-linux"],
        targets: &[Target { triple: "x86_64-unknown-linux-gnu", linking: Linking::Zig("x86_64-linux-gnu.2.17") }],
        extension: "so",
    },
    Platform {
        name: "win64",
        fmi3: &["x86_64-windows"],
        targets: &[Target { triple: "x86_64-pc-windows-gnu", linking: Linking::Zig("x86_64-windows-gnu") }],
        extension: "dll",
    },
    // FMI 2.0 has one folder for both kinds of Mac, so one file holds the code for both.
    Platform {
        name: "darwin64",
        fmi3: &["x86_64-darwin", "aarch64-darwin"],
        targets: &[
            Target { triple: "x86_64-apple-darwin", linking: Linking::Apple },
            Target { triple: "aarch64-apple-darwin", linking: Linking::Apple },
        ],
        extension: "dylib",
    },
    // FMI 2.0 has no name for it; the standard lets vendors add folders.
    Platform {
        name: "aarch64-linux",
        fmi3: &["aarch64-linux"],
        targets: &[Target { triple: "aarch64-unknown-linux-gnu", linking: Linking::Zig("aarch64-linux-gnu.2.17") }],
        extension: "so",
    },
];

impl Platform {
    /// The platforms in a list as the user writes it: `all`, or names after FMI 2.0, FMI 3.0 or Rust, each once.
    ///
    /// # Errors
    /// Of a name that is none, with those that there are.
    pub fn listed<S: AsRef<str>>(names: &[S]) -> Result<Vec<Self>> {
        let mut chosen: Vec<Self> = Vec::new();
        for name in names.iter().map(AsRef::as_ref) {
            let platforms = if name == "all" { PLATFORMS.to_vec() } else { vec![Self::named(name)?] };
            for platform in platforms {
                if !chosen.contains(&platform) {
                    chosen.push(platform);
                }
            }
        }
        Ok(chosen)
    }

    /// The platform of this name, after FMI 2.0, FMI 3.0 or Rust.
    pub fn named(name: &str) -> Result<Self> {
        let known = || PLATFORMS.map(|platform| platform.name).join(", ");
        let is_it = |platform: &Platform| {
            platform.name == name
                || platform.fmi3.contains(&name)
                || platform.targets.iter().any(|target| target.triple == name)
        };
        PLATFORMS.into_iter().find(is_it).with_context(|| format!("platform {name:?}: known are all, {}", known()))
    }

    /// The platform that this program runs on.
    pub fn host() -> Result<Self> {
        match (env::consts::OS, env::consts::ARCH) {
            ("linux", "x86_64") => Self::named("linux64"),
            ("linux", "aarch64") => Self::named("aarch64-linux"),
            ("macos", "x86_64" | "aarch64") => Self::named("darwin64"),
            ("windows", "x86_64") => Self::named("win64"),
            (system, processor) => bail!("platform {system} on {processor}: there is no model library for it"),
        }
    }

    /// The folder's name after FMI 3.0 for the processor that this program runs on.
    pub fn fmi3_of_this_machine(&self) -> String {
        let own = self.fmi3.iter().find(|name| name.starts_with(&format!("{}-", env::consts::ARCH)));
        own.unwrap_or(&self.name).to_string()
    }

    /// Name of its file in a folder of libraries.
    pub fn file(&self) -> String {
        format!("{}.{}", self.name, self.extension)
    }
}

impl Target {
    /// Whether it is what this program was compiled for.
    pub fn is_host(&self) -> bool {
        let system = match env::consts::OS {
            "linux" => "linux-gnu",
            "macos" => "apple-darwin",
            other => other,
        };
        self.triple.starts_with(env::consts::ARCH) && self.triple.contains(system)
    }

    /// Rust's name of what is compiled. On Windows that is what this program was compiled for, so that the linker that
    /// made it serves.
    pub fn compiled_as(&self) -> &'static str {
        if self.is_host() && cfg!(all(windows, target_env = "msvc")) { "x86_64-pc-windows-msvc" } else { self.triple }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_platform_is_found_by_each_of_its_names_and_an_unknown_one_lists_the_known() {
        for platform in PLATFORMS {
            let triples = platform.targets.iter().map(|target| target.triple);
            for name in platform.fmi3.iter().copied().chain(triples).chain([platform.name]) {
                assert_eq!(Platform::named(name).unwrap(), platform, "{name}");
            }
        }
        let said = Platform::named("amiga").unwrap_err().to_string();
        assert!(said.contains("amiga") && said.contains("linux64, win64, darwin64, aarch64-linux"), "{said}");
    }

    #[test]
    fn all_is_every_platform_and_none_is_listed_twice() {
        assert_eq!(Platform::listed(&["all"]).unwrap(), PLATFORMS);
        let names: Vec<_> =
            Platform::listed(&["win64", "x86_64-windows", "linux64"]).unwrap().iter().map(|p| p.name).collect();
        assert_eq!(names, ["win64", "linux64"]);
        assert!(Platform::listed(&["linux64", "win32"]).is_err());
        assert_eq!(Platform::listed::<&str>(&[]).unwrap(), []);
    }

    #[test]
    fn this_machine_is_one_target_of_its_platform() {
        let hosts = PLATFORMS.iter().flat_map(|platform| platform.targets).filter(|target| target.is_host());
        assert_eq!(hosts.count(), 1);
        assert!(Platform::host().unwrap().targets.iter().any(Target::is_host));
    }
}
