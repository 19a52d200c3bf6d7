//! The JSON schema of scene files: valid for every scene that is shipped or written, not for what is refused.
#![allow(clippy::unwrap_used)]

use crate::common;
use crate::common::program::{brinell, done};
use std::collections::HashMap;
use std::fs;
use std::path::Path;

/// Scenes that the schema refuses as [`brinell_scene_file::from_toml`] does: what is replaced in a scene, and by what.
const BAD: [(&str, &str); 14] = [
    ("element_count = 9", "element_cout = 9"),
    ("element_count = 9", "element_count = \"nine\""),
    ("motion = \"internal\"\nspeed_hz", "speed_hz"),
    ("motion = \"internal\"\nspeed_hz", "motion = \"free\"\nspeed_hz"),
    ("on = \"inner\"", "on = \"cage\""),
    ("angle_deg = -103.3", "angle = -103.3"),
    ("load_n = [0.0, -49.0]", "load_n = [0.0, -49.0, 0.0, 0.0]"),
    ("element_count = 9", "element_count = 9\ndegrees_of_freedom = 4"),
    ("[solver]", "[solwer]"),
    ("element_count = 9", "element_count = 0"),
    ("load_n = [0.0, -49.0]", "load_n = [0.0, -2e9]"),
    ("poissons_ratio = 0.3", "poissons_ratio = 0.5"),
    ("tolerance = 1e-5", "tolerance = 0.2"),
    ("name = \"6205-inner-5deg\"", "name = \"6205 inner\""),
];

fn schema() -> String {
    done(&mut brinell(&["schema"])).out
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
    let file = folder.join("scene.schema.json");
    fs::write(&file, schema()).unwrap();
    done(brinell(&["new", "new", "--defect", "element:1mm", "--output"]).arg(&folder));
    let mut texts: Vec<(String, String)> = common::scenes()
        .iter()
        .chain([&folder.join("new.toml")])
        .map(|path| (path.file_stem().unwrap().to_str().unwrap().to_owned(), fs::read_to_string(path).unwrap()))
        .collect();
    let good = texts.len();
    let scene = common::scene_text("6205-inner-5deg");
    for (k, (old, new)) in BAD.iter().enumerate() {
        assert_eq!(scene.matches(old).count(), 1, "{old}");
        let text = scene.replace(old, new);
        assert!(brinell_scene_file::from_toml(&text).is_err(), "{new}");
        texts.push((format!("bad-{k}"), text));
    }
    let files: Vec<String> = texts.iter().map(|(name, text)| as_json(&folder, name, text)).collect();
    let said = common::run_script("schema.py", [&file.display().to_string()].into_iter().chain(&files));
    let verdicts: HashMap<&str, &str> = said.lines().map(|line| line.split_once('\t').unwrap()).collect();
    for (k, file) in files.iter().enumerate() {
        let verdict = verdicts[file.as_str()];
        assert_eq!(verdict == "valid", k < good, "{file}: {verdict}");
    }
}

#[test]
fn editors_find_the_schema_of_shipped_scenes() {
    common::is_committed(&common::root().join("scenes/scene.schema.json"), &schema());
    for path in common::scenes() {
        assert!(fs::read_to_string(&path).unwrap().starts_with("#:schema scene.schema.json\n"), "{}", path.display());
    }
}

#[test]
fn the_schema_explains_every_key() {
    let schema: serde_json::Value = serde_json::from_str(&schema()).unwrap();
    let tables = schema["$defs"].as_object().unwrap().values().chain([&schema]);
    let mut count = 0;
    for (key, value) in tables.filter_map(|table| table["properties"].as_object()).flatten() {
        assert!(value["description"].as_str().is_some_and(|text| text.len() > 8), "{key}: {value}");
        count += 1;
    }
    assert!(count > 70, "{count} keys");
}

/// A scene with every table.
const WHOLE: &str = r#"
name = "whole"
gravity_m_s2 = [0.0, -9.81]
[bearing]
catalogue = "6205"
[contact]
[film]
viscosity_pa_s = 0.04
pressure_viscosity_1_pa = 2e-8
[cage]
seed = 1
[[defect]]
on = "element"
element = 1
angle_deg = 0.0
length_mm = 1.0
depth_um = 50.0
[[waviness]]
on = "element"
element = 1
order = 2
amplitude_um = 0.1
angle_deg = 0.0
[shaft]
motion = "internal"
speed_hz = 10.0
load_n = [0.0, -500.0]
[housing]
motion = "internal"
[[sensor]]
[[sensor.mode]]
frequency_hz = 1000.0
damping_ratio = 0.1
gain = 1.0
[solver]
[recorder]
rate_hz = 51200.0
[experiment]
"#;

/// Bounds of a schema's numbers, those of lists included: key with its table, name of the bound, its value, and whether
/// numbers are whole and how many there are.
fn bounds(schema: &serde_json::Value) -> Vec<(String, String, f64, bool, bool)> {
    let tables = [
        ("", ""),
        ("bearing", "BearingTable"),
        ("contact", "ContactTable"),
        ("film", "FilmTable"),
        ("cage", "CageTable"),
        ("defect", "DefectTable"),
        ("waviness", "WavinessTable"),
        ("shaft", "ShaftTable"),
        ("housing", "HousingTable"),
        ("sensor", "SensorTable"),
        ("sensor.mode", "SensorModeTable"),
        ("solver", "SolverTable"),
        ("recorder", "RecorderTable"),
        ("experiment", "ExperimentTable"),
    ];
    let mut bounds = Vec::new();
    for (table, name) in tables {
        let properties = if name.is_empty() { &schema["properties"] } else { &schema["$defs"][name]["properties"] };
        for (key, property) in properties.as_object().unwrap() {
            let is_list = property.get("items").is_some();
            let number = property.get("items").unwrap_or(property);
            let whole = number["type"] == "integer" || number["type"].get(0).is_some_and(|of| of == "integer");
            for bound in ["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"] {
                if let Some(value) = number[bound].as_f64() {
                    bounds.push((format!("{table}.{key}"), bound.to_owned(), value, whole, is_list));
                }
            }
        }
    }
    bounds
}

#[test]
fn every_bound_of_the_schema_is_refused_just_outside_by_the_program() {
    brinell_scene_file::from_toml(WHOLE).unwrap();
    let schema: serde_json::Value = serde_json::from_str(&schema()).unwrap();
    let bounds = bounds(&schema);
    for (path, bound, value, whole, is_list) in &bounds {
        let (table, key) = path.rsplit_once('.').unwrap();
        let outwards = if bound.ends_with("inimum") { -1.0 } else { 1.0 };
        let outside = if bound.starts_with("exclusive") {
            *value
        } else if *whole {
            // Values are rounded to twelve digits before they are compared.
            value + outwards * (1e-9 * value.abs()).max(1.0)
        } else {
            value + outwards * (1e-9 * value.abs()).max(f64::MIN_POSITIVE)
        };
        let shown = if *whole { format!("{outside:.0}") } else { format!("{outside:?}") };
        let shown = if *is_list { format!("[{shown}, {shown}]") } else { shown };
        let mut text: String = WHOLE
            .lines()
            .filter(|line| !line.starts_with(&format!("{key} =")))
            .fold(String::new(), |text, line| text + line + "\n");
        let heads = [format!("\n[{table}]\n"), format!("\n[[{table}]]\n")];
        match heads.iter().find(|head| text.contains(head.as_str())) {
            None => text = format!("{key} = {shown}\n{text}"),
            Some(head) => text = text.replacen(head, &format!("{head}{key} = {shown}\n"), 1),
        }
        let said = brinell_scene_file::from_toml(&text)
            .map_or_else(|error| error.to_string(), |_| panic!("{path} = {shown} was accepted"));
        assert!(said.contains(key), "{path} = {shown}: {said}");
    }
    assert!(bounds.len() > 110, "{} bounds", bounds.len());
    // Lists of tables have a longest.
    let mode = "[[sensor.mode]]\nfrequency_hz = 1000.0\ndamping_ratio = 0.1\ngain = 1.0\n";
    let lists = [("OneOrMoreSensorTable/anyOf/1", "[[sensor]]\n"), ("SensorTable/properties/mode", mode)];
    for (definition, table) in lists {
        let most =
            schema.pointer(&format!("/$defs/{definition}/maxItems")).and_then(|most| most.as_u64()).unwrap() as usize;
        let whole = WHOLE.replace(mode, "").replace("[[sensor]]\n", "");
        let text = |count: usize| match definition.starts_with("OneOr") {
            true => whole.clone() + &table.repeat(count),
            false => format!("{whole}[[sensor]]\n{}", table.repeat(count)),
        };
        assert!(
            brinell_scene_file::from_toml(&text(most)).is_ok()
                && brinell_scene_file::from_toml(&text(most + 1)).is_err(),
            "{definition}"
        );
    }
}

#[test]
fn every_number_of_a_scene_has_bounds_in_the_schema() {
    let schema: serde_json::Value = serde_json::from_str(&schema()).unwrap();
    let bounded = bounds(&schema);
    for (name, table) in schema["$defs"].as_object().unwrap() {
        for (key, property) in table["properties"].as_object().into_iter().flatten() {
            let number = property.get("items").unwrap_or(property);
            let kinds = number["type"].to_string();
            // Which of all random courses it is has no limit but that of its type; of a few all are listed.
            let listed = key == "seed" || key.ends_with("_seed") || property.get("enum").is_some();
            if (kinds.contains("number") || kinds.contains("integer")) && !listed {
                let count = bounded.iter().filter(|(path, ..)| path.ends_with(&format!(".{key}"))).count();
                assert!(count >= 2, "{name}.{key} has {count} bounds");
            }
        }
    }
}
