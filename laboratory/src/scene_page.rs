//! The page that lists every key of a scene, `docs/reference/keys.md`, made of the schema that editors check scenes by.

use std::fmt::Write;

use anyhow::{Context, Result};
use serde_json::Value;

/// What the page begins with.
const HEAD: &str = include_str!("../assets/keys.md");

/// Every key of a scene file, by table: what it takes, what it means, what holds without it.
fn scene_page() -> Result<String> {
    let schema = serde_json::to_value(brinell_scene_file::schema())?;
    let mut page = HEAD.to_owned();
    table(&mut page, &schema, &schema, "")?;
    Ok(page)
}

/// A table at `path` in the file, and those in it.
fn table(page: &mut String, schema: &Value, table: &Value, path: &str) -> Result<()> {
    let heading = if path.is_empty() { "The file itself".to_owned() } else { format!("`[{path}]`") };
    writeln!(page, "\n## {heading}\n")?;
    let Some(keys) = table["properties"].as_object() else {
        writeln!(page, "A table without keys.")?;
        return Ok(());
    };
    writeln!(page, "| key | takes | meaning | default |\n|---|---|---|---|")?;
    let needed = |key: &str| table["required"].as_array().is_some_and(|all| all.iter().any(|name| name == key));
    let mut inner = Vec::new();
    for (key, property) in keys {
        let path = format!("{path}{}{key}", if path.is_empty() { "" } else { "." });
        let kind = meant(schema, property);
        let takes = takes(schema, kind, &path).with_context(|| format!("what does {path} take? {property}"))?;
        let without = match &property["default"] {
            _ if needed(key) => "required".to_owned(),
            // A table that may be missing is none; of others each key has what holds without it.
            Value::Null if of_table(schema, kind).is_some() => {
                let is_read = property["$ref"].is_string() && kind["type"] == "object";
                (if is_read { "by its keys" } else { "none" }).to_owned()
            }
            Value::Null => String::new(),
            Value::Number(number) => number.as_f64().map(|value| format!("`{}`", digits(value))).unwrap_or_default(),
            default => format!("`{default}`"),
        };
        let about = property["description"].as_str().unwrap_or_default().replace('\n', " ");
        let limits = limits(if kind["items"].is_object() { meant(schema, &kind["items"]) } else { kind });
        writeln!(page, "| `{key}` | {takes}{limits} | {about} | {without} |")?;
        inner.extend(of_table(schema, kind).map(|of| (path, of)));
    }
    inner.into_iter().try_for_each(|(path, of)| self::table(page, schema, of, &path))
}

/// What a reference refers to; of something that may be missing, what it is if it is there.
fn meant<'s>(schema: &'s Value, of: &'s Value) -> &'s Value {
    if let Some(name) = of["$ref"].as_str().and_then(|path| path.strip_prefix("#/$defs/")) {
        return meant(schema, &schema["$defs"][name]);
    }
    match of["anyOf"].as_array().map(Vec::as_slice) {
        Some([one, none]) if none["type"] == "null" => meant(schema, one),
        _ => of,
    }
}

/// The table that a key takes, once or several times.
fn of_table<'s>(schema: &'s Value, kind: &'s Value) -> Option<&'s Value> {
    let one = [&kind["anyOf"][0], &kind["items"], kind].into_iter().map(|of| meant(schema, of));
    one.into_iter().find(|of| of["type"] == "object")
}

fn digits(value: f64) -> String {
    match value.abs() {
        size if size != 0.0 && !(1e-3..1e5).contains(&size) => format!("{value:e}"),
        _ => format!("{value}"),
    }
}

/// The limits of a number, if it has any.
fn limits(number: &Value) -> String {
    let limit = |key: &str, word: &str| number[key].as_f64().map(|value| format!("{word} {}", digits(value)));
    let low = limit("minimum", "from").or_else(|| limit("exclusiveMinimum", "above"));
    let high = limit("maximum", "to").or_else(|| limit("exclusiveMaximum", "below"));
    low.into_iter().chain(high).map(|limit| format!(", {limit}")).collect()
}

/// What a user writes for a key.
fn takes(schema: &Value, kind: &Value, path: &str) -> Option<String> {
    if of_table(schema, kind).is_some() {
        return Some(match kind {
            either if either["anyOf"][1]["type"] == "string" => format!("text, or a table `[{path}]`"),
            several if several["anyOf"].is_array() => format!("table; `[[{path}]]` for each of several"),
            several if several["items"].is_object() => format!("table `[[{path}]]`, each as often as wanted"),
            _ => "table".to_owned(),
        });
    }
    let listed = kind["enum"].as_array().into_iter().flatten();
    let described = kind["oneOf"].as_array().into_iter().flatten().map(|one| &one["const"]);
    let words: Vec<String> = listed.chain(described).map(|word| format!("`{word}`")).collect();
    if !words.is_empty() {
        return Some(words.join(", "));
    }
    let name = kind["type"].as_str().or_else(|| kind["type"][0].as_str())?;
    Some(match name {
        "number" => "number".to_owned(),
        "integer" => "whole number".to_owned(),
        "string" => "text".to_owned(),
        "boolean" => "true or false".to_owned(),
        "array" => {
            let each = takes(schema, meant(schema, &kind["items"]), path)?;
            match [&kind["minItems"], &kind["maxItems"]].map(serde_json::Value::as_u64) {
                [Some(2), Some(2)] => format!("two {each}s"),
                [Some(2), Some(3)] => format!("two or three {each}s"),
                _ => format!("list, each a {each}"),
            }
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use std::fs;
    use std::path::Path;

    use super::*;

    #[test]
    fn the_page_of_keys_is_what_the_schema_says() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/reference/keys.md");
        let page = scene_page().unwrap();
        if std::env::var_os("BLESS").is_some() {
            fs::write(&path, &page).unwrap();
        }
        assert_eq!(fs::read_to_string(&path).unwrap(), page, "BLESS=1 writes it anew");
    }

    #[test]
    fn the_list_of_keys_has_every_key_that_a_shipped_scene_gives() {
        let page = scene_page().unwrap();
        for entry in fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")).unwrap() {
            let path = entry.unwrap().path();
            let text = fs::read_to_string(&path).unwrap();
            let lines = text.lines().filter(|line| path.extension().unwrap() == "toml" && !line.starts_with('#'));
            for (key, _) in lines.filter_map(|line| line.split_once(" = ")) {
                assert!(page.contains(&format!("| `{}` |", key.trim())), "{}: {key}", path.display());
            }
        }
        for part in [
            "## `[sensor.mode]`\n",
            "| `solver` | table | Time integration. | by its keys |",
            "| `film` | table | An oil film; without it contacts are dry. | none |",
            "| `stiffness_n_m` | number, from 0, to 1e15 | Stiffness to the ground. | `1.51056e7` |",
            "## `[probe]`\n\nA table without keys.",
            "| `defect` | table; `[[defect]]` for each of several |",
            "| `mode` | table `[[sensor.mode]]`, each as often as wanted |",
            "| `element_count` | whole number, from 1, to 1000 |",
            "| `motion` | `\"host\"`, `\"internal\"`, `\"fixed\"` | ",
            "| `filter` | `\"linear-phase\"`, `\"none\"` | ",
            "| `load_n` | two or three numbers, from -1e9, to 1e9 |",
            "| `stop_s` | number, above 0, to 1e9 | How long it takes. | `0.5` |",
        ] {
            assert!(page.contains(part), "{part} is not in:\n{page}");
        }
        let motion = page.lines().find(|line| line.starts_with("| `motion`")).unwrap();
        assert!(motion.ends_with("| required |"), "{motion}");
    }
}
