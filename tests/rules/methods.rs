//! Finds where the methods stand that code calls: with a type's `impl` blocks in several files, one calls another
//! without naming its module.

use std::collections::{BTreeMap, BTreeSet};

use super::lengths::name;
use super::reader::{File, Path, without_comments};

/// Modules of methods, by type and method.
pub(super) struct Methods(BTreeMap<(String, String), Path>);

/// An `impl` block of a formatted file.
struct Block<'t> {
    of: String,
    is_inherent: bool,
    lines: Vec<&'t str>,
}

impl Methods {
    /// Those of some files, which are without tests.
    pub(super) fn of(files: &[File]) -> Self {
        let mut methods = BTreeMap::new();
        for (path, text) in files {
            for block in blocks(&without_comments(text)).into_iter().filter(|block| block.is_inherent) {
                let of_block = block.lines.iter().filter(|line| line.starts_with("    ") && !line.starts_with("     "));
                methods.extend(of_block.filter_map(|line| Some(((block.of.clone(), name(line)?), path.clone()))));
            }
        }
        Self(methods)
    }

    /// The modules of the methods that a file's types call on themselves, and of those that it calls on anything else
    /// and that exactly one module of a folder has.
    ///
    /// A method of the standard library or of another folder may have the same name. So the file has to name the type,
    /// unless the name is of several words and no other module of the crate has it.
    pub(super) fn called(&self, folder: &[String], text: &str) -> Vec<Path> {
        let text = without_comments(text);
        let mut found = Vec::new();
        for block in blocks(&text) {
            let code = block.lines.join("\n");
            for keyword in ["self.", "Self::"] {
                found.extend(names(&code, keyword).filter_map(|name| self.0.get(&(block.of.clone(), name)).cloned()));
            }
        }
        let words: BTreeSet<&str> = text.split(|c: char| !c.is_alphanumeric() && c != '_').collect();
        found.extend(names(&text, ".").filter_map(|name| {
            let name = &name;
            let homes = || self.0.iter().filter(move |((_, known), _)| known == name);
            let inside = || homes().filter(move |(_, path)| path.starts_with(folder));
            let ((_, path), module) = (inside().next()?, folder.len());
            let is_one = inside().all(|(_, other)| other.get(module) == path.get(module));
            let is_known = inside().any(|((of, _), _)| words.contains(&**of));
            let is_own = name.contains('_') && homes().all(|(_, path)| path.starts_with(folder));
            (is_one && (is_known || is_own)).then(|| path.clone())
        }));
        found
    }
}

/// The names that are called right after a keyword.
fn names(code: &str, keyword: &str) -> impl Iterator<Item = String> {
    code.split(keyword).skip(1).filter_map(|rest| {
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_')?;
        rest[end..].starts_with(['(', ':']).then(|| rest[..end].to_owned())
    })
}

fn blocks(text: &str) -> Vec<Block<'_>> {
    let mut blocks = Vec::new();
    let mut lines = text.lines();
    while let Some(first) = lines.next() {
        let Some(mut head) = first.strip_prefix("impl").map(str::to_owned) else { continue };
        while !head.contains('{')
            && let Some(more) = lines.next()
        {
            head.push_str(more);
        }
        let head = after_parameters(head.split('{').next().unwrap_or_default().trim());
        let (is_inherent, of) = head.split_once(" for ").map_or((true, head), |(_, of)| (false, of));
        let of = of.trim().split(['<', ' ']).next().unwrap_or_default().rsplit("::").next().unwrap_or_default();
        let own =
            if first.ends_with('}') { Vec::new() } else { lines.by_ref().take_while(|line| *line != "}").collect() };
        blocks.push(Block { of: of.to_owned(), is_inherent, lines: own });
    }
    blocks
}

/// What follows the parameters `<…>` with which an `impl` may begin.
fn after_parameters(head: &str) -> &str {
    let mut depth = 0;
    let closed = head.char_indices().find(|(at, letter)| {
        depth += match letter {
            '<' => 1,
            // Not that of an arrow.
            '>' if !head[..*at].ends_with(['-', '=']) => -1,
            _ => 0,
        };
        depth == 0
    });
    if head.starts_with('<') { closed.map_or(head, |(at, _)| &head[at + 1..]).trim() } else { head }
}
