//! The layers import in one direction only: a module names, by `crate::…`, none that stands to its right; and a crate of the
//! workspace depends only on those that it may know.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};

/// The order of the layers; each may import those before it.
const ORDER: [&str; 8] = ["numerics", "scene", "geometry", "surface", "contact", "dynamics", "simulation", "recording"];
/// The crates of the workspace by folder, and those among them that each may depend on.
const CRATES: [(&str, &[&str]); 5] = [
    ("", &[]),
    ("crates/fmi", &["brinell"]),
    ("crates/analysis", &["brinell"]),
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
    let text = "use crate::scene::Scene; // crate::fmi2\nuse crate::{\n    contact::Law,\n    fmi2::{self, Status},\n};\n\
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

/// Every name that follows `crate::`, alone or in braces, with its line; comments do not count.
fn imports(text: &str) -> Vec<(usize, String)> {
    let code: String = text.lines().map(|line| without_comment(line) + "\n").collect();
    let mut found = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        let before = code[..at].chars().next_back();
        if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == '$') {
            continue;
        }
        let line = code[..at].matches('\n').count() + 1;
        let rest = &code[at + "crate::".len()..];
        match rest.strip_prefix('{') {
            Some(list) => found.extend(first_names(list).into_iter().map(|name| (line, name))),
            None => found.push((line, name_at(rest))),
        }
    }
    found
}

/// The first name of each path in a list that ends with its closing brace.
fn first_names(list: &str) -> Vec<String> {
    let (mut names, mut depth, mut start) = (Vec::new(), 0, true);
    for (at, c) in list.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => start = true,
            c if start && (c.is_alphabetic() || c == '_') => {
                names.push(name_at(&list[at..]));
                start = false;
            }
            _ => {}
        }
    }
    names
}

fn name_at(text: &str) -> String {
    text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

fn without_comment(line: &str) -> String {
    let mut quoted = false;
    let bytes = line.as_bytes();
    for (at, byte) in bytes.iter().enumerate() {
        match byte {
            b'"' if at == 0 || bytes[at - 1] != b'\\' => quoted = !quoted,
            b'/' if !quoted && bytes.get(at + 1) == Some(&b'/') => return line[..at].to_owned(),
            _ => {}
        }
    }
    line.to_owned()
}
