//! Reads what a Rust file imports, as far as the layers need it.

use std::collections::{BTreeMap, BTreeSet};

/// A module by its path within a layer; that of the layer's own file is empty.
pub(super) type Path = Vec<String>;

/// Modules of a layer that each of its files names, the file's own path first. `files` are paths and texts; tests in
/// files do not count.
pub(super) fn graph(layer: &str, files: &[(Path, String)]) -> BTreeMap<String, BTreeSet<String>> {
    let known: BTreeSet<&Path> = files.iter().map(|(path, _)| path).collect();
    let facade = files.iter().find(|(path, _)| path.is_empty()).map_or("", |(_, text)| text);
    let handed_on = handed_on(facade);
    let mut graph = BTreeMap::<String, BTreeSet<String>>::new();
    for (path, text) in files {
        let from = top(path);
        let own = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
        for name in named(layer, path, own) {
            // An item of the layer's own file, a module below it, or an item that the file hands on from one.
            let to = match name.first() {
                Some(first) if known.iter().any(|module| module.first() == Some(first)) => first.clone(),
                Some(first) => handed_on.get(first).cloned().unwrap_or_default(),
                None => continue,
            };
            if to != from {
                graph.entry(from.clone()).or_default().insert(to);
            }
        }
    }
    graph
}

/// The first cycle of a graph, if there is one.
pub(super) fn cycle(graph: &BTreeMap<String, BTreeSet<String>>) -> Option<Vec<String>> {
    fn search<'a>(
        graph: &'a BTreeMap<String, BTreeSet<String>>,
        at: &'a String,
        way: &mut Vec<&'a String>,
        done: &mut BTreeSet<&'a String>,
    ) -> Option<Vec<String>> {
        if let Some(start) = way.iter().position(|module| *module == at) {
            return Some(way[start..].iter().map(|module| (*module).clone()).collect());
        }
        if !done.insert(at) {
            return None;
        }
        way.push(at);
        let found = graph.get(at).into_iter().flatten().find_map(|next| search(graph, next, way, done));
        way.pop();
        found
    }
    let mut done = BTreeSet::new();
    graph.keys().find_map(|start| search(graph, start, &mut Vec::new(), &mut done))
}

fn top(path: &Path) -> String {
    path.first().cloned().unwrap_or_default()
}

/// Names that the layer's file hands on by `pub use module::…`, and the module of each.
fn handed_on(facade: &str) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for part in facade.split("pub use ").skip(1) {
        let statement = part.split(';').next().unwrap_or_default();
        let Some((module, names)) = statement.split_once("::") else { continue };
        for name in names.trim_matches(['{', '}']).split(',') {
            found.insert(name.trim().to_owned(), module.to_owned());
        }
    }
    found
}

/// Paths within the layer that a file names, by `super::` or by `crate::layer::`.
fn named(layer: &str, path: &Path, text: &str) -> Vec<Path> {
    let code: String = text.lines().map(|line| without_comment(line) + "\n").collect();
    let mut found = Vec::new();
    let mut keep = |base: &[String], rest: &str| {
        let names = rest.strip_prefix('{').map_or_else(|| vec![name_at(rest)], first_names);
        found.extend(names.into_iter().map(|name| [base, &[name]].concat()));
    };
    for (at, _) in code.match_indices("super::") {
        let before = &code[..at];
        // The later ones of `super::super::` are counted with the first. A file that is handed down names its parent.
        if before.ends_with("super::") || path.is_empty() {
            continue;
        }
        let (mut up, mut rest) = (0, &code[at..]);
        while let Some(further) = rest.strip_prefix("super::") {
            (up, rest) = (up + 1, further);
        }
        if let Some(depth) = path.len().checked_sub(up) {
            keep(&path[..depth], rest);
        }
    }
    for (at, prefix) in code.match_indices(&format!("crate::{layer}::")) {
        keep(&[], &code[at + prefix.len()..]);
    }
    if path.is_empty() {
        for line in code.lines().filter(|line| line.starts_with("use ") && !line.starts_with("use crate::")) {
            keep(&[], &line["use ".len()..]);
        }
    }
    found
}

/// Every name that follows `crate::`, alone or in braces, with its line; comments do not count.
pub(super) fn imports(text: &str) -> Vec<(usize, String)> {
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
