//! The JSON schema of scene files: valid for every scene that is shipped or written, not for what is refused.
#![allow(clippy::unwrap_used)]

mod common;

use std::collections::HashMap;
use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

use brinell::scene::Scene;

/// Scenes that the schema refuses as [`Scene::from_toml`] does: what is replaced in a scene, and by what.
const BAD: [(&str, &str); 8] = [
    ("element_count = 9", "element_cout = 9"),
    ("element_count = 9", "element_count = \"nine\""),
    ("motion = \"internal\"\nspeed_hz", "speed_hz"),
    ("motion = \"internal\"\nspeed_hz", "motion = \"free\"\nspeed_hz"),
    ("on = \"inner\"", "on = \"cage\""),
    ("angle_deg = -103.3", "angle = -103.3"),
    ("load_n = [0.0, -49.0]", "load_n = [0.0, -49.0, 0.0]"),
    ("[solver]", "[solwer]"),
];

fn program(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_brinell")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Puts a scene as JSON into a file.
fn as_json(folder: &Path, name: &str, text: &str) -> String {
    let value: serde_json::Value = toml::from_str(text).unwrap();
    let path = folder.join(name).with_extension("json");
    fs::write(&path, value.to_string()).unwrap();
    path.display().to_string()
}

#[test]
fn the_schema_takes_every_scene_and_refuses_wrong_keys_types_and_words() {
    let folder = common::folder("schema");
    let schema = folder.join("scene.schema.json");
    fs::write(&schema, program(&["schema"])).unwrap();
    let new = ["new", "new", "--defect", "element:1mm", "--output", folder.to_str().unwrap()];
    program(&new);
    let mut texts: Vec<(String, String)> = common::scenes()
        .iter()
        .chain([&folder.join("new.toml")])
        .map(|path| (path.file_stem().unwrap().to_str().unwrap().to_owned(), fs::read_to_string(path).unwrap()))
        .collect();
    let good = texts.len();
    let scene = fs::read_to_string(common::root().join("scenes/6205-inner-5deg.toml")).unwrap();
    for (k, (old, new)) in BAD.iter().enumerate() {
        assert_eq!(scene.matches(old).count(), 1, "{old}");
        let text = scene.replace(old, new);
        assert!(Scene::from_toml(&text).is_err(), "{new}");
        texts.push((format!("bad-{k}"), text));
    }
    let files: Vec<String> = texts.iter().map(|(name, text)| as_json(&folder, name, text)).collect();
    let said = common::run_script("schema.py", [&schema.display().to_string()].into_iter().chain(&files));
    let verdicts: HashMap<&str, &str> = said.lines().map(|line| line.split_once('\t').unwrap()).collect();
    for (k, file) in files.iter().enumerate() {
        let verdict = verdicts[file.as_str()];
        assert_eq!(verdict == "valid", k < good, "{file}: {verdict}");
    }
}

#[test]
fn editors_find_the_schema_of_shipped_scenes() {
    let file = common::root().join("scenes/scene.schema.json");
    let schema = program(&["schema"]);
    if env::var_os("BLESS").is_some_and(|value| value == "1") {
        fs::write(&file, &schema).unwrap();
    }
    assert!(fs::read_to_string(&file).unwrap_or_default() == schema, "{} is an old one; bless it", file.display());
    for path in common::scenes() {
        assert!(fs::read_to_string(&path).unwrap().starts_with("#:schema scene.schema.json\n"), "{}", path.display());
    }
}

#[test]
fn the_schema_explains_every_key() {
    let schema: serde_json::Value = serde_json::from_str(&program(&["schema"])).unwrap();
    let tables = schema["$defs"].as_object().unwrap().values().chain([&schema]);
    let mut count = 0;
    for (key, value) in tables.filter_map(|table| table["properties"].as_object()).flatten() {
        assert!(value["description"].as_str().is_some_and(|text| text.len() > 8), "{key}: {value}");
        count += 1;
    }
    assert!(count > 70, "{count} keys");
}
