//! Writes `docs/fmi2-conformance.md` and `docs/fmi3-conformance.md`: each rule of FMI 2.0 co-simulation, what importers
//! ask beyond it, and what FMI 3.0 asks beside it, with the tests that show it. A rule whose test is gone fails here; a
//! test that fails fails the suite that this belongs to. After a change: `BLESS=1 cargo test --workspace
//! --test conformance`.
#![allow(clippy::unwrap_used)]

#[path = "conformance/rules.rs"]
mod rules;

use rules::{Evidence, Rule, rules, rules_of_fmi3};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

fn root() -> &'static Path {
    brinell_tests::root()
}

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|end| end == "rs") {
            found.push(path);
        }
    }
}

/// Names of all tests, with the file that each is in.
fn tests() -> BTreeMap<String, String> {
    let mut files = Vec::new();
    for folder in ["src", "crates", "tests", "fmu-build/src", "fmu-build/tests"] {
        rust_files(&root().join(folder), &mut files);
    }
    let mut tests = BTreeMap::new();
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        let name = file.strip_prefix(root()).unwrap().to_string_lossy().replace('\\', "/");
        let mut is_test = false;
        for line in text.lines().map(str::trim) {
            if line == "#[test]" {
                is_test = true;
            } else if let Some(rest) = line.strip_prefix("fn ")
                && (std::mem::take(&mut is_test) || text.contains("proptest! {"))
            {
                tests.insert(rest.split('(').next().unwrap().to_owned(), name.clone());
            }
        }
    }
    tests
}

/// How each page begins.
const HEADS: [&str; 2] = [
    "# FMI 2.0, rule by rule\n\n",
    "# FMI 3.0, rule by rule\n\n\
     What FMI 3.0.2 asks of a co-simulation FMU where FMI 2.0 asks something else or nothing. Handles, arguments, \
     clock, saved states and panics are one and the same code for both versions: \
     [fmi2-conformance.md](fmi2-conformance.md) shows them through FMI 2.0's functions.\n\n",
];

fn written(head: &str, rules: impl Iterator<Item = &'static Rule>) -> String {
    let tests = tests();
    let mut page = head.to_owned();
    page.push_str(
        "Written by `tests/conformance.rs`; do not edit. Every test named here is run by `cargo test --workspace`, \
         most against the exported C functions themselves; two of the library's own run with `--release`, which links \
         the library that is shipped. The suite fails with any of them, so a rule stands as *passes* only while its \
         tests do. What is measured says with what.\n",
    );
    let mut section = "";
    for (of, rule, evidence) in rules {
        if *of != section {
            section = of;
            write!(page, "\n## {section}\n\n| rule | shown by | result |\n|---|---|---|\n").unwrap();
        }
        let (mut shown, mut result) = (Vec::new(), Vec::new());
        for one in *evidence {
            match one {
                Evidence::Test(name) => {
                    let file = tests.get(*name).unwrap_or_else(|| panic!("no test {name}, which shows: {rule}"));
                    shown.push(format!("[`{name}`](../{file})"));
                    if !result.contains(&"passes".to_owned()) {
                        result.push("passes".to_owned());
                    }
                }
                Evidence::Measured(how, figure) => {
                    shown.push(format!("`{how}`"));
                    result.push((*figure).to_owned());
                }
                Evidence::Not(why) => result.push(format!("not done: {why}")),
            }
        }
        writeln!(page, "| {rule} | {} | {} |", shown.join("<br>"), result.join("; ")).unwrap();
    }
    page
}

fn check(name: &str, written: &str) {
    let file = root().join("docs").join(name);
    if env::var_os("BLESS").is_some_and(|value| value == "1") {
        fs::write(&file, written).unwrap();
    }
    assert!(fs::read_to_string(&file).unwrap_or_default() == written, "{name} is not up to date; bless it");
}

#[test]
fn every_rule_has_a_test_or_a_measurement_and_the_pages_say_which() {
    check("fmi2-conformance.md", &written(HEADS[0], rules()));
    check("fmi3-conformance.md", &written(HEADS[1], rules_of_fmi3()));
}
