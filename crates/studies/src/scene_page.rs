//! The page of the book that lists every key of a scene, made of the source that reads the file.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

/// Files of the source with tables and words of the scene; the doc comment of the first says what holds without a key.
const READER: &str = "crates/scene-file/src/tables/mod.rs";
const TABLES: &str = "crates/scene-file/src/tables";
const WORDS: [&str; 4] =
    ["src/scene/mod.rs", "src/scene/contact.rs", "src/scene/ring.rs", "src/scene/bearing/rolling_element.rs"];

/// Every key of a scene file: by table, whether it is needed, and what holds without it.
pub fn scene_page(source: &Path) -> Result<String> {
    let reader = fs::read_to_string(source.join(READER)).context(READER)?;
    let mut files = vec![reader.clone()];
    for entry in fs::read_dir(source.join(TABLES)).context(TABLES)? {
        files.push(fs::read_to_string(entry?.path())?);
    }
    let mut tables: Vec<(String, Vec<Key>)> = files.iter().flat_map(|text| tables_in(text)).collect();
    for file in WORDS {
        files.push(fs::read_to_string(source.join(file)).context(file)?);
    }
    let outermost = |name: &str| name.split('.').next().unwrap_or_default().to_owned();
    tables.sort_by_key(|(name, _)| (reader.find(&format!(" {}: ", outermost(name))).unwrap_or(0), name.clone()));
    let mut page = String::from(
        "# Keys of a scene\n\nA scene is a TOML file. Every key carries its unit. This page is made of the source that \
         reads the file, so it names every key there is.\n",
    );
    for (name, keys) in &tables {
        let heading = if name.is_empty() { "The file itself".to_owned() } else { format!("`[{name}]`") };
        writeln!(page, "\n## {heading}\n")?;
        if keys.is_empty() {
            writeln!(page, "A table without keys.")?;
            continue;
        }
        writeln!(page, "| key | what it takes | needed |\n|---|---|---|")?;
        for key in keys {
            let takes = takes(key, &files).with_context(|| format!("key {}: what is a {}?", key.name, key.kind))?;
            writeln!(page, "| `{}` | {takes} | {} |", key.name, if key.optional { "" } else { "yes" })?;
        }
    }
    page.push_str("\n## What holds without a key\n\n");
    for line in reader.lines().map_while(|line| line.strip_prefix("//!")) {
        writeln!(page, "{}", line.strip_prefix(' ').unwrap_or(line))?;
    }
    Ok(page)
}

struct Key {
    name: String,
    /// Its type in the source.
    kind: String,
    optional: bool,
}

/// The tables that a source file declares: `struct BearingTable { … }` is `[bearing]`, `struct SceneFile` the file.
fn tables_in(source: &str) -> Vec<(String, Vec<Key>)> {
    let mut found = Vec::new();
    let parts: Vec<&str> = source.split("struct ").collect();
    for (before, part) in parts.iter().zip(&parts[1..]) {
        let attributes = before.rsplit("\n\n").next().unwrap_or_default();
        let whole_default = attributes.lines().any(|line| line.starts_with("#[serde(") && line.contains("default"));
        let Some((name, body)) = part.split_once('}').and_then(|(whole, _)| whole.split_once(" {")) else { continue };
        let table = if name == "SceneFile" { Some("") } else { name.strip_suffix("Table") };
        let Some(table) = table.filter(|table| table.chars().all(char::is_alphabetic)) else { continue };
        found.push((path_of(table), keys_in(body, whole_default)));
    }
    found
}

/// The table's name in a file: `SensorMode` is `sensor.mode`.
fn path_of(table: &str) -> String {
    let mut path = String::new();
    for letter in table.chars() {
        if letter.is_uppercase() && !path.is_empty() {
            path.push('.');
        }
        path.extend(letter.to_lowercase());
    }
    path
}

/// The fields of a table, all of which may be left out where `whole_default` says so.
fn keys_in(body: &str, whole_default: bool) -> Vec<Key> {
    let mut keys = Vec::new();
    let mut default = false;
    for line in body.lines().map(str::trim) {
        if line.starts_with("#[serde(default") {
            default = true;
        } else if let Some((name, kind)) = line.trim_end_matches(',').split_once(": ")
            && !line.starts_with("//")
        {
            let name = name.trim_start_matches("pub(super) ").to_owned();
            let optional = whole_default || default || kind.starts_with("Option<");
            let kind = kind.strip_prefix("Option<").and_then(|kind| kind.strip_suffix('>')).unwrap_or(kind).to_owned();
            keys.push(Key { name, kind, optional });
            default = false;
        }
    }
    keys
}

/// What a user writes for a key's type; words are those of the enumeration of that name in `files`.
fn takes(key: &Key, files: &[String]) -> Option<String> {
    let plain = match key.kind.as_str() {
        "f64" => "number",
        "usize" | "i64" | "u64" | "u32" => "whole number",
        "[f64; 2]" => "two numbers",
        "[usize; 2]" | "[u32; 2]" => "two whole numbers",
        "String" => "text",
        "bool" => "true or false",
        kind if kind.starts_with("OneOrMore<") => {
            return Some(format!("table; `[[{}]]` for each of several", key.name));
        }
        kind if kind.ends_with("Table>") => {
            let table = kind.trim_start_matches("Vec<").trim_end_matches("Table>");
            return Some(format!("table `[[{}]]`, each as often as wanted", path_of(table)));
        }
        kind if kind.ends_with("Table") => "table",
        kind if kind.starts_with("Vec<") => "list",
        kind => return files.iter().find_map(|text| words(text, kind)),
    };
    Some(plain.to_owned())
}

/// The words that stand for the variants of an enumeration: their names in small letters, with hyphens.
fn words(source: &str, kind: &str) -> Option<String> {
    let (_, rest) = source.split_once(&format!("enum {kind} {{\n"))?;
    let (body, _) = rest.split_once("\n}")?;
    let variants = body.lines().filter_map(|line| line.trim().strip_suffix(','));
    let word = |variant: &str| {
        let mut word = String::new();
        for letter in variant.chars() {
            if letter.is_uppercase() && !word.is_empty() {
                word.push('-');
            }
            word.extend(letter.to_lowercase());
        }
        format!("`\"{word}\"`")
    };
    let alone = variants.filter(|variant| variant.chars().all(char::is_alphanumeric));
    Some(alone.map(word).collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::collections::BTreeSet;

    use super::*;

    fn root() -> &'static Path {
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
    }

    #[test]
    fn the_list_of_keys_has_every_key_that_a_shipped_scene_gives() {
        let page = scene_page(root()).unwrap();
        for entry in fs::read_dir(root().join("scenes")).unwrap() {
            let path = entry.unwrap().path();
            let text = fs::read_to_string(&path).unwrap();
            let lines = text.lines().filter(|line| path.extension().unwrap() == "toml" && !line.starts_with('#'));
            for (key, _) in lines.filter_map(|line| line.split_once(" = ")) {
                assert!(page.contains(&format!("| `{}` |", key.trim())), "{}: {key}", path.display());
            }
        }
        assert!(page.contains("## `[bearing]`") && page.contains("| `element_count` | whole number |  |"), "{page}");
        assert!(page.contains("| `catalogue` | text |  |") && page.contains("| `speed_hz` | number | yes |"), "{page}");
        assert!(page.contains("| `slip` | number |  |") && page.contains("`solver.tolerance`"), "{page}");
    }

    #[test]
    fn every_table_of_a_scene_has_a_part_of_the_page_and_no_other_struct_of_the_source_has_one() {
        let page = scene_page(root()).unwrap();
        let of_the_file: BTreeSet<_> = page
            .lines()
            .filter(|line| line.contains("| table"))
            .map(|line| match line.split_once("| table `[[") {
                Some((_, nested)) => format!("`[{}]`", nested.split(']').next().unwrap()),
                None => format!("`[{}]`", line.split('`').nth(1).unwrap()),
            })
            .collect();
        let parts: BTreeSet<_> = page
            .lines()
            .filter_map(|line| line.strip_prefix("## "))
            .filter(|h| h.contains('['))
            .map(str::to_owned)
            .collect();
        assert_eq!(parts, of_the_file);
        assert!(
            of_the_file.contains("`[sensor.mode]`")
                && of_the_file.contains("`[probe]`")
                && page.contains("A table without keys."),
            "{page}"
        );
        assert!(page.contains("| `motion` | `\"host\"`, `\"internal\"`, `\"fixed\"` | yes |"), "{page}");
        assert!(page.contains("| `filter` | `\"linear-phase\"`, `\"none\"` |  |"), "{page}");
        assert!(page.contains("| `defect` | table; `[[defect]]` for each of several |"), "{page}");
    }
}
