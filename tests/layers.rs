//! The layers import in one direction only: a module names, by `crate::…`, none that stands to its right; and a crate
//! of the workspace depends only on those that it may know.
#![allow(clippy::unwrap_used)]

#[path = "layers/reader.rs"]
mod reader;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use reader::imports;

/// The order of the layers; each may import those before it.
const ORDER: [&str; 8] = ["numerics", "scene", "geometry", "surface", "contact", "dynamics", "simulation", "recording"];
/// The crates of the workspace by folder, and those among them that each may depend on.
const CRATES: [(&str, &[&str]); 8] = [
    ("", &[]),
    ("crates/fmi", &["brinell"]),
    ("crates/eigen", &[]),
    ("crates/spectrum", &[]),
    ("crates/analysis", &["brinell", "brinell-eigen", "brinell-spectrum"]),
    ("crates/contact-bench", &["brinell"]),
    ("fmu-build", &["brinell", "brinell-analysis"]),
    ("crates/studies", &["brinell", "brinell-analysis", "fmu-build"]),
];

#[test]
fn every_crate_depends_only_on_those_it_may_know() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |folder: &str| -> toml::Table {
        let text = fs::read_to_string(root.join(folder).join("Cargo.toml")).unwrap();
        text.parse().unwrap()
    };
    let members = fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().file_name());
    let members = members.map(|name| format!("crates/{}", name.to_string_lossy())).chain(["fmu-build".to_owned()]);
    for member in members {
        assert!(CRATES.iter().any(|(folder, _)| **folder == member), "{member} has no place in this test");
    }
    let ours: Vec<String> = CRATES.iter().map(|c| read(c.0)["package"]["name"].as_str().unwrap().to_owned()).collect();
    for (folder, known) in CRATES {
        let manifest = read(folder);
        for (name, _) in manifest["dependencies"].as_table().unwrap() {
            assert!(!ours.contains(name) || known.contains(&name.as_str()), "{folder} depends on {name}");
        }
        let kinds = manifest.get("lib").and_then(|lib| lib.get("crate-type")).and_then(|kinds| kinds.as_array());
        let dynamic = kinds.is_some_and(|kinds| kinds.iter().any(|kind| kind.as_str() == Some("cdylib")));
        assert_eq!(dynamic, folder == "crates/fmi", "{folder}: the FMI interface is the only dynamic library");
    }
}

#[test]
fn no_layer_imports_backwards() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut backwards = Vec::new();
    for layer in ORDER {
        let files = files_of(&source, layer);
        assert!(!files.is_empty(), "layer {layer} has no file: the order in this test is out of date");
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            for (line, import) in imports(&text) {
                if !allowed(layer, &import) {
                    backwards.push(format!("{}:{line}: {layer} imports {import}", file.display()));
                }
            }
        }
    }
    assert!(backwards.is_empty(), "\n{}", backwards.join("\n"));
}

#[test]
fn no_module_of_a_layer_imports_one_that_imports_it() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut cycles = Vec::new();
    for layer in ORDER {
        let files: Vec<_> = files_of(&source, layer).into_iter().filter_map(|file| module(&source, &file)).collect();
        let parents = files.iter().flat_map(|(path, _)| (0..path.len()).map(|depth| path[..depth].to_vec()));
        for parent in parents.collect::<BTreeSet<_>>() {
            let name = [&[layer.to_owned()], &parent[..]].concat().join("::");
            let below = files.iter().filter_map(|(path, text)| {
                // A module and those in its folder may name each other; those of the folder one another only one way.
                let path = path.strip_prefix(&parent[..]).filter(|path| parent.is_empty() || !path.is_empty())?;
                Some((path.to_vec(), text.clone()))
            });
            let cycle = reader::cycle(&reader::graph(&name, &below.collect::<Vec<_>>()));
            cycles.extend(cycle.map(|cycle| format!("in {name}: {}", cycle.join(" -> "))));
        }
    }
    assert!(cycles.is_empty(), "\n{}", cycles.join("\n"));
}

/// Path of a file's module within its layer, and its text; none for files of tests.
fn module(source: &Path, file: &Path) -> Option<(reader::Path, String)> {
    let inside = file.strip_prefix(source).unwrap().with_extension("");
    let mut path: reader::Path = inside.iter().skip(1).map(|part| part.to_string_lossy().into_owned()).collect();
    if path.last().is_some_and(|name| name == "mod") {
        path.pop();
    }
    let is_test = path.last().is_some_and(|name| name == "tests" || name == "trees");
    (!is_test).then(|| (path, fs::read_to_string(file).unwrap()))
}

#[test]
fn the_reader_of_cycles_finds_one_that_is_there() {
    let file = |path: &str, text: &str| {
        let path: reader::Path = path.split('/').filter(|part| !part.is_empty()).map(str::to_owned).collect();
        (path, text.to_owned())
    };
    let good = [
        file("", "pub mod a;\npub use b::{B, C};\npub struct Own;"),
        file("a", "use super::{B, Own};\nuse crate::other::a;"),
        file("b", "//! `super::a`\nfn f() {}\n#[cfg(test)]\nmod tests {\n    use super::super::a;\n}"),
        file("a/part", "use super::super::b::f;\nuse super::g;"),
    ];
    assert_eq!(reader::cycle(&reader::graph("layer", &good)), None);
    for bad in [file("b", "use super::a::A;"), file("b", "use crate::layer::{c, a};"), file("b", "use super::Own;")] {
        let mut files = good.clone();
        let closes = bad.1.contains("Own");
        files[2] = bad;
        if closes {
            files[0].1 += "\nuse a::A;";
        }
        assert!(reader::cycle(&reader::graph("layer", &files)).is_some(), "{files:?}");
    }
}

#[test]
fn every_module_of_the_crate_has_a_place_in_the_order() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/lib.rs");
    let text = fs::read_to_string(source).unwrap();
    for line in text.lines() {
        let Some(module) = line.trim_start_matches("pub ").strip_prefix("mod ") else { continue };
        let module = module.trim_end_matches(';');
        assert!(ORDER.contains(&module), "module {module} is in no layer");
    }
}

#[test]
fn the_reader_of_imports_sees_what_it_should() {
    let text = "use crate::scene::Scene; // crate::fmi2\nuse crate::{\n    contact::Law,\n    fmi2::{self, \
                Status},\n};\n\
                //! [`crate::fmi2`]\nlet x = crate::dynamics::run();\npub(crate) use super::y;\nuse brinell::z;\n\
                let s = \"// no comment\"; crate::geometry::f();\n";
    let found: Vec<_> = imports(text);
    let expected = [(1, "scene"), (2, "contact"), (2, "fmi2"), (7, "dynamics"), (10, "geometry")];
    assert_eq!(found, expected.map(|(line, name)| (line, name.to_owned())));
    assert!(!allowed("contact", "dynamics"));
    assert!(!allowed("simulation", "analysis"));
    assert!(allowed("simulation", "scene"));
    assert!(allowed("scene", "scene"));
}

fn allowed(layer: &str, import: &str) -> bool {
    let place = |name: &str| ORDER.iter().position(|other| *other == name);
    match (place(layer), place(import)) {
        _ if layer == import => true,
        (Some(layer), Some(import)) => import < layer,
        // What is no layer is an item of the crate's root: there should be none to import.
        _ => false,
    }
}

fn files_of(source: &Path, layer: &str) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let single = source.join(layer).with_extension("rs");
    if single.is_file() {
        files.push(single);
    }
    let mut folders = vec![source.join(layer)];
    while let Some(folder) = folders.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        for path in entries.map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}
