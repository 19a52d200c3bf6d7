//! The licences of all crates that are compiled into the model library stand in `fmu-build/assets/third-party.txt`,
//! which every FMU holds; those of the program in `third-party-program.txt`, which goes along with it. After a change
//! of dependencies: `BLESS=1 cargo test --workspace --test fmu licenses`.
#![allow(clippy::unwrap_used)]

use crate::common;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use serde_json::Value;

const HEAD: &str = "\
What else is compiled into the {what}, and under which licence. Where a choice is offered, MIT is taken.

Rust's standard library: MIT or Apache-2.0, copyright the Rust project's contributors, https://github.com/rust-lang/rust
LLVM's libunwind, where the library was linked through zig: Apache-2.0 with LLVM exception, https://llvm.org
";

fn cargo(arguments: &[&str]) -> Vec<u8> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let output = Command::new(cargo).current_dir(common::root()).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout
}

fn metadata() -> Value {
    serde_json::from_slice(&cargo(&["metadata", "--locked", "--format-version", "1"])).unwrap()
}

/// Names and versions of all packages with the features that one of ours asks for. The metadata has those of the whole
/// workspace.
fn with_its_features(ours: &str) -> BTreeSet<String> {
    let options = ["--edges", "normal", "--target", "all", "--prefix", "none", "--format", "{p}"];
    let tree = cargo(&[&["tree", "--locked", "--package", ours], &options[..]].concat());
    let words = |line: &str| line.split(' ').take(2).collect::<Vec<_>>().join(" v").replace("vv", "v");
    String::from_utf8(tree).unwrap().lines().map(words).collect()
}

fn is_macro(package: &Value) -> bool {
    let targets = package["targets"].as_array().unwrap();
    targets.iter().any(|target| target["kind"].as_array().unwrap().iter().any(|kind| kind == "proc-macro"))
}

/// The packages that one of ours needs at run time, on any platform.
fn needed<'a>(metadata: &'a Value, ours: &str) -> Vec<&'a Value> {
    let by_id = |list: &'static str| -> BTreeMap<&str, &Value> {
        let list = if list == "nodes" { &metadata["resolve"]["nodes"] } else { &metadata[list] };
        list.as_array().unwrap().iter().map(|item| (item["id"].as_str().unwrap(), item)).collect()
    };
    let (packages, nodes) = (by_id("packages"), by_id("nodes"));
    let root = packages.values().find(|package| package["name"] == ours).unwrap()["id"].as_str().unwrap();
    let chosen = with_its_features(ours);
    let is_chosen = |package: &Value| {
        chosen.contains(&format!("{} v{}", package["name"].as_str().unwrap(), package["version"].as_str().unwrap()))
    };
    let (mut found, mut open) = (BTreeSet::new(), vec![root]);
    while let Some(id) = open.pop() {
        for dependency in nodes[id]["deps"].as_array().unwrap() {
            let next = dependency["pkg"].as_str().unwrap();
            let runs = dependency["dep_kinds"].as_array().unwrap().iter().any(|kind| kind["kind"].is_null());
            let runs = runs && next != root && !is_macro(packages[next]) && is_chosen(packages[next]);
            if runs && found.insert(next) {
                open.push(next);
            }
        }
    }
    // What comes from nowhere else is ours.
    let mut found: Vec<_> = found.into_iter().map(|id| packages[id]).filter(|p| !p["source"].is_null()).collect();
    found.sort_by_key(|package| (package["name"].as_str().unwrap(), package["version"].as_str().unwrap()));
    found
}

/// The files with the licence that is taken: that of MIT where there is one, else all.
fn texts(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<_> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().to_uppercase();
    files.retain(|path| {
        path.is_file() && ["LICENSE", "LICENCE", "COPYING", "NOTICE"].iter().any(|start| name(path).starts_with(start))
    });
    // Some have the terms among their authors.
    let authors = folder.join("AUTHORS");
    if files.is_empty() && fs::read_to_string(&authors).is_ok_and(|text| text.contains("Permission is hereby granted"))
    {
        files.push(authors);
    }
    files.sort();
    if files.iter().any(|path| name(path).contains("MIT")) {
        files.retain(|path| name(path).contains("MIT") || name(path).starts_with("NOTICE"));
    }
    files
}

/// A package's licence: its own files, those of another package of the same repository, or, of a package that came
/// without any, the terms of MIT with its authors' names.
fn texts_of(package: &Value, all: &Value) -> Vec<String> {
    let of = |package: &Value| texts(Path::new(package["manifest_path"].as_str().unwrap()).parent().unwrap());
    let is_sibling = |one: &Value| {
        package["repository"].is_string() && ["repository", "license"].iter().all(|key| one[*key] == package[*key])
    };
    let siblings = all["packages"].as_array().unwrap().iter().filter(|one| is_sibling(one));
    if let Some(files) = std::iter::once(package).chain(siblings).map(of).find(|found| !found.is_empty()) {
        return files.iter().map(|file| fs::read_to_string(file).unwrap().replace("\r\n", "\n")).collect();
    }
    let (name, license) = (&package["name"], package["license"].as_str().unwrap());
    assert!(license.split([' ', '/']).any(|offered| offered == "MIT"), "{name}: no text of its licence, {license}");
    let authors: Vec<_> = package["authors"]
        .as_array()
        .unwrap()
        .iter()
        .map(|name| name.as_str().unwrap().trim_end_matches(" <>"))
        .collect();
    let authors = if authors.is_empty() { "its authors".to_owned() } else { authors.join(", ") };
    let ours = fs::read_to_string(common::root().join("LICENSE-MIT")).unwrap();
    let terms = &ours[ours.find("Permission is hereby granted").unwrap()..];
    vec![format!("MIT License (the package came without a text)\n\nCopyright (c) {authors}\n\n{terms}")]
}

fn written(ours: &str, what: &str) -> String {
    let metadata = metadata();
    let mut by_text: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut page = HEAD.replace("{what}", what);
    for package in needed(&metadata, ours) {
        let field = |name: &str| package[name].as_str().unwrap_or_default();
        let shown = format!("{} {}", field("name"), field("version"));
        assert!(!field("license").is_empty(), "{shown}: no licence is named");
        writeln!(page, "{shown}: {}, {}", field("license").replace('/', " OR "), field("repository")).unwrap();
        for text in texts_of(package, &metadata) {
            by_text.entry(text.trim().to_owned()).or_default().push(shown.clone());
        }
    }
    let mut sections: Vec<_> = by_text.into_iter().map(|(text, names)| (names, text)).collect();
    sections.sort();
    for (names, text) in sections {
        write!(page, "\n{}\n{}\n\n{text}\n", "=".repeat(80), names.join(", ")).unwrap();
    }
    page
}

fn is_listed(ours: &str, what: &str, file: &str) -> String {
    let file = common::root().join("fmu-build/assets").join(file);
    let written = written(ours, what);
    common::is_committed(&file, &written);
    written
}

#[test]
fn every_crate_inside_the_library_is_listed_with_its_licence() {
    let written = is_listed("brinell-fmi", "model library", "third-party.txt");
    assert!(written.contains("libm ") && written.contains("Permission is hereby granted"));
}

#[test]
fn every_crate_inside_the_program_is_listed_with_its_licence() {
    let written = is_listed("fmu-build", "program `brinell`", "third-party-program.txt");
    assert!(written.contains("clap ") && written.contains("Permission is hereby granted"));
}
