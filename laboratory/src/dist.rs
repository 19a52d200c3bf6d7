//! The command `dist`: what users install, made on one machine for all. For each platform a wheel and an archive of the
//! same program, with the model libraries of all these platforms inside.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use flate2::{Compression, write::GzEncoder};
use fmu_build::package::{Archive, Choice, Library};
use fmu_build::platforms::{Platform, Toolchain};
use fmu_build::shared::{Project, Python, shipped, whole_file};
use zip::ZipArchive;

/// The wheels' maker, exact, so that equal source gives equal bytes.
const REQUIREMENTS: &str = "maturin==1.16.0\n";
/// 1980-01-01, the oldest date that zip knows.
const DATE: &str = "315532800";
/// What goes along with the program.
const FILES: [&str; 5] =
    ["README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE", "fmu-build/assets/third-party-program.txt"];

/// The command: libraries, wheels and archives of these platforms into `folder`, of all where none is named.
pub fn command(project: &Project, platforms: &[String], only_libraries: bool, folder: &Path) -> Result<()> {
    let source = project.source().context("wheels are made of Brinell's source, which is not there")?;
    let names = if platforms.is_empty() { vec!["all".to_owned()] } else { platforms.to_vec() };
    let libraries = libraries(project, &names, &folder.join("libraries"))?;
    if only_libraries {
        return Ok(());
    }
    let python = Python::prepare_from(project, "dist-python", REQUIREMENTS)?;
    for platform in Platform::listed(&names)? {
        let wheel = wheel(project, source, platform, &libraries, &python, folder)?;
        println!("{}: {} bytes", wheel.display(), fs::metadata(&wheel)?.len());
        let archive = archive(source, platform, &wheel, folder)?;
        println!("{}: {} bytes", archive.display(), fs::metadata(&archive)?.len());
    }
    Ok(())
}

/// Writes the library of each of these platforms, and no other, under its platform's name.
fn libraries(project: &Project, platforms: &[String], folder: &Path) -> Result<PathBuf> {
    let library = Library::obtain(project, &Choice { file: None, platforms: platforms.to_vec() })?;
    if folder.exists() {
        fs::remove_dir_all(folder)?;
    }
    for (binary, line) in library.binaries().iter().zip(library.describe()) {
        let file = folder.join(binary.platform.file());
        whole_file::write_if_new(&file, &binary.bytes)?;
        println!("{line}");
    }
    Ok(std::path::absolute(folder)?)
}

/// Makes a platform's wheel and gives its path.
fn wheel(
    project: &Project,
    source: &Path,
    platform: Platform,
    libraries: &Path,
    python: &Python,
    folder: &Path,
) -> Result<PathBuf> {
    let growing = whole_file::folder_in(folder)?;
    let target = match platform.targets {
        [one] => one.triple,
        // maturin's name for both kinds of Mac in one file.
        _ => "universal2-apple-darwin",
    };
    let mut command = Command::new(python.interpreter());
    command
        .current_dir(source)
        .args(["-m", "maturin", "build", "--release", "--locked", "--target", target, "--out"])
        .arg(std::path::absolute(growing.path())?)
        .env("BRINELL_LIBRARIES", libraries)
        .env("SOURCE_DATE_EPOCH", DATE);
    if platform.extension == "so" {
        command.args(["--compatibility", "manylinux2014"]);
    }
    for target in platform.targets {
        Toolchain::new(project, source, *target, false)?.set_up(&mut command);
    }
    let status = command.status().context("cannot start maturin")?;
    if !status.success() {
        bail!("{}: no wheel ({status}); maturin's messages are above", platform.name);
    }
    let made = fs::read_dir(growing.path())?.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>>>()?;
    let [wheel] = &made[..] else { bail!("{}: maturin made {} files", platform.name, made.len()) };
    whole_file::take_out(wheel, folder)
}

/// Packs the program of a wheel with what belongs to it: a zip file for Windows, else a compressed tar file.
fn archive(source: &Path, platform: Platform, wheel: &Path, folder: &Path) -> Result<PathBuf> {
    let (program, bytes) = program_of(wheel)?;
    let top = format!("brinell-{}-{}", env!("CARGO_PKG_VERSION"), platform.name);
    let mut files = vec![(program, bytes)];
    for file in FILES {
        let path = source.join(file);
        let name = path.file_name().unwrap_or(OsStr::new(file)).to_string_lossy().into_owned();
        files.push((name, fs::read(&path).with_context(|| path.display().to_string())?));
    }
    for (file, text) in shipped::scenes().filter_map(shipped::files_of).flatten() {
        files.push((format!("scenes/{file}"), text.as_bytes().to_vec()));
    }
    if platform.extension == "dll" {
        let mut zip = Archive::default();
        files.into_iter().try_for_each(|(name, bytes)| zip.add(format!("{top}/{name}"), bytes))?;
        let path = folder.join(format!("{top}.zip"));
        whole_file::write(&path, zip.to_zip()?)?;
        return Ok(path);
    }
    let path = folder.join(format!("{top}.tar.gz"));
    whole_file::write_with(&path, |out| {
        let mut tar = tar::Builder::new(GzEncoder::new(out, Compression::best()));
        for (name, bytes) in &files {
            let mut header = tar::Header::new_ustar();
            header.set_size(bytes.len() as u64);
            header.set_mode(if name == "brinell" { 0o755 } else { 0o644 });
            header.set_mtime(DATE.parse()?);
            tar.append_data(&mut header, format!("{top}/{name}"), &bytes[..])?;
        }
        Ok(tar.into_inner()?.finish()?.flush()?)
    })?;
    Ok(path)
}

/// Name and bytes of the program in a wheel.
fn program_of(wheel: &Path) -> Result<(String, Vec<u8>)> {
    let mut zip = ZipArchive::new(File::open(wheel)?)?;
    let names = zip.file_names().filter_map(Result::ok).map(|name| name.into_owned()).collect::<Vec<_>>();
    let entry = names.into_iter().find(|name| name.contains(".data/scripts/"));
    let entry = entry.with_context(|| format!("{}: no program in it", wheel.display()))?;
    let mut bytes = Vec::new();
    zip.by_name(&entry)?.read_to_end(&mut bytes)?;
    let name = entry.rsplit('/').next().unwrap_or_default().to_owned();
    ensure!(name.starts_with("brinell"), "{}: the program is {name:?}", wheel.display());
    Ok((name, bytes))
}
