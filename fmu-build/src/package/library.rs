//! The compiled library, the same for every scene: one that the user names, those inside this program, or compiled from
//! source.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::{env, fs};

use anyhow::{Context, Result, bail};
use clap::Args;

use super::archive::{ArchiveError, Compressed};
use crate::platforms::{OLDEST_GLIBC, Platform, compile, needed_glibc, toolchain};
use crate::shared::{Project, shipped};

/// What to pack: a file that is there, or for which platforms.
#[derive(Debug, Clone, Default, Args)]
pub struct Choice {
    /// Compiled model library to pack, instead of building it from source; so does the environment's BRINELL_LIBRARY
    #[arg(long = "library", value_name = "PATH", conflicts_with = "platforms")]
    pub file: Option<PathBuf>,
    /// Platforms to pack the library for: all, or a list of linux64, win64, darwin64, aarch64-linux
    /// [default: all that this program holds; where it compiles them, this machine's]
    #[arg(long, value_name = "PLATFORM,…", value_delimiter = ',')]
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
    /// Its platform.
    pub platform: Platform,
    /// The file.
    pub bytes: Vec<u8>,
    /// The same for archives, made when the first of them asks: it takes longer than all else in an FMU.
    compressed: OnceLock<Compressed>,
}

impl Choice {
    /// The same, and where nothing was chosen the file that the environment's BRINELL_LIBRARY names.
    pub fn or_environment(self) -> Self {
        let named = || env::var_os("BRINELL_LIBRARY").map(PathBuf::from).filter(|_| self.platforms.is_empty());
        Self { file: self.file.or_else(named), platforms: self.platforms }
    }
}

impl Library {
    /// The library that was chosen; else those inside this program; else the one built along with it; else compiled
    /// from the workspace's source; else the one beside this program.
    pub fn obtain(project: &Project, choice: &Choice) -> Result<Self> {
        let platforms = Platform::listed(&choice.platforms)?;
        if let Some(file) = &choice.file {
            return Self::of_host(file);
        }
        let inside = shipped::libraries();
        if !inside.is_empty() {
            return Self::inside(inside, &platforms);
        }
        let Some(source) = project.source() else {
            if !platforms.is_empty() {
                bail!("--platforms needs Brinell's source to compile, or a program that holds the libraries");
            }
            return Self::of_host(&beside_this_program()?);
        };
        if platforms.is_empty()
            && let Some(built) = project.built()
            && let platform = Platform::host()?
            && let Some(bytes) = compile::linked(project, source, platform, built)?
        {
            return Ok(Self { binaries: vec![Binary::new(platform, bytes)] });
        }
        let platforms = if platforms.is_empty() { vec![Platform::host()?] } else { platforms };
        toolchain::check_installed(source, &platforms)?;
        let build = |platform: Platform| Ok(Binary::new(platform, compile::platform(project, source, platform)?));
        Ok(Self { binaries: platforms.into_iter().map(build).collect::<Result<Vec<_>>>()? })
    }

    /// A library of these binaries.
    pub fn of(binaries: Vec<Binary>) -> Self {
        Self { binaries }
    }

    /// One binary for each platform.
    pub fn binaries(&self) -> &[Binary] {
        &self.binaries
    }

    /// A line for each binary: platform, size, and what it needs.
    pub fn describe(&self) -> Vec<String> {
        self.binaries.iter().map(Binary::describe).collect()
    }

    fn of_host(path: &Path) -> Result<Self> {
        let bytes = fs::read(path).with_context(|| path.display().to_string())?;
        Ok(Self { binaries: vec![Binary::new(Platform::host()?, bytes)] })
    }

    /// Those among the files inside the program that were asked for; all of them where nothing was.
    fn inside(files: &[(&str, &[u8])], platforms: &[Platform]) -> Result<Self> {
        let named = |file: &str| Platform::named(file.split('.').next().unwrap_or_default());
        let mut binaries = Vec::new();
        for (file, bytes) in files {
            let platform = named(file)?;
            if platforms.is_empty() || platforms.contains(&platform) {
                binaries.push(Binary::new(platform, bytes.to_vec()));
            }
        }
        if let Some(lacking) = platforms.iter().find(|wanted| !binaries.iter().any(|b| b.platform == **wanted)) {
            let known = files.iter().map(|(file, _)| file.split('.').next().unwrap_or_default()).collect::<Vec<_>>();
            bail!("platform {}: this program holds {}", lacking.name, known.join(", "));
        }
        Ok(Self { binaries })
    }
}

impl Binary {
    /// A library for this platform.
    pub fn new(platform: Platform, bytes: Vec<u8>) -> Self {
        Self { platform, bytes, compressed: OnceLock::new() }
    }

    /// The file as archives hold it.
    pub fn compressed(&self) -> Result<Compressed, ArchiveError> {
        if let Some(done) = self.compressed.get() {
            return Ok(done.clone());
        }
        let done = Compressed::executable(&self.bytes)?;
        Ok(self.compressed.get_or_init(|| done).clone())
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
        format!("{}: {size:.0} KiB{needs}", self.platform.name)
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_the_libraries_inside_a_program_those_asked_for_are_packed() {
        let files: [(&str, &[u8]); 2] = [("linux64.so", b"l"), ("win64.dll", b"w")];
        let packed = |names: &[&str]| {
            let found = Library::inside(&files, &Platform::listed(names).unwrap())?;
            anyhow::Ok(found.binaries.iter().map(|binary| binary.platform.name).collect::<Vec<_>>())
        };
        assert_eq!(packed(&[]).unwrap(), ["linux64", "win64"]);
        assert_eq!(packed(&["win64"]).unwrap(), ["win64"]);
        let message = packed(&["win64", "darwin64"]).unwrap_err().to_string();
        assert_eq!(message, "platform darwin64: this program holds linux64, win64");
    }
}
