//! The layers import in one direction only: a module names none that stands to its right; in no crate of the list
//! `CRATES` do modules import each other; and a crate depends only on those that it may know. Files and functions are
//! as short as CONTRIBUTING.md asks.
#![allow(clippy::unwrap_used)]

mod cycles;
mod lengths;
mod methods;
mod reader;

use std::fs;
use std::path::{Path, PathBuf};

use brinell_tests::files_below;
use cycles::cycles;
use reader::imports;

/// The order of the layers; each may import those before it.
const ORDER: [&str; 8] = ["numerics", "scene", "geometry", "surface", "contact", "dynamics", "simulation", "recording"];
/// The crates by folder, those of tests in `tests` aside, and those among them that each may depend on.
const CRATES: [(&str, &[&str]); 12] = [
    ("", &[]),
    ("crates/scene-file", &["brinell"]),
    ("crates/fmi", &["brinell"]),
    ("crates/eigen", &[]),
    ("crates/spectrum", &[]),
    ("crates/analysis", &["brinell", "brinell-eigen", "brinell-spectrum"]),
    ("fmu-build", &["brinell", "brinell-analysis", "brinell-scene-file"]),
    ("crates/cargo-fmu", &["brinell-fmi", "fmu-build"]),
    ("laboratory", &["brinell", "brinell-analysis", "brinell-fmi", "brinell-host", "brinell-scene-file", "fmu-build"]),
    ("tests/adversary/oracle", &[]),
    ("tests/fuzz", &["brinell", "brinell-analysis", "brinell-fmi", "brinell-scene-file", "brinell-tests"]),
    ("tests/host", &[]),
];
/// Tables of a manifest that name packages.
const ALL_KINDS: [&str; 3] = ["dependencies", "dev-dependencies", "build-dependencies"];

#[test]
fn every_crate_depends_only_on_those_it_may_know() {
    let root = brinell_tests::root();
    let read = |folder: &str| -> toml::Table {
        let text = fs::read_to_string(root.join(folder).join("Cargo.toml")).unwrap();
        text.parse().unwrap()
    };
    let oracle = read("tests/adversary/oracle");
    let depends = ALL_KINDS.into_iter().find(|kind| oracle.contains_key(*kind));
    assert_eq!(depends, None, "the oracle depends on nothing");
    let members = fs::read_dir(root.join("crates")).unwrap().map(|entry| entry.unwrap().file_name());
    let members = members
        .map(|name| format!("crates/{}", name.to_string_lossy()))
        .chain(["fmu-build", "laboratory"].map(str::to_owned));
    for member in members {
        assert!(CRATES.iter().any(|(folder, _)| **folder == member), "{member} is not in this test's list");
    }
    let name_of = |folder: &str| read(folder)["package"]["name"].as_str().unwrap().to_owned();
    let ours: Vec<String> = CRATES.iter().map(|c| c.0).chain(["tests"]).map(name_of).collect();
    for (folder, known) in CRATES {
        let manifest = read(folder);
        // Its tests may know more.
        for name in dependencies(&manifest, &["dependencies", "build-dependencies"]) {
            assert!(!ours.contains(&name) || known.contains(&name.as_str()), "{folder} depends on {name}");
        }
        let kinds = manifest.get("lib").and_then(|lib| lib.get("crate-type")).and_then(|kinds| kinds.as_array());
        let dynamic = kinds.is_some_and(|kinds| kinds.iter().any(|kind| kind.as_str() == Some("cdylib")));
        assert_eq!(dynamic, folder == "crates/fmi", "{folder}: the FMI interface is the only dynamic library");
    }
    let laboratory = name_of("laboratory");
    for folder in CRATES.iter().map(|c| c.0).chain(["tests"]) {
        let all = dependencies(&read(folder), &ALL_KINDS);
        assert!(!all.contains(&laboratory), "{folder}, or its tests, depends on {laboratory}");
    }
}

/// Names of the packages in a manifest's tables of these kinds, those for some systems only as well.
fn dependencies(manifest: &toml::Table, kinds: &[&str]) -> Vec<String> {
    let of_systems = manifest.get("target").and_then(|systems| systems.as_table()).into_iter().flatten();
    let tables = std::iter::once(manifest).chain(of_systems.filter_map(|(_, system)| system.as_table()));
    let found = tables.flat_map(|table| kinds.iter().filter_map(move |kind| table.get(*kind)?.as_table()));
    found.flatten().map(|(name, _)| name.clone()).collect()
}

#[test]
fn no_layer_imports_backwards() {
    let source = brinell_tests::root().join("src");
    let mut backwards = Vec::new();
    for layer in ORDER {
        let files = files_of(&source, layer);
        assert!(!files.is_empty(), "layer {layer} has no file: the order in this test is out of date");
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            for (line, import) in imports(&module(&source, &file), &text) {
                if !allowed(layer, &import) {
                    backwards.push(format!("{}:{line}: {layer} imports {import}", file.display()));
                }
            }
        }
    }
    assert!(backwards.is_empty(), "\n{}", backwards.join("\n"));
}

#[test]
fn no_module_imports_one_that_imports_it() {
    let root = brinell_tests::root();
    let mut found = Vec::new();
    for (folder, _) in CRATES {
        let source = Some(root.join(folder).join("src")).filter(|source| source.is_dir());
        // The oracle's files stand in its folder itself.
        let source = source.unwrap_or_else(|| root.join(folder));
        let files = files_below(&source, "rs").into_iter().map(|file| (module(&source, &file), read(&file))).collect();
        let files = reader::without_tests(files);
        assert!(!files.is_empty(), "{} has no file", source.display());
        // The order of the layers themselves is another test's.
        let layers = || ORDER.map(|layer| vec![layer.to_owned()]).to_vec();
        let tops = if folder.is_empty() { layers() } else { vec![Vec::new()] };
        found.extend(tops.iter().flat_map(|top| cycles(top, &files)).map(|cycle| format!("{folder}: {cycle}")));
    }
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

/// Path of a file's module from its crate's root.
fn module(source: &Path, file: &Path) -> reader::Path {
    let inside = file.strip_prefix(source).unwrap().with_extension("");
    let mut path: reader::Path = inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    let is_root = path.len() == 1 && matches!(&*path[0], "lib" | "main");
    if is_root || path.last().is_some_and(|name| name == "mod") {
        path.pop();
    }
    path
}

#[test]
fn the_reader_of_cycles_finds_one_that_is_there() {
    let file = |path: &str, text: &str| {
        let path: reader::Path = path.split('/').filter(|part| !part.is_empty()).map(str::to_owned).collect();
        (path, text.to_owned())
    };
    let good = [
        file("layer", "pub mod a;\npub(crate) use b::{B, C};\npub struct Own;\n#[cfg(test)]\nmod trees;"),
        file("layer/a", "use super::{B, Own};\nuse crate::other::a;\npub mod part;\nuse part::Part;"),
        file("layer/b", "//! `super::a`\nfn f() {}\n#[cfg(test)]\nmod tests {\n    use super::super::a;\n}"),
        file("layer/a/part", "use super::super::b::f;\nuse super::g;"),
        file("layer/trees", "use super::{a, b};"),
        file("other", "pub mod a;"),
        file("other/a", "use crate::layer::a::A;"),
    ];
    let found = |top: &[&str], more: &[(usize, &str)]| {
        let mut files = good.clone();
        for (index, text) in more {
            files[*index].1.insert_str(0, &format!("{text}\n"));
        }
        cycles(&top.iter().map(|name| name.to_string()).collect::<Vec<_>>(), &reader::without_tests(files.to_vec()))
    };
    assert_eq!(found(&["layer"], &[]), [""; 0]);
    for text in ["use super::a::A;", "use crate::layer::{c, a};", "use crate::{layer::a::{self, A}, other};"] {
        assert_eq!(found(&["layer"], &[(2, text)]), ["in crate::layer: a -> b -> a"], "{text}");
    }
    for text in ["use a::A;", "use self::a::A;"] {
        let cycle = "in crate::layer: crate::layer -> a -> crate::layer";
        assert_eq!(found(&["layer"], &[(0, text)]), [cycle], "{text}");
    }
    // What a folder's file only hands on comes from where it is.
    assert_eq!(found(&["layer"], &[(0, "pub use a::A;"), (2, "use super::A;")]), ["in crate::layer: a -> b -> a"]);
    assert_eq!(found(&[], &[]), ["in crate: layer -> other -> layer"]);
    // A method of a type whose other part stands in another module.
    let part =
        "impl<T: Fn(f64) -> f64> Own<T> {\n    pub fn of_b(&self) {\n        self.own();\n    }\n    fn own() {}\n}\n";
    let other = "impl Own {\n    fn of_a(&self) {\n        // self.nothing()\n        self.of_b();\n    }\n}\n";
    assert_eq!(found(&["layer"], &[(2, part)]), [""; 0]);
    assert_eq!(found(&["layer"], &[(2, part), (1, other), (2, "use super::a::A;")]), ["in crate::layer: a -> b -> a"]);
    // So is one that another type's value is asked for. That `a` uses `b` is known; only the call leads back.
    let asks = "fn g(own: &Own) {\n    own.of_a::<f64>();\n}";
    assert_eq!(found(&["layer"], &[(1, other), (2, asks)]), ["in crate::layer: a -> b -> a"]);
    // A single word has many homonyms: it counts where the type is named and no other module of the layer has it.
    let (word, asks) = (other.replace("of_a", "push"), asks.replace("of_a", "push"));
    let homonym = "impl Other {\n    fn push(&self) {}\n}\n";
    assert_eq!(found(&["layer"], &[(1, &word), (2, &asks)]), ["in crate::layer: a -> b -> a"]);
    assert_eq!(found(&["layer"], &[(1, &word), (2, &asks), (6, homonym)]), ["in crate::layer: a -> b -> a"]);
    assert_eq!(found(&["layer"], &[(1, &word), (2, &asks), (2, homonym)]), [""; 0]);
    assert_eq!(found(&["layer"], &[(1, &word), (2, &asks.replace("&Own", "&mut Vec<u8>"))]), [""; 0]);
    let back = part.replace("self.own()", "self.of_a()");
    assert_eq!(found(&["layer"], &[(2, &back), (1, other)]), ["in crate::layer: a -> b -> a"]);
}

#[test]
fn every_module_of_the_crate_is_in_the_order() {
    let source = brinell_tests::root().join("src/lib.rs");
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
                let s = \"// no comment\"; crate::geometry::f();\nuse super::super::simulation::State;\n\
                mod tests {\n    use super::super::other;\n    use super::super::super::recording;\n}\n\
                use super::super as root;\nuse crate as root;\n";
    let module = ["contact", "law"].map(str::to_owned).to_vec();
    let found: Vec<_> = imports(&module, text);
    let expected = [
        (1, "scene"),
        (2, "contact"),
        (2, "fmi2"),
        (7, "dynamics"),
        (8, "contact"),
        (10, "geometry"),
        (11, "simulation"),
        (13, "contact"),
        (14, "recording"),
        (16, ""),
        (17, ""),
    ];
    assert_eq!(found, expected.map(|(line, name)| (line, name.to_owned())));
    assert!(!allowed("contact", ""));
    assert!(!allowed("contact", "dynamics"));
    assert!(!allowed("simulation", "analysis"));
    assert!(allowed("simulation", "scene"));
    assert!(allowed("scene", "scene"));
}

#[test]
fn no_file_is_longer_than_400_lines_no_function_than_70_and_no_line_than_120_characters() {
    let root = brinell_tests::root();
    let folders = ["src", "crates", "fmu-build", "tests", "examples", "laboratory"];
    let files: Vec<_> = folders.iter().flat_map(|folder| files_below(&root.join(folder), "rs")).collect();
    assert!(files.len() > 500, "{} files", files.len());
    let mut long = Vec::new();
    for file in files {
        let text = read(&file);
        let lines = text.lines().count();
        let functions = lengths::functions(&text).into_iter().filter(|(_, lines)| *lines > 70);
        // Rust's formatter leaves comments and strings as they are.
        let wide = text.lines().zip(1..).filter(|(line, _)| line.chars().count() > 120);
        long.extend(wide.map(|(_, number)| format!("{}:{number}: more than 120 characters", file.display())));
        long.extend((lines > 400).then(|| format!("{}: {lines} lines", file.display())));
        long.extend(functions.map(|(name, lines)| format!("{}: {name} has {lines} lines", file.display())));
    }
    assert!(long.is_empty(), "\n{}", long.join("\n"));
}

#[test]
fn the_reader_of_lengths_sees_what_it_should() {
    let text = "pub(crate) fn first<T>() {\n    if true {\n    }\n}\nimpl A {\n    pub unsafe extern \"C\" fn \
                second(\n        a: i32,\n    ) -> i32 {\n        a\n    }\n    fn third(\n        a: i32,\n    \
                );\n}\n// a fn of\nfn fourth() {}\nfn fifth() {\n}\n";
    let expected = [("first", 4), ("second", 5), ("third", 3), ("fourth", 1), ("fifth", 2)];
    assert_eq!(lengths::functions(text), expected.map(|(name, lines)| (name.to_owned(), lines)));
}

fn allowed(layer: &str, import: &str) -> bool {
    let index = |name: &str| ORDER.iter().position(|other| *other == name);
    match (index(layer), index(import)) {
        _ if layer == import => true,
        (Some(layer), Some(import)) => import < layer,
        // What is no layer is an item of the crate's root: there should be none to import.
        _ => false,
    }
}

fn files_of(source: &Path, layer: &str) -> Vec<PathBuf> {
    let single = source.join(layer).with_extension("rs");
    let single = single.is_file().then_some(single);
    single.into_iter().chain(files_below(&source.join(layer), "rs")).collect()
}

fn read(file: &Path) -> String {
    fs::read_to_string(file).unwrap()
}
