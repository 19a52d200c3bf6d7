//! `fmi2-rules.csv` and `fmi3-rules.csv` in `docs/data`: each rule of the standard has a test, or a measurement.
//! A test that fails fails the suite that this belongs to.
#![allow(clippy::unwrap_used)]

use std::fs;

use serde::Deserialize;

#[derive(Deserialize)]
struct Rule {
    rule: String,
    /// `file: test` or a command, between semicolons.
    shown_by: String,
    result: String,
}

impl Rule {
    /// What is wrong with its evidence.
    fn fault(&self) -> Option<String> {
        if self.shown_by.is_empty() || self.result.is_empty() {
            return Some("neither test nor measurement".to_owned());
        }
        self.shown_by.split("; ").find_map(|one| {
            let Some((file, name)) = one.split_once(".rs: ") else {
                // A command, whose figure is the result.
                return (self.result == "passes").then(|| format!("{one} without a figure"));
            };
            let text = fs::read_to_string(brinell_tests::root().join(format!("{file}.rs"))).unwrap_or_default();
            (!text.contains(&format!("fn {name}("))).then(|| format!("no test {name} in {file}.rs"))
        })
    }
}

#[test]
fn every_rule_of_the_standard_has_a_test_or_a_measurement() {
    for (table, fewest) in [("fmi2-rules.csv", 60), ("fmi3-rules.csv", 30)] {
        let path = brinell_tests::root().join("docs/data").join(table);
        let rules: Vec<Rule> = csv::Reader::from_path(path).unwrap().deserialize().map(Result::unwrap).collect();
        for rule in &rules {
            let fault = rule.fault();
            assert!(fault.is_none(), "{table}: {} {}", rule.rule, fault.unwrap());
        }
        assert!(rules.len() >= fewest, "{table}: {} rules", rules.len());
    }
}
