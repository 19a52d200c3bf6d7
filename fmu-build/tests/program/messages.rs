//! What a user reads, and how much: the reason of what is not done, once; quiet and detailed runs; JSON of tables.
#![allow(clippy::unwrap_used)]

use crate::common;
use crate::common::program::{brinell, done, refused};
use std::fs;

use serde_json::Value;

#[track_caller]
fn once(said: &str, words: &str) {
    assert_eq!(said.matches(words).count(), 1, "`{words}` once in: {said}");
}

#[test]
fn a_reader_that_has_gone_ends_the_program_without_a_word() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let ended = brinell(&["scenes"]).stdout(writer).output().unwrap();
    assert!(!ended.status.success());
    assert_eq!(String::from_utf8(ended.stderr).unwrap(), "");
}

#[cfg(unix)]
#[test]
fn a_library_that_cannot_be_loaded_is_said_once() {
    common::python();
    let folder = common::folder("no-library");
    fs::write(folder.join("no.so"), "no library").unwrap();
    done(brinell(&["build", "6205-healthy", "--library", "no.so"]).current_dir(&folder));
    let said = refused(brinell(&["check", "6205-healthy.fmu"]).current_dir(&folder));
    once(&said, "Failed to load shared library");
}

#[test]
fn scenes_that_cannot_be_built_are_told_and_do_not_keep_others_from_it() {
    let folder = common::folder("some-scenes");
    fs::write(folder.join("so"), "any file").unwrap();
    fs::write(folder.join("bad.toml"), "name = \"bad\"").unwrap();
    let build = ["build", "bad.toml", "6205-healthy", "missing.toml", "6205-hosted", "--library", "so", "-o", "."];
    let said = refused(brinell(&build).current_dir(&folder));
    for words in ["2 of 4 scenes were not built", "bad.toml", "missing.toml"] {
        once(&said, words);
    }
    assert!(["6205-healthy.fmu", "6205-hosted.fmu"].iter().all(|name| folder.join(name).is_file()));
}

#[test]
fn a_new_scene_runs_as_it_is_and_is_not_written_over() {
    let folder = common::folder("new-scene");
    let new = ["new", "mine", "--bearing", "6206-2RS", "--defect", "inner:1.2mm"];
    done(brinell(&new).current_dir(&folder));
    done(brinell(&["run", "mine.toml", "--no-figure", "--stop", "0.002"]).current_dir(&folder));
    once(&refused(brinell(&new).current_dir(&folder)), "is there already and stays as it is");
    for (name, found) in [("NJ205", "\nNU205 "), ("6205-2RS", "\n6205 "), ("nu20", "\nNU203 ")] {
        once(&done(&mut brinell(&["catalogue", name])).out, found);
    }
    let listed = done(&mut brinell(&["catalogue", "62"])).out;
    once(&listed, "Case Western Reserve University's bearing data, drive end");
    let count = |word: &str| listed.lines().filter(|line| line.contains(word)).count();
    // 6200, 6201 and 6202; 6204 and 6206 to 6212.
    assert_eq!((count("assumed"), count("table A-9")), (3, 8), "{listed}");
    assert!(!listed.contains("\n60"), "{listed}");
}

#[test]
fn names_are_read_as_makers_write_them_by_every_command() {
    let folder = common::folder("makers-names");
    let out = done(&mut brinell(&["catalogue", "skf 6205-2z/c3", "--json"])).out;
    let bearing: Value = serde_json::from_str::<Vec<Value>>(&out).unwrap().remove(0);
    assert_eq!((&bearing["name"], &bearing["internal_clearance_um"]), (&"6205".into(), &20.5.into()), "{out}");
    let new = ["new", "mine", "--bearing", "NU 205 ECP/C3", "--hosted", "--load", "450"];
    once(&done(brinell(&new).current_dir(&folder)).err, "EC (the maker's design), P (cage)");
    let own = fs::read_to_string(folder.join("mine.toml")).unwrap();
    once(&own, "catalogue = \"NU 205 ECP/C3\"");
    once(&own, "internal_clearance_um = 47.5          # assumed: middle of C3, 35 to 60 um (ISO 5753-1)");
    once(&own, "largest_force_n = 1000.0");
    let tilting = ["new", "tilts", "--bearing", "6205", "--hosted", "--load", "450", "--degrees-of-freedom", "5"];
    done(brinell(&tilting).current_dir(&folder));
    once(&fs::read_to_string(folder.join("tilts.toml")).unwrap(), "degrees_of_freedom = 5");
    let run = ["run", "--bearing", "6205 ZZ C4", "--stop", "0.001", "--no-figure"];
    once(&done(brinell(&run).current_dir(&folder)).err, "C4, 23 to 41 um (ISO 5753-1), of which the middle, 32 um");
    let hybrid = own.replace("NU 205 ECP/C3", "NU 205 ECM/HC5C3").replace("internal_clearance_um", "# internal");
    fs::write(folder.join("hybrid.toml"), hybrid).unwrap();
    let said = done(brinell(&["run", "hybrid.toml", "--stop", "0.001", "--no-figure"]).current_dir(&folder)).err;
    assert!(said.contains("silicon nitride") && said.contains("C3, 35 to 60 um"), "{said}");
    let said = refused(brinell(&["new", "none", "--bearing", "7208-2RS"]).current_dir(&folder));
    assert!(["7208C", "7208AC", "7208B"].iter().all(|name| said.contains(name)) && !said.contains("6208"), "{said}");
    let said = refused(&mut brinell(&["catalogue", "6313"]));
    assert!(said.contains("6301 to 6312") && said.contains("bearing.element_count"), "{said}");
}

#[test]
fn scenes_that_are_written_have_the_schema_beside_them_that_they_name() {
    let folder = common::folder("schema-beside");
    let schema = folder.join("scene.schema.json");
    for command in [["new", "mine"], ["scenes", "6205-epps"]] {
        once(&done(brinell(&command).arg("--output").arg(&folder)).out, "scene.schema.json");
        assert_eq!(fs::read_to_string(&schema).unwrap(), done(&mut brinell(&["schema"])).out);
        fs::remove_file(&schema).unwrap();
    }
    // Somebody else's stays.
    fs::write(&schema, "{}").unwrap();
    done(brinell(&["new", "other", "--output"]).arg(&folder));
    assert_eq!(fs::read_to_string(&schema).unwrap(), "{}");
}

#[test]
fn a_quiet_run_says_nothing_but_its_files_and_a_detailed_one_its_steps() {
    let run = ["run", "6205-healthy", "--stop", "0.01", "--no-figure"];
    let folder = common::folder("quiet");
    let said = |how: &str| done(brinell(&run).arg(how).current_dir(&folder));
    let quiet = said("--quiet");
    assert_eq!((quiet.out.as_str(), quiet.err.as_str()), ("6205-healthy.csv\n", ""));
    let steps = said("-v").err;
    assert!(steps.contains("integration steps and ") && steps.contains(" rejected in "), "{steps}");
}

#[test]
fn shells_complete_every_command() {
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let out = done(&mut brinell(&["completions", shell])).out;
        assert!(["sweep", "paper", "size"].iter().all(|command| out.contains(command)), "{shell}: {out}");
    }
}

#[test]
fn tables_are_json_as_well() {
    let out = done(&mut brinell(&["catalogue", "6205", "--json"])).out;
    let bearing: Value = serde_json::from_str::<Vec<Value>>(&out).unwrap().remove(0);
    // Z/2 (1 − D/D_pw) times a turn, and the maker's 14.0 and 7.85 kN.
    let order = bearing["bpfo_orders"].as_f64().unwrap();
    assert!((order - 4.5 * (1.0 - 7.94 / 39.04)).abs() < 1e-9, "{bearing}");
    for (rating, maker) in [("dynamic_rating_n", 14.0e3), ("static_rating_n", 7.85e3)] {
        assert!((bearing[rating].as_f64().unwrap() / maker - 1.0).abs() < 0.02, "{bearing}");
    }
    let stiffness = ["stiffness", "er16k-tb2", "--json", "--no-figure", "--points", "20"];
    let said = done(brinell(&stiffness).current_dir(common::folder("stiffness-json")));
    let (out, found) = (&said.out, serde_json::from_str::<Value>(&said.out).unwrap());
    // By law hertz 3598 N (docs/evidence/validation.md); the stiffest place is healthy, 58 N/µm.
    assert!((found["critical_load_n"].as_f64().unwrap() - 3598.0).abs() < 1.0, "{out}");
    assert!((found["stiffness_n_m"]["greatest"].as_f64().unwrap() / 58e6 - 1.0).abs() < 0.02, "{out}");
    assert!(said.err.contains("er16k-tb2-stiffness.csv"), "{}", said.err);
    let out = done(&mut brinell(&["scenes", "--json"])).out;
    let scenes: Vec<Value> = serde_json::from_str(&out).unwrap();
    assert!(scenes.iter().any(|scene| scene["name"] == "er16k-tb1"), "{out}");
}
