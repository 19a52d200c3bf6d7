//! Finds modules that import each other, straight or around others.

use std::collections::{BTreeMap, BTreeSet};

use super::methods::Methods;
use super::reader::{File, Path, Use, named, uses};

/// Modules by name, those of one folder; the module of the folder itself has none.
type Graph = BTreeMap<String, BTreeSet<String>>;

/// A cycle of each folder below `top` that has one. `files` are without tests.
pub(super) fn cycles(top: &[String], files: &[File]) -> Vec<String> {
    let inside = files.iter().filter(|(path, _)| path.starts_with(top)).map(|(path, _)| path);
    let folders = inside.flat_map(|path| (top.len()..=path.len()).map(|depth| &path[..depth]));
    let methods = Methods::of(files);
    let found = folders.collect::<BTreeSet<_>>().into_iter().filter_map(|folder| {
        let cycle = cycle(&graph(folder, folder == top, files, &methods))?;
        let name = [&["crate".to_owned()], folder].concat().join("::");
        let shown = cycle.iter().chain(cycle.first()).map(|module| if module.is_empty() { &name } else { module });
        Some(format!("in {name}: {}", shown.map(String::as_str).collect::<Vec<_>>().join(" -> ")))
    });
    found.collect()
}

/// Which modules of a folder each of them names, or calls by a method of a type that both have a part of.
///
/// A module and those in its folder may name each other; not so at the top, whose own file counts as one of its modules
/// if `counts_own`.
fn graph(folder: &[String], counts_own: bool, files: &[File], methods: &Methods) -> Graph {
    let below = |path: &Path| path.strip_prefix(folder).map(|path| path.first().cloned().unwrap_or_default());
    let known: BTreeSet<String> = files.iter().filter_map(|(path, _)| below(path)).collect();
    let own_uses: Vec<Use> = files.iter().filter(|(path, _)| path == folder).flat_map(|(_, text)| uses(text)).collect();
    let own_path = [&["crate".to_owned()], folder].concat();
    let source = |brought: &Use| {
        let path = brought.path.strip_prefix(&own_path[..]).unwrap_or(&brought.path);
        path.first().filter(|module| known.contains(*module)).cloned()
    };
    // An item of the folder's own file is one that it defines or one that it brings from a module.
    let home = |name: String| match own_uses.iter().find(|brought| brought.name == name) {
        _ if known.contains(&name) => name,
        Some(brought) => source(brought).unwrap_or_default(),
        None => String::new(),
    };
    let mut graph = Graph::new();
    for (path, text) in files {
        let Some(from) = below(path).filter(|from| counts_own || !from.is_empty()) else { continue };
        let all = [named(path, text), methods.called(folder, text)].concat();
        let mut named: Vec<String> = all.iter().filter_map(below).map(home).collect();
        if from.is_empty() {
            named.extend(own_uses.iter().filter(|brought| !brought.is_public).filter_map(source));
        }
        graph.entry(from.clone()).or_default().extend(named.into_iter().filter(|to| *to != from));
    }
    graph
}

/// The first cycle of a graph, if there is one.
fn cycle(graph: &Graph) -> Option<Vec<String>> {
    fn search<'a>(
        graph: &'a Graph,
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
