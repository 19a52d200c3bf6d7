//! Lists what is compiled into the program: the scenes of the repository and, where `BRINELL_LIBRARIES` names a folder,
//! the model libraries in it. With them the program needs neither Rust nor this source. And tells it by which code it
//! computes contact maps.

mod map_sources;

use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn main() -> Result<(), Box<dyn Error>> {
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?).join("..");
    let mut text = constant("SCENES", "str", &files(&root.join("scenes"), &["toml", "csv"])?)?;
    println!("cargo::rerun-if-env-changed=BRINELL_LIBRARIES");
    let libraries = match env::var_os("BRINELL_LIBRARIES") {
        Some(folder) => files(Path::new(&folder), &["so", "dll", "dylib"])?,
        None => Vec::new(),
    };
    if libraries.is_empty() && env::var_os("BRINELL_LIBRARIES").is_some() {
        let message = "BRINELL_LIBRARIES names a folder without libraries; `cargo lab dist --only-libraries` fills one";
        return Err(message.into());
    }
    // Only a program that compiles the library needs to know where its source is.
    let source = if libraries.is_empty() { fs::canonicalize(&root)? } else { PathBuf::new() };
    println!("cargo::rustc-env=BRINELL_SOURCE={}", source.display());
    text += &constant("LIBRARIES", "[u8]", &libraries)?;
    println!("cargo::rustc-env=BRINELL_MAP_SOURCES={}", map_sources::fingerprint(&root)?);
    for source in map_sources::SOURCES {
        println!("cargo::rerun-if-changed={}", root.join(source).display());
    }
    fs::write(PathBuf::from(env::var("OUT_DIR")?).join("shipped.rs"), text)?;
    Ok(())
}

/// The folder's files with one of these extensions, by name; the build is repeated when the folder changes.
fn files(folder: &Path, extensions: &[&str]) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).map_err(|error| format!("{}: {error}", folder.display()))? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extensions.iter().any(|&known| extension == known)) {
            files.push(fs::canonicalize(path)?);
        }
    }
    files.sort();
    Ok(files)
}

/// A list of names with contents: `include_str!` for text, else `include_bytes!`.
fn constant(name: &str, kind: &str, files: &[PathBuf]) -> Result<String, Box<dyn Error>> {
    let macro_name = if kind == "str" { "include_str" } else { "include_bytes" };
    let mut text = format!("const {name}: &[(&str, &{kind})] = &[\n");
    for file in files {
        let title = file.file_name().unwrap_or_default().to_string_lossy();
        writeln!(text, "    ({title:?}, {macro_name}!({:?})),", file.display().to_string())?;
    }
    text += "];\n";
    Ok(text)
}
